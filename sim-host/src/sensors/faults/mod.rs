//! Faults of sensors, of rotors and of the battery: what, from when and until when.
//!
//! ```toml
//! [[fault]]
//! sensor = "gnss"
//! kind = "glitch"
//! from_s = 20.0
//! to_s = 30.0          # without it, for good
//! size_m = 50.0
//! ```
//!
//! A fault acts on what the sound sensor has measured, so that the sound sensor draws the same numbers with it and
//! without; what a fault draws comes from a stream of its own. `rate`, `sigma` and `size` are in the sensor's unit:
//! rad/s (gyro), m/s² (accel), µT (mag), Pa (baro), m (gnss, pose), V (battery).

mod running;

use anyhow::{Result, ensure};
use firmware::airframe::ROTORS;
use firmware::signals::Tick;
use serde::{Deserialize, Serialize};

use super::process::{seconds, ticks};
use crate::noise::gaussian::Stream;
use crate::refusal::{Refusal, after, typed, within};
use running::Running;
pub(super) use running::{Memory, Sample};

/// Faults that may be started while flying, in addition to those of the schedule.
const SPARE: usize = 32;
/// Faults that replace each other, for those that a ground station asks for: room for each is always there.
pub(crate) const SLOTS: usize = 10;
/// Longest time by which a fault delays samples, s.
pub(super) const EXTRA_MAX_S: f64 = 1.0;
/// Greatest time, s: 11 days.
const TIME_MAX_S: f64 = 1e6;

/// What fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sensor {
    /// Gyro and accelerometer together.
    Imu,
    /// Gyro alone.
    Gyro,
    /// Accelerometer alone.
    Accel,
    /// Magnetometer.
    Mag,
    /// Barometer.
    Baro,
    /// Satellite receiver.
    Gnss,
    /// Motion capture.
    Pose,
    /// Battery monitor.
    Battery,
}

/// The names of the kinds, as they are written in files.
pub(crate) const KINDS: [&str; 15] = [
    "off",
    "stuck",
    "drift",
    "noise",
    "spikes",
    "delayed",
    "nan",
    "glitch",
    "no-fix",
    "loss",
    "duplicate",
    "disorder",
    "time-jump",
    "rotor",
    "collapse",
];

/// How a sensor fails, or a rotor, or the battery. Directions are in the frame of what is measured; without one, it is
/// drawn from the seed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Kind {
    /// Nothing is delivered.
    Off {},
    /// The last value again and again, with fresh stamps.
    Stuck {},
    /// The error grows.
    Drift {
        /// In the sensor's unit a second.
        rate: f64,
        /// Along which it grows.
        direction: Option<[f64; 3]>,
    },
    /// More noise.
    Noise {
        /// Deviation, in the sensor's unit.
        sigma: f64,
    },
    /// Some samples are far off, each in a direction of its own.
    Spikes {
        /// Of a sample.
        probability: f64,
        /// In the sensor's unit.
        size: f64,
    },
    /// Samples arrive later; what is overtaken when that ends is lost.
    Delayed {
        /// By how much, s.
        extra_s: f64,
    },
    /// Numbers that are not.
    Nan {},
    /// A jump of the position for as long as it lasts (gnss and pose).
    Glitch {
        /// How far, m.
        size_m: f64,
        /// Where to; without it, in a horizontal direction drawn from the seed.
        direction: Option<[f64; 3]>,
    },
    /// The receiver delivers, but claims no fix (gnss).
    NoFix {},
    /// Some samples are lost.
    Loss {
        /// Of a sample.
        probability: f64,
    },
    /// In place of some samples the one before comes again, with its old stamp.
    Duplicate {
        /// Of a sample.
        probability: f64,
    },
    /// Each two samples arrive in the wrong order.
    Disorder {},
    /// Stamps are shifted.
    TimeJump {
        /// By how much, s; into the past if negative.
        shift_s: f64,
    },
    /// A rotor loses thrust; of no sensor.
    Rotor {
        /// Which, from 0.
        index: usize,
        /// What is left of its thrust, 0..=1.
        effectiveness: f64,
    },
    /// The battery's voltage collapses; of no sensor.
    Collapse {
        /// What is left of it, 0..=1.
        factor: f64,
    },
}

