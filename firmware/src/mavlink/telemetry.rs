//! Periodic telemetry: one table of messages and periods, and how each message is filled in.
//!
//! Owns when each message is next due; a ground station may change the intervals (`MAV_CMD_SET_MESSAGE_INTERVAL`). A
//! message that does not fit into a job's bytes is sent by a later job.

use glissade_dialect::mavlink_core::{MessageData, types::CharArray};
use glissade_dialect::{
    ATTITUDE_DATA, AUTOPILOT_VERSION_DATA, ESTIMATOR_STATUS_DATA, EXTENDED_SYS_STATE_DATA, HEARTBEAT_DATA,
    LOCAL_POSITION_NED_DATA, MavAutopilot, MavLandedState, MavModeFlag, MavProtocolCapability, MavState, MavType,
    NAMED_VALUE_INT_DATA, SYS_STATUS_DATA,
};

use super::outbox::TELEMETRY_SHARE;
use super::port::SENT_CAPACITY;
use super::writer::{Writer, frame_len};
use super::{GroundInput, LoopTiming, mode, status};
use crate::commander::Mode;
use crate::control::euler::Euler;
use crate::frames::flip_vector;
use crate::schedule::GROUND;
use crate::signals::{TICK_US, Tick};

/// A message that can be sent periodically or on request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Report {
    Heartbeat,
    Attitude,
    LocalPosition,
    SysStatus,
    EstimatorStatus,
    ExtendedSysState,
    LoopTiming,
    AutopilotVersion,
}

/// A row of the telemetry table.
struct Stream {
    report: Report,
    /// MAVLink message number.
    id: u32,
    /// Default, in ticks; 0 for never.
    period: Tick,
    /// First due at this tick, so that messages are spread over jobs.
    phase: Tick,
}

const fn stream<D: MessageData>(report: Report, period: Tick, phase: Tick) -> Stream {
    Stream { report, id: D::ID, period, phase }
}

const STREAM_COUNT: usize = 8;

/// Every message that can be sent, its default period and first tick. The motion is sent at 20 Hz, which leaves two
/// thirds of a 57,600 baud radio free; a ground station can set a shorter interval.
const STREAMS: [Stream; STREAM_COUNT] = [
    stream::<HEARTBEAT_DATA>(Report::Heartbeat, 1000, 0),
    stream::<ATTITUDE_DATA>(Report::Attitude, 50, 0),
    stream::<LOCAL_POSITION_NED_DATA>(Report::LocalPosition, 50, 10),
    stream::<SYS_STATUS_DATA>(Report::SysStatus, 500, 50),
    stream::<ESTIMATOR_STATUS_DATA>(Report::EstimatorStatus, 1000, 350),
    stream::<EXTENDED_SYS_STATE_DATA>(Report::ExtendedSysState, 500, 150),
    stream::<NAMED_VALUE_INT_DATA>(Report::LoopTiming, 1000, 250),
    stream::<AUTOPILOT_VERSION_DATA>(Report::AutopilotVersion, 0, 0),
];

/// Error of setting an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum IntervalError {
    /// The message is not in the table.
    UnknownMessage,
    /// The interval is invalid, or not allowed for this message.
    Refused,
}

#[derive(Clone, Copy, Debug)]
struct Slot {
    /// 0 for never.
    period: Tick,
    next: Tick,
}

/// When each message is due.
#[derive(Clone, Debug)]
pub(super) struct Telemetry {
    /// In the order of [`STREAMS`].
    slots: [Slot; STREAM_COUNT],
}

impl Default for Telemetry {
    fn default() -> Self {
        Self { slots: STREAMS.map(|stream| Slot { period: stream.period, next: stream.phase }) }
    }
}

impl Telemetry {
    /// Sends what is due at `now` and fits.
    pub(super) fn send(&mut self, now: Tick, input: &GroundInput, errors: u32, out: &mut Writer) {
        for (slot, stream) in self.slots.iter_mut().zip(&STREAMS) {
            if slot.period == 0 || now.wrapping_sub(slot.next) > Tick::MAX / 2 {
                continue;
            }
            // Without a heartbeat the vehicle counts as lost, however much there is to say.
            out.set_limit(if stream.report == Report::Heartbeat { SENT_CAPACITY } else { TELEMETRY_SHARE });
            if write(stream.report, now, input, errors, out) {
                let late = now.wrapping_sub(slot.next);
                // Keeps the average rate, unless a whole period has been missed.
                let from = if late < slot.period { slot.next } else { now };
                slot.next = from.wrapping_add(slot.period);
            }
        }
    }

