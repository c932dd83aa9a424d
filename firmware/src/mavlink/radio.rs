//! A radio's channels, and which of them are sticks and switches.
//!
//! A channel's pulse is scaled by its least and greatest width and its centre (`RC1_MIN`, `RC1_MAX`, `RC1_TRIM`), with a
//! dead zone about the centre (`RC1_DZ`), and reversed by `RC1_REV`. The throttle goes from the least width to the
//! greatest, wherever its centre is.

use crate::latest::{MODE_POSITIONS, Sticks, Switches};
use crate::math;
use crate::settings::{self, RadioChannel, Settings, Value};

/// Channels of a radio.
pub(super) const CHANNELS: usize = settings::RADIO_CHANNELS;

/// Pulse widths of a radio's channels, µs; `None` for one that is not there.
pub(super) type Channels = [Option<PulseUs>; CHANNELS];

/// A pulse width, µs: never 0, so that its absence takes no space.
pub(super) type PulseUs = core::num::NonZeroU16;

/// A switch is on above this part of its range.
const ON_ABOVE: f32 = 0.5;

/// Which channels are sticks and switches, by their index, and how those of the sticks are scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RadioMap {
    roll: Option<Mapped>,
    pitch: Option<Mapped>,
    yaw: Option<Mapped>,
    throttle: Option<Mapped>,
    mode: Option<Mapped>,
    arm: Option<Mapped>,
    kill: Option<Mapped>,
}

/// A channel that is used, and how it is scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Mapped {
    index: usize,
    scale: RadioChannel,
}

impl Mapped {
    fn of(settings: &Settings, map: usize) -> Option<Self> {
        let number = settings.get(map).map_or(0, Value::int);
        let index = usize::try_from(number).ok()?.checked_sub(1)?;
        Some(Self { index, scale: settings.radio_channel(index)? })
    }

    fn pulse(&self, channels: &Channels) -> Option<f32> {
        channels.get(self.index).copied().flatten().map(|pulse| f32::from(pulse.get()))
    }

    /// −1 to 1, 0 within the dead zone about the centre.
    fn axis(&self, channels: &Channels) -> Option<f32> {
        let RadioChannel { least_us, centre_us, greatest_us, dead_zone_us, reversed } = self.scale;
        let off = self.pulse(channels)? - centre_us;
        let beyond = math::abs(off) - dead_zone_us;
        let range = if off > 0.0 { greatest_us - centre_us } else { centre_us - least_us } - dead_zone_us;
        let part = math::clamp(beyond / math::max(range, 1.0), 0.0, 1.0);
        Some(if (off < 0.0) == reversed { part } else { -part })
    }

    /// 0 to 1.
    fn part(&self, channels: &Channels) -> Option<f32> {
        let RadioChannel { least_us, greatest_us, reversed, .. } = self.scale;
        let part = (self.pulse(channels)? - least_us) / math::max(greatest_us - least_us, 1.0);
        let part = math::clamp(part, 0.0, 1.0);
        Some(if reversed { 1.0 - part } else { part })
    }
}

impl RadioMap {
    /// As the settings say.
    pub(super) fn of(settings: &Settings) -> Self {
        let mapped = |map: usize| Mapped::of(settings, map);
        Self {
            roll: mapped(settings::RC_MAP_ROLL),
            pitch: mapped(settings::RC_MAP_PITCH),
            yaw: mapped(settings::RC_MAP_YAW),
            throttle: mapped(settings::RC_MAP_THROTTLE),
            mode: mapped(settings::RC_MAP_FLTMODE),
            arm: mapped(settings::RC_MAP_ARM_SW),
            kill: mapped(settings::RC_MAP_KILL_SW),
        }
    }

    /// The channel of the kill switch, by its index.
    pub(super) fn kill_channel(&self) -> Option<usize> {
        self.kill.map(|mapped| mapped.index)
    }

    /// Whether the kill switch is on; `None` if its channel is not there.
    pub(super) fn kill_switch(&self, channels: &Channels) -> Option<bool> {
        self.kill.as_ref()?.part(channels).map(|part| part > ON_ABOVE)
    }

    /// The sticks; `None` while one of the four is not mapped, or its channel is not there.
    pub(super) fn sticks(&self, channels: &Channels) -> Option<Sticks> {
        let axis = |mapped: &Option<Mapped>| mapped.as_ref()?.axis(channels);
        let part = |mapped: &Option<Mapped>| mapped.as_ref()?.part(channels);
        let is_on = |mapped: &Option<Mapped>| part(mapped).map(|part| part > ON_ABOVE);
        Some(Sticks {
            roll: axis(&self.roll)?,
            pitch: axis(&self.pitch)?,
            // A radio's yaw stick to the right has the longer pulse.
            yaw: -axis(&self.yaw)?,
            throttle: part(&self.throttle)?,
            buttons: 0,
            switches: Switches {
                mode: part(&self.mode).map(|part| math::min(part * f32::from(MODE_POSITIONS), 5.0) as u8),
                arm: is_on(&self.arm),
            },
        })
    }
}
