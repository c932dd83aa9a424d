//! What a flight is compared by: one number a figure of merit, taken row by row, without allocation.
//!
//! The error is the distance from the scenario's own trajectory. It counts from the end of the joining path, where
//! there is one, because only from there on the trajectory is what guidance flies; from the step, where there is one;
//! from the first tick otherwise.

use anyhow::Result;
use firmware::guidance::Trajectory;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use serde::Serialize;

use crate::flight;
use crate::record::{Recorder, Row};
use crate::report::measures::{Settling, Size, Variation};
use crate::report::metrics::{WIDE_BAND, errors};
use crate::scenario::Scenario;
use crate::sil::Outcome;

/// How a flight went. A lost flight has no figures besides `flown_s` and `saturated_fraction`: those of the part that
/// was flown would flatter it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Score {
    /// False if the vehicle was lost.
    pub survived: bool,
    /// Simulated time flown, s.
    pub flown_s: f64,
    /// Root mean square of the distance from the trajectory, m.
    pub rms_m: Option<f64>,
    /// Greatest distance from the trajectory, m.
    pub max_m: Option<f64>,
    /// From the start of what counts until the distance stays below 5 cm to the end, s; `None` if it does not.
    pub settle_s: Option<f64>,
    /// Greatest angle between the attitude and the desired one, rad.
    pub attitude_max_rad: Option<f64>,
    /// How far the vehicle sank below its trajectory at most, m.
    pub altitude_lost_m: Option<f64>,
    /// Root mean square of the length of the demanded torque, N m.
    pub torque_rms_n_m: Option<f64>,
    /// Mean of ω² over rotors and time, (rad/s)².
    pub omega_squared_mean_rad2_s2: Option<f64>,
    /// Total variation of the commanded ω², summed over the rotors, a second: (rad/s)²/s.
    pub chattering_rad2_s3: Option<f64>,
    /// Fraction of the ticks in which the mixer could not give the whole demand.
    pub saturated_fraction: f64,
}

/// Scores a flight.
#[derive(Clone, Debug)]
pub struct Scorer {
    from_s: f64,
    distance: Size,
    settling: Settling,
    attitude: Size,
    sunk: Size,
    torque: Size,
    omega: Size,
    chattering: Variation,
}

impl Scorer {
    /// Before the first row of a flight of `scenario`.
    pub fn new(scenario: &Scenario) -> Self {
        let from_s = counts_from_s(scenario);
        Self {
            from_s,
            distance: Size::default(),
            settling: Settling::new(WIDE_BAND),
            attitude: Size::default(),
            sunk: Size::default(),
            torque: Size::default(),
            omega: Size::default(),
            chattering: Variation::from(from_s),
        }
    }

    /// The score of the flight that ended so.
    pub fn score(&self, outcome: &Outcome) -> Score {
        let flown = Score {
            survived: outcome.survived,
            flown_s: f64::from(outcome.ticks) / 1e3,
            saturated_fraction: f64::from(outcome.saturated_ticks) / f64::from(outcome.ticks.max(1)),
            ..Score::default()
        };
        if !outcome.survived {
            return flown;
        }
        Score {
            rms_m: self.distance.rms(),
            max_m: self.distance.max(),
            settle_s: self.settling.after(self.from_s),
            attitude_max_rad: self.attitude.max(),
            altitude_lost_m: self.sunk.max(),
            torque_rms_n_m: self.torque.rms(),
            // The mean of ω² is the mean square of ω.
            omega_squared_mean_rad2_s2: self.omega.rms().map(|rms| rms * rms),
            chattering_rad2_s3: self.chattering.per_second(),
            ..flown
        }
    }
}

impl Recorder for Scorer {
    fn record(&mut self, row: &Row) {
        if row.t < self.from_s {
            return;
        }
        let [x, y, z, _] = errors(row);
        let distance = Vector3::new(x, y, z).norm();
        self.distance.take(distance);
        self.settling.take(row.t, distance);
        self.attitude.take(attitude_error(row));
        // Above the trajectory, z < 0, nothing is lost; a NaN stays one.
        self.sunk.take(if z < 0.0 { 0.0 } else { z });
        let [_, roll, pitch, yaw] = row.u;
        self.torque.take(Vector3::new(roll, pitch, yaw).norm());
        row.omega.iter().for_each(|omega| self.omega.take(*omega));
        self.chattering.take(row.t, row.omega_command);
    }
}

/// Flies a scenario under a seed, and scores it.
///
/// # Errors
/// What of the scenario the firmware refuses.
pub fn fly(scenario: &Scenario, seed: u64) -> Result<Score> {
    let mut scorer = Scorer::new(scenario);
    let outcome = flight::fly(scenario, seed, &mut scorer)?;
    Ok(scorer.score(&outcome))
}

/// From when on a flight of a scenario counts, s.
pub fn counts_from_s(scenario: &Scenario) -> f64 {
    let joined_s = scenario.file.join.as_ref().map_or(0.0, |join| f64::from(join.duration_s));
    match scenario.file.trajectory {
        Trajectory::Step { at_s, .. } => joined_s.max(f64::from(at_s)),
        _ => joined_s,
    }
}

/// The angle between the attitude and the desired one, rad.
fn attitude_error(row: &Row) -> f64 {
    let [w, x, y, z] = row.attitude;
    let flown = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
    let [roll, pitch, yaw] = row.desired_attitude;
    flown.angle_to(&UnitQuaternion::from_euler_angles(roll, pitch, yaw))
}
