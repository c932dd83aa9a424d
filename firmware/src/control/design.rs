//! Gain design from physical bounds: disturbance, authority and response time of an axis.
//!
//! The response time τ of the axis (sampling, delay and actuator lag together) bounds the bandwidth of a loop around
//! it. Inside its boundary layer a sliding mode axis is the loop
//!
//! ```text
//! L(p) = ((1 + λT) p + λ)/(T p²) · e^(−τp)        T: layer's time; λ ė + u_r with u_r = s/T
//! ```
//!
//! With T = 2.5 τ and λ = 1/(4T) it crosses over at 1.27/T with a phase margin of 52°, a gain margin of 3.0 (9.6 dB)
//! and a delay margin of 1.8 τ, for every τ. (Implicit super-twisting, with its integral, has 43°, 2.9 and 1.5 τ; an
//! integral surface 41°, 2.4 and 1.2 τ.) The other gains follow:
//!
//! ```text
//! K = A                       the whole authority: an implicit law does not chatter with it (needs K > D)
//! ρ = K T                     for layers that are specified by their width
//! braking = A − D             the deceleration that remains for a large error
//! k2 = 1.1 L, K = 1.5 √L      super-twisting, L a bound on the disturbance's rate, as Levant (1998) recommends; the
//!                             inequality in the law's docs is sufficient, and would require six times this K
//! ```

use crate::control::sliding::{AxisGains, ReachingLaw, Surface};
use crate::math;
use crate::validate::ConfigError;

/// Reaching law to design.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Design {
    /// Constant rate, smoothed by a layer of width ρ = K T.
    Sat,
    /// The same with tanh.
    Tanh,
    /// Half of the layer's slope comes from an exponential term, which also acts beyond the layer.
    Exponential,
    /// Backward Euler of sgn.
    #[default]
    ImplicitSgn,
    /// Super-twisting, explicit: for an axis that responds within a step.
    SuperTwisting,
    /// Super-twisting by backward Euler.
    ImplicitSuperTwisting,
}

/// Known bounds of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct AxisBounds {
    /// Response time τ, from a measurement to the effect of the resulting command, s.
    pub answer_s: f32,
    /// Greatest disturbance D, in m/s² or rad/s².
    pub disturbance: f32,
    /// Greatest rate of change L of the disturbance, in m/s³ or rad/s³.
    pub disturbance_rate: f32,
    /// Authority A: the greatest acceleration that the actuators can give, in m/s² or rad/s².
    pub authority: f32,
    /// Reaching law.
    #[cfg_attr(feature = "serde", serde(default))]
    pub law: Design,
    /// Sliding surface.
    #[cfg_attr(feature = "serde", serde(default))]
    pub surface: Surface,
}

/// T/τ: the layer's time constant over the response time.
const LAYER_PER_ANSWER: f32 = 2.5;
/// λT: the layer's time constant over the surface's, 1/λ.
const LAYER_PER_SURFACE: f32 = 0.25;

