//! Faults of sensors, rotors and battery, with their start and end.
//!
//! ```toml
//! [[fault]]
//! sensor = "gnss"
//! kind = "glitch"
//! from_s = 20.0
//! to_s = 30.0          # default: permanent
//! size_m = 50.0
//! ```
//!
//! A fault acts on the samples of the fault-free sensor, which draws the same random numbers with and without it. A fault's own random numbers come from a separate stream. `rate`, `sigma` and `size` are in the sensor's unit:
//! rad/s (gyro), m/s² (accel), µT (mag), Pa (baro), m (gnss, pose), V (battery).

mod running;

use anyhow::{Result, ensure};
use firmware::airframe::ROTORS;
use firmware::signals::Tick;
use glissade_files::refusal::{Refusal, after, typed, within};
use serde::{Deserialize, Serialize};

use super::process::{seconds, ticks};
use crate::noise::gaussian::Stream;
use crate::plant::PlantFaults;
use running::Running;
pub(super) use running::{Memory, Sample};

/// Greatest number of faults started in flight, in addition to those of the schedule.
const SPARE: usize = 32;
/// Number of slots for faults that replace each other, for a ground station's requests: there is always room.
pub const SLOTS: usize = 10;
/// Longest time by which a fault delays samples, s.
pub(super) const EXTRA_MAX_S: f64 = 1.0;
/// Greatest time, s: 11 days.
const TIME_MAX_S: f64 = 1e6;

/// The sensor that fails.
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
pub const KINDS: [&str; 15] = [
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

/// Kind of a fault of a sensor, a rotor or the battery. Directions are in the frame of the measurement; by default they are drawn from the seed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Kind {
    /// No samples.
    Off {},
    /// The value is stuck, with fresh time stamps.
    Stuck {},
    /// The error grows linearly.
    Drift {
        /// In the sensor's unit per second.
        rate: f64,
        /// Direction of the error.
        direction: Option<[f64; 3]>,
    },
    /// Additional noise.
    Noise {
        /// Deviation, in the sensor's unit.
        sigma: f64,
    },
    /// Some samples have a large error, each in its own direction.
    Spikes {
        /// Of a sample.
        probability: f64,
        /// In the sensor's unit.
        size: f64,
    },
    /// Samples arrive later; those overtaken when the fault ends are lost.
    Delayed {
        /// Additional latency, s.
        extra_s: f64,
    },
    /// Values are NaN.
    Nan {},
    /// A jump of the position while the fault lasts (gnss and pose).
    Glitch {
        /// Size of the jump, m.
        size_m: f64,
        /// Direction; by default horizontal, drawn from the seed.
        direction: Option<[f64; 3]>,
    },
    /// Samples without a fix (gnss).
    NoFix {},
    /// Some samples are lost.
    Loss {
        /// Of a sample.
        probability: f64,
    },
    /// Some samples are replaced by the previous one, with its old time stamp.
    Duplicate {
        /// Of a sample.
        probability: f64,
    },
    /// Pairs of samples arrive in the wrong order.
    Disorder {},
    /// Time stamps are shifted.
    TimeJump {
        /// Shift, s; negative for the past.
        shift_s: f64,
    },
    /// A rotor loses thrust (no sensor).
    Rotor {
        /// Rotor, from 0.
        index: usize,
        /// Remaining fraction of its thrust, 0..=1.
        effectiveness: f64,
    },
    /// The battery's voltage collapses (no sensor).
    Collapse {
        /// Remaining fraction of the voltage, 0..=1.
        factor: f64,
    },
}

/// A fault: what fails, how, from when and until when.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "toml::Table")]
pub struct Fault {
    /// The sensor; `None` for a rotor or the battery.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensor: Option<Sensor>,
    /// Its kind.
    #[serde(flatten)]
    pub kind: Kind,
    /// Onset, s.
    pub from_s: f64,
    /// End, s; permanent by default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_s: Option<f64>,
}

/// Identifier of a fault started in flight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FaultId(u32);

/// The keys common to all faults; the others belong to the kind.
#[derive(Deserialize)]
struct Common {
    sensor: Option<Sensor>,
    from_s: f64,
    to_s: Option<f64>,
}

impl TryFrom<toml::Table> for Fault {
    type Error = String;

    fn try_from(mut table: toml::Table) -> Result<Self, String> {
        require_known_keys(&table).map_err(in_a_fault)?;
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

/// The keys of a kind of fault by its name; empty for a name that is of none.
pub fn keys(kind: &str) -> &'static [&'static str] {
    match kind {
        "drift" => &["rate", "direction"],
        "noise" => &["sigma"],
        "spikes" => &["probability", "size"],
        "delayed" => &["extra_s"],
        "glitch" => &["size_m", "direction"],
        "loss" | "duplicate" => &["probability"],
        "time-jump" => &["shift_s"],
        "rotor" => &["index", "effectiveness"],
        "collapse" => &["factor"],
        _ => &[],
    }
}

/// Refuses a key that a fault of this kind does not have; one without a kind is left to whoever reads it.
///
/// # Errors
/// A [`Refusal`] with the key that may have been meant, or with all that there are.
pub fn require_known_keys(table: &toml::Table) -> Result<()> {
    let Some(kind) = table.get("kind").and_then(toml::Value::as_str).filter(|kind| KINDS.contains(kind)) else {
        return Ok(());
    };
    let known = [keys(kind), &["sensor", "kind", "from_s", "to_s"]].concat();
    match table.keys().find(|key| !known.contains(&key.as_str())) {
        Some(stray) => Err(Refusal::unknown_key(stray, &known).into()),
        None => Ok(()),
    }
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
        let is_known = key == "kind" || KINDS.iter().any(|kind| keys(kind).contains(&key.as_str()));
        if is_known && !is_one {
            return Err(Refusal::new(key, rule).given(value).into());
        }
    }
    Ok(())
}

