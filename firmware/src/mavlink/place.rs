//! Commands and messages that carry a place on Earth or a height: take-off, home, and the origin of the local frame.

use glissade_dialect::MavResult;

use super::GroundInput;
use super::incoming::{CommandMessage, Form};
use super::telemetry::{Place, View};
use crate::commander::Request;
use crate::frames::Origin;
use crate::sensors::Geodetic;

/// The last `MAV_FRAME`.
const LAST_FRAME: u8 = 21;
/// `MAV_FRAME_GLOBAL` and `_GLOBAL_INT`: heights above mean sea level.
const GLOBAL: [u8; 2] = [0, 5];
/// `MAV_FRAME_GLOBAL_RELATIVE_ALT` and `_GLOBAL_RELATIVE_ALT_INT`: heights above home.
const RELATIVE: [u8; 2] = [3, 6];
/// Greatest latitude and longitude, 1e-7°.
const LATITUDE_MAX_E7: i32 = 900_000_000;
const LONGITUDE_MAX_E7: i32 = 1_800_000_000;

/// What a height is above.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Datum {
    SeaLevel,
    Home,
}

/// True unless a command names a frame that does not exist.
pub(super) fn is_frame(message: &CommandMessage) -> bool {
    match message.form {
        Form::Int { frame, .. } => frame <= LAST_FRAME,
        Form::Long(_) => true,
    }
}

fn datum(frame: u8) -> Result<Datum, MavResult> {
    if GLOBAL.contains(&frame) {
        Ok(Datum::SeaLevel)
    } else if RELATIVE.contains(&frame) {
        Ok(Datum::Home)
    } else {
        Err(MavResult::MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME)
    }
}

/// A take-off to the height in parameter 7, m; NaN for the default height.
///
/// In a `COMMAND_INT` the height is in its frame. A `COMMAND_LONG` has none: some ground stations mean mean sea level,
/// others the ground. A height that would be below the vehicle if it were above mean sea level is above the ground.
pub(super) fn take_off(message: &CommandMessage, view: &View) -> Result<Request, MavResult> {
    let height = message.param7;
    let datum = match message.form {
        Form::Int { frame, .. } => datum(frame)?,
        Form::Long(_) if view.height_msl_m().is_some_and(|here| height >= here) => Datum::SeaLevel,
        Form::Long(_) => Datum::Home,
    };
    if height.is_nan() {
        return Ok(Request::TakeOff { height_m: view.take_off_m });
    }
    // Above the ground, where the vehicle stands, or stood when it was armed.
    let ground = match datum {
        Datum::SeaLevel if view.input.landed => view.height_msl_m(),
        Datum::SeaLevel => view.home_msl_m(),
        Datum::Home => Some(0.0),
    };
    Ok(Request::TakeOff { height_m: height - ground.ok_or(MavResult::MAV_RESULT_TEMPORARILY_REJECTED)? })
}

/// A new home: here for parameter 1 = 1, else the place in parameters 5 to 7, which only a `COMMAND_INT` carries exactly.
pub(super) fn set_home(message: &CommandMessage, view: &View) -> Result<Request, MavResult> {
    if message.param1 == 1.0 {
        return Ok(Request::SetHome { position_m: None });
    }
    if !(message.param1 == 0.0 || message.param1.is_nan()) {
        return Err(MavResult::MAV_RESULT_DENIED);
    }
    let Form::Int { frame, xy: [latitude_e7, longitude_e7] } = message.form else {
        return Err(MavResult::MAV_RESULT_COMMAND_INT_ONLY);
    };
    let datum = datum(frame)?;
    let height = message.param7;
    if !is_on_earth(latitude_e7, longitude_e7) || !height.is_finite() {
        return Err(MavResult::MAV_RESULT_DENIED);
    }
    let map = view.map.ok_or(MavResult::MAV_RESULT_TEMPORARILY_REJECTED)?;
    let base_mm = match datum {
        Datum::SeaLevel => 0,
        Datum::Home => {
            let home = view.input.home.as_ref().ok_or(MavResult::MAV_RESULT_TEMPORARILY_REJECTED)?;
            map.place(home).height_msl_mm
        }
    };
    let height_msl_mm = base_mm.saturating_add((height * 1e3) as i32);
    let position = map.position(&Place { latitude_e7, longitude_e7, height_msl_mm });
    Ok(Request::SetHome { position_m: Some(position.into()) })
}

/// Sets the origin of the local frame, for a vehicle without GNSS. Ignored while armed, once GNSS has found the origin,
/// and for a place that is not on Earth. The separation of the geoid is not known, and not needed.
pub(super) fn set_origin(place: &Place, input: &GroundInput, origin: &mut Option<Origin>) {
    let Place { latitude_e7, longitude_e7, height_msl_mm } = *place;
    if !input.armed && input.origin().is_none() && is_on_earth(latitude_e7, longitude_e7) {
        let place = Geodetic { latitude_e7, longitude_e7, height_mm: height_msl_mm };
        *origin = Some(Origin { place, separation_mm: 0 });
    }
}

fn is_on_earth(latitude_e7: i32, longitude_e7: i32) -> bool {
    (-LATITUDE_MAX_E7..=LATITUDE_MAX_E7).contains(&latitude_e7)
        && (-LONGITUDE_MAX_E7..=LONGITUDE_MAX_E7).contains(&longitude_e7)
}
