use super::*;
use crate::sensors::faults::{Kind, Sensor};

fn read(line: &str) -> Command {
    parse(line, 1500).expect(line).expect("a command")
}

#[test]
fn every_command_is_read() {
    let request = Command::Request;
    let goto = |place: [Option<f64>; 3], yaw_deg: Option<f64>| Command::GoTo { place, yaw_deg };
    for (line, command) in [
        ("help", Command::Help(None)),
        ("help rtl", Command::Help(COMMANDS.iter().find(|entry| entry.name() == "return"))),
        ("status", Command::Status),
        ("arm", request(Request::Arm { force: false })),
        ("ARM force", request(Request::Arm { force: true })),
        ("commander arm -f", request(Request::Arm { force: true })),
        ("disarm", request(Request::Disarm)),
        ("disarm force", Command::Kill),
        ("takeoff", request(Request::TakeOff { height_m: 2.5 })),
        ("commander takeoff", request(Request::TakeOff { height_m: 2.5 })),
        ("take-off 5", request(Request::TakeOff { height_m: 5.0 })),
        ("takeoff height=0.3", request(Request::TakeOff { height_m: 0.3 })),
        ("goto 1 -2 3", goto([Some(1.0), Some(-2.0), Some(3.0)], None)),
        ("goto 1 -2 3 90", goto([Some(1.0), Some(-2.0), Some(3.0)], Some(90.0))),
        ("goto 1 -2 up=3", goto([Some(1.0), Some(-2.0), Some(3.0)], None)),
        ("goto up=3 yaw=-90", goto([None, None, Some(3.0)], Some(-90.0))),
        ("velocity 1 0 0.5", request(Request::Velocity { velocity_m_s: [1.0, 0.0, 0.5], yaw_rate_rad_s: 0.0 })),
        ("hold", request(Request::Hold)),
        ("trajectory", request(Request::Follow)),
        ("rtl", request(Request::Return)),
        ("return", request(Request::Return)),
        ("land", request(Request::Land)),
        ("kill", Command::Kill),
        ("wind", Command::Wind),
        ("wind 3 -1", Command::SetWind([3.0, -1.0, 0.0])),
        ("wind 3 -1 0.5", Command::SetWind([3.0, -1.0, 0.5])),
        ("wind speed=0 from=0", Command::SetWind([0.0; 3])),
        ("fault gnss off", Command::Fault(Fault::starting(Some(Sensor::Gnss), Kind::Off {}, 1500))),
        ("faults", Command::Faults),
        ("clear", Command::Clear(None)),
        ("clear gps", Command::Clear(Some(Equipment::Sensor(Sensor::Gnss)))),
        ("failure gps ok", Command::Clear(Some(Equipment::Sensor(Sensor::Gnss)))),
        ("failure motor ok -i 2", Command::Clear(Some(Equipment::Rotors(Some(1))))),
        ("clear rotor index=3", Command::Clear(Some(Equipment::Rotors(Some(3))))),
        ("clear battery", Command::Clear(Some(Equipment::Sensor(Sensor::Battery)))),
        ("speed 10", Command::Speed(10.0)),
        ("quit  # and good night", Command::Quit),
    ] {
        assert_eq!(read(line), command, "{line}");
    }
    assert_eq!(parse("   ", 0).expect("nothing"), None);
    assert_eq!(parse("# arm", 0).expect("nothing"), None);
}

#[test]
fn wind_comes_from_where_forecasts_say() {
    // From the west it moves to the east: west is −5.
    for (from, velocity) in [(270.0, [0.0, -5.0]), (0.0, [-5.0, 0.0]), (90.0, [0.0, 5.0])] {
        let [north, west, up] = blowing(5.0, from);
        assert!((north - velocity[0]).abs() < 1e-12 && (west - velocity[1]).abs() < 1e-12, "{from}: {north} {west}");
        assert_eq!(up, 0.0);
    }
}

