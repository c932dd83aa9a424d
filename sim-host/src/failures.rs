//! Failures on command, while flying, in lines of text: with the keys of a scenario's `[[fault]]`, or as PX4 names them.
//! What those of ground stations are is in `sil::failures`.
//!
//! ```text
//! sensor=gnss kind=off                 from now on, or from_s=…
//! gnss off                             the same
//! rotor index=0 effectiveness=0.5      kind=rotor
//! motor off -i 1                       the same of PX4's shell: rotor 1, of which nothing is left
//! gps wrong                            as MAVLink's failure: a jump by 50 m
//! ```

use anyhow::{Context as _, Result, anyhow, bail, ensure};
use firmware::airframe::ROTORS;
use firmware::failure::{Manner, Unit};
use firmware::signals::Tick;
use toml::{Table, Value};

use crate::refusal::did_you_mean as meant;
use crate::sensors::Fault;
use crate::sensors::faults::{KINDS, Sensor, keys, require_known_keys};
use crate::sil::failures::kind;
use crate::words::as_pilots_say;

pub use crate::sil::failures::Equipment;

/// Reads a fault from its words: `KEY=VALUE`, or the name of a sensor or of a kind alone; or as PX4 has it, `motor off
/// -i 1`. Without `from_s` it begins at `now`.
///
/// # Errors
/// In one line, what is wrong with it.
pub fn parse<'a>(words: impl Iterator<Item = &'a str>, now: Tick) -> Result<Fault> {
    let mut words: Vec<&str> = words.collect();
    let instance = take_instance(&mut words)?;
    let of_manner = take_manner(&mut words)?;
    let (bare, words): (Vec<&str>, Vec<&str>) = words.into_iter().partition(|word| is_number(word));
    let mut table = table(&words)?;
    for (key, value) in of_manner {
        table.entry(key).or_insert(value);
    }
    if let Some(instance) = instance {
        number(&mut table, instance)?;
    }
    require_whole(&table, &bare)?;
    // Divided, for a number of three decimals at most.
    table.entry("from_s").or_insert(Value::Float(f64::from(now) / 1e3));
    Fault::try_from(table).map_err(|error| anyhow!("{}", error.replace("`fault.", "`")))
}

/// Reads the name of a sensor, of a rotor (`rotor index=1`, PX4's `motor -i 2`) or of the battery, with PX4's `ok` or
/// without.
///
/// # Errors
/// In one line, what is wrong with it.
pub fn parse_equipment(words: &[&str]) -> Result<Equipment> {
    let mut words: Vec<&str> = words.iter().copied().filter(|word| *word != "ok").collect();
    let instance = take_instance(&mut words)?;
    let index = words.iter().position(|word| word.starts_with("index=")).map(|place| words.remove(place));
    let index = index.map(|word| word["index=".len()..].parse().ok().filter(|index| *index < ROTORS));
    ensure!(index != Some(None), "`index` counts rotors from 0 to {}", ROTORS - 1);
    let rotor = index.flatten().or(instance.map(|instance| usize::from(instance) - 1));
    let [word] = words[..] else {
        bail!("name one thing that is to work again, as in `clear gnss`, `clear motor -i 1`")
    };
    let word = as_pilots_say(word).unwrap_or(word);
    if word == "rotor" {
        return Ok(Equipment::Rotors(rotor));
    }
    ensure!(rotor.is_none_or(|rotor| rotor == 0), "there is one `{word}` alone: leave out its number");
    let names = Sensor::ALL.map(Sensor::name);
    let found = Sensor::ALL.into_iter().find(|sensor| sensor.name() == word).map(Equipment::Sensor);
    found.with_context(|| {
        format!("`{word}` is nothing that fails by itself: {}", meant(word, &[&names[..], &["rotor"]].concat()))
    })
}

/// Whether a word is a number, and not the kind `nan`.
fn is_number(word: &str) -> bool {
    word.parse().is_ok_and(f64::is_finite)
}

/// Takes PX4's `-i N` out of the words.
fn take_instance(words: &mut Vec<&str>) -> Result<Option<u8>> {
    let Some(place) = words.iter().position(|word| *word == "-i") else { return Ok(None) };
    let number = words.get(place + 1).copied().unwrap_or_default();
    let instance = number.parse().ok().filter(|instance| (1..=ROTORS as u8).contains(instance));
    ensure!(instance.is_some(), "`-i` counts from 1 to {ROTORS}, as in `fault motor off -i 1`");
    words.drain(place..place + 2);
    Ok(instance)
}

/// The manners of failures by PX4's words.
const MANNERS: [(&str, Manner); 7] = [
    ("off", Manner::Off),
    ("stuck", Manner::Stuck),
    ("garbage", Manner::Garbage),
    ("wrong", Manner::Wrong),
    ("slow", Manner::Slow),
    ("delayed", Manner::Delayed),
    ("intermittent", Manner::Intermittent),
];

