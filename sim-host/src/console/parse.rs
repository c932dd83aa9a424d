//! Reads typed lines. One table has the names, arguments and explanations of the commands, so that help and parser
//! agree.

use core::fmt;
use core::ops::RangeInclusive;

use anyhow::{Error, Result, anyhow, bail, ensure};
use firmware::commander::{FARTHEST_M, FASTEST_M_S, ManualMode, Request, TAKE_OFF_HEIGHT_M, TAKE_OFF_HEIGHTS_M};
use firmware::signals::Tick;

use crate::failures::{self, Equipment};
use crate::refusal::{did_you_mean, shortest};
use crate::sensors::Fault;
use crate::serve::SPEEDS;

/// A command of the console. World frame NWU: x north, y west, z up.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Explain the commands, or one of them.
    Help(Option<&'static Entry>),
    /// Print the vehicle's state.
    Status,
    /// Send a request to the commander.
    Request(Request),
    /// Stop the rotors at once.
    Kill,
    /// Go to a place (m) with a heading (°); `None` keeps the present value.
    GoTo {
        /// x, y, z, m.
        place: [Option<f64>; 3],
        /// ψ, °.
        yaw_deg: Option<f64>,
    },
    /// Print the steady wind.
    Wind,
    /// Set the steady wind: the velocity of the air, m/s.
    SetWind([f64; 3]),
    /// Start a fault.
    Fault(Fault),
    /// List the faults.
    Faults,
    /// End all faults, or those of one sensor, rotor or battery.
    Clear(Option<Equipment>),
    /// Fly at so many times real time.
    Speed(f64),
    /// End the program.
    Quit,
}

/// A row of the table of commands.
#[derive(Debug)]
pub struct Entry {
    /// Its name, then its other names.
    names: &'static [&'static str],
    /// Its arguments, as help shows them.
    arguments: &'static str,
    /// What it does.
    summary: &'static str,
    /// More about it, for `help COMMAND`.
    details: &'static str,
    reads: Reads,
}

/// How the arguments of a command are read.
#[derive(Debug)]
enum Reads {
    /// There are none.
    Nothing(Command),
    /// `force`, or none.
    Force(fn(bool) -> Command),
    /// By a function of the arguments and the present tick.
    With(fn(&[&str], Tick) -> Result<Command>),
}

/// A manual mode, which takes no arguments.
const fn by_sticks(mode: ManualMode) -> Reads {
    Reads::Nothing(Command::Request(Request::Manual(mode)))
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.names == other.names
    }
}

impl Entry {
    const fn new(names: &'static [&'static str], arguments: &'static str, summary: &'static str, reads: Reads) -> Self {
        Self { names, arguments, summary, details: "", reads }
    }

    const fn with_details(self, details: &'static str) -> Self {
        Self { details, ..self }
    }

    /// Reads the arguments.
    fn read(&self, words: &[&str], now: Tick) -> Result<Command> {
        let read = match &self.reads {
            Reads::Nothing(command) => alone(words).map(|()| command.clone()),
            Reads::Force(command) => forced(words).map(command),
            Reads::With(read) => read(words, now),
        };
        read.map_err(|error| match error.downcast::<Misuse>() {
            Ok(misuse) => anyhow!("{}: {misuse}: type `{}`", self.name(), self.usage()),
            Err(error) => error.context(self.name()),
        })
    }

    /// Its name.
    pub fn name(&self) -> &'static str {
        self.names.first().copied().unwrap_or_default()
    }

    /// How it is typed.
    pub fn usage(&self) -> String {
        format!("{} {}", self.name(), self.arguments).trim_end().to_owned()
    }

    /// What it does.
    pub fn summary(&self) -> &'static str {
        self.summary
    }

    /// How it is typed, what it does, and what else it is called.
    pub fn help(&self) -> String {
        let mut text = format!("{}: {}", self.usage(), self.summary);
        if !self.details.is_empty() {
            text = format!("{text}. {}", self.details);
        }
        if let [_, others @ ..] = self.names
            && !others.is_empty()
        {
            text = format!("{text}. Also called {}", others.join(", "));
        }
        text
    }
}

