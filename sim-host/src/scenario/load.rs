//! Reading a scenario: its file, its airframe's and its tuning's, with settings from the command line laid over them.

use std::path::Path;

use anyhow::{Context, Result, bail};

use super::settings::{set, split_setting};
use super::{AIRFRAMES, SCENARIOS, Scenario, ScenarioFile, TUNINGS, trajectory};
use crate::airframe::AirframeFile;
use crate::controller::{Controller, TuningFile};
use crate::files::{one_line, parse, read, source};

impl Scenario {
    /// Loads a built-in scenario by name or a file by path, with `KEY=VALUE` settings applied to it. Keys are
    /// dotted (`control.roll.lambda`); those under `airframe.` set the airframe's.
    ///
    /// # Errors
    /// One line that names the scenario or file, the key, and what is wrong with it.
    pub fn load(name: &str, settings: &[String]) -> Result<Self> {
        let context = || format!("scenario `{name}`");
        let mut table = parse(&source(name, "scenario", &SCENARIOS)?).with_context(context)?;
        let mut airframe_settings = Vec::new();
        for setting in settings {
            let (key, value) = split_setting(setting)?;
            match key.strip_prefix("airframe.") {
                Some(key) => airframe_settings.push((key, value)),
                None => set(&mut table, key, value).with_context(|| format!("--set {setting}"))?,
            }
        }
        let folder = Path::new(name).parent().unwrap_or(Path::new(""));
        trajectory::resolve(&mut table, folder).with_context(context)?;
        let mut file: ScenarioFile = table.try_into().map_err(|error| one_line(&error)).with_context(context)?;
        if settings.iter().any(|setting| moves_the_bound(setting)) {
            file.time_optimal_s = None;
        }

        let airframe_name = file.airframe.clone();
        let context_airframe = || format!("airframe `{airframe_name}`");
        let mut table = parse(&source(&airframe_name, "airframe", &AIRFRAMES)?).with_context(context_airframe)?;
        for (key, value) in airframe_settings {
            set(&mut table, key, value).with_context(|| format!("--set airframe.{key}"))?;
        }
        let mut airframe: AirframeFile =
            table.try_into().map_err(|error| one_line(&error)).with_context(context_airframe)?;
        airframe.thrust_to_weight = file.thrust_to_weight.unwrap_or(airframe.thrust_to_weight);
        airframe.rotor_lag_s = file.rotor_lag_s.unwrap_or(airframe.rotor_lag_s);
        airframe.actuation_delay_s = file.actuation_delay_s.unwrap_or(airframe.actuation_delay_s);

        let controller = controller(&file).with_context(context)?;
        let scenario = Self { name: name.to_owned(), file, airframe, controller };
        scenario.validate().with_context(context)?;
        Ok(scenario)
    }
}

/// Loads a built-in tuning by name or a file by path.
///
/// # Errors
/// One line that names the tuning or file, and what is wrong with it.
pub fn tuning(name: &str) -> Result<TuningFile> {
    read(name, "tuning", &TUNINGS)
}

/// The controller that a scenario asks for.
fn controller(file: &ScenarioFile) -> Result<Controller> {
    let own = format!("{}-smc", file.airframe);
    match (&file.tuning, &file.control) {
        (Some(name), None) => Ok(tuning(name)?.controller),
        (None, Some(control)) => Ok(Controller::Smc(control.clone())),
        (None, None) if TUNINGS.iter().any(|(name, _)| *name == own) => Ok(tuning(&own)?.controller),
        (Some(_), Some(_)) => bail!("`tuning` and `control` both say what flies: keep one"),
        (None, None) => bail!("`tuning` is missing: name a tuning file, or give gains under `[control]`"),
    }
}

/// Whether a setting makes another problem of it than the one whose time-optimal bound is known.
fn moves_the_bound(setting: &str) -> bool {
    let key = setting.split(['=', '.']).next().unwrap_or_default();
    let start = key.starts_with("start_") || key == "tumble";
    let world = matches!(key, "truth" | "wind" | "world" | "push" | "battery" | "fault" | "sensors");
    start || world || matches!(key, "airframe" | "thrust_to_weight" | "trajectory" | "plant")
}
