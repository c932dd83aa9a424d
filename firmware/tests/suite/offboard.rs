//! Flights by streamed set-points.

use firmware::commander::{Goal, ManualMode, Mode, Request};
use firmware::config::FlightConfig;
use firmware::guidance::stream::Motion;
use firmware::latest::{AttitudeSetPoint, SetPoint, Stamped, Sticks};
use firmware::math;
use firmware::outer::OuterOutput;
use firmware::signals::TICK_S;
use nalgebra::{UnitQuaternion, Vector3};

use crate::vehicle::{Vehicle, config};

/// Thrust to weight is 2, and yaw has some torque.
fn agile() -> FlightConfig {
    let mut config = config();
    config.airframe.rotor_inertia_kg_m2 = 0.0;
    for (gains, (lambda, gain)) in config.attitude.axes.iter_mut().zip([(15.0, 60.0), (15.0, 60.0), (6.0, 10.0)]) {
        (gains.lambda, gains.gain) = (lambda, gain);
    }
    config
}

fn position([x, y, z]: [f32; 3], yaw: f32) -> SetPoint {
    let motion = Motion::default().with_position([Some(x), Some(y), Some(z)]).with_yaw(yaw);
    SetPoint::Motion { motion, sent_ms: None }
}

fn velocity([x, y, z]: [f32; 3]) -> SetPoint {
    SetPoint::Motion { motion: Motion::default().with_velocity([Some(x), Some(y), Some(z)]), sent_ms: None }
}

/// Streams set-points at 50 Hz for a time, each made at its time (s); they are seen 10 ms later, as from the link.
fn stream(vehicle: &mut Vehicle, seconds: f32, make: impl Fn(f32) -> SetPoint) {
    stream_while(vehicle, seconds, make, |_, _| {});
}

fn stream_while(
    vehicle: &mut Vehicle,
    seconds: f32,
    make: impl Fn(f32) -> SetPoint,
    mut look: impl FnMut(f32, &Vehicle),
) {
    let start = vehicle.tick;
    let mut waiting = None;
    while vehicle.tick - start < (seconds / TICK_S) as u32 {
        let since = vehicle.tick - start;
        let t = since as f32 * TICK_S;
        if since.is_multiple_of(20) {
            let mut value = make(t);
            if let SetPoint::Motion { sent_ms, .. } = &mut value {
                *sent_ms = Some(vehicle.tick + 5_000);
            }
            waiting = Some(Stamped { value, at: vehicle.tick });
        }
        if since % 20 == 10 {
            vehicle.latest.setpoint = waiting;
        }
        vehicle.tick();
        look(t, vehicle);
    }
}

/// In offboard mode, holding 4 m over the ground.
fn offboard(config: &FlightConfig) -> Vehicle {
    let mut vehicle = Vehicle::airborne(config);
    stream(&mut vehicle, 0.5, |_| position([0.0, 0.0, 4.0], 0.0));
    vehicle.ask(Request::Offboard);
    stream(&mut vehicle, 0.5, |_| position([0.0, 0.0, 4.0], 0.0));
    assert_eq!(vehicle.told.mode, Mode::Offboard);
    vehicle
}

#[test]
fn it_takes_off_goes_to_five_set_points_and_lands_by_the_stream_alone() {
    let mut vehicle = Vehicle::new(&agile());
    stream(&mut vehicle, 0.2, |_| position([0.0; 3], 0.0));
    vehicle.ask(Request::Offboard);
    vehicle.ask(Request::Arm { force: false });
    stream(&mut vehicle, 1.0, |_| position([0.0; 3], 0.0));
    assert_eq!((vehicle.told.mode, vehicle.told.armed), (Mode::Idle, true), "a set-point on the ground lifts nothing");
    // PX4's test, at half its tolerance: 0.15 m within 10 s.
    for place in [[0.0, 0.0, 3.0], [0.0, 5.0, 3.0], [5.0, 5.0, 3.0], [5.0, 0.0, 3.0], [0.0, 0.0, 3.0]] {
        stream(&mut vehicle, 10.0, |_| position(place, 0.0));
        vehicle.assert_near(place, 0.15);
        assert_eq!(vehicle.told.mode, Mode::Offboard);
    }
    stream(&mut vehicle, 6.0, |_| velocity([0.0, 0.0, -0.6]));
    stream(&mut vehicle, 3.0, |_| velocity([0.0, 0.0, -0.6]));
    assert!(!vehicle.told.armed && vehicle.body.nav.position.z == 0.0, "{:?}", vehicle.told.mode);
    assert_eq!(vehicle.told.shown, Mode::Offboard);
}

