//! The vehicle's physical constants and its rotor geometry.
//!
//! Owns the quantities of Table 2 (b, d, m, I, Jr, k1..k6), ωmax, and the matrix B from squared rotor speeds to U =
//! (U1, U2, U3, U4), Eq. 4. The values of a particular airframe come from its file on the desktop.
//!
//! ```
//! use firmware::airframe::{Airframe, ROTORS};
//!
//! // The paper's quadrotor, with twice as much thrust as weight.
//! let airframe = Airframe::paper(2.0);
//! assert!((airframe.thrust_max_n() - 2.0 * airframe.weight_n()).abs() < 1e-3);
//!
//! // At hover speed the rotors' torques cancel, and rotors 2 and 4 turning faster yaw to the right.
//! let hover = airframe.omega_for_thrust_to_weight(1.0);
//! assert!(airframe.geometry.torque(&[hover; ROTORS]).norm() < 1e-6);
//! let [slow, fast] = [0.9 * hover, 1.1 * hover];
//! assert!(airframe.geometry.torque(&[slow, fast, slow, fast]).z < 0.0);
//! ```

use nalgebra::Vector3;

use crate::math;
use crate::settings;
use crate::validate::ConfigError;

/// Number of rotors in this build. The mixer itself supports four to eight.
pub const ROTORS: usize = 4;

/// Physical constants of an airframe. Frames are NWU/FLU.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Airframe {
    /// Total mass m, kg.
    pub mass_kg: f32,
    /// Principal moments of inertia Ix, Iy, Iz, kg m².
    pub inertia_kg_m2: [f32; 3],
    /// Inertia of one rotor about its axis Jr, kg m².
    pub rotor_inertia_kg_m2: f32,
    /// Translational drag k1..k3, N s/m.
    pub drag_n_s_m: [f32; 3],
    /// Rotational drag k4..k6, N m s²/rad².
    pub rotational_drag_n_m_s2: [f32; 3],
    /// Gravitational acceleration g, m/s².
    pub gravity_m_s2: f32,
    /// Greatest rotor speed ωmax, rad/s.
    pub omega_max_rad_s: f32,
    /// Time constant of a rotor's speed, s; 0 for a rotor without lag.
    pub rotor_lag_s: f32,
    /// Whether the reaction torque of spinning up, −Jr Ω̇r, is modelled.
    pub spin_up_reaction: bool,
    /// Contribution of each rotor to U1..U4 per unit of ω² (see [`RotorGeometry`]).
    pub geometry: RotorGeometry,
}

/// Rows of the matrix B with U = B·(ω1², …, ωn²): U1 in N, U2..U4 in N m, each s²/rad².
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct RotorGeometry {
    /// Thrust per rotor, U1.
    pub thrust: [f32; ROTORS],
    /// Roll torque per rotor, U2.
    pub roll: [f32; ROTORS],
    /// Pitch torque per rotor, U3.
    pub pitch: [f32; ROTORS],
    /// Yaw torque per rotor, U4.
    pub yaw: [f32; ROTORS],
}

impl RotorGeometry {
    /// The paper's plus layout (Eq. 4) from lift `b` (N s²), drag `d` (N m s²) and arm `l` (m): rotor 1 front, 2 right,
    /// 3 rear, 4 left; 1 and 3 yaw the body towards +ψ.
    pub const fn plus(b: f32, d: f32, l: f32) -> Self {
        Self {
            thrust: [b, b, b, b],
            roll: [0.0, -l * b, 0.0, l * b],
            pitch: [-l * b, 0.0, l * b, 0.0],
            yaw: [d, -d, d, -d],
        }
    }

    /// Torque (N m) of rotor speeds (rad/s): the last three rows of U = B ω².
    #[inline]
    pub fn torque(&self, omega_rad_s: &[f32; ROTORS]) -> Vector3<f32> {
        let square = omega_rad_s.map(|omega| omega * omega);
        Vector3::new(product(&self.roll, &square), product(&self.pitch, &square), product(&self.yaw, &square))
    }

    /// The matrix B, 4 × [`ROTORS`].
    pub const fn rows(&self) -> [[f32; ROTORS]; 4] {
        [self.thrust, self.roll, self.pitch, self.yaw]
    }
}

/// Dot product over the rotors.
#[inline]
fn product(one: &[f32; ROTORS], other: &[f32; ROTORS]) -> f32 {
    one.iter().zip(other).map(|(a, b)| a * b).reduce(|a, b| a + b).unwrap_or(0.0)
}

/// Ωr (rad/s) of rotors with these senses of rotation and speeds.
#[inline]
pub fn spin_rad_s(senses: &[f32; ROTORS], omega_rad_s: &[f32; ROTORS]) -> f32 {
    product(senses, omega_rad_s)
}

