//! A range of seeds, as the command line and matrix files write it: `1..8`, both ends included.

use core::str::FromStr;

use anyhow::{Context, Error, Result, ensure};
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

    /// Whether a seed is in both ranges.
    pub fn overlaps(self, other: Self) -> bool {
        self.first <= other.last && other.first <= self.last
    }
}

impl FromStr for Seeds {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let (first, last) = text.split_once("..").context("use A..B, as in 1..8")?;
        let number = |text: &str| text.parse::<u64>().with_context(|| format!("`{text}` is not a seed"));
        let seeds = Self { first: number(first)?, last: number(last.trim_start_matches('='))? };
        ensure!(
            seeds.first <= seeds.last && seeds.last - seeds.first < 1_000_000,
            "the first seed comes first, and a million are enough"
        );
        Ok(seeds)
    }
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
        for bad in ["", "1", "8..1", "a..b", "1..", "0..18446744073709551615"] {
            assert!(bad.parse::<Seeds>().is_err(), "{bad}");
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
