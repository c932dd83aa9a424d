//! Gyro and accelerometer.
//!
//! ```text
//! read = round(clip((I + scale + misalignment) true + bias + vibration + white noise))
//! bias = turn-on + Gauss–Markov + random walk + coefficient · warming up
//! ```
//!
//! White noise of the one-sided density n (unit/√Hz), band-limited to half the sampling rate fs, has the deviation
//! n √(fs/2) a sample; its Allan deviation over T is n/√(2T).

use anyhow::Result;
use firmware::sensors::ImuSample;
use firmware::signals::Tick;
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::check::Check;
use super::process::{GaussMarkov, Period, TICKS_PER_S, WarmUp, quantise};
use super::vibration::{Shaking, Vibration};
use super::{Model, Truth};
use crate::noise::gaussian::{Source, Stream};

/// Ticks between two steps of the biases, which are slow.
const BIAS_TICKS: u32 = 10;
/// The same, s.
const BIAS_STEP_S: f64 = 0.01;

/// Data sheet of three axes, in the unit of the table: °/s for the gyro, m/s² for the accelerometer. Deviations are
/// over the seeds, per axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Triad {
    /// One-sided density of the white noise, unit/√Hz, per axis.
    pub noise_density: [f64; 3],
    /// Deviation of the Gauss–Markov bias; its Allan deviation is 0.62 of it at most, after 1.9 correlation times.
    pub bias_instability: f64,
    /// Its correlation time, s.
    pub bias_time_s: f64,
    /// Random walk of the bias, unit/√s.
    pub bias_walk: f64,
    /// Deviation of the turn-on bias that calibration does not remove.
    pub turn_on_bias: f64,
    /// Deviation of the scale error.
    pub scale_error: f64,
    /// Deviation of the misalignment towards another axis.
    pub misalignment: f64,
    /// Deviation of the bias' temperature coefficient, unit/K.
    pub bias_per_k: f64,
    /// Resolution.
    pub resolution: f64,
    /// Range, ±.
    pub range: f64,
}

/// Data sheet of an IMU; it measures every tick and delivers without latency.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Imu {
    /// Name of the built-in part that the values are from, but for those that differ; none if they are from a file.
    pub part: Option<String>,
    /// In °/s.
    pub gyro: Triad,
    /// In m/s².
    pub accel: Triad,
    /// Warm-up of the board.
    pub warm_up: WarmUp,
    /// Vibration from the rotors.
    pub vibration: Vibration,
}

impl Triad {
    fn validate(&self, check: &Check) -> Result<()> {
        self.noise_density.iter().try_for_each(|density| check.within(0.0, 100.0, &[("noise_density", *density)]))?;
        check.within(
            0.0,
            100.0,
            &[
                ("bias_instability", self.bias_instability),
                ("bias_walk", self.bias_walk),
                ("turn_on_bias", self.turn_on_bias),
                ("bias_per_k", self.bias_per_k),
                ("resolution", self.resolution),
            ],
        )?;
        check.within(0.0, 0.5, &[("scale_error", self.scale_error), ("misalignment", self.misalignment)])?;
        check.within(0.1, 1e6, &[("bias_time_s", self.bias_time_s)])?;
        check.within(1.0, 1e5, &[("range", self.range)])
    }
}

impl Imu {
    /// # Errors
    /// The first key that is out of range.
    pub(super) fn validate(&self) -> Result<()> {
        self.gyro.validate(&Check("imu.gyro"))?;
        self.accel.validate(&Check("imu.accel"))?;
        self.warm_up.validate(&Check("imu"))?;
        self.vibration.validate()
    }
}

/// The random streams of three axes.
struct Sources {
    errors: Source,
    noise: Source,
    bias: Source,
}

/// Three axes with errors drawn from a seed, in the unit of their table.
#[derive(Clone, Debug)]
struct Axes {
    /// I + scale + misalignment.
    gain: Matrix3<f64>,
    turn_on: Vector3<f64>,
    /// unit/K.
    warmth: Vector3<f64>,
    /// Deviation of the white noise of a sample.
    sigma: Vector3<f64>,
    instability: GaussMarkov,
    walk: Vector3<f64>,
    /// Deviation of what a step adds to the walk.
    walk_kick: f64,
    /// The total bias, as of the last step.
    bias: Vector3<f64>,
    resolution: f64,
    range: f64,
    noise: Stream,
    biases: Stream,
}