#[test]
fn offboard_needs_a_stream_and_its_loss_is_answered() {
    let mut vehicle = Vehicle::airborne(&agile());
    vehicle.ask(Request::Offboard);
    vehicle.run(0.1);
    assert_eq!(vehicle.told.mode, Mode::Hold);
    let mut vehicle = offboard(&agile());
    stream(&mut vehicle, 3.0, |_| velocity([3.0, 0.0, 0.0]));
    assert!((vehicle.body.nav.velocity.x - 3.0).abs() < 0.1);
    vehicle.run(0.9);
    assert_eq!(vehicle.told.mode, Mode::Offboard, "not lost yet");
    vehicle.run(0.2);
    assert_eq!(vehicle.told.mode, Mode::Hold);
    vehicle.run(5.0);
    assert!(vehicle.body.nav.velocity.norm() < 0.02);
}

#[test]
fn a_circle_at_eight_metres_a_second_is_flown_within_5_cm() {
    let mut config = agile();
    config.tilt_max_rad = 50.0_f32.to_radians();
    let (radius, speed) = (10.0, 8.0_f32);
    let rate = speed / radius;
    let at = |t: f32| [radius * (rate * t).sin(), radius * (1.0 - (rate * t).cos()), 4.0];
    let mut vehicle = offboard(&config);
    let (mut sum, mut count) = (0.0, 0);
    stream_while(
        &mut vehicle,
        25.0,
        |t| position(at(t), 0.0),
        |t, vehicle| {
            if t > 12.0 {
                let error = vehicle.body.nav.position - Vector3::from(at(t));
                sum += error.norm_squared();
                count += 1;
            }
        },
    );
    let rms = (sum / count as f32).sqrt();
    assert!(rms < 0.05, "{rms} m");
}

#[test]
fn from_offboard_to_hold_and_back_nothing_jumps() {
    let mut vehicle = offboard(&agile());
    let mut before = vehicle.reference.wanted_acceleration;
    let mut steepest = 0.0_f32;
    let mut look = |vehicle: &Vehicle| {
        if vehicle.tick.is_multiple_of(4) {
            let jerk = (vehicle.reference.wanted_acceleration - before) / 0.004;
            steepest = steepest.max(jerk.norm());
            before = vehicle.reference.wanted_acceleration;
        }
    };
    stream_while(&mut vehicle, 3.0, |_| position([30.0, 0.0, 4.0], 0.0), |_, vehicle| look(vehicle));
    assert!(vehicle.body.nav.velocity.x > 3.0);
    vehicle.ask(Request::Hold);
    stream_while(&mut vehicle, 0.6, |_| position([30.0, 0.0, 4.0], 0.0), |_, vehicle| look(vehicle));
    assert_eq!(vehicle.told.mode, Mode::Hold);
    vehicle.ask(Request::Offboard);
    stream_while(&mut vehicle, 12.0, |_| position([30.0, 0.0, 4.0], 0.0), |_, vehicle| look(vehicle));
    vehicle.assert_near([30.0, 0.0, 4.0], 0.1);
    // Horizontally and vertically 10 m/s³ each.
    assert!(steepest < 15.0, "{steepest} m/s³");
}

#[test]
fn an_attitude_is_flown_within_two_and_a_half_degrees() {
    let mut vehicle = offboard(&agile());
    let pitch = 20.0_f32.to_radians();
    let attitude = UnitQuaternion::from_euler_angles(0.0, pitch, 0.0);
    // The thrust that carries the weight: MPC_THR_HOVER.
    let wanted = AttitudeSetPoint { attitude: Some(attitude), rates: Vector3::zeros(), thrust: 0.5 };
    stream_while(
        &mut vehicle,
        3.0,
        |_| SetPoint::Attitude(wanted),
        |t, vehicle| {
            let off = vehicle.body.nav.attitude.angle_to(&attitude).to_degrees();
            assert!(t < 0.5 || off < 2.5, "{off}° at {t} s");
        },
    );
    assert!(vehicle.body.nav.velocity.x > 3.0, "nose down: forward");
}

