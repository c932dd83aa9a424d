//! The messages that the vehicle understands: how each is decoded, and whether it is for this vehicle.

use glissade_dialect::mavlink_core::{MavlinkVersion, MessageData, consts};
use glissade_dialect::{
    COMMAND_INT_DATA, COMMAND_LONG_DATA, FILE_TRANSFER_PROTOCOL_DATA, HEARTBEAT_DATA, LOG_REQUEST_DATA_DATA,
    LOG_REQUEST_LIST_DATA, MANUAL_CONTROL_DATA, MISSION_CLEAR_ALL_DATA, MISSION_COUNT_DATA, MISSION_ITEM_DATA,
    MISSION_ITEM_INT_DATA, MISSION_REQUEST_DATA, MISSION_REQUEST_INT_DATA, MISSION_REQUEST_LIST_DATA,
    MISSION_REQUEST_PARTIAL_LIST_DATA, MISSION_SET_CURRENT_DATA, MISSION_WRITE_PARTIAL_LIST_DATA, MavType,
    PARAM_EXT_REQUEST_LIST_DATA, PARAM_EXT_REQUEST_READ_DATA, PARAM_EXT_SET_DATA, PARAM_REQUEST_LIST_DATA,
    PARAM_REQUEST_READ_DATA, PARAM_SET_DATA, PING_DATA, RC_CHANNELS_OVERRIDE_DATA, SERIAL_CONTROL_DATA,
    SET_ATTITUDE_TARGET_DATA, SET_GPS_GLOBAL_ORIGIN_DATA, SET_MODE_DATA, SET_POSITION_TARGET_GLOBAL_INT_DATA,
    SET_POSITION_TARGET_LOCAL_NED_DATA, TIMESYNC_DATA,
};

use super::params::{Name, ParamRequest};
use super::services;
use super::setpoint::SetPointMessage;
use super::sticks::{self, StickMessage};
use super::telemetry::Place;
use super::{COMPONENT_ID, Identity};

/// Who sent a message: MAVLink system and component.
pub(super) type Sender = (u8, u8);

/// Bytes that a payload may be longer than its message as known here: fields that are still to come.
const FUTURE: usize = 29;

/// Parameters 5 and 6 of a command, by its form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Form {
    /// `COMMAND_LONG`; may be NaN.
    Long([f32; 2]),
    /// `COMMAND_INT`: `MAV_FRAME`, any value, and two integers.
    Int { frame: u8, xy: [i32; 2] },
}

/// A command from `COMMAND_LONG` or `COMMAND_INT`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CommandMessage {
    /// Number in `MAV_CMD`; any value.
    pub(super) command: u16,
    /// Parameter 1; may be NaN.
    pub(super) param1: f32,
    /// Parameter 2; may be NaN.
    pub(super) param2: f32,
    /// Parameter 3; may be NaN.
    pub(super) param3: f32,
    /// Parameter 4; may be NaN.
    pub(super) param4: f32,
    /// Its form, with parameters 5 and 6.
    pub(super) form: Form,
    /// Parameter 7; may be NaN.
    pub(super) param7: f32,
}

/// What is asked of the mission store.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MissionRequest {
    /// How many items there are.
    List,
    /// An item.
    Item,
    /// Some of the items, the old way.
    Part,
    /// To take items.
    Upload,
    /// To forget all items.
    Clear,
    /// To go on with an item.
    SetCurrent,
}

/// The head of a request of the file transfer protocol, all that an answer needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FileRequest {
    /// Number of the message; the answer's is one more.
    pub(super) sequence: u16,
    /// Session.
    pub(super) session: u8,
    /// Operation.
    pub(super) opcode: u8,
}

/// A request of the extended parameter protocol, with what an answer repeats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ExtendedRequest {
    /// `PARAM_EXT_REQUEST_LIST`.
    List,
    /// `PARAM_EXT_REQUEST_READ`.
    Read { name: Name },
    /// `PARAM_EXT_SET`, of a value of this type.
    Set { name: Name, kind: u8 },
}

