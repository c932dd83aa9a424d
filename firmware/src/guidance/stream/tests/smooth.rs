//! Smooth streams: how near the reference is to what was meant, at the same time.

use super::*;
use core::f64::consts::PI;

#[test]
fn circles_are_followed_without_a_lag() {
    // Period, radius, speed; given besides places: velocity, acceleration, clock; bounds of the error, m.
    for (name, clock, velocity, acceleration, bounds) in [
        ("places, clock", true, false, false, [0.02, 0.025]),
        ("places", false, false, false, [0.05, 0.05]),
        ("velocities, clock", true, true, false, [0.01, 0.02]),
        ("velocities", false, true, false, [0.04, 0.04]),
        ("all, clock", true, true, true, [0.01, 0.02]),
        ("all", false, true, true, [0.04, 0.04]),
    ] {
        for (period_s, bound) in [0.020_02, 0.050_03].into_iter().zip(bounds) {
            for (radius, speed) in [(8.0, 8.0), (15.0, 8.0), (15.0, 3.0)] {
                let path = |t: f64| circle(radius, speed, t);
                let link = Link { period_s, velocity, acceleration, clock, ..LINK };
                let flown = link.fly(&mut start_on(path), 20.0, path);
                let (rms, lag, _) = accuracy(&flown, path, 6.0);
                assert!(rms < bound && lag.abs() < 0.01, "{name} {period_s} {radius} {speed}: {rms} m, {lag} s");
            }
        }
    }
}

#[test]
fn jitter_of_the_link_is_removed_by_the_senders_clock_and_smoothed_without() {
    for (period_s, clock, jitter_s, speed, bound) in [
        (0.020_02, true, 0.015, 8.0, 0.03),
        (0.050_03, true, 0.015, 8.0, 0.05),
        (0.050_03, false, 0.015, 3.0, 0.06),
        // The delay of the link, 5 ms in the mean, is not known.
        (0.020_02, false, 0.005, 8.0, 0.06),
        (0.020_02, false, 0.005, 3.0, 0.03),
        (0.050_03, false, 0.010, 3.0, 0.04),
        // Samples overtake each other at the ground partition's jobs, and are lost: the limit of what places alone can tell.
        (0.020_02, false, 0.010, 3.0, 0.8),
    ] {
        let path = |t: f64| circle(15.0, speed, t);
        for seed in 1..4 {
            let link = Link { period_s, clock, jitter_s, seed, ..LINK };
            let (rms, lag, _) = accuracy(&link.fly(&mut start_on(path), 20.0, path), path, 6.0);
            assert!(rms < bound && lag < 0.06, "{period_s} {clock} {jitter_s}: {rms} m, lag {lag} s");
        }
    }
}

#[test]
fn corners_of_a_polygon_are_taken() {
    // A square of 20 m at 3 m/s.
    let path = |t: f64| {
        let (side, along) = (((t * 3.0 / 20.0) as usize) % 4, (t * 3.0) % 20.0);
        let (x, y) = [(along, 0.0), (20.0, along), (20.0 - along, 20.0), (0.0, 20.0 - along)][side];
        [[x, y, 5.0], [0.0; 3], [0.0; 3]]
    };
    for clock in [true, false] {
        let flown = Link { clock, ..LINK }.fly(&mut start_on(path), 26.0, path);
        let worst = flown.iter().filter(|(t, _)| *t > 4.0).map(|(t, r)| error(r, path(*t)[0])).fold(0.0, f64::max);
        // A change of velocity by 4.2 m/s with 3 m/s² takes 3 m, and 0.9 m more with limited jerk.
        assert!(worst < 4.0, "{worst}");
        let before_corners =
            flown.iter().filter(|(t, _)| *t > 4.0 && (t * 3.0) % 20.0 > 17.0).map(|(t, r)| error(r, path(*t)[0]));
        let worst = before_corners.fold(0.0, f64::max);
        assert!(worst < 0.05, "{worst}");
    }
}

#[test]
fn velocities_are_kept_and_reached_without_overshoot() {
    let mut stream = Stream::new(&LIMITS, FASTEST);
    let motion = Motion::default().with_velocity([Some(4.0), Some(-3.0), Some(0.5)]).with_yaw_rate(0.4);
    let mut most = 0.0_f32;
    for i in 0..1_500 {
        let r = stream.advance(i * 4 + 2, &Sample { motion, at: (i / 5 * 20).min(3_000), sent_ms: None });
        most = math::max(most, r.velocity.xy().norm());
        assert!(r.acceleration.xy().norm() < 3.03 && r.jerk.xy().norm() < 10.1, "{r:?}");
    }
    let r = stream.reference();
    assert!(most < 5.05, "{most}");
    assert!((r.velocity - Vector3::new(4.0, -3.0, 0.5)).norm() < 1e-3 && math::abs(r.yaw_rate - 0.4) < 1e-3, "{r:?}");
    // Half way between: nothing given any more.
    for i in 1_500..3_000 {
        stream.advance(i * 4 + 2, &Sample { motion: Motion::default(), at: i / 5 * 20, sent_ms: None });
    }
    let stopped = stream.reference();
    for i in 3_000..10_000 {
        stream.advance(i * 4 + 2, &Sample { motion: Motion::default(), at: i / 5 * 20, sent_ms: None });
    }
    let r = stream.reference();
    assert!((r.position - stopped.position).norm() < 1e-3 && r.velocity.norm() < 1e-4, "{r:?} {stopped:?}");
    assert!(math::abs(r.yaw - stopped.yaw) < 1e-3, "{r:?}");
}

