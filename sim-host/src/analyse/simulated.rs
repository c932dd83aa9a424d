//! The loops in the simulation: the whole firmware and the nonlinear plant in lockstep, with a tap on a law.

use std::cell::RefCell;

use anyhow::Result;
use firmware::control::law::{AttitudeLaw, PositionLaw};
use firmware::signals::AttitudeTarget;
use nalgebra::{Complex, Vector3, Vector4};

use super::law::turn;
use super::linear::{LoopAt, Which};
use super::margins::size;
use super::sine::Schedule;
use super::tap::{Change, Log, Signal, Tap, TappedAttitude, TappedPosition};
use super::vehicle::Vehicle;
use crate::flight;
use crate::noise::White;
use crate::record::{Recorder, Row};
use crate::scenario::Scenario;
use crate::sil::Lockstep as _;

/// Settling time before the response to a sinusoid is evaluated for the first time, in units of 1/ω of the crossover.
const SETTLING: f64 = 30.0;

/// How often it is doubled at most, until L is the same before and after: a loop near its margin takes long.
const DOUBLINGS: usize = 6;

/// L at the beginning and after twice the time is the same if it differs by less than this part of it: the least that is
/// shown, 0.1 %.
const SETTLED: f64 = 1e-3;

/// Duration of a flight at a margin: in units of 1/ω, and in steps at least.
const WATCHED: f64 = 400.0;
const WATCHED_STEPS: u32 = 2_000;

/// The initial push, in units of the amplitude of a small sinusoid: an oscillation then has room to grow.
const PUSH: f64 = 0.2;

/// A hovering vehicle, and the laws that fly it.
pub(super) struct Rig<'a, A, P> {
    pub(super) scenario: &'a Scenario,
    pub(super) vehicle: &'a Vehicle,
    pub(super) laws: (&'a A, &'a P),
}

