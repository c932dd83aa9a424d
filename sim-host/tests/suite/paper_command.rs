//! `paper`: the numbers of its table come from the flights and the equations, and its reasons are true of them.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};
use std::sync::OnceLock;

use serde_json::Value;
use sim_host::paper::claims::{ALTITUDE_ERROR, ALTITUDE_ERROR_M, Y_FOLLOWS, Z_FOLLOWS};
use sim_host::paper::flights::Flights;
use sim_host::report::metrics::errors;

fn flights() -> &'static Flights {
    static FLIGHTS: OnceLock<Flights> = OnceLock::new();
    FLIGHTS.get_or_init(|| Flights::fly(|| ()).expect("the built-in scenarios fly"))
}

fn folder(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("glissade-{}-paper-{name}", std::process::id()))
}

fn command(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_sim-host")).args(arguments).output().expect("the program starts")
}

#[test]
fn table_1_flies_as_the_closed_form_says() {
    // Eq. 16 and 18–23 by hand. The flight is sampled every 1 ms, and its reference and state are f32: 3 ms and 1 mm.
    let ideal = &flights().ideal;
    let by_hand = ideal.approaches().expect("it has flown");
    for (axis, approach) in by_hand.iter().enumerate().skip(1) {
        let settled = ideal.settled()[axis].expect("it settles");
        assert!((settled - approach.settled_s(0.05)).abs() < 3e-3, "{axis}: {settled}");
        for t in [0.1, 0.2, 0.3, 0.45] {
            let error = errors(ideal.at(t).expect("flown"))[axis];
            assert!((error - approach.error_at(t)).abs() < 1e-3, "{axis} at {t}: {error} {}", approach.error_at(t));
        }
    }
    let z = by_hand[2];
    assert!(z.error_at(0.45) > z.error * (-z.lambda * 0.45).exp(), "no K is fast enough for 2 mm at 0.45 s");
    assert!(z.error * (-z.lambda * 0.45).exp() > ALTITUDE_ERROR_M);
}

#[test]
fn the_papers_times_are_those_of_a_band_of_two_per_cent() {
    let ideal = &flights().ideal;
    for (axis, claim) in [(1, Y_FOLLOWS), (2, Z_FOLLOWS)] {
        let settled = ideal.settled_to(axis, 0.02).expect("it settles");
        assert!((settled - claim.time_s).abs() < 0.01, "{axis}: {settled}");
    }
}

#[test]
fn eq_11_has_no_solution_for_what_table_1_asks_for() {
    let (thrust, uy) = flights().ideal.first_demand().expect("it has flown");
    let flown = flights().ideal.rows[0].u[0];
    assert!((thrust - flown).abs() < 0.01, "{thrust} {flown}");
    assert!(uy.abs() > 1.0, "{uy}");
}

#[test]
fn the_layer_and_the_gains_of_the_position_are_why_the_coupled_vehicle_does_not_fly() {
    let Flights { literal, literal_strong, literal_thin, literal_slow, helix, .. } = flights();
    for flown in [literal, literal_strong, literal_thin] {
        assert_eq!(flown.all_settled(), None, "{}", flown.name);
        assert!(flown.greatest_error().is_some_and(|error| error > 1.0), "{}", flown.name);
    }
    for (flown, error_m) in [(literal_slow, 0.01), (helix, 0.002)] {
        assert!(flown.all_settled().is_some(), "{}", flown.name);
        assert!(flown.greatest_error().is_some_and(|error| error < error_m), "{}", flown.name);
    }
    let (slow, own) = (literal_slow.control(), helix.control());
    assert_eq!([slow.x.lambda, slow.x.gain], [own.x.lambda, own.x.gain], "the slow gains are those of `helix`");
    assert_eq!(literal_slow.control().roll, literal.control().roll, "the attitude's gains stay as Table 1 has them");
}

