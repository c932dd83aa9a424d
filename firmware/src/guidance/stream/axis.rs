//! One axis of a target: its motion at the time of the latest sample, and how samples correct that.

use crate::math;

/// How fast the residual that all samples have in common is learnt, as a fraction of their own memory.
const DRIFTING: f32 = 0.6;

/// What a sample gives of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Given {
    /// From the anchor.
    pub(super) place: Option<f32>,
    pub(super) speed: Option<f32>,
    pub(super) acceleration: Option<f32>,
}

impl Given {
    /// Whether nothing is.
    pub(super) fn is_nothing(&self) -> bool {
        self.place.is_none() && self.speed.is_none() && self.acceleration.is_none()
    }

    /// Whether its speed has to be estimated from places.
    pub(super) fn is_place_alone(&self) -> bool {
        self.place.is_some() && self.speed.is_none()
    }

    pub(super) fn has_same_fields(&self, other: &Self) -> bool {
        let fields = |given: &Self| (given.place.is_some(), given.speed.is_some(), given.acceleration.is_some());
        fields(self) == fields(other)
    }
}

/// One axis, at the time of the latest sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Axis {
    pub(super) given: Given,
    pub(super) place: f32,
    pub(super) speed: f32,
    pub(super) acceleration: f32,
    pub(super) jerk: f32,
    /// Between the two places before the latest, and from the last of them to the latest.
    pub(super) slope: f32,
    pub(super) next_slope: f32,
    /// The same of speeds, and whether the latest was taken for a steady one.
    pub(super) rate: f32,
    pub(super) next_rate: f32,
    is_steady: bool,
    /// Of the place from the prediction.
    pub(super) residual: f32,
    /// The residual that all have in common, and the rates of place to jerk by which it corrects them.
    usual: f32,
    pub(super) drift: [f32; 4],
}

impl Axis {
    /// Moves the state to a time `t` later.
    pub(super) fn predict(&mut self, t: f32) {
        self.place += (self.speed + (self.acceleration + self.jerk * (t / 3.0)) * (t / 2.0)) * t;
        self.speed += (self.acceleration + self.jerk * (t / 2.0)) * t;
        self.acceleration += self.jerk * t;
    }

    /// Forgets all motion; a speed that is not given goes on as `speed`.
    pub(super) fn restart(&mut self, given: &Given, speed: f32) {
        let unknown = if given.acceleration.is_some() && given.place.is_none() { speed } else { 0.0 };
        *self = Self {
            given: *given,
            place: given.place.unwrap_or(0.0),
            speed: given.speed.unwrap_or(unknown),
            acceleration: given.acceleration.unwrap_or(0.0),
            is_steady: true,
            ..Self::default()
        };
    }

    /// Takes the latest place, without motion.
    pub(super) fn stand(&mut self) {
        (self.usual, self.drift) = (0.0, [0.0; 4]);
        self.place = self.given.place.unwrap_or(self.place);
        (self.speed, self.jerk) = (0.0, 0.0);
        self.acceleration = self.given.acceleration.unwrap_or(0.0);
    }

    /// Begins to move from the latest place with the latest slope, at the end of a parabola through `change` of slope.
    pub(super) fn begin(&mut self, change: f32, since_s: f32) {
        (self.usual, self.drift) = (0.0, [0.0; 4]);
        self.place = self.given.place.unwrap_or(self.place);
        self.speed = self.next_slope + 0.5 * change;
        self.acceleration = change / since_s;
        self.jerk = 0.0;
    }

    fn correct(&mut self, [place, speed, acceleration, jerk]: [f32; 4], residual: f32) {
        self.place += place * residual;
        self.speed += speed * residual;
        self.acceleration += acceleration * residual;
        self.jerk += jerk * residual;
    }

    /// Corrects a prediction by the residual of a place alone; `memory` is the weight of the sample before.
    pub(super) fn correct_by_place(&mut self, memory: f32, since_s: f32) {
        let (m, forgotten) = (memory, 1.0 - memory);
        let square = forgotten * forgotten;
        let gains = [
            1.0 - m * m * m * m,
            square * (11.0 + (14.0 + 11.0 * m) * m) / (6.0 * since_s),
            2.0 * square * forgotten * (1.0 + m) / (since_s * since_s),
            square * square / (since_s * since_s * since_s),
        ];
        self.correct(gains, self.residual);
        // What corrects the same way each time is a rate.
        self.usual += DRIFTING * forgotten * (self.residual - self.usual);
        self.drift = gains.map(|gain| gain * self.usual / since_s);
    }

    /// Corrects a prediction by a given speed, of which the rate of change agrees with the one before or does not.
    pub(super) fn correct_by_speed(&mut self, speed: f32, memory: f32, since_s: f32, agrees: bool) {
        let error = (speed - self.speed) / since_s;
        self.speed = speed;
        if self.given.acceleration.is_some() {
            return;
        }
        if !agrees {
            (self.acceleration, self.jerk) = (0.0, 0.0);
        } else if self.is_steady {
            (self.acceleration, self.jerk) = (self.next_rate, 0.0);
        } else {
            self.acceleration += (1.0 - memory * memory) * error;
            self.jerk += (1.0 - memory) * (1.0 - memory) * error / since_s;
        }
        self.is_steady = !agrees;
    }

    /// Takes a given acceleration; a change that a jerk of `most` cannot explain is a step.
    pub(super) fn correct_by_acceleration(&mut self, acceleration: f32, memory: f32, since_s: f32, most: f32) {
        let rate = (acceleration - self.acceleration) / since_s;
        self.acceleration = acceleration;
        self.jerk = if math::abs(rate) > most { 0.0 } else { self.jerk + (1.0 - memory) * rate };
    }
}
