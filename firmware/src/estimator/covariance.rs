//! The covariance of the error state, by blocks of three, and the two things that happen to it.
//!
//! ```text
//!      θ        v        p        bg       ba       o                    m
//! ┌ attitude velocity position gyro     accel    GNSS x, GNSS y,      heading,  ┐
//! └ (world)                    bias     bias     height offset        wind x, y ┘
//! ```
//!
//! The attitude's error is a small rotation in the world, `R = Exp(θ) R̂` (the "global" error of Solà 2017, §7): so its
//! own dynamics hold no rotation, and those of velocity and position hold the integrated specific force alone. Over a
//! step of T seconds in which that integral is S,
//!
//! ```text
//! θ ← θ − T R bg      v ← v − S × θ − T R ba      p ← p + T v      (Solà 2017, eq. 283–288, to first order)
//! ```
//!
//! and the rest stands still. Each of the three is a shear of one block row by others, done in place on the upper
//! triangle; that is the whole of F P Fᵀ.

use nalgebra::{Matrix3, SVector, Vector3};

/// Number of states.
pub const STATES: usize = 21;
/// Blocks of three.
const BLOCKS: usize = STATES / 3;

/// Where a state stands.
pub mod index {
    /// Attitude error in the world, rad.
    pub const THETA: usize = 0;
    /// Velocity, m/s.
    pub const VELOCITY: usize = 3;
    /// Position, m.
    pub const POSITION: usize = 6;
    /// Bias of the gyroscope, rad/s.
    pub const GYRO_BIAS: usize = 9;
    /// Bias of the accelerometer, m/s².
    pub const ACCEL_BIAS: usize = 12;
    /// Where the satellites' frame is in the local one, x and y, m.
    pub const OFFSET: usize = 15;
    /// What the source of height reads beyond the height, m.
    pub const HEIGHT_OFFSET: usize = 17;
    /// What the magnetic heading reads beyond the heading, rad.
    pub const HEADING_OFFSET: usize = 18;
    /// Wind, x and y, m/s.
    pub const WIND: usize = 19;
}

/// An error state, or a row of numbers one a state.
pub type ErrorState = SVector<f32, STATES>;

const T: usize = index::THETA / 3;
const V: usize = index::VELOCITY / 3;
const P: usize = index::POSITION / 3;
const G: usize = index::GYRO_BIAS / 3;
const A: usize = index::ACCEL_BIAS / 3;
const O: usize = index::OFFSET / 3;
const M: usize = index::HEADING_OFFSET / 3;

/// What a measurement of one number depends on: all of the attitude, and up to three other states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// By the attitude's error.
    pub theta: Vector3<f32>,
    /// State and factor; a factor of 0 for none.
    pub entries: [(usize, f32); 3],
}

impl Row {
    /// H x.
    #[inline]
    pub fn dot(&self, x: &ErrorState) -> f32 {
        let attitude = self.theta.x * x[0] + self.theta.y * x[1] + self.theta.z * x[2];
        self.entries.iter().fold(attitude, |sum, (state, factor)| sum + factor * entry(x, *state))
    }
}

/// A state's number; 0 for a state that is none.
#[inline]
fn entry(x: &ErrorState, state: usize) -> f32 {
    x.as_slice().get(state).copied().unwrap_or(0.0)
}

/// Process noise of a step: variances that it adds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepNoise {
    /// θ, rad².
    pub theta: Vector3<f32>,
    /// v, (m/s)².
    pub velocity: f32,
    /// bg, (rad/s)².
    pub gyro_bias: f32,
    /// ba, (m/s²)².
    pub accel_bias: f32,
    /// GNSS x and y, height offset, m².
    pub offset: Vector3<f32>,
    /// Heading offset, rad²; wind, (m/s)².
    pub magnetic_wind: Vector3<f32>,
}

