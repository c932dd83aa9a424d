//! Motor test, termination, and how long an armed vehicle waits on the ground.

use super::*;
use crate::latest::{AttitudeSetPoint, SetPoint, Stamped, Sticks, Switches};

fn test(rotor: u8, part: f32, seconds: f32) -> Request {
    Request::TestMotor { test: MotorTest { rotor, part }, seconds }
}

#[test]
fn a_motor_turns_for_its_time_while_disarmed_and_is_stopped_by_arming_and_by_a_kill() {
    let mut bench = Bench::new(State::Disarmed);
    assert_eq!(bench.ask(test(2, 0.1, 1.0), &standing()), Outcome::Accepted);
    let turning = Some(MotorTest { rotor: 2, part: 0.1 });
    for _ in 0..48 {
        let output = bench.step(&standing());
        assert_eq!((output.motor_test, output.armed), (turning, false));
    }
    bench.run(0.1, &standing());
    assert_eq!(bench.step(&standing()).motor_test, None);
    let disarms = asking(Request::Disarm, &standing());
    for stop in [asking(ARM, &standing()), disarms, CommanderInput { kills: 1, ..standing() }] {
        let mut bench = Bench::new(State::Disarmed);
        bench.ask(test(0, 0.1, 5.0), &standing());
        assert_eq!(bench.step(&stop).motor_test, None);
        assert_eq!(bench.step(&CommanderInput { commands: Commands::new(), ..stop }).motor_test, None);
    }
    // What was asked for before a kill may come after it, on another link.
    let mut bench = Bench::new(State::Disarmed);
    let killed = CommanderInput { kills: 1, ..standing() };
    assert_eq!(bench.ask(test(0, 0.1, 1.0), &killed), Outcome::TemporarilyRejected(Refusal::Killed));
    bench.run(1.0, &killed);
    assert_eq!(bench.ask(test(0, 0.1, 1.0), &killed), Outcome::Accepted);
    let mut falls = Bench::new(State::Hold);
    let down = NavState { velocity: Vector3::new(0.0, 0.0, -5.0), ..hovering().nav };
    let falling = CommanderInput { kills: 1, nav: down, ..hovering() };
    falls.run(1.1, &falling);
    assert_eq!(falls.ask(test(0, 0.1, 1.0), &falling), Outcome::TemporarilyRejected(Refusal::InAir));
    let mut armed = Bench::new(State::Idle { disarm_at: None });
    assert_eq!(armed.ask(test(0, 0.1, 1.0), &standing()), Outcome::TemporarilyRejected(Refusal::Armed));
    for wrong in [test(4, 0.1, 1.0), test(0, 0.31, 1.0), test(0, f32::NAN, 1.0), test(0, 0.1, 11.0), test(0, 0.1, -1.0)]
    {
        assert_eq!(armed.ask(wrong, &standing()), Outcome::Denied);
    }
}

#[test]
fn a_terminated_vehicle_is_not_armed_not_even_by_force() {
    let mut bench = Bench::new(State::Hold);
    let ended = CommanderInput { kills: 1, terminated: true, ..hovering() };
    assert!(!bench.step(&ended).armed);
    let down = CommanderInput { kills: 1, terminated: true, ..standing() };
    bench.run(3.0, &down);
    for force in [false, true] {
        let refused = Outcome::TemporarilyRejected(Refusal::Terminated);
        assert_eq!(bench.ask(Request::Arm { force }, &down), refused);
    }
    assert_eq!(bench.step(&down).armable, Err(Refusal::Terminated));
}

