//! Reads a recording, and holds it against the flight that is to be flown again.

use std::iter::Peekable;
use std::path::Path;
use std::sync::Arc;

use anyhow::{Context as _, Result, anyhow, bail, ensure};
use firmware::mavlink::port::{LINKS, Profile};
use firmware::signals::{TICK_S_EXACT, Tick};

use super::{FIRST, Header, arguments, asked};
use crate::files::read_regular;
use crate::scenario::Scenario;
use crate::sil::replay::{Entry, Input, OnLink};

/// No recording is larger, bytes.
const LARGEST: u64 = 1 << 30;

/// A recording that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// What was flown.
    pub header: Header,
    /// What came from outside, by rising ticks.
    pub entries: Vec<Entry>,
    /// Ticks that were flown: to its `end`, or to its last line.
    pub ticks: Tick,
    /// Whether it has an `end`: one without was cut off.
    pub has_ended: bool,
}

impl Recording {
    /// Reads a file.
    ///
    /// # Errors
    /// In one line: the file and line, what stands there, and what is expected.
    pub fn read(path: &Path) -> Result<Self> {
        let text =
            read_regular(path, LARGEST).with_context(|| format!("cannot read recording `{}`", path.display()))?;
        Self::parse(&text).with_context(|| format!("recording `{}`", path.display()))
    }

    /// Reads a text.
    ///
    /// # Errors
    /// In one line: the line's number, what stands there, and what is expected.
    pub fn parse(text: &str) -> Result<Self> {
        let mut lines = (1..).zip(text.lines()).peekable();
        let header = header(&mut lines)?;
        let (mut entries, mut ticks, mut has_ended) = (Vec::new(), 0, false);
        for (number, line) in lines {
            let read = || {
                ensure!(!has_ended, "nothing may follow `end`, and `{line}` does");
                let (tick, what) = line.split_once(' ').unwrap_or((line, ""));
                let tick: Tick = tick.parse().map_err(|_| anyhow!("`{tick}` must be a tick, a whole number"))?;
                ensure!(tick >= ticks, "ticks must rise, and {tick} comes after {ticks}");
                Ok((tick, input(what)?))
            };
            let (tick, input) = read().with_context(|| format!("line {number}"))?;
            ticks = tick;
            has_ended = input.is_none();
            entries.extend(input.map(|input| Entry { tick, input }));
        }
        // The tick before which the last line came was flown, if nothing says otherwise.
        let ticks = ticks.saturating_add(Tick::from(!has_ended && !entries.is_empty()));
        ensure!(ticks > 0, "no tick was flown");
        Ok(Self { header, entries, ticks, has_ended })
    }

    /// Refuses to be flown again by another scenario, other settings or another seed than its own.
    ///
    /// # Errors
    /// In one line, what differs, and what to give.
    pub fn require(&self, flown: &Header) -> Result<()> {
        let Header { scenario, set, seed, files } = &self.header;
        let settings = |set: &[String]| {
            if set.is_empty() { "no --set".to_owned() } else { format!("`{}`", arguments(set).trim()) }
        };
        ensure!(*scenario == flown.scenario, "it is of scenario `{scenario}`, not of `{}`", flown.scenario);
        ensure!(*set == flown.set, "it was flown with {}, not with {}", settings(set), settings(&flown.set));
        ensure!(*seed == flown.seed, "it was flown with seed {seed}, not with {}: leave out --seed", flown.seed);
        ensure!(
            *files == flown.files,
            "scenario `{scenario}`, or a file that it names, has changed since it was flown"
        );
        Ok(())
    }

    /// The scenario to be flown with what came from outside, as long as it was.
    #[must_use]
    pub fn onto(self, mut scenario: Scenario) -> Scenario {
        scenario.file.duration_s = f64::from(self.ticks) * TICK_S_EXACT;
        scenario.replay = Some(Arc::from(self.entries));
        scenario
    }
}

/// The lines of a text, with their numbers.
type Lines<'a, I> = Peekable<std::iter::Zip<std::ops::RangeFrom<usize>, I>>;

fn header<'a, I: Iterator<Item = &'a str>>(lines: &mut Lines<'a, I>) -> Result<Header> {
    if lines.next().is_none_or(|(_, line)| line != FIRST) {
        bail!("line 1: a recording begins with `{FIRST}`: is it one of `sim-host serve --record`?");
    }
    let scenario = value(lines, "scenario")?.to_owned();
    let mut set = Vec::new();
    while lines.peek().is_some_and(|(_, line)| line.starts_with("set ")) {
        set.push(value(lines, "set")?.to_owned());
    }
    let seed = value(lines, "seed")?;
    let seed = seed.parse().map_err(|_| anyhow!("`seed` must be a whole number, not `{seed}`"))?;
    Ok(Header { scenario, set, seed, files: value(lines, "files")?.to_owned() })
}

/// The value of the next line, which must have this key.
fn value<'a, I: Iterator<Item = &'a str>>(lines: &mut Lines<'a, I>, key: &str) -> Result<&'a str> {
    let (number, line) = lines.next().with_context(|| format!("it ends before its line `{key} …`"))?;
    let value = line.strip_prefix(key).and_then(|rest| rest.strip_prefix(' '));
    value.with_context(|| format!("line {number}: expected `{key} …`, not `{line}`"))
}

/// What a line tells after its tick; `None` for the end.
fn input(what: &str) -> Result<Option<Input>> {
    let words: Vec<&str> = what.split(' ').collect();
    match words.as_slice() {
        ["end"] => Ok(None),
        ["link", link, event @ ..] => {
            let number = link.parse().ok().filter(|link| *link < LINKS);
            let link = number.with_context(|| format!("`{link}` must be a link, 0 to {}", LINKS - 1))?;
            Ok(Some(Input::Link { link, event: on_link(event)? }))
        }
        ["ask", asked @ ..] => Ok(Some(Input::Ask(asked::read(asked)?))),
        ["world", ..] => {
            bail!("`{}` was typed, and cannot be flown again: set it in the scenario", &what["world ".len()..])
        }
        _ => bail!("expected `link`, `ask` or `end` after the tick, not `{what}`"),
    }
}

fn on_link(words: &[&str]) -> Result<OnLink> {
    Ok(match words {
        ["open", "normal"] => OnLink::Open(Profile::Normal),
        ["open", "onboard"] => OnLink::Open(Profile::Onboard),
        ["close"] => OnLink::Close,
        ["lost", count] => {
            OnLink::Lost(count.parse().map_err(|_| anyhow!("`lost` must be followed by a number, not `{count}`"))?)
        }
        ["hex", digits] => {
            OnLink::Received(bytes(digits).context("`hex` must be followed by pairs of hexadecimal digits")?)
        }
        _ => bail!(
            "expected `open normal`, `open onboard`, `close`, `lost COUNT` or `hex BYTES` after the link, not `{}`",
            words.join(" ")
        ),
    })
}

fn bytes(digits: &str) -> Option<Vec<u8>> {
    let digit = |digit: &u8| char::from(*digit).to_digit(16);
    let (pairs, []) = digits.as_bytes().as_chunks() else { return None };
    pairs.iter().map(|[high, low]| Some((digit(high)? << 4 | digit(low)?) as u8)).collect()
}
