//! What the pilot wants: kept on the ground and under failures, shown, and not begun twice.

use super::*;

fn ask_shown(bench: &mut Bench, request: Request, input: &CommanderInput) -> (Outcome, Mode) {
    let output = bench.step(&asking(request, input));
    (output.replies[0].outcome, output.shown)
}

#[test]
fn a_mode_that_is_set_on_the_ground_is_shown_and_starts_nothing() {
    for mut bench in [Bench::new(State::Disarmed), Bench::new(State::Idle { disarm_at: None })] {
        let before = bench.commander.state;
        assert_eq!(bench.step(&standing()).shown, Mode::Hold, "unset");
        assert_eq!(ask_shown(&mut bench, Request::Hold, &standing()), (Outcome::Accepted, Mode::Hold));
        assert_eq!(bench.commander.state, before);
    }
    let mut bench = Bench::new(State::Disarmed);
    assert_eq!(ask_shown(&mut bench, Request::Land, &standing()), (Outcome::Accepted, Mode::Land));
    let output = bench.step(&asking(ARM, &standing()));
    assert_eq!((output.mode, output.shown), (Mode::Idle, Mode::Hold), "there is nothing to land");
    bench.run(5.0, &standing());
    assert_eq!(bench.commander.state, State::Idle { disarm_at: None });
}

#[test]
fn a_take_off_asked_for_while_disarmed_is_flown_when_armed() {
    for (request, mode) in [(TAKE_OFF, Mode::TakeOff), (Request::Follow, Mode::Follow)] {
        let mut bench = Bench::new(State::Disarmed);
        assert_eq!(ask_shown(&mut bench, request, &standing()), (Outcome::Accepted, mode));
        let output = bench.step(&standing());
        assert_eq!((output.armed, output.directive), (false, Directive::Stop));
        bench.run(3.0, &standing());
        bench.ask(ARM, &standing());
        assert_eq!(bench.step(&standing()).mode, mode);
    }
}

#[test]
fn a_flight_asked_for_in_the_job_of_a_kill_is_refused_and_the_next_arming_does_not_begin_it() {
    for request in [TAKE_OFF, Request::Follow, Request::Hold, Request::Land, Request::Return, GO_TO, VELOCITY, ARM] {
        for state in [State::Disarmed, State::Idle { disarm_at: None }] {
            let mut bench = Bench::new(state);
            let killed = CommanderInput { kills: 1, ..standing() };
            let outcome = bench.ask(request, &killed);
            assert!(matches!(outcome, Outcome::TemporarilyRejected(_)), "{request:?}: {outcome:?}");
            assert_eq!(bench.commander.intent, Intent::Hold);
            // What waited on another link comes later.
            assert_eq!(bench.ask(ARM, &killed), Outcome::TemporarilyRejected(Refusal::Killed));
            assert_eq!(bench.ask(TAKE_OFF, &killed), Outcome::TemporarilyRejected(Refusal::Killed));
            bench.run(1.0, &killed);
            assert_eq!(bench.ask(ARM, &killed), Outcome::Accepted);
            bench.run(5.0, &killed);
            assert_eq!(bench.commander.state, State::Idle { disarm_at: None }, "{request:?}");
        }
    }
}

#[test]
fn a_later_arming_does_not_launch_the_vehicle() {
    type Meanwhile = fn(&mut Bench);
    let disarmed: Meanwhile = |bench| assert_eq!(bench.ask(Request::Disarm, &standing()), Outcome::Accepted);
    let killed: Meanwhile = |bench| drop(bench.run(1.0, &CommanderInput { kills: 1, ..standing() }));
    let held: Meanwhile = |bench| assert_eq!(bench.ask(Request::Hold, &standing()), Outcome::Accepted);
    let expired: Meanwhile = |bench| drop(bench.run(5.1, &standing()));
    for (meanwhile, kills) in [(disarmed, 0), (killed, 1), (held, 0), (expired, 0)] {
        let mut bench = Bench::new(State::Disarmed);
        bench.ask(TAKE_OFF, &standing());
        meanwhile(&mut bench);
        let after = CommanderInput { kills, ..standing() };
        assert_eq!(bench.step(&after).shown, Mode::Hold);
        assert_eq!(bench.ask(ARM, &after), Outcome::Accepted);
        bench.run(5.0, &after);
        assert_eq!(bench.commander.state, State::Idle { disarm_at: None });
    }
    // Nor does the intent of a flight that is over.
    let mut bench = Bench::new(State::Idle { disarm_at: None });
    bench.ask(TAKE_OFF, &standing());
    bench.ask(Request::Disarm, &standing());
    bench.ask(ARM, &standing());
    bench.run(5.0, &standing());
    assert_eq!(bench.commander.state, State::Idle { disarm_at: None });
}

