//! The same claims where the vehicle has to tilt to move: Eq. 2 as it stands, and the rigid body.

use super::Line;
use super::claims::{ALTITUDE_ERROR, ALTITUDE_ERROR_M, AVERAGE_FOLLOWS};
use super::flights::{Flights, Flown};

pub(super) fn lines(flights: &Flights) -> Vec<Line> {
    let Flights { literal, literal_strong, literal_slow, helix, .. } = flights;
    vec![
        settled(literal, time_scales(literal)),
        error(literal, limit_cycle(literal)),
        error(literal_strong, not_the_limits(literal_strong)),
        settled(literal_slow, slow(literal_slow, literal)),
        settled(helix, bound(helix)),
        error(helix, own_gains()),
    ]
}

fn settled(flown: &Flown, why: String) -> Line {
    let claim = "the same on the coupled vehicle: all follow within 0.5 s";
    Line::new(claim, AVERAGE_FOLLOWS.source, flown, "x, y and z all within 5 cm from", "s").with(
        Some(AVERAGE_FOLLOWS.time_s),
        flown.all_settled(),
        why,
    )
}

fn error(flown: &Flown, why: String) -> Line {
    let claim = "the same on the coupled vehicle: error “nearly 0.002”";
    Line::new(claim, ALTITUDE_ERROR.source, flown, "greatest error of x, y, z after 4 s", "m").with(
        Some(ALTITUDE_ERROR_M),
        flown.greatest_error(),
        why,
    )
}

/// What the rotors can accelerate the vehicle by, m/s².
fn authority(flown: &Flown) -> f64 {
    let airframe = &flown.scenario.airframe;
    airframe.thrust_to_weight * airframe.gravity_m_s2
}

fn time_scales(flown: &Flown) -> String {
    let control = flown.control();
    format!(
        "Ux and Uy act through roll and pitch (Eq. 11), whose error dies as exp(−{} t): too slow for x and y, which ask for \
         exp(−{} t) and switch between ±{} m/s² where the rotors give {:.1} m/s²",
        control.roll.lambda,
        control.x.lambda,
        control.x.gain,
        authority(flown),
    )
}

fn limit_cycle(flown: &Flown) -> String {
    let saturated = f64::from(flown.outcome.saturated_ticks) / f64::from(flown.outcome.ticks.max(1));
    format!(
        "a limit cycle: the tilt asked for jumps from limit to limit, and a rotor is at a limit {:.0} % of the time. Sampled \
         at 1 kHz the layer of 0.00099 is not felt either: K h is {:.2} rad/s",
        100.0 * saturated,
        1e-3 * f64::from(flown.control().roll.gain),
    )
}

fn not_the_limits(flown: &Flown) -> String {
    format!(
        "the rotors' limits are not the cause: with thrust for {:.0} times the weight, what the ideal case takes, the gains \
         do not fly either",
        flown.scenario.airframe.thrust_to_weight
    )
}

fn slow(flown: &Flown, literal: &Flown) -> String {
    let (now, was) = (&flown.control().x, literal.control());
    format!(
        "λ = {} 1/s and K = {} m/s² on x, y and z, sgn by backward Euler, the rest as in Table 1: a λ of a sixth of the \
         attitude's {} 1/s keeps the two loops apart, and the same model flies",
        now.lambda, now.gain, was.roll.lambda,
    )
}

fn bound(flown: &Flown) -> String {
    let bound = flown.scenario.file.time_optimal_s.unwrap_or(f64::NAN);
    format!(
        "with thrust for {} times the weight nothing joins the helix exactly before {bound} s (optimal control); within 5 cm \
         is a little less than exactly",
        flown.scenario.airframe.thrust_to_weight
    )
}

fn own_gains() -> String {
    "gains of our own: separate time scales, sgn by backward Euler, which does not chatter, and attitude rates from the \
     reference's jerk and snap"
        .into()
}
