use firmware::commander::{Asked, Goal, ManualMode, MotorTest, OrbitGoal, OrbitHeading, Request, SpeedKind};

use super::*;
use crate::sil::replay::{Entry, Input, OnLink};

fn header() -> Header {
    let set = vec!["wind=false".to_owned(), "modes={a=1}".to_owned()];
    Header { scenario: "field".to_owned(), set, seed: 9, files: "abc".to_owned() }
}

fn head() -> String {
    let recorder: Recorder<Vec<u8>> = Recorder::new(Vec::new(), &header());
    String::from_utf8(recorder.into_inner()).expect("text")
}

#[test]
fn what_is_read_is_what_was_written() {
    let numbers = [0.1, -0.0, 1.0e-42, f32::MAX];
    let [x, y, z, w] = numbers;
    let requests = [
        Request::Arm { force: false },
        Request::Arm { force: true },
        Request::Disarm,
        Request::TakeOff { height_m: 1.0 / 3.0 },
        Request::Hold,
        Request::GoTo(Goal::at([x, y, z], w)),
        Request::GoTo(Goal { yaw_rad: Some(z), ..Goal::default() }),
        Request::Offboard,
        Request::Orbit(OrbitGoal::of_numbers([x, y, z, w, f32::NAN], OrbitHeading::Along)),
        Request::TestMotor { test: MotorTest { rotor: 3, part: x }, seconds: z },
        Request::Manual(ManualMode::Acro),
        Request::Manual(ManualMode::Stabilized),
        Request::Manual(ManualMode::Altitude),
        Request::Manual(ManualMode::Position),
        Request::LandAt(Goal { place_m: Some([x, y]), ..Goal::default() }),
        Request::Speed { kind: SpeedKind::Horizontal, speed_m_s: Some(z) },
        Request::Speed { kind: SpeedKind::Up, speed_m_s: None },
        Request::Speed { kind: SpeedKind::Down, speed_m_s: Some(x) },
        Request::Velocity { velocity_m_s: [w, z, y], yaw_rate_rad_s: x },
        Request::Land,
        Request::Return,
        Request::Follow,
    ];
    let asked = requests.into_iter().map(Asked::from).chain([Asked::Kill]);
    let events = [
        OnLink::Open(Profile::Normal),
        OnLink::Open(Profile::Onboard),
        OnLink::Received((0..=255).collect()),
        OnLink::Lost(17),
        OnLink::Close,
    ];
    let links = events.into_iter().map(|event| Input::Link { link: 3, event });
    let entries: Vec<Entry> =
        (5..).zip(links.chain(asked.map(Input::Ask))).map(|(tick, input)| Entry { tick, input }).collect();
    let mut recorder: Recorder<Vec<u8>> = Recorder::new(Vec::new(), &header());
    for Entry { tick, input } in &entries {
        match input {
            Input::Link { link, event } => recorder.link(*tick, *link, event.event()),
            Input::Ask(asked) => recorder.console(*tick, &ConsoleInput::Asked(*asked)),
        }
    }
    recorder.finish(1000).expect("memory");
    let text = String::from_utf8(recorder.into_inner()).expect("text");
    assert_eq!(
        Recording::parse(&text).expect("read"),
        Recording { header: header(), entries, ticks: 1000, has_ended: true }
    );
}

#[test]
fn a_recording_without_an_end_was_flown_to_its_last_line() {
    let recording = Recording::parse(&(head() + "12 ask arm\n12 ask hold\n")).expect("read");
    assert_eq!((recording.ticks, recording.entries.len(), recording.has_ended), (13, 2, false));
}

#[test]
fn a_line_that_is_none_is_told_with_its_number_and_what_is_expected() {
    let begin = head();
    for (text, parts) in [
        (String::new(), ["line 1", "begins with `glissade-recording 1`"]),
        ("glissade-recording 1\nseed 3\n".to_owned(), ["line 2", "expected `scenario …`, not `seed 3`"]),
        ("glissade-recording 1\nscenario a\nseed x\n".to_owned(), ["`seed`", "not `x`"]),
        ("glissade-recording 1\nscenario a\n".to_owned(), ["it ends before", "`seed …`"]),
        (begin.clone(), ["no tick was flown", ""]),
        (begin.clone() + "x link 0 close\n", ["line 7", "`x` must be a tick"]),
        (begin.clone() + "3 end\n4 end\n", ["line 8", "nothing may follow `end`"]),
        (begin.clone() + "3 ask arm\n2 ask arm\n", ["line 8", "2 comes after 3"]),
        (begin.clone() + "3 link 4 close\n", ["line 7", "0 to 3"]),
        (begin.clone() + "3 link 0 open\n", ["line 7", "`open normal`"]),
        (begin.clone() + "3 link 0 hex 012\n", ["line 7", "pairs of hexadecimal digits"]),
        (begin.clone() + "3 link 0 hex 0g\n", ["line 7", "pairs of hexadecimal digits"]),
        (begin.clone() + "3 link 0 lost many\n", ["line 7", "`many`"]),
        (begin.clone() + "3 ask dance\n", ["line 7", "arm, arm-force"]),
        (begin.clone() + "3 ask takeoff\n", ["line 7", "1 numbers"]),
        (begin.clone() + "3 ask takeoff high\n", ["line 7", "1 numbers"]),
        (begin.clone() + "3 world fault gnss off\n", ["line 7", "`fault gnss off` was typed"]),
        (begin + "3 fly\n", ["line 7", "`link`, `ask` or `end`"]),
    ] {
        let error = format!("{:#}", Recording::parse(&text).expect_err(&text));
        assert!(parts.iter().all(|part| error.contains(part)) && !error.contains('\n'), "{text}: {error}");
    }
}

#[test]
fn a_change_of_the_world_is_told_once_to_who_types_it() {
    let mut recorder: Recorder<Vec<u8>> = Recorder::new(Vec::new(), &header());
    for line in ["wind 3 0", "clear"] {
        recorder.console(5, &ConsoleInput::World(line.to_owned()));
    }
    let notes = recorder.take_notes();
    assert!(notes.len() == 1 && notes[0].contains("`wind 3 0`"), "{notes:?}");
    assert!(recorder.take_notes().is_empty());
}
