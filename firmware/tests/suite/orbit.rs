//! Circles.

use firmware::commander::{Mode, OrbitGoal, OrbitHeading, Request};
use firmware::math::wrap_angle;
use nalgebra::Vector3;

use crate::vehicle::{Vehicle, config};

const GOAL: OrbitGoal = OrbitGoal {
    center_m: Some([6.0, 2.0]),
    height_m: Some(7.0),
    radius_m: Some(8.0),
    speed_m_s: Some(3.0),
    heading: OrbitHeading::Kept,
};

#[test]
fn a_circle_is_flown_round_its_centre_either_way_with_the_nose_where_it_is_wanted() {
    for (speed, heading) in [
        (3.0, OrbitHeading::Center),
        (-3.0, OrbitHeading::Center),
        (2.0, OrbitHeading::Along),
        (-4.0, OrbitHeading::Kept),
    ] {
        let mut vehicle = Vehicle::airborne(&config());
        vehicle.ask(Request::Orbit(OrbitGoal { speed_m_s: Some(speed), heading, ..GOAL }));
        vehicle.run(15.0);
        assert_eq!(vehicle.told.mode, Mode::Orbit);
        let (mut turned, mut before) = (0.0_f32, None);
        for _ in 0..200 {
            vehicle.run(0.05);
            let nav = vehicle.body.nav;
            let away = nav.position - Vector3::new(6.0, 2.0, 7.0);
            let angle = away.y.atan2(away.x);
            turned += before.map_or(0.0, |before| wrap_angle(angle - before));
            before = Some(angle);
            assert!((away.xy().norm() - 8.0).abs() < 0.05 && away.z.abs() < 0.05, "{speed}: {away}");
            let nose = match heading {
                OrbitHeading::Center => angle + core::f32::consts::PI,
                OrbitHeading::Along => angle + core::f32::consts::FRAC_PI_2,
                OrbitHeading::Kept => 0.0,
            };
            assert!(wrap_angle(nav.yaw() - nose).abs() < 0.1, "{heading:?}: {} is not {nose}", nav.yaw());
        }
        let expected = speed / 8.0 * 199.0 * 0.05;
        assert!((turned - expected).abs() < 0.02, "{turned} of {expected} rad");
        vehicle.ask(Request::Hold);
        vehicle.run(5.0);
        assert!(vehicle.body.nav.velocity.norm() < 0.02);
    }
}

#[test]
fn what_is_not_given_is_where_it_is_and_no_circle_is_faster_than_it_can_turn() {
    let mut vehicle = Vehicle::airborne(&config());
    let goal = OrbitGoal { center_m: None, height_m: None, radius_m: Some(4.0), speed_m_s: Some(50.0), ..GOAL };
    vehicle.ask(Request::Orbit(goal));
    vehicle.run(20.0);
    let nav = vehicle.body.nav;
    // 0.8 of 3 m/s².
    let fastest = (0.8_f32 * 3.0 * 4.0).sqrt();
    assert!((nav.velocity.xy().norm() - fastest).abs() < 0.1, "{}", nav.velocity);
    assert!((nav.position.xy().norm() - 4.0).abs() < 0.1 && (nav.position.z - 4.0).abs() < 0.05, "{}", nav.position);
}
