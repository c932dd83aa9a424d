//! The switches of a radio on their way through the whole autopilot: from the bytes of its channels to the rotors.

use firmware::commander::{Refusal, Request};
use firmware::schedule::GROUND;
use firmware::settings::{Value, find};
use firmware::signals::{MotorCommand, SensorFrame};
use glissade_dialect::RC_CHANNELS_OVERRIDE_DATA;

use crate::latest::{Flight, frame};

/// Sticks in the middle, and a switch on channel 7, which is the kill switch.
fn channels(chan7_raw: u16) -> Vec<u8> {
    frame(&RC_CHANNELS_OVERRIDE_DATA {
        target_system: 1,
        target_component: 1,
        chan1_raw: 1500,
        chan2_raw: 1500,
        chan3_raw: 1500,
        chan4_raw: 1500,
        chan7_raw,
        ..RC_CHANNELS_OVERRIDE_DATA::DEFAULT
    })
}

/// Hovering at 20 m, with a kill switch.
fn with_kill_switch() -> Flight {
    let mut flight = Flight::new(0);
    let index = find("RC_MAP_KILL_SW").expect("a setting");
    flight.pilot.ground.settings_mut().set(index, Value::Int(7), true).expect("in flight");
    flight
}

/// Flies with this switch, told every 20 ms: whether the rotors stood still in each tick.
fn fly(flight: &mut Flight, ticks: u32, chan7_raw: u16) -> Vec<bool> {
    (0..ticks)
        .map(|tick| {
            if tick.is_multiple_of(20) {
                flight.pilot.ports.first().receive(&channels(chan7_raw));
            }
            let motors = flight.pilot.tick(Some(&SensorFrame::Motion(flight.body.nav))).motors;
            flight.body.step(&motors);
            motors == MotorCommand::STOPPED
        })
        .collect()
}

#[test]
fn the_kill_switch_of_a_radio_stops_the_rotors_and_keeps_them_from_being_armed_while_it_is_on() {
    let mut flight = with_kill_switch();
    assert!(fly(&mut flight, 1_000, 1000).iter().all(|stopped| !stopped), "it is off");
    let stopped = fly(&mut flight, 1_500, 2000);
    let first = stopped.iter().position(|stopped| *stopped).expect("they stop");
    assert!(first <= (GROUND.period + GROUND.offset) as usize, "after {first} ms");
    assert!(stopped[first..].iter().all(|stopped| *stopped));
    // It has fallen, and lies on the ground.
    fly(&mut flight, 3_000, 2000);
    flight.pilot.inner.request(Request::Arm { force: false }).expect("room");
    assert!(fly(&mut flight, 100, 2000).iter().all(|stopped| *stopped));
    assert_eq!(flight.pilot.inner.commander_output().armable, Err(Refusal::KillSwitch));
    // The switch was turned on long ago: what it stopped may be armed as soon as it is off.
    fly(&mut flight, 50, 1000);
    flight.pilot.inner.request(Request::Arm { force: false }).expect("room");
    assert_eq!(fly(&mut flight, 100, 1000).last(), Some(&false));
}
