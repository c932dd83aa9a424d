//! `tune`: searches for the gains of a controller, and writes them as a tuning file.

use std::fs;
use std::path::Path;

use anyhow::Result;
use indicatif::ProgressBar;
use sha2::{Digest as _, Sha256};

use super::TuneArgs;
use super::names::{self, Kind};
use crate::report::out::cannot_write;
use crate::report::{OutFolder, plots, progress, truth};
use crate::tune::{Iteration, Journal, Parameter, Run, Settings, State, Tune, require_optimisers};
use crate::words::counted;

pub(super) fn run(args: &TuneArgs) -> Result<()> {
    names::require(Kind::Tune, &args.tune)?;
    let tune = Tune::load(&args.tune)?;
    require_optimisers("tune")?;
    let journal = journal(args, &tune)?;
    let bar = progress::of_search((args.particles * args.iterations) as u64, true);
    let pool = args.threads.pool(u64::MAX)?;
    let (state, base_cost) = pool.install(|| {
        let report = Report::new(args, &tune, &bar)?;
        let cost = |point: &[f64]| {
            let cost = tune.cost(point);
            bar.inc(1);
            cost
        };
        let run = Run { settings: settings(args), dimensions: tune.space.dimensions(), cost, journal };
        Ok::<_, anyhow::Error>((run.go(|state| report.write(state))?, report.base_cost))
    })?;
    bar.finish_and_clear();
    super::say(&format!(
        "cost {:.4} after {} evaluations of {}: {} holds the gains",
        state.best_cost(),
        state.iterations.len() * args.particles,
        counted(tune.course.flights(), "flight"),
        args.out.join(TUNING).display()
    ))?;
    if let Some(warning) = warning(args, &state, base_cost) {
        super::complain(&warning);
    }
    Ok(())
}

/// What to do if the search has not come below where it started.
fn warning(args: &TuneArgs, state: &State, base_cost: f64) -> Option<String> {
    let best = state.best_cost();
    (best >= base_cost).then(|| {
        format!(
            "warning: the gains found cost {best:.4}, no less than the base's own {base_cost:.4}: keep the base's, or go on \
             with --resume --iterations {}",
            2 * args.iterations
        )
    })
}

const TUNING: &str = "tuning.toml";

fn settings(args: &TuneArgs) -> Settings {
    Settings { method: args.method, particles: args.particles, iterations: args.iterations, seed: args.seed }
}

/// The journal in the folder, which tells by a hash of all that decides a cost whose it is.
fn journal(args: &TuneArgs, tune: &Tune) -> Result<Journal> {
    OutFolder::create(&args.out)?;
    let path = args.out.join("journal.csv");
    let decides = format!("{} {} {} {}", args.method.name(), args.particles, args.seed, tune.identity());
    let identity = truth::hex(&Sha256::digest(decides));
    let names: Vec<&str> = tune.space.parameters().iter().map(Parameter::name).collect();
    if args.resume { Journal::resume(&path, &identity, &names) } else { Journal::create(&path, &identity, &names) }
}

/// What a run leaves in its folder, iteration by iteration.
struct Report<'a> {
    args: &'a TuneArgs,
    tune: &'a Tune,
    bar: &'a ProgressBar,
    base_cost: f64,
}

impl<'a> Report<'a> {
    fn new(args: &'a TuneArgs, tune: &'a Tune, bar: &'a ProgressBar) -> Result<Self> {
        let base_cost = tune.course.cost(&tune.space.base_controller()?);
        bar.println(format!("the base's own gains cost {base_cost:.4}"));
        Ok(Self { args, tune, bar, base_cost })
    }

    fn write(&self, state: &State) -> Result<()> {
        self.bar.set_position((state.iterations.len() * self.args.particles) as u64);
        self.bar.set_message(format!("{:.4}", state.best_cost()));
        let tuning = self.tune.space.tuning(&state.best_point, &self.summary(state))?;
        replace(&self.args.out.join(TUNING), &tuning)?;
        replace(&self.args.out.join("progress.csv"), &table(state, self.args.particles))?;
        plots::convergence(&self.args.out, &state.iterations, self.base_cost)?;
        Ok(())
    }

    /// Where the gains come from: the cost, the budget, and the command that finds them again.
    fn summary(&self, state: &State) -> String {
        let TuneArgs { tune, method, particles, seed, .. } = self.args;
        let iterations = state.iterations.len();
        let worse = if state.best_cost() < self.base_cost { "" } else { ", which are no worse" };
        format!(
            "cost {:.4} on course {} (the base's own gains: {:.4}{worse}) after {} evaluations of {}: \
             sim-host tune {tune} --method {} --particles {particles} --iterations {iterations} --seed {seed}",
            state.best_cost(),
            self.tune.course.name,
            self.base_cost,
            iterations * particles,
            counted(self.tune.course.flights(), "flight"),
            method.name(),
        )
    }
}

fn table(state: &State, particles: usize) -> String {
    let line = |(i, iteration): (usize, &Iteration)| {
        format!("{},{},{},{}\n", i + 1, (i + 1) * particles, iteration.best, iteration.mean)
    };
    let lines: Vec<String> = state.iterations.iter().enumerate().map(line).collect();
    "iteration,evaluations,best,mean\n".to_owned() + &lines.concat()
}

/// Writes a file in one step, so that an interruption leaves the old one or the new one.
fn replace(path: &Path, text: &str) -> Result<()> {
    let beside = path.with_extension("new");
    fs::write(&beside, text).and_then(|()| fs::rename(&beside, path)).map_err(|error| {
        let _ = fs::remove_file(&beside);
        cannot_write(path, error)
    })
}
