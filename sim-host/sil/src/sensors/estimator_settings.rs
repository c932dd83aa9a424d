//! The estimator's noise parameters, from the data sheets of the sensors and the errors that its model treats as noise.

use firmware::estimator::EstimatorSettings;

use super::imu::Triad;
use super::{Home, SuiteFile};

/// Current of a vehicle of 2 kg in hover, A.
const HOVER_A: f64 = 20.0;
/// Noise density of the accelerometer that is equivalent to rotor vibration, m/s²/√Hz.
const VIBRATION: f64 = 2.4e-3;

impl SuiteFile {
    /// The estimator's settings for this suite at a home. Sensors that the suite does not have keep their defaults,
    /// which are not used.
    pub fn estimator_settings(&self, home: &Home) -> EstimatorSettings {
        let mut settings = EstimatorSettings {
            magnetic_field_ut: home.field_nwu().map(|v| v as f32).into(),
            ..EstimatorSettings::default()
        };
        self.set_imu(&mut settings);
        if let Some(mag) = &self.mag {
            settings.mag_noise_ut = rounded(mag.noise_ut, mag.resolution_ut);
            let horizontal = home.strength_ut * libm::cos(home.inclination_deg.to_radians());
            let soft = mag.soft_iron * home.strength_ut * core::f64::consts::SQRT_2;
            let left = libm::hypot(libm::hypot(mag.hard_iron_ut, soft), mag.current_ut_a * HOVER_A);
            settings.heading_offset = (left / horizontal).max(1e-3) as f32;
        }
        if let Some(baro) = &self.baro {
            let m_per_pa = 1.0 / (home.pressure(-0.5) - home.pressure(0.5));
            settings.baro_noise_m = rounded(baro.noise_pa * m_per_pa, baro.resolution_pa * m_per_pa);
            let wander = baro.drift_pa * (2.0 / baro.drift_time_s).sqrt();
            let warming = baro.offset_pa_k * baro.warm_up.rise_k / baro.warm_up.time_s.sqrt();
            settings.baro_walk = (libm::hypot(wander, warming) * m_per_pa) as f32;
        }
        if let Some(gnss) = &self.gnss {
            settings.gnss_noise_m = [rounded(gnss.horizontal_noise_m, 0.011), gnss.vertical_noise_m as f32];
            settings.gnss_walk = (gnss.horizontal_m * (2.0 / gnss.wander_time_s).sqrt()) as f32;
            settings.gnss_speed_m_s = [gnss.speed_m_s as f32, gnss.climb_m_s as f32];
        }
        if let Some(pose) = &self.pose {
            settings.pose_position_m = pose.position_m.max(1e-4) as f32;
            settings.pose_attitude_rad = pose.attitude_deg.to_radians().max(1e-4) as f32;
        }
        settings
    }

    fn set_imu(&self, settings: &mut EstimatorSettings) {
        let (gyro, accel) = (&self.imu.gyro, &self.imu.accel);
        let warming = |triad: &Triad| triad.bias_per_k * self.imu.warm_up.rise_k / self.imu.warm_up.time_s.sqrt();
        let wander = |triad: &Triad| triad.bias_instability * (2.0 / triad.bias_time_s).sqrt();
        let walk = |triad: &Triad| libm::hypot(libm::hypot(triad.bias_walk, wander(triad)), warming(triad));
        settings.gyro_noise = noise(gyro, 0.0).to_radians() as f32;
        settings.gyro_bias_walk = walk(gyro).to_radians() as f32;
        settings.gyro_bias = gyro.turn_on_bias.max(1e-3).to_radians() as f32;
        settings.gyro_scale = scale(gyro) as f32;
        settings.accel_scale = scale(accel) as f32;
        settings.accel_noise = noise(accel, VIBRATION) as f32;
        settings.accel_bias_walk = walk(accel) as f32;
        settings.accel_bias = libm::hypot(accel.turn_on_bias, accel.scale_error * 9.81).max(1e-3) as f32;
    }
}

/// Scale error of an axis, together with the misalignment towards the other two.
fn scale(triad: &Triad) -> f64 {
    libm::hypot(triad.scale_error, core::f64::consts::SQRT_2 * triad.misalignment)
}

/// Noise density of the worst axis, with quantisation at 1 kHz and `more` noise, unit/√Hz.
fn noise(triad: &Triad, more: f64) -> f64 {
    let worst = triad.noise_density.iter().fold(0.0_f64, |worst, density| worst.max(*density));
    let rounding = triad.resolution / 12.0_f64.sqrt() / 500.0_f64.sqrt();
    libm::hypot(libm::hypot(worst, rounding), more)
}

/// Noise with that of quantisation.
fn rounded(noise: f64, resolution: f64) -> f32 {
    libm::hypot(noise, resolution / 12.0_f64.sqrt()).max(1e-4) as f32
}
