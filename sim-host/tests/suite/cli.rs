//! The command line as scripts use it: JSON with the documented keys, and bad input in one line with exit code 2.

use std::fs;
use std::net::UdpSocket;

use serde_json::Value;

use crate::common::folder::Folder;

const HELIX: &str = include_str!("../../scenarios/helix.toml");
const AIRFRAME: &str = include_str!("../../airframes/paper.toml");

#[test]
fn unknown_names_are_refused() {
    let folder = Folder::new("names");
    folder.refuses(&["run", "helicks"], &["helicks"]);
    folder.refuses(&["run", "helix", "--set", "airframe=papper"], &["papper"]);
    folder.refuses(&["serve", "padd"], &["padd"]);
    folder.refuses(&["plan", "helicks"], &["helicks"]);
    folder.refuses(&["run", "helix", "--colour"], &["--colour"]);
    folder.refuses(&["run"], &["SCENARIO"]);
    folder.refuses(&["fly", "helix"], &["fly"]);
    folder.refuses(&["run", "helix", "extra"], &["extra"]);
}

#[test]
fn bad_values_of_options_are_refused() {
    let folder = Folder::new("options");
    for bad in ["8..1", "1", "one..two", "1..99999999999"] {
        folder.refuses(&["run", "helix", "--seeds", bad], &["--seeds"]);
    }
    folder.refuses(&["run", "helix", "--seed", "-1"], &["-1"]);
    folder.refuses(&["run", "helix", "--seed", "1", "--seeds", "1..2"], &["--seed"]);
    folder.refuses(&["run", "helix", "--seeds", "1..2", "--jobs", "0"], &["--jobs"]);
    folder.refuses(&["run", "helix", "--seeds", "1..2", "--jobs", "many"], &["--jobs"]);
    folder.refuses(&["run", "helix", "--set", "duration_s"], &["duration_s"]);
    folder.refuses(&["run", "helix", "--set", "colour=1"], &["colour"]);
    folder.refuses(&["run", "helix", "--set", "duration_s=-1"], &["duration_s"]);
    folder.refuses(&["run", "helix", "--set", "duration_s=nan"], &["duration_s"]);
    folder.refuses(&["run", "helix", "--set", "airframe.mass_kg=-1"], &["mass_kg"]);
    folder.refuses(&["serve", "--listen", "nowhere"], &["--listen"]);
    folder.refuses(&["serve", "--speed", "0"], &["speed"]);
    folder.refuses(&["serve", "paper-ideal"], &["paper-ideal"]);
    folder.refuses(&["bench", "--runs", "0"], &["--runs"]);
    folder.refuses(&["bench", "--seconds", "nan"], &["--seconds"]);
}

#[test]
fn hands_that_there_are_not_are_refused() {
    let folder = Folder::new("hands");
    folder.refuses(&["serve", "--keys"], &["--keys", "terminal", "leave it out"]);
    folder.refuses(&["serve", "--keys", "--joystick"], &["--keys", "--joystick"]);
    folder.refuses(&["serve", "--joystick-axes", "x,y,rx,ry"], &["--joystick"]);
    folder.refuses(&["serve", "--joystick", "--joystick-axes", "-x,y"], &["--joystick-axes", "-x,y", "four"]);
    folder.refuses(&["serve", "--joystick", "--joystick-axes", "x,y,rx,x"], &["axis x", "twice"]);
    if cfg!(target_os = "linux") {
        folder.refuses(&["serve", "--joystick", "no such pad"], &["--joystick", "`no such pad`", "--keys"]);
        folder.refuses(&["serve", "--joystick", "/dev/null"], &["/dev/null", "no input device"]);
        folder.refuses(&["serve", "--record", "kept", "--joystick", "/gone"], &["/gone", "not there"]);
        assert!(folder.names().is_empty(), "no recording is begun");
    } else {
        folder.refuses(&["serve", "--joystick"], &["--joystick", "Linux", "--keys"]);
    }
}

