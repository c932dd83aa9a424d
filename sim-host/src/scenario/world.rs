//! The world of a scenario: how the plant differs from what the firmware believes, how the flight begins, the wind.

use nalgebra::{Matrix4, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::ScenarioFile;
use crate::noise::tumble;
use crate::plant::{Constants, Motion};
use firmware::airframe::ROTORS;

/// How the plant differs from the airframe file, which the firmware keeps believing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Truth {
    /// The plant's mass in units of the airframe's.
    pub mass_factor: f64,
    /// Each of the plant's moments of inertia in units of the airframe's.
    pub inertia_factor: f64,
    /// What is left of each rotor's thrust, and of its yaw torque: 1 for a sound rotor, 0 for one that is gone.
    pub rotor_effectiveness: [f64; ROTORS],
    /// In place of the airframe's, s.
    pub rotor_lag_s: Option<f64>,
}

impl Default for Truth {
    fn default() -> Self {
        Self { mass_factor: 1.0, inertia_factor: 1.0, rotor_effectiveness: [1.0; ROTORS], rotor_lag_s: None }
    }
}

impl Truth {
    /// The plant's constants, from those of the airframe file.
    pub fn of(&self, believed: &Constants) -> Constants {
        let effective = |column: usize| believed.geometry.column(column) * self.rotor_effectiveness[column];
        Constants {
            mass: believed.mass * self.mass_factor,
            inertia: believed.inertia * self.inertia_factor,
            geometry: Matrix4::from_columns(&core::array::from_fn::<_, ROTORS, _>(effective)),
            rotor_lag: self.rotor_lag_s.unwrap_or(believed.rotor_lag),
            ..believed.clone()
        }
    }
}

/// A start in a random attitude, turning and moving in random directions, drawn from the flight's seed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tumble {
    /// Size of the body rates, rad/s.
    pub rate_rad_s: f64,
    /// Size of the velocity, m/s.
    pub speed_m_s: f64,
}

/// A steady wind with Dryden turbulence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Wind {
    /// The steady part, in the world, m/s.
    pub mean_m_s: [f64; 3],
    /// W20, the wind's speed at 20 ft, which sets the strength of the turbulence, m/s: 7.7 light, 15.4 moderate,
    /// 23.15 severe (15, 30 and 45 knots).
    pub turbulence_20ft_m_s: f64,
    /// Height for which the turbulence is computed, m.
    pub altitude_m: f64,
    /// Speed at which the vehicle meets the turbulence, m/s; W20 without it.
    pub airspeed_m_s: Option<f64>,
}

impl Default for Wind {
    fn default() -> Self {
        Self { mean_m_s: [0.0; 3], turbulence_20ft_m_s: 0.0, altitude_m: 10.0, airspeed_m_s: None }
    }
}

impl ScenarioFile {
    /// Whether a motion at the start is written down.
    pub(super) fn has_start_motion(&self) -> bool {
        self.start_velocity_m_s.is_some() || self.start_attitude_deg.is_some() || self.start_rates_rad_s.is_some()
    }

    /// The motion with which a flight under `seed` begins.
    pub fn start_motion(&self, seed: u64) -> Motion {
        let position = Vector3::from(self.start_position_m);
        if let Some(tumble) = &self.tumble {
            return tumble::draw(tumble, position, seed);
        }
        let [roll, pitch, yaw] = self.start_attitude_deg.unwrap_or_default().map(f64::to_radians);
        Motion {
            position,
            velocity: self.start_velocity_m_s.unwrap_or_default().into(),
            attitude: UnitQuaternion::from_euler_angles(roll, pitch, yaw).into_inner(),
            rates: self.start_rates_rad_s.unwrap_or_default().into(),
        }
    }
}
