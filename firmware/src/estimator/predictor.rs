//! The inner half of the estimator, every tick: integrates the nominal state from the IMU.
//!
//! Strapdown integration by the trapezoidal rule: `q ← q ⊗ exp(½ (ω₋ + ω) T)`, `v ← v + ½ (R₋f₋ + R f) T − g T e3`, `p
//! ← p + ½ (v₋ + v) T` (Titterton and Weston 2004, §11; at 1 kHz coning between two samples is below the gyroscope's
//! noise). A missing sample is replaced by the last one. The filter gets the sums between two of its jobs as a [`Span`]
//! and returns a [`Correction`].
//!
//! ```
//! use firmware::estimator::Predictor;
//! use firmware::sensors::ImuSample;
//! use nalgebra::Vector3;
//!
//! // A vehicle at rest measures +g upwards: nothing moves. One that measures 1 m/s² more climbs.
//! let g = 9.81;
//! let mut predictor = Predictor::new(Vector3::zeros(), g);
//! for at in 1..=1_000 {
//!     // With noise: samples that repeat themselves would be those of a stuck sensor.
//!     let noise = if at % 2 == 0 { 0.01 } else { -0.01 };
//!     let sample = ImuSample { at, gyro: Vector3::zeros(), accel: Vector3::new(0.0, 0.0, g + 1.0 + noise) };
//!     assert!(predictor.predict(Some(&sample)));
//! }
//! // After 1 s: v = 1 m/s and z = 0.5 m.
//! assert!((predictor.state().velocity.z - 1.0).abs() < 1e-3);
//! assert!((predictor.state().position.z - 0.5).abs() < 1e-3);
//!
//! // A sample with NaN is refused, and the last one is integrated again.
//! let bad = ImuSample { at: 1_001, gyro: Vector3::repeat(f32::NAN), accel: Vector3::zeros() };
//! assert!(!predictor.predict(Some(&bad)));
//! assert!(predictor.state().velocity.z.is_finite());
//! ```

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::history::Snapshot;
use crate::math;
use crate::sensors::ImuSample;
use crate::signals::{TICK_S, Tick};

/// Sums over the ticks between two jobs of the filter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Span {
    /// Number of ticks.
    pub ticks: u32,
    /// Number of ticks with a sample.
    pub samples: u32,
    /// ∫ R f dt, m/s.
    pub velocity_change: Vector3<f32>,
    /// Sum of the gyroscope's samples, rad/s.
    pub gyro: Vector3<f32>,
    /// Sum of the accelerometer's samples, m/s².
    pub accel: Vector3<f32>,
}

/// The error that the filter has found, to be added to the nominal state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Correction {
    /// θ in the world, rad.
    pub theta: Vector3<f32>,
    /// m/s.
    pub velocity: Vector3<f32>,
    /// m.
    pub position: Vector3<f32>,
    /// rad/s.
    pub gyro_bias: Vector3<f32>,
    /// m/s².
    pub accel_bias: Vector3<f32>,
}

/// The nominal state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nominal {
    /// Body to world.
    pub attitude: UnitQuaternion<f32>,
    /// m/s.
    pub velocity: Vector3<f32>,
    /// m.
    pub position: Vector3<f32>,
    /// rad/s.
    pub gyro_bias: Vector3<f32>,
    /// m/s².
    pub accel_bias: Vector3<f32>,
}

impl Nominal {
    /// At rest and level, without biases.
    pub fn at_rest(position: Vector3<f32>) -> Self {
        let zero = Vector3::zeros();
        Self { attitude: UnitQuaternion::identity(), velocity: zero, position, gyro_bias: zero, accel_bias: zero }
    }
}

/// The predictor: owns the nominal state.
#[derive(Clone, Debug)]
pub struct Predictor {
    state: Nominal,
    /// Rounding error of the position sum, m (Kahan 1965): steps of millimetres at distances of kilometres.
    position_rest: Vector3<f32>,
    gravity: f32,
    /// Ω, and f in the body frame and in the world frame, of the previous tick.
    rates: Vector3<f32>,
    force: Vector3<f32>,
    force_in_world: Vector3<f32>,
    span: Span,
    last: Option<Tick>,
    /// Gyroscope and accelerometer of the last sample, and how many times in a row they have been repeated.
    repeated: (Vector3<f32>, Vector3<f32>, u32),
}

