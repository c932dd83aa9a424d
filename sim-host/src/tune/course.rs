//! A course: the flights and weights by which a controller is judged while it is tuned.

use anyhow::{Context, Result, bail, ensure};
use serde::{Deserialize, Serialize};

use super::COURSES;
use crate::controller::Controller;
use crate::files;
use crate::flight;
use crate::matrix::{Case, Matrix};
use crate::parallel;
use crate::record::{LOST_M, Recorder, Row};
use crate::refusal::did_you_mean;
use crate::report::measures::Size;
use crate::report::metrics::errors;
use crate::scenario::Scenario;
use crate::score::{Score, Scorer, counts_from_s};
use crate::seeds::Seeds;

/// A course file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct CourseFile {
    /// Description, in one line.
    summary: String,
    /// Name or path of the matrix whose flights are flown.
    matrix: String,
    /// Selected scenarios; by default all.
    scenarios: Option<Vec<String>>,
    /// Selected disturbances; by default all.
    disturbances: Option<Vec<String>>,
    /// Seeds; by default the matrix' training seeds.
    seeds: Option<Seeds>,
    /// What counts.
    cost: Weights,
}

/// The weights of a flight's cost. The cost of a controller is the mean over its flights, so that with logarithms of
/// the errors a controller that halves one flight's error gains as much as one that halves another's, whatever their
/// sizes.
///
/// A flight that is survived costs
///
/// ```text
/// rms ln(RMS + floor) + yaw ln(yaw RMS + floor) + settling S/T + chattering ln(1 + v) + saturation σ
/// ```
///
/// with the distance from the trajectory in m and the heading's error in rad, S the time until the
/// distance stays within 5 cm, T the time that counts, v the total variation of the commanded ω² per second in units of
/// Σω² in hover, σ the saturated part of the flight. A flight that is lost costs `lost (2 − t/D)`, t the time flown of
/// the whole D: the later, the better.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Weights {
    /// Of the distance's RMS: 1 makes the cost of accuracy the logarithm of its geometric mean.
    pub rms: f64,
    /// Errors far below it are as good as none, m and rad.
    pub floor: f64,
    /// Of the heading's RMS.
    pub yaw: f64,
    /// Of the time to settle.
    pub settling: f64,
    /// Of chattering.
    pub chattering: f64,
    /// Of saturation.
    pub saturation: f64,
    /// Of a lost flight; above everything that a survived one can cost.
    pub lost: f64,
}

impl Weights {
    /// Checks the weights, and that a lost flight costs more than any survived one.
    fn validate(&self) -> Result<()> {
        for (key, weight) in [
            ("rms", self.rms),
            ("yaw", self.yaw),
            ("settling", self.settling),
            ("chattering", self.chattering),
            ("saturation", self.saturation),
            ("lost", self.lost),
        ] {
            ensure!(weight.is_finite() && weight >= 0.0, "`cost.{key}` must be a number not below 0, not {weight}");
        }
        ensure!((1e-6..=1.0).contains(&self.floor), "`cost.floor` must be between 1e-6 and 1, not {}", self.floor);
        let most = self.survived_max();
        ensure!(
            self.lost > most,
            "`cost.lost` must be above {most:.2}, what the other weights can make of a survived flight, not {}",
            self.lost
        );
        Ok(())
    }

    /// The most that a survived flight can cost: as far away as a vehicle gets before it is lost (a heading is never as
    /// wrong in rad), never settled, always saturated, and worse chattering than any rotor's.
    fn survived_max(&self) -> f64 {
        const VARIATION_MAX: f64 = 1e9;
        (self.rms + self.yaw) * libm::log(LOST_M * 3.0_f64.sqrt() + self.floor)
            + self.settling
            + self.saturation
            + self.chattering * libm::log1p(VARIATION_MAX)
    }

    /// Cost of gains that the controller refuses.
    pub fn refused(&self) -> f64 {
        2.0 * self.lost
    }

    fn of(&self, score: &Score, yaw_rms_rad: f64, timing: &Timing) -> f64 {
        let Some(rms_m) = score.rms_m.filter(|_| score.survived) else {
            return self.lost * (2.0 - score.flown_s / timing.duration_s);
        };
        let log = |error: f64| libm::log(error + self.floor);
        let counted_s = timing.duration_s - timing.from_s;
        let variation = score.chattering_rad2_s3.unwrap_or(0.0) / timing.hover_rad2_s2;
        let cost = self.rms * log(rms_m)
            + self.yaw * log(yaw_rms_rad)
            + self.settling * score.settle_s.map_or(1.0, |settle_s| settle_s / counted_s)
            + self.chattering * libm::log1p(variation)
            + self.saturation * score.saturated_fraction;
        // A search cannot rank NaN.
        if cost.is_finite() { cost.min(self.lost) } else { self.lost }
    }
}

