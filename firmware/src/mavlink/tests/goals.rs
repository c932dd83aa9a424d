//! Commands that send the vehicle somewhere.

use super::messages::ORIGIN;
use super::status::status;
use super::*;
use crate::commander::{Goal, SpeedKind};
use crate::estimator::status::Status;

const LAND: u16 = 21;
const CONDITION_YAW: u16 = 115;
const CHANGE_SPEED: u16 = 178;
const REPOSITION: u16 = 192;
const NAN: f32 = f32::NAN;
/// 1e-5° north and 1e-5° east of the origin: 1.1118 m and 0.7551 m there.
const THERE: [i32; 2] = [473_977_100, 85_456_100];

/// In hold, 20 m above the origin, which is 441 m above mean sea level.
fn holding() -> Bench {
    let mut bench = Bench::silent();
    bench.input.estimator = Some(Status { origin: Some(ORIGIN), ..status() });
    bench.input.home = Some(Vector3::new(0.0, 0.0, 1.0));
    bench.input.nav.position = Vector3::new(3.0, 4.0, 20.0);
    (bench.input.mode, bench.input.armed, bench.input.landed) = (Mode::Hold, true, false);
    bench
}

fn int(command: u16, in_frame: u8, [param1, param2, param3, param4]: [f32; 4], [x, y]: [i32; 2], z: f32) -> Vec<u8> {
    frame(&COMMAND_INT_DATA {
        target_system: 1,
        target_component: 1,
        command,
        frame: in_frame,
        param1,
        param2,
        param3,
        param4,
        x,
        y,
        z,
        ..COMMAND_INT_DATA::DEFAULT
    })
}

fn long(command: u16, [param1, param2, param3, param4, param5, param6, param7]: [f32; 7]) -> Vec<u8> {
    frame(&COMMAND_LONG_DATA {
        target_system: 1,
        target_component: 1,
        command,
        param1,
        param2,
        param3,
        param4,
        param5,
        param6,
        param7,
        ..COMMAND_LONG_DATA::DEFAULT
    })
}

fn asked(bench: &mut Bench, bytes: &[u8]) -> Request {
    assert_eq!(bench.result_of(bytes), None, "the commander decides");
    bench.commands.pop().expect("a request").request
}

/// Whether it is this goal, places and headings within 1 cm and 0.01 rad.
fn assert_goal(asked: Request, expected: Request) {
    let numbers = |request| match request {
        Request::GoTo(goal) => (0, goal.numbers()),
        Request::LandAt(goal) => (1, goal.numbers()),
        other => panic!("{other:?}"),
    };
    let ((kind, told), (wanted_kind, wanted)) = (numbers(asked), numbers(expected));
    let agree = |(a, b): (&f32, &f32)| (a.is_nan() && b.is_nan()) || crate::math::abs(a - b) < 0.01;
    assert!(kind == wanted_kind && told.iter().zip(&wanted).all(agree), "{asked:?} is not {expected:?}");
}