#[test]
fn an_armed_vehicle_that_is_not_used_disarms_after_the_time_that_is_set() {
    for (seconds, disarms) in [(10.0, true), (3.0, true), (0.0, false), (-1.0, false)] {
        let mut bench = Bench::new(State::Disarmed);
        bench.commander.set(crate::settings::COM_DISARM_PRFLT, Value::Real(seconds));
        bench.ask(ARM, &standing());
        bench.run(math::max(seconds, 12.0) - 0.1, &standing());
        let is_armed = bench.step(&standing()).armed;
        assert_eq!(is_armed, !disarms, "{seconds} s");
    }
    let mut bench = Bench::new(State::Disarmed);
    bench.commander.set(crate::settings::COM_DISARM_PRFLT, Value::Real(3.0));
    bench.ask(ARM, &standing());
    bench.run(2.8, &standing());
    assert!(bench.step(&standing()).armed, "not before");
    // Another arming begins anew, and a take-off ends it.
    bench.ask(ARM, &standing());
    bench.run(2.8, &standing());
    assert!(bench.step(&standing()).armed);
    bench.ask(TAKE_OFF, &standing());
    bench.run(5.0, &hovering());
    assert!(bench.step(&hovering()).armed);
}

/// Standing, with a throttle.
fn with_throttle(throttle: f32) -> CommanderInput {
    with_sticks(Sticks { throttle, ..Sticks::CENTRED })
}

#[test]
fn nothing_lifts_the_vehicle_before_the_rotors_have_spun_up() {
    let spinning = || {
        let mut bench = Bench::new(State::Disarmed);
        bench.commander.set(crate::settings::COM_SPOOLUP_TIME, Value::Real(1.0));
        bench
    };
    // A take-off that is asked for meanwhile, or before, waits.
    for before in [false, true] {
        let mut bench = spinning();
        if before {
            assert_eq!(bench.ask(TAKE_OFF, &standing()), Outcome::Accepted);
        }
        bench.ask(ARM, &standing());
        if !before {
            assert_eq!(bench.ask(TAKE_OFF, &standing()), Outcome::Accepted);
        }
        bench.run(0.5, &standing());
        // As a ground station repeats what it has no answer for.
        bench.ask(ARM, &standing());
        bench.run(0.36, &standing());
        assert_eq!(bench.step(&standing()).mode, Mode::Idle);
        bench.run(0.1, &standing());
        assert_eq!(bench.step(&standing()).mode, Mode::TakeOff);
    }
    // It is told if it has become impossible, and the time without use begins when the rotors have spun up.
    let mut bench = spinning();
    bench.commander.set(crate::settings::COM_DISARM_PRFLT, Value::Real(0.5));
    bench.ask(ARM, &standing());
    bench.ask(TAKE_OFF, &standing());
    assert!(bench.run(0.9, &standing()).is_empty() && bench.step(&standing()).armed);
    let refused = bench.run(0.2, &CommanderInput { health: NavHealth::NONE, ..standing() });
    assert_eq!(refused, [Event::TakeOffRefused { refusal: Refusal::NotAligned }]);
    assert_eq!(refused[0].text(), "Takeoff refused: no valid attitude estimate");
    assert_eq!(bench.commander.intent, Intent::Hold, "it does not wait on");
    // What is asked for in its place ends it.
    let mut bench = spinning();
    bench.ask(ARM, &standing());
    bench.ask(TAKE_OFF, &standing());
    bench.ask(Request::Hold, &standing());
    bench.run(3.0, &standing());
    assert_eq!(bench.step(&standing()).mode, Mode::Idle);
    // A raised stick lifts it afterwards.
    let mut bench = spinning();
    bench.ask(Request::Manual(ManualMode::Position), &with_throttle(0.5));
    bench.ask(ARM, &with_throttle(0.5));
    bench.run(0.9, &with_throttle(1.0));
    assert_eq!(bench.step(&with_throttle(1.0)).mode, Mode::Idle);
    bench.run(0.1, &with_throttle(1.0));
    assert_eq!(bench.step(&with_throttle(1.0)).mode, Mode::Position);
    // A disarming begins anew.
    let mut bench = spinning();
    bench.ask(ARM, &standing());
    bench.run(1.5, &standing());
    bench.ask(Request::Disarm, &standing());
    bench.ask(ARM, &standing());
    bench.ask(TAKE_OFF, &standing());
    assert_eq!(bench.step(&standing()).mode, Mode::Idle);
}

