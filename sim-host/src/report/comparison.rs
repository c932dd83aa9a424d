//! A comparison as people and scripts read it: tables for the terminal and for a document, JSON, a CSV row a flight.

use std::fmt::Write as _;
use std::path::Path;

use anyhow::Result;

use super::out::write_file;
use crate::compare::{Cell, Comparison, Figure, FlightScore, LostCell, Medians, Overall};
use crate::statistics::{Estimate, FOR_AN_INTERVAL};
use crate::words::counted;

/// Letters of a column of a cell's controller, of a disturbance, and between columns: four controllers fit in 120.
const COLUMN: usize = 23;
const NAME: usize = 17;
/// Controllers side by side.
const BESIDE: usize = 4;

/// The columns of the table over all cells: heading, figure, and what its unit is a part of.
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

const RATIO: &str = "`ratio`: RMS over the first controller's under the same seed, median over seeds, then over cells";

/// Writes compare.json, compare.csv and compare.md.
///
/// # Errors
/// When a file cannot be written; the message names it.
pub fn write(comparison: &Comparison, folder: &Path) -> Result<()> {
    let json = serde_json::to_string_pretty(comparison)? + "\n";
    for (name, text) in
        [("compare.json", json), ("compare.csv", csv(&comparison.flights)), ("compare.md", markdown(comparison))]
    {
        write_file(&folder.join(name), text)?;
    }
    Ok(())
}

/// A row a flight; what a flight does not have is empty.
pub fn csv(flights: &[FlightScore]) -> String {
    let mut text = "scenario,disturbance,controller,seed,survived,flown_s".to_owned();
    text.extend(Figure::ALL.map(|figure| format!(",{}", figure.key())));
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
        let names: Vec<String> = beside.iter().map(|i| comparison.controllers[*i].clone()).collect();
        line(&mut text, "", &names);
        let mut scenario = "";
        for cell in &comparison.cells {
            if cell.scenario != scenario {
                scenario = &cell.scenario;
                let _ = writeln!(text, "{scenario}");
            }
            let entries: Vec<String> = beside.iter().map(|i| entry(&cell.controllers[*i])).collect();
            line(&mut text, &format!("  {}", cell.disturbance), &entries);
        }
        text.push('\n');
    }
    text.push_str(&overall_table(comparison));
    text.push('\n');
    text.extend(lost_cells(comparison).iter().map(|sentence| format!("{sentence}\n")));
    text
}

fn line(text: &mut String, name: &str, entries: &[String]) {
    let mut line = format!("{name:<NAME$}");
    for entry in entries {
        let _ = write!(line, "  {entry:<COLUMN$}");
    }
    text.extend([line.trim_end(), "\n"]);
}

