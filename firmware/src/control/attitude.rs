//! Attitude control, Eq. 25–27: sliding mode on the Euler angles, then the torque that makes it so.
//!
//! The surfaces and reaching laws act on η = (φ, θ, ψ) and give the angular acceleration η̈ that is wanted
//! ([`demand`]); the inverse model [`torque`] gives the torques. Fed with η̇ and η̈ themselves these are Eq. 25–27
//! to the letter, where φ̇ ≈ p; what flies first takes η̇, η̈ to body rates and accelerations by the exact
//! kinematics ([`Euler::body_acceleration`]), which hold at any tilt short of θ = ±90°.

use nalgebra::{UnitQuaternion, Vector3};

use crate::airframe::Airframe;
use crate::control::sliding::AxisGains;
use crate::math;

/// Euler angles φ, θ, ψ, with `R = Rz(ψ)·Ry(θ)·Rx(φ)`, as the sines and cosines that the laws need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Euler {
    /// sin φ, cos φ.
    pub roll: (f32, f32),
    /// sin θ, cos θ.
    pub pitch: (f32, f32),
    /// 1/cos θ.
    pub sec_pitch: f32,
    /// sin ψ, cos ψ.
    pub yaw: (f32, f32),
}

/// cos θ is kept away from zero by this much: at θ = ±90° the Euler angles are not defined.
const COS_PITCH_MIN: f32 = 0.02;

impl Euler {
    /// Of a rotation from body to world.
    #[inline]
    pub fn from_quaternion(attitude: &UnitQuaternion<f32>) -> Self {
        let q = attitude.quaternion();
        let (w, x, y, z) = (q.w, q.i, q.j, q.k);
        let sin_pitch = 2.0 * (w * y - z * x);
        let cos_squared = math::max(1.0 - sin_pitch * sin_pitch, COS_PITCH_MIN * COS_PITCH_MIN);
        // Root and reciprocal do not wait for each other.
        let cos_pitch = math::sqrt(cos_squared);
        let inverse = cos_pitch * (1.0 / cos_squared);
        let (roll_y, roll_x) = (2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y));
        let (yaw_y, yaw_x) = (2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z));
        Self {
            roll: (roll_y * inverse, roll_x * inverse),
            pitch: (sin_pitch, cos_pitch),
            sec_pitch: inverse,
            yaw: (yaw_y * inverse, yaw_x * inverse),
        }
    }

    /// Of three angles, rad.
    pub fn from_angles(angles: Vector3<f32>) -> Self {
        let (sin_pitch, cos_pitch) = math::sin_cos(angles.y);
        Self {
            roll: math::sin_cos(angles.x),
            pitch: (sin_pitch, cos_pitch),
            sec_pitch: 1.0 / math::max(cos_pitch, COS_PITCH_MIN),
            yaw: math::sin_cos(angles.z),
        }
    }

    /// φ, θ, ψ, rad.
    #[inline]
    pub fn angles(&self) -> Vector3<f32> {
        let angle = |(sin, cos): (f32, f32)| math::atan2(sin, cos);
        Vector3::new(angle(self.roll), angle(self.pitch), self.heading())
    }

    /// ψ, rad.
    #[inline]
    pub fn heading(&self) -> f32 {
        let (sin, cos) = self.yaw;
        math::atan2(sin, cos)
    }

    /// η̇ from the body rates Ω = (p, q, r).
    #[inline]
    pub fn rates(&self, body: &Vector3<f32>) -> Vector3<f32> {
        let ((sin_roll, cos_roll), (sin_pitch, _)) = (self.roll, self.pitch);
        let yaw_rate = (body.y * sin_roll + body.z * cos_roll) * self.sec_pitch;
        Vector3::new(body.x + sin_pitch * yaw_rate, body.y * cos_roll - body.z * sin_roll, yaw_rate)
    }

    /// Ω̇ = E(η) η̈ + Ė(η, η̇) η̇, with Ω = E(η) η̇.
    #[inline]
    pub fn body_acceleration(&self, rates: &Vector3<f32>, accelerations: &Vector3<f32>) -> Vector3<f32> {
        let ((sr, cr), (sp, cp)) = (self.roll, self.pitch);
        let (roll, pitch, yaw) = (rates.x, rates.y, rates.z);
        let (a_roll, a_pitch, a_yaw) = (accelerations.x, accelerations.y, accelerations.z);
        // Across the roll axis: y' = θ̇, z' = ψ̇ cos θ, turned by φ.
        let z_rate = cp * yaw;
        let z_acceleration = cp * a_yaw - sp * pitch * yaw;
        Vector3::new(
            (a_roll - cp * pitch * yaw) - sp * a_yaw,
            cr * (a_pitch + roll * z_rate) + sr * (z_acceleration - roll * pitch),
            cr * (z_acceleration - roll * pitch) - sr * (a_pitch + roll * z_rate),
        )
    }
}

