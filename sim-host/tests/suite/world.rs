//! What a scenario's world does to a flight, against closed forms: truth, delay, wind, and the motion at the start.

use firmware::inner::InnerOutput;
use firmware::outer::OuterOutput;
use nalgebra::{UnitQuaternion, Vector3, Vector4};
use sim_host::flight;
use sim_host::noise::Noise;
use sim_host::plant::rigid_body::RigidBody;
use sim_host::plant::{Constants, Motion, Plant, Push};
use sim_host::record::Row;
use sim_host::reference;
use sim_host::scenario::Scenario;
use sim_host::sil::Flight;

use crate::common::load::load;

type V = Vector3<f64>;

const MS: f64 = 1e-3;

fn ready(scenario: &Scenario) -> Flight<RigidBody> {
    flight::lockstep(scenario, 1, flight::rigid_body(scenario, 1)).expect("can be flown")
}

/// Flies a scenario's world without its controller: the rotors are told `command(tick)`, rad/s.
fn fly_open_loop(scenario: &Scenario, ticks: u32, command: impl Fn(u32) -> [f32; 4]) -> Vec<Row> {
    let (mut flight, mut rows) = (ready(scenario), Vec::new());
    let (mut inner, outer): (InnerOutput, OuterOutput) = {
        let own = &flight.autopilot.inner;
        (*own.inner_output(), *own.outer_output())
    };
    for tick in 0..ticks {
        flight.sense();
        inner.motors.omega_rad_s = command(tick);
        flight.look_at(&inner, &outer).show(&mut rows);
        flight.actuate(&inner.motors, inner.saturated);
    }
    rows
}

fn hover_speed(scenario: &Scenario) -> f64 {
    let c = scenario.constants();
    (c.mass * c.gravity / (4.0 * 8.54858e-6)).sqrt()
}

#[test]
fn a_delayed_flight_is_the_same_flight_later() {
    let hover = hover_speed(&load("x500-hover", &[])) as f32;
    // All four rotors apart, and never still, so that no other delay would do.
    let wobble = |tick: u32| {
        let t = f64::from(tick) * MS;
        [20.0, 23.0, 29.0, 31.0].map(|rate: f64| hover + (100.0 * (rate * t).sin()) as f32)
    };
    for lag in ["rotor_lag_s=0.02", "rotor_lag_s=0.0"] {
        let fly = |delay: &str| {
            let scenario = load("x500-hover", &[lag, &format!("actuation_delay_s={delay}")]);
            fly_open_loop(&scenario, 500, wobble)
        };
        let direct = fly("0.0");
        for (delay, ticks) in [("0.001", 1), ("0.005", 5), ("0.016", 16)] {
            let delayed = fly(delay);
            let hover = f64::from(hover);
            for row in &delayed[..ticks] {
                // Until a command arrives it hovers; f32 and f64 differ in what hovering is by 6e-8.
                assert!(row.omega_command.iter().all(|omega| (omega - hover).abs() < 1e-7 * hover), "{row:?}");
                assert!(row.rates.iter().chain(&row.velocity).all(|v| v.abs() < 1e-12), "{row:?}");
            }
            for (late, row) in delayed[ticks..].iter().zip(&direct) {
                assert_eq!(late.omega_command, row.omega_command, "{delay}");
                // A millisecond's rounding of m g at rest is all that differs.
                let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
                assert!(apart(&late.rates, &row.rates) < 1e-12, "{delay} at {}", row.t);
                assert!(apart(&late.attitude, &row.attitude) < 1e-12, "{delay} at {}", row.t);
                assert!(apart(&late.velocity, &row.velocity) < 1e-12, "{delay} at {}", row.t);
                assert!(apart(&late.omega, &row.omega) < 1e-9, "{delay} at {}", row.t);
            }
        }
        assert!(direct.iter().any(|row| row.rates[0].abs() > 0.1), "it did turn");
    }
}

/// Acceleration (m/s²) and angular acceleration (rad/s²) of a plant in its first microsecond under hover's commands.
fn first_accelerations(scenario: &Scenario, omega: f64) -> (V, V) {
    let h = 1e-6;
    let motion = Motion::at_rest(V::zeros());
    let mut plant = RigidBody::new(scenario.constants(), None, V::zeros()).with_state(motion, Vector4::repeat(omega));
    plant.step(&[omega; 4], &Push::default(), h);
    (plant.motion().velocity / h, plant.motion().rates / h)
}

