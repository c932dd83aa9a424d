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

/// A line.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Simulated time, s; none for a line of help.
    pub t_s: Option<f64>,
    /// What it is about.
    pub tone: Tone,
    /// One line of text, without its end.
    pub text: String,
}

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.t_s {
            Some(t_s) => write!(f, "[{t_s:8.2} s] {}", self.text),
            None => write!(f, "  {}", self.text),
        }
    }
}
