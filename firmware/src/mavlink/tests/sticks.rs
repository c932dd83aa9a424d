//! Sticks and heartbeats of ground stations: what is taken, what is refused, and what is told about them.

use glissade_dialect::{HEARTBEAT_DATA, MANUAL_CONTROL_DATA, RC_CHANNELS_DATA, RC_CHANNELS_OVERRIDE_DATA};

use super::*;
use crate::latest::{Stamped, Sticks};
use crate::mavlink::radio::{Channels, PulseUs};
use crate::settings::{COM_RC_IN_MODE, COM_RC_LOSS_T, RC_MAP_KILL_SW, Value};

/// The bit of `SYS_STATUS`.
const RC_RECEIVER: u32 = 65_536;

const JOYSTICK: MANUAL_CONTROL_DATA =
    MANUAL_CONTROL_DATA { target: 1, x: 500, y: -250, z: 750, r: 100, buttons: 0x8001 };
/// Everything ignored.
pub(super) const OVERRIDE: RC_CHANNELS_OVERRIDE_DATA = RC_CHANNELS_OVERRIDE_DATA {
    target_system: 1,
    target_component: 1,
    chan1_raw: u16::MAX,
    chan2_raw: u16::MAX,
    chan3_raw: u16::MAX,
    chan4_raw: u16::MAX,
    chan5_raw: u16::MAX,
    chan6_raw: u16::MAX,
    chan7_raw: u16::MAX,
    chan8_raw: u16::MAX,
    ..RC_CHANNELS_OVERRIDE_DATA::DEFAULT
};

fn read(bench: &mut Bench, message: &impl MessageData) -> Option<Stamped<Sticks>> {
    bench.output_of(&frame(message)).0.latest.sticks
}

fn read_channels(bench: &mut Bench, message: &impl MessageData) -> Option<Channels> {
    bench.job(&frame(message));
    held(bench)
}

/// The channels that are not lost.
fn held(bench: &Bench) -> Option<Channels> {
    bench.ground.hands.channels_within(bench.tick - GROUND.period, 0.5).copied()
}

fn channels(bench: &mut Bench, message: &RC_CHANNELS_OVERRIDE_DATA) -> Vec<u16> {
    let channels = read_channels(bench, message).expect("channels");
    channels.iter().map(|channel| channel.map_or(0, PulseUs::get)).collect()
}

#[test]
fn a_joysticks_axes_have_the_signs_of_rotations_in_the_body_frame() {
    let mut bench = Bench::silent();
    let (now, sticks) = (bench.tick, read(&mut bench, &JOYSTICK).expect("sticks"));
    assert_eq!(sticks.at, now);
    let Sticks { roll, pitch, yaw, throttle, buttons, .. } = sticks.value;
    // Forward, left, throttle, right.
    assert_eq!((pitch, roll, throttle, yaw), (0.5, -0.25, 0.75, -0.1));
    assert_eq!(buttons, 0x8001);
    let output = bench.output_of(&[]).0;
    assert_eq!(output.latest.sticks, Some(sticks), "it stays, and keeps its time");
}

#[test]
fn full_axes_are_taken_a_missing_one_is_centred_and_a_message_out_of_range_is_refused() {
    let mut bench = Bench::silent();
    let full = MANUAL_CONTROL_DATA { x: -1000, y: 1000, z: 0, r: -1000, ..JOYSTICK };
    let sticks = read(&mut bench, &full).expect("sticks");
    let Sticks { roll, pitch, yaw, throttle, .. } = sticks.value;
    assert_eq!((pitch, roll, throttle, yaw), (-1.0, 1.0, 0.0, 1.0));
    for (x, y, z, r) in [(1001, 0, 0, 0), (0, -1001, 0, 0), (0, 0, -1, 0), (0, 0, 1001, 0), (0, 0, 0, i16::MIN)] {
        let message = MANUAL_CONTROL_DATA { x, y, z, r, ..JOYSTICK };
        assert_eq!(read(&mut bench, &message), Some(sticks), "{message:?} changes nothing");
    }
    let partly = MANUAL_CONTROL_DATA { x: i16::MAX, z: i16::MAX, ..JOYSTICK };
    let sticks = read(&mut bench, &partly).expect("sticks").value;
    assert_eq!((sticks.pitch, sticks.throttle, sticks.roll), (0.0, 0.5, -0.25));
}

#[test]
fn sticks_for_others_and_for_everyone_are_ignored() {
    let mut bench = Bench::silent();
    for target in [0, 2, 255] {
        assert_eq!(read(&mut bench, &MANUAL_CONTROL_DATA { target, ..JOYSTICK }), None);
    }
    for (target_system, target_component) in [(0, 0), (2, 1), (1, 2)] {
        let message = RC_CHANNELS_OVERRIDE_DATA { target_system, target_component, chan1_raw: 1500, ..OVERRIDE };
        assert_eq!(read_channels(&mut bench, &message), None);
    }
}

