//! Home: the place of a flight on Earth, with its magnetic field and atmosphere.

use anyhow::Result;
use glissade_files::refusal::within;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::geodesy::Place;

/// Temperature lapse of the troposphere, K/m (ISO 2533).
const LAPSE_K_M: f64 = 0.0065;
/// g M / (R L): 9.80665 m/s² · 0.0289644 kg/mol / (8.31432 J/(mol K) · 0.0065 K/m) (ISO 2533).
const EXPONENT: f64 = 5.255_88;

/// Static pressure (Pa) of the standard atmosphere at a height above sea level, for a pressure (Pa) and a temperature
/// (K) at sea level. For the troposphere, up to 11 km.
pub fn pressure(height_m: f64, sea_level_pa: f64, sea_level_k: f64) -> f64 {
    sea_level_pa * libm::pow(1.0 - LAPSE_K_M * height_m / sea_level_k, EXPONENT)
}

/// The origin of the world's frame. Zurich on a standard day, unless it says otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Home {
    /// Latitude, °.
    pub latitude_deg: f64,
    /// Longitude, ° east.
    pub longitude_deg: f64,
    /// Height above the ellipsoid, m.
    pub height_m: f64,
    /// Height of the geoid (mean sea level) above the ellipsoid, m, which the receiver tells: 0, and not Zurich's 47 m, so
    /// that heights above either are the same unless a scenario says otherwise.
    pub geoid_m: f64,
    /// Magnetic declination, ° east of north.
    pub declination_deg: f64,
    /// Magnetic inclination, ° below the horizon.
    pub inclination_deg: f64,
    /// Strength of the magnetic field, µT.
    pub strength_ut: f64,
    /// Pressure at sea level, Pa.
    pub sea_level_pa: f64,
    /// Temperature at sea level, K.
    pub sea_level_k: f64,
}

impl Default for Home {
    /// The magnetic field is about that of the world magnetic model in 2025.
    fn default() -> Self {
        Self {
            latitude_deg: 47.3977,
            longitude_deg: 8.5456,
            height_m: 488.0,
            geoid_m: 0.0,
            declination_deg: 3.5,
            inclination_deg: 63.5,
            strength_ut: 48.3,
            sea_level_pa: 101_325.0,
            sea_level_k: 288.15,
        }
    }
}

impl Home {
    /// As a place.
    pub fn place(&self) -> Place {
        Place::from_degrees(self.latitude_deg, self.longitude_deg, self.height_m)
    }

    /// The magnetic field in the world (NWU), µT: F (cos I cos D, −cos I sin D, −sin I).
    pub fn field_nwu(&self) -> Vector3<f64> {
        let (sin_d, cos_d) = libm::sincos(self.declination_deg.to_radians());
        let (sin_i, cos_i) = libm::sincos(self.inclination_deg.to_radians());
        Vector3::new(cos_i * cos_d, -cos_i * sin_d, -sin_i) * self.strength_ut
    }

    /// Static pressure at a height above home, Pa.
    pub fn pressure(&self, up_m: f64) -> f64 {
        pressure(self.height_m - self.geoid_m + up_m, self.sea_level_pa, self.sea_level_k)
    }

    /// Checks that home is on Earth.
    ///
    /// # Errors
    /// The first key that is out of range.
    pub fn validate(&self) -> Result<()> {
        within("home.latitude_deg", self.latitude_deg, -90.0, 90.0)?;
        within("home.longitude_deg", self.longitude_deg, -180.0, 180.0)?;
        within("home.height_m", self.height_m, -500.0, 9000.0)?;
        within("home.geoid_m", self.geoid_m, -110.0, 90.0)?;
        within("home.declination_deg", self.declination_deg, -180.0, 180.0)?;
        within("home.inclination_deg", self.inclination_deg, -90.0, 90.0)?;
        within("home.strength_ut", self.strength_ut, 1.0, 100.0)?;
        within("home.sea_level_pa", self.sea_level_pa, 8e4, 1.2e5)?;
        within("home.sea_level_k", self.sea_level_k, 200.0, 350.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_air_is_that_of_the_standard_atmosphere() {
        // ISO 2533, Table 1: pressures in Pa.
        for (height_m, pressure_pa) in [(0.0, 101_325.0), (1000.0, 89_874.6), (5000.0, 54_019.9), (11_000.0, 22_632.1)]
        {
            let ours = pressure(height_m, 101_325.0, 288.15);
            assert!((ours - pressure_pa).abs() < 1.0, "{height_m}: {ours}");
        }
        // At 488 m: ρ = 1.168 kg/m³, so that a metre is ρ g = 11.46 Pa.
        let home = Home::default();
        let slope = home.pressure(-0.5) - home.pressure(0.5);
        assert!((slope - 11.46).abs() < 0.01, "{slope}");
    }

    #[test]
    fn the_air_is_that_above_the_sea() {
        let home = Home { height_m: 535.0, geoid_m: 47.0, ..Home::default() };
        assert_eq!(home.pressure(12.0), pressure(500.0, 101_325.0, 288.15));
    }

    #[test]
    fn the_field_points_north_east_and_down_in_zurich() {
        let field = Home::default().field_nwu();
        assert!((field.norm() - 48.3).abs() < 1e-12);
        // 48.3 cos 63.5° cos 3.5°, 48.3 cos 63.5° sin 3.5° to the east, 48.3 sin 63.5° down.
        assert!((field - Vector3::new(21.511, -1.316, -43.225)).amax() < 2e-3, "{field}");
    }

    #[test]
    fn a_home_that_is_not_on_earth_is_refused_by_its_key() {
        Home::default().validate().expect("valid");
        let refused = Home { latitude_deg: 91.0, ..Home::default() }.validate().expect_err("refused");
        assert!(format!("{refused}").contains("`home.latitude_deg`"));
        assert!(Home { sea_level_k: f64::NAN, ..Home::default() }.validate().is_err());
    }
}