/// A message that is for this vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Incoming {
    /// `HEARTBEAT`, of a ground station or of another.
    Heartbeat { station: bool },
    /// `COMMAND_LONG` or `COMMAND_INT`.
    Command(CommandMessage),
    /// `SET_MODE`.
    SetMode { base_mode: u8, custom_mode: u32 },
    /// One of the mission protocol's messages, for this type of mission.
    Mission { request: MissionRequest, mission_type: u8 },
    /// A request of `FILE_TRANSFER_PROTOCOL`.
    File(FileRequest),
    /// A request of the parameter protocol.
    Param(ParamRequest),
    /// `SERIAL_CONTROL` of this device.
    Serial { device: u8 },
    /// A request of the extended parameter protocol.
    ExtendedParams(ExtendedRequest),
    /// `LOG_REQUEST_LIST` or `LOG_REQUEST_DATA`.
    Logs,
    /// A request of `TIMESYNC`, with the sender's time.
    Timesync { ts1: i64 },
    /// `SET_GPS_GLOBAL_ORIGIN`.
    SetOrigin(Place),
    /// A set-point of a stream.
    SetPoint(SetPointMessage),
    /// `MANUAL_CONTROL` or `RC_CHANNELS_OVERRIDE`.
    Sticks(StickMessage),
    /// A request of `PING`.
    Ping { time_usec: u64, seq: u32 },
}

/// The payload of a frame with a correct checksum.
pub(super) struct Raw<'a> {
    /// Of the frame.
    pub(super) version: MavlinkVersion,
    /// Up to 255 bytes.
    pub(super) payload: &'a [u8],
    /// Who this vehicle is.
    pub(super) us: Identity,
}

impl Raw<'_> {
    fn read<D: MessageData>(&self) -> Option<D> {
        D::deser(self.version, self.payload).ok()
    }

    /// 0 is everyone.
    fn is_for_us(&self, system: u8, component: u8) -> bool {
        (system == 0 || system == self.us.system) && matches!(component, 0 | COMPONENT_ID)
    }
}

/// A message that is understood.
#[derive(Clone, Copy)]
pub(super) struct Known {
    /// Seed of its checksum.
    pub(super) extra_crc: u8,
    /// Longest payload as known today.
    encoded_len: usize,
    /// Its content, if it is for this vehicle.
    pub(super) decode: fn(&Raw) -> Option<Incoming>,
}

impl Known {
    const fn of<D: MessageData>(decode: fn(&Raw) -> Option<Incoming>) -> Self {
        Self { extra_crc: D::EXTRA_CRC, encoded_len: D::ENCODED_LEN, decode }
    }

    /// Longest payload that is taken for this message.
    pub(super) fn longest(&self) -> usize {
        (self.encoded_len + FUTURE).min(consts::MAX_PAYLOAD_LEN)
    }
}

