//! Ctrl-C (SIGINT), SIGTERM, SIGHUP (its terminal is closed) and SIGQUIT. A command that [`listen`]s ends its flight after
//! a tick and reports it; the second signal (but SIGHUP), or the first in any other command, ends the program at once.
//! Folders that are not whole are removed either way, and a terminal is left as it was, also while Ctrl-Z stops the program.

use std::fs;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

use anyhow::{Context as _, Result};
use signal_hook::consts::{SIGCONT, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGTSTP};
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;

use crate::tty;

/// The signal that asked for an end; 0 before.
static REQUESTED: AtomicI32 = AtomicI32::new(0);
/// Whether the command looks at [`requested`].
static LISTENING: AtomicBool = AtomicBool::new(false);
/// Folders that are not whole.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Handles the signals from now on, in a thread of its own. To be called once, when the program starts. SIGHUP and
/// SIGQUIT stay ignored where they are, so that `nohup` works.
///
/// # Errors
/// When the system does not let signals be handled.
pub fn handle_signals() -> Result<()> {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let further = [SIGHUP, SIGQUIT, SIGTSTP].into_iter().filter(|signal| !ignores(&status, *signal));
    let mut signals =
        Signals::new([SIGINT, SIGTERM, SIGCONT].into_iter().chain(further)).context("cannot handle Ctrl-C")?;
    thread::spawn(move || signals.forever().for_each(handle));
    Ok(())
}

/// Whether a process ignores a signal, by its status in `/proc`; also where nothing says so.
fn ignores(status: &str, signal: i32) -> bool {
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_none_or(|mask| mask >> (signal - 1) & 1 == 1)
}

/// Promises that the command looks at [`requested`] and ends by itself.
pub fn listen() {
    LISTENING.store(true, Ordering::Relaxed);
}

fn handle(signal: i32) {
    match signal {
        SIGTSTP => tty::lend(|| drop(emulate_default_handler(SIGTSTP))),
        // Stopped by something else than Ctrl-Z.
        SIGCONT => tty::take_again(),
        _ => end(signal),
    }
}

fn end(signal: i32) {
    let before = REQUESTED.swap(signal, Ordering::Relaxed);
    if ends_at_once(before, signal) || !LISTENING.load(Ordering::Relaxed) {
        // Held until the end, so that no further folder is begun.
        let folders = unfinished();
        folders.iter().for_each(|folder| remove(folder));
        tty::give_back();
        process::exit(i32::from(exit_code()));
    }
}

/// Whether a signal is a second one, after another or 0. A terminal that is closed makes several: SIGHUP of the system and of
/// the shell, and nothing can be printed any more, which asks for an end too.
fn ends_at_once(before: i32, signal: i32) -> bool {
    before != 0 && signal != SIGHUP
}

/// Removes a folder, also while a flight still writes into it.
fn remove(folder: &Path) {
    const ATTEMPTS: usize = 5;
    for _ in 0..ATTEMPTS {
        if fs::remove_dir_all(folder).is_ok() {
            return;
        }
    }
}

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Registers a folder to be removed if the program is ended at once.
pub fn begin_folder(folder: &Path) {
    unfinished().push(folder.to_owned());
}

/// The folder is whole or removed.
pub fn end_folder(folder: &Path) {
    unfinished().retain(|other| other != folder);
}

/// Asks for an end, as Ctrl-C does: when nobody reads what is printed any more.
pub fn request() {
    let _ = REQUESTED.compare_exchange(0, SIGINT, Ordering::Relaxed, Ordering::Relaxed);
}

/// Whether the user has asked for an end.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed) != 0
}

/// Exit code of a program that was interrupted, as shells have it: 128 + the signal, 130 for Ctrl-C, 143 for SIGTERM,
/// 129 for SIGHUP, 131 for SIGQUIT.
pub fn exit_code() -> u8 {
    u8::try_from(128 + REQUESTED.load(Ordering::Relaxed)).unwrap_or(u8::MAX)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_second_signal_ends_at_once_but_for_those_of_a_closed_terminal() {
        let ends = |(before, signal)| ends_at_once(before, signal);
        assert_eq!([(0, SIGINT), (0, SIGHUP), (SIGINT, SIGHUP), (SIGHUP, SIGHUP)].map(ends), [false; 4]);
        assert_eq!([(SIGINT, SIGINT), (SIGHUP, SIGTERM), (SIGINT, SIGQUIT)].map(ends), [true; 3]);
    }

    #[test]
    fn a_signal_that_is_ignored_stays_so() {
        let status = "Name:\tsim-host\nSigBlk:\t0000000000000000\nSigIgn:\t0000000000001001\nSigCgt:\t00\n";
        assert_eq!([SIGHUP, SIGINT, SIGQUIT].map(|signal| ignores(status, signal)), [true, false, false]);
        assert!(ignores("", SIGHUP), "where it is not known");
    }
}
