//! Roll, pitch and yaw as people read them, for rows and reports: nothing that flies uses them.

use std::f64::consts::{PI, TAU};

/// Roll φ, pitch θ, yaw ψ (rad) of a body-to-world unit quaternion w, x, y, z, for R = Rz(ψ)·Ry(θ)·Rx(φ).
pub fn roll_pitch_yaw([w, x, y, z]: [f64; 4]) -> [f64; 3] {
    let roll = libm::atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y));
    // Rounding may carry the sine just past ±1, where asin is NaN.
    let pitch = libm::asin((2.0 * (w * y - z * x)).clamp(-1.0, 1.0));
    [roll, pitch, yaw([w, x, y, z])]
}

/// Yaw ψ (rad) of a body-to-world unit quaternion w, x, y, z.
pub fn yaw([w, x, y, z]: [f64; 4]) -> f64 {
    libm::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
}

/// The same angle (rad) in [−π, π].
pub fn wrap(angle: f64) -> f64 {
    if angle.abs() <= PI { angle } else { angle - TAU * (angle / TAU).round() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::UnitQuaternion;

    #[test]
    fn angles_come_back_from_the_quaternion() {
        for angles in [[0.1, -0.2, 0.3], [-2.0, 1.5, 3.0], [0.0, 0.0, -3.1]] {
            let [roll, pitch, yaw] = angles;
            let q = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
            let back = roll_pitch_yaw([q.w, q.i, q.j, q.k]);
            // 1e-12: a few ulps, times 1/cos θ = 14 at 1.5 rad of pitch.
            assert!(angles.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-12), "{angles:?} became {back:?}");
        }
    }

    #[test]
    fn wrapping_takes_the_short_way() {
        assert!((wrap(3.1 - -3.1) - (6.2 - TAU)).abs() < 1e-15);
        assert_eq!(wrap(0.5), 0.5);
        assert_eq!(wrap(PI), PI);
        assert!((wrap(7.0 * TAU + 0.25) - 0.25).abs() < 1e-13);
    }
}
