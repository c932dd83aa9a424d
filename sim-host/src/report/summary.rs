//! A flight in one object: what `--json` prints and `summary.json` keeps. The keys are an interface that people
//! script against; [`Summary`]'s fields are those keys, in order.

use std::path::{Path, PathBuf};

use anyhow::Result;
use serde::Serialize;

use super::measures::finite;
use super::metrics::{Axes, AxisFigures, ControlEffort, EndErrors, Metrics, Recovery, TiltFigures, WIDE_BAND};
use super::mission::Mission;
use super::out::write_file;
use super::sensed::Sensed;
use super::timeline::{Course, Leg, Timeline, order_text};
use crate::outcome::Crash;
use crate::pilot::Order;
use crate::sil::End;

/// What the loop knows about a flight and its rows do not tell.
#[derive(Clone, Debug, PartialEq)]
pub struct Flight {
    /// Name of the scenario.
    pub scenario: String,
    /// Seed of its random numbers.
    pub seed: u64,
    /// Simulated time flown, s.
    pub duration_s: f64,
    /// SHA-256 of truth.csv's bytes, hexadecimal.
    pub truth_sha256: String,
    /// Simulated seconds a second of wall time.
    pub real_time_factor: f64,
    /// Fraction of the ticks in which the mixer met a limit.
    pub saturated_fraction: f64,
    /// The time-optimal bound for joining the reference, where known, s.
    pub time_optimal_s: Option<f64>,
    /// Whether the reference is the paper's helix, of which it makes its claims.
    pub papers_helix: bool,
    /// False on the paper's decoupled equations, whose force and torques are direct inputs.
    pub has_rotors: bool,
    /// Whether the flight is one of reaching a reference: when each axis settled is then shown.
    pub settles: bool,
    /// What it is to follow, and how closely at its end.
    pub aim: Aim,
    /// When the path that it follows ends, if the flight was to end before, s.
    pub path_ends_s: Option<f64>,
    /// When a disturbance set in, where one did, s.
    pub disturbance_onset_s: Option<f64>,
    /// What was asked of it that it cannot do: to lift what its rotors cannot, or to follow what nothing can.
    pub beyond_reach: Option<String>,
    /// Why it ended.
    pub end: End,
}

/// What a flight is to follow, and how closely it has to at its end to have reached it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aim {
    /// A position within so many m, and the heading within so many rad.
    Position {
        /// m.
        within_m: f64,
        /// rad.
        within_rad: f64,
    },
    /// Stated roll, pitch and yaw, while the position is held by inputs of its own.
    Attitude,
}

impl Aim {
    /// On ideal state: the bands in which an axis counts as settled.
    pub const IDEAL: Self = Self::Position { within_m: WIDE_BAND, within_rad: WIDE_BAND };

    /// How far off it was in its last second, in words; `None` if it was where it should have been.
    pub fn missed(&self, end: &EndErrors) -> Option<String> {
        let EndErrors { distance_m, tilt_rad, yaw_rad } = *end;
        let degrees = |angle: f64| format!("{:.1}°", angle.to_degrees());
        let (position, heading) = match *self {
            Self::Position { within_m, within_rad } => (distance_m >= within_m, yaw_rad >= within_rad),
            Self::Attitude => {
                let off = tilt_rad.max(yaw_rad);
                if off >= WIDE_BAND {
                    return Some(format!("up to {} off its reference", degrees(off)));
                }
                (distance_m >= WIDE_BAND, false)
            }
        };
        match (position, heading) {
            (true, _) => Some(format!("up to {} off its reference", metres(distance_m))),
            (false, true) => Some(format!("heading up to {} off", degrees(yaw_rad))),
            (false, false) => None,
        }
    }
}

fn metres(distance: f64) -> String {
    if distance < 1.0 { format!("{distance:.2} m") } else { format!("{distance:.1} m") }
}

/// What a flight on sensors or with a pilot did.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Told {
    /// Whether it did what its pilot asked for; null without a pilot.
    pub mission: Option<Mission>,
    /// Where the pilot sent it, and how far off it was when the next command came.
    pub places: Vec<Place>,
    /// Charge of the battery at the start and at the end, 0 to 1; null without one.
    pub battery: Option<[f64; 2]>,
    /// Its phases and events.
    #[serde(flatten)]
    pub timeline: Timeline,
}

