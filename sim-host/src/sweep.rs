//! Robustness of a scenario: its disturbances' standard deviations are scaled up until it fails.

use anyhow::{Context, Result, ensure};
use serde::Serialize;

use crate::flight;
use crate::paper::claims::DISTURBANCE_REMOVED;
use crate::record::{Recorder, Row};
use crate::report::Metrics;
use crate::report::metrics::{Recovery, angle_errors, errors};
use crate::scenario::{Disturbance, Scenario};

/// A disturbance that a scenario without one can be given.
const ONE: &str = "disturbance={from_s=3,to_s=8,hold_s=0.01,acceleration_m_s2=2}";

/// A flight at one strength of the disturbance.
#[derive(Clone, Debug, Serialize)]
pub struct Strength {
    /// Factor on the scenario's standard deviations.
    pub factor: f64,
    /// Standard deviations as flown; the ones that the scenario does not use are 0.
    pub acceleration_m_s2: f64,
    /// On the angular accelerations, rad/s².
    pub angular_acceleration_rad_s2: f64,
    /// On the measured position, m.
    pub position_output_m: f64,
    /// On the measured angles, rad.
    pub angle_output_rad: f64,
    /// Time from the onset until each error stays in its band for good, s; null if it never does.
    pub recovery_s: Recovery,
    /// Greatest error of x, y, z while disturbed, m.
    pub position_max_m: f64,
    /// Greatest error of roll, pitch, yaw while disturbed, rad.
    pub angle_max_rad: f64,
    /// False if an axis took longer than the paper's 0.2 s, or the vehicle was lost.
    pub held: bool,
    /// Which took longer.
    pub late: Vec<&'static str>,
}

/// Greatest errors while the disturbance acts.
struct Extremes {
    acting: core::ops::Range<f64>,
    position: f64,
    angle: f64,
}

impl Recorder for Extremes {
    fn record(&mut self, row: &Row) {
        if self.acting.contains(&row.t) && !row.reference_is_held {
            let greatest = |errors: &[f64]| errors.iter().fold(0.0_f64, |most, error| most.max(error.abs()));
            self.position = self.position.max(greatest(&errors(row)[..3]));
            self.angle = self.angle.max(greatest(&angle_errors(row)));
        }
    }
}

/// Doubles the disturbance until the scenario fails, or 20 times, then halves the interval between the last that
/// was held and the first that was not, `refinements` times. In the order in which they were flown.
///
/// # Errors
/// The scenario has no disturbance, or is still on its way to its reference when it begins.
pub fn sweep(scenario: &Scenario, seed: u64, refinements: u32) -> Result<Vec<Strength>> {
    let base = scenario.file.disturbance.with_context(|| {
        format!(
            "scenario `{}` has no `[disturbance]` to scale: choose one that has, as paper-disturbed, or set one: --set \
             '{ONE}'",
            scenario.name
        )
    })?;
    let mut flown: Vec<Strength> = Vec::new();
    let (mut held, mut failed) = (0.0_f64, None);
    let mut factor = 1.0;
    while failed.is_none() && flown.len() < 20 {
        let strength = fly(scenario, &base, factor, seed)?;
        if strength.held {
            held = factor;
        } else {
            failed = Some(factor);
        }
        flown.push(strength);
        factor *= 2.0;
    }
    let Some(mut failed) = failed else { return Ok(flown) };
    for _ in 0..refinements {
        let middle = 0.5 * (held + failed);
        let strength = fly(scenario, &base, middle, seed)?;
        if strength.held {
            held = middle;
        } else {
            failed = middle;
        }
        flown.push(strength);
    }
    Ok(flown)
}

fn fly(scenario: &Scenario, base: &Disturbance, factor: f64, seed: u64) -> Result<Strength> {
    let disturbance = Disturbance {
        acceleration_m_s2: base.acceleration_m_s2 * factor,
        angular_acceleration_rad_s2: base.angular_acceleration_rad_s2 * factor,
        position_output_m: base.position_output_m * factor,
        angle_output_rad: base.angle_output_rad * factor,
        ..*base
    };
    let mut scenario = scenario.clone();
    scenario.file.disturbance = Some(disturbance);
    let mut recorder = (Metrics::new(), Extremes { acting: base.from_s..base.to_s, position: 0.0, angle: 0.0 });
    let outcome = flight::fly(&scenario, seed, &mut recorder)?;
    let (metrics, extremes) = recorder;
    let recovery = if outcome.survived() { metrics.recovery(base.from_s) } else { Recovery::default() };
    ensure!(
        recovery.away().is_empty(),
        "scenario `{}`: when its disturbance begins, {} is further off than 5 cm (2°) already: set `disturbance.from_s` to \
         more than {}, or gains that follow",
        scenario.name,
        recovery.away().join(", "),
        base.from_s
    );
    let late = recovery.later_than(DISTURBANCE_REMOVED.time_s);
    Ok(Strength {
        factor,
        acceleration_m_s2: disturbance.acceleration_m_s2,
        angular_acceleration_rad_s2: disturbance.angular_acceleration_rad_s2,
        position_output_m: disturbance.position_output_m,
        angle_output_rad: disturbance.angle_output_rad,
        held: late.is_empty(),
        late,
        recovery_s: recovery,
        position_max_m: extremes.position,
        angle_max_rad: extremes.angle,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sweep_brackets_the_failure() {
        // Fast: the lockstep plant, 1.5 s, 0.5 s of it disturbed.
        let settings = ["duration_s=3", "disturbance={from_s=2.0,to_s=2.5,hold_s=0.001,acceleration_m_s2=0.1}"];
        let scenario = Scenario::load("helix", &settings.map(String::from)).expect("valid");
        let flown = sweep(&scenario, 1, 3).expect("disturbed");
        let most_held = flown.iter().filter(|s| s.held).map(|s| s.factor).fold(0.0, f64::max);
        let least_failed = flown.iter().filter(|s| !s.held).map(|s| s.factor).fold(f64::INFINITY, f64::min);
        assert!(most_held < least_failed && least_failed.is_finite(), "{most_held} {least_failed}");
        assert!(least_failed - most_held <= least_failed / 8.0);
    }

    #[test]
    fn a_scenario_without_a_disturbance_is_refused() {
        let scenario = Scenario::load("helix", &[]).expect("valid");
        assert!(sweep(&scenario, 1, 0).is_err());
    }

    #[test]
    fn a_disturbance_that_begins_on_the_way_is_refused() {
        let settings = ["duration_s=3", "disturbance={from_s=0.3,to_s=2.5,hold_s=0.001,acceleration_m_s2=0.1}"];
        let scenario = Scenario::load("helix", &settings.map(String::from)).expect("valid");
        let error = sweep(&scenario, 1, 0).expect_err("x and y start metres away").to_string();
        assert!(error.contains("x, y") && error.contains("`disturbance.from_s`"), "{error}");
    }
}