#[test]
fn channels_are_set_kept_released_and_refused_one_by_one() {
    let mut bench = Bench::silent();
    assert_eq!(read_channels(&mut bench, &OVERRIDE), None, "it says nothing");
    let some = RC_CHANNELS_OVERRIDE_DATA { chan1_raw: 1000, chan3_raw: 2000, chan18_raw: 1700, ..OVERRIDE };
    let mut expected = [0; 18];
    (expected[0], expected[2], expected[17]) = (1000, 2000, 1700);
    assert_eq!(channels(&mut bench, &some), expected);
    // The first eight are released by 0; the others ignore that, and have a number of their own.
    expected[2] = 0;
    assert_eq!(channels(&mut bench, &RC_CHANNELS_OVERRIDE_DATA { chan3_raw: 0, ..OVERRIDE }), expected);
    for wrong in [1, 799, 2201, 40_000, u16::MAX - 1] {
        let before = held(&bench);
        let message = RC_CHANNELS_OVERRIDE_DATA { chan1_raw: 1200, chan2_raw: wrong, ..OVERRIDE };
        assert_eq!(read_channels(&mut bench, &message), before, "{wrong} µs");
    }
    expected[17] = 0;
    assert_eq!(channels(&mut bench, &RC_CHANNELS_OVERRIDE_DATA { chan18_raw: u16::MAX - 1, ..OVERRIDE }), expected);
    let released = RC_CHANNELS_OVERRIDE_DATA { chan1_raw: 0, ..OVERRIDE };
    assert_eq!(read_channels(&mut bench, &released), None, "the last one");
    // A joystick's sticks are not let go of by another's channels.
    let joystick = read(&mut bench, &JOYSTICK);
    assert!(joystick.is_some());
    assert_eq!(read(&mut bench, &released), joystick);
}

#[test]
fn a_channel_that_was_lost_is_not_kept() {
    let mut bench = Bench::silent();
    channels(&mut bench, &RC_CHANNELS_OVERRIDE_DATA { chan1_raw: 1100, ..OVERRIDE });
    bench.jobs(60);
    let mut expected = [0; 18];
    expected[1] = 1200;
    assert_eq!(channels(&mut bench, &RC_CHANNELS_OVERRIDE_DATA { chan2_raw: 1200, ..OVERRIDE }), expected);
    // Nor is one kept alive by another that goes on.
    (expected[1], expected[2]) = (0, 1300);
    for _ in 0..60 {
        bench.job(&frame(&RC_CHANNELS_OVERRIDE_DATA { chan3_raw: 1300, ..OVERRIDE }));
    }
    assert_eq!(channels(&mut bench, &RC_CHANNELS_OVERRIDE_DATA { chan3_raw: 1300, ..OVERRIDE }), expected);
}

#[test]
fn of_two_joysticks_and_of_two_radios_the_first_counts_until_it_is_lost() {
    // Both of a station, with a roll in thousandths and a pulse.
    let station = |system_id: u32, y: i16, chan1_raw: u16| {
        let header = MavHeader { system_id, ..STATION };
        let joystick = frame_from(header, &MANUAL_CONTROL_DATA { y, ..JOYSTICK });
        [joystick, frame_from(header, &RC_CHANNELS_OVERRIDE_DATA { chan1_raw, ..OVERRIDE })].concat()
    };
    let mut bench = Bench::silent();
    for job in 0..120 {
        // The first one goes on for half a second.
        let mut bytes = Vec::new();
        if job < 50 {
            bytes.extend(station(255, 100, 1100));
        }
        if job > 0 {
            bytes.extend(station(254, 200, 1200));
        }
        let latest = bench.output_of(&bytes).0.latest;
        let (sticks, channels) = (latest.sticks.expect("sticks").value, held(&bench).expect("channels"));
        let moved = ((sticks.roll * 1000.0) as i16, channels[0].map_or(0, PulseUs::get));
        // Half of COM_RC_LOSS_T, 0.5 s.
        assert_eq!(moved, if job <= 49 + 25 { (100, 1100) } else { (200, 1200) }, "job {job}");
    }
}

#[test]
fn a_kill_switch_of_any_radio_counts_whoever_moves_the_vehicle() {
    let from = |system_id: u32| MavHeader { system_id, ..STATION };
    let radio = |system_id, switch: u16| {
        frame_from(from(system_id), &RC_CHANNELS_OVERRIDE_DATA { chan1_raw: 1500, chan5_raw: switch, ..OVERRIDE })
    };
    let joystick = || frame_from(from(254), &JOYSTICK);
    for (leads, sources, counts) in
        [(joystick(), 3, true), (joystick(), 1, false), (radio(253, 1000), 3, true), (Vec::new(), 3, true)]
    {
        let mut bench = Bench::silent();
        bench.ground.settings.set(RC_MAP_KILL_SW, Value::Int(5), false).expect("a channel");
        bench.ground.settings.set(COM_RC_IN_MODE, Value::Int(sources), false).expect("a mode");
        let mut kills = Vec::new();
        for job in 0..20 {
            let switch = if (5..15).contains(&job) { 2000 } else { 1000 };
            // Every second job: what leads says nothing of that switch, or that its own is off.
            let bytes = if job % 2 == 0 { leads.clone() } else { radio(255, switch) };
            let output = bench.output_of(&bytes).0;
            kills.extend(output.kill.then_some(job));
            if leads.len() != radio(253, 1000).len() {
                // No arming, and no motor test, while it is on.
                assert_eq!(output.latest.kill_switch, counts && (5..15).contains(&job), "{job}");
            }
        }
        assert_eq!(kills.first(), counts.then_some(&5), "{sources}: {kills:?}");
    }
}