/// Standing with the throttle down, and with switches.
fn switched(arm: bool, kill: bool) -> CommanderInput {
    let switches = Switches { arm: Some(arm), mode: None };
    let mut input = with_sticks(Sticks { throttle: 0.0, switches, ..Sticks::CENTRED });
    input.latest.kill_switch = kill;
    input
}

#[test]
fn an_arming_by_switch_that_is_refused_is_told_once_with_its_reason() {
    let mut bench = Bench::new(State::Disarmed);
    bench.run(0.2, &switched(false, true));
    let events = bench.run(1.0, &switched(true, true));
    assert_eq!(events, [Event::ArmingRefused { refusal: Refusal::KillSwitch }]);
    assert_eq!(events[0].text(), "Arming refused: kill switch on");
    bench.run(0.2, &switched(false, false));
    assert_eq!(bench.run(1.0, &switched(true, false)), []);
    assert!(bench.step(&switched(true, false)).armed);
}

#[test]
fn a_switch_arms_a_vehicle_that_was_just_killed_no_sooner_than_a_command() {
    let killed = |arm| CommanderInput { kills: 1, ..switched(arm, false) };
    let mut bench = Bench::new(State::Disarmed);
    bench.run(0.2, &switched(false, false));
    bench.run(0.5, &killed(false));
    assert_eq!(bench.run(0.2, &killed(true)), [Event::ArmingRefused { refusal: Refusal::Killed }]);
    assert!(!bench.step(&killed(true)).armed);
    // A second later it does.
    bench.run(0.5, &killed(false));
    assert_eq!(bench.run(0.2, &killed(true)), []);
    assert!(bench.step(&killed(true)).armed);
}

#[test]
fn an_arming_switch_that_is_on_when_it_is_first_seen_arms_only_after_it_was_off() {
    let mut bench = Bench::new(State::Disarmed);
    assert_eq!(bench.run(3.0, &switched(true, false)), []);
    assert!(!bench.step(&switched(true, false)).armed, "a radio that is turned on starts nothing");
    bench.run(0.2, &switched(false, false));
    assert!(bench.step(&switched(true, false)).armed);
}

/// Standing, with sticks.
fn with_sticks(sticks: Sticks) -> CommanderInput {
    let mut input = standing();
    input.latest.sticks = Some(Stamped { value: sticks, at: 0 });
    input
}

#[test]
fn no_motor_is_tested_with_a_kill_switch_on_or_after_a_termination() {
    let killed = CommanderInput { latest: Latest { kill_switch: true, ..Latest::default() }, ..standing() };
    let ended = CommanderInput { terminated: true, ..standing() };
    for (input, refusal) in [(killed, Refusal::KillSwitch), (ended, Refusal::Terminated)] {
        let mut bench = Bench::new(State::Disarmed);
        assert_eq!(bench.ask(test(0, 0.1, 1.0), &input), Outcome::TemporarilyRejected(refusal));
    }
}

#[test]
fn home_here_is_on_the_ground_below_a_vehicle_that_flies() {
    let mut bench = Bench::new(State::Hold);
    let here = hovering();
    assert_eq!(bench.ask(Request::SetHome { position_m: None }, &here), Outcome::Accepted);
    let below = Vector3::new(here.nav.position.x, here.nav.position.y, 0.0);
    assert_eq!(bench.step(&here).home, Some(below));
}

#[test]
fn a_speed_that_was_chosen_counts_until_the_vehicle_is_disarmed() {
    let slow = Request::Speed { kind: SpeedKind::Horizontal, speed_m_s: Some(1.0) };
    let speed = |bench: &mut Bench| {
        bench.ask(GO_TO, &hovering());
        let Directive::GoTo { speeds, .. } = bench.step(&hovering()).directive else { panic!("it goes nowhere") };
        speeds.horizontal_m_s
    };
    for disarms in [false, true] {
        let mut bench = Bench::new(State::Disarmed);
        bench.ask(ARM, &standing());
        assert_eq!(bench.ask(slow, &standing()), Outcome::Accepted);
        if disarms {
            bench.ask(Request::Disarm, &standing());
            bench.ask(ARM, &standing());
        }
        bench.ask(Request::TakeOff { height_m: 30.0 }, &standing());
        bench.run(1.0, &hovering());
        assert_eq!(speed(&mut bench), if disarms { settings().cruise_m_s } else { 1.0 });
    }
}

