//! What each sensor delivers in flight is its own affair: no other sensor, and no other's fault, changes a number of it.
//! And who listens to the vehicle changes nothing of its flight.

use firmware::mavlink::port::Profile;
use firmware::schedule::GROUND;
use firmware::sensors::Measurements;
use sim_host::flight;
use sim_host::plant::Plant as _;
use sim_host::plant::rigid_body::RigidBody;
use sim_host::scenario::Scenario;
use sim_host::sensors::{BatteryTruth, Fault, Suite, SuiteFile, Truth};
use sim_host::sil::{Flight, Lockstep as _};

use crate::common::fault::fault;
use crate::common::fingerprint::Fingerprint;
use crate::common::load::load;

const SEED: u64 = 3;
/// In the air after 5 s.
const TICKS: u32 = 12_000;

fn start(scenario: &Scenario) -> Flight<RigidBody> {
    flight::lockstep(scenario, SEED, flight::rigid_body(scenario, SEED)).expect("can be flown")
}

/// Flies `outdoor-hover`, and lets other sensors see the same flight; what each of these has delivered.
fn watch(mut suites: Vec<Suite>) -> Vec<Vec<Measurements>> {
    let mut flight = start(&load("outdoor-hover", &[]));
    let mut delivered: Vec<Vec<Measurements>> = suites.iter().map(|_| Vec::new()).collect();
    for tick in 0..TICKS {
        let motion = flight.plant().motion();
        let battery = flight.plant().battery().expect("flies on one");
        let truth = Truth {
            tick,
            motion: &motion,
            specific_force: flight.specific_force(),
            omega: flight.plant().omega(),
            battery: BatteryTruth { voltage_v: battery.voltage_v, current_a: battery.current_a },
        };
        for (suite, delivered) in suites.iter_mut().zip(&mut delivered) {
            delivered.push(suite.measure(&truth));
        }
        assert!(flight.step(&mut ()));
    }
    assert!(flight.plant().motion().position.z > 5.0, "it has taken off");
    delivered
}

fn suite(table: &str, faults: &[Fault]) -> Suite {
    let parts = SuiteFile::from_table(table.parse().expect("TOML")).expect("valid");
    Suite::new(&parts, &load("outdoor-hover", &[]).file.home, faults, SEED)
}

/// Whether two flights' samples of a sensor are the same, bit for bit; there must be some.
fn same<T: PartialEq>(a: &[Measurements], b: &[Measurements], of: impl Fn(&Measurements) -> Option<T>) -> bool {
    assert!(a.iter().filter_map(&of).count() > 30);
    a.iter().map(&of).eq(b.iter().map(&of))
}

#[test]
fn sensors_do_not_know_of_each_other() {
    let with_pose = "suite = \"gnss\"\npose.part = \"mocap\"";
    let faults =
        ["sensor='mag', kind='noise', sigma=3.0, from_s=2", "sensor='gnss', kind='loss', probability=0.3, from_s=2"];
    let faults = faults.map(fault);
    let delivered = watch(vec![
        suite("suite = \"gnss\"", &[]),
        suite(with_pose, &[]),
        suite("suite = \"gnss\"\nmag = false", &[]),
        suite("suite = \"gnss\"", &faults),
    ]);
    let [plain, more, fewer, faulty] = &delivered[..] else { panic!("four suites") };
    for (name, other) in [("more", more), ("fewer", fewer), ("faulty", faulty)] {
        assert!(same(plain, other, |m| m.imu), "{name}");
        assert!(same(plain, other, |m| m.baro), "{name}");
        assert!(same(plain, other, |m| m.battery), "{name}");
        assert!(same(plain, other, |m| m.gnss) == (name != "faulty"), "{name}");
        assert!(same(plain, other, |m| m.mag) == (name == "more"), "{name}");
    }
    // What the fault has left of the receiver's solutions is as it was.
    let kept = faulty.iter().zip(plain).filter(|(faulty, _)| faulty.gnss.is_some());
    assert!(kept.clone().count() > 20 && kept.clone().all(|(faulty, plain)| faulty.gnss == plain.gnss));
}

/// Flies with a ground station that talks and listens, or without one.
fn fly(listens: bool) -> ([u64; 2], usize) {
    let mut flight = start(&load("outdoor-hover", &[]));
    let (mut seen, mut heard) = (Fingerprint::default(), 0);
    if listens {
        flight.autopilot.ports.first().open(Profile::Normal);
    }
    for tick in 0..TICKS {
        if listens && tick % GROUND.period == 0 {
            // No message among them.
            flight.autopilot.ports.first().receive(&tick.wrapping_mul(0x9e37_79b9).to_le_bytes());
        }
        assert!(flight.step(&mut seen));
        heard += flight.autopilot.ports.first().take(&mut [0; 2048]).len();
    }
    (seen.hashes(), heard)
}

#[test]
fn a_flight_is_the_same_whether_a_ground_station_listens() {
    let ((alone, _), (watched, heard)) = (fly(false), fly(true));
    assert!(heard > 10_000, "{heard} bytes of telemetry");
    assert_eq!(alone, watched);
}
