//! Turning one motor of a disarmed vehicle for a while, to see which it is and which way it turns.

use core::ops::RangeInclusive;

use super::manual::check_kill_switch;
use super::{Commander, CommanderInput, Refusal, State, has_come, ticks};
use crate::airframe::ROTORS;
use crate::signals::Tick;

/// Accepted speeds, as a fraction of the greatest: with the last the rotor has a tenth of its thrust.
const PARTS: RangeInclusive<f32> = 0.0..=0.3;
/// Accepted times, s.
const TIMES_S: RangeInclusive<f32> = 0.0..=10.0;

/// A motor that turns, and how fast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorTest {
    /// Which, from 0.
    pub rotor: u8,
    /// Its speed, as a fraction of the greatest.
    pub part: f32,
}

impl MotorTest {
    /// True if there is such a motor, and it is to turn slowly and not for long.
    pub(super) fn is_sane(self, seconds: f32) -> bool {
        usize::from(self.rotor) < ROTORS && PARTS.contains(&self.part) && TIMES_S.contains(&seconds)
    }
}

impl Commander {
    pub(super) fn test_motor(
        &mut self,
        test: MotorTest,
        seconds: f32,
        effective: Tick,
        input: &CommanderInput,
    ) -> Result<(), Refusal> {
        if self.state != State::Disarmed {
            return Err(Refusal::Armed);
        }
        if self.ground.is_airborne() {
            return Err(Refusal::InAir);
        }
        self.check_terminated()?;
        check_kill_switch(input)?;
        self.motor_test = Some((test, effective.wrapping_add(ticks(seconds))));
        Ok(())
    }

    /// The motor that turns at a tick. Arming, disarming and a kill stop it.
    pub(super) fn tested_motor(&mut self, effective: Tick) -> Option<MotorTest> {
        self.motor_test =
            self.motor_test.filter(|(_, until)| self.state == State::Disarmed && !has_come(*until, effective));
        self.motor_test.map(|(test, _)| test)
    }
}
