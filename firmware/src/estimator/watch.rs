//! Whether a sensor is to be listened to: time stamps, values that stand still, innovations that are too large.

use crate::signals::Tick;

/// What has become of a sensor's samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Watch {
    /// Stamp of the newest sample.
    newest: Option<Tick>,
    /// The numbers of the newest sample, as bits.
    value: [u32; 3],
    /// How often they have come in a row.
    repeats: u32,
    /// When a sample was last taken in.
    accepted: Option<Tick>,
    /// Since when all have been refused by their innovation, and how many.
    refused_since: Option<Tick>,
    refused_in_row: u32,
    /// When the gate was last asked.
    noted: Option<Tick>,
    /// Samples since boot that were not taken in.
    refused: u32,
}

impl Watch {
    /// Whether a sample may be used at all: newer than the last, and not the same numbers for the `most`th time in a
    /// row. A sensor's noise is never that quiet; one that is has stopped measuring.
    pub fn admits(&mut self, at: Tick, value: [f32; 3], most: u32) -> bool {
        let is_new = self.newest.is_none_or(|newest| {
            let ahead = at.wrapping_sub(newest);
            ahead != 0 && ahead < Tick::MAX / 2
        });
        if !is_new {
            self.count();
            return false;
        }
        self.newest = Some(at);
        let bits = value.map(f32::to_bits);
        self.repeats = if bits == self.value { self.repeats.saturating_add(1) } else { 0 };
        self.value = bits;
        if self.repeats >= most {
            self.count();
            return false;
        }
        true
    }

    fn count(&mut self) {
        self.refused = self.refused.saturating_add(1);
    }

    /// Notes what the gate said of a sample, at the job released at `now`.
    pub fn note(&mut self, now: Tick, accepted: bool) {
        /// What was said before a silence of as many ticks says nothing about now.
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

    /// Whether samples have been refused by their innovation, and only that, for this many ticks.
    pub fn is_at_odds(&self, now: Tick, ticks: Tick) -> bool {
        /// One or two may be strays.
        const FEW: u32 = 3;
        self.refused_in_row >= FEW && self.refused_since.is_some_and(|since| now.wrapping_sub(since) >= ticks)
    }

    /// Whether a sample was taken in within these ticks.
    pub fn is_live(&self, now: Tick, ticks: Tick) -> bool {
        self.accepted.is_some_and(|at| now.wrapping_sub(at) <= ticks)
    }

    /// Samples since boot that were not taken in.
    pub fn refused(&self) -> u32 {
        self.refused
    }
}

/// How far a sensor's readings scatter, in units of the variance that they are said to have: a mean over some hundred.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter(f32);

impl Default for Scatter {
    fn default() -> Self {
        Self(1.0)
    }
}

impl Scatter {
    /// Takes in a normalised innovation squared, in units of the variance that is said.
    pub fn note(&mut self, square: f32) {
        /// No reading counts for more, and each for so much.
        const MOST: f32 = 400.0;
        const PART: f32 = 0.01;
        let square = if square < MOST { square } else { MOST };
        self.0 += (square - self.0) * PART;
    }

    /// By how much the variance is larger than said: 1 within what chance does to a sound sensor, whose mean is 1 ± 0.14.
    pub fn noisier(self) -> f32 {
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
            watch.admits(at, [value; 3], 5)
        };
        assert!(admits(10) && admits(20) && !admits(20) && !admits(15) && admits(21));
        assert_eq!(watch.refused(), 2);
    }

    #[test]
    fn a_value_that_stands_still_is_refused_until_it_moves() {
        let mut watch = Watch::default();
        assert!((0..5).all(|k| watch.admits(k, [1.0, 2.0, 3.0], 5)));
        assert!((5..9).all(|k| !watch.admits(k, [1.0, 2.0, 3.0], 5)));
        assert!(watch.admits(9, [1.0, 2.0, 3.5], 5));
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
            assert_eq!(scatter.noisier(), 1.0);
        }
        (0..500).for_each(|_| scatter.note(100.0));
        assert!(scatter.noisier() > 90.0 && scatter.noisier() < 101.0);
        scatter.note(f32::NAN);
        assert!(scatter.noisier() < 110.0);
    }
}
