//! Logical execution time: when a partition's inputs are read and its outputs take effect.
//!
//! A partition with period T and output offset D, both in ticks, is released at every multiple of T with a snapshot of
//! its inputs. Its output is published D ticks later, no matter when the job actually finished. So the flight does not
//! depend on the execution time of a job, as long as that is below D. A longer job is an overrun: it is counted, and the
//! old output stays in effect; the late one is dropped, or published late if it holds what must not be lost.
//!
//! ```
//! use firmware::schedule::Mailbox;
//!
//! // Period 4 ticks, output 2 ticks after the release.
//! let mut mailbox: Mailbox<u32, u32, 4, 2> = Mailbox::new();
//! assert!(mailbox.is_due(0));
//! mailbox.release(0, 20);
//!
//! // The partition's task: takes the snapshot, and finishes early.
//! let (released, input) = mailbox.take().expect("released");
//! mailbox.finish(input + 1);
//!
//! // The output takes effect at tick 2, and not before.
//! assert_eq!((released, mailbox.publish(1)), (0, None));
//! assert_eq!(mailbox.publish(2), Some(&21));
//!
//! // A job that has not finished in time is an overrun.
//! mailbox.release(4, 30);
//! assert_eq!(mailbox.publish(6), None);
//! assert_eq!(mailbox.overruns(), 1);
//! ```

use crate::signals::{TICK_S, Tick};

/// Period and output offset of a partition, in ticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timing {
    /// Released at every multiple of this.
    pub period: Tick,
    /// Outputs are published this long after the release; at most the period.
    pub offset: Tick,
}

/// Guidance and position control: 250 Hz.
pub const OUTER: Timing = Timing { period: 4, offset: 2 };
/// From the snapshot of the outer partition to its output, s.
pub const OUTER_AHEAD_S: f32 = OUTER.offset as f32 * TICK_S;
/// The estimator's covariance and late readings, in the outer partition's task: 250 Hz.
pub const FILTER: Timing = OUTER;
/// Arming, modes, failsafes: 50 Hz.
pub const COMMANDER: Timing = Timing { period: 20, offset: 4 };
/// MAVLink: 100 Hz. The offset is chosen for the way of the sticks to the rotors: bytes wait at most a period for a job's
/// release; that job's output is published at 6, 16, 26... ticks, the next job of the outer partition is released at 8,
/// 16, 28..., and its output acts 2 ticks later. So it takes at most 10 + 8 + 2 = 20 ms.
pub const GROUND: Timing = Timing { period: 10, offset: 6 };

/// State of a partition's current job.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Job {
    /// No job.
    Idle,
    /// Released at this tick, not finished.
    Running(Tick),
    /// Released at this tick and finished; to be published.
    Done(Tick),
    /// Overrun: still running.
    Late,
    /// Overrun and finished; to be published at once.
    Overdue,
}

/// The mailbox between the inner loop and one partition: one input snapshot in, one output out. Its timing is in its
/// type, because a division by a constant is cheap.
///
/// An output that is late is dropped if it is a value, of which the next one will be as good, and published at the next tick
/// if it `KEEPS_LATE`: then it has orders and answers in it, which nobody gives again.
#[derive(Clone, Debug)]
pub struct Mailbox<I, O, const PERIOD: Tick, const OFFSET: Tick, const KEEPS_LATE: bool = false> {
    input: Option<(Tick, I)>,
    job: Job,
    /// The last job's, also when it was published: the tick reads it where it stands, as it may hold hundreds of bytes.
    output: Option<O>,
    overruns: u32,
}

impl<I, O, const PERIOD: Tick, const OFFSET: Tick, const KEEPS_LATE: bool> Mailbox<I, O, PERIOD, OFFSET, KEEPS_LATE> {
    /// An empty mailbox.
    pub const fn new() -> Self {
        Self { input: None, job: Job::Idle, output: None, overruns: 0 }
    }

