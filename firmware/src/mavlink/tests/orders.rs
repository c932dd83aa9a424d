//! Orders beside the flight: termination, restart, motor test, orbit, standard modes.

use super::messages::ORIGIN;
use super::status::status;
use super::*;
use crate::commander::{ManualMode, MotorTest, OrbitGoal, OrbitHeading};
use crate::estimator::status::Status;

const ORBIT: u16 = 34;
const TERMINATION: u16 = 185;
const MOTOR_TEST: u16 = 209;
const REBOOT: u16 = 246;
const STANDARD_MODE: u16 = 262;
const NAN: f32 = f32::NAN;

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

#[test]
fn a_termination_is_a_kill_that_holds() {
    let mut bench = Bench::silent();
    for (param1, ends) in [(1.0, true), (0.0, false), (NAN, false)] {
        let (output, messages) = bench.output_of(&command(TERMINATION, param1, 0.0));
        assert_eq!((output.kill, output.terminate), (ends, ends));
        let result = if ends { MavResult::MAV_RESULT_ACCEPTED } else { MavResult::MAV_RESULT_DENIED };
        assert!(matches!(messages.as_slice(), [MavMessage::COMMAND_ACK(ack)] if ack.result == result), "{messages:?}");
    }
}

#[test]
fn it_is_restarted_while_disarmed_only() {
    let mut bench = Bench::silent();
    assert!(bench.output_of(&command(REBOOT, 1.0, 1.0)).0.restart);
    for param1 in [0.0, 2.0, 3.0, NAN] {
        assert_eq!(bench.result_of(&command(REBOOT, param1, 0.0)), Some(MavResult::MAV_RESULT_UNSUPPORTED));
    }
    bench.input.armed = true;
    let (output, messages) = bench.output_of(&command(REBOOT, 1.0, 0.0));
    assert!(!output.restart);
    let text = messages.iter().find_map(|m| if let MavMessage::STATUSTEXT(m) = m { Some(m) } else { None });
    assert_eq!(text.expect("a reason").text.to_str(), Ok("Restart refused: vehicle armed"));
}

#[test]
fn one_motor_is_tested_by_its_number_in_percent() {
    let mut bench = Bench::silent();
    let test = |motor: f32, kind: f32, percent: f32, seconds: f32, count: f32| {
        long(MOTOR_TEST, [motor, kind, percent, seconds, count, 0.0, 0.0])
    };
    let expected = |rotor: u8, part: f32, seconds: f32| Request::TestMotor { test: MotorTest { rotor, part }, seconds };
    assert_eq!(asked(&mut bench, &test(1.0, 0.0, 10.0, 2.0, 0.0)), expected(0, 0.1, 2.0));
    assert_eq!(asked(&mut bench, &test(4.0, 0.0, 25.0, 3.0, 1.0)), expected(3, 0.25, 3.0));
    for wrong in [
        test(0.0, 0.0, 10.0, 2.0, 0.0),
        test(1.5, 0.0, 10.0, 2.0, 0.0),
        test(NAN, 0.0, 10.0, 2.0, 0.0),
        // Pulse widths, and several motors one after the other.
        test(1.0, 1.0, 1100.0, 2.0, 0.0),
        test(1.0, 0.0, 10.0, 2.0, 4.0),
    ] {
        assert_eq!(bench.result_of(&wrong), Some(MavResult::MAV_RESULT_DENIED));
    }
}

#[test]
fn an_orbit_has_a_direction_a_heading_and_a_centre() {
    let mut bench = Bench::silent();
    bench.input.estimator = Some(Status { origin: Some(ORIGIN), ..status() });
    let orbit = |radius: f32, speed: f32, nose: f32| long(ORBIT, [radius, speed, nose, NAN, NAN, NAN, NAN]);
    for (bytes, radius_m, speed_m_s, heading) in [
        (orbit(20.0, 3.0, 0.0), Some(20.0), -3.0, OrbitHeading::Center),
        (orbit(-20.0, 3.0, 3.0), Some(20.0), 3.0, OrbitHeading::Along),
        (orbit(20.0, -3.0, 1.0), Some(20.0), 3.0, OrbitHeading::Kept),
        (orbit(NAN, NAN, NAN), None, -5.0, OrbitHeading::Center),
    ] {
        let Request::Orbit(told) = asked(&mut bench, &bytes) else { panic!("no orbit") };
        let speed_m_s = Some(speed_m_s);
        assert_eq!(told, OrbitGoal { center_m: None, height_m: None, radius_m, speed_m_s, heading });
    }
    let there = COMMAND_INT_DATA {
        target_system: 1,
        target_component: 1,
        command: ORBIT,
        frame: 5,
        param1: 20.0,
        param2: 3.0,
        param3: 0.0,
        param4: NAN,
        x: 473_977_100,
        y: 85_456_100,
        z: 451.0,
        ..COMMAND_INT_DATA::DEFAULT
    };
    let Request::Orbit(told) = asked(&mut bench, &frame(&there)) else { panic!("no orbit") };
    let [x, y] = told.center_m.expect("a centre");
    assert!(crate::math::abs(x - 1.1118) < 0.01 && crate::math::abs(y + 0.7551) < 0.01);
    assert!(told.height_m.is_some_and(|z| crate::math::abs(z - 10.0) < 0.01));
    // In a frame of heights above home: above the sea, as MAVSDK means it, unless that is below the ground.
    for (z, height) in [(451.0, 10.0), (7.0, 7.0), (-3.0, -3.0)] {
        let Request::Orbit(told) = asked(&mut bench, &frame(&COMMAND_INT_DATA { frame: 6, z, ..there.clone() })) else {
            panic!("no orbit")
        };
        assert!(told.height_m.is_some_and(|told| crate::math::abs(told - height) < 0.01), "{z}: {told:?}");
    }
    let denied = [orbit(20.0, 3.0, 9.0), long(ORBIT, [20.0, 3.0, 0.0, 2.0, NAN, NAN, NAN])];
    for bytes in denied {
        assert_eq!(bench.result_of(&bytes), Some(MavResult::MAV_RESULT_DENIED));
    }
}

#[test]
fn standard_modes_are_set_as_those_that_they_stand_for() {
    let mut bench = Bench::silent();
    for (number, request) in [
        (1.0, Request::Manual(ManualMode::Position)),
        (4.0, Request::Manual(ManualMode::Altitude)),
        (5.0, Request::Return),
        (6.0, Request::Follow),
        (7.0, Request::Land),
    ] {
        assert_eq!(asked(&mut bench, &command(STANDARD_MODE, number, 0.0)), request);
    }
    assert!(matches!(asked(&mut bench, &command(STANDARD_MODE, 8.0, 0.0)), Request::TakeOff { .. }));
    for number in [0.0, 2.0, 3.0, 9.0, 255.0, NAN] {
        let result = bench.result_of(&command(STANDARD_MODE, number, 0.0));
        assert_eq!(result, Some(MavResult::MAV_RESULT_UNSUPPORTED), "{number}");
    }
}
