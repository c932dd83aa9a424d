//! A range of seeds, as the command line and matrix files write it: `1..8`, both ends included.

use core::str::FromStr;

use anyhow::{Context, Error, Result, anyhow, ensure};
use serde::{Deserialize, Serialize};

/// A range of seeds, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Seeds {
    /// The first.
    pub first: u64,
    /// The last.
    pub last: u64,
}

impl Seeds {
    /// How many there are.
    pub fn count(self) -> u64 {
        self.last - self.first + 1
    }

    /// All of them.
    pub fn all(self) -> Vec<u64> {
        (self.first..=self.last).collect()
    }

    /// Whether a seed is in both ranges.
    pub fn overlaps(self, other: Self) -> bool {
        self.first <= other.last && other.first <= self.last
    }
}

impl FromStr for Seeds {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let (first, last) = text.split_once("..").with_context(|| match text.parse::<u64>() {
            Ok(one) => format!("seeds are a range, first and last: use {one}..{one} for one flight"),
            Err(_) => "seeds are a range, first and last: use A..B, as in 1..8".to_owned(),
        })?;
        let (first, last) = (number(first)?, number(last.trim_start_matches('='))?);
        ensure!(first <= last, "{text} runs backwards: use {last}..{first}");
        ensure!(last - first < MOST, "{text} are more than {MOST} seeds: fly fewer");
        Ok(Self { first, last })
    }
}

/// More seeds than anyone waits for.
const MOST: u64 = 1_000_000;

/// One seed.
///
/// # Errors
/// One line with what a seed may be.
pub fn number(text: &str) -> Result<u64> {
    text.parse().map_err(|_| anyhow!("`{text}` is not a seed: use a whole number from 0 to {}", u64::MAX))
}

impl TryFrom<String> for Seeds {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse().map_err(|error| format!("{error:#}"))
    }
}

impl From<Seeds> for String {
    fn from(seeds: Seeds) -> Self {
        format!("{}..{}", seeds.first, seeds.last)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seeds_are_two_numbers_in_order() {
        assert_eq!("1..8".parse::<Seeds>().expect("valid"), Seeds { first: 1, last: 8 });
        assert_eq!("1..=8".parse::<Seeds>().expect("valid"), Seeds { first: 1, last: 8 });
    }

    #[test]
    fn a_range_that_is_none_says_what_it_ought_to_be() {
        for (bad, expected) in [
            ("", "use A..B"),
            ("5", "use 5..5 for one flight"),
            ("9..3", "9..3 runs backwards: use 3..9"),
            ("a..b", "`a` is not a seed"),
            ("1..", "`` is not a seed"),
            ("-1..3", "`-1` is not a seed"),
            ("0..18446744073709551615", "more than 1000000 seeds"),
            (
                "0..18446744073709551616",
                "`18446744073709551616` is not a seed: use a whole number from 0 to 18446744073709551615",
            ),
        ] {
            let error = format!("{:#}", bad.parse::<Seeds>().expect_err(bad));
            assert!(error.contains(expected), "{bad}: {error}");
        }
    }

    #[test]
    fn ranges_overlap_if_a_seed_is_in_both() {
        let seeds = |text: &str| text.parse::<Seeds>().expect("valid");
        assert_eq!(seeds("1001..1016").count(), 16);
        for (other, overlap) in [("1..4", false), ("1..5", true), ("6..7", true), ("9..12", true), ("10..12", false)] {
            assert_eq!(seeds("5..9").overlaps(seeds(other)), overlap, "{other}");
            assert_eq!(seeds(other).overlaps(seeds("5..9")), overlap, "{other}");
        }
    }
}
