//! Telemetry of one link: one table of messages and rates, and how each message is filled in.
//!
//! [`Telemetry`] owns when each message is next due on its link; a ground station may change the intervals
//! (`MAV_CMD_SET_MESSAGE_INTERVAL`). A job begins with the message that did not fit into the last one's bytes, so that
//! what is due takes turns however much of it there is. What a message is made of is the job's [`View`]; the messages themselves are grouped by subject:
//!
//! | module | messages |
//! |---|---|
//! | `motion` | attitude, local position, odometry, what a pilot reads off |
//! | `global` | place on Earth, home, heights, GNSS, UTC |
//! | `control` | what is aimed at, the rotors, the inside of the control laws |
//! | `sensors` | IMU, pressure, wind, vibration |
//! | `status` | heartbeat, health, estimator, battery, landed state, loop rates |
//! | `identity` | versions, capabilities, modes |
//!
//! What is unknown is sent as MAVLink's value for unknown, or not at all.

mod control;
mod global;
mod identity;
mod motion;
mod sensors;
mod status;
mod view;

use glissade_dialect::mavlink_core::MessageData;
use glissade_dialect::{
    ALTITUDE_DATA, ATTITUDE_DATA, ATTITUDE_QUATERNION_DATA, ATTITUDE_TARGET_DATA, AUTOPILOT_VERSION_DATA,
    AVAILABLE_MODES_DATA, BATTERY_STATUS_DATA, CURRENT_MODE_DATA, DEBUG_FLOAT_ARRAY_DATA, ESC_STATUS_DATA,
    ESTIMATOR_STATUS_DATA, EXTENDED_SYS_STATE_DATA, GLOBAL_POSITION_INT_DATA, GPS_GLOBAL_ORIGIN_DATA, GPS_RAW_INT_DATA,
    HEARTBEAT_DATA, HIGHRES_IMU_DATA, HOME_POSITION_DATA, LOCAL_POSITION_NED_DATA, MESSAGE_INTERVAL_DATA,
    NAMED_VALUE_INT_DATA, ODOMETRY_DATA, ORBIT_EXECUTION_STATUS_DATA, POSITION_TARGET_LOCAL_NED_DATA,
    PROTOCOL_VERSION_DATA, RC_CHANNELS_DATA, SCALED_IMU_DATA, SCALED_PRESSURE_DATA, SERVO_OUTPUT_RAW_DATA,
    SYS_STATUS_DATA, SYSTEM_TIME_DATA, VFR_HUD_DATA, VIBRATION_DATA, WIND_COV_DATA,
};
use nalgebra::Vector3;

pub(super) use self::identity::{MODES, of_standard_mode};
pub(super) use self::view::{Place, View};
use super::outbox::ANSWERS_SHARE;
use super::port::{Profile, SENT_CAPACITY};
use super::sticks;
use super::writer::Writer;
use crate::schedule::GROUND;
use crate::signals::{TICK_US, Tick};

/// A message that can be sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Report {
    Heartbeat,
    SysStatus,
    ExtendedSysState,
    Attitude,
    AttitudeQuaternion,
    LocalPosition,
    GlobalPosition,
    VfrHud,
    Altitude,
    Odometry,
    GpsRaw,
    GpsGlobalOrigin,
    HomePosition,
    SystemTime,
    AttitudeTarget,
    PositionTarget,
    ServoOutput,
    EscStatus,
    HighresImu,
    ScaledImu,
    ScaledPressure,
    Battery,
    EstimatorStatus,
    Wind,
    Vibration,
    CurrentMode,
    RcChannels,
    LoopTiming,
    Orbit,
    SlidingMode,
    AutopilotVersion,
    ProtocolVersion,
    /// The mode with this number, from 1; 0 for all, one after the other.
    AvailableModes(u8),
    /// The interval at which a message is sent, µs: −1 for never, 0 for a message that does not exist.
    MessageInterval {
        id: u16,
        interval_us: i32,
    },
}

/// A row of the telemetry table.
struct Stream {
    report: Report,
    /// MAVLink message number.
    id: u32,
    /// Bytes of its longest frame.
    #[cfg(test)]
    bytes: usize,
    /// Default per [`Profile`], in ticks; 0 for never.
    periods: [Tick; 2],
    /// First due at this tick, so that messages are spread over jobs.
    phase: Tick,
}

impl Stream {
    fn period(&self, profile: Profile) -> Tick {
        let [normal, onboard] = self.periods;
        match profile {
            Profile::Normal => normal,
            Profile::Onboard => onboard,
        }
    }
}

