//! Why a value does not fit the type that it is read as: what serde says, put as we put it.

use std::fmt::{self, Display};

use serde::de::{Error, Expected, Unexpected};
use toml::Value;

use super::{Refusal, nearest};
use crate::words::{as_pilots_say, counted};

/// As many keys are listed; of a table that has more, the documentation tells.
const LISTED: usize = 16;

/// Why a value does not fit, and where it stands.
#[derive(Debug)]
pub(super) struct Misfit {
    /// The keys that lead to it, the last first.
    keys: Vec<String>,
    reason: Reason,
}

#[derive(Debug)]
enum Reason {
    Missing(&'static str),
    UnknownKey(String, &'static [&'static str]),
    UnknownChoice(String, &'static [&'static str]),
    /// A kind by its name alone, and the keys that it has.
    BareKind(String, &'static [&'static str]),
    /// What was given in place of a table, and the keys that it has.
    NoTable(String, &'static [&'static str]),
    /// What it must be, and what was given; without that, whoever has the file looks it up.
    Kind {
        expected: String,
        given: Option<String>,
    },
    Length {
        expected: String,
        count: usize,
    },
    Rule(&'static str),
    /// A refusal of ours on its way through serde, or what only serde can tell.
    Text(String),
}

impl From<Reason> for Misfit {
    fn from(reason: Reason) -> Self {
        Self { keys: Vec::new(), reason }
    }
}

impl Misfit {
    /// A rule that the value breaks.
    pub(super) fn rule(rule: &'static str) -> Self {
        Reason::Rule(rule).into()
    }

    /// A kind by its name alone, which has these keys.
    pub(super) fn bare_kind(name: String, keys: &'static [&'static str]) -> Self {
        Reason::BareKind(name, keys).into()
    }

    /// A value in place of a table that has these keys.
    pub(super) fn no_table(value: &Value, keys: &'static [&'static str]) -> Self {
        Reason::NoTable(in_words(value), keys).into()
    }

    /// A value of another kind than `expected`.
    pub(super) fn wrong_kind(value: &Value, expected: &str) -> Self {
        Reason::Kind { expected: expected.to_owned(), given: Some(in_words(value)) }.into()
    }

    /// The same, of a value that stands at `key`.
    pub(super) fn below(mut self, key: String) -> Self {
        self.keys.push(key);
        self
    }
}

impl Error for Misfit {
    fn custom<T: Display>(message: T) -> Self {
        Reason::Text(message.to_string()).into()
    }

    fn invalid_type(unexpected: Unexpected, expected: &dyn Expected) -> Self {
        Reason::Kind { expected: plain(&expected.to_string()), given: given(unexpected) }.into()
    }

    fn invalid_value(unexpected: Unexpected, expected: &dyn Expected) -> Self {
        Self::invalid_type(unexpected, expected)
    }

    fn invalid_length(count: usize, expected: &dyn Expected) -> Self {
        Reason::Length { expected: expected.to_string(), count }.into()
    }

    fn unknown_variant(name: &str, known: &'static [&'static str]) -> Self {
        Reason::UnknownChoice(name.to_owned(), known).into()
    }

    fn unknown_field(name: &str, known: &'static [&'static str]) -> Self {
        Reason::UnknownKey(name.to_owned(), known).into()
    }

    fn missing_field(name: &'static str) -> Self {
        Reason::Missing(name).into()
    }
}

impl Display for Misfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        refusal(&self.path(), &self.reason).fmt(f)
    }
}

impl std::error::Error for Misfit {}

impl From<Misfit> for Refusal {
    fn from(misfit: Misfit) -> Self {
        refusal(&misfit.path(), &misfit.reason)
    }
}

impl Misfit {
    /// `control.x.lambda`, `fault.0.from_s`.
    fn path(&self) -> String {
        self.keys.iter().rev().map(String::as_str).collect::<Vec<_>>().join(".")
    }
}

