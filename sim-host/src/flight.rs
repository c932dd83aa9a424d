//! From a scenario to a flight: builds plant and firmware, and runs them in lockstep.

use anyhow::{Result, anyhow};
use firmware::autopilot::Autopilot;
use firmware::control::attitude::SlidingAttitude;
use firmware::control::law::{AttitudeLaw, PositionLaw};
use firmware::control::position::SlidingPosition;
use nalgebra::Vector3;

use crate::assess::{Assess, Assessor, Measures};
use crate::baseline::geometric::{GeometricAttitude, GeometricPosition};
use crate::baseline::indi::{IndiAttitude, IndiPosition};
use crate::baseline::pid::{PidAttitude, PidPosition};
use crate::controller::Controller;
use crate::decoupled::Decoupled;
use crate::noise::Noise;
use crate::pilot::{Command, Order, Pilot};
use crate::plant::Plant;
use crate::plant::ground::Ground;
use crate::plant::paper::PaperPlant;
use crate::plant::rigid_body::RigidBody;
use crate::record::Recorder;
use crate::scenario::{PlantKind, Scenario};
use crate::sensors::Suite;
use crate::sil::replay::Replay;
use crate::sil::{AnyFlight, Flight, Lockstep as _, Outcome, Restart, UnderLaws};
use crate::touchdown::Touchdown;
use crate::weather::Weather;

/// The rigid-body plant of a scenario, in the initial motion under `seed`.
pub fn rigid_body(scenario: &Scenario, seed: u64) -> RigidBody {
    let position = Vector3::from(scenario.file.start_position_m);
    let plant =
        RigidBody::new(scenario.constants(), ground(scenario), position).with_motion(scenario.file.start_motion(seed));
    match scenario.effects() {
        Some(effects) => plant.with_effects(effects),
        None => plant,
    }
}

/// The ground of a scenario, if any.
pub fn ground(scenario: &Scenario) -> Option<Ground> {
    let (file, c) = (&scenario.file, scenario.constants());
    file.ground.then(|| Ground::for_vehicle(file.ground_height_m(), c.mass, c.gravity, c.inertia.z))
}

/// A plant with the firmware of a scenario in its loop, flying by its own sliding mode laws.
///
/// # Errors
/// The firmware refuses the configuration: the first field that is out of range, or that it asks for another
/// controller.
pub fn lockstep<P: Plant>(scenario: &Scenario, seed: u64, plant: P) -> Result<Flight<P>> {
    scenario.controller.require_smc("this command")?;
    let config = scenario.flight_config();
    let attitude = SlidingAttitude::new(&config.airframe, &config.attitude);
    let position = SlidingPosition::new(&config.airframe, &config.position);
    let restart = Restart { config, build: |config, settings, ports| Autopilot::on(config, settings, ports).ok() };
    Ok(with_laws(scenario, seed, plant, attitude, position)?.with_restart(restart))
}

/// The same with other control laws.
///
/// # Errors
/// The firmware refuses the configuration: the first field that is out of range.
pub fn with_laws<P: Plant, A: AttitudeLaw, L: PositionLaw>(
    scenario: &Scenario,
    seed: u64,
    plant: P,
    attitude: A,
    position: L,
) -> Result<Flight<P, A, L>> {
    let config = scenario.flight_config();
    let autopilot = Autopilot::with_laws(&config, attitude, position)
        .map_err(|error| anyhow!("scenario `{}`: {error}", scenario.name))?
        .with_settings(scenario.settings());
    let noise = Noise::new(scenario.file.disturbance.as_ref(), seed, 1000.0);
    let flight = Flight::new(autopilot, plant, noise, config.trajectory.clone());
    let flight = flight.with_actuation_delay(scenario.actuation_delay_ticks());
    let file = &scenario.file;
    let sensors = file.sensors.as_ref().map(|suite| Suite::new(suite, &file.home, &file.fault, seed));
    let pilot = (!file.command.is_empty()).then(|| Pilot::new(&file.command));
    let replay = scenario.replay.clone().map(Replay::new);
    Ok(flight.with_weather(weather(scenario, seed)).with_sensors(sensors).with_pilot(pilot).with_replay(replay))
}

