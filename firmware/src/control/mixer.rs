//! The mixer: from U1..U4 to squared rotor speeds, the inverse of Eq. 4 within 0 ≤ ωi² ≤ a limit for each rotor.
//!
//! Where a limit binds, roll and pitch are kept before thrust, and thrust before yaw: first the torque vector
//! (U2, U3) is shortened as little as possible over every thrust and yaw, then the thrust nearest to the wanted
//! one is taken over every yaw, then the nearest yaw. Exact for four to eight rotors, and without a search: the
//! [`facets`] of what the rotors can give are known beforehand, so each priority is a limit by those that bound it.

pub mod facets;

use nalgebra::{Matrix4, SMatrix, Vector4};

use crate::math;
use crate::signals::ControlInput;
use facets::{Column, Facet, Layout, Rotors, Table};

/// Squared rotor speeds, rad²/s², and whether they give the demand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allocation<const N: usize> {
    /// ωi², each from zero to its rotor's limit.
    pub omega_sq: [f32; N],
    /// True if a limit took something of the demand.
    pub saturated: bool,
}

/// Why a mixer cannot be built, a limit not be set or a demand not allocated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MixerError {
    /// The geometry does not span U1..U4: its rows are not independent.
    Singular,
    /// The limit of this rotor, counted from 0, is not within 0..=1.
    Limit(usize),
    /// The demand holds a number that is not finite; the field's name.
    NonFinite(&'static str),
}

/// The inverse of a rotor geometry and the facets of what its rotors can give, ready for the loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Mixer<const N: usize>
where
    Rotors<N>: Layout,
{
    /// Speeds for a unit of each of U1, U2, U3, U4: columns of B⁺.
    thrust: [f32; N],
    roll: [f32; N],
    pitch: [f32; N],
    yaw: [f32; N],
    /// Yaw for a unit of a rotor's speed: 1/`yaw`, or 0 for a rotor to which yaw is all one.
    yaw_per_speed: [f32; N],
    /// Greatest ωi² of each rotor. Never −0: [`is_possible`] compares bits.
    limits: [f32; N],
    torque_facets: <Rotors<N> as Layout>::Torque,
    thrust_facets: <Rotors<N> as Layout>::Thrust,
    yaw_facets: <Rotors<N> as Layout>::Yaw,
    spare: Spare<N>,
    columns: [Column; N],
    omega_sq_max: f32,
}

