//! Fusion of each sensor: from a sample to a measurement, and recovery when a sensor persistently disagrees.

use nalgebra::Vector3;

use super::covariance::{Row, index, triple};
use super::filter::{Filter, FilterInput, HeightSource, JUMPED_AFTER, Job, LOST_AFTER, Source};
use super::history::Snapshot;
use super::models::{Age, NONE, attitude_row, pressure_height, turn_between};
use super::update::{Measurement, Verdict, gate};
use crate::frames::{LocalFrame, Origin};
use crate::math;
use crate::sensors::{BaroSample, GnssSample, MagSample, PoseSample};
use crate::signals::Tick;

/// A sensor is stuck once it has repeated a reading this many times in a row.
const STUCK_AFTER: u32 = 8;
/// The same for a GNSS position, which is counted in mm and 1e-7° (1 cm): its noise hardly repeats one even once.
const GNSS_STUCK_AFTER: u32 = 2;
/// Drag is fused once per this many jobs: a mean over 80 ms.
const DRAG_EVERY: u32 = 20;
/// The zero-velocity update is made once per this many jobs: every 100 ms.
const REST_EVERY: u32 = 25;
/// A vehicle is at rest once it has been still for this many jobs, 1 s: one carried by hand is still for a moment too.
pub(super) const STILL_JOBS: u32 = 250;
/// Bounds of being still: rates (rad/s), within the greatest turn-on bias, and force beyond gravity (m/s²).
const STILL_RAD_S: f32 = 0.03;
const STILL_M_S2: f32 = 0.5;
/// Noise of drag as a specific force, m/s²: what gusts, tilt and the linear drag model leave in a mean over 80 ms.
const DRAG_NOISE: f32 = 0.08;
/// Deviation given to a state that is reset: larger than any in flight, in any unit, and small enough for f32
/// precision.
const RESET_SIGMA: f32 = 10.0;
/// Deviation added to the heading when the magnetometer disagrees persistently, rad.
const HEADING_IN_DOUBT: f32 = 0.2;
/// Above this rate, rad/s, the vehicle turns far enough during the mean of 80 ms for drag to average out.
const SPINNING_RAD_S: f32 = 3.0;
/// Deviation of the velocity of a vehicle at rest, m/s.
pub(super) const REST_NOISE: f32 = 0.02;

impl Filter {
    /// Fuses every reading that has arrived for this job.
    pub(super) fn fuse(&mut self, job: &mut Job) {
        let readings = &job.input.readings;
        if let Some(pose) = readings.pose.filter(PoseSample::is_valid) {
            self.fuse_pose(job, &pose);
        }
        if let Some(gnss) = readings.gnss.filter(GnssSample::is_usable) {
            self.fuse_gnss(job, &gnss);
        }
        if let Some(baro) = readings.baro.filter(|baro| baro.pressure_pa > 1e3 && baro.pressure_pa < 1.3e5) {
            self.fuse_baro(job, baro);
        }
        if let Some(mag) = readings.mag.filter(|mag| math::all_finite(mag.field_ut.as_slice())) {
            self.fuse_mag(job, &mag);
        }
        self.still_jobs = if self.is_still(job.input) { self.still_jobs.saturating_add(1) } else { 0 };
        if self.still_jobs >= STILL_JOBS && self.jobs.is_multiple_of(REST_EVERY) {
            self.fuse_rest(job);
        }
        let span = &job.input.span;
        self.force = (self.force.0 + span.accel, self.force.1 + span.samples);
        if self.jobs.is_multiple_of(DRAG_EVERY) {
            let (sum, samples) = core::mem::take(&mut self.force);
            let spins = job.input.rates.norm_squared() > SPINNING_RAD_S * SPINNING_RAD_S;
            if samples > 0 && !job.input.landed && !spins {
                self.fuse_drag(job, &(sum / samples as f32 - job.input.state.accel_bias));
            }
        }
    }

