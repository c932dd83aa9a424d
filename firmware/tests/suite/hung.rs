//! A partition whose job never ends: the vehicle comes down level and slowly, says so, and a kill still stops it.

use firmware::airframe::ROTORS;
use firmware::autopilot::{Autopilot, Released};
use firmware::commander::{Mode, MotorTest, Refusal, Request};
use firmware::config::{FlightConfig, Start};
use firmware::control::observer::ObserverGains;
use firmware::guidance::Trajectory;
use firmware::mavlink::GroundInput;
use firmware::mavlink::port::Profile;
use firmware::schedule::GROUND;
use firmware::settings::{Value, find};
use firmware::signals::{MotorCommand, NavState, SensorFrame, TICK_S, Tick};
use firmware::watchdog::{COMMANDER_HUNG_AFTER, OUTER_HUNG_AFTER};
use glissade_dialect::mavlink_core::{MAVLinkV2MessageRaw, MavHeader, MavlinkVersion, Message};
use glissade_dialect::{COMMAND_LONG_DATA, HEARTBEAT_DATA, MavCmd, MavMessage, MavState};
use nalgebra::Vector3;

use crate::vehicle::{Body, config};

/// The partitions that hang.
#[derive(Clone, Copy, Default)]
struct Hangs {
    outer: bool,
    commander: bool,
    /// Ticks by which the next job of the ground partition is late.
    ground_late: Tick,
}

/// The schedule as on a board, where a partition's task takes its snapshot and may never finish.
struct Vehicle {
    pilot: Autopilot,
    body: Body,
    motors: MotorCommand,
    hangs: Hangs,
    ground_job: Option<(Tick, GroundInput)>,
    sent: Vec<u8>,
}

impl Vehicle {
    /// Flying at 5 m along x.
    fn flying(speed_m_s: f32) -> Self {
        Self::flying_by(config(), speed_m_s)
    }

    /// The same with other gains.
    fn flying_by(config: FlightConfig, speed_m_s: f32) -> Self {
        let start = Vector3::new(0.0, 0.0, 5.0);
        let config = FlightConfig {
            trajectory: Trajectory::Hold { position_m: start.into(), yaw_rad: 0.0 },
            start: Start::InFlight,
            start_position_m: start.into(),
            ..config
        };
        let velocity = Vector3::new(speed_m_s, 0.0, 0.0);
        let nav = NavState { position: start, velocity, ..NavState::at_rest() };
        let pilot = Autopilot::new(&config).expect("valid");
        pilot.ports.first().open(Profile::Normal);
        Self {
            pilot,
            body: Body { airframe: config.airframe, nav },
            motors: MotorCommand::STOPPED,
            hangs: Hangs::default(),
            ground_job: None,
            sent: Vec::new(),
        }
    }

    /// Disarmed on the ground.
    fn standing() -> Self {
        let config = config();
        let pilot = Autopilot::new(&config).expect("valid");
        pilot.ports.first().open(Profile::Normal);
        Self { pilot, body: Body { airframe: config.airframe, nav: NavState::at_rest() }, ..Self::flying(0.0) }
    }

    fn tick(&mut self) {
        let Autopilot { inner, mail, ports, .. } = &mut self.pilot;
        let released = inner.tick(mail, ports, Some(&SensorFrame::Motion(self.body.nav)));
        // The ground partition's jobs are run below.
        self.pilot.run(Released {
            outer: released.outer && !self.hangs.outer,
            commander: released.commander && !self.hangs.commander,
            ground: false,
            ..released
        });
        let Autopilot { inner, ground, mail, ports, .. } = &mut self.pilot;
        // A job runs when it ends: what it works on is its release's.
        let now = inner.next_tick() - 1;
        let ends = |tick: Tick, late: Tick| now >= tick + if late > 0 { GROUND.offset + late } else { 0 };
        if released.ground {
            self.ground_job = mail.ground.take();
        }
        if let Some((tick, input)) = self.ground_job.take_if(|(tick, _)| ends(*tick, self.hangs.ground_late)) {
            mail.ground.finish(ground.step(tick, &input, ports));
            self.hangs.ground_late = 0;
        }
        self.motors = inner.inner_output().motors;
        self.sent.extend_from_slice(ports.first().take(&mut [0; 2048]));
        self.body.step(&self.motors);
    }

    fn run(&mut self, seconds: f32) {
        for _ in 0..(seconds / TICK_S) as u32 {
            self.tick();
        }
    }

