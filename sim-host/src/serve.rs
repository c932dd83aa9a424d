//! Flying in real time for a ground station: how simulated time keeps pace with the wall clock.
//!
//! Owns the wall clock; only the link and its stations read it too, for time-outs. The vehicle knows time by its ticks
//! alone: `speed` sets how many there are per second, never what a tick does. After a delay of the process, at most 0.1
//! s is caught up; the rest of the ticks is dropped. Typed lines are executed between ticks, and a pilot's hands are
//! looked at there; what they do reaches the vehicle as bytes on a link, at ticks.

use std::thread::sleep;
use std::time::{Duration, Instant};

use core::ops::RangeInclusive;

use anyhow::ensure;
use firmware::mavlink::port::{LinkEvent, Ports};
use firmware::signals::{TICK_S_EXACT, Tick};

use crate::console::terminal::Terminal;
use crate::console::{ConsoleInput, Control, Line, Session, Tone};
use crate::hands::station::Station;
use crate::hands::{Act, Hands, Sticks};
use crate::link::Links;
use crate::recording::Recorder;
use crate::stations::{LOST_AFTER, News};

/// Allowed simulated seconds per second.
pub const SPEEDS: RangeInclusive<f64> = 0.01..=1000.0;

/// A vehicle in its world.
pub trait Vehicle {
    /// One tick of vehicle and world.
    fn tick(&mut self);

    /// Its links: what has arrived is put into them before a tick, and what is to be sent taken from them after it.
    fn ports(&self) -> &Ports;

    /// What comes on a link before the next tick, beside what is put into [`ports`](Self::ports): to be read along.
    fn overhear(&mut self, link: usize, bytes: &[u8]);

    /// MAVLink frames that the simulator itself tells all peers, when there are any.
    fn truth(&mut self) -> Option<Vec<u8>>;

    /// Executes a typed line. The loop handles the returned control.
    fn enter(&mut self, line: &str) -> Option<Control>;

    /// A ground station was heard for the first time, was lost, or found no free link.
    fn notice(&mut self, news: &News);

    /// The lines to print since the last call.
    fn take_lines(&mut self) -> Vec<Line>;

    /// Whether it is armed.
    fn is_armed(&self) -> bool;

    /// The tick that comes next.
    fn next_tick(&self) -> Tick;

    /// What of the typed lines has acted on the flight since the last call, each with the tick before which it did.
    fn take_inputs(&mut self) -> Vec<(Tick, ConsoleInput)>;
}

impl Vehicle for Session {
    fn tick(&mut self) {
        Self::tick(self);
    }

    fn ports(&self) -> &Ports {
        Self::ports(self)
    }

