//! The partition as a ground station sees it: bytes in, bytes out.

mod failures;
mod framing;
mod goals;
mod links;
mod messages;
mod modes;
mod orders;
mod params;
mod places;
mod radio;
mod requests;
mod services;
mod setpoints;
mod status;
mod sticks;
mod turns;

use glissade_dialect::mavlink_core::{
    MAVLinkV1MessageRaw, MAVLinkV2MessageRaw, MavHeader, MavlinkVersion, Message, MessageData, calculate_crc,
};
use glissade_dialect::{
    COMMAND_INT_DATA, COMMAND_LONG_DATA, MISSION_REQUEST_LIST_DATA, MavMessage, MavResult, TIMESYNC_DATA,
};
use nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;

use super::outbox::TELEMETRY_SHARE;
use super::port::{Profile, SENT_CAPACITY};
use super::*;
use crate::autopilot::Autopilot;
use crate::commander::{Command, Event, Origin, Outcome, Refusal, Reply, Request};
use crate::config::FlightConfig;
use crate::schedule::GROUND;
use crate::signals::SensorFrame;

const STATION: MavHeader = MavHeader { system_id: 255, component_id: 190, sequence: 7 };
const ARM: u16 = 400;
const SET_INTERVAL: u16 = 511;
const REQUEST_MESSAGE: u16 = 512;
const NAV_WAYPOINT: u16 = 16;

fn frame(message: &impl MessageData) -> Vec<u8> {
    frame_from(STATION, message)
}

fn frame_from(header: MavHeader, message: &impl MessageData) -> Vec<u8> {
    let mut raw = MAVLinkV2MessageRaw::new();
    raw.serialize_message_data(header, message);
    raw.raw_bytes().to_vec()
}

fn command_to(target: (u8, u8), command: u16, param1: f32, param2: f32) -> Vec<u8> {
    let (target_system, target_component) = target;
    frame(&COMMAND_LONG_DATA { target_system, target_component, command, param1, param2, ..COMMAND_LONG_DATA::DEFAULT })
}

fn command(command: u16, param1: f32, param2: f32) -> Vec<u8> {
    command_to((1, 1), command, param1, param2)
}

/// The messages sent. Checks each frame: version, identity, sequence number, checksum, no trailing zeros.
fn parse(mut bytes: &[u8], sequence: &mut u8) -> Vec<MavMessage> {
    let mut messages = Vec::new();
    while !bytes.is_empty() {
        let length = usize::from(bytes[1]);
        assert_eq!((bytes[0], bytes[2], bytes[3]), (0xfd, 0, 0), "MAVLink 2 without flags");
        assert_eq!((bytes[5], bytes[6]), (1, 1), "system and component");
        assert_eq!(bytes[4], *sequence);
        *sequence = sequence.wrapping_add(1);
        let id = u32::from_le_bytes([bytes[7], bytes[8], bytes[9], 0]);
        let payload = &bytes[10..10 + length];
        assert!(length == 1 || payload[length - 1] != 0, "trailing zeros are cut");
        let checksum = u16::from_le_bytes([bytes[10 + length], bytes[11 + length]]);
        assert_eq!(checksum, calculate_crc(&bytes[1..10 + length], MavMessage::extra_crc(id)));
        messages.push(MavMessage::parse(MavlinkVersion::V2, id, payload).expect("parseable"));
        bytes = &bytes[12 + length..];
    }
    messages
}

/// The messages that are sent at an interval, but for the heartbeat.
const STREAMED: [f32; 26] = [
    1.0, 2.0, 24.0, 26.0, 29.0, 30.0, 31.0, 32.0, 33.0, 36.0, 49.0, 74.0, 83.0, 85.0, 105.0, 141.0, 147.0, 230.0,
    231.0, 241.0, 242.0, 245.0, 252.0, 291.0, 331.0, 436.0,
];

/// A ground partition and its inputs.
struct Bench {
    ground: Ground,
    ports: Ports,
    tick: Tick,
    sequence: u8,
    input: GroundInput,
    commands: Vec<Command>,
    killed: bool,
    largest: usize,
}

