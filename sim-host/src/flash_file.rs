//! A file as a flash memory: pages that are erased to ones, and words of which a write only clears bits.
//!
//! The firmware's store of settings runs on it as on a board's flash. A header tells such a file from any other.

use std::fs::{File, OpenOptions};
use std::os::unix::fs::FileExt as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, anyhow, ensure};
use embedded_storage_async::nor_flash::{ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash};
use firmware::settings::store::{Loaded, Store, StoreError, block_on};
use firmware::settings::{SETTINGS, Settings};

const HEADER: &[u8; 16] = b"glissade params\n";
/// Bytes of a page, and of the whole: all settings fit into half of it several times.
const PAGE: usize = 4096;
const SIZE: usize = 16 * PAGE;

/// The memory.
#[derive(Debug)]
pub struct FlashFile {
    file: File,
}

/// Why an operation on the memory failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FlashError(NorFlashErrorKind);

impl From<NorFlashErrorKind> for FlashError {
    fn from(kind: NorFlashErrorKind) -> Self {
        Self(kind)
    }
}

impl From<std::io::Error> for FlashError {
    fn from(_: std::io::Error) -> Self {
        Self(NorFlashErrorKind::Other)
    }
}

impl NorFlashError for FlashError {
    fn kind(&self) -> NorFlashErrorKind {
        self.0
    }
}

impl FlashFile {
    /// Opens a file, or creates one that is erased.
    fn open(path: &Path) -> Result<Self> {
        let is_new = !path.exists();
        let file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)?;
        let flash = Self { file };
        if is_new {
            flash.file.write_all_at(&vec![0xff; SIZE], HEADER.len() as u64)?;
            flash.file.write_all_at(HEADER, 0)?;
        }
        let mut header = [0; HEADER.len()];
        let has_header = flash.file.read_exact_at(&mut header, 0).is_ok() && header == *HEADER;
        let length = flash.file.metadata()?.len();
        ensure!(has_header && length == (HEADER.len() + SIZE) as u64, "is no file of parameters");
        Ok(flash)
    }

    /// Refuses what is not in whole units, or outside.
    fn check(from: u32, length: usize, unit: usize) -> Result<(), FlashError> {
        let from = from as usize;
        if !from.is_multiple_of(unit) || !length.is_multiple_of(unit) {
            return Err(NorFlashErrorKind::NotAligned.into());
        }
        let fits = from.checked_add(length).is_some_and(|end| end <= SIZE);
        if fits { Ok(()) } else { Err(NorFlashErrorKind::OutOfBounds.into()) }
    }

    fn at(offset: u32) -> u64 {
        HEADER.len() as u64 + u64::from(offset)
    }
}

impl ErrorType for FlashFile {
    type Error = FlashError;
}

impl ReadNorFlash for FlashFile {
    const READ_SIZE: usize = 1;

    async fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), FlashError> {
        Self::check(offset, bytes.len(), Self::READ_SIZE)?;
        Ok(self.file.read_exact_at(bytes, Self::at(offset))?)
    }

    fn capacity(&self) -> usize {
        SIZE
    }
}

impl NorFlash for FlashFile {
    const WRITE_SIZE: usize = 4;
    const ERASE_SIZE: usize = PAGE;

    async fn erase(&mut self, from: u32, to: u32) -> Result<(), FlashError> {
        let length = to.checked_sub(from).ok_or(NorFlashErrorKind::OutOfBounds)? as usize;
        Self::check(from, length, Self::ERASE_SIZE)?;
        Ok(self.file.write_all_at(&vec![0xff; length], Self::at(from))?)
    }

    async fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), FlashError> {
        Self::check(offset, bytes.len(), Self::WRITE_SIZE)?;
        let mut now = vec![0; bytes.len()];
        self.file.read_exact_at(&mut now, Self::at(offset))?;
        now.iter_mut().zip(bytes).for_each(|(now, byte)| *now &= byte);
        Ok(self.file.write_all_at(&now, Self::at(offset))?)
    }
}

/// A file that keeps the settings of a vehicle.
pub struct ParameterFile {
    path: PathBuf,
    store: Store<FlashFile>,
}

