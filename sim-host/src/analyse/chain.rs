//! The plant about hover, one axis at a time: rotor lag, integrators, drag; exact at the ticks.

use nalgebra::{Complex, SMatrix, SVector};

/// ```text
/// τ α̇ = u − α        q̇ = gain (α + reaction α̇) − rate_drag q        θ̇ = q        v̇ = tilt θ − drag v        ẋ = v
/// ```
///
/// About an axis u is the torque demanded, q and θ rate and angle, v and x the horizontal motion due to the tilt. Along
/// z, u is the thrust demanded, q and θ velocity and height.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Chain {
    /// τ, s; 0 for rotors without lag.
    pub lag_s: f64,
    /// Reaction to spin-up, s.
    pub reaction_s: f64,
    /// rad/s² for each N m, or m/s² for each N.
    pub gain: f64,
    /// 1/s.
    pub rate_drag: f64,
    /// m/s² for each rad.
    pub tilt: f64,
    /// 1/s.
    pub drag: f64,
}

/// States of the chain and its input.
const STATES: usize = 5;

/// Amplitudes of a chain's states for an input of amplitude 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moved {
    /// q.
    pub rate: Complex<f64>,
    /// θ.
    pub angle: Complex<f64>,
    /// v.
    pub velocity: Complex<f64>,
    /// x.
    pub position: Complex<f64>,
}

/// A chain with its input held between ticks: `x⁺ = A x + b u`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled {
    transition: SMatrix<f64, STATES, STATES>,
    input: SVector<f64, STATES>,
}

impl Chain {
    /// Sampled every `step_s` seconds: the exponential of the augmented matrix.
    pub fn sampled(&self, step_s: f64) -> Sampled {
        let mut m = SMatrix::<f64, 6, 6>::zeros();
        // Columns α, q, θ, v, x, u.
        if self.lag_s > 0.0 {
            let per_lag = 1.0 / self.lag_s;
            (m[(0, 0)], m[(0, 5)]) = (-per_lag, per_lag);
            m[(1, 0)] = self.gain * (1.0 - self.reaction_s * per_lag);
            m[(1, 5)] = self.gain * self.reaction_s * per_lag;
        } else {
            m[(1, 5)] = self.gain;
        }
        m[(1, 1)] = -self.rate_drag;
        m[(2, 1)] = 1.0;
        (m[(3, 2)], m[(3, 3)]) = (self.tilt, -self.drag);
        m[(4, 3)] = 1.0;
        let whole = exponential(&(m * step_s));
        Sampled {
            transition: whole.fixed_view::<STATES, STATES>(0, 0).into_owned(),
            input: whole.fixed_view::<STATES, 1>(0, STATES).into_owned(),
        }
    }
}

impl Sampled {
    /// `(z − A)⁻¹ b`.
    pub fn at(&self, z: Complex<f64>) -> Moved {
        let real = |v: f64| Complex::new(v, 0.0);
        let matrix = SMatrix::<Complex<f64>, STATES, STATES>::identity() * z - self.transition.map(real);
        let x = matrix.lu().solve(&self.input.map(real)).unwrap_or_else(|| SVector::repeat(real(f64::NAN)));
        Moved { rate: x[1], angle: x[2], velocity: x[3], position: x[4] }
    }
}

/// e^M by scaling and squaring of its Taylor series.
fn exponential(m: &SMatrix<f64, 6, 6>) -> SMatrix<f64, 6, 6> {
    const SQUARINGS: i32 = 10;
    let small = m * libm::ldexp(1.0, -SQUARINGS);
    let mut sum = SMatrix::<f64, 6, 6>::identity();
    let mut term = sum;
    for k in 1..=12 {
        term = term * small / f64::from(k);
        sum += term;
    }
    (0..SQUARINGS).fold(sum, |power, _| power * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    const H: f64 = 1e-3;

    fn z(omega: f64) -> Complex<f64> {
        Complex::new((omega * H).cos(), (omega * H).sin())
    }

    fn near(a: Complex<f64>, b: Complex<f64>) {
        assert!((a - b).norm_sqr().sqrt() < 1e-8 * b.norm_sqr().sqrt(), "{a} {b}");
    }

    #[test]
    fn without_lag_it_is_the_sampled_double_integrator() {
        let chain = Chain { gain: 3.0, ..Chain::default() }.sampled(H);
        for omega in [2.0, 50.0, 2_000.0] {
            let (z, one) = (z(omega), Complex::new(1.0, 0.0));
            near(chain.at(z).rate, one * 3.0 * H / (z - one));
            near(chain.at(z).angle, (z + one) * (1.5 * H * H) / ((z - one) * (z - one)));
        }
    }

    #[test]
    fn with_lag_the_rotors_step_is_exact() {
        // q after a unit step of u: gain (t − τ(1 − e^(−t/τ))); with the reaction c, gain c (1 − e^(−t/τ)) more.
        let chain = Chain { lag_s: 0.02, reaction_s: 0.003, gain: 2.0, ..Chain::default() }.sampled(H);
        let mut state = SVector::<f64, STATES>::zeros();
        for tick in 1..=100 {
            state = chain.transition * state + chain.input;
            let t = f64::from(tick) * H;
            let gone = 1.0 - (-t / 0.02).exp();
            assert!((state[1] - 2.0 * (t - 0.02 * gone + 0.003 * gone)).abs() < 1e-13, "{tick}");
        }
    }

    #[test]
    fn a_slow_sinusoid_moves_it_as_the_differential_equation_says() {
        let chain = Chain { gain: 2.0, rate_drag: 0.3, tilt: 9.81, drag: 0.5, lag_s: 0.02, reaction_s: 0.0 };
        let s = Complex::new(0.0, 1.0);
        let angle = Complex::new(2.0, 0.0) / ((s * 0.02 + 1.0) * (s + 0.3) * s);
        let velocity = angle * 9.81 / (s + 0.5);
        let moved = chain.sampled(H).at(z(1.0));
        // Half a tick of hold.
        for (a, b) in [(moved.angle, angle), (moved.velocity, velocity), (moved.position, velocity / s)] {
            assert!((a / b - 1.0).norm_sqr().sqrt() < 6e-4, "{a} {b}");
        }
    }
}
