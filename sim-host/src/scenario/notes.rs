//! What can be flown and yet does not go together: told, not refused.

use super::settings::Setting;
use super::{AIRFRAMES, PlantKind, SCENARIOS, Scenario, TUNINGS};
use crate::airframe::AirframeFile;
use crate::files;
use crate::reference;

/// What else than a trajectory a joining path was planned from.
const PLANNED_FROM: [&str; 4] = ["trajectory", "start_position_m", "start_velocity_m_s", "thrust_to_weight"];

impl Scenario {
    /// Gains, and a joining path, that were made for something else than what these settings make of the scenario.
    pub fn mismatches(&self, settings: &[String]) -> Vec<String> {
        let keys: Vec<&str> = settings.iter().filter_map(|text| Some(Setting::parse(text).ok()?.key)).collect();
        let is_set = |key: &str| keys.contains(&key);
        let airframe = &self.file.airframe;
        let gains = match (&self.file.tuning, &self.file.control) {
            (Some(tuning), _) => tuned_for_another(tuning, airframe),
            (None, Some(_)) if is_set("airframe") && !keys.iter().any(|key| key.starts_with("control")) => {
                Some(format!(
                    "the scenario's `control` was tuned for another airframe than `{airframe}`: --set control=false flies \
                 the airframe's own gains"
                ))
            }
            _ => None,
        };
        let moved = keys.iter().find(|key| PLANNED_FROM.contains(&key.split('.').next().unwrap_or(key)));
        let is_planned = self.file.join.as_ref().is_some_and(|join| !join.middle_m.is_empty());
        let join = moved.filter(|_| is_planned && !keys.iter().any(|key| key.starts_with("join")));
        let join = join.map(|key| {
            format!(
                "`join` was planned without `{key}`: plan another (`sim-host plan`), or --set join=false to fly without"
            )
        });
        let all = gains.into_iter().chain(join).chain(self.copied_path()).chain(self.unturned());
        all.chain(keys.iter().filter_map(|key| self.idle_on_decoupled(key))).collect()
    }

    /// Says of a heading that the plant `paper-decoupled` does not fly.
    fn unturned(&self) -> Option<String> {
        let level = self.file.plant == PlantKind::PaperDecoupled && self.file.attitude.is_none();
        let mut times = (0..=50).map(|i| f64::from(i) / 50.0 * self.file.duration_s);
        let turns = level && times.any(|t| reference::at(&self.file.trajectory, t)[3] != 0.0);
        turns.then(|| {
            "the plant `paper-decoupled` turns by `[attitude]` alone: the trajectory's yaw is not flown".to_owned()
        })
    }

    /// Says of a gain that the plant `paper-decoupled` has no use for.
    fn idle_on_decoupled(&self, key: &str) -> Option<String> {
        let unused = ["control.tilt_max_rad", "control.rotor_time_constant_s", "control.effectiveness_rate"];
        if self.file.plant != PlantKind::PaperDecoupled {
            return None;
        }
        if unused.contains(&key) {
            return Some(format!("`{key}` does nothing on the plant `paper-decoupled`, whose inputs are direct"));
        }
        let of_attitude = ["control.roll", "control.pitch", "control.yaw"].iter().any(|axis| key.starts_with(axis));
        let is_still = self.file.attitude.is_none() && self.file.disturbance.is_none();
        (of_attitude && is_still)
            .then(|| format!("`{key}` does nothing here, where nothing turns: `paper-attitude` does"))
    }

    /// Says of a joining path that was copied with a built-in scenario, and whose trajectory was not.
    fn copied_path(&self) -> Option<String> {
        let is_built_in = SCENARIOS.iter().any(|(name, _)| *name == self.name);
        self.file.join.as_ref().filter(|join| !is_built_in && !join.middle_m.is_empty())?;
        let origins: Vec<Self> = SCENARIOS
            .iter()
            .filter_map(|(name, _)| Self::load(name, &[]).ok())
            .filter(|built_in| built_in.file.join == self.file.join)
            .collect();
        let is_same = |origin: &Self| origin.file.trajectory == self.file.trajectory;
        let origin = origins.first().filter(|_| !origins.iter().any(is_same))?;
        let bound = if self.file.time_optimal_s.is_some() { " (and `time_optimal_s`)" } else { "" };
        Some(format!(
            "`join`{bound} is that of `{}`, which has another trajectory: leave it out, or plan another",
            origin.name
        ))
    }
}