/// A scenario's flight, before its first tick.
///
/// # Errors
/// The firmware refuses the configuration: the first field that is out of range.
pub fn prepare(scenario: &Scenario, seed: u64) -> Result<AnyFlight> {
    Ok(match scenario.file.plant {
        PlantKind::RigidBody => AnyFlight::RigidBody(under_laws(scenario, seed, rigid_body(scenario, seed))?),
        PlantKind::Paper => {
            let plant = PaperPlant::new(scenario.constants(), Vector3::from(scenario.file.start_position_m));
            AnyFlight::Paper(under_laws(scenario, seed, plant)?)
        }
        PlantKind::PaperDecoupled => AnyFlight::Decoupled(Box::new(decoupled(scenario, seed)?)),
    })
}

/// The paper's block diagram with a scenario's trajectory and gains.
///
/// # Errors
/// The firmware refuses the trajectory.
pub fn decoupled(scenario: &Scenario, seed: u64) -> Result<Decoupled> {
    let file = &scenario.file;
    let start = Vector3::from(file.start_position_m);
    let decoupled = Decoupled::new(scenario.constants(), &scenario.flight_config(), start)?;
    Ok(decoupled.with_attitude(file.attitude).with_disturbance(file.disturbance.as_ref(), seed))
}

/// A scenario's wind and pushes under a seed, if it has any.
pub fn weather(scenario: &Scenario, seed: u64) -> Option<Weather> {
    let constants = scenario.constants();
    Weather::new(scenario.file.wind.as_ref(), &scenario.file.push, constants.drag / constants.mass, seed)
}

/// A plant with the firmware in its loop, flying by a scenario's control laws.
fn under_laws<P: Plant>(scenario: &Scenario, seed: u64, plant: P) -> Result<UnderLaws<P>> {
    let airframe = scenario.airframe.flight();
    Ok(match &scenario.controller {
        Controller::Smc(_) => UnderLaws::Smc(Box::new(lockstep(scenario, seed, plant)?)),
        Controller::Pid(gains) => {
            let (inner, outer) = (PidAttitude::new(&airframe, gains), PidPosition::new(&airframe, gains));
            UnderLaws::Pid(Box::new(with_laws(scenario, seed, plant, inner, outer)?))
        }
        Controller::Geometric(gains) => {
            let (inner, outer) = (GeometricAttitude::new(&airframe, gains), GeometricPosition::new(&airframe, gains));
            UnderLaws::Geometric(Box::new(with_laws(scenario, seed, plant, inner, outer)?))
        }
        Controller::Indi(gains) => {
            let (inner, outer) = (IndiAttitude::new(&airframe, gains), IndiPosition::new(&airframe, gains));
            UnderLaws::Indi(Box::new(with_laws(scenario, seed, plant, inner, outer)?))
        }
    })
}

/// Flies a scenario to its end, or until the vehicle is lost.
///
/// # Errors
/// The firmware refuses the configuration: the first field that is out of range.
pub fn fly(scenario: &Scenario, seed: u64, recorder: &mut impl Recorder) -> Result<Outcome> {
    let mut touchdown = ground(scenario).map(Touchdown::new);
    let outcome = prepare(scenario, seed)?.run(scenario.ticks(), &mut (recorder, &mut touchdown));
    Ok(outcome.after(touchdown.as_ref()))
}

/// Flies a scenario to its end, and returns the measures of its assessment.
///
/// # Errors
/// The firmware refuses the configuration: the first field that is out of range.
pub fn assess(scenario: &Scenario, assess: &Assess, seed: u64) -> Result<Measures> {
    let file = &scenario.file;
    let place = |command: &Command| match command.order {
        Order::GoTo { position_m, .. } => Some(Vector3::from(position_m).cast()),
        _ => None,
    };
    let places: Vec<_> = file.command.iter().filter_map(place).collect();
    let start = Vector3::from(file.start_position_m);
    let ground = rigid_body(scenario, seed).ground().cloned();
    let mut assessor = Assessor::new(assess, file.duration_s, &start, ground, &places);
    let outcome = fly(scenario, seed, &mut assessor)?;
    Ok(assessor.finish(!outcome.end.is_lost()))
}
