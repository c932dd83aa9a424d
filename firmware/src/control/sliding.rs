//! Sliding surfaces and reaching laws.
//!
//! With the error `e = desired − actual` a surface is `s = λ e + ė` (Eq. 18–23); a reaching law makes
//! `ṡ = −K sw(s)` (Eq. 16), with `sw` one of the shapes of [`Switching`]. For every shape `s·sw(s) > 0` where
//! s ≠ 0, so V = s²/2 decreases as long as K·|sw(s)| exceeds the disturbance (Eq. 13–14).

use crate::math;
use crate::validate::ConfigError;

/// The shape `sw(s)` of a reaching law.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "kebab-case", deny_unknown_fields)
)]
pub enum Switching {
    /// `sgn(s)`, Eq. 17: reaches s = 0 after |s0|/K, rejects any disturbance below K; chatters when sampled.
    Sgn,
    /// `sat(s/ρ)`: sgn outside a boundary layer of half-width ρ, linear inside. A disturbance D < K leaves
    /// |s| ≤ ρ·D/K. Sampled every h seconds it needs ρ ≥ K·h, or it chatters as sgn does.
    Sat {
        /// Half-width ρ of the boundary layer, in units of s.
        rho: f32,
    },
    /// `tanh(s/ρ)`: smooth everywhere; a disturbance D < K leaves |s| ≤ ρ·artanh(D/K).
    Tanh {
        /// Scale ρ of the layer, in units of s.
        rho: f32,
    },
    /// `|s|^α sgn(s)`, 0 < α < 1 (the power-rate law): reaches s = 0 in |s0|^(1−α)/((1−α)K) without a jump; a
    /// disturbance D leaves |s| ≤ (D/K)^(1/α). Its power is good to 12 %, which moves these figures by as much.
    Power {
        /// Exponent α.
        alpha: f32,
    },
}

/// Gains of one axis: surface slope λ, reaching gain K and shape.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct AxisGains {
    /// Slope λ of the surface, 1/s: on the surface the error decays as e^(−λt).
    pub lambda: f32,
    /// Reaching gain K, in units of s a second.
    pub gain: f32,
    /// Shape of the switching term.
    pub switching: Switching,
}

impl AxisGains {
    /// Gains with the boundary layer `sat(s/ρ)`, in the order of the paper's Table 1.
    pub const fn sat(gain: f32, lambda: f32, rho: f32) -> Self {
        Self { lambda, gain, switching: Switching::Sat { rho } }
    }

    /// The sliding variable `s = λ e + ė` (Eq. 18–23).
    #[inline]
    pub fn surface(&self, error: f32, error_rate: f32) -> f32 {
        self.lambda * error + error_rate
    }

    /// The reaching rate `K sw(s)`.
    #[inline]
    pub fn reach(&self, s: f32) -> f32 {
        match self.switching {
            Switching::Sgn => self.gain * sgn(s),
            // K sat(s/ρ), with the division off the path from s to the result.
            Switching::Sat { rho } => math::clamp(s * (self.gain / rho), -self.gain, self.gain),
            Switching::Tanh { rho } => self.gain * math::tanh(s / rho),
            Switching::Power { alpha } => self.gain * sgn(s) * math::shape_power(math::abs(s), alpha),
        }
    }

    /// Slope `K dsw/ds` where it is of use to a feedforward: the layer's gain inside it, 0 where the law is
    /// flat or jumps.
    #[inline]
    pub fn reach_slope(&self, s: f32) -> f32 {
        match self.switching {
            Switching::Sat { rho } if math::abs(s) < rho => self.gain / rho,
            Switching::Tanh { rho } => {
                let shape = math::tanh(s / rho);
                self.gain / rho * (1.0 - shape * shape)
            }
            _ => 0.0,
        }
    }

