//! The pilot's station: what its vehicle is sent, as a ground station with a joystick sends it.
//!
//! Sticks go 50 times a second of simulated time, a heartbeat once a second, orders with the next tick. Nothing is
//! repeated: no frame is lost within the process.

use firmware::signals::Tick;
use glissade_dialect::{COMMAND_LONG_DATA, HEARTBEAT_DATA, MANUAL_CONTROL_DATA, MavCmd};

use super::{Order, Selected, Sticks};
use crate::link::frames::Component;

/// MAVLink system of the station: beside 255, which ground stations are unless told otherwise.
pub const SYSTEM: u8 = 254;
/// Its component: `MAV_COMP_ID_MISSIONPLANNER`, a ground station's.
const COMPONENT: u8 = 190;
/// Ticks between two messages of sticks: 50 Hz, as ground stations send them.
const STICKS_EVERY: Tick = 20;
/// Ticks between two heartbeats.
const HEARTBEAT_EVERY: Tick = 1_000;
/// `MAV_TYPE_GCS`, `MAV_AUTOPILOT_INVALID`, `MAV_STATE_ACTIVE`, and the version of MAVLink.
const HEARTBEAT: HEARTBEAT_DATA =
    HEARTBEAT_DATA { custom_mode: 0, mavtype: 6, autopilot: 8, base_mode: 0, system_status: 4, mavlink_version: 3 };
/// Full deflection in `MANUAL_CONTROL`.
const FULL: f64 = 1_000.0;
/// `MAV_MODE_FLAG_CUSTOM_MODE_ENABLED`: the mode is PX4's.
const CUSTOM_MODE: f32 = 1.0;
/// The number that makes a disarming a forced one: a kill.
const FORCED: f32 = 21_196.0;

/// The station of one vehicle.
#[derive(Clone, Debug)]
pub struct Station {
    component: Component,
    /// MAVLink system of the vehicle.
    vehicle: u8,
    /// Frames of orders, which go with the next tick.
    orders: Vec<u8>,
}

impl Station {
    /// For the vehicle that is a MAVLink system.
    pub fn new(vehicle: u8) -> Self {
        Self { component: Component::new(SYSTEM, COMPONENT), vehicle, orders: Vec::new() }
    }

    /// Asks the vehicle, before its next tick. `armed`: whether it is.
    pub fn ask(&mut self, order: Order, armed: bool) {
        let command = match order {
            Order::ArmOrDisarm => {
                command(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [if armed { 0.0 } else { 1.0 }, 0.0, 0.0])
            }
            Order::Kill => command(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [0.0, FORCED, 0.0]),
            Order::Select(mode) => {
                let (main, sub) = px4(mode);
                command(MavCmd::MAV_CMD_DO_SET_MODE, [CUSTOM_MODE, main, sub])
            }
        };
        let frame = self.component.frame(&COMMAND_LONG_DATA { target_system: self.vehicle, ..command });
        self.orders.extend(frame);
    }

    /// The frames for a tick, as a whole; without sticks none of them are sent.
    pub fn frames(&mut self, tick: Tick, sticks: Option<Sticks>) -> Vec<u8> {
        let mut frames = core::mem::take(&mut self.orders);
        if tick.is_multiple_of(HEARTBEAT_EVERY) {
            frames.extend(self.component.frame(&HEARTBEAT));
        }
        if let Some(sticks) = sticks.filter(|_| tick.is_multiple_of(STICKS_EVERY)) {
            frames.extend(self.component.frame(&manual_control(sticks, self.vehicle)));
        }
        frames
    }
}

/// A command with its first three parameters.
fn command(command: MavCmd, [param1, param2, param3]: [f32; 3]) -> COMMAND_LONG_DATA {
    COMMAND_LONG_DATA { command: command as u16, param1, param2, param3, ..COMMAND_LONG_DATA::DEFAULT }
}

/// PX4's main mode and sub-mode.
const fn px4(mode: Selected) -> (f32, f32) {
    match mode {
        Selected::Altitude => (2.0, 0.0),
        Selected::Position => (3.0, 0.0),
        Selected::Acro => (5.0, 0.0),
        Selected::Stabilized => (7.0, 0.0),
        Selected::Hold => (4.0, 3.0),
        Selected::Return => (4.0, 5.0),
        Selected::Land => (4.0, 6.0),
    }
}

/// Sticks as QGroundControl sends them: x forward, y and r to the right, z up from 0. Buttons act here and are not told.
fn manual_control(sticks: Sticks, target: u8) -> MANUAL_CONTROL_DATA {
    let axis = |deflection: f64| (deflection.clamp(-1.0, 1.0) * FULL).round() as i16;
    MANUAL_CONTROL_DATA {
        target,
        x: axis(sticks.pitch),
        y: axis(sticks.roll),
        z: axis(f64::midpoint(sticks.throttle, 1.0).max(0.0)),
        r: axis(sticks.yaw),
        ..MANUAL_CONTROL_DATA::DEFAULT
    }
}

