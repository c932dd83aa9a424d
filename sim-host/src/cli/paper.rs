//! `paper`: the paper's simulations, its figures, and its claims beside what was flown.

use std::path::Path;

use anyhow::Result;

use crate::paper::flights::Flights;
use crate::paper::{Study, Sweeps};
use crate::report::{Staged, paper, progress};

pub(super) fn run(out: &Path, as_json: bool) -> Result<()> {
    // Before the flights: a folder that cannot be written is better known now.
    let staged = Staged::begin(out)?;
    let bar = progress::of_flights(Flights::COUNT as u64 + 2, !as_json);
    let flights = Flights::fly(|| bar.inc(1))?;
    let sweeps = Sweeps::fly(&flights, || bar.inc(1))?;
    bar.finish_and_clear();
    let study = Study::new(&flights, &sweeps)?;
    let figures = staged.folder().paper(&study, &flights)?;
    staged.finish()?;
    if as_json {
        return super::say(&serde_json::to_string(&study)?);
    }
    super::say(&format!("{}\n{}", paper::render(&study), paper::files(out, &figures)))
}
