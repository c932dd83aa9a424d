//! The rows of a radio's channels: the same for each.

use super::table::{Class, Domain, Place, Setting, Value};
use super::{Settings, rows};
use crate::validate::{Field, Range};

/// Channels of a radio.
pub const RADIO_CHANNELS: usize = 18;
/// Rows of a channel.
const PER_CHANNEL: usize = 5;
/// Rows of all channels.
pub(super) const CHANNELS_COUNT: usize = PER_CHANNEL * RADIO_CHANNELS;

/// How a channel is scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadioChannel {
    /// Least pulse width, µs.
    pub least_us: f32,
    /// Pulse width of a centred stick, µs.
    pub centre_us: f32,
    /// Greatest pulse width, µs.
    pub greatest_us: f32,
    /// Pulse widths that are so close to the centre count as it, µs.
    pub dead_zone_us: f32,
    /// Whether the channel goes the other way.
    pub reversed: bool,
}

const fn row(name: &'static str, unit: &'static str, default: f32, domain: Domain, text: &'static str) -> Setting {
    let (class, default) = (Class::InFlight, Some(Value::Real(default)));
    Setting { name, unit, text, class, domain, scale: 1.0, default, key: Field::of("", ""), place: Place::Settings }
}

const LEAST: Domain = Domain::Real(Range::Within(800.0, 1500.0));
const CENTRE: Domain = Domain::Real(Range::Within(800.0, 2200.0));
const GREATEST: Domain = Domain::Real(Range::Within(1500.0, 2200.0));
const DIRECTION: Domain = Domain::Real(Range::Within(-1.0, 1.0));
const DEAD_ZONE: Domain = Domain::Real(Range::Within(0.0, 100.0));

/// The rows of the channels with these numbers.
macro_rules! channels {
    ($($number:literal)*) => {
        [$([
            row(concat!("RC", $number, "_MIN"), "us", 1000.0, LEAST, concat!("Least pulse width of channel ", $number)),
            row(concat!("RC", $number, "_TRIM"), "us", 1500.0, CENTRE, concat!("Pulse width of channel ", $number, " with a centred stick")),
            row(concat!("RC", $number, "_MAX"), "us", 2000.0, GREATEST, concat!("Greatest pulse width of channel ", $number)),
            row(concat!("RC", $number, "_REV"), "", 1.0, DIRECTION, concat!("Direction of channel ", $number, ": below 0 for a reversed one")),
            row(concat!("RC", $number, "_DZ"), "us", 10.0, DEAD_ZONE, concat!("Dead zone about the centre of channel ", $number)),
        ]),*]
    };
}

/// The rows of all channels.
pub(super) const CHANNELS: [Setting; CHANNELS_COUNT] = {
    let channels: [[Setting; PER_CHANNEL]; RADIO_CHANNELS] = channels!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18);
    let mut all = [channels[0][0]; CHANNELS_COUNT];
    let mut row = 0;
    while row < CHANNELS_COUNT {
        all[row] = channels[row / PER_CHANNEL][row % PER_CHANNEL];
        row += 1;
    }
    all
};

const FIRST_CHANNEL: usize = rows::index_of("RC1_MIN");

impl Settings {
    /// How the channel with this index, from 0, is scaled; `None` if there is no such channel.
    pub fn radio_channel(&self, index: usize) -> Option<RadioChannel> {
        if index >= RADIO_CHANNELS {
            return None;
        }
        let real = |row: usize| self.get(FIRST_CHANNEL + PER_CHANNEL * index + row).map(Value::real);
        Some(RadioChannel {
            least_us: real(0)?,
            centre_us: real(1)?,
            greatest_us: real(2)?,
            reversed: real(3)? < 0.0,
            dead_zone_us: real(4)?,
        })
    }
}
