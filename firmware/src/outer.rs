//! The outer partition, 250 Hz: guidance and position control.
//!
//! Works on a snapshot of the motion and gives an attitude reference for the tick at which it is published; the
//! motion is carried forward to that tick by the model, so that errors are taken between like times.

use nalgebra::Vector3;

use crate::config::FlightConfig;
use crate::control::flatness::{self, ForceProfile, Heading};
use crate::control::law::{PositionDemand, PositionInput, PositionLaw};
use crate::control::position::{ForceLimits, SlidingPosition, Translation};
use crate::guidance::Guidance;
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
    /// The tick at which the flight's clock started; none while disarmed.
    pub flight_start: Option<Tick>,
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
}

/// The outer partition, with a position law.
#[derive(Clone, Debug)]
pub struct Outer<P = SlidingPosition> {
    mass_kg: f32,
    model: Translation,
    limits: ForceLimits,
    guidance: Guidance,
    law: P,
    limited: bool,
}

/// Position, velocity, acceleration and thrust axis when the output takes effect.
struct Predicted {
    position: Vector3<f32>,
    velocity: Vector3<f32>,
    acceleration: Vector3<f32>,
    thrust_axis: Vector3<f32>,
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
            guidance: Guidance::new(config.trajectory, config.join.as_ref(), config.start_position())?,
            law,
            limited: false,
        })
    }

    /// Forgets what the law has made of earlier jobs.
    pub fn reset(&mut self) {
        self.law.reset();
        self.limited = false;
    }

    /// One job, released at `released`.
    pub fn step(&mut self, released: Tick, input: &OuterInput) -> OuterOutput {
        let effective = released.wrapping_add(OUTER.offset);
        let Some(start) = input.flight_start else {
            self.reset();
            let attitude = AttitudeReference::idle(input.nav.attitude);
            return OuterOutput { attitude, s: Vector3::zeros(), limited: false };
        };
        let reference = self.guidance.at(effective.wrapping_sub(start));
        self.follow(effective, input, &reference)
    }

    /// Position control towards a reference that holds, as the output will, at the tick `effective`.
    #[inline]
    pub fn follow(&mut self, effective: Tick, input: &OuterInput, reference: &FlatReference) -> OuterOutput {
        let now = self.predict(input);
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
        let heading =
            Heading { angle: reference.yaw, rate: reference.yaw_rate, acceleration: reference.yaw_acceleration };
        let mass = self.mass_kg;
        OuterOutput {
            attitude: AttitudeReference {
                valid_at: effective,
                target: flatness::attitude_target(&profile, &heading),
                thrust_n: math::max(mass * profile.force.dot(&now.thrust_axis), 0.0),
                thrust_rate_n_s: mass * profile.rate.dot(&now.thrust_axis),
            },
            s,
            limited: self.limited,
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