    /// Sets a message's interval, µs: 0 for its default, −1 for never.
    ///
    /// The heartbeat's interval is fixed: ground stations take its absence for the loss of the vehicle.
    pub(super) fn set_interval(&mut self, now: Tick, id: f32, interval_us: f32) -> Result<(), IntervalError> {
        let (slot, stream) = self
            .slots
            .iter_mut()
            .zip(&STREAMS)
            .find(|(_, s)| s.id as f32 == id)
            .ok_or(IntervalError::UnknownMessage)?;
        let period = if interval_us == 0.0 {
            stream.period
        } else if interval_us == -1.0 && stream.report != Report::Heartbeat {
            0
        } else if interval_us > 0.0 && interval_us.is_finite() && stream.report != Report::Heartbeat {
            keepable((interval_us / TICK_US as f32) as Tick)
        } else {
            return Err(IntervalError::Refused);
        };
        *slot = Slot { period, next: now };
        Ok(())
    }
}

/// The nearest period that can be scheduled.
fn keepable(period: Tick) -> Tick {
    // At most a quarter of the clock's range, or "due" could not be distinguished from "not yet due".
    period.clamp(GROUND.period, Tick::MAX / 4)
}

/// The message with this number, if it can be sent.
pub(super) fn report_by_id(id: f32) -> Option<Report> {
    STREAMS.iter().find(|stream| stream.id as f32 == id).map(|stream| stream.report)
}

/// True if the report's data is available.
pub(super) fn is_available(report: Report, input: &GroundInput) -> bool {
    match report {
        Report::LoopTiming => input.health.timing.is_some(),
        Report::EstimatorStatus => input.estimator.is_some(),
        _ => true,
    }
}

/// Appends a report; false, with nothing written, if it does not fit.
pub(super) fn write(report: Report, now: Tick, input: &GroundInput, errors: u32, out: &mut Writer) -> bool {
    match report {
        Report::Heartbeat => out.write(&heartbeat(input)),
        Report::Attitude => out.write(&attitude(now, input)),
        Report::LocalPosition => out.write(&local_position(now, input)),
        Report::SysStatus => out.write(&status::sys_status(input, errors)),
        // On ideal state there is no estimator, and no message.
        Report::EstimatorStatus => {
            input.estimator.is_none_or(|estimator| out.write(&status::estimator_status(now, &estimator)))
        }
        Report::ExtendedSysState => out.write(&extended_sys_state(input)),
        Report::LoopTiming => input.health.timing.is_none_or(|timing| write_timing(now, timing, out)),
        Report::AutopilotVersion => out.write(&autopilot_version()),
    }
}

/// A tick as MAVLink's time since boot.
fn boot_ms(tick: Tick) -> u32 {
    // A tick is a millisecond now; this holds for other lengths too.
    (u64::from(tick) * u64::from(TICK_US) / 1000) as u32
}

fn heartbeat(input: &GroundInput) -> HEARTBEAT_DATA {
    let flags = MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
        | MavModeFlag::MAV_MODE_FLAG_STABILIZE_ENABLED
        | MavModeFlag::MAV_MODE_FLAG_GUIDED_ENABLED
        | MavModeFlag::MAV_MODE_FLAG_AUTO_ENABLED;
    let (armed, state) = if input.armed {
        let fails = matches!(input.mode, Mode::Descent | Mode::MotorOut);
        let state = if fails { MavState::MAV_STATE_CRITICAL } else { MavState::MAV_STATE_ACTIVE };
        (MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED, state)
    } else {
        (MavModeFlag::empty(), MavState::MAV_STATE_STANDBY)
    };
    HEARTBEAT_DATA {
        custom_mode: mode::custom_mode(input.mode),
        mavtype: MavType::MAV_TYPE_QUADROTOR as u8,
        autopilot: MavAutopilot::MAV_AUTOPILOT_PX4 as u8,
        base_mode: (flags | armed).bits() as u8,
        system_status: state as u8,
        mavlink_version: glissade_dialect::MINOR_MAVLINK_VERSION,
    }
}

