//! Properties of the reference generator: limits, continuity, straight lines, no overshoot, arrival time.

use nalgebra::Vector3;
use proptest::prelude::*;

use super::*;
use crate::guidance::{Guidance, Trajectory};

pub(in crate::guidance) const LIMITS: ModeSettings = ModeSettings {
    cruise_m_s: 5.0,
    fastest_m_s: 5.0,
    climb_m_s: 2.0,
    sink_m_s: 1.5,
    acceleration_m_s2: 3.0,
    vertical_acceleration_m_s2: 2.0,
    jerk_m_s3: 10.0,
    yaw_rate_rad_s: 1.0,
    yaw_acceleration_rad_s2: 2.0,
    take_off_m_s: 1.5,
    landing_m_s: 0.7,
    touchdown_m_s: 0.4,
    descent_m_s: 1.0,
    return_height_m: 10.0,
    battery_low_v: 0.0,
    battery_critical_v: 0.0,
    idle_part: 0.1,
    blind_thrust_part: 0.93,
};

fn standing(position: [f32; 3]) -> Setpoint {
    let mut setpoint = Setpoint::new(&LIMITS);
    setpoint.start(&FlatReference::standing(position.into(), 0.0));
    setpoint
}

fn place(position: [f32; 3], yaw: f32) -> Target {
    Target::Place { position: position.into(), yaw: Some(yaw), speeds: Speeds::usual(&LIMITS) }
}

fn steps(seconds: f32) -> usize {
    (seconds / STEP_S + 0.5) as usize
}

fn horizontal(v: &Vector3<f32>) -> f32 {
    v.xy().norm()
}

/// Checks the limits, with 1 % for rounding. They hold for references that begin within them.
fn assert_within_limits(r: &FlatReference) {
    let most = |value: f32, limit: f32, name: &str| assert!(value <= 1.01 * limit + 1e-5, "{name}: {value}");
    most(horizontal(&r.velocity), LIMITS.cruise_m_s, "speed");
    most(r.velocity.z, LIMITS.climb_m_s, "climb");
    most(-r.velocity.z, LIMITS.sink_m_s, "sink");
    most(horizontal(&r.acceleration), LIMITS.acceleration_m_s2, "acceleration");
    most(math::abs(r.acceleration.z), LIMITS.vertical_acceleration_m_s2, "vertical acceleration");
    most(horizontal(&r.jerk), LIMITS.jerk_m_s3, "jerk");
    most(math::abs(r.jerk.z), LIMITS.jerk_m_s3, "vertical jerk");
    most(math::abs(r.yaw_rate), LIMITS.yaw_rate_rad_s, "yaw rate");
    most(math::abs(r.yaw_acceleration), LIMITS.yaw_acceleration_rad_s2, "yaw acceleration");
}

/// Checks that each derivative integrates to the previous one over a step.
fn assert_continuous(before: &FlatReference, after: &FlatReference) {
    let way = before.velocity * STEP_S + before.acceleration * (0.5 * STEP_S * STEP_S);
    // Truncation over a step, and the resolution of f32 at 100 m.
    assert!((after.position - before.position - way).norm() < 8e-5, "position: {before:?} {after:?}");
    let faster = after.velocity - before.velocity - before.acceleration * STEP_S;
    assert!(faster.norm() < 2e-5, "velocity: {faster}");
    let change = after.acceleration - before.acceleration - before.jerk * STEP_S;
    assert!(change.norm() < 4e-5, "acceleration: {change}");
    // The snap jumps, within ±2 a (h/τ's second derivative); the jerk is continuous.
    let jerk = (after.jerk - before.jerk).norm();
    assert!(jerk < 0.07 * LIMITS.jerk_m_s3, "jerk: {jerk}");
    let turned = math::wrap_angle(after.yaw - before.yaw);
    let wanted = before.yaw_rate * STEP_S + before.yaw_acceleration * (0.5 * STEP_S * STEP_S);
    assert!(math::abs(turned - wanted) < 5e-5, "yaw: {turned} for {wanted}");
}

/// Shortest time from rest to rest over a distance with limited speed, acceleration and jerk, s.
fn fastest(distance: f32, v: f32, a: f32, j: f32) -> f32 {
    if distance >= v * (v / a + a / j) {
        distance / v + v / a + a / j
    } else if distance >= 2.0 * a * a * a / (j * j) {
        a / j + math::sqrt((a / j) * (a / j) + 4.0 * distance / a)
    } else {
        let cube = f64::from(32.0 * distance / j).cbrt();
        cube as f32
    }
}

