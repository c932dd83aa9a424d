//! A vehicle in its world, with a console.

use std::collections::VecDeque;
use std::net::SocketAddr;
use std::ops::RangeInclusive;

use anyhow::{Result, ensure};
use firmware::commander::{
    self, Goal, LAUNCH_HELD_S, Mode, OrbitGoal, Origin, Outcome, Refusal, Reply, Request, SpeedKind,
};
use firmware::config::ModeSettings;
use firmware::failure::Manner;
use firmware::mavlink::port::{LINKS, Ports, SENT_CAPACITY};
use firmware::signals::Tick;
use nalgebra::Vector3;

use super::answers::{self, Answers};
use super::events::{self, Watch};
use super::line::{Line, Tone};
use super::overheard::Overheard;
use super::parse::{self, COMMANDS, Command};
use crate::failures::Equipment;
use crate::flash_file::ParameterFile;
use crate::plant::Plant as _;
use crate::plant::rigid_body::RigidBody;
use crate::report::timeline::fault_name;
use crate::sensors::Home;
use crate::sil::{Flight, Lockstep as _};
use crate::truth::TruthStream;

mod faults;

/// A line's instruction to the loop that runs the session.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// A new speed: simulated seconds per second.
    Speed(f64),
    /// End the program.
    Quit,
}

/// A request on its way to the commander and back.
#[derive(Clone, Copy, Debug)]
struct Asked {
    request: Request,
    /// Whether the vehicle has received it.
    sent: bool,
    /// Whether its answer is not printed.
    quiet: bool,
}

/// A flight that executes lines and reports events.
#[derive(Debug)]
pub struct Session {
    flight: Flight<RigidBody>,
    watch: Watch,
    /// What is answered to ground stations.
    answers: Answers,
    /// What they send and the vehicle passes over.
    overheard: Overheard,
    /// Requests in their order; the commander gets one at a time.
    asked: VecDeque<Asked>,
    /// The velocity to repeat, and the tick of its last request.
    velocity: Option<(Request, Tick)>,
    said: Vec<Line>,
    truth: Option<TruthStream>,
    /// Where settings are kept.
    parameters: Option<ParameterFile>,
    /// What of the console has acted on the flight, since somebody has last looked.
    inputs: Vec<(Tick, ConsoleInput)>,
}

/// What a typed line does to the flight, and before which tick.
#[derive(Clone, Debug, PartialEq)]
pub enum ConsoleInput {
    /// Asks the vehicle.
    Asked(commander::Asked),
    /// Changes the world around it: the line.
    World(String),
}

/// Ticks after which a velocity is repeated: five times as often as the vehicle needs.
const VELOCITY_AGAIN: Tick = 200;

/// Ticks between two messages of the truth: 10 Hz.
const TRUTH_EVERY: Tick = 100;

impl Session {
    /// Starts a session on a flight, before its next tick.
    pub fn new(mut flight: Flight<RigidBody>) -> Self {
        let injectable = flight.injectable();
        flight.autopilot.inner.allow_failures(injectable);
        let watch = Watch::new(&flight);
        let system = flight.autopilot.ground.settings().system_id();
        let overheard = Overheard::of(system..=system);
        let (answers, asked) = (Answers::default(), VecDeque::new());
        Self {
            flight,
            watch,
            answers,
            overheard,
            asked,
            velocity: None,
            said: Vec::new(),
            truth: None,
            parameters: None,
            inputs: Vec::new(),
        }
    }

    /// The same, with the truth told beside what the vehicle tells: the flight is about this home.
    #[must_use]
    pub fn telling_the_truth(mut self, home: &Home) -> Self {
        self.truth = Some(TruthStream::new(home, self.flight.autopilot.ground.settings().system_id()));
        self
    }

    /// The same, of vehicles with these systems, which ground stations may speak to beside this one.
    #[must_use]
    pub fn among(mut self, systems: RangeInclusive<u8>) -> Self {
        self.overheard = Overheard::of(systems);
        self
    }

