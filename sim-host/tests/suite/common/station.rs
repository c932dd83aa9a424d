//! What ground stations send in a flight for tests.

use firmware::mavlink::port::Profile;
use firmware::signals::Tick;
use glissade_dialect::mavlink_core::{MAVLinkV2MessageRaw, MavHeader, MessageData};
use glissade_dialect::{COMMAND_LONG_DATA, HEARTBEAT_DATA, MavCmd};
use sim_host::sil::replay::{Entry, Input, OnLink};

/// A frame of a ground station.
pub(crate) fn frame(sequence: u8, message: &impl MessageData) -> Vec<u8> {
    let mut raw = MAVLinkV2MessageRaw::new();
    raw.serialize_message_data(MavHeader { system_id: 255, component_id: 190, sequence }, message);
    raw.raw_bytes().to_vec()
}

/// `COMMAND_LONG`, with its first three parameters and its last.
pub(crate) fn command(command: MavCmd, [param1, param2, param3, param7]: [f32; 4]) -> COMMAND_LONG_DATA {
    let command = command as u16;
    COMMAND_LONG_DATA { command, param1, param2, param3, param7, target_system: 1, ..COMMAND_LONG_DATA::DEFAULT }
}

/// A flight by two ground stations, with junk between their frames and frames in pieces: arms, takes off to 3 m, holds,
/// goes back, and lands. `ready_s` is when it can be armed. One station asks for a fast telemetry, goes, and comes again;
/// both send heartbeats; a barometer is made to fail, which is refused on ideal state.
pub(crate) fn flight_by_two(ready_s: f64) -> Vec<Entry> {
    let at = |seconds: f64| ((ready_s + seconds) * 1e3) as Tick;
    let mut entries = vec![on(0, 0, OnLink::Open(Profile::Normal)), on(5, 1, OnLink::Open(Profile::Onboard))];
    let commands = [
        (at(-0.3), 1, command(MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL, [30.0, 5_000.0, 0.0, 0.0])),
        (at(-0.2), 0, command(MavCmd::MAV_CMD_REQUEST_MESSAGE, [148.0, 0.0, 0.0, 0.0])),
        (at(0.0), 0, command(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0, 0.0, 0.0])),
        (at(0.5), 1, command(MavCmd::MAV_CMD_NAV_TAKEOFF, [0.0, 0.0, 0.0, 3.0])),
        (at(4.0), 1, command(MavCmd::MAV_CMD_INJECT_FAILURE, [3.0, 1.0, 0.0, 0.0])),
        (at(6.0), 0, command(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, 4.0, 3.0, 0.0])),
        (at(6.003), 0, command(MavCmd::MAV_CMD_REQUEST_MESSAGE, [9_999.0, 0.0, 0.0, 0.0])),
        (at(6.5), 1, command(MavCmd::MAV_CMD_INJECT_FAILURE, [3.0, 0.0, 0.0, 0.0])),
        (at(8.0), 1, command(MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH, [0.0; 4])),
        (at(12.0), 0, command(MavCmd::MAV_CMD_NAV_LAND, [0.0; 4])),
    ];
    for (sequence, (tick, link, command)) in (0..).zip(commands) {
        let bytes = [b"junk \xfd\x03".to_vec(), frame(sequence, &command)].concat();
        // The rest comes a tick later.
        let (first, rest) = bytes.split_at(20);
        entries.extend([received(tick, link, first), received(tick + 1, link, rest)]);
    }
    for (sequence, second) in (0..).zip(1..20) {
        let heartbeat = frame(sequence, &HEARTBEAT_DATA::DEFAULT);
        // Long enough for several frames to the image before a tick.
        let long = [heartbeat.clone(), vec![0x55; 300], heartbeat].concat();
        entries.extend((0..2).map(|link| received(second * 1000 + 7, link, &long)));
    }
    entries.push(on(at(9.0), 1, OnLink::Close));
    entries.push(on(at(9.5), 1, OnLink::Open(Profile::Normal)));
    entries.push(on(at(9.5), 1, OnLink::Lost(17)));
    entries.sort_by_key(|entry| entry.tick);
    entries
}

fn on(tick: Tick, link: usize, event: OnLink) -> Entry {
    Entry { tick, input: Input::Link { link, event } }
}

fn received(tick: Tick, link: usize, bytes: &[u8]) -> Entry {
    on(tick, link, OnLink::Received(bytes.to_vec()))
}
