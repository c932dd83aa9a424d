//! The table, and the settings as a value.

use std::collections::BTreeSet;

use proptest::prelude::*;

use super::*;
use crate::commander::Commander;
use crate::config::Start;
use crate::control::attitude::SlidingAttitude;
use crate::control::gains::{AxisGains, ReachingLaw, Surface};
use crate::control::law::AttitudeLaw as _;
use crate::control::position::SlidingPosition;
use crate::estimator::{EstimatorSettings, Filter};
use crate::outer::Outer;

/// A configuration with every part.
fn whole() -> FlightConfig {
    FlightConfig { estimator: Some(EstimatorSettings::default()), ..FlightConfig::default() }
}

fn index(name: &str) -> usize {
    find(name).unwrap_or_else(|| panic!("`{name}` is in the table"))
}

/// Another accepted value than the present one, if there is one.
fn other(settings: &Settings, index: usize) -> Value {
    let setting = &SETTINGS[index];
    match (settings.get(index).expect("a setting"), setting.domain) {
        (Value::Int(now), Domain::OneOf(values)) => {
            Value::Int(*values.iter().find(|value| **value != now).expect("a choice"))
        }
        (Value::Int(now), _) if setting.max() == Value::Int(now) => Value::Int(now - 1),
        (Value::Int(now), _) => Value::Int(now + 1),
        (Value::Real(now), _) if setting.accepts(Value::Real(now * 1.01)) && now != 0.0 => Value::Real(now * 1.01),
        (Value::Real(now), _) if setting.accepts(Value::Real(now * 0.99)) && now != 0.0 => Value::Real(now * 0.99),
        (Value::Real(now), _) => Value::Real(now + 0.01),
    }
}

#[test]
fn names_are_unique_and_fit_into_a_message() {
    let names: BTreeSet<&str> = SETTINGS.iter().map(|setting| setting.name).collect();
    assert_eq!(names.len(), COUNT);
    for setting in &SETTINGS {
        let name = setting.name;
        assert!(name.len() <= NAME_MAX && !name.is_empty(), "{name}");
        assert!(name.bytes().all(|byte| byte.is_ascii_uppercase() || byte.is_ascii_digit() || byte == b'_'), "{name}");
        assert!(!setting.text.is_empty() && setting.text.is_ascii(), "{name}");
        assert_eq!(SETTINGS[index(name)].name, name);
    }
}

#[test]
fn defaults_are_within_their_ranges_and_bounds_are_accepted() {
    let settings = Settings::default();
    for (index, setting) in SETTINGS.iter().enumerate() {
        let name = setting.name;
        assert!(setting.accepts(settings.get(index).expect("a value")), "{name}");
        assert!(setting.accepts(setting.min()) && setting.accepts(setting.max()), "{name}");
        assert_eq!(setting.default.map_or(setting.kind(), Value::kind), setting.kind(), "{name}");
        // Python clients quiet signalling NaNs: the bits of no integer may be one.
        if let (Value::Int(low), Value::Int(high)) = (setting.min(), setting.max()) {
            assert!(low > -4_194_305 && high < 2_139_095_041, "{name}");
        }
    }
    assert!(!settings.is_configured() && Settings::of(&FlightConfig::default()).is_configured());
}