/// helix.toml with `from` replaced, which must be there.
fn spoilt(from: &str, to: &str) -> String {
    assert!(HELIX.contains(from), "{from}");
    HELIX.replacen(from, to, 1)
}

#[test]
fn spoilt_scenario_files_are_refused() {
    let folder = Folder::new("files");
    let cases = [
        ("nan", spoilt("climb_m_s = 1.0", "climb_m_s = nan"), "trajectory.helix"),
        ("infinite", spoilt("duration_s = 20.0", "duration_s = inf"), "duration_s"),
        ("unknown", spoilt("[control]", "[control]\ncolour = 1"), "colour"),
        ("unknown-top", spoilt("plant =", "colour = 1\nplant ="), "colour"),
        ("type", spoilt("duration_s = 20.0", "duration_s = \"soon\""), "duration_s"),
        ("plant", spoilt("plant = \"rigid-body\"", "plant = \"rubber-body\""), "rubber-body"),
        ("missing", spoilt("duration_s = 20.0", ""), "duration_s"),
        ("gain", spoilt("lambda = 30.0", "lambda = -30.0"), "roll"),
        ("horizon", spoilt("horizon_s = 0.005", "horizon_s = 0.0"), "roll"),
        ("tilt", spoilt("tilt_max_rad = 1.3", "tilt_max_rad = 3.0"), "tilt_max_rad"),
        ("join", spoilt("duration_s = 1.", "duration_s = -1."), "join"),
        ("start", spoilt("plant =", "start_position_m = [0.0, nan, 0.0]\nplant ="), "start_position_m"),
        ("syntax", spoilt("[control]", "[control"), "line"),
        ("empty", String::new(), "missing"),
        ("ratio", spoilt("thrust_to_weight = 2.0", "thrust_to_weight = nan"), "thrust_to_weight"),
    ];
    for (name, text, culprit) in cases {
        let path = folder.file(&format!("{name}.toml"), &text);
        folder.refuses(&["run", &path], &[culprit]);
        folder.refuses(&["run", &path], &[name]);
    }
    fs::write(folder.0.join("bytes.toml"), [0xff, 0xfe, 0x00]).expect("can be written");
    folder.refuses(&["run", "./bytes.toml"], &["bytes.toml"]);
    folder.refuses(&["run", "./gone.toml"], &["gone.toml"]);
    let directory = folder.0.join("folder.toml");
    fs::create_dir(&directory).expect("can be made");
    folder.refuses(&["run", "./folder.toml"], &["folder.toml"]);
}

#[test]
fn spoilt_airframe_files_are_refused() {
    let folder = Folder::new("airframes");
    let cases = [
        ("mass_kg = 0.823", "mass_kg = -0.823", "mass_kg"),
        ("mass_kg = 0.823", "mass_kg = nan", "mass_kg"),
        ("0.5e-2, 0.1e-2]", "0.0, 0.1e-2]", "inertia_kg_m2"),
        ("rotor_lag_s = 0.0", "rotor_lag_s = -0.1", "rotor_lag_s"),
        ("drag_n_s_m = [0.3729", "drag_n_s_m = [-1.0", "drag_n_s_m"),
        ("yaw_n_m_s2 = 33e-6", "yaw_n_m_s2 = nan", "rotors.0.yaw_n_m_s2"),
        ("x_m = 0.350", "x_m = inf", "rotors.0.x_m"),
        ("lift_n_s2 = 29.8e-4", "lift_n_s2 = 0.0", "lift_n_s2"),
        ("summary =", "colour = 1\nsummary =", "colour"),
    ];
    for (from, to, culprit) in cases {
        assert!(AIRFRAME.contains(from), "{from}");
        let airframe = folder.file("airframe.toml", AIRFRAME.replacen(from, to, 1));
        let scenario = folder.file("scenario.toml", spoilt("plant =", &format!("airframe = '{airframe}'\nplant =")));
        folder.refuses(&["run", &scenario], &[culprit]);
    }
    // Four rotors that all push the same way cannot yaw independently of thrust.
    let airframe = folder.file("airframe.toml", AIRFRAME.replace("= -33e-6", "= 33e-6"));
    let scenario = folder.file("scenario.toml", spoilt("plant =", &format!("airframe = '{airframe}'\nplant =")));
    folder.refuses(&["run", &scenario], &["rotors"]);
}

