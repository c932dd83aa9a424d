//! Which figures a flight gets, and what they need of it.

use std::path::{Path, PathBuf};

use anyhow::Result;
use firmware::config::Start;
use firmware::control::sliding::{AxisGains, Surface};
use firmware::guidance::Trajectory;

use super::backdrop::Backdrop;
use super::inputs::Inputs;
use super::{disturbance, estimate, inputs, path, phases, rotors, tracking};
use crate::controller::Controller;
use crate::noise::Noise;
use crate::pilot::{Command, Order};
use crate::record::Row;
use crate::report::estimate::Belief;
use crate::report::timeline::{Course, Leg};
use crate::scenario::Scenario;

/// How a vehicle flew, hence what is worth drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Along a trajectory from beginning to end: errors settle, and their phase portraits mean something.
    Tracking,
    /// Its attitude alone: nothing moves.
    Attitude,
    /// By a pilot: in phases, to places.
    Piloted,
}

/// A disturbance as it was applied.
#[derive(Clone, Debug)]
pub struct Disturbance {
    /// Time (s) and x, y, z, roll, pitch, yaw in the units below.
    pub samples: Vec<(f64, [f64; 6])>,
    /// Whether it acts on accelerations (m/s², rad/s²) or on what sensors give out (m, rad).
    pub on_accelerations: bool,
    /// From when to when it acts, s.
    pub acting: (f64, f64),
}

/// What is shown of a vehicle that stands still after a flight, s.
const AFTERWARDS_S: f64 = 5.0;

/// Everything that a flight's figures need.
#[derive(Clone, Debug)]
pub struct Figures<'a> {
    /// Scenario and seed, for the headings.
    pub of: String,
    /// How it flew.
    pub kind: Kind,
    /// The flight.
    pub rows: &'a [Row],
    /// What a vehicle on sensors believed; empty on ideal state.
    pub beliefs: &'a [Belief],
    /// The disturbance, where there is one; without, its two figures are left out.
    pub disturbance: Option<Disturbance>,
    /// Where the pilot sent it, m; none in place of what the vehicle refused.
    pub places: Vec<Option<[f64; 3]>>,
    /// Phases, faults and events.
    pub(super) backdrop: Backdrop,
    /// Gains of x, y and z, where the phase portraits end on their surfaces.
    pub(super) surfaces: Option<[AxisGains; 3]>,
    /// The inputs of the decoupled model, where it is flown.
    pub(super) inputs: Option<Inputs>,
}

impl<'a> Figures<'a> {
    /// Of a scenario flown under `seed`.
    pub fn new(scenario: &Scenario, seed: u64, rows: &'a [Row], beliefs: &'a [Belief], course: &Course) -> Self {
        let file = &scenario.file;
        let kind = match () {
            () if !file.command.is_empty() || file.start == Start::OnGround => Kind::Piloted,
            () if file.attitude.is_some() && matches!(file.trajectory, Trajectory::Hold { .. }) => Kind::Attitude,
            () => Kind::Tracking,
        };
        let backdrop = if kind == Kind::Piloted {
            phases::backdrop(scenario, rows, &course.timeline)
        } else {
            Backdrop::default()
        };
        let end = backdrop.end() + AFTERWARDS_S;
        Self {
            of: format!("{}, seed {seed}", scenario.name),
            kind,
            rows: &rows[..rows.partition_point(|row| row.t <= end)],
            beliefs: &beliefs[..beliefs.partition_point(|belief| belief.t <= end)],
            disturbance: applied(scenario, seed),
            places: places(&file.command, &course.legs),
            backdrop,
            surfaces: surfaces(scenario),
            inputs: Inputs::of(scenario),
        }
    }

    /// The same with the settings of the command line in the headings, as far as there is room.
    #[must_use]
    pub fn with_settings(mut self, settings: &[String]) -> Self {
        /// Characters.
        const ROOM: usize = 80;
        let mut room = ROOM;
        let fits = |setting: &&String| {
            let is_room = setting.chars().count() + 2 <= room;
            room = room.saturating_sub(setting.chars().count() + 2);
            is_room
        };
        let shown: Vec<&str> = settings.iter().take_while(fits).map(String::as_str).collect();
        let more = match settings.len() - shown.len() {
            0 => None,
            rest if shown.is_empty() => Some(crate::words::counted(rest, "setting")),
            rest => Some(format!("{rest} more")),
        };
        let said: Vec<&str> = shown.into_iter().chain(more.as_deref()).collect();
        if !said.is_empty() {
            self.of = format!("{}, with {}", self.of, said.join(", "));
        }
        self
    }