/// What moves the error over a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// T, s.
    pub step_s: f32,
    /// R, body to world, of the step's end.
    pub rotation: Matrix3<f32>,
    /// S = ∫ R f dt over the step, m/s.
    pub velocity_change: Vector3<f32>,
}

/// A symmetric 21 × 21 matrix: the blocks on and above the diagonal count.
#[derive(Clone, Debug, PartialEq)]
pub struct Covariance {
    blocks: [[Matrix3<f32>; BLOCKS]; BLOCKS],
}

/// `s × M`, column by column.
#[inline]
fn cross(s: &Vector3<f32>, m: &Matrix3<f32>) -> Matrix3<f32> {
    let turn = |j: usize| {
        let (x, y, z) = (m[(0, j)], m[(1, j)], m[(2, j)]);
        Vector3::new(s.y * z - s.z * y, s.z * x - s.x * z, s.x * y - s.y * x)
    };
    Matrix3::from_columns(&[turn(0), turn(1), turn(2)])
}

impl Covariance {
    /// Independent states with these variances.
    pub fn diagonal(variances: &ErrorState) -> Self {
        let mut covariance = Self { blocks: [[Matrix3::zeros(); BLOCKS]; BLOCKS] };
        for (i, variance) in variances.iter().enumerate() {
            covariance.set_variance(i, *variance);
        }
        covariance
    }

    /// The variance of a state; 0 for a state that is none.
    #[inline]
    pub fn variance(&self, state: usize) -> f32 {
        let (block, axis) = (state / 3, state % 3);
        self.blocks.get(block).and_then(|row| row.get(block)).map_or(0.0, |b| b[(axis, axis)])
    }

    /// The covariance of two states.
    pub fn get(&self, one: usize, other: usize) -> f32 {
        let (i, j) = if one / 3 <= other / 3 { (one, other) } else { (other, one) };
        self.blocks.get(i / 3).and_then(|row| row.get(j / 3)).map_or(0.0, |b| b[(i % 3, j % 3)])
    }

    /// Makes a state independent of all others, with this variance: for one that has been set anew.
    pub fn set_variance(&mut self, state: usize, variance: f32) {
        let (block, axis) = (state / 3, state % 3);
        for (i, row) in self.blocks.iter_mut().enumerate() {
            for (j, b) in row.iter_mut().enumerate().skip(i) {
                if i == block {
                    b.row_mut(axis).fill(0.0);
                }
                if j == block {
                    b.column_mut(axis).fill(0.0);
                }
                if i == block && j == block {
                    b[(axis, axis)] = variance;
                }
            }
        }
    }

    /// Adds to the variance of a state.
    pub fn add_variance(&mut self, state: usize, variance: f32) {
        let (block, axis) = (state / 3, state % 3);
        if let Some(b) = self.blocks.get_mut(block).and_then(|row| row.get_mut(block)) {
            b[(axis, axis)] += variance;
        }
    }

    /// A step: F P Fᵀ + Q.
    pub fn predict(&mut self, motion: &Motion, noise: &StepNoise) {
        self.move_position(motion.step_s);
        self.turn_velocity(&motion.velocity_change, &(motion.rotation * -motion.step_s));
        self.turn_attitude(&(motion.rotation * -motion.step_s));
        self.add_noise(noise);
    }

    /// p ← p + T v.
    #[inline]
    fn move_position(&mut self, step_s: f32) {
        let b = &mut self.blocks;
        let before = b[V][P];
        b[T][P] += b[T][V] * step_s;
        b[V][P] += b[V][V] * step_s;
        b[P][P] += (before.transpose() + b[V][P]) * step_s;
        for other in [G, A, O, M] {
            let change = b[V][other] * step_s;
            b[P][other] += change;
        }
    }