    /// A pilot of this process has this link: answers to what is asked there are told as the pilot's.
    pub fn seat_pilot(&mut self, link: u8) {
        self.answers.seat_pilot(link);
    }

    /// The truth as MAVLink frames of a component of its own, when it is due.
    pub fn truth(&mut self) -> Option<Vec<u8>> {
        let tick = self.flight.next_tick();
        let stream = self.truth.as_mut().filter(|_| tick.is_multiple_of(TRUTH_EVERY))?;
        Some(stream.frames(tick, &self.flight.plant().motion(), &self.flight.specific_force()))
    }

    /// Keeps its settings in a file from now on.
    pub fn keep_parameters(&mut self, parameters: Option<ParameterFile>) {
        self.parameters = parameters;
    }

    /// Saves a setting that was set, once the vehicle is disarmed.
    fn save_parameters(&mut self) {
        let Some(file) = &mut self.parameters else { return };
        let armed = self.flight.autopilot.inner.commander_output().armed;
        if let Err(error) = file.save_next(self.flight.autopilot.ground.settings_mut(), armed) {
            self.parameters = None;
            self.say(Tone::Refused, format!("parameters are not kept any more: {error:#}"));
        }
    }

    /// Saves what was set in flight and still waits, at the end. Returns how many parameters that were.
    ///
    /// # Errors
    /// One line with the file, and why they were not saved.
    pub fn save_at_end(&mut self) -> Result<usize> {
        let Some(file) = &mut self.parameters else { return Ok(0) };
        file.save_all(self.flight.autopilot.ground.settings_mut())
    }

    /// The flight.
    pub fn flight(&self) -> &Flight<RigidBody> {
        &self.flight
    }

    /// Simulated time, s.
    pub fn time_s(&self) -> f64 {
        f64::from(self.flight.next_tick()) / 1e3
    }

    /// The lines since the last call, the oldest first.
    pub fn take_lines(&mut self) -> Vec<Line> {
        core::mem::take(&mut self.said)
    }

    /// What of the console has acted on the flight since the last call, each with the tick before which it did.
    pub fn take_inputs(&mut self) -> Vec<(Tick, ConsoleInput)> {
        core::mem::take(&mut self.inputs)
    }

    fn note(&mut self, input: ConsoleInput) {
        self.inputs.push((self.flight.next_tick(), input));
    }

    fn say(&mut self, tone: Tone, text: String) {
        self.said.push(Line { t_s: Some(self.time_s()), tone, text });
    }

    /// Prints a line of help, without a time.
    fn explain(&mut self, text: String) {
        self.said.push(Line { t_s: None, tone: Tone::Plain, text });
    }

    /// The vehicle's links.
    pub fn ports(&self) -> &Ports {
        &self.flight.autopilot.ports
    }

    /// One tick of vehicle and world.
    pub fn tick(&mut self) {
        let left = self.left();
        self.flight.step(&mut ());
        self.take_failures();
        self.save_parameters();
        self.watch.step(&self.flight);
        if events::is_due(self.flight.next_tick()) {
            self.look();
        }
        self.read_answers(left);
    }

    /// Reads along what comes on a link before the next tick, and tells of what the vehicle passes over.
    pub fn overhear(&mut self, link: usize, bytes: &[u8]) {
        let (tick, t_s) = (self.flight.next_tick(), Some(self.time_s()));
        let Self { answers, overheard, said, .. } = self;
        overheard.read(tick, link, bytes, &mut |system, text| {
            let text = format!("{}: {text}", answers.who(link as u8, system));
            said.push(Line { t_s, tone: Tone::Refused, text });
        });
    }

    /// Bytes that the links still hold from before: a slow station has not taken them. They were read.
    fn left(&self) -> [usize; LINKS] {
        let mut left = [0; LINKS];
        for (left, port) in left.iter_mut().zip(self.ports()) {
            *left = if port.has_output() { port.look(&mut [0; SENT_CAPACITY]).len() } else { 0 };
        }
        left
    }

