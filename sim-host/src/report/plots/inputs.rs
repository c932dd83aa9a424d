//! The control inputs of the decoupled model, which is given U1 to U4 directly and without limits.
//!
//! On the surface a switching law changes an input every 10 µs, between its mean + m K and − m K (or I K). What is drawn
//! is the mean over the millisecond from one row to the next, as the motion tells it, in the band within which it
//! switches: single values taken every millisecond would show one side of the switching alone.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use anyhow::Result;
use firmware::control::sliding::{AxisGains, ReachingLaw};

use super::axis::{Quantity, Unit};
use super::flight::{Disturbance, Figures};
use super::page::{grid, save, size_of};
use super::panel::{ANGLES, Panel};
use super::series::{Points, thin_series};
use super::style::{Key, Role, palette};
use crate::angles::roll_pitch_yaw;
use crate::controller::{Control, Controller};
use crate::decoupled::STEP_S;
use crate::plant::Constants;
use crate::record::Row;
use crate::report::out::write_file;
use crate::scenario::{PlantKind, Scenario};

/// What is shown of the approach, s.
pub(super) const APPROACH_S: f64 = 1.0;
/// The legend of the band.
pub(super) const SWITCHES: Key = Key::Series("switches within", palette::BAND);
/// Height of a panel.
const PANEL: u32 = 235;

/// What U1 to U4 are told by.
#[derive(Clone, Debug)]
pub(super) struct Inputs {
    constants: Constants,
    /// Of z, roll, pitch and yaw.
    gains: [AxisGains; 4],
}

/// From when on a control input switches, and by how much around its mean.
struct Sliding {
    from_s: f64,
    swing: f64,
}

impl Inputs {
    /// Of a scenario on the decoupled model, and the gains that fly it.
    pub(super) fn new(scenario: &Scenario, control: &Control) -> Self {
        let gains = [control.z, control.roll, control.pitch, control.yaw];
        Self { constants: scenario.constants(), gains }
    }

    /// Of a scenario, if it is flown on the decoupled model.
    pub(super) fn of(scenario: &Scenario) -> Option<Self> {
        match &scenario.controller {
            Controller::Smc(control) if scenario.file.plant == PlantKind::PaperDecoupled => {
                Some(Self::new(scenario, control))
            }
            _ => None,
        }
    }

    /// The mean of an input: U1 (N) by index 0, U2 to U4 (N m) by 1 to 3.
    pub(super) fn mean(&self, rows: &[Row], input: usize, disturbance: Option<&Disturbance>) -> Points {
        match input.checked_sub(1) {
            None => self.thrust(rows, disturbance),
            Some(axis) => self.torque(rows, axis, disturbance),
        }
    }

    /// A panel of an input's mean, with the band within which it switches.
    pub(super) fn panel(&self, title: &str, rows: &[Row], input: usize, mean: Points) -> Panel {
        let unit = if input == 0 { Unit::Newton } else { Unit::NewtonMetre };
        let band = self.sliding(rows, input).map(|sliding| {
            let edge = |by: f64| mean.iter().filter(|(t, _)| *t > sliding.from_s).map(|(t, u)| (*t, u + by)).collect();
            (edge(-sliding.swing), edge(sliding.swing))
        });
        let up = Quantity::new(format!("U{}", input + 1), unit);
        Panel { band, ..Panel::over_time(title, up, vec![(Role::Flown, mean)]) }
    }

    /// Of a law that switches.
    fn sliding(&self, rows: &[Row], input: usize) -> Option<Sliding> {
        let gains = &self.gains[input];
        let gain = f64::from(gains.gain);
        // In a step, s moves by K h: through a thinner layer than that it switches as sgn does.
        let switches = match gains.reaching {
            ReachingLaw::Sgn => true,
            ReachingLaw::Sat { rho } => f64::from(rho) < 0.5 * gain * STEP_S,
            _ => false,
        };
        // U1 is of sz, the last of six; U2 to U4 are of the first three.
        let (variable, inertia) = match input.checked_sub(1) {
            None => (5, self.constants.mass),
            Some(axis) => (axis, self.constants.inertia[axis]),
        };
        let swing = inertia * gain;
        let reached = rows.iter().position(|row| row.s[variable].abs() <= gain * STEP_S)?;
        // An axis that is at rest where s is 0 does not switch at all.
        let does = rows[reached..].iter().any(|row| row.u[input].abs() > 0.5 * swing);
        (switches && does).then_some(Sliding { from_s: rows[reached].t, swing })
    }

