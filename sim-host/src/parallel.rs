//! Work on all threads of the current pool.

use std::sync::Mutex;

use anyhow::Result;
use rayon::iter::{IntoParallelIterator as _, ParallelIterator as _};

/// `work` on every item, on all threads. The results are in the order of the items, whichever thread was first.
pub(crate) fn map<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let results: Vec<Mutex<Option<R>>> = items.iter().map(|_| Mutex::new(None)).collect();
    each(items.len(), &|i| {
        let result = work(&items[i]);
        // Only this call has the slot, so that it is neither waited for nor poisoned.
        if let Ok(mut slot) = results[i].lock() {
            *slot = Some(result);
        }
    });
    results.into_iter().filter_map(|slot| slot.into_inner().ok().flatten()).collect()
}

/// The same of work that can fail.
///
/// # Errors
/// That of the first item that failed, in the order of the items.
pub(crate) fn try_map<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> Result<R> + Sync) -> Result<Vec<R>> {
    map(items, work).into_iter().collect()
}

/// All lists go through here: rayon's machinery is compiled once and not for every kind of work.
fn each(count: usize, work: &(dyn Fn(usize) + Sync)) {
    (0..count).into_par_iter().for_each(work);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_keep_the_order_of_the_items_and_none_is_lost() {
        let items: Vec<u64> = (0..1000).collect();
        // Early items take longest.
        let slow = |item: &u64| {
            (0..(1000 - item) * 50).for_each(|step| _ = std::hint::black_box(step));
            item * 2
        };
        assert_eq!(map(&items, slow), items.iter().map(|item| item * 2).collect::<Vec<_>>());
        assert!(map(&[] as &[u64], slow).is_empty());
    }
}
