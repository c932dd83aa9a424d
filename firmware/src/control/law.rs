//! The interface of a control law: one trait for the attitude, one for the position.
//!
//! The sliding mode laws of this crate implement both and fly by default. The desktop flies other controllers behind
//! the same traits, to compare them on the same flights. A law takes plain data and returns plain data: it owns its
//! state, and knows neither the clock nor the schedule.

use nalgebra::{UnitQuaternion, Vector3};

use crate::airframe::ROTORS;
use crate::control::flatness::ForceProfile;
use crate::settings::Change;
use crate::signals::{AttitudeTarget, FlatReference};

/// Torque and spin that the rotors cause, by their speeds and by changing them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorEffect {
    /// Torque on the body, N m: U2..U4, with the reaction to spinning up.
    pub torque: Vector3<f32>,
    /// U4 alone, N m.
    pub yaw_n_m: f32,
    /// Ωr, rad/s.
    pub spin_rad_s: f32,
}

/// Input of an attitude law, once per tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttitudeInput<'a> {
    /// Body to world.
    pub attitude: &'a UnitQuaternion<f32>,
    /// Ω = (p, q, r), rad/s.
    pub rates: &'a Vector3<f32>,
    /// The attitude to follow, with its derivatives.
    pub target: &'a AttitudeTarget,
    /// Estimated rotor speeds, rad/s: the last commands, passed through the model of the rotor lag.
    pub rotor_speeds: &'a [f32; ROTORS],
    /// Torque and spin at these speeds.
    pub rotors: &'a RotorEffect,
    /// True if the mixer saturated on the last demand: integrators should hold (anti-windup).
    pub saturated: bool,
}

/// Sliding variables (zero for a law that has none) and the demanded torque.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AttitudeDemand {
    /// s1, s2, s3, rad/s.
    pub s: Vector3<f32>,
    /// τ about the body's axes, N m.
    pub torque: Vector3<f32>,
}

/// What a law keeps inside, for pilots and plots; no loop uses it. Zero for a law that has none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LawState {
    /// Reaching terms `u_r(s)` of the three axes, in units of s per second.
    pub reaching: Vector3<f32>,
    /// Estimated disturbance d̂, in the same units.
    pub disturbance: Vector3<f32>,
}

/// An attitude law. The inner partition calls [`step`](Self::step) once per tick while the vehicle is armed and
/// controlled, and [`reset`](Self::reset) once per tick while it is disarmed or idling.
pub trait AttitudeLaw {
    /// Torque for this tick.
    fn step(&mut self, input: &AttitudeInput) -> AttitudeDemand;

    /// The state behind the sliding variables of the last step.
    fn state(&self) -> LawState {
        LawState::default()
    }

    /// Clears every integrator, filter and observer state.
    fn reset(&mut self);

    /// Takes over a setting of the law, between two steps and without a jump of its state. A law without settings
    /// ignores it, as every law ignores those of others.
    fn retune(&mut self, _change: &Change) {}
}

/// Input of a position law, once per job of the outer partition. All values are predicted to the tick at which the
/// job's output takes effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionInput<'a> {
    /// The position to follow, with its derivatives.
    pub reference: &'a FlatReference,
    /// Position, m.
    pub position: &'a Vector3<f32>,
    /// Velocity, m/s.
    pub velocity: &'a Vector3<f32>,
    /// The vehicle's acceleration by the model at the estimated rotor speeds, m/s².
    pub acceleration: &'a Vector3<f32>,
    /// True if the last force was limited: integrators should hold (anti-windup).
    pub limited: bool,
}

/// Sliding variables (zero for a law that has none) and the demanded specific force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionDemand {
    /// sx, sy, sz, m/s.
    pub s: Vector3<f32>,
    /// Thrust per unit of mass, with two derivatives for the attitude feedforward; these are zero for a law that has
    /// none.
    pub profile: ForceProfile,
}

/// A position law. The outer partition calls [`step`](Self::step) once per job while the vehicle is armed and
/// controlled, and [`reset`](Self::reset) once per job while it is disarmed or idling.
pub trait PositionLaw {
    /// Force for this job.
    fn step(&mut self, input: &PositionInput) -> PositionDemand;

    /// The state behind the sliding variables of the last step.
    fn state(&self) -> LawState {
        LawState::default()
    }

    /// Estimated ratio of the real thrust to the model's; 1 for a law that does not estimate it.
    fn thrust_effectiveness(&self) -> f32 {
        1.0
    }

    /// Clears every integrator, filter and observer state.
    fn reset(&mut self);

    /// Takes over a setting of the law, between two steps and without a jump of its state. A law without settings
    /// ignores it, as every law ignores those of others.
    fn retune(&mut self, _change: &Change) {}
}
