//! `--replay`: a scenario is flown with what came from outside while it was flown by hand.

use std::path::Path;

use anyhow::{Context as _, Result};

use super::Which;
use crate::recording::{Header, Recording};
use crate::scenario::Scenario;

/// The scenario with a recording, if one is named, and the seed: the one given, else the recording's, else `other`.
pub(super) fn load(
    which: &Which,
    seed: Option<u64>,
    recording: Option<&Path>,
    other: impl FnOnce(&Scenario) -> u64,
) -> Result<(Scenario, u64)> {
    let scenario = which.load()?;
    let Some(path) = recording else {
        let seed = seed.unwrap_or_else(|| other(&scenario));
        return Ok((scenario, seed));
    };
    scenario.require_rigid_body()?;
    let recording = Recording::read(path)?;
    let seed = seed.unwrap_or(recording.header.seed);
    let flown = Header::new(&scenario, &which.settings.set, seed)?;
    recording.require(&flown).with_context(|| format!("recording `{}`", path.display()))?;
    if !recording.has_ended {
        super::complain(&format!(
            "note: recording `{}` was cut off, it has no line `end`: it is flown to its last line, tick {}",
            path.display(),
            recording.ticks - 1
        ));
    }
    Ok((recording.onto(scenario), seed))
}