    /// The motion since a reading, or `None` if it is older than the history.
    fn age(&self, at: Tick, now: &Snapshot) -> Option<Age> {
        self.history.at(at).map(|past| Age::new(&past, now, self.gravity))
    }

    fn fuse_mag(&mut self, job: &mut Job, mag: &MagSample) {
        let Some((age, north)) = self.age(mag.at, &job.now).zip(self.north) else { return };
        let field = mag.field_ut;
        let bits: [f32; 3] = field.into();
        if !self.watches.mag.admits(mag.at, bits.map(f32::to_bits), STUCK_AFTER) || !north.is_plausible(&field) {
            return;
        }
        let reading = north.read(&field, &age.then.attitude);
        let sigma = self.settings.mag_noise_ut / reading.horizontal_ut;
        let factor = self.mag_scatter.noise_factor();
        let believed = self.offsets.heading + reading.row.dot(&age.since);
        let measurement = Measurement {
            rows: [reading.row],
            innovation: [math::wrap_angle(reading.turn - believed)],
            variance: [sigma * sigma * factor],
        };
        let verdict = measurement.apply(&mut self.covariance, &mut job.error, gate::<1>());
        self.mag_scatter.note(verdict.nis * factor);
        job.note(Source::Heading, verdict);
        self.watches.mag.note(job.now.at, verdict.accepted);
        if self.watches.mag.is_at_odds(job.now.at, 2 * JUMPED_AFTER) {
            self.offsets.heading += measurement.innovation[0] - reading.row.dot(&job.error);
            // The field cannot tell whether the heading or the magnetometer is wrong: let GNSS velocities decide.
            self.covariance.add_variance(index::THETA + 2, HEADING_IN_DOUBT * HEADING_IN_DOUBT);
            self.realign_offset(job, &measurement, index::HEADING_OFFSET);
            self.watches.mag.note(job.now.at, true);
        }
    }

    fn fuse_baro(&mut self, job: &mut Job, baro: BaroSample) {
        let Some(age) = self.age(baro.at, &job.now) else { return };
        if !self.watches.baro.admits(baro.at, [baro.pressure_pa.to_bits(), 0, 0], STUCK_AFTER) {
            return;
        }
        let height = pressure_height(baro.pressure_pa);
        let noise = self.settings.baro_noise_m;
        if self.height_by == HeightSource::Baro || !self.watches.baro.is_live(job.now.at, LOST_AFTER) {
            let factor = self.baro_scatter.noise_factor();
            let verdict = self.fuse_height(job, &age, height, noise * noise * factor, HeightSource::Baro);
            self.baro_scatter.note(verdict.nis * factor);
            job.note(Source::Baro, verdict);
            self.watches.baro.note(job.now.at, verdict.accepted);
            if self.watches.baro.is_at_odds(job.now.at, JUMPED_AFTER) {
                self.height_by = HeightSource::None;
            }
        }
    }

    /// Fuses a height. If the height source changes, the new source's offset is set so that it reads the estimated
    /// height.
    fn fuse_height(&mut self, job: &mut Job, age: &Age, height: f32, variance: f32, by: HeightSource) -> Verdict {
        let row = age.position(2, (index::HEIGHT_OFFSET, 1.0));
        let beyond = height - age.then.position.z - row.dot(&age.since) - row.dot(&job.error);
        if self.height_by != by {
            self.height_by = by;
            self.offsets.height = beyond;
            let measurement = Measurement { rows: [row], innovation: [0.0], variance: [variance] };
            self.realign_offset(job, &measurement, index::HEIGHT_OFFSET);
            return Verdict { nis: 0.0, accepted: true };
        }
        let innovation = height - age.then.position.z - row.dot(&age.since) - self.offsets.height;
        let measurement = Measurement { rows: [row], innovation: [innovation], variance: [variance] };
        measurement.apply(&mut self.covariance, &mut job.error, gate::<1>())
    }

