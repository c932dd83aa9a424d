//! A pilot's flight over time, with its phases, faults and events.

use std::path::{Path, PathBuf};

use anyhow::Result;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::axis::{Quantity, Unit};
use super::backdrop::{Backdrop, Span, phase_color};
use super::flight::Figures;
use super::page::{grid, save, size_of};
use super::panel::Panel;
use super::series::over_time;
use super::style::{Key, Role, palette};
use super::tracking::{error_over_time, with_new_reference};
use crate::record::Row;
use crate::report::estimate::Belief;
use crate::report::metrics::errors;
use crate::scenario::Scenario;

/// Phases, faults and events of a flight.
pub(super) fn backdrop(_scenario: &Scenario, _beliefs: &[Belief]) -> Backdrop {
    Backdrop::default()
}

/// Height, distance from the reference, speed, tilt and rotors, one above the other. Returns the file written.
///
/// # Errors
/// When the file cannot be written; the message names it.
pub(super) fn flight(folder: &Path, figures: &Figures) -> Result<PathBuf> {
    let rows = figures.rows;
    let panels = [height(rows), distance(figures), speed(rows), tilt(rows), rotors(rows)];
    let last = panels.len() - 1;
    let panels: Vec<Panel> = panels.into_iter().enumerate().map(|(i, panel)| {
        let backdrop = if i == 0 { figures.backdrop.named() } else { figures.backdrop.clone() };
        let across = if i == last { panel.across.clone() } else { Quantity::from("") };
        Panel { span: figures.span(), across, backdrop, ..panel }
    }).collect();
    let path = folder.join("flight.svg");
    let legend: Vec<Key> = figures.backdrop.keys().into_iter().chain([Key::Reference, Key::Flown]).collect();
    let heading = figures.heading("The flight");
    save(&path, size_of(panels.len(), 180), &heading, &legend, |area| grid(area, 1, &panels))?;
    Ok(path)
}

fn height(rows: &[Row]) -> Panel {
    let lines = vec![
        (Role::Reference, over_time(rows, |row| row.reference[2])),
        (Role::Flown, over_time(rows, |row| row.position[2])),
    ];
    Panel::over_time("height", Quantity::place("z"), lines)
}

fn distance(figures: &Figures) -> Panel {
    let rows = with_new_reference(figures);
    let distance = |row: &Row| {
        let [x, y, z, _] = errors(row);
        Vector3::new(x, y, z).norm()
    };
    let line = error_over_time(figures, &rows, distance);
    Panel::over_time("distance from the reference", Quantity::new("distance", Unit::Metre), vec![(Role::Flown, line)])
}

fn speed(rows: &[Row]) -> Panel {
    let over_ground = over_time(rows, |row| libm::hypot(row.velocity[0], row.velocity[1]));
    let up = over_time(rows, |row| row.velocity[2]);
    let lines = vec![(Role::Series(palette::GREEN), up), (Role::Flown, over_ground)];
    Panel::over_time("speed over the ground, and upwards (green)", Quantity::new("speed", Unit::MetrePerSecond), lines)
}

fn tilt(rows: &[Row]) -> Panel {
    let tilt = |row: &Row| {
        let [w, x, y, z] = row.attitude;
        let up = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z)) * Vector3::z();
        libm::acos(up.z.clamp(-1.0, 1.0)).to_degrees()
    };
    let line = over_time(rows, tilt);
    Panel::over_time("tilt", Quantity::new("tilt", Unit::Degree).at_least(2.0), vec![(Role::Flown, line)])
}

fn rotors(rows: &[Row]) -> Panel {
    let rotor = |i: usize| (Role::Series(palette::SERIES[i]), over_time(rows, |row| row.omega[i]));
    Panel::over_time("rotors", Quantity::new("speed", Unit::RadianPerSecond), (0..4).map(rotor).collect())
}