#[test]
fn a_take_off_that_has_become_impossible_is_not_armed_for_and_not_forced() {
    let low = volts(13.5, &standing());
    let mut bench = Bench::new(State::Disarmed);
    bench.ask(TAKE_OFF, &standing());
    bench.run(2.1, &low);
    assert_eq!(bench.ask(ARM, &low), Outcome::TemporarilyRejected(Refusal::Battery));
    assert_eq!(bench.ask(Request::Arm { force: true }, &low), Outcome::Accepted);
    assert_eq!(bench.commander.state, State::Idle { disarm_at: None });
    let mut bench = Bench::new(State::Disarmed);
    bench.run(2.1, &low);
    assert_eq!(bench.ask(TAKE_OFF, &low), Outcome::TemporarilyRejected(Refusal::Battery));
}

#[test]
fn another_height_is_flown_while_taking_off() {
    let mut bench = Bench::new(State::Idle { disarm_at: None });
    bench.ask(Request::TakeOff { height_m: 3.0 }, &standing());
    let at = |z: f32| {
        let mut input = standing();
        input.nav.position.z = z;
        input
    };
    assert_eq!(bench.ask(Request::TakeOff { height_m: 8.0 }, &at(2.0)), Outcome::Accepted);
    let climb = |height_m: f32| Directive::Climb { height_m, speed_m_s: settings().take_off_m_s, yaw: None };
    assert_eq!(bench.step(&at(3.0)).directive, climb(8.0), "over the ground, not over the present height");
    assert_eq!(bench.ask(Request::TakeOff { height_m: 4.0 }, &at(6.0)), Outcome::Accepted);
    assert_eq!(bench.step(&at(5.5)).directive, climb(4.0), "down again");
    assert_eq!(bench.step(&at(4.2)).mode, Mode::Hold);
    assert_eq!(bench.ask(Request::TakeOff { height_m: 8.0 }, &at(4.2)), Outcome::TemporarilyRejected(Refusal::InAir));
}

#[test]
fn what_is_already_being_done_is_not_begun_again() {
    for (state, request) in [
        (State::TakeOff { from_m: 0.0, to_m: 100.0 }, Request::TakeOff { height_m: 100.0 }),
        (State::Hold, Request::Hold),
        (State::Join, Request::Follow),
        (State::Follow { since: 7 }, Request::Follow),
        (State::Return { at_m: 100.0, climbs: true }, Request::Return),
        (State::Return { at_m: 10.0, climbs: false }, Request::Return),
        (State::Land, Request::Land),
        (State::GoTo(course([1.0, 2.0, 3.0], 0.5)), GO_TO),
    ] {
        let mut bench = Bench::new(state);
        let before = bench.step(&hovering());
        // The height would be another one for a new return.
        let mut higher = hovering();
        higher.nav.position.z = 50.0;
        let after = bench.step(&asking(request, &higher));
        assert_eq!(after.replies[0].outcome, Outcome::Accepted, "{state:?}");
        assert_eq!((after.directive, bench.commander.state), (before.directive, state));
    }
}

#[test]
fn a_return_that_lands_goes_on_landing_whatever_is_repeated() {
    let mut low = hovering();
    low.nav.position = Vector3::new(0.1, 0.0, 1.0);
    for failure in [None, Some(Override::BatteryLow)] {
        for request in [Request::Return, Request::Land, Request::Land] {
            let mut bench = Bench::new(State::Land);
            (bench.commander.intent, bench.commander.overridden) = (Intent::Return, failure);
            let before = bench.step(&low).directive;
            assert_eq!(bench.ask(request, &low), Outcome::Accepted);
            assert_eq!(bench.step(&low).directive, before, "{request:?}");
            assert_eq!((bench.commander.state, bench.commander.overridden), (State::Land, None));
        }
    }
}

