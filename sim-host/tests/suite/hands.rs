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
        let flight = sim_host::flight::lockstep(scenario, SEED, sim_host::flight::rigid_body(scenario, SEED));
        let mut session = Session::new(flight.expect("flies"));
        let mut links = Links::bind("127.0.0.1:0".parse().expect("an address"), &[]).expect("a free port");
        session.seat_pilot(links.seat_pilot().expect("a free link"));
        let recorder = Recorder::new(Vec::new(), &Header::new(scenario, &[], SEED).expect("loaded"));
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
