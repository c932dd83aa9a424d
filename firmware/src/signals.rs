//! The plain data that flows between the partitions (see the picture in the crate docs).
//!
//! World frame NWU (north, west, up), body frame FLU (forward, left, up), SI units. Only `frames` knows others.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::airframe::ROTORS;
use crate::math;
use crate::sensors::Measurements;

/// Number of the inner loop's tick, [`TICK_US`] apart, counted from boot.
pub type Tick = u32;

/// Length of a tick, µs: the inner loop runs at 1 kHz.
pub const TICK_US: u32 = 1_000;

/// Length of a tick, s.
pub const TICK_S: f32 = 1e-3;

/// Length of a tick, s, for what must not drift over hours.
pub const TICK_S_EXACT: f64 = TICK_US as f64 * 1e-6;

/// What is known of the vehicle's motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NavState {
    /// Position in the world, m.
    pub position: Vector3<f32>,
    /// Velocity in the world, m/s.
    pub velocity: Vector3<f32>,
    /// Rotation that takes body vectors to the world.
    pub attitude: UnitQuaternion<f32>,
    /// Angular velocity Ω = (p, q, r) in the body, rad/s.
    pub rates: Vector3<f32>,
}

impl NavState {
    /// At rest at the origin, level, heading north.
    pub fn at_rest() -> Self {
        Self {
            position: Vector3::zeros(),
            velocity: Vector3::zeros(),
            attitude: UnitQuaternion::identity(),
            rates: Vector3::zeros(),
        }
    }

    /// ψ, rad: of Rz(ψ) Ry(θ) Rx(φ).
    pub fn yaw(&self) -> f32 {
        let q = self.attitude.quaternion();
        math::atan2(2.0 * (q.w * q.k + q.i * q.j), 1.0 - 2.0 * (q.j * q.j + q.k * q.k))
    }

    /// True if every component is a finite number and the attitude is a unit quaternion within 1 %.
    pub fn is_valid(&self) -> bool {
        let q: &Quaternion<f32> = self.attitude.quaternion();
        let finite = [&self.position, &self.velocity, &self.rates].iter().all(|v| math::all_finite(v.as_slice()));
        let norm = q.norm_squared();
        finite && norm > 0.98 && norm < 1.02
    }
}

/// What of the motion may be trusted. Angular rates always come with the attitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "each is lost by itself")]
pub struct NavHealth {
    /// Roll and pitch.
    pub attitude: bool,
    /// Heading.
    pub heading: bool,
    /// Horizontal velocity.
    pub velocity: bool,
    /// Horizontal position.
    pub position: bool,
    /// Height.
    pub height: bool,
    /// Vertical velocity: it outlives the height, by what the accelerometers add up.
    pub climb: bool,
}

impl NavHealth {
    /// All of it: what an ideal sensor gives.
    pub const ALL: Self =
        Self { attitude: true, heading: true, velocity: true, position: true, height: true, climb: true };
    /// Nothing.
    pub const NONE: Self =
        Self { attitude: false, heading: false, velocity: false, position: false, height: false, climb: false };
}

/// What is delivered for one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SensorFrame {
    /// The vehicle's motion at this tick: what an ideal sensor gives, for comparing control laws.
    Motion(NavState),
    /// What sensors have measured.
    Measured(Measurements),
}

/// Speeds the rotors are to turn at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorCommand {
    /// One speed a rotor, rad/s, 0..=ωmax.
    pub omega_rad_s: [f32; ROTORS],
}

impl MotorCommand {
    /// All rotors stopped.
    pub const STOPPED: Self = Self { omega_rad_s: [0.0; ROTORS] };
}

/// Where the reference trajectory is, down to its fourth derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatReference {
    /// Position, m.
    pub position: Vector3<f32>,
    /// Velocity, m/s.
    pub velocity: Vector3<f32>,
    /// Acceleration, m/s².
    pub acceleration: Vector3<f32>,
    /// Jerk, m/s³.
    pub jerk: Vector3<f32>,
    /// Snap, m/s⁴.
    pub snap: Vector3<f32>,
    /// Yaw ψd, rad.
    pub yaw: f32,
    /// ψ̇d, rad/s.
    pub yaw_rate: f32,
    /// ψ̈d, rad/s².
    pub yaw_acceleration: f32,
}

impl FlatReference {
    /// Standing still at a place.
    pub fn standing(position: Vector3<f32>, yaw: f32) -> Self {
        let zero = Vector3::zeros();
        Self {
            position,
            velocity: zero,
            acceleration: zero,
            jerk: zero,
            snap: zero,
            yaw,
            yaw_rate: 0.0,
            yaw_acceleration: 0.0,
        }
    }
}

/// The attitude to follow, now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttitudeTarget {
    /// Desired body to world.
    pub attitude: UnitQuaternion<f32>,
    /// Desired Ωd, in the desired body's frame, rad/s.
    pub rates: Vector3<f32>,
    /// Its derivative in the same frame, Ω̇d, rad/s².
    pub accelerations: Vector3<f32>,
}

/// What the outer loop asks of the inner: an attitude with two derivatives, and the thrust.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttitudeReference {
    /// The tick for which the values hold; inner extrapolates from there.
    pub valid_at: Tick,
    /// Attitude, rates and accelerations.
    pub target: AttitudeTarget,
    /// Thrust U1, N.
    pub thrust_n: f32,
    /// U̇1, N/s.
    pub thrust_rate_n_s: f32,
}

impl AttitudeReference {
    /// An attitude at rest, without thrust.
    pub fn idle(attitude: UnitQuaternion<f32>) -> Self {
        let zero = Vector3::zeros();
        let target = AttitudeTarget { attitude, rates: zero, accelerations: zero };
        Self { valid_at: 0, target, thrust_n: 0.0, thrust_rate_n_s: 0.0 }
    }

    /// The attitude to follow `dt` seconds later, for turns of a few degrees: the quaternion's exponential to second
    /// order (3e-6 rad in 4 ms at 10 rad/s), the product's size to fourth.
    #[inline]
    pub fn target_after(&self, dt: f32) -> AttitudeTarget {
        let AttitudeTarget { attitude, rates, accelerations } = &self.target;
        let later = rates + accelerations * dt;
        // Half of dt times the mean of the rates now and then.
        let half = later * (0.5 * dt) - accelerations * (0.25 * dt * dt);
        let square = half.norm_squared();
        let turn = Quaternion::new(1.0 - 0.5 * square, half.x, half.y, half.z);
        AttitudeTarget {
            attitude: UnitQuaternion::new_unchecked(attitude.quaternion() * turn),
            rates: later,
            accelerations: *accelerations,
        }
    }
}

/// The four control inputs of Eq. 4.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ControlInput {
    /// U1, N.
    pub thrust_n: f32,
    /// U2, N m.
    pub roll_n_m: f32,
    /// U3, N m.
    pub pitch_n_m: f32,
    /// U4, N m.
    pub yaw_n_m: f32,
}

impl ControlInput {
    /// As U1..U4.
    pub const fn as_array(&self) -> [f32; 4] {
        [self.thrust_n, self.roll_n_m, self.pitch_n_m, self.yaw_n_m]
    }
}
