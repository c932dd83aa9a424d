//! Settings on their way through the whole autopilot: from a ground station's message to whoever flies by them.

use firmware::autopilot::{Autopilot, Released};
use firmware::commander::{Goal, Mode, Outcome, Refusal, Request};
use firmware::config::{FlightConfig, Start};
use firmware::estimator::EstimatorSettings;
use firmware::guidance::Trajectory;
use firmware::mavlink::port::Profile;
use firmware::sensors::{ImuSample, MagSample, Measurements};
use firmware::settings::{COUNT, Class, SETTINGS, SYS_AUTOSTART, Settings, Value, find};
use firmware::signals::{NavState, SensorFrame};
use glissade_dialect::mavlink_core::types::CharArray;
use glissade_dialect::mavlink_core::{MAVLinkV2MessageRaw, MavHeader};
use glissade_dialect::{COMMAND_LONG_DATA, MavCmd, MavParamType, PARAM_SET_DATA};
use nalgebra::Vector3;
use proptest::prelude::*;

use crate::vehicle::{Body, config};

/// `COMMAND_LONG` to arm.
fn arm() -> Vec<u8> {
    let message = COMMAND_LONG_DATA {
        param1: 1.0,
        target_system: 1,
        target_component: 1,
        command: MavCmd::MAV_CMD_COMPONENT_ARM_DISARM as u16,
        ..COMMAND_LONG_DATA::default()
    };
    let mut frame = MAVLinkV2MessageRaw::new();
    frame.serialize_message_data(MavHeader { system_id: 255, component_id: 190, sequence: 0 }, &message);
    frame.raw_bytes().to_vec()
}

/// `PARAM_SET` of a setting.
fn param_set(index: usize, value: Value) -> Vec<u8> {
    let mut param_id = [0; 16];
    param_id[..SETTINGS[index].name.len()].copy_from_slice(SETTINGS[index].name.as_bytes());
    let param_type = match value {
        Value::Int(_) => MavParamType::MAV_PARAM_TYPE_INT32,
        Value::Real(_) => MavParamType::MAV_PARAM_TYPE_REAL32,
    };
    let message = PARAM_SET_DATA {
        param_value: f32::from_bits(value.bits()),
        target_system: 1,
        target_component: 1,
        param_id: CharArray::new(param_id),
        param_type: param_type as u8,
    };
    let mut frame = MAVLinkV2MessageRaw::new();
    frame.serialize_message_data(MavHeader { system_id: 255, component_id: 190, sequence: 0 }, &message);
    frame.raw_bytes().to_vec()
}

fn index(name: &str) -> usize {
    find(name).expect("in the table")
}

fn hovering() -> FlightConfig {
    FlightConfig {
        start: Start::InFlight,
        trajectory: Trajectory::Hold { position_m: [0.0, 0.0, 20.0], yaw_rad: 0.0 },
        start_position_m: [0.0, 0.0, 20.0],
        join: None,
        ..config()
    }
}

/// A vehicle in the air, and its autopilot.
struct Flight {
    pilot: Autopilot,
    body: Body,
}

impl Flight {
    fn new(config: &FlightConfig) -> Self {
        let nav = NavState { position: config.start_position(), ..NavState::at_rest() };
        let pilot = Autopilot::new(config).expect("valid");
        pilot.ports.first().open(Profile::Normal);
        Self { pilot, body: Body { airframe: config.airframe, nav } }
    }

    /// Flies, and returns the rotor speeds of each tick.
    fn fly(&mut self, ticks: u32) -> Vec<[f32; 4]> {
        (0..ticks)
            .map(|_| {
                let motors = self.pilot.tick(Some(&SensorFrame::Motion(self.body.nav))).motors;
                self.body.step(&motors);
                motors.omega_rad_s
            })
            .collect()
    }
}

