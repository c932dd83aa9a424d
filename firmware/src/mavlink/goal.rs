//! Commands that send the vehicle somewhere: `DO_REPOSITION`, `DO_ORBIT`, `NAV_LAND` with a place, `CONDITION_YAW`, and
//! `DO_CHANGE_SPEED`.
//!
//! A value that is NaN, or the least or greatest integer in place of a latitude or longitude, is not given.

use glissade_dialect::MavResult;
use nalgebra::Vector3;

use super::command::Effect;
use super::incoming::{CommandMessage, Form};
use super::place::{Datum, datum, is_on_earth};
use super::telemetry::{Place, View};
use crate::commander::{Goal, Mode, OrbitGoal, OrbitHeading, Request, SpeedKind};
use crate::frames::flip_vector;
use crate::math;

/// `MAV_FRAME_LOCAL_NED`, in which a `COMMAND_INT` carries metres times 10⁴.
const LOCAL_NED: u8 = 1;
/// `MAV_FRAME_GLOBAL`.
const GLOBAL: u8 = 0;
const PER_METRE: f32 = 1e4;
/// Bit of `MAV_DO_REPOSITION_FLAGS`: the vehicle is to change to the mode in which it goes to places.
const CHANGE_MODE: f32 = 1.0;
const DENIED: Effect = Effect::Done(MavResult::MAV_RESULT_DENIED);
/// Speeds that `DO_CHANGE_SPEED` leaves as they are, and sets back to the settings'.
const NO_CHANGE: f32 = -1.0;
const BACK_TO_USUAL: f32 = -2.0;

/// `DO_REPOSITION`: a place, a height, a heading in rad (as PX4 takes it, whatever MAVLink's text says); nothing of it
/// is a pause. Parameter 1 is the speed, −1 for the usual one.
pub(super) fn reposition(message: &CommandMessage, view: &View) -> Result<Request, Effect> {
    let CommandMessage { param1: speed, param2: flags, param4: yaw, .. } = *message;
    let is_on_the_way = matches!(view.input.mode, Mode::Hold | Mode::GoTo);
    if !(flags == CHANGE_MODE || (is_on_the_way && (flags == 0.0 || flags.is_nan()))) {
        return Err(DENIED);
    }
    let (place_m, height_m) = place(message, view, "Go to")?;
    let goal = Goal {
        place_m,
        height_m,
        yaw_rad: given(yaw).map(|yaw| math::wrap_angle(-yaw)),
        speed_m_s: Some(speed).filter(|speed| *speed > 0.0),
    };
    Ok(if goal.numbers().iter().all(|number| number.is_nan()) { Request::Hold } else { Request::GoTo(goal) })
}

/// `NAV_LAND`: here, or at a place, with a heading in degrees. Of senders that know no NaN, 0, 0 is no place, and 0 no
/// heading unless there is a place.
pub(super) fn land(message: &CommandMessage, view: &View) -> Result<Request, Effect> {
    let is_unset = match message.form {
        Form::Long([latitude, longitude]) => latitude == 0.0 && longitude == 0.0,
        Form::Int { frame, xy } => frame != LOCAL_NED && xy == [0, 0],
    };
    let place_m = if is_unset { None } else { place(message, view, "Landing")?.0 };
    let yaw_deg = given(message.param4).filter(|yaw| *yaw != 0.0 || place_m.is_some());
    let yaw_rad = yaw_deg.map(|yaw| math::wrap_angle(-yaw.to_radians()));
    let goal = Goal { place_m, yaw_rad, ..Goal::default() };
    Ok(if place_m.is_none() && yaw_rad.is_none() { Request::Land } else { Request::LandAt(goal) })
}

/// `DO_ORBIT`: radius, positive for clockwise; speed; where the nose points; centre and height. For ever: the number of
/// turns must be open.
pub(super) fn orbit(message: &CommandMessage, view: &View) -> Result<Request, Effect> {
    let CommandMessage { param1: radius, param2: speed, param3: behaviour, param4: turns, .. } = *message;
    if !(turns.is_nan() || turns == 0.0) {
        return Err(DENIED);
    }
    let heading = match behaviour {
        0.0 => OrbitHeading::Center,
        3.0 => OrbitHeading::Along,
        1.0 | 2.0 | 4.0 => OrbitHeading::Kept,
        // As it is on the circle that is flown.
        unchanged if unchanged == 5.0 || unchanged.is_nan() => {
            view.input.control.orbit.map_or(OrbitHeading::Center, |orbit| orbit.heading)
        }
        _ => return Err(DENIED),
    };
    // MAVSDK sends a height above the sea in a frame of heights above home. One that would be below the ground is above home.
    let is_below_ground = view.ground_msl_m().is_some_and(|ground_m| message.param7 < ground_m);
    let form = match message.form {
        Form::Int { frame, xy } if frame != LOCAL_NED && datum(frame)? == Datum::Ground && !is_below_ground => {
            Form::Int { frame: GLOBAL, xy }
        }
        form => form,
    };
    let (center_m, height_m) = place(&CommandMessage { form, ..*message }, view, "Orbit")?;
    let radius = given(radius);
    // Clockwise is negative here. Of a speed that is not given the direction is that of the radius.
    let clockwise = radius.is_none_or(|radius| radius > 0.0) != given(speed).is_some_and(|speed| speed < 0.0);
    let usual = view.input.control.orbit.map_or(view.cruise_m_s, |orbit| math::abs(orbit.speed_m_s));
    let clockwise = match view.input.control.orbit {
        Some(orbit) if radius.is_none() && speed.is_nan() => orbit.speed_m_s < 0.0,
        _ => clockwise,
    };
    let speed = given(speed).map_or(usual, math::abs);
    Ok(Request::Orbit(OrbitGoal {
        center_m,
        height_m,
        radius_m: radius.map(math::abs),
        speed_m_s: Some(if clockwise { -speed } else { speed }),
        heading,
    }))
}

