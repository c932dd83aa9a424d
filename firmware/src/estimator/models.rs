//! Measurement models: the rows H by which each sensor's reading depends on the error state.
//!
//! Let d be the age of a reading, and S1 and S2 the first and second integrals of R f from then to now. The attitude
//! error is constant in the world over so short a time, so the error state at the time of the reading follows from the
//! present one:
//!
//! ```text
//! θ(t−d) = θ      v(t−d) = v + S1 × θ      p(t−d) = p − d v − (d S1 − S2) × θ
//! ```
//!
//! A late reading is therefore a measurement of the present error state with a row of its own; nothing is re-run.

use nalgebra::{UnitQuaternion, Vector3};

use super::covariance::{ErrorState, Row, index};
use super::history::{Moved, Past, Snapshot};
use crate::math;
use crate::signals::TICK_S;

/// The motion between a reading and now, as its rows need it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Age {
    /// The estimate at the time of the reading.
    pub then: Snapshot,
    /// Corrections made since, as an error state.
    pub since: ErrorState,
    /// d, s.
    old_s: f32,
    /// S1, m/s.
    first: Vector3<f32>,
    /// d S1 − S2, m.
    lever: Vector3<f32>,
}

impl Age {
    /// From the motion at the time of the reading to the newest snapshot.
    pub fn new(past: &Past, now: &Snapshot, gravity: f32) -> Self {
        let Past { snapshot: then, since } = past;
        let old_s = now.at.wrapping_sub(then.at) as f32 * TICK_S;
        let mut first = now.velocity - then.velocity - since.velocity;
        let mut second = now.position - then.position - since.position - then.velocity * old_s;
        first.z += gravity * old_s;
        second.z += 0.5 * gravity * old_s * old_s;
        Self { then: *then, since: error_of(since), old_s, first, lever: first * old_s - second }
    }

    /// Row of the velocity along a world axis (0 to 2).
    pub fn velocity(&self, axis: usize) -> Row {
        Row { theta: cross_row(axis, &self.first), entries: [(index::VELOCITY + axis, 1.0), NONE, NONE] }
    }

    /// Row of the position along a world axis (0 to 2), plus `offset`: a state and its factor, [`NONE`] for none.
    pub fn position(&self, axis: usize, offset: (usize, f32)) -> Row {
        let entries = [(index::POSITION + axis, 1.0), (index::VELOCITY + axis, -self.old_s), offset];
        Row { theta: -cross_row(axis, &self.lever), entries }
    }
}

/// An unused entry of a [`Row`].
pub const NONE: (usize, f32) = (0, 0.0);

/// The unit vector along a world axis (0 to 2).
pub fn axis_vector(axis: usize) -> Vector3<f32> {
    match axis {
        0 => Vector3::x(),
        1 => Vector3::y(),
        _ => Vector3::z(),
    }
}

/// e × v for the unit vector e of an axis: the component of v × θ along e is (e × v)·θ.
fn cross_row(axis: usize, v: &Vector3<f32>) -> Vector3<f32> {
    axis_vector(axis).cross(v)
}

/// Row of the attitude error about a world axis (0 to 2).
pub fn attitude_row(axis: usize) -> Row {
    Row { theta: axis_vector(axis), entries: [NONE; 3] }
}

fn error_of(moved: &Moved) -> ErrorState {
    let mut error = ErrorState::zeros();
    for (start, component) in
        [(index::THETA, moved.theta), (index::VELOCITY, moved.velocity), (index::POSITION, moved.position)]
    {
        for (to, from) in error.iter_mut().skip(start).zip(component.iter()) {
            *to = *from;
        }
    }
    error
}

/// The Earth's magnetic field where the vehicle flies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MagneticNorth {
    /// Horizontal unit vectors to magnetic north, and to the left of it.
    north: Vector3<f32>,
    left: Vector3<f32>,
    /// Horizontal component, µT.
    horizontal_ut: f32,
    /// Upward over horizontal component: minus the tangent of the inclination.
    slope: f32,
    /// Total strength, µT.
    strength_ut: f32,
}

