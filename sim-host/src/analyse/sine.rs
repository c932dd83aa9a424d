//! The response to a sinusoid, by least squares.

use nalgebra::{Complex, Matrix4, Vector4};

/// Least number of evaluated steps: at the highest frequencies a period is two or three steps.
const STEPS_AT_LEAST: f64 = 400.0;

/// Timing of a sinusoid and of the evaluation of its response.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Schedule {
    omega_step: f64,
    settle: u32,
    window: u32,
}

impl Schedule {
    /// Of ω (rad/s), sampled every `step_s`: `settle_s` to settle, then whole periods.
    pub(super) fn new(omega_rad_s: f64, step_s: f64, settle_s: f64) -> Self {
        let omega_step = omega_rad_s * step_s;
        let period = core::f64::consts::TAU / omega_step;
        let periods = (STEPS_AT_LEAST / period).ceil().max(1.0);
        Self { omega_step, settle: (settle_s / step_s) as u32, window: (periods * period).round() as u32 }
    }

    /// The same after twice the time to settle.
    pub(super) fn later(self) -> Self {
        Self { settle: 2 * self.settle, ..self }
    }

    /// Total number of steps.
    pub(super) fn steps(&self) -> u32 {
        self.settle + self.window
    }

    /// The sinusoid of unit amplitude at a step.
    pub(super) fn cos(&self, step: u32) -> f64 {
        libm::cos(self.omega_step * f64::from(step))
    }

    /// Complex amplitudes Y of answers `Re[Y e^(jωkh)]`, the answer of step k being the k-th. An offset and a slope, which
    /// integrators leave, are fitted with them and dropped.
    pub(super) fn amplitudes<const N: usize>(&self, answers: impl Iterator<Item = [f64; N]>) -> [Complex<f64>; N] {
        let mut normal = Matrix4::<f64>::zeros();
        let mut right = [Vector4::<f64>::zeros(); N];
        for (step, answer) in (0..self.steps()).zip(answers).skip(self.settle as usize) {
            let (sin, cos) = libm::sincos(self.omega_step * f64::from(step));
            let along = 2.0 * f64::from(step - self.settle) / f64::from(self.window) - 1.0;
            let row = Vector4::new(cos, sin, 1.0, along);
            normal += row * row.transpose();
            right.iter_mut().zip(answer).for_each(|(right, answer)| *right += row * answer);
        }
        let lu = normal.lu();
        right.map(|right| lu.solve(&right).map_or(Complex::new(f64::NAN, f64::NAN), |fit| Complex::new(fit.x, -fit.y)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sinusoid_is_found_beside_an_offset_and_a_slope() {
        for omega in [0.5, 30.0, 3_000.0] {
            let schedule = Schedule::new(omega, 1e-3, 0.1);
            let answer = |k: u32| {
                let t = f64::from(k) * 1e-3;
                [2.0 * (omega * t).cos() - 3.0 * (omega * t).sin() + 7.0 - 4.0 * t]
            };
            let [found] = schedule.amplitudes((0..schedule.steps()).map(answer));
            assert!((found - Complex::new(2.0, 3.0)).norm_sqr() < 1e-16, "{omega}: {found}");
        }
    }
}
