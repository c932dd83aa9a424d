//! The console of `serve`, in lockstep and without a clock: lines go in at given times, and what is printed is held
//! against the truth.

use firmware::commander::{Event, Refusal};
use firmware::mavlink::port::{Profile, SENT_CAPACITY};
use firmware::signals::TICK_S_EXACT;
use glissade_dialect::mavlink_core::MessageData;
use glissade_dialect::{COMMAND_LONG_DATA, MANUAL_CONTROL_DATA, SET_POSITION_TARGET_LOCAL_NED_DATA};
use nalgebra::{UnitQuaternion, Vector3};
use sim_host::console::{Control, Session};
use sim_host::flight;
use sim_host::plant::rigid_body::RigidBody;
use sim_host::plant::{Motion, Plant as _};
use sim_host::scenario::Scenario;
use sim_host::sil::{Flight, Lockstep as _};

use crate::common::station;

fn flight(name: &str, seed: u64) -> Flight<RigidBody> {
    let scenario = Scenario::load(name, &[]).expect("built in");
    flight::lockstep(&scenario, seed, flight::rigid_body(&scenario, seed)).expect("flies")
}

/// A session, and what it has printed.
struct Bench {
    session: Session,
    printed: Vec<String>,
    /// Lines before this one have been looked at.
    seen: usize,
    /// Speed downwards in the last tick in the air before each touchdown, m/s, and where that was. As in
    /// `touchdown`, one that has not been half a metre up does not touch down.
    touchdowns: Vec<(f64, Vector3<f64>)>,
    before: Motion,
    has_flown: bool,
}

impl Bench {
    fn new(name: &str) -> Self {
        let session = Session::new(flight(name, 1));
        session.ports().first().open(Profile::Normal);
        let before = session.flight().plant().motion();
        Self { session, printed: Vec::new(), seen: 0, touchdowns: Vec::new(), before, has_flown: false }
    }

    fn motion(&self) -> Motion {
        self.session.flight().plant().motion()
    }

    fn in_air(&self, motion: &Motion) -> bool {
        let ground = self.session.flight().plant().ground().expect("a ground");
        let attitude = UnitQuaternion::new_normalize(motion.attitude);
        ground.clearances(&motion.position, &attitude).iter().all(|clearance| *clearance > 0.0)
    }

    /// A tick in which this arrives from a ground station.
    fn hear(&mut self, bytes: &[u8]) {
        self.session.overhear(0, bytes);
        self.session.ports().first().receive(bytes);
        self.tick();
    }

    fn tick(&mut self) {
        self.session.tick();
        self.session.ports().first().take(&mut [0; SENT_CAPACITY]);
        let now = self.motion();
        self.has_flown |= now.position.z > 0.5;
        if self.has_flown && self.in_air(&self.before) && !self.in_air(&now) {
            self.has_flown = false;
            self.touchdowns.push((-self.before.velocity.z, now.position));
        }
        self.before = now;
        self.printed.extend(self.session.take_lines().iter().map(ToString::to_string));
    }

    fn fly(&mut self, seconds: f64) {
        for _ in 0..(seconds / TICK_S_EXACT).round() as u32 {
            self.tick();
        }
    }

    /// Flies until a line ends like that; returns it. Nothing before it is looked at again.
    fn until(&mut self, end: &str, within_s: f64) -> String {
        for _ in 0..(within_s / TICK_S_EXACT).round() as u32 {
            if let Some(place) = self.printed.iter().skip(self.seen).position(|line| line.contains(end)) {
                self.seen += place + 1;
                return self.printed[self.seen - 1].clone();
            }
            self.tick();
        }
        panic!("no `{end}` within {within_s} s: {:#?}", self.printed);
    }

    /// Enters a line; returns the first answer.
    fn enter(&mut self, line: &str) -> String {
        self.seen = self.printed.len();
        assert_eq!(self.session.enter(line), None, "{line}");
        self.until("", 0.1)
    }

