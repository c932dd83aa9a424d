//! A disturbance observer: what accelerates the vehicle beyond what its model says.
//!
//! An extended-state observer (Han 2009, linear form of Gao 2003) of `ẏ = a + d`, y a measured rate and a the
//! acceleration that the model gives for what the rotors are believed to do: both its poles stand at `e^(−ω₀h)`, so
//! a constant d is found to e^(−1) in about 2/ω₀, and a d that changes by L a second is followed within 2L/ω₀. Since it
//! is fed with what the rotors do and not with what was asked of them, it does not wind up when they are at a limit.
//!
//! With d̂ taken off, a reaching law needs a gain above |d − d̂| only, and not above |d|.

use nalgebra::Vector3;

use crate::math;
use crate::validate::ConfigError;

/// What an observer is configured with.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct ObserverGains {
    /// ω₀, rad/s; 0 for no observer.
    pub bandwidth_rad_s: f32,
    /// Bound D on each component of the disturbance, in units of y a second: nothing larger is believed.
    pub disturbance_max: f32,
}

impl ObserverGains {
    /// Refuses what is not a finite number, or below zero.
    ///
    /// # Errors
    /// `name` with what is wrong.
    pub fn validate(&self, name: &'static str) -> Result<(), ConfigError> {
        ConfigError::require_not_negative(name, self.bandwidth_rad_s)?;
        ConfigError::require_not_negative(name, self.disturbance_max)
    }
}

/// The observer of three axes and its state.
#[derive(Clone, Debug, PartialEq)]
pub struct DisturbanceObserver {
    /// Step h, s.
    step_s: f32,
    /// Corrections of the rate, and of the disturbance, by a unit of the rate's error.
    rate_gain: f32,
    disturbance_gain: f32,
    disturbance_max: f32,
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
            started: false,
            rate: Vector3::zeros(),
            disturbance: Vector3::zeros(),
        }
    }

    /// Forgets the disturbance.
    pub fn reset(&mut self) {
        self.started = false;
        self.disturbance = Vector3::zeros();
    }

    /// d̂ now, given the rate as measured now and the model's acceleration from now to the next step.
    #[inline]
    pub fn step(&mut self, measured: &Vector3<f32>, model: &Vector3<f32>) -> Vector3<f32> {
        if !self.started {
            self.started = true;
            self.rate = *measured;
        }
        let error = measured - self.rate;
        let most = self.disturbance_max;
        let disturbance = (self.disturbance + error * self.disturbance_gain).map(|d| math::limit(d, most));
        self.rate = self.rate + (model + disturbance) * self.step_s + error * self.rate_gain;
        self.disturbance = disturbance;
        disturbance
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
            found = observer.step(&Vector3::repeat(y), &Vector3::repeat(model));
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
    fn nothing_beyond_the_bound_is_believed() {
        let gains = ObserverGains { bandwidth_rad_s: 50.0, disturbance_max: 2.0 };
        let mut observer = DisturbanceObserver::new(&gains, 1e-3);
        let mut y = 0.0_f32;
        for _ in 0..2_000 {
            let found = observer.step(&Vector3::repeat(y), &Vector3::zeros());
            assert!(found.amax() <= 2.0);
            y += 10.0 * 1e-3;
        }
    }
}
