//! Streamed set-points: a companion computer's places, velocities and accelerations, a few to a hundred per second, as a
//! reference that is continuous to the jerk.
//!
//! ```text
//! sample ─► when was it taken? ─► how does the target move? ─► extrapolated to now ─► follow within limits ─► reference
//!           clock                 estimate                                           tracker
//! ```
//!
//! The reference moves with the target, whose velocity, acceleration and jerk are passed on, and what remains between the
//! two is brought to zero within the limits of [`ModeSettings`]. So a smooth stream is followed without a lag, and a step
//! is flown along a straight line and not overshot. A target that no vehicle could follow is followed up to [`Fastest`].
//!
//! Horizontal axes are treated as one vector, the height and the heading each by itself. An axis of which nothing is
//! given brakes, and holds the place at which it has stopped. What becomes of a stream that ends is left to others: here
//! a target that has a place brakes after 0.25 s, and one that has only a velocity keeps it.
//!
//! Places are offsets from an anchor, as in [`setpoint`](super::setpoint): far from the origin an f32 is coarser than a
//! step.

mod axis;
mod clock;
mod estimate;
mod follower;
mod motion;
mod tracker;

pub use motion::{Motion, Sample};

use nalgebra::{Vector1, Vector2, Vector3};

use crate::config::ModeSettings;
use crate::math;
use crate::schedule::OUTER;
use crate::signals::{FlatReference, TICK_S, Tick};
use axis::Given;
use clock::{Clock, Taken};
use estimate::Timing;
use follower::{Follower, SAME_M, heading, height, level};

/// Time between two steps, s: a period of the outer partition.
const STEP_S: f32 = OUTER.period as f32 * TICK_S;

/// Distance between anchors, m.
const ANCHORS_M: f32 = 128.0;

/// Least time between two samples, s.
const LEAST_S: f32 = 0.002;

/// Beyond these a sample's numbers are no motion: their squares are still finite, m, and m/s, m/s² or rad/s.
const FARTHEST_M: f32 = 1e6;
const LARGEST: f32 = 1e3;

/// Relative rounding error of a coordinate in a sample.
const GRAIN: f32 = 2e-7;

/// How fast a target may move and still be followed; vertically it may climb and sink as [`ModeSettings`] tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fastest {
    /// Horizontal speed of target and reference, m/s.
    pub speed_m_s: f32,
    /// Their horizontal acceleration, m/s²: g tan of the greatest tilt, or less.
    pub acceleration_m_s2: f32,
    /// Their vertical acceleration, m/s². Well below g: a force that vanishes has no direction.
    pub vertical_m_s2: f32,
}

/// Follows a stream of set-points.
#[derive(Clone, Debug, PartialEq)]
pub struct Stream {
    clock: Clock,
    /// The latest sample that told something, when it was taken before it was read (s), and the latest of all.
    latest: Option<Sample>,
    delay_s: f32,
    seen: Option<Tick>,
    /// Origin of x, y and z, m: whole multiples of [`ANCHORS_M`].
    anchor: Vector3<f32>,
    level: Follower<2>,
    height: Follower<1>,
    heading: Follower<1>,
}

impl Stream {
    /// At rest at the origin, with valid limits.
    pub fn new(limits: &ModeSettings, fastest: Fastest) -> Self {
        Self {
            clock: Clock::NONE,
            latest: None,
            delay_s: 0.0,
            seen: None,
            anchor: Vector3::zeros(),
            level: Follower::new(level(limits, fastest)),
            height: Follower::new(height(limits, fastest)),
            heading: Follower::new(heading(limits)),
        }
    }

    /// Goes on within other limits, without a jump.
    pub fn limit(&mut self, limits: &ModeSettings, fastest: Fastest) {
        self.level.limit(level(limits, fastest));
        self.height.limit(height(limits, fastest));
        self.heading.limit(heading(limits));
    }

    /// Continues from a reference without a jump in position to jerk, and forgets the stream before.
    pub fn start(&mut self, from: &FlatReference) {
        (self.clock, self.latest, self.seen) = (Clock::NONE, None, None);
        self.anchor = Vector3::zeros();
        let axis = |value: f32| Vector1::new(value);
        let FlatReference { position: p, velocity: v, acceleration: a, jerk: j, .. } = from;
        self.level.start(p.xy(), v.xy(), a.xy(), j.xy());
        self.height.start(axis(p.z), axis(v.z), axis(a.z), axis(j.z));
        self.heading.start(axis(from.yaw), axis(from.yaw_rate), axis(from.yaw_acceleration), axis(0.0));
        let snap = &from.snap;
        (self.level.tracker.chain.snap, self.height.tracker.chain.snap) = (snap.xy(), axis(snap.z));
        self.drop_anchor();
    }

