//! Nothing allocates in the lockstep loop: firmware with all partitions, plant, noise, metrics, score and the MAVLink bytes.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use firmware::mavlink::Ground;
use firmware::mavlink::port::Profile;
use firmware::schedule::GROUND;
use sim_host::flight;
use sim_host::plant::rigid_body::RigidBody;
use sim_host::record::Recorder;
use sim_host::report::{Metrics, TruthWriter};
use sim_host::scenario::Scenario;
use sim_host::score::Scorer;
use sim_host::sil::{Flight, Lockstep as _};

/// The system's allocator, counting.
struct Counting;

thread_local! {
    /// Of this thread: the test runner's own threads allocate when they like.
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

fn allocated() -> u64 {
    ALLOCATIONS.with(Cell::get)
}

fn count() {
    // A thread that ends may still allocate.
    let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
}

// Counting what the system's allocator is asked for needs an allocator, and its trait is unsafe: every call is passed
// on as it came.
#[allow(unsafe_code)]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        unsafe { System.dealloc(place, layout) }
    }

    unsafe fn realloc(&self, place: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        unsafe { System.realloc(place, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Bytes of noise that a link may bring: every job of the ground partition parses some.
fn noise(tick: u32) -> [u8; 8] {
    (u64::from(tick).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0xfd).to_le_bytes()
}

/// Flies `ticks` ticks with a talking ground station; returns how many bytes the firmware sent.
fn fly(flight: &mut Flight<RigidBody>, ticks: u32, recorder: &mut impl Recorder) -> usize {
    let mut sent = 0;
    for tick in 0..ticks {
        if tick % GROUND.period == 0 {
            flight.autopilot.ports.first().receive(&noise(tick));
        }
        assert!(flight.step(recorder));
        sent += flight.autopilot.ports.first().take(&mut [0; 2048]).len();
    }
    sent
}

/// How many allocations 5 s of a flight take, and how many bytes it sends in them, a second after it has begun.
fn allocations(scenario: &Scenario, from_ticks: u32) -> (u64, usize) {
    let before = allocated();
    let mut flight = flight::lockstep(scenario, 1, flight::rigid_body(scenario, 1)).expect("can be flown");
    assert!(allocated() > before, "the counter counts");
    flight.autopilot.ground = Ground::default();
    flight.autopilot.ports.first().open(Profile::Normal);

    let mut recorder = ((Metrics::new(), TruthWriter::hash_only()), Scorer::new(scenario));
    fly(&mut flight, from_ticks, &mut recorder);
    let before = allocated();
    let sent = fly(&mut flight, 5_000, &mut recorder);
    (allocated() - before, sent)
}

#[test]
fn five_seconds_of_flight_allocate_nothing() {
    on_ideal_state();
    on_sensors();
}

/// All that a suite has, each with a fault, and one of a rotor and of the battery, in a climb by a pilot's command.
fn on_sensors() {
    let faults = [
        "sensor='imu',kind='loss',probability=0.1",
        "sensor='imu',kind='disorder'",
        "sensor='gyro',kind='spikes',probability=0.001,size=3.0",
        "sensor='accel',kind='noise',sigma=0.1",
        "sensor='mag',kind='duplicate',probability=0.2",
        "sensor='baro',kind='stuck'",
        "sensor='baro',kind='delayed',extra_s=0.1",
        "sensor='gnss',kind='glitch',size_m=30.0",
        "sensor='gnss',kind='delayed',extra_s=0.05",
        "sensor='gnss',kind='time-jump',shift_s=-0.02",
        "sensor='battery',kind='nan'",
        "kind='rotor',index=1,effectiveness=0.9",
        "kind='collapse',factor=0.95",
    ];
    let list: Vec<String> = faults.iter().map(|keys| format!("{{{},from_s=7.0}}", keys.replace('\'', "\""))).collect();
    let settings = [format!("fault=[{}]", list.join(","))];
    let scenario = Scenario::load("outdoor-hover", &settings).expect("valid");
    // From a second before the faults: their beginning counts.
    let (allocations, sent) = allocations(&scenario, 6_000);
    assert_eq!(allocations, 0);
    assert!(sent > 1_000, "telemetry was sent: {sent} bytes");
}

fn on_ideal_state() {
    let settings = ["disturbance.from_s=0", "disturbance.to_s=9", "disturbance.hold_s=0.001"]
        .into_iter()
        .chain(["disturbance.acceleration_m_s2=0.5", "disturbance.angle_output_rad=0.001"])
        .chain(["actuation_delay_s=0.002", "wind.turbulence_20ft_m_s=7.7"])
        .chain(["wind.gust=[{from_s=2.0,rise_s=0.5,peak_m_s=[2.0,0.0,0.0]}]"])
        .chain(["push=[{from_s=2.0,to_s=2.1,angular_acceleration_rad_s2=[5.0,0.0,0.0]}]"])
        .chain(["fault=[{kind=\"rotor\",index=0,effectiveness=0.95,from_s=3.0}]", "world.altitude_m=500.0"])
        .map(str::to_owned)
        .collect::<Vec<_>>();
    let scenario = Scenario::load("helix", &settings).expect("valid");
    let (allocations, sent) = allocations(&scenario, 1_000);
    assert_eq!(allocations, 0);
    assert!(sent > 1_000, "telemetry was sent: {sent} bytes");
}
