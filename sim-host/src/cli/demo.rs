//! No command: a tour on sensors, and the paper's disturbed case, with their figures in runs/.

use std::path::{Path, PathBuf};

use anyhow::{Result, ensure};

use super::fly;
use crate::interrupt::{self, Interrupted};
use crate::report::{Paint, Staged, table};
use crate::scenario::Scenario;

const NEXT: &str = "next, each after `cargo run --release --`:
  run x500-helix --out runs/x500-helix   another flight (`scenarios` lists them)
  run outdoor-tour --seeds 1..20         the same tour in twenty winds, with twenty sets of sensors
  paper                                  the paper's Figures 2 to 7, and its claims beside what is flown here
  serve                                  fly it yourself: type `help`, or connect a ground station";

pub(super) fn run() -> Result<()> {
    interrupt::listen();
    let paint = Paint::for_stdout();
    for name in ["outdoor-tour", "paper-disturbed"] {
        let folder = Path::new("runs").join(name);
        let scenario = Scenario::load(name, &[])?;
        let staged = Staged::begin(&folder)?;
        let summary = fly::fly_into(&staged.folder(), &scenario, &[], 1, true)?;
        let contents = staged.finish()?;
        let about = paint.dim(&format!("  {}\n", scenario.file.summary));
        let heading = table::heading(&summary, paint) + &about + "\n" + &table::result(&summary);
        super::say(&format!("{heading}{}\n", pictures(&folder, &contents)))?;
        ensure!(!interrupt::requested(), Interrupted);
    }
    super::say(&format!("\n{NEXT}"))
}

/// Where the pictures are, and which to look at first.
fn pictures(folder: &Path, contents: &str) -> String {
    let first = telling(folder).map_or_else(String::new, |path| format!("; look first at {}", path.display()));
    super::wrote(folder, contents) + &first
}

/// The figure that tells most: of a pilot's flight, of a disturbed one, of any other.
fn telling(folder: &Path) -> Option<PathBuf> {
    ["flight.svg", "disturbed.svg", "path.svg"].iter().map(|name| folder.join(name)).find(|path| path.is_file())
}
