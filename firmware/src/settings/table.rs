//! What a setting is: name, range, unit, text, when it takes effect, and where it stands in the configuration.

use super::rows::SETTINGS;
use crate::airframe::Airframe;
use crate::config::{FlightConfig, ManualSettings, ModeSettings};
use crate::control::attitude::AttitudeGains;
use crate::control::position::PositionGains;
use crate::estimator::EstimatorSettings;
use crate::validate::{ConfigError, Field, Range};

/// Greatest length of a name: that of MAVLink's `param_id`.
pub const NAME_MAX: usize = 16;

/// A setting's value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// An integer.
    Int(i32),
    /// A number.
    Real(f32),
}

/// Type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// [`Value::Int`].
    Int32,
    /// [`Value::Real`].
    Real32,
}

impl Value {
    /// Its type.
    pub const fn kind(self) -> Kind {
        match self {
            Self::Int(_) => Kind::Int32,
            Self::Real(_) => Kind::Real32,
        }
    }

    /// The 32 bits in which it is stored.
    pub const fn bits(self) -> u32 {
        match self {
            Self::Int(int) => int.cast_unsigned(),
            Self::Real(real) => real.to_bits(),
        }
    }

    /// The value of a type that is stored in these bits.
    pub const fn from_bits(kind: Kind, bits: u32) -> Self {
        match kind {
            Kind::Int32 => Self::Int(bits.cast_signed()),
            Kind::Real32 => Self::Real(f32::from_bits(bits)),
        }
    }

    /// As a number; an integer above 2²⁴ is rounded.
    pub const fn real(self) -> f32 {
        match self {
            Self::Int(int) => int as f32,
            Self::Real(real) => real,
        }
    }

    /// As an integer; a number is truncated.
    pub const fn int(self) -> i32 {
        match self {
            Self::Int(int) => int,
            Self::Real(real) => real as i32,
        }
    }
}

/// When a setting may be set, and takes effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Set at any time, in effect from the next start.
    Boot,
    /// Set while disarmed, in effect at once.
    Disarmed,
    /// Set at any time, in effect at once.
    InFlight,
    /// Not set: what the vehicle does is fixed, or the value has no effect yet.
    ReadOnly,
}

/// The values that a setting accepts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Domain {
    /// Numbers, in the unit of the configuration.
    Real(Range),
    /// Integers from the first to the second.
    Whole(i32, i32),
    /// These integers, in ascending order.
    OneOf(&'static [i32]),
}

/// Access to a value within a part of the configuration.
#[derive(Debug)]
pub struct Slot<T: 'static> {
    /// The value; `None` for a number that the present reaching law does not have.
    pub get: fn(&T) -> Option<Value>,
    /// Sets it, if it is there.
    pub set: fn(&mut T, Value),
}

// Derived, these would ask the part itself to be copied.
impl<T> Clone for Slot<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Slot<T> {}

/// The part of the configuration in which a setting stands, hence the partitions that it concerns.
#[derive(Clone, Copy, Debug)]
pub enum Place {
    /// The attitude law: inner.
    Attitude(Slot<AttitudeGains>),
    /// The position law: outer.
    Position(Slot<PositionGains>),
    /// Modes: outer and commander.
    Modes(Slot<ModeSettings>),
    /// Sticks: outer and commander.
    Manual(Slot<ManualSettings>),
    /// The estimator: filter.
    Estimator(Slot<EstimatorSettings>),
    /// The vehicle.
    Airframe(Slot<Airframe>),
    /// A number of the flight's own.
    Flight(Slot<FlightConfig>),
    /// None: it stands in the settings alone.
    Settings,
}

impl Place {
    /// The access, if it is to the attitude law.
    pub fn attitude(&self) -> Option<&Slot<AttitudeGains>> {
        if let Self::Attitude(slot) = self { Some(slot) } else { None }
    }

    /// The access, if it is to the position law.
    pub fn position(&self) -> Option<&Slot<PositionGains>> {
        if let Self::Position(slot) = self { Some(slot) } else { None }
    }

    /// The access, if it is to the modes.
    pub fn modes(&self) -> Option<&Slot<ModeSettings>> {
        if let Self::Modes(slot) = self { Some(slot) } else { None }
    }

    /// The access, if it is to the sticks.
    pub fn manual(&self) -> Option<&Slot<ManualSettings>> {
        if let Self::Manual(slot) = self { Some(slot) } else { None }
    }

    /// The access, if it is to the estimator.
    pub fn estimator(&self) -> Option<&Slot<EstimatorSettings>> {
        if let Self::Estimator(slot) = self { Some(slot) } else { None }
    }

    /// The access, if it is to the airframe.
    pub fn airframe(&self) -> Option<&Slot<Airframe>> {
        if let Self::Airframe(slot) = self { Some(slot) } else { None }
    }

    /// The access, if it is to the flight itself.
    pub fn flight(&self) -> Option<&Slot<FlightConfig>> {
        if let Self::Flight(slot) = self { Some(slot) } else { None }
    }

    /// The value in a configuration.
    pub(super) fn get(&self, config: &FlightConfig) -> Option<Value> {
        match self {
            Self::Attitude(slot) => (slot.get)(&config.attitude),
            Self::Position(slot) => (slot.get)(&config.position),
            Self::Modes(slot) => (slot.get)(&config.modes),
            Self::Manual(slot) => (slot.get)(&config.manual),
            Self::Estimator(slot) => (slot.get)(&config.estimator.unwrap_or_default()),
            Self::Airframe(slot) => (slot.get)(&config.airframe),
            Self::Flight(slot) => (slot.get)(config),
            Self::Settings => None,
        }
    }

