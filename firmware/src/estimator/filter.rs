//! The outer half of the estimator: covariance, late readings, gates, and what is to be trusted.
//!
//! One job every 4 ms: the error state's covariance is moved to the newest snapshot, each reading that has come since
//! the last job is fused at its own time, and the error found is handed back for the predictor to take off. Position and
//! height have an offset a source ([`index::OFFSET`], [`index::HEIGHT_OFFSET`]): a receiver's slow wandering is not
//! taken for motion, and a source that has jumped and stays there moves its offset, never the vehicle.

use nalgebra::{UnitQuaternion, Vector3};

use super::align::{self, Aligner, Alignment};
use super::covariance::{self, Covariance, ErrorState, StepNoise, index};
use super::fusion::{REST_NOISE, STILL_JOBS};
use super::history::{History, Moved, Snapshot};
use super::models::MagneticNorth;
use super::predictor::{Correction, Nominal, Span};
use super::settings::EstimatorSettings;
use super::update::Verdict;
use super::watch::{Scatter, Watch};
use crate::frames::LocalFrame;
use crate::math;
use crate::sensors::{BaroSample, GnssSample, MagSample, Measurements, PoseSample};
use crate::signals::{NavHealth, TICK_S, Tick};

/// Readings since the last job: of each sensor the newest.
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
}

/// Snapshot for the filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterInput {
    /// The predictor's state, before the last job's correction if that has been lost.
    pub state: Nominal,
    /// Ω without bias, rad/s.
    pub rates: Vector3<f32>,
    /// f without bias in the body's frame, m/s².
    pub force: Vector3<f32>,
    /// Sums since the last job.
    pub span: Span,
    /// Whether the last job's injection was taken in.
    pub injected: bool,
    /// Whether the vehicle is on the ground.
    pub landed: bool,
    /// Whether it is known to stand there: disarmed.
    pub at_rest: bool,
    /// What has come.
    pub readings: Readings,
}

/// What a reading was of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Magnetic heading: one number.
    Heading,
    /// Height by pressure: one number.
    Baro,
    /// Place by satellites: two numbers.
    GnssPosition,
    /// Height by satellites: one number.
    GnssHeight,
    /// Velocity by satellites: three numbers.
    GnssVelocity,
    /// Position by motion capture: three numbers.
    PosePosition,
    /// Attitude by motion capture: three numbers.
    PoseAttitude,
    /// Drag, which tells the velocity through the air: two numbers.
    Drag,
    /// Standing: three numbers.
    Rest,
}

/// One reading's consistency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Consistency {
    /// Of what.
    pub source: Source,
    /// Normalised innovation squared, and whether the reading was taken in.
    pub verdict: Verdict,
}

/// What the predictor is to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Injection {
    /// Nothing.
    None,
    /// Take off an error.
    Correct(Correction),
    /// Start from this state.
    Start(Nominal),
}

/// What a job has found.
#[derive(Clone, Debug, PartialEq)]
pub struct FilterOutput {
    /// For the predictor.
    pub injection: Injection,
    /// What of the motion is to be trusted.
    pub health: NavHealth,
    /// Wind, x and y, m/s.
    pub wind: [f32; 2],
    /// Standard deviations of attitude (rad), velocity (m/s) and position (m).
    pub sigma: [f32; 9],
    /// Of each reading of this job.
    pub consistency: heapless::Vec<Consistency, 8>,
}

impl FilterOutput {
    /// Before the first job.
    pub fn initial() -> Self {
        Self {
            injection: Injection::None,
            health: NavHealth::NONE,
            wind: [0.0; 2],
            sigma: [0.0; 9],
            consistency: heapless::Vec::new(),
        }
    }
}

