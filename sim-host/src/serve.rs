//! Flying in real time for a ground station: how simulated time keeps pace with the wall clock.
//!
//! Owns the wall clock, which nobody else reads. The vehicle is told of time only by being ticked; `speed` says
//! how often that is, never what a tick does. A process that was held up catches up, but only so far: what it
//! missed beyond that is left out rather than flown in a rush. Lines of text are executed between ticks.

use std::io::Write as _;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::thread::sleep;
use std::time::{Duration, Instant};

use anyhow::ensure;
use firmware::mavlink::{RX_CAPACITY, TxBytes};
use firmware::schedule::GROUND;
use firmware::signals::TICK_S_EXACT;

use crate::link::UdpLink;

/// A vehicle in its world.
pub trait Vehicle {
    /// One tick of everything. `received` has come from the ground station since the last tick; what is returned
    /// goes to it as one datagram, so it consists of whole messages.
    fn tick(&mut self, received: &[u8]) -> Option<TxBytes>;

    /// Does what a line of text asks. What is returned is for whoever has written it.
    ///
    /// # Errors
    /// In one line, why it is not done.
    fn execute(&mut self, line: &str) -> anyhow::Result<String>;
}

/// Lines of text for the vehicle, and where answers and complaints go.
#[derive(Debug)]
pub struct Console {
    lines: Receiver<String>,
}

impl Console {
    /// Of lines that come from somewhere. One whose sender has gone stays silent.
    pub fn new(lines: Receiver<String>) -> Self {
        Self { lines }
    }

    /// Of standard input, read by a thread of its own; its end is no reason to stop.
    pub fn on_standard_input() -> Self {
        let (sender, lines) = channel();
        std::thread::spawn(move || {
            let lines = std::io::stdin().lines().map_while(Result::ok);
            lines.map(|line| sender.send(line)).take_while(Result::is_ok).for_each(drop);
        });
        Self::new(lines)
    }

    /// Executes the lines that have come.
    fn pass_on(&self, vehicle: &mut impl Vehicle) {
        for line in self.lines.try_iter() {
            match vehicle.execute(&line) {
                // Nobody may be there to read the answer.
                Ok(answer) if !answer.is_empty() => drop(writeln!(std::io::stdout(), "{answer}")),
                Ok(_) => {}
                Err(error) => eprintln!("sim-host: {}", format!("{error:#}").replace('\n', " ")),
            }
        }
    }
}

/// How simulated time relates to the wall clock's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pacing {
    /// Simulated seconds a second.
    pub speed: f64,
}

/// What the firmware can take between two jobs, spread over the ticks between them.
const BYTES_PER_TICK: usize = RX_CAPACITY / GROUND.period as usize;
/// More than this waits in the socket.
const INBOX_MAX: usize = 16 * RX_CAPACITY;
/// Ticks between two looks at the socket when behind.
const BATCH: u64 = 100;
/// Between two looks at the clock when on time.
const NAP: Duration = Duration::from_millis(1);
/// Wall time that is caught up at most, s.
const CATCH_UP_S: f64 = 0.1;

/// Flies until `stop` is set.
///
/// # Errors
/// A speed that is not a positive number.
pub fn serve(
    vehicle: &mut impl Vehicle,
    link: &mut UdpLink,
    console: &Console,
    pacing: Pacing,
    stop: &AtomicBool,
) -> anyhow::Result<()> {
    ensure!(pacing.speed.is_finite() && pacing.speed > 0.0, "speed must be a positive number, not {}", pacing.speed);
    let start = Instant::now();
    let mut pacer = Pacer { speed: pacing.speed, done: 0, skipped: 0 };
    let mut inbox = Vec::new();
    while !stop.load(Ordering::Relaxed) {
        if inbox.len() < INBOX_MAX {
            link.receive(&mut inbox);
        }
        console.pass_on(vehicle);
        let due = pacer.due(start.elapsed()).min(BATCH);
        for _ in 0..due {
            tick(vehicle, link, &mut inbox);
        }
        pacer.done += due;
        if due < BATCH {
            sleep(NAP);
        }
    }
    Ok(())
}

fn tick(vehicle: &mut impl Vehicle, link: &mut UdpLink, inbox: &mut Vec<u8>) {
    let count = inbox.len().min(BYTES_PER_TICK);
    let sent = vehicle.tick(&inbox[..count]);
    inbox.drain(..count);
    if let Some(bytes) = sent.filter(|bytes| !bytes.is_empty()) {
        link.send(&bytes);
    }
}

/// How many ticks simulated time is behind.
#[derive(Debug)]
struct Pacer {
    speed: f64,
    /// Ticks flown.
    done: u64,
    /// Ticks left out.
    skipped: u64,
}

