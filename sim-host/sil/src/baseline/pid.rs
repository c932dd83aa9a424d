//! The cascade of PX4 (v1.14): `PositionControl`, `ControlMath`, `AttitudeControl` and `RateControl`, in this project's
//! frames and units.
//!
//! ```text
//! position P ─► velocity limits ─► velocity PID ─► thrust vector ─► attitude P ─► rate limits ─► rate PID ─► torque
//!      + velocity feedforward    + acceleration feedforward       + yaw rate feedforward
//! ```
//!
//! As in PX4: derivatives are taken of the measurement, after a first-order low-pass; the vertical integral stops at a
//! limit, and the horizontal one has anti-windup by back-calculation (Rundqwist 1990); the rate integral is reduced for
//! large errors. The law uses neither drag nor the reference's jerk and snap. Unlike PX4: gains are in units of
//! acceleration, not of normalised thrust and torque, with PX4's factor K included; the thrust vector is the demanded
//! acceleration plus gravity (`MPC_ACC_DECOUPLE` off, for tracking); and because the mixer has one saturation flag for
//! all axes, the rate integral holds on all of them.

use anyhow::Result;
use firmware::airframe::Airframe;
use firmware::control::flatness::ForceProfile;
use firmware::control::law::{AttitudeDemand, AttitudeInput, AttitudeLaw, PositionDemand, PositionInput, PositionLaw};
use firmware::control::position::ForceLimits;
use firmware::math;
use firmware::signals::TICK_S;
use glissade_files::refusal::within;
use nalgebra::{Quaternion, UnitQuaternion, Vector2, Vector3};
use serde::{Deserialize, Serialize};

use super::filter::{Difference, LowPass};
use super::{AxisPair, OUTER_STEP_S, clamp_each, require_cutoff, require_tilt};

/// Gains of the cascade, as written in a tuning file; PX4's parameters in brackets.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pid {
    /// Greatest tilt that position control demands, rad (`MPC_TILTMAX_AIR`).
    pub tilt_max_rad: f32,
    /// P of the position: velocity setpoint per position error, 1/s (`MPC_XY_P`, `MPC_Z_P`).
    pub position_p_1_s: AxisPair,
    /// Greatest velocity setpoint, m/s (`MPC_XY_VEL_MAX`, `MPC_Z_VEL_MAX_UP`).
    pub velocity_max_m_s: AxisPair,
    /// P of the velocity, 1/s (`MPC_XY_VEL_P_ACC`, `MPC_Z_VEL_P_ACC`).
    pub velocity_p_1_s: AxisPair,
    /// I of the velocity, 1/s² (`MPC_XY_VEL_I_ACC`, `MPC_Z_VEL_I_ACC`).
    pub velocity_i_1_s2: AxisPair,
    /// D of the velocity, no unit (`MPC_XY_VEL_D_ACC`, `MPC_Z_VEL_D_ACC`).
    pub velocity_d: AxisPair,
    /// Low-pass of the acceleration for D, Hz (`MPC_VELD_LP`).
    pub velocity_d_cutoff_hz: f32,
    /// Fraction of the greatest thrust reserved for horizontal control (`MPC_THR_XY_MARG`).
    pub horizontal_thrust_margin: f32,
    /// P of the attitude: rate setpoint per attitude error, 1/s (`MC_ROLL_P`, `MC_PITCH_P`, `MC_YAW_P`).
    pub attitude_p_1_s: AxisPair,
    /// Weight of yaw relative to tilt, 0 to 1 (`MC_YAW_WEIGHT`).
    pub yaw_weight: f32,
    /// Greatest rate setpoint, rad/s (`MC_ROLLRATE_MAX`, `MC_YAWRATE_MAX`).
    pub rate_max_rad_s: AxisPair,
    /// P of the rate, 1/s: times the inertia (`MC_ROLLRATE_P`, there of the normalised torque).
    pub rate_p_1_s: AxisPair,
    /// I of the rate, 1/s² (`MC_ROLLRATE_I`).
    pub rate_i_1_s2: AxisPair,
    /// D of the rate, no unit (`MC_ROLLRATE_D`).
    pub rate_d: AxisPair,
    /// Low-pass of the angular acceleration for D, Hz (`IMU_DGYRO_CUTOFF`).
    pub rate_d_cutoff_hz: f32,
    /// Feedforward of the rate setpoint, 1/s (`MC_ROLLRATE_FF`).
    pub rate_feedforward_1_s: AxisPair,
    /// Bound on the rates' integral, rad/s² (`MC_RR_INT_LIM`).
    pub rate_integral_max_rad_s2: AxisPair,
}

