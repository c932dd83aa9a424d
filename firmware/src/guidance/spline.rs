//! A path of any shape: a uniform B-spline of degree 5 in x, y, z and yaw.
//!
//! Continuous down to snap within the path. Each derivative is a spline of lower degree in the differences of the same
//! control points, so that position and derivatives agree to rounding. Time is split into segment and fraction in whole
//! ticks: the path is as exact after a day as after a second. Whoever makes a path (`sim-host/src/spline.rs` fits one
//! to waypoints or to a file) chooses its control points; this module evaluates them.

use nalgebra::Vector4;

use crate::math;
use crate::signals::{FlatReference, Tick};
use crate::validate::ConfigError;

/// Degree of the polynomials.
pub const DEGREE: usize = 5;
/// Control points that act on a segment.
const ACTIVE: usize = DEGREE + 1;
/// Greatest number of control points: 16 bytes each, 4 KiB of RAM in all.
pub const CONTROL_POINTS: usize = 256;
/// The longest path, ms: 4.5 h, so that segment and fraction are computed in 32 bits.
pub const DURATION_MAX_MS: u32 = 16_000_000;

/// A path in time; x, y and z in m, yaw in rad.
///
/// ```
/// use firmware::guidance::Spline;
/// // From rest at (0, 0, 2) to rest at (3, 0, 2), 4 s long: equal points at an end are a standstill there.
/// let mut control_points = heapless::Vec::new();
/// for x in [0.0, 0.0, 0.0, 0.0, 0.0, 3.0, 3.0, 3.0, 3.0, 3.0] {
///     control_points.push([x, 0.0, 2.0, 0.0]).expect("fits");
/// }
/// let path = Spline { begin_ms: 0, duration_ms: 4_000, repeat: false, turn_rad: 0.0, control_points };
/// assert_eq!(path.validate(), Ok(()));
/// // To the rounding of an f32.
/// assert!((path.at(2_000, 1).position.x - 1.5).abs() < 1e-6);
/// assert_eq!(path.at(9_999, 1).velocity.x, 0.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Spline {
    /// Flight time at which it begins, ms; before that, its first point is held.
    pub begin_ms: u32,
    /// Time that it takes, ms; afterwards, its last point is held.
    pub duration_ms: u32,
    /// Flown again and again. The control points then close a ring.
    pub repeat: bool,
    /// How far the heading turns in one round of a ring, rad: whole turns.
    pub turn_rad: f32,
    /// x, y, z, yaw. n segments of equal duration have n + 5 points, a ring has n.
    pub control_points: heapless::Vec<[f32; 4], CONTROL_POINTS>,
}

/// Where in a path: its segment, and what of that has passed, 0 to 1.
struct Place {
    segment: u32,
    fraction: f32,
}

impl Spline {
    /// Number of segments.
    pub fn segments(&self) -> usize {
        if self.repeat { self.control_points.len() } else { self.control_points.len().saturating_sub(DEGREE) }
    }

