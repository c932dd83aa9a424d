//! Initial alignment: roll and pitch from gravity, heading from the magnetometer or motion capture, gyroscope bias from
//! the mean rates at rest.

use nalgebra::{UnitQuaternion, Vector3};

use super::models::MagneticNorth;
use super::predictor::Span;
use crate::math;
use crate::sensors::{MagSample, PoseSample};
use crate::signals::{TICK_S, Tick};

/// Length of the averaging window, ticks.
const WINDOW: Tick = 1_000;
/// A vehicle that does not come to rest within this time is aligned while it moves, ticks.
const PATIENCE: Tick = 5_000;

/// Greatest mean rate at rest, rad/s: the gyroscope bias that calibration may leave, 1.7 °/s.
const TURN_ON_BIAS_MAX: f32 = 0.03;
/// Greatest change of the means between the two halves of the window, rad/s and m/s²: on a boat rates are small, but
/// they change.
const GYRO_CHANGE_MAX: f32 = 5e-3;
const ACCEL_CHANGE_MAX: f32 = 0.15;
/// Greatest scatter of the means per job (4 ms) at rest, rad/s and m/s². Noise alone makes some 1e-3 rad/s.
const GYRO_SCATTER_MAX: f32 = 5e-3;
const ACCEL_SCATTER_MAX: f32 = 0.8;
/// Greatest difference of the mean specific force from g, as a fraction of g.
const GRAVITY_OFF_MAX: f32 = 0.05;

/// Result of the alignment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alignment {
    /// Body to world.
    pub attitude: UnitQuaternion<f32>,
    /// Mean rates, if the vehicle was at rest, rad/s.
    pub gyro_bias: Option<Vector3<f32>>,
    /// Uncertainty of that mean because the vehicle was not perfectly still, rad/s.
    pub scatter: f32,
    /// Whether north is known.
    pub has_heading: bool,
}

/// Sums over the window.
#[derive(Clone, Debug, Default)]
pub struct Aligner {
    ticks: Tick,
    waited: Tick,
    jobs: f32,
    samples: f32,
    gyro: Vector3<f32>,
    accel: Vector3<f32>,
    gyro_square: f32,
    accel_square: f32,
    /// Sums of the window's first half, and its samples.
    half: Option<(Vector3<f32>, Vector3<f32>, f32)>,
    field: Vector3<f32>,
    fields: f32,
}

impl Aligner {
    /// Adds one job's sums and samples. Returns the alignment once the window is full; if the vehicle moved, the window
    /// starts again until `PATIENCE` is used up.
    pub fn update(
        &mut self,
        span: &Span,
        mag: Option<&MagSample>,
        pose: Option<&PoseSample>,
        north: Option<&MagneticNorth>,
        gravity: f32,
    ) -> Option<Alignment> {
        self.waited = self.waited.saturating_add(span.ticks);
        if span.samples == 0 {
            return None;
        }
        self.add(span, mag, north);
        if self.ticks < WINDOW {
            return None;
        }
        let still = self.is_still(gravity);
        let has_heading = pose.is_some() || self.fields > 0.0;
        let patient = self.waited < PATIENCE;
        // A pose need not arrive with the very job that ends the window.
        if patient && !(still && has_heading) {
            if !still {
                *self = Self { waited: self.waited, ..Self::default() };
            }
            return None;
        }
        let attitude = pose.map_or_else(|| self.attitude(north), |pose| pose.attitude);
        let gyro_bias = still.then(|| self.gyro / self.samples);
        // Noise averages out over the window's jobs. A sway has one or two periods in it, so half of it may remain.
        let scatter = 0.5 * math::sqrt(self.gyro_scatter());
        Some(Alignment { attitude, gyro_bias, scatter, has_heading })
    }

    fn add(&mut self, span: &Span, mag: Option<&MagSample>, north: Option<&MagneticNorth>) {
        let samples = span.samples as f32;
        let (gyro, accel) = (span.gyro / samples, span.accel / samples);
        self.ticks += span.ticks;
        self.jobs += 1.0;
        self.samples += samples;
        self.gyro += span.gyro;
        self.accel += span.accel;
        self.gyro_square += gyro.norm_squared();
        self.accel_square += accel.norm_squared();
        if self.ticks >= WINDOW / 2 {
            self.half.get_or_insert((self.gyro, self.accel, self.samples));
        }
        if let (Some(mag), Some(north)) = (mag, north)
            && north.is_plausible(&mag.field_ut)
        {
            self.field += mag.field_ut;
            self.fields += 1.0;
        }
    }

    /// Variance of the jobs' mean rates, (rad/s)².
    fn gyro_scatter(&self) -> f32 {
        math::max(self.gyro_square / self.jobs - (self.gyro / self.samples).norm_squared(), 0.0)
    }

    /// Whether the second half of the window was like the first.
    fn is_steady(&self) -> bool {
        let Some((gyro, accel, samples)) = self.half else { return false };
        let left = self.samples - samples;
        let (gyro, accel) = ((self.gyro - gyro) / left - gyro / samples, (self.accel - accel) / left - accel / samples);
        gyro.norm_squared() < GYRO_CHANGE_MAX * GYRO_CHANGE_MAX
            && accel.norm_squared() < ACCEL_CHANGE_MAX * ACCEL_CHANGE_MAX
    }