    fn arm_and_climb(&mut self, height: f64) {
        self.until("] ready to arm", 10.0);
        self.enter("arm");
        self.enter(&format!("takeoff {height}"));
        self.until("mode: take-off → hold", 20.0);
    }
}

/// A line without its time stamp.
fn text(line: &str) -> &str {
    line.split_once("] ").map_or(line, |(_, text)| text)
}

/// The answer to a refused command.
fn refusal(command: &str, reason: Refusal, remedy: &str) -> String {
    format!("{command}: refused, {}{remedy}", reason.reason())
}

/// The numbers in a line.
fn numbers(line: &str) -> Vec<f64> {
    text(line).split(|c: char| !c.is_ascii_digit() && c != '.').filter_map(|word| word.parse().ok()).collect()
}

#[test]
fn a_whole_flight_is_commanded_by_lines_and_told_as_it_was() {
    let mut bench = Bench::new("field");
    bench.until("] ready to arm", 10.0);
    let home = bench.motion().position;
    assert_eq!(text(&bench.enter("arm")), "arm: accepted");
    bench.until("] armed: the rotors idle", 0.1);
    assert_eq!(text(&bench.enter("takeoff 5")), "take-off to 5 m: accepted");
    // Once the rotors have spun up.
    bench.until("mode: idle → take-off", 1.1);
    bench.until("] in the air", 3.0);
    bench.until("mode: take-off → hold", 10.0);
    bench.fly(3.0);
    // By satellites, height is known to a metre or so.
    assert!((bench.motion().position.z - 5.0).abs() < 1.5, "{}", bench.motion().position);

    assert_eq!(text(&bench.enter("goto 5 0 5 90")), "go to north 5, west 0, up 5 m, yaw 90°: accepted");
    bench.until("mode: hold → go-to", 0.1);
    bench.fly(10.0);
    assert!((bench.motion().position.xy() - Vector3::new(5.0, 0.0, 0.0).xy()).norm() < 2.0);
    assert_eq!(text(&bench.enter("wind 4 -1")), "wind set: north 4.0, west -1.0, up 0.0 m/s");
    bench.fly(5.0);
    assert!((bench.motion().position.xy() - Vector3::new(5.0, 0.0, 0.0).xy()).norm() < 2.0, "it leans into the wind");

    assert_eq!(text(&bench.enter("fault gnss off")), "fault: gnss off");
    bench.fly(1.0);
    assert_eq!(text(&bench.enter("clear")), "no faults: 1 cleared");
    bench.fly(5.0);
    assert_eq!(text(&bench.enter("land")), "land: accepted");
    let landed = bench.until("] landed: touched down at", 30.0);
    bench.until("] disarmed: after landing", 3.0);

    let (speed, place) = *bench.touchdowns.first().expect("it has come down");
    let away = (place - home).xy().norm();
    // Printed to 0.01.
    assert_eq!(numbers(&landed).len(), 2, "{landed}");
    assert!((numbers(&landed)[0] - speed).abs() <= 0.0051, "{landed}: {speed} m/s");
    assert!((numbers(&landed)[1] - away).abs() <= 0.0051, "{landed}: {away} m");
    assert!(speed < 1.0, "{landed}");
    let lines = bench.printed.len();
    bench.fly(5.0);
    assert_eq!(bench.printed.len(), lines, "{:?}", bench.printed.last());
}

#[test]
fn a_command_is_answered_within_24_ms_of_simulated_time() {
    let mut slowest = 0;
    for phase in 0..20 {
        let mut bench = Bench::new("pad");
        bench.fly(1.0 + f64::from(phase) * TICK_S_EXACT);
        bench.seen = bench.printed.len();
        bench.session.enter("disarm");
        let before = bench.session.flight().next_tick();
        while bench.printed.len() == bench.seen {
            bench.tick();
        }
        slowest = slowest.max(bench.session.flight().next_tick() - before);
    }
    // Up to 20 ms to the commander's next job, and the 4 ms after which its output takes effect.
    assert_eq!(slowest, 24);
}