    /// m (z̈ + g − d) + k3 ż, with d the disturbance.
    fn thrust(&self, rows: &[Row], disturbance: Option<&Disturbance>) -> Points {
        let Constants { mass, gravity, drag, .. } = &self.constants;
        let mean = |pair: &[Row]| {
            let acceleration = (pair[1].velocity[2] - pair[0].velocity[2]) / (pair[1].t - pair[0].t);
            let disturbed = pushed(disturbance, pair[0].t, 2);
            mass * (acceleration - disturbed + gravity) + drag.z * pair[0].velocity[2]
        };
        rows.windows(2).map(|pair| (pair[0].t, mean(pair))).collect()
    }

    /// Eq. 2 for U2, U3 or U4, with Ωr = 0.
    fn torque(&self, rows: &[Row], axis: usize, disturbance: Option<&Disturbance>) -> Points {
        let Constants { inertia, rotational_drag: drag, .. } = &self.constants;
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        let torque = |rows: &[Row]| {
            let [before, now, after] = [0, 1, 2].map(|i| roll_pitch_yaw(rows[i].attitude));
            let h = rows[1].t - rows[0].t;
            let rate = |i: usize| (after[i] - before[i]) / (2.0 * h);
            let acceleration = (after[axis] - 2.0 * now[axis] + before[axis]) / (h * h);
            let disturbed = [0, 1].map(|i| pushed(disturbance, rows[i].t, axis + 3)).iter().sum::<f64>() / 2.0;
            let gyroscopic = (inertia[next] - inertia[last]) * rate(next) * rate(last);
            let drag = drag[axis] * rate(axis) * rate(axis).abs();
            (rows[1].t, inertia[axis] * (acceleration - disturbed) + drag - gyroscopic)
        };
        rows.windows(3).map(torque).collect()
    }
}

/// What a disturbance of the accelerations adds from a time on until the next row.
fn pushed(disturbance: Option<&Disturbance>, t: f64, axis: usize) -> f64 {
    let samples = disturbance.filter(|applied| applied.on_accelerations).map(|applied| &applied.samples);
    let tick = (t * 1e3).round() as usize;
    samples.and_then(|samples| samples.get(tick)).map_or(0.0, |(_, sample)| sample[axis])
}

/// U1 to U4: the approach, and the whole flight. Returns the file written.
///
/// # Errors
/// When the file cannot be written; the message names it.
pub(super) fn inputs(folder: &Path, figures: &Figures, inputs: &Inputs) -> Result<PathBuf> {
    let approach = &figures.rows[..figures.rows.partition_point(|row| row.t <= APPROACH_S)];
    let disturbance = figures.disturbance.as_ref();
    let pair = |input: usize| {
        let name = if input == 0 { "thrust".to_owned() } else { format!("{} torque", ANGLES[input - 1]) };
        let first = inputs.panel(
            &format!("{name}: the first second"),
            approach,
            input,
            inputs.mean(approach, input, disturbance),
        );
        let mean = thin_series(inputs.mean(figures.rows, input, disturbance));
        let whole = Panel { band: None, ..inputs.panel(&format!("{name}: mean of 1 ms"), &[], input, mean) };
        let shaded = disturbance.map(|applied| applied.acting);
        [first, Panel { span: figures.span(), shaded, ..whole }]
    };
    let panels: Vec<Panel> = (0..4).flat_map(pair).collect();
    let path = folder.join("inputs.svg");
    let acting = disturbance.map(|_| Key::Disturbed);
    let switches = panels.iter().any(|panel| panel.band.is_some()).then_some(SWITCHES);
    let legend: Vec<Key> = [switches, acting].into_iter().flatten().collect();
    save(&path, size_of(4, PANEL), &figures.heading("Control inputs: means"), &legend, |area| grid(area, 2, &panels))?;
    Ok(path)
}

