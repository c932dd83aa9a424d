//! `compare`: every controller in every cell of a matrix.

use anyhow::Result;

use super::CompareArgs;
use crate::compare::{Comparison, Contest};
use crate::matrix::Matrix;
use crate::report::{Staged, comparison, progress};

pub(super) fn run(args: &CompareArgs) -> Result<()> {
    let mut matrix = Matrix::load(&args.matrix, &args.settings.set)?;
    if let Some(controllers) = &args.controllers {
        matrix.file.controllers.clone_from(controllers);
    }
    matrix.select(args.scenarios.as_deref(), args.disturbances.as_deref())?;
    matrix.file.seeds = args.seeds.unwrap_or(matrix.file.seeds);
    // Before the flights, which take a while: a folder that cannot be written is better known now.
    let staged = args.out.as_deref().map(Staged::begin).transpose()?;
    let found = fly(&Contest::new(&matrix)?, args)?;
    if let Some(staged) = staged {
        staged.folder().comparison(&found)?;
        staged.finish()?;
    }
    super::say(&if args.json { serde_json::to_string(&found)? } else { comparison::render(&found) })
}

fn fly(contest: &Contest, args: &CompareArgs) -> Result<Comparison> {
    let bar = progress::of_flights(contest.flights() as u64, !args.json);
    let pool = args.threads.pool(contest.flights() as u64)?;
    let found = pool.install(|| contest.fly(|| bar.inc(1)))?;
    bar.finish_and_clear();
    Ok(found)
}
