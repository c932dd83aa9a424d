//! Section 4.2: what is flown under Gaussian disturbances, on the decoupled model.

use super::claims::DISTURBANCE_REMOVED;
use super::flights::{Flights, Flown};
use super::{Line, Sweeps};
use crate::decoupled::STEP_S;
use crate::report::metrics::{ANGLE_RECOVERY_BAND, WIDE_BAND};
use crate::sweep::Strength;

pub(super) fn lines(flights: &Flights, sweeps: &Sweeps) -> Vec<Line> {
    let Flights { disturbed, disturbed_output, .. } = flights;
    vec![
        accelerations(disturbed),
        outputs(disturbed_output),
        most_acceleration(disturbed, &sweeps.accelerations),
        most_output(disturbed_output, &sweeps.outputs),
    ]
}

/// The onset's recovery of the slowest coordinate.
fn removed(flown: &Flown, what: &str, why: String) -> Line {
    let onset = flown.scenario.file.disturbance.map_or(0.0, |disturbance| disturbance.from_s);
    let here = flown.metrics.recovery(onset).slowest();
    let measure = "from its onset until within 5 cm, 2° for good";
    let claim = format!("{}, {what}", DISTURBANCE_REMOVED.what);
    Line::new(&claim, DISTURBANCE_REMOVED.source, flown, measure, "s").with(Some(DISTURBANCE_REMOVED.time_s), here, why)
}

/// Greatest errors while the disturbance acts and in the second before, in words.
fn greatest(flown: &Flown) -> String {
    let acting = flown.scenario.file.disturbance.map_or((0.0, 0.0), |d| (d.from_s, d.to_s));
    let text = |(position, angle): (f64, f64)| format!("{:.2} mm and {:.4}°", 1e3 * position, angle.to_degrees());
    let [during, before] = [acting, (acting.0 - 1.0, acting.0)].map(|time| text(flown.greatest_errors_within(time)));
    format!("the greatest errors while it acts are {during}; in the second before they are {before}")
}

fn accelerations(flown: &Flown) -> Line {
    let d = flown.scenario.file.disturbance.unwrap_or_default();
    let control = flown.control();
    let why = format!(
        "the paper gives no strength; σ = {} m/s² and {} rad/s² are far below K = {} m/s² and {} rad/s², so V̇ = s (d − K sgn s) \
         stays negative (Eq. 13–16): nothing leaves its band, {}",
        d.acceleration_m_s2,
        d.angular_acceleration_rad_s2,
        control.z.gain,
        control.yaw.gain,
        greatest(flown),
    );
    removed(flown, "accelerations", why)
}

fn outputs(flown: &Flown) -> Line {
    let d = flown.scenario.file.disturbance.unwrap_or_default();
    let why = format!(
        "the truth stays in its band although the measurement jumps by σ = {:.0} cm and {:.1}°: a sample that is held for \
         {:.0} ms moves s by K·{:.0} ms = {:.2} m/s at most, and 1/(p + λ) smooths that; {}",
        1e2 * d.position_output_m,
        d.angle_output_rad.to_degrees(),
        1e3 * d.hold_s,
        1e3 * d.hold_s,
        f64::from(flown.control().y.gain) * d.hold_s.max(STEP_S),
        greatest(flown),
    );
    removed(flown, "outputs", why)
}

/// The strongest disturbance that was held, and the weakest that was not.
fn limits(flown: &[Strength]) -> (Option<&Strength>, Option<&Strength>) {
    let by_factor = |a: &&Strength, b: &&Strength| a.factor.total_cmp(&b.factor);
    (flown.iter().filter(|s| s.held).max_by(by_factor), flown.iter().filter(|s| !s.held).min_by(by_factor))
}

/// Which band a flight left, in words.
fn left(strength: &Strength) -> &'static str {
    match (strength.position_max_m > WIDE_BAND, strength.angle_max_rad > ANGLE_RECOVERY_BAND) {
        (true, true) => "positions leave 5 cm and angles 2°",
        (true, false) => "a position leaves 5 cm",
        (false, true) => "an angle leaves 2°",
        (false, false) => "one takes longer",
    }
}

fn most_acceleration(flown: &Flown, sweep: &[Strength]) -> Line {
    let (held, failed) = limits(sweep);
    let why = failed.map_or_else(String::new, |failed| {
        format!(
            "at σ = {:.0} m/s² and {:.0} rad/s² {}: σ is then {:.1} times the K of roll, and V̇ < 0 needs |d| < K; x, y and z are \
             still within {:.2} mm",
            failed.acceleration_m_s2,
            failed.angular_acceleration_rad_s2,
            left(failed),
            failed.angular_acceleration_rad_s2 / f64::from(flown.control().roll.gain),
            1e3 * failed.position_max_m,
        )
    });
    let here = held.map(|held| held.angular_acceleration_rad_s2);
    robust(flown, "accelerations", "greatest σ of angular acceleration that is removed so", "rad/s²")
        .with(None, here, why)
}

fn most_output(flown: &Flown, sweep: &[Strength]) -> Line {
    let (held, failed) = limits(sweep);
    let why = failed.map_or_else(String::new, |failed| {
        format!(
            "at σ = {:.1} cm and {:.1}° {}: the truth follows the measurement's error as far as λ and K let it",
            1e2 * failed.position_output_m,
            failed.angle_output_rad.to_degrees(),
            left(failed),
        )
    });
    let here = held.map(|held| held.position_output_m);
    robust(flown, "outputs", "greatest σ of a measured position that is removed so", "m").with(None, here, why)
}

fn robust(flown: &Flown, on: &str, measure: &str, unit: &'static str) -> Line {
    Line::new(&format!("it is robust against disturbance, {on}"), "Section 4.2, 5.1", flown, measure, unit)
}
