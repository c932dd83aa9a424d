//! What sticks ask for: tilt, rates, velocity and thrust, by PX4's curves.
//!
//! A stick's deflection is shaped by a dead zone and by *expo*: `(1 − e) x + e x³`, flat about the centre. In acro mode
//! *super expo* divides that by `1 − |x| g`, over `1/(1 − g)`, so that the ends become steeper. What a stick asks for at
//! once passes through a critically damped filter, of which value and two derivatives go to the attitude law.

use nalgebra::{SVector, Vector2, Vector3};

use crate::config::{ManualSettings, ModeSettings};
use crate::latest::Sticks;
use crate::math;
use crate::schedule::OUTER;
use crate::signals::TICK_S;

/// Time between two steps, s.
const STEP_S: f32 = OUTER.period as f32 * TICK_S;

/// A manual mode: what the pilot steers by hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ManualMode {
    /// Body rates and thrust.
    Acro,
    /// Tilt and thrust.
    Stabilized,
    /// Tilt and rate of climb.
    Altitude,
    /// Velocity.
    Position,
}

impl ManualMode {
    /// Whether the throttle stick is the thrust; if not, its centre holds the height.
    pub const fn has_direct_thrust(self) -> bool {
        matches!(self, Self::Acro | Self::Stabilized)
    }
}

/// Flat about the centre by `e`, from 0 (linear) to 1 (cubic).
fn expo(x: f32, e: f32) -> f32 {
    (1.0 - e) * x + e * x * x * x
}

/// Steeper towards the ends by `g` below 1.
fn super_expo(x: f32, e: f32, g: f32) -> f32 {
    expo(x, e) * (1.0 - g) / (1.0 - math::abs(x) * g)
}

/// 0 within the zone about the centre, and ±1 at the ends still.
pub(crate) fn dead_zone(x: f32, zone: f32) -> f32 {
    let beyond = math::max(math::abs(x) - zone, 0.0) / (1.0 - zone);
    if x < 0.0 { -beyond } else { beyond }
}

/// Pitch and roll, forward and to the left: the corner of two sticks is no more than one at its end.
fn forward_and_left(sticks: &Sticks) -> Vector2<f32> {
    math::shorten(Vector2::new(sticks.pitch, -sticks.roll), 1.0)
}

impl ManualSettings {
    /// The tangent of the wanted tilt, forward and to the left.
    pub(crate) fn tilt(&self, sticks: &Sticks) -> Vector2<f32> {
        let part = forward_and_left(sticks);
        let angle = math::sqrt(part.norm_squared()) * self.tilt_max_rad;
        let (sin, cos) = math::sin_cos(angle);
        // tan(a)/a is 1 where the stick is centred.
        part * if angle > 1e-3 { sin / cos / angle * self.tilt_max_rad } else { self.tilt_max_rad }
    }

    /// The wanted horizontal velocity, forward and to the left, m/s.
    pub(crate) fn velocity(&self, sticks: &Sticks) -> Vector2<f32> {
        let part = forward_and_left(sticks);
        let size = math::sqrt(part.norm_squared());
        let shaped = expo(dead_zone(size, self.dead_zone), self.expo_xy);
        part * (shaped * self.speed_m_s / math::max(size, 1e-3))
    }

    /// The wanted rate of climb, m/s.
    pub(crate) fn climb(&self, sticks: &Sticks, limits: &ModeSettings) -> f32 {
        let part = expo(dead_zone(2.0 * sticks.throttle - 1.0, self.dead_zone), self.expo_z);
        part * if part > 0.0 { limits.climb_m_s } else { limits.sink_m_s }
    }

    /// The wanted rate of the heading, rad/s.
    pub(crate) fn yaw_rate(&self, sticks: &Sticks) -> f32 {
        self.yaw_rate_rad_s * expo(dead_zone(sticks.yaw, self.dead_zone), self.expo_yaw)
    }

