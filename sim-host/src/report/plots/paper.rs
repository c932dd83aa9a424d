//! The paper's Figures 2 to 7, laid out as its captions say, and one of the coupled vehicle beside them.
//!
//! The text gives no time windows. Where two lines coincide after the approach, the approach and the error are shown:
//! the first second holds every time that the paper names; its times are marked.

use std::path::{Path, PathBuf};

use anyhow::Result;

use super::axis::{Quantity, Unit};
use super::backdrop::Backdrop;
use super::disturbance::{applied_panel, error_panel};
use super::flight::{Disturbance, Figures};
use super::inputs::{APPROACH_S, Inputs, SWITCHES};
use super::page::{grid, save, size_of};
use super::panel::{ANGLES, POSITIONS, Panel};
use super::path;
use super::series::{Points, angle_over_time, angles_deg, over_time, thin_path};
use super::style::{Color, INK, Key, Role, palette};
use super::tracking::{SURFACE, phase_panel, with_surface};
use crate::paper::claims::{ALTITUDE_AT_REST, ALTITUDE_ERROR, Y_FOLLOWS, Z_FOLLOWS};
use crate::paper::flights::{Flights, Flown, SEED};
use crate::record::Row;
use crate::report::metrics::errors;
use crate::report::timeline::Course;

/// Height of a panel: of four in a figure, of six or nine, and of twelve.
const HIGH: u32 = 310;
const MIDDLE: u32 = 250;
const LOW: u32 = 215;
/// Distances are shown from a hundredth of a millimetre on, as logarithms of metres.
const DISTANCES: (f64, f64) = (-5.0, 2.0);
const FOLLOWING: [Key; 3] = [Key::Reference, Key::Flown, Key::Start];

/// Draws all into `folder`. Returns the files written, in the paper's order.
///
/// # Errors
/// When a file cannot be written; the message names it.
pub fn draw(flights: &Flights, folder: &Path) -> Result<Vec<PathBuf>> {
    let mut files = vec![altitude(folder, &flights.ideal)?, position(folder, &flights.ideal)?];
    files.push(attitude(folder, &flights.attitude)?);
    for (flown, name) in [(&flights.disturbed, ""), (&flights.disturbed_output, "-output")] {
        if let Some(applied) = figures(flown).disturbance {
            files.push(disturbance(&folder.join(format!("figure-5-disturbance{name}.svg")), flown, &applied)?);
            files.push(disturbed(&folder.join(format!("figure-6-disturbed{name}.svg")), flown, applied.acting)?);
        }
    }
    files.push(helix(folder, &flights.ideal)?);
    files.push(coupled(folder, flights)?);
    Ok(files)
}

/// Figure 2: altitude, its error, its phase plot, its control input.
fn altitude(folder: &Path, flown: &Flown) -> Result<PathBuf> {
    let start = approach(&flown.rows);
    let millimetres = |t: f64| flown.at(t).map_or(f64::NAN, |row| 1e3 * errors(row)[2]);
    let [follows, settled] = [Z_FOLLOWS.time_s, ALTITUDE_ERROR.time_s];
    let claimed = events(&[
        (follows, &format!("{follows} s: {:.0} mm", millimetres(follows))),
        (settled, &format!("{settled} s: {:.0} mm, paper 2 mm", millimetres(settled))),
    ]);
    let error = Panel { backdrop: claimed, ..titled("b) tracking error", error_panel(start, 2)) };
    let panels = [
        titled("a) altitude", tracking(&flown.rows, 2)),
        error,
        surface(flown, 2, "c) phase plot"),
        input(flown, "d) control input", 0),
    ];
    let path = folder.join("figure-2-altitude.svg");
    let legend = [FOLLOWING.as_slice(), &[SURFACE, SWITCHES]].concat();
    save(&path, size_of(2, HIGH), &heading(flown, "Figure 2: altitude"), &legend, |area| grid(area, 2, &panels))?;
    Ok(path)
}

/// Figure 3: x and y, their errors and their phase portraits.
fn position(folder: &Path, flown: &Flown) -> Result<PathBuf> {
    let start = approach(&flown.rows);
    let follows = Y_FOLLOWS.time_s;
    let millimetres = flown.at(follows).map_or(f64::NAN, |row| 1e3 * errors(row)[1]);
    let claimed = format!("{follows} s: {millimetres:.0} mm, paper: follows");
    let panels: Vec<Panel> = [(0, None), (1, Some((follows, claimed.as_str())))]
        .into_iter()
        .flat_map(|(axis, claimed)| {
            let name = POSITIONS[axis];
            let backdrop = events(claimed.as_slice());
            [
                titled(&format!("{name}: tracking"), tracking(&flown.rows, axis)),
                Panel { backdrop, ..titled(&format!("{name}: error of the first second"), error_panel(start, axis)) },
                surface(flown, axis, &format!("{name}: phase portrait")),
            ]
        })
        .collect();
    let path = folder.join("figure-3-position.svg");
    let legend = [FOLLOWING.as_slice(), &[SURFACE]].concat();
    let heading = heading(flown, "Figure 3: position");
    save(&path, size_of(2, HIGH), &heading, &legend, |area| grid(area, 3, &panels))?;
    Ok(path)
}

