//! Requests to the commander, its replies, and the events that it reports.

use core::ops::RangeInclusive;

use super::{Goal, ManualMode, MotorTest, OrbitGoal, SpeedKind, StationAction};
use crate::math;

/// Default height of a take-off, m.
pub const TAKE_OFF_HEIGHT_M: f32 = 2.5;
/// Accepted heights of a take-off, m: more than the uncertainty of a landed vehicle's height, and low enough to be
/// reached in about a minute.
pub const TAKE_OFF_HEIGHTS_M: RangeInclusive<f32> = 0.3..=100.0;
/// Greatest accepted distance from the origin along an axis, m.
pub const FARTHEST_M: f32 = 10_000.0;
/// Greatest accepted speed, m/s: above any limit that may be configured.
pub const FASTEST_M_S: f32 = 100.0;
/// Accepted speeds on the way to a goal, m/s: slower, nothing would ever arrive.
pub(super) const SPEEDS_M_S: RangeInclusive<f32> = 0.05..=FASTEST_M_S;

/// A request of a ground station or of a program on board. World frame NWU.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Request {
    /// Arm: the rotors may turn.
    Arm {
        /// Skip the checks.
        force: bool,
    },
    /// Disarm, on the ground: the rotors stop.
    Disarm,
    /// Turn a motor of a disarmed vehicle.
    TestMotor {
        /// Which, and how fast.
        test: MotorTest,
        /// For how long, s.
        seconds: f32,
    },
    /// Climb from the ground, and hold there.
    TakeOff {
        /// Over the ground, m.
        height_m: f32,
    },
    /// Brake, and stay.
    Hold,
    /// Fly by hand.
    Manual(ManualMode),
    /// Follow streamed set-points.
    Offboard,
    /// Fly a circle.
    Orbit(OrbitGoal),
    /// Go to a place, a height or a heading, and stay.
    GoTo(Goal),
    /// Set a speed for the way to a goal.
    Speed {
        /// Which.
        kind: SpeedKind,
        /// m/s; `None` for that of the settings.
        speed_m_s: Option<f32>,
    },
    /// Fly with a velocity; expires after [`VELOCITY_TIMEOUT_S`](super::VELOCITY_TIMEOUT_S) unless it is repeated.
    Velocity {
        /// m/s.
        velocity_m_s: [f32; 3],
        /// ψ̇, rad/s.
        yaw_rate_rad_s: f32,
    },
    /// Land here.
    Land,
    /// Go to a place and a heading at this height, and land there.
    LandAt(Goal),
    /// Return home, and land: to where it was armed, or to where home was set.
    Return,
    /// Fly the configured trajectory.
    Follow,
    /// Set where a return leads. Kept until the vehicle is disarmed.
    SetHome {
        /// m; `None` for the present position.
        position_m: Option<[f32; 3]>,
    },
}

/// Greatest accepted angle or rate: two turns, or two turns per second.
pub(crate) const TURN_MAX: f32 = 4.0 * core::f32::consts::PI;

/// Whether all values are finite and within ±`most`: a comparison with NaN is false.
pub(super) fn within(values: &[f32], most: f32) -> bool {
    values.iter().all(|value| math::abs(*value) <= most)
}

impl Request {
    /// True if every value is finite and within the accepted range.
    pub fn is_sane(&self) -> bool {
        match self {
            Self::TakeOff { height_m } => TAKE_OFF_HEIGHTS_M.contains(height_m),
            Self::TestMotor { test, seconds } => test.is_sane(*seconds),
            Self::GoTo(goal) | Self::LandAt(goal) => goal.is_sane(),
            Self::Orbit(goal) => goal.is_sane(),
            Self::Velocity { velocity_m_s, yaw_rate_rad_s } => {
                within(velocity_m_s, FASTEST_M_S) && within(&[*yaw_rate_rad_s], TURN_MAX)
            }
            Self::Speed { speed_m_s, .. } => speed_m_s.is_none_or(|speed| SPEEDS_M_S.contains(&speed)),
            Self::SetHome { position_m } => position_m.is_none_or(|position_m| within(&position_m, FARTHEST_M)),
            Self::Arm { .. }
            | Self::Disarm
            | Self::Hold
            | Self::Manual(_)
            | Self::Offboard
            | Self::Land
            | Self::Return
            | Self::Follow => true,
        }
    }
}

/// What a program on board or a scripted pilot asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Asked {
    /// A request, which waits in a queue for the commander's decision.
    Request(Request),
    /// Stop the rotors at once, also in the air. Waits in no queue and needs no decision.
    Kill,
}

impl From<Request> for Asked {
    fn from(request: Request) -> Self {
        Self::Request(request)
    }
}

/// The sender of a request, to which the reply goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A program on board: no acknowledgement is sent.
    OnBoard,
    /// A ground station.
    Station {
        /// The link on which it came.
        link: u8,
        /// Which of the link's peers sent it: how often the link had been opened, wrapping.
        peer: u16,
        /// MAVLink system and component of the sender.
        sender: (u8, u8),
        /// The `MAV_CMD` that it sent.
        command: u16,
    },
}

