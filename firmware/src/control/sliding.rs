//! Sliding surfaces and reaching laws: one axis of a sliding mode controller.
//!
//! With the error `e = desired − actual` a surface is `s = λ e + ė` (Eq. 18–23); a reaching law makes
//! `ṡ = −u_r(s)` (Eq. 16), and a disturbance d of the axis' acceleration turns that into `ṡ = −u_r(s) − d`.
//! [`ReachingLaw`] is the family of `u_r`, each with what it guarantees; [`AxisGains`] is an axis as configured,
//! [`SlidingAxis`] the same built into the form the loop uses, with its state. `K` is [`AxisGains::gain`], D a bound
//! on |d|, L one on |ḋ|, V = s²/2.

use crate::math;
use crate::validate::{ConfigError, Field};

/// A reaching law `u_r(s)`, selectable an axis at run time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "kebab-case", deny_unknown_fields)
)]
pub enum ReachingLaw {
    /// `K sgn(s)`, Eq. 17. K > D: V̇ ≤ −(K − D)|s|, so s = 0 after |s0|/(K − D), for any such disturbance, without a
    /// remaining error. Sampled every h seconds it chatters by K h.
    Sgn,
    /// `K sat(s/ρ)`: sgn outside a boundary layer of half-width ρ, linear inside. K > D: V̇ < 0 for |s| > ρ D/K, which is
    /// the error that remains. Sampled every h seconds it needs ρ ≥ K h not to overshoot, and ρ > K h/2 not to chatter as
    /// sgn does.
    Sat {
        /// Half-width ρ of the boundary layer, in units of s.
        rho: f32,
    },
    /// `K tanh(s/ρ)`: smooth everywhere. K > D: V̇ < 0 for |s| > ρ artanh(D/K), which is the error that remains.
    Tanh {
        /// Scale ρ of the layer, in units of s.
        rho: f32,
    },
    /// `K |s|^α sgn(s)`, 0 < α < 1 (the power-rate law): reaches s = 0 in |s0|^(1−α)/((1−α)K) without a jump; V̇ < 0 for
    /// |s| > (D/K)^(1/α). Its power is good to 12 %, which moves the time by as much and the
    /// error by 12 %/α.
    Power {
        /// Exponent α.
        alpha: f32,
    },
    /// `K sat(s/ρ) + q s` (exponential reaching, Gao and Hung 1993): far out V̇ ≤ −2 q V, so s comes down as e^(−qt)
    /// and not at the constant rate K; close in as [`Sat`](Self::Sat), which leaves |s| ≤ ρ D/(K + q ρ).
    Exponential {
        /// Rate q, 1/s.
        rate: f32,
        /// Half-width ρ of the boundary layer, in units of s.
        rho: f32,
    },
    /// Set-valued sgn by backward Euler (Acary and Brogliato 2010): the u of `s⁺ = s − T u, u ∈ K sgn(s⁺)`, which is
    /// `s/T` limited to ±K. With T the sampling step and K > D: s reaches |s| ≤ T D in a finite number of steps and
    /// stays, without chattering, however large K is. Where the actuator answers later than a step, T is the time it
    /// takes: sampling, delay and lag together.
    ImplicitSgn {
        /// T, s.
        horizon_s: f32,
    },
    /// `K √|s| sgn(s) + v, v̇ = k2 sgn(s)` (super-twisting, Levant 1993), explicit Euler. With k2 > L and
    /// K² ≥ 4 L (k2 + L)/(k2 − L) both s and ṡ reach 0 in finite time (strict Lyapunov function: Moreno and Osorio
    /// 2012), whatever the size of d. Sampled it leaves |s| of the order of h², and chatters by k2 h.
    SuperTwisting {
        /// k2, in units of s a second squared.
        twist: f32,
    },
    /// Super-twisting by backward Euler (after Brogliato, Polyakov and Efimov 2020), v taken as the estimate of the
    /// disturbance: with `u = v + w`, w solves `s⁺ = s − T w, w ∈ K √|s⁺| sgn(s⁺) + 4T k2 sgn(s⁺)`, and
    /// `v̇ ∈ k2 sgn(s⁺)`. No chattering; where |s| ≤ 4T² k2 it is `s/T + ∫s/(4T²)`, two poles at −1/(2T), so a constant
    /// disturbance leaves no error (weighed over T alone, the poles would lie on the unit circle for T = h). T as for
    /// [`ImplicitSgn`](Self::ImplicitSgn).
    ImplicitSuperTwisting {
        /// k2, in units of s a second squared.
        twist: f32,
        /// T, s.
        horizon_s: f32,
    },
}

/// The sliding surface of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Surface {
    /// `s = λ e + ė` (Eq. 18–23): on it the error dies as e^(−λt).
    #[default]
    Linear,
    /// `s = ė + 2λ e + λ² ∫e − (ė + 2λ e)(0)` (integral SMC, Utkin and Shi 1996): s = 0 from the first moment, so the
    /// bound on the disturbance holds without a reaching phase; on it the error dies with a double pole at −λ, and a
    /// constant disturbance leaves no error.
    Integral,
}

/// Gains of one axis: surface, reaching gain K and reaching law.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct AxisGains {
    /// Slope λ of the surface, 1/s.
    pub lambda: f32,
    /// Reaching gain K, in units of s a second; for super-twisting a second for each √s.
    pub gain: f32,
    /// Reaching law.
    pub reaching: ReachingLaw,
    /// Form of the surface.
    #[cfg_attr(feature = "serde", serde(default))]
    pub surface: Surface,
    /// On a linear surface, λ e is limited to this: the greatest rate at which a large error is taken back, in
    /// units of s.
    #[cfg_attr(feature = "serde", serde(default = "unlimited"))]
    pub approach_max: f32,
    /// On a linear surface, the greatest deceleration A along it, in units of s a second: from |e| = A/λ² on, λ|e| gives
    /// way to the parabola √(2A|e| − (A/λ)²), on which the error is braked by A until it is small, as on the switching
    /// curve of the time-optimal double integrator.
    #[cfg_attr(feature = "serde", serde(default = "unlimited"))]
    pub braking: f32,
}

