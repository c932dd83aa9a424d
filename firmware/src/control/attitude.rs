//! Attitude control: sliding mode on the rotation group, or on the paper's Euler angles, and the inverse model to
//! torque.
//!
//! Both forms return the demanded angular acceleration `η̈d + λ ė + u_r(s)`; the inverse model [`torque`] converts it
//! to torques. On the group the error is [`PointingError`]'s and the surface `s = λ e + R(qe) Ωd − Ω`, defined at any
//! attitude.
//!
//! The Euler form is Eq. 25–27: surfaces on φ, θ, ψ. With η̇ and η̈ themselves as inputs, [`euler_demand`] and
//! [`torque`] are those equations exactly as printed, where φ̇ ≈ p. In flight η̇ and η̈ are converted to body rates and
//! accelerations by the exact kinematics, which are defined for |θ| < 90°.

use nalgebra::{UnitQuaternion, Vector3};

use crate::airframe::Airframe;
use crate::control::euler::{Euler, EulerReference};
use crate::control::law::{AttitudeDemand, AttitudeInput, AttitudeLaw, LawState};
use crate::control::observer::{DisturbanceObserver, ObserverGains};
use crate::control::pointing::PointingError;
use crate::control::sliding::{AxisGains, SlidingAxis};
use crate::math;
use crate::settings::{Change, Place};
use crate::signals::{AttitudeTarget, TICK_S};
use crate::validate::ConfigError;

/// Coordinates of the sliding surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum AttitudeForm {
    /// The rotation group, without a singularity.
    #[default]
    Group,
    /// Euler angles, as in the paper.
    Euler,
}

impl AttitudeForm {
    /// Number of the form, for a setting.
    pub const fn code(self) -> i32 {
        match self {
            Self::Group => 0,
            Self::Euler => 1,
        }
    }

    /// The form of a code.
    pub const fn of_code(code: i32) -> Self {
        if code == 1 { Self::Euler } else { Self::Group }
    }
}

/// Gains of the attitude loop.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct AttitudeGains {
    /// Roll, pitch, yaw.
    pub axes: [AxisGains; 3],
    /// Coordinates of the surfaces.
    pub form: AttitudeForm,
    /// Observer of the angular acceleration's disturbance, rad/s².
    pub observer: ObserverGains,
}

impl AttitudeGains {
    /// Checks that the law is defined for these gains.
    ///
    /// # Errors
    /// The first gain that is out of range.
    pub fn validate(&self) -> Result<(), ConfigError> {
        let [roll, pitch, yaw] = &self.axes;
        roll.validate("control.roll")?;
        pitch.validate("control.pitch")?;
        yaw.validate("control.yaw")?;
        self.observer.validate("control.attitude_observer")
    }
}

/// Sliding mode control of the attitude, in the loop.
#[derive(Clone, Debug)]
#[repr(C)]
pub struct SlidingAttitude {
    airframe: Airframe,
    inverse_inertia: Vector3<f32>,
    axes: [SlidingAxis; 3],
    form: AttitudeForm,
    observer: Option<DisturbanceObserver>,
    /// What the above was built from, to be changed in flight.
    gains: AttitudeGains,
}

impl SlidingAttitude {
    /// With valid gains.
    pub fn new(airframe: &Airframe, gains: &AttitudeGains) -> Self {
        let observer = gains.observer;
        Self {
            airframe: *airframe,
            inverse_inertia: Vector3::from(airframe.inertia_kg_m2).map(|i| 1.0 / i),
            axes: gains.axes.map(|axis| SlidingAxis::new(&axis, TICK_S)),
            form: gains.form,
            observer: (observer.bandwidth_rad_s > 0.0).then(|| DisturbanceObserver::new(&observer, TICK_S)),
            gains: *gains,
        }
    }

    /// s and the demanded angular acceleration Ω̇, on the group.
    #[inline]
    fn on_group(&mut self, input: &AttitudeInput) -> (Vector3<f32>, Vector3<f32>) {
        let pointing = PointingError::between(input.attitude, &input.target.attitude);
        let rate_error = pointing.to_body(&input.target.rates) - input.rates;
        // d/dt [R(qe) Ωd] = R(qe) Ω̇d − Ω × R(qe) Ωd, and Ω × Ω = 0.
        let feedforward = pointing.to_body(&input.target.accelerations) - input.rates.cross(&rate_error);
        let (e, rate) = (&pointing.error, pointing.rate(&rate_error));
        let hold = input.saturated;
        let [g1, g2, g3] = &mut self.axes;
        let roll = g1.correction_along(e.x, rate.x, rate_error.x, hold);
        let pitch = g2.correction_along(e.y, rate.y, rate_error.y, hold);
        let yaw = g3.correction_along(e.z, rate.z, rate_error.z, hold);
        let correction = Vector3::new(roll.acceleration, pitch.acceleration, yaw.acceleration);
        (Vector3::new(roll.s, pitch.s, yaw.s), feedforward + correction)
    }

