//! Frame conversions: NWU/FLU inside, NED/FRD at the MAVLink interface, WGS-84 from GNSS.
//!
//! NWU to NED and FLU to FRD are rotations by 180° about x: `(x, y, z) → (x, −y, −z)`, `(φ, θ, ψ) → (φ, −θ, −ψ)`, for
//! vectors, rates and attitudes alike. Each conversion is its own inverse.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::math;
use crate::sensors::Geodetic;

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

/// Local tangent frame at a place on the ellipsoid: north, west, up.
///
/// To second order in the distance d, so with an error of d³/R²: 0.1 mm at 1 km, 0.2 m at 20 km. The resolution of the
/// coordinates is 1 cm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalFrame {
    origin: Geodetic,
    /// Metres per 1e-7° of latitude and of longitude.
    north_m: f32,
    east_m: f32,
    /// tan φ/2R, 1/m: how far a parallel bends north.
    bend: f32,
    /// 1/2R, 1/m: how far the surface falls away.
    fall: f32,
}

impl LocalFrame {
    /// With its origin at a place on WGS-84.
    pub fn new(origin: Geodetic) -> Self {
        const SEMI_MAJOR_M: f32 = 6_378_137.0;
        const ECCENTRICITY_SQ: f32 = 6.694_38e-3;
        const UNIT_RAD: f32 = 1.745_329_3e-9;
        // At a pole there is no west: bounded, so that nothing is divided by zero.
        let (sin, cos) = math::sin_cos(origin.latitude_e7 as f32 * UNIT_RAD);
        let cos = math::max(cos, 1e-3);
        let root = math::sqrt(1.0 - ECCENTRICITY_SQ * sin * sin);
        let normal_radius = SEMI_MAJOR_M / root;
        let meridian_radius = normal_radius * (1.0 - ECCENTRICITY_SQ) / (root * root);
        let height = origin.height_mm as f32 * 1e-3;
        Self {
            origin,
            north_m: (meridian_radius + height) * UNIT_RAD,
            east_m: (normal_radius + height) * cos * UNIT_RAD,
            bend: 0.5 * sin / (cos * normal_radius),
            fall: 0.5 / normal_radius,
        }
    }

    /// A place in this frame, m: north, west, up.
    pub fn to_local(&self, place: &Geodetic) -> Vector3<f32> {
        // Differences of integers, because an f32 resolves a latitude to a metre only.
        let north = self.north_m * place.latitude_e7.wrapping_sub(self.origin.latitude_e7) as f32;
        let east = self.east_m * eastwards(self.origin.longitude_e7, place.longitude_e7) as f32;
        // Meridians converge towards the pole.
        let east = east * (1.0 - 2.0 * self.bend * north);
        let up = place.height_mm.wrapping_sub(self.origin.height_mm) as f32 * 1e-3;
        Vector3::new(north + self.bend * east * east, -east, up - self.fall * (north * north + east * east))
    }
}

/// The shorter way from one longitude to another, 1e-7°.
fn eastwards(from: i32, to: i32) -> i32 {
    const TURN: i64 = 3_600_000_000;
    let difference = i64::from(to) - i64::from(from);
    let short = if difference > TURN / 2 {
        difference - TURN
    } else if difference < -TURN / 2 {
        difference + TURN
    } else {
        difference
    };
    // Half a turn fits into an i32.
    short as i32
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "tests compare with bounds; what flies may not")]
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

    #[test]
    fn places_around_the_origin_are_where_they_are_in_closed_form() {
        // At 45° the meridian's radius is 6 367 382 m and the parallel's 4 517 591 m (WGS-84).
        let frame = LocalFrame::new(Geodetic { latitude_e7: 450_000_000, longitude_e7: 0, height_mm: 0 });
        let north = frame.to_local(&Geodetic { latitude_e7: 450_010_000, longitude_e7: 0, height_mm: 5_000 });
        assert!((north - Vector3::new(111.132, 0.0, 5.0)).norm() < 5e-3, "{north}");
        let east = frame.to_local(&Geodetic { latitude_e7: 450_000_000, longitude_e7: 10_000, height_mm: 0 });
        assert!((east - Vector3::new(0.0, -78.847, 0.0)).norm() < 5e-3, "{east}");
    }

    #[test]
    fn positions_are_continuous_across_the_date_line() {
        let frame = LocalFrame::new(Geodetic { latitude_e7: 0, longitude_e7: 1_799_999_000, height_mm: 0 });
        let beyond = frame.to_local(&Geodetic { latitude_e7: 0, longitude_e7: -1_799_999_000, height_mm: 0 });
        assert!((beyond.y + 22.264).abs() < 1e-2, "{beyond}");
    }
}
