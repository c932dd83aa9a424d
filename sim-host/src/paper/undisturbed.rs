//! Section 4.1 and 4.3: what is flown without a disturbance, on the decoupled model.

use anyhow::Result;

use super::Line;
use super::approach::Approach;
use super::claims::{
    ALTITUDE_AT_REST, ALTITUDE_ERROR, ALTITUDE_ERROR_M, AVERAGE_FOLLOWS, PaperClaim, X_FOLLOWS, Y_FOLLOWS, Z_FOLLOWS,
};
use super::flights::{Flights, Flown};
use crate::decoupled::STEP_S;
use crate::report::Settling;
use crate::report::metrics::errors;

/// The usual band of a settling time: this fraction of the initial error, or of the greatest rate.
const SETTLED: f64 = 0.02;
/// What "follows on average" is measured by.
pub(super) const AVERAGE_FROM: &str = "within 5 cm, mean of x, y, z, from";
/// What "follows" is measured by.
const WITHIN_5_CM: &str = "within 5 cm from";

pub(super) fn lines(flights: &Flights) -> Result<Vec<Line>> {
    let ideal = &flights.ideal;
    let [x, y, z] = ideal.approaches()?;
    let (thrust, uy) = ideal.first_demand()?;
    Ok(vec![
        altitude(ideal, &z),
        altitude_settles(ideal, &z),
        altitude_error(ideal, &z),
        altitude_rate(ideal, &z),
        thrust_demanded(ideal, thrust, &z),
        x_follows(ideal, &x),
        y_follows(ideal, &y),
        attitude(&flights.attitude, uy),
        helix(ideal),
        average(ideal),
    ])
}

fn line(claim: &PaperClaim, flown: &Flown, measure: &str) -> Line {
    Line::new(claim.what, claim.source, flown, measure, "s")
}

fn altitude(ideal: &Flown, z: &Approach) -> Line {
    let why = format!(
        "s falls from {:.1} m/s to 0 at K = {} m/s², until {:.3} s; then e dies as exp(−{:.2} t): 5 cm at {:.3} s by hand. \
         Within 2 % of the initial error from {:.3} s.",
        z.surface(),
        z.gain,
        z.reached_s(),
        z.lambda,
        z.settled_s(0.05),
        ideal.settled_to(2, SETTLED).unwrap_or(f64::NAN),
    );
    line(&Z_FOLLOWS, ideal, WITHIN_5_CM).with(Some(Z_FOLLOWS.time_s), ideal.settled()[2], why)
}

fn altitude_settles(ideal: &Flown, z: &Approach) -> Line {
    let why = format!("from 5 cm to 2 mm exp(−{:.2} t) takes ln 25/λ = {:.3} s", z.lambda, libm::log(25.0) / z.lambda);
    let here = ideal.metrics.axes().z.settle_2mm_s;
    line(&ALTITUDE_ERROR, ideal, "within 2 mm from").with(Some(ALTITUDE_ERROR.time_s), here, why)
}

fn altitude_error(ideal: &Flown, z: &Approach) -> Line {
    let t = ALTITUDE_ERROR.time_s;
    let why = format!(
        "while s > 0, ė > −λ e: whatever K is, {} m cannot shrink below 2 exp(−{:.2} t) = {:.1} mm by then; with K = {} m/s² \
         it is {:.1} mm by hand",
        z.error,
        z.lambda,
        1e3 * z.error * libm::exp(-z.lambda * t),
        z.gain,
        1e3 * z.error_at(t),
    );
    let here = ideal.at(t).map(|row| errors(row)[2].abs());
    Line::new("that error at 0.45 s", ALTITUDE_ERROR.source, ideal, "error of z at 0.45 s", "m").with(
        Some(ALTITUDE_ERROR_M),
        here,
        why,
    )
}

fn altitude_rate(ideal: &Flown, z: &Approach) -> Line {
    let peak = ideal.rates(2).map(|(_, rate)| rate.abs()).fold(0.0, f64::max);
    let mut settling = Settling::new(SETTLED * peak);
    ideal.rates(2).for_each(|(t, rate)| settling.take(t, rate));
    let t = ALTITUDE_AT_REST.time_s;
    let why = format!(
        "on s = 0 the rate is −λ e and dies with the error. At {t} s it is {:.2} m/s, {:.0} % of its peak of {peak:.1} m/s: \
         close to zero at the scale of the phase plot",
        z.rate_at(t).abs(),
        100.0 * z.rate_at(t).abs() / peak,
    );
    line(&ALTITUDE_AT_REST, ideal, "rate below 2 % of its peak from").with(Some(t), settling.since(), why)
}

