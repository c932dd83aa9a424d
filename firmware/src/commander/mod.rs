//! The commander partition, 50 Hz: arming, modes and failsafes.
//!
//! Three things are kept apart: what the pilot wants ([`Intent`], also while disarmed), what the vehicle does
//! ([`State`]), and which failure overrides the pilot ([`Override`]). `intent` holds the first and the last, `state` the
//! states and the transition diagram, `decide` the decisions on requests, `failsafe` the responses to failures, `watch`
//! the conditions that are judged over several jobs, `checks` those for arming and take-off. The input is a list of
//! [`Request`]s, the output a [`Directive`] for guidance.
//!
//! A refused request changes nothing and returns the reason; a request for what is already being done changes nothing.
//! A kill is no request but a count of kills, which no queue can lose: the inner loop stops the rotors as soon as it is
//! ahead of the commander's (see `autopilot`).

mod checks;
mod decide;
mod directive;
mod failsafe;
mod goal;
mod home;
mod intent;
mod manual;
mod motor_test;
mod offboard;
mod orbit;
mod request;
mod spin_up;
mod state;
mod station;
mod steer;
mod text;
mod watch;

#[cfg(test)]
mod tests;

pub use decide::LAUNCH_HELD_S;
pub use directive::{Directive, Ground, Known, Mode};
pub use goal::{Goal, SpeedKind};
pub use intent::{Intent, Override};
pub use motor_test::MotorTest;
pub use orbit::{Orbit, OrbitGoal, OrbitHeading};

pub use crate::guidance::hands::ManualMode;
pub(crate) use request::TURN_MAX;
pub use request::{
    Answers, Asked, Command, Commands, Event, Events, FARTHEST_M, FASTEST_M_S, Origin, Outcome, Refusal, Replies,
    Reply, Request, StationReply, TAKE_OFF_HEIGHT_M, TAKE_OFF_HEIGHTS_M,
};
pub use state::{Course, State};
pub use station::StationAction;

use nalgebra::Vector3;

use self::checks::is_slow;
use self::goal::ChosenSpeeds;
use self::manual::Hand;
use self::offboard::Stream;
use self::station::StationLoss;
use self::watch::{BatteryWatch, Charge, GroundWatch, NavWatch};
use crate::config::{FlightConfig, ModeSettings, Start};
use crate::guidance::Guidance;
use crate::latest::Latest;
use crate::math;
use crate::schedule::COMMANDER;
use crate::sensors::BatterySample;
use crate::settings::{self, Change, Changes, Place, Settings, Value};
use crate::signals::{NavHealth, NavState, TICK_S, Tick};

/// Snapshot for the commander.
#[derive(Clone, Debug, PartialEq)]
pub struct CommanderInput {
    /// The motion at the release.
    pub nav: NavState,
    /// Whether sensor samples are arriving.
    pub nav_fresh: bool,
    /// Which components of the motion may be trusted.
    pub health: NavHealth,
    /// Estimated thrust of the rotors, N.
    pub thrust_n: f32,
    /// The last battery sample, if there is a recent one.
    pub battery: Option<BatterySample>,
    /// The rotor that has failed, from 0.
    pub failed_rotor: Option<u8>,
    /// Whether the outer partition hangs, so that no directive is executed.
    pub outer_hung: bool,
    /// Kills since boot, wrapping.
    pub kills: u32,
    /// Whether the flight was terminated: the vehicle is not armed again before it is restarted.
    pub terminated: bool,
    /// Sticks, and when a ground station was last heard.
    pub latest: Latest,
    /// Commands since the last job.
    pub commands: Commands,
    /// Settings to take over before the job.
    pub changes: Changes,
}

