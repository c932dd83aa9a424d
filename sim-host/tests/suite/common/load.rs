//! Scenarios for tests.

use sim_host::scenario::Scenario;

/// A built-in scenario with settings.
pub(crate) fn load(name: &str, settings: &[&str]) -> Scenario {
    let settings: Vec<String> = settings.iter().map(|s| (*s).to_owned()).collect();
    Scenario::load(name, &settings).unwrap_or_else(|error| panic!("{error:#}"))
}
