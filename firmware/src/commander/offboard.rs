//! Offboard mode: the vehicle follows the set-points that a companion computer streams.
//!
//! A stream must be there before the mode is taken, and for arming in it. On the ground the vehicle idles until a
//! set-point asks for going up; a set-point at or below the ground brings it down to idling again. Once the stream is lost,
//! `COM_OBL_RC_ACT` says what is done.

use super::steer::GROUND_M;
use super::{Commander, CommanderInput, Event, Intent, Known, ManualMode, Override, Refusal, State, StationAction};
use crate::latest::SetPoint;
use crate::schedule::COMMANDER;
use crate::settings::{COM_OBL_RC_ACT, COM_OF_LOSS_T, Value};
use crate::signals::Tick;

/// A set-point asks for going up when it is this far above the vehicle, m, or faster than this upwards, m/s.
const UP_M: f32 = 0.2;
const UP_M_S: f32 = 0.1;
/// And with this acceleration upwards, m/s², if neither is given.
const UP_M_S2: f32 = 0.3;
/// A thrust above this lifts the vehicle, and one below this part of what it hovers with may be a landing.
const LIFTS: f32 = 0.15;
const LANDS: f32 = 0.8;

/// When set-points count as lost, and what is done then.
#[derive(Clone, Debug)]
pub(super) struct Stream {
    loss_s: f32,
    lost: Lost,
}

/// What is done when set-points are lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Lost {
    /// A manual mode, as long as there are sticks; else hold.
    ByHand(ManualMode),
    Action(StationAction),
}

impl Default for Stream {
    fn default() -> Self {
        Self { loss_s: 1.0, lost: Lost::Action(StationAction::Hold) }
    }
}

impl Stream {
    /// Takes over a setting, if it is one of these.
    pub(super) fn set(&mut self, index: usize, value: Value) {
        match index {
            COM_OF_LOSS_T => self.loss_s = value.real(),
            COM_OBL_RC_ACT => {
                self.lost = match value.int() {
                    0 => Lost::ByHand(ManualMode::Position),
                    1 => Lost::ByHand(ManualMode::Altitude),
                    2 => Lost::ByHand(ManualMode::Stabilized),
                    3 => Lost::Action(StationAction::Return),
                    4 => Lost::Action(StationAction::Land),
                    _ => Lost::Action(StationAction::Hold),
                }
            }
            _ => {}
        }
    }
}

impl Commander {
    /// The set-point, unless it is lost.
    fn setpoint<'a>(&self, now: Tick, input: &'a CommanderInput) -> Option<&'a SetPoint> {
        input.latest.setpoint_within(now, self.stream.loss_s)
    }

    /// Whether there is a stream whose set-points can be followed with what is known of the motion.
    pub(super) fn check_stream(&self, now: Tick, input: &CommanderInput) -> Result<(), Refusal> {
        match self.setpoint(now, input).ok_or(Refusal::NoSetPoints)? {
            SetPoint::Motion { .. } => self.check_position(input),
            SetPoint::Attitude(_) if input.outer_hung => Err(Refusal::NoGuidance),
            SetPoint::Attitude(_) if input.nav_fresh && input.health.attitude => Ok(()),
            SetPoint::Attitude(_) => Err(Refusal::NotAligned),
        }
    }

    /// What set-points do to the state: they lift a vehicle that stands; their loss is answered.
    pub(super) fn take_setpoints(&mut self, effective: Tick, input: &CommanderInput) -> Option<Event> {
        let now = effective.wrapping_sub(COMMANDER.offset);
        match (self.state, self.intent, self.setpoint(now, input)) {
            (State::Idle { .. }, Intent::Offboard, Some(setpoint)) => {
                let lifts = asks_up(setpoint, input.nav.position.z);
                if lifts && self.has_spun_up(effective) && self.check_stream(now, input).is_ok() {
                    self.state = State::Offboard;
                }
                None
            }
            (State::Offboard, _, None) => Some(self.lose_stream(effective, input)),
            _ => None,
        }
    }

    /// Whether the set-point lifts a vehicle that stands where it has stood last.
    pub(super) fn lifts_by_setpoint(&self, now: Tick, input: &CommanderInput) -> bool {
        self.setpoint(now, input).is_some_and(|setpoint| asks_up(setpoint, self.ground_m()))
    }

    fn lose_stream(&mut self, effective: Tick, input: &CommanderInput) -> Event {
        let now = effective.wrapping_sub(COMMANDER.offset);
        let action = match self.stream.lost {
            Lost::Action(action) => action,
            Lost::ByHand(mode) => {
                if self.check_manual(mode, now, input).is_ok() {
                    self.engage(Intent::Manual(mode), effective, input);
                    return Event::SetPointsLost { action: None };
                }
                StationAction::Hold
            }
        };
        self.override_by(Override::SetPointsLost { action }, effective, &input.nav.position);
        Event::SetPointsLost { action: Some(action) }
    }

    /// Height to which the set-point leads, m.
    pub(super) fn height_by_setpoint(&self, now: Tick, input: &CommanderInput) -> Option<f32> {
        match self.setpoint(now, input)? {
            SetPoint::Motion { motion, .. } => motion.position()[2],
            SetPoint::Attitude(_) => None,
        }
    }

    /// What is known of the motion if the set-point may be bringing the vehicle to the ground.
    pub(super) fn descends_by_setpoint(&self, now: Tick, input: &CommanderInput) -> Option<Known> {
        let lands = match self.setpoint(now, input)? {
            SetPoint::Motion { motion, .. } => {
                let ([.., z], [.., vz]) = (motion.position(), motion.velocity());
                z.map_or_else(|| vz.is_some_and(|vz| vz < 0.0), |z| z < self.ground_m() + GROUND_M)
            }
            SetPoint::Attitude(wanted) => wanted.thrust < LANDS * self.hover_throttle,
        };
        lands.then_some(self.navigation.known())
    }
}

/// Whether a set-point lifts a vehicle that stands at a height, m.
fn asks_up(setpoint: &SetPoint, height: f32) -> bool {
    match setpoint {
        SetPoint::Motion { motion, .. } => {
            let ([.., z], [.., vz], [.., az]) = (motion.position(), motion.velocity(), motion.acceleration());
            match (z, vz, az) {
                (Some(z), _, _) => z > height + UP_M,
                (None, Some(vz), _) => vz > UP_M_S,
                (None, None, az) => az.is_some_and(|az| az > UP_M_S2),
            }
        }
        SetPoint::Attitude(wanted) => wanted.thrust > LIFTS,
    }
}
