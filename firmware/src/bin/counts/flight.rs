//! The flight over which instructions are counted: the default controller on a 2 kg quadrotor.

use core::hint::black_box;

use firmware::airframe::ROTORS;
use firmware::board::mps2::counter::{self, Counter, Mark};
use firmware::commander::{Directive, Ground};
use firmware::config::FlightConfig;
use firmware::control::attitude::SlidingAttitude;
use firmware::control::mixer::Mixer;
use firmware::control::position::SlidingPosition;
use firmware::guidance::Guidance;
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
use crate::vehicle::config;

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
            ground: Ground::Far,
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
