//! Ensembles: percentiles of the measures over many seeds of a scenario, compared with the expectations.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use anyhow::{Context, Result};
use serde::Serialize;

use super::consistency::{Innovations, STATES};
use super::{Assess, Expectation, Measure, Measures};
use crate::flight;
use crate::parallel;
use crate::scenario::Scenario;
use crate::seeds::Seeds;

/// Percentiles of a measure over the seeds. A flight without the measure counts as worse than any.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// What.
    pub measure: Measure,
    /// Number of flights that have the measure.
    pub count: usize,
    /// 5th, 50th, 95th percentile and the greatest; null if too few flights have the measure.
    pub p5: Option<f64>,
    /// The median.
    pub p50: Option<f64>,
    /// The 95th percentile.
    pub p95: Option<f64>,
    /// The greatest.
    pub max: Option<f64>,
    /// The root mean square.
    pub rms: Option<f64>,
}

/// An expectation and its result.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// The expectation.
    #[serde(flatten)]
    pub expected: Expectation,
    /// The percentile found.
    pub found: Option<f64>,
    /// Whether it is within the bounds; none where too few seeds were flown to judge it.
    pub met: Option<bool>,
    /// Seeds that it takes to judge it.
    pub seeds_needed: u64,
}

/// Consistency of the innovations of one kind of reading.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Nis {
    /// Of what.
    pub reading: String,
    /// How many.
    pub count: u64,
    /// Mean of the normalised innovation squared over its degrees of freedom: 1 if the filter is consistent.
    pub mean: f64,
    /// Fraction within the 95 % quantile of χ².
    pub within_95: f64,
    /// Fraction refused by the gate.
    pub refused: f64,
    /// Fraction of the samples at which the mean over the flights is within its 95 % band.
    pub within_band: f64,
}

/// Consistency of the estimation errors.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Nees {
    /// Number of times at which all flights were sampled.
    pub looks: usize,
    /// Mean over flights and times of eᵀP⁻¹e over its degrees of freedom: 1 if the filter is consistent.
    pub mean: f64,
    /// 95 % band of such a mean over the flights at one time.
    pub band: (f64, f64),
    /// Fraction of the times at which the mean over the flights is within it.
    pub within_band: f64,
    /// Fraction of all errors below the 95 % quantile of χ².
    pub within_95: f64,
    /// Mean over the degrees of freedom of attitude, velocity and position alone.
    pub parts: [f64; 3],
}

/// Result of an ensemble.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Name of the scenario.
    pub scenario: String,
    /// Seeds flown.
    pub seeds: Seeds,
    /// By measure.
    pub rows: Vec<Row>,
    /// By kind of reading.
    pub nis: Vec<Nis>,
    /// Of attitude, velocity and position.
    pub nees: Option<Nees>,
    /// The expectation.
    pub verdicts: Vec<Verdict>,
    /// Whether the errors and innovations are within their bands as often as expected; none if nothing is, or by too few
    /// seeds.
    pub consistent: Option<bool>,
    /// Seeds that it takes to judge that, where they are too few.
    pub bands_need: Option<u64>,
}

/// Seeds from which on the band of a mean over them is good: its χ² has a degree of freedom for each flight at least, and
/// the approximation of the quantile wants 30.
const SEEDS_FOR_BANDS: u64 = 30;

/// Seeds from which on the 5th and the 95th percentile are others than the least and the greatest.
const SEEDS_FOR_TAILS: u64 = 20;

/// A percentile of sorted values by nearest rank; none without any.
pub fn percentile(sorted: &[f64], percent: f64) -> Option<f64> {
    let rank = (percent / 100.0 * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.clamp(1, sorted.len().max(1)) - 1).copied()
}

/// The root mean square of values; none without any.
fn root_mean_square(values: &[f64]) -> Option<f64> {
    let sum: f64 = values.iter().map(|value| value * value).sum();
    (!values.is_empty()).then(|| (sum / values.len() as f64).sqrt())
}

