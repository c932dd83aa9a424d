//! The mixer: from U1..U4 to squared rotor speeds, the inverse of Eq. 4 within 0 ≤ ωi² ≤ ωmax².
//!
//! Where a limit binds, roll and pitch are kept before thrust, and thrust before yaw: first the torque vector
//! (U2, U3) is shortened as little as possible over every thrust and yaw, then the thrust nearest to the wanted
//! one is taken over every yaw, then the nearest yaw. Exact for four rotors (the plus layout by Eq. 4's own
//! inverse); for more, among the speeds the pseudo-inverse spans.

use nalgebra::{Matrix4, SMatrix};

use crate::math;
use crate::signals::ControlInput;

/// Squared rotor speeds, rad²/s², and what of the demand they give.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allocation<const N: usize> {
    /// ωi², each 0..=ωmax².
    pub omega_sq: [f32; N],
    /// True if a limit acted.
    pub saturated: bool,
}

/// Why a mixer cannot be built or a demand not allocated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MixerError {
    /// The geometry does not span U1..U4: its rows are not independent.
    Singular,
    /// The demand holds a number that is not finite; the field's name.
    NonFinite(&'static str),
}

/// The inverse of a rotor geometry, ready for the loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mixer<const N: usize> {
    /// Speeds for a unit of each of U1, U2, U3, U4: columns of B⁺.
    thrust: [f32; N],
    roll: [f32; N],
    pitch: [f32; N],
    yaw: [f32; N],
    omega_sq_max: f32,
}

/// Names the field of a demand that is not finite.
#[cold]
fn non_finite(demand: &ControlInput) -> MixerError {
    let names = ["thrust", "roll", "pitch", "yaw"];
    let culprit = names.into_iter().zip(demand.as_array()).find(|(_, value)| !value.is_finite());
    MixerError::NonFinite(culprit.map_or("demand", |(name, _)| name))
}

/// Greatest entry of (B Bᵀ)⁻¹, rows of unit size: beyond it f32 leaves less than three digits of the inverse.
const INVERSE_MAX: f32 = 1e4;

/// A range of numbers, empty where low > high.
#[derive(Clone, Copy)]
struct Interval {
    low: f32,
    high: f32,
}

impl Interval {
    const ALL: Self = Self { low: f32::NEG_INFINITY, high: f32::INFINITY };

    /// What of the range satisfies `slope·x ≤ bound`. A slope of zero says nothing.
    fn cut(self, slope: f32, bound: f32) -> Self {
        if slope > 0.0 {
            Self { low: self.low, high: math::min(self.high, bound / slope) }
        } else if slope < 0.0 {
            Self { low: math::max(self.low, bound / slope), high: self.high }
        } else {
            self
        }
    }

    fn nearest(self, x: f32) -> f32 {
        if self.low > self.high { 0.5 * (self.low + self.high) } else { math::clamp(x, self.low, self.high) }
    }
}

impl<const N: usize> Mixer<N> {
    /// Inverts the geometry `rows` (U = B ω², rows U1..U4), with the greatest speed `omega_max` in rad/s.
    ///
    /// # Errors
    /// [`MixerError::Singular`] if the rotors cannot produce U1..U4 independently of each other.
    pub fn new(rows: &[[f32; N]; 4], omega_max: f32) -> Result<Self, MixerError> {
        // Each row is scaled to unit size first, so that N and N m weigh the same in the inverse of B Bᵀ.
        let mut scale = [0.0; 4];
        let mut b = SMatrix::<f32, 4, N>::zeros();
        for ((row, scale), mut target) in rows.iter().zip(&mut scale).zip(b.row_iter_mut()) {
            let size = math::sqrt(row.iter().map(|v| v * v).sum());
            if !size.is_finite() || size <= 0.0 {
                return Err(MixerError::Singular);
            }
            *scale = 1.0 / size;
            for (to, from) in target.iter_mut().zip(row) {
                *to = from / size;
            }
        }
        let square: Matrix4<f32> = b * b.transpose();
        let square_inverse = square.try_inverse().ok_or(MixerError::Singular)?;
        if !square_inverse.iter().all(|v| math::abs(*v) < INVERSE_MAX) {
            return Err(MixerError::Singular);
        }
        let inverse = b.transpose() * square_inverse;
        let [s1, s2, s3, s4] = scale;
        let column = |j: usize, scale: f32| core::array::from_fn(|i| inverse[(i, j)] * scale);
        Ok(Self {
            thrust: column(0, s1),
            roll: column(1, s2),
            pitch: column(2, s3),
            yaw: column(3, s4),
            omega_sq_max: omega_max * omega_max,
        })
    }

    /// Greatest ωi², rad²/s².
    pub const fn omega_sq_max(&self) -> f32 {
        self.omega_sq_max
    }

    /// Squared speeds for a demand, by the priorities in the module's text. The steps are bounded: at most
    /// `NEWTON_STEPS` passes over pairs of rotors.
    ///
    /// # Errors
    /// [`MixerError::NonFinite`] with the demand's field; nothing is allocated then.
    #[inline]
    pub fn allocate(&self, demand: &ControlInput) -> Result<Allocation<N>, MixerError> {
        if !math::all_finite(&demand.as_array()) {
            return Err(non_finite(demand));
        }
        let torque = self.torque_speeds(demand);
        let omega_sq = self.speeds(&torque, demand.thrust_n, demand.yaw_n_m);
        if omega_sq.iter().all(|v| *v >= 0.0 && *v <= self.omega_sq_max) {
            return Ok(Allocation { omega_sq, saturated: false });
        }
        Ok(Allocation { omega_sq: self.allocate_limited(&torque, demand), saturated: true })
    }

