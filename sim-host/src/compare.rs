//! Controllers compared: each in every cell of a matrix, under the same seeds.

use anyhow::{Result, ensure};
use rayon::iter::{IntoParallelRefIterator as _, ParallelIterator as _};
use serde::ser::{Serialize, SerializeMap as _, Serializer};

use crate::controller::Controller;
use crate::matrix::{Case, Matrix};
use crate::scenario;
use crate::score::{self, Score};
use crate::seeds::Seeds;
use crate::statistics::Estimate;

/// A figure of merit. Less is better in each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Figure {
    /// RMS of the distance from the trajectory, m.
    Rms,
    /// Greatest distance, m.
    Max,
    /// Time until it stays below 5 cm, s.
    Settle,
    /// Greatest error of the attitude, rad.
    Attitude,
    /// Altitude lost, m.
    Altitude,
    /// RMS torque demanded, N m.
    Torque,
    /// Mean ω², (rad/s)².
    Omega,
    /// Total variation of the commanded ω² a second, (rad/s)²/s.
    Chattering,
    /// Fraction of the ticks in which the mixer could not give the whole demand.
    Saturated,
}

impl Figure {
    /// All of them, in the order of their columns.
    pub const ALL: [Self; 9] = [
        Self::Rms,
        Self::Max,
        Self::Settle,
        Self::Attitude,
        Self::Altitude,
        Self::Torque,
        Self::Omega,
        Self::Chattering,
        Self::Saturated,
    ];

    /// Its key in JSON and its column in CSV.
    pub fn key(self) -> &'static str {
        match self {
            Self::Rms => "rms_m",
            Self::Max => "max_m",
            Self::Settle => "settle_s",
            Self::Attitude => "attitude_max_rad",
            Self::Altitude => "altitude_lost_m",
            Self::Torque => "torque_rms_n_m",
            Self::Omega => "omega_squared_mean_rad2_s2",
            Self::Chattering => "chattering_rad2_s3",
            Self::Saturated => "saturated_fraction",
        }
    }

    /// Of a flight; `None` if it has none, as a lost one has not.
    pub fn of(self, score: &Score) -> Option<f64> {
        match self {
            Self::Rms => score.rms_m,
            Self::Max => score.max_m,
            Self::Settle => score.settle_s,
            Self::Attitude => score.attitude_max_rad,
            Self::Altitude => score.altitude_lost_m,
            Self::Torque => score.torque_rms_n_m,
            Self::Omega => score.omega_squared_mean_rad2_s2,
            Self::Chattering => score.chattering_rad2_s3,
            Self::Saturated => score.survived.then_some(score.saturated_fraction),
        }
    }
}

/// A median a figure, with how many flights survived.
#[derive(Clone, Debug, PartialEq)]
pub struct Medians {
    /// Flights.
    pub flights: usize,
    /// Those whose vehicle was not lost.
    pub survived: usize,
    /// In the order of [`Figure::ALL`].
    estimates: [Estimate; Figure::ALL.len()],
}

impl Medians {
    fn of_flights(flights: &[FlightScore]) -> Self {
        Self {
            flights: flights.len(),
            survived: flights.iter().filter(|flight| flight.score.survived).count(),
            estimates: Figure::ALL.map(|figure| Estimate::of(flights.iter().map(|flight| figure.of(&flight.score)))),
        }
    }

    /// Of the medians of cells, each of the same weight.
    fn of_cells<'a>(cells: impl Iterator<Item = &'a Self> + Clone) -> Self {
        // The cells are no sample of anything: their median has no interval.
        let estimate = |figure| Estimate {
            interval: None,
            ..Estimate::of(cells.clone().map(|cell| Some(cell.estimate(figure).median)))
        };
        Self {
            flights: cells.clone().map(|cell| cell.flights).sum(),
            survived: cells.clone().map(|cell| cell.survived).sum(),
            estimates: Figure::ALL.map(estimate),
        }
    }

    /// The median of a figure.
    pub fn estimate(&self, figure: Figure) -> &Estimate {
        &self.estimates[figure as usize]
    }

    /// The median of the RMS error, m.
    pub fn rms(&self) -> &Estimate {
        self.estimate(Figure::Rms)
    }
}

