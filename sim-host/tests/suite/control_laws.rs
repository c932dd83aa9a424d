//! Equivalent control makes ṡ = −K sw(s): the firmware's laws (f32), put into an independently written Eq. 2 (f64),
//! must give each of the six surfaces exactly its reaching law, whatever the state, the gains and the shape.

use chacha20::ChaCha8Rng;
use firmware::airframe::Airframe;
use firmware::control::attitude;
use firmware::control::euler::EulerReference;
use firmware::control::position::{self, Translation};
use firmware::control::sliding::{AxisGains, ReachingLaw, SlidingAxis};
use firmware::signals::FlatReference;
use nalgebra::Vector3;
use rand::{RngExt as _, SeedableRng as _};

type V = Vector3<f64>;

/// Eq. 2, rotation (errata: drag −k φ̇|φ̇|), Table 2: Euler accelerations under U2..U4 and Ωr.
fn eq2_rotation(rate: &V, u: &V, spin: f64) -> V {
    let (ix, iy, iz, jr, k) = (0.5e-2, 0.5e-2, 0.1e-2, 28.4e-4, 0.0556);
    let (roll, pitch, yaw) = (rate.x, rate.y, rate.z);
    V::new(
        (u.x - k * roll * roll.abs() - jr * spin * pitch + (iy - iz) * pitch * yaw) / ix,
        (u.y - k * pitch * pitch.abs() + jr * spin * roll + (iz - ix) * roll * yaw) / iy,
        (u.z - k * yaw * yaw.abs() + (ix - iy) * roll * pitch) / iz,
    )
}

/// Eq. 2, translation: accelerations under U1, Ux, Uy at roll φ and pitch θ.
fn eq2_translation(velocity: &V, (u1, ux, uy): (f64, f64, f64), (roll, pitch): (f64, f64)) -> V {
    let (m, k, g) = (0.823, 0.3729, 9.81);
    V::new(
        (ux * u1 - k * velocity.x) / m,
        (uy * u1 - k * velocity.y) / m,
        (roll.cos() * pitch.cos() * u1 - k * velocity.z - m * g) / m,
    )
}

/// sw(s) as docs/control-laws.md names it, and how far the firmware's may be from it: micromath's power is good to 12 %, the
/// others to f32 rounding (s/ρ to 2e-7 of itself, up to |s/ρ| = 1 where it still matters for sat, tanh less).
fn sw(shape: ReachingLaw, s: f64) -> (f64, f64) {
    match shape {
        ReachingLaw::Sgn => (s.signum(), 0.0),
        ReachingLaw::Sat { rho } => ((s / f64::from(rho)).clamp(-1.0, 1.0), 1e-6),
        ReachingLaw::Tanh { rho } => ((s / f64::from(rho)).tanh(), 1e-6),
        ReachingLaw::Power { alpha } => {
            let value = s.signum() * s.abs().powf(f64::from(alpha));
            (value, 0.12 * value.abs())
        }
        _ => unreachable!("not one of the paper's"),
    }
}

fn axes(gains: &[AxisGains; 3]) -> [SlidingAxis; 3] {
    gains.map(|gains| SlidingAxis::new(&gains, 1e-3))
}

struct Draw(ChaCha8Rng);

impl Draw {
    fn number(&mut self, low: f32, high: f32) -> f32 {
        self.0.random_range(low..high)
    }

    fn vector(&mut self, size: f32) -> Vector3<f32> {
        Vector3::from_fn(|_, _| self.number(-size, size))
    }

    fn gains(&mut self) -> AxisGains {
        let rho = self.number(0.001, 3.0);
        let reaching = match self.0.random_range(0..4) {
            0 => ReachingLaw::Sgn,
            1 => ReachingLaw::Sat { rho },
            2 => ReachingLaw::Tanh { rho },
            _ => ReachingLaw::Power { alpha: self.number(0.2, 0.95) },
        };
        AxisGains::new(self.number(1.0, 350.0), self.number(0.5, 30.0), reaching)
    }
}

/// ṡ = λ ė + (reference's second derivative − plant's) must be −K sw(s).
///
/// `scale` is the largest term in the sum (rad/s² or m/s²): f32 rounds each of about ten operations at 6e-8 of it;
/// s itself is rounded at 1.2e-7 of its terms, which the layer's slope K/ρ magnifies.
fn assert_reaching(gains: &AxisGains, e: f64, e_rate: f64, s_rate: f64, scale: f64) {
    let s = f64::from(gains.lambda) * e + e_rate;
    let (shape, shape_error) = sw(gains.reaching, s);
    let gain = f64::from(gains.gain);
    let s_rounding = 3e-7 * (f64::from(gains.lambda) * e.abs() + e_rate.abs());
    let slope = match gains.reaching {
        ReachingLaw::Sat { rho } | ReachingLaw::Tanh { rho } => gain / f64::from(rho),
        _ => 0.0,
    };
    let bound = 2e-6 * (scale + gain) + gain * shape_error + slope * s_rounding;
    let error = s_rate + gain * shape;
    assert!(error.abs() < bound, "{gains:?} at s = {s}: ṡ = {s_rate}, −K sw(s) = {}, bound {bound}", -gain * shape);
}

