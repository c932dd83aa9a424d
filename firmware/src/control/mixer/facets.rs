//! Facets of the attainable set of U, computed once from the geometry.
//!
//! The attainable set {B ω² : 0 ≤ ωi² ≤ limit} is a zonotope: a sum of segments, one per rotor. So are its projections
//! on (U2, U3) and (U1, U2, U3), and the set without some of the rotors. The normal of a facet is perpendicular to the
//! segments that span it, so normals depend on the geometry alone; the limits only set how far the zonotope extends
//! along each normal. A limit may be zero: the zonotopes are nested, so the facets also hold in that case.
//!
//! All normals are computed with the rows of B scaled to unit norm, so that N and N m have the same weight.

use core::fmt::Debug;

use crate::math;

/// A rotor's column of B: its contribution to U1..U4 per unit of ω².
pub(super) type Column = [f32; 4];

/// Two directions closer than this (rad) are parallel, and a volume smaller than this fraction of the product of its
/// edges is flat: well above f32 rounding, well below the angles between the rotors of a vehicle.
pub(super) const PARALLEL: f32 = 1e-4;
/// Greatest difference between two normals that count as equal.
const SAME: f32 = 1e-5;
/// Fraction of a sum's terms that may be rounding.
const ROUNDING: f32 = 1e-6;

/// A pair of opposite facets as a bound on a coordinate `x` when K others are known: `|x + normal·known − middle| ≤
/// half`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet<const K: usize> {
    normal: [f32; K],
    middle: f32,
    half: f32,
}

impl<const K: usize> Facet<K> {
    /// The facet with the given normal, scaled so that its component along `x` is 1; `None` if it does not bound `x`.
    fn bounding(x: f32, known: [f32; K]) -> Option<Self> {
        (math::abs(x) > PARALLEL).then(|| Self { normal: known.map(|v| v / x), middle: 0.0, half: 0.0 })
    }

    /// The value nearest to `x` within the bound.
    #[inline]
    pub(super) fn nearest(&self, x: f32, known: &[f32; K]) -> f32 {
        let middle = self.normal.iter().zip(known).fold(self.middle, |middle, (n, v)| middle - n * v);
        let beyond = x - middle;
        if math::abs(beyond) > self.half {
            return if beyond > 0.0 { middle + self.half } else { middle - self.half };
        }
        x
    }

    /// The smaller of `fraction` and the greatest fraction of `known` that is within the bound. The origin always is,
    /// because rotors may stop.
    #[inline]
    pub(super) fn shorten(&self, fraction: f32, known: &[f32; K]) -> f32 {
        let along = dot(&self.normal, known);
        let beyond = along - self.middle;
        if math::abs(beyond) > self.half {
            let bound = if beyond > 0.0 { self.middle + self.half } else { self.middle - self.half };
            return math::min(fraction, bound / along);
        }
        fraction
    }

    /// Sets `middle` and `half` from the rotors: for each, its limit and its contribution to `x` and to the known
    /// coordinates per unit of ω². The facet is then moved outwards by `slack` on each limit.
    pub(super) fn reach(&mut self, slack: f32, rotors: impl Iterator<Item = (f32, f32, [f32; K])>) {
        (self.middle, self.half) = (0.0, 0.0);
        for (limit, x, known) in rotors {
            let along = x + dot(&self.normal, &known);
            let terms = self.normal.iter().zip(known).fold(math::abs(x), |sum, (n, v)| sum + math::abs(n * v));
            // A rotor parallel to the facet must not move it by rounding, nor leave an origin on it outside.
            if math::abs(along) > ROUNDING * terms {
                self.middle += 0.5 * limit * along;
                self.half += (0.5 * limit + slack) * math::abs(along);
            }
        }
    }

    fn is_same(&self, other: &Self) -> bool {
        self.normal.iter().zip(&other.normal).all(|(a, b)| math::abs(a - b) <= SAME * (1.0 + math::abs(*a)))
    }
}

/// A list of facets with the capacity that a number of rotors needs.
pub trait Table<const K: usize>: Clone + Debug + Default + PartialEq {
    /// The facets.
    fn facets(&self) -> &[Facet<K>];
    /// The facets, mutable.
    fn facets_mut(&mut self) -> &mut [Facet<K>];
    /// Adds a facet, unless it is `None` or equal to one from index `from` on.
    fn add(&mut self, from: usize, facet: Option<Facet<K>>);

