//! A matrix of flights: scenarios, disturbances, controllers, seeds. Built into the binary, or read from a file.

mod files;

use std::collections::BTreeSet;

use anyhow::{Context, Result, anyhow, ensure};
use serde::{Deserialize, Serialize};

use crate::controller::Controller;
use crate::files::beside;
use crate::refusal::did_you_mean;
use crate::scenario::{Scenario, is_of_controller, is_within, tuning, with_files};
use crate::score::counts_from_s;
use crate::seeds::Seeds;

pub use self::files::{KEPT, short_name};

/// Why a gain cannot be set; what names the tunings follows.
const OWN_GAINS: &str = "a comparison flies the gains of its tunings: write a tuning file and name it in";

/// Matrices built into the binary.
pub(crate) const MATRICES: [(&str, &str); 1] = glissade_files::built_in!("matrices": "x500");

/// A disturbance, as settings of a scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DisturbanceEntry {
    /// Its name.
    pub name: String,
    /// `KEY=VALUE`, as `--set` takes them.
    #[serde(default)]
    pub set: Vec<String>,
    /// The scenarios that it disturbs; all if absent.
    pub scenarios: Option<Vec<String>>,
    /// Scenarios that are left out.
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
    /// The purpose of the comparison, in one line.
    #[serde(default)]
    pub summary: String,
    /// Names or paths of tuning files; the others are compared with the first.
    pub controllers: Vec<String>,
    /// Names or paths of scenarios.
    pub scenarios: Vec<String>,
    /// `KEY=VALUE` settings of every scenario, before those of the disturbances.
    #[serde(default)]
    pub set: Vec<String>,
    /// The disturbances.
    pub disturbances: Vec<DisturbanceEntry>,
    /// Seeds of the comparison.
    pub seeds: Seeds,
    /// Seeds of tuning; a comparison on any of them says so.
    pub training_seeds: Option<Seeds>,
}

/// A matrix that can be flown.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    /// Its name, or the path of its file.
    pub name: String,
    /// Its contents.
    pub file: MatrixFile,
    /// Its cells before some were selected.
    whole: usize,
}

/// A cell of a matrix: a scenario under a disturbance. [`Scenario::flown_by`] sets its controller.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// With the disturbance's settings, and the controller that its file names.
    pub scenario: Scenario,
    /// Its name in the matrix.
    pub scenario_name: String,
    /// Name of the disturbance.
    pub disturbance_name: String,
}

impl Case {
    /// Whether flights under different seeds differ.
    pub fn is_random(&self) -> bool {
        self.scenario.file.is_random()
    }

    /// The seeds to fly: all of `seeds` if flights under them differ, otherwise the first.
    pub fn seeds(&self, seeds: Seeds) -> impl Iterator<Item = u64> {
        let last = if self.is_random() { seeds.last } else { seeds.first };
        seeds.first..=last
    }
}

impl Matrix {
    /// Loads a built-in matrix by name or a file by path. `settings` (`KEY=VALUE`) are applied to each scenario.
    ///
    /// # Errors
    /// One line with the matrix or file, the key and the error; also if a setting is a gain.
    pub fn load(name: &str, settings: &[String]) -> Result<Self> {
        no_gains(settings).map_err(|setting| anyhow!("--set {setting}: {OWN_GAINS} --controllers"))?;
        let mut file: MatrixFile = crate::files::read(name, "matrix", &MATRICES)?;
        for controller in &mut file.controllers {
            *controller = beside(name, controller);
        }
        file.validate().with_context(|| format!("matrix `{name}`"))?;
        for setting in file.settings_mut() {
            *setting = with_files(setting, |_, path| Ok(beside(name, path)))?;
        }
        file.set.extend_from_slice(settings);
        let whole = file.cells().count();
        Ok(Self { name: name.to_owned(), file, whole })
    }

    /// `KEY=VALUE` settings of every scenario.
    pub fn settings(&self) -> &[String] {
        &self.file.set
    }

    /// The number of its cells before some were selected.
    pub fn whole(&self) -> usize {
        self.whole
    }