/// Takes PX4's word of a manner out of the words if we have another for it; returns the keys that it stands for, as
/// MAVLink's failure has them.
fn take_manner(words: &mut Vec<&str>) -> Result<Table> {
    let named = |word: &str| MANNERS.iter().find(|(name, _)| *name == word).map(|(_, manner)| *manner);
    let unit = words.iter().find_map(|word| Some((*word, unit(word)?)));
    let manner = words.iter().enumerate().find_map(|(place, word)| Some((place, *word, named(word)?)));
    let (Some((name, unit)), Some((place, word, manner))) = (unit, manner) else { return Ok(Table::new()) };
    let is_ours = unit != Unit::Motor && KINDS.contains(&word);
    let Some(kind) = kind(unit, manner, 0) else {
        let known = MANNERS.iter().filter(|(_, manner)| kind(unit, *manner, 0).is_some());
        let known: Vec<&str> = known.map(|(name, _)| *name).collect();
        ensure!(is_ours, "`{word}` does not go with `{name}`: use {}", known.join(", "));
        return Ok(Table::new());
    };
    let mut keys = Table::try_from(kind)?;
    // Which rotor has to be said.
    keys.remove("index");
    if !is_ours {
        words.remove(place);
    } else if keys.get("kind").and_then(Value::as_str) != Some(word) {
        // `battery off` is the monitor's here.
        keys.clear();
    }
    Ok(keys)
}

/// The unit that a word names.
fn unit(word: &str) -> Option<Unit> {
    Some(match as_pilots_say(word).unwrap_or(word) {
        "gyro" => Unit::Gyro,
        "accel" => Unit::Accel,
        "mag" => Unit::Mag,
        "baro" => Unit::Baro,
        "gnss" => Unit::Gnss,
        "battery" => Unit::Battery,
        "rotor" => Unit::Motor,
        _ => return None,
    })
}

/// Puts an instance, from 1, where the fault has its index. There is one of each sensor.
fn number(table: &mut Table, instance: u8) -> Result<()> {
    let kind = table.get("kind").and_then(Value::as_str).unwrap_or_default();
    if kind == "rotor" {
        insert(table, "index", Value::Integer(i64::from(instance) - 1))
    } else {
        ensure!(instance == 1, "there is one of it alone: leave out `-i {instance}`");
        Ok(())
    }
}

fn table(words: &[&str]) -> Result<Table> {
    let mut table = Table::new();
    for word in words {
        let (key, value) = key_and_value(word)?;
        insert(&mut table, key, value)?;
    }
    Ok(table)
}

fn insert(table: &mut Table, key: &str, value: Value) -> Result<()> {
    let given = plain(&value);
    match table.insert(key.to_owned(), value) {
        Some(before) => bail!("`{key}` is given twice, as `{}` and `{given}`: keep one", plain(&before)),
        None => Ok(()),
    }
}

/// Refuses a fault that lacks a key of its kind, and numbers without one.
fn require_whole(table: &Table, bare: &[&str]) -> Result<()> {
    let is_of_a_sensor = table.contains_key("sensor");
    let kinds = || KINDS.into_iter().filter(|kind| !is_of_a_sensor || !matches!(*kind, "rotor" | "collapse"));
    let kind = table.get("kind").and_then(Value::as_str);
    let Some(kind) = kind else { bail!("say how it fails: kind={}", kinds().collect::<Vec<_>>().join("|")) };
    require_known_keys(table)?;
    let missing: Vec<&str> = needs(kind).filter(|key| !table.contains_key(*key)).collect();
    if kind == "rotor" && missing.contains(&"index") {
        let rest = if missing.len() > 1 { " and how much of it is left" } else { "" };
        bail!("say which rotor (index=0 is rotor 1){rest}: fault rotor index=0 effectiveness=0, or motor off -i 1");
    }
    let with = |value: &str| missing.iter().map(|key| format!("`{key}={value}`")).collect::<Vec<_>>().join(" and ");
    match (bare, missing.as_slice()) {
        ([], []) => Ok(()),
        ([number, ..], []) => bail!("`{number}` is too much: the times are `from_s=` and `to_s=`"),
        ([number], [_]) => bail!("`{number}` has no key: write {}", with(number)),
        _ => bail!("`{kind}` needs {}", with("…")),
    }
}

/// The keys that a kind of fault cannot do without.
fn needs(kind: &str) -> impl Iterator<Item = &'static str> + use<> {
    keys(kind).iter().copied().filter(|key| *key != "direction")
}

/// A word as the key and the value that it stands for.
fn key_and_value(word: &str) -> Result<(&str, Value)> {
    let sensors = Sensor::ALL.map(Sensor::name);
    let is_known = |word: &&str| sensors.contains(word) || KINDS.contains(word);
    let word = as_pilots_say(word).filter(is_known).unwrap_or(word);
    let (key, text) = match word.split_once('=') {
        Some(pair) => pair,
        None if sensors.contains(&word) => ("sensor", word),
        None if KINDS.contains(&word) => ("kind", word),
        None => bail!("`{word}` is no sensor and no kind of fault: {}", meant(word, &[&sensors[..], &KINDS].concat())),
    };
    match key {
        "sensor" if !sensors.contains(&text) => bail!("there is no sensor `{text}`: {}", meant(text, &sensors)),
        "kind" if !KINDS.contains(&text) => bail!("there is no kind of fault `{text}`: {}", meant(text, &KINDS)),
        "sensor" | "kind" => Ok((key, Value::String(text.to_owned()))),
        _ => Ok((key, crate::scenario::value(text))),
    }
}

/// A fault as a line would write it: sensor and kind first, then the other keys.
pub fn describe(fault: &Fault) -> String {
    // What was read from a table can be written into one.
    let mut table = Table::try_from(fault).unwrap_or_default();
    let mut pairs: Vec<_> = ["sensor", "kind"].into_iter().filter_map(|key| table.remove_entry(key)).collect();
    pairs.extend(table);
    let words: Vec<String> = pairs.iter().map(|(key, value)| format!("{key}={}", plain(value))).collect();
    words.join(" ")
}

/// A value without quotes and spaces.
fn plain(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string().replace(' ', ""), str::to_owned)
}

#[cfg(test)]
mod tests;
