//! Ground contact: four feet on a flat, level ground, each a spring and damper with Coulomb friction.

use nalgebra::{UnitQuaternion, Vector3};

use super::Motion;

/// Flat ground and the feet that stand on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Ground {
    /// Height of the ground, m.
    pub height: f64,
    /// Distance of the feet from the body's z axis, m; they lie in the body's xy plane, between the arms.
    pub foot_radius: f64,
    /// Spring rate a foot, N/m.
    pub stiffness: f64,
    /// Damping a foot, N s/m.
    pub damping: f64,
    /// Coefficient of friction.
    pub friction: f64,
}

/// Force in the world (N) and torque about the body's axes (N m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench {
    /// In the world, N.
    pub force: Vector3<f64>,
    /// About the body's axes, N m.
    pub torque: Vector3<f64>,
}

/// Below this sliding speed (m/s) friction is proportional to it: Coulomb's law made smooth.
const STICK_SPEED: f64 = 0.02;

impl Ground {
    /// Ground at `height` for a vehicle of the given weight (N): it sinks in by 1 mm, damped near critically.
    pub fn for_weight(height: f64, weight: f64) -> Self {
        let stiffness = weight / 4.0 / 1e-3;
        let foot_mass = weight / 9.81 / 4.0;
        Self { height, foot_radius: 0.15, stiffness, damping: (stiffness * foot_mass).sqrt(), friction: 0.7 }
    }

    /// What the ground does to a body in this motion.
    pub fn wrench(&self, motion: &Motion) -> Wrench {
        let mut total = Wrench { force: Vector3::zeros(), torque: Vector3::zeros() };
        if motion.position.z - self.height > self.foot_radius {
            return total;
        }
        let attitude = UnitQuaternion::new_normalize(motion.attitude);
        let side = self.foot_radius * core::f64::consts::FRAC_1_SQRT_2;
        for (x, y) in [(side, side), (side, -side), (-side, -side), (-side, side)] {
            let arm = Vector3::new(x, y, 0.0);
            let place = motion.position + attitude * arm;
            let velocity = motion.velocity + attitude * motion.rates.cross(&arm);
            let force = self.foot_force(place.z, &velocity);
            total.force += force;
            total.torque += arm.cross(&attitude.inverse_transform_vector(&force));
        }
        total
    }

    /// Force on a foot at a height with a velocity.
    fn foot_force(&self, height: f64, velocity: &Vector3<f64>) -> Vector3<f64> {
        let depth = self.height - height;
        if depth <= 0.0 {
            return Vector3::zeros();
        }
        let normal = (self.stiffness * depth - self.damping * velocity.z).max(0.0);
        let speed = velocity.x.hypot(velocity.y);
        let friction = -self.friction * normal / speed.max(STICK_SPEED);
        Vector3::new(friction * velocity.x, friction * velocity.y, normal)
    }
}