/// Output of the commander.
#[derive(Clone, Debug, PartialEq)]
pub struct CommanderOutput {
    /// Whether the rotors may turn.
    pub armed: bool,
    /// The kills since boot that have disarmed it.
    pub kills: u32,
    /// What the vehicle is doing.
    pub mode: Mode,
    /// The mode that ground stations show: on the ground what the pilot wants, in the air what the vehicle does.
    pub shown: Mode,
    /// What the pilot wants.
    pub intent: Intent,
    /// The failure that overrides it.
    pub overridden: Option<Override>,
    /// The directive for guidance.
    pub directive: Directive,
    /// The motor that turns though the vehicle is disarmed.
    pub motor_test: Option<MotorTest>,
    /// How near the ground is to what guidance does.
    pub ground: Ground,
    /// Whether the vehicle is on the ground.
    pub landed: bool,
    /// z of the ground where it was armed, or has landed since, m.
    pub ground_m: f32,
    /// Where a return leads, m: where the vehicle was armed or as a pilot has set it; before arming, where it stands.
    /// `None` while that is unknown.
    pub home: Option<Vector3<f32>>,
    /// Whether an arm request would be accepted, and why not.
    pub armable: Result<(), Refusal>,
    /// Answers to the commands.
    pub replies: Replies,
    /// A failsafe event to report to the pilot.
    pub event: Option<Event>,
}

impl CommanderOutput {
    /// The tick at which the flight's clock started; `None` unless the trajectory is being flown.
    pub fn flight_start(&self) -> Option<Tick> {
        match self.directive {
            Directive::Follow { since } => Some(since),
            _ => None,
        }
    }
}

/// The commander partition.
#[derive(Clone, Debug)]
pub struct Commander {
    settings: ModeSettings,
    /// Whether the vehicle was ever configured: if not, it does not arm.
    configured: bool,
    weight_n: f32,
    /// Greatest thrust, as a multiple of the weight.
    thrust_to_weight: f32,
    /// Where the trajectory is joined from the ground; then the place and heading to join it from the air.
    start: Vector3<f32>,
    entry: Vector3<f32>,
    entry_yaw: f32,
    /// What the pilot wants, until when if it expires, and the failure that overrides it.
    intent: Intent,
    until: Option<Tick>,
    overridden: Option<Override>,
    /// What the vehicle does.
    state: State,
    /// Kills since boot that it has carried out, and until when what was asked for before the last one may still arrive.
    kills: u32,
    killed_until: Option<Tick>,
    /// Where a return leads: where the vehicle was armed, unless a pilot has set another place.
    home: Vector3<f32>,
    /// Whether a pilot has set it since the vehicle was last disarmed.
    home_is_set: bool,
    /// The speeds that a pilot has set since then.
    speeds: ChosenSpeeds,
    navigation: NavWatch,
    battery: BatteryWatch,
    ground: GroundWatch,
    /// The answer to the loss of the ground station.
    station: StationLoss,
    /// The motor that turns though it is disarmed, and until when.
    motor_test: Option<(MotorTest, Tick)>,
    /// Whether the flight was terminated.
    terminated: bool,
    /// What sticks may do.
    hand: Hand,
    /// When set-points are lost, and with which thrust one of an attitude hovers.
    stream: Stream,
    hover_throttle: f32,
    /// How long it idles on the ground, s: after arming, for ever if that is not positive, and after a landing.
    unused_s: f32,
    landed_s: f32,
    /// z of where it has stood last, m; `None` if it began in flight and nothing is known of the ground.
    stood_m: Option<f32>,
    /// How long the rotors spin up after an arming, s, and until when they do.
    spin_up_s: f32,
    spins_until: Option<Tick>,
    /// The charge level whose failsafe has already acted. It acts once, so that the pilot can override it.
    battery_answered: Charge,
}

/// Ratio of the greatest thrust to the weight with which a vehicle is armed. Each number of its airframe may be plausible
/// where all together are not.
const THRUST_TO_WEIGHT: core::ops::RangeInclusive<f32> = 1.01..=1_000.0;
/// A velocity request expires after this time, s, unless it is repeated.
pub const VELOCITY_TIMEOUT_S: f32 = 1.0;
/// Time for which nothing starts after a kill, s: more than what waits on another link needs to be read.
const KILL_HOLDS_S: f32 = 1.0;
/// Acceptance radius of a height, m, and as a part of a take-off.
const AT_HEIGHT_M: f32 = 0.3;
const AT_PART: f32 = 0.3;
/// Acceptance radius of a place, m; the vehicle must also be slow.
pub(crate) const AT_PLACE_M: f32 = 0.5;
/// Acceptance range of a heading, rad.
const AT_HEADING_RAD: f32 = 0.15;

