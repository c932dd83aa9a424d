//! Margins, bandwidth and noise of a scenario's loops about hover: linear, and checked against the simulation.
//!
//! A loop is opened where its law gives its demand: roll, pitch and yaw at the torque, between attitude law and mixer; x, y
//! and z at the specific force with its two derivatives, between position law and flatness, the attitude loops closed. All
//! is sampled: z = e^(jωh) with h = 1 ms, and 4 ms for the position laws.
//!
//! **The law** is the code that flies. Its gains C at ω are measured on it (`law`): a small sinusoid on one input, the
//! others at rest, and a least-squares fit of its output. For a law that is not linear this is its describing function.
//! **The vehicle** is analytic, in f64 (`chain`, `vehicle`): rotor lag, rigid body and drag with the command held for a
//! tick; D is the command for a demand (the firmware's lead compensation) with the actuation delay, R the torque that
//! the firmware estimates from the rotor speeds (the spin-up reaction is in Cω), X the motion for a torque.
//!
//! ```text
//! attitude    L = −(Cθ Xθ D + CΩ XΩ D + Cω R)
//! position    w = (Cθd k0, Cθd k1 + CΩd k0, Cθd k2 + CΩd k1 + CΩ̇d k0) / ((1 + L_attitude) f₀)       f₀ = g in hover
//!             L = −w · (Cx x + Cv v + Ca a),        x, v, a predicted over the outer partition's 2 ms
//! z           w = m (k0, k1, 0), and X along z for a thrust
//! kn(ω)       ¼ Σ_m (mh)ⁿ/n! e^(−jω(m + 2)h), m = 0..3: released at tick 0, held from tick 2, carried on by Taylor
//! ```
//!
//! w weighs a demand (f, ḟ, f̈) by the resulting torque, so L is a scalar although the demand has three components. A
//! gain or a delay of the demand multiplies L. The 4 ms hold has images at ω ± 2π/4h and ω − 4π/4h. With them the loop
//! is a sum of such products, a 3 × 3 matrix, and L its largest eigenvalue: near the crossover the only one that is not
//! zero. Coupling between axes is neglected: about a level hover it is of second order, unless the rotors are unequal.
//!
//! **The simulation** is the whole firmware on the nonlinear plant (`simulated`), with a tap on the law: a sinusoid
//! there measures L, a gain or a delay there shows where the loop becomes unstable.

pub mod chain;
mod law;
mod linear;
pub mod margins;
mod simulated;
mod sine;
mod tap;
mod vehicle;

use anyhow::Result;
use firmware::control::attitude::SlidingAttitude;
use firmware::control::law::{AttitudeLaw, PositionLaw};
use firmware::control::position::SlidingPosition;
use serde::Serialize;

use crate::baseline::geometric::{GeometricAttitude, GeometricPosition};
use crate::baseline::indi::{IndiAttitude, IndiPosition};
use crate::baseline::pid::{PidAttitude, PidPosition};
use crate::controller::Controller;
use crate::parallel;
use crate::scenario::Scenario;
use linear::{AttitudeAt, LoopAt, Which};
pub use margins::{GainMargin, Margins, Sample};
use margins::{angle, frequencies, size};
use simulated::Rig;
use tap::Change;
use vehicle::Vehicle;

/// Frequencies of a loop's response.
const POINTS: usize = 240;

/// The attitude step, °, and one that is small for any law.
pub const STEP_DEG: f64 = 5.0;
const SMALL_STEP_DEG: f64 = 0.05;

/// Deviation of the test noise on the rates, rad/s.
const NOISE_RAD_S: f64 = 1e-3;
/// Its duration, ticks.
const NOISE_TICKS: u32 = 20_000;

/// L at a frequency, linear and in the simulation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Check {
    /// From the linear model.
    pub linear: Sample,
    /// From the simulation.
    pub simulated: Sample,
    /// |L| simulated over |L| linear, minus 1.
    pub gain_error: f64,
    /// Difference of the phases, °.
    pub phase_error_deg: f64,
}

