//! The handshake before a flight: the configuration, and whether the image accepts it.

use serde::{Deserialize, Serialize};

use super::{REPLY_BYTES, VERSION};
use crate::config::FlightConfig;
use crate::failure::Injectable;
use crate::guidance::CONTROL_POINTS;
use crate::settings::{self, Settings};
use crate::signals::Tick;

/// Bytes of an encoded [`Hello`]: version, length, content, zeros.
pub const HELLO_BYTES: usize = 2048 + 16 * CONTROL_POINTS + 5 * settings::COUNT;
const TEXT_BYTES: usize = REPLY_BYTES - 4;

/// The host's first frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hello {
    /// Configuration of the flight.
    pub config: FlightConfig,
    /// Its settings: those of the configuration, and what stands in the settings alone.
    pub settings: Settings,
    /// Failures that the host can inject on behalf of the image.
    pub injectable: Injectable,
    /// Busy-waits added to the partitions' jobs.
    pub busy: BusyWait,
    /// A fault that the outer partition's job provokes from this tick on.
    pub fault: Option<(Tick, Fault)>,
}

/// Busy-wait added to each job of a partition, µs of the image's time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct BusyWait {
    /// Outer partition.
    pub outer_us: u32,
    /// Commander.
    pub commander_us: u32,
    /// Ground partition.
    pub ground_us: u32,
}

/// Faults to provoke, to test that the image stops the rotors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Fault {
    /// A panic.
    Panic,
    /// An undefined instruction.
    UndefinedInstruction,
    /// An infinite recursion.
    StackOverflow,
}

/// Error of encoding or decoding a hello.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HelloError {
    /// Too long for its frame.
    TooLong,
    /// Of another protocol version.
    Version,
    /// Not a hello.
    Malformed,
}

impl Hello {
    /// As bytes.
    ///
    /// # Errors
    /// [`HelloError::TooLong`] if it needs more than [`HELLO_BYTES`].
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
    /// [`HelloError::Version`] or [`HelloError::Malformed`]. The configuration is not validated here.
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
            Self::TooLong => "the flight's configuration does not fit into its frame",
            Self::Version => "host and image have different protocol versions",
            Self::Malformed => "the frame with the flight's configuration is malformed",
        })
    }
}

/// The image's answer to a hello.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Ready for the first request.
    Ready,
    /// Refused, with the reason.
    Refused(heapless::String<TEXT_BYTES>),
}

impl Answer {
    /// A refusal with its reason, truncated to the frame.
    pub fn refused(reason: &impl core::fmt::Display) -> Self {
        let mut text = Cut(heapless::String::new());
        // `Cut` does not fail.
        let _ = core::fmt::write(&mut text, format_args!("{reason}"));
        Self::Refused(text.0)
    }

    /// As bytes, in the size of a reply.
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

    /// From bytes; `None` if they are not an answer.
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

/// Truncates a text to its capacity.
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
