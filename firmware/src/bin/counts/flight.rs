//! The flight over which instructions are counted: the default controller on a 2 kg quadrotor.

use core::hint::black_box;

use firmware::airframe::{Airframe, ROTORS, RotorGeometry};
use firmware::board::mps2::counter::{self, Counter, Mark};
use firmware::commander::Directive;
use firmware::config::{FlightConfig, ModeSettings, Start};
use firmware::control::attitude::{AttitudeForm, AttitudeGains, SlidingAttitude};
use firmware::control::mixer::Mixer;
use firmware::control::observer::ObserverGains;
use firmware::control::position::{PositionGains, SlidingPosition};
use firmware::control::sliding::{AxisGains, ReachingLaw};
use firmware::guidance::{Guidance, JoinPlan, Trajectory};
use firmware::inner::Inner;
use firmware::latest::Latest;
use firmware::math;
use firmware::outer::{Outer, OuterInput};
use firmware::schedule::{FILTER, OUTER};
use firmware::settings::Changes;
use firmware::signals::{AttitudeReference, NavState, SensorFrame, Tick};
use firmware::validate::ConfigError;
use nalgebra::{UnitQuaternion, Vector3};

use crate::navigation::{Navigation, NavigationCounts};
use crate::plant::Plant;
use crate::sensors::Sensors;
use crate::tally::Tally;

/// 4 s to join the eight, and two and a half rounds of it.
const TICKS: Tick = 20_000;
/// Time before it for the estimator to align.
const STANDING: Tick = 1_200;

/// Instruction counts of a flight.
#[derive(Default)]
pub(crate) struct Counts {
    pub(crate) attitude: Tally,
    pub(crate) attitude_within_limits: Tally,
    pub(crate) position: Tally,
    pub(crate) guidance: Tally,
    pub(crate) mixer: Tally,
    pub(crate) mixer_saturated: Tally,
    pub(crate) navigation: NavigationCounts,
    /// Distance from the reference at the end, m: shows that the flight was valid.
    pub(crate) final_error_m: f32,
    /// Error of the position estimate at the end, m: shows that the estimate was valid.
    pub(crate) estimate_error_m: f32,
}

/// A vehicle of 2 kg with 0.25 m arms in X layout, after PX4's x500 in Gazebo.
fn airframe() -> Airframe {
    let (lift, arm) = (8.548_58e-6, 0.174 * 8.548_58e-6);
    let yaw = 0.016 * lift;
    Airframe {
        mass_kg: 2.0,
        inertia_kg_m2: [0.021_667, 0.021_667, 0.04],
        rotor_inertia_kg_m2: 2.65e-5,
        drag_n_s_m: [0.244; 3],
        rotational_drag_n_m_s2: [5e-4; 3],
        gravity_m_s2: 9.81,
        omega_max_rad_s: 1_071.0,
        rotor_lag_s: 0.02,
        spin_up_reaction: true,
        geometry: RotorGeometry {
            thrust: [lift; 4],
            roll: [-arm, arm, arm, -arm],
            pitch: [-arm, arm, -arm, arm],
            yaw: [-yaw, -yaw, yaw, yaw],
        },
    }
}

fn axis(lambda: f32, gain: f32, horizon_s: f32, approach_max: f32) -> AxisGains {
    AxisGains { approach_max, ..AxisGains::new(gain, lambda, ReachingLaw::ImplicitSgn { horizon_s }) }
}

/// Implicit sgn on every axis, both observers, and lead of the rotors.
fn config() -> FlightConfig {
    let (tilt, yaw) = (axis(12.0, 120.0, 0.02, 9.0), axis(3.0, 8.0, 0.05, 2.5));
    let (horizontal, vertical) = (axis(2.5, 12.0, 0.15, 6.0), axis(2.5, 8.0, 0.15, 6.0));
    FlightConfig {
        airframe: airframe(),
        attitude: AttitudeGains {
            axes: [tilt, tilt, yaw],
            form: AttitudeForm::Group,
            observer: ObserverGains { bandwidth_rad_s: 25.0, disturbance_max: 40.0 },
        },
        position: PositionGains {
            axes: [horizontal, horizontal, vertical],
            observer: ObserverGains { bandwidth_rad_s: 6.0, disturbance_max: 6.0 },
            effectiveness_rate: 1.0,
        },
        tilt_max_rad: 1.2,
        rotor_time_constant_s: 0.005,
        trajectory: Trajectory::FigureEight {
            center_m: [0.0, 0.0, 2.0],
            amplitude_m: [5.666_667, 2.833_333],
            rate_rad_s: 0.998_268,
            yaw_rad: 0.0,
        },
        join: Some(JoinPlan { duration_s: 4.0, start_acceleration_m_s2: [0.0; 3], middle_m: heapless::Vec::new() }),
        start: Start::InFlight,
        start_position_m: [0.0, 0.0, 2.0],
        estimator: None,
        modes: ModeSettings::default(),
    }
}

