//! Take-off and landing, hard and crooked: the ground takes energy and gives none, and what has landed stays.

use nalgebra::{UnitQuaternion, Vector3, Vector4};
use sim_host::plant::ground::Ground;
use sim_host::plant::rigid_body::RigidBody;
use sim_host::plant::{Motion, Plant, Push};
use sim_host::record::{Recorder, Row};
use sim_host::scenario::Scenario;
use sim_host::touchdown::Touchdown;

type V = Vector3<f64>;

const STILL: Push = Push { acceleration: V::new(0.0, 0.0, 0.0), angular_acceleration: V::new(0.0, 0.0, 0.0) };
const MS: f64 = 1e-3;

fn standing(airframe: &str, start: Motion) -> RigidBody {
    let c = Scenario::load("hover", &[format!("airframe={airframe}")]).expect("valid").constants();
    let ground = Ground::for_vehicle(0.0, c.mass, c.gravity, c.inertia.z);
    RigidBody::new(c, Some(ground), V::zeros()).with_state(start, Vector4::zeros())
}

/// Of motion, height and the feet's springs, J.
fn energy(plant: &RigidBody) -> f64 {
    let (c, motion, ground) = (plant.constants(), plant.motion(), plant.ground().expect("there is ground"));
    let attitude = UnitQuaternion::new_normalize(motion.attitude);
    let depths = ground.clearances(&motion.position, &attitude).map(|clearance| clearance.min(0.0));
    c.mass * (0.5 * motion.velocity.norm_squared() + c.gravity * motion.position.z)
        + 0.5 * motion.rates.dot(&c.inertia.component_mul(&motion.rates))
        + depths.iter().map(|depth| 0.5 * ground.stiffness * depth * depth).sum::<f64>()
}

/// Every landing at hand: level or tilted by 20°, straight down or drifting, at 1 and 3 m/s, turning or not.
fn landings() -> impl Iterator<Item = Motion> {
    let all = [0.0, 20.0_f64].map(|tilt| {
        [0.0, 3.0].map(|drift| [1.0, 3.0].map(|down| [-25.0, 0.0, 25.0].map(|spin| (tilt, drift, down, spin))))
    });
    all.into_iter().flatten().flatten().flatten().map(|(tilt, drift, down, spin)| Motion {
        position: V::new(0.0, 0.0, 0.06),
        velocity: V::new(drift, 0.0, -down),
        attitude: *UnitQuaternion::from_euler_angles(tilt.to_radians(), -0.3 * tilt.to_radians(), 0.4).quaternion(),
        rates: V::new(0.0, 0.0, spin),
    })
}

#[test]
fn every_landing_loses_energy_and_comes_to_rest() {
    for airframe in ["paper", "x500", "racer250", "crazyflie"] {
        for start in landings() {
            let mut plant = standing(airframe, start);
            let (first, mut before, mut lowest) = (energy(&plant), energy(&plant), 0.0_f64);
            for tick in 0..5_000 {
                plant.step(&[0.0; 4], &STILL, MS);
                let now = energy(&plant);
                // What an explicit step across a kink of the contact may be off by.
                assert!(now - before < 2e-3 * first, "{airframe} {start:?}: {before} to {now} of {first} at {tick}");
                assert!(now < first * (1.0 + 1e-9), "{airframe} {start:?}: {now} of {first} at {tick}");
                (before, lowest) = (now, lowest.min(plant.motion().position.z));
            }
            let end = plant.motion();
            assert!(end.velocity.norm() < 1e-9 && end.rates.norm() < 1e-9, "{airframe} {start:?}: {end:?}");
            // m g = 4 k x at rest: 1 mm; v/√(g/1 mm) = 3 cm without damping.
            assert!((end.position.z + 1e-3).abs() < 1e-9, "{airframe} {start:?}: {end:?}");
            assert!(lowest > -0.03, "{airframe} {start:?}: sank to {lowest}");
        }
    }
}

#[test]
fn a_take_off_and_a_landing_end_with_the_touchdowns_own_speed() {
    let mut plant = standing("x500", Motion::at_rest(V::zeros()));
    let ground = plant.ground().expect("there is ground").clone();
    let (hover, mut touchdown) = (plant.constants().hover_omega(), Touchdown::new(ground));
    let mut fell = 0.0;
    for tick in 0..8_000_u32 {
        let row = Row::of_motion(f64::from(tick) * MS, &plant.motion());
        touchdown.record(&row);
        // Up for a second and a half, then a little too slow to hover.
        let command = if tick < 1_500 { 1.1 * hover } else { 0.93 * hover };
        if plant.height_above_ground() > 0.0 {
            fell = -plant.motion().velocity.z;
        }
        plant.step(&[command; 4], &STILL, MS);
        if touchdown.first().is_some() {
            break;
        }
    }
    let contact = touchdown.first().expect("it lands");
    assert_eq!(contact.descent_m_s, fell);
    assert!((0.5..5.0).contains(&fell) && contact.t_s > 1.5, "{contact:?}");
}
