//! MAVLink frames: their borders in datagrams, which come whole, where to cut what is sent, and frames of one's own.

use std::ops::Range;

use glissade_dialect::MavMessage;
use glissade_dialect::mavlink_core::{
    MAVLinkV2MessageRaw, MavHeader, MavlinkVersion, Message as _, MessageData, calculate_crc, consts,
};

const HEADER_V1: usize = consts::STX_SIZE + consts::v1::HEADER_SIZE;
const HEADER_V2: usize = consts::STX_SIZE + consts::v2::MIN_HEADER_SIZE;

/// No frame is longer.
pub const LONGEST: usize = HEADER_V2 + 255 + consts::CHECKSUM_SIZE + consts::v2::SIGNATURE_SIZE;

/// A whole frame in a datagram.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Where it stands.
    pub range: Range<usize>,
    /// The MAVLink system that has sent it.
    pub system: u8,
    /// Whether it is known here and its checksum is right.
    pub valid: bool,
}

/// A MAVLink component of this process. It numbers its frames.
#[derive(Clone, Copy, Debug)]
pub struct Component {
    next: MavHeader,
}

impl Component {
    /// A component of a system, before its first frame.
    pub fn new(system: u8, component: u8) -> Self {
        Self { next: MavHeader { system_id: system.into(), component_id: component, sequence: 0 } }
    }

    /// Its next frame, of MAVLink 2.
    pub fn frame(&mut self, message: &impl MessageData) -> Vec<u8> {
        let mut raw = MAVLinkV2MessageRaw::new();
        raw.serialize_message_data(self.next, message);
        self.next.sequence = self.next.sequence.wrapping_add(1);
        raw.raw_bytes().to_vec()
    }
}

/// The whole frames of a datagram. A frame ends where its datagram ends at the latest: half a one, and bytes that belong to
/// none, are left out.
pub fn whole(datagram: &[u8]) -> impl Iterator<Item = Frame> {
    let mut at = 0;
    std::iter::from_fn(move || {
        while at < datagram.len() {
            let from = at;
            match length(&datagram[from..]) {
                Some(length) if from + length <= datagram.len() => {
                    at += length;
                    return Some(judge(datagram, from..at));
                }
                _ => at += 1,
            }
        }
        None
    })
}

/// The first valid frame of a stream, wherever it begins: what only looks like a header hides none.
pub fn first_valid(stream: &[u8]) -> Option<Frame> {
    (0..stream.len()).find_map(|at| {
        let end = at + length(&stream[at..])?;
        (end <= stream.len()).then(|| judge(stream, at..end)).filter(|frame| frame.valid)
    })
}

/// The length of the frame that begins here, by its header.
fn length(bytes: &[u8]) -> Option<usize> {
    let payload = usize::from(*bytes.get(1)?);
    match bytes[0] {
        0xfe => Some(HEADER_V1 + payload + consts::CHECKSUM_SIZE),
        0xfd => {
            let signed = bytes.get(2)? & consts::v2::IFLAG_SIGNED != 0;
            let signature = if signed { consts::v2::SIGNATURE_SIZE } else { 0 };
            Some(HEADER_V2 + payload + consts::CHECKSUM_SIZE + signature)
        }
        _ => None,
    }
}

/// The message of a whole frame, if it is known here.
pub fn message(frame: &[u8]) -> Option<MavMessage> {
    let is_v1 = frame.first() == Some(&0xfe);
    if frame.len() < if is_v1 { HEADER_V1 } else { HEADER_V2 } {
        return None;
    }
    let (header, _, id) = head(frame);
    let version = if is_v1 { MavlinkVersion::V1 } else { MavlinkVersion::V2 };
    let payload = frame.get(header..header + usize::from(frame[1]))?;
    MavMessage::parse(version, id, payload).ok()
}

/// Length of a whole frame's header, the system that has sent it, and its message's number.
fn head(frame: &[u8]) -> (usize, u8, u32) {
    if frame[0] == 0xfe {
        (HEADER_V1, frame[3], u32::from(frame[5]))
    } else {
        (HEADER_V2, frame[5], u32::from_le_bytes([frame[7], frame[8], frame[9], 0]))
    }
}

