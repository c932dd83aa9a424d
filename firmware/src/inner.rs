//! The inner partition, every tick: attitude control and mixer.
//!
//! Owns the last valid motion and the last motor command. The attitude reference comes from the outer partition, the
//! permission to turn the rotors from the commander.

use nalgebra::Vector3;

use crate::airframe::{Airframe, ROTORS};
use crate::config::{FlightConfig, Start};
use crate::control::attitude::SlidingAttitude;
use crate::control::law::{AttitudeDemand, AttitudeInput, AttitudeLaw, LawState, RotorEffect};
use crate::control::mixer::Mixer;
use crate::control::motor_out::MotorOut;
use crate::control::rotor::{RotorModel, RotorTorque, YawInversion};
use crate::control::rotor_monitor::RotorMonitor;
use crate::math;
use crate::navigator::Navigator;
use crate::sensors::Measurements;
use crate::settings::Change;
use crate::signals::{AttitudeReference, ControlInput, MotorCommand, NavState, SensorFrame, TICK_S, Tick};
use crate::validate::ConfigError;

/// After this many ticks without a valid sample the motion is no longer trusted.
pub const STALE_AFTER: u32 = 50;

/// Greatest torque in a descent, as a fraction of thrust times arm (all thrust on one side).
const GENTLE_FRACTION: f32 = 0.5;

/// Greatest extrapolation of a reference, ticks: if the outer loop stops, its last accelerations must not be integrated
/// for ever. Five periods of the outer loop.
const EXTRAPOLATED_AT_MOST: Tick = 20;

/// Output of the inner partition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InnerOutput {
    /// Speeds for the rotors.
    pub motors: MotorCommand,
    /// U1..U4, the demand on the mixer.
    pub demand: ControlInput,
    /// Sliding variables s1, s2, s3, rad/s.
    pub s: Vector3<f32>,
    /// True if the mixer could not give the whole demand.
    pub saturated: bool,
}

impl InnerOutput {
    /// Rotors stopped, nothing demanded.
    pub const IDLE: Self = Self {
        motors: MotorCommand::STOPPED,
        demand: ControlInput { thrust_n: 0.0, roll_n_m: 0.0, pitch_n_m: 0.0, yaw_n_m: 0.0 },
        s: Vector3::new(0.0, 0.0, 0.0),
        saturated: false,
    };
}

/// The inner partition, with an attitude law. The fields stand in memory as here, with what every tick uses first and the
/// largest last: the target reaches only the first kilobyte of a structure by a load of its own.
#[derive(Clone, Debug)]
#[repr(C)]
pub struct Inner<A = SlidingAttitude> {
    nav: NavState,
    output: InnerOutput,
    airframe: Airframe,
    mixer: Mixer<ROTORS>,
    rotors: RotorModel,
    believed: RotorTorque,
    /// Torque and spin at the estimated rotor speeds.
    effect: RotorEffect,
    yaw: YawInversion,
    idle_rad_s: f32,
    /// Greatest torque per unit of thrust in a descent, m.
    gentle_arm_m: f32,
    stale_ticks: u32,
    refused_samples: u32,
    /// Whether the vehicle was armed in the tick before.
    was_armed: bool,
    law: A,
    monitor: RotorMonitor,
    /// Replaces the law once a rotor has failed.
    motor_out: Option<MotorOut>,
    /// `None` on ideal state.
    navigator: Option<Navigator>,
}

impl<A: AttitudeLaw> Inner<A> {
    /// Ready to run with a valid configuration.
    ///
    /// # Errors
    /// [`ConfigError::SingularGeometry`] if the rotors cannot be mixed.
    pub fn new(config: &FlightConfig, law: A) -> Result<Self, ConfigError> {
        let airframe = config.airframe;
        let omega_max = airframe.omega_max_rad_s;
        let mixer = Mixer::new(&airframe.geometry.rows(), omega_max).map_err(|_| ConfigError::SingularGeometry)?;
        let mut rotors = RotorModel::new(airframe.rotor_lag_s, config.rotor_answer_s(), omega_max);
        if config.start == Start::InFlight {
            rotors.set([airframe.omega_for_thrust_to_weight(1.0); ROTORS]);
        }
        let believed = RotorTorque::new(&airframe);
        let mut nav = NavState::at_rest();
        nav.position = config.start_position();
        Ok(Self {
            airframe,
            law,
            mixer,
            effect: believed.steady(rotors.omega_rad_s()),
            believed,
            rotors,
            yaw: config.yaw_inversion(),
            navigator: Navigator::new(config),
            idle_rad_s: config.modes.idle_part * omega_max,
            gentle_arm_m: GENTLE_FRACTION * airframe.arm_m(),
            monitor: RotorMonitor::new(&airframe),
            motor_out: None,
            was_armed: false,
            nav,
            stale_ticks: 0,
            refused_samples: 0,
            output: InnerOutput::IDLE,
        })
    }

