//! Planning of a joining path: CMA-ES over its duration and shape; the cost comes from flying the closed loop.
//!
//! The cost is the time from which every axis stays within 5 cm of the trajectory. The firmware only evaluates the
//! curve; finding it is offline work, and its result is part of a scenario.

use std::sync::atomic::{AtomicU64, Ordering};

use anyhow::{Context, Result, anyhow, ensure};
use cmaes::{CMAESOptions, DVector};
use firmware::guidance::{JoinPlan, MIDDLE_POINTS};
use nalgebra::Vector3;

use crate::flight;
use crate::record::{Recorder, Row};
use crate::reference;
use crate::scenario::{PlantKind, Scenario};

/// Number of shaping points.
const POINTS: usize = 6;
const _: () = assert!(POINTS <= MIDDLE_POINTS);

/// Parameters: duration, vertical start acceleration, the points.
const PARAMETERS: usize = 2 + 3 * POINTS;

/// Scale of the duration (s) and of the start's acceleration (m/s²) in units of a parameter; points are in m.
const DURATION_SCALE: f64 = 0.25;
const ACCELERATION_SCALE: f64 = 5.0;

/// Masses with which a path is flown, relative to the mass that the controller assumes.
const MASSES: [f64; 3] = [1.0, 0.99, 1.01];

/// Population of the search.
const POPULATION: usize = 24;

/// Time flown after joining, s, to check that the error stays small.
const AFTER_S: f64 = 1.0;

/// A path overshoots if it passes the reference by more than this fraction of the initial error.
const OVERSHOOT_MAX: f64 = 0.08;

/// Settled means within 5 cm. A path is planned to 4 cm, so that rounding of its digits does not matter, and to 1.5 mm
/// for the rest of the flight.
const AWAY_M: f64 = 0.04;
const OFF_M: f64 = 1.5e-3;

/// Measures the settling of a flight.
#[derive(Default)]
struct Approach {
    /// Each axis' error at the start, m.
    start: [Option<f64>; 3],
    /// Last time at which each axis was [`AWAY_M`], and [`OFF_M`], or more away, s.
    last_away: [f64; 3],
    last_off: [f64; 3],
    /// Greatest overshoot, as a fraction of the initial error.
    overshoot: f64,
}

impl Recorder for Approach {
    fn record(&mut self, row: &Row) {
        for i in 0..3 {
            let error = row.reference[i] - row.position[i];
            let start = *self.start[i].get_or_insert(error);
            if error.abs() >= AWAY_M {
                self.last_away[i] = row.t + 1e-3;
            }
            if error.abs() >= OFF_M {
                self.last_off[i] = row.t + 1e-3;
            }
            if start.abs() >= 0.05 {
                self.overshoot = self.overshoot.max(-error / start);
            }
        }
    }
}

impl Approach {
    /// Time from which all axes stay within [`AWAY_M`], s.
    fn settle_s(&self) -> f64 {
        self.last_away.into_iter().fold(0.0, f64::max)
    }

    /// The time at which the last axis settles, plus small weights on the others and on settling to 1.5 mm, plus a
    /// penalty on overshoot.
    fn cost(&self) -> f64 {
        let others: f64 = self.last_away.iter().sum();
        let fine: f64 = self.last_off.iter().sum();
        self.settle_s() + 0.05 * others + 0.02 * fine + 5.0 * (self.overshoot - OVERSHOOT_MAX).max(0.0)
    }
}

/// A finished plan.
#[derive(Clone, Debug)]
pub struct Planned {
    /// The plan.
    pub plan: JoinPlan,
    /// Time from which all axes stay within 4 cm, s.
    pub settle_s: f64,
    /// Flights flown.
    pub flights: u64,
}

