//! What the controller demanded, and how fast the rotors turned.

use std::path::{Path, PathBuf};

use anyhow::Result;

use super::axis::{Quantity, Unit};
use super::flight::Figures;
use super::page::{grid, save, size_of};
use super::panel::{ANGLES, Panel};
use super::series::over_time;
use super::style::{Role, palette};
use crate::record::Row;

const NAMES: [&str; 4] = ["1", "2", "3", "4"];
/// The first and the second of two rotors that share a panel.
const PAIR: [Role; 2] = [Role::Series(palette::ORANGE), Role::Flown];

/// Thrust and torques demanded beside the rotors' speeds. Returns the file written.
///
/// # Errors
/// When the file cannot be written; the message names it.
pub(super) fn rotors(folder: &Path, figures: &Figures) -> Result<PathBuf> {
    let rows = figures.rows;
    let thrust = demand(rows, 0, "thrust demanded", Quantity::new("U1", Unit::Newton));
    let torque = |axis: usize| {
        let unit = Quantity::new(format!("U{}", axis + 2), Unit::NewtonMetre);
        demand(rows, axis + 1, &format!("{} torque demanded", ANGLES[axis]), unit)
    };
    let panels = [thrust, pair(rows, 0), torque(0), pair(rows, 2), torque(1), torque(2)];
    let place = |panel: Panel| Panel {
        span: figures.span(),
        shaded: figures.disturbance.as_ref().map(|disturbance| disturbance.acting),
        backdrop: figures.backdrop.clone(),
        ..panel
    };
    let panels: Vec<_> = panels.into_iter().map(place).collect();
    let path = folder.join("rotors.svg");
    let legend = figures.backdrop.keys();
    let heading = figures.heading("Thrust and torques demanded, rotor speeds");
    save(&path, size_of(panels.len().div_ceil(2), 235), &heading, &legend, |area| grid(area, 2, &panels))?;
    Ok(path)
}

/// Whether a rotor ever turns.
pub(super) fn turn(rows: &[Row]) -> bool {
    rows.iter().any(|row| row.omega.iter().any(|omega| *omega != 0.0))
}

fn demand(rows: &[Row], index: usize, title: &str, up: Quantity) -> Panel {
    Panel::over_time(title, up, vec![(Role::Flown, over_time(rows, |row| row.u[index]))])
}

/// The speeds of two rotors.
fn pair(rows: &[Row], first: usize) -> Panel {
    let speed = |rotor: usize| over_time(rows, |row| row.omega[rotor]);
    let lines = vec![(PAIR[0], speed(first)), (PAIR[1], speed(first + 1))];
    let title = format!("rotors {} and {}", first + 1, first + 2);
    let keys = vec![(NAMES[first], PAIR[0]), (NAMES[first + 1], PAIR[1])];
    let panel = Panel::over_time(&title, Quantity::new("speed", Unit::RadianPerSecond), lines);
    Panel { keys, ..panel }
}
