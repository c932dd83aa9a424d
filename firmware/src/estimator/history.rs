//! The estimated motion of the last 252 ms, so that late measurements are fused at the time they were taken.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::schedule::FILTER;
use crate::signals::Tick;

/// Filter jobs kept: from the oldest to the newest 252 ms, more than the latency of any GNSS receiver (200 ms).
const ENTRIES: usize = 64;
/// Greatest latency with which a reading is always fused, ticks: one that arrives just after a job waits for the next.
pub const LATENCY_MAX: Tick = (ENTRIES as Tick - 1) * FILTER.period - (FILTER.period - 1);

/// The kinematic components of a correction: attitude error (rad, world), velocity (m/s) and position (m).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moved {
    /// θ.
    pub theta: Vector3<f32>,
    /// δv.
    pub velocity: Vector3<f32>,
    /// δp.
    pub position: Vector3<f32>,
}

impl Moved {
    /// A fraction of the correction.
    fn scaled(&self, fraction: f32) -> Self {
        Self { theta: self.theta * fraction, velocity: self.velocity * fraction, position: self.position * fraction }
    }
}

impl core::ops::AddAssign for Moved {
    fn add_assign(&mut self, other: Self) {
        self.theta += other.theta;
        self.velocity += other.velocity;
        self.position += other.position;
    }
}

/// The estimated motion at a job.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Snapshot {
    /// When.
    pub at: Tick,
    /// Body to world.
    pub attitude: UnitQuaternion<f32>,
    /// m/s.
    pub velocity: Vector3<f32>,
    /// m.
    pub position: Vector3<f32>,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    snapshot: Snapshot,
    /// The correction found by this job. The next snapshot is the first to include it.
    ordered: Moved,
}

/// The motion at a measurement's own time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Past {
    /// The estimate of that time, interpolated between two jobs.
    pub snapshot: Snapshot,
    /// Sum of the corrections made since then.
    pub since: Moved,
}

/// Ring buffer of the last jobs.
#[derive(Clone, Debug)]
pub struct History {
    entries: [Entry; ENTRIES],
    /// Number of valid entries.
    filled: usize,
    /// Index of the newest entry.
    newest: usize,
}

impl History {
    /// Empty.
    pub fn new() -> Self {
        let zero = Vector3::zeros();
        let snapshot = Snapshot { at: 0, attitude: UnitQuaternion::identity(), velocity: zero, position: zero };
        Self { entries: [Entry { snapshot, ordered: Moved::default() }; ENTRIES], filled: 0, newest: 0 }
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.filled = 0;
    }

    /// Appends the newest snapshot.
    pub fn push(&mut self, snapshot: Snapshot) {
        self.newest = (self.newest + 1) % ENTRIES;
        if let Some(entry) = self.entries.get_mut(self.newest) {
            *entry = Entry { snapshot, ordered: Moved::default() };
        }
        self.filled = (self.filled + 1).min(ENTRIES);
    }

    /// Records the correction found by the newest snapshot's job.
    pub fn order(&mut self, moved: Moved) {
        if let Some(entry) = self.entries.get_mut(self.newest) {
            entry.ordered = moved;
        }
    }

    /// The entries from the newest back.
    fn backwards(&self) -> impl Iterator<Item = &Entry> {
        let newest = self.newest;
        (0..self.filled).filter_map(move |age| self.entries.get((newest + ENTRIES - age) % ENTRIES))
    }

    /// The motion at a time, or `None` if it is older than the history or later than the newest snapshot.
    pub fn at(&self, tick: Tick) -> Option<Past> {
        let mut since = Moved::default();
        let mut after: Option<&Entry> = None;
        for entry in self.backwards() {
            let age = tick.wrapping_sub(entry.snapshot.at);
            if age < Tick::MAX / 2 {
                let (snapshot, held) = match after {
                    None if age == 0 => (entry.snapshot, 0.0),
                    None => return None,
                    Some(after) => between(&entry.snapshot, &after.snapshot, tick),
                };
                // The fraction that interpolation towards the later snapshot does not already include.
                since += entry.ordered.scaled(1.0 - held);
                return Some(Past { snapshot, since });
            }
            since += entry.ordered;
            after = Some(entry);
        }
        None
    }
}

