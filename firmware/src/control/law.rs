//! What the partitions ask of a control law: one trait for the attitude, one for the position.
//!
//! The sliding mode laws of this crate implement both, and are what flies unless something else is asked for. The
//! desktop flies other controllers behind the same traits, to compare them on the same flights. A law is plain
//! data in, plain data out: it keeps its own state, and knows neither clock nor schedule.

use nalgebra::{UnitQuaternion, Vector3};

use crate::airframe::ROTORS;
use crate::control::flatness::ForceProfile;
use crate::signals::{AttitudeTarget, FlatReference};

/// What rotors do to the body by their speeds, and by changing them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorEffect {
    /// Torque on the body, N m: U2..U4, with the reaction to spinning up.
    pub torque: Vector3<f32>,
    /// U4 alone, N m.
    pub yaw_n_m: f32,
    /// Ωr, rad/s.
    pub spin_rad_s: f32,
}

/// What an attitude law is given in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttitudeInput<'a> {
    /// Body to world.
    pub attitude: &'a UnitQuaternion<f32>,
    /// Ω = (p, q, r), rad/s.
    pub rates: &'a Vector3<f32>,
    /// What to follow.
    pub target: &'a AttitudeTarget,
    /// Speeds at which the rotors are believed to turn, rad/s: the last commands, through the lag of the model.
    pub rotor_speeds: &'a [f32; ROTORS],
    /// What they do at these speeds.
    pub rotors: &'a RotorEffect,
    /// True if the mixer could not give the last demand: what integrates ought to hold.
    pub saturated: bool,
}

/// Sliding variables (zero for a law that has none) and the torque wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AttitudeDemand {
    /// s1, s2, s3, rad/s.
    pub s: Vector3<f32>,
    /// τ about the body's axes, N m.
    pub torque: Vector3<f32>,
}

/// An attitude law. The inner partition calls [`step`](Self::step) once a tick while the rotors may turn, and
/// [`reset`](Self::reset) once a tick while they may not.
pub trait AttitudeLaw {
    /// Torque for this tick.
    fn step(&mut self, input: &AttitudeInput) -> AttitudeDemand;

    /// Forgets what it has integrated, filtered or observed.
    fn reset(&mut self);
}

/// What a position law is given in a job of the outer partition. All holds for the tick at which the job's output
/// takes effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionInput<'a> {
    /// What to follow.
    pub reference: &'a FlatReference,
    /// Position, m.
    pub position: &'a Vector3<f32>,
    /// Velocity, m/s.
    pub velocity: &'a Vector3<f32>,
    /// The vehicle's acceleration by the model, for what the rotors are believed to do, m/s².
    pub acceleration: &'a Vector3<f32>,
    /// True if the last force had to be limited: what integrates ought to hold.
    pub limited: bool,
}

/// Sliding variables (zero for a law that has none) and the specific force wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionDemand {
    /// sx, sy, sz, m/s.
    pub s: Vector3<f32>,
    /// Thrust a unit of mass, with two derivatives for the attitude's feedforward; these are zero in a law that
    /// has none.
    pub profile: ForceProfile,
}

/// A position law. The outer partition calls [`step`](Self::step) once a job while the rotors may turn, and
/// [`reset`](Self::reset) once a job while they may not.
pub trait PositionLaw {
    /// Force for this job.
    fn step(&mut self, input: &PositionInput) -> PositionDemand;

    /// Part of the model's thrust that the rotors are found to give; 1 for a law that does not look for it.
    fn thrust_effectiveness(&self) -> f32 {
        1.0
    }

    /// Forgets what it has integrated, filtered or observed.
    fn reset(&mut self);
}
