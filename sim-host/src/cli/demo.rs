//! No command: a tour on sensors, and the paper's disturbed case with figures like the paper's 2 to 7, in runs/.

use std::path::Path;

use anyhow::Result;

use super::run;
use crate::report::table;
use crate::scenario::Scenario;

pub(super) fn run() -> Result<()> {
    for name in ["outdoor-tour", "paper-disturbed"] {
        let folder = Path::new("runs").join(name);
        let summary = run::fly(&Scenario::load(name, &[])?, 1, Some(&folder), true)?;
        let files = if summary.sensed.is_some() { "truth.csv, estimate.csv" } else { "truth.csv" };
        super::say(&format!(
            "{}figures, {files} and summary.json are in {}\n ",
            table::render(&summary),
            folder.display()
        ))?;
    }
    super::say("More: `sim-host scenarios` lists what can be flown, `sim-host serve` flies for a ground station.")
}
