//! The score of a flight: its figures of merit, computed row by row without allocation.
//!
//! The error is the distance from the scenario's own trajectory. It counts from the end of the joining path, if there
//! is one, because guidance follows the trajectory only from there; from the step, if there is one; otherwise from the
//! first tick. With a pilot it counts while the trajectory is flown, or, where the pilot asks for none, while the
//! vehicle holds a place or moves to one in the air: then it is the distance from where the commander wants it.

use anyhow::Result;
use firmware::guidance::Trajectory;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use serde::Serialize;

use crate::flight;
use crate::pilot::Order;
use crate::record::{Activity, Recorder, Row};
use crate::report::measures::{Settling, Size, Variation};
use crate::report::metrics::{WIDE_BAND, errors};
use crate::report::timeline::{controls_position, follows};
use crate::scenario::Scenario;
use crate::sil::Outcome;

/// The score of a flight. A lost flight has no figures besides `flown_s` and `saturated_fraction`: those of the time
/// before the loss would flatter it.
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
    /// Time from the start of the judged time until the distance stays below 5 cm, s; `None` if it does not.
    pub settle_s: Option<f64>,
    /// Greatest angle between the attitude and the desired one, rad.
    pub attitude_max_rad: Option<f64>,
    /// Greatest distance of the vehicle below its trajectory, m.
    pub altitude_lost_m: Option<f64>,
    /// Root mean square of the length of the demanded torque, N m.
    pub torque_rms_n_m: Option<f64>,
    /// Mean of ω² over rotors and time, (rad/s)².
    pub omega_squared_mean_rad2_s2: Option<f64>,
    /// Total variation of the commanded ω², summed over the rotors, per second: (rad/s)²/s.
    pub chattering_rad2_s3: Option<f64>,
    /// Fraction of the ticks in which the mixer could not give the whole demand.
    pub saturated_fraction: f64,
}

/// When a flight counts.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Counts {
    /// From a time on, s.
    From(f64),
    /// With a pilot who asks for it: while the trajectory is flown, once it has been joined for so long, s.
    Following(f64),
    /// With a pilot who does not: while a position is controlled.
    Flying,
}

impl Counts {
    fn of(scenario: &Scenario) -> Self {
        let script = &scenario.file.command;
        match () {
            () if script.is_empty() => Self::From(counts_from_s(scenario)),
            () if script.iter().any(|command| command.order == Order::Follow) => Self::Following(scenario.joined_s()),
            () => Self::Flying,
        }
    }
}