/// A place that the pilot sent the vehicle to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Place {
    /// The command.
    pub order: String,
    /// True distance from it when the next command was given, or at the end, m.
    pub off_m: f64,
}

impl Told {
    /// Of a course, with the verdict on its mission.
    pub fn new(course: Course, mission: Option<Mission>) -> Self {
        let sent = |leg: &Leg| matches!(leg.order, Order::TakeOff { .. } | Order::GoTo { .. });
        let place = |leg: &Leg| Some(Place { order: order_text(&leg.order), off_m: leg.off_m? });
        let places = course.legs.iter().filter(|leg| sent(leg)).filter_map(place).collect();
        Self { mission, places, battery: course.battery, timeline: course.timeline }
    }
}

/// The summary of one flight. SI units; what is not defined or not finite is null.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Name of the scenario.
    pub scenario: String,
    /// Seed of its random numbers.
    pub seed: u64,
    /// Simulated time flown, s.
    pub duration_s: f64,
    /// SHA-256 of truth.csv's bytes, hexadecimal.
    pub truth_sha256: String,
    /// Simulated seconds a second of wall time: the only key that differs between two runs of the same flight, and
    /// therefore left out (`None`) of summary.json.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub real_time_factor: Option<f64>,
    /// True if it flew, to its end and unharmed. Otherwise the figures are those of what was flown, and nothing counts
    /// as settled.
    pub survived: bool,
    /// Why it ended: `duration-reached`, `never-flew`, `crashed`, `left-reference`, `not-finite`, `interrupted`.
    pub end: &'static str,
    /// The contact with the ground that damaged it; null without one.
    pub crash: Option<Crash>,
    /// Greatest distance from the reference in the last second, m.
    pub end_error_m: Option<f64>,
    /// How each axis followed the paper's reference.
    pub axes: Axes<AxisFigures>,
    /// The time-optimal bound for joining the reference, where known, s.
    pub time_optimal_s: Option<f64>,
    /// Total variation of the commanded ω² over all rotors, a second: (rad/s)²/s.
    pub chattering: Option<f64>,
    /// The same after 4 s.
    pub chattering_after_4s: Option<f64>,
    /// Fraction of the ticks in which the mixer met a limit.
    pub saturated_fraction: f64,
    /// Root mean squares of U1..U4.
    pub control_effort: ControlEffort,
    /// How roll and pitch followed the desired attitude.
    pub attitude_error: TiltFigures,
    /// Recovery from the disturbance; null without one.
    pub recovery_s: Option<Recovery>,
    /// Of a flight on sensors, its keys stand among the others; of one on ideal state there are none.
    #[serde(flatten)]
    pub sensed: Option<Sensed>,
    /// Of a flight on sensors or with a pilot, its keys stand among the others.
    #[serde(flatten)]
    pub told: Option<Told>,
    /// Greatest distance from the reference over the whole flight, m.
    #[serde(skip)]
    pub distance_max_m: Option<f64>,
    /// Where it should have been in its last second and was not, in words.
    #[serde(skip)]
    pub missed: Option<String>,
    /// What was asked of it that it cannot do.
    #[serde(skip)]
    pub beyond_reach: Option<String>,
    /// How roll and pitch followed, where they are what is followed.
    #[serde(skip)]
    pub roll_and_pitch: Option<[AxisFigures; 2]>,
    /// When the path that it follows ends, if the flight was to end before, s.
    #[serde(skip)]
    pub path_ends_s: Option<f64>,
    /// When its reference last jumped, s.
    #[serde(skip)]
    pub reference_jump_s: Option<f64>,
    /// Why it ended, with the details.
    #[serde(skip)]
    pub ended: End,
    /// Whether it is of interest when each axis settled.
    #[serde(skip)]
    pub settles: bool,
    /// Whether the paper's claims belong beside these figures.
    #[serde(skip)]
    pub papers_helix: bool,
}