#[test]
fn lines_are_stamped_with_simulated_time() {
    let mut bench = Bench::new("pad");
    bench.fly(1.234);
    let line = bench.enter("wind");
    assert!(line.starts_with("[    1.23 s] wind: north 0.0"), "{line}");
}

#[test]
fn a_failure_and_what_the_vehicle_does_about_it_are_told() {
    let mut bench = Bench::new("field");
    bench.arm_and_climb(5.0);
    bench.enter("fault gnss off");
    let text_of = |line: &str| text(line).to_lowercase();
    let told = bench.until("failsafe: ", 5.0);
    assert_eq!(text_of(&told), format!("failsafe: {}", Event::PositionLost.text()).to_lowercase());
    bench.until("mode: hold → descent", 0.1);
    let refused = bench.enter("hold");
    assert_eq!(text(&refused), refusal("hold", Refusal::NoPosition, "; wait for sensors"));
    bench.until("landed: touched down at", 30.0);
    bench.until("disarmed", 3.0);
    bench.until(&format!("not ready to arm: {}", Refusal::NoPosition.reason()), 3.0);
    bench.enter("clear");
    bench.until("] ready to arm", 10.0);
}

#[test]
fn faults_are_told_when_they_begin_and_when_they_end() {
    let mut bench = Bench::new("field");
    assert_eq!(text(&bench.enter("fault baro stuck from_s=1 to_s=2")), "fault from 1 s on: baro stuck");
    assert_eq!(text(&bench.enter("faults")), "from 1 s on: fault sensor=baro kind=stuck from_s=1.0 to_s=2.0");
    assert!(bench.enter("status").ends_with("; no faults"), "it is yet to come");
    let begun = bench.until("fault: baro stuck", 2.0);
    assert_eq!(text(&bench.enter("faults")), "fault sensor=baro kind=stuck from_s=1.0 to_s=2.0");
    assert!(bench.enter("status").ends_with("; faults: baro stuck"));
    let over = bench.until("fault ends: baro stuck", 2.0);
    // The console looks each 20 ms.
    assert!(begun.starts_with("[    1.0") && over.starts_with("[    2.0"), "{begun} {over}");
    assert_eq!(text(&bench.enter("faults")), "no faults");
    assert_eq!(text(&bench.enter("clear")), "no faults");
    bench.enter("fault mag stuck");
    bench.enter("fault baro stuck");
    assert_eq!(text(&bench.enter("failure mag ok")), "no faults of mag: 1 cleared");
    assert!(bench.enter("status").ends_with("; faults: baro stuck"), "the other goes on");
}

/// A `COMMAND_LONG` of ground station 255, by its number and first three parameters.
fn command_long(command: u16, [param1, param2, param3]: [f32; 3]) -> Vec<u8> {
    let message = COMMAND_LONG_DATA { command, param1, param2, param3, target_system: 1, ..COMMAND_LONG_DATA::DEFAULT };
    frame(&message)
}

/// A frame of ground station 255.
fn frame(message: &impl MessageData) -> Vec<u8> {
    station::frame(0, message)
}

