//! What a flight may ask for beyond the plant's constants, against closed forms: specific force, rotors that fail or slow
//! down at another rate, thin air, the cushion over the ground, the battery, gusts and pushes on a schedule.

use nalgebra::{UnitQuaternion, Vector3, Vector4};
use sim_host::flight;
use sim_host::plant::effects::{Effects, RotorFailure};
use sim_host::plant::ground::Ground;
use sim_host::plant::paper::{PaperPlant, PaperState};
use sim_host::plant::rigid_body::RigidBody;
use sim_host::plant::{Constants, Motion, Plant, Push};
use sim_host::record::Row;
use sim_host::sil::Lockstep as _;

use crate::common::load::load;

type V = Vector3<f64>;

const STILL: Push = Push { acceleration: V::new(0.0, 0.0, 0.0), angular_acceleration: V::new(0.0, 0.0, 0.0) };
const MS: f64 = 1e-3;

fn x500() -> Constants {
    load("x500-hover", &[]).constants()
}

/// The plant of `x500-hover` with settings.
fn plant(settings: &[&str]) -> RigidBody {
    flight::rigid_body(&load("x500-hover", settings), 1)
}

fn fly(plant: &mut impl Plant, command: &[f64; 4], steps: usize) {
    for _ in 0..steps {
        plant.step(command, &STILL, MS);
    }
}

fn tumbling() -> Motion {
    Motion {
        position: V::new(0.0, 0.0, 100.0),
        velocity: V::new(1.0, -2.0, 0.5),
        attitude: *UnitQuaternion::from_euler_angles(0.4, -0.7, 1.9).quaternion(),
        rates: V::new(3.0, -4.0, 5.0),
    }
}

#[test]
fn an_accelerometer_reads_g_at_rest_and_nothing_in_free_fall() {
    let g = V::new(0.0, 0.0, 9.81);
    let c = x500();
    let hover = [c.hover_omega(); 4];
    let mut hovering = RigidBody::new(c.clone(), None, V::zeros());
    assert!((hovering.specific_force(&STILL) - g).norm() < 1e-14);
    fly(&mut hovering, &hover, 100);
    assert!((hovering.specific_force(&STILL) - g).norm() < 1e-12, "{}", hovering.specific_force(&STILL));

    let ground = Ground::for_vehicle(0.0, c.mass, c.gravity, c.inertia.z);
    let mut standing = RigidBody::new(c.clone(), Some(ground), V::zeros());
    fly(&mut standing, &[0.0; 4], 3_000);
    // Damped near critically at 99 rad/s: nothing is left of the first millimetre.
    assert!((standing.specific_force(&STILL) - g).norm() < 1e-9, "{}", standing.specific_force(&STILL));

    // In no air, however it turns.
    let vacuum = Constants { drag: V::zeros(), ..c };
    let mut falling = RigidBody::new(vacuum, None, V::zeros()).with_state(tumbling(), Vector4::zeros());
    fly(&mut falling, &[0.0; 4], 1_000);
    assert_eq!(falling.specific_force(&STILL), V::zeros());
    // What pushes it is felt about its own axes.
    let push = Push { acceleration: V::new(1.0, 2.0, 3.0), ..STILL };
    let felt = UnitQuaternion::new_normalize(falling.motion().attitude) * falling.specific_force(&push);
    assert!((felt - push.acceleration).norm() < 1e-12, "{felt}");
}

#[test]
fn at_its_terminal_speed_a_falling_body_feels_its_weight() {
    let c = x500();
    let terminal = V::new(0.0, 0.0, -c.mass * c.gravity / c.drag.z);
    let motion = Motion { velocity: terminal, ..Motion::at_rest(V::zeros()) };
    let falling = RigidBody::new(c, None, V::zeros()).with_state(motion, Vector4::zeros());
    assert!((falling.specific_force(&STILL) - V::new(0.0, 0.0, 9.81)).norm() < 1e-12);
}

/// Largest difference between the specific force and the velocity's central difference, over 0.2 s.
fn worst_difference(plant: &mut impl Plant, command: &[f64; 4], push: &Push) -> f64 {
    let h = 1e-4;
    let mut worst = 0.0_f64;
    for _ in 0..2_000 {
        let before = plant.motion();
        plant.step(command, push, h);
        let (felt, now) = (plant.specific_force(push), plant.motion());
        plant.step(command, push, h);
        let change = (plant.motion().velocity - before.velocity) / (2.0 * h);
        let exact = UnitQuaternion::new_normalize(now.attitude).inverse() * (change + V::new(0.0, 0.0, 9.81));
        worst = worst.max((felt - exact).norm());
    }
    worst
}

