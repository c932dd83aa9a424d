//! A scripted pilot: requests and their times, through the interface of a program on board.
//!
//! ```toml
//! [[command]]
//! at_s = 3.0
//! order = "arm"
//! [[command]]
//! at_s = 4.0
//! order = { take-off = { height_m = 10.0 } }
//! [[command]]
//! arrived_for_s = 1.0
//! order = { go-to = { position_m = [20.0, 0.0, 10.0], yaw_deg = 90.0 } }
//! ```
//!
//! Commands are given one after the other. The pilot knows what the vehicle reports, and not the truth.

use firmware::commander::{Asked, Goal, Request};
use firmware::signals::{NavState, Tick};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Order to the vehicle. World frame NWU.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Order {
    /// Arm; repeated twice per second until armed.
    Arm,
    /// Disarm, on the ground.
    Disarm,
    /// Disarm by force, anywhere.
    Kill,
    /// Take off.
    TakeOff {
        /// Height above the ground, m.
        height_m: f32,
    },
    /// Brake, and stay.
    Hold,
    /// Go to a place.
    GoTo {
        /// m.
        position_m: [f32; 3],
        /// ψ, °.
        yaw_deg: f32,
    },
    /// Fly with a velocity until the next command; repeated five times per second.
    Velocity {
        /// m/s.
        velocity_m_s: [f32; 3],
        /// ψ̇, °/s.
        #[serde(default)]
        yaw_rate_deg_s: f32,
    },
    /// Land here.
    Land,
    /// Return and land.
    Return,
    /// Fly the scenario's trajectory.
    Follow,
}

/// An order with its time: either a fixed time, or the arrival at the last waypoint.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Command {
    /// Simulated time, s.
    pub at_s: Option<f64>,
    /// Time for which the vehicle must have been where the command before leads to, s; for commands after those that
    /// [arrive](Order::arrives).
    pub arrived_for_s: Option<f64>,
    /// The order.
    pub order: Order,
}

impl Order {
    /// What the vehicle is asked.
    pub fn asked(&self) -> Asked {
        Asked::Request(match *self {
            Self::Arm => Request::Arm { force: false },
            Self::Disarm => Request::Disarm,
            Self::Kill => return Asked::Kill,
            Self::TakeOff { height_m } => Request::TakeOff { height_m },
            Self::Hold => Request::Hold,
            Self::GoTo { position_m, yaw_deg } => Request::GoTo(Goal::at(position_m, yaw_deg.to_radians())),
            Self::Velocity { velocity_m_s, yaw_rate_deg_s } => {
                Request::Velocity { velocity_m_s, yaw_rate_rad_s: yaw_rate_deg_s.to_radians() }
            }
            Self::Land => Request::Land,
            Self::Return => Request::Return,
            Self::Follow => Request::Follow,
        })
    }

    /// Interval in ticks at which the order is repeated while it is the last one.
    fn again_after(&self, armed: bool) -> Option<Tick> {
        match self {
            Self::Arm if !armed => Some(500),
            Self::Velocity { .. } => Some(200),
            _ => None,
        }
    }
}

/// Period of the pilot, ticks.
const LOOKS_EVERY: Tick = 20;
/// Arrived: within this distance of the waypoint, m, and slower than this, m/s.
const ARRIVED_M: f32 = 0.5;
const ARRIVED_M_S: f32 = 0.5;

/// Where a command leads to.
#[derive(Clone, Copy, Debug)]
enum Target {
    /// A place, m.
    Place(Vector3<f32>),
    /// To a stop, wherever that is.
    Stop,
}

impl Order {
    /// Whether it leads to a place, or to a stop, of which one can ask how long ago it was reached.
    pub fn arrives(&self) -> bool {
        matches!(self, Self::TakeOff { .. } | Self::GoTo { .. } | Self::Hold)
    }
}

/// The script and its progress.
#[derive(Clone, Debug)]
pub struct Pilot {
    script: Vec<Command>,
    /// Commands given.
    done: usize,
    given_at: Tick,
    /// Where the last command leads to.
    target: Option<Target>,
    arrived_since: Option<Tick>,
}

impl Pilot {
    /// Before the first command.
    pub fn new(script: &[Command]) -> Self {
        Self { script: script.to_vec(), done: 0, given_at: 0, target: None, arrived_since: None }
    }

    /// How many commands of the script have been given.
    pub fn given(&self) -> usize {
        self.done
    }

    /// What it asks at a tick, if anything. Call once per tick, with the vehicle's own estimate.
    pub fn step(&mut self, tick: Tick, nav: &NavState, armed: bool) -> Option<Asked> {
        if !tick.is_multiple_of(LOOKS_EVERY) {
            return None;
        }
        self.look(tick, nav);
        let last = self.done.checked_sub(1).and_then(|last| self.script.get(last)).map(|command| command.order);
        let waits = last == Some(Order::Arm) && !armed;
        if let Some(next) = self.script.get(self.done).copied()
            && !waits
            && self.is_due(&next, tick)
        {
            self.done += 1;
            return Some(self.give(tick, next.order, nav));
        }
        let again = last?.again_after(armed)?;
        if tick.wrapping_sub(self.given_at) < again {
            return None;
        }
        Some(self.give(tick, last?, nav))
    }

