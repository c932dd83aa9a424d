//! The flights that the paper is judged by: its own cases, and what its gains do on a vehicle that has to tilt to move.

use anyhow::Result;
use firmware::control::sliding::AxisGains;
use firmware::guidance::Guidance;

use super::approach::Approach;
use crate::controller::{Control, Controller};
use crate::decoupled::STEP_S;
use crate::flight;
use crate::parallel;
use crate::record::Row;
use crate::report::metrics::{TRACKING_FROM_S, angle_errors, errors};
use crate::report::{Metrics, Settling, TruthWriter};
use crate::scenario::Scenario;
use crate::sil::Outcome;

/// Seed of every flight.
pub const SEED: u64 = 1;

/// Slow position gains, those of the scenario `helix`, in the layer of Table 1.
const THIN: [&str; 3] = [
    "control.x={lambda=4.0,gain=20.0,reaching={sat={rho=0.00099}}}",
    "control.y={lambda=4.0,gain=20.0,reaching={sat={rho=0.00099}}}",
    "control.z={lambda=4.0,gain=20.0,reaching={sat={rho=0.00099}}}",
];

/// The same in a layer as wide as K times 0.1 s.
const SLOW: [&str; 3] = [
    "control.x={lambda=4.0,gain=20.0,reaching={sat={rho=2.0}}}",
    "control.y={lambda=4.0,gain=20.0,reaching={sat={rho=2.0}}}",
    "control.z={lambda=4.0,gain=20.0,reaching={sat={rho=2.0}}}",
];

/// The same with roll, pitch and yaw in a layer wider than what a sample of 1 ms moves s by, K h = 0.22 rad/s.
const SIX: [&str; 6] = [
    SLOW[0],
    SLOW[1],
    SLOW[2],
    "control.roll.reaching={sat={rho=0.25}}",
    "control.pitch.reaching={sat={rho=0.25}}",
    "control.yaw.reaching={sat={rho=0.25}}",
];

/// Scenarios with what is set in them and what that is called, in the order of [`Flights`].
const FLOWN: [(&str, &[&str], &str); 10] = [
    ("paper-ideal", &[], ""),
    ("paper-attitude", &[], ""),
    ("paper-disturbed", &[], ""),
    ("paper-disturbed-output", &[], ""),
    ("paper-literal", &[], ""),
    ("paper-literal", &["thrust_to_weight=25"], ", thrust-to-weight 25"),
    ("paper-literal", &THIN, ", slow gains"),
    ("paper-literal", &SLOW, ", slow gains, three wide layers"),
    ("paper-literal", &SIX, ", slow gains, six wide layers"),
    ("helix", &[], ""),
];

/// A flight with all its rows.
#[derive(Clone, Debug)]
pub struct Flown {
    /// Scenario, and what was set in it.
    pub name: String,
    /// The same as `run` takes it with `--set`.
    pub settings: Vec<String>,
    /// What was flown.
    pub scenario: Scenario,
    /// How it ended.
    pub outcome: Outcome,
    /// A row per millisecond.
    pub rows: Vec<Row>,
    /// Figures of merit.
    pub metrics: Metrics,
    /// SHA-256 of what its truth.csv would be.
    pub truth_sha256: String,
}

/// Every flight.
#[derive(Clone, Debug)]
pub struct Flights {
    /// Table 1 on the decoupled model: Figures 2, 3, 7.
    pub ideal: Flown,
    /// Eq. 25–27 following stated angles: Figure 4.
    pub attitude: Flown,
    /// Gaussian accelerations: Figures 5, 6.
    pub disturbed: Flown,
    /// Gaussian errors on the outputs: the other reading of Figures 5, 6.
    pub disturbed_output: Flown,
    /// Table 1 on the coupled model, thrust-to-weight 2.
    pub literal: Flown,
    /// The same with the thrust that the ideal case takes.
    pub literal_strong: Flown,
    /// The same as `literal` with slow position gains.
    pub literal_thin: Flown,
    /// The same in a wide layer.
    pub literal_slow: Flown,
    /// The same with a wide layer for the attitude too.
    pub literal_wide: Flown,
    /// The helix on the rigid body, by gains of our own.
    pub helix: Flown,
}

impl Flights {
    /// Flies all, several at once; `done` is called after each.
    ///
    /// # Errors
    /// None with the built-in scenarios.
    pub fn fly(done: impl Fn() + Sync) -> Result<Self> {
        let fly = |(name, settings, what): &(&str, &[&str], &str)| Flown::new(name, settings, what).inspect(|_| done());
        let flown: Vec<Flown> = parallel::try_map(&FLOWN, fly)?;
        let flown = <[Flown; FLOWN.len()]>::try_from(flown);
        let [
            ideal,
            attitude,
            disturbed,
            disturbed_output,
            literal,
            literal_strong,
            literal_thin,
            literal_slow,
            literal_wide,
            helix,
        ] = flown.map_err(|flown| anyhow::anyhow!("{} flights in place of {}", flown.len(), FLOWN.len()))?;
        Ok(Self {
            ideal,
            attitude,
            disturbed,
            disturbed_output,
            literal,
            literal_strong,
            literal_thin,
            literal_slow,
            literal_wide,
            helix,
        })
    }

    /// How many there are.
    pub const COUNT: usize = FLOWN.len();

