//! Sensor samples in SI units, body frame FLU, each with the tick of its measurement.
//!
//! A driver stamps a sample with the time of the measurement, not of its arrival: a late one is fused at its own time
//! (see `estimator`). No sample is trusted: it may be missing, repeated, out of order, stuck, NaN or infinite.

use nalgebra::{UnitQuaternion, Vector3};

use crate::math;
use crate::signals::Tick;

/// Angular rate and specific force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImuSample {
    /// When it was measured.
    pub at: Tick,
    /// Ω + bias, rad/s.
    pub gyro: Vector3<f32>,
    /// Rᵀ(v̇ + g e3) + bias, m/s²: (0, 0, g) at rest and level.
    pub accel: Vector3<f32>,
}

/// Magnetic field in the body's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MagSample {
    /// When it was measured.
    pub at: Tick,
    /// µT.
    pub field_ut: Vector3<f32>,
}

/// Static pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaroSample {
    /// When it was measured.
    pub at: Tick,
    /// Pa.
    pub pressure_pa: f32,
}

/// A place on the WGS-84 ellipsoid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Geodetic {
    /// Latitude, 1e-7°.
    pub latitude_e7: i32,
    /// Longitude, 1e-7°.
    pub longitude_e7: i32,
    /// Height above the ellipsoid, mm.
    pub height_mm: i32,
}

/// A solution of a satellite receiver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GnssSample {
    /// When it was measured; it arrives 100–200 ms later.
    pub at: Tick,
    /// Whether the receiver claims a three-dimensional fix.
    pub has_fix: bool,
    /// Place.
    pub place: Geodetic,
    /// Velocity in the world (NWU), m/s.
    pub velocity: Vector3<f32>,
    /// The receiver's estimate of its standard deviation per horizontal axis, m.
    pub horizontal_accuracy_m: f32,
    /// The same for the height, m.
    pub vertical_accuracy_m: f32,
    /// The same for each component of the velocity, m/s.
    pub speed_accuracy_m_s: f32,
    /// Height of the geoid (mean sea level) above the ellipsoid at that place, by the receiver's table, mm.
    pub separation_mm: i32,
    /// UTC of the measurement, µs since 1970; `None` before the receiver knows the time.
    pub utc_us: Option<u64>,
}

/// Position and attitude by motion capture, in the local frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseSample {
    /// When it was measured.
    pub at: Tick,
    /// m.
    pub position: Vector3<f32>,
    /// Body to world.
    pub attitude: UnitQuaternion<f32>,
}

/// Battery monitor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BatterySample {
    /// At the terminals, V.
    pub voltage_v: f32,
    /// A.
    pub current_a: f32,
}

/// Samples that have arrived in a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measurements {
    /// IMU: present every tick on a healthy vehicle.
    pub imu: Option<ImuSample>,
    /// Magnetometer.
    pub mag: Option<MagSample>,
    /// Barometer.
    pub baro: Option<BaroSample>,
    /// Satellite receiver.
    pub gnss: Option<GnssSample>,
    /// Motion capture.
    pub pose: Option<PoseSample>,
    /// Battery monitor.
    pub battery: Option<BatterySample>,
}

impl ImuSample {
    /// True if the values are within the range of any IMU for vehicles: 4000 °/s and 32 g per axis. The integration
    /// assumes turns of a few degrees per tick; a single sample of 1e5 rad/s would destroy the attitude.
    #[inline]
    pub fn is_plausible(&self) -> bool {
        /// √3 times these ranges, rad/s and m/s².
        const RATE_MAX: f32 = 121.0;
        const FORCE_MAX: f32 = 544.0;
        // A comparison with NaN is false.
        self.gyro.norm_squared() < RATE_MAX * RATE_MAX && self.accel.norm_squared() < FORCE_MAX * FORCE_MAX
    }
}

impl GnssSample {
    /// True for a finite fix that the receiver itself reports as accurate enough.
    pub fn is_usable(&self) -> bool {
        /// Worst accepted accuracy of position (m) and velocity (m/s): a vehicle cannot hold its place with worse.
        const ACCURACY: (f32, f32) = (10.0, 1.0);
        let (metres, metres_per_second) = ACCURACY;
        // A comparison with NaN is false.
        self.has_fix
            && math::all_finite(self.velocity.as_slice())
            && self.horizontal_accuracy_m < metres
            && self.vertical_accuracy_m < 2.0 * metres
            && self.speed_accuracy_m_s < metres_per_second
    }
}

impl PoseSample {
    /// True if every value is finite and the attitude is a unit quaternion within 1 %.
    pub fn is_valid(&self) -> bool {
        let norm = self.attitude.quaternion().norm_squared();
        math::all_finite(self.position.as_slice()) && norm > 0.98 && norm < 1.02
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_inaccurate_fix_is_not_used() {
        let good = GnssSample {
            at: 0,
            has_fix: true,
            place: Geodetic::default(),
            velocity: Vector3::zeros(),
            horizontal_accuracy_m: 1.5,
            vertical_accuracy_m: 2.5,
            speed_accuracy_m_s: 0.05,
            separation_mm: 0,
            utc_us: None,
        };
        assert!(good.is_usable());
        for bad in [
            GnssSample { has_fix: false, ..good },
            GnssSample { velocity: Vector3::new(0.0, f32::NAN, 0.0), ..good },
            GnssSample { horizontal_accuracy_m: 50.0, ..good },
            GnssSample { vertical_accuracy_m: f32::NAN, ..good },
            GnssSample { speed_accuracy_m_s: f32::INFINITY, ..good },
        ] {
            assert!(!bad.is_usable(), "{bad:?}");
        }
    }
}
