//! Position control, Eq. 28, 30 and 31: sliding mode on x, y, z, as a specific force and its derivatives.
//!
//! The paper's three laws share one form. With Ux U1/m, Uy U1/m and U1 cφcθ/m the components of the specific
//! force f (Eq. 2), each reads `f = r̈d − c ṙ + λ ė + K sw(s)`, plus g on z. Written so, the division by U1 and
//! by cφ cθ disappears and with it their singularities; [`paper_inputs`] gives U1, Ux, Uy as printed.

use nalgebra::Vector3;

use crate::airframe::Airframe;
use crate::control::flatness::ForceProfile;
use crate::control::sliding::AxisGains;
use crate::math;
use crate::signals::FlatReference;
use crate::validate::ConfigError;

/// Gains and limits of the position loop.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct PositionGains {
    /// x, y, z.
    pub axes: [AxisGains; 3],
    /// Greatest tilt the loop asks for, rad.
    pub tilt_max_rad: f32,
}

impl PositionGains {
    /// Refuses gains with which the law is not defined.
    ///
    /// # Errors
    /// The first gain or limit that is out of its range.
    pub fn validate(&self) -> Result<(), ConfigError> {
        let [x, y, z] = &self.axes;
        x.validate("control.x")?;
        y.validate("control.y")?;
        z.validate("control.z")?;
        ConfigError::require_positive("control.tilt_max_rad", self.tilt_max_rad)?;
        if self.tilt_max_rad < 1.5 { Ok(()) } else { Err(ConfigError::OutOfRange("control.tilt_max_rad")) }
    }
}

/// Sliding variables sx, sy, sz and the specific force they ask for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionDemand {
    /// Eq. 21–23, m/s.
    pub s: Vector3<f32>,
    /// f, m/s².
    pub force: Vector3<f32>,
}

/// Eq. 28, 30, 31 as a specific force (see the module text).
#[inline]
pub fn demand(
    axes: &[AxisGains; 3],
    airframe: &Airframe,
    reference: &FlatReference,
    position: &Vector3<f32>,
    velocity: &Vector3<f32>,
) -> PositionDemand {
    let error = reference.position - position;
    let error_rate = reference.velocity - velocity;
    let [gx, gy, gz] = axes;
    let x = gx.correction(error.x, error_rate.x);
    let y = gy.correction(error.y, error_rate.y);
    let z = gz.correction(error.z, error_rate.z);
    let correction = Vector3::new(x.acceleration, y.acceleration, z.acceleration);
    let force =
        reference.acceleration + drag(airframe, velocity) + correction + Vector3::new(0.0, 0.0, airframe.gravity_m_s2);
    PositionDemand { s: Vector3::new(x.s, y.s, z.s), force }
}

/// −c9..c11 times `v`: the specific drag force at velocity v, or its derivatives at v's.
#[inline]
fn drag(airframe: &Airframe, v: &Vector3<f32>) -> Vector3<f32> {
    let inverse = 1.0 / airframe.mass_kg;
    let [k1, k2, k3] = airframe.drag_n_s_m;
    Vector3::new(k1 * v.x, k2 * v.y, k3 * v.z) * inverse
}

/// The demand's force with its derivatives, for the attitude's feedforward.
///
/// `acceleration` is the vehicle's own, m/s², by the model. ḟ is exact but for the motion of the disturbance;
/// f̈ holds the reference's snap and drag only, since the feedback's second derivative would need the jerk.
pub fn force_profile(
    axes: &[AxisGains; 3],
    airframe: &Airframe,
    reference: &FlatReference,
    demand: &PositionDemand,
    velocity: &Vector3<f32>,
    acceleration: &Vector3<f32>,
) -> ForceProfile {
    let error_rate = reference.velocity - velocity;
    let error_acceleration = reference.acceleration - acceleration;
    let [gx, gy, gz] = axes;
    let feedback = |gains: &AxisGains, s: f32, rate: f32, acceleration: f32| {
        gains.lambda * acceleration + gains.reach_slope(s) * gains.surface(rate, acceleration)
    };
    let correction_rate = Vector3::new(
        feedback(gx, demand.s.x, error_rate.x, error_acceleration.x),
        feedback(gy, demand.s.y, error_rate.y, error_acceleration.y),
        feedback(gz, demand.s.z, error_rate.z, error_acceleration.z),
    );
    ForceProfile {
        force: demand.force,
        rate: reference.jerk + drag(airframe, &reference.acceleration) + correction_rate,
        acceleration: reference.snap + drag(airframe, &reference.jerk),
    }
}

/// Brings a specific force within what the rotors can give: not below `FLOOR`, at most `force_max` in size, tilted at
/// most the angle of which the tangent is given. Height is kept before horizontal acceleration. Returns whether a
/// limit acted; then the derivatives are those of a force that is not flown, and are dropped.
pub fn limit(profile: &mut ForceProfile, force_max: f32, tan_tilt_max: f32) -> bool {
    /// Least vertical part, as a part of the greatest force: the thrust axis must not point down.
    const FLOOR: f32 = 0.02;
    let force = profile.force;
    let vertical = math::clamp(force.z, FLOOR * force_max, force_max);
    let by_size = math::sqrt(math::max(force_max * force_max - vertical * vertical, 0.0));
    let limit = math::min(by_size, vertical * tan_tilt_max);
    let horizontal = math::sqrt(force.x * force.x + force.y * force.y);
    let scale = if horizontal > limit { limit / horizontal } else { 1.0 };
    let limited = scale < 1.0 || vertical != force.z;
    if limited {
        let zero = Vector3::zeros();
        let force = Vector3::new(force.x * scale, force.y * scale, vertical);
        *profile = ForceProfile { force, rate: zero, acceleration: zero };
    }
    limited
}

/// U1, Ux, Uy as printed in Eq. 28, 30 and 31, from the demand's force and the vehicle's roll and pitch cosines.
///
/// Ux and Uy are not limited; they are not finite where U1 is zero.
pub fn paper_inputs(airframe: &Airframe, force: &Vector3<f32>, cos_roll: f32, cos_pitch: f32) -> (f32, f32, f32) {
    let thrust = airframe.mass_kg * force.z / (cos_roll * cos_pitch);
    let scale = airframe.mass_kg / thrust;
    (thrust, force.x * scale, force.y * scale)
}