    /// Each of them, in the order of the fields.
    pub fn all(&self) -> [&Flown; FLOWN.len()] {
        [
            &self.ideal,
            &self.attitude,
            &self.disturbed,
            &self.disturbed_output,
            &self.literal,
            &self.literal_strong,
            &self.literal_thin,
            &self.literal_slow,
            &self.literal_wide,
            &self.helix,
        ]
    }
}

impl Flown {
    fn new(name: &str, settings: &[&str], what: &str) -> Result<Self> {
        let settings: Vec<String> = settings.iter().map(|setting| (*setting).to_owned()).collect();
        let scenario = Scenario::load(name, &settings)?;
        let mut recorder = ((Vec::new(), Metrics::new()), TruthWriter::hash_only());
        let outcome = flight::fly(&scenario, SEED, &mut recorder)?;
        let ((rows, metrics), truth) = recorder;
        let (name, truth_sha256) = (format!("{name}{what}"), truth.finish()?);
        Ok(Self { name, settings, scenario, outcome, rows, metrics, truth_sha256 })
    }

    /// The gains in use.
    ///
    /// # Panics
    /// Never: none of these flights has another controller.
    pub fn control(&self) -> &Control {
        match &self.scenario.controller {
            Controller::Smc(control) => control,
            other => unreachable!("`{}` flies by {}", self.name, other.name()),
        }
    }

    /// From when on x, y, z are within 5 cm, s; `None` for never.
    pub fn settled(&self) -> [Option<f64>; 3] {
        let axes = self.metrics.axes();
        [axes.x, axes.y, axes.z].map(|axis| axis.settle_5cm_s.filter(|_| self.outcome.survived()))
    }

    /// The mean of the three, s.
    pub fn mean_settled(&self) -> Option<f64> {
        self.settled().into_iter().try_fold(0.0, |sum, time| Some(sum + time? / 3.0))
    }

    /// From when on all three are, s.
    pub fn all_settled(&self) -> Option<f64> {
        self.settled().into_iter().try_fold(0.0_f64, |last, time| Some(last.max(time?)))
    }

    /// From when on an axis is within a fraction of its initial error, s.
    pub fn settled_to(&self, axis: usize, fraction: f64) -> Option<f64> {
        let initial = errors(self.rows.first()?)[axis].abs();
        let mut settling = Settling::new(fraction * initial);
        self.rows.iter().for_each(|row| settling.take(row.t, errors(row)[axis]));
        settling.since()
    }

    /// The greatest error of x, y and z after 4 s, m.
    pub fn greatest_error(&self) -> Option<f64> {
        let after = self.rows.iter().filter(|row| row.t >= TRACKING_FROM_S);
        after.map(position_error).reduce(f64::max)
    }

    /// The greatest torque demanded about an axis, N m.
    pub fn greatest_torque_n_m(&self) -> f64 {
        self.rows.iter().map(|row| greatest(&row.u[1..])).fold(0.0, f64::max)
    }

    /// The row at a time.
    pub fn at(&self, t: f64) -> Option<&Row> {
        self.rows.get(self.rows.partition_point(|row| row.t < t - 5e-4))
    }

    /// Error rate of an axis over time, m/s, by differences over one row.
    pub fn rates(&self, axis: usize) -> impl Iterator<Item = (f64, f64)> + '_ {
        let error = move |row: &Row| errors(row)[axis];
        self.rows.windows(2).map(move |pair| (pair[1].t, (error(&pair[1]) - error(&pair[0])) / (pair[1].t - pair[0].t)))
    }

    /// Greatest error of a position (m) and of an angle (rad) from a time on until another, s.
    pub fn greatest_errors_within(&self, (from, to): (f64, f64)) -> (f64, f64) {
        let within = || self.rows.iter().filter(|row| (from..to).contains(&row.t));
        let angle = |row: &Row| greatest(&angle_errors(row));
        (within().map(position_error).fold(0.0, f64::max), within().map(angle).fold(0.0, f64::max))
    }

    /// x, y and z by hand: what Table 1 makes of the start.
    ///
    /// # Errors
    /// None for a scenario that has flown.
    pub fn approaches(&self) -> Result<[Approach; 3]> {
        let reference = self.guidance()?.at(0);
        let start = self.scenario.file.start_position_m;
        let control = self.control();
        let axis = |gains: &AxisGains, i: usize| {
            Approach::new(gains, f64::from(reference.position[i]) - start[i], f64::from(reference.velocity[i]))
        };
        Ok([axis(&control.x, 0), axis(&control.y, 1), axis(&control.z, 2)])
    }

    /// What Eq. 28 and 31 ask for at the start: U1 in N, and Uy.
    ///
    /// # Errors
    /// As [`approaches`](Self::approaches).
    pub fn first_demand(&self) -> Result<(f64, f64)> {
        let acceleration = self.guidance()?.at(0).acceleration;
        let [_, y, z] = self.approaches()?;
        let demand = |axis: &Approach, feedforward: f32| {
            f64::from(feedforward) + axis.lambda * axis.rate + axis.gain * axis.surface().signum()
        };
        let constants = self.scenario.constants();
        let up = demand(&z, acceleration.z) + constants.gravity;
        Ok((constants.mass * up, demand(&y, acceleration.y) / up))
    }

    fn guidance(&self) -> Result<Guidance> {
        Guidance::with_tick(self.scenario.file.trajectory.clone(), STEP_S).map_err(|error| anyhow::anyhow!("{error}"))
    }
}

/// The greatest error of x, y and z, m.
fn position_error(row: &Row) -> f64 {
    greatest(&errors(row)[..3])
}

fn greatest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| value.abs().max(most))
}
