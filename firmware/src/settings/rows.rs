//! The rows of the table, in their fixed order.
//!
//! A row of the configuration names its field once: access and key both follow from it. The store goes by names; a new
//! row that is to leave the others' indices as they are is a new block at the end of [`SETTINGS`].

use super::axes::{AXES, AXES_COUNT};
use super::radio::{CHANNELS, CHANNELS_COUNT};
use super::table::{Class, Domain, Place, Setting, Slot, Value};
use crate::control::observer::ObserverGains;
use crate::control::position::PositionGains;
use crate::validate::{Field, Range};

/// Degrees per radian.
const DEGREES: f32 = 57.295_78;

/// Rows of numbers: name, unit, field of a part of the configuration, range, class, text.
macro_rules! reals {
    ($place:ident $group:literal: $(
        $name:literal, $unit:literal $(* $scale:ident)?, $field:ident $([$i:literal])? $(.$sub:ident $([$j:literal])?)?,
        $range:expr, $class:ident, $text:literal;
    )*) => {
        [$(Setting {
            name: $name,
            unit: $unit,
            text: $text,
            class: Class::$class,
            domain: Domain::Real($range),
            scale: 1.0 $(* $scale)?,
            default: None,
            key: Field::of("", concat!($group, ".", stringify!($field) $(, ".", stringify!($sub))?)),
            place: Place::$place(Slot {
                get: |part| Some(Value::Real(part.$field $([$i])? $(.$sub $([$j])?)?)),
                set: |part, value| part.$field $([$i])? $(.$sub $([$j])?)? = value.real(),
            }),
        }),*]
    };
}

/// Rows that stand in the settings alone: name, unit, default, domain, class, text.
macro_rules! own {
    ($($name:literal, $unit:literal, $kind:ident($default:expr), $domain:expr, $class:ident, $text:literal;)*) => {
        [$(Setting {
            name: $name,
            unit: $unit,
            text: $text,
            class: Class::$class,
            domain: $domain,
            scale: 1.0,
            default: Some(Value::$kind($default)),
            key: Field::of("", ""),
            place: Place::Settings,
        }),*]
    };
}

/// Slower, nothing would ever arrive; faster, a step of the reference would be a leap.
const MOTION: Range = Range::Within(0.05, 100.0);
/// A vehicle that comes down as slowly as one that stands could not be told from it.
const DESCENT: Range = Range::Within(0.35, 100.0);
const FRACTION: Range = Range::NotNegativeBelow(1.0);
/// With less the vehicle goes on for hundreds of metres before it has stopped.
const ACCELERATION: Range = Range::Within(0.5, 100.0);
/// PX4's least: with less the reference is many seconds late.
const JERK: Range = Range::Within(1.0, 100.0);
/// With 5 degrees it holds against the drag of a light wind.
const TILT: Range = Range::WithinBelow(0.087_266_46, 1.5);
const RETURN_HEIGHT: Range = Range::Within(0.0, crate::commander::FARTHEST_M);
/// Three decades below and above what sensors of such vehicles have.
const fn decades(typical: f32) -> Range {
    Range::Within(1e-3 * typical, 1e3 * typical)
}
/// A fraction that a scale may be off.
const SCALE: Range = Range::Within(0.0, 1.0);
/// m/s^0.5.
const WALK: Range = Range::Within(0.0, 10.0);