/// Writes the means of U1 to U4 beside their figure: truth.csv has one side of the switching alone.
///
/// # Errors
/// When the file cannot be written; the message names it.
pub(super) fn table(folder: &Path, figures: &Figures, inputs: &Inputs) -> Result<()> {
    let disturbance = figures.disturbance.as_ref();
    let [thrust, torques @ ..] = [0, 1, 2, 3].map(|input| inputs.mean(figures.rows, input, disturbance));
    let mut text = "t_s,U1_mean_n,U2_mean_n_m,U3_mean_n_m,U4_mean_n_m\n".to_owned();
    // A torque is the mean around a row: the first has none.
    for (k, (t, u1)) in thrust.iter().enumerate().skip(1) {
        let [u2, u3, u4] = torques.each_ref().map(|torque| torque[k - 1].1);
        let _ = writeln!(text, "{t},{u1},{u2},{u3},{u4}");
    }
    write_file(&folder.join("inputs.csv"), text)
}

#[cfg(test)]
mod tests {
    use super::super::flight::applied;
    use super::*;
    use crate::flight;

    /// Of laws in a wide layer, which do not switch, a row has the input itself.
    #[test]
    fn means_are_what_is_demanded_also_under_a_disturbance() {
        let wide = |axis: &str| format!("control.{axis}.reaching={{sat={{rho=2.0}}}}");
        let mut settings: Vec<String> = ["x", "y", "z", "roll", "pitch", "yaw"].map(wide).into();
        settings.extend(["duration_s=2", "disturbance.from_s=1", "disturbance.to_s=2"].map(String::from));
        let scenario = Scenario::load("paper-disturbed", &settings).expect("valid");
        let mut rows: Vec<Row> = Vec::new();
        flight::fly(&scenario, 1, &mut rows).expect("it flies");
        let inputs = Inputs::of(&scenario).expect("decoupled");
        let disturbance = applied(&scenario, 1).expect("there is one");
        for input in 0..4 {
            assert!(inputs.sliding(&rows, input).is_none(), "a wide layer does not switch");
            let demanded = rows.iter().map(|row| row.u[input]);
            let greatest = demanded.fold(0.0_f64, |most, u| most.max(u.abs()));
            for (t, mean) in inputs.mean(&rows, input, Some(&disturbance)) {
                let k = (t * 1e3).round() as usize;
                let u = |k: usize| rows[k].u[input];
                // The thrust is the mean until the next row, a torque that around a row, weighted as a triangle; between
                // rows they are taken to be straight, which they are not where a layer is entered.
                let expected =
                    if input == 0 { f64::midpoint(u(k), u(k + 1)) } else { (u(k - 1) + 4.0 * u(k) + u(k + 1)) / 6.0 };
                assert!((mean - expected).abs() < 0.02 * greatest, "U{} at {t}: {mean} is not {expected}", input + 1);
            }
        }
    }

    #[test]
    fn what_switches_has_a_band_of_its_gain() {
        let scenario =
            Scenario::load("paper-disturbed", &["duration_s=1".into(), "disturbance.from_s=0".into()]).expect("valid");
        let mut rows: Vec<Row> = Vec::new();
        flight::fly(&scenario, 1, &mut rows).expect("it flies");
        let inputs = Inputs::of(&scenario).expect("decoupled");
        let thrust = inputs.sliding(&rows, 0).expect("it switches");
        let expected = scenario.airframe.mass_kg * 224.5;
        assert!((thrust.swing - expected).abs() < 1e-6 * expected, "{} is not m K = {expected}", thrust.swing);
        assert!(thrust.from_s < 0.5, "{}", thrust.from_s);
    }
}