    /// Draws every figure that applies into `folder`. Returns the files written.
    ///
    /// # Errors
    /// When a file cannot be written; the message names it.
    pub fn draw(&self, folder: &Path) -> Result<Vec<PathBuf>> {
        let mut files = Vec::new();
        if self.kind == Kind::Piloted {
            files.push(phases::flight(folder, self)?);
        }
        if self.kind != Kind::Attitude {
            files.push(tracking::position(folder, self)?);
        }
        files.push(tracking::attitude(folder, self)?);
        // The paper's decoupled equations have no rotors.
        if let Some(of) = &self.inputs {
            files.push(inputs::inputs(folder, self, of)?);
            inputs::table(folder, self, of)?;
        } else if self.rows.is_empty() || rotors::turn(self.rows) {
            files.push(rotors::rotors(folder, self)?);
        }
        if self.kind == Kind::Tracking && tracking::errs(self.rows).next().is_some() {
            files.push(tracking::portraits(folder, self)?);
        }
        if path::moves(self.rows) && self.backdrop.has_flown() {
            files.push(path::path(folder, self)?);
        }
        if let Some(applied) = &self.disturbance {
            files.push(disturbance::disturbance(folder, self, applied)?);
            files.push(disturbance::disturbed(folder, self, applied.acting)?);
        }
        if !self.beliefs.is_empty() {
            files.extend(estimate::draw(folder, self)?);
        }
        Ok(files)
    }

    /// A figure's heading: what it shows, and of which flight.
    pub(super) fn heading(&self, title: &str) -> String {
        format!("{title}\n{}", self.of)
    }

    /// From when to when it flew, s: what all panels over time show.
    pub(super) fn span(&self) -> Option<(f64, f64)> {
        let (first, last) = (self.rows.first()?.t, self.rows.last()?.t);
        // The row after the last would have been at the end of the flight.
        let end = (last * 1e3 + 1.0).round() / 1e3;
        (last > first).then_some((first, if end.fract() == 0.0 { end } else { last }))
    }
}

/// Gains of x, y and z whose linear surfaces are those of the errors that are drawn: where a joining path is followed,
/// the law's errors are others.
fn surfaces(scenario: &Scenario) -> Option<[AxisGains; 3]> {
    let Controller::Smc(control) = &scenario.controller else { return None };
    let gains = [control.x, control.y, control.z];
    let are_drawn = scenario.file.join.is_none() && gains.iter().all(|gains| gains.surface == Surface::Linear);
    are_drawn.then_some(gains)
}

/// Where a script leads to, and nothing in place of what was refused, so that places keep the numbers of their phases.
fn places(script: &[Command], legs: &[Leg]) -> Vec<Option<[f64; 3]>> {
    let refused = |i: usize| legs.get(i).is_some_and(|leg| leg.refused.is_some());
    let place = |(i, command): (usize, &Command)| match command.order {
        Order::GoTo { position_m, .. } => Some((!refused(i)).then(|| position_m.map(f64::from))),
        _ => None,
    };
    script.iter().enumerate().filter_map(place).collect()
}

/// The disturbances of a scenario as they were applied, a sample each tick: on the accelerations, or, where there are
/// none, on the outputs.
pub(super) fn applied(scenario: &Scenario, seed: u64) -> Option<Disturbance> {
    let d = scenario.file.disturbance?;
    let mut noise = Noise::new(Some(&d), seed, 1000.0);
    let sample = |tick: u32| {
        let now = noise.at(tick);
        let (a, b) = if d.is_on_accelerations() {
            (now.push.acceleration, now.push.angular_acceleration)
        } else {
            (now.position, now.angles)
        };
        (f64::from(tick) * 1e-3, [a.x, a.y, a.z, b.x, b.y, b.z])
    };
    let samples = (0..scenario.ticks()).map(sample).collect();
    Some(Disturbance { samples, on_accelerations: d.is_on_accelerations(), acting: (d.from_s, d.to_s) })
}