const MODES: [Setting; 18] = reals! { Modes "modes":
    "MPC_XY_CRUISE", "m/s", cruise_m_s, MOTION, InFlight, "Horizontal speed on the way to a place";
    "MPC_XY_VEL_MAX", "m/s", fastest_m_s, MOTION, InFlight, "Greatest horizontal speed that can be asked for";
    "MPC_Z_VEL_MAX_UP", "m/s", climb_m_s, MOTION, InFlight, "Greatest speed upwards";
    "MPC_Z_VEL_MAX_DN", "m/s", sink_m_s, MOTION, InFlight, "Greatest speed downwards";
    "MPC_TKO_SPEED", "m/s", take_off_m_s, MOTION, InFlight, "Speed of a take-off";
    "MPC_LAND_SPEED", "m/s", landing_m_s, DESCENT, InFlight, "Speed of a landing";
    "MPC_LAND_CRWL", "m/s", touchdown_m_s, DESCENT, InFlight, "Speed of a landing near the ground";
    "GL_DESCENT_SPEED", "m/s", descent_m_s, DESCENT, InFlight, "Speed of a descent after a failure";
    "MPC_ACC_HOR", "m/s^2", acceleration_m_s2, ACCELERATION, InFlight, "Greatest horizontal acceleration";
    "GL_ACC_VERT", "m/s^2", vertical_acceleration_m_s2, ACCELERATION, InFlight, "Greatest vertical acceleration";
    "MPC_JERK_AUTO", "m/s^3", jerk_m_s3, JERK, InFlight, "Greatest jerk";
    "MPC_YAWRAUTO_MAX", "deg/s" * DEGREES, yaw_rate_rad_s, MOTION, InFlight, "Greatest rate of the heading";
    "MPC_YAWRAUTO_ACC", "deg/s^2" * DEGREES, yaw_acceleration_rad_s2, MOTION, InFlight, "Greatest acceleration of the heading";
    "RTL_RETURN_ALT", "m", return_height_m, RETURN_HEIGHT, InFlight, "Height over home of a return, if it is not higher already";
    "GL_BAT_LOW_V", "V", battery_low_v, Range::NotNegative, InFlight, "Battery voltage below which it returns; 0 for never";
    "GL_BAT_CRIT_V", "V", battery_critical_v, Range::NotNegative, InFlight, "Battery voltage below which it lands; 0 for never";
    "GL_IDLE_SPEED", "", idle_part, FRACTION, Boot, "Rotor speed while armed on the ground, as a fraction of the greatest";
    "GL_BLIND_THRUST", "", blind_thrust_part, FRACTION, InFlight, "Thrust of a blind descent, as a fraction of the weight";
};

const MANUAL: [Setting; 16] = reals! { Manual "manual":
    "MPC_MAN_TILT_MAX", "deg" * DEGREES, tilt_max_rad, MANUAL_TILT, InFlight, "Greatest tilt by stick, in stabilized and altitude mode";
    "MPC_MAN_Y_MAX", "deg/s" * DEGREES, yaw_rate_rad_s, MANUAL_TURN, InFlight, "Greatest rate of the heading by stick";
    "MPC_VEL_MANUAL", "m/s", speed_m_s, MOTION, InFlight, "Greatest horizontal speed by stick, in position mode";
    "MPC_XY_MAN_EXPO", "", expo_xy, SCALE, InFlight, "How cubic the roll and pitch sticks are in position mode: 0 linear, 1 cubic";
    "MPC_Z_MAN_EXPO", "", expo_z, SCALE, InFlight, "The same of the throttle stick in altitude and position mode";
    "MPC_YAW_EXPO", "", expo_yaw, SCALE, InFlight, "The same of the yaw stick";
    "MPC_HOLD_DZ", "", dead_zone, Range::Within(0.0, 0.5), InFlight, "Dead zone about the centre of a stick that holds there";
    "MPC_THR_HOVER", "", hover_throttle, Range::Within(0.1, 0.8), InFlight, "Thrust that a set-point of an attitude hovers with, as a fraction of its range";
    "MPC_MANTHR_MIN", "", throttle_min, Range::Within(0.02, 0.3), InFlight, "Least thrust by stick in the air, as a fraction of the greatest";
    "MC_ACRO_R_MAX", "deg/s" * DEGREES, acro_rates_rad_s[0], ACRO, InFlight, "Greatest roll rate in acro mode";
    "MC_ACRO_P_MAX", "deg/s" * DEGREES, acro_rates_rad_s[1], ACRO, InFlight, "Greatest pitch rate in acro mode";
    "MC_ACRO_Y_MAX", "deg/s" * DEGREES, acro_rates_rad_s[2], ACRO, InFlight, "Greatest yaw rate in acro mode";
    "MC_ACRO_EXPO", "", acro_expo, SCALE, InFlight, "How cubic the roll and pitch sticks are in acro mode";
    "MC_ACRO_EXPO_Y", "", acro_expo_yaw, SCALE, InFlight, "The same of the yaw stick";
    "MC_ACRO_SUPEXPO", "", acro_super_expo, Range::Within(0.0, 0.95), InFlight, "How much steeper the roll and pitch sticks become towards their ends in acro mode";
    "MC_ACRO_SUPEXPOY", "", acro_super_expo_yaw, Range::Within(0.0, 0.95), InFlight, "The same of the yaw stick";
};
/// Less can hardly be steered with; at more the vertical part of the thrust carries no vehicle.
const MANUAL_TILT: Range = Range::Within(0.087_266_46, 1.221_730_5);
/// 2 to 400 degrees per second.
const MANUAL_TURN: Range = Range::Within(0.034_906_585, 6.981_317);
/// 10 to 1800 degrees per second, as PX4 allows.
const ACRO: Range = Range::Within(0.174_532_92, 31.415_926);