/// Says of a built-in tuning that is flown on an airframe that it was not tuned for.
pub fn tuned_for_another(tuning: &str, airframe: &str) -> Option<String> {
    let is_built_in = TUNINGS.iter().any(|(name, _)| *name == tuning);
    let (of, _) = tuning.rsplit_once('-').filter(|_| is_built_in)?;
    let read = |name: &str| files::read::<AirframeFile>(name, "airframe", &AIRFRAMES).ok();
    let is_same = of == airframe || read(of).is_some_and(|tuned| read(airframe) == Some(tuned));
    let is_own = AIRFRAMES.iter().all(|(name, _)| *name != airframe);
    let remedy = if is_own { "docs/tuning.md tells how to tune for yours" } else { "its gains may not fly it" };
    (!is_same).then(|| format!("`{tuning}` was tuned for the airframe `{of}`, not for `{airframe}`: {remedy}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gains_and_paths_made_for_something_else_are_told() {
        let told = |name: &str, settings: &[&str]| {
            let settings: Vec<String> = settings.iter().map(|text| (*text).to_owned()).collect();
            Scenario::load(name, &settings).expect("valid").mismatches(&settings).join("; ")
        };
        for (name, settings, expected) in [
            ("pad", &["airframe=x500"][..], "`control` was tuned for another airframe than `x500`"),
            ("pad", &["airframe=x500", "control=false"], ""),
            ("pad", &["airframe.mass_kg=0.9"], ""),
            (
                "x500-hover",
                &["tuning=crazyflie-smc"],
                "`crazyflie-smc` was tuned for the airframe `crazyflie`, not for `x500`",
            ),
            ("x500-hover", &["tuning=x500-pid"], ""),
            (
                "helix",
                &["trajectory.helix.amplitude_m=[2,2]"],
                "`join` was planned without `trajectory.helix.amplitude_m`",
            ),
            ("helix", &["trajectory.helix.amplitude_m=[2,2]", "join=false"], ""),
            ("helix", &["control.x.gain=8"], ""),
            ("paper-ideal", &["trajectory.helix.yaw_rad=0.5"], "the trajectory's yaw is not flown"),
            ("paper-ideal", &["control.tilt_max_rad=0.5"], "`control.tilt_max_rad` does nothing"),
            ("paper-ideal", &["control.roll.gain=100"], "nothing turns: `paper-attitude` does"),
            ("paper-attitude", &["control.roll.gain=100"], ""),
            ("paper-literal", &["control.tilt_max_rad=0.5", "trajectory.helix.yaw_rad=0.5"], ""),
        ] {
            let found = told(name, settings);
            assert!(if expected.is_empty() { found.is_empty() } else { found.contains(expected) }, "{name}: {found}");
        }
    }

    #[test]
    fn a_path_copied_to_another_trajectory_is_told() {
        let (_, helix) = SCENARIOS.iter().find(|(name, _)| *name == "helix").expect("there is one");
        let told = |text: &str, name: &str| {
            let path = std::env::temp_dir().join(format!("glissade-notes-{}-{name}.toml", std::process::id()));
            std::fs::write(&path, text).expect("written");
            let told = Scenario::load(path.to_str().expect("a plain path"), &[]).expect("valid").mismatches(&[]);
            std::fs::remove_file(&path).expect("it is there");
            told.join("; ")
        };
        assert_eq!(told(helix, "same"), "");
        let other = helix.replace("amplitude_m = [4.0, 5.0]", "amplitude_m = [2.0, 2.0]");
        assert_ne!(&other, helix);
        assert!(
            told(&other, "other").starts_with("`join` (and `time_optimal_s`) is that of `helix`"),
            "{}",
            told(&other, "other")
        );
    }
}
