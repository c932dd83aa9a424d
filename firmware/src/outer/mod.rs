//! The outer partition, 250 Hz: guidance and position control.
//!
//! Executes the commander's [`Directive`]: follows the configured trajectory, or a setpoint generated online.
//! Components of the motion that are unknown are not controlled: they are set to zero in motion and reference alike.
//!
//! A job works on a snapshot of the motion and returns an attitude reference for the tick at which it is published. The
//! model predicts the motion to that tick, so that motion and reference are compared at the same time.

mod by_hand;
mod catch;
mod descent;
mod offboard;
mod orbit;

use nalgebra::{Vector3, Vector4};

use self::by_hand::ByHand;
use self::orbit::Circling;

use crate::commander::{Directive, Ground};
use crate::config::{FlightConfig, ModeSettings};
use crate::control::flatness::{self, ForceProfile, Heading};
use crate::control::law::{LawState, PositionDemand, PositionInput, PositionLaw};
use crate::control::position::{ForceLimits, SlidingPosition, Translation};
use crate::guidance::Guidance;
use crate::guidance::setpoint::{Setpoint, Target};
use crate::guidance::stream::Stream;
use crate::latest::Latest;
use crate::math;
use crate::schedule::{OUTER, OUTER_AHEAD_S};
use crate::settings::{self, Change, Changes, Place};
use crate::signals::{AttitudeReference, FlatReference, NavState, Tick};
use crate::validate::ConfigError;

/// Snapshot for the outer partition.
#[derive(Clone, Debug, PartialEq)]
pub struct OuterInput {
    /// The motion at the release.
    pub nav: NavState,
    /// Estimated thrust of the rotors, N.
    pub thrust_n: f32,
    /// The directive of the commander.
    pub directive: Directive,
    /// How near it takes the ground to be.
    pub ground: Ground,
    /// Sticks, and what else counts by its latest value.
    pub latest: Latest,
    /// Settings to take over before the job.
    pub changes: Changes,
}

/// Control authority that the inner partition may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Authority {
    /// Rotors idle, on the ground.
    Idle,
    /// Torque limited in proportion to thrust: the vehicle descends and may touch down at any time.
    Gentle,
    /// Full authority.
    Full,
}

/// Output of the outer partition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OuterOutput {
    /// For the inner partition.
    pub attitude: AttitudeReference,
    /// Sliding variables sx, sy, sz, m/s.
    pub s: Vector3<f32>,
    /// True if the demanded force was limited.
    pub limited: bool,
    /// Control authority while armed.
    pub authority: Authority,
    /// True if the heading is given up.
    pub heading_free: bool,
    /// Reference position, m, and heading, rad.
    pub wanted: Vector4<f32>,
    /// Velocity of the reference, m/s.
    pub wanted_velocity: Vector3<f32>,
    /// Acceleration of the reference, m/s².
    pub wanted_acceleration: Vector3<f32>,
    /// ψ̇ of the reference, rad/s.
    pub wanted_yaw_rate: f32,
    /// Thrust that the rotors give, as a fraction of the model's, for the inner partition should this be the last output.
    pub thrust_effectiveness: f32,
    /// What the position law keeps inside.
    pub law: LawState,
}

impl OuterOutput {
    /// The same, where nothing is wanted of the horizontal motion: what the vehicle does there is what is wanted.
    fn wanting_what_it_does(mut self, nav: &NavState) -> Self {
        (self.wanted.x, self.wanted.y) = (nav.position.x, nav.position.y);
        (self.wanted_velocity.x, self.wanted_velocity.y) = (nav.velocity.x, nav.velocity.y);
        self
    }
}

/// Source of the last job's reference.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Source {
    /// None: on the ground.
    Ground,
    /// The trajectory, with its last reference.
    Trajectory(FlatReference),
    /// The setpoint generator.
    Setpoint,
    /// Sticks, or set-points of the attitude, with the motion that something else goes on from.
    ByHand(FlatReference),
    /// Set-points of the motion.
    Stream,
}