impl Predictor {
    /// At rest, with gravity g, m/s².
    pub fn new(position: Vector3<f32>, gravity: f32) -> Self {
        let force = Vector3::new(0.0, 0.0, gravity);
        Self {
            state: Nominal::at_rest(position),
            position_rest: Vector3::zeros(),
            gravity,
            rates: Vector3::zeros(),
            force,
            force_in_world: force,
            span: Span::default(),
            last: None,
            repeated: (Vector3::zeros(), Vector3::zeros(), 0),
        }
    }

    /// Integrates one tick, with the IMU's sample if one has arrived. Returns whether it was used: a sample that is
    /// implausible, stuck, or not newer than the last is treated as missing.
    #[inline]
    pub fn predict(&mut self, sample: Option<&ImuSample>) -> bool {
        let fresh = sample.filter(|sample| self.is_new(sample.at) && sample.is_plausible() && self.moves(sample));
        let (rates, force) = match fresh {
            Some(sample) => {
                self.last = Some(sample.at);
                self.span.samples += 1;
                self.span.gyro += sample.gyro;
                self.span.accel += sample.accel;
                (sample.gyro - self.state.gyro_bias, sample.accel - self.state.accel_bias)
            }
            None => (self.rates, self.force),
        };
        self.integrate(&rates, &force);
        self.rates = rates;
        self.force = force;
        fresh.is_some()
    }

    /// Whether a time stamp is later than the last. A stamp more than `JUMP` ticks back is accepted too: that is no
    /// sample out of order but a clock that was set back.
    #[inline]
    fn is_new(&self, at: Tick) -> bool {
        /// Chosen: longer than any reordering on a bus, shorter than what a reset clock goes back.
        const JUMP: Tick = 20;
        self.last.is_none_or(|last| {
            let ahead = at.wrapping_sub(last);
            ahead != 0 && (ahead < Tick::MAX / 2 || last.wrapping_sub(at) > JUMP)
        })
    }

    /// False for a stuck sensor: noise moves every working one, so six equal values in a row mean that it has stopped,
    /// whatever its time stamps say.
    #[inline]
    fn moves(&mut self, sample: &ImuSample) -> bool {
        /// Equal samples in a row, 20 ms. Chosen: quantised noise repeats a sample now and then, never twenty times.
        const STUCK_AFTER: u32 = 20;
        let (gyro, accel, count) = self.repeated;
        let same = gyro == sample.gyro && accel == sample.accel;
        self.repeated = (sample.gyro, sample.accel, if same { count.saturating_add(1) } else { 0 });
        self.repeated.2 < STUCK_AFTER
    }

    #[inline]
    fn integrate(&mut self, rates: &Vector3<f32>, force: &Vector3<f32>) {
        let state = &mut self.state;
        state.attitude = turned(&state.attitude, &((rates + self.rates) * (0.5 * TICK_S)));
        let force_in_world = state.attitude * force;
        let change = (force_in_world + self.force_in_world) * (0.5 * TICK_S);
        self.force_in_world = force_in_world;
        self.span.velocity_change += change;
        self.span.ticks += 1;
        let before = state.velocity;
        state.velocity += change;
        state.velocity.z -= self.gravity * TICK_S;
        let step = (before + state.velocity) * (0.5 * TICK_S) - self.position_rest;
        let position = state.position + step;
        self.position_rest = (position - state.position) - step;
        state.position = position;
    }

    /// The nominal state.
    #[inline]
    pub fn state(&self) -> &Nominal {
        &self.state
    }

    /// Ω without its bias, as integrated, rad/s.
    #[inline]
    pub fn rates(&self) -> &Vector3<f32> {
        &self.rates
    }

    /// f in the body frame without its bias, m/s².
    #[inline]
    pub fn specific_force(&self) -> &Vector3<f32> {
        &self.force
    }

    /// The last sample that was used, as it was measured.
    pub fn last_sample(&self) -> Option<ImuSample> {
        let (gyro, accel, _) = self.repeated;
        self.last.map(|at| ImuSample { at, gyro, accel })
    }

