//! The paper's simulations, flown and held against what the paper says of them.
//!
//! ```text
//! claims ───────────────────────────┐
//! scenarios ─► flights ─► Flights ──┼─► undisturbed, disturbed, coupled ─► Line ─► Study ─► report::paper
//!                            │      │                                       ▲
//!                            │   approach: the same in closed form ─────────┘
//!                            └─► report::plots::paper: Figures 2 to 7
//! ```
//!
//! Each [`Line`] of the table is a claim, what was flown, the difference, and why there is one. The numbers in it are
//! those of the flights and of the equations; none is written down here but the paper's own ([`claims`]).

pub mod approach;
pub mod claims;
mod coupled;
mod disturbed;
pub mod errata;
pub mod flights;
mod undisturbed;

use anyhow::Result;
use firmware::control::sliding::{AxisGains, ReachingLaw};
use serde::Serialize;

use crate::airframe::AirframeFile;
use crate::sweep::{Strength, sweep};
use errata::{ERRATA, Erratum};
use flights::{Flights, Flown, SEED};

/// Halvings of the interval in which a sweep's failure lies: to 3 % of the disturbance.
const REFINEMENTS: u32 = 5;

/// A line of the table.
#[derive(Clone, Debug, Serialize)]
pub struct Line {
    /// What the paper says.
    pub claim: String,
    /// Section, figure, equation.
    pub place: String,
    /// The scenario flown, and what was set in it.
    pub flight: String,
    /// What is compared.
    pub measure: String,
    /// Unit of the three numbers.
    pub unit: &'static str,
    /// The paper's; null where its text gives none.
    pub paper: Option<f64>,
    /// That of the flight; null for never.
    pub here: Option<f64>,
    /// here − paper.
    pub difference: Option<f64>,
    /// Why they differ, or agree.
    pub why: String,
}

impl Line {
    /// A comparison in a unit.
    fn new(claim: &str, place: &str, flown: &Flown, measure: &str, unit: &'static str) -> Self {
        let [claim, place, flight, measure] = [claim, place, &flown.name, measure].map(str::to_owned);
        Self { claim, place, flight, measure, unit, paper: None, here: None, difference: None, why: String::new() }
    }

    /// With the two numbers, and why they differ.
    fn with(self, paper: Option<f64>, here: Option<f64>, why: String) -> Self {
        let difference = paper.zip(here).map(|(paper, here)| here - paper);
        Self { paper, here, difference, why, ..self }
    }
}

/// Table 1: the gains of an axis.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct TableOne {
    /// The axis.
    pub axis: &'static str,
    /// K, rad/s² or m/s².
    pub gain: f32,
    /// λ, 1/s.
    pub lambda: f32,
    /// ρ, rad/s or m/s; null for another reaching law than the paper's.
    pub rho: Option<f32>,
}

impl TableOne {
    fn new(axis: &'static str, gains: &AxisGains) -> Self {
        let rho = match gains.reaching {
            ReachingLaw::Sat { rho } => Some(rho),
            _ => None,
        };
        Self { axis, gain: gains.gain, lambda: gains.lambda, rho }
    }
}

/// A flight by its fingerprint.
#[derive(Clone, Debug, Serialize)]
pub struct Fingerprint {
    /// Scenario, and what was set in it.
    pub flight: String,
    /// What `run` takes with `--set` for the same flight.
    pub settings: Vec<String>,
    /// SHA-256 of its truth.csv, as `run` has it.
    pub truth_sha256: String,
}

/// Everything that the paper was judged by.
#[derive(Clone, Debug, Serialize)]
pub struct Study {
    /// Title of the paper.
    pub title: &'static str,
    /// The table.
    pub claims: Vec<Line>,
    /// What could not be flown as printed.
    pub errata: [Erratum; 7],
    /// Table 1 as flown.
    pub table_1: [TableOne; 6],
    /// Table 2 as flown.
    pub table_2: AirframeFile,
    /// The flights.
    pub flights: Vec<Fingerprint>,
}

/// The paper's title.
pub const TITLE: &str = "Trajectory Tracking Control of Quadrotor Unmanned Aerial Vehicle Using Sliding Mode \
Controller with the Presence of Gaussian Disturbance";

/// How much of each disturbance can be borne: on the accelerations, and on the outputs.
#[derive(Clone, Debug)]
pub struct Sweeps {
    accelerations: Vec<Strength>,
    outputs: Vec<Strength>,
}

impl Sweeps {
    /// Flies both, at once; `done` is called after each.
    ///
    /// # Errors
    /// None with the built-in scenarios.
    pub fn fly(flights: &Flights, done: impl Fn() + Sync) -> Result<Self> {
        let of = |flown: &Flown| sweep(&flown.scenario, SEED, REFINEMENTS).inspect(|_| done());
        let (accelerations, outputs) = rayon::join(|| of(&flights.disturbed), || of(&flights.disturbed_output));
        Ok(Self { accelerations: accelerations?, outputs: outputs? })
    }
}

impl Study {
    /// Holds flights against the claims.
    ///
    /// # Errors
    /// None with the built-in scenarios.
    pub fn new(flights: &Flights, sweeps: &Sweeps) -> Result<Self> {
        let mut claims = undisturbed::lines(flights)?;
        claims.extend(disturbed::lines(flights, sweeps));
        claims.extend(coupled::lines(flights));
        let control = flights.ideal.control();
        let axes = [
            ("roll", &control.roll),
            ("pitch", &control.pitch),
            ("yaw", &control.yaw),
            ("x", &control.x),
            ("y", &control.y),
            ("z", &control.z),
        ];
        let fingerprint = |flown: &Flown| Fingerprint {
            flight: flown.name.clone(),
            settings: flown.settings.clone(),
            truth_sha256: flown.truth_sha256.clone(),
        };
        Ok(Self {
            title: TITLE,
            claims,
            errata: ERRATA,
            table_1: axes.map(|(axis, gains)| TableOne::new(axis, gains)),
            table_2: flights.ideal.scenario.airframe.clone(),
            flights: flights.all().into_iter().map(fingerprint).collect(),
        })
    }
}
