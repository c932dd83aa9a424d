//! Hands of a pilot in this process: their bytes come in on a link, move the vehicle's sticks, and are flown again.

use firmware::commander::Mode;
use firmware::latest::{Stamped, Sticks as Seen};
use firmware::signals::Tick;
use sim_host::console::Session;
use sim_host::hands::station::Station;
use sim_host::hands::{Order, Selected, Sticks};
use sim_host::link::Links;
use sim_host::recording::{Header, Recorder};
use sim_host::scenario::Scenario;

use crate::common::load::load;
use crate::replay::{Course, SEED, again};

/// A vehicle with a pilot's station, flown as `serve` flies it.
struct Cockpit {
    session: Session,
    links: Links,
    pilot: Station,
    recorder: Recorder<Vec<u8>>,
    course: Course,
}

impl Cockpit {
    fn new(scenario: &Scenario) -> Self {
        Self::of_seed(scenario, SEED)
    }

    fn of_seed(scenario: &Scenario, seed: u64) -> Self {
        let flight = sim_host::flight::lockstep(scenario, seed, sim_host::flight::rigid_body(scenario, seed));
        let mut session = Session::new(flight.expect("flies"));
        let mut links = Links::bind("127.0.0.1:0".parse().expect("an address"), &[]).expect("a free port");
        session.seat_pilot(links.seat_pilot().expect("a free link"));
        let recorder = Recorder::new(Vec::new(), &Header::new(scenario, &[], seed).expect("loaded"));
        Self { session, links, pilot: Station::new(1), recorder, course: Course::default() }
    }

    fn next_tick(&self) -> Tick {
        (self.session.time_s() * 1e3).round() as Tick
    }

    fn ask(&mut self, order: Order) {
        let armed = self.session.flight().autopilot.inner.commander_output().armed;
        self.pilot.ask(order, armed);
    }

    /// Flies until a tick with the sticks so.
    fn until(&mut self, tick: Tick, sticks: Option<Sticks>) {
        while self.next_tick() < tick {
            let now = self.next_tick();
            let Self { session, links, pilot, recorder, course } = self;
            session.take_inputs().iter().for_each(|(tick, input)| recorder.console(*tick, input));
            links.hear_pilot(&pilot.frames(now, sticks));
            links.deliver(session.ports(), |link, event| recorder.link(now, link, event));
            session.tick();
            course.watch(session);
        }
    }

    /// The sticks that the vehicle has read last, and when.
    fn seen(&self) -> Option<Stamped<Seen>> {
        self.session.flight().autopilot.inner.latest().sticks
    }

    /// What was printed since the last call, without the times.
    fn said(&mut self) -> Vec<String> {
        self.session.take_lines().into_iter().map(|line| line.text).collect()
    }

    /// What was flown, and the recording.
    fn end(mut self) -> (Course, String) {
        self.recorder.finish(self.next_tick()).expect("memory");
        (self.course, String::from_utf8(self.recorder.into_inner()).expect("text"))
    }
}

#[test]
fn sticks_arrive_within_40_ms_and_stop_when_there_are_none() {
    let mut cockpit = Cockpit::new(&load("pad", &[]));
    cockpit.until(500, None);
    assert_eq!(cockpit.seen(), None);
    let sticks = Sticks { roll: 0.25, pitch: -0.5, yaw: 1.0, throttle: -1.0 };
    cockpit.until(510, Some(sticks));
    // A message every 20 ms, and 18 ms from its bytes to the outer loop.
    cockpit.until(550, Some(sticks));
    let seen = cockpit.seen().expect("they have come");
    // In the body's frame, forward, left, up.
    let there = Seen { roll: 0.25, pitch: -0.5, yaw: -1.0, throttle: 0.0, ..Seen::CENTRED };
    assert_eq!(seen.value, there);
    let oldest = (500..5_000).step_by(5).map(|tick| {
        cockpit.until(tick.max(551), Some(sticks));
        cockpit.next_tick() - cockpit.seen().expect("still there").at
    });
    assert!(oldest.max() <= Some(40), "50 a second");
    cockpit.until(5_000, Some(sticks));
    cockpit.until(6_000, None);
    let last = cockpit.seen().expect("the last ones").at;
    assert!((4_980..5_010).contains(&last), "none come any more: {last}");
}

#[test]
fn a_flight_with_sticks_and_orders_is_flown_again_bit_for_bit() {
    let scenario = load("field", &[]);
    let mut cockpit = Cockpit::new(&scenario);
    cockpit.until(3_000, Some(Sticks::default()));
    cockpit.said();
    cockpit.ask(Order::ArmOrDisarm);
    cockpit.until(3_500, Some(Sticks { throttle: -1.0, ..Sticks::default() }));
    assert!(cockpit.said().contains(&"pilot: arm: accepted".to_owned()));
    cockpit.session.enter("takeoff 2");
    let forward = Sticks { pitch: 0.123, roll: -0.777, ..Sticks::default() };
    cockpit.until(8_000, Some(forward));
    cockpit.ask(Order::Select(Selected::Return));
    cockpit.until(9_000, None);
    cockpit.ask(Order::Select(Selected::Hold));
    cockpit.until(10_000, Some(forward));
    cockpit.ask(Order::Kill);
    cockpit.until(11_000, Some(forward));
    let said = cockpit.said();
    for line in ["pilot: return: accepted", "pilot: hold: accepted", "pilot: kill: accepted"] {
        assert_eq!(said.iter().filter(|said| *said == line).count(), 1, "{line} in {said:?}");
    }
    let (course, recording) = cockpit.end();
    for mode in [Mode::TakeOff, Mode::Hold, Mode::Return] {
        assert!(course.modes.contains(&mode), "{mode:?}");
    }
    assert!(recording.contains("0 link 0 open normal") && recording.matches(" link 0 hex ").count() > 450);
    assert!(again(scenario, &recording) == course, "another flight");
}

