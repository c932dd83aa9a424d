//! Encodes messages as MAVLink 2 frames, as many as fit.

use glissade_dialect::mavlink_core::{MAVLinkV2MessageRaw, MavHeader, MessageData};

use super::port::{Port, Ring, SENT_CAPACITY};
use super::{COMPONENT_ID, Identity};

/// Bytes of an unsigned frame besides its payload.
const OVERHEAD: usize = 12;

/// Length of a message's longest frame.
pub(super) const fn frame_len<D: MessageData>() -> usize {
    D::ENCODED_LEN + OVERHEAD
}

/// Writes frames to a link's ring.
pub(super) struct Writer<'a> {
    ring: &'a Ring<SENT_CAPACITY>,
    /// The link's sequence number.
    sequence: &'a mut u8,
    us: Identity,
    /// Bytes that wait to be sent, as far as this job may know: those of its release, and its own.
    waiting: usize,
    limit: usize,
}

impl<'a> Writer<'a> {
    /// Writes until the ring is full.
    pub(super) fn new(port: &'a Port, sequence: &'a mut u8, us: Identity) -> Self {
        Self { ring: port.sent(), sequence, us, waiting: port.waiting(), limit: SENT_CAPACITY }
    }

    /// Writes from now on only as long as no more than this many bytes wait to be sent.
    pub(super) fn set_limit(&mut self, limit: usize) {
        self.limit = limit;
    }

    /// Bytes that wait to be sent.
    pub(super) fn waiting(&self) -> usize {
        self.waiting
    }

    /// True if `count` more bytes fit.
    pub(super) fn has_room(&self, count: usize) -> bool {
        self.waiting + count <= self.limit
    }

    /// Appends a frame; false, with nothing written, if it does not fit. A frame is often shorter than its longest form,
    /// because zeros at its end are cut.
    pub(super) fn write<D: MessageData>(&mut self, message: &D) -> bool {
        let header =
            MavHeader { system_id: self.us.system.into(), component_id: COMPONENT_ID, sequence: *self.sequence };
        let mut raw = MAVLinkV2MessageRaw::new();
        raw.serialize_message_data(header, message);
        if !self.has_room(raw.raw_bytes().len()) {
            return false;
        }
        // Whole, because there is room.
        self.waiting += self.ring.write(raw.raw_bytes());
        *self.sequence = self.sequence.wrapping_add(1);
        true
    }
}
