//! Online setpoint generator: the reference towards a place, a height or a velocity that may change at any time.
//!
//! ```text
//! target ─► braking law ─► speed within limits ─► ∫ ─► course ─► lag ─► lag ─► lag ─► reference
//!                                acceleration within limits
//! ```
//!
//! The *course* is a point that goes to the target with limited speed and acceleration, along a straight line if it
//! starts from rest, and stops there by a braking law that is exact in discrete time. Its acceleration jumps. So the
//! reference follows it through three equal first-order lags, applied to position, velocity and acceleration alike.
//! That is a convolution with a non-negative kernel of area 1. Therefore
//!
//! - the reference's velocity and acceleration respect every limit that the course's respect, in any direction;
//! - it overshoots no target that the course does not overshoot;
//! - position to jerk are continuous whatever the target does, the jerk is at most `2 h a`, with h = 2 e⁻²/τ the peak
//!   of the kernel, and τ is chosen such that this is the jerk limit;
//! - its velocity is exactly the derivative of its position, step by step, as long as this holds for the course.
//!
//! The price is 3τ of delay, half a second with the usual limits. The heading is a fourth component.
//!
//! The course is an offset from an *anchor*, which moves along with it in steps of 128 m. Far from the origin an f32 is
//! coarser than a step: at 9 km it resolves 1 mm, and a course with 0.1 m/s moves by 0.4 mm per step. Added to the
//! coordinate itself, that would be rounded away.

use nalgebra::{Vector3, Vector4};

use crate::config::ModeSettings;
use crate::math;
use crate::schedule::OUTER;
use crate::signals::{FlatReference, TICK_S};

/// Time between two steps, s: a period of the outer partition.
const STEP_S: f32 = OUTER.period as f32 * TICK_S;

/// 4 e⁻²: twice the peak of the kernel of three lags, times their time constant.
const KERNEL: f32 = 0.541_341_1;

/// Greatest speeds on the way to a place, m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speeds {
    /// Over the ground.
    pub horizontal_m_s: f32,
    /// Upwards.
    pub up_m_s: f32,
    /// Downwards.
    pub down_m_s: f32,
}

impl Speeds {
    /// Those of the settings.
    pub fn usual(settings: &ModeSettings) -> Self {
        Self { horizontal_m_s: settings.cruise_m_s, up_m_s: settings.climb_m_s, down_m_s: settings.sink_m_s }
    }

    /// The greatest speed in a direction, m/s.
    fn along(&self, direction: &Vector3<f32>) -> f32 {
        let vertical = if direction.z > 0.0 { self.up_m_s } else { self.down_m_s };
        within(direction, self.horizontal_m_s, vertical)
    }
}

/// Target of the generator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// Go to a place and heading, and stay.
    Place {
        /// In the world, m.
        position: Vector3<f32>,
        /// ψ, rad; `None` to keep the heading.
        yaw: Option<f32>,
        /// Greatest speeds.
        speeds: Speeds,
    },
    /// Stop horizontally, and go to a height.
    Height {
        /// z in the world, m.
        height_m: f32,
        /// Greatest speed, m/s.
        speed_m_s: f32,
        /// ψ, rad; `None` to keep the heading.
        yaw: Option<f32>,
    },
    /// Move with a velocity and a yaw rate.
    Velocity {
        /// In the world, m/s.
        velocity: Vector3<f32>,
        /// ψ̇, rad/s.
        yaw_rate: f32,
    },
}

/// One of the lags: its distance behind the one before, and its velocity and acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Lag {
    behind: Vector4<f32>,
    velocity: Vector4<f32>,
    acceleration: Vector4<f32>,
}

