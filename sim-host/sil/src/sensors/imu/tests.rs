//! The noise against Allan deviations in closed form, the other errors against the data sheet.

use super::super::suite::SuiteFile;
use super::super::tests::{at_rest, truth};
use super::*;
use crate::plant::Motion;

const GYRO: Sources = Sources { errors: Source::GyroErrors, noise: Source::GyroNoise, bias: Source::GyroBias };

/// Axes without any error.
const IDEAL: Triad = Triad {
    noise_density: [0.0; 3],
    bias_instability: 0.0,
    bias_time_s: 1.0,
    bias_walk: 0.0,
    turn_on_bias: 0.0,
    scale_error: 0.0,
    misalignment: 0.0,
    bias_per_k: 0.0,
    resolution: 0.0,
    range: 1e3,
};

/// Mean of the axes' Allan variances for clusters of `length` samples that do not overlap.
fn allan_variance(samples: &[Vector3<f64>], length: usize) -> f64 {
    let means: Vec<Vector3<f64>> =
        samples.chunks_exact(length).map(|cluster| cluster.iter().sum::<Vector3<f64>>() / length as f64).collect();
    let steps = means.windows(2).map(|pair| (pair[1] - pair[0]).norm_squared());
    steps.sum::<f64>() / (6.0 * (means.len() - 1) as f64)
}

/// 4.5 standard errors of an Allan variance of three axes, relative: a cluster's step is shared by two neighbours, so
/// that the variance is at most that of 2/3 as many independent ones.
fn bound(clusters: usize) -> f64 {
    4.5 * (2.0 * 1.5 / (3.0 * clusters as f64)).sqrt()
}

#[test]
fn white_noise_has_the_allan_deviation_of_its_density() {
    let density = 2.8e-3;
    let mut axes = Axes::new(&Triad { noise_density: [density; 3], ..IDEAL }, &GYRO, 1);
    let samples: Vec<Vector3<f64>> = (0..1_000_000).map(|_| axes.read(&Vector3::zeros())).collect();
    for length in [1, 10, 100, 1000] {
        let exact = density * density / (2.0 * length as f64 / TICKS_PER_S);
        let ours = allan_variance(&samples, length);
        assert!((ours / exact - 1.0).abs() < bound(samples.len() / length), "{length}: {ours} {exact}");
    }
}

/// Allan variance of a Gauss–Markov process of deviation 1 over T = `x` correlation times (IEEE 952, C.1.3).
fn gauss_markov_allan(x: f64) -> f64 {
    2.0 / x * (1.0 - (3.0 - 4.0 * libm::exp(-x) + libm::exp(-2.0 * x)) / (2.0 * x))
}

#[test]
fn the_bias_has_the_allan_deviation_of_its_instability() {
    let mut axes = Axes::new(&Triad { bias_instability: 0.5, bias_time_s: 1.0, ..IDEAL }, &GYRO, 2);
    let samples: Vec<Vector3<f64>> = (0..1_000_000)
        .map(|_| {
            axes.step_bias(0.0);
            axes.bias
        })
        .collect();
    for length in [50, 189, 500] {
        let exact = 0.25 * gauss_markov_allan(length as f64 * BIAS_STEP_S);
        let ours = allan_variance(&samples, length);
        // The process is sampled and not averaged between: 1e-4 of the variance.
        assert!((ours / exact - 1.0).abs() < bound(samples.len() / length) + 1e-3, "{length}: {ours} {exact}");
    }
    // As documented for `bias_instability`.
    let top = (1..1000).map(|x| gauss_markov_allan(f64::from(x) * 0.01)).fold(0.0, f64::max);
    assert!((top.sqrt() - 0.617).abs() < 1e-3 && (gauss_markov_allan(1.89) - top).abs() < 1e-6);
}

