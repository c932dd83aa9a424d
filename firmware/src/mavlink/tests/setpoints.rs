//! Set-points of companion computers: every mask, every frame, who counts, what is refused.

use glissade_dialect::{
    SET_ATTITUDE_TARGET_DATA, SET_POSITION_TARGET_GLOBAL_INT_DATA, SET_POSITION_TARGET_LOCAL_NED_DATA,
};

use super::messages::ORIGIN;
use super::status::status;
use super::*;
use crate::estimator::status::Status;
use crate::guidance::stream::Motion;
use crate::latest::{AttitudeSetPoint, SetPoint};

const LOCAL: SET_POSITION_TARGET_LOCAL_NED_DATA = SET_POSITION_TARGET_LOCAL_NED_DATA {
    time_boot_ms: 77,
    target_system: 1,
    target_component: 1,
    coordinate_frame: 1,
    type_mask: 0,
    x: 1.0,
    y: 2.0,
    z: -3.0,
    vx: 0.1,
    vy: 0.2,
    vz: -0.3,
    afx: 0.01,
    afy: 0.02,
    afz: -0.03,
    yaw: 0.5,
    yaw_rate: 0.25,
};

/// At the origin, which is 441 m above mean sea level, heading west.
fn vehicle() -> Bench {
    let mut bench = Bench::silent();
    bench.input.estimator = Some(Status { origin: Some(ORIGIN), ..status() });
    bench.input.nav.position = Vector3::new(10.0, 20.0, 30.0);
    bench.input.nav.attitude = UnitQuaternion::from_euler_angles(0.0, 0.0, core::f32::consts::FRAC_PI_2);
    bench
}

/// The set-point after a message, or the text that refuses it. The time before lets another one be told.
fn read(bench: &mut Bench, message: &impl MessageData) -> Result<SetPoint, String> {
    bench.ground.latest.setpoint = None;
    bench.jobs(201);
    let (output, messages) = bench.output_of(&frame(message));
    let text = messages.iter().find_map(|m| match m {
        MavMessage::STATUSTEXT(m) => Some(m.text.to_str().expect("text").to_owned()),
        _ => None,
    });
    match (output.latest.setpoint, text) {
        (Some(setpoint), None) => Ok(setpoint.value),
        (None, Some(text)) => Err(text),
        other => panic!("{other:?}"),
    }
}

fn motion(bench: &mut Bench, message: &impl MessageData) -> Motion {
    let Ok(SetPoint::Motion { motion, .. }) = read(bench, message) else { panic!("refused") };
    motion
}

#[test]
fn each_mask_is_obeyed_to_the_letter_or_refused() {
    let mut bench = vehicle();
    let (mut obeyed, mut refused) = (0, 0);
    for mask in 0..1 << 12 {
        // 201 jobs a mask would take minutes: texts are not the subject.
        bench.ground.latest.setpoint = None;
        let message = SET_POSITION_TARGET_LOCAL_NED_DATA { type_mask: mask, ..LOCAL };
        let setpoint = bench.output_of(&frame(&message)).0.latest.setpoint;
        let given = |bit: u16, value: f32| (mask >> bit & 1 == 0).then_some(value);
        let pairs = [0, 3, 6].map(|first| mask >> first & 3);
        let is_whole = pairs.iter().all(|pair| [0, 3].contains(pair));
        let forces = mask >> 9 & 1 == 1 && mask >> 6 & 7 != 7;
        let nothing = mask & 0xdff == 0xdff;
        if !is_whole || forces || nothing {
            assert_eq!(setpoint, None, "{mask:#x}");
            refused += 1;
            continue;
        }
        let Some(SetPoint::Motion { motion, sent_ms }) = setpoint.map(|setpoint| setpoint.value) else {
            panic!("{mask:#x}")
        };
        assert_eq!(sent_ms, Some(77));
        // North, west, up.
        assert_eq!(motion.position(), [given(0, 1.0), given(1, -2.0), given(2, 3.0)], "{mask:#x}");
        assert_eq!(motion.velocity(), [given(3, 0.1), given(4, -0.2), given(5, 0.3)], "{mask:#x}");
        assert_eq!(motion.acceleration(), [given(6, 0.01), given(7, -0.02), given(8, 0.03)], "{mask:#x}");
        assert_eq!((motion.yaw(), motion.yaw_rate()), (given(10, -0.5), given(11, -0.25)), "{mask:#x}");
        obeyed += 1;
    }
    // 2 choices for each x-y pair, z and angle: 2^8, twice for the force bit; less the forces, and nothing at all.
    assert_eq!((obeyed, refused), (318, 4096 - 318));
}