/// All commands, in the order in which help lists them.
pub const COMMANDS: &[Entry] = &[
    Entry::new(&["help", "?"], "[COMMAND]", "list the commands, or explain one", Reads::With(help)),
    Entry::new(&["status"], "", "mode, position, battery, wind and faults now", Reads::Nothing(Command::Status))
        .with_details("Position and velocity are the vehicle's own estimate"),
    Entry::new(
        &["arm"],
        "[force]",
        "let the rotors idle; `force` skips the checks",
        Reads::Force(|force| Command::Request(Request::Arm { force })),
    ),
    Entry::new(
        &["disarm"],
        "[force]",
        "stop the rotors on the ground; `force` also in the air",
        Reads::Force(|force| if force { Command::Kill } else { Command::Request(Request::Disarm) }),
    ),
    Entry::new(&["takeoff", "take-off"], "[HEIGHT]", "climb by HEIGHT (m; 2.5) and hold", Reads::With(take_off))
        .with_details("From the ground; before arming, it waits five seconds for that. HEIGHT is between 0.3 and 100 m"),
    Entry::new(
        &["goto", "go-to", "reposition"],
        "NORTH WEST UP [YAW]",
        "fly to a place in the local frame (m; yaw in °) and hold",
        Reads::With(go_to),
    )
    .with_details(
        "The frame begins where z = 0 of the world is: `up` is negative below it. YAW counts from north to \
         west: 90 looks west, -90 east. By name, what is left out stays as it is: `goto north=5 yaw=0`",
    ),
    Entry::new(
        &["velocity"],
        "NORTH WEST UP [YAW_RATE]",
        "fly with a velocity (m/s; yaw rate in °/s) until the next command",
        Reads::With(velocity),
    )
    .with_details(
        "At most 100 m/s along each axis and 360°/s, flown within the scenario's `modes`, as the answer says. By name, what is left out is 0: `velocity up=1`. `hold` ends it",
    ),
    Entry::new(&["position"], "", "fly by sticks: a velocity, held where they are centred", by_sticks(ManualMode::Position)),
    Entry::new(&["altitude"], "", "fly by sticks: a tilt and a rate of climb", by_sticks(ManualMode::Altitude)),
    Entry::new(&["stabilized"], "", "fly by sticks: a tilt and the thrust", by_sticks(ManualMode::Stabilized)),
    Entry::new(&["acro"], "", "fly by sticks: rates of turn and the thrust", by_sticks(ManualMode::Acro)),
    Entry::new(&["hold", "loiter", "brake"], "", "brake and stay", Reads::Nothing(Command::Request(Request::Hold))),
    Entry::new(
        &["trajectory", "follow", "mission", "start"],
        "",
        "fly the scenario's trajectory",
        Reads::Nothing(Command::Request(Request::Follow)),
    )
    .with_details("From the ground, armed, it takes off by itself if it stands where the trajectory begins"),
    Entry::new(
        &["return", "rtl"],
        "",
        "climb, fly to where it was armed, and land",
        Reads::Nothing(Command::Request(Request::Return)),
    ),
    Entry::new(&["land"], "", "land here; disarms by itself", Reads::Nothing(Command::Request(Request::Land))),
    Entry::new(
        &["kill", "terminate"],
        "",
        "stop the rotors at once, also in the air",
        Reads::Nothing(Command::Kill),
    ),
    Entry::new(
        &["wind"],
        "[NORTH WEST [UP] or speed= from=]",
        "set the steady wind (m/s, where the air moves to), or say what it is",
        Reads::With(wind),
    )
    .with_details(
        "As forecasts have it, `wind speed=5 from=270` comes from the west (degrees clockwise from north). \
         Turbulence and gusts of the scenario stay",
    ),
    Entry::new(
        &["fault", "failure"],
        "[SENSOR] KIND [KEY=VALUE]...",
        "make a sensor, a rotor or the battery fail",
        Reads::With(fault),
    )
    .with_details(
        "As in `fault gnss off`, `fault baro drift rate=5`, `fault rotor index=0 effectiveness=0.5` (rotor 1), \
         `fault motor off -i 1` (the same rotor, all of it), `fault gps wrong` (PX4's words, as large as by MAVLink), \
         `fault collapse factor=0.8`; from now on for good, or \
         `from_s=` and `to_s=` (s). The keys are those of \
         `[[fault]]` in docs/simulation.md",
    ),
    Entry::new(&["faults"], "", "list the faults that act, and those to come", Reads::Nothing(Command::Faults)),
    Entry::new(&["clear"], "[SENSOR]", "end all faults, those of the scenario too, or those of one sensor", Reads::With(clear))
        .with_details("`clear gnss`, `clear motor -i 1`, `clear battery`; `fault gps ok` is the same in PX4's words"),
    Entry::new(&["speed"], "X", "fly at X times real time", Reads::With(speed))
        .with_details("X is between 0.01 and 1000"),
    Entry::new(&["quit", "exit"], "", "end the program", Reads::Nothing(Command::Quit)),
];

fn fault(words: &[&str], now: Tick) -> Result<Command> {
    if words.contains(&"ok") {
        return clear(words, now);
    }
    Ok(Command::Fault(failures::parse(words.iter().copied(), now)?))
}