/// The plan of a parameter vector: points are offsets from a straight line from start to end.
fn decode(scenario: &Scenario, x: &DVector<f64>) -> JoinPlan {
    let duration = (1.5 + DURATION_SCALE * x[0]).clamp(0.3, 20.0);
    let start = Vector3::from(scenario.file.start_position_m);
    let [rx, ry, rz, _] = reference::at(&scenario.file.trajectory, duration);
    let end = Vector3::new(rx, ry, rz);
    let mut middle_m = heapless::Vec::new();
    for i in 0..POINTS {
        let part = (i as f64 + 1.0) / (POINTS as f64 + 1.0);
        let offset = Vector3::new(x[2 + 3 * i], x[3 + 3 * i], x[4 + 3 * i]);
        let point: Vector3<f32> = (start + (end - start) * part + offset).cast();
        // POINTS fit, by the assertion above.
        let _ = middle_m.push(point.into());
    }
    JoinPlan {
        duration_s: duration as f32,
        start_acceleration_m_s2: [0.0, 0.0, (ACCELERATION_SCALE * x[1]) as f32],
        middle_m,
    }
}

/// Settling of a plan with `mass` times the vehicle's mass; `None` if it is refused or the vehicle is lost.
fn try_plan(scenario: &Scenario, plan: &JoinPlan, mass: f64) -> Option<Approach> {
    let mut scenario = scenario.clone();
    scenario.file.duration_s = f64::from(plan.duration_s) + AFTER_S;
    scenario.file.join = Some(plan.clone());
    scenario.file.truth.mass_factor *= mass;
    let mut approach = Approach::default();
    let outcome = flight::fly(&scenario, 0, &mut approach).ok()?;
    outcome.survived().then_some(approach)
}

/// Cost of a plan: that of its worst vehicle. A plan for a single mass would be overfitted to one flight, and lost with
/// the next change of a control law.
fn cost(scenario: &Scenario, plan: &JoinPlan) -> f64 {
    const REFUSED: f64 = 1e3;
    let of = |part: &f64| try_plan(scenario, plan, *part).map_or(REFUSED, |approach| approach.cost());
    MASSES.iter().map(of).fold(0.0, f64::max)
}

/// Plans the joining path of a scenario with at most `flights` flights.
///
/// # Errors
/// The scenario has no path to plan, or the optimiser refuses its options.
pub fn plan(scenario: &Scenario, flights: usize, seed: u64, mut progress: impl FnMut(u64)) -> Result<Planned> {
    ensure!(
        scenario.file.plant != PlantKind::PaperDecoupled,
        "scenario `{}` is flown on the decoupled plant, which joins nothing: plan one on a coupled plant",
        scenario.name
    );
    let generation = POPULATION * MASSES.len();
    ensure!(
        flights >= generation,
        "--flights must be at least {generation}, a generation of paths, each with every mass, not {flights}"
    );
    let flown = AtomicU64::new(0);
    let objective = |x: &DVector<f64>| {
        flown.fetch_add(MASSES.len() as u64, Ordering::Relaxed);
        cost(scenario, &decode(scenario, x))
    };
    let mut start = vec![0.0; PARAMETERS];
    start[0] = (scenario.file.join.as_ref().map_or(2.0, |join| f64::from(join.duration_s)) - 1.5) / DURATION_SCALE;
    let mut search = CMAESOptions::new(start, 0.5)
        .population_size(POPULATION)
        .seed(seed)
        .max_function_evals(flights / MASSES.len())
        .tol_fun(1e-5)
        .build(objective)
        .map_err(|error| anyhow!("the optimiser refuses its options: {error:?}"))?;
    let ended = loop {
        let ended = search.next_parallel();
        progress(flown.load(Ordering::Relaxed));
        if let Some(ended) = ended {
            break ended;
        }
    };
    let best = ended.overall_best.ok_or_else(|| anyhow!("no flight was flown: give more than --flights {flights}"))?;
    let plan = decode(scenario, &best.point);
    let approach = try_plan(scenario, &plan, 1.0)
        .with_context(|| format!("no path was found with {flights} flights: give more with --flights"))?;
    Ok(Planned { plan, settle_s: approach.settle_s(), flights: flown.load(Ordering::Relaxed) })
}
