//! The folder that `--out` names: written under another name beside it, and renamed once it is whole. So it holds one
//! flight, all of it, and never a mixture of two.

use std::fs::{self, File};
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};

use super::estimate::EstimateWriter;
use super::{Figures, Summary, TruthWriter, comparison, paper, plots};
use crate::compare::Comparison;
use crate::paper::Study;
use crate::paper::flights::Flights;
use crate::words::counted;

/// Files by which a folder is known to be ours: one of them is written by every command with `--out`.
const MARKS: [&str; 4] = ["provenance.toml", "compare.json", "analyse.json", "paper.json"];
/// What else such a folder may hold, besides figures and a folder per seed.
const OURS: [&str; 9] = [
    "summary.json",
    "truth.csv",
    "estimate.csv",
    "scenario.toml",
    "airframe.toml",
    "tuning.toml",
    "compare.csv",
    "compare.md",
    "paper.md",
];

/// A folder that is being written.
#[derive(Clone, Debug)]
pub struct OutFolder(PathBuf);

/// A folder that will stand in its place once it is whole. Dropped before, it leaves nothing.
#[derive(Debug)]
pub struct Staged {
    target: PathBuf,
    partial: PathBuf,
}

impl Staged {
    /// Begins to write what is to be `target`. What a killed run has left of the same target is removed.
    ///
    /// # Errors
    /// When `target` is something else than a folder of ours, or the folder cannot be created; the message names it.
    pub fn begin(target: &Path) -> Result<Self> {
        let target = resolved(target)?;
        refuse_foreign(&target)?;
        let name = target.file_name().and_then(|name| name.to_str());
        let name = name.with_context(|| format!("--out {}: give the folder a name", target.display()))?;
        let partial = target.with_file_name(format!(".{name}.partial"));
        let cannot = || format!("cannot create {}: choose a folder you can write to with --out", target.display());
        if partial.exists() {
            fs::remove_dir_all(&partial).with_context(cannot)?;
        }
        fs::create_dir_all(&partial).with_context(cannot)?;
        Ok(Self { target, partial })
    }

    /// The folder to write into.
    pub fn folder(&self) -> OutFolder {
        OutFolder(self.partial.clone())
    }

    /// Puts the folder in its place, whole; what was there before is removed. Returns what it holds, in words.
    ///
    /// # Errors
    /// When it cannot be renamed; the message names it.
    pub fn finish(self) -> Result<String> {
        let cannot = || format!("cannot write {}: is it in use?", self.target.display());
        let contents = contents(&self.partial).with_context(cannot)?;
        let old = self.partial.with_extension("old");
        if old.exists() {
            fs::remove_dir_all(&old).with_context(cannot)?;
        }
        if self.target.exists() {
            fs::rename(&self.target, &old).with_context(cannot)?;
        }
        if let Err(error) = fs::rename(&self.partial, &self.target) {
            // What was there goes back to its place.
            let _ = fs::rename(&old, &self.target);
            return Err(error).with_context(cannot);
        }
        if old.exists() {
            fs::remove_dir_all(&old).with_context(cannot)?;
        }
        Ok(contents)
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        // After `finish` it is no longer there.
        let _ = fs::remove_dir_all(&self.partial);
    }
}

/// The folder itself where a link leads to it.
fn resolved(target: &Path) -> Result<PathBuf> {
    if !target.exists() {
        return Ok(target.to_owned());
    }
    ensure!(target.is_dir(), "--out {}: it is no folder: name a folder", target.display());
    let whole = target.canonicalize().with_context(|| format!("cannot read {}", target.display()))?;
    let here = std::env::current_dir().and_then(|here| here.canonicalize());
    ensure!(
        here.is_ok_and(|here| !here.starts_with(&whole)),
        "--out {}: the folder is replaced as a whole, and you are in it: name one below it",
        target.display()
    );
    Ok(whole)
}

/// Refuses to replace what is not ours.
fn refuse_foreign(target: &Path) -> Result<()> {
    match foreign(target) {
        None => Ok(()),
        Some(name) => bail!(
            "--out {}: it holds `{name}`, which no run has written, and would be replaced as a whole: name another \
             folder, or move that away",
            target.display()
        ),
    }
}

