//! The paper's plant: Eq. 2 with its errata, where Euler rates are used for body rates.
//!
//! Two readings. [`PaperPlant`] is the coupled one, driven by rotor speeds. The decoupled one ([`crate::decoupled`])
//! takes the specific force and the torques as direct inputs, of any size and sign: the model that the paper's figures
//! show.

use nalgebra::{UnitQuaternion, Vector3, Vector4};

use super::{Constants, Motion, Plant, Push};
use firmware::airframe::ROTORS;

/// State of Eq. 5–6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperState {
    /// φ, θ, ψ, rad.
    pub angles: Vector3<f64>,
    /// φ̇, θ̇, ψ̇, rad/s.
    pub angle_rates: Vector3<f64>,
    /// x, y, z, m.
    pub position: Vector3<f64>,
    /// ẋ, ẏ, ż, m/s.
    pub velocity: Vector3<f64>,
}

impl PaperState {
    /// At rest and level.
    pub fn at_rest(position: Vector3<f64>) -> Self {
        let zero = Vector3::zeros();
        Self { angles: zero, angle_rates: zero, position, velocity: zero }
    }

    #[inline]
    fn advance(&self, d: &Self, h: f64) -> Self {
        Self {
            angles: self.angles + d.angles * h,
            angle_rates: self.angle_rates + d.angle_rates * h,
            position: self.position + d.position * h,
            velocity: self.velocity + d.velocity * h,
        }
    }
}

/// The input of Eq. 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperInput {
    /// (Ux U1/m, Uy U1/m, cφcθ U1/m): specific force in the world, m/s².
    pub force: Vector3<f64>,
    /// U2..U4, N m.
    pub torque: Vector3<f64>,
    /// Ωr, rad/s.
    pub spin: f64,
}

impl Constants {
    /// Eq. 2 (errata: drag torques −k φ̇|φ̇|), with the specific force in place of its trigonometric factors.
    pub fn paper_derivative(&self, state: &PaperState, input: &PaperInput, push: &Push) -> PaperState {
        let (roll, pitch, yaw) = (state.angle_rates.x, state.angle_rates.y, state.angle_rates.z);
        let (i, k) = (&self.inertia, &self.rotational_drag);
        let gyroscopic = self.rotor_inertia * input.spin;
        let torque = Vector3::new(
            input.torque.x - k.x * roll * roll.abs() - gyroscopic * pitch + (i.y - i.z) * pitch * yaw,
            input.torque.y - k.y * pitch * pitch.abs() + gyroscopic * roll + (i.z - i.x) * roll * yaw,
            input.torque.z - k.z * yaw * yaw.abs() + (i.x - i.y) * roll * pitch,
        );
        let gravity = Vector3::new(0.0, 0.0, self.gravity);
        PaperState {
            angles: state.angle_rates,
            angle_rates: torque.component_div(&self.inertia) + push.angular_acceleration,
            position: state.velocity,
            velocity: input.force - self.drag.component_mul(&state.velocity) / self.mass - gravity + push.acceleration,
        }
    }

    /// One RK4 step of Eq. 2; `input` may depend on the state.
    pub fn paper_step(
        &self,
        state: &PaperState,
        input: impl Fn(&PaperState) -> PaperInput,
        push: &Push,
        h: f64,
    ) -> PaperState {
        let f = |s: &PaperState| self.paper_derivative(s, &input(s), push);
        let k1 = f(state);
        let k2 = f(&state.advance(&k1, 0.5 * h));
        let k3 = f(&state.advance(&k2, 0.5 * h));
        let k4 = f(&state.advance(&k3, h));
        state.advance(&k1, h / 6.0).advance(&k2, h / 3.0).advance(&k3, h / 3.0).advance(&k4, h / 6.0)
    }
}

/// The coupled Eq. 2: the force follows from the angles and U1.
#[derive(Clone, Debug)]
pub struct PaperPlant {
    constants: Constants,
    state: PaperState,
    omega: Vector4<f64>,
}

impl PaperPlant {
    /// At rest at `position`, with the rotors at hover speed.
    pub fn new(constants: Constants, position: Vector3<f64>) -> Self {
        let omega = Vector4::repeat(constants.hover_omega());
        Self { constants, state: PaperState::at_rest(position), omega }
    }

    /// With another state.
    #[must_use]
    pub fn with_state(mut self, state: PaperState) -> Self {
        self.state = state;
        self
    }
}

/// Ux, Uy and cφcθ (Eq. 9): the thrust axis of `R = Rz(ψ)·Ry(θ)·Rx(φ)`.
fn thrust_axis(angles: &Vector3<f64>) -> Vector3<f64> {
    let (sin_roll, cos_roll) = libm::sincos(angles.x);
    let (sin_pitch, cos_pitch) = libm::sincos(angles.y);
    let (sin_yaw, cos_yaw) = libm::sincos(angles.z);
    Vector3::new(
        cos_roll * sin_pitch * cos_yaw + sin_roll * sin_yaw,
        cos_roll * sin_pitch * sin_yaw - sin_roll * cos_yaw,
        cos_roll * cos_pitch,
    )
}

/// Body rates of Euler rates, Ω = E(η) η̇, so that the firmware sees the rates that this model integrates.
fn body_rates(state: &PaperState) -> Vector3<f64> {
    let (sin_roll, cos_roll) = libm::sincos(state.angles.x);
    let (sin_pitch, cos_pitch) = libm::sincos(state.angles.y);
    let rate = &state.angle_rates;
    Vector3::new(
        rate.x - sin_pitch * rate.z,
        cos_roll * rate.y + sin_roll * cos_pitch * rate.z,
        cos_roll * cos_pitch * rate.z - sin_roll * rate.y,
    )
}

/// The state as a motion, for the firmware and the record.
pub fn motion(state: &PaperState) -> Motion {
    let attitude = UnitQuaternion::from_euler_angles(state.angles.x, state.angles.y, state.angles.z);
    Motion {
        position: state.position,
        velocity: state.velocity,
        attitude: attitude.into_inner(),
        rates: body_rates(state),
    }
}

impl Plant for PaperPlant {
    fn motion(&self) -> Motion {
        motion(&self.state)
    }

    fn omega(&self) -> [f64; ROTORS] {
        self.omega.into()
    }

    fn omega_during(&self, command: &[f64; ROTORS]) -> [f64; ROTORS] {
        *command
    }

    fn specific_force(&self, push: &Push) -> Vector3<f64> {
        let (c, s) = (&self.constants, &self.state);
        let thrust = thrust_axis(&s.angles) * (c.inputs(&self.omega).x / c.mass);
        let world = thrust - c.drag.component_mul(&s.velocity) / c.mass + push.acceleration;
        UnitQuaternion::from_euler_angles(s.angles.x, s.angles.y, s.angles.z).inverse_transform_vector(&world)
    }

    fn step(&mut self, command: &[f64; ROTORS], push: &Push, h: f64) {
        let c = &self.constants;
        let omega = Vector4::from(*command);
        let u = c.inputs(&omega);
        let input = |s: &PaperState| PaperInput {
            force: thrust_axis(&s.angles) * (u.x / c.mass),
            torque: Vector3::new(u.y, u.z, u.w),
            spin: c.rotor_spin(&omega),
        };
        self.state = c.paper_step(&self.state, input, push, h);
        self.omega = omega;
    }
}
