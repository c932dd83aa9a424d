//! Set-points of companion computers: `SET_POSITION_TARGET_LOCAL_NED`, `SET_POSITION_TARGET_GLOBAL_INT` and
//! `SET_ATTITUDE_TARGET`.
//!
//! A number that its mask ignores, or that is NaN, is not given. x and y are given together or not at all. What cannot be
//! flown as it stands is refused, with a text to the pilot, and is no part of the stream.

use glissade_dialect::{
    SET_ATTITUDE_TARGET_DATA, SET_POSITION_TARGET_GLOBAL_INT_DATA, SET_POSITION_TARGET_LOCAL_NED_DATA,
};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::place::is_on_earth;
use super::telemetry::{Place, View};
use crate::commander::{FARTHEST_M, FASTEST_M_S};
use crate::frames::{flip_attitude, flip_vector};
use crate::guidance::stream::Motion;
use crate::latest::{AttitudeSetPoint, SetPoint};
use crate::math;

/// Bits of `POSITION_TARGET_TYPEMASK`: the first of three axes each, of what is ignored.
const POSITION: u16 = 0;
const VELOCITY: u16 = 3;
const ACCELERATION: u16 = 6;
/// The accelerations are forces.
const FORCE: u16 = 1 << 9;
const IGNORE_YAW: u16 = 1 << 10;
const IGNORE_YAW_RATE: u16 = 1 << 11;
/// The bits that there are.
const KNOWN: u16 = (1 << 12) - 1;
/// Bits of `ATTITUDE_TARGET_TYPEMASK`.
const IGNORE_RATES: u8 = 1 | 2 | 4;
const IGNORE_THRUST: u8 = 64;
const IGNORE_ATTITUDE: u8 = 128;
/// Greatest acceleration that is taken, m/s², and rate, rad/s.
const ACCELERATION_MAX: f32 = 100.0;
const RATE_MAX: f32 = 40.0;

