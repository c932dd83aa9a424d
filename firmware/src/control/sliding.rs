//! Sliding surfaces and reaching laws: one axis of a sliding mode controller.
//!
//! With the error `e = desired − actual` a surface is `s = λ e + ė` (Eq. 18–23). A reaching law makes `ṡ = −u_r(s)`
//! (Eq. 16), and a disturbance d of the axis' acceleration turns that into `ṡ = −u_r(s) − d`.
//!
//! [`AxisGains`] is the configuration of an axis (see `gains`), [`SlidingAxis`] its loop form with the state. `K` is [`AxisGains::gain`], D a bound on |d|, L a bound on |ḋ|, V =
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

pub use super::gains::{AxisGains, AxisNumber, ReachingLaw, Surface};
use crate::math;

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
    /// `u_r(s)` of the last step.
    reached: f32,
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
            reached: 0.0,
        }
    }

    /// Flies on with other gains. The integrators keep their state where both gains have them: what the law adds for a
    /// standing disturbance does not jump.
    pub fn retune(&mut self, gains: &AxisGains) {
        let before = *self;
        *self = Self { reached: before.reached, ..Self::new(gains, before.step_s) };
        if self.is_twisting() && before.is_twisting() {
            self.twist = before.twist;
        }
        if self.surface == before.surface {
            self.integral = before.integral;
        }
    }

    fn is_twisting(&self) -> bool {
        matches!(self.reach, Reach::SuperTwisting { .. } | Reach::ImplicitSuperTwisting(_))
    }

    /// Clears the integrators.
    pub fn reset(&mut self) {
        self.twist = 0.0;
        self.integral = None;
        self.reached = 0.0;
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
            self.reached = math::limit(slope * s, self.gain);
            return Correction { s, acceleration: equivalent + self.reached };
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
        self.reached = self.reach(s, hold);
        Correction { s, acceleration: equivalent + self.reached }
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

    /// `u_r(s)` of the last step.
    #[inline]
    pub fn reaching(&self) -> f32 {
        self.reached
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
