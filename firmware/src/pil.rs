//! The wire protocol between host and image for processor in the loop.
//!
//! ```text
//! host ── Hello ──► image      once: configuration, busy-waits and faults
//! host ◄─ Answer ── image      once: ready, or why not
//! host ── Request ► image      per tick: the sample, or the end; before it what a pilot asks, and what happens on links
//! host ◄─ Reply ─── image      per tick: output of the inner task, and a checksum of all that was sent on each link
//! ```
//!
//! Every frame has a fixed size, so that it is transferred in one file call. Values are little-endian 32-bit words;
//! unused words at the end are zero.

#[cfg(feature = "pil-wire")]
mod hello;
mod link;
mod words;

use nalgebra::Vector3;

use crate::autopilot::InnerTask;
use crate::commander::Asked;
use crate::inner::InnerOutput;
use crate::sensors::Measurements;
use crate::signals::{NavState, SensorFrame, Tick};
#[cfg(feature = "pil-wire")]
pub use hello::{Answer, BusyWait, Fault, HELLO_BYTES, Hello, HelloError};
pub use link::{AllSent, PIECE_BYTES, Piece, Sent, Signal, take_sent};
use words::{Reader, Words, Writer, as_words};

/// Incremented with every change of what the bytes of a frame or of a flight's configuration mean. A frame that changes
/// its size changes [`VERSION`] by itself.
const LAYOUT: u32 = 8;

/// Protocol version: host and image of different versions refuse each other.
pub const VERSION: u32 = LAYOUT << 16 | (REQUEST_BYTES + REPLY_BYTES) as u32;

/// Bytes of a [`Request`].
pub const REQUEST_BYTES: usize = 4 * Request::WORDS;
/// Bytes of a [`Reply`].
pub const REPLY_BYTES: usize = 4 * Reply::WORDS;

/// A frame from the host.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Request {
    /// Run a tick with this sample.
    Sample(SensorFrame),
    /// Run a tick without a sample.
    Missing,
    /// Hand this to the inner task before the tick, which follows in a later frame. Has no reply.
    Ask(Asked),
    /// This happens on a link before the tick, which follows in a later frame. Has no reply.
    Link {
        /// Its number.
        link: u32,
        /// What happens.
        signal: Signal,
    },
    /// Exit.
    Exit,
}

/// State of the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Running.
    Flying,
    /// Rotors stopped for good.
    Stopped(Cause),
}

/// Why an image has stopped the rotors for good.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// A panic.
    Panic,
    /// A hard fault.
    HardFault,
}

/// Output of the inner task in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reply {
    /// The tick.
    pub tick: Tick,
    /// State of the image.
    pub state: State,
    /// The motion that the inner loop used: as sensed, or as estimated.
    pub nav: NavState,
    /// Output of the inner partition.
    pub inner: InnerOutput,
    /// sx, sy, sz of the outer partition's output in effect, m/s.
    pub s_position: Vector3<f32>,
    /// Overruns since boot of outer, commander and ground.
    pub overruns: [u32; 3],
    /// What has been sent on each link.
    pub sent: AllSent,
}

impl Reply {
    /// The reply after [`InnerTask::tick`].
    pub fn of(flight: &InnerTask, overruns: [u32; 3], sent: AllSent) -> Self {
        Self {
            tick: flight.next_tick().wrapping_sub(1),
            state: State::Flying,
            nav: *flight.nav(),
            inner: *flight.inner_output(),
            s_position: flight.outer_output().s,
            overruns,
            sent,
        }
    }

    /// The last reply of an image that has stopped.
    pub fn stopped(cause: Cause) -> Self {
        Self {
            tick: Tick::MAX,
            state: State::Stopped(cause),
            nav: NavState::at_rest(),
            inner: InnerOutput::IDLE,
            s_position: Vector3::zeros(),
            overruns: [0; 3],
            sent: AllSent::default(),
        }
    }

    /// As bytes.
    pub fn encode(&self) -> [u8; REPLY_BYTES] {
        words::encode(self)
    }

    /// From bytes; `None` if they are not a reply.
    pub fn decode(bytes: &[u8; REPLY_BYTES]) -> Option<Self> {
        Self::read(&mut Reader::new(bytes))
    }
}

impl Request {
    /// As bytes.
    pub fn encode(&self) -> [u8; REQUEST_BYTES] {
        words::encode(self)
    }

    /// From bytes; `None` if they are not a request. The sample is not checked here: the inner partition refuses an
    /// invalid one.
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
    overruns: [u32; 3],
    sent: AllSent
});

impl Words for Request {
    const WORDS: usize = 1 + words::larger(words::larger(NavState::WORDS, Measurements::WORDS), 1 + Signal::WORDS);

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
            Self::Link { link, signal } => {
                to.word(5);
                to.word(*link);
                signal.write(to);
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
            5 => Some(Self::Link { link: Words::read(from)?, signal: Words::read(from)? }),
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