    /// The wanted body rates, rad/s.
    pub(crate) fn body_rates(&self, sticks: &Sticks) -> Vector3<f32> {
        let [roll, pitch, yaw] = self.acro_rates_rad_s;
        let across = |x: f32| super_expo(x, self.acro_expo, self.acro_super_expo);
        Vector3::new(
            roll * across(sticks.roll),
            pitch * across(sticks.pitch),
            yaw * super_expo(sticks.yaw, self.acro_expo_yaw, self.acro_super_expo_yaw),
        )
    }

    /// The wanted thrust by stick, N: the weight at the centre, and straight lines to the least and the greatest thrust.
    pub(crate) fn thrust_n(&self, sticks: &Sticks, weight_n: f32, thrust_max_n: f32) -> f32 {
        thrust_n(sticks.throttle, Sticks::CENTRED.throttle, self.throttle_min * thrust_max_n, weight_n, thrust_max_n)
    }
}

/// A thrust, N: the weight at `hover`, `least` at 0, the greatest at 1.
pub(crate) fn thrust_n(part: f32, hover: f32, least_n: f32, weight_n: f32, thrust_max_n: f32) -> f32 {
    let least_n = math::min(least_n, weight_n);
    if part < hover {
        least_n + (weight_n - least_n) * part / hover
    } else {
        weight_n + (math::max(thrust_max_n, weight_n) - weight_n) * (part - hover) / (1.0 - hover)
    }
}

/// A critically damped filter of the second order, exact for an input that is constant over a step: a value and two
/// derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Smooth {
    pub(crate) value: f32,
    pub(crate) rate: f32,
    pub(crate) acceleration: f32,
}

impl Smooth {
    /// At rest at a value.
    pub(crate) fn at(value: f32) -> Self {
        Self { value, rate: 0.0, acceleration: 0.0 }
    }

    /// A step towards an input, with an angular frequency, rad/s.
    pub(crate) fn step(&mut self, input: f32, omega: f32) {
        let (off, slope) = (self.value - input, self.rate);
        let decay = math::exp(-omega * STEP_S);
        let growth = slope + omega * off;
        self.value = input + (off + growth * STEP_S) * decay;
        self.rate = (slope - omega * growth * STEP_S) * decay;
        self.acceleration = omega * (omega * (input - self.value) - 2.0 * self.rate);
    }
}

/// The filter of axes that share their torque, as one vector, with an acceleration of at most `most`: what remains is braked
/// along one curve, linear near its end, and nothing is overshot, however great the step.
pub(crate) fn step_within<const N: usize>(axes: &mut [Smooth; N], input: &SVector<f32, N>, omega: f32, most: f32) {
    let braking = BRAKING * most;
    let away = input - SVector::from(axes.map(|axis| axis.value));
    let rate = SVector::from(axes.map(|axis| axis.rate));
    let size = math::sqrt(away.norm_squared());
    let speed = math::braked(size, omega, braking);
    let wanted = away * (speed / math::max(size, 1e-9));
    // Of the rate with respect to the way: a constant near the end, and what brakes with `braking` before.
    let slope = math::min(omega, braking / math::max(speed, 1e-6));
    let acceleration = math::shorten((wanted - rate) * omega - rate * slope, most);
    for (axis, acceleration) in axes.iter_mut().zip(&acceleration) {
        axis.value += (axis.rate + 0.5 * acceleration * STEP_S) * STEP_S;
        axis.rate += acceleration * STEP_S;
        axis.acceleration = *acceleration;
    }
}

