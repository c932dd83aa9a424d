//! The figures of a comparison: errors a cell with their intervals, ratios to the first controller, survival.

use std::path::Path;

use anyhow::Result;

use super::axis;
use super::page::save;
use super::series::extent;
use super::style::{Color, INK, Key, palette};
use super::svg::{Anchor, Area, Font, Stroke, text_width};
use crate::compare::{Cell, Comparison, Medians, RESOLUTION_M};

/// Shown pixels of a chart of one scenario, of the names of its disturbances, and of a map's square.
const CHART: (u32, u32) = (680, 330);
const NAMES: u32 = 110;
const SQUARE: (u32, u32) = (66, 26);
/// Size of a title, and how much wider bold letters are.
const TITLE: f64 = 13.0;
const BOLD: f64 = 1.1;
/// A ratio that is drawn in full colour.
const FULL_RATIO: f64 = 4.0;

/// Draws every figure into `folder`.
///
/// # Errors
/// When a file cannot be written; the message names it.
pub fn draw(comparison: &Comparison, folder: &Path) -> Result<()> {
    errors(comparison, &folder.join("compare-rms.svg"))?;
    if comparison.controllers.len() > 1 {
        ratios(comparison, &folder.join("compare-ratio.svg"))?;
    }
    survival(comparison, &folder.join("compare-survival.svg"))
}

/// RMS errors, a chart for each scenario.
fn errors(comparison: &Comparison, path: &Path) -> Result<()> {
    let scenarios = names(comparison, |cell| &cell.scenario);
    let (columns, rows) = (scenarios.len().min(2), scenarios.len().div_ceil(2));
    let keys: Vec<Key> =
        comparison.controllers.iter().enumerate().map(|(i, name)| Key::Series(name, color(i))).collect();
    let size = (CHART.0 * columns.max(1) as u32, 44 + CHART.1 * rows as u32);
    let heading =
        "RMS distance from the trajectory\nmedian, 95 % interval (a cross: lost); what is beyond lies on the edge";
    save(path, size, heading, &keys, |area| {
        for (i, scenario) in scenarios.iter().enumerate() {
            let (left, top) = (f64::from(CHART.0) * (i % 2) as f64, f64::from(CHART.1) * (i / 2) as f64);
            let cells: Vec<&Cell> = comparison.cells.iter().filter(|cell| cell.scenario == *scenario).collect();
            errors_of_scenario(&area.inner(left, top, f64::from(CHART.0), f64::from(CHART.1)), scenario, &cells);
        }
        Ok(())
    })
}

/// A chart: cells side by side, errors as logarithms.
struct Errors<'a> {
    chart: Area<'a>,
    cell: f64,
    low: f64,
    high: f64,
}

impl Errors<'_> {
    /// Pixels from the top, of an error in mm.
    fn height(&self, mm: f64) -> f64 {
        let at = |v: f64| libm::log10(v.clamp(self.low, self.high));
        self.chart.height * (at(self.high) - at(mm)) / (at(self.high) - at(self.low))
    }
}

fn errors_of_scenario(area: &Area, scenario: &str, cells: &[&Cell]) {
    let (low, high) = range_mm(cells);
    let chart = area.inner(64.0, 30.0, area.width - 72.0, area.height - 30.0 - f64::from(NAMES));
    let errors = Errors { cell: chart.width / cells.len() as f64, chart, low, high };
    area.text((64.0, 15.0), scenario, Font::new(13.0, Anchor::Start).bold());
    area.text((14.0, 30.0 + 0.5 * chart.height), "RMS, mm", Font::new(12.0, Anchor::Middle).upright());
    let grid = Stroke { color: palette::GRID, width: 0.6, dashed: false };
    for value in ticks(low, high) {
        let y = errors.height(value);
        chart.text((-6.0, y), &value.to_string(), Font::new(12.0, Anchor::End));
        chart.line([(0.0, y), (chart.width, y)], grid);
    }
    for (i, cell) in cells.iter().enumerate() {
        let left = errors.cell * i as f64;
        chart.line([(left + errors.cell, 0.0), (left + errors.cell, chart.height)], grid);
        upright(&chart, &cell.disturbance, (left + 0.5 * errors.cell, chart.height + 6.0));
        draw_errors(&errors, left, cell);
    }
    let frame = [(0.0, 0.0), (0.0, chart.height), (chart.width, chart.height)];
    chart.line(frame, Stroke { color: INK, width: 1.0, dashed: false });
}

