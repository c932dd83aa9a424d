//! Flights by the bytes of a pilot and of a companion computer, drawn at random.

use chacha20::ChaCha8Rng;
use firmware::mavlink::port::Profile;
use firmware::signals::Tick;
use glissade_dialect::mavlink_core::MessageData;
use glissade_dialect::{
    HEARTBEAT_DATA, MANUAL_CONTROL_DATA, MavCmd, SET_ATTITUDE_TARGET_DATA, SET_POSITION_TARGET_LOCAL_NED_DATA,
};
use rand::{RngExt as _, SeedableRng as _};
use sim_host::sil::replay::{Entry, Input, OnLink};

use super::station::{self, frame};

/// PX4's main modes, as `DO_SET_MODE` takes them, and its automatic ones.
pub(crate) const ALTITUDE: f32 = 2.0;
pub(crate) const POSITION: f32 = 3.0;
pub(crate) const AUTO: f32 = 4.0;
pub(crate) const ACRO: f32 = 5.0;
pub(crate) const OFFBOARD: f32 = 6.0;
pub(crate) const STABILIZED: f32 = 7.0;
pub(crate) const HOLD: f32 = 3.0;
pub(crate) const LAND: f32 = 6.0;

/// Ticks between two messages of sticks, and of set-points.
const STICKS: usize = 40;
const STREAM: usize = 20;

/// Stick positions, −1 to 1: forward, to the right, up, to the right.
pub(crate) type Axes = [f64; 4];
pub(crate) const CENTRED: Axes = [0.0; 4];
pub(crate) const DOWN: Axes = [0.0, 0.0, -1.0, 0.0];

/// What is sent to a vehicle, in order.
pub(crate) struct Bytes {
    entries: Vec<Entry>,
    sequence: u8,
    pub(crate) random: ChaCha8Rng,
    /// Until here all is written, and nothing before it is added any more.
    pub(crate) now: Tick,
}

impl Bytes {
    pub(crate) fn new(seed: u64) -> Self {
        let open = Entry { tick: 0, input: Input::Link { link: 0, event: OnLink::Open(Profile::Normal) } };
        Self { entries: vec![open], sequence: 0, random: ChaCha8Rng::seed_from_u64(seed), now: 0 }
    }

    pub(crate) fn send(&mut self, message: &impl MessageData) {
        self.sequence = self.sequence.wrapping_add(1);
        let event = OnLink::Received(frame(self.sequence, message));
        self.entries.push(Entry { tick: self.now, input: Input::Link { link: 0, event } });
    }

    /// A command with the first three and the last of its numbers.
    pub(crate) fn command(&mut self, command: MavCmd, numbers: [f32; 4]) {
        self.send(&station::command(command, numbers));
    }