/// The setpoint generator.
#[derive(Clone, Debug, PartialEq)]
pub struct Setpoint {
    limits: ModeSettings,
    /// Fraction of the distance to its input that a lag covers per step, 1 − e^(−h/τ).
    step_fraction: f32,
    /// Whether that is not what the limits want: other lags wait until the reference stands.
    waits: bool,
    /// Origin of the course's x, y and z, m: whole multiples of [`ANCHORS_M`], which an f32 holds and subtracts exactly.
    anchor: Vector3<f32>,
    /// x, y, z of the course from the anchor, and ψ; and their rates.
    place: Vector4<f32>,
    speed: Vector4<f32>,
    lags: [Lag; 3],
}

/// Distance between anchors, m: a power of two. Within it an f32 resolves 8 µm, a fiftieth of a step at 0.1 m/s.
const ANCHORS_M: f32 = 128.0;

fn four(vector: &Vector3<f32>, yaw: f32) -> Vector4<f32> {
    Vector4::new(vector.x, vector.y, vector.z, yaw)
}

/// The greatest speed after this step from which a point can still stop within `distance` (m) by `deceleration` (m/s²),
/// if it now moves with `speed` (m/s): the root of `s²/2a + h(v + s)/2 = d`, which decreases by exactly a·h per step.
fn braking_speed(distance: f32, speed: f32, deceleration: f32) -> f32 {
    let half = 0.5 * STEP_S * deceleration;
    let square = half * half + deceleration * (2.0 * distance - STEP_S * speed);
    math::max(math::sqrt(math::max(square, 0.0)) - half, 0.0)
}

/// The displacement and the change of speed in a step, along a line towards a point `distance` away, with the speed
/// limited to `most` and its change by `acceleration`. `grain` is the rounding error of the distance, m.
fn approach(distance: f32, speed: f32, most: f32, acceleration: f32, grain: f32) -> (f32, f32) {
    let change_max = acceleration * STEP_S;
    if math::abs(distance) <= change_max * STEP_S + grain && math::abs(speed) <= change_max {
        return (distance, -speed);
    }
    let sign = if distance < 0.0 { -1.0 } else { 1.0 };
    let wanted = sign * math::min(braking_speed(math::abs(distance), sign * speed, BRAKING * acceleration), most);
    moved(speed, math::limit(wanted - speed, change_max))
}

/// The displacement in a step with a change of speed, and the change.
fn moved(speed: f32, change: f32) -> (f32, f32) {
    ((speed + 0.5 * change) * STEP_S, change)
}

/// Below this the reference stands, m/s, m/s² and rad/s.
const STANDS: f32 = 1e-3;
/// Greatest time constant of a lag with which a moving reference is taken over, s: with slower lags the course would be far
/// ahead of it, and much faster. An acceleration that would need more, far beyond what the jerk suits, exceeds the jerk limit.
const TAKES_OVER_S: f32 = 0.7;

/// Greatest time constant of a lag, s: the reference is three of them late. An acceleration that would need more, far beyond
/// what the jerk suits, exceeds the jerk limit.
const SLOWEST_S: f32 = 2.0;

/// Time constant of a lag for which the jerk is limited, s.
fn time_constant_s(limits: &ModeSettings) -> f32 {
    let fastest = math::max(limits.acceleration_m_s2, limits.vertical_acceleration_m_s2);
    math::min(KERNEL * fastest / limits.jerk_m_s3, SLOWEST_S)
}

/// The same for going on from an acceleration that may be beyond the limit, m/s²: the course's may be against it, and later
/// against its own.
fn takes_over_s(limits: &ModeSettings, acceleration: &Vector3<f32>) -> f32 {
    let across = math::sqrt(acceleration.xy().norm_squared()) + limits.acceleration_m_s2;
    let along = math::abs(acceleration.z) + limits.vertical_acceleration_m_s2;
    let needed_s = 0.5 * KERNEL * math::max(across, along) / limits.jerk_m_s3;
    math::min(math::max(needed_s, time_constant_s(limits)), TAKES_OVER_S)
}

/// Delay of the reference behind the course, s.
pub(crate) fn delay_s(limits: &ModeSettings) -> f32 {
    3.0 * time_constant_s(limits)
}