    fn is_still(&self, gravity: f32) -> bool {
        let (gyro, accel) = (self.gyro / self.samples, self.accel / self.samples);
        let accel_scatter = self.accel_square / self.jobs - accel.norm_squared();
        let size = math::sqrt(accel.norm_squared());
        gyro.norm_squared() < TURN_ON_BIAS_MAX * TURN_ON_BIAS_MAX
            && self.gyro_scatter() < GYRO_SCATTER_MAX * GYRO_SCATTER_MAX
            && accel_scatter < ACCEL_SCATTER_MAX * ACCEL_SCATTER_MAX
            && math::abs(size - gravity) < GRAVITY_OFF_MAX * gravity
            && self.is_steady()
    }

    /// Roll and pitch by gravity, heading by the field: f = Rᵀ g e3 = g (−sθ, cθ sφ, cθ cφ).
    fn attitude(&self, north: Option<&MagneticNorth>) -> UnitQuaternion<f32> {
        let f = &self.accel;
        let level = math::sqrt(f.y * f.y + f.z * f.z);
        let (roll, pitch) = (math::atan2(f.y, f.z), math::atan2(-f.x, level));
        let tilt = about(&Vector3::y(), pitch) * about(&Vector3::x(), roll);
        let heading = north.filter(|_| self.fields > 0.0).map_or(0.0, |north| north.heading(&(tilt * self.field)));
        about(&Vector3::z(), heading) * tilt
    }
}

/// A turn about a unit vector, rad.
fn about(axis: &Vector3<f32>, angle: f32) -> UnitQuaternion<f32> {
    let (sin, cos) = math::sin_cos(0.5 * angle);
    UnitQuaternion::new_unchecked(nalgebra::Quaternion::from_parts(cos, axis * sin))
}

/// Standard deviation of the aligned tilt, rad: from the accelerometer bias (`accel_bias_sigma`, m/s²) if the vehicle
/// was still, else that of a vehicle moved by hand during the window.
pub fn tilt_sigma(still: bool, accel_bias_sigma: f32, gravity: f32) -> f32 {
    if still { accel_bias_sigma / gravity } else { 0.15 }
}

/// Length of the averaging window, s.
pub const WINDOW_S: f32 = WINDOW as f32 * TICK_S;

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "tests compare with bounds; what flies may not")]
mod tests {
    use super::*;

    const G: f32 = 9.81;

    fn align(
        jobs: u32,
        imu: impl Fn(u32) -> (Vector3<f32>, Vector3<f32>),
        field: Vector3<f32>,
    ) -> Option<(u32, Alignment)> {
        let north = MagneticNorth::new(Vector3::new(21.0, -1.3, -43.0));
        let mut aligner = Aligner::default();
        (0..jobs).find_map(|job| {
            let (gyro, accel) = imu(job);
            let span = Span { ticks: 4, samples: 4, gyro: gyro * 4.0, accel: accel * 4.0, ..Span::default() };
            let mag = MagSample { at: job * 4, field_ut: field };
            aligner.update(&span, Some(&mag), None, north.as_ref(), G).map(|a| (job, a))
        })
    }

    #[test]
    fn a_vehicle_at_rest_finds_its_attitude_and_its_gyroscopes_bias() {
        let truth = UnitQuaternion::from_euler_angles(0.1, -0.15, 2.1);
        let bias = Vector3::new(0.01, -0.02, 0.005);
        let field = truth.inverse() * Vector3::new(21.0, -1.3, -43.0);
        let (job, alignment) =
            align(1_000, |_| (bias, truth.inverse() * Vector3::new(0.0, 0.0, G)), field).expect("aligned");
        assert_eq!(job, 249, "after a second");
        assert!(alignment.attitude.angle_to(&truth) < 1e-5, "{}", alignment.attitude.angle_to(&truth));
        assert!((alignment.gyro_bias.expect("still") - bias).norm() < 1e-6);
    }

    #[test]
    fn a_vehicle_that_is_carried_is_aligned_as_well_as_it_can_be() {
        let rocking = |job: u32| {
            let s = (job as f32 * 0.05).sin();
            (Vector3::new(0.5 * s, 0.2, -0.3 * s), Vector3::new(1.5 * s, -s, G))
        };
        let (job, alignment) = align(2_000, rocking, Vector3::new(21.0, -1.3, -43.0)).expect("aligned");
        assert!(job >= PATIENCE / 4 - 1, "not before it has waited: {job}");
        assert!(alignment.gyro_bias.is_none());
        assert!(alignment.attitude.angle_to(&UnitQuaternion::identity()) < 2.0 * tilt_sigma(false, 0.0, G));
    }

    #[test]
    fn a_constant_turn_is_no_bias() {
        let turning = |_| (Vector3::new(0.0, 0.0, 0.5), Vector3::new(0.0, 0.0, G));
        let (_, alignment) = align(2_000, turning, Vector3::new(21.0, -1.3, -43.0)).expect("aligned");
        assert!(alignment.gyro_bias.is_none());
    }
}
