//! What a flight leaves behind: one row a tick, and who takes it.

use firmware::commander::CommanderOutput;
use firmware::estimator::covariance::Covariance;
use firmware::estimator::{FilterOutput, FilterReport};
use firmware::signals::{NavHealth, NavState};
use nalgebra::Vector3;

use crate::outcome::End;
use crate::plant::Motion;
use crate::plant::battery::BatteryState;

/// One tick of a flight. World frame NWU, body frame FLU, SI units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Row {
    /// Time, s.
    pub t: f64,
    /// True position at t, m.
    pub position: [f64; 3],
    /// True velocity at t, m/s.
    pub velocity: [f64; 3],
    /// True attitude at t, body to world: w, x, y, z.
    pub attitude: [f64; 4],
    /// True body rates p, q, r at t, rad/s.
    pub rates: [f64; 3],
    /// Rotor speeds that act from t to the next row, rad/s; with rotor lag, the speeds at t.
    pub omega: [f64; 4],
    /// Commanded rotor speeds that act from t to the next row, rad/s.
    pub omega_command: [f64; 4],
    /// Reference position (m) and yaw (rad) at t: the paper's own trajectory, not the path that joins it; with a pilot,
    /// where guidance has the vehicle.
    pub reference: [f64; 4],
    /// Whether the reference is that of an earlier row: guidance renews it at 250 Hz, and between it stands still while the
    /// vehicle flies on. No error is to be taken from such a row.
    pub reference_is_held: bool,
    /// Desired roll, pitch, yaw in effect at t, rad.
    pub desired_attitude: [f64; 3],
    /// U1 (N), U2..U4 (N m) as the controller demanded them at t.
    pub u: [f64; 4],
    /// Sliding variables s1, s2, s3 (rad/s), sx, sy, sz (m/s).
    pub s: [f64; 6],
}

/// A vehicle further than this from where it ought to be is lost, m.
pub const LOST_M: f64 = 50.0;

impl Row {
    /// The true motion at `t` (s), and nothing else yet.
    pub fn of_motion(t: f64, motion: &Motion) -> Self {
        let q = &motion.attitude;
        Self {
            t,
            position: motion.position.into(),
            velocity: motion.velocity.into(),
            attitude: [q.w, q.i, q.j, q.k],
            rates: motion.rates.into(),
            ..Self::default()
        }
    }

    /// Whether a flight that follows its reference ends here, and why.
    pub fn end(&self) -> End {
        let near = self.position.iter().zip(&self.reference).all(|(is, ought)| (is - ought).abs() < LOST_M);
        let mut rest = self.velocity.iter().chain(&self.attitude).chain(&self.rates);
        let finite = rest.all(|value| value.is_finite());
        if near && finite {
            return End::DurationReached;
        }
        let finite = finite && self.position.iter().all(|value| value.is_finite());
        if finite { End::LeftReference } else { End::NotFinite }
    }
}

/// What a vehicle on sensors believes at a tick, beside the truth.
#[derive(Clone, Copy, Debug)]
pub struct Navigation<'a> {
    /// Time, s.
    pub t: f64,
    /// What is true.
    pub truth: Motion,
    /// What is believed.
    pub nav: &'a NavState,
    /// What the vehicle takes its gyroscope to be off by, rad/s.
    pub gyro_bias: Vector3<f32>,
    /// What it takes its accelerometer to be off by, m/s².
    pub accel_bias: Vector3<f32>,
    /// What of the motion it trusts.
    pub health: NavHealth,
    /// What the filter knows.
    pub filter: &'a FilterReport,
    /// Its output, if one has come into effect at this tick.
    pub filtered: Option<&'a FilterOutput>,
    /// The filter's covariance.
    pub covariance: &'a Covariance,
    /// What the vehicle is doing.
    pub commander: &'a CommanderOutput,
}

/// What the vehicle is doing at a tick, and what its pilot has told it.
#[derive(Clone, Copy, Debug)]
pub struct Activity<'a> {
    /// Time, s.
    pub t: f64,
    /// What the vehicle is doing.
    pub commander: &'a CommanderOutput,
    /// How many commands of its script the pilot has given.
    pub given: usize,
    /// The battery as it is, if there is one.
    pub battery: Option<BatteryState>,
}

/// All that a tick shows.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// The truth, and what the controller makes of it.
    pub row: Row,
    /// What the vehicle is doing, where the firmware flies in lockstep.
    pub activity: Option<Activity<'a>>,
    /// What the vehicle believes, on sensors.
    pub navigation: Option<Navigation<'a>>,
}

impl Seen<'_> {
    /// Hands it to a recorder.
    #[inline]
    pub fn show(&self, recorder: &mut impl Recorder) {
        recorder.record(&self.row);
        if let Some(activity) = &self.activity {
            recorder.observe(activity);
        }
        if let Some(navigation) = &self.navigation {
            recorder.navigate(navigation);
        }
    }
}

/// Takes the rows of a flight, in order.
pub trait Recorder {
    /// False where rows would be thrown away, so that the loop need not make them.
    const ENABLED: bool = true;

    /// Takes the next row.
    fn record(&mut self, row: &Row);

    /// Takes what the vehicle believes, after the row of the same tick; of flights on sensors alone.
    fn navigate(&mut self, _navigation: &Navigation) {}

    /// Takes what the vehicle is doing, after the row of the same tick; of flights with the firmware in lockstep.
    fn observe(&mut self, _activity: &Activity) {}

    /// Whether the flight is to end after this tick. Asked after each row, so that it must be cheap.
    fn stops(&self) -> bool {
        false
    }
}

/// Takes nothing: for benchmarks.
impl Recorder for () {
    const ENABLED: bool = false;

    fn record(&mut self, _row: &Row) {}
}

/// Keeps everything.
impl Recorder for Vec<Row> {
    fn record(&mut self, row: &Row) {
        self.push(*row);
    }
}

/// Gives each row to two recorders.
impl<A: Recorder, B: Recorder> Recorder for (A, B) {
    const ENABLED: bool = A::ENABLED || B::ENABLED;

    fn record(&mut self, row: &Row) {
        self.0.record(row);
        self.1.record(row);
    }

    fn navigate(&mut self, navigation: &Navigation) {
        self.0.navigate(navigation);
        self.1.navigate(navigation);
    }

    fn observe(&mut self, activity: &Activity) {
        self.0.observe(activity);
        self.1.observe(activity);
    }

    fn stops(&self) -> bool {
        self.0.stops() || self.1.stops()
    }
}

/// Gives each row to a recorder, if there is one.
impl<A: Recorder> Recorder for Option<A> {
    const ENABLED: bool = A::ENABLED;

    fn record(&mut self, row: &Row) {
        if let Some(recorder) = self {
            recorder.record(row);
        }
    }

    fn navigate(&mut self, navigation: &Navigation) {
        if let Some(recorder) = self {
            recorder.navigate(navigation);
        }
    }

    fn observe(&mut self, activity: &Activity) {
        if let Some(recorder) = self {
            recorder.observe(activity);
        }
    }

    fn stops(&self) -> bool {
        self.as_ref().is_some_and(Recorder::stops)
    }
}

/// Gives each row to somebody else's recorder.
impl<A: Recorder> Recorder for &mut A {
    const ENABLED: bool = A::ENABLED;

    fn record(&mut self, row: &Row) {
        (**self).record(row);
    }

    fn navigate(&mut self, navigation: &Navigation) {
        (**self).navigate(navigation);
    }

    fn observe(&mut self, activity: &Activity) {
        (**self).observe(activity);
    }

    fn stops(&self) -> bool {
        (**self).stops()
    }
}
