//! Motion capture: position and attitude in the local frame, a little late and a little noisy.

use anyhow::Result;
use firmware::sensors::PoseSample;
use nalgebra::UnitQuaternion;
use serde::{Deserialize, Serialize};

use super::check::Check;
use super::process::{Period, ticks};
use super::{Model, Truth};
use crate::noise::gaussian::{Source, Stream};

/// Data sheet of a motion capture system.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pose {
    /// Name of the built-in part that the values are from, but for those that differ; none if they are from a file.
    pub part: Option<String>,
    /// Sampling rate, Hz.
    pub rate_hz: f64,
    /// From the exposure to the delivery, s.
    pub delay_s: f64,
    /// White noise of each coordinate, m.
    pub position_m: f64,
    /// White noise of the attitude about each axis, °.
    pub attitude_deg: f64,
}

impl Pose {
    /// # Errors
    /// The first key that is out of range.
    pub(super) fn validate(&self) -> Result<()> {
        let check = Check("pose");
        check.rate(self.rate_hz)?;
        check.fused_latency(self.delay_s, 0.0)?;
        check.within(0.0, 10.0, &[("position_m", self.position_m), ("attitude_deg", self.attitude_deg)])
    }
}

/// A motion capture system with noise drawn from a seed.
#[derive(Clone, Debug)]
pub(super) struct MotionCapture {
    period: Period,
    delay: u32,
    position_m: f64,
    attitude_rad: f64,
    noise: Stream,
}

impl MotionCapture {
    pub(super) fn new(spec: &Pose, seed: u64) -> Self {
        Self {
            period: Period::of_rate(spec.rate_hz),
            delay: ticks(spec.delay_s),
            position_m: spec.position_m,
            attitude_rad: spec.attitude_deg.to_radians(),
            noise: Stream::new(seed, Source::PoseNoise),
        }
    }
}

impl Model for MotionCapture {
    type Sample = PoseSample;

    fn period(&self) -> Period {
        self.period
    }

    fn delay(&mut self) -> u32 {
        self.delay
    }

    fn measure(&mut self, truth: &Truth) -> PoseSample {
        let position = truth.motion.position + self.noise.normal_vector() * self.position_m;
        let turn = UnitQuaternion::from_scaled_axis(self.noise.normal_vector() * self.attitude_rad);
        PoseSample { at: truth.tick, position: position.cast(), attitude: (truth.attitude() * turn).cast() }
    }
}
