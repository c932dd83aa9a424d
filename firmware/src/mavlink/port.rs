//! The bytes between a link's driver and the ground partition: two rings a link, each with one writer and one reader,
//! and a gate between them.
//!
//! ```text
//! driver ── received ──┤gate├──► ground partition ── sent ──┤gate├──► driver
//! ```
//!
//! The inner task moves the gates: that of `received` when the ground partition is released, that of `sent` when its
//! output is published. So what a job reads, and when its bytes leave, depends on ticks alone, whenever the bytes came
//! and however long the job took; and no byte passes through the tick's interrupt.
//!
//! Positions are counted in bytes since boot, wrapping. Each is stored by one side only, after the bytes that it covers,
//! so the rings need no lock.

use core::sync::atomic::{AtomicU8, AtomicU32, Ordering};

/// Links that can be open at the same time.
pub const LINKS: usize = 4;
/// Received bytes that can wait: 20 ms of a line of 1 Mbit/s.
pub const RECEIVED_CAPACITY: usize = 2048;
/// Bytes to send that can wait.
pub const SENT_CAPACITY: usize = 2048;

/// Bytes from one writer to one reader, who sees them once the gate has been moved past them.
#[derive(Debug)]
pub struct Ring<const N: usize> {
    bytes: [AtomicU8; N],
    /// Stored by the writer.
    written: AtomicU32,
    /// Stored by who moves the gate.
    gate: AtomicU32,
    /// Stored by the reader.
    read: AtomicU32,
    /// Bytes that did not fit, since boot; stored by the writer.
    lost: AtomicU32,
}

impl<const N: usize> Ring<N> {
    const fn new() -> Self {
        // Positions wrap at 2³², so the slots of neighbouring positions are neighbours only if N divides it.
        const { assert!(N.is_power_of_two()) };
        Self {
            bytes: [const { AtomicU8::new(0) }; N],
            written: AtomicU32::new(0),
            gate: AtomicU32::new(0),
            read: AtomicU32::new(0),
            lost: AtomicU32::new(0),
        }
    }

    fn slot(&self, position: u32) -> Option<&AtomicU8> {
        self.bytes.get(position as usize % N)
    }

    /// Free space; for the writer.
    pub fn room(&self) -> usize {
        N.saturating_sub(self.held())
    }

    /// Bytes written and not read yet.
    pub fn held(&self) -> usize {
        self.written.load(Ordering::Relaxed).wrapping_sub(self.read.load(Ordering::Acquire)) as usize
    }

    /// Writes what fits; the rest is lost, and counted. Returns how many bytes were written.
    pub fn write(&self, bytes: &[u8]) -> usize {
        let (fits, rest) = bytes.split_at(bytes.len().min(self.room()));
        let mut position = self.written.load(Ordering::Relaxed);
        for byte in fits {
            if let Some(slot) = self.slot(position) {
                slot.store(*byte, Ordering::Relaxed);
            }
            position = position.wrapping_add(1);
        }
        self.written.store(position, Ordering::Release);
        if !rest.is_empty() {
            self.lose(rest.len() as u32);
        }
        fits.len()
    }

    /// Counts bytes that were lost before they reached this ring; for the writer.
    pub fn lose(&self, count: u32) {
        self.lost.store(self.lost().saturating_add(count), Ordering::Relaxed);
    }

    /// Bytes lost since boot.
    pub fn lost(&self) -> u32 {
        self.lost.load(Ordering::Relaxed)
    }

    /// Lets the reader see all that has been written.
    pub fn open_gate(&self) {
        self.gate.store(self.written.load(Ordering::Acquire), Ordering::Release);
    }

    /// Bytes that can be read now; for the reader.
    pub fn readable(&self) -> usize {
        self.gate.load(Ordering::Acquire).wrapping_sub(self.read.load(Ordering::Relaxed)) as usize
    }