/// The outer partition, with a position law. The fields stand in memory as here, the largest last (see
/// [`Inner`](crate::inner::Inner)).
#[derive(Clone, Debug)]
#[repr(C)]
pub struct Outer<P = SlidingPosition> {
    mass_kg: f32,
    model: Translation,
    limits: ForceLimits,
    limited: bool,
    /// Specific force of a blind descent, m/s², and the thrust effectiveness held since that descent began.
    blind_force: f32,
    blind_effectiveness: Option<f32>,
    law: P,
    /// What limits and blind descents were built from, to be changed in flight.
    modes: ModeSettings,
    source: Source,
    by_hand: ByHand,
    circling: Circling,
    stream: Stream,
    setpoint: Setpoint,
    /// Whether the generator brakes a fall.
    catches: bool,
    guidance: Guidance,
}

/// A descending reference is at most this far below the vehicle, m: on the ground it must not run away.
const LEAD_DOWN_M: f32 = 0.5;
/// And at most this far above it, m: a vehicle that has fallen must not climb back to its reference.
const LAG_UP_M: f32 = 0.5;

/// Near the ground a thrust below this fraction of the weight may be a landing: the law gives less than the weight only
/// where it sinks faster and faster, or stands. A pilot who has the thrust in hand also flies with little.
const LANDS: f32 = 0.85;
const LANDS_BY_HAND: f32 = 0.5;
/// And so may a reference with this velocity upwards, m/s.
const SINKS_M_S: f32 = -0.05;

/// Position, velocity, acceleration and thrust axis at the tick when the output takes effect.
struct Predicted {
    position: Vector3<f32>,
    velocity: Vector3<f32>,
    acceleration: Vector3<f32>,
    thrust_axis: Vector3<f32>,
}

impl Predicted {
    /// Sets the horizontal components to zero.
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

/// The vehicle's own motion, with a heading: what is gone on from where none is controlled.
fn as_it_moves(now: &Predicted, heading: &Heading) -> FlatReference {
    FlatReference {
        velocity: now.velocity,
        yaw_rate: heading.rate,
        ..FlatReference::standing(now.position, heading.angle)
    }
}

fn velocity(velocity: Vector3<f32>, yaw_rate: f32) -> Target {
    Target::Velocity { velocity, yaw_rate }
}

impl<P: PositionLaw> Outer<P> {
    /// Ready to run with a valid configuration.
    ///
    /// # Errors
    /// The value of the trajectory or of the joining path that is out of range.
    pub fn new(config: &FlightConfig, law: P) -> Result<Self, ConfigError> {
        let limits = ForceLimits::new(&config.airframe, config.tilt_max_rad);
        let fastest = offboard::fastest(&config.modes, limits, config.airframe.gravity_m_s2);
        Ok(Self {
            mass_kg: config.airframe.mass_kg,
            model: Translation::new(&config.airframe),
            limits,
            stream: Stream::new(&config.modes, fastest),
            guidance: Guidance::new(config.trajectory.clone(), config.join.as_ref(), config.start_position())?,
            setpoint: Setpoint::new(&config.modes),
            catches: false,
            source: Source::Ground,
            by_hand: ByHand::new(&config.manual, &config.airframe),
            circling: Circling::default(),
            law,
            limited: false,
            blind_force: config.modes.blind_thrust_part * config.airframe.gravity_m_s2,
            blind_effectiveness: None,
            modes: config.modes,
        })
    }

    /// Takes over a setting: limits, or what is of the law.
    pub fn apply(&mut self, change: &Change) {
        let is_mode = change.apply_to(&mut self.modes, Place::modes);
        change.apply_to(&mut self.by_hand.settings, Place::manual);
        if is_mode {
            self.setpoint.limit(&self.modes);
            self.stream.limit(&self.modes, self.fastest());
            self.blind_force = self.modes.blind_thrust_part * self.model.gravity;
        } else if usize::from(change.index) == settings::TILT_MAX
            && let Some((_, tilt_max_rad)) = change.place()
        {
            self.limits = self.limits.with_tilt(tilt_max_rad.real());
            self.stream.limit(&self.modes, self.fastest());
        } else {
            self.law.retune(change);
        }
    }

