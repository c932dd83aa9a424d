//! Following the set-points of a companion computer: motions by the stream tracker, attitudes and rates directly.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::{Outer, OuterInput, OuterOutput, Source, as_it_moves};
use crate::config::ModeSettings;
use crate::control::flatness::{ForceProfile, Heading};
use crate::control::law::PositionLaw;
use crate::control::position::ForceLimits;
use crate::guidance::hands;
use crate::guidance::stream::{Fastest, Sample};
use crate::latest::{AttitudeSetPoint, SetPoint, Stamped};
use crate::math;
use crate::signals::{AttitudeReference, FlatReference, Tick};

/// Level, with a heading, rad.
fn level(yaw: f32) -> UnitQuaternion<f32> {
    let (sin, cos) = math::sin_cos(0.5 * yaw);
    UnitQuaternion::new_unchecked(Quaternion::new(cos, 0.0, 0.0, sin))
}

impl<P: PositionLaw> Outer<P> {
    /// One job by the latest set-point. `in_air` is whether the vehicle is off the ground: on it, it is kept level.
    pub(super) fn follow_setpoint(&mut self, effective: Tick, input: &OuterInput, in_air: bool) -> OuterOutput {
        match input.latest.setpoint {
            Some(Stamped { value: SetPoint::Motion { motion, sent_ms }, at }) => {
                self.by_hand.end();
                let reference = self.stream_to(effective, input, &Sample { motion, at, sent_ms });
                self.follow(effective, input, &reference)
            }
            Some(Stamped { value: SetPoint::Attitude(wanted), .. }) => {
                self.follow_attitude(effective, input, &wanted, in_air)
            }
            None => {
                self.by_hand.end();
                let hold = super::velocity(Vector3::zeros(), 0.0);
                let reference = self.steer(input, &hold);
                self.follow(effective, input, &reference)
            }
        }
    }

    /// The stream's reference, continued from the last reference, or from where the vehicle stands.
    pub(super) fn stream_to(&mut self, effective: Tick, input: &OuterInput, sample: &Sample) -> FlatReference {
        if self.source != Source::Stream {
            let reference = self.last_reference(input);
            self.stream.start(&reference);
            self.source = Source::Stream;
        }
        let mut reference = self.stream.advance(effective, sample);
        // On the ground it must not run away.
        reference.position.z = math::max(reference.position.z, input.nav.position.z - super::LEAD_DOWN_M);
        reference
    }

    fn follow_attitude(
        &mut self,
        effective: Tick,
        input: &OuterInput,
        wanted: &AttitudeSetPoint,
        in_air: bool,
    ) -> OuterOutput {
        let now = self.predict(input);
        let (weight_n, most_n) = (self.mass_kg * self.model.gravity, self.mass_kg * self.limits.force_max());
        let thrust_n = hands::thrust_n(wanted.thrust, self.by_hand.settings.hover_throttle, 0.0, weight_n, most_n);
        self.by_hand.lead(&input.nav, input.thrust_n);
        let target = match wanted.attitude {
            _ if !in_air => self.by_hand.approach(&level(input.nav.yaw()), &Vector3::zeros(), &input.nav),
            Some(attitude) => self.by_hand.approach(&attitude, &wanted.rates, &input.nav),
            None => self.by_hand.rotate(&wanted.rates, &input.nav),
        };
        let thrust = self.by_hand.thrust(thrust_n);
        let heading = Heading { angle: input.nav.yaw(), rate: 0.0, acceleration: 0.0 };
        let reference = as_it_moves(&now, &heading);
        self.source = Source::ByHand(reference);
        let (s, _) = self.demand(&now, &reference);
        let hover = ForceProfile::hover(self.model.gravity);
        let attitude =
            AttitudeReference { valid_at: effective, target, thrust_n: thrust.value, thrust_rate_n_s: thrust.rate };
        OuterOutput { attitude, ..self.output(effective, &now, &hover, &reference, s) }
    }

    /// How fast what is streamed may move.
    pub(super) fn fastest(&self) -> Fastest {
        fastest(&self.modes, self.limits, self.model.gravity)
    }
}

/// Part of g by which a streamed target may accelerate downwards: what is left of the weight keeps the attitude, also when
/// the law takes some of it.
const FALLING: f32 = 0.4;

/// Part of the vehicle's own horizontal acceleration that a streamed target may have: the rest is for drag, wind, and what
/// the vehicle is off by. Without it the vehicle would fall behind, and race after the reference at more than its speed.
const FOLLOWED: f32 = 0.8;

/// How fast a stream may move: horizontally as the tilt allows, or as the rotors do while they carry the weight; vertically
/// as far as neither the rotors are at their end nor the weight is gone.
pub(super) fn fastest(modes: &ModeSettings, limits: ForceLimits, gravity: f32) -> Fastest {
    let most = limits.force_max();
    let across = math::sqrt(math::max(most * most - gravity * gravity, 0.0));
    Fastest {
        speed_m_s: modes.fastest_m_s,
        acceleration_m_s2: FOLLOWED * math::min(limits.tan_tilt_max() * gravity, across),
        vertical_m_s2: math::clamp(most - gravity, 0.0, FALLING * gravity),
    }
}
