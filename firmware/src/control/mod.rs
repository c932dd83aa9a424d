//! The control laws: pure functions of their gains, state and inputs.
//!
//! | module | owns |
//! |---|---|
//! | [`law`] | the traits that a control law implements |
//! | [`gains`] | surface, gain and reaching law of an axis, as they are configured |
//! | [`sliding`] | sliding surfaces and reaching laws |
//! | [`position`] | position control: Eq. 28–31 |
//! | [`flatness`] | the map from a force and its derivatives to an attitude and its derivatives (Eq. 11) |
//! | [`attitude`] | attitude control on the rotation group ([`pointing`]) and, by Eq. 25–27, on Euler angles ([`euler`]) |
//! | [`mixer`] | control allocation: the inverse of Eq. 4 within the rotors' limits |
//! | [`observer`] | the disturbance observer |
//! | [`design`] | gains from bounds on disturbance, actuators and delay |
//! | [`rotor`] | rotor lag and its compensation |
//! | [`gyro`] | notch and low-pass filters on the gyroscope |
//! | [`rotor_monitor`], [`motor_out`] | detection of a failed rotor, and control without it |

pub mod attitude;
pub mod design;
pub mod euler;
pub mod flatness;
pub mod gains;
pub mod gyro;
pub mod law;
pub mod mixer;
pub mod motor_out;
pub mod observer;
pub mod pointing;
pub mod position;
pub mod rotor;
pub mod rotor_monitor;
pub mod sliding;