#[test]
fn a_number_that_is_nan_is_not_given_and_what_is_out_of_range_is_refused() {
    let mut bench = vehicle();
    let nan = SET_POSITION_TARGET_LOCAL_NED_DATA { vx: f32::NAN, vy: f32::NAN, yaw: f32::NAN, ..LOCAL };
    let told = motion(&mut bench, &nan);
    assert_eq!((told.velocity(), told.yaw()), ([None, None, Some(0.3)], None));
    let refusal = |reason: &str| Err(format!("Set-point refused: {reason}"));
    for message in [
        SET_POSITION_TARGET_LOCAL_NED_DATA { x: 2e4, ..LOCAL },
        SET_POSITION_TARGET_LOCAL_NED_DATA { vz: f32::INFINITY, ..LOCAL },
        SET_POSITION_TARGET_LOCAL_NED_DATA { afx: 1e3, ..LOCAL },
        SET_POSITION_TARGET_LOCAL_NED_DATA { yaw_rate: 1e3, ..LOCAL },
        SET_POSITION_TARGET_LOCAL_NED_DATA { yaw: 100.0, ..LOCAL },
    ] {
        assert_eq!(read(&mut bench, &message), refusal("out of range"), "{message:?}");
    }
    for type_mask in [0x1000, 0x8000, 0x0001] {
        let message = SET_POSITION_TARGET_LOCAL_NED_DATA { type_mask, ..LOCAL };
        assert_eq!(read(&mut bench, &message), refusal("mask not supported"));
    }
    for coordinate_frame in [0, 2, 3, 4, 10, 13, 20, 21, 99] {
        let message = SET_POSITION_TARGET_LOCAL_NED_DATA { coordinate_frame, ..LOCAL };
        assert_eq!(read(&mut bench, &message), refusal("frame not supported"));
    }
}

#[test]
fn frames_of_the_body_are_turned_by_its_heading_and_counted_from_the_vehicle() {
    let mut bench = vehicle();
    // Heading west: forward is west, right is north.
    for (coordinate_frame, place, speed, yaw) in [
        (7, [11.0, 18.0, 33.0], [0.1, -0.2, 0.3], -0.5),
        (8, [12.0, 21.0, 33.0], [0.2, 0.1, 0.3], -0.5),
        (9, [12.0, 21.0, 33.0], [0.2, 0.1, 0.3], 1.0708),
        (12, [12.0, 21.0, 33.0], [0.2, 0.1, 0.3], 1.0708),
    ] {
        let told = motion(&mut bench, &SET_POSITION_TARGET_LOCAL_NED_DATA { coordinate_frame, ..LOCAL });
        let near = |a: [Option<f32>; 3], b: [f32; 3]| {
            a.iter().zip(b).all(|(a, b)| a.is_some_and(|a| crate::math::abs(a - b) < 1e-5))
        };
        assert!(near(told.position(), place) && near(told.velocity(), speed), "{coordinate_frame}: {told:?}");
        assert!(told.yaw().is_some_and(|told| crate::math::abs(told - yaw) < 1e-4), "{coordinate_frame}: {told:?}");
    }
}

#[test]
fn a_place_on_earth_is_taken_in_every_frame_that_says_where_it_is() {
    let mut bench = vehicle();
    bench.input.home = Some(Vector3::new(0.0, 0.0, 1.0));
    let there = SET_POSITION_TARGET_GLOBAL_INT_DATA {
        target_system: 1,
        target_component: 1,
        type_mask: 0xdf8,
        lat_int: 473_977_100,
        lon_int: 85_456_100,
        ..SET_POSITION_TARGET_GLOBAL_INT_DATA::DEFAULT
    };
    for (coordinate_frame, alt, up) in [(0, 451.0, 10.0), (5, 451.0, 10.0), (3, 10.0, 11.0), (6, 10.0, 11.0)] {
        let message = SET_POSITION_TARGET_GLOBAL_INT_DATA { coordinate_frame, alt, ..there.clone() };
        let [Some(x), Some(y), Some(z)] = motion(&mut bench, &message).position() else { panic!("a place") };
        let off = Vector3::new(x, y, z) - Vector3::new(1.1118, -0.7551, up);
        assert!(off.norm_squared() < 1e-4, "{coordinate_frame}: {off}");
        // The height alone, and the place alone.
        let height = SET_POSITION_TARGET_GLOBAL_INT_DATA { type_mask: 0xdfb, ..message.clone() };
        let [None, None, Some(z)] = motion(&mut bench, &height).position() else { panic!("a height") };
        assert!(crate::math::abs(z - up) < 0.01, "{coordinate_frame}: {z}");
        let level = SET_POSITION_TARGET_GLOBAL_INT_DATA { type_mask: 0xdfc, ..message };
        assert!(matches!(motion(&mut bench, &level).position(), [Some(_), Some(_), None]));
    }
    let refusal = |reason: &str| Err(format!("Set-point refused: {reason}"));
    for coordinate_frame in [1, 2, 10, 11, 99] {
        let message = SET_POSITION_TARGET_GLOBAL_INT_DATA { coordinate_frame, ..there.clone() };
        assert_eq!(read(&mut bench, &message), refusal("frame not supported"));
    }
    let beyond = SET_POSITION_TARGET_GLOBAL_INT_DATA { lat_int: 900_000_001, ..there.clone() };
    assert_eq!(read(&mut bench, &beyond), refusal("out of range"));
    bench.input.estimator = Some(status());
    assert_eq!(read(&mut bench, &there), refusal("origin unknown"));
}

