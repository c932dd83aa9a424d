//! The linear response of a control law, measured on the law itself: a sinusoid of small amplitude on one of its
//! inputs, the others at rest, with both signs.

use firmware::control::law::{AttitudeInput, AttitudeLaw, PositionInput, PositionLaw, RotorEffect};
use firmware::signals::{AttitudeTarget, FlatReference, TICK_S_EXACT};
use nalgebra::{Complex, Quaternion, UnitQuaternion, Vector3};

use super::sine::Schedule;
use super::vehicle::{OUTER_STEP_S, Vehicle};

/// Settling time of a law's filters, s.
const ATTITUDE_SETTLE_S: f64 = 1.0;
const POSITION_SETTLE_S: f64 = 4.0;

/// Amplitudes: a hundredth of a boundary layer that is usual here, a thousand times an f32's rounding.
pub(super) const ANGLE_RAD: f64 = 2e-4;
pub(super) const RATE_RAD_S: f64 = 4e-3;
const ACCELERATION_RAD_S2: f64 = 0.1;
/// Of the rotors' speed at hover.
const ROTOR_PART: f64 = 1e-3;
pub(super) const POSITION_M: f64 = 1e-3;
pub(super) const VELOCITY_M_S: f64 = 3e-3;
const ACCELERATION_M_S2: f64 = 1e-2;

/// An input of an attitude law, about one axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AttitudeChannel {
    Angle,
    Rate,
    /// Rotor speeds, as their estimated torque; the law computes the spin-up reaction.
    Torque,
    TargetAngle,
    TargetRate,
    TargetAcceleration,
}

/// Torque of an attitude law about `axis` per unit of an input, at ω.
pub(super) fn attitude<A: AttitudeLaw + Clone>(
    law: &A,
    vehicle: &Vehicle,
    axis: usize,
    channel: AttitudeChannel,
    omega_rad_s: f64,
) -> Complex<f64> {
    let torque = ROTOR_PART * vehicle.omega.min() / vehicle.omega_per_torque[axis].amax();
    let amplitude = match channel {
        AttitudeChannel::Angle | AttitudeChannel::TargetAngle => ANGLE_RAD,
        AttitudeChannel::Rate | AttitudeChannel::TargetRate => RATE_RAD_S,
        AttitudeChannel::TargetAcceleration => ACCELERATION_RAD_S2,
        AttitudeChannel::Torque => torque,
    };
    let probe = || Probe { law: law.clone(), vehicle, axis, channel, rotors: None };
    let (mut up, mut down) = (probe(), probe());
    let schedule = Schedule::new(omega_rad_s, TICK_S_EXACT, ATTITUDE_SETTLE_S);
    let answer = |step: u32| {
        let value = amplitude * schedule.cos(step);
        [0.5 * (up.torque(value) - down.torque(-value)) / amplitude]
    };
    schedule.amplitudes((0..schedule.steps()).map(answer))[0]
}

/// An attitude law with one varying input.
struct Probe<'a, A> {
    law: A,
    vehicle: &'a Vehicle,
    axis: usize,
    channel: AttitudeChannel,
    /// Effect of the rotors in the previous tick.
    rotors: Option<RotorEffect>,
}

impl<A: AttitudeLaw> Probe<'_, A> {
    /// The law's torque in the next tick, with a value on the input.
    fn torque(&mut self, value: f64) -> f64 {
        let axis = self.axis;
        let on = |wanted: AttitudeChannel| if self.channel == wanted { value } else { 0.0 };
        let target = AttitudeTarget {
            attitude: turn(axis, on(AttitudeChannel::TargetAngle)),
            rates: along(axis, on(AttitudeChannel::TargetRate)),
            accelerations: along(axis, on(AttitudeChannel::TargetAcceleration)),
        };
        let rotor_speeds = self.vehicle.speeds(axis, on(AttitudeChannel::Torque));
        let model = &self.vehicle.rotor_torque;
        let rotors = match &self.rotors {
            Some(before) => model.after(before, &rotor_speeds),
            None => model.steady(&rotor_speeds),
        };
        self.rotors = Some(rotors);
        let demand = self.law.step(&AttitudeInput {
            attitude: &turn(axis, on(AttitudeChannel::Angle)),
            rates: &along(axis, on(AttitudeChannel::Rate)),
            target: &target,
            rotor_speeds: &rotor_speeds,
            rotors: &rotors,
            saturated: false,
        });
        f64::from(demand.torque[axis])
    }
}

/// A turn by an angle (rad) about a body axis.
pub(super) fn turn(axis: usize, angle_rad: f64) -> UnitQuaternion<f32> {
    let (sin, cos) = libm::sincos(0.5 * angle_rad);
    let vector = along(axis, sin);
    UnitQuaternion::new_unchecked(Quaternion::new(cos as f32, vector.x, vector.y, vector.z))
}

fn along(axis: usize, value: f64) -> Vector3<f32> {
    let mut vector = Vector3::zeros();
    vector[axis] = value as f32;
    vector
}

/// Force and its two derivatives of a position law along `axis`, for a unit of position, of velocity and of acceleration,
/// at ω.
pub(super) fn position<P: PositionLaw + Clone>(law: &P, axis: usize, omega_rad_s: f64) -> [[Complex<f64>; 3]; 3] {
    let schedule = Schedule::new(omega_rad_s, OUTER_STEP_S, POSITION_SETTLE_S);
    [(0, POSITION_M), (1, VELOCITY_M_S), (2, ACCELERATION_M_S2)].map(|(channel, amplitude)| {
        let mut laws = [law.clone(), law.clone()];
        let answer = |step: u32| {
            let value = amplitude * schedule.cos(step);
            let [up, down] = &mut laws;
            let [up, down] = [(up, value), (down, -value)].map(|(law, v)| profile_for(law, axis, channel, v));
            core::array::from_fn(|i| 0.5 * (up[i] - down[i]) / amplitude)
        };
        schedule.amplitudes((0..schedule.steps()).map(answer))
    })
}

/// One step of a position law with a value on one of position, velocity, acceleration.
fn profile_for<P: PositionLaw>(law: &mut P, axis: usize, channel: usize, value: f64) -> [f64; 3] {
    let on = |wanted: usize| along(axis, if channel == wanted { value } else { 0.0 });
    let demand = law.step(&PositionInput {
        reference: &FlatReference::standing(Vector3::zeros(), 0.0),
        position: &on(0),
        velocity: &on(1),
        acceleration: &on(2),
        limited: false,
    });
    let profile = demand.profile;
    [profile.force, profile.rate, profile.acceleration].map(|v| f64::from(v[axis]))
}
