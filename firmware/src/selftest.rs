//! A hash over the mathematics of flight, to check that desktop and target compute the same bits.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::math;

/// FNV-1a over the bits of f32 values.
struct Hash(u64);

impl Hash {
    fn take(&mut self, value: f32) {
        // The bits of NaN are not defined. None should occur here, but one must not make hashes differ.
        let bits = if value.is_nan() { 0x7fc0_0000 } else { value.to_bits() };
        for byte in bits.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

/// Numbers spread over many magnitudes and both signs (a linear congruential generator).
struct Numbers(u32);

impl Numbers {
    /// In −1..1.
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        // 24 bits, so that the conversion is exact.
        (self.0.cast_signed() >> 8) as f32 * (1.0 / 8_388_608.0)
    }

    fn vector(&mut self, scale: f32) -> Vector3<f32> {
        Vector3::new(self.unit(), self.unit(), self.unit()) * scale
    }
}

/// Hash of `steps` steps through every function of `math` and the quaternion and matrix operations used in flight.
pub fn math_hash(steps: u32) -> u64 {
    let mut hash = Hash(0xcbf2_9ce4_8422_2325);
    let mut numbers = Numbers(1);
    let mut attitude = UnitQuaternion::identity();
    for step in 0..steps {
        scalars(&mut hash, &mut numbers, step);
        attitude = rotations(&mut hash, &mut numbers, attitude);
    }
    hash.0
}

fn scalars(hash: &mut Hash, numbers: &mut Numbers, step: u32) {
    let (a, b) = (numbers.unit(), numbers.unit());
    let angle = 7.0 * a;
    let (sine, cosine) = math::sin_cos(angle);
    let phase = math::Phase::new(3.0 * b, 1e-3).at(step.wrapping_mul(977));
    let powers = [0.25, 0.5, 0.75].map(|exponent| math::shape_power(math::abs(30.0 * b), exponent));
    let extremes = [math::max(-0.0, 0.0 * a), math::min(0.0, 0.0 * b), math::clamp(a, -0.5, 0.5)];
    let others = [
        math::sqrt(math::abs(100.0 * a)),
        math::sqrt(math::abs(a * b * 1e-20)),
        math::atan2(a, b),
        math::atan2(a, 1.01 * b),
        math::tanh(4.0 * b),
        math::wrap_angle(angle + 3.0 * b),
    ];
    let roots = math::sqrt_each([a, b, a * b, 1e20 * a].map(math::abs));
    for value in [sine, cosine, phase].into_iter().chain(powers).chain(extremes).chain(others).chain(roots) {
        hash.take(value);
    }
}

fn rotations(hash: &mut Hash, numbers: &mut Numbers, attitude: UnitQuaternion<f32>) -> UnitQuaternion<f32> {
    let half = numbers.vector(0.1);
    let step = Quaternion::new(1.0, half.x, half.y, half.z);
    let product = attitude.quaternion() * step;
    let next = UnitQuaternion::new_unchecked(product / math::sqrt(product.norm_squared()));
    let turned = next * numbers.vector(10.0);
    let back = next.inverse() * turned;
    let matrix = next.to_rotation_matrix();
    let sum = matrix.matrix() * turned + turned.cross(&back) * turned.dot(&back);
    for value in next.coords.iter().chain(turned.iter()).chain(back.iter()).chain(sum.iter()) {
        hash.take(*value);
    }
    next
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_sees_every_step() {
        assert_eq!(math_hash(100), math_hash(100));
        assert_ne!(math_hash(100), math_hash(101));
    }
}
