//! Events of a flight, reported as they happen.
//!
//! The texts are the firmware's where it has them ([`Mode::name`], [`Event::text`], [`Refusal::reason`]). Touchdowns
//! are taken from the plant's true motion in every tick; everything else 50 times per second, when the commander's
//! output takes effect.

use firmware::commander::{Event, Mode, Refusal};
use firmware::schedule::COMMANDER;
use firmware::signals::{TICK_S_EXACT, Tick};
use nalgebra::Vector3;

use super::disarming::Disarming;
use super::line::Tone;
use crate::failures::Equipment;
use crate::outcome::Contact;
use crate::plant::rigid_body::RigidBody;
use crate::plant::{Motion, Plant as _};
use crate::record::{Recorder as _, Row};
use crate::report::mission::{self, REACHED_BY_GNSS_M};
use crate::report::timeline::fault_name;
use crate::sensors::Fault;
use crate::sil::Flight;
use crate::touchdown::{HARDEST_M_S, Touchdown};

/// Whether the commander's output has come into effect in the tick before this one.
pub(super) fn is_due(next_tick: Tick) -> bool {
    next_tick.wrapping_sub(1) % COMMANDER.period == COMMANDER.offset % COMMANDER.period
}

/// A state that may flicker is reported after it has lasted this long, ticks.
const LASTED: Tick = 500;
/// A touchdown that the vehicle has not detected is reported after this time, s.
const UNAWARE_AFTER_S: f64 = 5.0;

/// A value that is reported after it has lasted [`LASTED`].
#[derive(Clone, Debug)]
struct Steady<T> {
    told: Option<T>,
    seen: Option<(T, Tick)>,
}

impl<T: Copy + PartialEq> Steady<T> {
    const fn new() -> Self {
        Self { told: None, seen: None }
    }

    /// Takes the present value; returns it if it is to be reported.
    fn see(&mut self, tick: Tick, value: T) -> Option<T> {
        let since = match self.seen {
            Some((seen, since)) if seen == value => since,
            _ => tick,
        };
        self.seen = Some((value, since));
        let lasted = tick.wrapping_sub(since) >= LASTED;
        (lasted && self.told != Some(value)).then(|| *self.told.insert(value))
    }
}

/// Compares a flight with its state at the last look.
#[derive(Clone, Debug)]
pub struct Watch {
    armed: bool,
    disarming: Disarming,
    landed: bool,
    mode: Mode,
    ready: Steady<Result<(), Refusal>>,
    /// Why it could not be armed, since it last could.
    reasons: Vec<Refusal>,
    position: Steady<bool>,
    /// Whether it was told that the position is unknown, and not yet that it is known again.
    lost: bool,
    /// Where home is, m: the true position where it was armed. None once another place was made home: where that truly is
    /// the vehicle does not know.
    home: Option<Vector3<f64>>,
    /// Where it was armed: the true position, and what the vehicle took it for, m.
    armed_at: (Vector3<f64>, Vector3<f32>),
    touchdown: Option<Touchdown>,
    /// The last touchdown and its place, until it is reported.
    contact: Option<(Contact, Vector3<f64>)>,
    looked_at: Tick,
}

impl Watch {
    /// Starts from the present state of a flight.
    pub fn new(flight: &Flight<RigidBody>) -> Self {
        let commander = flight.autopilot.inner.commander_output();
        Self {
            armed: commander.armed,
            disarming: Disarming::new(flight),
            landed: commander.landed,
            mode: commander.mode,
            ready: Steady::new(),
            reasons: Vec::new(),
            position: Steady { told: Some(true), seen: None },
            lost: false,
            home: Some(flight.plant().motion().position),
            armed_at: stood(flight),
            touchdown: touchdown(flight),
            contact: None,
            looked_at: 0,
        }
    }

    /// Looks for a touchdown after a tick.
    pub fn step(&mut self, flight: &Flight<RigidBody>) {
        let Some(touchdown) = &mut self.touchdown else { return };
        let motion = flight.plant().motion();
        let t_s = f64::from(flight.next_tick()) * TICK_S_EXACT;
        touchdown.record(&Row::of_motion(t_s, &motion));
        if let Some(contact) = touchdown.first() {
            let contact = self.contact.as_ref().map_or(contact, |(before, _)| contact.and(before));
            self.contact = Some((contact, motion.position));
            self.touchdown = self::touchdown(flight);
        }
    }

    /// Reports what has changed since the last look. `disarmed_by` is whose request to disarm was accepted since.
    pub fn look(&mut self, flight: &Flight<RigidBody>, disarmed_by: Option<&str>, tell: &mut impl FnMut(Tone, String)) {
        self.look_at_faults(flight, tell);
        if let Some(event) = flight.autopilot.inner.commander_output().event {
            match event {
                Event::ArmingRefused { refusal } => {
                    tell(Tone::Plain, format!("sticks: arm: refused, {}", refusal.reason()));
                }
                Event::TakeOffRefused { refusal } => {
                    tell(Tone::Plain, format!("take-off: refused, {}", refusal.reason()));
                }
                _ => tell(Tone::Alarm, failsafe(event)),
            }
            if let Event::RotorFailed { rotor } = event
                && !has_failed(flight, usize::from(rotor))
            {
                tell(Tone::Plain, mission::no_rotor_failed(usize::from(rotor)));
            }
        }
        self.look_at_ground(flight, tell);
        self.look_at_mode(flight, disarmed_by, tell);
        self.look_at_health(flight, tell);
        self.looked_at = flight.next_tick();
    }

