//! The files that commands write into the folder that `--out` names.

use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind};
use std::path::{Path, PathBuf};

use anyhow::{Error, Result};

use super::estimate::EstimateWriter;
use super::{Figures, Summary, TruthWriter, comparison, paper, plots};
use crate::compare::Comparison;
use crate::paper::Study;
use crate::paper::flights::Flights;

/// A folder that is being written.
#[derive(Clone, Debug)]
pub struct OutFolder(pub(super) PathBuf);

/// Writes a whole file.
///
/// # Errors
/// When it cannot be written; the message names it, and what helps.
pub(crate) fn write_file(path: &Path, text: impl AsRef<[u8]>) -> Result<()> {
    fs::write(path, text).map_err(|error| cannot_write(path, error))
}

/// Creates a file, or empties it.
///
/// # Errors
/// When it cannot be created; the message names it, and what helps.
pub(crate) fn create_file(path: &Path) -> Result<File> {
    File::create(path).map_err(|error| cannot_write(path, error))
}

/// Says what cannot be written, what helps, and why.
pub(crate) fn cannot_write(path: &Path, error: io::Error) -> Error {
    let remedy = match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "free some space, or choose another folder with --out",
        _ => "choose a folder you can write to with --out",
    };
    Error::new(error).context(format!("cannot write {}: {remedy}", path.display()))
}

impl OutFolder {
    /// Creates the folder and those above it, unless they exist.
    ///
    /// # Errors
    /// When it cannot be created; the message names it.
    pub fn create(path: &Path) -> Result<Self> {
        fs::create_dir_all(path).map_err(|error| cannot_write(path, error))?;
        Ok(Self(path.to_owned()))
    }

    /// A folder below it.
    ///
    /// # Errors
    /// When it cannot be created; the message names it.
    pub fn below(&self, name: &str) -> Result<Self> {
        Self::create(&self.0.join(name))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0
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

    /// Writes a text.
    ///
    /// # Errors
    /// When the file cannot be written; the message names it.
    pub fn text(&self, name: &str, text: &str) -> Result<()> {
        write_file(&self.0.join(name), text)
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
    use crate::report::{Flight, Metrics, plots, summary};

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
