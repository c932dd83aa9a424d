//! How flights end, and what they leave: verdicts by the truth, folders that are whole, and Ctrl-C.

use std::fs::{self, File};
use std::io::Write as _;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use serde_json::Value;

use crate::common::folder::Folder;
use crate::common::load::load;

/// Starts a flight of a day, and waits until its truth.csv grows. No other run has begun in that folder.
fn flying(folder: &Folder, out: &str) -> Child {
    let child = folder.command(&["run", "day", "--out", out]).spawn().expect("the program starts");
    let truth = folder.0.join(format!(".{out}.1.partial/new/truth.csv"));
    while fs::metadata(&truth).map_or(0, |file| file.len()) < 1_000_000 {
        std::thread::sleep(Duration::from_millis(5));
    }
    child
}

#[test]
fn a_vehicle_too_heavy_to_fly_has_not_survived() {
    let folder = Folder::new("heavy");
    let heavy = ["run", "outdoor-tour", "--set", "truth.mass_factor=3", "--set", "duration_s=12"];
    let json = folder.json(&[&heavy[..], &["--json"]].concat());
    assert_eq!((&json["survived"], &json["end"]), (&false.into(), &"never-flew".into()));
    assert_eq!(json["mission"]["completed"], false);
    let text = folder.text(&heavy);
    assert!(text.contains("mission NOT completed\n  never flew"), "{text}");
    // 2 kg with rotors for twice the weight, at three times the mass.
    assert!(text.contains("its rotors give at most 39.2 N and it weighs 58.9 N: thrust-to-weight 0.67\n"), "{text}");
}

#[test]
fn a_hard_touchdown_is_a_crash_and_the_flight_goes_on() {
    let folder = Folder::new("crash");
    // With little left of its thrust from 15 s on, it falls from 20 m.
    let fall = ["run", "lost-rotor", "--set", "truth.mass_factor=1.0", "--set", "fault.0.from_s=20"];
    let fallen: Vec<&str> =
        [&fall[..], &["--set", "thrust_to_weight=1.6", "--set", "duration_s=40", "--json"]].concat();
    let json = folder.json(&fallen);
    assert_eq!((&json["survived"], &json["end"]), (&false.into(), &"crashed".into()), "{json}");
    assert!(
        json["crash"]["descent_m_s"].as_f64().expect("a speed") > 4.0 || json["crash"]["tilt_rad"].as_f64() > Some(1.0)
    );
    assert!(json["duration_s"].as_f64() > json["crash"]["t_s"].as_f64(), "it is simulated on");
}

#[test]
fn a_vehicle_that_stands_disarmed_is_not_lost() {
    let folder = Folder::new("parked");
    // Without an IMU the estimate runs away, and with it where guidance has the vehicle; or it begins elsewhere.
    let blind = "fault=[{sensor=\"imu\",kind=\"off\",from_s=3.0,to_s=13.0}]";
    let command = "command=[{at_s=20.0,order=\"arm\"}]";
    let far = "trajectory.figure-eight.center_m=[200.0,0.0,5.0]";
    for settings in [[blind, command], [far, "wind.mean_m_s.0=0.0"]] {
        let set = settings.map(|setting| ["--set", setting]).concat();
        let flight = [&["run", "field", "--seed", "2", "--set", "duration_s=25", "--json"], &set[..]].concat();
        let json = folder.json(&flight);
        assert_eq!((&json["end"], &json["duration_s"]), (&"never-flew".into(), &25.0.into()), "{settings:?}");
    }
}

#[test]
fn a_refused_command_is_told_as_refused_and_once() {
    // A place before take-off, and an arming that is repeated twice a second while there is no position.
    let command = "command=[{at_s=1.0,order=\"arm\"},{at_s=8.0,order={go-to={position_m=[8.0,0.0,5.0],yaw_deg=0.0}}},{at_s=8.5,order={take-off={height_m=2.0}}}]";
    let fault = "fault=[{sensor=\"gnss\",kind=\"off\",from_s=0.2,to_s=4.0}]";
    let flight = ["run", "path", "--set", command, "--set", fault, "--set", "duration_s=14"];
    let text = Folder::new("refused").text(&flight);
    assert!(text.contains("`go-to 8, 0, 5 m` refused: ") && !text.contains("missed by"), "{text}");
    assert!(!text.contains("m from go-to"), "{text}");
    assert_eq!(text.matches("Arming refused: no valid position estimate").count(), 1, "{text}");
}

#[test]
fn a_push_is_an_event() {
    let flight = ["run", "twist", "--set", "push.0.from_s=5.0", "--set", "push.0.to_s=6.0", "--set", "duration_s=8"];
    let text = Folder::new("push").text(&flight);
    let events = "     5.0 s  push: 40 rad/s² about roll\n     6.0 s  push ends: 40 rad/s² about roll\n";
    assert!(text.contains(events), "{text}");
}

