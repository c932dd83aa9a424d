//! Guidance: the reference position and its first four derivatives as functions of flight time.
//!
//! Owns the reference trajectories and the path that joins one from rest; [`setpoint`] generates the reference online
//! for a vehicle that is commanded in flight, [`hands`] says what sticks ask for. The outer partition evaluates the reference for the tick at which its
//! output takes effect. Time is a tick count, so a reference is as exact after an hour as after a second.

pub mod hands;
mod join;
pub mod setpoint;
mod spline;
pub mod stream;

pub use join::{JoinPath, JoinPlan, MIDDLE_POINTS};
pub use spline::{CONTROL_POINTS, DEGREE, DURATION_MAX_MS, Spline};

use nalgebra::Vector3;

use crate::config::Start;
use crate::math::{self, Phase};
use crate::signals::{FlatReference, TICK_S_EXACT, Tick};
use crate::validate::ConfigError;

/// A reference trajectory; t is the flight time in s. World frame NWU, m and rad.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "kebab-case", deny_unknown_fields)
)]
#[expect(
    clippy::large_enum_variant,
    reason = "a vehicle has one, and without an allocator the points have to be stored in it"
)]
pub enum Trajectory {
    /// A constant position.
    Hold {
        /// Position, m.
        position_m: [f32; 3],
        /// Heading ψd, rad.
        yaw_rad: f32,
    },
    /// A step from one position to another.
    Step {
        /// Position before the step, m.
        from_m: [f32; 3],
        /// Position after the step, m.
        to_m: [f32; 3],
        /// Flight time of the step, s.
        at_s: f32,
        /// Heading ψd, rad.
        yaw_rad: f32,
    },
    /// `(a sin ωt, b cos ωt, z0 + c t)`; the paper's is a = 4, b = 5, ω = 1, z0 = 2, c = 1.
    Helix {
        /// a and b, m.
        amplitude_m: [f32; 2],
        /// ω, rad/s.
        rate_rad_s: f32,
        /// z0, m.
        base_m: f32,
        /// c, m/s.
        climb_m_s: f32,
        /// Heading ψd, rad.
        yaw_rad: f32,
    },
    /// A horizontal figure eight about a centre: `(a sin ωt, b sin 2ωt, 0)`.
    FigureEight {
        /// Centre, m.
        center_m: [f32; 3],
        /// a and b, m.
        amplitude_m: [f32; 2],
        /// ω, rad/s.
        rate_rad_s: f32,
        /// Heading ψd, rad.
        yaw_rad: f32,
    },
    /// A spline that the desktop fits to waypoints or to a file.
    Spline(Spline),
}

impl Trajectory {
    /// The paper's helix, (4 sin t, 5 cos t, 2 + t).
    pub const PAPER_HELIX: Self =
        Self::Helix { amplitude_m: [4.0, 5.0], rate_rad_s: 1.0, base_m: 2.0, climb_m_s: 1.0, yaw_rad: 0.0 };

    /// Refuses a trajectory with NaN or an infinite value.
    ///
    /// # Errors
    /// The trajectory's name.
    pub fn validate(&self) -> Result<(), ConfigError> {
        let (name, finite) = match self {
            Self::Hold { position_m, yaw_rad } => {
                ("trajectory.hold", math::all_finite(position_m) && yaw_rad.is_finite())
            }
            Self::Step { from_m, to_m, at_s, yaw_rad } => (
                "trajectory.step",
                math::all_finite(from_m) && math::all_finite(to_m) && math::all_finite(&[*at_s, *yaw_rad]),
            ),
            Self::Helix { amplitude_m, rate_rad_s, base_m, climb_m_s, yaw_rad } => (
                "trajectory.helix",
                math::all_finite(amplitude_m) && math::all_finite(&[*rate_rad_s, *base_m, *climb_m_s, *yaw_rad]),
            ),
            Self::FigureEight { center_m, amplitude_m, rate_rad_s, yaw_rad } => (
                "trajectory.figure-eight",
                math::all_finite(center_m)
                    && math::all_finite(amplitude_m)
                    && math::all_finite(&[*rate_rad_s, *yaw_rad]),
            ),
            Self::Spline(path) => return path.validate(),
        };
        if finite { Ok(()) } else { Err(ConfigError::NonFinite(name.into())) }
    }
}

/// sin and cos of an angle that grows at a constant rate, and their time derivatives: entry k is the k-th derivative.
#[derive(Clone, Copy)]
struct Wave {
    sine: f32,
    cosine: f32,
    rate: f32,
}

impl Wave {
    fn new(angle: f32, rate: f32) -> Self {
        let (sine, cosine) = math::sin_cos(angle);
        Self { sine, cosine, rate }
    }

    /// `amplitude`·sin and its first four derivatives.
    fn sine(self, amplitude: f32) -> [f32; 5] {
        self.derivatives(amplitude, self.sine, self.cosine)
    }