impl<A: AttitudeLaw + Clone, P: PositionLaw + Clone> Rig<'_, A, P> {
    /// The demands of a loop's law over a number of its steps: torque, or force with two derivatives. The attitude
    /// loops are flown with a level target whatever the position loops demand, as in the linear model.
    fn asked(&self, which: Which, change: Change, signal: Signal, steps: u32) -> Result<Vec<[f64; 3]>> {
        let ticks = steps * (which.step_s() * 1e3).round() as u32;
        let mut attitude = TappedAttitude::plain(self.laws.0.clone());
        let mut position = TappedPosition { law: self.laws.1.clone(), tap: None };
        let (torques, forces): (Log<1>, Log<3>) = (RefCell::default(), RefCell::default());
        match which {
            Which::Attitude(axis) => {
                attitude.target = Some(held(0.0, axis));
                attitude.tap = Some(Tap::new(axis, [0.0], change, signal, &torques));
            }
            Which::Position(axis) => {
                let rest = [if axis == 2 { self.vehicle.specific_thrust } else { 0.0 }, 0.0, 0.0];
                position.tap = Some(Tap::new(axis, rest, change, signal, &forces));
            }
        }
        self.fly(attitude, position, ticks, &mut ())?;
        let torques = torques.into_inner().into_iter().map(|[torque]| [torque, 0.0, 0.0]);
        Ok(torques.chain(forces.into_inner()).collect())
    }

    fn fly(
        &self,
        attitude: TappedAttitude<A>,
        position: TappedPosition<P>,
        ticks: u32,
        recorder: &mut impl Recorder,
    ) -> Result<()> {
        let plant = flight::rigid_body(self.scenario, 1);
        flight::with_laws(self.scenario, 1, plant, attitude, position)?.run(ticks, recorder);
        Ok(())
    }

    /// L at a frequency, measured: a sinusoid is added to the demand, and the law's demand is compared with the sum. `None`
    /// if it does not settle.
    pub(super) fn measure(
        &self,
        which: Which,
        linear: &LoopAt,
        omega_rad_s: f64,
        crossover: f64,
    ) -> Result<Option<Complex<f64>>> {
        let step_s = which.step_s();
        let amplitude = linear.small * size(linear.value + 1.0) / size(linear.weights[0]);
        let signal = Signal::Sine { amplitude, omega_step: omega_rad_s * step_s };
        let mut early = Schedule::new(omega_rad_s, step_s, SETTLING / crossover);
        for _ in 0..DOUBLINGS {
            let late = early.later();
            let asked = self.asked(which, Change::NONE, signal, late.steps())?;
            let [before, after] = [early, late].map(|schedule| opened(linear, amplitude, &schedule, &asked));
            if size(after - before) < SETTLED * size(after) {
                return Ok(Some(after));
            }
            early = late;
        }
        Ok(None)
    }

    /// Whether a loop comes to rest after a push, with a change that would make it oscillate at about ω.
    pub(super) fn is_stable(&self, which: Which, linear: &LoopAt, omega_rad_s: f64, change: Change) -> Result<bool> {
        let per_turn = 1.0 / (omega_rad_s * which.step_s());
        let steps = ((WATCHED * per_turn).ceil() as u32).max(WATCHED_STEPS);
        // In one step as much as the sinusoid in 1/ω.
        let push = PUSH * per_turn * linear.small / size(linear.weights[0]);
        let asked = self.asked(which, change, Signal::Impulse(push), steps)?;
        let first = change.delay_steps + (WATCHED * per_turn / 20.0).ceil() as usize;
        let (early, rest) = asked.split_at(first.min(asked.len()));
        let part = |from: usize, to: usize| deviation(&rest[rest.len() * from / 4..rest.len() * to / 4]);
        let (early, middle, late) = (deviation(early), part(1, 2), part(3, 4));
        // Decayed to rest or to rounding, or grown, perhaps to a limit cycle; near the margin both are slow.
        Ok(late < 0.1 * early || (late < 10.0 * early && late < middle))
    }

    /// Angle about `axis` (rad) after a step of the target's of so many rad, a sample a tick, in units of the step.
    pub(super) fn step(&self, axis: usize, step_rad: f64, ticks: u32) -> Result<Vec<(f64, f64)>> {
        let mut attitude = TappedAttitude::plain(self.laws.0.clone());
        attitude.target = Some(held(step_rad, axis));
        let mut rows: Vec<Row> = Vec::new();
        let position = TappedPosition { law: self.laws.1.clone(), tap: None };
        self.fly(attitude, position, ticks, &mut rows)?;
        let angle = |row: &Row| crate::angles::roll_pitch_yaw(row.attitude)[axis];
        Ok(rows.iter().map(|row| (row.t, angle(row) / step_rad)).collect())
    }

    /// RMS over all rotors of the change of their commanded speed (rad/s), with white noise of deviation `sigma_rad_s` on
    /// the measured rates.
    pub(super) fn command_rms(&self, seed: u64, sigma_rad_s: f64, ticks: u32) -> Result<f64> {
        let mut attitude = TappedAttitude::plain(self.laws.0.clone());
        attitude.noise = Some(White::new(seed, sigma_rad_s));
        let mut rows: Vec<Row> = Vec::new();
        let position = TappedPosition { law: self.laws.1.clone(), tap: None };
        self.fly(attitude, position, ticks, &mut rows)?;
        let settled = &rows[rows.len() / 10..];
        let omega = self.vehicle.omega;
        let change = |row: &Row| Vector4::from(row.omega_command) - omega;
        let sum: f64 = settled.iter().map(|row| change(row).norm_squared()).sum();
        Ok((sum / (4 * settled.len()) as f64).sqrt())
    }
}

/// L of what a law asked for while a sinusoid of an amplitude was added to it.
fn opened(linear: &LoopAt, amplitude: f64, schedule: &Schedule, asked: &[[f64; 3]]) -> Complex<f64> {
    let answer = schedule.amplitudes(asked.iter().copied());
    let returned: Complex<f64> = linear.weights.iter().zip(answer).map(|(weight, part)| weight * part).sum();
    -returned / (returned + linear.weights[0] * amplitude)
}

/// An attitude to hold: turned about one axis.
fn held(angle_rad: f64, axis: usize) -> AttitudeTarget {
    AttitudeTarget { attitude: turn(axis, angle_rad), rates: Vector3::zeros(), accelerations: Vector3::zeros() }
}

/// Standard deviation of the first number of each.
fn deviation(asked: &[[f64; 3]]) -> f64 {
    let count = asked.len().max(1) as f64;
    let mean = asked.iter().map(|a| a[0]).sum::<f64>() / count;
    (asked.iter().map(|a| (a[0] - mean) * (a[0] - mean)).sum::<f64>() / count).sqrt()
}
