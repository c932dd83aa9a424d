//! Controllers that can be flown, with their gains, as they stand in a tuning file.

use firmware::config::FlightConfig;
use serde::{Deserialize, Serialize};

use crate::scenario::Control;

/// A controller and its gains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Controller {
    /// The firmware's own: sliding mode on both loops.
    Smc(Control),
}

/// A tuning file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TuningFile {
    /// Where the gains come from.
    pub summary: String,
    /// The controller, as a table of its name.
    #[serde(flatten)]
    pub controller: Controller,
}

impl Controller {
    /// Its name in a file.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Smc(_) => "smc",
        }
    }

    /// Puts into a flight's configuration what of the controller the firmware itself is told.
    pub fn configure(&self, config: &mut FlightConfig) {
        match self {
            Self::Smc(control) => {
                config.attitude = control.attitude();
                config.position = control.position();
                config.tilt_max_rad = control.tilt_max_rad;
                config.rotor_time_constant_s = control.rotor_time_constant_s;
            }
        }
    }
}
