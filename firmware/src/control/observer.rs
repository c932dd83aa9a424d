//! Disturbance observer: estimates the acceleration that the model does not explain.
//!
//! An extended-state observer (Han 2009, linear form of Gao 2003) of `ẏ = a + d`, where y is a measured rate and a the
//! model's acceleration at the estimated rotor speeds. Both poles are at `e^(−ω₀h)`: the error of a constant d falls to
//! e⁻¹ in about 2/ω₀, and a d that changes at a rate L is followed within 2L/ω₀. The observer is driven by what the
//! rotors do, not by what was demanded of them, so it does not wind up when they saturate.
//!
//! With d̂ compensated, a reaching law needs a gain above |d − d̂| instead of |d|.

use nalgebra::Vector3;

use crate::math;
use crate::validate::{ConfigError, Field, Range};

/// Configuration of an observer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct ObserverGains {
    /// ω₀, rad/s; 0 for no observer.
    pub bandwidth_rad_s: f32,
    /// Bound D on the magnitude of the estimate, in units of y per second: larger estimates are limited to it.
    pub disturbance_max: f32,
}

impl ObserverGains {
    /// The values of both.
    pub const RANGE: Range = Range::NotNegative;

    /// Checks that both values are finite and not negative.
    ///
    /// # Errors
    /// The field of the observer `group` and what is wrong with it.
    pub fn validate(&self, group: &'static str) -> Result<(), ConfigError> {
        Self::RANGE.check(Field::of(group, "bandwidth_rad_s"), self.bandwidth_rad_s)?;
        Self::RANGE.check(Field::of(group, "disturbance_max"), self.disturbance_max)
    }
}

/// The observer of three axes and its state.
#[derive(Clone, Debug, PartialEq)]
pub struct DisturbanceObserver {
    /// Step h, s.
    step_s: f32,
    /// Gains from the rate error to the rate and to the disturbance.
    rate_gain: f32,
    disturbance_gain: f32,
    disturbance_max: f32,
    /// Its square.
    square_max: f32,
    started: bool,
    rate: Vector3<f32>,
    disturbance: Vector3<f32>,
}

impl DisturbanceObserver {
    /// An observer that is stepped every `step_s` seconds.
    pub fn new(gains: &ObserverGains, step_s: f32) -> Self {
        let slow = 1.0 - math::exp(-gains.bandwidth_rad_s * step_s);
        Self {
            step_s,
            // Characteristic polynomial (z − e^(−ω₀h))², the disturbance being corrected before it is used.
            rate_gain: slow * (2.0 - slow),
            disturbance_gain: slow * slow / step_s,
            disturbance_max: gains.disturbance_max,
            square_max: gains.disturbance_max * gains.disturbance_max,
            started: false,
            rate: Vector3::zeros(),
            disturbance: Vector3::zeros(),
        }
    }

    /// Goes on with other gains, from the estimate so far; without a bandwidth there is no observer.
    pub fn retune(observer: &mut Option<Self>, gains: &ObserverGains, step_s: f32) {
        let tuned = (gains.bandwidth_rad_s > 0.0).then(|| Self::new(gains, step_s));
        *observer = match (tuned, observer.take()) {
            (Some(tuned), Some(Self { started, rate, disturbance, .. })) => {
                Some(Self { started, rate, disturbance, ..tuned })
            }
            (tuned, _) => tuned,
        };
    }

    /// Clears the estimate.
    pub fn reset(&mut self) {
        self.started = false;
        self.disturbance = Vector3::zeros();
    }

    /// The last estimate d̂.
    #[inline]
    pub fn disturbance(&self) -> Vector3<f32> {
        self.disturbance
    }

    /// Updates d̂ with the rate measured now and the model's acceleration from now to the next step.
    #[inline]
    pub fn estimate(&mut self, measured: &Vector3<f32>, model: &Vector3<f32>) -> Vector3<f32> {
        if !self.started {
            self.started = true;
            self.rate = *measured;
        }
        let error = measured - self.rate;
        let mut disturbance = self.disturbance + error * self.disturbance_gain;
        let square = disturbance.norm_squared();
        // False for NaN too, so that it does not persist.
        let believable = square <= self.square_max;
        if !believable {
            disturbance = shortened(&disturbance, square, self.disturbance_max);
        }
        self.rate = self.rate + (model + disturbance) * self.step_s + error * self.rate_gain;
        self.disturbance = disturbance;
        disturbance
    }
}

/// A vector with the given squared norm, scaled to the norm `size`; zero if it is not finite.
#[cold]
fn shortened(vector: &Vector3<f32>, square: f32, size: f32) -> Vector3<f32> {
    if square.is_finite() { vector * (size / math::sqrt(square)) } else { Vector3::zeros() }
}