impl Pid {
    /// Checks that the laws are defined for these gains.
    ///
    /// # Errors
    /// The first key that is out of range.
    pub fn validate(&self) -> Result<()> {
        require_tilt("pid.tilt_max_rad", self.tilt_max_rad)?;
        for (key, gain) in [
            ("position_p_1_s", self.position_p_1_s),
            ("velocity_max_m_s", self.velocity_max_m_s),
            ("velocity_p_1_s", self.velocity_p_1_s),
            ("velocity_i_1_s2", self.velocity_i_1_s2),
            ("velocity_d", self.velocity_d),
            ("attitude_p_1_s", self.attitude_p_1_s),
            ("rate_max_rad_s", self.rate_max_rad_s),
            ("rate_p_1_s", self.rate_p_1_s),
            ("rate_i_1_s2", self.rate_i_1_s2),
            ("rate_d", self.rate_d),
            ("rate_feedforward_1_s", self.rate_feedforward_1_s),
            ("rate_integral_max_rad_s2", self.rate_integral_max_rad_s2),
        ] {
            gain.require_not_negative(&format!("pid.{key}"))?;
        }
        within("pid.velocity_p_1_s.xy", self.velocity_p_1_s.xy, 0.01, super::GAIN_MAX)?;
        require_cutoff("pid.velocity_d_cutoff_hz", self.velocity_d_cutoff_hz, OUTER_STEP_S)?;
        require_cutoff("pid.rate_d_cutoff_hz", self.rate_d_cutoff_hz, TICK_S)?;
        within("pid.horizontal_thrust_margin", self.horizontal_thrust_margin, 0.0, 0.9)?;
        within("pid.yaw_weight", self.yaw_weight, 0.0, 1.0)
    }
}

/// Position P and velocity PID.
#[derive(Clone, Debug)]
pub struct PidPosition {
    gains: Pid,
    gravity: f32,
    force_max: f32,
    limits: ForceLimits,
    difference: Difference,
    low_pass: LowPass,
    integral: Vector3<f32>,
}

impl PidPosition {
    /// With valid gains; evaluated once per job of the outer partition.
    pub fn new(airframe: &Airframe, gains: &Pid) -> Self {
        Self {
            gains: *gains,
            gravity: airframe.gravity_m_s2,
            force_max: airframe.thrust_max_n() / airframe.mass_kg,
            limits: ForceLimits::new(airframe, gains.tilt_max_rad),
            difference: Difference::new(OUTER_STEP_S),
            low_pass: LowPass::new(gains.velocity_d_cutoff_hz, OUTER_STEP_S),
            integral: Vector3::zeros(),
        }
    }

    /// The velocity setpoint: the feedback has priority over the feedforward where their sum exceeds the limit.
    fn velocity_wanted(&self, error: &Vector3<f32>, feedforward: &Vector3<f32>) -> Vector3<f32> {
        let most = self.gains.velocity_max_m_s;
        let by_error = self.gains.position_p_1_s.vector().component_mul(error);
        let horizontal = within_circle(by_error.xy(), feedforward.xy(), most.xy);
        let vertical = math::clamp(by_error.z + feedforward.z, -most.z, most.z);
        Vector3::new(horizontal.x, horizontal.y, vertical)
    }

    /// Limits a force to the rotors' range: the vertical component has priority, except for the margin reserved for
    /// horizontal control.
    fn limited(&self, force: &Vector3<f32>) -> Vector3<f32> {
        let margin = math::min(force.xy().norm(), self.gains.horizontal_thrust_margin * self.force_max);
        let vertical_max = math::sqrt(self.force_max * self.force_max - margin * margin);
        let zero = Vector3::zeros();
        let within = Vector3::new(force.x, force.y, math::min(force.z, vertical_max));
        let mut profile = ForceProfile { force: within, rate: zero, acceleration: zero };
        self.limits.apply(&mut profile);
        profile.force
    }

    /// Integrates the velocity error, with back-calculation at the limits.
    fn integrate(&mut self, error: &Vector3<f32>, wanted: &Vector3<f32>, given: &Vector3<f32>) {
        let mut error = *error;
        let taken = wanted - given;
        if taken.z * error.z > 0.0 {
            error.z = 0.0;
        }
        if wanted.xy().norm_squared() > given.xy().norm_squared() {
            let tracking = 2.0 / self.gains.velocity_p_1_s.xy;
            error.x -= tracking * taken.x;
            error.y -= tracking * taken.y;
        }
        self.integral += self.gains.velocity_i_1_s2.vector().component_mul(&error) * OUTER_STEP_S;
        self.integral.z = math::clamp(self.integral.z, -self.gravity, self.gravity);
    }
}

