//! The figures of a flight, drawn after the paper's Figures 2–7, as SVG files that any browser shows.
//!
//! Each figure is a function over the rows, plus what rows do not hold. Axes are named as in truth.csv, angles are in
//! degrees. The reference is a wide light line below a thin dark one, so that both show where they agree. Long
//! series are thinned without losing their peaks, so that a file stays below 300 kB.

pub mod analysis;
pub mod comparison;
mod convergence;
pub mod estimate;
mod helix;
mod panel;
mod series;

use std::path::{Path, PathBuf};

use anyhow::Result;

pub use self::convergence::convergence;
use self::panel::{Key, Panel, Role, grid, save};
use self::series::{Points, angles_deg, over_time, phase, thin_path, thin_series};
use super::metrics::errors;
use super::timeline::Timeline;
use crate::record::Row;

/// The approach, shown where a whole flight would hide it, s.
const APPROACH_S: f64 = 4.0;
/// Shown before a disturbance sets in and after it ends, s.
const AROUND_DISTURBANCE_S: f64 = 1.0;

const WIDE: (u32, u32) = (1100, 760);
const TALL: (u32, u32) = (1100, 1040);

/// A disturbance as it was applied, for [`disturbance`].
#[derive(Clone, Copy, Debug)]
pub struct Disturbance<'a> {
    /// Time (s) and x, y, z, roll, pitch, yaw in the units below.
    pub samples: &'a [(f64, [f64; 6])],
    /// What x, y and z hold, such as `m/s²`.
    pub linear_unit: &'a str,
    /// What roll, pitch and yaw hold, such as `rad/s²`.
    pub angular_unit: &'a str,
    /// From when to when it acts, s.
    pub acting: (f64, f64),
}

/// Everything that a flight's figures need.
#[derive(Clone, Copy, Debug)]
pub struct Figures<'a> {
    /// The flight.
    pub rows: &'a [Row],
    /// The disturbance, where there is one; without, Figures 5 and 6 are left out.
    pub disturbance: Option<Disturbance<'a>>,
    /// What the vehicle did when.
    pub timeline: &'a Timeline,
}

impl Figures<'_> {
    /// Draws every figure that applies into `folder`. Returns the files written, in the paper's order.
    ///
    /// # Errors
    /// When a file cannot be written; the message names it.
    pub fn draw(&self, folder: &Path) -> Result<Vec<PathBuf>> {
        let rows = self.rows;
        let mut files = vec![altitude(folder, rows)?, position(folder, rows)?, attitude(folder, rows)?];
        if let Some(applied) = &self.disturbance {
            files.push(disturbance(folder, applied)?);
            files.push(disturbed(folder, rows, applied.acting)?);
        }
        files.push(helix(folder, rows)?);
        Ok(files)
    }
}

/// Figure 2: altitude, its error during the approach, phase portrait, thrust. Returns the file written.
///
/// # Errors
/// When the file cannot be written; the message names it. So for every figure.
pub fn altitude(folder: &Path, rows: &[Row]) -> Result<PathBuf> {
    let approach = approach(rows);
    let error = over_time(approach, |row| errors(row)[2]);
    let panels = [
        Panel::over_time("altitude", "z, m", tracking(rows, 2)),
        Panel::over_time("altitude error during the approach", "z error, m", vec![(Role::Flown, error)]),
        phase_panel(rows, 2),
        Panel::over_time("thrust demanded", "U1, N", vec![(Role::Flown, over_time(rows, |row| row.u[0]))]),
    ];
    let path = folder.join("fig2-altitude.svg");
    save(&path, WIDE, "Altitude (paper's Figure 2)", &FOLLOWING_A_PATH, |area| grid(area, 2, &panels))?;
    Ok(path)
}

/// Figure 3: x and y, and their phase portraits. Returns the file written.
///
/// # Errors
/// As [`altitude`].
pub fn position(folder: &Path, rows: &[Row]) -> Result<PathBuf> {
    let panels = [
        Panel::over_time("position north", "x, m", tracking(rows, 0)),
        Panel::over_time("position west", "y, m", tracking(rows, 1)),
        phase_panel(rows, 0),
        phase_panel(rows, 1),
    ];
    let path = folder.join("fig3-position.svg");
    save(&path, WIDE, "Position (paper's Figure 3)", &FOLLOWING_A_PATH, |area| grid(area, 2, &panels))?;
    Ok(path)
}

/// Figure 4: roll, pitch and yaw beside the torques demanded. Returns the file written.
///
/// # Errors
/// As [`altitude`].
pub fn attitude(folder: &Path, rows: &[Row]) -> Result<PathBuf> {
    let panels: Vec<_> = (0..3)
        .flat_map(|axis| {
            let torque = over_time(rows, |row| row.u[axis + 1]);
            let (title, up) = (format!("{} torque demanded", ANGLES[axis]), format!("U{}, N m", axis + 2));
            [angle_panel(rows, axis), Panel::over_time(&title, &up, vec![(Role::Flown, torque)])]
        })
        .collect();
    let path = folder.join("fig4-attitude.svg");
    let legend = [Key::Reference, Key::Flown];
    save(&path, TALL, "Attitude (paper's Figure 4)", &legend, |area| grid(area, 2, &panels))?;
    Ok(path)
}

