//! The images under QEMU against the same code on the desktop. Ignored by default, because they need the images
//! (`cargo fw && cargo fw-pil`) and `qemu-system-arm`; `tests/run` builds them and asks for these tests.

use std::process::Command;
use std::time::{Duration, Instant};

use firmware::autopilot::Autopilot;
use firmware::commander::Mode;
use firmware::config::{FlightConfig, Start};
use firmware::guidance::Trajectory;
use firmware::mavlink::port::LinkEvent;
use firmware::pil::{AllSent, Cause};
use firmware::signals::{NavState, SensorFrame, TICK_S};
use glissade_dialect::{SET_ATTITUDE_TARGET_DATA, SET_POSITION_TARGET_LOCAL_NED_DATA};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use sim_host::flight;
use sim_host::pil::{
    BusyWait, Difference, Fault, Overrun, Pil, PilOptions, SentDiffers, Stopped, compare, compare_sent,
};
use sim_host::plant::Motion;
use sim_host::scenario::Scenario;
use sim_host::sensors::{BatteryTruth, Suite, Truth};
use sim_host::sil::replay::{Entry, Input, OnLink};

use crate::common::by_bytes::{ACRO, ALTITUDE, Bytes, DOWN, OFFBOARD, POSITION, STABILIZED};
use crate::common::image::image;
use crate::common::station::flight_by_two;

const TICKS: u32 = 20_000;

fn config() -> FlightConfig {
    FlightConfig { trajectory: Trajectory::PAPER_HELIX, start: Start::InFlight, ..FlightConfig::default() }
}

/// A made-up motion that stays near the helix and turns all angles, now and then so wildly that the mixer limits.
fn motion(tick: u32) -> SensorFrame {
    let t = tick as f32 * TICK_S;
    let wobble = |rate: f32, size: f32| (rate * t).sin() * size;
    let half = Vector3::new(wobble(1.3, 0.15), wobble(1.7, 0.2), wobble(0.4, 0.6));
    let attitude = UnitQuaternion::new_normalize(Quaternion::new(1.0, half.x, half.y, half.z));
    let position = Vector3::new(4.0 * t.sin() + wobble(3.0, 0.1), 5.0 * t.cos() + wobble(2.0, 0.1), 2.0 + t);
    let velocity = Vector3::new(4.0 * t.cos(), -5.0 * t.sin(), 1.0 + wobble(2.5, 0.3));
    let rates = Vector3::new(wobble(5.0, 0.5), wobble(6.0, 0.4), wobble(4.0, 2.0));
    SensorFrame::Motion(NavState { position, velocity, attitude, rates })
}

/// Flies the made-up motion on both sides.
fn lockstep(options: &PilOptions, ticks: u32) -> anyhow::Result<()> {
    lockstep_with(options, ticks, |_, _| {})
}

/// The motion in a frame that is one.
fn nav_of(sample: &mut SensorFrame) -> &mut NavState {
    match sample {
        SensorFrame::Motion(nav) => nav,
        SensorFrame::Measured(_) => panic!("made of motions"),
    }
}

/// The same, with something done to the image's samples.
fn lockstep_with(options: &PilOptions, ticks: u32, disturb: fn(u32, &mut SensorFrame)) -> anyhow::Result<()> {
    let mut sil = Autopilot::new(options.config).expect("valid");
    let mut pil = Pil::start(options)?;
    let started = Instant::now();
    for tick in 0..ticks {
        let mut sample = motion(tick);
        if tick == 5_000 {
            nav_of(&mut sample).rates.x = f32::NAN;
        }
        let missing = tick % 997 == 500;
        sil.tick((!missing).then_some(&sample));
        disturb(tick, &mut sample);
        let output = if missing { pil.tick_without_sample()? } else { pil.tick(&sample)? };
        compare(&sil.inner, &output)?;
    }
    println!("{:.1} µs a tick", started.elapsed().as_secs_f64() * 1e6 / f64::from(ticks));
    pil.finish()
}

#[test]
#[ignore = "needs the images and QEMU"]
fn twenty_thousand_ticks_are_the_same_bit_for_bit() {
    let config = config();
    lockstep(&PilOptions::new(image("mps2-pil"), &config), TICKS).expect("the same");
    // Observers, lead, inversion of yaw, and what adapts.
    let x500 = Scenario::load("x500-helix", &[]).expect("valid").flight_config();
    lockstep(&PilOptions::new(image("mps2-pil"), &x500), TICKS / 2).expect("the same");
}