    /// Takes this tick's sample. If it is missing, or has a NaN or infinite field, the motion stays as it was; on
    /// sensors the predictor extrapolates it.
    #[inline]
    pub fn sense(&mut self, sample: Option<&SensorFrame>) {
        match sample {
            Some(SensorFrame::Motion(nav)) if nav.is_valid() && self.navigator.is_none() => {
                self.nav = *nav;
                self.stale_ticks = 0;
            }
            Some(SensorFrame::Measured(measured)) if self.navigator.is_some() => self.navigate(Some(measured)),
            None if self.navigator.is_some() => self.navigate(None),
            other => self.miss(other.is_some()),
        }
    }

    /// A tick of navigation on sensors.
    fn navigate(&mut self, measured: Option<&Measurements>) {
        let Some(navigator) = &mut self.navigator else { return };
        let fresh = navigator.step(measured, self.rotors.omega_rad_s());
        self.nav = navigator.nav();
        if fresh {
            self.stale_ticks = 0;
        } else {
            self.miss(measured.is_some_and(|m| m.imu.is_some()));
        }
    }

    /// A tick without a sample, or with one that was refused.
    fn miss(&mut self, refused: bool) {
        self.stale_ticks = self.stale_ticks.saturating_add(1);
        // The law is about to see a frozen motion: its integrators should hold.
        self.output.saturated = true;
        self.refused_samples = self.refused_samples.saturating_add(u32::from(refused));
    }

    /// One tick of control: tracks `reference` from the motion [sensed](Self::sense) last. Rotors stopped unless
    /// `armed`.
    #[inline]
    pub fn step(&mut self, tick: Tick, reference: &AttitudeReference, armed: bool) -> &InnerOutput {
        if armed {
            let age = tick.wrapping_sub(reference.valid_at).min(EXTRAPOLATED_AT_MOST);
            self.control::<false>(reference, age as f32 * TICK_S);
        } else {
            self.law.reset();
            self.follow(&MotorCommand::STOPPED);
            self.output = InnerOutput::IDLE;
        }
        &self.output
    }

    /// One tick of a descent that may touch down at any time, in place of [`step`](Self::step): the torque is limited
    /// in proportion to the thrust. A vehicle that stands on its landing gear with little thrust does not follow its
    /// rotors, and a law that responds with more torque would tip it over.
    pub fn step_gently(&mut self, tick: Tick, reference: &AttitudeReference) -> &InnerOutput {
        let age = tick.wrapping_sub(reference.valid_at).min(EXTRAPOLATED_AT_MOST);
        self.control::<true>(reference, age as f32 * TICK_S);
        &self.output
    }

    /// One tick with idling rotors, in place of [`step`](Self::step).
    pub fn idle(&mut self) -> &InnerOutput {
        self.law.reset();
        let motors = MotorCommand { omega_rad_s: [self.idle_rad_s; ROTORS] };
        self.follow(&motors);
        self.output = InnerOutput { motors, ..InnerOutput::IDLE };
        &self.output
    }

    /// Turns one rotor of a disarmed vehicle, with a speed as a fraction of the greatest.
    #[cold]
    pub fn spin(&mut self, rotor: u8, part: f32) {
        if let Some(omega) = self.output.motors.omega_rad_s.get_mut(usize::from(rotor)) {
            *omega = part * self.airframe.omega_max_rad_s;
        }
    }

    /// One tick of control, `dt` seconds after the tick for which the reference is valid.
    #[inline]
    fn control<const GENTLE: bool>(&mut self, reference: &AttitudeReference, dt: f32) {
        // Each branch returns its own values: sharing one variable would put it into memory every tick.
        let (s, torque) = if self.motor_out.is_none() {
            let wanted = self.law.step(&AttitudeInput {
                attitude: &self.nav.attitude,
                rates: &self.nav.rates,
                target: &reference.target_after(dt),
                rotor_speeds: self.rotors.omega_rad_s(),
                rotors: &self.effect,
                saturated: self.output.saturated,
            });
            (wanted.s, wanted.torque)
        } else {
            let wanted = self.demand_without_rotor(reference, dt);
            (wanted.s, wanted.torque)
        };
        let mut demand = ControlInput {
            // The mixer limits a thrust below zero.
            thrust_n: reference.thrust_n + reference.thrust_rate_n_s * dt,
            roll_n_m: torque.x,
            pitch_n_m: torque.y,
            yaw_n_m: self.yaw.demand(self.effect.yaw_n_m, torque.z),
        };
        if GENTLE {
            let most = self.gentle_arm_m * math::max(demand.thrust_n, 0.0);
            demand.roll_n_m = math::limit(demand.roll_n_m, most);
            demand.pitch_n_m = math::limit(demand.pitch_n_m, most);
        }
        let Ok(allocation) = self.mixer.allocate(&demand) else {
            // A product overflowed on an extreme sample. The last command is safer than none, and the law is reset
            // because its state may hold the overflow.
            self.law.reset();
            self.follow(&{ self.output.motors });
            self.output.saturated = true;
            return;
        };
        self.output = InnerOutput {
            motors: MotorCommand { omega_rad_s: self.rotors.command(math::sqrt_each(allocation.omega_sq)) },
            demand,
            s,
            saturated: allocation.saturated,
        };
        self.effect = self.believed.after(&self.effect, self.rotors.omega_rad_s());
    }

