use std::io::{Read as _, Write as _};
use std::net::{Shutdown, TcpStream};

use glissade_dialect::HEARTBEAT_DATA;

use super::address::beside;
use super::frames::Component;
use super::slot::TAIL_MAX;
use super::*;

fn local() -> SocketAddr {
    "127.0.0.1:0".parse().expect("an address")
}

fn station() -> UdpSocket {
    let socket = UdpSocket::bind(local()).expect("a free port");
    socket.set_read_timeout(Some(Duration::from_secs(5))).expect("a socket");
    socket
}

fn station_at(address: SocketAddr) -> Peer {
    Peer { address, profile: Profile::Normal }
}

fn heartbeat(system: u8) -> Vec<u8> {
    Component::new(system, 190).frame(&HEARTBEAT_DATA { mavtype: 6, ..HEARTBEAT_DATA::DEFAULT })
}

fn hears(station: &UdpSocket) -> Vec<u8> {
    let mut buffer = [0; 100];
    let length = station.recv(&mut buffer).expect("something was sent");
    buffer[..length].to_vec()
}

/// Links with a vehicle's ports.
struct Bench {
    links: Links,
    ports: Ports,
}

impl Bench {
    fn new(peers: &[SocketAddr]) -> Self {
        let peers: Vec<Peer> = peers.iter().copied().map(station_at).collect();
        Self { links: Links::bind(local(), &peers).expect("a free port"), ports: Ports::new() }
    }

    fn address(&self) -> SocketAddr {
        self.links.local_address().expect("bound")
    }

    /// What comes in on a link, with what the ground partition would then read.
    fn receive(&mut self, number: usize) -> Vec<u8> {
        let port = self.ports.get(number).expect("a link");
        let start = Instant::now();
        while port.received().held() == 0 && start.elapsed() < Duration::from_secs(5) {
            self.links.receive();
            self.links.deliver(&self.ports, |_, _| {});
        }
        self.ports.release();
        let mut bytes = [0; 2048];
        let bytes = port.received().copy(&mut bytes);
        port.received().skip(bytes.len());
        bytes.to_vec()
    }

    /// What the ground partition would write to every open link.
    fn say(&mut self, bytes: &[u8]) {
        self.links.deliver(&self.ports, |_, _| {});
        self.ports.release();
        for port in self.ports.iter().filter(|port| port.is_open()) {
            port.sent().write(bytes);
        }
        self.ports.publish();
        self.links.send(&self.ports);
    }
}

#[test]
fn peers_hear_without_having_spoken_and_guests_after_a_valid_frame() {
    let (peer, guest) = (station(), station());
    let mut bench = Bench::new(&[peer.local_addr().expect("bound")]);
    bench.say(&heartbeat(1));
    assert_eq!(hears(&peer), heartbeat(1));
    // Noise makes nobody a guest.
    guest.send_to(b"x", bench.address()).expect("sent");
    guest.send_to(&heartbeat(255), bench.address()).expect("sent");
    assert_eq!(bench.receive(1), heartbeat(255));
    bench.say(&heartbeat(2));
    assert_eq!((hears(&peer), hears(&guest)), (heartbeat(2), heartbeat(2)));
}

#[test]
fn each_peer_has_its_own_link_and_half_a_frame_of_one_holds_up_no_other() {
    let (one, two) = (station(), station());
    let peers = [&one, &two].map(|station| station.local_addr().expect("bound"));
    let mut bench = Bench::new(&peers);
    one.send_to(&heartbeat(1)[..10], bench.address()).expect("sent");
    two.send_to(&heartbeat(2), bench.address()).expect("sent");
    assert_eq!(bench.receive(1), heartbeat(2));
    one.send_to(&heartbeat(1), bench.address()).expect("sent");
    assert_eq!(bench.receive(0), heartbeat(1), "without the half");
    assert_eq!(bench.ports.first().received().lost(), 10, "which is counted");
}

#[test]
fn a_large_datagram_arrives_whole_as_fast_as_the_vehicle_takes_it() {
    let one = station();
    let mut bench = Bench::new(&[one.local_addr().expect("bound")]);
    let many = heartbeat(255).repeat(400);
    one.send_to(&many, bench.address()).expect("sent");
    let mut received = Vec::new();
    while received.len() < many.len() {
        let piece = bench.receive(0);
        assert!(!piece.is_empty());
        received.extend(piece);
    }
    assert_eq!(received, many);
}

#[test]
fn a_peer_that_is_not_there_stops_nothing() {
    let gone = station().local_addr().expect("bound");
    let peer = station();
    let mut bench = Bench::new(&[gone, peer.local_addr().expect("bound")]);
    for _ in 0..3 {
        bench.say(&heartbeat(1));
        assert_eq!(hears(&peer), heartbeat(1));
    }
    peer.send_to(&heartbeat(255), bench.address()).expect("sent");
    assert_eq!(bench.receive(1), heartbeat(255));
}

