//! Conditions that are judged over several jobs: loss of navigation, battery charge, lift-off and touchdown.

use super::checks::is_slow;
use super::{CommanderInput, Known};
use crate::config::ModeSettings;
use crate::math;
use crate::schedule::COMMANDER;
use crate::signals::{NavHealth, TICK_S};
use nalgebra::Vector3;

/// Number of commander jobs in a time.
pub(super) const fn jobs(seconds: f32) -> u16 {
    (seconds / (COMMANDER.period as f32 * TICK_S) + 0.5) as u16
}

/// Counts the consecutive jobs for which a condition has been true.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Persistence {
    jobs: u16,
}

impl Persistence {
    /// Takes the condition of a job; true once it has held for `long` jobs.
    fn step(&mut self, condition: bool, long: u16) -> bool {
        self.jobs = if condition { self.jobs.saturating_add(1) } else { 0 };
        self.jobs >= long
    }
}

/// A position or velocity that stays invalid for this long is lost, s. Until then the estimator's prediction is good
/// enough.
const LOST_AFTER_S: f32 = 1.0;
/// The same for the height, s: shorter, because a vertical error ends in the ground.
const HEIGHT_LOST_AFTER_S: f32 = 0.5;
/// The same for the attitude, s: shorter still, because thrust in a wrong direction accelerates the vehicle at once.
const ATTITUDE_LOST_AFTER_S: f32 = 0.1;
/// After this time without a sample the attitude may be anything, and control does more harm than good, s.
const GONE_AFTER_S: f32 = 2.0;

/// Detects the loss of navigation.
#[derive(Clone, Debug, Default)]
pub(super) struct NavWatch {
    position: Persistence,
    velocity: Persistence,
    height: Persistence,
    attitude: Persistence,
    climb: Persistence,
    samples: Persistence,
    /// What is known, after persistent losses.
    known: Option<Known>,
    gone: bool,
}

impl NavWatch {
    pub(super) fn step(&mut self, input: &CommanderInput) {
        let health = &input.health;
        let lasting = NavHealth {
            attitude: !self.attitude.step(!health.attitude, jobs(ATTITUDE_LOST_AFTER_S)),
            heading: health.heading,
            velocity: !self.velocity.step(!health.velocity, jobs(LOST_AFTER_S)),
            position: !self.position.step(!health.position, jobs(LOST_AFTER_S)),
            height: !self.height.step(!health.height, jobs(HEIGHT_LOST_AFTER_S)),
            climb: !self.climb.step(!health.climb, jobs(HEIGHT_LOST_AFTER_S)),
        };
        self.gone = self.samples.step(!input.nav_fresh, jobs(GONE_AFTER_S));
        self.known = Some(if input.nav_fresh { Known::of(&lasting) } else { Known::Attitude });
    }

    /// How much of the motion is known.
    pub(super) fn known(&self) -> Known {
        self.known.unwrap_or(Known::Position)
    }

    /// True if samples have been missing for so long that nothing can be controlled.
    pub(super) fn is_gone(&self) -> bool {
        self.gone
    }
}

/// A low voltage must persist for this long, s: it dips briefly with every climb.
const VOLTAGE_LASTS_S: f32 = 2.0;

/// Charge of the battery.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Charge {
    /// Good, or not monitored.
    #[default]
    Good,
    /// Enough to return.
    Low,
    /// Enough to land.
    Critical,
}

/// A battery counts as replaced above this multiple of the limit that it fell below, for [`VOLTAGE_LASTS_S`]. Without load
/// an empty cell recovers from 3.3 V to 3.6 V at most, by 9 %.
const REPLACED: f32 = 1.12;

/// Monitors the battery voltage. A battery does not recover in flight, and without load it only seems to: a level that
/// was reached while armed holds, also after disarming, until the battery has been replaced. While disarmed a new level
/// does not hold: a monitor that is not connected yet reads anything.
#[derive(Clone, Debug, Default)]
pub(super) struct BatteryWatch {
    low: Persistence,
    critical: Persistence,
    replaced: Persistence,
    /// Reached while armed.
    held: Charge,
    /// Held, or lower.
    charge: Charge,
}

impl BatteryWatch {
    pub(super) fn step(&mut self, input: &CommanderInput, settings: &ModeSettings, armed: bool) {
        // NaN is neither below nor above any limit.
        let voltage = input.battery.map_or(f32::NAN, |battery| battery.voltage_v);
        let (low_v, critical_v) = (settings.battery_low_v, settings.battery_critical_v);
        let low = self.low.step(voltage < low_v, jobs(VOLTAGE_LASTS_S));
        let critical = self.critical.step(voltage < critical_v, jobs(VOLTAGE_LASTS_S));
        let fell_below = if self.held == Charge::Critical { critical_v } else { low_v };
        let replaced = self.replaced.step(!armed && voltage > REPLACED * fell_below, jobs(VOLTAGE_LASTS_S));
        let now = if critical {
            Charge::Critical
        } else if low {
            Charge::Low
        } else {
            Charge::Good
        };
        if armed {
            self.held = self.held.max(now);
        } else if replaced {
            self.held = Charge::Good;
        }
        self.charge = self.held.max(now);
    }

    pub(super) fn charge(&self) -> Charge {
        self.charge
    }
}