fn refusal(path: &str, reason: &Reason) -> Refusal {
    match reason {
        Reason::Missing(name) => Refusal::new(below(path, name), "is missing").remedy(format!("add `{name} = …`")),
        Reason::UnknownKey(name, known) => unknown_key(path, name, known),
        Reason::UnknownChoice(name, known) => unknown_choice(path, name, known),
        Reason::BareKind(name, keys) => {
            let given = format!("{name:?}");
            no_table(path, given, &format!("{{{name}={}}}", form(keys)))
        }
        Reason::NoTable(given, keys) => no_table(path, given.clone(), &form(keys)),
        Reason::Kind { expected, given } => {
            let refusal = Refusal::new(path, format!("must be {expected}"));
            let refusal = given.iter().fold(refusal, Refusal::given);
            // `[push]` of what there may be several of.
            let is_single = expected == "an array" && given.as_deref() == Some("a table");
            if is_single { refusal.remedy(format!("write it as `[[{path}]]`, one for each")) } else { refusal }
        }
        Reason::Length { expected, count } => match expected.strip_prefix(ARRAY) {
            Some(right) => Refusal::new(path, format!("must have {}", values(right))).given(count),
            None => Refusal::new(path, format!("has too many values, {count}")),
        },
        Reason::Rule(rule) => Refusal::new(path, *rule),
        Reason::Text(text) => ours(path, text.trim()),
    }
}

/// A refusal of ours whose key is below this one, or written in full; another text as it is.
fn ours(path: &str, text: &str) -> Refusal {
    match text.strip_prefix('`').and_then(|rest| rest.split_once('`')) {
        Some((key, rule)) => Refusal::new(in_full(path, key), in_full_within(path, rule.trim())),
        None => Refusal::new(path, format!(": {}", text.replace('\n', " "))),
    }
}

fn below(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}

/// A path without the indices of arrays.
fn names(path: &str) -> String {
    let is_name = |part: &&str| !part.bytes().all(|byte| byte.is_ascii_digit());
    path.split('.').filter(is_name).collect::<Vec<_>>().join(".")
}

/// A rule that names another key of the same table, with that in full.
fn in_full_within(path: &str, rule: &str) -> String {
    if path.is_empty() { rule.to_owned() } else { rule.replace(&format!("`{}.", names(path)), &format!("`{path}.")) }
}

/// A key that may be relative to `path`, or begin with it (without indices of arrays), in full.
fn in_full(path: &str, key: &str) -> String {
    let names = names(path);
    // The key itself, of a table that is read by hand.
    if key == names {
        return path.to_owned();
    }
    let relative = key.strip_prefix(&names).and_then(|rest| rest.strip_prefix('.')).unwrap_or(key);
    below(path, relative)
}

pub(super) fn unknown_key(path: &str, name: &str, known: &[&str]) -> Refusal {
    let by_its_letter = by_its_letter(name, known).map(str::to_owned).or_else(|| elsewhere(name, known));
    let near = || nearest(name, known.iter().copied()).map(|near| format!("did you mean `{near}`?"));
    let remedy = match by_its_letter.or_else(near) {
        Some(remedy) => remedy,
        None if known.is_empty() => "it has no keys".to_owned(),
        None if known.len() > LISTED => "docs/simulation.md lists the keys".to_owned(),
        None => format!("use {}", known.join(", ")),
    };
    Refusal::new(below(path, name), "is no key").remedy(remedy)
}

/// What the paper has a letter for, as a table has it that is an axis' gains, or that has the axes.
fn by_its_letter(name: &str, known: &[&str]) -> Option<&'static str> {
    let is_axis = known.contains(&"gain") && known.contains(&"reaching");
    let has_axes = known.contains(&"roll") && known.contains(&"z");
    match name {
        "phi" | "φ" if has_axes => Some("the paper's φ is `roll`"),
        "theta" | "θ" if has_axes => Some("the paper's θ is `pitch`"),
        "psi" | "ψ" if has_axes => Some("the paper's ψ is `yaw`"),
        "altitude" | "height" if has_axes => Some("the altitude is `z`"),
        "K" | "k" if is_axis => Some("the paper's K is `gain`"),
        "λ" if is_axis => Some("the paper's λ is `lambda`"),
        "rho" | "ρ" if is_axis => Some("the paper's ρ stands inside `reaching`, as in reaching={tanh={rho=…}}"),
        _ => None,
    }
}

