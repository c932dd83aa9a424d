//! What a battery level that was reached holds for.

use super::*;

const EMPTY: f32 = 12.5;
/// What an empty battery recovers to without load, and what a charged one has.
const RESTED: f32 = 14.0;
const CHARGED: f32 = 16.0;

#[test]
fn a_monitor_that_is_connected_late_does_not_keep_the_vehicle_from_arming() {
    let mut bench = Bench::new(State::Disarmed);
    bench.run(10.0, &volts(0.3, &standing()));
    assert_eq!(bench.step(&volts(0.3, &standing())).armable, Err(Refusal::Battery));
    bench.run(0.1, &volts(CHARGED, &standing()));
    assert_eq!(bench.step(&volts(CHARGED, &standing())).armable, Ok(()));
    assert_eq!(bench.ask(TAKE_OFF, &volts(CHARGED, &standing())), Outcome::Accepted);
}

/// Landed by a critical battery, and disarmed.
fn landed() -> Bench {
    let mut bench = Bench::new(State::Hold);
    assert_eq!(bench.run(3.0, &volts(EMPTY, &hovering())), [Event::BatteryCritical]);
    bench.run(1.0, &volts(EMPTY, &CommanderInput { thrust_n: 0.0, ..hovering() }));
    bench.run(1.5, &volts(RESTED, &standing()));
    assert_eq!(bench.commander.state, State::Disarmed);
    bench
}

#[test]
fn an_empty_battery_stays_empty_when_its_voltage_recovers_without_load() {
    let mut bench = landed();
    bench.run(60.0, &volts(RESTED, &standing()));
    assert_eq!(bench.step(&volts(RESTED, &standing())).armable, Err(Refusal::Battery));
    bench.run(1.0, &volts(CHARGED, &standing()));
    assert_eq!(bench.step(&volts(CHARGED, &standing())).armable, Err(Refusal::Battery), "a moment proves nothing");
    bench.run(10.0, &standing());
    assert_eq!(bench.step(&standing()).armable, Err(Refusal::Battery), "nor does a silent monitor");
}

#[test]
fn a_battery_that_has_been_replaced_is_a_new_one() {
    let mut bench = landed();
    bench.run(3.0, &volts(0.0, &standing()));
    bench.run(2.1, &volts(CHARGED, &standing()));
    assert_eq!(bench.ask(ARM, &volts(CHARGED, &standing())), Outcome::Accepted);
    assert_eq!(bench.ask(TAKE_OFF, &volts(CHARGED, &standing())), Outcome::Accepted);
}

#[test]
fn a_low_battery_stays_low_when_its_voltage_recovers_without_load() {
    let mut bench = Bench::new(State::Idle { disarm_at: None });
    bench.run(2.1, &volts(13.5, &standing()));
    assert_eq!(bench.ask(Request::Disarm, &volts(13.5, &standing())), Outcome::Accepted);
    // Low is 14 V under load, and 9 % more at rest.
    let rested = volts(15.2, &standing());
    bench.run(60.0, &rested);
    assert_eq!(bench.ask(TAKE_OFF, &rested), Outcome::TemporarilyRejected(Refusal::Battery));
    bench.run(2.1, &volts(CHARGED, &standing()));
    assert_eq!(bench.ask(TAKE_OFF, &volts(CHARGED, &standing())), Outcome::Accepted, "another one");
}

#[test]
fn a_level_that_was_reached_holds_while_armed() {
    let mut bench = Bench::new(State::Idle { disarm_at: None });
    bench.run(2.1, &volts(13.5, &standing()));
    bench.run(10.0, &volts(CHARGED, &standing()));
    let refused = Outcome::TemporarilyRejected(Refusal::Battery);
    assert_eq!(bench.ask(TAKE_OFF, &volts(CHARGED, &standing())), refused);
}
