//! A scenario as files that fly it again, wherever they are: what was named is written out, and settings are in it.

use anyhow::{Context as _, Result};
use serde::Serialize;
use toml::Table;

use super::{Scenario, ScenarioFile};
use crate::controller::TuningFile;

impl Scenario {
    /// scenario.toml, airframe.toml and tuning.toml, each with its text; the first names the others, which have to lie
    /// beside it.
    ///
    /// # Errors
    /// None for a scenario that was loaded: its values came from TOML.
    pub fn files(&self) -> Result<[(&'static str, String); 3]> {
        let file = self.file_naming("airframe.toml", Some("tuning.toml"));
        let summary = format!("as flown in {}", self.name);
        let tuning = TuningFile { summary, controller: self.controller.clone() };
        Ok([("scenario.toml", text(&file)?), ("airframe.toml", text(&self.airframe)?), ("tuning.toml", text(&tuning)?)])
    }

    /// The scenario without gains, for whatever controller flies it; its airframe is to lie beside it by this name.
    ///
    /// # Errors
    /// None for a scenario that was loaded: its values came from TOML.
    pub fn table_for_any_controller(&self, airframe: &str) -> Result<Table> {
        Table::try_from(self.file_naming(airframe, None)).context(CANNOT)
    }

    fn file_naming(&self, airframe: &str, tuning: Option<&str>) -> ScenarioFile {
        let tuning = tuning.map(str::to_owned);
        ScenarioFile { airframe: airframe.to_owned(), tuning, control: None, ..self.file.clone() }
    }
}

const CANNOT: &str = "cannot write the scenario as TOML";

fn text(value: &impl Serialize) -> Result<String> {
    toml::to_string(value).context(CANNOT)
}

#[cfg(test)]
mod tests {
    use super::super::{Scenario, list};

    #[test]
    fn every_built_in_scenario_is_the_same_from_its_files() {
        let folder = std::env::temp_dir().join(format!("glissade-{}-files", std::process::id()));
        std::fs::create_dir_all(&folder).expect("the temporary folder can be written");
        let path = folder.join("scenario.toml");
        for listed in list().expect("all load") {
            let scenario = Scenario::load(listed.name, &["duration_s=300.5".into()]).expect("it loads");
            for (name, text) in scenario.files().expect("TOML") {
                std::fs::write(folder.join(name), text).expect("can be written");
            }
            let again = Scenario::load(path.to_str().expect("a plain path"), &[]).unwrap_or_else(|e| panic!("{e:#}"));
            assert_eq!(again.flight_config(), scenario.flight_config(), "{}", listed.name);
            let (airframe, tuning, control) =
                (scenario.file.airframe.clone(), scenario.file.tuning.clone(), scenario.file.control.clone());
            let file = super::ScenarioFile { airframe, control, tuning, ..again.file };
            assert_eq!(
                (file, again.airframe, again.controller),
                (scenario.file, scenario.airframe, scenario.controller)
            );
        }
        std::fs::remove_dir_all(&folder).expect("the folder is there");
    }
}