/// A magnetic heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadingReading {
    /// Measured heading minus estimated heading, positive to the left, rad.
    pub turn: f32,
    /// H: how it depends on the error state.
    pub row: Row,
    /// Horizontal component of the expected field, µT: the noise of the heading is that of the field over this.
    pub horizontal_ut: f32,
}

impl MagneticNorth {
    /// From the field in the world (NWU), µT. `None` if it is not finite, or if its horizontal component is too small
    /// to tell north.
    pub fn new(field_ut: Vector3<f32>) -> Option<Self> {
        /// Less than this within some 5° of a magnetic pole.
        const LEAST_UT: f32 = 4.0;
        let horizontal_ut = math::sqrt(field_ut.x * field_ut.x + field_ut.y * field_ut.y);
        if horizontal_ut < LEAST_UT || !math::all_finite(field_ut.as_slice()) {
            return None;
        }
        let north = Vector3::new(field_ut.x, field_ut.y, 0.0) / horizontal_ut;
        let left = Vector3::new(-north.y, north.x, 0.0);
        let strength_ut = math::sqrt(field_ut.norm_squared());
        Some(Self { north, left, horizontal_ut, slope: field_ut.z / horizontal_ut, strength_ut })
    }

    /// By how much a tilt error towards north turns the heading: the tangent of the inclination, 1 at least.
    pub fn slope(self) -> f32 {
        math::max(math::abs(self.slope), 1.0)
    }

    /// Whether a measured field can be the Earth's: its strength is within 35 % of the expected one.
    pub fn is_plausible(&self, field_ut: &Vector3<f32>) -> bool {
        let ratio = math::sqrt(field_ut.norm_squared()) / self.strength_ut;
        ratio > 0.65 && ratio < 1.35
    }

    /// The heading ψ, from a field in a frame that is level and turned with the vehicle.
    pub fn heading(&self, level_ut: &Vector3<f32>) -> f32 {
        math::wrap_angle(math::atan2(self.north.y, self.north.x) - math::atan2(level_ut.y, level_ut.x))
    }

    /// The heading measured by a field (body frame, µT) at the estimated attitude.
    ///
    /// With m the field in the world, the measurement turned by R̂ is R̂ Rᵀ m = m − θ × m, which lies left of north by
    /// −(θz − (mz/mh) θn). A tilt error towards north therefore changes the heading too.
    pub fn read(&self, field_ut: &Vector3<f32>, attitude: &UnitQuaternion<f32>) -> HeadingReading {
        let m = attitude * field_ut;
        let (north, left) = (m.dot(&self.north), m.dot(&self.left));
        let theta = Vector3::z() - self.north * self.slope;
        HeadingReading {
            turn: -math::atan2(left, north),
            row: Row { theta, entries: [(index::HEADING_OFFSET, 1.0), NONE, NONE] },
            horizontal_ut: self.horizontal_ut,
        }
    }
}

/// Rotation vector (world, rad) that takes `from` to `to`, for up to half a turn.
pub fn turn_between(from: &UnitQuaternion<f32>, to: &UnitQuaternion<f32>) -> Vector3<f32> {
    let q = to.quaternion() * from.quaternion().conjugate();
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    let vector = Vector3::new(q.i, q.j, q.k) * sign;
    let sine = math::sqrt(vector.norm_squared());
    // 2 atan(sine/w)/sine, which is 2 for a small turn.
    if sine < 1e-4 { vector * 2.0 } else { vector * (2.0 * math::atan2(sine, q.w * sign) / sine) }
}

/// Height of a pressure (Pa) in the standard atmosphere's troposphere (ISO 2533), m above its sea level. Use it for
/// differences: they are 3.5 % too small on a day that is 10 K warmer.
pub fn pressure_height(pressure_pa: f32) -> f32 {
    44_330.77 * (1.0 - math::powf(pressure_pa / 101_325.0, 0.190_263))
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "tests compare with bounds; what flies may not")]
mod tests {
    use super::*;