    /// v ← v − S × θ + B ba.
    #[inline]
    fn turn_velocity(&mut self, s: &Vector3<f32>, by_bias: &Matrix3<f32>) {
        let b = &mut self.blocks;
        let minus = -s;
        let (attitude, bias) = (b[T][V], b[V][A]);
        // With the others first: what stands on the diagonal needs the rows before and after.
        for other in [P, G] {
            let change = cross(&minus, &b[T][other]) + by_bias * b[other][A].transpose();
            b[V][other] += change;
        }
        for other in [A, O, M] {
            let change = cross(&minus, &b[T][other]) + by_bias * b[A][other];
            b[V][other] += change;
        }
        // As (θ, v): the transpose of (v, θ) after the step.
        let with_attitude = cross(&minus, &b[T][T]) + by_bias * b[T][A].transpose() + attitude.transpose();
        b[T][V] = with_attitude.transpose();
        let from_before = cross(&minus, &attitude) + by_bias * bias.transpose();
        // (v, θ) (−[S]×)ᵀ = (−S × (v, θ)ᵀ)ᵀ.
        let from_after = cross(&minus, &b[T][V]).transpose() + b[V][A] * by_bias.transpose();
        b[V][V] += from_before + from_after;
    }

    /// θ ← θ + B bg.
    #[inline]
    fn turn_attitude(&mut self, by_bias: &Matrix3<f32>) {
        let b = &mut self.blocks;
        let bias = b[T][G];
        for other in [V, P] {
            let change = by_bias * b[other][G].transpose();
            b[T][other] += change;
        }
        for other in [G, A, O, M] {
            let change = by_bias * b[G][other];
            b[T][other] += change;
        }
        b[T][T] += by_bias * bias.transpose() + b[T][G] * by_bias.transpose();
    }

    #[inline]
    fn add_noise(&mut self, noise: &StepNoise) {
        let mut add = |block: usize, variances: Vector3<f32>| {
            let b = &mut self.blocks[block][block];
            b.m11 += variances.x;
            b.m22 += variances.y;
            b.m33 += variances.z;
        };
        add(T, noise.theta);
        add(V, Vector3::repeat(noise.velocity));
        add(G, Vector3::repeat(noise.gyro_bias));
        add(A, Vector3::repeat(noise.accel_bias));
        add(O, noise.offset);
        add(M, noise.magnetic_wind);
    }

    /// P Hᵀ, into `product`: its 84 bytes are dear to hand about.
    pub fn times(&self, row: &Row, product: &mut ErrorState) {
        let (parts, _) = product.as_mut_slice().as_chunks_mut::<3>();
        let [x, y, z] = row.theta.into();
        for (to, block) in parts.iter_mut().zip(&self.blocks[T]) {
            let columns: &[[f32; 3]; 3] = block.as_ref();
            *to = columns.map(|[a, b, c]| a * x + b * y + c * z);
        }
        for (state, factor) in row.entries {
            if factor != 0.0 {
                self.add_column(state, factor, parts);
            }
        }
    }

    /// Adds a column's multiple: down to the diagonal the column itself, beyond it the row of the same number.
    #[inline]
    fn add_column(&self, state: usize, factor: f32, product: &mut [[f32; 3]]) {
        let (block, axis) = (state / 3, state % 3);
        let Some((above, beyond)) = product.split_at_mut_checked(block) else { return };
        for (to, row) in above.iter_mut().zip(&self.blocks) {
            let columns: &[[f32; 3]; 3] = row[block].as_ref();
            let column = &columns[axis];
            *to = core::array::from_fn(|i| to[i] + column[i] * factor);
        }
        let row = self.blocks.get(block).map_or(&[][..], |row| row.get(block..).unwrap_or_default());
        for (to, b) in beyond.iter_mut().zip(row) {
            let columns: &[[f32; 3]; 3] = b.as_ref();
            *to = core::array::from_fn(|i| to[i] + columns[i][axis] * factor);
        }
    }

