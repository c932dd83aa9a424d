//! Navigation in the inner partition: the estimator's predictor, the gyroscope filter ahead of the controller, and the
//! readings that wait for the estimator's next filter job.

use nalgebra::Vector3;

use crate::airframe::ROTORS;
use crate::config::FlightConfig;
use crate::control::gyro::GyroFilter;
use crate::estimator::{EstimatorSettings, FilterInput, Injection, Nominal, Predictor, Readings, Vibration};
use crate::math;
use crate::sensors::{BatterySample, ImuSample, Measurements};
use crate::settings::Changes;
use crate::signals::NavState;

/// The inner half of navigation.
#[derive(Clone, Debug)]
pub struct Navigator {
    predictor: Predictor,
    gyro: GyroFilter,
    /// Filtered Ω including its bias, rad/s.
    filtered: Vector3<f32>,
    readings: Readings,
    /// The last readings of all that the filter has been given, for telemetry.
    latest: Readings,
    vibration: Vibration,
    battery: Option<BatterySample>,
    /// Ticks since that sample, saturating.
    battery_age: u16,
    /// Whether the last job's injection has been applied.
    injected: bool,
}

impl Navigator {
    /// At rest at the start position; `None` for a flight on ideal state.
    pub fn new(config: &FlightConfig) -> Option<Self> {
        config.estimator.as_ref().map(|_: &EstimatorSettings| Self {
            predictor: Predictor::new(config.start_position(), config.airframe.gravity_m_s2),
            gyro: GyroFilter::new(),
            filtered: Vector3::zeros(),
            readings: Readings::default(),
            latest: Readings::default(),
            vibration: Vibration::default(),
            battery: None,
            battery_age: 0,
            injected: false,
        })
    }

    /// One tick with its measurements, if any. Returns whether an IMU sample was used. `omega_rad_s` are the estimated
    /// rotor speeds.
    #[inline]
    pub fn step(&mut self, measured: Option<&Measurements>, omega_rad_s: &[f32; ROTORS]) -> bool {
        let fresh = self.predictor.predict(measured.and_then(|m| m.imu.as_ref()));
        let raw = self.predictor.rates() + self.predictor.state().gyro_bias;
        self.filtered = self.gyro.filter(&raw, omega_rad_s);
        self.battery_age = self.battery_age.saturating_add(1);
        if let Some(measured) = measured {
            self.keep(measured);
            if fresh && let Some(imu) = &measured.imu {
                self.vibration.note(&imu.accel);
            }
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

    /// The motion now, with filtered rates.
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

    /// The predictor's nominal state: motion and biases.
    pub fn state(&self) -> &Nominal {
        self.predictor.state()
    }

    /// f without its bias in the body frame, m/s².
    #[inline]
    pub fn specific_force(&self) -> &Vector3<f32> {
        self.predictor.specific_force()
    }

    /// The last battery sample, unless it is too old.
    pub fn battery(&self) -> Option<BatterySample> {
        /// Greatest age, ticks: ten periods of a 10 Hz monitor.
        const SILENT_AFTER: u16 = 1_000;
        self.battery.filter(|_| self.battery_age < SILENT_AFTER)
    }

    /// The last battery sample and its age in ticks.
    pub fn battery_with_age(&self) -> Option<(BatterySample, u32)> {
        self.battery.map(|battery| (battery, u32::from(self.battery_age)))
    }

    /// The last reading of each sensor that the filter has been given.
    pub fn latest(&self) -> &Readings {
        &self.latest
    }

    /// The last IMU sample that was used, without corrections.
    pub fn imu(&self) -> Option<ImuSample> {
        self.predictor.last_sample()
    }

    /// How strongly the accelerometer is shaken.
    pub fn vibration(&self) -> &Vibration {
        &self.vibration
    }

    /// The snapshot for a filter job. `landed`: on the ground; `at_rest`: on the ground and disarmed; `changes`: settings
    /// to take over.
    pub fn release(&mut self, landed: bool, at_rest: bool, changes: Changes) -> FilterInput {
        let readings = core::mem::take(&mut self.readings);
        self.latest.update(&readings);
        self.vibration.average();
        FilterInput {
            state: *self.predictor.state(),
            rates: *self.predictor.rates(),
            force: *self.predictor.specific_force(),
            span: self.predictor.take_span(),
            injected: core::mem::take(&mut self.injected),
            landed,
            at_rest,
            readings,
            changes,
        }
    }

    /// Applies the output of a filter job.
    pub fn inject(&mut self, injection: &Injection) {
        self.injected = true;
        match injection {
            Injection::None => {}
            Injection::Correct(correction) => self.predictor.correct(correction),
            Injection::Start(state) => self.predictor.start(state),
        }
    }
}
