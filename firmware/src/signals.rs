//! The plain data that flows between the partitions (see the picture in the crate docs).
//!
//! World frame NWU (north, west, up), body frame FLU (forward, left, up), SI units. Only `frames` converts to others.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::airframe::ROTORS;
use crate::math;
use crate::sensors::Measurements;

/// Time in ticks of the inner loop since boot, [`TICK_US`] each; wraps around.
pub type Tick = u32;

/// Length of a tick, µs: the inner loop runs at 1 kHz.
pub const TICK_US: u32 = 1_000;

/// Length of a tick, s.
pub const TICK_S: f32 = 1e-3;

/// Length of a tick, s, in double precision: for times that must not drift over hours.
pub const TICK_S_EXACT: f64 = TICK_US as f64 * 1e-6;

/// Motion of the vehicle.
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

    /// The same at a position, m.
    pub fn at_rest_at(position: Vector3<f32>) -> Self {
        Self { position, ..Self::at_rest() }
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

/// Which components of the motion may be trusted. Angular rates are valid whenever the attitude is.
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
    /// Vertical velocity: stays valid for a while after the height is lost, by integrating the accelerometers.
    pub climb: bool,
}

impl NavHealth {
    /// Everything, as on ideal state.
    pub const ALL: Self =
        Self { attitude: true, heading: true, velocity: true, position: true, height: true, climb: true };
    /// Nothing.
    pub const NONE: Self =
        Self { attitude: false, heading: false, velocity: false, position: false, height: false, climb: false };
}

/// Sensor input of one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SensorFrame {
    /// Ideal state: the vehicle's true motion at this tick, for comparing control laws.
    Motion(NavState),
    /// Measurements of sensors.
    Measured(Measurements),
}

/// Commanded rotor speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorCommand {
    /// One speed per rotor, rad/s, 0..=ωmax.
    pub omega_rad_s: [f32; ROTORS],
}

impl MotorCommand {
    /// All rotors stopped.
    pub const STOPPED: Self = Self { omega_rad_s: [0.0; ROTORS] };
}

/// Position and heading reference with derivatives, up to snap: the flat outputs.
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

/// Attitude setpoint with two derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttitudeTarget {
    /// Desired body to world.
    pub attitude: UnitQuaternion<f32>,
    /// Desired Ωd, in the desired body's frame, rad/s.
    pub rates: Vector3<f32>,
    /// Its derivative in the same frame, Ω̇d, rad/s².
    pub accelerations: Vector3<f32>,
}

/// Reference of the outer loop for the inner: attitude with two derivatives, and thrust.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttitudeReference {
    /// The tick at which the values are valid; the inner loop extrapolates from there.
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

    /// The attitude setpoint extrapolated by `dt` seconds, for turns of a few degrees: the quaternion exponential to
    /// second order (an error of 3e-6 rad over 4 ms at 10 rad/s), its norm to fourth order.
    #[inline]
    pub fn target_after(&self, dt: f32) -> AttitudeTarget {
        let AttitudeTarget { attitude, rates, accelerations } = &self.target;
        let later = rates + accelerations * dt;
        // Half of dt times the mean rate.
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