/// Flies the whole command once: everything that is written.
#[test]
fn the_command_leaves_its_table_and_figures() {
    let folder = folder("whole");
    let out = folder.to_str().expect("a plain path");
    let output = command(&["paper", "--json", "--out", out]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let study: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let kept: Value =
        serde_json::from_str(&fs::read_to_string(folder.join("paper.json")).expect("kept")).expect("JSON");
    assert_eq!(study, kept);
    figures_are_whole(&folder);
    let table = fs::read_to_string(folder.join("paper.md")).expect("kept");
    fs::remove_dir_all(&folder).expect("it is there");
    let claims = study["claims"].as_array().expect("an array");
    assert_eq!(table.lines().count(), claims.len() + 2);
    claims.iter().for_each(is_whole);
    // Against the flights, flown once more.
    let claim = |what: &str| claims.iter().find(|claim| claim["claim"] == what).expect(what).clone();
    let flown = &flights().ideal;
    for (what, here) in [
        (Y_FOLLOWS.what, flown.settled()[1]),
        (Z_FOLLOWS.what, flown.settled()[2]),
        (ALTITUDE_ERROR.what, flown.metrics.axes().z.settle_2mm_s),
    ] {
        assert_eq!(claim(what)["here"].as_f64(), here, "{what}");
    }
    assert!(claim(Z_FOLLOWS.what)["difference"].as_f64() < Some(0.0), "sooner than the paper");
    assert!(claim(Y_FOLLOWS.what)["difference"].as_f64() > Some(0.0), "later than the paper");
    assert_eq!(study["table_1"][3]["gain"], 334.0);
    assert_eq!(study["table_2"]["mass_kg"], 0.823);
    assert_eq!(study["flights"][0]["truth_sha256"], flown.truth_sha256.as_str());
}

fn is_whole(claim: &Value) {
    let number = |key: &str| claim[key].as_f64();
    for key in ["claim", "place", "flight", "measure", "unit", "why"] {
        assert!(claim[key].as_str().is_some_and(|text| !text.is_empty() && !text.contains("NaN")), "{key}: {claim}");
    }
    let difference = number("paper").zip(number("here")).map(|(paper, here)| here - paper);
    // Decimal text and back may cost the last bit.
    match (number("difference"), difference) {
        (Some(told), Some(difference)) => assert!((told - difference).abs() < 1e-12, "{claim}"),
        (told, difference) => assert_eq!(told, difference, "{claim}"),
    }
}

fn figures_are_whole(folder: &std::path::Path) {
    for (name, panels) in [
        (
            "figure-2-altitude",
            &["Figure 2", "a) altitude", "b) tracking error", "c) phase plot", "d) control input"][..],
        ),
        ("figure-3-position", &["Figure 3", "x: tracking", "y: tracking", "x: phase portrait", "y: phase portrait"]),
        ("figure-4-attitude", &["Figure 4", "roll: tracking", "yaw: control input", "U2, N m"]),
        ("figure-5-disturbance", &["Figure 5", "m/s²", "rad/s²", "yaw"]),
        ("figure-5-disturbance-output", &["Figure 5"]),
        ("figure-6-disturbed", &["Figure 6", "a) position x", "c) altitude", "f) yaw", "its error"]),
        ("figure-6-disturbed-output", &["Figure 6"]),
        ("figure-7-helix", &["Figure 7", "from above", "z (up), m"]),
        ("coupled-vehicle", &["distance from the helix"]),
    ] {
        let svg = fs::read_to_string(folder.join(format!("{name}.svg"))).expect(name);
        assert!(svg.trim_end().ends_with("</svg>") && svg.len() < 150_000, "{name}: {} bytes", svg.len());
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
        assert!(panels.iter().all(|text| svg.contains(text)), "{name}: {panels:?}");
    }
}

#[test]
fn a_folder_that_cannot_be_written_is_named_before_anything_is_flown() {
    let output = command(&["paper", "--out", "/dev/null/paper"]);
    let complaint = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(output.status.code(), Some(2), "{complaint}");
    assert!(complaint.lines().count() == 1 && complaint.contains("/dev/null/paper"), "{complaint}");
}