    /// Refuses a path with too few points, without a duration, or with values that are not finite.
    ///
    /// # Errors
    /// The culprit's name.
    pub fn validate(&self) -> Result<(), ConfigError> {
        let segments = self.segments() as u32;
        let finite = self.control_points.iter().all(|point| math::all_finite(point)) && self.turn_rad.is_finite();
        if !finite {
            return Err(ConfigError::NonFinite("trajectory.spline.control_points".into()));
        }
        let within = |name: &'static str, value: u32, low: u32, high: u32| {
            if (low..=high).contains(&value) {
                return Ok(());
            }
            Err(ConfigError::OutOfRange { field: name.into(), low: low as f32, high: high as f32 })
        };
        let points = self.control_points.len() as u32;
        within("trajectory.spline.control_points", points, ACTIVE as u32, CONTROL_POINTS as u32)?;
        // A segment lasts 10 ms at least.
        within("trajectory.spline.duration_ms", self.duration_ms, 10 * segments, DURATION_MAX_MS)?;
        within("trajectory.spline.begin_ms", self.begin_ms, 0, DURATION_MAX_MS)
    }

    /// The reference `ticks` after the start of the flight, with so many ticks in a millisecond.
    pub fn at(&self, ticks: Tick, ticks_per_ms: u32) -> FlatReference {
        let begin = u64::from(self.begin_ms) * u64::from(ticks_per_ms);
        let duration = (u64::from(self.duration_ms) * u64::from(ticks_per_ms)).max(1);
        match u64::from(ticks).checked_sub(begin) {
            None => self.rest(&Place { segment: 0, fraction: 0.0 }),
            Some(passed) if passed >= duration && !self.repeat => {
                self.rest(&Place { segment: (self.segments() as u32).saturating_sub(1), fraction: 1.0 })
            }
            Some(passed) => self.evaluate(&self.place(passed, duration)),
        }
    }

    /// Segment and fraction after `passed` of `duration` ticks.
    fn place(&self, passed: u64, duration: u64) -> Place {
        let scaled = passed.checked_rem(duration).unwrap_or(0) * self.segments() as u64;
        Place {
            segment: scaled.checked_div(duration).unwrap_or(0) as u32,
            fraction: scaled.checked_rem(duration).unwrap_or(0) as f32 / duration as f32,
        }
    }

    /// A standstill at a place of the path.
    fn rest(&self, place: &Place) -> FlatReference {
        let there = self.evaluate(place);
        FlatReference::standing(there.position, there.yaw)
    }

    /// A control point; those of a ring go on into its next round.
    fn point(&self, index: usize) -> Vector4<f32> {
        let count = self.control_points.len();
        let (index, turn) = if index < count { (index, 0.0) } else { (index - count, self.turn_rad) };
        let mut point = self.control_points.get(index).copied().map_or_else(Vector4::zeros, Vector4::from);
        point.w += turn;
        point
    }

    fn evaluate(&self, place: &Place) -> FlatReference {
        let per_second = 1000.0 * self.segments() as f32 / self.duration_ms as f32;
        let mut points: [Vector4<f32>; ACTIVE] = core::array::from_fn(|i| self.point(place.segment as usize + i));
        let bases = bases(place.fraction);
        let mut derivatives = [Vector4::zeros(); ACTIVE];
        let mut scale = 1.0;
        for (order, (derivative, basis)) in derivatives.iter_mut().zip(bases.iter().rev()).enumerate() {
            let weighted = points.iter().zip(basis).take(ACTIVE - order);
            *derivative = weighted.fold(Vector4::zeros(), |sum, (point, weight)| sum + point * *weight) * scale;
            differences(&mut points);
            scale *= per_second;
        }
        let [place, rate, acceleration, jerk, snap, _] = derivatives;
        FlatReference {
            position: place.xyz(),
            velocity: rate.xyz(),
            acceleration: acceleration.xyz(),
            jerk: jerk.xyz(),
            snap: snap.xyz(),
            yaw: math::wrap_angle(place.w),
            yaw_rate: rate.w,
            yaw_acceleration: acceleration.w,
        }
    }
}

/// Each point becomes its difference to the next one; the last one has none and is of no further use.
fn differences(points: &mut [Vector4<f32>; ACTIVE]) {
    let next = *points;
    for (point, next) in points.iter_mut().zip(next.iter().skip(1)) {
        *point = next - *point;
    }
}

