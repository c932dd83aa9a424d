//! The settings' store: a map from names to values in flash memory, which survives a power cut at any moment.
//!
//! Generic over the flash: a board's own, or a file on the desktop. A value is saved as an entry of its own, and the
//! entries go around a whole range, which levels the wear. There are two ranges, each with every value: a cut may leave
//! anything in the page that was being erased, but only in one of the two, and loading mends it by the other. Entries are
//! numbered, so that of two values the newer one counts: each setting has its old value or its new one. Names that are not
//! in the table any more stay where they are.
//!
//! The caller is the lowest priority there is, and calls [`Store::save_next`] while the vehicle is disarmed: a flash that
//! is erased may stall the bus for a second.

use core::ops::Range;
use core::pin::pin;
use core::task::{Context, Poll, Waker};

use embedded_storage_async::nor_flash::NorFlash;
use sequential_storage::Error;
use sequential_storage::cache::{Cache, Uncached};
use sequential_storage::map::{MapConfig, MapConfigError, MapStorage};

use super::{COUNT, NAME_MAX, SETTINGS, Setting, Settings, Value, find};

/// A name, filled up with zeros.
type Key = [u8; NAME_MAX];

/// Room for an entry, in whole words of any flash.
const ENTRY_MAX: usize = 64;

/// Error of the store.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StoreError {
    /// The flash cannot be read, written or erased.
    Flash,
    /// All entries together do not fit.
    Full,
    /// What the flash holds is no store, and cannot be repaired.
    Corrupted,
    /// The range of the flash does not fit its pages and words.
    Range,
}

impl<E> From<Error<E>> for StoreError {
    fn from(error: Error<E>) -> Self {
        match error {
            Error::Storage { .. } => Self::Flash,
            Error::FullStorage | Error::ItemTooBig => Self::Full,
            _ => Self::Corrupted,
        }
    }
}

impl From<MapConfigError> for StoreError {
    fn from(_: MapConfigError) -> Self {
        Self::Range
    }
}

/// What [`Store::load`] has found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Loaded {
    /// Values that were put back.
    pub values: usize,
    /// Values that were refused: out of the range that the setting has now, or not fitting together.
    pub refused: usize,
    /// Copies that a cut, or something else than this store, had left in disorder: one is rebuilt from the other.
    pub rebuilt: usize,
}

/// A store in a range of a flash, half of it for each copy.
pub struct Store<F: NorFlash> {
    flash: F,
    copies: [Range<u32>; 2],
    /// Number of the newest entry.
    newest: u32,
    buffer: Buffer,
}

/// Aligned, as some flash controllers read words from it.
#[repr(align(32))]
struct Buffer([u8; ENTRY_MAX]);

/// State of a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Page {
    Erased,
    Filling,
    Full,
    /// None of them.
    Torn,
}

/// An entry of each setting: its number in the upper half and its bits in the lower one; 0 for none.
type Entries = [u64; COUNT];

/// The number of an entry.
const fn number_of(entry: u64) -> u32 {
    (entry >> 32) as u32
}

/// One copy, without a cache: what a cut has left is looked at each time.
type Map<'a, F> = MapStorage<Key, &'a mut F, Cache<Uncached, Uncached, Uncached, Key>>;

impl<F: NorFlash> Store<F> {
    /// The store in this range, whole pages and four at least. A range that was erased is an empty store.
    ///
    /// # Errors
    /// [`StoreError::Range`].
    pub fn new(flash: F, range: Range<u32>) -> Result<Self, StoreError> {
        let half = range.len() as u32 / 2;
        let middle = range.start.saturating_add(half - half % F::ERASE_SIZE as u32);
        let copies = [range.start..middle, middle..range.end];
        for copy in &copies {
            MapConfig::<F>::try_new(copy.clone())?;
        }
        Ok(Self { flash, copies, newest: 0, buffer: Buffer([0; ENTRY_MAX]) })
    }

    /// Puts the stored values back into the settings, at the start of the firmware, and mends a copy that a cut has
    /// damaged.
    ///
    /// # Errors
    /// Why the store cannot be read or mended; the settings are as before then.
    pub async fn load(&mut self, settings: &mut Settings) -> Result<Loaded, StoreError> {
        let mut found: Entries = [0; COUNT];
        let mut rebuilt = 0;
        for copy in self.copies.clone() {
            if !self.is_settled(&copy).await? || self.read(&copy, &mut found).await == Err(StoreError::Corrupted) {
                // The other copy has all of it: an operation begins on one of them when it is complete on the other.
                self.map(&copy)?.0.erase_all().await?;
                rebuilt += 1;
            }
        }
        self.newest = found.iter().copied().map(number_of).max().unwrap_or(0);
        for copy in self.copies.clone() {
            self.mend(&copy, &found).await?;
        }
        let values = || {
            let rows = found.iter().zip(&SETTINGS).enumerate().filter(|(_, (entry, _))| **entry != 0);
            rows.map(|(index, (entry, setting))| (index, Value::from_bits(setting.kind(), *entry as u32)))
        };
        let refused = settings.restore_all(values());
        Ok(Loaded { values: values().count().saturating_sub(refused), refused, rebuilt })
    }

    fn map(&mut self, copy: &Range<u32>) -> Result<(Map<'_, F>, &mut [u8]), StoreError> {
        let map = MapStorage::new(&mut self.flash, MapConfig::try_new(copy.clone())?, Cache::new_uncached());
        Ok((map, &mut self.buffer.0))
    }