impl AxisBounds {
    /// The gains.
    ///
    /// # Errors
    /// The bound that is not positive, or the disturbance if it is not below the authority: no law can reject it then.
    pub fn gains(&self) -> Result<AxisGains, ConfigError> {
        for (name, value) in [
            ("answer_s", self.answer_s),
            ("disturbance", self.disturbance),
            ("disturbance_rate", self.disturbance_rate),
            ("authority", self.authority),
        ] {
            ConfigError::require_positive(name, value)?;
        }
        ConfigError::require_below("disturbance", self.disturbance, self.authority)?;
        let horizon_s = LAYER_PER_ANSWER * self.answer_s;
        let lambda = LAYER_PER_SURFACE / horizon_s;
        let authority = self.authority;
        let (twist, root_gain) = (1.1 * self.disturbance_rate, 1.5 * math::sqrt(self.disturbance_rate));
        let rho = authority * horizon_s;
        let (gain, reaching) = match self.law {
            Design::Sat => (authority, ReachingLaw::Sat { rho }),
            Design::Tanh => (authority, ReachingLaw::Tanh { rho }),
            Design::Exponential => (authority, ReachingLaw::Exponential { rate: 0.5 / horizon_s, rho: 2.0 * rho }),
            Design::ImplicitSgn => (authority, ReachingLaw::ImplicitSgn { horizon_s }),
            Design::SuperTwisting => (root_gain, ReachingLaw::SuperTwisting { twist }),
            Design::ImplicitSuperTwisting => (root_gain, ReachingLaw::ImplicitSuperTwisting { twist, horizon_s }),
        };
        let braking = authority - self.disturbance;
        Ok(AxisGains { surface: self.surface, braking, ..AxisGains::new(gain, lambda, reaching) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::sliding::SlidingAxis;

    const BOUNDS: AxisBounds = AxisBounds {
        answer_s: 0.007,
        disturbance: 20.0,
        disturbance_rate: 200.0,
        authority: 120.0,
        law: Design::ImplicitSgn,
        surface: Surface::Linear,
    };

    /// The two gains of an axis inside its layer, found by small differences: of e and of ė.
    fn layer_gains(gains: &AxisGains) -> (f64, f64) {
        let small = 1e-4_f32;
        let answer = |e: f32, rate: f32| {
            let mut axis = SlidingAxis::new(gains, 1e-3);
            f64::from(axis.correction(e, rate, false).acceleration) / f64::from(small)
        };
        (answer(small, 0.0), answer(0.0, small))
    }

    #[test]
    fn the_margins_are_those_that_the_text_promises() {
        for law in [Design::ImplicitSgn, Design::Sat] {
            let gains = AxisBounds { law, ..BOUNDS }.gains().expect("valid");
            let (of_error, of_rate) = layer_gains(&gains);
            let tau = f64::from(BOUNDS.answer_s);
            let t = 2.5 * tau;
            // L = (of_rate p + of_error)/p² · e^(−τp).
            let size = |w: f64| (of_rate * of_rate * w * w + of_error * of_error).sqrt() / (w * w);
            let phase = |w: f64| (of_rate * w / of_error).atan() - core::f64::consts::PI - tau * w;
            let crossing = |f: &dyn Fn(f64) -> f64| {
                let (mut low, mut high) = (0.5 / t, 20.0 / t);
                for _ in 0..100 {
                    let middle = 0.5 * (low + high);
                    if f(middle) > 0.0 { low = middle } else { high = middle }
                }
                low
            };
            let crossover = crossing(&|w| size(w) - 1.0);
            let margin = phase(crossover) + core::f64::consts::PI;
            assert!((crossover * t - 1.27).abs() < 0.01, "{law:?}: {}", crossover * t);
            assert!((margin.to_degrees() - 52.0).abs() < 0.5, "{law:?}: {}", margin.to_degrees());
            let turn = crossing(&|w| phase(w) + core::f64::consts::PI);
            assert!((1.0 / size(turn) - 3.03).abs() < 0.03, "{law:?}: {}", 1.0 / size(turn));
            assert!((margin / crossover / tau - 1.79).abs() < 0.02, "{law:?}: {}", margin / crossover / tau);
        }
    }

    #[test]
    fn every_design_is_valid_and_a_disturbance_beyond_the_authority_is_refused() {
        for law in [
            Design::Sat,
            Design::Tanh,
            Design::Exponential,
            Design::ImplicitSgn,
            Design::SuperTwisting,
            Design::ImplicitSuperTwisting,
        ] {
            let gains = AxisBounds { law, ..BOUNDS }.gains().expect("valid");
            assert_eq!(gains.validate("roll"), Ok(()));
        }
        let weak = AxisBounds { authority: 20.0, ..BOUNDS };
        assert_eq!(weak.gains(), Err(ConfigError::NotBelow("disturbance".into(), 20.0)));
    }
}