impl Default for History {
    fn default() -> Self {
        Self::new()
    }
}

/// The motion at `tick`, interpolated between two snapshots a few ms apart, and the weight of the later one.
fn between(before: &Snapshot, after: &Snapshot, tick: Tick) -> (Snapshot, f32) {
    let fraction = tick.wrapping_sub(before.at) as f32 / after.at.wrapping_sub(before.at).max(1) as f32;
    let (a, b) = (before.attitude.quaternion(), after.attitude.quaternion());
    let mixed: Quaternion<f32> = a * (1.0 - fraction) + b * fraction;
    // The mean of two unit quaternions a small turn apart is nearly of unit size: one Newton step of 1/√n² makes it so.
    let size = 1.5 - 0.5 * mixed.norm_squared();
    let snapshot = Snapshot {
        at: tick,
        attitude: UnitQuaternion::new_unchecked(mixed * size),
        velocity: before.velocity + (after.velocity - before.velocity) * fraction,
        position: before.position + (after.position - before.position) * fraction,
    };
    (snapshot, fraction)
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "tests compare with bounds; what flies may not")]
mod tests {
    use super::*;

    fn snapshot(at: Tick) -> Snapshot {
        Snapshot {
            at,
            attitude: UnitQuaternion::from_axis_angle(&Vector3::z_axis(), at as f32 * 0.005),
            velocity: Vector3::repeat(at as f32),
            position: Vector3::repeat(2.0 * at as f32),
        }
    }

    fn filled(jobs: Tick) -> History {
        let mut history = History::new();
        for job in 0..jobs {
            history.push(snapshot(job * 4));
            history.order(Moved { position: Vector3::x(), ..Moved::default() });
        }
        history
    }

    #[test]
    fn the_past_is_interpolated_and_knows_the_corrections_since() {
        let history = filled(100);
        let past = history.at(350).expect("remembered");
        assert!((past.snapshot.velocity.x - 350.0).abs() < 1e-3);
        assert!((past.snapshot.position.y - 700.0).abs() < 1e-3);
        assert!((past.snapshot.attitude.angle() - 1.75).abs() < 1e-4);
        // Ordered at 352, 356, …, 396; what was ordered at 348 is in the snapshot at 352, so half of it is in their mean.
        assert_eq!(past.since.position.x, 12.5);
        assert_eq!(history.at(396).expect("the newest").since.position.x, 1.0);
    }

    #[test]
    fn what_is_too_old_or_yet_to_come_is_refused() {
        let history = filled(100);
        assert!(history.at(396 - 4 * 63).is_some());
        assert!(history.at(396 - 4 * 64).is_none());
        assert!(history.at(397).is_none());
        assert!(History::new().at(0).is_none());
    }

    #[test]
    fn a_reading_of_the_greatest_latency_is_remembered_whenever_it_arrives() {
        let history = filled(100);
        let oldest = LATENCY_MAX + FILTER.period - 1;
        for age in LATENCY_MAX..=oldest {
            assert!(history.at(396 - age).is_some(), "{age}");
        }
        assert!(history.at(396 - oldest - 1).is_none());
        assert_eq!(LATENCY_MAX, 249);
    }

    #[test]
    fn the_clock_may_wrap() {
        let mut history = History::new();
        for job in 0..10_u32 {
            history.push(Snapshot { at: (Tick::MAX - 15).wrapping_add(job * 4), ..snapshot(0) });
        }
        assert!(history.at(Tick::MAX - 5).is_some() && history.at(3).is_some());
    }
}
