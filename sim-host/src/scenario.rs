//! Scenarios: what to fly, typed. Built into the binary, or read from a file; every key can be set from outside.

mod validate;
mod world;

use anyhow::{Context, Result, anyhow, bail};
use firmware::config::{FlightConfig, ModeSettings, Start};
use firmware::guidance::{JoinPlan, Trajectory};
use serde::{Deserialize, Serialize};

use crate::airframe::AirframeFile;
use crate::assess::Assess;
use crate::controller::{Control, Controller, TuningFile};
use crate::files::{built_in, one_line, parse, read, source};
use crate::pilot::Command;
use crate::sensors::{Fault, Home, SuiteFile};
pub use world::{BatteryStart, Gust, ScheduledPush, Truth, Tumble, Wind, World};

/// Scenarios that come with the binary, in the order in which they are listed.
const SCENARIOS: [(&str, &str); 36] = built_in!("scenarios":
    "helix", "helix-tw4", "helix-lag", "figure-eight", "step", "hover", "pad",
    "paper-ideal", "paper-attitude", "paper-disturbed", "paper-disturbed-output", "paper-literal",
    "x500-hover", "x500-step", "x500-helix", "x500-eight", "x500-eight-tw4", "x500-recovery",
    "outdoor-tour", "field", "outdoor-hover", "outdoor-eight", "indoor-hover", "indoor-helix", "path", "path-gnss-lost", "path-mag-off",
    "path-mag-stuck", "path-baro-off", "path-baro-stuck", "gnss-glitch", "twist", "weak-rotor", "lost-rotor", "battery-collapse",
    "day",
);

/// Airframes that come with the binary.
pub(crate) const AIRFRAMES: [(&str, &str); 4] = built_in!("airframes": "paper", "x500", "racer250", "crazyflie");

/// Tunings that come with the binary.
pub(crate) const TUNINGS: [(&str, &str); 6] = built_in!("tunings":
    "x500-smc", "x500-pid", "x500-geometric", "x500-indi", "racer250-smc", "crazyflie-smc",
);

/// Which model of the world is flown in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PlantKind {
    /// Full Newton–Euler motion, firmware in lockstep at 1 kHz.
    RigidBody,
    /// Eq. 2 coupled through the angles, firmware in lockstep at 1 kHz.
    Paper,
    /// Eq. 2 with the force and the torques as direct, unlimited inputs, the control laws evaluated every 10 µs.
    PaperDecoupled,
}

/// Gaussian disturbances, each value held for `hold_s`; standard deviations a component.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Disturbance {
    /// Onset, s.
    pub from_s: f64,
    /// End, s.
    pub to_s: f64,
    /// How long each sample is held, s; whole ticks.
    pub hold_s: f64,
    /// On the accelerations of x, y and z, m/s².
    #[serde(default)]
    pub acceleration_m_s2: f64,
    /// On the angular accelerations, rad/s².
    #[serde(default)]
    pub angular_acceleration_rad_s2: f64,
    /// On the measured position, m.
    #[serde(default)]
    pub position_output_m: f64,
    /// On the measured angles, rad.
    #[serde(default)]
    pub angle_output_rad: f64,
}

impl Disturbance {
    /// Whether it pushes the vehicle.
    pub fn is_on_accelerations(&self) -> bool {
        self.acceleration_m_s2 > 0.0 || self.angular_acceleration_rad_s2 > 0.0
    }
}

/// An attitude to follow, for the case that has no position loop: `amplitude·sin(rate·t + phase)` an angle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AttitudeWave {
    /// φ, θ, ψ amplitudes, rad.
    pub amplitude_rad: [f64; 3],
    /// Angular rates of the waves, rad/s.
    pub rate_rad_s: [f64; 3],
    /// Phases at t = 0, rad.
    pub phase_rad: [f64; 3],
}