#[test]
fn each_command_of_a_ground_station_is_told_once_with_its_answer() {
    let mut bench = Bench::new("field");
    bench.until("] ready to arm", 10.0);
    for (command, parameters, told) in [
        // PREFLIGHT_STORAGE, to a main mode that there is not, neither arm nor disarm.
        (245, [0.0; 3], &["command 245 (PREFLIGHT_STORAGE): unsupported"][..]),
        // MISSION_START, which is not in the dialect; and one that nobody knows.
        (300, [0.0; 3], &["command 300 (MISSION_START): unsupported"]),
        (60_000, [0.0; 3], &["command 60000: unsupported"]),
        // The same again, as stations do every other second.
        (245, [0.0; 3], &[]),
        (176, [1.0, 9.0, 0.0], &["command 176 (DO_SET_MODE): denied"]),
        (400, [2.0, 0.0, 0.0], &["command 400 (COMPONENT_ARM_DISARM): denied"]),
        // A message that it has not: ground stations ask for many.
        (512, [30_000.0, 0.0, 0.0], &[]),
        // What the commander answers.
        (400, [1.0, 0.0, 0.0], &["arm: accepted"]),
        (22, [0.0; 3], &["take-off to 0 m: denied: a value is out of its range"]),
    ] {
        bench.seen = bench.printed.len();
        bench.hear(&command_long(command, parameters));
        bench.fly(0.2);
        let lines: Vec<_> =
            bench.printed[bench.seen..].iter().filter_map(|line| line.split_once("station 255: ")).collect();
        assert_eq!(lines.iter().map(|(_, text)| *text).collect::<Vec<_>>(), told, "{command} {parameters:?}");
    }
}

#[test]
fn an_answer_that_a_slow_link_has_not_taken_is_told_once() {
    let mut bench = Bench::new("field");
    bench.until("] ready to arm", 10.0);
    bench.session.ports().first().receive(&command_long(192, [0.0; 3]));
    bench.session.ports().first().receive(&command_long(400, [2.0, 0.0, 0.0]));
    let mut told = 0;
    for _ in 0..500 {
        bench.session.tick();
        told += bench.session.take_lines().iter().filter(|line| line.text.contains("command 400")).count();
    }
    assert_eq!(told, 1);
}

#[test]
fn a_take_off_that_arming_starts_is_told() {
    let mut bench = Bench::new("field");
    bench.until("] ready to arm", 10.0);
    let answer = bench.enter("takeoff 3");
    assert!(answer.contains("accepted, when armed within"), "{answer}");
    bench.enter("arm");
    bench.until("armed: the rotors idle", 1.0);
    // Once the rotors have spun up.
    bench.until("mode: idle → take-off", 1.1);
}

#[test]
fn a_landing_is_told_without_a_distance_once_another_home_was_set() {
    let mut bench = Bench::new("field");
    bench.arm_and_climb(3.0);
    bench.enter("goto 8 0 3");
    bench.fly(12.0);
    // DO_SET_HOME: here.
    bench.hear(&command_long(179, [1.0, 0.0, 0.0]));
    bench.until("home here: accepted", 1.0);
    bench.enter("land");
    let landed = bench.until("landed: touched down at", 30.0);
    assert!(numbers(&landed).len() == 1 && !landed.contains("home"), "{landed}: where home is it only believes");
}

#[test]
fn killed_in_the_air_it_falls_and_that_is_told() {
    falls_by(|bench| assert_eq!(text(&bench.enter("kill")), "kill: accepted"));
    falls_by(|bench| {
        bench.hear(&command_long(400, [0.0, 21_196.0, 0.0]));
        bench.until("ground station 255: kill: accepted", 0.1);
    });
}

fn falls_by(kill: impl Fn(&mut Bench)) {
    let mut bench = Bench::new("field");
    bench.arm_and_climb(5.0);
    let height = bench.motion().position.z;
    kill(&mut bench);
    bench.until("disarmed in the air: killed; the rotors are stopped", 0.1);
    let landed = bench.until("touched down at", 20.0);
    // v = √(2 g h); drag takes a little.
    let fallen = (2.0 * 9.81 * height).sqrt();
    assert!((0.8 * fallen..1.01 * fallen).contains(&numbers(&landed)[0]), "{landed}: {fallen}");
}

