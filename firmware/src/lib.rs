//! Glissade's firmware: a quadrotor flight controller with sliding mode control.
//!
//! The crate is `no_std`, does not allocate, and does not know the simulator: the desktop drives it through the same
//! interface as a board.
//!
//! ```text
//! SensorFrame ─► inner: attitude SMC ─► mixer ─► MotorCommand               every tick, 1 kHz
//!                  ▲ AttitudeReference (φd, θd, ψd, rates, accelerations, U1)
//!                outer: guidance ─► position SMC ─► flatness                250 Hz
//!                  ▲ directive
//!                commander: arming, modes, failsafes                        50 Hz
//!                  ▲ commands, ▼ replies
//!                ground: bytes ⇄ MAVLink                                    100 Hz, lowest
//! ```
//!
//! Each partition is a struct that owns its state and has one step function: plain data in, plain data out, no clock,
//! no I/O. [`schedule`] defines when its inputs are read and its outputs take effect, [`autopilot`] puts the partitions
//! together, and [`board`] gives them tasks, sensors and rotors.
//!
//! World frame NWU (north, west, up), body frame FLU (forward, left, up), SI units. Only [`frames`] converts to
//! MAVLink's NED and FRD.
//!
//! # Example
//!
//! Arm the default vehicle on the ground, and take off: [`Autopilot::tick`](autopilot::Autopilot::tick) is called once
//! per millisecond with the vehicle's motion, and returns rotor speeds.
//!
//! ```
//! use firmware::autopilot::Autopilot;
//! use firmware::commander::{Mode, Request};
//! use firmware::config::FlightConfig;
//! use firmware::signals::{NavState, SensorFrame};
//!
//! let config = FlightConfig::default();
//! let mut autopilot = Autopilot::new(&config).expect("a valid configuration");
//!
//! // The vehicle stands on the ground; a simulator would integrate its motion from the rotor speeds.
//! let motion = SensorFrame::Motion(NavState::at_rest());
//! autopilot.tick(Some(&motion));
//! autopilot.inner.request(Request::Arm { force: false }).expect("room for a request");
//! for _ in 0..100 {
//!     autopilot.tick(Some(&motion));
//! }
//! autopilot.inner.request(Request::TakeOff { height_m: 2.0 }).expect("room for a request");
//! for _ in 0..2_000 {
//!     autopilot.tick(Some(&motion));
//! }
//!
//! // Two seconds later the rotors give more than the weight.
//! assert_eq!(autopilot.inner.commander_output().mode, Mode::TakeOff);
//! let demand = autopilot.inner.inner_output().demand;
//! assert!(demand.thrust_n > config.airframe.weight_n());
//! ```

#![cfg_attr(not(test), no_std)]

pub mod airframe;
pub mod autopilot;
pub mod board;
pub mod commander;
pub mod config;
pub mod control;
pub mod estimator;
pub mod failure;
pub mod frames;
pub mod guidance;
pub mod inner;
pub mod latest;
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
pub mod settings;
pub mod signals;
pub mod validate;
pub mod watchdog;
