//! What ground stations send and the vehicle passes over: commands for another system, sticks out of their range, refused
//! set-points. None of it is answered by MAVLink, and whoever has sent it waits in vain: here it is told.

use std::ops::RangeInclusive;

use firmware::mavlink::port::LINKS;
use firmware::signals::Tick;
use glissade_dialect::{MANUAL_CONTROL_DATA, MavMessage, RC_CHANNELS_OVERRIDE_DATA};

use super::commands;
use crate::link::frames::{self, LONGEST};

/// A kind of what is passed over is told of a station once in this time, ticks: sticks and set-points come as streams.
const TELL_EVERY: Tick = 5_000;
/// More that was told is not kept: the oldest is told again.
const TOLD_MAX: usize = 64;
/// An axis that a joystick does not have.
const NO_AXIS: i16 = i16::MAX;

/// What is passed over, as far as one is told apart from another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    ForAnother,
    Sticks,
    SetPoint,
}

/// Who has sent something: a link, and a MAVLink system on it.
type Sender = (usize, u8);

/// Reads along.
#[derive(Clone, Debug)]
pub(super) struct Overheard {
    /// Systems of this vehicle and of those that fly beside it: what is for another of them is no mistake.
    systems: RangeInclusive<u8>,
    /// The beginning of a frame that is still to come, of each link.
    rest: [Vec<u8>; LINKS],
    /// Who has sent a set-point last, on each link.
    leaders: [Option<u8>; LINKS],
    /// What was told, and when.
    told: Vec<(Kind, Sender, Tick)>,
}

impl Overheard {
    /// Of vehicles with these systems.
    pub(super) fn of(systems: RangeInclusive<u8>) -> Self {
        Self { systems, rest: Default::default(), leaders: [None; LINKS], told: Vec::new() }
    }

    /// Reads what comes on a link before a tick, and tells of what the vehicle passes over, with who has sent it.
    pub(super) fn read(&mut self, tick: Tick, link: usize, bytes: &[u8], tell: &mut impl FnMut(u8, String)) {
        let Some(rest) = self.rest.get_mut(link) else { return };
        let mut stream = core::mem::take(rest);
        stream.extend_from_slice(bytes);
        let mut end = 0;
        for frame in frames::whole(&stream) {
            end = frame.range.end;
            let message = frames::message(&stream[frame.range.clone()]).filter(|_| frame.valid);
            if let Some((kind, text)) = message.and_then(|message| self.judge(link, frame.system, &message))
                && self.is_news(kind, (link, frame.system), tick)
            {
                tell(frame.system, text);
            }
        }
        let left = &stream[end.max(stream.len().saturating_sub(LONGEST))..];
        self.rest[link].extend_from_slice(left);
    }

    /// Who has sent a set-point that the vehicle refuses on a link, unless that was told a moment ago.
    pub(super) fn refused_set_point(&mut self, tick: Tick, link: usize) -> Option<u8> {
        let system = self.leaders.get(link).copied().flatten()?;
        self.is_news(Kind::SetPoint, (link, system), tick).then_some(system)
    }

    /// Whether it was not told a moment ago; from now on it was.
    fn is_news(&mut self, kind: Kind, sender: Sender, tick: Tick) -> bool {
        self.told.retain(|(.., at)| tick.wrapping_sub(*at) < TELL_EVERY);
        if self.told.iter().any(|(known, who, _)| (*known, *who) == (kind, sender)) {
            return false;
        }
        if self.told.len() == TOLD_MAX {
            self.told.remove(0);
        }
        self.told.push((kind, sender, tick));
        true
    }