    /// Speeds for thrust and yaw on top of those for the torques (U2, U3).
    #[inline]
    fn speeds(&self, torque: &[f32; N], thrust: f32, yaw: f32) -> [f32; N] {
        core::array::from_fn(|i| torque[i] + (self.thrust[i] * thrust + self.yaw[i] * yaw))
    }

    #[cold]
    #[inline(never)]
    fn allocate_limited(&self, torque: &[f32; N], demand: &ControlInput) -> [f32; N] {
        let share = self.torque_share(torque);
        let base = torque.map(|v| v * share);
        let thrust = self.thrust_range(&base).nearest(demand.thrust_n);
        let mut yaw_range = Interval::ALL;
        for (without_yaw, slope) in self.speeds(&base, thrust, 0.0).into_iter().zip(self.yaw) {
            yaw_range = yaw_range.cut(slope, self.omega_sq_max - without_yaw).cut(-slope, without_yaw);
        }
        let yaw = yaw_range.nearest(demand.yaw_n_m);
        self.speeds(&base, thrust, yaw).map(|speed| math::clamp(speed, 0.0, self.omega_sq_max))
    }

    /// Speeds for the torques (U2, U3). Torques beyond any rotor's reach are shortened first, so
    /// that nothing overflows.
    #[inline]
    fn torque_speeds(&self, demand: &ControlInput) -> [f32; N] {
        const BEYOND_REACH_N_M: f32 = 1e20;
        let largest = math::max(math::abs(demand.roll_n_m), math::abs(demand.pitch_n_m));
        let scale = if largest > BEYOND_REACH_N_M { BEYOND_REACH_N_M / largest } else { 1.0 };
        let (roll, pitch) = (demand.roll_n_m * scale, demand.pitch_n_m * scale);
        core::array::from_fn(|i| self.roll[i] * roll + self.pitch[i] * pitch)
    }

    /// The greatest part 0..=1 of the torque for which some thrust and yaw keep every rotor within its limits.
    ///
    /// Limits that no thrust can ease cut the part directly. Beyond them, the room for thrust, `high − low`, is a
    /// concave, piecewise linear function of the part; Newton's method comes down to its zero from outside, one
    /// linear piece at each step.
    fn torque_share(&self, torque: &[f32; N]) -> f32 {
        const NEWTON_STEPS: usize = 8;
        /// A hair inside, so that rounding does not leave the range of thrusts empty.
        const INSIDE: f32 = 1.0 - 1e-6;
        let mut share = 1.0_f32;
        self.for_each_thrust_limit(torque, |slope, constant, per_share| {
            if slope == 0.0 && per_share > 0.0 {
                share = math::min(share, constant / per_share * INSIDE);
            }
        });
        for _ in 0..NEWTON_STEPS {
            let (constant, per_share) = self.thrust_room(torque, share);
            if constant + per_share * share >= 0.0 || per_share >= 0.0 {
                break;
            }
            share = -constant / per_share * INSIDE;
        }
        math::clamp(share, 0.0, 1.0)
    }

    /// Room for thrust (N) around a part of the torque: `constant + per_share·part`.
    fn thrust_room(&self, torque: &[f32; N], share: f32) -> (f32, f32) {
        let mut low = (f32::NEG_INFINITY, 0.0, 0.0);
        let mut high = (f32::INFINITY, 0.0, 0.0);
        self.for_each_thrust_limit(torque, |slope, constant, per_share| {
            let at = (constant - per_share * share) / slope;
            let line = (at, constant / slope, -per_share / slope);
            if slope > 0.0 && at < high.0 {
                high = line;
            } else if slope < 0.0 && at > low.0 {
                low = line;
            }
        });
        (high.1 - low.1, high.2 - low.2)
    }

    /// The thrusts (N) for which some yaw keeps every rotor within its limits, given the torque's speeds.
    fn thrust_range(&self, base: &[f32; N]) -> Interval {
        let mut range = Interval::ALL;
        self.for_each_thrust_limit(base, |slope, constant, per_share| {
            range = range.cut(slope, constant - per_share);
        });
        range
    }

    /// Calls `limit(slope, constant, per_share)` for each inequality `slope·thrust + per_share·share ≤ constant`
    /// that is left when yaw is eliminated (Fourier–Motzkin) from `0 ≤ share·torque + thrust + yaw ≤ ωmax²`. A slope
    /// that is only rounding is given as 0: such a limit is on the torque alone.
    fn for_each_thrust_limit(&self, torque: &[f32; N], mut limit: impl FnMut(f32, f32, f32)) {
        // Rotor i as `sign·(yaw·Y + thrust·T + torque·share) ≤ bound`, once for each of its two limits.
        let row = |i: usize, upper: bool| {
            let (sign, bound) = if upper { (1.0, self.omega_sq_max) } else { (-1.0, 0.0) };
            (sign * self.yaw[i], sign * self.thrust[i], sign * torque[i], bound)
        };
        for i in 0..N {
            for upper in [true, false] {
                let (yaw, thrust, per_share, bound) = row(i, upper);
                if yaw == 0.0 {
                    limit(thrust, bound, per_share);
                }
                if yaw <= 0.0 {
                    continue;
                }
                for j in 0..N {
                    for other_upper in [true, false] {
                        let (yaw_j, thrust_j, per_share_j, bound_j) = row(j, other_upper);
                        if yaw_j < 0.0 && (i != j) {
                            let (a, b) = (1.0 / yaw, -1.0 / yaw_j);
                            let (one, other) = (thrust * a, thrust_j * b);
                            let rounding = 1e-5 * (math::abs(one) + math::abs(other));
                            let slope = if math::abs(one + other) > rounding { one + other } else { 0.0 };
                            limit(slope, bound * a + bound_j * b, per_share * a + per_share_j * b);
                        }
                    }
                }
            }
        }
    }
}
