//! Gains of a sliding mode axis: the configuration from which [`SlidingAxis`](super::sliding::SlidingAxis) is built.
//!
//! [`ReachingLaw`] is the family of `u_r`, each with its guarantee; [`AxisGains`] adds the surface and the gain K.
//! [`AxisNumber`] names the numbers among them one by one, with the range of each: validation and settings share it.

use crate::signals::TICK_S;
use crate::validate::{ConfigError, Field, Range};

/// A reaching law `u_r(s)`, selectable per axis at run time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "kebab-case", deny_unknown_fields)
)]
pub enum ReachingLaw {
    /// `K sgn(s)`, Eq. 17. For K > D: V̇ ≤ −(K − D)|s|, so s = 0 after |s0|/(K − D) for any such disturbance, with no
    /// residual error. Sampled every h seconds it chatters by K h.
    Sgn,
    /// `K sat(s/ρ)`: sgn outside a boundary layer of half-width ρ, linear inside. For K > D: V̇ < 0 for |s| > ρ D/K,
    /// which is the residual error. Sampled every h seconds it needs ρ ≥ K h not to overshoot, and ρ > K h/2 not to
    /// chatter as sgn does.
    Sat {
        /// Half-width ρ of the boundary layer, in units of s.
        rho: f32,
    },
    /// `K tanh(s/ρ)`: smooth everywhere. For K > D: V̇ < 0 for |s| > ρ artanh(D/K), which is the residual error.
    Tanh {
        /// Scale ρ of the layer, in units of s.
        rho: f32,
    },
    /// `K |s|^α sgn(s)`, 0 < α < 1 (the power-rate law): reaches s = 0 in |s0|^(1−α)/((1−α)K) without a jump; V̇ < 0 for
    /// |s| > (D/K)^(1/α). The power is computed to 12 %, which changes the reaching time by as much and the residual error
    /// by 12 %/α.
    Power {
        /// Exponent α.
        alpha: f32,
    },
    /// `K sat(s/ρ) + q s` (exponential reaching, Gao and Hung 1993): far out V̇ ≤ −2 q V, so s decays as e^(−qt)
    /// instead of at the constant rate K; close in it acts as [`Sat`](Self::Sat), with a residual of |s| ≤ ρ D/(K + q
    /// ρ).
    Exponential {
        /// Rate q, 1/s.
        rate: f32,
        /// Half-width ρ of the boundary layer, in units of s.
        rho: f32,
    },
    /// Set-valued sgn by backward Euler (Acary and Brogliato 2010): the u of `s⁺ = s − T u, u ∈ K sgn(s⁺)`, which is
    /// `s/T` limited to ±K. With T the sampling step and K > D: s reaches |s| ≤ T D in a finite number of steps and
    /// stays, without chattering, however large K is. If the actuator responds later than within a step, T is its
    /// response time: sampling, delay and lag together.
    ImplicitSgn {
        /// T, s.
        horizon_s: f32,
    },
    /// `K √|s| sgn(s) + v, v̇ = k2 sgn(s)` (super-twisting, Levant 1993), explicit Euler. With k2 > L and
    /// K² ≥ 4 L (k2 + L)/(k2 − L) both s and ṡ reach 0 in finite time (strict Lyapunov function: Moreno and Osorio 2012), whatever
    /// the size of d. Sampled, its residual is |s| of order h², and it chatters by k2 h.
    SuperTwisting {
        /// k2, in units of s per second squared.
        twist: f32,
    },
    /// Super-twisting by backward Euler (after Brogliato, Polyakov and Efimov 2020), v taken as the estimate of the
    /// disturbance: with `u = v + w`, w solves `s⁺ = s − T w, w ∈ K √|s⁺| sgn(s⁺) + 4T k2 sgn(s⁺)`, and `v̇ ∈ k2
    /// sgn(s⁺)`. No chattering; where |s| ≤ 4T² k2 it is `s/T + ∫s/(4T²)`, two poles at −1/(2T), so a constant
    /// disturbance leaves no error (with a weight of T alone, the poles would lie on the unit circle for T = h). T as
    /// for [`ImplicitSgn`](Self::ImplicitSgn).
    ImplicitSuperTwisting {
        /// k2, in units of s per second squared.
        twist: f32,
        /// T, s.
        horizon_s: f32,
    },
}