#[test]
fn a_busy_address_is_named_with_a_remedy_in_one_line() {
    let first = Links::bind(local(), &[]).expect("a free port");
    let address = first.local_address().expect("bound");
    let error = format!("{:#}", Links::bind(address, &DEFAULT_PEERS).expect_err("in use"));
    // Both vehicles are system 1: a ground station that hears both takes them for one.
    let expected = format!(
        "{address} is in use (another `sim-host serve`?): stop it, or fly another vehicle for another ground \
         station with --listen {} --peer 127.0.0.1:14551",
        beside(address)
    );
    assert_eq!(error, expected);
}

#[test]
fn a_busy_tcp_address_is_named_with_a_remedy_and_an_address_given_twice_is_refused() {
    let held = TcpListener::bind(local()).expect("a free port");
    let taken = held.local_addr().expect("bound");
    let mut links = Links::bind(local(), &[]).expect("a free port");
    let error = format!("{:#}", links.serve_tcp(taken).expect_err("in use"));
    let next = beside(taken);
    assert_eq!(error, format!("--tcp {taken} is in use (another `sim-host serve`?): stop it, or use --tcp {next}"));
    let onboard = DEFAULT_PEERS[1];
    for (other, expected) in [
        (onboard, "--onboard 127.0.0.1:14540 is given twice: leave one of them out"),
        (station_at(onboard.address), "127.0.0.1:14540 is given by --onboard and by --peer: leave one of them out"),
    ] {
        let error = format!("{:#}", Links::bind(local(), &[onboard, other]).expect_err("twice"));
        assert_eq!(error, expected);
    }
}

#[test]
fn nothing_can_be_sent_to_port_0_and_there_are_no_more_peers_than_links() {
    let error = format!("{:#}", Links::bind(local(), &[station_at(local())]).expect_err("no port"));
    assert_eq!(error, "--peer 127.0.0.1:0 has no port from 1 to 65535: use 127.0.0.1:14550");
    let five: Vec<Peer> = (1..=5).map(|port| station_at(SocketAddr::from(([127, 0, 0, 1], port)))).collect();
    let error = format!("{:#}", Links::bind(local(), &five).expect_err("too many"));
    assert_eq!(error, "5 peers are given, but the vehicle has 4 links");
}

#[test]
fn its_own_address_is_no_peer() {
    let free = station().local_addr().expect("bound").port();
    for (listen, peer) in [("127.0.0.1", "127.0.0.1"), ("0.0.0.0", "127.0.0.1"), ("0.0.0.0", "127.0.0.2")] {
        let at = |ip: &str| SocketAddr::new(ip.parse().expect("an address"), free);
        let error = format!("{:#}", Links::bind(at(listen), &[station_at(at(peer))]).expect_err("its own"));
        let expected = format!(
            "--peer {peer}:{free} is where the vehicle itself listens: give the ground station's address, as \
             127.0.0.1:14550"
        );
        assert_eq!(error, expected);
    }
}

#[test]
fn a_silent_guest_gives_way_and_one_that_speaks_stays() {
    let mut bench = Bench::new(&[]);
    let start = Instant::now();
    let at = |seconds: u64| start + Duration::from_secs(seconds);
    let address = |port: u16| SocketAddr::from(([127, 0, 0, 1], port));
    let is_guest = |bench: &Bench, port| {
        bench.links.slots.iter().any(|slot| slot.peer.is_some_and(|peer| peer.address == address(port)))
    };
    for port in 1..=4 {
        bench.links.take(address(port), &heartbeat(255), start);
    }
    for port in 2..=4 {
        bench.links.take(address(port), &heartbeat(255), at(4));
    }
    bench.links.take(address(5), &heartbeat(255), at(4));
    bench.links.take(address(6), &heartbeat(255), at(4));
    assert_eq!([1, 2, 3, 4, 5, 6].map(|port| is_guest(&bench, port)), [false, true, true, true, true, false]);
    bench.links.forget_at(at(15));
    assert!((1..=6).all(|port| !is_guest(&bench, port)));
    bench.links.deliver(&bench.ports, |_, _| {});
    assert!(bench.ports.iter().all(|port| !port.is_open()));
}

