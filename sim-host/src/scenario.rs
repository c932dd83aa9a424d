//! Scenarios: what to fly, typed. Built into the binary, or read from a file; every key can be set from outside.

#[cfg(test)]
mod airframe_tests;
mod csv;
mod files;
mod load;
mod notes;
mod orders;
mod params;
mod settings;
#[cfg(test)]
mod tests;
mod trajectory;
mod validate;
mod world;

use std::sync::Arc;

use anyhow::{Context, Result, bail};
use firmware::config::{FlightConfig, ManualSettings, ModeSettings, Start};
use firmware::guidance::{JoinPlan, Trajectory};
use firmware::settings::Settings;
use serde::{Deserialize, Serialize};

use crate::airframe::AirframeFile;
use crate::assess::Assess;
use crate::controller::{Control, Controller};
use crate::pilot::Command;
use crate::sensors::{Fault, Home, SuiteFile};
use crate::sil::replay::Entry;
pub use crate::world::{AttitudeWave, Disturbance, Gust, ScheduledPush, Tumble, Wind};
pub use load::tuning;
pub use notes::tuned_for_another;
pub use params::Params;
pub(crate) use settings::{is_of_controller, is_within, value, with_files};
pub use world::{BatteryStart, Truth, World};

/// Scenarios that come with the binary, in the order in which they are listed.
pub(crate) const SCENARIOS: [(&str, &str); 37] = glissade_files::built_in!("scenarios":
    "helix", "helix-tw4", "helix-lag", "figure-eight", "step", "hover", "pad",
    "paper-ideal", "paper-attitude", "paper-disturbed", "paper-disturbed-output", "paper-literal",
    "x500-hover", "x500-step", "x500-helix", "x500-eight", "x500-eight-tw4", "x500-recovery", "waypoints",
    "outdoor-tour", "field", "outdoor-hover", "outdoor-eight", "indoor-hover", "indoor-helix", "path", "path-gnss-lost", "path-mag-off",
    "path-mag-stuck", "path-baro-off", "path-baro-stuck", "gnss-glitch", "twist", "weak-rotor", "lost-rotor", "battery-collapse",
    "day",
);

/// Airframes that come with the binary.
pub(crate) const AIRFRAMES: [(&str, &str); 4] =
    glissade_files::built_in!("airframes": "paper", "x500", "racer250", "crazyflie");

/// Tunings that come with the binary.
pub(crate) const TUNINGS: [(&str, &str); 6] = glissade_files::built_in!("tunings":
    "x500-smc", "x500-pid", "x500-geometric", "x500-indi", "racer250-smc", "crazyflie-smc",
);

/// Which model of the world is flown in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PlantKind {
    /// Full Newton–Euler motion, firmware in lockstep at 1 kHz.
    #[default]
    RigidBody,
    /// Eq. 2 coupled through the angles, firmware in lockstep at 1 kHz.
    Paper,
    /// Eq. 2 with the force and the torques as direct, unlimited inputs, the control laws evaluated every 10 µs.
    PaperDecoupled,
}