impl Sensor {
    /// Every sensor.
    pub const ALL: [Self; 8] =
        [Self::Imu, Self::Gyro, Self::Accel, Self::Mag, Self::Baro, Self::Gnss, Self::Pose, Self::Battery];

    /// The sensor that delivers it: the IMU for its two halves.
    fn channel(self) -> Self {
        if matches!(self, Self::Gyro | Self::Accel) { Self::Imu } else { self }
    }

    /// Its name in files.
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

    /// The unit of `rate`, `sigma` and `size`; without one for the IMU, whose halves differ.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Imu => "",
            Self::Gyro => "rad/s",
            Self::Accel => "m/s²",
            Self::Mag => "µT",
            Self::Baro => "Pa",
            Self::Gnss | Self::Pose => "m",
            Self::Battery => "V",
        }
    }
}

impl Kind {
    /// Its name in files.
    fn name(&self) -> String {
        let table = toml::Table::try_from(self).unwrap_or_default();
        table.get("kind").and_then(toml::Value::as_str).unwrap_or_default().to_owned()
    }

    /// Whether this kind applies to a sensor.
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
            // Faults of the delivery apply to both halves.
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

/// Checks that a direction is not zero.
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
    /// A permanent fault from `tick` on.
    pub fn starting(sensor: Option<Sensor>, kind: Kind, tick: Tick) -> Self {
        Self { sensor, kind, from_s: seconds(tick), to_s: None }
    }

    /// Checks the fault.
    ///
    /// # Errors
    /// The first key that is out of range, or inconsistent with the others.
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
    /// Identifier of the next fault, and of its stream.
    next: u32,
    all: Vec<Running>,
    /// Greatest number of faults outside of slots.
    most: usize,
    slots: [Option<FaultId>; SLOTS],
}

impl Faults {
    /// A schedule under a seed. A fault's stream is determined by its position in the schedule.
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
    /// The fault is invalid, or there are too many.
    pub fn inject(&mut self, fault: &Fault) -> Result<FaultId> {
        fault.validate()?;
        let in_slots = self.slots.iter().flatten().count();
        let count = self.all.len() - in_slots;
        ensure!(count < self.most, "there are {count} faults already: clear some");
        Ok(self.start(fault))
    }

    /// Replaces the fault in a slot by a valid one, or by none. Does not allocate, and cannot fail.
    pub fn hold(&mut self, slot: usize, fault: Option<&Fault>) {
        if let Some(id) = self.slots.get_mut(slot).and_then(Option::take) {
            self.clear(id);
        }
        let started = fault.map(|fault| self.start(fault));
        if let Some(place) = self.slots.get_mut(slot) {
            *place = started;
        }
    }

    /// The present and future faults, in the order in which they were started.
    pub fn list(&self, tick: Tick) -> impl Iterator<Item = Fault> + '_ {
        self.all.iter().filter(move |fault| !fault.is_over(tick)).map(Running::fault)
    }

    /// Their effect on rotors and battery at a tick.
    pub fn of_plant(&self, tick: Tick) -> PlantFaults {
        PlantFaults { rotor_effectiveness: self.rotor_effectiveness(tick), battery_factor: self.battery_factor(tick) }
    }

    /// Ends a fault, or cancels it before it has begun.
    pub fn clear(&mut self, id: FaultId) {
        self.all.retain(|fault| fault.id != id);
    }

    /// Ends the faults of which this is true, also before they have begun.
    pub fn clear_where(&mut self, is_over: impl Fn(&Fault) -> bool) {
        self.all.retain(|fault| !is_over(&fault.fault()));
    }

    /// Ends all faults, those to come too.
    pub fn clear_all(&mut self) {
        self.slots = [None; SLOTS];
        self.all.clear();
    }

    fn active(&mut self, tick: Tick, channel: Sensor) -> impl Iterator<Item = &mut Running> {
        self.all.iter_mut().filter(move |fault| fault.channel == Some(channel) && fault.is_active(tick))
    }

    /// Remaining fraction of each rotor's thrust at a tick; 1 without a fault. Of several faults of a rotor the one that
    /// began last acts.
    pub fn rotor_effectiveness(&self, tick: Tick) -> [f64; ROTORS] {
        core::array::from_fn(|rotor| {
            self.last(tick, |kind| match kind {
                Kind::Rotor { index, effectiveness } if index == rotor => Some(effectiveness),
                _ => None,
            })
        })
    }

    /// Remaining fraction of the battery's voltage at a tick, 1 for a sound one. Of several faults the one that began last
    /// acts.
    pub fn battery_factor(&self, tick: Tick) -> f64 {
        self.last(tick, |kind| if let Kind::Collapse { factor } = kind { Some(factor) } else { None })
    }

    /// What is left by the active fault that began last, of those of a kind; 1 without one.
    fn last(&self, tick: Tick, left: impl Fn(Kind) -> Option<f64>) -> f64 {
        let active = self.all.iter().filter(|fault| fault.is_active(tick));
        let of_kind = active.filter_map(|fault| Some((fault.begins(), left(fault.kind)?)));
        // Of two that begin at once, the second.
        of_kind.max_by_key(|(begins, _)| *begins).map_or(1.0, |(_, left)| left)
    }

    /// The sample delivered for a fault-free one measured at `tick`, and its additional latency, ticks.
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

/// First tick of a fault, and the tick after its last.
fn span(fault: &Fault) -> core::ops::Range<Tick> {
    ticks(fault.from_s)..fault.to_s.map_or(Tick::MAX, ticks)
}

#[cfg(test)]
mod tests;
