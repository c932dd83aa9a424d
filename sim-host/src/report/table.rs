//! The summary as a table for the terminal, beside what the paper claims and what is physically possible.

mod course;
mod numbers;
mod seeds;

use std::fmt::Write as _;

use self::numbers::{error, number, seconds, undefined};
pub use self::seeds::seeds;
use super::metrics::{AxisFigures, Recovery, TRACKING_FROM_S};
use super::mission::{Mission, end_text};
use super::paint::{Paint, Verdict};
use super::summary::Summary;
use crate::paper::claims::{AVERAGE_FOLLOWS, DISTURBANCE_REMOVED, PaperClaim, X_FOLLOWS, Y_FOLLOWS, Z_FOLLOWS};
use crate::sil::End;

/// Renders one flight, several lines with a newline at the end.
pub fn render(summary: &Summary, paint: Paint) -> String {
    heading(summary, paint) + "\n" + &result(summary) + &paint.dim(&figures(summary))
}

/// The verdict in one line, with its newline; why not in a second one.
pub fn heading(summary: &Summary, paint: Paint) -> String {
    let name = format!("{}, seed {}: ", summary.scenario, summary.seed);
    let (text, how) = verdict(summary);
    let why = summary.told.as_ref().and_then(|told| told.mission.as_ref()?.reason.as_ref());
    let why = why.map_or_else(String::new, |reason| format!("  {reason}\n"));
    name + &paint.verdict(&text, how) + "\n" + &why
}

/// The verdict in words, and what it is.
fn verdict(summary: &Summary) -> (String, Verdict) {
    let mission = summary.told.as_ref().and_then(|told| told.mission.as_ref());
    match mission {
        Some(Mission { completed: true, .. }) => ("mission completed".into(), Verdict::Good),
        Some(_) => ("mission NOT completed".into(), Verdict::Failed),
        None if summary.ended == End::NeverFlew => {
            let cure = || format!("it has no commands; `sim-host serve {}` lets you fly it", summary.scenario);
            (format!("never flew: {}", summary.beyond_reach.clone().unwrap_or_else(cure)), Verdict::Failed)
        }
        None => flown(summary),
    }
}

/// The verdict on a flight without a pilot: by where it was in its last second.
fn flown(summary: &Summary) -> (String, Verdict) {
    let end = end_text(&summary.ended, summary.duration_s);
    let why = summary.beyond_reach.as_ref().map_or_else(String::new, |why| format!(": {why}"));
    match &summary.missed {
        _ if !summary.survived => (end + &why, Verdict::Failed),
        Some(missed) => (format!("{end}, but {missed} in the last second{why}"), Verdict::Off),
        None => (end, Verdict::Good),
    }
}

/// What the flight was, without what matters less.
pub fn result(summary: &Summary) -> String {
    match &summary.told {
        Some(told) if told.mission.is_some() || summary.ended != End::NeverFlew => {
            course::render(told, summary.sensed.as_ref())
        }
        _ if summary.ended == End::NeverFlew => String::new(),
        _ => followed(summary),
    }
}

/// How the reference was followed, and what became of a disturbance.
fn followed(summary: &Summary) -> String {
    let table = match summary.roll_and_pitch {
        Some(_) => attitude_table(summary),
        None if !summary.settles => error_table(summary),
        None => settling_table(summary) + &bound(summary),
    };
    let path = summary.path_ends_s.map(|ends| {
        entry("path", &format!("ends at {ends:.1} s, after the flight: set `duration_s` to more to see it whole"))
    });
    let jump = summary.reference_jump_s.map(|t| {
        let text = format!("jumps at {t:.3} s: overshoot counts from there, times from the beginning");
        entry("reference", &text)
    });
    let short = (summary.survived && summary.axes.x.max_m.is_none())
        .then(|| entry("errors", "count from 4 s on, and the flight has ended: set `duration_s` to more"));
    let recovery = summary.recovery_s.as_ref().map(recovery);
    let early = early_error(summary).map(|distance| {
        let distance = error(Some(distance), "m");
        entry("at first", &format!("up to {distance} off within {TRACKING_FROM_S} s, of which the table tells nothing"))
    });
    [Some(table), early, path, jump, short, recovery].into_iter().flatten().collect()
}