    /// Converts normals found with scaled rows to those for U in N and N m.
    fn rescale(&mut self, units: [f32; K]) {
        for facet in self.facets_mut() {
            for (v, unit) in facet.normal.iter_mut().zip(units) {
                *v *= unit;
            }
        }
    }
}

impl<const K: usize, const CAPACITY: usize> Table<K> for heapless::Vec<Facet<K>, CAPACITY> {
    #[inline]
    fn facets(&self) -> &[Facet<K>] {
        self
    }

    fn facets_mut(&mut self) -> &mut [Facet<K>] {
        self
    }

    fn add(&mut self, from: usize, facet: Option<Facet<K>>) {
        let Some(facet) = facet else { return };
        if !self.iter().skip(from).any(|other| other.is_same(&facet)) {
            // Never full: there is room for every pair or triple of rotors.
            let _ = self.push(facet);
        }
    }
}

/// The facet tables of a number of rotors.
pub trait Layout {
    /// Bounds on (U2, U3): one facet per rotor.
    type Torque: Table<2>;
    /// Bounds on U1, given (U2, U3): one per pair of rotors.
    type Thrust: Table<2>;
    /// Bounds on U4, given (U1, U2, U3): one per triple. Four rotors need none: their own limits are these facets.
    type Yaw: Table<3>;
    /// Bounds on the speed of each rotor from the fifth on, given U: one per triple of the rotors before it.
    type Spare: Table<4>;
}

/// A number of rotors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rotors<const N: usize>;

macro_rules! layout {
    ($n:literal, $pairs:literal, $triples:literal, $spare:literal) => {
        impl Layout for Rotors<$n> {
            type Torque = heapless::Vec<Facet<2>, $n>;
            type Thrust = heapless::Vec<Facet<2>, $pairs>;
            type Yaw = heapless::Vec<Facet<3>, $triples>;
            type Spare = heapless::Vec<Facet<4>, $spare>;
        }
    };
}

// The counts are n, C(n, 2), C(n, 3) for n > 4, and the sum of C(k, 3) for 4 ≤ k < n.
layout!(4, 6, 0, 0);
layout!(5, 10, 10, 4);
layout!(6, 15, 20, 14);
layout!(7, 21, 35, 34);
layout!(8, 28, 56, 69);

/// Facets of (U2, U3), for [`Facet::shorten`]. Normals are scaled to a 1-norm of 1, so that no torque overflows.
pub(super) fn torque<const N: usize, T: Table<2>>(columns: &[Column; N], scale: &[f32; 4]) -> T {
    let mut table = T::default();
    for [_, roll, pitch, _] in columns {
        let size = math::sqrt(roll * roll + pitch * pitch);
        if size > PARALLEL {
            let (a, b) = (-pitch / size, roll / size);
            // A normal and its opposite are made equal.
            let sign = if math::abs(a) > SAME { a } else { b };
            let normal = if sign < 0.0 { [-a, -b] } else { [a, b] };
            table.add(0, Some(Facet { normal, middle: 0.0, half: 0.0 }));
        }
    }
    let [_, roll, pitch, _] = *scale;
    table.rescale([roll, pitch]);
    for Facet { normal, .. } in table.facets_mut() {
        let [a, b] = *normal;
        *normal = normal.map(|v| v / (math::abs(a) + math::abs(b)));
    }
    table
}

/// Facets of (U1, U2, U3) that bound U1 when (U2, U3) is known. The remaining ones are facets of (U2, U3).
pub(super) fn thrust<const N: usize, T: Table<2>>(columns: &[Column; N], scale: &[f32; 4]) -> T {
    let mut table = T::default();
    for (i, a) in columns.iter().enumerate() {
        for b in columns.iter().skip(i + 1) {
            if let Some([x, roll, pitch]) = cross_3(a, b) {
                table.add(0, Facet::bounding(x, [roll, pitch]));
            }
        }
    }
    let [x, roll, pitch, _] = *scale;
    table.rescale([roll / x, pitch / x]);
    table
}

/// Facets of U that bound U4 when (U1, U2, U3) is known, for more than four rotors. The remaining ones are facets of
/// (U1, U2, U3).
pub(super) fn yaw<const N: usize, T: Table<3>>(columns: &[Column; N], scale: &[f32; 4]) -> T {
    let mut table = T::default();
    if N == 4 {
        return table;
    }
    for_each_triple(columns.iter(), |[thrust, roll, pitch, x]| {
        table.add(0, Facet::bounding(x, [thrust, roll, pitch]));
    });
    let [thrust, roll, pitch, x] = *scale;
    table.rescale([thrust / x, roll / x, pitch / x]);
    table
}

