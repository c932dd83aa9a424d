//! The outer half of the estimator: covariance, late readings, gates, and health.
//!
//! One job every 4 ms predicts the covariance to the newest snapshot, fuses each reading that has arrived since the
//! last job at its own time, and returns the error found as a correction for the predictor.
//!
//! Position and height have one offset per source ([`index::OFFSET`], [`index::HEIGHT_OFFSET`]), so that a receiver's
//! slow drift is not taken for motion. If a source jumps and stays there, its offset moves and the vehicle does not.

use nalgebra::{UnitQuaternion, Vector3};

use super::align::{self, Aligner, Alignment};
use super::covariance::{self, Covariance, ErrorState, StepNoise, index, triple};
use super::fusion::{REST_NOISE, STILL_JOBS};
use super::history::{History, Moved, Snapshot};
use super::models::MagneticNorth;
use super::predictor::{Correction, Nominal, Span};
use super::settings::EstimatorSettings;
use super::update::Verdict;
use super::watch::{Scatter, Watch};
use crate::frames::{LocalFrame, Origin};
use crate::math;
use crate::sensors::{BaroSample, GnssSample, MagSample, Measurements, PoseSample};
use crate::settings::{Change, Changes, Place};
use crate::signals::{NavHealth, TICK_S, Tick};

/// Readings since the last job: the newest of each sensor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Readings {
    /// Magnetometer.
    pub mag: Option<MagSample>,
    /// Barometer.
    pub baro: Option<BaroSample>,
    /// Satellites.
    pub gnss: Option<GnssSample>,
    /// Motion capture.
    pub pose: Option<PoseSample>,
}

impl Readings {
    /// Keeps the newest reading of each sensor.
    pub fn keep(&mut self, measured: &Measurements) {
        self.mag = measured.mag.or(self.mag);
        self.baro = measured.baro.or(self.baro);
        self.gnss = measured.gnss.or(self.gnss);
        self.pose = measured.pose.or(self.pose);
    }

    /// Replaces what newer readings have.
    pub fn update(&mut self, newer: &Self) {
        fn replace<T: Copy>(old: &mut Option<T>, new: Option<T>) {
            if new.is_some() {
                *old = new;
            }
        }
        replace(&mut self.mag, newer.mag);
        replace(&mut self.baro, newer.baro);
        replace(&mut self.gnss, newer.gnss);
        replace(&mut self.pose, newer.pose);
    }
}

/// Snapshot for the filter.
#[derive(Clone, Debug, PartialEq)]
pub struct FilterInput {
    /// The predictor's state. It lacks the last job's correction if that was lost.
    pub state: Nominal,
    /// Ω without bias, rad/s.
    pub rates: Vector3<f32>,
    /// f without bias in the body's frame, m/s².
    pub force: Vector3<f32>,
    /// Sums since the last job.
    pub span: Span,
    /// Whether the predictor applied the last job's injection.
    pub injected: bool,
    /// Whether the vehicle is on the ground.
    pub landed: bool,
    /// Whether it is on the ground and disarmed, so that it may be at rest.
    pub at_rest: bool,
    /// Readings since the last job.
    pub readings: Readings,
    /// Settings to take over before the job.
    pub changes: Changes,
}

/// Kind of a measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Magnetic heading: one component.
    Heading,
    /// Barometric height: one component.
    Baro,
    /// GNSS horizontal position: two components.
    GnssPosition,
    /// GNSS height: one component.
    GnssHeight,
    /// GNSS velocity: three components.
    GnssVelocity,
    /// Motion-capture position: three components.
    PosePosition,
    /// Motion-capture attitude: three components.
    PoseAttitude,
    /// Drag, which depends on the velocity through the air: two components.
    Drag,
    /// Zero-velocity update at rest: three components.
    Rest,
}

/// Consistency of one measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Consistency {
    /// Its kind.
    pub source: Source,
    /// Normalised innovation squared, and whether it was fused.
    pub verdict: Verdict,
}

/// Instruction for the predictor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Injection {
    /// Nothing.
    None,
    /// Apply a correction.
    Correct(Correction),
    /// Start from this state.
    Start(Nominal),
}

