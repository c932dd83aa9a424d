//! Encodes messages as MAVLink 2 frames, as many as fit into one job.

use glissade_dialect::mavlink_core::{MAVLinkV2MessageRaw, MavHeader, MessageData};

use super::{COMPONENT_ID, SYSTEM_ID, TxBytes};

/// Bytes of an unsigned frame besides its payload.
const OVERHEAD: usize = 12;

/// Length of a message's longest frame.
pub(super) const fn frame_len<D: MessageData>() -> usize {
    D::ENCODED_LEN + OVERHEAD
}

/// The frames that one job sends.
pub(super) struct Writer<'a> {
    bytes: &'a mut TxBytes,
    /// Sequence number, counted over all frames.
    sequence: &'a mut u8,
    limit: usize,
}

impl<'a> Writer<'a> {
    /// Writes to the end of `bytes`, up to its capacity.
    pub(super) fn new(bytes: &'a mut TxBytes, sequence: &'a mut u8) -> Self {
        let limit = bytes.capacity();
        Self { bytes, sequence, limit }
    }

    /// Limits the total number of bytes from now on.
    pub(super) fn set_limit(&mut self, limit: usize) {
        self.limit = limit;
    }

    /// True if `count` more bytes fit.
    pub(super) fn has_room(&self, count: usize) -> bool {
        self.bytes.len() + count <= self.limit
    }

    /// Appends a frame; false, with nothing written, if its longest form does not fit.
    pub(super) fn write<D: MessageData>(&mut self, message: &D) -> bool {
        if !self.has_room(frame_len::<D>()) {
            return false;
        }
        let header = MavHeader { system_id: SYSTEM_ID.into(), component_id: COMPONENT_ID, sequence: *self.sequence };
        let mut raw = MAVLinkV2MessageRaw::new();
        raw.serialize_message_data(header, message);
        let written = self.bytes.extend_from_slice(raw.raw_bytes()).is_ok();
        *self.sequence = self.sequence.wrapping_add(u8::from(written));
        written
    }
}
