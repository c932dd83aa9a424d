//! From a scenario to a flight: builds plant and firmware, and runs them.

use anyhow::{Result, anyhow};
use firmware::autopilot::Autopilot;
use nalgebra::Vector3;

use crate::decoupled::Decoupled;
use crate::noise::Noise;
use crate::plant::ground::Ground;
use crate::plant::paper::PaperPlant;
use crate::plant::rigid_body::RigidBody;
use crate::plant::{Constants, Plant};
use crate::record::Recorder;
use crate::scenario::{PlantKind, Scenario};
use crate::sil::{Flight, Outcome};

/// The rigid-body plant of a scenario.
pub fn rigid_body(scenario: &Scenario) -> RigidBody {
    let constants = scenario.constants();
    let position = Vector3::from(scenario.file.start_position_m);
    let on = |c: &Constants| Ground::for_vehicle(position.z, c.mass, c.gravity, c.inertia.z);
    let ground = scenario.file.ground.then(|| on(&constants));
    RigidBody::new(constants, ground, position)
}

/// A plant with the firmware of a scenario in its loop.
///
/// # Errors
/// What of the scenario the firmware refuses.
pub fn lockstep<P: Plant>(scenario: &Scenario, seed: u64, plant: P) -> Result<Flight<P>> {
    let config = scenario.flight_config();
    let autopilot = Autopilot::new(&config).map_err(|error| anyhow!("scenario `{}`: {error}", scenario.name))?;
    let noise = Noise::new(scenario.file.disturbance.as_ref(), seed, 1000.0);
    Ok(Flight::new(autopilot, plant, noise, config.trajectory))
}

/// Flies a scenario to its end, or until the vehicle is lost.
///
/// # Errors
/// What of the scenario the firmware refuses.
pub fn fly(scenario: &Scenario, seed: u64, recorder: &mut impl Recorder) -> Result<Outcome> {
    let ticks = scenario.ticks();
    Ok(match scenario.file.plant {
        PlantKind::RigidBody => lockstep(scenario, seed, rigid_body(scenario))?.run(ticks, recorder),
        PlantKind::Paper => {
            let plant = PaperPlant::new(scenario.constants(), Vector3::from(scenario.file.start_position_m));
            lockstep(scenario, seed, plant)?.run(ticks, recorder)
        }
        PlantKind::PaperDecoupled => Decoupled::new(scenario, seed)?.run(ticks, recorder),
    })
}
