//! Fits paths: the control points of a [`Spline`] that meets points exactly, or a table of rows closely.
//!
//! Both are one least-squares problem with equality constraints. What is minimised is the sum of squared fourth
//! differences of the control points, which stands for the integral of snap² (minimum snap), and, for rows, the squared
//! distance to each. It is solved by elimination on its optimality conditions, in f64 and in a fixed order.

use anyhow::{Result, bail};
use firmware::guidance::{CONTROL_POINTS, DEGREE, Spline};

/// Control points that act on a segment.
const ACTIVE: usize = DEGREE + 1;
/// The most segments of a path that does not repeat.
pub const SEGMENTS_MAX: usize = CONTROL_POINTS - DEGREE;
/// Weight of a fourth difference beside that of a row: rows decide, and where there are none, the path is smooth.
const SMOOTHNESS: f64 = 1e-9;

/// x, y, z in m and yaw in rad, at a place counted in segments from the beginning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot {
    /// Segments passed.
    pub at: f64,
    /// x, y, z, yaw.
    pub value: [f64; 4],
}

/// A path to be fitted.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// Number of segments.
    pub segments: usize,
    /// Whether the control points close a ring.
    pub repeat: bool,
    /// By how much yaw grows in a round of a ring, rad.
    pub turn: f64,
    /// A standstill at the beginning, and at the end, with as many derivatives as the laws use.
    pub rest: [Option<[f64; 4]>; 2],
}

/// One linear condition on the control points.
struct Row {
    first: usize,
    weights: [f64; ACTIVE],
    value: [f64; 4],
}

/// Weights of the six control points that act at `u`, 0 to 1, of a segment: Cox–de Boor on uniform knots.
pub fn weights(u: f64) -> [f64; ACTIVE] {
    let mut weights = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    for p in 1..ACTIVE {
        let mut before = 0.0;
        for (i, weight) in weights.iter_mut().enumerate().take(p + 1) {
            let now = ((u + (p as f64 - i as f64)) * before + (i as f64 + 1.0 - u) * *weight) / p as f64;
            before = std::mem::replace(weight, now);
        }
    }
    weights
}

impl Row {
    fn through(knot: &Knot, segments: usize) -> Self {
        let first = (knot.at.max(0.0) as usize).min(segments - 1);
        Self { first, weights: weights(knot.at - first as f64), value: knot.value }
    }

    fn smooth(first: usize) -> Self {
        Self { first, weights: [1.0, -4.0, 6.0, -4.0, 1.0, 0.0], value: [0.0; 4] }
    }

    fn point(index: usize, value: [f64; 4]) -> Self {
        Self { first: index, weights: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0], value }
    }

    /// Columns and weights among `count` control points, and the value, with those of the next round of a ring brought
    /// back by `turn`.
    fn on(&self, count: usize, turn: f64) -> (Vec<(usize, f64)>, [f64; 4]) {
        let mut value = self.value;
        let mut columns = Vec::with_capacity(ACTIVE);
        for (offset, weight) in self.weights.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
            let index = self.first + offset;
            value[3] -= weight * turn * (index / count) as f64;
            columns.push((index % count, *weight));
        }
        (columns, value)
    }
}

impl Shape {
    fn count(&self) -> usize {
        if self.repeat { self.segments } else { self.segments + DEGREE }
    }

    /// The conditions of a standstill: the points that act at an end are equal.
    fn rest_rows(&self) -> impl Iterator<Item = Row> {
        let ends = self.rest.into_iter().zip([0, self.segments]);
        ends.filter_map(|(rest, first)| Some((rest?, first)))
            .flat_map(|(value, first)| (first..first + DEGREE).map(move |index| Row::point(index, value)))
    }

    /// Control points of the smoothest path through all of `through` that comes closest to all of `near`.
    ///
    /// # Errors
    /// The conditions contradict each other: points too close to each other for the number of segments.
    pub fn fit(&self, through: &[Knot], near: &[Knot]) -> Result<Vec<[f64; 4]>> {
        let count = self.count();
        let exact = through.iter().map(|knot| Row::through(knot, self.segments)).chain(self.rest_rows());
        let exact: Vec<Row> = exact.collect();
        let mut system = System::new(count + exact.len());
        let smooth = if self.repeat { count } else { count - 4 };
        let weight = if near.is_empty() { 1.0 } else { SMOOTHNESS };
        for first in 0..smooth {
            system.add_square(&Row::smooth(first).on(count, self.turn), weight);
        }
        for knot in near {
            let share = self.segments as f64 / near.len() as f64;
            system.add_square(&Row::through(knot, self.segments).on(count, self.turn), share);
        }
        for (place, row) in exact.iter().enumerate() {
            system.add_constraint(count + place, &row.on(count, self.turn));
        }
        system.solve(count)
    }
}

/// Linear equations, each with four right-hand sides: dense, a row of numbers each.
struct System {
    rows: Vec<Vec<f64>>,
    size: usize,
}

impl System {
    fn new(size: usize) -> Self {
        Self { rows: vec![vec![0.0; size + 4]; size], size }
    }

    /// Adds `weight`·(row·c − value)²: its gradient.
    fn add_square(&mut self, (columns, value): &(Vec<(usize, f64)>, [f64; 4]), weight: f64) {
        for (i, wi) in columns {
            for (j, wj) in columns {
                self.rows[*i][*j] += weight * wi * wj;
            }
            for (k, v) in value.iter().enumerate() {
                self.rows[*i][self.size + k] += weight * wi * v;
            }
        }
    }

