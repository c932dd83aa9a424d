//! Glissade on the desktop: the world that the firmware flies in, and the front end to it.

#[cfg(unix)]
pub mod pil;
pub mod record;