impl Bench {
    /// A reply of the commander, for the next job.
    fn hear_reply(&mut self, reply: Reply) {
        let _ = reply.to_station().map(|reply| self.input.replies.push(reply));
    }

    fn new() -> Self {
        let input = GroundInput {
            nav: NavState::at_rest(),
            armed: false,
            mode: Mode::Disarmed,
            landed: true,
            ground_m: 0.0,
            armable: true,
            health: Health { nav_fresh: true, ..Health::default() },
            estimator: None,
            control: ControlReport::IDLE,
            sensors: None,
            home: None,
            injectable: Injectable::NONE,
            changes_taken: true,
            replies: Answers::new(),
            events: Events::new(),
        };
        let ports = Ports::new();
        ports.first().open(Profile::Normal);
        let mut ground = Ground::default();
        // As in the first job: what was set before is forgotten when a link is opened.
        ground.links[0].begin(1, Profile::Normal, 0, ports.first());
        Self { ground, ports, tick: 0, sequence: 0, input, commands: Vec::new(), killed: false, largest: 0 }
    }

    /// Without telemetry, so that only answers are seen.
    fn silent() -> Self {
        let mut bench = Self::new();
        for id in STREAMED {
            bench.set_interval(id, -1.0);
        }
        bench.job(&[]);
        bench
    }

    fn set_interval(&mut self, id: f32, interval_us: f32) {
        self.ground.links[0].telemetry.set_interval(0, id, interval_us).expect("allowed");
    }

    fn job(&mut self, received: &[u8]) -> Vec<MavMessage> {
        self.output_of(received).1
    }

    /// A job's output, and the messages that it sends.
    fn output_of(&mut self, received: &[u8]) -> (GroundOutput, Vec<MavMessage>) {
        let port = self.ports.first();
        assert_eq!(port.receive(received), received.len());
        self.ports.release();
        let output = self.ground.step(self.tick, &self.input, &self.ports);
        self.ports.publish();
        self.tick += GROUND.period;
        self.input.replies.clear();
        self.input.events.clear();
        self.commands.extend(output.commands.iter().copied());
        self.killed |= output.kill;
        let mut sent = [0; SENT_CAPACITY];
        let sent = port.take(&mut sent);
        self.largest = self.largest.max(sent.len());
        (output, parse(sent, &mut self.sequence))
    }

    fn jobs(&mut self, count: u32) -> Vec<MavMessage> {
        (0..count).flat_map(|_| self.job(&[])).collect()
    }

    fn result_of(&mut self, received: &[u8]) -> Option<MavResult> {
        self.job(received).iter().find_map(|message| match message {
            MavMessage::COMMAND_ACK(ack) => Some(ack.result),
            _ => None,
        })
    }
}

fn from_station(command: u16, request: Request) -> Command {
    Command { request, origin: Origin::Station { link: 0, peer: 1, sender: (255, 190), command } }
}

fn count(messages: &[MavMessage], id: u32) -> usize {
    messages.iter().filter(|message| message.message_id() == id).count()
}

#[test]
fn messages_are_sent_at_the_rates_of_the_table_within_the_link_budget() {
    let mut bench = Bench::new();
    bench.input.health.timing = Some(LoopTiming { inner_hz: 1000, outer_hz: 250, inner_period_us: (999, 1001) });
    let messages = bench.jobs(1000);
    for (id, expected) in [(0, 10), (30, 200), (32, 200), (1, 20), (245, 20), (252, 40), (148, 0), (331, 0)] {
        assert_eq!(count(&messages, id), expected, "message {id} in 10 s");
    }
    assert!(bench.largest <= TELEMETRY_SHARE);
}