impl PositionLaw for PidPosition {
    fn step(&mut self, input: &PositionInput) -> PositionDemand {
        let reference = input.reference;
        let wanted = self.velocity_wanted(&(reference.position - input.position), &reference.velocity);
        let error = wanted - input.velocity;
        let measured = self.low_pass.step(&self.difference.step(input.velocity));
        let proportional = self.gains.velocity_p_1_s.vector().component_mul(&error);
        let derivative = self.gains.velocity_d.vector().component_mul(&measured);
        let gravity = Vector3::new(0.0, 0.0, self.gravity);
        let force = reference.acceleration + proportional + self.integral - derivative + gravity;
        let given = self.limited(&force);
        self.integrate(&error, &force, &given);
        let zero = Vector3::zeros();
        PositionDemand { s: zero, profile: ForceProfile { force: given, rate: zero, acceleration: zero } }
    }

    fn reset(&mut self) {
        self.difference.reset();
        self.low_pass.reset();
        self.integral = Vector3::zeros();
    }
}

/// `first + second`, with `second` shortened so that the sum is within a circle.
fn within_circle(first: Vector2<f32>, second: Vector2<f32>, radius: f32) -> Vector2<f32> {
    let sum = first + second;
    let size = math::sqrt(first.norm_squared());
    if sum.norm_squared() <= radius * radius {
        return sum;
    }
    if size >= radius {
        return first * (radius / size);
    }
    // |first + s·second| = radius has one root s ≥ 0, since `first` lies inside.
    let (a, half_b) = (second.norm_squared(), first.dot(&second));
    let s = (math::sqrt(half_b * half_b + a * (radius * radius - size * size)) - half_b) / a;
    first + second * s
}

/// Attitude P and rate PID.
#[derive(Clone, Debug)]
pub struct PidAttitude {
    gains: Pid,
    inertia: Vector3<f32>,
    difference: Difference,
    low_pass: LowPass,
    integral: Vector3<f32>,
}

/// Rate error at which the integral stops, rad/s: 400 °/s.
const INTEGRAL_STOPS_AT_RAD_S: f32 = 6.981_317;

impl PidAttitude {
    /// With valid gains; evaluated once per tick.
    pub fn new(airframe: &Airframe, gains: &Pid) -> Self {
        Self {
            gains: *gains,
            inertia: airframe.inertia_kg_m2.into(),
            difference: Difference::new(TICK_S),
            low_pass: LowPass::new(gains.rate_d_cutoff_hz, TICK_S),
            integral: Vector3::zeros(),
        }
    }

    /// The rate setpoint. With a position law without force derivatives, the target's rates contain only the yaw rate.
    fn rate_wanted(&self, input: &AttitudeInput) -> Vector3<f32> {
        let relative = input.attitude.inverse() * input.target.attitude;
        let error = tilt_before_yaw(&relative, self.gains.yaw_weight);
        let mut p = self.gains.attitude_p_1_s.vector();
        if self.gains.yaw_weight > 1e-4 {
            p.z /= self.gains.yaw_weight;
        }
        let rate = p.component_mul(&error) + relative * input.target.rates;
        clamp_each(&rate, &self.gains.rate_max_rad_s.vector())
    }

    fn integrate(&mut self, error: &Vector3<f32>) {
        let slowed = error.map(|e| {
            let part = e / INTEGRAL_STOPS_AT_RAD_S;
            e * math::max(1.0 - part * part, 0.0)
        });
        let integral = self.integral + self.gains.rate_i_1_s2.vector().component_mul(&slowed) * TICK_S;
        self.integral = clamp_each(&integral, &self.gains.rate_integral_max_rad_s2.vector());
    }
}

impl AttitudeLaw for PidAttitude {
    fn step(&mut self, input: &AttitudeInput) -> AttitudeDemand {
        let wanted = self.rate_wanted(input);
        let error = wanted - input.rates;
        let measured = self.low_pass.step(&self.difference.step(input.rates));
        let g = &self.gains;
        let acceleration = g.rate_p_1_s.vector().component_mul(&error) + self.integral
            - g.rate_d.vector().component_mul(&measured)
            + g.rate_feedforward_1_s.vector().component_mul(&wanted);
        if !input.saturated {
            self.integrate(&error);
        }
        AttitudeDemand { s: Vector3::zeros(), torque: self.inertia.component_mul(&acceleration) }
    }

