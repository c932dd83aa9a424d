//! `[params]`: settings of the firmware by the names that ground stations know, laid over what the scenario says.

use std::collections::BTreeMap;

use anyhow::{Result, ensure};
use firmware::config::FlightConfig;
use firmware::settings::{Class, Domain, Kind, SETTINGS, Settings, Value, find};

use super::Scenario;
use crate::refusal::{Refusal, nearest, within};

/// Values by name.
pub type Params = BTreeMap<String, f64>;

/// Refuses a name that is no setting, and a value that it does not accept.
pub(super) fn validate(params: &Params, config: &FlightConfig) -> Result<()> {
    let mut settings = Settings::of(config);
    for (name, number) in params {
        accept(&settings, name, *number)?;
    }
    // What they come to together: of one alone the others may make another thing.
    let refused = settings.restore_all(params.iter().filter_map(|(name, number)| value_of(name, *number)));
    ensure!(refused == 0, "`params`: the rotors cannot produce thrust and three torques independently");
    Ok(())
}

fn accept(settings: &Settings, name: &str, number: f64) -> Result<()> {
    let (index, value) = value_of(name, number).ok_or_else(|| unknown(name))?;
    let setting = &SETTINGS[index];
    let key = format!("params.{name}");
    if setting.class == Class::ReadOnly && settings.get(index) != Some(value) {
        return Err(Refusal::new(key, "cannot be set: it shows what the vehicle does").into());
    }
    let is_whole = f64::from(value.int()) == number;
    let rule = match setting.domain {
        // As the firmware compares: the f32 nearest to a bound is a value that a ground station may have set.
        Domain::Real(_) if (setting.min().real()..=setting.max().real()).contains(&value.real()) => return Ok(()),
        Domain::Real(_) => return within(&key, number, decimal(setting.min()), decimal(setting.max())),
        Domain::Whole(low, high) if !is_whole || !(low..=high).contains(&value.int()) => {
            format!("must be a whole number from {low} to {high}")
        }
        Domain::OneOf(values) if !is_whole || !values.contains(&value.int()) => {
            let values: Vec<String> = values.iter().map(i32::to_string).collect();
            format!("must be {}", values.join(" or "))
        }
        Domain::Whole(..) | Domain::OneOf(_) => return Ok(()),
    };
    Err(Refusal::new(key, rule).given(number).into())
}

/// A bound as it is written: 0.05, and not the f32 that is nearest to it.
fn decimal(value: Value) -> f64 {
    value.real().to_string().parse().unwrap_or_else(|_| f64::from(value.real()))
}

fn unknown(name: &str) -> anyhow::Error {
    // Names are compared in lower case.
    let known: Vec<String> = SETTINGS.iter().map(|setting| setting.name.to_lowercase()).collect();
    let rule = nearest(name, known.iter().map(String::as_str)).map_or_else(
        || "is no parameter: docs/parameters.md lists them".to_owned(),
        |near| format!("is no parameter: did you mean `{}`?", near.to_uppercase()),
    );
    Refusal::new(format!("params.{name}"), rule).into()
}

/// The setting of a name, and the number as its value.
fn value_of(name: &str, number: f64) -> Option<(usize, Value)> {
    let index = find(name)?;
    let value = match SETTINGS[index].kind() {
        Kind::Int32 => Value::Int(number as i32),
        Kind::Real32 => Value::Real(number as f32),
    };
    Some((index, value))
}

/// Lays values over the settings.
pub(super) fn lay_over(settings: &mut Settings, params: &Params) {
    // Each was accepted before.
    let _ = settings.restore_all(params.iter().filter_map(|(name, number)| value_of(name, *number)));
}

impl Scenario {
    /// The firmware's settings before the flight.
    pub fn settings(&self) -> Settings {
        let mut settings = Settings::of(&self.flight_config());
        lay_over(&mut settings, &self.file.params);
        settings
    }

    /// The same scenario with other settings.
    ///
    /// # Errors
    /// What the firmware refuses of them for this scenario.
    pub fn with_settings(mut self, settings: &Settings) -> Result<Self> {
        let before = self.settings();
        for (index, setting) in SETTINGS.iter().enumerate() {
            if let Some(value) = settings.get(index).filter(|value| before.get(index) != Some(*value)) {
                let number = match value {
                    Value::Int(int) => f64::from(int),
                    Value::Real(real) => f64::from(real),
                };
                self.file.params.insert(setting.name.to_owned(), number);
            }
        }
        self.validate()?;
        Ok(self)
    }
}