    /// Until it stands on the ground: the greatest speed downwards.
    fn comes_down(&mut self, within_s: f32) -> f32 {
        let mut fastest = 0.0;
        for _ in 0..(within_s / TICK_S) as u32 {
            self.tick();
            fastest = firmware::math::max(fastest, -self.body.nav.velocity.z);
            if self.body.nav.position.z <= 0.0 {
                return fastest;
            }
        }
        panic!("not on the ground after {within_s} s: {:?}", self.body.nav);
    }

    fn has_said(&self, text: &str) -> bool {
        self.sent.windows(text.len()).any(|bytes| bytes == text.as_bytes())
    }

    fn mode(&self) -> Mode {
        self.pilot.inner.commander_output().mode
    }

    fn tilt(&self) -> f32 {
        (self.body.nav.attitude * Vector3::z()).angle(&Vector3::z())
    }
}

#[test]
fn with_a_hung_outer_partition_it_comes_down_level_and_is_disarmed() {
    let mut vehicle = Vehicle::flying(3.0);
    vehicle.run(0.3);
    assert!(vehicle.tilt() > 0.1, "it brakes when its guidance stops: {}", vehicle.tilt());
    vehicle.hangs.outer = true;
    vehicle.run(1.0);
    assert!(vehicle.tilt() < 0.01, "{}", vehicle.tilt());
    let nav = vehicle.body.nav;
    let weight = vehicle.body.airframe.weight_n();
    let thrust = vehicle.pilot.inner.inner_output().demand.thrust_n;
    assert!((0.9 * weight..0.95 * weight).contains(&thrust), "{thrust} of {weight} N");
    let fastest = vehicle.comes_down(10.0);
    assert!(fastest < 2.5, "{fastest} m/s");
    assert!((vehicle.body.nav.position - nav.position).xy().norm() < 10.0 && vehicle.tilt() < 0.02);
    assert_eq!(vehicle.mode(), Mode::Descent);
    assert!(vehicle.has_said("Guidance hung: blind descent"));
    vehicle.run(4.5);
    assert_eq!(vehicle.mode(), Mode::Disarmed);
    assert_eq!(vehicle.motors, MotorCommand::STOPPED);
    assert_eq!(vehicle.pilot.inner.commander_output().armable, Err(Refusal::NoGuidance));
}

#[test]
fn with_weak_rotors_a_blind_descent_has_the_thrust_that_it_was_seen_to_need() {
    let mut config = config();
    config.position.effectiveness_rate = 1.0;
    config.position.observer = ObserverGains { bandwidth_rad_s: 5.0, disturbance_max: 8.0 };
    let mut vehicle = Vehicle::flying_by(config, 0.0);
    // They lift four fifths of what the model says.
    vehicle.body.airframe.geometry.thrust = vehicle.body.airframe.geometry.thrust.map(|lift| 0.8 * lift);
    vehicle.run(15.0);
    assert!((vehicle.body.nav.position.z - 5.0).abs() < 0.1, "it has learnt to hover: {:?}", vehicle.body.nav);
    vehicle.hangs.outer = true;
    vehicle.run(0.5);
    let weight = vehicle.body.airframe.weight_n();
    let lifts = 0.8 * vehicle.pilot.inner.inner_output().demand.thrust_n;
    assert!((0.9 * weight..0.95 * weight).contains(&lifts), "{lifts} of {weight} N");
    let fastest = vehicle.comes_down(10.0);
    assert!(fastest < 2.5, "{fastest} m/s");
}

#[test]
fn with_a_hung_commander_it_descends_by_what_is_known_until_it_is_killed() {
    let mut vehicle = Vehicle::flying(0.0);
    vehicle.run(0.3);
    vehicle.hangs.commander = true;
    let place = vehicle.body.nav.position;
    let fastest = vehicle.comes_down(20.0);
    assert!(fastest < 0.6, "{fastest} m/s");
    assert!((vehicle.body.nav.position - place).xy().norm() < 0.1 && vehicle.tilt() < 0.02);
    assert!(vehicle.has_said("Commander hung: descending"));
    vehicle.pilot.inner.kill();
    vehicle.tick();
    assert_eq!(vehicle.motors, MotorCommand::STOPPED);
}

