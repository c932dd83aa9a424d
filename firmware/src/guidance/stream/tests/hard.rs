//! What a stream should not be: random, silent, repeated, with a broken clock, far away.

use super::*;
use proptest::prelude::*;

/// Checks that each derivative integrates to the one before: exactly, for the jerk goes linearly in a step.
fn assert_integrates(before: &FlatReference, after: &FlatReference) {
    const H: f32 = STEP_S;
    let s = &after.snap;
    let (p, v, a, j) = (&before.position, &before.velocity, &before.acceleration, &before.jerk);
    let close = |name, value: Vector3<f32>, expected: Vector3<f32>, size: f32, grain: f32| {
        assert!((value - expected).amax() <= 1e-6 * size + grain, "{name}: {value} {expected} {before:?} {after:?}");
    };
    close("jerk", after.jerk, j + s * H, j.amax() + s.amax() * H, 1e-6);
    close("acceleration", after.acceleration, a + (j + s * (H / 2.0)) * H, a.amax() + j.amax(), 1e-6);
    close("velocity", after.velocity, v + (a + (j + s * (H / 3.0)) * (H / 2.0)) * H, v.amax() + a.amax(), 1e-6);
    let way = (v + (a + (j + s * (H / 4.0)) * (H / 3.0)) * (H / 2.0)) * H;
    // Within the anchor's distance and in the world.
    close("position", after.position, p + way, p.amax(), 2e-5);
    let turned = math::wrap_angle(after.yaw - before.yaw) - before.yaw_rate * H;
    assert!(math::abs(turned - 0.5 * before.yaw_acceleration * H * H) < 3e-5, "yaw: {turned}");
    assert!(math::abs(after.yaw_acceleration - before.yaw_acceleration) < 0.2, "{before:?} {after:?}");
}

/// What a reference may be faster than the fastest, m/s, beside a tenth of the speed over the ground and 5 % of the vertical one.
const SLACK: f32 = 0.8;

/// Checks that a reference is one of a vehicle that can be flown, whatever was asked for.
fn assert_sane(r: &FlatReference) {
    assert!(r.velocity.xy().norm() < 1.1 * FASTEST.speed_m_s + SLACK, "{r:?}");
    assert!(r.velocity.z < 1.05 * LIMITS.climb_m_s + SLACK && r.velocity.z > -1.05 * LIMITS.sink_m_s - SLACK, "{r:?}");
    assert!(r.acceleration.xy().norm() < 1.5 * FASTEST.acceleration_m_s2, "{r:?}");
    assert!(r.jerk.amax() <= 2.0 * 50.5, "{r:?}");
    assert!(math::abs(r.yaw_rate) < 1.5 && math::abs(r.yaw_acceleration) < 5.0, "{r:?}");
}

fn any_motion(size: f32) -> impl Strategy<Value = Motion> {
    let axes = move |size: f32| {
        let axis = prop::option::of(-size..size);
        (axis.clone(), axis.clone(), axis).prop_map(|(x, y, z)| [x, y, z])
    };
    let yaw = (prop::option::of(-10.0..10.0_f32), prop::option::of(-3.0..3.0_f32));
    (axes(50.0 * size), axes(20.0 * size), axes(8.0 * size), yaw).prop_map(|(p, v, a, (yaw, rate))| {
        let motion = Motion::default().with_position(p).with_velocity(v).with_acceleration(a);
        let motion = yaw.map_or(motion, |yaw| motion.with_yaw(yaw));
        rate.map_or(motion, |rate| motion.with_yaw_rate(rate))
    })
}

