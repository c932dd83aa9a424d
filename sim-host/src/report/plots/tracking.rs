//! How a flight followed its reference: position and attitude with their errors, and phase portraits.

use std::path::{Path, PathBuf};

use anyhow::Result;
use firmware::control::sliding::{AxisGains, SlidingAxis};
use firmware::schedule::OUTER;
use firmware::signals::TICK_S;

use super::axis::{Quantity, Unit};
use super::flight::{Figures, Kind};
use super::page::{grid, save, size_of};
use super::panel::{ANGLES, DIRECTIONS, POSITIONS, Panel};
use super::series::{BREAK, Points, angle_over_time, angles_deg, gaps, over_time, phase, thin_series};
use super::style::{Key, Role, palette};
use crate::record::Row;
use crate::report::metrics::{TRACKING_FROM_S, angle_errors, errors};

/// Height of a panel.
const PANEL: u32 = 235;
/// An error that shrinks by this much after the approach is shown once more from then on.
const SHRINKS: f64 = 8.0;
/// A position error that never exceeds this is noise, and its portrait a dot, m.
const PORTRAIT_FROM_M: f64 = 1e-3;

const SURFACE_ROLE: Role = Role::Series(palette::GREEN);
/// The legend of a sliding surface.
pub(super) const SURFACE: Key = Key::Line("surface s = 0", SURFACE_ROLE);

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
    let demanded = &demanded(figures.rows);
    let absolute = |axis: usize| {
        let desired = |row: &Row| {
            if figures.backdrop.flies(row.t) { row.desired_attitude[axis].to_degrees() } else { f64::NAN }
        };
        let lines = vec![
            (Role::Reference, angle_over_time(demanded, desired)),
            (Role::Flown, angle_over_time(figures.rows, |row| angles_deg(row)[axis])),
        ];
        Panel::over_time(ANGLES[axis], Quantity::new(ANGLES[axis], Unit::Degree).at_least(2.0), lines)
    };
    let error: ErrorOf = |row, axis| angle_errors(row)[axis].to_degrees();
    let path = folder.join("attitude.svg");
    save_pairs(&path, figures, "Attitude and its error", demanded, absolute, (ANGLES, Unit::Degree, error))?;
    Ok(path)
}

/// The rows whose attitude is what the law follows: those with a new one, and those at which it has stood still for a
/// period of the outer loop. Between two new ones the law extrapolates, and the row does not say how.
fn demanded(rows: &[Row]) -> Vec<Row> {
    // Half a tick less than the period, for rounding.
    let period = f64::from(TICK_S) * (f64::from(OUTER.period) - 0.5);
    let (mut before, mut since) = (rows.first().copied(), f64::NEG_INFINITY);
    let mut follows = |row: &Row| {
        let is_new = before.is_some_and(|before| before.desired_attitude != row.desired_attitude);
        (before, since) = (Some(*row), if is_new { row.t } else { since });
        is_new || row.t - since > period
    };
    rows.iter().filter(|row| follows(row)).copied().collect()
}

/// Error rate over error of x, y and z. Returns the file written.
///
/// # Errors
/// As [`position`].
pub(super) fn portraits(folder: &Path, figures: &Figures) -> Result<PathBuf> {
    let panel = |axis: usize| {
        let panel = phase_panel(figures.rows, axis);
        figures.surfaces.map_or(panel.clone(), |gains| with_surface(panel, &gains[axis]))
    };
    let panels: Vec<_> = errs(figures.rows).map(panel).collect();
    let columns = panels.len().max(1);
    let path = folder.join("phase.svg");
    let heading = figures.heading("Phase portraits of the position error");
    let jumps = panels.iter().any(Panel::jumps).then_some(Key::Jump);
    let surface = figures.surfaces.map(|_| SURFACE);
    let legend: Vec<Key> = [Key::Flown, Key::Start].into_iter().chain(surface).chain(jumps).collect();
    save(&path, size_of(1, 400), &heading, &legend, |area| grid(area, columns, &panels))?;
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
    let points = phase(rows, axis);
    let lines = vec![(Role::Jump, gaps(&points)), (Role::Flown, points)];
    Panel { lines, ..Panel::path(name, error, rate, vec![]) }
}

