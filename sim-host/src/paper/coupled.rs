//! The same claims where the vehicle has to tilt to move: Eq. 2 as it stands, and the rigid body.

use firmware::control::sliding::{AxisGains, ReachingLaw};

use super::Line;
use super::claims::{ALTITUDE_ERROR, ALTITUDE_ERROR_M, AVERAGE_FOLLOWS};
use super::flights::{Flights, Flown};
use super::undisturbed::AVERAGE_FROM;

pub(super) fn lines(flights: &Flights) -> Vec<Line> {
    let Flights { literal, literal_strong, literal_thin, literal_slow, literal_wide, helix, .. } = flights;
    vec![
        settled(literal, relay(literal)),
        error(literal, height_first(literal)),
        error(literal_strong, not_the_limits(literal_strong)),
        error(literal_thin, thin(literal_thin)),
        settled(literal_slow, slow(literal_slow)),
        error(literal_slow, thin_attitude(literal_slow)),
        error(literal_wide, wide_attitude(literal_wide)),
        settled(helix, bound(helix)),
        error(helix, own_gains()),
    ]
}

/// What flies, in words.
fn vehicle(flown: &Flown) -> String {
    match flown.name.strip_prefix("paper-literal") {
        Some(set) => format!("coupled vehicle{set}"),
        None => "rigid body, gains of our own".into(),
    }
}

fn settled(flown: &Flown, why: String) -> Line {
    let claim = format!("{}: {}", vehicle(flown), AVERAGE_FOLLOWS.what);
    Line::new(&claim, AVERAGE_FOLLOWS.source, flown, AVERAGE_FROM, "s").with(
        Some(AVERAGE_FOLLOWS.time_s),
        flown.mean_settled(),
        why,
    )
}

fn error(flown: &Flown, why: String) -> Line {
    let claim = format!("{}: error “nearly 0.002”", vehicle(flown));
    Line::new(&claim, ALTITUDE_ERROR.source, flown, "greatest error of x, y, z after 4 s", "m").with(
        Some(ALTITUDE_ERROR_M),
        flown.greatest_error(),
        why,
    )
}

/// K/ρ: how fast s dies in the layer, 1/s.
fn layer_rate(gains: &AxisGains) -> f64 {
    match gains.reaching {
        ReachingLaw::Sat { rho } => f64::from(gains.gain) / f64::from(rho),
        _ => f64::INFINITY,
    }
}

fn relay(flown: &Flown) -> String {
    let control = flown.control();
    format!(
        "Ux and Uy act through roll and pitch (Eq. 11), whose errors die as exp(−{} t). In a layer of {:.5} m/s the laws of x and \
         y ask s to die as exp(−K t/ρ), K/ρ = {:.0} 1/s: through the attitude that is a switch that acts too late",
        control.roll.lambda,
        f64::from(control.x.gain) / layer_rate(&control.x),
        layer_rate(&control.x),
    )
}

fn height_first(flown: &Flown) -> String {
    let airframe = &flown.scenario.airframe;
    let level = flown.rows.iter().filter(|row| row.desired_attitude[..2] == [0.0, 0.0]).count();
    format!(
        "z asks for ±{} m/s², where rotors for {} times the weight give {:.1} m/s²: {:.0} % of the time height is all \
         that is asked for, and no tilt; else hardly any thrust is asked for at all",
        flown.control().z.gain,
        airframe.thrust_to_weight,
        airframe.thrust_to_weight * airframe.gravity_m_s2,
        100.0 * level as f64 / flown.rows.len() as f64,
    )
}

fn not_the_limits(flown: &Flown) -> String {
    let tilt = flown.metrics.tilt();
    let degrees = |angle: Option<f64>| angle.unwrap_or(f64::NAN).to_degrees();
    format!(
        "thrust is not the cause alone: with as much as the ideal case takes, the tilt asked for jumps so that roll and pitch \
         are {:.0}° and {:.0}° off (RMS)",
        degrees(tilt.roll_rms_rad),
        degrees(tilt.pitch_rms_rad),
    )
}

fn thin(flown: &Flown) -> String {
    let gains = &flown.control().x;
    format!(
        "with λ = {} 1/s and K = {} m/s² on x, y and z but the layer of Table 1, K/ρ is still {:.0} 1/s: the attitude asked for \
         jumps so that its feedforward demands up to {:.0e} N m, of which the rotors give what they can",
        gains.lambda,
        gains.gain,
        layer_rate(gains),
        flown.greatest_torque_n_m(),
    )
}

fn slow(flown: &Flown) -> String {
    let (gains, roll) = (&flown.control().x, &flown.control().roll);
    format!(
        "the same λ = {} 1/s and K = {} m/s² in a layer of {:.0} m/s: with K/ρ = {:.0} 1/s both are slower than the attitude's {} 1/s \
         (Table 1), and the same model flies",
        gains.lambda,
        gains.gain,
        f64::from(gains.gain) / layer_rate(gains),
        layer_rate(gains),
        roll.lambda,
    )
}

/// Total variation of the commanded ω², in (rad/s)²/s.
fn variation(flown: &Flown) -> f64 {
    flown.metrics.chattering_after_4s().unwrap_or(f64::NAN)
}

fn thin_attitude(flown: &Flown) -> String {
    let roll = &flown.control().roll;
    format!(
        "the attitude's layer is still {:.5} rad/s, and a sample of 1 ms moves s by K h = {:.2} rad/s: its laws switch the rotors \
         between their limits, with a total variation of ω² of {:.1e} (rad/s)²/s",
        f64::from(roll.gain) / layer_rate(roll),
        f64::from(roll.gain) * 1e-3,
        variation(flown),
    )
}

fn wide_attitude(flown: &Flown) -> String {
    let roll = &flown.control().roll;
    format!(
        "the same with {} rad/s for roll, pitch and yaw, wider than K h: they no longer switch, and the total variation is {:.1e} \
         (rad/s)²/s",
        f64::from(roll.gain) / layer_rate(roll),
        variation(flown),
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
