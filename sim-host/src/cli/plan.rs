//! `plan`: finds the path that joins a scenario's trajectory soonest.

use anyhow::{Context, Result};

use super::Which;
use crate::report::progress;

pub(super) fn run(which: &Which, seed: u64, flights: usize) -> Result<()> {
    let scenario = which.load()?;
    let bar = progress::of_flights(flights as u64, true);
    let planned = crate::plan::plan(&scenario, flights, seed, |flown| bar.set_position(flown))?;
    bar.finish_and_clear();
    let table = toml::to_string(&planned.plan).context("the plan cannot be written as TOML")?;
    super::say(&format!(
        "# All axes within 4 cm from {:.3} s; {} flights.\n[join]\n{table}",
        planned.settle_s, planned.flights
    ))
}
