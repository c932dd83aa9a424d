//! Settings on their way from the ground partition to the flash.
//!
//! Writing to a flash takes milliseconds, and erasing a page perhaps a second, so idle does it, in no task's way. The ground
//! partition owns the settings; [`Saving`] carries one value at a time to idle, and back that it was saved.

use embedded_storage_async::nor_flash::NorFlash;
use rtic_core::Mutex;

use crate::settings::store::{Store, StoreError, block_on};
use crate::settings::{Settings, Value};

/// A value between the ground partition and idle; shared by them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Saving {
    /// There is none.
    #[default]
    Nothing,
    /// To be saved: its index in the table, and the value.
    Wanted(usize, Value),
    /// Idle is saving it.
    Busy,
    /// It is in the flash.
    Saved(usize, Value),
}

impl Saving {
    /// The ground partition's side, after each job: notes what was saved, and gives the next value that waits, unless the
    /// vehicle is armed.
    pub(super) fn exchange(&mut self, settings: &mut Settings, armed: bool) {
        if let Self::Saved(index, value) = *self {
            settings.saved(index, value);
        }
        if *self != Self::Busy {
            let next = settings.next_unsaved().filter(|_| !armed);
            *self = next.map_or(Self::Nothing, |(index, value)| Self::Wanted(index, value));
        }
    }
}

/// Idle's side.
pub struct Keeper<F: NorFlash> {
    store: Store<F>,
}

impl<F: NorFlash> Keeper<F> {
    /// Keeps settings in a store from which they were [loaded](Store::load) at the start.
    pub fn new(store: Store<F>) -> Self {
        Self { store }
    }

    /// Saves a value that waits, if any.
    ///
    /// # Errors
    /// Why it was not saved: it goes on waiting. A flash that fails again and again should not be tried for ever.
    pub fn run(&mut self, mut saving: impl Mutex<T = Saving>) -> Result<(), StoreError> {
        let wanted = saving.lock(|saving| match *saving {
            Saving::Wanted(index, value) => {
                *saving = Saving::Busy;
                Some((index, value))
            }
            _ => None,
        });
        let Some((index, value)) = wanted else { return Ok(()) };
        let result = block_on(self.store.save(index, value));
        let after = if result.is_ok() { Saving::Saved(index, value) } else { Saving::Nothing };
        saving.lock(|saving| *saving = after);
        result
    }
}
