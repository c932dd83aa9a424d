//! The optimisers' libraries, driven over the unit cube.

use std::borrow::Borrow;
use std::cell::RefCell;
use std::f64::consts::LN_2;

use anyhow::{Result, anyhow};
use argmin::core::{CostFunction, PopulationState, Problem, Solver as _, State as _, SyncAlias};
use argmin::solver::particleswarm::ParticleSwarm;
use cmaes::{CMAESOptions, DVector};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng as _;

use super::{Costs, Settings};

/// Inertia of the swarm's particles, and their attraction to their own and the swarm's best point, as in the Standard
/// Particle Swarm Optimisation (Clerc 2006; Zambrano-Bigiarini and others 2013).
const INERTIA: f64 = 0.5 / LN_2;
const PULL: f64 = 0.5 + LN_2;

/// Initial mean and deviation of CMA-ES: they cover the whole cube.
const CENTRE: f64 = 0.5;
const STEP: f64 = 0.3;

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
pub(super) fn swarm(settings: &Settings, dimensions: usize, costs: Costs) -> Result<()> {
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

pub(super) fn evolution(settings: &Settings, dimensions: usize, costs: Costs) -> Result<()> {
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

    #[test]
    fn the_mirror_leaves_the_inside_alone() {
        for (x, seen) in [(0.0, 0.0), (0.25, 0.25), (1.0, 1.0), (1.25, 0.75), (-0.25, 0.25), (2.5, 0.5)] {
            assert_eq!(reflected(x), seen);
        }
    }
}
