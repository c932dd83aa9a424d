//! What a person or a script gets from a flight.
pub mod angles;
pub mod metrics;
pub mod plots;
pub mod progress;
pub mod summary;
pub mod table;
pub mod truth;
