//! How strongly the accelerometer is shaken, for pilots; no loop uses it.
//!
//! The level of an axis is the root mean square of the change from one sample to the next, in m/s²: a high-pass filter
//! as in PX4's `accel_vibration_metric`, but per axis and in 1 s. A vibration of amplitude A and frequency f gives
//! √2 A sin(π f T), with T the time between samples; white noise of deviation σ gives √2 σ.

use nalgebra::Vector3;

use crate::math;

/// Time constant of the mean, in calls of [`Vibration::average`], which is made at 250 Hz: 1 s.
const AVERAGED: f32 = 250.0;
/// A component of this size is taken for clipped, m/s²: 15.5 g, just below the range of most parts for vehicles.
const CLIPPED_M_S2: f32 = 152.0;

/// Level of vibration and number of clipped samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vibration {
    last: Option<Vector3<f32>>,
    /// Sum of the squared changes since the last average, m²/s⁴, and their number.
    sum: Vector3<f32>,
    count: u32,
    /// Mean squared change, m²/s⁴.
    mean_square: Vector3<f32>,
    clipped: u32,
}

impl Vibration {
    /// Takes a sample of the accelerometer, m/s².
    #[inline]
    pub fn note(&mut self, accel: &Vector3<f32>) {
        if let Some(last) = self.last {
            let change = accel - last;
            self.sum += change.component_mul(&change);
            self.count += 1;
        }
        self.last = Some(*accel);
        // No component can be beyond if the vector is not.
        if accel.norm_squared() >= CLIPPED_M_S2 * CLIPPED_M_S2 {
            self.note_clipping(accel);
        }
    }

    #[cold]
    #[inline(never)]
    fn note_clipping(&mut self, accel: &Vector3<f32>) {
        if accel.iter().any(|component| math::abs(*component) >= CLIPPED_M_S2) {
            self.clipped = self.clipped.saturating_add(1);
        }
    }

    /// Takes the samples since the last call into the mean.
    pub fn average(&mut self) {
        if self.count > 0 {
            let square = core::mem::take(&mut self.sum) / self.count as f32;
            self.count = 0;
            self.mean_square += (square - self.mean_square) * (1.0 / AVERAGED);
        }
    }

    /// Level of each axis in the body frame, m/s².
    pub fn level_m_s2(&self) -> Vector3<f32> {
        self.mean_square.map(math::sqrt)
    }

    /// Number of clipped samples since boot.
    pub fn clipped(&self) -> u32 {
        self.clipped
    }
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "tests compare with bounds; what flies may not")]
mod tests {
    use super::*;

    /// Five seconds at 1 kHz.
    fn shaken(accel: impl Fn(f32) -> Vector3<f32>) -> Vibration {
        let mut vibration = Vibration::default();
        for tick in 0..5_000_u16 {
            vibration.note(&accel(f32::from(tick) * 1e-3));
            if tick % 4 == 3 {
                vibration.average();
            }
        }
        vibration
    }

    #[test]
    fn a_vibration_shows_on_its_axis_by_its_amplitude_and_frequency() {
        let turn = core::f32::consts::TAU;
        let vibration = shaken(|t| Vector3::new(3.0 * (turn * 100.0 * t).sin(), 0.5, 9.81));
        // √2 · 3 sin(π · 100 / 1000) = 1.311 m/s², less e⁻⁵ in the mean square.
        let level = vibration.level_m_s2();
        assert!((level.x - 1.311).abs() < 0.01, "{level}");
        assert_eq!((level.y, level.z, vibration.clipped()), (0.0, 0.0, 0));
    }

    #[test]
    fn only_a_component_at_the_end_of_its_range_counts_as_clipped() {
        let mut vibration = Vibration::default();
        for accel in [[100.0, 100.0, 100.0], [0.0, -156.0, 0.0], [151.0, 0.0, 0.0]] {
            vibration.note(&accel.into());
        }
        assert_eq!(vibration.clipped(), 1);
    }
}