#[cfg(test)]
mod tests {
    use glissade_dialect::MavMessage;
    use glissade_dialect::mavlink_core::{MavlinkVersion, Message as _};

    use super::*;
    use crate::link::frames;

    /// The messages of a tick, each of which comes as a valid frame of the station.
    fn messages(frames: &[u8]) -> Vec<MavMessage> {
        frames::whole(frames)
            .map(|frame| {
                assert!(frame.valid && frame.system == SYSTEM);
                let bytes = &frames[frame.range];
                let id = u32::from_le_bytes([bytes[7], bytes[8], bytes[9], 0]);
                MavMessage::parse(MavlinkVersion::V2, id, &bytes[10..bytes.len() - 2]).expect("a message")
            })
            .collect()
    }

    #[test]
    fn sticks_go_every_20_ticks_and_a_heartbeat_every_second() {
        let mut station = Station::new(3);
        let (mut sticks, mut heartbeats) = (Vec::new(), Vec::new());
        for tick in 0..2_000 {
            for message in messages(&station.frames(tick, Some(Sticks::default()))) {
                match message {
                    MavMessage::MANUAL_CONTROL(message) => sticks.push((tick, message.target)),
                    MavMessage::HEARTBEAT(message) => heartbeats.push((tick, message.mavtype)),
                    other => panic!("{other:?}"),
                }
            }
        }
        assert_eq!(heartbeats, [(0, 6), (1_000, 6)]);
        assert!(sticks.into_iter().eq((0..100).map(|number| (number * 20, 3))));
    }

    #[test]
    fn without_sticks_the_station_is_still_there() {
        let mut station = Station::new(1);
        let told: Vec<MavMessage> = (0..1_500).flat_map(|tick| messages(&station.frames(tick, None))).collect();
        assert!(matches!(told.as_slice(), [MavMessage::HEARTBEAT(_), MavMessage::HEARTBEAT(_)]), "{told:?}");
    }

    #[test]
    fn deflections_have_the_signs_and_ranges_of_ground_stations() {
        let sent = |roll, pitch, yaw, throttle| {
            let m = manual_control(Sticks { roll, pitch, yaw, throttle }, 1);
            [m.y, m.x, m.r, m.z]
        };
        assert_eq!(sent(0.0, 0.0, 0.0, 0.0), [0, 0, 0, 500]);
        assert_eq!(sent(1.0, -1.0, 0.5, 1.0), [1000, -1000, 500, 1000]);
        assert_eq!(sent(-0.0004, 0.0006, -1.0, -1.0), [0, 1, -1000, 0]);
        assert_eq!(sent(7.0, -7.0, f64::NAN, -9.0), [1000, -1000, 0, 0], "never out of range");
    }

    #[test]
    fn orders_are_commands_to_the_vehicle() {
        let asked = |order, armed| {
            let mut station = Station::new(9);
            station.ask(order, armed);
            let [MavMessage::COMMAND_LONG(m)] = &messages(&station.frames(1, None))[..] else { panic!("a command") };
            assert_eq!(m.target_system, 9);
            (m.command, [m.param1, m.param2, m.param3])
        };
        assert_eq!(asked(Order::ArmOrDisarm, false), (400, [1.0, 0.0, 0.0]));
        assert_eq!(asked(Order::ArmOrDisarm, true), (400, [0.0, 0.0, 0.0]));
        assert_eq!(asked(Order::Kill, false), (400, [0.0, 21_196.0, 0.0]));
        for (mode, main, sub) in [
            (Selected::Altitude, 2.0, 0.0),
            (Selected::Position, 3.0, 0.0),
            (Selected::Acro, 5.0, 0.0),
            (Selected::Stabilized, 7.0, 0.0),
            (Selected::Hold, 4.0, 3.0),
            (Selected::Return, 4.0, 5.0),
            (Selected::Land, 4.0, 6.0),
        ] {
            assert_eq!(asked(Order::Select(mode), true), (176, [1.0, main, sub]), "{mode:?}");
        }
    }

    #[test]
    fn orders_are_sent_once_and_in_turn() {
        let mut station = Station::new(1);
        station.ask(Order::ArmOrDisarm, false);
        station.ask(Order::Select(Selected::Hold), false);
        assert_eq!(messages(&station.frames(1, None)).len(), 2);
        assert!(station.frames(2, None).is_empty());
    }
}
