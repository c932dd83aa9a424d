//! Directives of the commander to guidance, and the modes that pilots see.

use nalgebra::Vector3;

use super::Orbit;

use crate::guidance::hands::ManualMode;
use crate::guidance::setpoint::Speeds;
use crate::signals::{NavHealth, Tick};

/// How much of the motion is known, from most to least. Only what is known is controlled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Known {
    /// Position, velocity, height and attitude.
    Position,
    /// Position unknown; horizontal velocity, height and attitude known.
    Velocity,
    /// Height and attitude only: descends level at a rate.
    Height,
    /// Vertical velocity and attitude only: descends level at a rate, without a height.
    Climb,
    /// Attitude at most: holds level with a thrust below the weight.
    Attitude,
}

/// How near the ground is to a vehicle that flies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ground {
    /// It is not touched.
    Far,
    /// It may be touched at any time by a vehicle that sinks, or that gives little thrust.
    Near,
    /// Feet may be on it at any thrust.
    Underfoot,
}

impl Known {
    /// What may be controlled with a health.
    pub fn of(health: &NavHealth) -> Self {
        if !health.attitude || !(health.height || health.climb) {
            Self::Attitude
        } else if !health.height {
            Self::Climb
        } else if !health.velocity {
            Self::Height
        } else if !health.position {
            Self::Velocity
        } else {
            Self::Position
        }
    }
}

/// Directive for guidance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Directive {
    /// Rotors stopped.
    Stop,
    /// Rotors at a low idle, on the ground.
    Idle,
    /// Follow the configured trajectory, joined from the present reference.
    Follow {
        /// Start of the flight's clock.
        since: Tick,
    },
    /// Go to a place, and stay.
    GoTo {
        /// In the world, m.
        position: Vector3<f32>,
        /// ψ, rad; `None` to keep the heading.
        yaw: Option<f32>,
        /// Greatest speeds.
        speeds: Speeds,
    },
    /// Fly by the sticks.
    Manual {
        /// How.
        mode: ManualMode,
        /// Whether the vehicle is clear of the ground; while it is not, it is kept level.
        in_air: bool,
        /// Greatest speed downwards where the stick's centre holds the height, m/s.
        sink_m_s: f32,
    },
    /// Follow the latest set-point.
    Offboard {
        /// Whether the vehicle is clear of the ground; while it is not, it is kept level.
        in_air: bool,
    },
    /// Fly a circle.
    Orbit(Orbit),
    /// Fly with a velocity; zero brakes and holds the place where the vehicle stops.
    Velocity {
        /// In the world, m/s.
        velocity: Vector3<f32>,
        /// ψ̇, rad/s.
        yaw_rate: f32,
    },
    /// Go to a height, over the place where the vehicle stops.
    Climb {
        /// z in the world, m.
        height_m: f32,
        /// Greatest speed, m/s.
        speed_m_s: f32,
        /// ψ, rad; `None` to keep the heading.
        yaw: Option<f32>,
    },
    /// Descend to the ground, over one place if the position is known.
    Descend {
        /// Rate of descent, m/s.
        rate_m_s: f32,
        /// What is known, and therefore controlled.
        known: Known,
        /// Whether the heading is given up: with a failed rotor it cannot be held.
        heading_free: bool,
    },
}

impl Directive {
    /// Brake, and stay.
    pub const HOLD: Self = Self::Velocity { velocity: Vector3::new(0.0, 0.0, 0.0), yaw_rate: 0.0 };

    /// True if every value is finite.
    pub fn is_finite(&self) -> bool {
        match self {
            Self::Stop | Self::Idle | Self::Follow { .. } | Self::Offboard { .. } => true,
            Self::Orbit(Orbit { center, radius_m, speed_m_s, .. }) => {
                crate::math::all_finite(center.as_slice()) && crate::math::all_finite(&[*radius_m, *speed_m_s])
            }
            Self::Manual { sink_m_s, .. } => sink_m_s.is_finite(),
            Self::GoTo { position, yaw, .. } => {
                crate::math::all_finite(position.as_slice()) && yaw.is_none_or(f32::is_finite)
            }
            Self::Velocity { velocity, yaw_rate } => {
                crate::math::all_finite(velocity.as_slice()) && yaw_rate.is_finite()
            }
            Self::Climb { height_m, speed_m_s, yaw } => {
                crate::math::all_finite(&[*height_m, *speed_m_s]) && yaw.is_none_or(f32::is_finite)
            }
            Self::Descend { rate_m_s, .. } => rate_m_s.is_finite(),
        }
    }
}

/// A mode, for pilots: what the vehicle does, or is to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Rotors stopped.
    Disarmed,
    /// Armed on the ground.
    Idle,
    /// Climbing from the ground.
    TakeOff,
    /// Holding a place.
    Hold,
    /// On the way to a place, or there.
    GoTo,
    /// Flying with a velocity.
    Velocity,
    /// Following streamed set-points.
    Offboard,
    /// Flying a circle.
    Orbit,
    /// By hand: body rates and thrust.
    Acro,
    /// By hand: tilt and thrust.
    Stabilized,
    /// By hand: tilt and rate of climb.
    Altitude,
    /// By hand: velocity.
    Position,
    /// On the configured trajectory, or on the way to it.
    Follow,
    /// On the way home.
    Return,
    /// Landing.
    Land,
    /// Descending after a failure.
    Descent,
    /// Descending with a failed rotor.
    MotorOut,
}

impl From<ManualMode> for Mode {
    fn from(mode: ManualMode) -> Self {
        match mode {
            ManualMode::Acro => Self::Acro,
            ManualMode::Stabilized => Self::Stabilized,
            ManualMode::Altitude => Self::Altitude,
            ManualMode::Position => Self::Position,
        }
    }
}