impl Summary {
    /// Puts together what the loop and the rows tell.
    pub fn new(flight: Flight, metrics: &Metrics) -> Self {
        let survived = flight.end.survived();
        let crash = if let End::Crashed(crash) = flight.end { Some(crash) } else { None };
        let end = metrics.at_the_end();
        let tilt = (flight.aim == Aim::Attitude).then(|| metrics.roll_and_pitch());
        let recovery = flight.disturbance_onset_s.map(|onset| metrics.recovery(onset));
        Self {
            scenario: flight.scenario,
            seed: flight.seed,
            duration_s: flight.duration_s,
            truth_sha256: flight.truth_sha256,
            real_time_factor: Some(flight.real_time_factor),
            survived,
            end: flight.end.name(),
            crash,
            end_error_m: finite(end.distance_m),
            distance_max_m: metrics.distance_max_m(),
            beyond_reach: flight.beyond_reach,
            path_ends_s: flight.path_ends_s,
            missed: flight.aim.missed(&end),
            roll_and_pitch: tilt.map(|tilt| if survived { tilt } else { tilt.map(|axis| cleared(&axis)) }),
            ended: flight.end,
            settles: flight.settles,
            axes: if survived { metrics.axes() } else { unsettled(&metrics.axes()) },
            time_optimal_s: flight.time_optimal_s,
            chattering: metrics.chattering().filter(|_| flight.has_rotors),
            chattering_after_4s: metrics.chattering_after_4s().filter(|_| flight.has_rotors),
            saturated_fraction: flight.saturated_fraction,
            control_effort: metrics.control_effort(),
            attitude_error: metrics.tilt(),
            papers_helix: flight.papers_helix,
            reference_jump_s: metrics.jumped_s().filter(|_| survived),
            sensed: None,
            told: None,
            recovery_s: recovery.map(|r| if survived { r } else { Recovery::default() }),
        }
    }

    /// With what a flight on sensors tells besides.
    #[must_use]
    pub fn with_sensed(self, sensed: Option<Sensed>) -> Self {
        Self { sensed, ..self }
    }

    /// With the course of a flight on sensors or with a pilot.
    #[must_use]
    pub fn with_course(self, told: Option<Told>) -> Self {
        Self { told, ..self }
    }

    /// The object on one line, as `--json` prints it.
    pub fn to_json(&self) -> String {
        one_line(self)
    }

    /// The text of summary.json: the same object over several lines, without `real_time_factor`, so that the same
    /// flight leaves the same bytes.
    pub fn to_file_text(&self) -> String {
        let same_each_time = Self { real_time_factor: None, ..self.clone() };
        several_lines(&same_each_time) + "\n"
    }

    /// Writes summary.json into `folder`.
    ///
    /// # Errors
    /// When the file cannot be written; the message names it.
    pub fn write(&self, folder: &Path) -> Result<PathBuf> {
        let path = folder.join("summary.json");
        write_file(&path, self.to_file_text())?;
        Ok(path)
    }
}

/// One of several flights: its summary, or why there is none.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Row {
    /// A flight.
    Flown(Box<Summary>),
    /// A seed that could not be flown.
    Failed {
        /// Which.
        seed: u64,
        /// Why.
        error: String,
    },
}

/// Several flights as one JSON array, as `--json` prints them for `--seeds`.
pub fn to_json_array(rows: &[Row]) -> String {
    one_line(rows)
}

/// The same for the summary.json of their folder: over several lines, without `real_time_factor`.
pub fn to_file_array(rows: &[Row]) -> String {
    let same_each_time = |row: &Row| match row {
        Row::Flown(summary) => Row::Flown(Box::new(Summary { real_time_factor: None, ..Summary::clone(summary) })),
        Row::Failed { seed, error } => Row::Failed { seed: *seed, error: error.clone() },
    };
    several_lines(&rows.iter().map(same_each_time).collect::<Vec<_>>()) + "\n"
}

/// Why serialising cannot fail.
const PLAIN: &str = "only numbers and strings under string keys; a number that is not finite becomes null";

