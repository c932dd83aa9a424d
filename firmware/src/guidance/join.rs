//! The path that joins a trajectory from rest: a Bézier curve, continuous up to the snap where it meets the trajectory.
//!
//! The start fixes its first three control points (position, zero velocity, a given acceleration). The trajectory's
//! derivatives at the junction, position to snap, fix the last five. The points between shape the curve; a planner
//! chooses them together with the duration (`sim-host plan`).

use nalgebra::Vector3;

use crate::signals::{FlatReference, TICK_S, Tick};
use crate::validate::ConfigError;

/// Greatest number of control points between start and end.
pub const MIDDLE_POINTS: usize = 8;

/// Control points fixed by the start, and by the end.
const START_POINTS: usize = 3;
const END_POINTS: usize = 5;
const POINTS: usize = START_POINTS + MIDDLE_POINTS + END_POINTS;

/// A planned joining path.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct JoinPlan {
    /// Duration of the path, s; rounded to whole ticks.
    pub duration_s: f32,
    /// Acceleration at the start, m/s². Along z, because the vehicle is level there.
    #[cfg_attr(feature = "serde", serde(default))]
    pub start_acceleration_m_s2: [f32; 3],
    /// Control points between those that the start and the end fix, m.
    #[cfg_attr(feature = "serde", serde(default))]
    pub middle_m: heapless::Vec<[f32; 3], MIDDLE_POINTS>,
}

impl JoinPlan {
    /// Duration in ticks.
    pub fn duration_ticks(&self) -> Tick {
        (self.duration_s / TICK_S + 0.5) as Tick
    }

    /// Refuses a plan with NaN or an infinite value, or shorter than ten ticks.
    ///
    /// # Errors
    /// The field's name.
    pub fn validate(&self) -> Result<(), ConfigError> {
        // Rounds to ten ticks.
        ConfigError::require_within("join.duration_s", self.duration_s, 9.5 * TICK_S, 1e9)?;
        if !self.start_acceleration_m_s2.iter().all(|v| v.is_finite()) {
            return Err(ConfigError::NonFinite("join.start_acceleration_m_s2".into()));
        }
        if !self.middle_m.iter().flatten().all(|v| v.is_finite()) {
            return Err(ConfigError::NonFinite("join.middle_m".into()));
        }
        Ok(())
    }
}

/// A Bézier curve of position over time.
#[derive(Clone, Debug, PartialEq)]
pub struct JoinPath {
    duration: Tick,
    points: heapless::Vec<Vector3<f32>, POINTS>,
    yaw: f32,
}

impl JoinPath {
    /// The curve from rest at `start` to `end`, as planned.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] if the plan holds more points than fit.
    pub fn new(plan: &JoinPlan, start: Vector3<f32>, end: &FlatReference) -> Result<Self, ConfigError> {
        let duration = plan.duration_ticks();
        let degree = (START_POINTS + plan.middle_m.len() + END_POINTS - 1) as f32;
        let t = duration as f32 * TICK_S;
        // Unit of the k-th derivative: Tᵏ (n−k)!/n!.
        let u1 = t / degree;
        let u2 = u1 * t / (degree - 1.0);
        let u3 = u2 * t / (degree - 2.0);
        let u4 = u3 * t / (degree - 3.0);

        let mut points = heapless::Vec::new();
        let too_many =
            || ConfigError::OutOfRange { field: "join.middle_m".into(), low: 0.0, high: MIDDLE_POINTS as f32 };
        let mut push = |p: Vector3<f32>| points.push(p).map_err(|_| too_many());
        // Zero velocity: P1 = P0. The second difference is the acceleration.
        push(start)?;
        push(start)?;
        push(start + Vector3::from(plan.start_acceleration_m_s2) * u2)?;
        for point in &plan.middle_m {
            push(Vector3::from(*point))?;
        }
        // Backward differences at the end: Pn−k = Σ (−1)^j C(k,j) ∇^j Pn.
        let (p, d1, d2, d3, d4) =
            (end.position, end.velocity * u1, end.acceleration * u2, end.jerk * u3, end.snap * u4);
        push(p - d1 * 4.0 + d2 * 6.0 - d3 * 4.0 + d4)?;
        push(p - d1 * 3.0 + d2 * 3.0 - d3)?;
        push(p - d1 * 2.0 + d2)?;
        push(p - d1)?;
        push(p)?;
        Ok(Self { duration, points, yaw: end.yaw })
    }

