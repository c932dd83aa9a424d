//! Place on Earth: global position, home, origin, heights, GNSS, UTC.
//!
//! Heights above mean sea level are the receiver's height above the ellipsoid less its separation of the geoid at the
//! first fix; the estimator's height above the local origin is added.

use glissade_dialect::{
    ALTITUDE_DATA, GLOBAL_POSITION_INT_DATA, GPS_GLOBAL_ORIGIN_DATA, GPS_RAW_INT_DATA, HOME_POSITION_DATA,
    SYSTEM_TIME_DATA,
};
use nalgebra::Vector3;

use super::view::{Place, View, heading_deg, limited_i16, limited_u16, limited_u32};
use crate::frames::flip_vector;
use crate::math;
use crate::sensors::GnssSample;
use crate::signals::TICK_US;

/// `GPS_FIX_TYPE_NO_GPS`, `_NO_FIX` and `_3D_FIX`.
const NO_GPS: u8 = 0;
const NO_FIX: u8 = 1;
const FIX_3D: u8 = 3;
/// Below this speed over ground, m/s, a course means nothing.
const COURSE_FROM_M_S: f32 = 0.5;

/// Home on Earth.
pub(super) fn home(view: &View) -> Option<Place> {
    Some(view.map?.place(view.input.home.as_ref()?))
}

/// The local origin on Earth.
pub(super) fn origin(view: &View) -> Option<Place> {
    view.map.map(|map| map.place(&Vector3::zeros()))
}

/// Where the vehicle is.
pub(super) fn global_position(view: &View) -> Option<GLOBAL_POSITION_INT_DATA> {
    let place = view.place()?;
    let over_home = view.height_over_home_m().unwrap_or(view.input.nav.position.z);
    let velocity = view.velocity_ned() * 100.0;
    Some(GLOBAL_POSITION_INT_DATA {
        time_boot_ms: view.boot_ms(),
        lat: place.latitude_e7,
        lon: place.longitude_e7,
        alt: place.height_msl_mm,
        relative_alt: (over_home * 1e3) as i32,
        vx: limited_i16(velocity.x),
        vy: limited_i16(velocity.y),
        vz: limited_i16(velocity.z),
        hdg: if view.known().heading { centidegrees(heading_deg(view.input.nav.yaw())) } else { u16::MAX },
    })
}

/// A heading, °, as an integer below 36,000.
fn centidegrees(degrees: f32) -> u16 {
    limited_u16(degrees * 100.0) % 36_000
}

/// Where a return leads. The slope of the ground there and an approach to it are unknown: NaN.
pub(super) fn home_position(view: &View) -> Option<HOME_POSITION_DATA> {
    let place = home(view)?;
    let local = flip_vector(view.input.home.as_ref()?);
    Some(HOME_POSITION_DATA {
        latitude: place.latitude_e7,
        longitude: place.longitude_e7,
        altitude: place.height_msl_mm,
        x: local.x,
        y: local.y,
        z: local.z,
        q: [f32::NAN; 4],
        approach_x: f32::NAN,
        approach_y: f32::NAN,
        approach_z: f32::NAN,
        time_usec: view.boot_us(),
    })
}

/// Where the local frame's origin is.
pub(super) fn gps_global_origin(view: &View) -> Option<GPS_GLOBAL_ORIGIN_DATA> {
    let place = origin(view)?;
    Some(GPS_GLOBAL_ORIGIN_DATA {
        latitude: place.latitude_e7,
        longitude: place.longitude_e7,
        altitude: place.height_msl_mm,
        time_usec: view.boot_us(),
    })
}

/// Heights: above mean sea level, above the local origin and above home. The ground's is unknown.
pub(super) fn altitude(view: &View) -> Option<ALTITUDE_DATA> {
    let up = view.input.nav.position.z;
    view.known().height.then(|| ALTITUDE_DATA {
        time_usec: view.boot_us(),
        altitude_monotonic: up,
        altitude_amsl: view.height_msl_m().unwrap_or(f32::NAN),
        altitude_local: up,
        altitude_relative: view.height_over_home_m().unwrap_or(f32::NAN),
        altitude_terrain: f32::NAN,
        bottom_clearance: f32::NAN,
    })
}

/// The last solution of the receiver as it came; `None` if there has never been one.
pub(super) fn gps_raw(view: &View) -> Option<GPS_RAW_INT_DATA> {
    view.input.sensors.as_ref()?.gnss.as_ref()?;
    Some(view.gnss().map_or_else(|| unknown_solution(view.boot_us()), solution))
}

fn unknown_solution(time_usec: u64) -> GPS_RAW_INT_DATA {
    GPS_RAW_INT_DATA {
        time_usec,
        fix_type: NO_GPS,
        eph: u16::MAX,
        epv: u16::MAX,
        vel: u16::MAX,
        cog: u16::MAX,
        satellites_visible: u8::MAX,
        ..GPS_RAW_INT_DATA::DEFAULT
    }
}

fn solution(gnss: &GnssSample) -> GPS_RAW_INT_DATA {
    let unknown = unknown_solution(u64::from(gnss.at) * u64::from(TICK_US));
    if !gnss.has_fix || !math::all_finite(gnss.velocity.as_slice()) {
        return GPS_RAW_INT_DATA { fix_type: NO_FIX, ..unknown };
    }
    let v = &gnss.velocity;
    let speed = math::sqrt(v.x * v.x + v.y * v.y);
    // The heading of the velocity: ψ is counter-clockwise from north, as is the angle of (north, west).
    let course = heading_deg(math::atan2(v.y, v.x));
    GPS_RAW_INT_DATA {
        fix_type: FIX_3D,
        lat: gnss.place.latitude_e7,
        lon: gnss.place.longitude_e7,
        alt: gnss.place.height_mm.saturating_sub(gnss.separation_mm),
        alt_ellipsoid: gnss.place.height_mm,
        vel: limited_u16(speed * 100.0),
        cog: if speed < COURSE_FROM_M_S { u16::MAX } else { centidegrees(course) },
        h_acc: limited_u32(gnss.horizontal_accuracy_m * 1e3),
        v_acc: limited_u32(gnss.vertical_accuracy_m * 1e3),
        vel_acc: limited_u32(gnss.speed_accuracy_m_s * 1e3),
        ..unknown
    }
}

/// UTC, 0 while it is unknown, and the time since boot.
pub(super) fn system_time(view: &View) -> SYSTEM_TIME_DATA {
    SYSTEM_TIME_DATA { time_unix_usec: view.utc_us().unwrap_or(0), time_boot_ms: view.boot_ms() }
}