/// Output of a job.
#[derive(Clone, Debug, PartialEq)]
pub struct FilterOutput {
    /// For the predictor.
    pub injection: Injection,
    /// One entry per measurement of this job.
    pub consistency: heapless::Vec<Consistency, 8>,
    /// What is known of the motion.
    pub report: FilterReport,
}

/// What the filter knows after a job.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterReport {
    /// Which components of the motion may be trusted.
    pub health: NavHealth,
    /// Estimated wind, x and y, m/s.
    pub wind: [f32; 2],
    /// Its standard deviations, m/s.
    pub wind_sigma: [f32; 2],
    /// Where the local frame's origin is on Earth; `None` before the first GNSS fix.
    pub origin: Option<Origin>,
    /// Standard deviations of attitude (rad), velocity (m/s) and position (m), three components each.
    pub sigma: [f32; 9],
}

impl FilterOutput {
    /// Output of a job that has found nothing.
    fn none() -> Self {
        Self { injection: Injection::None, consistency: heapless::Vec::new(), report: FilterReport::NONE }
    }
}

impl FilterReport {
    /// Before the first job: nothing is known.
    pub const NONE: Self =
        Self { health: NavHealth::NONE, wind: [0.0; 2], wind_sigma: [f32::INFINITY; 2], origin: None, sigma: [0.0; 9] };
}

/// A source whose readings have failed the gate for this long has jumped, ticks.
pub(super) const JUMPED_AFTER: Tick = 2_500;
/// A source that has been silent, or whose readings have failed the gate, for this long is lost, ticks.
pub(super) const LOST_AFTER: Tick = 1_500;
/// The heading stays trusted this long without a reading, ticks: the gyroscope bias is known by then.
const HEADING_LOST_AFTER: Tick = 30_000;
/// Greatest trusted deviations: tilt and heading (rad), velocity (m/s), position and height (m). Chosen: a tilt of 0.2
/// rad lets the vehicle accelerate sideways by g/5, and 10 m is the accuracy beyond which a GNSS fix is not used
/// either.
const TILT_SIGMA_MAX: f32 = 0.2;
const HEADING_SIGMA_MAX: f32 = 0.4;
const SPEED_SIGMA_MAX: f32 = 1.0;
const POSITION_SIGMA_MAX: f32 = 10.0;
const HEIGHT_SIGMA_MAX: f32 = 5.0;
/// Gain per job of the low-pass on the specific force: a time constant of 40 ms, several rotor turns.
const FORCE_GAIN: f32 = 0.1;
/// Greatest age of a motion-capture pose used for alignment, ticks.
const POSE_FRESH: Tick = 200;

/// Values of the states that only the filter holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Offsets {
    pub(super) gnss: [f32; 2],
    pub(super) height: f32,
    pub(super) heading: f32,
    pub(super) wind: [f32; 2],
}

impl Offsets {
    /// Adds the error found.
    fn correct(&mut self, error: &ErrorState) {
        let [gnss_x, gnss_y, height] = triple(error, index::OFFSET).into();
        let [heading, wind_x, wind_y] = triple(error, index::HEADING_OFFSET).into();
        self.gnss = [self.gnss[0] + gnss_x, self.gnss[1] + gnss_y];
        self.height += height;
        self.heading += heading;
        self.wind = [self.wind[0] + wind_x, self.wind[1] + wind_y];
    }
}

/// The sensor that provides the height.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum HeightSource {
    None,
    Baro,
    Gnss,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Watches {
    pub(super) mag: Watch,
    pub(super) baro: Watch,
    pub(super) gnss: Watch,
    pub(super) gnss_velocity: Watch,
    pub(super) gnss_height: Watch,
    pub(super) pose: Watch,
    pub(super) pose_attitude: Watch,
}