#[test]
fn the_heartbeat_says_quadrotor_px4_and_whether_it_is_armed() {
    let mut bench = Bench::silent();
    for armed in [false, true] {
        bench.input.armed = armed;
        let messages = bench.jobs(100);
        let [MavMessage::HEARTBEAT(heartbeat)] = messages.as_slice() else { panic!("{messages:?}") };
        assert_eq!((heartbeat.mavtype, heartbeat.autopilot), (2, 12));
        assert_eq!(heartbeat.base_mode & 0x81, if armed { 0x81 } else { 1 });
        assert_eq!(heartbeat.system_status, if armed { 4 } else { 3 });
        assert_eq!(heartbeat.mavlink_version, 3);
    }
}

#[test]
fn motion_is_reported_in_north_east_down() {
    let mut bench = Bench::new();
    bench.input.nav = NavState {
        position: Vector3::new(1.0, 2.0, 3.0),
        velocity: Vector3::new(4.0, 5.0, 6.0),
        attitude: UnitQuaternion::from_euler_angles(0.1, 0.2, 0.3),
        rates: Vector3::new(7.0, 8.0, 9.0),
    };
    let messages = bench.jobs(2);
    let attitude = messages.iter().find_map(|m| if let MavMessage::ATTITUDE(m) = m { Some(m) } else { None });
    let attitude = attitude.expect("sent");
    let close = |a: f32, b: f32| crate::math::abs(a - b) < 1e-6;
    assert!(close(attitude.roll, 0.1) && close(attitude.pitch, -0.2) && close(attitude.yaw, -0.3));
    assert_eq!((attitude.rollspeed, attitude.pitchspeed, attitude.yawspeed), (7.0, -8.0, -9.0));
    let local = messages.iter().find_map(|m| if let MavMessage::LOCAL_POSITION_NED(m) = m { Some(m) } else { None });
    let local = local.expect("sent");
    assert_eq!((local.x, local.y, local.z), (1.0, -2.0, -3.0));
    assert_eq!((local.vx, local.vy, local.vz), (4.0, -5.0, -6.0));
    assert_eq!((attitude.time_boot_ms, local.time_boot_ms), (0, 10));
}

#[test]
fn health_shows_in_sys_status() {
    let mut bench = Bench::new();
    bench.input.armable = false;
    bench.input.health = Health { nav_fresh: false, refused_samples: 70_000, overruns: [1, 2, 3], ..Health::default() };
    let messages = bench.jobs(10);
    let status = messages.iter().find_map(|m| if let MavMessage::SYS_STATUS(m) = m { Some(m) } else { None });
    let status = status.expect("sent");
    let (present, health) =
        (status.onboard_control_sensors_present.bits(), status.onboard_control_sensors_health.bits());
    assert_eq!(present & 0x1020_0200, 0x1020_0200);
    assert_eq!(health & 0x1020_0200, 0);
    assert_eq!(health & 0x0010_0000, 0x0010_0000, "no fence is breached");
    assert_eq!(status.errors_count1, u16::MAX);
    assert_eq!((status.errors_count2, status.errors_count3, status.errors_count4), (1, 2, 3));
}

#[test]
fn a_vehicle_that_is_armed_has_passed_its_checks_wherever_it_is() {
    let mut bench = Bench::new();
    (bench.input.armable, bench.input.armed, bench.input.landed) = (false, true, false);
    let messages = bench.jobs(100);
    let status = messages.iter().find_map(|m| if let MavMessage::SYS_STATUS(m) = m { Some(m) } else { None });
    assert_ne!(status.expect("sent").onboard_control_sensors_health.bits() & 0x1000_0000, 0);
}

#[test]
fn a_partition_that_hangs_shows_in_sys_status() {
    let health = |hung: Hung| {
        let mut bench = Bench::new();
        bench.input.health.hung = hung;
        let messages = bench.jobs(10);
        let status = messages.iter().find_map(|m| if let MavMessage::SYS_STATUS(m) = m { Some(m) } else { None });
        status.expect("sent").onboard_control_sensors_health.bits() & 0x1000_7000
    };
    assert_eq!(health(Hung::default()), 0x1000_7000);
    assert_eq!(health(Hung { outer: true, commander: false }), 0x1000_0000, "no control of heading, height and place");
    assert_eq!(health(Hung { outer: false, commander: true }), 0x7000, "nobody would arm it");
}

