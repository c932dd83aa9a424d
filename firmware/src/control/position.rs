//! Position control, Eq. 28, 30 and 31: sliding mode on x, y, z, as a specific force and its derivatives.
//!
//! The paper's three laws share one form. With Ux U1/m, Uy U1/m and U1 cφcθ/m as the components of the specific force f
//! (Eq. 2), each reads `f = r̈d − c ṙ + λ ė + u_r(s)`, plus g on z. In this form the divisions by U1 and by cφ cθ
//! disappear, and with them their singularities; [`paper_inputs`] returns U1, Ux, Uy as printed.

use nalgebra::Vector3;

use crate::airframe::Airframe;
use crate::control::flatness::ForceProfile;
use crate::control::law::{LawState, PositionDemand, PositionInput, PositionLaw};
use crate::control::observer::{DisturbanceObserver, ObserverGains, ThrustEffectiveness};
use crate::control::sliding::{AxisGains, Correction, SlidingAxis};
use crate::math;
use crate::schedule::{OUTER, OUTER_AHEAD_S};
use crate::settings::{Change, Place};
use crate::signals::{FlatReference, TICK_S};
use crate::validate::{ConfigError, Range};

/// Gains of the position loop.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct PositionGains {
    /// x, y, z.
    pub axes: [AxisGains; 3],
    /// Observer of the acceleration's disturbance, m/s².
    pub observer: ObserverGains,
    /// Rate γ at which the thrust effectiveness adapts to the disturbance along the thrust, 1/s; 0 to disable.
    pub effectiveness_rate: f32,
}

impl PositionGains {
    /// Accepted rates γ.
    pub const EFFECTIVENESS_RATES: Range = Range::NotNegative;

    /// Checks that the law is defined for these gains.
    ///
    /// # Errors
    /// The first gain that is out of range.
    pub fn validate(&self) -> Result<(), ConfigError> {
        let [x, y, z] = &self.axes;
        x.validate("control.x")?;
        y.validate("control.y")?;
        z.validate("control.z")?;
        self.observer.validate("control.position_observer")?;
        Self::EFFECTIVENESS_RATES.check("control.effectiveness_rate", self.effectiveness_rate)
    }
}

/// The translational model that position laws compensate, ready for the loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Translation {
    /// k1..k3 over m: −c9..c11, 1/s.
    pub specific_drag: Vector3<f32>,
    /// g, m/s².
    pub gravity: f32,
}

impl Translation {
    /// For an airframe.
    pub fn new(airframe: &Airframe) -> Self {
        Self { specific_drag: Vector3::from(airframe.drag_n_s_m) / airframe.mass_kg, gravity: airframe.gravity_m_s2 }
    }

    /// r̈ = f − (k/m) ṙ − g e3, the translational half of Eq. 2.
    #[inline]
    pub fn acceleration(&self, force: &Vector3<f32>, velocity: &Vector3<f32>) -> Vector3<f32> {
        let mut acceleration = force - self.drag(velocity);
        acceleration.z -= self.gravity;
        acceleration
    }

    /// The f that gives an acceleration r̈: the inverse of [`acceleration`](Self::acceleration).
    #[inline]
    pub fn force(&self, acceleration: &Vector3<f32>, velocity: &Vector3<f32>) -> Vector3<f32> {
        let mut force = acceleration + self.drag(velocity);
        force.z += self.gravity;
        force
    }

    /// (k/m) ṙ, m/s²; or its derivatives, for those of ṙ.
    #[inline]
    pub fn drag(&self, velocity: &Vector3<f32>) -> Vector3<f32> {
        self.specific_drag.component_mul(velocity)
    }
}

/// Sliding mode control of the position, in the loop.
#[derive(Clone, Debug)]
#[repr(C)]
pub struct SlidingPosition {
    axes: [SlidingAxis; 3],
    model: Translation,
    observer: Option<DisturbanceObserver>,
    effectiveness: ThrustEffectiveness,
    /// What the above was built from, to be changed in flight.
    gains: PositionGains,
}

/// Time between two steps, s: a period of the outer partition.
const STEP_S: f32 = OUTER.period as f32 * TICK_S;

impl SlidingPosition {
    /// With valid gains; evaluated once per job of the outer partition.
    pub fn new(airframe: &Airframe, gains: &PositionGains) -> Self {
        let observer = gains.observer;
        Self {
            axes: gains.axes.map(|axis| SlidingAxis::new(&axis, STEP_S)),
            model: Translation::new(airframe),
            observer: (observer.bandwidth_rad_s > 0.0).then(|| DisturbanceObserver::new(&observer, STEP_S)),
            effectiveness: ThrustEffectiveness::new(gains.effectiveness_rate, STEP_S),
            gains: *gains,
        }
    }

