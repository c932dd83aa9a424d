//! Glissade on the desktop: the world that the firmware flies in, and the front end to it.

pub mod record;
pub mod report;
