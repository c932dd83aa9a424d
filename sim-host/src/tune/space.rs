//! The varied gains, as points of the unit cube.

use std::collections::BTreeSet;

use anyhow::{Context, Result, anyhow, ensure};
use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use crate::controller::{Controller, TuningFile};
use crate::refusal::typed;
use crate::words::significant;

/// Scale of a range.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scale {
    /// Equal steps are equal ratios: for gains and time constants.
    #[default]
    Log,
    /// Equal steps are equal differences.
    Linear,
}

/// One dimension of the search: a number between `low` and `high` that sets one key of the tuning, or several.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameter {
    /// Dotted keys of the tuning file that it sets.
    pub keys: Vec<String>,
    /// Factor for each of the keys; 1 by default.
    pub factors: Option<Vec<f64>>,
    /// Its least value.
    pub low: f64,
    /// Its greatest value.
    pub high: f64,
    /// How the range is divided.
    #[serde(default)]
    pub scale: Scale,
}

/// Significant digits of a gain: the tuning file contains exactly what was flown.
const DIGITS: usize = 4;

impl Parameter {
    /// The value at `x` in 0 ..= 1, to four digits.
    pub fn value(&self, x: f64) -> f64 {
        let value = match self.scale {
            Scale::Log => self.low * libm::pow(self.high / self.low, x),
            Scale::Linear => self.low + (self.high - self.low) * x,
        };
        significant(value, DIGITS)
    }

    /// Its name: the first of its keys.
    pub fn name(&self) -> &str {
        self.keys.first().map_or("", String::as_str)
    }

    /// The keys that it sets, each with its factor.
    fn settings(&self, x: f64) -> impl Iterator<Item = (&str, f64)> {
        let value = self.value(x);
        let factor = |i: usize| self.factors.as_ref().map_or(1.0, |factors| factors[i]);
        self.keys.iter().enumerate().map(move |(i, key)| (key.as_str(), significant(value * factor(i), DIGITS)))
    }

    fn validate(&self) -> Result<()> {
        let name = self.name();
        ensure!(!self.keys.is_empty(), "`parameters.keys` must name a key of the tuning");
        ensure!(
            self.low.is_finite() && self.high.is_finite() && self.low < self.high,
            "parameter `{name}`: `low` must be below `high`, both finite, not {} and {}",
            self.low,
            self.high
        );
        ensure!(
            self.scale == Scale::Linear || self.low > 0.0,
            "parameter `{name}`: `low` must be above zero on a log scale, not {}",
            self.low
        );
        let Some(factors) = &self.factors else { return Ok(()) };
        ensure!(
            factors.len() == self.keys.len() && factors.iter().all(|factor| factor.is_finite()),
            "parameter `{name}`: `factors` must be as many finite numbers as there are `keys`"
        );
        Ok(())
    }
}

/// A tuning file and its varied parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Space {
    base: Table,
    parameters: Vec<Parameter>,
}

impl Space {
    /// The space of `parameters` around the tuning `base`, which was read from `name`.
    ///
    /// # Errors
    /// A base that is no tuning; a parameter without a range, or with a key that the base does not have as a number,
    /// or that another parameter sets too.
    pub fn new(name: &str, base: Table, parameters: Vec<Parameter>) -> Result<Self> {
        ensure!(!parameters.is_empty(), "`parameters` is empty: name what is to be varied");
        let space = Self { base, parameters };
        let context = || format!("tuning `{name}`");
        space.base_controller().with_context(context)?;
        let mut seen = BTreeSet::new();
        for parameter in &space.parameters {
            parameter.validate()?;
            for key in &parameter.keys {
                ensure!(seen.insert(key), "`{key}` is set by two parameters: keep one");
                space.require_variable(key).with_context(context)?;
            }
        }
        Ok(space)
    }

