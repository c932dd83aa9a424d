//! From rows to the points of a line: errors, their rates, angles, and few enough points for a small file.
//!
//! A point that is not finite interrupts its line: where a reference jumps, where an angle passes from 180° to −180°,
//! and where a flight has diverged.

use crate::angles::roll_pitch_yaw;
use crate::record::Row;
use crate::report::metrics::errors;

/// A line's points in the units of its panel.
pub(super) type Points = Vec<(f64, f64)>;

/// Interrupts a line.
pub(super) const BREAK: (f64, f64) = (f64::NAN, f64::NAN);

/// A time series with more points than this is thinned: more than a panel has pixels.
const MOST_POINTS: usize = 1200;
/// Buckets of a thinned time series, each of which keeps its lowest and its highest point.
const BUCKETS: usize = 500;
/// A reference whose rate changes by this from one row to the next jumps, m/s: in a millisecond nothing that flies is
/// accelerated so.
const JUMP_M_S: f64 = 1.0;

/// A reference that is so much further in the next row has jumped there, m: the fastest that flies moves less.
const JUMP_M: f64 = 0.2;

/// An angle that changes by more from one row to the next has passed ±180°.
const HALF_A_TURN_DEG: f64 = 180.0;

/// A quantity of a row over time.
pub(super) fn over_time(rows: &[Row], value: impl Fn(&Row) -> f64) -> Points {
    thin_series(rows.iter().map(|row| (row.t, value(row))).collect())
}

/// An angle (°) over time, interrupted where it passes ±180°.
pub(super) fn angle_over_time(rows: &[Row], value: impl Fn(&Row) -> f64) -> Points {
    let mut points = Points::with_capacity(rows.len());
    for row in rows {
        let now = (row.t, value(row));
        if points.last().is_some_and(|before: &(f64, f64)| (now.1 - before.1).abs() > HALF_A_TURN_DEG) {
            points.push(BREAK);
        }
        points.push(now);
    }
    thin_series(points)
}

/// Error rate over error of one axis: (e, ė), with ė by central differences, since a row has no reference rate.
/// Interrupted where the reference jumps: there is no rate.
pub(super) fn phase(rows: &[Row], axis: usize) -> Points {
    let point = |k: usize| {
        let [before, now, after] = around(rows, k);
        // The velocity is known; only the reference has to be differentiated, and it is smooth where it does not jump.
        let rate = reference_rate(before, after, axis) - now.velocity[axis];
        if jumps(rows, k, axis) { BREAK } else { (errors(now)[axis], rate) }
    };
    thin_path((0..rows.len()).map(point).collect())
}

/// The reference's path, m, interrupted where it jumps to another place.
pub(super) fn reference_path(rows: &[Row]) -> Vec<[f64; 3]> {
    let is_far = |a: &Row, b: &Row| (0..3).any(|axis| (a.reference[axis] - b.reference[axis]).abs() > JUMP_M);
    let place = |k: usize| {
        let [before, now, after] = around(rows, k);
        let [x, y, z, _] = now.reference;
        if is_far(before, now) || is_far(now, after) { [f64::NAN; 3] } else { [x, y, z] }
    };
    (0..rows.len()).map(place).collect()
}

/// What a thinned line leaves out where it is interrupted: from its last point before to its first after.
pub(super) fn gaps(points: &[(f64, f64)]) -> Points {
    points.windows(3).filter(|three| three[1].0.is_nan()).flat_map(|three| [three[0], three[2], BREAK]).collect()
}

/// A row with the one before and the one after; at the ends, with itself.
fn around(rows: &[Row], k: usize) -> [&Row; 3] {
    [&rows[k.saturating_sub(1)], &rows[k], &rows[(k + 1).min(rows.len() - 1)]]
}

fn reference_rate(from: &Row, to: &Row, axis: usize) -> f64 {
    (to.reference[axis] - from.reference[axis]) / (to.t - from.t).max(f64::MIN_POSITIVE)
}

/// Whether the reference of an axis jumps right before or right after a row.
fn jumps(rows: &[Row], k: usize, axis: usize) -> bool {
    let [before, now, after] = around(rows, k);
    before.t < now.t
        && now.t < after.t
        && (reference_rate(before, now, axis) - reference_rate(now, after, axis)).abs() > JUMP_M_S
}

/// Roll, pitch, yaw in degrees.
pub(super) fn angles_deg(row: &Row) -> [f64; 3] {
    roll_pitch_yaw(row.attitude).map(f64::to_degrees)
}

/// Beyond this a flight has diverged and the rest of it is not drawn: no axis would show the rest.
const DIVERGED: f64 = 1e9;