fn heading(comparison: &Comparison) -> String {
    let Comparison { matrix, summary, seeds, flights, .. } = comparison;
    let (seeds, trained) = (String::from(*seeds), comparison.seeds_are_trained_on);
    let trained = if trained { " (SOME OF THEM TUNED ON)" } else { "" };
    let few = comparison.seeds.count() < FOR_AN_INTERVAL as u64 && comparison.cells.iter().any(|cell| cell.random);
    let summary = if summary.is_empty() { String::new() } else { format!(": {summary}") };
    let set = &comparison.set;
    let set = if set.is_empty() { String::new() } else { format!("every scenario with {}\n", set.join(", ")) };
    let few = if few { ". No interval: it takes six seeds or more" } else { "" };
    format!(
        "{matrix}{summary}\n{set}{}; seeds {seeds}{trained}; one flight where the seed changes nothing{few}\n\n\
         RMS distance from the trajectory, mm: median [95 % interval], survived/flown where some are lost\n\n",
        counted(flights.len(), "flight")
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

/// The headings and, a controller each, the rows of the table over all cells.
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

/// The cells that were flown: all of the matrix', or those selected.
fn cells(comparison: &Comparison) -> String {
    match (comparison.cells.len(), comparison.matrix_cells) {
        (flown, whole) if flown < whole => format!("{flown} of {whole} cells"),
        _ => "whole matrix".to_owned(),
    }
}

fn overall_table(comparison: &Comparison) -> String {
    let rows = overall_rows(comparison);
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..rows[0].len()).map(width).collect();
    let mut text = format!("{}; {RATIO}\n", cells(comparison));
    for row in &rows {
        let (name, width) = (&row[0], widths[0]);
        let _ = write!(text, "{name:<width$}");
        for (entry, width) in row[1..].iter().zip(&widths[1..]) {
            let _ = write!(text, "  {entry:>width$}");
        }
        text.push('\n');
    }
    text + EXPLAINED
}

/// What the first controller loses, and to which other, in sentences.
fn lost_cells(comparison: &Comparison) -> Vec<String> {
    let [first, others @ ..] = comparison.overall.as_slice() else { return Vec::new() };
    let (name, cells) = (&first.controller, comparison.cells.len());
    let against = |other: &Overall| {
        let Overall { controller, better_cells, worse_cells, .. } = other;
        let equal = match cells - worse_cells - better_cells {
            0 => String::new(),
            equal => format!(", equal in {equal}"),
        };
        format!(
            "{name} against {controller}: less RMS in {worse_cells} of {cells} cells, more in {better_cells}{equal}"
        )
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
    text.extend(["\n", EXPLAINED, RATIO, ".\n\n"]);
    text.extend(lost_cells(comparison).iter().map(|sentence| format!("- {sentence}\n")));
    text
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::compare::Contest;
    use crate::matrix::Matrix;
    use crate::score::Score;

    /// The x500's own tuning in two cells for 50 ms: enough for tables and figures.
    pub(in crate::report) fn comparison() -> Comparison {
        let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        let mut matrix = Matrix::load("x500", &names(&["duration_s=0.05"])).expect("valid");
        matrix
            .select(Some(&names(&["x500-hover", "x500-recovery"])), Some(&names(&["none", "mass+30"])))
            .expect("known");
        matrix.file.controllers = names(&["x500-smc"]);
        matrix.file.seeds = "1001..1006".parse().expect("valid");
        Contest::new(&matrix).and_then(|contest| contest.fly(|| ())).expect("flown")
    }

    /// The same with a second controller, all of whose flights are lost.
    pub(in crate::report) fn with_a_loser() -> Comparison {
        let mut comparison = comparison();
        let flight = FlightScore { score: Score::default(), ..comparison.flights[0].clone() };
        let all_lost = |medians: &Medians| Medians::of_flights(&vec![flight.clone(); medians.flights]);
        for cell in &mut comparison.cells {
            let (first, ratio) = (all_lost(&cell.controllers[0]), cell.rms_ratios[0]);
            cell.controllers.push(first);
            cell.rms_ratios.push(Estimate { median: f64::INFINITY, ..ratio });
        }
        let first = comparison.overall[0].clone();
        let medians = all_lost(&first.medians);
        comparison.overall.push(Overall { controller: "loser".into(), medians, rms_ratio: f64::INFINITY, ..first });
        comparison.controllers.push("loser".into());
        comparison
    }

    #[test]
    fn tables_fit_the_terminal_and_show_what_is_lost() {
        let text = render(&with_a_loser());
        assert!(text.lines().all(|line| line.chars().count() <= 120), "{text}");
        assert!(text.contains("lost 0/1") && text.contains("lost [lost, lost] 0/6"), "{text}");
        assert!(!text.contains("inf") && !text.contains("NaN"), "{text}");
        assert!(text.contains("\n4 of ") && text.contains(" cells; `ratio`"), "{text}");
        let markdown = markdown(&with_a_loser());
        let columns = |line: &str| line.matches('|').count();
        assert!(
            markdown.lines().filter(|line| line.starts_with("| x500-")).all(|line| columns(line) >= 5),
            "{markdown}"
        );
    }

    #[test]
    fn too_few_seeds_for_an_interval_are_named() {
        let few = "one flight where the seed changes nothing. No interval: it takes six seeds or more\n";
        let comparison = comparison();
        assert!(!render(&comparison).contains("No interval"));
        let comparison = Comparison { seeds: "1001..1005".parse().expect("valid"), ..comparison };
        assert!(render(&comparison).contains(few) && markdown(&comparison).contains(few));
    }

    #[test]
    fn a_row_a_flight_in_csv_with_as_many_fields_as_the_heading() {
        let comparison = comparison();
        let text = csv(&comparison.flights);
        let fields: Vec<usize> = text.lines().map(|line| line.split(',').count()).collect();
        // Two deterministic cells of x500-hover, two random ones of x500-recovery with six seeds.
        assert_eq!(fields, vec![6 + Figure::ALL.len(); 1 + 2 + 12]);
        assert_eq!(quoted("a,\"b\""), "\"a,\"\"b\"\"\"");
    }

    #[test]
    fn numbers_have_three_digits() {
        for (value, text) in
            [(0.0, "0"), (6e-5, "6e-5"), (1.234, "1.23"), (12.34, "12.3"), (1234.4, "1234"), (2e6, "2.0e6")]
        {
            assert_eq!(number(value, "lost"), text);
        }
        assert_eq!(number(f64::INFINITY, "lost"), "lost");
    }
}