/// Scores a flight.
#[derive(Clone, Debug)]
pub struct Scorer {
    counts: Counts,
    /// Time of the first row that counted, s.
    began_s: Option<f64>,
    /// The newest row of a flight with a pilot, until it is known what the vehicle does.
    newest: Row,
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
        Self {
            counts: Counts::of(scenario),
            began_s: None,
            newest: Row::default(),
            distance: Size::default(),
            settling: Settling::new(WIDE_BAND),
            attitude: Size::default(),
            sunk: Size::default(),
            torque: Size::default(),
            omega: Size::default(),
            chattering: Variation::from(f64::NEG_INFINITY),
        }
    }

    /// Takes a row that counts.
    fn count(&mut self, row: &Row) {
        self.began_s.get_or_insert(row.t);
        if !row.reference_is_held {
            self.count_distance(row);
        }
        self.attitude.take(attitude_error(row));
        let [_, roll, pitch, yaw] = row.u;
        self.torque.take(Vector3::new(roll, pitch, yaw).norm());
        row.omega.iter().for_each(|omega| self.omega.take(*omega));
        self.chattering.take(row.t, row.omega_command);
    }

    /// The score of the finished flight.
    pub fn score(&self, outcome: &Outcome) -> Score {
        let flown = Score {
            survived: outcome.survived(),
            flown_s: f64::from(outcome.ticks) / 1e3,
            saturated_fraction: f64::from(outcome.saturated_ticks) / f64::from(outcome.ticks.max(1)),
            ..Score::default()
        };
        if !outcome.survived() {
            return flown;
        }
        Score {
            rms_m: self.distance.rms(),
            max_m: self.distance.max(),
            settle_s: self.began_s.and_then(|began| self.settling.after(began)),
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

impl Scorer {
    fn count_distance(&mut self, row: &Row) {
        let [x, y, z, _] = errors(row);
        let distance = Vector3::new(x, y, z).norm();
        self.distance.take(distance);
        self.settling.take(row.t, distance);
        // Above the trajectory, z < 0, no altitude is lost; NaN stays NaN.
        self.sunk.take(if z < 0.0 { 0.0 } else { z });
    }
}

impl Recorder for Scorer {
    fn record(&mut self, row: &Row) {
        match self.counts {
            Counts::From(from_s) if row.t < from_s => {}
            Counts::From(_) => self.count(row),
            Counts::Following(_) | Counts::Flying => self.newest = *row,
        }
    }

    fn observe(&mut self, activity: &Activity) {
        let is_counted = match self.counts {
            Counts::From(_) => false,
            Counts::Following(joined_s) => follows(activity, joined_s),
            Counts::Flying => controls_position(activity.commander),
        };
        if is_counted {
            let row = self.newest;
            self.count(&row);
        }
    }
}

/// Flies a scenario under a seed, and scores it.
///
/// # Errors
/// The firmware refuses the configuration: the first field that is out of range.
pub fn fly(scenario: &Scenario, seed: u64) -> Result<Score> {
    let mut scorer = Scorer::new(scenario);
    let outcome = flight::fly(scenario, seed, &mut scorer)?;
    Ok(scorer.score(&outcome))
}

/// Start of the judged time of a flight without a pilot, s; with one, it is known when the trajectory is flown.
pub fn counts_from_s(scenario: &Scenario) -> f64 {
    if !scenario.file.command.is_empty() {
        return 0.0;
    }
    match scenario.file.trajectory {
        Trajectory::Step { at_s, .. } => scenario.joined_s().max(f64::from(at_s)),
        _ => scenario.joined_s(),
    }
}

/// The angle between the attitude and the desired one, rad.
fn attitude_error(row: &Row) -> f64 {
    let [w, x, y, z] = row.attitude;
    let flown = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
    let [roll, pitch, yaw] = row.desired_attitude;
    flown.angle_to(&UnitQuaternion::from_euler_angles(roll, pitch, yaw))
}

#[cfg(test)]
mod tests {
    use firmware::commander::{CommanderOutput, Directive, Mode};

    use super::*;
    use crate::sil::End;

    /// The score of a flight of `scenario` for `seconds` whose row at t is `row(t)`.
    fn scored(scenario: &str, settings: &[&str], seconds: f64, row: impl Fn(f64) -> Row, survived: bool) -> Score {
        let settings: Vec<String> = settings.iter().map(|setting| (*setting).to_owned()).collect();
        let mut scorer = Scorer::new(&Scenario::load(scenario, &settings).expect("valid"));
        let ticks = (seconds * 1e3).round() as u32;
        for k in 0..ticks {
            scorer.record(&row(f64::from(k) / 1e3));
        }
        let end = if survived { End::DurationReached } else { End::LeftReference };
        scorer.score(&Outcome { ticks, saturated_ticks: ticks / 4, end, ..Outcome::default() })
    }

    fn level(t: f64) -> Row {
        Row { t, attitude: [1.0, 0.0, 0.0, 0.0], ..Row::default() }
    }

    fn on_the_ground() -> CommanderOutput {
        let scenario = Scenario::load("indoor-helix", &[]).expect("valid");
        firmware::autopilot::Autopilot::new(&scenario.flight_config()).expect("valid").inner.commander_output().clone()
    }

    fn assert_is(value: Option<f64>, expected: f64) {
        let value = value.expect("defined");
        assert!((value - expected).abs() <= 1e-9 * expected.abs().max(1.0), "{value} is not {expected}");
    }

    #[test]
    fn distances_are_lengths_in_space() {
        let score = scored("hover", &[], 2.0, |t| Row { position: [0.3, -0.4, 1.2], ..level(t) }, true);
        assert_is(score.rms_m, 1.3);
        assert_is(score.max_m, 1.3);
        assert_eq!(score.settle_s, None);
        assert_is(score.altitude_lost_m, 0.0);
        // 2 A sin has a mean square of 2 A² over whole periods.
        let wave = |t: f64| Row { position: [0.0, 0.0, -0.2 * libm::sin(core::f64::consts::TAU * t)], ..level(t) };
        let score = scored("hover", &[], 3.0, wave, true);
        assert_is(score.rms_m, 0.2 / 2.0_f64.sqrt());
        assert_is(score.altitude_lost_m, 0.2);
    }

    #[test]
    fn what_comes_before_the_trajectory_does_not_count() {
        let approach = |t: f64| Row { position: [if t < 4.5 { 0.2 } else { 0.01 }, 0.0, 0.0], ..level(t) };
        // Joined at 4 s: half a second of 20 cm, half a second of 1 cm.
        let score =
            scored("x500-hover", &["join={duration_s=4.0}", "trajectory.hold.position_m=[0,0,0]"], 5.0, approach, true);
        assert_is(score.rms_m, (0.5 * 0.04_f64 + 0.5 * 0.0001).sqrt());
        assert_is(score.settle_s, 0.5);
        // A step at 1 s counts from there.
        assert_eq!(counts_from_s(&Scenario::load("x500-step", &[]).expect("valid")), 1.0);
        assert_eq!(counts_from_s(&Scenario::load("x500-recovery", &[]).expect("valid")), 0.0);
    }

    #[test]
    fn a_flight_with_a_pilot_counts_while_its_trajectory_is_flown() {
        let mut scorer = Scorer::new(&Scenario::load("indoor-helix", &[]).expect("valid"));
        // 3 m off while it takes off and joins, which takes 4 s from 16 s on; then 1 cm.
        let on_the_ground = on_the_ground();
        for k in 0..30_000_u32 {
            let t = f64::from(k) / 1e3;
            let mode = if t < 10.0 { Mode::TakeOff } else { Mode::Follow };
            let directive = if t < 16.0 { Directive::Idle } else { Directive::Follow { since: 16_000 } };
            let commander = CommanderOutput { mode, directive, ..on_the_ground.clone() };
            scorer.record(&Row { position: [if t < 20.0 { 3.0 } else { 0.01 }, 0.0, 0.0], ..level(t) });
            scorer.observe(&Activity { t, commander: &commander, given: 3, battery: None });
        }
        let score = scorer.score(&Outcome { ticks: 30_000, end: End::DurationReached, ..Outcome::default() });
        assert_is(score.rms_m, 0.01);
        assert_is(score.max_m, 0.01);
        assert_is(score.settle_s, 0.0);
    }

    #[test]
    fn effort_and_chattering_have_their_closed_forms() {
        // ω² alternates between 100² and 110² on each rotor: 4 · 2100 a tick, 1000 ticks a second.
        let row = |t: f64| {
            let omega = if ((t * 1e3).round() as u32).is_multiple_of(2) { 100.0 } else { 110.0 };
            Row { omega: [omega; 4], omega_command: [omega; 4], u: [9.0, 0.3, 0.0, -0.4], ..level(t) }
        };
        let score = scored("hover", &[], 2.0, row, true);
        assert_is(score.chattering_rad2_s3, 8.4e6);
        assert_is(score.omega_squared_mean_rad2_s2, f64::midpoint(1e4, 1.21e4));
        assert_is(score.torque_rms_n_m, 0.5);
        assert_eq!(score.saturated_fraction, 0.25);
    }

    #[test]
    fn an_attitude_error_is_the_angle_of_one_rotation() {
        let row = |t: f64| Row { desired_attitude: [0.0, 0.4, 0.0], ..level(t) };
        assert_is(scored("hover", &[], 1.0, row, true).attitude_max_rad, 0.4);
        // Upside down is π away whichever way it got there.
        let row = |t: f64| Row { attitude: [0.0, 0.6, 0.8, 0.0], ..level(t) };
        assert_is(scored("hover", &[], 1.0, row, true).attitude_max_rad, core::f64::consts::PI);
    }

    #[test]
    fn a_lost_flight_has_no_figures() {
        let score = scored("hover", &[], 1.5, level, false);
        let expected = Score { flown_s: 1.5, saturated_fraction: 0.25, ..Score::default() };
        assert_eq!(score, expected);
    }

    #[test]
    fn a_nan_is_not_forgotten() {
        let row = |t: f64| Row { position: [if t == 0.5 { f64::NAN } else { 0.0 }, 0.0, 0.0], ..level(t) };
        let score = scored("hover", &[], 1.0, row, true);
        assert_eq!((score.rms_m, score.max_m), (None, None));
    }
}