/// Figure 5: the disturbance as it was applied. Returns the file written.
///
/// # Errors
/// As [`altitude`].
pub fn disturbance(folder: &Path, applied: &Disturbance) -> Result<PathBuf> {
    let panel = |axis: usize| {
        let points = thin_series(applied.samples.iter().map(|(t, sample)| (*t, sample[axis])).collect());
        let (name, unit) = match axis {
            0..3 => (POSITIONS[axis], applied.linear_unit),
            _ => (ANGLES[axis - 3], applied.angular_unit),
        };
        Panel::over_time(&format!("disturbance in {name}"), unit, vec![(Role::Flown, points)])
    };
    let panels = columns(panel);
    let path = folder.join("fig5-disturbance.svg");
    save(&path, TALL, "Gaussian disturbance (paper's Figure 5)", &[], |area| grid(area, 2, &panels))?;
    Ok(path)
}

/// Figure 6: all six coordinates around a disturbance that acts during `acting` (s, from and to). Returns the file
/// written.
///
/// # Errors
/// As [`altitude`].
pub fn disturbed(folder: &Path, rows: &[Row], acting: (f64, f64)) -> Result<PathBuf> {
    let first = rows.partition_point(|row| row.t < acting.0 - AROUND_DISTURBANCE_S);
    let last = rows.partition_point(|row| row.t <= acting.1 + AROUND_DISTURBANCE_S).max(first);
    let shown = &rows[first..last];
    let panel = |axis: usize| {
        let panel = match axis {
            0..3 => Panel::over_time(POSITIONS[axis], &format!("{}, m", POSITIONS[axis]), tracking(shown, axis)),
            _ => angle_panel(shown, axis - 3),
        };
        Panel { shaded: Some(acting), ..panel }
    };
    let panels = columns(panel);
    let path = folder.join("fig6-disturbed.svg");
    let legend = [Key::Disturbed, Key::Reference, Key::Flown];
    save(&path, TALL, "Tracking under disturbance (paper's Figure 6)", &legend, |area| grid(area, 2, &panels))?;
    Ok(path)
}

/// Figure 7: the path in space and from above. Returns the file written.
///
/// # Errors
/// As [`altitude`].
pub fn helix(folder: &Path, rows: &[Row]) -> Result<PathBuf> {
    let from_above = |reference: bool| {
        let place = |row: &Row| {
            if reference { (row.reference[0], row.reference[1]) } else { (row.position[0], row.position[1]) }
        };
        thin_path(rows.iter().map(place).collect())
    };
    let lines = vec![(Role::Reference, from_above(true)), (Role::Flown, from_above(false))];
    let above = Panel { lines, equal_scales: true, ..Panel::path("from above", "x (north), m", "y (west), m", vec![]) };
    let path = folder.join("fig7-helix.svg");
    save(&path, (1100, 820), "Path in space (paper's Figure 7)", &FOLLOWING_A_PATH, |area| {
        let (left, right) = area.split_horizontally(panel::px(600));
        helix::draw(&left, rows)?;
        above.draw(&right.margin(panel::px(110), panel::px(110), 0, 0))
    })?;
    Ok(path)
}

const POSITIONS: [&str; 3] = ["x", "y", "z"];
const ANGLES: [&str; 3] = ["roll", "pitch", "yaw"];
const FOLLOWING_A_PATH: [Key; 3] = [Key::Reference, Key::Flown, Key::Start];

/// Six panels in two columns: positions left, angles right.
fn columns(panel: impl Fn(usize) -> Panel) -> [Panel; 6] {
    [0, 3, 1, 4, 2, 5].map(panel)
}

/// The rows of the approach.
fn approach(rows: &[Row]) -> &[Row] {
    &rows[..rows.partition_point(|row| row.t <= APPROACH_S)]
}

fn tracking(rows: &[Row], axis: usize) -> Vec<(Role, Points)> {
    let reference = over_time(rows, |row| row.reference[axis]);
    vec![(Role::Reference, reference), (Role::Flown, over_time(rows, |row| row.position[axis]))]
}

fn phase_panel(rows: &[Row], axis: usize) -> Panel {
    let name = POSITIONS[axis];
    let title = format!("phase portrait of {name}");
    Panel::path(&title, &format!("{name} error, m"), &format!("{name} error rate, m/s"), phase(rows, axis))
}

fn angle_panel(rows: &[Row], axis: usize) -> Panel {
    let reference = over_time(rows, |row| row.desired_attitude[axis].to_degrees());
    let flown = over_time(rows, |row| angles_deg(row)[axis]);
    let lines = vec![(Role::Reference, reference), (Role::Flown, flown)];
    Panel::over_time(ANGLES[axis], &format!("{}, °", ANGLES[axis]), lines)
}

#[cfg(test)]
pub(super) mod tests;