/// `CONDITION_YAW`: a heading in degrees, or a turn by them for parameter 4 = 1, to the left for parameter 3 = −1. It is
/// turned at the usual rate and by the shortest way.
pub(super) fn turn(message: &CommandMessage, view: &View) -> Result<Request, Effect> {
    let CommandMessage { param1: degrees, param3: direction, param4: relative, .. } = *message;
    if !(-360.0..=360.0).contains(&degrees) || ![-1.0, 0.0, 1.0].contains(&direction) {
        return Err(DENIED);
    }
    let yaw_rad = if relative == 1.0 {
        let clockwise = if direction < 0.0 { -degrees } else { degrees };
        view.input.nav.yaw() - clockwise.to_radians()
    } else if relative == 0.0 {
        -degrees.to_radians()
    } else {
        return Err(DENIED);
    };
    Ok(Request::GoTo(Goal { yaw_rad: Some(math::wrap_angle(yaw_rad)), ..Goal::default() }))
}

/// `DO_CHANGE_SPEED`: of type 0 or 1 over the ground, 2 upwards, 3 downwards, m/s. `None` changes nothing.
pub(super) fn change_speed(message: &CommandMessage) -> Result<Option<Request>, Effect> {
    let CommandMessage { param1: kind, param2: speed, .. } = *message;
    let kinds = [SpeedKind::Horizontal, SpeedKind::Horizontal, SpeedKind::Up, SpeedKind::Down];
    let kind = kinds.get(kind as usize).copied().filter(|_| [0.0, 1.0, 2.0, 3.0].contains(&kind)).ok_or(DENIED)?;
    if speed == NO_CHANGE || speed.is_nan() {
        return Ok(None);
    }
    Ok(Some(Request::Speed { kind, speed_m_s: (speed != BACK_TO_USUAL).then_some(speed) }))
}

fn given(value: f32) -> Option<f32> {
    (!value.is_nan()).then_some(value)
}

/// x and y, and z, as far as parameters 5 to 7 give them, m.
fn place(
    message: &CommandMessage,
    view: &View,
    request: &'static str,
) -> Result<(Option<[f32; 2]>, Option<f32>), Effect> {
    let (at, frame) = match message.form {
        Form::Int { frame: LOCAL_NED, xy } => return Ok(local(xy, message.param7)),
        Form::Int { frame, xy: [latitude, longitude] } => (on_earth(latitude, longitude)?, datum(frame)?),
        Form::Long([latitude, longitude]) if latitude.is_nan() || longitude.is_nan() => (None, Datum::SeaLevel),
        Form::Long([latitude, longitude]) => (on_earth(e7(latitude), e7(longitude))?, Datum::SeaLevel),
    };
    let height = given(message.param7);
    if height.is_some_and(f32::is_infinite) {
        return Err(DENIED);
    }
    let above_home = view.input.home.map_or(0.0, |home| home.z);
    let height_msl = height.filter(|_| frame == Datum::SeaLevel);
    let mut height_m = height.filter(|_| frame == Datum::Ground).map(|height| above_home + height);
    if at.is_none() && height_msl.is_none() {
        return Ok((None, height_m));
    }
    let map = view.map.ok_or(Effect::Refuse { request, reason: "origin unknown" })?;
    let here = map.place(&view.input.nav.position);
    let (latitude_e7, longitude_e7) = at.unwrap_or((here.latitude_e7, here.longitude_e7));
    let height_msl_mm = height_msl.map_or(here.height_msl_mm, |height| (height * 1e3) as i32);
    let position = map.position(&Place { latitude_e7, longitude_e7, height_msl_mm });
    if height_msl.is_some() {
        height_m = Some(position.z);
    }
    Ok((at.map(|_| [position.x, position.y]), height_m))
}

/// A place in the local frame.
fn local(xy: [i32; 2], down: f32) -> (Option<[f32; 2]>, Option<f32>) {
    let [x, y] = xy.map(|coordinate| coordinate as f32 / PER_METRE);
    let position = flip_vector(&Vector3::new(x, y, down));
    let is_given = xy.iter().all(|coordinate| is_coordinate(*coordinate));
    (is_given.then_some([position.x, position.y]), given(position.z))
}

fn is_coordinate(value: i32) -> bool {
    value != i32::MIN && value != i32::MAX
}

/// Latitude and longitude, 1e-7°, if they are given.
fn on_earth(latitude: i32, longitude: i32) -> Result<Option<(i32, i32)>, Effect> {
    if !is_coordinate(latitude) || !is_coordinate(longitude) {
        Ok(None)
    } else if is_on_earth(latitude, longitude) {
        Ok(Some((latitude, longitude)))
    } else {
        Err(DENIED)
    }
}

/// Degrees as 1e-7°. What does not fit is no place on Earth, and not one that is not given.
fn e7(degrees: f32) -> i32 {
    ((f64::from(degrees) * 1e7) as i32).clamp(i32::MIN + 1, i32::MAX - 1)
}
