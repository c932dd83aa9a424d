//! State and health: heartbeat, `SYS_STATUS`, estimator, battery, landed state, rates of the loops.

use glissade_dialect::mavlink_core::types::CharArray;
use glissade_dialect::{
    BATTERY_STATUS_DATA, ESTIMATOR_STATUS_DATA, EXTENDED_SYS_STATE_DATA, EstimatorStatusFlags, HEARTBEAT_DATA,
    MavLandedState, MavModeFlag, MavState, MavSysStatusSensor, MavType, NAMED_VALUE_INT_DATA, SYS_STATUS_DATA,
};

use super::view::View;
use crate::commander::Mode;
use crate::estimator::status::Sensor;
use crate::math;
use crate::mavlink::writer::{Writer, frame_len};
use crate::mavlink::{GroundInput, LoopTiming, mode};
use crate::sensors::BatterySample;

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

const STICKS: MavSysStatusSensor = MavSysStatusSensor::MAV_SYS_STATUS_SENSOR_RC_RECEIVER;

/// Fills in `SYS_STATUS`.
pub(super) fn sys_status(view: &View) -> SYS_STATUS_DATA {
    let input = view.input;
    let prearm = MavSysStatusSensor::MAV_SYS_STATUS_PREARM_CHECK;
    let (sensors, healthy) = sensors(input);
    let mut present = CONTROLLERS | prearm | sensors;
    present.set(STICKS, view.latest.sticks.is_some() || view.has_had_channels);
    // There is no geofence, but a ground station takes a missing health bit for a breach.
    let mut health = CONTROLLERS | healthy | MavSysStatusSensor::MAV_SYS_STATUS_GEOFENCE;
    // Armed it has passed: scripts wait for this bit whatever the vehicle is doing.
    health.set(prearm, (input.armable || input.armed) && !input.health.hung.commander);
    health.set(STICKS, view.has_sticks());
    health.set(GUIDED, !input.health.hung.outer);
    let sample = input.battery();
    let [outer, commander, ground] = input.health.overruns.map(saturate);
    SYS_STATUS_DATA {
        onboard_control_sensors_present: present,
        onboard_control_sensors_enabled: present,
        onboard_control_sensors_health: health,
        voltage_battery: sample.map_or(u16::MAX, millivolts),
        current_battery: sample.map_or(-1, centiamperes),
        battery_remaining: view.battery_percent,
        errors_comm: saturate(view.errors),
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

/// The estimator's; `None` on ideal state. Heights are relative to the start, neither above mean sea level nor above
/// ground.
pub(super) fn estimator_status(view: &View) -> Option<ESTIMATOR_STATUS_DATA> {
    use EstimatorStatusFlags as Flag;
    let status = view.input.estimator.as_ref()?;
    let mut flags = Flag::empty();
    let health = &status.health;
    flags.set(Flag::ESTIMATOR_ATTITUDE, health.attitude && health.heading);
    flags.set(Flag::ESTIMATOR_VELOCITY_HORIZ, health.velocity);
    flags.set(Flag::ESTIMATOR_VELOCITY_VERT, health.climb);
    flags.set(Flag::ESTIMATOR_POS_HORIZ_REL, health.position);
    flags.set(Flag::ESTIMATOR_POS_HORIZ_ABS, health.position && status.gnss.healthy);
    let [vel_ratio, pos_horiz_ratio, pos_vert_ratio, mag_ratio] = status.ratios;
    let [pos_horiz_accuracy, pos_vert_accuracy] = status.accuracy_m;
    Some(ESTIMATOR_STATUS_DATA {
        time_usec: view.boot_us(),
        vel_ratio,
        pos_horiz_ratio,
        pos_vert_ratio,
        mag_ratio,
        pos_horiz_accuracy,
        pos_vert_accuracy,
        flags,
        ..ESTIMATOR_STATUS_DATA::DEFAULT
    })
}

/// The battery. The temperature is unknown.
pub(super) fn battery_status(view: &View) -> Option<BATTERY_STATUS_DATA> {
    /// `MAV_BATTERY_FUNCTION_ALL`.
    const ALL: u8 = 1;
    let sample = view.input.battery()?;
    // The voltages of the cells are not known: the whole stands in the first.
    let mut voltages = [u16::MAX; 10];
    if let Some(whole) = voltages.first_mut() {
        *whole = millivolts(sample);
    }
    Some(BATTERY_STATUS_DATA {
        battery_function: ALL,
        temperature: i16::MAX,
        voltages,
        current_battery: centiamperes(sample),
        current_consumed: -1,
        energy_consumed: -1,
        battery_remaining: view.battery_percent,
        ..BATTERY_STATUS_DATA::DEFAULT
    })
}

/// Type and mode.
pub(super) fn heartbeat(view: &View) -> HEARTBEAT_DATA {
    let input = view.input;
    let flags = MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
        | MavModeFlag::MAV_MODE_FLAG_STABILIZE_ENABLED
        | MavModeFlag::MAV_MODE_FLAG_GUIDED_ENABLED
        | MavModeFlag::MAV_MODE_FLAG_AUTO_ENABLED;
    let (armed, state) = if input.armed {
        let fails = matches!(input.mode, Mode::Descent | Mode::MotorOut);
        let state = if fails { MavState::MAV_STATE_CRITICAL } else { MavState::MAV_STATE_ACTIVE };
        (MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED, state)
    } else {
        (MavModeFlag::empty(), MavState::MAV_STATE_STANDBY)
    };
    HEARTBEAT_DATA {
        custom_mode: mode::custom_mode(input.mode),
        mavtype: MavType::MAV_TYPE_QUADROTOR as u8,
        autopilot: view.us.autopilot,
        base_mode: (flags | armed).bits() as u8,
        system_status: state as u8,
        mavlink_version: glissade_dialect::MINOR_MAVLINK_VERSION,
    }
}

/// Whether it is on the ground.
pub(super) fn extended_sys_state(view: &View) -> EXTENDED_SYS_STATE_DATA {
    let input = view.input;
    let landed_state = match input.mode {
        // Clients wait for "in the air", which it is once it has lifted off.
        Mode::TakeOff if input.landed && input.armed => MavLandedState::MAV_LANDED_STATE_TAKEOFF,
        _ if input.landed => MavLandedState::MAV_LANDED_STATE_ON_GROUND,
        Mode::Land | Mode::Descent | Mode::MotorOut => MavLandedState::MAV_LANDED_STATE_LANDING,
        _ => MavLandedState::MAV_LANDED_STATE_IN_AIR,
    };
    EXTENDED_SYS_STATE_DATA { landed_state, ..EXTENDED_SYS_STATE_DATA::DEFAULT }
}

/// Rates of the loops: all four values or none.
pub(super) fn write_timing(view: &View, timing: LoopTiming, out: &mut Writer) -> bool {
    let (shortest, longest) = timing.inner_period_us;
    let values: [(&[u8; 10], u16); 4] = [
        (b"inner_hz\0\0", timing.inner_hz),
        (b"outer_hz\0\0", timing.outer_hz),
        (b"min_us\0\0\0\0", shortest),
        (b"max_us\0\0\0\0", longest),
    ];
    out.has_room(values.len() * frame_len::<NAMED_VALUE_INT_DATA>())
        && values.into_iter().all(|(name, value)| {
            out.write(&NAMED_VALUE_INT_DATA {
                time_boot_ms: view.boot_ms(),
                value: value.into(),
                name: CharArray::new(*name),
            })
        })
}