/// Flies a scenario under every seed and assesses the flights.
///
/// # Errors
/// The scenario's name, if it is not one that is judged, or what of it the firmware refuses.
pub fn fly(scenario: &Scenario, seeds: Seeds, flown: impl Fn() + Sync) -> Result<Report> {
    let assess = scenario.file.assess.as_ref().with_context(|| {
        format!(
            "scenario `{}` has no `[assess]`, which says what is expected of it: add one, or fly those that have by \
             `sim-host assess` alone",
            scenario.name
        )
    })?;
    assess.require_part_of(scenario.file.duration_s).with_context(|| format!("scenario `{}`", scenario.name))?;
    let measured: Vec<Measures> = parallel::try_map(&seeds.all(), |seed| {
        let measures = flight::assess(scenario, assess, *seed);
        flown();
        measures
    })?;
    Ok(report(&scenario.name, seeds, assess, &measured))
}

fn report(scenario: &str, seeds: Seeds, assess: &Assess, flights: &[Measures]) -> Report {
    let verdict = |expected: &Expectation| {
        let missing = if expected.at_most.is_some() { f64::INFINITY } else { f64::NEG_INFINITY };
        let values = sorted(flights, expected.measure, missing);
        let found = match expected.percentile {
            Some(percent) => percentile(&values, percent),
            None => root_mean_square(&values),
        };
        let found = found.filter(|value| value.is_finite());
        let met = expected.holds(found);
        let seeds_needed = expected.seeds_needed();
        let met = (seeds.count() >= seeds_needed).then_some(met);
        Verdict { expected: *expected, found, met, seeds_needed }
    };
    let (nis, nees) = (nis(flights), nees(flights));
    let is_judged = seeds.count() >= SEEDS_FOR_BANDS;
    let bands_need = assess.consistent.filter(|_| !is_judged).map(|_| SEEDS_FOR_BANDS);
    let consistent = assess.consistent.filter(|_| is_judged).map(|least| {
        let errors = nees.as_ref().is_some_and(|nees| nees.within_band >= least);
        // Zero-velocity updates and drag are not readings of a sensor: their noise is assumed, so they are not assessed.
        let sensors = || nis.iter().filter(|nis| !matches!(nis.reading.as_str(), "rest" | "drag"));
        errors && sensors().all(|nis| nis.within_band >= least)
    });
    Report {
        consistent,
        bands_need,
        scenario: scenario.to_owned(),
        seeds,
        rows: Measure::ALL.iter().filter_map(|measure| row(flights, *measure)).collect(),
        nis,
        nees,
        verdicts: assess.expect.iter().map(verdict).collect(),
    }
}

/// A measure over the flights, with what stands for those that have none.
fn sorted(flights: &[Measures], measure: Measure, missing: f64) -> Vec<f64> {
    let mut values: Vec<f64> = flights.iter().map(|flight| flight.get(measure).unwrap_or(missing)).collect();
    values.sort_by(f64::total_cmp);
    values
}

fn row(flights: &[Measures], measure: Measure) -> Option<Row> {
    let values = sorted(flights, measure, f64::INFINITY);
    let count = values.iter().filter(|value| value.is_finite()).count();
    let at = |percent| percentile(&values, percent).filter(|value| value.is_finite());
    let rms = root_mean_square(&values).filter(|value| value.is_finite());
    (count > 0).then(|| Row { measure, count, p5: at(5.0), p50: at(50.0), p95: at(95.0), max: at(100.0), rms })
}

fn nis(flights: &[Measures]) -> Vec<Nis> {
    let mut all: BTreeMap<&str, Innovations> = BTreeMap::new();
    for (name, one) in flights.iter().flat_map(|flight| &flight.consistency.innovations) {
        let sum = all.entry(name).or_default();
        sum.degrees = one.degrees;
        sum.count += one.count;
        sum.sum += one.sum;
        sum.within += one.within;
        sum.refused += one.refused;
    }
    let one = |(name, all): (&str, Innovations)| {
        let accepted = (all.count - all.refused).max(1) as f64;
        let count = all.count.max(1) as f64;
        let looks =
            |flight: &Measures| flight.consistency.innovations.get(name).map(|i| i.looks.clone()).unwrap_or_default();
        let looks: Vec<Vec<f64>> = flights.iter().map(looks).collect();
        Nis {
            reading: name.to_owned(),
            count: all.count,
            mean: all.sum / accepted / f64::from(all.degrees),
            within_band: within_band(&looks, f64::from(all.degrees)).map_or(0.0, |(_, within)| within),
            within_95: all.within as f64 / count,
            refused: all.refused as f64 / count,
        }
    };
    all.into_iter().map(one).collect()
}

