//! The world of a scenario: how the plant differs from what the firmware believes, how the flight begins, the air, and
//! what pushes the vehicle.

use nalgebra::{Matrix4, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::{Scenario, ScenarioFile};
use crate::noise::tumble;
use crate::plant::air::{Atmosphere, GroundEffect};
use crate::plant::battery::{Battery, Collapse};
use crate::plant::effects::{Effects, RotorFailure, Supply};
use crate::plant::{Constants, Motion};
use crate::sensors::faults::{Fault, Faults, Kind};
use firmware::airframe::ROTORS;

/// How the plant differs from the airframe file, which the firmware keeps believing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Truth {
    /// The plant's mass in units of the airframe's.
    pub mass_factor: f64,
    /// Each of the plant's moments of inertia in units of the airframe's.
    pub inertia_factor: f64,
    /// What is left of each rotor's thrust, and of its yaw torque: 1 for a sound rotor, 0 for one that is gone.
    pub rotor_effectiveness: [f64; ROTORS],
    /// In place of the airframe's, s.
    pub rotor_lag_s: Option<f64>,
}

impl Default for Truth {
    fn default() -> Self {
        Self { mass_factor: 1.0, inertia_factor: 1.0, rotor_effectiveness: [1.0; ROTORS], rotor_lag_s: None }
    }
}

impl Truth {
    /// The plant's constants, from those of the airframe file.
    pub fn of(&self, believed: &Constants) -> Constants {
        let effective = |column: usize| believed.geometry.column(column) * self.rotor_effectiveness[column];
        Constants {
            mass: believed.mass * self.mass_factor,
            inertia: believed.inertia * self.inertia_factor,
            geometry: Matrix4::from_columns(&core::array::from_fn::<_, ROTORS, _>(effective)),
            rotor_lag: self.rotor_lag_s.unwrap_or(believed.rotor_lag),
            ..believed.clone()
        }
    }
}

/// What of the airframe and of its air is flown with, besides the constants. The figures are the airframe's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct World {
    /// Height of z = 0 above sea level, m: thrust, torque and drag are those of the air up there.
    pub altitude_m: Option<f64>,
    /// Height of the ground, where there is some, m; the start's without it.
    pub ground_height_m: Option<f64>,
    /// Whether rotors lift more close to the ground.
    pub ground_effect: bool,
    /// Whether rotors slow down by `rotor_lag_down_s`.
    pub rotor_lag_down: bool,
}

/// The battery's state at the start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct BatteryStart {
    /// Part of the capacity that is left at the start.
    pub soc: f64,
}

impl Default for BatteryStart {
    fn default() -> Self {
        Self { soc: 1.0 }
    }
}

impl ScenarioFile {
    /// Whether a motion at the start is written down.
    pub(super) fn has_start_motion(&self) -> bool {
        self.start_velocity_m_s.is_some() || self.start_attitude_deg.is_some() || self.start_rates_rad_s.is_some()
    }

    /// Height of the ground where there is some, or would be, m.
    pub fn ground_height_m(&self) -> f64 {
        self.world.ground_height_m.unwrap_or(self.start_position_m[2])
    }

    /// The motion with which a flight under `seed` begins.
    pub fn start_motion(&self, seed: u64) -> Motion {
        let position = Vector3::from(self.start_position_m);
        if let Some(tumble) = &self.tumble {
            return tumble::draw(tumble, position, seed);
        }
        let [roll, pitch, yaw] = self.start_attitude_deg.unwrap_or_default().map(f64::to_radians);
        Motion {
            position,
            velocity: self.start_velocity_m_s.unwrap_or_default().into(),
            attitude: UnitQuaternion::from_euler_angles(roll, pitch, yaw).into_inner(),
            rates: self.start_rates_rad_s.unwrap_or_default().into(),
        }
    }
}

impl Scenario {
    /// What the plant is flown with besides its constants; nothing if it is nothing.
    pub fn effects(&self) -> Option<Effects> {
        let (file, airframe) = (&self.file, &self.airframe);
        let world = file.world;
        let plane = airframe.rotor_height_m;
        let effects = Effects {
            rotor_lag_down: airframe.rotor_lag_down_s.filter(|_| world.rotor_lag_down),
            failures: failures(&file.fault),
            atmosphere: world.altitude_m.map(|altitude| Atmosphere { altitude }),
            ground_effect: airframe
                .rotor_radius_m
                .filter(|_| world.ground_effect)
                .map(|radius| GroundEffect { radius, plane }),
            supply: self.supply(),
        };
        (effects != Effects::default()).then_some(effects)
    }

    fn supply(&self) -> Option<Supply> {
        let (start, pack) = (self.file.battery.as_ref()?, self.airframe.battery?);
        let collapse = |fault: &Fault| match fault.kind {
            Kind::Collapse { factor } => {
                Some(Collapse { from_to: (fault.from_s, fault.to_s.unwrap_or(f64::INFINITY)), factor })
            }
            _ => None,
        };
        Some(Supply {
            battery: Battery::new(pack, start.soc),
            omega_max: self.airframe.omega_max(),
            collapses: self.file.fault.iter().filter_map(collapse).collect(),
        })
    }
}

/// What becomes of the rotors, and when: each time at which a fault of theirs begins or ends.
fn failures(schedule: &[Fault]) -> Vec<RotorFailure> {
    let faults = Faults::new(schedule, 0);
    let of_rotors = schedule.iter().filter(|fault| matches!(fault.kind, Kind::Rotor { .. }));
    let mut times: Vec<f64> = of_rotors.flat_map(|fault| [Some(fault.from_s), fault.to_s]).flatten().collect();
    times.sort_by(f64::total_cmp);
    let at = |at: f64| RotorFailure { at, effectiveness: faults.rotor_effectiveness((at * 1e3).round() as u32) };
    times.into_iter().map(at).collect()
}