/// A change to a loop in the simulation, near a margin.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MarginCheck {
    /// Factor on the loop's gain.
    pub gain: f64,
    /// Additional delay of the demand, s.
    pub delay_s: f64,
    /// Whether it should come to rest, by the margins.
    pub expected_stable: bool,
    /// Whether it came to rest.
    pub stable: bool,
}

/// A loop.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Loop {
    /// roll, pitch, yaw, x, y, z.
    pub name: &'static str,
    /// Whether the unmodified loop comes to rest in the simulation; if not, its margins are meaningless.
    pub stable: bool,
    /// Its margins, linear.
    pub margins: Margins,
    /// Around the crossover; none of a loop that is not stable.
    pub checks: Vec<Check>,
    /// Frequencies of those that are left out, rad/s: there the response had not settled, as near a margin.
    pub unsettled_rad_s: Vec<f64>,
    /// 5 % on either side of each gain margin, and the whole steps on either side of the delay margin, 7 % off at
    /// least: the other loops, closed, shift it by some of that, and a flight closer to it would take too long to
    /// decide.
    pub margin_checks: Vec<MarginCheck>,
    /// L.
    pub response: Vec<Sample>,
}

/// Tracking of an attitude axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Attitude {
    /// roll, pitch, yaw.
    pub name: &'static str,
    /// −3 dB from the target's angle to the angle, linear, rad/s.
    pub bandwidth_rad_s: Option<f64>,
    /// From 10 % to 90 % of a step of [`STEP_DEG`] in the simulation, s.
    pub rise_s: Option<f64>,
    /// As a fraction of the step.
    pub overshoot: f64,
    /// Commanded rotor speed for noise on this axis' measured rate, over frequency: RMS over the rotors, rad/s per
    /// rad/s.
    pub noise_gain: Vec<(f64, f64)>,
    /// The step in the simulation: time (s) and angle in units of the step.
    pub step: Vec<(f64, f64)>,
    /// The same for a step that is small.
    pub small_step: Vec<(f64, f64)>,
}

/// RMS of the commanded rotor speeds, in rad/s per rad/s of noise on all three rates, white from tick to tick.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Noise {
    /// For a standard deviation of 1 rad/s per sample, linear.
    pub per_sample: f64,
    /// The same in the simulation.
    pub per_sample_simulated: f64,
    /// For a one-sided density of 1 rad/s/√Hz up to 500 Hz, linear.
    pub per_density: f64,
}

/// The analysis of a scenario.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Analysis {
    /// Its name.
    pub scenario: String,
    /// The controller.
    pub controller: &'static str,
    /// Roll, pitch, yaw, x, y, z.
    pub loops: Vec<Loop>,
    /// Roll, pitch, yaw.
    pub attitude: Vec<Attitude>,
    /// From rate noise to the rotors.
    pub noise: Noise,
}

/// Analyses a scenario's vehicle and controller about hover, whatever the scenario flies; `seed` is that of the test
/// noise.
///
/// # Errors
/// The scenario has another plant than the rigid body, or the firmware refuses its configuration.
pub fn analyse(scenario: &Scenario, seed: u64) -> Result<Analysis> {
    scenario.require_rigid_body()?;
    let hover = vehicle::hovering(scenario);
    let (config, airframe) = (hover.flight_config(), hover.airframe.flight());
    match &hover.controller {
        Controller::Smc(_) => {
            let attitude = SlidingAttitude::new(&config.airframe, &config.attitude);
            of_laws(&hover, seed, &attitude, &SlidingPosition::new(&airframe, &config.position))
        }
        Controller::Pid(gains) => {
            of_laws(&hover, seed, &PidAttitude::new(&airframe, gains), &PidPosition::new(&airframe, gains))
        }
        Controller::Geometric(gains) => {
            let attitude = GeometricAttitude::new(&airframe, gains);
            of_laws(&hover, seed, &attitude, &GeometricPosition::new(&airframe, gains))
        }
        Controller::Indi(gains) => {
            of_laws(&hover, seed, &IndiAttitude::new(&airframe, gains), &IndiPosition::new(&airframe, gains))
        }
    }
}

