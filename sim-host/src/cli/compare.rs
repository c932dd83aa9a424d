//! `compare`: every controller in every cell of a matrix.

use std::collections::BTreeSet;

use anyhow::Result;
use serde::Serialize;

use super::CompareArgs;
use super::fly::PROGRAM;
use super::names::{self, Kind};
use crate::compare::{Comparison, Contest};
use crate::matrix::{Case, Matrix};
use crate::report::{OutFolder, Staged, comparison, progress};
use crate::scenario::tuned_for_another;
use crate::seeds::Seeds;
use crate::words::counted;

pub(super) fn run(args: &CompareArgs) -> Result<()> {
    names::require(Kind::Matrix, &args.matrix)?;
    let mut matrix = Matrix::load(&args.matrix, &args.settings.set)?;
    if let Some(controllers) = &args.controllers {
        matrix.file.controllers.clone_from(controllers);
    }
    matrix.select(args.scenarios.as_deref(), args.disturbances.as_deref())?;
    matrix.file.seeds = args.seeds.unwrap_or(matrix.file.seeds);
    // Before the flights, which take a while: a folder that cannot be written is better known now.
    let staged = args.out.as_deref().map(Staged::begin).transpose()?;
    let contest = Contest::new(&matrix)?;
    note_late(contest.cases());
    note_airframes(&contest);
    note_beyond_reach(contest.cases());
    for (setting, disturbance) in matrix.replaced() {
        super::complain(&format!("note: {setting} does nothing under `{disturbance}`, which sets that itself"));
    }
    let found = fly(&contest, args)?;
    if let Some(staged) = &staged {
        provenance(&staged.folder(), &matrix, &contest)?;
        staged.folder().comparison(&found)?;
    }
    let contents = staged.map(Staged::finish).transpose()?;
    if args.json {
        return super::say(&serde_json::to_string(&found)?);
    }
    super::say(&super::and_wrote(comparison::render(&found), args.out.as_deref(), contents))
}

/// Says of what begins after the end of a flight, once each, in which cell that is first and in how many more.
fn note_late(cases: &[Case]) {
    let mut notes: Vec<(String, &Case, usize)> = Vec::new();
    for case in cases {
        for late in case.scenario.file.too_late() {
            let note = super::never_begins(&late);
            match notes.iter_mut().find(|(known, ..)| *known == note) {
                Some((.., more)) => *more += 1,
                None => notes.push((note, case, 0)),
            }
        }
    }
    for (note, Case { scenario_name, disturbance_name, .. }, more) in notes {
        let others = if more == 0 { String::new() } else { format!(", and {} more", counted(more, "cell")) };
        super::complain(&format!("{note} ({scenario_name} under {disturbance_name}{others})"));
    }
}

/// Says of the cells that no controller can follow.
fn note_beyond_reach(cases: &[Case]) {
    for Case { scenario, scenario_name, disturbance_name } in cases {
        if let Some(why) = scenario.beyond_reach() {
            super::complain(&format!("note: {scenario_name} under {disturbance_name}: {why}"));
        }
    }
}

/// Says, once each, of the tunings that are flown on an airframe that they were not tuned for.
fn note_airframes(contest: &Contest) {
    let airframes: BTreeSet<&str> = contest.cases().iter().map(|case| case.scenario.file.airframe.as_str()).collect();
    let pairs = airframes.iter().flat_map(|airframe| contest.tunings().iter().map(move |(name, _)| (name, airframe)));
    for note in pairs.filter_map(|(name, airframe)| tuned_for_another(name, airframe)) {
        super::complain(&format!("note: {note}"));
    }
}

fn fly(contest: &Contest, args: &CompareArgs) -> Result<Comparison> {
    let bar = progress::of_flights(contest.flights() as u64, !args.json);
    let pool = args.threads.pool(contest.flights() as u64)?;
    let found = pool.install(|| contest.fly(|| bar.inc(1)))?;
    bar.finish_and_clear();
    Ok(found)
}

/// By which program a comparison was flown, and what of.
#[derive(Serialize)]
struct Provenance<'a> {
    program: &'a str,
    version: &'a str,
    matrix: &'a str,
    set: &'a [String],
    seeds: Seeds,
    controllers: &'a [String],
    again: &'a str,
}

/// Writes provenance.toml, and the matrix with what it names, from which the same is flown again.
fn provenance(folder: &OutFolder, matrix: &Matrix, contest: &Contest) -> Result<()> {
    let provenance = Provenance {
        program: PROGRAM,
        version: env!("CARGO_PKG_VERSION"),
        matrix: &matrix.name,
        set: matrix.settings(),
        seeds: matrix.file.seeds,
        controllers: &matrix.file.controllers,
        again: "sim-host compare matrix.toml",
    };
    folder.text("provenance.toml", &toml::to_string(&provenance)?)?;
    matrix.files(contest.tunings())?.iter().try_for_each(|(name, text)| folder.text(name, text))
}
