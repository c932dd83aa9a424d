//! `run`: flies a scenario, for one seed or many, and reports.

use anyhow::{Result, bail, ensure};

use super::{RunArgs, fly, replay};
use crate::interrupt::{self, Interrupted};
use crate::parallel;
use crate::report::summary::{self, Row};
use crate::report::{OutFolder, Paint, Staged, progress, table};
use crate::scenario::Scenario;
use crate::seeds::Seeds;
use crate::sil::End;
use crate::words::counted;

pub(super) fn run(args: &RunArgs) -> Result<()> {
    let (scenario, seed) =
        replay::load(&args.which, args.seed, args.replay.as_deref(), |scenario| seed(args, scenario))?;
    super::note_idle_seeds(&scenario, args.seeds.is_some() || args.seed.is_some_and(|seed| seed != 1));
    let duration_s = scenario.file.duration_s;
    if args.out.is_some() && duration_s > fly::FIGURES_UP_TO_S {
        super::complain(&format!(
            "note: no figures: they are drawn of flights up to {} s, and `duration_s` is {duration_s}",
            fly::FIGURES_UP_TO_S
        ));
    }
    interrupt::listen();
    let staged = args.out.as_deref().map(Staged::begin).transpose()?;
    match args.seeds {
        Some(seeds) => many(args, &scenario, seeds, staged),
        None => one(args, &scenario, seed, staged),
    }
}

/// The seed of the flight which has left the scenario, so that it is the same flight; else 1.
fn seed(args: &RunArgs, scenario: &Scenario) -> u64 {
    let again = || {
        let seed = fly::seed_beside(&args.which.scenario)?;
        if args.seeds.is_none() && scenario.file.is_random() {
            super::complain(&format!(
                "note: flown with seed {seed}, as provenance.toml has it; choose another with --seed"
            ));
        }
        Some(seed)
    };
    again().unwrap_or(1)
}

fn one(args: &RunArgs, scenario: &Scenario, seed: u64, staged: Option<Staged>) -> Result<()> {
    let visible = !args.json;
    let summary = match &staged {
        Some(staged) => fly::fly_into(&staged.folder(), scenario, &args.which.settings.set, seed, visible)?,
        None => fly::fly(scenario, seed, visible)?,
    };
    let text = if args.json { summary.to_json() } else { table::render(&summary, Paint::for_stdout()) };
    report(args, &text, staged)?;
    ensure!(summary.ended != End::Interrupted, Interrupted);
    Ok(())
}

/// Puts the folder in its place and prints the result, with where it has been written.
fn report(args: &RunArgs, text: &str, staged: Option<Staged>) -> Result<()> {
    let contents = staged.map(Staged::finish).transpose()?;
    match (contents, &args.out) {
        (Some(contents), Some(out)) if !args.json => super::say(&(text.to_owned() + &super::wrote(out, &contents))),
        _ if args.json => super::say(text),
        _ => super::say(
            &(text.to_owned() + &table::entry("figures", "none without `--out DIR`, which also keeps truth.csv")),
        ),
    }
}

fn many(args: &RunArgs, scenario: &Scenario, seeds: Seeds, staged: Option<Staged>) -> Result<()> {
    let folder = staged.as_ref().map(Staged::folder);
    let mut rows = fly_all(args, scenario, seeds, folder.as_ref())?;
    if let Some(reason) = common_failure(&rows) {
        bail!(reason);
    }
    if let Some(folder) = &folder {
        folder.text("summary.json", &summary::to_file_array(&rows))?;
    }
    let text = if args.json { summary::to_json_array(&rows) } else { table::seeds(&rows) };
    report(args, &text, staged)?;
    if interrupt::requested() {
        let asked = counted(seeds.count(), "seed");
        super::complain(&format!("interrupted: {} of {asked} flown", whole(&rows)));
        return Err(Interrupted.into());
    }
    let flown = rows.len();
    rows.retain(|row| matches!(row, Row::Failed { .. }));
    ensure!(rows.is_empty(), SomeFailed { failed: rows.len(), of: flown });
    Ok(())
}

/// Flies all seeds that are begun before the user asks for an end.
fn fly_all(args: &RunArgs, scenario: &Scenario, seeds: Seeds, folder: Option<&OutFolder>) -> Result<Vec<Row>> {
    let bar = progress::of_flights(seeds.count(), !args.json);
    let pool = args.threads.pool(seeds.count())?;
    let fly_one = |seed: &u64| {
        let row = (!interrupt::requested()).then(|| fly_seed(args, scenario, *seed, folder));
        bar.inc(1);
        row
    };
    let rows = pool.install(|| parallel::map(&seeds.all(), fly_one)).into_iter().flatten().collect();
    bar.finish_and_clear();
    Ok(rows)
}

fn fly_seed(args: &RunArgs, scenario: &Scenario, seed: u64, folder: Option<&OutFolder>) -> Row {
    let flown = match folder {
        Some(folder) => folder
            .below(&format!("seed-{seed}"))
            .and_then(|folder| fly::fly_into(&folder, scenario, &args.which.settings.set, seed, false)),
        None => fly::fly(scenario, seed, false),
    };
    match flown {
        Ok(summary) => Row::Flown(Box::new(summary)),
        Err(error) => Row::Failed { seed, error: super::one_line(&error) },
    }
}

/// How many flights were not interrupted.
fn whole(rows: &[Row]) -> usize {
    let ended_by_itself = |row: &&Row| !matches!(row, Row::Flown(summary) if summary.ended == End::Interrupted);
    rows.iter().filter(ended_by_itself).count()
}

/// The reason for which all seeds failed, where it is the same for all: then there is nothing to report but that.
fn common_failure(rows: &[Row]) -> Option<String> {
    let mut errors = rows.iter().map(|row| if let Row::Failed { error, .. } = row { Some(error) } else { None });
    let first = errors.next()??;
    errors.all(|error| error == Some(first)).then(|| first.clone())
}

/// Some of several flights could not be flown; the others have been reported.
#[derive(Debug)]
pub(super) struct SomeFailed {
    failed: usize,
    of: usize,
}

impl std::fmt::Display for SomeFailed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} of {} could not be flown", self.failed, counted(self.of, "seed"))
    }
}

impl std::error::Error for SomeFailed {}

#[cfg(test)]
mod tests {
    use super::*;

    fn failed(seed: u64, error: &str) -> Row {
        Row::Failed { seed, error: error.into() }
    }

    #[test]
    fn a_reason_that_all_share_is_told_once() {
        assert_eq!(common_failure(&[failed(1, "no"), failed(2, "no")]), Some("no".into()));
        assert_eq!(common_failure(&[failed(1, "no"), failed(2, "disk full")]), None);
        assert_eq!(common_failure(&[]), None);
    }
}