#[test]
fn mistakes_are_answered_in_a_line_that_says_what_to_type() {
    for (line, answer) in [
        ("takof 5", "unknown command `takof`: did you mean `takeoff`? `help` lists all"),
        ("lnad", "unknown command `lnad`: did you mean `land`? `help` lists all"),
        ("xyzzy", "unknown command `xyzzy`: `help` lists all"),
        ("help lnad", "help: unknown command `lnad`: did you mean `land`? `help` lists all"),
        ("help land now", "help: `now` is too much: type `help [COMMAND]`"),
        ("status now", "status: `now` is too much: type `status`"),
        ("arm now", "arm: `now` is unknown here: only `force` may follow"),
        ("arm force force", "arm: `force` is too much: type `arm [force]`"),
        ("disarm 1", "disarm: `1` is unknown here: only `force` may follow"),
        ("takeoff 200", "takeoff: HEIGHT must be between 0.3 and 100 m, not 200"),
        ("takeoff 0", "takeoff: HEIGHT must be between 0.3 and 100 m, not 0"),
        ("takeoff nan", "takeoff: HEIGHT must be between 0.3 and 100 m, not nan"),
        ("takeoff high", "takeoff: HEIGHT must be a number, not `high`"),
        ("takeoff 5 6", "takeoff: `6` is too much: type `takeoff [HEIGHT]`"),
        ("goto", "goto: NORTH, WEST and UP are missing: type `goto NORTH WEST UP [YAW]`"),
        ("goto 1", "goto: WEST and UP are missing: type `goto NORTH WEST UP [YAW]`"),
        ("goto 1 2", "goto: UP is missing: type `goto NORTH WEST UP [YAW]`"),
        ("goto 1 2 yaw=90", "goto: UP is missing: type `goto NORTH WEST UP [YAW]`"),
        ("goto 1 2 up", "goto: UP must be a number, not `up`"),
        ("goto 1 2 inf", "goto: UP must be between -10000 and 10000 m, not inf"),
        ("goto 1 2 up=", "goto: UP must be a number, not ``"),
        ("goto nrth=5", "goto: there is no `nrth`: did you mean `north`?"),
        ("goto 1 2 3 400", "goto: YAW must be between -360 and 360°, not 400"),
        ("goto 1 2 1e9", "goto: UP must be between -10000 and 10000 m, not 1e9"),
        ("goto 1 2 3 north=4", "goto: NORTH is given twice"),
        ("goto 1 2 3 4 5", "goto: `5` is too much: type `goto NORTH WEST UP [YAW]`"),
        ("velocity", "velocity: NORTH, WEST and UP are missing: type `velocity NORTH WEST UP [YAW_RATE]`"),
        ("velocity 1 2", "velocity: UP is missing: type `velocity NORTH WEST UP [YAW_RATE]`"),
        ("velocity 1 2 3 4 5", "velocity: `5` is too much: type `velocity NORTH WEST UP [YAW_RATE]`"),
        ("velocity 1000", "velocity: NORTH must be between -100 and 100 m/s, not 1000"),
        ("hold on", "hold: `on` is too much: type `hold`"),
        ("wind 3", "wind: say NORTH WEST [UP], or speed= and from="),
        ("wind speed=3", "wind: say NORTH WEST [UP], or speed= and from="),
        ("wind 1 2 speed=3 from=4", "wind: say NORTH WEST [UP], or speed= and from="),
        ("wind speed=-3 from=0", "wind: SPEED must be between 0 and 50 m/s, not -3"),
        ("fault", "fault: say how it fails: kind=off|stuck"),
        ("fault gns off", "fault: `gns` is no sensor and no kind of fault: did you mean `gnss`?"),
        ("fault gnss kind=of", "fault: there is no kind of fault `of`: did you mean `off`?"),
        ("trajectory 1", "trajectory: `1` is too much: type `trajectory`"),
        ("return home", "return: `home` is too much: type `return`"),
        ("land now", "land: `now` is too much: type `land`"),
        ("kill -9", "kill: `-9` is too much: type `kill`"),
        ("wind 1 2 3 4", "wind: say NORTH WEST [UP], or speed= and from="),
        ("wind 1 2 3 4 5 6", "wind: `6` is too much: type `wind [NORTH WEST [UP] or speed= from=]`"),
        ("wind north", "wind: NORTH must be a number, not `north`"),
        ("faults all", "faults: `all` is too much: type `faults`"),
        ("clear gnns", "clear: `gnns` is nothing that fails by itself: did you mean `gnss`?"),
        ("speed", "speed: X is missing: type `speed X`"),
        ("speed 1 2", "speed: `2` is too much: type `speed X`"),
        ("speed fast", "speed: X must be a number, not `fast`"),
        ("speed 0", "speed: X must be between 0.01 and 1000, not 0"),
        ("quit now", "quit: `now` is too much: type `quit`"),
    ] {
        let error = format!("{:#}", parse(line, 0).expect_err(line));
        assert!(error.starts_with(answer) && !error.contains('\n'), "{line}: {error}");
    }
}

