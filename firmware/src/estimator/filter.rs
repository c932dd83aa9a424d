//! The outer half of the estimator: covariance, late readings, gates, and what is to be trusted.
//!
//! One job every 4 ms: the error state's covariance is moved to the newest snapshot, each reading that has come since
//! the last job is fused at its own time, and the error found is handed back for the predictor to take off. Position and
//! height have an offset a source ([`index::OFFSET`], [`index::HEIGHT_OFFSET`]): a receiver's slow wandering is not
//! taken for motion, and a source that has jumped and stays there moves its offset, never the vehicle.

use nalgebra::{UnitQuaternion, Vector3};

use super::align::{self, Aligner, Alignment};
use super::covariance::{self, Covariance, ErrorState, Row, index};
use super::history::{History, Moved, Snapshot};
use super::models::{Age, MagneticNorth, NONE, attitude_row, pressure_height, turn_between};
use super::predictor::{Correction, Nominal, Span};
use super::settings::EstimatorSettings;
use super::update::{Measurement, Verdict, gate};
use super::watch::Watch;
use crate::frames::LocalFrame;
use crate::math;
use crate::sensors::{BaroSample, GnssSample, MagSample, PoseSample};
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
    /// Whether the vehicle is known to stand: disarmed, on the ground.
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
#[expect(clippy::large_enum_variant, reason = "there is no heap to put one on")]
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
const JUMPED_AFTER: Tick = 2_500;
/// A source that has been silent, or at odds, for this long is lost, ticks.
const LOST_AFTER: Tick = 1_500;
/// The heading needs no reading for this long, ticks.
const HEADING_LOST_AFTER: Tick = 30_000;
/// As many equal readings in a row are a sensor that has stopped.
const STUCK_AFTER: u32 = 8;
/// Beyond these nothing is trusted: tilt and heading (rad), velocity (m/s), position and height (m).
const TILT_SIGMA_MAX: f32 = 0.2;
const HEADING_SIGMA_MAX: f32 = 0.4;
const SPEED_SIGMA_MAX: f32 = 1.0;
const POSITION_SIGMA_MAX: f32 = 10.0;
const HEIGHT_SIGMA_MAX: f32 = 5.0;
/// Drag is fused every so many jobs.
const DRAG_EVERY: u32 = 20;
/// And standing.
const REST_EVERY: u32 = 25;
/// Noise of drag as a specific force, m/s²: what gusts, tilting and the model leave of a mean over as many jobs.
const DRAG_NOISE: f32 = 0.08;
/// A vehicle at rest stands this still, m/s.
const REST_NOISE: f32 = 0.02;
/// How long ago a motion capture's pose may be for an alignment, ticks.
const POSE_FRESH: Tick = 200;

/// Values of the states that the filter alone knows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Offsets {
    gnss: [f32; 2],
    height: f32,
    heading: f32,
    wind: [f32; 2],
}

/// Which sensor the height is by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum HeightSource {
    None,
    Baro,
    Gnss,
}

#[derive(Clone, Debug, Default)]
struct Watches {
    mag: Watch,
    baro: Watch,
    gnss: Watch,
    gnss_velocity: Watch,
    gnss_height: Watch,
    pose: Watch,
    pose_attitude: Watch,
}

/// The filter.
#[derive(Clone, Debug)]
pub struct Filter {
    settings: EstimatorSettings,
    gravity: f32,
    /// k over m of the airframe along x and y, 1/s.
    specific_drag: f32,
    north: Option<MagneticNorth>,
    /// Until the vehicle is aligned.
    aligner: Option<Aligner>,
    covariance: Covariance,
    history: History,
    offsets: Offsets,
    watches: Watches,
    frame: Option<LocalFrame>,
    height_by: HeightSource,
    last_pose: Option<PoseSample>,
    /// Found but not known to have been taken in.
    ordered: Correction,
    started: Option<Nominal>,
    jobs: u32,
    /// Sum of the accelerometer's samples since drag was last fused, m/s², and how many.
    force: (Vector3<f32>, u32),
}

/// What a job works with.
struct Job<'a> {
    now: Snapshot,
    input: &'a FilterInput,
    /// Found so far.
    error: ErrorState,
    consistency: heapless::Vec<Consistency, 8>,
}

impl Job<'_> {
    fn note(&mut self, source: Source, verdict: Verdict) {
        // As many as there are sources.
        let _ = self.consistency.push(Consistency { source, verdict });
    }
}