    /// Reports what the vehicle refuses ground stations without the commander.
    fn read_answers(&mut self, left: [usize; LINKS]) {
        let (tick, t_s) = (self.flight.next_tick(), Some(self.time_s()));
        let Self { answers, overheard, said, flight, .. } = self;
        for ((number, port), left) in (0..).zip(&flight.autopilot.ports).zip(left) {
            if port.has_output() {
                let mut sent = [0; SENT_CAPACITY];
                let frames = port.look(&mut sent).get(left..).unwrap_or_default();
                let tell = &mut |text| said.push(Line { t_s, tone: Tone::Refused, text });
                answers.read(number, frames, tell);
                if let Some(reason) = answers::refused_set_point(frames)
                    && let Some(system) = overheard.refused_set_point(tick, number.into())
                {
                    tell(format!("{}: set-point: refused, {reason}", answers.who(number, system)));
                }
            }
        }
    }

    /// Applies the failures that were accepted from ground stations.
    fn take_failures(&mut self) {
        for failure in self.flight.take_failures() {
            if failure.manner == Manner::Well {
                self.say(Tone::Plain, format!("ground station: {} works again", Equipment::of(&failure).name()));
            }
        }
    }

    /// Reports the commander's decisions, and what has changed.
    fn look(&mut self) {
        let t_s = Some(self.time_s());
        let mut disarmed_by = None;
        for reply in self.flight.autopilot.inner.commander_output().replies.clone() {
            let who = self.hear(&reply);
            if reply.command.request == Request::Disarm && reply.outcome == Outcome::Accepted {
                disarmed_by = who;
            }
        }
        let Self { watch, flight, said, .. } = self;
        watch.look(flight, disarmed_by.as_deref(), &mut |tone, text| said.push(Line { t_s, tone, text }));
        self.go_on_with_velocity();
        self.send();
    }

    /// Reports the commander's answer to a request. Returns who has sent that, unless nothing is reported.
    fn hear(&mut self, reply: &Reply) -> Option<String> {
        let request = reply.command.request;
        let mut is_typed = false;
        let who = match reply.command.origin {
            Origin::Station { link, sender: (system, _), .. } => {
                self.answers.told(reply);
                self.answers.who(link, system)
            }
            Origin::OnBoard => {
                let mine = self.asked.iter().position(|asked| asked.sent && asked.request == request);
                match mine.and_then(|place| self.asked.remove(place)) {
                    Some(Asked { quiet: true, .. }) => return None,
                    Some(_) => {
                        is_typed = true;
                        "a typed line".to_owned()
                    }
                    None => "scenario".to_owned(),
                }
            }
        };
        if is_typed && reply.outcome == Outcome::Accepted {
            let goes_on = matches!(request, Request::Velocity { .. });
            self.velocity = goes_on.then_some((request, self.flight.next_tick()));
        }
        let (tone, outcome) = match reply.outcome {
            Outcome::Accepted if self.waits_to_be_armed(&request) => {
                (Tone::Plain, format!("accepted, when armed within {LAUNCH_HELD_S} s"))
            }
            Outcome::Accepted => (Tone::Plain, accepted(&request, self.flight.autopilot.commander.settings())),
            Outcome::TemporarilyRejected(refusal) => (Tone::Refused, refused(&request, refusal)),
            Outcome::Denied => (Tone::Refused, "denied: a value is out of its range".to_owned()),
        };
        let whose = if is_typed { String::new() } else { format!("{who}: ") };
        self.say(tone, format!("{whose}{}: {outcome}", describe(&request)));
        Some(who)
    }

    /// Whether a request to leave the ground, which was accepted, is held until the vehicle is armed.
    fn waits_to_be_armed(&self, request: &Request) -> bool {
        matches!(request, Request::TakeOff { .. } | Request::Follow)
            && !self.flight.autopilot.inner.commander_output().armed
    }