    /// The motion now, for the filter's history.
    pub fn snapshot(&self, at: Tick) -> Snapshot {
        let Nominal { attitude, velocity, position, .. } = self.state;
        Snapshot { at, attitude, velocity, position }
    }

    /// Returns the sums since the last call, and clears them.
    pub fn take_span(&mut self) -> Span {
        core::mem::take(&mut self.span)
    }

    /// Applies the filter's correction.
    pub fn correct(&mut self, c: &Correction) {
        let state = &mut self.state;
        state.attitude = turned_in_world(&state.attitude, &c.theta);
        state.velocity += c.velocity;
        state.position += c.position;
        state.gyro_bias += c.gyro_bias;
        state.accel_bias += c.accel_bias;
        self.rates -= c.gyro_bias;
        self.force -= c.accel_bias;
        self.force_in_world = state.attitude * self.force;
    }

    /// Continues from another state.
    pub fn start(&mut self, state: &Nominal) {
        self.rates -= state.gyro_bias - self.state.gyro_bias;
        self.force -= state.accel_bias - self.state.accel_bias;
        self.state = *state;
        self.position_rest = Vector3::zeros();
        self.force_in_world = state.attitude * self.force;
    }
}

/// The quaternion of a rotation vector of a few degrees, to fourth order in its size.
#[inline]
fn small_turn(turn: &Vector3<f32>) -> Quaternion<f32> {
    let half = turn * 0.5;
    let square = half.norm_squared();
    let sinc = 1.0 - square * (1.0 / 6.0);
    Quaternion::new(1.0 - square * (0.5 - square * (1.0 / 24.0)), half.x * sinc, half.y * sinc, half.z * sinc)
}

/// Normalises a quaternion of nearly unit size by one Newton step of 1/√n².
#[inline]
fn unit(q: Quaternion<f32>) -> UnitQuaternion<f32> {
    UnitQuaternion::new_unchecked(q * (1.5 - 0.5 * q.norm_squared()))
}

/// Turned by a small rotation vector in the body frame, rad.
#[inline]
fn turned(attitude: &UnitQuaternion<f32>, turn: &Vector3<f32>) -> UnitQuaternion<f32> {
    unit(attitude.quaternion() * small_turn(turn))
}

/// Turned by a rotation vector in the world, rad, of any size: an attitude that was far off is corrected at once.
pub(super) fn turned_in_world(attitude: &UnitQuaternion<f32>, turn: &Vector3<f32>) -> UnitQuaternion<f32> {
    let angle = math::sqrt(turn.norm_squared());
    if angle < 0.1 {
        return unit(small_turn(turn) * attitude.quaternion());
    }
    let (sin, cos) = math::sin_cos(0.5 * math::min(angle, core::f32::consts::PI));
    let axis = turn * (sin / angle);
    unit(Quaternion::new(cos, axis.x, axis.y, axis.z) * attitude.quaternion())
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "tests compare with bounds; what flies may not")]
mod tests {
    use super::*;

    const G: f32 = 9.81;

    fn sample(at: Tick, gyro: Vector3<f32>, accel: Vector3<f32>) -> ImuSample {
        ImuSample { at, gyro, accel }
    }

    /// A circle of 5 m radius at 1 rad/s with the heading along it: rates and force in the body frame are constant.
    #[test]
    fn a_circle_closes() {
        let (radius, rate) = (5.0_f32, 1.0_f32);
        let mut predictor = Predictor::new(Vector3::new(radius, 0.0, 0.0), G);
        predictor.start(&Nominal { velocity: Vector3::new(0.0, radius * rate, 0.0), ..*predictor.state() });
        // Heading north at (r, 0): the centre is behind.
        let imu = (Vector3::new(0.0, 0.0, rate), Vector3::new(-radius * rate * rate, 0.0, G));
        predictor.rates = imu.0;
        predictor.force = imu.1;
        predictor.force_in_world = imu.1;
        for tick in 1..=6_000 {
            predictor.predict(Some(&sample(tick, imu.0, imu.1)));
        }
        let exact = 6.0_f32 * rate;
        let (sin, cos) = (f64::from(exact).sin() as f32, f64::from(exact).cos() as f32);
        let state = predictor.state();
        assert!((state.position - Vector3::new(radius * cos, radius * sin, 0.0)).norm() < 2e-3, "{}", state.position);
        assert!((state.velocity - Vector3::new(-sin, cos, 0.0) * radius).norm() < 1e-3, "{}", state.velocity);
    }

