//! What of a scenario is refused: numbers with which no flight makes sense, each by the key that the user wrote.

use anyhow::{Result, ensure};
use firmware::config::Start;
use firmware::guidance::Trajectory;

use super::orders::commands;
use super::trajectory::flyable;
use super::{AttitudeWave, Disturbance, Gust, PlantKind, Scenario, ScenarioFile, ScheduledPush, Truth, Wind, World};
use crate::airframe::{AirframeFile, ROTOR_LAG_MAX_S, THRUST_TO_WEIGHT};
use crate::plant::air::ALTITUDE_M;
use crate::refusal::{Refusal, after, within};
use crate::sensors::{Fault, SuiteFile};
use crate::sil::DELAY_TICKS_MAX;

/// Greatest length or height, m: beyond it an f32 no longer resolves a decimetre.
const LENGTH_MAX_M: f64 = 1e6;
/// Fastest start and strongest wind, m/s.
const SPEED_MAX_M_S: f64 = 100.0;
/// Fastest turn along a trajectory, rad/s.
const RATE_MAX_RAD_S: f64 = 100.0;
/// Strongest push, m/s² and rad/s².
const ACCELERATION_MAX: f64 = 1e6;
/// Longest flight, s: 11 days.
pub(super) const DURATION_MAX_S: f64 = 1e6;
/// Longest flight on the decoupled plant, s: its steps of 10 µs are counted in 32 bits.
const DECOUPLED_DURATION_MAX_S: f64 = 4e4;

impl Scenario {
    /// Refuses what makes no flight.
    ///
    /// # Errors
    /// The first key that is out of its range.
    pub(super) fn validate(&self) -> Result<()> {
        let f = &self.file;
        optional(f)?;
        self.airframe.validate()?;
        let longest = if f.plant == PlantKind::PaperDecoupled { DECOUPLED_DURATION_MAX_S } else { DURATION_MAX_S };
        within("duration_s", f.duration_s, 1e-3, longest)?;
        whole_milliseconds("duration_s", f.duration_s)?;
        each("start_position_m", &f.start_position_m, LENGTH_MAX_M)?;
        delay(self.airframe.actuation_delay_s)?;
        world(f)?;
        effects(f, &self.airframe)?;
        trajectory(&f.trajectory)?;
        if let Some(d) = &f.disturbance {
            disturbance(d, f.duration_s)?;
        }
        if let Some(wave) = &f.attitude {
            ensure!(
                f.plant == PlantKind::PaperDecoupled,
                "`attitude` is followed on the plant `paper-decoupled` alone: elsewhere it follows from the trajectory"
            );
            attitude(wave)?;
        }
        f.home.validate()?;
        if let Some(assess) = &f.assess {
            assess.validate()?;
        }
        self.controller.validate()?;
        if f.plant == PlantKind::PaperDecoupled {
            self.controller.require_smc("the plant `paper-decoupled`")?;
        }
        super::params::validate(&f.params, &self.unset_config())?;
        let config = self.flight_config();
        firmware::autopilot::Autopilot::new(&config).map_err(Refusal::from)?;
        if let (Trajectory::Spline(path), true) = (&f.trajectory, f.plant != PlantKind::PaperDecoupled) {
            flyable(path, &config)?;
        }
        Ok(())
    }
}

impl ScenarioFile {
    /// The faults, pushes and gusts that begin when the flight has ended. A flight that is shortened may well leave some
    /// out, and `serve` flies on, so that they are no mistake by themselves.
    pub fn too_late(&self) -> Vec<Refusal> {
        let faults = self.fault.iter().enumerate().map(|(i, fault)| (format!("fault.{i}"), fault.from_s));
        let pushes = self.push.iter().enumerate().map(|(i, push)| (format!("push.{i}"), push.from_s));
        let gusts = self.wind.iter().flat_map(|wind| wind.gust.iter().enumerate());
        let gusts = gusts.map(|(i, gust)| (format!("wind.gust.{i}"), gust.from_s));
        let all = faults.chain(pushes).chain(gusts);
        all.filter_map(|(key, from_s)| too_late(&format!("{key}.from_s"), from_s, self.duration_s)).collect()
    }
}