/// Figure 4: roll, pitch and yaw, their errors and their control inputs.
fn attitude(folder: &Path, flown: &Flown) -> Result<PathBuf> {
    let start = approach(&flown.rows);
    let panels: Vec<Panel> = (0..3)
        .flat_map(|axis| {
            let name = ANGLES[axis];
            [
                titled(&format!("{name}: tracking"), angle(&flown.rows, axis)),
                titled(&format!("{name}: error of the first second"), error_panel(start, axis + 3)),
                input(flown, &format!("{name}: control input"), axis + 1),
            ]
        })
        .collect();
    let path = folder.join("figure-4-attitude.svg");
    let heading = heading(flown, "Figure 4: roll, pitch and yaw");
    let legend = [Key::Reference, Key::Flown, SWITCHES];
    save(&path, size_of(3, MIDDLE), &heading, &legend, |area| grid(area, 3, &panels))?;
    Ok(path)
}

/// Figure 5: the disturbance of all six coordinates.
fn disturbance(path: &Path, flown: &Flown, applied: &Disturbance) -> Result<PathBuf> {
    let panels = [0, 3, 1, 4, 2, 5].map(|axis| applied_panel(applied, axis));
    let heading = heading(flown, &format!("Figure 5: Gaussian disturbance of the {}", target(applied)));
    save(path, size_of(3, LOW), &heading, &[Key::Disturbed], |area| grid(area, 2, &panels))?;
    Ok(path.to_owned())
}

/// What is disturbed.
fn target(applied: &Disturbance) -> &'static str {
    if applied.on_accelerations { "accelerations" } else { "outputs" }
}

/// Figure 6: all six coordinates under the disturbance, and their errors around it.
fn disturbed(path: &Path, flown: &Flown, acting: (f64, f64)) -> Result<PathBuf> {
    let rows = &flown.rows;
    let around = &rows[rows.partition_point(|row| row.t < acting.0 - 1.0)..];
    let letters = ["a) position x", "b) position y", "c) altitude", "d) roll", "e) pitch", "f) yaw"];
    let outputs = |first: usize| {
        let output = move |axis: usize| if axis < 3 { tracking(rows, axis) } else { angle(rows, axis - 3) };
        let error = move |axis: usize| titled("its error", error_panel(around, axis));
        let shown = move |axis: usize| titled(letters[axis], output(axis));
        (first..first + 3).map(shown).chain((first..first + 3).map(error))
    };
    let shade = |panel: Panel| Panel { shaded: Some(acting), ..panel };
    let panels: Vec<Panel> = outputs(0).chain(outputs(3)).map(shade).collect();
    let on = figures(flown).disturbance.map_or("", |applied| target(&applied));
    let heading = heading(flown, &format!("Figure 6: tracking under disturbance of the {on}"));
    let legend = [Key::Disturbed, Key::Reference, Key::Flown];
    save(path, size_of(4, LOW), &heading, &legend, |area| grid(area, 3, &panels))?;
    Ok(path.to_owned())
}

/// Figure 7: the helix in space and from above.
fn helix(folder: &Path, flown: &Flown) -> Result<PathBuf> {
    let path = folder.join("figure-7-helix.svg");
    path::draw(&path, &heading(flown, "Figure 7: helix (4 sin t, 5 cos t, 2 + t) m from (0, 0, 0)"), &figures(flown))?;
    Ok(path)
}

