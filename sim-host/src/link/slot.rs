//! A link: who is there, how its bytes travel, and those that have come and wait for the vehicle.

use std::net::{IpAddr, Ipv4Addr, SocketAddr, UdpSocket};
use std::time::Instant;

use firmware::mavlink::port::Profile;

use super::tcp::Connection;
use super::{Peer, frames};

/// Bytes of a stream in which a whole frame is looked for.
pub(super) const TAIL_MAX: usize = 2 * frames::LONGEST;
/// What is sent is cut so that no network has to.
const SENT_MAX: usize = 1_400;

/// Who is at a link.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each tells something else of who is there")]
pub(super) struct Occupant {
    pub(super) address: SocketAddr,
    pub(super) profile: Profile,
    /// Whether it was not named at the start.
    pub(super) guest: bool,
    /// Whether it is a default peer, which nobody has asked for, and was never heard.
    pub(super) presumed: bool,
    /// Whether it has connected and sent something else than MAVLink.
    pub(super) junk: bool,
    /// Whether it has connected and sent anything.
    pub(super) spoken: bool,
    pub(super) heard: Instant,
    /// Whether the vehicle has been told of it.
    pub(super) opened: bool,
}

impl Occupant {
    pub(super) fn guest(address: SocketAddr, now: Instant) -> Self {
        let profile = Profile::Normal;
        Self { address, profile, guest: true, presumed: false, junk: false, spoken: false, heard: now, opened: false }
    }

    pub(super) fn peer(peer: Peer, presumed: bool) -> Self {
        let Peer { address, profile } = peer;
        Self {
            address,
            profile,
            guest: false,
            presumed,
            junk: false,
            spoken: false,
            heard: Instant::now(),
            opened: false,
        }
    }

    /// The pilot of this process, at an address from which no datagram comes.
    pub(super) fn pilot() -> Self {
        Self::peer(
            Peer { address: SocketAddr::new(IpAddr::V4(Ipv4Addr::UNSPECIFIED), 0), profile: Profile::Normal },
            false,
        )
    }

    /// Whether it is a default peer of this machine at whose port nobody listens: it can be bound.
    pub(super) fn is_nobody(&self) -> bool {
        self.presumed && self.address.ip().is_loopback() && UdpSocket::bind(self.address).is_ok()
    }
}

/// How the bytes of a link travel.
#[derive(Debug, Default)]
pub(super) enum Carrier {
    /// By the socket that all UDP peers share.
    #[default]
    Datagrams,
    /// By a TCP connection of its own.
    Stream(Connection),
    /// Within this process: the pilot's, whom nothing needs to be sent.
    Inside,
}

/// A link: who is there, and what has come from there.
#[derive(Debug, Default)]
pub(super) struct Slot {
    pub(super) peer: Option<Occupant>,
    /// How its bytes travel.
    pub(super) carrier: Carrier,
    pub(super) inbox: Vec<u8>,
    /// The end of what has come by the connection, in which no valid frame was found yet.
    pub(super) tail: Vec<u8>,
    pub(super) lost: u32,
    /// It has closed its connection, or its half of it: the link stays until the vehicle has read what was sent before,
    /// and for its answers.
    pub(super) ended: bool,
    /// When the vehicle had read all from one that has ended.
    pub(super) read: Option<Instant>,
}

impl Slot {
    /// The system of the first valid frame in what has come by the connection, the last bytes in the inbox from `from` on
    /// among it.
    pub(super) fn find_frame(&mut self, from: usize) -> Option<u8> {
        self.tail.extend_from_slice(&self.inbox[from..]);
        let (mut found, mut passed) = (None, 0);
        while let Some(frame) = frames::first_valid(&self.tail[passed..]) {
            found = found.or(Some(frame.system));
            passed += frame.range.end;
        }
        self.tail.drain(..passed.max(self.tail.len().saturating_sub(TAIL_MAX)));
        found
    }

    /// Whether who is there has not taken what was sent before.
    pub(super) fn is_busy(&mut self) -> bool {
        if let Carrier::Stream(connection) = &mut self.carrier { connection.is_busy() } else { false }
    }

    /// Sends whole frames to whoever is there.
    pub(super) fn send(&mut self, socket: &UdpSocket, frames: &[u8]) {
        match (&mut self.carrier, &self.peer) {
            (Carrier::Stream(connection), _) => connection.write(frames),
            (Carrier::Datagrams, Some(peer)) => frames::datagrams(frames, SENT_MAX).for_each(|piece| {
                let _ = socket.send_to(piece, peer.address);
            }),
            // The console prints what the vehicle answers, whoever has asked.
            (Carrier::Inside, _) | (Carrier::Datagrams, None) => {}
        }
    }
}
