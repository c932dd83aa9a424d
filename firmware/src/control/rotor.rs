//! Rotor model of the controller: a first-order lag, and the lead that compensates most of it.
//!
//! A rotor's speed follows its command as `ω̇ = (ω_cmd − ω)/τ`. The model estimates the present rotor speeds, which
//! observers and laws need. Its inverse, within the speed limits, shortens the response to a time constant τ′: each
//! step commands so much more that the modelled rotor moves as far as one with τ′ would,
//!
//! ```text
//! ω_cmd = ω̂ + (ω_wanted − ω̂)·(1 − e^(−h/τ′))/(1 − e^(−h/τ)),   0 ≤ ω_cmd ≤ ω_max
//! ```
//!
//! The model is driven by the limited command, so nothing winds up. [`YawInversion`] does the same for the reaction
//! torque of rotors that spin up.

use crate::airframe::{Airframe, ROTORS, RotorGeometry, spin_rad_s};
use crate::control::law::RotorEffect;
use crate::math;
use crate::signals::TICK_S;

/// Lag and lead of all rotors, and their speeds.
#[derive(Clone, Debug, PartialEq)]
pub struct RotorModel {
    /// Fraction of the distance to its command that a rotor covers per tick, 1 − e^(−h/τ), and the rest; 1 and 0
    /// without lag.
    step_fraction: f32,
    rest: f32,
    /// Lead factor (1 − e^(−h/τ′))/(1 − e^(−h/τ)), and 1 minus it; 1 and 0 without lead.
    lead: f32,
    behind: f32,
    omega_max: f32,
    omega: [f32; ROTORS],
}

impl RotorModel {
    /// Rotors at rest; `lag_s` is τ and `answer_s` τ′, in s. Without lead if τ′ is not below τ.
    pub fn new(lag_s: f32, answer_s: f32, omega_max_rad_s: f32) -> Self {
        let step_fraction = |time_s: f32| if time_s > 0.0 { 1.0 - math::exp(-TICK_S / time_s) } else { 1.0 };
        let lead = if answer_s < lag_s { step_fraction(answer_s) / step_fraction(lag_s) } else { 1.0 };
        Self {
            step_fraction: step_fraction(lag_s),
            rest: 1.0 - step_fraction(lag_s),
            lead,
            behind: 1.0 - lead,
            omega_max: omega_max_rad_s,
            omega: [0.0; ROTORS],
        }
    }

    /// Estimated rotor speeds, rad/s.
    #[inline]
    pub fn omega_rad_s(&self) -> &[f32; ROTORS] {
        &self.omega
    }

    /// Sets the estimated speeds, rad/s.
    pub fn set(&mut self, omega_rad_s: [f32; ROTORS]) {
        self.omega = omega_rad_s;
    }

    /// The command (rad/s) that takes the rotors to the wanted speeds, which must be within their limits. Advances the
    /// model by a tick.
    #[inline]
    pub fn command(&mut self, wanted_rad_s: [f32; ROTORS]) -> [f32; ROTORS] {
        let mut command = wanted_rad_s;
        for (command, omega) in command.iter_mut().zip(&mut self.omega) {
            *command = math::limit_positive(self.lead * *command + self.behind * *omega, self.omega_max);
            *omega = self.step_fraction * *command + self.rest * *omega;
        }
        command
    }

    /// Advances the model by a tick with the given commands, rad/s.
    pub fn follow(&mut self, command_rad_s: &[f32; ROTORS]) {
        for (omega, command) in self.omega.iter_mut().zip(command_rad_s) {
            *omega = self.step_fraction * command + self.rest * *omega;
        }
    }
}

/// Torque of the rotors on the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorTorque {
    geometry: RotorGeometry,
    /// Sense of rotation of each rotor about +z, ±1.
    senses: [f32; ROTORS],
    /// Jr per tick, N m per rad/s of change in Ωr; 0 without spin-up reaction.
    reaction: f32,
}

impl RotorTorque {
    /// For an airframe.
    pub fn new(airframe: &Airframe) -> Self {
        let reacts = airframe.spin_up_lead_s() > 0.0;
        let reaction = if reacts { airframe.rotor_inertia_kg_m2 / TICK_S } else { 0.0 };
        Self { geometry: airframe.geometry, senses: airframe.rotor_senses(), reaction }
    }