/// No error is taken back faster than this.
const fn unlimited() -> f32 {
    1e9
}

impl AxisGains {
    /// Gains with a reaching law of one's own, on a linear surface without a limit.
    pub const fn new(gain: f32, lambda: f32, reaching: ReachingLaw) -> Self {
        Self { lambda, gain, reaching, surface: Surface::Linear, approach_max: unlimited(), braking: unlimited() }
    }

    /// Gains with the boundary layer `sat(s/ρ)`, in the order of the paper's Table 1.
    pub const fn sat(gain: f32, lambda: f32, rho: f32) -> Self {
        Self::new(gain, lambda, ReachingLaw::Sat { rho })
    }

    /// Refuses gains with which the law is not defined.
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

/// A reaching law as the loop uses it: no division left.
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

/// ±`most`, on the side of `x`. A call of its own, or the compiler would have both sides computed every time.
#[cold]
#[inline(never)]
fn bound(x: f32, most: f32) -> f32 {
    if x > 0.0 { most } else { -most }
}

/// The rate at which a large error is approached, as a function of the error, with two derivatives.
struct Approach {
    rate: f32,
    slope: f32,
    curvature: f32,
}

/// What a sliding mode law asks for beyond its equivalent control.
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
    /// Greatest λ|e| that is taken as it is.
    linear_max: f32,
    approach_max: f32,
    braking: f32,
    /// Whether there is a parabola below the limit.
    brakes: bool,
    reach: Reach,
    surface: Surface,
    /// Slope of a layer on a linear surface: with [`ReachingLaw::ImplicitSgn`] or [`ReachingLaw::Sat`].
    layer: Option<f32>,
    step_s: f32,
    /// v of super-twisting.
    twist: f32,
    /// `λ² ∫e − (ė + 2λ e)(0)` of the integral surface; none before the first step.
    integral: Option<f32>,
}

impl SlidingAxis {
    /// An axis that is stepped every `step_s` seconds, with valid gains.
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

    /// Forgets what has been integrated.
    pub fn reset(&mut self) {
        self.twist = 0.0;
        self.integral = None;
    }

    /// `λ ė + u_r(s)`, the part that every law of the paper adds to its equivalent control, for e and ė.
    ///
    /// `hold` keeps the integrals as they are: the actuator is at its limit, and would not hear them.
    #[inline]
    pub fn correction(&mut self, error: f32, error_rate: f32, hold: bool) -> Correction {
        self.correction_along(error, error_rate, error_rate, hold)
    }

    /// The same where the error's derivative and the velocity error differ, as they do on the rotation group: the
    /// surface is `s = λ e + velocity_error`, its derivative takes `λ ė`.
    #[inline]
    pub fn correction_along(&mut self, error: f32, error_rate: f32, velocity_error: f32, hold: bool) -> Correction {
        if let Some(slope) = self.layer {
            let (s, equivalent) = self.linear_surface(error, error_rate, velocity_error);
            return Correction { s, acceleration: equivalent + math::limit(slope * s, self.gain) };
        }
        self.correction_otherwise(error, error_rate, velocity_error, hold)
    }

    /// The same for every surface and reaching law; apart, so that what is flown most fits into the loop.
    #[inline(never)]
    fn correction_otherwise(&mut self, error: f32, error_rate: f32, velocity_error: f32, hold: bool) -> Correction {
        let (s, equivalent) = match self.surface {
            Surface::Linear => self.linear_surface(error, error_rate, velocity_error),
            Surface::Integral => self.integral_surface(error, error_rate, velocity_error, hold),
        };
        Correction { s, acceleration: equivalent + self.reach(s, hold) }
    }

    /// s, and the derivative of its part λ e.
    #[inline]
    fn linear_surface(&self, error: f32, error_rate: f32, velocity_error: f32) -> (f32, f32) {
        let approach = self.lambda * error;
        if math::abs(approach) <= self.linear_max {
            (approach + velocity_error, self.lambda * error_rate)
        } else if self.brakes {
            let Approach { rate, slope, .. } = self.approach(error);
            (rate + velocity_error, slope * error_rate)
        } else {
            // Limited, it does not change.
            (bound(approach, self.approach_max) + velocity_error, 0.0)
        }
    }

    /// The approach to a large error. A call of its own, or the compiler would have it computed every time.
    #[cold]
    #[inline(never)]
    fn approach(&self, error: f32) -> Approach {
        let (a, e) = (self.braking, math::abs(error));
        let sign = sgn(error);
        let from_linear = a / self.lambda;
        let square = 2.0 * a * e - from_linear * from_linear;
        // Short of the parabola, or above the limit, the limit is what acts: it does not change.
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

    /// Slope `du_r/ds` where it is of use to a feedforward: the layer's gain inside it, 0 where the law is flat or
    /// jumps.
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

    /// Derivative of the [`correction`](Self::correction) that gave `s`, for e, ė and ë.
    #[inline]
    pub fn correction_rate(&self, s: f32, error: f32, error_rate: f32, error_acceleration: f32) -> f32 {
        if let Some(slope) = self.layer {
            let slope = if math::abs(s * slope) < self.gain { slope } else { 0.0 };
            return self.linear_rate(slope, error, error_rate, error_acceleration);
        }
        self.correction_rate_otherwise(s, error, error_rate, error_acceleration)
    }

    /// The same for every surface and reaching law.
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