/// A fault: how what fails, from when and until when.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "toml::Table")]
pub struct Fault {
    /// Which sensor; none for a rotor or the battery.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensor: Option<Sensor>,
    /// How.
    #[serde(flatten)]
    pub kind: Kind,
    /// Onset, s.
    pub from_s: f64,
    /// End, s; without it, for good.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_s: Option<f64>,
}

/// Number of a fault that has been started.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FaultId(u32);

/// The keys that every fault has; the others are those of its kind.
#[derive(Deserialize)]
struct Common {
    sensor: Option<Sensor>,
    from_s: f64,
    to_s: Option<f64>,
}

impl TryFrom<toml::Table> for Fault {
    type Error = String;

    fn try_from(mut table: toml::Table) -> Result<Self, String> {
        let mut common = toml::Table::new();
        for key in ["sensor", "from_s", "to_s"] {
            common.extend(table.remove_entry(key));
        }
        let common = typed(common).map_err(in_a_fault)?;
        let Common { sensor, from_s, to_s } = common;
        require_kinds_of_values(&table).map_err(in_a_fault)?;
        let fault = Self { sensor, kind: typed(table).map_err(in_a_fault)?, from_s, to_s };
        fault.validate().map_err(|error| format!("{error:#}"))?;
        Ok(fault)
    }
}

fn in_a_fault(error: anyhow::Error) -> String {
    format!("{:#}", Refusal::below(error, "fault"))
}

/// Refuses a value of another kind than its key's: an enumeration with its tag inside forgets which key it was.
fn require_kinds_of_values(table: &toml::Table) -> Result<()> {
    for (key, value) in table {
        let (rule, is_one) = match key.as_str() {
            "kind" => ("must be text in quotes", value.is_str()),
            "direction" => ("must be an array of 3 numbers", value.as_array().is_some_and(|v| v.len() == 3)),
            "index" => ("must be a whole number from 0 up", value.as_integer().is_some_and(|index| index >= 0)),
            _ => ("must be a number", value.is_float() || value.is_integer()),
        };
        if !is_one && KEYS.contains(&key.as_str()) {
            return Err(Refusal::new(key, rule).given(value).into());
        }
    }
    Ok(())
}

/// Every key that some kind of fault has.
const KEYS: [&str; 12] = [
    "kind",
    "direction",
    "index",
    "rate",
    "sigma",
    "probability",
    "size",
    "extra_s",
    "size_m",
    "shift_s",
    "effectiveness",
    "factor",
];

impl Sensor {
    /// Every sensor.
    pub(crate) const ALL: [Self; 8] =
        [Self::Imu, Self::Gyro, Self::Accel, Self::Mag, Self::Baro, Self::Gnss, Self::Pose, Self::Battery];

    /// The sensor whose samples it is part of.
    fn channel(self) -> Self {
        if matches!(self, Self::Gyro | Self::Accel) { Self::Imu } else { self }
    }

    /// As it is written in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Imu => "imu",
            Self::Gyro => "gyro",
            Self::Accel => "accel",
            Self::Mag => "mag",
            Self::Baro => "baro",
            Self::Gnss => "gnss",
            Self::Pose => "pose",
            Self::Battery => "battery",
        }
    }
}

impl Kind {
    /// As it is written in files.
    fn name(&self) -> String {
        let table = toml::Table::try_from(self).unwrap_or_default();
        table.get("kind").and_then(toml::Value::as_str).unwrap_or_default().to_owned()
    }

    /// Whether a sensor can fail like that.
    fn fits(&self, sensor: Option<Sensor>) -> bool {
        use Sensor::{Accel, Battery, Gnss, Gyro, Imu, Pose};
        let Some(sensor) = sensor else { return matches!(self, Self::Rotor { .. } | Self::Collapse { .. }) };
        match self {
            Self::Rotor { .. } | Self::Collapse { .. } => false,
            Self::Stuck {} | Self::Nan {} => true,
            // The units of the IMU's two halves differ.
            Self::Drift { .. } | Self::Noise { .. } | Self::Spikes { .. } => sensor != Imu,
            Self::Glitch { .. } => matches!(sensor, Gnss | Pose),
            Self::NoFix {} => sensor == Gnss,
            Self::TimeJump { .. } => !matches!(sensor, Gyro | Accel | Battery),
            // What becomes of a sample becomes of both halves.
            Self::Off {} | Self::Loss { .. } | Self::Duplicate { .. } | Self::Disorder {} | Self::Delayed { .. } => {
                !matches!(sensor, Gyro | Accel)
            }
        }
    }