/// The errors of each controller in the cell that begins `left` pixels from the chart's edge: a dot with its interval,
/// or a cross at the top for what is lost.
fn draw_errors(errors: &Errors, left: f64, cell: &Cell) {
    let chart = &errors.chart;
    for (i, medians) in cell.controllers.iter().enumerate() {
        let x = left + errors.cell * (i as f64 + 1.0) / (cell.controllers.len() as f64 + 1.0);
        let y = |metres: f64| errors.height(1e3 * metres);
        let stroke = Stroke { color: color(i), width: 2.0, dashed: false };
        if let Some((best, worst)) = medians.rms().interval {
            chart.line([(x, y(best)), (x, y(worst))], stroke);
        }
        let median = medians.rms().median;
        if median.is_finite() {
            chart.dot((x, y(median)), 3.0, color(i));
        } else {
            let y = y(f64::INFINITY) + 4.0;
            chart.line([(x - 4.0, y - 4.0), (x + 4.0, y + 4.0)], stroke);
            chart.line([(x - 4.0, y + 4.0), (x + 4.0, y - 4.0)], stroke);
        }
    }
}

/// From where to where the errors are, mm, with room for what is lost; what cannot be told from none is at the bottom.
fn range_mm(cells: &[&Cell]) -> (f64, f64) {
    let medians = cells.iter().flat_map(|cell| &cell.controllers).map(Medians::rms);
    let values = medians.flat_map(|rms| [Some(rms.median), rms.interval.map(|i| i.0), rms.interval.map(|i| i.1)]);
    let shown = values.flatten().filter(|value| value.is_finite()).map(|value| 1e3 * value.max(RESOLUTION_M));
    let (low, high) = extent(shown).unwrap_or((1.0, 1000.0));
    (0.8 * low, 1.6 * high)
}