    /// The byte at a distance from the next one to be read, which stays; for the reader.
    pub fn peek(&self, distance: usize) -> Option<u8> {
        if distance >= self.readable() {
            return None;
        }
        let position = self.read.load(Ordering::Relaxed).wrapping_add(distance as u32);
        Some(self.slot(position)?.load(Ordering::Relaxed))
    }

    /// Copies the next bytes, which stay, as many as there are and as fit; for the reader.
    pub fn copy<'a>(&self, into: &'a mut [u8]) -> &'a [u8] {
        let count = into.len().min(self.readable());
        let (into, _) = into.split_at_mut(count);
        let from = self.read.load(Ordering::Relaxed);
        for (distance, byte) in (0..).zip(into.iter_mut()) {
            *byte = self.slot(from.wrapping_add(distance)).map_or(0, |slot| slot.load(Ordering::Relaxed));
        }
        into
    }

    /// Where the next byte will be written.
    fn position(&self) -> u32 {
        self.written.load(Ordering::Acquire)
    }

    /// Bytes that are held before a position: none once it has been passed.
    fn distance_to(&self, position: u32) -> usize {
        let before = position.wrapping_sub(self.read.load(Ordering::Relaxed)) as usize;
        if before <= self.held() { before } else { 0 }
    }

    /// Passes over all that was written before a position; for the reader.
    fn skip_to(&self, position: u32) {
        self.skip(self.distance_to(position));
    }

    /// Passes over the next bytes; for the reader.
    pub fn skip(&self, count: usize) {
        let count = count.min(self.readable()) as u32;
        self.read.store(self.read.load(Ordering::Relaxed).wrapping_add(count), Ordering::Release);
    }
}

impl<const N: usize> Clone for Ring<N> {
    fn clone(&self) -> Self {
        let ring = Self::new();
        for (to, from) in ring.bytes.iter().zip(&self.bytes) {
            to.store(from.load(Ordering::Relaxed), Ordering::Relaxed);
        }
        for (to, from) in [
            (&ring.written, &self.written),
            (&ring.gate, &self.gate),
            (&ring.read, &self.read),
            (&ring.lost, &self.lost),
        ] {
            to.store(from.load(Ordering::Relaxed), Ordering::Relaxed);
        }
        ring
    }
}

/// What a link is for, which decides how much is sent on it by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Profile {
    /// A ground station, perhaps by radio: at most 60 % of 57,600 baud.
    #[default]
    Normal,
    /// A computer on board or a program by a fast line.
    Onboard,
}

/// What happens on a link, as its driver tells it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkEvent<'a> {
    /// There is a new peer.
    Open(Profile),
    /// The peer has gone.
    Close,
    /// So many bytes were lost before they got here.
    Lost(u32),
    /// Bytes have arrived.
    Received(&'a [u8]),
}

/// One link.
#[derive(Debug)]
pub struct Port {
    /// From the link to the ground partition.
    received: Ring<RECEIVED_CAPACITY>,
    /// From the ground partition to the link.
    sent: Ring<SENT_CAPACITY>,
    /// 0 while the link is closed; else bit 0 is 1, bit 1 the profile, and the rest counts how often it was opened.
    session: AtomicU32,
    /// The same, as seen by the ground partition.
    seen: AtomicU32,
    /// Bytes of `received` before this position are the last peer's; stored by the driver.
    received_from: AtomicU32,
    /// Bytes of `sent` before this position were for the last peer; stored by the inner task.
    sent_from: AtomicU32,
    /// Bytes of `sent` that waited for the driver when the ground partition was released, and bytes lost of `received`
    /// until then: a job must not see how far a driver has come meanwhile.
    waiting: AtomicU32,
    lost: AtomicU32,
}

impl Port {
    const fn new() -> Self {
        Self {
            received: Ring::new(),
            sent: Ring::new(),
            session: AtomicU32::new(0),
            seen: AtomicU32::new(0),
            received_from: AtomicU32::new(0),
            sent_from: AtomicU32::new(0),
            waiting: AtomicU32::new(0),
            lost: AtomicU32::new(0),
        }
    }

