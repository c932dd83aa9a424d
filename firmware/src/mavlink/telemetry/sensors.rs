//! Sensors as they measure: IMU, pressure, vibration; and the estimated wind. FRD.

use glissade_dialect::{HIGHRES_IMU_DATA, SCALED_IMU_DATA, SCALED_PRESSURE_DATA, VIBRATION_DATA, WIND_COV_DATA};
use nalgebra::Vector3;

use super::view::{View, limited_i16};
use crate::estimator::models::pressure_height;
use crate::frames::flip_vector;
use crate::sensors::BaroSample;
use crate::signals::{TICK_US, Tick};

/// A sample that was measured longer ago than this is not sent, ticks.
const SILENT_AFTER: Tick = 1_500;
/// Bits of `HIGHRES_IMU_UPDATED_FLAGS`.
const ACCEL_AND_GYRO: u16 = 0x3f;
const MAG: u16 = 0x1c0;
const PRESSURE_AND_ITS_HEIGHT: u16 = 0x200 | 0x800;
/// Standard gravity, m/s²: the unit of `SCALED_IMU`.
const STANDARD_GRAVITY: f32 = 9.806_65;
/// µT in a gauss.
const GAUSS_UT: f32 = 100.0;

/// Field of the magnetometer in FRD, gauss.
fn field_gauss(view: &View) -> Option<Vector3<f32>> {
    let mag = view.input.sensors.as_ref()?.mag?;
    is_new(view, mag.at).then(|| flip_vector(&mag.field_ut) / GAUSS_UT)
}

fn pressure(view: &View) -> Option<BaroSample> {
    let baro = view.input.sensors.as_ref()?.baro?;
    is_new(view, baro.at).then_some(baro)
}

fn is_new(view: &View, at: Tick) -> bool {
    view.now.wrapping_sub(at) <= SILENT_AFTER
}

/// The sensors in SI units. NaN is unknown; no sensor measures a temperature.
pub(super) fn highres_imu(view: &View) -> Option<HIGHRES_IMU_DATA> {
    let imu = view.input.sensors.as_ref()?.imu.filter(|imu| is_new(view, imu.at))?;
    let (accel, gyro) = (flip_vector(&imu.accel), flip_vector(&imu.gyro));
    let (mag, baro) = (field_gauss(view), pressure(view));
    let field = mag.unwrap_or(Vector3::repeat(f32::NAN));
    Some(HIGHRES_IMU_DATA {
        time_usec: u64::from(imu.at) * u64::from(TICK_US),
        xacc: accel.x,
        yacc: accel.y,
        zacc: accel.z,
        xgyro: gyro.x,
        ygyro: gyro.y,
        zgyro: gyro.z,
        xmag: field.x,
        ymag: field.y,
        zmag: field.z,
        abs_pressure: baro.map_or(f32::NAN, |baro| baro.pressure_pa * 1e-2),
        diff_pressure: f32::NAN,
        pressure_alt: baro.map_or(f32::NAN, |baro| pressure_height(baro.pressure_pa)),
        temperature: f32::NAN,
        fields_updated: ACCEL_AND_GYRO
            | if mag.is_some() { MAG } else { 0 }
            | if baro.is_some() { PRESSURE_AND_ITS_HEIGHT } else { 0 },
    })
}

/// The same in mG, mrad/s and mgauss. A field that is not measured has no value there: nothing is sent without it.
pub(super) fn scaled_imu(view: &View) -> Option<SCALED_IMU_DATA> {
    let imu = view.input.sensors.as_ref()?.imu.filter(|imu| is_new(view, imu.at))?;
    let accel = flip_vector(&imu.accel) * (1e3 / STANDARD_GRAVITY);
    let gyro = flip_vector(&imu.gyro) * 1e3;
    let field = field_gauss(view)? * 1e3;
    Some(SCALED_IMU_DATA {
        time_boot_ms: (u64::from(imu.at) * u64::from(TICK_US) / 1000) as u32,
        xacc: limited_i16(accel.x),
        yacc: limited_i16(accel.y),
        zacc: limited_i16(accel.z),
        xgyro: limited_i16(gyro.x),
        ygyro: limited_i16(gyro.y),
        zgyro: limited_i16(gyro.z),
        xmag: limited_i16(field.x),
        ymag: limited_i16(field.y),
        zmag: limited_i16(field.z),
        temperature: 0,
    })
}

/// Static pressure. The temperature is not measured, for which the message has no value: 0, as for other temperatures.
pub(super) fn scaled_pressure(view: &View) -> Option<SCALED_PRESSURE_DATA> {
    let baro = pressure(view)?;
    Some(SCALED_PRESSURE_DATA {
        time_boot_ms: (u64::from(baro.at) * u64::from(TICK_US) / 1000) as u32,
        press_abs: baro.pressure_pa * 1e-2,
        press_diff: f32::NAN,
        temperature: 0,
        temperature_press_diff: 0,
    })
}

/// The estimated wind: the velocity of the air, NED. The vertical component is not estimated.
pub(super) fn wind(view: &View) -> Option<WIND_COV_DATA> {
    let ([x, y], [sigma_x, sigma_y]) = view.wind()?;
    let variance = 0.5 * (sigma_x * sigma_x + sigma_y * sigma_y);
    Some(WIND_COV_DATA {
        time_usec: view.boot_us(),
        wind_x: x,
        wind_y: -y,
        wind_z: f32::NAN,
        // How much it varies is not estimated.
        var_horiz: f32::NAN,
        var_vert: f32::NAN,
        wind_alt: view.height_msl_m().unwrap_or(f32::NAN),
        horiz_accuracy: crate::math::sqrt(variance),
        vert_accuracy: f32::NAN,
    })
}

/// Vibration per axis, m/s², and the samples of the first accelerometer that were clipped.
pub(super) fn vibration(view: &View) -> Option<VIBRATION_DATA> {
    let sensors = view.input.sensors.as_ref()?;
    let level = &sensors.vibration_m_s2;
    Some(VIBRATION_DATA {
        time_usec: view.boot_us(),
        vibration_x: level.x,
        vibration_y: level.y,
        vibration_z: level.z,
        clipping_0: sensors.clipped,
        ..VIBRATION_DATA::DEFAULT
    })
}
