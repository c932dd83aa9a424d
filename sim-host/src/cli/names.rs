//! Names that are given where another kind of name is asked for: what each is, and how it is used.

use std::path::Path;

use anyhow::{Result, bail};
use clap::CommandFactory as _;

use super::Cli;
use crate::files::Source;
use crate::matrix::MATRICES;
use crate::scenario::{AIRFRAMES, SCENARIOS, TUNINGS};
use crate::sensors::SUITES;
use crate::tune::TUNES;

/// What a name can be, and how one is used, `NAME` being it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Scenario,
    Command,
    Matrix,
    Tune,
    Tuning,
    Airframe,
    Sensors,
}

impl Kind {
    const ALL: [Self; 7] =
        [Self::Scenario, Self::Command, Self::Matrix, Self::Tune, Self::Tuning, Self::Airframe, Self::Sensors];

    /// Whether it has one of this name.
    fn has(self, name: &str) -> bool {
        let built_in = |files: &[(&str, &str)]| files.iter().any(|(known, _)| *known == name);
        match self {
            Self::Scenario => built_in(&SCENARIOS),
            Self::Matrix => built_in(&MATRICES),
            Self::Tune => built_in(&TUNES),
            Self::Tuning => built_in(&TUNINGS),
            Self::Airframe => built_in(&AIRFRAMES),
            Self::Sensors => built_in(&SUITES),
            Self::Command => Cli::command().get_subcommands().any(|command| command.get_name() == name),
        }
    }

    /// Keys of its files that no other kind's have.
    fn marks(self) -> &'static [&'static str] {
        match self {
            Self::Scenario => &["duration_s"],
            Self::Matrix => &["disturbances", "controllers"],
            Self::Tune => &["parameters", "base"],
            Self::Tuning => &["smc", "pid", "geometric", "indi"],
            Self::Airframe => &["mass_kg", "rotors"],
            Self::Sensors => &["imu", "suite"],
            Self::Command => &[],
        }
    }

    /// The kind, and how one of it is used.
    fn said(self, name: &str) -> String {
        match self {
            Self::Scenario => format!("a scenario: `sim-host run {name}` flies it"),
            Self::Matrix => format!("a matrix: `sim-host compare {name}` flies it"),
            Self::Tune => format!("a tune: `sim-host tune {name} --out DIR` searches"),
            Self::Tuning => format!("a tuning: fly one with `--set tuning={name}`"),
            Self::Airframe => format!("an airframe: fly one with `--set airframe={name}`"),
            Self::Sensors => format!("a suite of sensors: fly one with `--set sensors={name}`"),
            Self::Command => format!("a command: `sim-host {name}`"),
        }
    }
}

/// Refuses a name, or a file, of another kind than the one asked for; one that is of none is left to whoever reads it.
pub(super) fn require(asked: Kind, name: &str) -> Result<()> {
    if asked.has(name) {
        return Ok(());
    }
    let meant = if Path::new(name).exists() { meant_by_file(asked, name) } else { meant(name) };
    match meant {
        Some(meant) => bail!("`{name}` is {meant}"),
        None => Ok(()),
    }
}

/// What a file is by its keys, and how it is used, if it is not of the kind asked for.
fn meant_by_file(asked: Kind, name: &str) -> Option<String> {
    let table = Source::read(name, "file", &[]).and_then(|source| source.table()).ok()?;
    let is = |kind: Kind| kind.marks().iter().any(|mark| table.contains_key(*mark));
    if is(asked) {
        return None;
    }
    // A path that is a name alone would be looked up among the built-in files.
    let path = if name.contains('/') { name.to_owned() } else { format!("./{name}") };
    Kind::ALL.into_iter().find(|kind| is(*kind)).map(|kind| kind.said(&path))
}

/// What a name is, and how it is used: all that it can be.
pub(super) fn meant(name: &str) -> Option<String> {
    let kinds: Vec<String> = Kind::ALL.into_iter().filter(|kind| kind.has(name)).map(|kind| kind.said(name)).collect();
    (!kinds.is_empty()).then(|| kinds.join("; or "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_of_another_kind_is_told_with_all_that_it_can_be() {
        let told = |asked, name| require(asked, name).err().map(|error| error.to_string());
        for (asked, name, expected) in [
            (Kind::Matrix, "x500-step", Some("`x500-step` is a scenario: `sim-host run x500-step` flies it")),
            (Kind::Scenario, "compare", Some("`compare` is a command: `sim-host compare`")),
            (
                Kind::Scenario,
                "x500",
                Some(
                    "`x500` is a matrix: `sim-host compare x500` flies it; or an airframe: fly one with `--set \
                     airframe=x500`",
                ),
            ),
            (
                Kind::Scenario,
                "x500-pid",
                Some(
                    "`x500-pid` is a tune: `sim-host tune x500-pid --out DIR` searches; or a tuning: fly one with `--set \
                     tuning=x500-pid`",
                ),
            ),
            (Kind::Scenario, "gnss", Some("`gnss` is a suite of sensors: fly one with `--set sensors=gnss`")),
            (Kind::Scenario, "helix", None),
            (Kind::Matrix, "x500", None),
            (Kind::Tune, "no-such", None),
        ] {
            assert_eq!(told(asked, name).as_deref(), expected, "{name}");
        }
    }

    #[test]
    fn a_file_of_another_kind_is_told_by_its_keys() {
        for (asked, file, expected) in [
            (Kind::Scenario, "airframes/x500.toml", Some("an airframe: fly one with `--set airframe=")),
            (Kind::Scenario, "tunings/x500-pid.toml", Some("a tuning: fly one with `--set tuning=")),
            (Kind::Scenario, "sensors/rtk.toml", Some("a suite of sensors: fly one with `--set sensors=")),
            (Kind::Scenario, "matrices/x500.toml", Some("a matrix: `sim-host compare ")),
            (Kind::Scenario, "tunes/x500-indi.toml", Some("a tune: `sim-host tune ")),
            (Kind::Matrix, "scenarios/outdoor-hover.toml", Some("a scenario: `sim-host run ")),
            (Kind::Scenario, "scenarios/outdoor-hover.toml", None),
            (Kind::Matrix, "matrices/x500.toml", None),
            (Kind::Tune, "tunes/x500-indi.toml", None),
            (Kind::Scenario, "Cargo.toml", None),
        ] {
            let file = format!("{}/{file}", env!("CARGO_MANIFEST_DIR"));
            let told = require(asked, &file).err().map(|error| error.to_string());
            let expected = expected.map(|kind| format!("`{file}` is {kind}{file}"));
            match (&told, &expected) {
                (Some(told), Some(expected)) => assert!(told.starts_with(expected.as_str()), "{told}"),
                (told, expected) => assert_eq!(told, expected, "{file}"),
            }
        }
    }
}