/// A phase portrait with the surface s = 0 on which it ends, as far as rates like those flown go.
pub(super) fn with_surface(panel: Panel, gains: &AxisGains) -> Panel {
    /// From one end to the other.
    const SAMPLES: u32 = 200;
    let flown = || panel.lines.iter().flat_map(|(_, points)| points).filter(|point| point.0.is_finite());
    let range = |values: &mut dyn Iterator<Item = f64>| {
        values.fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)))
    };
    let (left, right) = range(&mut flown().map(|point| point.0));
    let (low, high) = range(&mut flown().map(|point| point.1));
    // A little further than it is slid along, so that it shows.
    let (steepest, over) = (1.15 * low.min(-high), 0.6 * high.max(-low));
    let mut axis = SlidingAxis::new(gains, TICK_S);
    let (left, width) = (left - 0.1 * (right - left), 1.2 * (right - left));
    let error = |i: u32| left + width * f64::from(i) / f64::from(SAMPLES);
    // At rest s is λ e, or what stands for it far away; on the surface ė is as much the other way.
    let mut on_surface = |error: f64| (error, -f64::from(axis.correction(error as f32, 0.0, true).s));
    let line: Points =
        (0..=SAMPLES).map(|i| on_surface(error(i))).filter(|(_, rate)| (steepest..=over).contains(rate)).collect();
    let lines = std::iter::once((SURFACE_ROLE, line)).chain(panel.lines.iter().cloned()).collect();
    Panel { lines, ..panel }
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
    figures.rows.iter().filter(|row| !row.reference_is_held).copied().collect()
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;

    use super::super::tests::{draw_all, figures};
    use super::*;

    /// A pitch of 40° demanded at 1 s, and a push at 0.4 s that pitches the vehicle to 86° for a tick.
    fn pushed_before_a_step() -> Vec<Row> {
        let row = |k: u32| {
            let pitch = if k == 400 { 86.0_f64 } else { 0.0 };
            let q = UnitQuaternion::from_euler_angles(0.0, pitch.to_radians(), 0.0);
            let desired_attitude = [0.0, if k < 1000 { 0.0 } else { 40_f64.to_radians() }, 0.0];
            Row { t: f64::from(k) * 1e-3, attitude: [q.w, q.i, q.j, q.k], desired_attitude, ..Row::default() }
        };
        (0..1100).map(row).collect()
    }

    #[test]
    fn a_demand_that_stands_still_is_drawn_level() {
        let rows = demanded(&pushed_before_a_step());
        let pitch = |row: &Row| (row.t, row.desired_attitude[1].to_degrees().round());
        let ramps: Vec<_> = rows.windows(2).filter(|pair| pitch(&pair[0]).1 != pitch(&pair[1]).1).collect();
        assert_eq!(ramps.len(), 1);
        assert_eq!((pitch(&ramps[0][0]), pitch(&ramps[0][1])), ((0.999, 0.0), (1.0, 40.0)));
        // The three rows between the new demand and the outer loop's next output say nothing; all others do.
        assert_eq!(rows.len(), 1100 - 3);
    }

    #[test]
    fn a_peak_of_what_was_flown_is_drawn_while_the_demand_stands_still() {
        let rows = pushed_before_a_step();
        let figures = Figures { disturbance: None, ..figures(&rows) };
        let drawn = draw_all("pushed", &figures);
        let (_, attitude) = drawn.iter().find(|(name, _)| name == "attitude.svg").expect("it was drawn");
        // Of an axis that ends at the demanded 40° the highest tick would be 40.
        assert!(attitude.contains(">80<"), "the axis of pitch reaches the peak of 86°");
    }
}