impl Airframe {
    /// The paper's airframe (Table 2 as printed), with ωmax for the given thrust-to-weight ratio.
    pub fn paper(thrust_to_weight: f32) -> Self {
        let mut airframe = Self {
            mass_kg: 0.823,
            inertia_kg_m2: [0.5e-2, 0.5e-2, 0.1e-2],
            rotor_inertia_kg_m2: 28.4e-4,
            drag_n_s_m: [0.3729; 3],
            rotational_drag_n_m_s2: [0.0556; 3],
            gravity_m_s2: 9.81,
            omega_max_rad_s: 0.0,
            rotor_lag_s: 0.0,
            spin_up_reaction: false,
            geometry: RotorGeometry::plus(29.8e-4, 33e-6, 0.350),
        };
        airframe.omega_max_rad_s = airframe.omega_for_thrust_to_weight(thrust_to_weight);
        airframe
    }

    /// Weight m·g, N.
    pub fn weight_n(&self) -> f32 {
        self.mass_kg * self.gravity_m_s2
    }

    /// Rotor speed (rad/s) at which all rotors together lift `ratio` times the weight.
    pub fn omega_for_thrust_to_weight(&self, ratio: f32) -> f32 {
        let lift: f32 = self.geometry.thrust.iter().sum();
        math::sqrt(ratio * self.weight_n() / lift)
    }

    /// Lead time T of the spin-up reaction over the yaw torque, s: around hover the total torque is U4 + T U̇4 with T =
    /// Jr/(2 d ω). 0 without the reaction, and for rotors without lag.
    pub fn spin_up_lead_s(&self) -> f32 {
        let yaw: f32 = self.geometry.yaw.iter().map(|d| math::abs(*d)).sum::<f32>() / ROTORS as f32;
        let per_speed = 2.0 * yaw * self.omega_for_thrust_to_weight(1.0);
        let reacts = self.spin_up_reaction && self.rotor_lag_s > 0.0;
        if reacts && per_speed > 0.0 { self.rotor_inertia_kg_m2 / per_speed } else { 0.0 }
    }

    /// Greatest distance of a rotor from the roll axis or the pitch axis, m.
    pub fn arm_m(&self) -> f32 {
        let g = &self.geometry;
        let arms = |row: &[f32; ROTORS]| {
            row.iter().zip(&g.thrust).map(|(torque, lift)| math::abs(torque / lift)).fold(0.0, math::max)
        };
        math::max(arms(&g.roll), arms(&g.pitch))
    }

    /// Greatest thrust of all rotors together, N.
    pub fn thrust_max_n(&self) -> f32 {
        let lift: f32 = self.geometry.thrust.iter().sum();
        lift * self.omega_max_rad_s * self.omega_max_rad_s
    }

    /// Angular acceleration about the slower of roll and pitch with all the torque that the rotors can give, rad/s².
    pub fn tilting_rad_s2(&self) -> f32 {
        let [about_x, about_y, _] = self.turning();
        math::min(about_x, about_y)
    }

    /// The same about yaw.
    pub fn yawing_rad_s2(&self) -> f32 {
        self.turning()[2]
    }

    /// Angular acceleration about each axis with all the torque that the rotors can give, rad/s².
    fn turning(&self) -> [f32; 3] {
        let [_, roll, pitch, yaw] = self.geometry.rows();
        let torque = |row: [f32; ROTORS]| row.iter().map(|arm| math::max(*arm, 0.0)).sum::<f32>();
        let square = self.omega_max_rad_s * self.omega_max_rad_s;
        let [about_x, about_y, about_z] = self.inertia_kg_m2;
        [square * torque(roll) / about_x, square * torque(pitch) / about_y, square * torque(yaw) / about_z]
    }

    /// Ωr, the sum of the rotors' spins about +z (Eq. 2): −ω1 + ω2 − ω3 + ω4 on the plus layout.
    #[inline]
    pub fn rotor_spin_rad_s(&self, omega_rad_s: &[f32; ROTORS]) -> f32 {
        spin_rad_s(&self.rotor_senses(), omega_rad_s)
    }

    /// Sense of rotation of each rotor about +z, ±1: a rotor that yaws the body towards +ψ spins the other way.
    pub fn rotor_senses(&self) -> [f32; ROTORS] {
        self.geometry.yaw.map(|yaw| if yaw > 0.0 { -1.0 } else { 1.0 })
    }

    /// Checks that the values are physically possible.
    ///
    /// # Errors
    /// The first field that is not finite, not positive, or negative where it must be ≥ 0.
    pub fn validate(&self) -> Result<(), ConfigError> {
        settings::check_airframe(self)
    }
}