#[test]
fn a_whole_tour_is_a_completed_mission() {
    let json = Folder::new("tour").json(&["run", "outdoor-tour", "--json"]);
    assert_eq!((&json["mission"]["completed"], &json["survived"]), (&true.into(), &true.into()));
    let names: Vec<&str> =
        json["phases"].as_array().expect("phases").iter().filter_map(|p| p["name"].as_str()).collect();
    let expected = ["before arming", "armed", "take-off", "hold", "go-to 1", "go-to 2", "go-to 3", "go-to 4", "join"];
    assert_eq!(names[..9], expected);
    assert_eq!(names[9..], ["trajectory", "return", "land", "landed", "disarmed"]);
    assert!(json["touchdown"]["from_start_m"].as_f64() < Some(3.0));
}

#[test]
fn a_second_flight_is_told_as_the_first() {
    let climb = "order={take-off={height_m=3.0}}";
    let flight = |at: u32| {
        let (up, down) = (at + 2, at + 9);
        format!("{{at_s={at}.0,order=\"arm\"}},{{at_s={up}.0,{climb}}},{{at_s={down}.0,order=\"land\"}}")
    };
    let command = format!("command=[{},{}]", flight(3), flight(40));
    let folder = Folder::new("twice");
    let twice = ["run", "outdoor-hover", "--set", &command, "--set", "duration_s=60", "--out", "out"];
    let text = folder.text(&twice);
    assert!(text.contains("mission completed"), "{text}");
    let (_, again) = text.split_once("last at ").expect("both touchdowns are told");
    assert!(again.split_once(" s, with ").and_then(|(t, _)| t.parse::<f64>().ok()) > Some(49.0), "{text}");
    let summary = fs::read_to_string(folder.0.join("out/summary.json")).expect("it is there");
    let summary: Value = serde_json::from_str(&summary).expect("JSON");
    let phases = summary["phases"].as_array().expect("phases");
    let names: Vec<&str> = phases.iter().filter_map(|phase| phase["name"].as_str()).collect();
    let flown = ["armed", "take-off", "hold", "land", "landed", "disarmed"];
    assert_eq!(names, [&["before arming"], &flown[..], &flown[..]].concat());
}

#[test]
fn a_lost_receiver_is_told_with_what_the_vehicle_did() {
    let text = Folder::new("gnss").text(&["run", "path-gnss-lost", "--set", "duration_s=50"]);
    let order =
        ["mission NOT completed", "Position estimate lost: descending at", "landed at", "fault: gnss off", "touchdown"];
    let places: Vec<_> =
        order.iter().map(|words| text.find(words).unwrap_or_else(|| panic!("{words}: {text}"))).collect();
    assert!(places.is_sorted(), "{text}");
    assert!(!text.contains("never") && !text.contains('\x1b'), "{text}");
}

#[test]
fn a_folder_flies_again_by_itself() {
    let folder = Folder::new("again");
    let settings = ["--set", "duration_s=2", "--set", "airframe.mass_kg=0.9", "--set", "control.x.gain=18"];
    let first = folder.json(&[&["run", "helix", "--seed", "3", "--out", "out", "--json"], &settings[..]].concat());
    let again = folder.json(&["run", "out/scenario.toml", "--seed", "3", "--json"]);
    assert_eq!(again["truth_sha256"], first["truth_sha256"]);
    let provenance = fs::read_to_string(folder.0.join("out/provenance.toml")).expect("it is there");
    assert!(provenance.contains("airframe.mass_kg=0.9") && provenance.contains("seed = 3"), "{provenance}");
    assert!(provenance.contains(env!("CARGO_PKG_VERSION")), "{provenance}");
}

#[test]
fn a_folder_that_is_flown_over_keeps_how_the_flight_came_about() {
    let folder = Folder::new("over");
    folder.json(&["run", "helix", "--seed", "3", "--set", "duration_s=0.5", "--out", "out", "--json"]);
    let provenance = || fs::read_to_string(folder.0.join("out/provenance.toml")).expect("it is there");
    let first: toml::Table = provenance().parse().expect("TOML");
    folder.json(&["run", "out/scenario.toml", "--seed", "4", "--out", "out", "--json"]);
    let second: toml::Table = provenance().parse().expect("TOML");
    assert_eq!((second["seed"].as_integer(), second["set"].as_array().map(Vec::len)), (Some(4), Some(0)));
    assert_eq!(second["from"].as_table(), Some(&first));
}

#[test]
fn a_killed_run_leaves_the_folder_of_the_flight_before() {
    let folder = Folder::new("killed");
    folder.json(&["run", "step", "--set", "duration_s=1", "--out", "out", "--json"]);
    let whole = fs::read(folder.0.join("out/truth.csv")).expect("it is there");
    let mut child = flying(&folder, "out");
    child.kill().and_then(|()| child.wait()).expect("it can be killed");
    assert!(fs::read(folder.0.join("out/truth.csv")).expect("it is still there") == whole);
    folder.json(&["run", "step", "--set", "duration_s=2", "--out", "out", "--json"]);
    assert_eq!(fs::read_to_string(folder.0.join("out/truth.csv")).expect("it is there").lines().count(), 1 + 2000);
    assert_eq!(folder.names(), ["out"]);
    assert!(!folder.0.join("out/estimate.csv").exists());
}

