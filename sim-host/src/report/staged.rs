//! The folder that `--out` names is written under another name beside it, and renamed once it is whole. So it holds one
//! flight, all of it, and never a mixture of two.
//!
//! For `--out out`:
//!
//! ```text
//! .out.1.partial/       locked as long as the run lives; a second run at the same time takes .out.2.partial
//!     new/              what is being written; becomes out/ at the end
//!     old/              what out/ was before, while the two change places
//! ```
//!
//! A run that ends or is interrupted removes its own. What a killed run (SIGKILL, power) has left is no longer locked:
//! the next run with the same `--out` removes it, and puts `old/` back if the run was killed between the two renames.
//! Of runs at the same time, the last to end stays.

use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};

use super::OutFolder;
use super::out::cannot_write;
use crate::interrupt;
use crate::matrix::KEPT;
use crate::words::counted;

/// Files by which a folder is known to be ours: one of them is written by every command with `--out`.
const MARKS: [&str; 4] = ["provenance.toml", "compare.json", "analyse.json", "paper.json"];
/// What else such a folder may hold, besides figures, a folder per seed and the tunings of a comparison.
const OURS: [&str; 11] = [
    "summary.json",
    "truth.csv",
    "estimate.csv",
    "inputs.csv",
    "scenario.toml",
    "airframe.toml",
    "tuning.toml",
    "matrix.toml",
    "compare.csv",
    "compare.md",
    "paper.md",
];

/// A folder that will stand in its place once it is whole. Dropped before, it leaves nothing.
#[derive(Debug)]
pub struct Staged {
    target: PathBuf,
    staging: Staging,
}

impl Staged {
    /// Begins to write what is to be `target`. What killed runs have left of the same target is removed.
    ///
    /// # Errors
    /// When `target` is something else than a folder of ours, or the folder cannot be created; the message names it.
    pub fn begin(target: &Path) -> Result<Self> {
        let target = resolved(target)?;
        refuse_foreign(&target)?;
        let name = target.file_name().and_then(|name| name.to_str());
        let name = name.with_context(|| format!("--out {}: give the folder a name", target.display()))?;
        let staging = Staging::beside(&target, name).map_err(|error| cannot_write(&target, error))?;
        Ok(Self { target, staging })
    }

    /// The folder to write into.
    pub fn folder(&self) -> OutFolder {
        OutFolder(self.staging.being_written())
    }

    /// Puts the folder in its place, whole; what was there before is removed. Returns what it holds, in words.
    ///
    /// # Errors
    /// When it cannot be renamed; the message names it.
    pub fn finish(self) -> Result<String> {
        let contents = contents(&self.staging.being_written());
        let finished = contents.and_then(|contents| self.staging.replace(&self.target).map(|()| contents));
        finished.with_context(|| format!("cannot write {}: is it in use?", self.target.display()))
    }
}

/// A hidden folder for the time of writing, which no other run uses.
#[derive(Debug)]
struct Staging {
    folder: PathBuf,
    /// Held as long as this run lives; none where the file system has no locks.
    _lock: Option<File>,
}

impl Staging {
    fn beside(target: &Path, name: &str) -> io::Result<Self> {
        if let Some(parent) = target.parent() {
            fs::create_dir_all(parent)?;
            remove_stale(parent, target, name);
        }
        let mut number = 1;
        loop {
            let folder = target.with_file_name(format!(".{name}.{number}.partial"));
            if let Some(staging) = Self::claim(folder)? {
                return Ok(staging);
            }
            number += 1;
        }
    }

    /// Creates the folder; none if another run has it.
    fn claim(folder: PathBuf) -> io::Result<Option<Self>> {
        match fs::create_dir(&folder) {
            Ok(()) => {}
            Err(error) if error.kind() == ErrorKind::AlreadyExists => return Ok(None),
            Err(error) => return Err(error),
        }
        let lock = match lock(&folder) {
            // Another run took it for a stale one, in the moment before the lock.
            Lock::Taken => return Ok(None),
            Lock::Got(lock) => Some(lock),
            Lock::Unable => None,
        };
        match fs::create_dir(folder.join("new")) {
            Ok(()) => {}
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(error),
        }
        interrupt::begin_folder(&folder);
        Ok(Some(Self { folder, _lock: lock }))
    }

    /// The folder that becomes the target.
    fn being_written(&self) -> PathBuf {
        self.folder.join("new")
    }

    /// Puts what has been written in the place of `target`.
    fn replace(&self, target: &Path) -> io::Result<()> {
        let (new, old) = (self.being_written(), self.folder.join("old"));
        loop {
            match fs::rename(target, &old) {
                Err(error) if error.kind() != ErrorKind::NotFound => return Err(error),
                _ => {}
            }
            match fs::rename(&new, target) {
                // Another run has just put its own there.
                Err(error) if matches!(error.kind(), ErrorKind::DirectoryNotEmpty | ErrorKind::AlreadyExists) => {
                    fs::remove_dir_all(&old)?;
                }
                Err(error) => {
                    // What was there goes back to its place.
                    let _ = fs::rename(&old, target);
                    return Err(error);
                }
                Ok(()) => return Ok(()),
            }
        }
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.folder);
        interrupt::end_folder(&self.folder);
    }
}

