//! Geometric tracking control on SE(3): Lee, Leok and McClamroch (CDC 2010, arXiv:1003.2005), with the integrals of
//! Goodarzi, Lee and Lee (ECC 2013, arXiv:1304.6765).
//!
//! ```text
//! eR = ½ (RdᵀR − RᵀRd)^∨    eΩ = Ω − RᵀRd Ωd
//! f = kx (xd − x) + kv (vd − v) + ki sat(∫) + g e3 + ẍd
//! M = J (−kR eR − kΩ eΩ − kI sat(∫)) + Ω × JΩ − J (Ω̂ RᵀRd Ωd − RᵀRd Ω̇d)
//! ```
//!
//! The derivatives of Rd follow from those of f: the reference's jerk and snap, and the errors' derivatives with the
//! acceleration that the model gives and its difference from job to job. Like these papers, the law has no drag model:
//! the integral compensates what it can. The thrust is f along the body's axis, which the partition computes.

use anyhow::Result;
use firmware::airframe::Airframe;
use firmware::control::flatness::ForceProfile;
use firmware::control::law::{AttitudeDemand, AttitudeInput, AttitudeLaw, PositionDemand, PositionInput, PositionLaw};
use firmware::math;
use firmware::signals::{AttitudeTarget, TICK_S};
use nalgebra::{UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::filter::Difference;
use super::{AxisPair, OUTER_STEP_S, clamp_each, require_tilt};

/// Gains of both laws, as written in a tuning file.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Geometric {
    /// Greatest tilt that position control demands, rad.
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
    /// Checks that the laws are defined for these gains.
    ///
    /// # Errors
    /// The first key that is out of range.
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

/// An integral with a bounded contribution, in the units of the sum it is added to.
#[derive(Clone, Debug)]
struct BoundedIntegral {
    gain: Vector3<f32>,
    per_step: Vector3<f32>,
    most: Vector3<f32>,
    value: Vector3<f32>,
}

impl BoundedIntegral {
    fn new(gain: AxisPair, most: AxisPair, step_s: f32) -> Self {
        let (gain, most) = (gain.vector(), most.vector());
        Self { gain, per_step: gain * step_s, most, value: Vector3::zeros() }
    }

    /// The contribution after another step, unless `hold`; and the gain with which each axis integrates, zero while it
    /// holds or is at its bound.
    fn step(&mut self, integrand: &Vector3<f32>, hold: bool) -> (Vector3<f32>, Vector3<f32>) {
        if hold {
            return (self.value, Vector3::zeros());
        }
        let free = self.value + self.per_step.component_mul(integrand);
        self.value = clamp_each(&free, &self.most);
        let moves = free.zip_map(&self.most, |free, most| if math::abs(free) <= most { 1.0 } else { 0.0 });
        (self.value, self.gain.component_mul(&moves))
    }
}

/// The position law.
#[derive(Clone, Debug)]
pub struct GeometricPosition {
    gravity: f32,
    kx: Vector3<f32>,
    kv: Vector3<f32>,
    c1: f32,
    integral: BoundedIntegral,
    jerk: Difference,
}

impl GeometricPosition {
    /// With valid gains; evaluated once per job of the outer partition.
    pub fn new(airframe: &Airframe, gains: &Geometric) -> Self {
        let (ki, most) = (gains.position_integral_1_s2, gains.position_integral_max_m_s2);
        Self {
            gravity: airframe.gravity_m_s2,
            kx: gains.position_1_s2.vector(),
            kv: gains.velocity_1_s.vector(),
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
        let integrand_rate = error_acceleration + error_rate * self.c1;
        let (integral, ki) = self.integral.step(&integrand, input.limited);
        let gravity = Vector3::new(0.0, 0.0, self.gravity);
        PositionDemand {
            s: Vector3::zeros(),
            profile: ForceProfile {
                force: reference.acceleration + gravity + value + integral,
                rate: reference.jerk + rate + ki.component_mul(&integrand),
                acceleration: reference.snap + acceleration + ki.component_mul(&integrand_rate),
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

/// eR, eΩ, and the derivative of the rate desired; all in the body frame.
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
    /// With valid gains; evaluated once per tick.
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
        let (integral, _) = self.integral.step(&(e.rate + e.rotation * self.c2), input.saturated);
        let feedback = self.kr.component_mul(&e.rotation) + self.kw.component_mul(&e.rate) + integral;
        let acceleration = e.feedforward - feedback;
        let gyroscopic = input.rates.cross(&self.inertia.component_mul(input.rates));
        AttitudeDemand { s: Vector3::zeros(), torque: self.inertia.component_mul(&acceleration) + gyroscopic }
    }

    fn reset(&mut self) {
        self.integral.value = Vector3::zeros();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::baseline::tests::{airframe, attitudes, hover_speeds, input};
    use firmware::signals::FlatReference;

    /// By hand for the x500.
    fn gains() -> Geometric {
        Geometric {
            tilt_max_rad: 1.2,
            position_1_s2: AxisPair { xy: 8.0, z: 12.0 },
            velocity_1_s: AxisPair { xy: 5.0, z: 6.0 },
            position_integral_1_s2: AxisPair { xy: 1.5, z: 3.0 },
            position_integral_c1_1_s: 1.5,
            position_integral_max_m_s2: AxisPair { xy: 4.0, z: 4.0 },
            attitude_1_s2: AxisPair { xy: 250.0, z: 12.0 },
            rate_1_s: AxisPair { xy: 25.0, z: 6.0 },
            attitude_integral_1_s2: AxisPair { xy: 20.0, z: 2.0 },
            attitude_integral_c2_1_s: 3.0,
            attitude_integral_max_rad_s2: AxisPair { xy: 40.0, z: 4.0 },
        }
    }

    fn without_integrals() -> Geometric {
        let none = AxisPair::default();
        Geometric { position_integral_1_s2: none, attitude_integral_1_s2: none, ..gains() }
    }

    #[test]
    fn the_error_is_lees() {
        let target = |attitude| AttitudeTarget { attitude, rates: Vector3::zeros(), accelerations: Vector3::zeros() };
        for (is, ought) in attitudes().zip(attitudes().skip(13)) {
            let (r, rd) = (is.to_rotation_matrix(), ought.to_rotation_matrix());
            let skew = (rd.transpose() * r).into_inner() - (r.transpose() * rd).into_inner();
            let exact = Vector3::new(skew.m32, skew.m13, skew.m21) * 0.5;
            let e = errors(&is, &Vector3::zeros(), &target(ought)).rotation;
            assert!((e - exact).norm() < 1e-5, "{e} {exact}");
        }
    }

    /// Lee's error function ½ |eΩ|² + kR Ψ, Ψ = 1 − cos of the angle left, for a kR alike about all axes.
    fn lyapunov(kr: f64, at: (&UnitQuaternion<f64>, &Vector3<f64>), to: (&UnitQuaternion<f64>, &Vector3<f64>)) -> f64 {
        let relative = at.0.inverse() * to.0;
        let psi = 2.0 * relative.imag().norm_squared();
        0.5 * (at.1 - relative * to.1).norm_squared() + kr * psi
    }

    #[test]
    fn the_error_function_falls_at_the_rate_that_lee_proves() {
        let gains = Geometric {
            attitude_1_s2: AxisPair { xy: 100.0, z: 100.0 },
            rate_1_s: AxisPair { xy: 15.0, z: 15.0 },
            ..without_integrals()
        };
        let (airframe, h) = (airframe(), 1e-5_f64);
        let inertia = Vector3::from(airframe.inertia_kg_m2).cast::<f64>();
        let speeds = hover_speeds(&airframe);
        for (i, (is, ought)) in attitudes().zip(attitudes().skip(29)).enumerate().step_by(5) {
            let t = i as f64;
            let rates = Vector3::new(3.0 * t.sin(), 4.0 * t.cos(), 1.5 * (2.0 * t).sin());
            let (to_rates, to_accelerations) = (Vector3::new(1.0, -2.0, 0.5), Vector3::new(-8.0, 5.0, 3.0));
            let target =
                AttitudeTarget { attitude: ought, rates: to_rates.cast(), accelerations: to_accelerations.cast() };
            let mut law = GeometricAttitude::new(&airframe, &gains);
            let torque = law.step(&input(&is, &rates.cast(), &target, &speeds)).torque.cast::<f64>();
            let acceleration = (torque - rates.cross(&inertia.component_mul(&rates))).component_div(&inertia);
            // Rigid-body motion and the target's, to second order in h, both ways.
            let double = |q: UnitQuaternion<f32>| UnitQuaternion::new_normalize(q.into_inner().cast::<f64>());
            let (is, ought) = (double(is), double(ought));
            let v = |h: f64| {
                let at = is * UnitQuaternion::new(rates * h + acceleration * (0.5 * h * h));
                let to = ought * UnitQuaternion::new(to_rates * h + to_accelerations * (0.5 * h * h));
                lyapunov(100.0, (&at, &(rates + acceleration * h)), (&to, &(to_rates + to_accelerations * h)))
            };
            let rate = (v(h) - v(-h)) / (2.0 * h);
            let error = rates - is.inverse() * ought * to_rates;
            let exact = -15.0 * error.norm_squared();
            // The law's f32: 1e-6 of accelerations of a few hundred, times eΩ; the differences' rounding 1e-14·V/h.
            assert!((rate - exact).abs() < 2e-3 + 1e-4 * exact.abs(), "{i}: {rate} {exact}");
        }
    }

    /// A reference and a motion that leaves it, smooth and exactly differentiable: k-th derivatives at `t`.
    fn motion(t: f64, k: i32) -> (Vector3<f32>, Vector3<f32>) {
        let wave = |w: f64, phase: f64| w.powi(k) * (w * t + phase + f64::from(k) * std::f64::consts::FRAC_PI_2).sin();
        let reference = Vector3::new(3.0 * wave(1.0, 0.0), 2.0 * wave(1.3, 0.5), wave(0.7, 1.0));
        let is = Vector3::new(2.9 * wave(1.0, 0.1), 2.0 * wave(1.3, 0.4), wave(0.8, 1.1));
        (reference.cast(), is.cast())
    }

    fn profile_at(law: &mut GeometricPosition, t: f64, limited: bool) -> ForceProfile {
        let [(r, x), (r1, v), (r2, a), (r3, _), (r4, _)] = [0, 1, 2, 3, 4].map(|k| motion(t, k));
        let standing = FlatReference::standing(r, 0.0);
        let reference = FlatReference { velocity: r1, acceleration: r2, jerk: r3, snap: r4, ..standing };
        let input = PositionInput { reference: &reference, position: &x, velocity: &v, acceleration: &a, limited };
        law.step(&input).profile
    }

    #[test]
    fn the_derivatives_of_the_force_are_its_derivatives() {
        let quick = AxisPair { xy: 6.0, z: 12.0 };
        let bounded = AxisPair { xy: 1e-3, z: 4.0 };
        let with_integrals = Geometric { position_integral_1_s2: quick, ..gains() };
        let some_at_their_bounds = Geometric { position_integral_max_m_s2: bounded, ..with_integrals };
        for (gains, limited) in [
            (without_integrals(), false),
            (with_integrals, false),
            (with_integrals, true),
            (some_at_their_bounds, false),
        ] {
            for start in [0.3, 2.0, 7.0] {
                let mut law = GeometricPosition::new(&airframe(), &gains);
                let h = f64::from(OUTER_STEP_S);
                let [_, before, now, after] =
                    [-2.0 * h, -h, 0.0, h].map(|dt| profile_at(&mut law, start + dt, limited));
                let rate = (after.force - before.force) / (2.0 * OUTER_STEP_S);
                let acceleration = (after.rate - before.rate) / (2.0 * OUTER_STEP_S);
                // f32: 2e-6 of 20 m/s² over 8 ms; the integral is a sum, half a job ahead: ki (ë + c1 ė)·2 ms = 0.03;
                // the jerk is a difference, half a job late: kv·snap·2 ms = 0.05.
                assert!((rate - now.rate).norm() < 0.04, "{rate} {}", now.rate);
                assert!((acceleration - now.acceleration).norm() < 0.1, "{acceleration} {}", now.acceleration);
            }
        }
    }

    #[test]
    fn integrals_are_bounded_and_hold_while_they_are_told_to() {
        let mut integral = BoundedIntegral::new(AxisPair { xy: 2.0, z: 1.0 }, AxisPair { xy: 0.5, z: 9.0 }, 1e-3);
        let integrand = Vector3::new(1.0, -1.0, 0.5);
        for _ in 0..100 {
            integral.step(&integrand, false);
        }
        assert!((integral.value - Vector3::new(0.2, -0.2, 0.05)).norm() < 1e-5, "{}", integral.value);
        let before = integral.value;
        assert_eq!(integral.step(&integrand, true), (before, Vector3::zeros()));
        for _ in 0..1_000 {
            integral.step(&integrand, false);
        }
        assert_eq!(integral.value.xy(), nalgebra::Vector2::new(0.5, -0.5));
        // At its bound it moves no further, and moves back at once.
        assert_eq!(integral.step(&integrand, false).1, Vector3::new(0.0, 0.0, 1.0));
        assert_eq!(integral.step(&-integrand, false).1, Vector3::new(2.0, 2.0, 1.0));
    }
}