    /// The acceleration that the model does not explain, m/s², and d̂, the component of it that is not a thrust error.
    #[inline]
    fn observe(&mut self, input: &PositionInput) -> (Vector3<f32>, Vector3<f32>) {
        let Some(observer) = &mut self.observer else { return (Vector3::zeros(), Vector3::zeros()) };
        let force = self.model.force(input.acceleration, input.velocity);
        let wrong_thrust = force * (self.effectiveness.value() - 1.0);
        let beyond = wrong_thrust + observer.estimate(input.velocity, &(input.acceleration + wrong_thrust));
        self.effectiveness.adapt(&force, observer);
        (beyond, observer.disturbance())
    }
}

impl PositionLaw for SlidingPosition {
    /// Eq. 28, 30, 31 as a specific force, minus the disturbance, with its derivatives. ḟ neglects the derivatives of
    /// the disturbance, of v of super-twisting, and of the drag off the reference. f̈ contains only the reference's
    /// snap and drag, because the second derivative of the feedback would need the jerk.
    #[inline]
    fn step(&mut self, input: &PositionInput) -> PositionDemand {
        let reference = input.reference;
        let (beyond, disturbance) = self.observe(input);
        // The motion was predicted by the model alone, without the disturbance.
        let velocity = input.velocity + beyond * OUTER_AHEAD_S;
        let demand = demand(&mut self.axes, &self.model, reference, input.position, &velocity, input.limited);
        let error = reference.position - input.position;
        let error_rate = reference.velocity - velocity;
        let error_acceleration = reference.acceleration - (input.acceleration + beyond);
        let rate = |i: usize, axis: &SlidingAxis| {
            axis.correction_rate(demand.s[i], error[i], error_rate[i], error_acceleration[i])
        };
        let [x, y, z] = &self.axes;
        let correction_rate = Vector3::new(rate(0, x), rate(1, y), rate(2, z));
        // What the model's thrust has to be for the real one to be as wanted.
        let share = 1.0 / self.effectiveness.value();
        PositionDemand {
            s: demand.s,
            profile: ForceProfile {
                force: (demand.force - disturbance) * share,
                rate: (reference.jerk + self.model.drag(&reference.acceleration) + correction_rate) * share,
                acceleration: (reference.snap + self.model.drag(&reference.jerk)) * share,
            },
        }
    }

    fn thrust_effectiveness(&self) -> f32 {
        self.effectiveness.value()
    }

    fn state(&self) -> LawState {
        let [x, y, z] = &self.axes;
        LawState {
            reaching: Vector3::new(x.reaching(), y.reaching(), z.reaching()),
            disturbance: self.observer.as_ref().map_or_else(Vector3::zeros, DisturbanceObserver::disturbance),
        }
    }

    fn reset(&mut self) {
        self.axes.iter_mut().for_each(SlidingAxis::reset);
        if let Some(observer) = &mut self.observer {
            observer.reset();
        }
        self.effectiveness.reset();
    }

    fn retune(&mut self, change: &Change) {
        if !change.apply_to(&mut self.gains, Place::position) {
            return;
        }
        for (axis, gains) in self.axes.iter_mut().zip(&self.gains.axes) {
            axis.retune(gains);
        }
        DisturbanceObserver::retune(&mut self.observer, &self.gains.observer, STEP_S);
        self.effectiveness.retune(self.gains.effectiveness_rate, STEP_S);
    }
}

/// Sliding variables sx, sy, sz and the demanded specific force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceDemand {
    /// Eq. 21–23, m/s.
    pub s: Vector3<f32>,
    /// f, m/s².
    pub force: Vector3<f32>,
}

/// Eq. 28, 30, 31 as a specific force (see the module text). `hold` as in [`SlidingAxis::correction`].
#[inline]
pub fn demand(
    axes: &mut [SlidingAxis; 3],
    model: &Translation,
    reference: &FlatReference,
    position: &Vector3<f32>,
    velocity: &Vector3<f32>,
    hold: bool,
) -> ForceDemand {
    let error = reference.position - position;
    let error_rate = reference.velocity - velocity;
    let [gx, gy, gz] = axes;
    let x = gx.correction(error.x, error_rate.x, hold);
    let y = gy.correction(error.y, error_rate.y, hold);
    let z = gz.correction(error.z, error_rate.z, hold);
    let along = |axis: Correction| axis.acceleration;
    let correction = Vector3::new(along(x), along(y), along(z) + model.gravity);
    ForceDemand { s: Vector3::new(x.s, y.s, z.s), force: reference.acceleration + model.drag(velocity) + correction }
}

