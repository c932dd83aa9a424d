//! From rows to the points of a line: errors, their rates, angles, and few enough points for a small file.

use crate::record::Row;
use crate::report::angles::roll_pitch_yaw;
use crate::report::metrics::errors;

/// A line's points in the units of its panel.
pub(super) type Points = Vec<(f64, f64)>;

/// A time series with more points than this is thinned: more than a panel has pixels.
const MOST_POINTS: usize = 2000;
/// Buckets of a thinned time series, each of which keeps its lowest and its highest point.
const BUCKETS: usize = 700;

/// A quantity of a row over time.
pub(super) fn over_time(rows: &[Row], value: impl Fn(&Row) -> f64) -> Points {
    thin_series(rows.iter().map(|row| (row.t, value(row))).collect())
}

/// Error rate over error of one axis: (e, ė), with ė by central differences, since a row has no reference rate.
pub(super) fn phase(rows: &[Row], axis: usize) -> Points {
    let error = |row: &Row| errors(row)[axis];
    let rate = |k: usize| {
        let (before, after) = (&rows[k.saturating_sub(1)], &rows[(k + 1).min(rows.len() - 1)]);
        (error(after) - error(before)) / (after.t - before.t)
    };
    thin_path(rows.iter().enumerate().map(|(k, row)| (error(row), rate(k))).collect())
}

/// Roll, pitch, yaw in degrees.
pub(super) fn angles_deg(row: &Row) -> [f64; 3] {
    roll_pitch_yaw(row.attitude).map(f64::to_degrees)
}

/// Thins a series whose first coordinate ascends, keeping every peak to the bucket: what chatters still looks so.
pub(super) fn thin_series(mut points: Points) -> Points {
    points.retain(visible);
    if points.len() <= MOST_POINTS {
        return points;
    }
    // The ends stay, so that all panels of a figure cover the same time.
    let inner = &points[1..points.len() - 1];
    let thinned = inner.chunks(inner.len().div_ceil(BUCKETS)).flat_map(lowest_and_highest);
    points.first().copied().into_iter().chain(thinned).chain(points.last().copied()).collect()
}

/// A bucket's lowest and highest point, in the order in which they came.
fn lowest_and_highest(bucket: &[(f64, f64)]) -> impl Iterator<Item = (f64, f64)> {
    let pick = |better: fn(f64, f64) -> bool| {
        (1..bucket.len()).fold(0, |best, i| if better(bucket[i].1, bucket[best].1) { i } else { best })
    };
    let (low, high) = (pick(|a, b| a < b), pick(|a, b| a > b));
    let second = (low != high).then(|| bucket[low.max(high)]);
    std::iter::once(bucket[low.min(high)]).chain(second)
}

/// Thins a path that may go anywhere: drops points that lie too close to the last one kept to be seen, and of one
/// that jumps all over the panel, evenly many.
pub(super) fn thin_path(mut points: Points) -> Points {
    points.retain(visible);
    let size = |range: Option<(f64, f64)>| range.map_or(1.0, |(low, high)| high - low);
    let (width, height) = (size(extent(points.iter().map(|p| p.0))), size(extent(points.iter().map(|p| p.1))));
    for closeness in [0.001, 0.002, 0.004, 0.008] {
        if points.len() > MOST_POINTS {
            drop_close(&mut points, closeness * width, closeness * height);
        }
    }
    let stride = points.len().div_ceil(MOST_POINTS).max(1);
    points.into_iter().step_by(stride).collect()
}

/// Drops the points that lie within `dx` and `dy` of the last one kept.
fn drop_close(points: &mut Points, dx: f64, dy: f64) {
    let mut last = None;
    points.retain(|&(x, y)| {
        let far = last.is_none_or(|(a, b): (f64, f64)| (x - a).abs() > dx || (y - b).abs() > dy);
        if far {
            last = Some((x, y));
        }
        far
    });
}

/// Beyond this a flight has diverged and the rest of it is not drawn: pixels would overflow.
const DIVERGED: f64 = 1e9;

/// False for a NaN too.
fn drawable(value: f64) -> bool {
    value.abs() < DIVERGED
}

fn visible(point: &(f64, f64)) -> bool {
    drawable(point.0) && drawable(point.1)
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
    use super::super::tests::{approach, flight};
    use super::*;

    #[test]
    fn thinning_keeps_order_and_peaks() {
        let mut points: Points = (0..20_000).map(|k| (f64::from(k), f64::from(k % 7))).collect();
        points[12_345].1 = 99.0;
        points[777].1 = f64::NAN;
        let thin = thin_series(points);
        assert!(thin.len() <= 2 * BUCKETS + 2);
        assert_eq!((thin[0].0, thin[thin.len() - 1].0), (0.0, 19_999.0));
        assert!(thin.contains(&(12_345.0, 99.0)));
        assert!(thin.is_sorted_by(|a, b| a.0 < b.0));
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
        let rows = flight(1.9);
        let e0 = 5.0;
        // y's error is e0 (1 + t/τ) exp(−t/τ); its rate −e0 t/τ² exp(−t/τ). Central differences err by h²/6·e‴ < 1e-4.
        for (k, (error, rate)) in phase(&rows, 1).into_iter().enumerate().skip(1).take(1898) {
            let (e, de) = approach(e0, rows[k].t);
            assert!((error - e).abs() < 1e-9 && (rate - de).abs() < 1e-3, "row {k}: {rate} instead of {de}");
        }
    }

    #[test]
    fn nothing_gives_nothing() {
        assert_eq!(phase(&[], 0), []);
        assert_eq!(thin_series(vec![]), []);
        assert_eq!(extent([f64::NAN].into_iter()), None);
    }
}
