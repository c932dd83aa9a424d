//! Orders of a ground station on their way through the whole autopilot: the end of a flight, a restart, and more orders
//! than can wait.

use firmware::commander::Request;
use firmware::config::FlightConfig;
use firmware::schedule::GROUND;
use firmware::signals::{MotorCommand, SensorFrame};
use glissade_dialect::{COMMAND_LONG_DATA, MavCmd};

use crate::autopilot::{acknowledged, at, autopilot, command_arm, in_flight};
use crate::latest::{Flight, frame};

/// `COMMAND_LONG` with its first parameter.
fn command(command: MavCmd, param1: f32) -> Vec<u8> {
    let command = command as u16;
    frame(&COMMAND_LONG_DATA { target_system: 1, target_component: 1, command, param1, ..COMMAND_LONG_DATA::DEFAULT })
}

/// `MAV_RESULT`.
const ACCEPTED: u8 = 0;
const TEMPORARILY_REJECTED: u8 = 1;

#[test]
fn a_terminated_flight_ends_at_once_and_the_vehicle_is_never_armed_again() {
    let mut flight = Flight::new(0);
    flight.fly(1, &[]);
    let stopped = |flight: &Flight| flight.pilot.inner.inner_output().motors == MotorCommand::STOPPED;
    assert!(!stopped(&flight));
    flight.sent.clear();
    flight.pilot.ports.first().receive(&command(MavCmd::MAV_CMD_DO_FLIGHTTERMINATION, 1.0));
    for _ in 0..=GROUND.period + GROUND.offset {
        flight.pilot.tick(Some(&SensorFrame::Motion(flight.body.nav)));
    }
    assert!(stopped(&flight));
    flight.fly(5, &[]);
    assert_eq!(acknowledged(&flight.sent, 255), [ACCEPTED]);
    // It lies on the ground, and nothing else is in the way.
    for force in [false, true] {
        flight.sent.clear();
        flight.pilot.ports.first().receive(&command_arm(true, force));
        flight.fly(2, &[]);
        assert_eq!(acknowledged(&flight.sent, 255), [TEMPORARILY_REJECTED], "forced: {force}");
        assert!(flight.says("restart the vehicle first") && stopped(&flight));
    }
}

#[test]
fn a_restart_comes_half_a_second_after_its_order_but_not_to_a_vehicle_that_has_just_been_armed() {
    for arms in [false, true] {
        let mut vehicle = autopilot(&FlightConfig::default());
        let mut restarts = Vec::new();
        for tick in 0..2_000 {
            if tick == 100 {
                vehicle.ports.first().receive(&command(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, 1.0));
            }
            // Read a job earlier, it is decided after the order to restart was accepted.
            if tick == 90 && arms {
                vehicle.ports.first().receive(&command_arm(true, false));
            }
            vehicle.tick(Some(&at([0.0; 3])));
            if vehicle.inner.takes_restart() {
                restarts.push(tick);
            }
        }
        assert_eq!(vehicle.inner.commander_output().armed, arms);
        match restarts.as_slice() {
            [] => assert!(arms),
            [at] => assert!(!arms && (600..=600 + GROUND.period + GROUND.offset).contains(at), "at {at}"),
            several => panic!("{several:?}"),
        }
    }
}

#[test]
fn a_command_for_which_the_commander_has_no_room_is_refused_and_not_forgotten() {
    let mut vehicle = autopilot(&in_flight());
    let mut sent = Vec::new();
    vehicle.ports.first().receive(&command_arm(true, false));
    for _ in 0..100 {
        // A program on board is always faster.
        while vehicle.inner.request(Request::Hold).is_ok() {}
        vehicle.tick(Some(&at([0.0, 0.0, 20.0])));
        sent.extend_from_slice(vehicle.ports.first().take(&mut [0; 2048]));
    }
    // Alone it would be accepted: the vehicle is armed already.
    assert_eq!(acknowledged(&sent, 255), [TEMPORARILY_REJECTED]);
    let reason = b"too many commands at once";
    assert!(sent.windows(reason.len()).any(|bytes| bytes == reason));
}
