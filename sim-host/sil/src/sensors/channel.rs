//! Delivery of a sensor's samples to the firmware: first faults, then latency.

use std::collections::VecDeque;

use firmware::signals::Tick;

use super::check::LATENCY_MAX_S;
use super::faults::{EXTRA_MAX_S, Faults, Memory, Sample};
use super::process::{Period, ticks};

/// Samples in transit, in the order of arrival, at most one per tick.
#[derive(Clone, Debug)]
pub(super) struct Channel<T> {
    /// With the tick of arrival. The capacity suffices for the longest latency, so it never grows.
    under_way: VecDeque<(Tick, T)>,
    memory: Memory<T>,
}

impl<T: Sample> Channel<T> {
    pub(super) fn new(period: Period) -> Self {
        // The jitter is at most as long as the latency that it varies.
        let longest = ticks(2.0 * LATENCY_MAX_S + EXTRA_MAX_S) / period.ticks();
        Self { under_way: VecDeque::with_capacity(longest as usize + 2), memory: Memory::new() }
    }

    /// Sends a sample measured at `tick`, to arrive `latency` ticks later. Samples that it overtakes are lost.
    pub(super) fn send(&mut self, tick: Tick, latency: u32, sample: T, faults: &mut Faults) {
        let Some((sample, extra)) = faults.pass(tick, &mut self.memory, sample) else { return };
        let arrival = tick.saturating_add(latency).saturating_add(extra);
        while self.under_way.back().is_some_and(|(other, _)| *other >= arrival) {
            self.under_way.pop_back();
        }
        self.under_way.push_back((arrival, sample));
    }

    /// The sample that arrives at `tick`. Call once per tick, in order.
    pub(super) fn arrival(&mut self, tick: Tick) -> Option<T> {
        let (arrival, sample) = *self.under_way.front()?;
        (arrival <= tick).then(|| {
            self.under_way.pop_front();
            sample
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use firmware::sensors::BaroSample;

    fn sample(at: Tick) -> BaroSample {
        BaroSample { at, pressure_pa: 1e5 }
    }

    #[test]
    fn a_sample_arrives_after_its_latency() {
        let mut faults = Faults::new(&[], 1);
        let mut channel = Channel::new(Period::of_rate(100.0));
        let mut arrivals = Vec::new();
        for tick in 0..100 {
            if tick % 10 == 0 {
                channel.send(tick, 25, sample(tick), &mut faults);
            }
            arrivals.extend(channel.arrival(tick).map(|sample| (tick, sample.at)));
        }
        assert_eq!(arrivals, [(25, 0), (35, 10), (45, 20), (55, 30), (65, 40), (75, 50), (85, 60), (95, 70)]);
    }

    #[test]
    fn what_is_overtaken_is_lost() {
        let mut faults = Faults::new(&[], 1);
        let mut channel = Channel::new(Period::of_rate(1000.0));
        channel.send(0, 9, sample(0), &mut faults);
        channel.send(1, 3, sample(1), &mut faults);
        channel.send(2, 9, sample(2), &mut faults);
        let arrivals: Vec<(Tick, Tick)> =
            (2..20).filter_map(|tick| channel.arrival(tick).map(|sample| (tick, sample.at))).collect();
        assert_eq!(arrivals, [(4, 1), (11, 2)]);
    }
}