    /// `λ ė + K sw(s)`, the part that every law of the paper adds to its equivalent control.
    #[inline]
    pub fn correction(&self, error: f32, error_rate: f32) -> Correction {
        let s = self.surface(error, error_rate);
        Correction { s, acceleration: self.lambda * error_rate + self.reach(s) }
    }

    /// Refuses gains with which the law is not defined.
    ///
    /// # Errors
    /// `name` with what is wrong: λ, K, ρ or α not finite or not positive, or α not below 1.
    pub fn validate(&self, name: &'static str) -> Result<(), ConfigError> {
        ConfigError::require_positive(name, self.lambda)?;
        ConfigError::require_not_negative(name, self.gain)?;
        match self.switching {
            Switching::Sgn => Ok(()),
            Switching::Sat { rho } | Switching::Tanh { rho } => ConfigError::require_positive(name, rho),
            Switching::Power { alpha } => {
                ConfigError::require_positive(name, alpha)?;
                if alpha < 1.0 { Ok(()) } else { Err(ConfigError::OutOfRange(name)) }
            }
        }
    }
}

/// What a sliding mode law asks for beyond its equivalent control.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Correction {
    /// The sliding variable s.
    pub s: f32,
    /// `λ ė + K sw(s)`.
    pub acceleration: f32,
}

/// Eq. 17: 1, 0 or −1.
#[inline]
pub fn sgn(s: f32) -> f32 {
    if s > 0.0 {
        1.0
    } else if s < 0.0 {
        -1.0
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [Switching; 4] =
        [Switching::Sgn, Switching::Sat { rho: 0.5 }, Switching::Tanh { rho: 0.5 }, Switching::Power { alpha: 0.5 }];

    #[test]
    fn every_shape_drives_s_towards_zero_and_is_odd() {
        for switching in SHAPES {
            let gains = AxisGains { lambda: 1.0, gain: 3.0, switching };
            for i in 1..2_000 {
                let s = i as f32 * 0.01;
                assert!(gains.reach(s) > 0.0, "{switching:?} at {s}");
                assert_eq!(gains.reach(s), -gains.reach(-s), "{switching:?} at {s}");
            }
            assert_eq!(gains.reach(0.0), 0.0);
        }
    }

    #[test]
    fn power_law_reaches_zero_in_its_closed_form_time() {
        // |s|^½ from s0 = 4 with K = 2: T = s0^½ / (½·2) = 2 s; micromath's 12 % allows as much.
        let gains = AxisGains { lambda: 1.0, gain: 2.0, switching: Switching::Power { alpha: 0.5 } };
        let (mut s, mut t) = (4.0_f32, 0.0_f32);
        while s > 1e-4 {
            s -= gains.reach(s) * 1e-4;
            t += 1e-4;
        }
        assert!(crate::math::abs(t - 2.0) < 0.24, "{t}");
    }

    #[test]
    fn slope_is_the_derivative_of_the_reaching_rate() {
        for switching in [Switching::Sat { rho: 0.5 }, Switching::Tanh { rho: 0.5 }] {
            let gains = AxisGains { lambda: 1.0, gain: 3.0, switching };
            for s in [-1.2_f32, -0.3, 0.01, 0.2, 0.8] {
                let numeric = (gains.reach(s + 1e-3) - gains.reach(s - 1e-3)) / 2e-3;
                assert!(math::abs(gains.reach_slope(s) - numeric) < 0.02, "{switching:?} at {s}");
            }
        }
    }

    #[test]
    fn a_law_that_is_not_defined_is_refused() {
        assert!(AxisGains::sat(1.0, 0.0, 0.1).validate("k").is_err());
        assert!(AxisGains::sat(1.0, 1.0, f32::NAN).validate("k").is_err());
        let power = AxisGains { lambda: 1.0, gain: 1.0, switching: Switching::Power { alpha: 1.0 } };
        assert_eq!(power.validate("k"), Err(ConfigError::OutOfRange("k")));
    }
}
