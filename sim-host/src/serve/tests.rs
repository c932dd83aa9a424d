use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};

use super::*;
use crate::console::keyboard::Key;
use crate::hands::{Order, Selected};
use crate::link::frames::whole;

/// Counts ticks; stops itself in the end.
struct Counter<'a> {
    ticks: u64,
    end: u64,
    ports: Ports,
    /// The messages that it was sent, by their numbers, each with the tick.
    heard: Vec<(u64, u32)>,
    said: Vec<Line>,
    stop: &'a AtomicBool,
}

impl Counter<'_> {
    fn hear(&mut self) {
        self.ports.release();
        for port in &self.ports {
            let mut bytes = [0; 2048];
            let bytes = port.received().copy(&mut bytes);
            let number = |at: usize| u32::from_le_bytes([bytes[at + 7], bytes[at + 8], bytes[at + 9], 0]);
            self.heard.extend(whole(bytes).map(|frame| (self.ticks, number(frame.range.start))));
            port.received().skip(bytes.len());
        }
    }

    /// The ticks in which it was sent a message.
    fn ticks_of(&self, message: u32) -> Vec<u64> {
        self.heard.iter().filter(|(_, number)| *number == message).map(|(tick, _)| *tick).collect()
    }
}

impl Vehicle for Counter<'_> {
    fn tick(&mut self) {
        self.hear();
        self.ticks += 1;
        if self.ticks == self.end {
            self.stop.store(true, Ordering::Relaxed);
        }
    }

    fn ports(&self) -> &Ports {
        &self.ports
    }

    fn overhear(&mut self, _: usize, _: &[u8]) {}

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

    fn is_armed(&self) -> bool {
        false
    }

    fn next_tick(&self) -> Tick {
        self.ticks as Tick
    }

    fn take_inputs(&mut self) -> Vec<(Tick, ConsoleInput)> {
        Vec::new()
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
    Counter { ticks: 0, end, ports: Ports::new(), heard: Vec::new(), said: Vec::new(), stop }
}

/// A vehicle that nobody hears.
fn alone<V>(vehicle: V) -> [Member<V>; 1] {
    let links = Links::bind("127.0.0.1:0".parse().expect("an address"), &[]).expect("a free port");
    [Member { vehicle, links, recorder: None, pilot: None }]
}

#[test]
fn a_tenth_of_a_second_takes_no_less() {
    let stop = AtomicBool::new(false);
    let mut fleet = alone(counter(100, &stop));
    let start = Instant::now();
    serve(&mut fleet, &mut Script::default(), None, Pacing { speed: 1.0 }, || stop.load(Ordering::Relaxed))
        .expect("flies");
    let took = start.elapsed();
    assert!(took >= Duration::from_millis(100), "{took:?}");
    assert!(fleet[0].vehicle.ticks < 100 + BATCH);
}

#[test]
fn lines_are_carried_out_and_what_is_said_is_printed() {
    let stop = AtomicBool::new(false);
    let mut fleet = alone(counter(u64::MAX, &stop));
    let mut script = Script::typing(&["", "nonsense", "faster", "end"]);
    let flown =
        serve(&mut fleet, &mut script, None, Pacing { speed: 10.0 }, || stop.load(Ordering::Relaxed)).expect("it ends");
    assert_eq!(flown.simulated_s, fleet[0].vehicle.ticks as f64 * TICK_S_EXACT);
    let printed: Vec<&str> = script.printed.iter().map(|line| line.text.as_str()).collect();
    assert_eq!(printed, ["", "nonsense"]);
}

#[test]
fn a_line_can_end_it() {
    let stop = AtomicBool::new(false);
    let mut fleet = alone(counter(u64::MAX, &stop));
    let mut script = Script::typing(&["nonsense", "quit", "more"]);
    serve(&mut fleet, &mut script, None, Pacing { speed: 1.0 }, || stop.load(Ordering::Relaxed)).expect("it ends");
    assert_eq!((script.typed.len(), script.printed.len()), (1, 1));
}

#[test]
fn several_vehicles_fly_in_step_and_lines_are_for_the_one_selected() {
    let stop = AtomicBool::new(false);
    let [one] = alone(counter(u64::MAX, &stop));
    let [two] = alone(counter(u64::MAX, &stop));
    let mut fleet = vec![one, two];
    let lines = ["first", "vehicle 2", "second", "vehicle 3", "vehicle", "help vehicle", "help", "quit"];
    let mut script = Script::typing(&lines);
    serve(&mut fleet, &mut script, None, Pacing { speed: 10.0 }, || stop.load(Ordering::Relaxed)).expect("it ends");
    let printed: Vec<&str> = script.printed.iter().map(|line| line.text.as_str()).collect();
    let wrong = "there are the vehicles 1 to 2; lines are for vehicle 2";
    let help = "vehicle N: the lines that follow are for vehicle N";
    assert_eq!(printed, ["1: first", "lines are for vehicle 2", "2: second", wrong, wrong, help, help, "2: help"]);
    assert_eq!(fleet[0].vehicle.ticks, fleet[1].vehicle.ticks);
}

