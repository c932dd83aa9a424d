//! What may be asked of the commander, and what it answers and reports.

use core::ops::RangeInclusive;

use crate::math;

/// Height of a take-off for which none is given, m.
pub const TAKE_OFF_HEIGHT_M: f32 = 2.5;
/// Heights of a take-off, m: higher than what a landed vehicle's height is uncertain by, and low enough to be over in a
/// minute or so.
pub const TAKE_OFF_HEIGHTS_M: RangeInclusive<f32> = 0.3..=100.0;
/// No flight goes farther from its origin along an axis, m.
pub const FARTHEST_M: f32 = 10_000.0;
/// Faster than any limit that may be configured, m/s.
pub const FASTEST_M_S: f32 = 100.0;

/// What a ground station, or a program on board, may ask for. World frame NWU.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Request {
    /// Let the rotors turn; `force` skips the checks.
    Arm {
        /// Skip the checks.
        force: bool,
    },
    /// Stop the rotors; `force` also in the air.
    Disarm {
        /// Also in the air.
        force: bool,
    },
    /// Climb from the ground, and hold there.
    TakeOff {
        /// Over the ground, m.
        height_m: f32,
    },
    /// Brake, and stay.
    Hold,
    /// Go to a place, and stay.
    GoTo {
        /// m.
        position_m: [f32; 3],
        /// ψ, rad.
        yaw_rad: f32,
    },
    /// Fly with a velocity for [`VELOCITY_TIMEOUT_S`](super::VELOCITY_TIMEOUT_S), unless asked again.
    Velocity {
        /// m/s.
        velocity_m_s: [f32; 3],
        /// ψ̇, rad/s.
        yaw_rate_rad_s: f32,
    },
    /// Land here.
    Land,
    /// Return to where it was armed, and land.
    Return,
    /// Fly the configured trajectory.
    Follow,
}

impl Request {
    /// True if every number of it is one that a vehicle can be asked for.
    pub fn is_sane(&self) -> bool {
        /// Two turns, or two turns a second.
        const ANGLE: f32 = 4.0 * core::f32::consts::PI;
        // A comparison with NaN is false.
        let within = |values: &[f32], most: f32| values.iter().all(|value| math::abs(*value) <= most);
        match self {
            Self::TakeOff { height_m } => TAKE_OFF_HEIGHTS_M.contains(height_m),
            Self::GoTo { position_m, yaw_rad } => within(position_m, FARTHEST_M) && within(&[*yaw_rad], ANGLE),
            Self::Velocity { velocity_m_s, yaw_rate_rad_s } => {
                within(velocity_m_s, FASTEST_M_S) && within(&[*yaw_rate_rad_s], ANGLE)
            }
            Self::Arm { .. } | Self::Disarm { .. } | Self::Hold | Self::Land | Self::Return | Self::Follow => true,
        }
    }
}

/// Where a request has come from, so that the answer finds its way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// From a program on board: nobody waits for an answer.
    OnBoard,
    /// From a ground station.
    Station {
        /// MAVLink system and component of the sender.
        sender: (u8, u8),
        /// Number in `MAV_CMD` of what it has sent.
        command: u16,
    },
}

/// A request and where it has come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command {
    /// What is asked.
    pub request: Request,
    /// By whom.
    pub origin: Origin,
}

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Done, or under way.
    Accepted,
    /// Not now; the reason may pass.
    TemporarilyRejected(Refusal),
    /// It holds a number that makes no sense.
    Denied,
}

/// Why a command was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// No valid motion from the sensors.
    NoNavigation,
    /// Roll and pitch, or the heading, are not known yet.
    NotAligned,
    /// The position is not known.
    NoPosition,
    /// The height is not known.
    NoHeight,
    /// Tilted more than 20°.
    NotLevel,
    /// Moving faster than 0.5 m/s.
    Moving,
    /// The battery is too low.
    Battery,
    /// A rotor has failed.
    RotorFailed,
    /// In the air.
    InAir,
    /// On the ground: it is to take off first.
    OnGround,
    /// Rotors stopped: it is to be armed first.
    Disarmed,
    /// The trajectory begins elsewhere.
    NotAtStart,
}

/// The answer to a command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reply {
    /// The command.
    pub command: Command,
    /// How it ended.
    pub outcome: Outcome,
}

/// Something that the pilot has not asked for and is to know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// Samples have stopped coming: descends without knowing anything.
    SensorsLost,
    /// They have not come back: the rotors are stopped.
    SensorsGone,
    /// The attitude is not known: descends level, as far as that goes.
    AttitudeLost,
    /// The height is not known: descends with less thrust than its weight.
    HeightLost,
    /// Position and velocity are not known: descends level.
    VelocityLost,
    /// The position is not known: descends where it has stopped.
    PositionLost,
    /// Returns.
    BatteryLow,
    /// Lands at once.
    BatteryCritical,
    /// Lands at once, turning.
    RotorFailed {
        /// Which, from 0.
        rotor: u8,
    },
}

/// Commands between two jobs.
pub type Commands = heapless::Vec<Command, 4>;
/// Replies of one job.
pub type Replies = heapless::Vec<Reply, 4>;
/// Events between two jobs of the ground partition.
pub type Events = heapless::Vec<Event, 4>;
