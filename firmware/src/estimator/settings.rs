//! Noise parameters of the filter.

use nalgebra::Vector3;

use super::covariance::{ErrorState, StepNoise, index};
use crate::validate::ConfigError;

/// Noise of the sensors and of their environment, as standard deviations (1σ). The defaults describe an ICM-42688-P, an
/// IST8310, a BMP388 and a u-blox M9, each after calibration (data sheets; see docs/estimator.md).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields, default))]
pub struct EstimatorSettings {
    /// White noise density of the gyroscope, rad/s/√Hz.
    pub gyro_noise: f32,
    /// Random walk of the gyroscope bias, rad/s/√s.
    pub gyro_bias_walk: f32,
    /// Turn-on bias of the gyroscope, rad/s.
    pub gyro_bias: f32,
    /// Scale and misalignment error of the gyroscope, as a fraction.
    pub gyro_scale: f32,
    /// White noise density of the accelerometer, including residual vibration, m/s²/√Hz.
    pub accel_noise: f32,
    /// Random walk of the accelerometer bias, m/s²/√s.
    pub accel_bias_walk: f32,
    /// Turn-on bias of the accelerometer, m/s².
    pub accel_bias: f32,
    /// Scale and misalignment error of the accelerometer, as a fraction.
    pub accel_scale: f32,
    /// Noise of the magnetometer, µT.
    pub mag_noise_ut: f32,
    /// Error of the magnetic heading that calibration leaves, rad.
    pub heading_offset: f32,
    /// Noise of the barometer, m.
    pub baro_noise_m: f32,
    /// Random walk of the barometric height, m/√s.
    pub baro_walk: f32,
    /// White noise of a GNSS position, horizontal and vertical, m.
    pub gnss_noise_m: [f32; 2],
    /// Random walk of the GNSS position error on top of the white noise, m/√s.
    pub gnss_walk: f32,
    /// Noise of a GNSS velocity, horizontal and vertical, m/s.
    pub gnss_speed_m_s: [f32; 2],
    /// Noise of a motion-capture position, m.
    pub pose_position_m: f32,
    /// Noise of a motion-capture attitude, rad.
    pub pose_attitude_rad: f32,
    /// Earth's magnetic field in the world (NWU), µT.
    pub magnetic_field_ut: [f32; 3],
}

impl Default for EstimatorSettings {
    fn default() -> Self {
        Self {
            gyro_noise: 6e-5,
            gyro_bias_walk: 1e-5,
            gyro_bias: 5.5e-3,
            gyro_scale: 4e-3,
            accel_noise: 2e-3,
            accel_bias_walk: 1e-4,
            accel_bias: 0.02,
            accel_scale: 2.5e-3,
            mag_noise_ut: 0.35,
            heading_offset: 4e-3,
            baro_noise_m: 0.08,
            baro_walk: 8e-3,
            gnss_noise_m: [0.1, 0.2],
            gnss_walk: 0.04,
            gnss_speed_m_s: [0.05, 0.075],
            pose_position_m: 5e-4,
            pose_attitude_rad: 2e-3,
            magnetic_field_ut: [21.5, -1.3, -43.2],
        }
    }
}

/// Initial deviation of each horizontal wind component, m/s: a calm to fresh day.
const WIND_SIGMA: f32 = 5.0;
/// Random walk of each wind component, m/s/√s.
const WIND_WALK: f32 = 0.7;
/// Random walk of the magnetic heading's error as the vehicle turns and draws current, rad/√s.
const HEADING_WALK: f32 = 3e-5;
/// A scale error acts as noise of this correlation time, s: about as long as a manoeuvre turns one way.
const MANOEUVRE_S: f32 = 0.9;
/// Sensor noise densities are one-sided: n unit/√Hz gives a variance of n²T/2 after integration over T.
const ONE_SIDED: f32 = 0.5;
/// Share of the scale-error noise that every axis takes from the other axes' rates. Chosen: misalignments are smaller
/// than scale errors, and a turn about one axis must still widen the other two.
const CROSS_AXIS: f32 = 0.1;
/// Initial deviation of the position, m: the local frame is defined to start there, so it is exact up to this.
const START_POSITION_SIGMA_M: f32 = 0.01;
/// Initial deviation of the GNSS and height offsets, m. Chosen: the first reading of each source sets its offset and
/// replaces this (see `fusion`), so it only has to be finite and larger than that reading's noise.
const START_OFFSET_SIGMA_M: f32 = 1.0;

impl EstimatorSettings {
    /// Checks every setting against its range.
    ///
    /// # Errors
    /// The first setting that is out of range.
    pub fn validate(&self) -> Result<(), ConfigError> {
        crate::settings::check_estimator(self)
    }

    /// Process noise of a step of `step_s` seconds.
    ///
    /// `rates_in_world` are the body rates in the world frame, rad/s. `force_off` is how far the specific force is from
    /// that at rest, m/s²: a scale error times the force at rest is constant, hence part of the bias.
    pub(super) fn step_noise(&self, step_s: f32, rates_in_world: &Vector3<f32>, force_off: f32) -> StepNoise {
        let square = |walk: f32| walk * walk * step_s;
        let scale = square(self.gyro_scale) * MANOEUVRE_S;
        let gyro = ONE_SIDED * square(self.gyro_noise);
        let gnss = square(self.gnss_walk);
        let skew = CROSS_AXIS * scale * rates_in_world.norm_squared();
        StepNoise {
            theta: rates_in_world.map(|rate| gyro + scale * rate * rate + skew),
            velocity: ONE_SIDED * square(self.accel_noise) + square(self.accel_scale * force_off) * MANOEUVRE_S,
            gyro_bias: square(self.gyro_bias_walk),
            accel_bias: square(self.accel_bias_walk),
            offset: Vector3::new(gnss, gnss, square(self.baro_walk)),
            magnetic_wind: Vector3::new(square(HEADING_WALK), square(WIND_WALK), square(WIND_WALK)),
        }
    }

    /// Initial variances of the error state.
    ///
    /// `tilt` and `heading` (rad) and `speed` (m/s) are standard deviations. `averaged` is given if the gyroscope bias
    /// was averaged at rest: for how long (s), and how far the mean may be off because the vehicle swayed (rad/s).
    pub(super) fn initial(&self, tilt: f32, heading: f32, speed: f32, averaged: Option<(f32, f32)>) -> ErrorState {
        let square = |x: f32| x * x;
        let mut p = ErrorState::zeros();
        let mut set = |first: usize, values: [f32; 3]| {
            for (to, from) in p.iter_mut().skip(first).zip(values) {
                *to = square(from);
            }
        };
        // The mean of white noise over the window, plus the walk of the bias itself meanwhile.
        let seen =
            |(time, sway): (f32, f32)| self.gyro_noise / crate::math::sqrt(2.0 * time) + self.gyro_bias_walk + sway;
        set(index::THETA, [tilt, tilt, heading]);
        set(index::VELOCITY, [speed; 3]);
        set(index::POSITION, [START_POSITION_SIGMA_M; 3]);
        set(index::GYRO_BIAS, [averaged.map_or(self.gyro_bias, seen); 3]);
        set(index::ACCEL_BIAS, [self.accel_bias; 3]);
        set(index::OFFSET, [START_OFFSET_SIGMA_M; 3]);
        set(index::HEADING_OFFSET, [self.heading_offset, WIND_SIGMA, WIND_SIGMA]);
        p
    }
}