#[test]
fn what_a_vehicle_passes_over_is_told_once_in_a_while() {
    let mut bench = Bench::new("pad");
    bench.until("] ready to arm", 5.0);
    // A mask that gives nothing, and a place beyond all others.
    let nothing = SET_POSITION_TARGET_LOCAL_NED_DATA {
        type_mask: 0xfff,
        coordinate_frame: 1,
        target_system: 1,
        ..SET_POSITION_TARGET_LOCAL_NED_DATA::DEFAULT
    };
    let far = SET_POSITION_TARGET_LOCAL_NED_DATA { type_mask: 0, x: 1e6, ..nothing.clone() };
    let sticks = MANUAL_CONTROL_DATA { x: 2000, target: 1, ..MANUAL_CONTROL_DATA::DEFAULT };
    let other = COMMAND_LONG_DATA { command: 400, target_system: 9, ..COMMAND_LONG_DATA::DEFAULT };
    for (bytes, told) in [
        (frame(&nothing), "set-point: refused, mask not supported"),
        (frame(&far), "set-point: refused, out of range"),
        (frame(&sticks), "MANUAL_CONTROL: ignored, x must be between -1000 and 1000, not 2000"),
        (frame(&other), "command 400 (COMPONENT_ARM_DISARM): ignored, it is for system 9; the vehicle is 1"),
    ] {
        bench.seen = bench.printed.len();
        for _ in 0..100 {
            bench.hear(&bytes);
            bench.fly(0.049);
        }
        let lines: Vec<&str> = bench.printed[bench.seen..].iter().map(|line| text(line)).collect();
        assert_eq!(lines, [format!("ground station 255: {told}")]);
        bench.fly(5.0);
    }
}

#[test]
fn a_restart_and_a_termination_by_a_ground_station_are_told() {
    let mut bench = Bench::new("pad");
    bench.until("] ready to arm", 5.0);
    for (command, told) in [(246, "restart"), (185, "termination")] {
        bench.hear(&command_long(command, [1.0, 0.0, 0.0]));
        bench.until(&format!("ground station 255: {told}: accepted"), 0.1);
        // A restart follows its answer.
        bench.fly(2.0);
    }
    let told = bench.printed.iter().filter(|line| line.contains("ground station 255")).count();
    assert_eq!(told, 2, "{:#?}", bench.printed);
}

/// Why a vehicle is disarmed, and how that comes about.
type Cause<'a> = (&'a str, &'a dyn Fn(&mut Bench));

#[test]
fn why_it_was_disarmed_is_told() {
    let mut bench = Bench::new("pad");
    bench.until("] ready to arm", 5.0);
    let sticks = MANUAL_CONTROL_DATA { z: 0, r: -1000, target: 1, ..MANUAL_CONTROL_DATA::DEFAULT };
    let disarm: [Cause; 5] = [
        ("by a typed line", &|bench| {
            bench.session.enter("disarm");
        }),
        ("by ground station 255", &|bench| bench.hear(&command_long(400, [0.0; 3]))),
        ("killed", &|bench| bench.hear(&command_long(400, [0.0, 21_196.0, 0.0]))),
        // The gesture: throttle down, yaw to the left.
        ("by stick or switch", &|bench| {
            for _ in 0..60 {
                bench.hear(&frame(&sticks));
                bench.fly(0.02);
            }
        }),
        ("not flown since it was armed", &|bench| bench.fly(9.9)),
    ];
    for (why, disarm) in disarm {
        assert_eq!(text(&bench.enter("arm")), "arm: accepted", "before {why}");
        bench.until("armed: the rotors idle", 0.1);
        disarm(&mut bench);
        bench.until(&format!("] disarmed: {why}"), 1.0);
        // For a second after a kill nothing starts.
        bench.fly(2.0);
    }
}

#[test]
fn after_a_crash_it_is_told_to_be_neither_flying_nor_in_the_air() {
    let mut bench = Bench::new("field");
    bench.arm_and_climb(5.0);
    for index in 0..4 {
        bench.enter(&format!("fault rotor index={index} effectiveness=0"));
    }
    bench.until("CRASHED: touched down at", 5.0);
    bench.enter("disarm force");
    bench.fly(15.0);
    let after = &bench.printed[bench.seen..];
    let wrong = ["in the air", "on the ground without knowing it"];
    assert!(!after.iter().any(|line| wrong.iter().any(|text| line.contains(text))), "{after:#?}");
    assert!(after.iter().any(|line| line.ends_with("] disarmed: killed")), "{after:#?}");
}

