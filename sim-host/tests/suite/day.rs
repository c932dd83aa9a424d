//! A day of hover on GNSS: what the filter believes of the IMU's biases stays as good as it says, its covariance stays one,
//! and the log of the day is the same twice. Ten minutes of it always; the whole day takes `--ignored`.

use firmware::estimator::covariance::{Covariance, STATES, index};
use nalgebra::{SMatrix, UnitQuaternion, Vector3};
use sim_host::flight;
use sim_host::plant::Plant;
use sim_host::plant::rigid_body::RigidBody;
use sim_host::sil::{Flight, Lockstep as _};

use crate::common::fingerprint::Fingerprint;
use crate::common::load::load;

const SEED: u64 = 1;
/// In hover from here on, ticks.
const HOVERS: u32 = 60_000;
const MINUTE: u32 = 60_000;

/// A minute's look at the filter.
struct Look {
    minute: u32,
    /// Errors of the biases that hover shows, those of the gyroscope and of the accelerometer along the thrust, each in its
    /// own standard deviations.
    shown: [f64; 4],
    /// Errors of the accelerometer's biases across the thrust, m/s².
    across: [f64; 2],
    /// Error of roll and pitch, rad.
    tilt: f64,
}

/// Flies that long; returns the fingerprint of the flight and a look a minute.
fn fly(minutes: u32) -> ([u64; 2], Vec<Look>) {
    let scenario = load("day", &[]);
    let plant = flight::rigid_body(&scenario, SEED);
    let mut flight = flight::lockstep(&scenario, SEED, plant).expect("can be flown");
    let (mut seen, mut looks) = (Fingerprint::default(), Vec::new());
    for minute in 1..=minutes {
        for tick in 0..MINUTE {
            assert!(flight.step(&mut seen), "lost in minute {minute}, {tick} ms");
        }
        assert_positive(flight.autopilot.filter.covariance(), minute);
        if minute * MINUTE > HOVERS {
            looks.push(look(&flight, minute));
        }
    }
    (seen.hashes(), looks)
}

/// Cholesky in f64 of P, each state in its own deviation: no direction of the error is known better than exactly.
fn assert_positive(covariance: &Covariance, minute: u32) {
    let sigma = |state: usize| f64::from(covariance.variance(state)).sqrt();
    let correlation = SMatrix::<f64, STATES, STATES>::from_fn(|i, j| {
        // Either triangle of a block on the diagonal is as good as the other.
        f64::from(0.5 * (covariance.get(i, j) + covariance.get(j, i))) / (sigma(i) * sigma(j))
    });
    let finite = correlation.iter().all(|value| value.is_finite());
    assert!(finite && correlation.cholesky().is_some(), "minute {minute}: {:?}", correlation.symmetric_eigenvalues());
}

fn look(flight: &Flight<RigidBody>, minute: u32) -> Look {
    let believed = flight.autopilot.inner.navigator().expect("flies on sensors").state();
    let attitude = UnitQuaternion::new_normalize(flight.plant().motion().attitude);
    // In hover the force is that of the weight, and what scales and axes make of it is a bias like any other.
    let force = attitude.inverse() * Vector3::new(0.0, 0.0, 9.81);
    let (gyro, accel) = flight.sensors().expect("flies on sensors").imu_error(&Vector3::zeros(), &force);
    let covariance = flight.autopilot.filter.covariance();
    let (gyro, accel) = (gyro - believed.gyro_bias.cast::<f64>(), accel - believed.accel_bias.cast::<f64>());
    let sigma = |state: usize| f64::from(covariance.variance(state)).sqrt();
    let error = (attitude * believed.attitude.cast::<f64>().inverse()).scaled_axis();
    let axis = |i: usize| gyro[i] / sigma(index::GYRO_BIAS + i);
    Look {
        minute,
        shown: [axis(0), axis(1), axis(2), accel.z / sigma(index::ACCEL_BIAS + 2)],
        across: [accel.x, accel.y],
        tilt: error.xy().norm(),
    }
}

/// In hover with one heading, a bias across the thrust and a tilt are felt as one: neither comes to be known better than
/// calibration has left it, 0.025 m/s² an axis with what scales make of gravity, and 2.5 mrad of tilt. 5 σ, beyond which
/// chance puts none of a day's looks.
const ACROSS_M_S2: f64 = 0.125;
const TILT_RAD: f64 = 0.0125;

/// Biases that hover shows within 3 σ, the filter's own; those that it does not, and the tilt, within what is left anyway.
fn assert_biases_are_known(looks: &[Look]) {
    for axis in 0..4 {
        let errors = looks.iter().map(|look| (look.minute, look.shown[axis]));
        let beyond: Vec<(u32, f64)> = errors.filter(|(_, error)| error.abs() > 3.0).collect();
        assert!(beyond.is_empty(), "axis {axis}: {beyond:?}");
    }
    for Look { minute, across, tilt, .. } in looks {
        assert!(across.iter().all(|error| error.abs() < ACROSS_M_S2), "minute {minute}: {across:?}");
        assert!(*tilt < TILT_RAD, "minute {minute}: {tilt}");
    }
}

fn assert_flies_the_same_twice(minutes: u32) {
    let again = std::thread::spawn(move || fly(minutes));
    let (hashes, looks) = fly(minutes);
    assert_biases_are_known(&looks);
    assert_eq!(hashes, again.join().expect("flies").0, "the same day, another log");
    // For whoever runs it by hand.
    let rms = |of: &dyn Fn(&Look) -> f64| {
        (looks.iter().map(|look| of(look).powi(2)).sum::<f64>() / looks.len() as f64).sqrt()
    };
    let shown: [f64; 4] = core::array::from_fn(|axis| rms(&|look| look.shown[axis]));
    let across: [f64; 2] = core::array::from_fn(|axis| rms(&|look| look.across[axis]));
    let tilt = rms(&|look| look.tilt);
    println!("{minutes} min, rms: shown {shown:.2?} of their σ, across {across:.4?} m/s², tilt {tilt:.4} rad");
}

#[test]
fn ten_minutes_of_hover() {
    assert_flies_the_same_twice(10);
}

#[test]
#[ignore = "takes minutes: tests/run --full"]
fn a_day_of_hover() {
    assert_flies_the_same_twice(24 * 60);
}
