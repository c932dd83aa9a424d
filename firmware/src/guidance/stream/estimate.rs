//! Estimates a target's motion, at the time of its latest sample, from what the samples give.
//!
//! What is given is used; what is not is estimated, by polynomial filters with fading memory: of third degree for places
//! alone, so that a steady turn has no bias, and of first degree for the acceleration and jerk behind given speeds.
//!
//! Places alone do not tell a step from motion. The axes of a [`Group`] decide it together:
//!
//! ```text
//!                 two differences of places agree
//!    standing ──────────────────────────────────────────► moving
//!        ▲                                                 │  ▲
//!        │        a place is farther from the prediction   │  │  the next is not, or
//!        │               than an acceleration explains     │  │  goes on as fast as before
//!        │   else                                          ▼  │
//!        └────────────────────────────────────────────── doubted
//! ```
//!
//! A standing target is where its latest sample says and has no speed, so that no step is overshot. One whose samples do
//! not come any more goes on for [`SILENT_S`], and brakes.

use nalgebra::SVector;

use super::axis::{Axis, Given};
use super::tracker::Target;
use crate::math;

/// So long a target moves on without a sample, s.
pub(super) const SILENT_S: f32 = 0.25;
/// Time constant with which it comes to rest in the end, s.
const SOFTLY_S: f32 = 0.4;
/// After such a gap the samples before it tell nothing, s.
const GAP_S: f32 = 0.6;
/// Memory of the filters, s: of places, and of speeds and accelerations.
const PLACES_S: f32 = 0.075;
const RATES_S: f32 = 0.05;
/// By what the memory of places is longer, in units of the error of their times.
const ERRORS: f32 = 10.0;
/// So long a speed is extrapolated by the acceleration, if no place is given, s.
const UNPLACED_S: f32 = 0.1;
/// Two slopes or rates whose difference is a smaller fraction of the latter are of one motion.
const AGREEING: f32 = 0.5;
/// How much of the lack of confidence is left out with each place near its prediction, and what of confidence is kept with
/// one that is not.
const CALMING: f32 = 0.12;
const DOUBTING: f32 = 0.6;
/// So long after a target has begun to move in another way, its jerk is not well known: the filters have settled, and a
/// reference that may be 10 m/s² off with 10 m/s³ has met it, s.
const SETTLING_S: f32 = 1.0;
/// Fraction of a given place's residual that is followed if the speed is given too: the rest is noise of the times.
const PLACE_FRACTION: f32 = 0.5;

/// What a group takes for motion, and how far it is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Gate {
    /// A greater acceleration is a step, m/s² or rad/s².
    pub(super) acceleration: f32,
    /// Places that are closer are the same, m or rad.
    pub(super) floor: f32,
    /// The greatest speed of motion that is told from steps, m/s or rad/s.
    pub(super) fastest: f32,
    /// What of the target's speed is followed at most, in the direction of a positive axis and in the other; equal if N = 2.
    pub(super) up: f32,
    pub(super) down: f32,
    /// What of its acceleration and of its jerk is.
    pub(super) strongest: f32,
    pub(super) jerk: f32,
    /// Acceleration with which a silent target brakes, m/s² or rad/s².
    pub(super) braking: f32,
    /// Whether the axis is an angle.
    pub(super) turns: bool,
}

/// When a sample was taken, and how well that is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Timing {
    /// Since the sample before, s.
    since_s: f32,
    /// Error, s.
    error_s: f32,
    /// Weights of the sample before in the filters of places, and of speeds and accelerations.
    of_places: f32,
    of_rates: f32,
}

impl Timing {
    /// Of a sample `since_s` after the one before, with an error, s.
    pub(super) fn new(since_s: f32, error_s: f32) -> Self {
        let of_places = math::exp(-since_s / (PLACES_S + ERRORS * error_s));
        Self { since_s, error_s, of_places, of_rates: math::exp(-since_s / RATES_S) }
    }
}

