//! One flight with its report: what is flown, recorded, judged, and written into a folder. For `run`, the tour without a
//! command, and `pil`.

use std::io::Write;
use std::path::Path;
use std::time::Instant;

use anyhow::Result;
use firmware::airframe::ROTORS;
use firmware::commander;
use firmware::guidance::Trajectory;
use serde::Serialize;
use toml::{Table, Value};

use crate::failures::Equipment;
use crate::files::{LARGEST, read_regular};
use crate::flight;
use crate::record::Row;
use crate::recording::arguments;
use crate::report::estimate::Belief;
use crate::report::mission::{self, REACHED_BY_GNSS_M, REACHED_M};
use crate::report::summary::{Aim, Told};
use crate::report::timeline::{Course, Event, EventKind};
use crate::report::{
    Figures, Flight, Metrics, OutFolder, Progress, SensedRecorder, Summary, Timeline, TimelineRecorder, TruthWriter,
};
use crate::scenario::{Group, PlantKind, Scenario};
use crate::sensors::Fault;
use crate::sil::{End, Outcome};

/// Figures are drawn of flights up to this long, s: beyond it, rows are not kept in memory.
pub(super) const FIGURES_UP_TO_S: f64 = 600.0;

/// By which a provenance.toml is known to be ours.
pub(super) const PROGRAM: &str = "sim-host";

/// What came of a flight, and how long it took, s.
pub(super) struct Flown {
    pub(super) outcome: Outcome,
    pub(super) wall_s: f64,
}

/// A flight's summary with what its figures are drawn of.
struct Taken {
    summary: Summary,
    course: Course,
    rows: Vec<Row>,
    beliefs: Vec<Belief>,
}

/// Flies one seed, and writes nothing.
pub(super) fn fly(scenario: &Scenario, seed: u64, visible: bool) -> Result<Summary> {
    let sensed = scenario.file.sensors.as_ref().map(|_| SensedRecorder::new());
    Ok(take(scenario, seed, visible, TruthWriter::hash_only(), None, sensed)?.summary)
}

/// Flies one seed of a scenario as loaded with `settings`, and leaves truth.csv, summary.json, the figures, and what it
/// takes to fly it again in a folder.
pub(super) fn fly_into(
    folder: &OutFolder,
    scenario: &Scenario,
    settings: &[String],
    seed: u64,
    visible: bool,
) -> Result<Summary> {
    provenance(folder, scenario, settings, seed)?;
    let is_drawn = scenario.file.duration_s <= FIGURES_UP_TO_S;
    let sensed = match &scenario.file.sensors {
        Some(_) => Some(SensedRecorder::new().writing(folder.estimate()?, is_drawn)),
        None => None,
    };
    let taken = take(scenario, seed, visible, folder.truth()?, is_drawn.then(Vec::new), sensed)?;
    folder.summary(&taken.summary)?;
    draw(scenario, settings, seed, folder, &taken)?;
    Ok(taken.summary)
}

fn take<W: Write>(
    scenario: &Scenario,
    seed: u64,
    visible: bool,
    truth: TruthWriter<W>,
    rows: Option<Vec<Row>>,
    sensed: Option<SensedRecorder>,
) -> Result<Taken> {
    let bar = Progress::new(scenario.file.duration_s, visible);
    let course = TimelineRecorder::new(&scenario.file.command, scenario.joined_s());
    let mut recorder = (((Metrics::new().over(flight::ground(scenario)), truth), (bar, rows)), (sensed, course));
    let start = Instant::now();
    let outcome = flight::fly(scenario, seed, &mut recorder)?;
    let flown = Flown { outcome, wall_s: start.elapsed().as_secs_f64() };
    let (((metrics, truth), (bar, rows)), (sensed, course)) = recorder;
    bar.finish();
    let sensed = sensed.map(|sensed| sensed.finish(outcome.touchdown)).transpose()?;
    let (sensed, beliefs) = sensed.map_or_else(Default::default, |(sensed, beliefs)| (Some(sensed), beliefs));
    let mut course = course.finish(&scenario.file.fault, &scenario.file.push);
    add_contacts(&mut course.timeline, &outcome);
    let drawn = course.clone();
    let summary = summarise(scenario, seed, &flown, truth.finish()?, &metrics)
        .with_sensed(sensed)
        .with_course(told(scenario, course, &outcome));
    Ok(Taken { summary, course: drawn, rows: rows.unwrap_or_default(), beliefs })
}