#[test]
fn body_rates_are_flown() {
    let mut vehicle = offboard(&agile());
    let rates = Vector3::new(0.0, 0.5, 0.3);
    let wanted = AttitudeSetPoint { attitude: None, rates, thrust: 0.52 };
    stream(&mut vehicle, 0.7, |_| SetPoint::Attitude(wanted));
    assert!((vehicle.body.nav.rates - rates).norm() < 0.05, "{}", vehicle.body.nav.rates);
    vehicle.ask(Request::Hold);
    vehicle.run(5.0);
    assert!(vehicle.body.nav.velocity.norm() < 0.05 && vehicle.body.nav.rates.norm() < 0.05);
}

/// The greatest step of the reference between two jobs, m, and its greatest acceleration, m/s², while the stream goes on for
/// 0.4 s: sticks that were moved before are not lost yet.
fn soon_after(vehicle: &mut Vehicle, make: impl Fn(f32) -> SetPoint) -> (f32, f32) {
    let (mut before, mut step, mut most) = (vehicle.reference.wanted, 0.0_f32, 0.0_f32);
    stream_while(vehicle, 0.4, make, |_, vehicle| {
        step = step.max((vehicle.reference.wanted - before).xyz().norm());
        before = vehicle.reference.wanted;
        most = most.max(vehicle.reference.wanted_acceleration.norm());
    });
    (step, most)
}

#[test]
fn position_mode_goes_on_from_where_the_stream_has_brought_it() {
    let mut vehicle = offboard(&agile());
    for x in [20.0, -20.0] {
        vehicle.hold(Sticks::CENTRED);
        vehicle.ask(Request::Manual(ManualMode::Position));
        // At most 6 m/s.
        let (step, _) = soon_after(&mut vehicle, |_| position([x, 0.0, 4.0], 0.0));
        assert!(vehicle.told.mode == Mode::Position && step < 0.024, "{step} m");
        vehicle.ask(Request::Offboard);
        stream(&mut vehicle, 4.0, |_| position([x, 0.0, 4.0], 0.0));
        assert!(vehicle.told.mode == Mode::Offboard && vehicle.body.nav.velocity.norm() > 3.0);
    }
}

#[test]
fn what_takes_over_from_a_stream_that_shakes_does_not_carry_on_its_shaking() {
    let shaken = |t: f32| {
        let a = if ((t * 10.0) as u32).is_multiple_of(2) { 6.0 } else { -6.0 };
        let motion = Motion::default().with_velocity([Some(0.0), Some(0.0), Some(0.0)]);
        SetPoint::Motion { motion: motion.with_acceleration([Some(a), Some(-a), Some(0.3 * a)]), sent_ms: None }
    };
    for late in 0..10 {
        let mut vehicle = offboard(&agile());
        stream(&mut vehicle, 2.0 + 0.02 * late as f32, shaken);
        let before = vehicle.reference.wanted_acceleration.norm();
        vehicle.ask(Request::Hold);
        let (_, most) = soon_after(&mut vehicle, shaken);
        // Until the order comes the shaking goes on.
        assert!(most < before + 4.0, "{most} m/s² after {before}");
    }
}

#[test]
fn a_stream_never_takes_the_weight_away() {
    let mut config = agile();
    config.tilt_max_rad = 1.2;
    config.modes.sink_m_s = 6.0;
    let mut vehicle = offboard(&config);
    let fall = Motion::default().with_acceleration([Some(0.0), Some(0.0), Some(-7.0)]);
    let (mut least, g) = (0.0_f32, config.airframe.gravity_m_s2);
    stream_while(
        &mut vehicle,
        1.0,
        |_| SetPoint::Motion { motion: fall, sent_ms: None },
        |_, vehicle| least = least.min(vehicle.reference.wanted_acceleration.z),
    );
    assert!((-0.405 * g..-0.38 * g).contains(&least), "{least} m/s²");
}

#[test]
fn a_stream_leaves_a_fifth_of_the_tilt_for_the_wind() {
    let config = agile();
    let mut vehicle = offboard(&config);
    let race = Motion::default().with_acceleration([Some(7.0), None, None]);
    let mut most = 0.0_f32;
    stream_while(
        &mut vehicle,
        2.0,
        |_| SetPoint::Motion { motion: race, sent_ms: None },
        |_, vehicle| most = most.max(vehicle.reference.wanted_acceleration.x),
    );
    let limit = config.tilt_max_rad.tan() * config.airframe.gravity_m_s2;
    assert!((0.78..0.81).contains(&(most / limit)), "{most} of {limit} m/s²");
}

