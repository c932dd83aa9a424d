//! `assess`: many seeds of scenarios that say what is expected of them.

use anyhow::Result;

use super::AssessArgs;
use crate::assess::{Report, ensemble};
use crate::report::progress;
use crate::scenario::{self, Scenario};
use crate::words::counted;

pub(super) fn run(args: &AssessArgs) -> Result<()> {
    let scenarios = load(args)?;
    let bar = progress::of_flights(args.seeds.count() * scenarios.len() as u64, !args.json);
    let pool = args.threads.pool(args.seeds.count())?;
    let reports: Vec<Report> = pool.install(|| {
        scenarios.iter().map(|scenario| ensemble::fly(scenario, args.seeds, || bar.inc(1))).collect::<Result<_>>()
    })?;
    bar.finish_and_clear();
    let unmet = reports.iter().filter(|report| !report.is_met()).count();
    if args.json {
        super::say(&serde_json::to_string(&reports)?)?;
        return if unmet == 0 { Ok(()) } else { Err(Unmet { scenarios: unmet }.into()) };
    }
    let texts: Vec<String> = reports.iter().map(Report::render).collect();
    let too_few = reports.iter().filter(|report| report.seeds_needed().is_some()).count();
    let end = match (unmet, too_few) {
        (0, 0) => "all as expected".to_owned(),
        (0, _) => format!("nothing violated; {too_few} could not be judged: too few seeds"),
        _ => format!("{unmet} not as expected"),
    };
    super::say(&format!("{}\n{}: {end}", texts.join("\n"), counted(reports.len(), "scenario")))?;
    if unmet == 0 { Ok(()) } else { Err(Unmet { scenarios: unmet }.into()) }
}

/// What was expected has not come.
#[derive(Debug)]
pub(super) struct Unmet {
    scenarios: usize,
}

impl std::fmt::Display for Unmet {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "scenarios that are not as expected: {}", self.scenarios)
    }
}

impl std::error::Error for Unmet {}

/// Those asked for; without a name, all built-in ones that are judged, but for those that take hours.
fn load(args: &AssessArgs) -> Result<Vec<Scenario>> {
    /// Simulated time that is flown unasked, s.
    const LONGEST_S: f64 = 1000.0;
    if !args.scenarios.is_empty() {
        return args.scenarios.iter().map(|name| super::load(name, &args.settings.set)).collect();
    }
    let all = scenario::list()?;
    let all = all.iter().map(|listed| Scenario::load(listed.name, &args.settings.set)).collect::<Result<Vec<_>>>()?;
    Ok(all.into_iter().filter(|s| s.file.assess.is_some() && s.file.duration_s <= LONGEST_S).collect())
}