#[test]
fn an_output_that_cannot_be_written_is_named() {
    let folder = Folder::new("out");
    folder.file("taken", "");
    folder.refuses(&["run", "helix", "--set", "duration_s=1", "--out", "taken"], &["taken"]);
    folder.refuses(&["run", "helix", "--set", "duration_s=1", "--out", "taken/below"], &["taken"]);
    fs::create_dir_all(folder.0.join("here/truth.csv")).expect("can be made");
    folder.refuses(&["run", "helix", "--set", "duration_s=1", "--out", "here"], &["truth.csv"]);
}

#[test]
fn a_busy_port_is_named() {
    let folder = Folder::new("port");
    let socket = UdpSocket::bind("127.0.0.1:0").expect("a free port");
    let address = socket.local_addr().expect("bound").to_string();
    folder.refuses(&["serve", "--listen", &address], &[&address]);
}

const NULLABLE: [&str; 5] = ["settle_5cm_s", "settle_2mm_s", "rms_m", "max_m", "overshoot"];

fn assert_documented(summary: &Value) {
    assert!(summary["scenario"].is_string() && summary["seed"].is_u64() && summary["survived"].is_boolean());
    let hash = summary["truth_sha256"].as_str().expect("a hash");
    assert!(hash.len() == 64 && hash.bytes().all(|b| b.is_ascii_hexdigit()), "{hash}");
    for key in ["duration_s", "real_time_factor", "chattering", "saturated_fraction"] {
        assert!(summary[key].is_f64(), "{key}: {}", summary[key]);
    }
    for axis in ["x", "y", "z", "yaw"] {
        let axis = summary["axes"][axis].as_object().expect("an object an axis");
        assert!(NULLABLE.iter().all(|key| axis.get(*key).is_some_and(|v| v.is_f64() || v.is_null())), "{axis:?}");
    }
    assert!(summary.as_object().expect("an object").contains_key("time_optimal_s"));
}

#[test]
fn json_is_one_object_or_one_array_with_the_documented_keys() {
    let folder = Folder::new("json");
    let one: Value =
        serde_json::from_str(&folder.succeeds(&["run", "helix", "--set", "duration_s=5", "--seed", "3", "--json"]))
            .expect("one JSON value and nothing else");
    assert_documented(&one);
    assert_eq!((&one["scenario"], &one["seed"], &one["duration_s"]), (&"helix".into(), &3.into(), &5.0.into()));
    assert_eq!(one["time_optimal_s"], 1.31);
    let many: Value =
        serde_json::from_str(&folder.succeeds(&["run", "helix", "--set", "duration_s=1", "--seeds", "4..6", "--json"]))
            .expect("one JSON value and nothing else");
    let many = many.as_array().expect("an array");
    many.iter().for_each(assert_documented);
    assert_eq!(many.iter().map(|s| s["seed"].as_u64()).collect::<Vec<_>>(), [Some(4), Some(5), Some(6)]);
}

