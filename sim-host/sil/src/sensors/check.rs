//! Range checks of the sensors' data sheets.

use anyhow::Result;
use firmware::estimator::history::LATENCY_MAX;
use glissade_files::refusal::{Refusal, within};

use super::process::{TICKS_PER_S, seconds, ticks};

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

    /// Checks `delay_s`, the latency of readings that the estimator does not fuse.
    pub(super) fn latency(&self, delay_s: f64) -> Result<()> {
        within(&self.key("delay_s"), delay_s, 0.0, LATENCY_MAX_S)
    }

    /// Checks `delay_s`, the latency of readings that the estimator fuses, with their `jitter_s`: what is later than the
    /// motion that it remembers is lost.
    pub(super) fn fused_latency(&self, delay_s: f64, jitter_s: f64) -> Result<()> {
        let (kept_s, most_s) = (seconds(LATENCY_MAX), seconds(LATENCY_MAX.saturating_sub(ticks(jitter_s))));
        if (0.0..=most_s).contains(&delay_s) {
            return Ok(());
        }
        let refusal = Refusal::new(self.key("delay_s"), format!("must be between 0 and {most_s} s")).given(delay_s);
        if delay_s.is_nan() || delay_s < 0.0 {
            return Err(refusal.into());
        }
        let jitter = if jitter_s > 0.0 { format!(", and `jitter_s` is {jitter_s}") } else { String::new() };
        let remedy = format!("shorten it: the estimator fuses what is at most {kept_s} s late{jitter}");
        Err(refusal.remedy(remedy).into())
    }
}