    /// Reports faults that have begun, or have ended at their time.
    fn look_at_faults(&self, flight: &Flight<RigidBody>, tell: &mut impl FnMut(Tone, String)) {
        let Some(suite) = flight.sensors() else { return };
        let tick = |seconds: f64| (seconds / TICK_S_EXACT).round() as Tick;
        let new = self.looked_at..flight.next_tick();
        for fault in suite.faults().list(self.looked_at) {
            if new.contains(&tick(fault.from_s)) {
                tell(Tone::Alarm, format!("fault: {}", fault_name(&fault)));
            }
            if fault.to_s.is_some_and(|to_s| new.contains(&tick(to_s))) {
                tell(Tone::Good, format!("fault ends: {}", fault_name(&fault)));
            }
        }
    }

    fn look_at_ground(&mut self, flight: &Flight<RigidBody>, tell: &mut impl FnMut(Tone, String)) {
        let commander = flight.autopilot.inner.commander_output();
        let landed = commander.landed;
        if let (true, true, Some(home)) = (self.armed, commander.armed, commander.home) {
            let (position, believed) = self.armed_at;
            let is_here = (home - believed).xy().norm() < HERE_M;
            self.home = is_here.then_some(position);
        }
        if let Some((contact, place)) = self.contact
            && contact.descent_m_s >= HARDEST_M_S
        {
            let how = self.describe(&contact, &place);
            tell(Tone::Alarm, format!("CRASHED: {how}"));
            self.contact = None;
        }
        if landed && !self.landed {
            let how = self.contact.take().map(|(contact, place)| self.describe(&contact, &place));
            tell(Tone::Good, how.map_or_else(|| "landed".to_owned(), |how| format!("landed: {how}")));
        } else if self.landed && !landed {
            tell(Tone::Plain, "in the air".to_owned());
        }
        self.landed = landed;
        let now_s = f64::from(flight.next_tick()) * TICK_S_EXACT;
        if let Some((contact, place)) = self.contact
            && now_s - contact.t_s >= UNAWARE_AFTER_S
        {
            if commander.armed && stands(flight) {
                let how = self.describe(&contact, &place);
                tell(Tone::Alarm, format!("on the ground without knowing it: {how}; `kill` stops the rotors"));
            }
            self.contact = None;
        }
    }

    fn describe(&self, contact: &Contact, place: &Vector3<f64>) -> String {
        let away = self.home.map(|home| format!(", {:.2} m from home", (place - home).xy().norm()));
        format!("touched down at {:.2} m/s{}", contact.descent_m_s, away.unwrap_or_default())
    }

    fn look_at_mode(
        &mut self,
        flight: &Flight<RigidBody>,
        disarmed_by: Option<&str>,
        tell: &mut impl FnMut(Tone, String),
    ) {
        let commander = flight.autopilot.inner.commander_output();
        let (armed, mode) = (commander.armed, commander.mode);
        match (self.armed, armed) {
            (false, true) => {
                self.armed_at = stood(flight);
                self.home = Some(self.armed_at.0);
                tell(Tone::Plain, "armed: the rotors idle".to_owned());
                if mode != Mode::Idle {
                    tell(Tone::Plain, format!("mode: {} → {}", Mode::Idle.name(), mode.name()));
                }
            }
            (true, false) => {
                let why = self.disarming.why(commander, flight.next_tick(), disarmed_by);
                if commander.landed || stands(flight) {
                    tell(Tone::Good, format!("disarmed: {why}"));
                } else {
                    tell(Tone::Alarm, format!("disarmed in the air: {why}; the rotors are stopped"));
                }
            }
            _ if mode != self.mode => tell(Tone::Plain, format!("mode: {} → {}", self.mode.name(), mode.name())),
            _ => {}
        }
        (self.armed, self.mode) = (armed, mode);
        self.disarming.look(flight);
    }

    /// Reports whether it can be armed; while armed, whether it knows its position.
    fn look_at_health(&mut self, flight: &Flight<RigidBody>, tell: &mut impl FnMut(Tone, String)) {
        let (tick, vehicle) = (flight.next_tick(), &flight.autopilot.inner);
        let commander = vehicle.commander_output();
        let position = self.position.see(tick, vehicle.nav_health().position);
        if let Some(text) = position.and_then(|known| position_text(&mut self.lost, known, commander.armed)) {
            let (tone, off) = if self.lost { (Tone::Alarm, String::new()) } else { (Tone::Good, off_text(flight)) };
            tell(tone, format!("{text}{off}"));
        }
        if commander.armed {
            return;
        }
        if let Some(ready) = self.ready.see(tick, commander.armable)
            && let Some((tone, text)) = ready_text(&mut self.reasons, ready)
        {
            let off = if ready.is_ok() { off_text(flight) } else { String::new() };
            tell(tone, format!("{text}{off}"));
        }
    }
}

