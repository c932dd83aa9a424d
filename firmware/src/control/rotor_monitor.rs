//! Rotor failure detection: compares the measured motion with what the estimated rotor speeds should cause.
//!
//! The measured control input is `U = (m f_z, I Ω̇ + Ω × IΩ + …)`, from the accelerometer and the differentiated
//! gyroscope. The difference from the expected U, converted to squared speeds by the inverse of Eq. 4, gives one value
//! per rotor: a rotor with effectiveness η lacks (1 − η) ω² and leaves the others' values unchanged, while an external
//! push changes all of them. Both sides pass through the same low-pass, so a manoeuvre does not show as a difference.
//!
//! A slow rotor's thrust is small beside drag in a fast climb, and beside what yaw is off by, whose lever is a tenth of an
//! arm's. So a rotor that has failed must also tip the vehicle by its arm.

use nalgebra::{Matrix4, Vector3, Vector4};

use crate::airframe::{Airframe, ROTORS};
use crate::control::attitude;
use crate::control::law::RotorEffect;
use crate::math;
use crate::signals::TICK_S;

/// Time constant of the low-pass on both sides of the comparison, s: longer than vibration, shorter than a fall.
const LAG_S: f32 = 0.02;
/// Time constant with which the baseline of a working rotor follows, s: slow changes such as a draining battery, thin
/// air or a slightly twisted frame are no failure.
const BASELINE_S: f32 = 5.0;
/// Range of the baseline: bounded from below so that a rotor that fades slowly is still detected.
const BASELINE: (f32, f32) = (0.5, 1.5);
/// A rotor whose effectiveness falls below this fraction of its baseline has failed…
const FAILED_BELOW: f32 = 0.4;
/// …if every other is above this fraction: an external push lowers several at once.
const SOUND_ABOVE: f32 = 0.55;
/// The condition must hold for this many ticks in a row: twice the low-pass' time constant.
const FAILED_AFTER: u32 = 40;
/// A rotor slower than this fraction of the hover speed is not judged: its thrust is too small to measure.
const SLOWEST: f32 = 0.5;

/// The state of a first-order low-pass, updated once per tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Lagged<T>(T);

/// The failure detector and its state.
#[derive(Clone, Debug)]
pub struct RotorMonitor {
    airframe: Airframe,
    /// B⁻¹; `None` for a singular geometry, whose rotors cannot be told apart.
    inverse: Option<Matrix4<f32>>,
    /// The least ω² at which a rotor is judged, rad²/s².
    least: f32,
    rates: Lagged<Vector3<f32>>,
    missing: Lagged<Vector4<f32>>,
    square: Lagged<Vector4<f32>>,
    /// η now, and its slowly following baseline.
    effectiveness: [f32; ROTORS],
    baseline: [f32; ROTORS],
    suspect: Option<(u8, u32)>,
    failed: Option<u8>,
}

impl RotorMonitor {
    /// With all rotors working.
    pub fn new(airframe: &Airframe) -> Self {
        let rows = airframe.geometry.rows();
        let hover = airframe.omega_for_thrust_to_weight(1.0);
        Self {
            airframe: *airframe,
            inverse: Matrix4::from_fn(|i, j| rows[i][j]).try_inverse(),
            least: SLOWEST * SLOWEST * hover * hover,
            rates: Lagged::default(),
            missing: Lagged::default(),
            square: Lagged::default(),
            effectiveness: [1.0; ROTORS],
            baseline: [1.0; ROTORS],
            suspect: None,
            failed: None,
        }
    }

    /// The index of the failed rotor, from 0.
    pub fn failed(&self) -> Option<u8> {
        self.failed
    }

    /// The last estimate of η for each rotor; 1 for those too slow to judge.
    pub fn effectiveness(&self) -> &[f32; ROTORS] {
        &self.effectiveness
    }

    /// All rotors are taken to work again, as before a flight.
    pub fn reset(&mut self, rates: &Vector3<f32>) {
        self.rates = Lagged(*rates);
        self.missing = Lagged::default();
        self.square = Lagged::default();
        self.effectiveness = [1.0; ROTORS];
        self.baseline = [1.0; ROTORS];
        self.suspect = None;
        self.failed = None;
    }

    /// A tick without a measured motion: restarts the comparison, so that nothing is concluded from the gap.
    pub fn miss(&mut self, rates: &Vector3<f32>) {
        self.rates = Lagged(*rates);
        self.missing = Lagged::default();
        self.suspect = None;
    }