/// 1, 2 and 5 of each decade, or its 1 alone where there would be too many, mm.
fn ticks(low: f64, high: f64) -> Vec<f64> {
    let steps: &[f64] = if high / low < 300.0 { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let decades = [0.001, 0.01, 0.1, 1.0, 10.0, 100.0, 1000.0, 10_000.0, 100_000.0];
    let all = decades.iter().flat_map(|decade| steps.iter().map(move |step| step * decade));
    let ticks: Vec<f64> = all.filter(|value| (low..=high).contains(value)).collect();
    // A narrow range has its own round numbers.
    if ticks.len() > 1 { ticks } else { axis::ticks((low, high), axis::step(high - low, 4.0)) }
}

/// Each other controller's RMS error over the first one's, a map a controller.
fn ratios(comparison: &Comparison, path: &Path) -> Result<()> {
    let first = &comparison.controllers[0];
    let maps: Vec<(usize, String)> =
        comparison.controllers.iter().enumerate().skip(1).map(|(i, name)| (i, format!("{name} / {first}"))).collect();
    let (better, worse) = (format!("{first} is better"), format!("{first} is worse"));
    let keys = [Key::Series(&better, palette::FLOWN), Key::Series(&worse, palette::START)];
    maps_of_cells(
        comparison,
        path,
        &format!("RMS over {first}'s\nmedian under the same seeds"),
        &keys,
        &maps,
        |cell, index| {
            let (ratio, lost) = (cell.rms_ratios[index].median, cell.controllers[0].rms().median.is_infinite());
            let strength = (libm::log(ratio).abs() / libm::log(FULL_RATIO)).min(1.0);
            let label = match ratio {
                _ if ratio.is_infinite() => "lost".to_owned(),
                _ if lost => {
                    if ratio == 0.0 {
                        "first lost".to_owned()
                    } else {
                        "both lost".to_owned()
                    }
                }
                _ if ratio >= 10.0 => format!("{ratio:.0}"),
                _ => format!("{ratio:.2}"),
            };
            (label, if ratio >= 1.0 { palette::FLOWN } else { palette::START }, strength)
        },
    )
}

/// How many of the flights survived, a map for each controller.
fn survival(comparison: &Comparison, path: &Path) -> Result<()> {
    let maps: Vec<(usize, String)> = comparison.controllers.iter().cloned().enumerate().collect();
    let keys = [Key::Series("lost", palette::START)];
    maps_of_cells(comparison, path, "Flights survived", &keys, &maps, |cell, index| {
        let Medians { flights, survived, .. } = cell.controllers[index];
        let lost = 1.0 - survived as f64 / flights.max(1) as f64;
        (format!("{survived}/{flights}"), palette::START, lost)
    })
}

/// Maps side by side: scenarios across, disturbances down, each square with its label, colour and strength (0 to 1).
fn maps_of_cells(
    comparison: &Comparison,
    path: &Path,
    heading: &str,
    keys: &[Key],
    maps: &[(usize, String)],
    square: impl Fn(&Cell, usize) -> (String, Color, f64),
) -> Result<()> {
    let across = names(comparison, |cell| &cell.scenario);
    let down = names(comparison, |cell| &cell.disturbance);
    let wide = maps.iter().map(|(_, title)| text_width(title, TITLE)).fold(0.0, f64::max);
    // As wide as its squares, or as its title where that is longer.
    let width = (SQUARE.0 * across.len() as u32).max((BOLD * wide).ceil() as u32) + 24;
    let total = (NAMES + 20 + width * maps.len() as u32).max(560);
    let size = (total, 44 + 30 + SQUARE.1 * down.len() as u32 + NAMES);
    save(path, size, heading, keys, |area| {
        for (row, name) in down.iter().enumerate() {
            let place = (f64::from(NAMES + 4), middle(30, SQUARE.1, row));
            area.text(place, name, Font::new(12.0, Anchor::End));
        }
        for (map, (index, title)) in maps.iter().enumerate() {
            let left = NAMES + 10 + width * map as u32;
            area.text((f64::from(left), 15.0), title, Font::new(TITLE, Anchor::Start).bold());
            for cell in &comparison.cells {
                let place = |names: &[&str], name: &str| names.iter().position(|known| *known == name).unwrap_or(0);
                let at = (place(&across, &cell.scenario), place(&down, &cell.disturbance));
                draw_square(area, left, at, square(cell, *index));
            }
            for (column, name) in across.iter().enumerate() {
                let below = f64::from(30 + SQUARE.1 * down.len() as u32 + 6);
                upright(area, name, (middle(left, SQUARE.0, column), below));
            }
        }
        Ok(())
    })
}

fn draw_square(area: &Area, left: u32, at: (usize, usize), (label, color, strength): (String, Color, f64)) {
    let corner =
        |column: usize, row: usize| (f64::from(left + SQUARE.0 * column as u32), f64::from(30 + SQUARE.1 * row as u32));
    // Less than the full colour: the label stays readable.
    let ((x0, y0), (x1, y1)) = (corner(at.0, at.1), corner(at.0 + 1, at.1 + 1));
    area.rectangle((x0, y0), (x1, y1), palette::GRID);
    area.rectangle((x0 + 0.5, y0 + 0.5), (x1 - 0.5, y1 - 0.5), color.tint(0.7 * strength));
    let place = (middle(left, SQUARE.0, at.0), middle(30, SQUARE.1, at.1));
    area.text(place, &label, Font::new(12.0, Anchor::Middle));
}

/// The middle of the square `index` of those of `size` that begin at `start`, all in pixels.
fn middle(start: u32, size: u32, index: usize) -> f64 {
    f64::from(start + size * index as u32) + 0.5 * f64::from(size)
}

/// A name turned by a quarter, its end at `place`.
fn upright(area: &Area, name: &str, place: (f64, f64)) {
    area.text(place, name, Font::new(12.0, Anchor::End).upright());
}

fn color(index: usize) -> Color {
    palette::SERIES[index % palette::SERIES.len()]
}

/// Names of the cells, each once, in order.
fn names(comparison: &Comparison, name: impl Fn(&Cell) -> &String) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for cell in &comparison.cells {
        let name = name(cell);
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::report::comparison::tests::with_a_loser;

    #[test]
    fn figures_are_whole_and_show_what_is_lost() {
        let folder = std::env::temp_dir().join(format!("glissade-{}-compare", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder for the figures");
        draw(&with_a_loser(), &folder).expect("drawn");
        let words = [
            ("compare-rms.svg", ["RMS, mm", "x500-recovery", "mass+30", "loser"]),
            ("compare-ratio.svg", ["loser / x500-smc", "x500-smc is better", "lost", "none"]),
            ("compare-survival.svg", ["0/6", "6/6", "0/1", "1/1"]),
        ];
        for (name, words) in words {
            let svg = fs::read_to_string(folder.join(name)).expect("the file was written");
            assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>") && !svg.contains("NaN"), "{name}");
            for word in words {
                assert!(svg.contains(word), "{name} has no {word}");
            }
        }
        fs::remove_dir_all(&folder).expect("the folder is there");
    }

    #[test]
    fn ticks_are_round_and_few() {
        assert_eq!(ticks(1.5, 60.0), [2.0, 5.0, 10.0, 20.0, 50.0]);
        assert_eq!(ticks(1100.0, 2500.0), [1500.0, 2000.0, 2500.0]);
        assert_eq!(ticks(0.008, 90.0), [0.01, 0.1, 1.0, 10.0]);
    }
}