    /// Repeats the velocity until the vehicle leaves the mode.
    fn go_on_with_velocity(&mut self) {
        let Some((request, since)) = self.velocity else { return };
        if self.flight.autopilot.inner.commander_output().mode != Mode::Velocity {
            self.velocity = None;
        } else if self.flight.next_tick().wrapping_sub(since) >= VELOCITY_AGAIN && self.asked.is_empty() {
            self.velocity = Some((request, self.flight.next_tick()));
            self.asked.push_back(Asked { request, sent: false, quiet: true });
        }
    }

    /// Sends the next request to the commander, unless it has one already.
    fn send(&mut self) {
        if self.asked.iter().any(|asked| asked.sent) {
            return;
        }
        if let Some(next) = self.asked.front_mut() {
            // A full queue: later.
            next.sent = self.flight.autopilot.inner.request(next.request).is_ok();
            if next.sent {
                let request = next.request;
                self.note(ConsoleInput::Asked(request.into()));
            }
        }
    }

    fn ask(&mut self, request: Request) {
        self.asked.push_back(Asked { request, sent: false, quiet: false });
        self.send();
    }

    /// Stops the rotors. Overtakes the waiting requests and drops them.
    fn kill(&mut self) {
        self.asked.retain(|asked| asked.sent);
        self.flight.autopilot.inner.kill();
        self.note(ConsoleInput::Asked(commander::Asked::Kill));
        self.say(Tone::Good, "kill: accepted".to_owned());
    }

    /// Executes a line, and answers at once or when the commander has decided. An invalid line only gets an answer.
    pub fn enter(&mut self, line: &str) -> Option<Control> {
        match self.read_and_carry_out(line) {
            Ok(control) => control,
            Err(error) => {
                self.say(Tone::Refused, format!("{error:#}").replace('\n', " "));
                None
            }
        }
    }

    fn read_and_carry_out(&mut self, line: &str) -> Result<Option<Control>> {
        let Some(command) = parse::parse(line, self.flight.next_tick())? else { return Ok(None) };
        let control = self.carry_out(&command)?;
        if matches!(command, Command::SetWind(_) | Command::Fault(_) | Command::Clear(_)) {
            self.note(ConsoleInput::World(line.trim().to_owned()));
        }
        Ok(control)
    }

    fn carry_out(&mut self, command: &Command) -> Result<Option<Control>> {
        match command {
            Command::Help(None) => self.list_commands(),
            Command::Help(Some(entry)) => self.explain(entry.help()),
            Command::Status => self.say(Tone::Plain, self.status()),
            Command::Request(request) => self.ask(*request),
            Command::Kill => self.kill(),
            Command::GoTo { place, yaw_deg } => self.ask(self.go_to(*place, *yaw_deg)?),
            Command::Wind => self.say_wind("wind"),
            Command::SetWind(mean) => {
                self.flight.set_steady_wind((*mean).into())?;
                self.say_wind("wind set");
            }
            Command::Fault(fault) => self.inject(fault)?,
            Command::Faults => self.list_faults(),
            Command::Clear(of) => self.clear(*of)?,
            Command::Speed(speed) => {
                self.say(Tone::Plain, format!("speed: {speed} x real time"));
                return Ok(Some(Control::Speed(*speed)));
            }
            Command::Quit => return Ok(Some(Control::Quit)),
        }
        Ok(None)
    }

    fn list_commands(&mut self) {
        let width = COMMANDS.iter().map(|entry| entry.usage().len()).max().unwrap_or(0);
        for entry in COMMANDS {
            self.explain(format!("{:width$}  {}", entry.usage(), entry.summary()));
        }
    }

    /// The request for a place; missing coordinates are taken from the vehicle's estimate.
    fn go_to(&self, place: [Option<f64>; 3], yaw_deg: Option<f64>) -> Result<Request> {
        let nav = self.flight.autopilot.inner.nav();
        let mut position_m: [f32; 3] = nav.position.into();
        for (is, ought) in position_m.iter_mut().zip(place) {
            *is = ought.map_or(*is, |ought| ought as f32);
        }
        if let (Some(ground), Some(up)) = (self.flight.plant().ground(), place[2]) {
            let height = ground.height_above(&Vector3::new(0.0, 0.0, up));
            ensure!(
                height > 0.0,
                "goto: UP = {up} m is not above the ground, which is at {} m: use `land`",
                up - height
            );
        }
        let yaw_rad = yaw_deg.map_or_else(|| nav.attitude.euler_angles().2, |yaw| yaw.to_radians() as f32);
        Ok(Request::GoTo(Goal::at(position_m, yaw_rad)))
    }