#[test]
fn a_heading_alone_ends_neither_a_landing_nor_a_circle_nor_what_a_failure_has_begun() {
    let turn = Request::GoTo(Goal { yaw_rad: Some(1.0), ..Goal::default() });
    let refused = Outcome::TemporarilyRejected(Refusal::NotHolding);
    let orbit = Orbit { center: Vector3::zeros(), radius_m: 5.0, speed_m_s: 1.0, heading: OrbitHeading::Kept };
    let course = Course { place_m: Some([5.0, 0.0]), height_m: 2.0, yaw: None, speed_m_s: None };
    for (state, outcome) in [
        (State::Land, refused),
        (State::Return { at_m: 5.0, climbs: false }, refused),
        (State::Orbit(orbit), refused),
        (State::Hold, Outcome::Accepted),
        (State::GoTo(course), Outcome::Accepted),
    ] {
        assert_eq!(Bench::new(state).ask(turn, &hovering()), outcome, "{state:?}");
    }
}

#[test]
fn the_arming_gesture_needs_the_other_stick_in_the_middle() {
    for (pitch, arms) in [(0.0, true), (0.1, true), (0.5, false), (-1.0, false)] {
        let mut bench = Bench::new(State::Disarmed);
        let gesture = with_sticks(Sticks { yaw: -1.0, throttle: 0.0, pitch, ..Sticks::CENTRED });
        bench.run(1.2, &gesture);
        assert_eq!(bench.step(&gesture).armed, arms, "{pitch}");
    }
}

#[test]
fn a_mode_switch_counts_when_it_is_first_seen_while_disarmed_and_in_the_air_when_it_is_moved() {
    for (state, seen) in [(State::Disarmed, Mode::Position), (State::Hold, Mode::Hold)] {
        let mut bench = Bench::new(state);
        bench.commander.set(crate::settings::COM_FLTMODE1, Value::Int(2));
        let mut input = if state == State::Hold { hovering() } else { standing() };
        let switches = Switches { mode: Some(0), ..Switches::NONE };
        input.latest.sticks = Some(Stamped { value: Sticks { switches, ..Sticks::CENTRED }, at: 0 });
        bench.run(0.2, &input);
        assert_eq!(bench.step(&input).shown, seen);
    }
}

#[test]
fn disarming_what_is_disarmed_forgets_neither_home_nor_the_speeds() {
    for again in [asking(Request::Disarm, &standing()), CommanderInput { kills: 1, ..standing() }] {
        let mut bench = Bench::new(State::Disarmed);
        let home = [3.0, 4.0, 5.0];
        bench.ask(Request::SetHome { position_m: Some(home) }, &standing());
        bench.ask(Request::Speed { kind: SpeedKind::Horizontal, speed_m_s: Some(2.0) }, &standing());
        bench.step(&again);
        let after = CommanderInput { commands: Commands::new(), ..again };
        assert_eq!(bench.step(&after).home, Some(home.into()));
        bench.run(1.0, &after);
        bench.ask(ARM, &after);
        assert_eq!(bench.step(&after).home, Some(home.into()));
        assert_eq!(bench.commander.speeds.within(&settings()).horizontal_m_s, 2.0);
    }
}

