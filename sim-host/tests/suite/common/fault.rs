//! Faults for tests.

use sim_host::scenario::Scenario;
use sim_host::sensors::Fault;

/// A fault as scenarios write it: `"sensor='gnss', kind='off', from_s=20"`.
pub(crate) fn fault(keys: &str) -> Fault {
    let list = format!("fault=[{{{}}}]", keys.replace('\'', "\""));
    let scenario = Scenario::load("twist", &[list]).unwrap_or_else(|error| panic!("{error:#}"));
    scenario.file.fault[0]
}
