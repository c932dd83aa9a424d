//! The vehicle's links over UDP and TCP, and the one of a pilot in this process: each peer has one of its own.
//!
//! Owns the sockets and who has which link: the configured peers for good (the defaults while somebody listens there, or
//! nobody else wants the link), and up to [`LINKS`] in all every other address that a valid frame has come from, and
//! everyone who connects. A datagram that cannot be sent is dropped, as the network
//! may drop it too.

pub mod address;
pub mod frames;
mod slot;
mod tcp;

use std::collections::VecDeque;
use std::io::ErrorKind;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, TcpListener, UdpSocket};
use std::time::{Duration, Instant};

use anyhow::{Context, bail, ensure};
use firmware::mavlink::port::{LINKS, LinkEvent, Ports, Profile, SENT_CAPACITY};

use self::address::{cannot_listen, cannot_listen_by_tcp, elsewhere, is_own};
use self::slot::{Carrier, Occupant, Slot};
use self::tcp::Connection;
use crate::stations::{News, Stations};

/// The default address on which `serve` listens.
pub const DEFAULT_LISTEN: &str = "127.0.0.1:14580";
/// The address on which `serve --tcp` listens for connections.
pub const DEFAULT_TCP: &str = "127.0.0.1:5760";
/// The default peers of `serve`: ground stations, and programs that use MAVSDK.
pub const DEFAULT_PEERS: [Peer; 2] =
    [Peer::here(PEER_PORT, Profile::Normal), Peer::here(ONBOARD_PORT, Profile::Onboard)];

/// Whom the vehicle sends to without having heard of them, and how much.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Peer {
    /// Where they listen.
    pub address: SocketAddr,
    /// What they are told.
    pub profile: Profile,
}

impl Peer {
    /// The option that names it.
    pub fn option(&self) -> &'static str {
        match self.profile {
            Profile::Normal => "--peer",
            Profile::Onboard => "--onboard",
        }
    }

    /// On this machine.
    const fn here(port: u16, profile: Profile) -> Self {
        Self { address: SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), port), profile }
    }
}

/// Refuses an address that is given twice: it would be sent everything twice.
fn require_different(peers: &[Peer]) -> anyhow::Result<()> {
    for (number, peer) in peers.iter().enumerate() {
        if let Some(first) = peers[..number].iter().find(|first| first.address == peer.address) {
            let (first, second, address) = (first.option(), peer.option(), peer.address);
            ensure!(first == second, "{address} is given by {first} and by {second}: leave one of them out");
            bail!("{first} {address} is given twice: leave one of them out");
        }
    }
    Ok(())
}

/// The port of each, where an address is given without one.
pub const LISTEN_PORT: u16 = 14580;
/// See [`LISTEN_PORT`].
pub const TCP_PORT: u16 = 5760;
/// See [`LISTEN_PORT`].
pub const PEER_PORT: u16 = 14550;
/// See [`LISTEN_PORT`].
pub const ONBOARD_PORT: u16 = 14540;
/// The default port of the program of a vehicle beyond the tenth, as PX4 has it: further ones would be ground stations'.
pub const LAST_ONBOARD_PORT: u16 = PEER_PORT - 1;

/// A guest that has been silent this long has gone; ground stations send a heartbeat every second.
const FORGET_AFTER: Duration = Duration::from_secs(10);
/// A guest that has been silent this long gives way to a new one.
const YIELD_AFTER: Duration = Duration::from_secs(3);
/// Connections that wait for a link, and how long: silent guests give way meanwhile.
const WAITING_MAX: usize = 8;
/// See [`WAITING_MAX`].
const WAIT_AT_MOST: Duration = Duration::from_secs(5);
/// A link stays this long after its connection has ended and all of it was read, for the answers.
const ANSWER_WITHIN: Duration = Duration::from_millis(250);
/// Datagrams read at one go, so that a flood cannot hold up the flight.
const BURST: usize = 256;
/// No datagram is larger.
const DATAGRAM_MAX: usize = 65_536;
/// Bytes of a peer that wait for its link; the rest is lost, and counted.
const INBOX_MAX: usize = 65_536;

/// Sockets that never block, and their peers.
#[derive(Debug)]
pub struct Links {
    socket: UdpSocket,
    server: Option<TcpListener>,
    slots: [Slot; LINKS],
    /// Connections that have no link yet, and since when.
    waiting: VecDeque<(Connection, SocketAddr, Instant)>,
    /// Default peers that have given way to guests.
    absent: Vec<Peer>,
    stations: Stations,
    datagram: Vec<u8>,
}

