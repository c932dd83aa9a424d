//! Decisions on requests: refused with a reason, or the new intent and the state that it leads to.

use super::manual::check_kill_switch;
use super::ticks;
use super::{
    Commander, CommanderInput, Course, Goal, Intent, Outcome, Override, Refusal, Request, SpeedKind, State,
    VELOCITY_TIMEOUT_S,
};
use crate::schedule::COMMANDER;
use crate::signals::Tick;
use nalgebra::Vector3;

/// An intent to leave the ground is held for this time while disarmed, s. Ground stations ask for a take-off, wait for
/// the answer and arm then, which takes about a second on a slow link. A later arming must not launch the vehicle.
pub const LAUNCH_HELD_S: f32 = 5.0;

impl Commander {
    pub(super) fn decide(&mut self, request: &Request, effective: Tick, input: &CommanderInput) -> Outcome {
        if !request.is_sane() {
            return Outcome::Denied;
        }
        let done = match (request, Intent::of(request)) {
            (_, Some(intent)) => self.intend(intent, effective, input),
            (Request::Arm { force }, None) => self.arm(*force, effective, input),
            (Request::TestMotor { test, seconds }, None) => self.test_motor(*test, *seconds, effective, input),
            (Request::SetHome { position_m }, None) => self.set_home(*position_m, input),
            (Request::Speed { kind, speed_m_s }, None) => {
                self.speeds.choose(*kind, *speed_m_s);
                if let (State::GoTo(course) | State::Approach(course), SpeedKind::Horizontal) = (&mut self.state, kind)
                {
                    course.speed_m_s = None;
                }
                Ok(())
            }
            (_, None) => self.disarm(),
        };
        done.map_or_else(Outcome::TemporarilyRejected, |()| Outcome::Accepted)
    }

    /// Arms, and begins the flight that is intended.
    pub(super) fn arm(&mut self, force: bool, effective: Tick, input: &CommanderInput) -> Result<(), Refusal> {
        if let State::Idle { .. } = self.state {
            self.state = State::Idle { disarm_at: self.unused_until(effective) };
            // A take-off that waits for the rotors goes on waiting.
            if !self.intent.leaves_ground() {
                self.rest_intent();
            }
        }
        if self.state != State::Disarmed {
            return Ok(());
        }
        // Not even forced: nobody can know what it would do, or somebody does not want it.
        self.check_configured()?;
        self.check_terminated()?;
        check_kill_switch(input)?;
        let intent = self.intent;
        let launch = if intent.leaves_ground() { self.check_take_off(&intent, input) } else { Ok(()) };
        if !force {
            self.check(input)?;
            self.check_sticks(effective.wrapping_sub(COMMANDER.offset), input)?;
            launch?;
        }
        if !self.home_is_set {
            self.home = input.nav.position;
        }
        self.battery_answered = super::Charge::Good;
        self.station.rearm();
        self.begin_to_spin(effective);
        self.state = State::Idle { disarm_at: self.unused_until(effective) };
        self.stood_m = Some(input.nav.position.z);
        if intent.leaves_ground() && launch.is_ok() {
            self.launch(intent, effective, input);
        } else {
            self.rest_intent();
        }
        Ok(())
    }

    fn disarm(&mut self) -> Result<(), Refusal> {
        if self.state != State::Disarmed && self.ground.is_airborne() {
            return Err(Refusal::InAir);
        }
        self.stop();
        Ok(())
    }

    /// A request to take off, move, hold or land.
    fn intend(&mut self, intent: Intent, effective: Tick, input: &CommanderInput) -> Result<(), Refusal> {
        match self.state {
            State::Disarmed => self.intend_disarmed(intent, effective, input),
            State::Idle { .. } => self.intend_idle(intent, effective, input),
            // Its rotors turn, and it stands.
            standing @ (State::Manual(_) | State::Offboard) if !self.ground.is_airborne() => {
                self.state = State::Idle { disarm_at: self.unused_until(effective) };
                let done = self.intend_idle(intent, effective, input);
                if done.is_err() {
                    self.state = standing;
                }
                done
            }
            _ => self.intend_flying(intent, effective, input),
        }
    }

