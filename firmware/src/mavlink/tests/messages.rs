//! What each message says of a vehicle whose state is known, in MAVLink's units and frames. The expectations are worked
//! out by hand.

use super::status::status;
use super::*;
use crate::commander::{Orbit, OrbitHeading};
use crate::control::law::LawState;
use crate::estimator::status::Status;
use crate::frames::Origin as MapOrigin;
use crate::mavlink::report::{Aim, ControlReport, LawReport, SensorReport};
use crate::sensors::{BaroSample, Geodetic, GnssSample, ImuSample, MagSample};
use crate::signals::{MotorCommand, NavHealth};

/// Zurich, with the geoid 47 m above the ellipsoid: the origin is 441 m above mean sea level.
pub(super) const ORIGIN: MapOrigin = MapOrigin {
    place: Geodetic { latitude_e7: 473_977_000, longitude_e7: 85_456_000, height_mm: 488_000 },
    separation_mm: 47_000,
};

fn gnss() -> GnssSample {
    GnssSample {
        at: 900,
        has_fix: true,
        place: Geodetic { latitude_e7: 473_977_001, longitude_e7: -85_456_002, height_mm: 490_000 },
        velocity: Vector3::new(3.0, -4.0, 0.5),
        horizontal_accuracy_m: 1.5,
        vertical_accuracy_m: 2.25,
        speed_accuracy_m_s: 0.05,
        separation_mm: 47_000,
        utc_us: Some(1_700_000_000_000_000),
    }
}

fn estimator() -> Status {
    Status {
        sigma: [0.01, 0.02, 0.03, 0.1, 0.2, 0.3, 1.0, 2.0, 3.0],
        wind: [2.0, -1.0],
        wind_sigma: [0.5, 0.7],
        origin: Some(ORIGIN),
        ..status()
    }
}

/// A second after boot: 20 m north, 30 m east, 10 m up of the origin, heading west, on its way.
pub(super) fn vehicle() -> Bench {
    let mut bench = Bench::silent();
    bench.tick = 1_000;
    bench.input.nav = NavState {
        position: Vector3::new(20.0, -30.0, 10.0),
        velocity: Vector3::new(1.0, 2.0, -0.5),
        attitude: UnitQuaternion::from_euler_angles(0.0, 0.0, core::f32::consts::FRAC_PI_2),
        rates: Vector3::new(0.1, 0.2, 0.3),
    };
    bench.input.estimator = Some(estimator());
    bench.input.home = Some(Vector3::new(1.0, 2.0, 3.0));
    bench.input.sensors = Some(SensorReport {
        imu: Some(ImuSample { at: 999, gyro: Vector3::new(0.1, 0.2, 0.3), accel: Vector3::new(1.0, 2.0, 9.806_65) }),
        mag: Some(MagSample { at: 990, field_ut: Vector3::new(20.0, -10.0, -40.0) }),
        baro: Some(BaroSample { at: 980, pressure_pa: 95_460.8 }),
        gnss: Some(gnss()),
        vibration_m_s2: Vector3::new(0.5, 0.6, 0.7),
        clipped: 3,
    });
    bench
}

/// The answer to a request for message `id`, and how often it came.
fn requested(bench: &mut Bench, id: u32) -> Option<MavMessage> {
    let messages = bench.job(&command(REQUEST_MESSAGE, id as f32, f32::NAN));
    let accepted = messages
        .iter()
        .any(|m| matches!(m, MavMessage::COMMAND_ACK(ack) if ack.result == MavResult::MAV_RESULT_ACCEPTED));
    // A long one does not fit beside its acknowledgement.
    let found = messages.into_iter().chain(bench.job(&[])).find(|message| message.message_id() == id);
    assert_eq!(found.is_some(), accepted, "message {id}");
    found
}

macro_rules! expect {
    ($bench:expr, $name:ident, $data:ident) => {{
        let id = glissade_dialect::$data::ID;
        let Some(MavMessage::$name(message)) = requested($bench, id) else {
            panic!("{} is not sent", stringify!($name))
        };
        message
    }};
}

