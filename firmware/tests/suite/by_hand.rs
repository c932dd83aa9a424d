//! Flights by sticks.

use firmware::commander::{ManualMode, Mode, Request};
use firmware::config::FlightConfig;
use firmware::latest::Sticks;
use firmware::math::wrap_angle;
use firmware::outer::Authority;
use firmware::signals::TICK_S;
use nalgebra::Vector3;

use crate::vehicle::{Vehicle, config};

const CENTRED: Sticks = Sticks::CENTRED;
const DOWN: Sticks = Sticks { throttle: 0.0, ..CENTRED };

/// With enough torque for what pilots want: thrust to weight is 2, and yaw has some of it.
fn agile() -> FlightConfig {
    let mut config = config();
    config.airframe.rotor_inertia_kg_m2 = 0.0;
    for (gains, (lambda, gain)) in config.attitude.axes.iter_mut().zip([(15.0, 60.0), (15.0, 60.0), (6.0, 10.0)]) {
        (gains.lambda, gains.gain) = (lambda, gain);
    }
    config
}

fn tilt_deg(vehicle: &Vehicle) -> f32 {
    let axis = vehicle.body.nav.attitude * Vector3::z();
    axis.z.clamp(-1.0, 1.0).acos().to_degrees()
}

fn yaw(vehicle: &Vehicle) -> f32 {
    vehicle.body.nav.attitude.euler_angles().2
}

/// In a manual mode, 4 m over the ground, with centred sticks.
fn in_mode(mode: ManualMode) -> Vehicle {
    let mut vehicle = Vehicle::airborne(&agile());
    vehicle.hold(CENTRED);
    vehicle.run(0.1);
    vehicle.ask(Request::Manual(mode));
    vehicle.run(0.2);
    assert_eq!(vehicle.told.mode, mode.into());
    vehicle
}

#[test]
fn it_is_armed_flown_and_landed_by_the_sticks_alone_in_every_mode() {
    for mode in [ManualMode::Stabilized, ManualMode::Acro, ManualMode::Altitude, ManualMode::Position] {
        let mut vehicle = Vehicle::new(&agile());
        vehicle.hold(DOWN);
        vehicle.ask(Request::Manual(mode));
        vehicle.run(0.1);
        vehicle.hold(Sticks { yaw: -1.0, ..DOWN });
        vehicle.run(1.2);
        assert_eq!(vehicle.told.mode, Mode::Idle, "{mode:?}: throttle down and yaw to the right");
        vehicle.hold(Sticks { throttle: if mode.has_direct_thrust() { 0.7 } else { 1.0 }, ..CENTRED });
        vehicle.run(2.0);
        assert!(vehicle.body.nav.position.z > 0.8, "{mode:?}: {}", vehicle.body.nav.position);
        assert_eq!(vehicle.told.mode, mode.into());
        vehicle.hold(CENTRED);
        vehicle.run(1.0);
        let throttle = if mode.has_direct_thrust() { 0.42 } else { 0.2 };
        vehicle.hold(Sticks { throttle, ..CENTRED });
        vehicle.run(3.0);
        vehicle.hold(DOWN);
        vehicle.until_landed(12.0);
        assert_eq!((vehicle.told.mode, vehicle.body.nav.position.z), (Mode::Idle, 0.0), "{mode:?}");
        vehicle.run(2.1);
        assert!(!vehicle.told.armed && vehicle.told.shown == mode.into(), "{mode:?}: disarmed 2 s after the landing");
    }
}

