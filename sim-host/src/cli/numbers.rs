//! Numbers among the arguments: whatever is wrong with one, the complaint says what it may be.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::str::FromStr;

use crate::refusal::figure;

/// Reads whole numbers of a range.
pub(super) fn whole<T>(range: RangeInclusive<T>) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: FromStr + PartialOrd + Display + Clone,
{
    move |text| {
        let number = text.parse().ok().filter(|number| range.contains(number));
        number.ok_or_else(|| format!("use a whole number from {} to {}", range.start(), range.end()))
    }
}

/// Reads numbers of a range.
pub(super) fn number(range: RangeInclusive<f64>) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| {
        let number = text.parse().ok().filter(|number| range.contains(number));
        number.ok_or_else(|| format!("use a number from {} to {}", figure(*range.start()), figure(*range.end())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_number_may_be_is_said_whatever_is_wrong() {
        assert_eq!(whole(1..=100)("100"), Ok(100));
        for text in ["0", "-5", "101", "1.5", "x", "", "99999999999999999999999"] {
            assert_eq!(whole(1..=100)(text), Err("use a whole number from 1 to 100".to_owned()), "{text}");
        }
        assert_eq!(number(1.0..=1e6)("1e3"), Ok(1000.0));
        for text in ["0", "-5", "inf", "nan", "5x", ""] {
            assert_eq!(number(1.0..=1e6)(text), Err("use a number from 1 to 1e6".to_owned()), "{text}");
        }
    }
}