    /// The demand of the law for a failed rotor; a separate function, so that the usual path stays in registers.
    #[cold]
    #[inline(never)]
    fn demand_without_rotor(&mut self, reference: &AttitudeReference, dt: f32) -> AttitudeDemand {
        let Some(law) = &mut self.motor_out else { return AttitudeDemand::default() };
        law.demand(&AttitudeInput {
            attitude: &self.nav.attitude,
            rates: &self.nav.rates,
            target: &reference.target_after(dt),
            rotor_speeds: self.rotors.omega_rad_s(),
            rotors: &self.effect,
            saturated: self.output.saturated,
        })
    }

    /// One tick of rotor failure detection. A failed rotor is commanded to zero, and the vehicle cannot be armed again
    /// unless that is forced; arming takes all rotors to work again.
    pub fn watch_rotors(&mut self, armed: bool, in_air: bool) {
        let Some(navigator) = &self.navigator else { return };
        if armed && !self.was_armed {
            self.monitor.reset(&self.nav.rates);
            if self.motor_out.take().is_some() {
                // Limits of 1 are valid.
                let _ = self.mixer.set_limits([1.0; ROTORS]);
            }
        }
        self.was_armed = armed;
        if !armed {
            return;
        }
        if !in_air || self.motor_out.is_some() {
            return;
        }
        if self.stale_ticks > 0 {
            /// A gap of this many ticks restarts the comparison: a quarter of its time constant.
            const LONG: u32 = 5;
            if self.stale_ticks >= LONG {
                self.monitor.miss(&self.nav.rates);
            }
            return;
        }
        let force_z = navigator.specific_force().z;
        self.monitor.update(&self.nav.rates, force_z, &self.effect, self.rotors.omega_rad_s());
        if let Some(rotor) = self.monitor.failed() {
            let law = MotorOut::new(&self.airframe, usize::from(rotor));
            let _ = self.mixer.set_limits(law.limits());
            self.motor_out = Some(law);
        }
    }

    /// The rotor that has failed since the vehicle was armed, from 0.
    pub fn failed_rotor(&self) -> Option<u8> {
        self.monitor.failed()
    }

    /// Advances the rotor model by a tick with a command that comes from no law.
    fn follow(&mut self, command: &MotorCommand) {
        self.rotors.follow(&command.omega_rad_s);
        self.effect = self.believed.after(&self.effect, self.rotors.omega_rad_s());
    }

    /// Takes over a setting.
    pub fn apply(&mut self, change: &Change) {
        self.law.retune(change);
    }

    /// Navigation on sensors; `None` on ideal state.
    pub fn navigator(&self) -> Option<&Navigator> {
        self.navigator.as_ref()
    }

    /// The same, mutable, to inject the filter's output.
    pub(crate) fn navigator_mut(&mut self) -> Option<&mut Navigator> {
        self.navigator.as_mut()
    }

    /// The motion as last sensed.
    pub fn nav(&self) -> &NavState {
        &self.nav
    }

    /// The output of the last tick.
    pub fn output(&self) -> &InnerOutput {
        &self.output
    }

    /// Estimated speeds of the rotors, rad/s: the commands, passed through the model of the rotor lag.
    pub fn rotor_speeds_rad_s(&self) -> &[f32; ROTORS] {
        self.rotors.omega_rad_s()
    }

    /// The vehicle, as the controller believes it to be.
    pub fn airframe(&self) -> &Airframe {
        &self.airframe
    }

    /// What the attitude law keeps inside.
    pub fn law_state(&self) -> LawState {
        self.law.state()
    }

    /// Estimated thrust of the rotors, N.
    pub fn thrust_n(&self) -> f32 {
        let omega = self.rotors.omega_rad_s();
        omega.iter().zip(&self.airframe.geometry.thrust).map(|(omega, lift)| lift * omega * omega).sum()
    }

    /// False after [`STALE_AFTER`] ticks without a valid sample.
    pub fn is_nav_fresh(&self) -> bool {
        self.stale_ticks < STALE_AFTER
    }

    /// Samples refused since boot: with a NaN or infinite field, implausible, stuck or out of order.
    pub fn refused_samples(&self) -> u32 {
        self.refused_samples
    }
}