/// Fraction of the distance to its input that a lag with a time constant covers per step.
fn step_fraction(time_constant_s: f32) -> f32 {
    1.0 - math::exp(-STEP_S / time_constant_s)
}

/// Fraction of the acceleration that braking is planned with; the rest keeps the course on its line.
const BRAKING: f32 = 0.95;

/// Relative rounding error of a coordinate: several units in the last place of an f32.
const GRAIN: f32 = 1e-6;

impl Setpoint {
    /// A generator at rest at the origin, with valid limits.
    pub fn new(limits: &ModeSettings) -> Self {
        let zero = Vector4::zeros();
        Self {
            limits: *limits,
            step_fraction: step_fraction(time_constant_s(limits)),
            waits: false,
            anchor: Vector3::zeros(),
            place: zero,
            speed: zero,
            lags: [Lag { behind: zero, velocity: zero, acceleration: zero }; 3],
        }
    }

    /// Goes on within other limits, without a jump in position to snap. What is faster than they allow slows down.
    pub fn limit(&mut self, limits: &ModeSettings) {
        let reference = self.reference();
        self.limits = *limits;
        // Slower lags wait until the reference stands: while it moves, the course would have to be far ahead and too fast.
        let wanted = step_fraction(time_constant_s(limits));
        if wanted > self.step_fraction {
            self.start(&reference);
        } else {
            self.waits = wanted < self.step_fraction;
            if self.waits {
                self.wait();
            }
        }
    }

    /// Other lags, once the reference stands.
    #[cold]
    fn wait(&mut self) {
        let moves = |rates: &Vector4<f32>| rates.amax() > STANDS;
        if !moves(&self.speed) && !self.lags.iter().any(|lag| moves(&lag.velocity) || moves(&lag.acceleration)) {
            self.start(&FlatReference { snap: Vector3::zeros(), jerk: Vector3::zeros(), ..self.reference() });
        }
    }

    /// Continues from a reference without a jump in position to snap: the course is set ahead of it by the distance
    /// that the lags are behind.
    pub fn start(&mut self, from: &FlatReference) {
        let stands = from.velocity.amax() + from.acceleration.amax() + from.jerk.amax() <= 3.0 * STANDS;
        let (usual_s, moving_s) = (time_constant_s(&self.limits), takes_over_s(&self.limits, &from.acceleration));
        self.step_fraction = step_fraction(if stands { usual_s } else { moving_s });
        self.waits = !stands && moving_s != usual_s;
        let ahead_s = STEP_S / self.step_fraction;
        let mut velocity = four(&from.velocity, from.yaw_rate);
        let mut acceleration = four(&from.acceleration, from.yaw_acceleration);
        let mut jerk = four(&from.jerk, 0.0);
        let snap = four(&from.snap, 0.0);
        self.anchor = Vector3::zeros();
        self.place = four(&from.position, from.yaw);
        self.drop_anchor();
        for lag in self.lags.iter_mut().rev() {
            let behind = (velocity + acceleration * (0.5 * STEP_S)) * ahead_s;
            *lag = Lag { behind, velocity, acceleration };
            self.place += behind;
            velocity += acceleration * ahead_s;
            acceleration += jerk * ahead_s;
            jerk += snap * ahead_s;
        }
        self.speed = velocity;
    }

    /// Advances by a step towards a target, and returns the new reference.
    pub fn advance(&mut self, target: &Target) -> FlatReference {
        if self.waits {
            self.wait();
        }
        let (way, change) = self.translate(target);
        let (angle, rate_change) = self.turn(target);
        let (way, change) = (four(&way, angle), four(&change, rate_change));
        self.follow(&way, &(change / STEP_S));
        self.place += way;
        self.drop_anchor();
        self.place.w = math::wrap_angle(self.place.w);
        self.speed += change;
        self.reference()
    }

