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
/// To second order in the distance d and the height over the origin h: with an error of about (d³ (1 + tan² φ) + d² h)/R²
/// of north and west, and d h/R of distances: 3 cm at 1 km with 150 m of height, 0.8 m at 20 km up to a latitude φ of 65°,
/// 6 m at 20 km and 85°. Both ways have the same error: there and back it is that of the coordinates' resolution, 1 cm.
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

    /// The place of a position in this frame, m: the inverse of [`to_local`](Self::to_local), to the resolution of the
    /// coordinates (1 cm) within 20 km. Within 20 km of a pole only the latitude and the height mean anything.
    pub fn to_geodetic(&self, position: &Vector3<f32>) -> Geodetic {
        /// Least convergence of the meridians: less only where a pole is closer than the position.
        const CONVERGENCE_MIN: f32 = 0.5;
        let east = -position.y;
        let north = position.x - self.bend * east * east;
        let up = position.z + self.fall * (north * north + east * east);
        let along_parallel = east / math::max(1.0 - 2.0 * self.bend * north, CONVERGENCE_MIN);
        let latitude = i64::from(self.origin.latitude_e7) + i64::from(nearest(north / self.north_m));
        let longitude = i64::from(self.origin.longitude_e7) + i64::from(nearest(along_parallel / self.east_m));
        Geodetic {
            latitude_e7: latitude.clamp(-HALF_TURN_E7 / 2, HALF_TURN_E7 / 2) as i32,
            longitude_e7: within_half_a_turn(longitude),
            height_mm: self.origin.height_mm.saturating_add(nearest(up * 1e3)),
        }
    }
}

/// Where the local frame's origin is on Earth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Origin {
    /// Its place.
    pub place: Geodetic,
    /// Height of the geoid (mean sea level) above the ellipsoid there, mm: a height above the ellipsoid less this is one
    /// above mean sea level.
    pub separation_mm: i32,
}

/// The nearest integer; saturates, and NaN is 0.
fn nearest(x: f32) -> i32 {
    (if x < 0.0 { x - 0.5 } else { x + 0.5 }) as i32
}

/// Half a turn, 1e-7°.
const HALF_TURN_E7: i64 = 1_800_000_000;

/// The shorter way from one longitude to another, 1e-7°.
fn eastwards(from: i32, to: i32) -> i32 {
    within_half_a_turn(i64::from(to) - i64::from(from))
}