    /// Refuses a key that is not a number, or takes integers only.
    fn require_variable(&self, key: &str) -> Result<()> {
        let mut table = self.base.clone();
        *number(&mut table, key)? = Value::Float(0.5);
        controller(table).map(drop).with_context(|| format!("`{key}` cannot be varied"))
    }

    /// Number of dimensions.
    pub fn dimensions(&self) -> usize {
        self.parameters.len()
    }

    /// What is varied.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// The controller of the base.
    ///
    /// # Errors
    /// A key that the controller does not have, or lacks.
    pub fn base_controller(&self) -> Result<Controller> {
        controller(self.base.clone())
    }

    /// The controller at a point, whose coordinates are in 0 ..= 1.
    ///
    /// # Errors
    /// None for a base that is one.
    pub fn controller(&self, point: &[f64]) -> Result<Controller> {
        controller(self.table(point)?)
    }

    /// The base's controller with one parameter, of number `index`, at `x` in 0 ..= 1 and the others left as they are.
    ///
    /// # Errors
    /// None for a parameter of the space.
    pub fn with_one(&self, index: usize, x: f64) -> Result<Controller> {
        let mut table = self.base.clone();
        self.parameters.iter().skip(index).take(1).try_for_each(|parameter| set(&mut table, parameter, x))?;
        controller(table)
    }

    /// The tuning file at a point, with another summary.
    ///
    /// # Errors
    /// None for a base that is a tuning.
    pub fn tuning(&self, point: &[f64], summary: &str) -> Result<String> {
        let mut table = self.table(point)?;
        table.insert("summary".to_owned(), Value::String(summary.to_owned()));
        toml::to_string(&table).context("the tuning cannot be written as TOML")
    }

    fn table(&self, point: &[f64]) -> Result<Table> {
        let mut table = self.base.clone();
        self.parameters.iter().zip(point).try_for_each(|(parameter, x)| set(&mut table, parameter, *x))?;
        Ok(table)
    }
}

/// Puts a parameter's value at `x` into all its keys.
fn set(table: &mut Table, parameter: &Parameter, x: f64) -> Result<()> {
    parameter.settings(x).try_for_each(|(key, value)| {
        *number(table, key)? = Value::Float(value);
        Ok(())
    })
}

fn controller(table: Table) -> Result<Controller> {
    Ok(typed::<TuningFile>(table)?.controller)
}

/// The number at a dotted key.
fn number<'a>(table: &'a mut Table, key: &str) -> Result<&'a mut Value> {
    let missing = || anyhow!("`{key}` is not there: a parameter varies what the tuning has written down");
    let mut parts = key.split('.');
    let mut place = parts.next().and_then(|part| table.get_mut(part)).ok_or_else(missing)?;
    for part in parts {
        place = place.get_mut(part).ok_or_else(missing)?;
    }
    ensure!(place.is_float() || place.is_integer(), "`{key}` is not a number, so no parameter can vary it");
    Ok(place)
}

#[cfg(test)]
mod tests {
    use super::*;

    const BASE: &str = include_str!("../../tunings/x500-smc.toml");

    fn parameter(keys: &[&str], low: f64, high: f64, scale: Scale) -> Parameter {
        Parameter { keys: keys.iter().map(|key| (*key).to_owned()).collect(), factors: None, low, high, scale }
    }

    fn space(parameters: Vec<Parameter>) -> Result<Space> {
        Space::new("x500-smc", BASE.parse().expect("TOML"), parameters)
    }

    fn smc(space: &Space, point: &[f64]) -> crate::controller::Control {
        match space.controller(point).expect("a controller") {
            Controller::Smc(control) => control,
            other => panic!("{}", other.name()),
        }
    }

