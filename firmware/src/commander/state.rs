//! The commander's states and transitions.
//!
//! ```text
//! Disarmed                     ─ arm ──────────────► Idle
//! Disarmed                     ─ arm to take off ──► TakeOff
//! Disarmed                     ─ arm to follow ────► Follow
//! Idle                         ─ take off ─────────► TakeOff
//! Idle                         ─ follow ───────────► Follow
//! Idle                         ─ disarm, rested ───► Disarmed
//!
//! TakeOff                      ─ arrived ──────────► Hold
//! Velocity                     ─ timeout ──────────► Hold
//! Join                         ─ arrived ──────────► Follow
//! Return, Approach             ─ arrived ──────────► Land
//! Land, Descent, MotorOut      ─ touchdown ────────► Idle
//!
//! Offboard                     ─ touchdown ────────► Idle
//! Idle                         ─ set-point up ─────► Offboard
//! Manual, Cruise, TakeOff, Land, Descent ─ offboard ► Offboard
//! Manual, Cruise, TakeOff, Land, Descent ─ orbit ──► Orbit
//! Offboard                     ─ set-points lost ──► Hold by SetPointsLost
//! Manual                       ─ touchdown, stick down ► Idle
//! Idle                         ─ stick up ─────────► Manual
//! Cruise, TakeOff, Land        ─ stick moved ──────► Manual
//! Cruise, TakeOff, Land, Descent ─ by hand ────────► Manual
//! Manual                       ─ sticks lost ──────► Return by SticksLost
//! Manual, Cruise, TakeOff, Land, Descent ─ hold ───────────► Hold
//! Manual, Cruise, TakeOff, Land, Descent ─ go to ──────────► GoTo
//! Manual, Cruise, TakeOff, Land, Descent ─ velocity ───────► Velocity
//! Manual, Cruise, TakeOff, Land, Descent ─ return ─────────► Return
//! Manual, Cruise, TakeOff                ─ land ───────────► Land
//! Manual, Cruise, TakeOff, Land, Descent ─ land there ─────► Approach
//! Hold, Manual, GoTo, Velocity, Offboard, Orbit, Return, Approach, TakeOff, Land, Descent ─ follow ► Join
//!
//! Manual, Cruise, TakeOff              ─ battery critical ─► Land by BatteryCritical
//! Hold, Manual, GoTo, Velocity, Offboard, Orbit, Join, Follow, Approach, TakeOff ─ battery low ► Return by BatteryLow
//! GoTo, Velocity, Offboard, Orbit, Join, Follow, Approach, TakeOff ─ station lost: hold ► Hold by StationLost
//! Hold, GoTo, Velocity, Offboard, Orbit, Join, Follow, Approach, TakeOff ─ station lost: return ► Return by StationLost
//! Hold, GoTo, Velocity, Offboard, Orbit, Join, Follow, Approach, TakeOff ─ station lost: land ► Land by StationLost
//! Cruise, TakeOff, Land        ─ loss ─────────────► Descent by Loss
//! Manual, Cruise, TakeOff, Land        ─ hung ─────────────► Descent by OuterHung
//! Manual, Cruise, TakeOff, Land, Descent ─ rotor failed ───► MotorOut by RotorFailed
//! Manual, Cruise, TakeOff, Land, Descent, MotorOut ─ gone ─► Disarmed by SensorsGone
//! Idle, Manual, Cruise, TakeOff, Land, Descent, MotorOut ─ kill ────────► Disarmed
//!
//! Cruise = Hold, GoTo, Velocity, Offboard, Orbit, Join, Follow, Return, Approach
//! ```
//!
//! A test checks this diagram against the code.
//!
//! *By* names the [`Override`](super::Override): the failure acts in place of the pilot, whose [`Intent`](super::Intent)
//! is kept. It acts until the pilot asks for something else or the vehicle has landed, also if the failure itself has
//! passed. All other transitions end an override.
//!
//! While disarmed, the pilot may intend to hold, to land, to take off or to follow the trajectory. *Arm to take off*
//! and *arm to follow* are an arming while such an intent is held: for five seconds, because a later arming must not
//! launch the vehicle.
//!
//! *Loss* is a persistent loss of position, velocity, height, attitude or samples. *Gone* means that samples have been
//! missing for so long that control does more harm than good. *Hung* means that the outer partition's job does not end.
//! In a flying state, a disarm is accepted before lift-off only, and leads to Disarmed.

use nalgebra::Vector3;

use super::{ManualMode, Mode, Orbit};
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
        /// z of the ground, m.
        from_m: f32,
        /// To this z, m.
        to_m: f32,
    },
    /// Holding the place where the vehicle has stopped.
    Hold,
    /// Going to a place, a height and a heading.
    GoTo(Course),
    /// Flying by hand.
    Manual(ManualMode),
    /// Following streamed set-points.
    Offboard,
    /// Flying a circle.
    Orbit(Orbit),
    /// Flying with a velocity.
    Velocity {
        /// m/s.
        velocity: Vector3<f32>,
        /// ψ̇, rad/s.
        yaw_rate: f32,
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
    /// Going to where it is to land.
    Approach(Course),
    /// Landing.
    Land,
    /// Descending because part of the motion is unknown, or guidance hangs.
    Descent,
    /// Descending with a failed rotor.
    MotorOut,
}

/// Where a vehicle is going.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Course {
    /// x and y, m; `None` for where it stops.
    pub place_m: Option<[f32; 2]>,
    /// z, m.
    pub height_m: f32,
    /// ψ, rad; `None` for as it heads.
    pub yaw: Option<f32>,
    /// Horizontal speed, m/s; `None` for the one that has been chosen for all, or is usual.
    pub speed_m_s: Option<f32>,
}

impl State {
    /// Its mode.
    pub(super) fn mode(&self) -> Mode {
        match self {
            Self::Disarmed => Mode::Disarmed,
            Self::Idle { .. } => Mode::Idle,
            Self::TakeOff { .. } => Mode::TakeOff,
            Self::Hold => Mode::Hold,
            Self::Manual(mode) => (*mode).into(),
            Self::Offboard => Mode::Offboard,
            Self::Orbit(_) => Mode::Orbit,
            Self::GoTo(_) => Mode::GoTo,
            Self::Velocity { .. } => Mode::Velocity,
            Self::Join | Self::Follow { .. } => Mode::Follow,
            Self::Return { .. } => Mode::Return,
            Self::Approach(_) | Self::Land => Mode::Land,
            Self::Descent => Mode::Descent,
            Self::MotorOut => Mode::MotorOut,
        }
    }
}
