//! A matrix as files that fly it again, wherever they are: what it names that were files lie beside it.

use std::path::Path;

use anyhow::{Context as _, Result};
use toml::{Table, Value};

use super::{Matrix, MatrixFile};
use crate::controller::{Controller, TuningFile};
use crate::files::{LARGEST, Source, beside, read_regular};
use crate::scenario::{Scenario, with_files};
use crate::sensors::suite::file_names;

/// The name of a built-in file unchanged; of a path, the file's name without its extension, and without what
/// [`Matrix::files`] puts before it.
pub fn short_name(name: &str) -> &str {
    let (folder, file) = name.rsplit_once('/').unwrap_or(("", name));
    let Some(stem) = file.strip_suffix(".toml") else { return file };
    // What a search has found is called tuning.toml in a folder of its own.
    let folder = folder.rsplit('/').next().unwrap_or_default();
    if stem == "tuning" && !folder.trim_matches('.').is_empty() {
        return folder;
    }
    KEPT.iter().find_map(|kind| stem.strip_prefix(kind)).unwrap_or(stem)
}

/// What the names of the files begin with that a comparison keeps beside its matrix.
pub const KEPT: [&str; 5] = ["tuning-", "scenario-", "airframe-", "suite-", "part-"];

/// Files to be written, and their texts.
type Files = Vec<(String, String)>;

impl Matrix {
    /// matrix.toml, and what it names: each controller as `tuning-NAME.toml`, each scenario that was a file as
    /// `scenario-NAME.toml` with its `airframe-NAME.toml`, and the airframes, suites and parts that they or settings name.
    /// The settings of the command line stand in the matrix.
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
        for setting in file.settings_mut() {
            *setting = with_files(setting, |kind, path| keep(kind, path, &mut kept))?;
        }
        kept.push(("matrix.toml".to_owned(), toml::to_string(&file).context("cannot write the matrix")?));
        Ok(kept)
    }

    /// Adds a scenario without the settings of the matrix; returns the name of its file.
    fn keep_scenario(&self, name: &str, controller: &Controller, kept: &mut Files) -> Result<String> {
        let (stem, path) = (short_name(name), beside(&self.name, name));
        let loaded = Scenario::load_for(&path, &[], controller)?;
        let airframe = toml::to_string(&loaded.airframe).context("cannot write an airframe")?;
        let airframe = add("airframe", stem, airframe, kept);
        let mut scenario = loaded.table_for_any_controller(&airframe)?;
        // As they are written: values of a part that stood in the scenario would stay with another part by a setting.
        if let Some(sensors) = Source::read(&path, "scenario", &[])?.table()?.remove("sensors") {
            scenario.insert("sensors".to_owned(), keep_named(sensors, &path, kept)?);
        }
        let scenario = toml::to_string(&scenario).context("cannot write a scenario")?;
        Ok(add("scenario", stem, scenario, kept))
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

/// The name by which a file is kept, with the files that it names; a name that is no file's stays as it is.
fn keep(kind: &str, path: &str, kept: &mut Files) -> Result<String> {
    if !Path::new(path).is_file() {
        return Ok(path.to_owned());
    }
    let mut text =
        read_regular(Path::new(path), LARGEST).with_context(|| format!("cannot read {kind} file `{path}`"))?;
    if kind == "suite" {
        let suite: Table = text.parse().with_context(|| format!("{kind} `{path}`"))?;
        text = toml::to_string(&keep_named(Value::Table(suite), path, kept)?).context("cannot write a suite")?;
    }
    Ok(add(kind, short_name(path), text, kept))
}

/// Keeps what a suite, or a scenario's `sensors`, names from the file `by`; the same with the names of the copies.
fn keep_named(mut sensors: Value, by: &str, kept: &mut Files) -> Result<Value> {
    for (kind, name) in file_names(&mut sensors) {
        *name = keep(kind, &beside(by, name), kept)?;
    }
    Ok(sensors)
}

/// Adds a file by a name that no other has; returns it.
fn add(kind: &str, stem: &str, text: String, kept: &mut Files) -> String {
    let mut name = format!("{kind}-{stem}.toml");
    let mut number = 1;
    while let Some((_, other)) = kept.iter().find(|(known, _)| *known == name) {
        if *other == text {
            return name;
        }
        number += 1;
        name = format!("{kind}-{stem}-{number}.toml");
    }
    kept.push((name.clone(), text));
    name
}
