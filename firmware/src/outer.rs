//! The outer partition, 250 Hz: guidance and position control.
//!
//! Flies what the commander's [`Directive`] says: the configured trajectory, or a reference that is made while it flies.
//! What is not known of the motion is not controlled: it is taken out of motion and reference alike.
//!
//! Works on a snapshot of the motion and gives an attitude reference for the tick at which it is published; the
//! motion is carried forward to that tick by the model, so that errors are taken between like times.

use nalgebra::{Vector3, Vector4};

use crate::commander::{Directive, Known};
use crate::config::FlightConfig;
use crate::control::flatness::{self, ForceProfile, Heading};
use crate::control::law::{PositionDemand, PositionInput, PositionLaw};
use crate::control::position::{ForceLimits, SlidingPosition, Translation};
use crate::guidance::Guidance;
use crate::guidance::setpoint::{Setpoint, Target};
use crate::math;
use crate::schedule::{OUTER, OUTER_AHEAD_S};
use crate::signals::{AttitudeReference, FlatReference, NavState, Tick};
use crate::validate::ConfigError;

/// Snapshot for the outer partition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OuterInput {
    /// The motion at the release.
    pub nav: NavState,
    /// Thrust that the rotors are believed to give, N.
    pub thrust_n: f32,
    /// What to do.
    pub directive: Directive,
}

/// How much of the rotors is to be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Authority {
    /// They idle, on the ground.
    Idle,
    /// Torque in proportion to thrust: in a descent the ground may come at any time.
    Gentle,
    /// All of it.
    Full,
}

/// What the outer partition asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OuterOutput {
    /// For the inner partition.
    pub attitude: AttitudeReference,
    /// Sliding variables sx, sy, sz, m/s.
    pub s: Vector3<f32>,
    /// True if the force that control asks for had to be limited.
    pub limited: bool,
    /// How much of the rotors is to be used, while they may turn.
    pub authority: Authority,
    /// True if the heading is given up.
    pub heading_free: bool,
    /// Where the vehicle ought to be, m, and its heading, rad.
    pub wanted: Vector4<f32>,
}

/// Where the last job's reference has come from.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Source {
    /// There was none: on the ground.
    Ground,
    /// The trajectory, and this is it.
    Trajectory(FlatReference),
    /// The generator.
    Setpoint,
}

/// The outer partition, with a position law.
#[derive(Clone, Debug)]
pub struct Outer<P = SlidingPosition> {
    mass_kg: f32,
    model: Translation,
    limits: ForceLimits,
    guidance: Guidance,
    setpoint: Setpoint,
    source: Source,
    law: P,
    limited: bool,
    /// Specific force of a descent without a known height, m/s², and what the model's thrust has to be for it, as a part,
    /// since that descent has begun.
    blind_force: f32,
    blind_share: Option<f32>,
}

/// A descending reference is no lower than this below the vehicle, m: on the ground it must not run away.
const LEAD_DOWN_M: f32 = 0.5;
/// Nor higher than this above it, m: one that has fallen is to come down from where it is.
const LAG_UP_M: f32 = 0.5;

/// Position, velocity, acceleration and thrust axis when the output takes effect.
struct Predicted {
    position: Vector3<f32>,
    velocity: Vector3<f32>,
    acceleration: Vector3<f32>,
    thrust_axis: Vector3<f32>,
}

impl Predicted {
    /// As if it were known to stand still over the origin.
    fn forget_horizontal(&mut self) {
        for vector in [&mut self.position, &mut self.velocity, &mut self.acceleration] {
            (vector.x, vector.y) = (0.0, 0.0);
        }
    }
}

/// The same of a reference.
fn forget_horizontal(reference: &mut FlatReference) {
    let FlatReference { position, velocity, acceleration, jerk, snap, .. } = reference;
    for vector in [position, velocity, acceleration, jerk, snap] {
        (vector.x, vector.y) = (0.0, 0.0);
    }
}

fn velocity(velocity: Vector3<f32>, yaw_rate: f32) -> Target {
    Target::Velocity { velocity, yaw_rate }
}

impl<P: PositionLaw> Outer<P> {
    /// Ready to run with a valid configuration.
    ///
    /// # Errors
    /// What of the trajectory or the joining path is out of its range.
    pub fn new(config: &FlightConfig, law: P) -> Result<Self, ConfigError> {
        Ok(Self {
            mass_kg: config.airframe.mass_kg,
            model: Translation::new(&config.airframe),
            limits: ForceLimits::new(&config.airframe, config.tilt_max_rad),
            guidance: Guidance::new(config.trajectory.clone(), config.join.as_ref(), config.start_position())?,
            setpoint: Setpoint::new(&config.modes),
            source: Source::Ground,
            law,
            limited: false,
            blind_force: config.modes.blind_thrust_part * config.airframe.gravity_m_s2,
            blind_share: None,
        })
    }

