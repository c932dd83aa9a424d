//! Measures of a flight.

use nalgebra::{UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::Assess;
use super::consistency::Consistency;
use crate::plant::ground::Ground;
use crate::record::{Navigation, Recorder, Row};
use crate::statistics::MeanSquare;
use crate::touchdown::Touchdown;
use crate::touchdown::UPRIGHT;

/// A measure of a flight, over the judged time unless stated otherwise. Errors are true minus wanted values unless stated otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// Time from lift-off until the height is within 0.35 m of the wanted one, s.
    ClimbS,
    /// Greatest error of the height, m.
    HeightErrorMaxM,
    /// Greatest deviation of the height from its mean, m.
    HeightWanderMaxM,
    /// 95th percentile of the horizontal distance, m.
    HorizontalErrorP95M,
    /// Greatest horizontal distance, m.
    HorizontalErrorMaxM,
    /// Root mean square of the error along x, m.
    XErrorRmsM,
    /// Along y, m.
    YErrorRmsM,
    /// Along z, m.
    ZErrorRmsM,
    /// Greatest roll, °.
    RollMaxDeg,
    /// Root mean square error of the tilt estimate, °.
    TiltKnownRmsDeg,
    /// Root mean square error of the heading estimate, °.
    HeadingKnownRmsDeg,
    /// Root mean square error of the attitude estimate, as one rotation angle, °.
    AttitudeKnownRmsDeg,
    /// Root mean square error of the position estimate, m.
    PositionKnownRmsM,
    /// Whole flight: downward speed at the first touchdown, m/s.
    TouchdownMS,
    /// Whole flight: time of the first touchdown, s.
    TouchdownS,
    /// Whole flight: time at which the rotors stopped after it, s.
    DisarmedS,
    /// Whole flight: greatest of the smallest distances to the pilot's waypoints, each counted once the previous one was reached within 2 m, m.
    MissMaxM,
    /// Fraction of the time in the air.
    FlownPart,
    /// 1 if the vehicle flew and was not lost, no motor command was NaN, every touchdown was slower than 4 m/s and within 60° of upright, and it ended so; otherwise 0.
    Survived,
}

impl Measure {
    /// All measures.
    pub const ALL: [Self; 19] = [
        Self::ClimbS,
        Self::HeightErrorMaxM,
        Self::HeightWanderMaxM,
        Self::HorizontalErrorP95M,
        Self::HorizontalErrorMaxM,
        Self::XErrorRmsM,
        Self::YErrorRmsM,
        Self::ZErrorRmsM,
        Self::RollMaxDeg,
        Self::TiltKnownRmsDeg,
        Self::HeadingKnownRmsDeg,
        Self::AttitudeKnownRmsDeg,
        Self::PositionKnownRmsM,
        Self::TouchdownMS,
        Self::TouchdownS,
        Self::DisarmedS,
        Self::MissMaxM,
        Self::FlownPart,
        Self::Survived,
    ];

    /// Its name in files.
    pub fn name(self) -> String {
        serde_json::to_value(self).ok().and_then(|v| v.as_str().map(str::to_owned)).unwrap_or_default()
    }
}

/// The measures of a flight, each with its value if it has one.
#[derive(Clone, Debug, PartialEq)]
pub struct Measures {
    values: [Option<f64>; Measure::ALL.len()],
    /// Consistency of the estimator.
    pub consistency: Consistency,
}

impl Measures {
    /// The value of a measure.
    pub fn get(&self, measure: Measure) -> Option<f64> {
        self.values[measure as usize]
    }
}

/// Minimum and maximum of a series.
#[derive(Clone, Copy, Debug)]
struct Range {
    least: f64,
    greatest: f64,
}

impl Range {
    const EMPTY: Self = Self { least: f64::INFINITY, greatest: f64::NEG_INFINITY };

    fn take(&mut self, value: f64) {
        self.least = self.least.min(value);
        self.greatest = self.greatest.max(value);
    }

    fn some(self, value: impl Fn(Self) -> f64) -> Option<f64> {
        (self.least <= self.greatest).then(|| value(self))
    }
}