fn close(a: f32, b: f32) -> bool {
    crate::math::abs(a - b) <= 1e-4 * (1.0 + crate::math::abs(b))
}

#[test]
fn the_place_is_told_above_the_sea_and_above_home() {
    let told = expect!(&mut vehicle(), GLOBAL_POSITION_INT, GLOBAL_POSITION_INT_DATA);
    // 20 m on the meridian (radius 6,370,552 m at that height) and 30 m on the parallel (4,325,577 m).
    assert_eq!((told.lat, told.lon), (473_977_000 + 1_799, 85_456_000 + 3_974));
    assert_eq!((told.alt, told.relative_alt), (451_000, 7_000));
    assert_eq!((told.vx, told.vy, told.vz), (100, -200, 50));
    assert_eq!(told.hdg, 27_000, "west");
    assert_eq!(told.time_boot_ms, 1_000);
    let told = expect!(&mut vehicle(), ALTITUDE, ALTITUDE_DATA);
    assert!(close(told.altitude_amsl, 451.0), "{told:?}");
    assert_eq!((told.altitude_local, told.altitude_relative), (10.0, 7.0));
    assert!(told.altitude_terrain.is_nan() && told.bottom_clearance.is_nan());
}

#[test]
fn home_and_origin_are_told_in_both_frames() {
    let told = expect!(&mut vehicle(), HOME_POSITION, HOME_POSITION_DATA);
    assert_eq!((told.x, told.y, told.z), (1.0, -2.0, -3.0));
    assert_eq!((told.latitude, told.longitude, told.altitude), (473_977_090, 85_456_000 - 265, 444_000));
    assert!(told.q.iter().all(|q| q.is_nan()) && told.approach_x.is_nan());
    let told = expect!(&mut vehicle(), GPS_GLOBAL_ORIGIN, GPS_GLOBAL_ORIGIN_DATA);
    assert_eq!((told.latitude, told.longitude, told.altitude), (473_977_000, 85_456_000, 441_000));
}

#[test]
fn the_receivers_solution_is_told_as_it_came() {
    let told = expect!(&mut vehicle(), GPS_RAW_INT, GPS_RAW_INT_DATA);
    assert_eq!((told.fix_type, told.time_usec), (3, 900_000));
    assert_eq!((told.lat, told.lon, told.alt, told.alt_ellipsoid), (473_977_001, -85_456_002, 443_000, 490_000));
    // 3 m/s north and 4 m/s east: 53.13° clockwise from north.
    assert_eq!((told.vel, told.cog), (500, 5_313));
    assert_eq!((told.h_acc, told.v_acc, told.vel_acc), (1_500, 2_250, 50));
    assert_eq!((told.eph, told.epv, told.satellites_visible), (u16::MAX, u16::MAX, u8::MAX));
    let told = expect!(&mut vehicle(), SYSTEM_TIME, SYSTEM_TIME_DATA);
    assert_eq!((told.time_unix_usec, told.time_boot_ms), (1_700_000_000_100_000, 1_000));
    // Silent for longer than 2 s, and then without a fix.
    let mut bench = vehicle();
    bench.tick = 2_910;
    let told = expect!(&mut bench, GPS_RAW_INT, GPS_RAW_INT_DATA);
    assert_eq!((told.fix_type, told.lat, told.vel, told.cog), (0, 0, u16::MAX, u16::MAX));
    let sensors = bench.input.sensors.as_mut().expect("set");
    sensors.gnss = Some(GnssSample { at: 2_900, has_fix: false, ..gnss() });
    assert_eq!(expect!(&mut bench, GPS_RAW_INT, GPS_RAW_INT_DATA).fix_type, 1);
}