/// The same for a hovering scenario, with its laws, which must be in their initial state; clones of them are flown.
///
/// # Errors
/// The firmware refuses the configuration: the first field that is out of range.
fn of_laws<A, P>(hover: &Scenario, seed: u64, attitude: &A, position: &P) -> Result<Analysis>
where
    A: AttitudeLaw + Clone + Sync,
    P: PositionLaw + Clone + Sync,
{
    let vehicle = Vehicle::new(hover)?;
    let rig = Rig { scenario: hover, vehicle: &vehicle, laws: (attitude, position) };
    let attitude: Vec<_> = parallel::try_map(&[0, 1, 2], |axis| attitude_of(&rig, *axis))?;
    let (attitude, variances): (Vec<Attitude>, Vec<f64>) = attitude.into_iter().unzip();
    let per_sample = variances.iter().sum::<f64>().sqrt();
    Ok(Analysis {
        scenario: hover.name.clone(),
        controller: hover.controller.name(),
        loops: parallel::try_map(&Which::ALL, |which| loop_of(&rig, *which))?,
        attitude,
        noise: Noise {
            per_sample,
            per_sample_simulated: rig.command_rms(seed, NOISE_RAD_S, NOISE_TICKS)? / NOISE_RAD_S,
            per_density: per_sample * NYQUIST_HZ.sqrt(),
        },
    })
}

/// Of a sample a tick.
const NYQUIST_HZ: f64 = 500.0;

fn loop_of<A, P>(rig: &Rig<A, P>, which: Which) -> Result<Loop>
where
    A: AttitudeLaw + Clone + Sync,
    P: PositionLaw + Clone + Sync,
{
    let nyquist = core::f64::consts::PI / which.step_s();
    let at = |omega: f64| which.at(rig.laws, rig.vehicle, omega);
    let first = if which.step_s() > 2e-3 { 0.5 } else { 1.0 };
    let response: Vec<Sample> = parallel::map(&frequencies(first, 0.99 * nyquist, POINTS), |omega| Sample {
        omega_rad_s: *omega,
        value: at(*omega).value,
    });
    let margins = Margins::of(&response, Some(nyquist));
    let mut made = Loop {
        name: which.name(),
        stable: true,
        margins,
        checks: vec![],
        unsettled_rad_s: vec![],
        margin_checks: vec![],
        response,
    };
    let Some(crossover) = margins.crossover_rad_s else { return Ok(made) };
    made.stable = rig.is_stable(which, &at(crossover), crossover, Change::NONE)?;
    let around = [0.3, 0.6, 1.0, 1.7, 3.0].map(|times| times * crossover);
    for omega in around.into_iter().filter(|omega| made.stable && *omega < 0.8 * nyquist) {
        match check(rig, which, &at(omega), omega, crossover)? {
            Some(check) => made.checks.push(check),
            None => made.unsettled_rad_s.push(omega),
        }
    }
    for (change, omega, expected_stable) in near_margins(&margins, which.step_s()) {
        let stable = rig.is_stable(which, &at(omega), omega, change)?;
        let delay_s = change.delay_steps as f64 * which.step_s();
        made.margin_checks.push(MarginCheck { gain: change.gain, delay_s, expected_stable, stable });
    }
    Ok(made)
}

fn check<A, P>(rig: &Rig<A, P>, which: Which, linear: &LoopAt, omega: f64, crossover: f64) -> Result<Option<Check>>
where
    A: AttitudeLaw + Clone,
    P: PositionLaw + Clone,
{
    let Some(simulated) = rig.measure(which, linear, omega, crossover)? else { return Ok(None) };
    let ratio = simulated / linear.value;
    Ok(Some(Check {
        linear: Sample { omega_rad_s: omega, value: linear.value },
        simulated: Sample { omega_rad_s: omega, value: simulated },
        gain_error: size(ratio) - 1.0,
        phase_error_deg: angle(ratio).to_degrees(),
    }))
}

