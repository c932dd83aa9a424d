//! Compares controllers: each flies every cell of a matrix, under the same seeds.

use std::collections::BTreeSet;

use anyhow::{Context as _, Result, ensure};
use serde::ser::{Serialize, SerializeMap as _, Serializer};

use crate::controller::TuningFile;
use crate::matrix::{Case, Matrix, short_name};
use crate::parallel;
use crate::scenario::{self, Scenario};
use crate::score::{self, Score};
use crate::seeds::Seeds;
use crate::statistics::Estimate;

/// Errors below this are taken as equal, m: no vehicle's position is known to 10 µm, and the error of an undisturbed
/// flight is rounding of f32.
pub const RESOLUTION_M: f64 = 1e-5;

/// A figure of merit; less is better.
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
    /// Total variation of the commanded ω² per second, (rad/s)²/s.
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

    /// Its value for a flight; `None` if undefined, as for a lost flight.
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

/// The median of each figure, and how many flights survived.
#[derive(Clone, Debug, PartialEq)]
pub struct Medians {
    /// Flights.
    pub flights: usize,
    /// Flights whose vehicle survived.
    pub survived: usize,
    /// In the order of [`Figure::ALL`].
    estimates: [Estimate; Figure::ALL.len()],
}

impl Medians {
    /// Over the flights of one controller in one cell.
    pub(crate) fn of_flights(flights: &[FlightScore]) -> Self {
        Self {
            flights: flights.len(),
            survived: flights.iter().filter(|flight| flight.score.survived).count(),
            estimates: Figure::ALL.map(|figure| Estimate::of(flights.iter().map(|flight| figure.of(&flight.score)))),
        }
    }

    /// Over the medians of cells, equally weighted.
    fn of_cells(cells: &[&Self]) -> Self {
        // The cells are chosen, not drawn at random: their median has no confidence interval.
        let estimate = |figure| Estimate {
            interval: None,
            ..Estimate::of(cells.iter().map(|cell| Some(cell.estimate(figure).median)))
        };
        Self {
            flights: cells.iter().map(|cell| cell.flights).sum(),
            survived: cells.iter().map(|cell| cell.survived).sum(),
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
    /// Its figures.
    pub score: Score,
}

/// The controllers' results in one scenario under one disturbance.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Cell {
    /// Name of the scenario.
    pub scenario: String,
    /// Name of the disturbance.
    pub disturbance: String,
    /// Whether flights under different seeds differ; otherwise one was flown.
    pub random: bool,
    /// Per controller, in the comparison's order.
    pub controllers: Vec<Medians>,
    /// RMS error divided by the first controller's under the same seed, per controller: the median over the seeds. The
    /// pairing removes what a seed does to both flights, so that it resolves smaller differences than two medians.
    pub rms_ratios: Vec<Estimate>,
}

/// A controller's results over all cells flown.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Overall {
    /// Its name.
    pub controller: String,
    /// Medians of the cells' medians.
    pub medians: Medians,
    /// Median over the cells of [`Cell::rms_ratios`]; infinite (null) if most are lost.
    pub rms_ratio: f64,
    /// Cells in which that ratio is less than 1.
    pub better_cells: usize,
    /// Cells in which it is greater.
    pub worse_cells: usize,
}

/// A cell in which another controller has a smaller RMS error than the first.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct LostCell {
    /// Name of the scenario.
    pub scenario: String,
    /// Name of the disturbance.
    pub disturbance: String,
    /// The best controller there.
    pub to: String,
    /// Its RMS error divided by the first controller's: below 1; 0 if the first controller's flights are lost.
    pub rms_ratio: Estimate,
    /// Whether the difference is significant: the ratio's interval is below 1, or the cell is not random.
    pub clear: bool,
}

