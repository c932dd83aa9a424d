//! The settings of the terminal while its keys are read one by one: no echo, no line editing.
//!
//! They are the terminal's and not this process's, so whatever ends or stops the process has to put them back, or the
//! shell would go on without an echo: the end of `serve`, a panic, a signal that ends it at once, and Ctrl-Z, after which
//! they are taken again. The signals are `interrupt`'s.

use std::io::stdin;
use std::sync::{Mutex, MutexGuard, Once, PoisonError};

use rustix::process::getpgrp;
use rustix::termios::{LocalModes, OptionalActions, Termios, tcgetattr, tcgetpgrp, tcsetattr};

/// The settings before, while they are changed.
static BEFORE: Mutex<Option<Termios>> = Mutex::new(None);
/// Whether a panic puts them back.
static GUARDED: Once = Once::new();

fn before() -> MutexGuard<'static, Option<Termios>> {
    BEFORE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Switches off echo and line editing of the terminal on standard input, until [`give_back`]. False if there is none.
pub(crate) fn take() -> bool {
    let Ok(settings) = tcgetattr(stdin()) else { return false };
    if !change(before().get_or_insert(settings)) {
        *before() = None;
        return false;
    }
    GUARDED.call_once(|| {
        let others = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            give_back();
            others(panic);
        }));
    });
    true
}

/// Puts the settings back as they were, if they are changed.
pub(crate) fn give_back() {
    put_back(before().take().as_ref());
}

/// Lets the shell have the terminal as it was, for as long as `stopped` takes.
pub(crate) fn lend(stopped: impl FnOnce()) {
    put_back(before().as_ref());
    stopped();
    take_again();
}

/// Changes the settings again after the process was stopped. In the background the terminal is somebody else's.
pub(crate) fn take_again() {
    if let (Some(settings), Ok(group)) = (before().as_ref(), tcgetpgrp(stdin()))
        && group == getpgrp()
    {
        change(settings);
    }
}

fn change(settings: &Termios) -> bool {
    let mut changed = settings.clone();
    changed.local_modes -= LocalModes::ECHO | LocalModes::ICANON;
    tcsetattr(stdin(), OptionalActions::Now, &changed).is_ok()
}

fn put_back(settings: Option<&Termios>) {
    if let Some(settings) = settings {
        let _ = tcsetattr(stdin(), OptionalActions::Now, settings);
    }
}
