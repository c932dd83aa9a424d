//! Control: what is aimed at, the rotors, and the inside of the control laws.

use glissade_dialect::mavlink_core::types::CharArray;
use glissade_dialect::{
    ATTITUDE_TARGET_DATA, DEBUG_FLOAT_ARRAY_DATA, ESC_STATUS_DATA, ORBIT_EXECUTION_STATUS_DATA,
    POSITION_TARGET_LOCAL_NED_DATA, SERVO_OUTPUT_RAW_DATA,
};

use super::motion::quaternion;
use super::view::{View, limited_u16};
use crate::frames::flip_vector;
use crate::math;
use crate::mavlink::report::LawReport;

/// `MAV_FRAME_LOCAL_NED`, and `_GLOBAL_INT`.
const LOCAL_NED: u8 = 1;
const GLOBAL_INT: u8 = 5;
/// Bits of `POSITION_TARGET_TYPEMASK`: what is not aimed at.
const IGNORE_X_Y: u16 = 1 | 2;
const IGNORE_VX_VY: u16 = 8 | 16;
const IGNORE_AFX_AFY: u16 = 64 | 128;
const IGNORE_YAW: u16 = 1024 | 2048;
/// Bit of `ATTITUDE_TARGET_TYPEMASK`.
const IGNORE_YAW_RATE: u8 = 4;
/// Revolutions per minute in a rad/s.
const RPM: f32 = 60.0 / core::f32::consts::TAU;

/// The attitude that is aimed at, and the thrust as a fraction of the greatest.
pub(super) fn attitude_target(view: &View) -> Option<ATTITUDE_TARGET_DATA> {
    let control = &view.input.control;
    let aim = control.aim.as_ref()?;
    let rates = flip_vector(&aim.rates);
    Some(ATTITUDE_TARGET_DATA {
        time_boot_ms: view.boot_ms(),
        type_mask: if aim.holds_heading { 0 } else { IGNORE_YAW_RATE },
        q: quaternion(&aim.attitude),
        body_roll_rate: rates.x,
        body_pitch_rate: rates.y,
        body_yaw_rate: rates.z,
        thrust: math::clamp(aim.thrust_n / control.thrust_max_n, 0.0, 1.0),
    })
}

/// The place that is aimed at, with its derivatives.
pub(super) fn position_target(view: &View) -> Option<POSITION_TARGET_LOCAL_NED_DATA> {
    let aim = view.input.control.aim.as_ref()?;
    let place = flip_vector(&aim.place.xyz());
    let (velocity, acceleration) = (flip_vector(&aim.velocity), flip_vector(&aim.acceleration));
    let across = if aim.holds_position { 0 } else { IGNORE_X_Y | IGNORE_VX_VY | IGNORE_AFX_AFY };
    Some(POSITION_TARGET_LOCAL_NED_DATA {
        time_boot_ms: view.boot_ms(),
        coordinate_frame: LOCAL_NED,
        type_mask: across | if aim.holds_heading { 0 } else { IGNORE_YAW },
        x: place.x,
        y: place.y,
        z: place.z,
        vx: velocity.x,
        vy: velocity.y,
        vz: velocity.z,
        afx: acceleration.x,
        afy: acceleration.y,
        afz: acceleration.z,
        yaw: math::wrap_angle(-aim.place.w),
        yaw_rate: -aim.yaw_rate,
    })
}

/// The circle that is flown, on the map if there is one.
pub(super) fn orbit(view: &View) -> Option<ORBIT_EXECUTION_STATUS_DATA> {
    let orbit = view.input.control.orbit?;
    let radius = if orbit.speed_m_s < 0.0 { orbit.radius_m } else { -orbit.radius_m };
    let (frame, x, y, z) = if let Some(map) = &view.map {
        let place = map.place(&orbit.center);
        (GLOBAL_INT, place.latitude_e7, place.longitude_e7, place.height_msl_mm as f32 * 1e-3)
    } else {
        let center = flip_vector(&orbit.center) * 1e4;
        (LOCAL_NED, center.x as i32, center.y as i32, center.z * 1e-4)
    };
    Some(ORBIT_EXECUTION_STATUS_DATA { time_usec: view.boot_us(), radius, x, y, z, frame })
}

/// Commanded rotor speeds as pulse widths: 1000 µs at a standstill, 2000 µs at ωmax.
pub(super) fn servo_output(view: &View) -> SERVO_OUTPUT_RAW_DATA {
    let control = &view.input.control;
    let [servo1_raw, servo2_raw, servo3_raw, servo4_raw] = control.motors.omega_rad_s.map(|omega| {
        let part = math::clamp(omega / control.omega_max_rad_s, 0.0, 1.0);
        limited_u16(1000.0 + 1000.0 * part)
    });
    SERVO_OUTPUT_RAW_DATA {
        time_usec: view.boot_us() as u32,
        servo1_raw,
        servo2_raw,
        servo3_raw,
        servo4_raw,
        ..SERVO_OUTPUT_RAW_DATA::DEFAULT
    }
}

/// Estimated rotor speeds: no speed controller reports its own, nor voltage or current.
pub(super) fn esc_status(view: &View) -> ESC_STATUS_DATA {
    ESC_STATUS_DATA {
        time_usec: view.boot_us(),
        rpm: view.input.control.rotor_speeds_rad_s.map(|omega| (omega * RPM + 0.5) as i32),
        voltage: [f32::NAN; 4],
        current: [f32::NAN; 4],
        index: 0,
    }
}

/// The sliding mode laws, `smc`, in NWU and FLU: of the attitude s (rad/s), `u_r(s)` and d̂ (rad/s²), each in roll, pitch
/// and yaw; then of the position s (m/s), `u_r(s)` and d̂ (m/s²), each in x, y and z.
pub(super) fn sliding_mode(view: &View) -> DEBUG_FLOAT_ARRAY_DATA {
    let control = &view.input.control;
    let values = [control.attitude_law, control.position_law].map(|law| {
        let LawReport { s, state } = law;
        [s, state.reaching, state.disturbance]
    });
    let mut data = [0.0; 58];
    for (to, from) in data.iter_mut().zip(values.iter().flatten().flat_map(|vector| vector.iter())) {
        *to = *from;
    }
    DEBUG_FLOAT_ARRAY_DATA { time_usec: view.boot_us(), array_id: 0, name: CharArray::new(*b"smc\0\0\0\0\0\0\0"), data }
}