    fn fuse_gnss(&mut self, job: &mut Job, gnss: &GnssSample) {
        let Some(age) = self.age(gnss.at, &job.now) else { return };
        let place = gnss.place;
        let bits = [place.latitude_e7, place.longitude_e7, place.height_mm].map(i32::cast_unsigned);
        if !self.watches.gnss.admits(gnss.at, bits, GNSS_STUCK_AFTER) {
            return;
        }
        self.fuse_gnss_velocity(job, &age, gnss);
        let believed = age.then.position;
        let here = believed + triple(&age.since, index::POSITION);
        let frame = *self.frame.get_or_insert_with(|| LocalFrame::new(place));
        let local = frame.to_local(&place);
        if !self.watches.gnss.is_live(job.now.at, Tick::MAX / 4) {
            // The first fix: the receiver's frame is placed where the vehicle is.
            self.offsets.gnss = [local.x - here.x, local.y - here.y];
            self.origin = Some(Origin { place: frame.to_geodetic(&(local - here)), separation_mm: gnss.separation_mm });
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
            self.move_gnss_offset(job, &measurement);
        }
        if !self.watches.baro.is_live(job.now.at, LOST_AFTER) && !self.watches.pose.is_live(job.now.at, LOST_AFTER) {
            let verdict = self.fuse_height(job, &age, local.z, noise_up * noise_up, HeightSource::Gnss);
            job.note(Source::GnssHeight, verdict);
            self.watches.gnss_height.note(job.now.at, verdict.accepted);
            if self.watches.gnss_height.is_at_odds(job.now.at, LOST_AFTER / 2) {
                self.height_by = HeightSource::None;
            }
        }
    }

    /// The receiver has jumped and stays there: its frame has moved, not the vehicle. Moves the offset.
    fn move_gnss_offset(&mut self, job: &mut Job, measurement: &Measurement<2>) {
        for ((offset, row), innovation) in
            self.offsets.gnss.iter_mut().zip(&measurement.rows).zip(measurement.innovation)
        {
            *offset += innovation - row.dot(&job.error);
        }
        self.realign_offset(job, measurement, index::OFFSET);
        self.watches.gnss.note(job.now.at, true);
    }

    /// Makes the covariance agree with N offsets, from state `first` on, that have been set so that a reading's
    /// innovation is zero: they are now known by that reading and by the other states that it depends on.
    fn realign_offset<const N: usize>(&mut self, job: &mut Job, measurement: &Measurement<N>, first: usize) {
        let error = job.error;
        let agrees = Measurement { innovation: measurement.rows.map(|row| row.dot(&error)), ..*measurement };
        self.reset_states_from(job, &agrees, first);
    }