#[test]
fn attitude_and_odometry_are_in_the_frames_that_they_name() {
    let told = expect!(&mut vehicle(), ATTITUDE_QUATERNION, ATTITUDE_QUATERNION_DATA);
    // Heading west is −90° about the axis that points down.
    let half = core::f32::consts::FRAC_1_SQRT_2;
    assert!(close(told.q1, half) && close(told.q4, -half) && told.q2 == 0.0 && told.q3 == 0.0, "{told:?}");
    assert_eq!((told.rollspeed, told.pitchspeed, told.yawspeed), (0.1, -0.2, -0.3));
    let told = expect!(&mut vehicle(), ODOMETRY, ODOMETRY_DATA);
    assert_eq!((told.frame_id, told.child_frame_id), (1, 12));
    assert_eq!((told.x, told.y, told.z), (20.0, 30.0, -10.0));
    // 2 m/s to the west is forward, 1 m/s to the north is to the right.
    assert!(close(told.vx, 2.0) && close(told.vy, 1.0) && close(told.vz, 0.5), "{told:?}");
    // Variances of x, y, z, then roll and pitch, which change places, and yaw.
    for (index, variance) in [(0, 1.0), (6, 4.0), (11, 9.0), (15, 4e-4), (18, 1e-4), (20, 9e-4)] {
        assert!(crate::math::abs(told.pose_covariance[index] - variance) < 1e-6, "{index}: {:?}", told.pose_covariance);
    }
    for (index, variance) in [(0, 0.04), (6, 0.01), (11, 0.09)] {
        assert!(crate::math::abs(told.velocity_covariance[index] - variance) < 1e-6, "{index}");
    }
    assert!(told.pose_covariance[1].is_nan() && told.velocity_covariance[20].is_nan());
}

#[test]
fn the_pilots_instruments_show_air_and_ground_speed() {
    let mut bench = vehicle();
    bench.input.control.thrust_n = 5.0;
    bench.input.control.thrust_max_n = 40.0;
    let told = expect!(&mut bench, VFR_HUD, VFR_HUD_DATA);
    // √(1² + 2²) over the ground; through the air √((1 − 2)² + (2 + 1)² + 0.5²).
    assert!(close(told.groundspeed, 2.236_07) && close(told.airspeed, 3.201_56), "{told:?}");
    assert_eq!((told.heading, told.throttle, told.climb), (270, 13, -0.5));
    assert!(close(told.alt, 451.0));
    // With a wind from behind the air passes more slowly: √((3 − 2)² + (1 + 1)²).
    bench.input.nav.velocity = Vector3::new(3.0, 1.0, 0.0);
    assert!(close(expect!(&mut bench, VFR_HUD, VFR_HUD_DATA).airspeed, 2.236_07));
    bench.input.estimator = Some(Status { health: NavHealth { velocity: false, ..NavHealth::ALL }, ..estimator() });
    let told = expect!(&mut bench, VFR_HUD, VFR_HUD_DATA);
    assert!(told.groundspeed.is_nan() && told.airspeed.is_nan() && told.climb == 0.0, "{told:?}");
}

#[test]
fn the_sensors_are_told_in_front_right_down() {
    let told = expect!(&mut vehicle(), HIGHRES_IMU, HIGHRES_IMU_DATA);
    assert_eq!((told.xacc, told.yacc, told.zacc), (1.0, -2.0, -9.806_65));
    assert_eq!((told.xgyro, told.ygyro, told.zgyro), (0.1, -0.2, -0.3));
    assert_eq!((told.xmag, told.ymag, told.zmag), (0.2, 0.1, 0.4));
    // ISO 2533: 954.608 hPa at 500 m.
    assert!(close(told.abs_pressure, 954.608) && crate::math::abs(told.pressure_alt - 500.0) < 0.2, "{told:?}");
    assert!(told.temperature.is_nan() && told.diff_pressure.is_nan());
    assert_eq!((told.fields_updated, told.time_usec), (0b1011_1111_1111, 999_000));
    let told = expect!(&mut vehicle(), SCALED_IMU, SCALED_IMU_DATA);
    assert_eq!((told.xacc, told.yacc, told.zacc), (102, -204, -1_000));
    assert_eq!((told.xgyro, told.ygyro, told.zgyro), (100, -200, -300));
    assert_eq!((told.xmag, told.ymag, told.zmag), (200, 100, 400));
    let told = expect!(&mut vehicle(), SCALED_PRESSURE, SCALED_PRESSURE_DATA);
    assert!(close(told.press_abs, 954.608) && told.press_diff.is_nan() && told.temperature == 0);
    let told = expect!(&mut vehicle(), VIBRATION, VIBRATION_DATA);
    assert_eq!((told.vibration_x, told.vibration_y, told.vibration_z, told.clipping_0), (0.5, 0.6, 0.7, 3));
}