    /// Keeps only the named scenarios and disturbances; `None` keeps all.
    ///
    /// # Errors
    /// One line with the first name that the matrix does not have.
    pub fn select(&mut self, scenarios: Option<&[String]>, disturbances: Option<&[String]>) -> Result<()> {
        if let Some(names) = scenarios {
            let names = &self.file.in_full(names);
            known(names, self.file.scenarios.iter(), "scenario", &self.name)?;
            self.file.keep_scenarios(names);
        }
        if let Some(names) = disturbances {
            let all = self.file.disturbances.iter().map(|disturbance| &disturbance.name);
            known(names, all, "disturbance", &self.name)?;
            self.file.disturbances.retain(|disturbance| names.contains(&disturbance.name));
        }
        Ok(())
    }

    /// Its cells, scenario by scenario, with the disturbances that apply to each.
    ///
    /// # Errors
    /// One line with the disturbance, the scenario, the key and the error; also if a flight ends before its evaluated
    /// interval begins.
    pub fn cases(&self) -> Result<Vec<Case>> {
        let fallback = self.fallback()?;
        self.file.cells().map(|(scenario, disturbance)| self.case(scenario, disturbance, &fallback)).collect()
    }

    /// The settings for every scenario that a disturbance replaces by its own, each with the disturbance's name.
    pub fn replaced(&self) -> Vec<(&str, &str)> {
        let key = |setting: &str| setting.split('=').next().unwrap_or(setting).trim().to_owned();
        let by = |setting: &String, entry: &DisturbanceEntry| {
            entry.set.iter().any(|own| is_within(&key(setting), &key(own)))
        };
        let pairs = self.file.set.iter().flat_map(|set| self.file.disturbances.iter().map(move |entry| (set, entry)));
        pairs.filter(|(set, entry)| by(set, entry)).map(|(set, entry)| (set.as_str(), entry.name.as_str())).collect()
    }

    /// What flies a scenario that brings no gains until a controller is set: the first.
    fn fallback(&self) -> Result<Controller> {
        let first = self.file.controllers.first().context("`controllers` is empty: name one at least")?;
        Ok(tuning(first)?.controller)
    }

    fn case(&self, scenario: &str, disturbance: &DisturbanceEntry, fallback: &Controller) -> Result<Case> {
        let settings = [self.file.set.as_slice(), &disturbance.set].concat();
        let context = || format!("matrix `{}`, disturbance `{}`", self.name, disturbance.name);
        let loaded = Scenario::load_for(&beside(&self.name, scenario), &settings, fallback).with_context(context)?;
        require_counted(&loaded).with_context(context)?;
        Ok(Case { scenario: loaded, scenario_name: scenario.to_owned(), disturbance_name: disturbance.name.clone() })
    }
}

impl MatrixFile {
    /// Scenario by scenario, with the disturbances that apply to each.
    fn cells(&self) -> impl Iterator<Item = (&String, &DisturbanceEntry)> {
        self.scenarios.iter().flat_map(|scenario| {
            let applies = |disturbance: &&DisturbanceEntry| disturbance.applies_to(scenario);
            self.disturbances.iter().filter(applies).map(move |disturbance| (scenario, disturbance))
        })
    }

    /// All settings, of every scenario and of each disturbance.
    fn settings_mut(&mut self) -> impl Iterator<Item = &mut String> {
        self.disturbances.iter_mut().flat_map(|disturbance| &mut disturbance.set).chain(&mut self.set)
    }

    /// Its scenarios by the names that they are listed by, of these or of [`short_name`]s.
    fn in_full(&self, names: &[String]) -> Vec<String> {
        let full = |name: &String| {
            let by_short_name = || self.scenarios.iter().find(|scenario| short_name(scenario) == name);
            self.scenarios.iter().find(|scenario| *scenario == name).or_else(by_short_name).unwrap_or(name).clone()
        };
        names.iter().map(full).collect()
    }

    /// Keeps only some scenarios, here and where disturbances name them, so that what is left is a matrix too.
    fn keep_scenarios(&mut self, names: &[String]) {
        let keep = |scenarios: &mut Vec<String>| scenarios.retain(|scenario| names.contains(scenario));
        keep(&mut self.scenarios);
        for disturbance in &mut self.disturbances {
            disturbance.scenarios.iter_mut().for_each(keep);
            keep(&mut disturbance.except);
        }
    }