    fn validate(&self) -> Result<()> {
        let magnitude = |key: &str, value: f64| within(&format!("fault.{key}"), value, -1e6, 1e6);
        let fraction = |key: &str, value: f64| within(&format!("fault.{key}"), value, 0.0, 1.0);
        match *self {
            Self::Drift { rate, direction } => magnitude("rate", rate).and(pointing(direction)),
            Self::Glitch { size_m, direction } => magnitude("size_m", size_m).and(pointing(direction)),
            Self::Noise { sigma } => within("fault.sigma", sigma, 0.0, 1e6),
            Self::Spikes { probability, size } => fraction("probability", probability).and(magnitude("size", size)),
            Self::Delayed { extra_s } => within("fault.extra_s", extra_s, 0.0, EXTRA_MAX_S),
            Self::Loss { probability } | Self::Duplicate { probability } => fraction("probability", probability),
            Self::TimeJump { shift_s } => within("fault.shift_s", shift_s, -TIME_MAX_S, TIME_MAX_S),
            Self::Rotor { index, effectiveness } => {
                within("fault.index", index as f64, 0.0, (ROTORS - 1) as f64)?;
                fraction("effectiveness", effectiveness)
            }
            Self::Collapse { factor } => fraction("factor", factor),
            Self::Off {} | Self::Stuck {} | Self::Nan {} | Self::NoFix {} | Self::Disorder {} => Ok(()),
        }
    }
}

/// Refuses what points nowhere.
fn pointing(direction: Option<[f64; 3]>) -> Result<()> {
    let Some(direction) = direction else { return Ok(()) };
    direction.iter().try_for_each(|value| within("fault.direction", *value, -1e6, 1e6))?;
    ensure!(
        direction.iter().any(|value| value.abs() > 1e-6),
        "`fault.direction` must point somewhere, not be zero: leave it out for one drawn from the seed"
    );
    Ok(())
}

impl Fault {
    /// A fault from `tick` on, for good.
    pub fn starting(sensor: Option<Sensor>, kind: Kind, tick: Tick) -> Self {
        Self { sensor, kind, from_s: seconds(tick), to_s: None }
    }

    /// Refuses what cannot be.
    ///
    /// # Errors
    /// The first key that is out of its range, or that does not go with the others.
    pub fn validate(&self) -> Result<()> {
        within("fault.from_s", self.from_s, 0.0, TIME_MAX_S)?;
        if let Some(to_s) = self.to_s {
            within("fault.to_s", to_s, 0.0, TIME_MAX_S)?;
            if to_s < self.from_s {
                after(("fault.from_s", self.from_s), ("fault.to_s", to_s))?;
            }
        }
        self.require_fitting_sensor()?;
        self.kind.validate()
    }

    fn require_fitting_sensor(&self) -> Result<()> {
        if self.kind.fits(self.sensor) {
            return Ok(());
        }
        let fitting = Sensor::ALL.into_iter().filter(|sensor| self.kind.fits(Some(*sensor)));
        let fitting = fitting.map(Sensor::name).collect::<Vec<_>>().join(", ");
        let kind = self.kind.name();
        Err(match self.sensor {
            Some(_) if fitting.is_empty() => {
                Refusal::new("fault.sensor", format!("does not go with `{kind}`, which is of no sensor"))
                    .remedy("leave it out")
            }
            Some(sensor) => {
                Refusal::new("fault.kind", format!("`{kind}` does not go with the sensor `{}`", sensor.name()))
                    .remedy(format!("use it with {fitting}"))
            }
            None => Refusal::new("fault.sensor", "is missing").remedy(format!("`{kind}` goes with {fitting}")),
        }
        .into())
    }
}

/// The faults of a flight.
#[derive(Clone, Debug)]
pub struct Faults {
    seed: u64,
    /// Number of the next one, and of its stream.
    next: u32,
    all: Vec<Running>,
    /// Most of those that are in no slot.
    most: usize,
    slots: [Option<FaultId>; SLOTS],
}

/// What faults make of rotors and battery: 1 for what is sound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlantFaults {
    /// What is left of each rotor's thrust.
    pub rotor_effectiveness: [f64; ROTORS],
    /// What is left of the battery's voltage.
    pub battery_factor: f64,
}

