//! Why a vehicle was disarmed. The firmware does not tell; what it puts out, and how it was at the look before, leave one
//! cause each time.

use firmware::commander::{CommanderOutput, Event, State};
use firmware::signals::Tick;

use crate::plant::rigid_body::RigidBody;
use crate::sil::Flight;

/// How the vehicle was at the last look.
#[derive(Clone, Debug)]
pub(super) struct Disarming {
    kills: u32,
    /// When it is disarmed by itself, while it idles.
    due: Option<Tick>,
    /// Whether it has been in the air since it was armed.
    has_flown: bool,
}

impl Disarming {
    /// From the present state of a flight.
    pub(super) fn new(flight: &Flight<RigidBody>) -> Self {
        let mut new = Self { kills: 0, due: None, has_flown: false };
        new.look(flight);
        new
    }

    /// Keeps how the vehicle is now in mind.
    pub(super) fn look(&mut self, flight: &Flight<RigidBody>) {
        let commander = flight.autopilot.inner.commander_output();
        self.kills = commander.kills;
        self.due = match flight.autopilot.commander.state() {
            State::Idle { disarm_at } => *disarm_at,
            _ => None,
        };
        self.has_flown = commander.armed && (self.has_flown || !commander.landed);
    }

    /// Why the vehicle, which was armed at the last look, is not any more. `asked_by` is whose request to disarm was accepted
    /// since.
    pub(super) fn why(&self, commander: &CommanderOutput, next_tick: Tick, asked_by: Option<&str>) -> String {
        // The output has come into effect in the tick before.
        let is_due = self.due.is_some_and(|due| next_tick.wrapping_sub(1).wrapping_sub(due) < Tick::MAX / 2);
        match asked_by {
            _ if commander.kills != self.kills => "killed".to_owned(),
            Some(who) => format!("by {who}"),
            None if commander.event == Some(Event::SensorsGone) => "no sensor data".to_owned(),
            None if is_due && self.has_flown => "after landing".to_owned(),
            None if is_due => "not flown since it was armed".to_owned(),
            // Nothing else is left.
            None => "by stick or switch".to_owned(),
        }
    }
}
