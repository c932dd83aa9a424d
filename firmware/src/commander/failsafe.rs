//! Responses to failures: what overrides the intent of the pilot.

use super::{Charge, Commander, CommanderInput, Event, Known, Override, State};
use crate::schedule::COMMANDER;
use crate::signals::Tick;
use nalgebra::Vector3;

impl Commander {
    /// Failsafes, the most severe first.
    pub(super) fn fail_safe(&mut self, effective: Tick, input: &CommanderInput) -> Option<Event> {
        if matches!(self.state, State::Disarmed | State::Idle { .. }) {
            return None;
        }
        let here = &input.nav.position;
        if self.navigation.is_gone() {
            self.stop();
            self.override_by(Override::SensorsGone, effective, here);
            return Some(Event::SensorsGone);
        }
        if self.state == State::MotorOut {
            return None;
        }
        if let Some(rotor) = input.failed_rotor {
            self.override_by(Override::RotorFailed, effective, here);
            return Some(Event::RotorFailed { rotor });
        }
        let event = self.answer_loss(effective, input);
        // The inner loop has reported it.
        if input.outer_hung && self.state != State::Descent {
            self.override_by(Override::OuterHung, effective, here);
        }
        event
            .or_else(|| self.answer_battery(effective, here))
            .or_else(|| self.answer_silence(effective.wrapping_sub(COMMANDER.offset), effective, input))
    }

    fn answer_loss(&mut self, effective: Tick, input: &CommanderInput) -> Option<Event> {
        let known = self.navigation.known();
        if let State::Manual(_) = self.state
            && self.overridden.is_none()
            && input.nav_fresh
            && input.health.attitude
        {
            // The pilot flies on, in a mode that is simple enough.
            return None;
        }
        let before = match self.overridden {
            Some(Override::Loss { known }) => known,
            _ if known == Known::Position => return None,
            _ => Known::Position,
        };
        self.override_by(Override::Loss { known }, effective, &input.nav.position);
        (known > before).then_some(match known {
            Known::Position | Known::Velocity => Event::PositionLost,
            Known::Height => Event::VelocityLost,
            Known::Attitude if !input.nav_fresh => Event::SensorsLost,
            Known::Attitude if !input.health.attitude => Event::AttitudeLost,
            Known::Climb | Known::Attitude => Event::HeightLost,
        })
    }

    /// Each level acts once, so that the pilot can override it.
    fn answer_battery(&mut self, effective: Tick, here: &Vector3<f32>) -> Option<Event> {
        let charge = self.battery.charge();
        if charge <= self.battery_answered {
            return None;
        }
        let (failure, event) = match charge {
            Charge::Good => return None,
            Charge::Low => (Override::BatteryLow, Event::BatteryLow),
            Charge::Critical => (Override::BatteryCritical, Event::BatteryCritical),
        };
        match (charge, self.state) {
            // It is already descending. If the pilot takes over, the failsafe still has to act.
            (_, State::Land | State::Descent) => return None,
            // The pilot has come first.
            (Charge::Low, State::Return { .. }) => {}
            _ => self.override_by(failure, effective, here),
        }
        self.battery_answered = charge;
        Some(event)
    }
}