/// The filter.
#[derive(Clone, Debug)]
pub struct Filter {
    pub(super) settings: EstimatorSettings,
    pub(super) gravity: f32,
    /// k over m of the airframe along x and y, 1/s.
    pub(super) specific_drag: f32,
    /// Position at start-up, m.
    start: Vector3<f32>,
    /// Ticks since the last IMU sample.
    gap: u32,
    pub(super) north: Option<MagneticNorth>,
    /// Present until the vehicle is aligned.
    aligner: Option<Aligner>,
    pub(super) covariance: Covariance,
    pub(super) history: History,
    pub(super) offsets: Offsets,
    pub(super) watches: Watches,
    pub(super) frame: Option<LocalFrame>,
    /// Where the local frame's origin was found to be by the first fix.
    pub(super) origin: Option<Origin>,
    pub(super) height_by: HeightSource,
    pub(super) baro_scatter: Scatter,
    pub(super) mag_scatter: Scatter,
    last_pose: Option<PoseSample>,
    /// The last correction and start state: not yet confirmed by the predictor.
    ordered: Correction,
    started: Option<Nominal>,
    pub(super) jobs: u32,
    /// Number of consecutive jobs during which the vehicle has been still.
    pub(super) still_jobs: u32,
    /// Sum of the accelerometer's samples since drag was last fused, m/s², and their number.
    pub(super) force: (Vector3<f32>, u32),
    /// Low-passed difference of the specific force in the body frame from that at rest, m/s².
    force_off: Vector3<f32>,
}

/// Working data of a job.
pub(super) struct Job<'a> {
    pub(super) now: Snapshot,
    pub(super) input: &'a FilterInput,
    /// Error state found so far.
    pub(super) error: ErrorState,
    consistency: heapless::Vec<Consistency, 8>,
}

impl Job<'_> {
    pub(super) fn note(&mut self, source: Source, verdict: Verdict) {
        // Its capacity is the number of sources that one job can have.
        let _ = self.consistency.push(Consistency { source, verdict });
    }
}

impl Filter {
    /// A filter that is not aligned yet, for a vehicle at `start` (m). `gravity` is g (m/s²), `specific_drag` the
    /// airframe's k/m (1/s).
    pub fn new(settings: &EstimatorSettings, gravity: f32, specific_drag: f32, start: Vector3<f32>) -> Self {
        Self {
            settings: *settings,
            gravity,
            specific_drag,
            start,
            gap: 0,
            north: MagneticNorth::new(settings.magnetic_field_ut.into()),
            aligner: Some(Aligner::default()),
            covariance: Covariance::diagonal(&ErrorState::zeros()),
            history: History::new(),
            offsets: Offsets::default(),
            watches: Watches::default(),
            frame: None,
            origin: None,
            height_by: HeightSource::None,
            baro_scatter: Scatter::default(),
            mag_scatter: Scatter::default(),
            last_pose: None,
            ordered: Correction::default(),
            started: None,
            jobs: 0,
            still_jobs: 0,
            force: (Vector3::zeros(), 0),
            force_off: Vector3::zeros(),
        }
    }

    /// Takes over a setting of the estimator.
    pub fn apply(&mut self, change: &Change) {
        if change.apply_to(&mut self.settings, Place::estimator) {
            self.north = MagneticNorth::new(self.settings.magnetic_field_ut.into());
        }
    }

    /// One job, released at `now`.
    pub fn step(&mut self, now: Tick, input: &FilterInput) -> FilterOutput {
        self.jobs = self.jobs.wrapping_add(1);
        for change in &input.changes {
            self.apply(change);
        }
        if let Some(pose) = input.readings.pose.filter(PoseSample::is_valid) {
            self.last_pose = Some(pose);
        }
        if self.aligner.is_some() {
            return self.align(now, input);
        }
        let Nominal { attitude, velocity, position, .. } = self.state(input);
        let snapshot = Snapshot { at: now, attitude, velocity, position };
        let error = if input.injected { ErrorState::zeros() } else { self.take_back() };
        self.predict(input, &attitude);
        self.history.push(snapshot);
        let mut job = Job { now: snapshot, input, error, consistency: heapless::Vec::new() };
        self.fuse(&mut job);
        self.finish(job)
    }

    /// The covariance.
    pub fn covariance(&self) -> &Covariance {
        &self.covariance
    }