#[test]
fn a_weak_rotor_lifts_and_turns_less() {
    let scenario = load("x500-hover", &["truth.rotor_effectiveness=[0.8,1.0,1.0,1.0]"]);
    let omega = hover_speed(&scenario);
    let (acceleration, turn) = first_accelerations(&scenario, omega);
    // A fifth of a quarter of the weight is gone at the front right (x = 0.174, y = −0.174), and the yaw torque of a
    // rotor that pushed towards −ψ: it rolls right (p > 0), pitches nose down (q > 0) and yaws towards +ψ.
    let lost = 0.2 * 0.25 * 2.0 * 9.81;
    // Drag and damping after a microsecond: 1e-7 m/s².
    assert!((acceleration - V::new(0.0, 0.0, -lost / 2.0)).norm() < 1e-6, "{acceleration}");
    let exact = V::new(0.174 * lost / 0.021_667, 0.174 * lost / 0.021_667, 0.016 * lost / 0.04);
    assert!((turn - exact).norm() < 1e-5 * exact.norm(), "{turn} {exact}");
    assert_eq!(scenario.flight_config(), load("x500-hover", &[]).flight_config(), "the firmware does not know");
}

#[test]
fn a_heavier_vehicle_turns_and_rises_less_for_the_same_rotors() {
    let scenario = load("x500-hover", &["truth.mass_factor=1.25", "truth.inertia_factor=2.0"]);
    let omega = hover_speed(&load("x500-hover", &[]));
    let (acceleration, _) = first_accelerations(&scenario, omega);
    assert!((acceleration.z - (9.81 / 1.25 - 9.81)).abs() < 1e-6, "{acceleration}");
    // A torque of one rotor's: half the angular acceleration on every axis.
    let turn = |settings: &[&str]| {
        let weak = [settings, &["truth.rotor_effectiveness=[0.8,1.0,1.0,1.0]"]].concat();
        first_accelerations(&load("x500-hover", &weak), omega).1
    };
    let (light, heavy) = (turn(&[]), turn(&["truth.inertia_factor=2.0"]));
    assert!((light - heavy * 2.0).norm() < 1e-9 * light.norm() && light.norm() > 1.0, "{light} {heavy}");
    assert_eq!(scenario.flight_config(), load("x500-hover", &[]).flight_config(), "the firmware does not know");
}

#[test]
fn the_plants_rotors_lag_by_their_own_constant() {
    let scenario = load("x500-hover", &["truth.rotor_lag_s=0.04"]);
    assert_eq!(scenario.constants().rotor_lag, 0.04);
    assert_eq!(scenario.flight_config(), load("x500-hover", &[]).flight_config(), "the firmware does not know");
}

#[test]
fn wind_is_an_acceleration_of_drag_over_mass_times_wind() {
    // Galileo: seen from the moving air, a flight in wind is a flight in still air. Hard turning, and drag that differs
    // along the axes.
    let c = Constants { drag: V::new(0.3, 0.5, 0.8), ..load("x500-hover", &[]).constants() };
    let wind = V::new(4.0, -3.0, 1.5);
    let start = Motion {
        position: V::zeros(),
        velocity: V::new(1.0, -2.0, 0.5),
        attitude: *UnitQuaternion::from_euler_angles(0.4, -0.7, 1.9).quaternion(),
        rates: V::new(3.0, -4.0, 5.0),
    };
    let fly = |velocity: V, push: V| {
        let motion = Motion { velocity, ..start };
        let mut plant = RigidBody::new(c.clone(), None, V::zeros()).with_state(motion, Vector4::repeat(700.0));
        let push = Push { acceleration: push, ..Push::default() };
        for _ in 0..1_000 {
            plant.step(&[760.0, 755.0, 750.0, 765.0], &push, MS);
        }
        plant.motion()
    };
    let blown = fly(start.velocity, c.drag.component_mul(&wind) / c.mass);
    let still = fly(start.velocity - wind, V::zeros());
    // Rounding of 1000 steps at 10 m/s and 10 m.
    assert!((blown.velocity - wind - still.velocity).norm() < 1e-11, "{blown:?} {still:?}");
    assert!((blown.position - wind - still.position).norm() < 1e-11, "{blown:?} {still:?}");
    assert_eq!(blown.attitude, still.attitude);
}

#[test]
fn a_hovering_vehicle_drifts_with_the_wind() {
    let scenario = load("x500-hover", &["wind.mean_m_s=[3.0,-2.0,0.0]", "truth.mass_factor=1.5"]);
    let rows = fly_open_loop(&scenario, 2_000, |_| [hover_speed(&scenario) as f32; 4]);
    let constant_s = 2.0 * 1.5 / 0.244;
    for row in &rows {
        // v = w (1 − e^(−k t/m)).
        let part = 1.0 - (-row.t / constant_s).exp();
        let exact = V::new(3.0, -2.0, 0.0) * part;
        // Hover's speed in f32 is off by 6e-8: 1e-6 m/s² upwards.
        assert!((V::from(row.velocity) - exact).norm() < 3e-6, "{row:?} {exact}");
    }
}

