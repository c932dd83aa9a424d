//! What the inner partition makes of sensors: the predictor, the filter ahead of the controller, and the readings that
//! wait for the filter's next job.

use nalgebra::Vector3;

use crate::airframe::ROTORS;
use crate::config::FlightConfig;
use crate::control::gyro::GyroFilter;
use crate::estimator::{EstimatorSettings, FilterInput, Injection, Nominal, Predictor, Readings};
use crate::math;
use crate::sensors::{BatterySample, Measurements};
use crate::signals::NavState;

/// The inner half of navigation.
#[derive(Clone, Debug)]
pub struct Navigator {
    predictor: Predictor,
    gyro: GyroFilter,
    /// Ω through the filter, with its bias, rad/s.
    filtered: Vector3<f32>,
    readings: Readings,
    battery: Option<BatterySample>,
    /// Ticks since that was measured, as far as they can be counted.
    battery_age: u16,
    /// Whether the last job's injection has been taken in.
    injected: bool,
}

impl Navigator {
    /// At rest where the flight begins; none for a flight on ideal state.
    pub fn new(config: &FlightConfig) -> Option<Self> {
        config.estimator.as_ref().map(|_: &EstimatorSettings| Self {
            predictor: Predictor::new(config.start_position(), config.airframe.gravity_m_s2),
            gyro: GyroFilter::new(),
            filtered: Vector3::zeros(),
            readings: Readings::default(),
            battery: None,
            battery_age: 0,
            injected: false,
        })
    }

    /// One tick with what has been measured, if anything has; true if the IMU's sample was taken in. `omega_rad_s` are
    /// the speeds at which the rotors are believed to turn.
    #[inline]
    pub fn step(&mut self, measured: Option<&Measurements>, omega_rad_s: &[f32; ROTORS]) -> bool {
        let fresh = self.predictor.predict(measured.and_then(|m| m.imu.as_ref()));
        let raw = self.predictor.rates() + self.predictor.state().gyro_bias;
        self.filtered = self.gyro.filter(&raw, omega_rad_s);
        self.battery_age = self.battery_age.saturating_add(1);
        if let Some(measured) = measured {
            self.keep(measured);
        }
        fresh
    }

    /// Keeps the newest reading of each sensor, and of the battery.
    fn keep(&mut self, measured: &Measurements) {
        self.readings.keep(measured);
        if let Some(battery) = measured.battery.filter(|b| math::all_finite(&[b.voltage_v, b.current_a])) {
            (self.battery, self.battery_age) = (Some(battery), 0);
        }
    }

    /// The motion now; its rates are the filtered ones.
    #[inline]
    pub fn nav(&self) -> NavState {
        let state = self.predictor.state();
        NavState {
            position: state.position,
            velocity: state.velocity,
            attitude: state.attitude,
            rates: self.filtered - state.gyro_bias,
        }
    }

    /// What the predictor believes: motion and biases.
    pub fn state(&self) -> &Nominal {
        self.predictor.state()
    }

    /// f without its bias in the body's frame, m/s².
    #[inline]
    pub fn specific_force(&self) -> &Vector3<f32> {
        self.predictor.specific_force()
    }

    /// The battery as last measured, unless that is too long ago to say anything.
    pub fn battery(&self) -> Option<BatterySample> {
        /// Ticks.
        const SILENT_AFTER: u16 = 1_000;
        self.battery.filter(|_| self.battery_age < SILENT_AFTER)
    }

    /// The same, and how many ticks ago that was.
    pub fn battery_with_age(&self) -> Option<(BatterySample, u32)> {
        self.battery.map(|battery| (battery, u32::from(self.battery_age)))
    }

    /// The filter's snapshot, of a vehicle that is on the ground and, disarmed, at rest; or is not.
    pub fn release(&mut self, landed: bool, at_rest: bool) -> FilterInput {
        FilterInput {
            state: *self.predictor.state(),
            rates: *self.predictor.rates(),
            force: *self.predictor.specific_force(),
            span: self.predictor.take_span(),
            injected: core::mem::take(&mut self.injected),
            landed,
            at_rest,
            readings: core::mem::take(&mut self.readings),
        }
    }

    /// Takes in what the filter has found.
    pub fn inject(&mut self, injection: &Injection) {
        self.injected = true;
        match injection {
            Injection::None => {}
            Injection::Correct(correction) => self.predictor.correct(correction),
            Injection::Start(state) => self.predictor.start(state),
        }
    }
}