#[test]
fn a_changing_velocity_is_followed_without_a_lag() {
    let mut stream = Stream::new(&LIMITS, FASTEST);
    let truth = |t: f64| 2.0 * (1.5 * t).sin();
    let mut worst = 0.0_f64;
    for i in 0..4_000 {
        let at = i / 5 * 20;
        let motion = Motion::default().with_velocity([Some(truth(f64::from(at) * 1e-3) as f32), Some(0.0), Some(0.0)]);
        let r = stream.advance(i * 4 + 2, &Sample { motion, at, sent_ms: None });
        if i > 500 {
            worst = worst.max((f64::from(r.velocity.x) - truth(f64::from(i * 4 + 2) * 1e-3)).abs());
        }
    }
    // 5 ms of what the arrival times leave open are 15 mm/s.
    assert!(worst < 0.05, "{worst}");
}

#[test]
fn an_acceleration_alone_is_integrated() {
    let mut stream = Stream::new(&LIMITS, FASTEST);
    for i in 0..500 {
        let motion = Motion::default().with_acceleration([Some(1.0), None, None]);
        stream.advance(i * 4 + 2, &Sample { motion, at: i / 5 * 20, sent_ms: None });
    }
    let r = stream.reference();
    assert!(math::abs(r.velocity.x - 2.0) < 0.1 && math::abs(r.acceleration.x - 1.0) < 0.01, "{r:?}");
    assert!(math::abs(r.velocity.y) + math::abs(r.velocity.z) < 1e-6);
}

#[test]
fn a_turning_heading_is_followed_without_a_lag_and_a_far_one_the_shorter_way() {
    for given_rate in [false, true] {
        let mut stream = Stream::new(&LIMITS, FASTEST);
        let truth = |t: f64| 0.7 * t;
        for i in 0..5_000 {
            let at = i / 5 * 20;
            let mut motion = Motion::default().with_yaw((truth(f64::from(at) * 1e-3 - 0.005) % (2.0 * PI)) as f32);
            if given_rate {
                motion = motion.with_yaw_rate(0.7);
            }
            let r = stream.advance(i * 4 + 2, &Sample { motion, at, sent_ms: None });
            let t = f64::from(i * 4 + 2) * 1e-3;
            let wrong = (f64::from(r.yaw) - truth(t)).rem_euclid(2.0 * PI);
            assert!(i < 750 || wrong.min(2.0 * PI - wrong) < 0.003, "{t}: {wrong}");
        }
    }
    let mut stream = Stream::new(&LIMITS, FASTEST);
    stream.start(&FlatReference::standing(Vector3::zeros(), 3.0));
    for i in 0..1_000 {
        let r = stream.advance(i * 4 + 2, &Sample { motion: Motion::default().with_yaw(-3.0), at: 0, sent_ms: None });
        assert!(math::abs(r.yaw) > 2.9, "{}", r.yaw);
    }
}

#[test]
fn a_target_at_the_greatest_speed_keeps_its_turn() {
    for (radius, seed) in [(30.0, 1), (30.0, 2), (20.0, 3)] {
        let path = |t| circle(radius, 12.0, t);
        let flown = Link { seed, ..LINK }.fly(&mut start_on(path), 30.0, path);
        // It is caught up with at a fiftieth of its speed.
        let (rms, _, _) = accuracy(&flown, path, 8.0);
        assert!(rms < 0.1, "{radius}: {rms} m");
    }
}

#[test]
fn a_clock_of_another_rate_is_found_out() {
    for rate in [0.33, 0.5, 0.9, 1.1, 2.0] {
        let path = |t| circle(10.0, 4.0, t);
        let mut samples = LINK.samples(40.0, path);
        for (_, sample) in &mut samples {
            sample.sent_ms = Some((f64::from(sample.at) * rate) as u32 + 5_000);
        }
        let flown = fly(&samples, &mut start_on(path), 40.0);
        let (rms, _, _) = accuracy(&flown, path, 10.0);
        assert!(rms < 0.1, "{rate}: {rms} m");
    }
}

#[test]
fn a_stream_without_a_clock_that_becomes_slower_or_faster_is_followed_on() {
    for (before_s, after_s) in [(0.02, 0.05), (0.02, 0.1), (0.02, 0.01), (0.05, 0.02), (0.1, 0.02)] {
        let path = |t| circle(10.0, 3.0, t);
        let mut samples = Link { period_s: before_s, ..LINK }.samples(10.0, path);
        let later = Link { period_s: after_s, phase_s: 0.0051, ..LINK }.samples(30.0, path);
        samples.extend(later.into_iter().filter(|(seen, _)| *seen > 10_030));
        let flown = fly(&samples, &mut start_on(path), 30.0);
        let (rms, _, _) = accuracy(&flown, path, 15.0);
        assert!(rms < 0.1, "{before_s} {after_s}: {rms} m");
    }
}
