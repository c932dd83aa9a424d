//! What the project promises of flights on sensors: every scenario that says what is expected of it keeps its word, and
//! whatever a sensor does wrong is borne as docs/estimator.md has it. Judged by the truth.

use std::collections::{BTreeMap, BTreeSet};

use firmware::autopilot::Autopilot;
use firmware::commander::Mode;
use nalgebra::{UnitQuaternion, Vector3};
use sim_host::assess::consistency::kind;
use sim_host::assess::{Expectation, ensemble};
use sim_host::flight;
use sim_host::record::{Navigation, Recorder, Row};
use sim_host::report::TimelineRecorder;
use sim_host::scenario::{self, Scenario};
use sim_host::score::Scorer;
use sim_host::seeds::Seeds;
use sim_host::sil::Lockstep as _;

use crate::common::fault::fault;
use crate::common::load::load;

/// The error of a trajectory that a pilot asked for is the distance from the trajectory itself, in each tick: guidance has it
/// at 250 Hz, and the vehicle flies 4 mm a tick.
#[test]
fn the_error_on_a_trajectory_is_the_distance_from_its_closed_form() {
    let scenario = load("indoor-helix", &["duration_s=25"]);
    let course = TimelineRecorder::new(&scenario.file.command, scenario.joined_s());
    let mut recorder = ((Vec::new(), Scorer::new(&scenario)), course);
    let outcome = flight::fly(&scenario, 1, &mut recorder).expect("it flies");
    let ((rows, scorer), course): ((Vec<Row>, Scorer), _) = recorder;
    let phase = course.finish(&[], &[]).timeline.phases.pop().expect("phases");
    assert_eq!(phase.name, "trajectory");
    let from_s = phase.from_s;
    let squared = |row: &Row| {
        // The helix of the scenario's file, on its own clock.
        let tau = row.t - (from_s - 4.0);
        let (sin, cos) = libm::sincos(tau);
        let helix = Vector3::new(4.0 * sin, 5.0 * cos, 2.0 + tau);
        (Vector3::from(row.position) - helix).norm_squared()
    };
    let judged: Vec<f64> = rows.iter().filter(|row| row.t >= from_s).map(squared).collect();
    let expected = (judged.iter().sum::<f64>() / judged.len() as f64).sqrt();
    for (rms, of) in [(phase.error_rms_m, "phase"), (scorer.score(&outcome).rms_m, "score")] {
        let rms = rms.expect("it is flown");
        assert!((rms / expected - 1.0).abs() < 0.01, "{of}: {rms} is not {expected}");
    }
    assert!(expected < 0.005, "{expected}");
}

/// Higher than this it is in the air, m: the ground pushes on a rotor as no failure does.
const IN_AIR_M: f64 = 0.3;

/// What a flight that hovers 10 m over its start has shown, from a time on.
#[derive(Debug)]
struct Seen {
    from_s: f64,
    /// Greatest distances from where it ought to be, m: across the ground, and of the height.
    away_m: f64,
    off_height_m: f64,
    /// Greatest errors of what was believed: tilt and heading (°), velocity (m/s), vertical velocity (m/s).
    tilt_deg: f64,
    heading_deg: f64,
    speed_m_s: f64,
    climb_m_s: f64,
    /// By kind of reading, the whole flight: how many, and how many refused.
    readings: BTreeMap<&'static str, (u32, u32)>,
    /// What it did in the air, and last of all.
    modes: BTreeSet<&'static str>,
    last_mode: Mode,
    /// Vertical speed when the ground was first touched after flying, downwards, m/s.
    touchdown_m_s: Option<f64>,
    flew: bool,
    is_finite: bool,
}

impl Seen {
    fn from(from_s: f64) -> Self {
        Self {
            from_s,
            away_m: 0.0,
            off_height_m: 0.0,
            tilt_deg: 0.0,
            heading_deg: 0.0,
            speed_m_s: 0.0,
            climb_m_s: 0.0,
            readings: BTreeMap::new(),
            modes: BTreeSet::new(),
            last_mode: Mode::Disarmed,
            touchdown_m_s: None,
            flew: false,
            is_finite: true,
        }
    }

    fn stays(&self) -> bool {
        self.modes == BTreeSet::from(["take-off", "hold"])
    }

