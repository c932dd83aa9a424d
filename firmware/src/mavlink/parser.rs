//! Parser: finds frames in an arbitrary byte stream, and decodes the messages addressed to this vehicle.
//!
//! MAVLink 1 and 2. A frame is accepted if its message is known, its incompatibility flags are known and its checksum is
//! right. Signed frames are accepted; their signature is not checked. What comes with this vehicle's own identity is an
//! echo, and ignored.
//!
//! Frames are read where the link's ring holds them. While the stream is synchronised, that is, as long as each frame
//! begins where the last one ended, a frame that is not known, or is damaged but followed by another, is passed over as
//! a whole: its payload (a file, for example) may itself look like a command. Once synchronisation is lost, any byte may
//! begin a frame, until a checksum is right and another frame follows, or nothing: where a frame may have begun before,
//! nothing for [`QUIET_JOBS`]. A frame that is not complete within [`PATIENCE_JOBS`] is discarded.

use glissade_dialect::mavlink_core::{MavlinkVersion, calculate_crc, consts};

use super::incoming::{Incoming, Raw, Sender, known};
use super::port::{RECEIVED_CAPACITY, Ring};
use super::{COMPONENT_ID, Identity};

const MAGIC_V1: u8 = 0xfe;
const MAGIC_V2: u8 = 0xfd;
const HEADER_V1: usize = consts::STX_SIZE + consts::v1::HEADER_SIZE;
const HEADER_V2: usize = consts::STX_SIZE + consts::v2::MIN_HEADER_SIZE;
const FRAME_MAX: usize = HEADER_V2 + consts::MAX_PAYLOAD_LEN + consts::CHECKSUM_SIZE + consts::v2::SIGNATURE_SIZE;

/// Number of ground partition jobs to wait for the rest of a frame: 100 ms, twice what the longest frame takes on the
/// slowest usual radio (57.6 kBd).
const PATIENCE_JOBS: u8 = 10;

/// So many jobs without a byte after a frame: nothing follows it. In one job's bytes, the end is wherever they were cut.
const QUIET_JOBS: u8 = 5;

/// Bytes of frames that may be checked in one job. A hostile stream can begin a long frame with every second byte: what
/// is beyond this waits for the next job, and costs its sender's link alone.
const WORK_MAX: usize = 4096;

/// A link's stream: whether it is synchronised, and what it costs.
#[derive(Clone, Debug)]
pub(super) struct Parser {
    in_step: bool,
    /// Jobs for which the rest of a frame has been awaited, and jobs without a byte.
    waited_jobs: u8,
    empty_jobs: u8,
    /// Bytes to the end of what may have been a frame, and was damaged or is not known.
    doubtful: usize,
    /// Bytes that may still be checked in this job.
    work: usize,
    bad_checksums: u32,
}

impl Default for Parser {
    fn default() -> Self {
        Self { in_step: true, waited_jobs: 0, empty_jobs: 0, doubtful: 0, work: 0, bad_checksums: 0 }
    }
}

/// What stands at the beginning of the stream.
enum Scan {
    /// An incomplete frame, or nothing.
    Incomplete,
    /// Not a frame.
    Nothing,
    /// Possibly a frame of a message that is not known, perhaps incomplete.
    Foreign { length: usize },
    /// Perhaps a frame of a known message.
    Known(Header),
}

/// What follows a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Next {
    /// The beginning of another, or nothing.
    Frame,
    /// Something else.
    Other,
    /// Nothing yet.
    Unknown,
}

/// The header of a frame.
struct Header {
    version: MavlinkVersion,
    sender: Sender,
    id: u32,
    /// Lengths of its sections.
    start: usize,
    payload: usize,
    signature: usize,
}

impl Header {
    fn length(&self) -> usize {
        self.start + self.payload + consts::CHECKSUM_SIZE + self.signature
    }
}

impl Parser {
    /// Begins a job. Call it once per job, even without bytes, and then [`next`](Self::next) until that returns `None`.
    pub(super) fn begin(&mut self, bytes: &Ring<RECEIVED_CAPACITY>) {
        self.work = WORK_MAX;
        let is_empty = bytes.readable() == 0;
        self.waited_jobs = if is_empty { 0 } else { self.waited_jobs.saturating_add(1) };
        self.empty_jobs = if is_empty { self.empty_jobs.saturating_add(1) } else { 0 };
        if self.empty_jobs >= QUIET_JOBS {
            self.doubtful = 0;
        }
        if self.waited_jobs > PATIENCE_JOBS {
            self.pass_byte(bytes);
        }
    }