impl std::fmt::Debug for ParameterFile {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ParameterFile").field("path", &self.path).finish_non_exhaustive()
    }
}

impl ParameterFile {
    /// Opens a file, created if it is missing, and puts what it keeps into the settings.
    ///
    /// # Errors
    /// One line with the file, what is wrong with it and what to do.
    pub fn open(path: &Path, settings: &mut Settings) -> Result<(Self, Loaded)> {
        let mut open = || -> Result<(Store<FlashFile>, Loaded)> {
            let mut store = Store::new(FlashFile::open(path)?, 0..SIZE as u32).map_err(explain)?;
            let loaded = block_on(store.load(settings)).map_err(explain)?;
            Ok((store, loaded))
        };
        let (store, loaded) = open().map_err(|error| {
            let path = path.display();
            anyhow!(
                "--params {path}: {error:#}: name a new file in a folder that is there, or one that `serve` has made"
            )
        })?;
        Ok((Self { path: path.to_owned(), store }, loaded))
    }

    /// Saves one of the values that wait, unless the vehicle is armed. Returns the name of what was saved.
    ///
    /// # Errors
    /// One line with the file, and why it was not saved.
    pub fn save_next(&mut self, settings: &mut Settings, armed: bool) -> Result<Option<&'static str>> {
        let name = settings.next_unsaved().and_then(|(index, _)| SETTINGS.get(index)).map(|setting| setting.name);
        let saved = block_on(self.store.save_next(settings, armed)).map_err(explain);
        let saved = saved.with_context(|| format!("{}", self.path.display()))?;
        Ok(name.filter(|_| saved))
    }
}

fn explain(error: StoreError) -> anyhow::Error {
    anyhow::Error::msg(match error {
        StoreError::Flash => "cannot be read or written",
        StoreError::Full => "is full",
        StoreError::Corrupted => "is damaged",
        StoreError::Range => "has the wrong size",
    })
}

#[cfg(test)]
mod tests {
    use firmware::config::FlightConfig;
    use firmware::settings::{Value, find};

    use super::*;

    fn temporary(name: &str) -> PathBuf {
        let path = std::env::temp_dir().join(format!("glissade-{}-{name}", std::process::id()));
        let _ = std::fs::remove_file(&path);
        path
    }

    #[test]
    fn what_was_saved_is_there_again_and_armed_nothing_is() {
        let path = temporary("params");
        let index = find("MPC_XY_CRUISE").expect("in the table");
        let mut settings = Settings::of(&FlightConfig::default());
        let (mut file, loaded) = ParameterFile::open(&path, &mut settings).expect("created");
        assert_eq!(loaded, Loaded::default());
        for value in [3.0, 4.0] {
            settings.set(index, Value::Real(value), false).expect("in range");
            assert_eq!(file.save_next(&mut settings, true).expect("waits"), None);
            assert_eq!(file.save_next(&mut settings, false).expect("saved"), Some("MPC_XY_CRUISE"));
            assert_eq!(file.save_next(&mut settings, false).expect("nothing to do"), None);
        }
        let mut again = Settings::of(&FlightConfig::default());
        let (_, loaded) = ParameterFile::open(&path, &mut again).expect("opened");
        assert_eq!((loaded.values, again.get(index)), (1, Some(Value::Real(4.0))));
        std::fs::remove_file(&path).expect("removed");
    }

    #[test]
    fn another_file_is_refused_and_left_alone() {
        let path = temporary("letter");
        std::fs::write(&path, "Dear all").expect("written");
        let error = ParameterFile::open(&path, &mut Settings::default()).expect_err("refused");
        assert!(format!("{error:#}").contains("is no file of parameters: name a new file"), "{error:#}");
        assert_eq!(std::fs::read_to_string(&path).expect("there"), "Dear all");
        std::fs::remove_file(&path).expect("removed");
        let error = ParameterFile::open(Path::new("/nowhere/at/all"), &mut Settings::default()).expect_err("refused");
        assert!(format!("{error:#}").starts_with("--params /nowhere/at/all: "), "{error:#}");
    }
}
