//! Whatever fails and whenever: what is commanded can be flown, what is believed is a number, and the same flight is the
//! same flight. Faults at random, of any size that a scenario may ask for, in wind, from before take-off on.

use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, RngSeed, TestRunner};
use sim_host::flight;
use sim_host::scenario::Scenario;
use sim_host::sensors::Fault;
use sim_host::sensors::faults::{Kind, Sensor};
use sim_host::sil::Lockstep as _;

use crate::common::fingerprint::Fingerprint;
use crate::common::load::load;

/// Length of a flight, s: armed after 2.5 s, at 10 m after 14 s.
const DURATION_S: f64 = 30.0;
/// Flights, unless `PROPTEST_CASES` asks for another number.
const CASES: u32 = 24;

/// Sizes from a thousandth to a million, as many of each order.
fn size() -> impl Strategy<Value = f64> {
    (-3.0..6.0_f64, any::<bool>()).prop_map(|(order, negative)| {
        let size = libm::pow(10.0, order);
        if negative { -size } else { size }
    })
}

fn direction() -> impl Strategy<Value = Option<[f64; 3]>> {
    // Never all zero, which would point nowhere.
    prop::option::of((-1.0..1.0_f64, -1.0..1.0_f64, 0.01..1.0_f64).prop_map(|(x, y, z)| [x, y, z]))
}

fn sensor() -> impl Strategy<Value = Sensor> {
    use Sensor::{Accel, Baro, Battery, Gnss, Gyro, Imu, Mag, Pose};
    prop::sample::select(vec![Imu, Gyro, Accel, Mag, Baro, Gnss, Pose, Battery])
}

/// How a sensor may fail; what does not fit is refused by the fault itself.
fn kind() -> impl Strategy<Value = Kind> {
    let part = || 0.0..1.0_f64;
    prop_oneof![
        Just(Kind::Off {}),
        Just(Kind::Stuck {}),
        Just(Kind::Nan {}),
        Just(Kind::NoFix {}),
        Just(Kind::Disorder {}),
        (size(), direction()).prop_map(|(rate, direction)| Kind::Drift { rate, direction }),
        size().prop_map(|sigma| Kind::Noise { sigma: sigma.abs() }),
        (part(), size()).prop_map(|(probability, size)| Kind::Spikes { probability, size }),
        part().prop_map(|extra_s| Kind::Delayed { extra_s }),
        (size(), direction()).prop_map(|(size_m, direction)| Kind::Glitch { size_m, direction }),
        part().prop_map(|probability| Kind::Loss { probability }),
        part().prop_map(|probability| Kind::Duplicate { probability }),
        size().prop_map(|shift_s| Kind::TimeJump { shift_s }),
    ]
}

fn of_no_sensor() -> impl Strategy<Value = Kind> {
    prop_oneof![
        (0..4_usize, 0.0..1.0_f64).prop_map(|(index, effectiveness)| Kind::Rotor { index, effectiveness }),
        (0.0..1.0_f64).prop_map(|factor| Kind::Collapse { factor }),
    ]
}

fn fault() -> impl Strategy<Value = Fault> {
    let what = prop_oneof![
        6 => (sensor().prop_map(Some), kind()),
        1 => (Just(None), of_no_sensor()),
    ];
    // Most at work in the air; half of them end again.
    let when = (0.0..0.9 * DURATION_S, prop::option::of(0.01..10.0_f64));
    (what, when)
        .prop_map(|((sensor, kind), (from_s, lasts_s))| Fault {
            sensor,
            kind,
            from_s,
            to_s: lasts_s.map(|lasts| from_s + lasts),
        })
        .prop_filter("a kind that fits its sensor", |fault| fault.validate().is_ok())
}

#[derive(Clone, Debug)]
struct Case {
    suite: &'static str,
    faults: Vec<Fault>,
    seed: u64,
}

fn case() -> impl Strategy<Value = Case> {
    (prop::sample::select(vec!["gnss", "gnss", "mocap"]), prop::collection::vec(fault(), 1..=6), 0..1_000_u64)
        .prop_map(|(suite, faults, seed)| Case { suite, faults, seed })
}

fn scenario(case: &Case) -> Scenario {
    let mut scenario = load("outdoor-hover", &[&format!("sensors={}", case.suite)]);
    scenario.file.fault.clone_from(&case.faults);
    scenario
}

/// Flies to the end, wherever the vehicle goes, and looks at every tick.
fn fly(case: &Case) -> Result<[u64; 2], TestCaseError> {
    let scenario = scenario(case);
    let plant = flight::rigid_body(&scenario, case.seed);
    let mut flight = flight::lockstep(&scenario, case.seed, plant).expect("can be flown");
    let omega_max = scenario.airframe.flight().omega_max_rad_s;
    let mut seen = Fingerprint::default();
    for tick in 0..(DURATION_S * 1e3) as u32 {
        flight.step(&mut seen);
        let vehicle = &flight.autopilot.inner;
        let omega = vehicle.inner_output().motors.omega_rad_s;
        let flyable = omega.iter().all(|omega| (0.0..=omega_max).contains(omega));
        prop_assert!(flyable, "tick {tick}: commanded {omega:?}, {omega_max} at most");
        prop_assert!(vehicle.nav().is_valid(), "tick {tick}: believed {:?}", vehicle.nav());
    }
    Ok(seen.hashes())
}

#[test]
fn whatever_fails_commands_can_be_flown_and_the_motion_is_a_number() {
    // The cases of a run are those of any other.
    let cases = std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(CASES);
    let config = Config {
        cases,
        rng_algorithm: RngAlgorithm::ChaCha,
        rng_seed: RngSeed::Fixed(0x0067_6c69_7373_6164),
        failure_persistence: None,
        max_shrink_iters: 64,
        ..Config::default()
    };
    let outcome = TestRunner::new(config).run(&case(), |case| {
        let first = fly(&case)?;
        prop_assert_eq!(first, fly(&case)?, "the same flight twice");
        Ok(())
    });
    if let Err(error) = outcome {
        panic!("{error}");
    }
}
