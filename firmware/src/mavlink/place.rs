//! Commands and messages that carry a place on Earth or a height: take-off, home, and the origin of the local frame.

use glissade_dialect::MavResult;
use nalgebra::Vector3;

use super::GroundInput;
use super::command::Effect;
use super::incoming::{CommandMessage, Form};
use super::telemetry::{Place, View};
use crate::commander::Request;
use crate::frames::Origin;
use crate::sensors::Geodetic;

/// The last `MAV_FRAME`.
const LAST_FRAME: u8 = 21;
/// `MAV_FRAME_GLOBAL` and `_GLOBAL_INT`: heights above mean sea level.
const GLOBAL: [u8; 2] = [0, 5];
/// `MAV_FRAME_GLOBAL_RELATIVE_ALT` and `_GLOBAL_RELATIVE_ALT_INT`: heights above the ground where the vehicle started.
const RELATIVE: [u8; 2] = [3, 6];
/// Greatest latitude and longitude, 1e-7°.
const LATITUDE_MAX_E7: i32 = 900_000_000;
const LONGITUDE_MAX_E7: i32 = 1_800_000_000;

/// What a height is above.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Datum {
    SeaLevel,
    Ground,
}

/// True unless a command names a frame that does not exist.
pub(super) fn is_frame(message: &CommandMessage) -> bool {
    match message.form {
        Form::Int { frame, .. } => frame <= LAST_FRAME,
        Form::Long(_) => true,
    }
}

pub(super) fn datum(frame: u8) -> Result<Datum, Effect> {
    if GLOBAL.contains(&frame) {
        Ok(Datum::SeaLevel)
    } else if RELATIVE.contains(&frame) {
        Ok(Datum::Ground)
    } else {
        Err(MavResult::MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME.into())
    }
}

/// A take-off to the height in parameter 7, m; NaN for the default height.
///
/// In a `COMMAND_INT` the height is in its frame. A `COMMAND_LONG` has none: some ground stations mean mean sea level,
/// others the ground. A height that would be below the vehicle if it were above mean sea level is above the ground.
pub(super) fn take_off(message: &CommandMessage, view: &View) -> Result<Request, Effect> {
    let height = message.param7;
    let datum = match message.form {
        Form::Int { frame, .. } => datum(frame)?,
        Form::Long(_) if view.height_msl_m().is_some_and(|here| height >= here) => Datum::SeaLevel,
        Form::Long(_) => Datum::Ground,
    };
    if height.is_nan() {
        return Ok(Request::TakeOff { height_m: view.take_off_m });
    }
    // Above the ground, where the vehicle stands, or stood when it was armed.
    let ground = match datum {
        Datum::SeaLevel if view.input.landed => view.height_msl_m(),
        Datum::SeaLevel => view.ground_msl_m(),
        Datum::Ground => Some(0.0),
    };
    let ground = ground.ok_or(Effect::Refuse { request: "Take-off", reason: "height above the sea unknown" })?;
    Ok(Request::TakeOff { height_m: height - ground })
}

/// A new home: here for parameter 1 = 1, for 0 the place in parameters 5 to 7, which only a `COMMAND_INT` carries exactly.
///
/// A relative height is above the local origin, which is where the vehicle started. Above the present home, a repeated
/// command would move home each time.
pub(super) fn set_home(message: &CommandMessage, view: &View) -> Result<Request, Effect> {
    if message.param1 == 1.0 {
        return Ok(Request::SetHome { position_m: None });
    }
    if message.param1 != 0.0 {
        return Err(MavResult::MAV_RESULT_DENIED.into());
    }
    let Form::Int { frame, xy: [latitude_e7, longitude_e7] } = message.form else {
        return Err(MavResult::MAV_RESULT_COMMAND_INT_ONLY.into());
    };
    let datum = datum(frame)?;
    let height = message.param7;
    if !is_on_earth(latitude_e7, longitude_e7) || !height.is_finite() {
        return Err(MavResult::MAV_RESULT_DENIED.into());
    }
    let map = view.map.ok_or(Effect::Refuse { request: "Setting home", reason: "origin unknown" })?;
    let base_mm = match datum {
        Datum::SeaLevel => 0,
        Datum::Ground => map.place(&Vector3::zeros()).height_msl_mm,
    };
    let height_msl_mm = base_mm.saturating_add((height * 1e3) as i32);
    let position = map.position(&Place { latitude_e7, longitude_e7, height_msl_mm });
    Ok(Request::SetHome { position_m: Some(position.into()) })
}

/// Sets the origin of the local frame, for a vehicle without GNSS. The separation of the geoid is not known, and not needed.
///
/// # Errors
/// Why it is not set: while armed, once GNSS has found the origin, and to a place that is not on Earth.
pub(super) fn set_origin(place: &Place, input: &GroundInput, origin: &mut Option<Origin>) -> Result<(), &'static str> {
    let Place { latitude_e7, longitude_e7, height_msl_mm } = *place;
    if input.armed {
        return Err("vehicle armed");
    }
    if input.origin().is_some() {
        return Err("known by GNSS");
    }
    if !is_on_earth(latitude_e7, longitude_e7) {
        return Err("no place on Earth");
    }
    let place = Geodetic { latitude_e7, longitude_e7, height_mm: height_msl_mm };
    *origin = Some(Origin { place, separation_mm: 0 });
    Ok(())
}

pub(super) fn is_on_earth(latitude_e7: i32, longitude_e7: i32) -> bool {
    (-LATITUDE_MAX_E7..=LATITUDE_MAX_E7).contains(&latitude_e7)
        && (-LONGITUDE_MAX_E7..=LONGITUDE_MAX_E7).contains(&longitude_e7)
}