#[test]
fn wind_and_battery_are_told_with_what_is_unknown_of_them() {
    let told = expect!(&mut vehicle(), WIND_COV, WIND_COV_DATA);
    assert_eq!((told.wind_x, told.wind_y), (2.0, 1.0));
    // The root of the mean of 0.5² and 0.7²; how much the wind itself varies is not known.
    assert!(close(told.horiz_accuracy, 0.608_276), "{told:?}");
    assert!(told.wind_z.is_nan() && told.var_horiz.is_nan() && told.var_vert.is_nan());
    let told = expect!(&mut vehicle(), BATTERY_STATUS, BATTERY_STATUS_DATA);
    assert_eq!((told.voltages[0], told.voltages[1], told.current_battery), (15_250, u16::MAX, 1_250));
    assert_eq!((told.battery_remaining, told.current_consumed, told.temperature), (-1, -1, i16::MAX));
}

const ORBIT: Orbit = Orbit {
    center: Vector3::new(1.1118, -0.7551, 10.0),
    radius_m: 8.0,
    speed_m_s: -3.0,
    heading: OrbitHeading::Center,
};

pub(super) fn flying() -> ControlReport {
    let aim = Aim {
        attitude: UnitQuaternion::identity(),
        rates: Vector3::new(0.1, 0.2, 0.3),
        thrust_n: 10.0,
        place: nalgebra::Vector4::new(1.0, 2.0, 3.0, 0.5),
        velocity: Vector3::new(4.0, 5.0, 6.0),
        acceleration: Vector3::new(7.0, 8.0, 9.0),
        yaw_rate: 0.25,
        holds_position: true,
        holds_heading: true,
    };
    let law = |first: f32| LawReport {
        s: Vector3::new(first, 2.0, 3.0),
        state: LawState { reaching: Vector3::new(4.0, 5.0, 6.0), disturbance: Vector3::new(7.0, 8.0, 9.0) },
    };
    ControlReport {
        aim: Some(aim),
        orbit: Some(ORBIT),
        attitude_law: law(1.0),
        position_law: law(10.0),
        motors: MotorCommand { omega_rad_s: [0.0, 250.0, 500.0, 1_000.0] },
        rotor_speeds_rad_s: [104.719_76, 0.0, 523.598_8, 1_000.0],
        thrust_n: 10.0,
        thrust_max_n: 40.0,
        omega_max_rad_s: 1_000.0,
    }
}

#[test]
fn the_circle_is_told_on_the_map_while_one_is_flown() {
    let mut bench = vehicle();
    assert_eq!(requested(&mut bench, 360), None);
    bench.input.control = flying();
    let told = expect!(&mut bench, ORBIT_EXECUTION_STATUS, ORBIT_EXECUTION_STATUS_DATA);
    assert_eq!((told.radius, told.frame), (8.0, 5));
    assert!(
        (told.x - 473_977_100).abs() < 2 && (told.y - 85_456_100).abs() < 2 && crate::math::abs(told.z - 451.0) < 0.01
    );
}

