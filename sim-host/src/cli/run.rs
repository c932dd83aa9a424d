//! `run`: flies a scenario, for one seed or many, and reports.

use std::path::Path;
use std::time::Instant;

use anyhow::{Context, Result, ensure};
use firmware::guidance::Trajectory;
use rayon::iter::{IntoParallelIterator as _, ParallelIterator as _};

use super::RunArgs;
use crate::flight;
use crate::record::{Recorder, Row};
use crate::report::estimate::Belief;
use crate::report::{Figures, Flight, Metrics, OutFolder, Progress, Summary, TruthWriter};
use crate::report::{Sensed, SensedRecorder, TimelineRecorder, progress, summary, table};
use crate::scenario::Scenario;
use crate::sil::Outcome;

/// Figures are drawn of flights up to this long, s: beyond it, rows are not kept in memory.
const FIGURES_UP_TO_S: f64 = 600.0;

pub(super) fn run(args: &RunArgs) -> Result<()> {
    ensure!(args.jobs != Some(0), "--jobs must be at least 1");
    let scenario = args.which.load()?;
    let Some(seeds) = args.seeds else {
        let summary = fly(&scenario, args.seed, args.out.as_deref(), !args.json)?;
        return super::say(&if args.json { summary.to_json() } else { table::render(&summary) });
    };
    let count = seeds.count() as usize;
    let threads = args.jobs.map_or(0, |jobs| jobs.min(count).min(super::MOST_THREADS));
    let bar = progress::of_flights(seeds.count(), !args.json);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .context("cannot start the threads that --jobs asks for")?;
    let summaries: Vec<Summary> = pool.install(|| {
        let fly_one = |seed: u64| {
            let folder = args.out.as_ref().map(|out| out.join(format!("seed-{seed}")));
            let summary = fly(&scenario, seed, folder.as_deref(), false);
            bar.inc(1);
            summary
        };
        (seeds.first..=seeds.last).into_par_iter().map(fly_one).collect::<Result<_>>()
    })?;
    bar.finish_and_clear();
    super::say(&if args.json { summary::to_json_array(&summaries) } else { seeds_table(&summaries) })
}

/// A flight and how long it took, s.
pub(super) struct Flown {
    pub(super) outcome: Outcome,
    pub(super) wall_s: f64,
}

fn timed(scenario: &Scenario, seed: u64, recorder: &mut impl Recorder) -> Result<Flown> {
    let start = Instant::now();
    let outcome = flight::fly(scenario, seed, recorder)?;
    Ok(Flown { outcome, wall_s: start.elapsed().as_secs_f64() })
}

/// Flies one seed; with a folder, leaves truth.csv, summary.json and the figures there.
pub(super) fn fly(scenario: &Scenario, seed: u64, out: Option<&Path>, visible: bool) -> Result<Summary> {
    let bar = Progress::new(scenario.file.duration_s, visible);
    let Some(path) = out else {
        let mut recorder = (((Metrics::new(), TruthWriter::hash_only()), bar), sensed(scenario));
        let flown = timed(scenario, seed, &mut recorder)?;
        let (((metrics, truth), bar), sensed) = recorder;
        bar.finish();
        let (sensed, _) = finish(sensed)?;
        return Ok(summarise(scenario, seed, &flown, truth.finish()?, &metrics).with_sensed(sensed));
    };
    let folder = OutFolder::create(path)?;
    let sensed = match sensed(scenario) {
        Some(recorder) => Some(recorder.writing(folder.estimate()?, is_drawn(scenario))),
        None => None,
    };
    let course = TimelineRecorder::new(&scenario.file.command);
    let mut recorder = (((((Metrics::new(), folder.truth()?), bar), Rows::new(scenario)), sensed), course);
    let flown = timed(scenario, seed, &mut recorder)?;
    let (((((metrics, truth), bar), rows), sensed), course) = recorder;
    let timeline = course.finish(&scenario.file.fault);
    bar.finish();
    let (sensed, beliefs) = finish(sensed)?;
    let summary = summarise(scenario, seed, &flown, truth.finish()?, &metrics).with_sensed(sensed);
    folder.summary(&summary)?;
    if !rows.kept.is_empty() {
        folder.figures(&Figures::new(scenario, seed, &rows.kept, &beliefs, &timeline))?;
    }
    Ok(summary)
}

fn is_drawn(scenario: &Scenario) -> bool {
    scenario.file.duration_s <= FIGURES_UP_TO_S
}

/// Takes what a flight on sensors leaves besides its truth.
fn sensed(scenario: &Scenario) -> Option<SensedRecorder> {
    scenario.file.sensors.as_ref().map(|_| SensedRecorder::new(flight::ground(scenario)))
}

fn finish(sensed: Option<SensedRecorder>) -> Result<(Option<Sensed>, Vec<Belief>)> {
    let finished = sensed.map(SensedRecorder::finish).transpose()?;
    Ok(finished.map_or_else(Default::default, |(sensed, beliefs)| (Some(sensed), beliefs)))
}

/// Keeps the rows of a flight that is short enough to be drawn.
struct Rows {
    kept: Vec<Row>,
    keep: bool,
}

impl Rows {
    fn new(scenario: &Scenario) -> Self {
        Self { kept: Vec::new(), keep: is_drawn(scenario) }
    }
}

impl Recorder for Rows {
    fn record(&mut self, row: &Row) {
        if self.keep {
            self.kept.push(*row);
        }
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
        papers_helix: scenario.file.trajectory == Trajectory::PAPER_HELIX,
        time_optimal_s: scenario.file.time_optimal_s,
        disturbance_onset_s: scenario.file.disturbance.map(|d| d.from_s),
        survived: outcome.survived,
    };
    Summary::new(flight, metrics)
}

/// One line a seed.
fn seeds_table(summaries: &[Summary]) -> String {
    let mut lines =
        vec![format!("{:>8}  {:>9}  {:>9}  {:>9}  {:>9}  end", "seed", "settle s", "x RMS m", "y RMS m", "z RMS m")];
    for s in summaries {
        let number = |value: Option<f64>, digits: usize| value.map_or("-".to_owned(), |v| format!("{v:.digits$}"));
        let axes = [&s.axes.x, &s.axes.y, &s.axes.z];
        let settle = axes.iter().try_fold(0.0_f64, |most, axis| Some(most.max(axis.settle_5cm_s?)));
        let [x, y, z] = axes.map(|axis| number(axis.rms_m, 6));
        let end = if s.survived { "survived" } else { "LOST" };
        lines.push(format!("{:>8}  {:>9}  {x:>9}  {y:>9}  {z:>9}  {end}", s.seed, number(settle, 3)));
    }
    lines.join("\n")
}
