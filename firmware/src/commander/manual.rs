//! Flying by hand: when sticks arm, lift off, take over and are lost.
//!
//! Outer reads the sticks itself; here it is judged only what they mean for the state. On the ground the vehicle idles
//! until the throttle stick is raised, and idles again after a touchdown with the stick held down. An automatic mode ends
//! when a stick is moved. What the estimator has lost makes a manual mode a simpler one.

use super::watch::jobs;
use super::{Commander, CommanderInput, Event, Intent, Known, Override, Refusal, Request, State, StationAction};
use crate::guidance::hands::ManualMode;
use crate::latest::{MODE_POSITIONS, Sticks};
use crate::schedule::COMMANDER;
use crate::settings::{
    COM_FLTMODE1, COM_RC_LOSS_T, COM_RC_OVERRIDE, COM_RC_STICK_OV, MAN_ARM_GESTURE, NAV_RCL_ACT, Value,
};
use crate::signals::Tick;
use crate::{commander, math};

/// Throttle below which a stick that is the thrust counts as down, and above which it lifts the vehicle.
const DOWN: f32 = 0.1;
const LIFTS: f32 = 0.15;
/// The same for a stick whose centre holds the height.
const BELOW_CENTRE: f32 = 0.4;
const LIFTS_FROM_CENTRE: f32 = 0.65;
/// In the air a touchdown is looked for with a throttle below this: half the weight would not carry it.
const LANDS_BELOW: f32 = 0.4;
/// Yaw stick at its end, for a gesture, and how long it lasts, s.
const AT_END: f32 = 0.9;
const GESTURE_S: f32 = 1.0;
/// And the other one is in the middle within this.
const CENTRE: f32 = 0.2;
/// Bits of `COM_RC_OVERRIDE`.
const ENDS_AUTOMATIC: i32 = 1;
const ENDS_OFFBOARD: i32 = 2;

/// What sticks may do, by the settings, and what they did before.
#[derive(Clone, Debug)]
pub(super) struct Hand {
    loss_s: f32,
    lost: StationAction,
    gestures: bool,
    ends: i32,
    moved: f32,
    switch_modes: [i32; MODE_POSITIONS as usize],
    /// Positions of the switches in the last job with sticks.
    mode_before: Option<u8>,
    arm_before: Option<bool>,
    /// Jobs for which the gesture has lasted; negative for that which disarms.
    gesture: i16,
    /// The least deflections of roll, pitch and yaw since an automatic mode began.
    rest: Option<[f32; 3]>,
}

impl Default for Hand {
    fn default() -> Self {
        Self {
            loss_s: 0.5,
            lost: StationAction::Return,
            gestures: true,
            ends: ENDS_AUTOMATIC,
            moved: 0.3,
            switch_modes: [-1; MODE_POSITIONS as usize],
            mode_before: None,
            arm_before: None,
            gesture: 0,
            rest: None,
        }
    }
}

impl Hand {
    /// Takes over a setting, if it is one of these.
    pub(super) fn set(&mut self, index: usize, value: Value) {
        match index {
            COM_RC_LOSS_T => self.loss_s = value.real(),
            NAV_RCL_ACT => self.lost = StationAction::of(value.int()).unwrap_or(StationAction::Return),
            MAN_ARM_GESTURE => self.gestures = value.int() != 0,
            COM_RC_OVERRIDE => self.ends = value.int(),
            COM_RC_STICK_OV => self.moved = value.real() / 100.0,
            _ => {
                let position = index.checked_sub(COM_FLTMODE1).and_then(|at| self.switch_modes.get_mut(at));
                if let Some(mode) = position {
                    *mode = value.int();
                }
            }
        }
    }

