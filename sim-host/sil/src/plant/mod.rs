//! Plant models: the simulated truth. Double precision, fixed step, deterministic.
//!
//! [`rigid_body`] is the truth for everything that flies; [`paper`] is the paper's small-angle model, kept to
//! reproduce its figures. World frame NWU, body frame FLU.

pub mod air;
pub mod battery;
pub mod effects;
pub mod ground;
pub mod paper;
pub mod rigid_body;

use battery::BatteryState;
use firmware::airframe::ROTORS;
use firmware::signals::NavState;
use nalgebra::{Matrix4, Quaternion, UnitQuaternion, Vector3, Vector4};

/// An airframe's constants in double precision. Symbols as in Table 2 of the paper.
#[derive(Clone, Debug, PartialEq)]
pub struct Constants {
    /// m, kg.
    pub mass: f64,
    /// Ix, Iy, Iz, kg m².
    pub inertia: Vector3<f64>,
    /// Jr, kg m².
    pub rotor_inertia: f64,
    /// k1..k3, N s/m.
    pub drag: Vector3<f64>,
    /// k4..k6, N m s²/rad².
    pub rotational_drag: Vector3<f64>,
    /// g, m/s².
    pub gravity: f64,
    /// B in U = B ω² (Eq. 4).
    pub geometry: Matrix4<f64>,
    /// Sign of each rotor's spin in Ωr.
    pub spin: Vector4<f64>,
    /// Rotor time constant, s; 0 for rotors without lag.
    pub rotor_lag: f64,
    /// Whether the spin-up reaction (−Jr Ω̇r) is modelled. Not for the paper's airframe, whose printed Jr is so large
    /// that yaw control would be lost.
    pub spin_up_reaction: bool,
}

impl Constants {
    /// U1..U4 of rotor speeds (rad/s), Eq. 4.
    #[inline]
    pub fn inputs(&self, omega: &Vector4<f64>) -> Vector4<f64> {
        let square = omega.component_mul(omega);
        let share = |rotor: usize| self.geometry.column(rotor) * square[rotor];
        // Added in pairs: a serial sum of four would be the longest dependency chain in a step.
        (share(0) + share(1)) + (share(2) + share(3))
    }

    /// The rotor speed at which four equal rotors carry the weight, rad/s.
    pub fn hover_omega(&self) -> f64 {
        (self.mass * self.gravity / self.geometry.row(0).sum()).sqrt()
    }

    /// Ωr of rotor speeds, rad/s.
    #[inline]
    pub fn rotor_spin(&self, omega: &Vector4<f64>) -> f64 {
        self.spin.dot(omega)
    }
}

/// The true motion of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Position, m.
    pub position: Vector3<f64>,
    /// Velocity, m/s.
    pub velocity: Vector3<f64>,
    /// Body to world.
    pub attitude: Quaternion<f64>,
    /// Ω = (p, q, r), rad/s.
    pub rates: Vector3<f64>,
}

impl Motion {
    /// At rest, level, heading north.
    pub fn at_rest(position: Vector3<f64>) -> Self {
        Self { position, velocity: Vector3::zeros(), attitude: Quaternion::identity(), rates: Vector3::zeros() }
    }

    /// As ideal state for the firmware.
    #[inline]
    pub fn as_nav(&self) -> NavState {
        NavState {
            position: self.position.cast(),
            velocity: self.velocity.cast(),
            attitude: UnitQuaternion::new_unchecked(self.attitude.cast()),
            rates: self.rates.cast(),
        }
    }
}

/// Accelerations added to the vehicle's own, held over a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Push {
    /// In the world, m/s².
    pub acceleration: Vector3<f64>,
    /// About the body's axes, rad/s².
    pub angular_acceleration: Vector3<f64>,
}

/// Effect of the faults on rotors and battery; 1 without a fault.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlantFaults {
    /// Remaining fraction of each rotor's thrust.
    pub rotor_effectiveness: [f64; ROTORS],
    /// Remaining fraction of the battery's voltage.
    pub battery_factor: f64,
}

/// A model that can be flown in lockstep.
///
/// Between steps it provides the quantities that sensors measure, and accepts faults; a model without an effect returns
/// a constant.
pub trait Plant {
    /// The motion now.
    fn motion(&self) -> Motion;

    /// Rotor speeds now, rad/s: those of the step before, or those at the start.
    fn omega(&self) -> [f64; ROTORS];

    /// Rotor speeds (rad/s) that act from now on under a command: the command itself, or, with rotor lag, the
    /// speeds now.
    fn omega_during(&self, command: &[f64; ROTORS]) -> [f64; ROTORS];

    /// Advances by `step` seconds with commanded rotor speeds (rad/s) and a push, both held.
    fn step(&mut self, command: &[f64; ROTORS], push: &Push, step: f64);

    /// Specific force at the centre of mass in the body frame, m/s²: R(q)ᵀ (v̇ + g e3), at the present rotor speeds and
    /// with the given push.
    fn specific_force(&self, push: &Push) -> Vector3<f64>;

    /// Air density, relative to that for which the drag coefficients hold.
    fn air_density(&self) -> f64 {
        1.0
    }

    /// Sets the faults of rotors and battery from now on, in place of the schedule.
    fn apply_faults(&mut self, _faults: &PlantFaults) {}

    /// Drag over mass (k1..k3 over m, 1/s), by which a wind acts on it; none for a model without wind.
    fn drag(&self) -> Option<Vector3<f64>> {
        None
    }

    /// Whether there is ground below it.
    fn has_ground(&self) -> bool {
        false
    }

    /// Its battery, if it has one.
    fn battery(&self) -> Option<BatteryState> {
        None
    }
}
