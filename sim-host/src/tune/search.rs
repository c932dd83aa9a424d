//! The optimisers, over the unit cube: they evaluate points in an order that only depends on the seed and the costs.

use std::borrow::Borrow;
use std::cell::RefCell;
use std::f64::consts::LN_2;

use anyhow::{Result, anyhow, ensure};
use argmin::core::{CostFunction, PopulationState, Problem, Solver as _, State as _, SyncAlias};
use argmin::solver::particleswarm::ParticleSwarm;
use clap::ValueEnum;
use cmaes::{CMAESOptions, DVector};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng as _;

/// Inertia of the swarm's particles, and their attraction to their own and the swarm's best point, as in the Standard
/// Particle Swarm Optimisation (Clerc 2006; Zambrano-Bigiarini and others 2013).
const INERTIA: f64 = 0.5 / LN_2;
const PULL: f64 = 0.5 + LN_2;

/// Initial mean and deviation of CMA-ES: they cover the whole cube.
const CENTRE: f64 = 0.5;
const STEP: f64 = 0.3;

/// An optimiser.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Method {
    /// Particle swarm.
    Pso,
    /// Covariance matrix adaptation evolution strategy: a normal distribution that learns correlations between gains.
    CmaEs,
}

impl Method {
    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pso => "pso",
            Self::CmaEs => "cma-es",
        }
    }
}

/// How to search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// With which optimiser.
    pub method: Method,
    /// Points per iteration.
    pub particles: usize,
    /// Iterations, the first random points among them.
    pub iterations: usize,
    /// Seed of the search.
    pub seed: u64,
}

impl Settings {
    /// Checks the settings.
    ///
    /// # Errors
    /// The option that is out of its range.
    pub fn validate(&self) -> Result<()> {
        // CMA-ES learns from the better half, so it needs four points at least.
        ensure!(
            (4..=10_000).contains(&self.particles),
            "--particles must be between 4 and 10000, not {}",
            self.particles
        );
        ensure!(
            (1..=1_000_000).contains(&self.iterations),
            "--iterations must be between 1 and 1000000, not {}",
            self.iterations
        );
        Ok(())
    }
}

/// Returns the costs of points.
pub(super) type Costs<'a> = &'a mut dyn FnMut(&[Vec<f64>]) -> Result<Vec<f64>>;

/// Evaluates `costs` at points of `dimensions` coordinates in 0 ..= 1 until the budget is spent or the optimiser has
/// converged. Points that come in one call do not depend on each other's costs.
///
/// # Errors
/// What `costs` returns, or the optimiser's refusal of its settings.
pub(super) fn search(settings: &Settings, dimensions: usize, costs: Costs) -> Result<()> {
    match settings.method {
        Method::Pso => swarm(settings, dimensions, costs),
        Method::CmaEs => evolution(settings, dimensions, costs),
    }
}

/// The costs as argmin asks for them.
struct Swarm<'a>(RefCell<Costs<'a>>);

impl CostFunction for Swarm<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, point: &Vec<f64>) -> Result<f64> {
        self.bulk_cost(&[point])?.first().copied().ok_or_else(|| anyhow!("no cost for a point"))
    }

    fn bulk_cost<P: Borrow<Vec<f64>> + SyncAlias>(&self, points: &[P]) -> Result<Vec<f64>> {
        let points: Vec<Vec<f64>> = points.iter().map(|point| point.borrow().clone()).collect();
        (self.0.borrow_mut())(&points)
    }
}

/// argmin's `Executor` is left out: it brings a clock, a checkpoint of its own and observers that must own what they
/// use, and the loop is three lines.
fn swarm(settings: &Settings, dimensions: usize, costs: Costs) -> Result<()> {
    let cube = (vec![0.0; dimensions], vec![1.0; dimensions]);
    let mut solver = ParticleSwarm::new(cube, settings.particles)
        .with_rng_generator(Xoshiro256PlusPlus::seed_from_u64(settings.seed))
        .with_inertia_factor(INERTIA)?
        .with_cognitive_factor(PULL)?
        .with_social_factor(PULL)?;
    let mut problem = Problem::new(Swarm(RefCell::new(costs)));
    let (mut state, _) = solver.init(&mut problem, PopulationState::new())?;
    for _ in 1..settings.iterations {
        (state, _) = solver.next_iter(&mut problem, state)?;
    }
    Ok(())
}

fn evolution(settings: &Settings, dimensions: usize, costs: Costs) -> Result<()> {
    let mut failed = None;
    let objective = |x: &DVector<f64>| {
        let point = x.iter().map(|x| reflected(*x)).collect();
        // A cost of NaN ends the search.
        costs(&[point]).map_or_else(|error| (failed = Some(error), f64::NAN).1, |costs| costs[0])
    };
    CMAESOptions::new(vec![CENTRE; dimensions], STEP)
        .population_size(settings.particles)
        .seed(settings.seed)
        .max_generations(settings.iterations)
        .build(objective)
        .map_err(|error| anyhow!("the optimiser refuses its options: {error:?}"))?
        .run();
    failed.map_or(Ok(()), Err)
}

/// Points outside of the cube are reflected back inside.
fn reflected(x: f64) -> f64 {
    let x = x.rem_euclid(2.0);
    if x > 1.0 { 2.0 - x } else { x }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(method: Method, seed: u64) -> Vec<Vec<f64>> {
        let settings = Settings { method, particles: 8, iterations: 5, seed };
        let mut asked = Vec::new();
        let mut costs = |points: &[Vec<f64>]| {
            asked.extend_from_slice(points);
            Ok(points.iter().map(|point| point.iter().map(|x| (x - 0.9) * (x - 0.9)).sum()).collect())
        };
        search(&settings, 3, &mut costs).expect("searches");
        asked
    }

    #[test]
    fn a_seed_decides_the_points_and_all_lie_in_the_cube() {
        for method in [Method::Pso, Method::CmaEs] {
            let points = asked(method, 1);
            assert_eq!(points.len(), 8 * 5);
            assert!(points.iter().flatten().all(|x| (0.0..=1.0).contains(x)), "{method:?}");
            assert_eq!(points, asked(method, 1));
            assert_ne!(points, asked(method, 2));
        }
    }

    #[test]
    fn a_cost_that_cannot_be_had_ends_the_search() {
        for method in [Method::Pso, Method::CmaEs] {
            let settings = Settings { method, particles: 4, iterations: 3, seed: 1 };
            let error = search(&settings, 2, &mut |_| Err(anyhow!("no disk"))).expect_err("it has none");
            assert_eq!(error.to_string(), "no disk");
        }
    }

    #[test]
    fn the_mirror_leaves_the_inside_alone() {
        for (x, seen) in [(0.0, 0.0), (0.25, 0.25), (1.0, 1.0), (1.25, 0.75), (-0.25, 0.25), (2.5, 0.5)] {
            assert_eq!(reflected(x), seen);
        }
    }
}
