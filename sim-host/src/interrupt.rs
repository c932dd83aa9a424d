//! Ctrl-C, and the signal that asks a program to end: a flight ends after its tick and is reported; the second time, the
//! program ends at once.

use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context as _, Result};

/// Exit code of a program that was interrupted: 128 + SIGINT, as shells have it.
pub const EXIT_CODE: u8 = 130;

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Lets flights end when the user asks for it. To be called once, by commands that look at [`requested`].
///
/// # Errors
/// When the system does not let signals be handled.
pub fn listen() -> Result<()> {
    let handler = || {
        if REQUESTED.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(EXIT_CODE));
        }
    };
    ctrlc::set_handler(handler).context("cannot handle Ctrl-C")
}

/// Asks for an end, as the user would: when nobody reads what is printed any more.
pub fn request() {
    REQUESTED.store(true, Ordering::Relaxed);
}

/// Whether the user has asked for an end.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

/// What a command returns once it has reported what was flown before it was interrupted.
#[derive(Clone, Copy, Debug)]
pub struct Interrupted;

impl std::fmt::Display for Interrupted {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("interrupted")
    }
}

impl std::error::Error for Interrupted {}
