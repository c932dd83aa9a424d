//! Steps of the place: straight, within limits, not overshot, and hardly slower than possible.

use super::*;

/// Shortest time from rest to rest over a distance with limited speed, acceleration and jerk, s.
fn fastest(distance: f64, v: f64, a: f64, j: f64) -> f64 {
    if distance >= v * (v / a + a / j) {
        distance / v + v / a + a / j
    } else if distance >= 2.0 * a * a * a / (j * j) {
        a / j + ((a / j) * (a / j) + 4.0 * distance / a).sqrt()
    } else {
        (32.0 * distance / j).cbrt()
    }
}

fn assert_within_limits(r: &FlatReference) {
    let most = |value: f32, limit: f32, name: &str| assert!(value <= 1.01 * limit, "{name}: {value}");
    most(r.velocity.xy().norm(), LIMITS.cruise_m_s, "speed");
    most(r.velocity.z, LIMITS.climb_m_s, "climb");
    most(-r.velocity.z, LIMITS.sink_m_s, "sink");
    most(r.acceleration.xy().norm(), LIMITS.acceleration_m_s2, "acceleration");
    most(math::abs(r.acceleration.z), LIMITS.vertical_acceleration_m_s2, "vertical acceleration");
    most(r.jerk.xy().norm(), LIMITS.jerk_m_s3, "jerk");
    most(math::abs(r.jerk.z), LIMITS.jerk_m_s3, "vertical jerk");
    // A jerk that goes from one end to the other through a lag of 12 ms.
    most(r.snap.xy().norm(), 2.0 * LIMITS.jerk_m_s3 / 0.012, "snap");
    most(math::abs(r.yaw_rate), LIMITS.yaw_rate_rad_s, "yaw rate");
    most(math::abs(r.yaw_acceleration), LIMITS.yaw_acceleration_rad_s2, "yaw acceleration");
}

/// A step after 1 s from the origin by a vector.
fn step(to: [f64; 3]) -> impl Fn(f64) -> [[f64; 3]; 3] + Copy {
    move |t| [if t < 1.0 { [0.0; 3] } else { to }, [0.0; 3], [0.0; 3]]
}

#[test]
fn a_step_is_a_straight_line_that_ends_without_overshoot_in_nearly_the_shortest_time() {
    for (distance, factor) in
        [(0.05, 2.3), (0.1, 1.9), (0.3, 1.4), (1.0, 1.2), (3.0, 1.1), (10.0, 1.05), (30.0, 1.02), (100.0, 1.01)]
    {
        for bearing in [0.0_f64, 15.0, 45.0, 137.0] {
            for (period_s, velocity) in [(0.02, false), (0.05, false), (0.02, true), (0.1, false)] {
                let (s, c) = bearing.to_radians().sin_cos();
                let path = step([distance * c, distance * s, 0.0]);
                let link = Link { period_s, velocity, ..LINK };
                let ideal = fastest(distance, 5.0, 3.0, 10.0);
                let flown = link.fly(&mut start_on(path), 1.5 + factor * ideal + 3.0, path);
                let mut arrival = None;
                for (t, r) in &flown {
                    assert_within_limits(r);
                    let (x, y) = (f64::from(r.position.x), f64::from(r.position.y));
                    let (along, across) = (x * c + y * s, y * c - x * s);
                    assert!(across.abs() < 1e-3, "{distance} m at {bearing}°: {across} m beside the line");
                    assert!(along < 1.002 * distance, "{distance} m: {along} m");
                    arrival = arrival.or((along > 0.98 * distance).then_some(*t));
                }
                // The sample waits up to a period, 10 ms and 8 ms.
                let time = arrival.expect("arrives") - 1.0 - period_s - 0.018;
                assert!(time < factor * ideal, "{distance} m in {time} s, not {ideal} s");
                let end = flown.last().expect("some").1;
                assert!(error(&end, path(2.0)[0]) < 0.002 + 1e-5 * distance, "{distance}: {}", end.position);
            }
        }
    }
}

#[test]
fn a_vertical_step_and_a_turn_are_within_their_limits() {
    for height in [6.0, -4.0, 0.2] {
        let mut stream = Stream::new(&LIMITS, FASTEST);
        for i in 0..2_500 {
            let motion = Motion::default().with_position([None, None, Some(height)]).with_yaw(-2.5);
            let r = stream.advance(i * 4 + 2, &Sample { motion, at: i / 5 * 20, sent_ms: None });
            assert_within_limits(&r);
            assert!(
                r.position.z * if height < 0.0 { -1.0 } else { 1.0 } < 1.002 * math::abs(height) && r.yaw > -2.505,
                "{r:?}"
            );
        }
        let r = stream.reference();
        assert!(math::abs(r.position.z - height) < 1e-3 && math::abs(r.yaw + 2.5) < 1e-3, "{r:?}");
    }
}

#[test]
fn a_place_is_reached_from_any_motion_and_hardly_overshot() {
    let mut random = Random(3);
    for round in 0..300 {
        let mut number = |most: f64| ((2.0 * random.next() - 1.0) * most) as f32;
        let velocity = Vector3::new(number(4.0), number(2.5), number(1.0));
        let acceleration = Vector3::new(number(2.0), number(2.0), number(1.0));
        let mut stream = Stream::new(&LIMITS, FASTEST);
        stream.start(&FlatReference { velocity, acceleration, ..FlatReference::standing(Vector3::zeros(), 0.0) });
        let place = Vector3::new(number(20.0), number(20.0), number(8.0));
        let motion = Motion::default().with_position([Some(place.x), Some(place.y), Some(place.z)]);
        let way = place.xy().norm();
        // How far it leaves the place again, once it is near.
        let (mut least, mut again) = (f32::MAX, 0.0_f32);
        for i in 0..5_000 {
            let r = stream.advance(i * 4 + 2, &Sample { motion, at: i / 5 * 20, sent_ms: None });
            let away = (r.position - place).xy().norm();
            if least < f32::MAX || away < 0.5 * way {
                least = math::min(least, away);
                again = math::max(again, away - least);
            }
            assert!(r.velocity.xy().norm() < 1.05 * 5.0 && r.jerk.xy().norm() < 12.0, "{round}: {r:?}");
        }
        let r = stream.reference();
        assert!((r.position - place).norm() < 1e-3 && r.velocity.norm() < 1e-3, "{round}: {r:?}");
        // What cannot be braked before the place is braked behind it.
        let stop = velocity.xy().norm_squared() / 6.0 + velocity.xy().norm() * 0.8;
        assert!(least < 1e-3 && (way < stop + 2.0 || again < 0.02 * way), "{round}: {again} m of {way} m");
    }
}
