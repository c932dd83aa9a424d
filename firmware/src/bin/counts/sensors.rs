//! Sensors of the vehicle that is flown on the target: noisy, and GNSS late.

use firmware::math;
use firmware::sensors::{BaroSample, Geodetic, GnssSample, ImuSample, MagSample, Measurements};
use firmware::signals::{NavState, Tick};
use nalgebra::Vector3;

/// Sampling periods, ticks.
const MAG_EVERY: Tick = 10;
const BARO_EVERY: Tick = 20;
const GNSS_EVERY: Tick = 200;
/// Latency of a GNSS fix, ticks.
const GNSS_DELAY: Tick = 120;
/// The filter's default magnetic field, µT.
const FIELD_UT: Vector3<f32> = Vector3::new(21.5, -1.3, -43.2);
/// 1e-7° on the equator, m.
const DEGREE_M: f32 = 0.011_13;

pub(crate) struct Sensors {
    /// State of the noise (xorshift).
    noise: u32,
    /// The fix that has not yet arrived.
    fix: Option<GnssSample>,
}

impl Sensors {
    pub(crate) fn new() -> Self {
        Self { noise: 0x2545_f491, fix: None }
    }

    /// The samples of a tick, for a motion and its specific force.
    pub(crate) fn measure(&mut self, at: Tick, nav: &NavState, specific_force: &Vector3<f32>) -> Measurements {
        if at.is_multiple_of(GNSS_EVERY) {
            self.fix = Some(self.fix(at, nav));
        }
        Measurements {
            imu: Some(self.imu(at, nav, specific_force)),
            mag: at.is_multiple_of(MAG_EVERY).then(|| self.mag(at, nav)),
            baro: at.is_multiple_of(BARO_EVERY).then(|| self.baro(at, nav)),
            gnss: self.fix.take_if(|fix| at.wrapping_sub(fix.at) >= GNSS_DELAY),
            ..Measurements::default()
        }
    }

    /// Uniformly distributed within ± `size`.
    fn number(&mut self, size: f32) -> f32 {
        self.noise ^= self.noise << 13;
        self.noise ^= self.noise >> 17;
        self.noise ^= self.noise << 5;
        (self.noise.cast_signed() >> 8) as f32 / 8_388_608.0 * size
    }

    fn vector(&mut self, size: f32) -> Vector3<f32> {
        Vector3::new(self.number(size), self.number(size), self.number(size))
    }

    fn imu(&mut self, at: Tick, nav: &NavState, specific_force: &Vector3<f32>) -> ImuSample {
        let bias = Vector3::new(3e-3, -2e-3, 1e-3);
        ImuSample { at, gyro: nav.rates + bias + self.vector(3e-3), accel: specific_force + self.vector(0.1) }
    }

    fn mag(&mut self, at: Tick, nav: &NavState) -> MagSample {
        MagSample { at, field_ut: nav.attitude.inverse() * FIELD_UT + self.vector(0.6) }
    }

    fn baro(&mut self, at: Tick, nav: &NavState) -> BaroSample {
        let height = nav.position.z + self.number(0.1);
        BaroSample { at, pressure_pa: 101_325.0 * math::powf(1.0 - height / 44_330.77, 5.255_88) }
    }

    fn fix(&mut self, at: Tick, nav: &NavState) -> GnssSample {
        let p = nav.position + self.vector(0.1);
        let place = Geodetic {
            latitude_e7: (p.x / DEGREE_M) as i32,
            longitude_e7: (-p.y / DEGREE_M) as i32,
            height_mm: (p.z * 1e3) as i32,
        };
        GnssSample {
            at,
            has_fix: true,
            place,
            velocity: nav.velocity + self.vector(0.08),
            horizontal_accuracy_m: 1.0,
            vertical_accuracy_m: 1.5,
            speed_accuracy_m_s: 0.1,
            separation_mm: 0,
            utc_us: None,
        }
    }
}
