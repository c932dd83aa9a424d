//! The flights of several seeds, a line each.

use super::numbers::{error, seconds, undefined};
use super::{aligned_to_width, last_settling, verdict};
use crate::report::metrics::{AxisFigures, Recovery, TiltFigures};
use crate::report::summary::{Row, Summary};

/// Renders the flights of several seeds, a line each.
pub fn seeds(rows: &[Row]) -> String {
    let of = |row: &Row| if let Row::Flown(summary) = row { Some(Shown::of(summary)) } else { None };
    let shown = rows.iter().filter_map(of).max().unwrap_or(Shown::Errors);
    let mut lines = shown.head();
    lines.extend(rows.iter().map(|row| match row {
        Row::Flown(summary) => seed(shown, summary),
        Row::Failed { seed, error } => {
            [seed.to_string(), undefined(), undefined(), undefined(), format!("ERROR: {error}")]
        }
    }));
    // The last column holds words, and is not to be pushed to the right.
    let numbers: Vec<_> = lines.iter().map(|[a, b, c, d, _]| [a, b, c, d].map(Clone::clone)).collect();
    let text = aligned_to_width(&numbers);
    let line = |numbers: &String, end: &str| format!("{numbers}  {end}").trim_end().to_owned() + "\n";
    text.iter().zip(&lines).map(|(numbers, [.., end])| line(numbers, end)).collect()
}

/// Which three numbers tell of the seeds' flights: of any one, the last that applies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Shown {
    /// How the reference was followed.
    Errors,
    /// When it was reached, and how far off it was: errors after 4 s would hide it.
    Reaching,
    /// Of an attitude case: how its angles were followed.
    Angles,
    /// Under a disturbance: the greatest errors, and when it was removed.
    Disturbed,
    /// Of a flight on sensors or with a pilot: its landing and its battery.
    Landing,
}

impl Shown {
    /// For a flight.
    fn of(summary: &Summary) -> Self {
        match summary {
            Summary { told: Some(_), .. } => Self::Landing,
            Summary { recovery_s: Some(_), .. } => Self::Disturbed,
            Summary { roll_and_pitch: Some(_), .. } => Self::Angles,
            Summary { settles: true, .. } => Self::Reaching,
            _ => Self::Errors,
        }
    }

    fn head(self) -> Vec<[String; 5]> {
        let after = ["", "after 4 s", "after 4 s", "after 4 s", ""];
        let lines = match self {
            Self::Landing => vec![["seed", "touchdown", "from start", "battery", "end"]],
            Self::Angles => vec![["seed", "roll RMS", "pitch RMS", "yaw RMS", "end"], after],
            Self::Disturbed => vec![
                ["seed", "greatest of x, y, z", "of roll, pitch, yaw", "all within 5 cm, 2°", "end"],
                ["", "after 4 s", "after 4 s", "from its onset", ""],
            ],
            Self::Reaching => vec![
                ["seed", "x, y, z within", "greatest", "greatest in the", "end"],
                ["", "5 cm from", "distance", "last second", ""],
            ],
            Self::Errors => vec![["seed", "x RMS", "y RMS", "z RMS", "end"], after],
        };
        lines.into_iter().map(|line| line.map(String::from)).collect()
    }

    fn numbers(self, summary: &Summary) -> [String; 3] {
        let axes = &summary.axes;
        match self {
            Self::Landing => landing(summary),
            Self::Angles => {
                let [roll, pitch] = summary.roll_and_pitch.map_or([None; 2], |tilt| tilt.map(|axis| axis.rms_m));
                [roll, pitch, axes.yaw.rms_m].map(|rms| error(rms, "rad"))
            }
            Self::Disturbed => {
                let greatest =
                    |errors: [Option<f64>; 3]| errors.into_iter().try_fold(0.0, |most, e| Some(e?.max(most)));
                let AxisFigures { max_m: yaw, .. } = axes.yaw;
                let TiltFigures { roll_max_rad: roll, pitch_max_rad: pitch, .. } = summary.attitude_error;
                let slowest = summary.recovery_s.as_ref().and_then(Recovery::slowest);
                [
                    error(greatest([axes.x.max_m, axes.y.max_m, axes.z.max_m]), "m"),
                    error(greatest([roll, pitch, yaw]), "rad"),
                    seconds(slowest),
                ]
            }
            Self::Reaching => {
                [seconds(last_settling(summary)), error(summary.distance_max_m, "m"), error(summary.end_error_m, "m")]
            }
            Self::Errors => [&axes.x, &axes.y, &axes.z].map(|axis| error(axis.rms_m, "m")),
        }
    }
}

/// How it landed, and what was left in its battery.
fn landing(summary: &Summary) -> [String; 3] {
    let contact = summary.sensed.as_ref().and_then(|sensed| sensed.touchdown);
    let battery = summary.told.as_ref().and_then(|told| told.battery);
    [
        contact.map_or_else(undefined, |contact| format!("{:.2} m/s", contact.descent_m_s)),
        contact.map_or_else(undefined, |contact| format!("{:.2} m", contact.from_start_m)),
        battery.map_or_else(undefined, |[_, left]| format!("{:.0} %", 100.0 * left)),
    ]
}

/// A flight in a line: seed, three numbers, end.
fn seed(shown: Shown, summary: &Summary) -> [String; 5] {
    let mission = summary.told.as_ref().and_then(|told| told.mission.as_ref()?.reason.clone());
    let end = mission.unwrap_or_else(|| verdict(summary).0);
    let [a, b, c] = shown.numbers(summary);
    [summary.seed.to_string(), a, b, c, end]
}