#[test]
fn reposition_goes_to_a_place_in_every_frame_that_says_where_it_is() {
    let mut bench = holding();
    let usual = [-1.0, 1.0, 0.0, NAN];
    let place = Some([1.1118, -0.7551]);
    for (in_frame, z, up) in [(0, 451.0, 10.0), (5, 451.0, 10.0), (3, 9.0, 10.0), (6, 9.0, 10.0)] {
        let goal = Goal { place_m: place, height_m: Some(up), ..Goal::default() };
        assert_goal(asked(&mut bench, &int(REPOSITION, in_frame, usual, THERE, z)), Request::GoTo(goal));
    }
    // North, east, down; metres times 10⁴.
    let local = int(REPOSITION, 1, usual, [50_000, 20_000], -7.0);
    let goal = Goal { place_m: Some([5.0, -2.0]), height_m: Some(7.0), ..Goal::default() };
    assert_goal(asked(&mut bench, &local), Request::GoTo(goal));
    // Degrees in a COMMAND_LONG are as exact as a float is: 4e-6° here.
    let long_form = long(REPOSITION, [3.5, 1.0, 0.0, 1.5, 47.397_71, 8.545_61, 451.0]);
    let Request::GoTo(goal) = asked(&mut bench, &long_form) else { panic!() };
    let [x, y] = goal.place_m.expect("a place");
    assert!(crate::math::abs(x - 1.1) < 0.5 && crate::math::abs(y + 0.8) < 0.5, "{goal:?}");
    assert_eq!((goal.yaw_rad, goal.speed_m_s), (Some(-1.5), Some(3.5)), "a heading to the right, and a speed");
    for in_frame in [2, 7, 8, 10, 11, 20, 99] {
        let result = bench.result_of(&int(REPOSITION, in_frame, usual, THERE, 10.0));
        assert_eq!(result, Some(MavResult::MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME), "{in_frame}");
    }
    let beyond = int(REPOSITION, 6, usual, [900_000_001, 0], 10.0);
    assert_eq!(bench.result_of(&beyond), Some(MavResult::MAV_RESULT_DENIED));
    assert_eq!(bench.result_of(&int(REPOSITION, 6, usual, THERE, f32::INFINITY)), Some(MavResult::MAV_RESULT_DENIED));
}

#[test]
fn what_reposition_leaves_open_stays_and_nothing_at_all_is_a_pause() {
    let mut bench = holding();
    for nothing in [
        long(REPOSITION, [-1.0, 1.0, 0.0, NAN, NAN, NAN, NAN]),
        int(REPOSITION, 0, [-1.0, 1.0, 0.0, NAN], [i32::MAX; 2], NAN),
        int(REPOSITION, 6, [NAN, 1.0, 0.0, NAN], [i32::MIN; 2], NAN),
    ] {
        assert_eq!(asked(&mut bench, &nothing), Request::Hold);
    }
    // QGroundControl's change of altitude.
    let higher = long(REPOSITION, [-1.0, 1.0, 0.0, NAN, NAN, NAN, 466.0]);
    let goal = Goal { height_m: Some(25.0), ..Goal::default() };
    assert_goal(asked(&mut bench, &higher), Request::GoTo(goal));
    bench.input.estimator = Some(status());
    let messages = bench.job(&higher);
    let text = messages.iter().find_map(|m| if let MavMessage::STATUSTEXT(m) = m { Some(m) } else { None });
    assert_eq!(text.expect("a reason").text.to_str(), Ok("Go to refused: origin unknown"));
    let relative = int(REPOSITION, 6, [-1.0, 1.0, 0.0, NAN], [i32::MAX; 2], 4.0);
    let goal = Goal { height_m: Some(5.0), ..Goal::default() };
    assert_goal(asked(&mut bench, &relative), Request::GoTo(goal));
}

#[test]
fn reposition_changes_the_mode_only_if_it_is_told_to() {
    let mut bench = holding();
    let unflagged = long(REPOSITION, [-1.0, 0.0, 0.0, NAN, NAN, NAN, NAN]);
    assert_eq!(asked(&mut bench, &unflagged), Request::Hold);
    bench.input.mode = Mode::Follow;
    assert_eq!(bench.result_of(&unflagged), Some(MavResult::MAV_RESULT_DENIED));
    let flagged = long(REPOSITION, [-1.0, 1.0, 0.0, NAN, NAN, NAN, NAN]);
    assert_eq!(asked(&mut bench, &flagged), Request::Hold);
    let unknown = long(REPOSITION, [-1.0, 3.0, 0.0, NAN, NAN, NAN, NAN]);
    assert_eq!(bench.result_of(&unknown), Some(MavResult::MAV_RESULT_DENIED));
}