/// Keys of `control` besides the axes, and those of an axis: documents name them alone.
const OF_CONTROL: [&str; 6] = [
    "tilt_max_rad",
    "rotor_time_constant_s",
    "attitude_form",
    "attitude_observer",
    "position_observer",
    "effectiveness_rate",
];
const AXES: [&str; 6] = ["roll", "pitch", "yaw", "x", "y", "z"];
const OF_AN_AXIS: [&str; 6] = ["lambda", "gain", "reaching", "surface", "approach_max", "braking"];

/// Where a key stands that was given in another place.
fn elsewhere(name: &str, known: &[&str]) -> Option<String> {
    let (at_the_top, has_axes) = (known.contains(&"control"), known.contains(&"roll") && known.contains(&"z"));
    match name {
        "actuation_delay_s" if known.contains(&"mass_factor") => {
            Some("it stands at the top, outside of `truth`: the firmware is never told of it".to_owned())
        }
        // Of letters alone it is most like the latitude.
        "altitude_m" | "altitude" if known.contains(&"latitude_deg") => {
            Some("the place's height is `height_m`; the air's density goes by `world.altitude_m`".to_owned())
        }
        _ if at_the_top && AXES.contains(&name) => {
            Some(format!("gains stand below `control`, as in control.{name}.lambda"))
        }
        _ if at_the_top && OF_CONTROL.contains(&name) => Some(format!("it stands below `control`: control.{name}")),
        _ if (at_the_top || has_axes) && OF_AN_AXIS.contains(&name) => {
            Some(format!("each axis has its own, as in control.x.{name}"))
        }
        _ => None,
    }
}

/// A table with these keys, to be filled in.
fn form(keys: &[&str]) -> String {
    let keys: Vec<String> = keys.iter().map(|key| format!("{key}=…")).collect();
    format!("{{{}}}", keys.join(","))
}

fn no_table(path: &str, given: String, form: &str) -> Refusal {
    let remedy = format!("write {form} in its place, and all of a --set in quotes: --set '…={form}'");
    Refusal::new(path, "must be a table").given(given).remedy(remedy)
}

/// A value, short.
fn in_words(value: &Value) -> String {
    match value {
        Value::Table(_) => "a table".to_owned(),
        Value::Array(_) => "an array".to_owned(),
        other => other.to_string(),
    }
}

fn unknown_choice(path: &str, name: &str, known: &[&str]) -> Refusal {
    let refusal = Refusal::new(path, format!("must be one of {}", known.join(", "))).given(format!("`{name}`"));
    let pilots = as_pilots_say(name).filter(|word| known.contains(word));
    match pilots.or_else(|| nearest(name, known.iter().copied())) {
        Some(near) => refusal.remedy(format!("did you mean `{near}`?")),
        None => refusal,
    }
}

/// What serde expected, in plain words.
fn plain(expected: &str) -> String {
    match expected {
        "f32" | "f64" => "a number".to_owned(),
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number from 0 up".to_owned(),
        "i8" | "i16" | "i32" | "i64" => "a whole number".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "a string" => "text in quotes".to_owned(),
        "a sequence" => "an array".to_owned(),
        "a map" => "a table".to_owned(),
        other if other.starts_with("struct ") || other.starts_with("internally tagged") => "a table".to_owned(),
        other if other.contains("enum") || other.contains("variant") => "the name of one, or a table of one".to_owned(),
        other => array(other).unwrap_or_else(|| other.replace('\n', " ")),
    }
}

/// How serde begins what it expects of an array.
const ARRAY: &str = "an array of length ";

/// "an array of length 3" in plain words.
fn array(expected: &str) -> Option<String> {
    Some(format!("an array of {}", values(expected.strip_prefix(ARRAY)?)))
}

fn values(count: &str) -> String {
    count.parse().map_or_else(|_| count.to_owned(), |count: usize| counted(count, "value"))
}