    /// Sets it there; a flight without an estimator stays without.
    pub(super) fn set(&self, config: &mut FlightConfig, value: Value) {
        match self {
            Self::Attitude(slot) => (slot.set)(&mut config.attitude, value),
            Self::Position(slot) => (slot.set)(&mut config.position, value),
            Self::Modes(slot) => (slot.set)(&mut config.modes, value),
            Self::Manual(slot) => (slot.set)(&mut config.manual, value),
            Self::Estimator(slot) => {
                if let Some(estimator) = &mut config.estimator {
                    (slot.set)(estimator, value);
                }
            }
            Self::Airframe(slot) => (slot.set)(&mut config.airframe, value),
            Self::Flight(slot) => (slot.set)(config, value),
            Self::Settings => {}
        }
    }
}

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// Upper-case letters, digits and underscores, at most [`NAME_MAX`]; PX4's name if it means the same.
    pub name: &'static str,
    /// Unit of the value; empty for a pure number.
    pub unit: &'static str,
    /// What it is.
    pub text: &'static str,
    /// When it may be set.
    pub class: Class,
    /// What it accepts.
    pub domain: Domain,
    /// The value per unit of the configuration, for a setting in another unit.
    pub scale: f32,
    /// The default, where it does not follow from [`FlightConfig::default`].
    pub default: Option<Value>,
    /// Dotted key in the configuration, by which its validation names it; empty for none.
    pub key: Field,
    /// Where it stands.
    pub place: Place,
}

impl Setting {
    /// Its type.
    pub const fn kind(&self) -> Kind {
        match self.domain {
            Domain::Real(_) => Kind::Real32,
            Domain::Whole(..) | Domain::OneOf(_) => Kind::Int32,
        }
    }

    /// Least value.
    pub fn min(&self) -> Value {
        match self.domain {
            Domain::Real(range) => Value::Real(range.min() * self.scale),
            Domain::Whole(low, _) => Value::Int(low),
            Domain::OneOf(values) => Value::Int(values.first().copied().unwrap_or(0)),
        }
    }

    /// Greatest value.
    pub fn max(&self) -> Value {
        match self.domain {
            Domain::Real(range) => Value::Real(range.max() * self.scale),
            Domain::Whole(_, high) => Value::Int(high),
            Domain::OneOf(values) => Value::Int(values.last().copied().unwrap_or(0)),
        }
    }

    /// Whether it accepts a value of its type; false for NaN.
    pub(super) fn accepts(&self, value: Value) -> bool {
        match (self.domain, value, self.min(), self.max()) {
            (Domain::Real(_), Value::Real(value), Value::Real(low), Value::Real(high)) => (low..=high).contains(&value),
            (Domain::Whole(low, high), Value::Int(value), _, _) => (low..=high).contains(&value),
            (Domain::OneOf(values), Value::Int(value), _, _) => values.contains(&value),
            _ => false,
        }
    }

    /// The value in a configuration; `None` if it is not there.
    pub(super) fn read(&self, config: &FlightConfig) -> Option<Value> {
        self.place.get(config).map(|value| match value {
            Value::Real(real) if self.scale != 1.0 => Value::Real(real * self.scale),
            value => value,
        })
    }

    /// An accepted value in the configuration's unit, within its range there whatever the conversion rounds.
    pub(super) fn configured(&self, value: Value) -> Value {
        match (self.domain, value) {
            (Domain::Real(range), Value::Real(real)) if self.scale != 1.0 => {
                Value::Real(crate::math::clamp(real / self.scale, range.min(), range.max()))
            }
            (_, value) => value,
        }
    }
}

/// The index of a setting.
pub fn find(name: &str) -> Option<usize> {
    SETTINGS.iter().position(|setting| setting.name == name)
}

/// Checks the values of a part of the configuration, in the order of the table.
fn check<T>(part: &T, slot_of: fn(&Place) -> Option<&Slot<T>>) -> Result<(), ConfigError> {
    for setting in &SETTINGS {
        if let (Some(slot), Domain::Real(range)) = (slot_of(&setting.place), setting.domain)
            && let Some(Value::Real(value)) = (slot.get)(part)
        {
            range.check(setting.key, value)?;
        }
    }
    Ok(())
}

/// Checks limits and failsafe settings.
///
/// # Errors
/// The first field that is out of its range.
pub(crate) fn check_modes(modes: &ModeSettings) -> Result<(), ConfigError> {
    check(modes, Place::modes)
}

/// Checks what sticks do.
///
/// # Errors
/// The first field that is out of its range.
pub(crate) fn check_manual(manual: &ManualSettings) -> Result<(), ConfigError> {
    check(manual, Place::manual)
}

/// Checks the constants of an airframe.
///
/// # Errors
/// The first field that is out of its range.
pub(crate) fn check_airframe(airframe: &Airframe) -> Result<(), ConfigError> {
    check(airframe, Place::airframe)
}

/// Checks the noise parameters of the estimator.
///
/// # Errors
/// The first field that is out of its range.
pub(crate) fn check_estimator(settings: &EstimatorSettings) -> Result<(), ConfigError> {
    check(settings, Place::estimator)
}

/// Checks the numbers of the flight's own.
///
/// # Errors
/// The first field that is out of its range.
pub(crate) fn check_flight(config: &FlightConfig) -> Result<(), ConfigError> {
    check(config, Place::flight)
}