/// χ² quantile by the approximation of Wilson and Hilferty (1931), good to 0.1 % beyond 30 degrees of freedom.
fn chi_square(degrees: f64, normal: f64) -> f64 {
    let spread = 2.0 / (9.0 * degrees);
    degrees * (1.0 - spread + normal * spread.sqrt()).powi(3)
}

/// Band that holds a mean over so many flights of χ²/degrees with 95 % probability.
fn band(flights: usize, degrees: f64) -> (f64, f64) {
    /// 97.5 % quantile of the normal distribution.
    const TWO_SIDED: f64 = 1.96;
    let all = flights as f64 * degrees;
    (chi_square(all, -TWO_SIDED) / all, chi_square(all, TWO_SIDED) / all)
}

/// Means over the flights at each look that all have, over the degrees of freedom, and the part of them within the band.
fn within_band(looks: &[Vec<f64>], degrees: f64) -> Option<(Vec<f64>, f64)> {
    let count = looks.iter().map(Vec::len).min().filter(|count| *count > 0)?;
    let at = |look: usize| looks.iter().map(|flight| flight[look]).sum::<f64>() / looks.len() as f64 / degrees;
    let means: Vec<f64> = (0..count).map(at).collect();
    let (low, high) = band(looks.len(), degrees);
    let within = means.iter().filter(|mean| (low..=high).contains(*mean)).count();
    Some((means, within as f64 / count as f64))
}

fn nees(flights: &[Measures]) -> Option<Nees> {
    /// 95 % quantile of χ² with nine degrees of freedom.
    const QUANTILE: f64 = 16.919;
    let errors: Vec<Vec<f64>> =
        flights.iter().map(|flight| flight.consistency.nees.iter().map(|nees| nees[0]).collect()).collect();
    let (means, within_band) = within_band(&errors, STATES as f64)?;
    let looks = means.len();
    let all = || flights.iter().flat_map(|flight| &flight.consistency.nees[..looks]);
    let count = (looks * flights.len()) as f64;
    Some(Nees {
        looks,
        mean: means.iter().sum::<f64>() / looks as f64,
        band: band(flights.len(), STATES as f64),
        within_band,
        within_95: all().filter(|nees| nees[0] <= QUANTILE).count() as f64 / count,
        parts: [1, 2, 3].map(|part| all().map(|nees| nees[part]).sum::<f64>() / (3.0 * count)),
    })
}

impl Report {
    /// Whether all expectations are met.
    pub fn is_met(&self) -> bool {
        self.verdicts.iter().all(|verdict| verdict.met != Some(false)) && self.consistent != Some(false)
    }

    /// Seeds that it takes to judge everything, where there are too few.
    pub fn seeds_needed(&self) -> Option<u64> {
        let lacking = self.verdicts.iter().filter(|verdict| verdict.met.is_none());
        lacking.map(|verdict| verdict.seeds_needed).chain(self.bands_need).max()
    }