    fn say_wind(&mut self, what: &str) {
        let [north, west, up] = shown(self.flight.steady_wind());
        self.say(Tone::Plain, format!("{what}: north {north:.1}, west {west:.1}, up {up:.1} m/s"));
    }

    fn status(&self) -> String {
        let vehicle = &self.flight.autopilot.inner;
        let (commander, nav) = (vehicle.commander_output(), vehicle.nav());
        let [north, west, up] = shown(nav.position.cast());
        let yaw = nav.attitude.euler_angles().2.to_degrees().round() + 0.0;
        let off = events::off_text(&self.flight);
        let place = format!("north {north:.1}, west {west:.1}, up {up:.1} m{off}, yaw {yaw}°");
        let state = match (commander.armed, commander.landed, commander.armable) {
            (true, true, _) => "armed on the ground".to_owned(),
            (true, false, _) => "in the air".to_owned(),
            (false, _, Ok(())) => "ready to arm".to_owned(),
            (false, _, Err(refusal)) => format!("not ready to arm: {}", refusal.reason()),
        };
        let speed = nav.velocity.norm();
        let mut text = format!("{}, {state}; {place}; {speed:.1} m/s", commander.mode.name());
        if let Some(battery) = self.flight.plant().battery() {
            text = format!("{text}; battery {:.1} V, {:.0} %", battery.voltage_v, battery.soc * 100.0);
        }
        let [north, west, up] = shown(self.flight.steady_wind());
        let now_s = self.time_s();
        let acting = self.faults().into_iter().filter(|fault| fault.from_s <= now_s);
        let faults: Vec<String> = acting.map(|fault| fault_name(&fault)).collect();
        let faults = if faults.is_empty() { "no faults".to_owned() } else { format!("faults: {}", faults.join(", ")) };
        format!("{text}; wind {north:.1} {west:.1} {up:.1} m/s; {faults}")
    }

    /// A ground station at an address has been heard for the first time, or again.
    pub fn station_heard(&mut self, address: SocketAddr, system: u8) {
        self.say(Tone::Good, format!("ground station {system} connected from {address}"));
    }

    /// A ground station found no free link.
    pub fn station_turned_away(&mut self, address: SocketAddr) {
        self.say(Tone::Refused, format!("no free link for {address}: the vehicle has {LINKS}"));
    }

    /// A ground station has not been heard for a while.
    pub fn station_lost(&mut self, address: SocketAddr, system: u8, silent_s: u64) {
        self.say(Tone::Alarm, format!("ground station {system} lost: nothing from {address} for {silent_s} s"));
    }
}

/// Rounds to 0.1, without negative zeros.
fn shown(value: Vector3<f64>) -> [f64; 3] {
    [value.x, value.y, value.z].map(|value| (value * 10.0).round() / 10.0 + 0.0)
}

/// A goal in words.
fn describe_goal(goal: &Goal) -> String {
    let rounded = |value: f32| (f64::from(value) * 10.0).round() / 10.0 + 0.0;
    let place = goal.place_m.map(|[x, y]| format!("north {}, west {}", rounded(x), rounded(y)));
    let height = goal.height_m.map(|z| format!("up {} m", rounded(z)));
    let yaw = goal.yaw_rad.map(|yaw| format!("yaw {}°", yaw.to_degrees().round() + 0.0));
    let given: Vec<String> = [place, height, yaw].into_iter().flatten().collect();
    if given.is_empty() { "where it is".to_owned() } else { given.join(", ") }
}

