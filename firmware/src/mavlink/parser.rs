//! Parser: finds frames in an arbitrary byte stream, and decodes the messages addressed to this vehicle.
//!
//! MAVLink 1 and 2. A frame is accepted if its message is supported, its incompatibility flags are known and its
//! checksum is right. Signed frames are accepted; their signature is not checked.
//!
//! While the stream is synchronised, that is, as long as each frame begins where the last one ended, an unsupported
//! frame is skipped as a whole: its payload (a file, for example) may itself look like a command. Once synchronisation
//! is lost, any byte may begin a frame until a checksum is right. A frame that is not complete within [`PATIENCE_JOBS`]
//! is discarded.

use glissade_dialect::mavlink_core::{MavlinkVersion, MessageData, calculate_crc, consts};
use glissade_dialect::{COMMAND_INT_DATA, COMMAND_LONG_DATA, MISSION_REQUEST_LIST_DATA, TIMESYNC_DATA};

use super::{COMPONENT_ID, RX_CAPACITY, SYSTEM_ID};

const MAGIC_V1: u8 = 0xfe;
const MAGIC_V2: u8 = 0xfd;
const HEADER_V1: usize = consts::STX_SIZE + consts::v1::HEADER_SIZE;
const HEADER_V2: usize = consts::STX_SIZE + consts::v2::MIN_HEADER_SIZE;
const FRAME_MAX: usize = HEADER_V2 + consts::MAX_PAYLOAD_LEN + consts::CHECKSUM_SIZE + consts::v2::SIGNATURE_SIZE;

/// Longest payload of a supported message: those known today have 35 bytes at most, the rest is for future fields.
/// Bounds the work that a hostile stream can cause in one job: 64 checked bytes for every 3 received.
const PAYLOAD_MAX: usize = 64;

/// Number of ground partition jobs to wait for the rest of a frame: 100 ms, twice what the longest frame takes on the
/// slowest usual radio (57.6 kBd).
const PATIENCE_JOBS: u8 = 10;

/// Who sent a message: MAVLink system and component.
pub(super) type Sender = (u8, u8);

/// A command from `COMMAND_LONG` or `COMMAND_INT`, with the parameters that the supported commands use.
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
    /// Parameter 7; may be NaN.
    pub(super) param7: f32,
}

/// A message that is for this vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Incoming {
    /// `COMMAND_LONG` or `COMMAND_INT`.
    Command(CommandMessage),
    /// `MISSION_REQUEST_LIST` for this type of mission.
    MissionRequestList { mission_type: u8 },
    /// A request of `TIMESYNC`, with the sender's time.
    Timesync { ts1: i64 },
}

/// The stream parser: the bytes not decoded yet, and whether the stream is synchronised.
#[derive(Clone, Debug)]
pub(super) struct Parser {
    /// At most an incomplete frame from the last job, and the bytes received in this job.
    buffer: heapless::Vec<u8, { FRAME_MAX + RX_CAPACITY }>,
    position: usize,
    in_step: bool,
    waited_jobs: u8,
    bad_checksums: u32,
}

impl Default for Parser {
    fn default() -> Self {
        Self { buffer: heapless::Vec::new(), position: 0, in_step: true, waited_jobs: 0, bad_checksums: 0 }
    }
}

impl Parser {
    /// Appends the bytes received in one job. Call it once per job, even without bytes, and then [`next`](Self::next)
    /// until that returns `None`.
    pub(super) fn push(&mut self, received: &[u8]) {
        if !self.buffer.is_empty() {
            self.waited_jobs = self.waited_jobs.saturating_add(1);
            if self.waited_jobs > PATIENCE_JOBS {
                self.position = 1;
                self.in_step = false;
            }
        }
        // Always fits: what is left over is shorter than a frame.
        let _ = self.buffer.extend_from_slice(received);
    }

    /// The next message for this vehicle.
    pub(super) fn next(&mut self) -> Option<(Sender, Incoming)> {
        loop {
            // Every iteration advances by a byte at least, so it is bounded by the bytes received.
            match scan(self.buffer.get(self.position..).unwrap_or_default()) {
                Scan::Incomplete => break,
                Scan::BadChecksum => {
                    self.bad_checksums = self.bad_checksums.saturating_add(1);
                    self.skip(1);
                }
                Scan::Foreign { length } if self.in_step => {
                    if self.position + length > self.buffer.len() {
                        break;
                    }
                    self.position += length;
                }
                Scan::Nothing | Scan::Foreign { .. } => self.skip(1),
                Scan::Frame { length, frame } => {
                    let message = frame.decode().map(|message| (frame.sender, message));
                    self.position += length;
                    self.in_step = true;
                    if message.is_some() {
                        return message;
                    }
                }
            }
        }
        self.discard_scanned();
        None
    }

    /// Number of frames with a wrong checksum since boot.
    pub(super) fn bad_checksums(&self) -> u32 {
        self.bad_checksums
    }

    fn skip(&mut self, count: usize) {
        self.position += count;
        self.in_step = false;
    }

    /// Drops the bytes already scanned.
    fn discard_scanned(&mut self) {
        if self.position > 0 {
            let position = self.position.min(self.buffer.len());
            let left = self.buffer.len() - position;
            self.buffer.copy_within(position.., 0);
            self.buffer.truncate(left);
            self.position = 0;
            self.waited_jobs = 0;
        }
    }
}

/// What is found at the beginning of a stream.
enum Scan<'a> {
    /// An incomplete frame, or nothing.
    Incomplete,
    /// Not a frame.
    Nothing,
    /// Not a frame, or a damaged one.
    BadChecksum,
    /// Possibly an unsupported frame, perhaps incomplete.
    Foreign { length: usize },
    /// A frame.
    Frame { length: usize, frame: Frame<'a> },
}