    /// The same by Eq. 25–27, with the exact kinematics. A separate function with arguments by value, so that the loop
    /// on the group keeps its values in registers.
    #[inline(never)]
    fn on_euler_angles(
        &mut self,
        attitude: UnitQuaternion<f32>,
        body_rates: Vector3<f32>,
        target: AttitudeTarget,
        hold: bool,
    ) -> (Vector3<f32>, Vector3<f32>) {
        let target = EulerReference::of_target(&target);
        let euler = Euler::from_quaternion(&attitude);
        let rates = euler.rates(&body_rates);
        let wanted = euler_demand(&mut self.axes, &target, &euler.angles(), &rates, hold);
        (wanted.s, euler.body_acceleration(&rates, &wanted.acceleration))
    }
}

impl AttitudeLaw for SlidingAttitude {
    #[expect(
        clippy::inline_always,
        reason = "measured: called, its demand goes through memory, 5 % of a simulated tick"
    )]
    #[inline(always)]
    fn step(&mut self, input: &AttitudeInput) -> AttitudeDemand {
        let (s, mut acceleration) = match self.form {
            AttitudeForm::Group => self.on_group(input),
            AttitudeForm::Euler => self.on_euler_angles(*input.attitude, *input.rates, *input.target, input.saturated),
        };
        let holding = holding_torque(&self.airframe, input.rates, input.rotors.spin_rad_s);
        if let Some(observer) = &mut self.observer {
            acceleration -=
                observer.estimate(input.rates, &(input.rotors.torque - holding).component_mul(&self.inverse_inertia));
        }
        let inertia = Vector3::from(self.airframe.inertia_kg_m2);
        AttitudeDemand { s, torque: holding + inertia.component_mul(&acceleration) }
    }

    fn state(&self) -> LawState {
        let [x, y, z] = &self.axes;
        LawState {
            reaching: Vector3::new(x.reaching(), y.reaching(), z.reaching()),
            disturbance: self.observer.as_ref().map_or_else(Vector3::zeros, DisturbanceObserver::disturbance),
        }
    }

    fn reset(&mut self) {
        self.axes.iter_mut().for_each(SlidingAxis::reset);
        if let Some(observer) = &mut self.observer {
            observer.reset();
        }
    }

    #[inline(never)]
    fn retune(&mut self, change: &Change) {
        if !change.apply_to(&mut self.gains, Place::attitude) {
            return;
        }
        for (axis, gains) in self.axes.iter_mut().zip(&self.gains.axes) {
            axis.retune(gains);
        }
        self.form = self.gains.form;
        DisturbanceObserver::retune(&mut self.observer, &self.gains.observer, TICK_S);
    }
}

/// Sliding variables s1..s3 and the demanded angular acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EulerDemand {
    /// s1, s2, s3 (Eq. 18–20), rad/s.
    pub s: Vector3<f32>,
    /// `η̈d + λ ė + u_r(s)`, rad/s².
    pub acceleration: Vector3<f32>,
}

/// The terms inside the brackets of Eq. 25–27 that do not depend on the model: `η̈d + λ ė + u_r(s)`. `hold` as in
/// [`SlidingAxis::correction`].
#[inline]
pub fn euler_demand(
    axes: &mut [SlidingAxis; 3],
    reference: &EulerReference,
    angles: &Vector3<f32>,
    rates: &Vector3<f32>,
    hold: bool,
) -> EulerDemand {
    let error = (reference.angles - angles).map(math::wrap_angle);
    let error_rate = reference.rates - rates;
    let [g1, g2, g3] = axes;
    let roll = g1.correction(error.x, error_rate.x, hold);
    let pitch = g2.correction(error.y, error_rate.y, hold);
    let yaw = g3.correction(error.z, error_rate.z, hold);
    EulerDemand {
        s: Vector3::new(roll.s, pitch.s, yaw.s),
        acceleration: reference.accelerations + Vector3::new(roll.acceleration, pitch.acceleration, yaw.acceleration),
    }
}

/// Torques U2..U4 that give the body the acceleration Ω̇ at rates Ω, `spin` being Ωr of the rotors' speeds:
/// `τ = I Ω̇ + Ω × IΩ + Ω × (0, 0, Jr Ωr) + (k4 p|p|, k5 q|q|, k6 r|r|)`.
///
/// With Ω = η̇ these are Eq. 25–27 as printed: `U2 = Ix[φ̈ − c1 θ̇ψ̇ − c2 φ̇|φ̇| − c3 Ωr θ̇]` and so on.
#[inline]
pub fn torque(airframe: &Airframe, acceleration: &Vector3<f32>, rates: &Vector3<f32>, spin: f32) -> Vector3<f32> {
    let inertia = Vector3::from(airframe.inertia_kg_m2);
    holding_torque(airframe, rates, spin) + inertia.component_mul(acceleration)
}

/// The terms of [`torque`] that keep the rates constant, against gyroscopic effects and drag.
#[inline]
fn holding_torque(airframe: &Airframe, rates: &Vector3<f32>, spin: f32) -> Vector3<f32> {
    let [ix, iy, iz] = airframe.inertia_kg_m2;
    let [k4, k5, k6] = airframe.rotational_drag_n_m_s2;
    let (p, q, r) = (rates.x, rates.y, rates.z);
    let gyroscopic = airframe.rotor_inertia_kg_m2 * spin;
    Vector3::new(
        k4 * p * math::abs(p) - ((iy - iz) * r - gyroscopic) * q,
        k5 * q * math::abs(q) - ((iz - ix) * r + gyroscopic) * p,
        k6 * r * math::abs(r) - (ix - iy) * p * q,
    )
}
