//! Health messages: `SYS_STATUS` and `ESTIMATOR_STATUS`.

use glissade_dialect::{ESTIMATOR_STATUS_DATA, EstimatorStatusFlags, MavSysStatusSensor, SYS_STATUS_DATA};

use super::GroundInput;
use crate::estimator::status::{Sensor, Status};
use crate::math;
use crate::sensors::BatterySample;
use crate::signals::{TICK_US, Tick};

const CONTROLLERS: MavSysStatusSensor = MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_ANGULAR_RATE_CONTROL
    .union(MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_ATTITUDE_STABILIZATION)
    .union(MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_YAW_POSITION)
    .union(MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_Z_ALTITUDE_CONTROL)
    .union(MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_XY_POSITION_CONTROL)
    .union(MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_MOTOR_OUTPUTS);

/// Those of them in the outer partition.
const GUIDED: MavSysStatusSensor = MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_YAW_POSITION
    .union(MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_Z_ALTITUDE_CONTROL)
    .union(MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_XY_POSITION_CONTROL);

/// Fills in `SYS_STATUS`.
pub(super) fn sys_status(input: &GroundInput, errors: u32) -> SYS_STATUS_DATA {
    let prearm = MavSysStatusSensor::MAV_SYS_STATUS_PREARM_CHECK;
    let (sensors, healthy) = sensors(input);
    let present = CONTROLLERS | prearm | sensors;
    // There is no geofence, but a ground station takes a missing health bit for a breach.
    let mut health = CONTROLLERS | healthy | MavSysStatusSensor::MAV_SYS_STATUS_GEOFENCE;
    // Armed it has passed: scripts wait for this bit whatever the vehicle is doing.
    health.set(prearm, (input.armable || input.armed) && !input.health.hung.commander);
    health.set(GUIDED, !input.health.hung.outer);
    let sample = input.estimator.filter(|status| status.battery.healthy).and_then(|status| status.battery_sample);
    let [outer, commander, ground] = input.health.overruns.map(saturate);
    SYS_STATUS_DATA {
        onboard_control_sensors_present: present,
        onboard_control_sensors_enabled: present,
        onboard_control_sensors_health: health,
        voltage_battery: sample.map_or(u16::MAX, millivolts),
        current_battery: sample.map_or(-1, centiamperes),
        battery_remaining: -1,
        errors_comm: saturate(errors),
        errors_count1: saturate(input.health.refused_samples),
        errors_count2: outer,
        errors_count3: commander,
        errors_count4: ground,
        ..SYS_STATUS_DATA::DEFAULT
    }
}

/// Bits of the sensors that are present, and of those that are healthy. On ideal state only the ground truth is
/// present.
fn sensors(input: &GroundInput) -> (MavSysStatusSensor, MavSysStatusSensor) {
    use MavSysStatusSensor as Bit;
    let fresh = input.health.nav_fresh;
    let imu = Sensor { present: true, healthy: fresh };
    let Some(status) = &input.estimator else {
        return bits(&[(Bit::MAV_SYS_STATUS_SENSOR_EXTERNAL_GROUND_TRUTH, imu), (Bit::MAV_SYS_STATUS_AHRS, imu)]);
    };
    let known = Sensor { present: true, healthy: fresh && status.health.attitude && status.health.heading };
    bits(&[
        (Bit::MAV_SYS_STATUS_SENSOR_3D_GYRO, imu),
        (Bit::MAV_SYS_STATUS_SENSOR_3D_ACCEL, imu),
        (Bit::MAV_SYS_STATUS_SENSOR_3D_MAG, status.mag),
        (Bit::MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE, status.baro),
        (Bit::MAV_SYS_STATUS_SENSOR_GPS, status.gnss),
        (Bit::MAV_SYS_STATUS_SENSOR_EXTERNAL_GROUND_TRUTH, status.pose),
        (Bit::MAV_SYS_STATUS_SENSOR_BATTERY, status.battery),
        (Bit::MAV_SYS_STATUS_AHRS, known),
    ])
}

/// Bits of present and of healthy sensors.
fn bits(sensors: &[(MavSysStatusSensor, Sensor)]) -> (MavSysStatusSensor, MavSysStatusSensor) {
    let none = MavSysStatusSensor::empty();
    sensors.iter().fold((none, none), |(mut present, mut healthy), (bit, sensor)| {
        present.set(*bit, sensor.present);
        healthy.set(*bit, sensor.present && sensor.healthy);
        (present, healthy)
    })
}

/// Up to 65.534 V: the greatest value means unknown.
fn millivolts(sample: BatterySample) -> u16 {
    math::clamp(sample.voltage_v * 1e3, 0.0, f32::from(u16::MAX - 1)) as u16
}

/// Up to 327.67 A.
fn centiamperes(sample: BatterySample) -> i16 {
    math::clamp(sample.current_a * 1e2, 0.0, f32::from(i16::MAX)) as i16
}

fn saturate(count: u32) -> u16 {
    u16::try_from(count).unwrap_or(u16::MAX)
}

/// Fills in `ESTIMATOR_STATUS`. Heights are relative to the start, neither above mean sea level nor above ground.
pub(super) fn estimator_status(now: Tick, status: &Status) -> ESTIMATOR_STATUS_DATA {
    use EstimatorStatusFlags as Flag;
    let mut flags = Flag::empty();
    let health = &status.health;
    flags.set(Flag::ESTIMATOR_ATTITUDE, health.attitude && health.heading);
    flags.set(Flag::ESTIMATOR_VELOCITY_HORIZ, health.velocity);
    flags.set(Flag::ESTIMATOR_VELOCITY_VERT, health.climb);
    flags.set(Flag::ESTIMATOR_POS_HORIZ_REL, health.position);
    flags.set(Flag::ESTIMATOR_POS_HORIZ_ABS, health.position && status.gnss.healthy);
    let [vel_ratio, pos_horiz_ratio, pos_vert_ratio, mag_ratio] = status.ratios;
    let [pos_horiz_accuracy, pos_vert_accuracy] = status.accuracy_m;
    ESTIMATOR_STATUS_DATA {
        time_usec: u64::from(now) * u64::from(TICK_US),
        vel_ratio,
        pos_horiz_ratio,
        pos_vert_ratio,
        mag_ratio,
        pos_horiz_accuracy,
        pos_vert_accuracy,
        flags,
        ..ESTIMATOR_STATUS_DATA::DEFAULT
    }
}