/// A scenario file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScenarioFile {
    /// What it shows, in a line.
    #[serde(default)]
    pub summary: String,
    /// Name or path of the airframe.
    #[serde(default = "default_airframe")]
    pub airframe: String,
    /// In place of the airframe's.
    pub thrust_to_weight: Option<f64>,
    /// In place of the airframe's, s.
    pub rotor_lag_s: Option<f64>,
    /// In place of the airframe's, s; whole ticks.
    pub actuation_delay_s: Option<f64>,
    /// How the plant differs from what the firmware believes.
    #[serde(default)]
    pub truth: Truth,
    /// The model that is flown.
    #[serde(default)]
    pub plant: PlantKind,
    /// Whether there is ground at the start's height.
    #[serde(default)]
    pub ground: bool,
    /// Simulated time, s.
    pub duration_s: f64,
    /// How the flight begins.
    #[serde(default = "default_start")]
    pub start: Start,
    /// Where the flight begins, m.
    #[serde(default)]
    pub start_position_m: [f64; 3],
    /// In which velocity it begins, in the world, m/s; at rest without it.
    pub start_velocity_m_s: Option<[f64; 3]>,
    /// In which roll, pitch and yaw, °; level without it.
    pub start_attitude_deg: Option<[f64; 3]>,
    /// In which body rates, rad/s; none without it.
    pub start_rates_rad_s: Option<[f64; 3]>,
    /// A random start, in place of the three above.
    pub tumble: Option<Tumble>,
    /// What to fly.
    pub trajectory: Trajectory,
    /// How to get there; without it, the trajectory is followed from the first tick.
    pub join: Option<JoinPlan>,
    /// Gains of the sliding mode laws.
    pub control: Option<Control>,
    /// In their place, name or path of a tuning file. Without either, the airframe's own, `<airframe>-smc`.
    pub tuning: Option<String>,
    /// The sensors: a suite's name, or a table. Without them the firmware is given the true motion.
    pub sensors: Option<SuiteFile>,
    /// Where on earth the flight takes place.
    #[serde(default)]
    pub home: Home,
    /// What fails.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fault: Vec<Fault>,
    /// What a pilot asks for.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub command: Vec<Command>,
    /// How the vehicle flies by itself.
    #[serde(default)]
    pub modes: ModeSettings,
    /// What sticks do.
    #[serde(default)]
    pub manual: ManualSettings,
    /// Settings of the firmware by their names, in place of what the keys above give.
    #[serde(default, skip_serializing_if = "Params::is_empty")]
    pub params: Params,
    /// How its flights are judged.
    pub assess: Option<Assess>,
    /// Gaussian disturbances.
    pub disturbance: Option<Disturbance>,
    /// Wind.
    pub wind: Option<Wind>,
    /// Steady pushes for a while, which add up.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub push: Vec<ScheduledPush>,
    /// What of the airframe and of its air is flown with, besides the constants.
    #[serde(default)]
    pub world: World,
    /// The airframe's battery; without it, power that never ends.
    pub battery: Option<BatteryStart>,
    /// What roll, pitch and yaw are to follow (decoupled plant only); level without it.
    pub attitude: Option<AttitudeWave>,
    /// The least time in which this airframe can match the trajectory from the start, where it is known, s.
    pub time_optimal_s: Option<f64>,
}

fn default_airframe() -> String {
    "paper".to_owned()
}

const fn default_start() -> Start {
    Start::InFlight
}

/// A scenario that can be flown.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Its name, or the path it was read from.
    pub name: String,
    /// What to fly.
    pub file: ScenarioFile,
    /// The vehicle.
    pub airframe: AirframeFile,
    /// What flies it.
    pub controller: Controller,
    /// What came from outside in an earlier flight, to come again.
    pub replay: Option<Arc<[Entry]>>,
}

/// What scenarios have in common by which they are listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Group {
    /// The paper's own cases, in its equations.
    Paper,
    /// The rigid body; the firmware is given the true motion.
    IdealState,
    /// The rigid body; the firmware is given what sensors measure.
    OnSensors,
}

/// A built-in scenario, as it is listed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Listed {
    /// By which it is flown.
    pub name: &'static str,
    /// What it shows.
    pub summary: String,
    /// What it has in common with others.
    pub group: Group,
}

/// The built-in scenarios.
///
/// # Errors
/// None for a binary whose tests pass: they load each.
pub fn list() -> Result<Vec<Listed>> {
    let listed = |name: &'static str| {
        let file = Scenario::load(name, &[])?.file;
        Ok(Listed { name, group: file.group(), summary: file.summary })
    };
    SCENARIOS.iter().map(|(name, _)| listed(name)).collect()
}

impl ScenarioFile {
    /// Whether the seed makes a difference: sensors, disturbances, turbulence and a tumbling start are drawn from it.
    pub fn is_random(&self) -> bool {
        let gusty = self.wind.as_ref().is_some_and(|wind| wind.turbulence_20ft_m_s > 0.0);
        self.disturbance.is_some() || self.tumble.is_some() || gusty || self.sensors.is_some()
    }