    /// Kept for the flight to come.
    fn intend_disarmed(&mut self, intent: Intent, effective: Tick, input: &CommanderInput) -> Result<(), Refusal> {
        match intent {
            Intent::Hold | Intent::Land | Intent::Manual(_) => self.keep(intent, None),
            Intent::Offboard => {
                self.check_stream(effective.wrapping_sub(COMMANDER.offset), input)?;
                self.keep(intent, None);
            }
            Intent::TakeOff { .. } | Intent::Follow => {
                self.check_take_off(&intent, input)?;
                self.keep(intent, Some(effective.wrapping_add(ticks(LAUNCH_HELD_S))));
            }
            Intent::LandAt(_) => self.keep(Intent::Land, None),
            Intent::GoTo(_) | Intent::Orbit(_) | Intent::Velocity { .. } | Intent::Return => {
                return Err(Refusal::Disarmed);
            }
        }
        Ok(())
    }

    fn intend_idle(&mut self, intent: Intent, effective: Tick, input: &CommanderInput) -> Result<(), Refusal> {
        match intent {
            Intent::Hold | Intent::Manual(_) => self.keep(intent, None),
            Intent::Offboard => {
                self.check_stream(effective.wrapping_sub(COMMANDER.offset), input)?;
                self.keep(intent, None);
            }
            // On the ground it is landed already, and is disarmed as after a landing.
            Intent::Land | Intent::LandAt(_) => {
                self.keep(Intent::Land, None);
                self.state = State::Idle { disarm_at: Some(self.after_landing(effective)) };
            }
            Intent::TakeOff { .. } | Intent::Follow => {
                self.check_take_off(&intent, input)?;
                self.launch(intent, effective, input);
            }
            Intent::GoTo(_) | Intent::Orbit(_) | Intent::Velocity { .. } | Intent::Return => {
                return Err(Refusal::OnGround);
            }
        }
        Ok(())
    }

    fn intend_flying(&mut self, intent: Intent, effective: Tick, input: &CommanderInput) -> Result<(), Refusal> {
        let is_simpler = matches!(intent, Intent::Manual(mode) if self.state != State::Manual(mode));
        if self.pursued() == Some(intent) && !is_simpler && !matches!(intent, Intent::Velocity { .. }) {
            // It does so already: a repetition changes nothing, and what a failure has begun is now the pilot's.
            if let (State::GoTo(course), Intent::GoTo(Goal { speed_m_s: Some(speed_m_s), .. })) =
                (&mut self.state, intent)
            {
                course.speed_m_s = Some(speed_m_s);
            }
            self.keep(intent, None);
            self.overridden = None;
            return Ok(());
        }
        match (self.state, intent) {
            // It comes down already, by what is known and what works.
            (State::Descent | State::MotorOut, Intent::Land) | (State::MotorOut, Intent::LandAt(_)) => {
                self.keep(intent, None);
                return Ok(());
            }
            (State::MotorOut, _) => return Err(Refusal::RotorFailed),
            // A turn is no reason to end a landing, a circle, or what a failure has begun.
            (state, Intent::GoTo(goal)) if goal.is_turn() && !matches!(state, State::Hold | State::GoTo(_)) => {
                return Err(Refusal::NotHolding);
            }
            // A take-off takes another height.
            (State::TakeOff { .. }, Intent::TakeOff { .. }) | (_, Intent::Land) => {}
            (_, Intent::TakeOff { .. }) => return Err(Refusal::InAir),
            (_, Intent::Manual(mode)) => self.check_manual(mode, effective.wrapping_sub(COMMANDER.offset), input)?,
            (_, Intent::Offboard) => self.check_stream(effective.wrapping_sub(COMMANDER.offset), input)?,
            _ => self.check_position(input)?,
        }
        self.engage(intent, effective, input);
        Ok(())
    }

