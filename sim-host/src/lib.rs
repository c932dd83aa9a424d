//! Glissade on the desktop: the simulator, in which the firmware flies in lockstep, and its command line.
//!
//! # Example
//!
//! Load a built-in scenario, override a setting, fly it, and evaluate its rows:
//!
//! ```
//! use sim_host::record::Row;
//! use sim_host::{flight, scenario::Scenario};
//!
//! let scenario = Scenario::load("x500-hover", &["duration_s=2.0".into()])?;
//! let mut rows: Vec<Row> = Vec::new();
//! let outcome = flight::fly(&scenario, 1, &mut rows)?;
//!
//! // One row per tick of 1 ms, with the truth and the reference.
//! assert!(outcome.survived() && outcome.ticks == 2_000);
//! let last = rows.last().expect("a row per tick");
//! assert!((last.position[2] - last.reference[2]).abs() < 1e-3);
//! # Ok::<(), anyhow::Error>(())
//! ```
//!
//! A [`Recorder`](record::Recorder) of your own evaluates rows while they are flown, without storing them:
//!
//! ```
//! use sim_host::record::{Recorder, Row};
//! use sim_host::{flight, scenario::Scenario};
//!
//! /// The greatest commanded rotor speed, rad/s.
//! #[derive(Default)]
//! struct Fastest(f64);
//!
//! impl Recorder for Fastest {
//!     fn record(&mut self, row: &Row) {
//!         self.0 = row.omega_command.iter().fold(self.0, |fastest, omega| fastest.max(*omega));
//!     }
//! }
//!
//! let scenario = Scenario::load("x500-hover", &["duration_s=1.0".into()])?;
//! let mut fastest = Fastest::default();
//! flight::fly(&scenario, 1, &mut fastest)?;
//! let limit = f64::from(scenario.flight_config().airframe.omega_max_rad_s);
//! assert!(fastest.0 > 0.0 && fastest.0 <= limit);
//! # Ok::<(), anyhow::Error>(())
//! ```

// They panic when nobody reads.
#![warn(clippy::print_stdout, clippy::print_stderr)]
#![cfg_attr(
    test,
    allow(clippy::disallowed_methods, reason = "tests compare with bounds; what decides a flight may not")
)]

pub mod analyse;
pub mod assess;
pub mod cli;
pub mod compare;
pub mod console;
pub mod failures;
pub mod flash_file;
pub mod flight;
pub mod hands;
pub mod interrupt;
pub mod link;
pub mod matrix;
pub mod paper;
mod parallel;
pub mod pil;
#[cfg(feature = "search")]
pub mod plan;
pub mod recording;
pub mod report;
pub mod scenario;
pub mod score;
pub mod seeds;
pub mod serve;
pub mod spline;
pub mod stations;
pub mod statistics;
pub mod sweep;
pub mod truth;
mod tty;
pub mod tune;

use glissade_files::{files, refusal, words};
pub use glissade_sil as sil;
pub use glissade_sil::{
    airframe, angles, baseline, controller, decoupled, geodesy, noise, outcome, pilot, plant, record, reference,
    sensors, touchdown, weather, world,
};
