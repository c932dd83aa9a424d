//! The state machine against its diagram.

use std::collections::BTreeSet;

use super::*;
use crate::guidance::stream::Motion;
use crate::latest::{SetPoint, Stamped, Sticks};

/// Every state, none of them about to time out.
fn states() -> Vec<State> {
    let velocity = Vector3::new(1.0, 0.0, 0.0);
    vec![
        State::Disarmed,
        State::Idle { disarm_at: None },
        State::TakeOff { from_m: 0.0, to_m: 100.0 },
        State::Hold,
        State::GoTo(course(velocity.into(), 0.0)),
        State::Approach(course(velocity.into(), 0.0)),
        State::Manual(ManualMode::Position),
        State::Offboard,
        State::Orbit(Orbit { center: velocity, radius_m: 9.0, speed_m_s: 2.0, heading: OrbitHeading::Center }),
        State::Velocity { velocity, yaw_rate: 0.0 },
        State::Join,
        State::Follow { since: 0 },
        State::Return { at_m: 100.0, climbs: true },
        State::Land,
        State::Descent,
        State::MotorOut,
    ]
}

/// The state, by the failure that overrides the pilot.
fn situation(commander: &Commander) -> String {
    let state = name(&commander.state);
    commander.overridden.map_or(state.clone(), |failure| {
        let failure = format!("{failure:?}");
        format!("{state} by {}", failure.split([' ', '{', '(']).next().expect("a name"))
    })
}

/// The transitions out of a state, by cause.
fn outcomes(state: State) -> Vec<(&'static str, String)> {
    let flies = !matches!(state, State::Disarmed | State::Idle { .. });
    let mut quiet = if flies { hovering() } else { standing() };
    if let State::Manual(_) = state {
        quiet.latest.sticks = Some(Stamped { value: Sticks::CENTRED, at: 0 });
    }
    if state == State::Offboard {
        quiet.latest.setpoint = Some(streamed(30.0));
    }
    let end = |run: &dyn Fn(&mut Bench)| {
        let mut bench = Bench::new(state);
        run(&mut bench);
        situation(&bench.commander)
    };
    let ask = |request: Request| end(&|bench| drop(bench.step(&asking(request, &quiet))));
    let last = |seconds: f32, input: CommanderInput| end(&|bench| drop(bench.run(seconds, &input)));
    let lost = NavHealth { position: false, ..NavHealth::ALL };
    vec![
        ("arm", ask(ARM)),
        ("arm to take off", armed_to(state, TAKE_OFF)),
        ("arm to follow", armed_to(state, Request::Follow)),
        ("disarm", ask(Request::Disarm)),
        ("kill", last(0.1, CommanderInput { kills: 1, ..quiet.clone() })),
        ("take off", ask(TAKE_OFF)),
        ("hold", ask(Request::Hold)),
        ("by hand", by_hand(state, &quiet)),
        ("stick moved", stick_moved(state, &quiet)),
        ("stick up", stick_up(state)),
        ("go to", ask(GO_TO)),
        ("orbit", ask(Request::Orbit(ORBIT))),
        ("velocity", ask(VELOCITY)),
        ("land", ask(Request::Land)),
        ("land there", ask(LAND_AT)),
        ("return", ask(Request::Return)),
        ("follow", ask(Request::Follow)),
        ("loss", last(1.1, CommanderInput { health: lost, ..quiet.clone() })),
        ("gone", last(2.1, CommanderInput { nav_fresh: false, ..quiet.clone() })),
        ("rotor failed", last(0.1, CommanderInput { failed_rotor: Some(1), ..quiet.clone() })),
        ("hung", last(0.1, CommanderInput { outer_hung: true, ..quiet.clone() })),
        ("battery low", last(2.1, volts(13.5, &quiet))),
        ("battery critical", last(2.1, volts(12.5, &quiet))),
        ("station lost: hold", end(&|bench| station::is_lost(bench, StationAction::Hold, &quiet))),
        ("station lost: return", end(&|bench| station::is_lost(bench, StationAction::Return, &quiet))),
        ("station lost: land", end(&|bench| station::is_lost(bench, StationAction::Land, &quiet))),
        ("set-points lost", if state == State::Offboard { silenced(state, &quiet) } else { name(&state) }),
        ("offboard", offboard(state, &quiet)),
        ("set-point up", setpoint_up(state)),
        ("sticks lost", if let State::Manual(_) = state { silenced(state, &quiet) } else { name(&state) }),
        ("touchdown", touched_down(state, &quiet)),
        ("stick down", if let State::Manual(_) = state { touched_down(state, &quiet) } else { name(&state) }),
        ("rested", rested(state)),
        ("arrived", arrived(state)),
        ("timeout", timed_out(state)),
    ]
}

/// Asked for, with sticks.
fn by_hand(state: State, quiet: &CommanderInput) -> String {
    let mut input = quiet.clone();
    input.latest.sticks = Some(Stamped { value: Sticks::CENTRED, at: 0 });
    let mut bench = Bench::new(state);
    bench.ask(Request::Manual(ManualMode::Altitude), &input);
    situation(&bench.commander)
}

/// A set-point at a height, m.
fn streamed(height_m: f32) -> Stamped<SetPoint> {
    let motion = Motion::default().with_position([Some(50.0), Some(60.0), Some(height_m)]);
    Stamped { value: SetPoint::Motion { motion, sent_ms: None }, at: 0 }
}

/// Without sticks and set-points.
fn silenced(state: State, quiet: &CommanderInput) -> String {
    let mut bench = Bench::new(state);
    bench.run(0.1, &CommanderInput { latest: Latest::default(), ..quiet.clone() });
    situation(&bench.commander)
}