#[test]
fn specific_force_is_what_changes_the_velocity() {
    let c = x500();
    let push = Push { acceleration: V::new(0.5, -1.0, 0.7), angular_acceleration: V::new(1.0, 2.0, -1.0) };
    let command = [700.0, 690.0, 720.0, 700.0];
    let mut rigid = RigidBody::new(c.clone(), None, V::zeros()).with_state(tumbling(), Vector4::repeat(760.0));
    // A central difference is off by h²/6 of the third derivative: 1e-8/6 · a · (12 rad/s)², with a up to 20 m/s².
    let worst = worst_difference(&mut rigid, &command, &push);
    assert!(worst < 2e-5, "{worst}");
    let state = PaperState {
        angles: V::new(0.4, -0.7, 1.9),
        velocity: V::new(1.0, -2.0, 0.5),
        ..PaperState::at_rest(V::zeros())
    };
    let mut paper = PaperPlant::new(c, V::zeros()).with_state(state);
    let worst = worst_difference(&mut paper, &command, &push);
    assert!(worst < 2e-5, "{worst}");
}

#[test]
fn a_flight_tells_its_specific_force_with_wind_and_pushes() {
    let settings = ["wind.mean_m_s=[3.0,0.0,0.0]", "push=[{from_s=0.0,to_s=9.0,acceleration_m_s2=[0.0,1.5,0.0]}]"];
    let scenario = load("x500-hover", &settings);
    let mut flight = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("can be flown");
    flight.step(&mut ());
    let motion = flight.plant().motion();
    let felt = UnitQuaternion::new_normalize(motion.attitude) * flight.specific_force();
    // The rotors have had a tick to answer, not more.
    let exact = V::new(0.244 / 2.0 * (3.0 - motion.velocity.x), 1.5, 9.81);
    assert!((felt - exact).norm() < 2e-3, "{felt} {exact}");
}

/// Acceleration (m/s²) and angular acceleration (rad/s²) in a microsecond.
fn accelerations(plant: &RigidBody, omega: f64) -> (V, V) {
    let h = 1e-6;
    let mut plant = plant.clone();
    let before = plant.motion();
    plant.step(&[omega; 4], &STILL, h);
    ((plant.motion().velocity - before.velocity) / h, (plant.motion().rates - before.rates) / h)
}

#[test]
fn a_rotor_fails_in_flight_and_may_heal() {
    let c = x500();
    let hover = c.hover_omega();
    let mut plant = RigidBody::new(c.clone(), None, V::zeros());
    plant.set_rotor_effectiveness([0.0, 1.0, 1.0, 1.0]);
    let (acceleration, turn) = accelerations(&plant, hover);
    // A quarter of the weight gone at the front right (x = 0.174, y = −0.174), and its torque, which pushed towards −ψ.
    let lost = 0.25 * 2.0 * 9.81;
    assert!((acceleration - V::new(0.0, 0.0, -lost / 2.0)).norm() < 1e-5, "{acceleration}");
    let exact = V::new(0.174 * lost / 0.021_667, 0.174 * lost / 0.021_667, 0.016 * lost / 0.04);
    assert!((turn - exact).norm() < 1e-5 * exact.norm(), "{turn} {exact}");
    assert!((plant.omega()[0] - hover).abs() < 1e-12, "its spin goes on");
    plant.set_rotor_effectiveness([1.0; 4]);
    assert_eq!(plant.constants(), &c, "as it was built, to the bit");
}

#[test]
fn failures_come_at_their_tick() {
    let failures = "fault=[{kind=\"rotor\",index=0,effectiveness=0.5,from_s=0.005,to_s=0.02}]";
    let mut plant = plant(&[failures]);
    let hover = [plant.constants().hover_omega(); 4];
    let lift = |plant: &RigidBody| plant.constants().geometry[(0, 0)] / 8.54858e-6;
    for tick in 0..40 {
        let turned = plant.motion().rates.norm();
        plant.step(&hover, &STILL, MS);
        let sound = !(5..20).contains(&tick);
        assert_eq!(lift(&plant), if sound { 1.0 } else { 0.5 }, "tick {tick}");
        assert!(sound || plant.motion().rates.norm() > turned, "tick {tick}");
    }
}