/// The sliding surface of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Surface {
    /// `s = λ e + ė` (Eq. 18–23): on it the error decays as e^(−λt).
    #[default]
    Linear,
    /// `s = ė + 2λ e + λ² ∫e − (ė + 2λ e)(0)` (integral SMC, Utkin and Shi 1996): s = 0 from the first moment, so the
    /// bound on the disturbance holds without a reaching phase; on it the error decays with a double pole at −λ, and a
    /// constant disturbance leaves no error.
    Integral,
}

/// Gains of one axis: surface, reaching gain K and reaching law.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct AxisGains {
    /// Slope λ of the surface, 1/s.
    pub lambda: f32,
    /// Reaching gain K, in units of s per second; for super-twisting in units of √s per second.
    pub gain: f32,
    /// Reaching law.
    pub reaching: ReachingLaw,
    /// Form of the surface.
    #[cfg_attr(feature = "serde", serde(default))]
    pub surface: Surface,
    /// Limit on λ e of a linear surface: the greatest rate at which a large error is reduced, in units of s.
    #[cfg_attr(feature = "serde", serde(default = "unlimited"))]
    pub approach_max: f32,
    /// Greatest deceleration A along a linear surface, in units of s per second: beyond |e| = A/λ², λ|e| is replaced by
    /// the parabola √(2A|e| − (A/λ)²), on which the error is braked by A until it is small, as on the switching curve
    /// of the time-optimal double integrator.
    #[cfg_attr(feature = "serde", serde(default = "unlimited"))]
    pub braking: f32,
}

/// A limit that never acts.
const fn unlimited() -> f32 {
    1e9
}

impl ReachingLaw {
    /// The greatest [`code`](Self::code).
    pub const CODE_MAX: i32 = 7;

    /// Number of the law, for a setting.
    pub const fn code(&self) -> i32 {
        match self {
            Self::Sgn => 0,
            Self::Sat { .. } => 1,
            Self::Tanh { .. } => 2,
            Self::Power { .. } => 3,
            Self::Exponential { .. } => 4,
            Self::ImplicitSgn { .. } => 5,
            Self::SuperTwisting { .. } => 6,
            Self::ImplicitSuperTwisting { .. } => 7,
        }
    }

    /// The law of a code, with the default of each of its numbers; sgn for an unknown code.
    pub const fn of_code(code: i32) -> Self {
        let [rho, alpha, rate] =
            [AxisNumber::Rho.default_shape(), AxisNumber::Alpha.default_shape(), AxisNumber::Rate.default_shape()];
        let [twist, horizon_s] = [AxisNumber::Twist.default_shape(), AxisNumber::Horizon.default_shape()];
        match code {
            1 => Self::Sat { rho },
            2 => Self::Tanh { rho },
            3 => Self::Power { alpha },
            4 => Self::Exponential { rate, rho },
            5 => Self::ImplicitSgn { horizon_s },
            6 => Self::SuperTwisting { twist },
            7 => Self::ImplicitSuperTwisting { twist, horizon_s },
            _ => Self::Sgn,
        }
    }
}

impl Surface {
    /// Number of the form, for a setting.
    pub const fn code(self) -> i32 {
        match self {
            Self::Linear => 0,
            Self::Integral => 1,
        }
    }

    /// The form of a code.
    pub const fn of_code(code: i32) -> Self {
        if code == 1 { Self::Integral } else { Self::Linear }
    }
}

/// A number of an axis' gains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisNumber {
    /// λ.
    Lambda,
    /// Limit on λ e.
    ApproachMax,
    /// Greatest deceleration along the surface.
    Braking,
    /// K.
    Gain,
    /// Half-width ρ of the boundary layer.
    Rho,
    /// Exponent α.
    Alpha,
    /// Rate q of exponential reaching.
    Rate,
    /// k2 of super-twisting.
    Twist,
    /// Horizon T of the implicit laws.
    Horizon,
}

impl AxisNumber {
    /// In the order in which they are checked.
    const ALL: [Self; 9] = [
        Self::Lambda,
        Self::ApproachMax,
        Self::Braking,
        Self::Gain,
        Self::Rho,
        Self::Alpha,
        Self::Rate,
        Self::Twist,
        Self::Horizon,
    ];

    /// The values for which every law is defined, and that a sampled loop can have: a surface is no faster than some of its
    /// steps, and a horizon no shorter than one.
    pub const fn range(self) -> Range {
        match self {
            Self::Gain => Range::NotNegative,
            Self::Alpha => Range::PositiveBelow(1.0),
            Self::Lambda => Range::Within(1e-3, 100.0),
            Self::Horizon => Range::Within(TICK_S, 1e3),
            _ => Range::Positive,
        }
    }