#[test]
fn a_place_below_the_ground_does_not_lead_the_reference_away() {
    let mut vehicle = offboard(&agile());
    let mut deepest = 0.0_f32;
    stream_while(
        &mut vehicle,
        20.0,
        |_| position([0.0, 0.0, -30.0], 0.0),
        |_, vehicle| deepest = deepest.min(vehicle.reference.wanted.z - vehicle.body.nav.position.z),
    );
    assert!((-0.51..-0.3).contains(&deepest), "{deepest} m");
}

/// How sharply references bend.
#[derive(Default)]
struct Bends {
    last: Option<OuterOutput>,
    /// Greatest jerk between two jobs, over the ground and vertically, m/s³.
    level_m_s3: f32,
    vertical_m_s3: f32,
    /// Farthest that one was from where the one before led, m.
    jump_m: f32,
}

impl Bends {
    fn look(&mut self, vehicle: &Vehicle) {
        const STEP_S: f32 = 4.0 * TICK_S;
        let now = vehicle.reference;
        if let Some(last) = self.last.replace(now)
            && last.attitude.valid_at != now.attitude.valid_at
        {
            let way = (last.wanted_velocity + last.wanted_acceleration * (0.5 * STEP_S)) * STEP_S;
            self.jump_m = self.jump_m.max((now.wanted.xyz() - last.wanted.xyz() - way).norm());
            let jerk = (now.wanted_acceleration - last.wanted_acceleration) / STEP_S;
            self.level_m_s3 = self.level_m_s3.max(jerk.xy().norm());
            self.vertical_m_s3 = self.vertical_m_s3.max(jerk.z.abs());
        }
    }

    /// Checks the jerk limit of the settings.
    fn check(&self, limit_m_s3: f32, name: &str) {
        let Self { level_m_s3, vertical_m_s3, jump_m, .. } = self;
        let most = 1.03 * limit_m_s3;
        assert!(*level_m_s3 < most && *vertical_m_s3 < most, "{name}: {level_m_s3} and {vertical_m_s3} m/s³");
        assert!(*jump_m < 1e-5, "{name}: {jump_m} m");
    }
}

#[test]
fn a_stream_on_a_circle_is_left_and_taken_up_within_the_jerk_limit() {
    // 8 m/s on a radius of 10 m: 6.4 m/s² where 3 is the limit of what the vehicle flies by itself, and 5.1 m/s³.
    let circle = |t: f32| {
        let (sin, cos) = (0.8 * t).sin_cos();
        position([10.0 * sin, 10.0 - 10.0 * cos, 4.0], 0.0)
    };
    for (leaves, mode) in [(Request::Hold, Mode::Hold), (Request::Return, Mode::Return), (Request::Land, Mode::Land)] {
        for phase in 0..8 {
            let mut vehicle = offboard(&agile());
            let begun = 14.0 + phase as f32;
            stream(&mut vehicle, begun, circle);
            for (request, mode, after) in [(leaves, mode, 0.0), (Request::Offboard, Mode::Offboard, 3.0)] {
                let mut bends = Bends::default();
                vehicle.ask(request);
                stream_while(&mut vehicle, 3.0, |t| circle(begun + after + t), |_, vehicle| bends.look(vehicle));
                assert_eq!(vehicle.told.mode, mode);
                bends.check(10.0, &format!("{mode:?} at {begun} s"));
            }
        }
    }
}

