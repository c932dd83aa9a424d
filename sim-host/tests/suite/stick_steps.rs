//! How soon a stick is obeyed, from the bytes of its message to the rotors and to the true attitude.

use glissade_dialect::MANUAL_CONTROL_DATA;
use sim_host::flight;
use sim_host::plant::Plant as _;
use sim_host::plant::rigid_body::RigidBody;
use sim_host::sil::{Flight, Lockstep as _};

use crate::common::by_bytes::{ALTITUDE, Bytes, CENTRED, STABILIZED};
use crate::common::load::load;
use crate::common::station::frame;

/// An x500 in the air that is flown by hand, with centred sticks.
fn flown_by_hand(mode: f32) -> Flight<RigidBody> {
    let mut bytes = Bytes::new(1);
    bytes.sticks(0.5, CENTRED);
    bytes.mode(mode, 0.0);
    bytes.sticks(1.5, CENTRED);
    let mut scenario = load("x500-hover", &["start_position_m=[0,0,50]", "trajectory.hold.position_m=[0,0,50]"]);
    scenario.replay = Some(bytes.into_entries().into());
    let mut flight = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("flies");
    while flight.next_tick() < 2_000 {
        assert!(flight.step(&mut ()));
    }
    flight
}

fn tilt_deg(flight: &Flight<RigidBody>) -> f64 {
    let q = flight.plant().motion().attitude;
    (1.0 - 2.0 * (q.i * q.i + q.j * q.j)).clamp(-1.0, 1.0).acos().to_degrees()
}

#[test]
fn a_stick_moves_the_rotors_within_25_ms_and_tilts_to_90_per_cent_within_a_quarter_of_a_second() {
    for mode in [STABILIZED, ALTITUDE] {
        for (x, y) in [(1000, 0), (-1000, 0), (0, 1000), (0, -1000)] {
            // At every phase of the ground partition's period.
            for phase in 0..10 {
                let (mut still, mut moved) = (flown_by_hand(mode), flown_by_hand(mode));
                for _ in 0..phase {
                    assert!(still.step(&mut ()) && moved.step(&mut ()));
                }
                let (begin, mut turns, mut tilts) = (moved.next_tick(), None, None);
                while tilts.is_none() {
                    let since = moved.next_tick() - begin;
                    assert!(since < 1_000, "never tilted");
                    if since.is_multiple_of(20) {
                        let sticks = MANUAL_CONTROL_DATA { x, y, z: 500, target: 1, ..MANUAL_CONTROL_DATA::DEFAULT };
                        moved.autopilot.ports.first().receive(&frame(0, &sticks));
                    }
                    assert!(still.step(&mut ()) && moved.step(&mut ()));
                    let motors = |flight: &Flight<RigidBody>| flight.autopilot.inner.inner_output().motors.omega_rad_s;
                    if turns.is_none() && motors(&still) != motors(&moved) {
                        turns = Some(since);
                    }
                    tilts = (tilt_deg(&moved) > 0.9 * 35.0).then_some(since);
                }
                let (turns, tilts) = (turns.expect("it tilted"), tilts.expect("just seen"));
                assert!(turns <= 25, "{mode} {x} {y} {phase}: the rotors after {turns} ms");
                assert!(tilts <= 250, "{mode} {x} {y} {phase}: 90 % of the tilt after {tilts} ms");
            }
        }
    }
}