/// Changes on either side of each margin, with the frequency of oscillation and whether the loop should stay stable.
fn near_margins(margins: &Margins, step_s: f64) -> Vec<(Change, f64, bool)> {
    let mut changes = Vec::new();
    let gain = |factor: f64| Change { gain: factor, delay_steps: 0 };
    if let Some(GainMargin { factor, omega_rad_s }) = margins.gain_upper {
        changes.extend([(gain(0.95 * factor), omega_rad_s, true), (gain(1.05 * factor), omega_rad_s, false)]);
    }
    if let Some(GainMargin { factor, omega_rad_s }) = margins.gain_lower {
        changes.extend([(gain(1.05 * factor), omega_rad_s, true), (gain(0.95 * factor), omega_rad_s, false)]);
    }
    if let (Some(delay_s), Some(omega)) = (margins.delay_s, margins.delay_omega_rad_s) {
        let delay = |steps: f64| Change { gain: 1.0, delay_steps: steps as usize };
        let (below, above) = ((0.93 * delay_s / step_s).floor(), (1.07 * delay_s / step_s).ceil());
        changes.extend([(delay(below), omega, true), (delay(above), omega, false)]);
    }
    changes
}

/// An attitude axis, and the variance of the rotors' commands for a variance of 1 of its measured rate.
fn attitude_of<A, P>(rig: &Rig<A, P>, axis: usize) -> Result<(Attitude, f64)>
where
    A: AttitudeLaw + Clone + Sync,
    P: PositionLaw + Clone + Sync,
{
    let nyquist = core::f64::consts::PI / Which::Attitude(axis).step_s();
    let share = rig.vehicle.omega_per_torque[axis].norm() / 2.0;
    let points: Vec<(f64, f64, f64)> = parallel::map(&frequencies(1.0, 0.99 * nyquist, POINTS), |omega| {
        let at = AttitudeAt::new(rig.laws.0, rig.vehicle, axis, *omega);
        (*omega, size(at.followed()), share * size(at.command_for_rate_noise()))
    });
    let noise_gain: Vec<(f64, f64)> = points.iter().map(|(omega, _, gain)| (*omega, *gain)).collect();
    let variance = mean_square(&noise_gain, nyquist);
    let bandwidth_rad_s = bandwidth(&points);
    let ticks = bandwidth_rad_s.map_or(1000, |omega| (20e3 / omega) as u32).clamp(200, 4000);
    let step = rig.step(axis, STEP_DEG.to_radians(), ticks)?;
    let small_step = rig.step(axis, SMALL_STEP_DEG.to_radians(), ticks)?;
    let after = |level: f64| step.iter().find(|(_, angle)| *angle >= level).map(|(t, _)| *t);
    let attitude = Attitude {
        name: Which::Attitude(axis).name(),
        bandwidth_rad_s,
        rise_s: after(0.9).zip(after(0.1)).map(|(end, start)| end - start),
        overshoot: step.iter().fold(0.0_f64, |most, (_, angle)| most.max(angle - 1.0)),
        noise_gain,
        step,
        small_step,
    };
    Ok((attitude, variance))
}

/// Frequency at which a response of DC gain 1 first falls below 1/√2, rad/s.
fn bandwidth(points: &[(f64, f64, f64)]) -> Option<f64> {
    let level = core::f64::consts::FRAC_1_SQRT_2;
    points.windows(2).find(|pair| pair[0].1 >= level && pair[1].1 < level).map(|pair| {
        let part = (pair[0].1 - level) / (pair[0].1 - pair[1].1);
        pair[0].0 + part * (pair[1].0 - pair[0].0)
    })
}

/// Mean of a gain's square from 0 to `last` (rad/s): trapezia, constant beyond the ends.
fn mean_square(gain: &[(f64, f64)], last: f64) -> f64 {
    let trapezium =
        |pair: &[(f64, f64)]| 0.5 * (pair[1].0 - pair[0].0) * (pair[0].1 * pair[0].1 + pair[1].1 * pair[1].1);
    let ends = gain.first().map_or(0.0, |(w, g)| w * g * g) + gain.last().map_or(0.0, |(w, g)| (last - w) * g * g);
    (gain.windows(2).map(trapezium).sum::<f64>() + ends) / last
}