    /// Whether no operation on a copy was cut: all pages are erased, full or, at most one, being filled, and the one after
    /// that is erased. The store marks a page in use by its first word, and a full one by its last.
    async fn is_settled(&mut self, copy: &Range<u32>) -> Result<bool, StoreError> {
        let (mut filling, mut erased, mut after_filling) = (0, 0, true);
        let pages = || copy.clone().step_by(F::ERASE_SIZE);
        for page in pages() {
            let next = Some(page + F::ERASE_SIZE as u32).filter(|next| *next < copy.end).unwrap_or(copy.start);
            match self.page(page).await? {
                Page::Full => {}
                Page::Erased => erased += 1,
                Page::Filling => {
                    filling += 1;
                    after_filling &= self.page(next).await? == Page::Erased;
                }
                Page::Torn => return Ok(false),
            }
        }
        Ok(filling <= 1 && after_filling && erased > 0)
    }

    async fn page(&mut self, page: u32) -> Result<Page, StoreError> {
        const WORD_MAX: usize = 32;
        let word = usize::max(F::WRITE_SIZE, F::READ_SIZE);
        let Buffer(buffer) = &mut self.buffer;
        let end = page.saturating_add(F::ERASE_SIZE as u32);
        let word = buffer.get_mut(..word.min(WORD_MAX)).unwrap_or_default();
        let mut marks = [0; 2];
        for (mark, at) in marks.iter_mut().zip([page, end.saturating_sub(word.len() as u32)]) {
            self.flash.read(at, word).await.map_err(|_| StoreError::Flash)?;
            *mark = word.first().copied().filter(|first| word.iter().all(|byte| byte == first)).unwrap_or(1);
        }
        Ok(match marks {
            [0, 0] => Page::Full,
            [0, 0xff] => Page::Filling,
            [0xff, 0xff] => {
                for at in (page..end).step_by(word.len()) {
                    self.flash.read(at, word).await.map_err(|_| StoreError::Flash)?;
                    if word.iter().any(|byte| *byte != 0xff) {
                        return Ok(Page::Torn);
                    }
                }
                Page::Erased
            }
            _ => Page::Torn,
        })
    }

    /// Takes over the entries of a copy that are newer than those found so far.
    async fn read(&mut self, copy: &Range<u32>, found: &mut Entries) -> Result<(), StoreError> {
        let (mut map, buffer) = self.map(copy)?;
        let mut entries = map.fetch_all_items(buffer).await?;
        while let Some((key, entry)) = entries.next::<u64>(buffer).await? {
            if let Some(known) = index_of(&key).and_then(|index| found.get_mut(index))
                && number_of(entry) > number_of(*known)
            {
                *known = entry;
            }
        }
        Ok(())
    }

    /// Writes to a copy what it lacks.
    async fn mend(&mut self, copy: &Range<u32>, found: &Entries) -> Result<(), StoreError> {
        let mut own: Entries = [0; COUNT];
        self.read(copy, &mut own).await?;
        for ((setting, own), newest) in SETTINGS.iter().zip(own).zip(found) {
            if own != *newest {
                let (mut map, buffer) = self.map(copy)?;
                map.store_item(buffer, &key_of(setting), newest).await?;
            }
        }
        Ok(())
    }

    /// Saves a value.
    ///
    /// # Errors
    /// Why it was not saved: the old value is still there, or the new one already.
    pub async fn save(&mut self, index: usize, value: Value) -> Result<(), StoreError> {
        let Some(setting) = SETTINGS.get(index) else { return Ok(()) };
        self.newest = self.newest.saturating_add(1);
        let entry = u64::from(self.newest) << 32 | u64::from(value.bits());
        for copy in self.copies.clone() {
            let (mut map, buffer) = self.map(&copy)?;
            map.store_item(buffer, &key_of(setting), &entry).await?;
        }
        Ok(())
    }

    /// Saves one of the values that wait, unless the vehicle is armed. False if there was nothing to do.
    ///
    /// # Errors
    /// Why it was not saved: the value goes on waiting.
    pub async fn save_next(&mut self, settings: &mut Settings, armed: bool) -> Result<bool, StoreError> {
        let Some((index, value)) = settings.next_unsaved().filter(|_| !armed) else { return Ok(false) };
        self.save(index, value).await?;
        settings.saved(index, value);
        Ok(true)
    }

    /// The flash.
    pub fn flash(&mut self) -> &mut F {
        &mut self.flash
    }
}

fn key_of(setting: &Setting) -> Key {
    let mut key = Key::default();
    for (to, from) in key.iter_mut().zip(setting.name.bytes()) {
        *to = from;
    }
    key
}

fn index_of(key: &Key) -> Option<usize> {
    let length = key.iter().position(|byte| *byte == 0).unwrap_or(NAME_MAX);
    find(core::str::from_utf8(key.get(..length)?).ok()?)
}

/// Runs a task of the store to its end, for a caller that has nothing else to do: with a flash that waits for its
/// controller, it polls.
pub fn block_on<T>(task: impl Future<Output = T>) -> T {
    let mut task = pin!(task);
    let mut context = Context::from_waker(Waker::noop());
    loop {
        if let Poll::Ready(output) = task.as_mut().poll(&mut context) {
            return output;
        }
        core::hint::spin_loop();
    }
}

#[cfg(test)]
#[path = "store_tests.rs"]
pub(crate) mod tests;