    /// A reaching law's number until it is set, where the law did not have it before; 0 for the others. Chosen: a
    /// boundary layer that does not chatter with usual gains, the square root, a decay within a second, and a horizon of
    /// ten ticks.
    pub const fn default_shape(self) -> f32 {
        match self {
            Self::Rho | Self::Alpha => 0.5,
            Self::Rate | Self::Twist => 1.0,
            Self::Horizon => 0.01,
            _ => 0.0,
        }
    }

    /// The key within an axis, whatever its law.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lambda => "lambda",
            Self::ApproachMax => "approach_max",
            Self::Braking => "braking",
            Self::Gain => "gain",
            Self::Rho => "reaching.*.rho",
            Self::Alpha => "reaching.power.alpha",
            Self::Rate => "reaching.exponential.rate",
            Self::Twist => "reaching.*.twist",
            Self::Horizon => "reaching.*.horizon_s",
        }
    }

    /// The key within an axis with this law.
    fn key(self, law: &ReachingLaw) -> &'static str {
        match (self, law) {
            (Self::Rho, ReachingLaw::Sat { .. }) => "reaching.sat.rho",
            (Self::Rho, ReachingLaw::Tanh { .. }) => "reaching.tanh.rho",
            (Self::Rho, _) => "reaching.exponential.rho",
            (Self::Twist, ReachingLaw::SuperTwisting { .. }) => "reaching.super-twisting.twist",
            (Self::Twist, _) => "reaching.implicit-super-twisting.twist",
            (Self::Horizon, ReachingLaw::ImplicitSgn { .. }) => "reaching.implicit-sgn.horizon_s",
            (Self::Horizon, _) => "reaching.implicit-super-twisting.horizon_s",
            _ => self.name(),
        }
    }
}

impl AxisGains {
    /// Gains with any reaching law, on a linear surface without limits.
    pub const fn new(gain: f32, lambda: f32, reaching: ReachingLaw) -> Self {
        Self { lambda, gain, reaching, surface: Surface::Linear, approach_max: unlimited(), braking: unlimited() }
    }

    /// Gains with the boundary layer `sat(s/ρ)`, in the order of the paper's Table 1.
    pub const fn sat(gain: f32, lambda: f32, rho: f32) -> Self {
        Self::new(gain, lambda, ReachingLaw::Sat { rho })
    }

    /// Chooses the reaching law of a code; another than the present one begins with default numbers.
    pub fn choose_law(&mut self, code: i32) {
        if code != self.reaching.code() {
            self.reaching = ReachingLaw::of_code(code);
        }
    }

    /// A number of these gains; `None` if their reaching law does not have it.
    pub fn number(&self, number: AxisNumber) -> Option<f32> {
        let mut copy = *self;
        copy.number_mut(number).copied()
    }

    /// The same, to be changed.
    pub fn number_mut(&mut self, number: AxisNumber) -> Option<&mut f32> {
        use ReachingLaw as Law;
        match (number, &mut self.reaching) {
            (AxisNumber::Lambda, _) => Some(&mut self.lambda),
            (AxisNumber::Gain, _) => Some(&mut self.gain),
            (AxisNumber::ApproachMax, _) => Some(&mut self.approach_max),
            (AxisNumber::Braking, _) => Some(&mut self.braking),
            (AxisNumber::Rho, Law::Sat { rho } | Law::Tanh { rho } | Law::Exponential { rho, .. }) => Some(rho),
            (AxisNumber::Alpha, Law::Power { alpha }) => Some(alpha),
            (AxisNumber::Rate, Law::Exponential { rate, .. }) => Some(rate),
            (AxisNumber::Twist, Law::SuperTwisting { twist } | Law::ImplicitSuperTwisting { twist, .. }) => Some(twist),
            (AxisNumber::Horizon, Law::ImplicitSgn { horizon_s } | Law::ImplicitSuperTwisting { horizon_s, .. }) => {
                Some(horizon_s)
            }
            _ => None,
        }
    }

    /// Checks that the law is defined for these gains.
    ///
    /// # Errors
    /// The field of the axis `group` and what is wrong with it: a number that is not finite or not positive, or α not
    /// below 1.
    pub fn validate(&self, group: &'static str) -> Result<(), ConfigError> {
        for number in AxisNumber::ALL {
            if let Some(value) = self.number(number) {
                number.range().check(Field::of(group, number.key(&self.reaching)), value)?;
            }
        }
        Ok(())
    }
}
