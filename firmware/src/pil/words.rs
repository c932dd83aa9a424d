//! Encoding of the frames' fields as 32-bit words, with a fixed upper bound on their number.
//!
//! A float keeps its bit pattern, NaN included.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::airframe::ROTORS;
use crate::commander::{Asked, Goal, ManualMode, MotorTest, OrbitGoal, OrbitHeading, Request, SpeedKind};
use crate::inner::InnerOutput;
use crate::pil::Sent;
use crate::sensors::{BaroSample, BatterySample, Geodetic, GnssSample, ImuSample, MagSample, Measurements, PoseSample};
use crate::signals::{ControlInput, MotorCommand, NavState, Tick};

/// A type that is encoded as words.
pub(super) trait Words: Sized {
    /// Greatest number of words.
    const WORDS: usize;

    /// Appends the words.
    fn write(&self, to: &mut Writer);

    /// Reads the words; `None` if they encode no value of this type.
    fn read(from: &mut Reader) -> Option<Self>;
}

/// Encodes a value as the bytes of a frame, padded with zeros.
pub(super) fn encode<T: Words, const BYTES: usize>(what: &T) -> [u8; BYTES] {
    const { assert!(BYTES == 4 * T::WORDS, "the frame must have the size of its value") };
    let mut bytes = [0; BYTES];
    what.write(&mut Writer { rest: &mut bytes });
    bytes
}

/// The larger of two word counts.
pub(super) const fn larger(one: usize, other: usize) -> usize {
    if one > other { one } else { other }
}

/// Writes words to the rest of a frame.
pub(super) struct Writer<'a> {
    rest: &'a mut [u8],
}

impl Writer<'_> {
    /// Appends a word; [`encode`] has reserved room for all of them.
    pub(super) fn word(&mut self, word: u32) {
        if let Some((slot, rest)) = core::mem::take(&mut self.rest).split_first_chunk_mut() {
            *slot = word.to_le_bytes();
            self.rest = rest;
        }
    }
}

/// Reads words from the rest of a frame.
pub(super) struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    /// The next word.
    pub(super) fn word(&mut self) -> Option<u32> {
        let (word, rest) = self.rest.split_first_chunk()?;
        self.rest = rest;
        Some(u32::from_le_bytes(*word))
    }
}

impl Words for u32 {
    const WORDS: usize = 1;

    fn write(&self, to: &mut Writer) {
        to.word(*self);
    }

    fn read(from: &mut Reader) -> Option<Self> {
        from.word()
    }
}

/// Low word first.
impl Words for u64 {
    const WORDS: usize = 2;

    fn write(&self, to: &mut Writer) {
        to.word(*self as u32);
        to.word((*self >> 32) as u32);
    }

    fn read(from: &mut Reader) -> Option<Self> {
        let low = from.word()?;
        Some(Self::from(low) | Self::from(from.word()?) << 32)
    }
}

impl Words for i32 {
    const WORDS: usize = 1;

    fn write(&self, to: &mut Writer) {
        to.word(self.cast_unsigned());
    }

    fn read(from: &mut Reader) -> Option<Self> {
        from.word().map(u32::cast_signed)
    }
}

impl Words for f32 {
    const WORDS: usize = 1;

    fn write(&self, to: &mut Writer) {
        to.word(self.to_bits());
    }

    fn read(from: &mut Reader) -> Option<Self> {
        from.word().map(Self::from_bits)
    }
}

impl Words for bool {
    const WORDS: usize = 1;

    fn write(&self, to: &mut Writer) {
        to.word(u32::from(*self));
    }

    fn read(from: &mut Reader) -> Option<Self> {
        match from.word()? {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }
}

impl<T: Words + Copy + Default, const N: usize> Words for [T; N] {
    const WORDS: usize = N * T::WORDS;

    fn write(&self, to: &mut Writer) {
        for one in self {
            one.write(to);
        }
    }

