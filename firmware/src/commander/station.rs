//! The loss of the ground station: what is done when none is heard any more.

use super::{Commander, CommanderInput, Event, Intent, Override, State};
use crate::latest::is_older;
use crate::settings::{COM_DL_LOSS_T, NAV_DLL_ACT, Value};
use crate::signals::Tick;

/// What is done without a ground station.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StationAction {
    /// Hold the place.
    Hold,
    /// Return home, and land.
    Return,
    /// Land at once.
    Land,
}

impl StationAction {
    /// By its number in `NAV_DLL_ACT`; `None` for 0, nothing.
    pub(super) fn of(number: i32) -> Option<Self> {
        match number {
            1 => Some(Self::Hold),
            2 => Some(Self::Return),
            3 => Some(Self::Land),
            _ => None,
        }
    }

    /// The intent that it replaces the pilot's with.
    pub(super) fn pursues(self) -> Intent {
        match self {
            Self::Hold => Intent::Hold,
            Self::Return => Intent::Return,
            Self::Land => Intent::Land,
        }
    }
}

/// When the ground station counts as lost, and what is done then.
#[derive(Clone, Debug, Default)]
pub(super) struct StationLoss {
    action: Option<StationAction>,
    /// Silence after which it is lost, s.
    after_s: f32,
    /// Whether this silence has been answered. It is answered once, so that the pilot can override it.
    answered: bool,
}

impl StationLoss {
    /// Takes over a setting, if it is one of these.
    pub(super) fn set(&mut self, index: usize, value: Value) {
        match index {
            NAV_DLL_ACT => self.action = StationAction::of(value.int()),
            COM_DL_LOSS_T => self.after_s = value.real(),
            _ => {}
        }
    }

    /// For a new flight.
    pub(super) fn rearm(&mut self) {
        self.answered = false;
    }
}

impl Commander {
    /// Answers the silence of the ground station, at `now`, once. One that was never heard is not missed.
    pub(super) fn answer_silence(&mut self, now: Tick, effective: Tick, input: &CommanderInput) -> Option<Event> {
        let (action, heard_at) = (self.station.action?, input.latest.station?);
        if !is_older(heard_at, now, self.station.after_s) {
            self.station.answered = false;
        } else if !self.station.answered && self.flies_by_itself() {
            self.station.answered = true;
            self.override_by(Override::StationLost { action }, effective, &input.nav.position);
            return Some(Event::StationLost { action });
        }
        None
    }

    /// Whether it goes on with what nobody may be watching. A vehicle that comes down or returns does not, nor does one that
    /// set-points have not lifted.
    fn flies_by_itself(&self) -> bool {
        let stands = self.state == State::Offboard && !self.ground.is_airborne();
        !stands
            && !matches!(
                self.state,
                State::Disarmed
                    | State::Idle { .. }
                    | State::Manual(_)
                    | State::Return { .. }
                    | State::Land
                    | State::Descent
                    | State::MotorOut
            )
    }
}
