//! Barometer: the static pressure of the standard atmosphere, with noise, a slow drift and the drift of warming up.

use anyhow::Result;
use firmware::sensors::BaroSample;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::check::Check;
use super::home::Home;
use super::process::{GaussMarkov, Period, WarmUp, quantise, ticks};
use super::{Model, Truth};
use crate::noise::gaussian::{Source, Stream};

/// Data sheet of a barometer. Near the ground 1 Pa is 8.5 cm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Baro {
    /// Name of the built-in part that the values are from, but for those that differ; none if they are from a file.
    pub part: Option<String>,
    /// Sampling rate, Hz.
    pub rate_hz: f64,
    /// Latency: from the measurement to its delivery, s.
    pub delay_s: f64,
    /// White noise of a sample, Pa.
    pub noise_pa: f64,
    /// Resolution, Pa.
    pub resolution_pa: f64,
    /// Deviation of the offset over the seeds, Pa.
    pub offset_pa: f64,
    /// Deviation of the slow drift, from weather and sensor, Pa.
    pub drift_pa: f64,
    /// Its correlation time, s.
    pub drift_time_s: f64,
    /// Deviation of the offset's temperature coefficient over the seeds, Pa/K.
    pub offset_pa_k: f64,
    /// Its warm-up.
    pub warm_up: WarmUp,
}

impl Baro {
    /// # Errors
    /// The first key that is out of range.
    pub(super) fn validate(&self) -> Result<()> {
        let check = Check("baro");
        check.rate(self.rate_hz)?;
        check.fused_latency(self.delay_s, 0.0)?;
        check.within(
            0.0,
            1e4,
            &[
                ("noise_pa", self.noise_pa),
                ("resolution_pa", self.resolution_pa),
                ("offset_pa", self.offset_pa),
                ("drift_pa", self.drift_pa),
                ("offset_pa_k", self.offset_pa_k),
            ],
        )?;
        check.within(1.0, 1e6, &[("drift_time_s", self.drift_time_s)])?;
        self.warm_up.validate(&check)
    }
}

/// A barometer with errors drawn from a seed.
#[derive(Clone, Debug)]
pub(super) struct Barometer {
    period: Period,
    delay: u32,
    spec: Baro,
    home: Home,
    offset_pa: f64,
    /// Pa/K.
    warmth: f64,
    drift: GaussMarkov,
    drifts: Stream,
    noise: Stream,
}

impl Barometer {
    pub(super) fn new(spec: &Baro, home: &Home, seed: u64) -> Self {
        let period = Period::of_rate(spec.rate_hz);
        let (offset, warmth) = Stream::new(seed, Source::BaroErrors).normal_pair();
        let mut drifts = Stream::new(seed, Source::BaroDrift);
        let sigma = Vector3::new(spec.drift_pa, 0.0, 0.0);
        Self {
            period,
            delay: ticks(spec.delay_s),
            spec: spec.clone(),
            home: *home,
            offset_pa: spec.offset_pa * offset,
            warmth: spec.offset_pa_k * warmth,
            drift: GaussMarkov::new(&mut drifts, sigma, spec.drift_time_s, period.seconds()),
            drifts,
            noise: Stream::new(seed, Source::BaroNoise),
        }
    }
}

impl Model for Barometer {
    type Sample = BaroSample;

    fn period(&self) -> Period {
        self.period
    }

    fn delay(&mut self) -> u32 {
        self.delay
    }

    fn measure(&mut self, truth: &Truth) -> BaroSample {
        let drift = self.drift.sample(&mut self.drifts).x + self.warmth * self.spec.warm_up.at(truth.tick);
        let noise = self.noise.normal_pair().0 * self.spec.noise_pa;
        let pressure = self.home.pressure(truth.motion.position.z) + self.offset_pa + drift + noise;
        BaroSample { at: truth.tick, pressure_pa: quantise(pressure, self.spec.resolution_pa) as f32 }
    }
}
