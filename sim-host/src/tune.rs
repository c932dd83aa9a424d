//! Tuning: a search for the gains of a controller, with costs from flights.
//!
//! ```text
//! tunes/NAME.toml ──► Space: unit cube ──► gains ──► Controller ─┐
//!        │                  ▲                                    ▼
//!        └─► courses/NAME.toml ──► Course: flights, weights ──► cost
//!                           │                                    │
//!                        search (swarm, CMA-ES) ◄── Run ◄────────┘
//!                                                    └─► journal, progress, best
//! ```
//!
//! What is varied ([`Tune`]) and how it is judged ([`Course`]) are files of their own, so that several controllers are
//! tuned on the same flights to the same cost. The search is independent of both: it only sees costs of points in the
//! unit cube. [`Run`] records each cost; resuming replays the search with the recorded costs, and continues
//! bit-exactly.

mod course;
mod journal;
mod run;
mod search;
mod space;

pub use course::{Course, Weights};
pub use journal::Journal;
pub use run::{Iteration, Run, State};
pub use search::{ITERATIONS, Method, PARTICLES, Settings, require_optimisers};
pub use space::{Parameter, Scale, Space};

use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};

use crate::files;
use crate::scenario::TUNINGS;

/// Tunes built into the binary.
pub(crate) const TUNES: [(&str, &str); 4] =
    glissade_files::built_in!("tunes": "x500-smc", "x500-pid", "x500-geometric", "x500-indi");

/// Courses built into the binary.
const COURSES: [(&str, &str); 1] = glissade_files::built_in!("courses": "x500");

/// A tune file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct TuneFile {
    /// Description, in one line.
    summary: String,
    /// Name or path of the tuning file whose gains are varied.
    base: String,
    /// Name or path of the course.
    course: String,
    /// The varied parameters.
    parameters: Vec<Parameter>,
}

/// The parameter space, and the course.
#[derive(Clone, Debug)]
pub struct Tune {
    /// Its name, or the path of its file.
    pub name: String,
    /// Gains as points of the unit cube.
    pub space: Space,
    /// Flights and weights.
    pub course: Course,
}

impl Tune {
    /// Loads a built-in tune by name or a file by path, with the tuning and the course that it names.
    ///
    /// # Errors
    /// One line with the file, the key and the error.
    pub fn load(name: &str) -> Result<Self> {
        let context = || format!("tune `{name}`");
        let file: TuneFile = files::read(name, "tune", &TUNES)?;
        let (base_name, course) = (files::beside(name, &file.base), files::beside(name, &file.course));
        let base = files::read(&base_name, "tuning", &TUNINGS).with_context(context)?;
        let space = Space::new(&base_name, base, file.parameters).with_context(context)?;
        let course = Course::load(&course).with_context(context)?;
        course.require_flyable(&space.base_controller()?).with_context(context)?;
        require_ends(&space, &course).with_context(context)?;
        Ok(Self { name: name.to_owned(), space, course })
    }

    /// Cost of a point of the unit cube: that of its controller's flights.
    pub fn cost(&self, point: &[f64]) -> f64 {
        self.space.controller(point).map_or(self.course.weights.refused(), |controller| self.course.cost(&controller))
    }

    /// Identity of a run's costs, for its journal: two runs with the same text fly the same flights.
    pub fn identity(&self) -> String {
        format!("{:?} {:?}", self.space, self.course)
    }
}

/// Refuses a range if the controller refuses one of its ends: part of the search would be wasted.
fn require_ends(space: &Space, course: &Course) -> Result<()> {
    for (index, parameter) in space.parameters().iter().enumerate() {
        for (end, x) in [("low", 0.0), ("high", 1.0)] {
            let flyable = space.with_one(index, x).and_then(|controller| course.require_flyable(&controller));
            flyable.with_context(|| {
                let keys = parameter.keys.join(", ");
                format!("parameter `{keys}`: the controller refuses its `{end}`, {}", parameter.value(x))
            })?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_built_in_tune_loads_and_has_a_base_that_flies() {
        for (name, _) in TUNES {
            let tune = Tune::load(name).unwrap_or_else(|error| panic!("{error:#}"));
            assert!(tune.space.base_controller().is_ok(), "{name}");
        }
    }

    #[test]
    fn a_range_that_the_controller_refuses_is_refused_by_its_keys() {
        let course = Course::load("x500").expect("valid");
        let base = include_str!("../tunings/x500-pid.toml");
        let refusal = |key: &str, low: f64, high: f64| {
            let one = Parameter { keys: vec![key.to_owned()], factors: None, low, high, scale: Scale::Linear };
            let space = Space::new("x500-pid", base.parse().expect("TOML"), vec![one]).expect("a space");
            require_ends(&space, &course).err().map(|error| format!("{error:#}"))
        };
        assert_eq!(refusal("pid.yaw_weight", 0.0, 1.0), None);
        for (key, low, high, end) in [("pid.yaw_weight", 0.1, 1.2, "high"), ("pid.rate_p_1_s.xy", -1.0, 60.0, "low")] {
            let error = refusal(key, low, high).expect("must be refused");
            assert!(error.contains(&format!("`{key}`")) && error.contains(&format!("`{end}`")), "{error}");
            assert!(!error.contains('\n'), "{error}");
        }
    }
}
