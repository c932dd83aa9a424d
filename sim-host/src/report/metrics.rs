//! What a flight is judged by, taken row by row: settling, RMS and maximum error an axis, overshoot, chattering and
//! control effort. Owns the definitions; the words and files around them are [`summary`](super::summary)'s.
//!
//! Errors are `e = reference − truth` (m; yaw in rad, the short way round), against the paper's own trajectory.
//! Every figure is an `Option`: `None` where it is not defined (no rows after 4 s, say) or not finite.

use nalgebra::Quaternion;
use serde::Serialize;

pub use super::measures::Settling;
use super::measures::{Recent, Size, Variation, finite};
use crate::angles::{roll_pitch_yaw, wrap, yaw};
use crate::plant::ground::Ground;
use crate::record::{Recorder, Row};

/// RMS and maximum error are taken from here on, s: what comes before is the approach.
pub const TRACKING_FROM_S: f64 = 4.0;
/// The wide band: 5 cm, for yaw 0.05 rad.
pub const WIDE_BAND: f64 = 0.05;
/// The narrow band: 2 mm, for yaw 0.002 rad.
pub const NARROW_BAND: f64 = 0.002;
/// A disturbed angle has recovered within 2°, rad.
pub const ANGLE_RECOVERY_BAND: f64 = 2.0 * std::f64::consts::PI / 180.0;

/// One value for each of the axes that follow a reference.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Axes<T> {
    /// North.
    pub x: T,
    /// West.
    pub y: T,
    /// Up.
    pub z: T,
    /// Heading.
    pub yaw: T,
}

impl<T> Axes<T> {
    /// Each axis with its name, in order.
    pub fn named(&self) -> [(&'static str, &T); 4] {
        [("x", &self.x), ("y", &self.y), ("z", &self.z), ("yaw", &self.yaw)]
    }

    fn from_array([x, y, z, yaw]: [T; 4]) -> Self {
        Self { x, y, z, yaw }
    }
}

/// How one axis followed its reference. Lengths in m; for yaw the same keys hold rad.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct AxisFigures {
    /// From when on |e| < 5 cm (0.05 rad) until the end, s.
    pub settle_5cm_s: Option<f64>,
    /// From when on |e| < 2 mm (0.002 rad) until the end, s.
    pub settle_2mm_s: Option<f64>,
    /// Root mean square of e after 4 s.
    pub rms_m: Option<f64>,
    /// Maximum of |e| after 4 s.
    pub max_m: Option<f64>,
    /// How far the flight went past the reference, as a fraction of the initial error; `None` where that was below
    /// 5 cm (0.05 rad), where there is nothing to overshoot.
    pub overshoot: Option<f64>,
}

/// Root mean squares of what the controller demanded, over the whole flight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ControlEffort {
    /// U1, N.
    pub thrust_rms_n: Option<f64>,
    /// U2, N m.
    pub roll_rms_n_m: Option<f64>,
    /// U3, N m.
    pub pitch_rms_n_m: Option<f64>,
    /// U4, N m.
    pub yaw_rms_n_m: Option<f64>,
}

/// How roll and pitch followed the desired attitude after 4 s, rad.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct TiltFigures {
    /// Root mean square of the error in roll.
    pub roll_rms_rad: Option<f64>,
    /// Greatest error in roll.
    pub roll_max_rad: Option<f64>,
    /// Root mean square of the error in pitch.
    pub pitch_rms_rad: Option<f64>,
    /// Greatest error in pitch.
    pub pitch_max_rad: Option<f64>,
}

/// The greatest errors in about the last second of a flight; infinite where one was NaN.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EndErrors {
    /// Distance from the reference, m.
    pub distance_m: f64,
    /// Error of roll or pitch, rad.
    pub tilt_rad: f64,
    /// Error of yaw, rad.
    pub yaw_rad: f64,
}

/// Time from a disturbance's onset until the error stays within 5 cm, or 2° for an angle, s. `None` if it does not, and
/// if it was outside at the onset already, which is not the disturbance's doing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Recovery {
    /// North.
    pub x: Option<f64>,
    /// West.
    pub y: Option<f64>,
    /// Up.
    pub z: Option<f64>,
    /// Heading.
    pub yaw: Option<f64>,
    /// Roll.
    pub roll: Option<f64>,
    /// Pitch.
    pub pitch: Option<f64>,
    /// Which of x, y, z, roll, pitch, yaw were outside at the onset already.
    #[serde(skip)]
    pub outside: [bool; 6],
}

