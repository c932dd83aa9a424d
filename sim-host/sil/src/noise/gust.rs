//! Discrete gusts after MIL-F-8785C, 3.7.1.3. They are deterministic, in addition to the turbulence.
//!
//! ```text
//! rising   v = vm/2 (1 − cos π t/T)          holding   v = vm          falling   as it rose
//! ```
//!
//! The gust of the specification never falls: set a hold that lasts to the end of the flight.

use nalgebra::Vector3;

use crate::world::Gust;

/// Fraction of a gust's peak at a time, s.
fn part(gust: &Gust, time: f64) -> f64 {
    let into = time - gust.from_s;
    let left = 2.0 * gust.rise_s + gust.hold_s - into;
    // Both flanks have the same shape, measured from their ends.
    let flank = into.min(left) / gust.rise_s;
    if flank <= 0.0 { 0.0 } else { 0.5 * (1.0 - libm::cos(core::f64::consts::PI * flank.min(1.0))) }
}

/// The sum of gusts at a time (s), in the world, m/s.
pub fn at(gusts: &[Gust], time: f64) -> Vector3<f64> {
    gusts.iter().fold(Vector3::zeros(), |sum, gust| sum + Vector3::from(gust.peak_m_s) * part(gust, time))
}

#[cfg(test)]
mod tests {
    use super::*;

    const GUST: Gust = Gust { from_s: 2.0, rise_s: 0.5, hold_s: 1.0, peak_m_s: [4.0, 0.0, -2.0] };

    #[test]
    fn it_rises_holds_and_falls() {
        let peak = Vector3::from(GUST.peak_m_s);
        for (time, part) in [
            (1.9, 0.0),
            (2.0, 0.0),
            (2.25, 0.5),
            (2.125, 0.5 - 0.25 * core::f64::consts::SQRT_2),
            (2.5, 1.0),
            (3.4, 1.0),
            (3.75, 0.5),
            (4.0, 0.0),
            (9.0, 0.0),
        ] {
            assert!((at(&[GUST], time) - peak * part).norm() < 1e-12, "{time}");
        }
    }

    #[test]
    fn it_carries_the_air_by_its_closed_form() {
        // Each flank is half of what holding would be: vm (T + hold). The trapezoidal rule over whole waves is exact.
        let step = 1e-3;
        let carried = (0..5_000).fold(Vector3::zeros(), |sum, k| sum + at(&[GUST], f64::from(k) * step) * step);
        assert!((carried - Vector3::from(GUST.peak_m_s) * 1.5).norm() < 1e-9, "{carried}");
    }

    #[test]
    fn gusts_add_up() {
        let other = Gust { from_s: 2.2, hold_s: 1e6, ..GUST };
        for time in [2.1, 2.3, 3.9, 100.0] {
            assert_eq!(at(&[GUST, other], time), at(&[GUST], time) + at(&[other], time));
        }
        assert_eq!(at(&[other], 1e4), Vector3::from(GUST.peak_m_s), "the specification's own, which stays");
    }
}
