//! Positions on the WGS-84 ellipsoid, and the local tangent frame at home.
//!
//! ```text
//! (north, west, up) about home  ◄──►  earth-centred, earth-fixed  ◄──►  latitude, longitude, height
//!                        a rotation                        the ellipsoid
//! ```
//!
//! The local frame is a plane: 1 km from home the ellipsoid lies 8 cm below it.

use firmware::sensors::Geodetic;
use nalgebra::{Matrix3, Vector3};

/// Semi-major axis a, m (NIMA TR8350.2).
const EQUATOR_M: f64 = 6_378_137.0;
/// Flattening f.
const FLATTENING: f64 = 1.0 / 298.257_223_563;
/// e² = f (2 − f).
const ECCENTRICITY_2: f64 = FLATTENING * (2.0 - FLATTENING);
/// Units per degree in which a receiver reports latitude and longitude.
const PER_DEGREE: f64 = 1e7;

/// A geodetic position in full precision.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Place {
    /// Latitude, rad.
    pub latitude_rad: f64,
    /// Longitude, rad, east positive.
    pub longitude_rad: f64,
    /// Height above the ellipsoid, m.
    pub height_m: f64,
}

impl Place {
    /// From degrees and metres.
    pub fn from_degrees(latitude_deg: f64, longitude_deg: f64, height_m: f64) -> Self {
        Self { latitude_rad: latitude_deg.to_radians(), longitude_rad: longitude_deg.to_radians(), height_m }
    }

    /// Earth-centred, earth-fixed, m.
    pub fn to_ecef(&self) -> Vector3<f64> {
        let (sin, cos) = libm::sincos(self.latitude_rad);
        let (sin_longitude, cos_longitude) = libm::sincos(self.longitude_rad);
        let normal = normal_radius(sin);
        let across = (normal + self.height_m) * cos;
        let along = ((1.0 - ECCENTRICITY_2) * normal + self.height_m) * sin;
        Vector3::new(across * cos_longitude, across * sin_longitude, along)
    }

    /// The place of a point, earth-centred, earth-fixed, m.
    ///
    /// Bowring's formula for the latitude (Survey Review 28, 1985), applied twice: within 10 km of the ellipsoid only
    /// rounding remains, some nanometres. Not valid at the centre of the Earth.
    pub fn from_ecef(point: &Vector3<f64>) -> Self {
        let across = libm::hypot(point.x, point.y);
        let minor = EQUATOR_M * (1.0 - FLATTENING);
        let second_eccentricity_2 = ECCENTRICITY_2 / (1.0 - ECCENTRICITY_2);
        let mut reduced = libm::atan2(EQUATOR_M * point.z, minor * across);
        let mut latitude = 0.0;
        for _ in 0..2 {
            let (sin, cos) = libm::sincos(reduced);
            latitude = libm::atan2(
                point.z + second_eccentricity_2 * minor * sin * sin * sin,
                across - ECCENTRICITY_2 * EQUATOR_M * cos * cos * cos,
            );
            let (sin, cos) = libm::sincos(latitude);
            reduced = libm::atan2((1.0 - FLATTENING) * sin, cos);
        }
        let (sin, cos) = libm::sincos(latitude);
        // This form is well conditioned at the poles too.
        let height_m = across * cos + point.z * sin - EQUATOR_M * EQUATOR_M / normal_radius(sin);
        Self { latitude_rad: latitude, longitude_rad: libm::atan2(point.y, point.x), height_m }
    }

    /// As a receiver reports it: whole 1e-7° and mm.
    pub fn rounded(&self) -> Geodetic {
        Geodetic {
            latitude_e7: (self.latitude_rad.to_degrees() * PER_DEGREE).round() as i32,
            longitude_e7: (self.longitude_rad.to_degrees() * PER_DEGREE).round() as i32,
            height_mm: (self.height_m * 1e3).round() as i32,
        }
    }

    /// From a receiver's report.
    pub fn of(place: &Geodetic) -> Self {
        Self::from_degrees(
            f64::from(place.latitude_e7) / PER_DEGREE,
            f64::from(place.longitude_e7) / PER_DEGREE,
            f64::from(place.height_mm) * 1e-3,
        )
    }
}

/// N, the radius of curvature in the prime vertical at a latitude with this sine, m.
fn normal_radius(sin_latitude: f64) -> f64 {
    EQUATOR_M / (1.0 - ECCENTRICITY_2 * sin_latitude * sin_latitude).sqrt()
}

/// The local tangent frame (north, west, up) at a position on the ellipsoid.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalFrame {
    origin: Vector3<f64>,
    /// From (north, west, up) to earth-centred axes.
    axes: Matrix3<f64>,
}

impl LocalFrame {
    /// With its origin at a position.
    pub fn at(home: &Place) -> Self {
        let (sin, cos) = libm::sincos(home.latitude_rad);
        let (sin_longitude, cos_longitude) = libm::sincos(home.longitude_rad);
        let north = Vector3::new(-sin * cos_longitude, -sin * sin_longitude, cos);
        let west = Vector3::new(sin_longitude, -cos_longitude, 0.0);
        let up = Vector3::new(cos * cos_longitude, cos * sin_longitude, sin);
        Self { origin: home.to_ecef(), axes: Matrix3::from_columns(&[north, west, up]) }
    }