    /// Row·c = value, with its multiplier at `place`.
    fn add_constraint(&mut self, place: usize, (columns, value): &(Vec<(usize, f64)>, [f64; 4])) {
        for (i, weight) in columns {
            self.rows[place][*i] += weight;
            self.rows[*i][place] += weight;
        }
        self.rows[place][self.size..].copy_from_slice(value);
    }

    /// The first `count` unknowns, by elimination with partial pivoting.
    fn solve(mut self, count: usize) -> Result<Vec<[f64; 4]>> {
        for pivot in 0..self.size {
            self.eliminate(pivot)?;
        }
        let mut solution = vec![[0.0; 4]; self.size];
        for i in (0..self.size).rev() {
            solution[i] = std::array::from_fn(|k| {
                let known: f64 = (i + 1..self.size).map(|j| self.rows[i][j] * solution[j][k]).sum();
                (self.rows[i][self.size + k] - known) / self.rows[i][i]
            });
        }
        solution.truncate(count);
        Ok(solution)
    }

    fn eliminate(&mut self, pivot: usize) -> Result<()> {
        let size = |row: usize| self.rows[row][pivot].abs();
        let best = (pivot..self.size).max_by(|a, b| size(*a).total_cmp(&size(*b))).unwrap_or(pivot);
        if size(best) < 1e-14 {
            bail!("the points are too close to each other in time");
        }
        self.rows.swap(pivot, best);
        let (upper, lower) = self.rows.split_at_mut(pivot + 1);
        let above = &upper[pivot];
        for row in lower.iter_mut().filter(|row| row[pivot] != 0.0) {
            let factor = row[pivot] / above[pivot];
            for (value, above) in row.iter_mut().zip(above).skip(pivot) {
                *value -= factor * above;
            }
        }
        Ok(())
    }
}

/// x, y, z, yaw of control points at a place counted in segments; `turn` is added with each round of a ring.
pub fn value(points: &[[f64; 4]], shape: &Shape, at: f64) -> [f64; 4] {
    let row = Row::through(&Knot { at, value: [0.0; 4] }, shape.segments);
    let (columns, offset) = row.on(points.len(), shape.turn);
    let mut value = [0.0, 0.0, 0.0, -offset[3]];
    for (index, weight) in columns {
        for (sum, point) in value.iter_mut().zip(points[index]) {
            *sum += weight * point;
        }
    }
    value
}

/// As the firmware flies it, from `begin_ms` on for `duration_ms`.
pub fn for_firmware(shape: &Shape, points: &[[f64; 4]], begin_ms: u32, duration_ms: u32) -> Spline {
    Spline {
        begin_ms,
        duration_ms,
        repeat: shape.repeat,
        turn_rad: shape.turn as f32,
        control_points: points.iter().take(CONTROL_POINTS).map(|point| point.map(|v| v as f32)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REST: Shape =
        Shape { segments: 12, repeat: false, turn: 0.0, rest: [Some([0.0; 4]), Some([6.0, 2.0, 1.0, 3.0])] };

    fn away(a: [f64; 4], b: [f64; 4]) -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn a_path_meets_its_points_and_stands_at_its_ends() {
        let through = [Knot { at: 4.0, value: [1.0, 3.0, 0.5, 1.0] }, Knot { at: 7.3, value: [4.0, -1.0, 1.5, 2.0] }];
        let points = REST.fit(&through, &[]).expect("solvable");
        for knot in through {
            assert!(away(value(&points, &REST, knot.at), knot.value) < 1e-9);
        }
        for i in 1..DEGREE {
            assert!(away(points[0], points[i]) < 1e-9 && away(points[12], points[12 + i]) < 1e-9);
        }
    }

    #[test]
    fn the_smoothest_path_between_two_standstills_is_the_polynomial_of_minimum_snap() {
        // 35 τ⁴ − 84 τ⁵ + 70 τ⁶ − 20 τ⁷ has the least ∫snap² of all that begin and end with no velocity, acceleration
        // and jerk; the spline's snap is zero at its ends too, which costs it a little there.
        let shape = Shape { segments: 60, rest: [Some([0.0; 4]), Some([1.0; 4])], ..REST };
        let points = shape.fit(&[], &[]).expect("solvable");
        for i in 0..=60 {
            let t = f64::from(i) / 60.0;
            let exact = t.powi(4) * (35.0 - 84.0 * t + 70.0 * t * t - 20.0 * t.powi(3));
            assert!((value(&points, &shape, f64::from(i))[0] - exact).abs() < 0.02, "{i}");
        }
    }

    #[test]
    fn rows_of_a_circle_give_a_ring_that_turns_with_it() {
        let circle = |at: f64| {
            let angle = at * std::f64::consts::TAU / 16.0;
            [3.0 * angle.cos(), 3.0 * angle.sin(), 2.0, angle]
        };
        let near: Vec<Knot> =
            (0..1600).map(|i| f64::from(i) / 100.0).map(|at| Knot { at, value: circle(at) }).collect();
        let shape = Shape { segments: 16, repeat: true, turn: std::f64::consts::TAU, rest: [None; 2] };
        let points = shape.fit(&[], &near).expect("solvable");
        // h⁶/6! of the sixth derivative, within a factor.
        assert!(near.iter().all(|knot| away(value(&points, &shape, knot.at), knot.value) < 1e-4));
    }

    #[test]
    fn points_that_contradict_each_other_are_refused() {
        let twice = [Knot { at: 4.0, value: [1.0; 4] }, Knot { at: 4.0, value: [2.0; 4] }];
        assert!(REST.fit(&twice, &[]).is_err());
    }
}
