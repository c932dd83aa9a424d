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

impl Assess {
    /// Refuses what cannot be judged.
    ///
    /// # Errors
    /// The first key that is out of its range.
    pub fn validate(&self) -> Result<()> {
        ensure!(
            self.from_s >= 0.0 && self.to_s.is_none_or(|to_s| self.from_s < to_s),
            "`assess.from_s` must be from 0 up to `assess.to_s`, not {}",
            self.from_s
        );
        for value in self.hold_m.iter().flatten() {
            ensure!(value.abs() <= 1e6, "`assess.hold_m` must be between -1000000 and 1000000, not {value}");
        }
        for Expectation { measure, percentile, at_most, at_least } in &self.expect {
            let name = measure.name();
            ensure!(
                percentile.is_none_or(|percentile| (0.0..=100.0).contains(&percentile)),
                "`assess.expect.percentile` of `{name}` must be between 0 and 100, not {percentile:?}"
            );
            ensure!(
                at_most.or(*at_least).is_some_and(f64::is_finite),
                "`assess.expect` of `{name}` must have a number for `at_most` or `at_least`"
            );
        }
        Ok(())
    }

    /// Refuses a flight of `duration_s` that ends before what is judged of it; it may be flown all the same.
    ///
    /// # Errors
    /// The key to look at.
    pub fn require_part_of(&self, duration_s: f64) -> Result<()> {
        let to_s = self.to_s.unwrap_or(duration_s);
        ensure!(
            self.from_s < to_s && to_s <= duration_s,
            "`assess` must be a part of the flight, not from {} to {to_s} of {duration_s} s",
            self.from_s
        );
        Ok(())
    }
}
