//! Low-pass filters of three axes, and derivatives taken after them.

use firmware::math;
use nalgebra::Vector3;

/// First order: `ẏ = 2πf (x − y)`, sampled exactly.
#[derive(Clone, Debug)]
pub(super) struct LowPass {
    part: f32,
    value: Option<Vector3<f32>>,
}

impl LowPass {
    /// With the cutoff f in Hz, evaluated every `step_s` seconds.
    pub(super) fn new(cutoff_hz: f32, step_s: f32) -> Self {
        Self { part: 1.0 - math::exp(-core::f32::consts::TAU * cutoff_hz * step_s), value: None }
    }

    /// The next output. Starts in steady state with the first input.
    pub(super) fn step(&mut self, input: &Vector3<f32>) -> Vector3<f32> {
        let before = self.value.unwrap_or(*input);
        let value = before + (input - before) * self.part;
        self.value = Some(value);
        value
    }

    pub(super) fn reset(&mut self) {
        self.value = None;
    }
}

/// Second-order Butterworth, by the bilinear transform with prewarping: two integrators in a form whose DC gain is
/// exactly 1 in spite of rounding.
#[derive(Clone, Debug)]
pub(super) struct Butterworth {
    /// 1/(1 + √2 g + g²), that times g, and that times g², for g = tan(πfh), per axis.
    a: [Vector3<f32>; 3],
    /// The integrators; `None` before the first input.
    state: Option<[Vector3<f32>; 2]>,
}

impl Butterworth {
    /// With the cutoffs of the axes in Hz, evaluated every `step_s` seconds.
    pub(super) fn new(cutoff_hz: &Vector3<f32>, step_s: f32) -> Self {
        let g = cutoff_hz.map(|cutoff_hz| {
            let (sin, cos) = math::sin_cos(core::f32::consts::PI * cutoff_hz * step_s);
            sin / cos
        });
        let a = g.map(|g| 1.0 / (1.0 + g * (g + core::f32::consts::SQRT_2)));
        let times_g = a.component_mul(&g);
        Self { a: [a, times_g, times_g.component_mul(&g)], state: None }
    }

    /// The next output. Starts in steady state with the first input.
    pub(super) fn step(&mut self, input: &Vector3<f32>) -> Vector3<f32> {
        let [slope, value] = self.state.unwrap_or([Vector3::zeros(), *input]);
        let (error, [a1, a2, a3]) = (input - value, &self.a);
        let new_slope = slope.component_mul(a1) + error.component_mul(a2);
        let output = value + slope.component_mul(a2) + error.component_mul(a3);
        self.state = Some([new_slope * 2.0 - slope, output * 2.0 - value]);
        output
    }

    pub(super) fn reset(&mut self) {
        self.state = None;
    }
}

/// The rate of change of a signal from step to step; zero at the first.
#[derive(Clone, Debug)]
pub(super) struct Difference {
    per_step_s: f32,
    before: Option<Vector3<f32>>,
}

impl Difference {
    /// Evaluated every `step_s` seconds.
    pub(super) fn new(step_s: f32) -> Self {
        Self { per_step_s: 1.0 / step_s, before: None }
    }

    pub(super) fn step(&mut self, input: &Vector3<f32>) -> Vector3<f32> {
        let before = self.before.replace(*input).unwrap_or(*input);
        (input - before) * self.per_step_s
    }

    pub(super) fn reset(&mut self) {
        self.before = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Amplitude of the output of a sine of 1 at `hz`, after it has settled.
    fn gain(hz: f64, mut step: impl FnMut(&Vector3<f32>) -> Vector3<f32>) -> f64 {
        let wave = |i: u32| std::f64::consts::TAU * hz * f64::from(i) * 1e-3;
        (0..4_000)
            .map(|i| (i, f64::from(step(&Vector3::repeat(wave(i).sin() as f32)).x)))
            .filter(|(i, _)| *i >= 2_000)
            .fold(0.0, |most, (_, y)| most.max(y.abs()))
    }

    #[test]
    fn both_low_passes_halve_the_power_at_their_cutoff() {
        // 1/√2; a sine sampled 50 times a period misses its crest by at most 1 − cos(π/50) = 0.2 %. The first order is
        // sampled exactly for a step, which is 1 − e^(−ωh) ≈ 6 % at 20 Hz from the continuous one.
        let mut second = Butterworth::new(&Vector3::repeat(20.0), 1e-3);
        assert!((gain(20.0, |x| second.step(x)) - 0.5_f64.sqrt()).abs() < 3e-3);
        let mut first = LowPass::new(20.0, 1e-3);
        assert!((gain(20.0, |x| first.step(x)) - 0.5_f64.sqrt()).abs() < 0.05);
        // A decade above, |H| = 1/√(1 + (tan ratio)⁴): 40 dB a decade, a little more by the transformation.
        let mut second = Butterworth::new(&Vector3::repeat(20.0), 1e-3);
        assert!(gain(200.0, |x| second.step(x)) < 0.01);
    }

    #[test]
    fn a_constant_passes_from_the_first_step() {
        let x = Vector3::new(3.0, -1.0, 0.5);
        let (mut first, mut second, mut slope) =
            (LowPass::new(5.0, 1e-3), Butterworth::new(&Vector3::repeat(5.0), 1e-3), Difference::new(1e-3));
        for _ in 0..100 {
            assert!((first.step(&x) - x).norm() < 1e-5);
            assert_eq!(second.step(&x), x);
            assert_eq!(slope.step(&x), Vector3::zeros());
        }
    }
}
