//! What serde says of a value that does not fit, put as we put it.

use anyhow::Result;
use serde::de::DeserializeOwned;
use serde_path_to_error::{Path, Segment};
use toml::{Table, Value};

use super::{Refusal, nearest};
use crate::words::counted;

/// As many keys are listed; of a table that has more, the documentation tells.
const LISTED: usize = 16;

/// A table as what it describes.
///
/// # Errors
/// The dotted key, what it must be, and what was given.
pub(crate) fn typed<T: DeserializeOwned>(table: Table) -> Result<T> {
    serde_path_to_error::deserialize(Value::Table(table))
        .map_err(|error| refusal(&dotted(error.path()), error.inner().message()).into())
}

/// `control.x.lambda`, `fault.0.from_s`.
fn dotted(path: &Path) -> String {
    let name = |segment: &Segment| match segment {
        Segment::Seq { index } => Some(index.to_string()),
        Segment::Map { key } => Some(key.clone()),
        Segment::Enum { variant } => Some(variant.clone()),
        Segment::Unknown => None,
    };
    path.iter().filter_map(name).collect::<Vec<_>>().join(".")
}

fn below(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}

/// The table in which a key of serde's stands: its path ends with a key that is unknown, and without one that is missing.
fn without<'a>(path: &'a str, key: &str) -> &'a str {
    if path == key { "" } else { path.strip_suffix(key).and_then(|rest| rest.strip_suffix('.')).unwrap_or(path) }
}

/// The first name between backticks, and what follows it.
fn quoted(text: &str) -> Option<(&str, &str)> {
    text.split_once('`')?.1.split_once('`')
}

fn refusal(path: &str, message: &str) -> Refusal {
    let message = message.trim();
    if message.starts_with('`')
        && let Some((key, rule)) = quoted(message)
    {
        // A refusal of ours on its way through serde: its key is below this one, or written in full.
        return Refusal::new(in_full(path, key), in_full_within(path, rule.trim()));
    }
    if let Some((name, _)) = message.strip_prefix("missing field ").and_then(quoted) {
        return Refusal::new(below(path, name), "is missing").remedy(format!("add `{name} = …`"));
    }
    if let Some((name, rest)) = message.strip_prefix("unknown field ").and_then(quoted) {
        return unknown_key(without(path, name), name, &all_quoted(rest));
    }
    if let Some((name, rest)) = message.strip_prefix("unknown variant ").and_then(quoted) {
        return unknown_choice(path, name, &all_quoted(rest));
    }
    for prefix in ["invalid type: ", "invalid value: "] {
        if let Some((given, expected)) = message.strip_prefix(prefix).and_then(|rest| rest.rsplit_once(", expected ")) {
            let refusal = Refusal::new(path, format!("must be {}", plain(expected)));
            // Whoever has the file looks the value up.
            return if given == "unit variant" { refusal } else { refusal.given(unexpected(given)) };
        }
    }
    if let Some(found) = message.strip_prefix("wanted exactly 1 element, ") {
        let several = "must be one kind alone: keep one of its tables";
        return Refusal::new(path, if found.starts_with("more") { several } else { "must name a kind, not {}" });
    }
    if let Some((count, expected)) =
        message.strip_prefix("invalid length ").and_then(|rest| rest.split_once(", expected "))
    {
        return match expected.strip_prefix("an array of length ") {
            Some(right) => Refusal::new(path, format!("must have {}", values(right))).given(count),
            None => Refusal::new(path, format!("has too many values, {count}")),
        };
    }
    Refusal::new(path, format!(": {}", message.replace('\n', " ")))
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

fn all_quoted(mut text: &str) -> Vec<&str> {
    let mut all = Vec::new();
    while let Some((name, rest)) = quoted(text) {
        all.push(name);
        text = rest;
    }
    all
}

fn unknown_key(path: &str, name: &str, known: &[&str]) -> Refusal {
    let remedy = match nearest(name, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None if known.is_empty() => "it has no keys".to_owned(),
        None if known.len() > LISTED => "docs/simulation.md lists the keys".to_owned(),
        None => format!("use {}", known.join(", ")),
    };
    Refusal::new(below(path, name), "is no key").remedy(remedy)
}

fn unknown_choice(path: &str, name: &str, known: &[&str]) -> Refusal {
    let refusal = Refusal::new(path, format!("must be one of {}", known.join(", "))).given(format!("`{name}`"));
    match nearest(name, known.iter().copied()) {
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
        "string only" => "the name of one of its kinds, or a table".to_owned(),
        other if other.starts_with("struct ") || other.starts_with("internally tagged") => "a table".to_owned(),
        other if other.contains("enum") || other.contains("variant") => "the name of one, or a table of one".to_owned(),
        other => array(other).unwrap_or_else(|| other.replace('\n', " ")),
    }
}

/// "an array of length 3" in plain words.
fn array(expected: &str) -> Option<String> {
    Some(format!("an array of {}", values(expected.strip_prefix("an array of length ")?)))
}

fn values(count: &str) -> String {
    count.parse().map_or_else(|_| count.to_owned(), |count: usize| counted(count, "value"))
}

/// The value that serde did not expect: "string \"fast\"", "integer `3`", "map".
fn unexpected(given: &str) -> String {
    match given {
        "map" => "a table".to_owned(),
        "sequence" => "an array".to_owned(),
        other => {
            let value = other.split_once(['`', '"']).map(|(_, value)| value.trim_end_matches(['`', '"']));
            match value {
                Some(value) if other.starts_with("string") => format!("\"{value}\""),
                Some(value) => value.to_owned(),
                None => other.to_owned(),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

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
        let text = |path, message| refusal(path, message).to_string();
        assert_eq!(
            text("control.x", "`answer_s` must be above 0, not -1"),
            "`control.x.answer_s` must be above 0, not -1"
        );
        assert_eq!(text("fault.2", "`fault.index` must be 0 to 3"), "`fault.2.index` must be 0 to 3");
        assert_eq!(text("sensors", "`sensors.gnss.delay_s` is long"), "`sensors.gnss.delay_s` is long");
    }
}