/// Normalisation of a flight's figures.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Timing {
    /// Longest flight, s.
    duration_s: f64,
    /// Start of the judged time, s.
    from_s: f64,
    /// Σω² in hover, (rad/s)².
    hover_rad2_s2: f64,
}

impl Timing {
    fn of(scenario: &Scenario) -> Self {
        let airframe = &scenario.airframe;
        let lift_n_s2 = airframe.rotors.iter().map(|rotor| rotor.lift_n_s2).sum::<f64>() / airframe.rotors.len() as f64;
        Self {
            duration_s: scenario.file.duration_s,
            from_s: counts_from_s(scenario),
            hover_rad2_s2: airframe.mass_kg * airframe.gravity_m_s2 / lift_n_s2,
        }
    }
}

/// The heading's error.
struct Heading {
    from_s: f64,
    error: Size,
}

impl Recorder for Heading {
    fn record(&mut self, row: &Row) {
        if row.t >= self.from_s && !row.reference_is_held {
            self.error.take(errors(row)[3]);
        }
    }
}

/// A flight of a course.
#[derive(Clone, Debug, PartialEq)]
struct Sortie {
    case: Case,
    seed: u64,
}

impl Sortie {
    fn cost(&self, controller: &Controller, weights: &Weights) -> Result<f64> {
        let scenario = self.case.scenario.clone().flown_by(controller.clone())?;
        let timing = Timing::of(&scenario);
        let heading = Heading { from_s: timing.from_s, error: Size::default() };
        let mut recorder = (Scorer::new(&scenario), heading);
        let outcome = flight::fly(&scenario, self.seed, &mut recorder)?;
        let (scorer, heading) = recorder;
        let yaw_rms_rad = heading.error.rms().unwrap_or(core::f64::consts::PI);
        Ok(weights.of(&scorer.score(&outcome), yaw_rms_rad, &timing))
    }
}

/// Flights and weights.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// Its name, or the path of its file.
    pub name: String,
    /// What counts.
    pub weights: Weights,
    sorties: Vec<Sortie>,
}

impl Course {
    /// Loads a built-in course by name or a file by path.
    ///
    /// # Errors
    /// One line with the file, the key and the error: a scenario or a disturbance that the matrix does not have, or a
    /// seed that it judges with.
    pub fn load(name: &str) -> Result<Self> {
        let mut file: CourseFile = files::read(name, "course", &COURSES)?;
        file.matrix = files::beside(name, &file.matrix);
        let context = || format!("course `{name}`");
        file.cost.validate().with_context(context)?;
        let sorties = file.sorties().with_context(context)?;
        Ok(Self { name: name.to_owned(), weights: file.cost, sorties })
    }

    /// Number of flights.
    pub fn flights(&self) -> usize {
        self.sorties.len()
    }

    /// Cost of a controller: the mean over the flights, flown on the threads of the pool in which it is called.
    pub fn cost(&self, controller: &Controller) -> f64 {
        let cost = |sortie: &Sortie| sortie.cost(controller, &self.weights).unwrap_or(self.weights.refused());
        let costs = parallel::map(&self.sorties, cost);
        // Summed in the order of the flights, whichever thread flew them.
        costs.iter().sum::<f64>() / costs.len() as f64
    }

    /// Checks that a controller can fly the course.
    ///
    /// # Errors
    /// The scenario, and what of the controller the firmware refuses.
    pub fn require_flyable(&self, controller: &Controller) -> Result<()> {
        self.sorties.iter().try_for_each(|sortie| sortie.case.scenario.clone().flown_by(controller.clone()).map(drop))
    }
}

impl CourseFile {
    fn sorties(&self) -> Result<Vec<Sortie>> {
        let matrix = Matrix::load(&self.matrix, &[])?;
        let Some(seeds) = self.seeds.or(matrix.file.training_seeds) else {
            bail!("`seeds` is missing, and matrix `{}` has no `training_seeds`", self.matrix)
        };
        ensure!(
            !seeds.overlaps(matrix.file.seeds),
            "`seeds` {} overlap those with which matrix `{}` judges, {}: what is tuned on a seed cannot be judged by it",
            String::from(seeds),
            self.matrix,
            String::from(matrix.file.seeds)
        );
        let disturbances: Vec<&str> = matrix.file.disturbances.iter().map(|entry| entry.name.as_str()).collect();
        let scenarios: Vec<&str> = matrix.file.scenarios.iter().map(String::as_str).collect();
        known("scenarios", self.scenarios.as_deref(), &scenarios, &self.matrix)?;
        known("disturbances", self.disturbances.as_deref(), &disturbances, &self.matrix)?;
        let chosen =
            |names: &Option<Vec<String>>, name: &String| names.as_ref().is_none_or(|names| names.contains(name));
        let mut cases = matrix.cases()?;
        cases.retain(|case| {
            chosen(&self.scenarios, &case.scenario_name) && chosen(&self.disturbances, &case.disturbance_name)
        });
        let sorties: Vec<Sortie> =
            cases.iter().flat_map(|case| case.seeds(seeds).map(|seed| Sortie { case: case.clone(), seed })).collect();
        ensure!(!sorties.is_empty(), "`scenarios` and `disturbances` leave no flight of matrix `{}`", self.matrix);
        Ok(sorties)
    }
}