#[test]
fn a_file_s_path_and_settings_work_from_any_folder() {
    let folder = Folder::new("path");
    folder.file("mine.toml", HELIX);
    folder.file("heavy.toml", AIRFRAME.replace("0.823", "1.0"));
    let text = folder.succeeds(&["run", "./mine.toml", "--set", "duration_s=2", "--out", "out/deep", "--json"]);
    let summary: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(summary["duration_s"], 2.0);
    let truth = fs::read_to_string(folder.0.join("out/deep/truth.csv")).expect("truth.csv is there");
    assert_eq!(truth.lines().count(), 1 + 2000);
    let file = fs::read_to_string(folder.0.join("out/deep/summary.json")).expect("summary.json is there");
    let file: Value = serde_json::from_str(&file).expect("JSON");
    assert_eq!(file["truth_sha256"], summary["truth_sha256"]);

    let other =
        folder.succeeds(&["run", "mine.toml", "--set", "duration_s=2", "--set", "airframe=heavy.toml", "--json"]);
    let other: Value = serde_json::from_str(&other).expect("JSON");
    assert_ne!(other["truth_sha256"], summary["truth_sha256"], "another airframe, another flight");
}

#[test]
fn scenarios_lists_what_can_be_flown() {
    let folder = Folder::new("list");
    let text = folder.succeeds(&["scenarios"]);
    let list: Value = serde_json::from_str(&folder.succeeds(&["scenarios", "--json"])).expect("JSON");
    let names: Vec<&str> = list.as_array().expect("an array").iter().filter_map(|s| s["name"].as_str()).collect();
    for name in ["helix", "helix-tw4", "helix-lag", "paper-ideal", "paper-attitude", "paper-disturbed", "outdoor-tour"]
    {
        assert!(names.contains(&name) && text.lines().any(|line| line.trim_start().starts_with(name)), "{name}");
    }
    let groups: std::collections::BTreeSet<_> =
        list.as_array().expect("an array").iter().filter_map(|s| s["group"].as_str()).collect();
    assert_eq!(groups, ["ideal-state", "on-sensors", "paper"].into());
}

#[test]
fn a_flight_on_sensors_leaves_what_was_believed() {
    let folder = Folder::new("sensors");
    let text = folder.succeeds(&["run", "outdoor-tour", "--set", "duration_s=6", "--out", "out", "--json"]);
    let summary: Value = serde_json::from_str(&text).expect("JSON");
    assert_documented(&summary);
    assert!(summary["touchdown"].is_null() && summary["disarmed_s"].is_null());
    // Degrees and metres: a filter that has gone astray is off by far more.
    let known = |key: &str| summary["estimate"][key].as_f64().expect(key);
    assert!(known("tilt_rms_rad") < 0.02 && known("heading_rms_rad") < 0.1 && known("position_rms_m") < 1.0);
    let estimate = fs::read_to_string(folder.0.join("out/estimate.csv")).expect("estimate.csv is there");
    assert_eq!(estimate.lines().count(), 1 + 6000 / 20);
    assert!(estimate.contains(",take-off,1,"), "it has taken off");
    for figure in ["flight", "estimate-position", "estimate-attitude", "innovations"] {
        assert!(folder.0.join(format!("out/{figure}.svg")).is_file(), "{figure}");
    }
    let ideal = folder.succeeds(&["run", "helix", "--set", "duration_s=1", "--out", "ideal", "--json"]);
    let ideal: Value = serde_json::from_str(&ideal).expect("JSON");
    assert!(["estimate", "touchdown", "disarmed_s"].iter().all(|key| ideal.get(key).is_none()));
    assert!(!folder.0.join("ideal/estimate.csv").exists());
}

#[test]
fn help_and_version_are_results() {
    let folder = Folder::new("help");
    assert!(folder.succeeds(&["--help"]).contains("scenarios"));
    assert!(folder.succeeds(&["run", "--help"]).contains("--seeds"));
    assert!(folder.succeeds(&["--version"]).contains(env!("CARGO_PKG_VERSION")));
}

/// Three cells: one in which nothing is random, one that is, and one that loses a rotor and so the vehicle.
const MATRIX: &str = r#"
summary = "a small one"
controllers = ["stiff.toml", "soft.toml"]
scenarios = ["hover"]
seeds = "101..106"
training_seeds = "1..4"

