//! Settings of the world, as they stand in a file: disturbances, wind, pushes, random starts.

use serde::{Deserialize, Serialize};

/// Gaussian disturbances, each value held for `hold_s`; standard deviations a component.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Disturbance {
    /// Onset, s.
    pub from_s: f64,
    /// End, s.
    pub to_s: f64,
    /// How long each sample is held, s; whole ticks.
    pub hold_s: f64,
    /// On the accelerations of x, y and z, m/s².
    #[serde(default)]
    pub acceleration_m_s2: f64,
    /// On the angular accelerations, rad/s².
    #[serde(default)]
    pub angular_acceleration_rad_s2: f64,
    /// On the measured position, m.
    #[serde(default)]
    pub position_output_m: f64,
    /// On the measured angles, rad.
    #[serde(default)]
    pub angle_output_rad: f64,
}

impl Disturbance {
    /// Whether it pushes the vehicle.
    pub fn is_on_accelerations(&self) -> bool {
        self.acceleration_m_s2 > 0.0 || self.angular_acceleration_rad_s2 > 0.0
    }
}

/// An attitude to follow, for the case that has no position loop: `amplitude·sin(rate·t + phase)` an angle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AttitudeWave {
    /// φ, θ, ψ amplitudes, rad.
    pub amplitude_rad: [f64; 3],
    /// Angular rates of the waves, rad/s.
    pub rate_rad_s: [f64; 3],
    /// Phases at t = 0, rad.
    pub phase_rad: [f64; 3],
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

/// A steady wind with Dryden turbulence and discrete gusts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
    /// Discrete gusts, which add up.
    pub gust: Vec<Gust>,
}

impl Default for Wind {
    fn default() -> Self {
        Self { mean_m_s: [0.0; 3], turbulence_20ft_m_s: 0.0, altitude_m: 10.0, airspeed_m_s: None, gust: Vec::new() }
    }
}

/// A discrete gust: it rises as 1 − cos (MIL-F-8785C, 3.7.1.3), holds, and falls as it rose.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gust {
    /// When it begins, s.
    pub from_s: f64,
    /// How long it rises, and how long it falls, s: the specification's dm over the airspeed.
    pub rise_s: f64,
    /// How long it stays, s.
    #[serde(default)]
    pub hold_s: f64,
    /// Its peak, in the world, m/s.
    pub peak_m_s: [f64; 3],
}

/// A steady push for a while.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScheduledPush {
    /// Onset, s.
    pub from_s: f64,
    /// End, s.
    pub to_s: f64,
    /// In the world, m/s².
    #[serde(default)]
    pub acceleration_m_s2: [f64; 3],
    /// About the body's axes, rad/s².
    #[serde(default)]
    pub angular_acceleration_rad_s2: [f64; 3],
}