/// An error that is worth a line, m.
const MATTERS_M: f64 = 1e-3;

/// The greatest distance from the reference (m), if errors count from later on, it matters, and no column shows it.
fn early_error(summary: &Summary) -> Option<f64> {
    let axes = &summary.axes;
    let [x, y, z] = [axes.x.max_m?, axes.y.max_m?, axes.z.max_m?];
    // No later distance is greater than this.
    let later = (x * x + y * y + z * z).sqrt();
    summary.distance_max_m.filter(|distance| !summary.settles && *distance > later.max(MATTERS_M))
}

/// How far each axis was off.
fn error_table(summary: &Summary) -> String {
    let mut rows =
        vec![["axis", "error RMS", "maximum"].map(String::from), ["", "after 4 s", "after 4 s"].map(String::from)];
    for (name, axis) in summary.axes.named() {
        let unit = unit(name);
        rows.push([name.into(), error(axis.rms_m, unit), error(axis.max_m, unit)]);
    }
    aligned(&rows) + "\n"
}

fn settling_table(summary: &Summary) -> String {
    let claimed = summary.papers_helix;
    let (paper, from) = if claimed { ("the paper follows", "from") } else { ("", "") };
    let mut rows = vec![
        ["axis", "within 5 cm", "within 2 mm", "RMS", "maximum", "overshoot", paper].map(String::from),
        ["", "from", "from", "after 4 s", "after 4 s", "", from].map(String::from),
    ];
    let claims = [Some(X_FOLLOWS), Some(Y_FOLLOWS), Some(Z_FOLLOWS), None].map(|claim| claim.filter(|_| claimed));
    for ((name, axis), claim) in summary.axes.named().into_iter().zip(claims) {
        rows.push(axis_row(name, axis, claim));
    }
    if let Some(average) = mean_settling(summary) {
        let [blank_1, blank_2, blank_3, blank_4] = [const { String::new() }; 4];
        let claim = if claimed { seconds(Some(AVERAGE_FOLLOWS.time_s)) } else { String::new() };
        rows.push(["mean xyz".into(), seconds(Some(average)), blank_1, blank_2, blank_3, blank_4, claim]);
    }
    aligned(&rows) + "yaw: within 0.05 rad and 0.002 rad\n\n"
}

/// How roll, pitch and yaw followed, where they are what is followed.
fn attitude_table(summary: &Summary) -> String {
    let mut rows = vec![
        ["axis", "within 5 cm,", "within 2 mm,", "RMS", "maximum", "overshoot", ""].map(String::from),
        ["", "50 mrad from", "2 mrad from", "after 4 s", "after 4 s", "", ""].map(String::from),
    ];
    let ([roll, pitch], axes) = (summary.roll_and_pitch.unwrap_or_default(), &summary.axes);
    let positions = [("x", &axes.x), ("y", &axes.y), ("z", &axes.z)];
    for (name, axis) in positions.into_iter().chain([("roll", &roll), ("pitch", &pitch), ("yaw", &axes.yaw)]) {
        rows.push(axis_row(name, axis, None));
    }
    aligned(&rows) + "\n"
}

fn axis_row(name: &str, axis: &AxisFigures, claim: Option<PaperClaim>) -> [String; 7] {
    let unit = unit(name);
    [
        name.into(),
        seconds(axis.settle_5cm_s),
        seconds(axis.settle_2mm_s),
        error(axis.rms_m, unit),
        error(axis.max_m, unit),
        axis.overshoot.map_or_else(undefined, |o| format!("{:.1} %", 100.0 * o)),
        claim.map_or_else(String::new, |c| seconds(Some(c.time_s))),
    ]
}

