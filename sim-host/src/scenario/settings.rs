//! `--set KEY=VALUE`: a dotted key of a table, with indices for arrays (`fault.0.from_s`), and its value as TOML has it.

use anyhow::{Context, Error, Result, bail};
use toml::{Table, Value};

use crate::controller::Controller;
use crate::refusal::Refusal;
use crate::sensors::suite;

/// A setting, as it was given and as it is read.
#[derive(Clone, Debug)]
pub(super) struct Setting<'a> {
    /// As it was given.
    pub(super) text: &'a str,
    /// The dotted key.
    pub(super) key: &'a str,
    /// The value.
    pub(super) value: Value,
}

impl<'a> Setting<'a> {
    /// Of `KEY=VALUE`.
    pub(super) fn parse(text: &'a str) -> Result<Self> {
        let (key, given) = text.split_once('=').with_context(|| format!("--set {text}: use KEY=VALUE"))?;
        let key = key.trim();
        if key.split('.').any(str::is_empty) {
            bail!("--set {text}: a part of the key is missing: use KEY=VALUE, as in control.x.lambda=3");
        }
        if given.trim().is_empty() {
            bail!("--set {text}: the value is missing: use KEY=VALUE");
        }
        let value = value(given);
        if value.is_str() && given.trim_start().starts_with(['{', '[']) {
            bail!("--set {text}: not a TOML value: look at brackets, commas and quotes (names are quoted: \"sgn\")");
        }
        Ok(Self { text, key, value })
    }

    /// What the key begins with, and the rest after the dot.
    pub(super) fn split(&self) -> (&'a str, Option<&'a str>) {
        self.key.split_once('.').map_or((self.key, None), |(first, rest)| (first, Some(rest)))
    }

    /// Whether it sets gains.
    pub(super) fn is_of_gains(&self) -> bool {
        let (first, _) = self.split();
        first == "control" || Controller::NAMES.contains(&first)
    }

    /// Sets `key`, which is this setting's own or another for it, in a table.
    pub(super) fn apply(&self, table: &mut Table, key: &str) -> Result<()> {
        set(table, key, self.value.clone()).with_context(|| format!("--set {}", self.text))
    }
}

/// Whether a dotted key is another, or below it.
pub(crate) fn is_within(key: &str, other: &str) -> bool {
    key.strip_prefix(other).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// Whether a `KEY=VALUE` sets a gain, or the file of gains.
pub(crate) fn is_of_controller(text: &str) -> bool {
    Setting::parse(text).is_ok_and(|setting| setting.is_of_gains() || setting.split().0 == "tuning")
}

/// The names of files in a scenario's table, each of which may be built in, and their kinds.
pub(super) fn file_names(scenario: &mut Table) -> Vec<(&'static str, &mut String)> {
    let mut names = Vec::new();
    for (key, value) in scenario.iter_mut() {
        match (key.as_str(), value) {
            ("airframe", Value::String(name)) => names.push(("airframe", name)),
            ("tuning", Value::String(name)) => names.push(("tuning", name)),
            ("sensors", sensors) => names.extend(suite::file_names(sensors)),
            _ => {}
        }
    }
    names
}

/// A `KEY=VALUE` with other names of the files that it names: `rename` is given the kind and the name of each.
pub(crate) fn with_files(text: &str, mut rename: impl FnMut(&'static str, &str) -> Result<String>) -> Result<String> {
    let (mut table, key) = (Table::new(), text.split('=').next().unwrap_or(text).trim());
    // What is no setting is refused when a scenario is loaded with it.
    let is_set = Setting::parse(text).is_ok_and(|setting| setting.apply(&mut table, key).is_ok());
    let names = file_names(&mut table);
    if !is_set || names.is_empty() {
        return Ok(text.to_owned());
    }
    for (kind, name) in names {
        *name = rename(kind, name)?;
    }
    Ok(match get(&table, key) {
        Some(Value::String(plain)) if value(plain) == Value::String(plain.clone()) => format!("{key}={plain}"),
        Some(other) => format!("{key}={other}"),
        None => text.to_owned(),
    })
}

/// The value at a dotted key of a table.
pub(super) fn get<'a>(table: &'a Table, key: &str) -> Option<&'a Value> {
    let mut parts = key.split('.');
    let first = table.get(parts.next()?)?;
    parts.try_fold(first, |place, part| match place {
        Value::Array(values) => values.get(part.parse::<usize>().ok()?),
        other => other.get(part),
    })
}

/// The same, to be changed.
pub(super) fn get_mut<'a>(table: &'a mut Table, key: &str) -> Option<&'a mut Value> {
    let mut parts = key.split('.');
    let first = table.get_mut(parts.next()?)?;
    parts.try_fold(first, |place, part| match place {
        Value::Array(values) => values.get_mut(part.parse::<usize>().ok()?),
        other => other.get_mut(part),
    })
}

/// A value as TOML has it; what is none, or more than one, is a string.
pub(crate) fn value(text: &str) -> Value {
    let table = format!("value = {text}").parse::<Table>().ok().filter(|table| table.len() == 1);
    table
        .and_then(|mut table| table.remove("value"))
        .or_else(|| large(text))
        .unwrap_or_else(|| Value::String(text.to_owned()))
}

/// A whole number that is larger than TOML's are.
fn large(text: &str) -> Option<Value> {
    let digits = text.trim().trim_start_matches(['+', '-']);
    let is_whole = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    text.trim().parse().ok().filter(|_| is_whole).map(Value::Float)
}