    /// Clears the state of earlier jobs.
    pub fn reset(&mut self) {
        self.source = Source::Ground;
        self.by_hand.end();
        self.blind_effectiveness = None;
        self.reset_law();
    }

    fn reset_law(&mut self) {
        self.law.reset();
        self.limited = false;
    }

    /// One job, released at `released`.
    pub fn step(&mut self, released: Tick, input: &OuterInput) -> OuterOutput {
        let effective = released.wrapping_add(OUTER.offset);
        for change in &input.changes {
            self.apply(change);
        }
        if !matches!(input.directive, Directive::Manual { .. } | Directive::Offboard { .. }) {
            self.by_hand.end();
        }
        if !matches!(self.source, Source::Setpoint | Source::ByHand(_)) {
            self.catch(false);
        }
        match input.directive {
            Directive::Manual { mode, in_air, sink_m_s } => {
                let output = self.fly_by_hand(effective, input, (mode, in_air, sink_m_s));
                self.near_ground(output, input.ground, mode.has_direct_thrust(), in_air)
            }
            Directive::Offboard { in_air } => {
                let output = self.follow_setpoint(effective, input, in_air);
                let has_direct_thrust = matches!(self.source, Source::ByHand(_));
                self.near_ground(output, input.ground, has_direct_thrust, in_air)
            }
            Directive::Orbit(orbit) => {
                let output = self.fly_orbit(effective, input, &orbit);
                self.near_ground(output, input.ground, false, true)
            }
            Directive::Stop | Directive::Idle => self.rest(&input.nav),
            Directive::Follow { since } => {
                let reference = self.trajectory(effective.wrapping_sub(since));
                self.lead(effective, input, &reference)
            }
            Directive::Descend { rate_m_s, known, heading_free } => {
                let target = velocity(Vector3::new(0.0, 0.0, -rate_m_s), 0.0);
                let reference = self.steer(input, &target);
                let output = self.descend(effective, input, reference, known, heading_free);
                // With a failed rotor there is no torque to spare.
                let authority = if heading_free { Authority::Full } else { Authority::Gentle };
                OuterOutput { authority, heading_free, ..output }
            }
            Directive::GoTo { position, yaw, speeds } => {
                let reference = self.steer(input, &Target::Place { position, yaw, speeds });
                self.lead(effective, input, &reference)
            }
            Directive::Velocity { velocity: wanted, yaw_rate } => {
                let reference = self.steer(input, &velocity(wanted, yaw_rate));
                self.lead(effective, input, &reference)
            }
            Directive::Climb { height_m, speed_m_s, yaw } => {
                let reference = self.steer(input, &Target::Height { height_m, speed_m_s, yaw });
                self.lead(effective, input, &reference)
            }
        }
    }

    /// Follows a reference that guidance has made.
    fn lead(&mut self, effective: Tick, input: &OuterInput, reference: &FlatReference) -> OuterOutput {
        let output = self.follow(effective, input, reference);
        self.near_ground(output, input.ground, false, true)
    }

    /// An output with the authority that the ground leaves. Feet on the ground bear a part of the weight and turn the vehicle
    /// otherwise than its model says: with full authority it would rock until it tips over.
    fn near_ground(
        &mut self,
        output: OuterOutput,
        ground: Ground,
        has_direct_thrust: bool,
        in_air: bool,
    ) -> OuterOutput {
        let lands_below = if has_direct_thrust { LANDS_BY_HAND } else { LANDS } * self.mass_kg * self.model.gravity;
        let is_light = output.attitude.thrust_n < lands_below;
        let sinks = !has_direct_thrust && output.wanted_velocity.z < SINKS_M_S;
        let may_stand = match ground {
            Ground::Far => false,
            Ground::Near => is_light || sinks,
            Ground::Underfoot => is_light || !has_direct_thrust,
        };
        // In the next job.
        self.limits = self.limits.with_feet(may_stand.then_some(self.model.gravity));
        OuterOutput { authority: if !in_air || may_stand { Authority::Gentle } else { Authority::Full }, ..output }
    }