/// A row: default periods in ticks for [`Profile::Normal`] and [`Profile::Onboard`], and the first tick.
const fn stream<D: MessageData>(report: Report, periods: [Tick; 2], phase: Tick) -> Stream {
    Stream {
        report,
        id: D::ID,
        #[cfg(test)]
        bytes: super::writer::frame_len::<D>(),
        periods,
        phase,
    }
}

const STREAM_COUNT: usize = 34;

/// Every message that can be sent, its default periods and first tick. The heartbeat is the first. Rates
/// follow PX4's `normal` and `onboard` modes. A link's test holds the sum of `normal` below 60 % of 57,600 baud.
const STREAMS: [Stream; STREAM_COUNT] = [
    stream::<HEARTBEAT_DATA>(Report::Heartbeat, [1000, 1000], 0),
    stream::<ATTITUDE_DATA>(Report::Attitude, [50, 10], 0),
    stream::<LOCAL_POSITION_NED_DATA>(Report::LocalPosition, [50, 20], 10),
    stream::<GLOBAL_POSITION_INT_DATA>(Report::GlobalPosition, [200, 20], 30),
    stream::<ATTITUDE_QUATERNION_DATA>(Report::AttitudeQuaternion, [500, 20], 0),
    stream::<VFR_HUD_DATA>(Report::VfrHud, [250, 100], 40),
    stream::<SYS_STATUS_DATA>(Report::SysStatus, [500, 200], 50),
    stream::<EXTENDED_SYS_STATE_DATA>(Report::ExtendedSysState, [500, 200], 150),
    stream::<BATTERY_STATUS_DATA>(Report::Battery, [2000, 500], 60),
    stream::<GPS_RAW_INT_DATA>(Report::GpsRaw, [1000, 200], 70),
    stream::<HOME_POSITION_DATA>(Report::HomePosition, [2000, 1000], 80),
    stream::<GPS_GLOBAL_ORIGIN_DATA>(Report::GpsGlobalOrigin, [5000, 1000], 90),
    stream::<ALTITUDE_DATA>(Report::Altitude, [1000, 100], 110),
    stream::<CURRENT_MODE_DATA>(Report::CurrentMode, [2000, 1000], 120),
    stream::<SYSTEM_TIME_DATA>(Report::SystemTime, [1000, 1000], 130),
    stream::<ATTITUDE_TARGET_DATA>(Report::AttitudeTarget, [500, 20], 140),
    stream::<POSITION_TARGET_LOCAL_NED_DATA>(Report::PositionTarget, [1000, 100], 160),
    stream::<ODOMETRY_DATA>(Report::Odometry, [0, 30], 20),
    stream::<HIGHRES_IMU_DATA>(Report::HighresImu, [0, 20], 10),
    stream::<SCALED_IMU_DATA>(Report::ScaledImu, [0, 40], 170),
    stream::<SCALED_PRESSURE_DATA>(Report::ScaledPressure, [1000, 100], 180),
    stream::<SERVO_OUTPUT_RAW_DATA>(Report::ServoOutput, [1000, 100], 190),
    stream::<ESC_STATUS_DATA>(Report::EscStatus, [1000, 100], 210),
    stream::<ESTIMATOR_STATUS_DATA>(Report::EstimatorStatus, [1000, 200], 350),
    stream::<WIND_COV_DATA>(Report::Wind, [2000, 500], 220),
    stream::<VIBRATION_DATA>(Report::Vibration, [2000, 500], 230),
    stream::<RC_CHANNELS_DATA>(Report::RcChannels, [500, 50], 240),
    stream::<NAMED_VALUE_INT_DATA>(Report::LoopTiming, [1000, 1000], 250),
    stream::<ORBIT_EXECUTION_STATUS_DATA>(Report::Orbit, [500, 200], 260),
    stream::<DEBUG_FLOAT_ARRAY_DATA>(Report::SlidingMode, [0, 0], 0),
    stream::<AUTOPILOT_VERSION_DATA>(Report::AutopilotVersion, [0, 0], 0),
    stream::<PROTOCOL_VERSION_DATA>(Report::ProtocolVersion, [0, 0], 0),
    stream::<AVAILABLE_MODES_DATA>(Report::AvailableModes(0), [0, 0], 0),
    stream::<MESSAGE_INTERVAL_DATA>(Report::MessageInterval { id: 0, interval_us: 0 }, [0, 0], 0),
];

impl Report {
    /// Whether it can be sent at an interval, and not only on request.
    fn is_periodic(self) -> bool {
        !matches!(self, Self::AvailableModes(_) | Self::MessageInterval { .. })
    }
}

/// Error of setting an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum IntervalError {
    /// The message is not in the table.
    UnknownMessage,
    /// The interval is invalid, or not allowed for this message.
    Refused,
}

