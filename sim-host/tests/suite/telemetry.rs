//! Telemetry of whole flights, decoded and judged by the truth.

use firmware::mavlink::port::{Profile, SENT_CAPACITY};
use glissade_dialect::mavlink_core::{MAVLinkV2MessageRaw, MavHeader, MavlinkVersion, Message as _};
use glissade_dialect::{COMMAND_LONG_DATA, MavMessage};
use nalgebra::Vector3;
use sim_host::flight;
use sim_host::geodesy::{LocalFrame, Place};
use sim_host::plant::Plant as _;
use sim_host::plant::rigid_body::RigidBody;
use sim_host::sensors::gnss::START_UTC_US;
use sim_host::sil::{Flight, Lockstep as _};

use crate::common::load::load;

const ARM: u16 = 400;
const TAKEOFF: u16 = 22;
const SET_INTERVAL: u16 = 511;

fn command(command: u16, param1: f32, param2: f32, param7: f32) -> Vec<u8> {
    let (target_system, target_component) = (1, 1);
    let message = COMMAND_LONG_DATA {
        target_system,
        target_component,
        command,
        param1,
        param2,
        param7,
        ..COMMAND_LONG_DATA::DEFAULT
    };
    let mut raw = MAVLinkV2MessageRaw::new();
    raw.serialize_message_data(MavHeader { system_id: 255, component_id: 190, sequence: 0 }, &message);
    raw.raw_bytes().to_vec()
}

/// The messages in whole frames.
fn decode(mut bytes: &[u8]) -> Vec<MavMessage> {
    let mut messages = Vec::new();
    while let Some(length) = bytes.get(1).map(|length| usize::from(*length)) {
        let id = u32::from_le_bytes([bytes[7], bytes[8], bytes[9], 0]);
        messages.push(MavMessage::parse(MavlinkVersion::V2, id, &bytes[10..10 + length]).expect("a known message"));
        bytes = &bytes[12 + length..];
    }
    messages
}

/// A flight that a ground station has taken off 10 m, with a look at every message. A message is published 6 ms after its
/// time.
fn fly(scenario: &str, ticks: u32, mut look: impl FnMut(&Flight<RigidBody>, MavMessage)) {
    // The ellipsoid is 47 m below the sea, as in Zurich.
    let scenario = load(scenario, &["home.height_m=535.0", "home.geoid_m=47.0"]);
    let mut flight = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("valid");
    flight.autopilot.ports.first().open(Profile::Normal);
    for tick in 0..ticks {
        let bytes = match tick {
            100 => command(SET_INTERVAL, 331.0, 50_000.0, 0.0),
            5_000 => command(ARM, 1.0, 0.0, 0.0),
            5_500 => command(TAKEOFF, 0.0, 0.0, 10.0),
            _ => Vec::new(),
        };
        flight.autopilot.ports.first().receive(&bytes);
        assert!(flight.step(&mut ()));
        let mut sent = [0; SENT_CAPACITY];
        let sent = flight.autopilot.ports.first().take(&mut sent).to_vec();
        for message in decode(&sent) {
            look(&flight, message);
        }
    }
}

#[test]
fn the_place_on_earth_is_the_true_one_within_the_estimators_error() {
    // As a place whose heights are those above the sea.
    let home = load("field", &[]).file.home;
    let frame = LocalFrame::at(&home.place());
    let (mut told, mut worst, mut highest) = (0, Vector3::<f64>::zeros(), f64::MIN);
    let mut homes = Vec::new();
    fly("field", 25_000, |flight, message| match message {
        MavMessage::GLOBAL_POSITION_INT(m) => {
            let place = Place::from_degrees(f64::from(m.lat) * 1e-7, f64::from(m.lon) * 1e-7, f64::from(m.alt) * 1e-3);
            let off = frame.position(&place) - flight.plant().motion().position;
            worst = worst.zip_map(&off, |worst, off| worst.max(off.abs()));
            highest = highest.max(f64::from(m.relative_alt) * 1e-3);
            told += 1;
            // The velocity is the true one within 0.5 m/s.
            let v = flight.plant().motion().velocity;
            assert!((f64::from(m.vx) - 100.0 * v.x).abs() < 50.0 && (f64::from(m.vz) + 100.0 * v.z).abs() < 50.0);
        }
        MavMessage::HOME_POSITION(m) => homes.push((flight.next_tick(), m)),
        MavMessage::SYSTEM_TIME(m) if m.time_unix_usec != 0 => {
            assert_eq!(m.time_unix_usec, START_UTC_US + u64::from(m.time_boot_ms) * 1_000);
        }
        _ => {}
    });
    assert!(told > 90, "{told} in some 20 s at 5 Hz");
    // The first fix, 1.5 m of drift and noise per axis and 2.5 m in height, is the origin: three times that.
    assert!(worst.x < 4.5 && worst.y < 4.5 && worst.z < 7.5, "{worst}");
    assert!((highest - 10.0).abs() < 1.0, "{highest} m over home");
    // Home is told before arming, on the ground where the vehicle stands, well above the sea.
    let (at, first) = &homes[0];
    assert!(*at < 5_000, "{at}");
    assert!((first.altitude - 488_000).abs() < 8_000, "{first:?}");
    assert!(first.x.abs() < 0.5 && first.y.abs() < 0.5 && first.z.abs() < 0.5, "{first:?}");
}

#[test]
fn odometry_tells_errors_of_the_size_that_it_makes() {
    let (mut told, mut outside) = (0, 0);
    fly("indoor-hover", 8_000, |flight, message| {
        let MavMessage::ODOMETRY(m) = message else { return };
        let p = flight.plant().motion().position;
        let off = f64::from(m.x) - p.x;
        // Ten milliseconds late at walking pace: a few centimetres beside the deviation.
        let sigma = f64::from(m.pose_covariance[0]).sqrt();
        assert!(sigma > 0.0 && sigma < 1.0, "{sigma}");
        told += 1;
        outside += u32::from(off.abs() > 4.0 * sigma + 0.05);
    });
    assert!(told > 100 && outside * 50 < told, "{outside} of {told} beyond four deviations");
}

/// Before the estimator knows where the vehicle is, nothing about its position is told.
#[test]
fn what_is_not_known_yet_is_not_told() {
    let mut first = [None; 3];
    fly("field", 4_000, |flight, message| {
        let slot = match message {
            MavMessage::ATTITUDE(_) => 0,
            MavMessage::LOCAL_POSITION_NED(_) => 1,
            MavMessage::GLOBAL_POSITION_INT(_) => 2,
            _ => return,
        };
        first[slot].get_or_insert(flight.next_tick());
        let health = flight.autopilot.inner.nav_health();
        assert!(health.attitude && (slot == 0 || health.position));
    });
    let [attitude, local, global] = first.map(|tick| tick.expect("told"));
    // Aligning takes a second.
    assert!(attitude >= 1_000 && local > 1_000 && global >= local, "{first:?}");
}
