//! Failures on command, while flying: from a ground station, as PX4 and MAVSDK name them, and in lines of text, with
//! the keys of a scenario's `[[fault]]`.
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
use firmware::failure::{Failure, Injectable, Manner, Unit};
use firmware::signals::Tick;
use toml::{Table, Value};

use crate::refusal::did_you_mean as meant;
use crate::sensors::faults::{KINDS, Kind, SLOTS, Sensor, keys, require_known_keys};
use crate::sensors::{Fault, Suite};
use crate::words::as_pilots_say;

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

/// What can fail by itself, and be made to work again by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Equipment {
    /// A sensor; with its monitor, the battery itself.
    Sensor(Sensor),
    /// One rotor (from 0), or all.
    Rotors(Option<usize>),
}

impl Equipment {
    /// Reads the name of a sensor, of a rotor (`rotor index=1`, PX4's `motor -i 2`) or of the battery, with PX4's `ok` or
    /// without.
    ///
    /// # Errors
    /// In one line, what is wrong with it.
    pub fn parse(words: &[&str]) -> Result<Self> {
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
            return Ok(Self::Rotors(rotor));
        }
        ensure!(rotor.is_none_or(|rotor| rotor == 0), "there is one `{word}` alone: leave out its number");
        let names = Sensor::ALL.map(Sensor::name);
        let found = Sensor::ALL.into_iter().find(|sensor| sensor.name() == word).map(Self::Sensor);
        found.with_context(|| {
            format!("`{word}` is nothing that fails by itself: {}", meant(word, &[&names[..], &["rotor"]].concat()))
        })
    }

    /// What a failure is of.
    pub fn of(failure: &Failure) -> Self {
        match failure.unit {
            Unit::Motor => Self::Rotors(failure.instance.map(usize::from)),
            unit => Self::Sensor(sensor(unit).unwrap_or(Sensor::Battery)),
        }
    }

    /// Whether a fault, whoever has made it, is of it.
    pub fn has(self, fault: &Fault) -> bool {
        match (self, fault.kind) {
            (Self::Rotors(rotor), Kind::Rotor { index, .. }) => rotor.is_none_or(|rotor| rotor == index),
            (Self::Sensor(sensor), Kind::Collapse { .. }) => sensor == Sensor::Battery,
            (Self::Sensor(sensor), _) => fault.sensor == Some(sensor),
            (Self::Rotors(_), _) => false,
        }
    }

    /// As its faults are called: `rotor 2 (index 1)`.
    pub fn name(self) -> String {
        match self {
            Self::Rotors(Some(index)) => format!("rotor {} (index {index})", index + 1),
            Self::Rotors(None) => "every rotor".to_owned(),
            Self::Sensor(sensor) => sensor.name().to_owned(),
        }
    }
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

/// The failures that a ground station may inject: those of the sensors on board, the rotors and the battery. Empty on
/// ideal state.
pub fn injectable(sensors: Option<&Suite>, has_battery: bool) -> Injectable {
    use Manner::{Delayed, Garbage, Intermittent, Off, Slow, Stuck, Wrong};
    let Some(suite) = sensors else { return Injectable::NONE };
    let readings = [Off, Stuck, Garbage, Delayed, Intermittent];
    let mut injectable = Injectable::NONE
        .with(Unit::Gyro, 1, &[Stuck, Garbage])
        .with(Unit::Accel, 1, &[Stuck, Garbage])
        .with(Unit::Motor, ROTORS as u8, &[Off, Slow]);
    for (sensor, unit) in [(Sensor::Mag, Unit::Mag), (Sensor::Baro, Unit::Baro)] {
        if suite.has(sensor) {
            injectable = injectable.with(unit, 1, &readings);
        }
    }
    if suite.has(Sensor::Gnss) {
        injectable = injectable.with(Unit::Gnss, 1, &[Off, Stuck, Garbage, Wrong, Delayed, Intermittent]);
    }
    if has_battery {
        injectable = injectable.with(Unit::Battery, 1, &[Off]);
    }
    injectable
}

/// The slots of a failure, with the fault in each; `None` ends the slot's fault. Empty for a failure that is not
/// [`injectable`].
pub fn of(failure: &Failure, now: Tick) -> impl Iterator<Item = (usize, Option<Fault>)> + use<> {
    let Failure { unit, manner, instance } = *failure;
    let instances = match (unit, instance) {
        (Unit::Motor, None) => 0..ROTORS,
        (Unit::Motor, Some(motor)) => usize::from(motor)..usize::from(motor) + 1,
        _ => 0..1,
    };
    // The motors' slots are the last.
    let slots = instances.map(move |instance| (unit as usize + instance, instance));
    slots.filter(|(slot, _)| *slot < SLOTS).filter_map(move |(slot, instance)| {
        let fault = match manner {
            Manner::Well => None,
            _ => Some(Fault::starting(sensor(unit), kind(unit, manner, instance)?, now)),
        };
        Some((slot, fault))
    })
}

/// The sensor that fails; `None` for rotors and battery.
fn sensor(unit: Unit) -> Option<Sensor> {
    match unit {
        Unit::Gyro => Some(Sensor::Gyro),
        Unit::Accel => Some(Sensor::Accel),
        Unit::Mag => Some(Sensor::Mag),
        Unit::Baro => Some(Sensor::Baro),
        Unit::Gnss => Some(Sensor::Gnss),
        Unit::Battery | Unit::Motor => None,
    }
}

/// The kind of fault. MAVLink specifies no magnitudes: these are far outside of normal operation.
fn kind(unit: Unit, manner: Manner, instance: usize) -> Option<Kind> {
    /// What is left of an empty battery's voltage, and of a slow rotor's thrust.
    const EMPTY: f64 = 0.85;
    const SLOW: f64 = 0.7;
    Some(match (unit, manner) {
        (Unit::Motor, Manner::Off) => Kind::Rotor { index: instance, effectiveness: 0.0 },
        (Unit::Motor, Manner::Slow) => Kind::Rotor { index: instance, effectiveness: SLOW },
        (Unit::Battery, Manner::Off) => Kind::Collapse { factor: EMPTY },
        (Unit::Motor | Unit::Battery, _) => return None,
        (_, Manner::Stuck) => Kind::Stuck {},
        (_, Manner::Garbage) => Kind::Noise { sigma: garbage(unit) },
        (Unit::Gyro | Unit::Accel, _) => return None,
        (_, Manner::Off) => Kind::Off {},
        (_, Manner::Delayed) => Kind::Delayed { extra_s: 0.5 },
        (_, Manner::Intermittent) => Kind::Loss { probability: 0.7 },
        (Unit::Gnss, Manner::Wrong) => Kind::Glitch { size_m: 50.0, direction: None },
        (_, Manner::Wrong | Manner::Slow | Manner::Well) => return None,
    })
}

/// Standard deviation of a garbage signal, in the sensor's unit.
fn garbage(unit: Unit) -> f64 {
    match unit {
        Unit::Gyro => 1.0,
        Unit::Accel => 10.0,
        Unit::Mag => 50.0,
        Unit::Baro => 1e3,
        _ => 100.0,
    }
}

#[cfg(test)]
mod tests;
