//! The rotors as the controller believes them: a first-order lag, and the lead that takes most of it back.
//!
//! A rotor's speed follows its command as `ω̇ = (ω_cmd − ω)/τ`. Kept as a model, that gives what the rotors do now, for
//! laws that compare it with what the vehicle does. Inverted as far as the limits and a wrong τ allow, it makes the
//! speeds follow what control wants with a shorter time constant τ′: each step asks for so much more that the model
//! comes as near as a rotor of τ′ would,
//!
//! ```text
//! ω_cmd = ω̂ + (ω_wanted − ω̂)·(1 − e^(−h/τ′))/(1 − e^(−h/τ)),   0 ≤ ω_cmd ≤ ω_max
//! ```
//!
//! The model is fed with the limited command, so nothing winds up. [`YawInversion`] does the same for the torque with
//! which rotors that spin up turn the body.

use crate::airframe::{Airframe, ROTORS, RotorGeometry, spin_rad_s};
use crate::control::law::RotorEffect;
use crate::math;
use crate::signals::TICK_S;

/// Lag and lead of all rotors, and their speeds.
#[derive(Clone, Debug, PartialEq)]
pub struct RotorModel {
    /// Part of the way to its command that a rotor goes in a tick, 1 − e^(−h/τ), and what is left; 1 and 0 without lag.
    step_fraction: f32,
    rest: f32,
    /// What is asked for beyond it, and 1 less that; 1 and 0 without lead.
    lead: f32,
    behind: f32,
    omega_max: f32,
    omega: [f32; ROTORS],
}

impl RotorModel {
    /// At rest; `lag_s` is τ and `answer_s` τ′, in s. A τ′ that is not below τ asks for no lead.
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

    /// Speeds at which the rotors are believed to turn, rad/s.
    #[inline]
    pub fn omega_rad_s(&self) -> &[f32; ROTORS] {
        &self.omega
    }

    /// Starts from these speeds, rad/s.
    pub fn set(&mut self, omega_rad_s: [f32; ROTORS]) {
        self.omega = omega_rad_s;
    }

    /// The command (rad/s) by which the rotors come to the speeds wanted, which lie within their limits. A tick passes.
    #[inline]
    pub fn command(&mut self, wanted_rad_s: [f32; ROTORS]) -> [f32; ROTORS] {
        let mut command = wanted_rad_s;
        for (command, omega) in command.iter_mut().zip(&mut self.omega) {
            *command = math::limit_positive(self.lead * *command + self.behind * *omega, self.omega_max);
            *omega = self.step_fraction * *command + self.rest * *omega;
        }
        command
    }

    /// A tick passes with these commands, rad/s.
    pub fn follow(&mut self, command_rad_s: &[f32; ROTORS]) {
        for (omega, command) in self.omega.iter_mut().zip(command_rad_s) {
            *omega = self.step_fraction * command + self.rest * *omega;
        }
    }
}

/// What rotors do to the body by their speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorTorque {
    geometry: RotorGeometry,
    /// The sense, ±1, in which each spins about +z.
    senses: [f32; ROTORS],
    /// Jr over a tick, N m for each rad/s that Ωr changes by; 0 where there is no reaction.
    reaction: f32,
}

impl RotorTorque {
    /// Of an airframe.
    pub fn new(airframe: &Airframe) -> Self {
        let reacts = airframe.spin_up_lead_s() > 0.0;
        let reaction = if reacts { airframe.rotor_inertia_kg_m2 / TICK_S } else { 0.0 };
        Self { geometry: airframe.geometry, senses: airframe.rotor_senses(), reaction }
    }

    /// At speeds (rad/s) that do not change.
    pub fn steady(&self, omega_rad_s: &[f32; ROTORS]) -> RotorEffect {
        let torque = self.geometry.torque(omega_rad_s);
        RotorEffect { torque, yaw_n_m: torque.z, spin_rad_s: spin_rad_s(&self.senses, omega_rad_s) }
    }

    /// At these speeds, a tick after they had the effect `before`.
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

/// Yaw with rotors whose spinning up turns the body by itself.
///
/// Speeds that change towards another yaw torque U4 turn the body by T U̇4 on the way, T = Jr/(2 d ω): more, where T is
/// longer than the time τ′ in which the rotors answer, than the torque they are changed for. The two are a torque of
/// U4 + T U̇4, so the one wanted is had almost at once and without overshoot if U4 itself goes there with a time
/// constant of T + τ′: from where it is, it is asked to go the part τ′/(T + τ′) of the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YawInversion {
    anticipation: f32,
}

impl YawInversion {
    /// With T and τ′, s.
    pub fn new(lead_s: f32, answer_s: f32) -> Self {
        Self { anticipation: if lead_s > 0.0 { answer_s / (lead_s + answer_s) } else { 1.0 } }
    }

    /// U4 (N m) to ask for, given that of the speeds now and the torque wanted.
    #[inline]
    pub fn demand(self, now: f32, wanted: f32) -> f32 {
        now + self.anticipation * (wanted - now)
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
        // U4 follows what is asked for with τ′ = 8 ms; the body feels U4 + T U̇4, T = 128 ms.
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