/// Adds what the plant and the ground did to each other.
fn add_contacts(timeline: &mut Timeline, outcome: &Outcome) {
    let first_s = outcome.touchdown.map(|contact| contact.t_s);
    let again = outcome.landing.filter(|landing| Some(landing.t_s) != first_s);
    for contact in outcome.touchdown.into_iter().chain(again) {
        let (down, away) = (contact.descent_m_s, contact.from_start_m);
        let text = format!("touchdown with {down:.2} m/s, {away:.1} m from the start");
        timeline.add(Event { t_s: contact.t_s, kind: EventKind::Touchdown, text });
    }
    if let End::Crashed(crash) = outcome.end {
        timeline.add(Event { t_s: crash.t_s, kind: EventKind::Crash, text: "crash".into() });
    }
}

/// The course of a flight on sensors or with a pilot; of others there is nothing to tell.
fn told(scenario: &Scenario, mut course: Course, outcome: &Outcome) -> Option<Told> {
    let commands = scenario.file.command.len();
    if outcome.end == End::Interrupted {
        course.cut_off(radius_m(scenario));
    }
    if commands == 0 && scenario.file.sensors.is_none() {
        return None;
    }
    let mission = (commands > 0).then(|| mission::judge(&course, outcome, &scenario.file.command, radius_m(scenario)));
    let cause = || cannot_lift(scenario, outcome).or_else(|| no_rotor_failed(scenario, &course));
    let mission = mission.map(|mission| mission.because(cause()));
    Some(Told::new(course, mission))
}

/// Why a vehicle never flew, if its rotors cannot lift it, or not hold it level.
fn cannot_lift(scenario: &Scenario, outcome: &Outcome) -> Option<String> {
    let [thrust_n, weight_n] = scenario.thrust_and_weight_n();
    let ratio = thrust_n / weight_n;
    if outcome.end != End::NeverFlew {
        return None;
    }
    if ratio < 1.0 {
        let text = format!("its rotors give at most {thrust_n:.1} N and it weighs {weight_n:.1} N");
        return Some(format!("{text}: thrust-to-weight {ratio:.2}"));
    }
    // Squared speeds that carry the weight without turning it.
    let squares = scenario.constants().geometry.try_inverse()?.column(0) * weight_n;
    let most = scenario.airframe.omega_max().powi(2);
    let rotor = squares.iter().position(|square| !(0.0..=most).contains(square))?;
    Some(format!("its rotors cannot hold it level: rotor {} (index {rotor}) cannot give its share", rotor + 1))
}

/// What the vehicle took for a failed rotor, if none has failed.
fn no_rotor_failed(scenario: &Scenario, course: &Course) -> Option<String> {
    let (at_s, text) = course.response?;
    let rotor = (0..ROTORS).find(|rotor| commander::Event::RotorFailed { rotor: *rotor as u8 }.text() == text)?;
    let is_one = |fault: &Fault| Equipment::Rotors(Some(rotor)).has(fault) && fault.from_s <= at_s;
    let has_failed = scenario.file.fault.iter().any(is_one) || scenario.file.truth.rotor_effectiveness[rotor] != 1.0;
    (!has_failed).then(|| mission::no_rotor_failed(rotor))
}

/// What was asked of a flight that it cannot do, if it did not do what was asked.
fn beyond_reach(scenario: &Scenario, outcome: &Outcome) -> Option<String> {
    match outcome.end {
        End::NeverFlew => cannot_lift(scenario, outcome),
        End::Interrupted => None,
        _ => scenario.beyond_reach(),
    }
}

/// How near a place counts as reached, m.
fn radius_m(scenario: &Scenario) -> f64 {
    let by_gnss = scenario.file.sensors.as_ref().is_some_and(|suite| suite.gnss.is_some());
    if by_gnss { REACHED_BY_GNSS_M } else { REACHED_M }
}

/// What a flight is to follow. On sensors a place counts as reached as it does for a pilot, and the heading, which is as
/// good as its estimate, is not judged.
fn aim(scenario: &Scenario) -> Aim {
    match &scenario.file {
        file if file.attitude.is_some() => Aim::Attitude,
        file if file.sensors.is_some() => Aim::Position { within_m: radius_m(scenario), within_rad: f64::INFINITY },
        _ => Aim::IDEAL,
    }
}

