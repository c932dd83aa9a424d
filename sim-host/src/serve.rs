//! Flying in real time for a ground station: how simulated time keeps pace with the wall clock.
//!
//! Owns the wall clock; only the link and its stations read it too, for time-outs. The vehicle knows time by its ticks
//! alone: `speed` sets how many there are per second, never what a tick does. After a delay of the process, at most 0.1
//! s is caught up; the rest of the ticks is dropped. Typed lines are executed between ticks.

use std::thread::sleep;
use std::time::{Duration, Instant};

use core::ops::RangeInclusive;

use anyhow::ensure;
use firmware::mavlink::port::Ports;
use firmware::signals::TICK_S_EXACT;

use crate::console::terminal::Terminal;
use crate::console::{Control, Line, Session};
use crate::link::UdpLinks;
use crate::stations::{LOST_AFTER, News};

/// Allowed simulated seconds per second.
pub const SPEEDS: RangeInclusive<f64> = 0.01..=1000.0;

/// A vehicle in its world.
pub trait Vehicle {
    /// One tick of vehicle and world.
    fn tick(&mut self);

    /// Its links: what has arrived is put into them before a tick, and what is to be sent taken from them after it.
    fn ports(&self) -> &Ports;

    /// MAVLink frames that the simulator itself tells all peers, when there are any.
    fn truth(&mut self) -> Option<Vec<u8>>;

    /// Executes a typed line. The loop handles the returned control.
    fn enter(&mut self, line: &str) -> Option<Control>;

    /// A ground station was heard for the first time, or was lost.
    fn notice(&mut self, news: &News);

    /// The lines to print since the last call.
    fn take_lines(&mut self) -> Vec<Line>;
}

impl Vehicle for Session {
    fn tick(&mut self) {
        Self::tick(self);
    }

    fn ports(&self) -> &Ports {
        Self::ports(self)
    }

    fn truth(&mut self) -> Option<Vec<u8>> {
        Self::truth(self)
    }

    fn enter(&mut self, line: &str) -> Option<Control> {
        Self::enter(self, line)
    }

    fn notice(&mut self, news: &News) {
        match *news {
            News::Heard { address, system } => self.station_heard(address, system),
            News::Lost { address, system } => self.station_lost(address, system, LOST_AFTER.as_secs()),
        }
    }

    fn take_lines(&mut self) -> Vec<Line> {
        Self::take_lines(self)
    }
}

/// How simulated time relates to the wall clock's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pacing {
    /// Simulated seconds per second.
    pub speed: f64,
}

/// Duration of a flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flown {
    /// Simulated, s.
    pub simulated_s: f64,
    /// By the wall clock, s.
    pub wall_s: f64,
}

/// Ticks between two reads of the socket when behind the wall clock.
const BATCH: u64 = 100;
/// Pause between two reads of the clock when on time.
const NAP: Duration = Duration::from_millis(1);
/// Greatest delay that is caught up, s of wall time.
const CATCH_UP_S: f64 = 0.1;

/// Flies until `stop` returns true, or a line ends the program.
///
/// # Errors
/// A speed outside of [`SPEEDS`].
pub fn serve(
    vehicle: &mut impl Vehicle,
    links: &mut UdpLinks,
    terminal: &mut impl Terminal,
    pacing: Pacing,
    stop: impl Fn() -> bool,
) -> anyhow::Result<Flown> {
    let (low, high) = (SPEEDS.start(), SPEEDS.end());
    ensure!(SPEEDS.contains(&pacing.speed), "--speed must be between {low} and {high}, not {}", pacing.speed);
    let (start, mut ticks) = (Instant::now(), 0);
    let mut pacer = Pacer::starting(start, pacing.speed);
    while !stop() {
        links.receive();
        links.forget_silent();
        while let Some(news) = links.news() {
            vehicle.notice(&news);
        }
        match terminal.next_line().and_then(|line| vehicle.enter(&line)) {
            Some(Control::Quit) => break,
            Some(Control::Speed(speed)) => pacer = Pacer::starting(Instant::now(), speed),
            None => {}
        }
        let due = pacer.due(Instant::now()).min(BATCH);
        for _ in 0..due {
            links.deliver(vehicle.ports());
            vehicle.tick();
            links.send(vehicle.ports());
            if let Some(frames) = vehicle.truth() {
                links.tell(&frames);
            }
        }
        pacer.done += due;
        ticks += due;
        vehicle.take_lines().iter().for_each(|line| terminal.print(line));
        if due < BATCH {
            sleep(NAP);
        }
    }
    Ok(Flown { simulated_s: ticks as f64 * TICK_S_EXACT, wall_s: start.elapsed().as_secs_f64() })
}

/// How many ticks simulated time is behind.
#[derive(Debug)]
struct Pacer {
    start: Instant,
    speed: f64,
    /// Ticks flown.
    done: u64,
    /// Ticks dropped.
    skipped: u64,
}

impl Pacer {
    /// Starts at a time, with a speed.
    fn starting(start: Instant, speed: f64) -> Self {
        Self { start, speed, done: 0, skipped: 0 }
    }