/// A source that has been at odds for this long, ticks, is taken to have jumped.
pub(super) const JUMPED_AFTER: Tick = 2_500;
/// A source that has been silent, or at odds, for this long is lost, ticks.
pub(super) const LOST_AFTER: Tick = 1_500;
/// The heading needs no reading for this long, ticks.
const HEADING_LOST_AFTER: Tick = 30_000;
/// Beyond these nothing is trusted: tilt and heading (rad), velocity (m/s), position and height (m).
const TILT_SIGMA_MAX: f32 = 0.2;
const HEADING_SIGMA_MAX: f32 = 0.4;
const SPEED_SIGMA_MAX: f32 = 1.0;
const POSITION_SIGMA_MAX: f32 = 10.0;
const HEIGHT_SIGMA_MAX: f32 = 5.0;
/// Part of the way in a job by which the force follows what is measured: 40 ms, some turns of the rotors.
const FORCE_PART: f32 = 0.1;
/// How long ago a motion capture's pose may be for an alignment, ticks.
const POSE_FRESH: Tick = 200;

/// Values of the states that the filter alone knows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Offsets {
    pub(super) gnss: [f32; 2],
    pub(super) height: f32,
    pub(super) heading: f32,
    pub(super) wind: [f32; 2],
}

/// Which sensor the height is by.
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
    /// Where the vehicle stands before anything else is known, m.
    start: Vector3<f32>,
    /// Ticks without a sample of the IMU until now.
    gap: u32,
    pub(super) north: Option<MagneticNorth>,
    /// Until the vehicle is aligned.
    aligner: Option<Aligner>,
    pub(super) covariance: Covariance,
    pub(super) history: History,
    pub(super) offsets: Offsets,
    pub(super) watches: Watches,
    pub(super) frame: Option<LocalFrame>,
    pub(super) height_by: HeightSource,
    pub(super) baro_scatter: Scatter,
    pub(super) mag_scatter: Scatter,
    last_pose: Option<PoseSample>,
    /// Found but not known to have been taken in.
    ordered: Correction,
    started: Option<Nominal>,
    pub(super) jobs: u32,
    /// For how many jobs it has been still.
    pub(super) still_jobs: u32,
    /// Sum of the accelerometer's samples since drag was last fused, m/s², and how many.
    pub(super) force: (Vector3<f32>, u32),
    /// How far the specific force in the body's frame is from that at rest, smoothed, m/s².
    force_off: Vector3<f32>,
}

/// What a job works with.
pub(super) struct Job<'a> {
    pub(super) now: Snapshot,
    pub(super) input: &'a FilterInput,
    /// Found so far.
    pub(super) error: ErrorState,
    consistency: heapless::Vec<Consistency, 8>,
}

impl Job<'_> {
    pub(super) fn note(&mut self, source: Source, verdict: Verdict) {
        // As many as there are sources.
        let _ = self.consistency.push(Consistency { source, verdict });
    }
}

impl Filter {
    /// Not yet aligned. `specific_drag` is the airframe's k/m, 1/s.
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

