//! The only place that knows two frames: NWU/FLU inside, NED/FRD at the MAVLink edge.
//!
//! Both frames turn by 180° about x: `(x, y, z) → (x, −y, −z)`, `(φ, θ, ψ) → (φ, −θ, −ψ)`, for vectors, rates
//! and attitudes alike. Each conversion is its own inverse.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// A vector or a triple of Euler angles or rates, from one frame to the other.
#[inline]
pub fn flip_vector(v: &Vector3<f32>) -> Vector3<f32> {
    Vector3::new(v.x, -v.y, -v.z)
}

/// An attitude (body to world), from NWU/FLU to NED/FRD or back.
#[inline]
pub fn flip_attitude(attitude: &UnitQuaternion<f32>) -> UnitQuaternion<f32> {
    let q = attitude.quaternion();
    UnitQuaternion::new_unchecked(Quaternion::new(q.w, q.i, -q.j, -q.k))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_vector_is_the_same_seen_from_either_frame() {
        let attitude = UnitQuaternion::from_euler_angles(0.3, -0.5, 1.1);
        let v = Vector3::new(1.0, 2.0, 3.0);
        let here = flip_vector(&(attitude * v));
        let there = flip_attitude(&attitude) * flip_vector(&v);
        assert!((here - there).norm() < 1e-6);
    }

    #[test]
    fn euler_angles_change_sign_in_pitch_and_yaw() {
        let (roll, pitch, yaw) = flip_attitude(&UnitQuaternion::from_euler_angles(0.3, -0.5, 1.1)).euler_angles();
        assert!((Vector3::new(roll, pitch, yaw) - Vector3::new(0.3, 0.5, -1.1)).norm() < 1e-6);
    }
}