/// Angles, rates and accelerations that the attitude is to follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EulerReference {
    /// φd, θd, ψd, rad.
    pub angles: Vector3<f32>,
    /// Their first derivatives, rad/s.
    pub rates: Vector3<f32>,
    /// Their second derivatives, rad/s².
    pub accelerations: Vector3<f32>,
}

/// Sliding variables s1..s3 and the angular acceleration they ask for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttitudeDemand {
    /// s1, s2, s3 (Eq. 18–20), rad/s.
    pub s: Vector3<f32>,
    /// `η̈d + λ ė + K sw(s)`, rad/s².
    pub acceleration: Vector3<f32>,
}

/// The part of Eq. 25–27 inside the brackets that does not depend on the model: `η̈d + λ ė + K sw(s)`.
#[inline]
pub fn demand(
    gains: &[AxisGains; 3],
    reference: &EulerReference,
    angles: &Vector3<f32>,
    rates: &Vector3<f32>,
) -> AttitudeDemand {
    let error = (reference.angles - angles).map(math::wrap_angle);
    let error_rate = reference.rates - rates;
    let [g1, g2, g3] = gains;
    let roll = g1.correction(error.x, error_rate.x);
    let pitch = g2.correction(error.y, error_rate.y);
    let yaw = g3.correction(error.z, error_rate.z);
    AttitudeDemand {
        s: Vector3::new(roll.s, pitch.s, yaw.s),
        acceleration: reference.accelerations + Vector3::new(roll.acceleration, pitch.acceleration, yaw.acceleration),
    }
}

/// Torques U2..U4 that give the body the acceleration Ω̇ at rates Ω, `spin` being Ωr of the last commanded speeds:
/// `τ = I Ω̇ + Ω × IΩ + Ω × (0, 0, Jr Ωr) + (k4 p|p|, k5 q|q|, k6 r|r|)`.
///
/// With Ω = η̇ these are Eq. 25–27 to the letter: `U2 = Ix[φ̈ − c1 θ̇ψ̇ − c2 φ̇|φ̇| − c3 Ωr θ̇]` and so on.
#[inline]
pub fn torque(airframe: &Airframe, acceleration: &Vector3<f32>, rates: &Vector3<f32>, spin: f32) -> Vector3<f32> {
    let [ix, iy, iz] = airframe.inertia_kg_m2;
    let [k4, k5, k6] = airframe.rotational_drag_n_m_s2;
    let (p, q, r) = (rates.x, rates.y, rates.z);
    let gyroscopic = airframe.rotor_inertia_kg_m2 * spin;
    Vector3::new(
        (k4 * p * math::abs(p) - ((iy - iz) * r - gyroscopic) * q) + ix * acceleration.x,
        (k5 * q * math::abs(q) - ((iz - ix) * r + gyroscopic) * p) + iy * acceleration.y,
        (k6 * r * math::abs(r) - (ix - iy) * p * q) + iz * acceleration.z,
    )
}
