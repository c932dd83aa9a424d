//! The loss of the ground station: when it is answered, how, and how often.

use super::*;
use crate::settings::{COM_DL_LOSS_T, NAV_DLL_ACT, Value};

/// Silence after which it is lost, s.
const AFTER_S: i32 = 5;

fn number(action: StationAction) -> i32 {
    match action {
        StationAction::Hold => 1,
        StationAction::Return => 2,
        StationAction::Land => 3,
    }
}

fn set(bench: &mut Bench, index: usize, value: i32) {
    bench.commander.apply(&Change { index: index as u16, generation: 1, value: Value::Int(value) });
}

/// A commander that answers the loss of the ground station.
fn watching(state: State, action: i32) -> Bench {
    let mut bench = Bench::new(state);
    set(&mut bench, NAV_DLL_ACT, action);
    set(&mut bench, COM_DL_LOSS_T, AFTER_S);
    bench
}

/// A ground station was heard at this tick.
fn heard(at: Tick, input: &CommanderInput) -> CommanderInput {
    CommanderInput { latest: Latest { station: Some(at), ..input.latest }, ..input.clone() }
}

/// The first job after the time: by then no state that times out has done so.
pub(super) fn is_lost(bench: &mut Bench, action: StationAction, input: &CommanderInput) {
    set(bench, NAV_DLL_ACT, number(action));
    set(bench, COM_DL_LOSS_T, AFTER_S);
    bench.step(&heard(bench.tick.wrapping_sub(ticks(AFTER_S as f32) + 1), input));
}

const GOING: State =
    State::GoTo(Course { place_m: Some([500.0, 0.0]), height_m: 30.0, yaw: Some(0.0), speed_m_s: None });
const ACTIONS: [StationAction; 3] = [StationAction::Hold, StationAction::Return, StationAction::Land];

#[test]
fn it_is_lost_after_the_time_and_not_before() {
    for action in ACTIONS {
        let mut bench = watching(GOING, number(action));
        let input = heard(bench.tick, &hovering());
        assert_eq!(bench.run(5.0, &input), [], "not yet");
        assert_eq!(bench.commander.overridden, None);
        assert_eq!(bench.run(0.1, &input), [Event::StationLost { action }]);
        assert_eq!(bench.commander.overridden, Some(Override::StationLost { action }));
        assert_eq!(bench.commander.state.mode(), action.pursues().mode());
        assert_eq!(bench.commander.intent.mode(), Mode::GoTo, "what the pilot wants is kept");
    }
}

#[test]
fn without_a_station_that_was_heard_or_without_an_action_nothing_is_done() {
    for (action, station) in [(0, Some(1_000)), (2, None)] {
        let mut bench = watching(GOING, action);
        let latest = Latest { station, ..Latest::default() };
        assert_eq!(bench.run(60.0, &CommanderInput { latest, ..hovering() }), []);
        assert_eq!((bench.commander.state, bench.commander.overridden), (GOING, None));
    }
    // By default too.
    let mut bench = Bench::new(GOING);
    assert_eq!(bench.run(60.0, &heard(1_000, &hovering())), []);
}

#[test]
fn heartbeats_keep_it_and_an_action_that_is_set_in_flight_acts_at_once() {
    let mut bench = watching(GOING, 2);
    for _ in 0..20 {
        let input = heard(bench.tick, &hovering());
        assert_eq!(bench.run(4.9, &input), []);
    }
    let mut bench = watching(GOING, 0);
    let input = heard(bench.tick, &hovering());
    assert_eq!(bench.run(60.0, &input), []);
    set(&mut bench, NAV_DLL_ACT, 3);
    assert_eq!(bench.step(&input).event, Some(Event::StationLost { action: StationAction::Land }));
}

#[test]
fn a_silence_is_answered_once_so_that_a_later_request_wins_and_the_next_one_again() {
    let mut bench = watching(GOING, 2);
    let input = heard(bench.tick, &hovering());
    assert_eq!(bench.run(6.0, &input).len(), 1);
    // A program on board has the last word.
    assert_eq!(bench.ask(GO_TO, &input), Outcome::Accepted);
    assert_eq!(bench.run(60.0, &input), []);
    assert_eq!((bench.commander.state.mode(), bench.commander.overridden), (Mode::GoTo, None));
    let input = heard(bench.tick, &hovering());
    assert_eq!(bench.run(4.0, &input), [], "it is back");
    assert_eq!(bench.run(2.0, &input), [Event::StationLost { action: StationAction::Return }], "and lost again");
}

#[test]
fn a_request_for_what_the_loss_has_begun_makes_it_the_pilots() {
    let mut bench = watching(GOING, 2);
    let input = heard(bench.tick, &hovering());
    bench.run(6.0, &input);
    let before = bench.commander.state;
    assert_eq!(bench.ask(Request::Return, &input), Outcome::Accepted);
    assert_eq!((bench.commander.state, bench.commander.overridden), (before, None));
}

#[test]
fn a_vehicle_that_returns_or_comes_down_goes_on_until_somebody_ends_that() {
    for state in [State::Return { at_m: 100.0, climbs: true }, State::Land, State::Descent, State::MotorOut] {
        for action in ACTIONS {
            let mut bench = watching(state, number(action));
            let input = heard(bench.tick, &hovering());
            assert_eq!(bench.run(20.0, &input), []);
            assert_eq!(name(&bench.commander.state), name(&state));
        }
    }
    let mut bench = watching(State::Return { at_m: 100.0, climbs: true }, 3);
    let input = heard(bench.tick, &hovering());
    bench.run(20.0, &input);
    let output = bench.step(&asking(GO_TO, &input));
    assert_eq!(output.event, Some(Event::StationLost { action: StationAction::Land }), "nobody watches that");
}

#[test]
fn on_the_ground_nothing_is_answered_and_each_flight_anew() {
    let mut bench = watching(State::Disarmed, 3);
    let silent = heard(bench.tick, &standing());
    assert_eq!(bench.run(20.0, &silent), []);
    for _ in 0..2 {
        assert_eq!(bench.ask(ARM, &silent), Outcome::Accepted);
        assert_eq!(bench.run(1.0, &silent), []);
        let output = bench.step(&asking(TAKE_OFF, &silent));
        assert_eq!(output.event, Some(Event::StationLost { action: StationAction::Land }));
        bench.run(3.0, &silent);
        assert_eq!(bench.commander.state, State::Disarmed);
    }
}

#[test]
fn a_loss_of_the_position_comes_first() {
    let mut bench = watching(GOING, 2);
    let lost = CommanderInput { health: NavHealth { position: false, ..NavHealth::ALL }, ..hovering() };
    let events = bench.run(20.0, &heard(bench.tick, &lost));
    assert_eq!(events, [Event::PositionLost]);
    assert_eq!(bench.commander.state, State::Descent);
}