/// An angle of up to one and a half turns as one of up to half a turn, 1e-7°.
fn within_half_a_turn(angle: i64) -> i32 {
    let short = if angle > HALF_TURN_E7 {
        angle - 2 * HALF_TURN_E7
    } else if angle < -HALF_TURN_E7 {
        angle + 2 * HALF_TURN_E7
    } else {
        angle
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

    /// Earth-centred, earth-fixed coordinates in double precision, m.
    fn ecef(place: &Geodetic) -> Vector3<f64> {
        let (a, e2) = (6_378_137.0_f64, 6.694_379_990_141e-3);
        let (sin, cos) = (f64::from(place.latitude_e7) * 1e-7).to_radians().sin_cos();
        let (sin_l, cos_l) = (f64::from(place.longitude_e7) * 1e-7).to_radians().sin_cos();
        let (normal, height) = (a / (1.0 - e2 * sin * sin).sqrt(), f64::from(place.height_mm) * 1e-3);
        let across = (normal + height) * cos;
        Vector3::new(across * cos_l, across * sin_l, (normal * (1.0 - e2) + height) * sin)
    }

    /// A place in the tangent plane of another, m: north, west, up.
    fn exact(origin: &Geodetic, place: &Geodetic) -> Vector3<f64> {
        let (sin, cos) = (f64::from(origin.latitude_e7) * 1e-7).to_radians().sin_cos();
        let (sin_l, cos_l) = (f64::from(origin.longitude_e7) * 1e-7).to_radians().sin_cos();
        let d = ecef(place) - ecef(origin);
        Vector3::new(
            -sin * cos_l * d.x - sin * sin_l * d.y + cos * d.z,
            sin_l * d.x - cos_l * d.y,
            cos * cos_l * d.x + cos * sin_l * d.y + sin * d.z,
        )
    }

    const ORIGINS: [Geodetic; 6] = [
        Geodetic { latitude_e7: 473_977_000, longitude_e7: 85_456_000, height_mm: 488_000 },
        Geodetic { latitude_e7: 0, longitude_e7: 0, height_mm: 0 },
        Geodetic { latitude_e7: -338_568_000, longitude_e7: 1_512_153_000, height_mm: 30_000 },
        Geodetic { latitude_e7: 100_000_000, longitude_e7: 1_799_999_990, height_mm: -400_000 },
        Geodetic { latitude_e7: -100_000_000, longitude_e7: -1_799_999_990, height_mm: 2_000 },
        Geodetic { latitude_e7: 700_000_000, longitude_e7: -1_500_000_000, height_mm: 3_000_000 },
    ];

    #[test]
    fn a_position_is_given_the_place_that_it_has_in_closed_form() {
        for origin in ORIGINS {
            let frame = LocalFrame::new(origin);
            assert_eq!(frame.to_geodetic(&Vector3::zeros()), origin, "exact at the origin");
            // The model is of second order: its error is d³/R², times the slope of the parallels, and d h/R.
            for (position, most_m) in [
                ([30.0, -40.0, 12.0], 0.02),
                ([-700.0, 700.0, -50.0], 0.02),
                ([3_000.0, -4_000.0, 120.0], 0.12),
                ([-14_000.0, 14_000.0, 100.0], 1.0),
            ] {
                let position = Vector3::from(position);
                let off = exact(&origin, &frame.to_geodetic(&position)) - position.cast();
                assert!(off.norm() < most_m, "{origin:?} {position}: {off}");
            }
        }
    }

    #[test]
    fn a_place_comes_back_from_the_local_frame_to_its_last_digit() {
        for origin in ORIGINS {
            let frame = LocalFrame::new(origin);
            for [north, east, up] in [[0, 0, 0], [1, -1, 1], [-12_345, 23_456, 7_890], [900_000, -900_000, 500_000]] {
                let place = Geodetic {
                    latitude_e7: origin.latitude_e7 + north,
                    longitude_e7: within_half_a_turn(i64::from(origin.longitude_e7) + i64::from(east)),
                    height_mm: origin.height_mm + up,
                };
                let back = frame.to_geodetic(&frame.to_local(&place));
                assert!((back.latitude_e7 - place.latitude_e7).abs() <= 1, "{place:?} {back:?}");
                assert!(eastwards(back.longitude_e7, place.longitude_e7).abs() <= 1, "{place:?} {back:?}");
                assert!((back.height_mm - place.height_mm).abs() <= 2, "{place:?} {back:?}");
            }
        }
    }

    #[test]
    fn at_a_pole_and_far_away_places_stay_on_earth() {
        for latitude_e7 in [900_000_000, -900_000_000, 899_999_000] {
            let frame = LocalFrame::new(Geodetic { latitude_e7, longitude_e7: 1_000, height_mm: 2_800_000 });
            for reach in [1.0, 1e3, 2e4, 1e7, f32::MAX, f32::NAN] {
                for position in [[reach, reach, reach], [-reach, reach, -reach], [reach, -reach, 0.0]] {
                    let place = frame.to_geodetic(&position.into());
                    assert!(place.latitude_e7.abs() <= 900_000_000, "{position:?}: {place:?}");
                    assert!(place.longitude_e7.abs() <= 1_800_000_000, "{position:?}: {place:?}");
                }
            }
        }
    }

    #[test]
    fn positions_are_continuous_across_the_date_line() {
        let frame = LocalFrame::new(Geodetic { latitude_e7: 0, longitude_e7: 1_799_999_000, height_mm: 0 });
        let beyond = frame.to_local(&Geodetic { latitude_e7: 0, longitude_e7: -1_799_999_000, height_mm: 0 });
        assert!((beyond.y + 22.264).abs() < 1e-2, "{beyond}");
    }
}
