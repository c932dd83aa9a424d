//! What a companion computer sends: a set-point of which any number may be missing.

use crate::math;
use crate::signals::Tick;

/// A set-point: what of a motion is wanted, in the world. Every number is finite.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// A bit per number: 0 to 2 for the position's axes, 3 to 5 for the velocity's, 6 to 8 for the acceleration's, 9 for
    /// the yaw, 10 for its rate. What is not given is 0.
    given: u16,
    position: [f32; 3],
    velocity: [f32; 3],
    acceleration: [f32; 3],
    yaw: f32,
    yaw_rate: f32,
}

/// A larger angle has no direction that an f32 tells, rad.
const LARGEST_RAD: f32 = 1e4;

const YAW: u16 = 1 << 9;
const YAW_RATE: u16 = 1 << 10;

/// Stores the numbers that are given, and returns their bits.
fn put(values: [Option<f32>; 3], into: &mut [f32; 3]) -> u16 {
    let mut bits = 0;
    for ((bit, value), into) in [1, 2, 4].into_iter().zip(values).zip(into) {
        *into = value.unwrap_or(0.0);
        bits |= if value.is_some() { bit } else { 0 };
    }
    bits
}

fn get(bits: u16, [x, y, z]: [f32; 3]) -> [Option<f32>; 3] {
    [(1, x), (2, y), (4, z)].map(|(bit, value)| (bits & bit != 0).then_some(value))
}

impl Motion {
    /// With a position, m, of which axes may be `None`.
    #[must_use]
    pub fn with_position(mut self, axes: [Option<f32>; 3]) -> Self {
        self.given = self.given & !7 | put(axes, &mut self.position);
        self
    }

    /// With a velocity, m/s.
    #[must_use]
    pub fn with_velocity(mut self, axes: [Option<f32>; 3]) -> Self {
        self.given = self.given & !(7 << 3) | put(axes, &mut self.velocity) << 3;
        self
    }

    /// With an acceleration, m/s².
    #[must_use]
    pub fn with_acceleration(mut self, axes: [Option<f32>; 3]) -> Self {
        self.given = self.given & !(7 << 6) | put(axes, &mut self.acceleration) << 6;
        self
    }

    /// With a yaw angle ψ, rad.
    #[must_use]
    pub fn with_yaw(self, yaw: f32) -> Self {
        Self { given: self.given | YAW, yaw: math::wrap_angle(math::limit(yaw, LARGEST_RAD)), ..self }
    }

    /// With a yaw rate ψ̇, rad/s.
    #[must_use]
    pub fn with_yaw_rate(self, yaw_rate: f32) -> Self {
        Self { given: self.given | YAW_RATE, yaw_rate, ..self }
    }

    /// Position, m.
    pub fn position(&self) -> [Option<f32>; 3] {
        get(self.given, self.position)
    }

    /// Velocity, m/s.
    pub fn velocity(&self) -> [Option<f32>; 3] {
        get(self.given >> 3, self.velocity)
    }

    /// Acceleration, m/s².
    pub fn acceleration(&self) -> [Option<f32>; 3] {
        get(self.given >> 6, self.acceleration)
    }

    /// ψ, rad.
    pub fn yaw(&self) -> Option<f32> {
        (self.given & YAW != 0).then_some(self.yaw)
    }

    /// ψ̇, rad/s.
    pub fn yaw_rate(&self) -> Option<f32> {
        (self.given & YAW_RATE != 0).then_some(self.yaw_rate)
    }
}

/// A set-point of a stream.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// What is wanted.
    pub motion: Motion,
    /// When it was read.
    pub at: Tick,
    /// When it was sent, ms on the sender's clock, which wraps; `None` if it does not tell.
    pub sent_ms: Option<u32>,
}
