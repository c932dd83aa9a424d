//! Supervision of a sensor: time stamps out of order, values that are stuck, innovations beyond the gate.

use crate::signals::Tick;

/// Record of one sensor's samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Watch {
    /// Stamp of the newest sample.
    newest: Option<Tick>,
    /// Bit pattern of the newest sample.
    bits: [u32; 3],
    /// How many times in a row that pattern has been repeated.
    repeats: u32,
    /// When a sample last passed the gate.
    accepted: Option<Tick>,
    /// Since when every sample has failed the gate, and how many.
    refused_since: Option<Tick>,
    refused_in_row: u32,
    /// When a sample was last gated.
    noted: Option<Tick>,
    /// Samples refused since boot.
    refused: u32,
}

impl Watch {
    /// Whether a sample may be fused: it is newer than the last, and its bits have been repeated fewer than `most`
    /// times in a row. Noise moves every working sensor; one that repeats itself is stuck.
    pub fn admits(&mut self, at: Tick, bits: [u32; 3], most: u32) -> bool {
        let is_new = self.newest.is_none_or(|newest| {
            let ahead = at.wrapping_sub(newest);
            ahead != 0 && ahead < Tick::MAX / 2
        });
        if !is_new {
            self.count();
            return false;
        }
        self.newest = Some(at);
        self.repeats = if bits == self.bits { self.repeats.saturating_add(1) } else { 0 };
        self.bits = bits;
        if self.repeats >= most {
            self.count();
            return false;
        }
        true
    }

    fn count(&mut self) {
        self.refused = self.refused.saturating_add(1);
    }

    /// Records whether a sample passed the gate, at the job released at `now`.
    pub fn note(&mut self, now: Tick, accepted: bool) {
        /// A gap of this many ticks ends a run of refusals. Chosen: 1 s, five samples of the slowest receiver (5 Hz).
        const SILENCE: Tick = 1_000;
        let after_silence = self.noted.is_none_or(|at| now.wrapping_sub(at) > SILENCE);
        self.noted = Some(now);
        if accepted || after_silence {
            (self.refused_since, self.refused_in_row) = (None, 0);
        }
        if accepted {
            self.accepted = Some(now);
        } else {
            self.count();
            self.refused_since.get_or_insert(now);
            self.refused_in_row = self.refused_in_row.saturating_add(1);
        }
    }

    /// Whether every sample has failed the gate for this many ticks, three samples at least.
    pub fn is_at_odds(&self, now: Tick, ticks: Tick) -> bool {
        /// One or two refused samples may be outliers; the third in a row is not.
        const FEW: u32 = 3;
        self.refused_in_row >= FEW && self.refused_since.is_some_and(|since| now.wrapping_sub(since) >= ticks)
    }

    /// Whether a sample passed the gate within these ticks.
    pub fn is_live(&self, now: Tick, ticks: Tick) -> bool {
        self.accepted.is_some_and(|at| now.wrapping_sub(at) <= ticks)
    }

    /// Samples refused since boot.
    pub fn refused(&self) -> u32 {
        self.refused
    }
}

/// Running mean of a sensor's normalised innovation squared: 1 if its noise is what the settings say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter(f32);

impl Default for Scatter {
    fn default() -> Self {
        Self(1.0)
    }
}

impl Scatter {
    /// Adds a normalised innovation squared, in units of the configured variance.
    pub fn note(&mut self, square: f32) {
        /// A single reading counts as 20σ at most (20² = 400), so that one outlier cannot dominate the mean. NaN does
        /// too.
        const MOST: f32 = 400.0;
        /// Averages over 100 readings: 2 s of a barometer or magnetometer at 50 Hz.
        const AVERAGING_GAIN: f32 = 0.01;
        let square = if square < MOST { square } else { MOST };
        self.0 += (square - self.0) * AVERAGING_GAIN;
    }

    /// Factor on the configured variance: 1 unless the readings scatter by more than chance explains.
    pub fn noise_factor(self) -> f32 {
        /// The mean of a sound sensor is 1 with a deviation of √(2 · 0.01/1.99) = 0.10; this is ten of those above it,
        /// so that correlated noise within a data sheet's tolerance does not count as a fault.
        const BEYOND_CHANCE: f32 = 2.0;
        if self.0 > BEYOND_CHANCE { self.0 } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stamps_go_forward() {
        let mut watch = Watch::default();
        let mut value = 0.0;
        let mut admits = |at| {
            value += 1.0;
            watch.admits(at, [f32::to_bits(value); 3], 5)
        };
        assert!(admits(10) && admits(20) && !admits(20) && !admits(15) && admits(21));
        assert_eq!(watch.refused(), 2);
    }

    #[test]
    fn a_value_that_stands_still_is_refused_until_it_moves() {
        let mut watch = Watch::default();
        assert!((0..5).all(|k| watch.admits(k, [1, 2, 3], 5)));
        assert!((5..9).all(|k| !watch.admits(k, [1, 2, 3], 5)));
        assert!(watch.admits(9, [1, 2, 4], 5));
    }

    #[test]
    fn odds_are_counted_from_the_first_refusal_in_a_row() {
        let mut watch = Watch::default();
        watch.note(100, true);
        for at in [200, 250, 300] {
            watch.note(at, false);
        }
        assert!(watch.is_at_odds(300, 100) && !watch.is_at_odds(250, 100) && watch.is_live(200, 100));
        watch.note(310, true);
        assert!(!watch.is_at_odds(900, 0));
        // One bad reading, a silence, and one bad reading more are no jump.
        watch.note(400, false);
        watch.note(5_000, false);
        assert!(!watch.is_at_odds(5_000, 2_500));
    }

    #[test]
    fn ten_times_the_noise_is_seen_and_chance_is_not() {
        let mut scatter = Scatter::default();
        for k in 0..300 {
            scatter.note([0.0, 0.5, 2.5][k % 3]);
            assert_eq!(scatter.noise_factor(), 1.0);
        }
        (0..500).for_each(|_| scatter.note(100.0));
        assert!(scatter.noise_factor() > 90.0 && scatter.noise_factor() < 101.0);
        scatter.note(f32::NAN);
        assert!(scatter.noise_factor() < 110.0);
    }
}
