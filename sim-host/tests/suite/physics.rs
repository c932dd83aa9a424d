//! The plants against physics that does not depend on them: closed forms, conservation laws, orders of convergence,
//! and each other where they must agree.

use nalgebra::{Matrix4, Quaternion, UnitQuaternion, Vector3, Vector4};
use sim_host::plant::ground::Ground;
use sim_host::plant::paper::{PaperInput, PaperPlant, PaperState};
use sim_host::plant::rigid_body::RigidBody;
use sim_host::plant::{Constants, Motion, Plant, Push};

type V = Vector3<f64>;

const STILL: Push = Push { acceleration: V::new(0.0, 0.0, 0.0), angular_acceleration: V::new(0.0, 0.0, 0.0) };
const MS: f64 = 1e-3;

/// Table 2, written out here once more.
fn table_2() -> Constants {
    let (b, d, l) = (29.8e-4, 33e-6, 0.350);
    #[rustfmt::skip]
    let geometry = Matrix4::new(
        b,      b,      b,     b,
        0.0,    -l * b, 0.0,   l * b,
        -l * b, 0.0,    l * b, 0.0,
        d,      -d,     d,     -d,
    );
    Constants {
        mass: 0.823,
        inertia: V::new(0.5e-2, 0.5e-2, 0.1e-2),
        rotor_inertia: 28.4e-4,
        drag: V::repeat(0.3729),
        rotational_drag: V::repeat(0.0556),
        gravity: 9.81,
        geometry,
        spin: Vector4::new(-1.0, 1.0, -1.0, 1.0),
        rotor_lag: 0.0,
        spin_up_reaction: false,
    }
}

/// Nothing acts but the rotors' spin: no thrust, no drag, no gravity. All three moments of inertia differ.
fn free() -> Constants {
    Constants {
        inertia: V::new(0.5e-2, 0.4e-2, 0.1e-2),
        drag: V::zeros(),
        rotational_drag: V::zeros(),
        gravity: 0.0,
        geometry: Matrix4::zeros(),
        ..table_2()
    }
}

fn hover_speed(c: &Constants) -> f64 {
    (c.mass * c.gravity / (4.0 * 29.8e-4)).sqrt()
}

fn fly(plant: &mut impl Plant, command: &[f64; 4], steps: usize, h: f64) {
    for _ in 0..steps {
        plant.step(command, &STILL, h);
    }
}

fn tumbling() -> Motion {
    Motion {
        position: V::zeros(),
        velocity: V::new(1.0, -2.0, 0.5),
        attitude: *UnitQuaternion::from_euler_angles(0.4, -0.7, 1.9).quaternion(),
        rates: V::new(3.0, -4.0, 5.0),
    }
}

/// Angular momentum in the world: R (I Ω + [0, 0, Jr Σ spins]), spins counted about +z. Rotors 1 and 3 push the body
/// towards +ψ, so they are driven clockwise seen from above and spin negatively: Σ = −ω1 + ω2 − ω3 + ω4.
fn momentum(c: &Constants, motion: &Motion, [w1, w2, w3, w4]: [f64; 4]) -> V {
    let rotors = c.rotor_inertia * (-w1 + w2 - w3 + w4);
    let body = c.inertia.component_mul(&motion.rates) + V::new(0.0, 0.0, rotors);
    UnitQuaternion::new_normalize(motion.attitude) * body
}

fn rotation_energy(c: &Constants, motion: &Motion) -> f64 {
    0.5 * motion.rates.dot(&c.inertia.component_mul(&motion.rates))
}

#[test]
fn a_free_body_with_turning_rotors_keeps_angular_momentum_and_energy() {
    let c = free();
    // Far from balanced, so that a wrong sign of Ωr would turn the momentum at once: Jr Ωr = 0.12, I Ω = 0.02 N m s.
    let omega = [10.0, 40.0, 15.0, 28.0];
    let mut plant = RigidBody::new(c.clone(), None, V::zeros()).with_state(tumbling(), Vector4::from(omega));
    let (momentum_0, energy_0) = (momentum(&c, &tumbling(), omega), rotation_energy(&c, &tumbling()));
    for _ in 0..5_000 {
        plant.step(&omega, &STILL, MS);
        let motion = plant.motion();
        // RK4 at 1 ms: rates turn at 24 rad/s by the rotors, local error (0.024)⁵/120 = 7e-11, 5000 steps.
        assert!((momentum(&c, &motion, omega) - momentum_0).norm() < 1e-6 * momentum_0.norm());
        assert!((rotation_energy(&c, &motion) - energy_0).abs() < 1e-6 * energy_0);
        assert!((motion.velocity - tumbling().velocity).norm() < 1e-14, "nothing pushes it");
    }
    assert!((plant.motion().rates - tumbling().rates).norm() > 1.0, "it did tumble");
}

