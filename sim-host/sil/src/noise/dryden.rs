//! Wind: a steady component, Dryden turbulence in the low-altitude form of MIL-F-8785C, and discrete gusts.
//!
//! ```text
//! along    Hu(s) = σu √(2T) / (1 + T s)                  R(τ) = σu² e^(−τ/T)                  T = Lu/V
//! across   Hv(s) = σv √T (1 + √3 T s) / (1 + T s)²       R(τ) = σv² e^(−τ/T) (1 − τ/2T)       T = Lv/V
//! upwards  Hw(s) as Hv with σw, Lw
//! ```
//!
//! The filters are sampled exactly in covariance: at the ticks, variance and autocorrelation are those of the
//! continuous process at any step, and the first sample is already stationary. Between ticks the wind is held.

use core::f64::consts::FRAC_1_SQRT_2;

use nalgebra::{Matrix3, Vector3};

use super::gaussian::{Source, Stream};
use super::gust;
use crate::world;

const FOOT_M: f64 = 0.3048;
/// Heights between which the low-altitude form holds, ft.
const ALTITUDE_FT: (f64, f64) = (10.0, 1000.0);

/// Standard deviation (m/s) and length scale (m) of a component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intensity {
    /// σ, m/s.
    pub sigma_m_s: f64,
    /// L, m.
    pub length_m: f64,
}

/// Intensities of the components along the wind (equal to those perpendicular to it) and upwards, at `altitude_m` for a wind
/// of `w20_m_s` at 20 ft. Heights beyond 10 ft … 1000 ft count as these.
pub fn low_altitude(altitude_m: f64, w20_m_s: f64) -> [Intensity; 2] {
    let height_ft = (altitude_m / FOOT_M).clamp(ALTITUDE_FT.0, ALTITUDE_FT.1);
    let shape = 0.177 + 0.000_823 * height_ft;
    let upwards = Intensity { sigma_m_s: 0.1 * w20_m_s, length_m: height_ft * FOOT_M };
    let along = Intensity {
        sigma_m_s: upwards.sigma_m_s / libm::pow(shape, 0.4),
        length_m: upwards.length_m / libm::pow(shape, 1.2),
    };
    [along, upwards]
}

/// ∫ sᵏ e^(−2s) ds from 0 to `n`, as a series of positive terms: exact to rounding even where a step is a tiny part of
/// the time constant.
fn moment(k: i32, n: f64) -> f64 {
    let first = libm::pow(n, f64::from(k + 1)) / f64::from(k + 1);
    let (mut term, mut sum, mut divisor) = (first, first, f64::from(k + 1));
    while term > sum * f64::EPSILON {
        divisor += 1.0;
        term *= 2.0 * n / divisor;
        sum += term;
    }
    sum * libm::exp(-2.0 * n)
}

/// Two first-order lags in series, driven by white noise: ż1 = −z1 + w, ż2 = z1 − z2 in units of the time constant.
/// Its output is the first for the component along the wind, and a sum of both for the others.
#[derive(Clone, Debug)]
struct Filter {
    stream: Stream,
    /// z1, z2.
    state: [f64; 2],
    /// Φ over a step: [[a, 0], [n a, a]].
    a: f64,
    na: f64,
    /// The step's covariance in the form of Cholesky: [l11, l21, l22].
    spread: [f64; 3],
    /// The output in z1 and z2, m/s.
    output: [f64; 2],
}

impl Filter {
    /// At a component's intensity, met at `airspeed_m_s`, sampled every `step_s`; starts stationary.
    fn new(mut stream: Stream, intensity: Intensity, unit: [f64; 2], airspeed_m_s: f64, step_s: f64) -> Self {
        let n = step_s * airspeed_m_s / intensity.length_m;
        let a = libm::exp(-n);
        let l11 = moment(0, n).sqrt();
        let l21 = moment(1, n) / l11;
        let l22 = (moment(2, n) - l21 * l21).max(0.0).sqrt();
        // Stationary covariance [[1/2, 1/4], [1/4, 1/4]].
        let (g1, g2) = stream.normal_pair();
        let state = [FRAC_1_SQRT_2 * g1, 0.5 * FRAC_1_SQRT_2 * (g1 + g2)];
        let output = unit.map(|part| part * intensity.sigma_m_s);
        Self { stream, state, a, na: n * a, spread: [l11, l21, l22], output }
    }