#[test]
fn what_is_aimed_at_is_told_while_something_is() {
    let mut bench = vehicle();
    assert_eq!(requested(&mut bench, 83), None);
    assert_eq!(requested(&mut bench, 85), None);
    bench.input.control = flying();
    let told = expect!(&mut bench, ATTITUDE_TARGET, ATTITUDE_TARGET_DATA);
    assert_eq!((told.q, told.thrust, told.type_mask), ([1.0, 0.0, 0.0, 0.0], 0.25, 0));
    assert_eq!((told.body_roll_rate, told.body_pitch_rate, told.body_yaw_rate), (0.1, -0.2, -0.3));
    let told = expect!(&mut bench, POSITION_TARGET_LOCAL_NED, POSITION_TARGET_LOCAL_NED_DATA);
    assert_eq!((told.coordinate_frame, told.type_mask), (1, 0));
    assert_eq!((told.x, told.y, told.z, told.yaw), (1.0, -2.0, -3.0, -0.5));
    assert_eq!((told.vx, told.vy, told.vz, told.yaw_rate), (4.0, -5.0, -6.0, -0.25));
    assert_eq!((told.afx, told.afy, told.afz), (7.0, -8.0, -9.0));
    let aim = bench.input.control.aim.as_mut().expect("set");
    (aim.holds_position, aim.holds_heading) = (false, false);
    let told = expect!(&mut bench, POSITION_TARGET_LOCAL_NED, POSITION_TARGET_LOCAL_NED_DATA);
    // The yaw rate is not controlled; the attitude is.
    assert_eq!(expect!(&mut bench, ATTITUDE_TARGET, ATTITUDE_TARGET_DATA).type_mask, 0b100);
    // x, y, vx, vy, afx, afy, yaw and yaw rate are not controlled; z, vz and afz are.
    assert_eq!(told.type_mask, 0b1100_1101_1011);
}

#[test]
fn rotors_and_control_laws_are_told() {
    let mut bench = vehicle();
    bench.input.control = flying();
    let told = expect!(&mut bench, SERVO_OUTPUT_RAW, SERVO_OUTPUT_RAW_DATA);
    assert_eq!((told.servo1_raw, told.servo2_raw, told.servo3_raw, told.servo4_raw), (1_000, 1_250, 1_500, 2_000));
    let told = expect!(&mut bench, ESC_STATUS, ESC_STATUS_DATA);
    assert_eq!(told.rpm, [1_000, 0, 5_000, 9_549]);
    assert!(told.voltage.iter().chain(&told.current).all(|value| value.is_nan()));
    let told = expect!(&mut bench, DEBUG_FLOAT_ARRAY, DEBUG_FLOAT_ARRAY_DATA);
    assert_eq!(told.name.to_str(), Ok("smc"));
    let numbers: Vec<f32> = (1..10).map(|n| n as f32).collect();
    assert_eq!(told.data[..9], numbers[..]);
    assert_eq!((told.data[9], told.data[17], told.data[18]), (10.0, 9.0, 0.0));
}

#[test]
fn the_modes_that_can_be_set_are_listed_in_order() {
    let mut bench = vehicle();
    let messages = bench.job(&command(REQUEST_MESSAGE, 435.0, 0.0));
    let rest = bench.jobs(5);
    let listed: Vec<_> = messages
        .iter()
        .chain(&rest)
        .filter_map(|m| if let MavMessage::AVAILABLE_MODES(m) = m { Some(m) } else { None })
        .collect();
    let numbers: Vec<_> = listed.iter().map(|mode| (mode.mode_index, mode.number_modes)).collect();
    assert_eq!(numbers, (1..=11).map(|number| (number, 11)).collect::<Vec<_>>());
    let coded: Vec<_> = listed.iter().map(|mode| (mode.custom_mode >> 16 & 0xff, mode.custom_mode >> 24)).collect();
    assert_eq!(coded, [(4, 2), (4, 3), (4, 4), (4, 5), (4, 6), (3, 0), (2, 0), (7, 0), (5, 0), (3, 1), (6, 0)]);
    let standard: Vec<_> = listed.iter().map(|mode| mode.standard_mode).collect();
    assert_eq!(standard, [8, 0, 6, 5, 7, 1, 4, 0, 0, 2, 0]);
    assert_eq!(listed[3].mode_name.to_str(), Ok("Return"));
    // One alone, and one that does not exist.
    let messages = bench.job(&command(REQUEST_MESSAGE, 435.0, 3.0));
    let one = messages.iter().find_map(|m| if let MavMessage::AVAILABLE_MODES(m) = m { Some(m) } else { None });
    assert_eq!(one.expect("sent").mode_name.to_str(), Ok("Mission"));
    assert_eq!(bench.result_of(&command(REQUEST_MESSAGE, 435.0, 12.0)), Some(MavResult::MAV_RESULT_DENIED));
    bench.input.mode = Mode::Return;
    let told = expect!(&mut bench, CURRENT_MODE, CURRENT_MODE_DATA);
    assert_eq!((told.standard_mode, told.custom_mode, told.intended_custom_mode), (5, 5 << 24 | 4 << 16, 0));
    let told = expect!(&mut bench, PROTOCOL_VERSION, PROTOCOL_VERSION_DATA);
    assert_eq!((told.version, told.min_version, told.max_version), (200, 100, 200));
}