/// The name of something in a folder that no run has written. A folder of ours has a file that tells so, or holds
/// folders of ours, a seed each.
fn foreign(folder: &Path) -> Option<String> {
    let names: Vec<String> = fs::read_dir(folder)
        .ok()?
        .filter_map(|entry| Some(entry.ok()?.file_name().to_string_lossy().into_owned()))
        .collect();
    let mut in_seeds = names.iter().filter(|name| name.starts_with("seed-"));
    let in_seeds = in_seeds.find_map(|name| Some(format!("{name}/{}", foreign(&folder.join(name))?)));
    let known = names.iter().any(|name| MARKS.contains(&name.as_str()) || name.starts_with("seed-"));
    in_seeds.or_else(|| names.into_iter().find(|name| !known || !is_ours(name)))
}

fn is_figure(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|extension| extension == "svg")
}

fn is_ours(name: &str) -> bool {
    is_figure(name) || name.starts_with("seed-") || MARKS.contains(&name) || OURS.contains(&name)
}

/// Names of what a folder holds: figures are counted.
fn contents(folder: &Path) -> std::io::Result<String> {
    let mut names = Vec::new();
    let (mut figures, mut seeds) = (0, 0);
    for entry in fs::read_dir(folder)? {
        let name = entry?.file_name().to_string_lossy().into_owned();
        match name {
            _ if is_figure(&name) => figures += 1,
            _ if name.starts_with("seed-") => seeds += 1,
            _ => names.push(name),
        }
    }
    names.sort();
    for (count, noun) in [(figures, "figure"), (seeds, "folder")] {
        if count > 0 {
            names.insert(0, counted(count, noun));
        }
    }
    Ok(names.join(", "))
}

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
        let path = self.0.join(name);
        fs::write(&path, text)
            .with_context(|| format!("cannot write {}: choose a folder you can write to with --out", path.display()))
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

    fn place(name: &str) -> PathBuf {
        let base = std::env::temp_dir().join(format!("glissade-{}-staged-{name}", std::process::id()));
        fs::create_dir_all(&base).expect("the temporary folder can be written");
        base.join("flight")
    }

    fn written(target: &Path, name: &str) -> Result<String> {
        let staged = Staged::begin(target)?;
        staged.folder().text("provenance.toml", "")?;
        staged.folder().text(name, "")?;
        staged.finish()
    }

    #[test]
    fn a_folder_of_an_earlier_flight_is_replaced_whole() {
        let target = place("twice");
        assert_eq!(written(&target, "estimate.csv").expect("written"), "estimate.csv, provenance.toml");
        assert_eq!(written(&target, "path.svg").expect("written"), "1 figure, provenance.toml");
        assert!(!target.join("estimate.csv").exists() && target.join("path.svg").exists());
        let beside = fs::read_dir(target.parent().expect("it has one")).expect("it is there").count();
        assert_eq!(beside, 1, "nothing is left beside it");
    }

    #[test]
    fn what_is_not_ours_is_refused_and_stays() {
        let target = place("foreign");
        fs::create_dir_all(&target).expect("can be made");
        Staged::begin(&target).expect("an empty folder is fine");
        fs::write(target.join("thesis.tex"), "years of work").expect("can be written");
        let refused = |target: &Path| format!("{:#}", Staged::begin(target).expect_err("it holds a thesis"));
        assert!(refused(&target).contains("thesis.tex"));
        fs::write(target.join("provenance.toml"), "").expect("can be written");
        assert!(refused(&target).contains("thesis.tex"), "beside a flight of ours too");
        fs::create_dir_all(target.join("seed-1")).expect("can be made");
        fs::rename(target.join("thesis.tex"), target.join("seed-1/thesis.tex")).expect("can be moved");
        assert!(refused(&target).contains("seed-1/thesis.tex"), "in a folder of a seed too");
        assert!(target.join("seed-1/thesis.tex").exists());
        let target = place("namesake");
        fs::create_dir_all(&target).expect("can be made");
        fs::write(target.join("summary.json"), "{}").expect("can be written");
        assert!(refused(&target).contains("summary.json"), "a file of that name alone is no flight of ours");
    }

    #[test]
    fn a_flight_that_does_not_end_leaves_what_was_there() {
        let target = place("killed");
        written(&target, "truth.csv").expect("written");
        let staged = Staged::begin(&target).expect("begun");
        staged.folder().text("estimate.csv", "half").expect("written");
        // As a killed program leaves it.
        std::mem::forget(staged);
        assert!(target.join("truth.csv").exists() && !target.join("estimate.csv").exists());
        assert_eq!(written(&target, "path.svg").expect("written"), "1 figure, provenance.toml");
    }
}
