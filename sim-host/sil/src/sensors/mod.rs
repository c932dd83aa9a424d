//! The sensors of the vehicle: from the truth to the measurements that the firmware gets.
//!
//! ```text
//! truth ──► sensor model ──► faults ──► latency ──► Measurements     each tick, 1 kHz
//!           (imu, mag, baro, gnss, pose, battery)
//! ```
//!
//! World frame NWU, body frame FLU, SI units. Each source of randomness has its own stream: adding, changing or failing
//! a sensor changes no other sensor's samples. A tick does not allocate.

pub mod baro;
pub mod battery;
mod channel;
pub(crate) mod check;
mod estimator_settings;
pub mod faults;
pub mod gnss;
pub mod home;
pub mod imu;
pub mod mag;
pub mod pose;
mod process;
pub mod suite;
pub mod vibration;

use anyhow::{Result, ensure};
use firmware::airframe::ROTORS;
use firmware::sensors::Measurements;
use firmware::signals::Tick;
use nalgebra::{UnitQuaternion, Vector3};

pub use faults::{Fault, FaultId, Faults};
pub use home::Home;
pub use process::WarmUp;
pub use suite::{SUITES, SuiteFile};

use crate::plant::{Motion, PlantFaults};
use baro::Barometer;
use battery::Monitor;
use channel::Channel;
use faults::{Sample, Sensor};
use gnss::Receiver;
use imu::InertialUnit;
use mag::Magnetometer;
use pose::MotionCapture;
use process::Period;

/// The state of the battery.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BatteryTruth {
    /// At the terminals, V.
    pub voltage_v: f64,
    /// Drawn from it, A.
    pub current_a: f64,
}

/// The truth at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth<'a> {
    /// When.
    pub tick: Tick,
    /// Motion of the body.
    pub motion: &'a Motion,
    /// Rᵀ(v̇ + g e3), in the body, m/s².
    pub specific_force: Vector3<f64>,
    /// Rotor speeds, rad/s.
    pub omega: [f64; ROTORS],
    /// The battery.
    pub battery: BatteryTruth,
}

impl Truth<'_> {
    /// Body to world.
    fn attitude(&self) -> UnitQuaternion<f64> {
        UnitQuaternion::new_unchecked(self.motion.attitude)
    }
}

/// Model of a fault-free sensor.
trait Model {
    /// Its sample.
    type Sample: Sample;

    /// Its sampling period.
    fn period(&self) -> Period;

    /// Latency of the next measurement, ticks. Called once per measurement.
    fn delay(&mut self) -> u32;

    /// Measures. Called when the period is due.
    fn measure(&mut self, truth: &Truth) -> Self::Sample;
}

/// A sensor model with the channel that delivers its samples.
#[derive(Clone, Debug)]
struct Fitted<M: Model> {
    model: M,
    channel: Channel<M::Sample>,
}

impl<M: Model> Fitted<M> {
    fn new(model: M) -> Self {
        Self { channel: Channel::new(model.period()), model }
    }

    /// The sample that arrives at a tick.
    fn deliver(&mut self, truth: &Truth, faults: &mut Faults) -> Option<M::Sample> {
        if self.model.period().is_due(truth.tick) {
            let (delay, sample) = (self.model.delay(), self.model.measure(truth));
            self.channel.send(truth.tick, delay, sample, faults);
        }
        self.channel.arrival(truth.tick)
    }
}

/// The sensors of a flight.
#[derive(Clone, Debug)]
pub struct Suite {
    file: SuiteFile,
    imu: Fitted<InertialUnit>,
    mag: Option<Fitted<Magnetometer>>,
    baro: Option<Fitted<Barometer>>,
    gnss: Option<Fitted<Receiver>>,
    pose: Option<Fitted<MotionCapture>>,
    battery: Option<Fitted<Monitor>>,
    faults: Faults,
    /// Whether faults were started or ended in flight: then these determine rotors and battery, not the schedule.
    commanded: bool,
    /// The faults last applied to the plant.
    applied: Option<PlantFaults>,
}