[[disturbances]]
name = "none"
set = []

[[disturbances]]
name = "gusts"
set = ["wind={mean_m_s=[3.0,0.0,0.0],turbulence_20ft_m_s=15.0}"]

[[disturbances]]
name = "three-rotors"
set = ["truth.rotor_effectiveness=[0.0,1.0,1.0,1.0]"]
"#;

/// Gains of helix.toml as a tuning file, those of the position divided by `softness`.
fn tuning(softness: f64) -> String {
    let (_, gains) = HELIX.split_once("[control]").expect("gains by the sliding mode laws");
    let gain = format!("lambda = {:.2}", 4.0 / softness);
    format!("summary = \"of a test\"\n[smc]{}", gains.replace("lambda = 4.0", &gain))
}

/// A folder with the matrix and its two controllers.
fn compared(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.file("matrix.toml", MATRIX);
    folder.file("stiff.toml", tuning(1.0));
    folder.file("soft.toml", tuning(2.0));
    folder
}

#[test]
fn a_comparison_is_the_same_whatever_the_threads() {
    let folder = compared("threads");
    let files = |jobs: &str| {
        folder.succeeds(&["compare", "matrix.toml", "--jobs", jobs, "--out", jobs]);
        let names = ["json", "csv", "md"].map(|kind| format!("compare.{kind}"));
        let figures = ["rms", "ratio", "survival"].map(|figure| format!("compare-{figure}.svg"));
        let read = |name: &String| fs::read(folder.0.join(jobs).join(name)).expect("the file was written");
        names.iter().chain(&figures).map(read).collect::<Vec<_>>()
    };
    assert!(files("1") == files("4"));
}

#[test]
fn a_comparison_says_who_is_better_and_who_is_lost() {
    let folder = compared("compare");
    let text = folder.succeeds(&["compare", "matrix.toml", "--json"]);
    let found: Value = serde_json::from_str(&text).expect("one JSON value and nothing else");
    assert_eq!(found["controllers"], serde_json::json!(["stiff", "soft"]));
    let [calm, gusts, broken] = found["cells"].as_array().expect("cells").as_slice() else { panic!("{text}") };
    assert_eq!((&calm["random"], &calm["controllers"][0]["flights"]), (&false.into(), &1.into()));
    assert_eq!((&gusts["random"], &gusts["controllers"][0]["flights"]), (&true.into(), &6.into()));
    // With half the bandwidth the same gust moves the vehicle further, under every seed.
    let ratio = &gusts["rms_ratios"][1];
    assert!(ratio["median"].as_f64() > Some(1.2) && ratio["interval"][0].as_f64() > Some(1.0), "{ratio}");
    assert_eq!((&broken["controllers"][0]["survived"], &broken["controllers"][0]["flights"]), (&0.into(), &1.into()));
    assert_eq!(broken["controllers"][0]["rms_m"]["median"], Value::Null);
    assert_eq!(found["lost"], serde_json::json!([]));

    let swapped = folder.succeeds(&["compare", "matrix.toml", "--controllers", "soft.toml,stiff.toml"]);
    assert!(swapped.contains("lost: hover under gusts to stiff") && swapped.contains("lost 0/1"), "{swapped}");
    assert!(swapped.lines().all(|line| line.chars().count() <= 120), "{swapped}");
}

#[test]
fn a_comparison_can_be_narrowed() {
    let folder = compared("narrow");
    let arguments = ["compare", "matrix.toml", "--disturbances", "gusts", "--seeds", "3..5", "--set", "duration_s=1"];
    let text = folder.succeeds(&[&arguments[..], &["--controllers", "stiff.toml", "--out", "out"]].concat());
    assert!(text.contains("TUNED ON"), "seeds 3 and 4 are for training: {text}");
    let csv = fs::read_to_string(folder.0.join("out/compare.csv")).expect("the file was written");
    let rows: Vec<&str> = csv.lines().skip(1).collect();
    assert!(rows.len() == 3 && rows.iter().all(|row| row.starts_with("hover,gusts,stiff,")), "{csv}");
}