    /// The conversion from WGS-84 to the local frame. `None` before the first GNSS fix.
    pub fn local_frame(&self) -> Option<&LocalFrame> {
        self.frame.as_ref()
    }

    /// The predictor's state, or the start state if its injection was lost.
    fn state(&self, input: &FilterInput) -> Nominal {
        self.started.filter(|_| !input.injected).unwrap_or(input.state)
    }

    /// The error that is already known because the last correction was lost.
    fn take_back(&mut self) -> ErrorState {
        self.history.order(Moved::default());
        let c = &self.ordered;
        let mut error = ErrorState::zeros();
        let components = [c.theta, c.velocity, c.position, c.gyro_bias, c.accel_bias];
        for (to, from) in error.iter_mut().zip(components.iter().flat_map(|v| v.iter())) {
            *to = *from;
        }
        error
    }

    // ---------------------------------------------------------------------------------------------- alignment

    fn align(&mut self, now: Tick, input: &FilterInput) -> FilterOutput {
        let mag = input.readings.mag.filter(|mag| math::all_finite(mag.field_ut.as_slice()));
        let pose = self.last_pose.filter(|pose| now.wrapping_sub(pose.at) < POSE_FRESH);
        let Some(aligner) = &mut self.aligner else { return FilterOutput::none() };
        let found = aligner.update(&input.span, mag.as_ref(), pose.as_ref(), self.north.as_ref(), self.gravity);
        let Some(alignment) = found else { return FilterOutput::none() };
        let state = self.begin(&alignment, pose.as_ref());
        self.aligner = None;
        self.started = Some(state);
        let Nominal { attitude, velocity, position, .. } = state;
        self.history.clear();
        self.history.push(Snapshot { at: now, attitude, velocity, position });
        FilterOutput {
            injection: Injection::Start(state),
            report: FilterReport {
                health: self.health(now),
                origin: self.origin,
                sigma: self.sigma(),
                ..FilterReport::NONE
            },
            ..FilterOutput::none()
        }
    }

    /// The state to start from. Sets the covariance to match.
    fn begin(&mut self, alignment: &Alignment, pose: Option<&PoseSample>) -> Nominal {
        let settings = &self.settings;
        let still = alignment.gyro_bias.is_some();
        // Alignment has already observed a second of rest.
        self.still_jobs = if still { STILL_JOBS } else { 0 };
        let tilt = align::tilt_sigma(still, settings.accel_bias, self.gravity);
        let heading = match (alignment.has_heading, pose) {
            (_, Some(_)) => settings.pose_attitude_rad,
            (true, None) => settings.heading_offset + self.north.map_or(1.0, MagneticNorth::slope) * tilt,
            (false, None) => core::f32::consts::PI,
        };
        let tilt = if pose.is_some() { settings.pose_attitude_rad } else { tilt };
        let speed = if still { REST_NOISE } else { 2.0 };
        let averaged = alignment.gyro_bias.map(|_| (align::WINDOW_S, alignment.scatter));
        self.covariance = Covariance::diagonal(&settings.initial(tilt, heading, speed, averaged));
        Nominal {
            attitude: alignment.attitude,
            gyro_bias: alignment.gyro_bias.unwrap_or_default(),
            ..Nominal::at_rest(pose.map_or(self.start, |pose| pose.position))
        }
    }

    // ----------------------------------------------------------------------------------------- prediction, output

    fn predict(&mut self, input: &FilterInput, attitude: &UnitQuaternion<f32>) {
        let step_s = input.span.ticks as f32 * TICK_S;
        self.force_off += (input.force - Vector3::z() * self.gravity - self.force_off) * FORCE_GAIN;
        let off = &self.force_off;
        let mut noise = self.settings.step_noise(step_s, &(attitude * input.rates), math::sqrt(off.norm_squared()));
        self.add_gap(&input.span, &mut noise);
        let motion = covariance::Motion {
            step_s,
            rotation: attitude.to_rotation_matrix().into_inner(),
            velocity_change: input.span.velocity_change,
        };
        self.covariance.predict(&motion, &noise);
    }