    /// Advances by a step to `now` with the latest sample, and returns the reference for then.
    pub fn advance(&mut self, now: Tick, sample: &Sample) -> FlatReference {
        if self.seen != Some(sample.at) {
            self.seen = Some(sample.at);
            if !self.is_repeated(sample) {
                self.take(sample);
            }
        }
        // The target is compared with the reference before the step.
        let before = now.wrapping_sub(OUTER.period);
        let age_s = self.latest.map_or(0.0, |latest| between_s(latest.at, before) + self.delay_s);
        self.level.advance(age_s);
        self.height.advance(age_s);
        self.heading.advance(age_s);
        self.drop_anchor();
        self.reference()
    }

    /// Whether a sample is the latest once more, as a link that repeats messages brings it.
    fn is_repeated(&self, sample: &Sample) -> bool {
        self.latest.is_some_and(|latest| {
            latest.motion == sample.motion
                && latest.sent_ms == sample.sent_ms
                && (sample.sent_ms.is_some() || self.clock.is_early(sample.at.wrapping_sub(latest.at).cast_signed()))
        })
    }

    fn take(&mut self, sample: &Sample) {
        let since = self.latest.map(|latest| sample.at.wrapping_sub(latest.at).cast_signed());
        let Taken::Before(delay_s, error_s) = self.clock.take(sample.at, since, sample.sent_ms) else { return };
        let since_s = since.map_or(f32::MAX, |since| since as f32 * TICK_S + self.delay_s - delay_s);
        // Of two that seem to be of one time, the later is a little later.
        let timing = Timing::new(math::max(since_s, LEAST_S), error_s);
        (self.latest, self.delay_s) = (Some(*sample), delay_s);
        let ([x, y, z], yaw) = self.given(&sample.motion);
        self.level.target.gate.floor = SAME_M + GRAIN * self.anchor.xy().amax();
        self.height.target.gate.floor = SAME_M + GRAIN * math::abs(self.anchor.z);
        self.level.take(&[x, y], &timing);
        self.height.take(&[z], &timing);
        self.heading.take(&[yaw], &timing);
    }

    /// What is given of each axis, from the anchor.
    fn given(&self, motion: &Motion) -> ([Given; 3], Given) {
        let mut axes = [Given::default(); 3];
        let rates = motion.velocity().into_iter().zip(motion.acceleration());
        let places = motion.position().into_iter().zip(self.anchor.iter());
        for ((axis, (place, anchor)), (speed, acceleration)) in axes.iter_mut().zip(places).zip(rates) {
            *axis = Given {
                place: place.map(|place| math::limit(place - anchor, FARTHEST_M)),
                speed: speed.map(|speed| math::limit(speed, LARGEST)),
                acceleration: acceleration.map(|acceleration| math::limit(acceleration, LARGEST)),
            };
        }
        (
            axes,
            Given {
                place: motion.yaw(),
                speed: motion.yaw_rate().map(|rate| math::limit(rate, LARGEST)),
                acceleration: None,
            },
        )
    }

    /// Moves the anchor to the reference where that has gone far from it. Exact, except for a target that is far away.
    #[inline]
    fn drop_anchor(&mut self) {
        let (level, height) = (&self.level.tracker.chain.place, &self.height.tracker.chain.place);
        if math::max(level.amax(), height.amax()) > ANCHORS_M {
            self.move_anchor(&Vector3::new(level.x, level.y, height.x));
        }
    }

    #[cold]
    fn move_anchor(&mut self, place: &Vector3<f32>) {
        let by = place.map(|offset| (offset / ANCHORS_M) as i32 as f32 * ANCHORS_M);
        self.anchor += by;
        self.level.shift(&Vector2::new(by.x, by.y));
        self.height.shift(&Vector1::new(by.z));
    }

    /// The reference now.
    pub fn reference(&self) -> FlatReference {
        let (level, height, heading) =
            (&self.level.tracker.chain, &self.height.tracker.chain, &self.heading.tracker.chain);
        let world = |level: &Vector2<f32>, height: &Vector1<f32>| Vector3::new(level.x, level.y, height.x);
        FlatReference {
            position: self.anchor + world(&level.place, &height.place),
            velocity: world(&level.speed, &height.speed),
            acceleration: world(&level.acceleration, &height.acceleration),
            jerk: world(&level.jerk, &height.jerk),
            snap: world(&level.snap, &height.snap),
            yaw: heading.place.x,
            yaw_rate: heading.speed.x,
            yaw_acceleration: heading.acceleration.x,
        }
    }
}

/// Time from a tick to a later one, s; negative if it is earlier.
fn between_s(from: Tick, to: Tick) -> f32 {
    to.wrapping_sub(from).cast_signed() as f32 * TICK_S
}

#[cfg(test)]
mod tests;
