//! Failures that a ground station asks for, to see what the vehicle makes of them (`MAV_CMD_INJECT_FAILURE`).
//!
//! The firmware itself has nothing to make fail. A board that has says so with
//! [`InnerTask::allow_failures`](crate::autopilot::InnerTask::allow_failures); the ground partition accepts these failures
//! and refuses all others, and what it has accepted the board takes each tick
//! ([`take_failures`](crate::autopilot::InnerTask::take_failures)) and must do: the sender has been told that it is done.

/// What is to fail.
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
    /// All of them.
    pub const ALL: [Self; 7] = [Self::Gyro, Self::Accel, Self::Mag, Self::Baro, Self::Gnss, Self::Battery, Self::Motor];
}

/// How it is to fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Manner {
    /// Not at all: what has failed on request is well again.
    Well,
    /// It stops.
    Off,
    /// It stays at what it was.
    Stuck,
    /// What comes is random.
    Garbage,
    /// What comes is wrong.
    Wrong,
    /// It works, but slowly.
    Slow,
    /// What comes, comes late.
    Delayed,
    /// Some of what should come does not.
    Intermittent,
}

impl Manner {
    /// All of them.
    pub const ALL: [Self; 8] =
        [Self::Well, Self::Off, Self::Stuck, Self::Garbage, Self::Wrong, Self::Slow, Self::Delayed, Self::Intermittent];
}

/// A failure that was accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Failure {
    /// What.
    pub unit: Unit,
    /// How.
    pub manner: Manner,
    /// Which of several, from 0; `None` for all of them.
    pub instance: Option<u8>,
}

/// Failures between two ticks.
pub type Failures = heapless::Vec<Failure, 4>;

/// The failures that a board can inject: for each unit the manners, and how many there are of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Injectable {
    /// By unit, a bit a manner.
    manners: [u8; Unit::ALL.len()],
    count: [u8; Unit::ALL.len()],
}

impl Injectable {
    /// Nothing: a board that cannot.
    pub const NONE: Self = Self { manners: [0; Unit::ALL.len()], count: [0; Unit::ALL.len()] };

    /// The same, and so many units of a kind in these manners. Whatever can fail can be made well.
    #[must_use]
    pub fn with(mut self, unit: Unit, count: u8, manners: &[Manner]) -> Self {
        let bits = manners.iter().fold(1 << Manner::Well as u8, |bits, manner| bits | 1 << *manner as u8);
        if let (Some(has), Some(number)) = (self.manners.get_mut(unit as usize), self.count.get_mut(unit as usize)) {
            (*has, *number) = (bits, count);
        }
        self
    }

    /// Whether there is nothing that the board can make fail.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// Whether a unit can fail in a manner.
    pub fn allows(&self, unit: Unit, manner: Manner) -> bool {
        self.manners.get(unit as usize).is_some_and(|bits| bits & 1 << manner as u8 != 0)
    }

    /// How many there are of a unit.
    pub fn count(&self, unit: Unit) -> u8 {
        self.count.get(unit as usize).copied().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_board_allows_what_it_has_said_and_nothing_else() {
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
