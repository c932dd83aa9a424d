//! A pilot's flight over time, with its phases, faults and events.

use std::path::{Path, PathBuf};

use anyhow::Result;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::axis::{Quantity, Unit};
use super::backdrop::{Backdrop, DISARMED, Span, phase_color, time_of};
use super::flight::Figures;
use super::page::{grid, save, size_of};
use super::panel::Panel;
use super::series::over_time;
use super::style::{INK, Key, Role, palette};
use super::tracking::{while_flying, with_new_reference};
use crate::flight;
use crate::record::{Recorder as _, Row};
use crate::report::metrics::errors;
use crate::report::timeline::{Event, EventKind, Phase, Timeline};
use crate::scenario::Scenario;
use crate::sil::End;
use crate::touchdown::Touchdown;

/// Phases in which it stands.
const ON_THE_GROUND: [&str; 3] = ["before arming", "on the ground", "disarmed"];
const TOUCHDOWN: &str = "touchdown";

/// Phases, faults and events of a pilot's flight.
pub(super) fn backdrop(scenario: &Scenario, rows: &[Row], timeline: &Timeline) -> Backdrop {
    let phases: Vec<Span> = timeline.phases.iter().filter(|phase| flies(&phase.name)).map(span).collect();
    let events = events(scenario, rows, timeline);
    let landed = if phases.is_empty() { Some(f64::NEG_INFINITY) } else { time_of(&events, TOUCHDOWN) };
    Backdrop { phases, faults: faults(timeline), events, landed, named: false }
}

fn flies(phase: &str) -> bool {
    !ON_THE_GROUND.contains(&phase)
}

fn span(phase: &Phase) -> Span {
    Span { name: phase.name.clone(), from: phase.from_s, to: phase.to_s, color: phase_color(&phase.name) }
}

/// From each fault's and each push's begin to its end; without one, for good.
fn faults(timeline: &Timeline) -> Vec<Span> {
    let kinds = [(EventKind::FaultBegins, EventKind::FaultEnds), (EventKind::PushBegins, EventKind::PushEnds)];
    let mut spans: Vec<Span> = kinds.into_iter().flat_map(|kinds| spans_of(timeline, kinds)).collect();
    spans.sort_by(|a, b| a.from.total_cmp(&b.from));
    spans
}

fn spans_of(timeline: &Timeline, (begins, ends): (EventKind, EventKind)) -> Vec<Span> {
    let of = |kind: EventKind| timeline.events.iter().filter(move |event| event.kind == kind);
    let name = |event: &Event| event.text.split_once(": ").map_or(event.text.clone(), |(_, name)| name.to_owned());
    let fault = |begin: &Event| {
        let name_of_begin = name(begin);
        let end = of(ends).find(|end| end.t_s >= begin.t_s && name(end) == name_of_begin);
        Span { name: name_of_begin, from: begin.t_s, to: end.map_or(f64::INFINITY, |end| end.t_s), color: INK }
    };
    of(begins).map(fault).collect()
}

/// The first touchdown, crash and disarming, and the loss of the vehicle, s.
fn events(scenario: &Scenario, rows: &[Row], timeline: &Timeline) -> Vec<(f64, String)> {
    let of = |kind: EventKind| timeline.events.iter().find(|event| event.kind == kind).map(|event| event.t_s);
    let landed = of(EventKind::Touchdown).or_else(|| touchdown(scenario, rows));
    // A vehicle that is lost is flown no further.
    let cut_off = rows.last().filter(|_| rows.len() < scenario.ticks() as usize);
    let lost = cut_off.filter(|row| row.end() != End::DurationReached).map(|row| row.t);
    let named =
        [(landed, TOUCHDOWN), (of(EventKind::Crash), "crash"), (of(EventKind::Disarmed), DISARMED), (lost, "lost")];
    let mut events: Vec<_> = named.into_iter().filter_map(|(t, name)| Some((t?, name.to_owned()))).collect();
    events.sort_by(|a, b| a.0.total_cmp(&b.0));
    events
}

/// When it touched down, s.
fn touchdown(scenario: &Scenario, rows: &[Row]) -> Option<f64> {
    let mut touchdown = Touchdown::new(flight::ground(scenario)?);
    for row in rows {
        touchdown.record(row);
    }
    touchdown.first().map(|contact| contact.t_s)
}

/// Height, distance from the reference, speed, tilt and rotors, one above the other. Returns the file written.
///
/// # Errors
/// When the file cannot be written; the message names it.
pub(super) fn flight(folder: &Path, figures: &Figures) -> Result<PathBuf> {
    let rows = figures.rows;
    let panels = [height(figures), distance(figures), speed(rows), tilt(rows), rotors(rows)];
    let last = panels.len() - 1;
    let panels: Vec<Panel> = panels
        .into_iter()
        .enumerate()
        .map(|(i, panel)| {
            let backdrop = if i == 0 { figures.backdrop.named() } else { figures.backdrop.clone() };
            let across = if i == last { panel.across.clone() } else { Quantity::from("") };
            Panel { span: figures.span(), across, backdrop, ..panel }
        })
        .collect();
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