fn thrust_demanded(ideal: &Flown, first: f64, z: &Approach) -> Line {
    let constants = ideal.scenario.constants();
    let weight = constants.mass * constants.gravity;
    // ż = żd − ė, and the reference climbs at 1 m/s.
    let rate = z.rate_at(z.reached_s());
    let mean = weight + constants.mass * z.lambda * rate + constants.drag.z * (1.0 - rate);
    let here = ideal.rows.iter().map(|row| row.u[0]).reduce(f64::max);
    let why = format!(
        "Eq. 28 has no limit: m (g + λ ėz + K) is {first:.0} N at the start, {:.0} times the weight. On the surface it switches by \
         ± m K = {:.0} N around a mean that begins at m (g + λ ėz) + k3 ż = {} N: rotors do not pull down.",
        first / weight,
        constants.mass * z.gain,
        format!("{mean:.0}").replace('-', "−"),
    );
    Line::new("control input of the altitude, U1", "Section 4.1, Figure 2 d", ideal, "greatest U1", "N")
        .with(None, here, why)
}

fn x_follows(ideal: &Flown, x: &Approach) -> Line {
    let greatest = ideal.rows.iter().map(|row| errors(row)[0].abs()).fold(0.0, f64::max);
    let why = format!(
        "it starts on the reference but {:.0} m/s too slow. s is 0 after {:.0} ms, by when that has made an error of \
         {:.0} mm; within 2 mm from {:.3} s.",
        x.rate,
        1e3 * x.reached_s(),
        1e3 * greatest,
        ideal.metrics.axes().x.settle_2mm_s.unwrap_or(f64::NAN),
    );
    line(&X_FOLLOWS, ideal, WITHIN_5_CM).with(Some(X_FOLLOWS.time_s), ideal.settled()[0], why)
}

fn y_follows(ideal: &Flown, y: &Approach) -> Line {
    let why = format!(
        "5 cm is 1 % of the {:.0} m that y starts away: {:.3} s by hand. Within 2 %, the usual band, from {:.3} s: the \
         paper's number.",
        y.error,
        y.settled_s(0.05),
        ideal.settled_to(1, SETTLED).unwrap_or(f64::NAN),
    );
    line(&Y_FOLLOWS, ideal, WITHIN_5_CM).with(Some(Y_FOLLOWS.time_s), ideal.settled()[1], why)
}

fn attitude(flown: &Flown, uy: f64) -> Line {
    let here = flown.metrics.angles_settled_s().into_iter().try_fold(0.0_f64, |t, axis| Some(t.max(axis?)));
    let why = format!(
        "its references come from Eq. 11, which has no solution here: at the start Eq. 31 asks for Uy = {uy:.2}, and an arc \
         sine takes 1 at most. Flown are stated angles (0.5 sin t, 0.4 cos t, 0.3 cos t/2 rad)."
    );
    let what = "roll, pitch and yaw follow";
    Line::new(what, "Section 4.1, Figure 4", flown, "all within 2° from", "s").with(None, here, why)
}

fn helix(ideal: &Flown) -> Line {
    let gains = &ideal.control().y;
    let swing = f64::from(gains.gain) * STEP_S;
    let why = format!(
        "what is left is chattering: a step of {:.0} µs moves s by K h = {:.1} mm/s, more than the layer is wide, and the \
         middle of that swing leaves at most K h/2λ = {:.2} mm",
        1e6 * STEP_S,
        1e3 * swing,
        1e3 * 0.5 * swing / f64::from(gains.lambda),
    );
    let what = "the 3-D helix is tracked from (0, 0, 0)";
    Line::new(what, "Section 4.3, Figure 7", ideal, "greatest error after 4 s", "m").with(
        None,
        ideal.greatest_error(),
        why,
    )
}

fn average(ideal: &Flown) -> Line {
    let why = format!(
        "mean of x, y and z; the slowest is y, {:.3} s. What the paper averages it does not say.",
        ideal.all_settled().unwrap_or(f64::NAN)
    );
    line(&AVERAGE_FOLLOWS, ideal, AVERAGE_FROM).with(Some(AVERAGE_FOLLOWS.time_s), ideal.mean_settled(), why)
}