fn clear(words: &[&str], _: Tick) -> Result<Command> {
    let of = (!words.is_empty()).then(|| failures::parse_equipment(words)).transpose()?;
    Ok(Command::Clear(of))
}

/// Words of other shells, as that of PX4, for which there is no command, and what there is instead.
const ELSEWHERE: &[(&str, &str)] = &[
    (
        "mode",
        "a mode is a command: takeoff, hold, goto, velocity, trajectory, return, land; by sticks: position, altitude, stabilized, acro",
    ),
    ("param", "ground stations show and set parameters; at the start: sim-host serve --set params.NAME=VALUE"),
    ("vehicle", "it is the only one; several fly with sim-host serve --vehicles N"),
    ("log", "a flight without a pilot at the console is recorded: sim-host run SCENARIO --out DIR"),
    ("logger", "a flight without a pilot at the console is recorded: sim-host run SCENARIO --out DIR"),
    ("yaw", "to turn, `goto yaw=90` (a heading, °) or `velocity yaw_rate=10` (°/s)"),
    ("check", "`status` says whether it is ready to arm, and why not"),
];

/// Reads a line at a tick; `None` for an empty line and a comment (`#`).
///
/// # Errors
/// One line with the mistake and what to type instead.
pub fn parse(line: &str, now: Tick) -> Result<Option<Command>> {
    let mut words: Vec<&str> = line.split_whitespace().take_while(|word| !word.starts_with('#')).collect();
    from_px4(&mut words);
    let Some((name, arguments)) = words.split_first() else { return Ok(None) };
    entry(name)?.read(arguments, now).map(Some)
}

/// PX4's shell has its vehicle's commands below another one, and a flag for `force`.
fn from_px4(words: &mut Vec<&str>) {
    if words.len() > 1 && words[0].eq_ignore_ascii_case("commander") {
        words.remove(0);
        words.iter_mut().filter(|word| **word == "-f").for_each(|word| *word = "force");
    }
}

/// The command of a name, whatever its case.
fn entry(name: &str) -> Result<&'static Entry> {
    let lower = name.to_lowercase();
    if let Some(entry) = COMMANDS.iter().find(|entry| entry.names.contains(&lower.as_str())) {
        return Ok(entry);
    }
    if let Some((_, instead)) = ELSEWHERE.iter().find(|(word, _)| *word == lower) {
        bail!("there is no `{name}` here: {instead}");
    }
    let names: Vec<&str> = COMMANDS.iter().flat_map(|entry| entry.names).copied().collect();
    match did_you_mean(&lower, &names) {
        meant if meant.starts_with("did") => bail!("unknown command `{name}`: {meant} `help` lists all"),
        _ => bail!("unknown command `{name}`: `help` lists all"),
    }
}

/// Too many arguments, or too few; answered with the command's usage.
#[derive(Debug)]
struct Misuse(String);

