//! The UDP link of MAVLink: bytes in datagrams, without regard to their contents.
//!
//! Owns the socket and the list of receivers: the configured peers, and every address that has sent something lately. A
//! datagram that cannot be sent is dropped, as the network may drop it too.

use std::io::ErrorKind;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, ToSocketAddrs as _, UdpSocket};
use std::time::{Duration, Instant};

use anyhow::{Context, anyhow, bail, ensure};

use crate::stations::{News, Stations};

/// The default address on which `serve` listens.
pub const DEFAULT_LISTEN: &str = "127.0.0.1:14580";
/// The default peers of `serve`: ground stations, and programs that use MAVSDK.
pub const DEFAULT_PEERS: [&str; 2] = ["127.0.0.1:14550", "127.0.0.1:14540"];

/// The port of each, where an address is given without one.
pub const LISTEN_PORT: u16 = 14580;
/// See [`LISTEN_PORT`].
pub const PEER_PORT: u16 = 14550;

/// Nothing is sent to a guest that has been silent this long; ground stations send a heartbeat every second.
const FORGET_AFTER: Duration = Duration::from_secs(10);
/// More guests than this are not kept, so that a port scan cannot make the list grow.
const GUESTS_MAX: usize = 16;
/// Datagrams read at one go, so that a flood cannot hold up the flight.
const BURST: usize = 64;
/// Larger than any datagram of MAVLink; the rest of a larger one is lost.
const DATAGRAM_MAX: usize = 2048;

/// An address as a user writes it: `127.0.0.1:14550`, `localhost`, `[::1]:14550`; `:14580` for every interface.
///
/// # Errors
/// One line with the invalid text and a valid example, or the unknown host.
pub fn address(text: &str, default_port: u16) -> anyhow::Result<SocketAddr> {
    if let Ok(address) = text.parse() {
        return Ok(address);
    }
    ensure!(!text.trim().is_empty(), "the address is missing: use 127.0.0.1:{default_port}");
    // The system would take a whole number for an address.
    if text.parse::<u32>().is_ok() {
        let port = text.parse::<u16>().ok();
        let port =
            port.with_context(|| format!("`{text}` is no port from 0 to 65535: use 127.0.0.1:{default_port}"))?;
        bail!("`{text}` is no address: for a port use 127.0.0.1:{port}");
    }
    let in_brackets = text.strip_prefix('[').and_then(|text| text.strip_suffix(']'));
    if let Ok(ip) = in_brackets.unwrap_or(text).parse::<IpAddr>() {
        return Ok(SocketAddr::new(ip, default_port));
    }
    let (host, port) = text.rsplit_once(':').map_or((text, None), |(host, port)| (host, Some(port)));
    ensure!(!host.contains(['/', ':', '[', ']', ' ']), "`{text}` is no address: use 127.0.0.1:{default_port}");
    let port = match port {
        Some(port) => {
            let port = port.parse::<u16>().ok();
            port.with_context(|| format!("`{text}` has no port from 0 to 65535: use {host}:{default_port}"))?
        }
        None => default_port,
    };
    if host.is_empty() {
        return Ok(SocketAddr::new(IpAddr::V4(Ipv4Addr::UNSPECIFIED), port));
    }
    let known = (host, port).to_socket_addrs().map(Iterator::collect::<Vec<_>>).unwrap_or_default();
    // `localhost` is both; ground stations listen by IPv4.
    let chosen = known.iter().find(|address| address.is_ipv4()).or(known.first());
    chosen.copied().with_context(|| format!("the host `{host}` is not known: use an address, as 127.0.0.1:{port}"))
}

/// The same address with the port beside its own.
fn beside(address: SocketAddr) -> SocketAddr {
    let port = address.port();
    SocketAddr::new(address.ip(), if port == u16::MAX { port - 1 } else { port + 1 })
}

fn cannot_listen(listen: SocketAddr, peers: &[SocketAddr], error: &std::io::Error) -> anyhow::Error {
    let (ip, port) = (listen.ip(), listen.port());
    match error.kind() {
        ErrorKind::AddrInUse => {
            let peer = peers.first().copied().unwrap_or_else(|| elsewhere(listen));
            anyhow!(
                "{listen} is in use (another `sim-host serve`?): stop it, or fly another vehicle for another ground \
                 station with --listen {} --peer {}",
                beside(listen),
                beside(peer)
            )
        }
        ErrorKind::AddrNotAvailable => {
            anyhow!("{ip} is no address of this machine: use --listen 127.0.0.1:{port}, or :{port} for all of its own")
        }
        ErrorKind::PermissionDenied => {
            anyhow!("port {port} is for privileged programs: choose one from 1024 up, as --listen {ip}:14580")
        }
        _ => anyhow!("cannot listen on UDP address {listen}: {error}"),
    }
}

/// Whether what is sent to `peer` comes in at `own` again.
fn is_own(own: SocketAddr, peer: &SocketAddr) -> bool {
    // Only an address of this machine can be bound.
    let is_this_machine = || UdpSocket::bind((peer.ip(), 0)).is_ok();
    own.port() == peer.port() && (own.ip() == peer.ip() || (own.ip().is_unspecified() && is_this_machine()))
}