    /// Moves the reference to a horizontal position (m), keeping its velocity and higher derivatives.
    pub fn put_horizontally(&mut self, x: f32, y: f32) {
        let behind = self.behind();
        self.place.x = x - self.anchor.x + behind.x;
        self.place.y = y - self.anchor.y + behind.y;
        self.drop_anchor();
    }

    /// Moves the reference to a height (m), keeping its velocity and higher derivatives.
    pub fn put_vertically(&mut self, z: f32) {
        self.place.z = z - self.anchor.z + self.behind().z;
        self.drop_anchor();
    }

    /// Moves the anchor to the course where that has gone far from it. Exact: neither changes where the course is.
    #[inline]
    fn drop_anchor(&mut self) {
        if self.place.xyz().amax() > ANCHORS_M {
            self.move_anchor();
        }
    }

    #[cold]
    fn move_anchor(&mut self) {
        let by = self.place.xyz().map(|offset| (offset / ANCHORS_M) as i32 as f32 * ANCHORS_M);
        self.anchor += by;
        for (offset, step) in self.place.iter_mut().zip(&by) {
            *offset -= step;
        }
    }

    /// The displacement of the course in this step, and the change of its velocity.
    fn translate(&self, target: &Target) -> (Vector3<f32>, Vector3<f32>) {
        let (place, speed, limits) = (self.place.xyz(), self.speed.xyz(), &self.limits);
        match *target {
            Target::Place { position, speeds, .. } => {
                let position = position - self.anchor;
                self.go(&(position - place), &speeds, GRAIN * position.amax())
            }
            Target::Height { height_m, speed_m_s, .. } => {
                let height_m = height_m - self.anchor.z;
                let distance = height_m - place.z;
                let most = math::min(speed_m_s, if distance > 0.0 { limits.climb_m_s } else { limits.sink_m_s });
                let acceleration = limits.vertical_acceleration_m_s2;
                let (rise, faster) = approach(distance, speed.z, most, acceleration, GRAIN * math::abs(height_m));
                let (way, mut change) = self.change_speed(&Vector3::new(-speed.x, -speed.y, 0.0));
                change.z = faster;
                (Vector3::new(way.x, way.y, rise), change)
            }
            Target::Velocity { velocity, .. } => self.change_speed(&(self.within_limits(&velocity) - speed)),
        }
    }

    /// Moves the course along the straight line to a place `away`; motion off that line is braked.
    fn go(&self, away: &Vector3<f32>, speeds: &Speeds, grain: f32) -> (Vector3<f32>, Vector3<f32>) {
        let speed = self.speed.xyz();
        let distance = math::sqrt(away.norm_squared());
        let direction = away / math::max(distance, 1e-9);
        let acceleration = self.acceleration_along(&direction);
        let change_max = acceleration * STEP_S;
        if distance <= change_max * STEP_S + grain && speed.norm_squared() <= change_max * change_max {
            return (*away, -speed);
        }
        let now = speed.dot(&direction);
        // A larger change than one step allows would be reached sooner along one axis than along another.
        let most = math::min(speeds.along(&direction), math::max(now, 0.0) + change_max);
        let along = math::min(braking_speed(distance, now, BRAKING * acceleration), most);
        self.change_speed(&(direction * along - speed))
    }

    /// A change of velocity limited by the acceleration, and the displacement of the course with it.
    fn change_speed(&self, change: &Vector3<f32>) -> (Vector3<f32>, Vector3<f32>) {
        let horizontal = shorten(change.x, change.y, self.limits.acceleration_m_s2 * STEP_S);
        let vertical = math::limit(change.z, self.limits.vertical_acceleration_m_s2 * STEP_S);
        let change = Vector3::new(horizontal.0, horizontal.1, vertical);
        ((self.speed.xyz() + change * 0.5) * STEP_S, change)
    }

