//! Failures that a ground station injects, as PX4 and MAVSDK name them: which faults they are.

use firmware::airframe::ROTORS;
use firmware::failure::{Failure, Injectable, Manner, Unit};
use firmware::signals::Tick;

use crate::sensors::faults::{Kind, SLOTS, Sensor};
use crate::sensors::{Fault, Suite};

/// What can fail by itself, and be made to work again by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Equipment {
    /// A sensor; with its monitor, the battery itself.
    Sensor(Sensor),
    /// One rotor (from 0), or all.
    Rotors(Option<usize>),
}

impl Equipment {
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

/// The kind of fault, if there is one of the unit. MAVLink specifies no magnitudes: these are far outside of normal
/// operation.
pub fn kind(unit: Unit, manner: Manner, instance: usize) -> Option<Kind> {
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
