//! A line that the console prints.

use core::fmt;

/// Kind of a line, which sets its colour on a terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// An answer, or an expected event.
    Plain,
    /// Something went well: ready, landed.
    Good,
    /// A refused command, or an invalid line.
    Refused,
    /// Something has failed.
    Alarm,
}

/// A line.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Simulated time, s; `None` for a line of help.
    pub t_s: Option<f64>,
    /// Its kind.
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