/// A request and its sender.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command {
    /// The request.
    pub request: Request,
    /// Its sender.
    pub origin: Origin,
}

/// Result of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Done, or in progress.
    Accepted,
    /// Refused for a reason that may pass.
    TemporarilyRejected(Refusal),
    /// A parameter is not finite or out of range.
    Denied,
}

/// Why a command was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The vehicle does something that this would end.
    NotHolding,
    /// No valid motion from the sensors.
    NoNavigation,
    /// No valid estimate of roll and pitch.
    NotAligned,
    /// No valid estimate of the heading.
    NoHeading,
    /// No valid estimate of position or velocity.
    NoPosition,
    /// No valid estimate of the height.
    NoHeight,
    /// Tilted more than 20°.
    NotLevel,
    /// Moving faster than 0.5 m/s.
    Moving,
    /// The battery is too low.
    Battery,
    /// A rotor has failed.
    RotorFailed,
    /// The outer partition hangs.
    NoGuidance,
    /// The commander hangs.
    NoCommander,
    /// In the air.
    InAir,
    /// On the ground: take off first.
    OnGround,
    /// Disarmed: arm first.
    Disarmed,
    /// Armed: disarm first.
    Armed,
    /// The flight was terminated: restart the vehicle.
    Terminated,
    /// Not at the start point of the trajectory.
    NotAtStart,
    /// The vehicle was never configured.
    NotConfigured,
    /// It is configured with rotors that cannot lift it, or with next to no weight.
    ThrustToWeight,
    /// More commands at once than the commander takes.
    Busy,
    /// What can be set while disarmed only is still being set.
    Unsettled,
    /// The rotors were stopped a moment ago.
    Killed,
    /// The kill switch is on.
    KillSwitch,
    /// No sticks.
    NoSticks,
    /// The throttle stick would lift the vehicle.
    ThrottleUp,
    /// No set-points.
    NoSetPoints,
}

/// The reply to a command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reply {
    /// The command.
    pub command: Command,
    /// Its result.
    pub outcome: Outcome,
}

impl Reply {
    /// For the ground partition; `None` if the command came from on board.
    pub fn to_station(&self) -> Option<StationReply> {
        let Origin::Station { link, peer, sender, command } = self.command.origin else { return None };
        let request = self.command.request.name();
        Some(StationReply { link, peer, sender, command, request, outcome: self.outcome })
    }
}

/// The reply to a ground station: no more of the command than there is to say, as it is copied under the lock that the
/// inner task waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StationReply {
    /// The link on which the command came.
    pub link: u8,
    /// Which of the link's peers sent it: another one is not told.
    pub peer: u16,
    /// MAVLink system and component of its sender.
    pub sender: (u8, u8),
    /// The `MAV_CMD` that it sent.
    pub command: u16,
    /// What was requested.
    pub request: &'static str,
    /// Its result.
    pub outcome: Outcome,
}

/// A failsafe event, to be reported to the pilot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// No sensor samples: descends level with a thrust below the weight.
    SensorsLost,
    /// Still no sensor samples: the rotors are stopped.
    SensorsGone,
    /// Attitude unknown: levels as well as the estimate allows, with a thrust below the weight.
    AttitudeLost,
    /// Height unknown: descends level at a rate, or with a thrust below the weight if the vertical velocity is unknown
    /// too.
    HeightLost,
    /// Position and velocity unknown: descends level.
    VelocityLost,
    /// Position unknown: brakes and descends.
    PositionLost,
    /// Battery low: returns home.
    BatteryLow,
    /// Battery critical: lands at once.
    BatteryCritical,
    /// No ground station is heard any more.
    StationLost {
        /// What is done without it.
        action: StationAction,
    },
    /// No sticks any more in a manual mode.
    SticksLost {
        /// What is done without them.
        action: StationAction,
    },
    /// No set-points any more in offboard mode.
    SetPointsLost {
        /// What is done without them; `None` for flying by hand.
        action: Option<StationAction>,
    },
    /// Position or velocity unknown in position mode: altitude mode.
    NoPositionMode,
    /// Vertical velocity unknown in altitude mode: stabilized mode.
    NoAltitudeMode,
    /// A rotor has failed: descends at once, without yaw control.
    RotorFailed {
        /// Which, from 0.
        rotor: u8,
    },
    /// Sticks or a switch have asked to arm, and the vehicle does not.
    ArmingRefused {
        /// Why.
        refusal: Refusal,
    },
    /// A take-off has waited for the rotors, and is not possible any more.
    TakeOffRefused {
        /// Why.
        refusal: Refusal,
    },
    /// The outer partition hangs: the inner one holds level with a thrust below the weight.
    OuterHung,
    /// The commander hangs: the outer partition descends by what is known.
    CommanderHung,
}

/// Commands between two jobs.
pub type Commands = heapless::Vec<Command, 4>;
/// Replies of one job.
pub type Replies = heapless::Vec<Reply, 4>;
/// Replies between two jobs of the ground partition: those of a commander's job, and those to commands that did not fit.
pub type Answers = heapless::Vec<StationReply, 8>;
/// Events between two jobs of the ground partition.
pub type Events = heapless::Vec<Event, 4>;