#[test]
fn it_lands_here_or_there_with_a_heading_in_degrees() {
    let mut bench = holding();
    for here in [
        long(LAND, [0.0; 7]),
        long(LAND, [0.0, 0.0, 0.0, NAN, NAN, NAN, 0.0]),
        int(LAND, 0, [0.0, 0.0, 0.0, NAN], [i32::MIN; 2], 0.0),
        int(LAND, 3, [0.0; 4], [0, 0], 0.0),
    ] {
        assert_eq!(asked(&mut bench, &here), Request::Land);
    }
    let there = int(LAND, 6, [0.0, 0.0, 0.0, 90.0], THERE, 0.0);
    let quarter = core::f32::consts::FRAC_PI_2;
    let goal = Goal { place_m: Some([1.1118, -0.7551]), yaw_rad: Some(-quarter), ..Goal::default() };
    assert_goal(asked(&mut bench, &there), Request::LandAt(goal));
    let turned = long(LAND, [0.0, 0.0, 0.0, -90.0, NAN, NAN, 0.0]);
    let goal = Goal { yaw_rad: Some(quarter), ..Goal::default() };
    assert_goal(asked(&mut bench, &turned), Request::LandAt(goal));
}

#[test]
fn a_heading_is_turned_to_or_by() {
    let mut bench = holding();
    let turn = |angle: f32, direction: f32, relative: f32| {
        long(CONDITION_YAW, [angle, 20.0, direction, relative, 0.0, 0.0, 0.0])
    };
    let to = |degrees: f32| {
        let yaw_rad = Some(-degrees.to_radians());
        Request::GoTo(Goal { yaw_rad, ..Goal::default() })
    };
    assert_goal(asked(&mut bench, &turn(90.0, 0.0, 0.0)), to(90.0));
    assert_goal(asked(&mut bench, &turn(270.0, 0.0, 0.0)), to(-90.0));
    assert_goal(asked(&mut bench, &turn(30.0, 1.0, 1.0)), to(30.0));
    assert_goal(asked(&mut bench, &turn(30.0, -1.0, 1.0)), to(-30.0));
    for wrong in [turn(NAN, 0.0, 0.0), turn(361.0, 0.0, 0.0), turn(0.0, 2.0, 0.0), turn(0.0, 0.0, 3.0)] {
        assert_eq!(bench.result_of(&wrong), Some(MavResult::MAV_RESULT_DENIED));
    }
}

#[test]
fn speeds_are_set_left_and_reset() {
    let mut bench = holding();
    let change = |kind: f32, speed: f32| long(CHANGE_SPEED, [kind, speed, -1.0, 0.0, 0.0, 0.0, 0.0]);
    for (number, kind) in
        [(0.0, SpeedKind::Horizontal), (1.0, SpeedKind::Horizontal), (2.0, SpeedKind::Up), (3.0, SpeedKind::Down)]
    {
        let set = Request::Speed { kind, speed_m_s: Some(2.5) };
        assert_eq!(asked(&mut bench, &change(number, 2.5)), set);
        assert_eq!(asked(&mut bench, &change(number, -2.0)), Request::Speed { kind, speed_m_s: None });
        assert_eq!(bench.result_of(&change(number, -1.0)), Some(MavResult::MAV_RESULT_ACCEPTED));
    }
    for kind in [4.0, -1.0, 0.5, NAN] {
        assert_eq!(bench.result_of(&change(kind, 2.0)), Some(MavResult::MAV_RESULT_DENIED));
    }
    assert!(bench.commands.is_empty());
}

#[test]
fn degrees_that_are_none_are_no_place_and_not_one_that_is_left_open() {
    let mut bench = holding();
    for latitude in [91.0, 300.0, 473_976_843.0, -473_976_843.0, f32::INFINITY] {
        for command in [REPOSITION, LAND] {
            let wrong = long(command, [-1.0, 1.0, 0.0, NAN, latitude, 8.0, 450.0]);
            assert_eq!(bench.result_of(&wrong), Some(MavResult::MAV_RESULT_DENIED), "{command} {latitude}");
        }
    }
}