fn one_line<T: Serialize + ?Sized>(value: &T) -> String {
    serde_json::to_string(value).expect(PLAIN)
}

fn several_lines<T: Serialize>(value: &T) -> String {
    serde_json::to_string_pretty(value).expect(PLAIN)
}

/// A flight that ended early has not stayed anywhere until the end.
fn unsettled(axes: &Axes<AxisFigures>) -> Axes<AxisFigures> {
    Axes { x: cleared(&axes.x), y: cleared(&axes.y), z: cleared(&axes.z), yaw: cleared(&axes.yaw) }
}

fn cleared(axis: &AxisFigures) -> AxisFigures {
    AxisFigures { settle_5cm_s: None, settle_2mm_s: None, ..*axis }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::record::{self, Recorder as _};
    use serde_json::Value;
    use std::collections::BTreeSet;

    pub(in crate::report) fn flight(survived: bool) -> Flight {
        Flight {
            scenario: "helix".into(),
            seed: 7,
            duration_s: 20.0,
            truth_sha256: "ab".repeat(32),
            real_time_factor: 3210.0,
            saturated_fraction: 0.0123,
            time_optimal_s: Some(1.31),
            papers_helix: true,
            has_rotors: true,
            settles: true,
            aim: Aim::IDEAL,
            disturbance_onset_s: None,
            beyond_reach: None,
            path_ends_s: None,
            end: if survived { End::DurationReached } else { End::LeftReference },
        }
    }

    /// Five seconds that settle at 1 s in x and were on the reference before in all else.
    pub(in crate::report) fn metrics() -> Metrics {
        let mut metrics = Metrics::new();
        for k in 0..5000 {
            metrics.record(&row(f64::from(k) / 1000.0));
        }
        metrics
    }

    fn row(t: f64) -> record::Row {
        record::Row {
            t,
            position: [if t < 1.0 { -4.0 } else { -0.0015 }, 0.0, 0.0],
            attitude: [1.0, 0.0, 0.0, 0.0],
            omega: [26.0; 4],
            omega_command: [26.0; 4],
            u: [8.0, 0.0, 0.0, 0.0],
            ..record::Row::default()
        }
    }

    fn keys(value: &Value) -> BTreeSet<&str> {
        value.as_object().expect("an object").keys().map(String::as_str).collect()
    }

    fn parse(text: &str) -> Value {
        serde_json::from_str(text).expect("valid JSON")
    }

    #[test]
    fn json_has_exactly_the_documented_keys() {
        let json = parse(&Summary::new(flight(true), &metrics()).to_json());
        let documented = [
            ["scenario", "seed", "duration_s", "truth_sha256", "real_time_factor"].as_slice(),
            &["end_error_m", "axes", "chattering", "saturated_fraction", "time_optimal_s", "survived", "end", "crash"],
            &["chattering_after_4s", "control_effort", "attitude_error", "recovery_s"],
        ];
        assert_eq!(keys(&json), documented.concat().into_iter().collect());
        assert_eq!(keys(&json["axes"]), BTreeSet::from(["x", "y", "z", "yaw"]));
        let figures = BTreeSet::from(["settle_5cm_s", "settle_2mm_s", "rms_m", "max_m", "overshoot"]);
        assert!(["x", "y", "z", "yaw"].iter().all(|axis| keys(&json["axes"][axis]) == figures));
        let effort = BTreeSet::from(["thrust_rms_n", "roll_rms_n_m", "pitch_rms_n_m", "yaw_rms_n_m"]);
        assert_eq!(keys(&json["control_effort"]), effort);
    }

    #[test]
    fn a_flight_that_ends_off_its_reference_says_how_far() {
        let end = |distance_m, yaw_rad| EndErrors { distance_m, tilt_rad: 0.3, yaw_rad };
        let missed = |aim: Aim, end| aim.missed(&end);
        assert_eq!(missed(Aim::IDEAL, end(0.049, 0.049)), None);
        assert_eq!(missed(Aim::IDEAL, end(0.05, 0.0)).as_deref(), Some("up to 0.05 m off its reference"));
        assert_eq!(missed(Aim::IDEAL, end(13.19, 0.2)).as_deref(), Some("up to 13.2 m off its reference"));
        assert_eq!(missed(Aim::IDEAL, end(0.0, 0.1)).as_deref(), Some("heading up to 5.7° off"));
        assert_eq!(missed(Aim::Attitude, end(9.0, 0.0)).as_deref(), Some("up to 17.2° off its reference"));
    }

    #[test]
    fn a_flight_on_sensors_has_three_keys_more() {
        let ideal = Summary::new(flight(true), &metrics());
        let sensed = Summary { sensed: Some(Sensed::default()), ..ideal.clone() };
        let (ideal, sensed) = (parse(&ideal.to_json()), parse(&sensed.to_json()));
        let more: BTreeSet<_> = keys(&sensed).difference(&keys(&ideal)).copied().collect();
        assert_eq!(more, BTreeSet::from(["estimate", "touchdown", "disarmed_s"]));
        let known = BTreeSet::from(["tilt_rms_rad", "heading_rms_rad", "position_rms_m", "velocity_rms_m_s"]);
        assert_eq!(keys(&sensed["estimate"]), known);
        assert_eq!(sensed["touchdown"], Value::Null);
    }

    #[test]
    fn json_holds_the_figures() {
        let json = parse(&Summary::new(flight(true), &metrics()).to_json());
        assert_eq!(json["axes"]["x"]["settle_5cm_s"], 1.0);
        assert_eq!(json["axes"]["y"]["settle_5cm_s"], 0.0);
        assert_eq!(json["axes"]["y"]["overshoot"], Value::Null);
        assert_eq!(json["time_optimal_s"], 1.31);
        assert_eq!(json["recovery_s"], Value::Null);
    }

    #[test]
    fn the_file_differs_only_in_real_time_factor() {
        let summary = Summary::new(flight(true), &metrics());
        let mut json = parse(&summary.to_json());
        json.as_object_mut().expect("an object").remove("real_time_factor");
        assert_eq!(parse(&summary.to_file_text()), json);
        let slower = Summary { real_time_factor: Some(1.0), ..summary.clone() };
        assert_eq!(slower.to_file_text(), summary.to_file_text());
    }

    #[test]
    fn numbers_that_are_not_finite_become_null() {
        let (real_time_factor, saturated_fraction) = (f64::INFINITY, f64::NAN);
        let flight = Flight { real_time_factor, saturated_fraction, duration_s: f64::NAN, ..flight(true) };
        let json = parse(&Summary::new(flight, &Metrics::new()).to_json());
        for key in ["real_time_factor", "saturated_fraction", "duration_s", "chattering"] {
            assert_eq!(json[key], Value::Null, "{key}");
        }
    }

    #[test]
    fn a_flight_that_ended_early_settled_nowhere() {
        let flight = Flight { disturbance_onset_s: Some(2.0), ..flight(false) };
        let summary = Summary::new(flight, &metrics());
        assert!(summary.axes.named().iter().all(|(_, axis)| axis.settle_5cm_s.is_none()));
        assert!(summary.axes.named().iter().all(|(_, axis)| axis.rms_m.is_some()));
        assert_eq!(summary.recovery_s, Some(Recovery::default()));
    }

    #[test]
    fn several_flights_are_one_array() {
        let summary = Summary::new(flight(true), &metrics());
        let failed = Row::Failed { seed: 8, error: "no room".into() };
        let rows = [Row::Flown(Box::new(summary)), failed];
        let (json, file) = (parse(&to_json_array(&rows)), parse(&to_file_array(&rows)));
        assert_eq!(json.as_array().map(Vec::len), Some(2));
        assert_eq!((&json[0]["seed"], &json[1]["error"]), (&7.into(), &"no room".into()));
        assert!(file[0].get("real_time_factor").is_none() && file[0]["truth_sha256"] == json[0]["truth_sha256"]);
    }

    #[test]
    fn a_missing_folder_is_named() {
        let error = Summary::new(flight(true), &metrics()).write(Path::new("no/such/folder")).expect_err("no folder");
        assert!(format!("{error:#}").contains("no/such/folder"));
    }
}
