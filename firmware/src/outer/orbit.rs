//! Circles: a point that runs along one, followed by the stream tracker.

use nalgebra::Vector3;

use super::{Outer, OuterInput, OuterOutput, Source};
use crate::commander::{Orbit, OrbitHeading};
use crate::control::law::PositionLaw;
use crate::guidance::stream::{Motion, Sample};
use crate::math;
use crate::schedule::OUTER;
use crate::signals::{TICK_S, Tick};

/// Time between two jobs, s.
const STEP_S: f32 = OUTER.period as f32 * TICK_S;

/// The circle that is flown, and where on it the point is: an angle from north to the left, rad.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Circling {
    orbit: Option<Orbit>,
    angle: f32,
}

impl<P: PositionLaw> Outer<P> {
    /// One job on a circle.
    pub(super) fn fly_orbit(&mut self, effective: Tick, input: &OuterInput, orbit: &Orbit) -> OuterOutput {
        let rate = orbit.speed_m_s / orbit.radius_m;
        if self.circling.orbit == Some(*orbit) && self.source == Source::Stream {
            self.circling.angle = math::wrap_angle(self.circling.angle + rate * STEP_S);
        } else {
            // From the nearest point of the circle on; from its centre, ahead.
            let away = self.last_reference(input).position - orbit.center;
            let is_there = away.x * away.x + away.y * away.y > 1e-4;
            let angle = if is_there { math::atan2(away.y, away.x) } else { input.nav.yaw() };
            self.circling = Circling { orbit: Some(*orbit), angle };
        }
        let at = effective.wrapping_sub(OUTER.offset);
        let sample = Sample { motion: motion(orbit, self.circling.angle, rate), at, sent_ms: Some(at) };
        let reference = self.stream_to(effective, input, &sample);
        self.follow(effective, input, &reference)
    }
}

/// The motion of the point at an angle, rad, with its rate, rad/s.
fn motion(orbit: &Orbit, angle: f32, rate: f32) -> Motion {
    let (sin, cos) = math::sin_cos(angle);
    let out = Vector3::new(cos, sin, 0.0) * orbit.radius_m;
    let along = Vector3::new(-out.y, out.x, 0.0) * rate;
    let some = |v: Vector3<f32>| [Some(v.x), Some(v.y), Some(v.z)];
    let motion = Motion::default()
        .with_position(some(orbit.center + out))
        .with_velocity(some(along))
        .with_acceleration(some(out * (-rate * rate)));
    let quarter = if rate < 0.0 { -core::f32::consts::FRAC_PI_2 } else { core::f32::consts::FRAC_PI_2 };
    match orbit.heading {
        OrbitHeading::Kept => motion,
        OrbitHeading::Center => motion.with_yaw(angle + core::f32::consts::PI).with_yaw_rate(rate),
        OrbitHeading::Along => motion.with_yaw(angle + quarter).with_yaw_rate(rate),
    }
}
