//! Suites and parts of one's own: they are found beside the file that names them, and what a command leaves flies again
//! when they have gone.

use std::fs;

use crate::common::folder::Folder;

/// A scenario in `mine/`, its suite in `mine/suites/`, that suite's part in `mine/suites/parts/`, and two parts and another
/// suite for settings.
fn own(name: &str) -> Folder {
    let folder = Folder::new(name);
    fs::create_dir_all(folder.0.join("mine/suites/parts")).expect("the temporary folder can be written");
    let hover = include_str!("../../scenarios/indoor-hover.toml");
    folder.file("mine/hover.toml", hover.replace("\"mocap\"", "\"./suites/mine.toml\""));
    folder.file("mine/suites/mine.toml", "suite = \"mocap\"\npose.part = \"parts/camera.toml\"\n");
    folder.file("mine/suites/finer.toml", "suite = \"mine.toml\"\npose.position_m = 0.0001\n");
    let camera = include_str!("../../sensors/parts/mocap.toml");
    for (path, position_m) in [("mine/suites/parts/camera.toml", "0.003"), ("mine/blurred.toml", "0.01")] {
        folder.file(path, camera.replace("0.0005", position_m));
    }
    let meter = include_str!("../../sensors/parts/power-module.toml");
    folder.file("mine/meter.toml", meter.replace("voltage_v = 0.02", "voltage_v = 0.05"));
    folder
}

/// SHA-256 of what a flight of 5 s was.
fn flown(folder: &Folder, scenario: &str, more: &[&str]) -> String {
    let summary = folder.json(&[&["run", scenario, "--set", "duration_s=5", "--json"], more].concat());
    summary["truth_sha256"].as_str().unwrap_or_else(|| panic!("{scenario}: {summary}")).to_owned()
}

#[test]
fn they_are_found_beside_the_file_that_names_them() {
    let folder = own("beside");
    let own = flown(&folder, "mine/hover.toml", &[]);
    let by_values = ["--set", "sensors=mocap", "--set", "sensors.pose.position_m=0.003"];
    assert_eq!(own, flown(&folder, "mine/hover.toml", &by_values));
    assert_ne!(own, flown(&folder, "mine/hover.toml", &by_values[..2]));
    // A setting names a file beside the scenario, or else from the current folder.
    let blurred = flown(&folder, "mine/hover.toml", &["--set", "sensors.pose.position_m=0.01"]);
    for path in ["blurred.toml", "./blurred.toml", "mine/blurred.toml"] {
        let setting = format!("sensors.pose.part={path}");
        assert_eq!(flown(&folder, "mine/hover.toml", &["--set", &setting]), blurred, "{path}");
    }
    folder.refuses(
        &["run", "mine/hover.toml", "--set", "sensors.pose.part=./gone.toml"],
        &["`sensors.pose.part`: cannot read part file `./gone.toml`: No such file"],
    );
}

#[test]
fn another_part_by_a_setting_replaces_all_that_the_file_has_of_the_sensor() {
    let folder = own("another");
    let finer = ["--set", "sensors.pose.position_m=0.0001"];
    flown(&folder, "mine/hover.toml", &["--out", "out"]);
    // out/scenario.toml has each value of the camera.
    let part = ["--set", "sensors.pose.part=mocap"];
    let plain = flown(&folder, "indoor-hover", &[]);
    assert_eq!(flown(&folder, "out/scenario.toml", &part), plain);
    // A value that is set stands above the part's, before and after it.
    let expected = flown(&folder, "indoor-hover", &finer);
    assert_eq!(flown(&folder, "out/scenario.toml", &[finer, part].concat()), expected);
    assert_eq!(flown(&folder, "out/scenario.toml", &[part, finer].concat()), expected);
}

#[test]
fn a_flight_on_them_flies_again_without_them() {
    let folder = own("again");
    let setting = ["--set", "sensors.battery.part=./mine/meter.toml", "--out", "out"];
    let first = flown(&folder, "mine/hover.toml", &setting);
    fs::remove_dir_all(folder.0.join("mine")).expect("it is there");
    fs::rename(folder.0.join("out"), folder.0.join("elsewhere")).expect("it is there");
    assert_eq!(flown(&folder, "elsewhere/scenario.toml", &[]), first);
}

#[test]
fn a_comparison_on_them_flies_again_without_them() {
    let folder = own("compared");
    let disturbances = [
        ("none", ""),
        ("built-in-part", "\"sensors.pose.part=mocap\""),
        ("part", "\"sensors.pose.part=./blurred.toml\""),
        ("suite", "\"sensors=./suites/finer.toml\""),
        ("table", "'sensors={suite=\"suites/finer.toml\",mag=false}'"),
    ];
    let disturbances = disturbances.map(|(name, set)| format!("[[disturbances]]\nname = \"{name}\"\nset = [{set}]\n"));
    let head =
        "controllers = [\"x500-smc\"]\nscenarios = [\"hover.toml\"]\nseeds = \"1..1\"\nset = [\"duration_s=5\"]\n";
    folder.file("mine/matrix.toml", head.to_owned() + &disturbances.concat());
    folder.succeeds(&["compare", "mine/matrix.toml", "--set", "sensors.battery.part=mine/meter.toml", "--out", "out"]);
    let flights = |out: &str| fs::read_to_string(folder.0.join(out).join("compare.csv")).expect("it was written");
    let first = flights("out");
    let figures = |name: &str| {
        let row = first.lines().find_map(|line| line.strip_prefix(&format!("hover,{name},")));
        row.unwrap_or_else(|| panic!("{name}: {first}")).to_owned()
    };
    for other in ["built-in-part", "part", "suite"] {
        assert_ne!(figures("none"), figures(other), "{other} changes nothing");
    }
    assert_eq!(figures("suite"), figures("table"));
    fs::remove_dir_all(folder.0.join("mine")).expect("it is there");
    fs::rename(folder.0.join("out"), folder.0.join("elsewhere")).expect("it is there");
    folder.succeeds(&["compare", "elsewhere/matrix.toml", "--out", "third"]);
    assert_eq!(flights("third"), first);
    // What was kept is kept by the same names, and says the same.
    for name in ["matrix", "scenario-hover", "suite-finer", "suite-mine", "part-camera", "part-blurred", "part-meter"] {
        let text =
            |out: &str| fs::read_to_string(folder.0.join(out).join(format!("{name}.toml"))).expect("it was kept");
        assert_eq!(text("elsewhere"), text("third"), "{name}");
    }
}
