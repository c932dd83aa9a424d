//! `docs/parameters.md` is the table of settings. After a change of the table, `GLISSADE_GENERATE=1 cargo test -p
//! firmware parameters` writes it.

use std::fmt::Write as _;
use std::{env, fs};

use firmware::config::FlightConfig;
use firmware::settings::{Class, Domain, SETTINGS, Setting, Settings, Value};

const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/parameters.md");

const HEAD: &str = "# Parameters

<!-- Generated from the table in `firmware/src/settings`: GLISSADE_GENERATE=1 cargo test -p firmware parameters -->

Everything about the vehicle that can be set, in the order in which it is listed over [MAVLink](mavlink.md#parameters). A
name is PX4's where it means the same in the same unit. `serve --params FILE` keeps what a ground station sets in a file,
and loads it again ([serve](serve.md#parameters)); a scenario sets the same names in its table `[params]`, the command
line by `--set params.NAME=VALUE` ([simulation](simulation.md#parameters)).

The defaults are those of a board that was never configured. A scenario has values of its own: its airframe's, its
tuning's, its sensors'.

| when | meaning |
| --- | --- |
| in flight | may be set at any time, and is in effect at once |
| disarmed | may be set while the vehicle is disarmed, and is in effect at once |
| next start | may be set at any time, and is in effect from the next start |
| read only | shows what the vehicle does; it cannot be changed |

| name | default | range | unit | when | meaning |
| --- | --- | --- | --- | --- | --- |
";

/// The shortest text of a number, without a long row of zeros.
fn number(value: Value) -> String {
    match value {
        Value::Int(int) => int.to_string(),
        Value::Real(real) if real != 0.0 && !(1e-3..1e6).contains(&real.abs()) => format!("{real:e}"),
        Value::Real(real) => real.to_string(),
    }
}

fn range(setting: &Setting) -> String {
    match setting.domain {
        Domain::OneOf(values) => values.iter().map(i32::to_string).collect::<Vec<_>>().join(", "),
        _ if setting.min() == Value::Real(f32::MIN) => "any".to_owned(),
        _ if setting.min() == Value::Real(f32::MIN_POSITIVE) => "above 0".to_owned(),
        _ => format!("{} to {}", number(setting.min()), number(setting.max())),
    }
}

fn document() -> String {
    let defaults = Settings::default();
    let mut text = HEAD.to_owned();
    for (index, setting) in SETTINGS.iter().enumerate() {
        let when = match setting.class {
            Class::InFlight => "in flight",
            Class::Disarmed => "disarmed",
            Class::Boot => "next start",
            Class::ReadOnly => "read only",
        };
        let Setting { name, unit, text: meaning, .. } = setting;
        let default = number(defaults.get(index).expect("a value"));
        writeln!(text, "| `{name}` | {default} | {} | {unit} | {when} | {meaning} |", range(setting)).expect("text");
    }
    text
}

#[test]
fn the_document_is_the_table() {
    let text = document();
    if env::var_os("GLISSADE_GENERATE").is_some() {
        fs::write(PATH, &text).expect("writable");
    }
    let same = fs::read_to_string(PATH).is_ok_and(|written| written == text);
    assert!(same, "docs/parameters.md is out of date: GLISSADE_GENERATE=1 cargo test -p firmware parameters");
}

#[test]
fn the_defaults_are_the_configurations() {
    let mut config = FlightConfig::default();
    Settings::default().write_to(&mut config);
    assert_eq!(config, FlightConfig::default());
}
