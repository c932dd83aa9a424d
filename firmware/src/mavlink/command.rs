//! Commands: what each one does, and how it is answered.
//!
//! Flight commands go to the commander, which answers with a [`Reply`](crate::commander::Reply); the others are
//! answered here. Earlier commands are not remembered: a repeated one is executed and answered again, which is harmless
//! for all of them.

use glissade_dialect::num_traits::FromPrimitive;
use glissade_dialect::{MavCmd, MavModeFlag, MavResult};

use super::incoming::{CommandMessage, Form};
use super::telemetry::{IntervalError, MODES, Report, Telemetry, View, is_available, of_standard_mode, report_by_id};
use super::{GroundOutput, goal, mode, place};
use crate::commander::{MotorTest, Outcome, Refusal, Request};
use crate::failure::{Failure, Failures, Injectable, Manner, Unit};

/// Value of `param2` that forces arming and disarming, and the one that forces arming alone.
const FORCE: f32 = 21_196.0;
const FORCE_ARMING: f32 = 2_989.0;

/// What a command leads to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Effect {
    /// It is done or refused.
    Done(MavResult),
    /// It is temporarily rejected, which is told to the pilot.
    Refuse {
        /// What was asked for.
        request: &'static str,
        /// Why not.
        reason: &'static str,
    },
    /// It is accepted, and this message sent once.
    Report(Report),
    /// The commander decides.
    Ask(Request),
}

impl From<MavResult> for Effect {
    fn from(result: MavResult) -> Self {
        Self::Done(result)
    }
}

impl From<Result<Request, Self>> for Effect {
    fn from(request: Result<Request, Self>) -> Self {
        request.map_or_else(core::convert::identity, Self::Ask)
    }
}

impl From<Option<Request>> for Effect {
    /// Denied without a request.
    fn from(request: Option<Request>) -> Self {
        request.map_or(Self::Done(MavResult::MAV_RESULT_DENIED), Self::Ask)
    }
}

/// Carries out a command, or finds out what the commander is to be asked.
pub(super) fn carry_out(
    message: &CommandMessage,
    view: &View,
    telemetry: &mut Telemetry,
    output: &mut GroundOutput,
) -> Effect {
    let command = MavCmd::from_u16(message.command);
    if command.is_some() && !place::is_frame(message) {
        return MavResult::MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME.into();
    }
    match command {
        Some(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM) if is_kill(message) => {
            output.kill = true;
            MavResult::MAV_RESULT_ACCEPTED.into()
        }
        Some(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM) => arm_request(message).into(),
        Some(MavCmd::MAV_CMD_DO_FLIGHTTERMINATION) if message.param1 >= 0.5 => {
            (output.kill, output.terminate) = (true, true);
            MavResult::MAV_RESULT_ACCEPTED.into()
        }
        Some(MavCmd::MAV_CMD_DO_FLIGHTTERMINATION) => MavResult::MAV_RESULT_DENIED.into(),
        Some(MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN) => restart(message, view, output),
        Some(MavCmd::MAV_CMD_DO_MOTOR_TEST) => motor_test(message).into(),
        Some(MavCmd::MAV_CMD_NAV_TAKEOFF) => place::take_off(message, view).into(),
        Some(MavCmd::MAV_CMD_DO_SET_HOME) => place::set_home(message, view).into(),
        Some(MavCmd::MAV_CMD_NAV_LAND) => goal::land(message, view).into(),
        Some(MavCmd::MAV_CMD_DO_REPOSITION) => goal::reposition(message, view).into(),
        Some(MavCmd::MAV_CMD_DO_ORBIT) => goal::orbit(message, view).into(),
        Some(MavCmd::MAV_CMD_CONDITION_YAW) => goal::turn(message, view).into(),
        Some(MavCmd::MAV_CMD_DO_CHANGE_SPEED) => match goal::change_speed(message) {
            Ok(Some(request)) => Effect::Ask(request),
            Ok(None) => MavResult::MAV_RESULT_ACCEPTED.into(),
            Err(effect) => effect,
        },
        Some(MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH) => Effect::Ask(Request::Return),
        Some(MavCmd::MAV_CMD_DO_SET_MODE) => mode_request(message, view.take_off_m).into(),
        Some(MavCmd::MAV_CMD_DO_SET_STANDARD_MODE) => standard_mode(message, view.take_off_m),
        Some(MavCmd::MAV_CMD_INJECT_FAILURE) => {
            inject(message, &view.input.injectable, &mut output.failures).map_or_else(Into::into, Into::into)
        }
        Some(MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL) => set_message_interval(message, view, telemetry).into(),
        Some(MavCmd::MAV_CMD_REQUEST_MESSAGE) => request_message(message, view, telemetry),
        Some(MavCmd::MAV_CMD_GET_MESSAGE_INTERVAL) => interval_of(message.param1, telemetry),
        Some(MavCmd::MAV_CMD_GET_HOME_POSITION) => request(Report::HomePosition, view),
        Some(MavCmd::MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES) => {
            request_if(message.param1 == 1.0, Report::AutopilotVersion, view)
        }
        Some(MavCmd::MAV_CMD_REQUEST_PROTOCOL_VERSION) => {
            request_if(message.param1 == 1.0, Report::ProtocolVersion, view)
        }
        _ => MavResult::MAV_RESULT_UNSUPPORTED.into(),
    }
}