#[test]
fn what_is_set_is_had_and_reaches_the_configuration_alone_where_it_stands() {
    for (index, setting) in SETTINGS.iter().enumerate() {
        let name = setting.name;
        let mut settings = Settings::of(&whole());
        let value = other(&settings, index);
        if setting.class == Class::ReadOnly {
            assert_eq!(settings.set(index, value, false), Err(SettingError::ReadOnly), "{name}");
            continue;
        }
        let change = settings.set(index, value, false).unwrap_or_else(|error| panic!("{name}: {error:?}"));
        assert_eq!((change.index, change.value, settings.get(index)), (index as u16, value, Some(value)), "{name}");
        let mut config = whole();
        settings.write_to(&mut config);
        let again = Settings::of(&config);
        for (i, other) in SETTINGS.iter().enumerate().filter(|(i, _)| *i != SYS_AUTOSTART && *i != index) {
            // A number of a law that is not chosen is no part of the configuration.
            let depends = setting.name.ends_with("_LAW") && other.name.starts_with(&name[..name.len() - 4]);
            assert!(depends || again.get(i) == settings.get(i), "{name} has changed {}", other.name);
        }
        let stands = !matches!(setting.place, Place::Settings) && settings.is_in_use(index);
        match (again.get(index), value) {
            (Some(Value::Real(had)), Value::Real(set)) if stands => {
                // A unit that is converted may round.
                let near = if setting.scale == 1.0 { 0.0 } else { 2e-7 };
                assert!(crate::math::abs(had - set) <= near * crate::math::abs(set), "{name}: {had} {set}");
            }
            (had, set) if stands => assert_eq!(had, Some(set), "{name}"),
            _ => {}
        }
    }
}

#[test]
fn a_configuration_goes_through_the_settings_bit_for_bit() {
    let mut config = whole();
    config.start = Start::InFlight;
    config.tilt_max_rad = 0.612_345_6;
    config.attitude.axes[1] = AxisGains {
        surface: Surface::Integral,
        reaching: ReachingLaw::ImplicitSuperTwisting { twist: 3.0, horizon_s: 0.03 },
        ..AxisGains::sat(1.0, 2.0, 3.0)
    };
    let mut again = config.clone();
    Settings::of(&config).write_to(&mut again);
    assert_eq!(again, config);
    let mut from_other = whole();
    from_other.start = config.start;
    Settings::of(&config).write_to(&mut from_other);
    from_other.tilt_max_rad = config.tilt_max_rad;
    assert_eq!(from_other, config);
}