/// Whether a tick has come by another.
const fn has_come(at: Tick, by: Tick) -> bool {
    by.wrapping_sub(at) < Tick::MAX / 2
}

/// The number of ticks in a time.
const fn ticks(seconds: f32) -> Tick {
    (seconds / TICK_S + 0.5) as Tick
}

impl Commander {
    /// In the state in which a valid configuration starts.
    pub fn new(config: &FlightConfig) -> Self {
        let flies = config.start == Start::InFlight;
        let start = config.start_position();
        // An invalid trajectory has been refused before.
        let (entry, entry_yaw) = Guidance::new(config.trajectory.clone(), config.join.as_ref(), start)
            .map_or((start, 0.0), |guidance| guidance.entry(config.start));
        Self {
            settings: config.modes,
            configured: true,
            weight_n: config.airframe.weight_n(),
            thrust_to_weight: config.airframe.thrust_max_n() / config.airframe.weight_n(),
            start,
            entry,
            entry_yaw,
            intent: if flies { Intent::Follow } else { Intent::Hold },
            until: None,
            overridden: None,
            state: if flies { State::Follow { since: 0 } } else { State::Disarmed },
            kills: 0,
            killed_until: None,
            home: start,
            home_is_set: false,
            speeds: ChosenSpeeds::default(),
            navigation: NavWatch::default(),
            battery: BatteryWatch::default(),
            ground: GroundWatch::new(flies, start.z),
            station: StationLoss::default(),
            motor_test: None,
            terminated: false,
            hand: Hand::default(),
            stream: Stream::default(),
            hover_throttle: config.manual.hover_throttle,
            unused_s: 10.0,
            landed_s: 2.0,
            stood_m: None,
            spin_up_s: 0.0,
            spins_until: None,
            battery_answered: Charge::Good,
        }
    }

    /// Takes over what stands in the settings alone. A vehicle that is built from a configuration was configured.
    pub fn configure(&mut self, settings: &Settings) {
        for index in settings::OF_COMMANDER {
            if let Some(value) = settings.get(index) {
                self.set(index, value);
            }
        }
    }

    /// Takes over a value that stands in the settings alone.
    fn set(&mut self, index: usize, value: Value) {
        match index {
            settings::SYS_AUTOSTART => self.configured = value.int() != 0,
            settings::COM_DISARM_PRFLT => self.unused_s = value.real(),
            settings::COM_DISARM_LAND => self.landed_s = value.real(),
            settings::COM_SPOOLUP_TIME => self.spin_up_s = value.real(),
            _ => {
                self.station.set(index, value);
                self.hand.set(index, value);
                self.stream.set(index, value);
            }
        }
    }

    /// Takes over a setting.
    pub fn apply(&mut self, change: &Change) {
        change.apply_to(&mut self.settings, Place::modes);
        if usize::from(change.index) == settings::MPC_THR_HOVER {
            self.hover_throttle = change.value.real();
        }
        self.set(usize::from(change.index), change.value);
    }

    /// How it flies by itself.
    pub fn settings(&self) -> &ModeSettings {
        &self.settings
    }

    /// The output in effect before the first job's.
    pub fn initial_output(&self) -> CommanderOutput {
        self.output(&NavState::at_rest_at(self.home), Err(Refusal::NoNavigation), Replies::new(), None)
    }