    fn overhear(&mut self, link: usize, bytes: &[u8]) {
        Self::overhear(self, link, bytes);
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
            News::TurnedAway { address } => self.station_turned_away(address),
        }
    }

    fn take_lines(&mut self) -> Vec<Line> {
        Self::take_lines(self)
    }

    fn is_armed(&self) -> bool {
        self.flight().autopilot.inner.commander_output().armed
    }

    fn next_tick(&self) -> Tick {
        self.flight().next_tick()
    }

    fn take_inputs(&mut self) -> Vec<(Tick, ConsoleInput)> {
        Self::take_inputs(self)
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
/// How often it is looked whether the speed is reached, and the part of it below which it is not.
const LOOK_EVERY: Duration = Duration::from_secs(3);
const LAGS_BELOW: f64 = 0.95;
/// Greatest delay that is caught up, s of wall time.
const CATCH_UP_S: f64 = 0.1;

/// A vehicle and its links.
#[derive(Debug)]
pub struct Member<V> {
    /// The vehicle, in its own world.
    pub vehicle: V,
    /// Its links.
    pub links: Links,
    /// What comes to it from outside is recorded here.
    pub recorder: Option<Recorder>,
    /// Sends it what a pilot's hands do.
    pub pilot: Option<Station>,
}

impl<V: Vehicle> Member<V> {
    /// Reads its sockets, and tells it of ground stations that have come or gone.
    fn listen(&mut self) {
        self.links.receive();
        self.links.forget_silent();
        while let Some(news) = self.links.news() {
            self.vehicle.notice(&news);
        }
    }

    /// One tick, with the sticks of who flies it by hand.
    fn tick(&mut self, sticks: Option<Sticks>) {
        let Self { vehicle, links, recorder, pilot } = self;
        let typed = vehicle.take_inputs();
        if let Some(recorder) = recorder {
            for (tick, input) in &typed {
                recorder.console(*tick, input);
            }
        }
        let tick = vehicle.next_tick();
        if let Some(pilot) = pilot {
            links.hear_pilot(&pilot.frames(tick, sticks));
        }
        let mut arrived = Vec::new();
        links.deliver(vehicle.ports(), |link, event| {
            if let LinkEvent::Received(bytes) = event {
                arrived.push((link, bytes.to_vec()));
            }
            if let Some(recorder) = recorder {
                recorder.link(tick, link, event);
            }
        });
        for (link, bytes) in &arrived {
            vehicle.overhear(*link, bytes);
        }
        vehicle.tick();
        links.send(vehicle.ports());
        if let Some(frames) = vehicle.truth() {
            links.tell(&frames);
        }
    }

    /// Writes what has been recorded; returns what is to be said of it.
    fn flush(&mut self) -> anyhow::Result<Vec<String>> {
        let Some(recorder) = &mut self.recorder else { return Ok(Vec::new()) };
        recorder.flush()?;
        Ok(recorder.take_notes())
    }
}

/// Vehicles that fly by one clock, and the one that typed lines and hands are for.
#[derive(Debug)]
struct Fleet<'a, V> {
    members: &'a mut [Member<V>],
    selected: usize,
    /// Where the pilot's sticks are.
    sticks: Option<Sticks>,
}

impl<V: Vehicle> Fleet<'_, V> {
    fn tick(&mut self) {
        for (number, member) in self.members.iter_mut().enumerate() {
            member.tick(self.sticks.filter(|_| number == self.selected));
        }
    }

    /// Simulated time, s.
    fn time_s(&self) -> Option<f64> {
        self.members.first().map(|member| f64::from(member.vehicle.next_tick()) * TICK_S_EXACT)
    }

    /// Looks at a pilot's hands. What they ask is for the selected vehicle.
    fn look_at(&mut self, hands: &mut dyn Hands, terminal: &mut impl Terminal) -> Option<Control> {
        let now = Instant::now();
        while let Some(key) = terminal.next_key() {
            hands.press(key, now);
        }
        let mut control = None;
        for act in hands.poll(now) {
            match act {
                Act::Order(order) => {
                    if let Some(Member { vehicle, pilot: Some(pilot), .. }) = self.members.get_mut(self.selected) {
                        pilot.ask(order, vehicle.is_armed());
                    }
                }
                Act::Say(tone, text) => terminal.print(&Line { t_s: self.time_s(), tone, text }),
                Act::Explain(text) => terminal.print(&Line { t_s: None, tone: Tone::Plain, text }),
                Act::Quit => control = Some(Control::Quit),
            }
        }
        self.sticks = hands.sticks();
        control
    }

    /// Executes a line: `vehicle 2` selects one, where there are several; any other is the selected one's.
    fn enter(&mut self, line: &str, terminal: &mut impl Terminal) -> Option<Control> {
        let several = self.members.len() > 1;
        let words: Vec<&str> = line.split_whitespace().collect();
        if let (true, ["help" | "?", rest @ ..]) = (several, words.as_slice())
            && let [] | ["vehicle"] = rest
        {
            let text = "vehicle N: the lines that follow are for vehicle N".to_owned();
            terminal.print(&Line { t_s: None, tone: Tone::Plain, text });
            if !rest.is_empty() {
                return None;
            }
        }
        if let Some(number) = line.trim().strip_prefix("vehicle").filter(|_| several) {
            let count = self.members.len();
            let text = match number.trim().parse::<usize>() {
                Ok(number) if (1..=count).contains(&number) => {
                    self.selected = number - 1;
                    format!("lines are for vehicle {number}")
                }
                _ => format!("there are the vehicles 1 to {count}; lines are for vehicle {}", self.selected + 1),
            };
            terminal.print(&Line { t_s: None, tone: Tone::Plain, text });
            return None;
        }
        self.members.get_mut(self.selected)?.vehicle.enter(line)
    }

    /// Writes what has been recorded.
    fn flush(&mut self, terminal: &mut impl Terminal) -> anyhow::Result<()> {
        for member in self.members.iter_mut() {
            for text in member.flush()? {
                terminal.print(&Line { t_s: None, tone: Tone::Alarm, text });
            }
        }
        Ok(())
    }

    /// Prints what the vehicles have said, with their number where there are several.
    fn print(&mut self, terminal: &mut impl Terminal) {
        let several = self.members.len() > 1;
        for (number, member) in (1..).zip(self.members.iter_mut()) {
            for mut line in member.vehicle.take_lines() {
                if several {
                    line.text = format!("{number}: {}", line.text);
                }
                terminal.print(&line);
            }
        }
    }
}

