//! Who the vehicle is and what it can do: versions, capabilities, modes.

use glissade_dialect::mavlink_core::types::CharArray;
use glissade_dialect::{
    AUTOPILOT_VERSION_DATA, AVAILABLE_MODES_DATA, CURRENT_MODE_DATA, MavAutopilot, MavProtocolCapability,
    PROTOCOL_VERSION_DATA,
};

use super::view::View;
use crate::commander::Mode;
use crate::mavlink::mode;

/// Values of `MAV_STANDARD_MODE`.
const NON_STANDARD: u8 = 0;
const POSITION_HOLD: u8 = 1;
const ORBIT: u8 = 2;
const ALTITUDE_HOLD: u8 = 4;
const SAFE_RECOVERY: u8 = 5;
const MISSION: u8 = 6;
const LAND: u8 = 7;
const TAKE_OFF: u8 = 8;
/// Bits of `MAV_MODE_PROPERTY`.
const ADVANCED: u32 = 1;
const NOT_USER_SELECTABLE: u32 = 2;
const AUTO_MODE: u32 = 4;

/// A mode as ground stations list it.
struct Listed {
    /// One of the modes that have its `custom_mode`.
    mode: Mode,
    standard_mode: u8,
    properties: u32,
    name: &'static str,
}

/// The modes of `AVAILABLE_MODES`, numbered from 1.
const LISTED: [Listed; 11] = [
    Listed { mode: Mode::TakeOff, standard_mode: TAKE_OFF, properties: AUTO_MODE, name: "Takeoff" },
    Listed { mode: Mode::Hold, standard_mode: NON_STANDARD, properties: AUTO_MODE, name: "Hold" },
    Listed { mode: Mode::Follow, standard_mode: MISSION, properties: AUTO_MODE, name: "Mission" },
    Listed { mode: Mode::Return, standard_mode: SAFE_RECOVERY, properties: AUTO_MODE, name: "Return" },
    Listed { mode: Mode::Land, standard_mode: LAND, properties: AUTO_MODE, name: "Land" },
    Listed { mode: Mode::Position, standard_mode: POSITION_HOLD, properties: 0, name: "Position" },
    Listed { mode: Mode::Altitude, standard_mode: ALTITUDE_HOLD, properties: 0, name: "Altitude" },
    Listed { mode: Mode::Stabilized, standard_mode: NON_STANDARD, properties: 0, name: "Stabilized" },
    Listed { mode: Mode::Acro, standard_mode: NON_STANDARD, properties: ADVANCED, name: "Acro" },
    Listed { mode: Mode::Orbit, standard_mode: ORBIT, properties: NOT_USER_SELECTABLE, name: "Orbit" },
    Listed { mode: Mode::Offboard, standard_mode: NON_STANDARD, properties: 0, name: "Offboard" },
];

/// The number of modes.
pub(in crate::mavlink) const MODES: u8 = LISTED.len() as u8;

/// The mode with this number, from 1.
pub(super) fn available_mode(number: u8) -> Option<AVAILABLE_MODES_DATA> {
    let Listed { mode, standard_mode, properties, name } = LISTED.get(usize::from(number.checked_sub(1)?))?;
    let mut mode_name = [0; 35];
    for (to, from) in mode_name.iter_mut().zip(name.bytes()) {
        *to = from;
    }
    Some(AVAILABLE_MODES_DATA {
        number_modes: MODES,
        mode_index: number,
        standard_mode: *standard_mode,
        custom_mode: mode::custom_mode(*mode),
        properties: *properties,
        mode_name: CharArray::new(mode_name),
    })
}

/// The `custom_mode` of a standard mode; `None` if the vehicle does not have it.
pub(in crate::mavlink) fn of_standard_mode(number: u8) -> Option<u32> {
    let listed = LISTED.iter().find(|listed| {
        listed.standard_mode == number && number != NON_STANDARD && listed.properties & NOT_USER_SELECTABLE == 0
    })?;
    Some(mode::custom_mode(listed.mode))
}

/// The mode now. It is also the one that was asked for last, unless a failure has overridden that: 0, unknown.
pub(super) fn current_mode(view: &View) -> CURRENT_MODE_DATA {
    let custom_mode = mode::custom_mode(view.input.mode);
    let listed = LISTED.iter().find(|listed| mode::custom_mode(listed.mode) == custom_mode);
    CURRENT_MODE_DATA {
        standard_mode: listed.map_or(NON_STANDARD, |listed| listed.standard_mode),
        custom_mode,
        intended_custom_mode: 0,
    }
}

/// Version and capabilities. Who tells that it is PX4 tells the version of PX4 whose interface it has: ground stations refuse
/// versions below 1.4.1. Our own stands as the middleware's. The hardware has no number of its own: `uid` is 0, unknown.
pub(super) fn autopilot_version(view: &View) -> AUTOPILOT_VERSION_DATA {
    let as_px4 = view.us.autopilot == MavAutopilot::MAV_AUTOPILOT_PX4 as u8;
    AUTOPILOT_VERSION_DATA {
        capabilities: MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_COMMAND_INT
            | MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE
            | MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_MAVLINK2,
        flight_sw_version: if as_px4 { PX4_INTERFACE } else { SOFTWARE_VERSION },
        middleware_sw_version: SOFTWARE_VERSION,
        ..AUTOPILOT_VERSION_DATA::DEFAULT
    }
}

/// MAVLink 1 and 2 are understood. The hashes of specification and library are unknown: zeros.
pub(super) fn protocol_version() -> PROTOCOL_VERSION_DATA {
    PROTOCOL_VERSION_DATA { version: 200, min_version: 100, max_version: 200, ..PROTOCOL_VERSION_DATA::DEFAULT }
}

/// PX4's modes, parameters and messages as of v1.15: major, minor, patch, and 0 for a development version.
const PX4_INTERFACE: u32 = 1 << 24 | 15 << 16;

/// This crate's version: major, minor, patch, and 0 for a development version. QGroundControl compares the
/// version of any other type with PX4's.
const SOFTWARE_VERSION: u32 = decimal(env!("CARGO_PKG_VERSION_MAJOR")) << 24
    | decimal(env!("CARGO_PKG_VERSION_MINOR")) << 16
    | decimal(env!("CARGO_PKG_VERSION_PATCH")) << 8;

const fn decimal(text: &str) -> u32 {
    match u8::from_str_radix(text, 10) {
        Ok(number) => number as u32,
        Err(_) => 0,
    }
}