#[test]
fn a_frame_without_the_added_channels_ignores_them() {
    let mut bench = Bench::silent();
    let mut v1 = MAVLinkV1MessageRaw::new();
    v1.serialize_message_data(STATION, &RC_CHANNELS_OVERRIDE_DATA { chan8_raw: 1800, ..OVERRIDE });
    bench.job(v1.raw_bytes());
    let channels = held(&bench).expect("channels");
    assert_eq!(channels.iter().flatten().copied().map(PulseUs::get).collect::<Vec<_>>(), [1800]);
}

/// The channels told in a second, and present and healthy in the last `SYS_STATUS`.
fn told(bench: &mut Bench, seconds: u32) -> (Vec<RC_CHANNELS_DATA>, (bool, bool)) {
    let messages = bench.jobs(100 * seconds);
    let rows = messages.iter().filter_map(|m| if let MavMessage::RC_CHANNELS(m) = m { Some(m.clone()) } else { None });
    let status = messages.iter().rev().find_map(|m| if let MavMessage::SYS_STATUS(m) = m { Some(m) } else { None });
    let status = status.expect("sent");
    let bits = (status.onboard_control_sensors_present.bits(), status.onboard_control_sensors_health.bits());
    (rows.collect(), (bits.0 & RC_RECEIVER != 0, bits.1 & RC_RECEIVER != 0))
}

#[test]
fn channels_are_told_while_they_are_there_and_their_loss_is_a_sensors() {
    let mut bench = Bench::new();
    assert_eq!(told(&mut bench, 2), (vec![], (false, false)), "nothing without sticks");
    bench.ground.settings.set(COM_RC_LOSS_T, Value::Real(1.2), false).expect("settable");
    bench.job(&frame(&RC_CHANNELS_OVERRIDE_DATA { chan1_raw: 1100, chan4_raw: 1900, ..OVERRIDE }));
    let (rows, status) = told(&mut bench, 1);
    assert_eq!((rows.len(), status), (2, (true, true)));
    let RC_CHANNELS_DATA { chancount, chan1_raw, chan2_raw, chan4_raw, chan5_raw, rssi, .. } = rows[0].clone();
    assert_eq!((chancount, rssi), (4, 255));
    assert_eq!([chan1_raw, chan2_raw, chan4_raw, chan5_raw], [1100, u16::MAX, 1900, u16::MAX]);
    let (rows, status) = told(&mut bench, 2);
    assert!(rows.len() < 2, "lost after 1.2 s");
    assert_eq!(status, (true, false));
    assert_eq!(told(&mut bench, 1).0, []);
    bench.job(&frame(&JOYSTICK));
    let status = bench.job(&command(REQUEST_MESSAGE, RC_CHANNELS_DATA::ID as f32, 0.0));
    assert!(!status.iter().any(|m| matches!(m, MavMessage::RC_CHANNELS(_))), "a joystick has no channels");
}

#[test]
fn a_ground_station_is_heard_by_its_heartbeat_alone() {
    let mut bench = Bench::silent();
    let beat = |mavtype| frame(&HEARTBEAT_DATA { mavtype, ..HEARTBEAT_DATA::DEFAULT });
    for received in [beat(2), beat(18), command(ARM, 1.0, 0.0), frame(&JOYSTICK)] {
        assert_eq!(bench.output_of(&received).0.latest.station, None);
    }
    let now = bench.tick;
    assert_eq!(bench.output_of(&beat(6)).0.latest.station, Some(now));
    assert_eq!(bench.output_of(&beat(2)).0.latest.station, Some(now));
}

#[test]
fn a_kill_switch_stays_on_when_the_radio_is_lost() {
    let mut bench = Bench::silent();
    bench.ground.settings.set(RC_MAP_KILL_SW, Value::Int(5), false).expect("a channel");
    let on = frame(&RC_CHANNELS_OVERRIDE_DATA { chan5_raw: 2000, ..OVERRIDE });
    let mut kills = Vec::new();
    for job in 0..200 {
        let bytes = if (50..150).contains(&job) { Vec::new() } else { on.clone() };
        let output = bench.output_of(&bytes).0;
        kills.extend(output.kill.then_some(job));
        assert!(output.latest.kill_switch, "{job}");
    }
    assert_eq!(kills, [0]);
    // The ground station lets go of the channel.
    let released = bench.output_of(&frame(&RC_CHANNELS_OVERRIDE_DATA { chan5_raw: 0, ..OVERRIDE })).0;
    assert!(!released.latest.kill_switch);
}