proptest! {
    #[test]
    fn it_is_continuous_to_the_jerk_whatever_is_asked_for(
        parts in prop::collection::vec((any_motion(1.0), 1..400_u32, 1..40_u32, prop::option::of(0..100_000_u32)), 1..10),
    ) {
        let mut stream = Stream::new(&LIMITS, FASTEST);
        stream.start(&FlatReference::standing(Vector3::new(10.0, 20.0, 30.0), 1.0));
        let mut before = stream.reference();
        let mut now = 2;
        for (motion, steps, every, sent_ms) in parts {
            for i in 0..steps {
                let at = now - 2 - i % every * 4;
                let sent_ms = sent_ms.map(|begin| begin + i);
                let r = stream.advance(now, &Sample { motion, at, sent_ms });
                assert_integrates(&before, &r);
                assert_sane(&r);
                before = r;
                now += 4;
            }
        }
    }

    #[test]
    fn it_is_finite_for_any_finite_numbers(
        motions in prop::collection::vec((any_motion(1e36), any_motion(1e4)), 1..20), every in 1..20_u32,
    ) {
        let mut stream = Stream::new(&LIMITS, FASTEST);
        let mut now = 2;
        for motion in motions.iter().flat_map(|(huge, large)| [huge, large]) {
            for _ in 0..every {
                let r = stream.advance(now, &Sample { motion: *motion, at: now, sent_ms: Some(now) });
                assert!(r.position.iter().all(|x| x.is_finite()) && r.yaw.is_finite());
                assert_sane(&r);
                now += 4;
            }
        }
    }
}

#[test]
fn it_continues_from_a_moving_reference_and_within_other_limits() {
    let from = FlatReference {
        position: Vector3::new(300.0, -200.0, 50.0),
        velocity: Vector3::new(4.0, -2.0, 1.0),
        acceleration: Vector3::new(-2.0, 1.0, 0.5),
        jerk: Vector3::new(5.0, -3.0, 1.0),
        snap: Vector3::new(1.0, 2.0, 3.0),
        yaw: 3.1,
        yaw_rate: 0.5,
        yaw_acceleration: 0.4,
    };
    let mut stream = Stream::new(&LIMITS, FASTEST);
    stream.start(&from);
    assert_eq!(stream.reference(), from);
    let mut before = from;
    for i in 0..3_000 {
        if i % 300 == 299 {
            let slower = 0.3 + 0.1 * (i / 300) as f32;
            stream.limit(&ModeSettings { cruise_m_s: 5.0 * slower, jerk_m_s3: 10.0 * slower, ..LIMITS }, FASTEST);
            assert_eq!(stream.reference(), before);
        }
        let motion = Motion::default().with_position([Some(320.0), Some(-180.0), Some(55.0)]);
        let r = stream.advance(i * 4 + 2, &Sample { motion, at: i / 5 * 20, sent_ms: None });
        assert_integrates(&before, &r);
        before = r;
    }
}

#[test]
fn every_change_of_what_is_given_is_without_a_jump() {
    let place = Motion::default().with_position([Some(10.0), Some(0.0), Some(5.0)]);
    let both = place.with_velocity([Some(1.0), Some(1.0), Some(0.0)]);
    let velocity = Motion::default().with_velocity([Some(3.0), Some(-1.0), Some(0.5)]).with_yaw_rate(0.5);
    let height = Motion::default().with_velocity([Some(1.0), Some(0.0), None]).with_position([None, None, Some(8.0)]);
    let push = Motion::default().with_acceleration([Some(1.0), Some(0.0), None]).with_yaw(2.0);
    let kinds = [place, both, velocity, height, push, Motion::default()];
    for (first, second) in kinds.iter().flat_map(|first| kinds.iter().map(move |second| (first, second))) {
        let mut stream = Stream::new(&LIMITS, FASTEST);
        let mut before = stream.reference();
        for i in 0..1_000 {
            let motion = *if i < 400 { first } else { second };
            let r = stream.advance(i * 4 + 2, &Sample { motion, at: i / 5 * 20, sent_ms: None });
            assert_integrates(&before, &r);
            assert!(r.velocity.xy().norm() < 8.0 && r.acceleration.xy().norm() < 4.1, "{first:?} {second:?} {r:?}");
            before = r;
        }
    }
}

/// A stream of places along a line, 3 m/s.
fn line(t: f64) -> [[f64; 3]; 3] {
    [[3.0 * t, 0.0, 5.0], [3.0, 0.0, 0.0], [0.0; 3]]
}

