//! A vehicle to be flown on the target: a rigid body with rotor lag and spin-up reaction, integrated by Euler steps of
//! a tick. Just accurate enough to exercise the loops as in a flight.

use firmware::airframe::{Airframe, ROTORS};
use firmware::control::position::Translation;
use firmware::math;
use firmware::signals::{MotorCommand, NavState, TICK_S};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

pub(crate) struct Plant {
    airframe: Airframe,
    model: Translation,
    omega_rad_s: [f32; ROTORS],
    pub(crate) nav: NavState,
    /// Rᵀ(v̇ + g e3), m/s².
    pub(crate) specific_force: Vector3<f32>,
}

impl Plant {
    /// With the rotors at hover speed.
    pub(crate) fn new(airframe: &Airframe, nav: NavState) -> Self {
        let omega_rad_s = [airframe.omega_for_thrust_to_weight(1.0); ROTORS];
        let specific_force = Vector3::new(0.0, 0.0, airframe.gravity_m_s2);
        Self { airframe: *airframe, model: Translation::new(airframe), omega_rad_s, nav, specific_force }
    }

    /// Rotor speeds, rad/s.
    pub(crate) fn omega_rad_s(&self) -> &[f32; ROTORS] {
        &self.omega_rad_s
    }

    /// Advances by one tick with these commands.
    pub(crate) fn step(&mut self, command: &MotorCommand) {
        let airframe = &self.airframe;
        let spin_before = airframe.rotor_spin_rad_s(&self.omega_rad_s);
        for (omega, command) in self.omega_rad_s.iter_mut().zip(command.omega_rad_s) {
            *omega += (command - *omega) * (TICK_S / airframe.rotor_lag_s);
        }
        let lifts = self.omega_rad_s.iter().zip(&airframe.geometry.thrust).map(|(omega, lift)| lift * omega * omega);
        let thrust_n: f32 = lifts.sum();
        let mut torque = airframe.geometry.torque(&self.omega_rad_s);
        let spin_up = (airframe.rotor_spin_rad_s(&self.omega_rad_s) - spin_before) / TICK_S;
        torque.z -= airframe.rotor_inertia_kg_m2 * spin_up;
        let inertia = Vector3::from(airframe.inertia_kg_m2);

        let nav = &mut self.nav;
        let force = nav.attitude * Vector3::new(0.0, 0.0, thrust_n / airframe.mass_kg);
        nav.position += nav.velocity * TICK_S;
        let acceleration = self.model.acceleration(&force, &nav.velocity);
        nav.velocity += acceleration * TICK_S;
        let half_turn = nav.rates * (0.5 * TICK_S);
        let turn = Quaternion::new(1.0, half_turn.x, half_turn.y, half_turn.z);
        let attitude = nav.attitude.quaternion() * turn;
        nav.attitude = UnitQuaternion::new_unchecked(attitude / math::sqrt(attitude.norm_squared()));
        let gyroscopic = nav.rates.cross(&inertia.component_mul(&nav.rates));
        self.specific_force = nav.attitude.inverse() * (acceleration + Vector3::z() * airframe.gravity_m_s2);
        nav.rates += (torque - gyroscopic).component_div(&inertia) * TICK_S;
    }
}
