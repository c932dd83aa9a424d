//! The line being typed on a terminal: its editing, its history, and the completion of commands.

use super::keyboard::Key;
use super::parse::completions;

/// A line being typed: its letters, and those entered before.
#[derive(Debug, Default)]
pub(super) struct Editor {
    typed: Vec<u8>,
    /// Entered lines that were not taken yet.
    lines: std::collections::VecDeque<String>,
    history: Vec<String>,
    /// Entry of the history on display, counted from the newest; 0 for none.
    back: usize,
    /// The names that go on as the word that was to be completed, until they are shown.
    pub(super) offered: Option<String>,
}

/// Longest line, bytes; longer ones are truncated.
const LINE_MAX: usize = 1000;

impl Editor {
    pub(super) fn typed(&self) -> String {
        String::from_utf8_lossy(&self.typed).into_owned()
    }

    pub(super) fn has_line(&self) -> bool {
        !self.lines.is_empty()
    }

    pub(super) fn take_line(&mut self) -> Option<String> {
        self.lines.pop_front()
    }

    /// Takes a key: the up and down keys go through the history, others of those do nothing.
    pub(super) fn take(&mut self, key: Key) {
        const BACKSPACE: u8 = 0x08;
        const DELETE: u8 = 0x7f;
        const CTRL_U: u8 = 0x15;
        const CTRL_W: u8 = 0x17;
        match key {
            Key::Up => self.show((self.back + 1).min(self.history.len())),
            Key::Down => self.show(self.back.saturating_sub(1)),
            Key::Byte(b'\r' | b'\n') => self.enter(),
            Key::Byte(b'\t') => self.complete(),
            Key::Byte(BACKSPACE | DELETE) => self.erase(),
            Key::Byte(CTRL_U) => self.typed.clear(),
            Key::Byte(CTRL_W) => self.erase_word(),
            Key::Byte(byte @ 0x20..) if self.typed.len() < LINE_MAX => self.typed.push(byte),
            Key::Byte(_) | Key::Left | Key::Right => {}
        }
    }

    /// Leaves the line that is being typed.
    pub(super) fn leave(&mut self) {
        self.typed.clear();
        self.back = 0;
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

    /// Shows an entry of the history, counted from the newest.
    fn show(&mut self, back: usize) {
        self.back = back;
        let shown = self.history.len().checked_sub(back).and_then(|place| self.history.get(place));
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
    use super::super::keyboard::Decoder;
    use super::*;

    fn decoded(keys: &str) -> impl Iterator<Item = Key> {
        let mut decoder = Decoder::default();
        keys.bytes().filter_map(move |byte| decoder.take(byte))
    }

    /// What is being typed after some keys, and the lines that were entered.
    fn after(keys: &str) -> (String, Vec<String>) {
        let mut editor = Editor::default();
        decoded(keys).for_each(|key| editor.take(key));
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
            decoded(keys).for_each(|key| editor.take(key));
            editor.offered
        };
        assert_eq!(offered("fau\t\t").as_deref(), Some("fault  faults"));
        assert_eq!(offered("fau\t"), None, "it has been completed");
        assert_eq!(offered("s\t").as_deref(), Some("status  stabilized  speed"));
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
