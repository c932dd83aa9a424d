//! Medians and their confidence intervals, without assuming a distribution and without resampling.
//!
//! A figure that a flight does not have, because the vehicle was lost or never settled, is infinite here: worse than
//! any value. The median is then infinite too if half of the flights are lost, and null in JSON.

use serde::Serialize;

/// Least coverage probability of an interval.
pub const CONFIDENCE: f64 = 0.95;
/// Values from which on a median has an interval: of five, even the least and the greatest miss it with probability 2/32.
pub const FOR_AN_INTERVAL: usize = 6;

/// Accumulates a root mean square.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeanSquare {
    sum: f64,
    count: u64,
}

impl MeanSquare {
    /// Adds a value.
    pub fn take(&mut self, value: f64) {
        self.sum += value * value;
        self.count += 1;
    }

    /// The root mean square so far; `None` without a value.
    pub fn root(self) -> Option<f64> {
        (self.count > 0).then(|| (self.sum / self.count as f64).sqrt())
    }
}

/// A median over flights, or over cells.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// Number of values.
    pub count: usize,
    /// The median; infinite (null) if too many flights are lost.
    pub median: f64,
    /// Confidence interval of the median, at least 95 %; `None` for fewer than six values.
    pub interval: Option<(f64, f64)>,
}

impl Estimate {
    /// The median of values of which smaller ones are better; `None` counts as worse than any.
    pub fn of(values: impl Iterator<Item = Option<f64>>) -> Self {
        let mut values: Vec<f64> = values.map(|value| value.unwrap_or(f64::INFINITY)).collect();
        values.sort_by(f64::total_cmp);
        let count = values.len();
        let interval = interval_ranks(count).map(|(low, high)| (values[low], values[high]));
        Self { count, median: median(&values), interval }
    }
}

/// The median of sorted values; infinite without values.
fn median(sorted: &[f64]) -> f64 {
    let half = sorted.len() / 2;
    match sorted {
        [] => f64::INFINITY,
        _ if sorted.len() % 2 == 1 => sorted[half],
        _ => f64::midpoint(sorted[half - 1], sorted[half]),
    }
}

/// Ranks, from 0, of the order statistics between which the true median lies with at least [`CONFIDENCE`], whatever
/// the distribution (Conover, Practical Nonparametric Statistics, 3.2): the number of values below the median is
/// binomial, so that ranks k and n − 1 − k miss it with probability 2 P(B(n, 1/2) ≤ k).
fn interval_ranks(count: usize) -> Option<(usize, usize)> {
    let mut term = (0..count).fold(1.0, |product, _| 0.5 * product);
    let mut missed = 0.0;
    let mut narrowest = None;
    for k in 0..count / 2 {
        missed += 2.0 * term;
        if missed > 1.0 - CONFIDENCE {
            break;
        }
        narrowest = Some((k, count - 1 - k));
        term *= (count - k) as f64 / (k + 1) as f64;
    }
    narrowest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_are_those_of_the_tables() {
        // Conover, Table A3 and common tables of the sign test: n, and the rank counted from 1.
        for (count, rank) in [(6, 1), (8, 1), (9, 2), (10, 2), (12, 3), (15, 4), (16, 4), (20, 6), (25, 8), (50, 18)] {
            assert_eq!(interval_ranks(count), Some((rank - 1, count - rank)), "{count}");
        }
        // Five values miss it with probability 2/32.
        assert!((0..FOR_AN_INTERVAL).all(|count| interval_ranks(count).is_none()));
    }

    #[test]
    fn the_interval_holds_the_median_as_often_as_it_says() {
        // Values of a linear congruence: uniform in 0..1, true median 1/2. For n = 16 and rank 4 the coverage is
        // 1 - 2 (1 + 16 + 120 + 560)/65536 = 0.9787; 4000 trials know it to 3 * 0.0023.
        let mut state = 12_345_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let covers = |_: &u32| {
            let estimate = Estimate::of((0..16).map(|_| Some(uniform())));
            estimate.interval.is_some_and(|(low, high)| (low..=high).contains(&0.5))
        };
        let covered = (0..4000_u32).filter(covers).count() as f64 / 4000.0;
        assert!((covered - 0.9787).abs() < 0.0069, "{covered}");
    }

    #[test]
    fn medians_of_odd_and_even_counts() {
        let median = |values: &[f64]| Estimate::of(values.iter().map(|value| Some(*value))).median;
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
        assert_eq!(median(&[7.0]), 7.0);
        assert_eq!(median(&[]), f64::INFINITY);
    }

    #[test]
    fn what_is_lost_is_worse_than_anything() {
        let lost = |survivors: usize| Estimate::of((0..16).map(|i| (i < survivors).then_some(i as f64)));
        assert_eq!(lost(16).median, 7.5);
        assert_eq!((lost(9).median, lost(8).median), (7.5, f64::INFINITY));
        // The 4th and the 13th of 16.
        assert_eq!(lost(13).interval, Some((3.0, 12.0)));
        assert_eq!(lost(12).interval, Some((3.0, f64::INFINITY)));
    }
}