impl Axes {
    fn new(triad: &Triad, sources: &Sources, seed: u64) -> Self {
        let mut errors = Stream::new(seed, sources.errors);
        let turn_on = errors.normal_vector() * triad.turn_on_bias;
        let warmth = errors.normal_vector() * triad.bias_per_k;
        let scale = errors.normal_vector() * triad.scale_error;
        let columns: [Vector3<f64>; 3] = core::array::from_fn(|_| errors.normal_vector() * triad.misalignment);
        let mut gain = Matrix3::from_columns(&columns);
        gain.set_diagonal(&scale.add_scalar(1.0));
        let mut biases = Stream::new(seed, sources.bias);
        let sigma = Vector3::repeat(triad.bias_instability);
        Self {
            gain,
            turn_on,
            warmth,
            sigma: Vector3::from(triad.noise_density) * (0.5 * TICKS_PER_S).sqrt(),
            instability: GaussMarkov::new(&mut biases, sigma, triad.bias_time_s, BIAS_STEP_S),
            walk: Vector3::zeros(),
            walk_kick: triad.bias_walk * BIAS_STEP_S.sqrt(),
            bias: turn_on,
            resolution: triad.resolution,
            range: triad.range,
            noise: Stream::new(seed, sources.noise),
            biases,
        }
    }

    /// Advances the bias by a step; the board is warmer than at calibration by `warmer_k`.
    fn step_bias(&mut self, warmer_k: f64) {
        let wandering = self.instability.sample(&mut self.biases) + self.walk;
        self.bias = self.turn_on + wandering + self.warmth * warmer_k;
        self.walk += self.biases.normal_vector() * self.walk_kick;
    }

    /// The error of a reading without noise and quantisation.
    fn error(&self, value: &Vector3<f64>) -> Vector3<f64> {
        self.gain * value + self.bias - value
    }

    /// The reading of a true value.
    fn read(&mut self, value: &Vector3<f64>) -> Vector3<f64> {
        let noise = self.sigma.component_mul(&self.noise.normal_vector());
        let sensed = self.gain * value + self.bias + noise;
        sensed.map(|value| quantise(value.clamp(-self.range, self.range), self.resolution))
    }
}

/// An IMU with errors drawn from a seed.
#[derive(Clone, Debug)]
pub(super) struct InertialUnit {
    gyro: Axes,
    accel: Axes,
    warm_up: WarmUp,
    shaking: Shaking,
}

impl InertialUnit {
    pub(super) fn new(spec: &Imu, seed: u64) -> Self {
        let gyro = Sources { errors: Source::GyroErrors, noise: Source::GyroNoise, bias: Source::GyroBias };
        let accel = Sources { errors: Source::AccelErrors, noise: Source::AccelNoise, bias: Source::AccelBias };
        Self {
            gyro: Axes::new(&spec.gyro, &gyro, seed),
            accel: Axes::new(&spec.accel, &accel, seed),
            warm_up: spec.warm_up,
            shaking: Shaking::new(&spec.vibration, seed),
        }
    }

    /// Errors at rates (rad/s) and a specific force (m/s²), without noise, quantisation and vibration.
    pub(super) fn error(&self, rates: &Vector3<f64>, force: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let gyro_deg_s = self.gyro.error(&rates.map(f64::to_degrees));
        (gyro_deg_s.map(f64::to_radians), self.accel.error(force))
    }

    fn step_biases(&mut self, tick: Tick) {
        if tick.is_multiple_of(BIAS_TICKS) {
            let warmer_k = self.warm_up.at(tick);
            self.gyro.step_bias(warmer_k);
            self.accel.step_bias(warmer_k);
        }
    }
}

impl Model for InertialUnit {
    type Sample = ImuSample;

    fn period(&self) -> Period {
        Period::EVERY_TICK
    }

    fn delay(&mut self) -> u32 {
        0
    }

    fn measure(&mut self, truth: &Truth) -> ImuSample {
        self.step_biases(truth.tick);
        let (rates, force) = self.shaking.sample(&truth.omega);
        let rates_deg_s = (truth.motion.rates + rates).map(f64::to_degrees);
        let gyro = self.gyro.read(&rates_deg_s).map(f64::to_radians);
        let accel = self.accel.read(&(truth.specific_force + force));
        ImuSample { at: truth.tick, gyro: gyro.cast(), accel: accel.cast() }
    }
}

#[cfg(test)]
mod tests;