    /// A velocity limited in its horizontal and vertical components.
    fn within_limits(&self, velocity: &Vector3<f32>) -> Vector3<f32> {
        let (x, y) = shorten(velocity.x, velocity.y, self.limits.fastest_m_s);
        Vector3::new(x, y, math::clamp(velocity.z, -self.limits.sink_m_s, self.limits.climb_m_s))
    }

    /// Greatest acceleration in a direction, m/s².
    fn acceleration_along(&self, direction: &Vector3<f32>) -> f32 {
        within(direction, self.limits.acceleration_m_s2, self.limits.vertical_acceleration_m_s2)
    }

    /// The yaw angle that the course turns by in this step, and the change of its rate.
    fn turn(&self, target: &Target) -> (f32, f32) {
        let (rate, most, acceleration) =
            (self.speed.w, self.limits.yaw_rate_rad_s, self.limits.yaw_acceleration_rad_s2);
        let to_rate = |wanted: f32| moved(rate, math::limit(wanted - rate, acceleration * STEP_S));
        match *target {
            Target::Place { yaw: Some(yaw), .. } | Target::Height { yaw: Some(yaw), .. } => {
                approach(math::wrap_angle(yaw - self.place.w), rate, most, acceleration, GRAIN)
            }
            Target::Place { yaw: None, .. } | Target::Height { yaw: None, .. } => to_rate(0.0),
            Target::Velocity { yaw_rate, .. } => to_rate(math::limit(yaw_rate, most)),
        }
    }

    /// Advances the lags by a step in which the course moves by `way` with an acceleration.
    fn follow(&mut self, way: &Vector4<f32>, acceleration: &Vector4<f32>) {
        let gain = self.step_fraction;
        let (mut way, mut velocity, mut acceleration) = (*way, self.speed, *acceleration);
        for lag in &mut self.lags {
            let before = *lag;
            lag.velocity += (velocity - before.velocity) * gain;
            lag.acceleration += (acceleration - before.acceleration) * gain;
            let own_way = before.behind * gain;
            lag.behind += way - own_way;
            (way, velocity, acceleration) = (own_way, before.velocity, before.acceleration);
        }
    }

    /// Distance of the reference behind the course.
    fn behind(&self) -> Vector4<f32> {
        self.lags.iter().fold(Vector4::zeros(), |sum, lag| sum + lag.behind)
    }

    /// The reference now.
    pub fn reference(&self) -> FlatReference {
        let per_s = self.step_fraction / STEP_S;
        let [first, second, third] = &self.lags;
        let place = self.place - self.behind();
        let jerk = (second.acceleration - third.acceleration) * per_s;
        let jerk_before = (first.acceleration - second.acceleration) * per_s;
        FlatReference {
            position: self.anchor + place.xyz(),
            velocity: third.velocity.xyz(),
            acceleration: third.acceleration.xyz(),
            jerk: jerk.xyz(),
            snap: ((jerk_before - jerk) * per_s).xyz(),
            yaw: math::wrap_angle(place.w),
            yaw_rate: third.velocity.w,
            yaw_acceleration: third.acceleration.w,
        }
    }
}

/// The greatest length of a vector along a direction, with limits on its horizontal and vertical components.
fn within(direction: &Vector3<f32>, horizontal: f32, vertical: f32) -> f32 {
    let level = math::sqrt(direction.x * direction.x + direction.y * direction.y);
    let up = math::abs(direction.z);
    // One of the two is 0.7 at least, unless the direction is zero.
    math::min(horizontal / math::max(level, 1e-6), vertical / math::max(up, 1e-6))
}

/// A horizontal vector limited to the length `most`.
fn shorten(x: f32, y: f32, most: f32) -> (f32, f32) {
    let size = math::sqrt(x * x + y * y);
    let scale = if size > most { most / size } else { 1.0 };
    (x * scale, y * scale)
}

#[cfg(test)]
#[path = "setpoint_tests.rs"]
pub(super) mod tests;