/// A made-up motion that stands for 2 s and then sways, climbs and turns, with the specific force that belongs to it.
fn swaying(tick: u32) -> (Motion, Vector3<f64>) {
    let t = f64::from(tick.saturating_sub(2_000)) * 1e-3;
    // c (1 − cos ωt) and its derivatives.
    let sway = |c: f64, w: f64| {
        let (sin, cos) = libm::sincos(w * t);
        [c * (1.0 - cos), c * w * sin, if t > 0.0 { c * w * w * cos } else { 0.0 }]
    };
    let [x, y, z, yaw] = [sway(3.0, 0.8), sway(-2.0, 0.5), sway(0.5, 1.1), sway(0.5, 1.0)];
    let attitude = Quaternion::from_parts(libm::cos(0.5 * yaw[0]), Vector3::z() * libm::sin(0.5 * yaw[0]));
    let motion = Motion {
        position: Vector3::new(x[0], y[0], z[0]),
        velocity: Vector3::new(x[1], y[1], z[1]),
        attitude,
        rates: Vector3::new(0.0, 0.0, yaw[1]),
    };
    let force = UnitQuaternion::new_unchecked(attitude).inverse() * Vector3::new(x[2], y[2], z[2] + 9.81);
    (motion, force)
}

/// What a scenario's sensors make of it, now and then of no number.
fn measured(suite: &mut Suite, tick: u32) -> SensorFrame {
    let (motion, specific_force) = swaying(tick);
    let truth = Truth { tick, motion: &motion, specific_force, omega: [600.0; 4], battery: BatteryTruth::default() };
    let mut measured = suite.measure(&truth);
    if let (3_000..3_020, Some(imu)) = (tick, &mut measured.imu) {
        imu.gyro.y = f32::NAN;
    }
    if let (7_000..8_000, Some(gnss)) = (tick, &mut measured.gnss) {
        gnss.velocity.x = f32::INFINITY;
    }
    SensorFrame::Measured(measured)
}

#[test]
#[ignore = "needs the images and QEMU"]
fn navigation_on_sensors_is_the_same_bit_for_bit() {
    for name in ["outdoor-hover", "indoor-hover"] {
        let scenario = Scenario::load(name, &[]).expect("valid");
        let config = FlightConfig { start: Start::InFlight, ..scenario.flight_config() };
        let parts = scenario.file.sensors.as_ref().expect("on sensors");
        let mut suite = Suite::new(parts, &scenario.file.home, &[], 1);
        let mut sil = Autopilot::new(&config).expect("valid");
        let mut pil = Pil::start(&PilOptions::new(image("mps2-pil"), &config)).expect("boots");
        for tick in 0..TICKS {
            let sample = measured(&mut suite, tick);
            let missing = tick % 997 == 500;
            sil.tick((!missing).then_some(&sample));
            let output = if missing { pil.tick_without_sample() } else { pil.tick(&sample) };
            compare(&sil.inner, &output.expect("no overrun")).unwrap_or_else(|error| panic!("{name}: {error}"));
        }
        assert!(sil.inner.nav_health().attitude, "{name}: it was a flight on sensors");
        pil.finish().expect("ends");
    }
}

/// Flies a scenario by what comes on its links, on both sides: what is sent, and the modes that were flown. `disturb`
/// changes what the image hears.
fn by_bytes(
    name: &str,
    entries: Vec<Entry>,
    ticks: u32,
    disturb: fn(&mut Vec<u8>),
) -> anyhow::Result<(AllSent, Vec<Mode>)> {
    // Settings that have no place in the configuration, too.
    let set = ["params.BAT1_N_CELLS=5", "params.COM_DL_LOSS_T=7"].map(str::to_owned);
    let mut scenario = Scenario::load(name, &set).expect("valid");
    scenario.replay = Some(entries.into());
    let config = scenario.flight_config();
    let mut sil = flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("flies");
    let settings = scenario.settings();
    let options = PilOptions { settings, injectable: sil.injectable(), ..PilOptions::new(image("mps2-pil"), &config) };
    let mut pil = Pil::start(&options)?;
    let mut modes = Vec::new();
    for tick in 0..ticks {
        for entry in sil.hear_replayed() {
            match &entry.input {
                Input::Link { link, event: OnLink::Received(bytes) } => {
                    let mut bytes = bytes.clone();
                    disturb(&mut bytes);
                    pil.link(*link, LinkEvent::Received(&bytes))?;
                }
                Input::Link { link, event } => pil.link(*link, event.event())?,
                Input::Ask(asked) => pil.ask(*asked)?,
            }
        }
        let sample = sil.sense();
        sil.autopilot.tick(Some(&sample));
        sil.send_replayed();
        let output = pil.tick(&sample)?;
        compare(&sil.autopilot.inner, &output)?;
        compare_sent(tick, &sil.sent(), &output.sent)?;
        modes.push(sil.autopilot.inner.commander_output().mode);
        sil.actuate(&output.motors, output.saturated);
    }
    pil.finish()?;
    Ok((sil.sent(), modes))
}