#[test]
fn arming_goes_to_the_commander_and_its_reply_back_to_the_sender() {
    let mut bench = Bench::silent();
    let requests = [
        (1.0, 0.0, Request::Arm { force: false }),
        (1.0, f32::NAN, Request::Arm { force: false }),
        (1.0, 2989.0, Request::Arm { force: true }),
        (1.0, 21196.0, Request::Arm { force: true }),
        (0.0, 0.0, Request::Disarm),
        (0.0, 2989.0, Request::Disarm),
    ];
    for (param1, param2, request) in requests {
        assert_eq!(bench.result_of(&command(ARM, param1, param2)), None, "not before the commander has decided");
        assert_eq!(bench.commands.pop(), Some(from_station(ARM, request)));
    }
    let command = from_station(ARM, Request::Disarm);
    bench.hear_reply(Reply { command, outcome: Outcome::TemporarilyRejected(Refusal::InAir) });
    let messages = bench.job(&[]);
    let [MavMessage::COMMAND_ACK(ack), MavMessage::STATUSTEXT(text)] = messages.as_slice() else {
        panic!("{messages:?}")
    };
    assert_eq!((ack.command, ack.result), (ARM, MavResult::MAV_RESULT_TEMPORARILY_REJECTED));
    assert_eq!((ack.target_system, ack.target_component), (255, 190));
    assert_eq!(text.text.to_str(), Ok("Disarming refused: vehicle in the air"));
}

#[test]
fn an_invalid_arm_parameter_is_denied_and_too_many_commands_at_once_are_temporarily_rejected() {
    let mut bench = Bench::silent();
    for param1 in [f32::NAN, 0.5, 2.0, -1.0, f32::INFINITY] {
        assert_eq!(bench.result_of(&command(ARM, param1, 0.0)), Some(MavResult::MAV_RESULT_DENIED), "{param1}");
    }
    // Eight wait for the commander, and are passed on two a job.
    let nine: Vec<u8> = (0..9).flat_map(|_| command(ARM, 1.0, 0.0)).collect();
    assert_eq!(bench.result_of(&nine), Some(MavResult::MAV_RESULT_TEMPORARILY_REJECTED));
    assert_eq!(bench.commands.len(), 2);
    bench.jobs(10);
    assert_eq!(bench.commands.len(), 8);
}

#[test]
fn a_forced_disarm_is_accepted_at_once_and_what_waits_before_it_is_refused() {
    let mut bench = Bench::silent();
    let six: Vec<u8> = (0..6).flat_map(|_| command(ARM, 1.0, 0.0)).collect();
    let messages = bench.job(&[six, command(ARM, 0.0, 21196.0)].concat());
    assert!(bench.killed);
    let results: Vec<_> = messages
        .iter()
        .filter_map(|m| if let MavMessage::COMMAND_ACK(m) = m { Some(m.result as u8) } else { None })
        .collect();
    assert_eq!(results, [0, 1, 1, 1, 1, 1, 1]);
    bench.jobs(10);
    assert!(bench.commands.is_empty(), "an arming of before must not undo it");
}

#[test]
fn unsupported_commands_are_answered_in_both_forms_and_versions() {
    let mut bench = Bench::silent();
    for unsupported in [NAV_WAYPOINT, 0, 40_001, u16::MAX] {
        let int = COMMAND_INT_DATA { target_system: 1, command: unsupported, frame: 99, ..COMMAND_INT_DATA::DEFAULT };
        let mut v1 = MAVLinkV1MessageRaw::new();
        v1.serialize_message_data(STATION, &int);
        for bytes in [command(unsupported, f32::NAN, f32::NAN), frame(&int), v1.raw_bytes().to_vec()] {
            assert_eq!(bench.result_of(&bytes), Some(MavResult::MAV_RESULT_UNSUPPORTED), "{unsupported}");
        }
    }
}

