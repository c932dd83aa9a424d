//! Inputs of which only the latest counts: sticks, set-points, and when a ground station was last heard.
//!
//! They are the third path of inputs, beside kills (a count) and requests (a queue). Whoever reads one overwrites the
//! last, with the time; it comes with the snapshots of the outer partition and of the commander, which judge its age by
//! their own clock. So nothing queues: from the bytes of a stick message to the rotors it takes 20 ms at most (see
//! [`schedule`](crate::schedule)). The commander selects only whom the vehicle obeys.

use nalgebra::{UnitQuaternion, Vector3};

use crate::guidance::stream::Motion;
use crate::signals::{TICK_S, Tick};

/// A value, and when it was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamped<T> {
    /// The value.
    pub value: T,
    /// When the job that has read it was released.
    pub at: Tick,
}

/// Whether what was read at a tick is older than a time, s.
pub fn is_older(at: Tick, now: Tick, limit_s: f32) -> bool {
    now.wrapping_sub(at) as f32 * TICK_S > limit_s
}

/// Sticks and switches, of a joystick or of a radio. An axis that its source does not have is centred.
///
/// Axes have the signs of rotations in the body frame, forward, left, up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sticks {
    /// −1 to 1, positive to the right: right side down.
    pub roll: f32,
    /// −1 to 1, positive forward: nose down.
    pub pitch: f32,
    /// −1 to 1, positive to the left: nose to the left.
    pub yaw: f32,
    /// 0 to 1, positive up.
    pub throttle: f32,
    /// Pressed buttons, a bit each.
    pub buttons: u16,
    /// Switches.
    pub switches: Switches,
}

impl Sticks {
    /// All centred, nothing pressed or switched.
    pub const CENTRED: Self =
        Self { roll: 0.0, pitch: 0.0, yaw: 0.0, throttle: 0.5, buttons: 0, switches: Switches::NONE };
}

/// Switches of a radio. What it does not have is `None`, or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Switches {
    /// Position of the mode switch, from 0 to [`MODE_POSITIONS`].
    pub mode: Option<u8>,
    /// Whether the arming switch is on.
    pub arm: Option<bool>,
}

impl Switches {
    /// None.
    pub const NONE: Self = Self { mode: None, arm: None };
}

/// Positions of a mode switch.
pub const MODE_POSITIONS: u8 = 6;

/// A set-point that a companion computer has sent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SetPoint {
    /// What of a motion is wanted.
    Motion {
        /// In the world.
        motion: Motion,
        /// When it was sent, ms on the sender's clock, which wraps; `None` if it does not tell.
        sent_ms: Option<u32>,
    },
    /// An attitude, or body rates.
    Attitude(AttitudeSetPoint),
}

/// An attitude, or body rates alone, and a thrust.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttitudeSetPoint {
    /// Body to world; `None` for the rates alone.
    pub attitude: Option<UnitQuaternion<f32>>,
    /// In the body frame, rad/s.
    pub rates: Vector3<f32>,
    /// 0 to 1; the fraction with which it hovers is a setting.
    pub thrust: f32,
}

/// What was read last of each.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Latest {
    /// The sticks that count; `None` if there were none.
    pub sticks: Option<Stamped<Sticks>>,
    /// The set-point of who streams them; `None` if there was none.
    pub setpoint: Option<Stamped<SetPoint>>,
    /// Whether a radio's kill switch is on, whether its sticks count or not.
    pub kill_switch: bool,
    /// When a ground station was last heard, on whatever link; `None` if none ever was.
    pub station: Option<Tick>,
}

impl Latest {
    /// Forgets what is so old that its age would soon seem to be small, because the clock wraps.
    pub fn forget_old(&mut self, now: Tick) {
        let is_old = |at: Tick| now.wrapping_sub(at) > Tick::MAX / 2;
        self.sticks = self.sticks.filter(|sticks| !is_old(sticks.at));
        self.setpoint = self.setpoint.filter(|setpoint| !is_old(setpoint.at));
        self.station = self.station.filter(|at| !is_old(*at));
    }

    /// The sticks, unless they are older than a time, s.
    pub fn sticks_within(&self, now: Tick, limit_s: f32) -> Option<&Sticks> {
        within(self.sticks.as_ref(), now, limit_s)
    }

    /// The set-point, unless it is older than a time, s.
    pub fn setpoint_within(&self, now: Tick, limit_s: f32) -> Option<&SetPoint> {
        within(self.setpoint.as_ref(), now, limit_s)
    }
}

/// A value, unless it is older than a time, s.
pub(crate) fn within<T>(latest: Option<&Stamped<T>>, now: Tick, limit_s: f32) -> Option<&T> {
    latest.filter(|latest| !is_older(latest.at, now, limit_s)).map(|latest| &latest.value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sticks_are_there_as_long_as_they_are_no_older_than_the_limit_also_when_the_clock_wraps() {
        for at in [0, 1_000, Tick::MAX - 100] {
            let latest = Latest { sticks: Some(Stamped { value: Sticks::CENTRED, at }), ..Latest::default() };
            for (age, there) in [(0, true), (499, true), (500, true), (501, false), (100_000, false)] {
                assert_eq!(latest.sticks_within(at.wrapping_add(age), 0.5).is_some(), there, "{age} ms");
            }
            assert!(latest.sticks_within(at, 0.0).is_some(), "just read");
        }
        assert_eq!(Latest::default().sticks_within(0, 35.0), None);
    }

    #[test]
    fn what_was_read_weeks_ago_does_not_come_back() {
        let read = Latest {
            sticks: Some(Stamped { value: Sticks::CENTRED, at: 7 }),
            setpoint: Some(Stamped { value: SetPoint::Motion { motion: Motion::default(), sent_ms: None }, at: 7 }),
            kill_switch: false,
            station: Some(7),
        };
        let mut latest = read;
        latest.forget_old(7 + Tick::MAX / 2);
        assert_eq!(latest, read);
        latest.forget_old(8 + Tick::MAX / 2);
        assert_eq!(latest, Latest::default());
    }

    #[test]
    fn the_latest_values_are_small_enough_for_every_snapshot() {
        assert!(size_of::<Latest>() <= 120, "{} bytes", size_of::<Latest>());
    }
}
