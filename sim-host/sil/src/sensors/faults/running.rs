//! Active faults, and their effect on samples.

use core::ops::Range;

use firmware::sensors::{BaroSample, BatterySample, GnssSample, ImuSample, MagSample, PoseSample};
use firmware::signals::Tick;
use nalgebra::Vector3;

use super::{Fault, FaultId, Kind, Sensor, span};
use crate::geodesy::{LocalFrame, Place};
use crate::noise::gaussian::Stream;
use crate::sensors::process::{TICKS_PER_S, seconds, ticks};

/// A sample that faults can change. `sensor` selects a half of the IMU; other samples have one sensor.
pub(in crate::sensors) trait Sample: Copy {
    /// The sensor of these samples.
    const CHANNEL: Sensor;
    /// Whether the value has a direction; without one, errors go along x.
    const IS_VECTOR: bool = true;

    /// The time stamp, if it has one.
    fn stamp(&mut self) -> Option<&mut Tick>;

    /// Adds an error to the value, in the sensor's unit.
    fn add(&mut self, sensor: Sensor, error: &Vector3<f64>);

    /// Sets the values to NaN.
    fn spoil(&mut self, sensor: Sensor);

    /// Takes the value of an earlier sample, keeping the time stamp.
    fn hold(&mut self, sensor: Sensor, earlier: &Self);

    /// Removes the fix.
    fn lose_fix(&mut self) {}
}

impl Sample for ImuSample {
    const CHANNEL: Sensor = Sensor::Imu;

    fn stamp(&mut self) -> Option<&mut Tick> {
        Some(&mut self.at)
    }

    fn add(&mut self, sensor: Sensor, error: &Vector3<f64>) {
        let value = if sensor == Sensor::Gyro { &mut self.gyro } else { &mut self.accel };
        *value += error.cast::<f32>();
    }

    fn spoil(&mut self, sensor: Sensor) {
        let spoilt = Self { gyro: Vector3::repeat(f32::NAN), accel: Vector3::repeat(f32::NAN), ..*self };
        self.hold(sensor, &spoilt);
    }

    fn hold(&mut self, sensor: Sensor, earlier: &Self) {
        if sensor != Sensor::Accel {
            self.gyro = earlier.gyro;
        }
        if sensor != Sensor::Gyro {
            self.accel = earlier.accel;
        }
    }
}

impl Sample for MagSample {
    const CHANNEL: Sensor = Sensor::Mag;

    fn stamp(&mut self) -> Option<&mut Tick> {
        Some(&mut self.at)
    }

    fn add(&mut self, _: Sensor, error: &Vector3<f64>) {
        self.field_ut += error.cast::<f32>();
    }

    fn spoil(&mut self, _: Sensor) {
        self.field_ut = Vector3::repeat(f32::NAN);
    }

    fn hold(&mut self, _: Sensor, earlier: &Self) {
        self.field_ut = earlier.field_ut;
    }
}

impl Sample for BaroSample {
    const CHANNEL: Sensor = Sensor::Baro;
    const IS_VECTOR: bool = false;

    fn stamp(&mut self) -> Option<&mut Tick> {
        Some(&mut self.at)
    }

    fn add(&mut self, _: Sensor, error: &Vector3<f64>) {
        self.pressure_pa += error.x as f32;
    }

    fn spoil(&mut self, _: Sensor) {
        self.pressure_pa = f32::NAN;
    }

    fn hold(&mut self, _: Sensor, earlier: &Self) {
        self.pressure_pa = earlier.pressure_pa;
    }
}

impl Sample for GnssSample {
    const CHANNEL: Sensor = Sensor::Gnss;

    fn stamp(&mut self) -> Option<&mut Tick> {
        Some(&mut self.at)
    }

    fn add(&mut self, _: Sensor, error: &Vector3<f64>) {
        self.place = LocalFrame::at(&Place::of(&self.place)).place(error).rounded();
    }

