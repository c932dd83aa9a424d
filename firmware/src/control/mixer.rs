//! The mixer (control allocation): from U1..U4 to squared rotor speeds, the inverse of Eq. 4 within a limit per rotor.
//!
//! When a rotor saturates, roll and pitch have priority over thrust, and thrust over yaw: the torque vector (U2, U3) is
//! shortened as little as possible, for any thrust and yaw; then the thrust nearest to the demand is chosen, for any
//! yaw; then the nearest yaw. The result is exact for four to eight rotors and needs no search: the [`facets`] of the
//! set of attainable U are computed in advance, so each priority is a clamp by the facets that bound it.
//!
//! ```
//! use firmware::airframe::Airframe;
//! use firmware::control::mixer::Mixer;
//! use firmware::signals::ControlInput;
//!
//! let airframe = Airframe::paper(2.0);
//! let mixer = Mixer::new(&airframe.geometry.rows(), airframe.omega_max_rad_s).expect("independent rows");
//!
//! // Hover with a little roll: the four rotors give exactly the demand.
//! let demand = ControlInput { thrust_n: airframe.weight_n(), roll_n_m: 0.1, ..ControlInput::default() };
//! let allocation = mixer.allocate(&demand).expect("a finite demand");
//! assert!(!allocation.saturated);
//! assert!((mixer.given(&allocation.omega_sq).roll_n_m - 0.1).abs() < 1e-4);
//!
//! // Far too much yaw: roll and thrust stay, yaw is what is left.
//! let demand = ControlInput { yaw_n_m: 1.0, ..demand };
//! let allocation = mixer.allocate(&demand).expect("a finite demand");
//! let given = mixer.given(&allocation.omega_sq);
//! assert!(allocation.saturated && given.yaw_n_m < 0.2);
//! assert!((given.thrust_n - airframe.weight_n()).abs() < 1e-3 && (given.roll_n_m - 0.1).abs() < 1e-4);
//! ```

pub mod facets;

use nalgebra::{Matrix4, SMatrix, Vector4};

use crate::math;
use crate::signals::ControlInput;
use facets::{Column, Facet, Layout, Rotors, Table};

/// Squared rotor speeds, rad²/s², and whether they give the whole demand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allocation<const N: usize> {
    /// ωi², each from zero to its rotor's limit.
    pub omega_sq: [f32; N],
    /// True if a limit reduced the demand.
    pub saturated: bool,
}

/// Error of building a mixer, setting a limit or allocating a demand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MixerError {
    /// The geometry does not span U1..U4: its rows are not independent.
    Singular,
    /// The limit of this rotor, counted from 0, is not within 0..=1.
    Limit(usize),
    /// A field of the demand is NaN or infinite; its name.
    NonFinite(&'static str),
}

/// The inverse of a rotor geometry and the facets of its attainable set, ready for the loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Mixer<const N: usize>
where
    Rotors<N>: Layout,
{
    /// Columns of B⁺: squared speeds per unit of U1, U2, U3 and U4.
    thrust: [f32; N],
    roll: [f32; N],
    pitch: [f32; N],
    yaw: [f32; N],
    /// Yaw per unit of a rotor's squared speed: 1/`yaw`, or 0 for a rotor whose speed does not depend on yaw.
    yaw_per_speed: [f32; N],
    /// Greatest ωi² of each rotor. Never −0: [`is_possible`] compares bit patterns.
    limits: [f32; N],
    torque_facets: <Rotors<N> as Layout>::Torque,
    thrust_facets: <Rotors<N> as Layout>::Thrust,
    yaw_facets: <Rotors<N> as Layout>::Yaw,
    spare: Spare<N>,
    columns: [Column; N],
    omega_sq_max: f32,
}

/// Allocation among more than four rotors where the pseudo-inverse exceeds a limit.
#[derive(Clone, Debug, PartialEq)]
struct Spare<const N: usize>
where
    Rotors<N>: Layout,
{
    /// Order of the rotors: four that span U1..U4, then the others.
    order: [usize; N],
    /// Inverse of the first four columns of B.
    inverse: Matrix4<f32>,
    /// Facets that bound the speed of the fifth rotor in `order`, then of the sixth and so on.
    facets: <Rotors<N> as Layout>::Spare,
    /// Number of facets per rotor in `order`; 0 for the first four.
    counts: [usize; N],
}

