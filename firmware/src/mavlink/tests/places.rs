//! Commands and messages that carry a place or a height, and the telemetry of home and origin.

use glissade_dialect::SET_GPS_GLOBAL_ORIGIN_DATA;

use super::messages::ORIGIN;
use super::status::status;
use super::*;
use crate::commander::TAKE_OFF_HEIGHT_M;
use crate::estimator::status::Status;
use crate::frames::Origin as MapOrigin;

const TAKEOFF: u16 = 22;
const SET_HOME: u16 = 179;
const GET_HOME: u16 = 410;

/// On the ground at the origin, 441 m above mean sea level.
fn landed() -> Bench {
    let mut bench = Bench::silent();
    bench.input.estimator = Some(Status { origin: Some(ORIGIN), ..status() });
    bench.input.home = Some(Vector3::zeros());
    bench
}

fn int(command: u16, frame_of: u8, param1: f32, [x, y]: [i32; 2], z: f32) -> Vec<u8> {
    let int = COMMAND_INT_DATA {
        target_system: 1,
        target_component: 1,
        command,
        frame: frame_of,
        param1,
        x,
        y,
        z,
        ..COMMAND_INT_DATA::DEFAULT
    };
    frame(&int)
}

fn long(command: u16, param1: f32, param7: f32) -> Vec<u8> {
    frame(&COMMAND_LONG_DATA {
        target_system: 1,
        target_component: 1,
        command,
        param1,
        param7,
        ..COMMAND_LONG_DATA::DEFAULT
    })
}

#[test]
fn a_take_off_height_is_above_what_its_frame_says() {
    let mut bench = landed();
    for (bytes, height_m) in [
        (int(TAKEOFF, 0, 0.0, [0, 0], 451.0), 10.0),
        (int(TAKEOFF, 5, 0.0, [0, 0], 443.0), 2.0),
        (int(TAKEOFF, 3, 0.0, [0, 0], 7.0), 7.0),
        (int(TAKEOFF, 6, 0.0, [0, 0], 451.0), 451.0),
        (int(TAKEOFF, 3, 0.0, [0, 0], f32::NAN), TAKE_OFF_HEIGHT_M),
        // MAVProxy's relative height and QGroundControl's above mean sea level.
        (long(TAKEOFF, 0.0, 5.0), 5.0),
        (long(TAKEOFF, 0.0, 446.0), 5.0),
        (long(TAKEOFF, 0.0, f32::NAN), TAKE_OFF_HEIGHT_M),
    ] {
        assert_eq!(bench.result_of(&bytes), None, "the commander decides");
        let Some(Command { request: Request::TakeOff { height_m: told }, .. }) = bench.commands.pop() else {
            panic!("no take-off")
        };
        assert!(crate::math::abs(told - height_m) < 1e-3, "{told} is not {height_m}");
    }
    for frame in [1, 2, 8, 10, 22, 99, 255] {
        let result = bench.result_of(&int(TAKEOFF, frame, 0.0, [0, 0], 5.0));
        assert_eq!(result, Some(MavResult::MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME), "{frame}");
    }
    // Without a map a height above mean sea level means nothing.
    bench.input.estimator = Some(status());
    let result = bench.result_of(&int(TAKEOFF, 0, 0.0, [0, 0], 451.0));
    assert_eq!(result, Some(MavResult::MAV_RESULT_TEMPORARILY_REJECTED));
    assert_eq!(bench.result_of(&long(TAKEOFF, 0.0, 446.0)), None);
    assert_eq!(bench.commands.pop(), Some(from_station(TAKEOFF, Request::TakeOff { height_m: 446.0 })));
}

#[test]
fn a_height_above_the_sea_is_the_same_when_it_is_repeated_in_the_climb() {
    let mut bench = landed();
    (bench.input.ground_m, bench.input.nav.position.z) = (2.0, 2.0);
    for (up_m, landed) in [(2.0, true), (3.5, false), (9.0, false)] {
        (bench.input.nav.position.z, bench.input.landed) = (up_m, landed);
        // The ground is 441 m + 2 m above the sea.
        bench.job(&int(TAKEOFF, 0, 0.0, [0, 0], 455.0));
        let Some(Command { request: Request::TakeOff { height_m }, .. }) = bench.commands.pop() else {
            panic!("no take-off")
        };
        assert!(crate::math::abs(height_m - 12.0) < 2e-3, "{height_m} m at {up_m} m");
    }
}

