//! The state machine against its diagram; refusals and failsafes.

mod any;
mod battery;
mod diagram;
mod intents;
mod orders;
mod station;
mod stream;

use nalgebra::{UnitQuaternion, Vector3};

use super::*;
use crate::guidance::setpoint::Speeds;

const PERIOD: Tick = COMMANDER.period;

/// Hovering 30 m above the ground, away from home.
fn hovering() -> CommanderInput {
    let nav = NavState { position: Vector3::new(50.0, 60.0, 30.0), ..NavState::at_rest() };
    CommanderInput { nav, thrust_n: FlightConfig::default().airframe.weight_n(), ..standing() }
}

pub(super) fn standing() -> CommanderInput {
    CommanderInput {
        nav: NavState::at_rest(),
        nav_fresh: true,
        health: NavHealth::ALL,
        thrust_n: 0.0,
        battery: None,
        failed_rotor: None,
        outer_hung: false,
        kills: 0,
        terminated: false,
        latest: Latest::default(),
        commands: Commands::new(),
        changes: Changes::new(),
    }
}

fn asking(request: Request, input: &CommanderInput) -> CommanderInput {
    let commands = [Command { request, origin: Origin::OnBoard }].into_iter().collect();
    CommanderInput { commands, ..input.clone() }
}

fn settings() -> ModeSettings {
    ModeSettings { battery_low_v: 14.0, battery_critical_v: 13.0, ..ModeSettings::default() }
}

fn volts(voltage_v: f32, input: &CommanderInput) -> CommanderInput {
    CommanderInput { battery: Some(BatterySample { voltage_v, current_a: 10.0 }), ..input.clone() }
}

/// A commander in a state, airborne if it is a flying state, and its clock.
struct Bench {
    commander: Commander,
    tick: Tick,
}

impl Bench {
    fn new(state: State) -> Self {
        let mut commander = Commander::new(&FlightConfig { modes: settings(), ..FlightConfig::default() });
        let flies = !matches!(state, State::Disarmed | State::Idle { .. });
        commander.state = state;
        (commander.intent, commander.overridden) = wanted(&state);
        commander.ground = GroundWatch::new(flies, 0.0);
        // The time on the ground is the subject of tests of its own.
        (commander.unused_s, commander.landed_s) = (0.0, 1.0);
        Self { commander, tick: 1_000 }
    }

    /// Sticks and set-points, if there are any, are as new as can be.
    fn step(&mut self, input: &CommanderInput) -> CommanderOutput {
        let mut input = input.clone();
        if let Some(sticks) = &mut input.latest.sticks {
            sticks.at = self.tick;
        }
        if let Some(setpoint) = &mut input.latest.setpoint {
            setpoint.at = self.tick;
        }
        let output = self.commander.step(self.tick, &input);
        self.tick += PERIOD;
        output
    }

    fn run(&mut self, seconds: f32, input: &CommanderInput) -> Vec<Event> {
        (0..watch::jobs(seconds)).filter_map(|_| self.step(input).event).collect()
    }

    fn ask(&mut self, request: Request, input: &CommanderInput) -> Outcome {
        self.step(&asking(request, input)).replies[0].outcome
    }
}

/// What the pilot wants in a state, and the failure that overrides it.
fn wanted(state: &State) -> (Intent, Option<Override>) {
    match *state {
        State::Disarmed | State::Idle { .. } | State::Hold => (Intent::Hold, None),
        State::TakeOff { from_m, to_m } => (Intent::TakeOff { height_m: to_m - from_m }, None),
        State::Manual(mode) => (Intent::Manual(mode), None),
        State::Offboard => (Intent::Offboard, None),
        State::Orbit(orbit) => (Intent::Orbit(OrbitGoal { radius_m: Some(orbit.radius_m), ..ORBIT }), None),
        State::GoTo(course) => (Intent::GoTo(goal(&course)), None),
        State::Approach(course) => (Intent::LandAt(goal(&course)), None),
        State::Velocity { velocity, yaw_rate } => (Intent::Velocity { velocity, yaw_rate }, None),
        State::Join | State::Follow { .. } => (Intent::Follow, None),
        State::Return { .. } => (Intent::Return, None),
        State::Land => (Intent::Land, None),
        State::Descent => (Intent::Hold, Some(Override::Loss { known: Known::Position })),
        State::MotorOut => (Intent::Hold, Some(Override::RotorFailed)),
    }
}