#[test]
fn it_arrives_without_overshoot_in_nearly_the_shortest_time() {
    for (distance, factor) in [(0.5, 1.75), (2.0, 1.5), (5.0, 1.4), (20.0, 1.25), (100.0, 1.1)] {
        let mut setpoint = standing([0.0; 3]);
        let mut arrival = None;
        for step in 0..steps(60.0) {
            let r = setpoint.advance(&place([distance, 0.0, 0.0], 0.0));
            assert!(r.position.x <= distance * 1.000_1, "overshoot at {distance}: {}", r.position.x);
            if r.position.x >= 0.98 * distance {
                arrival = arrival.or(Some(step as f32 * STEP_S));
            }
        }
        let (arrival, ideal) = (arrival.expect("arrives"), fastest(distance, 5.0, 3.0, 10.0));
        assert!(arrival < factor * ideal, "{distance} m in {arrival} s, not {ideal}");
        let r = setpoint.reference();
        assert!(math::abs(r.position.x - distance) < 1e-4 && r.velocity.norm() < 1e-6, "{r:?}");
    }
}

#[test]
fn a_move_from_rest_is_a_straight_line_within_the_limits() {
    for to in [[30.0, 20.0, 5.0], [-3.0, 1.0, -4.0], [0.0, 0.0, 20.0], [8.0, -8.0, 0.0]] {
        let from = Vector3::new(1.0, 2.0, 10.0);
        let mut setpoint = standing(from.into());
        let direction = (Vector3::from(to) - from).normalize();
        let mut before = setpoint.reference();
        for _ in 0..steps(40.0) {
            let r = setpoint.advance(&place(to, 1.0));
            assert_within_limits(&r);
            assert_continuous(&before, &r);
            let way = r.position - from;
            assert!((way - direction * way.dot(&direction)).norm() < 5e-4, "{way}");
            before = r;
        }
        assert!((before.position - Vector3::from(to)).norm() < 1e-3 && math::abs(before.yaw - 1.0) < 1e-4);
    }
}

#[test]
fn it_brakes_where_the_limits_allow_and_stays_there() {
    let mut setpoint = standing([0.0, 0.0, 5.0]);
    let go = Target::Velocity { velocity: Vector3::new(9.0, 0.0, 0.0), yaw_rate: 0.5 };
    let stop = Target::Velocity { velocity: Vector3::zeros(), yaw_rate: 0.0 };
    for _ in 0..steps(6.0) {
        setpoint.advance(&go);
    }
    let moving = setpoint.reference();
    assert!(math::abs(moving.velocity.x - 5.0) < 1e-3, "the limit, not the commanded 9 m/s");
    for _ in 0..steps(6.0) {
        assert_within_limits(&setpoint.advance(&stop));
    }
    let stopped = setpoint.reference();
    // v²/2a, and the distance flown within the filter's lag.
    let way = stopped.position.x - moving.position.x;
    assert!((25.0 / 6.0..25.0 / 6.0 + 2.5 + 0.1).contains(&way), "{way}");
    assert!(stopped.velocity.norm() < 1e-4 && math::abs(stopped.yaw_rate) < 1e-4);
    for _ in 0..steps(60.0) {
        setpoint.advance(&stop);
    }
    assert!((setpoint.reference().position - stopped.position).norm() < 1e-3);
}

#[test]
fn it_continues_from_a_trajectory_without_a_jump() {
    let slow =
        Trajectory::FigureEight { center_m: [0.0, 0.0, 5.0], amplitude_m: [2.0, 1.0], rate_rad_s: 0.8, yaw_rad: 3.0 };
    for trajectory in [slow, Trajectory::PAPER_HELIX] {
        let guidance = Guidance::new(trajectory, None, Vector3::zeros()).expect("valid");
        let from = guidance.at(3_000);
        let mut setpoint = Setpoint::new(&LIMITS);
        setpoint.start(&from);
        let start = setpoint.reference();
        assert!((start.position - from.position).norm() < 1e-5 && (start.velocity - from.velocity).norm() < 1e-5);
        assert!((start.acceleration - from.acceleration).norm() < 1e-4, "{}", start.acceleration);
        assert!((start.jerk - from.jerk).norm() < 1e-3 && (start.snap - from.snap).norm() < 0.05);
        let mut before = start;
        for _ in 0..steps(8.0) {
            let r = setpoint.advance(&Target::Velocity { velocity: Vector3::zeros(), yaw_rate: 0.0 });
            assert_continuous(&before, &r);
            before = r;
        }
        assert!(before.velocity.norm() < 1e-3 && (before.position - from.position).norm() < 12.0);
    }
}

#[test]
fn the_heading_turns_the_shorter_way() {
    let mut setpoint = Setpoint::new(&LIMITS);
    setpoint.start(&FlatReference::standing(Vector3::zeros(), 3.0));
    for _ in 0..steps(3.0) {
        let r = setpoint.advance(&place([0.0; 3], -3.0));
        assert!(math::abs(r.yaw) > 2.9, "{}", r.yaw);
    }
    assert!(math::abs(setpoint.reference().yaw + 3.0) < 1e-4);
}

