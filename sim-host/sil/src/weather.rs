//! Wind and scheduled pushes on the vehicle, in addition to the disturbance.

use core::ops::Range;

use firmware::signals::TICK_S_EXACT;
use nalgebra::Vector3;

use crate::noise::dryden::Wind;
use crate::plant::Push;
use crate::world::{self, ScheduledPush};

/// The pushes of a flight. Drag is linear in the velocity through the air, ρ/ρ0 k∘(v − w)/m, so that a wind w is the
/// same as an acceleration of ρ/ρ0 k∘w/m.
#[derive(Clone, Debug)]
pub struct Weather {
    wind: Option<Wind>,
    /// k1..k3 over m, 1/s.
    drag: Vector3<f64>,
    scheduled: Vec<(Range<u32>, Push)>,
    /// The sum of this tick.
    sum: Push,
}

impl Weather {
    /// A wind under a seed, and pushes, on a plant with this drag (k1..k3 over m, 1/s); nothing if there are none.
    pub fn new(wind: Option<&world::Wind>, pushes: &[ScheduledPush], drag: Vector3<f64>, seed: u64) -> Option<Self> {
        (wind.is_some() || !pushes.is_empty()).then(|| Self {
            wind: wind.map(|wind| Wind::new(wind, seed, TICK_S_EXACT)),
            drag,
            scheduled: pushes.iter().map(scheduled).collect(),
            sum: Push::default(),
        })
    }

    /// Calm air, for a plant with this drag (k1..k3 over m, 1/s).
    pub fn calm(drag: Vector3<f64>) -> Self {
        Self { wind: None, drag, scheduled: Vec::new(), sum: Push::default() }
    }

    /// The steady part of the wind, in the world, m/s.
    pub fn steady_wind(&self) -> Vector3<f64> {
        self.wind.as_ref().map_or_else(Vector3::zeros, Wind::mean)
    }

    /// Sets the steady part of the wind (m/s, in the world); turbulence, gusts and pushes stay as they are.
    pub fn set_steady_wind(&mut self, mean: Vector3<f64>) {
        let calm = || Wind::new(&world::Wind::default(), 0, TICK_S_EXACT);
        self.wind.get_or_insert_with(calm).set_mean(mean);
    }

    /// A tick's push with the wind and the schedule added, in air of a density (ρ/ρ0). To be asked for once a tick. Out
    /// of the way of the flights without.
    #[cold]
    pub fn add(&mut self, push: &Push, tick: u32, density: f64) -> &Push {
        self.sum = *push;
        if let Some(wind) = &mut self.wind {
            self.sum.acceleration += self.drag.component_mul(&wind.sample()) * density;
        }
        for (_, push) in self.scheduled.iter().filter(|(ticks, _)| ticks.contains(&tick)) {
            self.sum.acceleration += push.acceleration;
            self.sum.angular_acceleration += push.angular_acceleration;
        }
        &self.sum
    }

    /// The sum of the last call.
    pub fn now(&self) -> &Push {
        &self.sum
    }
}

/// A scheduled push.
fn scheduled(push: &ScheduledPush) -> (Range<u32>, Push) {
    let tick = |seconds: f64| (seconds / TICK_S_EXACT).round() as u32;
    let acts = Push {
        acceleration: push.acceleration_m_s2.into(),
        angular_acceleration: push.angular_acceleration_rad_s2.into(),
    };
    (tick(push.from_s)..tick(push.to_s), acts)
}
