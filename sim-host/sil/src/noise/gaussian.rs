//! Random numbers: one counter-based stream per source, so that adding a source changes no other.

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng as _, SeedableRng as _};
use nalgebra::Vector3;

/// Source of a stream of random numbers. The discriminants determine the streams of a seed: do not reuse one.
#[derive(Clone, Copy, Debug)]
#[repr(u64)]
pub(crate) enum Source {
    Acceleration = 1,
    AngularAcceleration = 2,
    PositionOutput = 3,
    AngleOutput = 4,
    Tumble = 5,
    WindAlong = 6,
    WindAcross = 7,
    WindVertical = 8,
    /// Constant errors of a sensor: biases, scales, misalignments.
    GyroErrors = 16,
    GyroNoise = 17,
    GyroBias = 18,
    AccelErrors = 19,
    AccelNoise = 20,
    AccelBias = 21,
    Vibration = 22,
    MagErrors = 23,
    MagNoise = 24,
    BaroErrors = 25,
    BaroNoise = 26,
    BaroDrift = 27,
    GnssPlace = 28,
    GnssVelocity = 29,
    GnssNoise = 30,
    GnssJitter = 31,
    PoseNoise = 32,
    BatteryNoise = 33,
    /// Test signal of an analysis.
    Test = 64,
    /// The first fault; the others follow it.
    Fault = 1 << 32,
}

/// The random stream of one source.
#[derive(Debug)]
pub(crate) struct Stream {
    rng: ChaCha8Rng,
}

/// A copy that goes on as the original does. The generator cannot be cloned, lest a key be used twice by accident; its
/// state can be taken.
impl Clone for Stream {
    fn clone(&self) -> Self {
        Self { rng: ChaCha8Rng::deserialize_state(&self.rng.serialize_state()) }
    }
}

impl Stream {
    pub(crate) fn new(seed: u64, source: Source) -> Self {
        Self::numbered(seed, source as u64)
    }

    /// The stream of a fault, counted from 0.
    pub(crate) fn of_fault(seed: u64, number: u32) -> Self {
        Self::numbered(seed, Source::Fault as u64 + u64::from(number))
    }

    fn numbered(seed: u64, number: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(number);
        Self { rng }
    }

    /// Three independent standard normal numbers.
    pub(crate) fn normal_vector(&mut self) -> Vector3<f64> {
        let ((x, y), (z, _)) = (self.normal_pair(), self.normal_pair());
        Vector3::new(x, y, z)
    }

    /// Two independent standard normal numbers (Box and Muller 1958), with `libm` only: the same on every platform,
    /// which a library that uses the system's logarithm does not guarantee.
    pub(crate) fn normal_pair(&mut self) -> (f64, f64) {
        let radius = (-2.0 * libm::log(self.unit())).sqrt();
        let (sin, cos) = libm::sincos(core::f64::consts::TAU * self.unit());
        (radius * cos, radius * sin)
    }

    /// Uniform in 0 < u ≤ 1, of 53 bits.
    pub(crate) fn unit(&mut self) -> f64 {
        ((self.rng.next_u64() >> 11) + 1) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform on the unit sphere, whose height is uniform (Archimedes).
    pub(crate) fn direction(&mut self) -> Vector3<f64> {
        let height = 2.0 * self.unit() - 1.0;
        let (sin, cos) = libm::sincos(core::f64::consts::TAU * self.unit());
        let radius = (1.0 - height * height).sqrt();
        Vector3::new(radius * cos, radius * sin, height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_means_the_same_numbers_on_every_platform() {
        // Recorded once, on x86-64 Linux; a change here changes every disturbed flight.
        let mut stream = Stream::new(1, Source::Acceleration);
        let bits: Vec<u64> = stream.normal_vector().iter().map(|v| v.to_bits()).collect();
        assert_eq!(bits, [4_603_016_073_665_546_400, 4_595_582_661_899_543_185, 4_606_018_111_832_256_684]);
        let sum = (0..100_000)
            .fold(0_u64, |sum, _| stream.normal_vector().iter().fold(sum, |sum, v| sum.rotate_left(5) ^ v.to_bits()));
        assert_eq!(sum, 11_237_696_190_688_973_650);
    }

    #[test]
    fn a_copy_goes_on_as_the_original_does() {
        let mut stream = Stream::new(7, Source::AngleOutput);
        for drawn in 0..200 {
            let (mut copy, mut original) = (stream.clone(), stream);
            assert_eq!([(); 200].map(|()| copy.unit()), [(); 200].map(|()| original.unit()), "after {drawn}");
            stream = Stream::new(7, Source::AngleOutput);
            (0..=drawn).for_each(|_| _ = stream.unit());
        }
    }
}