#[test]
fn spinning_the_rotors_up_keeps_the_total_angular_momentum() {
    // No air: whatever the rotors gain about z the body loses.
    let c = Constants { rotor_lag: 0.05, spin_up_reaction: true, ..free() };
    let start = [5.0, 6.0, 7.0, 8.0];
    let mut plant = RigidBody::new(c.clone(), None, V::zeros()).with_state(tumbling(), Vector4::from(start));
    let before = momentum(&c, &tumbling(), start);
    let command = [30.0, 10.0, 25.0, 12.0];
    fly(&mut plant, &command, 2_000, 0.1 * MS);
    let omega = plant.omega_during(&command);
    assert!((omega[0] - 30.0).abs() < 1.0, "spun up");
    let after = momentum(&c, &plant.motion(), omega);
    // The reaction is exact in the lag's closed form; what is left is RK4's error: the body reaches 100 rad/s, so
    // (0.01)⁵/120 = 1e-12 a step.
    assert!((after - before).norm() < 1e-6 * before.norm(), "{before} {after}");
}

#[test]
fn a_level_body_that_spins_its_rotors_up_turns_the_other_way() {
    let c = Constants { rotor_lag: 0.05, spin_up_reaction: true, ..free() };
    let mut plant =
        RigidBody::new(c.clone(), None, V::zeros()).with_state(Motion::at_rest(V::zeros()), Vector4::zeros());
    fly(&mut plant, &[20.0, 0.0, 20.0, 0.0], 1000, MS);
    // Iz r = −Jr Ωr = +2·20 Jr (rotors 1 and 3 spin negatively); e^(−20) is left of the lag.
    let exact = 40.0 * c.rotor_inertia / c.inertia.z;
    assert!((plant.motion().rates.z - exact).abs() < 1e-6 * exact, "{}", plant.motion().rates.z);
}

/// Position and attitude after 0.4 s of a hard manoeuvre with every smooth term of the model in use: quadratic drag has
/// a kink where a rate changes its sign, and its own test.
fn manoeuvre(lag: f64, h: f64) -> (V, Quaternion<f64>) {
    let c = Constants {
        rotor_lag: lag,
        spin_up_reaction: lag > 0.0,
        inertia: free().inertia,
        rotational_drag: V::zeros(),
        ..table_2()
    };
    let omega = Vector4::new(20.0, 22.0, 24.0, 21.0);
    let mut plant = RigidBody::new(c, None, V::zeros()).with_state(tumbling(), omega);
    fly(&mut plant, &[25.0, 25.4, 26.3, 26.1], (0.4 / h).round() as usize, h);
    (plant.motion().position, plant.motion().attitude)
}

#[test]
fn rk4_converges_at_fourth_order() {
    for lag in [0.0, 0.1] {
        let (fine_p, fine_q) = manoeuvre(lag, 0.4 / 16_384.0);
        let error = |h: f64| {
            let (p, q) = manoeuvre(lag, h);
            (p - fine_p).norm() + (q - fine_q).norm()
        };
        let (coarse, half) = (error(0.4 / 256.0), error(0.4 / 512.0));
        // 2⁴ = 16; the next order changes the ratio by a few per cent at these steps.
        assert!((14.0..18.0).contains(&(coarse / half)), "lag {lag}: {coarse} / {half} = {}", coarse / half);
    }
}

