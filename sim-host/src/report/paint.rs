//! Colour, where the terminal has it.

use std::io::IsTerminal as _;

/// What is said of a flight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It did what it should.
    Good,
    /// It was flown to its end, but not where it should have been.
    Off,
    /// It did not do what it should, or was lost.
    Failed,
}

/// Colours, or none.
#[derive(Clone, Copy, Debug, Default)]
pub struct Paint {
    on: bool,
}

/// Colour of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// The terminal's own.
    None,
    /// Something has failed.
    Red,
    /// Something went well.
    Green,
    /// Something was refused.
    Yellow,
}

impl Paint {
    /// None: for files and pipes.
    pub const PLAIN: Self = Self { on: false };

    /// For standard output: none unless it is a terminal, nor if `NO_COLOR` is set or `TERM` is `dumb`.
    pub fn for_stdout() -> Self {
        let wanted = std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
        Self { on: wanted && stdout_takes_escapes() }
    }

    /// A whole line in one colour.
    pub fn line(self, colour: Colour, text: &str) -> String {
        match colour {
            Colour::None => text.to_owned(),
            Colour::Red => self.paint("31", text),
            Colour::Green => self.paint("32", text),
            Colour::Yellow => self.paint("33", text),
        }
    }

    /// Bold: green for what is well, yellow for what was flown but not as it should be, red for what failed.
    pub fn verdict(self, text: &str, how: Verdict) -> String {
        let code = match how {
            Verdict::Good => "1;32",
            Verdict::Off => "1;33",
            Verdict::Failed => "1;31",
        };
        self.paint(code, text)
    }

    /// Dim, line by line: for what matters less.
    pub fn dim(self, text: &str) -> String {
        text.split_inclusive('\n').map(|line| self.dim_line(line)).collect()
    }

    fn dim_line(self, line: &str) -> String {
        let bare = line.trim_end_matches('\n');
        self.paint("2", bare) + &line[bare.len()..]
    }

    fn paint(self, code: &str, text: &str) -> String {
        if self.on && !text.is_empty() { format!("\x1b[{code}m{text}\x1b[0m") } else { text.to_owned() }
    }
}

/// Whether standard output is a terminal that knows escape sequences: `TERM` is set, and not `dumb`.
pub fn stdout_takes_escapes() -> bool {
    std::env::var_os("TERM").is_some_and(|term| term != "dumb") && std::io::stdout().is_terminal()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colour_is_around_the_text_and_nowhere_without_a_terminal() {
        let paint = Paint { on: true };
        assert_eq!(paint.verdict("well", Verdict::Good), "\x1b[1;32mwell\x1b[0m");
        assert_eq!(paint.verdict("so so", Verdict::Off), "\x1b[1;33mso so\x1b[0m");
        assert_eq!(paint.dim("a\n\nb\n"), "\x1b[2ma\x1b[0m\n\n\x1b[2mb\x1b[0m\n");
        assert_eq!(paint.line(Colour::Yellow, "refused"), "\x1b[33mrefused\x1b[0m");
        assert_eq!((paint.line(Colour::None, "a"), Paint::PLAIN.line(Colour::Red, "b")), ("a".into(), "b".into()));
        assert_eq!(Paint::PLAIN.verdict("well", Verdict::Failed) + &Paint::PLAIN.dim("a\n"), "wella\n");
    }
}