/// Where ground stations listen on this machine, unless that is `own`.
fn elsewhere(own: SocketAddr) -> SocketAddr {
    let ip = if own.ip().is_unspecified() { IpAddr::V4(Ipv4Addr::LOCALHOST) } else { own.ip() };
    SocketAddr::new(ip, if own.port() == PEER_PORT { LISTEN_PORT } else { PEER_PORT })
}

/// A peer that was not named at the start, and when it was last heard.
#[derive(Clone, Copy, Debug)]
struct Guest {
    address: SocketAddr,
    heard: Instant,
}

/// A UDP socket that never blocks.
#[derive(Debug)]
pub struct UdpLink {
    socket: UdpSocket,
    peers: Vec<SocketAddr>,
    guests: Vec<Guest>,
    stations: Stations,
}

impl UdpLink {
    /// Listens on an address; what is sent goes to `peers`, and to whoever sends something.
    ///
    /// # Errors
    /// One line that names the address, and what to do, if it cannot be listened on.
    pub fn bind(listen: SocketAddr, peers: &[SocketAddr]) -> anyhow::Result<Self> {
        if let Some(peer) = peers.iter().find(|peer| peer.port() == 0) {
            bail!("--peer {peer} has no port from 1 to 65535: use {}", SocketAddr::new(peer.ip(), PEER_PORT));
        }
        if let Some(peer) = peers.iter().find(|peer| peer.is_ipv4() != listen.is_ipv4()) {
            bail!("cannot send from {listen} to {peer}: one is IPv4, the other IPv6: give both of one kind");
        }
        if let (true, Some(far)) = (listen.ip().is_loopback(), peers.iter().find(|peer| !peer.ip().is_loopback())) {
            bail!(
                "cannot send from {listen}, which reaches this machine alone, to {far}: add --listen :{}",
                listen.port()
            );
        }
        let socket = UdpSocket::bind(listen).map_err(|error| cannot_listen(listen, peers, &error))?;
        let own = socket.local_addr().unwrap_or(listen);
        if let Some(peer) = peers.iter().find(|peer| is_own(own, peer)) {
            bail!(
                "--peer {peer} is where the vehicle itself listens: give the ground station's address, as {}",
                elsewhere(own)
            );
        }
        socket.set_nonblocking(true).with_context(|| format!("cannot use UDP address {listen}"))?;
        Ok(Self { socket, peers: peers.to_vec(), guests: Vec::new(), stations: Stations::default() })
    }

    /// The address on which it listens; with the port that was assigned for port 0.
    ///
    /// # Errors
    /// The system's.
    pub fn local_address(&self) -> anyhow::Result<SocketAddr> {
        self.socket.local_addr().context("the socket has no address")
    }

    /// Appends what has arrived to `buffer`, without waiting.
    pub fn receive(&mut self, buffer: &mut Vec<u8>) {
        let mut datagram = [0; DATAGRAM_MAX];
        for _ in 0..BURST {
            match self.socket.recv_from(&mut datagram) {
                Ok((length, from)) => {
                    let now = Instant::now();
                    self.welcome(from, now);
                    self.stations.hear(from, &datagram[..length], now);
                    buffer.extend_from_slice(&datagram[..length]);
                }
                // An earlier datagram found nobody at its port: no news about what has arrived.
                Err(error) if matches!(error.kind(), ErrorKind::ConnectionRefused | ErrorKind::ConnectionReset) => {}
                Err(_) => break,
            }
        }
    }

    /// The next ground station that was heard for the first time or lost, if any.
    pub fn news(&mut self) -> Option<News> {
        self.stations.news(Instant::now())
    }

    /// Sends one datagram to everyone. Nobody listening is not an error.
    pub fn send(&mut self, bytes: &[u8]) {
        let now = Instant::now();
        self.guests.retain(|guest| now.duration_since(guest.heard) < FORGET_AFTER);
        for address in self.peers.iter().chain(self.guests.iter().map(|guest| &guest.address)) {
            let _ = self.socket.send_to(bytes, address);
        }
    }

