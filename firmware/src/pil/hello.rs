//! The one frame each way before a flight: what to fly, and whether the image will.

use serde::{Deserialize, Serialize};

use super::{REPLY_BYTES, VERSION};
use crate::config::FlightConfig;
use crate::guidance::CONTROL_POINTS;
use crate::signals::Tick;

/// Bytes of an encoded [`Hello`]: version, length, content, zeros.
pub const HELLO_BYTES: usize = 2048 + 16 * CONTROL_POINTS;
const TEXT_BYTES: usize = REPLY_BYTES - 4;

/// What to fly, and what to disturb.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hello {
    /// What to fly.
    pub config: FlightConfig,
    /// Work that the partitions pretend to have.
    pub busy: BusyWait,
    /// What the outer partition's job at that tick does to the image.
    pub fault: Option<(Tick, Fault)>,
}

/// Time by which a partition's jobs are made longer, µs of the image's time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct BusyWait {
    /// Of guidance and position control.
    pub outer_us: u32,
    /// Of the commander.
    pub commander_us: u32,
    /// Of MAVLink.
    pub ground_us: u32,
}

/// Ways to end an image, to show that it stops the rotors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Fault {
    /// A panic.
    Panic,
    /// An instruction that the core does not have.
    UndefinedInstruction,
    /// A recursion without end.
    StackOverflow,
}

/// Why a hello cannot be written or read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HelloError {
    /// It does not fit.
    TooLong,
    /// It is of another version.
    Version,
    /// It is not a hello.
    Malformed,
}

impl Hello {
    /// As bytes.
    ///
    /// # Errors
    /// [`HelloError::TooLong`] if they are more than [`HELLO_BYTES`].
    pub fn encode(&self) -> Result<[u8; HELLO_BYTES], HelloError> {
        let mut bytes = [0; HELLO_BYTES];
        let (head, content) = bytes.split_at_mut(8);
        let length = postcard::to_slice(self, content).map_err(|_| HelloError::TooLong)?.len();
        let (version, size) = head.split_at_mut(4);
        version.copy_from_slice(&VERSION.to_le_bytes());
        size.copy_from_slice(&(length as u32).to_le_bytes());
        Ok(bytes)
    }

    /// From bytes.
    ///
    /// # Errors
    /// What is wrong with them. The configuration is not yet validated.
    pub fn decode(bytes: &[u8; HELLO_BYTES]) -> Result<Self, HelloError> {
        let (version, rest) = bytes.split_first_chunk().ok_or(HelloError::Malformed)?;
        if u32::from_le_bytes(*version) != VERSION {
            return Err(HelloError::Version);
        }
        let (length, rest) = rest.split_first_chunk().ok_or(HelloError::Malformed)?;
        let content = rest.get(..u32::from_le_bytes(*length) as usize).ok_or(HelloError::Malformed)?;
        postcard::from_bytes(content).map_err(|_| HelloError::Malformed)
    }
}

impl core::fmt::Display for HelloError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::TooLong => "the flight does not fit into its frame",
            Self::Version => "host and image are of different versions",
            Self::Malformed => "the flight's frame cannot be read",
        })
    }
}

/// The image's answer to a hello.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// The first request may come.
    Ready,
    /// It will not fly, for that reason.
    Refused(heapless::String<TEXT_BYTES>),
}

impl Answer {
    /// A refusal with its reason, cut short if it is long.
    pub fn refused(reason: &impl core::fmt::Display) -> Self {
        let mut text = Cut(heapless::String::new());
        // `Cut` does not fail.
        let _ = core::fmt::write(&mut text, format_args!("{reason}"));
        Self::Refused(text.0)
    }

    /// As bytes, as many as a reply has.
    pub fn encode(&self) -> [u8; REPLY_BYTES] {
        let mut bytes = [0; REPLY_BYTES];
        if let (Self::Refused(text), Some((refused, rest))) = (self, bytes.split_first_mut()) {
            *refused = 1;
            for (to, from) in rest.iter_mut().skip(3).zip(text.bytes()) {
                *to = from;
            }
        }
        bytes
    }

    /// From bytes; none if they are not an answer.
    pub fn decode(bytes: &[u8; REPLY_BYTES]) -> Option<Self> {
        let (refused, text) = bytes.split_first_chunk::<4>()?;
        match refused {
            [0, 0, 0, 0] => Some(Self::Ready),
            [1, 0, 0, 0] => {
                let end = text.iter().position(|byte| *byte == 0).unwrap_or(text.len());
                let text = core::str::from_utf8(text.get(..end)?).ok()?;
                Some(Self::Refused(heapless::String::try_from(text).ok()?))
            }
            _ => None,
        }
    }
}

/// Takes as much of a text as fits.
struct Cut(heapless::String<TEXT_BYTES>);

impl core::fmt::Write for Cut {
    fn write_str(&mut self, text: &str) -> core::fmt::Result {
        for character in text.chars() {
            if self.0.push(character).is_err() {
                break;
            }
        }
        Ok(())
    }
}
