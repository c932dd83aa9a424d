//! Sliding surfaces and reaching laws: one axis of a sliding mode controller.
//!
//! With the error `e = desired − actual` a surface is `s = λ e + ė` (Eq. 18–23). A reaching law makes `ṡ = −u_r(s)`
//! (Eq. 16), and a disturbance d of the axis' acceleration turns that into `ṡ = −u_r(s) − d`.
//!
//! [`ReachingLaw`] is the family of `u_r`, each with its guarantee. [`AxisGains`] is the configuration of an axis,
//! [`SlidingAxis`] its loop form with the state. `K` is [`AxisGains::gain`], D a bound on |d|, L a bound on |ḋ|, V =
//! s²/2.
//!
//! ```
//! use firmware::control::sliding::{AxisGains, ReachingLaw, SlidingAxis};
//!
//! // ë = −(correction) − d, sampled at 1 kHz, with a disturbance of half the reaching gain.
//! let (step_s, gain, lambda, disturbance) = (1e-3, 4.0, 2.0, 2.0);
//! let gains = AxisGains::new(gain, lambda, ReachingLaw::ImplicitSgn { horizon_s: step_s });
//! gains.validate("roll").expect("in range");
//! let mut axis = SlidingAxis::new(&gains, step_s);
//!
//! let (mut error, mut error_rate) = (0.5_f32, 0.0_f32);
//! for _ in 0..5_000 {
//!     let correction = axis.correction(error, error_rate, false);
//!     error_rate -= (correction.acceleration + disturbance) * step_s;
//!     error += error_rate * step_s;
//! }
//! // On the surface within T·D, as the law promises, so |e| ≤ T·D/λ.
//! let s = lambda * error + error_rate;
//! assert!(s.abs() < 1.1 * step_s * disturbance, "{s}");
//! assert!(error.abs() < 2.0 * step_s * disturbance / lambda, "{error}");
//! ```

use crate::math;
use crate::validate::{ConfigError, Field};

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

impl AxisGains {
    /// Gains with any reaching law, on a linear surface without limits.
    pub const fn new(gain: f32, lambda: f32, reaching: ReachingLaw) -> Self {
        Self { lambda, gain, reaching, surface: Surface::Linear, approach_max: unlimited(), braking: unlimited() }
    }

    /// Gains with the boundary layer `sat(s/ρ)`, in the order of the paper's Table 1.
    pub const fn sat(gain: f32, lambda: f32, rho: f32) -> Self {
        Self::new(gain, lambda, ReachingLaw::Sat { rho })
    }

    /// Checks that the law is defined for these gains.
    ///
    /// # Errors
    /// The field of the axis `group` and what is wrong with it: a number that is not finite or not positive, or α not
    /// below 1.
    pub fn validate(&self, group: &'static str) -> Result<(), ConfigError> {
        let positive = |name, value| ConfigError::require_positive(Field::of(group, name), value);
        positive("lambda", self.lambda)?;
        positive("approach_max", self.approach_max)?;
        positive("braking", self.braking)?;
        ConfigError::require_not_negative(Field::of(group, "gain"), self.gain)?;
        match self.reaching {
            ReachingLaw::Sgn => Ok(()),
            ReachingLaw::Sat { rho } => positive("reaching.sat.rho", rho),
            ReachingLaw::Tanh { rho } => positive("reaching.tanh.rho", rho),
            ReachingLaw::Exponential { rate, rho } => {
                positive("reaching.exponential.rate", rate).and(positive("reaching.exponential.rho", rho))
            }
            ReachingLaw::ImplicitSgn { horizon_s } => positive("reaching.implicit-sgn.horizon_s", horizon_s),
            ReachingLaw::SuperTwisting { twist } => positive("reaching.super-twisting.twist", twist),
            ReachingLaw::ImplicitSuperTwisting { twist, horizon_s } => {
                positive("reaching.implicit-super-twisting.twist", twist)?;
                positive("reaching.implicit-super-twisting.horizon_s", horizon_s)
            }
            ReachingLaw::Power { alpha } => {
                positive("reaching.power.alpha", alpha)?;
                ConfigError::require_below(Field::of(group, "reaching.power.alpha"), alpha, 1.0)
            }
        }
    }
}