    /// What it has in common with others.
    pub fn group(&self) -> Group {
        match (self.plant, &self.sensors) {
            (PlantKind::Paper | PlantKind::PaperDecoupled, _) => Group::Paper,
            (PlantKind::RigidBody, None) => Group::IdealState,
            (PlantKind::RigidBody, Some(_)) => Group::OnSensors,
        }
    }
}

impl Scenario {
    /// The same scenario with another controller.
    ///
    /// # Errors
    /// What of the controller the firmware refuses for this scenario.
    pub fn flown_by(mut self, controller: Controller) -> Result<Self> {
        self.controller = controller;
        self.validate().with_context(|| format!("scenario `{}`", self.name))?;
        Ok(self)
    }

    /// Refuses a scenario that is not flown on the rigid-body plant.
    ///
    /// # Errors
    /// The scenario's name, and the key to look at.
    pub fn require_rigid_body(&self) -> Result<()> {
        if self.file.plant == PlantKind::RigidBody {
            return Ok(());
        }
        bail!("scenario `{}`: `plant` must be `rigid-body` for this command", self.name)
    }

    /// What the firmware is told.
    pub fn flight_config(&self) -> FlightConfig {
        let mut config = self.unset_config();
        if !self.file.params.is_empty() {
            let mut settings = Settings::of(&config);
            params::lay_over(&mut settings, &self.file.params);
            settings.write_to(&mut config);
        }
        config
    }

    /// The same without its `[params]`.
    fn unset_config(&self) -> FlightConfig {
        let mut config = FlightConfig {
            airframe: self.airframe.flight(),
            trajectory: self.file.trajectory.clone(),
            join: self.file.join.clone(),
            start: self.file.start,
            start_position_m: self.file.start_position_m.map(|v| v as f32),
            estimator: self.file.sensors.as_ref().map(|suite| suite.estimator_settings(&self.file.home)),
            modes: self.file.modes,
            manual: self.file.manual,
            ..FlightConfig::default()
        };
        self.controller.configure(&mut config);
        config
    }

    /// What the plant is made of.
    pub fn constants(&self) -> crate::plant::Constants {
        self.file.truth.of(&self.airframe.constants())
    }

    /// The greatest thrust of the rotors as they truly are, and the vehicle's true weight, both at sea level, N.
    pub fn thrust_and_weight_n(&self) -> [f64; 2] {
        let plant = self.constants();
        let thrust_n = plant.geometry.row(0).sum() * self.airframe.omega_max().powi(2);
        [thrust_n, plant.mass * plant.gravity]
    }

    /// Why nothing can follow its trajectory for long, if it is so: more thrust than the rotors give, or more tilt than
    /// the controller may demand.
    pub fn beyond_reach(&self) -> Option<String> {
        let [thrust_n, weight_n] = self.thrust_and_weight_n();
        let sideways = trajectory::sideways_m_s2(&self.file.trajectory);
        let gravity = self.constants().gravity;
        let (needed, tilt) = (libm::hypot(sideways, gravity), libm::atan2(sideways, gravity).to_degrees());
        let given = gravity * thrust_n / weight_n;
        let most = f64::from(self.flight_config().tilt_max_rad).to_degrees();
        if needed > given {
            return Some(format!(
                "its trajectory takes {needed:.1} m/s² of thrust, and the rotors give {given:.1} at most"
            ));
        }
        (tilt > most).then(|| format!("its trajectory takes a tilt of {tilt:.0}°, and `tilt_max_rad` is {most:.0}°"))
    }

    /// How long its trajectory is joined, s.
    pub fn joined_s(&self) -> f64 {
        self.file.join.as_ref().map_or(0.0, |join| f64::from(join.duration_s))
    }

    /// How much later than commanded the rotors are told, ticks.
    pub fn actuation_delay_ticks(&self) -> usize {
        (self.airframe.actuation_delay_s * 1e3).round() as usize
    }

    /// Number of ticks to fly.
    pub fn ticks(&self) -> u32 {
        (self.file.duration_s * 1e3).round() as u32
    }
}