#[test]
fn a_stick_step_to_tilt_takes_less_than_a_quarter_of_a_second() {
    for mode in [ManualMode::Stabilized, ManualMode::Altitude] {
        for (sticks, axis) in [
            (Sticks { pitch: 1.0, ..CENTRED }, Vector3::x()),
            (Sticks { roll: -1.0, ..CENTRED }, Vector3::y()),
            (Sticks { pitch: -1.0, ..CENTRED }, -Vector3::x()),
        ] {
            let mut vehicle = in_mode(mode);
            vehicle.hold(sticks);
            let full = 35.0;
            let start = vehicle.tick;
            while tilt_deg(&vehicle) < 0.9 * full {
                vehicle.run(TICK_S * 1.01);
                assert!(vehicle.tick - start < 250, "{mode:?}: {}° after 250 ms", tilt_deg(&vehicle));
            }
            vehicle.run(0.5);
            assert!((tilt_deg(&vehicle) - full).abs() < 1.0, "{mode:?}: {}", tilt_deg(&vehicle));
            let leans = vehicle.body.nav.attitude * Vector3::z();
            assert!(leans.dot(&axis) > 0.56, "{mode:?}: {leans} is not along {axis}");
        }
    }
}

#[test]
fn altitude_mode_holds_the_height_whatever_the_tilt_and_climbs_by_stick() {
    let mut vehicle = in_mode(ManualMode::Altitude);
    let height = vehicle.body.nav.position.z;
    for (roll, pitch) in [(0.0, 0.7), (0.7, 0.0), (-0.5, -0.5), (0.0, 0.0)] {
        vehicle.hold(Sticks { roll, pitch, ..CENTRED });
        vehicle.run(2.0);
        let off = vehicle.body.nav.position.z - height;
        assert!(off.abs() < 0.1, "{roll} {pitch}: {off}");
    }
    vehicle.hold(Sticks { throttle: 1.0, ..CENTRED });
    vehicle.run(3.0);
    assert!((vehicle.body.nav.velocity.z - 2.0).abs() < 0.05, "{}", vehicle.body.nav.velocity);
    vehicle.hold(CENTRED);
    vehicle.run(3.0);
    assert!(vehicle.body.nav.velocity.z.abs() < 0.02);
}

#[test]
fn position_mode_flies_where_the_vehicle_heads_and_holds_where_it_stops() {
    let mut vehicle = in_mode(ManualMode::Position);
    vehicle.hold(Sticks { yaw: 1.0, ..CENTRED });
    vehicle.run(0.8);
    vehicle.hold(CENTRED);
    vehicle.run(2.0);
    let heading = yaw(&vehicle);
    assert!(heading > 0.8, "to the left: {heading}");
    vehicle.hold(Sticks { pitch: 0.6, ..CENTRED });
    vehicle.run(4.0);
    let v = vehicle.body.nav.velocity;
    let along = Vector3::new(heading.cos(), heading.sin(), 0.0);
    assert!(v.norm() > 2.0 && (v - along * v.dot(&along)).norm() < 0.1, "{v} is not along {along}");
    vehicle.hold(CENTRED);
    vehicle.run(6.0);
    let stopped = vehicle.body.nav.position;
    assert!(vehicle.body.nav.velocity.norm() < 0.02);
    vehicle.run(5.0);
    vehicle.assert_near(stopped.into(), 0.03);
    assert!(wrap_angle(yaw(&vehicle) - heading).abs() < 0.02, "the heading too");
}