#[test]
fn a_climb_keeps_its_commanded_speed_and_stops_horizontally() {
    let mut setpoint = standing([0.0; 3]);
    for _ in 0..steps(3.0) {
        setpoint.advance(&Target::Velocity { velocity: Vector3::new(3.0, 0.0, 0.0), yaw_rate: 0.0 });
    }
    for _ in 0..steps(15.0) {
        let r = setpoint.advance(&Target::Height { height_m: 6.0, speed_m_s: 0.8, yaw: None });
        assert!(r.velocity.z < 0.81 && r.position.z < 6.000_1);
        assert_within_limits(&r);
    }
    let r = setpoint.reference();
    assert!(math::abs(r.position.z - 6.0) < 1e-4 && r.velocity.norm() < 1e-4);
}

#[test]
fn a_shift_of_position_keeps_the_motion() {
    let mut setpoint = standing([0.0; 3]);
    for _ in 0..steps(1.0) {
        setpoint.advance(&Target::Velocity { velocity: Vector3::new(3.0, 0.0, -1.0), yaw_rate: 0.0 });
    }
    let before = setpoint.reference();
    setpoint.put_horizontally(10.0, 20.0);
    setpoint.put_vertically(30.0);
    let after = setpoint.reference();
    assert!((after.position - Vector3::new(10.0, 20.0, 30.0)).norm() < 1e-5);
    assert_eq!(FlatReference { position: before.position, ..after }, before);
}

#[test]
fn slow_motion_goes_on_far_from_the_origin() {
    // 9 km away an f32 resolves 1 mm, more than the way of a step.
    let far = Vector3::new(9_000.0, -9_000.0, 9_000.0);
    let slow = Vector3::new(0.1, -0.07, 0.05);
    let mut setpoint = standing(far.into());
    for _ in 0..steps(100.0) {
        setpoint.advance(&Target::Velocity { velocity: slow, yaw_rate: 0.0 });
    }
    let r = setpoint.reference();
    // Less the lags' delay of 3τ and the time of acceleration.
    let way = r.position - far;
    assert!((way - slow * 99.5).norm() < 0.06, "{way}");
    assert!((r.velocity - slow).norm() < 1e-4, "{}", r.velocity);
    for _ in 0..steps(60.0) {
        setpoint.advance(&place(far.into(), 0.0));
    }
    assert!((setpoint.reference().position - far).norm() < 2e-3);
}

#[test]
fn a_long_way_passes_the_anchors_without_a_jump() {
    let mut setpoint = standing([100.0, 0.0, 0.0]);
    let mut before = setpoint.reference();
    for _ in 0..steps(200.0) {
        let r = setpoint.advance(&place([-400.0, 300.0, 150.0], 0.0));
        let way = before.velocity * STEP_S + before.acceleration * (0.5 * STEP_S * STEP_S);
        assert!((r.position - before.position - way).norm() < 2e-4, "{before:?} {r:?}");
        before = r;
    }
    assert!((before.position - Vector3::new(-400.0, 300.0, 150.0)).norm() < 1e-3, "{before:?}");
}

fn any_target() -> impl Strategy<Value = Target> {
    let place = (-50.0..50.0_f32, -50.0..50.0_f32, 0.0..50.0_f32, -3.0..3.0_f32)
        .prop_map(|(x, y, z, yaw)| place([x, y, z], yaw));
    let velocity = (-8.0..8.0_f32, -8.0..8.0_f32, -3.0..3.0_f32, -2.0..2.0_f32)
        .prop_map(|(x, y, z, yaw_rate)| Target::Velocity { velocity: Vector3::new(x, y, z), yaw_rate });
    let height = (0.0..50.0_f32, 0.1..3.0_f32).prop_map(|(height_m, speed_m_s)| Target::Height {
        height_m,
        speed_m_s,
        yaw: None,
    });
    prop_oneof![place, velocity, height]
}

proptest! {
    #[test]
    fn limits_and_continuity_hold_whatever_is_asked_for(
        targets in prop::collection::vec((any_target(), 1..1500_usize), 1..12),
    ) {
        let mut setpoint = standing([0.0, 0.0, 10.0]);
        let mut before = setpoint.reference();
        for (target, count) in targets {
            for _ in 0..count {
                let r = setpoint.advance(&target);
                assert_within_limits(&r);
                assert_continuous(&before, &r);
                before = r;
            }
        }
    }

    #[test]
    fn from_any_motion_a_place_is_reached_and_stayed_at(
        before in any_target(), lasting in 1..1500_usize, x in -30.0..30.0_f32, y in -30.0..30.0_f32, z in 0.0..30.0_f32,
    ) {
        let mut setpoint = standing([0.0, 0.0, 10.0]);
        for _ in 0..lasting {
            setpoint.advance(&before);
        }
        for _ in 0..steps(90.0) {
            setpoint.advance(&place([x, y, z], 0.0));
        }
        let r = setpoint.reference();
        prop_assert!((r.position - Vector3::new(x, y, z)).norm() < 1e-3, "{:?}", r);
        prop_assert!(r.velocity.norm() < 1e-5);
    }
}