#[test]
fn a_comparison_leaves_what_it_was_flown_with() {
    let folder = compared("left");
    let flown = ["--scenarios", "hover", "--disturbances", "none", "--set", "duration_s=1", "--out", "out"];
    let text = folder.succeeds(&[&["compare", "matrix.toml"], &flown[..]].concat());
    assert!(text.contains("\nevery scenario with duration_s=1\n2 flights"), "{text}");
    let read = |name: &str| fs::read_to_string(folder.0.join("out").join(name)).expect("the file was written");
    let provenance: toml::Table = read("provenance.toml").parse().expect("TOML");
    let expected = "program = 'sim-host'\nmatrix = 'matrix.toml'\nset = ['duration_s=1']\nseeds = '101..106'\n\
                    controllers = ['stiff.toml', 'soft.toml']\nagain = 'sim-host compare matrix.toml'";
    let mut expected: toml::Table = expected.parse().expect("TOML");
    expected.insert("version".into(), env!("CARGO_PKG_VERSION").into());
    assert_eq!(provenance, expected);
    assert!(text.contains("\n1 of 3 cells; `ratio`"), "{text}");
    // The copies are whole: the same again, over the folder from which they are read, with what they were made of gone.
    let flights = read("compare.csv");
    for gone in ["stiff.toml", "soft.toml", "matrix.toml"] {
        fs::remove_file(folder.0.join(gone)).expect("it is there");
    }
    folder.succeeds(&["compare", "out/matrix.toml", "--out", "out"]);
    assert_eq!(read("compare.csv"), flights);
}

#[test]
fn a_comparison_on_an_airframe_of_one_s_own_needs_no_gains_but_its_controllers() {
    let folder = compared("airframe");
    let x500 = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/airframes/x500.toml")).expect("there");
    fs::write(folder.0.join("heavy.toml"), x500.replace("mass_kg = 2.0", "mass_kg = 2.2")).expect("can be written");
    let hold = "trajectory = { hold = { position_m = [0.0, 0.0, 2.0], yaw_rad = 0.0 } }";
    folder.file("ring.toml", format!("airframe = \"heavy.toml\"\nduration_s = 2.0\n{hold}\n"));
    folder.file("own.toml", MATRIX.replace("\"hover\"", "\"ring.toml\""));
    let by_setting = ["compare", "matrix.toml", "--set", "airframe=heavy.toml"];
    for (out, command) in [("by-setting", &by_setting[..]), ("by-scenario", &["compare", "own.toml"])] {
        folder.succeeds(&[command, &["--disturbances", "none", "--out", out]].concat());
    }
    let read = |out: &str| fs::read_to_string(folder.0.join(out).join("compare.csv")).expect("the file was written");
    let flights = ["by-setting", "by-scenario"].map(read);
    assert!(flights[1].contains("\nring,none,stiff,"), "{}", flights[1]);
    for gone in ["heavy.toml", "ring.toml"] {
        fs::remove_file(folder.0.join(gone)).expect("it is there");
    }
    for (out, flights) in ["by-setting", "by-scenario"].into_iter().zip(flights) {
        folder.succeeds(&["compare", &format!("{out}/matrix.toml"), "--out", out]);
        assert_eq!(read(out), flights, "{out}");
    }
}

#[test]
fn gains_that_a_comparison_would_not_fly_are_refused() {
    let folder = compared("gains");
    for setting in ["control.x.lambda=1", "smc.x.lambda=1", "pid.tilt_max_rad=1", "tuning=soft.toml"] {
        let expected = format!(
            "--set {setting}: a comparison flies the gains of its tunings: write a tuning file and name it in --controllers"
        );
        folder.refuses(&["compare", "matrix.toml", "--set", setting], &[&expected]);
    }
}

