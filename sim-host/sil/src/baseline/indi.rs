//! Incremental nonlinear dynamic inversion: Smeur, Chu and de Croon (JGCD 39(3), 2016) for the rotation, Tal and
//! Karaman (IEEE TCST 29(3), 2021, arXiv:1809.04048) for both loops.
//!
//! The vehicle's measured motion is compared with the estimated effect of the rotors, both after the same low-pass H,
//! and only the increment is inverted:
//!
//! ```text
//! τ = H τ_rotors + J (Ω̇_wanted − H Ω̇)        Ω̇_wanted = kR e + kΩ (R(qe) Ωd − Ω) + d/dt R(qe) Ωd
//! f = H f_rotors + (a_wanted − H a)            a_wanted = kx e + kv ė + ka (r̈d − H a) + r̈d
//! ```
//!
//! So drag, gyroscopic torques and gravity need no model: they are contained in the measured accelerations. The error e
//! of the attitude is the tilt-prioritised one of [`PointingError`]. Tal and Karaman's linear acceleration comes from
//! an accelerometer; with ideal state, differences of the velocity replace it. They measure the rotor speeds; here
//! these come from the model of the lag, as in Smeur's flights. Delays that the model lacks must be compensated, or the
//! two sides of the increment belong to different times (see their section on synchronisation).

use anyhow::Result;
use firmware::airframe::{Airframe, ROTORS};
use firmware::control::flatness::ForceProfile;
use firmware::control::law::{AttitudeDemand, AttitudeInput, AttitudeLaw, PositionDemand, PositionInput, PositionLaw};
use firmware::control::pointing::PointingError;
use firmware::control::position::Translation;
use firmware::signals::TICK_S;
use glissade_files::refusal::within;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::filter::{Butterworth, Difference};
use super::{AxisPair, OUTER_STEP_S, require_cutoff, require_tilt};

/// Longest delay that can be compensated, ticks.
const DELAY_TICKS_MAX: usize = 16;

/// Gains of both laws, as written in a tuning file.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Indi {
    /// Greatest tilt that position control demands, rad.
    pub tilt_max_rad: f32,
    /// kx, 1/s².
    pub position_1_s2: AxisPair,
    /// kv, 1/s.
    pub velocity_1_s: AxisPair,
    /// ka, no unit.
    pub acceleration: AxisPair,
    /// Fraction of the feedback's derivative in ḟ, 0 to 1: 0 as published, where ḟ holds the reference's jerk.
    pub feedback_rate: f32,
    /// Cutoff of H in the position loop, Hz.
    pub acceleration_cutoff_hz: f32,
    /// kR, 1/s².
    pub attitude_1_s2: AxisPair,
    /// kΩ, 1/s.
    pub rate_1_s: AxisPair,
    /// Cutoff of H in the attitude loop, Hz; yaw often needs a lower one.
    pub rate_cutoff_hz: AxisPair,
    /// Delay of the rotors beyond the model's lag, ticks.
    pub rotor_delay_ticks: u8,
    /// Whether the model includes the spin-up reaction: Smeur's G2.
    pub rotor_spin_up: bool,
}

impl Indi {
    /// Checks that the laws are defined for these gains.
    ///
    /// # Errors
    /// The first key that is out of range.
    pub fn validate(&self) -> Result<()> {
        require_tilt("indi.tilt_max_rad", self.tilt_max_rad)?;
        for (key, gain) in [
            ("position_1_s2", self.position_1_s2),
            ("velocity_1_s", self.velocity_1_s),
            ("acceleration", self.acceleration),
            ("attitude_1_s2", self.attitude_1_s2),
            ("rate_1_s", self.rate_1_s),
        ] {
            gain.require_not_negative(&format!("indi.{key}"))?;
        }
        within("indi.feedback_rate", self.feedback_rate, 0.0, 1.0)?;
        require_cutoff("indi.acceleration_cutoff_hz", self.acceleration_cutoff_hz, OUTER_STEP_S)?;
        require_cutoff("indi.rate_cutoff_hz.xy", self.rate_cutoff_hz.xy, TICK_S)?;
        require_cutoff("indi.rate_cutoff_hz.z", self.rate_cutoff_hz.z, TICK_S)?;
        let delay = f32::from(self.rotor_delay_ticks);
        within("indi.rotor_delay_ticks", delay, 0.0, DELAY_TICKS_MAX as f64)
    }
}