    /// One job, released at `released`.
    pub fn step(&mut self, released: Tick, input: &CommanderInput) -> CommanderOutput {
        let effective = released.wrapping_add(COMMANDER.offset);
        for change in &input.changes {
            self.apply(change);
        }
        self.watch(released, input);
        self.rest_if_down(effective, input);
        let mut replies = Replies::new();
        self.terminated = input.terminated;
        if input.kills != self.kills {
            self.kills = input.kills;
            self.killed_until = Some(effective.wrapping_add(ticks(KILL_HOLDS_S)));
            self.stop();
        }
        self.killed_until = self.killed_until.filter(|until| !has_come(*until, effective));
        for command in &input.commands {
            // Which of the two came first is not known: a kill is not undone by an arming that waited on another link, nor
            // does a flight that was asked for before it begin with the next arming.
            let turns = matches!(command.request, Request::Arm { .. } | Request::TestMotor { .. });
            let starts = turns || Intent::of(&command.request).is_some();
            let outcome = if starts && self.killed_until.is_some() {
                Outcome::TemporarilyRejected(Refusal::Killed)
            } else {
                self.decide(&command.request, effective, input)
            };
            // As many replies fit as commands.
            let _ = replies.push(Reply { command: *command, outcome });
        }
        let event = self.take_sticks(effective, input).or_else(|| self.take_setpoints(effective, input));
        let event = self.fail_safe(effective, input).or(event);
        let event = event.or(self.spin_up(effective, input));
        self.progress(effective, input);
        let home = self.known_home(input);
        let armable = self.check(input).and_then(|()| self.check_sticks(released, input));
        let motor_test = self.tested_motor(effective);
        let mut output = self.output(&input.nav, armable, replies, event);
        if self.settles(released, input) {
            output.directive = self.descend(self.settings.touchdown_m_s, input.nav.position.z, false);
        }
        CommanderOutput { motor_test, home, ..output }
    }

    /// The output, from a motion, while home is unknown.
    fn output(
        &self,
        nav: &NavState,
        armable: Result<(), Refusal>,
        replies: Replies,
        event: Option<Event>,
    ) -> CommanderOutput {
        let mode = self.state.mode();
        CommanderOutput {
            armed: self.state != State::Disarmed,
            kills: self.kills,
            mode,
            shown: if matches!(mode, Mode::Disarmed | Mode::Idle) { self.intent.mode() } else { mode },
            intent: self.intent,
            overridden: self.overridden,
            directive: self.directive(nav),
            ground: self.ground_below(nav),
            motor_test: None,
            landed: !self.ground.is_airborne(),
            ground_m: self.ground_m(),
            home: None,
            armable,
            replies,
            event,
        }
    }

    /// z of the ground, m: where it has stood last, or where it began.
    fn ground_m(&self) -> f32 {
        self.stood_m.unwrap_or(self.start.z)
    }

    /// When a vehicle that has landed is disarmed.
    fn after_landing(&self, landed: Tick) -> Tick {
        landed.wrapping_add(ticks(self.landed_s))
    }

    /// When a vehicle that was armed, or armed again, and does not fly is disarmed: the rotors have spun up by then.
    fn unused_until(&self, armed: Tick) -> Option<Tick> {
        (self.unused_s > 0.0).then(|| self.spins_until.unwrap_or(armed).wrapping_add(ticks(self.unused_s)))
    }

    /// The present state.
    pub fn state(&self) -> &State {
        &self.state
    }

    fn watch(&mut self, released: Tick, input: &CommanderInput) {
        self.navigation.step(input);
        self.battery.step(input, &self.settings, self.state != State::Disarmed);
        match self.state {
            State::Disarmed | State::Idle { .. } => self.ground.step_idle(input),
            State::Land | State::Descent | State::MotorOut => {
                self.ground.step_flying(input, self.weight_n, Some(self.navigation.known()), false);
            }
            State::Offboard => {
                let descends = self.descends_by_setpoint(released, input);
                self.ground.step_flying(input, self.weight_n, descends, false);
            }
            State::Manual(mode) => {
                let descends = self.descends_by_hand(mode, released, input);
                self.ground.step_flying(input, self.weight_n, descends, false);
            }
            State::TakeOff { .. } => self.ground.step_flying(input, self.weight_n, None, false),
            _ => {
                let was_airborne = self.ground.is_airborne();
                let may_stand = was_airborne && self.ground_below(&input.nav) != Ground::Far;
                let known = (may_stand && self.leads_down(input.nav.position.z)).then(|| self.navigation.known());
                self.ground.step_flying(input, self.weight_n, known, may_stand);
                self.ground.touched = was_airborne && !self.ground.is_airborne();
            }
        }
    }

