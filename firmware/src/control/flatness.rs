//! From a force and its derivatives to an attitude and its derivatives: Eq. 11 as a differentially flat map.
//!
//! The specific force f (thrust per unit of mass) determines the direction of the body's z axis, n = f/|f|. Rotated by
//! −ψ, the corrected Eq. 11 reads φd = asin(−n′y) = asin(Ux sψ − Uy cψ), θd = asin(n′x/cφd). Its first two derivatives
//! are the rates and accelerations that the attitude loop needs for exact tracking. The angles themselves are never
//! computed: their sines and cosines are components of n′, and those of the half angles make the quaternion.

use nalgebra::Vector3;

use crate::control::euler::Euler;
use crate::math;
use crate::signals::AttitudeTarget;

/// A specific force, m/s², with two derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceProfile {
    /// f, m/s².
    pub force: Vector3<f32>,
    /// ḟ, m/s³.
    pub rate: Vector3<f32>,
    /// f̈, m/s⁴.
    pub acceleration: Vector3<f32>,
}

/// Heading with two derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heading {
    /// ψ, rad.
    pub angle: f32,
    /// ψ̇, rad/s.
    pub rate: f32,
    /// ψ̈, rad/s².
    pub acceleration: f32,
}

/// Smallest specific force (m/s²) whose direction is followed.
const FORCE_MIN: f32 = 0.05;

/// A unit vector with two derivatives.
struct Direction {
    n: Vector3<f32>,
    rate: Vector3<f32>,
    acceleration: Vector3<f32>,
}

impl ForceProfile {
    /// The constant force that balances gravity `g`, m/s².
    pub fn hover(g: f32) -> Self {
        let zero = Vector3::zeros();
        Self { force: Vector3::new(0.0, 0.0, g), rate: zero, acceleration: zero }
    }

    /// True if every component is finite.
    #[inline]
    pub fn is_finite(&self) -> bool {
        [&self.force, &self.rate, &self.acceleration].iter().all(|v| math::all_finite(v.as_slice()))
    }

    /// n = f/|f| with ṅ and n̈ (from f = |f| n).
    fn direction(&self) -> Direction {
        let magnitude = math::max(math::sqrt(self.force.norm_squared()), FORCE_MIN);
        let inverse = 1.0 / magnitude;
        let n = self.force * inverse;
        let magnitude_rate = n.dot(&self.rate);
        let rate = (self.rate - n * magnitude_rate) * inverse;
        let magnitude_acceleration = n.dot(&self.acceleration) + magnitude * rate.norm_squared();
        let acceleration = (self.acceleration - rate * (2.0 * magnitude_rate) - n * magnitude_acceleration) * inverse;
        Direction { n, rate, acceleration }
    }
}

/// The vector `v` rotated by −ψ about z, given (sin ψ, cos ψ).
fn turn_back(v: &Vector3<f32>, (sin, cos): (f32, f32)) -> Vector3<f32> {
    Vector3::new(cos * v.x + sin * v.y, cos * v.y - sin * v.x, v.z)
}

/// `e3 × v`.
fn quarter_turn(v: &Vector3<f32>) -> Vector3<f32> {
    Vector3::new(-v.y, v.x, 0.0)
}