/// How U is shared out where more than four rotors leave a choice that the pseudo-inverse does not make.
#[derive(Clone, Debug, PartialEq)]
struct Spare<const N: usize>
where
    Rotors<N>: Layout,
{
    /// The rotors: four that span U1..U4, then the others.
    order: [usize; N],
    /// The four rotors' speeds for U.
    inverse: Matrix4<f32>,
    /// What bounds the speed of the fifth rotor in `order`, then of the sixth and so on.
    facets: <Rotors<N> as Layout>::Spare,
    /// How many of these facets are the fifth's, the sixth's and so on; those of the first four are none.
    counts: [usize; N],
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

/// How far beyond its limits a rotor is taken to reach where torque is shortened, as a part of ωmax². Where rotors have
/// failed, the origin may lie on an edge of the torques: one along it must not vanish because rounding leads it out.
const HAIR: f32 = 1e-6;

impl<const N: usize> Mixer<N>
where
    Rotors<N>: Layout,
{
    /// Inverts the geometry `rows` (U = B ω², rows U1..U4), with the greatest speed `omega_max` in rad/s.
    ///
    /// # Errors
    /// [`MixerError::Singular`] if the rotors cannot produce U1..U4 independently of each other.
    pub fn new(rows: &[[f32; N]; 4], omega_max: f32) -> Result<Self, MixerError> {
        // Each row is scaled to unit size first, so that N and N m weigh the same.
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
        let square_inverse = (b * b.transpose()).try_inverse().ok_or(MixerError::Singular)?;
        if !square_inverse.iter().all(|v| math::abs(*v) < INVERSE_MAX) {
            return Err(MixerError::Singular);
        }
        let inverse = b.transpose() * square_inverse;
        let [s1, s2, s3, s4] = scale;
        let column = |j: usize, scale: f32| core::array::from_fn(|i| inverse[(i, j)] * scale);
        let yaw_per_speed = core::array::from_fn(|i| {
            let row = inverse.row(i);
            let size = math::sqrt(row.iter().map(|v| v * v).sum());
            if math::abs(row[3]) > facets::PARALLEL * size { 1.0 / (row[3] * s4) } else { 0.0 }
        });
        let scaled = core::array::from_fn(|i| core::array::from_fn(|j| b[(j, i)]));
        let mut mixer = Self {
            thrust: column(0, s1),
            roll: column(1, s2),
            pitch: column(2, s3),
            yaw: column(3, s4),
            yaw_per_speed,
            limits: [0.0; N],
            torque_facets: facets::torque(&scaled, &scale),
            thrust_facets: facets::thrust(&scaled, &scale),
            yaw_facets: facets::yaw(&scaled, &scale),
            spare: Spare::new(&scaled, &scale)?,
            columns: core::array::from_fn(|i| rows.map(|row| row[i])),
            omega_sq_max: omega_max * omega_max,
        };
        mixer.set_limits([1.0; N])?;
        Ok(mixer)
    }

    /// Greatest ωi² of a sound rotor, rad²/s².
    pub const fn omega_sq_max(&self) -> f32 {
        self.omega_sq_max
    }

    /// Limits each rotor's ω² to a part 0..=1 of the greatest: less than one for a weak rotor, zero for one that has
    /// failed. For the slow parts of a flight, not for the loop.
    ///
    /// # Errors
    /// [`MixerError::Limit`] with the first rotor whose part is out of range; all limits then stay as they were.
    pub fn set_limits(&mut self, fractions: [f32; N]) -> Result<(), MixerError> {
        if let Some(rotor) = fractions.iter().position(|fraction| !(0.0..=1.0).contains(fraction)) {
            return Err(MixerError::Limit(rotor));
        }
        self.limits = fractions.map(|fraction| math::abs(fraction) * self.omega_sq_max);
        let slack = HAIR * self.omega_sq_max;
        let rotors = || self.limits.iter().zip(&self.columns);
        for facet in self.torque_facets.facets_mut() {
            facet.reach(slack, rotors().map(|(limit, [_, roll, pitch, _])| (*limit, 0.0, [*roll, *pitch])));
        }
        for facet in self.thrust_facets.facets_mut() {
            facet.reach(0.0, rotors().map(|(limit, [thrust, roll, pitch, _])| (*limit, *thrust, [*roll, *pitch])));
        }
        for facet in self.yaw_facets.facets_mut() {
            facet.reach(
                0.0,
                rotors().map(|(limit, [thrust, roll, pitch, yaw])| (*limit, *yaw, [*thrust, *roll, *pitch])),
            );
        }
        self.spare.reach(&self.limits, &self.columns);
        Ok(())
    }

    /// What squared speeds (rad²/s²) give: U = B ω².
    pub fn given(&self, omega_sq: &[f32; N]) -> ControlInput {
        let mut u = [0.0; 4];
        for (column, speed) in self.columns.iter().zip(omega_sq) {
            for (u, v) in u.iter_mut().zip(column) {
                *u += v * speed;
            }
        }
        let [thrust_n, roll_n_m, pitch_n_m, yaw_n_m] = u;
        ControlInput { thrust_n, roll_n_m, pitch_n_m, yaw_n_m }
    }

    /// Squared speeds for a demand, by the priorities in the module's text. The steps are bounded: one for each facet.
    ///
    /// # Errors
    /// [`MixerError::NonFinite`] with the demand's field; nothing is allocated then.
    #[expect(clippy::inline_always, reason = "measured: a call would put the demand and the speeds into memory")]
    #[inline(always)]
    pub fn allocate(&self, demand: &ControlInput) -> Result<Allocation<N>, MixerError> {
        let omega_sq = self.speeds(demand);
        // A demand that is not finite has no speed that is.
        if self.are_possible(&omega_sq) {
            return Ok(Allocation { omega_sq, saturated: false });
        }
        self.allocate_limited(*demand)
    }

    /// B⁺ U, limits or not.
    #[inline]
    fn speeds(&self, u: &ControlInput) -> [f32; N] {
        core::array::from_fn(|i| {
            let torque = self.roll[i] * u.roll_n_m + self.pitch[i] * u.pitch_n_m;
            torque + self.thrust[i] * u.thrust_n + self.yaw[i] * u.yaw_n_m
        })
    }

    #[inline]
    fn are_possible(&self, omega_sq: &[f32; N]) -> bool {
        omega_sq.iter().zip(&self.limits).all(|(speed, limit)| is_possible(*speed, *limit))
    }

    #[cold]
    #[inline(never)]
    fn allocate_limited(&self, demand: ControlInput) -> Result<Allocation<N>, MixerError> {
        if !math::all_finite(&demand.as_array()) {
            return Err(non_finite(&demand));
        }
        let asked = [demand.roll_n_m, demand.pitch_n_m];
        let share = self.torque_facets.facets().iter().fold(1.0, |share, facet| facet.shorten(share, &asked));
        let torque = asked.map(|v| v * share);
        let thrust = nearest(self.thrust_facets.facets().iter(), demand.thrust_n, torque);
        let [roll, pitch] = torque;
        let without_yaw =
            core::array::from_fn(|i| self.roll[i] * roll + self.pitch[i] * pitch + self.thrust[i] * thrust);
        let yaw = self.nearest_yaw(demand.yaw_n_m, [thrust, roll, pitch], &without_yaw);
        let mut omega_sq = core::array::from_fn(|i| without_yaw[i] + self.yaw[i] * yaw);
        if N > 4 && !self.are_possible(&omega_sq) {
            self.spare.share_out([thrust, roll, pitch, yaw], &mut omega_sq, &self.limits, &self.columns);
        }
        for (speed, limit) in omega_sq.iter_mut().zip(&self.limits) {
            *speed = possible(*speed, *limit);
        }
        let saturated = differ(share, 1.0) || differ(thrust, demand.thrust_n) || differ(yaw, demand.yaw_n_m);
        Ok(Allocation { omega_sq, saturated })
    }

    /// The yaw nearest to the wanted one that thrust and torque leave: with four rotors by their own limits.
    #[inline]
    fn nearest_yaw(&self, wanted: f32, known: [f32; 3], without_yaw: &[f32; N]) -> f32 {
        if N > 4 {
            return nearest(self.yaw_facets.facets().iter(), wanted, known);
        }
        let mut yaw = wanted;
        let rotors = self.yaw.iter().zip(&self.yaw_per_speed).zip(&self.limits);
        for (without_yaw, ((per_yaw, yaw_per_speed), limit)) in without_yaw.iter().zip(rotors) {
            let speed = without_yaw + per_yaw * yaw;
            if !is_possible(speed, *limit) && *yaw_per_speed != 0.0 {
                yaw = (possible(speed, *limit) - without_yaw) * yaw_per_speed;
            }
        }
        yaw
    }
}

/// True if a speed is from 0 to its limit. Numbers from 0 up are ordered as their bits are, and those of a negative
/// number or of none are greater: one comparison does for both ends. (It refuses −0 as well, which costs time but is
/// no error.)
#[inline]
fn is_possible(speed: f32, limit: f32) -> bool {
    speed.to_bits() <= limit.to_bits()
}

/// The speed nearest to the given one that is from 0 to its limit; 0 for no number, whatever its sign is.
#[inline]
fn possible(speed: f32, limit: f32) -> f32 {
    if is_possible(speed, limit) { speed } else { math::clamp(speed, 0.0, limit) }
}

/// True if a number is no longer what it was.
#[inline]
fn differ(a: f32, b: f32) -> bool {
    a.to_bits() != b.to_bits()
}

/// What is left for `x` by one facet after the other: the value of all of them that is nearest, because there is one.
#[inline]
fn nearest<'a, const K: usize>(facets: impl Iterator<Item = &'a Facet<K>>, x: f32, known: [f32; K]) -> f32 {
    facets.fold(x, |x, facet| facet.nearest(x, &known))
}