impl Serialize for Medians {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(2 + Figure::ALL.len()))?;
        map.serialize_entry("flights", &self.flights)?;
        map.serialize_entry("survived", &self.survived)?;
        for figure in Figure::ALL {
            map.serialize_entry(figure.key(), self.estimate(figure))?;
        }
        map.end()
    }
}

/// One flight.
#[derive(Clone, Debug, PartialEq)]
pub struct FlightScore {
    /// Name of the scenario.
    pub scenario: String,
    /// Name of the disturbance.
    pub disturbance: String,
    /// Name of the controller.
    pub controller: String,
    /// Seed of its random numbers.
    pub seed: u64,
    /// How it went.
    pub score: Score,
}

/// How the controllers did in one scenario under one disturbance.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Cell {
    /// Name of the scenario.
    pub scenario: String,
    /// Name of the disturbance.
    pub disturbance: String,
    /// Whether flights under different seeds differ; where they do not, one was flown.
    pub random: bool,
    /// One a controller, in the comparison's order.
    pub controllers: Vec<Medians>,
}

/// A controller over the whole matrix.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Overall {
    /// Its name.
    pub controller: String,
    /// Medians of the cells' medians.
    pub medians: Medians,
    /// Median over the cells of its RMS error over the first controller's; infinite (null) if most are lost.
    pub rms_ratio: f64,
    /// Cells in which its RMS error is less than the first controller's.
    pub better_cells: usize,
    /// Cells in which it is greater.
    pub worse_cells: usize,
}

/// A cell that the first controller loses.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct LostCell {
    /// Name of the scenario.
    pub scenario: String,
    /// Name of the disturbance.
    pub disturbance: String,
    /// The controller that is best there.
    pub to: String,
    /// The first controller's RMS error over the best one's; infinite (null) if its flights are lost.
    pub ratio: f64,
    /// Whether seeds cannot explain it: the intervals are apart, or the cell is not random.
    pub clear: bool,
}

/// What a comparison finds.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Comparison {
    /// Name of the matrix.
    pub matrix: String,
    /// What it compares.
    pub summary: String,
    /// Seeds flown in random cells.
    pub seeds: Seeds,
    /// Whether some of them are seeds that controllers are tuned on.
    pub seeds_are_trained_on: bool,
    /// Names of the controllers; the others are compared with the first.
    pub controllers: Vec<String>,
    /// In the matrix' order.
    pub cells: Vec<Cell>,
    /// One a controller.
    pub overall: Vec<Overall>,
    /// Where another controller has the least RMS error.
    pub lost: Vec<LostCell>,
    /// Every flight, by cell, controller and seed.
    #[serde(skip)]
    pub flights: Vec<FlightScore>,
}

/// A comparison to be flown.
#[derive(Clone, Debug)]
pub struct Contest<'a> {
    matrix: &'a Matrix,
    cases: Vec<Case>,
    controllers: Vec<(String, Controller)>,
}

impl<'a> Contest<'a> {
    /// Loads every scenario and every controller of a matrix.
    ///
    /// # Errors
    /// One line that names the scenario or tuning, the key, and what is wrong with it; or that no cell is left.
    pub fn new(matrix: &'a Matrix) -> Result<Self> {
        let mut controllers: Vec<(String, Controller)> = Vec::new();
        for name in &matrix.file.controllers {
            let controller = scenario::tuning(name)?.controller;
            let short = short_name(name);
            ensure!(!controllers.iter().any(|(known, _)| known == short), "two controllers are called `{short}`");
            controllers.push((short.to_owned(), controller));
        }
        let cases = matrix.cases()?;
        ensure!(!cases.is_empty(), "no disturbance applies to any scenario: nothing to fly");
        Ok(Self { matrix, cases, controllers })
    }

    /// How many flights it takes.
    pub fn flights(&self) -> usize {
        let seeds = |case: &Case| case.seeds(self.matrix.file.seeds).count();
        self.cases.iter().map(seeds).sum::<usize>() * self.controllers.len()
    }

