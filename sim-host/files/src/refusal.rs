//! Why a key of a file, or of `--set`, is refused: the dotted key down to the leaf, what it must be, the value given.
//!
//! A check of ours, a type of serde's and the firmware's validation all end in a [`Refusal`], so that each reads alike:
//!
//! ```text
//! `control.x.lambda` must be above 0, not -3
//! ```
//!
//! Which file it is about, and in which line, is added by whoever has read it ([`crate::files::Source`]).

mod misfit;
mod reader;

use std::fmt::{self, Display};

use anyhow::Result;
use firmware::validate::ConfigError;
use serde::de::DeserializeOwned;
use toml::{Table, Value};

use reader::Reader;

/// Why a key is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    key: String,
    /// What it must be, or what is wrong with it.
    rule: String,
    /// The value as it was given, where it is known and the rule does not say it.
    given: Option<String>,
    /// What to do about it, where the rule does not say it.
    remedy: Option<String>,
}

impl Refusal {
    /// A key that breaks a rule: "must be above 0", "is missing".
    pub fn new(key: impl Into<String>, rule: impl Into<String>) -> Self {
        Self { key: key.into(), rule: rule.into(), given: None, remedy: None }
    }

    /// With the value that was given.
    #[must_use]
    pub fn given(mut self, value: impl Display) -> Self {
        self.given = Some(short(&value.to_string()));
        self
    }

    /// With what to do about it.
    #[must_use]
    pub fn remedy(mut self, remedy: impl Into<String>) -> Self {
        self.remedy = Some(remedy.into());
        self
    }

    /// The dotted key.
    pub fn key(&self) -> &str {
        &self.key
    }

    /// A key that a table does not have, which has the `known` ones: the one that may have been meant, or all of them.
    pub fn unknown_key(name: &str, known: &[&str]) -> Self {
        misfit::unknown_key("", name, known)
    }

    /// Whether a rule of values was broken and nobody has said yet by which, as the file has it: what is larger than an
    /// f32 arrives as infinite.
    pub fn lacks_value(&self) -> bool {
        match self.given.as_deref() {
            None => self.rule.starts_with("must ") && !self.rule.contains(", not "),
            Some(given) => matches!(given, "inf" | "-inf"),
        }
    }

    /// Whether the key is not there.
    pub fn is_missing(&self) -> bool {
        self.rule == "is missing"
    }

    /// An error about a table at `group`: a refusal's key is put below it, any other is told where it is.
    pub fn below(error: anyhow::Error, group: &str) -> anyhow::Error {
        match error.downcast::<Self>() {
            Ok(refusal) => Self { key: format!("{group}.{}", refusal.key), ..refusal }.into(),
            Err(error) => error.context(format!("`{group}`")),
        }
    }

    /// The same by another key, as that of the file in which it stands.
    #[must_use]
    pub fn with_key(mut self, key: String) -> Self {
        self.key = key;
        self
    }
}

impl Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // "`sensors`: unknown suite", and "`duration_s` must be".
        let space = if self.rule.starts_with(':') { "" } else { " " };
        write!(f, "`{}`{space}{}", self.key, self.rule)?;
        if let Some(given) = &self.given {
            write!(f, ", not {given}")?;
        }
        if let Some(remedy) = &self.remedy {
            write!(f, ": {remedy}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Refusal {}

impl From<ConfigError> for Refusal {
    fn from(error: ConfigError) -> Self {
        let (field, rule) = match error {
            ConfigError::NonFinite(field) => (field, "must be a finite number".to_owned()),
            ConfigError::NotPositive(field) => (field, "must be above 0".to_owned()),
            ConfigError::Negative(field) => (field, "must not be below 0".to_owned()),
            ConfigError::OutOfRange { field, low, high } => {
                return Self::new(field.to_string(), range(&field.to_string(), shortest(low), shortest(high)));
            }
            ConfigError::NotBelow(field, limit) => (field, format!("must be below {}", figure(shortest(limit)))),
            ConfigError::SingularGeometry => {
                return Self::new("airframe.rotors", "cannot turn the vehicle about every axis")
                    .remedy("place the rotors apart, two of them spinning each way (`yaw_n_m_s2` of either sign)");
            }
        };
        Self::new(field.to_string(), rule)
    }
}

/// A table as what it describes.
///
/// # Errors
/// The dotted key, what it must be, and what was given.
pub fn typed<T: DeserializeOwned>(table: Table) -> Result<T> {
    T::deserialize(Reader(Value::Table(table))).map_err(|misfit| Refusal::from(misfit).into())
}

/// An f32 as the f64 with the same decimals: 0.05 and not 0.05000000074505806.
pub fn shortest(value: f32) -> f64 {
    value.to_string().parse().unwrap_or(f64::from(value))
}

/// Refuses a value outside `low ..= high`.
///
/// # Errors
/// A [`Refusal`] with the range, its unit after the key's name.
pub fn within<T: Into<f64> + Copy + Display>(key: &str, value: T, low: f64, high: f64) -> Result<()> {
    if (low..=high).contains(&value.into()) {
        return Ok(());
    }
    Err(Refusal::new(key, range(key, low, high)).given(value).into())
}

/// Refuses a value that is not above zero, or too near to it or too far from it for the firmware.
///
/// # Errors
/// A [`Refusal`].
pub fn above_zero(key: &str, value: f64) -> Result<()> {
    /// As large as the firmware's numbers get.
    const LARGEST: f64 = 1e9;
    if value <= 0.0 || value.is_nan() {
        return Err(Refusal::new(key, "must be above 0").given(value).into());
    }
    within(key, value, 1.0 / LARGEST, LARGEST)
}

/// Refuses a time (s) that is not after another, each with its key.
///
/// # Errors
/// A [`Refusal`] of the later one.
pub fn after(from: (&str, f64), to: (&str, f64)) -> Result<()> {
    let ((from_key, from_s), (to_key, to_s)) = (from, to);
    if to_s > from_s {
        return Ok(());
    }
    let rule = format!("must be after `{from_key}`, {} s", figure(from_s));
    let backwards = format!("from {} to {} s runs backwards", figure(from_s), figure(to_s));
    let refusal = Refusal::new(to_key, rule).given(figure(to_s));
    Err(if to_s < from_s { refusal.remedy(backwards) } else { refusal }.into())
}

fn range(key: &str, low: f64, high: f64) -> String {
    format!("must be between {} and {}{}", figure(low), figure(high), unit(key))
}

/// A value as it was given, unless it is a number of so many digits that nobody has written it so.
fn short(text: &str) -> String {
    const LONGEST: usize = 15;
    let number = text.parse::<f64>().ok().filter(|number| number.is_finite() && text.len() > LONGEST);
    number.map_or_else(|| text.replace("NaN", "nan"), figure)
}

/// A number as short as it can be written.
pub fn figure(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) { format!("{value:e}") } else { value.to_string() }
}

/// The unit that a key's name ends with, after a space; nothing for a number without one.
fn unit(key: &str) -> &'static str {
    /// The longest first, where one ends with another.
    const UNITS: [(&str, &str); 20] = [
        ("_n_m_s2", " N m s²"),
        ("_kg_m2", " kg m²"),
        ("_n_s_m", " N s/m"),
        ("_n_s2", " N s²"),
        ("_rad_s2", " rad/s²"),
        ("_rad_s", " rad/s"),
        ("_m_s3", " m/s³"),
        ("_m_s2", " m/s²"),
        ("_m_s", " m/s"),
        ("_1_s", " 1/s"),
        ("_rad", " rad"),
        ("_deg", "°"),
        ("_ohm", " Ω"),
        ("_ah", " Ah"),
        ("_hz", " Hz"),
        ("_kg", " kg"),
        ("_s", " s"),
        ("_m", " m"),
        ("_v", " V"),
        ("_w", " W"),
    ];
    // An index of an array has the unit of its array.
    let is_index = |end: &str| !end.is_empty() && end.bytes().all(|byte| byte.is_ascii_digit());
    let name = key.rsplit_once('.').filter(|(_, end)| is_index(end)).map_or(key, |(array, _)| array);
    UNITS.iter().find(|(suffix, _)| name.ends_with(suffix)).map_or("", |(_, unit)| unit)
}

