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

use anyhow::{Result, anyhow, bail, ensure};
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
        None if word == "ok" => bail!("`clear` ends all faults; for one, give it a `to_s=`"),
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

/// Whether a fault, whoever has made it, is of what a failure is of.
pub fn is_of(failure: &Failure, fault: &Fault) -> bool {
    match (failure.unit, fault.kind) {
        (Unit::Motor, Kind::Rotor { index, .. }) => failure.instance.is_none_or(|motor| usize::from(motor) == index),
        (Unit::Battery, Kind::Collapse { .. }) => true,
        (Unit::Motor | Unit::Battery, _) => false,
        (unit, _) => fault.sensor.is_some() && fault.sensor == sensor(unit),
    }
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

/// The unit of a failure, as its faults are called: `rotor 2 (index 1)`.
pub fn unit_name(failure: &Failure) -> String {
    match (failure.unit, failure.instance) {
        (Unit::Motor, Some(index)) => format!("rotor {} (index {index})", index + 1),
        (Unit::Motor, None) => "every rotor".to_owned(),
        (unit, _) => sensor(unit).map_or("battery", Sensor::name).to_owned(),
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
mod tests {
    use super::*;
    use crate::flight;
    use crate::scenario::Scenario;
    use crate::sil::Lockstep as _;

    fn read(line: &str) -> Result<Fault> {
        parse(line.split_whitespace(), 1500)
    }

    fn fault(line: &str) -> Fault {
        read(line).expect(line)
    }

    #[test]
    fn a_sensor_is_offered_no_faults_of_rotors() {
        let offered = |line: &str| parse(line.split_whitespace(), 0).expect_err("no kind").to_string();
        assert!(offered("gnss").ends_with(
            "kind=off|stuck|drift|noise|spikes|delayed|nan|glitch|no-fix|loss|duplicate|disorder|time-jump"
        ));
        assert!(offered("").ends_with("|time-jump|rotor|collapse"));
    }

    #[test]
    fn lines_are_the_faults_of_files_from_now_on() {
        let rotor = fault("kind=rotor index=0 effectiveness=0.5");
        assert_eq!(rotor.kind, Kind::Rotor { index: 0, effectiveness: 0.5 });
        assert_eq!((rotor.from_s, rotor.to_s, rotor.sensor), (1.5, None, None));
        let gnss = fault("  sensor=gnss kind=glitch size_m=50 direction=[1,0,0] from_s=20 to_s=30 ");
        assert_eq!(gnss.kind, Kind::Glitch { size_m: 50.0, direction: Some([1.0, 0.0, 0.0]) });
        assert_eq!((gnss.from_s, gnss.to_s), (20.0, Some(30.0)));
    }

    #[test]
    fn names_alone_are_enough_in_any_order() {
        assert_eq!(fault("gnss off"), fault("sensor=gnss kind=off"));
        assert_eq!(fault("stuck baro"), fault("kind=stuck sensor=baro"));
        assert_eq!(fault("rotor index=1 effectiveness=0"), fault("kind=rotor index=1 effectiveness=0.0"));
    }

    #[test]
    fn motors_fail_as_in_px4() {
        for (number, index) in [(1, 0), (4, 3)] {
            let kind = Kind::Rotor { index, effectiveness: 0.0 };
            assert_eq!(fault(&format!("motor off -i {number}")), Fault::starting(None, kind, 1500));
        }
        assert_eq!(fault("motor off index=2"), fault("rotor index=2 effectiveness=0"));
        assert_eq!(fault("gps off -i 1"), fault("gnss off"));
        assert_eq!(fault("mag stuck"), fault("sensor=mag kind=stuck"));
    }

    #[test]
    fn other_units_fail_as_mavlink_has_it() {
        for (px4, ours) in [
            ("motor slow -i 1", "rotor index=0 effectiveness=0.7"),
            ("gps wrong", "gnss glitch size_m=50"),
            ("gps wrong size_m=20 to_s=30", "gnss glitch size_m=20 to_s=30"),
            ("accel garbage", "accel noise sigma=10"),
            ("gyro garbage -i 1", "gyro noise sigma=1"),
            ("mag garbage", "mag noise sigma=50"),
            ("baro delayed", "baro delayed extra_s=0.5"),
            ("baro delayed extra_s=0.1", "baro delayed extra_s=0.1"),
            ("baro intermittent", "baro loss probability=0.7"),
            ("battery off", "sensor=battery kind=off"),
        ] {
            assert_eq!(fault(px4), fault(ours), "{px4}");
        }
    }

    #[test]
    fn with_what_a_kind_needs_it_is_a_fault() {
        for kind in KINDS {
            let keys: Vec<String> = needs(kind).map(|key| format!("{key}=1")).collect();
            let sensor = if matches!(kind, "rotor" | "collapse") { "" } else { "gnss" };
            fault(&format!("{sensor} {kind} {}", keys.join(" ")));
        }
    }

    #[test]
    fn what_is_listed_can_be_typed_again() {
        for line in ["gnss off", "collapse factor=0.85 from_s=3 to_s=5", "gnss glitch size_m=5"] {
            let asked = fault(line);
            assert_eq!(fault(&describe(&asked)), asked, "{}", describe(&asked));
        }
    }

    #[test]
    fn bad_lines_are_refused_by_what_is_wrong_with_them() {
        for (line, culprit) in [
            ("rotor index=0", "`rotor` needs `effectiveness=…`"),
            ("rotor index=1 effectivness=0.5", "`effectivness` is no key: did you mean `effectiveness`?"),
            ("gnss off from=10 to=20", "`from` is no key: did you mean `from_s`?"),
            ("gnss off size=3", "`size` is no key: use sensor, kind, from_s, to_s"),
            ("gnss drift rate=1 colour=3", "`colour` is no key: use rate, direction, sensor, kind, from_s, to_s"),
            ("rotor index=0 0.5", "`0.5` has no key: write `effectiveness=0.5`"),
            ("rotor index=9 effectiveness=0", "`index` must be between 0 and 3, not 9"),
            ("motor 1", "say which rotor (index=0 is rotor 1)"),
            ("motor off", "say which rotor (index=0 is rotor 1)"),
            ("motor slow", "say which rotor (index=0 is rotor 1): "),
            ("motor garbage -i 1", "`garbage` does not go with `motor`: use off, slow"),
            ("gps slow", "`slow` does not go with `gps`: use off, stuck, garbage, wrong, delayed, intermittent"),
            ("gyro wrong", "`wrong` does not go with `gyro`: use stuck, garbage"),
            ("accel off", "`off` does not go with the sensor `accel`"),
            ("motor off -i 5", "`-i` counts from 1 to 4"),
            ("motor off -i", "`-i` counts from 1 to 4"),
            ("motor off -i 1 index=0", "`index` is given twice, as `0` and `0`"),
            ("gps off -i 2", "there is one of it alone: leave out `-i 2`"),
            ("gps ok", "`clear` ends all faults"),
            ("collapse 0.7", "`0.7` has no key: write `factor=0.7`"),
            ("collapse", "`collapse` needs `factor=…`"),
            ("gnss spikes 1", "`spikes` needs `probability=…` and `size=…`"),
            ("gnss off 3", "`3` is too much: the times are `from_s=` and `to_s=`"),
            ("explode", "`explode` is no sensor and no kind"),
            ("", "kind="),
            ("sensor=gnss", "kind="),
            ("sensor=gps kind=off", "there is no sensor `gps`: use one of imu"),
            ("gns off", "did you mean `gnss`?"),
            ("gnss kind=stck", "there is no kind of fault `stck`: did you mean `stuck`?"),
            ("gnss off stuck", "`kind` is given twice"),
            ("sensor=gyro kind=off", "gyro"),
            ("rotor index=9 effectiveness=0.5", "index"),
            ("sensor=gnss kind=off colour=1", "colour"),
        ] {
            let error = format!("{:#}", read(line).expect_err(line));
            assert!(error.contains(culprit) && !error.contains('\n'), "{line}: {error}");
        }
    }

    #[test]
    fn whatever_may_be_asked_for_is_done_and_is_a_valid_fault() {
        let scenario = Scenario::load("field", &[]).expect("built in");
        let flight = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("flies");
        let injectable = injectable(flight.sensors(), true);
        let mut slots = Vec::new();
        for unit in Unit::ALL {
            for manner in Manner::ALL.into_iter().filter(|manner| injectable.allows(unit, *manner)) {
                let done: Vec<_> = of(&Failure { unit, manner, instance: None }, 1000).collect();
                assert_eq!(done.len(), usize::from(injectable.count(unit)), "{unit:?} {manner:?}");
                for (slot, fault) in done {
                    assert_eq!(fault.is_none(), manner == Manner::Well, "{unit:?} {manner:?}");
                    if let Some(fault) = fault {
                        fault.validate().expect("a fault");
                    }
                    slots.push(slot);
                }
            }
        }
        slots.sort_unstable();
        slots.dedup();
        assert_eq!(slots, (0..SLOTS).collect::<Vec<_>>());
    }

    #[test]
    fn the_present_time_is_told_with_three_decimals() {
        let error = parse("gnss off to_s=5".split_whitespace(), 20_519).expect_err("in the past").to_string();
        assert_eq!(error, "`to_s` must be after `from_s`, 20.519 s, not 5: from 20.519 to 5 s runs backwards");
    }

    #[test]
    fn a_failure_takes_the_place_of_the_one_before_and_can_be_taken_back() {
        let scenario = Scenario::load("field", &[]).expect("built in");
        let mut flight = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("flies");
        let count = |flight: &crate::sil::Flight<_>| flight.sensors().map(|suite| suite.faults().list(0).count());
        for (manner, faults) in [(Manner::Off, 1), (Manner::Stuck, 1), (Manner::Well, 0)] {
            for (slot, fault) in of(&Failure { unit: Unit::Gnss, manner, instance: None }, 0) {
                flight.hold_fault(slot, fault.as_ref()).expect("on sensors");
            }
            assert_eq!(count(&flight), Some(faults), "{manner:?}");
        }
    }

    #[test]
    fn ideal_state_has_nothing_to_fail() {
        assert!(injectable(None, true).is_none());
        let scenario = Scenario::load("pad", &[]).expect("built in");
        let mut flight = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("flies");
        let refusal = flight.inject(&fault("sensor=gnss kind=off")).expect_err("ideal");
        assert!(refusal.to_string().contains("sensors"), "{refusal}");
        let refusal = flight.inject(&fault("kind=collapse factor=0.5")).expect_err("no battery");
        assert!(refusal.to_string().contains("battery"), "{refusal}");
    }

    #[test]
    fn rotors_and_battery_go_by_what_is_commanded() {
        let scenario = Scenario::load("field", &[]).expect("built in");
        let mut flight = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("flies");
        let volts = |flight: &crate::sil::Flight<crate::plant::rigid_body::RigidBody>| {
            crate::plant::Plant::battery(flight.plant()).map_or(0.0, |battery| battery.voltage_v)
        };
        flight.step(&mut ());
        let (lift, full) = (flight.plant().constants().geometry[(0, 2)], volts(&flight));
        flight.inject(&fault("kind=rotor index=2 effectiveness=0.5 from_s=0")).expect("a fault");
        flight.inject(&fault("kind=collapse factor=0.8 from_s=0")).expect("a fault");
        flight.step(&mut ());
        let left = flight.plant().constants().geometry[(0, 2)] / lift;
        assert!((left - 0.5).abs() < 1e-3 && (volts(&flight) / full - 0.8).abs() < 1e-3, "{left} {}", volts(&flight));
        flight.clear_faults().expect("on sensors");
        flight.step(&mut ());
        let left = flight.plant().constants().geometry[(0, 2)] / lift;
        assert!((left - 1.0).abs() < 1e-3 && (volts(&flight) / full - 1.0).abs() < 1e-3, "{left} {}", volts(&flight));
    }
}
