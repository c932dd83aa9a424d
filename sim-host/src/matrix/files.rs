//! A matrix as files that fly it again, wherever they are: scenarios, airframes and tunings that were files lie beside it.

use std::path::Path;

use anyhow::{Context as _, Result};

use super::{Matrix, MatrixFile};
use crate::controller::{Controller, TuningFile};
use crate::files::{LARGEST, read_regular};
use crate::scenario::{Scenario, airframe_of, beside};

/// The name of a built-in file unchanged; of a path, the file's name without its extension, and without what
/// [`Matrix::files`] puts before it.
pub fn short_name(name: &str) -> &str {
    let file = name.rsplit('/').next().unwrap_or(name);
    let Some(stem) = file.strip_suffix(".toml") else { return file };
    ["tuning-", "scenario-"].iter().find_map(|kind| stem.strip_prefix(kind)).unwrap_or(stem)
}

/// Files to be written, and their texts.
type Files = Vec<(String, String)>;

impl Matrix {
    /// matrix.toml, and what it names: each controller as `tuning-NAME.toml`, each scenario that was a file as
    /// `scenario-NAME.toml` with its `airframe-NAME.toml`, and airframes that settings name. The settings of the command
    /// line stand in the matrix.
    ///
    /// # Errors
    /// A file that has gone since it was read.
    pub fn files(&self, tunings: &[(String, TuningFile)]) -> Result<Files> {
        let mut kept = Files::new();
        for (name, tuning) in tunings {
            kept.push((format!("tuning-{name}.toml"), toml::to_string(tuning).context("cannot write a tuning")?));
        }
        let mut file =
            MatrixFile { controllers: kept.iter().map(|(name, _)| name.clone()).collect(), ..self.file.clone() };
        let (_, first) = tunings.first().context("no controller was flown")?;
        for name in &self.file.scenarios {
            if Path::new(name).extension().is_some() {
                let kept_as = self.keep_scenario(name, &first.controller, &mut kept)?;
                file.rename_scenario(name, &kept_as);
            }
        }
        file.settings_mut().try_for_each(|setting| keep_airframe(setting, &mut kept))?;
        kept.push(("matrix.toml".to_owned(), toml::to_string(&file).context("cannot write the matrix")?));
        Ok(kept)
    }

    /// Adds a scenario without the settings of the matrix; returns the name of its file.
    fn keep_scenario(&self, name: &str, controller: &Controller, kept: &mut Files) -> Result<String> {
        let stem = short_name(name);
        let scenario = Scenario::load_for(&beside(&self.name, name), &[], controller)?;
        let (scenario_file, airframe_file) = (format!("scenario-{stem}.toml"), format!("airframe-{stem}.toml"));
        let [scenario, airframe] = scenario.files_for_any_controller(&airframe_file)?;
        kept.extend([(scenario_file.clone(), scenario), (airframe_file, airframe)]);
        Ok(scenario_file)
    }
}

impl MatrixFile {
    fn rename_scenario(&mut self, from: &str, to: &str) {
        let rename = |names: &mut Vec<String>| {
            names.iter_mut().filter(|name| *name == from).for_each(|name| to.clone_into(name));
        };
        rename(&mut self.scenarios);
        for disturbance in &mut self.disturbances {
            disturbance.scenarios.iter_mut().for_each(rename);
            rename(&mut disturbance.except);
        }
    }
}

/// Adds the airframe's file that a setting names, and lets the setting name the copy.
fn keep_airframe(setting: &mut String, kept: &mut Files) -> Result<()> {
    let Some(path) = airframe_of(setting).filter(|path| Path::new(path).is_file()) else { return Ok(()) };
    let text =
        read_regular(Path::new(&path), LARGEST).with_context(|| format!("cannot read airframe file `{path}`"))?;
    let name = format!("airframe-{}.toml", short_name(&path));
    *setting = format!("airframe={name}");
    if !kept.iter().any(|(known, _)| *known == name) {
        kept.push((name, text));
    }
    Ok(())
}
