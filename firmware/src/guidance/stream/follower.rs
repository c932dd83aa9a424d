//! Some axes of a stream: the estimate of their target, the reference that follows it, and their limits.

use super::Fastest;
use super::axis::Given;
use super::estimate::{Gate, Group, Timing};
use super::tracker::{Axes, Limits, Target, Tracker};
use crate::config::ModeSettings;
use crate::math;

/// Below this an axis of which nothing is given has stopped, m/s and m/s², rad/s and rad/s².
const STOPPED: f32 = 0.01;
const STOPPED_2: f32 = 0.05;
/// A residual that needs more acceleration than this is a step, m/s² and rad/s²: twice what a fast vehicle can do.
const STEP_M_S2: f32 = 25.0;
const STEP_RAD_S2: f32 = 20.0;
/// Places and headings closer than this are the same, m and rad.
pub(super) const SAME_M: f32 = 0.003;
const SAME_RAD: f32 = 0.003;
/// Speeds so much greater than the fastest that is followed are still motion.
const FASTER: f32 = 1.2;
/// A silent target brakes with this fraction of the acceleration, which the reference has to catch up with.
const BRAKING: f32 = 0.7;
/// In this time the greatest acceleration may be reached, s: a limit for the target's jerk.
const REACHED_S: f32 = 0.2;
/// In this time the heading's acceleration is reached, s.
const TURNING_S: f32 = 0.1;

/// Estimate and reference of some axes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Follower<const N: usize> {
    pub(super) target: Group<N>,
    pub(super) tracker: Tracker<N>,
    /// Where an axis stopped of which nothing is given.
    held: [Option<f32>; N],
}

impl<const N: usize> Follower<N> {
    /// Follows nothing yet.
    pub(super) fn new((limits, gate): (Limits, Gate)) -> Self {
        Self { target: Group::new(gate), tracker: Tracker::new(limits), held: [None; N] }
    }

    /// Goes on within other limits.
    pub(super) fn limit(&mut self, (limits, gate): (Limits, Gate)) {
        self.target.gate = gate;
        self.tracker.limit(limits);
    }

    /// Forgets the target, and continues from a motion.
    pub(super) fn start(&mut self, place: Axes<N>, speed: Axes<N>, acceleration: Axes<N>, jerk: Axes<N>) {
        self.target = Group::new(self.target.gate);
        self.held = [None; N];
        let chain = &mut self.tracker.chain;
        (chain.place, chain.speed, chain.acceleration, chain.jerk) = (place, speed, acceleration, jerk);
    }

    /// Takes a sample.
    pub(super) fn take(&mut self, given: &[Given; N], timing: &Timing) {
        self.target.correct(given, timing, &self.tracker.chain.speed);
    }

    /// Advances by a step towards the target `age_s` after its latest sample.
    pub(super) fn advance(&mut self, age_s: f32) {
        let mut target = self.target.at(age_s);
        self.hold(&mut target);
        self.tracker.follow(&target);
    }

    /// The place at which an axis has stopped becomes its target, if nothing is given of it.
    fn hold(&mut self, target: &mut Target<N>) {
        let chain = &self.tracker.chain;
        let reference = chain.place.iter().zip(chain.speed.iter()).zip(chain.acceleration.iter());
        let axes = self.held.iter_mut().zip(self.target.has_nothing()).zip(reference);
        let targets = target.place.iter_mut().zip(target.placed.iter_mut());
        for (((held, is_free), ((place, speed), acceleration)), (wanted, placed)) in axes.zip(targets) {
            let stopped = math::abs(*speed) < STOPPED && math::abs(*acceleration) < STOPPED_2;
            *held = if is_free { held.or(stopped.then_some(*place)) } else { None };
            if let Some(held) = *held {
                (*wanted, *placed) = (held, 1.0);
            }
        }
    }

    /// Moves the origin of places.
    pub(super) fn shift(&mut self, by: &Axes<N>) {
        self.target.shift(by);
        self.tracker.chain.place -= by;
        for (held, by) in self.held.iter_mut().zip(by.iter()) {
            *held = held.map(|place| place - by);
        }
    }
}

/// The horizontal axes.
pub(super) fn level(settings: &ModeSettings, fastest: Fastest) -> (Limits, Gate) {
    let speed = math::max(fastest.speed_m_s, settings.cruise_m_s);
    let strongest = math::max(fastest.acceleration_m_s2, settings.acceleration_m_s2);
    let limits = Limits {
        up: settings.cruise_m_s,
        down: settings.cruise_m_s,
        fastest_up: speed,
        fastest_down: speed,
        acceleration: settings.acceleration_m_s2,
        strongest,
        jerk: settings.jerk_m_s3,
        sharpest: math::max(strongest / REACHED_S, settings.jerk_m_s3),
        turns: false,
    };
    (limits, gate(&limits, STEP_M_S2, SAME_M))
}

/// The vertical axis.
pub(super) fn height(settings: &ModeSettings, fastest: Fastest) -> (Limits, Gate) {
    let strongest = math::max(fastest.vertical_m_s2, settings.vertical_acceleration_m_s2);
    let limits = Limits {
        up: settings.climb_m_s,
        down: settings.sink_m_s,
        fastest_up: settings.climb_m_s,
        fastest_down: settings.sink_m_s,
        acceleration: settings.vertical_acceleration_m_s2,
        strongest,
        jerk: settings.jerk_m_s3,
        sharpest: math::max(strongest / REACHED_S, settings.jerk_m_s3),
        turns: false,
    };
    (limits, gate(&limits, STEP_M_S2, SAME_M))
}

/// The heading.
pub(super) fn heading(settings: &ModeSettings) -> (Limits, Gate) {
    let (rate, acceleration) = (settings.yaw_rate_rad_s, settings.yaw_acceleration_rad_s2);
    let limits = Limits {
        up: rate,
        down: rate,
        fastest_up: rate,
        fastest_down: rate,
        acceleration,
        strongest: acceleration,
        jerk: acceleration / TURNING_S,
        sharpest: acceleration / TURNING_S,
        turns: true,
    };
    (limits, gate(&limits, STEP_RAD_S2, SAME_RAD))
}

fn gate(limits: &Limits, acceleration: f32, floor: f32) -> Gate {
    Gate {
        acceleration,
        floor,
        fastest: FASTER * math::max(limits.fastest_up, limits.fastest_down),
        up: limits.fastest_up,
        down: limits.fastest_down,
        strongest: limits.strongest,
        jerk: limits.sharpest,
        braking: BRAKING * limits.acceleration,
        turns: limits.turns,
    }
}