const FLIGHT: [Setting; 2] = reals! { Flight "control":
    "MPC_TILTMAX_AIR", "deg" * DEGREES, tilt_max_rad, TILT, InFlight, "Greatest tilt that position control demands";
    "GL_ROTOR_TAU", "s", rotor_time_constant_s, Range::NotNegative, Boot, "Time constant to which the rotor lag is shortened; 0 for none";
};

/// A row whose key does not follow from its field.
const fn keyed(setting: Setting, key: &'static str) -> Setting {
    Setting { key: Field::of("", key), ..setting }
}

const CONTROL: [Setting; 5] = {
    let [attitude_bandwidth, attitude_max] = reals! { Attitude "control.attitude":
        "SMC_ATT_OBS_BW", "rad/s", observer.bandwidth_rad_s, ObserverGains::RANGE, InFlight, "Bandwidth of the attitude's disturbance observer; 0 for none";
        "SMC_ATT_OBS_MAX", "rad/s^2", observer.disturbance_max, ObserverGains::RANGE, InFlight, "Greatest disturbance that it estimates";
    };
    let [bandwidth, max, rate] = reals! { Position "control.position":
        "SMC_POS_OBS_BW", "rad/s", observer.bandwidth_rad_s, ObserverGains::RANGE, InFlight, "Bandwidth of the position's disturbance observer; 0 for none";
        "SMC_POS_OBS_MAX", "m/s^2", observer.disturbance_max, ObserverGains::RANGE, InFlight, "Greatest disturbance that it estimates";
        "SMC_POS_EFF_RATE", "1/s", effectiveness_rate, PositionGains::EFFECTIVENESS_RATES, InFlight, "Rate at which the thrust effectiveness adapts; 0 to disable";
    };
    [
        keyed(attitude_bandwidth, "control.attitude_observer.bandwidth_rad_s"),
        keyed(attitude_max, "control.attitude_observer.disturbance_max"),
        keyed(bandwidth, "control.position_observer.bandwidth_rad_s"),
        keyed(max, "control.position_observer.disturbance_max"),
        keyed(rate, "control.effectiveness_rate"),
    ]
};