impl Links {
    /// Listens on an address; what is sent goes to `peers`, and to whoever sends a valid frame.
    ///
    /// # Errors
    /// One line that names the address, and what to do, if it cannot be listened on; more peers than links.
    pub fn bind(listen: SocketAddr, peers: &[Peer]) -> anyhow::Result<Self> {
        let addresses: Vec<SocketAddr> = peers.iter().map(|peer| peer.address).collect();
        if let Some(peer) = peers.iter().find(|peer| peer.address.port() == 0) {
            let (option, address) = (peer.option(), peer.address);
            let port = if peer.profile == Profile::Onboard { ONBOARD_PORT } else { PEER_PORT };
            bail!("{option} {address} has no port from 1 to 65535: use {}", SocketAddr::new(address.ip(), port));
        }
        require_different(peers)?;
        if let Some(peer) = addresses.iter().find(|peer| peer.is_ipv4() != listen.is_ipv4()) {
            bail!("cannot send from {listen} to {peer}: one is IPv4, the other IPv6: give both of one kind");
        }
        if let (true, Some(far)) = (listen.ip().is_loopback(), addresses.iter().find(|peer| !peer.ip().is_loopback())) {
            bail!(
                "cannot send from {listen}, which reaches this machine alone, to {far}: add --listen :{}",
                listen.port()
            );
        }
        ensure!(peers.len() <= LINKS, "{} peers are given, but the vehicle has {LINKS} links", peers.len());
        let socket = UdpSocket::bind(listen).map_err(|error| cannot_listen(listen, &addresses, &error))?;
        let own = socket.local_addr().unwrap_or(listen);
        if let Some(peer) = peers.iter().find(|peer| is_own(own, &peer.address)) {
            bail!(
                "{} {} is where the vehicle itself listens: give the ground station's address, as {}",
                peer.option(),
                peer.address,
                elsewhere(own)
            );
        }
        socket.set_nonblocking(true).with_context(|| format!("cannot use UDP address {listen}"))?;
        let mut slots: [Slot; LINKS] = Default::default();
        for (slot, peer) in slots.iter_mut().zip(peers) {
            slot.peer = Some(Occupant::peer(*peer, false));
        }
        Ok(Self {
            socket,
            server: None,
            slots,
            waiting: VecDeque::new(),
            absent: Vec::new(),
            stations: Stations::default(),
            datagram: vec![0; DATAGRAM_MAX],
        })
    }

    /// Its peers are the defaults, which nobody has asked for: those at whose port nobody listens give way to guests.
    #[must_use]
    pub fn presuming_its_peers(mut self) -> Self {
        self.slots.iter_mut().filter_map(|slot| slot.peer.as_mut()).for_each(|peer| peer.presumed = true);
        self
    }

    /// Gives a link to the pilot of this process, for good. Returns its number.
    ///
    /// # Errors
    /// One line, if peers have all of them.
    pub fn seat_pilot(&mut self) -> anyhow::Result<u8> {
        let free = (0..).zip(&mut self.slots).find(|(_, slot)| slot.peer.is_none());
        let Some((number, slot)) = free else {
            bail!("a pilot needs one of the vehicle's {LINKS} links: name at most {} peers", LINKS - 1);
        };
        *slot = Slot { peer: Some(Occupant::pilot()), carrier: Carrier::Inside, ..Slot::default() };
        Ok(number)
    }

    /// Whole frames of the pilot, for the next tick.
    pub fn hear_pilot(&mut self, frames: &[u8]) {
        let seat = self.slots.iter_mut().find(|slot| matches!(slot.carrier, Carrier::Inside));
        if let Some(slot) = seat.filter(|slot| slot.inbox.len() + frames.len() <= INBOX_MAX) {
            slot.inbox.extend_from_slice(frames);
        }
    }

    /// Takes connections over TCP too.
    ///
    /// # Errors
    /// One line that names the address, and what to do, if it cannot be listened on.
    pub fn serve_tcp(&mut self, listen: SocketAddr) -> anyhow::Result<SocketAddr> {
        let server = TcpListener::bind(listen).map_err(|error| cannot_listen_by_tcp(listen, &error))?;
        server.set_nonblocking(true).with_context(|| format!("cannot use TCP address {listen}"))?;
        let address = server.local_addr().context("the server has no address")?;
        self.server = Some(server);
        Ok(address)
    }

    /// The address on which it listens; with the port that was assigned for port 0.
    ///
    /// # Errors
    /// The system's.
    pub fn local_address(&self) -> anyhow::Result<SocketAddr> {
        self.socket.local_addr().context("the socket has no address")
    }