/// The value that was given; none where serde knows only that it was a name.
fn given(unexpected: Unexpected) -> Option<String> {
    Some(match unexpected {
        Unexpected::UnitVariant => return None,
        Unexpected::Bool(value) => value.to_string(),
        Unexpected::Signed(number) => number.to_string(),
        Unexpected::Unsigned(number) => number.to_string(),
        Unexpected::Float(number) => format!("{number:?}"),
        Unexpected::Str(text) => format!("{text:?}"),
        Unexpected::Map => "a table".to_owned(),
        Unexpected::Seq => "an array".to_owned(),
        other => other.to_string(),
    })
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::super::typed;
    use super::*;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Outer {
        #[allow(dead_code, reason = "read by serde alone")]
        inner: Vec<Inner>,
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields, rename_all = "kebab-case")]
    #[allow(dead_code, reason = "read by serde alone")]
    enum Inner {
        Point { place_m: [f64; 3], count: u32, is_there: bool },
        Nothing,
    }

    fn refused(text: &str) -> String {
        typed::<Outer>(text.parse().expect("TOML")).expect_err("refused").to_string()
    }

    #[test]
    fn serdes_errors_are_put_with_the_whole_key_the_value_and_a_remedy() {
        let point = |rest: &str| format!("inner = [\"nothing\", {{ point = {{ {rest} }} }}]");
        for (text, expected) in [
            (String::new(), "`inner` is missing: add `inner = …`"),
            ("iner = []".to_owned(), "`iner` is no key: did you mean `inner`?"),
            ("colour = []".to_owned(), "`colour` is no key: use inner"),
            ("inner = 3".to_owned(), "`inner` must be an array, not 3"),
            (
                "inner = [\"pint\"]".to_owned(),
                "`inner.0` must be one of point, nothing, not `pint`: did you mean `point`?",
            ),
            (point("count = 1, is_there = true"), "`inner.1.point.place_m` is missing: add `place_m = …`"),
            (point("count = -1"), "`inner.1.point.count` must be a whole number from 0 up, not -1"),
            (point("is_there = \"yes\""), "`inner.1.point.is_there` must be true or false, not \"yes\""),
            (point("place_m = [1.0, 2.0]"), "`inner.1.point.place_m` must have 3 values, not 2"),
            (point("place_m = [1.0, 2.0, 3.0, 4.0]"), "`inner.1.point.place_m` has too many values, 4"),
            (point("place_m = [1.0, \"b\", 3.0]"), "`inner.1.point.place_m.1` must be a number, not \"b\""),
            (
                "inner = [\"point\"]".to_owned(),
                "`inner.0` must be a table, not \"point\": write {point={place_m=…,count=…,is_there=…}} in its place, and all of a --set in quotes: --set '…={point={place_m=…,count=…,is_there=…}}'",
            ),
            (
                "inner = [{ point = 0.5 }]".to_owned(),
                "`inner.0.point` must be a table, not 0.5: write {place_m=…,count=…,is_there=…} in its place, and all of a --set in quotes: --set '…={place_m=…,count=…,is_there=…}'",
            ),
            ("inner = [{}]".to_owned(), "`inner.0` must name a kind, not {}"),
            (
                "inner = [{ point = {}, nothing = {} }]".to_owned(),
                "`inner.0` must be one kind alone: keep one of its tables",
            ),
            (point("place_m = { x = 1.0 }"), "`inner.1.point.place_m` must be an array of 3 values, not a table"),
        ] {
            assert_eq!(refused(&text), expected, "{text}");
        }
    }

    #[test]
    fn a_refusal_that_has_come_through_serde_keeps_its_key() {
        let text = |path, message: &str| refusal(path, &Reason::Text(message.to_owned())).to_string();
        assert_eq!(
            text("control.x", "`answer_s` must be above 0, not -1"),
            "`control.x.answer_s` must be above 0, not -1"
        );
        assert_eq!(text("fault.2", "`fault.index` must be 0 to 3"), "`fault.2.index` must be 0 to 3");
        assert_eq!(text("sensors", "`sensors.gnss.delay_s` is long"), "`sensors.gnss.delay_s` is long");
    }
}