/// Result of a comparison.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Comparison {
    /// Name of the matrix.
    pub matrix: String,
    /// Its purpose, in one line.
    pub summary: String,
    /// Cells of the whole matrix, of which some may have been selected.
    pub matrix_cells: usize,
    /// `KEY=VALUE` settings of every scenario.
    pub set: Vec<String>,
    /// Seeds flown in random cells.
    pub seeds: Seeds,
    /// Whether they overlap the seeds of tuning.
    pub seeds_are_trained_on: bool,
    /// Names of the controllers; the others are compared with the first.
    pub controllers: Vec<String>,
    /// In the matrix's order.
    pub cells: Vec<Cell>,
    /// Per controller.
    pub overall: Vec<Overall>,
    /// Cells in which another controller has the least RMS error.
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
    tunings: Vec<(String, TuningFile)>,
}

impl<'a> Contest<'a> {
    /// Loads every scenario and every controller of a matrix.
    ///
    /// # Errors
    /// One line with the scenario or tuning, the key and the error; also if two scenarios or two controllers share a
    /// name, or no cell is left.
    pub fn new(matrix: &'a Matrix) -> Result<Self> {
        require_told_apart("controllers", &matrix.file.controllers)?;
        require_told_apart("scenarios", &matrix.file.scenarios)?;
        let load = |name: &String| Ok((short_name(name).to_owned(), scenario::tuning(name)?));
        let tunings = matrix.file.controllers.iter().map(load).collect::<Result<_>>()?;
        let cases = matrix.cases()?;
        ensure!(!cases.is_empty(), "no disturbance applies to any scenario: nothing to fly");
        Ok(Self { matrix, cases, tunings })
    }

    /// Its controllers, by the names that they have in tables.
    pub fn tunings(&self) -> &[(String, TuningFile)] {
        &self.tunings
    }

    /// Its cells, in the order in which they are flown.
    pub fn cases(&self) -> &[Case] {
        &self.cases
    }

    /// The number of flights.
    pub fn flights(&self) -> usize {
        let seeds = |case: &Case| case.seeds(self.matrix.file.seeds).count();
        self.cases.iter().map(seeds).sum::<usize>() * self.tunings.len()
    }

    /// Flies all of them on the threads of the current pool; `flown` is called after each flight. The result does not
    /// depend on the number of threads.
    ///
    /// # Errors
    /// The firmware refuses the configuration of a scenario.
    pub fn fly(&self, flown: impl Fn() + Sync) -> Result<Comparison> {
        let mut entries: Vec<(&Case, &str, Scenario)> = Vec::new();
        for case in &self.cases {
            for (name, tuning) in &self.tunings {
                entries.push((case, name, flown_by(case, name, tuning)?));
            }
        }
        let seeds = self.matrix.file.seeds;
        let sorties: Vec<_> =
            entries.iter().flat_map(|entry| entry.0.seeds(seeds).map(move |seed| (entry, seed))).collect();
        let fly = |((case, name, scenario), seed): &(&(&Case, &str, Scenario), u64)| {
            let score = score::fly(scenario, *seed)?;
            flown();
            Ok(FlightScore {
                scenario: short_name(&case.scenario_name).to_owned(),
                disturbance: case.disturbance_name.clone(),
                controller: (*name).to_owned(),
                seed: *seed,
                score,
            })
        };
        Ok(self.judge(parallel::try_map(&sorties, fly)?))
    }

    /// Evaluates the flights, which are in the order of [`fly`](Self::fly).
    fn judge(&self, flights: Vec<FlightScore>) -> Comparison {
        let file = &self.matrix.file;
        let mut rest = flights.as_slice();
        let cell = |case: &Case| {
            let seeds = case.seeds(file.seeds).count();
            let (flown, left) = rest.split_at(seeds * self.tunings.len());
            rest = left;
            Cell::of(case, &flown.chunks(seeds).collect::<Vec<_>>())
        };
        let cells: Vec<Cell> = self.cases.iter().map(cell).collect();
        let controllers: Vec<String> = self.tunings.iter().map(|(name, _)| name.clone()).collect();
        Comparison {
            matrix: self.matrix.name.clone(),
            summary: file.summary.clone(),
            matrix_cells: self.matrix.whole(),
            set: self.matrix.settings().to_vec(),
            seeds: file.seeds,
            seeds_are_trained_on: file.training_seeds.is_some_and(|training| training.overlaps(file.seeds)),
            overall: controllers.iter().enumerate().map(|(i, name)| overall(&cells, i, name)).collect(),
            lost: cells.iter().filter_map(|cell| cell.lost(&controllers)).collect(),
            controllers,
            cells,
            flights,
        }
    }
}

