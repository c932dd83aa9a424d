//! A matrix of flights: scenarios, what disturbs them, controllers, seeds. Built into the binary, or read from a file.

use std::collections::BTreeSet;

use anyhow::{Context, Result, ensure};
use serde::{Deserialize, Serialize};

use crate::scenario::{self, Scenario, built_in};
use crate::seeds::Seeds;

/// Matrices that come with the binary.
const MATRICES: [(&str, &str); 1] = built_in!("matrices": "x500");

/// A disturbance, as settings of a scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DisturbanceEntry {
    /// Its name.
    pub name: String,
    /// `KEY=VALUE`, as `--set` takes them.
    pub set: Vec<String>,
    /// Which scenarios it disturbs; all without it.
    pub scenarios: Option<Vec<String>>,
    /// Which of them it does not.
    #[serde(default)]
    pub except: Vec<String>,
}

impl DisturbanceEntry {
    /// Whether it disturbs a scenario.
    pub fn applies_to(&self, scenario: &str) -> bool {
        let has = |names: &[String]| names.iter().any(|name| name == scenario);
        self.scenarios.as_deref().is_none_or(has) && !has(&self.except)
    }
}

/// A matrix file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MatrixFile {
    /// What it compares, in a line.
    pub summary: String,
    /// Names or paths of tuning files; the first is the one that the others are compared with.
    pub controllers: Vec<String>,
    /// Names or paths of scenarios.
    pub scenarios: Vec<String>,
    /// What disturbs them.
    pub disturbances: Vec<DisturbanceEntry>,
    /// Seeds to judge with.
    pub seeds: Seeds,
    /// Seeds to tune with; none of them judges.
    pub training_seeds: Option<Seeds>,
}

/// A matrix that can be flown.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    /// Its name, or the path it was read from.
    pub name: String,
    /// What to fly.
    pub file: MatrixFile,
    /// `KEY=VALUE` settings of every scenario, before those of the disturbances.
    settings: Vec<String>,
}

/// A cell of a matrix: a scenario under a disturbance. [`Scenario::flown_by`] puts a controller in.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// With the settings that make the disturbance, and the controller that its file names.
    pub scenario: Scenario,
    /// Its name in the matrix.
    pub scenario_name: String,
    /// Name of the disturbance.
    pub disturbance_name: String,
}

impl Case {
    /// Whether the seed makes a difference. Where it does not, one flight tells everything.
    pub fn is_random(&self) -> bool {
        let file = &self.scenario.file;
        let gusty = file.wind.as_ref().is_some_and(|wind| wind.turbulence_20ft_m_s > 0.0);
        file.disturbance.is_some() || file.tumble.is_some() || gusty
    }

    /// The seeds out of `seeds` that are worth flying: all if they differ, the first if they do not.
    pub fn seeds(&self, seeds: Seeds) -> impl Iterator<Item = u64> {
        let last = if self.is_random() { seeds.last } else { seeds.first };
        seeds.first..=last
    }
}

impl Matrix {
    /// Loads a built-in matrix by name or a file by path. `settings` (`KEY=VALUE`) are applied to each scenario.
    ///
    /// # Errors
    /// One line that names the matrix or file, the key, and what is wrong with it.
    pub fn load(name: &str, settings: &[String]) -> Result<Self> {
        let file: MatrixFile = scenario::read(name, "matrix", &MATRICES)?;
        file.validate().with_context(|| format!("matrix `{name}`"))?;
        Ok(Self { name: name.to_owned(), file, settings: settings.to_vec() })
    }

    /// Its cells: for each scenario in turn, the disturbances that apply to it.
    ///
    /// # Errors
    /// One line that names the disturbance, the scenario, the key, and what is wrong with it.
    pub fn cases(&self) -> Result<Vec<Case>> {
        let cells = self.file.scenarios.iter().flat_map(|scenario| {
            let applies = |disturbance: &&DisturbanceEntry| disturbance.applies_to(scenario);
            self.file.disturbances.iter().filter(applies).map(move |disturbance| (scenario, disturbance))
        });
        cells.map(|(scenario, disturbance)| self.case(scenario, disturbance)).collect()
    }

    fn case(&self, scenario: &str, disturbance: &DisturbanceEntry) -> Result<Case> {
        let settings = [self.settings.as_slice(), &disturbance.set].concat();
        let loaded = Scenario::load(scenario, &settings)
            .with_context(|| format!("matrix `{}`, disturbance `{}`", self.name, disturbance.name))?;
        Ok(Case { scenario: loaded, scenario_name: scenario.to_owned(), disturbance_name: disturbance.name.clone() })
    }
}

impl MatrixFile {
    fn validate(&self) -> Result<()> {
        distinct("controllers", self.controllers.iter())?;
        distinct("scenarios", self.scenarios.iter())?;
        distinct("disturbances", self.disturbances.iter().map(|disturbance| &disturbance.name))?;
        for disturbance in &self.disturbances {
            for name in disturbance.scenarios.iter().flatten().chain(&disturbance.except) {
                let key = &disturbance.name;
                ensure!(
                    self.scenarios.contains(name),
                    "disturbance `{key}` names `{name}`, which `scenarios` does not"
                );
            }
        }
        ensure!(
            !self.training_seeds.is_some_and(|training| training.overlaps(self.seeds)),
            "`seeds` and `training_seeds` overlap: what is tuned on a seed cannot be judged by it"
        );
        Ok(())
    }
}

/// Refuses a list that is empty, or names something twice.
fn distinct<'a>(key: &str, names: impl Iterator<Item = &'a String>) -> Result<()> {
    let mut seen = BTreeSet::new();
    for name in names {
        ensure!(seen.insert(name), "`{key}` names `{name}` twice");
    }
    ensure!(!seen.is_empty(), "`{key}` is empty");
    Ok(())
}