/// How to read the message with this number; `None` if it is not understood.
pub(super) fn known(id: u32) -> Option<Known> {
    Some(match id {
        HEARTBEAT_DATA::ID => Known::of::<HEARTBEAT_DATA>(heartbeat),
        PING_DATA::ID => Known::of::<PING_DATA>(ping),
        SET_MODE_DATA::ID => Known::of::<SET_MODE_DATA>(set_mode),
        PARAM_REQUEST_READ_DATA::ID => Known::of::<PARAM_REQUEST_READ_DATA>(param_read),
        PARAM_REQUEST_LIST_DATA::ID => Known::of::<PARAM_REQUEST_LIST_DATA>(param_list),
        PARAM_SET_DATA::ID => Known::of::<PARAM_SET_DATA>(param_set),
        MISSION_WRITE_PARTIAL_LIST_DATA::ID => Known::of::<MISSION_WRITE_PARTIAL_LIST_DATA>(partial_upload),
        MISSION_REQUEST_PARTIAL_LIST_DATA::ID => Known::of::<MISSION_REQUEST_PARTIAL_LIST_DATA>(partial_list),
        MISSION_ITEM_DATA::ID => Known::of::<MISSION_ITEM_DATA>(old_item),
        MISSION_REQUEST_DATA::ID => Known::of::<MISSION_REQUEST_DATA>(old_item_request),
        MISSION_SET_CURRENT_DATA::ID => Known::of::<MISSION_SET_CURRENT_DATA>(set_current),
        MISSION_REQUEST_LIST_DATA::ID => Known::of::<MISSION_REQUEST_LIST_DATA>(mission_list),
        MISSION_COUNT_DATA::ID => Known::of::<MISSION_COUNT_DATA>(mission_count),
        MISSION_CLEAR_ALL_DATA::ID => Known::of::<MISSION_CLEAR_ALL_DATA>(mission_clear),
        MISSION_REQUEST_INT_DATA::ID => Known::of::<MISSION_REQUEST_INT_DATA>(item_request),
        MISSION_ITEM_INT_DATA::ID => Known::of::<MISSION_ITEM_INT_DATA>(item),
        MANUAL_CONTROL_DATA::ID => Known::of::<MANUAL_CONTROL_DATA>(manual_control),
        RC_CHANNELS_OVERRIDE_DATA::ID => Known::of::<RC_CHANNELS_OVERRIDE_DATA>(channels_override),
        SET_GPS_GLOBAL_ORIGIN_DATA::ID => Known::of::<SET_GPS_GLOBAL_ORIGIN_DATA>(set_origin),
        COMMAND_INT_DATA::ID => Known::of::<COMMAND_INT_DATA>(command_int),
        COMMAND_LONG_DATA::ID => Known::of::<COMMAND_LONG_DATA>(command_long),
        SET_ATTITUDE_TARGET_DATA::ID => Known::of::<SET_ATTITUDE_TARGET_DATA>(attitude_target),
        SET_POSITION_TARGET_LOCAL_NED_DATA::ID => Known::of::<SET_POSITION_TARGET_LOCAL_NED_DATA>(local_target),
        SET_POSITION_TARGET_GLOBAL_INT_DATA::ID => Known::of::<SET_POSITION_TARGET_GLOBAL_INT_DATA>(global_target),
        SERIAL_CONTROL_DATA::ID => Known::of::<SERIAL_CONTROL_DATA>(serial),
        PARAM_EXT_REQUEST_LIST_DATA::ID => Known::of::<PARAM_EXT_REQUEST_LIST_DATA>(extended_params),
        PARAM_EXT_REQUEST_READ_DATA::ID => Known::of::<PARAM_EXT_REQUEST_READ_DATA>(extended_read),
        PARAM_EXT_SET_DATA::ID => Known::of::<PARAM_EXT_SET_DATA>(extended_set),
        FILE_TRANSFER_PROTOCOL_DATA::ID => Known::of::<FILE_TRANSFER_PROTOCOL_DATA>(file),
        TIMESYNC_DATA::ID => Known::of::<TIMESYNC_DATA>(timesync),
        LOG_REQUEST_LIST_DATA::ID => Known::of::<LOG_REQUEST_LIST_DATA>(log_list),
        LOG_REQUEST_DATA_DATA::ID => Known::of::<LOG_REQUEST_DATA_DATA>(log_data),
        _ => return None,
    })
}

fn heartbeat(raw: &Raw) -> Option<Incoming> {
    let m: HEARTBEAT_DATA = raw.read()?;
    Some(Incoming::Heartbeat { station: m.mavtype == MavType::MAV_TYPE_GCS as u8 })
}

fn ping(raw: &Raw) -> Option<Incoming> {
    let m: PING_DATA = raw.read()?;
    // One with a target is an answer, and nothing has been asked here.
    let asks = m.target_system == 0 && m.target_component == 0;
    asks.then_some(Incoming::Ping { time_usec: m.time_usec, seq: m.seq })
}

fn set_mode(raw: &Raw) -> Option<Incoming> {
    let m: SET_MODE_DATA = raw.read()?;
    let asked = Incoming::SetMode { base_mode: m.base_mode, custom_mode: m.custom_mode };
    raw.is_for_us(m.target_system, 0).then_some(asked)
}