    /// The driver's side: what has happened.
    pub fn take_in(&self, event: LinkEvent) {
        match event {
            LinkEvent::Open(profile) => self.open(profile),
            LinkEvent::Close => self.close(),
            LinkEvent::Lost(count) => self.lose(count),
            LinkEvent::Received(bytes) => {
                self.receive(bytes);
            }
        }
    }

    /// Opens the link for a new peer. What the last one has asked for is forgotten, what it has sent and was not read yet is
    /// not carried out, and what was meant for it is not sent.
    pub fn open(&self, profile: Profile) {
        let count = (self.session.load(Ordering::Relaxed) >> 2).wrapping_add(1);
        let onboard = u32::from(profile == Profile::Onboard);
        self.received_from.store(self.received.position(), Ordering::Relaxed);
        // After the position: who sees this peer must see where its bytes begin.
        self.session.store(count << 2 | onboard << 1 | 1, Ordering::Release);
    }

    /// Closes the link: nothing is read from it, and nothing sent.
    pub fn close(&self) {
        self.session.store(self.session.load(Ordering::Relaxed) & !1, Ordering::Relaxed);
    }

    /// Whether the link is open.
    pub fn is_open(&self) -> bool {
        self.session.load(Ordering::Relaxed) & 1 == 1
    }

    /// The driver's side: bytes that have arrived. What does not fit is lost, and counted.
    pub fn receive(&self, bytes: &[u8]) -> usize {
        self.received.write(bytes)
    }

    /// The driver's side: space for bytes that arrive.
    pub fn room(&self) -> usize {
        self.received.room()
    }

    /// The driver's side: counts bytes that were lost before they got here.
    pub fn lose(&self, count: u32) {
        self.received.lose(count);
    }

    /// The driver's side: the next byte to send.
    pub fn next_byte(&self) -> Option<u8> {
        if !self.pass_stale() {
            return None;
        }
        let byte = self.sent.peek(0)?;
        self.sent.skip(1);
        Some(byte)
    }

    /// The driver's side: takes bytes to send, as many as there are and as fit. They are whole frames unless `into` is
    /// too short.
    pub fn take<'a>(&self, into: &'a mut [u8]) -> &'a [u8] {
        let bytes = self.look(into);
        self.sent.skip(bytes.len());
        bytes
    }

    /// The driver's side: the bytes to send, which stay.
    pub fn look<'a>(&self, into: &'a mut [u8]) -> &'a [u8] {
        if self.pass_stale() { self.sent.copy(into) } else { &[] }
    }

    /// Whether there are bytes to send. Anyone may ask.
    pub fn has_output(&self) -> bool {
        self.is_known() && self.sent.readable() > self.sent.distance_to(self.sent_from.load(Ordering::Relaxed))
    }

    /// The driver's side: passes over what was meant for the last peer. False while nothing is meant for this one yet.
    fn pass_stale(&self) -> bool {
        let is_known = self.is_known();
        if is_known {
            self.sent.skip_to(self.sent_from.load(Ordering::Relaxed));
        }
        is_known
    }

    /// Whether the ground partition's release has seen the present peer: until then all that waits was for the last one.
    fn is_known(&self) -> bool {
        self.seen.load(Ordering::Acquire) == self.session.load(Ordering::Relaxed)
    }

    /// The ground partition's side, once it has seen that there is a new peer: passes over what the last one has sent.
    pub(super) fn pass_stale_input(&self) {
        self.received.skip_to(self.received_from.load(Ordering::Relaxed));
    }

    /// Which opening of the link the ground partition has to do with: its count and profile; `None` while it is closed.
    pub(super) fn session(&self) -> Option<(u32, Profile)> {
        let seen = self.seen.load(Ordering::Acquire);
        let profile = if seen & 2 == 0 { Profile::Normal } else { Profile::Onboard };
        (seen & 1 == 1).then_some((seen >> 2, profile))
    }

    /// The ground partition's side: bytes that waited to be sent when it was released.
    pub(super) fn waiting(&self) -> usize {
        self.waiting.load(Ordering::Relaxed) as usize
    }

    /// The ground partition's side: received bytes lost since boot, until it was released.
    pub(super) fn lost(&self) -> u32 {
        self.lost.load(Ordering::Relaxed)
    }

    /// When the ground partition's output is published.
    fn publish(&self) {
        self.sent.open_gate();
    }

    /// At the release of the ground partition, whose last job has ended. All that it wrote without having seen that the
    /// peer is a new one was meant for the last one. Once that has been passed over, the mark moves along: positions wrap.
    fn release(&self) {
        self.received.open_gate();
        let session = self.session.load(Ordering::Acquire);
        if session != self.seen.load(Ordering::Relaxed) {
            self.sent_from.store(self.sent.position(), Ordering::Relaxed);
            self.seen.store(session, Ordering::Release);
        } else if self.sent.distance_to(self.sent_from.load(Ordering::Relaxed)) == 0 {
            self.sent_from.store(self.sent.read.load(Ordering::Relaxed), Ordering::Relaxed);
        }
        self.waiting.store(self.sent.held() as u32, Ordering::Relaxed);
        self.lost.store(self.received.lost(), Ordering::Relaxed);
    }

    /// The ground partition's side: what has arrived.
    pub fn received(&self) -> &Ring<RECEIVED_CAPACITY> {
        &self.received
    }

    /// The ground partition's side: what is to be sent.
    pub fn sent(&self) -> &Ring<SENT_CAPACITY> {
        &self.sent
    }
}