#[test]
fn a_speed_that_is_not_reached_is_told_once_and_so_is_that_it_is_again() {
    let start = Instant::now();
    let mut pacer = Pacer::starting(start, 10.0);
    let mut at = |seconds: u64, done: u64| {
        pacer.done += done;
        pacer.news(start + Duration::from_secs(seconds))
    };
    assert_eq!(at(1, 10_000), None, "too early to say");
    assert_eq!(at(3, 20_000), None, "reached");
    let text = "runs at 5.00 x real time, not at 10: this machine does no more now";
    assert_eq!(at(6, 15_000).as_deref(), Some(text));
    assert_eq!(at(9, 15_000), None, "told");
    assert_eq!(at(12, 30_000).as_deref(), Some("runs at 10 x real time again"));
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
        let flown =
            serve(&mut alone(counter(1, &stop)), &mut script, None, Pacing { speed }, || stop.load(Ordering::Relaxed));
        let refusal = flown.expect_err("refused").to_string();
        assert!(refusal.contains("between 0.01 and 1000"), "{refusal}");
    }
}

const HEARTBEAT: u32 = 0;
const MANUAL_CONTROL: u32 = 69;
const COMMAND_LONG: u32 = 76;

/// Hands that hold still, and at one look do something; they end the program some looks later.
struct Thumbs {
    looks: u64,
    does: Vec<(u64, Act)>,
    keys: Vec<Key>,
}

impl Thumbs {
    fn doing(does: Vec<(u64, Act)>) -> Box<dyn Hands> {
        Box::new(Self { looks: 0, does, keys: Vec::new() })
    }
}

impl Hands for Thumbs {
    fn press(&mut self, key: Key, _: Instant) {
        self.keys.push(key);
    }

    fn poll(&mut self, _: Instant) -> Vec<Act> {
        self.looks += 1;
        let now = self.does.iter().filter(|(look, _)| *look == self.looks);
        let keys = self.keys.drain(..).map(|key| Act::Explain(format!("{key:?}")));
        now.map(|(_, act)| act.clone()).chain(keys).collect()
    }

    fn sticks(&self) -> Option<Sticks> {
        Some(Sticks::default())
    }
}

/// A terminal that selects vehicle 2 at one look, and on which a key is pressed at the first.
#[derive(Default)]
struct Desk {
    looks: u64,
    selects_at: u64,
    printed: Vec<Line>,
}

impl Terminal for Desk {
    fn next_line(&mut self) -> Option<String> {
        self.looks += 1;
        (self.looks == self.selects_at).then(|| "vehicle 2".to_owned())
    }

    fn next_key(&mut self) -> Option<Key> {
        (self.looks == 1 && self.printed.is_empty()).then(|| {
            self.looks += 1;
            Key::Up
        })
    }

    fn print(&mut self, line: &Line) {
        self.printed.push(line.clone());
    }
}

/// A vehicle with a pilot.
fn piloted(vehicle: Counter) -> Member<Counter> {
    let [mut member] = alone(vehicle);
    member.links.seat_pilot().expect("a free link");
    Member { pilot: Some(Station::new(1)), ..member }
}

#[test]
fn sticks_and_orders_are_for_the_vehicle_that_is_selected_and_each_has_its_heartbeats() {
    let stop = AtomicBool::new(false);
    let mut fleet = vec![piloted(counter(u64::MAX, &stop)), piloted(counter(u64::MAX, &stop))];
    let mut desk = Desk { selects_at: 30, ..Desk::default() };
    let hold = Act::Order(Order::Select(Selected::Hold));
    let hands = Thumbs::doing(vec![(50, hold), (60, Act::Quit)]);
    serve(&mut fleet, &mut desk, Some(hands), Pacing { speed: 1000.0 }, || false).expect("it ends");
    let [one, two] = [0, 1].map(|number: usize| &fleet[number].vehicle);
    let [first, second] = [one, two].map(|vehicle| vehicle.ticks_of(MANUAL_CONTROL));
    assert!(first.last() < second.first(), "the old one's sticks stop: {first:?}, {second:?}");
    let all = [first, second].concat();
    assert!(all.len() as u64 == one.ticks.div_ceil(20) && all.iter().all(|tick| tick % 20 == 0), "50 Hz: {all:?}");
    assert_eq!([one.ticks_of(COMMAND_LONG).len(), two.ticks_of(COMMAND_LONG).len()], [0, 1]);
    for vehicle in [one, two] {
        assert!(vehicle.ticks_of(HEARTBEAT).into_iter().eq((0..vehicle.ticks.div_ceil(1000)).map(|s| s * 1000)));
    }
}

#[test]
fn what_hands_tell_is_printed_and_keys_are_theirs() {
    let stop = AtomicBool::new(false);
    let mut fleet = vec![piloted(counter(u64::MAX, &stop))];
    let mut desk = Desk::default();
    let hands = Thumbs::doing(vec![(2, Act::Say(Tone::Alarm, "gone".to_owned())), (3, Act::Quit)]);
    serve(&mut fleet, &mut desk, Some(hands), Pacing { speed: 1.0 }, || false).expect("it ends");
    let printed: Vec<(&str, bool)> = desk.printed.iter().map(|line| (line.text.as_str(), line.t_s.is_some())).collect();
    assert_eq!(printed, [("Up", false), ("gone", true)]);
}