/// 5 m away from where the flight should begin, with a wrong heading, so that the rotors reach their limits.
fn start(config: &FlightConfig) -> NavState {
    let mut nav = NavState::at_rest();
    nav.position = config.start_position() + Vector3::new(0.0, -5.0, 0.0);
    nav.attitude = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 1.0);
    nav
}

/// The vehicle, the components of its controller that are counted, and the counts so far.
pub(crate) struct Flight {
    counter: Counter,
    counts: Counts,
    plant: Plant,
    sensors: Sensors,
    navigation: Navigation,
    inner: Inner,
    outer: Outer,
    guidance: Guidance,
    mixer: Mixer<ROTORS>,
    /// The reference in effect now, and the one from the next publication on.
    reference: AttitudeReference,
    next: AttitudeReference,
}

impl Flight {
    /// Ready to take off.
    ///
    /// # Errors
    /// The field of the configuration that is invalid.
    pub(crate) fn new(counter: Counter) -> Result<Self, ConfigError> {
        let config = config();
        config.validate()?;
        let airframe = &config.airframe;
        let plant = Plant::new(airframe, start(&config));
        let reference = AttitudeReference::idle(plant.nav.attitude);
        Ok(Self {
            counter,
            counts: Counts::default(),
            inner: Inner::new(&config, SlidingAttitude::new(&config.airframe, &config.attitude))?,
            outer: Outer::new(&config, SlidingPosition::new(airframe, &config.position))?,
            guidance: Guidance::new(config.trajectory.clone(), config.join.as_ref(), config.start_position())?,
            navigation: Navigation::new(counter, &config, &plant.nav),
            sensors: Sensors::new(),
            mixer: Mixer::new(&airframe.geometry.rows(), airframe.omega_max_rad_s)
                .map_err(|_| ConfigError::SingularGeometry)?,
            plant,
            reference,
            next: reference,
        })
    }

    /// The whole flight.
    pub(crate) fn fly(mut self) -> Counts {
        for tick in 0..STANDING {
            self.navigate(tick, true);
        }
        for tick in 0..TICKS {
            if tick % OUTER.period == OUTER.offset {
                self.reference = self.next;
            }
            if tick % OUTER.period == 0 {
                self.outer_job(tick);
            }
            self.navigate(STANDING + tick, false);
            self.inner_step(tick);
            self.plant.step(&self.inner.output().motors);
        }
        let end = self.guidance.at(TICKS).position;
        self.counts.final_error_m = math::sqrt((self.plant.nav.position - end).norm_squared());
        self.counts.estimate_error_m = self.navigation.error_m(&self.plant.nav);
        self.counts.navigation = self.navigation.counts;
        self.counts
    }

    /// The estimator runs alongside; the controller uses the true motion.
    fn navigate(&mut self, tick: Tick, at_rest: bool) {
        let measured = self.sensors.measure(tick, &self.plant.nav, &self.plant.specific_force);
        if tick % FILTER.period == FILTER.offset {
            self.navigation.publish();
        }
        self.navigation.step(&measured, self.plant.omega_rad_s());
        if tick.is_multiple_of(FILTER.period) {
            self.navigation.job(tick, at_rest);
        }
    }

    /// Guidance, position control and flatness.
    #[inline(never)]
    fn outer_job(&mut self, tick: Tick) {
        let effective = tick + OUTER.offset;
        let input = OuterInput {
            nav: self.plant.nav,
            thrust_n: self.inner.thrust_n(),
            directive: Directive::Follow { since: 0 },
            latest: Latest::default(),
            changes: Changes::new(),
        };
        let (instructions, reference) =
            self.counter.count(counter::mark_begin_guidance, || black_box(&self.guidance).at(black_box(effective)));
        self.counts.guidance.add(instructions);
        let (outer, input, reference) = black_box((&mut self.outer, &input, &reference));
        let (instructions, output) =
            self.counter.count(counter::mark_begin_position, || black_box(outer.follow(effective, input, reference)));
        self.counts.position.add(instructions);
        self.next = output.attitude;
    }

    /// Attitude control and mixer, then the mixer once more on its own.
    #[inline(never)]
    fn inner_step(&mut self, tick: Tick) {
        let sample = SensorFrame::Motion(self.plant.nav);
        self.inner.sense(Some(&sample));
        let (inner, reference) = black_box((&mut self.inner, &self.reference));
        let armed = black_box(true);
        let (instructions, output) =
            self.counter.count(counter::mark_begin_attitude, || inner.step(tick, reference, armed));
        self.counts.attitude.add(instructions);
        if !output.saturated {
            self.counts.attitude_within_limits.add(instructions);
        }

        let (begin, tally) = if output.saturated {
            (counter::mark_begin_mixer_saturated as Mark, &mut self.counts.mixer_saturated)
        } else {
            (counter::mark_begin_mixer as Mark, &mut self.counts.mixer)
        };
        let (mixer, demand) = black_box((&self.mixer, &output.demand));
        let (instructions, _) = self.counter.count(begin, || black_box(mixer.allocate(demand)));
        tally.add(instructions);
    }
}