#[test]
fn free_fall_has_its_closed_form() {
    let c = Constants { geometry: Matrix4::zeros(), ..table_2() };
    let (v0, k) = (V::new(3.0, -2.0, 1.0), 0.3729 / 0.823);
    let motion = Motion { velocity: v0, ..Motion::at_rest(V::new(0.0, 0.0, 100.0)) };
    let mut plant = RigidBody::new(c.clone(), None, V::zeros()).with_state(motion, Vector4::zeros());
    let state = PaperState { velocity: v0, ..PaperState::at_rest(V::new(0.0, 0.0, 100.0)) };
    let mut paper = PaperPlant::new(c, V::zeros()).with_state(state);
    fly(&mut plant, &[0.0; 4], 3_000, MS);
    fly(&mut paper, &[0.0; 4], 3_000, MS);
    // v = (v0 − v∞) e^(−kt) + v∞ with v∞ = −g/k, and its integral.
    let (t, terminal) = (3.0, V::new(0.0, 0.0, -9.81 / k));
    let decay = (-k * t).exp();
    let velocity = (v0 - terminal) * decay + terminal;
    let position = V::new(0.0, 0.0, 100.0) + (v0 - terminal) * ((1.0 - decay) / k) + terminal * t;
    for motion in [plant.motion(), paper.motion()] {
        // RK4's error is (k h)⁵ a step, far below the rounding of 3000 additions at 100 m.
        assert!((motion.velocity - velocity).norm() < 1e-11, "{}", motion.velocity);
        assert!((motion.position - position).norm() < 1e-10, "{}", motion.position);
    }
}

#[test]
fn a_spinning_body_slows_down_by_quadratic_drag() {
    // Iz ṙ = −k6 r|r|: r = r0/(1 + k6 r0 t/Iz), either way round.
    for r0 in [6.0, -6.0_f64] {
        let c = Constants { geometry: Matrix4::zeros(), gravity: 0.0, ..table_2() };
        let motion = Motion { rates: V::new(0.0, 0.0, r0), ..Motion::at_rest(V::zeros()) };
        let mut plant = RigidBody::new(c, None, V::zeros()).with_state(motion, Vector4::zeros());
        fly(&mut plant, &[0.0; 4], 500, MS);
        let exact = r0 / (1.0 + 0.0556 * r0.abs() * 0.5 / 0.1e-2);
        // Rate k6 r0/Iz = 334/s against 1 ms steps: RK4's local error is (0.33)⁵/120 at first, then fades.
        assert!((plant.motion().rates.z - exact).abs() < 1e-4 * exact.abs(), "{} {exact}", plant.motion().rates.z);
    }
}

#[test]
fn rotors_lag_by_their_closed_form() {
    let c = Constants { rotor_lag: 0.02, ..table_2() };
    let mut plant = RigidBody::new(c, None, V::zeros()).with_state(Motion::at_rest(V::zeros()), Vector4::repeat(10.0));
    let command = [30.0, 20.0, 10.0, 0.0];
    for step in 1..=100 {
        plant.step(&command, &STILL, MS);
        let decay = (-f64::from(step) * MS / 0.02).exp();
        for (omega, target) in plant.omega_during(&command).into_iter().zip(command) {
            assert!((omega - (target + (10.0 - target) * decay)).abs() < 1e-12);
        }
    }
}

#[test]
fn hover_is_an_equilibrium_of_both_plants() {
    let c = table_2();
    let hover = [hover_speed(&c); 4];
    let at = V::new(1.0, 2.0, 3.0);
    let mut rigid = RigidBody::new(c.clone(), None, at);
    let mut paper = PaperPlant::new(c.clone(), at);
    let mut lagging = RigidBody::new(Constants { rotor_lag: 0.02, ..c }, None, at);
    fly(&mut rigid, &hover, 10_000, MS);
    fly(&mut paper, &hover, 10_000, MS);
    fly(&mut lagging, &hover, 10_000, MS);
    for motion in [rigid.motion(), paper.motion(), lagging.motion()] {
        // Rounding of m·g at 2e-15 m/s² over 10 s.
        assert!((motion.position - at).norm() < 1e-11 && motion.rates.norm() < 1e-11, "{motion:?}");
    }
}

/// Largest difference in attitude and position between the plants after 0.3 s from angles and torques of order `size`.
fn plants_differ(size: f64) -> f64 {
    let c = table_2();
    let hover = hover_speed(&c);
    let state = PaperState {
        angles: V::new(0.9, -0.8, 0.7) * size,
        angle_rates: V::new(0.5, 0.6, -0.7) * size,
        velocity: V::new(1.0, 2.0, -0.5) * size,
        position: V::zeros(),
    };
    let mut paper = PaperPlant::new(c.clone(), V::zeros()).with_state(state);
    let mut rigid = RigidBody::new(c, None, V::zeros()).with_state(paper.motion(), Vector4::repeat(hover));
    let lean = [0.02, -0.01, -0.01, 0.015].map(|part| hover * (1.0 + part * size));
    fly(&mut paper, &lean, 300, MS);
    fly(&mut rigid, &lean, 300, MS);
    let (a, b) = (paper.motion(), rigid.motion());
    let turn = UnitQuaternion::new_normalize(a.attitude).angle_to(&UnitQuaternion::new_normalize(b.attitude));
    turn.max((a.position - b.position).norm())
}

