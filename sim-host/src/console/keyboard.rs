//! What a terminal sends for its keys: bytes, and a sequence that begins with an escape for an arrow.

use std::time::{Duration, Instant};

/// A key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    /// One that sends a byte; a letter beyond ASCII sends several.
    Byte(u8),
    /// The arrow up.
    Up,
    /// The arrow down.
    Down,
    /// The arrow to the left.
    Left,
    /// The arrow to the right.
    Right,
}

const ESCAPE: u8 = 0x1b;
/// An escape that nothing follows for this long is the key Esc: a terminal sends a sequence at once, and a network rarely
/// tears it apart for longer.
const ALONE_AFTER: Duration = Duration::from_millis(50);

/// State within a key's escape sequence.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Escape {
    #[default]
    None,
    Begun,
    Control,
}

/// Makes keys of bytes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Decoder {
    escape: Escape,
    /// When the last byte came, once somebody has asked.
    since: Option<Instant>,
}

impl Decoder {
    /// The key that a byte completes, if it is one with a meaning here.
    pub(super) fn take(&mut self, byte: u8) -> Option<Key> {
        self.since = None;
        let (escape, key) = match (self.escape, byte) {
            (Escape::None | Escape::Begun, ESCAPE) => (Escape::Begun, None),
            (Escape::None, _) => (Escape::None, Some(Key::Byte(byte))),
            (Escape::Begun, b'[' | b'O') => (Escape::Control, None),
            (Escape::Control, b'A') => (Escape::None, Some(Key::Up)),
            (Escape::Control, b'B') => (Escape::None, Some(Key::Down)),
            (Escape::Control, b'C') => (Escape::None, Some(Key::Right)),
            (Escape::Control, b'D') => (Escape::None, Some(Key::Left)),
            // Digits and semicolons stand before the letter that ends it.
            (Escape::Begun, _) | (Escape::Control, 0x40..=0x7e) => (Escape::None, None),
            (Escape::Control, _) => (Escape::Control, None),
        };
        self.escape = escape;
        key
    }

    /// Whether the key Esc was pressed, and no sequence begun; asked again and again. It is told once.
    pub(super) fn is_alone(&mut self, now: Instant) -> bool {
        if self.escape != Escape::Begun {
            return false;
        }
        let since = *self.since.get_or_insert(now);
        let alone = now.saturating_duration_since(since) >= ALONE_AFTER;
        if alone {
            self.escape = Escape::None;
        }
        alone
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(bytes: &[u8]) -> Vec<Key> {
        let mut decoder = Decoder::default();
        bytes.iter().filter_map(|byte| decoder.take(*byte)).collect()
    }

    #[test]
    fn arrows_are_told_from_letters() {
        assert_eq!(keys(b"\x1b[A\x1bOB\x1b[C\x1b[1;5D"), [Key::Up, Key::Down, Key::Right, Key::Left]);
        assert_eq!(keys(b"A\x1b[3~B"), [Key::Byte(b'A'), Key::Byte(b'B')], "a key that means nothing");
        assert_eq!(keys(b"\x1bx\x1b\x1b[Ay"), [Key::Up, Key::Byte(b'y')], "with Alt, and Esc before an arrow");
    }

    #[test]
    fn an_escape_that_nothing_follows_is_a_key() {
        let (mut decoder, start) = (Decoder::default(), Instant::now());
        let at = |ms| start + Duration::from_millis(ms);
        assert!(!decoder.is_alone(at(0)));
        decoder.take(ESCAPE);
        assert_eq!([100, 149, 150, 151].map(|ms| decoder.is_alone(at(ms))), [false, false, true, false]);
        assert_eq!(decoder.take(b'['), Some(Key::Byte(b'[')), "it is over");
        decoder.take(ESCAPE);
        assert!(!decoder.is_alone(at(200)));
        decoder.take(b'[');
        assert!(!decoder.is_alone(at(900)));
        assert_eq!(decoder.take(b'A'), Some(Key::Up), "however late");
    }
}
