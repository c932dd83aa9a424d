//! A line that the console says.

use core::fmt;

/// What a line is about, by which a terminal colours it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// An answer, or something that was to be expected.
    Plain,
    /// Something went well: ready, landed.
    Good,
    /// A refused command, or a line that cannot be read.
    Refused,
    /// Something has failed.
    Alarm,
}

/// A line, stamped with simulated time.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// s.
    pub t_s: f64,
    /// What it is about.
    pub tone: Tone,
    /// One line of text, without its end.
    pub text: String,
}

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "[{:8.2} s] {}", self.t_s, self.text)
    }
}