    fn look(&mut self, tick: Tick, nav: &NavState) {
        let is_near = |target: Target| match target {
            Target::Place(place) => (place - nav.position).norm() < ARRIVED_M,
            Target::Stop => true,
        };
        let there = self.target.is_some_and(is_near) && nav.velocity.norm() < ARRIVED_M_S;
        self.arrived_since = if there { self.arrived_since.or(Some(tick)) } else { None };
    }

    fn is_due(&self, command: &Command, tick: Tick) -> bool {
        let ticks = |seconds: f64| (seconds * 1e3).round() as Tick;
        let in_time = command.at_s.is_none_or(|at| tick >= ticks(at));
        let there = command
            .arrived_for_s
            .is_none_or(|time| self.arrived_since.is_some_and(|since| tick.wrapping_sub(since) >= ticks(time)));
        in_time && there
    }

    fn give(&mut self, tick: Tick, order: Order, nav: &NavState) -> Asked {
        self.given_at = tick;
        match order {
            Order::TakeOff { height_m } => self.send(Target::Place(nav.position + Vector3::z() * height_m)),
            Order::GoTo { position_m, .. } => self.send(Target::Place(position_m.into())),
            Order::Hold => self.send(Target::Stop),
            _ => {}
        }
        order.asked()
    }

    fn send(&mut self, target: Target) {
        self.target = Some(target);
        self.arrived_since = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TAKE_OFF: Order = Order::TakeOff { height_m: 10.0 };

    fn script() -> Vec<Command> {
        let at = |at_s: f64, order| Command { at_s: Some(at_s), arrived_for_s: None, order };
        let then = |order| Command { at_s: None, arrived_for_s: Some(1.0), order };
        vec![at(1.0, Order::Arm), at(2.0, TAKE_OFF), then(Order::Land)]
    }

    fn at_height(z: f32) -> NavState {
        NavState { position: Vector3::new(0.0, 0.0, z), ..NavState::at_rest() }
    }

    #[test]
    fn commands_come_in_their_time_and_once_the_vehicle_is_there() {
        let mut pilot = Pilot::new(&script());
        let mut asked = Vec::new();
        for tick in 0..20_000_u32 {
            let z = if tick < 9_000 { tick.saturating_sub(2_000) as f32 / 700.0 } else { 10.0 };
            let climbing =
                NavState { velocity: Vector3::new(0.0, 0.0, if tick < 9_000 { 1.4 } else { 0.0 }), ..at_height(z) };
            let (armed, nav) = (tick > 2_000, if tick < 2_000 { NavState::at_rest() } else { climbing });
            if let Some(one) = pilot.step(tick, &nav, armed) {
                asked.push((tick, one));
            }
        }
        let arm = Request::Arm { force: false };
        assert_eq!(
            asked,
            [
                (1_000, arm.into()),
                (1_500, arm.into()),
                (2_000, arm.into()),
                (2_020, Request::TakeOff { height_m: 10.0 }.into()),
                (10_000, Request::Land.into()),
            ]
        );
    }

    #[test]
    fn a_hold_arrives_where_the_vehicle_comes_to_a_stop() {
        let at = |at_s: f64, order| Command { at_s: Some(at_s), arrived_for_s: None, order };
        let then = Command { at_s: None, arrived_for_s: Some(2.0), order: Order::Land };
        let mut pilot = Pilot::new(&[at(1.0, Order::Hold), then]);
        let moving = |tick: Tick| NavState {
            velocity: Vector3::x() * if tick < 3_000 { 1.0 } else { 0.1 },
            ..NavState::at_rest()
        };
        let asked: Vec<Tick> = (0..9_000).filter(|tick| pilot.step(*tick, &moving(*tick), true).is_some()).collect();
        assert_eq!(asked, [1_000, 5_000]);
    }

    #[test]
    fn a_velocity_is_asked_again_until_the_next_command() {
        let velocity = Order::Velocity { velocity_m_s: [1.0, 0.0, 0.0], yaw_rate_deg_s: 0.0 };
        let at = |at_s: f64, order| Command { at_s: Some(at_s), arrived_for_s: None, order };
        let mut pilot = Pilot::new(&[at(1.0, velocity), at(2.0, Order::Hold)]);
        let asked: Vec<Tick> =
            (0..5_000).filter(|tick| pilot.step(*tick, &NavState::at_rest(), true).is_some()).collect();
        assert_eq!(asked, [1_000, 1_200, 1_400, 1_600, 1_800, 2_000]);
    }
}
