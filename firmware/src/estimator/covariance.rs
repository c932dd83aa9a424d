//! The covariance of the error state, in blocks of three: prediction and correction.
//!
//! ```text
//!      θ        v        p        bg       ba       o                    m
//! ┌ attitude velocity position gyro     accel    GNSS x, GNSS y,      heading,  ┐
//! └ (world)                    bias     bias     height offset        wind x, y ┘
//! ```
//!
//! The attitude error is a small rotation in the world, `R = Exp(θ) R̂` (the "global" error of Solà 2017, §7). Its own
//! dynamics therefore contain no rotation, and those of velocity and position contain the integrated specific force
//! only. Over a step of T seconds with that integral S:
//!
//! ```text
//! θ ← θ − T R bg      v ← v − S × θ − T R ba      p ← p + T v      (Solà 2017, eq. 283–288, to first order)
//! ```
//!
//! The other states are constant. Each of the three lines is a shear of one block row by others, done in place on the
//! upper triangle; together they are F P Fᵀ.

use nalgebra::{Matrix3, SVector, Vector3};

/// Number of states.
pub const STATES: usize = 21;
/// Blocks of three.
const BLOCKS: usize = STATES / 3;

/// Index of the first component of each state.
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
    /// Origin of the GNSS frame in the local frame, x and y, m.
    pub const OFFSET: usize = 15;
    /// Offset of the height source: its reading minus the height, m.
    pub const HEIGHT_OFFSET: usize = 17;
    /// Offset of the magnetic heading: its reading minus the heading, rad.
    pub const HEADING_OFFSET: usize = 18;
    /// Wind, x and y, m/s.
    pub const WIND: usize = 19;
}

/// An error state, or another vector with one component per state.
pub type ErrorState = SVector<f32, STATES>;

/// Three components of an error state, from `first` on; zero if there are none.
pub(super) fn triple(x: &ErrorState, first: usize) -> Vector3<f32> {
    match x.as_slice().get(first..first + 3) {
        Some([x, y, z]) => Vector3::new(*x, *y, *z),
        _ => Vector3::zeros(),
    }
}

const T: usize = index::THETA / 3;
const V: usize = index::VELOCITY / 3;
const P: usize = index::POSITION / 3;
const G: usize = index::GYRO_BIAS / 3;
const A: usize = index::ACCEL_BIAS / 3;
const O: usize = index::OFFSET / 3;
const M: usize = index::HEADING_OFFSET / 3;

/// A row of H, for one component of a measurement: factors on the attitude error and on up to three other states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Factors on the attitude error.
    pub theta: Vector3<f32>,
    /// State and factor of each other entry; a factor of 0 for an unused one.
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

/// A component by its index; 0 beyond the last.
#[inline]
fn entry(x: &ErrorState, state: usize) -> f32 {
    x.as_slice().get(state).copied().unwrap_or(0.0)
}

/// Process noise of a step: the variances that it adds.
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

/// The motion over a step, as the error dynamics need it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// T, s.
    pub step_s: f32,
    /// R, body to world, at the end of the step.
    pub rotation: Matrix3<f32>,
    /// S = ∫ R f dt over the step, m/s.
    pub velocity_change: Vector3<f32>,
}