#[test]
fn a_stream_that_falls_silent_goes_on_for_a_moment_and_brakes() {
    for velocity in [false, true] {
        let link = Link { velocity, ..LINK };
        let samples = link.samples(4.0, line);
        let mut stream = start_on(line);
        let mut fastest_back = 0.0_f32;
        for step in 2..3_000 {
            let now = step * 4 + 2;
            let sample = samples.iter().rev().find(|(seen, _)| *seen <= now - 2);
            if let Some((_, sample)) = sample {
                fastest_back = math::min(fastest_back, stream.advance(now, sample).velocity.x);
            }
        }
        let r = stream.reference();
        // 12 m, 0.25 s at 3 m/s, and v²/2a with 0.7 a, which ends gently.
        assert!((12.0..12.0 + 0.75 + 2.2 + 0.1).contains(&r.position.x) && r.velocity.norm() < 1e-3, "{r:?}");
        assert!(fastest_back > -0.3, "{fastest_back}");
    }
}

#[test]
fn a_stream_that_stops_is_not_extrapolated() {
    let path = |t: f64| line(t.min(4.0));
    let flown = LINK.fly(&mut start_on(path), 12.0, |t| [path(t)[0], [0.0; 3], [0.0; 3]]);
    let most = flown.iter().map(|(_, r)| r.position.x).fold(0.0, math::max);
    // 3 m/s need 1.5 m and, with limited jerk, 0.45 m more; known after two samples and their way.
    assert!(most < 12.0 + 1.5 + 0.45 + 0.3, "{most}");
    assert!(error(&flown.last().expect("some").1, path(9.0)[0]) < 1e-3);
}

/// What becomes of the sender's time, ms.
type Broken = fn(u32) -> Option<u32>;

#[test]
fn repeated_samples_and_broken_clocks_do_no_harm() {
    let path = |t: f64| circle(15.0, 3.0, t);
    let broken: [(&str, Broken); 7] = [
        ("constant", |_| Some(5)),
        ("zero", |_| Some(0)),
        ("back now and then", |ms| Some(if ms / 1_000 % 3 == 0 { ms } else { ms + 40_000 })),
        ("ten times as fast", |ms| Some(ms * 10)),
        ("random", |ms| Some(ms.wrapping_mul(2_654_435_761))),
        ("wraps", |ms| Some(ms.wrapping_sub(80_000))),
        ("comes and goes", |ms| (ms / 500 % 2 == 0).then_some(ms)),
    ];
    for (name, clock) in broken {
        let mut stream = start_on(path);
        let mut samples = Vec::new();
        for (seen, sample) in (Link { clock: true, ..LINK }).samples(20.0, path) {
            let sample = Sample { sent_ms: sample.sent_ms.and_then(clock), ..sample };
            samples.extend([(seen, sample), (seen + 10, Sample { at: sample.at + 10, ..sample })]);
        }
        let flown = fly(&samples, &mut stream, 20.0);
        let (rms, lag, _) = accuracy(&flown, path, 6.0);
        assert!(rms < 0.07, "{name}: {rms} m, lag {lag} s");
    }
}

#[test]
fn a_rotation_of_the_stream_rotates_the_reference() {
    let (s, c) = (0.6_f64, 0.8_f64);
    let turn = |[x, y, z]: [f64; 3]| [c * x - s * y, s * x + c * y, z];
    let path = |t: f64| {
        let [p, v, a] = circle(6.0, 3.0, t);
        if t < 5.0 { [p, v, a] } else { [[10.0, -7.0, 5.0], [0.0; 3], [0.0; 3]] }
    };
    let turned = |t: f64| path(t).map(turn);
    let one = LINK.fly(&mut start_on(path), 12.0, path);
    let other = LINK.fly(&mut start_on(turned), 12.0, turned);
    for ((t, one), (_, other)) in one.iter().zip(&other) {
        let expected = turn([one.position.x, one.position.y, one.position.z].map(f64::from));
        assert!(error(other, expected) < 2e-3, "{t}: {}", error(other, expected));
    }
}

#[test]
fn slow_motion_goes_on_far_from_the_origin() {
    let far = [9_000.0, -9_000.0, 3_000.0];
    let path = move |t: f64| [[far[0] + 0.1 * t, far[1] - 0.07 * t, far[2]], [0.1, -0.07, 0.0], [0.0; 3]];
    for velocity in [true, false] {
        let flown = Link { velocity, clock: true, ..LINK }.fly(&mut start_on(path), 60.0, path);
        let (rms, _, _) = accuracy(&flown, path, 5.0);
        // An f32 resolves 1 mm there.
        assert!(rms < 0.003, "{rms}");
        let fastest = flown.iter().filter(|(t, _)| *t > 5.0).map(|(_, r)| r.velocity.norm()).fold(0.0, math::max);
        assert!(fastest < if velocity { 0.125 } else { 0.2 }, "{fastest}");
    }
}

