//! What a person or a script gets from a flight.
pub mod truth;