#[test]
fn a_rotor_that_works_again_is_flown_after_arming_by_force() {
    let mut bench = Bench::new("field");
    bench.arm_and_climb(3.0);
    // INJECT_FAILURE: motor 2 off, and later well again.
    bench.hear(&command_long(420, [101.0, 1.0, 2.0]));
    bench.until("mode: hold → motor-out", 1.0);
    let hold = bench.enter("hold");
    assert_eq!(text(&hold), refusal("hold", Refusal::RotorFailed, ""), "in the air");
    bench.until("] disarmed", 30.0);
    let refused = refusal("arm", Refusal::RotorFailed, "; once it works (`clear`), `arm force`");
    assert_eq!(text(&bench.enter("arm")), refused);
    bench.hear(&command_long(420, [101.0, 0.0, 2.0]));
    bench.until("ground station: rotor 2 (index 1) works again", 0.1);
    assert_eq!(text(&bench.enter("arm force")), "arm without checks: accepted");
    assert_eq!(text(&bench.enter("takeoff 2")), "take-off to 2 m: accepted");
    bench.until("mode: take-off → hold", 10.0);
}

#[test]
fn what_a_ground_station_says_works_again_does_whoever_broke_it() {
    let mut bench = Bench::new("field");
    bench.until("] ready to arm", 10.0);
    bench.enter("fault rotor index=1 effectiveness=0.5");
    bench.enter("fault gnss off");
    bench.hear(&command_long(420, [101.0, 0.0, 2.0]));
    bench.until("ground station: rotor 2 (index 1) works again", 0.1);
    let left = bench.enter("faults");
    assert!(left.contains("fault sensor=gnss kind=off"), "{left}");
}

#[test]
fn a_velocity_that_is_cut_says_by_what() {
    let mut bench = Bench::new("field");
    bench.arm_and_climb(5.0);
    let answer =
        |bench: &mut Bench, line: &str| text(&bench.enter(line)).split_once(": ").map(|(_, said)| said.to_owned());
    assert_eq!(answer(&mut bench, "velocity 3 4 1").as_deref(), Some("accepted"));
    let cut = "accepted, at no more than 12 m/s (modes.fastest_m_s), 2 m/s (modes.climb_m_s)";
    assert_eq!(answer(&mut bench, "velocity 15 0 3").as_deref(), Some(cut));
    bench.fly(10.0);
    let flown = bench.motion().velocity;
    assert!((flown.x - 12.0).abs() < 0.3, "{flown}");
}

#[test]
fn a_position_that_is_wrong_though_the_vehicle_trusts_it_is_told_by_the_truth() {
    let mut bench = Bench::new("field");
    bench.arm_and_climb(15.0);
    // The estimator takes the satellites to have jumped, and shifts them.
    bench.enter("fault mag drift rate=1");
    let line = bench.until("m off the truth", 60.0);
    let nav = bench.session.flight().autopilot.inner.nav().position.cast::<f64>();
    let off = (bench.motion().position - nav).norm();
    assert!(
        off > 3.0 && line.contains("position known again") && line.ends_with(&format!(", {off:.1} m off the truth")),
        "{off}: {line}"
    );
    assert!(bench.enter("status").contains("m off the truth, yaw"), "{:?}", bench.printed.last());
}

#[test]
fn a_velocity_goes_on_until_the_next_command() {
    let mut bench = Bench::new("field");
    bench.arm_and_climb(5.0);
    bench.enter("velocity 1 0 0");
    let start = bench.motion().position.x;
    bench.fly(10.0);
    let flown = bench.motion().position.x - start;
    // 1 m/s for 10 s, less the time to get there.
    assert!((8.0..10.5).contains(&flown), "{flown}");
    assert_eq!(text(&bench.enter("hold")), "hold: accepted");
    bench.until("mode: velocity → hold", 0.1);
    let lines = bench.printed.len();
    bench.fly(5.0);
    assert_eq!(bench.printed.len(), lines, "{:?}", bench.printed.last());
    assert!(bench.motion().velocity.norm() < 0.5);
}

