//! A comparison as people and scripts read it: tables for the terminal and for a document, JSON, a CSV row a flight.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use crate::compare::{Cell, Comparison, Figure, FlightScore, LostCell, Medians, Overall};
use crate::statistics::Estimate;

/// Letters of a column of a cell's controller, of a disturbance, and between columns: four controllers fit in 120.
const COLUMN: usize = 23;
const NAME: usize = 17;
/// Controllers side by side.
const BESIDE: usize = 4;

/// The columns of the table over the whole matrix: heading, figure, and what its unit is a part of.
const OVERALL: [(&str, Figure, f64); 9] = [
    ("RMS mm", Figure::Rms, 1e3),
    ("max mm", Figure::Max, 1e3),
    ("settle s", Figure::Settle, 1.0),
    ("tilted °", Figure::Attitude, 180.0 / core::f64::consts::PI),
    ("sunk mm", Figure::Altitude, 1e3),
    ("mN m", Figure::Torque, 1e3),
    ("ω² k", Figure::Omega, 1e-3),
    ("TV M/s", Figure::Chattering, 1e-6),
    ("sat. %", Figure::Saturated, 1e2),
];

const EXPLAINED: &str = "RMS and maximum of the distance from the trajectory, from where it is joined; time to 5 cm for \
good; greatest error of\nthe attitude; altitude lost; RMS torque demanded; mean ω², 1000 (rad/s)²; total variation of \
the commanded ω² a second,\n10⁶ (rad/s)²/s; time in which the mixer met a limit. Each is the median over the cells of \
the cells' medians.\n";

/// Writes compare.json, compare.csv and compare.md.
///
/// # Errors
/// When a file cannot be written; the message names it.
pub fn write(comparison: &Comparison, folder: &Path) -> Result<()> {
    let json = serde_json::to_string_pretty(comparison)? + "\n";
    for (name, text) in
        [("compare.json", json), ("compare.csv", csv(&comparison.flights)), ("compare.md", markdown(comparison))]
    {
        let path = folder.join(name);
        fs::write(&path, text)
            .with_context(|| format!("cannot write {}: choose a folder you can write to with --out", path.display()))?;
    }
    Ok(())
}

/// A row a flight; what a flight does not have is empty.
pub fn csv(flights: &[FlightScore]) -> String {
    let mut text = "scenario,disturbance,controller,seed,survived,flown_s".to_owned();
    Figure::ALL.iter().for_each(|figure| text.extend([",", figure.key()]));
    for flight in flights {
        let (FlightScore { scenario, disturbance, controller, seed, score }, survived) =
            (flight, flight.score.survived);
        let names = [scenario, disturbance, controller].map(|name| quoted(name)).join(",");
        let _ = write!(text, "\n{names},{seed},{survived},{}", score.flown_s);
        for figure in Figure::ALL {
            let value = figure.of(score).map_or_else(String::new, |value| value.to_string());
            text.extend([",", &value]);
        }
    }
    text + "\n"
}

/// A field of a CSV file, after RFC 4180.
fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n']) { format!("\"{}\"", field.replace('"', "\"\"")) } else { field.to_owned() }
}

/// Renders a comparison for the terminal, at most 120 columns wide for names of usual lengths.
pub fn render(comparison: &Comparison) -> String {
    let mut text = heading(comparison);
    let indices: Vec<usize> = (0..comparison.controllers.len()).collect();
    for beside in indices.chunks(BESIDE) {
        let names = beside.iter().map(|i| comparison.controllers[*i].clone()).collect();
        line(&mut text, "", names);
        let mut scenario = "";
        for cell in &comparison.cells {
            if cell.scenario != scenario {
                scenario = &cell.scenario;
                let _ = writeln!(text, "{scenario}");
            }
            line(
                &mut text,
                &format!("  {}", cell.disturbance),
                beside.iter().map(|i| entry(&cell.controllers[*i])).collect(),
            );
        }
        text.push('\n');
    }
    text.push_str(&overall_table(comparison));
    text.push('\n');
    lost_cells(comparison).iter().for_each(|sentence| text.extend([sentence, "\n"]));
    text
}

fn line(text: &mut String, name: &str, entries: Vec<String>) {
    let entries: String = entries.iter().map(|entry| format!("  {entry:<COLUMN$}")).collect();
    text.extend([format!("{name:<NAME$}{entries}").trim_end(), "\n"]);
}

fn heading(comparison: &Comparison) -> String {
    let Comparison { matrix, summary, seeds, flights, .. } = comparison;
    let (seeds, trained) = (String::from(*seeds), comparison.seeds_are_trained_on);
    let trained = if trained { " (SOME OF THEM TUNED ON)" } else { "" };
    format!(
        "{matrix}: {summary}\n{} flights; seeds {seeds}{trained}; one flight where the seed changes nothing\n\n\
         RMS distance from the trajectory, mm: median [95 % interval], survived/flown where some are lost\n\n",
        flights.len()
    )
}

