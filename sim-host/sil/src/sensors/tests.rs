//! The slow sensors against their data sheets, and all sensors together.

use super::*;
use crate::geodesy::{LocalFrame, Place};

/// Level and at rest at the origin.
pub(super) fn at_rest() -> Motion {
    Motion::at_rest(Vector3::zeros())
}

/// The truth of a motion without acceleration, rotors at rest.
pub(super) fn truth(tick: Tick, motion: &Motion) -> Truth<'_> {
    let specific_force = UnitQuaternion::new_unchecked(motion.attitude).inverse() * Vector3::new(0.0, 0.0, 9.81);
    let battery = BatteryTruth { voltage_v: 15.2, current_a: 18.0 };
    Truth { tick, motion, specific_force, omega: [0.0; ROTORS], battery }
}

/// A suite from TOML.
pub(super) fn parts(text: &str) -> SuiteFile {
    SuiteFile::from_table(text.parse().expect("TOML")).expect("loads")
}

/// All samples that arrive in a time at rest.
pub(super) fn record(parts: &SuiteFile, faults: &[Fault], seed: u64, ticks: Tick) -> Vec<Measurements> {
    let motion = at_rest();
    let mut suite = Suite::new(parts, &Home::default(), faults, seed);
    (0..ticks).map(|tick| suite.measure(&truth(tick, &motion))).collect()
}

/// Asserts the deviation of independent values of mean 0, within 4.5 standard errors.
fn assert_deviation(numbers: &[f64], sigma: f64) {
    let count = numbers.len() as f64;
    let variance = numbers.iter().map(|number| number * number).sum::<f64>() / count;
    let bound = 4.5 * (2.0 / count).sqrt();
    assert!((variance / (sigma * sigma) - 1.0).abs() < bound, "{} {sigma} ± {bound}", variance.sqrt());
}

#[test]
fn the_imu_delivers_at_every_tick_and_the_others_at_their_rates() {
    let record = record(&parts("suite = \"gnss\"\npose.part = \"mocap\""), &[], 1, 10_000);
    assert!(record.iter().enumerate().all(|(tick, m)| m.imu.is_some_and(|imu| imu.at as usize == tick)));
    let count = |is_there: fn(&Measurements) -> bool| record.iter().filter(|m| is_there(m)).count();
    // In 10 s; the last pose is then still in transit.
    assert_eq!(count(|m| m.mag.is_some()), 500);
    assert_eq!(count(|m| m.baro.is_some()), 500);
    assert_eq!(count(|m| m.pose.is_some()), 999);
    assert_eq!(count(|m| m.battery.is_some()), 100);
    assert_eq!(count(|m| m.gnss.is_some()), 50);
}

#[test]
fn the_latencies_are_those_of_the_parts() {
    let record = record(&parts("suite = \"gnss\"\npose.part = \"mocap\""), &[], 1, 10_000);
    for (tick, m) in record.iter().enumerate() {
        let late = |at: Tick| tick - at as usize;
        assert!(m.mag.is_none_or(|mag| late(mag.at) == 5));
        assert!(m.baro.is_none_or(|baro| late(baro.at) == 10));
        assert!(m.pose.is_none_or(|pose| late(pose.at) == 10));
    }
}

#[test]
fn solutions_arrive_in_order_100_to_200_ms_late_with_jitter() {
    let late: Vec<(Tick, f64)> = record(&parts("suite = \"gnss\""), &[], 1, 1_000_000)
        .iter()
        .enumerate()
        .filter_map(|(tick, m)| m.gnss.map(|gnss| (gnss.at, tick as f64 - f64::from(gnss.at))))
        .collect();
    assert!(late.windows(2).all(|pair| pair[1].0 == pair[0].0 + 200));
    assert!(late.iter().all(|(_, late)| (130.0..=170.0).contains(late)));
    let jitter: Vec<f64> = late.iter().map(|(_, late)| late - 150.0).collect();
    let mean = jitter.iter().sum::<f64>() / jitter.len() as f64;
    // Uniform in ± 20 ms: a deviation of 20/√3.
    assert!(mean.abs() < 4.5 * 11.55 / (jitter.len() as f64).sqrt(), "{mean}");
    assert_deviation(&jitter, 20.0 / 3.0_f64.sqrt());
}

#[test]
fn places_have_the_stated_errors_over_the_seeds() {
    let home = Home::default();
    let frame = LocalFrame::at(&home.place());
    let spec = SuiteFile::load("gnss").expect("loads").gnss.expect("there");
    let (mut horizontal, mut vertical, mut speed) = (Vec::new(), Vec::new(), Vec::new());
    let position = Vector3::new(300.0, -200.0, 50.0);
    let motion = Motion { velocity: Vector3::new(3.0, -4.0, 1.0), ..Motion::at_rest(position) };
    for seed in 0..4000 {
        let sample = Receiver::new(&spec, &home, seed).measure(&truth(0, &motion));
        let error = frame.position(&Place::of(&sample.place)) - position;
        horizontal.extend([error.x, error.y]);
        vertical.push(error.z);
        speed.extend([f64::from(sample.velocity.x) - 3.0, f64::from(sample.velocity.y) + 4.0]);
        assert!(sample.has_fix);
        assert!(
            (sample.horizontal_accuracy_m - 1.204).abs() < 1e-3 && (sample.vertical_accuracy_m - 2.01).abs() < 1e-3
        );
    }
    assert_deviation(&horizontal, 1.204);
    assert_deviation(&vertical, 2.01);
    assert_deviation(&speed, 0.05);
}

