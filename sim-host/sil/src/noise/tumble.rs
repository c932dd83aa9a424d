//! A tumbling start, drawn from the seed.

use nalgebra::{Quaternion, Vector3};

use super::gaussian::{Source, Stream};
use crate::plant::Motion;
use crate::world::Tumble;

/// A motion at `position` (m): attitude uniform over the rotations, body rates and velocity each uniform in direction.
pub fn draw(tumble: &Tumble, position: Vector3<f64>, seed: u64) -> Motion {
    let mut stream = Stream::new(seed, Source::Tumble);
    let attitude = rotation(&mut stream);
    let rates = stream.direction() * tumble.rate_rad_s;
    let velocity = stream.direction() * tumble.speed_m_s;
    Motion { position, velocity, attitude, rates }
}

/// Uniform over the rotations (Shoemake, "Uniform random rotations", Graphics Gems III, 1992).
fn rotation(stream: &mut Stream) -> Quaternion<f64> {
    let part = stream.unit();
    let (sin_1, cos_1) = libm::sincos(core::f64::consts::TAU * stream.unit());
    let (sin_2, cos_2) = libm::sincos(core::f64::consts::TAU * stream.unit());
    let (near, far) = ((1.0 - part).sqrt(), part.sqrt());
    Quaternion::new(far * cos_2, near * sin_1, near * cos_1, far * sin_2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix3, UnitQuaternion};

    const TUMBLE: Tumble = Tumble { rate_rad_s: 10.0, speed_m_s: 3.0 };
    const STARTS: u64 = 20_000;

    fn starts() -> impl Iterator<Item = Motion> {
        (0..STARTS).map(|seed| draw(&TUMBLE, Vector3::zeros(), seed))
    }

    /// Of independent vectors uniform on the sphere, the mean is 0 and the mean of v vᵀ is 1/3 on the diagonal.
    fn assert_isotropic(vectors: impl Iterator<Item = Vector3<f64>>) {
        let n = STARTS as f64;
        let (mut mean, mut square) = (Vector3::zeros(), Matrix3::zeros());
        for v in vectors {
            mean += v / n;
            square += v * v.transpose() / n;
        }
        // Each component has variance 1/3, its square 4/45, a product of two 1/15: 4.5 standard errors.
        let four_and_a_half = |variance: f64| 4.5 * (variance / n).sqrt();
        assert!(mean.amax() < four_and_a_half(1.0 / 3.0), "{mean}");
        let excess = square - Matrix3::identity() / 3.0;
        assert!(excess.amax() < four_and_a_half(4.0 / 45.0), "{excess}");
    }

    #[test]
    fn rates_and_velocity_have_their_sizes_in_every_direction() {
        for motion in starts() {
            assert!((motion.rates.norm() - 10.0).abs() < 1e-12 && (motion.velocity.norm() - 3.0).abs() < 1e-12);
            assert!((motion.attitude.norm() - 1.0).abs() < 1e-12);
        }
        assert_isotropic(starts().map(|motion| motion.rates / 10.0));
        assert_isotropic(starts().map(|motion| motion.velocity / 3.0));
    }

    #[test]
    fn attitudes_are_uniform_over_the_rotations() {
        // A uniform rotation takes each axis everywhere alike, and turns by angles of density (1 − cos θ)/π, whose
        // cosine has the mean −1/2 and the variance 1/4.
        let attitudes = || starts().map(|motion| UnitQuaternion::new_normalize(motion.attitude));
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            assert_isotropic(attitudes().map(|attitude| attitude * axis));
        }
        let mean = attitudes().map(|q| 2.0 * q.w * q.w - 1.0).sum::<f64>() / STARTS as f64;
        assert!((mean + 0.5).abs() < 4.5 * (0.25 / STARTS as f64).sqrt(), "{mean}");
    }

    #[test]
    fn a_seed_is_a_start() {
        let at = |seed| draw(&TUMBLE, Vector3::zeros(), seed);
        assert_eq!(at(7), at(7));
        assert_ne!(at(7), at(8));
    }
}
