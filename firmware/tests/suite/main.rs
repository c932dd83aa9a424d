//! The integration tests of the firmware, one module per subject, in one executable: it is compiled and linked once.

#![expect(clippy::disallowed_methods, reason = "tests compare with bounds; what flies may not")]

mod autopilot;
mod by_hand;
mod flood;
mod goals;
mod hung;
mod latest;
mod mixer;
mod modes;
mod moving_start;
mod offboard;
mod orbit;
mod orders;
mod parameters;
mod radio;
mod settings;
mod sliding;
mod vehicle;