impl Faults {
    /// A schedule under a seed. A fault's stream goes by its place in the schedule.
    pub fn new(schedule: &[Fault], seed: u64) -> Self {
        let most = schedule.len() + SPARE;
        let mut faults = Self { seed, next: 0, all: Vec::with_capacity(most + SLOTS), most, slots: [None; SLOTS] };
        for fault in schedule {
            faults.start(fault);
        }
        faults
    }

    fn start(&mut self, fault: &Fault) -> FaultId {
        let id = FaultId(self.next);
        self.all.push(Running::new(fault, id, Stream::of_fault(self.seed, self.next)));
        self.next += 1;
        id
    }

    /// Adds a fault while flying. Does not allocate.
    ///
    /// # Errors
    /// A fault that cannot be, or one too many.
    pub fn inject(&mut self, fault: &Fault) -> Result<FaultId> {
        fault.validate()?;
        let in_slots = self.slots.iter().flatten().count();
        let count = self.all.len() - in_slots;
        ensure!(count < self.most, "there are {count} faults already: clear some");
        Ok(self.start(fault))
    }

    /// Ends the fault in a slot, and puts a valid one in its place, if there is one. Does not allocate, and cannot fail.
    pub fn hold(&mut self, slot: usize, fault: Option<&Fault>) {
        if let Some(id) = self.slots.get_mut(slot).and_then(Option::take) {
            self.clear(id);
        }
        let started = fault.map(|fault| self.start(fault));
        if let Some(place) = self.slots.get_mut(slot) {
            *place = started;
        }
    }

    /// The faults that act now or will, in the order in which they were started.
    pub fn list(&self, tick: Tick) -> impl Iterator<Item = Fault> + '_ {
        self.all.iter().filter(move |fault| !fault.is_over(tick)).map(Running::fault)
    }

    /// What they make of rotors and battery at a tick.
    pub fn of_plant(&self, tick: Tick) -> PlantFaults {
        PlantFaults { rotor_effectiveness: self.rotor_effectiveness(tick), battery_factor: self.battery_factor(tick) }
    }

    /// Ends a fault, or takes it back before it has begun.
    pub fn clear(&mut self, id: FaultId) {
        self.all.retain(|fault| fault.id != id);
    }

    /// Ends all faults, those to come too.
    pub fn clear_all(&mut self) {
        self.slots = [None; SLOTS];
        self.all.clear();
    }

    fn active(&mut self, tick: Tick, channel: Sensor) -> impl Iterator<Item = &mut Running> {
        self.all.iter_mut().filter(move |fault| fault.channel == Some(channel) && fault.is_active(tick))
    }

    /// What is left of each rotor's thrust at a tick, 1 for a sound one.
    pub fn rotor_effectiveness(&self, tick: Tick) -> [f64; ROTORS] {
        let mut left = [1.0; ROTORS];
        for fault in self.all.iter().filter(|fault| fault.is_active(tick)) {
            if let Kind::Rotor { index, effectiveness } = fault.kind {
                left[index] *= effectiveness;
            }
        }
        left
    }

    /// What is left of the battery's voltage at a tick, 1 for a sound one.
    pub fn battery_factor(&self, tick: Tick) -> f64 {
        let active = self.all.iter().filter(|fault| fault.is_active(tick));
        active.fold(1.0, |left, fault| if let Kind::Collapse { factor } = fault.kind { left * factor } else { left })
    }

    /// What is delivered of a sample that a sound sensor has measured at `tick`, and how much later than usual, ticks.
    pub(super) fn pass<T: Sample>(&mut self, tick: Tick, memory: &mut Memory<T>, mut sample: T) -> Option<(T, u32)> {
        for fault in self.active(tick, T::CHANNEL) {
            fault.hold(&mut sample, memory);
        }
        memory.keep(&sample);
        let mut way = running::Way::default();
        for fault in self.active(tick, T::CHANNEL) {
            fault.act(tick, &mut sample, &mut way);
        }
        memory.send(sample, way).map(|sample| (sample, way.extra))
    }
}

/// Ticks from and to which a fault acts.
fn span(fault: &Fault) -> core::ops::Range<Tick> {
    ticks(fault.from_s)..fault.to_s.map_or(Tick::MAX, ticks)
}

#[cfg(test)]
mod tests;
