//! Keys of a terminal as sticks.
//!
//! A terminal tells that a key is pressed, and again while it is held, but never that it is let go. So a press holds its
//! stick for a while, and the repetition of a held key holds it on. A stick moves to its end and back as fast as a thumb
//! would: what takes sticks for velocities is not to be shaken by a tap.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use super::{Act, Hands, Order, Selected, Sticks};
use crate::console::keyboard::Key;

/// How long a press holds its stick: longer than the pause between two repetitions of a held key, 33 ms as usual.
pub const HELD: Duration = Duration::from_millis(250);
/// How fast a stick moves, full deflections per second.
const SPEED_1_S: f64 = 8.0;

/// A row of the table of keys.
struct Entry {
    /// As help shows it.
    shown: &'static str,
    keys: &'static [Key],
    does: Does,
    summary: &'static str,
}

/// What a key does.
#[derive(Clone, Copy)]
enum Does {
    /// Holds a stick, the number in [`Keys::sticks`], at one of its ends.
    Hold(usize, f64),
    Centre,
    Ask(Order),
    Explain,
    Quit,
    /// The terminal takes it.
    Nothing,
}

const ROLL: usize = 0;
const PITCH: usize = 1;
const YAW: usize = 2;
const THROTTLE: usize = 3;

const fn selects(shown: &'static str, keys: &'static [Key], mode: Selected, summary: &'static str) -> Entry {
    Entry { shown, keys, does: Does::Ask(Order::Select(mode)), summary }
}

const fn holds(shown: &'static str, keys: &'static [Key], stick: usize, end: f64, summary: &'static str) -> Entry {
    Entry { shown, keys, does: Does::Hold(stick, end), summary }
}

const ENTRIES: &[Entry] = &[
    holds("w", &[Key::Byte(b'w'), Key::Byte(b'W')], THROTTLE, 1.0, "throttle up"),
    holds("s", &[Key::Byte(b's'), Key::Byte(b'S')], THROTTLE, -1.0, "throttle down"),
    holds("a", &[Key::Byte(b'a'), Key::Byte(b'A')], YAW, -1.0, "yaw to the left"),
    holds("d", &[Key::Byte(b'd'), Key::Byte(b'D')], YAW, 1.0, "yaw to the right"),
    holds("up", &[Key::Up], PITCH, 1.0, "pitch forward"),
    holds("down", &[Key::Down], PITCH, -1.0, "pitch back"),
    holds("left", &[Key::Left], ROLL, -1.0, "roll to the left"),
    holds("right", &[Key::Right], ROLL, 1.0, "roll to the right"),
    Entry {
        shown: "space",
        keys: &[Key::Byte(b' ')],
        does: Does::Centre,
        summary: "all sticks to the middle, at once",
    },
    Entry { shown: "m", keys: &[Key::Byte(b'm')], does: Does::Ask(Order::ArmOrDisarm), summary: "arm, or disarm" },
    selects(
        "1",
        &[Key::Byte(b'1')],
        Selected::Stabilized,
        "stabilized: the sticks tilt it, the throttle is its thrust",
    ),
    selects("2", &[Key::Byte(b'2')], Selected::Altitude, "altitude: as stabilized, the throttle climbs and descends"),
    selects("3", &[Key::Byte(b'3')], Selected::Position, "position: the sticks are velocities"),
    selects("4", &[Key::Byte(b'4')], Selected::Acro, "acro: the sticks are angular rates"),
    selects("5", &[Key::Byte(b'5')], Selected::Hold, "hold"),
    selects("6", &[Key::Byte(b'6')], Selected::Return, "return"),
    selects("7", &[Key::Byte(b'7')], Selected::Land, "land"),
    Entry {
        shown: "K",
        keys: &[Key::Byte(b'K')],
        does: Does::Ask(Order::Kill),
        summary: "kill: stop the rotors at once",
    },
    Entry {
        shown: ":",
        keys: &[],
        does: Does::Nothing,
        summary: "type a line, as `:takeoff 5`; Enter executes it, Esc leaves it",
    },
    Entry { shown: "?", keys: &[Key::Byte(b'?')], does: Does::Explain, summary: "these keys" },
    Entry { shown: "Q", keys: &[Key::Byte(b'Q')], does: Does::Quit, summary: "end the program" },
];