#[test]
fn ways_that_follow_a_stream_keep_the_jerk_limit_that_is_set_also_when_they_turn_back() {
    for limit_m_s3 in [4.0, 10.0, 20.0] {
        let mut config = agile();
        config.modes.jerk_m_s3 = limit_m_s3;
        for speed in [0.3, 0.8, 2.0, 4.0] {
            for back in [false, true] {
                let mut vehicle = offboard(&config);
                stream(&mut vehicle, 3.0, |_| velocity([speed, 0.0, -0.2 * speed]));
                let place = vehicle.body.nav.position;
                let mut bends = Bends::default();
                let aside = |metres: f32| Request::GoTo(Goal::at([place.x + metres, 0.0, place.z + 1.0], 0.0));
                vehicle.ask(aside(if back { -6.0 } else { 3.0 }));
                stream_while(&mut vehicle, 1.5, |_| velocity([speed, 0.0, 0.0]), |_, vehicle| bends.look(vehicle));
                vehicle.ask(aside(if back { 6.0 } else { -3.0 }));
                stream_while(&mut vehicle, 4.0, |_| velocity([speed, 0.0, 0.0]), |_, vehicle| bends.look(vehicle));
                bends.check(limit_m_s3, &format!("{limit_m_s3} m/s³, {speed} m/s, {back}"));
            }
        }
        // And from a circle whose acceleration is twice what the vehicle flies by itself.
        for phase in 0..4 {
            let mut vehicle = offboard(&config);
            let circle = |t: f32| {
                let (sin, cos) = (0.8 * t).sin_cos();
                position([10.0 * sin, 10.0 - 10.0 * cos, 4.0], 0.0)
            };
            stream(&mut vehicle, 14.0 + phase as f32, circle);
            let mut bends = Bends::default();
            vehicle.ask(Request::Hold);
            stream_while(&mut vehicle, 6.0, circle, |_, vehicle| bends.look(vehicle));
            bends.check(limit_m_s3, &format!("{limit_m_s3} m/s³ from a circle, {phase}"));
        }
    }
}

#[test]
fn places_that_begin_to_move_are_met_within_the_jerk_limit() {
    let mut vehicle = offboard(&agile());
    let mut bends = Bends::default();
    // They stand, and then run round a circle at once.
    let path = |t: f32| {
        let (sin, cos) = (0.8 * math::max(t - 3.0, 0.0)).sin_cos();
        position([10.0 * sin, 10.0 - 10.0 * cos, 4.0], 0.0)
    };
    stream_while(&mut vehicle, 4.0, path, |_, vehicle| bends.look(vehicle));
    bends.check(10.0, "from standing to 8 m/s");
}

#[test]
fn a_way_after_a_stream_is_no_slower_than_any_other() {
    let arrival = |vehicle: &mut Vehicle| {
        let from = vehicle.body.nav.position;
        vehicle.ask(Request::GoTo(Goal::at([from.x + 3.0, from.y, from.z], 0.0)));
        for tick in 0..10_000_u32 {
            vehicle.tick();
            if vehicle.body.nav.position.x - from.x > 2.9 {
                return tick;
            }
        }
        panic!("it does not arrive: {:?}", vehicle.body.nav);
    };
    let mut vehicle = offboard(&agile());
    vehicle.ask(Request::Hold);
    vehicle.run(3.0);
    let usual = arrival(&mut vehicle);
    let mut vehicle = offboard(&agile());
    stream(&mut vehicle, 14.0, |t| position([10.0 * (0.8 * t).sin(), 10.0 - 10.0 * (0.8 * t).cos(), 4.0], 0.0));
    vehicle.ask(Request::Hold);
    vehicle.run(8.0);
    let after = arrival(&mut vehicle);
    assert!(after.abs_diff(usual) < 60, "{after} and {usual} ms");
}

#[test]
fn altitude_mode_is_left_without_a_bend_of_the_height() {
    for leaves in [Some(Request::Hold), Some(Request::Return), None] {
        for ticks in [200, 400, 700] {
            let mut vehicle = offboard(&agile());
            vehicle.hold(Sticks::CENTRED);
            vehicle.run(0.1);
            vehicle.ask(Request::Manual(ManualMode::Altitude));
            vehicle.run(0.5);
            let mut bends = Bends::default();
            let climbs = Sticks { throttle: 1.0, ..Sticks::CENTRED };
            // It gathers speed upwards when that is no longer wanted.
            for tick in 0..3_000 {
                if tick < ticks {
                    vehicle.hold(climbs);
                } else if tick == ticks {
                    match leaves {
                        Some(request) => vehicle.ask(request),
                        None => vehicle.latest.sticks = None,
                    }
                }
                vehicle.tick();
                bends.look(&vehicle);
            }
            assert_ne!(vehicle.told.mode, Mode::Altitude);
            assert!(bends.vertical_m_s3 < 10.3, "{leaves:?} after {ticks} ms: {} m/s³", bends.vertical_m_s3);
        }
    }
}
