//! What host and image tell each other when the processor is in the loop: the frames and their bytes.
//!
//! ```text
//! host ── Hello ──► image      once: what to fly, and what to disturb
//! host ◄─ Answer ── image      once: ready, or why not
//! host ── Request ► image      a tick: the sample, or the end; before it, what a pilot asks for
//! host ◄─ Reply ─── image      a tick: what the inner task has done
//! ```
//!
//! Every frame has a fixed size, so that it crosses in one file call; numbers are little-endian 32-bit words,
//! and what a frame does not need of its size is zero.

#[cfg(feature = "pil-wire")]
mod hello;
mod words;

use nalgebra::Vector3;

use crate::autopilot::InnerTask;
use crate::commander;
use crate::inner::InnerOutput;
use crate::sensors::Measurements;
use crate::signals::{NavState, SensorFrame, Tick};
#[cfg(feature = "pil-wire")]
pub use hello::{Answer, BusyWait, Fault, HELLO_BYTES, Hello, HelloError};
use words::{Reader, Words, Writer, as_words};

/// Raised with every change of what the bytes of a frame or of a flight's configuration mean. A frame that changes its
/// size changes [`VERSION`] by itself.
const LAYOUT: u32 = 5;

/// By which host and image of different versions refuse each other.
pub const VERSION: u32 = LAYOUT << 16 | (REQUEST_BYTES + REPLY_BYTES) as u32;

/// Bytes of a [`Request`].
pub const REQUEST_BYTES: usize = 4 * Request::WORDS;
/// Bytes of a [`Reply`].
pub const REPLY_BYTES: usize = 4 * Reply::WORDS;

/// What the host asks for in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Request {
    /// Fly a tick with this sample.
    Sample(SensorFrame),
    /// Fly a tick without a sample.
    Missing,
    /// Hand this to the commander before the tick, which comes with the next frame; there is no reply.
    Ask(commander::Request),
    /// End.
    Exit,
}

/// Whether the image flies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// It does.
    Flying,
    /// It has stopped the rotors for good.
    Stopped(Cause),
}

/// Why an image stops the rotors for good.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The program found itself in a state that must not be.
    Panic,
    /// The core could not go on.
    HardFault,
}

/// What the inner task has done in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reply {
    /// The tick.
    pub tick: Tick,
    /// Whether the image flies on.
    pub state: State,
    /// The motion that was controlled: as sensed, or as estimated.
    pub nav: NavState,
    /// Output of the inner partition.
    pub inner: InnerOutput,
    /// sx, sy, sz of the outer partition's output in effect, m/s.
    pub s_position: Vector3<f32>,
    /// Overruns since boot of outer, commander and ground.
    pub overruns: [u32; 3],
}

impl Reply {
    /// After [`InnerTask::tick`].
    pub fn of(flight: &InnerTask, overruns: [u32; 3]) -> Self {
        Self {
            tick: flight.next_tick().wrapping_sub(1),
            state: State::Flying,
            nav: *flight.nav(),
            inner: *flight.inner_output(),
            s_position: flight.outer_output().s,
            overruns,
        }
    }

    /// The last one of an image that has stopped.
    pub fn stopped(cause: Cause) -> Self {
        Self {
            tick: Tick::MAX,
            state: State::Stopped(cause),
            nav: NavState::at_rest(),
            inner: InnerOutput::IDLE,
            s_position: Vector3::zeros(),
            overruns: [0; 3],
        }
    }

    /// As bytes.
    pub fn encode(&self) -> [u8; REPLY_BYTES] {
        words::encode(self)
    }

    /// From bytes; none if they are not a reply.
    pub fn decode(bytes: &[u8; REPLY_BYTES]) -> Option<Self> {
        Self::read(&mut Reader::new(bytes))
    }
}

impl Request {
    /// As bytes.
    pub fn encode(&self) -> [u8; REQUEST_BYTES] {
        words::encode(self)
    }

    /// From bytes; none if they are not a request. The sample is as the host sent it: the inner partition
    /// refuses one that is not valid.
    pub fn decode(bytes: &[u8; REQUEST_BYTES]) -> Option<Self> {
        Self::read(&mut Reader::new(bytes))
    }
}

as_words!(Reply {
    tick: Tick,
    state: State,
    nav: NavState,
    inner: InnerOutput,
    s_position: Vector3<f32>,
    overruns: [u32; 3]
});

impl Words for Request {
    const WORDS: usize = 1 + words::larger(NavState::WORDS, Measurements::WORDS);

    fn write(&self, to: &mut Writer) {
        match self {
            Self::Sample(SensorFrame::Motion(nav)) => {
                to.word(0);
                nav.write(to);
            }
            Self::Sample(SensorFrame::Measured(measurements)) => {
                to.word(1);
                measurements.write(to);
            }
            Self::Missing => to.word(2),
            Self::Exit => to.word(3),
            Self::Ask(request) => {
                to.word(4);
                request.write(to);
            }
        }
    }

    fn read(from: &mut Reader) -> Option<Self> {
        match from.word()? {
            0 => Some(Self::Sample(SensorFrame::Motion(Words::read(from)?))),
            1 => Some(Self::Sample(SensorFrame::Measured(Words::read(from)?))),
            2 => Some(Self::Missing),
            3 => Some(Self::Exit),
            4 => Some(Self::Ask(Words::read(from)?)),
            _ => None,
        }
    }
}

impl Words for State {
    const WORDS: usize = 1;

    fn write(&self, to: &mut Writer) {
        to.word(match self {
            Self::Flying => 0,
            Self::Stopped(Cause::Panic) => 1,
            Self::Stopped(Cause::HardFault) => 2,
        });
    }

    fn read(from: &mut Reader) -> Option<Self> {
        match from.word()? {
            0 => Some(Self::Flying),
            1 => Some(Self::Stopped(Cause::Panic)),
            2 => Some(Self::Stopped(Cause::HardFault)),
            _ => None,
        }
    }
}

#[cfg(test)]
#[path = "pil/tests.rs"]
mod tests;
