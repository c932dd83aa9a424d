//! Controllers that can be flown, with their gains, as written in a tuning file.

mod smc;

pub use smc::Control;

use anyhow::{Result, bail, ensure};
use firmware::config::FlightConfig;
use glissade_files::refusal::{did_you_mean, typed};
use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use crate::baseline::geometric::Geometric;
use crate::baseline::indi::Indi;
use crate::baseline::pid::Pid;

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

/// A tuning file: a summary and the table of one controller.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Table")]
pub struct TuningFile {
    /// Origin of the gains.
    pub summary: String,
    /// The controller, as a table with its name.
    #[serde(flatten)]
    pub controller: Controller,
}

impl TryFrom<Table> for TuningFile {
    type Error = anyhow::Error;

    // Deserialised by hand, because a flattened enum takes the first known table and silently drops every other key.
    fn try_from(mut table: Table) -> Result<Self> {
        let choices = Controller::NAMES.join(", ");
        let Some(Value::String(summary)) = table.remove("summary") else {
            bail!("`summary` is missing, or no text in quotes: say in a line where the gains come from")
        };
        if let Some(stray) = table.keys().find(|key| !Controller::NAMES.contains(&key.as_str())) {
            let remedy = did_you_mean(stray, &["summary", "smc", "pid", "geometric", "indi"]);
            bail!("`{stray}` is no key of a tuning, which has `summary` and one controller's table: {remedy}");
        }
        ensure!(
            !table.is_empty(),
            "`smc` is missing, and every other controller: give the gains in a table of {choices}"
        );
        if let Some(second) = table.keys().nth(1) {
            bail!("`{second}` is a second controller: keep one table of {choices}");
        }
        let controller = typed(table)?;
        Ok(Self { summary, controller })
    }
}

impl Controller {
    /// The names of all controllers.
    pub const NAMES: [&str; 4] = ["smc", "pid", "geometric", "indi"];

    /// Its name in a file.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Smc(_) => "smc",
            Self::Pid(_) => "pid",
            Self::Geometric(_) => "geometric",
            Self::Indi(_) => "indi",
        }
    }

    /// Checks that its laws are defined for these gains; the firmware refuses those of its own.
    ///
    /// # Errors
    /// The first key that is out of range.
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

    /// Copies the controller's settings into the firmware's configuration.
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

#[cfg(test)]
mod tests {
    use super::*;

    const INDI: &str = include_str!("../../tunings/x500-indi.toml");

    fn refusal(text: &str) -> String {
        let table: Table = text.parse().expect("TOML");
        let error = TuningFile::try_from(table).expect_err("must be refused").to_string();
        assert!(!error.contains('\n'), "{error}");
        error
    }

    #[test]
    fn a_tuning_file_is_a_summary_and_one_controller() {
        let read: TuningFile = toml::from_str(INDI).expect("a tuning");
        let again: TuningFile = toml::from_str(&toml::to_string(&read).expect("TOML")).expect("a tuning");
        assert_eq!((read.controller.name(), &again), ("indi", &read));
    }

    #[test]
    fn what_is_no_part_of_a_tuning_file_is_refused_by_its_key() {
        let second = "\n[smc]\ntilt_max_rad = 1.0\n";
        for (text, culprits) in [
            (format!("colour = 1\n{INDI}"), ["`colour`", "smc, pid, geometric, indi"]),
            (format!("{INDI}\n[lqr]\nq = 1.0\n"), ["`lqr`", "smc, pid, geometric, indi"]),
            (format!("{INDI}{second}"), ["`smc`", "second"]),
            ("summary = \"nothing\"".to_owned(), ["`smc` is missing", "smc, pid, geometric, indi"]),
            (INDI.replace("summary", "sumary"), ["`summary`", "missing"]),
            (INDI.replace("feedback_rate", "feedback_rat"), ["`indi.feedback_rat` is no key", "`feedback_rate`"]),
        ] {
            let error = refusal(&text);
            assert!(culprits.iter().all(|culprit| error.contains(culprit)), "{error}");
        }
    }
}
