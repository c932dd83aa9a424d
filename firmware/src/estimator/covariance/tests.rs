use nalgebra::{SMatrix, UnitQuaternion};

use super::*;

type Dense = SMatrix<f64, STATES, STATES>;

/// Pseudo-random values in −1..1 (xorshift).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 40) as f32 / 8_388_608.0 - 1.0
    }

    fn vector(&mut self) -> Vector3<f32> {
        Vector3::new(self.next(), self.next(), self.next())
    }
}

fn dense(p: &Covariance) -> Dense {
    Dense::from_fn(|i, j| f64::from(p.get(i, j)))
}

fn motion(n: &mut Numbers) -> Motion {
    let attitude = UnitQuaternion::new(n.vector() * 2.0);
    Motion {
        step_s: 0.004,
        rotation: attitude.to_rotation_matrix().into_inner(),
        velocity_change: n.vector() * 0.1 + Vector3::new(0.0, 0.0, 0.04),
    }
}

fn noise() -> StepNoise {
    StepNoise {
        theta: Vector3::repeat(1e-9),
        velocity: 1e-6,
        gyro_bias: 1e-13,
        accel_bias: 1e-11,
        offset: Vector3::repeat(1e-5),
        magnetic_wind: Vector3::repeat(1e-6),
    }
}

/// F as in the module's documentation, as a full matrix.
fn transition(m: &Motion) -> Dense {
    let mut f = Dense::identity();
    let (r, s) = (m.rotation.cast::<f64>() * f64::from(m.step_s), m.velocity_change.cast::<f64>());
    f.fixed_view_mut::<3, 3>(0, 9).copy_from(&-r);
    f.fixed_view_mut::<3, 3>(3, 12).copy_from(&-r);
    f.fixed_view_mut::<3, 3>(3, 0).copy_from(&-s.cross_matrix());
    f.fixed_view_mut::<3, 3>(6, 3).copy_from(&(nalgebra::Matrix3::identity() * f64::from(m.step_s)));
    f
}

/// A covariance without zero entries.
fn mixed(n: &mut Numbers) -> Covariance {
    let mut p = Covariance::diagonal(&ErrorState::from_fn(|i, _| 0.01 + 0.1 * i as f32));
    for _ in 0..60 {
        let m = motion(n);
        p.predict(&m, &noise());
        correct(&mut p, &row(n), 0.01);
    }
    p
}

fn row(n: &mut Numbers) -> Row {
    let state = |n: &mut Numbers| ((n.next().abs() * 20.9) as usize, n.next());
    Row { theta: n.vector(), entries: [state(n), state(n), state(n)] }
}

fn correct(p: &mut Covariance, row: &Row, variance: f32) {
    let mut c = ErrorState::zeros();
    p.times(row, &mut c);
    let s = row.dot(&c) + variance;
    p.correct(&[c], &[s]);
}

fn h(row: &Row) -> SMatrix<f64, 1, STATES> {
    let mut h = SMatrix::<f64, 1, STATES>::zeros();
    for i in 0..3 {
        h[i] = f64::from(row.theta[i]);
    }
    for (state, factor) in row.entries {
        h[state] += f64::from(factor);
    }
    h
}

fn assert_near(is: &Dense, ought: &Dense, tolerance: f64) {
    for i in 0..STATES {
        for j in 0..STATES {
            let scale = (ought[(i, i)] * ought[(j, j)]).sqrt();
            let error = (is[(i, j)] - ought[(i, j)]).abs();
            assert!(error < tolerance * scale, "({i}, {j}): {} {}", is[(i, j)], ought[(i, j)]);
        }
    }
}

#[test]
fn a_prediction_is_f_p_f_transposed() {
    let mut n = Numbers(7);
    for _ in 0..50 {
        let mut p = mixed(&mut n);
        let (before, m) = (dense(&p), motion(&mut n));
        p.predict(
            &m,
            &StepNoise {
                theta: Vector3::zeros(),
                velocity: 0.0,
                gyro_bias: 0.0,
                accel_bias: 0.0,
                offset: Vector3::zeros(),
                magnetic_wind: Vector3::zeros(),
            },
        );
        let f = transition(&m);
        // As a product of three shears, F is exact: velocity uses the attitude before the step, position the velocity
        // before it.
        assert_near(&dense(&p), &(f * before * f.transpose()), 1e-5);
    }
}

#[test]
fn a_correction_is_josephs_form() {
    let mut n = Numbers(11);
    for _ in 0..50 {
        let mut p = mixed(&mut n);
        let (before, row, variance) = (dense(&p), row(&mut n), 0.05_f32);
        let h = h(&row);
        let s = (h * before * h.transpose())[0] + f64::from(variance);
        let k = before * h.transpose() / s;
        let left = Dense::identity() - k * h;
        let ought = left * before * left.transpose() + k * k.transpose() * f64::from(variance);
        correct(&mut p, &row, variance);
        assert_near(&dense(&p), &ought, 2e-5);
    }
}

#[test]
fn a_reset_state_is_uncorrelated_with_the_others() {
    let mut n = Numbers(3);
    let mut p = mixed(&mut n);
    let before = dense(&p);
    p.set_variance(7, 2.5);
    for i in 0..STATES {
        for j in 0..STATES {
            let ought = if i == 7 && j == 7 {
                2.5
            } else if i == 7 || j == 7 {
                0.0
            } else {
                before[(i, j)]
            };
            assert_eq!(f64::from(p.get(i, j)), ought, "({i}, {j})");
        }
    }
}

/// Measurements far more and far less accurate than the estimate, as many as GNSS corrections in an hour.
#[test]
fn it_stays_positive_definite() {
    let mut n = Numbers(5);
    let mut p = mixed(&mut n);
    for step in 0..40_000 {
        p.predict(&motion(&mut n), &noise());
        if step % 5 == 0 {
            let variance = [1e-6_f32, 1e-2, 1.0, 1e4][step / 5 % 4];
            correct(&mut p, &row(&mut n), variance);
        }
        if step % 500 == 0 {
            let dense = dense(&p);
            // Scaled to unit variances, so that its eigenvalues have no units.
            let scaled = Dense::from_fn(|i, j| dense[(i, j)] / (dense[(i, i)] * dense[(j, j)]).sqrt());
            let least = scaled.symmetric_eigen().eigenvalues.min();
            assert!(least > -1e-4, "{step}: {least}");
        }
    }
}