/// The same with a rate of at most `most`: the filter's two poles are a lag of the value and one of its rate, and the rate that
/// the former wants is limited.
pub(crate) fn step_slewing<const N: usize>(axes: &mut [Smooth; N], input: &SVector<f32, N>, omega: f32, most: f32) {
    let away = input - SVector::from(axes.map(|axis| axis.value));
    let wanted = math::shorten(away * (0.5 * omega), most);
    let follows = 1.0 - math::exp(-2.0 * omega * STEP_S);
    for (axis, wanted) in axes.iter_mut().zip(&wanted) {
        let before = axis.rate;
        axis.rate += (wanted - before) * follows;
        axis.value += 0.5 * (before + axis.rate) * STEP_S;
        axis.acceleration = (axis.rate - before) / STEP_S;
    }
}

/// Part of the greatest acceleration that is braked with; the rest corrects.
const BRAKING: f32 = 0.85;

#[cfg(test)]
mod tests {
    use super::*;

    const SETTINGS: fn() -> ManualSettings = ManualSettings::default;

    fn sticks(roll: f32, pitch: f32, yaw: f32, throttle: f32) -> Sticks {
        Sticks { roll, pitch, yaw, throttle, ..Sticks::CENTRED }
    }

    #[test]
    fn centred_sticks_ask_for_nothing_and_full_ones_for_the_limits() {
        let (settings, limits) = (SETTINGS(), ModeSettings::default());
        for x in [0.0, 0.07, -0.07] {
            let centred = sticks(x, -x, x, 0.5 + 0.5 * x);
            assert_eq!(settings.velocity(&centred), Vector2::zeros());
            assert_eq!((settings.climb(&centred, &limits), settings.yaw_rate(&centred)), (0.0, 0.0));
        }
        for (full, forward, left) in [(sticks(0.0, 1.0, 0.0, 1.0), 1.0, 0.0), (sticks(1.0, 0.0, 0.0, 0.0), 0.0, -1.0)] {
            let direction = Vector2::new(forward, left);
            assert!((settings.velocity(&full) - direction * 10.0).norm() < 1e-5);
            assert!((settings.tilt(&full) - direction * 0.700_207_5).norm() < 1e-6, "tan 35°");
        }
        assert_eq!(settings.climb(&sticks(0.0, 0.0, 0.0, 1.0), &limits), limits.climb_m_s);
        assert_eq!(settings.climb(&sticks(0.0, 0.0, 0.0, 0.0), &limits), -limits.sink_m_s);
        let rates = settings.body_rates(&sticks(1.0, -1.0, 1.0, 0.0));
        assert!((rates - Vector3::new(1.0, -1.0, 1.0) * 1.745_329_3).norm() < 1e-5);
    }

    #[test]
    fn a_corner_is_no_more_than_an_end_in_any_direction() {
        let settings = SETTINGS();
        for i in 0..48 {
            let (sin, cos) = math::sin_cos(i as f32 * core::f32::consts::TAU / 48.0);
            let far = math::max(math::abs(sin), math::abs(cos));
            let corner = sticks(sin / far, cos / far, 0.0, 0.5);
            let (velocity, tilt) = (settings.velocity(&corner), settings.tilt(&corner));
            assert!(math::abs(velocity.norm() - 10.0) < 1e-4 && math::abs(tilt.norm() - 0.700_207_5) < 1e-5);
            assert!((velocity.normalize() - Vector2::new(cos, -sin)).norm() < 1e-5, "straight where it points");
        }
    }

    #[test]
    fn curves_are_odd_and_rise_throughout() {
        let settings = SETTINGS();
        let mut before = [-f32::INFINITY; 4];
        for i in -100..=100_i16 {
            let x = f32::from(i) / 100.0;
            let at = |x: f32| {
                let both = sticks(0.0, x, x, 0.5 + 0.5 * x);
                let rates = settings.body_rates(&both);
                [settings.velocity(&both).x, settings.yaw_rate(&both), rates.y, settings.tilt(&both).x]
            };
            for ((now, opposite), before) in at(x).iter().zip(at(-x)).zip(&mut before) {
                assert!(math::abs(now + opposite) < 1e-5 && *now >= *before - 1e-6, "{x}: {now} {opposite} {before}");
                *before = *now;
            }
        }
    }

