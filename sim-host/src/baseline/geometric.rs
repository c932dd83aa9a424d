//! Geometric tracking control on SE(3): Lee, Leok and McClamroch (CDC 2010, arXiv:1003.2005), with the integrals of
//! Goodarzi, Lee and Lee (ECC 2013, arXiv:1304.6765).
//!
//! With eR = ½ (RdᵀR − RᵀRd)^∨ and eΩ = Ω − RᵀRd Ωd,
//!
//! ```text
//! f = kx (xd − x) + kv (vd − v) + ki sat(∫) + g e3 + ẍd
//! M = J (−kR eR − kΩ eΩ − kI sat(∫)) + Ω × JΩ − J (Ω̂ RᵀRd Ωd − RᵀRd Ω̇d)
//! ```
//!
//! The derivatives of Rd follow from those of f: the reference's jerk and snap, and the errors' derivatives with the
//! acceleration that the model gives and its difference from job to job. There is no drag in these papers, and none
//! here: the integral takes of it what it can. The thrust is f along the body's axis, which the partition sees to.

use anyhow::Result;
use firmware::airframe::Airframe;
use firmware::control::flatness::ForceProfile;
use firmware::control::law::{
    AttitudeDemand, AttitudeInput, AttitudeLaw, AttitudeTarget, PositionDemand, PositionInput, PositionLaw,
};
use firmware::signals::TICK_S;
use nalgebra::{UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::filter::Difference;
use super::{AxisPair, OUTER_STEP_S, clamp_each, require_tilt};

/// Gains of both laws, as they stand in a file.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Geometric {
    /// Greatest tilt that position control asks for, rad.
    pub tilt_max_rad: f32,
    /// kx over the mass, 1/s².
    pub position_1_s2: AxisPair,
    /// kv over the mass, 1/s.
    pub velocity_1_s: AxisPair,
    /// ki over the mass, 1/s²: of ∫ (vd − v) + c1 (xd − x).
    pub position_integral_1_s2: AxisPair,
    /// c1, 1/s.
    pub position_integral_c1_1_s: f32,
    /// Bound on ki ∫, m/s².
    pub position_integral_max_m_s2: AxisPair,
    /// kR over the inertia, 1/s².
    pub attitude_1_s2: AxisPair,
    /// kΩ over the inertia, 1/s.
    pub rate_1_s: AxisPair,
    /// kI over the inertia, 1/s²: of ∫ eΩ + c2 eR.
    pub attitude_integral_1_s2: AxisPair,
    /// c2, 1/s.
    pub attitude_integral_c2_1_s: f32,
    /// Bound on kI ∫, rad/s².
    pub attitude_integral_max_rad_s2: AxisPair,
}

impl Geometric {
    /// Refuses gains with which the laws are not defined.
    ///
    /// # Errors
    /// The first key that is out of its range.
    pub fn validate(&self) -> Result<()> {
        require_tilt("geometric.tilt_max_rad", self.tilt_max_rad)?;
        let c1 = AxisPair { xy: self.position_integral_c1_1_s, z: 0.0 };
        let c2 = AxisPair { xy: self.attitude_integral_c2_1_s, z: 0.0 };
        for (key, gain) in [
            ("position_1_s2", self.position_1_s2),
            ("velocity_1_s", self.velocity_1_s),
            ("position_integral_1_s2", self.position_integral_1_s2),
            ("position_integral_c1_1_s", c1),
            ("position_integral_max_m_s2", self.position_integral_max_m_s2),
            ("attitude_1_s2", self.attitude_1_s2),
            ("rate_1_s", self.rate_1_s),
            ("attitude_integral_1_s2", self.attitude_integral_1_s2),
            ("attitude_integral_c2_1_s", c2),
            ("attitude_integral_max_rad_s2", self.attitude_integral_max_rad_s2),
        ] {
            gain.require_not_negative(&format!("geometric.{key}"))?;
        }
        Ok(())
    }
}

/// An integral whose contribution is bounded, kept in the units of what it is added to.
#[derive(Clone, Debug)]
struct BoundedIntegral {
    per_step: Vector3<f32>,
    most: Vector3<f32>,
    value: Vector3<f32>,
}

impl BoundedIntegral {
    fn new(gain: AxisPair, most: AxisPair, step_s: f32) -> Self {
        Self { per_step: gain.vector() * step_s, most: most.vector(), value: Vector3::zeros() }
    }

    /// The contribution, after another step unless it is to hold.
    fn step(&mut self, integrand: &Vector3<f32>, hold: bool) -> Vector3<f32> {
        if !hold {
            self.value = clamp_each(&(self.value + self.per_step.component_mul(integrand)), &self.most);
        }
        self.value
    }
}

