//! Follows an estimated target: the motion of the reference *relative to it* is brought to rest within limits.
//!
//! ```text
//! place error ─► braking curve ─► speed error ─► acceleration ─► jerk ─► lag ─► ∫∫∫ reference
//!                 + target's speed    + target's acceleration    + target's jerk
//! ```
//!
//! Each stage's output is the derivative of what the stage before wants, plus a correction of its error, so that a step is
//! braked along one curve. The curve and the corrections are linear near zero, where noise and small errors live, and
//! bend where the linear law would exceed the jerk, then the acceleration (derivation at [`Curve`]).
//!
//! Everything is a vector of its [`Chain`]: with N = 2 the horizontal motion, which therefore goes along a straight line at
//! any bearing; with N = 1 the vertical motion, and the heading.

use nalgebra::SVector;

use super::STEP_S;
use crate::math;

/// Slope of the braking curve at its end, rad/s: the position bandwidth for small errors.
const PLACE_RAD_S: f32 = 5.5;
/// Gain of a small speed error, rad/s.
const SPEED_RAD_S: f32 = 6.0;
/// Gain of an acceleration error, rad/s.
const ACCELERATION_RAD_S: f32 = 24.0;
/// Time constant of the lag that makes the jerk continuous, s.
const JERK_LAG_S: f32 = 0.012;
/// Fraction of the jerk's way to its wanted value in a step, about 1 − e^(−h/τ).
const JERK_FRACTION: f32 = 0.283_468_7;
/// What is planned with is the state after the delay of the two last stages, s.
const AHEAD_S: f32 = JERK_LAG_S + 1.0 / ACCELERATION_RAD_S;
/// Fraction of the acceleration that the braking curve uses; the rest corrects.
const BRAKING: f32 = 0.92;
/// Fraction of the jerk that the braking curve uses, and that the approach to a speed uses.
const EASING: f32 = 0.75;
const CHANGING: f32 = 0.8;
/// The reference may be so much faster than the fastest target: it is not held back on one of these.
const FASTER: f32 = 1.02;

/// Vector of a chain.
pub(super) type Axes<const N: usize> = SVector<f32, N>;

/// What a target does now; places are offsets from the anchor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Target<const N: usize> {
    pub(super) place: Axes<N>,
    pub(super) speed: Axes<N>,
    pub(super) acceleration: Axes<N>,
    pub(super) jerk: Axes<N>,
    /// 1 for each axis whose place is given, 0 for the others.
    pub(super) placed: Axes<N>,
    /// Whether it has moved in one way for a while, so that its jerk is well known.
    pub(super) settled: bool,
}

/// Limits of a chain. `up` holds in the direction of the positive axis, `down` in the other; equal if N = 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Limits {
    /// Speed relative to the target.
    pub(super) up: f32,
    pub(super) down: f32,
    /// Speed of the target and of the reference.
    pub(super) fastest_up: f32,
    pub(super) fastest_down: f32,
    /// Acceleration relative to the target, and of the target and the reference.
    pub(super) acceleration: f32,
    pub(super) strongest: f32,
    /// Jerk relative to the target, and of the reference until the target has settled; and the former while the speed of
    /// target and reference is at its limit.
    pub(super) jerk: f32,
    pub(super) sharpest: f32,
    /// Whether the axis is an angle.
    pub(super) turns: bool,
}

/// The greatest speed towards a place as a function of the distance d.
///
/// `v = c ((d + δ)^(2/3) − δ^(2/3))` with `c = ½ J (6/J)^(2/3)`. With δ = 0 that is braking with constant jerk J. With
/// r = 1 − (δ/(d + δ))^(2/3), the jerk along the curve is J (2r − r²), below J everywhere, and the slope at d = 0 is
/// `⅔ c δ^(-1/3)`, finite. From the distance at which the deceleration v v′ reaches A, the curve goes on with A:
/// `v² = v_A² + 2 A (d − d_A)`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Curve {
    scale: f32,
    /// δ^(1/3).
    root: f32,
    deceleration: f32,
    bend: f32,
    bend_speed: f32,
}

impl Curve {
    fn new(deceleration: f32, jerk: f32) -> Self {
        // ½·6^(2/3).
        let scale = 1.650_963_6 * cube_root(jerk);
        let root = 2.0 * scale / (3.0 * PLACE_RAD_S);
        // v v′ = A, as a quadratic equation for y = (d + δ)^(1/3).
        let half = 0.75 * deceleration / (scale * scale);
        let y = half + math::sqrt(half * half + root * root);
        let bend = y * y * y - root * root * root;
        Self { scale, root, deceleration, bend, bend_speed: scale * (y * y - root * root) }
    }

