//! What the controller demanded, and how fast the rotors turned.

use std::path::{Path, PathBuf};

use anyhow::Result;

use super::axis::{Quantity, Unit};
use super::flight::Figures;
use super::page::{grid, save, size_of};
use super::panel::{ANGLES, Panel};
use super::series::over_time;
use super::style::{Key, Role, palette};
use crate::record::Row;

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
    let panels = [thrust, pair(rows, 0), torque(0), pair(rows, 2), torque(1), torque(2)].map(|panel| Panel {
        span: figures.span(),
        shaded: figures.disturbance.as_ref().map(|disturbance| disturbance.acting),
        backdrop: figures.backdrop.clone(),
        ..panel
    });
    let path = folder.join("rotors.svg");
    let [first, second] = PAIR;
    let legend: Vec<Key> = figures
        .backdrop
        .keys()
        .into_iter()
        .chain([Key::Line("rotor 1, 3", first), Key::Line("rotor 2, 4", second)])
        .collect();
    let heading = figures.heading("Thrust and torques demanded, rotor speeds");
    save(&path, size_of(3, 235), &heading, &legend, |area| grid(area, 2, &panels))?;
    Ok(path)
}

fn demand(rows: &[Row], index: usize, title: &str, up: Quantity) -> Panel {
    Panel::over_time(title, up, vec![(Role::Flown, over_time(rows, |row| row.u[index]))])
}

/// The speeds of two rotors.
fn pair(rows: &[Row], first: usize) -> Panel {
    let speed = |rotor: usize| over_time(rows, |row| row.omega[rotor]);
    let lines = vec![(PAIR[0], speed(first)), (PAIR[1], speed(first + 1))];
    let title = format!("rotors {} and {}", first + 1, first + 2);
    Panel::over_time(&title, Quantity::new("speed", Unit::RadianPerSecond), lines)
}