    /// One job, released at `now`.
    pub fn step(&mut self, now: Tick, input: &FilterInput) -> FilterOutput {
        self.jobs = self.jobs.wrapping_add(1);
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

    /// Where satellites' places are in the local frame, once the first has come.
    pub fn local_frame(&self) -> Option<&LocalFrame> {
        self.frame.as_ref()
    }

    /// The predictor's state; the one it was to start from, if that has been lost.
    fn state(&self, input: &FilterInput) -> Nominal {
        self.started.filter(|_| !input.injected).unwrap_or(input.state)
    }

    /// A correction that was lost is still to be made: it is the error already known.
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

    // ---------------------------------------------------------------------------------------------- beginning

    fn align(&mut self, now: Tick, input: &FilterInput) -> FilterOutput {
        let mag = input.readings.mag.filter(|mag| math::all_finite(mag.field_ut.as_slice()));
        let pose = self.last_pose.filter(|pose| now.wrapping_sub(pose.at) < POSE_FRESH);
        let Some(aligner) = &mut self.aligner else { return FilterOutput::initial() };
        let found = aligner.update(&input.span, mag.as_ref(), pose.as_ref(), self.north.as_ref(), self.gravity);
        let Some(alignment) = found else { return FilterOutput::initial() };
        let state = self.begin(&alignment, pose.as_ref());
        self.aligner = None;
        self.started = Some(state);
        let Nominal { attitude, velocity, position, .. } = state;
        self.history.clear();
        self.history.push(Snapshot { at: now, attitude, velocity, position });
        FilterOutput {
            injection: Injection::Start(state),
            health: self.health(now),
            sigma: self.sigma(),
            ..FilterOutput::initial()
        }
    }

    /// The state to start from; the covariance is set to what is known of it.
    fn begin(&mut self, alignment: &Alignment, pose: Option<&PoseSample>) -> Nominal {
        let settings = &self.settings;
        let still = alignment.gyro_bias.is_some();
        // The window has shown it.
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

    // ------------------------------------------------------------------------------------------------ a job

    fn predict(&mut self, input: &FilterInput, attitude: &UnitQuaternion<f32>) {
        let step_s = input.span.ticks as f32 * TICK_S;
        self.force_off += (input.force - Vector3::z() * self.gravity - self.force_off) * FORCE_PART;
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

    /// Without samples the last one is integrated on: what the vehicle does meanwhile is not known.
    fn add_gap(&mut self, span: &Span, noise: &mut StepNoise) {
        /// A vehicle in a manoeuvre: rad/s² and m/s³.
        const UNSEEN: (f32, f32) = (20.0, 50.0);
        let missing = span.ticks.saturating_sub(span.samples);
        self.gap = if span.samples == 0 { self.gap.saturating_add(missing) } else { missing };
        let both = self.gap as f32 * missing as f32 * (TICK_S * TICK_S);
        let (turn, push) = (UNSEEN.0 * both, UNSEEN.1 * both);
        noise.theta += Vector3::repeat(turn * turn);
        noise.velocity += push * push;
    }

    /// Orders the correction and says what is to be trusted.
    fn finish(&mut self, job: Job) -> FilterOutput {
        if !math::all_finite(job.error.as_slice()) {
            return self.give_up();
        }
        let e = job.error.as_slice();
        let three = |first: usize| match e.get(first..first + 3) {
            Some([x, y, z]) => Vector3::new(*x, *y, *z),
            _ => Vector3::zeros(),
        };
        let correction = Correction {
            theta: three(index::THETA),
            velocity: three(index::VELOCITY),
            position: three(index::POSITION),
            gyro_bias: three(index::GYRO_BIAS),
            accel_bias: three(index::ACCEL_BIAS),
        };
        let [gnss, more, wind] = [three(index::OFFSET), three(index::HEADING_OFFSET), three(index::WIND - 1)];
        let offsets = &mut self.offsets;
        offsets.gnss = [offsets.gnss[0] + gnss.x, offsets.gnss[1] + gnss.y];
        offsets.height += gnss.z;
        offsets.heading += more.x;
        offsets.wind = [offsets.wind[0] + wind.y, offsets.wind[1] + wind.z];
        let Correction { theta, velocity, position, .. } = correction;
        self.history.order(Moved { theta, velocity, position });
        self.ordered = correction;
        // A start that was lost is ordered once more.
        self.started = self.started.filter(|_| !job.input.injected);
        let injection = self.started.map_or(Injection::Correct(correction), Injection::Start);
        FilterOutput {
            injection,
            health: self.health(job.now.at),
            wind: self.offsets.wind,
            sigma: self.sigma(),
            consistency: job.consistency,
        }
    }

    /// Nothing is left that could be corrected: from the beginning.
    #[cold]
    fn give_up(&mut self) -> FilterOutput {
        self.aligner = Some(Aligner::default());
        self.offsets = Offsets::default();
        self.history.clear();
        FilterOutput::initial()
    }

    // ------------------------------------------------------------------------------------------------- health

    fn sigma(&self) -> [f32; 9] {
        // What is no number is not known at all.
        let root = |variance: f32| if variance >= 0.0 { math::sqrt(variance) } else { f32::INFINITY };
        core::array::from_fn(|state| root(self.covariance.variance(state)))
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
