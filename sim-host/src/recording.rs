//! What comes to the vehicle from outside in a flight by hand, as a text file, so that `run` and `pil` fly it again.
//!
//! ```text
//! glissade-recording 1
//! scenario field
//! set wind=false
//! seed 1
//! files 5f70bf18a0…              SHA-256 of the scenario's files
//! 0 link 0 open normal           before tick 0 link 0 is opened; or `onboard`
//! 812 link 0 hex fd09000000ff…   bytes of a ground station
//! 812 link 0 lost 17             bytes that did not fit
//! 2000 ask takeoff 5             what was typed, as the vehicle is asked
//! 9000 link 0 close
//! 12000 end
//! ```

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use anyhow::{Context as _, Result};
use firmware::mavlink::port::{LinkEvent, Profile};
use firmware::signals::Tick;
use sha2::{Digest as _, Sha256};

use crate::console::ConsoleInput;
use crate::report::truth::hex;
use crate::scenario::Scenario;

pub use read::Recording;

mod asked;
mod read;
#[cfg(test)]
mod tests;

/// The first line, with the format's version.
const FIRST: &str = "glissade-recording 1";

/// A flight that is recorded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Header {
    /// The scenario's name, or the path it was read from.
    pub scenario: String,
    /// Its settings.
    pub set: Vec<String>,
    /// The seed.
    pub seed: u64,
    /// SHA-256 of the scenario's files.
    pub files: String,
}

impl Header {
    /// Of a scenario as loaded with `set`, flown with a seed.
    ///
    /// # Errors
    /// None for a scenario that was loaded.
    pub fn new(scenario: &Scenario, set: &[String], seed: u64) -> Result<Self> {
        let mut hash = Sha256::new();
        scenario.files()?.iter().for_each(|(_, text)| hash.update(text));
        let files = hex(&hash.finalize());
        // A setting is one line here, however it was given.
        let set = set.iter().map(|setting| setting.replace(['\n', '\r'], " ")).collect();
        Ok(Self { scenario: scenario.name.clone(), set, seed, files })
    }
}

/// Settings as arguments of the command line, each with a space before it.
pub fn arguments(set: &[String]) -> String {
    set.iter().fold(String::new(), |text, setting| text + " --set '" + setting + "'")
}

/// Writes a recording. An error is kept, and returned by the next [`flush`](Self::flush).
#[derive(Debug)]
pub struct Recorder<W = BufWriter<File>> {
    out: W,
    result: std::io::Result<()>,
    /// Whether it can be flown again.
    is_whole: bool,
    /// Notes for who types.
    notes: Vec<String>,
}

impl Recorder {
    /// Begins a file, which must not be there yet.
    ///
    /// # Errors
    /// It is there, or cannot be written.
    pub fn create(path: &Path, header: &Header) -> Result<Self> {
        let file = File::create_new(path).with_context(|| {
            let there = path.exists();
            let what = if there { "a recording replaces no file: name another, or remove" } else { "cannot write" };
            format!("{what} {}", path.display())
        })?;
        Ok(Self::new(BufWriter::new(file), header))
    }
}

impl<W: Write> Recorder<W> {
    /// Begins a recording.
    pub fn new(mut out: W, header: &Header) -> Self {
        let Header { scenario, set, seed, files } = header;
        let set = set.iter().fold(String::new(), |text, setting| text + "set " + setting + "\n");
        let result = write!(out, "{FIRST}\nscenario {scenario}\n{set}seed {seed}\nfiles {files}\n");
        Self { out, result, is_whole: true, notes: Vec::new() }
    }

    /// Something has happened on a link before a tick.
    pub fn link(&mut self, tick: Tick, link: usize, event: LinkEvent) {
        let what = match event {
            LinkEvent::Open(Profile::Normal) => "open normal".to_owned(),
            LinkEvent::Open(Profile::Onboard) => "open onboard".to_owned(),
            LinkEvent::Close => "close".to_owned(),
            LinkEvent::Lost(count) => format!("lost {count}"),
            LinkEvent::Received(bytes) => format!("hex {}", hex(bytes)),
        };
        self.line(format_args!("{tick} link {link} {what}"));
    }

    /// A typed line acts on the flight before a tick.
    pub fn console(&mut self, tick: Tick, input: &ConsoleInput) {
        match input {
            ConsoleInput::Asked(asked) => self.line(format_args!("{tick} ask {}", asked::text(asked))),
            ConsoleInput::World(line) => {
                if self.is_whole {
                    self.notes.push(format!(
                        "the recording cannot be flown again from `{line}` on: give the scenario its wind and faults by \
                         --set, or inject failures by MAVLink"
                    ));
                }
                self.is_whole = false;
                self.line(format_args!("{tick} world {line}"));
            }
        }
    }

    /// Whether it can be flown again: nothing that was typed has changed the world.
    pub fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// The notes for who types since the last call.
    pub fn take_notes(&mut self) -> Vec<String> {
        core::mem::take(&mut self.notes)
    }

    /// The flight has ended before this tick.
    ///
    /// # Errors
    /// The recording could not be written.
    pub fn finish(&mut self, tick: Tick) -> Result<()> {
        self.line(format_args!("{tick} end"));
        self.flush()
    }

    /// Writes what is still to be written.
    ///
    /// # Errors
    /// The recording could not be written.
    pub fn flush(&mut self) -> Result<()> {
        core::mem::replace(&mut self.result, Ok(()))
            .and_then(|()| self.out.flush())
            .context("cannot write the recording")
    }

    /// What it was written to.
    pub fn into_inner(self) -> W {
        self.out
    }

    fn line(&mut self, text: std::fmt::Arguments) {
        if self.result.is_ok() {
            self.result = writeln!(self.out, "{text}");
        }
    }
}
