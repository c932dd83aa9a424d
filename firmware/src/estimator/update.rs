//! A measurement of one to three numbers: innovation, gate, correction.

use super::covariance::{Covariance, ErrorState, Row};

/// A measurement made linear about what is believed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement<const N: usize> {
    /// H, a row a number.
    pub rows: [Row; N],
    /// y = z − h(x̂), the error state taken as zero.
    pub innovation: [f32; N],
    /// R, its diagonal.
    pub variance: [f32; N],
}

/// What came of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// Normalised innovation squared yᵀ S⁻¹ y: χ² with as many degrees of freedom as numbers, if all is as believed.
    pub nis: f32,
    /// Whether it was within the gate, and taken in.
    pub accepted: bool,
}

/// χ² beyond which a measurement of N numbers is refused: exceeded by chance once in 1.7 million (5σ of one number).
pub const fn gate<const N: usize>() -> f32 {
    match N {
        1 => 25.0,
        2 => 28.4,
        _ => 32.0,
    }
}

impl<const N: usize> Measurement<N> {
    /// Takes the measurement in if it is within the gate: corrects `error`, the error state found so far, and its
    /// covariance.
    ///
    /// The numbers are taken one after the other, each with what is left of the innovation and of P Hᵀ by those before:
    /// the sum of their squares over s is yᵀ S⁻¹ y, without an inverse, and known before the covariance is touched.
    pub fn apply(&self, covariance: &mut Covariance, error: &mut ErrorState, gate: f32) -> Verdict {
        let mut c = self.rows.map(|row| covariance.times(&row));
        let mut innovation: [f32; N] = core::array::from_fn(|n| self.innovation[n] - self.rows[n].dot(error));
        let mut gains = [ErrorState::zeros(); N];
        let mut sums = [0.0; N];
        let mut nis = 0.0;
        for n in 0..N {
            let s = self.rows[n].dot(&c[n]) + self.variance[n];
            // P is positive but for rounding, and R is not small: only what is no number can fail here.
            if !(s > 0.0) {
                return Verdict { nis: f32::INFINITY, accepted: false };
            }
            let gain = c[n] / s;
            nis += innovation[n] * innovation[n] / s;
            for later in n + 1..N {
                let shared = self.rows[later].dot(&c[n]);
                c[later] -= gain * shared;
                innovation[later] -= innovation[n] * shared / s;
            }
            (gains[n], sums[n]) = (gain, s);
        }
        let accepted = nis <= gate;
        if accepted {
            for n in 0..N {
                *error += gains[n] * innovation[n];
            }
            covariance.correct(&gains, &c, &sums);
        }
        Verdict { nis, accepted }
    }
}
