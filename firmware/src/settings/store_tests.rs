//! The store against power cuts: at every word of every write, and in every erase.

use embedded_storage_async::nor_flash::{ErrorType, NorFlashError, NorFlashErrorKind, ReadNorFlash};

use super::*;
use crate::config::FlightConfig;

const PAGE: usize = 512;
const PAGES: usize = 6;

/// What a cut leaves of the word that was being written, or of the page that was being erased.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Torn {
    /// Nothing has happened yet.
    Before,
    /// The first half.
    Half,
    /// The other half.
    Other,
    /// The middle.
    Middle,
    /// Some of the bits, anywhere.
    Random,
    /// All of it, but nobody was told.
    After,
}

const TORN: [Torn; 6] = [Torn::Before, Torn::Half, Torn::Other, Torn::Middle, Torn::Random, Torn::After];

impl Torn {
    /// The bits that have changed of a byte of a word or a page.
    fn mask(self, at: usize, of: usize) -> u8 {
        match self {
            Self::Before => 0,
            Self::Half => {
                if at < of / 2 {
                    0xff
                } else {
                    0
                }
            }
            Self::Other => {
                if at < of / 2 {
                    0
                } else {
                    0xff
                }
            }
            Self::Middle => {
                if at < of / 4 || at >= of - of / 4 {
                    0
                } else {
                    0xff
                }
            }
            Self::Random => (at as u32 + 1).wrapping_mul(0x9e37_79b1).to_be_bytes()[0],
            Self::After => 0xff,
        }
    }
}

/// A flash in memory with words of `WORD` bytes, whose power fails after a number of operations: a word written is one,
/// and so is a page erased.
#[derive(Clone, Debug)]
pub(crate) struct Flash<const WORD: usize> {
    bytes: Vec<u8>,
    written: Vec<bool>,
    /// Operations until the cut.
    left: Option<u32>,
    torn: Torn,
    operations: u32,
    erased: [u32; PAGES],
}

#[derive(Debug)]
pub(crate) struct NoPower;

impl NorFlashError for NoPower {
    fn kind(&self) -> NorFlashErrorKind {
        NorFlashErrorKind::Other
    }
}

impl<const WORD: usize> Flash<WORD> {
    pub(crate) fn new() -> Self {
        let (bytes, written) = (vec![0xff; PAGE * PAGES], vec![false; PAGE * PAGES / WORD]);
        Self { bytes, written, left: None, torn: Torn::Before, operations: 0, erased: [0; PAGES] }
    }

    /// Counts an operation; what is left of it at the cut.
    fn operate(&mut self) -> Result<(), Torn> {
        match &mut self.left {
            // Nothing happens after the cut.
            Some(0) => Err(core::mem::replace(&mut self.torn, Torn::Before)),
            Some(left) => {
                *left -= 1;
                self.operations += 1;
                Ok(())
            }
            None => {
                self.operations += 1;
                Ok(())
            }
        }
    }
}

impl<const WORD: usize> ErrorType for Flash<WORD> {
    type Error = NoPower;
}

impl<const WORD: usize> ReadNorFlash for Flash<WORD> {
    const READ_SIZE: usize = 1;

    async fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), NoPower> {
        let offset = offset as usize;
        bytes.copy_from_slice(&self.bytes[offset..offset + bytes.len()]);
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.bytes.len()
    }
}

impl<const WORD: usize> NorFlash for Flash<WORD> {
    const WRITE_SIZE: usize = WORD;
    const ERASE_SIZE: usize = PAGE;

    async fn erase(&mut self, from: u32, to: u32) -> Result<(), NoPower> {
        let (from, to) = (from as usize, to as usize);
        assert!(from.is_multiple_of(PAGE) && to.is_multiple_of(PAGE) && to <= self.bytes.len());
        for page in (from..to).step_by(PAGE) {
            let torn = self.operate().err();
            for at in page..page + PAGE {
                let done = torn.map_or(0xff, |torn| torn.mask(at - page, PAGE));
                self.bytes[at] |= done;
                self.written[at / WORD] &= self.bytes[at / WORD * WORD..][..WORD].iter().any(|byte| *byte != 0xff);
            }
            if torn.is_some() {
                return Err(NoPower);
            }
            self.erased[page / PAGE] += 1;
        }
        Ok(())
    }