#[test]
fn a_refusal_is_told_once_and_as_the_pilots() {
    let mut cockpit = Cockpit::new(&load("field", &[]));
    cockpit.until(100, None);
    cockpit.ask(Order::ArmOrDisarm);
    cockpit.until(400, None);
    let refused = "pilot: arm: refused, no valid attitude estimate; wait for sensors";
    let said = cockpit.said();
    assert_eq!(said.iter().filter(|said| said.contains("pilot")).collect::<Vec<_>>(), [refused], "{said:?}");
}

/// The seed that `serve` flies unless told otherwise, as the commands beside the shown flights do.
const SHOWN_SEED: u64 = 1;

/// A flight that a document shows, and what is printed.
struct Shown {
    cockpit: Cockpit,
    printed: String,
}

impl Shown {
    fn new() -> Self {
        Self { cockpit: Cockpit::of_seed(&load("field", &[]), SHOWN_SEED), printed: String::new() }
    }

    /// Flies until a time, s.
    fn until(&mut self, until_s: f64, sticks: Option<Sticks>) {
        self.cockpit.until((until_s * 1e3) as Tick, sticks);
        self.printed.extend(self.cockpit.session.take_lines().iter().map(|line| format!("{line}\n")));
    }

    /// Presses something, and flies until a time, s.
    fn press(&mut self, pressed: &str, order: Option<Order>, sticks: Sticks, until_s: f64) {
        let now_s = f64::from(self.cockpit.next_tick()) * 1e-3;
        self.printed.extend([format!("[{now_s:8.2} s] you: {pressed}\n")]);
        if let Some(order) = order {
            self.cockpit.ask(order);
        }
        self.until(until_s, Some(sticks));
    }

    /// Compares it with the block of a document after `<!-- begin: NAME -->`, or writes that if `GLISSADE_GENERATE` is set.
    fn assert_shown(self, path: &str, name: &str) {
        let path = format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"));
        let document = std::fs::read_to_string(&path).expect("a document");
        let begin = format!("<!-- begin: {name} -->\n```\n");
        let (before, rest) = document.split_once(&begin).expect("the block begins");
        let (shown, after) = rest.split_once("```").expect("the block ends");
        if std::env::var_os("GLISSADE_GENERATE").is_some() {
            std::fs::write(path, [before, &begin, &self.printed, "```", after].concat()).expect("written");
            return;
        }
        assert_eq!(shown, self.printed, "GLISSADE_GENERATE=1 writes it");
    }
}

#[test]
fn a_pilots_session_in_the_readme_is_what_is_printed() {
    let mut shown = Shown::new();
    let middle = Sticks::default();
    shown.until(2.0, Some(middle));
    shown.press("3 (position mode)", Some(Order::Select(Selected::Position)), middle, 3.0);
    shown.press("m (arm)", Some(Order::ArmOrDisarm), middle, 4.0);
    shown.press("w, held (throttle up)", None, Sticks { throttle: 1.0, ..middle }, 6.0);
    shown.press("nothing", None, middle, 8.0);
    shown.press("arrow up, held (forward)", None, Sticks { pitch: 1.0, ..middle }, 11.0);
    shown.press("nothing", None, middle, 14.0);
    shown.press("6 (return)", Some(Order::Select(Selected::Return)), middle, 45.0);
    shown.assert_shown("README.md", "pilot");
}

/// What the script beside the first flight types, each line with its time, s.
fn typed(document: &str) -> Vec<(f64, String)> {
    let (_, script) = document.split_once("```sh\n(").expect("the script begins");
    let (script, _) = script.split_once(") | cargo run --release -- serve\n").expect("the script ends");
    let (mut now_s, mut lines) = (0.0, Vec::new());
    for word in script.split([';', '\n']).map(str::trim) {
        if let Some(pause) = word.strip_prefix("sleep ") {
            now_s += pause.parse::<f64>().expect("seconds");
        } else {
            lines.push((now_s, word.strip_prefix("echo ").expect("a line").to_owned()));
        }
    }
    lines
}

#[test]
fn the_first_flight_in_the_docs_is_what_is_printed() {
    let document = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/serve.md");
    let mut lines = typed(&std::fs::read_to_string(document).expect("a document"));
    let (quit_s, quit) = lines.pop().expect("it ends");
    assert_eq!(quit, "quit");
    let mut shown = Shown::new();
    for (at_s, line) in lines {
        shown.until(at_s, None);
        shown.cockpit.session.enter(&line);
    }
    // What is printed last is printed also where the program begins later than the script.
    shown.until(quit_s - 1.0, None);
    let before = shown.printed.len();
    shown.until(quit_s, None);
    assert!(shown.printed.contains("] disarmed: ") && shown.printed.len() == before, "{}", shown.printed);
    shown.assert_shown("docs/serve.md", "first flight");
}