impl fmt::Display for Misuse {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl core::error::Error for Misuse {}

fn too_much(word: &str) -> Error {
    Misuse(format!("`{word}` is too much")).into()
}

fn help(words: &[&str], _: Tick) -> Result<Command> {
    match words {
        [] => Ok(Command::Help(None)),
        [name] => Ok(Command::Help(Some(entry(name)?))),
        [_, rest, ..] => Err(too_much(rest)),
    }
}

fn alone(words: &[&str]) -> Result<()> {
    words.first().map_or(Ok(()), |word| Err(too_much(word)))
}

fn forced(words: &[&str]) -> Result<bool> {
    match words {
        [] => Ok(false),
        ["force"] => Ok(true),
        ["force", rest, ..] => Err(too_much(rest)),
        [other, ..] => bail!("`{other}` is unknown here: only `force` may follow"),
    }
}

/// A numeric argument.
struct Number {
    key: &'static str,
    unit: &'static str,
    range: RangeInclusive<f64>,
}

/// Within `most` of zero.
const fn number(key: &'static str, unit: &'static str, most: f64) -> Number {
    Number { key, unit, range: -most..=most }
}

impl Number {
    fn read(&self, text: &str) -> Result<f64> {
        let Self { key, unit, range } = self;
        let name = key.to_uppercase();
        let Ok(value) = text.parse::<f64>() else { bail!("{name} must be a number, not `{text}`") };
        let (low, high) = (range.start(), range.end());
        ensure!(range.contains(&value), "{name} must be between {low} and {high}{unit}, not {text}");
        Ok(value)
    }
}

/// Reads numbers by position or as `key=value`. If any is given by position, or if there are none, the first `needed`
/// are required.
fn numbers<const N: usize>(words: &[&str], needed: usize, known: &[Number; N]) -> Result<[Option<f64>; N]> {
    let mut values = [None; N];
    for (place, word) in words.iter().enumerate() {
        let (place, text) = match word.split_once('=') {
            Some((key, text)) => (known.iter().position(|number| number.key == key), text),
            None => (Some(place), *word),
        };
        let found = place.and_then(|place| Some((known.get(place)?, values.get_mut(place)?)));
        let keys = || known.iter().map(|number| number.key).collect::<Vec<_>>();
        let Some((number, value)) = found else {
            match word.split_once('=') {
                Some((key, _)) => bail!("there is no `{key}`: {}", did_you_mean(key, &keys())),
                None => return Err(too_much(word)),
            }
        };
        ensure!(value.is_none(), "{} is given twice", number.key.to_uppercase());
        *value = Some(number.read(text)?);
    }
    if words.is_empty() || words.iter().any(|word| !word.contains('=')) {
        none_missing(&known[..needed], &values)?;
    }
    Ok(values)
}

fn none_missing(needed: &[Number], values: &[Option<f64>]) -> Result<()> {
    let missing = needed.iter().zip(values).filter(|(_, value)| value.is_none());
    let names: Vec<String> = missing.map(|(number, _)| number.key.to_uppercase()).collect();
    match names.as_slice() {
        [] => Ok(()),
        [name] => Err(Misuse(format!("{name} is missing")).into()),
        [names @ .., last] => Err(Misuse(format!("{} and {last} are missing", names.join(", "))).into()),
    }
}

fn take_off(words: &[&str], _: Tick) -> Result<Command> {
    let (low, high) = (shortest(*TAKE_OFF_HEIGHTS_M.start()), shortest(*TAKE_OFF_HEIGHTS_M.end()));
    let [height] = numbers(words, 0, &[Number { key: "height", unit: " m", range: low..=high }])?;
    let height_m = height.map_or(TAKE_OFF_HEIGHT_M, |height| height as f32);
    Ok(Command::Request(Request::TakeOff { height_m }))
}

fn go_to(words: &[&str], _: Tick) -> Result<Command> {
    let far = f64::from(FARTHEST_M);
    let [north, west, up, yaw_deg] = numbers(
        words,
        3,
        &[number("north", " m", far), number("west", " m", far), number("up", " m", far), number("yaw", "°", 360.0)],
    )?;
    Ok(Command::GoTo { place: [north, west, up], yaw_deg })
}

fn velocity(words: &[&str], _: Tick) -> Result<Command> {
    let fast = f64::from(FASTEST_M_S);
    let [north, west, up, yaw_rate] = numbers(
        words,
        3,
        &[
            number("north", " m/s", fast),
            number("west", " m/s", fast),
            number("up", " m/s", fast),
            number("yaw_rate", "°/s", 360.0),
        ],
    )?;
    let velocity_m_s = [north, west, up].map(|value| value.unwrap_or(0.0) as f32);
    let yaw_rate_rad_s = yaw_rate.unwrap_or(0.0).to_radians() as f32;
    Ok(Command::Request(Request::Velocity { velocity_m_s, yaw_rate_rad_s }))
}

fn wind(words: &[&str], _: Tick) -> Result<Command> {
    const MOST_M_S: f64 = 50.0;
    let [north, west, up, speed, from] = numbers(
        words,
        0,
        &[
            number("north", " m/s", MOST_M_S),
            number("west", " m/s", MOST_M_S),
            number("up", " m/s", MOST_M_S),
            Number { key: "speed", unit: " m/s", range: 0.0..=MOST_M_S },
            number("from", "°", 360.0),
        ],
    )?;
    match (north, west, up, speed, from) {
        (None, None, None, None, None) => Ok(Command::Wind),
        (Some(north), Some(west), up, None, None) => Ok(Command::SetWind([north, west, up.unwrap_or(0.0)])),
        (None, None, None, Some(speed), Some(from)) => Ok(Command::SetWind(blowing(speed, from))),
        _ => bail!("say NORTH WEST [UP], or speed= and from="),
    }
}

/// The velocity of air that comes `from_deg` clockwise from north, m/s.
fn blowing(speed_m_s: f64, from_deg: f64) -> [f64; 3] {
    let (sin, cos) = (libm::sin(from_deg.to_radians()), libm::cos(from_deg.to_radians()));
    [-speed_m_s * cos, speed_m_s * sin, 0.0]
}

fn speed(words: &[&str], _: Tick) -> Result<Command> {
    let [speed] = numbers(words, 1, &[Number { key: "x", unit: "", range: SPEEDS }])?;
    Ok(Command::Speed(speed.unwrap_or(1.0)))
}

/// The commands whose names begin with the word.
pub fn completions(word: &str) -> impl Iterator<Item = &'static str> + Clone {
    COMMANDS.iter().map(Entry::name).filter(move |name| name.starts_with(word))
}

#[cfg(test)]
mod tests;
