//! Air density by the International Standard Atmosphere, and ground effect.

/// Temperature of the standard atmosphere at sea level, K, and its lapse rate, K/m (ISO 2533).
const SEA_LEVEL_K: f64 = 288.15;
const LAPSE_K_M: f64 = 0.0065;
/// g0/(R L) − 1 with g0 = 9.80665 m/s² and R = 287.05287 J/(kg K): the density's exponent in the temperature.
const DENSITY_EXPONENT: f64 = 9.806_65 / (287.052_87 * LAPSE_K_M) - 1.0;
/// Range of altitudes, m: from the lowest that a scenario may use to the top of the troposphere.
pub const ALTITUDE_M: (f64, f64) = (-1_000.0, 11_000.0);

/// Atmosphere whose density decreases with height, relative to sea level, for which an airframe's coefficients hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Atmosphere {
    /// Height of the world's origin above sea level, m.
    pub altitude: f64,
}

impl Atmosphere {
    /// ρ/ρ0 = (1 − L h/T0)^(g0/(R L) − 1) at a height `z` (m) in the world, within the troposphere.
    pub fn density(&self, z: f64) -> f64 {
        let altitude = (self.altitude + z).clamp(ALTITUDE_M.0, ALTITUDE_M.1);
        libm::pow(1.0 - LAPSE_K_M * altitude / SEA_LEVEL_K, DENSITY_EXPONENT)
    }
}

/// Ground effect after Cheeseman and Bennett (1955, ARC R&M 3021): a rotor at a height z above the ground gives 1/(1 −
/// (R/4z)²) times the thrust far from it, at the same speed and torque.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundEffect {
    /// R, m.
    pub radius: f64,
    /// Height of the rotors' plane above the feet, m: the contact model has the feet in the plane of the centre of
    /// mass.
    pub plane: f64,
}

/// The lowest height at which the formula is used, in radii: it has a pole at 1/4, and was measured down to 1/2.
const LOWEST_IN_RADII: f64 = 0.5;

impl GroundEffect {
    /// Thrust at a height of the rotor above the ground (m) relative to that far from it: 1 to 4/3.
    pub fn factor(&self, height: f64) -> f64 {
        let radii = (height / self.radius).max(LOWEST_IN_RADII);
        1.0 / (1.0 - 1.0 / (16.0 * radii * radii))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn density_is_that_of_the_standard_atmosphere() {
        let sea_level = Atmosphere { altitude: 0.0 };
        assert_eq!(sea_level.density(0.0), 1.0);
        // ISO 2533, table of ρ/ρ0 over geopotential height.
        for (altitude, ratio) in [(1_000.0, 0.907_46), (2_000.0, 0.821_62), (5_000.0, 0.600_91), (11_000.0, 0.297_08)] {
            assert!((Atmosphere { altitude }.density(0.0) - ratio).abs() < 2e-5, "{altitude}");
            assert_eq!(Atmosphere { altitude }.density(0.0), sea_level.density(altitude));
        }
        assert_eq!(sea_level.density(1e6), sea_level.density(11_000.0), "the troposphere's end");
    }

    #[test]
    fn the_cushion_is_cheesemans_and_bennetts() {
        let cushion = GroundEffect { radius: 0.127, plane: 0.0 };
        // 1/(1 − 1/16) at z = R, 1/(1 − 1/64) at 2 R; 4/3 at R/2 and below.
        assert!((cushion.factor(0.127) - 16.0 / 15.0).abs() < 1e-15);
        assert!((cushion.factor(0.254) - 64.0 / 63.0).abs() < 1e-15);
        for low in [0.0635, 0.03, 0.0, -1.0] {
            assert!((cushion.factor(low) - 4.0 / 3.0).abs() < 1e-15, "{low}");
        }
        assert!(cushion.factor(100.0) - 1.0 < 1e-6);
    }
}