    async fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), NoPower> {
        let offset = offset as usize;
        assert!(offset.is_multiple_of(WORD) && bytes.len().is_multiple_of(WORD));
        for (at, word) in (offset..).step_by(WORD).zip(bytes.chunks(WORD)) {
            let torn = self.operate().err();
            if torn == Some(Torn::Before) {
                return Err(NoPower);
            }
            // After a cut the store completes a mark that may be torn: bits that are clear are cleared again.
            let old = &self.bytes[at..at + WORD];
            let repeats = old.iter().zip(word).all(|(old, new)| old & new == *new);
            assert!(!self.written[at / WORD] || repeats, "bits are set by an erase alone");
            self.written[at / WORD] = true;
            for (i, byte) in word.iter().enumerate() {
                let done = torn.map_or(0xff, |torn| torn.mask(i, WORD));
                self.bytes[at + i] &= byte | !done;
            }
            if torn.is_some() {
                return Err(NoPower);
            }
        }
        Ok(())
    }
}

fn store<const WORD: usize>(flash: Flash<WORD>) -> Store<Flash<WORD>> {
    Store::new(flash, 0..(PAGE * PAGES) as u32).expect("whole pages")
}

fn defaults() -> Settings {
    Settings::of(&FlightConfig::default())
}

/// The `step`th value of a session that sets a few settings over and over.
fn session(step: u32) -> (usize, Value) {
    let names = ["MPC_XY_CRUISE", "MAV_SYS_ID", "SMC_PITCH_LAMBDA", "GL_MASS", "SYS_AUTOSTART"];
    let index = find(names[step as usize % names.len()]).expect("in the table");
    let value = match defaults().get(index).expect("a value") {
        Value::Int(_) => Value::Int(1 + (step % 200).cast_signed()),
        Value::Real(_) => Value::Real(1.0 + step as f32 * 0.01),
    };
    (index, value)
}

/// Plays a session until its end or a cut. Returns the settings as they were saved, and the one that was being saved.
fn play<const WORD: usize>(
    flash: &mut Flash<WORD>,
    steps: core::ops::Range<u32>,
) -> (Settings, Option<(usize, Value)>) {
    let mut saved = defaults();
    let mut store = store(flash.clone());
    let mut cut = None;
    block_on(store.load(&mut saved)).expect("readable");
    for step in steps {
        let (index, value) = session(step);
        if block_on(store.save(index, value)).is_err() {
            cut = Some((index, value));
            break;
        }
        saved.restore(index, value).expect("in range");
    }
    flash.clone_from(store.flash());
    (saved, cut)
}

/// Cuts a session of `steps` at every operation, and asks for what is left of it.
fn cut_everywhere<const WORD: usize>(steps: u32) -> Flash<WORD> {
    let mut whole = Flash::<WORD>::new();
    play(&mut whole, 0..steps);
    for at in 0..whole.operations {
        for torn in TORN {
            let mut flash = Flash::<WORD> { left: Some(at), torn, ..Flash::new() };
            let (saved, cut) = play(&mut flash, 0..steps);
            let (index, new) = cut.expect("cut");
            flash.left = None;
            // The power comes back.
            let mut had = defaults();
            let mut again = store(flash);
            let loaded = block_on(again.load(&mut had));
            assert!(matches!(loaded, Ok(Loaded { refused: 0, rebuilt: 0..=1, .. })), "{at} {torn:?}: {loaded:?}");
            for (i, setting) in SETTINGS.iter().enumerate() {
                let now = had.get(i);
                let is_either = now == saved.get(i) || (i == index && now == Some(new));
                assert!(is_either, "{at} {torn:?}: {} is {now:?}", setting.name);
            }
            // And it goes on working, around all pages once more.
            let mut flash = again.flash().clone();
            let (end, cut) = play(&mut flash, steps..steps + steps / 2);
            assert_eq!(cut, None, "{at} {torn:?}");
            let mut last = defaults();
            block_on(store(flash).load(&mut last)).expect("readable");
            assert_eq!(last, end, "{at} {torn:?}");
        }
    }
    whole
}

#[test]
fn a_cut_at_any_word_leaves_the_old_value_or_the_new_one() {
    // Around all pages: 36 to 64 bytes an entry.
    let whole = cut_everywhere::<4>(60);
    assert!(whole.erased.iter().sum::<u32>() >= 4, "{:?}", whole.erased);
    cut_everywhere::<8>(50);
    cut_everywhere::<32>(30);
}

