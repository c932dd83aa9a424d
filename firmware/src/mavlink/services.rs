//! Services that ground stations ask for and the vehicle does not have: missions, files, logs, extended parameters, consoles. Each is answered at once,
//! because a client that is not answered waits for seconds, and then again.

use glissade_dialect::mavlink_core::types::CharArray;
use glissade_dialect::{
    FILE_TRANSFER_PROTOCOL_DATA, LOG_ENTRY_DATA, MISSION_ACK_DATA, MISSION_COUNT_DATA, MISSION_CURRENT_DATA,
    MavMissionResult, PARAM_EXT_ACK_DATA, PARAM_EXT_VALUE_DATA, SERIAL_CONTROL_DATA,
};

use super::incoming::{ExtendedRequest, FileRequest, MissionRequest, Sender};
use super::writer::Writer;

/// Answers a message of the mission protocol: every list is empty, and takes no items. False if it does not fit.
pub(super) fn write_mission(request: MissionRequest, mission_type: u8, to: Sender, out: &mut Writer) -> bool {
    let (target_system, target_component) = to;
    let result = match request {
        MissionRequest::List => {
            return out.write(&MISSION_COUNT_DATA { target_system, target_component, count: 0, mission_type });
        }
        MissionRequest::SetCurrent => {
            // There is no mission, and so no number of its items.
            let current = MISSION_CURRENT_DATA { total: u16::MAX, mission_state: 1, ..MISSION_CURRENT_DATA::DEFAULT };
            return out.write(&current);
        }
        MissionRequest::Clear => MavMissionResult::MAV_MISSION_ACCEPTED,
        MissionRequest::Item => MavMissionResult::MAV_MISSION_INVALID_SEQUENCE,
        MissionRequest::Upload | MissionRequest::Part => MavMissionResult::MAV_MISSION_UNSUPPORTED,
    };
    out.write(&MISSION_ACK_DATA { target_system, target_component, mavtype: result as u8, mission_type })
}

/// Operations and errors of the file transfer protocol.
mod file {
    pub(super) const TERMINATE: u8 = 1;
    pub(super) const RESET: u8 = 2;
    pub(super) const LIST: u8 = 3;
    pub(super) const OPEN_TO_READ: u8 = 4;
    pub(super) const CHECKSUM: u8 = 14;
    pub(super) const ACK: u8 = 128;
    pub(super) const NAK: u8 = 129;
    pub(super) const END_OF_FILE: u8 = 6;
    pub(super) const UNKNOWN_COMMAND: u8 = 7;
    pub(super) const NOT_FOUND: u8 = 10;
}

/// Answers a request for files: there are none. False if it does not fit.
pub(super) fn write_file(request: FileRequest, to: Sender, out: &mut Writer) -> bool {
    let error = match request.opcode {
        // No session is open, so it is closed.
        file::TERMINATE | file::RESET => None,
        file::LIST => Some(file::END_OF_FILE),
        file::OPEN_TO_READ | file::CHECKSUM => Some(file::NOT_FOUND),
        _ => Some(file::UNKNOWN_COMMAND),
    };
    let (target_system, target_component) = to;
    let mut message =
        FILE_TRANSFER_PROTOCOL_DATA { target_system, target_component, ..FILE_TRANSFER_PROTOCOL_DATA::DEFAULT };
    let [low, high] = request.sequence.wrapping_add(1).to_le_bytes();
    let opcode = if error.is_some() { file::NAK } else { file::ACK };
    // Sequence, session, operation, size, the operation that is answered, three bytes that are not used and the offset.
    let header = [low, high, request.session, opcode, u8::from(error.is_some()), request.opcode, 0, 0, 0, 0, 0, 0];
    for (to, from) in message.payload.iter_mut().zip(header.into_iter().chain(error)) {
        *to = from;
    }
    out.write(&message)
}

/// Flag of `SERIAL_CONTROL`: an answer.
pub(super) const SERIAL_REPLY: u8 = 1;

/// Answers a serial console's message: nothing was read. False if it does not fit.
pub(super) fn write_no_serial(device: u8, out: &mut Writer) -> bool {
    out.write(&SERIAL_CONTROL_DATA { device, flags: SERIAL_REPLY, ..SERIAL_CONTROL_DATA::DEFAULT })
}

/// `PARAM_ACK_FAILED`.
const FAILED: u8 = 2;

/// Answers a request for extended parameters: there are none. False if it does not fit.
pub(super) fn write_no_extended_params(request: &ExtendedRequest, out: &mut Writer) -> bool {
    match *request {
        ExtendedRequest::List => out.write(&PARAM_EXT_VALUE_DATA::DEFAULT),
        ExtendedRequest::Read { name } => {
            out.write(&PARAM_EXT_VALUE_DATA { param_id: CharArray::new(name), ..PARAM_EXT_VALUE_DATA::DEFAULT })
        }
        ExtendedRequest::Set { name, kind } => out.write(&PARAM_EXT_ACK_DATA {
            param_id: CharArray::new(name),
            param_type: kind,
            param_result: FAILED,
            ..PARAM_EXT_ACK_DATA::DEFAULT
        }),
    }
}

/// Answers a request for logs: there are none. False if it does not fit.
pub(super) fn write_no_logs(out: &mut Writer) -> bool {
    out.write(&LOG_ENTRY_DATA::DEFAULT)
}
