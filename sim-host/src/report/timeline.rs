//! What a flight did, as plain data for the table, summary.json and the figures: its phases, and what happened when.
//!
//! Times are the plant's. Distances are between the true position and the reference; the vehicle's belief decides
//! nothing here but the names of the phases, which are the commander's modes.

use firmware::commander::{Asked, CommanderOutput, Mode, Outcome, Reply};
use serde::Serialize;

use super::measures::Size;
use crate::pilot::{Command, Order};
use crate::record::{Activity, Recorder, Row};
use crate::scenario::ScheduledPush;
use crate::sensors::Fault;
use crate::sensors::faults::{Kind, Sensor};

/// A stretch of a flight in which the vehicle did one thing.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Phase {
    /// What it did: a mode's name, `go-to 2`, `join`, `trajectory`, `before arming`, `armed`, `landed`, `disarmed`.
    pub name: String,
    /// Start, s.
    pub from_s: f64,
    /// End, s.
    pub to_s: f64,
    /// Root mean square of the true distance from the reference, m; none on the ground and where no position is
    /// controlled.
    pub error_rms_m: Option<f64>,
    /// Its maximum, m.
    pub error_max_m: Option<f64>,
}

/// What kind of event it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum EventKind {
    /// A command of the pilot.
    Order,
    /// A command that the vehicle refused.
    Refused,
    /// A fault begins.
    FaultBegins,
    /// A fault ends.
    FaultEnds,
    /// A push begins.
    PushBegins,
    /// A push ends.
    PushEnds,
    /// The vehicle acts by itself.
    Response,
    /// A foot touches the ground, after the vehicle has flown.
    Touchdown,
    /// The vehicle is damaged.
    Crash,
    /// The rotors are stopped.
    Disarmed,
}

/// Something that happened.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Event {
    /// When, s.
    pub t_s: f64,
    /// What kind.
    pub kind: EventKind,
    /// In words.
    pub text: String,
}

/// The course of a flight.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Timeline {
    /// One after the other, without gaps. Empty where no firmware flies (`paper-decoupled`).
    pub phases: Vec<Phase>,
    /// In the order of time.
    pub events: Vec<Event>,
}

impl Timeline {
    /// Adds what the recorder of the vehicle's doings does not see, in its place.
    pub fn add(&mut self, event: Event) {
        let place = self.events.partition_point(|other| other.t_s <= event.t_s);
        self.events.insert(place, event);
    }
}

/// What became of a command of the pilot.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg {
    /// The command.
    pub order: Order,
    /// Where it leads to, m, where it leads anywhere: home for a return, and where the vehicle was for a landing.
    pub place: Option<[f64; 3]>,
    /// Why the vehicle refused it, if it did.
    pub refused: Option<&'static str>,
    /// True distance from there when the next command was given, the vehicle first acted by itself, or at the end, m; none of
    /// a refused command.
    pub off_m: Option<f64>,
}

/// A flight as its mission is judged by.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Course {
    /// What happened when.
    pub timeline: Timeline,
    /// The commands that were given.
    pub legs: Vec<Leg>,
    /// When (s) the vehicle first changed its mode by itself, and why.
    pub response: Option<(f64, &'static str)>,
    /// Charge at the start and at the end, 0 to 1.
    pub battery: Option<[f64; 2]>,
    /// Whether it was disarmed at the end.
    pub disarmed: bool,
}

impl Course {
    /// Takes back how far the vehicle was from the place that it was on its way to when the flight was cut off, further
    /// than `reached_m`.
    pub fn cut_off(&mut self, reached_m: f64) {
        if let Some(last) = self.legs.last_mut() {
            last.off_m = last.off_m.filter(|off| *off <= reached_m);
        }
    }
}

/// Records the course of a flight.
#[derive(Clone, Debug, Default)]
#[allow(clippy::struct_excessive_bools, reason = "each remembers one thing that has been seen, in any combination")]
pub struct TimelineRecorder {
    script: Vec<Command>,
    course: Course,
    error: Size,
    /// Distance from the reference in the newest row, m; none where the reference is an earlier row's.
    distance_m: Option<f64>,
    /// How long the trajectory is joined, s.
    joined_s: f64,
    position: [f64; 3],
    /// Where the flight began.
    home: Option<[f64; 3]>,
    armed_before: bool,
    armed: bool,
    mode: Option<Mode>,
    /// Whether it has flown since it was armed.
    flown: bool,
    event: Option<firmware::commander::Event>,
    replied: bool,
    end_s: f64,
}