fn goal(course: &Course) -> Goal {
    Goal { place_m: course.place_m, height_m: Some(course.height_m), yaw_rad: course.yaw, speed_m_s: None }
}

/// The course to a place, m, and a heading, rad.
fn course([x, y, z]: [f32; 3], yaw: f32) -> Course {
    Course { place_m: Some([x, y]), height_m: z, yaw: Some(yaw), speed_m_s: None }
}

fn name(state: &State) -> String {
    let text = format!("{state:?}");
    text.split([' ', '{', '(']).next().expect("a name").to_string()
}

const ARM: Request = Request::Arm { force: false };
const GO_TO: Request = Request::GoTo(Goal::at([1.0, 2.0, 3.0], 0.5));
const LAND_AT: Request =
    Request::LandAt(Goal { place_m: Some([4.0, 5.0]), height_m: None, yaw_rad: Some(0.5), speed_m_s: None });
const VELOCITY: Request = Request::Velocity { velocity_m_s: [1.0, 0.0, 0.0], yaw_rate_rad_s: 0.1 };
const ORBIT: OrbitGoal =
    OrbitGoal { center_m: None, height_m: None, radius_m: Some(20.0), speed_m_s: None, heading: OrbitHeading::Center };
const TAKE_OFF: Request = Request::TakeOff { height_m: 2.0 };

#[test]
fn arming_is_refused_with_the_reason_and_lets_the_rotors_idle() {
    let spoil = |f: &dyn Fn(&mut CommanderInput)| {
        let mut input = standing();
        f(&mut input);
        input
    };
    for (input, refusal) in [
        (spoil(&|i| i.nav_fresh = false), Refusal::NoNavigation),
        (spoil(&|i| i.health.attitude = false), Refusal::NotAligned),
        (spoil(&|i| i.health.heading = false), Refusal::NoHeading),
        (spoil(&|i| i.health.position = false), Refusal::NoPosition),
        (spoil(&|i| i.health.velocity = false), Refusal::NoPosition),
        (spoil(&|i| i.health.height = false), Refusal::NoHeight),
        (spoil(&|i| i.nav.attitude = UnitQuaternion::from_euler_angles(0.4, 0.0, 0.0)), Refusal::NotLevel),
        (spoil(&|i| i.nav.velocity.x = 0.6), Refusal::Moving),
        (spoil(&|i| i.failed_rotor = Some(0)), Refusal::RotorFailed),
    ] {
        let mut bench = Bench::new(State::Disarmed);
        let arm = Request::Arm { force: false };
        assert_eq!(bench.ask(arm, &input), Outcome::TemporarilyRejected(refusal));
        assert_eq!(bench.step(&input).armable, Err(refusal));
        assert_eq!(bench.ask(Request::Arm { force: true }, &input), Outcome::Accepted);
    }
    let mut bench = Bench::new(State::Disarmed);
    bench.run(3.0, &volts(12.0, &standing()));
    let refused = bench.ask(Request::Arm { force: false }, &volts(12.0, &standing()));
    assert_eq!(refused, Outcome::TemporarilyRejected(Refusal::Battery));

    let mut bench = Bench::new(State::Disarmed);
    let output = bench.step(&asking(Request::Arm { force: false }, &standing()));
    assert_eq!((output.armed, output.directive, output.mode), (true, Directive::Idle, Mode::Idle));
    assert!(output.landed);
}

#[test]
fn a_vehicle_that_is_told_to_land_before_it_has_flown_is_disarmed() {
    let mut idle = Bench::new(State::Idle { disarm_at: None });
    assert_eq!(idle.ask(Request::Land, &standing()), Outcome::Accepted);
    idle.run(0.5, &standing());
    assert!(matches!(idle.commander.state, State::Idle { .. }), "as after a landing, it idles for a second");
    idle.run(0.7, &standing());
    assert_eq!(idle.commander.state, State::Disarmed);
}

