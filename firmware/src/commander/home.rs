//! Home: where a return leads.

use nalgebra::Vector3;

use super::{Commander, CommanderInput, Refusal, State};
use crate::math;

impl Commander {
    /// Sets home to a place, m, or to the present position; in the air, to the ground below: a home in the air would raise a
    /// return, and be raised again by the next.
    pub(super) fn set_home(&mut self, place: Option<[f32; 3]>, input: &CommanderInput) -> Result<(), Refusal> {
        self.check_position(input)?;
        let before = self.home;
        let mut here = input.nav.position;
        if self.ground.is_airborne() {
            here.z = self.ground_m();
        }
        self.home = place.map_or(here, Vector3::from);
        self.home_is_set = true;
        if self.home.z != before.z && matches!(self.state, State::Return { .. }) {
            // Sideways it follows home anyway.
            self.state = self.return_from(input.nav.position.z);
        }
        Ok(())
    }

    /// A return that begins at a height (z, m).
    pub(super) fn return_from(&self, height: f32) -> State {
        State::Return { at_m: math::max(self.home.z + self.settings.return_height_m, height), climbs: true }
    }

    /// Home, if it is known. A disarmed vehicle's home is where it stands: that is where it would be armed.
    pub(super) fn known_home(&self, input: &CommanderInput) -> Option<Vector3<f32>> {
        if self.home_is_set || self.state != State::Disarmed {
            return Some(self.home);
        }
        let stands = !self.ground.is_airborne() && self.check_position(input).is_ok();
        stands.then_some(input.nav.position)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commander::tests::standing;
    use crate::commander::{Command, Commands, Origin, Outcome, Request};
    use crate::config::{FlightConfig, Start};
    use crate::signals::{NavHealth, NavState};

    fn at(x: f32, commands: &[Request]) -> CommanderInput {
        let nav = NavState { position: Vector3::new(x, 0.0, 0.0), ..NavState::at_rest() };
        CommanderInput {
            nav,
            commands: commands
                .iter()
                .map(|request| Command { request: *request, origin: Origin::OnBoard })
                .collect::<Commands>(),
            ..standing()
        }
    }

    fn on_ground() -> Commander {
        Commander::new(&FlightConfig { start: Start::OnGround, ..FlightConfig::default() })
    }

    #[test]
    fn home_is_where_it_stands_until_it_is_armed_and_then_stays() {
        let mut commander = on_ground();
        let lost = NavHealth { position: false, ..NavHealth::ALL };
        assert_eq!(commander.step(0, &CommanderInput { health: lost, ..at(1.0, &[]) }).home, None);
        assert_eq!(commander.step(20, &at(1.0, &[])).home, Some(Vector3::new(1.0, 0.0, 0.0)));
        assert_eq!(commander.step(40, &at(2.0, &[])).home, Some(Vector3::new(2.0, 0.0, 0.0)));
        assert_eq!(commander.step(60, &at(3.0, &[Request::Arm { force: false }])).home, Some(Vector3::x() * 3.0));
        assert_eq!(commander.step(80, &at(4.0, &[])).home, Some(Vector3::x() * 3.0));
    }

    #[test]
    fn a_home_that_a_pilot_has_set_lasts_until_disarming() {
        let mut commander = on_ground();
        let set = Request::SetHome { position_m: Some([7.0, 8.0, 9.0]) };
        let place = Vector3::new(7.0, 8.0, 9.0);
        assert_eq!(commander.step(0, &at(1.0, &[set])).home, Some(place));
        assert_eq!(commander.step(20, &at(1.0, &[Request::Arm { force: false }])).home, Some(place), "armed elsewhere");
        let here = Request::SetHome { position_m: None };
        assert_eq!(commander.step(40, &at(2.0, &[here])).home, Some(Vector3::x() * 2.0));
        assert_eq!(commander.step(60, &at(3.0, &[Request::Disarm])).home, Some(Vector3::x() * 3.0), "where it stands");
    }

    #[test]
    fn home_is_not_set_to_what_is_unknown_or_far_away() {
        let mut commander = on_ground();
        let lost = NavHealth { position: false, ..NavHealth::ALL };
        let here = Request::SetHome { position_m: None };
        let output = commander.step(0, &CommanderInput { health: lost, ..at(0.0, &[here]) });
        assert_eq!(output.replies[0].outcome, Outcome::TemporarilyRejected(Refusal::NoPosition));
        for position_m in [[1e5, 0.0, 0.0], [0.0, f32::NAN, 0.0]] {
            let output = commander.step(20, &at(0.0, &[Request::SetHome { position_m: Some(position_m) }]));
            assert_eq!(output.replies[0].outcome, Outcome::Denied);
        }
    }
}