/// A symmetric 21 × 21 matrix. Only the blocks on and above the diagonal are used.
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

    /// The variance of a state; 0 beyond the last.
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

    /// Sets the variance of a state and clears its correlations with all others: for a state that has been reset.
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

    /// Predicts over a step: F P Fᵀ + Q.
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
        // The off-diagonal blocks first: the diagonal one needs the row before and after.
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

    /// Writes P Hᵀ to `product`, in place: returning its 84 bytes by value would cost a copy per measurement.
    pub fn times(&self, row: &Row, product: &mut ErrorState) {
        let (triples, _) = product.as_mut_slice().as_chunks_mut::<3>();
        let [x, y, z] = row.theta.into();
        for (to, block) in triples.iter_mut().zip(&self.blocks[T]) {
            let columns: &[[f32; 3]; 3] = block.as_ref();
            *to = columns.map(|[a, b, c]| a * x + b * y + c * z);
        }
        for (state, factor) in row.entries {
            if factor != 0.0 {
                self.add_column(state, factor, triples);
            }
        }
    }

    /// Adds a multiple of a column: above the diagonal from the column itself, below it from the row of the same index.
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

    /// Corrects by N measured components, each independent of those before it: Joseph's form for gains K = c/s, with c
    /// = P Hᵀ and s = H c + R,
    ///
    /// ```text
    /// P ← (I − K H) P (I − K H)ᵀ + K R Kᵀ = P − K uᵀ − u Kᵀ,      u = c − s K/2
    /// ```
    ///
    /// which depends on the rounding of the gain to second order only. The diagonal blocks are then made symmetric and
    /// their variances kept above a floor.
    pub fn correct<const N: usize>(&mut self, c: &[ErrorState; N], s: &[f32; N]) {
        let mut gains = [BlockGain::<N>::ZERO; BLOCKS];
        for (n, (c, s)) in c.iter().zip(s).enumerate() {
            for (gain, c) in gains.iter_mut().zip(triples(c)) {
                gain.set(n, c, *s);
            }
        }
        for (i, (row, one)) in self.blocks.iter_mut().zip(&gains).enumerate() {
            for (block, other) in row.iter_mut().skip(i).zip(gains.iter().skip(i)) {
                one.subtract_from(other, block);
            }
        }
        self.condition();
    }

    /// Makes the diagonal blocks symmetric, against rounding, and raises variances that are below the floor, or NaN.
    #[inline]
    fn condition(&mut self) {
        /// No state is ever known better than this, and f32 still resolves it: (1e-5 rad)², (1e-4 m/s)², (1e-4 m)²,
        /// (1e-6 rad/s)², (1e-5 m/s²)², (1e-4 m)², (1e-5 rad or m/s)².
        const LEAST: [f32; BLOCKS] = [1e-10, 1e-8, 1e-8, 1e-12, 1e-10, 1e-10, 1e-10];
        for (i, (row, least)) in self.blocks.iter_mut().zip(LEAST).enumerate() {
            let Some(b) = row.get_mut(i) else { return };
            let at_least = |variance: f32| if variance >= least { variance } else { least };
            (b.m11, b.m22, b.m33) = (at_least(b.m11), at_least(b.m22), at_least(b.m33));
            (b.m21, b.m31, b.m32) = (b.m12, b.m13, b.m23);
        }
    }
}

/// The blocks of a vector. (nalgebra's iterator would check for the end of a column at every element.)
#[inline]
fn triples(x: &ErrorState) -> &[[f32; 3]] {
    x.as_slice().as_chunks().0
}

/// x ← x + a y.
#[inline]
pub(super) fn add_multiple(x: &mut ErrorState, a: f32, y: &ErrorState) {
    for (x, y) in x.as_mut_slice().iter_mut().zip(y.as_slice()) {
        *x += a * y;
    }
}

/// K and u of one block of three states, for each measured component.
#[derive(Clone, Copy)]
struct BlockGain<const N: usize> {
    k: [[f32; 3]; N],
    u: [[f32; 3]; N],
}

impl<const N: usize> BlockGain<N> {
    const ZERO: Self = Self { k: [[0.0; 3]; N], u: [[0.0; 3]; N] };

    /// Sets those of component `n`, from c and s.
    #[inline]
    fn set(&mut self, n: usize, c: &[f32; 3], s: f32) {
        let k = c.map(|c| c * (1.0 / s));
        self.k[n] = k;
        self.u[n] = core::array::from_fn(|axis| c[axis] - k[axis] * (0.5 * s));
    }

    /// Subtracts K uᵀ + u Kᵀ from a block: rows of `self`, columns of `other`.
    #[inline]
    fn subtract_from(&self, other: &Self, block: &mut Matrix3<f32>) {
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
