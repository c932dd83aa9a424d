//! What a vehicle on sensors believed beside what was true: position, errors with the deviations believed of them, and
//! how far each reading was from what was expected of it.

use std::path::{Path, PathBuf};

use anyhow::Result;
use nalgebra::{UnitQuaternion, Vector3};

use super::axis::{Quantity, Unit};
use super::flight::Figures;
use super::page::{grid, save, size_of};
use super::panel::{DIRECTIONS, POSITIONS, Panel};
use super::series::{Points, thin_series};
use super::style::{Key, Role, palette};
use crate::assess::consistency::{SOURCES, kind, quantile};
use crate::report::estimate::Belief;

/// Most dots of a panel; of more, evenly many are drawn, and all that were refused.
const MOST_DOTS: usize = 1500;
/// What is shown of normalised innovations, in decades: what the gates let pass is below 100. What lies beyond is drawn at
/// the edge, and counted in the title.
const DECADES: (f64, f64) = (-2.1, 2.1);
/// The top of the axis.
const GREATEST: f32 = 100.0;

/// Height of a panel.
const PANEL: u32 = 235;

/// Draws the three figures of a flight's beliefs into `folder`. Returns the files written.
///
/// # Errors
/// When a file cannot be written; the message names it.
pub(super) fn draw(folder: &Path, figures: &Figures) -> Result<Vec<PathBuf>> {
    Ok(vec![position(folder, figures)?, attitude(folder, figures)?, innovations(folder, figures)?])
}

/// A panel over the whole flight, before its phases and faults.
fn placed(figures: &Figures, panel: Panel) -> Panel {
    Panel { span: figures.span(), backdrop: figures.backdrop.clone(), ..panel }
}

