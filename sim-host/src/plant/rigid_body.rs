//! The rigid-body plant: full Newton–Euler motion of a quaternion attitude, integrated by fixed-step RK4.
//!
//! ```text
//! ṗ = v        v̇ = R(q)[0,0,U1]ᵀ/m − (k1..3/m)·v − [0,0,g]ᵀ        q̇ = ½ q ⊗ [0, Ω]
//! I Ω̇ = τ − Ω × I Ω − Ω × [0, 0, Jr Ωr]ᵀ − (k4 p|p|, k5 q|q|, k6 r|r|)ᵀ (− [0, 0, Jr Ω̇r]ᵀ)
//! ω̇i = (ωi,cmd − ωi)/τrotor
//! ```
//!
//! The rotors' first-order lag has a closed form between commands, so it is evaluated exactly at the stages.

use nalgebra::{Quaternion, Vector3, Vector4};

use super::ground::Ground;
use super::{Constants, Motion, Plant, Push};
use firmware::airframe::ROTORS;

/// The plant and its state.
#[derive(Clone, Debug)]
pub struct RigidBody {
    constants: Constants,
    inverse_mass: f64,
    inverse_inertia: Vector3<f64>,
    ground: Option<Ground>,
    motion: Motion,
    omega: Vector4<f64>,
}

/// Time derivative of a [`Motion`].
#[derive(Clone, Copy)]
struct Derivative {
    velocity: Vector3<f64>,
    acceleration: Vector3<f64>,
    attitude: Quaternion<f64>,
    angular_acceleration: Vector3<f64>,
}

/// What the rotors do to the body at a stage.
#[derive(Clone, Copy)]
struct RotorState {
    /// U1/m, m/s².
    specific_thrust: f64,
    /// U2..U4, less the reaction to spin-up, N m.
    torque: Vector3<f64>,
    /// Jr Ωr, N m s.
    spin_momentum: f64,
}

impl RigidBody {
    /// At rest at `position`, rotors turning so as to hover (in the air) or standing (on the ground).
    pub fn new(constants: Constants, ground: Option<Ground>, position: Vector3<f64>) -> Self {
        let hover = (constants.mass * constants.gravity / constants.geometry.row(0).sum()).sqrt();
        let omega = Vector4::repeat(if ground.is_some() { 0.0 } else { hover });
        Self {
            inverse_mass: 1.0 / constants.mass,
            inverse_inertia: constants.inertia.map(f64::recip),
            ground,
            motion: Motion::at_rest(position),
            omega,
            constants,
        }
    }

    /// With another motion and rotor speeds.
    #[must_use]
    pub fn with_state(mut self, motion: Motion, omega: Vector4<f64>) -> Self {
        self.motion = motion;
        self.omega = omega;
        self
    }

    /// The constants it was built with.
    pub fn constants(&self) -> &Constants {
        &self.constants
    }

    #[inline]
    fn rotors(&self, omega: &Vector4<f64>, command: &Vector4<f64>) -> RotorState {
        let c = &self.constants;
        let u = c.inputs(omega);
        let spin_momentum = c.rotor_inertia * c.rotor_spin(omega);
        let reaction = if c.spin_up_reaction && c.rotor_lag > 0.0 {
            c.rotor_inertia * c.rotor_spin(&((command - omega) / c.rotor_lag))
        } else {
            0.0
        };
        RotorState {
            specific_thrust: u.x * self.inverse_mass,
            torque: Vector3::new(u.y, u.z, u.w - reaction),
            spin_momentum,
        }
    }

    #[inline]
    fn derivative(&self, state: &Motion, rotors: &RotorState, push: &Push) -> Derivative {
        let c = &self.constants;
        let q = &state.attitude;
        let (w, x, y, z) = (q.w, q.i, q.j, q.k);
        let axis = Vector3::new(2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y));
        let mut acceleration = axis * rotors.specific_thrust
            - c.drag.component_mul(&state.velocity) * self.inverse_mass
            + push.acceleration;
        acceleration.z -= c.gravity;

