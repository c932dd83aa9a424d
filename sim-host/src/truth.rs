//! The truth of a simulated flight as MAVLink messages: `HIL_STATE_QUATERNION` and `SIM_STATE`, of a component of its own
//! beside the autopilot, so that a ground station can show what is estimated and what is true.
//!
//! The firmware knows nothing of it. NED and FRD; heights are above mean sea level.

use firmware::frames::flip_vector;
use firmware::signals::{TICK_US, Tick};
use glissade_dialect::{HIL_STATE_QUATERNION_DATA, SIM_STATE_DATA};
use nalgebra::Vector3;

use crate::angles::roll_pitch_yaw;
use crate::geodesy::{LocalFrame, Place};
use crate::link::frames::Component;
use crate::plant::Motion;
use crate::sensors::Home;

/// MAVLink component of the simulator: `MAV_COMP_ID_ONBOARD_COMPUTER`.
pub const COMPONENT_ID: u8 = 191;

/// Standard gravity, m/s²: the unit of `HIL_STATE_QUATERNION`'s accelerations.
const STANDARD_GRAVITY: f64 = 9.806_65;

/// Tells the truth of one vehicle on one link.
#[derive(Clone, Debug)]
pub struct TruthStream {
    frame: LocalFrame,
    /// Height of the geoid above the ellipsoid, m.
    geoid_m: f64,
    component: Component,
}

impl TruthStream {
    /// For a vehicle, a MAVLink system, that flies about a home.
    pub fn new(home: &Home, system: u8) -> Self {
        Self {
            frame: LocalFrame::at(&home.place()),
            geoid_m: home.geoid_m,
            component: Component::new(system, COMPONENT_ID),
        }
    }

    /// Both messages, as whole frames. `specific_force` is what an ideal accelerometer reads, FLU, m/s².
    pub fn frames(&mut self, at: Tick, motion: &Motion, specific_force: &Vector3<f64>) -> Vec<u8> {
        let (hil_state, sim_state) =
            (self.hil_state(at, motion, specific_force), self.sim_state(motion, specific_force));
        let mut frames = self.component.frame(&hil_state);
        frames.extend(self.component.frame(&sim_state));
        frames
    }

    /// Where the vehicle is, with its height above mean sea level.
    fn place(&self, motion: &Motion) -> Place {
        let place = self.frame.place(&motion.position);
        Place { height_m: place.height_m - self.geoid_m, ..place }
    }

    /// Airspeeds are not known here: gusts are the weather's.
    fn hil_state(&self, at: Tick, motion: &Motion, specific_force: &Vector3<f64>) -> HIL_STATE_QUATERNION_DATA {
        let place = self.place(motion).rounded();
        let rates = flip_vector(&motion.rates.cast());
        let [vx, vy, vz] = ned(&motion.velocity).map(|v| (v * 100.0).round() as i16);
        let [xacc, yacc, zacc] = ned(specific_force).map(|f| (f * 1e3 / STANDARD_GRAVITY).round() as i16);
        HIL_STATE_QUATERNION_DATA {
            time_usec: u64::from(at) * u64::from(TICK_US),
            attitude_quaternion: quaternion(motion),
            rollspeed: rates.x,
            pitchspeed: rates.y,
            yawspeed: rates.z,
            lat: place.latitude_e7,
            lon: place.longitude_e7,
            alt: place.height_mm,
            vx,
            vy,
            vz,
            ind_airspeed: u16::MAX,
            true_airspeed: u16::MAX,
            xacc,
            yacc,
            zacc,
        }
    }

