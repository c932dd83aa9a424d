//! The paper's study as people and scripts read it: blocks for the terminal, a table for a document, JSON.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use anyhow::Result;

use super::out::write_file;
use crate::paper::{Line, Study};

/// Letters of a line on the terminal.
const WIDTH: usize = 100;
/// What the lines of a claim after its first begin with.
const INDENT: &str = "    ";

/// Writes paper.json and paper.md.
///
/// # Errors
/// When a file cannot be written; the message names it.
pub fn write(study: &Study, folder: &Path) -> Result<()> {
    let json = serde_json::to_string_pretty(study)? + "\n";
    for (name, text) in [("paper.json", json), ("paper.md", markdown(study))] {
        write_file(&folder.join(name), text)?;
    }
    Ok(())
}

/// The study for the terminal, with a newline at the end.
pub fn render(study: &Study) -> String {
    let mut text =
        wrapped("The paper: ", study.title) + "\n" + &table(study) + "\nWhat is compared, and why it differs\n\n";
    for (i, line) in study.claims.iter().enumerate() {
        let measured = format!("{}, {}: {}. Why: {}", line.place, line.flight, line.measure, line.why);
        text.push_str(&wrapped(&format!("{:>2}  ", i + 1), &measured));
    }
    text.push_str("\nErrata that change a flight: printed, flown instead, and what the printed form would do\n\n");
    for erratum in &study.errata {
        let all = format!("{}. Flown: {}. As printed: {}", erratum.printed, erratum.flown, erratum.effect);
        text.push_str(&wrapped(INDENT, &format!("{}: {all}", erratum.place)));
    }
    text + "\n" + &gains(study) + &vehicle(study)
}

/// The claims with their numbers.
fn table(study: &Study) -> String {
    let width = study.claims.iter().map(|line| line.claim.chars().count()).max().unwrap_or(0);
    let row = |number: &str, [claim, paper, here, difference]: [&str; 4]| {
        format!("{number:>2}  {claim:<width$}  {paper:>9}  {here:>9}  {difference:>10}\n")
    };
    let mut text = row("", ["claim", "paper", "here", "difference"]);
    for (i, line) in study.claims.iter().enumerate() {
        let here = number(line.here, line.unit);
        text.push_str(&row(&(i + 1).to_string(), [&line.claim, &stated(line), &here, &difference(line)]));
    }
    text
}

/// Where the files are.
pub fn files(folder: &Path, figures: &[PathBuf]) -> String {
    let names: Vec<_> = figures.iter().filter_map(|file| file.file_name()?.to_str()).collect();
    let list = wrapped("figures: ", &names.join(", "));
    format!("{list}All of this is in {}, the table in paper.md and paper.json.", folder.display())
}

/// The claims as a table for a document.
pub fn markdown(study: &Study) -> String {
    let mut text = "| claim | paper | here | difference | why |\n| --- | --- | --- | --- | --- |\n".to_owned();
    for line in &study.claims {
        let here = format!("{} {}, `{}`", number(line.here, line.unit), line.measure, line.flight);
        let cells = [&format!("{} ({})", line.claim, line.place), &stated(line), &here, &difference(line), &line.why];
        let _ = writeln!(text, "| {} |", cells.map(|cell| cell.replace('|', "\\|")).join(" | "));
    }
    text
}

fn stated(line: &Line) -> String {
    line.paper.map_or_else(|| "no number".into(), |value| number(Some(value), line.unit))
}

fn difference(line: &Line) -> String {
    match (line.paper, line.here, line.difference) {
        (None, _, _) => "–".into(),
        (Some(_), None, _) => "never".into(),
        (_, _, value) => value.map_or_else(
            || "–".into(),
            |value| {
                let sign = if value < 0.0 { '−' } else { '+' };
                format!("{sign}{}", number(Some(value.abs()), line.unit))
            },
        ),
    }
}

/// A value as people write it: lengths below a metre in mm.
fn number(value: Option<f64>, unit: &str) -> String {
    match (value, unit) {
        (None, _) => "never".into(),
        (Some(v), "s") => format!("{v:.3} s"),
        (Some(v), "m") if v < 0.1 => format!("{:.2} mm", 1e3 * v),
        (Some(v), "m") => format!("{v:.2} m"),
        (Some(v), unit) => format!("{v:.0} {unit}"),
    }
}

fn gains(study: &Study) -> String {
    let mut text = format!("Table 1 as flown\n\n{:<6} {:>8} {:>8} {:>9}\n", "axis", "K", "λ", "ρ");
    for row in &study.table_1 {
        let rho = row.rho.map_or_else(|| "–".into(), |rho| rho.to_string());
        let _ = writeln!(text, "{:<6} {:>8} {:>8} {rho:>9}", row.axis, row.gain, row.lambda);
    }
    text + "\n"
}

fn vehicle(study: &Study) -> String {
    let a = &study.table_2;
    let [lift, yaw, arm] = [a.rotors[0].lift_n_s2, a.rotors[0].yaw_n_m_s2, a.rotors[0].x_m];
    let list = |values: [f64; 3]| values.map(|value| value.to_string()).join(", ");
    format!(
        "Table 2 as flown\n\n\
         b {lift} N s²/rad², d {yaw} N m s²/rad², m {} kg, l {arm} m, Jr {} kg m², g {} m/s²\n\
         I {} kg m², k1..3 {} N s/m, k4..6 {} N m s²/rad²\n",
        a.mass_kg,
        a.rotor_inertia_kg_m2,
        a.gravity_m_s2,
        list(a.inertia_kg_m2),
        list(a.drag_n_s_m),
        list(a.rotational_drag_n_m_s2),
    )
}

/// Breaks a text into lines of so many letters, the first after `head`, the others indented.
fn wrapped(head: &str, text: &str) -> String {
    let mut lines = vec![head.to_owned()];
    for word in text.split_whitespace() {
        let line = lines.last_mut().expect("it begins with one");
        let blank = line.trim().is_empty() || line.ends_with(' ');
        if !blank && line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push(format!("{INDENT}{word}"));
        } else {
            line.push_str(if blank { "" } else { " " });
            line.push_str(word);
        }
    }
    lines.join("\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_people_do() {
        assert_eq!(number(Some(0.448), "s"), "0.448 s");
        assert_eq!(number(Some(0.000_044), "m"), "0.04 mm");
        assert_eq!(number(Some(13.193), "m"), "13.19 m");
        assert_eq!(number(Some(205.2), "N"), "205 N");
        assert_eq!(number(None, "s"), "never");
    }

    #[test]
    fn long_texts_are_broken_between_words() {
        let text = wrapped("why: ", &"word ".repeat(60));
        assert!(text.lines().count() == 4 && text.lines().all(|line| line.chars().count() <= WIDTH), "{text}");
        assert!(text.starts_with("why: word word") && text.lines().skip(1).all(|line| line.starts_with(INDENT)));
        assert_eq!(wrapped(INDENT, "a b"), "    a b\n");
    }
}
