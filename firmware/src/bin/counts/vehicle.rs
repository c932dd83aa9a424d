//! The vehicle that is flown on the target, and its controller.

use firmware::airframe::{Airframe, RotorGeometry};
use firmware::config::{FlightConfig, ManualSettings, ModeSettings, Start};
use firmware::control::attitude::{AttitudeForm, AttitudeGains};
use firmware::control::observer::ObserverGains;
use firmware::control::position::PositionGains;
use firmware::control::sliding::{AxisGains, ReachingLaw};
use firmware::guidance::{JoinPlan, Trajectory};

/// A vehicle of 2 kg with 0.25 m arms in X layout, after PX4's x500 in Gazebo.
fn airframe() -> Airframe {
    let (lift, arm) = (8.548_58e-6, 0.174 * 8.548_58e-6);
    let yaw = 0.016 * lift;
    Airframe {
        mass_kg: 2.0,
        inertia_kg_m2: [0.021_667, 0.021_667, 0.04],
        rotor_inertia_kg_m2: 2.65e-5,
        drag_n_s_m: [0.244; 3],
        rotational_drag_n_m_s2: [5e-4; 3],
        gravity_m_s2: 9.81,
        omega_max_rad_s: 1_071.0,
        rotor_lag_s: 0.02,
        spin_up_reaction: true,
        geometry: RotorGeometry {
            thrust: [lift; 4],
            roll: [-arm, arm, arm, -arm],
            pitch: [-arm, arm, -arm, arm],
            yaw: [-yaw, -yaw, yaw, yaw],
        },
    }
}

fn axis(lambda: f32, gain: f32, horizon_s: f32, approach_max: f32) -> AxisGains {
    AxisGains { approach_max, ..AxisGains::new(gain, lambda, ReachingLaw::ImplicitSgn { horizon_s }) }
}

/// Implicit sgn on every axis, both observers, and lead of the rotors.
pub(crate) fn config() -> FlightConfig {
    let (tilt, yaw) = (axis(12.0, 120.0, 0.02, 9.0), axis(3.0, 8.0, 0.05, 2.5));
    let (horizontal, vertical) = (axis(2.5, 12.0, 0.15, 6.0), axis(2.5, 8.0, 0.15, 6.0));
    FlightConfig {
        airframe: airframe(),
        attitude: AttitudeGains {
            axes: [tilt, tilt, yaw],
            form: AttitudeForm::Group,
            observer: ObserverGains { bandwidth_rad_s: 25.0, disturbance_max: 40.0 },
        },
        position: PositionGains {
            axes: [horizontal, horizontal, vertical],
            observer: ObserverGains { bandwidth_rad_s: 6.0, disturbance_max: 6.0 },
            effectiveness_rate: 1.0,
        },
        tilt_max_rad: 1.2,
        rotor_time_constant_s: 0.005,
        trajectory: Trajectory::FigureEight {
            center_m: [0.0, 0.0, 2.0],
            amplitude_m: [5.666_667, 2.833_333],
            rate_rad_s: 0.998_268,
            yaw_rad: 0.0,
        },
        join: Some(JoinPlan { duration_s: 4.0, start_acceleration_m_s2: [0.0; 3], middle_m: heapless::Vec::new() }),
        start: Start::InFlight,
        start_position_m: [0.0, 0.0, 2.0],
        estimator: None,
        modes: ModeSettings::default(),
        manual: ManualSettings::default(),
    }
}
