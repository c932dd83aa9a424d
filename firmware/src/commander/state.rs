//! The commander's states, and what leads from one to another.
//!
//! ```text
//! Disarmed                     ─ arm ──────────────► Idle
//! Idle                         ─ take off ─────────► TakeOff
//! Idle                         ─ follow ───────────► Follow
//! Idle                         ─ disarm, rested ───► Disarmed
//!
//! TakeOff                      ─ arrived ──────────► Hold
//! Velocity                     ─ timeout ──────────► Hold
//! Join                         ─ arrived ──────────► Follow
//! Return                       ─ arrived ──────────► Land
//! Land, Descent, MotorOut      ─ touchdown ────────► Idle
//!
//! Cruise, TakeOff, Land, Descent ─ hold ───────────► Hold
//! Cruise, TakeOff, Land, Descent ─ go to ──────────► GoTo
//! Cruise, TakeOff, Land, Descent ─ velocity ───────► Velocity
//! Cruise, TakeOff, Land, Descent ─ return ─────────► Return
//! Cruise, TakeOff                ─ land ───────────► Land
//! Hold, GoTo, Velocity, Return, TakeOff, Land, Descent ─ follow ► Join
//!
//! Cruise, TakeOff              ─ battery critical ─► Land
//! Hold, GoTo, Velocity, Join, Follow, TakeOff ─ battery low ► Return
//! Cruise, TakeOff, Land        ─ loss ─────────────► Descent
//! Cruise, TakeOff, Land, Descent ─ rotor failed ───► MotorOut
//! Cruise, TakeOff, Land, Descent, MotorOut ─ gone ─► Disarmed
//! Idle, Cruise, TakeOff, Land, Descent, MotorOut ─ forced disarm ► Disarmed
//!
//! Cruise = Hold, GoTo, Velocity, Join, Follow, Return
//! ```
//!
//! A test holds this diagram against the code. *Loss* is that of position, velocity, height, attitude or samples, once
//! it has lasted; what comes back does not end the descent, a pilot does. *Gone* are samples that have not come for so
//! long that control does more harm than none. From a state that flies, a disarm that is not forced is accepted before
//! lift-off only, and leads to Disarmed.

use nalgebra::Vector3;

use super::{Known, Mode};
use crate::signals::Tick;

/// What is being done (see the diagram above).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum State {
    /// Rotors stopped.
    Disarmed,
    /// Rotors idle, on the ground.
    Idle {
        /// When they stop, after a landing.
        disarm_at: Option<Tick>,
    },
    /// Climbing from the ground.
    TakeOff {
        /// To this z, m.
        to_m: f32,
    },
    /// At the place where it has stopped.
    Hold,
    /// To a place.
    GoTo {
        /// m.
        position: Vector3<f32>,
        /// ψ, rad.
        yaw: f32,
    },
    /// With a velocity.
    Velocity {
        /// m/s.
        velocity: Vector3<f32>,
        /// ψ̇, rad/s.
        yaw_rate: f32,
        /// When it has not been asked again.
        until: Tick,
    },
    /// To where the trajectory is joined.
    Join,
    /// On the trajectory.
    Follow {
        /// Start of the flight's clock.
        since: Tick,
    },
    /// Home, at this z (m): up to it first.
    Return {
        /// m.
        at_m: f32,
        /// Whether it is still climbing.
        climbs: bool,
    },
    /// Down, where it is.
    Land,
    /// Down, because something of the motion is lost.
    Descent {
        /// What is known.
        known: Known,
    },
    /// Down, with a rotor lost.
    MotorOut,
}

impl State {
    /// By the name that pilots know.
    pub(super) fn mode(&self) -> Mode {
        match self {
            Self::Disarmed => Mode::Disarmed,
            Self::Idle { .. } => Mode::Idle,
            Self::TakeOff { .. } => Mode::TakeOff,
            Self::Hold => Mode::Hold,
            Self::GoTo { .. } => Mode::GoTo,
            Self::Velocity { .. } => Mode::Velocity,
            Self::Join | Self::Follow { .. } => Mode::Follow,
            Self::Return { .. } => Mode::Return,
            Self::Land => Mode::Land,
            Self::Descent { .. } => Mode::Descent,
            Self::MotorOut => Mode::MotorOut,
        }
    }
}