/// The position law.
#[derive(Clone, Debug)]
pub struct GeometricPosition {
    gravity: f32,
    kx: Vector3<f32>,
    kv: Vector3<f32>,
    ki: Vector3<f32>,
    c1: f32,
    integral: BoundedIntegral,
    jerk: Difference,
}

impl GeometricPosition {
    /// Stepped once a job of the outer partition, with valid gains.
    pub fn new(airframe: &Airframe, gains: &Geometric) -> Self {
        let (ki, most) = (gains.position_integral_1_s2, gains.position_integral_max_m_s2);
        Self {
            gravity: airframe.gravity_m_s2,
            kx: gains.position_1_s2.vector(),
            kv: gains.velocity_1_s.vector(),
            ki: ki.vector(),
            c1: gains.position_integral_c1_1_s,
            integral: BoundedIntegral::new(ki, most, OUTER_STEP_S),
            jerk: Difference::new(OUTER_STEP_S),
        }
    }
}

impl PositionLaw for GeometricPosition {
    fn step(&mut self, input: &PositionInput) -> PositionDemand {
        let reference = input.reference;
        let error = reference.position - input.position;
        let error_rate = reference.velocity - input.velocity;
        let error_acceleration = reference.acceleration - input.acceleration;
        let error_jerk = reference.jerk - self.jerk.step(input.acceleration);
        let feedback = |e: &Vector3<f32>, rate: &Vector3<f32>| self.kx.component_mul(e) + self.kv.component_mul(rate);
        let (value, rate, acceleration) = (
            feedback(&error, &error_rate),
            feedback(&error_rate, &error_acceleration),
            feedback(&error_acceleration, &error_jerk),
        );
        let integrand = error_rate + error * self.c1;
        let integral = self.integral.step(&integrand, input.limited);
        let integral_rate = self.ki.component_mul(&integrand);
        let gravity = Vector3::new(0.0, 0.0, self.gravity);
        PositionDemand {
            s: Vector3::zeros(),
            profile: ForceProfile {
                force: reference.acceleration + gravity + value + integral,
                rate: reference.jerk + rate + integral_rate,
                acceleration: reference.snap + acceleration,
            },
        }
    }

    fn reset(&mut self) {
        self.integral.value = Vector3::zeros();
        self.jerk.reset();
    }
}

/// The attitude law.
#[derive(Clone, Debug)]
pub struct GeometricAttitude {
    inertia: Vector3<f32>,
    kr: Vector3<f32>,
    kw: Vector3<f32>,
    c2: f32,
    integral: BoundedIntegral,
}

/// eR and eΩ, RᵀRd Ωd, and the derivative of the latter; all in the body's frame.
struct Errors {
    rotation: Vector3<f32>,
    rate: Vector3<f32>,
    feedforward: Vector3<f32>,
}

/// Errors of an attitude and its rates. eR needs no matrix: for qe = q⁻¹ ⊗ qd = (w, v) it is −2 w v.
fn errors(attitude: &UnitQuaternion<f32>, rates: &Vector3<f32>, target: &AttitudeTarget) -> Errors {
    let relative = attitude.inverse() * target.attitude;
    let desired = relative * target.rates;
    Errors {
        rotation: relative.imag() * (-2.0 * relative.w),
        rate: rates - desired,
        feedforward: relative * target.accelerations - rates.cross(&desired),
    }
}

impl GeometricAttitude {
    /// Stepped once a tick, with valid gains.
    pub fn new(airframe: &Airframe, gains: &Geometric) -> Self {
        let (ki, most) = (gains.attitude_integral_1_s2, gains.attitude_integral_max_rad_s2);
        Self {
            inertia: airframe.inertia_kg_m2.into(),
            kr: gains.attitude_1_s2.vector(),
            kw: gains.rate_1_s.vector(),
            c2: gains.attitude_integral_c2_1_s,
            integral: BoundedIntegral::new(ki, most, TICK_S),
        }
    }
}

impl AttitudeLaw for GeometricAttitude {
    fn step(&mut self, input: &AttitudeInput) -> AttitudeDemand {
        let e = errors(input.attitude, input.rates, input.target);
        let integral = self.integral.step(&(e.rate + e.rotation * self.c2), input.saturated);
        let feedback = self.kr.component_mul(&e.rotation) + self.kw.component_mul(&e.rate) + integral;
        let acceleration = e.feedforward - feedback;
        let gyroscopic = input.rates.cross(&self.inertia.component_mul(input.rates));
        AttitudeDemand { s: Vector3::zeros(), torque: self.inertia.component_mul(&acceleration) + gyroscopic }
    }

    fn reset(&mut self) {
        self.integral.value = Vector3::zeros();
    }
}
