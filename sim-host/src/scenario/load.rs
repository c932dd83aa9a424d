//! Reading a scenario: its file, its airframe's and its tuning's, with settings from the command line laid over them.

use std::path::Path;

use anyhow::{Error, Result, anyhow, bail};
use toml::{Table, Value};

use super::settings::{Setting, file_names, get, get_mut, is_within};
use super::{AIRFRAMES, SCENARIOS, Scenario, ScenarioFile, TUNINGS, default_airframe, trajectory};
use crate::airframe::AirframeFile;
use crate::controller::{Controller, TuningFile};
use crate::files::{Source, beside, read};
use crate::refusal::{Refusal, typed};

/// What `KEY=false` leaves out of a scenario's file.
const LEFT_OUT: [&str; 13] = [
    "assess",
    "attitude",
    "battery",
    "command",
    "control",
    "disturbance",
    "fault",
    "join",
    "push",
    "sensors",
    "tumble",
    "tuning",
    "wind",
];

/// A file that a scenario is made of, and what the command line has set in it.
struct Layer {
    source: Source,
    table: Table,
    /// Keys that were set, as the file has them.
    set: Vec<String>,
    /// What its keys begin with in a scenario, and in the file: `control.` and `smc.`.
    prefix: (&'static str, &'static str),
}

impl Layer {
    fn new(source: Source, prefix: (&'static str, &'static str)) -> Result<Self> {
        Ok(Self { table: source.table()?, source, set: Vec::new(), prefix })
    }

    fn set(&mut self, setting: &Setting, key: &str) -> Result<()> {
        // A suite by its name is a table that builds on it.
        if key.starts_with("sensors.")
            && let Some(suite @ Value::String(_)) = self.table.get_mut("sensors")
        {
            *suite = Value::Table([("suite".to_owned(), suite.clone())].into_iter().collect());
        }
        if setting.value == Value::Boolean(false) && LEFT_OUT.contains(&key) {
            self.table.remove(key);
            return Ok(());
        }
        self.clear_for_part(key);
        self.clear_for_kind(key);
        setting.apply(&mut self.table, key)?;
        self.set.push(key.to_owned());
        Ok(())
    }

    /// Another kind of trajectory, or of reaching law, replaces the file's.
    fn clear_for_kind(&mut self, key: &str) {
        let Self { table, set, .. } = self;
        for (choice, kind) in choices(key) {
            let is_set = |other: &str| set.iter().any(|key| is_within(key, &format!("{choice}.{other}")));
            match get_mut(table, choice) {
                Some(Value::Table(kinds)) => kinds.retain(|other, _| other == kind || is_set(other)),
                Some(name @ Value::String(_)) => *name = Value::Table(Table::new()),
                _ => {}
            }
        }
    }

    /// Another part replaces the sensor: the file's values were for the part before it. What was set stays.
    fn clear_for_part(&mut self, key: &str) {
        let Some(sensor) = key.strip_prefix("sensors.").and_then(|rest| rest.strip_suffix(".part")) else { return };
        let Self { table, set, .. } = self;
        if let Some(Value::Table(values)) = table.get_mut("sensors").and_then(|sensors| sensors.get_mut(sensor)) {
            values.retain(|name, _| {
                let own = format!("sensors.{sensor}.{name}");
                set.iter().any(|key| is_within(key, &own))
            });
        }
    }

    /// A scenario's key as this file has it, if it belongs here.
    fn own_key(&self, key: &str) -> Option<String> {
        let (outside, inside) = self.prefix;
        key.strip_prefix(outside).map(|rest| inside.to_owned() + rest)
    }

    fn is_set(&self, key: &str) -> bool {
        self.set.iter().any(|set| is_within(key, set) || is_within(set, key))
    }

    /// An error about one of its own keys, with the line in which it stands unless the command line has set it.
    fn explain(&self, error: Error) -> Error {
        let is_set = error.downcast_ref::<Refusal>().is_some_and(|refusal| self.is_set(refusal.key()));
        if is_set { error.context(self.source.to_string()) } else { self.source.about(error) }
    }

    /// As what it describes; a key that is refused is named as a scenario has it.
    fn typed<T: serde::de::DeserializeOwned>(&self) -> Result<T> {
        typed(self.table.clone()).map_err(|error| match error.downcast::<Refusal>() {
            Ok(refusal) => {
                let (outside, inside) = self.prefix;
                let key = refusal.key().strip_prefix(inside).map(|rest| outside.to_owned() + rest);
                let key = key.unwrap_or_else(|| refusal.key().to_owned());
                refusal.with_key(key).into()
            }
            Err(error) => error,
        })
    }
}