#[test]
fn what_cannot_be_done_is_refused_with_the_reason() {
    let mut bench = Bench::new("field");
    assert_eq!(text(&bench.enter("arm")), refusal("arm", Refusal::NotAligned, "; wait for sensors"));
    bench.until("] ready to arm", 10.0);
    assert_eq!(text(&bench.enter("return")), refusal("return", Refusal::Disarmed, "; `arm` first"));
    assert_eq!(
        text(&bench.enter("goto 0 0 -1")),
        "goto: UP = -1 m is not above the ground, which is at 0 m: use `land`"
    );
    bench.enter("arm");
    assert_eq!(
        text(&bench.enter("velocity up=1")),
        refusal("velocity north 0, west 0, up 1 m/s, yaw 0°/s", Refusal::OnGround, "; `takeoff` first")
    );
    assert_eq!(text(&bench.enter("fault pose off")), "there is no `pose` on board");
    let mut ideal = Bench::new("pad");
    let refused = ideal.enter("fault gnss off");
    assert!(text(&refused).starts_with("nothing fails on ideal state"), "{refused}");
}

#[test]
fn a_take_off_waits_a_while_to_be_armed() {
    let mut bench = Bench::new("pad");
    bench.until("] ready to arm", 1.0);
    assert_eq!(text(&bench.enter("takeoff 2")), "take-off to 2 m: accepted, when armed within 5 s");
    bench.enter("arm");
    bench.until("mode: take-off → hold", 10.0);
}

#[test]
fn many_lines_at_once_are_carried_out_in_their_order() {
    let mut bench = Bench::new("pad");
    bench.until("] ready to arm", 1.0);
    for _ in 0..10 {
        bench.session.enter("arm");
        bench.session.enter("disarm");
    }
    bench.session.enter("arm");
    bench.session.enter("takeoff 2");
    bench.fly(1.0);
    let answers = bench.printed.iter().filter(|line| line.ends_with(": accepted")).count();
    assert_eq!(answers, 22, "{:#?}", bench.printed);
    bench.until("mode: take-off → hold", 10.0);
}

#[test]
fn the_pace_and_the_end_are_for_whoever_runs_the_session() {
    let mut session = Session::new(flight("pad", 1));
    assert_eq!(session.enter("speed 10"), Some(Control::Speed(10.0)));
    assert_eq!(session.enter("quit"), Some(Control::Quit));
}

#[test]
fn questions_and_bad_lines_change_no_bit_of_the_flight() {
    let mut plain = flight("field", 3);
    let mut session = Session::new(flight("field", 3));
    let harmless = ["help", "status", "wind", "faults", "nonsense", "takeoff -5", "fault gns off", "goto 0 0 -1", ""];
    for tick in 0..20_000 {
        if tick % 100 == 0 {
            session.enter(harmless[tick / 100 % harmless.len()]);
        }
        plain.step(&mut ());
        session.tick();
        assert_eq!(session.flight().plant().motion(), plain.plant().motion(), "tick {tick}");
    }
    assert!(session.take_lines().len() > 100, "each was answered");
}

#[test]
fn help_lists_what_is_known_and_explains_each() {
    let mut bench = Bench::new("pad");
    bench.enter("help");
    bench.fly(0.1);
    for command in ["help", "arm", "takeoff", "goto", "land", "wind", "fault", "clear", "return", "kill", "status"] {
        let listed = bench.printed.iter().any(|line| line.starts_with(&format!("  {command} ")));
        assert!(listed, "{command}: {:#?}", bench.printed);
        let explained = bench.enter(&format!("help {command}"));
        assert!(explained.starts_with(&format!("  {command}")), "{explained}");
    }
}