    fn read(from: &mut Reader) -> Option<Self> {
        let mut all = [T::default(); N];
        for one in &mut all {
            *one = T::read(from)?;
        }
        Some(all)
    }
}

/// A flag, then the value if there is one.
impl<T: Words> Words for Option<T> {
    const WORDS: usize = 1 + T::WORDS;

    fn write(&self, to: &mut Writer) {
        self.is_some().write(to);
        if let Some(one) = self {
            one.write(to);
        }
    }

    fn read(from: &mut Reader) -> Option<Self> {
        Some(if bool::read(from)? { Some(T::read(from)?) } else { None })
    }
}

impl Words for Vector3<f32> {
    const WORDS: usize = 3;

    fn write(&self, to: &mut Writer) {
        [self.x, self.y, self.z].write(to);
    }

    fn read(from: &mut Reader) -> Option<Self> {
        <[f32; 3]>::read(from).map(Self::from)
    }
}

/// w, x, y, z, not normalised.
impl Words for UnitQuaternion<f32> {
    const WORDS: usize = 4;

    fn write(&self, to: &mut Writer) {
        let q = self.quaternion();
        [q.w, q.i, q.j, q.k].write(to);
    }

    fn read(from: &mut Reader) -> Option<Self> {
        let [w, i, j, k] = Words::read(from)?;
        Some(Self::new_unchecked(Quaternion::new(w, i, j, k)))
    }
}

/// Encodes a struct as the words of its fields, in the order given.
macro_rules! as_words {
    ($name:ident { $($field:ident: $type:ty),+ }) => {
        impl $crate::pil::words::Words for $name {
            const WORDS: usize = 0 $(+ <$type as $crate::pil::words::Words>::WORDS)+;

            fn write(&self, to: &mut $crate::pil::words::Writer) {
                $(self.$field.write(to);)+
            }

            fn read(from: &mut $crate::pil::words::Reader) -> Option<Self> {
                Some(Self { $($field: <$type as $crate::pil::words::Words>::read(from)?),+ })
            }
        }
    };
}
pub(super) use as_words;

const KINDS: [SpeedKind; 3] = [SpeedKind::Horizontal, SpeedKind::Up, SpeedKind::Down];

const HEADINGS: [OrbitHeading; 3] = [OrbitHeading::Center, OrbitHeading::Kept, OrbitHeading::Along];
const MODES: [ManualMode; 4] = [ManualMode::Acro, ManualMode::Stabilized, ManualMode::Altitude, ManualMode::Position];

fn number_in<T: PartialEq, const N: usize>(all: &[T; N], one: &T) -> f32 {
    all.iter().position(|known| known == one).map_or(0.0, |at| at as f32)
}

/// The kind, and up to five values.
impl Words for Asked {
    const WORDS: usize = 6;

    fn write(&self, to: &mut Writer) {
        let (kind, numbers) = match *self {
            Self::Request(Request::Arm { force }) => (0, [f32::from(u8::from(force)), 0.0, 0.0, 0.0, 0.0]),
            Self::Request(Request::Disarm) => (1, [0.0; 5]),
            Self::Request(Request::TakeOff { height_m }) => (2, [height_m, 0.0, 0.0, 0.0, 0.0]),
            Self::Request(Request::Hold) => (3, [0.0; 5]),
            Self::Request(Request::GoTo(goal)) => (4, goal.numbers()),
            Self::Request(Request::Velocity { velocity_m_s: [x, y, z], yaw_rate_rad_s }) => {
                (5, [x, y, z, yaw_rate_rad_s, 0.0])
            }
            Self::Request(Request::Manual(mode)) => (14, [number_in(&MODES, &mode), 0.0, 0.0, 0.0, 0.0]),
            Self::Request(Request::Offboard) => (15, [0.0; 5]),
            Self::Request(Request::TestMotor { test: MotorTest { rotor, part }, seconds }) => {
                (16, [f32::from(rotor), part, seconds, 0.0, 0.0])
            }
            Self::Request(Request::Orbit(goal)) => (17 + number_in(&HEADINGS, &goal.heading) as u32, goal.numbers()),
            Self::Request(Request::Land) => (6, [0.0; 5]),
            Self::Request(Request::LandAt(goal)) => (12, goal.numbers()),
            Self::Request(Request::Speed { kind, speed_m_s }) => {
                (13, [number_in(&KINDS, &kind), speed_m_s.unwrap_or(f32::NAN), 0.0, 0.0, 0.0])
            }
            Self::Request(Request::Return) => (7, [0.0; 5]),
            Self::Request(Request::Follow) => (8, [0.0; 5]),
            Self::Kill => (9, [0.0; 5]),
            Self::Request(Request::SetHome { position_m: None }) => (10, [0.0; 5]),
            Self::Request(Request::SetHome { position_m: Some([x, y, z]) }) => (11, [x, y, z, 0.0, 0.0]),
        };
        to.word(kind);
        numbers.write(to);
    }

