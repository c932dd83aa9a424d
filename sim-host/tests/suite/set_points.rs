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

#[test]
fn a_place_on_the_ground_is_landed_at_without_a_turn() {
    // Held at the height of the ground it would balance on its feet, and turn.
    for seed in 0..20 {
        let mut bytes = Bytes::new(seed);
        bytes.wait(4.0);
        bytes.arm();
        let to = |z: f32| {
            let type_mask = 0b1001_1111_1000;
            SET_POSITION_TARGET_LOCAL_NED_DATA { y: 4.0, z, yaw: 1.0, type_mask, ..Default::default() }
        };
        bytes.stream(0.5, |_| to(0.0));
        bytes.mode(OFFBOARD, 0.0);
        bytes.stream(10.0, |_| to(-4.0));
        bytes.stream(11.0, |_| to(0.0));
        let end = bytes.now;
        let mut scenario = load("field", &[]);
        scenario.replay = Some(bytes.into_entries().into());
        let mut flight = flight::lockstep(&scenario, seed, flight::rigid_body(&scenario, seed)).expect("flies");
        let (mut high, mut lean) = (0.0_f64, 0.0_f64);
        while flight.next_tick() < end {
            assert!(flight.step(&mut ()));
            let motion = flight.plant().motion();
            high = high.max(motion.position.z);
            if flight.next_tick() + 7_000 > end {
                let (x, y) = (motion.attitude.i, motion.attitude.j);
                lean = lean.max((1.0 - 2.0 * (x * x + y * y)).acos().to_degrees());
            }
        }
        let motion = flight.plant().motion();
        let turned = (motion.attitude.k / motion.attitude.w).atan() * 2.0 + 1.0;
        let turned = turned.to_degrees();
        assert!(high > 3.0 && motion.position.z < 0.02, "seed {seed}: {high} m, {} m", motion.position.z);
        assert!(turned.abs() < 8.0 && lean < 12.0, "seed {seed}: turned by {turned:.1}°, leant {lean:.1}°");
    }
}
