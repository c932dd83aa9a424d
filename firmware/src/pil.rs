//! What host and image tell each other when the processor is in the loop: the frames and their bytes.
//!
//! ```text
//! host ── Hello ──► image      once: what to fly, and what to disturb
//! host ◄─ Answer ── image      once: ready, or why not
//! host ── Request ► image      a tick: the sample, or the end
//! host ◄─ Reply ─── image      a tick: what the inner task has done
//! ```
//!
//! Every frame has a fixed size, so that it crosses in one file call; numbers are little-endian 32-bit words.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::airframe::ROTORS;
use crate::autopilot::InnerTask;
use crate::inner::InnerOutput;
use crate::signals::{ControlInput, MotorCommand, NavState, SensorFrame, Tick};

/// Changes with every change of a frame, so that host and image of different versions refuse each other.
pub const VERSION: u32 = 3;

/// Bytes of a [`Request`].
pub const REQUEST_BYTES: usize = 4 * REQUEST_WORDS;
/// Bytes of a [`Reply`].
pub const REPLY_BYTES: usize = 4 * REPLY_WORDS;

const REQUEST_WORDS: usize = 14;
const REPLY_WORDS: usize = 20;

/// What the host asks for in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Request {
    /// Fly a tick with this sample.
    Sample(SensorFrame),
    /// Fly a tick without a sample.
    Missing,
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
            inner: InnerOutput::IDLE,
            s_position: Vector3::zeros(),
            overruns: [0; 3],
        }
    }

    /// As bytes.
    pub fn encode(&self) -> [u8; REPLY_BYTES] {
        let mut words = Writer { words: [0; REPLY_WORDS], at: 0 };
        words.put(self.tick);
        words.put(match self.state {
            State::Flying => 0,
            State::Stopped(Cause::Panic) => 1,
            State::Stopped(Cause::HardFault) => 2,
        });
        words.put_all(&self.inner.motors.omega_rad_s);
        words.put_all(&self.inner.demand.as_array());
        words.put_all(self.inner.s.as_ref());
        words.put(u32::from(self.inner.saturated));
        words.put_all(self.s_position.as_ref());
        for count in self.overruns {
            words.put(count);
        }
        to_bytes(&words.words)
    }

    /// From bytes; none if they are not a reply.
    pub fn decode(bytes: &[u8; REPLY_BYTES]) -> Option<Self> {
        let mut words = Reader { bytes };
        let tick = words.word()?;
        let state = match words.word()? {
            0 => State::Flying,
            1 => State::Stopped(Cause::Panic),
            2 => State::Stopped(Cause::HardFault),
            _ => return None,
        };
        let motors = MotorCommand { omega_rad_s: words.numbers::<ROTORS>()? };
        let [thrust_n, roll_n_m, pitch_n_m, yaw_n_m] = words.numbers()?;
        let demand = ControlInput { thrust_n, roll_n_m, pitch_n_m, yaw_n_m };
        let s = words.numbers::<3>()?.into();
        let saturated = words.word()? != 0;
        let s_position = words.numbers::<3>()?.into();
        let overruns = [words.word()?, words.word()?, words.word()?];
        Some(Self { tick, state, inner: InnerOutput { motors, demand, s, saturated }, s_position, overruns })
    }
}

impl Request {
    /// As bytes.
    pub fn encode(&self) -> [u8; REQUEST_BYTES] {
        let mut words = Writer { words: [0; REQUEST_WORDS], at: 0 };
        match self {
            Self::Sample(SensorFrame::Motion(nav)) => {
                let q = nav.attitude.quaternion();
                words.put(0);
                words.put_all(nav.position.as_ref());
                words.put_all(nav.velocity.as_ref());
                words.put_all(&[q.w, q.i, q.j, q.k]);
                words.put_all(nav.rates.as_ref());
            }
            // Not yet flown with the processor in the loop.
            Self::Sample(SensorFrame::Measured(_)) | Self::Missing => words.put(1),
            Self::Exit => words.put(2),
        }
        to_bytes(&words.words)
    }

    /// From bytes; none if they are not a request. The sample is as the host sent it: the inner partition
    /// refuses one that is not valid.
    pub fn decode(bytes: &[u8; REQUEST_BYTES]) -> Option<Self> {
        let mut words = Reader { bytes };
        match words.word()? {
            0 => {
                let (position, velocity) = (words.numbers::<3>()?.into(), words.numbers::<3>()?.into());
                let [w, i, j, k] = words.numbers()?;
                let attitude = UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k));
                let rates = words.numbers::<3>()?.into();
                Some(Self::Sample(SensorFrame::Motion(NavState { position, velocity, attitude, rates })))
            }
            1 => Some(Self::Missing),
            2 => Some(Self::Exit),
            _ => None,
        }
    }
}

struct Writer<const N: usize> {
    words: [u32; N],
    at: usize,
}

impl<const N: usize> Writer<N> {
    fn put(&mut self, word: u32) {
        if let Some(slot) = self.words.get_mut(self.at) {
            *slot = word;
            self.at += 1;
        }
    }