/// A home this near to where it was armed is that place, m: the vehicle's estimate wanders.
const HERE_M: f32 = 0.5;

/// Where it is: its true position, and what the vehicle takes it for, m.
fn stood(flight: &Flight<RigidBody>) -> (Vector3<f64>, Vector3<f32>) {
    (flight.plant().motion().position, flight.autopilot.inner.nav().position)
}

/// Positions that are further off than receivers in the open wander are told, m.
const FAR_OFF_M: f64 = REACHED_BY_GNSS_M;

/// How far the vehicle's position is off the truth, where that is far: it does not know it.
pub(super) fn off_text(flight: &Flight<RigidBody>) -> String {
    let off_m = (flight.plant().motion().position - flight.autopilot.inner.nav().position.cast()).norm();
    if off_m > FAR_OFF_M { format!(", {off_m:.1} m off the truth") } else { String::new() }
}

/// What is said of whether it can be armed: each reason why not once, until it can. After a crash they take turns.
fn ready_text(reasons: &mut Vec<Refusal>, ready: Result<(), Refusal>) -> Option<(Tone, String)> {
    let Err(refusal) = ready else {
        reasons.clear();
        return Some((Tone::Good, "ready to arm".to_owned()));
    };
    let is_new = !reasons.contains(&refusal);
    is_new.then(|| {
        reasons.push(refusal);
        (Tone::Refused, format!("not ready to arm: {}", refusal.reason()))
    })
}

/// What is said of a position that has become known or unknown. On the ground whether it may be armed tells of one that
/// is unknown; what was lost in the air is found again when it is, and not when the vehicle is armed the next time.
fn position_text(lost: &mut bool, known: bool, armed: bool) -> Option<&'static str> {
    let was_lost = std::mem::replace(lost, !known && (*lost || armed));
    if known {
        was_lost.then_some("navigation: position known again")
    } else {
        (armed && !was_lost).then_some("navigation: position unknown")
    }
}

/// Whether it is on the ground, whatever it believes.
fn stands(flight: &Flight<RigidBody>) -> bool {
    let Motion { position, attitude, .. } = flight.plant().motion();
    flight.plant().ground().is_some_and(|ground| ground.touches(&position, &attitude))
}

/// A detector of the next touchdown, if there is a ground.
fn touchdown(flight: &Flight<RigidBody>) -> Option<Touchdown> {
    flight.plant().ground().cloned().map(Touchdown::new)
}

/// Whether a fault has ever acted on a rotor (from 0).
fn has_failed(flight: &Flight<RigidBody>, rotor: usize) -> bool {
    let now_s = f64::from(flight.next_tick()) * TICK_S_EXACT;
    let is_of = |fault: &Fault| Equipment::Rotors(Some(rotor)).has(fault) && fault.from_s <= now_s;
    flight.sensors().is_some_and(|suite| suite.faults().list(0).any(|fault| is_of(&fault)))
}

/// The firmware's text for a failure, as the console prints it.
fn failsafe(event: Event) -> String {
    let text = event.text();
    let mut letters = text.chars();
    let first = letters.next().map(|letter| letter.to_ascii_lowercase());
    format!("failsafe: {}{}", first.unwrap_or_default(), letters.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_position_lost_in_the_air_is_found_again_on_the_ground_and_one_unknown_before_arming_is_not() {
        let mut lost = false;
        let mut say = |known, armed| position_text(&mut lost, known, armed);
        assert_eq!([say(false, false), say(true, false)], [None, None], "before the first fix");
        assert_eq!(say(false, true), Some("navigation: position unknown"));
        assert_eq!(say(true, false), Some("navigation: position known again"));
        assert_eq!(say(true, true), None, "armed again");
    }

    #[test]
    fn reasons_that_take_turns_are_told_once_until_it_can_be_armed() {
        let mut reasons = Vec::new();
        let mut says = |ready| ready_text(&mut reasons, ready).map(|(_, text)| text);
        let (level, moving) = (Err(Refusal::NotLevel), Err(Refusal::Moving));
        let told: Vec<String> =
            [level, moving, level, moving, Ok(()), level].into_iter().filter_map(&mut says).collect();
        let not_ready = |reason: &str| format!("not ready to arm: {reason}");
        let expected = [
            not_ready("vehicle not level"),
            not_ready("vehicle moving"),
            "ready to arm".to_owned(),
            not_ready("vehicle not level"),
        ];
        assert_eq!(told, expected);
    }

    #[test]
    fn what_flickers_is_told_once_it_has_lasted() {
        let mut steady = Steady::new();
        let told: Vec<(Tick, bool)> = (0..4000)
            .step_by(20)
            .filter_map(|tick| {
                let value = match tick {
                    0..1000 => false,
                    1000..2000 => tick % 200 < 100,
                    _ => true,
                };
                steady.see(tick, value).map(|value| (tick, value))
            })
            .collect();
        assert_eq!(told, [(500, false), (2500, true)]);
    }
}
