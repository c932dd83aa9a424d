//! The commander's states and transitions.
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
//! Idle, Cruise, TakeOff, Land, Descent, MotorOut ─ kill ────────► Disarmed
//!
//! Cruise = Hold, GoTo, Velocity, Join, Follow, Return
//! ```
//!
//! A test checks this diagram against the code.
//!
//! *Loss* is a persistent loss of position, velocity, height, attitude or samples. If it recovers, the descent goes on
//! until the pilot ends it. *Gone* means that samples have been missing for so long that control does more harm than
//! good. In a flying state, a disarm is accepted before lift-off only, and leads to Disarmed.

use nalgebra::Vector3;

use super::{Known, Mode};
use crate::signals::Tick;

/// State of the commander (see the diagram above).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum State {
    /// Rotors stopped.
    Disarmed,
    /// Rotors idling on the ground.
    Idle {
        /// When to disarm, after a landing.
        disarm_at: Option<Tick>,
    },
    /// Climbing from the ground.
    TakeOff {
        /// To this z, m.
        to_m: f32,
    },
    /// Holding the place where the vehicle has stopped.
    Hold,
    /// Going to a place.
    GoTo {
        /// m.
        position: Vector3<f32>,
        /// ψ, rad.
        yaw: f32,
    },
    /// Flying with a velocity.
    Velocity {
        /// m/s.
        velocity: Vector3<f32>,
        /// ψ̇, rad/s.
        yaw_rate: f32,
        /// When the request expires.
        until: Tick,
    },
    /// Going to the point where the trajectory is joined.
    Join,
    /// Following the trajectory.
    Follow {
        /// Start of the flight's clock.
        since: Tick,
    },
    /// Returning home: climbs first, then goes there.
    Return {
        /// z of the return flight, m.
        at_m: f32,
        /// Whether it is still climbing.
        climbs: bool,
    },
    /// Landing.
    Land,
    /// Descending because part of the motion is unknown.
    Descent {
        /// What is known.
        known: Known,
    },
    /// Descending with a failed rotor.
    MotorOut,
}

impl State {
    /// The mode that pilots see.
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
