//! `sweep`: how much of its disturbance a scenario bears.

use anyhow::Result;

use super::Which;
use crate::paper::claims::DISTURBANCE_REMOVED;
use crate::refusal::figure;
use crate::sweep::{Strength, sweep};
use crate::words::significant;

/// Halvings of the interval in which the failure lies: to 3 % of the factor.
const REFINEMENTS: u32 = 5;

pub(super) fn run(which: &Which, seed: u64, as_json: bool) -> Result<()> {
    let scenario = which.load()?;
    let mut flown = sweep(&scenario, seed, REFINEMENTS)?;
    flown.sort_by(|a, b| a.factor.total_cmp(&b.factor));
    super::say(&if as_json { serde_json::to_string(&flown)? } else { table(&flown) })
}

/// A standard deviation to three digits, however small: a factor may be a thousandth.
fn sigma(value: f64) -> String {
    figure(significant(value, 3))
}

fn table(flown: &[Strength]) -> String {
    let mut lines = vec![format!(
        "{:>9}  {:>9}  {:>9}  {:>9}  {:>9}  {:>9}  {:>9}  {:>9}  end",
        "factor", "σ m/s²", "σ rad/s²", "σ m", "σ °", "slowest s", "max mm", "max °"
    )];
    for s in flown {
        let slowest = s.recovery_s.slowest().map_or("never".to_owned(), |time| format!("{time:.3}"));
        lines.push(format!(
            "{:>9.2}  {:>9}  {:>9}  {:>9}  {:>9}  {slowest:>9}  {:>9.3}  {:>9.3}  {}",
            s.factor,
            sigma(s.acceleration_m_s2),
            sigma(s.angular_acceleration_rad_s2),
            sigma(s.position_output_m),
            sigma(s.angle_output_rad.to_degrees()),
            1e3 * s.position_max_m,
            s.angle_max_rad.to_degrees(),
            if s.held { "held".to_owned() } else { format!("FAILED: {}", s.late.join(", ")) }
        ));
    }
    lines.push(format!(
        "factor and σ: of the disturbance; slowest: of all axes, the time from the onset to within 5 cm or 2° for good;\n\
         max: greatest errors of position, and of angles against those asked for, while it acts; held: slowest at most {} s, \
         the paper's claim",
        DISTURBANCE_REMOVED.time_s
    ));
    if !flown.iter().any(|strength| strength.held) {
        lines.push("failed at every strength: perhaps without a disturbance too, as `run` shows".to_owned());
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::metrics::Recovery;

    #[test]
    fn a_small_deviation_is_no_zero() {
        let strength = Strength {
            factor: 0.031_25,
            acceleration_m_s2: 0.004_876,
            angular_acceleration_rad_s2: 20.0 / 3.0,
            position_output_m: 0.0,
            angle_output_rad: 2e-6,
            recovery_s: Recovery::default(),
            position_max_m: 0.1,
            angle_max_rad: 0.0,
            held: false,
            late: vec!["x", "roll"],
        };
        let text = table(&[strength]);
        let row: Vec<&str> = text.lines().nth(1).expect("a row").split_whitespace().collect();
        assert_eq!(
            row,
            ["0.03", "0.00488", "6.67", "0", "1.15e-4", "never", "100.000", "0.000", "FAILED:", "x,", "roll"]
        );
    }
}
