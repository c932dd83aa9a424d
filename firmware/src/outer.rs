//! The outer partition, 250 Hz: guidance and position control.
//!
//! Works on a snapshot of the motion and gives an attitude reference for the tick at which it is published; the
//! motion is carried forward to that tick by the model, so that errors are taken between like times.

use nalgebra::Vector3;

use crate::airframe::Airframe;
use crate::config::FlightConfig;
use crate::control::attitude::Euler;
use crate::control::flatness::{self, Heading};
use crate::control::position::{self, PositionGains};
use crate::guidance::Guidance;
use crate::math;
use crate::schedule::OUTER;
use crate::signals::{AttitudeReference, NavState, TICK_S, Tick};
use crate::validate::ConfigError;

/// Snapshot for the outer partition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OuterInput {
    /// The motion at the release.
    pub nav: NavState,
    /// Thrust of the last motor command, N.
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

/// The outer partition.
#[derive(Clone, Debug)]
pub struct Outer {
    airframe: Airframe,
    gains: PositionGains,
    guidance: Guidance,
    force_max: f32,
    tan_tilt_max: f32,
}

/// Position, velocity, acceleration and thrust axis when the output takes effect.
struct Predicted {
    position: Vector3<f32>,
    velocity: Vector3<f32>,
    acceleration: Vector3<f32>,
    thrust_axis: Vector3<f32>,
    heading: f32,
    heading_rate: f32,
}

impl Outer {
    /// Ready to run with a valid configuration.
    ///
    /// # Errors
    /// What of the trajectory or the joining path is out of its range.
    pub fn new(config: &FlightConfig) -> Result<Self, ConfigError> {
        let (sin_tilt, cos_tilt) = math::sin_cos(config.position.tilt_max_rad);
        Ok(Self {
            airframe: config.airframe,
            gains: config.position,
            guidance: Guidance::new(config.trajectory, config.join.as_ref(), config.start_position())?,
            tan_tilt_max: sin_tilt / cos_tilt,
            force_max: config.airframe.thrust_max_n() / config.airframe.mass_kg,
        })
    }

    /// One job, released at `released`.
    pub fn step(&self, released: Tick, input: &OuterInput) -> OuterOutput {
        let effective = released.wrapping_add(OUTER.offset);
        let now = self.predict(input, OUTER.offset as f32 * TICK_S);
        let Some(start) = input.flight_start else {
            return OuterOutput {
                attitude: AttitudeReference::level(now.heading, 0.0),
                s: Vector3::zeros(),
                limited: false,
            };
        };
        let reference = self.guidance.at(effective.wrapping_sub(start));
        let axes = &self.gains.axes;
        let demand = position::demand(axes, &self.airframe, &reference, &now.position, &now.velocity);
        let mut profile =
            position::force_profile(axes, &self.airframe, &reference, &demand, &now.velocity, &now.acceleration);
        let limited = position::limit(&mut profile, self.force_max, self.tan_tilt_max);
        let heading = Heading { angle: now.heading, rate: now.heading_rate, acceleration: reference.yaw_acceleration };
        let mut target = flatness::euler_reference(&profile, &heading);
        target.angles.z = reference.yaw;
        target.rates.z = reference.yaw_rate;
        let mass = self.airframe.mass_kg;
        OuterOutput {
            attitude: AttitudeReference {
                valid_at: effective,
                angles: target.angles,
                rates: target.rates,
                accelerations: target.accelerations,
                thrust_n: math::max(mass * profile.force.dot(&now.thrust_axis), 0.0),
                thrust_rate_n_s: mass * profile.rate.dot(&now.thrust_axis),
            },
            s: demand.s,
            limited,
        }
    }

    /// The motion `dt` seconds after the snapshot, by Eq. 2 with the last thrust.
    fn predict(&self, input: &OuterInput, dt: f32) -> Predicted {
        let nav = &input.nav;
        let axis = nav.attitude * Vector3::z();
        let axis_rate = nav.attitude * Vector3::new(nav.rates.y, -nav.rates.x, 0.0);
        let drag = Vector3::from(self.airframe.drag_n_s_m).component_mul(&nav.velocity);
        let gravity = Vector3::new(0.0, 0.0, self.airframe.gravity_m_s2);
        let acceleration = (axis * input.thrust_n - drag) * (1.0 / self.airframe.mass_kg) - gravity;
        let euler = Euler::from_quaternion(&nav.attitude);
        let heading_rate = euler.rates(&nav.rates).z;
        Predicted {
            position: nav.position + nav.velocity * dt + acceleration * (0.5 * dt * dt),
            velocity: nav.velocity + acceleration * dt,
            acceleration,
            thrust_axis: axis + axis_rate * dt,
            heading: euler.heading() + heading_rate * dt,
            heading_rate,
        }
    }
}
