//! Gains of the sliding mode laws, by axis, as written in a tuning file: each axis by its gains, or by its bounds
//! ([`AxisBounds`], recognised by `answer_s`), from which the gains are designed.

use firmware::control::attitude::{AttitudeForm, AttitudeGains};
use firmware::control::design::AxisBounds;
use firmware::control::observer::ObserverGains;
use firmware::control::position::PositionGains;
use firmware::control::sliding::AxisGains;
use firmware::validate::ConfigError;
use glissade_files::refusal::{Refusal, typed};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

/// Gains, by axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Control {
    /// Greatest tilt that position control demands, rad.
    pub tilt_max_rad: f32,
    /// Time constant to which lead compensation shortens the rotor lag, s; 0 for none.
    #[serde(default)]
    pub rotor_time_constant_s: f32,
    /// Coordinates of the attitude surfaces.
    #[serde(default)]
    pub attitude_form: AttitudeForm,
    /// Observer of the angular acceleration disturbance, rad/s².
    #[serde(default)]
    pub attitude_observer: ObserverGains,
    /// Observer of the acceleration disturbance, m/s².
    #[serde(default)]
    pub position_observer: ObserverGains,
    /// Rate of adaptation of the thrust effectiveness, 1/s; 0 to disable.
    #[serde(default)]
    pub effectiveness_rate: f32,
    /// Roll φ.
    #[serde(deserialize_with = "axis")]
    pub roll: AxisGains,
    /// Pitch θ.
    #[serde(deserialize_with = "axis")]
    pub pitch: AxisGains,
    /// Yaw ψ.
    #[serde(deserialize_with = "axis")]
    pub yaw: AxisGains,
    /// x.
    #[serde(deserialize_with = "axis")]
    pub x: AxisGains,
    /// y.
    #[serde(deserialize_with = "axis")]
    pub y: AxisGains,
    /// z.
    #[serde(deserialize_with = "axis")]
    pub z: AxisGains,
}

/// An axis by its gains or by its bounds.
fn axis<'de, D: Deserializer<'de>>(deserializer: D) -> Result<AxisGains, D::Error> {
    let table = toml::Table::deserialize(deserializer)?;
    if !table.contains_key("answer_s") {
        return typed(table).map_err(D::Error::custom);
    }
    by_bounds(table).map_err(D::Error::custom)
}

/// An axis by its bounds alone: gains beside them would be overruled.
fn by_bounds(table: toml::Table) -> anyhow::Result<AxisGains> {
    for gain in ["lambda", "gain", "reaching", "approach_max", "braking"] {
        if table.contains_key(gain) {
            let rule = "is no key of an axis that is given by its bounds";
            let remedy =
                "use answer_s, disturbance, disturbance_rate, authority, law, surface, or leave out `answer_s`";
            return Err(Refusal::new(gain, rule).remedy(remedy).into());
        }
    }
    let given = table.clone();
    let bounds: AxisBounds = typed(table)?;
    bounds.gains().map_err(|error| {
        let beyond = matches!(error, ConfigError::NotBelow(..));
        let mut refusal = Refusal::from(error);
        if beyond {
            refusal = refusal.remedy("no law rejects more than its `authority`");
        }
        let value = given.get(refusal.key()).cloned();
        value.map_or(refusal.clone(), |value| refusal.given(value)).into()
    })
}

impl Control {
    /// For the attitude loop.
    pub fn attitude(&self) -> AttitudeGains {
        AttitudeGains {
            axes: [self.roll, self.pitch, self.yaw],
            form: self.attitude_form,
            observer: self.attitude_observer,
        }
    }

    /// For the position loop.
    pub fn position(&self) -> PositionGains {
        PositionGains {
            axes: [self.x, self.y, self.z],
            observer: self.position_observer,
            effectiveness_rate: self.effectiveness_rate,
        }
    }
}