/// A reaching law in loop form, without divisions.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Reach {
    Sgn,
    /// `slope·s` limited to ±K: sat, and sgn by backward Euler.
    Layer {
        slope: f32,
    },
    Tanh {
        per_rho: f32,
    },
    Power {
        alpha: f32,
    },
    Exponential {
        slope: f32,
        rate: f32,
    },
    SuperTwisting {
        twist_step: f32,
    },
    ImplicitSuperTwisting(Twist),
}

/// Backward Euler of super-twisting, with T the horizon and h the step.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Twist {
    /// 4T² k2: where |s| is below, s⁺ = 0.
    inside: f32,
    /// Its inverse.
    per_inside: f32,
    /// 4T k2 and h k2.
    over_horizon: f32,
    over_step: f32,
    /// T K/2.
    half_horizon_gain: f32,
}

impl Twist {
    /// w and the change of v.
    #[inline]
    fn solve(&self, gain: f32, s: f32) -> (f32, f32) {
        let sign = math::limit(s * self.per_inside, 1.0);
        let beyond = math::abs(s) - self.inside;
        let mut w = self.over_horizon * sign;
        if beyond > 0.0 {
            // r = √|s⁺| solves r² + T K r = |s| − 4T² k2.
            let half = self.half_horizon_gain;
            let root = math::sqrt(half * half + beyond) - half;
            w += gain * root * sign;
        }
        (w, self.over_step * sign)
    }
}

/// `most` with the sign of `x`. A separate function, because inlined the compiler would compute both sides every time.
#[cold]
#[inline(never)]
fn bound(x: f32, most: f32) -> f32 {
    if x > 0.0 { most } else { -most }
}

/// The rate at which a large error is reduced, as a function of the error, with two derivatives.
struct Approach {
    rate: f32,
    slope: f32,
    curvature: f32,
}

/// What a sliding mode law adds to its equivalent control.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Correction {
    /// The sliding variable s.
    pub s: f32,
    /// `λ ė + u_r(s)`.
    pub acceleration: f32,
}

/// One axis in the loop: its gains in loop form, and its state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlidingAxis {
    lambda: f32,
    gain: f32,
    /// Greatest λ|e| in the linear range.
    linear_max: f32,
    approach_max: f32,
    braking: f32,
    /// Whether the braking parabola begins below `approach_max`.
    brakes: bool,
    reach: Reach,
    surface: Surface,
    /// Slope of the boundary layer, for [`ReachingLaw::ImplicitSgn`] and [`ReachingLaw::Sat`] on a linear surface.
    layer: Option<f32>,
    step_s: f32,
    /// v of super-twisting.
    twist: f32,
    /// `λ² ∫e − (ė + 2λ e)(0)` of the integral surface; `None` before the first step.
    integral: Option<f32>,
}

