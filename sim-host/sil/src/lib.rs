//! Software in the loop: the firmware in lockstep with a plant, on its sensors, in its weather.
//!
//! All that decides a flight, its rows and its contacts with the ground; nothing that reads scenarios, writes or draws:
//! those are `sim-host`'s. What a scenario may ask for is compiled here, whole and once ([`AnyFlight`]), so that the rest
//! can be built for speed of building.

#![cfg_attr(
    test,
    allow(clippy::disallowed_methods, reason = "tests compare with bounds; what decides a flight may not")
)]

pub mod airframe;
pub mod angles;
mod any;
pub mod baseline;
pub mod controller;
pub mod decoupled;
mod delay;
pub mod failures;
pub mod geodesy;
mod lockstep;
pub mod noise;
pub mod outcome;
pub mod pilot;
pub mod plant;
pub mod record;
pub mod reference;
pub mod replay;
pub mod sensors;
pub mod touchdown;
pub mod weather;
pub mod world;

pub use any::{AnyFlight, UnderLaws};
pub use delay::DELAY_TICKS_MAX;
pub use lockstep::{Flight, Lockstep, Restart};
pub use outcome::{End, Outcome};