    #[test]
    fn the_ends_of_a_range_are_its_bounds_and_its_middle_is_its_mean() {
        let log = parameter(&["smc.x.lambda"], 0.5, 8.0, Scale::Log);
        assert_eq!([0.0, 0.5, 1.0].map(|x| log.value(x)), [0.5, 2.0, 8.0]);
        let linear = parameter(&["smc.x.lambda"], -1.0, 2.0, Scale::Linear);
        assert_eq!([0.0, 0.5, 1.0].map(|x| linear.value(x)), [-1.0, 0.5, 2.0]);
    }

    #[test]
    fn a_parameter_sets_all_its_keys_in_proportion_and_nothing_else() {
        let factors = Some(vec![1.0, 0.5, 0.01]);
        let keys = ["smc.x.lambda", "smc.y.lambda", "smc.x.reaching.implicit-sgn.horizon_s"];
        let space = space(vec![Parameter { factors, ..parameter(&keys, 1.0, 9.0, Scale::Log) }]).expect("valid");
        let (base, set) = (smc(&space, &[]), smc(&space, &[0.5]));
        assert_eq!((set.x.lambda, set.y.lambda), (3.0, 1.5));
        assert_eq!(set.x.reaching, firmware::control::sliding::ReachingLaw::ImplicitSgn { horizon_s: 0.03 });
        assert_eq!((set.z, set.roll, set.tilt_max_rad), (base.z, base.roll, base.tilt_max_rad));
    }

    #[test]
    fn what_is_written_is_what_was_flown() {
        let space = space(vec![parameter(&["smc.x.gain"], 1.0, 30.0, Scale::Log)]).expect("valid");
        for i in 0..20 {
            let point = [f64::from(i) / 19.0];
            let text = space.tuning(&point, "of a test").expect("TOML");
            let read: TuningFile = toml::from_str(&text).expect("a tuning");
            assert_eq!(read.summary, "of a test");
            assert_eq!(read.controller, space.controller(&point).expect("a controller"));
        }
    }

    #[test]
    fn what_cannot_be_varied_is_refused_by_its_key() {
        let log = |keys: &[&str], low, high| parameter(keys, low, high, Scale::Log);
        let unequal = Parameter { factors: Some(vec![1.0, 2.0]), ..log(&["smc.x.gain"], 1.0, 2.0) };
        for (parameters, culprit) in [
            (vec![], "parameters"),
            (vec![log(&[], 1.0, 2.0)], "parameters.keys"),
            (vec![log(&["smc.x.gian"], 1.0, 2.0)], "smc.x.gian"),
            (vec![log(&["pid.x.gain"], 1.0, 2.0)], "pid.x.gain"),
            (vec![log(&["smc.x.reaching"], 1.0, 2.0)], "smc.x.reaching"),
            (vec![log(&["smc.x.gain.more"], 1.0, 2.0)], "smc.x.gain.more"),
            (vec![log(&["summary"], 1.0, 2.0)], "summary"),
            (vec![log(&["smc.x.gain"], 0.0, 2.0)], "smc.x.gain"),
            (vec![log(&["smc.x.gain"], 2.0, 1.0)], "smc.x.gain"),
            (vec![log(&["smc.x.gain"], 1.0, f64::NAN)], "smc.x.gain"),
            (vec![log(&["smc.x.gain"], 1.0, 2.0), log(&["smc.y.gain", "smc.x.gain"], 1.0, 2.0)], "smc.x.gain"),
            (vec![unequal], "factors"),
        ] {
            let error = format!("{:#}", space(parameters).expect_err(culprit));
            assert!(error.contains(culprit) && !error.contains('\n'), "{error}");
        }
    }
    #[test]
    fn what_counts_takes_no_fraction() {
        let base = include_str!("../../tunings/x500-indi.toml").parse().expect("TOML");
        let ticks = parameter(&["indi.rotor_delay_ticks"], 1.0, 4.0, Scale::Log);
        let error = format!("{:#}", Space::new("x500-indi", base, vec![ticks]).expect_err("ticks are whole"));
        assert!(error.contains("`indi.rotor_delay_ticks` cannot be varied"), "{error}");
    }
}