/// Height over the start that counts as in the air, m.
const AIRBORNE_M: f64 = 0.5;
/// Height that counts as off the ground, m.
const LIFTED_M: f64 = 0.05;
/// Acceptance radius of a waypoint, m.
const PASSED_M: f64 = 2.0;
/// Ticks between two stored distances: a flight of a day has millions of ticks.
const KEPT_EVERY: u64 = 20;
/// Tolerance of a reached height, m.
const REACHED_M: f64 = 0.35;

/// Times of single events in a flight, s.
#[derive(Clone, Copy, Debug, Default)]
struct Events {
    lifted: Option<f64>,
    reached: Option<f64>,
    disarmed: Option<f64>,
}

/// Takes the measures during a flight.
#[derive(Clone, Debug)]
pub struct Assessor {
    from_s: f64,
    to_s: f64,
    hold: Option<Vector3<f64>>,
    start_height: f64,
    events: Events,
    touchdown: Option<Touchdown>,
    /// Ticks judged, those of them with an error, and those in the air.
    judged: u64,
    errors: u64,
    in_air: u64,
    /// Cosine of the tilt in the last row.
    upright: f64,
    height: Range,
    height_error: Range,
    height_sum: (f64, f64),
    horizontal: Vec<f64>,
    axes: [MeanSquare; 3],
    roll: Range,
    known: [MeanSquare; 4],
    /// The pilot's waypoints, and the smallest distance to each so far.
    places: Vec<(Vector3<f64>, f64)>,
    sound: bool,
    consistency: Consistency,
}

impl Assessor {
    /// Before a flight of `duration_s` from `start` over a ground, if there is one, in which the pilot sends the vehicle to
    /// `places` (m).
    pub fn new(
        assess: &Assess,
        duration_s: f64,
        start: &Vector3<f64>,
        ground: Option<Ground>,
        places: &[Vector3<f64>],
    ) -> Self {
        Self {
            from_s: assess.from_s,
            to_s: assess.to_s.unwrap_or(duration_s),
            hold: assess.hold_m.map(Vector3::from),
            start_height: start.z,
            events: Events::default(),
            touchdown: ground.map(Touchdown::new),
            judged: 0,
            errors: 0,
            in_air: 0,
            upright: 1.0,
            height: Range::EMPTY,
            height_error: Range::EMPTY,
            height_sum: (0.0, 0.0),
            horizontal: Vec::new(),
            axes: [MeanSquare::default(); 3],
            roll: Range::EMPTY,
            known: [MeanSquare::default(); 4],
            places: places.iter().map(|place| (*place, f64::INFINITY)).collect(),
            sound: true,
            consistency: Consistency::default(),
        }
    }

    fn is_judged(&self, t: f64) -> bool {
        t >= self.from_s && t < self.to_s
    }

    fn once(&mut self, row: &Row) {
        let height = row.position[2] - self.start_height;
        let events = &mut self.events;
        if height > LIFTED_M {
            events.lifted.get_or_insert(row.t);
        }
        if events.lifted.is_some() && self.hold.is_some_and(|hold| (row.position[2] - hold.z).abs() < REACHED_M) {
            events.reached.get_or_insert(row.t);
        }
        let stopped = row.omega_command.iter().all(|omega| *omega == 0.0);
        if let Some(touchdown) = &mut self.touchdown {
            touchdown.record(row);
            if touchdown.first().is_some() && stopped {
                events.disarmed.get_or_insert(row.t);
            }
        }
        let [_, x, y, _] = row.attitude;
        self.upright = 1.0 - 2.0 * (x * x + y * y);
    }

    fn judge(&mut self, row: &Row, wanted: &Vector3<f64>) {
        // A place to hold is the same in every row.
        if self.hold.is_some() || !row.reference_is_held {
            self.judge_error(&(Vector3::from(row.position) - wanted));
        }
        self.height.take(row.position[2]);
        self.height_sum = (self.height_sum.0 + row.position[2], self.height_sum.1 + 1.0);
        self.judged += 1;
        self.in_air += u64::from(row.position[2] - self.start_height > AIRBORNE_M);
        self.roll.take(crate::angles::roll_pitch_yaw(row.attitude)[0].abs().to_degrees());
    }