#[test]
fn commands_to_other_systems_are_ignored() {
    let mut bench = Bench::silent();
    for target in [(2, 1), (1, 2), (2, 0), (255, 190), (0, 2)] {
        assert_eq!(bench.result_of(&command_to(target, NAV_WAYPOINT, 0.0, 0.0)), None, "{target:?}");
    }
    for target in [(0, 0), (1, 0), (0, 1), (1, 1)] {
        assert!(bench.result_of(&command_to(target, NAV_WAYPOINT, 0.0, 0.0)).is_some(), "{target:?}");
    }
}

#[test]
fn every_message_of_the_table_comes_on_request() {
    let mut bench = Bench::silent();
    bench.input.health.timing = Some(LoopTiming { inner_hz: 1000, outer_hz: 250, inner_period_us: (999, 1001) });
    for id in [0_u16, 1, 30, 32, 148, 245, 252] {
        let messages = bench.job(&command(REQUEST_MESSAGE, f32::from(id), f32::NAN));
        assert_eq!(count(&messages, 77), 1);
        assert_eq!(count(&messages, id.into()), if id == 252 { 4 } else { 1 }, "message {id}");
    }
    for id in [397.0, 395.0, -1.0, 0.5, f32::NAN, f32::INFINITY] {
        let result = bench.result_of(&command(REQUEST_MESSAGE, id, 0.0));
        assert_eq!(result, Some(MavResult::MAV_RESULT_UNSUPPORTED), "{id}");
    }
    bench.input.health.timing = None;
    let result = bench.result_of(&command(REQUEST_MESSAGE, 252.0, 0.0));
    assert_eq!(result, Some(MavResult::MAV_RESULT_TEMPORARILY_REJECTED));
}

#[test]
fn the_version_lists_only_supported_capabilities() {
    let messages = Bench::silent().job(&command(520, 1.0, 0.0));
    let version = messages.iter().find_map(|m| if let MavMessage::AUTOPILOT_VERSION(m) = m { Some(m) } else { None });
    let version = version.expect("sent");
    assert_eq!(version.capabilities.bits(), 8 | 16 | 8192);
    assert_eq!(version.flight_sw_version & 0xff, 0, "a development version");
}

#[test]
fn intervals_can_be_set_disabled_and_restored() {
    let mut bench = Bench::new();
    for (interval_us, expected) in [(10_000.0, 100), (1.0, 100), (100_000.0, 10), (-1.0, 0), (0.0, 20)] {
        let result = bench.result_of(&command(SET_INTERVAL, 30.0, interval_us));
        assert_eq!(result, Some(MavResult::MAV_RESULT_ACCEPTED));
        let messages = bench.jobs(100);
        assert_eq!(count(&messages, 30), expected, "{interval_us} µs");
    }
    for (id, interval_us, result) in [
        (30.0, -2.0, MavResult::MAV_RESULT_DENIED),
        (30.0, f32::INFINITY, MavResult::MAV_RESULT_DENIED),
        (0.0, -1.0, MavResult::MAV_RESULT_DENIED),
        (28.0, 0.0, MavResult::MAV_RESULT_UNSUPPORTED),
        (435.0, 10_000.0, MavResult::MAV_RESULT_UNSUPPORTED),
    ] {
        assert_eq!(bench.result_of(&command(SET_INTERVAL, id, interval_us)), Some(result), "{id} {interval_us}");
    }
    assert_eq!(count(&bench.jobs(100), 30), 20, "as before");
}

#[test]
fn all_streams_at_once_are_deferred_not_cut() {
    let mut bench = Bench::new();
    bench.input.health.timing = Some(LoopTiming { inner_hz: 1000, outer_hz: 250, inner_period_us: (999, 1001) });
    for id in STREAMED {
        bench.set_interval(id, 10_000.0);
    }
    let flood: Vec<u8> = (0..10).flat_map(|_| command(REQUEST_MESSAGE, 148.0, 0.0)).collect();
    let messages: Vec<_> = (0..200).flat_map(|_| bench.job(&flood)).collect();
    assert!(bench.largest <= SENT_CAPACITY);
    assert_eq!(count(&messages, 0), 2, "the heartbeat gets through");
}

