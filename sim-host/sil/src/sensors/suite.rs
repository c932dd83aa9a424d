//! Sensor suites: the sensors of a vehicle and their data sheets. A suite names parts, and may override their values:
//!
//! ```toml
//! summary = "what it is"
//! [imu]
//! part = "icm-42688-p"
//! gyro.turn_on_bias = 1.0
//! [gnss]
//! part = "neo-m9n"
//! delay_s = 0.2
//! ```
//!
//! A suite is given by name, such as `"gnss"`, or by a table that builds on one: `suite = "gnss"` with overrides; `mag = false`
//! omits a sensor. A part of one's own is a file, and so is a suite: its path is from the file that names it, or else from
//! the current folder. A sensor without a part gives all values itself.

use anyhow::{Context, Error, Result};
use glissade_files::files::{Source, beside};
use glissade_files::refusal::{Refusal, typed};
use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use super::baro::Baro;
use super::battery::Battery;
use super::faults::Sensor;
use super::gnss::Gnss;
use super::imu::Imu;
use super::mag::Mag;
use super::pose::Pose;

/// Suites built into the binary.
pub const SUITES: [(&str, &str); 3] = glissade_files::built_in!("../../sensors": "gnss", "rtk", "mocap");

/// Parts built into the binary.
const PARTS: [(&str, &str); 8] = glissade_files::built_in!("../../sensors/parts":
    "icm-42688-p", "bmi088", "ist8310", "bmp388", "neo-m9n", "zed-f9p", "mocap", "power-module",
);

/// The sensors of a vehicle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Value")]
pub struct SuiteFile {
    /// Description, in one line.
    pub summary: String,
    /// Gyro and accelerometer.
    pub imu: Imu,
    /// Magnetometer.
    pub mag: Option<Mag>,
    /// Barometer.
    pub baro: Option<Baro>,
    /// Satellite receiver.
    pub gnss: Option<Gnss>,
    /// Motion capture.
    pub pose: Option<Pose>,
    /// Battery monitor.
    pub battery: Option<Battery>,
}

/// A suite with its parts resolved.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Complete {
    summary: String,
    imu: Imu,
    mag: Option<Mag>,
    baro: Option<Baro>,
    gnss: Option<Gnss>,
    pose: Option<Pose>,
    battery: Option<Battery>,
}

impl TryFrom<Value> for SuiteFile {
    type Error = String;

    fn try_from(value: Value) -> Result<Self, String> {
        let suite = match value {
            Value::String(name) => Self::load(&name),
            Value::Table(table) => Self::from_table(table),
            other => Err(Refusal::new("sensors", "must be a suite's name or a table").given(other).into()),
        };
        suite.map_err(|error| format!("{error:#}"))
    }
}

impl SuiteFile {
    /// Loads a built-in suite by name or a file by path.
    ///
    /// # Errors
    /// One line with the suite or file, the key and the error.
    pub fn load(name: &str) -> Result<Self> {
        let source = Source::read(name, "suite", &SUITES)?;
        Self::from_table(table(&source, name)?).map_err(|error| source.about(error))
    }

    /// From a table, which may build on another suite by `suite = "name"`.
    ///
    /// # Errors
    /// One line that names the key, and what is wrong with it.
    pub fn from_table(table: Table) -> Result<Self> {
        let mut complete = Table::new();
        for (key, value) in built_on_others(table)? {
            let value = match value {
                Value::Table(sensor) => Value::Table(with_part(&key, sensor)?),
                Value::Boolean(false) => continue,
                other => other,
            };
            complete.insert(key, value);
        }
        let complete = typed(complete).map_err(|error| Refusal::below(or_part(error), "sensors"))?;
        let Complete { summary, imu, mag, baro, gnss, pose, battery } = complete;
        let suite = Self { summary, imu, mag, baro, gnss, pose, battery };
        suite.validate()?;
        Ok(suite)
    }

    /// Whether a sensor is on board.
    pub fn has(&self, sensor: Sensor) -> bool {
        match sensor {
            Sensor::Imu | Sensor::Gyro | Sensor::Accel => true,
            Sensor::Mag => self.mag.is_some(),
            Sensor::Baro => self.baro.is_some(),
            Sensor::Gnss => self.gnss.is_some(),
            Sensor::Pose => self.pose.is_some(),
            Sensor::Battery => self.battery.is_some(),
        }
    }

    /// Checks every value against its range.
    ///
    /// # Errors
    /// The first key that is out of range.
    pub fn validate(&self) -> Result<()> {
        self.imu.validate()?;
        self.mag.as_ref().map_or(Ok(()), Mag::validate)?;
        self.baro.as_ref().map_or(Ok(()), Baro::validate)?;
        self.gnss.as_ref().map_or(Ok(()), Gnss::validate)?;
        self.pose.as_ref().map_or(Ok(()), Pose::validate)?;
        self.battery.as_ref().map_or(Ok(()), Battery::validate)
    }
}

