//! Gyroscope filter ahead of the controller: notches at the rotor frequencies, then a low-pass.
//!
//! An unbalanced rotor shakes the frame once per turn. The notches follow the estimated rotor speeds; one notch is
//! retuned per tick, in turn. Each notch is the bilinear transform of `(s² + ω²)/(s² + s ω/Q + ω²)`, and the low-pass
//! that of a second-order Butterworth filter (Oppenheim and Schafer 2010, §7.1, with frequency prewarping). Below its
//! frequency f0 a notch costs a phase of about f/(Q f0) rad, for f ≪ f0.
//!
//! The estimator integrates the unfiltered rates: vibration has zero mean, but the delay of a filter would be an error.

use nalgebra::Vector3;

use crate::airframe::ROTORS;
use crate::math;
use crate::signals::TICK_S;

/// Quality factor of a notch: centre frequency over bandwidth.
const QUALITY: f32 = 4.0;
/// A rotor slower than this is not filtered, rad/s: the notch's phase lag would reach into the control bandwidth.
const NOTCH_FROM_RAD_S: f32 = 250.0;
/// A rotor faster than this is not filtered, rad/s: 450 Hz, just below the Nyquist frequency.
const NOTCH_TO_RAD_S: f32 = 2_827.0;
/// Cut-off of the low-pass, rad/s: 150 Hz.
const LOW_PASS_RAD_S: f32 = 942.5;

/// `y = b0 x + b1 x₋ + b2 x₋₋ − a1 y₋ − a2 y₋₋`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Coefficients {
    b: [f32; 3],
    a: [f32; 2],
}

impl Coefficients {
    /// Passes everything.
    const NONE: Self = Self { b: [1.0, 0.0, 0.0], a: [0.0, 0.0] };

    /// A notch at ω, rad/s.
    fn notch(omega: f32) -> Self {
        if !(NOTCH_FROM_RAD_S..=NOTCH_TO_RAD_S).contains(&omega) {
            return Self::NONE;
        }
        let (sin, cos) = math::sin_cos(omega * TICK_S);
        let alpha = sin / (2.0 * QUALITY);
        let scale = 1.0 / (1.0 + alpha);
        let turn = -2.0 * cos * scale;
        Self { b: [scale, turn, scale], a: [turn, (1.0 - alpha) * scale] }
    }

    /// A Butterworth low-pass of second order at ω, rad/s.
    fn low_pass(omega: f32) -> Self {
        let (sin, cos) = math::sin_cos(omega * TICK_S);
        let alpha = sin * core::f32::consts::FRAC_1_SQRT_2;
        let scale = 1.0 / (1.0 + alpha);
        let side = 0.5 * (1.0 - cos) * scale;
        Self { b: [side, 2.0 * side, side], a: [-2.0 * cos * scale, (1.0 - alpha) * scale] }
    }
}

/// A biquad filter of three axes in direct form I, so that its coefficients may change while it runs.
#[derive(Clone, Copy, Debug)]
struct Biquad {
    coefficients: Coefficients,
    x: [Vector3<f32>; 2],
    y: [Vector3<f32>; 2],
}

impl Biquad {
    fn new(coefficients: Coefficients) -> Self {
        Self { coefficients, x: [Vector3::zeros(); 2], y: [Vector3::zeros(); 2] }
    }

    #[inline]
    fn step(&mut self, x: Vector3<f32>) -> Vector3<f32> {
        let Coefficients { b: [b0, b1, b2], a: [a1, a2] } = self.coefficients;
        let ([x1, x2], [y1, y2]) = (self.x, self.y);
        let y = x * b0 + x1 * b1 + x2 * b2 - y1 * a1 - y2 * a2;
        self.x = [x, x1];
        self.y = [y, y1];
        y
    }
}

/// The gyroscope filter ahead of the controller.
#[derive(Clone, Debug)]
pub struct GyroFilter {
    notches: [Biquad; ROTORS],
    low_pass: Biquad,
    /// The rotor whose notch was retuned last.
    turn: usize,
}

impl GyroFilter {
    /// For a vehicle at rest with its rotors stopped.
    pub fn new() -> Self {
        Self {
            notches: [Biquad::new(Coefficients::NONE); ROTORS],
            low_pass: Biquad::new(Coefficients::low_pass(LOW_PASS_RAD_S)),
            turn: 0,
        }
    }

    /// The filtered rates, from the measured rates and the rotor speeds, all in rad/s.
    #[inline]
    pub fn filter(&mut self, measured: &Vector3<f32>, omega_rad_s: &[f32; ROTORS]) -> Vector3<f32> {
        self.turn = (self.turn + 1) % ROTORS;
        if let (Some(notch), Some(omega)) = (self.notches.get_mut(self.turn), omega_rad_s.get(self.turn)) {
            notch.coefficients = Coefficients::notch(*omega);
        }
        let rates = self.notches.iter_mut().fold(*measured, |rates, notch| notch.step(rates));
        self.low_pass.step(rates)
    }
}

impl Default for GyroFilter {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Amplitude of what comes out over what goes in at ω (rad/s), and the lag, rad, rotors turning at these speeds.
    fn answer(omega: f64, rotors: [f32; ROTORS]) -> (f64, f64) {
        let mut filter = GyroFilter::new();
        let (mut cosine, mut sine) = (0.0, 0.0);
        let (settle, count) = (4_000, 20_000);
        for k in 0..settle + count {
            let phase = omega * f64::from(k) * 1e-3;
            let y = f64::from(filter.filter(&Vector3::repeat(phase.sin() as f32), &rotors).y);
            if k >= settle {
                sine += y * phase.sin();
                cosine += y * phase.cos();
            }
        }
        let (sine, cosine) = (2.0 * sine / f64::from(count), 2.0 * cosine / f64::from(count));
        (sine.hypot(cosine), -cosine.atan2(sine))
    }

    #[test]
    fn what_shakes_at_a_rotors_frequency_is_gone_and_follows_its_speed() {
        for omega in [400.0_f32, 757.0, 1_071.0] {
            let rotors = [omega, omega * 1.02, omega * 0.97, omega];
            for rotor in rotors {
                let (gain, _) = answer(f64::from(rotor), rotors);
                assert!(gain < 0.01, "{rotor}: {gain}");
            }
        }
    }

    #[test]
    fn what_control_needs_passes_with_little_lag() {
        // 10 Hz, at hover: four notches of f/(Q f0) = 0.021 rad each and √2 f/fc = 0.094 rad of the low-pass.
        let (gain, lag) = answer(62.8, [757.0; ROTORS]);
        assert!((gain - 1.0).abs() < 0.02, "{gain}");
        assert!(lag > 0.0 && lag < 0.2, "{lag}");
    }

    #[test]
    fn rotors_that_stand_are_not_filtered() {
        let (gain, _) = answer(150.0, [150.0; ROTORS]);
        assert!(gain > 0.95, "{gain}");
    }
}