#[test]
fn home_is_set_here_or_at_a_place() {
    let mut bench = landed();
    for bytes in [long(SET_HOME, 1.0, 0.0), int(SET_HOME, 0, 1.0, [0, 0], 0.0)] {
        assert_eq!(bench.result_of(&bytes), None);
        assert_eq!(bench.commands.pop(), Some(from_station(SET_HOME, Request::SetHome { position_m: None })));
    }
    // 1e-5° on the meridian are 1.11179 m there, and 0.75505 m on the parallel.
    let there = [473_977_100, 85_456_100];
    for (frame, z, up) in [(0, 446.0, 5.0), (5, 446.0, 5.0), (3, 5.0, 5.0), (6, 5.0, 5.0)] {
        assert_eq!(bench.result_of(&int(SET_HOME, frame, 0.0, there, z)), None);
        let Some(Command { request: Request::SetHome { position_m: Some(told) }, .. }) = bench.commands.pop() else {
            panic!("no home")
        };
        let off = Vector3::from(told) - Vector3::new(1.1118, -0.7551, up);
        assert!(off.norm_squared() < 1e-5, "{told:?}");
    }
    for (bytes, result) in [
        (long(SET_HOME, 0.0, 0.0), MavResult::MAV_RESULT_COMMAND_INT_ONLY),
        (long(SET_HOME, 2.0, 0.0), MavResult::MAV_RESULT_DENIED),
        (int(SET_HOME, 0, f32::NAN, there, 446.0), MavResult::MAV_RESULT_DENIED),
        (int(SET_HOME, 1, 0.0, there, 0.0), MavResult::MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME),
        (int(SET_HOME, 0, 0.0, [900_000_001, 0], 0.0), MavResult::MAV_RESULT_DENIED),
        (int(SET_HOME, 0, 0.0, [0, i32::MIN], 0.0), MavResult::MAV_RESULT_DENIED),
        (int(SET_HOME, 0, 0.0, there, f32::NAN), MavResult::MAV_RESULT_DENIED),
    ] {
        assert_eq!(bench.result_of(&bytes), Some(result));
    }
    bench.input.estimator = Some(status());
    let messages = bench.job(&int(SET_HOME, 0, 0.0, there, 446.0));
    let [MavMessage::COMMAND_ACK(ack), MavMessage::STATUSTEXT(text)] = messages.as_slice() else {
        panic!("{messages:?}")
    };
    assert_eq!(ack.result, MavResult::MAV_RESULT_TEMPORARILY_REJECTED);
    assert_eq!(text.text.to_str(), Ok("Setting home refused: origin unknown"));
    assert!(bench.commands.is_empty());
}

#[test]
fn a_home_at_a_relative_height_is_the_same_however_often_it_is_set() {
    let mut bench = landed();
    for frame in [3, 6] {
        for home_m in [0.0, 5.0, 20.0] {
            bench.input.home = Some(Vector3::new(0.0, 0.0, home_m));
            bench.job(&int(SET_HOME, frame, 0.0, [473_977_100, 85_456_100], 5.0));
            let Some(Command { request: Request::SetHome { position_m: Some([_, _, up]) }, .. }) = bench.commands.pop()
            else {
                panic!("no home")
            };
            assert!(crate::math::abs(up - 5.0) < 2e-3, "{up} m from a home at {home_m} m");
        }
    }
}

#[test]
fn a_home_that_follows_a_noisy_estimate_is_told_at_its_interval() {
    let mut bench = landed();
    let told = |bench: &mut Bench, jobs: u32| {
        let messages: Vec<_> = (0..jobs)
            .flat_map(|job| {
                let noise = if job % 2 == 0 { 0.3 } else { -0.3 };
                bench.input.home = Some(Vector3::new(noise, -noise, 0.1));
                bench.job(&[])
            })
            .collect();
        [242, 49].map(|id| count(&messages, id))
    };
    bench.set_interval(242.0, 2e6);
    bench.set_interval(49.0, 5e6);
    told(&mut bench, 10);
    assert_eq!(told(&mut bench, 1_000), [5, 2], "every 2 s and every 5 s");
    bench.ground.links[0].telemetry.set_interval(bench.tick, 242.0, 10e6).expect("allowed");
    told(&mut bench, 10);
    assert_eq!(told(&mut bench, 900), [0, 1], "every 10 s");
    // Armed it stands still: whatever moves it is news, and so is the arming.
    bench.input.armed = true;
    assert_eq!(count(&bench.job(&[]), 242), 1);
    assert_eq!(count(&bench.jobs(50), 242), 0);
    bench.input.home = Some(Vector3::new(0.5, 0.0, 0.0));
    assert_eq!(count(&bench.job(&[]), 242), 1);
    assert_eq!(count(&bench.jobs(50), 242), 0);
    // Another origin is another place of home too.
    let place = crate::sensors::Geodetic { latitude_e7: 473_000_000, ..ORIGIN.place };
    bench.input.estimator = Some(Status { origin: Some(MapOrigin { place, ..ORIGIN }), ..status() });
    let messages = bench.job(&[]);
    assert_eq!([242, 49].map(|id| count(&messages, id)), [1, 1]);
}