    /// Disarms. One that is disarmed keeps the home and the speeds that it was given.
    fn stop(&mut self) {
        self.motor_test = None;
        if self.state != State::Disarmed {
            self.state = State::Disarmed;
            self.spins_until = None;
            self.home_is_set = false;
            self.speeds = ChosenSpeeds::default();
        }
        self.rest_intent();
    }

    /// Transitions on arrival, touchdown and timeout.
    fn progress(&mut self, effective: Tick, input: &CommanderInput) {
        let nav = &input.nav;
        let expires = self.until.is_some_and(|until| has_come(until, effective));
        if expires {
            (self.intent, self.until) = (Intent::Hold, None);
        }
        let is_at = |place: Vector3<f32>| (nav.position - place).norm_squared() < AT_PLACE_M * AT_PLACE_M;
        let heads = |yaw: f32| math::abs(math::wrap_angle(nav.yaw() - yaw)) < AT_HEADING_RAD;
        self.state = match self.state {
            State::Idle { disarm_at: Some(at) } if has_come(at, effective) => return self.stop(),
            State::TakeOff { from_m, to_m } if self.is_at_height(nav, from_m, to_m) => State::Hold,
            State::Velocity { .. } if expires => State::Hold,
            State::Join if is_at(self.entry) && is_slow(nav) && heads(self.entry_yaw) => {
                State::Follow { since: effective }
            }
            State::Return { at_m, climbs: true } if nav.position.z > at_m - AT_HEIGHT_M => {
                State::Return { at_m, climbs: false }
            }
            State::Return { at_m, climbs: false } if is_at(self.over_home(at_m)) && is_slow(nav) => State::Land,
            State::Approach(course) if is_slow(nav) && course.yaw.is_none_or(heads) => {
                let place = course.place_m.map(|[x, y]| Vector3::new(x, y, nav.position.z));
                if place.is_none_or(is_at) { State::Land } else { self.state }
            }
            state => state,
        };
    }

    /// Whether a take-off has arrived. One to a small height has still to leave the ground.
    fn is_at_height(&self, nav: &NavState, from_m: f32, to_m: f32) -> bool {
        let within_m = math::min(AT_HEIGHT_M, AT_PART * (to_m - from_m));
        self.ground.is_airborne() && math::abs(nav.position.z - to_m) < within_m
    }

    /// What has come down, or never left the ground and is not lifted any more, idles. Before the orders: none of them is for a
    /// vehicle that flies any more.
    fn rest_if_down(&mut self, effective: Tick, input: &CommanderInput) {
        let (now, height) = (effective.wrapping_sub(COMMANDER.offset), input.nav.position.z);
        let touched = core::mem::take(&mut self.ground.touched);
        if self.ground.is_airborne() {
            return;
        }
        self.state = match self.state {
            State::Land | State::Descent | State::MotorOut => {
                self.forget_intent();
                self.land(effective, height)
            }
            State::Offboard if !self.lifts_by_setpoint(now, input) => self.land(effective, height),
            State::Manual(mode)
                if self.hand.sticks(now, input).is_none() || self.descends_by_hand(mode, now, input).is_some() =>
            {
                self.land(effective, height)
            }
            _ if touched => self.land(effective, height),
            state => state,
        };
    }

    /// On the ground at a height (z, m); a mode that stays is kept.
    fn land(&mut self, effective: Tick, height: f32) -> State {
        self.stood_m = Some(height);
        self.rest_intent();
        State::Idle { disarm_at: Some(self.after_landing(effective)) }
    }
}
