//! Controllers that sliding mode control is compared with, each written as its users write it.
//!
//! They fly behind the firmware's own traits: in the same partitions, at the same rates, in the same f32 arithmetic,
//! with the same mixer and the same limits on the force. What they share stands here; nothing of it is flight code.
//!
//! - [`pid`]: the cascade of PX4, which is what most multicopters fly.
//! - [`geometric`]: tracking on SE(3), Lee, Leok and McClamroch, with the integrals of Goodarzi, Lee and Lee.
//! - [`indi`]: incremental nonlinear dynamic inversion, Smeur, Chu and de Croon, and Tal and Karaman.
//!
//! Gains are in units of acceleration: those of a force are divided by the mass, those of a torque by the moment of
//! inertia. The literature of none of them leads the rotors' lag away, so none of them is given that lead.

mod filter;
pub mod geometric;
pub mod indi;
pub mod pid;

use anyhow::Result;
use firmware::math;
use firmware::schedule::OUTER;
use firmware::signals::TICK_S;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::refusal::within;

/// Step of a position law, s.
const OUTER_STEP_S: f32 = OUTER.period as f32 * TICK_S;

/// Largest gain: products of three still fit an f32.
const GAIN_MAX: f64 = 1e6;

/// A gain that x and y share, and z's: along the axes of the world, or about those of the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AxisPair {
    /// x and y: horizontal, or roll and pitch.
    pub xy: f32,
    /// z: vertical, or yaw.
    pub z: f32,
}

impl AxisPair {
    /// x, y and z.
    pub fn vector(self) -> Vector3<f32> {
        Vector3::new(self.xy, self.xy, self.z)
    }

    /// Refuses what is not a finite number, or below zero.
    fn require_not_negative(self, key: &str) -> Result<()> {
        within(&format!("{key}.xy"), self.xy, 0.0, GAIN_MAX)?;
        within(&format!("{key}.z"), self.z, 0.0, GAIN_MAX)
    }
}

/// Refuses a tilt (rad) that position control cannot be limited to.
fn require_tilt(key: &str, tilt_max_rad: f32) -> Result<()> {
    within(key, tilt_max_rad, 0.01, 1.49)
}

/// Refuses a low-pass that loops of this step (s) cannot have: half the rate of the loop is too fast.
fn require_cutoff(key: &str, cutoff_hz: f32, step_s: f32) -> Result<()> {
    within(key, cutoff_hz, 0.1, (45.0 / f64::from(step_s)).round() / 100.0)
}

/// Each component limited to ± that of `most`.
fn clamp_each(v: &Vector3<f32>, most: &Vector3<f32>) -> Vector3<f32> {
    v.zip_map(most, |v, most| math::clamp(v, -most, most))
}

#[cfg(test)]
mod tests;