#[test]
fn every_number_of_the_configuration_is_a_setting() {
    // Written out: a new field does not compile here until it has been thought of.
    let FlightConfig {
        airframe,
        attitude,
        position,
        tilt_max_rad: _,
        rotor_time_constant_s: _,
        trajectory: _,
        join: _,
        start: _,
        start_position_m: _,
        estimator,
        modes: _,
        manual: _,
    } = whole();
    let keys: BTreeSet<String> = SETTINGS.iter().map(|setting| setting.key.to_string()).collect();
    let fields = |text: String, group: &str| {
        // `Name { field: …, … }`: the fields of the outermost level.
        let mut depth = 0;
        let mut found = Vec::new();
        for (i, c) in text.char_indices() {
            match c {
                '{' | '[' => depth += 1,
                '}' | ']' => depth -= 1,
                ':' if depth == 1 => {
                    let name = text[..i].rsplit(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or("");
                    found.push(format!("{group}.{name}"));
                }
                _ => {}
            }
        }
        found
    };
    let mut wanted = Vec::new();
    wanted.extend(fields(format!("{airframe:?}"), "airframe"));
    wanted.extend(fields(format!("{:?}", airframe.geometry), "airframe.geometry"));
    wanted.extend(fields(format!("{:?}", estimator.expect("whole")), "estimator"));
    wanted.extend(fields(format!("{:?}", whole().modes), "modes"));
    wanted.extend(fields(format!("{:?}", whole().manual), "manual"));
    for axis in ["roll", "pitch", "yaw", "x", "y", "z"] {
        wanted.extend(fields(format!("{:?}", attitude.axes[0]), &format!("control.{axis}")));
    }
    for law in [fields(format!("{attitude:?}"), "control"), fields(format!("{position:?}"), "control")] {
        wanted.extend(law.into_iter().filter(|key| !["control.axes", "control.observer"].contains(&key.as_str())));
    }
    let observer = |group: &str| fields(format!("{:?}", attitude.observer), &format!("control.{group}_observer"));
    wanted.extend(observer("attitude").into_iter().chain(observer("position")));
    wanted.extend(["control.tilt_max_rad".to_owned(), "control.rotor_time_constant_s".to_owned()]);
    for key in wanted {
        let there = keys.iter().any(|had| *had == key || had.starts_with(&format!("{key}.")));
        assert!(there, "`{key}` is no setting");
    }
}

#[test]
fn what_does_not_fit_is_refused_and_nothing_changes() {
    let mut settings = Settings::of(&whole());
    let before = settings.clone();
    let speed = index("MPC_XY_CRUISE");
    for (index, value, armed, error) in [
        (COUNT, Value::Int(1), false, SettingError::Unknown),
        (speed, Value::Int(1), false, SettingError::OtherType),
        (speed, Value::Real(f32::NAN), false, SettingError::NotANumber),
        (speed, Value::Real(f32::INFINITY), false, SettingError::OutOfRange),
        (speed, Value::Real(0.04), false, SettingError::OutOfRange),
        (index("NAV_ACC_RAD"), Value::Real(1.0), false, SettingError::ReadOnly),
        (index("SMC_ATT_FORM"), Value::Int(1), true, SettingError::Armed),
        (index("GL_AUTOPILOT"), Value::Int(3), false, SettingError::OutOfRange),
        (index("MAV_SYS_ID"), Value::Int(0), false, SettingError::OutOfRange),
        (index("MAV_SYS_ID"), Value::Int(251), false, SettingError::OutOfRange),
    ] {
        assert_eq!(settings.set(index, value, armed), Err(error));
    }
    assert_eq!(settings, before);
    // The present value is never refused.
    for index in 0..COUNT {
        let value = before.get(index).expect("a value");
        assert!(settings.set(index, value, true).is_ok());
    }
    assert_eq!(settings, before);
}

#[test]
fn a_geometry_that_cannot_be_mixed_is_refused() {
    let mut settings = Settings::of(&whole());
    // Without the yaw torques of all rotors there is none.
    for (rotor, expected) in [("GL_YAW_1", true), ("GL_YAW_2", true), ("GL_YAW_3", true), ("GL_YAW_4", false)] {
        let done = settings.set(index(rotor), Value::Real(0.0), false);
        assert_eq!(done.is_ok(), expected, "{rotor}: {done:?}");
    }
    let refused = settings.set(index("GL_YAW_4"), Value::Real(0.0), false);
    assert_eq!(refused, Err(SettingError::Refused(ConfigError::SingularGeometry)));
}

#[test]
fn changes_go_out_once_and_the_last_value_counts() {
    let mut settings = Settings::of(&whole());
    let speed = index("MPC_XY_CRUISE");
    for value in [3.0, 4.0, 5.5] {
        settings.set(speed, Value::Real(value), true).expect("in range");
    }
    // Takes effect at the next start, and in the settings alone: neither is sent.
    settings.set(index("GL_MASS"), Value::Real(0.9), true).expect("in range");
    settings.set(MIS_TAKEOFF_ALT, Value::Real(4.0), true).expect("in range");
    let changes = settings.take_changes();
    assert_eq!(changes.len(), 1);
    assert_eq!((changes[0].index, changes[0].value), (speed as u16, Value::Real(5.5)));
    assert!(settings.take_changes().is_empty());
}

#[test]
fn a_law_is_sent_together_with_its_numbers() {
    let mut settings = Settings::of(&whole());
    // Remembered, though sat has no such number.
    settings.set(index("SMC_X_HORIZ"), Value::Real(0.25), true).expect("in range");
    settings.set(index("SMC_X_TWIST"), Value::Real(2.5), true).expect("in range");
    assert!(settings.take_changes().is_empty());
    for name in ["SMC_X_LAMBDA", "SMC_X_K"] {
        settings.set(index(name), Value::Real(1.5), true).expect("in range");
    }
    settings.set(index("SMC_X_LAW"), Value::Int(7), false).expect("in range");
    let mut law = crate::config::FlightConfig::default().position;
    let mut batches = Vec::new();
    loop {
        let changes = settings.take_changes();
        if changes.is_empty() {
            break;
        }
        for change in &changes {
            assert!(change.apply_to(&mut law, Place::position));
        }
        let whole = match law.axes[0].reaching {
            ReachingLaw::ImplicitSuperTwisting { twist, horizon_s } => twist == 2.5 && horizon_s == 0.25,
            other => other == crate::config::FlightConfig::default().position.axes[0].reaching,
        };
        assert!(whole, "never a law with other numbers: {:?}", law.axes[0]);
        batches.push(changes.len());
    }
    assert_eq!((batches, law.axes[0].lambda, law.axes[0].gain), (vec![2, 3], 1.5, 1.5));
}

#[test]
fn settings_that_are_set_again_and_again_do_not_hold_up_the_others() {
    let mut settings = Settings::of(&whole());
    settings.set(index("RTL_RETURN_ALT"), Value::Real(15.0), false).expect("in range");
    let flood = ["MPC_XY_CRUISE", "MPC_Z_VEL_MAX_UP", "MPC_Z_VEL_MAX_DN", "MPC_TKO_SPEED", "MPC_LAND_SPEED"];
    let sent = (0..3_u8).any(|round| {
        for name in flood {
            settings.set(index(name), Value::Real(1.0 + f32::from(round)), false).expect("in range");
        }
        settings.take_changes().iter().any(|change| usize::from(change.index) == index("RTL_RETURN_ALT"))
    });
    assert!(sent, "in the second batch at the latest");
}

#[test]
fn settings_are_settled_once_what_can_be_set_while_disarmed_only_was_sent() {
    let mut settings = Settings::of(&whole());
    for index in (0..COUNT).filter(|index| SETTINGS[*index].class == Class::InFlight) {
        settings.set(index, other(&settings, index), false).expect("in range");
    }
    settings.set(SYS_AUTOSTART, Value::Int(0), false).expect("in range");
    assert!(!settings.are_settled());
    let mut taken: Vec<usize> = Vec::new();
    while !settings.are_settled() {
        taken.extend(settings.take_changes().iter().map(|change| usize::from(change.index)));
    }
    assert_eq!(taken.iter().filter(|index| **index == SYS_AUTOSTART).count(), 1);
}

#[test]
fn what_was_set_waits_until_it_is_saved() {
    let mut settings = Settings::of(&whole());
    let mass = index("GL_MASS");
    settings.set(mass, Value::Real(0.9), false).expect("in range");
    assert_eq!(settings.next_unsaved(), Some((mass, Value::Real(0.9))));
    settings.set(mass, Value::Real(1.0), false).expect("in range");
    settings.saved(mass, Value::Real(0.9));
    assert_eq!(settings.next_unsaved(), Some((mass, Value::Real(1.0))), "it was set again meanwhile");
    settings.saved(mass, Value::Real(1.0));
    assert_eq!(settings.next_unsaved(), None);
}

/// What the owners of settings have made of a configuration.
struct Owners {
    attitude: SlidingAttitude,
    outer: Outer,
    commander: Commander,
    filter: Filter,
}

impl Owners {
    fn of(config: &FlightConfig, settings: &Settings) -> Self {
        let estimator = config.estimator.expect("a whole configuration");
        let mut commander = Commander::new(config);
        commander.configure(settings);
        Self {
            attitude: SlidingAttitude::new(&config.airframe, &config.attitude),
            outer: Outer::new(config, SlidingPosition::new(&config.airframe, &config.position)).expect("valid"),
            commander,
            filter: Filter::new(&estimator, 9.81, 0.1, config.start_position()),
        }
    }

    fn apply(&mut self, change: &Change) {
        self.attitude.retune(change);
        self.outer.apply(change);
        self.commander.apply(change);
        self.filter.apply(change);
    }

    /// Every float has its own text.
    fn texts(&self) -> [String; 4] {
        let Self { attitude, outer, commander, filter } = self;
        [format!("{attitude:?}"), format!("{outer:?}"), format!("{commander:?}"), format!("{filter:?}")]
    }
}

#[test]
fn whoever_takes_a_change_over_is_as_if_built_with_it() {
    for law in 0..=ReachingLaw::CODE_MAX {
        let mut config = whole();
        for axis in config.attitude.axes.iter_mut().chain(&mut config.position.axes) {
            axis.choose_law(law);
        }
        config.attitude.observer.bandwidth_rad_s = 20.0;
        for (index, setting) in SETTINGS.iter().enumerate() {
            let mut settings = Settings::of(&config);
            let value = other(&settings, index);
            let mut owners = Owners::of(&config, &settings);
            if settings.set(index, value, setting.class == Class::InFlight).is_err() {
                continue;
            }
            let before = owners.texts();
            let changes = settings.take_changes();
            for change in &changes {
                owners.apply(change);
            }
            let mut changed = config.clone();
            settings.write_to(&mut changed);
            let name = setting.name;
            match setting.place {
                Place::Settings if OF_COMMANDER.contains(&index) && index != SYS_AUTOSTART => {
                    assert_ne!(owners.texts(), before, "{name} has no effect");
                    assert_eq!(owners.texts(), Owners::of(&changed, &settings).texts(), "{name}");
                }
                Place::Settings | Place::Airframe(_) => assert_eq!(owners.texts(), before, "{name}"),
                _ if changes.is_empty() => {
                    assert!(setting.class == Class::Boot || !settings.is_in_use(index), "{name}");
                    assert_eq!(owners.texts(), before, "{name}");
                }
                _ => {
                    assert_ne!(owners.texts(), before, "{name} of law {law} has no effect");
                    assert_eq!(owners.texts(), Owners::of(&changed, &settings).texts(), "{name} of law {law}");
                }
            }
        }
    }
}

proptest! {
    #[test]
    fn random_sets_never_leave_the_ranges(sets in prop::collection::vec((0..COUNT + 2, any::<u32>(), any::<bool>(), any::<bool>()), 1..200)) {
        let mut settings = Settings::of(&whole());
        for (index, bits, is_int, armed) in sets {
            let kind = if is_int { Kind::Int32 } else { Kind::Real32 };
            let before = settings.get(index);
            let done = settings.set(index, Value::from_bits(kind, bits), armed);
            if done.is_err() {
                prop_assert_eq!(settings.get(index), before);
            }
        }
        for (index, setting) in SETTINGS.iter().enumerate() {
            prop_assert!(setting.accepts(settings.get(index).expect("a value")), "{}", setting.name);
        }
        let mut config = whole();
        settings.write_to(&mut config);
        prop_assert_eq!(config.validate(), Ok(()));
    }
}

#[test]
fn a_charge_is_told_once_the_cells_are_known_by_their_voltage_at_rest() {
    let mut settings = Settings::of(&FlightConfig::default());
    // Four cells of 3.825 V at rest, half way from 3.6 to 4.05 V, of which 20 A take 0.1 V each.
    let battery = BatterySample { voltage_v: 4.0 * 3.725, current_a: 20.0 };
    assert_eq!(settings.charge(&battery), None);
    settings.set(BAT1_N_CELLS, Value::Int(4), false).expect("in range");
    assert!(math::abs(settings.charge(&battery).expect("known") - 0.5) < 1e-5);
    for (voltage_v, charge) in [(10.0, Some(0.0)), (17.0, Some(1.0)), (f32::NAN, None)] {
        assert_eq!(settings.charge(&BatterySample { voltage_v, current_a: 0.0 }), charge);
    }
    settings.set(BAT1_V_CHARGED, Value::Real(3.0), false).expect("in range");
    assert_eq!(settings.charge(&battery), None, "full is below empty");
}
