//! Configuration of a flight, validated once before it reaches a loop.

use nalgebra::Vector3;

use crate::airframe::Airframe;
use crate::control::attitude::{AttitudeForm, AttitudeGains};
use crate::control::observer::ObserverGains;
use crate::control::position::PositionGains;
use crate::control::rotor::YawInversion;
use crate::control::sliding::AxisGains;
use crate::estimator::EstimatorSettings;
use crate::guidance::{JoinPlan, Trajectory};
use crate::settings;
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
    /// On the ground, disarmed; the flight's clock starts when the vehicle is commanded to follow its trajectory.
    OnGround,
}

/// Limits and failsafe settings of the flight modes. `vertical` limits are along the world's z axis, the others are on
/// the magnitude of the horizontal component.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default, deny_unknown_fields))]
pub struct ModeSettings {
    /// Horizontal speed on the way to a place, m/s.
    pub cruise_m_s: f32,
    /// Greatest horizontal speed that can be asked for, m/s.
    pub fastest_m_s: f32,
    /// Greatest speed upwards, m/s.
    pub climb_m_s: f32,
    /// Greatest speed downwards, m/s.
    pub sink_m_s: f32,
    /// Speed of a take-off, m/s.
    pub take_off_m_s: f32,
    /// Speed of a landing, m/s.
    pub landing_m_s: f32,
    /// Speed of a landing near the ground and at unknown heights, m/s.
    pub touchdown_m_s: f32,
    /// Speed of a descent after a failure, m/s.
    pub descent_m_s: f32,
    /// Greatest horizontal acceleration, m/s².
    pub acceleration_m_s2: f32,
    /// Greatest vertical acceleration, m/s².
    pub vertical_acceleration_m_s2: f32,
    /// Greatest jerk of either, m/s³.
    pub jerk_m_s3: f32,
    /// Greatest rate of the heading, rad/s.
    pub yaw_rate_rad_s: f32,
    /// Greatest acceleration of the heading, rad/s².
    pub yaw_acceleration_rad_s2: f32,
    /// Height over home at which the vehicle returns, if it is not higher already, m.
    pub return_height_m: f32,
    /// Battery voltage below which the vehicle returns, V; 0 for never.
    pub battery_low_v: f32,
    /// Battery voltage below which it lands where it is, V; 0 for never.
    pub battery_critical_v: f32,
    /// Speed of the rotors while armed on the ground, as a fraction of ωmax.
    pub idle_part: f32,
    /// Thrust of a descent without a known vertical velocity, as a fraction of the weight.
    pub blind_thrust_part: f32,
}

/// Suitable for a quadrotor of any size outdoors. Battery voltages depend on the vehicle.
impl Default for ModeSettings {
    fn default() -> Self {
        Self {
            cruise_m_s: 5.0,
            fastest_m_s: 12.0,
            climb_m_s: 2.0,
            sink_m_s: 1.5,
            take_off_m_s: 1.5,
            landing_m_s: 0.7,
            touchdown_m_s: 0.4,
            descent_m_s: 1.0,
            acceleration_m_s2: 3.0,
            vertical_acceleration_m_s2: 2.0,
            jerk_m_s3: 10.0,
            yaw_rate_rad_s: 1.0,
            yaw_acceleration_rad_s2: 2.0,
            return_height_m: 10.0,
            battery_low_v: 0.0,
            battery_critical_v: 0.0,
            idle_part: 0.1,
            blind_thrust_part: 0.93,
        }
    }
}

/// What sticks do. Rates and angles at full deflection.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default, deny_unknown_fields))]
pub struct ManualSettings {
    /// Greatest tilt in stabilized and altitude mode, rad.
    pub tilt_max_rad: f32,
    /// Greatest rate of the heading, rad/s.
    pub yaw_rate_rad_s: f32,
    /// Greatest horizontal speed in position mode, m/s.
    pub speed_m_s: f32,
    /// How cubic the roll and pitch sticks are in position mode, from 0 to 1.
    pub expo_xy: f32,
    /// The same of the throttle stick in altitude and position mode.
    pub expo_z: f32,
    /// The same of the yaw stick.
    pub expo_yaw: f32,
    /// Dead zone about the centre of a stick that holds there.
    pub dead_zone: f32,
    /// Thrust that a set-point of an attitude hovers with, as a fraction of its range.
    pub hover_throttle: f32,
    /// Least thrust by stick in the air, as a fraction of the greatest.
    pub throttle_min: f32,
    /// Greatest body rates in acro mode, roll, pitch, yaw, rad/s.
    pub acro_rates_rad_s: [f32; 3],
    /// How cubic the roll and pitch sticks are in acro mode, from 0 to 1.
    pub acro_expo: f32,
    /// The same of the yaw stick.
    pub acro_expo_yaw: f32,
    /// How much steeper the roll and pitch sticks become towards their ends in acro mode, below 1.
    pub acro_super_expo: f32,
    /// The same of the yaw stick.
    pub acro_super_expo_yaw: f32,
}