    fn validate(&self) -> Result<()> {
        distinct("controllers", self.controllers.iter())?;
        distinct("scenarios", self.scenarios.iter())?;
        no_gains(&self.set).map_err(|setting| anyhow!("`set` has {setting}: {OWN_GAINS} `controllers`"))?;
        distinct("disturbances", self.disturbances.iter().map(|disturbance| &disturbance.name))?;
        for disturbance in &self.disturbances {
            let key = &disturbance.name;
            no_gains(&disturbance.set)
                .map_err(|setting| anyhow!("disturbance `{key}`: `set` has {setting}: {OWN_GAINS} `controllers`"))?;
            for name in disturbance.scenarios.iter().flatten().chain(&disturbance.except) {
                ensure!(
                    self.scenarios.contains(name),
                    "disturbance `{key}` names `{name}`, which `scenarios` does not"
                );
            }
        }
        Ok(())
    }
}

/// Finds a setting of the controller, which each controller of the comparison would replace.
fn no_gains(settings: &[String]) -> Result<(), &String> {
    settings.iter().find(|setting| is_of_controller(setting)).map_or(Ok(()), Err)
}

/// Refuses a flight that ends before its evaluated interval begins.
fn require_counted(scenario: &Scenario) -> Result<()> {
    let (from_s, duration_s) = (counts_from_s(scenario), scenario.file.duration_s);
    ensure!(
        from_s < duration_s,
        "scenario `{}`: `duration_s` is {duration_s}, but the flight is evaluated from {from_s} s on (`join.duration_s`, or \
         a step's `at_s`): make it longer",
        scenario.name
    );
    Ok(())
}

/// Refuses an empty list, and one with a name twice.
fn distinct<'a>(key: &str, names: impl Iterator<Item = &'a String>) -> Result<()> {
    let mut seen = BTreeSet::new();
    for name in names {
        ensure!(seen.insert(name), "`{key}` names `{name}` twice");
    }
    ensure!(!seen.is_empty(), "`{key}` is empty: name one at least");
    Ok(())
}