    /// The next message for this vehicle.
    pub(super) fn next(&mut self, bytes: &Ring<RECEIVED_CAPACITY>, us: Identity) -> Option<(Sender, Incoming)> {
        // Every turn advances by a byte at least, so it is bounded by the bytes received.
        loop {
            match scan(bytes) {
                Scan::Incomplete => return None,
                Scan::Nothing => self.pass_byte(bytes),
                Scan::Foreign { length } if !self.in_step => self.doubt(bytes, length),
                Scan::Foreign { length } if length > bytes.readable() => return None,
                Scan::Foreign { length } => self.pass(bytes, length),
                Scan::Known(header) if header.length() > bytes.readable() => return None,
                Scan::Known(header) => {
                    let next = self.next_after(bytes, &header);
                    // By a checksum alone it may be a piece of a file in a message that was damaged on the way; and there is
                    // no need to check it.
                    if !self.in_step && next == Next::Other {
                        self.pass_byte(bytes);
                        continue;
                    }
                    self.work = self.work.checked_sub(header.length())?;
                    let mut frame = [0; FRAME_MAX];
                    let frame = bytes.copy(&mut frame);
                    let is_intact = is_intact(frame, &header);
                    if is_intact != self.in_step && next == Next::Unknown {
                        return None;
                    }
                    if let Some(message) = self.take(bytes, &header, is_intact, next, frame, us) {
                        return Some((header.sender, message));
                    }
                }
            }
        }
    }

    /// Passes a complete frame of a known message; returns the message if it is intact and for this vehicle.
    fn take(
        &mut self,
        bytes: &Ring<RECEIVED_CAPACITY>,
        header: &Header,
        is_intact: bool,
        next: Next,
        frame: &[u8],
        us: Identity,
    ) -> Option<Incoming> {
        if !is_intact {
            self.bad_checksums = self.bad_checksums.saturating_add(1);
            if self.in_step && next == Next::Frame {
                self.pass(bytes, header.length());
            } else {
                self.doubt(bytes, header.length());
            }
            return None;
        }
        self.pass(bytes, header.length());
        self.in_step = true;
        if header.sender == (us.system, COMPONENT_ID) {
            return None;
        }
        let payload = frame.get(header.start..header.start + header.payload)?;
        (known(header.id)?.decode)(&Raw { version: header.version, payload, us })
    }

    /// What follows a frame. If that is another, or nothing, its length is probably right.
    fn next_after(&self, bytes: &Ring<RECEIVED_CAPACITY>, header: &Header) -> Next {
        match bytes.peek(header.length()) {
            Some(MAGIC_V1 | MAGIC_V2) => Next::Frame,
            Some(_) => Next::Other,
            None if (self.in_step || self.doubtful > 0) && self.waited_jobs < QUIET_JOBS => Next::Unknown,
            None => Next::Frame,
        }
    }

    /// Number of frames with a wrong checksum since the link was opened.
    pub(super) fn bad_checksums(&self) -> u32 {
        self.bad_checksums
    }

    fn pass(&mut self, bytes: &Ring<RECEIVED_CAPACITY>, count: usize) {
        bytes.skip(count);
        self.waited_jobs = 0;
        self.doubtful = self.doubtful.saturating_sub(count);
    }

    /// Passes the first byte of what may have been a frame of a length.
    fn doubt(&mut self, bytes: &Ring<RECEIVED_CAPACITY>, length: usize) {
        self.doubtful = self.doubtful.max(length);
        self.pass_byte(bytes);
    }

    fn pass_byte(&mut self, bytes: &Ring<RECEIVED_CAPACITY>) {
        self.pass(bytes, 1);
        self.in_step = false;
    }
}

/// Whether a frame's checksum is right.
fn is_intact(frame: &[u8], header: &Header) -> bool {
    let end = header.start + header.payload;
    let checksum = frame.get(end..).and_then(<[u8]>::first_chunk::<{ consts::CHECKSUM_SIZE }>);
    let (Some(covered), Some(checksum)) = (frame.get(consts::STX_SIZE..end), checksum) else { return false };
    known(header.id).is_some_and(|known| calculate_crc(covered, known.extra_crc) == u16::from_le_bytes(*checksum))
}

fn scan(bytes: &Ring<RECEIVED_CAPACITY>) -> Scan {
    let mut start = [0; HEADER_V2];
    match *bytes.copy(&mut start) {
        [MAGIC_V1, payload, _, system, component, id, ..] => judge(Header {
            version: MavlinkVersion::V1,
            sender: (system, component),
            id: id.into(),
            start: HEADER_V1,
            payload: payload.into(),
            signature: 0,
        }),
        [MAGIC_V2, payload, incompatible, _, _, system, component, id0, id1, id2] => {
            let signed = incompatible & consts::v2::IFLAG_SIGNED != 0;
            let header = Header {
                version: MavlinkVersion::V2,
                sender: (system, component),
                id: u32::from_le_bytes([id0, id1, id2, 0]),
                start: HEADER_V2,
                payload: payload.into(),
                signature: if signed { consts::v2::SIGNATURE_SIZE } else { 0 },
            };
            if incompatible & !consts::v2::IFLAG_SIGNED == 0 {
                judge(header)
            } else {
                Scan::Foreign { length: header.length() }
            }
        }
        [] | [MAGIC_V1 | MAGIC_V2, ..] => Scan::Incomplete,
        _ => Scan::Nothing,
    }
}

fn judge(header: Header) -> Scan {
    match known(header.id) {
        Some(known) if header.payload > known.longest() => Scan::Nothing,
        Some(_) => Scan::Known(header),
        None => Scan::Foreign { length: header.length() },
    }
}
