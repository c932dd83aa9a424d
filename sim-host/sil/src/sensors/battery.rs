//! Battery monitor: voltage and current as a power module reports them.

use anyhow::Result;
use firmware::sensors::BatterySample;
use serde::{Deserialize, Serialize};

use super::check::Check;
use super::process::{Period, quantise, ticks};
use super::{Model, Truth};
use crate::noise::gaussian::{Source, Stream};

/// Data sheet of a battery monitor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Battery {
    /// Name of the built-in part that the values are from, but for those that differ; none if they are from a file.
    pub part: Option<String>,
    /// Sampling rate, Hz.
    pub rate_hz: f64,
    /// Latency: from the measurement to its delivery, s.
    pub delay_s: f64,
    /// White noise of the voltage, V.
    pub voltage_v: f64,
    /// White noise of the current, A.
    pub current_a: f64,
    /// Resolution of the voltage, V.
    pub voltage_resolution_v: f64,
    /// Resolution of the current, A.
    pub current_resolution_a: f64,
}

impl Battery {
    /// # Errors
    /// The first key that is out of range.
    pub(super) fn validate(&self) -> Result<()> {
        let check = Check("battery");
        check.rate(self.rate_hz)?;
        check.latency(self.delay_s)?;
        check.within(
            0.0,
            100.0,
            &[
                ("voltage_v", self.voltage_v),
                ("current_a", self.current_a),
                ("voltage_resolution_v", self.voltage_resolution_v),
                ("current_resolution_a", self.current_resolution_a),
            ],
        )
    }
}

/// A battery monitor with errors drawn from a seed.
#[derive(Clone, Debug)]
pub(super) struct Monitor {
    period: Period,
    delay: u32,
    spec: Battery,
    noise: Stream,
}

impl Monitor {
    pub(super) fn new(spec: &Battery, seed: u64) -> Self {
        Self {
            period: Period::of_rate(spec.rate_hz),
            delay: ticks(spec.delay_s),
            spec: spec.clone(),
            noise: Stream::new(seed, Source::BatteryNoise),
        }
    }
}

impl Model for Monitor {
    type Sample = BatterySample;

    fn period(&self) -> Period {
        self.period
    }

    fn delay(&mut self) -> u32 {
        self.delay
    }

    fn measure(&mut self, truth: &Truth) -> BatterySample {
        let (volts, amperes) = self.noise.normal_pair();
        let spec = &self.spec;
        let voltage = truth.battery.voltage_v + volts * spec.voltage_v;
        let current = truth.battery.current_a + amperes * spec.current_a;
        BatterySample {
            voltage_v: quantise(voltage, spec.voltage_resolution_v) as f32,
            current_a: quantise(current, spec.current_resolution_a) as f32,
        }
    }
}
