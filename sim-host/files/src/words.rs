//! Words of messages.

use std::fmt::Display;

/// "1 flight", "2 flights".
pub fn counted<T: Copy + Display + PartialEq + From<u8>>(count: T, noun: &str) -> String {
    let plural = if count == T::from(1) { "" } else { "s" };
    format!("{count} {noun}{plural}")
}

/// A number to so many significant digits; the decimal conversion rounds correctly, hence alike everywhere.
pub fn significant(value: f64, digits: usize) -> f64 {
    format!("{value:.0$e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}

/// What we call something for which pilots have another word, those of PX4 and ArduPilot.
pub fn as_pilots_say(word: &str) -> Option<&'static str> {
    Some(match word {
        "rtl" => "return",
        "loiter" | "brake" => "hold",
        "takeoff" => "take-off",
        "goto" | "reposition" | "waypoint" => "go-to",
        "mission" | "trajectory" | "start" => "follow",
        "terminate" => "kill",
        "gps" => "gnss",
        "compass" => "mag",
        "motor" => "rotor",
        _ => return None,
    })
}

/// A line as a terminal shows it: what would act on the terminal is escaped, and what nobody reads to its end shortened.
pub fn printable(line: &str) -> String {
    const WORD: usize = 240;
    const LINE: usize = 1200;
    let words: Vec<String> = line.split(' ').map(|word| shortened(&escaped(word), WORD)).collect();
    shortened(&words.join(" "), LINE)
}

/// Control characters, and those that turn the direction of what follows, by their numbers.
fn escaped(text: &str) -> String {
    let acts = |c: char| {
        c.is_control() || matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    text.chars().map(|c| if acts(c) { c.escape_default().to_string() } else { c.to_string() }).collect()
}

/// The beginning and the end of a text of more than `most` characters.
fn shortened(text: &str, most: usize) -> String {
    let count = text.chars().count();
    if count <= most {
        return text.to_owned();
    }
    let (begin, end) = (most * 2 / 3, most / 4);
    let part = |from: usize, count: usize| text.chars().skip(from).take(count).collect::<String>();
    format!("{}…{}", part(0, begin), part(count - end, end))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_singular() {
        let texts = [0_u64, 1, 2].map(|count| counted(count, "flight"));
        assert_eq!(texts, ["0 flights", "1 flight", "2 flights"]);
    }

    #[test]
    fn digits_are_counted_from_the_first_that_is_none_zero() {
        let rounded = [0.0, 0.004_876_3, -2.005, 99.96, 123_456.0].map(|value| significant(value, 3));
        assert_eq!(rounded, [0.0, 0.004_88, -2.0, 100.0, 123_000.0]);
    }

    #[test]
    fn what_acts_on_a_terminal_is_escaped() {
        assert_eq!(printable("a `\u{1b}[31m\tb\u{202e}` é"), "a `\\u{1b}[31m\\tb\\u{202e}` é");
    }

    #[test]
    fn what_is_long_keeps_its_beginning_and_its_end() {
        let word = format!("`{}z`", "k".repeat(5000));
        assert_eq!(printable(&format!("key {word} is")), format!("key `{}…{}z` is", "k".repeat(159), "k".repeat(58)));
        assert_eq!(printable(&"word ".repeat(5000)).chars().count(), 800 + 1 + 300);
    }
}