    /// The effect at constant speeds (rad/s).
    pub fn steady(&self, omega_rad_s: &[f32; ROTORS]) -> RotorEffect {
        let torque = self.geometry.torque(omega_rad_s);
        RotorEffect { torque, yaw_n_m: torque.z, spin_rad_s: spin_rad_s(&self.senses, omega_rad_s) }
    }

    /// The effect at these speeds (rad/s), a tick after `before`.
    #[inline]
    pub fn after(&self, before: &RotorEffect, omega_rad_s: &[f32; ROTORS]) -> RotorEffect {
        let mut torque = self.geometry.torque(omega_rad_s);
        let yaw_n_m = torque.z;
        let spin_rad_s = spin_rad_s(&self.senses, omega_rad_s);
        // −Jr Ω̇r.
        torque.z -= self.reaction * (spin_rad_s - before.spin_rad_s);
        RotorEffect { torque, yaw_n_m, spin_rad_s }
    }
}

/// Yaw allocation for rotors with a noticeable spin-up reaction.
///
/// While the speeds change towards another yaw torque U4, the reaction adds T U̇4 with T = Jr/(2 d ω); where T is
/// longer than the rotors' time constant τ′, that is more than the change of U4 itself. The total torque is U4 + T U̇4.
/// It reaches the wanted value almost at once and without overshoot if U4 approaches it with a time constant of T + τ′,
/// that is, if each step demands the fraction τ′/(T + τ′) of the remaining difference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YawInversion {
    /// τ′/(T + τ′); 1 without spin-up reaction.
    step_fraction: f32,
}

impl YawInversion {
    /// With T and τ′, s.
    pub fn new(lead_s: f32, answer_s: f32) -> Self {
        Self { step_fraction: if lead_s > 0.0 { answer_s / (lead_s + answer_s) } else { 1.0 } }
    }

    /// U4 (N m) to demand, given U4 at the present speeds and the wanted torque.
    #[inline]
    pub fn demand(self, now: f32, wanted: f32) -> f32 {
        now + self.step_fraction * (wanted - now)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotor_with_lead_answers_like_a_faster_one_until_it_meets_its_limit() {
        let mut model = RotorModel::new(0.02, 0.005, 1000.0);
        model.set([400.0; ROTORS]);
        for tick in 1..=50 {
            let command = model.command([500.0; ROTORS]);
            assert!(command.iter().all(|omega| (0.0..=1000.0).contains(omega)));
            let exact = 500.0 - 100.0 * math::exp(-(tick as f32) * 1e-3 / 0.005);
            assert!(math::abs(model.omega_rad_s()[0] - exact) < 0.01, "{tick}");
        }
        // 400 rad/s above would ask for 1,600 at once: it gets 1,000, and goes there as a rotor without lead does.
        model.set([500.0; ROTORS]);
        assert_eq!(model.command([900.0; ROTORS]), [1000.0; ROTORS]);
    }

    #[test]
    fn a_step_of_yaw_torque_is_had_at_once_with_the_reaction_and_kept_without() {
        // U4 follows its command with τ′ = 8 ms; the body feels U4 + T U̇4, T = 128 ms.
        let (lead, answer, h) = (0.128_f32, 0.008_f32, 1e-4_f32);
        let inversion = YawInversion::new(lead, answer);
        let (mut yaw, wanted) = (0.0_f32, 0.3_f32);
        for _ in 0..5_000 {
            let rate = (inversion.demand(yaw, wanted) - yaw) / answer;
            let felt = yaw + lead * rate;
            // From T/(T + τ′) = 94 % at once up to all of it.
            assert!(felt > 0.93 * wanted && felt < 1.001 * wanted, "{felt}");
            yaw += rate * h;
        }
        assert!(math::abs(yaw - wanted) < 0.03 * wanted, "{yaw}");
        assert_eq!(YawInversion::new(0.0, answer).demand(0.25, 0.75), 0.75);
    }

    #[test]
    fn a_rotor_without_lag_is_where_it_is_told_to_be() {
        let mut model = RotorModel::new(0.0, 0.005, 50.0);
        assert_eq!(model.command([20.0, 30.0, 0.0, 50.0]), [20.0, 30.0, 0.0, 50.0]);
        assert_eq!(*model.omega_rad_s(), [20.0, 30.0, 0.0, 50.0]);
    }
}
