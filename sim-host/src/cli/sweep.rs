//! `sweep`: how much of its disturbance a scenario bears.

use anyhow::Result;

use super::Which;
use crate::paper::claims::DISTURBANCE_REMOVED;
use crate::sweep::{Strength, sweep};

/// Halvings of the interval in which the failure lies: to 3 % of the factor.
const REFINEMENTS: u32 = 5;

pub(super) fn run(which: &Which, seed: u64, as_json: bool) -> Result<()> {
    let scenario = which.load()?;
    let mut flown = sweep(&scenario, seed, REFINEMENTS)?;
    flown.sort_by(|a, b| a.factor.total_cmp(&b.factor));
    super::say(&if as_json { serde_json::to_string(&flown)? } else { table(&flown) })
}

fn table(flown: &[Strength]) -> String {
    let mut lines = vec![format!(
        "{:>9}  {:>9}  {:>9}  {:>9}  {:>9}  {:>9}  {:>9}  {:>9}  end",
        "factor", "σ m/s²", "σ rad/s²", "σ m", "σ °", "slowest s", "max mm", "max °"
    )];
    for s in flown {
        let slowest = s.recovery_s.as_array().iter().try_fold(0.0_f64, |most, time| Some(most.max((*time)?)));
        let slowest = slowest.map_or("never".to_owned(), |time| format!("{time:.3}"));
        lines.push(format!(
            "{:>9.2}  {:>9.1}  {:>9.1}  {:>9.3}  {:>9.2}  {slowest:>9}  {:>9.3}  {:>9.3}  {}",
            s.factor,
            s.acceleration_m_s2,
            s.angular_acceleration_rad_s2,
            s.position_output_m,
            s.angle_output_rad.to_degrees(),
            1e3 * s.position_max_m,
            s.angle_max_rad.to_degrees(),
            if s.held { "held" } else { "FAILED" }
        ));
    }
    lines.push(format!(
        "factor and σ: of the disturbance; slowest: of all axes, the time from the onset to within 5 cm or 2° for good;\n\
         max: greatest errors of position and angles while it acts; held: slowest at most {} s, the paper's claim",
        DISTURBANCE_REMOVED.time_s
    ));
    if !flown.iter().any(|strength| strength.held) {
        lines.push("failed at every strength: perhaps without a disturbance too, as `run` shows".to_owned());
    }
    lines.join("\n")
}
