//! How a search for gains converged.

use std::path::{Path, PathBuf};

use anyhow::Result;

use super::page::{grid, save, size_of};
use super::panel::Panel;
use super::series::Points;
use super::style::{Key, Role};
use crate::tune::Iteration;

/// Best and mean cost over the iterations, beside the cost of the base's own gains. Returns the file
/// written.
///
/// # Errors
/// When the file cannot be written; the message names it.
pub fn convergence(folder: &Path, iterations: &[Iteration], base_cost: f64) -> Result<PathBuf> {
    let over_iterations = |cost: fn(&Iteration) -> f64| -> Points {
        iterations.iter().enumerate().map(|(i, iteration)| (i as f64 + 1.0, cost(iteration))).collect()
    };
    let panel = |title: &str, lines| Panel { across: "iteration".into(), ..Panel::over_time(title, "cost", lines) };
    let best = over_iterations(|iteration| iteration.best);
    let base = best.iter().map(|(i, _)| (*i, base_cost)).collect();
    let panels = [
        panel("best so far", vec![(Role::Reference, base), (Role::Flown, best)]),
        panel("mean of the iteration", vec![(Role::Flown, over_iterations(|iteration| iteration.mean))]),
    ];
    let path = folder.join("convergence.svg");
    let legend = [Key::Line("the base's own gains", Role::Reference), Key::Line("search", Role::Flown)];
    save(&path, size_of(1, 380), "Convergence of the search", &legend, |area| grid(area, 2, &panels))?;
    Ok(path)
}
