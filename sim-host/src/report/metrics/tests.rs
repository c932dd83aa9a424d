//! The figures against closed forms.

use std::f64::consts::{PI, SQRT_2, TAU};

use super::*;
use crate::plant::ground::Ground;

const TICK: f64 = 0.001;

/// A row that hovers on its reference.
fn hover(t: f64) -> Row {
    Row { t, attitude: [1.0, 0.0, 0.0, 0.0], ..Row::default() }
}

/// Metrics of a flight of `seconds` whose row at t is `row(t)`.
fn fly(seconds: f64, row: impl Fn(f64) -> Row) -> Metrics {
    let mut metrics = Metrics::new();
    for k in 0..(seconds / TICK).round() as u32 {
        metrics.record(&row(f64::from(k) / 1000.0));
    }
    metrics
}

/// Metrics of a flight whose error in x is `error(t)`.
fn fly_x(seconds: f64, error: impl Fn(f64) -> f64) -> AxisFigures {
    fly(seconds, |t| Row { position: [-error(t), 0.0, 0.0], ..hover(t) }).axes().x
}

fn assert_near(value: Option<f64>, expected: f64, tolerance: f64) {
    let value = value.expect("defined");
    assert!((value - expected).abs() <= tolerance, "{value} is not {expected} ± {tolerance}");
}

#[test]
fn exponential_settles_at_tau_ln_of_the_ratio() {
    let (e0, tau) = (5.0, 0.3);
    let x = fly_x(6.0, |t| e0 * (-t / tau).exp());
    // The first row inside comes at most a tick after the crossing.
    assert_near(x.settle_5cm_s, tau * f64::ln(e0 / 0.05) + TICK / 2.0, TICK / 2.0);
    assert_near(x.settle_2mm_s, tau * f64::ln(e0 / 0.002) + TICK / 2.0, TICK / 2.0);
    assert_eq!(x.overshoot, Some(0.0));
}

#[test]
fn settling_means_until_the_end() {
    assert_eq!(fly_x(1.0, |_| 0.0).settle_2mm_s, Some(0.0));
    assert_eq!(fly_x(1.0, |_| 0.05).settle_5cm_s, None, "the band is open");
    assert_eq!(fly_x(1.0, |t| if t == 0.6 { 0.1 } else { 0.0 }).settle_5cm_s, Some(0.601));
    assert_eq!(fly_x(1.0, |t| if t > 0.998 { 0.1 } else { 0.0 }).settle_5cm_s, None);
    assert_eq!(fly_x(1.0, |t| if t == 0.2 { f64::NAN } else { 0.0 }).settle_5cm_s, Some(0.201));
}

#[test]
fn sine_has_rms_of_amplitude_over_root_two() {
    let amplitude = 0.003;
    let x = fly_x(8.0, |t| if t < 4.0 { 1.0 } else { amplitude * (TAU * t).sin() });
    // Four whole periods, evenly sampled: exact but for rounding.
    assert_near(x.rms_m, amplitude / SQRT_2, 1e-15);
    assert_near(x.max_m, amplitude, 1e-15);
    assert_eq!(x.settle_5cm_s, Some(4.0));
}

#[test]
fn nothing_is_said_about_tracking_before_4_s() {
    let x = fly_x(3.9, |_| 1.0);
    assert_eq!((x.rms_m, x.max_m), (None, None));
}

#[test]
fn second_order_response_overshoots_as_its_damping_says() {
    for (e0, zeta) in [(5.0, 0.5), (-2.0, 0.2)] {
        let (natural, damped) = (8.0, 8.0 * f64::sqrt(1.0 - zeta * zeta));
        let response = |t: f64| {
            e0 * (-zeta * natural * t).exp() * ((damped * t).cos() + zeta * natural / damped * (damped * t).sin())
        };
        let expected = (-PI * zeta / f64::sqrt(1.0 - zeta * zeta)).exp();
        // The peak lies at most half a tick from a row, where the curvature ωn² takes off (ωn·h/2)²/2 = 8e-6.
        assert_near(fly_x(5.0, response).overshoot, expected, 1e-5);
    }
}

#[test]
fn overshoot_needs_something_to_overshoot() {
    assert_eq!(fly_x(1.0, |t| 0.049 - t).overshoot, None);
    assert_near(fly_x(1.001, |t| 0.05 - t).overshoot, 19.0, 1e-12);
}

#[test]
fn overshoot_counts_from_the_last_jump_of_the_reference() {
    // A step to 5 m at 1 s, reached at once and passed by 0.5 m after another second.
    let position = |t: f64| if t < 1.5 { 0.0 } else { 5.5 };
    let reference = |t: f64| if t < 1.0 { 0.0 } else { 5.0 };
    let row = |t| Row { position: [position(t), 0.0, 0.0], reference: [reference(t), 0.0, 0.0, 0.0], ..hover(t) };
    let metrics = fly(3.0, row);
    assert_eq!(metrics.jumped_s(), Some(1.0));
    assert!(!metrics.began_away());
    assert_near(metrics.axes().x.overshoot, 0.1, 1e-12);
    assert_eq!(metrics.axes().y.overshoot, None);
    assert!(fly(0.1, |t| Row { reference: [0.0, 0.05, 0.0, 0.0], ..hover(t) }).began_away());
    // As fast as anything here flies: 40 m/s.
    assert_eq!(fly(1.0, |t| Row { reference: [40.0 * t, 0.0, 0.0, 0.0], ..hover(t) }).jumped_s(), None);
}