/// The median error of a cell with its interval, and how many survived if not all did.
fn entry(medians: &Medians) -> String {
    let Estimate { median, interval, .. } = *medians.rms();
    let value = |metres: f64| number(1e3 * metres, "lost");
    let interval = interval.map_or_else(String::new, |(low, high)| format!(" [{}, {}]", value(low), value(high)));
    let Medians { flights, survived, .. } = medians;
    let survived = if survived < flights { format!(" {survived}/{flights}") } else { String::new() };
    value(median) + &interval + &survived
}

/// Three digits; `infinite` where there is no number.
fn number(value: f64, infinite: &str) -> String {
    match value.abs() {
        size if !size.is_finite() => infinite.to_owned(),
        size if size < 1e-3 => {
            if size == 0.0 {
                "0".to_owned()
            } else {
                format!("{value:.0e}")
            }
        }
        size if size < 9.995 => format!("{value:.2}"),
        size if size < 99.95 => format!("{value:.1}"),
        size if size < 1e5 => format!("{value:.0}"),
        _ => format!("{value:.1e}"),
    }
}

/// The headings and, a controller each, the rows of the table over the whole matrix.
fn overall_rows(comparison: &Comparison) -> Vec<Vec<String>> {
    let mut headings = vec!["controller".to_owned(), "ratio".to_owned(), "survived".to_owned()];
    headings.extend(OVERALL.map(|(heading, _, _)| heading.to_owned()));
    let row = |overall: &Overall| {
        let Medians { flights, survived, .. } = overall.medians;
        let ratio = number(overall.rms_ratio, "lost");
        let mut row = vec![overall.controller.clone(), ratio, format!("{survived}/{flights}")];
        row.extend(OVERALL.map(|(_, figure, scale)| {
            let infinite = if figure == Figure::Settle { "never" } else { "lost" };
            number(scale * overall.medians.estimate(figure).median, infinite)
        }));
        row
    };
    std::iter::once(headings).chain(comparison.overall.iter().map(row)).collect()
}

fn overall_table(comparison: &Comparison) -> String {
    let rows = overall_rows(comparison);
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..rows[0].len()).map(width).collect();
    let mut text = "whole matrix; `ratio`: RMS over the first controller's under the same seed, median over seeds, then over cells\n".to_owned();
    for row in &rows {
        let rest: String =
            row[1..].iter().zip(&widths[1..]).map(|(entry, width)| format!("  {entry:>width$}")).collect();
        let (name, width) = (&row[0], widths[0]);
        let _ = writeln!(text, "{name:<width$}{rest}");
    }
    text + EXPLAINED
}

/// What the first controller loses, and to which other, in sentences.
fn lost_cells(comparison: &Comparison) -> Vec<String> {
    let [first, others @ ..] = comparison.overall.as_slice() else { return Vec::new() };
    let (name, cells) = (&first.controller, comparison.cells.len());
    let against = |other: &Overall| {
        let Overall { controller, better_cells, worse_cells, .. } = other;
        format!("{name} against {controller}: less RMS in {worse_cells} of {cells} cells, more in {better_cells}")
    };
    let mut text: Vec<String> = others.iter().map(against).collect();
    text.extend(comparison.lost.iter().map(lost_cell));
    text
}

fn lost_cell(cell: &LostCell) -> String {
    let LostCell { scenario, disturbance, to, rms_ratio, clear } = cell;
    let ratio = |ratio: f64| format!("{ratio:.3}");
    let interval =
        rms_ratio.interval.map_or_else(String::new, |(low, high)| format!(" [{}, {}]", ratio(low), ratio(high)));
    let chance = if *clear { "" } else { ", which may be chance" };
    format!("lost: {scenario} under {disturbance} to {to}, {} of the RMS{interval}{chance}", ratio(rms_ratio.median))
}

/// The same as [`render`] for a document.
pub fn markdown(comparison: &Comparison) -> String {
    let row = |entries: Vec<String>| format!("| {} |\n", entries.join(" | "));
    let rule = |columns: usize| format!("|{}\n", " --- |".repeat(columns));
    let mut text = heading(comparison);
    let names = comparison.controllers.iter().cloned();
    text += &row(["scenario", "disturbance"].map(String::from).into_iter().chain(names).collect());
    text += &rule(2 + comparison.controllers.len());
    for Cell { scenario, disturbance, controllers, .. } in &comparison.cells {
        let entries = controllers.iter().map(entry);
        text += &row([scenario.clone(), disturbance.clone()].into_iter().chain(entries).collect());
    }
    text.push('\n');
    for (i, entries) in overall_rows(comparison).into_iter().enumerate() {
        let columns = entries.len();
        text += &row(entries);
        if i == 0 {
            text += &rule(columns);
        }
    }
    text.extend([
        "\n",
        EXPLAINED,
        "`ratio`: RMS over the first controller's under the same seed, median over seeds, then over cells.\n\n",
    ]);
    lost_cells(comparison).iter().for_each(|sentence| text.extend(["- ", sentence, "\n"]));
    text
}