/// False for a NaN too.
fn drawable(value: f64) -> bool {
    value.abs() < DIVERGED
}

fn visible(point: &(f64, f64)) -> bool {
    drawable(point.0) && drawable(point.1)
}

/// Makes one break of each run of points that cannot be drawn, and none of those at the ends.
fn interrupt(points: &mut Points) {
    for point in points.iter_mut().filter(|point| !visible(point)) {
        *point = BREAK;
    }
    points.dedup_by(|a, b| a.0.is_nan() && b.0.is_nan());
    if points.last().is_some_and(|last| last.0.is_nan()) {
        points.pop();
    }
    if points.first().is_some_and(|first| first.0.is_nan()) {
        points.remove(0);
    }
}

/// Thins a series whose first coordinate ascends, keeping every peak to the bucket: what chatters still looks so.
pub(super) fn thin_series(mut points: Points) -> Points {
    interrupt(&mut points);
    if points.len() <= MOST_POINTS {
        return points;
    }
    // The ends stay, so that all panels of a figure show the same time.
    let inner = &points[1..points.len() - 1];
    let thinned = inner.chunks(inner.len().div_ceil(BUCKETS)).flat_map(extremes);
    points.first().copied().into_iter().chain(thinned).chain(points.last().copied()).collect()
}

/// A bucket's lowest and highest point, in the order in which they came, with a break wherever the line is interrupted
/// before, between or after them.
fn extremes(bucket: &[(f64, f64)]) -> impl Iterator<Item = (f64, f64)> + use<> {
    let pick = |better: fn(f64, f64) -> bool| {
        let points = bucket.iter().enumerate().filter(|(_, p)| !p.0.is_nan());
        points.reduce(|best, next| if better(next.1.1, best.1.1) { next } else { best }).map_or(0, |(i, _)| i)
    };
    let (low, high) = (pick(|a, b| a < b), pick(|a, b| a > b));
    let (first, second) = (low.min(high), low.max(high));
    let gap = |from: usize, to: usize| bucket[from..to].iter().any(|p| p.0.is_nan()).then_some(BREAK);
    let last = (first != second).then(|| bucket[second]);
    [gap(0, first), Some(bucket[first]), gap(first, second), last, gap(second, bucket.len())].into_iter().flatten()
}

/// Thins a path that may go anywhere: drops points that lie too close to the last one kept to be seen, and of one
/// that jumps all over the panel, evenly many.
pub(super) fn thin_path(mut points: Points) -> Points {
    interrupt(&mut points);
    let size = |range: Option<(f64, f64)>| range.map_or(1.0, |(low, high)| high - low);
    let (width, height) = (size(extent(points.iter().map(|p| p.0))), size(extent(points.iter().map(|p| p.1))));
    for closeness in [0.001, 0.002, 0.004, 0.008] {
        if points.len() > MOST_POINTS {
            drop_close(&mut points, closeness * width, closeness * height);
        }
    }
    let stride = points.len().div_ceil(MOST_POINTS).max(1);
    let kept = points.into_iter().enumerate().filter(|(k, point)| k.is_multiple_of(stride) || point.0.is_nan());
    kept.map(|(_, point)| point).collect()
}

/// Drops the points that lie within `dx` and `dy` of the last one kept. The last of a line stays.
fn drop_close(points: &mut Points, dx: f64, dy: f64) {
    let end = points.len().saturating_sub(1);
    let (mut last, mut index): (Option<(f64, f64)>, usize) = (None, 0);
    points.retain(|&(x, y)| {
        let far = last.is_none_or(|(a, b)| a.is_nan() || x.is_nan() || (x - a).abs() > dx || (y - b).abs() > dy);
        let kept = far || index == end;
        index += 1;
        if kept {
            last = Some((x, y));
        }
        kept
    });
}