#[test]
fn the_plants_agree_for_small_angles_to_second_order() {
    // φ̇ ≈ p leaves out products of an angle and a rate: half the angles, a quarter of the difference.
    let differences = [0.08, 0.04, 0.02, 0.01].map(plants_differ);
    for pair in differences.windows(2) {
        assert!((3.6..4.4).contains(&(pair[0] / pair[1])), "{differences:?}");
    }
    // Of the order of size² itself: 0.08² = 6.4e-3.
    assert!(differences[0] < 6.4e-3 && differences[0] > 1e-6, "{differences:?}");
}

#[test]
fn eq_2_has_the_signs_of_the_errata() {
    // By hand, for φ̇ = 2, θ̇ = −3, ψ̇ = 5, Ωr = 10, with U2 = 0.1, U3 = 0.2, U4 = −0.3 and drag 0.0556:
    let state = PaperState {
        angle_rates: V::new(2.0, -3.0, 5.0),
        velocity: V::new(1.0, -2.0, 3.0),
        ..PaperState::at_rest(V::zeros())
    };
    let input = PaperInput { force: V::new(1.0, 2.0, 12.0), torque: V::new(0.1, 0.2, -0.3), spin: 10.0 };
    let d = table_2().paper_derivative(&state, &input, &STILL);
    let roll = (0.1 - 0.0556 * 4.0 + 28.4e-4 * 30.0 + (0.5e-2 - 0.1e-2) * -15.0) / 0.5e-2;
    let pitch = (0.2 + 0.0556 * 9.0 + 28.4e-4 * 20.0 + (0.1e-2 - 0.5e-2) * 10.0) / 0.5e-2;
    let yaw = (-0.3 - 0.0556 * 25.0) / 0.1e-2;
    assert!((d.angle_rates - V::new(roll, pitch, yaw)).norm() < 1e-9, "{}", d.angle_rates);
    let k = 0.3729 / 0.823;
    assert!((d.velocity - V::new(1.0 - k, 2.0 + 2.0 * k, 12.0 - 3.0 * k - 9.81)).norm() < 1e-12, "{}", d.velocity);
}

#[test]
fn thrust_acts_along_the_bodys_axis_as_eq_9_says() {
    // Ux = cφ sθ cψ + sφ sψ, Uy = cφ sθ sψ − sφ cψ, cφ cθ: from one step of both plants at rest.
    let (angles, h) = (V::new(0.3, -0.4, 1.2), 1e-6);
    let state = PaperState { angles, ..PaperState::at_rest(V::zeros()) };
    let mut paper = PaperPlant::new(table_2(), V::zeros()).with_state(state);
    let mut rigid = RigidBody::new(table_2(), None, V::zeros()).with_state(paper.motion(), Vector4::repeat(30.0));
    fly(&mut paper, &[30.0; 4], 1, h);
    fly(&mut rigid, &[30.0; 4], 1, h);
    let ((sr, cr), (sp, cp), (sy, cy)) = (angles.x.sin_cos(), angles.y.sin_cos(), angles.z.sin_cos());
    let thrust = 4.0 * 29.8e-4 * 900.0 / 0.823;
    let exact = V::new(cr * sp * cy + sr * sy, cr * sp * sy - sr * cy, cr * cp) * thrust - V::new(0.0, 0.0, 9.81);
    for motion in [paper.motion(), rigid.motion()] {
        // Drag after a microsecond: k·a·h/2 = 3e-6 m/s².
        assert!((motion.velocity / h - exact).norm() < 1e-5, "{}", motion.velocity / h);
    }
}

#[test]
fn each_rotor_turns_the_body_its_own_way() {
    // One rotor a little faster than hover: 1 (front) pitches the nose up (q < 0), 2 (right) rolls left side down
    // (p < 0), 3 and 4 the opposite; 1 and 3 yaw towards +ψ.
    for (rotor, (p, q, r)) in
        [(0.0, -1.0, 1.0), (-1.0, 0.0, -1.0), (0.0, 1.0, 1.0), (1.0, 0.0, -1.0)].into_iter().enumerate()
    {
        let c = Constants { rotor_inertia: 0.0, ..table_2() };
        let mut command = [hover_speed(&c); 4];
        command[rotor] += 1.0;
        let mut plant = RigidBody::new(c, None, V::zeros());
        fly(&mut plant, &command, 1, MS);
        // Coupling through the rates adds up to their product, 1e-8; the rates themselves are above 1e-3.
        let sign = |v: f64| if v.abs() < 1e-6 { 0.0 } else { v.signum() };
        assert_eq!(plant.motion().rates.map(sign), V::new(p, q, r), "rotor {}", rotor + 1);
    }
}