    /// A tick in the air, with Ω (rad/s), the specific force along the thrust axis (m/s²), the expected effect of the
    /// rotors, and their estimated speeds (rad/s).
    pub fn update(&mut self, rates: &Vector3<f32>, force_z: f32, believed: &RotorEffect, omega_rad_s: &[f32; ROTORS]) {
        let lag_gain = TICK_S / LAG_S;
        let acceleration = (rates - self.rates.0) / LAG_S;
        self.rates.0 += (rates - self.rates.0) * lag_gain;
        let square = Vector4::from(*omega_rad_s).map(|omega| omega * omega);
        let thrust = Vector4::from(self.airframe.geometry.thrust).dot(&square);
        let holding = attitude::torque(&self.airframe, &Vector3::zeros(), rates, believed.spin_rad_s);
        let missing = holding - believed.torque;
        let lack = Vector4::new(self.airframe.mass_kg * force_z - thrust, missing.x, missing.y, missing.z);
        self.missing.0 += (lack - self.missing.0) * lag_gain;
        self.square.0 += (square - self.square.0) * lag_gain;
        let inertia = Vector3::from(self.airframe.inertia_kg_m2).component_mul(&acceleration);
        let turning = Vector4::new(0.0, inertia.x, inertia.y, inertia.z);
        self.judge(&(self.missing.0 + turning));
    }

    fn judge(&mut self, missing: &Vector4<f32>) {
        let Some(inverse) = &self.inverse else { return };
        let lacking = inverse * missing;
        for ((eta, lack), square) in self.effectiveness.iter_mut().zip(&lacking).zip(&self.square.0) {
            *eta = if *square > self.least { 1.0 + lack / square } else { 1.0 };
        }
        // A failed rotor leaves less thrust than expected. More than expected means contact with the ground.
        let lifted_less = missing.x < 0.0;
        let mut relative = self.effectiveness;
        relative.iter_mut().zip(&self.baseline).for_each(|(eta, baseline)| *eta /= baseline);
        let weak = relative.iter().position(|eta| *eta < FAILED_BELOW).filter(|_| lifted_less);
        let alone = |rotor: usize| relative.iter().enumerate().all(|(other, eta)| other == rotor || *eta > SOUND_ABOVE);
        if weak.is_none() {
            for (baseline, eta) in self.baseline.iter_mut().zip(&self.effectiveness) {
                let next = *baseline + (eta - *baseline) * (TICK_S / BASELINE_S);
                *baseline = math::clamp(next, BASELINE.0, BASELINE.1);
            }
        }
        let weak = weak.filter(|rotor| alone(*rotor) && self.tips(*rotor, missing));
        self.suspect = match (weak, self.suspect) {
            (Some(rotor), Some((before, ticks))) if usize::from(before) == rotor => Some((before, ticks + 1)),
            (Some(rotor), _) => Some((rotor as u8, 1)),
            (None, _) => None,
        };
        if let Some((rotor, ticks)) = self.suspect
            && ticks >= FAILED_AFTER
        {
            self.failed.get_or_insert(rotor);
        }
    }
}