#[test]
fn what_is_unknown_is_neither_streamed_nor_sent_on_request() {
    let mut bench = vehicle();
    let lost = |health| Some(Status { health, ..estimator() });
    bench.input.estimator = lost(NavHealth { position: false, ..NavHealth::ALL });
    for id in [32, 33, 331] {
        assert_eq!(requested(&mut bench, id), None, "message {id} without a position");
    }
    assert!(requested(&mut bench, 141).is_some(), "the height is known");
    bench.input.estimator = lost(NavHealth { heading: false, ..NavHealth::ALL });
    assert_eq!(expect!(&mut bench, GLOBAL_POSITION_INT, GLOBAL_POSITION_INT_DATA).hdg, u16::MAX);
    assert_eq!(requested(&mut bench, 74), None, "no heading");
    bench.input.estimator = lost(NavHealth::NONE);
    for id in [30, 31, 32, 33, 74, 141, 331] {
        assert_eq!(requested(&mut bench, id), None, "message {id} of an unknown motion");
    }
    bench.input.estimator = Some(Status { origin: None, wind_sigma: [5.0; 2], ..estimator() });
    for id in [33, 49, 242] {
        assert_eq!(requested(&mut bench, id), None, "message {id} without a map");
    }
    assert_eq!(expect!(&mut bench, WIND_COV, WIND_COV_DATA).horiz_accuracy, 5.0, "a wind that nobody has felt");
    let told = expect!(&mut bench, VFR_HUD, VFR_HUD_DATA);
    assert!(told.alt.is_nan() && told.airspeed.is_nan() && told.groundspeed > 2.0);
    assert!(expect!(&mut bench, ALTITUDE, ALTITUDE_DATA).altitude_amsl.is_nan());
    (bench.input.estimator, bench.input.home) = (Some(estimator()), None);
    assert_eq!(requested(&mut bench, 242), None, "no home");
    assert!(expect!(&mut bench, ALTITUDE, ALTITUDE_DATA).altitude_relative.is_nan());
    bench.input.sensors = Some(SensorReport::default());
    for id in [24, 26, 29, 105] {
        assert_eq!(requested(&mut bench, id), None, "message {id} of sensors that are silent");
    }
    assert_eq!(expect!(&mut bench, SYSTEM_TIME, SYSTEM_TIME_DATA).time_unix_usec, 0);
    (bench.input.sensors, bench.input.estimator) = (None, None);
    for id in [24, 26, 29, 105, 147, 230, 231, 241] {
        assert_eq!(requested(&mut bench, id), None, "message {id} on ideal state");
    }
}

#[test]
fn a_sensor_that_is_silent_is_left_out() {
    let mut bench = vehicle();
    let sensors = bench.input.sensors.as_mut().expect("set");
    (sensors.mag, sensors.baro) = (None, None);
    let told = expect!(&mut bench, HIGHRES_IMU, HIGHRES_IMU_DATA);
    assert_eq!(told.fields_updated, 0x3f);
    assert!(told.xmag.is_nan() && told.abs_pressure.is_nan() && told.pressure_alt.is_nan());
    assert_eq!(requested(&mut bench, 26), None, "its field has no value for unknown");
    bench.tick = 2_500;
    assert_eq!(requested(&mut bench, 105), None, "the IMU's sample is 1.5 s old");
}
