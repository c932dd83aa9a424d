//! Attitude error on the rotation group, with tilt and heading separated.
//!
//! The error rotation `qe = q⁻¹ ⊗ qd = (w, x, y, z)` is split into the shortest rotation that aligns the thrust axis
//! and a rotation about that axis (Brescianini and D'Andrea, IEEE TCST 2018). With N = w² + z²:
//!
//! ```text
//! e1 = 2 (wx − yz)/√N    e2 = 2 (wy + xz)/√N    e3 = 2 sgn(w) z/√N
//! ```
//!
//! (e1, e2) is 2 sin(α/2) along the axis of the tilt error α, and e3 is 2 sin(β/2) of the heading error β. Small errors
//! are angles; the largest value, 2, means upside down or heading backwards. There is no singularity at 90°, and q and
//! −q give the same error, so there is no unwinding. The tilt error does not depend on the heading, so a vehicle short
//! of yaw torque still aligns its thrust the shortest way.

use nalgebra::{UnitQuaternion, Vector3};

use crate::math;

/// Error of an attitude with respect to a desired one. All vectors are in the body frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointingError {
    /// e1..e3, rad for small errors.
    pub error: Vector3<f32>,
    /// wx − yz, wy + xz, 1/√N, sgn(w)/√N.
    tilt: (f32, f32),
    per_root: f32,
    signed_per_root: f32,
    /// qe = w + (x, y, z), and 2 (x, y, z).
    w: f32,
    vector: Vector3<f32>,
    twice: Vector3<f32>,
}

/// Below this N, within 3.6° of upside down, every rotation back is equally short: the vehicle rolls, with a constant
/// error.
const INVERTED: f32 = 1e-3;

impl PointingError {
    /// The error of the attitude `is` with respect to the desired attitude `ought`, both body to world.
    #[inline]
    pub fn between(is: &UnitQuaternion<f32>, ought: &UnitQuaternion<f32>) -> Self {
        let (a, b) = (is.quaternion(), ought.quaternion());
        // q⁻¹ ⊗ qd.
        let w = a.w * b.w + a.i * b.i + a.j * b.j + a.k * b.k;
        let x = a.w * b.i - a.i * b.w - a.j * b.k + a.k * b.j;
        let y = a.w * b.j + a.i * b.k - a.j * b.w - a.k * b.i;
        let z = a.w * b.k - a.i * b.j + a.j * b.i - a.k * b.w;

        let tilt = (w * x - y * z, w * y + x * z);
        let square = w * w + z * z;
        let upright = square > INVERTED;
        let per_root = if upright { 1.0 / math::sqrt(square) } else { 0.0 };
        // Products of two components do not depend on the sign of the quaternion, but the heading error does.
        let signed_per_root = if w < 0.0 { -per_root } else { per_root };
        let error = if upright {
            Vector3::new(2.0 * per_root * tilt.0, 2.0 * per_root * tilt.1, 2.0 * signed_per_root * z)
        } else {
            Vector3::new(2.0, 0.0, 0.0)
        };
        let vector = Vector3::new(x, y, z);
        Self { error, tilt, per_root, signed_per_root, w, vector, twice: vector + vector }
    }

    /// R(qe) v, which transforms a vector from the desired body frame to the body frame: `v + w t + q × t` with `t = 2
    /// q × v`, cheaper for two vectors than the matrix.
    #[inline]
    pub fn to_body(&self, v: &Vector3<f32>) -> Vector3<f32> {
        let (w, q, t) = (self.w, &self.vector, self.twice.cross(v));
        Vector3::new(
            v.x + w * t.x + q.y * t.z - q.z * t.y,
            v.y + w * t.y + q.z * t.x - q.x * t.z,
            v.z + w * t.z + q.x * t.y - q.y * t.x,
        )
    }

    /// ė, given the rate error R(qe) Ωd − Ω in the body frame.
    ///
    /// With T = (wx − yz, wy + xz): Ṫ = ½((2N−1)a − 2c T2, (2N−1)b + 2c T1) and Ṅ = −(a T1 + b T2) for a rate error of
    /// (a, b, c), which follow from q̇e = ½ (0, a, b, c) ⊗ qe.
    #[inline]
    pub fn rate(&self, rate_error: &Vector3<f32>) -> Vector3<f32> {
        let (a, b, c) = (rate_error.x, rate_error.y, rate_error.z);
        let ((t1, t2), w, (x, y, z)) = (self.tilt, self.w, (self.vector.x, self.vector.y, self.vector.z));
        let root = self.per_root;
        // −Ṅ/N.
        let shrinking = (a * t1 + b * t2) * (root * root);
        // 2N − 1.
        let axis = 1.0 - (x * self.twice.x + y * self.twice.y);
        Vector3::new(
            root * (a * axis - 2.0 * c * t2 + t1 * shrinking),
            root * (b * axis + 2.0 * c * t1 + t2 * shrinking),
            self.signed_per_root * (c * w + a * y - b * x + z * shrinking),
        )
    }
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "tests compare with bounds; what flies may not")]
mod tests {
    use super::*;
    use nalgebra::UnitQuaternion as Q;

