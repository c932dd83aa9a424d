//! A scenario's flight as one type is the flight of its plant under its laws, whoever records it.

use firmware::control::law::{AttitudeLaw, PositionLaw};
use sim_host::baseline::geometric::{GeometricAttitude, GeometricPosition};
use sim_host::baseline::indi::{IndiAttitude, IndiPosition};
use sim_host::baseline::pid::{PidAttitude, PidPosition};
use sim_host::controller::Controller;
use sim_host::flight;
use sim_host::record::{Recorder, Row};
use sim_host::scenario::Scenario;
use sim_host::sil::{End, Lockstep, Outcome};

use crate::common::load::load;

const TICKS: u32 = 1_500;

fn recorded(flight: &mut impl Lockstep) -> (Outcome, Vec<Row>) {
    let mut rows = Vec::new();
    (flight.run(TICKS, &mut rows), rows)
}

/// On the rigid body, with laws of this test's choice.
fn by_hand(scenario: &Scenario, attitude: impl AttitudeLaw, position: impl PositionLaw) -> (Outcome, Vec<Row>) {
    let plant = flight::rigid_body(scenario, 1);
    recorded(&mut flight::with_laws(scenario, 1, plant, attitude, position).expect("can be flown"))
}

#[test]
fn it_is_the_flight_of_its_plant_under_its_laws() {
    for tuning in ["x500-smc", "x500-pid", "x500-geometric", "x500-indi"] {
        let scenario = load("x500-eight", &[&format!("tuning={tuning}")]);
        let airframe = scenario.airframe.flight();
        let expected = match &scenario.controller {
            Controller::Smc(_) => {
                recorded(&mut flight::lockstep(&scenario, 1, flight::rigid_body(&scenario, 1)).expect("can be flown"))
            }
            Controller::Pid(gains) => {
                by_hand(&scenario, PidAttitude::new(&airframe, gains), PidPosition::new(&airframe, gains))
            }
            Controller::Geometric(gains) => {
                by_hand(&scenario, GeometricAttitude::new(&airframe, gains), GeometricPosition::new(&airframe, gains))
            }
            Controller::Indi(gains) => {
                by_hand(&scenario, IndiAttitude::new(&airframe, gains), IndiPosition::new(&airframe, gains))
            }
        };
        let prepared = recorded(&mut flight::prepare(&scenario, 1).expect("can be flown"));
        assert!(prepared == expected && prepared.1.len() == TICKS as usize, "{tuning}");
    }
}

#[test]
fn it_flies_alike_unseen() {
    for name in ["x500-eight", "outdoor-hover", "paper-literal", "paper-ideal"] {
        let scenario = load(name, &[]);
        let prepare = || flight::prepare(&scenario, 1).expect("can be flown");
        let (mut seen, mut unseen) = (prepare(), prepare());
        let outcomes = (recorded(&mut seen).0, unseen.run(TICKS, &mut ()));
        assert_eq!(outcomes.0, outcomes.1, "{name}");
        assert_eq!(seen.look().row, unseen.look().row, "{name}");
    }
}

/// Wants no more than so many rows.
struct Enough(usize, Vec<Row>);

impl Recorder for Enough {
    fn record(&mut self, row: &Row) {
        self.1.push(*row);
    }

    fn stops(&self) -> bool {
        self.1.len() >= self.0
    }
}

#[test]
fn a_recorder_that_has_enough_ends_it_after_that_tick() {
    for name in ["x500-eight", "outdoor-hover", "paper-literal", "paper-ideal"] {
        let scenario = load(name, &[]);
        let mut enough = Enough(123, Vec::new());
        let outcome = flight::prepare(&scenario, 1).expect("can be flown").run(TICKS, &mut enough);
        assert_eq!((outcome.end, outcome.ticks, enough.1.len()), (End::Interrupted, 123, 123), "{name}");
    }
}