impl Filter {
    /// Not yet aligned. `specific_drag` is the airframe's k/m, 1/s.
    pub fn new(settings: &EstimatorSettings, gravity: f32, specific_drag: f32) -> Self {
        Self {
            settings: *settings,
            gravity,
            specific_drag,
            north: MagneticNorth::new(settings.magnetic_field_ut.into()),
            aligner: Some(Aligner::default()),
            covariance: Covariance::diagonal(&ErrorState::zeros()),
            history: History::new(),
            offsets: Offsets::default(),
            watches: Watches::default(),
            frame: None,
            height_by: HeightSource::None,
            last_pose: None,
            ordered: Correction::default(),
            started: None,
            jobs: 0,
            force: (Vector3::zeros(), 0),
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
        let parts = [c.theta, c.velocity, c.position, c.gyro_bias, c.accel_bias];
        for (to, from) in error.iter_mut().zip(parts.iter().flat_map(|v| v.iter())) {
            *to = *from;
        }
        error
    }

    // ---------------------------------------------------------------------------------------------- beginning

    fn align(&mut self, now: Tick, input: &FilterInput) -> FilterOutput {
        let mag = input.readings.mag.filter(|mag| math::all_finite(mag.field_ut.as_slice()));
        let pose = self.last_pose.filter(|pose| now.wrapping_sub(pose.at) < POSE_FRESH);
        let Some(aligner) = &mut self.aligner else { return FilterOutput::initial() };
        let found = aligner.step(&input.span, mag.as_ref(), pose.as_ref(), self.north.as_ref(), self.gravity);
        let Some(alignment) = found else { return FilterOutput::initial() };
        let state = self.begin(&alignment, pose.as_ref(), input);
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
    fn begin(&mut self, alignment: &Alignment, pose: Option<&PoseSample>, input: &FilterInput) -> Nominal {
        let settings = &self.settings;
        let still = alignment.gyro_bias.is_some();
        let tilt = align::tilt_sigma(still, settings.accel_bias, self.gravity);
        let heading = match (alignment.has_heading, pose) {
            (_, Some(_)) => settings.pose_attitude_rad,
            (true, None) => settings.heading_offset + 2.0 * tilt,
            (false, None) => core::f32::consts::PI,
        };
        let tilt = if pose.is_some() { settings.pose_attitude_rad } else { tilt };
        let speed = if still { REST_NOISE } else { 2.0 };
        let averaged = alignment.gyro_bias.map(|_| align::WINDOW_S);
        self.covariance = Covariance::diagonal(&settings.initial(tilt, heading, speed, averaged));
        Nominal {
            attitude: alignment.attitude,
            position: pose.map_or(input.state.position, |pose| pose.position),
            gyro_bias: alignment.gyro_bias.unwrap_or_default(),
            ..Nominal::at_rest(input.state.position)
        }
    }

    // ------------------------------------------------------------------------------------------------ a job

    fn predict(&mut self, input: &FilterInput, attitude: &UnitQuaternion<f32>) {
        let step_s = input.span.ticks as f32 * TICK_S;
        let off = input.force - Vector3::z() * self.gravity;
        let noise = self.settings.step_noise(step_s, &(attitude * input.rates), math::sqrt(off.norm_squared()));
        let motion = covariance::Motion {
            step_s,
            rotation: attitude.to_rotation_matrix().into_inner(),
            velocity_change: input.span.velocity_change,
        };
        self.covariance.predict(&motion, &noise);
    }

    fn fuse(&mut self, job: &mut Job) {
        let readings = &job.input.readings;
        if let Some(pose) = readings.pose.filter(PoseSample::is_valid) {
            self.fuse_pose(job, &pose);
        }
        if let Some(gnss) = readings.gnss.filter(|gnss| gnss.has_fix && gnss.is_finite()) {
            self.fuse_gnss(job, &gnss);
        }
        if let Some(baro) = readings.baro.filter(|baro| baro.pressure_pa > 1e3 && baro.pressure_pa < 1.3e5) {
            self.fuse_baro(job, &baro);
        }
        if let Some(mag) = readings.mag.filter(|mag| math::all_finite(mag.field_ut.as_slice())) {
            self.fuse_mag(job, &mag);
        }
        if job.input.at_rest && self.jobs.is_multiple_of(REST_EVERY) {
            self.fuse_rest(job);
        }
        let span = &job.input.span;
        self.force = (self.force.0 + span.accel, self.force.1 + span.samples);
        if self.jobs.is_multiple_of(DRAG_EVERY) {
            let (sum, samples) = core::mem::take(&mut self.force);
            if samples > 0 && !job.input.at_rest {
                self.fuse_drag(job, &(sum / samples as f32 - job.input.state.accel_bias));
            }
        }
    }

    /// Orders the correction and says what is to be trusted.
    fn finish(&mut self, job: Job) -> FilterOutput {
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
        let injection = match self.started.take_if(|_| !job.input.injected) {
            // The start itself was lost: once more, corrected.
            Some(start) => {
                self.started = Some(start);
                Injection::Start(start)
            }
            None => {
                self.started = None;
                Injection::Correct(correction)
            }
        };
        FilterOutput {
            injection,
            health: self.health(job.now.at),
            wind: self.offsets.wind,
            sigma: self.sigma(),
            consistency: job.consistency,
        }
    }

    // --------------------------------------------------------------------------------------------- the sensors

    /// The past of a reading; none if it is not remembered.
    fn age(&self, at: Tick, now: &Snapshot) -> Option<Age> {
        self.history.at(at).map(|past| Age::new(&past, now, self.gravity))
    }

    fn fuse_mag(&mut self, job: &mut Job, mag: &MagSample) {
        let Some((age, north)) = self.age(mag.at, &job.now).zip(self.north) else { return };
        let field = mag.field_ut;
        if !self.watches.mag.admits(mag.at, field.into(), STUCK_AFTER) || !north.is_plausible(&field) {
            return;
        }
        let reading = north.read(&field, &age.then.attitude);
        let sigma = self.settings.mag_noise_ut / reading.horizontal_ut;
        let believed = self.offsets.heading + reading.row.dot(&age.since);
        let measurement = Measurement {
            rows: [reading.row],
            innovation: [math::wrap_angle(reading.turn - believed)],
            variance: [sigma * sigma],
        };
        let verdict = measurement.apply(&mut self.covariance, &mut job.error, gate::<1>());
        job.note(Source::Heading, verdict);
        self.watches.mag.note(job.now.at, verdict.accepted);
        if self.watches.mag.is_at_odds(job.now.at, 2 * JUMPED_AFTER) {
            self.offsets.heading += measurement.innovation[0] - reading.row.dot(&job.error);
            self.covariance.set_variance(index::HEADING_OFFSET, sigma * sigma);
            self.watches.mag.note(job.now.at, true);
        }
    }

    fn fuse_baro(&mut self, job: &mut Job, baro: &BaroSample) {
        let Some(age) = self.age(baro.at, &job.now) else { return };
        if !self.watches.baro.admits(baro.at, [baro.pressure_pa, 0.0, 0.0], STUCK_AFTER) {
            return;
        }
        let height = pressure_height(baro.pressure_pa);
        let noise = self.settings.baro_noise_m;
        if self.height_by == HeightSource::Baro || !self.watches.baro.is_live(job.now.at, LOST_AFTER) {
            let verdict = self.fuse_height(job, &age, height, noise * noise, HeightSource::Baro);
            job.note(Source::Baro, verdict);
            self.watches.baro.note(job.now.at, verdict.accepted);
            if self.watches.baro.is_at_odds(job.now.at, JUMPED_AFTER) {
                self.height_by = HeightSource::None;
            }
        }
    }

    /// A height by a source whose offset is known, or is set so that the source reads the height believed.
    fn fuse_height(&mut self, job: &mut Job, age: &Age, height: f32, variance: f32, by: HeightSource) -> Verdict {
        let row = age.position(2, (index::HEIGHT_OFFSET, 1.0));
        let beyond = height - age.then.position.z - row.dot(&age.since) - row.dot(&job.error);
        if self.height_by != by {
            self.height_by = by;
            self.offsets.height = beyond;
            self.covariance.set_variance(index::HEIGHT_OFFSET, variance);
            return Verdict { nis: 0.0, accepted: true };
        }
        let innovation = height - age.then.position.z - row.dot(&age.since) - self.offsets.height;
        let measurement = Measurement { rows: [row], innovation: [innovation], variance: [variance] };
        measurement.apply(&mut self.covariance, &mut job.error, gate::<1>())
    }

    fn fuse_gnss(&mut self, job: &mut Job, gnss: &GnssSample) {
        let Some(age) = self.age(gnss.at, &job.now) else { return };
        let place = gnss.place;
        let value = [place.latitude_e7, place.longitude_e7, place.height_mm].map(|v| f32::from_bits(v as u32));
        if !self.watches.gnss.admits(gnss.at, value, 2) {
            return;
        }
        self.fuse_gnss_velocity(job, &age, gnss);
        let believed = age.then.position;
        let anchor = believed + axes_of(&age.since, index::POSITION);
        let frame = *self.frame.get_or_insert_with(|| LocalFrame::new(place));
        let local = frame.to_local(&place);
        if !self.watches.gnss.is_live(job.now.at, Tick::MAX / 4) {
            // The first: its frame is where the vehicle is.
            self.offsets.gnss = [local.x - anchor.x, local.y - anchor.y];
        }
        let [noise, noise_up] = self.settings.gnss_noise_m;
        let rows = [age.position(0, (index::OFFSET, 1.0)), age.position(1, (index::OFFSET + 1, 1.0))];
        let reads = [local.x - self.offsets.gnss[0], local.y - self.offsets.gnss[1]];
        let innovation: [f32; 2] = core::array::from_fn(|i| reads[i] - believed[i] - rows[i].dot(&age.since));
        let measurement = Measurement { rows, innovation, variance: [noise * noise; 2] };
        let verdict = measurement.apply(&mut self.covariance, &mut job.error, gate::<2>());
        job.note(Source::GnssPosition, verdict);
        self.watches.gnss.note(job.now.at, verdict.accepted);
        if self.watches.gnss.is_at_odds(job.now.at, JUMPED_AFTER) {
            self.move_gnss_offset(job, &rows, &innovation, noise * noise);
        }
        if !self.watches.baro.is_live(job.now.at, LOST_AFTER) && !self.watches.pose.is_live(job.now.at, LOST_AFTER) {
            let verdict = self.fuse_height(job, &age, local.z, noise_up * noise_up, HeightSource::Gnss);
            job.note(Source::GnssHeight, verdict);
            self.watches.gnss_height.note(job.now.at, verdict.accepted);
        }
    }

    /// The receiver has jumped and stays there: its frame has moved, not the vehicle.
    fn move_gnss_offset(&mut self, job: &mut Job, rows: &[Row; 2], innovation: &[f32; 2], variance: f32) {
        for (i, (row, innovation)) in rows.iter().zip(innovation).enumerate() {
            if let Some(offset) = self.offsets.gnss.get_mut(i) {
                *offset += innovation - row.dot(&job.error);
            }
            self.covariance.set_variance(index::OFFSET + i, variance);
        }
        self.watches.gnss.note(job.now.at, true);
    }

    fn fuse_gnss_velocity(&mut self, job: &mut Job, age: &Age, gnss: &GnssSample) {
        let [horizontal, up] = self.settings.gnss_speed_m_s;
        let rows = [0, 1, 2].map(|axis| age.velocity(axis));
        let believed = age.then.velocity;
        let innovation: [f32; 3] = core::array::from_fn(|i| gnss.velocity[i] - believed[i] - rows[i].dot(&age.since));
        let variance = [horizontal * horizontal, horizontal * horizontal, up * up];
        let measurement = Measurement { rows, innovation, variance };
        let verdict = measurement.apply(&mut self.covariance, &mut job.error, gate::<3>());
        job.note(Source::GnssVelocity, verdict);
        self.watches.gnss_velocity.note(job.now.at, verdict.accepted);
        if self.watches.gnss_velocity.is_at_odds(job.now.at, JUMPED_AFTER) {
            self.start_again(job, index::VELOCITY, &rows, &innovation, &variance);
            self.watches.gnss_velocity.note(job.now.at, true);
        }
    }

    fn fuse_pose(&mut self, job: &mut Job, pose: &PoseSample) {
        let Some(age) = self.age(pose.at, &job.now) else { return };
        if !self.watches.pose.admits(pose.at, pose.position.into(), STUCK_AFTER) {
            return;
        }
        let sigma = self.settings.pose_position_m;
        let rows = [0, 1, 2].map(|axis| age.position(axis, NONE));
        let believed = age.then.position;
        let innovation: [f32; 3] = core::array::from_fn(|i| pose.position[i] - believed[i] - rows[i].dot(&age.since));
        let variance = [sigma * sigma; 3];
        let verdict =
            Measurement { rows, innovation, variance }.apply(&mut self.covariance, &mut job.error, gate::<3>());
        job.note(Source::PosePosition, verdict);
        self.watches.pose.note(job.now.at, verdict.accepted);
        if self.watches.pose.is_at_odds(job.now.at, JUMPED_AFTER / 2) {
            self.start_again(job, index::POSITION, &rows, &innovation, &variance);
            self.watches.pose.note(job.now.at, true);
        }

        let sigma = self.settings.pose_attitude_rad;
        let turn = turn_between(&age.then.attitude, &pose.attitude);
        let rows = [0, 1, 2].map(attitude_row);
        let innovation: [f32; 3] = core::array::from_fn(|i| turn[i] - rows[i].dot(&age.since));
        let measurement = Measurement { rows, innovation, variance: [sigma * sigma; 3] };
        let verdict = measurement.apply(&mut self.covariance, &mut job.error, gate::<3>());
        job.note(Source::PoseAttitude, verdict);
        self.watches.pose_attitude.note(job.now.at, verdict.accepted);
    }

    /// Three states are set to what was read, whatever was believed.
    fn start_again(
        &mut self,
        job: &mut Job,
        first: usize,
        rows: &[Row; 3],
        innovation: &[f32; 3],
        variance: &[f32; 3],
    ) {
        for (i, ((row, innovation), variance)) in rows.iter().zip(innovation).zip(variance).enumerate() {
            let rest = innovation - row.dot(&job.error);
            if let Some(error) = job.error.get_mut(first + i) {
                *error += rest;
            }
            self.covariance.set_variance(first + i, *variance);
        }
    }

    /// A vehicle that stands does not move; one that is carried about is not taken to stand.
    fn fuse_rest(&mut self, job: &mut Job) {
        let force = math::sqrt(job.input.force.norm_squared());
        if job.input.rates.norm_squared() > 0.01 || math::abs(force - self.gravity) > 0.5 {
            return;
        }
        let rows =
            [0, 1, 2].map(|axis| Row { theta: Vector3::zeros(), entries: [(index::VELOCITY + axis, 1.0), NONE, NONE] });
        let v = job.now.velocity;
        let measurement = Measurement { rows, innovation: [-v.x, -v.y, -v.z], variance: [REST_NOISE * REST_NOISE; 3] };
        let verdict = measurement.apply(&mut self.covariance, &mut job.error, gate::<3>());
        job.note(Source::Rest, verdict);
    }

    /// Across the thrust axis nothing accelerates the vehicle but drag, −k/m (v − w). A mean over some turns of the rotors:
    /// they shake the accelerometer harder than any wind.
    fn fuse_drag(&mut self, job: &mut Job, force: &Vector3<f32>) {
        let across = job.now.attitude * Vector3::new(force.x, force.y, 0.0);
        let k = self.specific_drag;
        if !(k > 0.0) || !math::all_finite(across.as_slice()) {
            return;
        }
        let (v, w) = (&job.now.velocity, &self.offsets.wind);
        let rows = [0, 1].map(|axis| Row {
            theta: Vector3::zeros(),
            entries: [(index::VELOCITY + axis, -k), (index::WIND + axis, k), NONE],
        });
        let innovation = [across.x + k * (v.x - w[0]), across.y + k * (v.y - w[1])];
        let measurement = Measurement { rows, innovation, variance: [DRAG_NOISE * DRAG_NOISE; 2] };
        let verdict = measurement.apply(&mut self.covariance, &mut job.error, gate::<2>());
        job.note(Source::Drag, verdict);
    }

    // ------------------------------------------------------------------------------------------------- health

    fn sigma(&self) -> [f32; 9] {
        core::array::from_fn(|state| math::sqrt(math::max(self.covariance.variance(state), 0.0)))
    }

    fn health(&self, now: Tick) -> NavHealth {
        let [roll, pitch, heading, vx, vy, _, x, y, z] = self.sigma();
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
        }
    }
}

/// Three numbers of an error state.
fn axes_of(error: &ErrorState, first: usize) -> Vector3<f32> {
    Vector3::from_iterator((first..first + 3).map(|i| error.get(i).copied().unwrap_or(0.0)))
}
