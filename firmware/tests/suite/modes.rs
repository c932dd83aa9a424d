//! Whole flights through the partitions, on a rigid body over a flat ground: what a pilot asks for is done, and what is
//! not known of the motion is not needed.

use firmware::airframe::ROTORS;
use firmware::autopilot::Autopilot;
use firmware::commander::{Directive, Event, Goal, Known, Mode, Request};
use firmware::config::{FlightConfig, Start};
use firmware::guidance::Trajectory;
use firmware::settings::{Class, SETTINGS, Setting, Settings, Value};
use firmware::signals::{MotorCommand, NavHealth, NavState, SensorFrame, TICK_S};
use nalgebra::Vector3;

use crate::vehicle::{Body, Spoil, Vehicle, config};

fn is_stopped(vehicle: &Vehicle) -> bool {
    vehicle.motors == MotorCommand::STOPPED
}

#[test]
fn armed_it_idles_takes_off_holds_lands_and_stops() {
    let config = config();
    let mut vehicle = Vehicle::new(&config);
    vehicle.run(0.5);
    assert!(is_stopped(&vehicle));
    vehicle.ask(Request::Arm { force: false });
    vehicle.run(2.0);
    let idle = config.modes.idle_part * config.airframe.omega_max_rad_s;
    assert_eq!(vehicle.motors.omega_rad_s, [idle; ROTORS]);
    vehicle.ask(Request::TakeOff { height_m: 3.0 });
    vehicle.until(Mode::Hold, 6.0);
    vehicle.run(3.0);
    vehicle.assert_near([0.0, 0.0, 3.0], 0.05);
    vehicle.ask(Request::Land);
    vehicle.until(Mode::Idle, 12.0);
    assert!(vehicle.told.landed && vehicle.body.nav.position.z == 0.0);
    vehicle.run(2.1);
    assert!(is_stopped(&vehicle) && !vehicle.told.armed);
}

#[test]
fn it_goes_where_it_is_told_and_brakes_when_it_is_told_to_hold() {
    let mut vehicle = Vehicle::airborne(&config());
    vehicle.ask(Request::GoTo(Goal::at([6.0, -3.0, 5.0], 1.0)));
    vehicle.run(8.0);
    vehicle.assert_near([6.0, -3.0, 5.0], 0.05);
    let (_, _, yaw) = vehicle.body.nav.attitude.euler_angles();
    assert!((0.97..1.03).contains(&yaw), "{yaw}");
    vehicle.ask(Request::GoTo(Goal::at([60.0, -3.0, 5.0], 1.0)));
    vehicle.run(4.0);
    assert!(vehicle.body.nav.velocity.x > 4.5, "{}", vehicle.body.nav.velocity);
    vehicle.ask(Request::Hold);
    let from = vehicle.body.nav.position;
    vehicle.run(5.0);
    let stopped = vehicle.body.nav.position;
    assert!((4.0..8.0).contains(&(stopped - from).x) && vehicle.body.nav.velocity.norm() < 0.02);
    vehicle.run(5.0);
    vehicle.assert_near(stopped.into(), 0.02);
}

#[test]
fn a_velocity_is_flown_and_ends_in_a_hold() {
    let mut vehicle = Vehicle::airborne(&config());
    for _ in 0..8 {
        vehicle.ask(Request::Velocity { velocity_m_s: [0.0, 2.0, 0.0], yaw_rate_rad_s: 0.0 });
        vehicle.run(0.5);
    }
    assert!((vehicle.body.nav.velocity - Vector3::new(0.0, 2.0, 0.0)).norm() < 0.05);
    vehicle.until(Mode::Hold, 1.1);
    vehicle.run(4.0);
    assert!(vehicle.body.nav.velocity.norm() < 0.02);
}

#[test]
fn it_returns_over_its_home_and_lands_there() {
    let mut vehicle = Vehicle::airborne(&config());
    vehicle.ask(Request::GoTo(Goal::at([15.0, 10.0, 4.0], 0.0)));
    vehicle.run(10.0);
    vehicle.ask(Request::Return);
    vehicle.until(Mode::Land, 25.0);
    vehicle.assert_near([0.0, 0.0, 10.0], 0.6);
    vehicle.until(Mode::Disarmed, 25.0);
    vehicle.assert_near([0.0; 3], 0.3);
}