    fn read(from: &mut Reader) -> Option<Self> {
        let kind = from.word()?;
        let [x, y, z, w, v] = Words::read(from)?;
        Some(Self::Request(match kind {
            0 => Request::Arm { force: x != 0.0 },
            1 => Request::Disarm,
            2 => Request::TakeOff { height_m: x },
            3 => Request::Hold,
            4 => Request::GoTo(Goal::of_numbers([x, y, z, w, v])),
            5 => Request::Velocity { velocity_m_s: [x, y, z], yaw_rate_rad_s: w },
            6 => Request::Land,
            7 => Request::Return,
            8 => Request::Follow,
            9 => return Some(Self::Kill),
            10 => Request::SetHome { position_m: None },
            11 => Request::SetHome { position_m: Some([x, y, z]) },
            15 => Request::Offboard,
            17..20 => Request::Orbit(OrbitGoal::of_numbers([x, y, z, w, v], *HEADINGS.get(kind as usize - 17)?)),
            16 => Request::TestMotor { test: MotorTest { rotor: x as u8, part: y }, seconds: z },
            14 => Request::Manual(*MODES.get(x as usize)?),
            12 => Request::LandAt(Goal::of_numbers([x, y, z, w, v])),
            13 => Request::Speed { kind: *KINDS.get(x as usize)?, speed_m_s: Some(y).filter(|y| !y.is_nan()) },
            _ => return None,
        }))
    }
}

type Vector = Vector3<f32>;
type Attitude = UnitQuaternion<f32>;

as_words!(Sent { bytes: u32, checksum: u32 });
as_words!(NavState { position: Vector, velocity: Vector, attitude: Attitude, rates: Vector });
as_words!(InnerOutput { motors: MotorCommand, demand: ControlInput, s: Vector, saturated: bool });
as_words!(MotorCommand { omega_rad_s: [f32; ROTORS] });
as_words!(ControlInput { thrust_n: f32, roll_n_m: f32, pitch_n_m: f32, yaw_n_m: f32 });

as_words!(Measurements {
    imu: Option<ImuSample>,
    mag: Option<MagSample>,
    baro: Option<BaroSample>,
    gnss: Option<GnssSample>,
    pose: Option<PoseSample>,
    battery: Option<BatterySample>
});
as_words!(ImuSample { at: Tick, gyro: Vector, accel: Vector });
as_words!(MagSample { at: Tick, field_ut: Vector });
as_words!(BaroSample { at: Tick, pressure_pa: f32 });
as_words!(GnssSample {
    at: Tick,
    has_fix: bool,
    place: Geodetic,
    velocity: Vector,
    horizontal_accuracy_m: f32,
    vertical_accuracy_m: f32,
    speed_accuracy_m_s: f32,
    separation_mm: i32,
    utc_us: Option<u64>
});
as_words!(Geodetic { latitude_e7: i32, longitude_e7: i32, height_mm: i32 });
as_words!(PoseSample { at: Tick, position: Vector, attitude: Attitude });
as_words!(BatterySample { voltage_v: f32, current_a: f32 });