fn param_read(raw: &Raw) -> Option<Incoming> {
    let m: PARAM_REQUEST_READ_DATA = raw.read()?;
    let request = ParamRequest::Read { index: m.param_index, name: m.param_id.into() };
    raw.is_for_us(m.target_system, m.target_component).then_some(Incoming::Param(request))
}

fn param_list(raw: &Raw) -> Option<Incoming> {
    let m: PARAM_REQUEST_LIST_DATA = raw.read()?;
    raw.is_for_us(m.target_system, m.target_component).then_some(Incoming::Param(ParamRequest::List))
}

fn param_set(raw: &Raw) -> Option<Incoming> {
    let m: PARAM_SET_DATA = raw.read()?;
    let request = ParamRequest::Set { name: m.param_id.into(), bits: m.param_value.to_bits(), kind: m.param_type };
    raw.is_for_us(m.target_system, m.target_component).then_some(Incoming::Param(request))
}

/// A message of the mission protocol, if it is for this vehicle.
fn mission(raw: &Raw, request: MissionRequest, target: (u8, u8), mission_type: u8) -> Option<Incoming> {
    raw.is_for_us(target.0, target.1).then_some(Incoming::Mission { request, mission_type })
}

/// Readers of the mission protocol's messages of which only the kind matters.
macro_rules! mission_readers {
    ($($name:ident: $data:ty => $request:expr,)*) => {$(
        fn $name(raw: &Raw) -> Option<Incoming> {
            let m: $data = raw.read()?;
            mission(raw, $request, (m.target_system, m.target_component), m.mission_type)
        }
    )*};
}

mission_readers! {
    mission_list: MISSION_REQUEST_LIST_DATA => MissionRequest::List,
    partial_list: MISSION_REQUEST_PARTIAL_LIST_DATA => MissionRequest::Part,
    partial_upload: MISSION_WRITE_PARTIAL_LIST_DATA => MissionRequest::Upload,
    old_item: MISSION_ITEM_DATA => MissionRequest::Upload,
    item: MISSION_ITEM_INT_DATA => MissionRequest::Upload,
    old_item_request: MISSION_REQUEST_DATA => MissionRequest::Item,
    item_request: MISSION_REQUEST_INT_DATA => MissionRequest::Item,
    mission_clear: MISSION_CLEAR_ALL_DATA => MissionRequest::Clear,
}

fn mission_count(raw: &Raw) -> Option<Incoming> {
    let m: MISSION_COUNT_DATA = raw.read()?;
    // Nothing to upload is what a client sends that clears.
    let request = if m.count == 0 { MissionRequest::Clear } else { MissionRequest::Upload };
    mission(raw, request, (m.target_system, m.target_component), m.mission_type)
}

fn set_current(raw: &Raw) -> Option<Incoming> {
    let m: MISSION_SET_CURRENT_DATA = raw.read()?;
    mission(raw, MissionRequest::SetCurrent, (m.target_system, m.target_component), 0)
}

fn command_long(raw: &Raw) -> Option<Incoming> {
    let m: COMMAND_LONG_DATA = raw.read()?;
    let command = CommandMessage {
        command: m.command,
        param1: m.param1,
        param2: m.param2,
        param3: m.param3,
        param4: m.param4,
        form: Form::Long([m.param5, m.param6]),
        param7: m.param7,
    };
    raw.is_for_us(m.target_system, m.target_component).then_some(Incoming::Command(command))
}

fn command_int(raw: &Raw) -> Option<Incoming> {
    let m: COMMAND_INT_DATA = raw.read()?;
    let command = CommandMessage {
        command: m.command,
        param1: m.param1,
        param2: m.param2,
        param3: m.param3,
        param4: m.param4,
        form: Form::Int { frame: m.frame, xy: [m.x, m.y] },
        param7: m.z,
    };
    raw.is_for_us(m.target_system, m.target_component).then_some(Incoming::Command(command))
}