#[test]
fn yaw_error_takes_the_short_way_round() {
    let yaw = 3.1_f64;
    let attitude = [(yaw / 2.0).cos(), 0.0, 0.0, (yaw / 2.0).sin()];
    let metrics = fly(5.0, |t| Row { attitude, reference: [0.0, 0.0, 0.0, -3.1], ..hover(t) });
    assert_near(metrics.axes().yaw.max_m, TAU - 6.2, 1e-12);
}

#[test]
fn square_wave_varies_twice_its_height_a_period() {
    // Two rotors between ω² = 100 and 400, 50 periods a second: 2 rotors · 2 edges · 300 · 50.
    let square = |t: f64| if ((t * 1000.0).round() as u32 / 10).is_multiple_of(2) { 10.0 } else { 20.0 };
    let metrics = fly(10.0, |t| Row { omega_command: [square(t), 7.0, square(t), 7.0], ..hover(t) });
    let expected = 2.0 * 2.0 * 300.0 * 50.0;
    // One edge in a thousand falls off the end.
    assert_near(metrics.chattering(), expected, 1.1e-3 * expected);
    assert_near(metrics.chattering_after_4s(), expected, 1.8e-3 * expected);
}

#[test]
fn a_ramp_of_squares_varies_at_its_slope() {
    let metrics = fly(5.0, |t| Row { omega_command: [(1.0 + 3.0 * t).sqrt(), 0.0, 0.0, 0.0], ..hover(t) });
    assert_near(metrics.chattering(), 3.0, 1e-12);
}

#[test]
fn effort_is_the_rms_of_each_component() {
    let effort = fly(2.0, |t| Row { u: [8.0, (TAU * t).sin(), 0.0, -0.5], ..hover(t) }).control_effort();
    assert_near(effort.thrust_rms_n, 8.0, 1e-12);
    assert_near(effort.roll_rms_n_m, 1.0 / SQRT_2, 1e-12);
    assert_near(effort.pitch_rms_n_m, 0.0, 0.0);
    assert_near(effort.yaw_rms_n_m, 0.5, 1e-12);
}

#[test]
fn recovery_counts_from_the_onset() {
    let onset = 5.0;
    let kicked = |t: f64| if t > onset && t < onset + 0.2 { 0.06 } else { 0.0 };
    let metrics = fly(8.0, |t| Row { position: [kicked(t), kicked(t) / 2.0, -kicked(t)], ..hover(t) });
    let recovery = metrics.recovery(onset);
    assert_near(recovery.x, 0.2, 1e-12);
    assert_eq!(recovery.y, Some(0.0), "3 cm never left the band");
    assert_eq!(recovery.yaw, Some(0.0));
    let leaving = |t: f64| if t > 6.0 { t } else { 0.0 };
    let gone = fly(8.0, |t| Row { position: [leaving(t), 0.0, 0.0], ..hover(t) }).recovery(onset);
    assert_eq!((gone.x, gone.away()), (None, vec![]));
}

#[test]
fn what_was_off_before_the_onset_is_not_the_disturbances_doing() {
    let onset = 5.0;
    // x arrives at 6 s, y has never been there, z arrives at 4 s and is pushed out once more at 6 s.
    let arriving = |t: f64| if t < 6.0 { 1.0 } else { 0.0 };
    let pushed = |t: f64| if t < 4.0 || (6.0..6.5).contains(&t) { 1.0 } else { 0.0 };
    let metrics = fly(8.0, |t| Row { position: [arriving(t), 1.0, pushed(t)], ..hover(t) });
    let recovery = metrics.recovery(onset);
    assert_eq!((recovery.x, recovery.y, recovery.away()), (None, None, vec!["x", "y"]));
    assert_near(recovery.z, 1.5, 1e-12);
    let at_once = metrics.recovery(0.0);
    assert_eq!(at_once.away(), ["x", "y"], "z has been inside since, and was pushed out by the disturbance");
}

#[test]
fn divergence_gives_no_figures_instead_of_wrong_ones() {
    let metrics = fly(6.0, |t| {
        let wild = if t > 5.0 { f64::NAN } else { 0.0 };
        Row { position: [wild; 3], omega_command: [wild; 4], u: [wild; 4], ..hover(t) }
    });
    let x = metrics.axes().x;
    assert_eq!((x.settle_5cm_s, x.rms_m, x.max_m), (None, None, None));
    assert_eq!((metrics.chattering(), metrics.control_effort().thrust_rms_n), (None, None));
}

#[test]
fn no_rows_no_figures() {
    let metrics = Metrics::new();
    assert_eq!(metrics.axes(), Axes::default());
    assert_eq!(metrics.chattering(), None);
    assert_eq!(fly(TICK, hover).chattering(), None, "one row has no variation a second");
}

#[test]
fn errors_of_the_attitude_count_while_no_foot_is_on_the_ground() {
    let ground = Ground::for_vehicle(0.0, 2.0, 9.81, 0.04);
    let mut metrics = Metrics::new().over(Some(ground));
    for tick in 4_000..4_100_u32 {
        // In the air level and 0.1 rad off; on the ground tilted by 0.5 rad, and 0.8 rad off.
        let (height, half_tilt, off) = if tick < 4_050 { (5.0, 0.0, 0.1) } else { (0.0, 0.25, 1.3) };
        metrics.record(&Row {
            position: [0.0, 0.0, height],
            attitude: [libm::cos(half_tilt), libm::sin(half_tilt), 0.0, 0.0],
            desired_attitude: [off, 0.0, 0.0],
            ..hover(f64::from(tick) * TICK)
        });
    }
    let most = metrics.tilt().roll_max_rad.expect("it has flown");
    assert!((most - 0.1).abs() < 1e-12, "{most}");
}
