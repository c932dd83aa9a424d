//! Which rotor has failed: what the body does, against what its rotors are believed to do.
//!
//! What the body feels is `U = (m f_z, I Ω̇ + Ω × IΩ + …)`, from the accelerometer and the differentiated gyroscope. What
//! is missing of it, turned into squared speeds by the inverse of Eq. 4, is a number a rotor: a rotor that gives the part
//! η of its thrust lacks (1 − η) ω² of its own and nothing of the others', a push on the body lacks or adds on all. Both
//! sides pass through the same lag, so nothing is seen of a change that both have.

use nalgebra::{Matrix4, Vector3, Vector4};

use crate::airframe::{Airframe, ROTORS};
use crate::control::attitude;
use crate::control::law::RotorEffect;
use crate::math;
use crate::signals::TICK_S;

/// Time constant of the comparison, s: longer than vibration, shorter than a fall.
const LAG_S: f32 = 0.02;
/// How slowly what is thought of a sound rotor follows, s: a spent battery, thin air, a frame that is a little twisted.
const BASELINE_S: f32 = 5.0;
/// How far it follows: below, a rotor that fades is not lost sight of.
const BASELINE: (f32, f32) = (0.5, 1.5);
/// A rotor that gives less than this part of what it gave has failed…
const FAILED_BELOW: f32 = 0.4;
/// …if every other gives more than this.
const SOUND_ABOVE: f32 = 0.55;
/// For so many ticks in a row.
const FAILED_AFTER: u32 = 40;
/// A rotor slower than this part of hover's speed tells nothing.
const SLOWEST: f32 = 0.5;

/// A first-order lag of a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Lagged<T>(T);

/// The comparison, and what has come of it.
#[derive(Clone, Debug)]
pub struct RotorMonitor {
    airframe: Airframe,
    /// B⁻¹; none for rotors that cannot be told apart.
    inverse: Option<Matrix4<f32>>,
    /// The least ω² that tells something.
    least: f32,
    rates: Lagged<Vector3<f32>>,
    missing: Lagged<Vector4<f32>>,
    square: Lagged<Vector4<f32>>,
    /// η as last found, and as it is in the long run.
    effectiveness: [f32; ROTORS],
    baseline: [f32; ROTORS],
    suspect: Option<(u8, u32)>,
    failed: Option<u8>,
}

impl RotorMonitor {
    /// All rotors sound.
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

    /// The rotor that has failed, from 0.
    pub fn failed(&self) -> Option<u8> {
        self.failed
    }

    /// η of each rotor as last found; 1 for those too slow to tell.
    pub fn effectiveness(&self) -> &[f32; ROTORS] {
        &self.effectiveness
    }

    /// All rotors sound again, as they are taken to be before a flight.
    pub fn reset(&mut self, rates: &Vector3<f32>) {
        self.rates = Lagged(*rates);
        self.missing = Lagged::default();
        self.square = Lagged::default();
        self.effectiveness = [1.0; ROTORS];
        self.baseline = [1.0; ROTORS];
        self.suspect = None;
        self.failed = None;
    }

    /// A tick whose motion was not measured: nothing may be concluded from it.
    pub fn miss(&mut self, rates: &Vector3<f32>) {
        self.rates = Lagged(*rates);
        self.missing = Lagged::default();
        self.suspect = None;
    }

    /// A tick in the air: Ω (rad/s), the thrust axis' specific force (m/s²), and what the rotors are believed to do at
    /// their speeds (rad/s).
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
        // A rotor that fails leaves less thrust than is believed; what is held up by more of it touches the ground.
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
        self.suspect = match (weak.filter(|rotor| alone(*rotor)), self.suspect) {
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

    #[test]
    fn a_weak_rotor_and_a_push_are_none() {
        assert_eq!(watch([1.0, 0.65, 1.0, 1.0], Vector3::zeros(), 300).failed(), None);
        assert_eq!(watch([1.0; ROTORS], Vector3::new(0.3, 0.0, 0.0), 300).failed(), None);
        assert_eq!(watch([0.6; ROTORS], Vector3::zeros(), 300).failed(), None);
    }
}