#[test]
fn acro_flips_at_720_degrees_a_second_and_recovers() {
    let mut config = agile();
    config.manual.acro_rates_rad_s = [720.0_f32.to_radians(); 3];
    for (roll, pitch) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
        let mut vehicle = Vehicle::airborne(&config);
        vehicle.ask(Request::GoTo(firmware::commander::Goal::at([0.0, 0.0, 30.0], 0.0)));
        vehicle.run(20.0);
        vehicle.hold(CENTRED);
        vehicle.run(0.1);
        vehicle.ask(Request::Manual(ManualMode::Acro));
        vehicle.run(0.1);
        vehicle.hold(Sticks { throttle: 0.9, ..CENTRED });
        vehicle.run(0.3);
        vehicle.hold(Sticks { roll, pitch, throttle: 0.6, ..CENTRED });
        let (mut upside_down, mut fastest) = (false, 0.0_f32);
        for _ in 0..100 {
            vehicle.run(0.01);
            upside_down |= tilt_deg(&vehicle) > 150.0;
            fastest = fastest.max(vehicle.body.nav.rates.norm().to_degrees());
        }
        assert!(upside_down && fastest > 600.0 && fastest < 800.0, "{roll} {pitch}: {fastest}°/s");
        vehicle.hold(CENTRED);
        vehicle.run(0.3);
        assert!(vehicle.body.nav.rates.norm() < 0.3, "it stops: {}", vehicle.body.nav.rates);
        vehicle.ask(Request::Manual(ManualMode::Position));
        vehicle.run(6.0);
        assert!(tilt_deg(&vehicle) < 3.0 && vehicle.body.nav.velocity.norm() < 0.1, "{:?}", vehicle.body.nav);
        assert!(vehicle.body.nav.position.z > 5.0, "{}", vehicle.body.nav.position);
    }
}

#[test]
fn lost_sticks_are_answered_in_manual_modes_alone() {
    let mut vehicle = in_mode(ManualMode::Stabilized);
    vehicle.latest.sticks = None;
    vehicle.run(0.1);
    assert_eq!(vehicle.told.mode, Mode::Return);
    let mut vehicle = Vehicle::airborne(&agile());
    vehicle.hold(CENTRED);
    vehicle.run(1.0);
    vehicle.latest.sticks = None;
    vehicle.run(1.0);
    assert_eq!(vehicle.told.mode, Mode::Hold);
}

#[test]
fn a_moved_stick_ends_an_automatic_mode_and_a_resting_one_does_not() {
    let mut vehicle = Vehicle::airborne(&agile());
    // As it lies there, off its centre.
    vehicle.hold(Sticks { pitch: 0.5, ..CENTRED });
    vehicle.run(0.2);
    vehicle.ask(Request::Return);
    vehicle.run(1.0);
    assert_eq!(vehicle.told.mode, Mode::Return);
    vehicle.hold(Sticks { pitch: 0.5, roll: 0.4, ..CENTRED });
    vehicle.run(0.1);
    assert_eq!(vehicle.told.mode, Mode::Position);
}

#[test]
fn a_stick_that_is_held_when_an_automatic_mode_begins_does_not_end_it_whatever_was_flown_before() {
    for request in [Request::Return, Request::Hold, Request::Land] {
        // An automatic mode with centred sticks, and then by hand.
        let mut vehicle = in_mode(ManualMode::Position);
        vehicle.ask(Request::Hold);
        vehicle.run(0.5);
        vehicle.ask(Request::Manual(ManualMode::Position));
        vehicle.run(0.2);
        vehicle.hold(Sticks { pitch: 0.6, ..CENTRED });
        vehicle.run(1.0);
        vehicle.ask(request);
        vehicle.run(1.0);
        assert_ne!(vehicle.told.mode, Mode::Position, "{request:?}");
        // Let go, and moved anew, it takes over.
        vehicle.hold(CENTRED);
        vehicle.run(0.1);
        vehicle.hold(Sticks { pitch: 0.6, ..CENTRED });
        vehicle.run(0.1);
        assert_eq!(vehicle.told.mode, Mode::Position, "{request:?}");
    }
}

#[test]
fn without_sticks_or_with_the_throttle_up_it_is_not_armed_for_a_manual_mode() {
    let mut vehicle = Vehicle::new(&agile());
    vehicle.ask(Request::Manual(ManualMode::Stabilized));
    vehicle.run(0.1);
    vehicle.ask(Request::Arm { force: false });
    vehicle.run(0.1);
    assert!(!vehicle.told.armed);
    vehicle.hold(CENTRED);
    vehicle.ask(Request::Arm { force: false });
    vehicle.run(0.1);
    assert!(!vehicle.told.armed, "half the throttle would lift it");
    vehicle.hold(DOWN);
    vehicle.run(0.1);
    vehicle.ask(Request::Arm { force: false });
    vehicle.run(9.9);
    assert!(vehicle.told.armed);
    vehicle.run(0.5);
    assert!(!vehicle.told.armed, "10 s on the ground, untouched");
}

