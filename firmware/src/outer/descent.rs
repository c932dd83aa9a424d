//! Descents: controlled as far as the motion is known.

use nalgebra::Vector3;

use super::{LAG_UP_M, LEAD_DOWN_M, Outer, OuterInput, OuterOutput, Predicted, forget_horizontal};
use crate::commander::Known;
use crate::control::flatness::ForceProfile;
use crate::control::law::{PositionInput, PositionLaw};
use crate::math;
use crate::signals::{FlatReference, Tick};

impl<P: PositionLaw> Outer<P> {
    /// Descends, controlling what is known of the motion.
    pub(super) fn descend(
        &mut self,
        effective: Tick,
        input: &OuterInput,
        mut reference: FlatReference,
        known: Known,
        heading_free: bool,
    ) -> OuterOutput {
        let mut now = self.predict(input);
        if known > Known::Position {
            // Once the position is known again, the generator continues from here.
            self.setpoint.put_horizontally(now.position.x, now.position.y);
            (reference.position.x, reference.position.y) = (now.position.x, now.position.y);
        }
        self.leash(&mut reference, &now, true);
        if heading_free {
            (reference.yaw, reference.yaw_rate, reference.yaw_acceleration) = (input.nav.yaw(), 0.0, 0.0);
        }
        match known {
            Known::Position | Known::Velocity if heading_free => self.damp(effective, &now, &reference),
            Known::Position | Known::Velocity => self.track(effective, &now, &reference),
            Known::Height => {
                now.forget_horizontal();
                forget_horizontal(&mut reference);
                self.track(effective, &now, &reference).wanting_what_it_does(&input.nav)
            }
            Known::Climb => {
                now.forget_horizontal();
                forget_horizontal(&mut reference);
                self.setpoint.put_vertically(now.position.z);
                reference.position.z = now.position.z;
                self.track(effective, &now, &reference).wanting_what_it_does(&input.nav)
            }
            Known::Attitude => {
                self.setpoint.put_vertically(now.position.z);
                self.sink(effective, &now, &reference)
            }
        }
    }

    /// Keeps a reference that descends close to the vehicle's height.
    pub(super) fn leash(&mut self, reference: &mut FlatReference, now: &Predicted, descends: bool) {
        if !descends {
            return;
        }
        let (lowest, highest) = (now.position.z - LEAD_DOWN_M, now.position.z + LAG_UP_M);
        let leashed = math::clamp(reference.position.z, lowest, highest);
        if leashed != reference.position.z {
            self.setpoint.put_vertically(leashed);
            reference.position.z = leashed;
        }
    }

    /// Descends at the reference's rate and only damps horizontal motion, with a low gain: with a failed rotor the
    /// attitude responds slowly, and a fast position loop around it would be unstable.
    fn damp(&mut self, effective: Tick, now: &Predicted, reference: &FlatReference) -> OuterOutput {
        /// Gain on the horizontal velocity, 1/s, and limit of the acceleration, m/s². Chosen: a tenth of the attitude
        /// law's slope with a failed rotor (5/s, see `motor_out`), and a tilt of 9° at most.
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

    /// Level, with a thrust below the weight.
    fn sink(&mut self, effective: Tick, now: &Predicted, reference: &FlatReference) -> OuterOutput {
        // The law's thrust effectiveness is still valid: it is kept before the law is reset.
        let share = 1.0 / *self.blind_effectiveness.get_or_insert(self.law.thrust_effectiveness());
        self.reset_law();
        let profile = ForceProfile::hover(self.blind_force * share);
        self.output(effective, now, &profile, reference, Vector3::zeros())
    }
}
