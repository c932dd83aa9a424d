//! Attitude with a rotor lost: the heading is given up, the thrust axis is kept.
//!
//! A quadrotor that has lost a rotor can hold no yaw torque: with the opposite rotor idling, the other two carry it and
//! spin it up until drag holds the balance (Mueller and D'Andrea 2014). Of the torques across the thrust axis it keeps
//! both directions of one, by the two that carry, and one direction of the other, by the rotor opposite; a body that
//! spins turns that one through all directions. So what is asked for in the missing direction is left out, and the rest
//! flown by the law on the rotation group with gains for it: a tilt that stands in the world turns in the body at the
//! rate of the spin, and following it takes a torque in proportion to spin and rate.

use nalgebra::Vector3;

use crate::airframe::{Airframe, ROTORS};
use crate::control::attitude::{AttitudeForm, AttitudeGains, SlidingAttitude};
use crate::control::law::{AttitudeDemand, AttitudeInput, AttitudeLaw};
use crate::control::observer::ObserverGains;
use crate::control::sliding::{AxisGains, ReachingLaw};
use crate::math;

/// Surface, 1/s: a third of what four rotors are flown with.
const LAMBDA: f32 = 5.0;
/// Reaching gain, rad/s².
const GAIN: f32 = 60.0;
/// Sampling, lag and what is left of it, s.
const HORIZON_S: f32 = 0.04;
/// Greatest rate at which a tilt is taken back, rad/s: at a spin of 25 rad/s it takes 2 N m on the x500.
const APPROACH_MAX: f32 = 2.0;

/// The law with a rotor lost.
#[derive(Clone, Debug)]
pub struct MotorOut {
    law: SlidingAttitude,
    /// Unit vector of the torque that the lost rotor gave, about x and y.
    missing: Vector3<f32>,
    /// Greatest ω² of each rotor, as a part: 0 for the lost one.
    limits: [f32; ROTORS],
}

impl MotorOut {
    /// Without this rotor, from 0.
    pub fn new(airframe: &Airframe, rotor: usize) -> Self {
        let axis = AxisGains {
            approach_max: APPROACH_MAX,
            ..AxisGains::new(GAIN, LAMBDA, ReachingLaw::ImplicitSgn { horizon_s: HORIZON_S })
        };
        let gains = AttitudeGains { axes: [axis; 3], form: AttitudeForm::Group, observer: ObserverGains::default() };
        let of = |row: &[f32; ROTORS]| row.get(rotor).copied().unwrap_or(0.0);
        let torque = Vector3::new(of(&airframe.geometry.roll), of(&airframe.geometry.pitch), 0.0);
        let size = math::sqrt(torque.norm_squared());
        let missing = if size > 0.0 { torque / size } else { torque };
        let limits = core::array::from_fn(|i| if i == rotor { 0.0 } else { 1.0 });
        Self { law: SlidingAttitude::new(airframe, &gains), missing, limits }
    }

    /// Greatest ω² of each rotor, as a part.
    pub fn limits(&self) -> [f32; ROTORS] {
        self.limits
    }

    /// Torque for this tick, of what can be given; nothing about z.
    pub fn demand(&mut self, input: &AttitudeInput) -> AttitudeDemand {
        let AttitudeDemand { s, mut torque } = self.law.step(input);
        torque.z = 0.0;
        let beyond = torque.dot(&self.missing);
        if beyond > 0.0 {
            torque -= self.missing * beyond;
        }
        AttitudeDemand { s, torque }
    }
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "tests compare with bounds; what flies may not")]
mod tests {
    use super::*;
    use crate::control::rotor::RotorTorque;
    use crate::signals::AttitudeTarget;
    use nalgebra::UnitQuaternion;

    /// What is asked for at a tilt error about an axis of the body.
    fn torque(tilt: Vector3<f32>) -> Vector3<f32> {
        let airframe = Airframe::paper(3.0);
        let mut law = MotorOut::new(&airframe, 1);
        let zero = Vector3::zeros();
        let target = AttitudeTarget { attitude: UnitQuaternion::new(tilt), rates: zero, accelerations: zero };
        let still = RotorTorque::new(&airframe).steady(&[20.0; ROTORS]);
        let input = AttitudeInput {
            attitude: &UnitQuaternion::identity(),
            rates: &zero,
            target: &target,
            rotor_speeds: &[20.0; ROTORS],
            rotors: &still,
            saturated: false,
        };
        law.demand(&input).torque
    }

    #[test]
    fn what_the_lost_rotor_gave_is_not_asked_for_and_the_rest_is() {
        // Rotor 2, on the right, gave roll to the left: U2 = L b (ω4² − ω2²).
        assert!(torque(Vector3::new(-0.2, 0.1, 0.0)).x.abs() < 1e-6);
        assert!(torque(Vector3::new(0.2, 0.1, 0.0)).x > 0.0);
        assert!(torque(Vector3::new(-0.2, 0.1, 0.0)).y > 0.0);
        assert!(torque(Vector3::new(-0.2, -0.1, 0.5)).y < 0.0);
        assert_eq!(torque(Vector3::new(0.0, 0.0, 0.5)).z, 0.0);
    }
}
