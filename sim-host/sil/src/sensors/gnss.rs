//! GNSS receiver: position on the ellipsoid and velocity, late, with errors that are correlated over half an hour.

use anyhow::Result;
use firmware::sensors::GnssSample;
use firmware::signals::TICK_US;
use glissade_files::refusal::within;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::check::Check;
use super::home::Home;
use super::process::{GaussMarkov, Period, ticks};
use super::{Model, Truth};
use crate::geodesy::LocalFrame;
use crate::noise::gaussian::{Source, Stream};

/// UTC at the start of every flight, µs since 1970: noon of 2026-01-01. A constant, so that a flight is the same
/// whenever it is simulated.
pub const START_UTC_US: u64 = 1_767_268_800_000_000;

/// Data sheet of a receiver. Deviations are per component.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gnss {
    /// Name of the built-in part that the values are from, but for those that differ; none if they are from a file.
    pub part: Option<String>,
    /// Solution rate, Hz.
    pub rate_hz: f64,
    /// Latency: from the time of a solution to its delivery, s.
    pub delay_s: f64,
    /// Jitter of the latency, ± s, uniform; less than half a period, so that solutions arrive in order.
    pub jitter_s: f64,
    /// Deviation of the drifting error per horizontal axis, m.
    pub horizontal_m: f64,
    /// The same for the height, m.
    pub vertical_m: f64,
    /// Correlation time of these, s.
    pub wander_time_s: f64,
    /// White noise of each horizontal axis, m.
    pub horizontal_noise_m: f64,
    /// White noise of the height, m.
    pub vertical_noise_m: f64,
    /// Deviation of the horizontal velocity's error, m/s.
    pub speed_m_s: f64,
    /// Deviation of the vertical velocity's error, m/s.
    pub climb_m_s: f64,
    /// Correlation time of these, s.
    pub speed_time_s: f64,
}

impl Gnss {
    /// # Errors
    /// The first key that is out of range.
    pub(super) fn validate(&self) -> Result<()> {
        let check = Check("gnss");
        check.rate(self.rate_hz)?;
        check.fused_latency(self.delay_s, 0.0)?;
        let jitter_max_s = self.delay_s.min(0.49 / self.rate_hz);
        within("sensors.gnss.jitter_s", self.jitter_s, 0.0, jitter_max_s)?;
        check.fused_latency(self.delay_s, self.jitter_s)?;
        check.within(
            0.0,
            1e3,
            &[
                ("horizontal_m", self.horizontal_m),
                ("vertical_m", self.vertical_m),
                ("horizontal_noise_m", self.horizontal_noise_m),
                ("vertical_noise_m", self.vertical_noise_m),
                ("speed_m_s", self.speed_m_s),
                ("climb_m_s", self.climb_m_s),
            ],
        )?;
        let times = [("wander_time_s", self.wander_time_s), ("speed_time_s", self.speed_time_s)];
        check.within(1e-3, 1e6, &times)
    }
}

/// A receiver with errors drawn from a seed.
#[derive(Clone, Debug)]
pub(super) struct Receiver {
    period: Period,
    spec: Gnss,
    frame: LocalFrame,
    /// Of the geoid from the ellipsoid, mm.
    separation_mm: i32,
    place: (Stream, GaussMarkov),
    velocity: (Stream, GaussMarkov),
    noise: Stream,
    jitter: Stream,
}

impl Receiver {
    pub(super) fn new(spec: &Gnss, home: &Home, seed: u64) -> Self {
        let period = Period::of_rate(spec.rate_hz);
        let process = |source, horizontal: f64, vertical: f64, time_s| {
            let mut stream = Stream::new(seed, source);
            let sigma = Vector3::new(horizontal, horizontal, vertical);
            let process = GaussMarkov::new(&mut stream, sigma, time_s, period.seconds());
            (stream, process)
        };
        Self {
            period,
            spec: spec.clone(),
            frame: LocalFrame::at(&home.place()),
            separation_mm: (home.geoid_m * 1e3).round() as i32,
            place: process(Source::GnssPlace, spec.horizontal_m, spec.vertical_m, spec.wander_time_s),
            velocity: process(Source::GnssVelocity, spec.speed_m_s, spec.climb_m_s, spec.speed_time_s),
            noise: Stream::new(seed, Source::GnssNoise),
            jitter: Stream::new(seed, Source::GnssJitter),
        }
    }
}

impl Model for Receiver {
    type Sample = GnssSample;

    fn period(&self) -> Period {
        self.period
    }

    /// The latency of the next solution, ticks: drawn for each one.
    fn delay(&mut self) -> u32 {
        ticks(self.spec.delay_s + self.spec.jitter_s * (2.0 * self.jitter.unit() - 1.0))
    }

    /// The velocity is in the axes at home; 1 km away the local axes differ by 0.16 mrad.
    fn measure(&mut self, truth: &Truth) -> GnssSample {
        let spec = &self.spec;
        let white = Vector3::new(spec.horizontal_noise_m, spec.horizontal_noise_m, spec.vertical_noise_m);
        let wander = self.place.1.sample(&mut self.place.0);
        let error = wander + self.noise.normal_vector().component_mul(&white);
        let velocity = truth.motion.velocity + self.velocity.1.sample(&mut self.velocity.0);
        GnssSample {
            at: truth.tick,
            has_fix: true,
            place: self.frame.place(&(truth.motion.position + error)).rounded(),
            velocity: velocity.cast(),
            horizontal_accuracy_m: libm::hypot(spec.horizontal_m, spec.horizontal_noise_m) as f32,
            vertical_accuracy_m: libm::hypot(spec.vertical_m, spec.vertical_noise_m) as f32,
            speed_accuracy_m_s: spec.speed_m_s.max(spec.climb_m_s) as f32,
            separation_mm: self.separation_mm,
            utc_us: Some(START_UTC_US + u64::from(truth.tick) * u64::from(TICK_US)),
        }
    }
}