    /// First order: Hu.
    fn along(stream: Stream, intensity: Intensity, airspeed_m_s: f64, step_s: f64) -> Self {
        Self::new(stream, intensity, [core::f64::consts::SQRT_2, 0.0], airspeed_m_s, step_s)
    }

    /// Second order: Hv, Hw.
    fn across(stream: Stream, intensity: Intensity, airspeed_m_s: f64, step_s: f64) -> Self {
        let root_3 = 3.0_f64.sqrt();
        Self::new(stream, intensity, [root_3, 1.0 - root_3], airspeed_m_s, step_s)
    }

    /// Returns the present component, m/s, and advances by a step.
    fn sample(&mut self) -> f64 {
        let [z1, z2] = self.state;
        let [l11, l21, l22] = self.spread;
        let (g1, g2) = self.stream.normal_pair();
        self.state = [self.a * z1 + l11 * g1, self.na * z1 + self.a * z2 + l21 * g1 + l22 * g2];
        self.output[0] * z1 + self.output[1] * z2
    }
}

/// The wind of a flight, tick by tick.
#[derive(Clone, Debug)]
pub struct Wind {
    mean: Vector3<f64>,
    /// From (along, across, up) to the world.
    axes: Matrix3<f64>,
    filters: Option<[Filter; 3]>,
    gusts: Vec<world::Gust>,
    /// Number of calls, and the time between two, s.
    asked: u32,
    step_s: f64,
}

impl Wind {
    /// A scenario's wind under a seed, sampled every `step_s`.
    pub fn new(wind: &world::Wind, seed: u64, step_s: f64) -> Self {
        let w20 = wind.turbulence_20ft_m_s;
        let filters = (w20 > 0.0).then(|| {
            let [along, upwards] = low_altitude(wind.altitude_m, w20);
            let airspeed = wind.airspeed_m_s.unwrap_or(w20);
            [
                Filter::along(Stream::new(seed, Source::WindAlong), along, airspeed, step_s),
                Filter::across(Stream::new(seed, Source::WindAcross), along, airspeed, step_s),
                Filter::across(Stream::new(seed, Source::WindVertical), upwards, airspeed, step_s),
            ]
        });
        let mean = Vector3::from(wind.mean_m_s);
        Self { mean, axes: axes(&mean), filters, gusts: wind.gust.clone(), asked: 0, step_s }
    }

    /// The steady part, in the world, m/s.
    pub fn mean(&self) -> Vector3<f64> {
        self.mean
    }

    /// Sets the steady part (m/s, in the world). The turbulence keeps its strength and its random numbers, and turns with
    /// the wind.
    pub fn set_mean(&mut self, mean: Vector3<f64>) {
        self.mean = mean;
        self.axes = axes(&mean);
    }

    /// The wind of this tick in the world, m/s. To be asked for once a tick.
    pub fn sample(&mut self) -> Vector3<f64> {
        let wind = self.blowing();
        if self.gusts.is_empty() {
            return wind;
        }
        let time = f64::from(self.asked) * self.step_s;
        self.asked += 1;
        wind + gust::at(&self.gusts, time)
    }

    /// The steady wind and the turbulence.
    fn blowing(&mut self) -> Vector3<f64> {
        let Some([along, across, up]) = &mut self.filters else { return self.mean };
        self.mean + self.axes * Vector3::new(along.sample(), across.sample(), up.sample())
    }
}