#[test]
fn a_comparison_on_seeds_of_the_tuning_says_so_and_flies_again_from_its_folder() {
    let folder = compared("trained");
    folder.file("trained.toml", MATRIX.replacen("1..4", "100..101", 1));
    let (first, _) = folder.prints(&["compare", "trained.toml", "--out", "flown"]);
    let (again, _) = folder.prints(&["compare", "flown/matrix.toml"]);
    for text in [first, again] {
        assert!(text.contains("SOME OF THEM TUNED ON"), "{text}");
    }
}

#[test]
fn a_comparison_of_what_is_not_there_is_refused() {
    let folder = compared("refused");
    folder.refuses(&["compare", "x600"], &["x600"]);
    folder.refuses(&["compare", "matrix.toml", "--controllers", "stiff.toml,x500-lqr"], &["x500-lqr"]);
    folder.refuses(&["compare", "matrix.toml", "--controllers", "gone.toml"], &["gone.toml"]);
    folder.refuses(&["compare", "matrix.toml", "--scenarios", "hovver"], &["hovver"]);
    folder.refuses(&["compare", "matrix.toml", "--disturbances", "gusts,rain"], &["rain"]);
    folder.refuses(&["compare", "matrix.toml", "--jobs", "0"], &["--jobs"]);
    folder.refuses(&["compare", "matrix.toml", "--seeds", "2..1"], &["--seeds"]);
    for (from, to, culprit) in [
        ("101..106", "106", "seeds"),
        ("soft.toml", "stiff.toml", "twice"),
        ("soft.toml", "lost.toml", "lost.toml"),
        ("\"hover\"", "", "scenarios"),
        ("mean_m_s", "median_m_s", "gusts"),
        ("set = []", "set = []\nexcept = [\"helix\"]", "helix"),
        ("summary", "colour = 1\nsummary", "colour"),
        (
            "set = []",
            "set = [\"tuning=x500-pid\"]",
            "disturbance `none`: `set` has tuning=x500-pid: a comparison flies",
        ),
    ] {
        assert!(MATRIX.contains(from), "{from}");
        folder.file("spoilt.toml", MATRIX.replacen(from, to, 1));
        folder.refuses(&["compare", "spoilt.toml"], &[culprit]);
    }
}

#[test]
fn a_vehicle_too_heavy_to_fly_has_not_survived() {
    let settings = ["truth.mass_factor=2.2", "duration_s=20", "assess.from_s=5", "assess.to_s=15"];
    let settings = settings.iter().flat_map(|setting| ["--set", setting]);
    let arguments: Vec<&str> =
        ["assess", "outdoor-hover", "--seeds", "1..1", "--json"].into_iter().chain(settings).collect();
    let reports = Folder::new("too-heavy").json(&arguments);
    let rows = reports[0]["rows"].as_array().expect("an array");
    let survived = rows.iter().find(|row| row["measure"] == "survived").expect("a row");
    assert_eq!(survived["max"], 0.0);
}

#[test]
fn an_analysis_of_a_vehicle_that_has_to_trim_itself_says_so() {
    let folder = Folder::new("untrimmed");
    let (_, told) = folder.prints(&["analyse", "x500-hover", "--set", "truth.mass_factor=1.3"]);
    assert!(told.contains("note: with `truth.mass_factor`") && told.contains("do not hold"), "{told}");
    let (_, told) = folder.prints(&["analyse", "x500-hover", "--set", "truth.inertia_factor=1.3"]);
    assert!(!told.contains("note"), "{told}");
}

#[test]
fn a_vehicle_that_its_rotors_cannot_hold_level_says_so() {
    let folder = Folder::new("unlevel");
    let text = folder.text(&["run", "outdoor-tour", "--set", "airframe.rotors.2.x_m=-0.2", "--set", "duration_s=80"]);
    assert!(text.contains("its rotors cannot hold it level: rotor "), "{text}");
}
