//! How a flight followed its reference: position and attitude with their errors, and phase portraits.

use std::path::{Path, PathBuf};

use anyhow::Result;

use super::axis::{Quantity, Unit};
use super::flight::{Figures, Kind};
use super::page::{grid, save, size_of};
use super::panel::{ANGLES, DIRECTIONS, POSITIONS, Panel};
use super::series::{BREAK, Points, angle_over_time, angles_deg, over_time, phase, thin_series};
use super::style::{Key, Role};
use crate::record::Row;
use crate::report::metrics::{TRACKING_FROM_S, angle_errors, errors};

/// Height of a panel.
const PANEL: u32 = 235;
/// An error that shrinks by this much after the approach is shown once more from then on.
const SHRINKS: f64 = 8.0;
/// A position error that never exceeds this is noise, and its portrait a dot, m.
const PORTRAIT_FROM_M: f64 = 1e-3;
/// A pilot's flight has a new reference as often, ticks (from tick 2 on): between, the reference stands still.
const NEW_REFERENCE: (u64, u64) = (4, 2);

/// The error of one axis in the unit of its panel, of a row.
type ErrorOf = fn(&Row, usize) -> f64;

/// Position and its error. Returns the file written.
///
/// # Errors
/// When the file cannot be written; the message names it. So for every figure.
pub(super) fn position(folder: &Path, figures: &Figures) -> Result<PathBuf> {
    let rows = with_new_reference(figures);
    let absolute = |axis: usize| {
        let name = format!("{} ({})", POSITIONS[axis], DIRECTIONS[axis]);
        let lines = vec![
            (Role::Reference, while_flying(figures, &rows, |row| row.reference[axis])),
            (Role::Flown, over_time(&rows, |row| row.position[axis])),
        ];
        Panel::over_time(&name, Quantity::place(POSITIONS[axis]), lines)
    };
    let error: ErrorOf = |row, axis| errors(row)[axis];
    let path = folder.join("position.svg");
    save_pairs(&path, figures, "Position and its error", &rows, absolute, (POSITIONS, Unit::Metre, error))?;
    Ok(path)
}

/// Attitude and its error. Returns the file written.
///
/// # Errors
/// As [`position`].
pub(super) fn attitude(folder: &Path, figures: &Figures) -> Result<PathBuf> {
    let rows = &with_new_target(figures.rows);
    let absolute = |axis: usize| {
        let desired = |row: &Row| {
            if figures.backdrop.flies(row.t) { row.desired_attitude[axis].to_degrees() } else { f64::NAN }
        };
        let lines = vec![
            (Role::Reference, angle_over_time(rows, desired)),
            (Role::Flown, angle_over_time(rows, |row| angles_deg(row)[axis])),
        ];
        Panel::over_time(ANGLES[axis], Quantity::new(ANGLES[axis], Unit::Degree).at_least(2.0), lines)
    };
    let error: ErrorOf = |row, axis| angle_errors(row)[axis].to_degrees();
    let path = folder.join("attitude.svg");
    save_pairs(&path, figures, "Attitude and its error", rows, absolute, (ANGLES, Unit::Degree, error))?;
    Ok(path)
}

/// The rows at which a new attitude was demanded: until the next, the law extrapolates it, and the row does not say
/// how. All rows where it never changes.
fn with_new_target(rows: &[Row]) -> Vec<Row> {
    let new = rows.windows(2).filter(|pair| pair[0].desired_attitude != pair[1].desired_attitude);
    let first = rows.first().copied();
    let kept: Vec<Row> = first.into_iter().chain(new.map(|pair| pair[1])).collect();
    if kept.len() > 1 { kept } else { rows.to_vec() }
}

/// Error rate over error of x, y and z. Returns the file written.
///
/// # Errors
/// As [`position`].
pub(super) fn portraits(folder: &Path, figures: &Figures) -> Result<PathBuf> {
    let panels: Vec<_> = errs(figures.rows).map(|axis| phase_panel(figures.rows, axis)).collect();
    let columns = panels.len().max(1);
    let path = folder.join("phase.svg");
    let heading = figures.heading("Phase portraits of the position error");
    save(&path, size_of(1, 400), &heading, &[Key::Flown, Key::Start], |area| grid(area, columns, &panels))?;
    Ok(path)
}