/// Asked for, with a stream.
fn offboard(state: State, quiet: &CommanderInput) -> String {
    let mut input = quiet.clone();
    input.latest.setpoint = Some(streamed(quiet.nav.position.z));
    let mut bench = Bench::new(state);
    bench.ask(Request::Offboard, &input);
    name(&bench.commander.state)
}

/// On the ground in offboard mode, with a set-point above.
fn setpoint_up(state: State) -> String {
    let State::Idle { .. } = state else { return name(&state) };
    let mut bench = Bench::new(state);
    bench.commander.intent = Intent::Offboard;
    let mut input = standing();
    input.latest.setpoint = Some(streamed(3.0));
    bench.run(0.1, &input);
    situation(&bench.commander)
}

/// Flying by itself, a stick to its end after a while.
fn stick_moved(state: State, quiet: &CommanderInput) -> String {
    let mut input = quiet.clone();
    input.latest.sticks = Some(Stamped { value: Sticks::CENTRED, at: 0 });
    let mut bench = Bench::new(state);
    bench.commander.hand.set(crate::settings::COM_RC_OVERRIDE, Value::Int(3));
    bench.run(0.1, &input);
    input.latest.sticks = Some(Stamped { value: Sticks { roll: 0.5, ..Sticks::CENTRED }, at: 0 });
    bench.run(0.1, &input);
    situation(&bench.commander)
}

/// On the ground in a manual mode, the throttle stick up.
fn stick_up(state: State) -> String {
    let State::Idle { .. } = state else { return name(&state) };
    let mut bench = Bench::new(state);
    bench.commander.intent = Intent::Manual(ManualMode::Stabilized);
    let mut input = standing();
    input.latest.sticks = Some(Stamped { value: Sticks { throttle: 0.6, ..Sticks::CENTRED }, at: 0 });
    bench.run(0.1, &input);
    situation(&bench.commander)
}

/// On the ground with little thrust, in a manual mode with the throttle stick down.
fn touched_down(state: State, quiet: &CommanderInput) -> String {
    let mut input = CommanderInput { thrust_n: 0.0, ..quiet.clone() };
    if let Some(sticks) = &mut input.latest.sticks {
        sticks.value.throttle = 0.0;
    }
    if input.latest.setpoint.is_some() {
        input.latest.setpoint = Some(streamed(-1.0));
    }
    let mut bench = Bench::new(state);
    bench.run(0.6, &input);
    situation(&bench.commander)
}

/// Disarmed, and armed a second after a request.
fn armed_to(state: State, request: Request) -> String {
    if state != State::Disarmed {
        return name(&state);
    }
    let mut bench = Bench::new(state);
    bench.ask(request, &standing());
    bench.run(1.0, &standing());
    bench.ask(ARM, &standing());
    situation(&bench.commander)
}

fn rested(state: State) -> String {
    let State::Idle { .. } = state else { return name(&state) };
    let mut bench = Bench::new(State::Idle { disarm_at: Some(1_100) });
    bench.run(0.2, &standing());
    situation(&bench.commander)
}

fn arrived(state: State) -> String {
    let at = |state: State, position: Vector3<f32>| {
        let mut bench = Bench::new(state);
        let mut input = hovering();
        input.nav.position = position;
        bench.step(&input);
        situation(&bench.commander)
    };
    match state {
        State::TakeOff { .. } => at(state, Vector3::new(0.0, 0.0, 99.8)),
        State::Join => at(state, Bench::new(state).commander.entry),
        State::Approach(_) => at(state, Vector3::new(1.2, 0.0, 30.0)),
        State::Return { .. } => at(State::Return { at_m: 10.0, climbs: false }, Vector3::new(0.2, 0.0, 10.0)),
        _ => name(&state),
    }
}

fn timed_out(state: State) -> String {
    let mut bench = Bench::new(state);
    if name(&state) == "Velocity" {
        bench.commander.until = Some(1_100);
        bench.run(0.2, &hovering());
    }
    name(&bench.commander.state)
}

/// The diagram's rows as (state, cause, state).
fn diagram() -> BTreeSet<(String, String, String)> {
    let rows: Vec<&str> = include_str!("../state.rs").lines().filter_map(|line| line.strip_prefix("//! ")).collect();
    let group = rows.iter().find_map(|row| row.strip_prefix("Cruise = ")).expect("a group");
    let mut transitions = BTreeSet::new();
    for row in rows.iter().filter(|row| row.contains('►')) {
        let (states, rest) = row.split_once('─').expect("an arrow");
        let (causes, to) = rest.split_once('►').expect("a head");
        let states = states.replace("Cruise", group);
        for from in states.split(',').map(str::trim) {
            for cause in causes.split([',', '─']).map(str::trim).filter(|cause| !cause.is_empty()) {
                transitions.insert((from.to_string(), cause.to_string(), to.trim().to_string()));
            }
        }
    }
    transitions
}

#[test]
fn the_diagram_shows_the_transitions_of_the_code() {
    let mut found = BTreeSet::new();
    for state in states() {
        for (cause, end) in outcomes(state) {
            found.insert((name(&state), cause.to_string(), end));
        }
    }
    let leaves = |(from, _, to): &(String, String, String)| to.split(" by ").next() != Some(from);
    found.retain(leaves);
    let mut drawn = diagram();
    drawn.retain(leaves);
    let missing: Vec<_> = drawn.difference(&found).collect();
    let extra: Vec<_> = found.difference(&drawn).collect();
    assert!(missing.is_empty() && extra.is_empty(), "only in the diagram: {missing:?}\nonly in the code: {extra:?}");
}