    /// Why a message is passed over, if it is.
    fn judge(&mut self, link: usize, system: u8, message: &MavMessage) -> Option<(Kind, String)> {
        let (target, what) = addressed(message)?;
        if target != 0 && !self.systems.contains(&target) {
            return Some((Kind::ForAnother, format!("{what}: ignored, it is for system {target}; {}", self.here())));
        }
        match message {
            MavMessage::MANUAL_CONTROL(_) | MavMessage::RC_CHANNELS_OVERRIDE(_) if target == 0 => {
                Some((Kind::ForAnother, format!("{what}: ignored, it is for every system; {}", self.here())))
            }
            MavMessage::RC_CHANNELS_OVERRIDE(channels) => {
                let (channel, us) = no_pulse(channels)?;
                Some((Kind::Sticks, format!("{what}: ignored, channel {channel} must be 800 to 2200 us, not {us}")))
            }
            MavMessage::MANUAL_CONTROL(sticks) => {
                let (axis, value, low) = out_of_range(sticks)?;
                Some((Kind::Sticks, format!("{what}: ignored, {axis} must be between {low} and 1000, not {value}")))
            }
            MavMessage::SET_POSITION_TARGET_LOCAL_NED(_)
            | MavMessage::SET_POSITION_TARGET_GLOBAL_INT(_)
            | MavMessage::SET_ATTITUDE_TARGET(_) => {
                self.leaders[link] = Some(system);
                None
            }
            _ => None,
        }
    }

    /// Which systems there are.
    fn here(&self) -> String {
        match (self.systems.start(), self.systems.end()) {
            (first, last) if first == last => format!("the vehicle is {first}"),
            (first, last) => format!("the vehicles are {first} to {last}"),
        }
    }
}

/// The system that a message is for, of those whose loss somebody would miss, and what it is.
fn addressed(message: &MavMessage) -> Option<(u8, String)> {
    let command = |number: u16| {
        let name = commands::name(number).map_or_else(String::new, |name| format!(" ({name})"));
        format!("command {number}{name}")
    };
    Some(match message {
        MavMessage::COMMAND_LONG(m) => (m.target_system, command(m.command)),
        MavMessage::COMMAND_INT(m) => (m.target_system, command(m.command)),
        MavMessage::SET_MODE(m) => (m.target_system, "SET_MODE".to_owned()),
        MavMessage::MANUAL_CONTROL(m) => (m.target, "MANUAL_CONTROL".to_owned()),
        MavMessage::RC_CHANNELS_OVERRIDE(m) => (m.target_system, "RC_CHANNELS_OVERRIDE".to_owned()),
        MavMessage::SET_POSITION_TARGET_LOCAL_NED(m) => (m.target_system, "SET_POSITION_TARGET_LOCAL_NED".to_owned()),
        MavMessage::SET_POSITION_TARGET_GLOBAL_INT(m) => (m.target_system, "SET_POSITION_TARGET_GLOBAL_INT".to_owned()),
        MavMessage::SET_ATTITUDE_TARGET(m) => (m.target_system, "SET_ATTITUDE_TARGET".to_owned()),
        _ => return None,
    })
}

/// The first of the channels that there have always been with a width that no radio has, and that, µs.
fn no_pulse(m: &RC_CHANNELS_OVERRIDE_DATA) -> Option<(usize, u16)> {
    const RELEASED: u16 = 0;
    const IGNORED: u16 = u16::MAX;
    let widths =
        [m.chan1_raw, m.chan2_raw, m.chan3_raw, m.chan4_raw, m.chan5_raw, m.chan6_raw, m.chan7_raw, m.chan8_raw];
    let is_one = |us: u16| matches!(us, RELEASED | IGNORED | 800..=2200);
    (1..).zip(widths).find(|(_, us)| !is_one(*us))
}

/// The first axis that is out of its range, its value, and the least that it may be.
fn out_of_range(sticks: &MANUAL_CONTROL_DATA) -> Option<(&'static str, i16, i16)> {
    let axes = [("x", sticks.x, -1000), ("y", sticks.y, -1000), ("z", sticks.z, 0), ("r", sticks.r, -1000)];
    axes.into_iter().find(|(_, value, low)| *value != NO_AXIS && !(*low..=1000).contains(value))
}