    /// What the vehicle works towards: the pilot's intent, or what a failure has put in its place.
    fn pursued(&self) -> Option<Intent> {
        self.overridden.map_or(Some(self.intent), Override::pursues)
    }

    /// Notes an intent, to be forgotten at `until`.
    pub(super) fn keep(&mut self, intent: Intent, until: Option<Tick>) {
        (self.intent, self.until) = (intent, until);
    }

    /// As before the first request.
    pub(super) fn forget_intent(&mut self) {
        self.keep(Intent::Hold, None);
        self.overridden = None;
    }

    /// After a landing or a disarming, and with an arming that begins no flight: a manual mode stays.
    pub(super) fn rest_intent(&mut self) {
        match self.intent {
            Intent::Manual(_) | Intent::Offboard => self.overridden = None,
            _ => self.forget_intent(),
        }
    }

    /// Begins with what the pilot wants, and ends what has overridden it.
    pub(super) fn engage(&mut self, intent: Intent, effective: Tick, input: &CommanderInput) {
        self.state = self.state_for(&intent, effective, &input.nav.position);
        let expires = matches!(intent, Intent::Velocity { .. });
        self.keep(intent, expires.then(|| effective.wrapping_add(ticks(VELOCITY_TIMEOUT_S))));
        self.overridden = None;
    }

    /// A failure takes over; the intent is kept.
    pub(super) fn override_by(&mut self, failure: Override, effective: Tick, here: &Vector3<f32>) {
        self.state = match failure {
            Override::Loss { .. } | Override::OuterHung => State::Descent,
            Override::RotorFailed => State::MotorOut,
            Override::BatteryLow => self.state_for(&Intent::Return, effective, here),
            Override::BatteryCritical => State::Land,
            Override::StationLost { action } | Override::SticksLost { action } | Override::SetPointsLost { action } => {
                self.state_for(&action.pursues(), effective, here)
            }
            Override::SensorsGone => State::Disarmed,
        };
        self.overridden = Some(failure);
    }

    /// The state that an intent leads to, of a vehicle at a place.
    fn state_for(&self, intent: &Intent, effective: Tick, here: &Vector3<f32>) -> State {
        let height = here.z;
        match *intent {
            Intent::TakeOff { height_m } => {
                let from_m = if let State::TakeOff { from_m, .. } = self.state { from_m } else { height };
                State::TakeOff { from_m, to_m: from_m + height_m }
            }
            Intent::GoTo(goal) => State::GoTo(self.course_to(&goal, height)),
            Intent::LandAt(goal) => State::Approach(self.course_to(&goal, height)),
            Intent::Velocity { velocity, yaw_rate } => State::Velocity { velocity, yaw_rate },
            Intent::Return => self.return_from(height),
            Intent::Follow if matches!(self.state, State::Idle { .. }) => State::Follow { since: effective },
            Intent::Follow => State::Join,
            Intent::Land => State::Land,
            Intent::Hold => State::Hold,
            Intent::Manual(mode) => State::Manual(mode),
            Intent::Offboard => State::Offboard,
            Intent::Orbit(goal) => State::Orbit(self.orbit(&goal, here)),
        }
    }

    /// The course to a goal, at a height (z, m): what the goal leaves open is as on the course before.
    fn course_to(&self, goal: &Goal, height: f32) -> Course {
        let before = match self.state {
            State::GoTo(course) => course,
            State::TakeOff { to_m, .. } => Course { place_m: None, height_m: to_m, yaw: None, speed_m_s: None },
            _ => Course { place_m: None, height_m: height, yaw: None, speed_m_s: None },
        };
        // Another place is gone to with the usual speed, unless one is given.
        let kept_m_s = if goal.place_m.is_none() { before.speed_m_s } else { None };
        Course {
            place_m: goal.place_m.or(before.place_m),
            height_m: goal.height_m.unwrap_or(before.height_m),
            yaw: goal.yaw_rad.or(before.yaw),
            speed_m_s: goal.speed_m_s.or(kept_m_s),
        }
    }
}
