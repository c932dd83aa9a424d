//! The figures of a comparison: errors a cell with their intervals, ratios to the first controller, survival.

use std::path::Path;

use anyhow::Result;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::panel::{Area, Chart, Key, palette, px, save, text};
use super::series::extent;
use crate::compare::{Cell, Comparison, Medians, RESOLUTION_M};

/// Shown pixels of a chart of one scenario, of the names of its disturbances, and of a map's square.
const CHART: (u32, u32) = (680, 330);
const NAMES: u32 = 110;
const SQUARE: (u32, u32) = (66, 26);
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

/// RMS errors, a chart a scenario.
fn errors(comparison: &Comparison, path: &Path) -> Result<()> {
    let scenarios = names(comparison, |cell| &cell.scenario);
    let (columns, rows) = (scenarios.len().min(2), scenarios.len().div_ceil(2));
    let keys: Vec<Key> =
        comparison.controllers.iter().enumerate().map(|(i, name)| Key::Series(name, color(i))).collect();
    let size = (CHART.0 * columns as u32, 44 + CHART.1 * rows as u32);
    save(path, size, "RMS distance from the trajectory: median, 95 % interval (a cross: lost)", &keys, |area| {
        let charts = area.split_evenly((rows, columns));
        scenarios.iter().zip(&charts).try_for_each(|(scenario, chart)| {
            let cells: Vec<&Cell> = comparison.cells.iter().filter(|cell| cell.scenario == *scenario).collect();
            errors_of_scenario(chart, scenario, &cells)
        })
    })
}

fn errors_of_scenario(area: &Area, scenario: &str, cells: &[&Cell]) -> Result<()> {
    let (low, high) = range_mm(cells);
    let mut chart = ChartBuilder::on(area)
        .caption(scenario, text(15))
        .margin(px(8))
        .x_label_area_size(px(NAMES))
        .y_label_area_size(px(64))
        .build_cartesian_2d(0.0..cells.len() as f64, libm::log10(low)..libm::log10(high))?;
    // The axes' names and frame; ticks of a logarithm are drawn by hand.
    let axes = palette::INK.stroke_width(3);
    chart.configure_mesh().disable_mesh().axis_style(axes).x_labels(0).y_labels(0).draw()?;
    let (left, top) = area.get_base_pixel();
    let right = Pos::new(HPos::Right, VPos::Center);
    for value in ticks(low, high) {
        let line = vec![(0.0, libm::log10(value)), (cells.len() as f64, libm::log10(value))];
        let (x, y) = chart.backend_coord(&line[0]);
        area.draw(&Text::new(value.to_string(), (x - left - px(6).cast_signed(), y - top), text(12).pos(right)))?;
        chart.draw_series([PathElement::new(line, palette::GRID.stroke_width(1))])?;
    }
    let (x, y) = chart.backend_coord(&(0.0, libm::log10(high)));
    let unit = Text::new("RMS, mm", (x - left, y - top - px(8).cast_signed()), text(12).pos(right));
    area.draw(&unit)?;
    for (i, cell) in cells.iter().enumerate() {
        let border = vec![(i as f64 + 1.0, libm::log10(low)), (i as f64 + 1.0, libm::log10(high))];
        chart.draw_series([PathElement::new(border, palette::GRID.stroke_width(1))])?;
        let (x, y) = chart.backend_coord(&(i as f64 + 0.5, libm::log10(low)));
        upright(area, &cell.disturbance, (x - left, y - top + px(6).cast_signed()))?;
        draw_errors(&mut chart, i as f64, cell, (low, high))?;
    }
    Ok(())
}

/// The errors of each controller in the cell that begins at `from` on the horizontal axis, between `low` and `high`
/// (mm): a dot with its interval, or a cross at the top for what is lost.
fn draw_errors(chart: &mut Chart, from: f64, cell: &Cell, (low, high): (f64, f64)) -> Result<()> {
    let height = |metres: f64| libm::log10((1e3 * metres).clamp(low, high));
    for (i, medians) in cell.controllers.iter().enumerate() {
        let across = from + (i as f64 + 1.0) / (cell.controllers.len() as f64 + 1.0);
        if let Some((best, worst)) = medians.rms().interval {
            let whisker = vec![(across, height(best)), (across, height(worst))];
            chart.draw_series([PathElement::new(whisker, color(i).stroke_width(6))])?;
        }
        let median = medians.rms().median;
        if median.is_finite() {
            chart.draw_series([Circle::new((across, height(median)), px(3), color(i).filled())])?;
        } else {
            chart.draw_series([Cross::new((across, height(median)), px(4), color(i).stroke_width(6))])?;
        }
    }
    Ok(())
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
    all.filter(|value| (low..=high).contains(value)).collect()
}

