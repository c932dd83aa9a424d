//! The summary as a table for the terminal, beside what the paper claims and what is physically possible.

use std::fmt::Write as _;

use super::metrics::{AxisFigures, Recovery};
use super::sensed::{Knowledge, Sensed};
use super::summary::Summary;
use super::touchdown::Contact;
use crate::paper::claims::{AVERAGE_FOLLOWS, DISTURBANCE_REMOVED, PaperClaim, X_FOLLOWS, Y_FOLLOWS, Z_FOLLOWS};

/// Renders one flight, several lines with a newline at the end.
pub fn render(summary: &Summary) -> String {
    let mut text = heading(summary);
    text.push_str(&axes_table(summary));
    text.push_str(&bound(summary));
    text.push_str(&summary.recovery_s.as_ref().map(recovery).unwrap_or_default());
    text.push_str(&summary.sensed.as_ref().map(sensed).unwrap_or_default());
    text.push_str(&figures(summary));
    text
}

fn heading(summary: &Summary) -> String {
    let end = if summary.survived { "survived" } else { "DID NOT SURVIVE" };
    format!("{}, seed {}: {:.3} s flown, {end}\n\n", summary.scenario, summary.seed, summary.duration_s)
}

fn axes_table(summary: &Summary) -> String {
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
    let average = mean_settling(summary);
    let [blank_1, blank_2, blank_3, blank_4] = [const { String::new() }; 4];
    let claim = if claimed { seconds(Some(AVERAGE_FOLLOWS.time_s)) } else { String::new() };
    rows.push(["mean xyz".into(), seconds(average), blank_1, blank_2, blank_3, blank_4, claim]);
    aligned(&rows) + "yaw: within 0.05 rad and 0.002 rad; its errors are in mrad\n\n"
}

fn axis_row(name: &str, axis: &AxisFigures, claim: Option<PaperClaim>) -> [String; 7] {
    let unit = if name == "yaw" { "rad" } else { "m" };
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

/// Mean of the times at which x, y and z settle within 5 cm, s.
fn mean_settling(summary: &Summary) -> Option<f64> {
    let axes = &summary.axes;
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
        || "xyz never all within 5 cm".into(),
        |last| format!("all of xyz within 5 cm from {last:.3} s, {:.2} × the bound", last / bound),
    );
    format!("time-optimal bound  {bound:.2} s to join the reference exactly; {reached}\n")
}

fn recovery(recovery: &Recovery) -> String {
    let Recovery { x, y, z, yaw, roll, pitch } = *recovery;
    let axes = [("x", x), ("y", y), ("z", z), ("roll", roll), ("pitch", pitch), ("yaw", yaw)];
    let each: Vec<_> = axes.iter().map(|(name, time)| format!("{name} {}", seconds(*time))).collect();
    format!(
        "disturbance         from its onset to within 5 cm (2°) for good: {} (paper: under {} s)\n",
        each.join(", "),
        DISTURBANCE_REMOVED.time_s
    )
}

/// What a flight on sensors knew, and how it ended.
fn sensed(sensed: &Sensed) -> String {
    let degrees = |value: Option<f64>| value.map_or_else(undefined, |v| format!("{:.2}°", v.to_degrees()));
    let Knowledge { tilt_rms_rad, heading_rms_rad, position_rms_m, velocity_rms_m_s } = sensed.estimate;
    let known = format!(
        "knowledge           off by {} tilt, {} heading, {}, {}/s RMS while armed\n",
        degrees(tilt_rms_rad),
        degrees(heading_rms_rad),
        error(position_rms_m, "m"),
        error(velocity_rms_m_s, "m"),
    );
    let landed = |contact: Contact| format!("at {:.3} s with {:.2} m/s", contact.t_s, contact.descent_m_s);
    let touchdown = sensed.touchdown.map_or_else(|| "none".into(), landed);
    known + &format!("touchdown           {touchdown}; {}\n", disarmed(sensed.disarmed_s))
}

fn disarmed(time: Option<f64>) -> String {
    time.map_or_else(|| "not disarmed".into(), |t| format!("disarmed at {t:.3} s"))
}

fn figures(summary: &Summary) -> String {
    let effort = &summary.control_effort;
    let number = |value: Option<f64>, digits| value.map_or_else(undefined, |v| format!("{v:.digits$}"));
    let [thrust, roll, pitch, yaw] =
        [effort.thrust_rms_n, effort.roll_rms_n_m, effort.pitch_rms_n_m, effort.yaw_rms_n_m];
    let mut text = String::new();
    let mut line = |name: &str, value: &str| writeln!(text, "{name:<18}  {value}").expect("a string takes every byte");
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
    line("saturated", &format!("{:.2} % of the ticks", 100.0 * summary.saturated_fraction));
    line("real-time factor", &number(summary.real_time_factor, 0));
    line("truth SHA-256", &summary.truth_sha256);
    text
}

