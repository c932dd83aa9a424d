//! One axis of the decoupled model under Table 1, in closed form.
//!
//! With Ux, Uy and U1 as direct inputs, Eq. 28–31 cancel the model, and each axis is `ṡ = −K sgn(s)` with `s = λ e + ė`
//! (Eq. 16, 18–23). s comes down from s(0) at the rate K; until it is zero e follows `ė + λ e = s(0) − K t sgn(s)`, and
//! from then on `e = e(t₁) exp(−λ (t − t₁))`.

use firmware::control::sliding::AxisGains;

/// An axis on its way to its reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach {
    /// e at the start, m or rad.
    pub error: f64,
    /// ė at the start, a second.
    pub rate: f64,
    /// λ, 1/s.
    pub lambda: f64,
    /// K.
    pub gain: f64,
}

impl Approach {
    /// Of an axis with gains, from an error and its rate.
    pub fn new(gains: &AxisGains, error: f64, rate: f64) -> Self {
        Self { error, rate, lambda: f64::from(gains.lambda), gain: f64::from(gains.gain) }
    }

    /// s at the start.
    pub fn surface(&self) -> f64 {
        self.lambda * self.error + self.rate
    }

    /// When s is zero, s.
    pub fn reached_s(&self) -> f64 {
        self.surface().abs() / self.gain
    }

    /// e at `t`, s.
    pub fn error_at(&self, t: f64) -> f64 {
        let reached = self.reached_s();
        if t > reached {
            return self.error_at(reached) * libm::exp(-self.lambda * (t - reached));
        }
        let (offset, slope) = self.particular();
        offset + slope * t + (self.error - offset) * libm::exp(-self.lambda * t)
    }

    /// ė at `t`, a second.
    pub fn rate_at(&self, t: f64) -> f64 {
        let s = self.surface() - self.surface().signum() * self.gain * t.min(self.reached_s());
        (if t < self.reached_s() { s } else { 0.0 }) - self.lambda * self.error_at(t)
    }

    /// When |e| falls below `band` for good, s; of a band that e is outside of when s is zero.
    pub fn settled_s(&self, band: f64) -> f64 {
        let reached = self.reached_s();
        reached + libm::log(self.error_at(reached).abs() / band) / self.lambda
    }

    /// Offset and slope of the straight line that `ė + λ e = s(0) − K t sgn(s)` approaches.
    fn particular(&self) -> (f64, f64) {
        let slope = -self.gain * self.surface().signum() / self.lambda;
        ((self.surface() - slope) / self.lambda, slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const Y: Approach = Approach { error: 5.0, rate: 0.0, lambda: 15.05, gain: 334.0 };

    #[test]
    fn the_closed_form_is_the_differential_equation() {
        let h = 1e-6;
        for t in [0.01, 0.1, 0.2, 0.3, 0.5] {
            let rate = (Y.error_at(t + h) - Y.error_at(t - h)) / (2.0 * h);
            assert!((rate - Y.rate_at(t)).abs() < 1e-4, "{t}: {rate} {}", Y.rate_at(t));
            let s = (Y.surface() - Y.gain * t).max(0.0);
            assert!((Y.rate_at(t) + Y.lambda * Y.error_at(t) - s).abs() < 1e-9);
        }
        assert_eq!((Y.error_at(0.0), Y.rate_at(0.0)), (5.0, 0.0));
    }

    #[test]
    fn it_settles_when_its_error_says_so() {
        let t = Y.settled_s(0.05);
        assert!(Y.error_at(t - 1e-6) > 0.05 && Y.error_at(t + 1e-6) < 0.05, "{t}");
    }
}
