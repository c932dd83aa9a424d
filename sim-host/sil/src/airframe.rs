//! Airframe files: a vehicle's constants, read once, for the plant (f64) and for the firmware (f32) alike.

use anyhow::{Result, ensure};
use firmware::airframe::{Airframe, ROTORS, RotorGeometry};
use glissade_files::refusal::{above_zero, within};
use nalgebra::{Matrix4, Vector3, Vector4};
use serde::{Deserialize, Serialize};

use crate::plant::Constants;

/// One rotor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rotor {
    /// Where it is, forward of the centre of mass, m.
    pub x_m: f64,
    /// Where it is, left of the centre of mass, m.
    pub y_m: f64,
    /// Thrust for each unit of ω², N s²/rad².
    pub lift_n_s2: f64,
    /// Yaw torque on the body for each unit of ω², N m s²/rad²: above zero if it pushes towards +ψ.
    pub yaw_n_m_s2: f64,
}

/// Least and greatest thrust over weight: below, it cannot climb; above, ωmax is no speed of a rotor.
pub const THRUST_TO_WEIGHT: (f64, f64) = (1.01, 1e3);
/// Slowest rotors, s.
pub const ROTOR_LAG_MAX_S: f64 = 10.0;

/// How many points a battery's curve has: at 0, 10, …, 100 % of its charge.
pub const CURVE_POINTS: usize = 11;

/// A battery, and what it feeds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pack {
    /// Open-circuit voltage at 0, 10, …, 100 % of the charge, V.
    pub open_circuit_v: [f64; CURVE_POINTS],
    /// Of the cells and the wires, Ω.
    pub resistance_ohm: f64,
    /// Charge of a full one, Ah.
    pub capacity_ah: f64,
    /// Voltage at the terminals at which the rotors just reach ωmax, V.
    pub nominal_v: f64,
    /// Mechanical power of the rotors over electrical power, of motors and their controllers together.
    pub efficiency: f64,
    /// What all else takes, W.
    pub avionics_w: f64,
}

/// An airframe file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AirframeFile {
    /// What it is, and where its figures come from.
    pub summary: String,
    /// m, kg.
    pub mass_kg: f64,
    /// Ix, Iy, Iz, kg m².
    pub inertia_kg_m2: [f64; 3],
    /// Jr, kg m².
    pub rotor_inertia_kg_m2: f64,
    /// k1..k3, N s/m.
    pub drag_n_s_m: [f64; 3],
    /// k4..k6, N m s²/rad².
    pub rotational_drag_n_m_s2: [f64; 3],
    /// g, m/s².
    pub gravity_m_s2: f64,
    /// Greatest thrust over weight; ωmax follows from it.
    pub thrust_to_weight: f64,
    /// Time constant of the rotors' speed, s.
    pub rotor_lag_s: f64,
    /// How much later than commanded the rotors are told, s; whole ticks.
    #[serde(default)]
    pub actuation_delay_s: f64,
    /// Whether spinning the rotors up turns the body.
    pub spin_up_reaction: bool,
    /// Time constant of a rotor that slows down, s, for scenarios that ask for it.
    pub rotor_lag_down_s: Option<f64>,
    /// R, m, for scenarios with ground effect.
    pub rotor_radius_m: Option<f64>,
    /// Height of the rotors' plane above the feet, m, for scenarios with ground effect.
    #[serde(default)]
    pub rotor_height_m: f64,
    /// The battery, for scenarios that fly by one.
    pub battery: Option<Pack>,
    /// The rotors.
    pub rotors: [Rotor; ROTORS],
}

impl Rotor {
    fn validate(&self, key: &str) -> Result<()> {
        above_zero(&format!("{key}.lift_n_s2"), self.lift_n_s2)?;
        within(&format!("{key}.yaw_n_m_s2"), self.yaw_n_m_s2, -1.0, 1.0)?;
        within(&format!("{key}.x_m"), self.x_m, -100.0, 100.0)?;
        within(&format!("{key}.y_m"), self.y_m, -100.0, 100.0)
    }
}