/// By two ground stations.
fn by_stations(name: &str, ready_s: f64, ticks: u32, disturb: fn(&mut Vec<u8>)) -> anyhow::Result<AllSent> {
    let (sent, modes) = by_bytes(name, flight_by_two(ready_s), ticks, disturb)?;
    for mode in [Mode::TakeOff, Mode::Hold, Mode::Return, Mode::Land, Mode::Idle] {
        assert!(modes.contains(&mode), "{name}: {mode:?}");
    }
    Ok(sent)
}

#[test]
#[ignore = "needs the images and QEMU"]
fn a_flight_by_mavlink_alone_and_all_that_is_sent_are_the_same_bit_for_bit() {
    for (name, ready_s) in [("pad", 0.4), ("field", 3.0)] {
        let sent = by_stations(name, ready_s, 24_000, |_| {}).unwrap_or_else(|error| panic!("{name}: {error:#}"));
        assert!(sent[0].bytes > 20_000 && sent[1].bytes > 60_000, "{name}: {sent:?}");
    }
}

#[test]
#[ignore = "needs the images and QEMU"]
fn a_flight_by_sticks_is_the_same_bit_for_bit_in_every_manual_mode() {
    let mut bytes = Bytes::new(1);
    bytes.sticks(0.5, DOWN);
    bytes.mode(STABILIZED, 0.0);
    bytes.sticks(0.2, DOWN);
    bytes.arm();
    bytes.sticks(0.5, DOWN);
    bytes.sticks(1.2, [0.1, 0.1, 0.5, 0.2]);
    for number in [ALTITUDE, ACRO, POSITION] {
        bytes.mode(number, 0.0);
        bytes.stir(1.5, -0.2..0.5);
    }
    let ticks = bytes.now;
    let (_, modes) = by_bytes("pad", bytes.into_entries(), ticks, |_| {}).expect("the same");
    for mode in [Mode::Stabilized, Mode::Altitude, Mode::Acro, Mode::Position] {
        assert!(modes.contains(&mode), "{mode:?}");
    }
}

#[test]
#[ignore = "needs the images and QEMU"]
fn a_flight_by_set_points_is_the_same_bit_for_bit() {
    let mut bytes = Bytes::new(2);
    bytes.wait(3.0);
    let up = SET_POSITION_TARGET_LOCAL_NED_DATA { z: -3.0, type_mask: 0b111 << 6, ..Default::default() };
    bytes.stream(0.5, |_| up.clone());
    bytes.mode(OFFBOARD, 0.0);
    bytes.arm();
    bytes.stream(3.0, |_| up.clone());
    bytes.scatter(5.0);
    bytes.attitude(
        0.5,
        &SET_ATTITUDE_TARGET_DATA { q: [0.995, 0.0, 0.0998, 0.0], thrust: 0.5, type_mask: 7, ..Default::default() },
    );
    let ticks = bytes.now;
    let (_, modes) = by_bytes("field", bytes.into_entries(), ticks, |_| {}).expect("the same");
    assert_eq!(modes.last(), Some(&Mode::Offboard));
}

/// Or the tests above could not fail.
#[test]
#[ignore = "needs the images and QEMU"]
fn a_byte_that_a_station_sends_to_one_side_only_is_found_in_what_is_sent_back() {
    let error = by_stations("pad", 0.4, 3_000, |bytes| {
        if let Some(last) = bytes.last_mut() {
            *last ^= 1;
        }
    });
    let error = error.expect_err("heard differently");
    assert!(error.is::<SentDiffers>() || error.is::<Difference>(), "{error:#}");
}