/// Weights of the points on a segment, for each degree from 0 up (Cox–de Boor on uniform knots): of degree p,
/// Nᵢ = ((u + p − i) Nᵢ₋₁ + (i + 1 − u) Nᵢ) / p, where those on the right are of degree p − 1.
fn bases(u: f32) -> [[f32; ACTIVE]; ACTIVE] {
    /// 1/p.
    const INVERSE: [f32; ACTIVE] = [1.0, 1.0, 0.5, 1.0 / 3.0, 0.25, 0.2];
    let mut all = [[0.0; ACTIVE]; ACTIVE];
    let mut last = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    for (p, (basis, inverse)) in all.iter_mut().zip(INVERSE).enumerate() {
        if p > 0 {
            let mut before = 0.0;
            for (i, value) in last.iter_mut().enumerate().take(p + 1) {
                let i = i as f32;
                let now = ((u + p as f32 - i) * before + (i + 1.0 - u) * *value) * inverse;
                before = core::mem::replace(value, now);
            }
        }
        *basis = last;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(points: usize, repeat: bool) -> Spline {
        let control_points = (0..points)
            .map(|i| {
                let angle = i as f64 * core::f64::consts::TAU / points as f64;
                [(3.0 * angle.sin()) as f32, (2.0 * angle.cos()) as f32, 2.0 + 0.1 * (i % 3) as f32, angle as f32]
            })
            .collect();
        let turn_rad = core::f32::consts::TAU;
        Spline { begin_ms: 500, duration_ms: 7_919, repeat, turn_rad, control_points }
    }

    /// By de Boor's recursion in f64, with knots and times in s.
    fn de_boor(path: &Spline, t: f64) -> [f64; 4] {
        let h = f64::from(path.duration_ms) * 1e-3 / path.segments() as f64;
        let s = (t - f64::from(path.begin_ms) * 1e-3) / h;
        let segment = s.floor();
        let u = s - segment;
        let mut d: Vec<[f64; 4]> =
            (0..=DEGREE).map(|i| path.point(segment as usize + i).map(f64::from).into()).collect();
        for level in 1..=DEGREE {
            for i in (level..=DEGREE).rev() {
                let alpha = (u + (DEGREE - i) as f64) / (DEGREE + 1 - level) as f64;
                d[i] = core::array::from_fn(|k| (1.0 - alpha) * d[i - 1][k] + alpha * d[i][k]);
            }
        }
        d[DEGREE]
    }

    #[test]
    fn the_value_is_de_boors() {
        let path = wave(20, false);
        for ticks in (500..8_400).step_by(37) {
            let (here, exact) = (path.at(ticks, 1), de_boor(&path, f64::from(ticks) * 1e-3));
            for (value, exact) in here.position.iter().zip(exact) {
                assert!((f64::from(*value) - exact).abs() < 2e-6, "{ticks}: {value} {exact}");
            }
        }
    }

    #[test]
    fn it_is_continuous_to_snap_where_segments_and_rounds_meet() {
        // 20 segments of 400 ms: each begins at a tick.
        let path = Spline { begin_ms: 0, duration_ms: 8_000, ..wave(20, true) };
        for segment in 1..=20 {
            let last = path.evaluate(&Place { segment: segment - 1, fraction: 1.0 });
            let next = path.at(segment * 400, 1);
            assert!((last.position - next.position).norm() < 2e-6);
            assert!((last.velocity - next.velocity).norm() < 1e-5);
            assert!((last.acceleration - next.acceleration).norm() < 5e-5);
            assert!((last.jerk - next.jerk).norm() < 2e-4);
            assert!((last.snap - next.snap).norm() < 1e-3);
            assert!(math::abs(math::wrap_angle(last.yaw - next.yaw)) < 2e-6);
            assert!(math::abs(last.yaw_rate - next.yaw_rate) < 1e-5);
        }
    }

    #[test]
    fn a_ring_is_the_same_after_an_hour_and_on_finer_ticks() {
        let path = wave(20, true);
        for ticks in [600, 3_000, 8_000] {
            assert_eq!(path.at(ticks, 1), path.at(ticks + 450 * 7_919, 1));
            assert_eq!(path.at(ticks, 1), path.at(100 * ticks, 100));
        }
    }

    #[test]
    fn before_and_after_it_stands() {
        let path = wave(20, false);
        let (first, last) = (path.at(500, 1), path.evaluate(&Place { segment: 14, fraction: 1.0 }));
        assert_eq!(path.at(3, 1), FlatReference::standing(first.position, first.yaw));
        assert_eq!(path.at(9_000, 1), FlatReference::standing(last.position, last.yaw));
    }

    #[test]
    fn a_bad_path_is_refused_by_name() {
        assert_eq!(wave(256, false).validate(), Ok(()));
        let out_of = |name: &'static str, low, high| ConfigError::OutOfRange { field: name.into(), low, high };
        let refused = |bad: Spline, error| assert_eq!(bad.validate(), Err(error));
        refused(wave(5, true), out_of("trajectory.spline.control_points", 6.0, 256.0));
        let duration = out_of("trajectory.spline.duration_ms", 200.0, 16e6);
        refused(Spline { duration_ms: 0, ..wave(20, true) }, duration);
        refused(Spline { begin_ms: u32::MAX, ..wave(20, true) }, out_of("trajectory.spline.begin_ms", 0.0, 16e6));
        let not_finite = ConfigError::NonFinite("trajectory.spline.control_points".into());
        refused(Spline { turn_rad: f32::NAN, ..wave(20, true) }, not_finite);
    }
}