impl Pacer {
    /// Ticks to fly by now. What is too far behind is left out for good.
    fn due(&mut self, elapsed: Duration) -> u64 {
        let ticks_a_second = self.speed / TICK_S_EXACT;
        let target = (elapsed.as_secs_f64() * ticks_a_second) as u64;
        let behind = target.saturating_sub(self.done + self.skipped);
        let allowed = ((CATCH_UP_S * ticks_a_second) as u64).max(1);
        self.skipped += behind.saturating_sub(allowed);
        behind.min(allowed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sends a datagram every ten ticks, and keeps what it receives; stops itself in the end.
    struct Counter<'a> {
        ticks: u64,
        end: u64,
        received: Vec<u8>,
        largest: usize,
        stop: &'a AtomicBool,
    }

    impl Vehicle for Counter<'_> {
        fn tick(&mut self, received: &[u8]) -> Option<TxBytes> {
            self.ticks += 1;
            self.received.extend_from_slice(received);
            self.largest = self.largest.max(received.len());
            if self.ticks == self.end {
                self.stop.store(true, Ordering::Relaxed);
            }
            self.ticks.is_multiple_of(10).then(|| TxBytes::from_slice(b"whole").expect("fits"))
        }

        fn execute(&mut self, line: &str) -> anyhow::Result<String> {
            ensure!(line == "end", "no");
            self.end = self.ticks + 1;
            Ok(String::new())
        }
    }

    fn fly(speed: f64, end: u64, sent: &[u8]) -> (Duration, u64, Vec<u8>, usize) {
        let stop = AtomicBool::new(false);
        let mut vehicle = Counter { ticks: 0, end, received: Vec::new(), largest: 0, stop: &stop };
        let local = "127.0.0.1:0".parse().expect("an address");
        let mut link = UdpLink::bind(local, &[]).expect("a free port");
        let station = std::net::UdpSocket::bind(local).expect("a free port");
        station.send_to(sent, link.local_address().expect("bound")).expect("sent");
        let start = Instant::now();
        let (_, lines) = channel();
        serve(&mut vehicle, &mut link, &Console::new(lines), Pacing { speed }, &stop).expect("flies");
        (start.elapsed(), vehicle.ticks, vehicle.received, vehicle.largest)
    }

    #[test]
    fn a_tenth_of_a_second_takes_no_less() {
        let (took, ticks, _, _) = fly(1.0, 100, b"");
        assert!(took >= Duration::from_millis(100), "{took:?}");
        assert!(ticks < 100 + BATCH);
    }

    #[test]
    fn everything_received_arrives_once_and_no_faster_than_the_firmware_takes_it() {
        let sent: Vec<u8> = (0..1500_u32).map(|i| i as u8).collect();
        let (_, _, received, largest) = fly(10.0, 500, &sent);
        assert_eq!(received, sent);
        assert!(largest * GROUND.period as usize <= RX_CAPACITY);
    }

    #[test]
    fn lines_are_executed_and_bad_ones_do_no_harm() {
        let stop = AtomicBool::new(false);
        let mut vehicle = Counter { ticks: 0, end: u64::MAX, received: Vec::new(), largest: 0, stop: &stop };
        let mut link = UdpLink::bind("127.0.0.1:0".parse().expect("an address"), &[]).expect("a free port");
        let (sender, lines) = channel();
        for line in ["", "nonsense", "end"] {
            sender.send(line.to_owned()).expect("there is a receiver");
        }
        drop(sender);
        serve(&mut vehicle, &mut link, &Console::new(lines), Pacing { speed: 10.0 }, &stop).expect("it ends");
        assert!(vehicle.ticks > 0 && vehicle.ticks < 1000, "{}", vehicle.ticks);
    }

    #[test]
    fn a_delay_is_caught_up_only_so_far() {
        let mut pacer = Pacer { speed: 2.0, done: 0, skipped: 0 };
        assert_eq!(pacer.due(Duration::from_millis(50)), 100);
        pacer.done += 100;
        assert_eq!(pacer.due(Duration::from_millis(50)), 0);
        assert_eq!(pacer.due(Duration::from_secs(10)), 200);
        pacer.done += 200;
        assert_eq!(pacer.due(Duration::from_secs(10)), 0, "the rest is left out");
        assert_eq!(pacer.due(Duration::from_millis(10_001)), 2);
    }

    #[test]
    fn nonsense_speeds_are_refused() {
        let stop = AtomicBool::new(true);
        let mut vehicle = Counter { ticks: 0, end: 1, received: Vec::new(), largest: 0, stop: &stop };
        let mut link = UdpLink::bind("127.0.0.1:0".parse().expect("an address"), &[]).expect("a free port");
        for speed in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let (_, lines) = channel();
            assert!(serve(&mut vehicle, &mut link, &Console::new(lines), Pacing { speed }, &stop).is_err(), "{speed}");
        }
    }
}
