//! A flight by hand that is recorded is flown again as it was: bit for bit, and with every byte that the vehicle sends.

use std::io::{BufRead as _, BufReader, Write as _};
use std::process::Stdio;
use std::sync::Arc;

use firmware::commander::Mode;
use firmware::mavlink::port::Profile;
use firmware::pil::{AllSent, Sent, take_sent};
use firmware::signals::Tick;
use glissade_dialect::MavCmd;
use sim_host::console::Session;
use sim_host::flight;
use sim_host::plant::{Motion, Plant as _};
use sim_host::recording::{Header, Recorder, Recording};
use sim_host::scenario::Scenario;
use sim_host::sil::Lockstep as _;
use sim_host::sil::replay::{Entry, Input, OnLink};

use crate::common::folder::Folder;
use crate::common::load::load;
use crate::common::station::{self, flight_by_two};

pub(crate) const SEED: u64 = 3;

/// A flight, tick by tick.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Course {
    motions: Vec<Motion>,
    pub(crate) modes: Vec<Mode>,
    sent: AllSent,
}

impl Course {
    /// A tick was flown.
    pub(crate) fn watch(&mut self, session: &Session) {
        take_sent(session.ports(), &mut self.sent);
        self.motions.push(session.flight().plant().motion());
        self.modes.push(session.flight().autopilot.inner.commander_output().mode);
    }
}

/// Flies a session, as `serve` does, on these inputs and typed lines. Returns what was flown, and its recording.
fn by_hand(scenario: &Scenario, inputs: &[Entry], typed: &[(Tick, &str)], ticks: Tick) -> (Course, String) {
    let flight = flight::lockstep(scenario, SEED, flight::rigid_body(scenario, SEED)).expect("flies");
    let (mut session, mut course) = (Session::new(flight), Course::default());
    let mut recorder = Recorder::new(Vec::new(), &Header::new(scenario, &[], SEED).expect("loaded"));
    for tick in 0..ticks {
        for (_, line) in typed.iter().filter(|(at, _)| *at == tick) {
            session.enter(line);
        }
        session.take_inputs().iter().for_each(|(tick, input)| recorder.console(*tick, input));
        for entry in inputs.iter().filter(|entry| entry.tick == tick) {
            let Input::Link { link, event } = &entry.input else { panic!("stations only") };
            session.ports().get(*link).expect("a link").take_in(event.event());
            recorder.link(tick, *link, event.event());
        }
        session.tick();
        course.watch(&session);
    }
    recorder.finish(ticks).expect("memory");
    (course, String::from_utf8(recorder.into_inner()).expect("text"))
}

/// Flies a recording.
pub(crate) fn again(scenario: Scenario, recording: &str) -> Course {
    let recording = Recording::parse(recording).expect("a recording");
    recording.require(&Header::new(&scenario, &[], SEED).expect("loaded")).expect("of this scenario");
    let scenario = recording.onto(scenario);
    let mut flight = flight::lockstep(&scenario, SEED, flight::rigid_body(&scenario, SEED)).expect("flies");
    let mut course = Course::default();
    for _ in 0..scenario.ticks() {
        flight.step(&mut ());
        course.motions.push(flight.plant().motion());
        course.modes.push(flight.autopilot.inner.commander_output().mode);
    }
    course.sent = flight.sent();
    course
}

#[test]
fn a_flight_by_ground_stations_is_flown_again_bit_for_bit() {
    let scenario = load("field", &[]);
    let (by_hand, recording) = by_hand(&scenario, &flight_by_two(3.0), &[], 24_000);
    for mode in [Mode::TakeOff, Mode::Hold, Mode::Return, Mode::Land, Mode::Idle] {
        assert!(by_hand.modes.contains(&mode), "{mode:?}");
    }
    let [first, second, none @ ..] = by_hand.sent;
    assert!(first.bytes > 20_000 && second.bytes > 60_000, "{first:?}, {second:?}");
    assert_eq!(none, [Sent::default(); 2]);
    assert!(again(scenario, &recording) == by_hand, "another flight");
}

#[test]
fn what_is_typed_is_flown_again_too() {
    let scenario = load("field", &[]);
    let typed = [
        (3_000, "arm"),
        (3_200, "takeoff 2.3"),
        (7_000, "goto 1.1 0.3 2 30"),
        (9_000, "velocity 0.7 0 0 5"),
        (11_000, "hold"),
        (11_000, "return"),
        (13_000, "kill"),
    ];
    let (by_hand, recording) = by_hand(&scenario, &[], &typed, 14_000);
    for mode in [Mode::TakeOff, Mode::GoTo, Mode::Velocity, Mode::Return] {
        assert!(by_hand.modes.contains(&mode), "{mode:?}");
    }
    assert!(again(scenario, &recording) == by_hand, "another flight");
}

/// Or the tests above could not fail.
#[test]
fn one_byte_changed_is_another_flight() {
    let scenario = load("pad", &[]);
    let inputs = flight_by_two(0.4);
    let (_, recording) = by_hand(&scenario, &inputs, &[], 3_000);
    let first = again(scenario.clone(), &recording);
    let changed = recording.replacen("hex 6a756e6b20fd03fd", "hex 6a756e6b20fd03fc", 1);
    assert!(changed != recording, "it has that byte");
    assert!(again(scenario, &changed) != first);
}