/// Each other controller's RMS error over the first one's, a map a controller.
fn ratios(comparison: &Comparison, path: &Path) -> Result<()> {
    let first = &comparison.controllers[0];
    let maps: Vec<(usize, String)> =
        comparison.controllers.iter().enumerate().skip(1).map(|(i, name)| (i, format!("{name} / {first}"))).collect();
    let keys = [Key::Series("first is better", palette::FLOWN), Key::Series("first is worse", palette::START)];
    maps_of_cells(
        comparison,
        path,
        "RMS over the first controller's under the same seed: median",
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

/// Which part of the flights survived, a map a controller.
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
    square: impl Fn(&Cell, usize) -> (String, RGBColor, f64),
) -> Result<()> {
    let across = names(comparison, |cell| &cell.scenario);
    let down = names(comparison, |cell| &cell.disturbance);
    let width = SQUARE.0 * across.len() as u32 + 24;
    let total = (NAMES + 20 + width * maps.len() as u32).max(560);
    let size = (total, 44 + 30 + SQUARE.1 * down.len() as u32 + NAMES);
    save(path, size, heading, keys, |area| {
        let right = Pos::new(HPos::Right, VPos::Center);
        for (row, name) in down.iter().enumerate() {
            let place = (px(NAMES + 4).cast_signed(), middle(30, SQUARE.1, row));
            area.draw(&Text::new((*name).to_owned(), place, text(12).pos(right)))?;
        }
        for (map, (index, title)) in maps.iter().enumerate() {
            let left = NAMES + 10 + width * map as u32;
            area.draw(&Text::new(title.clone(), (px(left).cast_signed(), px(6).cast_signed()), text(14)))?;
            for cell in &comparison.cells {
                let place = |names: &[&str], name: &str| names.iter().position(|known| *known == name).unwrap_or(0);
                let at = (place(&across, &cell.scenario), place(&down, &cell.disturbance));
                draw_square(area, left, at, square(cell, *index))?;
            }
            for (column, name) in across.iter().enumerate() {
                let below = px(30 + SQUARE.1 * down.len() as u32 + 6).cast_signed();
                upright(area, name, (middle(left, SQUARE.0, column), below))?;
            }
        }
        Ok(())
    })
}

fn draw_square(
    area: &Area,
    left: u32,
    at: (usize, usize),
    (label, color, strength): (String, RGBColor, f64),
) -> Result<()> {
    let corner = |column: usize, row: usize| {
        (px(left + SQUARE.0 * column as u32).cast_signed(), px(30 + SQUARE.1 * row as u32).cast_signed())
    };
    let corners = [corner(at.0, at.1), corner(at.0 + 1, at.1 + 1)];
    area.draw(&Rectangle::new(corners, WHITE.filled()))?;
    // Half the colour at most: the label stays readable.
    area.draw(&Rectangle::new(corners, color.mix(0.7 * strength).filled()))?;
    area.draw(&Rectangle::new(corners, palette::GRID.stroke_width(2)))?;
    let center = Pos::new(HPos::Center, VPos::Center);
    let place = (middle(left, SQUARE.0, at.0), middle(30, SQUARE.1, at.1));
    area.draw(&Text::new(label, place, text(12).pos(center)))?;
    Ok(())
}

/// The middle of the square `index` of those of `size` that begin at `start`, all shown pixels, in the page's units.
fn middle(start: u32, size: u32, index: usize) -> i32 {
    px(start + size * index as u32).cast_signed() + px(size).cast_signed() / 2
}

/// A name turned by a quarter, its end at `place`.
fn upright(area: &Area, name: &str, place: (i32, i32)) -> Result<()> {
    let turned = ("sans-serif", px(12)).into_font().transform(FontTransform::Rotate270).color(&palette::INK);
    area.draw(&Text::new(name.to_owned(), place, turned.pos(Pos::new(HPos::Right, VPos::Center))))?;
    Ok(())
}

fn color(index: usize) -> RGBColor {
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
            ("compare-ratio.svg", ["loser / x500-smc", "first is better", "lost", "none"]),
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
        assert_eq!(ticks(0.008, 90.0), [0.01, 0.1, 1.0, 10.0]);
    }
}
