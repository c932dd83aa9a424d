//! Messages to bytes: frames of MAVLink 2 for one job, as many as fit.

use glissade_dialect::mavlink_core::{MAVLinkV2MessageRaw, MavHeader, MessageData};

use super::{COMPONENT_ID, SYSTEM_ID, TxBytes};

/// Bytes of a frame besides its payload, unsigned.
const OVERHEAD: usize = 12;

/// Longest frame of a message.
pub(super) const fn frame_len<D: MessageData>() -> usize {
    D::ENCODED_LEN + OVERHEAD
}

/// What one job sends.
pub(super) struct Writer<'a> {
    bytes: &'a mut TxBytes,
    /// One counter for everything that is sent.
    sequence: &'a mut u8,
    limit: usize,
}

impl<'a> Writer<'a> {
    /// Writes to the end of `bytes`, up to its capacity.
    pub(super) fn new(bytes: &'a mut TxBytes, sequence: &'a mut u8) -> Self {
        let limit = bytes.capacity();
        Self { bytes, sequence, limit }
    }

    /// From now on, no more than this many bytes altogether.
    pub(super) fn set_limit(&mut self, limit: usize) {
        self.limit = limit;
    }

    /// True if so many more bytes fit.
    pub(super) fn has_room(&self, count: usize) -> bool {
        self.bytes.len() + count <= self.limit
    }

    /// Appends a frame; false, and nothing done, if its longest form does not fit.
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