    #[test]
    fn a_field_measured_in_any_attitude_gives_its_heading_error_and_the_row_is_its_derivative() {
        let field = Vector3::new(21.0, -1.3, -43.0);
        let north = MagneticNorth::new(field).expect("horizontal");
        for i in 0..40 {
            let t = i as f32;
            let truth = UnitQuaternion::from_euler_angles(0.4 * (t * 0.7).sin(), 0.4 * (t * 1.3).cos(), t * 0.5);
            let measured = truth.inverse() * field;
            let error = Vector3::new((t * 1.1).sin(), (t * 0.9).cos(), (t * 1.7).sin()) * 0.01;
            // R = Exp(θ) R̂.
            let believed = UnitQuaternion::new(-error) * truth;
            let reading = north.read(&measured, &believed);
            let linear = reading.row.theta.dot(&error);
            // Second order: 2e-4 times the slope of the field, 2.
            assert!((reading.turn - linear).abs() < 6e-4, "{i}: {} {linear}", reading.turn);
        }
    }

    #[test]
    fn a_level_field_gives_the_heading() {
        let north = MagneticNorth::new(Vector3::new(21.0, -1.3, -43.0)).expect("horizontal");
        for heading in [-3.0_f32, -1.0, 0.0, 0.5, 2.0] {
            let attitude = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), heading);
            let level = attitude.inverse() * Vector3::new(21.0, -1.3, -43.0);
            assert!((north.heading(&level) - heading).abs() < 1e-5);
        }
        assert!(MagneticNorth::new(Vector3::new(0.5, 0.5, -60.0)).is_none());
        assert!(MagneticNorth::new(Vector3::new(f32::NAN, 0.5, -60.0)).is_none());
    }

    #[test]
    fn a_turn_between_attitudes_is_their_rotation_vector() {
        let from = UnitQuaternion::from_euler_angles(0.3, -0.2, 1.0);
        for turn in [Vector3::new(1e-6, 0.0, 0.0), Vector3::new(0.1, -0.2, 0.3), Vector3::new(-1.5, 2.0, 1.0)] {
            let to = UnitQuaternion::new(turn) * from;
            assert!((turn_between(&from, &to) - turn).norm() < 1e-5);
            assert!((turn_between(&from, &UnitQuaternion::new_unchecked(-to.into_inner())) - turn).norm() < 1e-5);
        }
    }

    #[test]
    fn pressure_heights_are_the_standard_atmospheres() {
        // ISO 2533: 500 m at 95 460.8 Pa, 1000 m at 89 874.6 Pa.
        assert!((pressure_height(89_874.6) - 1_000.0).abs() < 0.3);
        assert!((pressure_height(95_460.8) - 500.0).abs() < 0.2);
        assert_eq!(pressure_height(101_325.0), 0.0);
    }

    /// Motion under a constant force and attitude, seen from now, with errors put in then.
    #[test]
    fn rows_of_the_past_are_derivatives() {
        let (gravity, d) = (9.81_f32, 0.2_f32);
        let force = Vector3::new(2.0_f32, -1.0, 11.0);
        let attitude = UnitQuaternion::from_euler_angles(0.2, 0.3, -0.7);
        let run = |q: UnitQuaternion<f32>, v: Vector3<f32>, p: Vector3<f32>| {
            let a = q * force - Vector3::z() * gravity;
            (v + a * d, p + v * d + a * (0.5 * d * d))
        };
        let (v, p) = (Vector3::new(3.0, 1.0, -0.5), Vector3::new(10.0, 20.0, 5.0));
        let (v_now, p_now) = run(attitude, v, p);
        let past = Past { snapshot: Snapshot { at: 0, attitude, velocity: v, position: p }, since: Moved::default() };
        let now = Snapshot { at: 200, attitude, velocity: v_now, position: p_now };
        let age = Age::new(&past, &now, gravity);
        let theta = Vector3::new(0.002, -0.001, 0.003);
        let (dv, dp) = (Vector3::new(0.1, -0.2, 0.05), Vector3::new(1.0, 2.0, -1.0));
        let (v_true, p_true) = run(UnitQuaternion::new(theta) * attitude, v + dv, p + dp);
        let error = error_of(&Moved { theta, velocity: v_true - v_now, position: p_true - p_now });
        for axis in 0..3 {
            assert!((age.velocity(axis).dot(&error) - dv[axis]).abs() < 2e-5);
            assert!((age.position(axis, NONE).dot(&error) - dp[axis]).abs() < 2e-5);
        }
    }
}