/// Names and summaries of the built-in suites.
///
/// # Errors
/// None in practice: tests load each built-in suite.
pub fn list() -> Result<Vec<(&'static str, String)>> {
    SUITES.iter().map(|(name, _)| Ok((*name, SuiteFile::load(name)?.summary))).collect()
}

/// The names of files in a suite, or in a scenario's `sensors`, each of which may be built in, and their kinds: `suite` or
/// `part`.
pub fn file_names(sensors: &mut Value) -> Vec<(&'static str, &mut String)> {
    match sensors {
        Value::String(suite) => vec![("suite", suite)],
        Value::Table(table) => names_in(table).collect(),
        _ => Vec::new(),
    }
}

fn names_in(table: &mut Table) -> impl Iterator<Item = (&'static str, &mut String)> {
    table.iter_mut().filter_map(|(key, value)| match value {
        Value::String(suite) if key == "suite" => Some(("suite", suite)),
        Value::Table(sensor) => match sensor.get_mut("part")? {
            Value::String(part) => Some(("part", part)),
            _ => None,
        },
        _ => None,
    })
}

/// The table of a suite's file; what it names may be files beside it.
fn table(source: &Source, path: &str) -> Result<Table> {
    let mut table = source.table()?;
    for (_, name) in names_in(&mut table) {
        *name = beside(path, name);
    }
    Ok(table)
}

/// A table merged over the suite that it builds on, which may build on another.
fn built_on_others(mut over: Table) -> Result<Table> {
    /// More are a suite that builds on itself.
    const MOST: usize = 8;
    for _ in 0..=MOST {
        let Some(base) = over.remove("suite") else { return Ok(over) };
        let name = base.as_str().context("`sensors.suite` must be a suite's name")?;
        let source = Source::named("sensors.suite", name, "suite", &SUITES)?;
        over = merged(table(&source, name)?, over);
    }
    let rule = format!("builds on itself, or on more than {MOST} suites one after the other");
    Err(Refusal::new("sensors.suite", rule).remedy("name a suite that is built in").into())
}

/// A sensor's table merged over its part's. A part of one's own is not named any more: its file may go.
fn with_part(sensor: &str, mut table: Table) -> Result<Table> {
    let Some(name) = table.get("part") else { return Ok(table) };
    let name = name.as_str().with_context(|| format!("`sensors.{sensor}.part` must be a part's name"))?;
    let source = Source::named(&format!("sensors.{sensor}.part"), name, "part", &PARTS)?;
    if source.is_path() {
        table.remove("part");
    }
    Ok(merged(source.table()?, table))
}

/// A value that a sensor lacks can come from a part.
fn or_part(error: Error) -> Error {
    match error.downcast::<Refusal>() {
        Ok(refusal) if refusal.is_missing() && refusal.key().contains('.') => {
            refusal.remedy("give it, or the sensor a `part` that has it").into()
        }
        Ok(refusal) => refusal.into(),
        Err(error) => error,
    }
}

