//! Seeded randomness of the world: disturbances, wind, tumbling starts.

pub mod dryden;
pub(crate) mod gaussian;
pub mod gust;
pub mod tumble;

use nalgebra::Vector3;

use crate::plant::Push;
use crate::world::Disturbance;
use gaussian::{Source, Stream};

/// Vectors of three Gaussian numbers of mean 0.
#[derive(Clone, Debug)]
struct Samples {
    stream: Stream,
    sigma: f64,
}

impl Samples {
    fn new(seed: u64, source: Source, sigma: f64) -> Self {
        Self { stream: Stream::new(seed, source), sigma }
    }

    fn draw(&mut self) -> Vector3<f64> {
        self.stream.normal_vector() * self.sigma
    }
}

/// A test signal, white from tick to tick: vectors of three Gaussian numbers of mean 0.
#[derive(Clone, Debug)]
pub struct White(Samples);

impl White {
    /// With a standard deviation per component.
    pub fn new(seed: u64, sigma: f64) -> Self {
        Self(Samples::new(seed, Source::Test, sigma))
    }

    /// The next three.
    pub fn draw(&mut self) -> Vector3<f64> {
        self.0.draw()
    }
}

/// Disturbances at a tick.
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
    /// Whether it disturbs measurements.
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
    acceleration: Samples,
    angular_acceleration: Samples,
    position: Samples,
    angles: Samples,
    now: Disturbed,
}

impl Noise {
    /// The disturbances of a scenario under a seed; `ticks_per_s` is the rate at which [`at`](Self::at) is called.
    pub fn new(disturbance: Option<&Disturbance>, seed: u64, ticks_per_s: f64) -> Self {
        let d = disturbance.copied().unwrap_or_default();
        let ticks = |seconds: f64| (seconds * ticks_per_s).round() as u32;
        Self {
            ticks: ticks(d.from_s)..ticks(d.to_s),
            hold: ticks(d.hold_s).max(1),
            acceleration: Samples::new(seed, Source::Acceleration, d.acceleration_m_s2),
            angular_acceleration: Samples::new(seed, Source::AngularAcceleration, d.angular_acceleration_rad_s2),
            position: Samples::new(seed, Source::PositionOutput, d.position_output_m),
            angles: Samples::new(seed, Source::AngleOutput, d.angle_output_rad),
            now: Disturbed::default(),
        }
    }

    /// The disturbances at `tick`. Call once per tick, in order; [`now`](Self::now) returns them again.
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

    /// The disturbances of the last call.
    #[inline]
    pub fn now(&self) -> &Disturbed {
        &self.now
    }

    fn draw(&mut self) {
        self.now = Disturbed {
            push: Push {
                acceleration: self.acceleration.draw(),
                angular_acceleration: self.angular_acceleration.draw(),
            },
            position: self.position.draw(),
            angles: self.angles.draw(),
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