/// The keys above this one that are a choice of one kind, with the kind: `control.x.reaching` and `sat`.
fn choices(key: &str) -> impl Iterator<Item = (&str, &str)> {
    let ends = key.match_indices('.').map(|(dot, _)| dot);
    ends.filter_map(move |dot| {
        let (choice, rest) = (&key[..dot], &key[dot + 1..]);
        let is_choice = choice == "trajectory" || choice.ends_with(".reaching");
        is_choice.then(|| (choice, rest.split('.').next().unwrap_or(rest)))
    })
}

/// The files of a scenario: its own first.
struct Layers(Vec<Layer>);

impl Layers {
    /// An error with the file that it is about, the line of its key, and the value that the file has there.
    fn explain(&self, error: Error) -> Error {
        let own = &self.0[0];
        let mut refusal = match error.downcast::<Refusal>() {
            Ok(refusal) => refusal,
            Err(error) => return error.context(own.source.to_string()),
        };
        let with_key = |layer: &Layer| layer.own_key(refusal.key());
        let (layer, key) = self
            .0
            .iter()
            .rev()
            .find_map(|layer| Some((layer, with_key(layer)?)))
            .unwrap_or_else(|| (own, refusal.key().to_owned()));
        if refusal.lacks_value()
            && let Some(value) = get(&layer.table, &key)
        {
            refusal = refusal.given(value);
        }
        if layer.is_set(&key) {
            return Error::new(refusal).context(own.source.to_string());
        }
        layer.explain(refusal.with_key(key).into())
    }
}

impl Scenario {
    /// Loads a built-in scenario by name or a file by path, with `KEY=VALUE` settings applied to it. Keys are
    /// dotted (`control.roll.lambda`); those under `airframe.` set the airframe's, and those under `control.`, or the
    /// name of another controller, the gains, whether they stand in the scenario or in its tuning.
    ///
    /// # Errors
    /// One line that names the scenario or file, the key, and what is wrong with it.
    pub fn load(name: &str, settings: &[String]) -> Result<Self> {
        Self::read(name, settings, None)
    }

    /// The same to be flown by another controller than its own: one that brings no gains is given it.
    ///
    /// # Errors
    /// One line that names the scenario or file, the key, and what is wrong with it.
    pub fn load_for(name: &str, settings: &[String], controller: &Controller) -> Result<Self> {
        Self::read(name, settings, Some(controller))
    }

    fn read(name: &str, settings: &[String], controller: Option<&Controller>) -> Result<Self> {
        let settings = settings.iter().map(|setting| Setting::parse(setting)).collect::<Result<Vec<_>>>()?;
        let mut own = Layer::new(Source::read(name, "scenario", &SCENARIOS)?, ("", ""))?;
        let (mut of_airframe, mut of_gains) = (Vec::new(), Vec::new());
        for setting in &settings {
            match setting.split() {
                ("airframe", Some(rest)) => of_airframe.push((setting, rest)),
                (_, Some(rest)) if setting.is_of_gains() => of_gains.push((setting, rest)),
                _ => own.set(setting, setting.key)?,
            }
        }
        find_beside(&mut own.table, name);
        let tuning = gains(&mut own, &of_gains)?;
        let mut layers = Layers(vec![own]);
        layers.0.extend(tuning);
        let folder = Path::new(name).parent().unwrap_or(Path::new(""));
        let resolved = trajectory::resolve(&mut layers.0[0].table, folder);
        resolved.map_err(|error| layers.explain(error))?;
        let typed = layers.0[0].typed().map_err(trajectory::explain_missing);
        let mut file: ScenarioFile = typed.map_err(|error| layers.explain(error))?;
        if settings.iter().any(moves_the_bound) {
            file.time_optimal_s = None;
        }
        let airframe = Source::named("airframe", &file.airframe, "airframe", &AIRFRAMES);
        layers.0.push(Layer::new(airframe.map_err(|error| layers.explain(error))?, ("airframe.", ""))?);
        let airframe_layer = layers.0.last_mut().ok_or_else(|| anyhow!("no airframe"))?;
        of_airframe.iter().try_for_each(|(setting, key)| airframe_layer.set(setting, key))?;
        of_airframe
            .iter()
            .try_for_each(|(setting, key)| require_effective(&file, setting, key, &layers.0[0].source))?;
        Self::assemble(name, file, &layers, controller).map_err(|error| layers.explain(error))
    }

    /// A scenario of its files, the last of which is the airframe's.
    fn assemble(name: &str, file: ScenarioFile, layers: &Layers, other: Option<&Controller>) -> Result<Self> {
        let [_, tuning @ .., airframe] = layers.0.as_slice() else { bail!("no airframe") };
        let mut airframe: AirframeFile = airframe.typed()?;
        airframe.thrust_to_weight = file.thrust_to_weight.unwrap_or(airframe.thrust_to_weight);
        airframe.rotor_lag_s = file.rotor_lag_s.unwrap_or(airframe.rotor_lag_s);
        airframe.actuation_delay_s = file.actuation_delay_s.unwrap_or(airframe.actuation_delay_s);
        let controller = match (tuning, &file.control, other) {
            ([tuning], None, _) => tuning.typed::<TuningFile>()?.controller,
            ([], Some(control), _) => Controller::Smc(control.clone()),
            ([], None, Some(other)) => other.clone(),
            ([], None, None) => {
                let remedy = format!(
                    "the airframe `{}` brings no gains: fly another (`airframe = \"x500\"`), or name some (`tuning = \
                     \"x500-smc\"`, or a file of yours), or give `[control]`",
                    file.airframe
                );
                return Err(Refusal::new("tuning", "is missing").remedy(remedy).into());
            }
            _ => bail!(BOTH),
        };
        let scenario = Self { name: name.to_owned(), file, airframe, controller, replay: None };
        scenario.validate()?;
        Ok(scenario)
    }
}