/// `over` merged over `base`, recursively.
fn merged(mut base: Table, over: Table) -> Table {
    for (key, value) in over {
        let value = match (base.remove(&key), value) {
            (Some(Value::Table(below)), Value::Table(above)) => Value::Table(merged(below, above)),
            (_, value) => value,
        };
        base.insert(key, value);
    }
    base
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(text: &str) -> String {
        let error = SuiteFile::from_table(text.parse().expect("TOML")).expect_err("must be refused");
        let text = format!("{error:#}");
        assert!(!text.contains('\n'), "{text}");
        text
    }

    #[test]
    fn every_built_in_suite_loads_and_has_its_sensors() {
        assert_eq!(list().expect("all load").len(), SUITES.len());
        let has = |name: &str| {
            let suite = SuiteFile::load(name).expect("loads");
            [suite.mag.is_some(), suite.baro.is_some(), suite.gnss.is_some(), suite.pose.is_some()]
        };
        assert_eq!(has("gnss"), [true, true, true, false]);
        assert_eq!(has("rtk"), [true, true, true, false]);
        assert_eq!(has("mocap"), [false, true, false, true]);
    }

    #[test]
    fn every_part_fits_its_sensor() {
        for (sensor, name) in [
            ("imu", "icm-42688-p"),
            ("imu", "bmi088"),
            ("mag", "ist8310"),
            ("baro", "bmp388"),
            ("gnss", "neo-m9n"),
            ("gnss", "zed-f9p"),
            ("pose", "mocap"),
            ("battery", "power-module"),
        ] {
            let table = format!("suite = \"mocap\"\n{sensor}.part = \"{name}\"");
            SuiteFile::from_table(table.parse().expect("TOML")).expect(name);
        }
    }

    #[test]
    fn what_a_suite_says_stands_above_what_its_part_says() {
        let table = "suite = \"gnss\"\ngnss.delay_s = 0.2\nimu.gyro.turn_on_bias = 1.0";
        let (plain, changed) = (
            SuiteFile::load("gnss").expect("loads"),
            SuiteFile::from_table(table.parse().expect("TOML")).expect("loads"),
        );
        let mut expected = plain.clone();
        expected.gnss.as_mut().expect("there").delay_s = 0.2;
        expected.imu.gyro.turn_on_bias = 1.0;
        assert_eq!(changed, expected);
        assert_ne!(changed, plain);
    }

    #[test]
    fn a_sensor_without_a_part_gives_all_values_itself() {
        let parse = |text: &str| SuiteFile::from_table(text.parse().expect("TOML"));
        let values = "rate_hz = 100.0, delay_s = 0.01, position_m = 0.0005, attitude_deg = 0.1";
        let suite = format!("suite = \"gnss\"\npose = {{ {values} }}");
        let named = Pose { part: None, ..SuiteFile::load("mocap").expect("loads").pose.expect("there") };
        assert_eq!(parse(&suite).expect("loads").pose, Some(named));
        assert_eq!(
            refusal("suite = \"gnss\"\npose = { rate_hz = 100.0 }"),
            "`sensors.pose.delay_s` is missing: give it, or the sensor a `part` that has it"
        );
    }

    #[test]
    fn a_suite_that_builds_on_itself_is_refused() {
        let path = std::env::temp_dir().join(format!("glissade-{}-suite.toml", std::process::id()));
        std::fs::write(&path, format!("suite = \"{}\"", path.display())).expect("can be written");
        let text = refusal(&format!("suite = \"{}\"", path.display()));
        assert_eq!(
            text,
            "`sensors.suite` builds on itself, or on more than 8 suites one after the other: name a suite that is built in"
        );
        std::fs::remove_file(&path).expect("it is there");
    }

    #[test]
    fn a_sensor_can_be_left_out() {
        let without = SuiteFile::from_table("suite = \"gnss\"\nmag = false".parse().expect("TOML")).expect("loads");
        assert_eq!(without, SuiteFile { mag: None, ..SuiteFile::load("gnss").expect("loads") });
        assert!(refusal("suite = \"gnss\"\nimu = false").contains("imu"));
    }

    #[test]
    fn a_suite_can_be_a_name_or_a_table_in_another_file() {
        #[derive(Deserialize)]
        struct Outer {
            sensors: SuiteFile,
        }
        for text in ["sensors = \"rtk\"", "sensors = { suite = \"rtk\" }"] {
            let outer: Outer = toml::from_str(text).expect("loads");
            assert_eq!(outer.sensors, SuiteFile::load("rtk").expect("loads"));
        }
        let written = toml::to_string(&SuiteFile::load("rtk").expect("loads")).expect("writes");
        assert_eq!(
            SuiteFile::from_table(written.parse().expect("TOML")).expect("reads"),
            SuiteFile::load("rtk").expect("loads")
        );
    }

    #[test]
    fn bad_input_is_one_line_that_names_the_culprit() {
        for (setting, culprit) in [
            (
                "gnss.delay_s = 0.3",
                "`sensors.gnss.delay_s` must be between 0 and 0.249 s, not 0.3: shorten it: the estimator fuses what is \
                 at most 0.249 s late",
            ),
            (
                "gnss.delay_s = 0.23",
                "`sensors.gnss.delay_s` must be between 0 and 0.229 s, not 0.23: shorten it: the estimator fuses what is \
                 at most 0.249 s late, and `jitter_s` is 0.02",
            ),
            ("gnss.delay_s = -0.1", "`sensors.gnss.delay_s` must be between 0 and 0.249 s, not -0.1"),
            ("mag.delay_s = 0.25", "`sensors.mag.delay_s` must be between 0 and 0.249 s, not 0.25"),
            ("baro.delay_s = 0.25", "`sensors.baro.delay_s` must be between 0 and 0.249 s, not 0.25"),
            ("pose = { part = \"mocap\", delay_s = 0.25 }", "`sensors.pose.delay_s` must be between 0 and 0.249 s"),
            ("battery.delay_s = 2.0", "`sensors.battery.delay_s` must be between 0 and 1 s, not 2"),
            ("gnss.jitter_s = 0.1", "sensors.gnss.jitter_s"),
            ("gnss.colour = 1", "colour"),
            ("gnss.part = \"neo-m8\"", "neo-m8"),
            ("gnss.part = 8", "sensors.gnss.part"),
            ("gnss.part = \"bmp388\"", "rate_hz"),
            ("imu.gyro.noise_density = [1.0, nan, 1.0]", "sensors.imu.gyro.noise_density"),
            ("imu.accel.range = 0.0", "sensors.imu.accel.range"),
            ("imu.vibration.second_harmonic = -1.0", "sensors.imu.vibration.second_harmonic"),
            ("mag.rate_hz = 300.0", "sensors.mag.rate_hz"),
            ("baro.warm_up.time_s = 0.0", "sensors.baro.warm_up.time_s"),
            ("colour = 1", "colour"),
        ] {
            let text = refusal(&format!("suite = \"gnss\"\n{setting}"));
            assert!(text.contains(culprit), "{setting}: {text}");
        }
        assert!(refusal("suite = \"gps\"").contains("gps"));
        assert!(refusal("summary = \"none\"").contains("imu"));
    }
}
