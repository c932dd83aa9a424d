//! Inputs of which only the latest counts: sticks, a radio's channels, and when a ground station was last heard.
//!
//! They are the third path of inputs, beside kills (a count) and requests (a queue). Whoever reads one overwrites the
//! last, with the time; it comes with the snapshots of the outer partition and of the commander, which judge its age by
//! their own clock. So nothing queues: from the bytes of a stick message to the rotors it takes 20 ms at most (see
//! [`schedule`](crate::schedule)). The commander selects only whom the vehicle obeys. A set-point that a ground station
//! streams is to be a field of [`Latest`] too.

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

/// Channels of a radio.
pub const CHANNELS: usize = 18;

/// Pulse widths of a radio's channels, µs; `None` for one that is not there.
pub type Channels = [Option<PulseUs>; CHANNELS];

/// A pulse width, µs: never 0, so that its absence takes no space.
pub type PulseUs = core::num::NonZeroU16;

/// Sticks. An axis is `None` if its source does not tell it, and in its range otherwise.
///
/// Axes have the signs of rotations in the body frame, forward, left, up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sticks {
    /// −1 to 1, positive to the right: right side down.
    pub roll: Option<f32>,
    /// −1 to 1, positive forward: nose down.
    pub pitch: Option<f32>,
    /// −1 to 1, positive to the left: nose to the left.
    pub yaw: Option<f32>,
    /// 0 to 1, positive up.
    pub throttle: Option<f32>,
    /// Pressed buttons, a bit each.
    pub buttons: u16,
}

/// What was read last of each.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Latest {
    /// The sticks of a joystick; `None` if there were none.
    pub sticks: Option<Stamped<Sticks>>,
    /// A radio's channels, none of them lost when the last came; `None` if there were none, or if all have been released.
    pub channels: Option<Stamped<Channels>>,
    /// When a ground station was last heard, on whatever link; `None` if none ever was.
    pub station: Option<Tick>,
}

impl Latest {
    /// Forgets what is so old that its age would soon seem to be small, because the clock wraps.
    pub fn forget_old(&mut self, now: Tick) {
        let is_old = |at: Tick| now.wrapping_sub(at) > Tick::MAX / 2;
        self.sticks = self.sticks.filter(|sticks| !is_old(sticks.at));
        self.channels = self.channels.filter(|channels| !is_old(channels.at));
        self.station = self.station.filter(|at| !is_old(*at));
    }

    /// The sticks, unless they are older than a time, s.
    pub fn sticks_within(&self, now: Tick, limit_s: f32) -> Option<&Sticks> {
        within(self.sticks.as_ref(), now, limit_s)
    }

    /// A radio's channels, unless they are older than a time, s.
    pub fn channels_within(&self, now: Tick, limit_s: f32) -> Option<&Channels> {
        within(self.channels.as_ref(), now, limit_s)
    }
}

fn within<T>(latest: Option<&Stamped<T>>, now: Tick, limit_s: f32) -> Option<&T> {
    latest.filter(|latest| !is_older(latest.at, now, limit_s)).map(|latest| &latest.value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sticks_are_there_as_long_as_they_are_no_older_than_the_limit_also_when_the_clock_wraps() {
        for at in [0, 1_000, Tick::MAX - 100] {
            let latest = Latest { sticks: Some(Stamped { value: Sticks::default(), at }), ..Latest::default() };
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
            sticks: Some(Stamped { value: Sticks::default(), at: 7 }),
            channels: Some(Stamped { value: Channels::default(), at: 7 }),
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
        assert!(size_of::<Latest>() <= 96, "{} bytes", size_of::<Latest>());
    }
}