#[test]
fn effects_that_change_nothing_change_no_bit() {
    let failures = vec![RotorFailure { at: 0.0, effectiveness: [1.0; 4] }];
    let fly = |effects: Effects| {
        let mut plant = RigidBody::new(x500(), None, V::zeros())
            .with_state(tumbling(), Vector4::repeat(700.0))
            .with_effects(effects);
        fly(&mut plant, &[760.0, 755.0, 750.0, 765.0], 1_000);
        plant.motion()
    };
    let mut plain = RigidBody::new(x500(), None, V::zeros()).with_state(tumbling(), Vector4::repeat(700.0));
    self::fly(&mut plain, &[760.0, 755.0, 750.0, 765.0], 1_000);
    assert_eq!(fly(Effects { failures, ..Effects::default() }), plain.motion());
    // A lag down that is the lag up: the same closed form.
    assert_eq!(fly(Effects { rotor_lag_down: Some(0.02), ..Effects::default() }), plain.motion());
}

#[test]
fn rotors_slow_down_by_their_own_closed_form() {
    let mut plant = plant(&["world.rotor_lag_down=true", "airframe.rotor_lag_down_s=0.035"]);
    let start = plant.omega()[0];
    let command = [start + 200.0, start, start - 200.0, 0.0];
    for step in 1..=200 {
        plant.step(&command, &STILL, MS);
        for (omega, target) in plant.omega().into_iter().zip(command) {
            let constant = if target < start { 0.035 } else { 0.02 };
            let exact = target + (start - target) * (-f64::from(step) * MS / constant).exp();
            assert!((omega - exact).abs() < 1e-10, "step {step}: {omega} {exact}");
        }
    }
}

#[test]
fn slowing_down_by_another_constant_keeps_the_total_angular_momentum() {
    let c = Constants {
        drag: V::zeros(),
        rotational_drag: V::zeros(),
        geometry: nalgebra::Matrix4::zeros(),
        gravity: 0.0,
        ..x500()
    };
    let momentum = |plant: &RigidBody| {
        let rotors = c.rotor_inertia * c.rotor_spin(&Vector4::from(plant.omega()));
        let motion = plant.motion();
        UnitQuaternion::new_normalize(motion.attitude)
            * (c.inertia.component_mul(&motion.rates) + V::new(0.0, 0.0, rotors))
    };
    let mut plant = RigidBody::new(c.clone(), None, V::zeros())
        .with_state(tumbling(), Vector4::new(900.0, 300.0, 700.0, 0.0))
        .with_effects(Effects { rotor_lag_down: Some(0.035), ..Effects::default() });
    let before = momentum(&plant);
    fly(&mut plant, &[0.0, 900.0, 100.0, 500.0], 500);
    // RK4 at 1 ms on rates of 7 rad/s and reactions that fade within 20 ms: (0.05)⁵/120 = 3e-9 a step at first.
    assert!((momentum(&plant) - before).norm() < 1e-7 * before.norm(), "{} {before}", momentum(&plant));
}

#[test]
fn thin_air_lifts_turns_and_drags_less() {
    // 2,000 m: ρ/ρ0 = 0.82162 (ISO 2533).
    let high = plant(&["world.altitude_m=1998.0"]);
    assert!((high.air_density() - 0.821_62).abs() < 2e-5, "start at z = 2 m: {}", high.air_density());
    let hover = x500().hover_omega();
    let (acceleration, _) = accelerations(&high, hover);
    assert!((acceleration.z - 9.81 * (high.air_density() - 1.0)).abs() < 1e-5, "{acceleration}");
    assert!((high.constants().hover_omega() - hover / high.air_density().sqrt()).abs() < 1e-9);
    // Terminal speed m g/(k ρ/ρ0), and what a wind does there.
    let falling = Motion { velocity: V::new(0.0, 0.0, -10.0), ..Motion::at_rest(V::zeros()) };
    let high = plant(&["world.altitude_m=2000.0"]).with_state(falling, Vector4::zeros());
    let drag = high.specific_force(&STILL).z;
    assert!((drag - 0.244 / 2.0 * 10.0 * high.air_density()).abs() < 1e-6, "{drag}");
    let scenario = load("x500-hover", &["world.altitude_m=1998.0", "wind.mean_m_s=[5.0,0.0,0.0]"]);
    let mut flight = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("can be flown");
    flight.step(&mut ());
    let exact = 0.244 / 2.0 * 5.0 * 0.821_62 * MS;
    assert!((flight.plant().motion().velocity.x / exact - 1.0).abs() < 1e-3, "{}", flight.plant().motion().velocity);
}