/// What begins at `key` once the flight has ended is refused.
fn too_late(key: &str, from_s: f64, duration_s: f64) -> Option<Refusal> {
    let rule = format!("must be before the end of the flight, `duration_s` = {duration_s}");
    (from_s >= duration_s).then(|| Refusal::new(key, rule).given(from_s))
}

fn optional(f: &ScenarioFile) -> Result<()> {
    for (key, value, low, high) in [
        ("time_optimal_s", f.time_optimal_s, 1e-3, 1e4),
        ("thrust_to_weight", f.thrust_to_weight, THRUST_TO_WEIGHT.0, THRUST_TO_WEIGHT.1),
        ("rotor_lag_s", f.rotor_lag_s, 0.0, ROTOR_LAG_MAX_S),
        ("join.duration_s", f.join.as_ref().map(|join| f64::from(join.duration_s)), 0.01, 1e4),
    ] {
        if let Some(value) = value {
            within(key, value, low, high)?;
        }
    }
    Ok(())
}

/// What is there on the plant `rigid-body` alone, and how far each may go.
fn world(f: &ScenarioFile) -> Result<()> {
    for (key, is_there) in [
        ("ground", f.ground),
        ("truth.rotor_effectiveness", f.truth.rotor_effectiveness != Truth::default().rotor_effectiveness),
        ("truth.rotor_lag_s", f.truth.rotor_lag_s.is_some()),
        ("rotor_lag_s", f.rotor_lag_s.is_some_and(|lag| lag > 0.0)),
        ("actuation_delay_s", f.actuation_delay_s.is_some()),
        ("start_velocity_m_s", f.start_velocity_m_s.is_some()),
        ("start_attitude_deg", f.start_attitude_deg.is_some()),
        ("start_rates_rad_s", f.start_rates_rad_s.is_some()),
        ("tumble", f.tumble.is_some()),
        ("wind", f.wind.is_some()),
        ("push", !f.push.is_empty()),
        ("world", f.world != World::default()),
        ("battery", f.battery.is_some()),
        ("sensors", f.sensors.is_some()),
        ("fault", !f.fault.is_empty()),
        ("command", !f.command.is_empty()),
    ] {
        let plant = f.plant == PlantKind::RigidBody;
        ensure!(
            !is_there || plant,
            "`{key}` is modelled on the plant `rigid-body` alone: leave it out, or fly a scenario on that plant, as `helix`; on the paper's \
             plants `disturbance` acts"
        );
    }
    ensure!(
        f.thrust_to_weight.is_none() || f.plant != PlantKind::PaperDecoupled,
        "`thrust_to_weight` limits nothing on the plant `paper-decoupled`, whose inputs are direct: leave it out, or set \
         `plant = \"rigid-body\"`"
    );
    measured(f)?;
    place_of_start(f)?;
    truth(&f.truth)?;
    start(f)?;
    f.fault.iter().enumerate().try_for_each(|(i, fault)| on_board(i, fault, f.sensors.as_ref()))?;
    commands(f)?;
    f.push.iter().enumerate().try_for_each(|(i, one)| push(&format!("push.{i}"), one))?;
    f.wind.as_ref().map_or(Ok(()), wind)
}

/// Refuses errors of the measured state where no state is measured, but sensors.
fn measured(f: &ScenarioFile) -> Result<()> {
    let (Some(disturbance), Some(_)) = (&f.disturbance, &f.sensors) else { return Ok(()) };
    let given =
        [("position_output_m", disturbance.position_output_m), ("angle_output_rad", disturbance.angle_output_rad)];
    match given.into_iter().find(|(_, sigma)| *sigma != 0.0) {
        Some((key, sigma)) => {
            Err(Refusal::new(format!("disturbance.{key}"), "must be 0 with `sensors`, whose errors are their own")
                .given(sigma)
                .remedy("use a `[[fault]]` of kind `noise`")
                .into())
        }
        None => Ok(()),
    }
}