impl Recovery {
    /// The names of what [`as_array`](Self::as_array) has.
    pub const NAMES: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];

    /// x, y, z, roll, pitch, yaw.
    pub fn as_array(&self) -> [Option<f64>; 6] {
        [self.x, self.y, self.z, self.roll, self.pitch, self.yaw]
    }

    /// The time of the slowest; `None` if one has none.
    pub fn slowest(&self) -> Option<f64> {
        self.as_array().into_iter().try_fold(0.0_f64, |most, time| Some(most.max(time?)))
    }

    /// The names of those that took longer than `time_s`, or did not recover.
    pub fn later_than(&self, time_s: f64) -> Vec<&'static str> {
        let is_late = |time: Option<f64>| time.is_none_or(|time| time > time_s);
        Self::NAMES.into_iter().zip(self.as_array()).filter_map(|(name, time)| is_late(time).then_some(name)).collect()
    }

    /// The names of those that were outside at the onset already.
    pub fn away(&self) -> Vec<&'static str> {
        Self::NAMES.into_iter().zip(self.outside).filter_map(|(name, outside)| outside.then_some(name)).collect()
    }
}

#[derive(Clone, Copy, Debug)]
struct Axis {
    initial: Option<f64>,
    wide: Settling,
    narrow: Settling,
    tracking: Size,
    /// How far past the reference, in the error's unit.
    beyond: f64,
}

impl Axis {
    fn new() -> Self {
        let (wide, narrow) = (Settling::new(WIDE_BAND), Settling::new(NARROW_BAND));
        Self { initial: None, wide, narrow, tracking: Size::default(), beyond: 0.0 }
    }

    /// Begins again with the next error: the reference has jumped.
    fn restart(&mut self) {
        (self.initial, self.beyond) = (None, 0.0);
    }

    fn take(&mut self, t: f64, error: f64) {
        let initial = *self.initial.get_or_insert(error);
        self.beyond = self.beyond.max(-initial.signum() * error);
        self.wide.take(t, error);
        self.narrow.take(t, error);
        if t >= TRACKING_FROM_S {
            self.tracking.take(error);
        }
    }

    fn figures(&self) -> AxisFigures {
        AxisFigures {
            settle_5cm_s: self.wide.since(),
            settle_2mm_s: self.narrow.since(),
            rms_m: self.tracking.rms(),
            max_m: self.tracking.max(),
            overshoot: self.overshoot(),
        }
    }

    fn overshoot(&self) -> Option<f64> {
        let initial = self.initial?.abs();
        if initial < WIDE_BAND { None } else { finite(self.beyond / initial) }
    }
}

/// Accumulates a flight's figures row by row, without allocation.
#[derive(Clone, Debug)]
pub struct Metrics {
    axes: [Axis; 4],
    /// Roll, pitch, yaw.
    angles: [Settling; 3],
    tilt: [Axis; 2],
    /// Distance from the reference (m), and the greatest error of roll and pitch, and that of yaw (rad).
    recent: [Recent; 3],
    /// Distance from the reference over the whole flight, m.
    distance: Size,
    chattering: Variation,
    chattering_after_4s: Variation,
    effort: [Size; 4],
    last_t: Option<f64>,
    /// The reference of the row before, m.
    reference: Option<[f64; 3]>,
    jumped_s: Option<f64>,
    /// Whether it was away from its reference in the first row.
    began_away: bool,
    /// Where a foot touches it, errors of the attitude are not those of control.
    ground: Option<Ground>,
}

impl Metrics {
    /// Before the first row.
    pub fn new() -> Self {
        Self {
            axes: [Axis::new(); 4],
            angles: [Settling::new(ANGLE_RECOVERY_BAND); 3],
            tilt: [Axis::new(); 2],
            recent: [Recent::default(); 3],
            distance: Size::default(),
            chattering: Variation::from(f64::NEG_INFINITY),
            chattering_after_4s: Variation::from(TRACKING_FROM_S),
            effort: [Size::default(); 4],
            last_t: None,
            reference: None,
            jumped_s: None,
            began_away: false,
            ground: None,
        }
    }

    /// The same over a ground: errors of the attitude count while no foot touches it.
    #[must_use]
    pub fn over(self, ground: Option<Ground>) -> Self {
        Self { ground, ..self }
    }

    fn is_on_ground(&self, row: &Row) -> bool {
        let [w, x, y, z] = row.attitude;
        let attitude = Quaternion::new(w, x, y, z);
        self.ground.as_ref().is_some_and(|ground| ground.touches(&row.position.into(), &attitude))
    }

    /// When the reference last jumped by [`WIDE_BAND`] or more from a row to the next, s. Overshoot counts from there.
    pub fn jumped_s(&self) -> Option<f64> {
        self.jumped_s
    }

    /// Whether it began away from its reference, by [`WIDE_BAND`] or more in an axis.
    pub fn began_away(&self) -> bool {
        self.began_away
    }

    fn take_errors(&mut self, row: &Row, angles: &[f64; 3]) {
        let errors = errors(row);
        for (axis, error) in self.axes.iter_mut().zip(errors) {
            axis.take(row.t, error);
        }
        let ([x, y, z, yaw], [roll, pitch, _]) = (errors, *angles);
        let off = [libm::sqrt(x * x + y * y + z * z), roll.abs().max(pitch.abs()), yaw.abs()];
        for (recent, value) in self.recent.iter_mut().zip(off) {
            recent.take(row.t, value);
        }
        self.distance.take(off[0]);
    }

