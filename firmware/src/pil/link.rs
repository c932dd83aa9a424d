//! The links to ground stations: what happens on one before a tick, and what has been sent on it.

use super::words::{Reader, Words, Writer};
use crate::mavlink::port::{LINKS, LinkEvent, Ports, Profile, SENT_CAPACITY};

/// Bytes that one frame carries, at most. More need several frames before a tick.
pub const PIECE_BYTES: usize = 140;

/// Bytes that a ground station has sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    length: u32,
    bytes: [u8; PIECE_BYTES],
}

impl Piece {
    /// The first bytes, as many as fit, and the rest.
    pub fn split(from: &[u8]) -> (Self, &[u8]) {
        let (first, rest) = from.split_at(from.len().min(PIECE_BYTES));
        let mut bytes = [0; PIECE_BYTES];
        for (to, byte) in bytes.iter_mut().zip(first) {
            *to = *byte;
        }
        (Self { length: first.len() as u32, bytes }, rest)
    }

    /// The bytes.
    pub fn bytes(&self) -> &[u8] {
        self.bytes.get(..self.length as usize).unwrap_or(&self.bytes)
    }
}

/// What happens on a link: a [`LinkEvent`] that owns its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Signal {
    /// There is a new peer.
    Open(Profile),
    /// The peer has gone.
    Close,
    /// So many bytes were lost.
    Lost(u32),
    /// Bytes have arrived.
    Received(Piece),
}

impl Signal {
    /// For the port.
    pub fn event(&self) -> LinkEvent<'_> {
        match self {
            Self::Open(profile) => LinkEvent::Open(*profile),
            Self::Close => LinkEvent::Close,
            Self::Lost(count) => LinkEvent::Lost(*count),
            Self::Received(piece) => LinkEvent::Received(piece.bytes()),
        }
    }

    /// An event as one signal, or of many bytes as several.
    pub fn each(event: LinkEvent, mut signal: impl FnMut(Self)) {
        match event {
            LinkEvent::Open(profile) => signal(Self::Open(profile)),
            LinkEvent::Close => signal(Self::Close),
            LinkEvent::Lost(count) => signal(Self::Lost(count)),
            LinkEvent::Received(mut bytes) => {
                while !bytes.is_empty() {
                    let (piece, rest) = Piece::split(bytes);
                    signal(Self::Received(piece));
                    bytes = rest;
                }
            }
        }
    }
}

/// What, a number, and bytes.
impl Words for Signal {
    const WORDS: usize = 2 + PIECE_BYTES / 4;

    fn write(&self, to: &mut Writer) {
        let (what, number) = match self {
            Self::Open(Profile::Normal) => (0, 0),
            Self::Open(Profile::Onboard) => (0, 1),
            Self::Close => (1, 0),
            Self::Lost(count) => (2, *count),
            Self::Received(piece) => (3, piece.length),
        };
        to.word(what);
        to.word(number);
        if let Self::Received(piece) = self {
            let (words, _) = piece.bytes.as_chunks();
            for word in words {
                to.word(u32::from_le_bytes(*word));
            }
        }
    }

    fn read(from: &mut Reader) -> Option<Self> {
        Some(match (from.word()?, from.word()?) {
            (0, 0) => Self::Open(Profile::Normal),
            (0, 1) => Self::Open(Profile::Onboard),
            (1, 0) => Self::Close,
            (2, count) => Self::Lost(count),
            (3, length) if length as usize <= PIECE_BYTES => {
                let mut bytes = [0; PIECE_BYTES];
                let (words, _) = bytes.as_chunks_mut();
                for word in words {
                    *word = from.word()?.to_le_bytes();
                }
                Self::Received(Piece { length, bytes })
            }
            _ => return None,
        })
    }
}

/// All that has been sent on a link since boot: how many bytes, and their checksum (FNV-1a, 32 bits), so that every one of
/// them is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sent {
    /// Bytes, modulo 2³².
    pub bytes: u32,
    /// Checksum of all of them.
    pub checksum: u32,
}

impl Default for Sent {
    fn default() -> Self {
        Self { bytes: 0, checksum: 0x811c_9dc5 }
    }
}

impl Sent {
    pub(super) fn add(&mut self, byte: u8) {
        self.bytes = self.bytes.wrapping_add(1);
        self.checksum = (self.checksum ^ u32::from(byte)).wrapping_mul(0x0100_0193);
    }
}

/// What has been sent on each link.
pub type AllSent = [Sent; LINKS];

/// Takes all that can be sent now, in place of the links' drivers. To be called after each tick of the inner task.
pub fn take_sent(ports: &Ports, sent: &mut AllSent) {
    for (port, sent) in ports.iter().zip(sent) {
        // No more than these are ever there.
        for _ in 0..SENT_CAPACITY {
            let Some(byte) = port.next_byte() else { break };
            sent.add(byte);
        }
    }
}
