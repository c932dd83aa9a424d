//! Helpers of the three controllers' tests.

use firmware::airframe::{Airframe, ROTORS};
use firmware::control::law::{AttitudeInput, RotorEffect};
use firmware::signals::AttitudeTarget;
use nalgebra::UnitQuaternion;

use super::*;
use crate::airframe::AirframeFile;
use crate::controller::{Controller, TuningFile};

/// No baseline looks at it: INDI filters the speeds and makes its own.
const UNUSED: RotorEffect = RotorEffect { torque: Vector3::new(0.0, 0.0, 0.0), yaw_n_m: 0.0, spin_rad_s: 0.0 };

pub(super) fn airframe() -> Airframe {
    let file: AirframeFile = toml::from_str(include_str!("../../../airframes/x500.toml")).expect("an airframe");
    file.flight()
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

#[test]
fn gains_out_of_their_range_are_refused_by_their_key() {
    let refusal = |controller: &Controller| controller.validate().expect_err("must be refused").to_string();
    let tuning = |text: &str| toml::from_str::<TuningFile>(text).expect("a tuning").controller;
    let Controller::Pid(pid) = tuning(include_str!("../../../tunings/x500-pid.toml")) else {
        panic!("another controller")
    };
    let Controller::Geometric(geometric) = tuning(include_str!("../../../tunings/x500-geometric.toml")) else {
        panic!("another controller")
    };
    let Controller::Indi(indi) = tuning(include_str!("../../../tunings/x500-indi.toml")) else {
        panic!("another controller")
    };
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