impl TimelineRecorder {
    /// Of a flight with a pilot's script, whose trajectory is joined for `joined_s`.
    pub fn new(script: &[Command], joined_s: f64) -> Self {
        Self { script: script.to_vec(), joined_s, ..Self::default() }
    }

    /// The course, with the faults and pushes of a schedule that began before its end.
    pub fn finish(mut self, faults: &[Fault], pushes: &[ScheduledPush]) -> Course {
        self.close();
        self.arrive();
        for fault in faults {
            let kinds = [EventKind::FaultBegins, EventKind::FaultEnds];
            self.schedule((fault.from_s, fault.to_s), kinds, ["fault: ", "fault ends: "], &fault_name(fault));
        }
        for push in pushes {
            let kinds = [EventKind::PushBegins, EventKind::PushEnds];
            self.schedule((push.from_s, Some(push.to_s)), kinds, ["push: ", "push ends: "], &push_name(push));
        }
        Course { disarmed: !self.armed, ..self.course }
    }

    /// Adds begin and end of what a schedule did, as far as it came before the flight's end.
    fn schedule(&mut self, (from_s, to_s): (f64, Option<f64>), kinds: [EventKind; 2], says: [&str; 2], name: &str) {
        let times = [Some(from_s).filter(|from| *from <= self.end_s), to_s.filter(|to| *to < self.end_s)];
        for ((t_s, kind), says) in times.into_iter().zip(kinds).zip(says) {
            if let Some(t_s) = t_s {
                self.course.timeline.add(Event { t_s, kind, text: format!("{says}{name}") });
            }
        }
    }

    fn close(&mut self) {
        let (rms, max, end) = (self.error.rms(), self.error.max(), self.end_s);
        if let Some(phase) = self.course.timeline.phases.last_mut() {
            (phase.to_s, phase.error_rms_m, phase.error_max_m) = (end, rms, max);
        }
        self.error = Size::default();
    }

    fn say(&mut self, t_s: f64, kind: EventKind, text: impl Into<String>) {
        self.course.timeline.events.push(Event { t_s, kind, text: text.into() });
    }

    fn orders(&mut self, activity: &Activity) {
        while let Some(command) = self.script[..activity.given.min(self.script.len())].get(self.course.legs.len()) {
            let order = command.order;
            self.arrive();
            let place = self.place_of(&order);
            self.course.legs.push(Leg { order, place, refused: None, off_m: None });
            self.say(activity.t, EventKind::Order, order_text(&order));
        }
    }

    fn place_of(&self, order: &Order) -> Option<[f64; 3]> {
        let [x, y, z] = self.position;
        match *order {
            Order::TakeOff { height_m } => Some([x, y, z + f64::from(height_m)]),
            Order::GoTo { position_m, .. } => Some(position_m.map(f64::from)),
            Order::Land => Some(self.position),
            Order::Return => self.home,
            _ => None,
        }
    }

    /// How far the vehicle is from where the newest command leads to. Once it has acted by itself, it is no longer on its
    /// way there.
    fn arrive(&mut self) {
        if self.course.response.is_some() {
            return;
        }
        let position = self.position;
        if let Some(leg) = self.course.legs.last_mut() {
            leg.off_m = leg.place.filter(|_| leg.refused.is_none()).map(|place| distance(&place, &position));
        }
    }

    fn answers(&mut self, t: f64, commander: &CommanderOutput) {
        if !self.replied {
            for reply in &commander.replies {
                self.answer(t, reply);
            }
        }
        self.replied = !commander.replies.is_empty();
        if commander.event != self.event {
            self.event = commander.event;
            if let Some(event) = commander.event {
                self.say(t, EventKind::Response, event.text());
                if self.mode != Some(commander.mode) && self.course.response.is_none() {
                    self.arrive();
                    self.course.response = Some((t, event.text()));
                }
            }
        }
        self.mode = Some(commander.mode);
    }

