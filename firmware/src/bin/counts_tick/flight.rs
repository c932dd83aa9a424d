//! The inner task's tick as a whole, in a flight on sensors with an open link: what control, navigation, the mailboxes of
//! all partitions and the gates of the links' rings cost together.

use core::hint::black_box;

use firmware::autopilot::Autopilot;
use firmware::board::mps2::counter::Counter;
use firmware::commander::Request;
use firmware::config::{FlightConfig, Start};
use firmware::estimator::EstimatorSettings;
use firmware::math;
use firmware::mavlink::port::Profile;
use firmware::signals::{NavState, SensorFrame, Tick};
use firmware::validate::ConfigError;
use nalgebra::Vector3;

use crate::plant::Plant;
use crate::sensors::Sensors;
use crate::tally::Tally;
use crate::vehicle;

/// When it is armed and takes off: by then the estimator has aligned and found its position.
const TAKE_OFF_AT: Tick = 8_000;
/// From when to when ticks are counted: it holds its height.
const COUNTED: core::ops::Range<Tick> = 14_000..16_000;
/// Where it then is, over the ground, m.
const HEIGHT_M: f32 = 2.5;

/// Instruction counts of the inner task's tick.
#[derive(Default)]
pub(crate) struct TickCounts {
    /// All ticks.
    pub(crate) all: Tally,
    /// Those that release no partition.
    pub(crate) alone: Tally,
    /// Distance from where it was told to hold at the end, m: shows that the flight was valid.
    pub(crate) final_error_m: f32,
}

/// An empty function that marks the beginning of a tick (see `counter`).
#[inline(never)]
extern "C" fn mark_begin_tick() {
    black_box(());
}

/// Takes off, holds, and counts.
///
/// # Errors
/// The field of the configuration that is invalid.
pub(crate) fn fly(counter: Counter) -> Result<TickCounts, ConfigError> {
    let ground = FlightConfig::default();
    let config = FlightConfig {
        start: Start::OnGround,
        start_position_m: [0.0; 3],
        trajectory: ground.trajectory,
        join: ground.join,
        estimator: Some(EstimatorSettings::default()),
        ..vehicle::config()
    };
    let (mut plant, mut sensors) = (Plant::new(&config.airframe, NavState::at_rest()), Sensors::new());
    let mut pilot = Autopilot::new(&config)?;
    pilot.ports.first().open(Profile::Normal);
    let mut counts = TickCounts::default();
    for tick in 0..COUNTED.end {
        if tick == TAKE_OFF_AT {
            // There is room for both.
            let _ = pilot.inner.request(Request::Arm { force: false });
            let _ = pilot.inner.request(Request::TakeOff { height_m: HEIGHT_M });
        }
        let measured = sensors.measure(tick, &plant.nav, &plant.specific_force);
        let instructions = step(counter, &mut pilot, &SensorFrame::Measured(measured));
        if COUNTED.contains(&tick) {
            counts.all.add(instructions);
            if tick % 2 == 1 {
                counts.alone.add(instructions);
            }
        }
        plant.step(&pilot.inner.inner_output().motors);
        stand_on_the_ground(&mut plant, config.airframe.gravity_m_s2);
    }
    let away = plant.nav.position - Vector3::new(0.0, 0.0, HEIGHT_M);
    counts.final_error_m = math::sqrt(away.norm_squared());
    Ok(counts)
}

/// A ground at height zero that takes every speed.
fn stand_on_the_ground(plant: &mut Plant, gravity_m_s2: f32) {
    let nav = &mut plant.nav;
    if nav.position.z <= 0.0 && nav.velocity.z <= 0.0 {
        nav.position.z = 0.0;
        nav.velocity = Vector3::zeros();
        nav.rates = Vector3::zeros();
        plant.specific_force = nav.attitude.inverse() * (Vector3::z() * gravity_m_s2);
    }
}

/// One tick of the inner task, which is counted, and of those that it releases, as `Autopilot::tick` does it.
#[inline(never)]
fn step(counter: Counter, pilot: &mut Autopilot, sample: &SensorFrame) -> u32 {
    let Autopilot { inner, mail, ports, .. } = pilot;
    let (task, boxes, gates, sample) = black_box((&mut *inner, &mut *mail, &*ports, Some(sample)));
    let (instructions, released) = counter.count(mark_begin_tick, || black_box(task.tick(boxes, gates, sample)));
    pilot.run(released);
    // The line takes what is to be sent.
    let _ = pilot.ports.first().take(&mut [0; 512]);
    instructions
}
