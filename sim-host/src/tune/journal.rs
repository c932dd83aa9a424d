//! The journal of a run: every evaluated point and its cost, in order, one per line.
//!
//! A search evaluates the same points when it gets the same costs. So a run is resumed by repeating the search with the
//! recorded costs: that takes no time, is bit-exact, and works with every optimiser.

use std::fs::{File, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, ensure};

use crate::files::read_regular;

/// Larger journals are refused, bytes: tens of millions of points.
const LARGEST: u64 = 1 << 32;

/// Points and costs of a run so far, in memory and in a file.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    known: Vec<(Vec<f64>, f64)>,
    replayed: usize,
}

impl Journal {
    /// A new journal. `identity` distinguishes the run from others, `names` are those of the coordinates.
    ///
    /// # Errors
    /// The file exists already, or cannot be written.
    pub fn create(path: &Path, identity: &str, names: &[&str]) -> Result<Self> {
        ensure!(
            !path.exists(),
            "{} is there: add --resume to go on with that run, or choose another folder with --out",
            path.display()
        );
        let mut file = File::create(path).with_context(|| cannot("write", path))?;
        file.write_all(header(identity, names).as_bytes()).with_context(|| cannot("write", path))?;
        Ok(Self { path: path.to_owned(), file, known: Vec::new(), replayed: 0 })
    }

    /// The journal of a run to be resumed. An incomplete last line is removed.
    ///
    /// # Errors
    /// The file cannot be read, or belongs to another run.
    pub fn resume(path: &Path, identity: &str, names: &[&str]) -> Result<Self> {
        let text = read_regular(path, LARGEST).with_context(|| cannot("resume from", path))?;
        let rows = text.strip_prefix(&header(identity, names)).ok_or_else(|| {
            anyhow!(
                "{} is another run's: tune, course, method, particles or seed differ; choose another folder with --out",
                path.display()
            )
        })?;
        let whole = rows.rfind('\n').map_or(0, |end| end + 1);
        let known = rows[..whole].lines().map(|line| parse(line, names.len())).collect::<Option<_>>();
        let known = known.ok_or_else(|| anyhow!("{} is damaged: choose another folder with --out", path.display()))?;
        let file = OpenOptions::new().append(true).open(path).with_context(|| cannot("write", path))?;
        file.set_len((text.len() - rows.len() + whole) as u64).with_context(|| cannot("write", path))?;
        Ok(Self { path: path.to_owned(), file, known, replayed: 0 })
    }

    /// The cost of the next point, if it is known.
    ///
    /// # Errors
    /// The journal has another point in its place: it was written by a different program.
    pub(super) fn recall(&mut self, point: &[f64]) -> Result<Option<f64>> {
        let Some((known, cost)) = self.known.get(self.replayed) else { return Ok(None) };
        ensure!(
            known == point,
            "{} was written by another version of the program: choose another folder with --out",
            self.path.display()
        );
        self.replayed += 1;
        Ok(Some(*cost))
    }

    /// Records a new cost.
    ///
    /// # Errors
    /// When the file cannot be written; the message names it.
    pub(super) fn append(&mut self, points: &[Vec<f64>], costs: &[f64]) -> Result<()> {
        // `to_string` is the shortest decimal that reads back exactly.
        let line = |(point, cost): (&Vec<f64>, &f64)| {
            let numbers: Vec<String> = [cost].into_iter().chain(point).map(f64::to_string).collect();
            numbers.join(",") + "\n"
        };
        let lines: Vec<String> = points.iter().zip(costs).map(line).collect();
        self.file.write_all(lines.concat().as_bytes()).with_context(|| cannot("write", &self.path))
    }
}

fn header(identity: &str, names: &[&str]) -> String {
    format!("# run {identity}; coordinates from 0 for low to 1 for high\ncost,{}\n", names.join(","))
}

fn cannot(act: &str, path: &Path) -> String {
    format!("cannot {act} {}", path.display())
}

fn parse(line: &str, dimensions: usize) -> Option<(Vec<f64>, f64)> {
    let numbers: Vec<f64> = line.split(',').map(|text| text.parse().ok()).collect::<Option<_>>()?;
    let (cost, point) = numbers.split_first()?;
    (point.len() == dimensions).then(|| (point.to_vec(), *cost))
}