#[test]
fn eq_25_to_27_make_each_attitude_surface_reach_by_its_law() {
    let mut draw = Draw(ChaCha8Rng::seed_from_u64(25));
    for _ in 0..20_000 {
        let gains = [draw.gains(), draw.gains(), draw.gains()];
        let (angles, rates, spin) = (draw.vector(0.7), draw.vector(6.0), draw.number(-60.0, 60.0));
        let reference =
            EulerReference { angles: draw.vector(0.7), rates: draw.vector(6.0), accelerations: draw.vector(100.0) };
        let demand = attitude::euler_demand(&mut axes(&gains), &reference, &angles, &rates, false);
        let u = attitude::torque(&Airframe::paper(2.0), &demand.acceleration, &rates, spin);
        let acceleration = eq2_rotation(&rates.cast(), &u.cast(), f64::from(spin));
        for i in 0..3 {
            let e = f64::from(reference.angles[i]) - f64::from(angles[i]);
            let e_rate = f64::from(reference.rates[i]) - f64::from(rates[i]);
            let s_rate = f64::from(gains[i].lambda) * e_rate + f64::from(reference.accelerations[i]) - acceleration[i];
            // Drag on yaw, k6·36/Iz, is 2000 rad/s²; gyroscopic torque, Jr·60·6/Ix, 200.
            assert_reaching(&gains[i], e, e_rate, s_rate, 2500.0);
            assert!((f64::from(demand.s[i]) - (f64::from(gains[i].lambda) * e + e_rate)).abs() < 1e-4);
        }
    }
}

#[test]
fn eq_28_30_31_make_each_position_surface_reach_by_its_law() {
    let mut draw = Draw(ChaCha8Rng::seed_from_u64(28));
    for _ in 0..20_000 {
        let gains = [draw.gains(), draw.gains(), draw.gains()];
        let (position, velocity, tilt) = (draw.vector(10.0), draw.vector(10.0), draw.vector(1.2));
        let mut reference = FlatReference::standing(draw.vector(10.0), 0.0);
        (reference.velocity, reference.acceleration) = (draw.vector(10.0), draw.vector(20.0));

        let airframe = Airframe::paper(2.0);
        let demand =
            position::demand(&mut axes(&gains), &Translation::new(&airframe), &reference, &position, &velocity, false);
        let (u1, ux, uy) = position::paper_inputs(&airframe, &demand.force, tilt.x.cos(), tilt.y.cos());
        if u1.abs() < 1e-3 {
            continue; // Ux and Uy are not defined without thrust.
        }
        let inputs = (f64::from(u1), f64::from(ux), f64::from(uy));
        let acceleration = eq2_translation(&velocity.cast(), inputs, (f64::from(tilt.x), f64::from(tilt.y)));
        for i in 0..3 {
            let e = f64::from(reference.position[i]) - f64::from(position[i]);
            let e_rate = f64::from(reference.velocity[i]) - f64::from(velocity[i]);
            let s_rate = f64::from(gains[i].lambda) * e_rate + f64::from(reference.acceleration[i]) - acceleration[i];
            // λ ė is at most 30·20 m/s²; K is added by the bound, and |s|^α by the power law.
            let scale = 700.0 + f64::from(gains[i].gain) * f64::from(demand.s[i]).abs().powf(0.95);
            assert_reaching(&gains[i], e, e_rate, s_rate, scale);
        }
    }
}

#[test]
fn sliding_reaches_zero_in_the_time_that_the_law_promises() {
    // Eq. 16 with sgn: |s| falls at K, so s0 = K/4 takes 0.25 s; then e decays as e^(−λt). Integrated here by Euler
    // steps of 10 µs on roll, with the law and the plant of the other tests.
    let mut axes = axes(&[AxisGains::new(40.0, 5.0, ReachingLaw::Sgn); 3]);
    let (mut angle, mut rate, h) = (V::new(-2.0, 0.0, 0.0), V::zeros(), 1e-5);
    let mut crossed = None;
    let target = EulerReference { angles: Vector3::zeros(), rates: Vector3::zeros(), accelerations: Vector3::zeros() };
    for step in 0..50_000 {
        let demand = attitude::euler_demand(&mut axes, &target, &angle.cast(), &rate.cast(), false);
        if demand.s.x <= 0.0 {
            crossed.get_or_insert(f64::from(step) * h);
        }
        let u = attitude::torque(&Airframe::paper(2.0), &demand.acceleration, &rate.cast(), 0.0);
        let acceleration = eq2_rotation(&rate, &u.cast(), 0.0);
        angle += rate * h;
        rate += acceleration * h;
    }
    let reached = crossed.expect("the surface is reached");
    // 10 µs steps: the first crossing comes within a few of them.
    assert!((reached - 0.25).abs() < 2e-4, "{reached}");
    // On the surface from t = 0.25 s: φ(0.5) = φ(0.25) e^(−5·0.25); φ(0.25) solves ė = s − λ e with s = 10 − 40 t.
    let (lambda, s0, k, t) = (5.0_f64, 10.0, 40.0, 0.25);
    let a = s0 / lambda + k / (lambda * lambda);
    let at_reach = a - k / lambda * t + (2.0 - a) * (-lambda * t).exp();
    let end = -at_reach * (-lambda * 0.25).exp();
    // Chatter of one step, K h² λ⁻¹, is far below this; Euler's error is of order h.
    assert!((angle.x - end).abs() < 1e-4, "{} {end}", angle.x);
}