    /// The place of a local position, m.
    pub fn place(&self, position: &Vector3<f64>) -> Place {
        Place::from_ecef(&(self.origin + self.axes * position))
    }

    /// The local position of a place, m.
    pub fn position(&self, place: &Place) -> Vector3<f64> {
        self.axes.tr_mul(&(place.to_ecef() - self.origin))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACES: [(f64, f64, f64); 7] = [
        (47.3977, 8.5456, 488.0),
        (0.0, 0.0, 0.0),
        (-33.9, 151.2, 30.0),
        (89.9999, -120.0, 3000.0),
        (-90.0, 0.0, 2800.0),
        (27.99, 86.93, 8848.0),
        (10.0, -179.99, -400.0),
    ];

    #[test]
    fn places_on_the_axes_are_where_the_semi_axes_end() {
        let minor = 6_356_752.314_245; // b as TR8350.2 prints it.
        for (place, point) in [
            ((0.0, 0.0, 0.0), [EQUATOR_M, 0.0, 0.0]),
            ((0.0, 90.0, 10.0), [0.0, EQUATOR_M + 10.0, 0.0]),
            ((90.0, 0.0, 5.0), [0.0, 0.0, minor + 5.0]),
            ((-90.0, 0.0, 0.0), [0.0, 0.0, -minor]),
        ] {
            let ecef = Place::from_degrees(place.0, place.1, place.2).to_ecef();
            assert!((ecef - Vector3::from(point)).amax() < 1e-6, "{ecef}");
        }
    }

    #[test]
    fn a_place_comes_back_from_earth_centred_axes() {
        for (latitude, longitude, height) in PLACES {
            let place = Place::from_degrees(latitude, longitude, height);
            let back = Place::from_ecef(&place.to_ecef());
            // An angle of 1e-14 rad is 60 nm; heights are differences of numbers of 6e6 m: 1e-9 m each.
            assert!((back.latitude_rad - place.latitude_rad).abs() < 1e-14, "{place:?} {back:?}");
            assert!((back.height_m - place.height_m).abs() < 1e-8, "{place:?} {back:?}");
            let off_longitude = (back.longitude_rad - place.longitude_rad) * libm::cos(place.latitude_rad);
            assert!(off_longitude.abs() < 1e-14, "{place:?} {back:?}");
        }
    }

    #[test]
    fn small_steps_are_those_of_the_radii_of_curvature() {
        for (latitude, longitude, height) in PLACES.into_iter().filter(|place| place.0.abs() < 80.0) {
            let home = Place::from_degrees(latitude, longitude, height);
            let frame = LocalFrame::at(&home);
            let sin = libm::sin(home.latitude_rad);
            let normal = normal_radius(sin);
            // M, the radius of curvature along the meridian.
            let meridian = normal * (1.0 - ECCENTRICITY_2) / (1.0 - ECCENTRICITY_2 * sin * sin);
            let north = frame.place(&Vector3::new(1.0, 0.0, 0.0));
            let west = frame.place(&Vector3::new(0.0, 1.0, 0.0));
            let up = frame.place(&Vector3::new(0.0, 0.0, 1.0));
            // Of second order is 1 m²/6,000 km = 0.2 µm.
            assert!(((north.latitude_rad - home.latitude_rad) * (meridian + height) - 1.0).abs() < 1e-6);
            let east = (west.longitude_rad - home.longitude_rad) * (normal + height) * libm::cos(home.latitude_rad);
            assert!((east + 1.0).abs() < 1e-6, "{east}");
            assert!((up.height_m - height - 1.0).abs() < 1e-7);
        }
    }

    #[test]
    fn a_local_position_comes_back() {
        for (latitude, longitude, height) in PLACES {
            let frame = LocalFrame::at(&Place::from_degrees(latitude, longitude, height));
            for position in [[0.0; 3], [100.0, -200.0, 50.0], [-5e3, 5e3, 1e3]] {
                let position = Vector3::from(position);
                let back = frame.position(&frame.place(&position));
                assert!((back - position).amax() < 1e-7, "{position} {back}");
            }
        }
        // The plane leaves the ellipsoid by d²/2R: 7.8 cm in 1 km.
        let frame = LocalFrame::at(&Place::from_degrees(47.0, 8.0, 0.0));
        let height = frame.place(&Vector3::new(0.0, 1000.0, 0.0)).height_m;
        assert!((height - 0.078).abs() < 0.001, "{height}");
    }

    #[test]
    fn a_receiver_rounds_to_its_last_digit() {
        let place = Place::from_degrees(47.397_712_345_6, -8.545_612_345_6, 488.123_4);
        let told = place.rounded();
        let exact = Geodetic { latitude_e7: 473_977_123, longitude_e7: -85_456_123, height_mm: 488_123 };
        assert_eq!(told, exact);
        // Half of 1e-7° is 5.6 mm of the meridian.
        let frame = LocalFrame::at(&place);
        assert!(frame.position(&Place::of(&told)).amax() < 5.6e-3);
    }
}