    #[test]
    fn the_centre_of_the_throttle_carries_the_weight() {
        let settings = SETTINGS();
        let thrust = |throttle: f32| settings.thrust_n(&sticks(0.0, 0.0, 0.0, throttle), 10.0, 25.0);
        assert_eq!([thrust(0.0), thrust(0.5), thrust(1.0)], [2.0, 10.0, 25.0]);
        assert!(math::abs(thrust(0.25) - 6.0) < 1e-5 && math::abs(thrust(0.75) - 17.5) < 1e-5);
    }

    #[test]
    fn the_filter_is_the_closed_form_of_its_step_response() {
        let (omega, mut smooth) = (20.0, Smooth::default());
        for i in 1..200_u16 {
            smooth.step(1.0, omega);
            let t = f64::from(i) * f64::from(STEP_S);
            let (w, decay) = (f64::from(omega), (-f64::from(omega) * t).exp());
            let exact = [1.0 - (1.0 + w * t) * decay, w * w * t * decay, w * w * (1.0 - w * t) * decay];
            for (value, exact) in [smooth.value, smooth.rate, smooth.acceleration].iter().zip(exact) {
                assert!((f64::from(*value) - exact).abs() < 2e-5 * w * w, "{i}: {value} {exact}");
            }
        }
    }

    /// The greatest acceleration on the way, and how far the end is overshot along it, with its distance at last.
    fn go<F: Fn(&mut [Smooth; 2], &Vector2<f32>)>(step: F, from: Vector2<f32>, to: Vector2<f32>) -> [f32; 3] {
        let mut axes = [from.x, from.y].map(Smooth::at);
        let (mut strongest, mut beyond) = (0.0_f32, 0.0_f32);
        for _ in 0..250 {
            let before = axes;
            step(&mut axes, &to);
            let faster = Vector2::from(core::array::from_fn(|i| axes[i].rate - before[i].rate));
            let value = Vector2::from(axes.map(|axis| axis.value));
            strongest = math::max(strongest, faster.norm() / STEP_S);
            beyond = math::max(beyond, (value - to).dot(&(to - from).normalize()));
        }
        [strongest, beyond, (Vector2::from(axes.map(|axis| axis.value)) - to).norm()]
    }

    #[test]
    fn a_limited_step_arrives_without_overshoot_and_keeps_its_limit_in_any_direction() {
        for to in [Vector2::new(0.7, 0.0), Vector2::new(0.0, -0.7), Vector2::new(-0.5, 0.5), Vector2::new(0.01, 0.02)] {
            // From one end to the other.
            let [strongest, beyond, off] = go(|axes, to| step_within(axes, to, 35.0, 90.0), -to, to);
            assert!(strongest <= 90.01 && beyond < 1e-4 && off < 1e-4, "{to}: {strongest} {beyond} {off}");
        }
    }

    #[test]
    fn a_rate_is_gone_to_with_limited_acceleration_and_not_overshot() {
        for to in [Vector2::new(12.6, 0.0), Vector2::new(9.0, -9.0), Vector2::new(0.1, 0.0)] {
            let mut axes = [Smooth::default(); 2];
            let mut strongest = 0.0_f32;
            for i in 0..250 {
                step_slewing(&mut axes, &to, 40.0, 50.0);
                strongest = math::max(strongest, Vector2::from(axes.map(|axis| axis.rate)).norm());
                let value = Vector2::from(axes.map(|axis| axis.value));
                assert!(value.norm() < 1.001 * to.norm(), "{i}: {value}");
                // As soon as it can, and the filter's lag.
                let lasts = to.norm() / 50.0 + 0.15;
                assert!(f32::from(i as u16) * STEP_S < lasts || (value - to).norm() < 0.02 * to.norm(), "{i}: {value}");
            }
            assert!(strongest <= 50.01, "{to}: {strongest}");
        }
    }
}