/// Refuses a start on a ground that is not there, and one in the air of a vehicle that has to align first.
fn place_of_start(f: &ScenarioFile) -> Result<()> {
    let refusal = match f.start {
        Start::OnGround if !f.ground => Refusal::new("start", "is `on-ground`, and there is no ground")
            .remedy("set `ground = true` on the plant `rigid-body`, or `start = \"in-flight\"`"),
        Start::InFlight if f.sensors.is_some() => {
            Refusal::new("sensors", "need a start on the ground, where the estimator aligns at rest").remedy(
                "set `start = \"on-ground\"`, `ground = true` and `[[command]]`s, as `indoor-helix` has them, or leave \
                 `sensors` out",
            )
        }
        _ => return Ok(()),
    };
    Err(refusal.into())
}

/// What acts on the airframe's own figures: whether the airframe has them, and how far each may go.
fn effects(f: &ScenarioFile, airframe: &AirframeFile) -> Result<()> {
    let start_z = f.start_position_m[2];
    let ground_m = f.ground_height_m();
    within("world.ground_height_m", ground_m, -LENGTH_MAX_M, LENGTH_MAX_M)?;
    if ground_m > start_z {
        let rule = format!("must not be above the start, `start_position_m.2` = {start_z}");
        return Err(Refusal::new("world.ground_height_m", rule).given(ground_m).into());
    }
    within("world.altitude_m", f.world.altitude_m.unwrap_or(0.0), ALTITUDE_M.0, ALTITUDE_M.1)?;
    for (key, asked, needs, is_there) in [
        ("world.ground_height_m", f.world.ground_height_m.is_some(), "ground", f.ground),
        ("world.ground_effect", f.world.ground_effect, "ground", f.ground),
        ("world.ground_effect", f.world.ground_effect, "airframe.rotor_radius_m", airframe.rotor_radius_m.is_some()),
        (
            "world.rotor_lag_down",
            f.world.rotor_lag_down,
            "airframe.rotor_lag_down_s",
            airframe.rotor_lag_down_s.is_some(),
        ),
        ("world.rotor_lag_down", f.world.rotor_lag_down, "rotor_lag_s", airframe.rotor_lag_s > 0.0),
        ("battery", f.battery.is_some(), "airframe.battery", airframe.battery.is_some()),
    ] {
        ensure!(!asked || is_there, "`{key}` needs `{needs}`: set it, or leave `{key}` out: --set {key}=false");
    }
    for (key, volts) in [("battery_low_v", f.modes.battery_low_v), ("battery_critical_v", f.modes.battery_critical_v)] {
        if volts > 0.0 && f.battery.is_none() {
            let refusal = Refusal::new(format!("modes.{key}"), "needs a battery").remedy("add a table `[battery]`");
            return Err(refusal.into());
        }
    }
    f.battery.map_or(Ok(()), |battery| within("battery.soc", battery.soc, 0.0, 1.0))
}

/// Refuses a fault of a sensor that the vehicle does not have: nothing would fail.
fn on_board(index: usize, fault: &Fault, suite: Option<&SuiteFile>) -> Result<()> {
    let Some(sensor) = fault.sensor.filter(|sensor| !suite.is_some_and(|suite| suite.has(*sensor))) else {
        return Ok(());
    };
    let rule = format!("is `{}`, which is not on board", sensor.name());
    let remedy = if suite.is_some() { "choose a sensor of `sensors`" } else { "give the vehicle `sensors`" };
    Err(Refusal::new(format!("fault.{index}.sensor"), rule).remedy(remedy).into())
}

fn push(key: &str, push: &ScheduledPush) -> Result<()> {
    period(key, push.from_s, push.to_s)?;
    each(&format!("{key}.acceleration_m_s2"), &push.acceleration_m_s2, ACCELERATION_MAX)?;
    each(&format!("{key}.angular_acceleration_rad_s2"), &push.angular_acceleration_rad_s2, ACCELERATION_MAX)
}

