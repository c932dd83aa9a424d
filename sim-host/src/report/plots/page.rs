//! A figure: its heading and legend, and panels in a grid.

use std::path::Path;

use anyhow::Result;

use super::panel::Panel;
use super::style::{Key, Role, palette};
use super::svg::{Anchor, Area, Font, Page, Stroke, text_width};
use crate::report::out::write_file;

/// Height of a figure's heading.
pub(super) const HEADING: u32 = 44;
/// Height of a legend below it.
const LEGEND: u32 = 24;
/// Width of a figure.
pub(super) const WIDTH: u32 = 1100;
/// Sizes of its texts.
const TITLE_SIZE: f64 = 17.0;
const KEY_SIZE: f64 = 12.5;
/// Width of a legend's sample, and from it to its name and from the name to the next.
const SAMPLE: f64 = 26.0;
const GAP: f64 = 6.0;
const NEXT: f64 = 18.0;

/// The size of a figure with so many rows of panels, each `height` high.
pub(super) fn size_of(rows: usize, height: u32) -> (u32, u32) {
    (WIDTH, HEADING + rows as u32 * height)
}

/// Draws a figure of `size` pixels and writes it to `path`. `heading` may go on after a newline, in lighter text.
pub(super) fn save(
    path: &Path,
    size: (u32, u32),
    heading: &str,
    legend: &[Key],
    draw: impl FnOnce(&Area) -> Result<()>,
) -> Result<()> {
    let page = Page::default();
    // The bold letters of some machines are a fifth wider.
    let beside = 1.2 * text_width(heading, TITLE_SIZE) + legend_width(legend) + 60.0 < f64::from(size.0);
    // A legend that does not fit beside the heading stands below it, in as many lines as it takes.
    let lines = if beside { vec![legend] } else { legend_lines(legend, f64::from(size.0) - 40.0) };
    let below = if beside { 0 } else { LEGEND * lines.len() as u32 };
    let size = (size.0, size.1 + below);
    let (top, rest) = page.area(size).split_below(f64::from(HEADING + below));
    draw_heading(&top.inner(0.0, 0.0, top.width, f64::from(HEADING)), heading);
    let first = f64::from(HEADING) * 0.5 + f64::from(if beside { 0 } else { LEGEND });
    for (i, line) in lines.into_iter().enumerate() {
        draw_legend(&top, line, first + f64::from(LEGEND) * i as f64);
    }
    draw(&rest)?;
    write_file(path, page.finish(size))
}

/// Draws panels row by row into equal cells.
///
/// # Errors
/// Never: it returns a result so that it can be what [`save`] draws.
#[expect(clippy::unnecessary_wraps, reason = "what `save` draws may fail")]
pub(super) fn grid(area: &Area, columns: usize, panels: &[Panel]) -> Result<()> {
    let (width, height) = (area.width / columns as f64, area.height / panels.len().div_ceil(columns).max(1) as f64);
    for (i, panel) in panels.iter().enumerate() {
        let (row, column) = ((i / columns) as f64, (i % columns) as f64);
        panel.draw(&area.inner(column * width, row * height, width, height));
    }
    Ok(())
}

fn draw_heading(area: &Area, heading: &str) {
    let (title, rest) = heading.split_once('\n').unwrap_or((heading, ""));
    let middle = 0.5 * area.height;
    area.text_and((14.0, middle), title, Font::new(TITLE_SIZE, Anchor::Start).bold(), (rest, KEY_SIZE));
}

fn legend_width(legend: &[Key]) -> f64 {
    legend.iter().map(|key| text_width(key.name(), KEY_SIZE) + SAMPLE + GAP + NEXT).sum()
}

/// A legend in lines that fit into a width.
fn legend_lines<'a, 'b>(mut legend: &'a [Key<'b>], width: f64) -> Vec<&'a [Key<'b>]> {
    let mut lines = Vec::new();
    while !legend.is_empty() {
        let fits = (1..=legend.len()).take_while(|count| legend_width(&legend[..*count]) <= width).last();
        let (line, rest) = legend.split_at(fits.unwrap_or(1));
        lines.push(line);
        legend = rest;
    }
    lines
}

/// From the right to the left, at a height.
fn draw_legend(area: &Area, legend: &[Key], middle: f64) {
    let mut x = area.width - 20.0;
    for key in legend.iter().rev() {
        x -= text_width(key.name(), KEY_SIZE);
        area.text((x, middle), key.name(), Font::new(KEY_SIZE, Anchor::Start));
        x -= SAMPLE + GAP;
        draw_sample(area, *key, (x, middle));
        x -= NEXT;
    }
}

fn draw_sample(area: &Area, key: Key, (x, y): (f64, f64)) {
    let line = |stroke: Stroke| area.line([(x, y), (x + SAMPLE, y)], stroke);
    let filled = |color| area.rectangle((x, y - 6.0), (x + SAMPLE, y + 6.0), color);
    match key {
        Key::Reference => line(Role::Reference.stroke()),
        Key::Flown | Key::Linear => line(Role::Flown.stroke()),
        Key::Start | Key::Simulated => area.dot((x + 20.0, y), 4.0, palette::START),
        Key::Jump => line(Role::Jump.stroke()),
        Key::Disturbed => filled(palette::DISTURBED),
        Key::Line(_, role) => line(role.stroke()),
        Key::Series(_, color) => filled(color),
        Key::Dots(_, color) => area.dots([4.0, 12.0, 20.0].map(|dx| (x + dx, y)), 1.5, color),
    }
}