#[test]
fn a_station_that_connects_over_tcp_has_a_link_until_it_leaves() {
    let mut bench = Bench::new(&[]);
    let server = bench.links.serve_tcp(local()).expect("a free port");
    let mut station = TcpStream::connect(server).expect("somebody listens");
    station.set_read_timeout(Some(Duration::from_secs(5))).expect("a socket");
    // In two pieces: a stream has no borders.
    let (first, second) = (&heartbeat(255)[..5], &heartbeat(255)[5..]);
    station.write_all(first).expect("sent");
    assert_eq!(bench.receive(0), first);
    station.write_all(second).expect("sent");
    assert_eq!(bench.receive(0), second);
    bench.say(&heartbeat(1));
    let mut heard = vec![0; heartbeat(1).len()];
    station.read_exact(&mut heard).expect("something was sent");
    assert_eq!(heard, heartbeat(1));
    drop(station);
    let start = Instant::now();
    while bench.ports.first().is_open() && start.elapsed() < Duration::from_secs(5) {
        bench.links.receive();
        bench.links.deliver(&bench.ports, |_, _| {});
    }
    assert!(!bench.ports.first().is_open());
}

#[test]
fn a_default_peer_who_is_not_there_gives_way_to_guests_and_one_that_listens_or_was_named_does_not() {
    let (listens, gone) = (station(), station().local_addr().expect("bound"));
    let peers = [listens.local_addr().expect("bound"), gone];
    let now = Instant::now();
    let address = |port: u16| SocketAddr::from(([127, 0, 0, 1], port));
    let there =
        |links: &Links| -> Vec<SocketAddr> { links.slots.iter().filter_map(|slot| Some(slot.peer?.address)).collect() };
    for (presumed, taken) in [(true, true), (false, false)] {
        let mut bench = Bench::new(&peers);
        if presumed {
            bench.links = bench.links.presuming_its_peers();
        }
        (1..=4).for_each(|port| bench.links.take(address(port), &heartbeat(255), now));
        let now_there = there(&bench.links);
        assert_eq!((now_there.contains(&peers[0]), now_there.contains(&gone)), (true, !taken));
        assert_eq!(now_there.contains(&address(3)), taken);
        let turned_away: Vec<News> =
            core::iter::from_fn(|| bench.links.news()).filter(|news| matches!(news, News::TurnedAway { .. })).collect();
        assert_eq!(turned_away.len(), if taken { 1 } else { 2 }, "{turned_away:?}");
        // Once the guests have gone, whoever begins to listen there hears without having spoken.
        bench.links.forget_at(now + Duration::from_secs(60));
        assert!(there(&bench.links).contains(&gone));
    }
}

#[test]
fn a_connection_that_sends_no_mavlink_gives_way_at_once() {
    let mut bench = Bench::new(&[]);
    let server = bench.links.serve_tcp(local()).expect("a free port");
    let browsers: Vec<TcpStream> = (0..5).map(|_| TcpStream::connect(server).expect("somebody listens")).collect();
    for mut browser in &browsers {
        browser.write_all(b"GET / HTTP/1.1\r\n\r\n").expect("sent");
    }
    let mut client = TcpStream::connect(server).expect("somebody listens");
    client.set_nonblocking(true).expect("a socket");
    let (start, mut heard) = (Instant::now(), 0);
    while heard == 0 && start.elapsed() < YIELD_AFTER {
        bench.links.receive();
        bench.say(&heartbeat(1));
        heard = client.read(&mut [0; 100]).unwrap_or(0);
    }
    assert!(heard > 0, "it hears the vehicle without having spoken, before a silent guest would give way");
}

#[test]
fn what_a_slow_connection_has_not_taken_stays_with_the_vehicle() {
    let mut bench = Bench::new(&[]);
    let server = bench.links.serve_tcp(local()).expect("a free port");
    let _slow = TcpStream::connect(server).expect("somebody listens");
    let start = Instant::now();
    while bench.links.slots[0].peer.is_none() && start.elapsed() < Duration::from_secs(5) {
        bench.links.receive();
    }
    let many = heartbeat(1).repeat(40);
    let mut rounds = 0;
    while bench.ports.first().sent().held() == 0 && rounds < 1_000_000 {
        bench.say(&many);
        rounds += 1;
    }
    assert!(bench.ports.first().sent().held() > 0, "its ring holds what was not taken");
    let held = bench.ports.first().sent().held();
    bench.links.tell(&many);
    bench.links.send(&bench.ports);
    assert_eq!(bench.ports.first().sent().held(), held);
}

