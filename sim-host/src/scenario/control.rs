//! Gains of the sliding mode laws, by axis, as they stand in a file.

use firmware::control::attitude::{AttitudeForm, AttitudeGains};
use firmware::control::observer::ObserverGains;
use firmware::control::position::PositionGains;
use firmware::control::sliding::AxisGains;
use serde::{Deserialize, Serialize};

/// Gains, by axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Control {
    /// Greatest tilt that position control asks for, rad.
    pub tilt_max_rad: f32,
    /// Time constant to which the rotors' lag is brought down, s; 0 for none.
    #[serde(default)]
    pub rotor_time_constant_s: f32,
    /// Coordinates of the attitude's surfaces.
    #[serde(default)]
    pub attitude_form: AttitudeForm,
    /// Observer of what turns the vehicle beyond its model, rad/s².
    #[serde(default)]
    pub attitude_observer: ObserverGains,
    /// Observer of what accelerates it beyond its model, m/s².
    #[serde(default)]
    pub position_observer: ObserverGains,
    /// Roll φ.
    pub roll: AxisGains,
    /// Pitch θ.
    pub pitch: AxisGains,
    /// Yaw ψ.
    pub yaw: AxisGains,
    /// x.
    pub x: AxisGains,
    /// y.
    pub y: AxisGains,
    /// z.
    pub z: AxisGains,
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
        PositionGains { axes: [self.x, self.y, self.z], observer: self.position_observer }
    }
}