#[test]
fn a_trajectory_is_joined_from_anywhere_in_the_air() {
    let config = FlightConfig {
        trajectory: Trajectory::FigureEight {
            center_m: [0.0, 0.0, 5.0],
            amplitude_m: [3.0, 1.5],
            rate_rad_s: 0.6,
            yaw_rad: 0.0,
        },
        ..config()
    };
    let mut vehicle = Vehicle::airborne(&config);
    vehicle.ask(Request::GoTo(Goal::at([8.0, 4.0, 3.0], 0.5)));
    vehicle.run(6.0);
    vehicle.ask(Request::Follow);
    let mut furthest = 0.0;
    for _ in 0..20_000 {
        vehicle.tick();
        let (speed, acceleration) = (vehicle.body.nav.velocity.norm(), vehicle.body.nav.attitude * Vector3::z());
        assert!(speed < 5.5 && acceleration.z > 0.85, "no leap on the way: {speed} {acceleration}");
        if let Some(since) = vehicle.told.flight_start()
            && vehicle.tick > since + 6_000
        {
            let phase = 0.6 * (vehicle.tick - since) as f32 * TICK_S;
            let (sine, twice) = (firmware::math::sin_cos(phase).0, firmware::math::sin_cos(2.0 * phase).0);
            let away = vehicle.body.nav.position - Vector3::new(3.0 * sine, 1.5 * twice, 5.0);
            furthest = firmware::math::max(furthest, away.norm());
        }
    }
    assert!(vehicle.told.flight_start().is_some() && furthest < 0.05, "{furthest}");
}

#[test]
fn from_the_ground_the_trajectory_is_what_it_always_was() {
    let mut vehicle = Vehicle::new(&config());
    vehicle.ask(Request::Arm { force: false });
    vehicle.ask(Request::Follow);
    vehicle.run(5.0);
    assert_eq!(vehicle.told.mode, Mode::Follow);
    vehicle.assert_near([0.0, 0.0, 2.0], 0.05);
}

#[test]
fn a_hold_in_the_middle_of_a_trajectory_leaves_it_without_a_leap() {
    let config = FlightConfig {
        trajectory: Trajectory::PAPER_HELIX,
        join: None,
        start: Start::InFlight,
        start_position_m: [0.0, 5.0, 2.0],
        ..config()
    };
    let mut vehicle = Vehicle::new(&config);
    vehicle.body.nav.velocity = Vector3::new(4.0, 0.0, 1.0);
    vehicle.run(3.0);
    vehicle.ask(Request::Hold);
    let mut before = vehicle.reference.attitude.target.attitude;
    for _ in 0..6_000 {
        vehicle.tick();
        let now = vehicle.reference.attitude.target.attitude;
        assert!(before.angle_to(&now) < 0.06, "{} at {}", before.angle_to(&now), vehicle.tick);
        before = now;
    }
    assert!(vehicle.body.nav.velocity.norm() < 0.02);
}

/// Comes down by what is known, with the rest of the motion spoilt, and how fast and far it went sideways.
fn descend(health: NavHealth, spoil: Spoil, known: Known) -> (f32, f32, Vehicle) {
    let mut vehicle = Vehicle::airborne(&config());
    let from = vehicle.body.nav.position;
    (vehicle.health, vehicle.spoil) = (health, spoil);
    let (mut sideways, mut down) = (0.0, 0.0);
    let end = vehicle.tick + 40_000;
    while vehicle.tick < end && (vehicle.body.nav.position.z > 0.0) {
        vehicle.tick();
        if let Directive::Descend { known: told, .. } = vehicle.told.directive {
            assert_eq!(told, known);
        }
        sideways = firmware::math::max(sideways, (vehicle.body.nav.position - from).xy().norm());
        down = firmware::math::max(down, -vehicle.body.nav.velocity.z);
    }
    assert!(vehicle.tick < end, "{:?}", vehicle.body.nav);
    (sideways, down, vehicle)
}

#[test]
fn without_a_position_it_descends_where_it_is() {
    let health = NavHealth { position: false, ..NavHealth::ALL };
    // Once it is known to be lost, the position runs away.
    let spoil: Spoil = |nav, t| nav.position.x += if t > 12.0 { 5.0 * (t - 12.0) } else { 0.0 };
    let (sideways, down, mut vehicle) = descend(health, spoil, Known::Velocity);
    assert!(sideways < 0.1 && down < 1.1, "{sideways} m, {down} m/s");
    vehicle.until(Mode::Disarmed, 6.0);
    assert_eq!(vehicle.events, [Event::PositionLost]);
}