fn judge(datagram: &[u8], range: Range<usize>) -> Frame {
    let bytes = &datagram[range.clone()];
    let payload = usize::from(bytes[1]);
    let (header, system, id) = head(bytes);
    let end = header + payload;
    let checksum = u16::from_le_bytes([bytes[end], bytes[end + 1]]);
    let known = MavMessage::default_message_from_id(id).is_some();
    let valid = known && calculate_crc(&bytes[1..end], MavMessage::extra_crc(id)) == checksum;
    Frame { range, system, valid }
}

/// Whole frames cut into pieces of at most `most` bytes, each of whole frames.
pub fn datagrams(mut frames: &[u8], most: usize) -> impl Iterator<Item = &[u8]> {
    std::iter::from_fn(move || {
        let mut end = 0;
        while let Some(length) = length(&frames[end..]).filter(|length| end + length <= frames.len()) {
            if end > 0 && end + length > most {
                break;
            }
            end += length;
        }
        // What is no frame goes as it is.
        let (piece, rest) = frames.split_at(if end == 0 { frames.len() } else { end });
        frames = rest;
        (!piece.is_empty()).then_some(piece)
    })
}

#[cfg(test)]
mod tests {
    use glissade_dialect::HEARTBEAT_DATA;
    use glissade_dialect::mavlink_core::MAVLinkV1MessageRaw;

    use super::*;

    const FROM: MavHeader = MavHeader { system_id: 255, component_id: 190, sequence: 0 };

    fn heartbeat() -> Vec<u8> {
        Component::new(255, 190).frame(&HEARTBEAT_DATA { mavtype: 6, ..HEARTBEAT_DATA::DEFAULT })
    }

    #[test]
    fn frames_of_both_versions_are_found_among_noise_and_half_ones_are_not() {
        let mut v1 = MAVLinkV1MessageRaw::new();
        v1.serialize_message_data(FROM, &HEARTBEAT_DATA { mavtype: 6, ..HEARTBEAT_DATA::DEFAULT });
        let (one, two) = (heartbeat(), v1.raw_bytes());
        let datagram = [b"noise", &one[..], two, &one[..10]].concat();
        let found: Vec<Frame> = whole(&datagram).collect();
        let end = 5 + one.len() + two.len();
        assert_eq!(
            found,
            [
                Frame { range: 5..5 + one.len(), system: 255, valid: true },
                Frame { range: 5 + one.len()..end, system: 255, valid: true },
            ]
        );
    }

    #[test]
    fn a_valid_frame_is_found_behind_half_a_one() {
        let (one, two) = (&heartbeat()[..12], heartbeat());
        let stream = [one, &two].concat();
        assert!(whole(&stream).all(|frame| !frame.valid), "the half swallows the rest");
        assert_eq!(first_valid(&stream), Some(Frame { range: 12..12 + two.len(), system: 255, valid: true }));
        assert_eq!(first_valid(&stream[..stream.len() - 1]), None);
    }

    #[test]
    fn a_damaged_frame_is_not_valid() {
        let mut frame = heartbeat();
        frame[12] ^= 1;
        assert!(whole(&frame).all(|frame| !frame.valid));
    }

    #[test]
    fn a_component_numbers_its_frames() {
        let mut component = Component::new(255, 190);
        let numbers = (0..300).map(|_| component.frame(&HEARTBEAT_DATA::DEFAULT)[4]);
        assert!(numbers.eq((0..300).map(|number| number as u8)));
    }

    #[test]
    fn pieces_are_whole_frames() {
        let one = heartbeat();
        let many = one.repeat(10);
        let pieces: Vec<&[u8]> = datagrams(&many, 3 * one.len() + 1).collect();
        assert_eq!(pieces.iter().map(|piece| piece.len() / one.len()).collect::<Vec<_>>(), [3, 3, 3, 1]);
        assert_eq!(pieces.concat(), many);
    }
}