#[test]
fn with_both_hung_it_comes_down_level_and_a_kill_stops_it_at_once() {
    let mut vehicle = Vehicle::flying(3.0);
    vehicle.run(0.3);
    vehicle.hangs = Hangs { outer: true, commander: true, ..Hangs::default() };
    let fastest = vehicle.comes_down(10.0);
    assert!(fastest < 2.5 && vehicle.tilt() < 0.02, "{fastest} m/s, {}", vehicle.tilt());
    assert!(vehicle.motors.omega_rad_s.iter().all(|omega| *omega > 0.0), "nobody knows that it has landed");
    vehicle.pilot.inner.kill();
    vehicle.tick();
    assert_eq!(vehicle.motors.omega_rad_s, [0.0; ROTORS]);
    vehicle.run(1.0);
    assert_eq!(vehicle.motors.omega_rad_s, [0.0; ROTORS]);
}

#[test]
fn a_partition_that_is_late_is_none_that_hangs() {
    let mut vehicle = Vehicle::flying(0.0);
    vehicle.run(0.3);
    vehicle.hangs = Hangs { outer: true, commander: true, ..Hangs::default() };
    for _ in 0..OUTER_HUNG_AFTER - 4 {
        vehicle.tick();
    }
    vehicle.hangs.outer = false;
    // The late jobs end at last, and the next ones are released.
    let late = *vehicle.pilot.inner.outer_output();
    vehicle.pilot.mail.outer.finish(late);
    for _ in 0..COMMANDER_HUNG_AFTER - OUTER_HUNG_AFTER - 40 {
        vehicle.tick();
    }
    vehicle.hangs.commander = false;
    let late = vehicle.pilot.inner.commander_output().clone();
    vehicle.pilot.mail.commander.finish(late);
    vehicle.run(3.0);
    assert!(!vehicle.has_said("hung"));
    assert_eq!(vehicle.mode(), Mode::Follow);
    assert!((vehicle.body.nav.position - Vector3::new(0.0, 0.0, 5.0)).norm() < 0.1, "{:?}", vehicle.body.nav);
}

#[test]
fn on_the_ground_a_hung_partition_starts_nothing() {
    for (outer, commander) in [(true, true), (true, false), (false, true)] {
        let mut vehicle = Vehicle::standing();
        vehicle.run(0.1);
        vehicle.pilot.inner.request(Request::Arm { force: false }).expect("room");
        vehicle.run(0.1);
        let idle = vehicle.motors;
        assert!(idle.omega_rad_s[0] > 0.0);
        vehicle.hangs = Hangs { outer, commander, ..Hangs::default() };
        vehicle.run(3.0);
        assert_eq!(vehicle.motors, idle);
        assert!(!vehicle.has_said("hung"), "nothing is done about it");
    }
}

/// A command with its first four numbers.
fn command(command: MavCmd, [param1, param2, param3, param4]: [f32; 4]) -> Vec<u8> {
    let mut raw = MAVLinkV2MessageRaw::new();
    let command = command as u16;
    let numbers = COMMAND_LONG_DATA { param1, param2, param3, param4, ..COMMAND_LONG_DATA::DEFAULT };
    let message = COMMAND_LONG_DATA { target_system: 1, command, ..numbers };
    raw.serialize_message_data(MavHeader { system_id: 255, component_id: 190, sequence: 0 }, &message);
    raw.raw_bytes().to_vec()
}

fn kill() -> Vec<u8> {
    command(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [0.0, 21_196.0, 0.0, 0.0])
}

/// The last heartbeat of what was sent.
fn last_heartbeat(mut sent: &[u8]) -> HEARTBEAT_DATA {
    let mut last = None;
    while let [_, length, _, _, _, _, _, id0, id1, id2, ref rest @ ..] = *sent {
        let payload = &rest[..usize::from(length)];
        let id = u32::from_le_bytes([id0, id1, id2, 0]);
        if let Ok(MavMessage::HEARTBEAT(heartbeat)) = MavMessage::parse(MavlinkVersion::V2, id, payload) {
            last = Some(heartbeat);
        }
        sent = &rest[usize::from(length) + 2..];
    }
    last.expect("a heartbeat")
}

fn turn(motors: &MotorCommand) -> bool {
    *motors != MotorCommand::STOPPED
}