/// Lowest and highest of the values that can be drawn; `None` without any.
pub(super) fn extent(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.filter(|v| drawable(*v)).fold(None, |range, v| {
        let (low, high) = range.unwrap_or((v, v));
        Some((v.min(low), v.max(high)))
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::{approach, made_up};
    use super::*;

    #[test]
    fn thinning_keeps_order_and_peaks() {
        let mut points: Points = (0..20_000).map(|k| (f64::from(k), f64::from(k % 7))).collect();
        points[12_345].1 = 99.0;
        points[777].1 = f64::NAN;
        let thin = thin_series(points);
        assert!(thin.len() <= 2 * BUCKETS + 3);
        assert_eq!((thin[0].0, thin[thin.len() - 1].0), (0.0, 19_999.0));
        assert!(thin.contains(&(12_345.0, 99.0)));
        // Where a value is missing the line breaks, once.
        let (breaks, drawn): (Points, Points) = thin.iter().partition(|point| point.0.is_nan());
        assert_eq!(breaks.len(), 1);
        assert!(drawn.is_sorted_by(|a, b| a.0 < b.0));
    }

    #[test]
    fn short_series_stay_as_they_are() {
        let points: Points = (0..MOST_POINTS).map(|k| (k as f64, 1.0)).collect();
        assert_eq!(thin_series(points.clone()), points);
    }

    #[test]
    fn thinned_paths_stay_close() {
        let circle: Points = (0..50_000).map(|k| f64::from(k) * 1e-3).map(|a| (a.cos(), a.sin())).collect();
        let thin = thin_path(circle.clone());
        assert!(thin.len() <= MOST_POINTS && thin.len() > 100);
        let noise: Points = (0..50_000).map(|k| (f64::from(k * 619 % 1009), f64::from(k * 7919 % 997))).collect();
        assert!(thin_path(noise).len() <= MOST_POINTS);
    }

    #[test]
    fn phase_is_the_derivative_of_the_error() {
        let rows = made_up(1.1);
        let e0 = 5.0;
        // y's error is e0 (1 + t/τ) exp(−t/τ); its rate −e0 t/τ² exp(−t/τ). Central differences err by h²/6·e‴ < 1e-4.
        for (k, (error, rate)) in phase(&rows, 1).into_iter().enumerate().skip(1).take(1098) {
            let (e, de) = approach(e0, rows[k].t);
            assert!((error - e).abs() < 1e-9 && (rate - de).abs() < 1e-3, "row {k}: {rate} instead of {de}");
        }
    }

    #[test]
    fn a_jump_of_the_reference_has_no_rate() {
        let row = |k: u32| {
            let t = f64::from(k) * 1e-3;
            Row { t, reference: [if k < 100 { 0.0 } else { 5.0 }, 0.0, 0.0, 0.0], ..Row::default() }
        };
        let rows: Vec<_> = (0..200).map(row).collect();
        let points = phase(&rows, 0);
        assert_eq!(points.iter().filter(|p| p.0.is_nan()).count(), 1, "{points:?}");
        assert!(points.iter().all(|p| p.0.is_nan() || p.1.abs() < 1e-9), "{points:?}");
    }

    #[test]
    fn a_reference_that_jumps_is_two_places() {
        let row = |k: u32| {
            let at = if k < 100 { [0.0; 4] } else { [5.0, 3.0, 2.0, 0.0] };
            Row { t: f64::from(k) * 1e-3, reference: at, ..Row::default() }
        };
        let rows: Vec<_> = (0..200).map(row).collect();
        let plan = thin_path(reference_path(&rows).iter().map(|[x, y, _]| (*x, *y)).collect());
        let runs: Vec<Points> = plan.split(|p| p.0.is_nan()).map(<[_]>::to_vec).collect();
        assert_eq!(runs.len(), 2);
        assert!(runs[0].iter().all(|p| *p == (0.0, 0.0)) && runs[1].iter().all(|p| *p == (5.0, 3.0)), "{runs:?}");
        assert_eq!(gaps(&plan)[..2], [(0.0, 0.0), (5.0, 3.0)]);
    }

    #[test]
    fn an_angle_that_passes_180_degrees_is_interrupted() {
        let row = |k: u32| Row { t: f64::from(k), ..Row::default() };
        let rows: Vec<_> = (0..40_000).map(row).collect();
        let spins = |row: &Row| (row.t * 0.01 + 180.0).rem_euclid(360.0) - 180.0;
        let points = angle_over_time(&rows, spins);
        assert!(points.len() < 3 * BUCKETS);
        let joined = points.windows(2).filter(|pair| (pair[1].1 - pair[0].1).abs() > 180.0);
        assert_eq!(joined.count(), 0);
        // As a heading does that is held at 180°.
        let flips = |row: &Row| if (row.t as u32).is_multiple_of(7) { 180.0 } else { -179.9 };
        let points = angle_over_time(&rows, flips);
        assert_eq!(points.windows(2).filter(|pair| (pair[1].1 - pair[0].1).abs() > 180.0).count(), 0);
    }

    #[test]
    fn nothing_gives_nothing() {
        assert_eq!(phase(&[], 0), []);
        assert_eq!(thin_series(vec![]), []);
        assert_eq!(extent([f64::NAN].into_iter()), None);
    }
}