    /// Resets N states, from `first` on, to what a reading says: their old variance and correlations are discarded, and
    /// the reading is fused without a gate.
    fn reset_states_from<const N: usize>(&mut self, job: &mut Job, measurement: &Measurement<N>, first: usize) {
        for state in first..first + N {
            self.covariance.set_variance(state, RESET_SIGMA * RESET_SIGMA);
        }
        measurement.apply(&mut self.covariance, &mut job.error, f32::INFINITY);
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
            self.reset_states_from(job, &measurement, index::VELOCITY);
            self.watches.gnss_velocity.note(job.now.at, true);
        }
    }

    fn fuse_pose(&mut self, job: &mut Job, pose: &PoseSample) {
        let Some(age) = self.age(pose.at, &job.now) else { return };
        let bits: [f32; 3] = pose.position.into();
        if !self.watches.pose.admits(pose.at, bits.map(f32::to_bits), STUCK_AFTER) {
            return;
        }
        let sigma = self.settings.pose_position_m;
        let rows = [0, 1, 2].map(|axis| age.position(axis, NONE));
        let believed = age.then.position;
        let innovation: [f32; 3] = core::array::from_fn(|i| pose.position[i] - believed[i] - rows[i].dot(&age.since));
        let variance = [sigma * sigma; 3];
        let measurement = Measurement { rows, innovation, variance };
        let verdict = measurement.apply(&mut self.covariance, &mut job.error, gate::<3>());
        job.note(Source::PosePosition, verdict);
        self.watches.pose.note(job.now.at, verdict.accepted);
        if self.watches.pose.is_at_odds(job.now.at, JUMPED_AFTER / 2) {
            // A position that far off was reached with a wrong velocity.
            for axis in 0..3 {
                self.covariance.set_variance(index::VELOCITY + axis, 1.0);
            }
            self.reset_states_from(job, &measurement, index::POSITION);
            self.watches.pose.note(job.now.at, true);
        }
        self.fuse_pose_attitude(job, &age, pose);
    }

    fn fuse_pose_attitude(&mut self, job: &mut Job, age: &Age, pose: &PoseSample) {
        let sigma = self.settings.pose_attitude_rad;
        let turn = turn_between(&age.then.attitude, &pose.attitude);
        let rows = [0, 1, 2].map(attitude_row);
        let innovation: [f32; 3] = core::array::from_fn(|i| turn[i] - rows[i].dot(&age.since));
        let measurement = Measurement { rows, innovation, variance: [sigma * sigma; 3] };
        let verdict = measurement.apply(&mut self.covariance, &mut job.error, gate::<3>());
        job.note(Source::PoseAttitude, verdict);
        self.watches.pose_attitude.note(job.now.at, verdict.accepted);
        if self.watches.pose_attitude.is_at_odds(job.now.at, JUMPED_AFTER / 2) {
            self.reset_states_from(job, &measurement, index::THETA);
            self.watches.pose_attitude.note(job.now.at, true);
        }
    }

    /// Whether a disarmed, landed vehicle neither turns nor accelerates.
    fn is_still(&self, input: &FilterInput) -> bool {
        let off = math::sqrt(input.force.norm_squared()) - self.gravity;
        input.at_rest && input.rates.norm_squared() < STILL_RAD_S * STILL_RAD_S && math::abs(off) < STILL_M_S2
    }

    /// Zero-velocity update of a vehicle at rest. Not made while it is carried, or on a moving boat.
    fn fuse_rest(&mut self, job: &mut Job) {
        let rows =
            [0, 1, 2].map(|axis| Row { theta: Vector3::zeros(), entries: [(index::VELOCITY + axis, 1.0), NONE, NONE] });
        let v = job.now.velocity;
        let measurement = Measurement { rows, innovation: [-v.x, -v.y, -v.z], variance: [REST_NOISE * REST_NOISE; 3] };
        let verdict = measurement.apply(&mut self.covariance, &mut job.error, gate::<3>());
        job.note(Source::Rest, verdict);
    }

    /// Fuses drag: perpendicular to the thrust axis, the specific force is −k/m (v − w) alone. `force` is a mean over
    /// several rotor turns, because rotor vibration is larger than the drag of any wind.
    fn fuse_drag(&mut self, job: &mut Job, force: &Vector3<f32>) {
        let horizontal_force = job.now.attitude * Vector3::new(force.x, force.y, 0.0);
        let k = self.specific_drag;
        if k <= 0.0 || !math::all_finite(horizontal_force.as_slice()) {
            return;
        }
        let (v, w) = (&job.now.velocity, &self.offsets.wind);
        let rows = [0, 1].map(|axis| Row {
            theta: Vector3::zeros(),
            entries: [(index::VELOCITY + axis, -k), (index::WIND + axis, k), NONE],
        });
        let innovation = [horizontal_force.x + k * (v.x - w[0]), horizontal_force.y + k * (v.y - w[1])];
        let measurement = Measurement { rows, innovation, variance: [DRAG_NOISE * DRAG_NOISE; 2] };
        let verdict = measurement.apply(&mut self.covariance, &mut job.error, gate::<2>());
        job.note(Source::Drag, verdict);
    }
}