    /// `amplitude`·cos and its first four derivatives.
    fn cosine(self, amplitude: f32) -> [f32; 5] {
        self.derivatives(amplitude, self.cosine, -self.sine)
    }

    /// f, f′, −f, −f′, f, each times its power of ω.
    fn derivatives(self, amplitude: f32, value: f32, slope: f32) -> [f32; 5] {
        let w = self.rate;
        let w2 = w * w;
        [
            amplitude * value,
            amplitude * w * slope,
            -amplitude * w2 * value,
            -amplitude * w2 * w * slope,
            amplitude * w2 * w2 * value,
        ]
    }
}

/// Combines the derivatives of the three axes.
fn flat(x: [f32; 5], y: [f32; 5], z: [f32; 5], yaw: f32) -> FlatReference {
    let vector = |k: usize| Vector3::new(x[k], y[k], z[k]);
    FlatReference {
        position: vector(0),
        velocity: vector(1),
        acceleration: vector(2),
        jerk: vector(3),
        snap: vector(4),
        yaw,
        yaw_rate: 0.0,
        yaw_acceleration: 0.0,
    }
}

/// A trajectory prepared for the loop, with the path that joins it.
///
/// ```
/// use firmware::guidance::{Guidance, JoinPlan, Trajectory};
/// use nalgebra::Vector3;
///
/// // The paper's helix, joined from rest at the origin within 3 s.
/// let plan = JoinPlan { duration_s: 3.0, start_acceleration_m_s2: [0.0; 3], middle_m: Default::default() };
/// let guidance = Guidance::new(Trajectory::PAPER_HELIX, Some(&plan), Vector3::zeros()).expect("finite values");
///
/// assert_eq!(guidance.at(0).position, Vector3::zeros());
/// // From 3 s on: (4 sin t, 5 cos t, 2 + t), here at t = 5 s.
/// let reference = guidance.at(5_000);
/// let exact = Vector3::new(4.0 * 5.0_f32.sin(), 5.0 * 5.0_f32.cos(), 7.0);
/// assert!((reference.position - exact).norm() < 1e-5);
/// assert!((reference.velocity.z - 1.0).abs() < 1e-6);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Guidance {
    phase: Phase,
    tick_s: f32,
    ticks_per_ms: u32,
    join: Option<JoinPath>,
    /// The joining path from another position, in place of the configured one.
    detour: Option<JoinPath>,
    trajectory: Trajectory,
}

impl Guidance {
    /// Prepares a trajectory, and the path that joins it from rest at `start`.
    ///
    /// # Errors
    /// The field of the trajectory or the plan that is out of range.
    pub fn new(trajectory: Trajectory, plan: Option<&JoinPlan>, start: Vector3<f32>) -> Result<Self, ConfigError> {
        let mut guidance = Self::with_tick(trajectory, TICK_S_EXACT)?;
        if let Some(plan) = plan {
            plan.validate()?;
            let end = guidance.trajectory_at(plan.duration_ticks());
            guidance.join = Some(JoinPath::new(plan, start, &end)?);
        }
        Ok(guidance)
    }

    /// A trajectory alone, with ticks of another length than the inner loop's (s).
    ///
    /// # Errors
    /// The field of the trajectory that is out of range.
    pub fn with_tick(trajectory: Trajectory, tick_s: f64) -> Result<Self, ConfigError> {
        trajectory.validate()?;
        let rate = match trajectory {
            Trajectory::Helix { rate_rad_s, .. } | Trajectory::FigureEight { rate_rad_s, .. } => rate_rad_s,
            Trajectory::Hold { .. } | Trajectory::Step { .. } | Trajectory::Spline(_) => 0.0,
        };
        Ok(Self {
            phase: Phase::new(rate, tick_s),
            tick_s: tick_s as f32,
            ticks_per_ms: (1e-3 / tick_s + 0.5) as u32,
            join: None,
            detour: None,
            trajectory,
        })
    }

    /// The reference `ticks` after the start of the flight: the joining path first, then the trajectory.
    pub fn at(&self, ticks: Tick) -> FlatReference {
        match self.detour.as_ref().or(self.join.as_ref()) {
            Some(join) if ticks < join.duration_ticks() => join.at(ticks),
            _ => self.trajectory_at(ticks),
        }
    }

    /// Position and heading at which a vehicle in the air waits at rest before the flight's clock starts: the start of
    /// the joining path. If that is on the ground, the height is at least that of the path's end.
    pub fn entry(&self, start: Start) -> (Vector3<f32>, f32) {
        let first = self.at(0);
        let mut entry = first.position;
        if start == Start::OnGround
            && let Some(join) = &self.join
        {
            entry.z = math::max(entry.z, self.trajectory_at(join.duration_ticks()).position.z);
        }
        (entry, first.yaw)
    }

