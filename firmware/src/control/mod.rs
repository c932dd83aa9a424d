//! The control laws: pure functions of their gains and inputs, as they stand in the paper.
//!
//! [`sliding`] owns the surfaces and reaching laws, [`position`] Eq. 28–31, [`flatness`] the way from a force
//! and its derivatives to angles and theirs (Eq. 11), [`attitude`] Eq. 25–27, [`mixer`] the inverse of Eq. 4.

pub mod attitude;
pub mod flatness;
pub mod mixer;
pub mod position;
pub mod sliding;
