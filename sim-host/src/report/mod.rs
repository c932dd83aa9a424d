//! What a person or a script gets from a flight.
pub mod angles;
pub mod metrics;
pub mod truth;