/// The position law.
#[derive(Clone, Debug)]
pub struct IndiPosition {
    gains: Indi,
    model: Translation,
    velocity: Butterworth,
    difference: Difference,
    force: Butterworth,
}

impl IndiPosition {
    /// With valid gains; evaluated once per job of the outer partition.
    pub fn new(airframe: &Airframe, gains: &Indi) -> Self {
        let low_pass = || Butterworth::new(&Vector3::repeat(gains.acceleration_cutoff_hz), OUTER_STEP_S);
        Self {
            gains: *gains,
            model: Translation::new(airframe),
            velocity: low_pass(),
            difference: Difference::new(OUTER_STEP_S),
            force: low_pass(),
        }
    }
}

impl PositionLaw for IndiPosition {
    fn step(&mut self, input: &PositionInput) -> PositionDemand {
        let reference = input.reference;
        let [kx, kv, ka] =
            [self.gains.position_1_s2, self.gains.velocity_1_s, self.gains.acceleration].map(AxisPair::vector);
        let measured = self.difference.step(&self.velocity.step(input.velocity));
        // The rotors' force: the model's acceleration without drag and gravity.
        let mut rotors = input.acceleration + self.model.drag(input.velocity);
        rotors.z += self.model.gravity;
        let rotors = self.force.step(&rotors);

        let error = reference.position - input.position;
        let error_rate = reference.velocity - input.velocity;
        let error_acceleration = reference.acceleration - measured;
        let wanted = reference.acceleration
            + kx.component_mul(&error)
            + kv.component_mul(&error_rate)
            + ka.component_mul(&error_acceleration);
        let feedback_rate = kx.component_mul(&error_rate) + kv.component_mul(&error_acceleration);
        PositionDemand {
            s: Vector3::zeros(),
            profile: ForceProfile {
                force: rotors + wanted - measured,
                rate: reference.jerk + feedback_rate * self.gains.feedback_rate,
                acceleration: reference.snap,
            },
        }
    }

    fn reset(&mut self) {
        self.velocity.reset();
        self.difference.reset();
        self.force.reset();
    }
}

/// The modelled torque of the rotors, with their delay.
#[derive(Clone, Debug)]
struct RotorTorque {
    airframe: Airframe,
    spin_up: bool,
    spin_before: Option<f32>,
    on_the_way: [Vector3<f32>; DELAY_TICKS_MAX + 1],
    delay: usize,
    next: usize,
}

impl RotorTorque {
    fn new(airframe: &Airframe, gains: &Indi) -> Self {
        Self {
            airframe: *airframe,
            spin_up: gains.rotor_spin_up,
            spin_before: None,
            on_the_way: [Vector3::zeros(); DELAY_TICKS_MAX + 1],
            delay: usize::from(gains.rotor_delay_ticks).min(DELAY_TICKS_MAX),
            next: 0,
        }
    }

    /// The delayed torque of these speeds (rad/s), with the spin-up reaction −Jr Ω̇r.
    fn step(&mut self, speeds: &[f32; ROTORS]) -> Vector3<f32> {
        let mut torque = self.airframe.geometry.torque(speeds);
        let spin = self.airframe.rotor_spin_rad_s(speeds);
        let before = self.spin_before.replace(spin).unwrap_or(spin);
        if self.spin_up {
            torque.z -= self.airframe.rotor_inertia_kg_m2 * (spin - before) / TICK_S;
        }
        let length = self.on_the_way.len();
        self.on_the_way[self.next] = torque;
        let late = self.on_the_way[(self.next + length - self.delay) % length];
        self.next = (self.next + 1) % length;
        late
    }

    fn reset(&mut self) {
        self.spin_before = None;
        self.on_the_way = [Vector3::zeros(); DELAY_TICKS_MAX + 1];
    }
}