    fn spoil(&mut self, _: Sensor) {
        self.velocity = Vector3::repeat(f32::NAN);
        self.horizontal_accuracy_m = f32::NAN;
        self.vertical_accuracy_m = f32::NAN;
        self.speed_accuracy_m_s = f32::NAN;
    }

    fn hold(&mut self, _: Sensor, earlier: &Self) {
        *self = Self { at: self.at, ..*earlier };
    }

    fn lose_fix(&mut self) {
        self.has_fix = false;
    }
}

impl Sample for PoseSample {
    const CHANNEL: Sensor = Sensor::Pose;

    fn stamp(&mut self) -> Option<&mut Tick> {
        Some(&mut self.at)
    }

    fn add(&mut self, _: Sensor, error: &Vector3<f64>) {
        self.position += error.cast::<f32>();
    }

    fn spoil(&mut self, _: Sensor) {
        self.position = Vector3::repeat(f32::NAN);
    }

    fn hold(&mut self, _: Sensor, earlier: &Self) {
        *self = Self { at: self.at, ..*earlier };
    }
}

impl Sample for BatterySample {
    const CHANNEL: Sensor = Sensor::Battery;
    const IS_VECTOR: bool = false;

    fn stamp(&mut self) -> Option<&mut Tick> {
        None
    }

    fn add(&mut self, _: Sensor, error: &Vector3<f64>) {
        self.voltage_v += error.x as f32;
    }

    fn spoil(&mut self, _: Sensor) {
        (self.voltage_v, self.current_a) = (f32::NAN, f32::NAN);
    }

    fn hold(&mut self, _: Sensor, earlier: &Self) {
        *self = *earlier;
    }
}

/// Delivery of a sample.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Way {
    is_lost: bool,
    is_repeated: bool,
    is_disordered: bool,
    /// Additional latency, ticks.
    pub(super) extra: u32,
}

/// A sample that is held back until the next has overtaken it.
#[derive(Clone, Copy, Debug)]
enum Waiting<T> {
    No,
    /// It was the last one.
    ForTheNext(T),
    /// The next one has gone by.
    ForItsTurn(T),
}

/// State of a sensor's faults.
#[derive(Clone, Copy, Debug)]
pub(in crate::sensors) struct Memory<T> {
    /// The value for a stuck sensor.
    last: Option<T>,
    /// The last sample delivered.
    sent: Option<T>,
    waiting: Waiting<T>,
}

impl<T: Sample> Memory<T> {
    pub(in crate::sensors) const fn new() -> Self {
        Self { last: None, sent: None, waiting: Waiting::No }
    }

    pub(super) fn keep(&mut self, sample: &T) {
        self.last = Some(*sample);
    }

    /// The sample delivered in place of another.
    pub(super) fn send(&mut self, sample: T, way: Way) -> Option<T> {
        if way.is_lost {
            return None;
        }
        let sample = self.sent.filter(|_| way.is_repeated).unwrap_or(sample);
        let sent = if way.is_disordered {
            self.disorder(sample)
        } else {
            // A sample still held back when the fault ends is lost.
            self.waiting = Waiting::No;
            Some(sample)
        };
        self.sent = sent.or(self.sent);
        sent
    }

    /// Delivers samples 0, 1, 2, 3 … as none, 1, 0, 3, 2 …: one at a time, in swapped pairs.
    fn disorder(&mut self, sample: T) -> Option<T> {
        let (sent, waiting) = match self.waiting {
            Waiting::No => (None, Waiting::ForTheNext(sample)),
            Waiting::ForTheNext(held) => (Some(sample), Waiting::ForItsTurn(held)),
            Waiting::ForItsTurn(held) => (Some(held), Waiting::ForTheNext(sample)),
        };
        self.waiting = waiting;
        sent
    }
}

/// A fault with its random stream.
#[derive(Clone, Debug)]
pub(super) struct Running {
    pub(super) id: FaultId,
    pub(super) kind: Kind,
    sensor: Option<Sensor>,
    /// The sensor whose samples it acts on.
    pub(super) channel: Option<Sensor>,
    ticks: Range<Tick>,
    /// Direction of a constant error.
    direction: Vector3<f64>,
    stream: Stream,
}

