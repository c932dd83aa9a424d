//! The paper's simulations, flown and held against what the paper says of them.

pub mod claims;