impl SlidingAxis {
    /// An axis that is evaluated every `step_s` seconds, with valid gains.
    pub fn new(gains: &AxisGains, step_s: f32) -> Self {
        let k = gains.gain;
        let reach = match gains.reaching {
            ReachingLaw::Sgn => Reach::Sgn,
            ReachingLaw::Sat { rho } => Reach::Layer { slope: k / rho },
            ReachingLaw::ImplicitSgn { horizon_s } => Reach::Layer { slope: 1.0 / horizon_s },
            ReachingLaw::Tanh { rho } => Reach::Tanh { per_rho: 1.0 / rho },
            ReachingLaw::Power { alpha } => Reach::Power { alpha },
            ReachingLaw::Exponential { rate, rho } => Reach::Exponential { slope: k / rho, rate },
            ReachingLaw::SuperTwisting { twist } => Reach::SuperTwisting { twist_step: twist * step_s },
            ReachingLaw::ImplicitSuperTwisting { twist, horizon_s } => {
                let inside = 4.0 * horizon_s * horizon_s * twist;
                Reach::ImplicitSuperTwisting(Twist {
                    inside,
                    per_inside: 1.0 / inside,
                    over_horizon: 4.0 * horizon_s * twist,
                    over_step: step_s * twist,
                    half_horizon_gain: 0.5 * horizon_s * k,
                })
            }
        };
        let AxisGains { lambda, gain, approach_max, braking, surface, .. } = *gains;
        let linear_max = math::min(approach_max, braking / lambda);
        let layer = match (surface, reach) {
            (Surface::Linear, Reach::Layer { slope }) => Some(slope),
            _ => None,
        };
        Self {
            lambda,
            gain,
            linear_max,
            approach_max,
            braking,
            brakes: linear_max < approach_max,
            reach,
            surface,
            layer,
            step_s,
            twist: 0.0,
            integral: None,
        }
    }

    /// Clears the integrators.
    pub fn reset(&mut self) {
        self.twist = 0.0;
        self.integral = None;
    }

    /// `λ ė + u_r(s)`, the term that every law of the paper adds to its equivalent control, for e and ė.
    ///
    /// `hold` freezes the integrators while the actuator is saturated (anti-windup).
    #[inline]
    pub fn correction(&mut self, error: f32, error_rate: f32, hold: bool) -> Correction {
        self.correction_along(error, error_rate, error_rate, hold)
    }

    /// The same where the derivative of the error differs from the velocity error, as on the rotation group: the
    /// surface is `s = λ e + velocity_error`, and its derivative contains `λ ė`.
    #[inline]
    pub fn correction_along(&mut self, error: f32, error_rate: f32, velocity_error: f32, hold: bool) -> Correction {
        if let Some(slope) = self.layer {
            let (s, equivalent) = self.linear_surface(error, error_rate, velocity_error);
            return Correction { s, acceleration: equivalent + math::limit(slope * s, self.gain) };
        }
        self.correction_otherwise(error, error_rate, velocity_error, hold)
    }

    /// The same for any surface and reaching law; a separate function, so that the usual case stays small.
    #[inline(never)]
    fn correction_otherwise(&mut self, error: f32, error_rate: f32, velocity_error: f32, hold: bool) -> Correction {
        let (s, equivalent) = match self.surface {
            Surface::Linear => self.linear_surface(error, error_rate, velocity_error),
            Surface::Integral => self.integral_surface(error, error_rate, velocity_error, hold),
        };
        Correction { s, acceleration: equivalent + self.reach(s, hold) }
    }

    /// s, and the derivative of its term λ e.
    #[inline]
    fn linear_surface(&self, error: f32, error_rate: f32, velocity_error: f32) -> (f32, f32) {
        let approach = self.lambda * error;
        if math::abs(approach) <= self.linear_max {
            (approach + velocity_error, self.lambda * error_rate)
        } else if self.brakes {
            let Approach { rate, slope, .. } = self.approach(error);
            (rate + velocity_error, slope * error_rate)
        } else {
            // At the limit, the term is constant.
            (bound(approach, self.approach_max) + velocity_error, 0.0)
        }
    }

    /// The rate of approach for a large error. A separate function, because inlined it would be computed every time.
    #[cold]
    #[inline(never)]
    fn approach(&self, error: f32) -> Approach {
        let (a, e) = (self.braking, math::abs(error));
        let sign = sgn(error);
        let from_linear = a / self.lambda;
        let square = 2.0 * a * e - from_linear * from_linear;
        // Before the parabola begins, or above the limit, the constant limit acts.
        if e * self.lambda < from_linear || square >= self.approach_max * self.approach_max {
            return Approach { rate: sign * self.approach_max, slope: 0.0, curvature: 0.0 };
        }
        let rate = math::sqrt(square);
        let slope = a / rate;
        Approach { rate: sign * rate, slope, curvature: -sign * slope * slope / rate }
    }