/// Values of an array of which none is further from 0 than `most`.
pub(super) fn each<T: Into<f64> + Copy + std::fmt::Display>(key: &str, values: &[T], most: f64) -> Result<()> {
    values.iter().enumerate().try_for_each(|(i, value)| within(&format!("{key}.{i}"), *value, -most, most))
}

/// A time from which something acts, and one until which it does.
fn period(key: &str, from_s: f64, to_s: f64) -> Result<()> {
    let (from_key, to_key) = (format!("{key}.from_s"), format!("{key}.to_s"));
    within(&from_key, from_s, 0.0, DURATION_MAX_S)?;
    within(&to_key, to_s, 0.0, 2.0 * DURATION_MAX_S)?;
    after((&from_key, from_s), (&to_key, to_s))
}

fn truth(truth: &Truth) -> Result<()> {
    within("truth.mass_factor", truth.mass_factor, 0.01, 100.0)?;
    within("truth.inertia_factor", truth.inertia_factor, 0.01, 100.0)?;
    for (i, part) in truth.rotor_effectiveness.into_iter().enumerate() {
        within(&format!("truth.rotor_effectiveness.{i}"), part, 0.0, 10.0)?;
    }
    ensure!(
        truth.rotor_effectiveness.iter().any(|part| *part >= 0.01),
        "`truth.rotor_effectiveness` must leave a rotor that lifts"
    );
    within("truth.rotor_lag_s", truth.rotor_lag_s.unwrap_or(0.0), 0.0, ROTOR_LAG_MAX_S)
}

fn start(f: &ScenarioFile) -> Result<()> {
    for (key, values, most) in [
        ("start_velocity_m_s", f.start_velocity_m_s, SPEED_MAX_M_S),
        ("start_attitude_deg", f.start_attitude_deg, 360.0),
        ("start_rates_rad_s", f.start_rates_rad_s, RATE_MAX_RAD_S),
    ] {
        values.map_or(Ok(()), |values| each(key, &values, most))?;
    }
    let Some(tumble) = &f.tumble else { return Ok(()) };
    ensure!(
        !f.has_start_motion(),
        "`tumble` draws the whole motion at the start: leave out either it, or `start_velocity_m_s`, \
         `start_attitude_deg` and `start_rates_rad_s`"
    );
    within("tumble.rate_rad_s", tumble.rate_rad_s, 0.0, RATE_MAX_RAD_S)?;
    within("tumble.speed_m_s", tumble.speed_m_s, 0.0, SPEED_MAX_M_S)
}

fn wind(wind: &Wind) -> Result<()> {
    each("wind.mean_m_s", &wind.mean_m_s, SPEED_MAX_M_S)?;
    within("wind.turbulence_20ft_m_s", wind.turbulence_20ft_m_s, 0.0, SPEED_MAX_M_S)?;
    within("wind.altitude_m", wind.altitude_m, 0.0, LENGTH_MAX_M)?;
    within("wind.airspeed_m_s", wind.airspeed_m_s.unwrap_or(1.0), 0.01, SPEED_MAX_M_S)?;
    wind.gust.iter().enumerate().try_for_each(|(i, one)| gust(&format!("wind.gust.{i}"), one))
}

fn gust(key: &str, gust: &Gust) -> Result<()> {
    within(&format!("{key}.from_s"), gust.from_s, 0.0, DURATION_MAX_S)?;
    within(&format!("{key}.rise_s"), gust.rise_s, 1e-3, DURATION_MAX_S)?;
    within(&format!("{key}.hold_s"), gust.hold_s, 0.0, DURATION_MAX_S)?;
    each(&format!("{key}.peak_m_s"), &gust.peak_m_s, SPEED_MAX_M_S)
}

fn delay(seconds: f64) -> Result<()> {
    within("actuation_delay_s", seconds, 0.0, DELAY_TICKS_MAX as f64 * 1e-3)?;
    whole_milliseconds("actuation_delay_s", seconds)
}

