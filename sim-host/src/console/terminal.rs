//! Reads typed lines and prints: on a terminal, or through pipes.
//!
//! On a terminal the typed line stays below the printed ones: the terminal's own echo and line editing are switched
//! off, and `Editor` takes their place. Pipes carry whole lines.

use std::io::{IsTerminal as _, Read as _, Write as _};
use std::sync::mpsc::{Receiver, channel};

use rustix::termios::{LocalModes, OptionalActions, Termios, tcgetattr, tcsetattr};

use super::line::{Line, Tone};
use super::parse::completions;
use crate::report::paint::{Colour, Paint, stdout_takes_escapes};

/// Source of typed lines and destination of printed ones.
pub trait Terminal {
    /// The next typed line, if any; does not wait.
    fn next_line(&mut self) -> Option<String>;

    /// Prints a line at once.
    fn print(&mut self, line: &Line);
}

/// Standard input and output. The end of standard input is no reason to stop.
#[derive(Debug)]
pub struct Stdio {
    typed: Receiver<Vec<u8>>,
    editor: Editor,
    /// The terminal's settings before; `None` with pipes.
    before: Option<Termios>,
    paint: Paint,
}

/// Prompt before the typed line.
const PROMPT: &str = "> ";

impl Stdio {
    /// Starts to read standard input in a thread.
    pub fn new() -> Self {
        let is_terminal = std::io::stdin().is_terminal() && stdout_takes_escapes();
        let before = if is_terminal { without_echo() } else { None };
        let paint = Paint::for_stdout();
        let mut stdio = Self { typed: read_in_thread(), editor: Editor::default(), before, paint };
        stdio.show_typed();
        stdio
    }

    /// Shows the line being typed, below what has been printed.
    fn show_typed(&mut self) {
        if self.before.is_some() {
            let mut out = std::io::stdout().lock();
            let _ = write!(out, "\r\x1b[K{PROMPT}{}", self.editor.typed()).and_then(|()| out.flush());
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
        let mut changed = false;
        while !self.editor.has_line()
            && let Ok(bytes) = self.typed.try_recv()
        {
            for byte in bytes {
                self.editor.feed(byte);
            }
            changed = true;
        }
        if let (Some(names), Some(_)) = (self.editor.offered.take(), &self.before) {
            let _ = writeln!(std::io::stdout(), "\r\x1b[K  {names}");
        }
        let line = self.editor.take_line();
        if let (Some(line), Some(_)) = (&line, &self.before) {
            // Leaves what was typed above the answer.
            let _ = writeln!(std::io::stdout(), "\r\x1b[K{PROMPT}{line}");
        }
        if changed || line.is_some() {
            self.show_typed();
        }
        line
    }

    fn print(&mut self, line: &Line) {
        let start = if self.before.is_some() { "\r\x1b[K" } else { "" };
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
        if let Some(before) = &self.before {
            let _ = write!(std::io::stdout(), "\r\x1b[K").and_then(|()| std::io::stdout().flush());
            let _ = tcsetattr(std::io::stdin(), OptionalActions::Now, before);
        }
    }
}

/// Switches off the terminal's echo and line editing; returns its settings before.
fn without_echo() -> Option<Termios> {
    let before = tcgetattr(std::io::stdin()).ok()?;
    let mut without = before.clone();
    without.local_modes -= LocalModes::ECHO | LocalModes::ICANON;
    tcsetattr(std::io::stdin(), OptionalActions::Now, &without).ok()?;
    Some(before)
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

/// A line being typed: its letters, and those entered before.
#[derive(Debug, Default)]
struct Editor {
    typed: Vec<u8>,
    /// Entered lines that were not taken yet.
    lines: std::collections::VecDeque<String>,
    history: Vec<String>,
    /// Entry of the history on display, counted from the newest; 0 for none.
    back: usize,
    escape: Escape,
    /// The names that go on as the word that was to be completed, until they are shown.
    offered: Option<String>,
}

/// State within a key's escape sequence.
#[derive(Debug, Default, PartialEq)]
enum Escape {
    #[default]
    None,
    Begun,
    Control,
}

/// Longest line, bytes; longer ones are truncated.
const LINE_MAX: usize = 1000;

impl Editor {
    fn typed(&self) -> String {
        String::from_utf8_lossy(&self.typed).into_owned()
    }

    fn has_line(&self) -> bool {
        !self.lines.is_empty()
    }

    fn take_line(&mut self) -> Option<String> {
        self.lines.pop_front()
    }

    /// Takes a byte from the keyboard.
    fn feed(&mut self, byte: u8) {
        const BACKSPACE: u8 = 0x08;
        const DELETE: u8 = 0x7f;
        const CTRL_U: u8 = 0x15;
        const CTRL_W: u8 = 0x17;
        const ESCAPE: u8 = 0x1b;
        match (&self.escape, byte) {
            (Escape::Begun, b'[' | b'O') => self.escape = Escape::Control,
            (Escape::Begun, _) => self.escape = Escape::None,
            (Escape::Control, _) => self.control(byte),
            (Escape::None, b'\r' | b'\n') => self.enter(),
            (Escape::None, b'\t') => self.complete(),
            (Escape::None, BACKSPACE | DELETE) => self.erase(),
            (Escape::None, CTRL_U) => self.typed.clear(),
            (Escape::None, CTRL_W) => self.erase_word(),
            (Escape::None, ESCAPE) => self.escape = Escape::Begun,
            (Escape::None, 0x20..) if self.typed.len() < LINE_MAX => self.typed.push(byte),
            (Escape::None, _) => {}
        }
    }

    fn enter(&mut self) {
        let line = self.typed();
        if !line.trim().is_empty() && self.history.last() != Some(&line) {
            self.history.push(line.clone());
        }
        self.typed.clear();
        self.back = 0;
        self.lines.push_back(line);
    }

    /// A further byte of a control sequence: the up and down keys go through the history, others do nothing.
    fn control(&mut self, byte: u8) {
        // Digits and semicolons stand before the letter that ends it.
        if !(0x40..=0x7e).contains(&byte) {
            return;
        }
        self.escape = Escape::None;
        match byte {
            b'A' => self.back = (self.back + 1).min(self.history.len()),
            b'B' => self.back = self.back.saturating_sub(1),
            _ => return,
        }
        let shown = self.history.len().checked_sub(self.back).and_then(|place| self.history.get(place));
        self.typed = shown.map_or_else(Vec::new, |line| line.clone().into_bytes());
    }

    /// Completes the command as far as it is one; offers those that go on differently.
    fn complete(&mut self) {
        let typed = self.typed();
        let names = completions(&typed);
        let Some(common) = names.clone().reduce(common_beginning) else { return };
        self.typed.extend(common[typed.len()..].bytes());
        match names.clone().count() {
            1 => self.typed.push(b' '),
            _ if common == typed => self.offered = Some(names.collect::<Vec<_>>().join("  ")),
            _ => {}
        }
    }

    /// Erases a letter, which may be several bytes.
    fn erase(&mut self) {
        while self.typed.pop().is_some_and(|byte| byte & 0xc0 == 0x80) {}
    }

    fn erase_word(&mut self) {
        let kept = self.typed().trim_end().rfind(' ').map_or(0, |space| space + 1);
        self.typed.truncate(kept);
    }
}

/// As much of two names, of ASCII, as is the same.
fn common_beginning<'a>(a: &'a str, b: &str) -> &'a str {
    let same = a.bytes().zip(b.bytes()).take_while(|(a, b)| a == b).count();
    &a[..same]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is being typed after some keys, and the lines that were entered.
    fn after(keys: &str) -> (String, Vec<String>) {
        let mut editor = Editor::default();
        keys.bytes().for_each(|byte| editor.feed(byte));
        let lines = core::iter::from_fn(|| editor.take_line()).collect();
        (editor.typed(), lines)
    }

