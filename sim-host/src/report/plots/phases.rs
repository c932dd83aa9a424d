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
use super::style::{INK, Key, Role, palette};
use super::tracking::{while_flying, with_new_reference};
use crate::flight;
use crate::record::{Recorder as _, Row};
use crate::report::estimate::{self, Belief};
use crate::report::metrics::errors;
use crate::report::touchdown::Touchdown;
use crate::scenario::Scenario;
use crate::sensors::Fault;
use crate::sensors::faults::{Kind, Sensor};

/// From one belief to the next, s.
const BELIEF_S: f64 = estimate::EVERY as f64 / 1e3;

/// Phases, faults and events of a flight on sensors; nothing of one on ideal state.
pub(super) fn backdrop(scenario: &Scenario, rows: &[Row], beliefs: &[Belief]) -> Backdrop {
    let Some(end) = beliefs.last().map(|belief| belief.t) else { return Backdrop::default() };
    let fault = |fault: &Fault| Span {
        name: name_of(fault),
        from: fault.from_s,
        to: fault.to_s.unwrap_or(f64::INFINITY),
        color: INK,
    };
    let faults = scenario.file.fault.iter().filter(|fault| fault.from_s < end).map(fault).collect();
    let landed = touchdown(scenario, rows);
    let never_armed = beliefs.iter().all(|belief| !belief.armed);
    let landed = if never_armed { Some(f64::NEG_INFINITY) } else { landed };
    Backdrop { phases: phases(beliefs), faults, events: events(landed, rows, beliefs), landed, named: false }
}

/// When it touched down, s.
fn touchdown(scenario: &Scenario, rows: &[Row]) -> Option<f64> {
    let mut touchdown = Touchdown::new(flight::ground(scenario)?);
    rows.iter().for_each(|row| touchdown.record(row));
    touchdown.first().map(|contact| contact.t_s)
}

/// Stretches of one mode while the vehicle is armed. A short one between two of the same mode is a stop on the way.
fn phases(beliefs: &[Belief]) -> Vec<Span> {
    let mut phases: Vec<Span> = Vec::new();
    for belief in beliefs.iter().filter(|belief| belief.armed) {
        let name = estimate::name(belief.mode);
        match phases.last_mut().filter(|phase| phase.name == name && belief.t - phase.to < 2.0 * BELIEF_S) {
            Some(phase) => phase.to = belief.t,
            None => {
                if let Some(before) = phases.last_mut() {
                    before.to = belief.t;
                }
                phases.push(Span { name: name.into(), from: belief.t, to: belief.t, color: phase_color(name) });
            }
        }
    }
    phases.retain(|phase| phase.to > phase.from && phase.name != "idle" && phase.name != "disarmed");
    phases
}

/// Touchdown, disarming and loss of the vehicle, s.
fn events(landed: Option<f64>, rows: &[Row], beliefs: &[Belief]) -> Vec<(f64, String)> {
    let disarmed = beliefs.windows(2).find(|pair| pair[0].armed && !pair[1].armed).map(|pair| pair[1].t);
    let lost = rows.last().filter(|row| !row.is_tracking()).map(|row| row.t);
    let named = [(landed, "touchdown"), (disarmed, "disarmed"), (lost, "lost")];
    let mut events: Vec<_> = named.into_iter().filter_map(|(t, name)| Some((t?, name.to_owned()))).collect();
    events.sort_by(|a, b| a.0.total_cmp(&b.0));
    events
}

/// What fails, and how.
fn name_of(fault: &Fault) -> String {
    let sensor = fault.sensor.map_or("", Sensor::name);
    let how = match fault.kind {
        Kind::Off {} => "off",
        Kind::Stuck {} => "stuck",
        Kind::Drift { .. } => "drifts",
        Kind::Noise { .. } => "noisy",
        Kind::Spikes { .. } => "spikes",
        Kind::Delayed { .. } => "delayed",
        Kind::Nan {} => "NaN",
        Kind::Glitch { .. } => "glitch",
        Kind::NoFix {} => "no fix",
        Kind::Loss { .. } => "loses samples",
        Kind::Duplicate { .. } => "repeats samples",
        Kind::Disorder {} => "out of order",
        Kind::TimeJump { .. } => "wrong stamps",
        Kind::Rotor { index, effectiveness: 0.0 } => return format!("rotor {} lost", index + 1),
        Kind::Rotor { index, effectiveness } => {
            return format!("rotor {} at {:.0} % of its thrust", index + 1, 100.0 * effectiveness);
        }
        Kind::Collapse { factor } => return format!("battery at {:.0} % of its voltage", 100.0 * factor),
    };
    format!("{sensor} {how}")
}

/// Height, distance from the reference, speed, tilt and rotors, one above the other. Returns the file written.
///
/// # Errors
/// When the file cannot be written; the message names it.
pub(super) fn flight(folder: &Path, figures: &Figures) -> Result<PathBuf> {
    let rows = figures.rows;
    let panels = [height(figures), distance(figures), speed(rows), tilt(rows), rotors(rows)];
    let last = panels.len() - 1;
    let panels: Vec<Panel> = panels.into_iter().enumerate().map(|(i, panel)| {
        let backdrop = if i == 0 { figures.backdrop.named() } else { figures.backdrop.clone() };
        let across = if i == last { panel.across.clone() } else { Quantity::from("") };
        Panel { span: figures.span(), across, backdrop, ..panel }
    }).collect();
    let path = folder.join("flight.svg");
    let legend: Vec<Key> = figures.backdrop.keys().into_iter().chain([Key::Reference, Key::Flown]).collect();
    let heading = figures.heading("Flight, phase by phase");
    save(&path, size_of(panels.len(), 180), &heading, &legend, |area| grid(area, 1, &panels))?;
    Ok(path)
}

pub(super) fn height(figures: &Figures) -> Panel {
    let rows = figures.rows;
    let lines = vec![
        (Role::Reference, while_flying(figures, rows, |row| row.reference[2])),
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
    let line = while_flying(figures, &rows, distance);
    Panel::over_time("distance from the reference", Quantity::new("distance", Unit::Metre), vec![(Role::Flown, line)])
}

fn speed(rows: &[Row]) -> Panel {
    let over_ground = over_time(rows, |row| libm::hypot(row.velocity[0], row.velocity[1]));
    let up = over_time(rows, |row| row.velocity[2]);
    let lines = vec![(Role::Series(palette::GREEN), up), (Role::Flown, over_ground)];
    let keys = vec![("upwards", lines[0].0), ("over the ground", lines[1].0)];
    Panel { keys, ..Panel::over_time("speed", Quantity::new("speed", Unit::MetrePerSecond), lines) }
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
    let lines = vec![
        (Role::Series(palette::ORANGE), over_time(rows, |row| row.omega.into_iter().fold(f64::INFINITY, f64::min))),
        (Role::Flown, over_time(rows, |row| row.omega.into_iter().fold(0.0, f64::max))),
    ];
    let keys = vec![("slowest", lines[0].0), ("fastest", lines[1].0)];
    Panel { keys, ..Panel::over_time("rotor speed", Quantity::new("speed", Unit::RadianPerSecond), lines) }
}
