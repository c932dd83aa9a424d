//! Attitude control with a failed rotor: gives up the heading and keeps the thrust axis.
//!
//! A quadrotor with a failed rotor cannot balance the yaw torque: the two neighbours carry it, the opposite rotor
//! idles, and the vehicle spins up until drag balances the torque (Mueller and D'Andrea 2014). Perpendicular to the
//! thrust axis it keeps one torque in both directions, by the two neighbours, and the other in one direction only, by
//! the opposite rotor; as the body spins, that direction sweeps through all directions of the world.
//!
//! So the demand in the missing direction is dropped, and the rest comes from the law on the rotation group with lower
//! gains: a tilt that is constant in the world turns in the body at the rate of the spin, and following it takes a
//! torque in proportion to spin and rate.

use nalgebra::Vector3;

use crate::airframe::{Airframe, ROTORS};
use crate::control::attitude::{AttitudeForm, AttitudeGains, SlidingAttitude};
use crate::control::law::{AttitudeDemand, AttitudeInput, AttitudeLaw};
use crate::control::observer::ObserverGains;
use crate::control::sliding::{AxisGains, ReachingLaw};
use crate::math;

/// Slope of the surface, 1/s: a third of that with four rotors.
const LAMBDA: f32 = 5.0;
/// Reaching gain, rad/s².
const GAIN: f32 = 60.0;
/// Horizon of the reaching law, s: sampling, rotor lag and a reserve.
const HORIZON_S: f32 = 0.04;
/// Greatest rate at which a tilt error is reduced, rad/s: at a spin of 25 rad/s it takes 2 N m on the x500.
const APPROACH_MAX: f32 = 2.0;

/// The attitude law with a failed rotor.
#[derive(Clone, Debug)]
pub struct MotorOut {
    law: SlidingAttitude,
    /// Unit vector of the failed rotor's torque, about x and y.
    missing: Vector3<f32>,
    /// Limit on ω² of each rotor, as a fraction of ωmax²: 0 for the failed one.
    limits: [f32; ROTORS],
}

impl MotorOut {
    /// Without this rotor, counted from 0.
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

    /// Limit on ω² of each rotor, as a fraction of ωmax².
    pub fn limits(&self) -> [f32; ROTORS] {
        self.limits
    }

    /// Torque for this tick, without the direction that cannot be produced and without yaw.
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

    /// The torque demanded at a tilt error, a rotation vector in the body.
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
    fn the_torque_of_the_lost_rotor_is_not_demanded_and_the_rest_is() {
        // Rotor 2, on the right, gave roll to the left: U2 = L b (ω4² − ω2²).
        assert!(torque(Vector3::new(-0.2, 0.1, 0.0)).x.abs() < 1e-6);
        assert!(torque(Vector3::new(0.2, 0.1, 0.0)).x > 0.0);
        assert!(torque(Vector3::new(-0.2, 0.1, 0.0)).y > 0.0);
        assert!(torque(Vector3::new(-0.2, -0.1, 0.5)).y < 0.0);
        assert_eq!(torque(Vector3::new(0.0, 0.0, 0.5)).z, 0.0);
    }
}
