//! Modes as telemetry reports them, and the commands that set them.

use glissade_dialect::SET_MODE_DATA;

use super::*;
use crate::commander::{ManualMode, TAKE_OFF_HEIGHT_M};

const RETURN_TO_LAUNCH: u16 = 20;
const LAND: u16 = 21;
const TAKEOFF: u16 = 22;
const SET_MODE: u16 = 176;

#[test]
fn modes_and_landed_states_are_encoded_as_px4_encodes_them() {
    let mut bench = Bench::new();
    bench.input.armed = true;
    bench.input.landed = false;
    for (mode, (main, sub), landed_state, state) in [
        (Mode::Hold, (4, 3), 2, 4),
        (Mode::TakeOff, (4, 2), 2, 4),
        (Mode::Follow, (4, 4), 2, 4),
        (Mode::Return, (4, 5), 2, 4),
        (Mode::Land, (4, 6), 4, 4),
        (Mode::GoTo, (4, 3), 2, 4),
        (Mode::Velocity, (6, 0), 2, 4),
        (Mode::Altitude, (2, 0), 2, 4),
        (Mode::Position, (3, 0), 2, 4),
        (Mode::Acro, (5, 0), 2, 4),
        (Mode::Stabilized, (7, 0), 2, 4),
        (Mode::Descent, (4, 6), 4, 5),
        (Mode::MotorOut, (4, 6), 4, 5),
    ] {
        bench.input.mode = mode;
        let messages = bench.jobs(100);
        let heartbeat = messages.iter().find_map(|m| if let MavMessage::HEARTBEAT(m) = m { Some(m) } else { None });
        let heartbeat = heartbeat.expect("sent");
        assert_eq!((heartbeat.custom_mode >> 16 & 0xff, heartbeat.custom_mode >> 24), (main, sub), "{mode:?}");
        assert_eq!(heartbeat.system_status, state, "{mode:?}");
        let landed =
            messages.iter().rev().find_map(|m| if let MavMessage::EXTENDED_SYS_STATE(m) = m { Some(m) } else { None });
        assert_eq!(landed.expect("sent").landed_state as u8, landed_state, "{mode:?}");
    }
}

#[test]
fn a_take_off_is_told_as_such_until_it_has_lifted() {
    for (mode, armed, landed, landed_state) in [
        (Mode::TakeOff, false, true, 1),
        (Mode::TakeOff, true, true, 3),
        (Mode::TakeOff, true, false, 2),
        (Mode::Hold, true, true, 1),
    ] {
        let mut bench = Bench::new();
        (bench.input.mode, bench.input.armed, bench.input.landed) = (mode, armed, landed);
        let told = bench.jobs(100);
        let told = told.iter().find_map(|m| if let MavMessage::EXTENDED_SYS_STATE(m) = m { Some(m) } else { None });
        assert_eq!(told.expect("sent").landed_state as u8, landed_state, "{mode:?} {armed} {landed}");
    }
}

#[test]
fn commands_to_fly_become_requests() {
    let mut bench = Bench::silent();
    let custom = 1.0;
    let take_off = |height_m| Request::TakeOff { height_m };
    for (number, [param1, param2, param3, param7], request) in [
        (TAKEOFF, [0.0, 0.0, 0.0, 4.0], take_off(4.0)),
        (TAKEOFF, [0.0, 0.0, 0.0, f32::NAN], take_off(TAKE_OFF_HEIGHT_M)),
        (LAND, [0.0; 4], Request::Land),
        (RETURN_TO_LAUNCH, [0.0; 4], Request::Return),
        (SET_MODE, [custom, 4.0, 2.0, 0.0], take_off(TAKE_OFF_HEIGHT_M)),
        (SET_MODE, [custom, 4.0, 3.0, 0.0], Request::Hold),
        (SET_MODE, [129.0, 4.0, 4.0, 0.0], Request::Follow),
        (SET_MODE, [custom, 4.0, 5.0, 0.0], Request::Return),
        (SET_MODE, [custom, 4.0, 6.0, 0.0], Request::Land),
        (SET_MODE, [custom, 1.0, 0.0, 0.0], Request::Manual(ManualMode::Stabilized)),
        (SET_MODE, [custom, 2.0, 0.0, 0.0], Request::Manual(ManualMode::Altitude)),
        (SET_MODE, [custom, 3.0, 0.0, 0.0], Request::Manual(ManualMode::Position)),
        (SET_MODE, [custom, 5.0, 0.0, 0.0], Request::Manual(ManualMode::Acro)),
        (SET_MODE, [custom, 7.0, 0.0, 0.0], Request::Manual(ManualMode::Stabilized)),
    ] {
        let long = COMMAND_LONG_DATA {
            target_system: 1,
            target_component: 1,
            command: number,
            param1,
            param2,
            param3,
            param7,
            ..COMMAND_LONG_DATA::DEFAULT
        };
        let int = COMMAND_INT_DATA {
            target_system: 1,
            target_component: 1,
            command: number,
            param1,
            param2,
            param3,
            frame: 3,
            z: param7,
            ..COMMAND_INT_DATA::DEFAULT
        };
        for bytes in [frame(&long), frame(&int)] {
            assert_eq!(bench.result_of(&bytes), None, "{number}: the commander decides");
            assert_eq!(bench.commands.pop(), Some(from_station(number, request)));
        }
    }
}