/// How much the places of a group tell.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Motion {
    /// One sample.
    Placed,
    /// A slope too.
    Standing,
    /// Speed and acceleration.
    Moving,
    /// These, but the latest sample was off.
    Doubted,
}

/// What becomes of the estimate.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Response {
    Stand,
    /// Whether with an acceleration.
    Begin(bool),
    Turn,
    Shift,
    Correct,
    Coast,
}

/// Axes that are judged together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Group<const N: usize> {
    axes: [Axis; N],
    motion: Motion,
    /// Until the target has moved in one way for so long that its jerk is well known, s.
    settling_s: f32,
    /// Confidence in the acceleration that places tell, 0 to 1: what of it is passed on.
    calm: f32,
    /// From the latest sample to the state, s: 0 unless the target is silent.
    ahead_s: f32,
    pub(super) gate: Gate,
}

fn length(values: impl Iterator<Item = f32>) -> f32 {
    math::sqrt(values.map(|value| value * value).sum())
}

impl<const N: usize> Group<N> {
    /// A group of which nothing is given.
    pub(super) fn new(gate: Gate) -> Self {
        Self {
            axes: [Axis::default(); N],
            motion: Motion::Placed,
            settling_s: SETTLING_S,
            calm: 0.0,
            ahead_s: 0.0,
            gate,
        }
    }

    /// Takes a sample. `speed` is the reference's, with which an axis goes on of which the acceleration alone is given.
    pub(super) fn correct(&mut self, given: &[Given; N], timing: &Timing, speed: &SVector<f32, N>) {
        let known = self.axes.iter().zip(given).all(|(axis, given)| axis.given.has_same_fields(given));
        if !known || timing.since_s > GAP_S {
            self.motion = Motion::Placed;
            self.settling_s = SETTLING_S;
            self.ahead_s = 0.0;
            for ((axis, given), speed) in self.axes.iter_mut().zip(given).zip(speed.iter()) {
                axis.restart(given, *speed);
            }
        } else {
            let was_silent = self.ahead_s > 0.0;
            self.settling_s = math::max(self.settling_s - timing.since_s, 0.0);
            self.predict(given, timing.since_s);
            self.correct_by_places(timing);
            self.correct_by_rates(timing, was_silent);
        }
    }

    /// Moves the state to the time of a sample, and compares the places.
    fn predict(&mut self, given: &[Given; N], since_s: f32) {
        let turns = self.gate.turns;
        let difference = |a: f32, b: f32| if turns { math::wrap_angle(a - b) } else { a - b };
        for (axis, given) in self.axes.iter_mut().zip(given) {
            axis.predict(since_s - self.ahead_s);
            if turns {
                axis.place = math::wrap_angle(axis.place);
            }
            if let (Some(place), Some(before)) = (given.place, axis.given.place) {
                axis.residual = difference(place, axis.place);
                (axis.slope, axis.next_slope) = (axis.next_slope, difference(place, before) / since_s);
            }
            if let (Some(speed), Some(before)) = (given.speed, axis.given.speed) {
                (axis.rate, axis.next_rate) = (axis.next_rate, (speed - before) / since_s);
            }
            axis.given = *given;
        }
        self.ahead_s = 0.0;
    }

    /// The greatest distance of a place from its prediction that is motion, or noise, of axes with a speed.
    fn widest(&self, timing: &Timing, speed: f32) -> f32 {
        let t = timing.since_s;
        let motion = math::min(0.5 * self.gate.acceleration * t, 0.5 * speed) * t;
        motion + self.gate.floor + speed * timing.error_s
    }

