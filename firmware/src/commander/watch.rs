//! What the commander believes of the vehicle over several jobs: what of the motion is lost, how the battery stands,
//! and whether it touches the ground.

use super::checks::is_slow;
use super::{CommanderInput, Known};
use crate::config::ModeSettings;
use crate::math;
use crate::schedule::COMMANDER;
use crate::signals::TICK_S;

/// Jobs in a time.
pub(super) const fn jobs(seconds: f32) -> u16 {
    (seconds / (COMMANDER.period as f32 * TICK_S) + 0.5) as u16
}

/// Counts the jobs for which something has been true without a break.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Persistence {
    jobs: u16,
}

impl Persistence {
    /// True once it has been so for as long.
    fn step(&mut self, is_so: bool, long: u16) -> bool {
        self.jobs = if is_so { self.jobs.saturating_add(1) } else { 0 };
        self.jobs >= long
    }
}

/// A position or velocity that does not come back within this time is lost, s: until then, it is carried forward.
const LOST_AFTER_S: f32 = 1.0;
/// The same for a height, s: what is wrong upwards meets the ground sooner.
const HEIGHT_LOST_AFTER_S: f32 = 0.5;
/// The same for an attitude, s.
const ATTITUDE_LOST_AFTER_S: f32 = 0.1;
/// Without a sample for this long, the attitude is no more what it was and control does harm, s.
const GONE_AFTER_S: f32 = 2.0;

/// What of the motion is lost.
#[derive(Clone, Debug, Default)]
pub(super) struct NavWatch {
    position: Persistence,
    velocity: Persistence,
    height: Persistence,
    attitude: Persistence,
    climb: Persistence,
    samples: Persistence,
    /// What is known, a loss counted once it has lasted.
    known: Option<Known>,
    gone: bool,
}

impl NavWatch {
    pub(super) fn step(&mut self, input: &CommanderInput) {
        let health = &input.health;
        let attitude = self.attitude.step(!health.attitude, jobs(ATTITUDE_LOST_AFTER_S));
        let height = self.height.step(!health.height, jobs(HEIGHT_LOST_AFTER_S));
        let velocity = self.velocity.step(!health.velocity, jobs(LOST_AFTER_S));
        let position = self.position.step(!health.position, jobs(LOST_AFTER_S));
        self.gone = self.samples.step(!input.nav_fresh, jobs(GONE_AFTER_S));
        let climb = self.climb.step(!health.climb, jobs(HEIGHT_LOST_AFTER_S));
        self.known = Some(if !input.nav_fresh || attitude || (height && climb) {
            Known::Attitude
        } else if height {
            Known::Climb
        } else if velocity {
            Known::Height
        } else if position {
            Known::Velocity
        } else {
            Known::Position
        });
    }

    /// How much of the motion is known.
    pub(super) fn known(&self) -> Known {
        self.known.unwrap_or(Known::Position)
    }

    /// True if samples have not come for so long that nothing can be controlled.
    pub(super) fn is_gone(&self) -> bool {
        self.gone
    }
}

/// A voltage counts once it has lasted, s: it dips with every climb.
const VOLTAGE_LASTS_S: f32 = 2.0;

/// How the battery stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Charge {
    /// Enough, or not watched.
    #[default]
    Good,
    /// Enough to return.
    Low,
    /// Enough to land.
    Critical,
}

/// The battery's voltage over time. It does not recover in flight: what has been low stays so until it is disarmed.
#[derive(Clone, Debug, Default)]
pub(super) struct BatteryWatch {
    low: Persistence,
    critical: Persistence,
    charge: Charge,
}

impl BatteryWatch {
    pub(super) fn step(&mut self, input: &CommanderInput, settings: &ModeSettings) {
        // A voltage that is not a number is not low.
        let below = |limit: f32| input.battery.is_some_and(|battery| battery.voltage_v < limit);
        let low = self.low.step(below(settings.battery_low_v), jobs(VOLTAGE_LASTS_S));
        let critical = self.critical.step(below(settings.battery_critical_v), jobs(VOLTAGE_LASTS_S));
        let now = if critical {
            Charge::Critical
        } else if low {
            Charge::Low
        } else {
            Charge::Good
        };
        self.charge = self.charge.max(now);
    }

    pub(super) fn charge(&self) -> Charge {
        self.charge
    }

    pub(super) fn forget(&mut self) {
        *self = Self::default();
    }
}

/// Higher than this over where it stood, m, the vehicle flies.
const LIFT_OFF_M: f32 = 0.15;
/// So does one that gives this part of its weight for [`LIFT_OFF_S`], whatever its height is believed to be.
const LIFT_OFF_THRUST: f32 = 0.85;
const LIFT_OFF_S: f32 = 0.5;
/// A vehicle that is told to descend, gives less than this part of its weight and does not fall, stands.
const STANDING_THRUST: f32 = 0.55;
const STANDING_M_S: f32 = 0.3;
const STANDING_S: f32 = 0.5;
/// So does one that gives less than all of it and has not moved at all for longer.
const RESTING_THRUST: f32 = 0.95;
const RESTING_M_S: f32 = 0.1;
const RESTING_S: f32 = 2.0;

/// Whether the vehicle touches the ground.
#[derive(Clone, Debug)]
pub(super) struct GroundWatch {
    airborne: bool,
    /// Where it stood, m.
    ground_m: f32,
    lifting: Persistence,
    standing: Persistence,
    resting: Persistence,
    at_rest: Persistence,
}

impl GroundWatch {
    pub(super) fn new(airborne: bool, ground_m: f32) -> Self {
        let none = Persistence::default();
        Self { airborne, ground_m, lifting: none, standing: none, resting: none, at_rest: none }
    }

    /// With rotors that stand still or idle: it is on the ground once it has come to rest.
    pub(super) fn step_idle(&mut self, input: &CommanderInput) {
        if self.at_rest.step(is_slow(&input.nav), jobs(STANDING_S)) || !self.airborne {
            *self = Self::new(false, input.nav.position.z);
        }
    }

    /// With rotors that carry; if the vehicle is told to descend, with what is known of the motion. Without its height,
    /// whether it moves is not known, and it is never taken to have landed.
    pub(super) fn step_flying(&mut self, input: &CommanderInput, weight_n: f32, descends: Option<Known>) {
        let descend = descends.is_some_and(|known| known <= Known::Climb);
        let thrust = input.thrust_n / weight_n;
        let lifting = self.lifting.step(thrust > LIFT_OFF_THRUST, jobs(LIFT_OFF_S));
        self.airborne |= lifting || input.nav.position.z - self.ground_m > LIFT_OFF_M;
        let vertical = math::abs(input.nav.velocity.z);
        let standing = descend && thrust < STANDING_THRUST && vertical < STANDING_M_S;
        let resting = descend && thrust < RESTING_THRUST && vertical < RESTING_M_S;
        let stands = self.standing.step(standing, jobs(STANDING_S)) | self.resting.step(resting, jobs(RESTING_S));
        if stands || (descends.is_some() && !self.airborne) {
            *self = Self::new(false, input.nav.position.z);
        }
    }

    pub(super) fn is_airborne(&self) -> bool {
        self.airborne
    }
}