fn set_origin(raw: &Raw) -> Option<Incoming> {
    let m: SET_GPS_GLOBAL_ORIGIN_DATA = raw.read()?;
    let place = Place { latitude_e7: m.latitude, longitude_e7: m.longitude, height_msl_mm: m.altitude };
    raw.is_for_us(m.target_system, 0).then_some(Incoming::SetOrigin(place))
}

fn manual_control(raw: &Raw) -> Option<Incoming> {
    let m: MANUAL_CONTROL_DATA = raw.read()?;
    // Sticks move one vehicle: they cannot be for everyone.
    let message = sticks::of_joystick(&m).filter(|_| m.target == raw.us.system)?;
    Some(Incoming::Sticks(message))
}

fn channels_override(raw: &Raw) -> Option<Incoming> {
    let m: RC_CHANNELS_OVERRIDE_DATA = raw.read()?;
    let ours = m.target_system == raw.us.system && raw.is_for_us(m.target_system, m.target_component);
    let message = sticks::of_channels(&m).filter(|_| ours)?;
    Some(Incoming::Sticks(message))
}

/// Readers of set-points.
macro_rules! setpoint_readers {
    ($($name:ident: $data:ty,)*) => {$(
        fn $name(raw: &Raw) -> Option<Incoming> {
            let m: $data = raw.read()?;
            let ours = raw.is_for_us(m.target_system, m.target_component);
            ours.then_some(Incoming::SetPoint(SetPointMessage::from(m)))
        }
    )*};
}

setpoint_readers! {
    attitude_target: SET_ATTITUDE_TARGET_DATA,
    local_target: SET_POSITION_TARGET_LOCAL_NED_DATA,
    global_target: SET_POSITION_TARGET_GLOBAL_INT_DATA,
}

fn file(raw: &Raw) -> Option<Incoming> {
    let m: FILE_TRANSFER_PROTOCOL_DATA = raw.read()?;
    let [low, high, session, opcode, ..] = m.payload;
    let request = FileRequest { sequence: u16::from_le_bytes([low, high]), session, opcode };
    raw.is_for_us(m.target_system, m.target_component).then_some(Incoming::File(request))
}

fn serial(raw: &Raw) -> Option<Incoming> {
    let m: SERIAL_CONTROL_DATA = raw.read()?;
    let asks = m.flags & services::SERIAL_REPLY == 0;
    asks.then_some(Incoming::Serial { device: m.device })
}

fn extended_params(raw: &Raw) -> Option<Incoming> {
    let m: PARAM_EXT_REQUEST_LIST_DATA = raw.read()?;
    raw.is_for_us(m.target_system, m.target_component).then_some(Incoming::ExtendedParams(ExtendedRequest::List))
}

fn extended_read(raw: &Raw) -> Option<Incoming> {
    let m: PARAM_EXT_REQUEST_READ_DATA = raw.read()?;
    let request = ExtendedRequest::Read { name: m.param_id.into() };
    raw.is_for_us(m.target_system, m.target_component).then_some(Incoming::ExtendedParams(request))
}

fn extended_set(raw: &Raw) -> Option<Incoming> {
    let m: PARAM_EXT_SET_DATA = raw.read()?;
    let request = ExtendedRequest::Set { name: m.param_id.into(), kind: m.param_type };
    raw.is_for_us(m.target_system, m.target_component).then_some(Incoming::ExtendedParams(request))
}

fn log_list(raw: &Raw) -> Option<Incoming> {
    let m: LOG_REQUEST_LIST_DATA = raw.read()?;
    raw.is_for_us(m.target_system, m.target_component).then_some(Incoming::Logs)
}

fn log_data(raw: &Raw) -> Option<Incoming> {
    let m: LOG_REQUEST_DATA_DATA = raw.read()?;
    raw.is_for_us(m.target_system, m.target_component).then_some(Incoming::Logs)
}

fn timesync(raw: &Raw) -> Option<Incoming> {
    let m: TIMESYNC_DATA = raw.read()?;
    // With another tc1 it is an answer, and nothing has been asked here.
    let request = (m.tc1 == 0).then_some(Incoming::Timesync { ts1: m.ts1 });
    request.filter(|_| raw.is_for_us(m.target_system, m.target_component))
}