    fn look_for_jump(&mut self, row: &Row) {
        let [x, y, z, _] = row.reference;
        let now = [x, y, z];
        let Some(before) = self.reference.replace(now) else {
            self.began_away = errors(row).iter().any(|error| error.abs() >= WIDE_BAND);
            return;
        };
        for ((axis, now), before) in self.axes.iter_mut().zip(now).zip(before) {
            if (now - before).abs() >= WIDE_BAND {
                axis.restart();
                self.jumped_s = Some(row.t);
            }
        }
    }

    /// How each axis followed the reference.
    pub fn axes(&self) -> Axes<AxisFigures> {
        Axes::from_array(self.axes.map(|axis| axis.figures()))
    }

    /// Total variation of the commanded ω², summed over the rotors, a second: (rad/s)²/s.
    pub fn chattering(&self) -> Option<f64> {
        self.chattering.per_second()
    }

    /// The same after 4 s, without the approach.
    pub fn chattering_after_4s(&self) -> Option<f64> {
        self.chattering_after_4s.per_second()
    }

    /// Root mean squares of U1..U4.
    pub fn control_effort(&self) -> ControlEffort {
        let [thrust_rms_n, roll_rms_n_m, pitch_rms_n_m, yaw_rms_n_m] = self.effort.map(|u| u.rms());
        ControlEffort { thrust_rms_n, roll_rms_n_m, pitch_rms_n_m, yaw_rms_n_m }
    }

    /// How roll and pitch followed what was desired of them, rad.
    pub fn roll_and_pitch(&self) -> [AxisFigures; 2] {
        self.tilt.map(|axis| axis.figures())
    }

    /// The greatest distance from the reference over the whole flight, m.
    pub fn distance_max_m(&self) -> Option<f64> {
        self.distance.max()
    }

    /// How far the flight was off in about its last second.
    pub fn at_the_end(&self) -> EndErrors {
        let [distance_m, tilt_rad, yaw_rad] = self.recent.map(|recent| recent.max());
        EndErrors { distance_m, tilt_rad, yaw_rad }
    }

    /// How roll and pitch followed what was desired of them, after 4 s, rad.
    pub fn tilt(&self) -> TiltFigures {
        let [roll, pitch] = self.tilt.map(|axis| axis.tracking);
        TiltFigures {
            roll_rms_rad: roll.rms(),
            roll_max_rad: roll.max(),
            pitch_rms_rad: pitch.rms(),
            pitch_max_rad: pitch.max(),
        }
    }

    /// Recovery from a disturbance that set in at `onset_s`; not defined if the flight ended before.
    pub fn recovery(&self, onset_s: f64) -> Recovery {
        if !self.last_t.is_some_and(|last| last > onset_s) {
            return Recovery::default();
        }
        let [x, y, z, _] = self.axes.map(|axis| axis.wide);
        let [roll, pitch, yaw] = self.angles;
        let all = [x, y, z, roll, pitch, yaw];
        let outside = all.map(|settling| settling.was_outside_at(onset_s));
        let [x, y, z, roll, pitch, yaw] =
            all.map(|settling| settling.after(onset_s).filter(|_| !settling.was_outside_at(onset_s)));
        Recovery { x, y, z, yaw, roll, pitch, outside }
    }

    /// From when on roll, pitch and yaw stay within 2° of what is desired, s.
    pub fn angles_settled_s(&self) -> [Option<f64>; 3] {
        self.angles.map(|angle| angle.since())
    }
}

impl Default for Metrics {
    fn default() -> Self {
        Self::new()
    }
}

impl Recorder for Metrics {
    fn record(&mut self, row: &Row) {
        self.last_t = Some(row.t);
        self.look_for_jump(row);
        let angles = angle_errors(row);
        for (settling, error) in self.angles.iter_mut().zip(angles) {
            settling.take(row.t, error);
        }
        if !self.is_on_ground(row) {
            for (axis, error) in self.tilt.iter_mut().zip(angles) {
                axis.take(row.t, error);
            }
        }
        if !row.reference_is_held {
            self.take_errors(row, &angles);
        }
        self.chattering.take(row.t, row.omega_command);
        self.chattering_after_4s.take(row.t, row.omega_command);
        for (effort, u) in self.effort.iter_mut().zip(row.u) {
            effort.take(u);
        }
    }
}

/// Reference − truth: x, y, z (m), yaw (rad, in [−π, π]).
pub fn errors(row: &Row) -> [f64; 4] {
    let ([x, y, z], [ref_x, ref_y, ref_z, ref_yaw]) = (row.position, row.reference);
    [ref_x - x, ref_y - y, ref_z - z, wrap(ref_yaw - yaw(row.attitude))]
}

/// Desired attitude − truth: roll, pitch, yaw, rad in [−π, π].
pub fn angle_errors(row: &Row) -> [f64; 3] {
    let flown = roll_pitch_yaw(row.attitude);
    core::array::from_fn(|i| wrap(row.desired_attitude[i] - flown[i]))
}

#[cfg(test)]
mod tests;