    fn welcome(&mut self, address: SocketAddr, now: Instant) {
        if self.peers.contains(&address) {
            return;
        }
        if let Some(guest) = self.guests.iter_mut().find(|guest| guest.address == address) {
            guest.heard = now;
        } else if self.guests.len() < GUESTS_MAX {
            self.guests.push(Guest { address, heard: now });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn local() -> SocketAddr {
        "127.0.0.1:0".parse().expect("an address")
    }

    fn station() -> UdpSocket {
        let socket = UdpSocket::bind(local()).expect("a free port");
        socket.set_read_timeout(Some(Duration::from_secs(5))).expect("a socket");
        socket
    }

    fn hears(station: &UdpSocket) -> Vec<u8> {
        let mut buffer = [0; 100];
        let length = station.recv(&mut buffer).expect("something was sent");
        buffer[..length].to_vec()
    }

    fn receive_some(link: &mut UdpLink) -> Vec<u8> {
        let mut buffer = Vec::new();
        let start = Instant::now();
        while buffer.is_empty() && start.elapsed() < Duration::from_secs(5) {
            link.receive(&mut buffer);
        }
        buffer
    }

    #[test]
    fn peers_hear_without_having_spoken_and_guests_after() {
        let (peer, guest) = (station(), station());
        let mut link = UdpLink::bind(local(), &[peer.local_addr().expect("bound")]).expect("a free port");
        link.send(b"one");
        assert_eq!(hears(&peer), b"one");
        guest.send_to(b"hello", link.local_address().expect("bound")).expect("sent");
        assert_eq!(receive_some(&mut link), b"hello");
        link.send(b"two");
        assert_eq!((hears(&peer), hears(&guest)), (b"two".to_vec(), b"two".to_vec()));
    }

    #[test]
    fn a_peer_that_is_not_there_stops_nothing() {
        let gone = station().local_addr().expect("bound");
        let peer = station();
        let mut link = UdpLink::bind(local(), &[gone, peer.local_addr().expect("bound")]).expect("a free port");
        for _ in 0..3 {
            link.send(b"x");
            assert_eq!(hears(&peer), b"x");
        }
        peer.send_to(b"hello", link.local_address().expect("bound")).expect("sent");
        assert_eq!(receive_some(&mut link), b"hello");
    }

    #[test]
    fn a_busy_address_is_named_with_a_remedy_in_one_line() {
        let first = UdpLink::bind(local(), &[]).expect("a free port");
        let address = first.local_address().expect("bound");
        let peers = DEFAULT_PEERS.map(|peer| peer.parse().expect("an address"));
        let error = format!("{:#}", UdpLink::bind(address, &peers).expect_err("in use"));
        // Both vehicles are system 1: a ground station that hears both takes them for one.
        let expected = format!(
            "{address} is in use (another `sim-host serve`?): stop it, or fly another vehicle for another ground \
             station with --listen {} --peer 127.0.0.1:14551",
            beside(address)
        );
        assert_eq!(error, expected);
    }

    #[test]
    fn nothing_can_be_sent_to_port_0() {
        let error = format!("{:#}", UdpLink::bind(local(), &[local()]).expect_err("no port"));
        assert_eq!(error, "--peer 127.0.0.1:0 has no port from 1 to 65535: use 127.0.0.1:14550");
    }

    #[test]
    fn its_own_address_is_no_peer() {
        let free = station().local_addr().expect("bound").port();
        for (listen, peer) in [("127.0.0.1", "127.0.0.1"), ("0.0.0.0", "127.0.0.1"), ("0.0.0.0", "127.0.0.2")] {
            let at = |ip: &str| SocketAddr::new(ip.parse().expect("an address"), free);
            let error = format!("{:#}", UdpLink::bind(at(listen), &[at(peer)]).expect_err("its own"));
            let expected = format!(
                "--peer {peer}:{free} is where the vehicle itself listens: give the ground station's address, as \
                 127.0.0.1:14550"
            );
            assert_eq!(error, expected);
        }
    }

    #[test]
    fn what_is_no_address_is_answered_with_one() {
        for text in ["", " ", ":::", "a b", "[::1", "[]:1", "http://x", "udp:127.0.0.1:14550", "127.0.0.1:", ":x"] {
            let error = format!("{:#}", address(text, PEER_PORT).expect_err(text));
            assert!(error.contains(":14550") && !error.contains('\n'), "{text}: {error}");
        }
    }

    #[test]
    fn an_address_may_be_a_name_a_port_or_neither() {
        let at = |text: &str| address(text, PEER_PORT).map(|address| address.to_string());
        for (text, expected) in [
            ("127.0.0.1:14551", "127.0.0.1:14551"),
            ("127.0.0.1", "127.0.0.1:14550"),
            ("localhost", "127.0.0.1:14550"),
            ("localhost:1", "127.0.0.1:1"),
            (":14580", "0.0.0.0:14580"),
            ("[::1]:5", "[::1]:5"),
            ("::1", "[::1]:14550"),
        ] {
            assert_eq!(at(text).expect(text), expected);
        }
        for (text, expected) in [
            ("14551", "`14551` is no address: for a port use 127.0.0.1:14551"),
            ("99999", "`99999` is no port from 0 to 65535: use 127.0.0.1:14550"),
        ] {
            assert_eq!(format!("{:#}", at(text).expect_err(text)), expected);
        }
        for (text, expected) in [("localhost:many", "localhost:14550"), ("localhost:70000", "65535")] {
            let error = format!("{:#}", at(text).expect_err(text));
            assert!(error.contains(expected), "{error}");
        }
    }

    #[test]
    fn silent_guests_are_forgotten_and_there_are_never_too_many() {
        let mut link = UdpLink::bind(local(), &[]).expect("a free port");
        let now = Instant::now();
        for port in 1..1000 {
            link.welcome(SocketAddr::new(local().ip(), port), now);
        }
        assert_eq!(link.guests.len(), GUESTS_MAX);
        for guest in &mut link.guests {
            guest.heard = now.checked_sub(FORGET_AFTER).expect("long after boot");
        }
        link.send(b"x");
        assert!(link.guests.is_empty());
    }
}