#[test]
fn without_a_velocity_it_descends_level() {
    let health = NavHealth { position: false, velocity: false, ..NavHealth::ALL };
    let spoil: Spoil = |nav, t| nav.velocity.y += if t > 12.0 { t - 12.0 } else { 0.0 };
    let (sideways, down, mut vehicle) = descend(health, spoil, Known::Height);
    assert!(sideways < 0.3 && down < 1.1, "{sideways} m, {down} m/s");
    vehicle.until(Mode::Disarmed, 6.0);
    assert_eq!(vehicle.events, [Event::VelocityLost]);
}

#[test]
fn without_a_height_it_sinks_level() {
    let health = NavHealth { height: false, climb: false, ..NavHealth::ALL };
    let spoil: Spoil = |nav, t| nav.position.z += if t > 12.0 { t - 12.0 } else { 0.0 };
    let (sideways, down, vehicle) = descend(health, spoil, Known::Attitude);
    assert!(sideways < 0.3 && down < 2.0, "{sideways} m, {down} m/s");
    assert_eq!(vehicle.events, [Event::HeightLost]);
}

#[test]
fn programs_on_board_fly_it_through_the_autopilots_door() {
    let config = config();
    let mut pilot = Autopilot::new(&config).expect("valid");
    let mut body = Body { airframe: config.airframe, nav: NavState::at_rest() };
    let mut fly = |pilot: &mut Autopilot, ticks: u32| {
        for _ in 0..ticks {
            let motors = pilot.tick(Some(&SensorFrame::Motion(body.nav))).motors;
            body.step(&motors);
        }
        body.nav.position
    };
    for request in [Request::Arm { force: false }, Request::TakeOff { height_m: 2.5 }] {
        assert_eq!(pilot.inner.request(request), Ok(()));
    }
    let position = fly(&mut pilot, 8_000);
    assert!((position - Vector3::new(0.0, 0.0, 2.5)).norm() < 0.05, "{position}");
    assert_eq!(pilot.inner.request(Request::Land), Ok(()));
    let position = fly(&mut pilot, 12_000);
    assert_eq!((position.z, pilot.inner.commander_output().mode), (0.0, Mode::Disarmed));
    for _ in 0..4 {
        assert_eq!(pilot.inner.request(Request::Land), Ok(()));
    }
    assert_eq!(pilot.inner.request(Request::Hold), Err(Request::Hold), "no more than four at once");
}

#[test]
fn without_a_height_it_comes_down_by_its_vertical_velocity_and_lands() {
    let health = NavHealth { height: false, ..NavHealth::ALL };
    // Its idea of the height runs away upwards.
    let spoil: Spoil = |nav, t| nav.position.z += if t > 12.0 { 3.0 * (t - 12.0) } else { 0.0 };
    let (sideways, down, mut vehicle) = descend(health, spoil, Known::Climb);
    assert!(sideways < 0.3 && down < 1.2, "{sideways} m, {down} m/s");
    vehicle.until(Mode::Disarmed, 20.0);
    assert_eq!(vehicle.events, [Event::HeightLost]);
}

/// Lands, and the speed of the touchdown, m/s.
fn touch_down(vehicle: &mut Vehicle) -> f32 {
    vehicle.ask(Request::Land);
    let (mut speed, end) = (0.0, vehicle.tick + 90_000);
    while vehicle.body.nav.position.z > 0.0 {
        speed = -vehicle.body.nav.velocity.z;
        vehicle.tick();
        assert!(vehicle.tick < end, "{:?}", vehicle.body.nav);
    }
    speed
}

#[test]
fn a_fast_landing_slows_down_in_time() {
    for (down_m_s, vertical_acceleration_m_s2, jerk_m_s3) in
        [(0.7, 2.0, 10.0), (3.0, 2.0, 10.0), (5.0, 2.0, 10.0), (5.0, 1.0, 10.0), (5.0, 2.0, 2.0), (8.0, 4.0, 40.0)]
    {
        let mut config = config();
        let modes = &mut config.modes;
        (modes.landing_m_s, modes.sink_m_s) = (down_m_s, down_m_s);
        let mut vehicle = Vehicle::airborne(&config);
        vehicle.ask(Request::GoTo(Goal::at([0.0, 0.0, 60.0], 0.0)));
        vehicle.run(40.0);
        let mut slower = config.clone();
        (slower.modes.vertical_acceleration_m_s2, slower.modes.jerk_m_s3) = (vertical_acceleration_m_s2, jerk_m_s3);
        vehicle.take_over(&slower);
        let speed = touch_down(&mut vehicle);
        assert!((0.3..0.5).contains(&speed), "{down_m_s} m/s, {vertical_acceleration_m_s2} m/s²: {speed} m/s");
    }
}

