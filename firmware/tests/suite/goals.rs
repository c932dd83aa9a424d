//! Flights to places, heights and headings, each of them asked for by itself.

use firmware::commander::{Goal, Mode, Request, SpeedKind};
use firmware::config::FlightConfig;
use firmware::math::wrap_angle;
use nalgebra::Vector3;

use crate::vehicle::{Vehicle, config};

const NOTHING: Goal = Goal { place_m: None, height_m: None, yaw_rad: None, speed_m_s: None };

fn yaw(vehicle: &Vehicle) -> f32 {
    vehicle.body.nav.attitude.euler_angles().2
}

#[test]
fn a_height_alone_is_gone_to_over_where_it_stops_and_a_heading_alone_is_turned_to() {
    let mut vehicle = Vehicle::airborne(&config());
    vehicle.ask(Request::GoTo(Goal::at([40.0, 0.0, 4.0], 0.0)));
    vehicle.run(5.0);
    vehicle.ask(Request::Hold);
    vehicle.run(0.1);
    let from = vehicle.body.nav;
    assert!(from.velocity.x > 4.0);
    vehicle.ask(Request::GoTo(Goal { height_m: Some(9.0), ..NOTHING }));
    vehicle.run(8.0);
    let stopped = vehicle.body.nav;
    assert!((stopped.position.z - 9.0).abs() < 0.03 && stopped.velocity.norm() < 0.02, "{stopped:?}");
    assert!((3.0..9.0).contains(&(stopped.position - from.position).x), "braked, not turned round: {stopped:?}");
    vehicle.ask(Request::GoTo(Goal { yaw_rad: Some(-2.0), ..NOTHING }));
    vehicle.run(5.0);
    assert!(wrap_angle(yaw(&vehicle) + 2.0).abs() < 0.02, "{}", yaw(&vehicle));
    vehicle.assert_near(stopped.position.into(), 0.05);
    assert_eq!(vehicle.told.mode, Mode::GoTo);
}

#[test]
fn on_the_way_to_a_place_another_height_or_heading_changes_that_alone() {
    let mut vehicle = Vehicle::airborne(&config());
    vehicle.ask(Request::GoTo(Goal::at([20.0, -10.0, 4.0], 0.0)));
    vehicle.run(2.0);
    vehicle.ask(Request::GoTo(Goal { height_m: Some(7.0), ..NOTHING }));
    vehicle.run(1.0);
    vehicle.ask(Request::GoTo(Goal { yaw_rad: Some(1.0), ..NOTHING }));
    vehicle.run(8.0);
    vehicle.assert_near([20.0, -10.0, 7.0], 0.05);
    assert!((yaw(&vehicle) - 1.0).abs() < 0.02);
}

#[test]
fn a_chosen_speed_counts_until_another_one_or_disarming_and_within_the_limits() {
    let config =
        FlightConfig { modes: firmware::config::ModeSettings { fastest_m_s: 8.0, ..config().modes }, ..config() };
    let mut vehicle = Vehicle::airborne(&config);
    let top_speed = |vehicle: &mut Vehicle, x: f32| {
        vehicle.ask(Request::GoTo(Goal::at([x, 0.0, 4.0], 0.0)));
        let mut most = 0.0_f32;
        for _ in 0..250 {
            vehicle.run(0.1);
            most = most.max(vehicle.body.nav.velocity.xy().norm());
        }
        vehicle.assert_near([x, 0.0, 4.0], 0.1);
        most
    };
    let speed = |kind, speed_m_s| Request::Speed { kind, speed_m_s };
    for (chosen, expected) in [(Some(2.0), 2.0), (Some(7.0), 7.0), (Some(50.0), 8.0), (None, 5.0)] {
        vehicle.ask(speed(SpeedKind::Horizontal, chosen));
        vehicle.run(0.1);
        let there = if vehicle.body.nav.position.x > 20.0 { 0.0 } else { 40.0 };
        let reached = top_speed(&mut vehicle, there);
        assert!((reached - expected).abs() < 0.1, "{chosen:?}: {reached}");
    }
    vehicle.ask(Request::GoTo(Goal { speed_m_s: Some(1.0), ..Goal::at([40.0, 0.0, 4.0], 0.0) }));
    vehicle.run(6.0);
    assert!((vehicle.body.nav.velocity.xy().norm() - 1.0).abs() < 0.05, "by the goal itself");
    let reached = top_speed(&mut vehicle, 60.0);
    assert!((reached - 5.0).abs() < 0.1, "and on the next way the usual one: {reached}");
    vehicle.ask(Request::GoTo(Goal { speed_m_s: Some(1.0), ..Goal::at([40.0, 0.0, 4.0], 0.0) }));
    vehicle.run(3.0);
    vehicle.ask(speed(SpeedKind::Horizontal, Some(3.0)));
    vehicle.run(4.0);
    assert!((vehicle.body.nav.velocity.xy().norm() - 3.0).abs() < 0.05, "by what is chosen on the way");
    vehicle.ask(Request::Hold);
    vehicle.run(4.0);
    vehicle.ask(speed(SpeedKind::Up, Some(0.5)));
    vehicle.ask(Request::GoTo(Goal { height_m: Some(20.0), ..NOTHING }));
    vehicle.run(6.0);
    assert!((vehicle.body.nav.velocity.z - 0.5).abs() < 0.02, "{}", vehicle.body.nav.velocity);
}

#[test]
fn it_lands_at_a_place_with_a_heading() {
    let mut vehicle = Vehicle::airborne(&config());
    vehicle.ask(Request::LandAt(Goal { place_m: Some([7.0, -4.0]), yaw_rad: Some(2.5), ..NOTHING }));
    vehicle.run(0.1);
    assert_eq!(vehicle.told.mode, Mode::Land);
    vehicle.until(Mode::Disarmed, 40.0);
    let at = vehicle.body.nav.position - Vector3::new(7.0, -4.0, 0.0);
    assert!(at.norm() < 0.1 && wrap_angle(yaw(&vehicle) - 2.5).abs() < 0.1, "{at} {}", yaw(&vehicle));
}
