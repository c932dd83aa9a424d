//! The controllers that sliding mode control is compared with, each in the form in which it is commonly used.
//!
//! They implement the firmware's own traits: they run in the same partitions, at the same rates, in the same f32 arithmetic, with the same mixer and the same force limits. This module contains what they share; none of it is flight code.
//!
//! - [`pid`]: the cascade of PX4, which most multicopters fly.
//! - [`geometric`]: tracking on SE(3), Lee, Leok and McClamroch, with the integrals of Goodarzi, Lee and Lee.
//! - [`indi`]: incremental nonlinear dynamic inversion, Smeur, Chu and de Croon, and Tal and Karaman.
//!
//! Gains are in units of acceleration: those of a force are divided by the mass, those of a torque by the moment of
//! inertia. None of them has lead compensation of the rotor lag in the literature, so none has it here.

mod filter;
pub mod geometric;
pub mod indi;
pub mod pid;

use anyhow::Result;
use firmware::math;
use firmware::schedule::OUTER;
use firmware::signals::TICK_S;
use glissade_files::refusal::within;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Step of a position law, s.
const OUTER_STEP_S: f32 = OUTER.period as f32 * TICK_S;

/// Largest gain: products of three still fit an f32.
const GAIN_MAX: f64 = 1e6;

/// One gain for x and y, and one for z: along the world axes, or about the body axes.
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

    /// Checks that both are finite and not negative.
    fn require_not_negative(self, key: &str) -> Result<()> {
        within(&format!("{key}.xy"), self.xy, 0.0, GAIN_MAX)?;
        within(&format!("{key}.z"), self.z, 0.0, GAIN_MAX)
    }
}

/// Checks the greatest tilt of position control (rad).
fn require_tilt(key: &str, tilt_max_rad: f32) -> Result<()> {
    within(key, tilt_max_rad, 0.01, 1.49)
}

/// Checks the cutoff of a low-pass: below half the rate of a loop with this step (s).
fn require_cutoff(key: &str, cutoff_hz: f32, step_s: f32) -> Result<()> {
    within(key, cutoff_hz, 0.1, (45.0 / f64::from(step_s)).round() / 100.0)
}

/// Each component limited to ± that of `most`.
fn clamp_each(v: &Vector3<f32>, most: &Vector3<f32>) -> Vector3<f32> {
    v.zip_map(most, |v, most| math::clamp(v, -most, most))
}

#[cfg(test)]
mod tests;