    pub(crate) fn mode(&mut self, main: f32, sub: f32) {
        self.command(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, main, sub, 0.0]);
    }

    pub(crate) fn arm(&mut self) {
        self.command(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0, 0.0, 0.0]);
    }

    pub(crate) fn take_off(&mut self, height_m: f32) {
        self.command(MavCmd::MAV_CMD_NAV_TAKEOFF, [0.0, 0.0, 0.0, height_m]);
    }

    /// Waits; a ground station's heartbeats go on.
    pub(crate) fn wait(&mut self, seconds: f64) {
        self.repeat(seconds, 1_000, |bytes| bytes.send(&HEARTBEAT_DATA::DEFAULT));
    }

    fn repeat(&mut self, seconds: f64, period: usize, mut each: impl FnMut(&mut Self)) {
        let end = self.now + (seconds * 1e3) as Tick;
        for tick in (self.now..end).step_by(period) {
            self.now = tick;
            each(self);
        }
        self.now = end;
    }

    /// Holds the sticks.
    pub(crate) fn sticks(&mut self, seconds: f64, [forward, right, up, yaw]: Axes) {
        let all = |part: f64| (1e3 * part) as i16;
        let message = MANUAL_CONTROL_DATA {
            x: all(forward),
            y: all(right),
            z: all(0.5 + 0.5 * up),
            r: all(yaw),
            target: 1,
            ..MANUAL_CONTROL_DATA::DEFAULT
        };
        self.repeat(seconds, STICKS, |bytes| bytes.send(&message));
    }

    /// Moves the sticks at random: each to an end, the centre or anywhere, for 0.1 to 1.5 s. The throttle stays in a range.
    pub(crate) fn stir(&mut self, seconds: f64, throttle: core::ops::Range<f64>) {
        let end = self.now + (seconds * 1e3) as Tick;
        while self.now < end {
            let mut axes = [0.0; 4].map(|_: f64| self.position());
            axes[2] = throttle.start + 0.5 * (axes[2] + 1.0) * (throttle.end - throttle.start);
            let held = self.random.random_range(0.1..1.5);
            self.sticks(held, axes);
        }
    }

    fn position(&mut self) -> f64 {
        match self.random.random_range(0..4) {
            0 => -1.0,
            1 => 1.0,
            2 => 0.0,
            _ => self.random.random_range(-1.0..1.0),
        }
    }

    /// Streams a set-point at 50 Hz, made anew each time from the time since the stream's beginning, s.
    pub(crate) fn stream(&mut self, seconds: f64, make: impl Fn(f64) -> SET_POSITION_TARGET_LOCAL_NED_DATA) {
        let begun = self.now;
        self.repeat(seconds, STREAM, |bytes| {
            let made = make(f64::from(bytes.now - begun) * 1e-3);
            bytes.send(&SET_POSITION_TARGET_LOCAL_NED_DATA {
                time_boot_ms: bytes.now,
                target_system: 1,
                coordinate_frame: 1,
                ..made
            });
        });
    }

    /// Set-points that move as their velocity and acceleration tell, or that do not move at all though they tell so.
    pub(crate) fn scatter(&mut self, seconds: f64) {
        let end = self.now + (seconds * 1e3) as Tick;
        while self.now < end {
            let drawn = draw(&mut self.random);
            let moves = self.random.random_range(0..2) == 0;
            let lasts = self.random.random_range(0.3..4.0);
            self.stream(lasts, |t| {
                let t = if moves { t as f32 } else { 0.0 };
                let place = |place: f32, speed: f32, acceleration: f32| place + (speed + 0.5 * acceleration * t) * t;
                SET_POSITION_TARGET_LOCAL_NED_DATA {
                    x: place(drawn.x, drawn.vx, drawn.afx),
                    y: place(drawn.y, drawn.vy, drawn.afy),
                    z: place(drawn.z, drawn.vz, drawn.afz),
                    vx: drawn.vx + drawn.afx * t,
                    vy: drawn.vy + drawn.afy * t,
                    vz: drawn.vz + drawn.afz * t,
                    ..drawn
                }
            });
        }
    }

    /// Streams an attitude or rates at 50 Hz.
    pub(crate) fn attitude(&mut self, seconds: f64, message: &SET_ATTITUDE_TARGET_DATA) {
        let message = SET_ATTITUDE_TARGET_DATA { target_system: 1, ..message.clone() };
        self.repeat(seconds, STREAM, |bytes| bytes.send(&message));
    }

    pub(crate) fn into_entries(self) -> Vec<Entry> {
        self.entries
    }
}

/// A set-point at random: places, velocities or accelerations, alone or together, and something of the heading.
fn draw(random: &mut ChaCha8Rng) -> SET_POSITION_TARGET_LOCAL_NED_DATA {
    let mut range = |most: f32| random.random_range(-most..most);
    let drawn = SET_POSITION_TARGET_LOCAL_NED_DATA {
        x: range(30.0),
        y: range(30.0),
        z: -60.0 + range(20.0),
        vx: range(20.0),
        vy: range(20.0),
        vz: range(5.0),
        afx: range(8.0),
        afy: range(8.0),
        afz: range(4.0),
        yaw: range(3.1),
        yaw_rate: range(3.0),
        ..SET_POSITION_TARGET_LOCAL_NED_DATA::DEFAULT
    };
    // Of place, velocity and acceleration, what is not ignored; and of yaw and its rate.
    let given = [0b001, 0b010, 0b011, 0b110, 0b111, 0b101][random.random_range(0..6)];
    let mut type_mask = 0;
    for part in 0..3 {
        type_mask |= if given & (1 << part) == 0 { 7 << (3 * part) } else { 0 };
    }
    type_mask |= random.random_range(0..4) << 10;
    SET_POSITION_TARGET_LOCAL_NED_DATA { type_mask, ..drawn }
}