    /// The curve from rest at `start` to `end` without points between, `duration` ticks long.
    ///
    /// # Errors
    /// None: its points fit.
    pub fn plain(duration: Tick, start: Vector3<f32>, end: &FlatReference) -> Result<Self, ConfigError> {
        let duration_s = duration as f32 * TICK_S;
        let plan = JoinPlan { duration_s, start_acceleration_m_s2: [0.0; 3], middle_m: heapless::Vec::new() };
        Self::new(&plan, start, end)
    }

    /// Length of the path in ticks.
    pub fn duration_ticks(&self) -> Tick {
        self.duration
    }

    /// Position to snap, `ticks` after the start of the flight (de Casteljau; the differences of the last five
    /// levels are the derivatives).
    pub fn at(&self, ticks: Tick) -> FlatReference {
        let u = ticks as f32 / self.duration as f32;
        let per_second = 1.0 / (self.duration as f32 * TICK_S);
        let mut reference = FlatReference::standing(Vector3::zeros(), self.yaw);
        let mut points = self.points.clone();
        let degree = points.len() - 1;
        for left in (0..=degree).rev() {
            // `left + 1` points are left: their `left`-th difference is the derivative of that order, up to scale.
            if left <= 4 {
                let mut scale = 1.0;
                for k in 0..left {
                    scale *= (degree - k) as f32 * per_second;
                }
                let derivative = difference(&points) * scale;
                match left {
                    4 => reference.snap = derivative,
                    3 => reference.jerk = derivative,
                    2 => reference.acceleration = derivative,
                    1 => reference.velocity = derivative,
                    _ => reference.position = derivative,
                }
            }
            for i in 0..left {
                if let (Some(a), Some(b)) = (points.get(i).copied(), points.get(i + 1)) {
                    let between = a + (b - a) * u;
                    if let Some(slot) = points.get_mut(i) {
                        *slot = between;
                    }
                }
            }
            points.truncate(left);
        }
        reference
    }
}

/// The highest difference of up to five points: Σ (−1)^(n−i) C(n,i) Pi.
fn difference(points: &[Vector3<f32>]) -> Vector3<f32> {
    match *points {
        [a] => a,
        [a, b] => b - a,
        [a, b, c] => c - b * 2.0 + a,
        [a, b, c, d] => d - c * 3.0 + b * 3.0 - a,
        [a, b, c, d, e] => e - d * 4.0 + c * 6.0 - b * 4.0 + a,
        _ => Vector3::zeros(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::guidance::{Guidance, Trajectory};

    fn plan() -> JoinPlan {
        let mut middle_m = heapless::Vec::new();
        for point in [[0.5, 1.5, 1.0], [1.5, 3.0, 2.0], [3.0, 3.5, 3.0]] {
            middle_m.push(point).expect("fits");
        }
        JoinPlan { duration_s: 2.0, start_acceleration_m_s2: [0.0, 0.0, 3.0], middle_m }
    }

    #[test]
    fn starts_at_rest_with_the_given_acceleration() {
        let guidance =
            Guidance::new(Trajectory::PAPER_HELIX, Some(&plan()), Vector3::new(1.0, 2.0, 3.0)).expect("valid");
        let start = guidance.at(0);
        assert!((start.position - Vector3::new(1.0, 2.0, 3.0)).norm() < 1e-6);
        assert!(start.velocity.norm() < 1e-5);
        assert!((start.acceleration - Vector3::new(0.0, 0.0, 3.0)).norm() < 1e-3);
    }

    #[test]
    fn meets_the_trajectory_with_all_derivatives() {
        let guidance = Guidance::new(Trajectory::PAPER_HELIX, Some(&plan()), Vector3::zeros()).expect("valid");
        let end = plan().duration_ticks();
        let join = guidance.join.as_ref().expect("planned").at(end);
        let trajectory = guidance.trajectory_at(end);
        assert!((join.position - trajectory.position).norm() < 2e-6);
        assert!((join.velocity - trajectory.velocity).norm() < 2e-5);
        assert!((join.acceleration - trajectory.acceleration).norm() < 5e-4);
        assert!((join.jerk - trajectory.jerk).norm() < 5e-3);
        assert!((join.snap - trajectory.snap).norm() < 5e-2);
    }

    #[test]
    fn a_plan_out_of_range_is_refused() {
        let bad = JoinPlan { duration_s: f32::NAN, ..plan() };
        let built = Guidance::new(Trajectory::PAPER_HELIX, Some(&bad), Vector3::zeros());
        assert_eq!(built, Err(ConfigError::NonFinite("join.duration_s".into())));
    }
}
