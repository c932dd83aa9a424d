//! The optimisers, over the unit cube: they evaluate points in an order that only depends on the seed and the costs.

#[cfg(feature = "search")]
mod libraries;

use std::ops::RangeInclusive;

use anyhow::{Result, ensure};
use clap::ValueEnum;

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

/// Points per iteration that a search takes. CMA-ES learns from the better half, so it needs four at least.
pub const PARTICLES: RangeInclusive<usize> = 4..=10_000;
/// Iterations that it takes.
pub const ITERATIONS: RangeInclusive<usize> = 1..=1_000_000;

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
        ensure!(
            PARTICLES.contains(&self.particles),
            "--particles must be between {} and {}, not {}",
            PARTICLES.start(),
            PARTICLES.end(),
            self.particles
        );
        ensure!(
            ITERATIONS.contains(&self.iterations),
            "--iterations must be between {} and {}, not {}",
            ITERATIONS.start(),
            ITERATIONS.end(),
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
#[cfg(feature = "search")]
pub(super) fn search(settings: &Settings, dimensions: usize, costs: Costs) -> Result<()> {
    match settings.method {
        Method::Pso => libraries::swarm(settings, dimensions, costs),
        Method::CmaEs => libraries::evolution(settings, dimensions, costs),
    }
}

/// Without the optimisers.
///
/// # Errors
/// Always: the command that builds them in.
#[cfg(not(feature = "search"))]
pub(super) fn search(_settings: &Settings, _dimensions: usize, _costs: Costs) -> Result<()> {
    require_optimisers("tune")
}

/// Whether this build can search. The optimisers' crates, and what these bring, are a sixth of what a first build
/// compiles, and few users search.
///
/// # Errors
/// The command that builds them in.
pub fn require_optimisers(command: &str) -> Result<()> {
    ensure!(
        cfg!(feature = "search"),
        "`{command}` needs the optimisers, which this build leaves out: use \
         `cargo run --release --features search -- {command} …`"
    );
    Ok(())
}

#[cfg(all(test, feature = "search"))]
mod tests {
    use anyhow::anyhow;

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
}