    /// Flies it on the threads of the current pool; `flown` is called after each flight. The result does not depend on
    /// the number of threads.
    ///
    /// # Errors
    /// What of a scenario the firmware refuses.
    pub fn fly(&self, flown: impl Fn() + Sync) -> Result<Comparison> {
        let mut entries = Vec::new();
        for case in &self.cases {
            for (name, controller) in &self.controllers {
                let scenario = case.scenario.clone().flown_by(controller.clone())?;
                entries.extend(case.seeds(self.matrix.file.seeds).map(|seed| (case, name, seed, scenario.clone())));
            }
        }
        let fly = |(case, name, seed, scenario): &(&Case, &String, u64, scenario::Scenario)| {
            let score = score::fly(scenario, *seed)?;
            flown();
            Ok(FlightScore {
                scenario: short_name(&case.scenario_name).to_owned(),
                disturbance: case.disturbance_name.clone(),
                controller: (*name).clone(),
                seed: *seed,
                score,
            })
        };
        Ok(self.judge(entries.par_iter().map(fly).collect::<Result<_>>()?))
    }

    /// The flights, in the order of [`fly`](Self::fly), as a comparison.
    fn judge(&self, flights: Vec<FlightScore>) -> Comparison {
        let file = &self.matrix.file;
        let mut rest = flights.as_slice();
        let mut take = |count| {
            let (taken, left) = rest.split_at(count);
            rest = left;
            Medians::of_flights(taken)
        };
        let cell = |case: &Case| Cell {
            scenario: short_name(&case.scenario_name).to_owned(),
            disturbance: case.disturbance_name.clone(),
            random: case.is_random(),
            controllers: self.controllers.iter().map(|_| take(case.seeds(file.seeds).count())).collect(),
        };
        let cells: Vec<Cell> = self.cases.iter().map(cell).collect();
        let controllers: Vec<String> = self.controllers.iter().map(|(name, _)| name.clone()).collect();
        Comparison {
            matrix: self.matrix.name.clone(),
            summary: file.summary.clone(),
            seeds: file.seeds,
            seeds_are_trained_on: file.training_seeds.is_some_and(|training| training.overlaps(file.seeds)),
            overall: controllers.iter().enumerate().map(|(i, name)| overall(&cells, i, name)).collect(),
            lost: cells.iter().filter_map(|cell| lost(cell, &controllers)).collect(),
            controllers,
            cells,
            flights,
        }
    }
}

/// A built-in name as it is, a path by its file's name.
fn short_name(name: &str) -> &str {
    let file = name.rsplit('/').next().unwrap_or(name);
    file.strip_suffix(".toml").unwrap_or(file)
}

fn overall(cells: &[Cell], index: usize, name: &str) -> Overall {
    let ratios = || cells.iter().map(|cell| cell.rms_ratio(index));
    Overall {
        controller: name.to_owned(),
        medians: Medians::of_cells(cells.iter().map(|cell| &cell.controllers[index])),
        rms_ratio: Estimate::of(ratios().map(Some)).median,
        better_cells: ratios().filter(|ratio| *ratio < 1.0).count(),
        worse_cells: ratios().filter(|ratio| *ratio > 1.0).count(),
    }
}

impl Cell {
    /// The median RMS error of a controller over the first one's.
    pub fn rms_ratio(&self, index: usize) -> f64 {
        ratio(self.controllers[index].rms().median, self.controllers[0].rms().median)
    }
}

/// `a` over `b`; 1 where both are the same, also if both are infinite or 0.
fn ratio(a: f64, b: f64) -> f64 {
    if a.total_cmp(&b).is_eq() { 1.0 } else { a / b }
}

/// The cell as one that the first controller loses, if it does.
fn lost(cell: &Cell, names: &[String]) -> Option<LostCell> {
    let first = cell.controllers[0].rms();
    let others = cell.controllers.iter().zip(names).skip(1);
    let (best, to) = others.min_by(|(a, _), (b, _)| a.rms().median.total_cmp(&b.rms().median))?;
    let apart = match (first.interval, best.rms().interval) {
        (Some((low, _)), Some((_, high))) => low > high,
        _ => !cell.random,
    };
    (best.rms().median < first.median).then(|| LostCell {
        scenario: cell.scenario.clone(),
        disturbance: cell.disturbance.clone(),
        to: to.clone(),
        ratio: ratio(first.median, best.rms().median),
        clear: apart,
    })
}