    /// Step 1 of a tick: the output that takes effect now, if any. Counts an overrun if its job has not finished.
    #[inline]
    pub fn publish(&mut self, tick: Tick) -> Option<&O> {
        let is_due = |released: Tick| tick.wrapping_sub(released) >= OFFSET;
        match self.job {
            Job::Done(released) if is_due(released) => {}
            Job::Overdue => {}
            Job::Running(released) if is_due(released) => {
                self.job = Job::Late;
                self.overruns = self.overruns.saturating_add(1);
                return None;
            }
            _ => return None,
        }
        self.job = Job::Idle;
        self.output.as_ref()
    }

    /// True if the partition is due for release at `tick`: a multiple of its period, and its last job has ended.
    #[inline]
    pub fn is_due(&self, tick: Tick) -> bool {
        tick.is_multiple_of(PERIOD) && matches!(self.job, Job::Idle)
    }

    /// Step 2 of a tick, if the partition is due: stores the snapshot for it.
    #[inline]
    pub fn release(&mut self, tick: Tick, input: I) {
        self.input = Some((tick, input));
        self.job = Job::Running(tick);
    }

    /// Step 4, in the partition's own task: takes the snapshot, once per release.
    #[inline]
    pub fn take(&mut self) -> Option<(Tick, I)> {
        self.input.take()
    }

    /// Returns the job's output, to be published when it is due, or at the next tick if the job has overrun and its output
    /// is kept.
    #[inline]
    pub fn finish(&mut self, output: O) {
        self.job = match self.job {
            Job::Running(released) => Job::Done(released),
            Job::Late if KEEPS_LATE => Job::Overdue,
            _ => Job::Idle,
        };
        self.output = Some(output);
    }

    /// Step 4 on the desktop: the released job, if any, to its end.
    #[inline]
    pub fn run(&mut self, step: impl FnOnce(Tick, &I) -> O) {
        if let Some((tick, input)) = self.take() {
            self.finish(step(tick, &input));
        }
    }

    /// The output of the last job that has finished, which may not be in effect yet.
    pub fn last_output(&self) -> Option<&O> {
        self.output.as_ref()
    }

    /// Number of jobs that had not finished when their output was due.
    pub fn overruns(&self) -> u32 {
        self.overruns
    }
}

impl<I, O, const PERIOD: Tick, const OFFSET: Tick, const KEEPS_LATE: bool> Default
    for Mailbox<I, O, PERIOD, OFFSET, KEEPS_LATE>
{
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn output_appears_exactly_at_its_offset() {
        let mut mailbox: Mailbox<u32, u32, 4, 2> = Mailbox::new();
        assert!(mailbox.is_due(8) && !mailbox.is_due(9));
        mailbox.release(8, 80);
        let (tick, input) = mailbox.take().expect("released");
        mailbox.finish(input + tick);
        assert_eq!(mailbox.publish(9), None);
        assert_eq!(mailbox.publish(10), Some(&88));
        assert_eq!(mailbox.publish(11), None);
        assert_eq!(mailbox.overruns(), 0);
    }

    #[test]
    fn what_must_not_be_lost_is_published_late() {
        let mut mailbox: Mailbox<u32, u32, 4, 2, true> = Mailbox::new();
        mailbox.release(0, 1);
        assert_eq!(mailbox.publish(2), None);
        assert_eq!(mailbox.publish(3), None);
        mailbox.finish(7);
        assert!(!mailbox.is_due(4), "the next job waits until this one's output is in effect");
        assert_eq!(mailbox.publish(4), Some(&7));
        assert_eq!(mailbox.publish(5), None);
        assert!(mailbox.is_due(8));
        assert_eq!(mailbox.overruns(), 1);
    }

    #[test]
    fn a_late_job_is_counted_once_and_its_output_dropped() {
        let mut mailbox: Mailbox<u32, u32, 4, 2> = Mailbox::new();
        mailbox.release(0, 1);
        assert_eq!(mailbox.publish(2), None);
        assert_eq!(mailbox.publish(3), None);
        assert_eq!(mailbox.overruns(), 1);
        assert!(!mailbox.is_due(4), "still under way");
        mailbox.finish(7);
        assert_eq!(mailbox.publish(5), None);
        assert!(mailbox.is_due(8));
        mailbox.release(8, 3);
        mailbox.take();
        mailbox.finish(9);
        assert_eq!(mailbox.publish(10), Some(&9));
    }
}