fn attitude(now: Tick, input: &GroundInput) -> ATTITUDE_DATA {
    let angles = flip_vector(&Euler::from_quaternion(&input.nav.attitude).angles());
    let rates = flip_vector(&input.nav.rates);
    ATTITUDE_DATA {
        time_boot_ms: boot_ms(now),
        roll: angles.x,
        pitch: angles.y,
        yaw: angles.z,
        rollspeed: rates.x,
        pitchspeed: rates.y,
        yawspeed: rates.z,
    }
}

fn local_position(now: Tick, input: &GroundInput) -> LOCAL_POSITION_NED_DATA {
    let position = flip_vector(&input.nav.position);
    let velocity = flip_vector(&input.nav.velocity);
    LOCAL_POSITION_NED_DATA {
        time_boot_ms: boot_ms(now),
        x: position.x,
        y: position.y,
        z: position.z,
        vx: velocity.x,
        vy: velocity.y,
        vz: velocity.z,
    }
}

fn extended_sys_state(input: &GroundInput) -> EXTENDED_SYS_STATE_DATA {
    let landed_state = match input.mode {
        // Clients wait for "in the air", which it is once it has lifted off.
        Mode::TakeOff if input.landed && input.armed => MavLandedState::MAV_LANDED_STATE_TAKEOFF,
        _ if input.landed => MavLandedState::MAV_LANDED_STATE_ON_GROUND,
        Mode::Land | Mode::Descent | Mode::MotorOut => MavLandedState::MAV_LANDED_STATE_LANDING,
        _ => MavLandedState::MAV_LANDED_STATE_IN_AIR,
    };
    EXTENDED_SYS_STATE_DATA { landed_state, ..EXTENDED_SYS_STATE_DATA::DEFAULT }
}

/// All four values or none.
fn write_timing(now: Tick, timing: LoopTiming, out: &mut Writer) -> bool {
    let (shortest, longest) = timing.inner_period_us;
    let values: [(&[u8; 10], u16); 4] = [
        (b"inner_hz\0\0", timing.inner_hz),
        (b"outer_hz\0\0", timing.outer_hz),
        (b"min_us\0\0\0\0", shortest),
        (b"max_us\0\0\0\0", longest),
    ];
    out.has_room(values.len() * frame_len::<NAMED_VALUE_INT_DATA>())
        && values.into_iter().all(|(name, value)| {
            out.write(&NAMED_VALUE_INT_DATA {
                time_boot_ms: boot_ms(now),
                value: value.into(),
                name: CharArray::new(*name),
            })
        })
}

fn autopilot_version() -> AUTOPILOT_VERSION_DATA {
    AUTOPILOT_VERSION_DATA {
        capabilities: MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_COMMAND_INT
            | MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE
            | MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_MAVLINK2,
        flight_sw_version: SOFTWARE_VERSION,
        ..AUTOPILOT_VERSION_DATA::DEFAULT
    }
}

/// This crate's version: major, minor, patch, and 0 for a development version. QGroundControl compares the
/// version of any other type with PX4's.
const SOFTWARE_VERSION: u32 = decimal(env!("CARGO_PKG_VERSION_MAJOR")) << 24
    | decimal(env!("CARGO_PKG_VERSION_MINOR")) << 16
    | decimal(env!("CARGO_PKG_VERSION_PATCH")) << 8;

const fn decimal(text: &str) -> u32 {
    match u8::from_str_radix(text, 10) {
        Ok(number) => number as u32,
        Err(_) => 0,
    }
}

#[cfg(test)]
mod tests {
    use glissade_dialect::MavMessage;
    use glissade_dialect::mavlink_core::Message as _;

    use super::*;

    /// Number and period of a row ``| `NAME` | period in ms | …``.
    fn documented(line: &str) -> Option<(u32, Tick)> {
        let (name, rest) = line.strip_prefix("| `")?.split_once("` | ")?;
        let (period_ms, _) = rest.split_once(" |")?;
        let id = MavMessage::message_id_from_name(name)?;
        Some((id, period_ms.parse::<Tick>().ok()? * 1000 / TICK_US))
    }

    #[test]
    fn the_document_tells_the_default_intervals() {
        let rows: Vec<_> = include_str!("../../../docs/mavlink.md").lines().filter_map(documented).collect();
        let streams: Vec<_> = STREAMS.iter().filter(|s| s.period != 0).map(|s| (s.id, s.period)).collect();
        assert_eq!(rows, streams);
    }
}
