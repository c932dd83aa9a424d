//! Where it flew: in space, and from above.

use std::path::{Path, PathBuf};

use anyhow::Result;

use super::axis::Quantity;
use super::flight::Figures;
use super::page::{HEADING, WIDTH, save};
use super::panel::{ABOVE, BELOW, LEFT, Panel, RIGHT};
use super::phases;
use super::series::{extent, gaps, reference_path, thin_path};
use super::space::{self, Frame, Leg};
use super::style::{Key, Role};
use super::svg::Area;
use super::tracking::with_new_reference;
use crate::record::Row;

/// A vehicle that has moved less, and should have, m: its path would be a dot.
const MOVES_M: f64 = 0.5;
/// Width of the view in space.
const SPACE: f64 = 560.0;
/// The lowest and the highest that a view may be, and what height over time needs below the view from above.
const LOWEST: f64 = 330.0;
const HIGHEST: f64 = 740.0;
const FILLER: f64 = 190.0;

/// Whether vehicle or reference moved far enough for a path to be seen.
pub(super) fn moves(rows: &[Row]) -> bool {
    let size = |axis: usize| extent(rows.iter().flat_map(|row| [row.position[axis], row.reference[axis]]));
    (0..3).filter_map(size).any(|(low, high)| high - low > MOVES_M)
}

/// The path in space and from above. Returns the file written.
///
/// # Errors
/// When the file cannot be written; the message names it.
pub(super) fn path(folder: &Path, figures: &Figures) -> Result<PathBuf> {
    let path = folder.join("path.svg");
    draw(&path, &figures.heading("The path in space and from above"), figures)?;
    Ok(path)
}

/// Draws the path of a flight under a heading into a file.
///
/// # Errors
/// When the file cannot be written; the message names it.
pub(super) fn draw(path: &Path, heading: &str, figures: &Figures) -> Result<()> {
    let rows = figures.rows;
    let frame = Frame::around(rows);
    let above = from_above(figures);
    let plan = height_from_above(&above).min(HIGHEST);
    let space = frame.height(SPACE).clamp(LOWEST, HIGHEST);
    let height = space.max(plan);
    let phases = figures.backdrop.leg_keys();
    let lines =
        if phases.is_empty() { vec![Key::Reference, Key::Flown] } else { vec![Key::Line("reference", Role::Guide)] };
    let jumps = above.jumps().then_some(Key::Jump);
    let legend: Vec<Key> = phases.into_iter().chain(lines).chain([Key::Start]).chain(jumps).collect();
    save(path, (WIDTH, HEADING + height as u32), heading, &legend, |area| {
        let (left, right) = area.split_right(SPACE);
        let reference = Leg { points: reference(figures), role: reference_role(figures) };
        let in_space = stacked(&left, space, figures);
        space::draw(&in_space, &frame, &reference, &legs(figures), &places(figures));
        above.draw(&stacked(&right, plan, figures));
        Ok(())
    })
}

/// The upper `height` of an area, with height over time below it where that leaves room; else its middle.
fn stacked<'a>(area: &Area<'a>, height: f64, figures: &Figures) -> Area<'a> {
    let rest = area.height - height;
    if rest < FILLER {
        return area.inner(0.0, 0.5 * rest, area.width, height);
    }
    let (above, below) = area.split_below(height);
    Panel { span: figures.span(), backdrop: figures.backdrop.clone(), ..phases::height(figures) }.draw(&below);
    above
}

/// How the reference is drawn below what was flown: light, where phases have colours.
fn reference_role(figures: &Figures) -> Role {
    if figures.backdrop.phases.is_empty() { Role::Reference } else { Role::Guide }
}

/// The reference's path while it flies.
fn reference(figures: &Figures) -> Vec<[f64; 3]> {
    let mut rows = with_new_reference(figures);
    rows.retain(|row| figures.backdrop.flies(row.t));
    reference_path(&rows)
}

/// What was flown, in phases where there are any.
fn legs(figures: &Figures) -> Vec<Leg> {
    let points = |rows: &[Row]| rows.iter().map(|row| row.position).collect();
    let rows = figures.rows;
    if figures.backdrop.phases.is_empty() {
        return vec![Leg { points: points(rows), role: Role::Flown }];
    }
    let at = |t: f64| rows.partition_point(|row| row.t < t);
    let leg = |span: &super::backdrop::Span| {
        // With the row after the last, so that legs meet.
        let flown = &rows[at(span.from)..(at(span.to) + 1).min(rows.len())];
        Leg { points: points(flown), role: Role::Leg(span.color) }
    };
    figures.backdrop.phases.iter().map(leg).collect()
}

/// The places that it was sent to, each once, numbered in order.
fn places(figures: &Figures) -> Vec<([f64; 3], String)> {
    let mut places: Vec<([f64; 3], String)> = Vec::new();
    let sent = figures.places.iter().zip(1..).filter_map(|(place, number)| Some(((*place)?, number)));
    for (place, number) in sent {
        match places.iter_mut().find(|(known, _)| *known == place) {
            Some((_, name)) => *name = format!("{name}, {number}"),
            None => places.push((place, number.to_string())),
        }
    }
    places
}

fn from_above(figures: &Figures) -> Panel {
    let plane = |points: &[[f64; 3]]| thin_path(points.iter().map(|[x, y, _]| (*x, *y)).collect());
    let reference = plane(&reference(figures));
    let jumps = (Role::Jump, gaps(&reference));
    let flown = legs(figures).into_iter().map(|leg| (leg.role, plane(&leg.points)));
    let lines: Vec<_> = [jumps, (reference_role(figures), reference)].into_iter().chain(flown).collect();
    let places = places(figures).into_iter().map(|([x, y, _], name)| ((x, y), name)).collect();
    let start = figures.rows.first().map(|row| (row.position[0], row.position[1]));
    let panel = Panel::path("from above", Quantity::place("x (north)"), Quantity::place("y (west)"), vec![]);
    Panel { lines, places, equal_scales: true, mark_start: false, dots: start.into_iter().collect(), ..panel }
}

/// The height at which a view from above has no empty sides.
fn height_from_above(above: &Panel) -> f64 {
    let (across, up) = above.ranges();
    let width = f64::from(WIDTH) - SPACE - LEFT - RIGHT;
    (width * (up.1 - up.0) / (across.1 - across.0) + ABOVE + BELOW).max(0.6 * LOWEST)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{figures, made_up};
    use super::*;

    #[test]
    fn places_are_numbered_in_the_order_of_the_visits() {
        let rows = made_up(1.0);
        let mut figures = figures(&rows);
        // The third was refused.
        figures.places = vec![Some([1.0, 0.0, 5.0]), Some([2.0, 0.0, 5.0]), None, Some([1.0, 0.0, 5.0])];
        let names: Vec<_> = places(&figures).into_iter().map(|(_, name)| name).collect();
        assert_eq!(names, ["1, 4", "2"]);
    }

    #[test]
    fn a_hover_has_no_path() {
        assert!(!moves(&[Row::default(), Row::default()]) && !moves(&[]));
        assert!(moves(&made_up(1.0)));
    }
}