    /// Plans the joining path from another position, for a vehicle at rest in the air before the clock starts. It takes
    /// as long as the configured one. Without a joining path in the configuration, nothing changes.
    pub fn join_from(&mut self, place: &Vector3<f32>) {
        /// The configured path may have been optimised: it is flown if it begins here.
        const SAME_PLACE_M: f32 = 0.02;
        let Some(join) = &self.join else { return };
        let same = (join.at(0).position - place).norm_squared() < SAME_PLACE_M * SAME_PLACE_M;
        let end = self.trajectory_at(join.duration_ticks());
        self.detour = if same { None } else { JoinPath::plain(join.duration_ticks(), *place, &end).ok() };
    }

    /// Returns to the configured joining path.
    pub fn join_from_start(&mut self) {
        self.detour = None;
    }

    /// The reference on the trajectory, without the joining path.
    pub fn trajectory_at(&self, ticks: Tick) -> FlatReference {
        let t = ticks as f32 * self.tick_s;
        match self.trajectory {
            Trajectory::Hold { position_m, yaw_rad } => FlatReference::standing(position_m.into(), yaw_rad),
            Trajectory::Step { from_m, to_m, at_s, yaw_rad } => {
                FlatReference::standing(if t < at_s { from_m } else { to_m }.into(), yaw_rad)
            }
            Trajectory::Helix { amplitude_m: [a, b], rate_rad_s, base_m, climb_m_s, yaw_rad } => {
                let wave = Wave::new(self.phase.at(ticks), rate_rad_s);
                let climb = [base_m + climb_m_s * t, climb_m_s, 0.0, 0.0, 0.0];
                flat(wave.sine(a), wave.cosine(b), climb, yaw_rad)
            }
            Trajectory::FigureEight { center_m, amplitude_m: [a, b], rate_rad_s, yaw_rad } => {
                let angle = self.phase.at(ticks);
                let once = Wave::new(angle, rate_rad_s);
                let twice = Wave::new(2.0 * angle, 2.0 * rate_rad_s);
                let mut reference = flat(once.sine(a), twice.sine(b), [0.0; 5], yaw_rad);
                reference.position += Vector3::from(center_m);
                reference
            }
            Trajectory::Spline(ref path) => path.at(ticks, self.ticks_per_ms),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signals::TICK_S;

    fn trajectories() -> [Trajectory; 3] {
        [
            Trajectory::PAPER_HELIX,
            Trajectory::FigureEight {
                center_m: [1.0, 2.0, 3.0],
                amplitude_m: [4.0, 2.0],
                rate_rad_s: 1.3,
                yaw_rad: 0.2,
            },
            Trajectory::Spline(Spline {
                begin_ms: 0,
                duration_ms: 9_000,
                repeat: true,
                turn_rad: 0.0,
                control_points: (0..12_u8).map(|i| [f32::from(i % 5), f32::from(i % 3), 2.0, 0.1]).collect(),
            }),
        ]
    }

    fn assert_derivatives(at: impl Fn(Tick) -> FlatReference, ticks: Tick) {
        let h = 20;
        let (before, now, after) = (at(ticks - h), at(ticks), at(ticks + h));
        let span = 2.0 * h as f32 * TICK_S;
        for (name, higher, low, high) in [
            ("velocity", now.velocity, before.position, after.position),
            ("acceleration", now.acceleration, before.velocity, after.velocity),
            ("jerk", now.jerk, before.acceleration, after.acceleration),
            ("snap", now.snap, before.jerk, after.jerk),
        ] {
            let error = (high - low) / span - higher;
            // h²/6 of truncation on the next derivative but one, and f32 rounding over 40 ms.
            assert!(error.norm() < 2e-3 * (1.0 + higher.norm()), "{name} at {ticks}: {error}");
        }
    }

    #[test]
    fn derivatives_are_those_of_the_position() {
        for trajectory in trajectories() {
            let guidance = Guidance::new(trajectory, None, Vector3::zeros()).expect("valid");
            for ticks in [100, 1_234, 7_777] {
                assert_derivatives(|t| guidance.at(t), ticks);
            }
        }
    }

    #[test]
    fn the_helix_is_the_papers() {
        let guidance = Guidance::new(Trajectory::PAPER_HELIX, None, Vector3::zeros()).expect("valid");
        for ticks in [0_u32, 500, 3_141, 20_000] {
            let t = f64::from(ticks) * 1e-3;
            let exact = [4.0 * t.sin(), 5.0 * t.cos(), 2.0 + t];
            for (value, exact) in guidance.at(ticks).position.iter().zip(exact) {
                assert!((f64::from(*value) - exact).abs() < 3e-6, "{ticks}: {value} {exact}");
            }
        }
    }
}
