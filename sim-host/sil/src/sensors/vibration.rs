//! Vibration from unbalanced rotors, at each rotor's frequency and twice that.
//!
//! The force of an unbalance grows with ω². Its size at the IMU is in no data sheet: the amplitudes are given for one
//! speed, and are an assumption about the vehicle, not about the sensor.

use anyhow::Result;
use firmware::airframe::ROTORS;
use firmware::signals::TICK_S_EXACT;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::check::Check;
use crate::noise::gaussian::{Source, Stream};

/// Vibration of the IMU. Amplitudes are peak values per rotor, along a direction drawn from the seed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vibration {
    /// Rotor speed for which the amplitudes are given, rad/s.
    pub at_rad_s: f64,
    /// Amplitude of the rates, rad/s.
    pub gyro_rad_s: f64,
    /// Amplitude of the specific force, m/s².
    pub accel_m_s2: f64,
    /// Amplitude of the second harmonic over that of the fundamental.
    pub second_harmonic: f64,
}

impl Vibration {
    /// # Errors
    /// The first key that is out of range.
    pub(super) fn validate(&self) -> Result<()> {
        let check = Check("imu.vibration");
        check.within(1.0, 1e4, &[("at_rad_s", self.at_rad_s)])?;
        check.within(
            0.0,
            1e3,
            &[
                ("gyro_rad_s", self.gyro_rad_s),
                ("accel_m_s2", self.accel_m_s2),
                ("second_harmonic", self.second_harmonic),
            ],
        )
    }
}

/// Vibration from a rotor at its peak, at the given speed.
#[derive(Clone, Copy, Debug)]
struct Shake {
    rates: Vector3<f64>,
    force: Vector3<f64>,
    /// Phase lead over the rotor's angle, rad.
    lead: f64,
}

/// The vibration from all rotors, tick by tick.
#[derive(Clone, Debug)]
pub(super) struct Shaking {
    at_rad_s: f64,
    shakes: [[Shake; 2]; ROTORS],
    /// Angle of each rotor, rad, 0 ≤ θ < 2π.
    angle: [f64; ROTORS],
    /// Rotor speeds of the previous tick, rad/s.
    before: Option<[f64; ROTORS]>,
}

impl Shaking {
    pub(super) fn new(vibration: &Vibration, seed: u64) -> Self {
        let mut stream = Stream::new(seed, Source::Vibration);
        let mut shake = |fraction: f64| Shake {
            rates: stream.direction() * (fraction * vibration.gyro_rad_s),
            force: stream.direction() * (fraction * vibration.accel_m_s2),
            lead: core::f64::consts::TAU * stream.unit(),
        };
        let shakes = core::array::from_fn(|_| [shake(1.0), shake(vibration.second_harmonic)]);
        Self { at_rad_s: vibration.at_rad_s, shakes, angle: [0.0; ROTORS], before: None }
    }

    /// Vibration of the rates (rad/s) and of the specific force (m/s²) at rotor speeds (rad/s). Call once per
    /// tick: the angles are the integral of the speeds, interpolated linearly between ticks.
    pub(super) fn sample(&mut self, omega: &[f64; ROTORS]) -> (Vector3<f64>, Vector3<f64>) {
        let before = self.before.replace(*omega);
        let (mut rates, mut force) = (Vector3::zeros(), Vector3::zeros());
        for rotor in 0..ROTORS {
            let turned = before.map_or(0.0, |before| f64::midpoint(before[rotor], omega[rotor]) * TICK_S_EXACT);
            self.angle[rotor] = (self.angle[rotor] + turned) % core::f64::consts::TAU;
            let relative = omega[rotor] / self.at_rad_s;
            let strength = relative * relative;
            for (shake, harmonic) in self.shakes[rotor].iter().zip([1.0, 2.0]) {
                let now = strength * libm::sin(harmonic * self.angle[rotor] + shake.lead);
                rates += shake.rates * now;
                force += shake.force * now;
            }
        }
        (rates, force)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIBRATION: Vibration = Vibration { at_rad_s: 757.0, gyro_rad_s: 0.05, accel_m_s2: 1.0, second_harmonic: 0.3 };

    /// Amplitude of a component at `rate` (rad/s), by Goertzel's sum.
    fn amplitude(samples: &[Vector3<f64>], rate: f64) -> f64 {
        let sum = samples.iter().enumerate().fold([Vector3::zeros(); 2], |[re, im]: [Vector3<f64>; 2], (k, sample)| {
            let (sin, cos) = libm::sincos(rate * k as f64 * TICK_S_EXACT);
            [re + sample * cos, im + sample * sin]
        });
        2.0 / samples.len() as f64 * (sum[0].norm_squared() + sum[1].norm_squared()).sqrt()
    }

    #[test]
    fn each_rotor_shakes_at_its_speed_and_at_twice_that_as_strongly_as_stated() {
        let omega = [700.0, 757.0, 800.0, 850.0];
        let mut shaking = Shaking::new(&VIBRATION, 1);
        let (rates, force): (Vec<_>, Vec<_>) = (0..20_000).map(|_| shaking.sample(&omega)).unzip();
        for speed in omega {
            let strength = (speed / 757.0) * (speed / 757.0);
            for (harmonic, fraction) in [(1.0, 1.0), (2.0, 0.3)] {
                // Another line, 43 rad/s away, leaks 2/(43 rad/s · 20 s) of its amplitude, and there are seven.
                let near =
                    |ours: f64, exact: f64| assert!((ours / exact - 1.0).abs() < 0.03, "{speed}: {ours} {exact}");
                near(amplitude(&force, harmonic * speed), fraction * strength);
                near(amplitude(&rates, harmonic * speed), 0.05 * fraction * strength);
            }
        }
        assert!(amplitude(&force, 500.0) < 0.03);
    }

    #[test]
    fn the_phase_is_the_integral_of_the_speed() {
        let mut shaking = Shaking::new(&Vibration { second_harmonic: 0.0, ..VIBRATION }, 2);
        let shake = shaking.shakes[0][0];
        for tick in 0..10_000 {
            let t = f64::from(tick) * TICK_S_EXACT;
            let speed = 200.0 + 60.0 * t;
            let (_, force) = shaking.sample(&[speed, 0.0, 0.0, 0.0]);
            let strength = (speed / 757.0) * (speed / 757.0);
            let exact = shake.force * (strength * libm::sin(200.0 * t + 30.0 * t * t + shake.lead));
            assert!((force - exact).amax() < 1e-9, "{tick}: {force} {exact}");
        }
    }

    #[test]
    fn rotors_at_rest_shake_nothing() {
        let mut shaking = Shaking::new(&VIBRATION, 3);
        assert_eq!(shaking.sample(&[0.0; ROTORS]), (Vector3::zeros(), Vector3::zeros()));
    }
}