impl Clone for Port {
    fn clone(&self) -> Self {
        let copy = |from: &AtomicU32| AtomicU32::new(from.load(Ordering::Relaxed));
        Self {
            received: self.received.clone(),
            sent: self.sent.clone(),
            session: copy(&self.session),
            seen: copy(&self.seen),
            received_from: copy(&self.received_from),
            sent_from: copy(&self.sent_from),
            waiting: copy(&self.waiting),
            lost: copy(&self.lost),
        }
    }
}

/// All links.
#[derive(Clone, Debug)]
pub struct Ports([Port; LINKS]);

impl Ports {
    /// All of them closed.
    #[expect(clippy::large_stack_arrays, reason = "a constant, which a board puts into a static")]
    pub const fn new() -> Self {
        Self([const { Port::new() }; LINKS])
    }

    /// The link with this number.
    pub fn get(&self, number: usize) -> Option<&Port> {
        self.0.get(number)
    }

    /// All links, by number.
    pub fn iter(&self) -> core::slice::Iter<'_, Port> {
        self.0.iter()
    }

    /// The first link: a board's serial port, or the first ground station of the simulator.
    pub fn first(&self) -> &Port {
        let [first, ..] = &self.0;
        first
    }

    /// At the release of the ground partition: shows it what has arrived.
    pub fn release(&self) {
        self.iter().for_each(Port::release);
    }

    /// When the ground partition's output is published: lets its bytes leave.
    pub fn publish(&self) {
        self.iter().for_each(Port::publish);
    }
}

impl Default for Ports {
    fn default() -> Self {
        Self::new()
    }
}

