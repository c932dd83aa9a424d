//! A disturbance as it was applied, and the errors while it acts.

use std::path::{Path, PathBuf};

use anyhow::Result;

use super::axis::{Quantity, Unit};
use super::flight::{Disturbance, Figures};
use super::page::{grid, save, size_of};
use super::panel::{ANGLES, POSITIONS, Panel};
use super::series::{over_time, thin_series};
use super::style::{Key, Role};
use crate::record::Row;
use crate::report::metrics::{angle_errors, errors};

/// Shown before a disturbance sets in and after it ends, s.
const AROUND_S: f64 = 1.0;
/// Height of a panel.
const PANEL: u32 = 235;

/// The disturbance as it was applied. Returns the file written.
///
/// # Errors
/// When the file cannot be written; the message names it. So for every figure.
pub(super) fn disturbance(folder: &Path, figures: &Figures, applied: &Disturbance) -> Result<PathBuf> {
    let panels = columns(|axis| Panel { span: figures.span(), ..applied_panel(applied, axis) });
    let path = folder.join("disturbance.svg");
    let of = if applied.on_accelerations { "accelerations" } else { "what sensors give out" };
    let heading = figures.heading(&format!("Disturbance of the {of}").replace("the what", "what"));
    save(&path, size_of(3, PANEL), &heading, &[Key::Disturbed], |area| grid(area, 2, &panels))?;
    Ok(path)
}

/// One axis of the disturbance.
pub(super) fn applied_panel(applied: &Disturbance, axis: usize) -> Panel {
    let (name, unit) = match (axis, applied.on_accelerations) {
        (0..3, true) => (POSITIONS[axis], Unit::Acceleration("m/s²")),
        (0..3, false) => (POSITIONS[axis], Unit::Metre),
        (_, true) => (ANGLES[axis - 3], Unit::Acceleration("rad/s²")),
        (_, false) => (ANGLES[axis - 3], Unit::Degree),
    };
    let scale = if unit == Unit::Degree { 1_f64.to_degrees() } else { 1.0 };
    let points = thin_series(applied.samples.iter().map(|(t, sample)| (*t, scale * sample[axis])).collect());
    let panel = Panel::over_time(name, Quantity::new("disturbance", unit), vec![(Role::Flown, points)]);
    Panel { shaded: Some(applied.acting), ..panel }
}

/// All six errors around a disturbance that acts during `acting` (s, from and to). Returns the file written.
///
/// # Errors
/// As [`disturbance`].
pub(super) fn disturbed(folder: &Path, figures: &Figures, acting: (f64, f64)) -> Result<PathBuf> {
    let panels = columns(|axis| Panel { shaded: Some(acting), ..error_panel(around(figures.rows, acting), axis) });
    let path = folder.join("disturbed.svg");
    let heading = figures.heading("Errors while the disturbance acts: reference − flown");
    save(&path, size_of(3, PANEL), &heading, &[Key::Disturbed], |area| grid(area, 2, &panels))?;
    Ok(path)
}

/// The rows from shortly before a disturbance to shortly after it.
fn around(rows: &[Row], acting: (f64, f64)) -> &[Row] {
    let first = rows.partition_point(|row| row.t < acting.0 - AROUND_S);
    let last = rows.partition_point(|row| row.t <= acting.1 + AROUND_S).max(first);
    &rows[first..last]
}

/// The error of x, y, z, roll, pitch or yaw.
pub(super) fn error_panel(rows: &[Row], axis: usize) -> Panel {
    let (name, unit) = if axis < 3 { (POSITIONS[axis], Unit::Metre) } else { (ANGLES[axis - 3], Unit::Degree) };
    let error = |row: &Row| if axis < 3 { errors(row)[axis] } else { angle_errors(row)[axis - 3].to_degrees() };
    // What the paper's gains leave of a disturbance is smaller than what is worth showing of a flight elsewhere.
    let least = if axis < 3 { 1e-4 } else { 4e-3 };
    let up = Quantity::new(format!("{name} error"), unit).at_least(least);
    Panel::over_time(name, up, vec![(Role::Flown, over_time(rows, error))])
}

/// Six panels in two columns: positions left, angles right.
fn columns(panel: impl Fn(usize) -> Panel) -> [Panel; 6] {
    [0, 3, 1, 4, 2, 5].map(panel)
}