/// Sends a signal to the program.
fn signal(child: &Child, name: &str) {
    let status = Command::new("kill").args([format!("-{name}"), child.id().to_string()]).status();
    assert!(status.expect("kill is there").success());
}

#[test]
fn an_interrupted_flight_keeps_what_was_flown() {
    let folder = Folder::new("interrupted");
    let child = flying(&folder, "out");
    signal(&child, "INT");
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(130));
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    assert!(text.contains("mission NOT completed\n  interrupted at") && text.contains("wrote out:"), "{text}");
    let summary = fs::read_to_string(folder.0.join("out/summary.json")).expect("it is there");
    let summary: Value = serde_json::from_str(&summary).expect("JSON");
    assert_eq!(summary["end"], "interrupted");
    let truth = fs::read_to_string(folder.0.join("out/truth.csv")).expect("it is there");
    let rows = truth.lines().count() - 1;
    assert_eq!(Some(rows as f64 / 1e3), summary["duration_s"].as_f64());
    assert!(truth.ends_with('\n'), "the last row is whole");
}

#[test]
fn a_flight_ended_by_the_system_says_so_in_its_exit_code() {
    // 128 + the signal.
    for (name, code) in [("TERM", 143), ("HUP", 129), ("QUIT", 131)] {
        let folder = Folder::new("terminated");
        let child = flying(&folder, "out");
        signal(&child, name);
        assert_eq!(child.wait_with_output().expect("it ends").status.code(), Some(code));
        assert_eq!(folder.names(), ["out"]);
    }
}

#[test]
fn a_command_that_reports_nothing_half_done_leaves_nothing() {
    let folder = Folder::new("study");
    let child = folder.command(&["compare", "x500", "--out", "out"]).spawn().expect("the program starts");
    while folder.names().is_empty() {
        std::thread::sleep(Duration::from_millis(5));
    }
    signal(&child, "INT");
    assert_eq!(child.wait_with_output().expect("it ends").status.code(), Some(130));
    assert_eq!(folder.names(), [""; 0]);
}

#[test]
fn what_flies_ends_as_it_should_when_nothing_can_be_printed() {
    let folder = Folder::new("mute");
    for full in [false, true] {
        let (listen, file) = (["--listen", "127.0.0.1:0", "--peer", "127.0.0.1:9"], format!("{full}.txt"));
        let mut command = folder.command(&[&["serve"], &listen[..], &["--record", &file]].concat());
        let error = if full { Stdio::from(File::create("/dev/full").expect("there")) } else { Stdio::piped() };
        let mut child = command.stdin(Stdio::piped()).stderr(error).spawn().expect("the program starts");
        // Nobody reads it.
        drop(child.stderr.take());
        child.stdin.take().expect("piped").write_all(b"quit\n").expect("it reads");
        assert_eq!(child.wait_with_output().expect("it ends").status.code(), Some(0));
        assert!(fs::read_to_string(folder.0.join(&file)).expect("there").ends_with(" end\n"));
    }
}

#[test]
fn two_flights_into_one_folder_leave_one_of_them_whole() {
    let folder = Folder::new("two");
    let fly = |seconds: &str| {
        let duration = format!("duration_s={seconds}");
        folder.command(&["run", "step", "--set", &duration, "--out", "out", "--json"]).spawn().expect("it starts")
    };
    let ends: Vec<_> =
        [fly("20"), fly("21")].into_iter().map(|child| child.wait_with_output().expect("it ends")).collect();
    assert!(ends.iter().all(|output| output.status.success()), "{ends:?}");
    assert_eq!(folder.names(), ["out"]);
    let summary: Value =
        serde_json::from_slice(&fs::read(folder.0.join("out/summary.json")).expect("it is there")).expect("JSON");
    let rows = fs::read_to_string(folder.0.join("out/truth.csv")).expect("it is there").lines().count() - 1;
    assert_eq!(Some(rows as f64 / 1e3), summary["duration_s"].as_f64());
}

#[test]
fn a_trajectory_that_nothing_can_follow_is_named_as_the_reason() {
    let reason = |name: &str, settings: &[&str]| load(name, settings).beyond_reach().unwrap_or_default();
    // 2 m at 6 rad/s: 72 m/s² sideways, 72.7 with the weight; a thrust-to-weight ratio of 2 gives 19.6.
    let fast = reason("helix", &["trajectory.helix.amplitude_m=[2.0,2.0]", "trajectory.helix.rate_rad_s=6.0"]);
    assert_eq!(fast, "its trajectory takes 72.7 m/s² of thrust, and the rotors give 19.6 at most");
    let steep =
        reason("x500-helix", &["trajectory.helix.rate_rad_s=2.2", "thrust_to_weight=50.0", "smc.tilt_max_rad=0.3"]);
    assert!(steep.ends_with("and `tilt_max_rad` is 17°"), "{steep}");
    assert!(["helix", "x500-helix", "figure-eight", "x500-eight"].iter().all(|name| reason(name, &[]).is_empty()));
}