/// A forced disarm.
fn is_kill(message: &CommandMessage) -> bool {
    message.param1 == 0.0 && message.param2 == FORCE
}

/// `None` if `param1` is neither 1 (arm) nor 0 (disarm), as for NaN.
fn arm_request(message: &CommandMessage) -> Option<Request> {
    if message.param1 == 1.0 {
        Some(Request::Arm { force: [FORCE, FORCE_ARMING].contains(&message.param2) })
    } else if message.param1 == 0.0 {
        Some(Request::Disarm)
    } else {
        None
    }
}

/// `None` unless it is a PX4 custom mode, flagged as such, that can be set.
fn mode_request(message: &CommandMessage, take_off_m: f32) -> Option<Request> {
    let flags = MavModeFlag::from_bits_truncate(whole(message.param1)?.into());
    let custom = flags.contains(MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED);
    custom.then(|| mode::request(message.param2, message.param3, take_off_m)).flatten()
}

/// Restarts the autopilot, while disarmed; other parts of the vehicle and a shutdown are not supported.
fn restart(message: &CommandMessage, view: &View, output: &mut GroundOutput) -> Effect {
    if message.param1 != 1.0 {
        return MavResult::MAV_RESULT_UNSUPPORTED.into();
    }
    if view.input.armed {
        return Effect::Refuse { request: "Restart", reason: Refusal::Armed.reason() };
    }
    output.restart = true;
    MavResult::MAV_RESULT_ACCEPTED.into()
}

/// Turns one motor: number in parameter 1, from 1, throttle in percent, for parameter 4 in seconds.
fn motor_test(message: &CommandMessage) -> Option<Request> {
    const PERCENT: f32 = 0.0;
    let rotor = whole(message.param1)?.checked_sub(1)?;
    let count = match message.form {
        Form::Long([count, _]) => count,
        Form::Int { xy: [count, _], .. } => count as f32,
    };
    let one = is_unset(count) || count == 1.0;
    let test = MotorTest { rotor, part: message.param3 / 100.0 };
    (one && message.param2 == PERCENT).then_some(Request::TestMotor { test, seconds: message.param4 })
}

/// The mode that stands for a standard one.
fn standard_mode(message: &CommandMessage, take_off_m: f32) -> Effect {
    match whole(message.param1).and_then(of_standard_mode) {
        Some(custom_mode) => {
            let [_, _, main, sub] = custom_mode.to_le_bytes();
            mode::request(f32::from(main), f32::from(sub), take_off_m).into()
        }
        None => MavResult::MAV_RESULT_UNSUPPORTED.into(),
    }
}

/// Accepts a failure that the board supports, and passes it on. Denied if the board supports none, as PX4 does while
/// `SYS_FAILURE_EN` is off.
fn inject(message: &CommandMessage, injectable: &Injectable, failures: &mut Failures) -> Result<MavResult, MavResult> {
    if injectable.is_none() {
        return Err(MavResult::MAV_RESULT_DENIED);
    }
    let unit = whole(message.param1).ok_or(MavResult::MAV_RESULT_DENIED)?;
    let manner = whole(message.param2).ok_or(MavResult::MAV_RESULT_DENIED)?;
    let unit = unit_of(unit).ok_or(MavResult::MAV_RESULT_UNSUPPORTED)?;
    let manner = Manner::ALL.get(usize::from(manner)).copied().ok_or(MavResult::MAV_RESULT_UNSUPPORTED)?;
    if !injectable.allows(unit, manner) {
        return Err(MavResult::MAV_RESULT_UNSUPPORTED);
    }
    // Instances are counted from 1; 0 and NaN mean all of them.
    let number = if message.param3.is_nan() { Some(0) } else { whole(message.param3) };
    let number = number.filter(|n| *n <= injectable.count(unit)).ok_or(MavResult::MAV_RESULT_DENIED)?;
    let failure = Failure { unit, manner, instance: number.checked_sub(1) };
    failures.push(failure).map_err(|_| MavResult::MAV_RESULT_TEMPORARILY_REJECTED)?;
    Ok(MavResult::MAV_RESULT_ACCEPTED)
}