#[test]
fn an_old_message_sets_the_mode_of_the_vehicle_that_it_names() {
    // Auto, loiter.
    let hold = |target_system| frame(&SET_MODE_DATA { target_system, base_mode: 1, custom_mode: 4 << 16 | 3 << 24 });
    let mut bench = Bench::silent();
    for other in [2, 7, 255] {
        assert_eq!(bench.job(&hold(other)), [], "system {other}");
        assert!(bench.commands.is_empty());
    }
    bench.job(&hold(1));
    assert_eq!(bench.commands.pop(), Some(from_station(SET_MODE, Request::Hold)));
}

#[test]
fn modes_that_cannot_be_set_are_denied() {
    let mut bench = Bench::silent();
    for [param1, param2, param3] in [
        [0.0, 4.0, 3.0],
        [1.0, 8.0, 0.0],
        [1.0, 9.0, 0.0],
        [1.0, 4.0, 1.0],
        [1.0, 4.0, f32::NAN],
        [f32::NAN, 4.0, 3.0],
        [1.0, f32::NAN, 3.0],
        [1.0, 4.5, 3.0],
    ] {
        let long = COMMAND_LONG_DATA {
            target_system: 1,
            command: SET_MODE,
            param1,
            param2,
            param3,
            ..COMMAND_LONG_DATA::DEFAULT
        };
        let result = bench.result_of(&frame(&long));
        assert_eq!(result, Some(MavResult::MAV_RESULT_DENIED), "{param1} {param2} {param3}");
    }
}

#[test]
fn requests_of_programs_on_board_are_not_acknowledged_and_invalid_parameters_are_denied() {
    let mut bench = Bench::silent();
    let outcome = Outcome::TemporarilyRejected(Refusal::OnGround);
    bench.hear_reply(Reply { command: Command { request: Request::Hold, origin: Origin::OnBoard }, outcome });
    assert!(bench.job(&[]).is_empty());
    let command = from_station(TAKEOFF, Request::TakeOff { height_m: -1.0 });
    bench.hear_reply(Reply { command, outcome: Outcome::Denied });
    let messages = bench.job(&[]);
    let [MavMessage::COMMAND_ACK(ack)] = messages.as_slice() else { panic!("{messages:?}") };
    assert_eq!((ack.command, ack.result), (TAKEOFF, MavResult::MAV_RESULT_DENIED));
}

#[test]
fn failsafe_events_are_sent_as_text() {
    let mut bench = Bench::silent();
    for (event, words) in [
        (Event::SensorsLost, "Sensor data lost: blind descent"),
        (Event::SensorsGone, "No sensor data for 2 s: motors stopped"),
        (Event::AttitudeLost, "Attitude estimate lost: blind descent"),
        (Event::HeightLost, "Height estimate lost: level descent"),
        (Event::VelocityLost, "Velocity estimate lost: level descent"),
        (Event::PositionLost, "Position estimate lost: descending"),
        (Event::BatteryLow, "Battery low: returning home"),
        (Event::BatteryCritical, "Battery critical: landing"),
        (Event::RotorFailed { rotor: 2 }, "Motor 3 failed: descending without yaw control"),
        (Event::OuterHung, "Guidance hung: blind descent"),
        (Event::CommanderHung, "Commander hung: descending"),
    ] {
        let _ = bench.input.events.push(event);
        let messages = bench.job(&[]);
        let [MavMessage::STATUSTEXT(text)] = messages.as_slice() else { panic!("{messages:?}") };
        assert_eq!((text.text.to_str(), text.severity as u8), (Ok(words), 2));
    }
}

#[test]
fn a_reply_to_the_last_peer_of_a_link_is_not_told_the_next_one() {
    let mut bench = Bench::new();
    let command = from_station(400, Request::Arm { force: false });
    let outcome = Outcome::TemporarilyRejected(Refusal::NoHeading);
    let acknowledged = |messages: &[MavMessage]| {
        messages.iter().any(|message| matches!(message, MavMessage::COMMAND_ACK(_) | MavMessage::STATUSTEXT(_)))
    };
    bench.hear_reply(Reply { command, outcome });
    assert!(acknowledged(&bench.job(&[])));
    bench.input.replies.clear();
    // The command was passed on before the link was opened anew.
    bench.ports.first().open(Profile::Normal);
    bench.hear_reply(Reply { command, outcome });
    assert!(!acknowledged(&bench.job(&[])));
}