#[test]
fn what_stands_stays_level_until_it_is_clear_of_the_ground_and_touches_it_gently() {
    let mut vehicle = Vehicle::new(&agile());
    vehicle.hold(DOWN);
    vehicle.ask(Request::Manual(ManualMode::Stabilized));
    vehicle.run(0.1);
    vehicle.ask(Request::Arm { force: false });
    vehicle.run(0.1);
    // Nine tenths of the weight: it stands, and would be tipped over by its feet.
    vehicle.hold(Sticks { roll: 1.0, throttle: 0.44, ..CENTRED });
    vehicle.run(3.0);
    assert_eq!((vehicle.told.mode, vehicle.body.nav.position.z), (Mode::Stabilized, 0.0));
    let wanted = vehicle.reference.attitude.target.attitude * Vector3::z();
    assert!(wanted.z > 0.9999 && vehicle.reference.authority == Authority::Gentle, "{wanted}");
    vehicle.hold(Sticks { roll: 1.0, throttle: 0.8, ..CENTRED });
    vehicle.run(1.5);
    assert!(tilt_deg(&vehicle) > 30.0 && vehicle.reference.authority == Authority::Full);
    for (mode, throttle) in [(ManualMode::Position, 0.0), (ManualMode::Altitude, 0.0), (ManualMode::Stabilized, 0.1)] {
        let mut vehicle = in_mode(mode);
        assert_eq!(vehicle.reference.authority, Authority::Full);
        vehicle.hold(Sticks { throttle, ..CENTRED });
        while vehicle.body.nav.position.z > 0.3 {
            vehicle.run(0.02);
        }
        let falls = vehicle.body.nav.velocity.z < -0.6;
        assert_eq!(falls, mode == ManualMode::Stabilized);
        assert_eq!(vehicle.reference.authority, if falls { Authority::Full } else { Authority::Gentle }, "{mode:?}");
        vehicle.run(0.7);
        assert_ne!(vehicle.reference.authority, Authority::Full, "{mode:?}: on the ground");
    }
}

#[test]
fn what_falls_below_its_home_with_little_thrust_keeps_its_attitude() {
    let mut vehicle = in_mode(ManualMode::Stabilized);
    vehicle.ask(Request::SetHome { position_m: Some([0.0, 0.0, 300.0]) });
    vehicle.body.nav.position.z = 200.0;
    vehicle.run(0.1);
    for (roll, pitch) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (1.0, 1.0), (0.0, 0.0)] {
        vehicle.hold(Sticks { roll, pitch, throttle: 0.0, ..CENTRED });
        for _ in 0..30 {
            vehicle.run(0.01);
            assert!(tilt_deg(&vehicle) < 40.0, "{}°", tilt_deg(&vehicle));
            assert!(vehicle.body.nav.velocity.z > -0.7 || vehicle.reference.authority == Authority::Full);
        }
    }
    assert!(tilt_deg(&vehicle) < 2.0);
    // It is caught by half of the thrust beyond the weight, g/2: the way is v²/g, and that of the delays.
    let (from, fell) = (vehicle.body.nav.position.z, vehicle.body.nav.velocity.z);
    assert!(fell < -8.0, "{fell} m/s");
    vehicle.ask(Request::Manual(ManualMode::Position));
    vehicle.hold(CENTRED);
    vehicle.run(8.0);
    let lost = from - vehicle.body.nav.position.z;
    assert!(vehicle.body.nav.velocity.norm() < 0.1 && lost < 2.0 * fell * fell / 9.81, "{lost} m");
}
