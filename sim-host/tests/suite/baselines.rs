//! Flights of the three controllers that sliding mode is compared with.

use sim_host::flight;
use sim_host::record::Row;
use sim_host::scenario::Scenario;

use crate::common::load::load;

/// As they come out of the last search: what is asked of their flights below holds for any gains that are fit to fly.
const TUNINGS: [&str; 3] = ["x500-pid", "x500-geometric", "x500-indi"];

fn scenario(tuning: &str, settings: &[&str]) -> Scenario {
    let tuning = format!("tuning={tuning}");
    load("x500-hover", &[settings, &[&tuning]].concat())
}

fn fly(scenario: &Scenario) -> Vec<Row> {
    let mut rows = Vec::new();
    let outcome = flight::fly(scenario, 1, &mut rows).expect("can be flown");
    assert!(outcome.survived(), "{}", scenario.controller.name());
    rows
}

fn distance(row: &Row) -> f64 {
    let square = |i: usize| (row.position[i] - row.reference[i]) * (row.position[i] - row.reference[i]);
    (square(0) + square(1) + square(2)).sqrt()
}

#[test]
fn each_comes_back_from_an_offset_and_stays() {
    for tuning in TUNINGS {
        let rows = fly(&scenario(tuning, &["start_position_m=[0.3,-0.3,2.3]"]));
        let (first, last) = (rows.first().expect("rows"), rows.last().expect("rows"));
        assert!(distance(first) > 0.5, "{tuning}");
        assert!(distance(last) < 0.05, "{tuning}: {}", distance(last));
        let farthest = rows.iter().map(distance).fold(0.0, f64::max);
        assert!(farthest < 0.8, "{tuning}: {farthest}");
    }
}

#[test]
fn each_survives_a_step_without_a_path() {
    let step = "trajectory={step={from_m=[0.0,0.0,2.0],to_m=[3.0,0.0,2.0],at_s=1.0,yaw_rad=0.0}}";
    for tuning in TUNINGS {
        let rows = fly(&scenario(tuning, &[step]));
        let last = rows.last().expect("rows");
        assert!(distance(last) < 0.1, "{tuning}: {}", distance(last));
        let beyond = rows.iter().map(|row| row.position[0] - 3.0).fold(0.0, f64::max);
        assert!(beyond < 1.0, "{tuning}: {beyond}");
        let sunk = rows.iter().map(|row| (row.position[2] - 2.0).abs()).fold(0.0, f64::max);
        assert!(sunk < 1.0, "{tuning}: {sunk}");
    }
}

#[test]
fn each_upholds_a_push_that_it_does_not_know() {
    // 10 % more mass than modelled, and a steady wind of 3 m/s, from the first tick. Uncompensated, the mass alone
    // makes 1 m/s² of it: 0.08 m at a position gain of 12 1/s².
    for tuning in TUNINGS {
        let rows = fly(&scenario(tuning, &["truth.mass_factor=1.1", "wind.mean_m_s=[3.0,0.0,0.0]"]));
        let last = rows.last().expect("rows");
        assert!(distance(last) < 0.05, "{tuning}: {}", distance(last));
    }
}

#[test]
fn what_flies_the_firmwares_own_laws_alone_says_so() {
    for tuning in TUNINGS {
        let error = Scenario::load(
            "x500-hover",
            &[format!("tuning={tuning}"), "plant=paper-decoupled".into(), "duration_s=1".into()],
        )
        .expect_err("must be refused");
        let text = format!("{error:#}");
        assert!(text.contains("paper-decoupled") && text.contains("tuning") && !text.contains('\n'), "{text}");
        let hover = scenario(tuning, &[]);
        let error = flight::lockstep(&hover, 1, flight::rigid_body(&hover, 1)).expect_err("must be refused");
        assert!(error.to_string().contains(hover.controller.name()), "{error}");
    }
}