    /// Speed, and its derivative with respect to the distance.
    fn at(&self, distance: f32) -> (f32, f32) {
        let Self { scale, root, deceleration, bend, bend_speed } = *self;
        if distance < bend {
            let y = cube_root(distance + root * root * root);
            // y² − δ^(2/3) as a quotient without cancellation would cost more than it is worth: the error is 1e-7 m/s.
            (math::max(scale * (y * y - root * root), 0.0), 2.0 * scale / (3.0 * y))
        } else {
            let speed = math::sqrt(bend_speed * bend_speed + 2.0 * deceleration * (distance - bend));
            (speed, deceleration / speed)
        }
    }
}

/// Cube root of a positive number, to 1e-6: a third of the exponent, and two of Halley's steps.
fn cube_root(x: f32) -> f32 {
    let guess = f32::from_bits(x.to_bits() / 3 + 0x2a51_2ce3);
    let step = |y: f32| {
        let cube = y * y * y;
        y * (cube + 2.0 * x) / (2.0 * cube + x)
    };
    step(step(guess))
}

/// How much of what is passed on from a target acts against a correction. A correction may be larger by that: accelerations
/// that do not lead where the given velocities do would outweigh it otherwise.
fn against<const N: usize>(passed_on: &Axes<N>, correction: &Axes<N>) -> f32 {
    let product = passed_on.dot(correction);
    if product < 0.0 { -product / math::max(math::sqrt(correction.norm_squared()), 1e-6) } else { 0.0 }
}

/// The reference's motion along some axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Chain<const N: usize> {
    /// From the anchor.
    pub(super) place: Axes<N>,
    pub(super) speed: Axes<N>,
    pub(super) acceleration: Axes<N>,
    pub(super) jerk: Axes<N>,
    pub(super) snap: Axes<N>,
    /// What of the place is too small for its last digit.
    rest: Axes<N>,
}

/// A follower with its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tracker<const N: usize> {
    pub(super) chain: Chain<N>,
    pub(super) limits: Limits,
    curve: Curve,
}

impl<const N: usize> Chain<N> {
    /// Exact motion over a step in which the jerk goes linearly to `jerk`.
    fn integrate(&mut self, jerk: &Axes<N>) {
        const H: f32 = STEP_S;
        self.snap = (jerk - self.jerk) / H;
        let way = (self.speed + (self.acceleration + (self.jerk + self.snap * (H / 4.0)) * (H / 3.0)) * (H / 2.0)) * H;
        // What rounding takes away is added with the next way: a slow motion would come to rest otherwise.
        let way = way + self.rest;
        let before = self.place;
        self.place += way;
        self.rest = way - (self.place - before);
        self.speed += (self.acceleration + (self.jerk + self.snap * (H / 3.0)) * (H / 2.0)) * H;
        self.acceleration += (self.jerk + self.snap * (H / 2.0)) * H;
        self.jerk = *jerk;
    }
}

impl<const N: usize> Tracker<N> {
    /// A tracker at rest.
    pub(super) fn new(limits: Limits) -> Self {
        let zero = Axes::zeros();
        let chain = Chain { place: zero, speed: zero, acceleration: zero, jerk: zero, snap: zero, rest: zero };
        Self { chain, limits, curve: Curve::new(BRAKING * limits.acceleration, EASING * limits.jerk) }
    }

    /// Goes on within other limits; the motion is kept.
    pub(super) fn limit(&mut self, limits: Limits) {
        *self = Self { chain: self.chain, ..Self::new(limits) };
    }

    /// Advances by a step.
    pub(super) fn follow(&mut self, target: &Target<N>) {
        let wanted = self.wanted_jerk(target);
        let jerk = self.chain.jerk + (wanted - self.chain.jerk) * JERK_FRACTION;
        self.chain.integrate(&jerk);
        if self.limits.turns {
            self.chain.place.apply(|angle| *angle = math::wrap_angle(*angle));
        }
    }

    fn wanted_jerk(&self, target: &Target<N>) -> Axes<N> {
        let Chain { place, speed, acceleration, .. } = &self.chain;
        let changing = acceleration - target.acceleration;
        let moving = speed - target.speed;
        let mut away = place - target.place;
        if self.limits.turns {
            away.apply(|angle| *angle = math::wrap_angle(*angle));
        }
        away += (moving + changing * (0.5 * AHEAD_S)) * AHEAD_S;
        let relative =
            self.wanted_acceleration(&away.component_mul(&target.placed), &(moving + changing * AHEAD_S), target);
        let free = math::shorten(target.acceleration + relative, self.limits.strongest);
        let (wanted, passed_on) = self.slow_down(free, target.jerk);
        let correction = (wanted - acceleration) * ACCELERATION_RAD_S;
        let Limits { jerk, sharpest, .. } = self.limits;
        // A target that turns at its limits would carry the reference beyond the speed while that turns more slowly.
        let most = if wanted == free { jerk } else { sharpest };
        if !target.settled {
            return math::shorten(passed_on + correction, most);
        }
        passed_on + math::shorten(correction, most + against(&passed_on, &correction))
    }