    /// Forgets what has been made of earlier jobs.
    pub fn reset(&mut self) {
        self.source = Source::Ground;
        self.blind_share = None;
        self.reset_law();
    }

    fn reset_law(&mut self) {
        self.law.reset();
        self.limited = false;
    }

    /// One job, released at `released`.
    pub fn step(&mut self, released: Tick, input: &OuterInput) -> OuterOutput {
        let effective = released.wrapping_add(OUTER.offset);
        match input.directive {
            Directive::Stop | Directive::Idle => self.rest(&input.nav),
            Directive::Follow { since } => {
                let reference = self.trajectory(effective.wrapping_sub(since));
                self.follow(effective, input, &reference)
            }
            Directive::Descend { rate_m_s, known, heading_free } => {
                let target = velocity(Vector3::new(0.0, 0.0, -rate_m_s), 0.0);
                let reference = self.steer(input, &target);
                let output = self.descend(effective, input, reference, known, heading_free);
                // Without a rotor there is no torque to spare.
                let authority = if heading_free { Authority::Full } else { Authority::Gentle };
                OuterOutput { authority, heading_free, ..output }
            }
            Directive::GoTo { position, yaw } => {
                let reference = self.steer(input, &Target::Place { position, yaw });
                self.follow(effective, input, &reference)
            }
            Directive::Velocity { velocity: wanted, yaw_rate } => {
                let reference = self.steer(input, &velocity(wanted, yaw_rate));
                self.follow(effective, input, &reference)
            }
            Directive::Climb { height_m, speed_m_s } => {
                let reference = self.steer(input, &Target::Height { height_m, speed_m_s });
                self.follow(effective, input, &reference)
            }
        }
    }

    /// On the ground there is nothing to control.
    fn rest(&mut self, nav: &NavState) -> OuterOutput {
        self.reset();
        let attitude = AttitudeReference::idle(nav.attitude);
        let wanted = nav.position.push(nav.yaw());
        OuterOutput {
            attitude,
            s: Vector3::zeros(),
            limited: false,
            authority: Authority::Idle,
            heading_free: false,
            wanted,
        }
    }

    /// The trajectory at a time on the flight's clock, joined from the air if the vehicle was there.
    fn trajectory(&mut self, ticks: Tick) -> FlatReference {
        match self.source {
            Source::Ground => self.guidance.join_from_start(),
            Source::Setpoint => self.guidance.join_from(&self.setpoint.reference().position),
            Source::Trajectory(_) => {}
        }
        let reference = self.guidance.at(ticks);
        self.source = Source::Trajectory(reference);
        reference
    }

    /// The generator's reference, from where the last one was, or from where the vehicle stands.
    fn steer(&mut self, input: &OuterInput, target: &Target) -> FlatReference {
        match self.source {
            Source::Setpoint => {}
            Source::Trajectory(reference) => self.setpoint.start(&reference),
            Source::Ground => {
                self.setpoint.start(&FlatReference::standing(input.nav.position, input.nav.yaw()));
            }
        }
        self.source = Source::Setpoint;
        self.setpoint.advance(target)
    }

    /// Down, by what is known of the motion.
    fn descend(
        &mut self,
        effective: Tick,
        input: &OuterInput,
        mut reference: FlatReference,
        known: Known,
        heading_free: bool,
    ) -> OuterOutput {
        let mut now = self.predict(input);
        if known > Known::Position {
            // The generator goes on from here, once the position is known again.
            self.setpoint.put_horizontally(now.position.x, now.position.y);
            (reference.position.x, reference.position.y) = (now.position.x, now.position.y);
        }
        let (lowest, highest) = (now.position.z - LEAD_DOWN_M, now.position.z + LAG_UP_M);
        let leashed = math::clamp(reference.position.z, lowest, highest);
        if leashed != reference.position.z {
            self.setpoint.put_vertically(leashed);
            reference.position.z = leashed;
        }
        if heading_free {
            (reference.yaw, reference.yaw_rate, reference.yaw_acceleration) = (input.nav.yaw(), 0.0, 0.0);
        }
        match known {
            Known::Position | Known::Velocity if heading_free => self.damp(effective, &now, &reference),
            Known::Position | Known::Velocity => self.track(effective, &now, &reference),
            Known::Height => {
                now.forget_horizontal();
                forget_horizontal(&mut reference);
                self.track(effective, &now, &reference)
            }
            Known::Climb => {
                now.forget_horizontal();
                forget_horizontal(&mut reference);
                self.setpoint.put_vertically(now.position.z);
                reference.position.z = now.position.z;
                self.track(effective, &now, &reference)
            }
            Known::Attitude => {
                self.setpoint.put_vertically(now.position.z);
                self.sink(effective, &now, &reference)
            }
        }
    }