#[test]
fn a_request_that_the_state_does_not_allow_is_refused_with_the_reason() {
    use Outcome::TemporarilyRejected as No;
    let mut disarmed = Bench::new(State::Disarmed);
    let mut idle = Bench::new(State::Idle { disarm_at: None });
    for request in [GO_TO, VELOCITY, Request::Return] {
        assert_eq!(disarmed.ask(request, &standing()), No(Refusal::Disarmed));
        assert_eq!(idle.ask(request, &standing()), No(Refusal::OnGround));
    }
    let mut elsewhere = standing();
    elsewhere.nav.position.x = 3.0;
    assert_eq!(idle.ask(Request::Follow, &elsewhere), No(Refusal::NotAtStart));
    let lost = CommanderInput { health: NavHealth { height: false, ..NavHealth::ALL }, ..standing() };
    assert_eq!(idle.ask(TAKE_OFF, &lost), No(Refusal::NoHeight));
    idle.run(2.1, &volts(13.5, &standing()));
    assert_eq!(idle.ask(TAKE_OFF, &standing()), No(Refusal::Battery));

    let mut hold = Bench::new(State::Hold);
    assert_eq!(hold.ask(TAKE_OFF, &hovering()), No(Refusal::InAir));
    assert_eq!(hold.ask(Request::Disarm, &hovering()), No(Refusal::InAir));
    let lost = CommanderInput { health: NavHealth { position: false, ..NavHealth::ALL }, ..hovering() };
    assert_eq!(hold.ask(GO_TO, &lost), No(Refusal::NoPosition));
    let mut falling = Bench::new(State::MotorOut);
    assert_eq!(falling.ask(Request::Hold, &hovering()), No(Refusal::RotorFailed));
}

#[test]
fn parameters_out_of_range_are_denied() {
    let go = |x: f32, yaw_rad: f32| Request::GoTo(Goal::at([x, 0.0, 5.0], yaw_rad));
    let fly = |z: f32, yaw_rate_rad_s: f32| Request::Velocity { velocity_m_s: [0.0, 0.0, z], yaw_rate_rad_s };
    let climb = |height_m: f32| Request::TakeOff { height_m };
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e6, -1e6] {
        for request in [go(bad, 0.0), go(0.0, bad), fly(bad, 0.0), fly(0.0, bad), climb(bad)] {
            let mut bench = Bench::new(State::Hold);
            assert_eq!(bench.ask(request, &hovering()), Outcome::Denied, "{request:?}");
            assert_eq!(bench.commander.state, State::Hold);
        }
    }
    assert_eq!(Bench::new(State::Idle { disarm_at: None }).ask(climb(0.1), &standing()), Outcome::Denied);
}

#[test]
fn a_velocity_expires_after_a_second_unless_it_is_repeated() {
    let mut bench = Bench::new(State::Hold);
    for _ in 0..5 {
        bench.ask(VELOCITY, &hovering());
        bench.run(0.8, &hovering());
        assert_eq!(name(&bench.commander.state), "Velocity");
    }
    bench.run(0.3, &hovering());
    assert_eq!(bench.commander.state, State::Hold);
}