#[test]
fn close_to_the_ground_rotors_lift_more() {
    // Ground at z = 0 (the start's height), rotors 0.287 m above the feet.
    let settings = ["ground=true", "start_position_m=[0.0,0.0,0.0]", "world.ground_effect=true"];
    let at = |settings: &[&str], z: f64| {
        let motion = Motion::at_rest(V::new(0.0, 0.0, z));
        let hover = x500().hover_omega();
        plant(settings)
            .with_state(motion, Vector4::repeat(hover))
            .with_effects(load("x500-hover", settings).effects().expect("some"))
    };
    let hover = x500().hover_omega();
    for (height, factor) in [(2.0 * 0.127, 64.0 / 63.0), (10.0 * 0.127, 1600.0 / 1599.0)] {
        let low: &[&str] = &[&settings[..], &["airframe.rotor_height_m=0.0"]].concat();
        let (acceleration, turn) = accelerations(&at(low, height), hover);
        assert!((acceleration.z - 9.81 * (factor - 1.0)).abs() < 1e-5, "{height}: {acceleration}");
        assert!(turn.norm() < 1e-9, "lifted evenly: {turn}");
    }
    // On its feet: 0.287 m are 2.26 R, 1/(1 − 1/(16·2.26²)) = 1.0124. Yaw torque stays as it is.
    let standing = at(&settings, 0.0);
    let b = standing.constants().geometry;
    assert!((b[(0, 0)] / 8.54858e-6 - 1.0124).abs() < 1e-4, "{}", b[(0, 0)]);
    assert_eq!(b.row(3), x500().geometry.row(3));
    // Leaning to the right (φ > 0), the right rotors are lower, lift more and right it.
    let lean = Motion {
        attitude: *UnitQuaternion::from_euler_angles(0.3, 0.0, 0.0).quaternion(),
        ..Motion::at_rest(V::new(0.0, 0.0, 0.2))
    };
    let leaning = at(&settings, 0.2)
        .with_state(lean, Vector4::repeat(hover))
        .with_effects(load("x500-hover", &settings).effects().expect("some"));
    assert!(accelerations(&leaning, hover).1.x < -0.1, "{}", accelerations(&leaning, hover).1);
}

#[test]
fn a_battery_feeds_the_rotors_and_limits_them() {
    let settings = ["battery.soc=0.5", "airframe.rotor_lag_s=0.0"];
    let mut plant = plant(&settings);
    let hover = plant.constants().hover_omega();
    fly(&mut plant, &[hover; 4], 1);
    let state = plant.battery().expect("there is one");
    // 4 rotors at 1.367773e-7 ω³ over 0.8, and 8 W, at 15.36 V less 0.02 Ω times the current.
    let power = 4.0 * 1.367_773e-7 * hover.powi(3) / 0.8 + 8.0;
    assert!((state.voltage_v * state.current_a - power).abs() < 1e-6, "{state:?} {power}");
    assert!((state.voltage_v - (15.36 - 0.02 * state.current_a)).abs() < 1e-4, "{state:?}");
    // 300 W at 15 V: 20 A, and a rotor that asks for more than the voltage gives gets what it gives.
    assert!((18.0..23.0).contains(&state.current_a), "{state:?}");
    let most = load("x500-hover", &settings).airframe.omega_max();
    for _ in 0..50 {
        let limit = most * plant.battery().expect("there is one").voltage_v / 14.8;
        let given = plant.omega_during(&[2.0 * most; 4]);
        assert!(given.iter().all(|omega| (omega - limit).abs() < 1e-9), "{given:?} {limit}");
        plant.step(&[2.0 * most; 4], &STILL, MS);
        assert_eq!(plant.omega(), given);
    }
    assert!(plant.battery().expect("there is one").voltage_v < state.voltage_v, "sagged");
}

#[test]
fn hovering_empties_the_battery_in_the_time_of_its_closed_form() {
    // 0.02 Ah at 15.5 V between 14 and 16.8 V: some 4 s. Without resistance P t = C ∫E ds.
    let curve = [14.0, 14.76, 14.92, 15.08, 15.2, 15.36, 15.48, 15.8, 16.08, 16.44, 16.8];
    let mut plant = plant(&["battery.soc=1", "airframe.battery.resistance_ohm=0", "airframe.battery.capacity_ah=0.02"]);
    let hover = plant.constants().hover_omega();
    let power = 4.0 * 1.367_773e-7 * hover.powi(3) / 0.8 + 8.0;
    let energy = 0.02 * 3600.0 * curve.windows(2).map(|pair| 0.1 * 0.5 * (pair[0] + pair[1])).sum::<f64>();
    let mut steps = 0;
    while plant.battery().expect("there is one").soc > 0.0 {
        plant.step(&[hover; 4], &STILL, MS);
        steps += 1;
    }
    // Euler's method is off by less than a step, and the end is seen to a step.
    assert!((f64::from(steps) * MS - energy / power).abs() < 2.0 * MS, "{steps} {}", energy / power);
    fly(&mut plant, &[hover; 4], 200);
    assert!(plant.omega().iter().all(|omega| *omega < 0.1), "nothing turns without power: {:?}", plant.omega());
}