    /// What the vehicle said to the newest command of its kind.
    fn answer(&mut self, t: f64, reply: &Reply) {
        let (name, refused) = (reply.command.request.name(), refusal(reply));
        let leg = self.course.legs.iter_mut().rfind(|leg| asks(&leg.order, name));
        let before = leg.and_then(|leg| std::mem::replace(&mut leg.refused, refused));
        // Orders that are repeated until they are accepted are refused again and again.
        if let Some(reason) = refused.filter(|_| refused != before) {
            self.say(t, EventKind::Refused, format!("{name} refused: {reason}"));
        }
    }

    /// The name of what is being done, with a number where it is done more than once.
    fn doing(&self, activity: &Activity) -> (&'static str, Option<usize>) {
        let commander = activity.commander;
        match commander.mode {
            Mode::Disarmed if self.armed_before => ("disarmed", None),
            Mode::Disarmed => ("before arming", None),
            Mode::Idle if self.flown => ("landed", None),
            Mode::Idle => ("armed", None),
            Mode::GoTo => ("go-to", Some(self.legs_given())),
            Mode::Follow if !follows(activity, self.joined_s) => ("join", None),
            mode => (mode.name(), None),
        }
    }

    fn legs_given(&self) -> usize {
        self.course.legs.iter().filter(|leg| matches!(leg.order, Order::GoTo { .. })).count()
    }
}

impl Recorder for TimelineRecorder {
    fn record(&mut self, row: &Row) {
        let [x, y, z, _] = row.reference;
        self.distance_m = (!row.reference_is_held).then(|| distance(&[x, y, z], &row.position));
        self.position = row.position;
        self.home.get_or_insert(row.position);
        self.end_s = row.t;
    }

    fn observe(&mut self, activity: &Activity) {
        self.orders(activity);
        let commander = activity.commander;
        self.answers(activity.t, commander);
        if self.armed && !commander.armed {
            self.say(activity.t, EventKind::Disarmed, "disarmed");
        }
        if let Some(battery) = activity.battery {
            self.course.battery.get_or_insert([battery.soc; 2])[1] = battery.soc;
        }
        self.armed = commander.armed;
        self.armed_before |= commander.armed;
        // Once disarmed, what comes is another flight.
        self.flown = commander.armed && (self.flown || !matches!(commander.mode, Mode::Disarmed | Mode::Idle));
        let (name, number) = self.doing(activity);
        let is_same = self.course.timeline.phases.last().is_some_and(|phase| is_named(&phase.name, name, number));
        if !is_same {
            self.close();
            let name = number.map_or_else(|| name.to_owned(), |number| format!("{name} {number}"));
            let phase = Phase { name, from_s: activity.t, to_s: activity.t, ..Phase::default() };
            self.course.timeline.phases.push(phase);
        }
        if let Some(distance_m) = self.distance_m.filter(|_| controls_position(commander)) {
            self.error.take(distance_m);
        }
    }
}

/// Whether an order asks for what is called so. A kill has no reply.
fn asks(order: &Order, name: &str) -> bool {
    matches!(order.asked(), Asked::Request(request) if request.name() == name)
}

/// Whether the vehicle is on its trajectory, after the path of `joined_s` that leads onto it.
pub fn follows(activity: &Activity, joined_s: f64) -> bool {
    let start_s = activity.commander.flight_start().map(|tick| f64::from(tick) / 1e3);
    start_s.is_some_and(|start| activity.t >= start + joined_s)
}

/// Whether the vehicle controls its position.
pub fn controls_position(commander: &CommanderOutput) -> bool {
    !matches!(commander.mode, Mode::Disarmed | Mode::Idle | Mode::Descent | Mode::MotorOut)
}

fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let [x, y, z]: [f64; 3] = std::array::from_fn(|i| a[i] - b[i]);
    libm::sqrt(x * x + y * y + z * z)
}

/// Whether a phase's name is `name`, or `name number`. Does not allocate: it is asked each tick.
fn is_named(phase: &str, name: &str, number: Option<usize>) -> bool {
    let Some(rest) = phase.strip_prefix(name) else { return false };
    match number {
        None => rest.is_empty(),
        Some(number) => rest.trim_start().parse() == Ok(number),
    }
}