impl RotorMonitor {
    /// Whether the roll and pitch that are missing are those of this rotor alone.
    #[cold]
    fn tips(&self, rotor: usize, missing: &Vector4<f32>) -> bool {
        let g = &self.airframe.geometry;
        let of = |row: &[f32; ROTORS]| row.get(rotor).copied().unwrap_or(0.0);
        let (roll, pitch) = (of(&g.roll), of(&g.pitch));
        let lack = (roll * missing.y + pitch * missing.z) / math::max(roll * roll + pitch * pitch, f32::MIN_POSITIVE);
        let (square, baseline) =
            (self.square.0[rotor.min(ROTORS - 1)], self.baseline.get(rotor).copied().unwrap_or(1.0));
        square + lack < SOUND_ABOVE * baseline * square
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::rotor::RotorTorque;

    /// A body at rest whose rotors turn at hover, with these parts of their thrust, and pushed by a torque (N m): rates
    /// as they grow from it.
    fn watch(effectiveness: [f32; ROTORS], push: Vector3<f32>, ticks: u32) -> RotorMonitor {
        watch_held_up(effectiveness, push, 0.0, ticks)
    }

    /// The same with something from below that bears a part of the weight.
    fn watch_held_up(effectiveness: [f32; ROTORS], push: Vector3<f32>, held_up: f32, ticks: u32) -> RotorMonitor {
        let airframe = Airframe::paper(2.0);
        let mut monitor = RotorMonitor::new(&airframe);
        let omega = [airframe.omega_for_thrust_to_weight(1.0); ROTORS];
        let effect = RotorTorque::new(&airframe).steady(&omega);
        let square = omega[0] * omega[0];
        let sum = |row: [f32; ROTORS]| row.iter().zip(effectiveness).map(|(b, eta)| b * eta * square).sum::<f32>();
        let g = &airframe.geometry;
        let torque = Vector3::new(sum(g.roll), sum(g.pitch), sum(g.yaw)) + push;
        let inertia = Vector3::from(airframe.inertia_kg_m2);
        let mut rates = Vector3::zeros();
        monitor.reset(&rates);
        for _ in 0..ticks {
            let force = sum(g.thrust) / airframe.mass_kg + held_up * airframe.gravity_m_s2;
            monitor.update(&rates, force, &effect, &omega);
            let holding = attitude::torque(&airframe, &Vector3::zeros(), &rates, effect.spin_rad_s);
            rates += (torque - holding).component_div(&inertia) * TICK_S;
        }
        monitor
    }

    #[test]
    fn a_lost_rotor_is_found_within_an_eighth_of_a_second() {
        for rotor in 0..ROTORS {
            let mut effectiveness = [1.0; ROTORS];
            effectiveness[rotor] = 0.0;
            assert_eq!(watch(effectiveness, Vector3::zeros(), 125).failed(), Some(rotor as u8));
        }
    }

    #[test]
    fn feet_on_the_ground_are_no_failed_rotor() {
        // The torque of a rotor that is gone, but the vehicle is lifted by more than its rotors.
        assert_eq!(watch_held_up([0.0, 1.0, 1.0, 1.0], Vector3::zeros(), 0.5, 300).failed(), None);
    }

    /// A rotor is slow and the one across from it slower still, to turn the heading and to tip, while the vehicle climbs so
    /// fast that drag takes a third of the weight.
    fn turns_in_a_climb(slow: usize, has_failed: bool) -> Option<u8> {
        let airframe = Airframe::paper(2.0);
        let mut monitor = RotorMonitor::new(&airframe);
        let mut omega = [1.3 * airframe.omega_for_thrust_to_weight(1.0); ROTORS];
        (omega[slow], omega[(slow + 2) % ROTORS]) = (0.5 * omega[slow], 0.25 * omega[slow]);
        let effect = RotorTorque::new(&airframe).steady(&omega);
        let mut given = omega.map(|omega| omega * omega);
        given[slow] *= if has_failed { 0.0 } else { 1.0 };
        let sum = |row: [f32; ROTORS]| row.iter().zip(given).map(|(b, square)| b * square).sum::<f32>();
        let g = &airframe.geometry;
        let torque = Vector3::new(sum(g.roll), sum(g.pitch), sum(g.yaw));
        let mut rates = Vector3::zeros();
        monitor.reset(&rates);
        for _ in 0..150 {
            let force = sum(g.thrust) / airframe.mass_kg - 0.33 * airframe.gravity_m_s2;
            monitor.update(&rates, force, &effect, &omega);
            let holding = attitude::torque(&airframe, &Vector3::zeros(), &rates, effect.spin_rad_s);
            rates += (torque - holding).component_div(&Vector3::from(airframe.inertia_kg_m2)) * TICK_S;
        }
        monitor.failed()
    }

    #[test]
    fn drag_in_a_climb_is_none_also_where_a_rotor_is_slow() {
        for rotor in 0..ROTORS {
            assert_eq!(turns_in_a_climb(rotor, false), None);
            assert_eq!(turns_in_a_climb(rotor, true), Some(rotor as u8));
        }
    }

    #[test]
    fn a_weak_rotor_and_a_push_are_none() {
        assert_eq!(watch([1.0, 0.65, 1.0, 1.0], Vector3::zeros(), 300).failed(), None);
        assert_eq!(watch([1.0; ROTORS], Vector3::new(0.3, 0.0, 0.0), 300).failed(), None);
        assert_eq!(watch([0.6; ROTORS], Vector3::zeros(), 300).failed(), None);
    }
}