#[test]
fn names_are_unique_and_help_gives_the_ranges_that_are_checked() {
    let mut names: Vec<&str> = COMMANDS.iter().flat_map(|entry| entry.names).copied().collect();
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count);
    let help = |name: &str| entry(name).expect("known").help();
    let heights = format!("between {} and {} m", TAKE_OFF_HEIGHTS_M.start(), TAKE_OFF_HEIGHTS_M.end());
    assert!(help("takeoff").contains(&heights), "{}", help("takeoff"));
    assert!(help("takeoff").contains(&format!("(m; {TAKE_OFF_HEIGHT_M})")));
    assert!(help("speed").contains(&format!("between {} and {}", SPEEDS.start(), SPEEDS.end())));
    assert!(help("rtl").starts_with("return: ") && help("rtl").ends_with("Also called rtl"), "{}", help("rtl"));
}

#[test]
fn the_help_of_a_velocity_names_its_limits() {
    let help = COMMANDS.iter().find(|entry| entry.name() == "velocity").map(Entry::help).unwrap_or_default();
    assert!(help.contains(&format!("At most {FASTEST_M_S} m/s along each axis and 360°/s,")), "{help}");
}

#[test]
fn the_manual_has_the_same_table() {
    let manual = include_str!("../../../../docs/serve.md");
    let section = manual.split("\n## ").find(|section| section.starts_with("Commands\n")).expect("it has commands");
    let rows: Vec<&str> = section.lines().filter(|line| line.starts_with("| `")).collect();
    let table: Vec<String> =
        COMMANDS.iter().map(|entry| format!("| `{}` | {} |", entry.usage(), entry.summary())).collect();
    assert_eq!(rows, table);
    let other_names = COMMANDS.iter().flat_map(|entry| &entry.names[1..]);
    for name in other_names {
        assert!(section.contains(&format!("`{name}`")), "{name}");
    }
}

#[test]
fn words_of_other_shells_are_answered_with_what_there_is_here() {
    for (line, answer) in [
        ("mode auto:loiter", "there is no `mode` here: a mode is a command: takeoff, hold, goto, "),
        ("commander mode auto:land", "there is no `mode` here: a mode is a command: takeoff, hold, goto, "),
        ("param set MPC_XY_VEL_MAX 5", "there is no `param` here: ground stations show and set parameters"),
        ("log list", "there is no `log` here: a flight without a pilot at the console is recorded: sim-host run"),
        ("yaw 90", "there is no `yaw` here: to turn, `goto yaw=90` (a heading, °) or `velocity yaw_rate=10`"),
        ("commander check", "there is no `check` here: `status` says whether it is ready to arm, and why not"),
    ] {
        let error = format!("{:#}", parse(line, 0).expect_err(line));
        assert!(error.starts_with(answer) && !error.contains('\n'), "{line}: {error}");
    }
    for line in ["takeoff", "hold", "goto 1 2 3", "velocity yaw_rate=10", "trajectory", "return", "land", "goto yaw=90"]
    {
        read(line);
    }
    assert!(ELSEWHERE.iter().all(|(word, _)| !COMMANDS.iter().any(|entry| entry.names.contains(word))));
}

#[test]
fn commands_are_found_by_how_they_begin() {
    let found = |word: &str| completions(word).collect::<Vec<_>>();
    assert_eq!(found("fau"), ["fault", "faults"]);
    assert_eq!(found("tak"), ["takeoff"]);
    assert!(found("x").is_empty());
    assert_eq!(found("").len(), COMMANDS.len());
}
