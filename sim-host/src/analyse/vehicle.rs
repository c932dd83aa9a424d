//! The vehicle about hover: the inputs of the laws, and the effect of their demands.

use anyhow::{Context, Result, ensure};
use firmware::airframe::ROTORS;
use firmware::config::{FlightConfig, Start};
use firmware::control::rotor::RotorTorque;
use firmware::guidance::Trajectory;
use firmware::schedule::OUTER;
use firmware::signals::TICK_S_EXACT;
use nalgebra::{Complex, Matrix4, Vector4};

use super::chain::{Chain, Sampled};
use crate::scenario::{Scenario, World};

/// Period of the outer partition, s.
pub(super) const OUTER_STEP_S: f64 = OUTER.period as f64 * TICK_S_EXACT;

/// From the outer partition's release to its output, s.
const AHEAD_S: f64 = OUTER.offset as f64 * TICK_S_EXACT;

/// `e^(jωt)`.
pub(super) fn turned(angle: f64) -> Complex<f64> {
    let (sin, cos) = libm::sincos(angle);
    Complex::new(cos, sin)
}

/// The scenario's vehicle and controller, hovering on ideal state at the origin in still air, without faults, at sea
/// level.
pub(super) fn hovering(scenario: &Scenario) -> Scenario {
    let mut hover = scenario.clone();
    let file = &mut hover.file;
    (file.sensors, file.command) = (None, Vec::new());
    file.trajectory = Trajectory::Hold { position_m: [0.0; 3], yaw_rad: 0.0 };
    (file.join, file.disturbance, file.wind, file.tumble, file.battery) = (None, None, None, None, None);
    (file.push, file.fault, file.world) = (Vec::new(), Vec::new(), World::default());
    (file.start, file.ground, file.start_position_m) = (Start::InFlight, false, [0.0; 3]);
    (file.start_velocity_m_s, file.start_attitude_deg, file.start_rates_rad_s) = (None, None, None);
    hover
}

/// The rotor model of the firmware, linear.
#[derive(Clone, Copy, Debug, PartialEq)]
struct BelievedRotor {
    /// Fraction of the distance to the wanted speed that a rotor covers per tick.
    part: f64,
    lead: f64,
    /// Fraction of the difference between present and wanted yaw torque that is commanded per tick.
    yaw: f64,
}

impl BelievedRotor {
    fn new(config: &FlightConfig) -> Self {
        let (lag, wanted) = (f64::from(config.airframe.rotor_lag_s), f64::from(config.rotor_answer_s()));
        let part = |time_s: f64| if time_s > 0.0 { 1.0 - libm::exp(-TICK_S_EXACT / time_s) } else { 1.0 };
        let lead = if wanted < lag { part(wanted) / part(lag) } else { 1.0 };
        Self { part: lead * part(lag), lead, yaw: f64::from(config.yaw_inversion().demand(0.0, 1.0)) }
    }
}

/// Response to a demand at a frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Actuation {
    /// Torque that the firmware estimates before it computes this tick's command; about yaw without the spin-up
    /// reaction.
    pub(super) believed: Complex<f64>,
    /// The command.
    pub(super) command: Complex<f64>,
    /// The command, delayed.
    pub(super) delayed: Complex<f64>,
}

/// A vehicle about hover.
#[derive(Clone, Debug)]
pub(super) struct Vehicle {
    rotor: BelievedRotor,
    /// The firmware's estimate of its rotors' effect.
    pub(super) rotor_torque: RotorTorque,
    delay_s: f64,
    /// Rotor speeds, rad/s.
    pub(super) omega: Vector4<f64>,
    /// Change of the rotor speeds per N m about an axis, rad/s.
    pub(super) omega_per_torque: [Vector4<f64>; 3],
    /// Thrust over mass in the firmware's model, m/s²: the vertical force that its position law demands.
    pub(super) specific_thrust: f64,
    /// Mass in the firmware's model, kg.
    pub(super) mass_kg: f64,
    /// k over m in the firmware's model, 1/s.
    pub(super) specific_drag: [f64; 3],
    /// About x, y, z, with the horizontal motion due to the tilt.
    pub(super) about: [Sampled; 3],
    /// Along z.
    pub(super) vertical: Sampled,
}