/// Axes: along the horizontal component of the mean wind (x if there is none), horizontally to its left, and up.
fn axes(mean: &Vector3<f64>) -> Matrix3<f64> {
    let along = Vector3::new(mean.x, mean.y, 0.0).try_normalize(0.0).unwrap_or_else(Vector3::x);
    Matrix3::from_columns(&[along, Vector3::z().cross(&along), Vector3::z()])
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP_S: f64 = 1e-3;

    fn wind(seed: u64, mean_m_s: [f64; 3]) -> Wind {
        let turbulence = world::Wind { mean_m_s, turbulence_20ft_m_s: 15.4, ..world::Wind::default() };
        Wind::new(&turbulence, seed, STEP_S)
    }

    #[test]
    fn intensities_are_those_of_the_specification() {
        // By hand at 200 ft: 0.177 + 0.1646 = 0.3416, to the 0.4th 0.6506, to the 1.2th 0.2754.
        let [along, upwards] = low_altitude(60.96, 10.0);
        let near = |value: f64, expected: f64| assert!((value / expected - 1.0).abs() < 1e-3, "{value} {expected}");
        near(upwards.sigma_m_s, 1.0);
        near(upwards.length_m, 60.96);
        near(along.sigma_m_s, 1.0 / 0.6506);
        near(along.length_m, 60.96 / 0.2754);
        // At 1000 ft, the end of its range, it is isotropic.
        let [along, upwards] = low_altitude(304.8, 10.0);
        assert_eq!(along, upwards);
        assert_eq!(low_altitude(1e4, 10.0), low_altitude(304.8, 10.0));
        assert_eq!(low_altitude(0.0, 10.0), low_altitude(3.048, 10.0));
    }

    /// Autocorrelation of a component at a lag of `time` time constants, as a fraction of its variance.
    fn closed_form(component: usize, time: f64) -> f64 {
        libm::exp(-time) * if component == 0 { 1.0 } else { 1.0 - 0.5 * time }
    }

    /// Covariance of the filter with itself `steps` later, from its own matrices: C Φᵏ P Cᵀ.
    fn covariance(filter: &Filter, steps: i32) -> f64 {
        let (p1, p12, p2) = stationary(filter);
        let a = libm::pow(filter.a, f64::from(steps));
        let na = f64::from(steps) * a * filter.na / filter.a;
        let [c1, c2] = filter.output;
        c1 * a * (p1 * c1 + p12 * c2) + c2 * (na * (p1 * c1 + p12 * c2) + a * (p12 * c1 + p2 * c2))
    }

    /// The covariance that a step keeps, P = Φ P Φᵀ + L Lᵀ, solved for its entries.
    fn stationary(filter: &Filter) -> (f64, f64, f64) {
        let ([l11, l21, l22], a, na) = (filter.spread, filter.a, filter.na);
        let left = 1.0 - a * a;
        let p1 = l11 * l11 / left;
        let p12 = (l11 * l21 + a * na * p1) / left;
        let p2 = (l21 * l21 + l22 * l22 + na * na * p1 + 2.0 * a * na * p12) / left;
        (p1, p12, p2)
    }

    #[test]
    fn the_filters_have_the_spectrum_of_the_specification_at_any_step() {
        for step_s in [1e-5, 1e-3, 0.1, 2.0] {
            for component in 0..3 {
                let intensity = Intensity { sigma_m_s: 1.5, length_m: 20.0 };
                let stream = Stream::new(1, Source::WindAlong);
                let make = if component == 0 { Filter::along } else { Filter::across };
                let filter = make(stream, intensity, 8.0, step_s);
                for steps in [0, 1, 10, 100] {
                    let exact = 2.25 * closed_form(component, f64::from(steps) * step_s * 8.0 / 20.0);
                    let ours = covariance(&filter, steps);
                    // Rounding, divided by 1 − a² = 8e-6 at the shortest step, three times over.
                    assert!((ours - exact).abs() < 1e-6, "{component} {step_s} {steps}: {ours} {exact}");
                }
            }
        }
    }

    #[test]
    fn samples_have_the_variance_and_the_autocorrelation_of_the_specification() {
        let [along, upwards] = low_altitude(10.0, 15.4);
        let ticks = 4_000_000_usize;
        let mut wind = wind(3, [0.0; 3]);
        let samples: Vec<Vector3<f64>> = (0..ticks).map(|_| wind.sample()).collect();
        for (component, intensity) in [along, along, upwards].into_iter().enumerate() {
            let constant_s = intensity.length_m / 15.4;
            let variance = intensity.sigma_m_s * intensity.sigma_m_s;
            // Bartlett: the variance of such an estimate is at most 2 ∫R²dτ/duration both ways, and ∫R² both ways is no
            // more than σ⁴ T. So 4.5 standard errors are:
            let bound = 4.5 * variance * (2.0 * constant_s / (ticks as f64 * STEP_S)).sqrt();
            for time in [0.0, 0.5, 1.0, 2.0, 4.0] {
                let lag = (time * constant_s / STEP_S).round() as usize;
                let products = samples.iter().zip(&samples[lag..]).map(|(a, b)| a[component] * b[component]);
                let estimate = products.sum::<f64>() / (ticks - lag) as f64;
                let exact = variance * closed_form(component, lag as f64 * STEP_S / constant_s);
                assert!((estimate - exact).abs() < bound, "{component} at {time}: {estimate} {exact} ± {bound}");
            }
        }
    }

    #[test]
    fn components_do_not_depend_on_each_other() {
        let [along, upwards] = low_altitude(10.0, 15.4);
        let ticks = 2_000_000;
        let mut wind = wind(4, [0.0; 3]);
        let products = (0..ticks).fold(Vector3::zeros(), |sum: Vector3<f64>, _| {
            let w = wind.sample();
            sum + Vector3::new(w.x * w.y, w.y * w.z, w.z * w.x) / f64::from(ticks)
        });
        for (product, (a, b)) in products.iter().zip([(along, along), (along, upwards), (upwards, along)]) {
            // Bartlett again: ∫Ra Rb dτ both ways is at most σa² σb² √(Ta Tb).
            let constant_s = (a.length_m * b.length_m).sqrt() / 15.4;
            let bound = 4.5 * a.sigma_m_s * b.sigma_m_s * (constant_s / (f64::from(ticks) * STEP_S)).sqrt();
            assert!(product.abs() < bound, "{products} ± {bound}");
        }
    }

    #[test]
    fn a_stronger_wind_has_the_same_gusts() {
        let at = |w20: f64| {
            let airspeed_m_s = Some(10.0);
            let wind = world::Wind { turbulence_20ft_m_s: w20, airspeed_m_s, ..world::Wind::default() };
            Wind::new(&wind, 6, STEP_S)
        };
        let (mut weak, mut strong) = (at(4.0), at(8.0));
        assert!((0..1000).all(|_| (strong.sample() - 2.0 * weak.sample()).norm() < 1e-12));
    }

    #[test]
    fn the_first_sample_is_as_strong_as_any() {
        let [along, upwards] = low_altitude(10.0, 15.4);
        let seeds = 20_000_u64;
        let square = (0..seeds).fold(Vector3::zeros(), |sum: Vector3<f64>, seed| {
            let first = wind(seed, [0.0; 3]).sample();
            sum + first.component_mul(&first) / seeds as f64
        });
        for (component, intensity) in [along, along, upwards].into_iter().enumerate() {
            let variance = intensity.sigma_m_s * intensity.sigma_m_s;
            // A variance from n numbers is known to √(2/n): 4.5 of these.
            let bound = 4.5 * variance * (2.0 / seeds as f64).sqrt();
            assert!((square[component] - variance).abs() < bound, "{component}: {square} {variance}");
        }
    }

    #[test]
    fn along_is_along_the_mean_wind() {
        let (mut still, mut blowing) = (wind(5, [0.0; 3]), wind(5, [0.0, 6.0, 0.0]));
        for _ in 0..100 {
            let (a, b) = (still.sample(), blowing.sample());
            // Turned by a quarter: x becomes y, y becomes −x.
            assert!((b - Vector3::new(-a.y, 6.0 + a.x, a.z)).norm() < 1e-12, "{a} {b}");
        }
    }

    #[test]
    fn without_turbulence_the_wind_is_steady() {
        let steady = world::Wind { mean_m_s: [1.0, -2.0, 0.5], ..world::Wind::default() };
        let mut wind = Wind::new(&steady, 1, STEP_S);
        assert!((0..100).all(|_| wind.sample() == Vector3::new(1.0, -2.0, 0.5)));
    }

    #[test]
    fn another_steady_part_leaves_the_random_numbers_alone() {
        let (mut unchanged, mut changed) = (wind(7, [2.0, 0.0, 0.0]), wind(7, [2.0, 0.0, 0.0]));
        for _ in 0..100 {
            assert_eq!(unchanged.sample(), changed.sample());
        }
        changed.set_mean(Vector3::new(5.0, 0.0, 0.5));
        for _ in 0..100 {
            let turbulence = unchanged.sample() - unchanged.mean();
            assert!((changed.sample() - changed.mean() - turbulence).norm() < 1e-12);
        }
    }

    #[test]
    fn a_seed_means_the_same_wind_on_every_platform() {
        // Recorded once, on x86-64 Linux; a change here changes every flight in wind.
        let mut wind = wind(1, [0.0; 3]);
        let sum = (0..100_000)
            .fold(0_u64, |sum, _| wind.sample().iter().fold(sum, |sum, v| sum.rotate_left(5) ^ v.to_bits()));
        assert_eq!(sum, 13_954_862_459_057_009_759);
    }
}