/// A request in words.
fn describe(request: &Request) -> String {
    match *request {
        Request::Arm { force: false } => "arm".to_owned(),
        Request::Arm { force: true } => "arm without checks".to_owned(),
        Request::Disarm => "disarm".to_owned(),
        // Heights over the sea come back from float with a tail of digits.
        Request::TakeOff { height_m } => format!("take-off to {} m", (f64::from(height_m) * 100.0).round() / 100.0),
        Request::Hold => "hold".to_owned(),
        Request::Manual(mode) => format!("{} mode", Mode::from(mode).name()),
        Request::TestMotor { test, seconds } => format!("motor {} for {seconds} s", test.rotor + 1),
        Request::Orbit(OrbitGoal { radius_m, speed_m_s, .. }) => {
            let radius = radius_m.map_or_else(String::new, |radius| format!(" of {radius} m"));
            let speed = speed_m_s.map_or_else(String::new, |speed| format!(" at {} m/s", speed.abs()));
            format!("orbit{radius}{speed}")
        }
        Request::Offboard => "offboard mode".to_owned(),
        Request::GoTo(goal) => format!("go to {}", describe_goal(&goal)),
        Request::LandAt(goal) => format!("land at {}", describe_goal(&goal)),
        Request::Speed { kind, speed_m_s } => {
            let kind = match kind {
                SpeedKind::Horizontal => "speed",
                SpeedKind::Up => "speed upwards",
                SpeedKind::Down => "speed downwards",
            };
            speed_m_s.map_or_else(|| format!("usual {kind}"), |speed| format!("{kind} {speed} m/s"))
        }
        Request::Velocity { velocity_m_s: [north, west, up], yaw_rate_rad_s } => {
            format!("velocity north {north}, west {west}, up {up} m/s, yaw {}°/s", yaw_rate_rad_s.to_degrees().round())
        }
        Request::Land => "land".to_owned(),
        Request::Return => "return".to_owned(),
        Request::Follow => "trajectory".to_owned(),
        Request::SetHome { position_m: None } => "home here".to_owned(),
        Request::SetHome { position_m: Some(position_m) } => {
            let [north, west, up] = shown(Vector3::from(position_m).cast());
            format!("home at north {north}, west {west}, up {up} m")
        }
    }
}

/// The answer to a request that is granted, with what of it is cut.
fn accepted(request: &Request, modes: &ModeSettings) -> String {
    let Request::Velocity { velocity_m_s: [north, west, up], yaw_rate_rad_s } = *request else {
        return "accepted".to_owned();
    };
    let vertical = if up > 0.0 { ("climb_m_s", modes.climb_m_s) } else { ("sink_m_s", modes.sink_m_s) };
    let limits = [
        ("fastest_m_s", libm::hypotf(north, west), modes.fastest_m_s, "m/s"),
        (vertical.0, up.abs(), vertical.1, "m/s"),
        ("yaw_rate_rad_s", yaw_rate_rad_s.abs(), modes.yaw_rate_rad_s, "rad/s"),
    ];
    let cut = limits.iter().filter(|(_, asked, most, _)| asked > most);
    let cut: Vec<String> = cut.map(|(key, _, most, unit)| format!("{most} {unit} (modes.{key})")).collect();
    if cut.is_empty() { "accepted".to_owned() } else { format!("accepted, at no more than {}", cut.join(", ")) }
}

/// The commander's reason, and a remedy.
fn refused(request: &Request, refusal: Refusal) -> String {
    let remedy = match refusal {
        Refusal::Disarmed => "; `arm` first",
        Refusal::OnGround => "; `takeoff` first",
        Refusal::NoNavigation | Refusal::NotAligned | Refusal::NoHeading | Refusal::NoPosition | Refusal::NoHeight => {
            "; wait for sensors"
        }
        // It stays so until the vehicle is armed again, also of a rotor that works.
        Refusal::RotorFailed if matches!(request, Request::Arm { .. }) => "; once it works (`clear`), `arm force`",
        _ => "",
    };
    format!("refused, {}{remedy}", refusal.reason())
}
