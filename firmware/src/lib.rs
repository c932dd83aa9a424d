//! Glissade's firmware: everything that flies, and nothing else.
//!
//! A quadrotor flight controller whose control law is sliding mode control. The crate is `no_std`, does not
//! allocate, and knows nothing of the simulator: the desktop uses it through the same doors as a board.
//!
//! ```text
//! SensorFrame ─► inner: attitude SMC ─► mixer ─► MotorCommand               every tick, 1 kHz
//!                  ▲ AttitudeReference (φd, θd, ψd, rates, accelerations, U1)
//!                outer: guidance ─► position SMC ─► flatness                250 Hz
//!                  ▲ directive
//!                commander: arming, modes, failures                         50 Hz
//!                  ▲ commands, ▼ replies
//!                ground: bytes ⇄ MAVLink                                    100 Hz, lowest
//! ```
//!
//! Each partition is a struct that owns its state and has one step function: plain data in, plain data out, no
//! clock, no I/O. [`schedule`] says when its inputs are read and its outputs take effect, [`autopilot`] puts the
//! partitions together; `board` gives them tasks, sensors and rotors. World frame NWU, body frame FLU, SI units; [`frames`] alone knows MAVLink's.

#![cfg_attr(not(test), no_std)]

pub mod airframe;
pub mod autopilot;
#[cfg(all(target_arch = "arm", target_os = "none"))]
pub mod board;
pub mod commander;
pub mod config;
pub mod control;
pub mod estimator;
pub mod failure;
pub mod frames;
pub mod guidance;
pub mod inner;
pub mod math;
pub mod mavlink;
pub mod meter;
pub mod navigator;
pub mod outer;
pub mod pil;
pub mod rotors;
pub mod schedule;
pub mod selftest;
pub mod sensors;
pub mod signals;
pub mod validate;