/// Or the tests above could not fail.
#[test]
#[ignore = "needs the images and QEMU"]
fn a_sample_that_is_a_little_off_is_found_and_named() {
    let config = config();
    let error = lockstep_with(&PilOptions::new(image("mps2-pil"), &config), 100, |tick, sample| {
        if tick == 50 {
            let nav = nav_of(sample);
            nav.rates.x = f32::from_bits(nav.rates.x.to_bits() ^ 1);
        }
    });
    let error = error.expect_err("it is off");
    let difference = error.downcast_ref::<Difference>().unwrap_or_else(|| panic!("{error:#}"));
    assert_eq!((difference.tick, difference.field), (50, "p"));
}

#[test]
#[ignore = "needs the images and QEMU"]
fn a_busy_wait_shorter_than_the_output_offset_changes_no_bit() {
    let config = config();
    for busy in [
        BusyWait { outer_us: 1_500, ..BusyWait::default() },
        BusyWait { commander_us: 3_500, ..BusyWait::default() },
        BusyWait { ground_us: 5_500, ..BusyWait::default() },
        BusyWait { outer_us: 500, commander_us: 2_000, ground_us: 2_000 },
    ] {
        let options = PilOptions { busy, ..PilOptions::new(image("mps2-pil"), &config) };
        lockstep(&options, 2_000).unwrap_or_else(|error| panic!("{busy:?}: {error:#}"));
    }
}

#[test]
#[ignore = "needs the images and QEMU"]
fn a_busy_wait_longer_than_the_output_offset_is_an_overrun() {
    let config = config();
    for (busy, tick, counts) in [
        (BusyWait { outer_us: 3_000, ..BusyWait::default() }, 2, [1, 0, 0]),
        (BusyWait { commander_us: 5_000, ..BusyWait::default() }, 4, [0, 1, 0]),
        (BusyWait { ground_us: 7_000, ..BusyWait::default() }, 6, [0, 0, 1]),
    ] {
        let options = PilOptions { busy, ..PilOptions::new(image("mps2-pil"), &config) };
        let error = lockstep(&options, 100).expect_err("too long");
        assert_eq!(error.downcast_ref(), Some(&Overrun { tick, counts }), "{busy:?}: {error:#}");
    }
}

#[test]
#[ignore = "needs the images and QEMU"]
fn a_panic_or_a_hard_fault_stops_the_rotors() {
    let config = config();
    for (fault, cause) in [
        (Fault::Panic, Cause::Panic),
        (Fault::UndefinedInstruction, Cause::HardFault),
        (Fault::StackOverflow, Cause::HardFault),
    ] {
        let options = PilOptions { fault: Some((40, fault)), ..PilOptions::new(image("mps2-pil"), &config) };
        let error = lockstep(&options, 100).expect_err("it faults");
        // The outer job of tick 40 runs after the reply to tick 40.
        assert_eq!(error.downcast_ref(), Some(&Stopped { tick: 41, cause }), "{fault:?}: {error:#}");
    }
}

#[test]
#[ignore = "needs the images and QEMU"]
fn a_bad_configuration_is_refused_with_its_reason() {
    let mut config = config();
    config.airframe.mass_kg = -1.0;
    let error = Pil::start(&PilOptions::new(image("mps2-pil"), &config)).expect_err("negative mass");
    assert_eq!(format!("{error:#}"), "the image refuses the flight: `airframe.mass_kg` must be above zero");
}

#[test]
#[ignore = "needs the images and QEMU"]
fn an_image_that_does_not_talk_to_the_host_is_noticed() {
    let config = config();
    let timeout = Duration::from_millis(500);
    let wrong = PilOptions { timeout, ..PilOptions::new(image("mps2"), &config) };
    let error = Pil::start(&wrong).expect_err("the wrong one");
    assert!(format!("{error:#}").contains("is it one for processor in the loop?"), "{error:#}");
    let error = Pil::start(&PilOptions { timeout, ..PilOptions::new(env!("CARGO_MANIFEST_PATH"), &config) });
    let text = format!("{:#}", error.expect_err("not even an image"));
    assert!(text.contains("not an ELF file"), "{text}");
}

#[test]
#[ignore = "needs the images and QEMU"]
fn desktop_and_image_agree_on_the_hash_of_the_mathematics() {
    let output = Command::new("qemu-system-arm")
        .args(["-M", "mps2-an386", "-nographic", "-semihosting-config", "enable=on,target=native", "-kernel"])
        .arg(image("math-hash"))
        .output()
        .expect("qemu-system-arm");
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(text.trim(), format!("{:016x}", firmware::selftest::math_hash(TICKS)));
}