    /// Takes places without speeds.
    fn correct_by_places(&mut self, timing: &Timing) {
        if !self.axes.iter().any(|axis| axis.given.is_place_alone()) {
            return;
        }
        let (motion, response) = self.judge(timing);
        self.motion = motion;
        self.calm = match response {
            Response::Correct => self.calm + CALMING * (1.0 - self.calm),
            Response::Coast | Response::Shift => DOUBTING * self.calm,
            Response::Stand | Response::Begin(_) | Response::Turn => 0.0,
        };
        if matches!(response, Response::Stand | Response::Begin(_) | Response::Turn) {
            self.settling_s = SETTLING_S;
        }
        for axis in self.axes.iter_mut().filter(|axis| axis.given.is_place_alone()) {
            match response {
                Response::Stand => axis.stand(),
                Response::Begin(bends) => {
                    let change = if bends { axis.next_slope - axis.slope } else { 0.0 };
                    axis.begin(change, timing.since_s);
                }
                Response::Turn => axis.begin(0.0, timing.since_s),
                Response::Shift => axis.place = axis.given.place.unwrap_or(axis.place),
                Response::Correct => axis.correct_by_place(timing.of_places, timing.since_s),
                Response::Coast => {}
            }
        }
    }

    /// What the latest places mean.
    fn judge(&self, timing: &Timing) -> (Motion, Response) {
        let alone = || self.axes.iter().filter(|axis| axis.given.is_place_alone());
        let speed = length(alone().map(|axis| axis.speed));
        let is_near = length(alone().map(|axis| axis.residual)) <= self.widest(timing, speed);
        let slope = length(alone().map(|axis| axis.next_slope));
        let is_motion = slope <= self.gate.fastest && slope * timing.since_s > 0.1 * self.gate.floor;
        // Neither a stop nor a start, and no step.
        let noise = (slope * timing.error_s + self.gate.floor) / timing.since_s;
        let explained = self.gate.acceleration * timing.since_s + noise;
        let change = length(alone().map(|axis| axis.next_slope - axis.slope));
        let agrees = |change: f32| is_motion && change <= math::min(explained, AGREEING * slope);
        match self.motion {
            Motion::Standing if agrees(change) => (Motion::Moving, Response::Begin(change > 2.0 * noise)),
            Motion::Moving | Motion::Doubted if is_near => (Motion::Moving, Response::Correct),
            Motion::Moving => (Motion::Doubted, Response::Coast),
            // A sample was lost, or its time is wrong.
            Motion::Doubted if agrees(length(alone().map(|axis| axis.next_slope - axis.speed))) => {
                (Motion::Moving, Response::Shift)
            }
            // Around a corner the speed is kept, but not its direction.
            Motion::Doubted if agrees(math::abs(slope - speed)) => (Motion::Moving, Response::Turn),
            Motion::Placed | Motion::Standing | Motion::Doubted => (Motion::Standing, Response::Stand),
        }
    }

    /// Takes what is given besides places alone. After a silence a speed says nothing about its change: what it differs from
    /// has braked by itself.
    fn correct_by_rates(&mut self, timing: &Timing, was_silent: bool) {
        let t = timing.since_s;
        let with_speed = || self.axes.iter().filter(|axis| !axis.given.is_place_alone());
        let speed = length(with_speed().map(|axis| axis.speed));
        let is_near = length(with_speed().map(|axis| axis.residual)) <= self.widest(timing, speed);
        let rate = length(with_speed().map(|axis| axis.next_rate));
        let change = length(with_speed().map(|axis| axis.next_rate - axis.rate));
        let agrees = !was_silent && rate <= self.gate.acceleration && change <= AGREEING * rate;
        for axis in &mut self.axes {
            if let Some(speed) = axis.given.speed {
                axis.correct_by_speed(speed, timing.of_rates, t, agrees);
                match axis.given.place {
                    Some(_) if is_near => axis.place += PLACE_FRACTION * axis.residual,
                    Some(place) => axis.place = place,
                    None => {}
                }
            }
            if let Some(given) = axis.given.acceleration {
                axis.correct_by_acceleration(given, timing.of_rates, t, self.gate.jerk);
            }
        }
    }