impl<const N: usize> Spare<N>
where
    Rotors<N>: Layout,
{
    /// From the columns and scales of B with rows of unit size.
    fn new(columns: &[Column; N], scale: &[f32; 4]) -> Result<Self, MixerError> {
        let mut spare = Self {
            order: core::array::from_fn(|i| i),
            inverse: Matrix4::zeros(),
            facets: Default::default(),
            counts: [0; N],
        };
        if N > 4 {
            spare.order = facets::order(columns);
            let ordered = spare.order.map(|i| columns[i]);
            for (position, last) in ordered.iter().enumerate().skip(4) {
                let before = spare.facets.facets().len();
                facets::spare(&mut spare.facets, last, ordered.iter().take(position));
                spare.counts[position] = spare.facets.facets().len() - before;
            }
            spare.facets.rescale(*scale);
            let base = Matrix4::from_fn(|i, j| ordered[j][i]);
            let inverse = base.try_inverse().ok_or(MixerError::Singular)?;
            spare.inverse = Matrix4::from_fn(|i, j| inverse[(i, j)] * scale[j]);
        }
        Ok(spare)
    }

    fn reach(&mut self, limits: &[f32; N], columns: &[Column; N]) {
        let mut facets = self.facets.facets_mut().iter_mut();
        for (position, count) in self.counts.iter().enumerate() {
            for facet in facets.by_ref().take(*count) {
                let others = self.order.iter().take(position);
                facet.reach(0.0, others.filter_map(|i| Some((*limits.get(*i)?, 0.0, *columns.get(*i)?))));
            }
        }
    }

    /// Brings speeds within the limits that still give `u`, which the rotors can. Rotor after rotor takes the speed
    /// nearest to the one it has that leaves the rest of U to those before it, down to four, which have no choice. So
    /// the speeds are continuous in U: each is limited by bounds that are.
    fn share_out(&self, u: [f32; 4], omega_sq: &mut [f32; N], limits: &[f32; N], columns: &[Column; N]) {
        let mut rest = u;
        let mut facets = self.facets.facets().iter();
        for (i, count) in self.order.iter().zip(self.counts).skip(4).rev() {
            let rotor = omega_sq.get_mut(*i).zip(limits.get(*i)).zip(columns.get(*i));
            let Some(((speed, limit), column)) = rotor else { continue };
            *speed = possible(nearest(facets.by_ref().rev().take(count), *speed, rest), *limit);
            for (rest, v) in rest.iter_mut().zip(column) {
                *rest -= v * *speed;
            }
        }
        let last = self.inverse * Vector4::from(rest);
        for (i, speed) in self.order.iter().zip(&last) {
            if let Some(to) = omega_sq.get_mut(*i) {
                *to = *speed;
            }
        }
    }
}
