//! The linear loops at one frequency; the equations are in the parent module's docs.

use firmware::control::law::{AttitudeLaw, PositionLaw};
use nalgebra::{Complex, Matrix3, RowVector3, Vector3};

use super::chain::Moved;
use super::law::{self, ANGLE_RAD, AttitudeChannel, POSITION_M, RATE_RAD_S, VELOCITY_M_S};
use super::margins::size;
use super::vehicle::{Actuation, OUTER_STEP_S, Vehicle, turned};
use firmware::signals::TICK_S_EXACT;

/// A loop opened at a law's demand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LoopAt {
    /// L.
    pub(super) value: Complex<f64>,
    /// w: weights of the demand, s = w · demand.
    pub(super) weights: [Complex<f64>; 3],
    /// An amplitude of s that is small for the laws.
    pub(super) small: f64,
}

/// An attitude loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AttitudeAt {
    /// Opened at the torque.
    pub(super) opened: LoopAt,
    /// Torque for a unit of the target's angle, rate and acceleration; of the measured angle and rate.
    for_target: [Complex<f64>; 3],
    for_rate: Complex<f64>,
    /// Motion for a unit of torque demanded.
    moved: Moved,
    actuation: Actuation,
}

impl Moved {
    /// With the path from demand to rotors.
    fn after(self, gain: Complex<f64>) -> Self {
        let Self { rate, angle, velocity, position } = self;
        Self { rate: rate * gain, angle: angle * gain, velocity: velocity * gain, position: position * gain }
    }
}

impl AttitudeAt {
    /// For an axis: roll, pitch, yaw.
    pub(super) fn new<A: AttitudeLaw + Clone>(law: &A, vehicle: &Vehicle, axis: usize, omega_rad_s: f64) -> Self {
        let gain = |channel| law::attitude(law, vehicle, axis, channel, omega_rad_s);
        let actuation = vehicle.turning(axis, omega_rad_s);
        let moved = vehicle.about[axis].at(turned(omega_rad_s * TICK_S_EXACT)).after(actuation.delayed);
        let for_rate = gain(AttitudeChannel::Rate);
        let returned = gain(AttitudeChannel::Angle) * moved.angle
            + for_rate * moved.rate
            + gain(AttitudeChannel::Torque) * actuation.believed;
        let (one, zero) = (Complex::new(1.0, 0.0), Complex::new(0.0, 0.0));
        let small = (ANGLE_RAD / size(moved.angle)).min(RATE_RAD_S / size(moved.rate));
        Self {
            opened: LoopAt { value: -returned, weights: [one, zero, zero], small },
            for_target: [
                AttitudeChannel::TargetAngle,
                AttitudeChannel::TargetRate,
                AttitudeChannel::TargetAcceleration,
            ]
            .map(gain),
            for_rate,
            moved,
            actuation,
        }
    }

    /// Angle for a unit of the target's angle, its derivatives given as zero.
    pub(super) fn followed(&self) -> Complex<f64> {
        self.for_target[0] * self.moved.angle / (self.opened.value + 1.0)
    }

    /// Rotor speed commanded (rad/s, as a torque, N m, before it is shared out) for a unit of noise on the rate.
    pub(super) fn command_for_rate_noise(&self) -> Complex<f64> {
        self.for_rate * self.actuation.command / (self.opened.value + 1.0)
    }
}

/// A position loop along `axis`: x, y, z.
pub(super) fn position<A: AttitudeLaw + Clone, P: PositionLaw + Clone>(
    (attitude, law): (&A, &P),
    vehicle: &Vehicle,
    axis: usize,
    omega_rad_s: f64,
) -> LoopAt {
    let gains = law::position(law, axis, omega_rad_s);
    // The returned demand for a demand.
    let returned = |weights: [Complex<f64>; 3], motion: [Complex<f64>; 3]| {
        let inputs = vehicle.predicted(axis, motion);
        let asked = |part: usize| -> Complex<f64> { gains.iter().zip(&inputs).map(|(g, input)| g[part] * input).sum() };
        Vector3::new(asked(0), asked(1), asked(2)) * RowVector3::from(weights)
    };
    let (weights, motion) = reach(attitude, vehicle, axis, omega_rad_s);
    let mut whole: Matrix3<Complex<f64>> = returned(weights, motion);
    let mut value = -whole.trace();
    if omega_rad_s > IMAGES_FROM_RAD_S {
        for image in [-TURN_RAD_S, TURN_RAD_S, -2.0 * TURN_RAD_S] {
            let (weights, motion) = reach(attitude, vehicle, axis, omega_rad_s + image);
            whole += returned(weights, motion);
        }
        let (_, triangle) = whole.schur().unpack();
        let first = triangle.diagonal().iter().copied().max_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()));
        value = -first.unwrap_or_default();
    }
    let small = (POSITION_M / size(motion[0])).min(VELOCITY_M_S / size(motion[1]));
    LoopAt { value, weights, small }
}