/// The unit of an axis' errors.
fn unit(axis: &str) -> &'static str {
    if matches!(axis, "roll" | "pitch" | "yaw") { "rad" } else { "m" }
}

/// Mean of the times at which x, y and z settle within 5 cm, s: of the paper's helix, for which it is claimed, and else
/// where all three began further off. An axis that had nothing to do would only make the mean look better.
fn mean_settling(summary: &Summary) -> Option<f64> {
    let axes = &summary.axes;
    let all_began_off = [axes.x, axes.y, axes.z].iter().all(|axis| axis.overshoot.is_some());
    if !(summary.papers_helix || all_began_off) {
        return None;
    }
    Some((axes.x.settle_5cm_s? + axes.y.settle_5cm_s? + axes.z.settle_5cm_s?) / 3.0)
}

/// When the last of x, y and z settles within 5 cm, s.
fn last_settling(summary: &Summary) -> Option<f64> {
    let axes = &summary.axes;
    Some(axes.x.settle_5cm_s?.max(axes.y.settle_5cm_s?).max(axes.z.settle_5cm_s?))
}

fn bound(summary: &Summary) -> String {
    let Some(bound) = summary.time_optimal_s else { return String::new() };
    let reached = last_settling(summary).map_or_else(
        || "not all of xyz are within 5 cm at the end".into(),
        |last| format!("all of xyz within 5 cm from {last:.3} s, {:.2} × the bound", last / bound),
    );
    entry("time-optimal bound", &format!("{bound:.2} s to join the reference exactly; {reached}"))
}

fn recovery(recovery: &Recovery) -> String {
    let (times, paper) = (recovery.as_array(), DISTURBANCE_REMOVED.time_s);
    if times.iter().all(|time| *time == Some(0.0)) {
        let text = format!("never further off than 5 cm, 2°, from its onset on (paper: removed in under {paper} s)");
        return entry("disturbance", &text);
    }
    let away = recovery.away();
    let judged = Recovery::NAMES.iter().zip(times).filter(|(name, _)| !away.contains(name));
    let each: Vec<_> = judged.map(|(name, time)| format!("{name} {}", seconds(time))).collect();
    let of_judged =
        format!("from its onset until the error stays within 5 cm (2°): {} (paper: under {paper} s)", each.join(", "));
    let of_others = format!("{} further off than that before its onset already", was(&away));
    let parts = [(!each.is_empty()).then_some(of_judged), (!away.is_empty()).then_some(of_others)];
    entry("disturbance", &parts.into_iter().flatten().collect::<Vec<_>>().join("; "))
}

/// Names, and the verb that goes with so many.
fn was(names: &[&str]) -> String {
    format!("{} {}", names.join(", "), if names.len() == 1 { "was" } else { "were" })
}

/// A line of what stands below the table: a name, and what is said of it.
pub fn entry(name: &str, text: &str) -> String {
    format!("{name:<18}  {text}\n")
}

fn figures(summary: &Summary) -> String {
    let effort = &summary.control_effort;
    let number = |value: Option<f64>, digits| value.map_or_else(undefined, |v| number(v, digits));
    let [thrust, roll, pitch, yaw] =
        [effort.thrust_rms_n, effort.roll_rms_n_m, effort.pitch_rms_n_m, effort.yaw_rms_n_m];
    let mut text = String::new();
    let mut line = |name: &str, value: &str| text += &entry(name, value);
    // Without rotors (`paper-decoupled`) the inputs switch between the rows, and figures of them would mislead.
    let has_rotors = summary.chattering.is_some();
    if summary.sensed.is_none() && has_rotors {
        line(
            "chattering",
            &format!(
                "{} (rad/s)²/s, {} after 4 s: total variation of ω²",
                number(summary.chattering, 0),
                number(summary.chattering_after_4s, 0)
            ),
        );
        line(
            "control effort",
            &format!(
                "U1 {} N, U2 {} N m, U3 {} N m, U4 {} N m RMS",
                number(thrust, 2),
                number(roll, 4),
                number(pitch, 4),
                number(yaw, 4)
            ),
        );
    }
    if summary.survived && !has_rotors {
        line(
            "inputs",
            "direct and unlimited; where a law switches them, a row shows one side, and `inputs.csv` their means",
        );
    }
    if has_rotors {
        line("saturated", &format!("{:.2} % of the ticks", 100.0 * summary.saturated_fraction));
    }
    line(
        "simulated",
        &format!("{} s, {} times as fast as real time", summary.duration_s, number(summary.real_time_factor, 0)),
    );
    line("truth SHA-256", &summary.truth_sha256);
    text
}