#[test]
fn the_error_of_a_place_wanders_slowly() {
    let home = Home::default();
    let frame = LocalFrame::at(&home.place());
    let spec = SuiteFile::load("gnss").expect("loads").gnss.expect("there");
    let motion = at_rest();
    let (mut steps, mut strides) = (Vec::new(), Vec::new());
    for seed in 0..300 {
        let mut receiver = Receiver::new(&spec, &home, seed);
        let north: Vec<f64> =
            (0..900).map(|k| frame.position(&Place::of(&receiver.measure(&truth(200 * k, &motion)).place)).x).collect();
        steps.push(north[1] - north[0]);
        strides.push(north[899] - north[0]);
    }
    // From one to the next, white noise twice, and 1.2 m √(2 · 0.2/1800) = 18 mm of wandering.
    assert_deviation(&steps, 0.143);
    // In 179.8 s, 1.2 m √(2 (1 − e^(−0.1))) = 0.523 m of wandering.
    assert_deviation(&strides, 0.542);
}

#[test]
fn a_magnetometer_sees_the_field_from_the_body() {
    let ideal = "suite = \"gnss\"\nmag = { noise_ut = 0.0, resolution_ut = 0.0, hard_iron_ut = 0.0, soft_iron = 0.0, \
                 current_ut_a = 0.0 }";
    let spec = parts(ideal).mag.expect("there");
    let home = Home::default();
    let attitude = UnitQuaternion::from_euler_angles(0.3, -0.2, 1.9);
    let motion = Motion { attitude: attitude.into_inner(), ..at_rest() };
    let sample = Magnetometer::new(&spec, &home, 1).measure(&truth(0, &motion));
    assert!((attitude * sample.field_ut.cast::<f64>() - home.field_nwu()).amax() < 1e-5);
    // Heading west, the field, which points north, comes from the right.
    let west = UnitQuaternion::from_euler_angles(0.0, 0.0, core::f64::consts::FRAC_PI_2);
    let motion = Motion { attitude: west.into_inner(), ..at_rest() };
    let sample = Magnetometer::new(&spec, &home, 1).measure(&truth(0, &motion));
    assert!(sample.field_ut.y < -21.0 && sample.field_ut.x < 0.0, "{}", sample.field_ut);
}

#[test]
fn what_disturbs_a_magnetometer_is_as_strong_as_stated() {
    let spec = parts("suite = \"gnss\"\nmag = { resolution_ut = 0.0, soft_iron = 0.0, current_ut_a = 0.0 }");
    let spec = spec.mag.expect("there");
    let (home, motion) = (Home::default(), at_rest());
    let (mut iron, mut noise) = (Vec::new(), Vec::new());
    for seed in 0..2000 {
        let mut sensor = Magnetometer::new(&spec, &home, seed);
        iron.extend_from_slice(sensor.hard_iron.as_slice());
        let error = sensor.measure(&truth(0, &motion)).field_ut.cast::<f64>() - home.field_nwu() - sensor.hard_iron;
        noise.extend_from_slice(error.as_slice());
    }
    assert_deviation(&iron, 0.05);
    assert_deviation(&noise, 0.3);
}

#[test]
fn a_barometer_reads_the_air_at_its_height_with_noise_of_8_cm() {
    let spec = SuiteFile::load("gnss").expect("loads").baro.expect("there");
    let home = Home::default();
    let motion = Motion::at_rest(Vector3::new(0.0, 0.0, 100.0));
    let mut all = Vec::new();
    for seed in 0..4000 {
        let pressure = f64::from(Barometer::new(&spec, &home, seed).measure(&truth(0, &motion)).pressure_pa);
        all.push(pressure - home.pressure(100.0));
    }
    // Offset, drift and noise; an f32 resolves 8 mPa here.
    assert_deviation(&all, (20.0_f64.powi(2) + 3.5 * 3.5 + 0.93 * 0.93).sqrt());
    let mut barometer = Barometer::new(&spec, &home, 1);
    let readings: Vec<f64> =
        (0..4000).map(|k| f64::from(barometer.measure(&truth(20 * k, &motion)).pressure_pa)).collect();
    let halves: Vec<f64> = readings.chunks_exact(2).map(|pair| (pair[1] - pair[0]) / 2.0_f64.sqrt()).collect();
    assert_deviation(&halves, 0.93);
    let metres = 0.93 / (home.pressure(-0.5) - home.pressure(0.5));
    assert!((metres - 0.081).abs() < 1e-3, "{metres}");
}