/// PX4's defaults.
impl Default for ManualSettings {
    fn default() -> Self {
        Self {
            tilt_max_rad: 35.0_f32.to_radians(),
            yaw_rate_rad_s: 150.0_f32.to_radians(),
            speed_m_s: 10.0,
            expo_xy: 0.6,
            expo_z: 0.6,
            expo_yaw: 0.6,
            dead_zone: 0.1,
            hover_throttle: 0.5,
            throttle_min: 0.08,
            acro_rates_rad_s: [100.0_f32.to_radians(); 3],
            acro_expo: 0.69,
            acro_expo_yaw: 0.69,
            acro_super_expo: 0.7,
            acro_super_expo_yaw: 0.7,
        }
    }
}

impl ModeSettings {
    /// Refuses settings that no vehicle can fly by; the ranges are those of the settings' table.
    ///
    /// # Errors
    /// The first field that is out of its range.
    pub fn validate(&self) -> Result<(), ConfigError> {
        settings::check_modes(self)
    }
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
    /// Greatest tilt that position control demands, rad.
    pub tilt_max_rad: f32,
    /// Time constant to which lead compensation shortens the rotor lag, s; 0 for none.
    pub rotor_time_constant_s: f32,
    /// The trajectory.
    pub trajectory: Trajectory,
    /// The path that joins it; `None` to start on the trajectory.
    pub join: Option<JoinPlan>,
    /// How the flight begins.
    pub start: Start,
    /// Where the flight begins, m.
    pub start_position_m: [f32; 3],
    /// Noise parameters of the estimator; `None` for a flight on ideal state.
    #[cfg_attr(feature = "serde", serde(default))]
    pub estimator: Option<EstimatorSettings>,
    /// Limits and failsafe settings of the flight modes.
    #[cfg_attr(feature = "serde", serde(default))]
    pub modes: ModeSettings,
    /// What sticks do.
    #[cfg_attr(feature = "serde", serde(default))]
    pub manual: ManualSettings,
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
        settings::check_flight(self)?;
        if !crate::math::all_finite(&self.start_position_m) {
            return Err(ConfigError::NonFinite("start_position_m".into()));
        }
        if let Some(estimator) = &self.estimator {
            estimator.validate()?;
        }
        self.modes.validate()?;
        settings::check_manual(&self.manual)?;
        self.trajectory.validate()
    }

    fn leads(&self) -> bool {
        self.rotor_time_constant_s > 0.0 && self.rotor_time_constant_s < self.airframe.rotor_lag_s
    }

    /// Effective time constant of the rotors, s: their lag, or the one that lead compensation gives.
    pub fn rotor_answer_s(&self) -> f32 {
        if self.leads() { self.rotor_time_constant_s } else { self.airframe.rotor_lag_s }
    }

    /// The yaw allocation; without lead compensation of the rotors it has none either.
    pub fn yaw_inversion(&self) -> YawInversion {
        let lead_s = if self.leads() { self.airframe.spin_up_lead_s() } else { 0.0 };
        YawInversion::new(lead_s, self.rotor_answer_s())
    }

    /// Start position as a vector.
    pub fn start_position(&self) -> Vector3<f32> {
        self.start_position_m.into()
    }
}

/// A safe default for a board that has not been configured: on the ground, with a trajectory that holds 2 m above it.
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
            modes: ModeSettings::default(),
            manual: ManualSettings::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_out_of_range_are_refused_by_name() {
        let good = ModeSettings::default();
        assert_eq!(good.validate(), Ok(()));
        let out_of_range = |name: &'static str, low| ConfigError::OutOfRange { field: name.into(), low, high: 100.0 };
        for (bad, error) in [
            (ModeSettings { jerk_m_s3: f32::NAN, ..good }, ConfigError::NonFinite("modes.jerk_m_s3".into())),
            (ModeSettings { climb_m_s: 0.0, ..good }, out_of_range("modes.climb_m_s", 0.05)),
            (ModeSettings { landing_m_s: 0.1, ..good }, out_of_range("modes.landing_m_s", 0.35)),
            (ModeSettings { battery_low_v: -1.0, ..good }, ConfigError::Negative("modes.battery_low_v".into())),
            (
                ModeSettings { blind_thrust_part: 1.0, ..good },
                ConfigError::NotBelow("modes.blind_thrust_part".into(), 1.0),
            ),
        ] {
            assert_eq!(FlightConfig { modes: bad, ..FlightConfig::default() }.validate(), Err(error));
        }
    }
}