#[test]
fn a_low_take_off_has_arrived_when_it_is_at_its_height_and_off_the_ground() {
    for (height_m, arrives_m) in [(0.3, 0.21), (0.5, 0.35), (2.5, 2.2)] {
        let mut bench = Bench::new(State::Idle { disarm_at: None });
        bench.ask(Request::TakeOff { height_m }, &standing());
        let lifting = standing_with_thrust();
        let at = |z: f32| CommanderInput { nav: NavState::at_rest_at(Vector3::new(0.0, 0.0, z)), ..lifting.clone() };
        bench.run(0.2, &at(0.04));
        bench.run(0.2, &at(arrives_m - 0.02));
        assert_eq!(bench.step(&at(arrives_m - 0.02)).mode, Mode::TakeOff, "{height_m}");
        bench.step(&at(arrives_m + 0.02));
        assert_eq!(bench.step(&at(arrives_m + 0.02)).mode, Mode::Hold, "{height_m}");
    }
}

/// Standing, with as much thrust as a hovering vehicle has.
fn standing_with_thrust() -> CommanderInput {
    CommanderInput { thrust_n: hovering().thrust_n, ..standing() }
}

#[test]
fn a_kill_switch_that_is_on_is_not_armed_against_not_even_by_force() {
    let killed = CommanderInput { latest: Latest { kill_switch: true, ..Latest::default() }, ..standing() };
    for force in [false, true] {
        let mut bench = Bench::new(State::Disarmed);
        assert_eq!(bench.ask(Request::Arm { force }, &killed), Outcome::TemporarilyRejected(Refusal::KillSwitch));
    }
}

#[test]
fn rotors_that_cannot_lift_the_vehicle_are_not_armed_not_even_by_force() {
    let airframe = FlightConfig::default().airframe;
    let light = crate::airframe::Airframe { mass_kg: 1e-6, ..airframe };
    let weak = crate::airframe::Airframe { omega_max_rad_s: 1.0, ..airframe };
    for (airframe, flies) in [(airframe, true), (light, false), (weak, false)] {
        let mut bench = Bench::new(State::Disarmed);
        bench.commander = Commander::new(&FlightConfig { airframe, ..FlightConfig::default() });
        let outcome = bench.ask(Request::Arm { force: true }, &standing());
        let refused = Outcome::TemporarilyRejected(Refusal::ThrustToWeight);
        assert_eq!(outcome, if flies { Outcome::Accepted } else { refused });
    }
}

/// Attitude set-points with a thrust, standing.
fn streaming(thrust: f32) -> CommanderInput {
    let value = SetPoint::Attitude(AttitudeSetPoint { attitude: None, rates: Vector3::zeros(), thrust });
    let mut input = standing();
    input.latest.setpoint = Some(Stamped { value, at: 0 });
    input
}

#[test]
fn what_stands_with_its_rotors_above_idle_stays_on_the_ground_whatever_is_lost_or_asked_for() {
    let by_hand = |mode| (Request::Manual(mode), with_throttle(0.0), with_throttle(0.3));
    for (request, before, stands) in [
        by_hand(ManualMode::Stabilized),
        by_hand(ManualMode::Acro),
        (Request::Offboard, streaming(0.0), streaming(0.3)),
    ] {
        let begun = || {
            let mut bench = Bench::new(State::Disarmed);
            bench.ask(request, &before);
            bench.ask(ARM, &before);
            bench.run(1.0, &stands);
            assert_eq!(bench.commander.state.mode(), bench.commander.intent.mode(), "{request:?}");
            bench
        };
        // Sticks or set-points are lost.
        let mut bench = begun();
        assert_eq!(bench.run(0.5, &standing()), []);
        assert_eq!(bench.step(&standing()).mode, Mode::Idle, "{request:?}");
        // It is told to fly, or to stay.
        for (asked, outcome) in [
            (Request::Hold, Outcome::Accepted),
            (Request::Return, Outcome::TemporarilyRejected(Refusal::OnGround)),
            (GO_TO, Outcome::TemporarilyRejected(Refusal::OnGround)),
        ] {
            let mut bench = begun();
            assert_eq!(bench.ask(asked, &stands), outcome, "{request:?}");
            let after = bench.step(&stands).mode;
            assert!(if asked == Request::Hold { after == Mode::Idle } else { after != Mode::Return }, "{after:?}");
        }
        assert_eq!(begun().ask(TAKE_OFF, &stands), Outcome::Accepted);
    }
}

