//! Modes in PX4's encoding: main mode and sub mode in the third and fourth byte of `custom_mode`.

use glissade_dialect::MavCmd;

use super::incoming::{CommandMessage, Form};
use crate::commander::{ManualMode, Mode, Request};

const ALTITUDE: u8 = 2;
const POSITION: u8 = 3;
const AUTO: u8 = 4;
const ACRO: u8 = 5;
const STABILIZED: u8 = 7;
const OFFBOARD: u8 = 6;
const ORBIT: u8 = 1;
const TAKE_OFF: u8 = 2;
const LOITER: u8 = 3;
const MISSION: u8 = 4;
const RETURN: u8 = 5;
const LAND: u8 = 6;

/// `custom_mode` of a mode. Clients know no PX4 mode for a descent after a failure, so it is reported as landing.
pub(super) fn custom_mode(mode: Mode) -> u32 {
    let (main, sub) = match mode {
        Mode::Disarmed | Mode::Idle | Mode::Hold | Mode::GoTo => (AUTO, LOITER),
        Mode::TakeOff => (AUTO, TAKE_OFF),
        Mode::Follow => (AUTO, MISSION),
        Mode::Return => (AUTO, RETURN),
        Mode::Land | Mode::Descent | Mode::MotorOut => (AUTO, LAND),
        Mode::Velocity | Mode::Offboard => (OFFBOARD, 0),
        Mode::Acro => (ACRO, 0),
        Mode::Stabilized => (STABILIZED, 0),
        Mode::Altitude => (ALTITUDE, 0),
        Mode::Position => (POSITION, 0),
        Mode::Orbit => (POSITION, ORBIT),
    };
    u32::from(main) << 16 | u32::from(sub) << 24
}

/// The command that `SET_MODE` stands for: `DO_SET_MODE`, by which it is acknowledged too.
pub(super) fn as_command(base_mode: u8, custom_mode: u32) -> CommandMessage {
    let [_, _, main, sub] = custom_mode.to_le_bytes();
    let command = MavCmd::MAV_CMD_DO_SET_MODE as u16;
    let [param1, param2, param3] = [base_mode, main, sub].map(f32::from);
    let form = Form::Long([f32::NAN; 2]);
    CommandMessage { command, param1, param2, param3, param4: f32::NAN, form, param7: f32::NAN }
}

/// The manual modes. PX4's main mode 1, "manual", is for multicopters the same as stabilized.
const MANUAL: [(u8, ManualMode); 5] = [
    (1, ManualMode::Stabilized),
    (ALTITUDE, ManualMode::Altitude),
    (POSITION, ManualMode::Position),
    (ACRO, ManualMode::Acro),
    (STABILIZED, ManualMode::Stabilized),
];

/// The request that corresponds to setting a mode; `None` if it cannot be set. A take-off goes to `take_off_m`.
pub(super) fn request(main: f32, sub: f32, take_off_m: f32) -> Option<Request> {
    for (number, mode) in MANUAL {
        if main == f32::from(number) && (sub == 0.0 || sub.is_nan()) {
            return Some(Request::Manual(mode));
        }
    }
    if main == f32::from(OFFBOARD) {
        return Some(Request::Offboard);
    }
    if main != f32::from(AUTO) {
        return None;
    }
    [
        (TAKE_OFF, Request::TakeOff { height_m: take_off_m }),
        (LOITER, Request::Hold),
        (MISSION, Request::Follow),
        (RETURN, Request::Return),
        (LAND, Request::Land),
    ]
    .into_iter()
    .find_map(|(number, request)| (sub == f32::from(number)).then_some(request))
}