    /// Without deviations: it is the truth.
    fn sim_state(&self, motion: &Motion, specific_force: &Vector3<f64>) -> SIM_STATE_DATA {
        let place = self.place(motion);
        let rounded = place.rounded();
        let q = &motion.attitude;
        let [roll, pitch, yaw] = roll_pitch_yaw([q.w, q.i, q.j, q.k]);
        let [q1, q2, q3, q4] = quaternion(motion);
        let [[vn, ve, vd], [xacc, yacc, zacc], [xgyro, ygyro, zgyro]] =
            [ned(&motion.velocity), ned(specific_force), ned(&motion.rates)]
                .map(|v| v.map(|component| component as f32));
        SIM_STATE_DATA {
            q1,
            q2,
            q3,
            q4,
            roll: roll as f32,
            pitch: -pitch as f32,
            yaw: -yaw as f32,
            xacc,
            yacc,
            zacc,
            xgyro,
            ygyro,
            zgyro,
            lat: place.latitude_rad.to_degrees() as f32,
            lon: place.longitude_rad.to_degrees() as f32,
            alt: place.height_m as f32,
            std_dev_horz: 0.0,
            std_dev_vert: 0.0,
            vn,
            ve,
            vd,
            lat_int: rounded.latitude_e7,
            lon_int: rounded.longitude_e7,
        }
    }
}

/// A vector of NWU or FLU in NED or FRD.
fn ned(v: &Vector3<f64>) -> [f64; 3] {
    [v.x, -v.y, -v.z]
}

/// FRD to NED: w, x, y, z, with w not negative.
fn quaternion(motion: &Motion) -> [f32; 4] {
    let q = &motion.attitude;
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    [q.w, q.i, -q.j, -q.k].map(|component| (component * sign) as f32)
}

#[cfg(test)]
mod tests {
    use glissade_dialect::MavMessage;
    use glissade_dialect::mavlink_core::{MavlinkVersion, Message as _};
    use nalgebra::UnitQuaternion;

    use super::*;

    #[test]
    fn the_truth_is_told_in_the_frames_of_mavlink() {
        let motion = Motion {
            position: Vector3::new(20.0, -30.0, 10.0),
            velocity: Vector3::new(1.0, 2.0, -0.5),
            attitude: UnitQuaternion::from_euler_angles(0.1, -0.2, 0.3).into_inner(),
            rates: Vector3::new(0.1, 0.2, 0.3),
        };
        let home = Home { height_m: 535.0, geoid_m: 47.0, ..Home::default() };
        let mut stream = TruthStream::new(&home, 1);
        let bytes = stream.frames(1_500, &motion, &Vector3::new(1.0, 2.0, 9.806_65));
        let messages: Vec<MavMessage> = frames(&bytes);
        let [MavMessage::HIL_STATE_QUATERNION(hil), MavMessage::SIM_STATE(sim)] = messages.as_slice() else {
            panic!("{messages:?}")
        };
        assert_eq!(hil.time_usec, 1_500_000);
        // 20 m are 1799 of 1e-7° on the meridian there, 30 m are 3974 on the parallel.
        assert_eq!((hil.lat, hil.lon, hil.alt), (473_977_000 + 1_799, 85_456_000 + 3_974, 498_000));
        assert_eq!((sim.lat_int, sim.lon_int), (hil.lat, hil.lon));
        assert_eq!((hil.vx, hil.vy, hil.vz), (100, -200, 50));
        assert_eq!((hil.xacc, hil.yacc, hil.zacc), (102, -204, -1_000));
        assert!((sim.roll - 0.1).abs() < 1e-6 && (sim.pitch - 0.2).abs() < 1e-6 && (sim.yaw + 0.3).abs() < 1e-6);
        assert_eq!((sim.vn, sim.ve, sim.vd), (1.0, -2.0, 0.5));
        assert_eq!((sim.xgyro, sim.ygyro, sim.zgyro), (0.1, -0.2, -0.3));
        assert_eq!(hil.attitude_quaternion, [sim.q1, sim.q2, sim.q3, sim.q4]);
    }

    /// Decodes frames of the component, which number themselves.
    fn frames(mut bytes: &[u8]) -> Vec<MavMessage> {
        let mut messages = Vec::new();
        while !bytes.is_empty() {
            let length = usize::from(bytes[1]);
            assert_eq!((bytes[0], bytes[4], bytes[5], bytes[6]), (0xfd, messages.len() as u8, 1, COMPONENT_ID));
            let id = u32::from_le_bytes([bytes[7], bytes[8], bytes[9], 0]);
            messages.push(MavMessage::parse(MavlinkVersion::V2, id, &bytes[10..10 + length]).expect("a message"));
            bytes = &bytes[12 + length..];
        }
        messages
    }
}