/// Refuses a setting of the airframe that the scenario has in its place: it would change nothing.
fn require_effective(file: &ScenarioFile, setting: &Setting, key: &str, source: &Source) -> Result<()> {
    let own = match key {
        "thrust_to_weight" => file.thrust_to_weight,
        "rotor_lag_s" => file.rotor_lag_s,
        "actuation_delay_s" => file.actuation_delay_s,
        _ => None,
    };
    if own.is_some() {
        bail!("--set {}: {source} has its own `{key}` in place of the airframe's: set `{key}`", setting.text);
    }
    Ok(())
}

/// Lets the names of airframe, tuning, suite and parts mean files beside the scenario's own, where there are such.
fn find_beside(table: &mut Table, scenario: &str) {
    for (_, name) in file_names(table) {
        *name = beside(scenario, name);
    }
}

/// Loads a built-in tuning by name or a file by path.
///
/// # Errors
/// One line that names the tuning or file, and what is wrong with it.
pub fn tuning(name: &str) -> Result<TuningFile> {
    read(name, "tuning", &TUNINGS)
}

const BOTH: &str =
    "`tuning` and `control` both say what flies: keep one: --set control=false leaves the scenario's gains out";

/// Lays settings of gains over the scenario's own, or over those of its tuning, which is given back then.
fn gains(own: &mut Layer, settings: &[(&Setting, &str)]) -> Result<Option<Layer>> {
    if own.table.contains_key("tuning") && own.table.contains_key("control") {
        bail!("{}: {BOTH}", own.source);
    }
    let Some(mut tuning) = named_tuning(own)? else {
        for (setting, key) in settings {
            require_controller("smc", setting, &own.source)?;
            own.set(setting, &format!("control.{key}"))?;
        }
        return Ok(None);
    };
    let controller = Controller::NAMES.into_iter().find(|name| tuning.table.contains_key(*name));
    if let Some(controller) = controller {
        tuning.prefix = prefix(controller);
        for (setting, key) in settings {
            require_controller(controller, setting, &tuning.source)?;
            tuning.set(setting, &format!("{controller}.{key}"))?;
        }
    }
    Ok(Some(tuning))
}

/// The tuning that a scenario names, or its airframe's own where it has no gains.
fn named_tuning(own: &Layer) -> Result<Option<Layer>> {
    let table = &own.table;
    let airframe = table.get("airframe").and_then(Value::as_str).map_or_else(default_airframe, str::to_owned);
    let airframes = format!("{airframe}-smc");
    let name = match table.get("tuning") {
        Some(Value::String(name)) => name,
        None if !table.contains_key("control") && TUNINGS.iter().any(|(name, _)| *name == airframes) => &airframes,
        _ => return Ok(None),
    };
    let tuning = Source::named("tuning", name, "tuning", &TUNINGS).map_err(|error| own.explain(error))?;
    Layer::new(tuning, ("", "")).map(Some)
}

/// What a controller's keys begin with in a scenario, and in a tuning file.
fn prefix(controller: &str) -> (&'static str, &'static str) {
    match controller {
        "pid" => ("pid.", "pid."),
        "geometric" => ("geometric.", "geometric."),
        "indi" => ("indi.", "indi."),
        _ => ("control.", "smc."),
    }
}

/// Refuses a setting of another controller's gains than those that `source` gives.
fn require_controller(controller: &str, setting: &Setting, source: &Source) -> Result<()> {
    let (of, _) = setting.split();
    let of = if of == "control" { "smc" } else { of };
    if of == controller {
        return Ok(());
    }
    let (right, _) = prefix(controller);
    let text = setting.text;
    bail!("--set {text}: {source} has the gains of `{controller}`, not of `{of}`: set `{right}…`, or another `tuning`")
}

/// Whether a setting makes another problem of it than the one whose time-optimal bound is known.
fn moves_the_bound(setting: &Setting) -> bool {
    let (key, _) = setting.split();
    let start = key.starts_with("start_") || key == "tumble";
    let world = matches!(key, "truth" | "wind" | "world" | "push" | "battery" | "fault" | "sensors");
    start || world || matches!(key, "airframe" | "thrust_to_weight" | "trajectory" | "plant")
}
