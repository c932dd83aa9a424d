//! A set of settings, by index.

use super::rows::COUNT;

const WORDS: usize = COUNT.div_ceil(32);

/// A bit for each setting.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Marks {
    words: [u32; WORDS],
}

impl Marks {
    /// Adds one.
    pub(crate) fn set(&mut self, index: usize) {
        if let Some(word) = self.words.get_mut(index / 32) {
            *word |= 1 << (index % 32);
        }
    }

    /// Removes one.
    pub(crate) fn clear(&mut self, index: usize) {
        if let Some(word) = self.words.get_mut(index / 32) {
            *word &= !(1 << (index % 32));
        }
    }

    /// Whether it is in the set.
    pub(crate) fn has(&self, index: usize) -> bool {
        self.words.get(index / 32).is_some_and(|word| word & (1 << (index % 32)) != 0)
    }

    /// The one with the least index.
    pub(crate) fn first(&self) -> Option<usize> {
        let word = self.words.iter().position(|word| *word != 0)?;
        Some(word * 32 + self.words.get(word)?.trailing_zeros() as usize)
    }

    /// The next one from an index on, going round.
    pub(crate) fn next_from(&self, index: usize) -> Option<usize> {
        let first = self.first()?;
        Some((index..COUNT).find(|index| self.has(*index)).unwrap_or(first))
    }
}