/// What Table 1 does where the vehicle has to tilt to move, beside gains that fly.
fn coupled(folder: &Path, flights: &Flights) -> Result<PathBuf> {
    let Flights { ideal, literal, literal_slow, literal_wide, helix, .. } = flights;
    let compared: [(&str, &Flown, Color); 5] = [
        ("decoupled", ideal, palette::GREEN),
        ("coupled", literal, INK),
        ("three wide layers", literal_slow, palette::PURPLE),
        ("six wide layers", literal_wide, palette::VERMILION),
        ("own gains", helix, palette::SKY),
    ];
    let within = ideal.rows.len();
    let lines =
        compared.map(|(_, flown, color)| (Role::Series(color), distance(&flown.rows[..within.min(flown.rows.len())])));
    let distances = Panel::over_time("d) distance from the helix", "distance, m", lines.to_vec());
    let panels = [
        from_above("a) from above: Table 1 on the coupled model", literal),
        from_above("b) from above: own gains on the rigid body", helix),
        titled("c) pitch: Table 1 on the coupled model", angle(&literal.rows, 1)),
        Panel { decades_up: Some(DISTANCES), ..distances },
    ];
    let path = folder.join("coupled-vehicle.svg");
    let keys = compared.map(|(name, _, color)| Key::Series(name, color));
    let legend = [FOLLOWING.as_slice(), &keys].concat();
    let heading = "Coupled vehicle: Table 1, and gains that fly";
    save(&path, size_of(2, 400), heading, &legend, |area| grid(area, 2, &panels))?;
    Ok(path)
}

fn figures(flown: &Flown) -> Figures<'_> {
    Figures::new(&flown.scenario, SEED, &flown.rows, &[], &Course::default())
}

fn heading(flown: &Flown, title: &str) -> String {
    format!("{title}\n{}", flown.name)
}

fn titled(title: &str, panel: Panel) -> Panel {
    Panel { title: title.into(), ..panel }
}

/// Times that the paper names.
fn events(times: &[(f64, &str)]) -> Backdrop {
    let events = times.iter().map(|(t, name)| (*t, (*name).to_owned())).collect();
    Backdrop { events, named: true, ..Backdrop::default() }
}

fn approach(rows: &[Row]) -> &[Row] {
    &rows[..rows.partition_point(|row| row.t <= APPROACH_S)]
}

fn tracking(rows: &[Row], axis: usize) -> Panel {
    let lines = vec![
        (Role::Reference, over_time(rows, |row| row.reference[axis])),
        (Role::Flown, over_time(rows, |row| row.position[axis])),
    ];
    Panel::over_time("", Quantity::place(POSITIONS[axis]), lines)
}

fn angle(rows: &[Row], axis: usize) -> Panel {
    let lines = vec![
        (Role::Reference, angle_over_time(rows, |row| row.desired_attitude[axis].to_degrees())),
        (Role::Flown, angle_over_time(rows, |row| angles_deg(row)[axis])),
    ];
    Panel::over_time("", Quantity::new(ANGLES[axis], Unit::Degree).at_least(2.0), lines)
}

/// A phase portrait with the surface s = 0 that it ends on; where the paper says that z is at rest, a ring.
fn surface(flown: &Flown, axis: usize, title: &str) -> Panel {
    let control = flown.control();
    let gains = [&control.x, &control.y, &control.z][axis];
    let panel = titled(title, with_surface(phase_panel(&flown.rows, axis), gains));
    let at_rest = (axis == 2).then(|| flown.at(ALTITUDE_AT_REST.time_s)).flatten();
    let place = |row: &Row| {
        let error = errors(row)[axis];
        ((error, -f64::from(gains.lambda) * error), format!("{} s", ALTITUDE_AT_REST.time_s))
    };
    Panel { places: at_rest.map(place).into_iter().collect(), ..panel }
}

/// U1 to U4, by index from 0, of the first second.
fn input(flown: &Flown, title: &str, input: usize) -> Panel {
    let start = approach(&flown.rows);
    let inputs = Inputs::new(&flown.scenario, flown.control());
    let mean = inputs.mean(start, input, None);
    Panel { span: Some((0.0, APPROACH_S)), ..inputs.panel(title, start, input, mean) }
}

fn from_above(title: &str, flown: &Flown) -> Panel {
    let path = |of: fn(&Row) -> (f64, f64)| thin_path(flown.rows.iter().map(of).collect());
    let lines = vec![
        (Role::Reference, path(|row| (row.reference[0], row.reference[1]))),
        (Role::Flown, path(|row| (row.position[0], row.position[1]))),
    ];
    let panel = Panel::path(title, Quantity::place("x (north)"), Quantity::place("y (west)"), vec![]);
    Panel { lines, equal_scales: true, ..panel }
}

/// Decimal logarithm of the distance from the reference (m), over time.
fn distance(rows: &[Row]) -> Points {
    let squared = |row: &Row| (0..3).map(|axis| (row.reference[axis] - row.position[axis]).powi(2)).sum::<f64>();
    over_time(rows, |row| libm::log10(squared(row).sqrt()).clamp(DISTANCES.0, DISTANCES.1))
}
