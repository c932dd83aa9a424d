//! Margins of a loop from its frequency response.

use core::f64::consts::{PI, TAU};

use nalgebra::Complex;
use serde::Serialize;

/// A complex gain at a frequency; in JSON `omega_rad_s`, `re`, `im`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(into = "Flat")]
pub struct Sample {
    /// ω, rad/s.
    pub omega_rad_s: f64,
    /// L(e^(jωh)), with 1 + L as the characteristic function of the closed loop.
    pub value: Complex<f64>,
}

#[derive(Serialize)]
struct Flat {
    omega_rad_s: f64,
    re: f64,
    im: f64,
}

impl From<Sample> for Flat {
    fn from(sample: Sample) -> Self {
        Self { omega_rad_s: sample.omega_rad_s, re: sample.value.re, im: sample.value.im }
    }
}

/// A gain margin.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GainMargin {
    /// Factor on the loop's gain at which it begins to oscillate.
    pub factor: f64,
    /// Frequency of that oscillation, rad/s.
    pub omega_rad_s: f64,
}

/// Margins of a stable loop; `None` for a margin without limit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Margins {
    /// Highest frequency at which |L| = 1, rad/s.
    pub crossover_rad_s: Option<f64>,
    /// The least gain above 1.
    pub gain_upper: Option<GainMargin>,
    /// The greatest gain below 1, for a conditionally stable loop.
    pub gain_lower: Option<GainMargin>,
    /// Smallest phase margin at |L| = 1, degrees; negative if unstable.
    pub phase_deg: Option<f64>,
    /// Delay margin, s.
    pub delay_s: Option<f64>,
    /// Frequency of oscillation at that delay, rad/s.
    pub delay_omega_rad_s: Option<f64>,
    /// max |1/(1 + L)|.
    pub sensitivity_peak: f64,
    /// Its frequency, rad/s.
    pub sensitivity_omega_rad_s: f64,
}

/// Magnitude.
pub(super) fn size(value: Complex<f64>) -> f64 {
    value.norm_sqr().sqrt()
}

/// Angle, rad, in (−π, π].
pub(super) fn angle(value: Complex<f64>) -> f64 {
    libm::atan2(value.im, value.re)
}

impl Margins {
    /// From samples in ascending order of frequency, dense enough for linear interpolation.
    ///
    /// `nyquist_rad_s` is π/h of a sampled loop whose samples end short of it. There L is real, and its real part is flat:
    /// a loop of a fast law and a double integrator has its gain margin there.
    pub fn of(samples: &[Sample], nyquist_rad_s: Option<f64>) -> Self {
        let end = nyquist_rad_s
            .zip(samples.last())
            .map(|(omega_rad_s, last)| Sample { omega_rad_s, value: Complex::new(last.value.re, 0.0) });
        let samples: Vec<Sample> = samples.iter().copied().chain(end).collect();
        let mut margins = Self::default();
        for sample in &samples {
            let peak = 1.0 / size(sample.value + 1.0);
            if peak > margins.sensitivity_peak {
                (margins.sensitivity_peak, margins.sensitivity_omega_rad_s) = (peak, sample.omega_rad_s);
            }
        }
        for pair in samples.windows(2) {
            margins.look_for_gain(&pair[0], &pair[1]);
            margins.look_for_phase(&pair[0], &pair[1]);
        }
        margins
    }

    /// A crossing of the negative real axis.
    fn look_for_gain(&mut self, a: &Sample, b: &Sample) {
        if a.value.im * b.value.im > 0.0 || a.value.im == b.value.im {
            return;
        }
        let part = a.value.im / (a.value.im - b.value.im);
        let omega_rad_s = between(a.omega_rad_s, b.omega_rad_s, part);
        let real = a.value.re + part * (b.value.re - a.value.re);
        if real >= 0.0 {
            return;
        }
        let found = GainMargin { factor: -1.0 / real, omega_rad_s };
        if found.factor > 1.0 && self.gain_upper.is_none_or(|upper| found.factor < upper.factor) {
            self.gain_upper = Some(found);
        }
        if found.factor < 1.0 && self.gain_lower.is_none_or(|lower| found.factor > lower.factor) {
            self.gain_lower = Some(found);
        }
    }