impl Vehicle {
    /// Of a scenario.
    ///
    /// # Errors
    /// The rotor geometry is singular, or the vehicle cannot hover, so that it has no loops about hover.
    pub(super) fn new(scenario: &Scenario) -> Result<Self> {
        let (truth, believed) = (scenario.constants(), scenario.airframe.constants());
        let inverse = believed.geometry.try_inverse().context("`rotors`: the four cannot be mixed")?;
        // Response of U1..U4; the off-diagonal terms couple the axes, and are neglected.
        let given: Matrix4<f64> = truth.geometry * inverse;
        let thrust = truth.mass * truth.gravity / given[(0, 0)];
        let omega = (inverse.column(0) * thrust).map(|square: f64| square.max(0.0).sqrt());
        let omega_max = scenario.airframe.omega_max();
        ensure!(
            omega.min() > 0.0 && omega.max() < omega_max,
            "the vehicle cannot hover: that takes rotors between {:.0} and {:.0} rad/s, and theirs is 0 to {omega_max:.0}: \
             change `truth` or `thrust_to_weight`",
            omega.min(),
            omega.max()
        );
        let per_torque = |axis: usize| inverse.column(axis + 1).component_div(&(omega * 2.0));
        let omega_per_torque = core::array::from_fn(per_torque);
        let reacts = truth.spin_up_reaction && truth.rotor_lag > 0.0;
        let about = |axis: usize| {
            let gain = given[(axis + 1, axis + 1)];
            let momentum = truth.rotor_inertia * truth.spin.dot(&omega_per_torque[axis]);
            Chain {
                lag_s: truth.rotor_lag,
                reaction_s: if reacts && axis == 2 { -momentum / gain } else { 0.0 },
                gain: gain / truth.inertia[axis],
                tilt: if axis == 2 { 0.0 } else { truth.gravity },
                // Roll moves it along y, pitch along x.
                drag: truth.drag[1 - axis.min(1)] / truth.mass,
                rate_drag: 0.0,
            }
        };
        let vertical = Chain {
            lag_s: truth.rotor_lag,
            gain: given[(0, 0)] / truth.mass,
            rate_drag: truth.drag.z / truth.mass,
            ..Chain::default()
        };
        let config = scenario.flight_config();
        Ok(Self {
            rotor: BelievedRotor::new(&config),
            rotor_torque: RotorTorque::new(&config.airframe),
            delay_s: scenario.actuation_delay_ticks() as f64 * TICK_S_EXACT,
            omega,
            omega_per_torque,
            specific_thrust: thrust / believed.mass,
            mass_kg: believed.mass,
            specific_drag: (believed.drag / believed.mass).into(),
            about: [0, 1, 2].map(|axis| about(axis).sampled(TICK_S_EXACT)),
            vertical: vertical.sampled(TICK_S_EXACT),
        })
    }

    /// Rotor speeds (rad/s) that are believed to give a torque (N m) about an axis beside hover's thrust.
    pub(super) fn speeds(&self, axis: usize, torque: f64) -> [f32; ROTORS] {
        (self.omega + self.omega_per_torque[axis] * torque).map(|omega| omega as f32).into()
    }

    /// What becomes of a torque about an axis at ω, rad/s. About yaw the rotors are told u = B + p (demand − B), B being
    /// what they are believed to give: u = p demand/(1 − (1 − p) b), with B = b u.
    pub(super) fn turning(&self, axis: usize, omega_rad_s: f64) -> Actuation {
        let plain = self.actuation(omega_rad_s);
        let one = Complex::new(1.0, 0.0);
        let told = if axis == 2 { one * self.rotor.yaw / (one - plain.believed * (1.0 - self.rotor.yaw)) } else { one };
        Actuation { believed: plain.believed * told, command: plain.command * told, delayed: plain.delayed * told }
    }

    /// What becomes of a thrust at ω, rad/s.
    pub(super) fn actuation(&self, omega_rad_s: f64) -> Actuation {
        let BelievedRotor { part, lead, .. } = self.rotor;
        let z = turned(omega_rad_s * TICK_S_EXACT);
        let believed = Complex::new(part, 0.0) / (z - 1.0 + part);
        let command = believed + (Complex::new(1.0, 0.0) - believed) * lead;
        Actuation { believed, command, delayed: command * turned(-omega_rad_s * self.delay_s) }
    }

    /// Position, velocity and acceleration as a position law gets them, predicted from those at the release; the
    /// acceleration is what the thrust gives at the release.
    pub(super) fn predicted(&self, axis: usize, [position, velocity, thrust]: [Complex<f64>; 3]) -> [Complex<f64>; 3] {
        let acceleration = thrust - velocity * self.specific_drag[axis];
        [
            position + velocity * AHEAD_S + acceleration * (0.5 * AHEAD_S * AHEAD_S),
            velocity + acceleration * AHEAD_S,
            acceleration,
        ]
    }

    /// How a force and its two derivatives, given at the release, reach the inner partition: held for a period of the
    /// outer, carried on by a Taylor series. Amplitudes at ω of 1, t, t²/2 since the reference holds.
    pub(super) fn hold(omega_rad_s: f64) -> [Complex<f64>; 3] {
        let mut sum = [Complex::new(0.0, 0.0); 3];
        for tick in 0..OUTER.period {
            let t = f64::from(tick) * TICK_S_EXACT;
            let turn = turned(-omega_rad_s * (t + AHEAD_S)) / f64::from(OUTER.period);
            for (sum, weight) in sum.iter_mut().zip([1.0, t, 0.5 * t * t]) {
                *sum += turn * weight;
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vehicle_that_cannot_hover_has_no_loops_about_it() {
        let vehicle = |settings: &[&str]| {
            let settings: Vec<String> = settings.iter().map(|s| (*s).to_owned()).collect();
            Vehicle::new(&hovering(&Scenario::load("x500-hover", &settings).expect("valid")))
        };
        // Hover takes √(mass factor/thrust to weight) of the greatest speed.
        assert!(vehicle(&["thrust_to_weight=2.0", "truth.mass_factor=1.9"]).is_ok());
        for settings in [
            &["thrust_to_weight=2.0", "truth.mass_factor=2.1"][..],
            &["thrust_to_weight=2.0", "truth.rotor_effectiveness=[0.4,0.4,0.4,0.4]"],
        ] {
            let error = format!("{:#}", vehicle(settings).expect_err("too heavy"));
            let names = error.contains("`truth`") && error.contains("`thrust_to_weight`");
            assert!(names && !error.contains('\n'), "{error}");
        }
    }
}
