//! What a flight is configured with, validated once before it reaches a loop.

use nalgebra::Vector3;

use crate::airframe::Airframe;
use crate::control::attitude::{AttitudeForm, AttitudeGains};
use crate::control::observer::ObserverGains;
use crate::control::position::PositionGains;
use crate::control::rotor::YawInversion;
use crate::control::sliding::AxisGains;
use crate::estimator::EstimatorSettings;
use crate::guidance::{JoinPlan, Trajectory};
use crate::validate::ConfigError;

/// How a flight begins.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "kebab-case", deny_unknown_fields)
)]
pub enum Start {
    /// In the air, armed, at rest; the flight's clock starts with the first tick.
    InFlight,
    /// On the ground, disarmed; the flight's clock starts when the vehicle is armed.
    OnGround,
}

/// Everything the firmware needs to know before a flight.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct FlightConfig {
    /// The vehicle, as the controller believes it to be.
    pub airframe: Airframe,
    /// Gains for roll, pitch and yaw.
    pub attitude: AttitudeGains,
    /// Gains for x, y and z.
    pub position: PositionGains,
    /// Greatest tilt that position control asks for, rad.
    pub tilt_max_rad: f32,
    /// Time constant to which the rotors' lag is brought down by lead, s; 0 for none.
    pub rotor_time_constant_s: f32,
    /// What to fly.
    pub trajectory: Trajectory,
    /// How to get there.
    pub join: Option<JoinPlan>,
    /// How the flight begins.
    pub start: Start,
    /// Where the flight begins, m.
    pub start_position_m: [f32; 3],
    /// What the filter is told of the sensors; none for a flight on ideal state.
    #[cfg_attr(feature = "serde", serde(default))]
    pub estimator: Option<EstimatorSettings>,
}

impl FlightConfig {
    /// Refuses a configuration that no loop should see.
    ///
    /// # Errors
    /// The first field that is out of its range.
    pub fn validate(&self) -> Result<(), ConfigError> {
        self.airframe.validate()?;
        self.attitude.validate()?;
        self.position.validate()?;
        ConfigError::require_positive("control.tilt_max_rad", self.tilt_max_rad)?;
        if self.tilt_max_rad >= 1.5 {
            return Err(ConfigError::OutOfRange("control.tilt_max_rad"));
        }
        ConfigError::require_not_negative("control.rotor_time_constant_s", self.rotor_time_constant_s)?;
        if !crate::math::all_finite(&self.start_position_m) {
            return Err(ConfigError::NonFinite("start_position_m"));
        }
        if let Some(estimator) = &self.estimator {
            estimator.validate()?;
        }
        self.trajectory.validate()
    }

    fn leads(&self) -> bool {
        self.rotor_time_constant_s > 0.0 && self.rotor_time_constant_s < self.airframe.rotor_lag_s
    }

    /// Time constant with which the rotors answer, s: their lag, or what lead brings it down to.
    pub fn rotor_answer_s(&self) -> f32 {
        if self.leads() { self.rotor_time_constant_s } else { self.airframe.rotor_lag_s }
    }

    /// How the torque about yaw is asked for; rotors that nothing is led for are not led in yaw either.
    pub fn yaw_inversion(&self) -> YawInversion {
        let lead_s = if self.leads() { self.airframe.spin_up_lead_s() } else { 0.0 };
        YawInversion::new(lead_s, self.rotor_answer_s())
    }

    /// Start position as a vector.
    pub fn start_position(&self) -> Vector3<f32> {
        self.start_position_m.into()
    }
}

/// A safe default for a board that has not been configured: on the ground, holding 2 m above it once armed.
impl Default for FlightConfig {
    fn default() -> Self {
        Self {
            airframe: Airframe::paper(2.0),
            attitude: AttitudeGains {
                axes: [
                    AxisGains::sat(60.0, 20.0, 0.5),
                    AxisGains::sat(60.0, 20.0, 0.5),
                    AxisGains::sat(30.0, 10.0, 0.5),
                ],
                form: AttitudeForm::Group,
                observer: ObserverGains::default(),
            },
            position: PositionGains {
                axes: [AxisGains::sat(6.0, 2.0, 2.0), AxisGains::sat(6.0, 2.0, 2.0), AxisGains::sat(6.0, 3.0, 1.5)],
                observer: ObserverGains::default(),
                effectiveness_rate: 0.0,
            },
            tilt_max_rad: 0.6,
            rotor_time_constant_s: 0.0,
            trajectory: Trajectory::Hold { position_m: [0.0, 0.0, 2.0], yaw_rad: 0.0 },
            join: Some(JoinPlan { duration_s: 3.0, start_acceleration_m_s2: [0.0; 3], middle_m: heapless::Vec::new() }),
            start: Start::OnGround,
            start_position_m: [0.0; 3],
            estimator: None,
        }
    }
}