    #[test]
    fn keys_edit_the_line() {
        for (keys, typed) in [
            ("arm", "arm"),
            ("arn\x7fm", "arm"),
            ("§\x7f", ""),
            ("goto 1 2\x17", "goto 1 "),
            ("goto  \x17", ""),
            ("arm\x15la", "la"),
            ("tak\t5", "takeoff 5"),
            ("s\t", "s"),
            ("fau\t", "fault"),
            ("f\ts\t", "faults "),
            ("x\t", "x"),
            ("l\x1b[Cand\x1b[1;5D", "land"),
            ("\x1b[A\x1b[B\x07arm", "arm"),
        ] {
            assert_eq!(after(keys), (typed.to_owned(), Vec::new()), "{keys:?}");
        }
    }

    #[test]
    fn names_that_go_on_differently_are_offered() {
        let offered = |keys: &str| {
            let mut editor = Editor::default();
            keys.bytes().for_each(|byte| editor.feed(byte));
            editor.offered
        };
        assert_eq!(offered("fau\t\t").as_deref(), Some("fault  faults"));
        assert_eq!(offered("fau\t"), None, "it has been completed");
        assert_eq!(offered("s\t").as_deref(), Some("status  speed"));
        assert!(offered("\t").is_some_and(|names| names.starts_with("help  status  arm  ")));
        assert_eq!(offered("x\t"), None);
    }

    #[test]
    fn lines_are_entered_and_can_be_called_back() {
        let lines = |lines: &[&str]| lines.iter().map(|line| (*line).to_owned()).collect::<Vec<_>>();
        assert_eq!(after("arm\nland\r\nho"), ("ho".to_owned(), lines(&["arm", "land", ""])));
        assert_eq!(after("arm\nland\n\x1b[A\x1b[A"), ("arm".to_owned(), lines(&["arm", "land"])));
        assert_eq!(after("arm\nland\n\x1b[A\x1b[A\x1bOB"), ("land".to_owned(), lines(&["arm", "land"])));
        assert_eq!(after("arm\n\x1b[A\x1b[B"), (String::new(), lines(&["arm"])));
    }

    #[test]
    fn a_line_without_end_takes_no_more_memory_for_ever() {
        assert_eq!(after(&"x".repeat(5000)).0.len(), LINE_MAX);
    }
}