/// The attitude law.
#[derive(Clone, Debug)]
pub struct IndiAttitude {
    inertia: Vector3<f32>,
    kr: Vector3<f32>,
    kw: Vector3<f32>,
    rates: Butterworth,
    difference: Difference,
    rotors: RotorTorque,
    torque: Butterworth,
}

impl IndiAttitude {
    /// With valid gains; evaluated once per tick.
    pub fn new(airframe: &Airframe, gains: &Indi) -> Self {
        let low_pass = || Butterworth::new(&gains.rate_cutoff_hz.vector(), TICK_S);
        Self {
            inertia: airframe.inertia_kg_m2.into(),
            kr: gains.attitude_1_s2.vector(),
            kw: gains.rate_1_s.vector(),
            rates: low_pass(),
            difference: Difference::new(TICK_S),
            rotors: RotorTorque::new(airframe, gains),
            torque: low_pass(),
        }
    }

    /// The demanded Ω̇, rad/s².
    fn wanted(&self, input: &AttitudeInput) -> Vector3<f32> {
        let pointing = PointingError::between(input.attitude, &input.target.attitude);
        let desired = pointing.to_body(&input.target.rates);
        let feedforward = pointing.to_body(&input.target.accelerations) - input.rates.cross(&desired);
        let feedback = self.kr.component_mul(&pointing.error) + self.kw.component_mul(&(desired - input.rates));
        feedforward + feedback
    }
}

impl AttitudeLaw for IndiAttitude {
    fn step(&mut self, input: &AttitudeInput) -> AttitudeDemand {
        let measured = self.difference.step(&self.rates.step(input.rates));
        let torque = self.torque.step(&self.rotors.step(input.rotor_speeds));
        let increment = self.inertia.component_mul(&(self.wanted(input) - measured));
        AttitudeDemand { s: Vector3::zeros(), torque: torque + increment }
    }