    fn reset(&mut self) {
        self.difference.reset();
        self.low_pass.reset();
        self.integral = Vector3::zeros();
    }
}

/// Twice the vector part of the remaining rotation, `relative` = q⁻¹ ⊗ qd, with its turn about the thrust axis scaled
/// by `yaw_weight` (Brescianini, Hehn and D'Andrea 2013).
///
/// `relative` = (w, x, y, z) is the shortest rotation of the axis, (N, wx − yz, wy + xz, 0)/√N with N = w² + z², and
/// then a turn by 2 atan2(z, w).
fn tilt_before_yaw(relative: &UnitQuaternion<f32>, yaw_weight: f32) -> Vector3<f32> {
    /// Below this N the axis is inverted, and all tilts back are equally short.
    const INVERTED: f32 = 1e-8;
    let q = relative.quaternion();
    let (w, x, y, z) = (q.w, q.i, q.j, q.k);
    let n = w * w + z * z;
    let rotation = if n > INVERTED {
        let root = math::sqrt(n);
        let tilt = Quaternion::new(root, (w * x - y * z) / root, (w * y + x * z) / root, 0.0);
        let half_turn = if w < 0.0 { math::atan2(-z, -w) } else { math::atan2(z, w) };
        let (sin, cos) = math::sin_cos(yaw_weight * half_turn);
        tilt * Quaternion::new(cos, 0.0, 0.0, sin)
    } else {
        *q
    };
    rotation.imag() * if rotation.w < 0.0 { -2.0 } else { 2.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::baseline::tests::{airframe, attitudes, hover_speeds, input, level};
    use firmware::signals::FlatReference;

    /// PX4's defaults, stiffened by hand for the x500.
    fn gains() -> Pid {
        Pid {
            tilt_max_rad: 1.2,
            position_p_1_s: AxisPair { xy: 2.5, z: 3.0 },
            velocity_max_m_s: AxisPair { xy: 12.0, z: 6.0 },
            velocity_p_1_s: AxisPair { xy: 5.0, z: 6.0 },
            velocity_i_1_s2: AxisPair { xy: 0.8, z: 2.0 },
            velocity_d: AxisPair { xy: 0.1, z: 0.0 },
            velocity_d_cutoff_hz: 5.0,
            horizontal_thrust_margin: 0.3,
            attitude_p_1_s: AxisPair { xy: 14.0, z: 4.0 },
            yaw_weight: 0.4,
            rate_max_rad_s: AxisPair { xy: 12.0, z: 3.5 },
            rate_p_1_s: AxisPair { xy: 60.0, z: 10.0 },
            rate_i_1_s2: AxisPair { xy: 59.0, z: 4.0 },
            rate_d: AxisPair { xy: 1.5, z: 0.0 },
            rate_d_cutoff_hz: 60.0,
            rate_feedforward_1_s: AxisPair::default(),
            rate_integral_max_rad_s2: AxisPair { xy: 80.0, z: 6.0 },
        }
    }

    /// The same law as its paper writes it, in f64, from the axes in the world.
    fn by_world_axes(is: &UnitQuaternion<f64>, ought: &UnitQuaternion<f64>, yaw_weight: f64) -> Vector3<f64> {
        let (axis, wanted) = (is * Vector3::z(), ought * Vector3::z());
        let reduced = UnitQuaternion::rotation_between(&axis, &wanted).expect("not opposite") * is;
        let turn = reduced.inverse() * ought;
        let sign = if turn.w < 0.0 { -1.0 } else { 1.0 };
        let (w, z) = ((sign * turn.w).clamp(-1.0, 1.0), (sign * turn.k).clamp(-1.0, 1.0));
        let scaled = Quaternion::new((yaw_weight * w.acos()).cos(), 0.0, 0.0, (yaw_weight * z.asin()).sin());
        let left = is.inverse().into_inner() * reduced.into_inner() * scaled;
        left.imag() * (2.0 * left.w.signum())
    }

    #[test]
    fn tilt_comes_before_yaw_as_in_the_paper() {
        let mut compared = 0;
        for (is, ought) in attitudes().zip(attitudes().skip(17)) {
            let relative = is.inverse() * ought;
            for yaw_weight in [0.0, 0.4, 1.0] {
                let exact = by_world_axes(&is.cast(), &ought.cast(), yaw_weight);
                let error = tilt_before_yaw(&relative, yaw_weight as f32).cast::<f64>() - exact;
                // f32, magnified by 1/√N where the axis points nearly the wrong way.
                assert!(error.norm() < 1e-4, "{relative}: {error}");
                compared += 1;
            }
        }
        assert!(compared > 500);
    }

    #[test]
    fn a_constant_torque_is_integrated_away_and_nothing_while_saturated() {
        let (airframe, gains) = (airframe(), gains());
        let mut law = PidAttitude::new(&airframe, &gains);
        let inertia = Vector3::from(airframe.inertia_kg_m2);
        let (target, speeds) = (level(), hover_speeds(&airframe));
        let (mut attitude, mut rates) = (UnitQuaternion::identity(), Vector3::zeros());
        let push = Vector3::new(6.0_f32, -4.0, 1.0);
        for _ in 0..30_000 {
            let torque = law.step(&input(&attitude, &rates, &target, &speeds)).torque;
            rates += (torque.component_div(&inertia) + push) * TICK_S;
            attitude *= UnitQuaternion::new(rates * TICK_S);
        }
        // The slowest pole is about I/P = 0.4 1/s about z, e^(−12) in 30 s; the rest is f32.
        assert!((law.integral + push).norm() < 1e-2, "{}", law.integral);
        assert!(attitude.angle() < 1e-3, "{}", attitude.angle());

        let before = law.integral;
        let tilted = UnitQuaternion::from_euler_angles(0.3, 0.0, 0.0);
        law.step(&AttitudeInput { saturated: true, ..input(&tilted, &rates, &target, &speeds) });
        assert_eq!(law.integral, before);
    }

    #[test]
    fn large_rate_errors_slow_the_integral_down_and_stop_it() {
        let mut law = PidAttitude::new(&airframe(), &Pid { rate_i_1_s2: AxisPair { xy: 1.0, z: 1.0 }, ..gains() });
        // 200 °/s of 400: a quarter less.
        law.integrate(&Vector3::new(0.5 * INTEGRAL_STOPS_AT_RAD_S, 2.0 * INTEGRAL_STOPS_AT_RAD_S, 0.0));
        let full = 0.5 * INTEGRAL_STOPS_AT_RAD_S * TICK_S;
        assert!((law.integral.x - 0.75 * full).abs() < 1e-6 * full, "{}", law.integral);
        assert_eq!(law.integral.y, 0.0);
    }

    #[test]
    fn what_the_error_asks_for_goes_before_the_references_velocity() {
        let (first, second) = (Vector2::new(3.0_f32, 1.0), Vector2::new(-1.0_f32, 6.0));
        assert_eq!(within_circle(first, second, 20.0), first + second);
        let inside = within_circle(first, second, 5.0);
        assert!((inside.norm() - 5.0).abs() < 1e-5);
        assert!((inside - first).perp(&second).abs() < 1e-5 && (inside - first).dot(&second) > 0.0, "{inside}");
        let only = within_circle(first, second, 2.0);
        assert!((only.norm() - 2.0).abs() < 1e-5 && only.perp(&first).abs() < 1e-5, "{only}");
    }

    #[test]
    fn a_force_beyond_the_limits_drives_the_integral_back() {
        let (airframe, gains) = (airframe(), gains());
        let mut law = PidPosition::new(&airframe, &gains);
        let reference = FlatReference::standing(Vector3::new(100.0, 0.0, 0.0), 0.0);
        let zero = Vector3::zeros();
        let at_rest = PositionInput {
            reference: &reference,
            position: &zero,
            velocity: &zero,
            acceleration: &zero,
            limited: false,
        };
        let mut force = zero;
        for _ in 0..20_000 {
            force = law.step(&at_rest).profile.force;
        }
        // It rests where the velocity's error e is what 2/P of the force taken gives: P e + I − f = P e/2.
        let (p, e) = (gains.velocity_p_1_s.xy, gains.velocity_max_m_s.xy);
        let most = airframe.thrust_max_n() / airframe.mass_kg;
        let exact = (most * most - airframe.gravity_m_s2 * airframe.gravity_m_s2).sqrt();
        assert!((force.x - exact).abs() < 1e-3 && (force.z - airframe.gravity_m_s2).abs() < 1e-3, "{force}");
        assert!((law.integral.x - (exact - 0.5 * p * e)).abs() < 1e-2, "{}", law.integral);
        assert_eq!(law.integral.z, 0.0);
    }
}