        let (p, q_, r) = (state.rates.x, state.rates.y, state.rates.z);
        let (i, k) = (&c.inertia, &c.rotational_drag);
        let mut torque = Vector3::new(
            rotors.torque.x - (i.z - i.y) * q_ * r - rotors.spin_momentum * q_ - k.x * p * p.abs(),
            rotors.torque.y - (i.x - i.z) * p * r + rotors.spin_momentum * p - k.y * q_ * q_.abs(),
            rotors.torque.z - (i.y - i.x) * p * q_ - k.z * r * r.abs(),
        );
        if let Some(ground) = &self.ground {
            let contact = ground.wrench(state);
            acceleration += contact.force * self.inverse_mass;
            torque += contact.torque;
        }
        Derivative {
            velocity: state.velocity,
            acceleration,
            attitude: Quaternion::new(
                0.5 * (-x * p - y * q_ - z * r),
                0.5 * (w * p + y * r - z * q_),
                0.5 * (w * q_ - x * r + z * p),
                0.5 * (w * r + x * q_ - y * p),
            ),
            angular_acceleration: torque.component_mul(&self.inverse_inertia) + push.angular_acceleration,
        }
    }

    /// Rotor speeds after `time` on the way from `from` to `command`.
    #[inline]
    fn omega_after(&self, from: &Vector4<f64>, command: &Vector4<f64>, time: f64) -> Vector4<f64> {
        if self.constants.rotor_lag > 0.0 {
            command + (from - command) * libm::exp(-time / self.constants.rotor_lag)
        } else {
            *command
        }
    }
}

/// `state + derivative·h`.
#[inline]
fn advance(state: &Motion, d: &Derivative, h: f64) -> Motion {
    Motion {
        position: state.position + d.velocity * h,
        velocity: state.velocity + d.acceleration * h,
        attitude: state.attitude + d.attitude * h,
        rates: state.rates + d.angular_acceleration * h,
    }
}

impl Plant for RigidBody {
    #[inline]
    fn motion(&self) -> Motion {
        self.motion
    }

    #[inline]
    fn omega_during(&self, command: &[f64; ROTORS]) -> [f64; ROTORS] {
        if self.constants.rotor_lag > 0.0 { self.omega.into() } else { *command }
    }

    #[inline]
    fn step(&mut self, command: &[f64; ROTORS], push: &Push, h: f64) {
        let command = Vector4::from(*command);
        let start = if self.constants.rotor_lag > 0.0 { self.omega } else { command };
        let first = self.rotors(&start, &command);
        let (middle, last, end) = if self.constants.rotor_lag > 0.0 {
            let half = self.omega_after(&start, &command, 0.5 * h);
            let end = self.omega_after(&start, &command, h);
            (self.rotors(&half, &command), self.rotors(&end, &command), end)
        } else {
            (first, first, command)
        };

        let s = &self.motion;
        let k1 = self.derivative(s, &first, push);
        let k2 = self.derivative(&advance(s, &k1, 0.5 * h), &middle, push);
        let k3 = self.derivative(&advance(s, &k2, 0.5 * h), &middle, push);
        let k4 = self.derivative(&advance(s, &k3, h), &last, push);
        let sum = Derivative {
            velocity: k1.velocity + (k2.velocity + k3.velocity) * 2.0 + k4.velocity,
            acceleration: k1.acceleration + (k2.acceleration + k3.acceleration) * 2.0 + k4.acceleration,
            attitude: k1.attitude + (k2.attitude + k3.attitude) * 2.0 + k4.attitude,
            angular_acceleration: k1.angular_acceleration
                + (k2.angular_acceleration + k3.angular_acceleration) * 2.0
                + k4.angular_acceleration,
        };
        let mut next = advance(s, &sum, h / 6.0);
        next.attitude /= next.attitude.norm_squared().sqrt();
        self.motion = next;
        self.omega = end;
    }
}