/// A message of a set-point, as it was sent: north, east, down; forward, right, down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SetPointMessage {
    /// `SET_POSITION_TARGET_LOCAL_NED` or `SET_POSITION_TARGET_GLOBAL_INT`.
    Motion(MotionMessage),
    /// `SET_ATTITUDE_TARGET`.
    Attitude(AttitudeMessage),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MotionMessage {
    frame: u8,
    mask: u16,
    place: PlaceMessage,
    velocity: [f32; 3],
    acceleration: [f32; 3],
    yaw: f32,
    yaw_rate: f32,
    sent_ms: u32,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum PlaceMessage {
    /// m.
    Local([f32; 3]),
    /// Latitude and longitude, 1e-7°, and height, m.
    Global([i32; 2], f32),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AttitudeMessage {
    mask: u8,
    q: [f32; 4],
    rates: [f32; 3],
    thrust: f32,
}

impl From<SET_POSITION_TARGET_LOCAL_NED_DATA> for SetPointMessage {
    fn from(m: SET_POSITION_TARGET_LOCAL_NED_DATA) -> Self {
        Self::Motion(MotionMessage {
            frame: m.coordinate_frame,
            mask: m.type_mask,
            place: PlaceMessage::Local([m.x, m.y, m.z]),
            velocity: [m.vx, m.vy, m.vz],
            acceleration: [m.afx, m.afy, m.afz],
            yaw: m.yaw,
            yaw_rate: m.yaw_rate,
            sent_ms: m.time_boot_ms,
        })
    }
}

impl From<SET_POSITION_TARGET_GLOBAL_INT_DATA> for SetPointMessage {
    fn from(m: SET_POSITION_TARGET_GLOBAL_INT_DATA) -> Self {
        Self::Motion(MotionMessage {
            frame: m.coordinate_frame,
            mask: m.type_mask,
            place: PlaceMessage::Global([m.lat_int, m.lon_int], m.alt),
            velocity: [m.vx, m.vy, m.vz],
            acceleration: [m.afx, m.afy, m.afz],
            yaw: m.yaw,
            yaw_rate: m.yaw_rate,
            sent_ms: m.time_boot_ms,
        })
    }
}

impl From<SET_ATTITUDE_TARGET_DATA> for SetPointMessage {
    fn from(m: SET_ATTITUDE_TARGET_DATA) -> Self {
        let rates = [m.body_roll_rate, m.body_pitch_rate, m.body_yaw_rate];
        Self::Attitude(AttitudeMessage { mask: m.type_mask, q: m.q, rates, thrust: m.thrust })
    }
}

/// Why a set-point is not taken.
type Refused = &'static str;
const MASK: Refused = "mask not supported";
const FRAME: Refused = "frame not supported";
const RANGE: Refused = "out of range";
const NO_ORIGIN: Refused = "origin unknown";

/// The set-point of a message, in the world.
///
/// # Errors
/// Why it cannot be flown.
pub(super) fn read(message: &SetPointMessage, view: &View) -> Result<SetPoint, Refused> {
    match message {
        SetPointMessage::Motion(m) => motion(m, view),
        SetPointMessage::Attitude(m) => attitude(m),
    }
}

/// How a frame lies in the world.
struct Turn {
    /// Where positions are counted from, m.
    origin: Vector3<f32>,
    /// ψ of the frame, and of what the yaw is counted from, rad.
    heading: f32,
    yaw_from: f32,
    /// Whether it moves with the vehicle.
    moves: bool,
}

impl Turn {
    const NONE: Self = Self { origin: Vector3::new(0.0, 0.0, 0.0), heading: 0.0, yaw_from: 0.0, moves: false };

    /// Of a frame of local positions.
    fn of_local(frame: u8, view: &View) -> Result<Self, Refused> {
        let (position, yaw) = (view.input.nav.position, view.input.nav.yaw());
        Ok(match frame {
            // MAV_FRAME_LOCAL_NED.
            1 => Self::NONE,
            // _LOCAL_OFFSET_NED: from the vehicle.
            7 => Self { origin: position, moves: true, ..Self::NONE },
            // _BODY_NED: along its heading.
            8 => Self { origin: position, heading: yaw, yaw_from: 0.0, moves: true },
            // _BODY_OFFSET_NED and _BODY_FRD: the yaw from its heading too.
            9 | 12 => Self { origin: position, heading: yaw, yaw_from: yaw, moves: true },
            _ => return Err(FRAME),
        })
    }

    /// A vector of the frame in the world.
    fn apply(&self, ned: &Vector3<f32>) -> Vector3<f32> {
        let (sin, cos) = math::sin_cos(self.heading);
        let v = flip_vector(ned);
        Vector3::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y, v.z)
    }
}

/// `values`, NaN where the mask ignores them. x without y, and the other way round, is refused.
fn masked(values: [f32; 3], mask: u16, first: u16) -> Result<Vector3<f32>, Refused> {
    let mut vector = Vector3::from(values);
    for (axis, value) in vector.iter_mut().enumerate() {
        if mask >> first >> axis & 1 != 0 {
            *value = f32::NAN;
        }
    }
    if vector.x.is_nan() == vector.y.is_nan() { Ok(vector) } else { Err(MASK) }
}

/// What a message gives of a motion.
fn motion(m: &MotionMessage, view: &View) -> Result<SetPoint, Refused> {
    let (turn, position) = match m.place {
        PlaceMessage::Local(ned) => {
            let turn = Turn::of_local(m.frame, view)?;
            let position = turn.apply(&masked(ned, m.mask, POSITION)?) + turn.origin;
            (turn, position)
        }
        PlaceMessage::Global(place, height) => (Turn::NONE, on_earth(m, place, height, view)?),
    };
    let mut velocity = turn.apply(&masked(m.velocity, m.mask, VELOCITY)?);
    if turn.moves {
        // A place from the vehicle stands still when it is sent. That the next one has moved, with the vehicle, is no motion
        // to be followed: the vehicle would run after itself.
        velocity.zip_apply(&position, |speed, place| {
            if speed.is_nan() && !place.is_nan() {
                *speed = 0.0;
            }
        });
    }
    let acceleration = turn.apply(&masked(m.acceleration, m.mask, ACCELERATION)?);
    let vectors = [(position, FARTHEST_M), (velocity, FASTEST_M_S), (acceleration, ACCELERATION_MAX)];
    let gives_force = m.mask & FORCE != 0 && !acceleration.iter().all(|value| value.is_nan());
    if m.mask & !KNOWN != 0 || gives_force {
        return Err(MASK);
    }
    let yaw = (m.mask & IGNORE_YAW == 0).then_some(m.yaw).filter(|yaw| !yaw.is_nan());
    let yaw_rate = (m.mask & IGNORE_YAW_RATE == 0).then_some(m.yaw_rate).filter(|rate| !rate.is_nan());
    // What is not given is in every range.
    let is_within = |value: f32, most: f32| value.is_nan() || math::abs(value) <= most;
    if !vectors.iter().all(|(v, most)| v.iter().all(|value| is_within(*value, *most)))
        || !is_within(yaw.unwrap_or(0.0), crate::commander::TURN_MAX)
        || !is_within(yaw_rate.unwrap_or(0.0), RATE_MAX)
    {
        return Err(RANGE);
    }
    let given = |v: Vector3<f32>| [v.x, v.y, v.z].map(|value| Some(value).filter(|value| !value.is_nan()));
    let mut wanted = Motion::default()
        .with_position(given(position))
        .with_velocity(given(velocity))
        .with_acceleration(given(acceleration));
    if let Some(yaw) = yaw {
        wanted = wanted.with_yaw(turn.yaw_from - yaw);
    }
    if let Some(rate) = yaw_rate {
        wanted = wanted.with_yaw_rate(-rate);
    }
    if wanted == Motion::default() {
        return Err(MASK);
    }
    Ok(SetPoint::Motion { motion: wanted, sent_ms: (m.sent_ms != 0).then_some(m.sent_ms) })
}

/// The position of a place on Earth, m; NaN for what is not given.
fn on_earth(
    m: &MotionMessage,
    [latitude_e7, longitude_e7]: [i32; 2],
    height: f32,
    view: &View,
) -> Result<Vector3<f32>, Refused> {
    let mut position = masked([0.0, 0.0, height], m.mask, POSITION)?;
    let above_sea = match m.frame {
        // MAV_FRAME_GLOBAL and _GLOBAL_INT.
        0 | 5 => true,
        // _GLOBAL_RELATIVE_ALT and _GLOBAL_RELATIVE_ALT_INT: above home.
        3 | 6 => false,
        _ => return Err(FRAME),
    };
    let (gives_place, height) = (!position.x.is_nan() && !position.y.is_nan(), position.z);
    if gives_place || (above_sea && !height.is_nan()) {
        let map = view.map.ok_or(NO_ORIGIN)?;
        let here = map.place(&view.input.nav.position);
        let (latitude_e7, longitude_e7) =
            if gives_place { (latitude_e7, longitude_e7) } else { (here.latitude_e7, here.longitude_e7) };
        if !is_on_earth(latitude_e7, longitude_e7) || height.is_infinite() {
            return Err(RANGE);
        }
        let height_msl_mm = if above_sea && !height.is_nan() { (height * 1e3) as i32 } else { here.height_msl_mm };
        let there = map.position(&Place { latitude_e7, longitude_e7, height_msl_mm });
        if gives_place {
            (position.x, position.y) = (there.x, there.y);
        }
        if !height.is_nan() {
            position.z = there.z;
        }
    }
    if !above_sea {
        position.z = view.input.home.map_or(0.0, |home| home.z) + height;
    }
    Ok(position)
}

fn attitude(m: &AttitudeMessage) -> Result<SetPoint, Refused> {
    let ignores_attitude = m.mask & IGNORE_ATTITUDE != 0;
    if m.mask & IGNORE_THRUST != 0 || (ignores_attitude && m.mask & IGNORE_RATES != 0) {
        return Err(MASK);
    }
    let mut rates = Vector3::from(m.rates);
    for (axis, rate) in rates.iter_mut().enumerate() {
        if m.mask >> axis & 1 != 0 {
            *rate = 0.0;
        }
    }
    if !rates.iter().all(|rate| math::abs(*rate) <= RATE_MAX) || !(0.0..=1.0).contains(&m.thrust) {
        return Err(RANGE);
    }
    let [w, x, y, z] = m.q;
    let q = Quaternion::new(w, x, y, z);
    let is_unit = (0.9..1.1).contains(&q.norm_squared());
    if !ignores_attitude && !is_unit {
        return Err(RANGE);
    }
    let attitude = (!ignores_attitude).then(|| flip_attitude(&UnitQuaternion::new_normalize(q)));
    Ok(SetPoint::Attitude(AttitudeSetPoint { attitude, rates: flip_vector(&rates), thrust: m.thrust }))
}