/// A case's scenario under a tuning; what is refused of it is the tuning's.
fn flown_by(case: &Case, name: &str, tuning: &TuningFile) -> Result<Scenario> {
    let flown = case.scenario.clone().flown_by(tuning.controller.clone());
    flown.with_context(|| format!("tuning `{name}`"))
}

/// Refuses paths whose files have the same name: tables and files could not tell them apart.
fn require_told_apart(key: &str, names: &[String]) -> Result<()> {
    let mut seen = BTreeSet::new();
    for name in names {
        let short = short_name(name);
        ensure!(seen.insert(short), "two of `{key}` are called `{short}`: name each once, or rename a file");
    }
    Ok(())
}

fn overall(cells: &[Cell], index: usize, name: &str) -> Overall {
    let ratios = || cells.iter().map(|cell| cell.rms_ratios[index].median);
    let medians = Medians::of_cells(&cells.iter().map(|cell| &cell.controllers[index]).collect::<Vec<_>>());
    // Of two that are lost in most cells neither is as good as the other.
    let is_lost = medians.rms().median.is_infinite();
    Overall {
        controller: name.to_owned(),
        rms_ratio: if is_lost { f64::INFINITY } else { Estimate::of(ratios().map(Some)).median },
        medians,
        better_cells: ratios().filter(|ratio| *ratio < 1.0).count(),
        worse_cells: ratios().filter(|ratio| *ratio > 1.0).count(),
    }
}

impl Cell {
    /// Evaluates the flights of each controller, all under the same seeds.
    fn of(case: &Case, flown: &[&[FlightScore]]) -> Self {
        let paired = |flights: &&[FlightScore]| {
            let pairs = flights.iter().zip(flown[0]);
            Estimate::of(pairs.map(|(flight, first)| Some(ratio(&flight.score, &first.score))))
        };
        Self {
            scenario: short_name(&case.scenario_name).to_owned(),
            disturbance: case.disturbance_name.clone(),
            random: case.is_random(),
            controllers: flown.iter().map(|flights| Medians::of_flights(flights)).collect(),
            rms_ratios: flown.iter().map(paired).collect(),
        }
    }

    /// The cell as a lost one, if another controller has a smaller RMS error than the first.
    fn lost(&self, names: &[String]) -> Option<LostCell> {
        let others = self.rms_ratios.iter().zip(names).skip(1);
        let (best, to) = others.min_by(|(a, _), (b, _)| a.median.total_cmp(&b.median))?;
        (best.median < 1.0).then(|| LostCell {
            scenario: self.scenario.clone(),
            disturbance: self.disturbance.clone(),
            to: to.clone(),
            rms_ratio: *best,
            clear: best.interval.map_or(!self.random, |(_, high)| high < 1.0),
        })
    }
}