/// Refuses a name that is not among `all`.
fn known<'a>(names: &[String], all: impl Iterator<Item = &'a String>, kind: &str, matrix: &str) -> Result<()> {
    let all: Vec<&str> = all.map(String::as_str).collect();
    for name in names {
        ensure!(all.contains(&name.as_str()), "matrix `{matrix}` has no {kind} `{name}`: {}", did_you_mean(name, &all));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_built_in_matrix_loads_with_all_its_scenarios() {
        for (name, _) in MATRICES {
            let matrix = Matrix::load(name, &[]).expect("valid");
            let cases = matrix.cases().expect("valid");
            assert_eq!(cases.len(), matrix.file.scenarios.len() * matrix.file.disturbances.len());
        }
    }

    #[test]
    fn disturbances_change_the_plant_and_not_the_firmwares_model() {
        let cases = Matrix::load("x500", &[]).and_then(|matrix| matrix.cases()).expect("valid");
        let case = |name: &str| cases.iter().find(|case| case.disturbance_name == name).expect("there");
        let (calm, heavy) = (&case("none").scenario, &case("mass+30").scenario);
        assert!((heavy.constants().mass / calm.constants().mass - 1.3).abs() < 1e-12);
        assert_eq!(heavy.flight_config(), calm.flight_config());
        assert_eq!(case("delay-4ms").scenario.actuation_delay_ticks(), 4);
        assert_eq!(case("lag-50ms").scenario.constants().rotor_lag, 0.05);
        let believed = f64::from(case("lag-50ms").scenario.flight_config().airframe.rotor_lag_s);
        assert!((believed - 0.02).abs() < 1e-6, "{believed}");
    }

    #[test]
    fn several_seeds_are_flown_where_flights_differ() {
        let matrix = Matrix::load("x500", &[]).expect("valid");
        for case in matrix.cases().expect("valid") {
            let random = case.scenario_name == "x500-recovery"
                || case.disturbance_name.starts_with("dryden")
                || case.disturbance_name == "gaussian";
            assert_eq!(case.is_random(), random, "{} {}", case.scenario_name, case.disturbance_name);
            let flown = if random { matrix.file.seeds.count() } else { 1 };
            assert_eq!(case.seeds(matrix.file.seeds).count() as u64, flown);
        }
    }

    #[test]
    fn a_flight_that_ends_before_its_evaluated_interval_is_refused() {
        // The step is at 1 s.
        let refusal = |setting: &str| {
            let mut matrix = Matrix::load("x500", &[setting.to_owned()]).expect("valid");
            matrix.select(Some(&["x500-step".to_owned()]), None).expect("known");
            matrix.cases().err().map(|error| format!("{error:#}"))
        };
        let error = refusal("duration_s=1").expect("must be refused");
        assert!(error.contains("`duration_s`") && error.contains("x500-step") && !error.contains('\n'), "{error}");
        assert_eq!(refusal("duration_s=1.1"), None);
    }

    #[test]
    fn what_is_selected_of_a_matrix_is_a_matrix() {
        let mut matrix = Matrix::load("x500", &[]).expect("valid");
        let step = || vec!["x500-step".to_owned()];
        (matrix.file.disturbances[0].scenarios, matrix.file.disturbances[1].except) = (Some(step()), step());
        matrix.select(Some(&["x500-hover".to_owned()]), None).expect("known");
        let text = toml::to_string(&matrix.file).expect("TOML");
        let again: MatrixFile = toml::from_str(&text).expect("a matrix");
        again.validate().expect("valid");
        assert_eq!(again, matrix.file);
        assert_eq!(matrix.cases().expect("valid").len(), matrix.file.disturbances.len() - 1);
    }

    #[test]
    fn a_scenario_by_its_path_is_selected_by_its_short_name_too() {
        for name in ["square", "./mine/square.toml"] {
            let mut matrix = Matrix::load("x500", &[]).expect("valid");
            matrix.file.scenarios.push("./mine/square.toml".to_owned());
            matrix.select(Some(&[name.to_owned()]), None).expect("known");
            assert_eq!(matrix.file.scenarios, ["./mine/square.toml"], "{name}");
        }
    }

    #[test]
    fn settings_and_filters_reach_the_cells() {
        let mut matrix = Matrix::load("x500", &["duration_s=2".to_owned()]).expect("valid");
        let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        matrix.select(Some(&names(&["x500-step", "x500-hover"])), Some(&names(&["mass-30"]))).expect("known");
        matrix.file.disturbances[0].except = names(&["x500-step"]);
        let cases = matrix.cases().expect("valid");
        assert_eq!(cases.iter().map(|case| case.scenario_name.as_str()).collect::<Vec<_>>(), ["x500-hover"]);
        assert_eq!(cases[0].scenario.file.duration_s, 2.0);
        let error = matrix.select(Some(&names(&["x500-hovr"])), None).expect_err("unknown");
        assert!(error.to_string().contains("x500-hovr"), "{error}");
    }

    #[test]
    fn paths_are_from_the_matrix_own_folder_if_there_is_such_a_file() {
        let folder = std::env::temp_dir().join(format!("glissade-{}-matrix", std::process::id()));
        std::fs::create_dir_all(&folder).expect("the temporary folder can be written");
        let path = folder.join("mine.toml").to_string_lossy().into_owned();
        let text = "summary = \"\"\nseeds = \"1..2\"\ntraining_seeds = \"3..4\"\ncontrollers = [\"x500-smc\", \"./own.toml\"]\n\
                    scenarios = [\"x500-step\"]\n[[disturbances]]\nname = \"none\"\nset = []\n";
        std::fs::write(&path, text).expect("can be written");
        std::fs::write(folder.join("own.toml"), "").expect("can be written");
        let matrix = Matrix::load(&path, &[]).expect("it loads");
        let own = folder.join("./own.toml").to_string_lossy().into_owned();
        assert_eq!(matrix.file.controllers, ["x500-smc".to_owned(), own]);
        assert_eq!(matrix.cases().expect("built in")[0].scenario_name, "x500-step");
        std::fs::remove_dir_all(&folder).expect("it is there");
    }
}