/// Pads every column to its widest cell: the first to the left, numbers to the right.
fn aligned<const N: usize>(rows: &[[String; N]]) -> String {
    aligned_to_width(rows).iter().map(|line| line.trim_end().to_owned() + "\n").collect()
}

/// The same as lines that are all as wide.
fn aligned_to_width<const N: usize>(rows: &[[String; N]]) -> Vec<String> {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; N] = std::array::from_fn(width);
    let line = |row: &[String; N]| {
        let mut line = format!("{:<1$}", row[0], widths[0]);
        for (cell, width) in row.iter().zip(widths).skip(1) {
            write!(line, "  {cell:>width$}").expect("a string takes every byte");
        }
        line
    };
    rows.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::super::summary::tests::{flight, metrics};
    use super::super::summary::{Aim, Flight, Row, Summary};
    use super::*;
    use crate::report::metrics::Metrics;

    #[test]
    fn a_flight_reads_as_expected() {
        let flight = Flight { disturbance_onset_s: Some(0.9), ..flight(true) };
        let text = render(&Summary::new(flight, &metrics()), Paint::PLAIN);
        let expected = "\
helix, seed 7: flown for 20 s

axis      within 5 cm  within 2 mm         RMS     maximum  overshoot  the paper follows
                 from         from   after 4 s   after 4 s                          from
x             1.000 s      1.000 s    1.500 mm    1.500 mm      0.0 %            0.000 s
y             0.000 s      0.000 s    0.000 mm    0.000 mm          –            0.400 s
z             0.000 s      0.000 s    0.000 mm    0.000 mm          –            0.350 s
yaw           0.000 s      0.000 s  0.000 mrad  0.000 mrad          –
mean xyz      0.333 s                                                            0.500 s
yaw: within 0.05 rad and 0.002 rad

time-optimal bound  1.31 s to join the reference exactly; all of xyz within 5 cm from 1.000 s, 0.76 × the bound
disturbance         from its onset until the error stays within 5 cm (2°): y 0.000 s, z 0.000 s, roll 0.000 s, pitch 0.000 s, yaw 0.000 s (paper: under 0.2 s); x was further off than that before its onset already
chattering          0 (rad/s)²/s, 0 after 4 s: total variation of ω²
control effort      U1 8.00 N, U2 0.0000 N m, U3 0.0000 N m, U4 0.0000 N m RMS
saturated           1.23 % of the ticks
simulated           20 s, 3210 times as fast as real time
truth SHA-256       abababababababababababababababababababababababababababababababab
";
        assert_eq!(text, expected);
    }

    #[test]
    fn a_flight_that_ends_off_its_reference_is_no_success() {
        let off =
            Summary { missed: Some("up to 13.2 m off its reference".into()), ..Summary::new(flight(true), &metrics()) };
        let expected = "helix, seed 7: flown for 20 s, but up to 13.2 m off its reference in the last second\n";
        assert_eq!(heading(&off, Paint::PLAIN), expected);
        assert_eq!(verdict(&off).1, Verdict::Off);
        assert_eq!(verdict(&Summary::new(flight(true), &metrics())).1, Verdict::Good);
    }

    #[test]
    fn a_jump_of_the_reference_and_errors_that_do_not_count_yet_are_told() {
        let jumped = Summary { reference_jump_s: Some(1.0), ..Summary::new(flight(true), &metrics()) };
        let text = render(&jumped, Paint::PLAIN);
        let line = "reference           jumps at 1.000 s: overshoot counts from there, times from the beginning\n";
        assert!(text.contains(line), "{text}");
        let short = Summary::new(Flight { settles: false, ..flight(true) }, &Metrics::new());
        let text = render(&short, Paint::PLAIN);
        assert!(text.contains("errors              count from 4 s on, and the flight has ended"), "{text}");
    }

    #[test]
    fn of_several_seeds_a_recovery_is_told_by_when_it_was_over() {
        let rows = |settles| {
            let summary = Summary::new(Flight { settles, ..flight(true) }, &metrics());
            [Row::Flown(Box::new(summary)), Row::Failed { seed: 8, error: "no room".into() }]
        };
        let reaching = "\
seed  x, y, z within  greatest  greatest in the  end
           5 cm from  distance      last second
7            1.000 s    4.00 m         1.500 mm  flown for 20 s
8                  –         –                –  ERROR: no room
";
        assert_eq!(seeds(&rows(true)), reaching);
        let following = "\
seed      x RMS      y RMS      z RMS  end
      after 4 s  after 4 s  after 4 s
7      1.500 mm   0.000 mm   0.000 mm  flown for 20 s
8             –          –          –  ERROR: no room
";
        assert_eq!(seeds(&rows(false)), following);
    }

    #[test]
    fn a_mean_is_of_axes_that_all_had_to_settle() {
        let of = |papers_helix, off: [bool; 3]| {
            let mut summary = Summary { papers_helix, ..Summary::new(flight(true), &metrics()) };
            let axes = &mut summary.axes;
            for (axis, off) in [&mut axes.x, &mut axes.y, &mut axes.z].into_iter().zip(off) {
                axis.overshoot = off.then_some(0.0);
            }
            render(&summary, Paint::PLAIN).contains("mean xyz")
        };
        assert!(of(false, [true; 3]) && !of(false, [true, false, true]), "x, y and z, or none");
        assert!(of(true, [false, true, true]), "the paper's mean counts its x, which begins on the helix");
    }

    #[test]
    fn of_several_seeds_under_a_disturbance_the_greatest_errors_and_the_recovery_are_told() {
        let flight = Flight { disturbance_onset_s: Some(2.0), aim: Aim::Attitude, ..flight(true) };
        let text = seeds(&[Row::Flown(Box::new(Summary::new(flight, &metrics())))]);
        let expected = "\
seed  greatest of x, y, z  of roll, pitch, yaw  all within 5 cm, 2°  end
                after 4 s            after 4 s       from its onset
7                1.500 mm           0.000 mrad              0.000 s  flown for 20 s
";
        assert_eq!(text, expected);
    }

    #[test]
    fn an_attitude_case_is_judged_by_its_angles() {
        let text = render(&Summary::new(Flight { aim: Aim::Attitude, ..flight(true) }, &metrics()), Paint::PLAIN);
        let rows: Vec<&str> = text.lines().skip(7).take(3).collect();
        let row = |name: &str| format!("{name:<5}       0.000 s       0.000 s  0.000 mrad  0.000 mrad          –");
        assert_eq!(rows, ["roll", "pitch", "yaw"].map(row), "{text}");
        assert!(text.lines().nth(4).is_some_and(|line| line.starts_with("x ")), "{text}");
        assert!(!text.contains("mean xyz"), "{text}");
    }

    #[test]
    fn a_flight_without_figures_still_has_a_table() {
        let text = render(&Summary::new(flight(false), &Metrics::new()), Paint::PLAIN);
        assert!(text.contains("LOST") && !text.contains("never") && !text.contains("NaN"), "{text}");
    }
}
