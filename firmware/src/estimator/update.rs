//! Update by a measurement of one to three components: innovation, gate, correction.

use super::covariance::{Covariance, ErrorState, Row, add_multiple};

/// A measurement of N components, linearised about the nominal state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement<const N: usize> {
    /// H: one row per component.
    pub rows: [Row; N],
    /// y = z − h(x̂), for an error state of zero.
    pub innovation: [f32; N],
    /// Diagonal of R.
    pub variance: [f32; N],
}

/// Result of gating a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// Normalised innovation squared yᵀ S⁻¹ y: χ² with N degrees of freedom if the filter is consistent.
    pub nis: f32,
    /// Whether it was within the gate, and fused.
    pub accepted: bool,
}

/// Gate on the NIS of a measurement of N components: exceeded by chance once in 1.7 million (5σ of one component).
pub const fn gate<const N: usize>() -> f32 {
    match N {
        1 => 25.0,
        2 => 28.4,
        _ => 32.0,
    }
}

impl<const N: usize> Measurement<N> {
    /// Fuses the measurement if its NIS is within `gate`: corrects `error`, the error state found so far, and the
    /// covariance.
    ///
    /// The components are processed one after the other, each with the innovation and the P Hᵀ that those before it
    /// leave. The sum of y²/s is then yᵀ S⁻¹ y without a matrix inverse, and known before the covariance is touched.
    pub fn apply(&self, covariance: &mut Covariance, error: &mut ErrorState, gate: f32) -> Verdict {
        let mut c = [ErrorState::zeros(); N];
        for (c, row) in c.iter_mut().zip(&self.rows) {
            covariance.times(row, c);
        }
        let mut innovation: [f32; N] = core::array::from_fn(|n| self.innovation[n] - self.rows[n].dot(error));
        let mut sums = [0.0; N];
        let mut nis = 0.0;
        for n in 0..N {
            let s = self.rows[n].dot(&c[n]) + self.variance[n];
            // P is positive but for rounding, and R is not small: only NaN can fail here.
            if s <= 0.0 || s.is_nan() {
                return Verdict { nis: f32::INFINITY, accepted: false };
            }
            sums[n] = s;
            let y = innovation[n];
            nis += y * y / s;
            let (done, later) = c.split_at_mut(n + 1);
            for ((c, row), innovation) in later.iter_mut().zip(&self.rows[n + 1..]).zip(&mut innovation[n + 1..]) {
                let shared = row.dot(&done[n]) / s;
                add_multiple(c, -shared, &done[n]);
                *innovation -= y * shared;
            }
        }
        let accepted = nis <= gate;
        if accepted {
            for ((c, y), s) in c.iter().zip(innovation).zip(sums) {
                add_multiple(error, y / s, c);
            }
            covariance.correct(&c, &sums);
        }
        Verdict { nis, accepted }
    }
}