/// Names the field of a demand that is not finite.
#[cold]
fn non_finite(demand: &ControlInput) -> MixerError {
    let names = ["thrust", "roll", "pitch", "yaw"];
    let culprit = names.into_iter().zip(demand.as_array()).find(|(_, value)| !value.is_finite());
    MixerError::NonFinite(culprit.map_or("demand", |(name, _)| name))
}

/// Greatest entry of (B Bᵀ)⁻¹ for rows of unit norm: beyond it f32 leaves less than three digits of the inverse.
const INVERSE_MAX: f32 = 1e4;

/// Slack on each rotor's limit when torque is shortened, as a fraction of ωmax². With failed rotors the origin may lie
/// on an edge of the attainable torques; a torque along that edge must not vanish because of rounding.
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
        // Each row is scaled to unit norm first, so that N and N m have the same weight.
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

    /// Greatest ωi² of a working rotor, rad²/s².
    pub const fn omega_sq_max(&self) -> f32 {
        self.omega_sq_max
    }

    /// Limits each rotor's ω² to a fraction 0..=1 of ωmax²: less than one for a weak rotor, zero for a failed one. Not
    /// meant for every tick: it recomputes all facets.
    ///
    /// # Errors
    /// [`MixerError::Limit`] with the first rotor whose fraction is out of range; no limit is changed then.
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

    /// The control input U = B ω² of squared speeds (rad²/s²).
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

    /// Allocates a demand, with the priorities given in the module docs. Bounded: one step per facet.
    ///
    /// # Errors
    /// [`MixerError::NonFinite`] with the name of the demand's field.
    #[expect(clippy::inline_always, reason = "measured: a call would put the demand and the speeds into memory")]
    #[inline(always)]
    pub fn allocate(&self, demand: &ControlInput) -> Result<Allocation<N>, MixerError> {
        let omega_sq = self.speeds(demand);
        // A demand that is not finite gives speeds that are not possible, so it is caught below.
        if self.are_possible(&omega_sq) {
            return Ok(Allocation { omega_sq, saturated: false });
        }
        self.allocate_limited(*demand)
    }

    /// B⁺ U, without limits.
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
        let wanted = [demand.roll_n_m, demand.pitch_n_m];
        let share = self.torque_facets.facets().iter().fold(1.0, |share, facet| facet.shorten(share, &wanted));
        let torque = wanted.map(|v| v * share);
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

    /// The attainable yaw nearest to the demand, given thrust and torque; with four rotors, by the rotors' own limits.
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

/// True if a squared speed is from 0 to its limit. The bit patterns of non-negative floats are ordered like the floats,
/// and those of negative ones and of NaN are greater, so one comparison checks both ends. (It also refuses −0, which
/// only costs time.)
#[inline]
fn is_possible(speed: f32, limit: f32) -> bool {
    speed.to_bits() <= limit.to_bits()
}

/// The squared speed clamped to 0 and its limit; 0 for NaN.
#[inline]
fn possible(speed: f32, limit: f32) -> f32 {
    if is_possible(speed, limit) { speed } else { math::clamp(speed, 0.0, limit) }
}

/// True if two values differ in any bit.
#[inline]
fn differ(a: f32, b: f32) -> bool {
    a.to_bits() != b.to_bits()
}

/// Clamps `x` by one facet after the other. The result is the nearest value within all of them, because one exists.
#[inline]
fn nearest<'a, const K: usize>(facets: impl Iterator<Item = &'a Facet<K>>, x: f32, known: [f32; K]) -> f32 {
    facets.fold(x, |x, facet| facet.nearest(x, &known))
}

impl<const N: usize> Spare<N>
where
    Rotors<N>: Layout,
{
    /// From the columns and scales of B with rows of unit norm.
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

    /// Moves the squared speeds within their limits while they still give `u`, which must be attainable. From the last
    /// rotor to the fifth, each takes the speed nearest to its present one that leaves a remainder of U which the
    /// rotors before it can give; the first four have no choice. The speeds are continuous in U, because every bound
    /// is.
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
