//! What a vehicle on sensors believed beside what was true: position, errors with the deviations believed of them, and
//! how far each reading was from what was expected of it.

use std::path::{Path, PathBuf};

use anyhow::Result;
use nalgebra::{UnitQuaternion, Vector3};

use super::panel::{Key, Panel, Role, grid, palette, save};
use super::series::{Points, thin_series};
use super::{POSITIONS, TALL};
use crate::assess::consistency::{SOURCES, kind, quantile};
use crate::report::estimate::Belief;
use crate::report::timeline::Timeline;

/// Most dots of a panel; of more, evenly many are drawn, and all that were refused.
const MOST_DOTS: usize = 1500;
/// What is shown of normalised innovations, in decades; what lies beyond is drawn at the edge.
const DECADES: (f64, f64) = (-2.1, 4.1);

/// Draws the three figures of a flight's beliefs into `folder`. Returns the files written.
///
/// # Errors
/// When a file cannot be written; the message names it.
pub fn draw(folder: &Path, beliefs: &[Belief], _timeline: &Timeline) -> Result<Vec<PathBuf>> {
    Ok(vec![position(folder, beliefs)?, attitude(folder, beliefs)?, innovations(folder, beliefs)?])
}

/// Position: true, and believed with its band of two standard deviations; beside it the error in the same band.
fn position(folder: &Path, beliefs: &[Belief]) -> Result<PathBuf> {
    let panels: Vec<_> = (0..3)
        .flat_map(|axis| {
            let name = POSITIONS[axis];
            let believed = move |b: &Belief| f64::from(b.nav.position[axis]);
            let sigma = move |b: &Belief| f64::from(b.sigma[6 + axis]);
            let lines = vec![
                (Role::Reference, over_time(beliefs, move |b| b.truth.position[axis])),
                (Role::Flown, over_time(beliefs, believed)),
            ];
            let band = Some(band(beliefs, believed, sigma));
            let absolute = Panel { band, ..Panel::over_time(name, &format!("{name}, m"), lines) };
            let error = move |b: &Belief| b.truth.position[axis] - believed(b);
            [absolute, error_panel(beliefs, name, "m", error, sigma)]
        })
        .collect();
    let path = folder.join("fig8-estimate-position.svg");
    let legend = [TRUE, BELIEVED, TWO_SIGMA];
    save(&path, TALL, "Position, true and believed", &legend, |area| grid(area, 2, &panels))?;
    Ok(path)
}

/// Errors of attitude and velocity, each in the band of two standard deviations that is believed of it.
fn attitude(folder: &Path, beliefs: &[Belief]) -> Result<PathBuf> {
    let about = ["tilt about north", "tilt about west", "heading"];
    let along = ["velocity north", "velocity west", "velocity up"];
    let panels: Vec<_> = (0..3)
        .flat_map(|axis| {
            let turn = move |b: &Belief| turn(b)[axis].to_degrees();
            let turn_sigma = move |b: &Belief| f64::from(b.sigma[axis]).to_degrees();
            let speed = move |b: &Belief| b.truth.velocity[axis] - f64::from(b.nav.velocity[axis]);
            let speed_sigma = move |b: &Belief| f64::from(b.sigma[3 + axis]);
            // Of what is not aligned yet, nothing is believed.
            let aligned = &beliefs[beliefs.partition_point(|b| b.sigma[0] == 0.0)..];
            [
                error_panel(aligned, about[axis], "°", turn, turn_sigma),
                error_panel(aligned, along[axis], "m/s", speed, speed_sigma),
            ]
        })
        .collect();
    let path = folder.join("fig9-estimate-attitude.svg");
    let legend = [Key::Series("true − believed", palette::FLOWN), TWO_SIGMA];
    save(&path, TALL, "What the vehicle's attitude and velocity were off by", &legend, |area| grid(area, 2, &panels))?;
    Ok(path)
}

/// The normalised innovations squared of each kind of reading that came, over time, with their 95 % line.
fn innovations(folder: &Path, beliefs: &[Belief]) -> Result<PathBuf> {
    let panels: Vec<_> = (0..SOURCES.len()).filter_map(|number| innovation_panel(beliefs, number)).collect();
    let path = folder.join("fig10-innovations.svg");
    let legend = [Key::Series("reading", palette::FLOWN), Key::Series("95 %, if all is as believed", palette::START)];
    let heading = "Normalised innovations squared (NIS)";
    save(&path, TALL, heading, &legend, |area| grid(area, 2, &panels))?;
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
    let title = format!("{name}: {:.1} % within", 100.0 * within as f64 / readings.len() as f64);
    let line = [first, last].map(|t| (t, libm::log10(limit))).to_vec();
    let lines = vec![(Role::Limit, line)];
    Some(Panel { dots, decades_up: Some(DECADES), ..Panel::over_time(&title, "NIS", lines) })
}

const TRUE: Key = Key::Series("true", palette::REFERENCE);
const BELIEVED: Key = Key::Series("believed", palette::FLOWN);
const TWO_SIGMA: Key = Key::Series("±2σ as believed", palette::BAND);

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
    name: &str,
    unit: &str,
    error: impl Fn(&Belief) -> f64,
    sigma: impl Fn(&Belief) -> f64,
) -> Panel {
    let lines = vec![(Role::Flown, over_time(beliefs, error))];
    let band = Some(band(beliefs, |_| 0.0, sigma));
    Panel { band, ..Panel::over_time(&format!("{name}: true − believed"), unit, lines) }
}

/// The rotation vector, in the world, from the believed attitude to the true one, rad.
fn turn(belief: &Belief) -> Vector3<f64> {
    let is = UnitQuaternion::new_normalize(belief.truth.attitude);
    (is * belief.nav.attitude.cast::<f64>().inverse()).scaled_axis()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::estimate::tests::belief;

    #[test]
    fn figures_are_drawn_of_what_there_is() {
        let folder = std::env::temp_dir().join(format!("glissade-{}-beliefs", std::process::id()));
        std::fs::create_dir_all(&folder).expect("the temporary folder can be written");
        let beliefs: Vec<_> = (0..500).map(|k| belief(f64::from(k) * 0.02)).collect();
        for file in draw(&folder, &beliefs, &Timeline::default()).expect("drawn") {
            let svg = std::fs::read_to_string(&file).expect("written");
            assert!(svg.starts_with("<svg") && !svg.contains("NaN"), "{}", file.display());
        }
        let svg = std::fs::read_to_string(folder.join("fig10-innovations.svg")).expect("written");
        assert!(svg.contains("baro: 100.0 % within") && !svg.contains("heading:"));
        std::fs::remove_dir_all(&folder).expect("the folder is there");
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
        assert_eq!(panel.dots.iter().filter(|dot| dot.1 > 2.9).count(), 3);
        assert!(innovation_panel(&beliefs, 0).is_none());
    }
}