#[test]
fn home_is_told_on_request_and_when_it_changes() {
    let mut bench = landed();
    bench.input.home = None;
    assert_eq!(bench.result_of(&command(GET_HOME, 0.0, 0.0)), Some(MavResult::MAV_RESULT_TEMPORARILY_REJECTED));
    bench.input.home = Some(Vector3::zeros());
    assert_eq!(count(&bench.job(&command(GET_HOME, 0.0, 0.0)), 242), 1);
    bench.ground.links[0].telemetry.set_interval(bench.tick, 242.0, 10e6).expect("allowed");
    assert_eq!(count(&bench.jobs(100), 242), 1, "as it was switched on");
    bench.input.home = Some(Vector3::new(5.0, 0.0, 0.0));
    assert_eq!(count(&bench.jobs(1), 242), 1, "at once");
    assert_eq!(count(&bench.jobs(100), 242), 0);
}

#[test]
fn home_is_told_at_once_when_the_vehicle_is_armed_and_disarmed() {
    let mut bench = landed();
    bench.set_interval(242.0, 10e6);
    bench.jobs(100);
    for armed in [true, false] {
        bench.input.armed = armed;
        assert_eq!(count(&bench.job(&[]), 242), 1, "armed: {armed}");
        assert_eq!(count(&bench.jobs(100), 242), 0);
    }
}

fn set_origin(latitude: i32, longitude: i32, altitude: i32) -> Vec<u8> {
    frame(&SET_GPS_GLOBAL_ORIGIN_DATA { target_system: 1, latitude, longitude, altitude })
}

fn origin(bench: &mut Bench) -> Option<(i32, i32, i32)> {
    bench.job(&command(REQUEST_MESSAGE, 49.0, 0.0)).into_iter().find_map(|message| match message {
        MavMessage::GPS_GLOBAL_ORIGIN(told) => Some((told.latitude, told.longitude, told.altitude)),
        _ => None,
    })
}

#[test]
fn a_vehicle_without_gnss_is_given_a_map() {
    let mut bench = Bench::silent();
    bench.job(&set_origin(900_000_001, 0, 0));
    bench.input.armed = true;
    bench.job(&set_origin(1, 2, 3));
    assert_eq!(origin(&mut bench), None, "neither off the Earth nor while armed");
    bench.input.armed = false;
    bench.job(&set_origin(473_977_000, 85_456_000, 441_000));
    assert_eq!(origin(&mut bench), Some((473_977_000, 85_456_000, 441_000)));
    assert_eq!(count(&bench.job(&command(REQUEST_MESSAGE, 33.0, 0.0)), 33), 1);
    // GNSS knows better, and is not overruled.
    bench.input.estimator = Some(Status { origin: Some(ORIGIN), ..status() });
    bench.job(&set_origin(1, 2, 3));
    assert_eq!(origin(&mut bench), Some((473_977_000, 85_456_000, 441_000)));
    bench.input.estimator = None;
    assert_eq!(origin(&mut bench), Some((473_977_000, 85_456_000, 441_000)), "as it was set");
}

#[test]
fn an_origin_that_is_sent_is_answered_by_the_one_in_effect() {
    let place = |messages: &[MavMessage]| match messages {
        [MavMessage::GPS_GLOBAL_ORIGIN(told)] => Some((told.latitude, told.longitude, told.altitude)),
        _ => None,
    };
    let reason = |messages: &[MavMessage]| match messages {
        [MavMessage::STATUSTEXT(text)] => text.text.to_str().map(str::to_owned).ok(),
        _ => None,
    };
    let mut bench = Bench::silent();
    let refused = reason(&bench.job(&set_origin(900_000_001, 0, 0)));
    assert_eq!(refused.as_deref(), Some("Setting the origin refused: no place on Earth"));
    bench.input.armed = true;
    let refused = reason(&bench.job(&set_origin(1, 2, 3)));
    assert_eq!(refused.as_deref(), Some("Setting the origin refused: vehicle armed"));
    bench.input.armed = false;
    for there in [(1, 2, 3), (473_977_000, 85_456_000, 441_000)] {
        assert_eq!(place(&bench.job(&set_origin(there.0, there.1, there.2))), Some(there), "set, and told at once");
    }
    bench.input.armed = true;
    assert_eq!(place(&bench.job(&set_origin(1, 2, 3))), Some((473_977_000, 85_456_000, 441_000)), "as it was");
    let place_of_gnss = crate::sensors::Geodetic { latitude_e7: 473_000_000, ..ORIGIN.place };
    bench.input.estimator = Some(Status { origin: Some(MapOrigin { place: place_of_gnss, ..ORIGIN }), ..status() });
    bench.input.armed = false;
    assert_eq!(place(&bench.job(&set_origin(1, 2, 3))), Some((473_000_000, 85_456_000, 441_000)), "by GNSS");
}