/// Pads every column to its widest cell: the first to the left, numbers to the right.
fn aligned<const N: usize>(rows: &[[String; N]]) -> String {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; N] = std::array::from_fn(width);
    let mut text = String::new();
    for row in rows {
        let mut line = format!("{:<1$}", row[0], widths[0]);
        for (cell, width) in row.iter().zip(widths).skip(1) {
            write!(line, "  {cell:>width$}").expect("a string takes every byte");
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

fn seconds(time: Option<f64>) -> String {
    time.map_or_else(|| "never".into(), |t| format!("{t:.3} s"))
}

/// An error in thousandths of its unit, or in the unit where that would be a long number.
fn error(value: Option<f64>, unit: &str) -> String {
    match value {
        None => undefined(),
        Some(v) if v >= 1e6 => format!("{v:.1e} {unit}"),
        Some(v) if v >= 1.0 => format!("{v:.2} {unit}"),
        Some(v) => format!("{:.3} m{unit}", 1e3 * v),
    }
}

fn undefined() -> String {
    "–".into()
}

#[cfg(test)]
mod tests {
    use super::super::summary::tests::{flight, metrics};
    use super::super::summary::{Flight, Summary};
    use super::*;
    use crate::report::metrics::Metrics;

    #[test]
    fn a_flight_reads_as_expected() {
        let flight = Flight { disturbance_onset_s: Some(0.9), ..flight(true) };
        let text = render(&Summary::new(flight, &metrics()));
        let expected = "\
helix, seed 7: 20.000 s flown, survived

axis      within 5 cm  within 2 mm         RMS     maximum  overshoot  the paper follows
                 from         from   after 4 s   after 4 s                          from
x             1.000 s      1.000 s    1.500 mm    1.500 mm      0.0 %            0.000 s
y             0.000 s      0.000 s    0.000 mm    0.000 mm          –            0.400 s
z             0.000 s      0.000 s    0.000 mm    0.000 mm          –            0.350 s
yaw           0.000 s      0.000 s  0.000 mrad  0.000 mrad          –
mean xyz      0.333 s                                                            0.500 s
yaw: within 0.05 rad and 0.002 rad; its errors are in mrad

time-optimal bound  1.31 s to join the reference exactly; all of xyz within 5 cm from 1.000 s, 0.76 × the bound
disturbance         from its onset to within 5 cm (2°) for good: x 0.100 s, y 0.000 s, z 0.000 s, roll 0.000 s, pitch 0.000 s, yaw 0.000 s (paper: under 0.2 s)
chattering          0 (rad/s)²/s, 0 after 4 s: total variation of ω²
control effort      U1 8.00 N, U2 0.0000 N m, U3 0.0000 N m, U4 0.0000 N m RMS
saturated           1.23 % of the ticks
real-time factor    3210
truth SHA-256       abababababababababababababababababababababababababababababababab
";
        assert_eq!(text, expected);
    }

    #[test]
    fn a_flight_without_figures_still_has_a_table() {
        let text = render(&Summary::new(flight(false), &Metrics::new()));
        assert!(text.contains("DID NOT SURVIVE") && text.contains("never") && !text.contains("NaN"), "{text}");
    }

    #[test]
    fn a_flight_on_sensors_tells_what_it_knew_and_how_it_ended() {
        let estimate = Knowledge {
            tilt_rms_rad: Some(0.005),
            heading_rms_rad: Some(0.02),
            position_rms_m: Some(1.25),
            velocity_rms_m_s: Some(0.05),
        };
        let touchdown = Some(Contact { t_s: 71.5, descent_m_s: 0.4, drift_m_s: 0.1 });
        let sensed = Sensed { estimate, touchdown, disarmed_s: Some(73.0) };
        let text = render(&Summary::new(flight(true), &metrics()).with_sensed(Some(sensed)));
        assert!(text.contains("off by 0.29° tilt, 1.15° heading, 1.25 m, 50.000 mm/s RMS while armed"), "{text}");
        assert!(text.contains("at 71.500 s with 0.40 m/s; disarmed at 73.000 s"), "{text}");
        let text = render(&Summary::new(flight(true), &metrics()).with_sensed(Some(Sensed::default())));
        assert!(text.contains("none; not disarmed"), "{text}");
    }

    #[test]
    fn errors_are_readable_at_any_size() {
        assert_eq!(error(Some(0.000_012), "m"), "0.012 mm");
        assert_eq!(error(Some(0.25), "rad"), "250.000 mrad");
        assert_eq!(error(Some(12.345), "m"), "12.35 m");
        assert_eq!(error(Some(1.0e12), "m"), "1.0e12 m");
    }
}