/// Appends the facets that bound the speed of the rotor `last` when U is known, such that the `others` can give the
/// rest.
pub(super) fn spare<'a, T: Table<4>>(table: &mut T, last: &Column, others: impl Iterator<Item = &'a Column> + Clone) {
    let from = table.facets().len();
    let size = math::sqrt(dot(last, last));
    for_each_triple(others, |normal| {
        // The rest is U minus the last rotor's contribution, hence the opposite sign of its speed along the normal.
        let x = dot(&normal, last) / size;
        table.add(from, Facet::bounding(x, normal.map(|v| -v / size)));
    });
}

/// Orders the rotors: first four that span U1..U4 well, each with the largest component perpendicular to those before
/// it (Gram–Schmidt with pivoting), then the others.
pub(super) fn order<const N: usize>(columns: &[Column; N]) -> [usize; N] {
    let mut order = core::array::from_fn(|i| i);
    let mut beyond = *columns;
    for k in 0..4 {
        let mut best = k;
        for i in k..N {
            if dot(&beyond[i], &beyond[i]) > dot(&beyond[best], &beyond[best]) {
                best = i;
            }
        }
        order.swap(k, best);
        beyond.swap(k, best);
        let direction = beyond[k];
        let square = dot(&direction, &direction);
        for column in beyond.iter_mut().skip(k + 1) {
            let component = dot(column, &direction) / square;
            for (v, d) in column.iter_mut().zip(direction) {
                *v -= component * d;
            }
        }
    }
    order
}

/// Dot product.
#[inline]
pub(super) fn dot<const K: usize>(a: &[f32; K], b: &[f32; K]) -> f32 {
    a.iter().zip(b).map(|(a, b)| a * b).reduce(|sum, v| sum + v).unwrap_or(0.0)
}

/// Calls `found` with the unit normal to each triple of columns that is not coplanar.
fn for_each_triple<'a>(columns: impl Iterator<Item = &'a Column> + Clone, mut found: impl FnMut(Column)) {
    let mut after_a = columns;
    while let Some(a) = after_a.next() {
        let mut after_b = after_a.clone();
        while let Some(b) = after_b.next() {
            for c in after_b.clone() {
                if let Some(normal) = cross_4(a, b, c) {
                    found(normal);
                }
            }
        }
    }
}

/// Unit normal to the first three components of two columns; `None` if they are parallel.
fn cross_3(a: &Column, b: &Column) -> Option<[f32; 3]> {
    let ([a1, a2, a3, _], [b1, b2, b3, _]) = (*a, *b);
    let edges = (a1 * a1 + a2 * a2 + a3 * a3) * (b1 * b1 + b2 * b2 + b3 * b3);
    unit([a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1], edges)
}

/// Unit normal to three columns; `None` if they are coplanar.
fn cross_4(a: &Column, b: &Column, c: &Column) -> Option<Column> {
    let ([a1, a2, a3, a4], [b1, b2, b3, b4], [c1, c2, c3, c4]) = (*a, *b, *c);
    let (m12, m13, m14) = (b1 * c2 - b2 * c1, b1 * c3 - b3 * c1, b1 * c4 - b4 * c1);
    let (m23, m24, m34) = (b2 * c3 - b3 * c2, b2 * c4 - b4 * c2, b3 * c4 - b4 * c3);
    let normal = [
        a2 * m34 - a3 * m24 + a4 * m23,
        -(a1 * m34 - a3 * m14 + a4 * m13),
        a1 * m24 - a2 * m14 + a4 * m12,
        -(a1 * m23 - a2 * m13 + a3 * m12),
    ];
    unit(normal, dot(a, a) * dot(b, b) * dot(c, c))
}

/// Normalises a normal; `None` if its square is only rounding beside the product of its edges' squares.
fn unit<const K: usize>(normal: [f32; K], edges: f32) -> Option<[f32; K]> {
    let square = dot(&normal, &normal);
    let size = math::sqrt(square);
    (square > PARALLEL * PARALLEL * edges).then(|| normal.map(|v| v / size))
}