    /// Whether it came down softly and has stopped its rotors.
    fn has_landed(&self) -> bool {
        self.last_mode == Mode::Disarmed && self.touchdown_m_s.is_some_and(|speed| speed < SOFT_M_S)
    }
}

impl Recorder for Seen {
    fn record(&mut self, row: &Row) {
        let [x, y, z] = row.position;
        self.is_finite &= row.omega_command.iter().all(|omega| omega.is_finite());
        self.flew |= z > 5.0;
        if self.flew && z < 0.02 {
            self.touchdown_m_s.get_or_insert(-row.velocity[2]);
        }
        if row.t >= self.from_s {
            self.away_m = self.away_m.max(libm::hypot(x, y));
            self.off_height_m = self.off_height_m.max((z - 10.0).abs());
        }
    }

    fn navigate(&mut self, navigation: &Navigation) {
        self.last_mode = navigation.commander.mode;
        if navigation.truth.position.z > IN_AIR_M {
            self.modes.insert(name(self.last_mode));
        }
        if navigation.t >= self.from_s {
            let (truth, nav) = (&navigation.truth, navigation.nav);
            let is = UnitQuaternion::new_normalize(truth.attitude);
            let error = (is * nav.attitude.cast::<f64>().inverse()).scaled_axis();
            let velocity: Vector3<f64> = truth.velocity - nav.velocity.cast();
            self.tilt_deg = self.tilt_deg.max(error.xy().norm().to_degrees());
            self.heading_deg = self.heading_deg.max(error.z.abs().to_degrees());
            self.speed_m_s = self.speed_m_s.max(velocity.xy().norm());
            self.climb_m_s = self.climb_m_s.max(velocity.z.abs());
        }
        for reading in navigation.filtered.into_iter().flat_map(|output| &output.consistency) {
            let (read, refused) = self.readings.entry(kind(reading.source).0).or_default();
            *read += 1;
            *refused += u32::from(!reading.verdict.accepted);
        }
    }
}

fn name(mode: Mode) -> &'static str {
    match mode {
        Mode::Disarmed => "disarmed",
        Mode::Idle => "idle",
        Mode::TakeOff => "take-off",
        Mode::Hold => "hold",
        Mode::Return => "return",
        Mode::Land => "land",
        Mode::Descent => "descent",
        Mode::MotorOut => "motor-out",
        Mode::GoTo
        | Mode::Velocity
        | Mode::Follow
        | Mode::Offboard
        | Mode::Orbit
        | Mode::Acro
        | Mode::Stabilized
        | Mode::Altitude
        | Mode::Position => "other",
    }
}

/// A minute of take-off and hover at 10 m in 5 m/s of wind and moderate turbulence.
fn hover(suite: &str, faults: &[&str]) -> Scenario {
    let mut scenario = load("outdoor-hover", &[&format!("sensors={suite}")]);
    scenario.file.duration_s = 60.0;
    scenario.file.fault = faults.iter().map(|keys| fault(keys)).collect();
    scenario
}

/// What a flight has shown from 20 s on, when it hovers; it must survive.
fn fly(scenario: &Scenario, seed: u64) -> Seen {
    let mut seen = Seen::from(20.0);
    let outcome = flight::fly(scenario, seed, &mut seen).expect("can be flown");
    assert!(outcome.survived() && seen.is_finite, "{:?} seed {seed}: {seen:?}", scenario.file.fault);
    seen
}

/// Names of what is expected of a scenario and not met under so many seeds.
fn unmet(scenario: &Scenario, seeds: u64, is_judged: impl Fn(&Expectation) -> bool) -> Vec<String> {
    let report = ensemble::fly(scenario, Seeds { first: 1, last: seeds }, || ()).expect("can be flown");
    let unmet =
        report.verdicts.iter().filter(|verdict| is_judged(&verdict.expected) && !verdict.expected.holds(verdict.found));
    unmet.map(|verdict| format!("{}: {verdict:?}", scenario.name)).collect()
}