/// The attitude target by the corrected Eq. 11, with rates and accelerations, for a force and a heading.
///
/// Defined for a force above the horizon (|θd| < 90°); roll is limited so that its cosine is at least 0.01.
#[inline]
pub fn attitude_target(profile: &ForceProfile, heading: &Heading) -> AttitudeTarget {
    let direction = profile.direction();
    let (sin_half, cos_half) = math::sin_cos(0.5 * heading.angle);
    let turn = (2.0 * sin_half * cos_half, 1.0 - 2.0 * sin_half * sin_half);
    // In the frame that turns with ψ: d/dt [Rz(−ψ) n] = Rz(−ψ)(ṅ − ψ̇ e3×n), and the same again for n̈.
    let n = turn_back(&direction.n, turn);
    let n_rate = turn_back(&direction.rate, turn);
    let rate = n_rate - quarter_turn(&n) * heading.rate;
    let acceleration = turn_back(&direction.acceleration, turn)
        - quarter_turn(&n_rate) * (2.0 * heading.rate)
        - quarter_turn(&n) * heading.acceleration
        + quarter_turn(&quarter_turn(&n)) * (heading.rate * heading.rate);

    let sin_roll = math::clamp(-n.y, -0.999_95, 0.999_95);
    let cos_roll = math::sqrt(1.0 - sin_roll * sin_roll);
    let sec_roll = 1.0 / cos_roll;
    let roll_rate = -rate.y * sec_roll;
    let roll_acceleration = (-acceleration.y + sin_roll * roll_rate * roll_rate) * sec_roll;

    let square = math::max(n.x * n.x + n.z * n.z, 1e-4);
    let per_square = 1.0 / square;
    let pitch_rate = (rate.x * n.z - n.x * rate.z) * per_square;
    let square_rate = 2.0 * (n.x * rate.x + n.z * rate.z);
    let pitch_acceleration = (acceleration.x * n.z - n.x * acceleration.z - pitch_rate * square_rate) * per_square;

    let per_root = math::sqrt(per_square);
    let (sin_pitch, cos_pitch) = (n.x * per_root, n.z * per_root);
    let euler = Euler { roll: (sin_roll, cos_roll), pitch: (sin_pitch, cos_pitch), sec_pitch: 0.0, yaw: turn };
    let rates = Vector3::new(roll_rate, pitch_rate, heading.rate);
    let accelerations = Vector3::new(roll_acceleration, pitch_acceleration, heading.acceleration);
    AttitudeTarget {
        attitude: euler.to_quaternion((sin_half, cos_half)),
        rates: euler.body_rates(&rates),
        accelerations: euler.body_acceleration(&rates, &accelerations),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::euler::{Euler, EulerReference};

    fn euler_reference(profile: &ForceProfile, heading: &Heading) -> EulerReference {
        EulerReference::of_target(&attitude_target(profile, heading))
    }

    /// A smooth test force and heading with exact derivatives, computed in f64.
    fn sample(t: f64) -> (ForceProfile, Heading) {
        let (s, c) = t.sin_cos();
        let v = |a: f64, b: f64, z: f64| Vector3::new(a as f32, b as f32, z as f32);
        let profile = ForceProfile {
            force: v(6.0 * s, 5.0 * c, 10.0 + 3.0 * s),
            rate: v(6.0 * c, -5.0 * s, 3.0 * c),
            acceleration: v(-6.0 * s, -5.0 * c, -3.0 * s),
        };
        let (s2, c2) = (2.0 * t).sin_cos();
        let heading = Heading { angle: (0.7 * s2) as f32, rate: (1.4 * c2) as f32, acceleration: (-2.8 * s2) as f32 };
        (profile, heading)
    }

    #[test]
    fn thrust_axis_of_the_angles_is_the_force_direction() {
        for i in 0..60 {
            let (profile, heading) = sample(f64::from(i) * 0.1);
            let euler = euler_reference(&profile, &heading).angles;
            let rotation = nalgebra::Rotation3::from_euler_angles(euler.x, euler.y, euler.z);
            let error = rotation * Vector3::z() - profile.force.normalize();
            assert!(error.norm() < 1e-6, "{i}: {error}");
        }
    }

    #[test]
    fn rates_and_accelerations_are_the_derivatives() {
        let h = 2e-3;
        for i in 0..60 {
            let t = f64::from(i) * 0.1;
            let at = |dt: f64| {
                let (profile, heading) = sample(t + dt);
                euler_reference(&profile, &heading)
            };
            let (before, now, after) = (at(-h), at(0.0), at(h));
            let rate = (after.angles - before.angles) / (2.0 * h as f32);
            let acceleration = (after.rates - before.rates) / (2.0 * h as f32);
            // Central differences of f32 angles: 2·6e-8/4e-3 of rounding plus h² of truncation.
            assert!((rate - now.rates).norm() < 5e-4, "{t}: {rate} {}", now.rates);
            assert!((acceleration - now.accelerations).norm() < 2e-3, "{t}: {acceleration} {}", now.accelerations);
        }
    }

    #[test]
    fn euler_rates_and_body_rates_agree_with_the_rotation() {
        // Body rates from the rotation itself, by differences, against Euler::body_acceleration's integral.
        let h = 1e-3_f32;
        let (angles, rates) = (Vector3::new(0.4_f32, -0.7, 0.9), Vector3::new(1.0_f32, -0.5, 0.8));
        let accelerations = Vector3::new(-2.0_f32, 3.0, 1.0);
        let body_at = |t: f32| {
            let a = angles + rates * t + accelerations * (0.5 * t * t);
            let euler = Euler::from_angles(a);
            let r = rates + accelerations * t;
            // Ω = E η̇.
            let ((sr, cr), (sp, cp)) = (euler.roll, euler.pitch);
            Vector3::new(r.x - sp * r.z, cr * r.y + sr * cp * r.z, -sr * r.y + cr * cp * r.z)
        };
        let numeric = (body_at(h) - body_at(-h)) / (2.0 * h);
        let euler = Euler::from_angles(angles);
        let analytic = euler.body_acceleration(&rates, &accelerations);
        assert!((numeric - analytic).norm() < 1e-3, "{numeric} {analytic}");
        assert!((euler.rates(&body_at(0.0)) - rates).norm() < 1e-6);
    }
}