/// The name most like `name`, if one is so much like it that it may have been meant.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    const LIKE: f64 = 0.8;
    let name = &name.to_lowercase();
    // Short words with one slip are less alike by Jaro and Winkler than they look.
    let one_slip = |candidate: &str| candidate.len() > 2 && strsim::osa_distance(name, candidate) == 1;
    let likeness = |candidate: &str| if one_slip(candidate) { 1.0 } else { strsim::jaro_winkler(name, candidate) };
    let nearest = known.into_iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b)))?;
    (likeness(nearest) > LIKE).then_some(nearest)
}

/// "did you mean `x`?", or what there is.
pub fn did_you_mean(name: &str, known: &[&str]) -> String {
    nearest(name, known.iter().copied())
        .map_or_else(|| format!("use one of {}", known.join(", ")), |nearest| format!("did you mean `{nearest}`?"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use firmware::validate::Field;

    #[test]
    fn a_refusal_names_key_rule_and_value() {
        let text = |result: Result<()>| result.expect_err("refused").to_string();
        assert_eq!(text(within("duration_s", -1.0, 1e-3, 1e6)), "`duration_s` must be between 0.001 and 1e6 s, not -1");
        assert_eq!(text(within("start_m.0", 0.1_f32, 1.0, 2.0)), "`start_m.0` must be between 1 and 2 m, not 0.1");
        assert_eq!(text(within("a", 1e308, 0.0, 1.0)), "`a` must be between 0 and 1, not 1e308");
        assert_eq!(text(within("a", f32::MAX, 0.0, 1.0)), "`a` must be between 0 and 1, not 3.4028235e38");
        assert_eq!(text(above_zero("mass_kg", f64::NAN)), "`mass_kg` must be above 0, not nan");
        assert_eq!(
            text(after(("push.from_s", 5.0), ("push.to_s", 3.0))),
            "`push.to_s` must be after `push.from_s`, 5 s, not 3: from 5 to 3 s runs backwards"
        );
    }

    #[test]
    fn what_the_firmware_refuses_reads_alike() {
        let lambda = Field::of("control.x", "lambda");
        for (error, text) in [
            (ConfigError::NotPositive(lambda), "`control.x.lambda` must be above 0"),
            (
                ConfigError::OutOfRange { field: "modes.climb_m_s".into(), low: 0.05, high: 100.0 },
                "`modes.climb_m_s` must be between 0.05 and 100 m/s",
            ),
            (ConfigError::NotBelow("control.tilt_max_rad".into(), 1.5), "`control.tilt_max_rad` must be below 1.5"),
        ] {
            assert_eq!(Refusal::from(error).to_string(), text);
        }
    }

    #[test]
    fn a_name_is_meant_if_it_is_like_enough() {
        assert_eq!(nearest("helicks", ["hover", "helix", "pad"]), Some("helix"));
        assert_eq!(nearest("lamda", ["gain", "lambda"]), Some("lambda"));
        assert_eq!(nearest("sng", ["sgn", "sat", "tanh"]), Some("sgn"));
        assert_eq!(nearest("mass", ["mass_kg", "summary"]), Some("mass_kg"));
        assert_eq!(nearest("colour", ["control", "summary", "duration_s"]), None);
        assert_eq!(nearest("x", []), None);
    }
}