    fn integral_surface(&mut self, error: f32, error_rate: f32, velocity_error: f32, hold: bool) -> (f32, f32) {
        let proportional = velocity_error + 2.0 * self.lambda * error;
        let integral = self.integral.unwrap_or(-proportional);
        let change = self.lambda * self.lambda * error;
        self.integral = Some(if hold { integral } else { integral + change * self.step_s });
        (proportional + integral, 2.0 * self.lambda * error_rate + change)
    }

    /// `u_r(s)`.
    fn reach(&mut self, s: f32, hold: bool) -> f32 {
        let k = self.gain;
        let (rate, twist) = match self.reach {
            Reach::Layer { slope } => return math::limit(s * slope, k),
            Reach::Sgn => return k * sgn(s),
            Reach::Tanh { per_rho } => return k * math::tanh(s * per_rho),
            Reach::Power { alpha } => return k * sgn(s) * math::shape_power(math::abs(s), alpha),
            Reach::Exponential { slope, rate } => return math::limit(s * slope, k) + rate * s,
            Reach::SuperTwisting { twist_step } => (k * math::sqrt(math::abs(s)) * sgn(s), twist_step * sgn(s)),
            Reach::ImplicitSuperTwisting(twist) => twist.solve(k, s),
        };
        let u = rate + self.twist;
        if !hold {
            self.twist += twist;
        }
        u
    }

    /// Slope `du_r/ds` for feedforward: the gain inside the boundary layer, 0 where the law is constant or jumps.
    #[inline]
    fn reach_slope(&self, s: f32) -> f32 {
        match self.reach {
            Reach::Layer { slope } if math::abs(s * slope) < self.gain => slope,
            Reach::Tanh { per_rho } => {
                let shape = math::tanh(s * per_rho);
                self.gain * per_rho * (1.0 - shape * shape)
            }
            Reach::Exponential { slope, rate } => rate + if math::abs(s * slope) < self.gain { slope } else { 0.0 },
            Reach::ImplicitSuperTwisting(twist) if math::abs(s) < twist.inside => twist.over_horizon * twist.per_inside,
            _ => 0.0,
        }
    }

    /// Derivative of the [`correction`](Self::correction) that returned `s`, for e, ė and ë.
    #[inline]
    pub fn correction_rate(&self, s: f32, error: f32, error_rate: f32, error_acceleration: f32) -> f32 {
        if let Some(slope) = self.layer {
            let slope = if math::abs(s * slope) < self.gain { slope } else { 0.0 };
            return self.linear_rate(slope, error, error_rate, error_acceleration);
        }
        self.correction_rate_otherwise(s, error, error_rate, error_acceleration)
    }

    /// The same for any surface and reaching law.
    #[inline(never)]
    fn correction_rate_otherwise(&self, s: f32, error: f32, error_rate: f32, error_acceleration: f32) -> f32 {
        let slope = self.reach_slope(s);
        match self.surface {
            Surface::Linear => self.linear_rate(slope, error, error_rate, error_acceleration),
            Surface::Integral => {
                let (twice, square) = (2.0 * self.lambda, self.lambda * self.lambda);
                let equivalent_rate = twice * error_acceleration + square * error_rate;
                equivalent_rate + slope * (error_acceleration + twice * error_rate + square * error)
            }
        }
    }

    #[inline]
    fn linear_rate(&self, slope: f32, error: f32, error_rate: f32, error_acceleration: f32) -> f32 {
        if math::abs(self.lambda * error) <= self.linear_max {
            let lambda = self.lambda;
            return lambda * error_acceleration + slope * (lambda * error_rate + error_acceleration);
        }
        let approach = self.approach(error);
        approach.slope * error_acceleration
            + approach.curvature * error_rate * error_rate
            + slope * (approach.slope * error_rate + error_acceleration)
    }
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
