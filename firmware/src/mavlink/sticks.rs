//! Sticks of ground stations: `MANUAL_CONTROL` of a joystick, and `RC_CHANNELS_OVERRIDE` of a radio's channels.

use glissade_dialect::{MANUAL_CONTROL_DATA, RC_CHANNELS_DATA, RC_CHANNELS_OVERRIDE_DATA};

use super::telemetry::View;
use crate::latest::{CHANNELS, Channels, Latest, PulseUs, Stamped, Sticks, is_older};
use crate::signals::Tick;

/// An axis that a joystick does not have.
const NO_AXIS: i16 = i16::MAX;
/// Full deflection in `MANUAL_CONTROL`.
const FULL: i16 = 1000;
/// Channels that there have always been; the others were added, with numbers of their own.
const FIRST_CHANNELS: usize = 8;
/// Pulse widths that a radio can have, µs.
const PULSES_US: core::ops::RangeInclusive<u16> = 800..=2200;
/// A channel in `RC_CHANNELS` that there is not.
const NO_CHANNEL: u16 = u16::MAX;
/// Unknown strength of a signal.
const NO_RSSI: u8 = u8::MAX;

/// What a message says of a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Channel {
    /// Nothing: it stays as it is.
    Ignored,
    /// The ground station lets go of it.
    Released,
    /// Its pulse width.
    Set(PulseUs),
}

/// A message of sticks, its values in their ranges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum StickMessage {
    /// All that a joystick has.
    Joystick(Sticks),
    /// Some of a radio's channels.
    Channels([Channel; CHANNELS]),
}

/// The sticks of a joystick; `None` if a value is out of range. Pitch is positive forward, roll and yaw to the right, as
/// QGroundControl sends them and PX4 takes them; MAVLink's text has yaw the other way round.
pub(super) fn of_joystick(m: &MANUAL_CONTROL_DATA) -> Option<StickMessage> {
    let axis = |value: i16, lowest: i16| match value {
        NO_AXIS => Some(None),
        value if (lowest..=FULL).contains(&value) => Some(Some(f32::from(value) / f32::from(FULL))),
        _ => None,
    };
    Some(StickMessage::Joystick(Sticks {
        roll: axis(m.y, -FULL)?,
        pitch: axis(m.x, -FULL)?,
        yaw: axis(m.r, -FULL)?.map(|right| -right),
        throttle: axis(m.z, 0)?,
        buttons: m.buttons,
    }))
}

/// The channels of an override; `None` if a pulse width is none that a radio can have.
pub(super) fn of_channels(m: &RC_CHANNELS_OVERRIDE_DATA) -> Option<StickMessage> {
    let raw = [
        m.chan1_raw,
        m.chan2_raw,
        m.chan3_raw,
        m.chan4_raw,
        m.chan5_raw,
        m.chan6_raw,
        m.chan7_raw,
        m.chan8_raw,
        m.chan9_raw,
        m.chan10_raw,
        m.chan11_raw,
        m.chan12_raw,
        m.chan13_raw,
        m.chan14_raw,
        m.chan15_raw,
        m.chan16_raw,
        m.chan17_raw,
        m.chan18_raw,
    ];
    let mut channels = [Channel::Ignored; CHANNELS];
    for (index, (channel, us)) in channels.iter_mut().zip(raw).enumerate() {
        let released = if index < FIRST_CHANNELS { us == 0 } else { us == u16::MAX - 1 };
        *channel = match PulseUs::new(us) {
            _ if released => Channel::Released,
            None => Channel::Ignored,
            Some(_) if us == u16::MAX => Channel::Ignored,
            Some(pulse) if PULSES_US.contains(&us) => Channel::Set(pulse),
            Some(_) => return None,
        };
    }
    Some(StickMessage::Channels(channels))
}

/// Who moves sticks: a MAVLink system on a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Source {
    /// The link.
    pub(super) link: u8,
    /// The system.
    pub(super) system: u8,
}

/// From whom sticks and channels come, and since when each channel has been as it is.
#[derive(Clone, Debug, Default)]
pub(super) struct Hands {
    joystick: Option<Source>,
    radio: Option<Source>,
    set_at: [Tick; CHANNELS],
}

impl Hands {
    /// Takes over a message that was read at a tick. While nothing of a source is older than `loss_s`, no other one of its
    /// kind counts: the vehicle would be moved by both in turn.
    pub(super) fn take(&mut self, message: &StickMessage, from: Source, now: Tick, loss_s: f32, latest: &mut Latest) {
        match message {
            StickMessage::Joystick(sticks) => {
                if latest.sticks_within(now, loss_s).is_none() || self.joystick == Some(from) {
                    self.joystick = Some(from);
                    latest.sticks = Some(Stamped { value: *sticks, at: now });
                }
            }
            StickMessage::Channels(message) => {
                let held = latest.channels_within(now, loss_s).copied();
                let says_something = message.iter().any(|said| *said != Channel::Ignored);
                if says_something && (held.is_none() || self.radio == Some(from)) {
                    self.radio = Some(from);
                    let channels = self.channels(held.unwrap_or_default(), message, now, loss_s);
                    let are_there = channels != Channels::default();
                    latest.channels = are_there.then_some(Stamped { value: channels, at: now });
                }
            }
        }
    }

    /// The channels after a message. One that it ignores stays as it is, unless it was lost.
    fn channels(&mut self, held: Channels, message: &[Channel; CHANNELS], now: Tick, loss_s: f32) -> Channels {
        let mut channels = held;
        for ((channel, set_at), said) in channels.iter_mut().zip(&mut self.set_at).zip(message) {
            match said {
                Channel::Ignored if is_older(*set_at, now, loss_s) => *channel = None,
                Channel::Ignored => {}
                Channel::Released => *channel = None,
                Channel::Set(pulse) => (*channel, *set_at) = (Some(*pulse), now),
            }
        }
        channels
    }
}

/// The channels, while there are any that are not lost.
pub(super) fn rc_channels(view: &View) -> Option<RC_CHANNELS_DATA> {
    let channels = view.channels()?;
    let last = channels.iter().rposition(Option::is_some)?;
    let mut raw = [NO_CHANNEL; CHANNELS];
    for (raw, channel) in raw.iter_mut().zip(channels) {
        *raw = channel.map_or(NO_CHANNEL, PulseUs::get);
    }
    let [c1, c2, c3, c4, c5, c6, c7, c8, c9, c10, c11, c12, c13, c14, c15, c16, c17, c18] = raw;
    Some(RC_CHANNELS_DATA {
        time_boot_ms: view.boot_ms(),
        chancount: last as u8 + 1,
        chan1_raw: c1,
        chan2_raw: c2,
        chan3_raw: c3,
        chan4_raw: c4,
        chan5_raw: c5,
        chan6_raw: c6,
        chan7_raw: c7,
        chan8_raw: c8,
        chan9_raw: c9,
        chan10_raw: c10,
        chan11_raw: c11,
        chan12_raw: c12,
        chan13_raw: c13,
        chan14_raw: c14,
        chan15_raw: c15,
        chan16_raw: c16,
        chan17_raw: c17,
        chan18_raw: c18,
        rssi: NO_RSSI,
    })
}