    fn put_all(&mut self, numbers: &[f32]) {
        for number in numbers {
            self.put(number.to_bits());
        }
    }
}

fn to_bytes<const WORDS: usize, const BYTES: usize>(words: &[u32; WORDS]) -> [u8; BYTES] {
    let mut bytes = [0; BYTES];
    for (to, from) in bytes.chunks_exact_mut(4).zip(words) {
        to.copy_from_slice(&from.to_le_bytes());
    }
    bytes
}

struct Reader<'a> {
    bytes: &'a [u8],
}

impl Reader<'_> {
    fn word(&mut self) -> Option<u32> {
        let (word, rest) = self.bytes.split_first_chunk()?;
        self.bytes = rest;
        Some(u32::from_le_bytes(*word))
    }

    fn numbers<const N: usize>(&mut self) -> Option<[f32; N]> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = f32::from_bits(self.word()?);
        }
        Some(numbers)
    }
}

#[cfg(feature = "pil-wire")]
pub use hello::{Answer, BusyWait, Fault, HELLO_BYTES, Hello, HelloError};

#[cfg(feature = "pil-wire")]
mod hello {
    use serde::{Deserialize, Serialize};

    use super::{REPLY_BYTES, VERSION};
    use crate::config::FlightConfig;
    use crate::signals::Tick;

    /// Bytes of an encoded [`Hello`]: version, length, content, zeros.
    pub const HELLO_BYTES: usize = 1024;
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
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers<const N: usize>(first: f32) -> [f32; N] {
        core::array::from_fn(|i| first + i as f32 * 0.1)
    }

    #[test]
    fn a_request_survives_its_bytes() {
        let [w, i, j, k] = numbers(0.3);
        let nav = NavState {
            position: numbers::<3>(1.0).into(),
            velocity: [f32::NAN, -0.0, f32::MIN_POSITIVE / 2.0].into(),
            attitude: UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k)),
            rates: numbers::<3>(4.0).into(),
        };
        let bytes = Request::Sample(SensorFrame::Motion(nav)).encode();
        // Compared as bytes: the sample holds a NaN.
        assert_eq!(Request::decode(&bytes).map(|request| request.encode()), Some(bytes));
        for request in [Request::Missing, Request::Exit] {
            assert_eq!(Request::decode(&request.encode()), Some(request));
        }
        assert_eq!(Request::decode(&[9; REQUEST_BYTES]), None);
    }

    #[test]
    fn a_reply_survives_its_bytes() {
        let [thrust_n, roll_n_m, pitch_n_m, yaw_n_m] = numbers(2.0);
        let reply = Reply {
            tick: 77,
            state: State::Flying,
            inner: InnerOutput {
                motors: MotorCommand { omega_rad_s: numbers(10.0) },
                demand: ControlInput { thrust_n, roll_n_m, pitch_n_m, yaw_n_m },
                s: numbers::<3>(-1.0).into(),
                saturated: true,
            },
            s_position: numbers::<3>(7.0).into(),
            overruns: [1, 2, 3],
        };
        assert_eq!(Reply::decode(&reply.encode()), Some(reply));
        for cause in [Cause::Panic, Cause::HardFault] {
            assert_eq!(Reply::decode(&Reply::stopped(cause).encode()), Some(Reply::stopped(cause)));
        }
        assert_eq!(Reply::decode(&[9; REPLY_BYTES]), None);
    }

    #[cfg(feature = "pil-wire")]
    #[test]
    fn a_hello_survives_its_bytes_and_a_bad_one_is_refused() {
        let hello = Hello {
            config: crate::config::FlightConfig::default(),
            busy: BusyWait { outer_us: 1, commander_us: 2, ground_us: 3 },
            fault: Some((5, Fault::Panic)),
        };
        let bytes = hello.encode().expect("fits");
        assert_eq!(Hello::decode(&bytes), Ok(hello));
        let mut other = bytes;
        other[0] ^= 1;
        assert_eq!(Hello::decode(&other), Err(HelloError::Version));
        let mut long = bytes;
        long[4..8].copy_from_slice(&u32::MAX.to_le_bytes());
        assert_eq!(Hello::decode(&long), Err(HelloError::Malformed));
        let mut short = bytes;
        short[4..8].copy_from_slice(&9_u32.to_le_bytes());
        assert_eq!(Hello::decode(&short), Err(HelloError::Malformed));
    }

    #[cfg(feature = "pil-wire")]
    #[test]
    fn a_long_reason_is_cut() {
        let answer = Answer::refused(&core::iter::repeat_n('x', 200).collect::<String>());
        assert_eq!(Answer::decode(&answer.encode()), Some(answer.clone()));
        assert!(matches!(answer, Answer::Refused(text) if text.len() == REPLY_BYTES - 4));
        assert_eq!(Answer::decode(&Answer::Ready.encode()), Some(Answer::Ready));
    }
}
