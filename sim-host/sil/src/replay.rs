//! What came to the vehicle from outside while it was flown by hand: the same again, at the same ticks.
//!
//! Bytes of ground stations, links that open and close, and what a console asked. The flight depends on nothing else that
//! is not in its scenario, so it is the same, bit for bit.

use std::sync::Arc;

use firmware::commander::Asked;
use firmware::mavlink::port::{LinkEvent, Ports, Profile};
use firmware::pil::{AllSent, take_sent};
use firmware::signals::Tick;

/// What happened on a link: a [`LinkEvent`] that owns its bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OnLink {
    /// A new peer.
    Open(Profile),
    /// The peer has gone.
    Close,
    /// So many bytes were lost on the way.
    Lost(u32),
    /// Bytes have arrived.
    Received(Vec<u8>),
}

impl OnLink {
    /// For the vehicle's port.
    pub fn event(&self) -> LinkEvent<'_> {
        match self {
            Self::Open(profile) => LinkEvent::Open(*profile),
            Self::Close => LinkEvent::Close,
            Self::Lost(count) => LinkEvent::Lost(*count),
            Self::Received(bytes) => LinkEvent::Received(bytes),
        }
    }
}

impl From<LinkEvent<'_>> for OnLink {
    fn from(event: LinkEvent) -> Self {
        match event {
            LinkEvent::Open(profile) => Self::Open(profile),
            LinkEvent::Close => Self::Close,
            LinkEvent::Lost(count) => Self::Lost(count),
            LinkEvent::Received(bytes) => Self::Received(bytes.to_vec()),
        }
    }
}

/// What came from outside.
#[derive(Clone, Debug, PartialEq)]
pub enum Input {
    /// On a link.
    Link {
        /// Its number.
        link: usize,
        /// What happened.
        event: OnLink,
    },
    /// From a program on board.
    Ask(Asked),
}

/// An input, and the tick before which it came.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The tick.
    pub tick: Tick,
    /// The input.
    pub input: Input,
}

/// The inputs of a flight, and what the vehicle has sent.
#[derive(Clone, Debug)]
pub struct Replay {
    /// By rising ticks.
    entries: Arc<[Entry]>,
    next: usize,
    sent: AllSent,
}

impl Replay {
    /// Before the first tick; the entries stand in the order of their ticks.
    pub fn new(entries: Arc<[Entry]>) -> Self {
        Self { entries, next: 0, sent: AllSent::default() }
    }

    /// What comes before this tick; once.
    pub(crate) fn due(&mut self, tick: Tick) -> &[Entry] {
        let rest = self.entries.get(self.next..).unwrap_or_default();
        let count = rest.iter().take_while(|entry| entry.tick <= tick).count();
        self.next += count;
        &rest[..count]
    }

    /// Takes what the vehicle sends.
    pub(crate) fn take_sent(&mut self, ports: &Ports) {
        take_sent(ports, &mut self.sent);
    }

    /// What the vehicle has sent on each link so far.
    pub fn sent(&self) -> &AllSent {
        &self.sent
    }
}
