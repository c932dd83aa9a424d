//! Judging flights on sensors: what each flight measured, and the percentiles over many seeds against what is expected.
//!
//! A scenario says over which time it is judged, where the vehicle ought to be, and what is expected of which percentile:
//!
//! ```toml
//! [assess]
//! from_s = 40.0
//! to_s = 100.0
//! hold_m = [0.0, 0.0, 10.0]
//! [[assess.expect]]
//! measure = "height-error-max-m"
//! percentile = 95.0
//! at_most = 0.15
//! ```
//!
//! Everything is measured against the truth; what the vehicle believes is measured too, but never judged by itself.

pub mod consistency;
pub mod ensemble;
pub mod measures;

use anyhow::{Result, ensure};
use serde::{Deserialize, Serialize};

use crate::refusal::{after, within};

pub use ensemble::Report;
pub use measures::{Assessor, Measure, Measures};

/// How a scenario's flights are judged.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Assess {
    /// Begin of what is judged, s.
    pub from_s: f64,
    /// End of it, s; that of the flight without it.
    pub to_s: Option<f64>,
    /// Where the vehicle ought to be, m; what guidance asks for at the time without it.
    pub hold_m: Option<[f64; 3]>,
    /// Least part of the looks, one every two seconds, at which errors, and innovations of each kind of reading, are to be
    /// within the band that holds their mean over the seeds with 95 % probability.
    pub consistent: Option<f64>,
    /// What is expected.
    #[serde(default)]
    pub expect: Vec<Expectation>,
}

/// A bound on a percentile of a measure over the seeds, or on its root mean square over them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// Of what.
    pub measure: Measure,
    /// Which percentile, 0 to 100: of 100 seeds, the 95th is the one that five are worse than. Without it, the root mean
    /// square.
    pub percentile: Option<f64>,
    /// Greatest value that is as expected.
    pub at_most: Option<f64>,
    /// Least value that is as expected.
    pub at_least: Option<f64>,
}

/// Longer than any flight, s.
const LONGEST_S: f64 = 1e6;

impl Expectation {
    fn validate(&self, key: &str) -> Result<()> {
        within(&format!("{key}.percentile"), self.percentile.unwrap_or(0.0), 0.0, 100.0)?;
        ensure!(
            self.at_most.or(self.at_least).is_some_and(f64::is_finite),
            "`{key}` is without a bound on `{}`: give a number for `at_most` or `at_least`",
            self.measure.name()
        );
        Ok(())
    }

    /// Seeds that it takes to judge it: so many that the percentile is not simply the worst flight or the best. The least
    /// and the greatest, 0 and 100, are those of the seeds flown, however few. A root mean square of 20 is good to 16 %.
    pub fn seeds_needed(&self) -> u64 {
        const FOR_ROOT_MEAN_SQUARE: u64 = 20;
        let Some(percentile) = self.percentile else { return FOR_ROOT_MEAN_SQUARE };
        let beyond = percentile.min(100.0 - percentile);
        if beyond > 0.0 { (100.0 / beyond).ceil() as u64 } else { 1 }
    }
}

impl Assess {
    /// Refuses what cannot be judged.
    ///
    /// # Errors
    /// The first key that is out of range.
    pub fn validate(&self) -> Result<()> {
        within("assess.from_s", self.from_s, 0.0, LONGEST_S)?;
        if let Some(to_s) = self.to_s {
            within("assess.to_s", to_s, 0.0, LONGEST_S)?;
            after(("assess.from_s", self.from_s), ("assess.to_s", to_s))?;
        }
        for (i, value) in self.hold_m.iter().flatten().enumerate() {
            within(&format!("assess.hold_m.{i}"), *value, -1e6, 1e6)?;
        }
        within("assess.consistent", self.consistent.unwrap_or(0.0), 0.0, 1.0)?;
        self.expect.iter().enumerate().try_for_each(|(i, one)| one.validate(&format!("assess.expect.{i}")))
    }

    /// Refuses a flight of `duration_s` that ends before what is judged of it; it may be flown all the same.
    ///
    /// # Errors
    /// The key to look at.
    pub fn require_part_of(&self, duration_s: f64) -> Result<()> {
        let to_s = self.to_s.unwrap_or(duration_s);
        ensure!(
            self.from_s < to_s && to_s <= duration_s,
            "`assess` judges from {} to {to_s} s, and the flight ends at {duration_s} s: lengthen `duration_s`, or set \
             `assess.from_s` and `assess.to_s` to a part of the flight",
            self.from_s
        );
        Ok(())
    }
}