#[test]
fn motion_capture_is_as_good_as_stated() {
    let spec = SuiteFile::load("mocap").expect("loads").pose.expect("there");
    let attitude = UnitQuaternion::from_euler_angles(0.3, -0.2, 1.9);
    let motion = Motion { attitude: attitude.into_inner(), ..Motion::at_rest(Vector3::new(1.0, 2.0, 3.0)) };
    let mut system = MotionCapture::new(&spec, 1);
    let (mut places, mut turns) = (Vec::new(), Vec::new());
    for tick in 0..4000 {
        let sample = system.measure(&truth(tick, &motion));
        places.extend_from_slice((sample.position.cast::<f64>() - motion.position).as_slice());
        turns.extend_from_slice((attitude.inverse() * sample.attitude.cast::<f64>()).scaled_axis().as_slice());
        assert!(sample.is_valid());
    }
    assert_deviation(&places, 5e-4);
    assert_deviation(&turns, 0.1_f64.to_radians());
}

#[test]
fn a_battery_monitor_reads_voltage_and_current() {
    let record = record(&SuiteFile::load("gnss").expect("loads"), &[], 1, 100_000);
    let samples: Vec<_> = record.iter().filter_map(|m| m.battery).collect();
    let volts: Vec<f64> = samples.iter().map(|sample| f64::from(sample.voltage_v) - 15.2).collect();
    let amperes: Vec<f64> = samples.iter().map(|sample| f64::from(sample.current_a) - 18.0).collect();
    // With the variance of quantisation, the resolution squared over 12.
    assert_deviation(&volts, (0.02_f64.powi(2) + 0.01 * 0.01 / 12.0).sqrt());
    assert_deviation(&amperes, (0.1_f64.powi(2) + 0.05 * 0.05 / 12.0).sqrt());
}

#[test]
fn one_sensor_does_not_change_another() {
    let base = record(&parts("suite = \"gnss\""), &[], 7, 3000);
    let other = parts("suite = \"gnss\"\npose.part = \"mocap\"\ngnss.rate_hz = 10.0\nbaro.noise_pa = 5.0");
    let other = record(&other, &[], 7, 3000);
    assert!(base.iter().zip(&other).all(|(a, b)| (a.imu, a.mag, a.battery) == (b.imu, b.mag, b.battery)));
    let without = SuiteFile { mag: None, ..parts("suite = \"gnss\"") };
    let without = record(&without, &[], 7, 3000);
    assert!(base.iter().zip(&without).all(|(a, b)| Measurements { mag: None, ..*a } == *b));
    assert_ne!(base, record(&parts("suite = \"gnss\""), &[], 8, 3000));
}

/// A hash over all bits of the samples.
fn fingerprint(sum: u64, m: &Measurements) -> u64 {
    let add = |sum: u64, value: f32| sum.rotate_left(5) ^ u64::from(value.to_bits());
    let mut sum = m.imu.iter().flat_map(|imu| imu.gyro.iter().chain(&imu.accel)).copied().fold(sum, add);
    sum = m.mag.iter().flat_map(|mag| mag.field_ut.iter()).copied().fold(sum, add);
    sum = m.baro.iter().map(|baro| baro.pressure_pa).fold(sum, add);
    sum = m.pose.iter().flat_map(|pose| pose.attitude.coords.iter().chain(&pose.position)).copied().fold(sum, add);
    sum = m.battery.iter().flat_map(|battery| [battery.voltage_v, battery.current_a]).fold(sum, add);
    m.gnss.iter().fold(sum, |sum, gnss| {
        let place = [gnss.place.latitude_e7, gnss.place.longitude_e7, gnss.place.height_mm];
        let sum = place.into_iter().fold(sum, |sum, value| sum.rotate_left(5) ^ u64::from(value.cast_unsigned()));
        gnss.velocity.iter().copied().fold(sum, add)
    })
}

#[test]
fn a_seed_means_the_same_measurements_on_every_platform() {
    // Recorded once, on x86-64 Linux; a change here changes every flight on sensors.
    let parts = parts("suite = \"gnss\"\npose.part = \"mocap\"");
    let attitude = UnitQuaternion::from_euler_angles(0.3, -0.2, 1.9).into_inner();
    let motion = Motion { attitude, rates: Vector3::new(0.1, -0.2, 0.3), ..at_rest() };
    let mut suite = Suite::new(&parts, &Home::default(), &[], 1);
    let sum = (0..20_000).fold(0, |sum, tick| {
        let omega = [700.0, 757.0, 800.0, 850.0];
        fingerprint(sum, &suite.measure(&Truth { omega, ..truth(tick, &motion) }))
    });
    assert_eq!(sum, 12_401_510_915_009_552_057);
}