    fn reset(&mut self) {
        self.rates.reset();
        self.difference.reset();
        self.rotors.reset();
        self.torque.reset();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::baseline::tests::{airframe, hover_speeds, input, level};
    use firmware::signals::FlatReference;

    /// By hand for the x500; the bounds below count on the cutoffs and on ka = 0.
    fn gains() -> Indi {
        Indi {
            tilt_max_rad: 1.2,
            position_1_s2: AxisPair { xy: 9.0, z: 12.0 },
            velocity_1_s: AxisPair { xy: 5.5, z: 6.0 },
            acceleration: AxisPair::default(),
            feedback_rate: 0.5,
            acceleration_cutoff_hz: 10.0,
            attitude_1_s2: AxisPair { xy: 250.0, z: 12.0 },
            rate_1_s: AxisPair { xy: 25.0, z: 6.0 },
            rate_cutoff_hz: AxisPair { xy: 20.0, z: 20.0 },
            rotor_delay_ticks: 1,
            rotor_spin_up: false,
        }
    }

    /// Turns the vehicle at a constant angular acceleration beyond that of its rotors, with all else in place, and
    /// returns the angular acceleration that the law's torque stands for after `ticks`.
    fn answer(beyond: &Vector3<f32>, ticks: u32) -> (Vector3<f32>, Vector3<f32>) {
        let (airframe, gains) = (airframe(), gains());
        let mut law = IndiAttitude::new(&airframe, &gains);
        let mut speeds = hover_speeds(&airframe);
        speeds[0] += 20.0;
        let inertia = Vector3::from(airframe.inertia_kg_m2);
        let acceleration = airframe.geometry.torque(&speeds).component_div(&inertia) + beyond;
        let (target, mut torque, mut wanted) = (level(), Vector3::zeros(), Vector3::zeros());
        for tick in 0..ticks {
            let rates = acceleration * (tick as f32 * TICK_S);
            let input = input(&target.attitude, &rates, &target, &speeds);
            wanted = law.wanted(&input);
            torque = law.step(&input).torque;
        }
        (torque.component_div(&inertia), wanted)
    }

    #[test]
    fn with_an_exact_model_the_increment_gives_the_acceleration_wanted() {
        // Behind the filter's answer, e^(−ζωt) = e^(−89·0.3); f32 differences of rates up to 30 rad/s leave 2e-6/1e-3 a
        // tick, filtered.
        let (given, wanted) = answer(&Vector3::zeros(), 300);
        assert!((given - wanted).norm() < 0.02 + 1e-4 * wanted.norm(), "{given} {wanted}");
    }

    #[test]
    fn a_torque_that_is_not_in_the_model_is_compensated_behind_the_filter() {
        let beyond = Vector3::new(8.0, -5.0, 2.0);
        let (given, wanted) = answer(&beyond, 300);
        assert!((given - (wanted - beyond)).norm() < 0.02 + 1e-4 * wanted.norm(), "{given} {wanted}");
        // ζω = 89 1/s at 20 Hz: after 75 ms e^(−6.7) of it is left, and at the start nearly all.
        let left = |ticks: u32| {
            let (given, wanted) = answer(&beyond, ticks);
            let (exact, exact_wanted) = answer(&Vector3::zeros(), ticks);
            let taken = (wanted - given) - (exact_wanted - exact);
            (beyond - taken).norm() / beyond.norm()
        };
        assert!(left(75) < 0.01, "{}", left(75));
        assert!(left(3) > 0.9, "{}", left(3));
    }

    #[test]
    fn rotors_that_speed_up_push_back_and_as_late_as_they_do() {
        let airframe = airframe();
        let (hover, mut faster) = (hover_speeds(&airframe), hover_speeds(&airframe));
        let towards = |rotor: &usize| airframe.geometry.yaw[*rotor] > 0.0;
        (0..ROTORS).filter(towards).for_each(|rotor| faster[rotor] += 1.0);
        let mut model = RotorTorque::new(&airframe, &Indi { rotor_delay_ticks: 3, rotor_spin_up: true, ..gains() });
        let mut yaw = Vec::new();
        for tick in 0..10 {
            yaw.push(model.step(if tick < 4 { &hover } else { &faster }).z);
        }
        // Two rotors gain 1 rad/s in a tick: −Jr Ω̇r is 2 Jr/h, towards +ψ as is their drag; three ticks later.
        let drag = airframe.geometry.torque(&faster).z;
        let spin_up = 2.0 * airframe.rotor_inertia_kg_m2 / TICK_S;
        assert!(yaw[..7].iter().all(|torque| torque.abs() < 1e-6), "{yaw:?}");
        assert!((yaw[7] - (drag + spin_up)).abs() < 1e-4 * spin_up, "{yaw:?}");
        assert!((yaw[8] - drag).abs() < 1e-6, "{yaw:?}");
    }

    #[test]
    fn a_push_that_is_not_in_the_model_is_compensated_and_so_is_drag() {
        let airframe = airframe();
        let mut law = IndiPosition::new(&airframe, &gains());
        let (push, model) = (Vector3::new(1.0, -2.0, 0.5), Vector3::new(0.3, 0.2, -0.1));
        let (reference, position) = (FlatReference::standing(Vector3::zeros(), 0.0), Vector3::zeros());
        let (mut given, mut velocity) = (Vector3::zeros(), Vector3::zeros());
        for _ in 0..250 {
            velocity += (model + push) * OUTER_STEP_S;
            let input = PositionInput {
                reference: &reference,
                position: &position,
                velocity: &velocity,
                acceleration: &model,
                limited: false,
            };
            given = law.step(&input).profile.force;
        }
        // f = a_wanted + g e3 + drag − push; what is wanted is −(1 + ka) times nothing but the velocity's feedback here,
        // ka being 0.
        let wanted = -gains().velocity_1_s.vector().component_mul(&velocity);
        let mut exact = wanted - push + Translation::new(&airframe).drag(&velocity);
        exact.z += airframe.gravity_m_s2;
        // The drag grows with the velocity, so that behind the filter it is late by √2/ω: 0.12·2.2·√2/63 = 6e-3.
        assert!((given - exact).norm() < 0.02, "{given} {exact}");
    }
}