#[test]
fn a_lifted_stick_that_is_let_go_before_it_lifts_leaves_the_rotors_idling() {
    let mut bench = Bench::new(State::Disarmed);
    bench.ask(Request::Manual(ManualMode::Position), &with_throttle(0.5));
    bench.ask(ARM, &with_throttle(0.5));
    bench.run(0.1, &with_throttle(0.72));
    assert_eq!(bench.step(&with_throttle(0.72)).mode, Mode::Position);
    bench.run(0.1, &with_throttle(0.5));
    assert_eq!(bench.step(&with_throttle(0.5)).mode, Mode::Idle);
}

#[test]
fn a_vehicle_that_is_lighter_than_is_set_does_not_land_in_the_air() {
    for mass in [1.0, 0.85, 0.7, 0.5] {
        let mut bench = Bench::new(State::Land);
        let weight = hovering().thrust_n;
        let moving = |climb: f32, thrust: f32| {
            let velocity = Vector3::new(0.0, 0.0, climb);
            CommanderInput { nav: NavState { velocity, ..hovering().nav }, thrust_n: thrust * weight, ..hovering() }
        };
        // It has climbed here, and sinks so slowly that the estimate is at rest.
        bench.run(3.0, &moving(1.0, mass));
        bench.run(20.0, &moving(-0.05, mass));
        assert_eq!(bench.step(&moving(-0.05, mass)).mode, Mode::Land, "{mass}");
        // On the ground a tenth of its weight is taken away.
        bench.run(2.5, &moving(0.0, 0.85 * mass));
        assert_eq!(bench.step(&moving(0.0, 0.85 * mass)).mode, Mode::Idle, "{mass}");
    }
}

#[test]
fn a_circle_on_the_ground_or_below_is_come_down_to_straight_unless_there_is_no_ground() {
    let circling = |from_m: f32, height_m: f32| {
        let mut bench = Bench::new(State::Hold);
        bench.commander.home = Vector3::zeros();
        let at = CommanderInput { nav: NavState::at_rest_at(Vector3::new(0.0, 0.0, from_m)), ..hovering() };
        let goal = OrbitGoal { height_m: Some(height_m), ..ORBIT };
        assert_eq!(bench.ask(Request::Orbit(goal), &at), Outcome::Accepted);
        bench.step(&at).directive
    };
    for (from_m, height_m) in [(20.0, 0.0), (20.0, 0.2), (20.0, -30.0), (1.0, -1.0), (-10.0, -30.0)] {
        let Directive::Climb { height_m: to_m, .. } = circling(from_m, height_m) else { panic!("{from_m} {height_m}") };
        assert_eq!(to_m, height_m);
    }
    // In a valley below where it began there is none at that height.
    for (from_m, height_m) in [(20.0, 1.0), (20.0, 20.0), (-29.0, -30.0)] {
        assert!(matches!(circling(from_m, height_m), Directive::Orbit(_)), "{from_m} {height_m}");
    }
}

#[test]
fn of_another_circle_what_is_left_open_stays_as_it_is_flown() {
    let mut bench = Bench::new(State::Hold);
    let first = OrbitGoal {
        center_m: Some([60.0, 60.0]),
        height_m: Some(25.0),
        radius_m: Some(20.0),
        speed_m_s: Some(-4.0),
        heading: OrbitHeading::Along,
    };
    bench.ask(Request::Orbit(first), &hovering());
    let open = OrbitGoal { center_m: None, height_m: None, radius_m: Some(30.0), speed_m_s: None, ..first };
    bench.ask(Request::Orbit(open), &hovering());
    let State::Orbit(orbit) = bench.commander.state else { panic!("{:?}", bench.commander.state) };
    assert_eq!((orbit.center, orbit.radius_m), (Vector3::new(60.0, 60.0, 25.0), 30.0));
    assert_eq!((orbit.speed_m_s, orbit.heading), (-4.0, OrbitHeading::Along));
}
