//! The integration tests of the simulator, one module per subject, in one executable: whole flights are compiled and
//! linked once. Only what needs a process of its own is a test file beside this folder.

#![expect(clippy::disallowed_methods, reason = "tests compare with bounds; what decides a flight may not")]

mod common;

mod analyse;
mod any_flight;
mod baselines;
mod cli;
mod console;
mod control_laws;
mod day;
mod determinism;
mod effects;
mod endings;
mod fault_schedules;
mod flights;
mod hands;
mod landing;
mod messages;
mod no_panic;
mod own_sensors;
mod paper_cases;
mod paper_command;
mod physics;
#[cfg(unix)]
mod pil;
mod random_flights;
mod replay;
mod sensor_flights;
mod sensor_streams;
mod set_points;
mod stick_steps;
mod telemetry;
mod trajectories;
#[cfg(feature = "search")]
mod tune;
mod world;