/// Thrust effectiveness κ̂: the ratio of the real thrust to the model's. It differs from 1 with a wrong mass, a weak
/// rotor or a drained battery.
///
/// A thrust error turns with the vehicle, faster than an observer of a disturbance that is constant in the world can
/// follow. So the component of d̂ along the force f, d̂·f/|f|², is transferred to a factor κ̂ on f: with `κ̂̇ = γ
/// d̂·f/|f|²` and d̂ = (κ − κ̂) f the error of κ̂ decays as e^(−γt). What κ̂ gains is subtracted from d̂ in the same
/// step, so that their sum does not jump.
#[derive(Clone, Debug, PartialEq)]
pub struct ThrustEffectiveness {
    /// γ h.
    adapt_gain: f32,
    value: f32,
}

impl ThrustEffectiveness {
    /// Range of κ̂. Below it, a vehicle with a thrust-to-weight ratio of 2 has almost no thrust to spare; above it, the
    /// configured mass is simply wrong.
    const RANGE: (f32, f32) = (0.6, 1.6);
    /// Smallest specific force (m/s²) whose direction is used.
    const FORCE_MIN: f32 = 1.0;

    /// Adapted at `rate` γ (1/s), stepped every `step_s` seconds.
    pub fn new(rate: f32, step_s: f32) -> Self {
        Self { adapt_gain: rate * step_s, value: 1.0 }
    }

    /// κ̂.
    #[inline]
    pub fn value(&self) -> f32 {
        self.value
    }

    /// Goes on with another rate (1/s), from the value so far; at 0 that value stays.
    pub fn retune(&mut self, rate: f32, step_s: f32) {
        self.adapt_gain = rate * step_s;
    }

    /// Back to 1.
    pub fn reset(&mut self) {
        self.value = 1.0;
    }

    /// Transfers a fraction γ h of the disturbance along `force`, the model's specific force (m/s²), from `observer`.
    #[inline]
    pub fn adapt(&mut self, force: &Vector3<f32>, observer: &mut DisturbanceObserver) {
        let square = math::max(force.norm_squared(), Self::FORCE_MIN * Self::FORCE_MIN);
        let wanted = self.value + self.adapt_gain * observer.disturbance.dot(force) / square;
        let value = math::clamp(wanted, Self::RANGE.0, Self::RANGE.1);
        observer.disturbance -= force * (value - self.value);
        self.value = value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_disturbance_is_found_and_a_ramp_is_followed_within_its_bound() {
        let (bandwidth, h) = (20.0_f32, 1e-3_f32);
        let gains = ObserverGains { bandwidth_rad_s: bandwidth, disturbance_max: 100.0 };
        let mut observer = DisturbanceObserver::new(&gains, h);
        let (mut y, model, slope) = (0.0_f32, 3.0_f32, 5.0_f32);
        let mut found = Vector3::zeros();
        for i in 0..4_000 {
            let t = i as f32 * h;
            // 7 m/s² at once, and from 2 s on 5 m/s³ more.
            let d = 7.0 + slope * math::max(t - 2.0, 0.0);
            found = observer.estimate(&Vector3::repeat(y), &Vector3::repeat(model));
            if i == 1_999 {
                assert!(math::abs(found.x - 7.0) < 1e-3, "{found}");
            }
            y += (model + d) * h;
        }
        // The lag of a double pole behind a ramp is 2L/ω₀; 1 % for the sampling.
        let lag = 7.0 + slope * 2.0 - found.x;
        assert!(math::abs(lag - 2.0 * slope / bandwidth) < 0.03 * slope / bandwidth, "{lag}");
    }

    #[test]
    fn a_turning_thrust_that_is_too_weak_is_told_from_a_disturbance_that_stands_still() {
        // 30 % less thrust than believed, along an axis that turns at 3 rad/s, and a steady 1 m/s² from the west.
        let (h, weak, wind) = (4e-3_f32, 0.7_f32, Vector3::new(0.0, 1.0, 0.0));
        let gains = ObserverGains { bandwidth_rad_s: 10.0, disturbance_max: 10.0 };
        let mut observer = DisturbanceObserver::new(&gains, h);
        let mut effectiveness = ThrustEffectiveness::new(2.0, h);
        let (mut velocity, mut found) = (Vector3::zeros(), Vector3::zeros());
        for i in 0..5_000 {
            let (sin, cos) = math::sin_cos(math::wrap_angle(i as f32 * h * 3.0));
            let force = Vector3::new(6.0 * sin, 6.0 * cos, 10.0);
            found = observer.estimate(&velocity, &(force * effectiveness.value()));
            effectiveness.adapt(&force, &mut observer);
            velocity += (force * weak + wind) * h;
        }
        // The observer's lag behind what turns keeps a few percent of it.
        assert!(math::abs(effectiveness.value() - weak) < 0.05, "{}", effectiveness.value());
        assert!((found - wind).norm() < 0.4, "{found}");
    }

    #[test]
    fn nothing_beyond_the_bound_is_believed() {
        let gains = ObserverGains { bandwidth_rad_s: 50.0, disturbance_max: 2.0 };
        let mut observer = DisturbanceObserver::new(&gains, 1e-3);
        let mut y = 0.0_f32;
        for _ in 0..2_000 {
            let found = observer.estimate(&Vector3::repeat(y), &Vector3::zeros());
            assert!(found.norm() <= 2.000_001);
            y += 10.0 * 1e-3;
        }
    }
}