#[test]
fn a_kill_read_by_a_job_that_ends_late_stops_the_rotors_when_it_ends() {
    let mut vehicle = Vehicle::flying(0.0);
    vehicle.run(1.0);
    vehicle.pilot.ports.first().receive(&kill());
    vehicle.hangs.ground_late = 7;
    vehicle.run(0.05);
    assert!(!turn(&vehicle.motors) && !vehicle.pilot.inner.commander_output().armed);
    assert_eq!(vehicle.pilot.mail.overruns(), [0, 0, 1], "and the overrun is counted");
}

#[test]
fn no_number_of_kills_starts_the_rotors_again() {
    let mut vehicle = Vehicle::flying(0.0);
    vehicle.run(1.0);
    vehicle.hangs.commander = true;
    for number in 0..300 {
        vehicle.pilot.ports.first().receive(&kill());
        for _ in 0..10 {
            vehicle.tick();
            assert!(number < 2 || !turn(&vehicle.motors), "kill {number}");
        }
    }
}

#[test]
fn what_is_flown_in_place_of_a_hung_partition_follows_the_settings() {
    let thrust = |set: Option<f32>| {
        let mut vehicle = Vehicle::flying(0.0);
        if let Some(part) = set {
            let index = find("GL_BLIND_THRUST").expect("a setting");
            vehicle.pilot.ground.settings_mut().set(index, Value::Real(part), true).expect("in flight");
        }
        vehicle.run(1.0);
        vehicle.hangs.outer = true;
        vehicle.run(0.2);
        vehicle.pilot.inner.inner_output().demand.thrust_n
    };
    let (weight, default) = (config().airframe.weight_n(), config().modes.blind_thrust_part);
    for (set, part) in [(None, default), (Some(0.5), 0.5)] {
        assert!((thrust(set) - part * weight).abs() < 0.02 * weight, "{set:?}: {}", thrust(set));
    }
}

#[test]
fn a_hung_commander_is_told_as_a_descent_and_what_is_asked_of_it_is_refused_and_never_carried_out() {
    let mut vehicle = Vehicle::flying(0.0);
    vehicle.run(0.3);
    vehicle.hangs.commander = true;
    vehicle.run(1.0);
    let heartbeat = last_heartbeat(&vehicle.sent);
    // PX4's main mode automatic, sub-mode land.
    assert_eq!(heartbeat.custom_mode.to_le_bytes()[2..], [4, 6]);
    assert_eq!(heartbeat.system_status, MavState::MAV_STATE_CRITICAL as u8);
    vehicle.pilot.ports.first().receive(&command(MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH, [0.0; 4]));
    let answered = vehicle.sent.len();
    vehicle.run(0.1);
    assert!(vehicle.has_said("Return refused: commander hung"));
    assert!(vehicle.sent.len() > answered);
    vehicle.hangs.commander = false;
    let late = vehicle.pilot.inner.commander_output().clone();
    vehicle.pilot.mail.commander.finish(late);
    vehicle.run(2.0);
    assert_eq!(vehicle.mode(), Mode::Follow, "the order of then is forgotten");
    assert_eq!(last_heartbeat(&vehicle.sent).custom_mode.to_le_bytes()[2..], [4, 4], "and what it does is told again");
}

#[test]
fn a_motor_test_ends_with_a_kill_at_once_and_when_the_commander_hangs() {
    for hangs in [false, true] {
        let mut vehicle = Vehicle::standing();
        let test = MotorTest { rotor: 1, part: 0.2 };
        vehicle.pilot.inner.request(Request::TestMotor { test, seconds: 1.0 }).expect("room");
        vehicle.run(0.1);
        assert!(turn(&vehicle.motors));
        vehicle.hangs.commander = hangs;
        if hangs {
            vehicle.run(0.6);
            assert!(!turn(&vehicle.motors), "nobody would end it");
        } else {
            vehicle.pilot.inner.kill();
            vehicle.tick();
            assert!(!turn(&vehicle.motors));
            vehicle.run(0.5);
            assert!(!turn(&vehicle.motors));
        }
    }
}

#[test]
fn what_is_about_to_restart_is_not_armed() {
    let mut vehicle = Vehicle::standing();
    vehicle.run(0.1);
    let mut bytes = command(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, [1.0, 0.0, 0.0, 0.0]);
    bytes.extend(command(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0, 0.0, 0.0]));
    vehicle.pilot.ports.first().receive(&bytes);
    vehicle.run(0.1);
    assert!(!vehicle.pilot.inner.commander_output().armed && vehicle.has_said("Arming refused: restart the vehicle"));
    vehicle.run(0.5);
    assert!(vehicle.pilot.inner.takes_restart());
}