#[test]
fn scenarios_are_as_they_are_expected_to_be() {
    let mut failed = Vec::new();
    for listed in scenario::list().expect("all load") {
        let scenario = load(listed.name, &[]);
        // A day has a test of its own.
        if scenario.file.assess.is_none() || listed.name == "day" {
            continue;
        }
        // Of four seeds the worst stands for every percentile above the 75th.
        failed.extend(unmet(&scenario, 4, |expected| expected.percentile.is_some()));
        // Heading is off by one number a seed: its root mean square over n of them scatters by 1/√2n.
        if scenario.file.assess.iter().flat_map(|assess| &assess.expect).any(|expected| expected.percentile.is_none()) {
            failed.extend(unmet(&scenario, 16, |expected| expected.percentile.is_none()));
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// Readings as late as they may be, between two jobs of the filter (125 ms are no multiple of 4), are all fused.
#[test]
fn readings_of_the_greatest_latency_are_fused() {
    let late = ["sensors.gnss.rate_hz=8", "sensors.gnss.delay_s=0.249", "sensors.gnss.jitter_s=0", "duration_s=60"];
    let seen = fly(&load("outdoor-hover", &late), 1);
    // Two kinds of reading a solution, 8 times a second from the alignment, after 1 s to 2 s, on.
    for kind in ["gnss-position", "gnss-velocity"] {
        assert!(seen.readings[kind].0 >= 8 * 58 && seen.flew, "{kind}: {seen:?}");
    }
}

/// A filter is as wrong as it believes to be. Of a mean over thousands of innovations chance moves nothing; a quarter
/// is what gusts leave of the noise that drag is said to have. Errors of a flight are much the same all along, so that
/// twelve flights are some twelve times nine numbers: √(2/108) = 0.14 about 1 at the least, and more, since a place's
/// error is one draw an axis; and a filter that is told more noise than there is, which a sound one is, lies below 1.
#[test]
fn errors_and_innovations_are_as_large_as_believed() {
    for (name, suite) in [("outdoor-hover", "gnss"), ("outdoor-eight", "gnss"), ("indoor-hover", "mocap")] {
        let settings = [&format!("sensors={suite}"), "duration_s=70", "assess.from_s=35", "assess.to_s=70"];
        let report = ensemble::fly(&load(name, &settings), Seeds { first: 1, last: 12 }, || ()).expect("can be flown");
        assert!(report.nis.len() >= 4, "{name}: {:?}", report.nis);
        for nis in &report.nis {
            let mean = nis.mean;
            assert!((0.8..=1.25).contains(&mean) && nis.refused == 0.0, "{name}: {nis:?}");
        }
        let nees = report.nees.expect("looked at");
        assert!((0.6..=1.6).contains(&nees.mean), "{name}: {nees:?}");
    }
}

/// What is to hold of a hover from 20 s on: distances across the ground and of the height, m, and the believed tilt's error, °.
#[derive(Clone, Copy)]
struct Bounds {
    away_m: f64,
    off_height_m: f64,
    tilt_deg: f64,
}

/// Of a sound vehicle. In 40 s a receiver's place wanders by 1.2 m √(2·40/1800) = 0.25 m an axis, and the vehicle with it:
/// 4 σ. The barometer's by 0.3 m √(2·40/3600) = 0.045 m, from where it stood when the target was set some 20 s earlier, with
/// what its warming leaves: 0.2 Pa, 0.02 m. Roll and pitch are known to 1.5 mrad of the accelerometer's bias, 0.1° an axis.
const SOUND: Bounds = Bounds { away_m: 1.0, off_height_m: 0.3, tilt_deg: 0.6 };
/// A touchdown no harder than this, m/s: landings sink at 0.7 m/s or less near the ground.
const SOFT_M_S: f64 = 0.8;

/// Each fault under two seeds: the vehicle stays where it is.
fn assert_borne(faults: &[&str], bounds: Bounds) {
    for keys in faults {
        for seed in [1, 2] {
            let seen = fly(&hover("gnss", &[keys]), seed);
            let held = seen.away_m < bounds.away_m && seen.off_height_m < bounds.off_height_m;
            assert!(held && seen.tilt_deg < bounds.tilt_deg && seen.stays(), "{keys} seed {seed}: {seen:?}");
        }
    }
}

/// Each fault under two seeds: the vehicle comes down near its start, softly, in a mode that says why.
fn assert_lands(faults: &[&str], mode: &str, away_m: f64) {
    for keys in faults {
        for seed in [1, 2] {
            let seen = fly(&hover("gnss", &[keys]), seed);
            let as_told = seen.modes.contains(mode) && !seen.modes.contains("motor-out");
            assert!(as_told && seen.has_landed() && seen.away_m < away_m, "{keys} seed {seed}: {seen:?}");
        }
    }
}

#[test]
fn a_sound_vehicle_refuses_nothing_in_hover() {
    for (suite, seed) in [("gnss", 1), ("gnss", 2), ("gnss", 3), ("gnss", 4), ("rtk", 1), ("mocap", 1), ("mocap", 2)] {
        let seen = fly(&hover(suite, &[]), seed);
        assert!(
            seen.stays() && seen.away_m < SOUND.away_m && seen.tilt_deg < SOUND.tilt_deg,
            "{suite} {seed}: {seen:?}"
        );
        // Some thousand readings a flight, of which chance puts one in 1.7 million beyond the gate.
        let sound = |name: &&str| !matches!(*name, "rest" | "drag");
        let refused: Vec<_> = seen.readings.iter().filter(|(name, (_, refused))| sound(name) && *refused > 0).collect();
        assert!(refused.is_empty(), "{suite} {seed}: {refused:?} of {:?}", seen.readings);
        assert!(seen.readings.values().map(|(read, _)| read).sum::<u32>() > 5_000, "{:?}", seen.readings);
    }
}

#[test]
fn samples_lost_repeated_or_out_of_order_are_hardly_felt() {
    let faults = [
        "sensor='imu', kind='loss', probability=0.2, from_s=5",
        "sensor='imu', kind='duplicate', probability=0.2, from_s=5",
        "sensor='imu', kind='disorder', from_s=5",
        "sensor='gnss', kind='loss', probability=0.2, from_s=5",
        "sensor='gnss', kind='duplicate', probability=0.3, from_s=5",
        "sensor='gnss', kind='disorder', from_s=5",
        "sensor='baro', kind='duplicate', probability=0.3, from_s=5",
        "sensor='baro', kind='disorder', from_s=5",
        "sensor='mag', kind='duplicate', probability=0.3, from_s=5",
        "sensor='mag', kind='disorder', from_s=5",
    ];
    // A sample of the gyroscope in five missing, its last one in its place: noise at 1 kHz, not an error that grows.
    assert_borne(&faults, Bounds { tilt_deg: 1.0, ..SOUND });
}

#[test]
fn an_imu_that_is_silent_or_stuck_for_50_ms_leaves_a_turn_of_its_last_rates() {
    let faults = [
        "sensor='imu', kind='off', from_s=25, to_s=25.04",
        "sensor='imu', kind='nan', from_s=25, to_s=25.04",
        "sensor='imu', kind='stuck', from_s=25, to_s=25.05",
        "sensor='gyro', kind='stuck', from_s=25, to_s=25.05",
        "sensor='accel', kind='stuck', from_s=25, to_s=25.05",
    ];
    // Rates of up to 1 rad/s in moderate turbulence, off for 50 ms: 2.9°.
    assert_borne(&faults, Bounds { tilt_deg: 3.0, ..SOUND });
}

#[test]
fn stamps_that_jump_within_what_is_remembered_are_readings_of_another_time() {
    // In hover at some dm/s, 0.1 s is some cm. What lies in the future is refused: one such GNSS reading arrives 0.15 s old.
    let faults = [
        "sensor='gnss', kind='time-jump', shift_s=-0.05, from_s=25",
        "sensor='gnss', kind='time-jump', shift_s=0.1, from_s=25, to_s=35",
        "sensor='baro', kind='time-jump', shift_s=-0.1, from_s=25, to_s=35",
        "sensor='mag', kind='time-jump', shift_s=-0.01, from_s=25, to_s=35",
        "sensor='gnss', kind='delayed', extra_s=0.1, from_s=25",
        "sensor='gnss', kind='delayed', extra_s=0.1, from_s=25, to_s=35",
    ];
    assert_borne(&faults, SOUND);
    // A gust turns roll or pitch by degrees in 0.1 s, and the steep field with them.
    let turned = ["sensor='mag', kind='time-jump', shift_s=-0.1, from_s=25, to_s=35"];
    assert_borne(&turned, Bounds { tilt_deg: 1.5, ..SOUND });
}

#[test]
fn an_imu_clock_that_jumps_is_not_felt() {
    // Its samples are taken as of the tick in which they come. Back by less than 20 ms, they count as out of order until
    // the clock has caught up.
    let shifts = ["-10.0", "-1.0", "-0.1", "-0.01", "0.01", "0.1", "1.0", "10.0"];
    let faults = shifts.map(|shift| format!("sensor='imu', kind='time-jump', shift_s={shift}, from_s=25, to_s=35"));
    assert_borne(&faults.each_ref().map(String::as_str), SOUND);
}

#[test]
fn a_barometer_that_is_gone_leaves_the_height_to_satellites() {
    let faults = [
        "sensor='baro', kind='off', from_s=25",
        "sensor='baro', kind='nan', from_s=25, to_s=45",
        "sensor='baro', kind='stuck', from_s=25",
        "sensor='baro', kind='time-jump', shift_s=0.1, from_s=25",
        "sensor='baro', kind='time-jump', shift_s=1.0, from_s=25, to_s=35",
        "sensor='baro', kind='time-jump', shift_s=-1.0, from_s=25, to_s=35",
        "sensor='baro', kind='time-jump', shift_s=-10.0, from_s=25",
        "sensor='baro', kind='time-jump', shift_s=10.0, from_s=25",
        // On the way up, where a height that stood still would be the end of the climb or of the vehicle.
        "sensor='baro', kind='stuck', from_s=6",
    ];
    // In 50 s the satellites' height wanders by 2 m √(2·50/1800) = 0.47 m: 3 σ.
    assert_borne(&faults, Bounds { off_height_m: 1.4, ..SOUND });
}

#[test]
fn a_magnetometer_that_is_gone_leaves_the_heading_to_the_gyroscope() {
    let faults = [
        "sensor='mag', kind='off', from_s=25",
        "sensor='mag', kind='nan', from_s=25, to_s=45",
        "sensor='mag', kind='stuck', from_s=25",
        "sensor='mag', kind='time-jump', shift_s=0.1, from_s=25",
        "sensor='mag', kind='time-jump', shift_s=1.0, from_s=25, to_s=35",
        "sensor='mag', kind='time-jump', shift_s=-1.0, from_s=25",
        "sensor='mag', kind='time-jump', shift_s=10.0, from_s=25",
        "sensor='mag', kind='time-jump', shift_s=-10.0, from_s=25, to_s=35",
    ];
    assert_borne(&faults, SOUND);
    // The bias about the vertical is known to 0.02 °/s after 20 s: 0.7° in 35 s beside the 0.5° of the magnetometer itself.
    for keys in faults {
        let seen = fly(&hover("gnss", &[keys]), 3);
        assert!(seen.heading_deg < 2.5, "{keys}: {seen:?}");
    }
}

#[test]
fn spikes_are_refused_or_as_small_as_their_millisecond() {
    let refused = [
        "sensor='gnss', kind='spikes', probability=0.1, size=30.0, from_s=5",
        "sensor='baro', kind='spikes', probability=0.1, size=300.0, from_s=5",
        "sensor='mag', kind='spikes', probability=0.1, size=30.0, from_s=5",
        "sensor='battery', kind='spikes', probability=0.5, size=10.0, from_s=5",
        // Beyond what an IMU can read.
        "sensor='gyro', kind='spikes', probability=0.01, size=1000.0, from_s=5",
        "sensor='gyro', kind='spikes', probability=0.001, size=1e6, from_s=5",
        "sensor='accel', kind='spikes', probability=0.01, size=1000.0, from_s=5",
        "sensor='accel', kind='spikes', probability=0.001, size=1e6, from_s=5",
    ];
    assert_borne(&refused, SOUND);
    // Within it: 5 rad/s and 100 m/s² for a millisecond are 0.3° and 0.1 m/s, once a second; three in a row add up.
    let felt = [
        "sensor='gyro', kind='spikes', probability=0.001, size=5.0, from_s=20",
        "sensor='accel', kind='spikes', probability=0.001, size=100.0, from_s=20",
    ];
    assert_borne(&felt, Bounds { off_height_m: 0.5, tilt_deg: 1.5, ..SOUND });
}

#[test]
fn ten_times_the_noise_is_flown() {
    // Ten times the deviations of the parts' data sheets, a sample.
    let faults = [
        "sensor='gnss', kind='noise', sigma=1.0, from_s=5",
        "sensor='baro', kind='noise', sigma=9.3, from_s=5",
        "sensor='mag', kind='noise', sigma=3.0, from_s=5",
        "sensor='gyro', kind='noise', sigma=0.011, from_s=5",
        "sensor='accel', kind='noise', sigma=0.15, from_s=5",
    ];
    // A filter that believes its readings ten times too much follows them: 0.8 m of a barometer's, averaged over some 10,
    // 0.08 rad of a heading's, of which the slope of the field, 2, makes tilt.
    assert_borne(&faults, Bounds { away_m: 1.5, off_height_m: 1.0, tilt_deg: 2.0 });
}

#[test]
fn satellites_that_jump_do_not_take_the_vehicle_along() {
    let faults = [
        "sensor='gnss', kind='glitch', size_m=50.0, from_s=25",
        "sensor='gnss', kind='glitch', size_m=50.0, from_s=25, to_s=40",
        "sensor='gnss', kind='glitch', size_m=50000.0, from_s=25, to_s=40",
        // Up and down, which the barometer knows better.
        "sensor='gnss', kind='glitch', size_m=50.0, direction=[0.0, 0.0, -1.0], from_s=25, to_s=40",
    ];
    // On the velocity alone while it is refused, 2.5 s twice, and then from where that has led.
    assert_borne(&faults, Bounds { away_m: 1.2, ..SOUND });
}

#[test]
fn without_satellites_it_comes_down_where_it_is() {
    let faults = [
        "sensor='gnss', kind='off', from_s=25",
        "sensor='gnss', kind='nan', from_s=25",
        "sensor='gnss', kind='no-fix', from_s=25",
        "sensor='gnss', kind='stuck', from_s=25",
        "sensor='gnss', kind='time-jump', shift_s=1.0, from_s=25",
        "sensor='gnss', kind='time-jump', shift_s=10.0, from_s=25",
        "sensor='gnss', kind='time-jump', shift_s=-1.0, from_s=25",
        "sensor='gnss', kind='time-jump', shift_s=-10.0, from_s=25",
    ];
    // 20 s on the accelerometer and on drag, in gusts: 0.2 m/s.
    assert_lands(&faults, "descent", 4.0);
}

#[test]
fn a_battery_that_collapses_ends_the_flight_softly() {
    // Four full cells, 16.8 V, of which hover takes 0.4 V: the factors leave 14.7 V, at which it is to return, and 13.8 V,
    // at which it is to land.
    for (factor, mode) in [(0.9, "return"), (0.85, "land")] {
        for seed in [1, 2] {
            let scenario = hover("gnss", &[&format!("kind='collapse', factor={factor}, from_s=25")]);
            let mut config = scenario.flight_config();
            config.modes.battery_low_v = 15.0;
            config.modes.battery_critical_v = 14.2;
            config.modes.return_height_m = 10.0;
            let mut flight =
                flight::lockstep(&scenario, seed, flight::rigid_body(&scenario, seed)).expect("can be flown");
            flight.autopilot = Autopilot::new(&config).expect("can be flown");
            let mut seen = Seen::from(20.0);
            let outcome = flight.run(scenario.ticks(), &mut seen);
            assert!(outcome.survived() && seen.has_landed() && seen.away_m < SOUND.away_m, "{factor} {seed}: {seen:?}");
            assert!(seen.modes.contains(mode) && !seen.modes.contains("motor-out"), "{factor} {seed}: {seen:?}");
        }
    }
}

#[test]
fn a_battery_monitor_that_fails_alone_ends_no_flight() {
    let faults = [
        "sensor='battery', kind='off', from_s=25",
        "sensor='battery', kind='nan', from_s=25",
        "sensor='battery', kind='stuck', from_s=25",
    ];
    assert_borne(&faults, SOUND);
}