/// 2π over the outer partition's period.
const TURN_RAD_S: f64 = core::f64::consts::TAU / OUTER_STEP_S;

/// Below this, the images of the hold are smaller than one millionth.
const IMAGES_FROM_RAD_S: f64 = 50.0;

/// Weights of the demand of a position loop, and position, velocity and specific thrust for a unit of what comes of it;
/// at a frequency that may be negative.
fn reach<A: AttitudeLaw + Clone>(
    attitude: &A,
    vehicle: &Vehicle,
    axis: usize,
    omega_rad_s: f64,
) -> ([Complex<f64>; 3], [Complex<f64>; 3]) {
    let positive = omega_rad_s.abs();
    let (weights, motion) = match axis {
        // A force along x tilts the vehicle about y, one along y about −x.
        0 | 1 => horizontal(attitude, vehicle, 1 - axis, positive),
        _ => vertical(vehicle, positive),
    };
    if omega_rad_s < 0.0 { (weights.map(|w| w.conj()), motion.map(|m| m.conj())) } else { (weights, motion) }
}

/// Weights of a horizontal force and its derivatives towards the torque about `about`, and position, velocity and
/// specific thrust for a unit of torque.
fn horizontal<A: AttitudeLaw + Clone>(
    attitude: &A,
    vehicle: &Vehicle,
    about: usize,
    omega_rad_s: f64,
) -> ([Complex<f64>; 3], [Complex<f64>; 3]) {
    let inner = AttitudeAt::new(attitude, vehicle, about, omega_rad_s);
    let [k0, k1, k2] = Vehicle::hold(omega_rad_s);
    let [angle, rate, acceleration] = inner.for_target;
    let per = (inner.opened.value + 1.0) * vehicle.specific_thrust;
    let weights = [angle * k0, angle * k1 + rate * k0, angle * k2 + rate * k1 + acceleration * k0].map(|w| w / per);
    let Moved { angle, velocity, position, .. } = inner.moved;
    (weights, [position, velocity, angle * vehicle.specific_thrust])
}

/// The same along z, a unit of thrust (N) in place of the torque.
fn vertical(vehicle: &Vehicle, omega_rad_s: f64) -> ([Complex<f64>; 3], [Complex<f64>; 3]) {
    let actuation = vehicle.actuation(omega_rad_s);
    let [k0, k1, _] = Vehicle::hold(omega_rad_s);
    let moved = vehicle.vertical.at(turned(omega_rad_s * TICK_S_EXACT)).after(actuation.delayed);
    let weights = [k0 * vehicle.mass_kg, k1 * vehicle.mass_kg, Complex::new(0.0, 0.0)];
    (weights, [moved.angle, moved.rate, actuation.believed / vehicle.mass_kg])
}

/// A loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Which {
    /// Roll, pitch, yaw.
    Attitude(usize),
    /// x, y, z.
    Position(usize),
}

impl Which {
    pub(super) const ALL: [Self; 6] = [
        Self::Attitude(0),
        Self::Attitude(1),
        Self::Attitude(2),
        Self::Position(0),
        Self::Position(1),
        Self::Position(2),
    ];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Attitude(axis) => ["roll", "pitch", "yaw"][axis],
            Self::Position(axis) => ["x", "y", "z"][axis],
        }
    }

    /// Period of its law, s.
    pub(super) fn step_s(self) -> f64 {
        match self {
            Self::Attitude(_) => TICK_S_EXACT,
            Self::Position(_) => OUTER_STEP_S,
        }
    }

    /// Opened, at a frequency.
    pub(super) fn at<A: AttitudeLaw + Clone, P: PositionLaw + Clone>(
        self,
        laws: (&A, &P),
        vehicle: &Vehicle,
        omega_rad_s: f64,
    ) -> LoopAt {
        match self {
            Self::Attitude(axis) => AttitudeAt::new(laws.0, vehicle, axis, omega_rad_s).opened,
            Self::Position(axis) => position(laws, vehicle, axis, omega_rad_s),
        }
    }
}
