//! Ctrl-C: asks for the end once, and ends at once the second time.

use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context as _, Result};

/// Exit code of a program that Ctrl-C has ended: 128 and the signal's number.
pub(super) const EXIT_CODE: u8 = 130;

static STOP: AtomicBool = AtomicBool::new(false);

/// From now on, Ctrl-C sets what is returned instead of ending the program.
///
/// # Errors
/// The system's; and if this has been done before.
pub(super) fn watch() -> Result<&'static AtomicBool> {
    let stop = || {
        if STOP.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(EXIT_CODE));
        }
    };
    ctrlc::set_handler(stop).context("cannot watch for Ctrl-C")?;
    Ok(&STOP)
}

/// The end that was asked for: no complaint, but an exit code of its own.
#[derive(Debug)]
pub(super) struct Interrupted;

impl fmt::Display for Interrupted {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("interrupted")
    }
}

impl std::error::Error for Interrupted {}
