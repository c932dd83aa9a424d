//! The inner half of the estimator, every tick: the nominal state, integrated from the IMU.
//!
//! Strapdown integration by trapezoids: `q ← q ⊗ exp(½ (ω₋ + ω) T)`, `v ← v + ½ (R₋f₋ + R f) T − g T e3`,
//! `p ← p + ½ (v₋ + v) T` (Titterton and Weston 2004, §11; at 1 kHz coning between two samples is below the gyroscope's
//! noise). A missing sample is the last one again. What the outer half needs of the time between two of its jobs is
//! summed up in a [`Span`]; what it finds out comes back as a [`Correction`].

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::history::Snapshot;
use crate::math;
use crate::sensors::ImuSample;
use crate::signals::{TICK_S, Tick};

/// Sums over the ticks between two jobs of the filter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Span {
    /// Ticks.
    pub ticks: u32,
    /// Ticks of them with a sample.
    pub samples: u32,
    /// ∫ R f dt, m/s.
    pub velocity_change: Vector3<f32>,
    /// Sum of the gyroscope's samples, rad/s.
    pub gyro: Vector3<f32>,
    /// Sum of the accelerometer's samples, m/s².
    pub accel: Vector3<f32>,
}

/// An error state found by the filter, to be taken off.
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

/// The predictor and the nominal state.
#[derive(Clone, Debug)]
pub struct Predictor {
    state: Nominal,
    /// What adding to the position in f32 has lost, m (Kahan 1965): 1 kHz steps of mm at a distance of km.
    position_rest: Vector3<f32>,
    gravity: f32,
    /// Ω, and f in the body's and in the world's frame, of the tick before.
    rates: Vector3<f32>,
    force: Vector3<f32>,
    force_in_world: Vector3<f32>,
    span: Span,
    last: Option<Tick>,
    /// The last sample's numbers, and how often they have come in a row.
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

    /// One tick, with the IMU's sample if a sound one has come. True if it was taken in: a sample that holds a number
    /// which no sensor can read, or is no newer than the last, is as good as none.
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

    /// Time stamps go forward, but for samples that come in the wrong order; a clock that goes back by more has jumped.
    #[inline]
    fn is_new(&self, at: Tick) -> bool {
        const JUMP: Tick = 20;
        self.last.is_none_or(|last| {
            let ahead = at.wrapping_sub(last);
            ahead != 0 && (ahead < Tick::MAX / 2 || last.wrapping_sub(at) > JUMP)
        })
    }

    /// Noise moves every sound sensor: one whose six numbers stand still has stopped, whatever its stamps say.
    #[inline]
    fn moves(&mut self, sample: &ImuSample) -> bool {
        /// In a row: by chance never.
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

    /// f in the body's frame without its bias, m/s².
    #[inline]
    pub fn specific_force(&self) -> &Vector3<f32> {
        &self.force
    }

    /// The motion now, for the filter's history.
    pub fn snapshot(&self, at: Tick) -> Snapshot {
        let Nominal { attitude, velocity, position, .. } = self.state;
        Snapshot { at, attitude, velocity, position }
    }

    /// The sums since the last call.
    pub fn take_span(&mut self) -> Span {
        core::mem::take(&mut self.span)
    }

    /// Takes off an error that the filter has found.
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

    /// Starts from another state.
    pub fn start(&mut self, state: &Nominal) {
        self.rates -= state.gyro_bias - self.state.gyro_bias;
        self.force -= state.accel_bias - self.state.accel_bias;
        self.state = *state;
        self.position_rest = Vector3::zeros();
        self.force_in_world = state.attitude * self.force;
    }
}

/// exp of half a rotation vector of a few degrees, to fourth order in its size.
#[inline]
fn small_turn(turn: &Vector3<f32>) -> Quaternion<f32> {
    let half = turn * 0.5;
    let square = half.norm_squared();
    let sinc = 1.0 - square * (1.0 / 6.0);
    Quaternion::new(1.0 - square * (0.5 - square * (1.0 / 24.0)), half.x * sinc, half.y * sinc, half.z * sinc)
}

/// An attitude brought back to unit size by one Newton step of 1/√n².
#[inline]
fn unit(q: Quaternion<f32>) -> UnitQuaternion<f32> {
    UnitQuaternion::new_unchecked(q * (1.5 - 0.5 * q.norm_squared()))
}

/// Turned by a small rotation vector in the body's frame, rad.
#[inline]
fn turned(attitude: &UnitQuaternion<f32>, turn: &Vector3<f32>) -> UnitQuaternion<f32> {
    unit(attitude.quaternion() * small_turn(turn))
}

/// Turned by a rotation vector in the world, rad: of any size, for corrections of an attitude that was far off.
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

    /// A circle of 5 m at 1 rad/s, turning with it: constant rates and, in the body, constant force.
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
    fn a_sample_that_is_missing_repeated_late_or_no_number_is_the_last_one_again() {
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

    /// Spikes of a bus rather than of a motion: what is refused leaves no trace, what is let through leaves a motion.
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