    /// The correction by numbers measured, each independent of those before it: Joseph's form for gains K = c/s, with
    /// c = P Hᵀ and s = H c + R,
    ///
    /// ```text
    /// P ← (I − K H) P (I − K H)ᵀ + K R Kᵀ = P − K uᵀ − u Kᵀ,      u = c − s K/2
    /// ```
    ///
    /// to second order indifferent to the gain's rounding. The diagonal is then kept symmetric, and its
    /// variances above what no state is known better than.
    pub fn correct<const N: usize>(&mut self, c: &[ErrorState; N], s: &[f32; N]) {
        let mut parts = [Part::<N>::ZERO; BLOCKS];
        for (n, (c, s)) in c.iter().zip(s).enumerate() {
            for (part, c) in parts.iter_mut().zip(threes(c)) {
                part.set(n, c, *s);
            }
        }
        for (i, (row, one)) in self.blocks.iter_mut().zip(&parts).enumerate() {
            for (block, other) in row.iter_mut().skip(i).zip(parts.iter().skip(i)) {
                one.take_off(other, block);
            }
        }
        self.settle();
    }

    /// Makes the diagonal's blocks symmetric again, which rounding may have made a little less so, and its variances not
    /// less than what no state is known better than, in f32; one that is not a number is brought up to that too.
    #[inline]
    fn settle(&mut self) {
        /// (1e-5 rad)², (1e-4 m/s)², (1e-4 m)², (1e-6 rad/s)², (1e-5 m/s²)², (1e-4 m)², (1e-5 rad or m/s)².
        const LEAST: [f32; BLOCKS] = [1e-10, 1e-8, 1e-8, 1e-12, 1e-10, 1e-10, 1e-10];
        for (i, (row, least)) in self.blocks.iter_mut().zip(LEAST).enumerate() {
            let Some(b) = row.get_mut(i) else { return };
            let at_least = |variance: f32| if variance >= least { variance } else { least };
            (b.m11, b.m22, b.m33) = (at_least(b.m11), at_least(b.m22), at_least(b.m33));
            (b.m21, b.m31, b.m32) = (b.m12, b.m13, b.m23);
        }
    }
}

/// By blocks. (An iterator of nalgebra's looks for the end of a column at every number.)
#[inline]
fn threes(x: &ErrorState) -> &[[f32; 3]] {
    x.as_slice().as_chunks().0
}

/// x ← x + a y.
#[inline]
pub(super) fn add_multiple(x: &mut ErrorState, a: f32, y: &ErrorState) {
    for (x, y) in x.as_mut_slice().iter_mut().zip(y.as_slice()) {
        *x += a * y;
    }
}

/// Three states' part of what a correction takes off: K and u of each number.
#[derive(Clone, Copy)]
struct Part<const N: usize> {
    k: [[f32; 3]; N],
    u: [[f32; 3]; N],
}

impl<const N: usize> Part<N> {
    const ZERO: Self = Self { k: [[0.0; 3]; N], u: [[0.0; 3]; N] };

    /// Of the number `n`, by c and s.
    #[inline]
    fn set(&mut self, n: usize, c: &[f32; 3], s: f32) {
        let k = c.map(|c| c * (1.0 / s));
        self.k[n] = k;
        self.u[n] = core::array::from_fn(|axis| c[axis] - k[axis] * (0.5 * s));
    }

    /// K uᵀ + u Kᵀ, rows from here and columns from there.
    #[inline]
    fn take_off(&self, other: &Self, block: &mut Matrix3<f32>) {
        let columns: &mut [[f32; 3]; 3] = block.as_mut();
        for (column, numbers) in columns.iter_mut().enumerate() {
            *numbers = core::array::from_fn(|axis| {
                (0..N).fold(numbers[axis], |rest, n| {
                    rest - self.k[n][axis] * other.u[n][column] - self.u[n][axis] * other.k[n][column]
                })
            });
        }
    }
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "tests compare with bounds; what flies may not")]
#[path = "covariance/tests.rs"]
mod tests;
