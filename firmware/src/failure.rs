//! Failure injection by a ground station (`MAV_CMD_INJECT_FAILURE`).
//!
//! The firmware itself injects nothing. A board or simulator that can declares its failures with
//! [`InnerTask::allow_failures`](crate::autopilot::InnerTask::allow_failures). The ground partition accepts these and
//! refuses all others. The board takes the accepted ones each tick with
//! [`take_failures`](crate::autopilot::InnerTask::take_failures) and must inject them: they have already been
//! acknowledged.

/// Unit that fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Gyroscope.
    Gyro,
    /// Accelerometer.
    Accel,
    /// Magnetometer.
    Mag,
    /// Barometer.
    Baro,
    /// Satellite receiver.
    Gnss,
    /// The battery itself.
    Battery,
    /// A rotor.
    Motor,
}

impl Unit {
    /// All units.
    pub const ALL: [Self; 7] = [Self::Gyro, Self::Accel, Self::Mag, Self::Baro, Self::Gnss, Self::Battery, Self::Motor];
}

/// Manner of a failure, in the order of MAVLink's `FAILURE_TYPE`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Manner {
    /// No failure: ends an injected one.
    Well,
    /// Off: no output.
    Off,
    /// The output is stuck at its last value.
    Stuck,
    /// The output is noise.
    Garbage,
    /// The output is wrong.
    Wrong,
    /// Works, but slowly.
    Slow,
    /// The output is delayed.
    Delayed,
    /// Some of the output is missing.
    Intermittent,
}

impl Manner {
    /// All manners.
    pub const ALL: [Self; 8] =
        [Self::Well, Self::Off, Self::Stuck, Self::Garbage, Self::Wrong, Self::Slow, Self::Delayed, Self::Intermittent];
}

/// An accepted failure injection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Failure {
    /// The unit that fails.
    pub unit: Unit,
    /// The manner in which it fails.
    pub manner: Manner,
    /// Instance of the unit, from 0; `None` for all instances.
    pub instance: Option<u8>,
}

/// Failures between two ticks.
pub type Failures = heapless::Vec<Failure, 4>;

/// The failures that a board can inject: manners and number of instances per unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Injectable {
    /// One bit per manner, for each unit.
    manners: [u8; Unit::ALL.len()],
    count: [u8; Unit::ALL.len()],
}

impl Injectable {
    /// None.
    pub const NONE: Self = Self { manners: [0; Unit::ALL.len()], count: [0; Unit::ALL.len()] };

    /// Adds `count` instances of a unit with these manners. [`Manner::Well`] is always included.
    #[must_use]
    pub fn with(mut self, unit: Unit, count: u8, manners: &[Manner]) -> Self {
        let bits = manners.iter().fold(1 << Manner::Well as u8, |bits, manner| bits | 1 << *manner as u8);
        if let (Some(has), Some(number)) = (self.manners.get_mut(unit as usize), self.count.get_mut(unit as usize)) {
            (*has, *number) = (bits, count);
        }
        self
    }

    /// Whether the board can inject no failure.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// Whether a unit can fail in a manner.
    pub fn allows(&self, unit: Unit, manner: Manner) -> bool {
        self.manners.get(unit as usize).is_some_and(|bits| bits & 1 << manner as u8 != 0)
    }

    /// Number of instances of a unit.
    pub fn count(&self, unit: Unit) -> u8 {
        self.count.get(unit as usize).copied().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_declared_failures_are_allowed() {
        let injectable = Injectable::NONE.with(Unit::Gnss, 1, &[Manner::Off]).with(Unit::Motor, 4, &[Manner::Slow]);
        assert!(!injectable.is_none() && Injectable::default().is_none());
        for unit in Unit::ALL {
            for manner in Manner::ALL {
                let said = matches!(
                    (unit, manner),
                    (Unit::Gnss, Manner::Off | Manner::Well) | (Unit::Motor, Manner::Slow | Manner::Well)
                );
                assert_eq!(injectable.allows(unit, manner), said, "{unit:?} {manner:?}");
                assert!(!Injectable::NONE.allows(unit, manner));
            }
        }
        assert_eq!((injectable.count(Unit::Motor), injectable.count(Unit::Baro)), (4, 0));
    }
}