/// A parameter as an integer from 0 to 255.
fn whole(parameter: f32) -> Option<u8> {
    let number = parameter as u8;
    (f32::from(number) == parameter).then_some(number)
}

/// The unit of a MAVLink `FAILURE_UNIT`.
fn unit_of(number: u8) -> Option<Unit> {
    Some(match number {
        0 => Unit::Gyro,
        1 => Unit::Accel,
        2 => Unit::Mag,
        3 => Unit::Baro,
        4 => Unit::Gnss,
        100 => Unit::Battery,
        101 => Unit::Motor,
        _ => return None,
    })
}

fn set_message_interval(message: &CommandMessage, view: &View, telemetry: &mut Telemetry) -> MavResult {
    let [param5, param6] = match message.form {
        Form::Long(parameters) => parameters,
        Form::Int { xy, .. } => xy.map(|integer| integer as f32),
    };
    let reserved = [message.param3, message.param4, param5, param6];
    // Parameter 7: to whom it is sent; 0 is the default, 1 the sender, 2 everyone on the link.
    if !reserved.into_iter().all(is_unset) || !(is_unset(message.param7) || [1.0, 2.0].contains(&message.param7)) {
        return MavResult::MAV_RESULT_DENIED;
    }
    match telemetry.set_interval(view.now, message.param1, message.param2) {
        Ok(()) => MavResult::MAV_RESULT_ACCEPTED,
        Err(IntervalError::UnknownMessage) => MavResult::MAV_RESULT_UNSUPPORTED,
        Err(IntervalError::Refused) => MavResult::MAV_RESULT_DENIED,
    }
}

/// A parameter that is not set: NaN, or 0 from senders that know no NaN.
fn is_unset(parameter: f32) -> bool {
    parameter.is_nan() || parameter == 0.0
}

fn request_message(message: &CommandMessage, view: &View, telemetry: &mut Telemetry) -> Effect {
    match report_by_id(message.param1) {
        Some(Report::AvailableModes(_)) => request_modes(message.param2, telemetry),
        Some(Report::MessageInterval { .. }) => interval_of(message.param2, telemetry),
        Some(report) => request(report, view),
        None => MavResult::MAV_RESULT_UNSUPPORTED.into(),
    }
}

/// Answers with a report, if its data is available.
fn request(report: Report, view: &View) -> Effect {
    if is_available(report, view) { Effect::Report(report) } else { MavResult::MAV_RESULT_TEMPORARILY_REJECTED.into() }
}

fn request_if(valid: bool, report: Report, view: &View) -> Effect {
    if valid { request(report, view) } else { MavResult::MAV_RESULT_DENIED.into() }
}

/// The mode with a number, from 1; all for 0 and NaN.
fn request_modes(number: f32, telemetry: &mut Telemetry) -> Effect {
    if is_unset(number) {
        telemetry.send_all_modes();
        return MavResult::MAV_RESULT_ACCEPTED.into();
    }
    match whole(number) {
        Some(number) if number <= MODES => Effect::Report(Report::AvailableModes(number)),
        _ => MavResult::MAV_RESULT_DENIED.into(),
    }
}

/// Answers with the interval of a message; one that does not exist has none.
fn interval_of(id: f32, telemetry: &Telemetry) -> Effect {
    let number = id as u16;
    if f32::from(number) != id {
        return MavResult::MAV_RESULT_DENIED.into();
    }
    Effect::Report(Report::MessageInterval { id: number, interval_us: telemetry.interval(id) })
}

/// The `MAV_RESULT` of the commander's outcome.
pub(super) fn result_of(outcome: Outcome) -> MavResult {
    match outcome {
        Outcome::Accepted => MavResult::MAV_RESULT_ACCEPTED,
        Outcome::TemporarilyRejected(_) => MavResult::MAV_RESULT_TEMPORARILY_REJECTED,
        Outcome::Denied => MavResult::MAV_RESULT_DENIED,
    }
}