#[test]
fn the_random_walk_grows_with_the_root_of_time() {
    let (walk, seeds) = (0.1, 2000_u64);
    let mut variance = [0.0; 2];
    for seed in 0..seeds {
        let mut axes = Axes::new(&Triad { bias_walk: walk, ..IDEAL }, &GYRO, seed);
        for axis in &mut variance {
            for _ in 0..200 {
                axes.step_bias(0.0);
            }
            *axis += axes.walk.norm_squared() / (3.0 * seeds as f64);
        }
    }
    for (ours, time_s) in variance.into_iter().zip([2.0, 4.0]) {
        let exact = walk * walk * time_s;
        assert!((ours / exact - 1.0).abs() < 4.5 * (2.0 / (3.0 * seeds as f64)).sqrt(), "{time_s}: {ours} {exact}");
    }
}

#[test]
fn errors_of_a_part_have_their_deviations_over_the_seeds() {
    let spec = Triad { turn_on_bias: 0.3, scale_error: 0.003, misalignment: 0.002, bias_per_k: 0.005, ..IDEAL };
    let seeds = 4000_u64;
    let [mut bias, mut scale, mut cross, mut warmth] = [0.0; 4];
    for seed in 0..seeds {
        let axes = Axes::new(&spec, &GYRO, seed);
        let off = axes.gain - Matrix3::identity();
        bias += axes.bias.norm_squared();
        warmth += axes.warmth.norm_squared();
        scale += off.diagonal().norm_squared();
        cross += 0.5 * (off.norm_squared() - off.diagonal().norm_squared());
    }
    for (sum, sigma) in [(bias, 0.3), (scale, 0.003), (cross, 0.002), (warmth, 0.005)] {
        let ratio = sum / (3.0 * seeds as f64) / (sigma * sigma);
        assert!((ratio - 1.0).abs() < 4.5 * (2.0 / (3.0 * seeds as f64)).sqrt(), "{sigma}: {ratio}");
    }
}

#[test]
fn a_board_that_warms_up_shifts_the_bias() {
    let mut axes = Axes::new(&Triad { bias_per_k: 0.01, ..IDEAL }, &GYRO, 3);
    axes.step_bias(0.0);
    assert_eq!(axes.bias, Vector3::zeros());
    axes.step_bias(10.0);
    assert_eq!(axes.bias, axes.warmth * 10.0);
    assert!(axes.bias.norm() > 0.0);
}

#[test]
fn what_is_out_of_range_is_clipped() {
    let spec = SuiteFile::load("gnss").expect("loads").imu;
    let mut imu = InertialUnit::new(&spec, 1);
    let rates = Vector3::new(100.0, -100.0, 1.0);
    let motion = Motion { rates, ..Motion::at_rest(Vector3::zeros()) };
    let truth = Truth { specific_force: Vector3::new(-500.0, 500.0, 0.0), ..truth(0, &motion) };
    let sample = imu.measure(&truth);
    // ±2000 °/s and ±16 g, to the last digit of an f32.
    for (read, limit) in [(sample.gyro.x, 34.906_586), (-sample.gyro.y, 34.906_586), (-sample.accel.x, 156.906_4)] {
        assert!((read - limit).abs() < 1e-4, "{read} {limit}");
    }
    assert!(sample.gyro.z.abs() < 2.0);
}

#[test]
fn readings_are_multiples_of_the_resolution() {
    let spec = SuiteFile::load("gnss").expect("loads").imu;
    let mut imu = InertialUnit::new(&spec, 1);
    let motion = at_rest();
    let mut levels = std::collections::BTreeSet::new();
    for tick in 0..1000 {
        let sample = imu.measure(&truth(tick, &motion));
        let steps = f64::from(sample.gyro.x).to_degrees() / spec.gyro.resolution;
        assert!((steps - steps.round()).abs() < 1e-4, "{steps}");
        levels.insert(steps.round() as i32);
        let steps = f64::from(sample.accel.z) / spec.accel.resolution;
        assert!((steps - steps.round()).abs() < 1e-3, "{steps}");
    }
    // 63 m°/s of noise are a step of 61 m°/s: some levels, not one and not hundreds.
    assert!((3..20).contains(&levels.len()), "{levels:?}");
}