#[test]
fn an_attitude_or_its_rates_are_taken_with_a_thrust() {
    let mut bench = vehicle();
    let target = SET_ATTITUDE_TARGET_DATA {
        target_system: 1,
        target_component: 1,
        q: [0.8, 0.0, 0.6, 0.0],
        body_roll_rate: 0.1,
        body_pitch_rate: 0.2,
        body_yaw_rate: 0.3,
        thrust: 0.5,
        ..SET_ATTITUDE_TARGET_DATA::DEFAULT
    };
    let attitude = UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(0.8, 0.0, -0.6, 0.0));
    for (type_mask, attitude, rates) in [
        (0, Some(attitude), [0.1, -0.2, -0.3]),
        (7, Some(attitude), [0.0; 3]),
        (3, Some(attitude), [0.0, 0.0, -0.3]),
        (128, None, [0.1, -0.2, -0.3]),
    ] {
        let message = SET_ATTITUDE_TARGET_DATA { type_mask, ..target.clone() };
        let Ok(SetPoint::Attitude(told)) = read(&mut bench, &message) else { panic!("refused") };
        let AttitudeSetPoint { attitude: told_attitude, rates: told_rates, thrust } = told;
        assert_eq!((told_attitude.is_some(), thrust), (attitude.is_some(), 0.5));
        assert!((told_rates - Vector3::from(rates)).norm_squared() < 1e-10);
        if let (Some(told), Some(attitude)) = (told_attitude, attitude) {
            assert!(told.angle_to(&attitude) < 1e-3);
        }
    }
    for wrong in [
        SET_ATTITUDE_TARGET_DATA { type_mask: 64, ..target.clone() },
        SET_ATTITUDE_TARGET_DATA { type_mask: 129, ..target.clone() },
        SET_ATTITUDE_TARGET_DATA { q: [0.0; 4], ..target.clone() },
        SET_ATTITUDE_TARGET_DATA { q: [f32::NAN, 0.0, 0.0, 0.0], ..target.clone() },
        SET_ATTITUDE_TARGET_DATA { thrust: f32::NAN, ..target.clone() },
        SET_ATTITUDE_TARGET_DATA { thrust: -0.1, ..target.clone() },
        SET_ATTITUDE_TARGET_DATA { body_roll_rate: f32::NAN, ..target },
    ] {
        assert!(read(&mut bench, &wrong).is_err(), "{wrong:?}");
    }
}

#[test]
fn the_first_who_streams_counts_until_its_stream_is_lost() {
    let mut bench = vehicle();
    let from = |system_id: u32, x: f32| {
        let header = MavHeader { system_id, ..STATION };
        frame_from(header, &SET_POSITION_TARGET_LOCAL_NED_DATA { x, ..LOCAL })
    };
    let wanted = |bench: &mut Bench, bytes: &[u8]| {
        let setpoint = bench.output_of(bytes).0.latest.setpoint.expect("a set-point").value;
        let SetPoint::Motion { motion, .. } = setpoint else { panic!("a motion") };
        motion.position()[0].expect("given")
    };
    assert_eq!(wanted(&mut bench, &from(255, 1.0)), 1.0);
    for _ in 0..99 {
        assert_eq!(wanted(&mut bench, &from(254, 2.0)), 1.0);
    }
    bench.jobs(2);
    assert_eq!(wanted(&mut bench, &from(254, 2.0)), 2.0, "after COM_OF_LOSS_T of silence");
    assert_eq!(wanted(&mut bench, &from(255, 1.0)), 2.0);
}

#[test]
fn a_stream_that_is_refused_is_told_of_every_two_seconds() {
    let mut bench = vehicle();
    let bytes = frame(&SET_POSITION_TARGET_LOCAL_NED_DATA { coordinate_frame: 2, ..LOCAL });
    let texts: usize = (0..500).map(|_| count(&bench.job(&bytes), 253)).sum();
    assert_eq!(texts, 3, "in 5 s");
}

/// A place from the vehicle stands still when it is sent; one of the map moves as its successors tell.
#[test]
fn a_place_in_a_frame_that_moves_with_the_vehicle_has_no_speed() {
    let mut bench = vehicle();
    for (coordinate_frame, speed) in [(1, None), (7, Some(0.0)), (8, Some(0.0)), (9, Some(0.0)), (12, Some(0.0))] {
        let alone = SET_POSITION_TARGET_LOCAL_NED_DATA { coordinate_frame, type_mask: 0b1101_1111_1000, ..LOCAL };
        assert_eq!(motion(&mut bench, &alone).velocity(), [speed; 3], "{coordinate_frame}");
    }
}