/// The keys and what they do, a line each.
pub fn help() -> impl Iterator<Item = (&'static str, &'static str)> {
    ENTRIES.iter().map(|entry| (entry.shown, entry.summary))
}

/// A stick that keys move.
#[derive(Clone, Copy, Debug, Default)]
struct Stick {
    at: f64,
    /// The end at which it is held, and until when.
    held: Option<(f64, Instant)>,
}

impl Stick {
    /// Moves it for a time that ends now.
    fn step(&mut self, past: Duration, now: Instant) {
        self.held = self.held.filter(|(_, until)| now < *until);
        let target = self.held.map_or(0.0, |(end, _)| end);
        let most = SPEED_1_S * past.as_secs_f64();
        self.at += (target - self.at).clamp(-most, most);
    }
}

/// Hands on the keys of a terminal.
#[derive(Debug, Default)]
pub struct Keys {
    /// Roll, pitch, yaw, throttle.
    sticks: [Stick; 4],
    /// When they were moved last.
    moved: Option<Instant>,
    acts: VecDeque<Act>,
}

impl Hands for Keys {
    fn press(&mut self, key: Key, now: Instant) {
        let Some(entry) = ENTRIES.iter().find(|entry| entry.keys.contains(&key)) else { return };
        match entry.does {
            Does::Hold(stick, end) => {
                if let Some(stick) = self.sticks.get_mut(stick) {
                    stick.held = Some((end, now + HELD));
                }
            }
            Does::Centre => self.sticks = [Stick::default(); 4],
            Does::Ask(order) => self.acts.push_back(Act::Order(order)),
            Does::Explain => self.acts.extend(help().map(|(key, does)| Act::Explain(format!("{key:5}  {does}")))),
            Does::Quit => self.acts.push_back(Act::Quit),
            Does::Nothing => {}
        }
    }

    fn poll(&mut self, now: Instant) -> Vec<Act> {
        let past = now.saturating_duration_since(self.moved.replace(now).unwrap_or(now));
        self.sticks.iter_mut().for_each(|stick| stick.step(past, now));
        self.acts.drain(..).collect()
    }