    /// Reads what has arrived, without waiting.
    pub fn receive(&mut self) {
        let mut datagram = core::mem::take(&mut self.datagram);
        for _ in 0..BURST {
            match self.socket.recv_from(&mut datagram) {
                Ok((length, from)) => self.take(from, &datagram[..length], Instant::now()),
                // An earlier datagram found nobody at its port: no news about what has arrived.
                Err(error) if matches!(error.kind(), ErrorKind::ConnectionRefused | ErrorKind::ConnectionReset) => {}
                Err(_) => break,
            }
        }
        self.datagram = datagram;
        self.accept();
        self.read_connections();
    }

    /// Gives a link to everyone who has connected, before anything is heard: stations that connect wait for the vehicle.
    /// Who finds none free waits a while for one, and is turned away then.
    fn accept(&mut self) {
        while let Some((stream, address)) = self.server.as_ref().and_then(|server| server.accept().ok()) {
            let Some(connection) = Connection::new(stream) else { continue };
            if self.waiting.len() < WAITING_MAX {
                self.waiting.push_back((connection, address, Instant::now()));
            } else {
                self.stations.turn_away(address);
            }
        }
        self.seat(Instant::now());
    }

    /// Gives links to those who wait for one, in turn.
    fn seat(&mut self, now: Instant) {
        while let Some((connection, address, since)) = self.waiting.pop_front() {
            if let Some(number) = self.place_for_guest(now) {
                self.put(number, Occupant::guest(address, now), Carrier::Stream(connection));
            } else if now.saturating_duration_since(since) > WAIT_AT_MOST {
                self.stations.turn_away(address);
            } else {
                self.waiting.push_front((connection, address, since));
                return;
            }
        }
    }

    /// Gives a link to someone; a default peer that gives way is kept in mind.
    fn put(&mut self, number: usize, peer: Occupant, carrier: Carrier) {
        let Some(slot) = self.slots.get_mut(number) else { return };
        let before = core::mem::replace(slot, Slot { peer: Some(peer), carrier, ..Slot::default() });
        if let Some(Occupant { address, profile, presumed: true, .. }) = before.peer {
            self.absent.push(Peer { address, profile });
        }
    }

    fn read_connections(&mut self) {
        let now = Instant::now();
        for slot in &mut self.slots {
            let Carrier::Stream(connection) = &mut slot.carrier else { continue };
            let before = slot.inbox.len();
            slot.ended = slot.ended || !connection.read(&mut slot.inbox, INBOX_MAX);
            if slot.inbox.len() == before {
                continue;
            }
            // No frame begins so, and none has come yet: this is no station.
            let begins_wrong = slot.inbox.get(before).is_some_and(|byte| ![0xfd, 0xfe].contains(byte));
            let system = slot.find_frame(before);
            let Some(peer) = &mut slot.peer else { continue };
            peer.junk |= begins_wrong && !peer.spoken;
            peer.spoken = true;
            if let Some(system) = system {
                (peer.heard, peer.junk) = (now, false);
                self.stations.hear(peer.address, system, now);
            }
        }
    }

    /// Puts a datagram's whole frames into its sender's inbox. Whoever has sent no valid frame yet is nobody.
    fn take(&mut self, from: SocketAddr, datagram: &[u8], now: Instant) {
        let valid = frames::whole(datagram).find(|frame| frame.valid);
        let Some(slot) = self.slot_of(from, valid.is_some(), now) else { return };
        let bytes: usize = frames::whole(datagram).map(|frame| frame.range.len()).sum();
        if slot.inbox.len() + bytes > INBOX_MAX {
            slot.lost = slot.lost.saturating_add(datagram.len() as u32);
            return;
        }
        frames::whole(datagram).for_each(|frame| slot.inbox.extend_from_slice(&datagram[frame.range]));
        slot.lost = slot.lost.saturating_add((datagram.len() - bytes) as u32);
        if let Some(frame) = valid {
            self.stations.hear(from, frame.system, now);
        }
    }

    /// The link of an address; a new one if it has sent a valid frame and there is room.
    fn slot_of(&mut self, from: SocketAddr, valid: bool, now: Instant) -> Option<&mut Slot> {
        let known = self.slots.iter().position(|slot| slot.peer.is_some_and(|peer| peer.address == from));
        let number = match known {
            Some(number) => number,
            None if valid => {
                let Some(number) = self.place_for_guest(now) else {
                    self.stations.turn_away(from);
                    return None;
                };
                self.absent.retain(|peer| peer.address != from);
                self.put(number, Occupant::guest(from, now), Carrier::Datagrams);
                number
            }
            None => return None,
        };
        let slot = self.slots.get_mut(number)?;
        if let Some(peer) = slot.peer.as_mut().filter(|_| valid) {
            (peer.heard, peer.presumed) = (now, false);
        }
        Some(slot)
    }

