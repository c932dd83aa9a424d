//! The inner partition, every tick: attitude control and mixer.
//!
//! Owns the last good motion and the last motor command. Plain data in, plain data out; what it is told to
//! follow comes from the outer partition, whether it may turn the rotors from the commander.

use nalgebra::Vector3;

use crate::airframe::{Airframe, ROTORS};
use crate::config::FlightConfig;
use crate::control::attitude::{self, Euler, EulerReference};
use crate::control::mixer::Mixer;
use crate::control::sliding::AxisGains;
use crate::math;
use crate::signals::{AttitudeReference, ControlInput, MotorCommand, NavState, SensorFrame, TICK_S, Tick};
use crate::validate::ConfigError;

/// After this many ticks without a valid sample the motion is no longer trusted.
pub const STALE_AFTER: u32 = 50;

/// A reference is followed this many ticks beyond the one it holds for: an outer loop that has stopped answering must
/// not have its last accelerations flown for ever.
const EXTRAPOLATED_AT_MOST: Tick = 20;

/// What the inner partition has done in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InnerOutput {
    /// Speeds for the rotors.
    pub motors: MotorCommand,
    /// U1..U4 as demanded of the mixer.
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

/// The inner partition.
#[derive(Clone, Debug)]
pub struct Inner {
    airframe: Airframe,
    gains: [AxisGains; 3],
    mixer: Mixer<ROTORS>,
    nav: NavState,
    stale_ticks: u32,
    refused_samples: u32,
    output: InnerOutput,
}

impl Inner {
    /// Ready to run with a valid configuration.
    ///
    /// # Errors
    /// [`ConfigError::SingularGeometry`] if the rotors cannot be mixed.
    pub fn new(config: &FlightConfig) -> Result<Self, ConfigError> {
        let rows = config.airframe.geometry.rows();
        let mixer = Mixer::new(&rows, config.airframe.omega_max_rad_s).map_err(|_| ConfigError::SingularGeometry)?;
        let mut nav = NavState::at_rest();
        nav.position = config.start_position();
        Ok(Self {
            airframe: config.airframe,
            gains: config.attitude,
            mixer,
            nav,
            stale_ticks: 0,
            refused_samples: 0,
            output: InnerOutput::IDLE,
        })
    }

    /// Takes in this tick's sample. A missing one, or one that holds a number that is not finite, leaves the
    /// motion as it was.
    #[inline]
    pub fn sense(&mut self, sample: Option<&SensorFrame>) {
        match sample {
            Some(frame) if frame.nav.is_valid() => {
                self.nav = frame.nav;
                self.stale_ticks = 0;
            }
            other => {
                self.stale_ticks = self.stale_ticks.saturating_add(1);
                self.refused_samples = self.refused_samples.saturating_add(u32::from(other.is_some()));
            }
        }
    }

    /// One tick of control towards `reference`; rotors stopped unless `armed`. `sample` is the one that was just
    /// [sensed](Self::sense): if it was taken in, it is used as it came, which spares the wait for its copy.
    #[inline]
    pub fn step(
        &mut self,
        tick: Tick,
        sample: Option<&SensorFrame>,
        reference: &AttitudeReference,
        armed: bool,
    ) -> &InnerOutput {
        let nav = match sample {
            Some(frame) if self.stale_ticks == 0 => &frame.nav,
            _ => &self.nav,
        };
        self.output = if armed { self.control(tick, nav, reference) } else { InnerOutput::IDLE };
        &self.output
    }

    #[inline]
    fn control(&self, tick: Tick, nav: &NavState, reference: &AttitudeReference) -> InnerOutput {
        let age = tick.wrapping_sub(reference.valid_at).min(EXTRAPOLATED_AT_MOST);
        let dt = age as f32 * TICK_S;
        let target = EulerReference {
            angles: reference.angles + reference.rates * dt + reference.accelerations * (0.5 * dt * dt),
            rates: reference.rates + reference.accelerations * dt,
            accelerations: reference.accelerations,
        };
        let euler = Euler::from_quaternion(&nav.attitude);
        let rates = euler.rates(&nav.rates);
        let wanted = attitude::demand(&self.gains, &target, &euler.angles(), &rates);
        let acceleration = euler.body_acceleration(&rates, &wanted.acceleration);
        let spin = self.airframe.rotor_spin_rad_s(&self.output.motors.omega_rad_s);
        let torque = attitude::torque(&self.airframe, &acceleration, &nav.rates, spin);
        let demand = ControlInput {
            thrust_n: math::max(reference.thrust_n + reference.thrust_rate_n_s * dt, 0.0),
            roll_n_m: torque.x,
            pitch_n_m: torque.y,
            yaw_n_m: torque.z,
        };
        match self.mixer.allocate(&demand) {
            Ok(allocation) => InnerOutput {
                motors: MotorCommand { omega_rad_s: allocation.omega_sq.map(math::sqrt) },
                demand,
                s: wanted.s,
                saturated: allocation.saturated,
            },
            // A sample so wild that a product overflowed; the last command is safer than none.
            Err(_) => InnerOutput { saturated: true, ..self.output },
        }
    }

    /// The motion as last sensed.
    pub fn nav(&self) -> &NavState {
        &self.nav
    }

    /// What the last tick gave.
    pub fn output(&self) -> &InnerOutput {
        &self.output
    }

    /// Thrust of the last motor command, N.
    pub fn thrust_n(&self) -> f32 {
        let omega = &self.output.motors.omega_rad_s;
        omega.iter().zip(&self.airframe.geometry.thrust).map(|(omega, lift)| lift * omega * omega).sum()
    }

    /// False once no valid sample has come for [`STALE_AFTER`] ticks.
    pub fn is_nav_fresh(&self) -> bool {
        self.stale_ticks < STALE_AFTER
    }

    /// Samples refused since boot because they held a number that is not finite.
    pub fn refused_samples(&self) -> u32 {
        self.refused_samples
    }
}