#[test]
fn a_loss_starts_a_descent_on_the_remaining_states_and_is_reported_once() {
    let health = |f: &dyn Fn(&mut NavHealth)| {
        let mut health = NavHealth::ALL;
        f(&mut health);
        CommanderInput { health, ..hovering() }
    };
    let stale = CommanderInput { nav_fresh: false, ..hovering() };
    for (input, known, event) in [
        (health(&|h| h.position = false), Known::Velocity, Event::PositionLost),
        (health(&|h| (h.position, h.velocity) = (false, false)), Known::Height, Event::VelocityLost),
        (health(&|h| h.height = false), Known::Climb, Event::HeightLost),
        (health(&|h| (h.height, h.climb) = (false, false)), Known::Attitude, Event::HeightLost),
        (health(&|h| h.attitude = false), Known::Attitude, Event::AttitudeLost),
        (stale, Known::Attitude, Event::SensorsLost),
    ] {
        let mut bench = Bench::new(State::Hold);
        assert_eq!(bench.run(1.5, &input), [event]);
        let Directive::Descend { known: told, heading_free: false, rate_m_s } = bench.step(&input).directive else {
            panic!("{event:?}")
        };
        // At an unknown height the ground may be anywhere.
        let unknown = known >= Known::Climb;
        let rate = if unknown { settings().touchdown_m_s } else { settings().descent_m_s };
        assert_eq!((told, rate_m_s), (known, rate));
    }
    let mut bench = Bench::new(State::Hold);
    assert_eq!(bench.run(3.0, &health(&|h| h.heading = false)), [], "goes on without a heading");
    for _ in 0..10 {
        assert_eq!(bench.run(0.9, &health(&|h| h.position = false)), [], "a short loss is bridged");
        bench.run(0.1, &hovering());
    }
    assert_eq!(bench.commander.state, State::Hold);
}

#[test]
fn a_worse_loss_is_reported_and_after_its_end_the_mode_stays_until_the_pilot_changes_it() {
    let mut bench = Bench::new(State::Follow { since: 0 });
    let position = CommanderInput { health: NavHealth { position: false, ..NavHealth::ALL }, ..hovering() };
    let mut velocity = position.clone();
    velocity.health.velocity = false;
    assert_eq!(bench.run(2.0, &position), [Event::PositionLost]);
    assert_eq!(bench.run(2.0, &velocity), [Event::VelocityLost]);
    assert_eq!(bench.run(2.0, &hovering()), []);
    assert_eq!(bench.commander.overridden, Some(Override::Loss { known: Known::Position }));
    assert_eq!((bench.commander.state, bench.commander.intent), (State::Descent, Intent::Follow), "still wanted");
    assert_eq!(bench.ask(Request::Hold, &hovering()), Outcome::Accepted);
    assert_eq!((bench.commander.state, bench.commander.overridden), (State::Hold, None));
}

#[test]
fn missing_samples_stop_the_rotors() {
    let mut bench = Bench::new(State::Hold);
    let stale = CommanderInput { nav_fresh: false, ..hovering() };
    assert_eq!(bench.run(1.9, &stale), [Event::SensorsLost]);
    assert!(bench.step(&stale).armed);
    assert_eq!(bench.run(0.2, &stale), [Event::SensorsGone]);
    assert_eq!(bench.step(&stale).directive, Directive::Stop);
}

#[test]
fn a_failed_rotor_starts_a_descent_without_yaw_control_on_the_known_states() {
    let mut bench = Bench::new(State::GoTo(course([0.0; 3], 0.0)));
    let failed = CommanderInput { failed_rotor: Some(3), ..hovering() };
    assert_eq!(bench.run(1.0, &failed), [Event::RotorFailed { rotor: 3 }]);
    let lost = CommanderInput { health: NavHealth { position: false, ..NavHealth::ALL }, ..failed };
    assert_eq!(bench.run(2.0, &lost), []);
    let output = bench.step(&lost);
    assert_eq!(output.mode, Mode::MotorOut);
    let rate_m_s = settings().descent_m_s;
    let descend = Directive::Descend { rate_m_s, known: Known::Velocity, heading_free: true };
    assert_eq!(output.directive, descend);
}

#[test]
fn a_low_battery_returns_once_and_a_critical_one_lands() {
    let mut bench = Bench::new(State::Hold);
    assert_eq!(bench.run(1.9, &volts(12.0, &hovering())), [], "a short dip is ignored");
    bench.run(0.1, &volts(15.0, &hovering()));
    assert_eq!(bench.run(3.0, &volts(13.5, &hovering())), [Event::BatteryLow]);
    assert_eq!(name(&bench.commander.state), "Return");
    bench.ask(Request::Hold, &volts(13.5, &hovering()));
    assert_eq!(bench.run(5.0, &volts(13.5, &hovering())), [], "the pilot's request stands");
    assert_eq!(bench.run(3.0, &volts(12.5, &hovering())), [Event::BatteryCritical]);
    assert_eq!(bench.commander.state, State::Land);
    let mut unwatched = Bench::new(State::Hold);
    assert_eq!(unwatched.run(5.0, &volts(f32::NAN, &hovering())), []);
}