#[test]
fn turbulence_is_the_seeds_and_leaves_the_disturbance_alone() {
    let disturbance = "disturbance={from_s=0.0,to_s=9.0,hold_s=0.001,angular_acceleration_rad_s2=5.0}";
    let fly = |settings: &[&str], seed: u64| {
        let scenario = load("x500-hover", &[&["duration_s=0.5"], settings].concat());
        let mut rows: Vec<Row> = Vec::new();
        flight::fly(&scenario, seed, &mut rows).expect("can be flown");
        rows
    };
    let gusts = "wind.turbulence_20ft_m_s=7.7";
    assert_eq!(fly(&[gusts], 1), fly(&[gusts], 1));
    assert_ne!(fly(&[gusts], 1), fly(&[gusts], 2));
    // Before the firmware has reacted, what turns the vehicle is the disturbance alone.
    assert_eq!(fly(&[disturbance], 1)[1].rates, fly(&[disturbance, gusts], 1)[1].rates);
    assert_ne!(fly(&[disturbance], 1)[1].velocity, fly(&[disturbance, gusts], 1)[1].velocity);
}

#[test]
fn the_eights_are_as_fast_as_they_say() {
    for (name, acceleration_m_s2) in [("x500-eight", 12.0), ("x500-eight-tw4", 20.0)] {
        let trajectory = load(name, &[]).file.trajectory;
        let at = |t: f64| V::from_iterator(reference::at(&trajectory, t).into_iter().take(3));
        let h = 1e-3;
        let (mut fastest, mut hardest) = (0.0_f64, 0.0_f64);
        for t in (0..7_000).map(|k| f64::from(k) * h) {
            fastest = fastest.max((at(t + h) - at(t - h)).norm() / (2.0 * h));
            hardest = hardest.max((at(t + h) - at(t) * 2.0 + at(t - h)).norm() / (h * h));
        }
        // Differences are off by (2 ω h)²/6 = 2e-6 of the value.
        assert!((fastest - 8.0).abs() < 1e-3, "{name}: {fastest} m/s");
        assert!((hardest - acceleration_m_s2).abs() < 1e-3, "{name}: {hardest} m/s²");
    }
}

#[test]
fn the_x500_survives_its_scenarios() {
    for name in ["x500-hover", "x500-step", "x500-helix", "x500-eight", "x500-eight-tw4"] {
        let mut rows: Vec<Row> = Vec::new();
        let outcome = flight::fly(&load(name, &[]), 1, &mut rows).expect("can be flown");
        let last = rows.last().expect("rows");
        let away = last.position.iter().zip(&last.reference).map(|(is, ought)| (is - ought).abs()).fold(0.0, f64::max);
        assert!(outcome.survived() && away < 0.5, "{name}: {away} m away in the end");
    }
}

#[test]
fn a_flight_begins_in_the_motion_of_its_scenario() {
    let settings = ["start_velocity_m_s=[1,-2,3]", "start_attitude_deg=[90,0,180]", "start_rates_rad_s=[0.1,0.2,0.3]"];
    let motion = flight::rigid_body(&load("x500-hover", &settings), 1).motion();
    assert_eq!((motion.position, motion.velocity), (V::new(0.0, 0.0, 2.0), V::new(1.0, -2.0, 3.0)));
    assert_eq!(motion.rates, V::new(0.1, 0.2, 0.3));
    // R = Rz(180°) Rx(90°): x to −x; z by the roll to −y, by the turn to y.
    let attitude = UnitQuaternion::new_normalize(motion.attitude);
    assert!((attitude * V::x() - V::new(-1.0, 0.0, 0.0)).norm() < 1e-12);
    assert!((attitude * V::z() - V::new(0.0, 1.0, 0.0)).norm() < 1e-12);
}

#[test]
fn a_tumbling_start_is_the_seeds() {
    let scenario = load("x500-recovery", &[]);
    let start = |seed| flight::rigid_body(&scenario, seed).motion();
    assert_eq!(start(5), start(5));
    assert_ne!(start(5), start(6));
    assert!((start(5).rates.norm() - 10.0).abs() < 1e-12 && (start(5).velocity.norm() - 3.0).abs() < 1e-12);
}

#[test]
fn a_disturbance_is_drawn_once_a_tick_and_pushes_as_it_was_drawn() {
    let scenario = load(
        "x500-hover",
        &[
            "disturbance={from_s=0.1,to_s=0.9,hold_s=0.001,acceleration_m_s2=2.0,position_output_m=0.01}",
            "duration_s=2",
        ],
    );
    let constants = scenario.constants();
    let hover = constants.hover_omega();
    let rows = fly_open_loop(&scenario, 1_000, |_| [hover as f32; 4]);
    // Level and hovering, v̇ = a − (k/m) v: exact for an acceleration that is held over the tick.
    let decay = constants.drag.x / constants.mass;
    let kept = (-decay * MS).exp();
    let mut noise = Noise::new(scenario.file.disturbance.as_ref(), 1, 1000.0);
    let mut velocity = 0.0;
    for (tick, row) in rows.iter().enumerate() {
        assert!((row.velocity[0] - velocity).abs() < 1e-12, "tick {tick}: {} {velocity}", row.velocity[0]);
        let push = noise.at(tick as u32).push.acceleration.x;
        velocity = velocity * kept + push * (1.0 - kept) / decay;
    }
}