/// Limits of the force that the rotors can give.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceLimits {
    /// Greatest specific force, m/s².
    force_max: f32,
    /// Tangent of the greatest tilt.
    tan_tilt_max: f32,
    /// Least vertical component, m/s².
    floor: f32,
    /// What feet may bear a part of, m/s²; 0 for a vehicle that flies.
    weight: f32,
}

/// Least vertical component as a fraction of the greatest force: the thrust axis must not point down.
const FLOOR: f32 = 0.02;

/// Tangent of the greatest tilt of a vehicle that feet may bear, while its rotors carry all of its weight: enough against a
/// storm. With less it goes by the square of what they carry.
const TAN_TILT_ON_FEET: f32 = 0.5;

impl ForceLimits {
    /// For an airframe and a greatest tilt (rad).
    pub fn new(airframe: &Airframe, tilt_max_rad: f32) -> Self {
        let force_max = airframe.thrust_max_n() / airframe.mass_kg;
        Self { force_max, tan_tilt_max: 0.0, floor: FLOOR * force_max, weight: 0.0 }.with_tilt(tilt_max_rad)
    }

    /// The same with another greatest tilt (rad).
    #[must_use]
    pub fn with_tilt(self, tilt_max_rad: f32) -> Self {
        let (sin_tilt, cos_tilt) = math::sin_cos(tilt_max_rad);
        Self { tan_tilt_max: sin_tilt / cos_tilt, ..self }
    }

    /// The same with a vertical component of at least this, m/s², or as it was made.
    #[must_use]
    pub fn with_floor(self, floor: Option<f32>) -> Self {
        let least = FLOOR * self.force_max;
        Self { floor: floor.map_or(least, |floor| math::clamp(floor, least, self.force_max)), ..self }
    }

    /// The same for a vehicle whose feet may bear a part of its weight (as a specific force, m/s²), or for one that flies.
    /// Feet hold it against a horizontal force. One that is given all the same leans it over, the more the less the rotors
    /// carry, until one of them stands still and its heading is lost.
    #[must_use]
    pub fn with_feet(self, weight: Option<f32>) -> Self {
        Self { weight: weight.unwrap_or(0.0), ..self }
    }

    /// Tangent of the greatest tilt.
    pub fn tan_tilt_max(&self) -> f32 {
        self.tan_tilt_max
    }

    /// Greatest specific force, m/s².
    pub fn force_max(&self) -> f32 {
        self.force_max
    }

    /// Limits a specific force: the vertical component from below, the magnitude and the tilt from above. The vertical
    /// component has priority over the horizontal ones. Returns whether a limit acted; the derivatives are then those
    /// of another force, and are set to zero.
    #[inline]
    pub fn apply(&self, profile: &mut ForceProfile) -> bool {
        let (force, force_max) = (profile.force, self.force_max);
        let vertical = math::clamp(force.z, self.floor, force_max);
        let by_size = math::sqrt(math::max(force_max * force_max - vertical * vertical, 0.0));
        let tan_tilt_max = if self.weight > 0.0 {
            let carried = math::min(vertical / self.weight, 1.0);
            math::min(self.tan_tilt_max, TAN_TILT_ON_FEET * carried * carried)
        } else {
            self.tan_tilt_max
        };
        let limit = math::min(by_size, vertical * tan_tilt_max);
        let horizontal = math::sqrt(force.x * force.x + force.y * force.y);
        let scale = if horizontal > limit { limit / horizontal } else { 1.0 };
        let limited = scale < 1.0 || vertical != force.z;
        if limited {
            let zero = Vector3::zeros();
            let force = Vector3::new(force.x * scale, force.y * scale, vertical);
            *profile = ForceProfile { force, rate: zero, acceleration: zero };
        }
        limited
    }
}

/// U1, Ux, Uy as printed in Eq. 28, 30 and 31, from the demanded force and the cosines of roll and pitch.
///
/// Ux and Uy are not limited; they are not finite if U1 is zero.
pub fn paper_inputs(airframe: &Airframe, force: &Vector3<f32>, cos_roll: f32, cos_pitch: f32) -> (f32, f32, f32) {
    let thrust = airframe.mass_kg * force.z / (cos_roll * cos_pitch);
    let scale = airframe.mass_kg / thrust;
    (thrust, force.x * scale, force.y * scale)
}