/// What came of an attempt to lock a folder.
enum Lock {
    Got(File),
    /// Another run has it.
    Taken,
    /// It cannot be locked, or is not there.
    Unable,
}

fn lock(folder: &Path) -> Lock {
    let Ok(file) = File::open(folder) else { return Lock::Unable };
    match file.try_lock() {
        Ok(()) => Lock::Got(file),
        Err(fs::TryLockError::WouldBlock) => Lock::Taken,
        Err(fs::TryLockError::Error(_)) => Lock::Unable,
    }
}

/// Removes what killed runs have left of a target. One of them may have moved the target away.
fn remove_stale(parent: &Path, target: &Path, name: &str) {
    let Ok(entries) = fs::read_dir(if parent.as_os_str().is_empty() { Path::new(".") } else { parent }) else { return };
    for folder in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        if is_staging(&folder, name)
            && let Lock::Got(_lock) = lock(&folder)
        {
            if !target.exists() {
                let _ = fs::rename(folder.join("old"), target);
            }
            let _ = fs::remove_dir_all(&folder);
        }
    }
}

/// Whether it is named as [`Staging`] names its folders for a target of that name.
fn is_staging(folder: &Path, name: &str) -> bool {
    let staging = folder.file_name().and_then(|name| name.to_str());
    let rest = staging.and_then(|staging| staging.strip_prefix('.')?.strip_prefix(name));
    let number = rest.and_then(|rest| rest.strip_prefix('.')?.strip_suffix(".partial"));
    number.is_some_and(|number| !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()))
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

/// Whether it is named as a comparison names what it keeps.
fn is_kept(name: &str) -> bool {
    KEPT.iter().any(|kind| name.starts_with(kind)) && Path::new(name).extension().is_some_and(|end| end == "toml")
}

fn is_ours(name: &str) -> bool {
    is_figure(name) || is_kept(name) || name.starts_with("seed-") || MARKS.contains(&name) || OURS.contains(&name)
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

#[cfg(test)]
mod tests {
    use super::*;

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

    /// Names beside the target and the target's own.
    fn around(target: &Path) -> Vec<String> {
        let parent = target.parent().expect("it has one");
        let entries = fs::read_dir(parent).expect("it is there");
        let mut names: Vec<String> =
            entries.map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_flight_that_does_not_end_leaves_what_was_there() {
        let target = place("dropped");
        written(&target, "truth.csv").expect("written");
        let staged = Staged::begin(&target).expect("begun");
        staged.folder().text("estimate.csv", "half").expect("written");
        drop(staged);
        assert!(target.join("truth.csv").exists() && !target.join("estimate.csv").exists());
        assert_eq!(around(&target), ["flight"]);
    }

    /// As a killed program leaves it: the folder stays, without a lock.
    fn killed(target: &Path) -> PathBuf {
        let folder = target.with_file_name(".flight.1.partial");
        fs::create_dir_all(folder.join("new")).expect("can be made");
        fs::write(folder.join("new/estimate.csv"), "half").expect("can be written");
        folder
    }

    #[test]
    fn what_a_killed_run_left_is_removed_by_the_next() {
        let target = place("killed");
        written(&target, "truth.csv").expect("written");
        killed(&target);
        assert_eq!(around(&target), [".flight.1.partial", "flight"]);
        assert_eq!(written(&target, "path.svg").expect("written"), "1 figure, provenance.toml");
        assert_eq!(around(&target), ["flight"]);
    }

    #[test]
    fn a_folder_that_a_killed_run_had_moved_away_comes_back() {
        let target = place("between");
        written(&target, "truth.csv").expect("written");
        let folder = killed(&target);
        fs::rename(&target, folder.join("old")).expect("can be moved");
        drop(Staged::begin(&target).expect("begun"));
        assert!(target.join("truth.csv").exists());
        assert_eq!(around(&target), ["flight"]);
    }

    #[test]
    fn runs_at_the_same_time_do_not_touch_each_other() {
        let target = place("both");
        let [first, second] = [(); 2].map(|()| Staged::begin(&target).expect("begun"));
        assert_eq!(around(&target), [".flight.1.partial", ".flight.2.partial"]);
        for (staged, name) in [(&first, "truth.csv"), (&second, "estimate.csv")] {
            staged.folder().text("provenance.toml", "").expect("written");
            staged.folder().text(name, "").expect("written");
        }
        assert_eq!(second.finish().expect("written"), "estimate.csv, provenance.toml");
        assert_eq!(first.finish().expect("written"), "provenance.toml, truth.csv");
        assert_eq!(around(&target), ["flight"]);
        assert!(target.join("truth.csv").exists() && !target.join("estimate.csv").exists(), "the last to end stays");
    }

    #[test]
    fn only_folders_of_that_target_are_taken_for_stale() {
        for name in ["flight", ".flight.partial", ".flight.x.partial", ".flight.2.1.partial", ".other.1.partial"] {
            assert!(!is_staging(Path::new(name), "flight"), "{name}");
        }
        assert!(is_staging(Path::new("runs/.flight.12.partial"), "flight"));
    }
}