/// A scenario file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScenarioFile {
    /// What it shows, in a line.
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
    /// The world.
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
    #[serde(default)]
    pub fault: Vec<Fault>,
    /// What a pilot asks for.
    #[serde(default)]
    pub command: Vec<Command>,
    /// How the vehicle flies by itself.
    #[serde(default)]
    pub modes: ModeSettings,
    /// How its flights are judged.
    pub assess: Option<Assess>,
    /// Gaussian disturbances.
    pub disturbance: Option<Disturbance>,
    /// Wind.
    pub wind: Option<Wind>,
    /// Steady pushes for a while, which add up.
    #[serde(default)]
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
    /// Loads a built-in scenario by name or a file by path, with `KEY=VALUE` settings applied to it. Keys are
    /// dotted (`control.roll.lambda`); those under `airframe.` set the airframe's.
    ///
    /// # Errors
    /// One line that names the scenario or file, the key, and what is wrong with it.
    pub fn load(name: &str, settings: &[String]) -> Result<Self> {
        let context = || format!("scenario `{name}`");
        let mut table = parse(&source(name, "scenario", &SCENARIOS)?).with_context(context)?;
        let mut airframe_settings = Vec::new();
        for setting in settings {
            let (key, value) = split_setting(setting)?;
            match key.strip_prefix("airframe.") {
                Some(key) => airframe_settings.push((key, value)),
                None => set(&mut table, key, value).with_context(|| format!("--set {setting}"))?,
            }
        }
        let mut file: ScenarioFile = table.try_into().map_err(|error| one_line(&error)).with_context(context)?;
        if settings.iter().any(|setting| moves_the_bound(setting)) {
            file.time_optimal_s = None;
        }

        let airframe_name = file.airframe.clone();
        let context_airframe = || format!("airframe `{airframe_name}`");
        let mut table = parse(&source(&airframe_name, "airframe", &AIRFRAMES)?).with_context(context_airframe)?;
        for (key, value) in airframe_settings {
            set(&mut table, key, value).with_context(|| format!("--set airframe.{key}"))?;
        }
        let mut airframe: AirframeFile =
            table.try_into().map_err(|error| one_line(&error)).with_context(context_airframe)?;
        airframe.thrust_to_weight = file.thrust_to_weight.unwrap_or(airframe.thrust_to_weight);
        airframe.rotor_lag_s = file.rotor_lag_s.unwrap_or(airframe.rotor_lag_s);
        airframe.actuation_delay_s = file.actuation_delay_s.unwrap_or(airframe.actuation_delay_s);

        let controller = controller(&file).with_context(context)?;
        let scenario = Self { name: name.to_owned(), file, airframe, controller };
        scenario.validate().with_context(context)?;
        Ok(scenario)
    }

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
        let mut config = FlightConfig {
            airframe: self.airframe.flight(),
            trajectory: self.file.trajectory,
            join: self.file.join.clone(),
            start: self.file.start,
            start_position_m: self.file.start_position_m.map(|v| v as f32),
            estimator: self.file.sensors.as_ref().map(|suite| suite.estimator_settings(&self.file.home)),
            modes: self.file.modes,
            ..FlightConfig::default()
        };
        self.controller.configure(&mut config);
        config
    }

    /// What the plant is made of.
    pub fn constants(&self) -> crate::plant::Constants {
        self.file.truth.of(&self.airframe.constants())
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

/// Loads a built-in tuning by name or a file by path.
///
/// # Errors
/// One line that names the tuning or file, and what is wrong with it.
pub fn tuning(name: &str) -> Result<TuningFile> {
    read(name, "tuning", &TUNINGS)
}

/// The controller that a scenario asks for.
fn controller(file: &ScenarioFile) -> Result<Controller> {
    let own = format!("{}-smc", file.airframe);
    match (&file.tuning, &file.control) {
        (Some(name), None) => Ok(tuning(name)?.controller),
        (None, Some(control)) => Ok(Controller::Smc(control.clone())),
        (None, None) if TUNINGS.iter().any(|(name, _)| *name == own) => Ok(tuning(&own)?.controller),
        (Some(_), Some(_)) => bail!("`tuning` and `control` both say what flies: keep one"),
        (None, None) => bail!("`tuning` is missing: name a tuning file, or give gains under `[control]`"),
    }
}

/// Whether a setting makes another problem of it than the one whose time-optimal bound is known.
fn moves_the_bound(setting: &str) -> bool {
    let key = setting.split(['=', '.']).next().unwrap_or_default();
    let start = key.starts_with("start_") || key == "tumble";
    let world = matches!(key, "truth" | "wind" | "world" | "push" | "battery" | "fault" | "sensors");
    start || world || matches!(key, "airframe" | "thrust_to_weight" | "trajectory" | "plant")
}

fn split_setting(setting: &str) -> Result<(&str, toml::Value)> {
    let (key, text) = setting.split_once('=').ok_or_else(|| anyhow!("--set {setting}: use KEY=VALUE"))?;
    Ok((key, value(text)))
}

/// A value as TOML has it; what is none, is a string.
pub(crate) fn value(text: &str) -> toml::Value {
    format!("value = {text}")
        .parse::<toml::Table>()
        .ok()
        .and_then(|mut table| table.remove("value"))
        .unwrap_or_else(|| toml::Value::String(text.to_owned()))
}

/// Sets a dotted key; integers become floats where a float stood.
fn set(table: &mut toml::Table, key: &str, value: toml::Value) -> Result<()> {
    let (path, last) = key.rsplit_once('.').map_or((None, key), |(path, last)| (Some(path), last));
    let mut place = table;
    for part in path.into_iter().flat_map(|path| path.split('.')) {
        place = place
            .entry(part)
            .or_insert_with(|| toml::Value::Table(toml::Table::new()))
            .as_table_mut()
            .ok_or_else(|| anyhow!("`{part}` is not a table"))?;
    }
    place.insert(last.to_owned(), value);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(name: &str, settings: &[&str]) -> String {
        let settings: Vec<String> = settings.iter().map(|s| (*s).to_owned()).collect();
        let error = Scenario::load(name, &settings).expect_err("must be refused");
        let text = format!("{error:#}");
        assert!(!text.contains('\n'), "{text}");
        text
    }

    #[test]
    fn every_built_in_scenario_loads() {
        assert_eq!(list().expect("all load").len(), SCENARIOS.len());
    }

    #[test]
    fn bad_input_is_one_line_that_names_the_culprit() {
        assert!(refusal("helicks", &[]).contains("helicks"));
        assert!(refusal("helix", &["airframe=papper"]).contains("papper"));
        assert!(refusal("helix", &["airframe.mass_kg=-1"]).contains("mass_kg"));
        assert!(refusal("helix", &["airframe.mass_kg=nan"]).contains("mass_kg"));
        assert!(refusal("helix", &["control.roll.lambda=nan"]).contains("control.roll"));
        assert!(refusal("helix", &["colour=1"]).contains("colour"));
        assert!(refusal("helix", &["control.roll.colour=1"]).contains("colour"));
        assert!(refusal("helix", &["duration_s=soon"]).contains("duration_s"));
        assert!(refusal("helix", &["duration_s"]).contains("KEY=VALUE"));
        assert!(refusal("helix", &["modes.colour=1"]).contains("colour"));
        assert!(refusal("helix", &["modes.cruise_m_s=0"]).contains("modes.cruise_m_s"));
        assert!(refusal("helix", &["modes.cruise_m_s=\"fast\""]).contains("cruise_m_s"));
        assert!(refusal("/nowhere/x.toml", &[]).contains("/nowhere/x.toml"));
    }

    #[test]
    fn numbers_with_which_no_flight_makes_sense_are_refused_by_their_key() {
        for (scenario, setting, culprit) in [
            ("helix", "time_optimal_s=nan", "time_optimal_s"),
            ("helix", "duration_s=0.0001", "duration_s"),
            ("paper-ideal", "duration_s=50000", "duration_s"),
            ("helix", "trajectory.helix.yaw_rad=1e30", "yaw_rad"),
            ("helix", "trajectory.helix.rate_rad_s=1e4", "rate_rad_s"),
            ("helix", "trajectory.helix.base_m=1e38", "base_m"),
            ("helix", "join.duration_s=1e9", "join.duration_s"),
            ("helix", "thrust_to_weight=1e30", "thrust_to_weight"),
            ("helix", "airframe.mass_kg=1e-40", "mass_kg"),
            ("helix", "control.x.lambda=1e38", "control.x"),
            ("paper-disturbed", "duration_s=3", "disturbance"),
            ("paper-disturbed", "disturbance.to_s=4", "disturbance"),
            ("paper-disturbed", "disturbance.hold_s=0.0014", "hold_s"),
            ("paper-disturbed", "disturbance.position_output_m=-0.1", "position_output_m"),
            ("paper-ideal", "ground=true", "ground"),
            ("helix", "truth.mass_factor=0", "truth.mass_factor"),
            ("helix", "truth.inertia_factor=nan", "truth.inertia_factor"),
            ("helix", "truth.rotor_effectiveness=[1,1,1,-1]", "truth.rotor_effectiveness"),
            ("helix", "truth.rotor_effectiveness=[0,0,0,0]", "truth.rotor_effectiveness"),
            ("helix", "truth.rotor_lag_s=-1", "truth.rotor_lag_s"),
            ("helix", "truth.colour=1", "colour"),
            ("helix", "true_mass_kg=1", "true_mass_kg"),
            ("helix", "actuation_delay_s=0.0005", "actuation_delay_s"),
            ("helix", "actuation_delay_s=0.017", "actuation_delay_s"),
            ("helix", "airframe.actuation_delay_s=-0.001", "actuation_delay_s"),
            ("helix", "start_velocity_m_s=[1e3,0,0]", "start_velocity_m_s"),
            ("helix", "start_rates_rad_s=[0,nan,0]", "start_rates_rad_s"),
            ("helix", "tumble={rate_rad_s=-1.0,speed_m_s=0.0}", "tumble.rate_rad_s"),
            ("helix", "wind.turbulence_20ft_m_s=-1", "wind.turbulence_20ft_m_s"),
            ("helix", "wind.airspeed_m_s=0", "wind.airspeed_m_s"),
            ("helix", "wind.mean_m_s=[0,0,inf]", "wind.mean_m_s"),
            ("helix", "wind.gust=[{from_s=1.0,rise_s=0.0,peak_m_s=[1.0,0.0,0.0]}]", "wind.gust.rise_s"),
            ("helix", "wind.gust=[{from_s=1.0,rise_s=1.0,peak_m_s=[1e3,0.0,0.0]}]", "wind.gust.peak_m_s"),
            ("helix", "push=[{from_s=1.0,to_s=1.0}]", "push.to_s"),
            ("helix", "push=[{from_s=1.0,to_s=2.0,acceleration_m_s2=[0.0,nan,0.0]}]", "push.acceleration_m_s2"),
            ("helix", "push=[{from_s=1.0,to_s=2.0,colour=1.0}]", "colour"),
            ("helix", "world.altitude_m=2e4", "world.altitude_m"),
            ("pad", "world.ground_effect=true", "rotor_radius_m"),
            ("pad", "world.ground_height_m=1", "world.ground_height_m"),
            ("helix", "world.ground_height_m=-1", "ground"),
            ("x500-hover", "world.ground_effect=true", "ground"),
            ("helix", "world.rotor_lag_down=true", "rotor_lag_down_s"),
            ("helix", "battery.soc=0.5", "airframe.battery"),
            ("x500-hover", "battery.soc=1.1", "battery.soc"),
            ("x500-hover", "fault=[{kind=\"collapse\",from_s=1.0,to_s=2.0,factor=-1.0}]", "fault.factor"),
            ("x500-hover", "airframe.battery.efficiency=0", "airframe.battery.efficiency"),
            ("x500-hover", "airframe.rotor_radius_m=0", "airframe.rotor_radius_m"),
            ("helix", "fault=[{kind=\"rotor\",index=0,effectiveness=1.0,from_s=-1.0}]", "fault.from_s"),
            ("helix", "fault=[{kind=\"rotor\",index=4,effectiveness=1.0,from_s=1.0}]", "fault.index"),
            ("helix", "sensors=\"gps\"", "gps"),
            ("helix", "command=[{order=\"dance\"}]", "dance"),
            ("helix", "assess={from_s=-1.0}", "assess.from_s"),
            ("helix", "assess={from_s=9.0,to_s=8.0}", "assess.from_s"),
            ("helix", "home.latitude_deg=91", "latitude_deg"),
            ("paper-ideal", "world.altitude_m=100", "world"),
            ("paper-ideal", "push=[{from_s=1.0,to_s=2.0}]", "push"),
            ("paper-ideal", "battery.soc=1", "battery"),
            ("paper-ideal", "fault=[{kind=\"rotor\",index=0,effectiveness=0.0,from_s=1.0}]", "fault"),
            ("paper-ideal", "sensors=\"gnss\"", "sensors"),
            ("paper-ideal", "actuation_delay_s=0.001", "actuation_delay_s"),
            ("paper-ideal", "start_attitude_deg=[10,0,0]", "start_attitude_deg"),
            ("paper-ideal", "wind.mean_m_s=[1,0,0]", "wind"),
            ("paper-ideal", "tumble={rate_rad_s=1.0,speed_m_s=0.0}", "tumble"),
            ("helix", "attitude={amplitude_rad=[1,0,0],rate_rad_s=[1,1,1],phase_rad=[0,0,0]}", "attitude"),
        ] {
            assert!(refusal(scenario, &[setting]).contains(culprit), "{setting}");
        }
    }

    #[test]
    fn a_start_is_either_drawn_or_written_down() {
        let settings = ["tumble={rate_rad_s=1.0,speed_m_s=0.0}", "start_rates_rad_s=[0,0,0]"];
        assert!(refusal("helix", &settings).contains("start_rates_rad_s"));
    }

    #[test]
    fn the_bound_is_not_shown_for_another_problem() {
        let bound = |settings: &[&str]| {
            let settings: Vec<String> = settings.iter().map(|s| (*s).to_owned()).collect();
            Scenario::load("helix", &settings).expect("valid").file.time_optimal_s
        };
        assert_eq!(bound(&["control.x.lambda=3"]), Some(1.31));
        assert_eq!(bound(&["thrust_to_weight=4"]), None);
        assert_eq!(bound(&["truth.mass_factor=1.1"]), None);
        assert_eq!(bound(&["start_velocity_m_s=[1,0,0]"]), None);
    }

    #[test]
    fn a_setting_takes_effect_in_plant_and_firmware() {
        let scenario = Scenario::load("helix", &["airframe.mass_kg=1".to_owned()]).expect("valid");
        assert_eq!(scenario.constants().mass, 1.0);
        assert_eq!(scenario.flight_config().airframe.mass_kg, 1.0);
    }
}
