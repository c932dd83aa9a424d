//! Sticks of ground stations: `MANUAL_CONTROL` of a joystick, and `RC_CHANNELS_OVERRIDE` of a radio's channels.

use glissade_dialect::{MANUAL_CONTROL_DATA, RC_CHANNELS_DATA, RC_CHANNELS_OVERRIDE_DATA};

use super::radio::{CHANNELS, Channels, PulseUs, RadioMap};
use super::telemetry::View;
use crate::latest::{Latest, Stamped, Sticks, Switches, is_older, within};
use crate::settings::{COM_RC_IN_MODE, Settings, Value};
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

impl Channel {
    fn pulse(self) -> Option<PulseUs> {
        match self {
            Self::Set(pulse) => Some(pulse),
            Self::Ignored | Self::Released => None,
        }
    }
}

/// A message of sticks, its values in their ranges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum StickMessage {
    /// All that a joystick has.
    Joystick(Sticks),
    /// Some of a radio's channels.
    Channels([Channel; CHANNELS]),
}

/// The sticks of a joystick, its missing axes centred; `None` if a value is out of range. Pitch is positive forward, roll and yaw to the right, as
/// QGroundControl sends them and PX4 takes them; MAVLink's text has yaw the other way round.
pub(super) fn of_joystick(m: &MANUAL_CONTROL_DATA) -> Option<StickMessage> {
    let axis = |value: i16, lowest: i16, centre: f32| match value {
        NO_AXIS => Some(centre),
        value if (lowest..=FULL).contains(&value) => Some(f32::from(value) / f32::from(FULL)),
        _ => None,
    };
    Some(StickMessage::Joystick(Sticks {
        roll: axis(m.y, -FULL, 0.0)?,
        pitch: axis(m.x, -FULL, 0.0)?,
        yaw: -axis(m.r, -FULL, 0.0)?,
        throttle: axis(m.z, 0, Sticks::CENTRED.throttle)?,
        buttons: m.buttons,
        switches: Switches::NONE,
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

/// A kind of sticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Joystick,
    Radio,
}

/// From whom sticks come, and a radio's channels.
#[derive(Clone, Debug, Default)]
pub(super) struct Hands {
    joystick: Option<Source>,
    radio: Option<Source>,
    /// Whose sticks were taken last.
    held_by: Option<Kind>,
    /// A radio's channels, none of them lost when the last came; `None` if there were none, or all have been released.
    channels: Option<Stamped<Channels>>,
    /// Since when each of them has been as it is.
    set_at: [Tick; CHANNELS],
}

/// How sticks are taken, by the settings.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taking {
    /// Age at which they are lost, s.
    pub(super) loss_s: f32,
    /// `COM_RC_IN_MODE`: 0 a radio, 1 a joystick, 2 and 3 whichever comes first until it is lost, 4 none.
    pub(super) sources: i32,
    /// What a radio's channels are.
    pub(super) radio: RadioMap,
}

/// Part of the time to the loss of sticks after which another source may take their place.
const HANDED_OVER: f32 = 0.5;

impl Taking {
    /// As the settings say.
    pub(super) fn by(settings: &Settings) -> Self {
        let sources = settings.get(COM_RC_IN_MODE).map_or(0, Value::int);
        Self { loss_s: settings.stick_loss_s(), sources, radio: RadioMap::of(settings) }
    }

    fn takes(&self, kind: Kind) -> bool {
        match kind {
            Kind::Radio => [0, 2, 3].contains(&self.sources),
            Kind::Joystick => (1..=3).contains(&self.sources),
        }
    }
}

impl Hands {
    /// Takes over a message that was read at a tick, and returns whether a kill switch was turned on by it: one of any radio
    /// counts, whoever moves the vehicle.
    pub(super) fn take(
        &mut self,
        message: &StickMessage,
        from: Source,
        now: Tick,
        taking: &Taking,
        latest: &mut Latest,
    ) -> bool {
        let is_turned_on = turn_kill_switch(message, taking, &mut latest.kill_switch);
        if let Some(sticks) = self.counted(message, from, now, taking, latest) {
            latest.sticks = Some(Stamped { value: sticks, at: now });
        }
        is_turned_on
    }

    /// The sticks of a message if they count. While a source has said something within half of `loss_s`, no other one does:
    /// the vehicle would be moved by both in turn. After that another takes its place before the sticks are lost.
    fn counted(
        &mut self,
        message: &StickMessage,
        from: Source,
        now: Tick,
        taking: &Taking,
        latest: &Latest,
    ) -> Option<Sticks> {
        let is_free = latest.sticks_within(now, HANDED_OVER * taking.loss_s).is_none();
        let (kind, sticks) = match message {
            StickMessage::Joystick(sticks) => {
                if !is_free && self.held_by == Some(Kind::Joystick) && self.joystick != Some(from) {
                    return None;
                }
                self.joystick = Some(from);
                (Kind::Joystick, Some(*sticks))
            }
            StickMessage::Channels(message) => {
                let held = within(self.channels.as_ref(), now, taking.loss_s).copied();
                let is_heard = within(self.channels.as_ref(), now, HANDED_OVER * taking.loss_s).is_some();
                let says_something = message.iter().any(|said| *said != Channel::Ignored);
                if !says_something || (is_heard && self.radio != Some(from)) {
                    return None;
                }
                self.radio = Some(from);
                let channels = self.after(held.unwrap_or_default(), message, now, taking.loss_s);
                let are_there = channels != Channels::default();
                self.channels = are_there.then_some(Stamped { value: channels, at: now });
                (Kind::Radio, taking.radio.sticks(&channels))
            }
        };
        if !taking.takes(kind) || !(is_free || self.held_by == Some(kind)) {
            return None;
        }
        let sticks = sticks?;
        self.held_by = Some(kind);
        Some(sticks)
    }

    /// A radio's channels, unless they are older than a time, s.
    pub(super) fn channels_within(&self, now: Tick, limit_s: f32) -> Option<&Channels> {
        within(self.channels.as_ref(), now, limit_s)
    }

    /// Whether there ever were channels.
    pub(super) fn has_had_channels(&self) -> bool {
        self.channels.is_some()
    }

    /// Forgets what is so old that its age would soon seem to be small, because the clock wraps.
    pub(super) fn forget_old(&mut self, now: Tick) {
        let is_old = |at: Tick| now.wrapping_sub(at) > Tick::MAX / 2;
        self.channels = self.channels.filter(|channels| !is_old(channels.at));
    }

    /// The channels after a message. One that it ignores stays as it is, unless it was lost.
    fn after(&mut self, held: Channels, message: &[Channel; CHANNELS], now: Tick, loss_s: f32) -> Channels {
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

/// Takes what a radio's message says of its kill switch, and returns whether that was turned on. It stays as it was said to
/// be last: who loses the radio with the switch on has not turned it off.
fn turn_kill_switch(message: &StickMessage, taking: &Taking, kill_switch: &mut bool) -> bool {
    let (StickMessage::Channels(said), Some(index)) = (message, taking.radio.kill_channel()) else { return false };
    let is_on = match said.get(index) {
        _ if !taking.takes(Kind::Radio) => None,
        Some(Channel::Released) => Some(false),
        _ => taking.radio.kill_switch(&said.map(Channel::pulse)),
    };
    let Some(is_on) = is_on else { return false };
    let was_on = core::mem::replace(kill_switch, is_on);
    is_on && !was_on
}

/// The channels, while there are any that are not lost.
pub(super) fn rc_channels(view: &View) -> Option<RC_CHANNELS_DATA> {
    let channels = view.channels.as_ref()?;
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