#[test]
fn a_stream_is_small() {
    assert!(size_of::<Motion>() == 48 && size_of::<Stream>() < 1_024, "{} bytes", size_of::<Stream>());
}

/// Places that stand still and a speed that says otherwise, as a script that counts in another unit sends, with silences in
/// which the target brakes by itself.
#[test]
fn a_speed_that_contradicts_the_places_does_no_harm_after_a_silence() {
    let motion = Motion::default().with_position([Some(0.0), None, None]).with_velocity([Some(-12.7), None, None]);
    for every in [60, 252, 300, 400, 900] {
        let mut stream = Stream::new(&LIMITS, FASTEST);
        stream.start(&FlatReference::standing(Vector3::new(10.0, 20.0, 30.0), 1.0));
        for now in (2..60_000).step_by(4) {
            let r = stream.advance(now, &Sample { motion, at: now - 2 - (now - 2) % every, sent_ms: None });
            assert_sane(&r);
            assert!(r.position.xy().norm() < 60.0, "{every}: {r:?}");
        }
    }
}

#[test]
fn a_target_is_followed_as_far_as_a_vehicle_could() {
    // 12 m/s on a radius of 9 m have 16 m/s², and 10 are allowed.
    let path = |t: f64| circle(9.0, 12.0, t);
    let link = Link { velocity: true, acceleration: true, ..LINK };
    let (mut fastest, mut strongest) = (0.0_f32, 0.0_f32);
    for (t, r) in link.fly(&mut Stream::new(&LIMITS, FASTEST), 20.0, path) {
        if t > 2.0 {
            fastest = math::max(fastest, r.velocity.xy().norm());
            strongest = math::max(strongest, r.acceleration.xy().norm());
        }
    }
    assert!((11.0..1.1 * FASTEST.speed_m_s + SLACK).contains(&fastest), "{fastest} m/s");
    assert!((0.9..1.05).contains(&(strongest / FASTEST.acceleration_m_s2)), "{strongest} m/s²");
    // A velocity alone, and a place that moves with one.
    let velocity = Motion::default().with_velocity([Some(20.0), Some(0.0), None]);
    let mut stream = Stream::new(&LIMITS, FASTEST);
    for i in 0..2_500 {
        let at = i / 5 * 20;
        stream.advance(i * 4 + 2, &Sample { motion: velocity, at, sent_ms: Some(at) });
    }
    assert!(math::abs(stream.reference().velocity.x - 12.0) < 0.05, "{}", stream.reference().velocity);
    let line = |t: f64| [[13.5 * t, 0.0, 5.0], [0.0; 3], [0.0; 3]];
    let (_, r) = *Link { clock: true, ..LINK }.fly(&mut start_on(line), 20.0, line).last().expect("some");
    assert!((11.9..12.3).contains(&r.velocity.x), "{}", r.velocity);
}

#[test]
fn samples_that_are_overtaken_change_nothing() {
    let path = |t: f64| circle(15.0, 6.0, t);
    let samples = Link { clock: true, ..LINK }.samples(20.0, path);
    // Each fifth comes once more, 40 ms late.
    let mut overtaken = samples.clone();
    for (seen, sample) in samples.iter().step_by(5) {
        overtaken.push((seen + 40, Sample { at: sample.at + 40, ..*sample }));
    }
    overtaken.sort_by_key(|(seen, sample)| (*seen, sample.at, sample.sent_ms));
    let flown = [&samples, &overtaken].map(|samples| fly(samples, &mut start_on(path), 20.0));
    let farthest = flown[0].iter().zip(&flown[1]).filter(|((t, _), _)| *t > 3.0);
    let farthest = farthest.map(|((_, a), (_, b))| (a.position - b.position).norm()).fold(0.0, math::max);
    assert!(farthest < 0.01, "{farthest} m");
}