#[test]
fn a_gain_set_in_flight_acts_without_a_jump() {
    let mut flight = Flight::new(&hovering());
    let before = flight.fly(3_000);
    for (name, value) in [("SMC_X_LAMBDA", 1.0), ("SMC_X_K", 3.0), ("SMC_ROLL_LAMBDA", 15.0), ("SMC_PITCH_RHO", 0.7)] {
        flight.pilot.ports.first().receive(&param_set(index(name), Value::Real(value)));
    }
    let after = flight.fly(100);
    let last = before[before.len() - 1];
    let jump = after.iter().flatten().zip(last.iter().cycle()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(jump < 0.01, "{jump} rad/s at hover");

    // From 0.5 m off at rest, with λ = 1 and K/ρ = 1.5 it comes back as 1.5 e^(−t) − e^(−1.5t); with the gains before as
    // 1.5 e^(−2t) − e^(−3t), to 0.025 m in this time.
    flight.body.nav.position.x += 0.5;
    flight.fly(2_000);
    let off = flight.body.nav.position.x;
    let expected = 1.5 * (-2.0_f32).exp() - (-3.0_f32).exp();
    assert!((off - expected).abs() < 0.02, "{off} m, {expected} expected");
}

#[test]
fn a_limit_set_in_flight_is_kept_by_the_next_metres() {
    let mut flight = Flight::new(&hovering());
    flight.fly(500);
    let go = Request::GoTo(Goal::at([60.0, 0.0, 20.0], 0.0));
    flight.pilot.inner.request(go).expect("room");
    flight.fly(6_000);
    let speed = flight.body.nav.velocity.x;
    assert!((speed - 5.0).abs() < 0.1, "{speed} m/s before");
    flight.pilot.ports.first().receive(&param_set(index("MPC_XY_CRUISE"), Value::Real(2.0)));
    flight.pilot.ports.first().receive(&param_set(index("MPC_JERK_AUTO"), Value::Real(5.0)));
    let mut reference: Vec<Vector3<f32>> = Vec::new();
    for _ in 0..4_000 {
        flight.fly(1);
        reference.push(flight.pilot.inner.outer_output().wanted.xyz());
    }
    let speed = flight.body.nav.velocity.x;
    assert!((speed - 2.0).abs() < 0.05, "{speed} m/s after");
    // No step of the reference, which moves with 5 m/s at most, is longer than that makes it in 4 ms.
    let longest = reference.windows(2).map(|pair| (pair[1] - pair[0]).norm()).fold(0.0, f32::max);
    assert!(longest < 1.02 * 5.0 * 4e-3, "{longest} m");
}

#[test]
fn what_takes_effect_at_the_next_start_changes_no_flight() {
    let (mut one, mut other) = (Flight::new(&hovering()), Flight::new(&hovering()));
    for (i, setting) in SETTINGS.iter().enumerate().filter(|(_, setting)| setting.class == Class::Boot) {
        let half = match one.pilot.ground.settings().get(i) {
            Some(Value::Real(value)) => Value::Real(0.5 * value),
            _ => continue,
        };
        let done = one.pilot.ground.settings_mut().set(i, half, true);
        assert!(done.is_ok() || half == Value::Real(0.0), "{}: {done:?}", setting.name);
        assert_eq!(one.fly(10), other.fly(10), "{}", setting.name);
    }
}

#[test]
fn a_vehicle_that_was_never_configured_does_not_arm_not_even_forced() {
    let mut flight = Flight::new(&config());
    flight.pilot = flight.pilot.with_settings(Settings::default());
    flight.fly(100);
    for force in [false, true] {
        flight.pilot.inner.request(Request::Arm { force }).expect("room");
        let mut replies = Vec::new();
        for _ in 0..60 {
            flight.fly(1);
            replies.extend(flight.pilot.inner.commander_output().replies.iter().map(|reply| reply.outcome));
        }
        assert!(replies.iter().all(|outcome| *outcome == Outcome::TemporarilyRejected(Refusal::NotConfigured)));
        assert!(!replies.is_empty());
    }
    assert_eq!(flight.pilot.inner.commander_output().armable, Err(Refusal::NotConfigured));
    flight.pilot.ports.first().receive(&param_set(SYS_AUTOSTART, Value::Int(4001)));
    flight.fly(100);
    flight.pilot.inner.request(Request::Arm { force: false }).expect("room");
    flight.fly(60);
    assert_eq!(flight.pilot.inner.commander_output().mode, Mode::Idle);
}

#[test]
fn what_is_set_while_disarmed_only_is_in_effect_before_an_arming_asked_for_after_it() {
    for wait in 0..40 {
        let mut flight = Flight::new(&config());
        flight.fly(100);
        let in_flight = SETTINGS.iter().enumerate().filter(|(_, setting)| setting.class == Class::InFlight);
        for (i, setting) in in_flight.take(30) {
            let value = Value::Real(0.99 * flight.pilot.ground.settings().get(i).expect("a value").real());
            if setting.kind() == value.kind() {
                flight.pilot.ports.first().receive(&param_set(i, value));
            }
        }
        flight.pilot.ports.first().receive(&param_set(SYS_AUTOSTART, Value::Int(0)));
        flight.fly(wait);
        flight.pilot.ports.first().receive(&arm());
        flight.fly(1_000);
        assert_eq!(flight.pilot.inner.commander_output().mode, Mode::Disarmed, "{wait} ms after");
    }
}

#[test]
fn the_estimator_begins_by_the_field_that_was_set_before() {
    // A field that points forward and down: the vehicle heads north where such a field points north, and west where it
    // points west.
    for (field, yaw_deg) in [([20.0, 0.0, -40.0], 0.0), ([0.0, 20.0, -40.0], 90.0)] {
        let config = FlightConfig { estimator: Some(EstimatorSettings::default()), ..config() };
        let mut pilot = Autopilot::new(&config).expect("valid");
        pilot.ports.first().open(Profile::Normal);
        for (name, value) in ["GL_E_FIELD_X", "GL_E_FIELD_Y", "GL_E_FIELD_Z"].into_iter().zip(field) {
            pilot.ports.first().receive(&param_set(index(name), Value::Real(value)));
        }
        for at in 0..5_000 {
            // What repeats itself exactly would be a stuck sensor's.
            let noise = Vector3::repeat(1e-3 * f64::from(at).sin() as f32);
            let rests = Measurements {
                imu: Some(ImuSample { at, gyro: noise, accel: Vector3::z() * 9.81 + noise }),
                mag: at
                    .is_multiple_of(20)
                    .then_some(MagSample { at, field_ut: Vector3::new(20.0, 0.0, -40.0) + noise }),
                ..Measurements::default()
            };
            pilot.tick(Some(&SensorFrame::Measured(rests)));
        }
        assert!(pilot.inner.nav_health().heading);
        let yaw = pilot.inner.nav().yaw().to_degrees();
        assert!((yaw - yaw_deg).abs() < 1.0, "{yaw}° in place of {yaw_deg}°");
    }
}

#[test]
fn partitions_that_are_too_slow_lose_no_change() {
    let config = hovering();
    let mut pilot = Autopilot::new(&config).expect("valid");
    pilot.ports.first().open(Profile::Normal);
    let names = [
        "MPC_XY_CRUISE",
        "MPC_Z_VEL_MAX_UP",
        "MPC_Z_VEL_MAX_DN",
        "MPC_TKO_SPEED",
        "MPC_LAND_SPEED",
        "MPC_LAND_CRWL",
        "GL_DESCENT_SPEED",
        "RTL_RETURN_ALT",
        "GL_BAT_LOW_V",
        "GL_BAT_CRIT_V",
        "MPC_ACC_HOR",
        "GL_ACC_VERT",
    ];
    for (i, name) in (1_u8..).zip(names) {
        let value = Value::Real(f32::from(i));
        pilot.ground.settings_mut().set(index(name), value, true).expect("in range");
    }
    let mut expected = config.clone();
    pilot.ground.settings().write_to(&mut expected);
    let sample = SensorFrame::Motion(NavState { position: config.start_position(), ..NavState::at_rest() });
    // Each of the commander's jobs takes 90 ticks in place of 4: all of them overrun.
    let mut job = None;
    for tick in 0..3_000_u32 {
        let released = pilot.inner.tick(&mut pilot.mail, &pilot.ports, Some(&sample));
        pilot.run(Released { commander: false, ..released });
        if released.commander {
            job = pilot.mail.commander.take().map(|job| (tick + 90, job));
        }
        if let Some((_, (released, input))) = job.take_if(|(end, _)| *end == tick) {
            pilot.mail.commander.finish(pilot.commander.step(released, &input));
        }
    }
    assert!(pilot.mail.overruns()[1] > 20, "it was too slow");
    assert_eq!(*pilot.commander.settings(), expected.modes);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn setting_the_present_values_changes_no_flight(order in prop::collection::vec(0..COUNT, 20)) {
        let (mut one, mut other) = (Flight::new(&hovering()), Flight::new(&hovering()));
        one.body.nav.velocity.x = 1.0;
        other.body.nav.velocity.x = 1.0;
        for index in order {
            let value = one.pilot.ground.settings().get(index).expect("a value");
            one.pilot.ports.first().receive(&param_set(index, value));
            prop_assert_eq!(one.fly(25), other.fly(25));
        }
    }

    #[test]
    fn whatever_is_set_in_flight_the_settings_stay_within_their_ranges(
        sets in prop::collection::vec((0..COUNT, any::<u32>(), any::<bool>()), 100),
    ) {
        let mut flight = Flight::new(&hovering());
        for (index, bits, is_int) in sets {
            let value = if is_int { Value::Int(bits.cast_signed()) } else { Value::Real(f32::from_bits(bits)) };
            flight.pilot.ports.first().receive(&param_set(index, value));
            for speeds in flight.fly(10) {
                prop_assert!(speeds.iter().all(|speed| speed.is_finite()), "{speeds:?}");
            }
        }
        let mut config = hovering();
        flight.pilot.ground.settings().write_to(&mut config);
        prop_assert_eq!(config.validate(), Ok(()));
    }
}
