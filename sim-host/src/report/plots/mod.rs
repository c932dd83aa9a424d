//! The figures of a flight, an analysis, a comparison and a search, as SVG files that any browser shows.
//!
//! ```text
//! Figures ─► tracking, rotors, inputs, path, disturbance, phases, estimate ─► Panel ─► page ─► svg ─► *.svg
//!                                                                │             │ axis: ranges, units, ticks
//!                                                 series: points of lines      │ backdrop: phases, faults, events
//! ```
//!
//! Rules, the same in every figure:
//! - A figure is named and titled by what it shows; its heading names scenario and seed.
//! - The reference is a wide light line below a thin dark one. Where both coincide, the error is drawn beside them.
//! - Axes have round ticks and a least span (`axis`), so that numerical noise is not blown up.
//! - Lines are interrupted where a reference jumps or an angle passes 180°. Long series are thinned without losing
//!   their peaks, so that a file stays below 300 kB.
//!
//! To draw another figure: make `Panel`s of `Points`, and hand them to
//! `grid` within `save`.

pub mod analysis;
mod axis;
mod backdrop;
pub mod comparison;
mod convergence;
mod disturbance;
mod estimate;
mod flight;
mod inputs;
mod page;
mod panel;
pub mod paper;
mod path;
mod phases;
mod rotors;
mod series;
mod space;
mod style;
mod svg;
mod tracking;

pub use self::convergence::convergence;
pub use self::flight::{Disturbance, Figures, Kind};

#[cfg(test)]
pub(super) mod tests;