    /// The target's motion `age_s` after the latest sample.
    pub(super) fn at(&mut self, age_s: f32) -> Target<N> {
        if age_s > SILENT_S {
            self.brake(age_s);
        }
        let t = math::max(age_s - self.ahead_s, 0.0);
        let mut axes = self.axes;
        for axis in &mut axes {
            let placed = axis.given.place.is_some();
            axis.predict(if placed { t } else { math::min(t, UNPLACED_S) });
        }
        let vector = |value: fn(&Axis) -> f32| SVector::from(axes.each_ref().map(value));
        let Gate { up, down, strongest, jerk, .. } = self.gate;
        let place = vector(|axis| axis.place);
        let speed = vector(|axis| axis.speed + axis.drift[0]);
        let placed = vector(|axis| if axis.given.place.is_some() { 1.0 } else { 0.0 });
        // An acceleration that places have told must have been confirmed, or noise would be flown.
        let known = |axis: &Axis| if axis.given.is_place_alone() { self.calm } else { 1.0 };
        let vector = |value: fn(&Axis) -> f32| SVector::from(axes.each_ref().map(|axis| known(axis) * value(axis)));
        let acceleration = vector(|axis| axis.acceleration + axis.drift[1]);
        let jerk = math::shorten(vector(|axis| axis.jerk + axis.drift[2]), jerk);
        let speed_kept =
            if N == 1 { speed.map(|speed| math::clamp(speed, -down, up)) } else { math::shorten(speed, up) };
        // Where one is cut off, what would lead farther beyond is not passed on; what turns the speed is.
        let excess = speed - speed_kept;
        let beyond = math::sqrt(excess.norm_squared());
        let direction = if beyond > 0.0 { excess / beyond } else { SVector::zeros() };
        let kept = |v: SVector<f32, N>| v - direction * math::max(v.dot(&direction), 0.0);
        let slower = kept(acceleration);
        let acceleration = math::shorten(slower, strongest);
        let jerk = if acceleration == slower { kept(jerk) } else { SVector::zeros() };
        Target { place, speed: speed_kept, acceleration, jerk, placed, settled: self.settling_s <= 0.0 }
    }

    /// Goes on to `age_s` without a sample: what has a place brakes, and what has none keeps its speed.
    #[cold]
    fn brake(&mut self, age_s: f32) {
        if self.ahead_s < SILENT_S {
            for axis in &mut self.axes {
                axis.predict(SILENT_S - self.ahead_s);
                axis.speed = axis.given.speed.filter(|_| axis.given.place.is_none()).unwrap_or(axis.speed);
            }
            self.ahead_s = SILENT_S;
        }
        let t = math::max(age_s - self.ahead_s, 0.0);
        self.ahead_s += t;
        let placed = |axis: &&Axis| axis.given.place.is_some();
        let speed = length(self.axes.iter().filter(placed).map(|axis| axis.speed));
        // With a limited deceleration first, then more and more gently.
        let rate = math::min(self.gate.braking / math::max(speed, 1e-6), 1.0 / math::max(t, SOFTLY_S));
        for axis in &mut self.axes {
            (axis.acceleration, axis.jerk, axis.drift) = (0.0, 0.0, [0.0; 4]);
            if axis.given.place.is_some() {
                axis.acceleration = -rate * axis.speed;
                axis.predict(t);
            }
        }
    }

    /// Moves the origin of places.
    pub(super) fn shift(&mut self, by: &SVector<f32, N>) {
        for (axis, by) in self.axes.iter_mut().zip(by.iter()) {
            axis.place -= by;
            axis.given.place = axis.given.place.map(|place| place - by);
        }
    }

    /// Whether nothing is given of an axis, for each.
    pub(super) fn has_nothing(&self) -> [bool; N] {
        self.axes.map(|axis| axis.given.is_nothing())
    }
}