#[test]
fn inputs_come_at_their_ticks_and_none_is_left_out() {
    let mut scenario = load("pad", &[]);
    scenario.replay = Some(Arc::from(flight_by_two(0.4)));
    let mut flight = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("flies");
    let (mut tick, mut count) = (0, 0);
    while count < flight_by_two(0.4).len() {
        let due = flight.hear_replayed();
        assert!(due.iter().all(|entry| entry.tick == tick));
        count += due.len();
        assert!(tick < 30_000, "{count} came");
        let sample = flight.sense();
        flight.autopilot.tick(Some(&sample));
        tick += 1;
        flight.actuate(&firmware::signals::MotorCommand { omega_rad_s: [0.0; 4] }, false);
    }
}

#[test]
fn serve_records_what_run_flies_again() {
    let folder = Folder::new("record");
    let mut serve = folder.command(&["serve", "pad", "--listen", "127.0.0.1:0", "--record", "r.txt", "--seed", "7"]);
    let mut serve = serve.stdin(Stdio::piped()).spawn().expect("starts");
    let mut typed = serve.stdin.take().expect("a pipe");
    let mut printed = BufReader::new(serve.stdout.take().expect("a pipe")).lines();
    typed.write_all(b"arm\n").expect("it reads");
    assert!(printed.any(|line| line.is_ok_and(|line| line.contains("arm: accepted"))));
    typed.write_all(b"quit\n").expect("it reads");
    let output = serve.wait_with_output().expect("ends");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.contains("run pad --replay r.txt"), "{said}");
    let recording = std::fs::read_to_string(folder.0.join("r.txt")).expect("written");
    assert!(recording.contains(" ask arm\n") && recording.ends_with(" end\n"), "{recording}");
    folder.refuses(&["serve", "pad", "--listen", "127.0.0.1:0", "--record", "r.txt"], &["r.txt", "name another"]);
    let json = folder.json(&["run", "pad", "--replay", "r.txt", "--json"]);
    assert_eq!(json["seed"], 7);
    let (cut, _) = recording.trim_end().rsplit_once('\n').expect("lines");
    folder.file("cut.txt", format!("{cut}\n"));
    let (_, said) = folder.prints(&["run", "pad", "--replay", "cut.txt", "--json"]);
    assert!(said.contains("`cut.txt` was cut off"), "{said}");
}

#[test]
fn a_recording_with_a_restart_is_flown_again_by_run_and_refused_by_pil() {
    let folder = Folder::new("restart");
    let scenario = load("pad", &[]);
    let restart = |param1| station::command(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, [param1, 0.0, 0.0, 0.0]);
    let on_link = |tick, event| Entry { tick, input: Input::Link { link: 0, event } };
    let record = |name: &str, param1| {
        let received = OnLink::Received(station::frame(0, &restart(param1)));
        let entries = [on_link(0, OnLink::Open(Profile::Normal)), on_link(1_000, received)];
        let (_, recording) = by_hand(&scenario, &entries, &[], 3_000);
        folder.file(name, recording);
    };
    // Only the first of them is carried out: the second asks for a shutdown.
    record("restart.txt", 1.0);
    record("shutdown.txt", 2.0);
    folder.succeeds(&["run", "pad", "--replay", "restart.txt", "--json"]);
    let image = ["--image", "gone.elf"];
    folder.refuses(
        &["pil", "pad", "--replay", "restart.txt", image[0], image[1]],
        &["recording `restart.txt`", "before 1.5 s (PREFLIGHT_REBOOT_SHUTDOWN)", "`run --replay`"],
    );
    folder.refuses(&["pil", "pad", "--replay", "shutdown.txt", image[0], image[1]], &["gone.elf"]);
}

#[test]
fn a_recording_of_something_else_is_refused_with_what_differs() {
    let folder = Folder::new("replay");
    let scenario = load("pad", &["duration_s=5"]);
    let header = Header::new(&scenario, &["duration_s=5".to_owned()], 2).expect("loaded");
    let mut recorder = Recorder::new(Vec::new(), &header);
    recorder.finish(100).expect("memory");
    let text = String::from_utf8(recorder.into_inner()).expect("text");
    folder.file("r.txt", &text);
    folder.file("changed.txt", text.replace("files ", "files 0"));
    folder.file("bad.txt", text.replace("100 end", "100 link 0 hexx 12"));
    folder.file("world.txt", text.replace("100 end", "100 world wind 3 0"));
    let set = ["--set", "duration_s=5"];
    for (arguments, parts) in [
        (&["run", "helix", "--replay", "r.txt"][..], &["recording `r.txt`", "scenario `pad`, not of `helix`"][..]),
        (&["run", "pad", "--replay", "r.txt"], &["`--set 'duration_s=5'`, not with no --set"]),
        (&["run", "pad", set[0], set[1], "--seed", "1", "--replay", "r.txt"], &["seed 2, not with 1"]),
        (&["pil", "pad", set[0], set[1], "--seed", "1", "--replay", "r.txt"], &["seed 2, not with 1"]),
        (&["run", "pad", set[0], set[1], "--replay", "changed.txt"], &["`pad`", "has changed"]),
        (&["run", "pad", set[0], set[1], "--replay", "bad.txt"], &["`bad.txt`: line 6: ", "`hex BYTES`", "`hexx 12`"]),
        (&["run", "pad", set[0], set[1], "--replay", "world.txt"], &["line 6", "`wind 3 0` was typed"]),
        (&["run", "pad", "--replay", "gone.txt"], &["recording `gone.txt`", "No such file"]),
        (&["run", "pad", "--replay", "r.txt", "--seeds", "1..3"], &["--replay", "--seeds"]),
        (&["run", "paper-ideal", "--replay", "r.txt"], &["`plant` must be `rigid-body`"]),
    ] {
        folder.refuses(arguments, parts);
    }
    folder.succeeds(&["run", "pad", set[0], set[1], "--replay", "r.txt", "--json"]);
}
