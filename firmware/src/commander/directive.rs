//! What the commander tells guidance and the rotors to do, and by what name pilots know it.

use nalgebra::Vector3;

use crate::signals::Tick;

/// How much of the motion is known, the most first: what is not known is not controlled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Known {
    /// Everything.
    Position,
    /// Where it is, is not; horizontal velocity, height and attitude are.
    Velocity,
    /// Height and attitude only: level, at a rate of descent.
    Height,
    /// The vertical velocity and the attitude: level, at a rate of descent, without a height.
    Climb,
    /// The attitude at best: level, with a thrust that is known to let the vehicle sink.
    Attitude,
}

/// What guidance is to do now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Directive {
    /// Rotors stopped.
    Stop,
    /// Rotors at a low idle, on the ground.
    Idle,
    /// The configured trajectory, joined from where the reference stands.
    Follow {
        /// Start of the flight's clock.
        since: Tick,
    },
    /// To a place, and stay.
    GoTo {
        /// In the world, m.
        position: Vector3<f32>,
        /// ψ, rad; `None` for as it is.
        yaw: Option<f32>,
    },
    /// With a velocity; one of zero is to brake and to stay where that ends.
    Velocity {
        /// In the world, m/s.
        velocity: Vector3<f32>,
        /// ψ̇, rad/s.
        yaw_rate: f32,
    },
    /// To a height, over the place where braking ends.
    Climb {
        /// z in the world, m.
        height_m: f32,
        /// At most, m/s.
        speed_m_s: f32,
    },
    /// Down, into the ground if there is any: over one place, or as near to it as what is known allows.
    Descend {
        /// Rate, m/s, downwards.
        rate_m_s: f32,
        /// What is controlled.
        known: Known,
        /// Whether the heading is given up: with a rotor lost, it cannot be held.
        heading_free: bool,
    },
}

impl Directive {
    /// Brake, and stay.
    pub const HOLD: Self = Self::Velocity { velocity: Vector3::new(0.0, 0.0, 0.0), yaw_rate: 0.0 };

    /// True if every number of it is finite.
    pub fn is_finite(&self) -> bool {
        match self {
            Self::Stop | Self::Idle | Self::Follow { .. } => true,
            Self::GoTo { position, yaw } => {
                crate::math::all_finite(position.as_slice()) && yaw.is_none_or(f32::is_finite)
            }
            Self::Velocity { velocity, yaw_rate } => {
                crate::math::all_finite(velocity.as_slice()) && yaw_rate.is_finite()
            }
            Self::Climb { height_m, speed_m_s } => height_m.is_finite() && speed_m_s.is_finite(),
            Self::Descend { rate_m_s, .. } => rate_m_s.is_finite(),
        }
    }
}

/// What the vehicle is doing, for pilots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Rotors stopped.
    Disarmed,
    /// Armed on the ground.
    Idle,
    /// Climbing to where it holds.
    TakeOff,
    /// Holding a place.
    Hold,
    /// On the way to a place, or there.
    GoTo,
    /// At a velocity.
    Velocity,
    /// On the configured trajectory, or on the way to it.
    Follow,
    /// On the way home.
    Return,
    /// Landing.
    Land,
    /// Coming down because something has failed.
    Descent,
    /// Coming down with a rotor lost.
    MotorOut,
}