    /// Down at the reference's rate, horizontal motion only damped, and gently: an attitude that answers slowly, as with a
    /// rotor lost, bears no tight loop around it.
    fn damp(&mut self, effective: Tick, now: &Predicted, reference: &FlatReference) -> OuterOutput {
        /// 1/s, and m/s².
        const DAMPING: f32 = 0.7;
        const MOST: f32 = 1.5;
        let mut level = *reference;
        forget_horizontal(&mut level);
        let mut vertical = Predicted { ..*now };
        vertical.forget_horizontal();
        let mut demand = self.law.step(&PositionInput {
            reference: &level,
            position: &vertical.position,
            velocity: &vertical.velocity,
            acceleration: &vertical.acceleration,
            limited: self.limited,
        });
        let damped = |v: f32| math::clamp(-DAMPING * v, -MOST, MOST);
        let force = Vector3::new(damped(now.velocity.x), damped(now.velocity.y), demand.profile.force.z);
        let zero = Vector3::zeros();
        demand.profile = ForceProfile { force, rate: zero, acceleration: zero };
        if !demand.profile.is_finite() {
            self.law.reset();
            demand.profile = ForceProfile::hover(self.model.gravity);
        }
        self.limited = self.limits.apply(&mut demand.profile);
        self.output(effective, now, &demand.profile, reference, demand.s)
    }

    /// Level, with a thrust by which the vehicle sinks.
    fn sink(&mut self, effective: Tick, now: &Predicted, reference: &FlatReference) -> OuterOutput {
        // What the law knows of the thrust holds without a height too; it is forgotten with the rest.
        let share = *self.blind_share.get_or_insert(1.0 / self.law.thrust_effectiveness());
        self.reset_law();
        let profile = ForceProfile::hover(self.blind_force * share);
        self.output(effective, now, &profile, reference, Vector3::zeros())
    }

    /// Position control towards a reference that holds, as the output will, at the tick `effective`.
    #[inline]
    pub fn follow(&mut self, effective: Tick, input: &OuterInput, reference: &FlatReference) -> OuterOutput {
        let now = self.predict(input);
        self.track(effective, &now, reference)
    }

    #[inline]
    fn track(&mut self, effective: Tick, now: &Predicted, reference: &FlatReference) -> OuterOutput {
        let PositionDemand { mut s, mut profile } = self.law.step(&PositionInput {
            reference,
            position: &now.position,
            velocity: &now.velocity,
            acceleration: &now.acceleration,
            limited: self.limited,
        });
        if !profile.is_finite() {
            // A motion so wild that a product overflowed: what the law has made of it is not to stay.
            self.law.reset();
            (s, profile) = (Vector3::zeros(), ForceProfile::hover(self.model.gravity));
        }
        self.limited = self.limits.apply(&mut profile);
        self.output(effective, now, &profile, reference, s)
    }

    /// The attitude and thrust by which a force is had.
    #[inline]
    fn output(
        &self,
        effective: Tick,
        now: &Predicted,
        profile: &ForceProfile,
        reference: &FlatReference,
        s: Vector3<f32>,
    ) -> OuterOutput {
        let heading =
            Heading { angle: reference.yaw, rate: reference.yaw_rate, acceleration: reference.yaw_acceleration };
        let mass = self.mass_kg;
        OuterOutput {
            attitude: AttitudeReference {
                valid_at: effective,
                target: flatness::attitude_target(profile, &heading),
                thrust_n: math::max(mass * profile.force.dot(&now.thrust_axis), 0.0),
                thrust_rate_n_s: mass * profile.rate.dot(&now.thrust_axis),
            },
            s,
            limited: self.limited,
            authority: Authority::Full,
            heading_free: false,
            wanted: reference.position.push(reference.yaw),
        }
    }

    /// The motion [`OUTER_AHEAD_S`] after the snapshot, by Eq. 2 with the thrust that the rotors are believed to give.
    #[inline]
    fn predict(&self, input: &OuterInput) -> Predicted {
        let nav = &input.nav;
        let axis = nav.attitude * Vector3::z();
        let axis_rate = nav.attitude * Vector3::new(nav.rates.y, -nav.rates.x, 0.0);
        let acceleration = self.model.acceleration(&(axis * (input.thrust_n / self.mass_kg)), &nav.velocity);
        Predicted {
            position: nav.position
                + nav.velocity * OUTER_AHEAD_S
                + acceleration * (0.5 * OUTER_AHEAD_S * OUTER_AHEAD_S),
            velocity: nav.velocity + acceleration * OUTER_AHEAD_S,
            acceleration,
            thrust_axis: axis + axis_rate * OUTER_AHEAD_S,
        }
    }
}
