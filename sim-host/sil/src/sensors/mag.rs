//! Magnetometer: the Earth's field in the body frame, with the iron and current errors that calibration leaves.

use anyhow::Result;
use firmware::sensors::MagSample;
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::check::Check;
use super::home::Home;
use super::process::{Period, quantise, ticks};
use super::{Model, Truth};
use crate::noise::gaussian::{Source, Stream};

/// Data sheet of a magnetometer. Deviations are over the seeds, per component.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mag {
    /// Name of the built-in part that the values are from, but for those that differ; none if they are from a file.
    pub part: Option<String>,
    /// Sampling rate, Hz.
    pub rate_hz: f64,
    /// Latency: from the measurement to its delivery, s.
    pub delay_s: f64,
    /// White noise of a sample, µT.
    pub noise_ut: f64,
    /// Resolution, µT.
    pub resolution_ut: f64,
    /// Range, ±µT.
    pub range_ut: f64,
    /// Deviation of the residual hard iron, µT.
    pub hard_iron_ut: f64,
    /// Deviation of each entry of the residual matrix of soft iron, scale errors and misalignment.
    pub soft_iron: f64,
    /// Deviation of the field of the battery's current, µT/A.
    pub current_ut_a: f64,
}

impl Mag {
    /// # Errors
    /// The first key that is out of range.
    pub(super) fn validate(&self) -> Result<()> {
        let check = Check("mag");
        check.rate(self.rate_hz)?;
        check.fused_latency(self.delay_s, 0.0)?;
        check.within(1.0, 1e4, &[("range_ut", self.range_ut)])?;
        check.within(
            0.0,
            100.0,
            &[
                ("noise_ut", self.noise_ut),
                ("resolution_ut", self.resolution_ut),
                ("hard_iron_ut", self.hard_iron_ut),
                ("current_ut_a", self.current_ut_a),
            ],
        )?;
        check.within(0.0, 0.5, &[("soft_iron", self.soft_iron)])
    }
}

/// A magnetometer with errors drawn from a seed.
#[derive(Clone, Debug)]
pub(super) struct Magnetometer {
    period: Period,
    delay: u32,
    spec: Mag,
    field: Vector3<f64>,
    pub(super) hard_iron: Vector3<f64>,
    iron: Matrix3<f64>,
    /// µT/A.
    wires: Vector3<f64>,
    noise: Stream,
}

impl Magnetometer {
    pub(super) fn new(spec: &Mag, home: &Home, seed: u64) -> Self {
        let mut errors = Stream::new(seed, Source::MagErrors);
        let hard_iron = errors.normal_vector() * spec.hard_iron_ut;
        let wires = errors.normal_vector() * spec.current_ut_a;
        let columns: [Vector3<f64>; 3] = core::array::from_fn(|_| errors.normal_vector() * spec.soft_iron);
        Self {
            period: Period::of_rate(spec.rate_hz),
            delay: ticks(spec.delay_s),
            spec: spec.clone(),
            field: home.field_nwu(),
            hard_iron,
            iron: Matrix3::identity() + Matrix3::from_columns(&columns),
            wires,
            noise: Stream::new(seed, Source::MagNoise),
        }
    }
}

impl Model for Magnetometer {
    type Sample = MagSample;

    fn period(&self) -> Period {
        self.period
    }

    fn delay(&mut self) -> u32 {
        self.delay
    }

    fn measure(&mut self, truth: &Truth) -> MagSample {
        let field = truth.attitude().inverse() * self.field;
        let noise = self.noise.normal_vector() * self.spec.noise_ut;
        let sensed = self.iron * field + self.hard_iron + self.wires * truth.battery.current_a + noise;
        let range = self.spec.range_ut;
        let read = |value: f64| quantise(value.clamp(-range, range), self.spec.resolution_ut) as f32;
        MagSample { at: truth.tick, field_ut: sensed.map(read) }
    }
}