impl<'a> IntoIterator for &'a Ports {
    type Item = &'a Port;
    type IntoIter = core::slice::Iter<'a, Port>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_pass_in_order_once_the_gate_has_moved() {
        let ring: Ring<8> = Ring::new();
        assert_eq!(ring.write(b"abc"), 3);
        assert_eq!((ring.readable(), ring.peek(0)), (0, None));
        ring.open_gate();
        ring.write(b"d");
        let mut into = [0; 8];
        assert_eq!(ring.copy(&mut into), b"abc");
        ring.skip(2);
        assert_eq!((ring.peek(0), ring.peek(1)), (Some(b'c'), None));
        ring.open_gate();
        assert_eq!(ring.copy(&mut into), b"cd");
        ring.skip(100);
        assert_eq!((ring.readable(), ring.room()), (0, 8));
    }

    #[test]
    fn what_does_not_fit_is_counted_and_nothing_is_overwritten() {
        let ring: Ring<4> = Ring::new();
        // Long enough for the positions to go round the ring many times.
        for round in 0..100_u8 {
            assert_eq!(ring.write(&[round, 1, 2, 3, 4, 5]), 4);
            ring.open_gate();
            let mut into = [0; 3];
            assert_eq!(ring.copy(&mut into), [round, 1, 2]);
            assert_eq!(ring.peek(3), Some(3));
            ring.skip(4);
        }
        assert_eq!(ring.lost(), 200);
    }

    #[test]
    fn a_new_peer_gets_nothing_that_was_for_the_last_one() {
        let port = Port::new();
        port.open(Profile::Normal);
        assert_eq!(port.session(), None, "not before the next release");
        port.release();
        port.sent.write(b"sent ");
        port.publish();
        // A job that was released before the new peer came, and has not seen it.
        port.release();
        port.sent.write(b"written ");
        port.open(Profile::Onboard);
        port.sent.write(b"answered ");
        port.publish();
        assert!(port.is_open() && !port.has_output());
        port.release();
        port.sent.write(b"new");
        port.publish();
        assert_eq!(port.take(&mut [0; 99]), b"new");
        port.close();
        assert!(!port.is_open());
    }

    #[test]
    fn what_the_last_peer_has_sent_is_passed_over() {
        let port = Port::new();
        port.open(Profile::Normal);
        port.receive(b"old");
        port.close();
        port.open(Profile::Normal);
        port.receive(b"new");
        port.release();
        port.pass_stale_input();
        assert_eq!(port.received.copy(&mut [0; 99]), b"new");
        port.received.skip(3);
        port.pass_stale_input();
        port.receive(b"er");
        port.release();
        assert_eq!(port.received.copy(&mut [0; 99]), b"er", "passed over once");
    }

    #[test]
    fn nothing_is_dropped_when_the_positions_wrap_in_a_session() {
        let port = Port::new();
        port.open(Profile::Normal);
        port.release();
        // 4 GiB were sent in this session.
        for position in [&port.sent.written, &port.sent.gate, &port.sent.read] {
            position.store(u32::MAX - 99, Ordering::Relaxed);
        }
        port.sent_from.store(u32::MAX - 99, Ordering::Relaxed);
        let (mut sent, mut taken) = (Vec::new(), Vec::new());
        for number in 0..200_u8 {
            let bytes = [number; 7];
            port.sent.write(&bytes);
            sent.extend(bytes);
            port.publish();
            // Some always wait.
            taken.extend_from_slice(port.take(&mut [0; 6]));
            port.release();
        }
        taken.extend_from_slice(port.take(&mut [0; 999]));
        assert_eq!(taken, sent);
    }

    #[test]
    fn an_old_mark_is_passed_for_good() {
        let port = Port::new();
        port.open(Profile::Normal);
        port.release();
        port.sent.write(b"abc");
        port.publish();
        assert_eq!(port.take(&mut [0; 9]), b"abc");
        port.release();
        // As if 4 GiB less 2 bytes had been sent meanwhile.
        for position in [&port.sent.written, &port.sent.gate, &port.sent.read] {
            position.store(port.sent_from.load(Ordering::Relaxed).wrapping_sub(2), Ordering::Relaxed);
        }
        port.release();
        assert_eq!(port.sent_from.load(Ordering::Relaxed), port.sent.read.load(Ordering::Relaxed));
    }

    #[test]
    fn to_ask_for_output_takes_nothing() {
        let port = Port::new();
        port.open(Profile::Normal);
        port.release();
        port.sent.write(b"old");
        port.publish();
        port.open(Profile::Normal);
        let read = port.sent.read.load(Ordering::Relaxed);
        assert!(!port.has_output());
        port.release();
        port.sent.write(b"new");
        port.publish();
        assert!(port.has_output());
        assert_eq!(port.sent.read.load(Ordering::Relaxed), read, "only who sends passes over bytes");
    }
}