    /// The sticks, unless they are lost.
    pub(super) fn sticks<'a>(&self, now: Tick, input: &'a CommanderInput) -> Option<&'a Sticks> {
        input.latest.sticks_within(now, self.loss_s)
    }

    /// What a switch asks for that was moved, or that is seen for the first time while `disarmed`.
    fn switched(&mut self, sticks: &Sticks, disarmed: bool) -> Option<Request> {
        let position = sticks.switches.mode;
        let before = core::mem::replace(&mut self.mode_before, position);
        if position == before || (before.is_none() && !disarmed) {
            return None;
        }
        let number = self.switch_modes.get(usize::from(position?))?;
        Some(match number {
            1 => Request::Manual(ManualMode::Altitude),
            2 => Request::Manual(ManualMode::Position),
            3 => Request::Follow,
            4 => Request::Hold,
            5 => Request::Return,
            7 => Request::Offboard,
            6 => Request::Manual(ManualMode::Acro),
            8 => Request::Manual(ManualMode::Stabilized),
            11 => Request::Land,
            _ => return None,
        })
    }

    /// Whether the pilot wants to arm or to disarm, by switch or gesture; none of them is repeated while it lasts.
    fn wants_armed(&mut self, sticks: &Sticks) -> Option<bool> {
        let switch = sticks.switches.arm;
        let before = core::mem::replace(&mut self.arm_before, switch);
        if switch != before && before.is_some() {
            return switch;
        }
        let leans = math::max(math::abs(sticks.roll), math::abs(sticks.pitch)) > CENTRE;
        if !self.gestures || sticks.throttle > DOWN || math::abs(sticks.yaw) < AT_END || leans {
            self.gesture = 0;
            return None;
        }
        // To the right is negative.
        let step = if sticks.yaw < 0.0 { 1 } else { -1 };
        self.gesture = if self.gesture.signum() == -step { step } else { self.gesture.saturating_add(step) };
        let lasts = i32::from(jobs(GESTURE_S));
        (i32::from(self.gesture).abs() == lasts).then_some(step > 0)
    }

    /// Whether a stick has been moved since an automatic mode began.
    fn has_moved(&mut self, sticks: &Sticks) -> bool {
        let now = [sticks.roll, sticks.pitch, sticks.yaw];
        let rest = self.rest.get_or_insert(now);
        let mut moved = false;
        for (rest, now) in rest.iter_mut().zip(now) {
            if math::abs(now) < math::abs(*rest) {
                *rest = now;
            }
            moved |= math::abs(now) > self.moved && math::abs(now - *rest) > self.moved;
        }
        moved
    }
}

impl Commander {
    /// What sticks do to the state.
    pub(super) fn take_sticks(&mut self, effective: Tick, input: &CommanderInput) -> Option<Event> {
        let now = effective.wrapping_sub(COMMANDER.offset);
        let Some(sticks) = self.hand.sticks(now, input).copied() else {
            (self.hand.gesture, self.hand.rest) = (0, None);
            return self.answer_lost_sticks(effective, input);
        };
        if let Some(request) = self.hand.switched(&sticks, self.state == State::Disarmed) {
            // A mode that is not possible now is not taken; what the vehicle does is told all the time.
            let _ = self.decide(&request, effective, input);
        }
        match self.hand.wants_armed(&sticks) {
            Some(true) => {
                let refused = match self.killed_until {
                    Some(_) => Err(Refusal::Killed),
                    None => self.arm(false, effective, input),
                };
                if let Err(refusal) = refused {
                    return Some(Event::ArmingRefused { refusal });
                }
            }
            Some(false) => {
                let _ = self.decide(&Request::Disarm, effective, input);
            }
            _ => {}
        }
        match (self.state, self.intent) {
            (State::Idle { .. }, Intent::Manual(mode)) if lifts(mode, &sticks) && self.has_spun_up(effective) => {
                if let Some(mode) = self.possible(mode, input) {
                    self.state = State::Manual(mode);
                }
            }
            (State::Manual(mode), _) => {
                // Where the sticks are when the next automatic mode begins is where they rest.
                self.hand.rest = None;
                return self.degrade(mode, input);
            }
            _ => {}
        }
        self.take_over(&sticks, effective, input);
        None
    }

    /// Ends an automatic mode once a stick is moved.
    fn take_over(&mut self, sticks: &Sticks, effective: Tick, input: &CommanderInput) {
        let kind = match self.state {
            State::Velocity { .. } | State::Offboard => ENDS_OFFBOARD,
            State::Disarmed | State::Idle { .. } | State::Manual(_) | State::Descent | State::MotorOut => 0,
            _ => ENDS_AUTOMATIC,
        };
        if self.hand.ends & kind == 0 {
            self.hand.rest = None;
        } else if self.hand.has_moved(sticks)
            && let Some(mode) = self.possible(ManualMode::Position, input)
        {
            self.engage(Intent::Manual(mode), effective, input);
        }
    }