fn whole_milliseconds(key: &str, seconds: f64) -> Result<()> {
    let ticks = seconds * 1e3;
    if (ticks - ticks.round()).abs() < 1e-6 {
        return Ok(());
    }
    Err(Refusal::new(key, "must be whole milliseconds").given(format!("{seconds} s")).into())
}

fn trajectory(trajectory: &Trajectory) -> Result<()> {
    match *trajectory {
        Trajectory::Hold { position_m, yaw_rad } => {
            lengths("trajectory.hold.position_m", &position_m)?;
            yaw("trajectory.hold.yaw_rad", yaw_rad)
        }
        Trajectory::Step { from_m, to_m, at_s, yaw_rad } => {
            lengths("trajectory.step.from_m", &from_m)?;
            lengths("trajectory.step.to_m", &to_m)?;
            within("trajectory.step.at_s", at_s, 0.0, DURATION_MAX_S)?;
            yaw("trajectory.step.yaw_rad", yaw_rad)
        }
        Trajectory::Helix { amplitude_m, rate_rad_s, base_m, climb_m_s, yaw_rad } => {
            lengths("trajectory.helix.amplitude_m", &amplitude_m)?;
            within("trajectory.helix.base_m", base_m, -LENGTH_MAX_M, LENGTH_MAX_M)?;
            within("trajectory.helix.climb_m_s", climb_m_s, -100.0, 100.0)?;
            rate("trajectory.helix.rate_rad_s", rate_rad_s)?;
            yaw("trajectory.helix.yaw_rad", yaw_rad)
        }
        Trajectory::FigureEight { center_m, amplitude_m, rate_rad_s, yaw_rad } => {
            lengths("trajectory.figure-eight.center_m", &center_m)?;
            lengths("trajectory.figure-eight.amplitude_m", &amplitude_m)?;
            rate("trajectory.figure-eight.rate_rad_s", rate_rad_s)?;
            yaw("trajectory.figure-eight.yaw_rad", yaw_rad)
        }
        Trajectory::Spline(ref path) => {
            path.control_points.iter().try_for_each(|point| lengths("trajectory.spline.control_points", point))
        }
    }
}

fn lengths(key: &str, values: &[f32]) -> Result<()> {
    each(key, values, LENGTH_MAX_M)
}

fn rate(key: &str, value: f32) -> Result<()> {
    within(key, value, -RATE_MAX_RAD_S, RATE_MAX_RAD_S)
}

fn yaw(key: &str, value: f32) -> Result<()> {
    // A turn either way, and no more decimals in the message than anyone would write.
    within(key, value, -6.3, 6.3)
}

fn disturbance(d: &Disturbance, duration_s: f64) -> Result<()> {
    for (key, value) in [
        ("acceleration_m_s2", d.acceleration_m_s2),
        ("angular_acceleration_rad_s2", d.angular_acceleration_rad_s2),
        ("position_output_m", d.position_output_m),
        ("angle_output_rad", d.angle_output_rad),
    ] {
        within(&format!("disturbance.{key}"), value, 0.0, 1e9)?;
    }
    if let Some(late) = too_late("disturbance.from_s", d.from_s, duration_s) {
        return Err(late.into());
    }
    period("disturbance", d.from_s, d.to_s)?;
    within("disturbance.hold_s", d.hold_s, 1e-3, 1e3)?;
    whole_milliseconds("disturbance.hold_s", d.hold_s)
}

fn attitude(wave: &AttitudeWave) -> Result<()> {
    each("attitude.amplitude_rad", &wave.amplitude_rad, 10.0)?;
    // Euler angles go no further.
    within("attitude.amplitude_rad.1", wave.amplitude_rad[1], -1.5, 1.5)?;
    each("attitude.rate_rad_s", &wave.rate_rad_s, 1e3)?;
    each("attitude.phase_rad", &wave.phase_rad, 100.0)
}