impl Pack {
    fn validate(&self) -> Result<()> {
        let within = |name: &str, value, low, high| within(&format!("airframe.battery.{name}"), value, low, high);
        let curve = &self.open_circuit_v;
        for (i, volts) in curve.iter().enumerate() {
            within(&format!("open_circuit_v.{i}"), *volts, 0.1, 1e3)?;
        }
        ensure!(curve.is_sorted(), "`airframe.battery.open_circuit_v` must rise from an empty to a full battery");
        within("resistance_ohm", self.resistance_ohm, 0.0, 10.0)?;
        within("capacity_ah", self.capacity_ah, 1e-3, 1e4)?;
        within("nominal_v", self.nominal_v, 0.1, 1e3)?;
        within("efficiency", self.efficiency, 0.01, 1.0)?;
        within("avionics_w", self.avionics_w, 0.0, 1e5)
    }
}

impl AirframeFile {
    /// Refuses values from which no vehicle can be made; what the firmware refuses, it refuses itself.
    ///
    /// # Errors
    /// The key that is out of its range.
    pub fn validate(&self) -> Result<()> {
        let positive = |name: &str, value| above_zero(&format!("airframe.{name}"), value);
        positive("mass_kg", self.mass_kg)?;
        positive("gravity_m_s2", self.gravity_m_s2)?;
        within("airframe.thrust_to_weight", self.thrust_to_weight, THRUST_TO_WEIGHT.0, THRUST_TO_WEIGHT.1)?;
        within("airframe.rotor_lag_s", self.rotor_lag_s, 0.0, ROTOR_LAG_MAX_S)?;
        for (i, moment) in self.inertia_kg_m2.iter().enumerate() {
            positive(&format!("inertia_kg_m2.{i}"), *moment)?;
        }
        self.rotors.iter().enumerate().try_for_each(|(i, rotor)| rotor.validate(&format!("airframe.rotors.{i}")))?;
        positive("rotor_lag_down_s", self.rotor_lag_down_s.unwrap_or(1.0))?;
        positive("rotor_radius_m", self.rotor_radius_m.unwrap_or(1.0))?;
        within("airframe.rotor_height_m", self.rotor_height_m, -100.0, 100.0)?;
        self.battery.as_ref().map_or(Ok(()), Pack::validate)
    }

    /// ωmax, rad/s: the speed at which the rotors lift `thrust_to_weight` times the weight.
    pub fn omega_max(&self) -> f64 {
        let lift: f64 = self.rotors.iter().map(|rotor| rotor.lift_n_s2).sum();
        (self.thrust_to_weight * self.mass_kg * self.gravity_m_s2 / lift).sqrt()
    }

    /// B in U = B ω²: thrust, roll (y b), pitch (−x b) and yaw a rotor.
    pub fn geometry(&self) -> Matrix4<f64> {
        Matrix4::from_columns(&self.rotors.map(|rotor| {
            let lift = rotor.lift_n_s2;
            Vector4::new(lift, rotor.y_m * lift, -rotor.x_m * lift, rotor.yaw_n_m_s2)
        }))
    }

    /// For the plant.
    pub fn constants(&self) -> Constants {
        Constants {
            mass: self.mass_kg,
            inertia: Vector3::from(self.inertia_kg_m2),
            rotor_inertia: self.rotor_inertia_kg_m2,
            drag: Vector3::from(self.drag_n_s_m),
            rotational_drag: Vector3::from(self.rotational_drag_n_m_s2),
            gravity: self.gravity_m_s2,
            geometry: self.geometry(),
            spin: Vector4::from(self.rotors.map(|rotor| if rotor.yaw_n_m_s2 > 0.0 { -1.0 } else { 1.0 })),
            rotor_lag: self.rotor_lag_s,
            spin_up_reaction: self.spin_up_reaction,
        }
    }

    /// For the firmware.
    pub fn flight(&self) -> Airframe {
        let vector = |v: [f64; 3]| v.map(|x| x as f32);
        let b = self.geometry();
        let row = |i: usize| core::array::from_fn(|j| b[(i, j)] as f32);
        Airframe {
            mass_kg: self.mass_kg as f32,
            inertia_kg_m2: vector(self.inertia_kg_m2),
            rotor_inertia_kg_m2: self.rotor_inertia_kg_m2 as f32,
            drag_n_s_m: vector(self.drag_n_s_m),
            rotational_drag_n_m_s2: vector(self.rotational_drag_n_m_s2),
            gravity_m_s2: self.gravity_m_s2 as f32,
            omega_max_rad_s: self.omega_max() as f32,
            rotor_lag_s: self.rotor_lag_s as f32,
            spin_up_reaction: self.spin_up_reaction,
            geometry: RotorGeometry { thrust: row(0), roll: row(1), pitch: row(2), yaw: row(3) },
        }
    }
}