/// The axes whose error is ever worth a portrait.
pub(super) fn errs(rows: &[Row]) -> impl Iterator<Item = usize> + '_ {
    (0..3).filter(|axis| rows.iter().any(|row| errors(row)[*axis].abs() > PORTRAIT_FROM_M))
}

/// The phase portrait of one axis' error.
pub(super) fn phase_panel(rows: &[Row], axis: usize) -> Panel {
    let name = POSITIONS[axis];
    let (error, rate) = (format!("{name} error"), format!("{name} error rate"));
    let (error, rate) = (Quantity::new(error, Unit::Metre), Quantity::new(rate, Unit::MetrePerSecond));
    Panel::path(name, error, rate, phase(rows, axis))
}

/// Saves a row of panels for each axis: what was flown beside the reference, the error, and, where the approach would
/// hide it, the error after the approach.
fn save_pairs(
    path: &Path,
    figures: &Figures,
    title: &str,
    rows: &[Row],
    absolute: impl Fn(usize) -> Panel,
    (names, unit, error): ([&str; 3], Unit, ErrorOf),
) -> Result<()> {
    let tracked = &rows[rows.partition_point(|row| row.t < TRACKING_FROM_S)..];
    let approaches = figures.kind != Kind::Piloted && (0..3).any(|axis| shrinks(rows, tracked, |row| error(row, axis)));
    let panel = |rows: &[Row], axis: usize, title: &str| {
        let error = |row: &Row| if figures.backdrop.flies(row.t) { error(row, axis) } else { f64::NAN };
        let error = if unit == Unit::Degree { angle_over_time(rows, error) } else { over_time(rows, error) };
        let line = vec![(Role::Flown, error)];
        Panel::over_time(title, Quantity::new(format!("{} error", names[axis]), unit), line)
    };
    let of_axis = |axis: usize| {
        let whole = [absolute(axis), panel(rows, axis, "reference − flown")].map(|panel| Panel {
            span: figures.span(),
            shaded: acting(figures),
            backdrop: figures.backdrop.clone(),
            ..panel
        });
        let after = format!("the same after {TRACKING_FROM_S} s");
        let after = Panel { shaded: acting(figures), ..panel(tracked, axis, &after) };
        whole.into_iter().chain(approaches.then_some(after))
    };
    let panels: Vec<Panel> = (0..3).flat_map(of_axis).collect();
    let legend: Vec<Key> = acting(figures)
        .map(|_| Key::Disturbed)
        .into_iter()
        .chain(figures.backdrop.keys())
        .chain([Key::Reference, Key::Flown])
        .collect();
    let columns = panels.len() / 3;
    save(path, size_of(3, PANEL), &figures.heading(title), &legend, |area| grid(area, columns, &panels))
}

/// While the disturbance acts.
fn acting(figures: &Figures) -> Option<(f64, f64)> {
    figures.disturbance.as_ref().map(|disturbance| disturbance.acting)
}

/// Whether the greatest error is much smaller once the approach is over.
fn shrinks(rows: &[Row], tracked: &[Row], error: impl Fn(&Row) -> f64) -> bool {
    let most = |rows: &[Row]| rows.iter().map(|row| error(row).abs()).fold(0.0, f64::max);
    tracked.len() > 1 && most(rows) > SHRINKS * most(tracked)
}

/// A reference or an error while the vehicle flies, interrupted where it does not.
pub(super) fn while_flying(figures: &Figures, rows: &[Row], value: impl Fn(&Row) -> f64) -> Points {
    let point = |row: &Row| if figures.backdrop.flies(row.t) { (row.t, value(row)) } else { BREAK };
    thin_series(rows.iter().map(point).collect())
}

/// The rows at which the reference is new: of a pilot's flight, those of the outer loop.
pub(super) fn with_new_reference(figures: &Figures) -> Vec<Row> {
    let (every, from) = NEW_REFERENCE;
    let is_new = |row: &&Row| figures.kind != Kind::Piloted || (row.t * 1e3).round() as u64 % every == from;
    figures.rows.iter().filter(is_new).copied().collect()
}
