//! Controllers that can be flown, with their gains, as they stand in a tuning file.

use anyhow::{Result, bail};
use firmware::config::FlightConfig;
use serde::{Deserialize, Serialize};

use crate::baseline::geometric::Geometric;
use crate::baseline::indi::Indi;
use crate::baseline::pid::Pid;
use crate::scenario::Control;

/// A controller and its gains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Controller {
    /// The firmware's own: sliding mode on both loops.
    Smc(Control),
    /// The cascade of PX4.
    Pid(Pid),
    /// Geometric tracking on SE(3).
    Geometric(Geometric),
    /// Incremental nonlinear dynamic inversion.
    Indi(Indi),
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
            Self::Pid(_) => "pid",
            Self::Geometric(_) => "geometric",
            Self::Indi(_) => "indi",
        }
    }

    /// Refuses gains with which its laws are not defined; the firmware refuses those of its own.
    ///
    /// # Errors
    /// The first key that is out of its range.
    pub fn validate(&self) -> Result<()> {
        match self {
            Self::Smc(_) => Ok(()),
            Self::Pid(gains) => gains.validate(),
            Self::Geometric(gains) => gains.validate(),
            Self::Indi(gains) => gains.validate(),
        }
    }

    /// Refuses every controller but the firmware's own, for `what` flies nothing else.
    ///
    /// # Errors
    /// What flies, and what to do about it.
    pub fn require_smc(&self, what: &str) -> Result<()> {
        match self {
            Self::Smc(_) => Ok(()),
            other => bail!("{what} flies the firmware's own `smc` alone, not `{}`: change `tuning`", other.name()),
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
            Self::Pid(Pid { tilt_max_rad, .. })
            | Self::Geometric(Geometric { tilt_max_rad, .. })
            | Self::Indi(Indi { tilt_max_rad, .. }) => {
                config.tilt_max_rad = *tilt_max_rad;
                config.rotor_time_constant_s = 0.0;
            }
        }
    }
}