    /// What of an acceleration and of a target's jerk remains, so that the reference does not become faster than it may be.
    /// Target and motion relative to it each keep their limits; while a target turns or jumps their sum would not.
    ///
    /// Two half-planes are kept: along the acceleration, also while the speed is against it and it will be too late to
    /// brake when that has turned; and along the speed, which may be beyond the limit already.
    fn slow_down(&self, wanted: Axes<N>, jerk: Axes<N>) -> (Axes<N>, Axes<N>) {
        let Chain { speed, acceleration, .. } = &self.chain;
        let ahead = speed + acceleration * AHEAD_S;
        let (wanted, jerk) = self.keep_below(&wanted, &ahead, wanted, jerk);
        self.keep_below(&ahead, &ahead, wanted, jerk)
    }

    /// Takes from an acceleration and a jerk what would make a speed too great in a direction.
    fn keep_below(&self, direction: &Axes<N>, speed: &Axes<N>, wanted: Axes<N>, jerk: Axes<N>) -> (Axes<N>, Axes<N>) {
        let size = math::sqrt(direction.norm_squared());
        if size < NEAR {
            return (wanted, jerk);
        }
        let direction = direction / size;
        let Limits { fastest_up, fastest_down, .. } = self.limits;
        let fastest = FASTER * if direction.sum() < 0.0 { fastest_down } else { fastest_up };
        let excess = wanted.dot(&direction) - self.correction(fastest - speed.dot(&direction));
        if excess <= 0.0 {
            return (wanted, jerk);
        }
        (wanted - direction * excess, jerk - direction * math::max(jerk.dot(&direction), 0.0))
    }

    /// Acceleration relative to the target, from place and speed relative to it.
    fn wanted_acceleration(&self, away: &Axes<N>, moving: &Axes<N>, target: &Target<N>) -> Axes<N> {
        let distance = math::sqrt(away.norm_squared());
        let (curve_speed, slope) = self.curve.at(distance);
        let (outward, turning) =
            if distance > NEAR { (away / distance, curve_speed / distance) } else { (Axes::zeros(), slope) };
        let approaching = -moving.dot(&outward);
        let across = moving + outward * approaching;
        let sideways = across.component_mul(&target.placed) * -turning - self.correct(&across);
        let along = if distance > NEAR {
            let most = self.speed_towards(&outward, &target.speed);
            let braking = -slope * approaching - self.correction(approaching - curve_speed);
            math::min(braking, -self.correction(approaching - most))
        } else {
            0.0
        };
        let wanted = sideways - outward * along;
        math::shorten(wanted, self.limits.acceleration + against(&target.acceleration, &wanted))
    }

    /// The greatest speed relative to the target in the direction −`outward`: within its own limit, and such that the sum
    /// with the target's speed is within the absolute one. Against the target's speed it is greater by that: a place that is
    /// sent with a speed at which it does not move would be left behind for ever.
    fn speed_towards(&self, outward: &Axes<N>, target: &Axes<N>) -> f32 {
        let up = outward.sum() < 0.0;
        let Limits { up: most_up, down, fastest_up, fastest_down, .. } = self.limits;
        let (most, fastest) = if up { (most_up, fastest_up) } else { (down, fastest_down) };
        let with = -target.dot(outward);
        let room = math::max(with * with + fastest * fastest - target.norm_squared(), 0.0);
        math::clamp(math::sqrt(room) - with, 0.0, most + math::max(-with, 0.0))
    }

    /// Acceleration that reduces an error of the speed: linear, then the square root by which it ends with limited jerk.
    fn correction(&self, error: f32) -> f32 {
        math::braked(error, SPEED_RAD_S, CHANGING * self.limits.jerk)
    }

    fn correct(&self, error: &Axes<N>) -> Axes<N> {
        let size = math::sqrt(error.norm_squared());
        if size > NEAR { error * (self.correction(size) / size) } else { error * SPEED_RAD_S }
    }
}

/// Below this a length has no direction, m or m/s.
const NEAR: f32 = 1e-9;