const AIRFRAME: [Setting; 30] = reals! { Airframe "airframe":
    "GL_MASS", "kg", mass_kg, Range::Positive, Boot, "Mass";
    "GL_INERTIA_X", "kg m^2", inertia_kg_m2[0], Range::Positive, Boot, "Moment of inertia in roll";
    "GL_INERTIA_Y", "kg m^2", inertia_kg_m2[1], Range::Positive, Boot, "Moment of inertia in pitch";
    "GL_INERTIA_Z", "kg m^2", inertia_kg_m2[2], Range::Positive, Boot, "Moment of inertia in yaw";
    "GL_GRAVITY", "m/s^2", gravity_m_s2, Range::Positive, Boot, "Gravitational acceleration";
    "GL_OMEGA_MAX", "rad/s", omega_max_rad_s, Range::Within(1.0, 1e5), Boot, "Greatest rotor speed";
    "GL_ROTOR_J", "kg m^2", rotor_inertia_kg_m2, Range::NotNegative, Boot, "Moment of inertia of a rotor about its axis";
    "GL_DRAG_X", "N s/m", drag_n_s_m[0], Range::NotNegative, Boot, "Drag along x";
    "GL_DRAG_Y", "N s/m", drag_n_s_m[1], Range::NotNegative, Boot, "Drag along y";
    "GL_DRAG_Z", "N s/m", drag_n_s_m[2], Range::NotNegative, Boot, "Drag along z";
    "GL_ROT_DRAG_X", "N m s^2", rotational_drag_n_m_s2[0], Range::NotNegative, Boot, "Rotational drag in roll";
    "GL_ROT_DRAG_Y", "N m s^2", rotational_drag_n_m_s2[1], Range::NotNegative, Boot, "Rotational drag in pitch";
    "GL_ROT_DRAG_Z", "N m s^2", rotational_drag_n_m_s2[2], Range::NotNegative, Boot, "Rotational drag in yaw";
    "GL_ROTOR_LAG", "s", rotor_lag_s, Range::NotNegative, Boot, "Time constant of a rotor's speed";
    "GL_THRUST_1", "N s^2", geometry.thrust[0], Range::FinitePositive, Boot, "Thrust of rotor 1 per squared speed";
    "GL_THRUST_2", "N s^2", geometry.thrust[1], Range::FinitePositive, Boot, "Thrust of rotor 2 per squared speed";
    "GL_THRUST_3", "N s^2", geometry.thrust[2], Range::FinitePositive, Boot, "Thrust of rotor 3 per squared speed";
    "GL_THRUST_4", "N s^2", geometry.thrust[3], Range::FinitePositive, Boot, "Thrust of rotor 4 per squared speed";
    "GL_ROLL_1", "N m s^2", geometry.roll[0], Range::Finite, Boot, "Roll torque of rotor 1 per squared speed";
    "GL_ROLL_2", "N m s^2", geometry.roll[1], Range::Finite, Boot, "Roll torque of rotor 2 per squared speed";
    "GL_ROLL_3", "N m s^2", geometry.roll[2], Range::Finite, Boot, "Roll torque of rotor 3 per squared speed";
    "GL_ROLL_4", "N m s^2", geometry.roll[3], Range::Finite, Boot, "Roll torque of rotor 4 per squared speed";
    "GL_PITCH_1", "N m s^2", geometry.pitch[0], Range::Finite, Boot, "Pitch torque of rotor 1 per squared speed";
    "GL_PITCH_2", "N m s^2", geometry.pitch[1], Range::Finite, Boot, "Pitch torque of rotor 2 per squared speed";
    "GL_PITCH_3", "N m s^2", geometry.pitch[2], Range::Finite, Boot, "Pitch torque of rotor 3 per squared speed";
    "GL_PITCH_4", "N m s^2", geometry.pitch[3], Range::Finite, Boot, "Pitch torque of rotor 4 per squared speed";
    "GL_YAW_1", "N m s^2", geometry.yaw[0], Range::Finite, Boot, "Yaw torque of rotor 1 per squared speed";
    "GL_YAW_2", "N m s^2", geometry.yaw[1], Range::Finite, Boot, "Yaw torque of rotor 2 per squared speed";
    "GL_YAW_3", "N m s^2", geometry.yaw[2], Range::Finite, Boot, "Yaw torque of rotor 3 per squared speed";
    "GL_YAW_4", "N m s^2", geometry.yaw[3], Range::Finite, Boot, "Yaw torque of rotor 4 per squared speed";
};

