//! Euler angles φ, θ, ψ and their kinematics: the paper's coordinates of an attitude.
//!
//! With `R = Rz(ψ)·Ry(θ)·Rx(φ)`: Ω = E(η) η̇ and its derivative, exact for |θ| < 90°. At θ = ±90° the angles are not
//! defined.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::math;
use crate::signals::AttitudeTarget;

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

/// Lower bound on cos θ: at θ = ±90° the Euler angles are not defined.
const COS_PITCH_MIN: f32 = 0.02;

impl Euler {
    /// From a rotation from body to world.
    #[inline]
    pub fn from_quaternion(attitude: &UnitQuaternion<f32>) -> Self {
        let q = attitude.quaternion();
        let (w, x, y, z) = (q.w, q.i, q.j, q.k);
        let sin_pitch = 2.0 * (w * y - z * x);
        let cos_squared = math::max(1.0 - sin_pitch * sin_pitch, COS_PITCH_MIN * COS_PITCH_MIN);
        // Root and reciprocal are independent, so the core can overlap them.
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

    /// η̈ from the body's angular acceleration Ω̇, the inverse of [`body_acceleration`](Self::body_acceleration).
    #[inline]
    pub fn accelerations(&self, rates: &Vector3<f32>, body: &Vector3<f32>) -> Vector3<f32> {
        let without = self.body_acceleration(rates, &Vector3::zeros());
        self.rates(&(body - without))
    }

    /// From three angles, rad.
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

    /// The body rates Ω = E(η) η̇.
    #[inline]
    pub fn body_rates(&self, rates: &Vector3<f32>) -> Vector3<f32> {
        let ((sr, cr), (sp, cp)) = (self.roll, self.pitch);
        let z_rate = cp * rates.z;
        Vector3::new(rates.x - sp * rates.z, cr * rates.y + sr * z_rate, cr * z_rate - sr * rates.y)
    }

    /// The rotation, for |φ|, |θ| < 90°; `half_yaw` is (sin, cos) of ψ/2.
    #[inline]
    pub fn to_quaternion(&self, half_yaw: (f32, f32)) -> UnitQuaternion<f32> {
        let ((sr, cr), (sp, cp), (sy, cy)) = (half_angle(self.roll), half_angle(self.pitch), half_yaw);
        // Rz(ψ) Ry(θ) first, then Rx(φ).
        let (w, x, y, z) = (cy * cp, -sy * sp, cy * sp, sy * cp);
        let product = Quaternion::new(w * cr - x * sr, w * sr + x * cr, y * cr + z * sr, z * cr - y * sr);
        UnitQuaternion::new_unchecked(product)
    }

    /// Ω̇ = E(η) η̈ + Ė(η, η̇) η̇, with Ω = E(η) η̇.
    #[inline]
    pub fn body_acceleration(&self, rates: &Vector3<f32>, accelerations: &Vector3<f32>) -> Vector3<f32> {
        let ((sr, cr), (sp, cp)) = (self.roll, self.pitch);
        let (roll, pitch, yaw) = (rates.x, rates.y, rates.z);
        let (a_roll, a_pitch, a_yaw) = (accelerations.x, accelerations.y, accelerations.z);
        // Perpendicular to the roll axis: y' = θ̇, z' = ψ̇ cos θ, rotated by φ.
        let z_rate = cp * yaw;
        let z_acceleration = cp * a_yaw - sp * pitch * yaw;
        Vector3::new(
            (a_roll - cp * pitch * yaw) - sp * a_yaw,
            cr * (a_pitch + roll * z_rate) + sr * (z_acceleration - roll * pitch),
            cr * (z_acceleration - roll * pitch) - sr * (a_pitch + roll * z_rate),
        )
    }
}

/// (sin, cos) of half an angle between ±90°, given those of the angle.
#[inline]
fn half_angle((sin, cos): (f32, f32)) -> (f32, f32) {
    let half_cos = math::sqrt(0.5 + 0.5 * math::max(cos, 0.0));
    (0.5 * sin / half_cos, half_cos)
}

/// Reference angles with rates and accelerations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EulerReference {
    /// φd, θd, ψd, rad.
    pub angles: Vector3<f32>,
    /// Their first derivatives, rad/s.
    pub rates: Vector3<f32>,
    /// Their second derivatives, rad/s².
    pub accelerations: Vector3<f32>,
}

impl EulerReference {
    /// The angles, rates and accelerations of an attitude target.
    pub fn of_target(target: &AttitudeTarget) -> Self {
        let euler = Euler::from_quaternion(&target.attitude);
        let rates = euler.rates(&target.rates);
        let accelerations = euler.accelerations(&rates, &target.accelerations);
        Self { angles: euler.angles(), rates, accelerations }
    }
}
