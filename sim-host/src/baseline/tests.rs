//! Helpers of the three controllers' tests, and their flights.

use firmware::airframe::{Airframe, ROTORS};
use firmware::control::law::{AttitudeInput, RotorEffect};
use firmware::signals::AttitudeTarget;
use nalgebra::UnitQuaternion;

use super::*;
use crate::controller::Controller;
use crate::flight;
use crate::record::Row;
use crate::scenario::Scenario;

/// No baseline looks at it: INDI filters the speeds and makes its own.
const UNUSED: RotorEffect = RotorEffect { torque: Vector3::new(0.0, 0.0, 0.0), yaw_n_m: 0.0, spin_rad_s: 0.0 };

/// As they come out of the last search: what is asked of their flights below holds for any gains that are fit to fly.
const TUNINGS: [&str; 3] = ["x500-pid", "x500-geometric", "x500-indi"];

fn scenario(tuning: &str, settings: &[&str]) -> Result<Scenario> {
    let settings: Vec<String> = settings.iter().map(|s| (*s).to_owned()).chain([format!("tuning={tuning}")]).collect();
    Scenario::load("x500-hover", &settings)
}

fn tuning(name: &str) -> Controller {
    scenario(name, &[]).expect("valid").controller
}

pub(super) fn airframe() -> Airframe {
    scenario("x500-pid", &[]).expect("valid").airframe.flight()
}

pub(super) fn hover_speeds(airframe: &Airframe) -> [f32; ROTORS] {
    [airframe.omega_for_thrust_to_weight(1.0); ROTORS]
}

/// Level, heading north, at rest.
pub(super) fn level() -> AttitudeTarget {
    AttitudeTarget { attitude: UnitQuaternion::identity(), rates: Vector3::zeros(), accelerations: Vector3::zeros() }
}

pub(super) fn input<'a>(
    attitude: &'a UnitQuaternion<f32>,
    rates: &'a Vector3<f32>,
    target: &'a AttitudeTarget,
    rotor_speeds: &'a [f32; ROTORS],
) -> AttitudeInput<'a> {
    AttitudeInput { attitude, rates, target, rotor_speeds, rotors: &UNUSED, saturated: false }
}

/// Attitudes spread over the rotation group.
pub(super) fn attitudes() -> impl Iterator<Item = UnitQuaternion<f32>> {
    (0..300).map(|i| {
        let t = f64::from(i);
        let angles = [3.1 * (0.37 * t).sin(), 1.57 * (0.71 * t).cos(), 3.1 * (1.13 * t).sin()];
        UnitQuaternion::from_euler_angles(angles[0], angles[1], angles[2]).cast()
    })
}

fn fly(scenario: &Scenario) -> Vec<Row> {
    let mut rows = Vec::new();
    let outcome = flight::fly(scenario, 1, &mut rows).expect("can be flown");
    assert!(outcome.survived(), "{}", scenario.controller.name());
    rows
}

fn distance(row: &Row) -> f64 {
    let square = |i: usize| (row.position[i] - row.reference[i]) * (row.position[i] - row.reference[i]);
    (square(0) + square(1) + square(2)).sqrt()
}

#[test]
fn each_comes_back_from_an_offset_and_stays() {
    for tuning in TUNINGS {
        let rows = fly(&scenario(tuning, &["start_position_m=[0.3,-0.3,2.3]"]).expect("valid"));
        let (first, last) = (rows.first().expect("rows"), rows.last().expect("rows"));
        assert!(distance(first) > 0.5, "{tuning}");
        assert!(distance(last) < 0.05, "{tuning}: {}", distance(last));
        let farthest = rows.iter().map(distance).fold(0.0, f64::max);
        assert!(farthest < 0.8, "{tuning}: {farthest}");
    }
}

#[test]
fn each_survives_a_step_without_a_path() {
    let step = "trajectory={step={from_m=[0.0,0.0,2.0],to_m=[3.0,0.0,2.0],at_s=1.0,yaw_rad=0.0}}";
    for tuning in TUNINGS {
        let rows = fly(&scenario(tuning, &[step]).expect("valid"));
        let last = rows.last().expect("rows");
        assert!(distance(last) < 0.1, "{tuning}: {}", distance(last));
        let beyond = rows.iter().map(|row| row.position[0] - 3.0).fold(0.0, f64::max);
        assert!(beyond < 1.0, "{tuning}: {beyond}");
        let sunk = rows.iter().map(|row| (row.position[2] - 2.0).abs()).fold(0.0, f64::max);
        assert!(sunk < 1.0, "{tuning}: {sunk}");
    }
}

#[test]
fn each_upholds_a_push_that_it_does_not_know() {
    // 10 % more mass than modelled, and a steady wind of 3 m/s, from the first tick. Uncompensated, the mass alone
    // makes 1 m/s² of it: 0.08 m at a position gain of 12 1/s².
    for tuning in TUNINGS {
        let rows = fly(&scenario(tuning, &["truth.mass_factor=1.1", "wind.mean_m_s=[3.0,0.0,0.0]"]).expect("valid"));
        let last = rows.last().expect("rows");
        assert!(distance(last) < 0.05, "{tuning}: {}", distance(last));
    }
}

#[test]
fn gains_out_of_their_range_are_refused_by_their_key() {
    let refusal = |controller: &Controller| controller.validate().expect_err("must be refused").to_string();
    let Controller::Pid(pid) = tuning("x500-pid") else { panic!("another controller") };
    let Controller::Geometric(geometric) = tuning("x500-geometric") else { panic!("another controller") };
    let Controller::Indi(indi) = tuning("x500-indi") else { panic!("another controller") };
    let nan = AxisPair { xy: 1.0, z: f32::NAN };
    for (controller, culprit) in [
        (Controller::Pid(pid::Pid { tilt_max_rad: 1.6, ..pid }), "pid.tilt_max_rad"),
        (Controller::Pid(pid::Pid { rate_p_1_s: nan, ..pid }), "pid.rate_p_1_s.z"),
        (Controller::Pid(pid::Pid { yaw_weight: 1.1, ..pid }), "pid.yaw_weight"),
        (Controller::Pid(pid::Pid { rate_d_cutoff_hz: 500.0, ..pid }), "pid.rate_d_cutoff_hz"),
        (Controller::Geometric(geometric::Geometric { attitude_1_s2: nan, ..geometric }), "geometric.attitude_1_s2.z"),
        (Controller::Indi(indi::Indi { acceleration_cutoff_hz: 0.0, ..indi }), "indi.acceleration_cutoff_hz"),
        (Controller::Indi(indi::Indi { rotor_delay_ticks: 17, ..indi }), "indi.rotor_delay_ticks"),
    ] {
        assert!(refusal(&controller).contains(culprit), "{culprit}: {}", refusal(&controller));
    }
}

#[test]
fn what_flies_the_firmwares_own_laws_alone_says_so() {
    for tuning in TUNINGS {
        let error = scenario(tuning, &["plant=paper-decoupled", "duration_s=1"]).expect_err("must be refused");
        let text = format!("{error:#}");
        assert!(text.contains("paper-decoupled") && text.contains("tuning") && !text.contains('\n'), "{text}");
        let hover = scenario(tuning, &[]).expect("valid");
        let error = flight::lockstep(&hover, 1, flight::rigid_body(&hover, 1)).expect_err("must be refused");
        assert!(error.to_string().contains(hover.controller.name()), "{error}");
    }
}
