//! Reads typed lines or keys, and prints: on a terminal, or through pipes.
//!
//! On a terminal the typed line stays below the printed ones: the terminal's own echo and line editing are switched
//! off, and `Editor` takes their place. Pipes carry whole lines. Who flies by keys types a line after a colon.

use std::collections::VecDeque;
use std::io::{IsTerminal as _, Read as _, Write as _};
use std::sync::mpsc::{Receiver, channel};
use std::time::Instant;

use super::editor::Editor;
use super::keyboard::{Decoder, Key};
use super::line::{Line, Tone};
use crate::report::paint::{Colour, Paint, stdout_takes_escapes};
use crate::tty;

/// Source of typed lines and destination of printed ones.
pub trait Terminal {
    /// The next typed line, if any; does not wait.
    fn next_line(&mut self) -> Option<String>;

    /// The next key that is no part of a line, if any; does not wait.
    fn next_key(&mut self) -> Option<Key> {
        None
    }

    /// Prints a line at once.
    fn print(&mut self, line: &Line);
}

/// What keys are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum For {
    /// Lines, always.
    Lines,
    /// Flying, until a colon begins a line.
    Flying,
    /// The line after a colon.
    OneLine,
}

/// Standard input and output. The end of standard input is no reason to stop.
#[derive(Debug)]
pub struct Stdio {
    typed: Receiver<Vec<u8>>,
    decoder: Decoder,
    editor: Editor,
    keys_are: For,
    /// Keys to fly by that were not taken yet.
    keys: VecDeque<Key>,
    /// Whether the typed line is drawn below the printed ones.
    draws: bool,
    paint: Paint,
}

impl Stdio {
    /// Starts to read lines from standard input in a thread.
    pub fn new() -> Self {
        let draws = std::io::stdin().is_terminal() && stdout_takes_escapes() && tty::take();
        Self::reading(For::Lines, draws)
    }

    /// Starts to read keys from the terminal on standard input; `None` if that is none.
    pub fn with_keys() -> Option<Self> {
        let is_terminal = std::io::stdin().is_terminal() && tty::take();
        is_terminal.then(|| Self::reading(For::Flying, stdout_takes_escapes()))
    }

    fn reading(keys_are: For, draws: bool) -> Self {
        let mut stdio = Self {
            typed: read_in_thread(),
            decoder: Decoder::default(),
            editor: Editor::default(),
            keys_are,
            keys: VecDeque::new(),
            draws,
            paint: Paint::for_stdout(),
        };
        stdio.show_typed();
        stdio
    }

    /// What stands before the typed line.
    fn prompt(&self) -> &'static str {
        match self.keys_are {
            For::Lines => "> ",
            For::Flying => "keys fly; ? lists them ",
            For::OneLine => ":",
        }
    }

    /// Shows the line being typed, below what has been printed.
    fn show_typed(&mut self) {
        if self.draws {
            let mut out = std::io::stdout().lock();
            let _ = write!(out, "\r\x1b[K{}{}", self.prompt(), self.editor.typed()).and_then(|()| out.flush());
        }
    }

    /// Takes what was typed until now, up to the end of a line. Whether anything was.
    fn read(&mut self) -> bool {
        let mut changed = false;
        while !self.editor.has_line()
            && let Ok(bytes) = self.typed.try_recv()
        {
            for byte in bytes {
                if let Some(key) = self.decoder.take(byte) {
                    self.take(key);
                }
            }
            changed = true;
        }
        if self.decoder.is_alone(Instant::now()) && self.keys_are == For::OneLine {
            self.editor.leave();
            self.keys_are = For::Flying;
            changed = true;
        }
        changed
    }

    fn take(&mut self, key: Key) {
        match (self.keys_are, key) {
            (For::Flying, Key::Byte(b':')) => self.keys_are = For::OneLine,
            (For::Flying, _) => self.keys.push_back(key),
            (For::Lines | For::OneLine, _) => self.editor.take(key),
        }
        if self.keys_are == For::OneLine && self.editor.has_line() {
            self.keys_are = For::Flying;
        }
    }
}

impl Default for Stdio {
    fn default() -> Self {
        Self::new()
    }
}

impl Terminal for Stdio {
    fn next_line(&mut self) -> Option<String> {
        let changed = self.read();
        if let (Some(names), true) = (self.editor.offered.take(), self.draws) {
            let _ = writeln!(std::io::stdout(), "\r\x1b[K  {names}");
        }
        let line = self.editor.take_line();
        if let (Some(line), true) = (&line, self.draws) {
            // Leaves what was typed above the answer.
            let before = if self.keys_are == For::Lines { "> " } else { ":" };
            let _ = writeln!(std::io::stdout(), "\r\x1b[K{before}{line}");
        }
        if changed || line.is_some() {
            self.show_typed();
        }
        line
    }

    fn next_key(&mut self) -> Option<Key> {
        self.keys.pop_front()
    }

    fn print(&mut self, line: &Line) {
        let start = if self.draws { "\r\x1b[K" } else { "" };
        let text = self.paint.line(colour(line.tone), &line.to_string());
        if writeln!(std::io::stdout(), "{start}{text}").is_err() {
            // As in `sim-host serve | head`: nobody is there to read any more.
            crate::interrupt::request();
        }
        self.show_typed();
    }
}

impl Drop for Stdio {
    fn drop(&mut self) {
        if self.draws {
            let _ = write!(std::io::stdout(), "\r\x1b[K").and_then(|()| std::io::stdout().flush());
        }
        tty::give_back();
    }
}

/// Reads standard input in a thread; the receiver gets the bytes as they arrive.
fn read_in_thread() -> Receiver<Vec<u8>> {
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        let mut bytes = [0; 1024];
        while let Ok(count @ 1..) = std::io::stdin().read(&mut bytes) {
            if sender.send(bytes[..count].to_vec()).is_err() {
                return;
            }
        }
        // The last line may have no end.
        let _ = sender.send(b"\n".to_vec());
    });
    receiver
}

const fn colour(tone: Tone) -> Colour {
    match tone {
        Tone::Plain => Colour::None,
        Tone::Good => Colour::Green,
        Tone::Refused => Colour::Yellow,
        Tone::Alarm => Colour::Red,
    }
}
