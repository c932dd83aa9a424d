//! What the pilot wants, and what overrides it.

use nalgebra::Vector3;

use super::{Goal, Known, ManualMode, Mode, OrbitGoal, Request, StationAction};

/// What the pilot wants: the last request to fly that was accepted. It is kept while a failure overrides it. A landing
/// and a disarming end it, unless it is to fly by hand or offboard; then it is [`Hold`](Self::Hold), as before the first request.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Intent {
    /// Stay.
    Hold,
    /// Climb from the ground, and hold there.
    TakeOff {
        /// Over the ground, m.
        height_m: f32,
    },
    /// Go to a place, a height or a heading, and stay.
    GoTo(Goal),
    /// Fly by hand.
    Manual(ManualMode),
    /// Follow streamed set-points.
    Offboard,
    /// Fly a circle.
    Orbit(OrbitGoal),
    /// Fly with a velocity.
    Velocity {
        /// In the world, m/s.
        velocity: Vector3<f32>,
        /// ψ̇, rad/s.
        yaw_rate: f32,
    },
    /// Fly the configured trajectory.
    Follow,
    /// Return home, and land.
    Return,
    /// Land.
    Land,
    /// Go to a place and a heading, and land there.
    LandAt(Goal),
}

impl Intent {
    /// What a request to fly wants; `None` for any other.
    pub(super) fn of(request: &Request) -> Option<Self> {
        Some(match *request {
            Request::Arm { .. }
            | Request::Disarm
            | Request::TestMotor { .. }
            | Request::SetHome { .. }
            | Request::Speed { .. } => {
                return None;
            }
            Request::Hold => Self::Hold,
            Request::Manual(mode) => Self::Manual(mode),
            Request::Offboard => Self::Offboard,
            Request::Orbit(goal) => Self::Orbit(goal),
            Request::TakeOff { height_m } => Self::TakeOff { height_m },
            Request::GoTo(goal) => Self::GoTo(goal),
            Request::Velocity { velocity_m_s, yaw_rate_rad_s } => {
                Self::Velocity { velocity: velocity_m_s.into(), yaw_rate: yaw_rate_rad_s }
            }
            Request::Follow => Self::Follow,
            Request::Return => Self::Return,
            Request::Land => Self::Land,
            Request::LandAt(goal) => Self::LandAt(goal),
        })
    }

    /// Its mode.
    pub fn mode(&self) -> Mode {
        match self {
            Self::Hold => Mode::Hold,
            Self::Manual(mode) => (*mode).into(),
            Self::Offboard => Mode::Offboard,
            Self::Orbit(_) => Mode::Orbit,
            Self::TakeOff { .. } => Mode::TakeOff,
            Self::GoTo(_) => Mode::GoTo,
            Self::Velocity { .. } => Mode::Velocity,
            Self::Follow => Mode::Follow,
            Self::Return => Mode::Return,
            Self::Land | Self::LandAt(_) => Mode::Land,
        }
    }

    /// Whether it makes a vehicle on the ground fly.
    pub(super) fn leaves_ground(&self) -> bool {
        matches!(self, Self::TakeOff { .. } | Self::Follow)
    }
}

/// The failure that overrides the intent. It ends when the pilot asks for something that the vehicle can do, when the
/// vehicle has landed, and when it is armed again; never by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Override {
    /// Part of the motion is unknown.
    Loss {
        /// What is known.
        known: Known,
    },
    /// A rotor has failed.
    RotorFailed,
    /// The outer partition hangs: the inner one descends blindly.
    OuterHung,
    /// The battery is low.
    BatteryLow,
    /// The battery is critical.
    BatteryCritical,
    /// No ground station is heard any more.
    StationLost {
        /// What is done without it.
        action: StationAction,
    },
    /// No sticks in a manual mode.
    SticksLost {
        /// What is done without them.
        action: StationAction,
    },
    /// No set-points in offboard mode.
    SetPointsLost {
        /// What is done without them.
        action: StationAction,
    },
    /// No sensor samples: the rotors are stopped.
    SensorsGone,
}

impl Override {
    /// The intent that it replaces the pilot's with; `None` if it leads to something that cannot be asked for.
    pub(super) fn pursues(self) -> Option<Intent> {
        match self {
            Self::BatteryLow => Some(Intent::Return),
            Self::BatteryCritical => Some(Intent::Land),
            Self::StationLost { action } | Self::SticksLost { action } | Self::SetPointsLost { action } => {
                Some(action.pursues())
            }
            Self::Loss { .. } | Self::RotorFailed | Self::OuterHung | Self::SensorsGone => None,
        }
    }
}