/// Flies until `stop` returns true, or a line or a key ends the program. All vehicles fly in step.
///
/// # Errors
/// A speed outside of [`SPEEDS`]; a recording that cannot be written.
pub fn serve<V: Vehicle>(
    members: &mut [Member<V>],
    terminal: &mut impl Terminal,
    mut hands: Option<Box<dyn Hands>>,
    pacing: Pacing,
    stop: impl Fn() -> bool,
) -> anyhow::Result<Flown> {
    let (low, high) = (SPEEDS.start(), SPEEDS.end());
    ensure!(SPEEDS.contains(&pacing.speed), "--speed must be between {low} and {high}, not {}", pacing.speed);
    let mut fleet = Fleet { members: &mut *members, selected: 0, sticks: None };
    let (start, mut ticks) = (Instant::now(), 0);
    let mut pacer = Pacer::starting(start, pacing.speed);
    while !stop() {
        fleet.members.iter_mut().for_each(Member::listen);
        let typed = terminal.next_line().and_then(|line| fleet.enter(&line, terminal));
        match hands.as_mut().and_then(|hands| fleet.look_at(hands.as_mut(), terminal)).or(typed) {
            Some(Control::Quit) => break,
            Some(Control::Speed(speed)) => pacer = Pacer::starting(Instant::now(), speed),
            None => {}
        }
        let due = pacer.due(Instant::now()).min(BATCH);
        (0..due).for_each(|_| fleet.tick());
        pacer.done += due;
        ticks += due;
        fleet.print(terminal);
        fleet.flush(terminal)?;
        if let Some(text) = pacer.news(Instant::now()) {
            terminal.print(&Line { t_s: fleet.time_s(), tone: Tone::Plain, text });
        }
        if due < BATCH {
            sleep(NAP);
        }
    }
    for member in members {
        if let Some(recorder) = &mut member.recorder {
            recorder.finish(member.vehicle.next_tick())?;
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
    /// When it was last looked whether the speed is reached, and the ticks flown by then.
    looked: (Instant, u64),
    /// Whether it was not.
    lags: bool,
}

impl Pacer {
    /// Starts at a time, with a speed.
    fn starting(start: Instant, speed: f64) -> Self {
        Self { start, speed, done: 0, skipped: 0, looked: (start, 0), lags: false }
    }

    /// Whether the speed is reached or not, when that has changed over the last seconds.
    fn news(&mut self, now: Instant) -> Option<String> {
        let (then, done) = self.looked;
        let past = now.saturating_duration_since(then);
        if past < LOOK_EVERY {
            return None;
        }
        let reached = (self.done - done) as f64 * TICK_S_EXACT / past.as_secs_f64();
        let lags = reached < LAGS_BELOW * self.speed;
        self.looked = (now, self.done);
        if core::mem::replace(&mut self.lags, lags) == lags {
            return None;
        }
        let speed = self.speed;
        Some(if lags {
            format!("runs at {reached:.2} x real time, not at {speed}: this machine does no more now")
        } else {
            format!("runs at {speed} x real time again")
        })
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
mod tests;
