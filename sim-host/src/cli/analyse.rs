//! `analyse`: margins, bandwidth and noise of a scenario's loops.

use std::path::Path;

use anyhow::Result;

use super::Which;
use crate::analyse::{Analysis, Loop, analyse};
use crate::report::{Staged, plots};
use crate::scenario::Scenario;

pub(super) fn run(which: &Which, seed: u64, out: Option<&Path>, as_json: bool) -> Result<()> {
    let scenario = which.load()?;
    if let Some(key) = untrimmed(&scenario) {
        super::complain(&format!(
            "note: with `{key}` the law trims itself in flight, and is analysed as it is before: margins, steps and noise do \
             not hold (docs/analysis.md)"
        ));
    }
    // Before the analysis, which takes a while.
    let staged = out.map(Staged::begin).transpose()?;
    let analysis = analyse(&scenario, seed)?;
    if let Some(staged) = &staged {
        let folder = staged.folder();
        folder.text("analyse.json", &(serde_json::to_string(&analysis)? + "\n"))?;
        plots::analysis::draw(folder.path(), &analysis)?;
    }
    let contents = staged.map(Staged::finish).transpose()?;
    if as_json {
        return super::say(&serde_json::to_string(&analysis)?);
    }
    super::say(&super::and_wrote(table(&analysis), out, contents))
}

/// What of the truth makes the vehicle's first seconds a transient: another thrust, or another weight, than the law believes.
fn untrimmed(scenario: &Scenario) -> Option<&'static str> {
    let truth = &scenario.file.truth;
    if truth.mass_factor != 1.0 {
        return Some("truth.mass_factor");
    }
    truth.rotor_effectiveness.iter().any(|factor| *factor != 1.0).then_some("truth.rotor_effectiveness")
}

fn table(analysis: &Analysis) -> String {
    let mut lines = vec![format!("{}, {}: about hover", analysis.scenario, analysis.controller), String::new()];
    lines.push(format!(
        "{:<5}  {:>9}  {:>9}  {:>9}  {:>8}  {:>8}  {:>5}  {:>15}  margins in the simulation",
        "loop", "ωc rad/s", "gain up", "gain down", "phase °", "delay ms", "Ms", "L simulated"
    ));
    lines.extend(analysis.loops.iter().map(loop_line));
    lines.extend(analysis.loops.iter().filter_map(left_out));
    lines.push(String::new());
    lines.push(format!("{:<5}  {:>15}  {:>9}  {:>9}", "angle", "bandwidth rad/s", "rise ms", "overshoot"));
    lines.extend(analysis.attitude.iter().map(|axis| {
        let rise = number(axis.rise_s.map(|t| 1e3 * t), 0);
        format!(
            "{:<5}  {:>15}  {rise:>9}  {:>7.1} %",
            axis.name,
            number(axis.bandwidth_rad_s, 1),
            100.0 * axis.overshoot
        )
    }));
    let noise = &analysis.noise;
    lines.push(String::new());
    lines.push(format!(
        "noise of 1 mrad/s a sample on the rates: rotors' commands {:.2} rad/s RMS ({:.2} in the simulation)",
        1e-3 * noise.per_sample,
        1e-3 * noise.per_sample_simulated
    ));
    lines.push(format!(
        "noise of 0.1 mrad/s/√Hz:                 rotors' commands {:.2} rad/s RMS",
        1e-4 * noise.per_density
    ));
    lines.join("\n")
}

fn loop_line(one: &Loop) -> String {
    let m = &one.margins;
    let gain_error = one.checks.iter().fold(0.0_f64, |most, c| most.max(c.gain_error.abs()));
    let phase_error = one.checks.iter().fold(0.0_f64, |most, c| most.max(c.phase_error_deg.abs()));
    let within = format!("{:.1} %, {phase_error:.1}°", 100.0 * gain_error);
    let within = if one.checks.is_empty() { number(None, 0) } else { within };
    let confirmed = one.margin_checks.iter().filter(|c| c.stable == c.expected_stable).count();
    let end = if one.stable { format!("{confirmed} of {} hold", one.margin_checks.len()) } else { "UNSTABLE".into() };
    format!(
        "{:<5}  {:>9}  {:>9}  {:>9}  {:>8}  {:>8}  {:>5.2}  {within:>15}  {end}",
        one.name,
        number(m.crossover_rad_s, 2),
        number(m.gain_upper.map(|g| g.factor), 2),
        number(m.gain_lower.map(|g| g.factor), 3),
        number(m.phase_deg, 1),
        number(m.delay_s.map(|t| 1e3 * t), 2),
        m.sensitivity_peak,
    )
}

/// At which frequencies L was not measured.
fn left_out(one: &Loop) -> Option<String> {
    let frequencies: Vec<String> = one.unsettled_rad_s.iter().map(|omega| format!("{omega:.0}")).collect();
    let name = one.name;
    (!frequencies.is_empty()).then(|| {
        let list = frequencies.join(", ");
        format!("{name}: L simulated leaves out {list} rad/s, where it had not settled")
    })
}

fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or("-".to_owned(), |v| format!("{v:.digits$}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyse::Margins;

    #[test]
    fn what_has_not_settled_is_left_out_and_said() {
        let margins = Margins::default();
        let unsettled_rad_s = vec![110.2, 220.4];
        let one = Loop {
            name: "roll",
            stable: true,
            margins,
            checks: vec![],
            unsettled_rad_s,
            margin_checks: vec![],
            response: vec![],
        };
        let line = loop_line(&one);
        assert!(line.ends_with("  -  0 of 0 hold"), "{line}");
        let expected = "roll: L simulated leaves out 110, 220 rad/s, where it had not settled";
        assert_eq!(left_out(&one).as_deref(), Some(expected));
        assert_eq!(left_out(&Loop { unsettled_rad_s: vec![], ..one }), None);
    }
}
