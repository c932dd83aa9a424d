//! Measures the rates of the control loops with a clock that is independent of the tick.

use crate::mavlink::LoopTiming;

/// Counts the inner loop's activations and the outer loop's jobs over windows of a second.
#[derive(Clone, Debug)]
pub struct LoopMeter {
    counts_per_us: u32,
    /// Clock at the last activation; `None` before the first.
    last: Option<u32>,
    window: Window,
}

#[derive(Clone, Copy, Debug)]
struct Window {
    elapsed: u32,
    activations: u32,
    outer_jobs: u32,
    shortest: u32,
    longest: u32,
}

impl Window {
    const EMPTY: Self = Self { elapsed: 0, activations: 0, outer_jobs: 0, shortest: u32::MAX, longest: 0 };
}

impl LoopMeter {
    /// A meter for a clock with this rate.
    pub const fn new(counts_per_us: u32) -> Self {
        Self { counts_per_us, last: None, window: Window::EMPTY }
    }

    /// Call at each activation of the inner loop, with the free-running clock and the number of outer jobs finished
    /// since the last call. Returns the rates once per second.
    #[inline]
    pub fn activation(&mut self, now: u32, outer_jobs: u32) -> Option<LoopTiming> {
        let last = self.last.replace(now)?;
        let period = now.wrapping_sub(last);
        let window = &mut self.window;
        window.elapsed = window.elapsed.saturating_add(period);
        window.activations += 1;
        window.outer_jobs = window.outer_jobs.saturating_add(outer_jobs);
        window.shortest = window.shortest.min(period);
        window.longest = window.longest.max(period);
        if window.elapsed < self.counts_per_us.saturating_mul(1_000_000) {
            return None;
        }
        let full = core::mem::replace(window, Window::EMPTY);
        Some(self.timing(&full))
    }

    fn timing(&self, window: &Window) -> LoopTiming {
        let counts_per_us = u64::from(self.counts_per_us.max(1));
        let elapsed_us = (u64::from(window.elapsed) / counts_per_us).max(1);
        let hertz = |n: u32| saturate((u64::from(n) * 1_000_000 + elapsed_us / 2) / elapsed_us);
        let us = |counts: u32| saturate((u64::from(counts) + counts_per_us / 2) / counts_per_us);
        LoopTiming {
            inner_hz: hertz(window.activations),
            outer_hz: hertz(window.outer_jobs),
            inner_period_us: (us(window.shortest), us(window.longest)),
        }
    }
}

fn saturate(value: u64) -> u16 {
    u16::try_from(value).unwrap_or(u16::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loop_that_holds_its_period_shows_it() {
        let mut meter = LoopMeter::new(25);
        // The clock wraps on the way.
        let start = u32::MAX - 10_000_000;
        let timings: Vec<_> = (0..=1_000_u32)
            .filter_map(|k| meter.activation(start.wrapping_add(k * 25_000), u32::from(k % 4 == 2)))
            .collect();
        assert_eq!(timings, [LoopTiming { inner_hz: 1_000, outer_hz: 250, inner_period_us: (1_000, 1_000) }]);
    }

    #[test]
    fn a_late_activation_shows_in_the_periods_and_a_stalled_loop_in_its_rate() {
        let mut meter = LoopMeter::new(1);
        let mut now = 0;
        let mut timing = None;
        for k in 0..=1_000_u32 {
            now += match k {
                500 => 1_300,
                501 => 700,
                _ => 1_000,
            };
            timing = timing.or(meter.activation(now, 0));
        }
        let timing = timing.expect("a second is over");
        assert_eq!((timing.inner_hz, timing.outer_hz, timing.inner_period_us), (1_000, 0, (700, 1_300)));
        assert_eq!(meter.activation(now + 4_000_000, 0).map(|t| t.inner_hz), Some(0));
    }
}