/// The RMS error of a flight divided by another's: 1 if both are below [`RESOLUTION_M`], or both are lost.
fn ratio(flight: &Score, other: &Score) -> f64 {
    let rms = |score: &Score| score.rms_m.map_or(f64::INFINITY, |rms| rms.max(RESOLUTION_M));
    let (a, b) = (rms(flight), rms(other));
    if a.total_cmp(&b).is_eq() { 1.0 } else { a / b }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flight(controller: &str, rms_m: Option<f64>) -> FlightScore {
        FlightScore {
            scenario: "x500-hover".into(),
            disturbance: "gaussian".into(),
            controller: controller.into(),
            seed: 1,
            score: Score { survived: rms_m.is_some(), rms_m, ..Score::default() },
        }
    }

    /// A random cell, from the RMS errors of each controller.
    fn cell(errors: &[&[Option<f64>]]) -> Cell {
        let cases = Matrix::load("x500", &[]).and_then(|matrix| matrix.cases()).expect("valid");
        let case = cases.iter().find(|case| case.is_random()).expect("there is one");
        let flown: Vec<Vec<FlightScore>> =
            errors.iter().map(|errors| errors.iter().map(|rms| flight("any", *rms)).collect()).collect();
        Cell::of(case, &flown.iter().map(Vec::as_slice).collect::<Vec<_>>())
    }

    fn names() -> Vec<String> {
        ["first", "second", "third"].map(String::from).to_vec()
    }

    #[test]
    fn ratios_compare_flights_under_the_same_seed() {
        // The seeds differ a thousandfold; under each the second has 0.9 of the first's error.
        let first: Vec<_> = (0..8).map(|k| Some(1e-3 * 10_f64.powf(0.4 * f64::from(k)))).collect();
        let second: Vec<_> = first.iter().map(|rms| rms.map(|rms| 0.9 * rms)).collect();
        let cell = cell(&[&first, &second]);
        let close = |value: f64, expected: f64| assert!((value - expected).abs() < 1e-12, "{value}");
        close(cell.rms_ratios[0].median, 1.0);
        close(cell.rms_ratios[1].median, 0.9);
        let lost = cell.lost(&names()).expect("lost");
        assert!(lost.to == "second" && lost.clear);
        let (low, high) = lost.rms_ratio.interval.expect("eight seeds");
        close(low, 0.9);
        close(high, 0.9);
    }

    #[test]
    fn a_lost_flight_is_worse_than_any_that_survived() {
        let far = [Some(40.0); 8];
        let lost = [None; 8];
        let cell = cell(&[&far, &lost, &far]);
        assert_eq!((cell.controllers[1].survived, cell.controllers[1].flights), (0, 8));
        assert_eq!(cell.rms_ratios[1].median, f64::INFINITY);
        assert_eq!(cell.controllers[1].rms().median, f64::INFINITY);
        assert_eq!(cell.lost(&names()), None, "neither to a lost one nor to an equal one");
    }

    #[test]
    fn a_controller_whose_flights_are_lost_loses_the_cell() {
        let found = cell(&[&[None; 8], &[None; 8], &[Some(40.0); 8]]).lost(&names()).expect("lost");
        assert_eq!((found.to.as_str(), found.rms_ratio.median, found.clear), ("third", 0.0, true));
        assert_eq!(cell(&[&[None; 8], &[None; 8]]).lost(&names()), None, "both are lost");
    }

    #[test]
    fn a_difference_within_the_interval_is_not_clear() {
        let first = [Some(1.0); 8];
        let second = [0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 2.0].map(Some);
        let found = cell(&[&first, &second]).lost(&names()).expect("lost");
        assert!(!found.clear, "the interval of 8 seeds reaches from the least to the greatest");
        assert_eq!(found.rms_ratio.interval, Some((0.5, 2.0)));
    }

    #[test]
    fn errors_below_the_resolution_are_equal() {
        let cell = cell(&[&[Some(6e-8); 8], &[Some(9e-6); 8], &[Some(2e-5); 8]]);
        assert_eq!(cell.rms_ratios[1].median, 1.0);
        assert!((cell.rms_ratios[2].median - 2.0).abs() < 1e-12);
    }

    #[test]
    fn two_files_of_the_same_name_are_refused() {
        let refusal = |spoil: &dyn Fn(&mut Matrix)| {
            let mut matrix = Matrix::load("x500", &[]).expect("valid");
            spoil(&mut matrix);
            Contest::new(&matrix).expect_err("must be refused").to_string()
        };
        let error = refusal(&|matrix| matrix.file.scenarios.push("mine/x500-hover.toml".to_owned()));
        assert!(error.contains("`scenarios`") && error.contains("`x500-hover`"), "{error}");
        let error = refusal(&|matrix| matrix.file.controllers.push("mine/x500-smc.toml".to_owned()));
        assert!(error.contains("`controllers`") && error.contains("`x500-smc`"), "{error}");
    }

    #[test]
    fn a_path_is_shortened_to_its_files_name() {
        assert_eq!(short_name("/tmp/here/softer.toml"), "softer");
        assert_eq!(short_name("x500-smc"), "x500-smc");
    }
}