#[test]
fn a_cut_during_the_repair_after_a_cut_loses_nothing_either() {
    const STEPS: u32 = 70;
    let mut whole = Flash::<4>::new();
    play(&mut whole, 0..STEPS);
    for at in (0..whole.operations).step_by(7) {
        for second in 0..40 {
            let torn = TORN[(second as usize + at as usize) % TORN.len()];
            let mut flash = Flash::<4> { left: Some(at), torn, ..Flash::new() };
            let (saved, cut) = play(&mut flash, 0..STEPS);
            let (index, new) = cut.expect("cut");
            let mut again = store(Flash { left: Some(second), ..flash });
            let _ = block_on(again.load(&mut defaults()));
            let _ = block_on(again.save(index, new));
            let mut had = defaults();
            let flash = Flash { left: None, ..again.flash().clone() };
            block_on(store(flash).load(&mut had)).expect("readable");
            for (i, setting) in SETTINGS.iter().enumerate() {
                let now = had.get(i);
                let is_either = now == saved.get(i) || (i == index && now == Some(new));
                assert!(is_either, "{at} {second} {torn:?}: {} is {now:?}", setting.name);
            }
        }
    }
}

#[test]
fn values_wait_while_the_vehicle_is_armed_and_are_saved_then() {
    let mut store = store(Flash::<4>::new());
    let mut settings = defaults();
    for step in 0..5 {
        let (index, value) = session(step);
        settings.set(index, value, false).expect("in range");
    }
    assert_eq!(block_on(store.save_next(&mut settings, true)), Ok(false));
    let mut count = 0;
    while block_on(store.save_next(&mut settings, false)) == Ok(true) {
        count += 1;
    }
    assert_eq!(count, 5);
    let mut had = defaults();
    assert_eq!(block_on(store.load(&mut had)), Ok(Loaded { values: 5, refused: 0, rebuilt: 0 }));
    for index in 0..COUNT {
        assert_eq!(had.get(index), settings.get(index));
    }
}

#[test]
fn a_page_that_looks_erased_at_its_ends_alone_is_found_and_rebuilt() {
    let mut flash = Flash::<4>::new();
    let (saved, _) = play(&mut flash, 0..5);
    // The last page of the first half, which a cut has left half erased.
    let page = 2 * PAGE;
    assert!(flash.bytes[page..page + PAGE].iter().all(|byte| *byte == 0xff), "not used yet");
    let middle = page + PAGE / 2;
    (flash.bytes[middle], flash.written[middle / 4]) = (0x5a, true);
    let mut had = defaults();
    let mut again = store(flash);
    assert_eq!(block_on(again.load(&mut had)), Ok(Loaded { values: 5, refused: 0, rebuilt: 1 }));
    assert_eq!(had, saved);
    assert_eq!(again.flash().bytes[middle], 0xff);
}

#[test]
fn all_pages_wear_alike() {
    let mut flash = Flash::<4>::new();
    assert_eq!(Store::new(flash.clone(), 0..100).map(|_| ()).err(), Some(StoreError::Range));
    let (_, cut) = play(&mut flash, 0..2_000);
    assert_eq!(cut, None);
    let (least, most) = (flash.erased.iter().min().expect("pages"), flash.erased.iter().max().expect("pages"));
    assert!(most - least <= 1 && *least > 20, "{:?}", flash.erased);
}

#[test]
fn values_that_do_not_fit_any_more_are_refused() {
    let mut store = store(Flash::<4>::new());
    let wild = [("MPC_XY_CRUISE", Value::Real(1e6)), ("GL_YAW_1", Value::Real(0.0)), ("GL_YAW_2", Value::Real(0.0))];
    for (name, value) in wild.into_iter().chain([("GL_YAW_3", Value::Real(0.0)), ("GL_YAW_4", Value::Real(0.0))]) {
        block_on(store.save(find(name).expect("in the table"), value)).expect("saved");
    }
    let mut settings = defaults();
    assert_eq!(block_on(store.load(&mut settings)), Ok(Loaded { values: 0, refused: 5, rebuilt: 0 }));
    assert_eq!(settings, defaults());
}