    /// Ticks to fly until `now`. Ticks beyond [`CATCH_UP_S`] are dropped.
    fn due(&mut self, now: Instant) -> u64 {
        let ticks_a_second = self.speed / TICK_S_EXACT;
        let target = (now.saturating_duration_since(self.start).as_secs_f64() * ticks_a_second) as u64;
        let behind = target.saturating_sub(self.done + self.skipped);
        let allowed = ((CATCH_UP_S * ticks_a_second) as u64).max(1);
        self.skipped += behind.saturating_sub(allowed);
        behind.min(allowed)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::VecDeque;
    use std::sync::atomic::{AtomicBool, Ordering};

    use super::*;
    use crate::console::Tone;

    /// Counts ticks; stops itself in the end.
    struct Counter<'a> {
        ticks: u64,
        end: u64,
        ports: Ports,
        said: Vec<Line>,
        stop: &'a AtomicBool,
    }

    impl Vehicle for Counter<'_> {
        fn tick(&mut self) {
            self.ticks += 1;
            if self.ticks == self.end {
                self.stop.store(true, Ordering::Relaxed);
            }
        }

        fn ports(&self) -> &Ports {
            &self.ports
        }

        fn truth(&mut self) -> Option<Vec<u8>> {
            None
        }

        fn enter(&mut self, line: &str) -> Option<Control> {
            match line {
                "end" => self.end = self.ticks + 1,
                "quit" => return Some(Control::Quit),
                "faster" => return Some(Control::Speed(100.0)),
                _ => self.said.push(Line { t_s: None, tone: Tone::Refused, text: line.to_owned() }),
            }
            None
        }

        fn notice(&mut self, _: &News) {}

        fn take_lines(&mut self) -> Vec<Line> {
            core::mem::take(&mut self.said)
        }
    }

    /// Lines that have been typed, and what was printed.
    #[derive(Default)]
    struct Script {
        typed: VecDeque<&'static str>,
        printed: Vec<Line>,
    }

    impl Script {
        fn typing(lines: &[&'static str]) -> Self {
            Self { typed: lines.iter().copied().collect(), printed: Vec::new() }
        }
    }

    impl Terminal for Script {
        fn next_line(&mut self) -> Option<String> {
            self.typed.pop_front().map(str::to_owned)
        }

        fn print(&mut self, line: &Line) {
            self.printed.push(line.clone());
        }
    }

    fn counter(end: u64, stop: &AtomicBool) -> Counter<'_> {
        Counter { ticks: 0, end, ports: Ports::new(), said: Vec::new(), stop }
    }

    fn unheard() -> UdpLinks {
        UdpLinks::bind("127.0.0.1:0".parse().expect("an address"), &[]).expect("a free port")
    }

    #[test]
    fn a_tenth_of_a_second_takes_no_less() {
        let stop = AtomicBool::new(false);
        let mut vehicle = counter(100, &stop);
        let start = Instant::now();
        serve(&mut vehicle, &mut unheard(), &mut Script::default(), Pacing { speed: 1.0 }, || {
            stop.load(Ordering::Relaxed)
        })
        .expect("flies");
        let took = start.elapsed();
        assert!(took >= Duration::from_millis(100), "{took:?}");
        assert!(vehicle.ticks < 100 + BATCH);
    }

    #[test]
    fn lines_are_carried_out_and_what_is_said_is_printed() {
        let stop = AtomicBool::new(false);
        let mut vehicle = counter(u64::MAX, &stop);
        let mut script = Script::typing(&["", "nonsense", "faster", "end"]);
        let flown =
            serve(&mut vehicle, &mut unheard(), &mut script, Pacing { speed: 10.0 }, || stop.load(Ordering::Relaxed))
                .expect("it ends");
        assert_eq!(flown.simulated_s, vehicle.ticks as f64 * TICK_S_EXACT);
        let printed: Vec<&str> = script.printed.iter().map(|line| line.text.as_str()).collect();
        assert_eq!(printed, ["", "nonsense"]);
    }

    #[test]
    fn a_line_can_end_it() {
        let stop = AtomicBool::new(false);
        let mut vehicle = counter(u64::MAX, &stop);
        let mut script = Script::typing(&["nonsense", "quit", "more"]);
        serve(&mut vehicle, &mut unheard(), &mut script, Pacing { speed: 1.0 }, || stop.load(Ordering::Relaxed))
            .expect("it ends");
        assert_eq!((script.typed.len(), script.printed.len()), (1, 1));
    }

    #[test]
    fn a_delay_is_caught_up_only_so_far() {
        let start = Instant::now();
        let mut pacer = Pacer::starting(start, 2.0);
        let at = |ms: u64| start + Duration::from_millis(ms);
        assert_eq!(pacer.due(at(50)), 100);
        pacer.done += 100;
        assert_eq!(pacer.due(at(50)), 0);
        assert_eq!(pacer.due(at(10_000)), 200);
        pacer.done += 200;
        assert_eq!(pacer.due(at(10_000)), 0, "the rest is dropped");
        assert_eq!(pacer.due(at(10_001)), 2);
    }

    #[test]
    fn nonsense_speeds_are_refused() {
        let stop = AtomicBool::new(true);
        for speed in [0.0, -1.0, 1e4, f64::NAN, f64::INFINITY] {
            let mut script = Script::default();
            let flown = serve(&mut counter(1, &stop), &mut unheard(), &mut script, Pacing { speed }, || {
                stop.load(Ordering::Relaxed)
            });
            let refusal = flown.expect_err("refused").to_string();
            assert!(refusal.contains("between 0.01 and 1000"), "{refusal}");
        }
    }
}