    /// Attitudes spread over the rotation group.
    fn attitudes() -> impl Iterator<Item = Q<f32>> {
        (0..400).map(|i| {
            let t = i as f32;
            Q::from_euler_angles(3.1 * (0.37 * t).sin(), 1.57 * (0.71 * t).cos(), 3.1 * (1.13 * t).sin())
        })
    }

    #[test]
    fn tilt_is_the_angle_between_the_axes_and_does_not_depend_on_the_heading() {
        for (is, turn) in attitudes().zip([0.0_f32, 1.0, 2.5, -2.9].into_iter().cycle()) {
            let ought = Q::from_euler_angles(0.3, -0.5, 0.8);
            let angle = (is * Vector3::z()).angle(&(ought * Vector3::z()));
            let turned = ought * Q::from_axis_angle(&Vector3::z_axis(), turn);
            for target in [ought, turned] {
                let error = PointingError::between(&is, &target).error;
                let tilt = error.xy().norm();
                assert!((tilt - 2.0 * (0.5 * angle).sin()).abs() < 2e-5, "{tilt} {angle}");
            }
        }
    }

    #[test]
    fn the_way_it_points_leads_to_the_target_from_anywhere() {
        // Kinematics alone, turning with the error as its rate: it converges from every attitude, and by the sign of
        // the quaternion it does not care.
        for start in attitudes().step_by(7) {
            let ought = Q::from_euler_angles(0.2, 0.4, -1.0);
            let mut is = start;
            let mut flipped = Q::new_unchecked(-start.into_inner());
            for _ in 0..1_500 {
                for q in [&mut is, &mut flipped] {
                    let error = PointingError::between(q, &ought).error;
                    *q *= Q::new(error * 0.01);
                }
            }
            assert!(is.angle_to(&ought) < 1e-2, "{start}: {}", is.angle_to(&ought));
            assert!(flipped.angle_to(&ought) < 1e-2);
        }
    }

    #[test]
    fn its_rate_is_its_derivative() {
        let (rates, desired_rates) = (Vector3::new(1.0_f32, -2.0, 0.7), Vector3::new(-0.4_f32, 0.9, 1.5));
        let ought = Q::from_euler_angles(0.3, -0.5, 0.8);
        let h = 2e-3_f32;
        for is in attitudes().filter(|is| is.angle_to(&Q::from_euler_angles(0.3, -0.5, 0.8)) < 2.6) {
            let at = |t: f32| PointingError::between(&(is * Q::new(rates * t)), &(ought * Q::new(desired_rates * t)));
            let now = at(0.0);
            let numeric = (at(h).error - at(-h).error) / (2.0 * h);
            let rate = now.rate(&(now.to_body(&desired_rates) - rates));
            // f32 differences: 1e-7·2/4e-3 of rounding; h² of truncation, more near the inverted attitude.
            assert!((numeric - rate).norm() < 5e-3, "{is}: {numeric} {rate}");
        }
    }

    #[test]
    fn upside_down_it_rolls() {
        let inverted = Q::from_axis_angle(&Vector3::x_axis(), core::f32::consts::PI);
        let error = PointingError::between(&Q::identity(), &inverted).error;
        assert!((error.xy().norm() - 2.0).abs() < 1e-5, "{error}");
        assert!(PointingError::between(&inverted, &inverted).error.norm() < 1e-6);
        // Near it the error neither changes nor is said to, and further off its rate is bounded: 1/√N there.
        let rates = Vector3::new(1.0, 1.0, 1.0);
        for i in 0..600 {
            let is = Q::from_axis_angle(&Vector3::x_axis(), 0.001 * i as f32);
            let pointing = PointingError::between(&is, &inverted);
            assert!(pointing.rate(&rates).norm() < 120.0, "{i}: {}", pointing.rate(&rates));
        }
    }
}
