//! What a flight leaves to people and scripts: its record, its figures of merit, its pictures.
//!
//! ```text
//!                 ┌─► TruthWriter ─► truth.csv, SHA-256 ─┐
//! loop ─► Row ─►  ├─► Metrics ───────────────────────────┼─► Summary ─► summary.json, --json, table
//!  (Recorder)     ├─► Progress ─► bar on stderr          │      ▲
//!                 └─► Vec<Row> ─► Figures ─► *.svg       └──────┤ Flight: what the loop knows besides
//!                                                               │ Sensed: of flights on sensors
//! loop ─► Navigation ─► SensedRecorder ─► estimate.csv ─────────┘
//!                            └─► Vec<Belief> ─► Figures
//! ```
//!
//! Everything takes rows through [`Recorder`](crate::record::Recorder), in simulated time, and none of it can change a
//! flight. Recorders combine as tuples, so that a sweep over seeds keeps figures without keeping rows:
//!
//! ```
//! use sim_host::record::Recorder as _;
//! use sim_host::report::{Metrics, TruthWriter};
//!
//! let mut recorder = (Metrics::new(), TruthWriter::hash_only());
//! // sil::fly(&scenario, &mut recorder);
//! let (metrics, truth) = recorder;
//! let truth_sha256 = truth.finish()?;
//! # assert_eq!(truth_sha256.len(), 64);
//! # anyhow::Ok(())
//! ```

pub mod angles;
pub mod comparison;
pub mod estimate;
pub mod measures;
pub mod metrics;
pub mod paper;
pub mod plots;
pub mod progress;
pub mod sensed;
pub mod summary;
pub mod table;
pub mod timeline;
pub mod touchdown;
pub mod truth;

use std::fs::{self, File};
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use crate::compare::Comparison;
use crate::paper::Study;
use crate::paper::flights::Flights;
use estimate::EstimateWriter;
pub use metrics::{Metrics, Settling};
pub use plots::Figures;
pub use progress::Progress;
pub use sensed::{Sensed, SensedRecorder};
pub use summary::{Flight, Summary};
pub use timeline::{Timeline, TimelineRecorder};
pub use touchdown::Touchdown;
pub use truth::TruthWriter;

/// The folder that `--out` names.
#[derive(Clone, Debug)]
pub struct OutFolder(PathBuf);

impl OutFolder {
    /// Creates the folder and those above it, unless they exist.
    ///
    /// # Errors
    /// When it cannot be created; the message names it.
    pub fn create(path: &Path) -> Result<Self> {
        fs::create_dir_all(path).with_context(|| {
            format!("cannot create {}: choose a folder you can write to with --out", path.display())
        })?;
        Ok(Self(path.to_owned()))
    }

    /// Opens truth.csv for the rows to come.
    ///
    /// # Errors
    /// When the file cannot be created; the message names it.
    pub fn truth(&self) -> Result<TruthWriter<File>> {
        TruthWriter::create(&self.0.join("truth.csv"))
    }

    /// Opens estimate.csv for the beliefs to come.
    ///
    /// # Errors
    /// When the file cannot be created; the message names it.
    pub fn estimate(&self) -> Result<EstimateWriter<BufWriter<File>>> {
        EstimateWriter::create(&self.0.join("estimate.csv"))
    }

    /// Writes summary.json.
    ///
    /// # Errors
    /// When the file cannot be written; the message names it.
    pub fn summary(&self, summary: &Summary) -> Result<PathBuf> {
        summary.write(&self.0)
    }

    /// Writes compare.json, compare.csv, compare.md and the figures of a comparison.
    ///
    /// # Errors
    /// When a file cannot be written; the message names it.
    pub fn comparison(&self, comparison: &Comparison) -> Result<()> {
        comparison::write(comparison, &self.0)?;
        plots::comparison::draw(comparison, &self.0)
    }

    /// Writes paper.json, paper.md and Figures 2 to 7 of the paper's study. Returns the figures.
    ///
    /// # Errors
    /// When a file cannot be written; the message names it.
    pub fn paper(&self, study: &Study, flights: &Flights) -> Result<Vec<PathBuf>> {
        paper::write(study, &self.0)?;
        plots::paper::draw(flights, &self.0)
    }

    /// Draws every figure that applies.
    ///
    /// # Errors
    /// When a file cannot be written; the message names it.
    pub fn figures(&self, figures: &Figures) -> Result<Vec<PathBuf>> {
        figures.draw(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Recorder as _;

    #[test]
    fn a_flight_leaves_its_files() {
        let path = std::env::temp_dir().join(format!("glissade-{}-out/deep", std::process::id()));
        let folder = OutFolder::create(&path).expect("the temporary folder can be written");
        let rows = plots::tests::made_up(1.0);
        let mut recorder = (Metrics::new(), folder.truth().expect("a file"));
        for row in &rows {
            recorder.record(row);
        }
        let truth_sha256 = recorder.1.finish().expect("the disk has room");
        let summary = Summary::new(Flight { truth_sha256, ..summary::tests::flight(true) }, &recorder.0);
        folder.summary(&summary).expect("a file");
        let lines = fs::read_to_string(path.join("truth.csv")).expect("truth.csv is there").lines().count();
        assert_eq!(lines, 1 + rows.len());
        let text = fs::read_to_string(path.join("summary.json")).expect("summary.json is there");
        assert_eq!(text, summary.to_file_text());
        fs::remove_dir_all(path.parent().expect("it has one")).expect("the folder is there");
    }

    #[test]
    fn a_folder_that_is_a_file_is_named() {
        let error = OutFolder::create(Path::new("Cargo.toml")).expect_err("it is a file");
        assert!(format!("{error:#}").contains("Cargo.toml"));
    }
}
