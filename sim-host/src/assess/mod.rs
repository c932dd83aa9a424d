//! Assessment of flights on sensors: the measures of each flight, and their percentiles over many seeds against
//! expectations.
//!
//! A scenario gives the judged time, the wanted position, and bounds on percentiles of measures:
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
//! Everything is measured against the truth. The error of the vehicle's own estimate is one of the measures.

pub mod consistency;
pub mod ensemble;
pub mod measures;

use anyhow::{Result, ensure};
use serde::{Deserialize, Serialize};

use crate::refusal::{after, within};

pub use ensemble::Report;
pub use measures::{Assessor, Measure, Measures};

/// How a scenario's flights are assessed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Assess {
    /// Start of the judged time, s.
    pub from_s: f64,
    /// End of the judged time, s; by default the end of the flight.
    pub to_s: Option<f64>,
    /// Wanted position, m; by default the reference of guidance at each time.
    pub hold_m: Option<[f64; 3]>,
    /// Least fraction of the samples, one every two seconds, in which the mean over the seeds of the normalised errors,
    /// and of the normalised innovations of each kind of reading, must be within its 95 % band.
    pub consistent: Option<f64>,
    /// The expectations.
    #[serde(default)]
    pub expect: Vec<Expectation>,
}

/// A bound on a percentile of a measure over the seeds, or on its root mean square over them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// The measure.
    pub measure: Measure,
    /// Percentile, 0 to 100: of 100 seeds, the 95th is the one that five are worse than. By default the root mean
    /// square.
    pub percentile: Option<f64>,
    /// Upper bound.
    pub at_most: Option<f64>,
    /// Lower bound.
    pub at_least: Option<f64>,
}

/// Longer than any flight, s.
const LONGEST_S: f64 = 1e6;

impl Expectation {
    /// Whether a value is there and within the bounds, however many seeds it is from.
    pub fn holds(&self, found: Option<f64>) -> bool {
        found.is_some_and(|value| {
            self.at_most.is_none_or(|most| value <= most) && self.at_least.is_none_or(|least| value >= least)
        })
    }

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
    /// Checks the settings.
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

    /// Checks that a flight of `duration_s` does not end before the judged time. Such a flight may be flown, but not
    /// assessed.
    ///
    /// # Errors
    /// The key that is out of range.
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
