//! Glissade on the desktop: the world that the firmware flies in, and the front end to it.

#![cfg_attr(
    test,
    allow(clippy::disallowed_methods, reason = "tests compare with bounds; what decides a flight may not")
)]

pub mod airframe;
pub mod analyse;
pub mod assess;
pub mod baseline;
pub mod cli;
pub mod compare;
pub mod console;
pub mod controller;
pub mod decoupled;
pub mod failures;
mod files;
pub mod flight;
pub mod geodesy;
pub mod interrupt;
pub mod link;
pub mod matrix;
pub mod noise;
pub mod paper;
pub mod pil;
pub mod pilot;
pub mod plan;
pub mod plant;
pub mod record;
pub mod reference;
mod refusal;
pub mod report;
pub mod scenario;
pub mod score;
pub mod seeds;
pub mod sensors;
pub mod serve;
pub mod sil;
pub mod spline;
pub mod stations;
pub mod statistics;
pub mod sweep;
pub mod tune;
pub mod weather;