    /// A manual mode, or the next simpler one that what is known of the motion allows.
    fn possible(&self, mode: ManualMode, input: &CommanderInput) -> Option<ManualMode> {
        let known = self.navigation.known();
        let simpler = match mode {
            ManualMode::Position if known > Known::Position => ManualMode::Altitude,
            mode => mode,
        };
        let simpler = match simpler {
            ManualMode::Altitude if known > Known::Climb => ManualMode::Stabilized,
            mode => mode,
        };
        (input.nav_fresh && input.health.attitude && !input.outer_hung).then_some(simpler)
    }

    /// A simpler mode when what a manual mode needs has been lost.
    fn degrade(&mut self, mode: ManualMode, input: &CommanderInput) -> Option<Event> {
        let possible = self.possible(mode, input).filter(|possible| *possible != mode)?;
        self.state = State::Manual(possible);
        Some(if possible == ManualMode::Altitude { Event::NoPositionMode } else { Event::NoAltitudeMode })
    }

    /// Answers the loss of the sticks in a manual mode.
    fn answer_lost_sticks(&mut self, effective: Tick, input: &CommanderInput) -> Option<Event> {
        let State::Manual(_) = self.state else { return None };
        let action = self.hand.lost;
        self.override_by(Override::SticksLost { action }, effective, &input.nav.position);
        Some(Event::SticksLost { action })
    }

    /// Whether a manual mode is possible: with sticks, and what it needs of the motion.
    pub(super) fn check_manual(&self, mode: ManualMode, now: Tick, input: &CommanderInput) -> Result<(), Refusal> {
        self.hand.sticks(now, input).ok_or(Refusal::NoSticks)?;
        match (self.possible(mode, input), mode) {
            (Some(possible), _) if possible == mode => Ok(()),
            (Some(_), ManualMode::Position) => Err(Refusal::NoPosition),
            (Some(_), _) => Err(Refusal::NoHeight),
            (None, _) if input.outer_hung => Err(Refusal::NoGuidance),
            (None, _) => Err(Refusal::NotAligned),
        }
    }

    /// Whether sticks and set-points let the vehicle be armed: a mode that needs them has them, and sticks would not lift it.
    pub(super) fn check_sticks(&self, now: Tick, input: &CommanderInput) -> Result<(), Refusal> {
        check_kill_switch(input)?;
        let sticks = self.hand.sticks(now, input);
        let mode = match self.intent {
            Intent::Manual(mode) => mode,
            Intent::Offboard => return self.check_stream(now, input),
            _ => return Ok(()),
        };
        let sticks = sticks.ok_or(Refusal::NoSticks)?;
        let is_down = if mode.has_direct_thrust() { sticks.throttle <= DOWN } else { !lifts(mode, sticks) };
        if is_down { Ok(()) } else { Err(Refusal::ThrottleUp) }
    }

    /// What is known of the motion if the sticks may be bringing the vehicle to the ground.
    pub(super) fn descends_by_hand(&self, mode: ManualMode, now: Tick, input: &CommanderInput) -> Option<Known> {
        let sticks = self.hand.sticks(now, input)?;
        let below = match (mode.has_direct_thrust(), self.ground.is_airborne()) {
            (true, true) => LANDS_BELOW,
            (true, false) => DOWN,
            (false, true) => BELOW_CENTRE,
            (false, false) => LIFTS_FROM_CENTRE,
        };
        (sticks.throttle < below).then_some(self.navigation.known())
    }
}

/// Whether no kill switch is on.
pub(super) fn check_kill_switch(input: &CommanderInput) -> Result<(), Refusal> {
    if input.latest.kill_switch { Err(Refusal::KillSwitch) } else { Ok(()) }
}

/// Whether the throttle stick lifts a vehicle that stands.
fn lifts(mode: commander::ManualMode, sticks: &Sticks) -> bool {
    sticks.throttle > if mode.has_direct_thrust() { LIFTS } else { LIFTS_FROM_CENTRE }
}