impl Suite {
    /// A valid suite at a home, under a schedule of faults and a seed.
    pub fn new(suite: &SuiteFile, home: &Home, faults: &[Fault], seed: u64) -> Self {
        Self {
            file: suite.clone(),
            imu: Fitted::new(InertialUnit::new(&suite.imu, seed)),
            mag: suite.mag.as_ref().map(|spec| Fitted::new(Magnetometer::new(spec, home, seed))),
            baro: suite.baro.as_ref().map(|spec| Fitted::new(Barometer::new(spec, home, seed))),
            gnss: suite.gnss.as_ref().map(|spec| Fitted::new(Receiver::new(spec, home, seed))),
            pose: suite.pose.as_ref().map(|spec| Fitted::new(MotionCapture::new(spec, seed))),
            battery: suite.battery.as_ref().map(|spec| Fitted::new(Monitor::new(spec, seed))),
            faults: Faults::new(faults, seed),
            commanded: false,
            applied: None,
        }
    }

    /// The samples that arrive at a tick. Call once per tick, in order.
    pub fn measure(&mut self, truth: &Truth) -> Measurements {
        let faults = &mut self.faults;
        Measurements {
            imu: self.imu.deliver(truth, faults),
            mag: self.mag.as_mut().and_then(|mag| mag.deliver(truth, faults)),
            baro: self.baro.as_mut().and_then(|baro| baro.deliver(truth, faults)),
            gnss: self.gnss.as_mut().and_then(|gnss| gnss.deliver(truth, faults)),
            pose: self.pose.as_mut().and_then(|pose| pose.deliver(truth, faults)),
            battery: self.battery.as_mut().and_then(|battery| battery.deliver(truth, faults)),
        }
    }

    /// Errors of gyro (rad/s) and accelerometer (m/s²) without noise and vibration, with the biases of the last sample:
    /// to test the estimated biases.
    pub fn imu_error(&self, rates: &Vector3<f64>, force: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        self.imu.model.error(rates, force)
    }

    /// The faults, including those of rotors and battery.
    pub fn faults(&self) -> &Faults {
        &self.faults
    }

    /// Adds a fault in flight.
    ///
    /// # Errors
    /// The fault is invalid, its sensor is not in the suite, or there are too many.
    pub fn inject(&mut self, fault: &Fault) -> Result<FaultId> {
        if let Some(sensor) = fault.sensor {
            ensure!(self.has(sensor), "there is no `{}` on board", sensor.name());
        }
        let id = self.faults.inject(fault)?;
        self.commanded = true;
        Ok(id)
    }

    /// Replaces the fault in a slot by a valid one, or by none.
    pub fn hold(&mut self, slot: usize, fault: Option<&Fault>) {
        self.commanded = true;
        self.faults.hold(slot, fault);
    }

    /// Ends a fault.
    pub fn clear(&mut self, id: FaultId) {
        self.commanded = true;
        self.faults.clear(id);
    }

    /// Ends the faults of which this is true, also before they have begun.
    pub fn clear_where(&mut self, is_over: impl Fn(&Fault) -> bool) {
        self.commanded = true;
        self.faults.clear_where(is_over);
    }

    /// Ends all faults, including future ones.
    pub fn clear_all(&mut self) {
        self.commanded = true;
        self.faults.clear_all();
    }

    /// Whether the suite has a sensor.
    pub fn has(&self, sensor: Sensor) -> bool {
        self.file.has(sensor)
    }

    /// The faults to apply to rotors and battery at a tick, if they have changed. `None` until faults have been started
    /// or ended in flight: before, the plant follows the schedule.
    pub fn tell_plant(&mut self, tick: Tick) -> Option<PlantFaults> {
        if !self.commanded {
            return None;
        }
        let now = self.faults.of_plant(tick);
        (self.applied.replace(now) != Some(now)).then_some(now)
    }
}

#[cfg(test)]
mod tests;
