//! `plan`: finds the path that joins a scenario's trajectory soonest.

#[cfg(feature = "search")]
use anyhow::Context as _;
use anyhow::Result;

use super::Which;
#[cfg(feature = "search")]
use crate::report::progress;
#[cfg(feature = "search")]
use crate::words::counted;

#[cfg(not(feature = "search"))]
pub(super) fn run(which: &Which, _seed: u64, _flights: usize) -> Result<()> {
    which.load()?;
    crate::tune::require_optimisers("plan")
}

#[cfg(feature = "search")]
pub(super) fn run(which: &Which, seed: u64, flights: usize) -> Result<()> {
    let scenario = which.load()?;
    let bar = progress::of_flights(flights as u64, true);
    let planned = crate::plan::plan(&scenario, flights, seed, |flown| bar.set_position(flown))?;
    bar.finish_and_clear();
    let table = toml::to_string(&planned.plan).context("the plan cannot be written as TOML")?;
    super::say(&format!(
        "# All axes within 4 cm from {:.3} s; {}.\n[join]\n{table}",
        planned.settle_s,
        counted(planned.flights, "flight")
    ))
}
