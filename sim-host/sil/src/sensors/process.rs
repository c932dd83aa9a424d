//! Building blocks of the sensor models: random processes, warm-up, quantisation, sampling times.

use anyhow::Result;
use firmware::signals::Tick;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::check::Check;
use crate::noise::gaussian::Stream;

/// Ticks in a second.
pub(super) const TICKS_PER_S: f64 = 1e3;

/// Whole ticks of a time, s.
pub(super) fn ticks(seconds: f64) -> u32 {
    (seconds * TICKS_PER_S).round() as u32
}

/// Seconds of a time in ticks.
pub(super) fn seconds(ticks: Tick) -> f64 {
    f64::from(ticks) / TICKS_PER_S
}

/// Three independent Gauss–Markov processes of first order, R(τ) = σ² e^(−|τ|/T), sampled exactly at any step and
/// stationary from the first sample.
#[derive(Clone, Debug)]
pub(super) struct GaussMarkov {
    /// Factor on the state per step.
    keep: f64,
    /// Deviation of the noise added per step.
    kick: Vector3<f64>,
    state: Vector3<f64>,
}

impl GaussMarkov {
    /// With deviation `sigma` per component and correlation time `time_s`, sampled every `step_s`.
    pub(super) fn new(stream: &mut Stream, sigma: Vector3<f64>, time_s: f64, step_s: f64) -> Self {
        let keep = libm::exp(-step_s / time_s);
        // 1 − keep² without cancellation.
        let added = -libm::expm1(-2.0 * step_s / time_s);
        Self { keep, kick: sigma * added.sqrt(), state: sigma.component_mul(&stream.normal_vector()) }
    }

    /// Returns the present sample and advances by a step.
    pub(super) fn sample(&mut self, stream: &mut Stream) -> Vector3<f64> {
        let now = self.state;
        self.state = now * self.keep + self.kick.component_mul(&stream.normal_vector());
        now
    }
}

/// Warm-up of a board from the temperature at which its sensors were calibrated: ΔT (1 − e^(−t/τ)).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WarmUp {
    /// ΔT, K.
    pub rise_k: f64,
    /// τ, s.
    pub time_s: f64,
}

impl WarmUp {
    /// Temperature rise at a tick since calibration, K.
    pub(super) fn at(&self, tick: Tick) -> f64 {
        -self.rise_k * libm::expm1(-seconds(tick) / self.time_s)
    }

    /// # Errors
    /// The first key that is out of range.
    pub(super) fn validate(&self, check: &Check) -> Result<()> {
        check.within(-100.0, 100.0, &[("warm_up.rise_k", self.rise_k)])?;
        check.within(0.1, 1e6, &[("warm_up.time_s", self.time_s)])
    }
}

/// The nearest multiple of a resolution; unchanged for a resolution of 0.
#[inline]
pub(super) fn quantise(value: f64, resolution: f64) -> f64 {
    if resolution > 0.0 { (value / resolution).round() * resolution } else { value }
}

/// Sampling period of a sensor: it measures at every multiple of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Period(u32);

impl Period {
    pub(super) const EVERY_TICK: Self = Self(1);

    pub(super) fn of_rate(rate_hz: f64) -> Self {
        Self(((TICKS_PER_S / rate_hz).round() as u32).max(1))
    }

    #[inline]
    pub(super) fn is_due(self, tick: Tick) -> bool {
        tick.is_multiple_of(self.0)
    }

    pub(super) fn ticks(self) -> u32 {
        self.0
    }

    pub(super) fn seconds(self) -> f64 {
        seconds(self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::gaussian::Source;

    #[test]
    fn a_gauss_markov_process_has_its_deviation_and_its_correlation_time() {
        let mut stream = Stream::new(1, Source::GnssPlace);
        let (time_s, step_s, count) = (2.0, 0.1, 400_000_usize);
        let mut process = GaussMarkov::new(&mut stream, Vector3::new(1.0, 2.0, 3.0), time_s, step_s);
        let samples: Vec<Vector3<f64>> = (0..count).map(|_| process.sample(&mut stream)).collect();
        for component in 0..3 {
            let sigma = component as f64 + 1.0;
            for lag in [0_usize, 10, 20, 40] {
                let products = samples.iter().zip(&samples[lag..]).map(|(a, b)| a[component] * b[component]);
                let estimate = products.sum::<f64>() / (count - lag) as f64;
                let exact = sigma * sigma * libm::exp(-(lag as f64) * step_s / time_s);
                // Bartlett: the variance is at most 2 σ⁴ T/duration; 4.5 standard errors.
                let bound = 4.5 * sigma * sigma * (2.0 * time_s / (count as f64 * step_s)).sqrt();
                assert!((estimate - exact).abs() < bound, "{component} {lag}: {estimate} {exact} ± {bound}");
            }
        }
    }

    #[test]
    fn its_first_sample_is_as_wide_as_any() {
        let seeds = 20_000_u64;
        let sum = (0..seeds).fold(0.0, |sum, seed| {
            let mut stream = Stream::new(seed, Source::GnssPlace);
            let first = GaussMarkov::new(&mut stream, Vector3::repeat(2.0), 1e3, 1e-3).sample(&mut stream);
            sum + first.norm_squared() / 3.0
        });
        // A variance from n numbers is known to √(2/n).
        let bound = 4.5 * 4.0 * (2.0 / (3.0 * seeds as f64)).sqrt();
        assert!((sum / seeds as f64 - 4.0).abs() < bound);
    }

    #[test]
    fn warming_up_is_exponential() {
        let warm_up = WarmUp { rise_k: 20.0, time_s: 100.0 };
        assert_eq!(warm_up.at(0), 0.0);
        assert!((warm_up.at(100_000) - 20.0 * (1.0 - libm::exp(-1.0))).abs() < 1e-12);
        assert!((warm_up.at(2_000_000) - 20.0).abs() < 1e-6);
    }

    #[test]
    fn quantising_is_rounding_to_multiples() {
        assert_eq!(quantise(0.74, 0.5), 0.5);
        assert_eq!(quantise(-0.76, 0.5), -1.0);
        assert_eq!(quantise(0.74, 0.0), 0.74);
    }

    #[test]
    fn a_period_is_due_at_its_multiples() {
        let period = Period::of_rate(50.0);
        assert_eq!((period.ticks(), period.seconds()), (20, 0.02));
        assert!(period.is_due(0) && period.is_due(40) && !period.is_due(41));
    }
}