#[test]
fn mission_lists_are_empty_and_time_requests_are_answered() {
    let mut bench = Bench::silent();
    let list = MISSION_REQUEST_LIST_DATA { target_system: 1, target_component: 1, mission_type: 2 };
    let messages = bench.job(&frame(&list));
    let [MavMessage::MISSION_COUNT(mission)] = messages.as_slice() else { panic!("{messages:?}") };
    assert_eq!((mission.count, mission.mission_type, mission.target_system), (0, 2, 255));
    let now = bench.tick;
    let messages = bench.job(&frame(&TIMESYNC_DATA { ts1: 123, ..TIMESYNC_DATA::DEFAULT }));
    let [MavMessage::TIMESYNC(time)] = messages.as_slice() else { panic!("{messages:?}") };
    assert_eq!((time.tc1, time.ts1, time.target_component), (i64::from(now) * 1_000_000, 123, 190));
    assert!(bench.job(&frame(&TIMESYNC_DATA { tc1: 5, ts1: 123, ..TIMESYNC_DATA::DEFAULT })).is_empty());
}

#[test]
fn a_frame_may_come_in_pieces() {
    let bytes = command(NAV_WAYPOINT, 0.0, 0.0);
    for cut in 1..bytes.len() {
        let mut bench = Bench::silent();
        let (first, second) = bytes.split_at(cut);
        assert_eq!(bench.result_of(first), None);
        assert!(bench.result_of(second).is_some(), "cut at {cut}");
    }
}

/// A command with incompatibility flags, and with this many bytes after its checksum.
fn with_flags(flags: u8, trailer: usize) -> Vec<u8> {
    let mut bytes = command(NAV_WAYPOINT, 0.0, 0.0);
    bytes[2] = flags;
    let end = bytes.len() - 2;
    let checksum = calculate_crc(&bytes[1..end], COMMAND_LONG_DATA::EXTRA_CRC);
    bytes[end..].copy_from_slice(&checksum.to_le_bytes());
    bytes.extend(core::iter::repeat_n(0x55, trailer));
    bytes
}

#[test]
fn signed_frames_are_read_and_unknown_flags_are_not() {
    let mut bench = Bench::silent();
    assert!(bench.result_of(&with_flags(1, 13)).is_some());
    assert_eq!(bench.result_of(&with_flags(2, 0)), None);
    assert_eq!(bench.result_of(&with_flags(3, 13)), None);
    assert!(bench.result_of(&command(NAV_WAYPOINT, 0.0, 0.0)).is_some());
}

#[test]
fn a_command_inside_another_message_is_not_executed() {
    // Messages whose payload is a whole frame: an unknown one, and a file's piece that was damaged on the way.
    let inner = command(ARM, 0.0, 21196.0);
    for id in [[0x0f, 0x27, 0], [110, 0, 0]] {
        let mut outer = vec![0xfd, inner.len() as u8, 0, 0, 0, 255, 190];
        outer.extend(id);
        outer.extend(&inner);
        outer.extend([0, 0]);
        for next in [vec![], command(NAV_WAYPOINT, 0.0, 0.0)] {
            let mut bench = Bench::silent();
            bench.job(&[outer.clone(), next].concat());
            bench.jobs(30);
            assert!(!bench.killed, "{id:?}");
        }
    }
}

#[test]
fn a_command_after_half_a_frame_is_executed_in_time() {
    let mut bench = Bench::silent();
    let mut bytes = vec![0xfd, 60, 0, 0, 0, 255, 190, 76, 0, 0, 1, 2, 3];
    bytes.extend(command(NAV_WAYPOINT, 0.0, 0.0));
    bench.job(&bytes);
    let messages = bench.jobs(15);
    assert_eq!(count(&messages, 77), 1, "within 150 ms, where senders wait 500");
}