fn scan(bytes: &[u8]) -> Scan<'_> {
    match bytes.first() {
        Some(&MAGIC_V1) => scan_v1(bytes),
        Some(&MAGIC_V2) => scan_v2(bytes),
        Some(_) => Scan::Nothing,
        None => Scan::Incomplete,
    }
}

fn scan_v1(bytes: &[u8]) -> Scan<'_> {
    let Some(&[_, payload, _, system, component, id]) = bytes.first_chunk::<HEADER_V1>() else {
        return Scan::Incomplete;
    };
    let layout = Layout { header: HEADER_V1, payload: usize::from(payload), signature: 0 };
    check(bytes, &layout, MavlinkVersion::V1, (system, component), u32::from(id))
}

fn scan_v2(bytes: &[u8]) -> Scan<'_> {
    let Some(&[_, payload, incompatible, _, _, system, component, id0, id1, id2]) = bytes.first_chunk::<HEADER_V2>()
    else {
        return Scan::Incomplete;
    };
    let signed = incompatible & consts::v2::IFLAG_SIGNED != 0;
    let signature = if signed { consts::v2::SIGNATURE_SIZE } else { 0 };
    let layout = Layout { header: HEADER_V2, payload: usize::from(payload), signature };
    if incompatible & !consts::v2::IFLAG_SIGNED != 0 {
        return Scan::Foreign { length: layout.length() };
    }
    check(bytes, &layout, MavlinkVersion::V2, (system, component), u32::from_le_bytes([id0, id1, id2, 0]))
}

/// Lengths of a frame's sections.
struct Layout {
    header: usize,
    payload: usize,
    signature: usize,
}

impl Layout {
    fn length(&self) -> usize {
        self.header + self.payload + consts::CHECKSUM_SIZE + self.signature
    }
}

fn check<'a>(bytes: &'a [u8], layout: &Layout, version: MavlinkVersion, sender: Sender, id: u32) -> Scan<'a> {
    let Some(extra) = extra_crc(id) else { return Scan::Foreign { length: layout.length() } };
    if layout.payload > PAYLOAD_MAX {
        return Scan::Nothing;
    }
    let end = layout.header + layout.payload;
    let (Some(_), Some(covered), Some(payload), Some(&checksum)) = (
        bytes.get(..layout.length()),
        bytes.get(consts::STX_SIZE..end),
        bytes.get(layout.header..end),
        bytes.get(end..).and_then(|rest| rest.first_chunk::<{ consts::CHECKSUM_SIZE }>()),
    ) else {
        return Scan::Incomplete;
    };
    if calculate_crc(covered, extra) == u16::from_le_bytes(checksum) {
        Scan::Frame { length: layout.length(), frame: Frame { version, sender, id, payload } }
    } else {
        Scan::BadChecksum
    }
}

/// The checksum seed of a supported message; `None` for an unsupported one.
fn extra_crc(id: u32) -> Option<u8> {
    match id {
        COMMAND_LONG_DATA::ID => Some(COMMAND_LONG_DATA::EXTRA_CRC),
        COMMAND_INT_DATA::ID => Some(COMMAND_INT_DATA::EXTRA_CRC),
        MISSION_REQUEST_LIST_DATA::ID => Some(MISSION_REQUEST_LIST_DATA::EXTRA_CRC),
        TIMESYNC_DATA::ID => Some(TIMESYNC_DATA::EXTRA_CRC),
        _ => None,
    }
}

/// A frame with a correct checksum.
struct Frame<'a> {
    version: MavlinkVersion,
    sender: Sender,
    id: u32,
    payload: &'a [u8],
}

impl Frame<'_> {
    /// The message, if it is for this vehicle.
    fn decode(&self) -> Option<Incoming> {
        match self.id {
            COMMAND_LONG_DATA::ID => self.decode_long(),
            COMMAND_INT_DATA::ID => self.decode_int(),
            MISSION_REQUEST_LIST_DATA::ID => self.decode_mission_request_list(),
            TIMESYNC_DATA::ID => self.decode_timesync(),
            _ => None,
        }
    }

    fn decode_long(&self) -> Option<Incoming> {
        let m = COMMAND_LONG_DATA::deser(self.version, self.payload).ok()?;
        let command = CommandMessage {
            command: m.command,
            param1: m.param1,
            param2: m.param2,
            param3: m.param3,
            param7: m.param7,
        };
        is_for_us(m.target_system, m.target_component).then_some(Incoming::Command(command))
    }

    fn decode_int(&self) -> Option<Incoming> {
        let m = COMMAND_INT_DATA::deser(self.version, self.payload).ok()?;
        let command =
            CommandMessage { command: m.command, param1: m.param1, param2: m.param2, param3: m.param3, param7: m.z };
        is_for_us(m.target_system, m.target_component).then_some(Incoming::Command(command))
    }

    fn decode_mission_request_list(&self) -> Option<Incoming> {
        let m = MISSION_REQUEST_LIST_DATA::deser(self.version, self.payload).ok()?;
        let request = Incoming::MissionRequestList { mission_type: m.mission_type };
        is_for_us(m.target_system, m.target_component).then_some(request)
    }

    fn decode_timesync(&self) -> Option<Incoming> {
        let m = TIMESYNC_DATA::deser(self.version, self.payload).ok()?;
        // With another tc1 it is an answer, and nothing has been asked here.
        let request = (m.tc1 == 0).then_some(Incoming::Timesync { ts1: m.ts1 });
        request.filter(|_| is_for_us(m.target_system, m.target_component))
    }
}

/// 0 is everyone.
fn is_for_us(system: u8, component: u8) -> bool {
    matches!(system, 0 | SYSTEM_ID) && matches!(component, 0 | COMPONENT_ID)
}
