//! Ground contact: four feet on a flat, level ground, each a spring and damper with Coulomb friction.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::Motion;

/// Flat ground and the feet that stand on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Ground {
    /// Height of the ground, m.
    pub height: f64,
    /// Distance of the feet from the body's z axis, m; they are in the body's xy plane, between the arms.
    pub foot_radius: f64,
    /// Stiffness per foot, N/m.
    pub stiffness: f64,
    /// Damping per foot, N s/m.
    pub damping: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Below this sliding speed of the feet (m/s) friction against turning is proportional to it, as long as they carry
    /// the weight; a harder impact softens it in proportion.
    pub turn_stick_speed: f64,
    /// Load on a foot at rest, N.
    pub rest_load: f64,
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
/// The step with which the plants are integrated, s.
const STEP_S: f64 = firmware::signals::TICK_S_EXACT;

impl Ground {
    /// Ground at `height` for a vehicle of the given mass (kg), gravity (m/s²) and yaw inertia Iz (kg m²): it sinks in by 1 mm, damped
    /// near critically.
    ///
    /// Friction on feet with a long lever would stop a rotation within less than a step, and an explicit integrator
    /// would oscillate: friction against turning is softened until that takes a whole step. A landing at 3 m/s loads
    /// the feet with 30 times the weight for a moment, so the softening is proportional to the load.
    pub fn for_vehicle(height: f64, mass: f64, gravity: f64, yaw_inertia: f64) -> Self {
        let (foot_radius, friction) = (0.15, 0.7);
        let weight = mass * gravity;
        let stiffness = weight / 4.0 / 1e-3;
        let foot_mass = mass / 4.0;
        let one_step = friction * weight * foot_radius * foot_radius * STEP_S / yaw_inertia;
        Self {
            height,
            foot_radius,
            stiffness,
            damping: (stiffness * foot_mass).sqrt(),
            friction,
            turn_stick_speed: one_step.max(STICK_SPEED),
            rest_load: weight / 4.0,
        }
    }

    /// Height of a place (m) above the ground, m.
    pub fn height_above(&self, position: &Vector3<f64>) -> f64 {
        position.z - self.height
    }

    /// Force and torque of the ground on a body in this motion.
    pub fn wrench(&self, motion: &Motion) -> Wrench {
        let mut total = Wrench { force: Vector3::zeros(), torque: Vector3::zeros() };
        if self.height_above(&motion.position) > self.foot_radius {
            return total;
        }
        let attitude = UnitQuaternion::new_normalize(motion.attitude);
        for arm in self.feet() {
            let place = motion.position + attitude * arm;
            let turning = attitude * Vector3::new(0.0, 0.0, motion.rates.z).cross(&arm);
            let tilting = attitude * Vector3::new(motion.rates.x, motion.rates.y, 0.0).cross(&arm);
            let force = self.foot_force(place.z, &(motion.velocity + tilting), &turning);
            total.force += force;
            total.torque += arm.cross(&attitude.inverse_transform_vector(&force));
        }
        total
    }

    /// Positions of the feet in the body, m.
    fn feet(&self) -> [Vector3<f64>; 4] {
        let side = self.foot_radius * core::f64::consts::FRAC_1_SQRT_2;
        [(side, side), (side, -side), (-side, -side), (-side, side)].map(|(x, y)| Vector3::new(x, y, 0.0))
    }

    /// Heights of the feet above the ground, m; negative in contact.
    pub fn clearances(&self, position: &Vector3<f64>, attitude: &UnitQuaternion<f64>) -> [f64; 4] {
        self.feet().map(|arm| self.height_above(&(position + attitude * arm)))
    }

    /// Whether a foot of a body there is on it.
    pub fn touches(&self, position: &Vector3<f64>, attitude: &Quaternion<f64>) -> bool {
        if self.height_above(position) > self.foot_radius {
            return false;
        }
        let attitude = UnitQuaternion::new_normalize(*attitude);
        self.clearances(position, &attitude).iter().any(|clearance| *clearance <= 0.0)
    }

    /// Force on a foot at a height, from its velocity without and due to the rotation about the body's z axis.
    fn foot_force(&self, height: f64, moving: &Vector3<f64>, turning: &Vector3<f64>) -> Vector3<f64> {
        let depth = self.height - height;
        if depth <= 0.0 {
            return Vector3::zeros();
        }
        let velocity = moving + turning;
        let normal = (self.stiffness * depth - self.damping * velocity.z).max(0.0);
        let speed = velocity.xy().norm();
        let blow = (normal / self.rest_load).max(1.0);
        let slip = moving / speed.max(STICK_SPEED * blow) + turning / speed.max(self.turn_stick_speed * blow);
        let grip = self.friction * normal / slip.xy().norm().max(1.0);
        Vector3::new(-grip * slip.x, -grip * slip.y, normal)
    }
}
