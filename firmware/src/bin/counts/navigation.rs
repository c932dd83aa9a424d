//! The estimator, in the components that are counted.

use core::hint::black_box;

use firmware::airframe::ROTORS;
use firmware::board::mps2::counter::{self, Counter, Mark};
use firmware::config::FlightConfig;
use firmware::control::gyro::GyroFilter;
use firmware::estimator::covariance::{Covariance, ErrorState, Motion, Row, StepNoise, index};
use firmware::estimator::models::NONE;
use firmware::estimator::predictor::Span;
use firmware::estimator::update::{Measurement, gate};
use firmware::estimator::{EstimatorSettings, Filter, FilterInput, FilterOutput, Injection, Predictor, Readings};
use firmware::math;
use firmware::sensors::Measurements;
use firmware::settings::Changes;
use firmware::signals::{NavState, TICK_S, Tick};
use nalgebra::Vector3;

use crate::tally::Tally;

/// Instruction counts of the estimator.
#[derive(Clone, Copy, Default)]
pub(crate) struct NavigationCounts {
    pub(crate) prediction: Tally,
    pub(crate) gyro_filter: Tally,
    pub(crate) covariance: Tally,
    pub(crate) correction_1: Tally,
    pub(crate) correction_3: Tally,
    pub(crate) job: Tally,
    pub(crate) job_with_gnss: Tally,
}

/// Predictor, filter, and the filter's components once more on their own.
pub(crate) struct Navigation {
    counter: Counter,
    pub(crate) counts: NavigationCounts,
    predictor: Predictor,
    gyro: GyroFilter,
    filter: Filter,
    /// A second covariance, predicted and corrected like the filter's own.
    covariance: Covariance,
    readings: Readings,
    /// The output of the last job, until it is published.
    found: Option<Injection>,
    injected: bool,
    aligned: bool,
}

impl Navigation {
    pub(crate) fn new(counter: Counter, config: &FlightConfig, start: &NavState) -> Self {
        let airframe = &config.airframe;
        let [drag, _, _] = airframe.drag_n_s_m;
        let settings = EstimatorSettings::default();
        Self {
            counter,
            counts: NavigationCounts::default(),
            predictor: Predictor::new(start.position, airframe.gravity_m_s2),
            gyro: GyroFilter::new(),
            filter: Filter::new(&settings, airframe.gravity_m_s2, drag / airframe.mass_kg, start.position),
            covariance: Covariance::diagonal(&ErrorState::repeat(0.01)),
            readings: Readings::default(),
            found: None,
            injected: false,
            aligned: false,
        }
    }

    /// One tick of the inner half.
    #[inline(never)]
    pub(crate) fn step(&mut self, measured: &Measurements, omega_rad_s: &[f32; ROTORS]) {
        let (predictor, imu) = black_box((&mut self.predictor, measured.imu.as_ref()));
        let (instructions, _) =
            self.counter.count(counter::mark_begin_prediction, || black_box(predictor.predict(imu)));
        self.counts.prediction.add(instructions);

        let raw = self.predictor.rates() + self.predictor.state().gyro_bias;
        let (gyro, raw, omega) = black_box((&mut self.gyro, &raw, omega_rad_s));
        let (instructions, _) =
            self.counter.count(counter::mark_begin_gyro_filter, || black_box(gyro.filter(raw, omega)));
        self.counts.gyro_filter.add(instructions);

        self.readings.keep(measured);
    }

    /// The filter's job.
    #[inline(never)]
    pub(crate) fn job(&mut self, tick: Tick, at_rest: bool) {
        let input = FilterInput {
            state: *self.predictor.state(),
            rates: *self.predictor.rates(),
            force: *self.predictor.specific_force(),
            span: self.predictor.take_span(),
            injected: core::mem::take(&mut self.injected),
            landed: at_rest,
            at_rest,
            readings: core::mem::take(&mut self.readings),
            changes: Changes::new(),
        };
        let output = self.count_job(tick, &input);
        if self.aligned {
            self.count_parts(&input);
        }
        self.aligned |= matches!(output.injection, Injection::Start(_));
        self.found = Some(output.injection);
    }