/// Checks the names in a selection.
fn known(key: &str, filter: Option<&[String]>, names: &[&str], matrix: &str) -> Result<()> {
    for name in filter.unwrap_or_default() {
        ensure!(
            names.contains(&name.as_str()),
            "`{key}` names `{name}`, which matrix `{matrix}` does not have: {}",
            did_you_mean(name, names)
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const WEIGHTS: Weights =
        Weights { rms: 1.0, floor: 1e-3, yaw: 0.0, settling: 0.0, chattering: 0.0, saturation: 0.0, lost: 10.0 };
    const TIMING: Timing = Timing { duration_s: 10.0, from_s: 1.0, hover_rad2_s2: 4e5 };

    fn score(rms_m: f64) -> Score {
        Score { survived: true, flown_s: 10.0, rms_m: Some(rms_m), ..Score::default() }
    }

    #[test]
    fn halving_an_error_gains_the_same_wherever_it_is() {
        let gain = |rms_m: f64| WEIGHTS.of(&score(2.0 * rms_m), 0.0, &TIMING) - WEIGHTS.of(&score(rms_m), 0.0, &TIMING);
        // ln 2 less what the floor takes: at most floor/rms.
        for rms_m in [0.05, 0.5, 5.0] {
            assert!((gain(rms_m) - core::f64::consts::LN_2).abs() < 1e-3 / rms_m, "{rms_m}");
        }
        assert!(gain(1e-5) < 0.02);
    }

    #[test]
    fn the_later_a_flight_is_lost_the_better_and_none_is_better_than_one_that_is_not() {
        let lost = |flown_s: f64| WEIGHTS.of(&Score { flown_s, ..Score::default() }, 0.0, &TIMING);
        assert_eq!([0.0, 5.0, 10.0].map(lost), [20.0, 15.0, 10.0]);
        assert!(WEIGHTS.of(&score(50.0), 0.0, &TIMING) < lost(10.0));
        assert_eq!(WEIGHTS.of(&score(1e300), 0.0, &TIMING), 10.0);
    }

    #[test]
    fn a_loss_that_may_be_cheaper_than_a_survival_is_refused() {
        // ln(50 √3) = 4.46; ln 1e9 = 20.7.
        for (weights, most) in [
            (WEIGHTS, 4.46),
            (Weights { yaw: 1.0, ..WEIGHTS }, 8.92),
            (Weights { settling: 2.0, saturation: 1.0, ..WEIGHTS }, 7.46),
            (Weights { chattering: 0.2, ..WEIGHTS }, 8.61),
        ] {
            assert!(Weights { lost: most + 0.01, ..weights }.validate().is_ok(), "{most}");
            let error = Weights { lost: most - 0.01, ..weights }.validate().expect_err("too cheap").to_string();
            assert!(error.contains("`cost.lost`") && error.contains(&format!("{most}")), "{error}");
        }
    }

    #[test]
    fn each_weight_takes_its_own_figure() {
        let figures = Score {
            settle_s: Some(3.0),
            chattering_rad2_s3: Some(4e5 * (core::f64::consts::E - 1.0)),
            saturated_fraction: 0.25,
            ..score(1.0 - 1e-3)
        };
        let cost = |weights: Weights| weights.of(&figures, 1.0 - 1e-3, &TIMING);
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
        near(cost(WEIGHTS), 0.0);
        near(cost(Weights { yaw: 3.0, ..WEIGHTS }), 0.0);
        near(cost(Weights { settling: 3.0, ..WEIGHTS }), 1.0);
        near(cost(Weights { chattering: 0.5, ..WEIGHTS }), 0.5);
        near(cost(Weights { saturation: 2.0, ..WEIGHTS }), 0.5);
    }

    #[test]
    fn gains_that_are_refused_cost_more_than_any_flight() {
        let Controller::Smc(mut control) = crate::scenario::tuning("x500-smc").expect("built in").controller else {
            panic!("another controller")
        };
        control.x.lambda = -1.0;
        let controller = Controller::Smc(control);
        let course = Course::load("x500").expect("valid");
        assert_eq!(course.cost(&controller), course.weights.refused());
        assert!(course.require_flyable(&controller).is_err());
    }

    #[test]
    fn the_built_in_course_judges_by_no_seed_that_the_matrix_judges_by() {
        let course = Course::load("x500").expect("valid");
        let matrix = Matrix::load("x500", &[]).expect("valid");
        let judges = |seed: u64| (matrix.file.seeds.first..=matrix.file.seeds.last).contains(&seed);
        assert!(course.sorties.iter().all(|sortie| !judges(sortie.seed)));
    }
}