    /// As a text for the terminal.
    pub fn render(&self) -> String {
        let mut text = format!("{}, seeds {}..{}\n\n", self.scenario, self.seeds.first, self.seeds.last);
        let _ = writeln!(
            text,
            "{:26} {:>6} {:>10} {:>10} {:>10} {:>10} {:>10}",
            "", "count", "p5", "p50", "p95", "max", "rms"
        );
        for row in &self.rows {
            let [p5, p50, p95, max, rms] = [row.p5, row.p50, row.p95, row.max, row.rms].map(number);
            let name = row.measure.name();
            let _ = writeln!(text, "{name:26} {:>6} {p5:>10} {p50:>10} {p95:>10} {max:>10} {rms:>10}", row.count);
        }
        if self.seeds.count() < SEEDS_FOR_TAILS {
            let _ = writeln!(
                text,
                "p5 and p95 of so few seeds are the least and the greatest: {SEEDS_FOR_TAILS} seeds or more tell them apart"
            );
        }
        let _ = writeln!(
            text,
            "\n{:26} {:>8} {:>10} {:>10} {:>10} {:>10}",
            "innovations", "count", "mean/dof", "within 95", "in band", "refused"
        );
        for nis in &self.nis {
            let Nis { reading, count, mean, within_95, refused, within_band } = nis;
            let _ = writeln!(
                text,
                "{reading:26} {count:>8} {mean:>10.3} {within_95:>10.3} {within_band:>10.3} {refused:>10.4}"
            );
        }
        if let Some(nees) = &self.nees {
            let Nees { mean, band: (low, high), within_band, within_95, parts: [a, v, p], .. } = nees;
            let _ = writeln!(
                text,
                "\nerrors (attitude, velocity, position): mean/dof {mean:.3}, band {low:.3} to {high:.3} held {within_band:.2} of the time, within 95 %: {within_95:.3}; apart {a:.3} {v:.3} {p:.3}"
            );
        }
        if let Some(met) = self.consistent {
            let _ = writeln!(
                text,
                "errors and innovations within their bands (drag and rest apart, whose noise is assumed): {}",
                if met { "met" } else { "NOT MET" }
            );
        }
        if let Some(needed) = self.bands_need {
            let _ = writeln!(text, "errors and innovations within their bands: too few seeds, {needed} needed");
        }
        for verdict in &self.verdicts {
            let Verdict { expected, found, met, seeds_needed } = verdict;
            let bound = match (expected.at_most, expected.at_least) {
                (Some(most), _) => format!("at most {most}"),
                (None, Some(least)) => format!("at least {least}"),
                (None, None) => String::new(),
            };
            let verdict = match met {
                None => format!("too few seeds, {seeds_needed} needed"),
                Some(true) => "met".to_owned(),
                Some(false) => "NOT MET".to_owned(),
            };
            let (name, percent) = (expected.measure.name(), expected.percentile);
            let of = percent.map_or_else(|| "rms".to_owned(), |percent| format!("p{percent}"));
            let _ = writeln!(text, "{of} of {name}: {} ({bound}): {verdict}", number(*found));
        }
        text
    }
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.4}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_percentile_is_the_value_of_its_rank() {
        let values: Vec<f64> = (1..=100).map(f64::from).collect();
        assert_eq!(percentile(&values, 95.0), Some(95.0));
        assert_eq!(percentile(&values, 100.0), Some(100.0));
        assert_eq!(percentile(&values, 0.0), Some(1.0));
        assert_eq!(percentile(&values[..3], 50.0), Some(2.0));
        assert_eq!(percentile(&[], 50.0), None);
        let tail = |count: usize| (percentile(&values[..count], 95.0), percentile(&values[..count], 100.0));
        assert_eq!((tail(19), tail(20)), ((Some(19.0), Some(19.0)), (Some(19.0), Some(20.0))));
    }

    #[test]
    fn few_seeds_judge_the_worst_and_no_percentile() {
        let expected =
            |percentile| Expectation { measure: Measure::TouchdownMS, percentile, at_most: Some(1.0), at_least: None };
        for (percentile, needed) in [(Some(95.0), 20), (Some(5.0), 20), (Some(50.0), 2), (Some(100.0), 1), (None, 20)] {
            assert_eq!(expected(percentile).seeds_needed(), needed, "{percentile:?}");
        }
        let assess =
            Assess { from_s: 0.0, to_s: None, hold_m: None, consistent: Some(0.8), expect: vec![expected(Some(95.0))] };
        let judged = |last| report("x", Seeds { first: 1, last }, &assess, &[]);
        let (few, many) = (judged(19), judged(30));
        assert!(few.is_met() && few.seeds_needed() == Some(30) && few.render().contains("too few seeds, 20 needed"));
        assert!(few.render().contains("\np5 and p95 of so few seeds are the least and the greatest: 20 seeds or more"));
        assert!(!many.render().contains("so few seeds"));
        assert!(!many.is_met() && many.seeds_needed().is_none() && many.render().contains("NOT MET"));
    }

    #[test]
    fn the_band_is_that_of_tables() {
        // χ² of 100 degrees of freedom: 74.22 and 129.56.
        assert!((chi_square(100.0, -1.96) - 74.22).abs() < 0.1);
        assert!((chi_square(100.0, 1.96) - 129.56).abs() < 0.1);
    }
}
