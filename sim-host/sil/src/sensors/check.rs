//! Range checks of the sensors' data sheets.

use anyhow::Result;
use glissade_files::refusal::{Refusal, within};

use super::process::TICKS_PER_S;

/// Longest latency of a fault-free sensor, s.
pub(super) const LATENCY_MAX_S: f64 = 1.0;

/// Checks of a sensor's values, named by their keys below `sensors.<sensor>`.
pub(super) struct Check(pub(super) &'static str);

impl Check {
    fn key(&self, key: &str) -> String {
        format!("sensors.{}.{key}", self.0)
    }

    /// Checks that values are within `low ..= high`.
    pub(super) fn within(&self, low: f64, high: f64, values: &[(&str, f64)]) -> Result<()> {
        values.iter().try_for_each(|(key, value)| within(&self.key(key), *value, low, high))
    }

    /// Checks that a rate has a period of whole ticks.
    pub(super) fn rate(&self, rate_hz: f64) -> Result<()> {
        let (key, period) = (self.key("rate_hz"), TICKS_PER_S / rate_hz);
        within(&key, rate_hz, 0.1, TICKS_PER_S)?;
        if (period - period.round()).abs() < 1e-6 {
            return Ok(());
        }
        let remedy = "use a rate that divides 1000, as 1, 2, 4, 5, 8, 10, 20, 25, 40, 50 or 100";
        Err(Refusal::new(key, "must make a period of whole milliseconds").given(rate_hz).remedy(remedy).into())
    }

    /// Checks a latency, s.
    pub(super) fn latency(&self, key: &str, seconds: f64) -> Result<()> {
        within(&self.key(key), seconds, 0.0, LATENCY_MAX_S)
    }
}