/// Home and origin when a change of them was last told, which is done at once.
#[derive(Clone, Copy, Debug, Default)]
struct Told {
    /// m.
    home: Option<Vector3<f32>>,
    armed: bool,
    origin: Option<Place>,
}

impl Told {
    /// Whether `now` differs. Home follows the estimate, with all its noise, until the vehicle is armed: only what is farther
    /// away than this counts until then.
    fn has_other_home(&self, now: &Self) -> bool {
        /// 1 m, squared.
        const MOVED_M2: f32 = 1.0;
        match (self.home, now.home) {
            _ if self.armed != now.armed || self.origin != now.origin => true,
            (Some(before), Some(home)) if !now.armed => (home - before).norm_squared() > MOVED_M2,
            (before, home) => before != home,
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct Slot {
    /// 0 for never.
    period: Tick,
    next: Tick,
}

impl Slot {
    /// Setting what is set already has no effect.
    fn set(&mut self, period: Tick, now: Tick) {
        if period != self.period {
            *self = Self { period, next: now };
        }
    }

    fn is_due(self, now: Tick) -> bool {
        self.period != 0 && now.wrapping_sub(self.next) <= Tick::MAX / 2
    }

    /// Keeps the average rate, unless a whole period has been missed.
    fn sent(&mut self, now: Tick) {
        let from = if now.wrapping_sub(self.next) < self.period { self.next } else { now };
        self.next = from.wrapping_add(self.period);
    }
}

/// When each message is due on one link.
#[derive(Clone, Debug)]
pub(super) struct Telemetry {
    profile: Profile,
    /// In the order of [`STREAMS`].
    slots: [Slot; STREAM_COUNT],
    /// Index of the message whose turn it is.
    first: usize,
    told: Told,
    /// The next of the modes that have been asked for.
    next_mode: Option<u8>,
}

impl Default for Telemetry {
    fn default() -> Self {
        Self::new(Profile::default(), 0)
    }
}

impl Telemetry {
    /// A link that is opened now, with the default rates of a profile.
    pub(super) fn new(profile: Profile, now: Tick) -> Self {
        let slots = STREAMS.map(|stream| Slot { period: stream.period(profile), next: now.wrapping_add(stream.phase) });
        Self { profile, slots, first: 0, told: Told::default(), next_mode: None }
    }

    /// The default rates again.
    pub(super) fn forget_rates(&mut self, now: Tick) {
        for (slot, stream) in self.slots.iter_mut().zip(&STREAMS) {
            slot.set(stream.period(self.profile), now);
        }
    }

    /// Sends what is due and fits: a heartbeat always, then the modes that have been asked for, then as long as no more
    /// than `share` bytes wait the rest, in turn.
    pub(super) fn send(&mut self, view: &View, share: usize, out: &mut Writer) {
        self.note_changes(view);
        // Without a heartbeat the vehicle counts as lost, however much there is to say.
        out.set_limit(SENT_CAPACITY);
        let [heartbeat, ..] = &mut self.slots;
        if heartbeat.is_due(view.now) && write(Report::Heartbeat, view, out) {
            heartbeat.sent(view.now);
        }
        out.set_limit(ANSWERS_SHARE);
        self.send_modes(view, out);
        out.set_limit(share);
        for index in (self.first..STREAM_COUNT).chain(0..self.first) {
            let (Some(slot), Some(stream)) = (self.slots.get_mut(index), STREAMS.get(index)) else { continue };
            if stream.report == Report::Heartbeat || !slot.is_due(view.now) {
                continue;
            }
            if !write(stream.report, view, out) {
                // Nor may a shorter one go before it, or a long one would never have room on a slow line.
                self.first = index;
                return;
            }
            slot.sent(view.now);
        }
    }

    /// Makes home and origin due if they have changed.
    fn note_changes(&mut self, view: &View) {
        let origin = global::origin(view);
        let now = Told { home: view.input.home.filter(|_| origin.is_some()), armed: view.input.armed, origin };
        if now.origin != self.told.origin {
            self.make_due(Report::GpsGlobalOrigin, view.now);
        }
        if self.told.has_other_home(&now) {
            self.make_due(Report::HomePosition, view.now);
            self.told = now;
        }
    }

    /// Makes a message due, unless it is never sent.
    fn make_due(&mut self, report: Report, now: Tick) {
        let found = self.slots.iter_mut().zip(&STREAMS).find(|(slot, s)| s.report == report && slot.period != 0);
        if let Some((slot, _)) = found {
            slot.next = now;
        }
    }

    /// Starts sending every mode, one after the other.
    pub(super) fn send_all_modes(&mut self) {
        self.next_mode = Some(1);
    }

    fn send_modes(&mut self, view: &View, out: &mut Writer) {
        while let Some(number) = self.next_mode {
            if !write(Report::AvailableModes(number), view, out) {
                return;
            }
            self.next_mode = number.checked_add(1).filter(|next| *next <= MODES);
        }
    }

    /// Sets a message's interval, µs: 0 for its default, −1 for never. NaN, which means unset, is 0. Setting what is set
    /// already has no effect.
    ///
    /// The heartbeat's interval is fixed: ground stations take its absence for the loss of the vehicle.
    pub(super) fn set_interval(&mut self, now: Tick, id: f32, interval_us: f32) -> Result<(), IntervalError> {
        let (slot, stream) = self
            .slots
            .iter_mut()
            .zip(&STREAMS)
            .find(|(_, s)| s.id as f32 == id && s.report.is_periodic())
            .ok_or(IntervalError::UnknownMessage)?;
        let period = if interval_us == 0.0 || interval_us.is_nan() {
            stream.period(self.profile)
        } else if interval_us == -1.0 && stream.report != Report::Heartbeat {
            0
        } else if interval_us > 0.0 && interval_us.is_finite() && stream.report != Report::Heartbeat {
            keepable((interval_us / TICK_US as f32) as Tick)
        } else {
            return Err(IntervalError::Refused);
        };
        slot.set(period, now);
        Ok(())
    }

    /// A message's interval, µs: −1 for never, 0 if there is no such message.
    pub(super) fn interval(&self, id: f32) -> i32 {
        let found = self.slots.iter().zip(&STREAMS).find(|(_, s)| s.id as f32 == id);
        found.map_or(0, |(slot, _)| match slot.period {
            0 => -1,
            period => i32::try_from(u64::from(period) * u64::from(TICK_US)).unwrap_or(i32::MAX),
        })
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

/// Appends a report. False, with nothing written, if it does not fit; true, with nothing written, if its data is not
/// available.
pub(super) fn write(report: Report, view: &View, out: &mut Writer) -> bool {
    match report {
        Report::Heartbeat => out.write(&status::heartbeat(view)),
        Report::SysStatus => out.write(&status::sys_status(view)),
        Report::ExtendedSysState => out.write(&status::extended_sys_state(view)),
        Report::EstimatorStatus => known(status::estimator_status(view), out),
        Report::Battery => known(status::battery_status(view), out),
        Report::LoopTiming => view.input.health.timing.is_none_or(|timing| status::write_timing(view, timing, out)),
        Report::Attitude => known(motion::attitude(view), out),
        Report::AttitudeQuaternion => known(motion::attitude_quaternion(view), out),
        Report::LocalPosition => known(motion::local_position(view), out),
        Report::VfrHud => known(motion::vfr_hud(view), out),
        Report::Odometry => known(motion::odometry(view), out),
        Report::GlobalPosition => known(global::global_position(view), out),
        Report::Altitude => known(global::altitude(view), out),
        Report::GpsRaw => known(global::gps_raw(view), out),
        Report::GpsGlobalOrigin => known(global::gps_global_origin(view), out),
        Report::HomePosition => known(global::home_position(view), out),
        Report::SystemTime => out.write(&global::system_time(view)),
        Report::AttitudeTarget => known(control::attitude_target(view), out),
        Report::PositionTarget => known(control::position_target(view), out),
        Report::ServoOutput => out.write(&control::servo_output(view)),
        Report::EscStatus => out.write(&control::esc_status(view)),
        Report::Orbit => known(control::orbit(view), out),
        Report::SlidingMode => out.write(&control::sliding_mode(view)),
        Report::HighresImu => known(sensors::highres_imu(view), out),
        Report::ScaledImu => known(sensors::scaled_imu(view), out),
        Report::ScaledPressure => known(sensors::scaled_pressure(view), out),
        Report::Wind => known(sensors::wind(view), out),
        Report::Vibration => known(sensors::vibration(view), out),
        Report::RcChannels => known(sticks::rc_channels(view), out),
        Report::CurrentMode => out.write(&identity::current_mode(view)),
        Report::AutopilotVersion => out.write(&identity::autopilot_version(view)),
        Report::ProtocolVersion => out.write(&identity::protocol_version()),
        Report::AvailableModes(number) => known(identity::available_mode(number), out),
        Report::MessageInterval { id, interval_us } => {
            out.write(&MESSAGE_INTERVAL_DATA { message_id: id, interval_us })
        }
    }
}

/// Appends a message whose data may not be available.
fn known<D: MessageData>(message: Option<D>, out: &mut Writer) -> bool {
    message.is_none_or(|message| out.write(&message))
}

/// True if the report's data is available.
pub(super) fn is_available(report: Report, view: &View) -> bool {
    match report {
        Report::LoopTiming => view.input.health.timing.is_some(),
        Report::EstimatorStatus => view.input.estimator.is_some(),
        Report::Battery => status::battery_status(view).is_some(),
        Report::Attitude => motion::attitude(view).is_some(),
        Report::AttitudeQuaternion => motion::attitude_quaternion(view).is_some(),
        Report::LocalPosition => motion::local_position(view).is_some(),
        Report::VfrHud => motion::vfr_hud(view).is_some(),
        Report::Odometry => motion::odometry(view).is_some(),
        Report::GlobalPosition => global::global_position(view).is_some(),
        Report::Altitude => global::altitude(view).is_some(),
        Report::GpsRaw => global::gps_raw(view).is_some(),
        Report::GpsGlobalOrigin => global::gps_global_origin(view).is_some(),
        Report::HomePosition => global::home_position(view).is_some(),
        Report::AttitudeTarget => control::attitude_target(view).is_some(),
        Report::PositionTarget => control::position_target(view).is_some(),
        Report::Orbit => control::orbit(view).is_some(),
        Report::HighresImu => sensors::highres_imu(view).is_some(),
        Report::ScaledImu => sensors::scaled_imu(view).is_some(),
        Report::ScaledPressure => sensors::scaled_pressure(view).is_some(),
        Report::Wind => sensors::wind(view).is_some(),
        Report::Vibration => sensors::vibration(view).is_some(),
        Report::RcChannels => sticks::rc_channels(view).is_some(),
        Report::AvailableModes(number) => identity::available_mode(number).is_some(),
        Report::Heartbeat
        | Report::SysStatus
        | Report::ExtendedSysState
        | Report::SystemTime
        | Report::ServoOutput
        | Report::EscStatus
        | Report::SlidingMode
        | Report::CurrentMode
        | Report::AutopilotVersion
        | Report::ProtocolVersion
        | Report::MessageInterval { .. } => true,
    }
}

#[cfg(test)]
mod tests {
    use glissade_dialect::MavMessage;
    use glissade_dialect::mavlink_core::Message as _;

    use super::*;

    /// Number and periods of a row ``| `NAME` | normal, ms | on board, ms | …``; a dash for never.
    fn documented(line: &str) -> Option<(u32, [Tick; 2])> {
        let (name, rest) = line.strip_prefix("| `")?.split_once("` | ")?;
        let id = MavMessage::message_id_from_name(name)?;
        let mut periods = rest.split(" | ").map_while(|cell| match cell {
            "–" => Some(0),
            number => Some(number.parse::<Tick>().ok()? * 1000 / TICK_US),
        });
        Some((id, [periods.next()?, periods.next()?]))
    }

    #[test]
    fn the_document_tells_the_default_intervals() {
        let rows: Vec<_> = include_str!("../../../../docs/mavlink.md").lines().filter_map(documented).collect();
        let streams: Vec<_> = STREAMS.iter().map(|s| (s.id, s.periods)).collect();
        assert_eq!(rows, streams);
    }

    /// Bytes in 10 s, if every frame had its greatest length.
    fn bytes_in_10_s(profile: Profile) -> usize {
        let frames = |stream: &Stream| if stream.report == Report::LoopTiming { 4 } else { 1 };
        STREAMS
            .iter()
            .filter(|stream| stream.period(profile) != 0)
            .map(|stream| frames(stream) * stream.bytes * 10_000 / stream.period(profile) as usize)
            .sum()
    }

    #[test]
    fn the_normal_rates_leave_two_fifths_of_a_slow_radio_free() {
        // 57,600 baud are 5,760 bytes a second, with start and stop bits.
        let normal = bytes_in_10_s(Profile::Normal);
        assert!(normal < 6 * 5_760, "{normal} bytes in 10 s");
        // The document says these numbers.
        let text = include_str!("../../../../docs/mavlink.md");
        for (profile, bytes) in [("normal", normal), ("onboard", bytes_in_10_s(Profile::Onboard))] {
            let said = format!("`{profile}`: {} bytes per second", (bytes + 5) / 10);
            assert!(text.contains(&said), "the document should have: {said}");
        }
    }

    #[test]
    fn every_message_stands_in_the_table_once() {
        for (index, stream) in STREAMS.iter().enumerate() {
            assert!(STREAMS.iter().skip(index + 1).all(|other| other.id != stream.id), "{}", stream.id);
        }
    }
}