    /// Adds noise for missing IMU samples: the predictor repeats the last sample, and the true motion is unknown.
    fn add_gap(&mut self, span: &Span, noise: &mut StepNoise) {
        /// Angular acceleration (rad/s²) and jerk (m/s³) of a brisk manoeuvre.
        const UNSEEN: (f32, f32) = (20.0, 50.0);
        let missing = span.ticks.saturating_sub(span.samples);
        self.gap = if span.samples == 0 { self.gap.saturating_add(missing) } else { missing };
        let both = self.gap as f32 * missing as f32 * (TICK_S * TICK_S);
        let (turn, push) = (UNSEEN.0 * both, UNSEEN.1 * both);
        noise.theta += Vector3::repeat(turn * turn);
        noise.velocity += push * push;
    }

    /// Splits the error found into the predictor's correction and the filter's own offsets, and assesses the health.
    fn finish(&mut self, job: Job) -> FilterOutput {
        if !math::all_finite(job.error.as_slice()) {
            return self.give_up();
        }
        let e = &job.error;
        let correction = Correction {
            theta: triple(e, index::THETA),
            velocity: triple(e, index::VELOCITY),
            position: triple(e, index::POSITION),
            gyro_bias: triple(e, index::GYRO_BIAS),
            accel_bias: triple(e, index::ACCEL_BIAS),
        };
        self.offsets.correct(e);
        let Correction { theta, velocity, position, .. } = correction;
        self.history.order(Moved { theta, velocity, position });
        self.ordered = correction;
        // A start that was lost is ordered again.
        self.started = self.started.filter(|_| !job.input.injected);
        let injection = self.started.map_or(Injection::Correct(correction), Injection::Start);
        FilterOutput {
            injection,
            consistency: job.consistency,
            report: FilterReport {
                health: self.health(job.now.at),
                wind: self.offsets.wind,
                wind_sigma: [0, 1].map(|axis| self.deviation(index::WIND + axis)),
                origin: self.origin,
                sigma: self.sigma(),
            },
        }
    }

    /// The error is not finite, so nothing can be corrected: aligns again.
    #[cold]
    fn give_up(&mut self) -> FilterOutput {
        self.aligner = Some(Aligner::default());
        self.offsets = Offsets::default();
        // Without offsets the local frame is the receiver's.
        let origin = |frame: LocalFrame| frame.to_geodetic(&Vector3::zeros());
        self.origin = self.origin.zip(self.frame).map(|(was, frame)| Origin { place: origin(frame), ..was });
        self.history.clear();
        FilterOutput::none()
    }

    // ------------------------------------------------------------------------------------------------- health

    fn sigma(&self) -> [f32; 9] {
        core::array::from_fn(|state| self.deviation(state))
    }

    /// Standard deviation of a state.
    fn deviation(&self, state: usize) -> f32 {
        let variance = self.covariance.variance(state);
        // A variance of NaN means unknown.
        if variance >= 0.0 { math::sqrt(variance) } else { f32::INFINITY }
    }

    fn health(&self, now: Tick) -> NavHealth {
        let [roll, pitch, heading, vx, vy, vz, x, y, z] = self.sigma();
        let worst = |a: f32, b: f32| math::max(a, b);
        let w = &self.watches;
        let pose = w.pose.is_live(now, LOST_AFTER);
        let heading_read = pose || w.mag.is_live(now, HEADING_LOST_AFTER);
        let position_read = pose || w.gnss.is_live(now, 2 * JUMPED_AFTER);
        let heard = pose || w.gnss_velocity.is_live(now, LOST_AFTER);
        let height_read = pose || w.baro.is_live(now, LOST_AFTER) || w.gnss_height.is_live(now, LOST_AFTER);
        let velocity = worst(vx, vy) < SPEED_SIGMA_MAX;
        NavHealth {
            attitude: worst(roll, pitch) < TILT_SIGMA_MAX,
            heading: heading < HEADING_SIGMA_MAX && heading_read,
            velocity,
            position: velocity && position_read && heard && worst(x, y) < POSITION_SIGMA_MAX,
            height: height_read && z < HEIGHT_SIGMA_MAX,
            climb: vz < SPEED_SIGMA_MAX,
        }
    }
}