#[cfg(test)]
mod tests {
    use glissade_dialect::COMMAND_LONG_DATA;
    use glissade_dialect::mavlink_core::MessageData;

    use super::*;
    use crate::link::frames::Component;

    /// What is told of messages of station 255, one before each of these ticks.
    fn told(systems: RangeInclusive<u8>, ticks: &[Tick], message: &impl MessageData) -> Vec<String> {
        let (mut overheard, mut station) = (Overheard::of(systems), Component::new(255, 190));
        let mut lines = Vec::new();
        for tick in ticks {
            // In two pieces, as a stream may bring it.
            let frame = station.frame(message);
            let (first, rest) = frame.split_at(7);
            for piece in [first, rest] {
                overheard.read(*tick, 0, piece, &mut |system, text| lines.push(format!("{system}: {text}")));
            }
        }
        lines
    }

    fn arm(target_system: u8) -> COMMAND_LONG_DATA {
        COMMAND_LONG_DATA { command: 400, param1: 1.0, target_system, ..COMMAND_LONG_DATA::DEFAULT }
    }

    #[test]
    fn a_command_for_a_system_that_is_not_there_is_told() {
        let line = "255: command 400 (COMPONENT_ARM_DISARM): ignored, it is for system 4; the vehicle is 1";
        assert_eq!(told(1..=1, &[0], &arm(4)), [line]);
        let line = "255: command 400 (COMPONENT_ARM_DISARM): ignored, it is for system 4; the vehicles are 1 to 3";
        assert_eq!(told(1..=3, &[0], &arm(4)), [line]);
        for target in 0..=3 {
            assert_eq!(told(1..=3, &[0], &arm(target)), [""; 0], "for all, or for one of them: {target}");
        }
    }

    #[test]
    fn a_stream_is_told_once_in_five_seconds_of_flight() {
        assert_eq!(told(1..=1, &[0, 20, 4_999], &arm(2)).len(), 1);
        assert_eq!(told(1..=1, &[0, 20, 5_000, 5_020, 10_000], &arm(2)).len(), 3);
    }

    #[test]
    fn sticks_out_of_range_are_told_with_the_axis() {
        let sticks = MANUAL_CONTROL_DATA { target: 1, ..MANUAL_CONTROL_DATA::DEFAULT };
        let low = MANUAL_CONTROL_DATA { z: -500, ..sticks.clone() };
        let line = "255: MANUAL_CONTROL: ignored, z must be between 0 and 1000, not -500";
        assert_eq!(told(1..=1, &[0], &low), [line]);
        let high = MANUAL_CONTROL_DATA { r: 1001, ..sticks.clone() };
        let line = "255: MANUAL_CONTROL: ignored, r must be between -1000 and 1000, not 1001";
        assert_eq!(told(1..=1, &[0], &high), [line]);
        let missing = MANUAL_CONTROL_DATA { x: -1000, y: NO_AXIS, z: 1000, ..sticks.clone() };
        assert_eq!(told(1..=1, &[0], &missing), [""; 0]);
        let line = "255: MANUAL_CONTROL: ignored, it is for every system; the vehicle is 1";
        assert_eq!(told(1..=1, &[0], &MANUAL_CONTROL_DATA { target: 0, ..sticks }), [line]);
        let channels = RC_CHANNELS_OVERRIDE_DATA { target_system: 1, ..RC_CHANNELS_OVERRIDE_DATA::DEFAULT };
        let well = RC_CHANNELS_OVERRIDE_DATA { chan1_raw: 1500, chan2_raw: u16::MAX, ..channels.clone() };
        assert_eq!(told(1..=1, &[0], &well), [""; 0]);
        let line = "255: RC_CHANNELS_OVERRIDE: ignored, channel 2 must be 800 to 2200 us, not 50";
        assert_eq!(told(1..=1, &[0], &RC_CHANNELS_OVERRIDE_DATA { chan2_raw: 50, ..channels }), [line]);
    }
}