    /// Output on the ground, where nothing is controlled.
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
            thrust_effectiveness: self.thrust_effectiveness(),
            wanted_velocity: Vector3::zeros(),
            wanted_acceleration: Vector3::zeros(),
            wanted_yaw_rate: 0.0,
            law: LawState::default(),
        }
    }

    /// The trajectory at a time on the flight's clock, joined from the present setpoint if the vehicle is flying.
    fn trajectory(&mut self, ticks: Tick) -> FlatReference {
        match self.source {
            Source::Ground => self.guidance.join_from_start(),
            Source::Setpoint => self.guidance.join_from(&self.setpoint.reference().position),
            Source::Stream => self.guidance.join_from(&self.stream.reference().position),
            Source::ByHand(reference) => self.guidance.join_from(&reference.position),
            Source::Trajectory(_) => {}
        }
        let reference = self.guidance.at(ticks);
        self.source = Source::Trajectory(reference);
        reference
    }

    /// The generator's reference, continued from the last reference, or from where the vehicle stands.
    fn steer(&mut self, input: &OuterInput, target: &Target) -> FlatReference {
        if self.source != Source::Setpoint {
            let reference = self.last_reference(input);
            self.go_on_from(&reference);
            self.source = Source::Setpoint;
        }
        self.advance(target)
    }

    /// The reference of the last job, or where the vehicle stands.
    fn last_reference(&self, input: &OuterInput) -> FlatReference {
        match self.source {
            Source::Setpoint => self.setpoint.reference(),
            Source::Stream => self.after_stream(),
            Source::Trajectory(reference) | Source::ByHand(reference) => reference,
            Source::Ground => FlatReference::standing(input.nav.position, input.nav.yaw()),
        }
    }

    /// The stream's reference, for the generator to go on from. A stream may bend within milliseconds; the generator's lags
    /// carry on what they begin with for half a second, and a sharp bend would become metres per second.
    fn after_stream(&self) -> FlatReference {
        let reference = self.stream.reference();
        let size = math::sqrt(reference.jerk.norm_squared());
        let jerk = reference.jerk * math::min(1.0, self.modes.jerk_m_s3 / math::max(size, 1e-6));
        FlatReference { jerk, snap: Vector3::zeros(), ..reference }
    }

    /// The thrust effectiveness, or the one held in a blind descent.
    fn thrust_effectiveness(&self) -> f32 {
        self.blind_effectiveness.unwrap_or_else(|| self.law.thrust_effectiveness())
    }

    /// Position control: tracks a reference that is valid, like the output, at the tick `effective`.
    #[inline]
    pub fn follow(&mut self, effective: Tick, input: &OuterInput, reference: &FlatReference) -> OuterOutput {
        let now = self.predict(input);
        self.track(effective, &now, reference)
    }

    #[inline]
    fn track(&mut self, effective: Tick, now: &Predicted, reference: &FlatReference) -> OuterOutput {
        let (s, mut profile) = self.demand(now, reference);
        self.limited = self.limits.apply(&mut profile);
        self.output(effective, now, &profile, reference, s)
    }

    /// The force that the law demands.
    #[inline]
    fn demand(&mut self, now: &Predicted, reference: &FlatReference) -> (Vector3<f32>, ForceProfile) {
        let PositionDemand { s, profile } = self.law.step(&PositionInput {
            reference,
            position: &now.position,
            velocity: &now.velocity,
            acceleration: &now.acceleration,
            limited: self.limited,
        });
        if profile.is_finite() {
            return (s, profile);
        }
        // A product overflowed on an extreme motion: the law is reset because its state may hold the overflow.
        self.law.reset();
        (Vector3::zeros(), ForceProfile::hover(self.model.gravity))
    }

    /// The attitude and thrust that give a force.
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
            thrust_effectiveness: self.thrust_effectiveness(),
            wanted_velocity: reference.velocity,
            wanted_acceleration: reference.acceleration,
            wanted_yaw_rate: reference.yaw_rate,
            law: self.law.state(),
        }
    }

    /// Predicts the motion [`OUTER_AHEAD_S`] after the snapshot, by Eq. 2 with the estimated thrust.
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