/// The legend: phases, then what the lines are.
fn legend<'a>(figures: &'a Figures, lines: &[Key<'a>]) -> Vec<Key<'a>> {
    figures.backdrop.keys().into_iter().chain(lines.iter().copied()).collect()
}

/// The position's error in the band of two standard deviations that is believed of it, beside the position.
fn position(folder: &Path, figures: &Figures) -> Result<PathBuf> {
    let beliefs = figures.beliefs;
    let panels = (0..3).flat_map(|axis| {
        let name = POSITIONS[axis];
        let believed = move |b: &Belief| f64::from(b.nav.position[axis]);
        let lines = vec![
            (Role::Reference, over_time(beliefs, move |b| b.truth.position[axis])),
            (Role::Flown, over_time(beliefs, believed)),
        ];
        let absolute = Panel::over_time(&format!("{name} ({})", DIRECTIONS[axis]), Quantity::place(name), lines);
        let error = move |b: &Belief| b.truth.position[axis] - believed(b);
        let up = Quantity::new(format!("{name} error"), Unit::Metre);
        [absolute, error_panel(beliefs, up, error, move |b| f64::from(b.sigma[6 + axis]))]
    });
    let panels: Vec<_> = panels.map(|panel| placed(figures, panel)).collect();
    let path = folder.join("estimate-position.svg");
    let heading = figures.heading("Position, true and estimated");
    let legend = legend(figures, &[TRUE, ESTIMATED, TWO_SIGMA]);
    save(&path, size_of(3, PANEL), &heading, &legend, |area| grid(area, 2, &panels))?;
    Ok(path)
}

/// Errors of attitude and velocity, each in the band of two standard deviations that is believed of it.
fn attitude(folder: &Path, figures: &Figures) -> Result<PathBuf> {
    let about = ["tilt about north", "tilt about west", "heading"];
    // Of what is not aligned yet, nothing is believed.
    let beliefs = &figures.beliefs[figures.beliefs.partition_point(|b| b.sigma[0] == 0.0)..];
    let panels = (0..3).flat_map(|axis| {
        let turn = move |b: &Belief| turn(b)[axis].to_degrees();
        let turn_sigma = move |b: &Belief| f64::from(b.sigma[axis]).to_degrees();
        let speed = move |b: &Belief| b.truth.velocity[axis] - f64::from(b.nav.velocity[axis]);
        let angle = Quantity::new(format!("{} error", about[axis]), Unit::Degree);
        let velocity = Quantity::new(format!("v{} error", POSITIONS[axis]), Unit::MetrePerSecond);
        let named = format!("velocity {}: true − estimated", DIRECTIONS[axis]);
        [
            Panel {
                title: format!("{}: true − estimated", about[axis]),
                ..error_panel(beliefs, angle, turn, turn_sigma)
            },
            Panel { title: named, ..error_panel(beliefs, velocity, speed, move |b| f64::from(b.sigma[3 + axis])) },
        ]
    });
    let panels: Vec<_> = panels.map(|panel| placed(figures, panel)).collect();
    let path = folder.join("estimate-attitude.svg");
    let heading = figures.heading("Errors of the attitude and velocity estimates");
    let legend = legend(figures, &[Key::Line("error", Role::Flown), TWO_SIGMA]);
    save(&path, size_of(3, PANEL), &heading, &legend, |area| grid(area, 2, &panels))?;
    Ok(path)
}

/// The normalised innovations squared of each kind of reading that came, over time, with their 95 % line.
fn innovations(folder: &Path, figures: &Figures) -> Result<PathBuf> {
    let panels = (0..SOURCES.len()).filter_map(|number| innovation_panel(figures.beliefs, number));
    let panels: Vec<_> = panels.map(|panel| placed(figures, panel)).collect();
    let path = folder.join("innovations.svg");
    let legend = legend(figures, &[Key::Dots("reading", palette::FLOWN), Key::Line("95 % line", Role::Limit)]);
    let heading = figures.heading("Normalised innovations squared (NIS)");
    let rows = panels.len().div_ceil(2).max(1);
    save(&path, size_of(rows, PANEL), &heading, &legend, |area| grid(area, 2, &panels))?;
    Ok(path)
}

/// None for a reading that never came.
fn innovation_panel(beliefs: &[Belief], number: usize) -> Option<Panel> {
    let (name, degrees) = kind(SOURCES[number]);
    let readings: Vec<_> = beliefs.iter().filter_map(|b| Some((b.t, b.readings[number]?))).collect();
    let (first, last) = (beliefs.first()?.t, beliefs.last()?.t);
    if readings.is_empty() {
        return None;
    }
    let limit = quantile(degrees);
    let within = readings.iter().filter(|(_, verdict)| f64::from(verdict.nis) <= limit).count();
    let stride = readings.len().div_ceil(MOST_DOTS);
    let kept = readings.iter().enumerate().filter(|(i, (_, verdict))| i % stride == 0 || !verdict.accepted);
    let dot = |t: f64, nis: f32| (t, libm::log10(f64::from(nis)).clamp(DECADES.0 + 0.05, DECADES.1 - 0.05));
    let dots = kept.map(|(_, (t, verdict))| dot(*t, verdict.nis)).collect();
    let beyond = readings.iter().filter(|(_, verdict)| verdict.nis > GREATEST).count();
    let beyond = if beyond > 0 { format!("; {beyond} above {GREATEST}, at the edge") } else { String::new() };
    let title = format!("{name}: {:.1} % within{beyond}", 100.0 * within as f64 / readings.len() as f64);
    let line = [first, last].map(|t| (t, libm::log10(limit))).to_vec();
    let lines = vec![(Role::Limit, line)];
    Some(Panel { dots, decades_up: Some(DECADES), ..Panel::over_time(&title, "NIS", lines) })
}

const TRUE: Key = Key::Line("true", Role::Reference);
const ESTIMATED: Key = Key::Line("estimated", Role::Flown);
const TWO_SIGMA: Key = Key::Series("±2σ of the estimator", palette::BAND);

fn over_time(beliefs: &[Belief], value: impl Fn(&Belief) -> f64) -> Points {
    thin_series(beliefs.iter().map(|belief| (belief.t, value(belief))).collect())
}

/// Two deviations below and above a value.
fn band(beliefs: &[Belief], value: impl Fn(&Belief) -> f64, sigma: impl Fn(&Belief) -> f64) -> (Points, Points) {
    (
        over_time(beliefs, |belief| value(belief) - 2.0 * sigma(belief)),
        over_time(beliefs, |belief| value(belief) + 2.0 * sigma(belief)),
    )
}

fn error_panel(
    beliefs: &[Belief],
    up: Quantity,
    error: impl Fn(&Belief) -> f64,
    sigma: impl Fn(&Belief) -> f64,
) -> Panel {
    let lines = vec![(Role::Flown, over_time(beliefs, error))];
    let band = Some(band(beliefs, |_| 0.0, sigma));
    Panel { band, ..Panel::over_time("true − estimated", up, lines) }
}

/// The rotation vector, in the world, from the believed attitude to the true one, rad.
fn turn(belief: &Belief) -> Vector3<f64> {
    let is = UnitQuaternion::new_normalize(belief.truth.attitude);
    (is * belief.nav.attitude.cast::<f64>().inverse()).scaled_axis()
}

#[cfg(test)]
mod tests {
    use super::super::tests::{draw_all, figures, made_up};
    use super::*;
    use crate::report::estimate::tests::belief;

    #[test]
    fn figures_are_drawn_of_what_there_is() {
        let beliefs: Vec<_> = (0..500).map(|k| belief(f64::from(k) * 0.02)).collect();
        let rows = made_up(1.0);
        let drawn = draw_all("beliefs", &Figures { beliefs: &beliefs, ..figures(&rows) });
        let svg = &drawn.iter().find(|(name, _)| name == "innovations.svg").expect("it was drawn").1;
        assert!(svg.contains("baro: 100.0 % within") && !svg.contains("heading:"));
    }

    #[test]
    fn refused_readings_are_never_thinned_out() {
        let mut beliefs: Vec<_> = (0..5000).map(|k| belief(f64::from(k))).collect();
        let refused = firmware::estimator::update::Verdict { nis: 1e3, accepted: false };
        for at in [1001, 1003, 4999] {
            beliefs[at].readings[1] = Some(refused);
        }
        let panel = innovation_panel(&beliefs, 1).expect("there are readings");
        assert!(panel.dots.len() <= MOST_DOTS + 3);
        assert_eq!(panel.dots.iter().filter(|dot| dot.1 > 2.0).count(), 3);
        assert!(panel.title.ends_with(" % within; 3 above 100, at the edge"), "{}", panel.title);
        assert!(innovation_panel(&beliefs, 0).is_none());
    }
}
