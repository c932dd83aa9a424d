//! Streamed set-points on motion capture, from their bytes to the true path.

use glissade_dialect::SET_POSITION_TARGET_LOCAL_NED_DATA;
use sim_host::flight;
use sim_host::plant::Plant as _;
use sim_host::sil::Lockstep as _;

use crate::common::by_bytes::{Bytes, OFFBOARD};
use crate::common::load::load;

const RADIUS_M: f64 = 10.0;
const SPEED_M_S: f64 = 8.0;
const HEIGHT_M: f64 = 10.0;

/// North, east, at a time on the circle.
fn circle(t: f64) -> [f64; 2] {
    let (sin, cos) = (SPEED_M_S / RADIUS_M * t).sin_cos();
    [RADIUS_M * sin, RADIUS_M * (1.0 - cos)]
}

/// Until the vehicle has taken off.
fn in_the_air(seed: u64) -> Bytes {
    let mut bytes = Bytes::new(seed);
    bytes.wait(4.0);
    bytes.arm();
    bytes.wait(0.3);
    bytes.take_off(HEIGHT_M as f32);
    bytes.wait(12.0);
    bytes
}

#[test]
fn a_circle_at_eight_metres_a_second_is_flown_within_5_cm() {
    let mut bytes = in_the_air(1);
    let place = |t: f64| {
        let [x, y] = circle(t).map(|part| part as f32);
        let type_mask = 0b1101_1111_1000;
        SET_POSITION_TARGET_LOCAL_NED_DATA { x, y, z: -HEIGHT_M as f32, type_mask, ..Default::default() }
    };
    bytes.stream(0.5, |_| place(0.0));
    bytes.mode(OFFBOARD, 0.0);
    let begun = bytes.now;
    bytes.stream(30.0, place);
    let end = bytes.now;
    let mut scenario = load("field", &["sensors=\"mocap\""]);
    scenario.replay = Some(bytes.into_entries().into());
    let mut flight = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("flies");
    let (mut sum, mut count) = (0.0, 0.0);
    while flight.next_tick() < end {
        assert!(flight.step(&mut ()));
        let t = f64::from(flight.next_tick()) * 1e-3 - f64::from(begun) * 1e-3;
        if t > 12.0 {
            let [north, east] = circle(t);
            let p = flight.plant().motion().position;
            sum += (p.x - north).powi(2) + (p.y + east).powi(2) + (p.z - HEIGHT_M).powi(2);
            count += 1.0;
        }
    }
    let rms = (sum / f64::max(count, 1.0)).sqrt();
    // What the local frame's origin is off by is in it too.
    assert!(count > 10_000.0 && rms < 0.05, "{rms:.3} m");
}

#[test]
fn a_light_vehicle_that_sinks_slowly_does_not_land_in_the_air() {
    for (key, factor) in [
        ("truth.mass_factor", "0.85"),
        ("truth.mass_factor", "0.75"),
        ("truth.rotor_effectiveness", "[1.15, 1.15, 1.15, 1.15]"),
    ] {
        let mut bytes = in_the_air(2);
        // Down at 3 cm/s, and nothing else.
        let sinks = |_: f64| {
            let type_mask = 0b1101_1100_0111;
            SET_POSITION_TARGET_LOCAL_NED_DATA { vz: 0.03, type_mask, ..Default::default() }
        };
        bytes.stream(0.5, sinks);
        bytes.mode(OFFBOARD, 0.0);
        bytes.stream(15.0, sinks);
        let end = bytes.now;
        let mut scenario = load("field", &["sensors=\"mocap\"", &format!("{key}={factor}")]);
        scenario.replay = Some(bytes.into_entries().into());
        let mut flight = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("flies");
        while flight.next_tick() < end {
            assert!(flight.step(&mut ()));
        }
        let height = flight.plant().motion().position.z;
        assert!((height - (HEIGHT_M - 0.45)).abs() < 0.3, "{key} {factor}: {height} m");
    }
}
