//! `bench`: how fast the simulation is, on one core, without a log.

use std::time::Instant;

use anyhow::{Result, ensure};
use serde_json::json;

use crate::flight;
use crate::report::progress;
use crate::scenario::Scenario;
use crate::sil::Lockstep as _;
use crate::words::counted;

pub(super) fn run(seconds: f64, runs: usize, as_json: bool) -> Result<()> {
    let scenario = Scenario::load("helix", &[])?;
    let ticks = (seconds * 1e3) as u32;
    let bar = progress::of_flights(runs as u64, !as_json);
    if !as_json {
        super::tell(&format!(
            "measuring {} of `helix`, {seconds} simulated s each, on one core",
            counted(runs, "flight")
        ));
    }
    let timed = |_| {
        let factor = fly(&scenario, ticks);
        bar.inc(1);
        factor
    };
    let mut factors = (0..runs).map(timed).collect::<Result<Vec<f64>>>()?;
    bar.finish_and_clear();
    factors.sort_by(f64::total_cmp);
    let median = factors[runs / 2];
    if as_json {
        return super::say(&json!({ "ideal_state": median, "ideal_state_runs": factors }).to_string());
    }
    super::say(&format!(
        "ideal state: lowest {:.0}, median {median:.0}, highest {:.0} × real time\n\
         (`helix`, firmware at 1 kHz and 250 Hz, rigid body in RK4 at 1 kHz, no log)",
        factors[0],
        factors[runs - 1]
    ))
}

/// Simulated seconds a second of wall time.
fn fly(scenario: &Scenario, ticks: u32) -> Result<f64> {
    let mut flight = flight::prepare(scenario, 1)?;
    let start = Instant::now();
    let outcome = flight.run(ticks, &mut ());
    let wall_s = start.elapsed().as_secs_f64();
    // Looked at, so that the flight cannot be optimised away.
    ensure!(outcome.survived() && outcome.ticks == ticks, "the benchmark's flight was lost");
    Ok(f64::from(ticks) * 1e-3 / wall_s)
}