    fn sticks(&self) -> Option<Sticks> {
        let [roll, pitch, yaw, throttle] = self.sticks.map(|stick| stick.at);
        Some(Sticks { roll, pitch, yaw, throttle })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Keys, looked at every so many milliseconds.
    struct Bench {
        keys: Keys,
        start: Instant,
        ms: u64,
    }

    impl Bench {
        fn new() -> Self {
            let mut bench = Self { keys: Keys::default(), start: Instant::now(), ms: 0 };
            bench.until(0);
            bench
        }

        fn now(&self) -> Instant {
            self.start + Duration::from_millis(self.ms)
        }

        fn press(&mut self, key: Key) {
            self.keys.press(key, self.now());
        }

        fn until(&mut self, ms: u64) -> (Sticks, Vec<Act>) {
            let mut acts = Vec::new();
            loop {
                acts.extend(self.keys.poll(self.now()));
                if self.ms >= ms {
                    return (self.keys.sticks().expect("keys are always there"), acts);
                }
                self.ms += 1;
            }
        }

        fn sticks(&mut self, ms: u64) -> [f64; 4] {
            let Sticks { roll, pitch, yaw, throttle } = self.until(ms).0;
            // To 1e-9: they are sums of steps.
            [roll, pitch, yaw, throttle].map(|stick| (stick * 1e9).round() / 1e9 + 0.0)
        }
    }

    #[test]
    fn a_press_moves_a_stick_to_its_end_and_back() {
        for (key, axis, end) in [
            (Key::Byte(b'w'), THROTTLE, 1.0),
            (Key::Byte(b'S'), THROTTLE, -1.0),
            (Key::Byte(b'a'), YAW, -1.0),
            (Key::Byte(b'D'), YAW, 1.0),
            (Key::Up, PITCH, 1.0),
            (Key::Down, PITCH, -1.0),
            (Key::Left, ROLL, -1.0),
            (Key::Right, ROLL, 1.0),
        ] {
            let mut bench = Bench::new();
            bench.press(key);
            let mut at = |ms| {
                let sticks = bench.sticks(ms);
                assert!(
                    sticks.iter().enumerate().all(|(stick, at)| stick == axis || *at == 0.0),
                    "{key:?}: {sticks:?}"
                );
                sticks[axis] * end
            };
            // Half way after 1/16 s, there after 1/8 s, held until 250 ms, and back as fast.
            assert_eq!([at(0), at(50), at(125), at(249)], [0.0, 0.4, 1.0, 1.0], "{key:?}");
            assert!((at(300) - 0.592).abs() < 1e-6, "{key:?}");
            assert_eq!([at(375), at(1_000)], [0.0, 0.0], "{key:?}");
        }
    }

    #[test]
    fn a_key_that_is_held_holds_its_stick() {
        let mut bench = Bench::new();
        for press in 0..30 {
            bench.press(Key::Up);
            assert!(bench.sticks(press * 33 + 1)[PITCH] > 0.0);
            assert!(press < 5 || bench.sticks(press * 33 + 33)[PITCH] == 1.0);
        }
        assert_eq!(bench.sticks(29 * 33 + 249)[PITCH], 1.0);
        assert_eq!(bench.sticks(29 * 33 + 400)[PITCH], 0.0);
    }

    #[test]
    fn several_sticks_are_held_at_a_time_and_the_other_key_turns_one_round() {
        let mut bench = Bench::new();
        bench.press(Key::Byte(b'w'));
        bench.press(Key::Left);
        assert_eq!(bench.sticks(200), [-1.0, 0.0, 0.0, 1.0]);
        bench.press(Key::Right);
        assert_eq!(bench.sticks(449)[ROLL], 0.992, "through the middle");
    }

    #[test]
    fn the_space_bar_centres_at_once() {
        let mut bench = Bench::new();
        bench.press(Key::Byte(b'w'));
        bench.press(Key::Left);
        bench.until(200);
        bench.press(Key::Byte(b' '));
        assert_eq!(bench.sticks(200), [0.0; 4]);
        assert_eq!(bench.sticks(260), [0.0; 4], "nothing is held any more");
    }

    #[test]
    fn how_often_it_is_looked_makes_no_difference_to_where_a_held_stick_gets() {
        let start = Instant::now();
        let mut keys = Keys::default();
        keys.poll(start);
        keys.press(Key::Up, start);
        keys.poll(start + Duration::from_millis(100));
        assert!((keys.sticks().expect("keys").pitch - 0.8).abs() < 1e-9);
        keys.poll(start + Duration::from_secs(3_600));
        assert_eq!(keys.sticks(), Some(Sticks::default()), "after a long stop");
    }

    #[test]
    fn keys_ask_once_a_press() {
        let mut bench = Bench::new();
        for (key, act) in [
            (b'm', Act::Order(Order::ArmOrDisarm)),
            (b'1', Act::Order(Order::Select(Selected::Stabilized))),
            (b'2', Act::Order(Order::Select(Selected::Altitude))),
            (b'3', Act::Order(Order::Select(Selected::Position))),
            (b'4', Act::Order(Order::Select(Selected::Acro))),
            (b'5', Act::Order(Order::Select(Selected::Hold))),
            (b'6', Act::Order(Order::Select(Selected::Return))),
            (b'7', Act::Order(Order::Select(Selected::Land))),
            (b'K', Act::Order(Order::Kill)),
            (b'Q', Act::Quit),
        ] {
            bench.press(Key::Byte(key));
            assert_eq!(bench.until(0).1, [act], "{}", char::from(key));
            assert_eq!(bench.until(0).1, [], "once");
        }
        for key in [b'k', b'q', b'8', b':', b'\n', 0x7f] {
            bench.press(Key::Byte(key));
            assert_eq!(bench.until(0), (Sticks::default(), Vec::new()), "{key}");
        }
    }

    #[test]
    fn every_key_is_explained() {
        let mut bench = Bench::new();
        bench.press(Key::Byte(b'?'));
        let acts = bench.until(0).1;
        assert_eq!(acts.len(), ENTRIES.len());
        assert!(acts.contains(&Act::Explain("m      arm, or disarm".to_owned())), "{acts:?}");
    }
}