/// Whole numbers of the configuration.
const CHOICES: [Setting; 2] = [
    Setting {
        name: "GL_SPIN_UP",
        unit: "",
        text: "Whether the reaction torque of rotors that spin up is modelled: 0 no, 1 yes",
        class: Class::Boot,
        domain: Domain::Whole(0, 1),
        scale: 1.0,
        default: None,
        key: Field::of("", "airframe.spin_up_reaction"),
        place: Place::Airframe(Slot {
            get: |airframe| Some(Value::Int(i32::from(airframe.spin_up_reaction))),
            set: |airframe, value| airframe.spin_up_reaction = value.int() != 0,
        }),
    },
    Setting {
        name: "SMC_ATT_FORM",
        unit: "",
        text: "Coordinates of the attitude's surfaces: 0 rotation group, 1 Euler angles",
        class: Class::Disarmed,
        domain: Domain::Whole(0, 1),
        scale: 1.0,
        default: None,
        key: Field::of("", "control.form"),
        place: Place::Attitude(Slot {
            get: |gains| Some(Value::Int(gains.form.code())),
            set: |gains, value| gains.form = crate::control::attitude::AttitudeForm::of_code(value.int()),
        }),
    },
];

const ESTIMATOR: [Setting; 22] = reals! { Estimator "estimator":
    "GL_E_GYR_N", "rad/s/sqrt(Hz)", gyro_noise, decades(1e-4), Disarmed, "White noise density of the gyroscope";
    "GL_E_GYR_WALK", "rad/s/sqrt(s)", gyro_bias_walk, decades(1e-5), Disarmed, "Random walk of the gyroscope's bias";
    "GL_E_GYR_BIAS", "rad/s", gyro_bias, decades(0.01), Disarmed, "Turn-on bias of the gyroscope; at the next alignment";
    "GL_E_ACC_N", "m/s^2/sqrt(Hz)", accel_noise, decades(0.001), Disarmed, "White noise density of the accelerometer";
    "GL_E_ACC_WALK", "m/s^2/sqrt(s)", accel_bias_walk, decades(1e-4), Disarmed, "Random walk of the accelerometer's bias";
    "GL_E_ACC_BIAS", "m/s^2", accel_bias, decades(0.01), Disarmed, "Turn-on bias of the accelerometer; at the next alignment";
    "GL_E_MAG_N", "uT", mag_noise_ut, decades(1.0), Disarmed, "Noise of the magnetometer";
    "GL_E_MAG_OFF", "rad", heading_offset, decades(0.01), Disarmed, "Error of the magnetic heading that calibration leaves; at the next alignment";
    "GL_E_BAR_N", "m", baro_noise_m, decades(0.1), Disarmed, "Noise of the barometer";
    "GL_E_GNS_N_H", "m", gnss_noise_m[0], decades(0.1), Disarmed, "White noise of a GNSS position, horizontal";
    "GL_E_GNS_N_V", "m", gnss_noise_m[1], decades(0.1), Disarmed, "White noise of a GNSS position, vertical";
    "GL_E_GNS_V_H", "m/s", gnss_speed_m_s[0], decades(0.1), Disarmed, "Noise of a GNSS velocity, horizontal";
    "GL_E_GNS_V_V", "m/s", gnss_speed_m_s[1], decades(0.1), Disarmed, "Noise of a GNSS velocity, vertical";
    "GL_E_POSE_N", "m", pose_position_m, decades(0.001), Disarmed, "Noise of a motion-capture position";
    "GL_E_POSE_ATT_N", "rad", pose_attitude_rad, decades(0.001), Disarmed, "Noise of a motion-capture attitude";
    "GL_E_GYR_SCALE", "", gyro_scale, SCALE, Disarmed, "Scale and misalignment error of the gyroscope";
    "GL_E_ACC_SCALE", "", accel_scale, SCALE, Disarmed, "Scale and misalignment error of the accelerometer";
    "GL_E_BAR_WALK", "m/sqrt(s)", baro_walk, WALK, Disarmed, "Random walk of the barometric height";
    "GL_E_GNS_WALK", "m/sqrt(s)", gnss_walk, WALK, Disarmed, "Random walk of the GNSS position's error";
    "GL_E_FIELD_X", "uT", magnetic_field_ut[0], Range::Finite, Disarmed, "Earth's magnetic field, north";
    "GL_E_FIELD_Y", "uT", magnetic_field_ut[1], Range::Finite, Disarmed, "Earth's magnetic field, west";
    "GL_E_FIELD_Z", "uT", magnetic_field_ut[2], Range::Finite, Disarmed, "Earth's magnetic field, up";
};