/// Airborne above this height over the ground, m.
const LIFT_OFF_M: f32 = 0.15;
/// Airborne with a thrust above this fraction of the weight for [`LIFT_OFF_S`], whatever the height estimate says.
const LIFT_OFF_THRUST: f32 = 0.85;
const LIFT_OFF_S: f32 = 0.5;
/// And with a thrust above this fraction for [`CLEAR_S`] it has left the ground, whatever the height estimate says: half a
/// metre in a second, more than a foot reaches down.
const CLEAR_THRUST: f32 = 1.1;
const CLEAR_S: f32 = 1.0;
/// Touchdown while descending: thrust below this fraction of the weight, yet slower than [`STANDING_M_S`], for
/// [`STANDING_S`]. A flying vehicle with so little thrust would fall.
const STANDING_THRUST: f32 = 0.55;
const STANDING_M_S: f32 = 0.3;
const STANDING_S: f32 = 0.5;
/// Touchdown too: thrust below nearly all of the weight, and no motion at all for longer.
const RESTING_THRUST: f32 = 0.95;
const RESTING_M_S: f32 = 0.1;
const RESTING_S: f32 = 2.0;

/// Faster upwards than this, m/s, nothing stands: there the thrust that carries the vehicle is learnt, with this gain per job,
/// in 0.75 s. Downwards the air carries a part. No less than this part of the weight is believed.
const CLIMBS_M_S: f32 = 0.25;
const CARRYING_GAIN: f32 = 0.026;
const CARRYING_LEAST: f32 = 0.4;
/// Near enough for that, m/s².
const GRAVITY_M_S2: f32 = 9.81;

/// Detects lift-off and touchdown.
#[derive(Clone, Debug)]
pub(super) struct GroundWatch {
    airborne: bool,
    /// Thrust that carries it in this flight, as a part of the weight: less than 1 if that is less than what is set, or the
    /// rotors are stronger. Compared with the weight, such a vehicle would seem to stand while it hovers.
    carrying: f32,
    /// Of the last job.
    climb_m_s: f32,
    /// Whether it is high enough to lean.
    clear: bool,
    /// Whether the ground was just found in a mode that does not lead there.
    pub(super) touched: bool,
    /// z of the ground, as last stood on, m.
    ground_m: f32,
    lifting: Persistence,
    leaving: Persistence,
    standing: Persistence,
    resting: Persistence,
    at_rest: Persistence,
}

impl GroundWatch {
    pub(super) fn new(airborne: bool, ground_m: f32) -> Self {
        let none = Persistence::default();
        let (lifting, leaving, standing, resting, at_rest) = (none, none, none, none, none);
        let clear = airborne;
        Self {
            airborne,
            carrying: 1.0,
            climb_m_s: 0.0,
            clear,
            touched: false,
            ground_m,
            lifting,
            leaving,
            standing,
            resting,
            at_rest,
        }
    }

    /// With rotors stopped or idling: landed once the vehicle has come to rest.
    pub(super) fn step_idle(&mut self, input: &CommanderInput) {
        if self.at_rest.step(is_slow(&input.nav), jobs(STANDING_S)) || !self.airborne {
            *self = Self::new(false, input.nav.position.z);
        }
    }

    /// With rotors carrying the vehicle; `descends` is what is known of the motion if it is commanded to descend. Without a
    /// known vertical velocity no touchdown is detected. One that is not to descend, and `may_stand`, has touched down only if
    /// it gives so little thrust that no wrong mass explains it.
    pub(super) fn step_flying(
        &mut self,
        input: &CommanderInput,
        weight_n: f32,
        descends: Option<Known>,
        may_stand: bool,
    ) {
        let descend = descends.is_some_and(|known| known <= Known::Climb);
        let thrust = input.thrust_n / weight_n;
        let lifting = self.lifting.step(thrust > LIFT_OFF_THRUST, jobs(LIFT_OFF_S));
        let is_high = input.nav.position.z - self.ground_m > LIFT_OFF_M;
        self.airborne |= lifting || is_high;
        let has_left = self.leaving.step(thrust > CLEAR_THRUST, jobs(CLEAR_S));
        self.clear |= is_high || has_left || (self.airborne && !input.health.height);
        let vertical = math::abs(input.nav.velocity.z);
        let climb = input.nav.velocity.z;
        let before = core::mem::replace(&mut self.climb_m_s, climb);
        if self.airborne && climb > CLIMBS_M_S && input.health.climb {
            self.learn(thrust * (input.nav.attitude * Vector3::z()).z, climb - before);
        }
        let part = thrust / self.carrying;
        let standing = (descend || may_stand) && part < STANDING_THRUST && vertical < STANDING_M_S;
        let resting = descend && part < RESTING_THRUST && vertical < RESTING_M_S;
        let stands = self.standing.step(standing, jobs(STANDING_S)) | self.resting.step(resting, jobs(RESTING_S));
        if stands || (descends.is_some() && !self.airborne) {
            *self = Self::new(false, input.nav.position.z);
        }
    }

    /// Learns what carries the vehicle from a thrust upwards, as a part of the weight, with which it has become so much faster
    /// in a job, m/s.
    fn learn(&mut self, upwards: f32, faster: f32) {
        let in_g = 1.0 + faster / (COMMANDER.period as f32 * TICK_S * GRAVITY_M_S2);
        let carrying = upwards / math::max(in_g, 0.2);
        self.carrying = math::clamp(self.carrying + CARRYING_GAIN * (carrying - self.carrying), CARRYING_LEAST, 1.0);
    }

    pub(super) fn is_airborne(&self) -> bool {
        self.airborne
    }

    /// Whether it may lean. A vehicle that gives nearly all of its weight for thrust counts as airborne and may still stand:
    /// one that leans then is tipped over by its feet.
    pub(super) fn is_clear(&self) -> bool {
        self.clear
    }
}