    /// A free link, that of a default peer who is not there, or of the guest that has been silent for longest.
    fn place_for_guest(&self, now: Instant) -> Option<usize> {
        if let Some(free) = self.slots.iter().position(|slot| slot.peer.is_none()) {
            return Some(free);
        }
        let silent = |slot: &Slot| match slot.peer {
            Some(peer) if peer.is_nobody() || peer.junk || slot.read.is_some() => Some(Duration::MAX),
            Some(peer) if peer.guest => Some(now.saturating_duration_since(peer.heard)),
            _ => None,
        };
        let places = self.slots.iter().enumerate().filter_map(|(number, slot)| Some((silent(slot)?, number)));
        // Of several the first.
        let longest = places.max_by_key(|(silent, number)| (*silent, core::cmp::Reverse(*number)));
        longest.filter(|(silent, _)| *silent > YIELD_AFTER).map(|(_, number)| number)
    }

    /// Hands on what has arrived, as much as the vehicle takes, and tells it which links are open. Of each link's events
    /// `note` is told too, with its number.
    pub fn deliver(&mut self, ports: &Ports, note: impl FnMut(usize, LinkEvent)) {
        self.deliver_at(Instant::now(), ports, note);
    }

    fn deliver_at(&mut self, now: Instant, ports: &Ports, mut note: impl FnMut(usize, LinkEvent)) {
        for (number, (slot, port)) in self.slots.iter_mut().zip(ports).enumerate() {
            let mut hand_on = |event: LinkEvent| {
                port.take_in(event);
                note(number, event);
            };
            let Some(peer) = &mut slot.peer else {
                if port.is_open() {
                    hand_on(LinkEvent::Close);
                }
                continue;
            };
            if !peer.opened {
                peer.opened = true;
                hand_on(LinkEvent::Open(peer.profile));
            }
            if slot.lost > 0 {
                hand_on(LinkEvent::Lost(core::mem::take(&mut slot.lost)));
            }
            let count = slot.inbox.len().min(port.room());
            if count > 0 {
                hand_on(LinkEvent::Received(&slot.inbox[..count]));
                slot.inbox.drain(..count);
            }
            if slot.ended && slot.inbox.is_empty() && port.received().held() == 0 {
                let read = *slot.read.get_or_insert(now);
                if now.saturating_duration_since(read) >= ANSWER_WITHIN {
                    hand_on(LinkEvent::Close);
                    *slot = Slot::default();
                }
            }
        }
    }

    /// The next ground station that was heard for the first time or lost, if any.
    pub fn news(&mut self) -> Option<News> {
        self.stations.news(Instant::now())
    }

    /// Sends each link's bytes to its peer. Nobody listening is not an error.
    pub fn send(&mut self, ports: &Ports) {
        for (slot, port) in self.slots.iter_mut().zip(ports) {
            // What a slow station has not taken keeps the rest with the vehicle, which thins its telemetry then.
            if port.has_output() && !slot.is_busy() {
                slot.send(&self.socket, port.take(&mut [0; SENT_CAPACITY]));
            }
        }
    }

    /// Sends frames that come from no link to every peer.
    pub fn tell(&mut self, frames: &[u8]) {
        let socket = &self.socket;
        self.slots
            .iter_mut()
            .filter_map(|slot| (!slot.is_busy()).then_some(slot))
            .for_each(|slot| slot.send(socket, frames));
    }

    /// Forgets guests that have gone.
    pub fn forget_silent(&mut self) {
        self.forget_at(Instant::now());
    }

    fn forget_at(&mut self, now: Instant) {
        // Who is connected is there.
        for slot in self.slots.iter_mut().filter(|slot| matches!(slot.carrier, Carrier::Datagrams)) {
            if slot.peer.is_some_and(|peer| peer.guest && now.saturating_duration_since(peer.heard) > FORGET_AFTER) {
                *slot = Slot::default();
            }
        }
        // A default peer comes back to a link that nobody waits for: who listens there is to hear without having spoken.
        if self.waiting.is_empty()
            && let Some(slot) = self.slots.iter_mut().find(|slot| slot.peer.is_none())
            && let Some(peer) = self.absent.pop()
        {
            *slot = Slot { peer: Some(Occupant::peer(peer, true)), ..Slot::default() };
        }
    }
}

#[cfg(test)]
mod tests;