#[test]
fn a_landing_with_a_higher_speed_takes_less_time() {
    let duration = |down_m_s: f32| {
        let mut config = config();
        (config.modes.landing_m_s, config.modes.sink_m_s) = (down_m_s, down_m_s);
        let mut vehicle = Vehicle::airborne(&config);
        vehicle.ask(Request::GoTo(Goal::at([0.0, 0.0, 15.0], 0.0)));
        vehicle.run(20.0);
        vehicle.ask(Request::Land);
        let begun = vehicle.tick;
        vehicle.until(Mode::Idle, 60.0);
        vehicle.tick - begun
    };
    let times = [0.7, 1.5, 3.0, 8.0].map(duration);
    assert!(times.is_sorted_by(|slow, fast| slow > fast), "{times:?} ms");
    assert!(2 * times[3] < times[0], "{times:?} ms");
}

#[test]
fn a_home_below_the_ground_hastens_no_landing() {
    let mut vehicle = Vehicle::airborne(&config());
    vehicle.ask(Request::SetHome { position_m: Some([0.0, 0.0, -100.0]) });
    let speed = touch_down(&mut vehicle);
    assert!((0.3..0.5).contains(&speed), "{speed} m/s");
}

#[test]
fn a_return_follows_a_home_that_is_corrected_in_height() {
    let mut vehicle = Vehicle::airborne(&config());
    vehicle.ask(Request::SetHome { position_m: Some([5.0, 0.0, 1000.0]) });
    vehicle.ask(Request::Return);
    vehicle.run(10.0);
    let before = vehicle.body.nav.position.z;
    assert!(before > 15.0 && vehicle.told.mode == Mode::Return);
    vehicle.ask(Request::SetHome { position_m: Some([5.0, 0.0, 0.0]) });
    vehicle.until(Mode::Land, 20.0);
    vehicle.assert_near([5.0, 0.0, before], 3.0);
}

/// What is lost, if the vehicle is, by setting one value in flight: it goes somewhere meanwhile, holds and lands.
fn lost_by(setting: usize, value: Value) -> Option<String> {
    let mut vehicle = Vehicle::airborne(&config());
    vehicle.ask(Request::GoTo(Goal::at([6.0, -4.0, 10.0], 0.0)));
    vehicle.run(1.5);
    let mut settings = Settings::of(&vehicle.config);
    let change = settings.set(setting, value, true).ok()?;
    vehicle.commander.apply(&change);
    vehicle.outer.apply(&change);
    vehicle.inner.apply(&change);
    let (mut lowest, mut highest, mut steepest) = (10.0, 0.0, 1.0);
    for request in [None, Some(Request::Hold)] {
        if let Some(request) = request {
            vehicle.ask(request);
        }
        for _ in 0..10_000 {
            vehicle.tick();
            let nav = &vehicle.body.nav;
            lowest = firmware::math::min(lowest, nav.position.z);
            highest = firmware::math::max(highest, nav.position.z);
            steepest = firmware::math::min(steepest, (nav.attitude * Vector3::z()).z);
        }
    }
    let off = lowest < 3.0 || highest > 12.0 || steepest < 0.6;
    off.then(|| format!("{} {value:?}: {lowest} to {highest} m, cosine {steepest}", SETTINGS[setting].name))
}

#[test]
fn no_setting_at_an_end_of_its_range_loses_the_vehicle_in_flight() {
    // How large a reaching gain may be depends on the law's layer or horizon.
    let may_be_set = |setting: &Setting| setting.class == Class::InFlight && !setting.name.ends_with("_K");
    let in_flight = SETTINGS.iter().enumerate().filter(|(_, setting)| may_be_set(setting));
    let ends = in_flight.flat_map(|(index, setting)| [(index, setting.min()), (index, setting.max())]);
    let lost: Vec<String> = ends.filter_map(|(index, value)| lost_by(index, value)).collect();
    assert!(lost.is_empty(), "{lost:#?}");
}