pub(super) fn summarise(
    scenario: &Scenario,
    seed: u64,
    flown: &Flown,
    truth_sha256: String,
    metrics: &Metrics,
) -> Summary {
    let outcome = flown.outcome;
    let duration_s = f64::from(outcome.ticks) / 1e3;
    let flight = Flight {
        scenario: scenario.name.clone(),
        seed,
        duration_s,
        truth_sha256,
        real_time_factor: duration_s / flown.wall_s,
        saturated_fraction: f64::from(outcome.saturated_ticks) / f64::from(outcome.ticks.max(1)),
        has_rotors: scenario.file.plant != PlantKind::PaperDecoupled,
        papers_helix: scenario.file.trajectory == Trajectory::PAPER_HELIX,
        settles: settles(scenario, metrics),
        time_optimal_s: scenario.file.time_optimal_s,
        aim: aim(scenario),
        path_ends_s: path_ends_s(scenario),
        disturbance_onset_s: scenario.file.disturbance.map(|d| d.from_s),
        beyond_reach: beyond_reach(scenario, &outcome),
        end: outcome.end,
    };
    Summary::new(flight, metrics)
}

/// When the path of a scenario ends, if its flight ends before, s.
fn path_ends_s(scenario: &Scenario) -> Option<f64> {
    let Trajectory::Spline(path) = &scenario.file.trajectory else { return None };
    let ends_s = f64::from(path.begin_ms + path.duration_ms) * 1e-3;
    (!path.repeat && ends_s > scenario.file.duration_s).then_some(ends_s)
}

/// Whether it is of interest when each axis settled: in the paper's cases, and where the flight began away from its
/// reference or the reference jumped. Corners of an eight or of a path through points are a question of errors.
fn settles(scenario: &Scenario, metrics: &Metrics) -> bool {
    let file = &scenario.file;
    let was_away = metrics.axes().named().iter().any(|(_, axis)| axis.settle_5cm_s != Some(0.0));
    let repeats = matches!(file.trajectory, Trajectory::FigureEight { .. } | Trajectory::Spline(_));
    file.group() == Group::Paper || metrics.began_away() || (was_away && !repeats)
}

/// What a folder holds besides the flight: by which program, from what, and how to fly it again.
#[derive(Serialize)]
struct Provenance<'a> {
    program: &'a str,
    version: &'a str,
    scenario: &'a str,
    set: &'a [String],
    seed: u64,
    again: String,
    /// Of a flight whose files were flown again: its own.
    from: Option<Table>,
}

pub(super) fn provenance(folder: &OutFolder, scenario: &Scenario, settings: &[String], seed: u64) -> Result<()> {
    let provenance = Provenance {
        program: PROGRAM,
        version: env!("CARGO_PKG_VERSION"),
        scenario: &scenario.name,
        set: settings,
        seed,
        again: again(scenario, settings, seed),
        from: provenance_beside(&scenario.name),
    };
    folder.text("provenance.toml", &toml::to_string(&provenance)?)?;
    scenario.files()?.iter().try_for_each(|(name, text)| folder.text(name, text))
}

/// How to fly it again: by the scenario in its folder; with a recording, by what that was recorded of.
fn again(scenario: &Scenario, settings: &[String], seed: u64) -> String {
    if scenario.replay.is_none() {
        return format!("sim-host run scenario.toml --seed {seed}");
    }
    format!("sim-host run {}{} --seed {seed} --replay RECORDING", scenario.name, arguments(settings))
}

/// The seed of the flight that has left a scenario.toml, if one has.
pub(super) fn seed_beside(scenario: &str) -> Option<u64> {
    provenance_beside(scenario)?.get("seed")?.as_integer()?.try_into().ok()
}

/// The provenance of the flight that has left a scenario.toml, if one has: it stands in the provenance.toml beside it.
fn provenance_beside(scenario: &str) -> Option<Table> {
    let path = Path::new(scenario);
    let text = read_regular(&path.with_file_name("provenance.toml"), LARGEST).ok()?;
    let flown: Table = text.parse().ok()?;
    let is_ours = flown.get("program").and_then(Value::as_str) == Some(PROGRAM);
    (path.file_name()? == "scenario.toml" && is_ours).then_some(flown)
}

fn draw(scenario: &Scenario, settings: &[String], seed: u64, folder: &OutFolder, taken: &Taken) -> Result<()> {
    let Taken { rows, beliefs, course, .. } = taken;
    if !rows.is_empty() {
        folder.figures(&Figures::new(scenario, seed, rows, beliefs, course).with_settings(settings))?;
    }
    Ok(())
}