    fn count_job(&mut self, tick: Tick, input: &FilterInput) -> FilterOutput {
        let (begin, tally) = if input.readings.gnss.is_some() {
            (counter::mark_begin_filter_gnss as Mark, &mut self.counts.job_with_gnss)
        } else {
            (counter::mark_begin_filter as Mark, &mut self.counts.job)
        };
        let (filter, input) = black_box((&mut self.filter, input));
        let (instructions, output) = self.counter.count(begin, || black_box(filter.step(tick, input)));
        if self.aligned {
            tally.add(instructions);
        }
        output
    }

    /// Prediction of the covariance, and corrections when readings arrive.
    fn count_parts(&mut self, input: &FilterInput) {
        let motion = motion(&input.state.attitude.to_rotation_matrix().into_inner(), &input.span);
        let (covariance, motion, noise) = black_box((&mut self.covariance, &motion, &NOISE));
        let (instructions, ()) =
            self.counter.count(counter::mark_begin_covariance, || covariance.predict(motion, noise));
        self.counts.covariance.add(instructions);
        if let Some(gnss) = &input.readings.gnss {
            let change = gnss.velocity;
            let measurement = Measurement {
                rows: [0, 1, 2].map(|axis| velocity_row(axis, &change)),
                innovation: [0.02, -0.01, 0.03],
                variance: [2.5e-3; 3],
            };
            let instructions = self.correct(counter::mark_begin_correction_3, &measurement);
            self.counts.correction_3.add(instructions);
        }
        if input.readings.baro.is_some() {
            let entries = [(index::POSITION + 2, 1.0), (index::VELOCITY + 2, -0.02), (index::HEIGHT_OFFSET, 1.0)];
            let row = Row { theta: Vector3::new(1e-3, 2e-3, 0.0), entries };
            let measurement = Measurement { rows: [row], innovation: [0.05], variance: [6.4e-3] };
            let instructions = self.correct(counter::mark_begin_correction_1, &measurement);
            self.counts.correction_1.add(instructions);
        }
    }

    fn correct<const N: usize>(&mut self, begin: Mark, measurement: &Measurement<N>) -> u32 {
        let mut error = ErrorState::zeros();
        let (covariance, measurement, error) = black_box((&mut self.covariance, measurement, &mut error));
        let (instructions, verdict) =
            self.counter.count(begin, || black_box(measurement.apply(covariance, error, gate::<N>())));
        // A refused measurement would have been counted with fewer instructions.
        assert!(verdict.accepted, "within the gate");
        instructions
    }

    /// Injects the filter's last output into the predictor.
    pub(crate) fn publish(&mut self) {
        match self.found.take() {
            Some(Injection::Correct(correction)) => self.predictor.correct(&correction),
            Some(Injection::Start(state)) => self.predictor.start(&state),
            Some(Injection::None) | None => {}
        }
        self.injected = true;
    }

    /// Error of the position estimate, m.
    pub(crate) fn error_m(&self, nav: &NavState) -> f32 {
        math::sqrt((self.predictor.state().position - nav.position).norm_squared())
    }
}

/// As in the default settings.
const NOISE: StepNoise = StepNoise {
    theta: Vector3::new(1e-9, 1e-9, 1e-9),
    velocity: 1e-8,
    gyro_bias: 4e-13,
    accel_bias: 4e-11,
    offset: Vector3::new(6.4e-6, 6.4e-6, 2.6e-7),
    magnetic_wind: Vector3::new(3.6e-12, 2e-3, 2e-3),
};

fn motion(rotation: &nalgebra::Matrix3<f32>, span: &Span) -> Motion {
    Motion { step_s: span.ticks as f32 * TICK_S, rotation: *rotation, velocity_change: span.velocity_change }
}

/// The row of a late velocity, for a change of velocity since.
fn velocity_row(axis: usize, change: &Vector3<f32>) -> Row {
    let theta = [Vector3::x(), Vector3::y(), Vector3::z()].get(axis).copied().unwrap_or_default().cross(change);
    Row { theta, entries: [(index::VELOCITY + axis, 1.0), NONE, NONE] }
}