/// Why a command was refused, if it was.
fn refusal(reply: &Reply) -> Option<&'static str> {
    match reply.outcome {
        Outcome::Accepted => None,
        Outcome::TemporarilyRejected(refusal) => Some(refusal.reason()),
        Outcome::Denied => Some("a value out of its range"),
    }
}

/// A pilot's command in words.
pub fn order_text(order: &Order) -> String {
    match order {
        Order::Arm => "arm".into(),
        Order::Disarm => "disarm".into(),
        Order::Kill => "kill".into(),
        Order::TakeOff { height_m } => format!("take-off to {height_m} m"),
        Order::Hold => "hold".into(),
        Order::GoTo { position_m: [x, y, z], .. } => format!("go-to {x}, {y}, {z} m"),
        Order::Velocity { velocity_m_s: [x, y, z], .. } => format!("velocity {x}, {y}, {z} m/s"),
        Order::Land => "land".into(),
        Order::Return => "return".into(),
        Order::Follow => "follow the trajectory".into(),
    }
}

/// A push in words: its parts, along the world's axes and about the body's.
fn push_name(push: &ScheduledPush) -> String {
    let linear = (push.acceleration_m_s2, ["north", "west", "up"], "m/s²");
    let angular = (push.angular_acceleration_rad_s2, ["about roll", "about pitch", "about yaw"], "rad/s²");
    let parts = [linear, angular].into_iter().flat_map(|(values, axes, unit)| {
        let part = move |(value, axis): (f64, &str)| (value != 0.0).then(|| format!("{value} {unit} {axis}"));
        values.into_iter().zip(axes).filter_map(part)
    });
    parts.collect::<Vec<_>>().join(", ")
}

/// A fault in words.
pub fn fault_name(fault: &Fault) -> String {
    let (sensor, unit) = fault.sensor.map_or(("", ""), |sensor| (sensor.name(), sensor.unit()));
    match fault.kind {
        Kind::Off {} if fault.sensor == Some(Sensor::Battery) => "battery monitor off".to_owned(),
        Kind::Off {} => format!("{sensor} off"),
        Kind::Stuck {} => format!("{sensor} stuck"),
        Kind::Drift { rate, .. } => format!("{sensor} drifts by {rate} {unit} a second"),
        Kind::Noise { sigma } => format!("{sensor} noise of {sigma} {unit}"),
        Kind::Spikes { size, .. } => format!("{sensor} spikes of {size} {unit}"),
        Kind::Delayed { extra_s } => format!("{sensor} late by {extra_s} s"),
        Kind::Nan {} => format!("{sensor} gives NaN"),
        Kind::Glitch { size_m, .. } => format!("{sensor} jumps by {size_m} m"),
        Kind::NoFix {} => format!("{sensor} without a fix"),
        Kind::Loss { probability } => format!("{sensor} loses {} % of its samples", 100.0 * probability),
        Kind::Duplicate { .. } => format!("{sensor} repeats samples"),
        Kind::Disorder {} => format!("{sensor} samples out of order"),
        Kind::TimeJump { shift_s } => format!("{sensor} time stamps shifted by {shift_s} s"),
        // Pilots count rotors from 1, files from 0.
        Kind::Rotor { index, effectiveness } => {
            format!("rotor {} (index {index}) keeps {} % of its thrust", index + 1, 100.0 * effectiveness)
        }
        Kind::Collapse { factor } => format!("battery voltage falls to {} %", 100.0 * factor),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flight_that_is_cut_off_has_not_missed_where_it_was_on_its_way_to() {
        let order = Order::GoTo { position_m: [20.0, 0.0, 10.0], yaw_deg: 0.0 };
        let leg = |off_m| Leg { order, place: Some([0.0; 3]), refused: None, off_m: Some(off_m) };
        let left = |legs: &[f64]| {
            let mut course = Course { legs: legs.iter().copied().map(leg).collect(), ..Course::default() };
            course.cut_off(3.0);
            course.legs.iter().map(|leg| leg.off_m).collect::<Vec<_>>()
        };
        assert_eq!(left(&[5.0, 12.0]), [Some(5.0), None], "only the last was on its way");
        assert_eq!(left(&[2.0]), [Some(2.0)], "reached");
        assert!(left(&[]).is_empty());
    }
}