#[test]
fn a_return_climbs_goes_home_and_lands() {
    let mut bench = Bench::new(State::Hold);
    let at = |x: f32, z: f32| {
        let mut input = hovering();
        input.nav.position = Vector3::new(x, 0.0, z);
        input
    };
    bench.ask(Request::Return, &at(20.0, 3.0));
    let directive = bench.step(&at(20.0, 5.0)).directive;
    assert_eq!(directive, Directive::Climb { height_m: 10.0, speed_m_s: settings().climb_m_s, yaw: None });
    let directive = bench.step(&at(20.0, 9.9)).directive;
    assert_eq!(
        directive,
        Directive::GoTo { position: Vector3::new(0.0, 0.0, 10.0), yaw: None, speeds: Speeds::usual(&settings()) }
    );
    let directive = bench.step(&at(0.1, 9.9)).directive;
    let rate_m_s = settings().landing_m_s;
    assert_eq!(directive, Directive::Descend { rate_m_s, known: Known::Position, heading_free: false });
    let Directive::Descend { rate_m_s, .. } = bench.step(&at(0.1, 1.9)).directive else { panic!("lands") };
    assert_eq!(rate_m_s, settings().touchdown_m_s, "slower near the ground");
}

#[test]
fn touchdown_is_detected_by_little_thrust_without_falling_and_only_in_descent() {
    let weight = FlightConfig::default().airframe.weight_n();
    let with = |thrust: f32, sink: f32| {
        let mut input = CommanderInput { thrust_n: thrust * weight, ..hovering() };
        input.nav.velocity.z = -sink;
        input
    };
    for (state, input, seconds, lands) in [
        (State::Land, with(0.5, 0.0), 0.6, true),
        (State::Land, with(0.5, 0.5), 5.0, false),
        (State::Land, with(0.9, 0.0), 2.1, true),
        (State::Land, with(0.9, 0.0), 1.5, false),
        (State::Land, with(0.9, 0.35), 5.0, false),
        (State::Land, with(1.0, 0.0), 5.0, false),
        (State::Hold, with(0.1, 0.0), 5.0, false),
        (State::MotorOut, with(0.5, 0.0), 0.6, true),
    ] {
        let mut bench = Bench::new(state);
        bench.run(seconds, &input);
        assert_eq!(matches!(bench.commander.state, State::Idle { .. }), lands, "{state:?} {input:?}");
    }
    let blind = CommanderInput { health: NavHealth::NONE, ..with(0.3, 0.0) };
    let mut bench = Bench::new(State::Hold);
    bench.run(20.0, &blind);
    assert!(matches!(bench.commander.state, State::Descent), "without a height it cannot be detected");
}

#[test]
fn disarming_is_accepted_before_lift_off_and_refused_after_it() {
    let mut bench = Bench::new(State::Idle { disarm_at: None });
    bench.ask(TAKE_OFF, &standing());
    assert!(bench.step(&standing()).landed);
    let mut lifted = standing();
    lifted.nav.position.z = 0.2;
    assert!(!bench.step(&lifted).landed);
    let disarm = Request::Disarm;
    assert_eq!(bench.ask(disarm, &lifted), Outcome::TemporarilyRejected(Refusal::InAir));

    let mut bench = Bench::new(State::Idle { disarm_at: None });
    bench.ask(TAKE_OFF, &standing());
    assert_eq!(bench.ask(disarm, &standing()), Outcome::Accepted);
    // With thrust, a constant height does not prove that the vehicle is on the ground.
    let mut bench = Bench::new(State::Idle { disarm_at: None });
    bench.ask(TAKE_OFF, &standing());
    let lifting = CommanderInput { thrust_n: FlightConfig::default().airframe.weight_n(), ..standing() };
    bench.run(0.6, &lifting);
    assert_eq!(bench.ask(disarm, &lifting), Outcome::TemporarilyRejected(Refusal::InAir));
}