/// Sets a dotted key; tables that are not there are made.
fn set(table: &mut Table, key: &str, value: Value) -> Result<()> {
    let Some((path, last)) = key.rsplit_once('.') else {
        table.insert(key.to_owned(), value);
        return Ok(());
    };
    match descend(table, path, last)? {
        Value::Table(table) => drop(table.insert(last.to_owned(), value)),
        Value::Array(values) => *entry(values, path, last)? = value,
        other => return Err(no_table(path, other).into()),
    }
    Ok(())
}

fn is_index(part: &str) -> bool {
    part.bytes().all(|byte| byte.is_ascii_digit())
}

/// An array that an index is to reach into and that is not there.
fn no_entry(key: &str) -> Error {
    Refusal::new(key, "has no entries").remedy(format!("set it as a whole, as in --set '{key}=[…]'")).into()
}

/// The value at a dotted path; `last` is the key that is set in it.
fn descend<'a>(table: &'a mut Table, path: &str, last: &str) -> Result<&'a mut Value> {
    let parts: Vec<&str> = path.split('.').chain([last]).collect();
    let so_far = |count: usize| parts[..count].join(".");
    let mut place = child(table, parts[0], parts[0], parts[1])?;
    for i in 1..parts.len() - 1 {
        place = match place {
            Value::Table(table) => child(table, &so_far(i + 1), parts[i], parts[i + 1])?,
            Value::Array(values) => entry(values, &so_far(i), parts[i])?,
            other => return Err(no_table(&so_far(i), other).into()),
        };
    }
    Ok(place)
}

/// The value of a table by its name, `key` in full; one that is not there is made, unless `next` is an index into it.
fn child<'a>(table: &'a mut Table, key: &str, name: &str, next: &str) -> Result<&'a mut Value> {
    if !table.contains_key(name) && is_index(next) {
        return Err(no_entry(key));
    }
    Ok(table.entry(name).or_insert_with(|| Value::Table(Table::new())))
}

fn no_table(key: &str, value: &Value) -> Refusal {
    Refusal::new(key, format!("is {value}, and no table: it has no keys below it"))
}

/// An entry of an array, by its index from 0.
fn entry<'a>(values: &'a mut [Value], key: &str, index: &str) -> Result<&'a mut Value> {
    let count = values.len();
    let entry = index.parse::<usize>().ok().and_then(|index| values.get_mut(index));
    entry.with_context(|| match count {
        0 => format!("`{key}.{index}` is not there: `{key}` is empty"),
        count => format!("`{key}.{index}` is not there: `{key}` has the entries 0 to {}", count - 1),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_lead_through_tables_and_arrays() {
        let mut table: Table = "a = [{ b = [1.0, 2.0] }]\nc = 3".parse().expect("TOML");
        for (key, given) in [("a.0.b.1", "5"), ("d.e", "true"), ("c", "x")] {
            set(&mut table, key, value(given)).expect(key);
        }
        assert_eq!(table, "a = [{ b = [1.0, 5] }]\nc = 'x'\nd.e = true".parse().expect("TOML"));
    }

    #[test]
    fn what_is_no_value_of_toml_is_a_string_or_a_large_number() {
        assert_eq!(value("3\nother = 4"), Value::String("3\nother = 4".to_owned()), "nothing is dropped");
        assert_eq!(value("[1,\n2]"), Value::Array(vec![1.into(), 2.into()]));
        assert_eq!(value("-99999999999999999999"), Value::Float(-1e20));
    }

    #[test]
    fn the_files_that_a_setting_names_can_be_renamed() {
        let renamed = |text: &str| with_files(text, |kind, name| Ok(format!("{kind}/{name}"))).expect("renamed");
        for (setting, expected) in [
            ("airframe=a.toml", "airframe=airframe/a.toml"),
            ("sensors=\"s.toml\"", "sensors=suite/s.toml"),
            ("sensors.suite = \"s.toml\"", "sensors.suite=suite/s.toml"),
            ("sensors.gnss.part=p.toml", "sensors.gnss.part=part/p.toml"),
            ("sensors.gnss={part=\"p.toml\",delay_s=0.1}", "sensors.gnss={ delay_s = 0.1, part = \"part/p.toml\" }"),
            ("sensors.gnss.delay_s = 0.1", "sensors.gnss.delay_s = 0.1"),
            ("fault.0.x=1", "fault.0.x=1"),
            ("airframe", "airframe"),
        ] {
            assert_eq!(renamed(setting), expected);
        }
    }

    #[test]
    fn what_leads_nowhere_is_refused_by_its_place() {
        let refusal = |text: &str| {
            let mut table: Table = "a = [{ b = [1.0, 2.0] }]\nc = 3\nf = []".parse().expect("TOML");
            let setting = Setting::parse(text);
            let error = setting.and_then(|setting| setting.apply(&mut table, setting.key)).expect_err("refused");
            format!("{error:#}")
        };
        for (setting, expected) in [
            ("a.1.b=1", "--set a.1.b=1: `a.1` is not there: `a` has the entries 0 to 0"),
            ("a.0.b.2=1", "--set a.0.b.2=1: `a.0.b.2` is not there: `a.0.b` has the entries 0 to 1"),
            ("f.0.x=1", "--set f.0.x=1: `f.0` is not there: `f` is empty"),
            ("g.0.x=1", "--set g.0.x=1: `g` has no entries: set it as a whole, as in --set 'g=[…]'"),
            ("c.x.y=1", "--set c.x.y=1: `c` is 3, and no table: it has no keys below it"),
            ("c=", "--set c=: the value is missing: use KEY=VALUE"),
            ("=3", "--set =3: a part of the key is missing: use KEY=VALUE, as in control.x.lambda=3"),
            ("a..b=3", "--set a..b=3: a part of the key is missing: use KEY=VALUE, as in control.x.lambda=3"),
            ("c", "--set c: use KEY=VALUE"),
        ] {
            assert_eq!(refusal(setting), expected);
        }
    }
}