    /// A crossing of the unit circle.
    fn look_for_phase(&mut self, a: &Sample, b: &Sample) {
        let [size_a, size_b] = [a, b].map(|s| libm::log(size(s.value)));
        if size_a * size_b > 0.0 || size_a == size_b {
            return;
        }
        let part = size_a / (size_a - size_b);
        let omega = between(a.omega_rad_s, b.omega_rad_s, part);
        let turn = angle(b.value / a.value);
        // From −180°, in [0, 2π): the phase that a delay must add.
        let from_minus_1 = wrapped(angle(a.value) + part * turn + PI);
        let phase_deg = (if from_minus_1 > PI { from_minus_1 - TAU } else { from_minus_1 }).to_degrees();
        self.crossover_rad_s = Some(self.crossover_rad_s.map_or(omega, |most| most.max(omega)));
        if self.phase_deg.is_none_or(|least| phase_deg.abs() < least.abs()) {
            self.phase_deg = Some(phase_deg);
        }
        if self.delay_s.is_none_or(|least| from_minus_1 / omega < least) {
            (self.delay_s, self.delay_omega_rad_s) = (Some(from_minus_1 / omega), Some(omega));
        }
    }
}

/// A frequency between two, on a logarithmic scale.
fn between(a: f64, b: f64, part: f64) -> f64 {
    a * libm::exp(part * libm::log(b / a))
}

/// An angle in [0, 2π).
fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).floor()
}

/// Logarithmically spaced frequencies, from the first to the last, rad/s.
pub(super) fn frequencies(first: f64, last: f64, count: usize) -> Vec<f64> {
    let ratio = libm::log(last / first);
    (0..count).map(|i| first * libm::exp(ratio * i as f64 / (count - 1) as f64)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(of: impl Fn(Complex<f64>) -> Complex<f64>) -> Vec<Sample> {
        let at = |omega_rad_s| Sample { omega_rad_s, value: of(Complex::new(0.0, omega_rad_s)) };
        frequencies(0.01, 1000.0, 600).into_iter().map(at).collect()
    }

    fn near(a: Option<f64>, b: f64) {
        let a = a.expect("found");
        assert!((a - b).abs() < 1e-3 * b.abs(), "{a} {b}");
    }

    #[test]
    fn margins_of_an_integrator_with_two_lags() {
        // L = 2/(s(s + 1)²): −180° at 1 rad/s, where |L| = 1; half the gain has a margin of 2.
        let margins = Margins::of(&samples(|s| (s * (s + 1.0) * (s + 1.0)).inv()), None);
        let gain = margins.gain_upper.expect("it has one");
        near(Some(gain.factor), 2.0);
        near(Some(gain.omega_rad_s), 1.0);
        assert!(margins.gain_lower.is_none());
        // |L| = 1 where ω(ω² + 1) = 1.
        near(margins.crossover_rad_s, 0.682_328);
        near(margins.phase_deg, 90.0 - 2.0 * 0.682_328_f64.atan().to_degrees());
        near(margins.delay_s, (90.0 - 2.0 * 0.682_328_f64.atan().to_degrees()).to_radians() / 0.682_328);
    }

    #[test]
    fn a_conditionally_stable_loop_has_a_margin_below_one() {
        // 5 (s + 1)²/s³: −180° at 1 rad/s, |L| = 10 there.
        let margins = Margins::of(&samples(|s| (s + 1.0) * (s + 1.0) * 5.0 / (s * s * s)), None);
        near(margins.gain_lower.map(|g| g.factor), 0.1);
        assert!(margins.gain_upper.is_none());
    }
}
