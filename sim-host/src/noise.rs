//! Seeded Gaussian disturbances: one counter-based stream a source, so that adding a source changes no other.

use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng as _, SeedableRng as _};

use crate::plant::Push;
use crate::scenario::Disturbance;

/// Where a stream of random numbers is used. The numbers are part of what a seed means: do not reuse one.
#[derive(Clone, Copy, Debug)]
enum Source {
    Acceleration = 1,
    AngularAcceleration = 2,
    PositionOutput = 3,
    AngleOutput = 4,
}

/// Three Gaussian numbers at a time from one stream.
#[derive(Clone, Debug)]
struct Stream {
    rng: ChaCha8Rng,
    sigma: f64,
}

impl Stream {
    fn new(seed: u64, source: Source, sigma: f64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(source as u64);
        Self { rng, sigma }
    }

    fn sample(&mut self) -> Vector3<f64> {
        let ((x, y), (z, _)) = (self.normal_pair(), self.normal_pair());
        Vector3::new(x, y, z) * self.sigma
    }

    /// Two independent standard normal numbers (Box and Muller 1958), from `libm` alone: the same on every platform,
    /// which a library that may take its logarithms from the system does not promise.
    fn normal_pair(&mut self) -> (f64, f64) {
        let radius = (-2.0 * libm::log(self.unit())).sqrt();
        let (sin, cos) = libm::sincos(core::f64::consts::TAU * self.unit());
        (radius * cos, radius * sin)
    }

    /// Uniform in 0 < u ≤ 1, of 53 bits.
    fn unit(&mut self) -> f64 {
        ((self.rng.next_u64() >> 11) + 1) as f64 / (1_u64 << 53) as f64
    }
}

/// What disturbs the flight at a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Disturbed {
    /// On the plant.
    pub push: Push,
    /// On the measured position, m.
    pub position: Vector3<f64>,
    /// On the measured angles, rad.
    pub angles: Vector3<f64>,
}

impl Disturbed {
    /// Whether it falsifies what is measured.
    #[inline]
    pub fn is_on_outputs(&self) -> bool {
        self.position != Vector3::zeros() || self.angles != Vector3::zeros()
    }
}

/// A scenario's disturbances, sample by sample.
#[derive(Clone, Debug)]
pub struct Noise {
    ticks: core::ops::Range<u32>,
    hold: u32,
    acceleration: Stream,
    angular_acceleration: Stream,
    position: Stream,
    angles: Stream,
    now: Disturbed,
}

impl Noise {
    /// The disturbances of a scenario under a seed; `ticks_per_s` is how often [`at`](Self::at) is asked.
    pub fn new(disturbance: Option<&Disturbance>, seed: u64, ticks_per_s: f64) -> Self {
        let d = disturbance.copied().unwrap_or_default();
        let ticks = |seconds: f64| (seconds * ticks_per_s).round() as u32;
        Self {
            ticks: ticks(d.from_s)..ticks(d.to_s),
            hold: ticks(d.hold_s).max(1),
            acceleration: Stream::new(seed, Source::Acceleration, d.acceleration_m_s2),
            angular_acceleration: Stream::new(seed, Source::AngularAcceleration, d.angular_acceleration_rad_s2),
            position: Stream::new(seed, Source::PositionOutput, d.position_output_m),
            angles: Stream::new(seed, Source::AngleOutput, d.angle_output_rad),
            now: Disturbed::default(),
        }
    }

    /// What acts at `tick`. To be asked for each tick in turn.
    #[inline]
    pub fn at(&mut self, tick: u32) -> &Disturbed {
        if self.ticks.contains(&tick) {
            if (tick - self.ticks.start).is_multiple_of(self.hold) {
                self.draw();
            }
        } else if tick == self.ticks.end {
            self.now = Disturbed::default();
        }
        &self.now
    }

    fn draw(&mut self) {
        self.now = Disturbed {
            push: Push {
                acceleration: self.acceleration.sample(),
                angular_acceleration: self.angular_acceleration.sample(),
            },
            position: self.position.sample(),
            angles: self.angles.sample(),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_held_have_the_stated_deviation_and_stop() {
        let disturbance =
            Disturbance { from_s: 1.0, to_s: 21.0, hold_s: 0.002, acceleration_m_s2: 2.0, ..Disturbance::default() };
        let mut noise = Noise::new(Some(&disturbance), 7, 1000.0);
        let samples: Vec<Vector3<f64>> = (0..22_000).map(|tick| noise.at(tick).push.acceleration).collect();
        assert!(samples[..1000].iter().chain(&samples[21_000..]).all(|v| *v == Vector3::zeros()));
        assert!(samples[1000..21_000].chunks(2).all(|pair| pair[0] == pair[1]));
        let square: f64 = samples[1000..21_000].iter().map(Vector3::norm_squared).sum::<f64>() / 60_000.0;
        // 30,000 independent samples: the deviation is known to 2.0·(1 ± 3/√60,000).
        assert!((square.sqrt() - 2.0).abs() < 0.03, "{}", square.sqrt());
    }

    #[test]
    fn a_seed_means_the_same_numbers_on_every_platform() {
        // Made once, on x86-64 Linux; what changes them changes every disturbed flight.
        let mut stream = Stream::new(1, Source::Acceleration, 1.0);
        let bits: Vec<u64> = stream.sample().iter().map(|v| v.to_bits()).collect();
        assert_eq!(bits, [4_603_016_073_665_546_400, 4_595_582_661_899_543_185, 4_606_018_111_832_256_684]);
        let sum = (0..100_000)
            .fold(0_u64, |sum, _| stream.sample().iter().fold(sum, |sum, v| sum.rotate_left(5) ^ v.to_bits()));
        assert_eq!(sum, 11_237_696_190_688_973_650);
    }

    #[test]
    fn one_source_does_not_change_another() {
        let base =
            Disturbance { from_s: 0.0, to_s: 1.0, hold_s: 0.001, acceleration_m_s2: 1.0, ..Disturbance::default() };
        let more = Disturbance { angular_acceleration_rad_s2: 5.0, ..base };
        let (mut a, mut b) = (Noise::new(Some(&base), 3, 1000.0), Noise::new(Some(&more), 3, 1000.0));
        assert!((0..1000).all(|tick| a.at(tick).push.acceleration == b.at(tick).push.acceleration));
        let mut other = Noise::new(Some(&base), 4, 1000.0);
        assert_ne!(other.at(0).push, Noise::new(Some(&base), 3, 1000.0).at(0).push);
    }
}
