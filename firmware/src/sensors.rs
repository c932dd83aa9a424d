//! What sensors deliver: samples in SI units, body frame FLU, each with the tick at which it was true.
//!
//! A driver stamps a sample with the time of the measurement, not of its arrival: what comes late is fused at its own
//! time (see `estimator`). Nothing here is trusted: samples may be missing, repeated, out of order, stuck or not finite.

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
    /// When it was true; it arrives 100–200 ms later.
    pub at: Tick,
    /// Whether the receiver claims a three-dimensional fix.
    pub has_fix: bool,
    /// Place.
    pub place: Geodetic,
    /// Velocity in the world (NWU), m/s.
    pub velocity: Vector3<f32>,
    /// The receiver's own estimate of its standard deviation, m: each horizontal axis.
    pub horizontal_accuracy_m: f32,
    /// The same of the height, m.
    pub vertical_accuracy_m: f32,
    /// The same of each component of the velocity, m/s.
    pub speed_accuracy_m_s: f32,
}

/// Position and attitude by motion capture, in the local frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseSample {
    /// When it was true.
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

/// What the sensors have delivered in a tick: each its sample, if one has arrived.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measurements {
    /// Every tick, on a sound vehicle.
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
    /// True if it can have been measured: no part for vehicles has a range beyond 4000 °/s or 32 g an axis. What is
    /// integrated is made for turns of a few degrees a tick; a single sample of 1e5 rad/s would leave no attitude.
    #[inline]
    pub fn is_plausible(&self) -> bool {
        /// √3 times these ranges, rad/s and m/s².
        const RATE_MAX: f32 = 121.0;
        const FORCE_MAX: f32 = 544.0;
        // Of what is no number, no comparison holds.
        self.gyro.norm_squared() < RATE_MAX * RATE_MAX && self.accel.norm_squared() < FORCE_MAX * FORCE_MAX
    }
}

impl GnssSample {
    /// True for a fix of finite numbers, of which the receiver does not say itself that they are worth nothing.
    pub fn is_usable(&self) -> bool {
        /// A position worse than this, m, or a velocity worse than that, m/s, holds no vehicle.
        const ACCURACY: (f32, f32) = (10.0, 1.0);
        let (metres, metres_a_second) = ACCURACY;
        // A comparison with NaN is false.
        self.has_fix
            && math::all_finite(self.velocity.as_slice())
            && self.horizontal_accuracy_m < metres
            && self.vertical_accuracy_m < 2.0 * metres
            && self.speed_accuracy_m_s < metres_a_second
    }
}

impl PoseSample {
    /// True if every number of it is finite and the attitude is of unit size, within 1 %.
    pub fn is_valid(&self) -> bool {
        let norm = self.attitude.quaternion().norm_squared();
        math::all_finite(self.position.as_slice()) && norm > 0.98 && norm < 1.02
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_receiver_that_knows_nothing_is_not_listened_to() {
        let good = GnssSample {
            at: 0,
            has_fix: true,
            place: Geodetic::default(),
            velocity: Vector3::zeros(),
            horizontal_accuracy_m: 1.5,
            vertical_accuracy_m: 2.5,
            speed_accuracy_m_s: 0.05,
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