const ID: Domain = Domain::Whole(0, 16_777_215);

/// What ground stations look for. They read most of them to show the vehicle's state; it cannot be changed here.
const STATION: [Setting; 46] = own! {
    "MAV_SYS_ID", "", Int(1), Domain::Whole(1, 250), Boot, "MAVLink system of this vehicle";
    "GL_AUTOPILOT", "", Int(12), Domain::OneOf(&[0, 12]), Boot, "Autopilot that ground stations are told: 12 PX4, 0 generic";
    "SYS_AUTOSTART", "", Int(0), Domain::Whole(0, 9_999_999), Disarmed, "Airframe; 0 for a vehicle that is not configured, and does not arm";
    "SYS_AUTOCONFIG", "", Int(0), Domain::Whole(0, 2), ReadOnly, "No effect: nothing is reset at start";
    "CAL_GYRO0_ID", "", Int(1), ID, ReadOnly, "No effect: sensors come calibrated";
    "CAL_ACC0_ID", "", Int(1), ID, ReadOnly, "No effect: sensors come calibrated";
    "CAL_MAG0_ID", "", Int(1), ID, ReadOnly, "No effect: sensors come calibrated";
    "CAL_MAG1_ID", "", Int(0), ID, ReadOnly, "No effect: there is one magnetometer";
    "CAL_MAG2_ID", "", Int(0), ID, ReadOnly, "No effect: there is one magnetometer";
    "COM_RC_IN_MODE", "", Int(3), Domain::Whole(0, 4), InFlight, "Whose sticks count: 0 a radio's, 1 a joystick's, 2 and 3 whichever come first, until they are lost, 4 none";
    "RC_MAP_ROLL", "", Int(1), CHANNEL, InFlight, "Channel of the roll stick; 0 for none";
    "RC_MAP_PITCH", "", Int(2), CHANNEL, InFlight, "Channel of the pitch stick; 0 for none";
    "RC_MAP_YAW", "", Int(4), CHANNEL, InFlight, "Channel of the yaw stick; 0 for none";
    "RC_MAP_THROTTLE", "", Int(3), CHANNEL, InFlight, "Channel of the throttle stick; 0 for none";
    "COM_FLTMODE1", "", Int(-1), SWITCH_MODE, InFlight, "Mode of the mode switch's position 1: -1 none, 1 altitude, 2 position, 3 trajectory, 4 hold, 5 return, 6 acro, 7 offboard, 8 stabilized, 11 land";
    "COM_FLTMODE2", "", Int(-1), SWITCH_MODE, InFlight, "Mode of the mode switch's position 2: -1 none, 1 altitude, 2 position, 3 trajectory, 4 hold, 5 return, 6 acro, 7 offboard, 8 stabilized, 11 land";
    "COM_FLTMODE3", "", Int(-1), SWITCH_MODE, InFlight, "Mode of the mode switch's position 3: -1 none, 1 altitude, 2 position, 3 trajectory, 4 hold, 5 return, 6 acro, 7 offboard, 8 stabilized, 11 land";
    "COM_FLTMODE4", "", Int(-1), SWITCH_MODE, InFlight, "Mode of the mode switch's position 4: -1 none, 1 altitude, 2 position, 3 trajectory, 4 hold, 5 return, 6 acro, 7 offboard, 8 stabilized, 11 land";
    "COM_FLTMODE5", "", Int(-1), SWITCH_MODE, InFlight, "Mode of the mode switch's position 5: -1 none, 1 altitude, 2 position, 3 trajectory, 4 hold, 5 return, 6 acro, 7 offboard, 8 stabilized, 11 land";
    "COM_FLTMODE6", "", Int(-1), SWITCH_MODE, InFlight, "Mode of the mode switch's position 6: -1 none, 1 altitude, 2 position, 3 trajectory, 4 hold, 5 return, 6 acro, 7 offboard, 8 stabilized, 11 land";
    "BAT1_SOURCE", "", Int(0), Domain::Whole(-1, 2), ReadOnly, "Source of battery data: 0, the power module";
    "BAT1_N_CELLS", "", Int(0), Domain::Whole(0, 16), InFlight, "Cells of the battery, by which its charge is told: 0, unknown";
    "RTL_LAND_DELAY", "s", Real(0.0), Domain::Real(Range::Within(-1.0, 300.0)), ReadOnly, "Wait over home before landing: none";
    "RTL_DESCEND_ALT", "m", Real(0.0), Domain::Real(Range::Within(0.0, 100.0)), ReadOnly, "Height over home to wait at before landing: none";
    "NAV_DLL_ACT", "", Int(0), Domain::Whole(0, 3), InFlight, "What is done when the ground station is lost: 0 nothing, 1 hold, 2 return, 3 land";
    "NAV_RCL_ACT", "", Int(2), Domain::OneOf(&[1, 2, 3]), InFlight, "What is done when the sticks are lost in a manual mode: 1 hold, 2 return, 3 land";
    "COM_DL_LOSS_T", "s", Int(10), Domain::Whole(5, 300), InFlight, "Silence after which the ground station is lost";
    "COM_RC_LOSS_T", "s", Real(0.5), Domain::Real(Range::Within(0.1, 35.0)), InFlight, "Silence after which sticks are lost";
    "COM_LOW_BAT_ACT", "", Int(3), Domain::Whole(0, 3), ReadOnly, "What a low battery does: 3, returns, and lands when critical";
    "NAV_ACC_RAD", "m", Real(crate::commander::AT_PLACE_M), Domain::Real(Range::Within(0.05, 200.0)), ReadOnly, "Acceptance radius of a place";
    "MIS_TAKEOFF_ALT", "m", Real(crate::commander::TAKE_OFF_HEIGHT_M), Domain::Real(TAKE_OFF), InFlight, "Height of a take-off for which none is given";
    "BAT1_V_EMPTY", "V", Real(3.6), Domain::Real(CELL), InFlight, "Voltage of a cell at rest that is told as empty";
    "BAT1_V_CHARGED", "V", Real(4.05), Domain::Real(CELL), InFlight, "Voltage of a cell at rest that is told as full";
    "RC_MAP_FLTMODE", "", Int(0), CHANNEL, InFlight, "Channel of the mode switch, with six positions; 0 for none";
    "RC_MAP_ARM_SW", "", Int(0), CHANNEL, InFlight, "Channel of the arming switch; 0 for none";
    "RC_MAP_KILL_SW", "", Int(0), CHANNEL, InFlight, "Channel of the kill switch; 0 for none";
    "RC_CHAN_CNT", "", Int(0), Domain::Whole(0, 18), InFlight, "Channels of the radio that was calibrated last; for ground stations";
    "MAN_ARM_GESTURE", "", Int(1), Domain::Whole(0, 1), InFlight, "Whether the throttle down and the yaw stick to the right for a second arm, and to the left disarm";
    "COM_RC_OVERRIDE", "", Int(1), Domain::Whole(0, 3), InFlight, "Which modes moved sticks end: 1 automatic ones, 2 offboard, 3 both, 0 none";
    "COM_RC_STICK_OV", "%", Real(30.0), Domain::Real(Range::Within(5.0, 80.0)), InFlight, "How far a roll, pitch or yaw stick has to be moved to end an automatic mode";
    "COM_DISARM_PRFLT", "s", Real(10.0), Domain::Real(Range::Within(-1.0, 600.0)), InFlight, "Time on the ground after arming until it disarms; 0 or less for never";
    "COM_DISARM_LAND", "s", Real(2.0), Domain::Real(Range::Within(0.0, 20.0)), InFlight, "Time for which the rotors idle after a landing";
    "COM_SPOOLUP_TIME", "s", Real(0.0), Domain::Real(Range::Within(0.0, 30.0)), InFlight, "Time for which the rotors idle after arming before anything lifts the vehicle";
    "COM_OF_LOSS_T", "s", Real(1.0), Domain::Real(Range::Within(0.1, 60.0)), InFlight, "Silence after which a stream of set-points is lost";
    "COM_OBL_RC_ACT", "", Int(5), Domain::OneOf(&[0, 1, 2, 3, 4, 5]), InFlight, "What is done when set-points are lost: 0 position, 1 altitude, 2 stabilized mode, if there are sticks, 3 return, 4 land, 5 hold";
    "BAT1_R_INTERNAL", "Ohm", Real(0.005), Domain::Real(Range::Within(0.0, 0.2)), InFlight, "Resistance of a cell, with its share of the wires";
};
const CHANNEL: Domain = Domain::Whole(0, 18);
/// PX4's numbers of the modes that there are.
const SWITCH_MODE: Domain = Domain::OneOf(&[-1, 1, 2, 3, 4, 5, 6, 7, 8, 11]);
const CELL: Range = Range::Within(2.0, 5.0);
const TAKE_OFF: Range =
    Range::Within(*crate::commander::TAKE_OFF_HEIGHTS_M.start(), *crate::commander::TAKE_OFF_HEIGHTS_M.end());