#[test]
fn a_collapse_of_the_voltage_slows_the_rotors_while_it_lasts() {
    let mut plant = plant(&["battery={}", "fault=[{kind=\"collapse\",from_s=0.1,to_s=0.3,factor=0.5}]"]);
    let hover = plant.constants().hover_omega();
    let mut slowest = f64::INFINITY;
    for tick in 1..=600 {
        plant.step(&[hover; 4], &STILL, MS);
        slowest = slowest.min(plant.omega()[0]);
        let collapsed = plant.battery().expect("there is one").voltage_v < 10.0;
        assert_eq!(collapsed, (100..300).contains(&tick), "tick {tick}");
    }
    // ωmax = 1.414 hover at 14.8 V: 8.2 V give 0.78 of hover.
    assert!((0.75..0.8).contains(&(slowest / hover)), "{}", slowest / hover);
    assert!((plant.omega()[0] / hover - 1.0).abs() < 1e-4, "recovered");
}

#[test]
fn a_scheduled_push_turns_and_moves_by_its_integral() {
    let push = "push=[{from_s=0.1,to_s=0.2,angular_acceleration_rad_s2=[40.0,0.0,0.0]},{from_s=0.15,to_s=0.3,acceleration_m_s2=[0.0,0.0,2.0]}]";
    let scenario = load("x500-hover", &[push, "duration_s=0.2"]);
    let mut rows: Vec<Row> = Vec::new();
    flight::fly(&scenario, 1, &mut rows).expect("can be flown");
    assert!(rows[..101].iter().all(|row| row.rates[0].abs() < 1e-6), "nothing before its time");
    // A tick later, before anything has answered: 40 rad/s² · 1 ms.
    assert!((rows[101].rates[0] - 0.04).abs() < 1e-6, "{}", rows[101].rates[0]);
    assert!((rows[151].velocity[2] - rows[150].velocity[2] - 2.0 * MS).abs() < 1e-3);
}

#[test]
fn a_gust_pushes_as_its_closed_form_says() {
    let gust = "wind.gust=[{from_s=0.0,rise_s=0.4,hold_s=0.2,peak_m_s=[5.0,0.0,0.0]}]";
    let scenario = load("x500-hover", &[gust]);
    let (c, mut weather) = (scenario.constants(), flight::weather(&scenario, 1).expect("there is some"));
    let mut plant = RigidBody::new(c.clone(), None, V::zeros());
    let hover = [c.hover_omega(); 4];
    for tick in 0..1_000 {
        let push = *weather.add(&STILL, tick, plant.air_density());
        plant.step(&hover, &push, MS);
    }
    // Impulse k/m · 5 m/s · (0.4 + 0.2) s, of which drag takes back less than k/m · 1 s of itself.
    let impulse = 0.244 / 2.0 * 5.0 * 0.6;
    let speed = plant.motion().velocity.x;
    assert!(speed < impulse && speed > impulse * (1.0 - 0.122), "{speed} {impulse}");
}

#[test]
fn the_x500_flies_in_the_whole_world() {
    let scenario = load(
        "x500-step",
        &[
            "ground=true",
            "battery.soc=0.9",
            "world={altitude_m=488.0,ground_height_m=0.0,ground_effect=true,rotor_lag_down=true}",
            "thrust_to_weight=3.0",
            "wind={mean_m_s=[3.0,0.0,0.0],turbulence_20ft_m_s=5.0}",
        ],
    );
    let fly = || {
        let mut rows: Vec<Row> = Vec::new();
        let outcome = flight::fly(&scenario, 1, &mut rows).expect("can be flown");
        assert!(outcome.survived());
        rows
    };
    let rows = fly();
    let last = rows.last().expect("rows");
    let away = last.position.iter().zip(&last.reference).map(|(is, ought)| (is - ought).abs()).fold(0.0, f64::max);
    assert!(away < 0.5, "{away} m away in the end");
    assert_eq!(rows, fly(), "the same flight again");
}