    #[test]
    fn small_steps_far_away_are_not_lost() {
        let mut predictor = Predictor::new(Vector3::new(20_000.0, 0.0, 0.0), G);
        predictor.start(&Nominal { velocity: Vector3::new(0.1, 0.0, 0.0), ..*predictor.state() });
        for tick in 1..=10_000 {
            predictor.predict(Some(&sample(tick, Vector3::zeros(), Vector3::new(0.0, 0.0, G))));
        }
        // A step of 0.1 mm is a twentieth of what an f32 resolves there.
        assert!((predictor.state().position.x - 20_001.0).abs() < 5e-3, "{}", predictor.state().position.x);
    }

    #[test]
    fn a_sample_that_is_missing_repeated_late_or_nan_is_replaced_by_the_last_one() {
        let turning = Vector3::new(0.3, -0.2, 0.5);
        let force = Vector3::new(0.1, 0.2, 9.0);
        let (mut sound, mut lossy) = (Predictor::new(Vector3::zeros(), G), Predictor::new(Vector3::zeros(), G));
        let bad = sample(4, Vector3::new(f32::NAN, 0.0, 0.0), force);
        for tick in 1..=16 {
            let good = sample(tick, turning, force);
            assert!(sound.predict(Some(&good)));
            let given = match tick % 4 {
                1 => Some(good),
                2 => None,
                3 => Some(sample(tick - 2, turning * 3.0, force)),
                _ => Some(ImuSample { at: tick, ..bad }),
            };
            assert_eq!(lossy.predict(given.as_ref()), tick % 4 == 1);
        }
        assert_eq!(sound.state(), lossy.state());
        assert_eq!((lossy.take_span().samples, lossy.take_span().ticks), (4, 0));
    }

    /// Spikes from a bus error, not from a motion: a refused one leaves no trace, an accepted one a finite motion.
    #[test]
    fn a_sample_beyond_any_sensors_range_does_not_end_the_attitude() {
        let still = (Vector3::zeros(), Vector3::new(0.0, 0.0, G));
        let mut predictor = Predictor::new(Vector3::zeros(), G);
        for (k, size) in (1..).zip([1.0_f32, 69.0, 130.0, 600.0, 1e4, 1e6, 1e20, f32::MAX, f32::INFINITY]) {
            for (axis, accel) in [(0, false), (1, false), (2, false), (0, true), (1, true), (2, true)] {
                let tick = k * 100 + axis as Tick * 10 + Tick::from(accel);
                let mut spike = sample(tick, still.0, still.1);
                let of = if accel { &mut spike.accel } else { &mut spike.gyro };
                of[axis] = -size;
                let range = if accel { 544.0 } else { 121.0 };
                assert_eq!(predictor.predict(Some(&spike)), size < range, "{spike:?}");
                predictor.predict(Some(&sample(tick + 5, still.0, still.1)));
                let state = predictor.state();
                assert!((state.attitude.norm() - 1.0).abs() < 1e-5, "{spike:?}: {state:?}");
                assert!(state.velocity.norm() < 10.0 && state.position.norm() < 10.0, "{spike:?}: {state:?}");
            }
        }
    }

    #[test]
    fn a_correction_turns_in_the_world() {
        let mut predictor = Predictor::new(Vector3::zeros(), G);
        let start = UnitQuaternion::from_euler_angles(0.3, -0.4, 1.0);
        predictor.start(&Nominal { attitude: start, ..*predictor.state() });
        for turn in [Vector3::new(0.01, -0.02, 0.03), Vector3::new(0.5, 0.7, -2.0)] {
            let before = predictor.state().attitude;
            predictor.correct(&Correction { theta: turn, ..Correction::default() });
            let ought = UnitQuaternion::new(turn) * before;
            assert!(predictor.state().attitude.angle_to(&ought) < 2e-6);
        }
    }
}
