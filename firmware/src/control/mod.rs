//! The control laws: pure functions of their gains, state and inputs.
//!
//! [`law`] is what the partitions ask of a control law. [`sliding`] owns the surfaces and reaching laws, [`observer`] the
//! disturbance observer, [`design`] gains from physical numbers; [`position`] Eq. 28–31, [`flatness`] the way from a force and its derivatives to an attitude
//! and its derivatives (Eq. 11), [`attitude`] the surfaces on the rotation group ([`pointing`]) and Eq. 25–27 on Euler
//! angles ([`euler`]), [`mixer`] the inverse of Eq. 4, [`rotor`] the rotors' lag, [`gyro`] what of the gyroscope is heard.

pub mod attitude;
pub mod design;
pub mod euler;
pub mod flatness;
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
