//! A run: a search, its journal and its progress.

use anyhow::Result;

use super::journal::Journal;
use super::search::{Settings, search};
use crate::parallel;

/// An iteration's result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iteration {
    /// Best cost so far.
    pub best: f64,
    /// Mean cost of the iteration's points.
    pub mean: f64,
}

/// Progress of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// Iterations so far.
    pub iterations: Vec<Iteration>,
    /// The best point so far.
    pub best_point: Vec<f64>,
    /// Costs of the current iteration.
    under_way: Vec<f64>,
    /// The best cost so far.
    best: Option<f64>,
}

impl State {
    /// Adds a point with its cost; true if that completes an iteration.
    fn take(&mut self, point: &[f64], cost: f64, particles: usize) -> bool {
        if self.best.is_none_or(|best| cost < best) {
            self.best = Some(cost);
            self.best_point = point.to_vec();
        }
        self.under_way.push(cost);
        if self.under_way.len() < particles {
            return false;
        }
        let mean = self.under_way.iter().sum::<f64>() / particles as f64;
        self.iterations.push(Iteration { best: self.best_cost(), mean });
        self.under_way.clear();
        true
    }

    /// The best cost so far; infinite before the first.
    pub fn best_cost(&self) -> f64 {
        self.best.unwrap_or(f64::INFINITY)
    }
}

/// A search with expensive costs.
pub struct Run<C> {
    /// How to search.
    pub settings: Settings,
    /// Number of dimensions.
    pub dimensions: usize,
    /// Cost of a point of the unit cube; finite. Called from several threads.
    pub cost: C,
    /// The journal of the costs.
    pub journal: Journal,
}

impl<C: Fn(&[f64]) -> f64 + Sync> Run<C> {
    /// Runs the search on the current thread pool; the result does not depend on the number of threads. Calls `observe`
    /// after each iteration.
    ///
    /// # Errors
    /// Invalid settings, a journal that cannot be written or belongs to another run, or an error of `observe`.
    pub fn go(mut self, mut observe: impl FnMut(&State) -> Result<()>) -> Result<State> {
        self.settings.validate()?;
        let (settings, dimensions) = (self.settings, self.dimensions);
        let mut state = State::default();
        let mut costs = |points: &[Vec<f64>]| {
            let costs = self.costs(points)?;
            for (point, cost) in points.iter().zip(&costs) {
                if state.take(point, *cost, settings.particles) {
                    observe(&state)?;
                }
            }
            Ok(costs)
        };
        search(&settings, dimensions, &mut costs)?;
        Ok(state)
    }

    /// Costs of points, from the journal as long as it has them.
    fn costs(&mut self, points: &[Vec<f64>]) -> Result<Vec<f64>> {
        let mut costs = Vec::with_capacity(points.len());
        for point in points {
            match self.journal.recall(point)? {
                Some(cost) => costs.push(cost),
                None => break,
            }
        }
        let unknown = &points[costs.len()..];
        let found = parallel::map(unknown, |point| (self.cost)(point));
        self.journal.append(unknown, &found)?;
        costs.extend(found);
        Ok(costs)
    }
}