#[test]
fn a_take_off_that_has_arrived_may_be_repeated() {
    let mut bench = Bench::new(State::TakeOff { from_m: 0.0, to_m: 30.0 });
    assert_eq!(bench.step(&hovering()).mode, Mode::Hold);
    assert_eq!(bench.ask(Request::TakeOff { height_m: 30.0 }, &hovering()), Outcome::Accepted);
    assert_eq!(bench.commander.state, State::Hold);
}

#[test]
fn landing_on_the_ground_disarms_in_every_state() {
    let land = |bench: &mut Bench| {
        assert_eq!(bench.ask(Request::Land, &standing()), Outcome::Accepted);
        bench.run(1.2, &standing());
        assert_eq!(bench.commander.state, State::Disarmed);
    };
    land(&mut Bench::new(State::Disarmed));
    land(&mut Bench::new(State::Idle { disarm_at: None }));
    let mut armed = Bench::new(State::Disarmed);
    armed.ask(ARM, &standing());
    land(&mut armed);
    // A take-off, and a trajectory, that have not lifted yet.
    for request in [TAKE_OFF, Request::Follow] {
        let mut bench = Bench::new(State::Idle { disarm_at: None });
        bench.ask(request, &standing());
        land(&mut bench);
    }
    let mut together = Bench::new(State::Disarmed);
    let mut input = asking(ARM, &standing());
    let _ = input.commands.push(Command { request: Request::Land, origin: Origin::OnBoard });
    together.step(&input);
    land(&mut together);
}

#[test]
fn an_intent_outlasts_the_failure_that_overrides_it_and_only_the_pilot_resumes_it() {
    let mut bench = Bench::new(State::GoTo(course([1.0, 2.0, 3.0], 0.5)));
    let goes = bench.commander.intent;
    bench.run(3.0, &volts(13.5, &hovering()));
    let output = bench.step(&hovering());
    assert_eq!((output.mode, output.shown, output.intent), (Mode::Return, Mode::Return, goes));
    assert_eq!(output.overridden, Some(Override::BatteryLow));
    bench.run(5.0, &hovering());
    assert_eq!(bench.step(&hovering()).mode, Mode::Return);
    assert_eq!(bench.ask(GO_TO, &hovering()), Outcome::Accepted);
    let output = bench.step(&hovering());
    assert_eq!((output.mode, output.overridden), (Mode::GoTo, None));
}

#[test]
fn a_landing_ends_what_was_wanted() {
    let mut bench = Bench::new(State::Land);
    bench.run(1.0, &CommanderInput { thrust_n: 0.0, ..hovering() });
    let output = bench.step(&standing());
    assert_eq!((output.mode, output.shown, output.intent), (Mode::Idle, Mode::Hold, Intent::Hold));
}

#[test]
fn without_guidance_it_comes_down_and_nothing_else_is_accepted() {
    let hung = CommanderInput { outer_hung: true, ..hovering() };
    let mut bench = Bench::new(State::Hold);
    assert_eq!(bench.run(1.0, &hung), [], "the inner loop reports it");
    let refused = Outcome::TemporarilyRejected(Refusal::NoGuidance);
    for request in [Request::Hold, GO_TO, VELOCITY, Request::Return, Request::Follow] {
        assert_eq!(bench.ask(request, &hung), refused);
    }
    assert_eq!(bench.ask(Request::Land, &hung), Outcome::Accepted);
    assert_eq!(bench.step(&hung).mode, Mode::Descent);
    assert_eq!(bench.ask(Request::Hold, &hovering()), Outcome::Accepted, "it runs again");
    // At rest with the thrust of a blind descent, it has landed.
    let mut bench = Bench::new(State::Hold);
    let weight = FlightConfig::default().airframe.weight_n();
    bench.run(3.5, &CommanderInput { thrust_n: 0.93 * weight, ..hung });
    assert_eq!(bench.commander.state, State::Disarmed);
    let grounded = CommanderInput { outer_hung: true, ..standing() };
    assert_eq!(Bench::new(State::Disarmed).ask(ARM, &grounded), refused);
}