    fn judge_error(&mut self, error: &Vector3<f64>) {
        self.height_error.take(error.z.abs());
        if self.errors.is_multiple_of(KEPT_EVERY) {
            self.horizontal.push(libm::hypot(error.x, error.y));
        }
        self.errors += 1;
        for (axis, error) in self.axes.iter_mut().zip(error.iter()) {
            axis.take(*error);
        }
    }

    /// What the flight has measured; `tracked` unless the vehicle was lost.
    pub fn finish(self, tracked: bool) -> Measures {
        let events = self.events;
        let mean = self.height_sum.0 / self.height_sum.1;
        let mut horizontal = self.horizontal;
        horizontal.sort_by(f64::total_cmp);
        let contact = self.touchdown.as_ref().and_then(Touchdown::first);
        let whole = self.touchdown.as_ref().is_none_or(|seen| seen.has_flown() && seen.crash().is_none());
        let whole = whole && self.upright > UPRIGHT;
        let miss = self.places.iter().map(|(_, least)| *least).reduce(f64::max);
        let [tilt, heading, attitude, position] = self.known.map(MeanSquare::root);
        let [x, y, z] = self.axes.map(MeanSquare::root);
        let climb = events.reached.zip(events.lifted).map(|(reached, lifted)| reached - lifted);
        let value = |measure: Measure| match measure {
            Measure::ClimbS => climb,
            Measure::HeightErrorMaxM => self.height_error.some(|range| range.greatest),
            Measure::HeightWanderMaxM => self.height.some(|range| (range.greatest - mean).max(mean - range.least)),
            Measure::HorizontalErrorP95M => super::ensemble::percentile(&horizontal, 95.0),
            Measure::HorizontalErrorMaxM => horizontal.last().copied(),
            Measure::XErrorRmsM => x,
            Measure::YErrorRmsM => y,
            Measure::ZErrorRmsM => z,
            Measure::RollMaxDeg => self.roll.some(|range| range.greatest),
            Measure::TiltKnownRmsDeg => tilt.map(f64::to_degrees),
            Measure::HeadingKnownRmsDeg => heading.map(f64::to_degrees),
            Measure::AttitudeKnownRmsDeg => attitude.map(f64::to_degrees),
            Measure::PositionKnownRmsM => position,
            Measure::TouchdownMS => contact.map(|contact| contact.descent_m_s),
            Measure::TouchdownS => contact.map(|contact| contact.t_s),
            Measure::DisarmedS => events.disarmed,
            Measure::MissMaxM => miss,
            Measure::FlownPart => Some(self.in_air as f64 / self.judged.max(1) as f64),
            Measure::Survived => Some(f64::from(tracked && self.sound && whole)),
        };
        Measures { values: Measure::ALL.map(value), consistency: self.consistency }
    }
}

impl Recorder for Assessor {
    fn record(&mut self, row: &Row) {
        let [x, y, z, _] = row.reference;
        let wanted = self.hold.unwrap_or_else(|| Vector3::new(x, y, z));
        self.once(row);
        self.sound &= row.omega_command.iter().all(|omega| omega.is_finite());
        for (place, least) in &mut self.places {
            *least = least.min((Vector3::from(row.position) - *place).norm());
            if *least > PASSED_M {
                break;
            }
        }
        if self.is_judged(row.t) {
            self.judge(row, &wanted);
        }
    }

    fn navigate(&mut self, navigation: &Navigation) {
        if !self.is_judged(navigation.t) {
            return;
        }
        let is = UnitQuaternion::new_normalize(navigation.truth.attitude);
        let believed = navigation.nav.attitude.cast::<f64>();
        let error = (is * believed.inverse()).scaled_axis();
        let [tilt, heading, attitude, position] = &mut self.known;
        tilt.take(libm::hypot(error.x, error.y));
        heading.take(error.z);
        attitude.take(error.norm());
        position.take((navigation.truth.position - navigation.nav.position.cast()).norm());
        self.consistency.take(navigation, &error);
    }
}
