//! What the ground partition is told of control and sensors, for telemetry. All in the frames of flight, NWU and FLU.

use nalgebra::{UnitQuaternion, Vector3, Vector4};

use crate::airframe::ROTORS;
use crate::commander::Orbit;
use crate::control::law::LawState;
use crate::sensors::{BaroSample, GnssSample, ImuSample, MagSample};
use crate::signals::MotorCommand;

/// What the control loops aim at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aim {
    /// Desired body to world.
    pub attitude: UnitQuaternion<f32>,
    /// Desired Ω, in the desired body's frame, rad/s.
    pub rates: Vector3<f32>,
    /// Thrust, N.
    pub thrust_n: f32,
    /// Position, m, and ψ, rad.
    pub place: Vector4<f32>,
    /// m/s.
    pub velocity: Vector3<f32>,
    /// m/s².
    pub acceleration: Vector3<f32>,
    /// ψ̇, rad/s.
    pub yaw_rate: f32,
    /// Whether position and velocity across the ground are controlled.
    pub holds_position: bool,
    /// Whether the heading is controlled.
    pub holds_heading: bool,
}

/// A sliding mode law: sliding variables, and what is behind them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LawReport {
    /// s: of the attitude rad/s, of the position m/s.
    pub s: Vector3<f32>,
    /// Reaching terms and disturbance estimate.
    pub state: LawState,
}

/// Report of the control loops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlReport {
    /// What is aimed at; `None` while the rotors stand or idle.
    pub aim: Option<Aim>,
    /// The circle that is flown.
    pub orbit: Option<Orbit>,
    /// The attitude law.
    pub attitude_law: LawReport,
    /// The position law.
    pub position_law: LawReport,
    /// Commanded speeds of the rotors.
    pub motors: MotorCommand,
    /// Estimated speeds of the rotors, rad/s: the commands, passed through the model of the rotor lag.
    pub rotor_speeds_rad_s: [f32; ROTORS],
    /// Thrust that is demanded of the mixer, N.
    pub thrust_n: f32,
    /// Thrust of all rotors at their greatest speed, N.
    pub thrust_max_n: f32,
    /// Greatest rotor speed ωmax, rad/s.
    pub omega_max_rad_s: f32,
}

impl ControlReport {
    /// Before the first tick: nothing is controlled.
    pub const IDLE: Self = {
        let zero = Vector3::new(0.0, 0.0, 0.0);
        let law = LawReport { s: zero, state: LawState { reaching: zero, disturbance: zero } };
        Self {
            aim: None,
            orbit: None,
            attitude_law: law,
            position_law: law,
            motors: MotorCommand::STOPPED,
            rotor_speeds_rad_s: [0.0; ROTORS],
            thrust_n: 0.0,
            thrust_max_n: 1.0,
            omega_max_rad_s: 1.0,
        }
    };
}

/// The last sample of each sensor, as it was measured.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SensorReport {
    /// Gyroscope and accelerometer.
    pub imu: Option<ImuSample>,
    /// Magnetometer.
    pub mag: Option<MagSample>,
    /// Barometer.
    pub baro: Option<BaroSample>,
    /// Satellite receiver.
    pub gnss: Option<GnssSample>,
    /// Level of vibration per axis (see [`Vibration`](crate::estimator::Vibration)), m/s².
    pub vibration_m_s2: Vector3<f32>,
    /// Clipped samples of the accelerometer since boot.
    pub clipped: u32,
}