#[test]
fn extension_fields_are_ignored_and_impossible_lengths_are_no_frame() {
    let with_length = |length: u8| {
        let mut bytes = vec![0xfd, length, 0, 0, 0, 255, 190, 75, 0, 0];
        let int = COMMAND_INT_DATA { target_system: 1, command: NAV_WAYPOINT, ..COMMAND_INT_DATA::DEFAULT };
        let mut payload = vec![1; usize::from(length)];
        int.ser(MavlinkVersion::V2, &mut payload);
        bytes.extend(payload);
        bytes.extend(calculate_crc(&bytes[1..], COMMAND_INT_DATA::EXTRA_CRC).to_le_bytes());
        bytes
    };
    let mut bench = Bench::silent();
    assert!(bench.result_of(&with_length(64)).is_some());
    assert_eq!(bench.result_of(&with_length(65)), None);
}

#[test]
fn the_whole_autopilot_arms_on_command() {
    let mut autopilot = Autopilot::new(&FlightConfig::default()).expect("valid");
    autopilot.ports.first().open(Profile::Normal);
    let sample = SensorFrame::Motion(NavState::at_rest());
    let mut messages = Vec::new();
    let mut sequence = 0;
    for tick in 0..1500 {
        if tick == 100 {
            autopilot.ports.first().receive(&command(ARM, 1.0, 0.0));
        }
        autopilot.tick(Some(&sample));
        let mut sent = [0; SENT_CAPACITY];
        let sent = autopilot.ports.first().take(&mut sent);
        messages.extend(parse(sent, &mut sequence).into_iter().map(|m| (tick, m)));
    }
    let acks: Vec<_> = messages.iter().filter(|(_, m)| m.message_id() == 77).collect();
    let [(answered, MavMessage::COMMAND_ACK(ack))] = acks.as_slice() else { panic!("{acks:?}") };
    assert_eq!(ack.result, MavResult::MAV_RESULT_ACCEPTED);
    assert!(*answered <= 160, "within 60 ms, but at {answered}");
    let last = messages.iter().rev().find_map(|(_, m)| if let MavMessage::HEARTBEAT(m) = m { Some(m) } else { None });
    assert_eq!(last.expect("sent").base_mode & 0x80, 0x80);
}

proptest! {
    #[test]
    fn any_bytes_are_survived_and_then_commands_work(
        bursts in prop::collection::vec(prop::collection::vec(any_byte(), 0..512), 0..20),
    ) {
        let mut bench = Bench::silent();
        for burst in &bursts {
            bench.job(burst);
        }
        bench.jobs(300);
        prop_assert!(bench.result_of(&command(NAV_WAYPOINT, 0.0, 0.0)).is_some());
    }

    #[test]
    fn damaged_streams_are_survived_and_then_commands_work(
        commands in prop::collection::vec((any::<u16>(), any::<f32>(), any::<f32>()), 1..10),
        damage in prop::collection::vec((any::<prop::sample::Index>(), any_byte(), 0..3), 0..20),
    ) {
        let mut bytes: Vec<u8> = commands.iter().flat_map(|(c, p1, p2)| command(*c, *p1, *p2)).collect();
        for (index, byte, kind) in &damage {
            let at = index.index(bytes.len());
            match kind {
                0 => bytes[at] = *byte,
                1 => bytes.insert(at, *byte),
                _ if bytes.len() > 1 => { bytes.remove(at); }
                _ => {}
            }
        }
        let mut bench = Bench::silent();
        for chunk in bytes.chunks(100) {
            bench.job(chunk);
        }
        bench.jobs(300);
        prop_assert!(bench.result_of(&command(NAV_WAYPOINT, 0.0, 0.0)).is_some());
    }
}

/// Random bytes, with frame start markers more frequent than at random.
fn any_byte() -> impl Strategy<Value = u8> {
    prop_oneof![4 => any::<u8>(), 1 => Just(0xfd), 1 => Just(0xfe), 1 => Just(76), 1 => Just(0), 1 => Just(1)]
}