fn energy(c: &Constants, motion: &Motion) -> f64 {
    c.mass * (0.5 * motion.velocity.norm_squared() + c.gravity * motion.position.z) + rotation_energy(c, motion)
}

fn standing(motion: Motion) -> RigidBody {
    let c = table_2();
    let ground = Ground::for_vehicle(0.0, c.mass, c.gravity, c.inertia.z);
    RigidBody::new(c, Some(ground), V::zeros()).with_state(motion, Vector4::zeros())
}

#[test]
fn what_is_dropped_comes_to_rest_without_gaining_energy() {
    for (roll, pitch) in [(0.0, 0.0), (0.2, -0.1), (0.0, 0.4)] {
        let attitude = *UnitQuaternion::from_euler_angles(roll, pitch, 0.5).quaternion();
        let mut plant = standing(Motion { attitude, ..Motion::at_rest(V::new(0.0, 0.0, 0.5)) });
        let c = plant.constants().clone();
        let start = energy(&c, &plant.motion());
        let mut lowest = f64::INFINITY;
        for _ in 0..10_000 {
            plant.step(&[0.0; 4], &STILL, MS);
            // The spring holds some of it for a moment, never more than there was.
            assert!(energy(&c, &plant.motion()) < start * 1.001, "{:?}", plant.motion());
            lowest = lowest.min(plant.motion().position.z);
        }
        let end = plant.motion();
        assert!(end.velocity.norm() < 1e-6 && end.rates.norm() < 1e-6, "at rest: {end:?}");
        // m g = 4 k x at rest, by the ground's own choice of k: 1 mm.
        assert!((end.position.z + 1e-3).abs() < 1e-6, "{}", end.position.z);
        // v = √(2 g 0.5 m) = 3.1 m/s onto a spring of √(g/1 mm) = 99 rad/s: at most v/99 = 3 cm without damping; tilted
        // by 0.4 rad, one foot of four takes the first blow.
        assert!(lowest > -0.06, "sank to {lowest}");
    }
}

#[test]
fn friction_stops_a_slide_and_holds_against_a_push() {
    let mut plant = standing(Motion { velocity: V::new(1.0, 0.0, 0.0), ..Motion::at_rest(V::new(0.0, 0.0, -1e-3)) });
    fly(&mut plant, &[0.0; 4], 3_000, MS);
    let slid = plant.motion().position;
    // v²/(2 μ g) = 0.073 m for μ = 0.7, less what linear drag takes; the feet are in the plane of the centre of mass.
    assert!((0.065..0.08).contains(&slid.x) && slid.y.abs() < 1e-6, "{slid}");
    let push = Push { acceleration: V::new(0.5 * 0.7 * 9.81, 0.0, 0.0), ..STILL };
    for _ in 0..1_000 {
        plant.step(&[0.0; 4], &push, MS);
    }
    // Half of what friction can hold: it creeps at half of the 2 cm/s below which Coulomb's law is made smooth.
    assert!((plant.motion().position.x - slid.x) < 0.0105, "{}", plant.motion().position);
    let push = Push { acceleration: V::new(1.5 * 0.7 * 9.81, 0.0, 0.0), ..STILL };
    for _ in 0..1_000 {
        plant.step(&[0.0; 4], &push, MS);
    }
    assert!(plant.motion().velocity.x > 2.0, "half as much again as friction holds moves it");
}

#[test]
fn nothing_sinks_and_nothing_pulls_at_what_takes_off() {
    let mut plant = standing(Motion::at_rest(V::zeros()));
    let c = plant.constants().clone();
    let below_hover = [0.99 * hover_speed(&c); 4];
    fly(&mut plant, &below_hover, 5_000, MS);
    assert!((-1e-3..1e-4).contains(&plant.motion().position.z), "{:?}", plant.motion());
    fly(&mut plant, &[1.1 * hover_speed(&c); 4], 1_000, MS);
    // U1 = 1.21 m g: 0.21 g upwards for 1 s, less drag (k/m = 0.45/s takes about a seventh) — 0.9 m.
    assert!((0.8..1.03).contains(&plant.motion().position.z), "{:?}", plant.motion());
}