/// Number of settings.
pub const COUNT: usize = MODES.len()
    + FLIGHT.len()
    + AXES_COUNT
    + CONTROL.len()
    + AIRFRAME.len()
    + CHOICES.len()
    + ESTIMATOR.len()
    + STATION.len()
    + MANUAL.len()
    + CHANNELS_COUNT;

/// Every setting. The order does not change while the vehicle runs, because ground stations ask by index.
pub static SETTINGS: [Setting; COUNT] =
    concatenated(&[&MODES, &FLIGHT, &AXES, &CONTROL, &AIRFRAME, &CHOICES, &ESTIMATOR, &STATION, &MANUAL, &CHANNELS]);

/// The blocks one after the other.
#[expect(clippy::large_stack_arrays, reason = "evaluated by the compiler alone")]
const fn concatenated(blocks: &[&[Setting]]) -> [Setting; COUNT] {
    let mut all = [MODES[0]; COUNT];
    let (mut at, mut block) = (0, 0);
    while block < blocks.len() {
        let mut row = 0;
        while row < blocks[block].len() {
            all[at] = blocks[block][row];
            at += 1;
            row += 1;
        }
        block += 1;
    }
    all
}

/// The index of a row that the firmware itself asks for, found when it is compiled.
pub(super) const fn index_of(name: &str) -> usize {
    let mut index = 0;
    while index < COUNT {
        if equal(SETTINGS[index].name.as_bytes(), name.as_bytes()) {
            return index;
        }
        index += 1;
    }
    panic!("no such setting")
}

const fn equal(one: &[u8], other: &[u8]) -> bool {
    let mut i = 0;
    while i < one.len() && i < other.len() && one[i] == other[i] {
        i += 1;
    }
    i == one.len() && i == other.len()
}