#[test]
fn what_a_station_has_sent_before_it_hung_up_is_read() {
    let mut bench = Bench::new(&[]);
    let server = bench.links.serve_tcp(local()).expect("a free port");
    let mut station = TcpStream::connect(server).expect("somebody listens");
    station.write_all(&heartbeat(255)).expect("sent");
    drop(station);
    let start = Instant::now();
    let port = bench.ports.first();
    while !(port.is_open() && port.received().held() > 0) && start.elapsed() < Duration::from_secs(5) {
        bench.links.receive();
        bench.links.deliver(&bench.ports, |_, _| {});
    }
    // It stays until that has been read, however long that takes, and a little for the answers.
    let now = Instant::now();
    let after = |part: u32| now + ANSWER_WITHIN * part / 2;
    for part in [0, 4, 8] {
        bench.links.receive();
        bench.links.deliver_at(after(part), &bench.ports, |_, _| {});
    }
    bench.ports.release();
    assert!(port.is_open());
    assert_eq!(port.received().copy(&mut [0; 99]), heartbeat(255));
    port.received().skip(99);
    for (part, stays) in [(10, true), (11, true), (12, false)] {
        bench.links.receive();
        bench.links.deliver_at(after(part), &bench.ports, |_, _| {});
        assert_eq!(port.is_open(), stays, "{part}");
    }
}

#[test]
fn a_station_that_has_said_all_it_wants_hears_the_answer() {
    let mut bench = Bench::new(&[]);
    let server = bench.links.serve_tcp(local()).expect("a free port");
    let mut station = TcpStream::connect(server).expect("somebody listens");
    station.set_read_timeout(Some(Duration::from_secs(5))).expect("a socket");
    station.write_all(&heartbeat(255)).expect("sent");
    station.shutdown(Shutdown::Write).expect("connected");
    assert_eq!(bench.receive(0), heartbeat(255));
    let (start, now) = (Instant::now(), Instant::now());
    while bench.links.slots[0].read.is_none() && start.elapsed() < Duration::from_secs(5) {
        bench.links.receive();
        bench.links.deliver_at(now, &bench.ports, |_, _| {});
    }
    let port = bench.ports.first();
    port.sent().write(&heartbeat(1));
    bench.ports.publish();
    bench.links.send(&bench.ports);
    let mut heard = vec![0; heartbeat(1).len()];
    station.read_exact(&mut heard).expect("something was sent");
    assert_eq!(heard, heartbeat(1));
}

#[test]
fn a_connection_whose_frames_come_in_pieces_is_heard() {
    let mut bench = Bench::new(&[]);
    let server = bench.links.serve_tcp(local()).expect("a free port");
    let mut station = TcpStream::connect(server).expect("somebody listens");
    station.set_nodelay(true).expect("a socket");
    // It begins within a frame, as a radio's line does.
    let stream = [&heartbeat(255)[7..], &heartbeat(255).repeat(3)].concat();
    let mut heard = Vec::new();
    for piece in stream.chunks(7) {
        station.write_all(piece).expect("sent");
        assert_eq!(bench.receive(0), piece);
        heard.extend(core::iter::from_fn(|| bench.links.news()));
        assert!(bench.links.slots[0].tail.len() <= TAIL_MAX);
    }
    assert!(matches!(heard[..], [News::Heard { system: 255, .. }]), "{heard:?}");
    let peer = bench.links.slots[0].peer.expect("it is there");
    assert!(!peer.junk && bench.links.slots[0].tail.is_empty());
}

#[test]
fn a_stream_without_a_frame_takes_no_more_memory_for_ever() {
    let mut slot = Slot { inbox: vec![0xfd; 5000], ..Slot::default() };
    assert_eq!((slot.find_frame(0), slot.tail.len()), (None, TAIL_MAX));
}

#[test]
fn a_pilot_keeps_the_link_that_is_free_and_is_sent_nothing() {
    let station = station();
    let mut bench = Bench::new(&[station.local_addr().expect("bound")]);
    assert_eq!(bench.links.seat_pilot().expect("a free link"), 1);
    bench.links.hear_pilot(&heartbeat(254));
    assert_eq!(bench.receive(1), heartbeat(254));
    bench.say(b"telemetry");
    assert_eq!(hears(&station), b"telemetry");
    assert!(!bench.ports.get(1).expect("a link").has_output(), "it is taken, and dropped");
    assert_eq!(bench.links.news(), None, "the pilot is no ground station that connects");
    // However silent: neither a guest nor time takes the link.
    let long_after = Instant::now() + Duration::from_secs(3_600);
    bench.links.forget_at(long_after);
    assert_eq!(bench.links.place_for_guest(long_after), Some(2));
    assert!(bench.links.slots[1].peer.is_some());
}

#[test]
fn a_pilot_without_a_free_link_is_refused_in_a_line() {
    let others: Vec<UdpSocket> = (0..LINKS).map(|_| station()).collect();
    let addresses: Vec<SocketAddr> = others.iter().map(|other| other.local_addr().expect("bound")).collect();
    let error = Bench::new(&addresses).links.seat_pilot().expect_err("no link").to_string();
    assert_eq!(error, "a pilot needs one of the vehicle's 4 links: name at most 3 peers");
}