impl Running {
    pub(super) fn new(fault: &Fault, id: FaultId, mut stream: Stream) -> Self {
        let drawn = stream.direction();
        let given = |direction: Option<[f64; 3]>, or: Vector3<f64>| direction.map_or(or, Vector3::from).normalize();
        let direction = match fault.kind {
            Kind::Drift { direction, .. } => given(direction, drawn),
            // At the poles there is no horizontal component, but they have probability 0.
            Kind::Glitch { direction, .. } => given(direction, Vector3::new(drawn.x, drawn.y, 0.0)),
            _ => drawn,
        };
        let channel = fault.sensor.map(Sensor::channel);
        Self { id, kind: fault.kind, sensor: fault.sensor, channel, ticks: span(fault), direction, stream }
    }

    pub(super) fn is_active(&self, tick: Tick) -> bool {
        self.ticks.contains(&tick)
    }

    /// Its first tick.
    pub(super) fn begins(&self) -> Tick {
        self.ticks.start
    }

    pub(super) fn is_over(&self, tick: Tick) -> bool {
        tick >= self.ticks.end
    }

    /// As it was asked for.
    pub(super) fn fault(&self) -> Fault {
        let to_s = (self.ticks.end != Tick::MAX).then(|| seconds(self.ticks.end));
        Fault { sensor: self.sensor, kind: self.kind, from_s: seconds(self.ticks.start), to_s }
    }

    /// Replaces a sample's value by the previous one, for a stuck sensor.
    pub(super) fn hold<T: Sample>(&self, sample: &mut T, memory: &Memory<T>) {
        if let (Kind::Stuck {}, Some(sensor), Some(last)) = (self.kind, self.sensor, &memory.last) {
            sample.hold(sensor, last);
        }
    }

    /// Applies the fault to a sample measured at `tick`, and to its delivery.
    pub(super) fn act<T: Sample>(&mut self, tick: Tick, sample: &mut T, way: &mut Way) {
        let Some(sensor) = self.sensor else { return };
        match self.kind {
            Kind::Drift { rate, .. } => {
                let along = if T::IS_VECTOR { self.direction } else { Vector3::x() };
                sample.add(sensor, &(along * (rate * seconds(tick - self.ticks.start))));
            }
            Kind::Noise { sigma } => sample.add(sensor, &(self.stream.normal_vector() * sigma)),
            Kind::Spikes { probability, size } => {
                if let Some(direction) = self.spike::<T>(probability) {
                    sample.add(sensor, &(direction * size));
                }
            }
            Kind::Glitch { size_m, .. } => sample.add(sensor, &(self.direction * size_m)),
            Kind::Nan {} => sample.spoil(sensor),
            Kind::NoFix {} => sample.lose_fix(),
            Kind::TimeJump { shift_s } => shift(sample, shift_s),
            Kind::Off {} => way.is_lost = true,
            Kind::Loss { probability } => way.is_lost |= self.stream.unit() <= probability,
            Kind::Duplicate { probability } => way.is_repeated |= self.stream.unit() <= probability,
            Kind::Disorder {} => way.is_disordered = true,
            Kind::Delayed { extra_s } => way.extra = way.extra.saturating_add(ticks(extra_s)),
            Kind::Stuck {} | Kind::Rotor { .. } | Kind::Collapse { .. } => {}
        }
    }

    /// Direction of a spike, if this sample has one; ±1 for a scalar.
    fn spike<T: Sample>(&mut self, probability: f64) -> Option<Vector3<f64>> {
        let (chance, direction) = (self.stream.unit(), self.stream.direction());
        let direction = if T::IS_VECTOR { direction } else { Vector3::x() * direction.x.signum() };
        (chance <= probability).then_some(direction)
    }
}

fn shift<T: Sample>(sample: &mut T, shift_s: f64) {
    if let Some(at) = sample.stamp() {
        *at = at.saturating_add_signed((shift_s * TICKS_PER_S).round() as i32);
    }
}
