//! Rotors that spin up: for a time after arming nothing lifts the vehicle, and a take-off that is asked for meanwhile waits.

use super::{Commander, CommanderInput, Event, Intent, State, has_come, ticks};
use crate::signals::Tick;

impl Commander {
    /// The rotors begin to turn.
    pub(super) fn begin_to_spin(&mut self, effective: Tick) {
        self.spins_until = (self.spin_up_s > 0.0).then(|| effective.wrapping_add(ticks(self.spin_up_s)));
    }

    /// Whether a flight may begin.
    pub(super) fn has_spun_up(&self, effective: Tick) -> bool {
        self.spins_until.is_none_or(|until| has_come(until, effective))
    }

    /// Begins a flight from the ground, at once or when the rotors have spun up.
    pub(super) fn launch(&mut self, intent: Intent, effective: Tick, input: &CommanderInput) {
        if self.has_spun_up(effective) {
            self.engage(intent, effective, input);
        } else {
            self.keep(intent, None);
        }
    }

    /// Begins the flight that has waited, if it is still possible; tells why not.
    pub(super) fn spin_up(&mut self, effective: Tick, input: &CommanderInput) -> Option<Event> {
        if self.spins_until.is_none() || !self.has_spun_up(effective) {
            return None;
        }
        self.spins_until = None;
        if !matches!(self.state, State::Idle { .. }) || !self.intent.leaves_ground() {
            return None;
        }
        let refused = self.check_take_off(&self.intent, input).err();
        if refused.is_none() {
            self.engage(self.intent, effective, input);
        } else {
            self.rest_intent();
        }
        refused.map(|refusal| Event::TakeOffRefused { refusal })
    }
}
