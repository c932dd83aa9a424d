//! A file as a flash memory: pages that are erased to ones, and words of which a write only clears bits.
//!
//! The firmware's store of settings runs on it as on a board's flash. A header tells such a file from any other.

use std::fs::{File, Metadata, OpenOptions, TryLockError};
use std::io::ErrorKind;
use std::os::unix::fs::{FileExt as _, MetadataExt as _};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, anyhow, bail, ensure};
use embedded_storage_async::nor_flash::{ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash};
use firmware::settings::store::{Loaded, Store, StoreError, block_on};
use firmware::settings::{SETTINGS, Settings};

const HEADER: &[u8; 16] = b"glissade params\n";
/// Bytes of a page, and of the whole: all settings fit into half of it several times.
const PAGE: usize = 4096;
const SIZE: usize = 16 * PAGE;
/// Bytes of the file.
const WHOLE: usize = HEADER.len() + SIZE;

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

/// What is wrong with a file that has a remedy of its own.
#[derive(Debug)]
enum Unfit {
    /// It is a link to a file that is not there.
    Link(PathBuf),
    /// `serve` has made it, and it has only so many bytes left.
    CutOff(u64),
}

impl std::fmt::Display for Unfit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Link(target) => write!(f, "is a link to {}, which is not there", target.display()),
            Self::CutOff(length) => write!(f, "is cut off: it has {length} of its {WHOLE} bytes"),
        }
    }
}

impl std::error::Error for Unfit {}

/// What to do about a file that cannot be opened.
fn remedy(error: &anyhow::Error) -> &'static str {
    let kind = error.downcast_ref::<std::io::Error>().map(std::io::Error::kind);
    match (error.downcast_ref(), kind) {
        (Some(Unfit::Link(_)), _) => "remove the link, or name another file",
        (Some(Unfit::CutOff(_)), _) => "name a whole copy of it, or a new file",
        (None, Some(ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem)) => {
            "name a file that you may write to"
        }
        (None, _) => "name a new file in a folder that is there, or one that `serve` has made",
    }
}

/// How often opening is tried anew when another process creates the same file at the same moment.
const TRIES: usize = 3;

impl FlashFile {
    /// Opens a file for this process alone. One that is missing, or that was never written to, is created erased.
    fn open(path: &Path) -> Result<Self> {
        for _ in 0..TRIES {
            let file = match OpenOptions::new().read(true).write(true).open(path) {
                Ok(file) => file,
                Err(error) if error.kind() == ErrorKind::NotFound => {
                    if let Ok(target) = std::fs::read_link(path) {
                        bail!(Unfit::Link(target));
                    }
                    create(path, None)?;
                    continue;
                }
                Err(error) => return Err(error.into()),
            };
            ensure!(file.metadata()?.is_file(), "is no file of parameters");
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => bail!("is in use by another `sim-host serve`"),
                // Where the file system knows no locks, there is none.
                Ok(()) | Err(TryLockError::Error(_)) => {}
            }
            if !is_named(&file, path) {
                continue;
            }
            if is_blank(&file)? {
                create(path, Some(&file))?;
                continue;
            }
            let mut header = [0; HEADER.len()];
            let has_header = file.read_exact_at(&mut header, 0).is_ok() && header == *HEADER;
            let length = file.metadata()?.len();
            ensure!(!has_header || length >= WHOLE as u64, Unfit::CutOff(length));
            ensure!(has_header && length == WHOLE as u64, "is no file of parameters");
            return Ok(Self { file });
        }
        bail!("is being made by another `sim-host serve`")
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
        self.file.write_all_at(&vec![0xff; length], Self::at(from))?;
        Ok(self.file.sync_data()?)
    }

    async fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), FlashError> {
        Self::check(offset, bytes.len(), Self::WRITE_SIZE)?;
        let mut now = vec![0; bytes.len()];
        self.file.read_exact_at(&mut now, Self::at(offset))?;
        now.iter_mut().zip(bytes).for_each(|(now, byte)| *now &= byte);
        self.file.write_all_at(&now, Self::at(offset))?;
        Ok(self.file.sync_data()?)
    }
}

/// Whether the path still names this file, and not another one that has taken its place.
fn is_named(file: &File, path: &Path) -> bool {
    let inode = |data: std::io::Result<Metadata>| data.ok().map(|data| (data.dev(), data.ino()));
    inode(file.metadata()) == inode(std::fs::metadata(path))
}

/// Whether a file holds nothing: it is empty, or was cut off while it was being created.
fn is_blank(file: &File) -> Result<bool> {
    let length = file.metadata()?.len();
    if length > WHOLE as u64 {
        return Ok(false);
    }
    let mut bytes = vec![0; length as usize];
    file.read_exact_at(&mut bytes, 0)?;
    let (header, rest) = bytes.split_at(bytes.len().min(HEADER.len()));
    let no_header = header.iter().zip(HEADER).any(|(byte, of_header)| byte != of_header) || header.len() < HEADER.len();
    Ok(no_header && header.iter().all(|byte| [0, 0xff].contains(byte)) && rest.iter().all(|byte| *byte == 0xff))
}

/// Creates an erased file whole: it is written aside, and then gets its name, in place of `blank` if that is there.
fn create(path: &Path, blank: Option<&File>) -> Result<()> {
    // What a link names is made, and not put in the place of the link.
    let path = if blank.is_some() { std::fs::canonicalize(path)? } else { path.to_owned() };
    let mut aside = path.clone().into_os_string();
    aside.push(format!(".{}", std::process::id()));
    let aside = PathBuf::from(aside);
    let made = write_aside(&aside, blank).and_then(|()| give_name(&aside, &path, blank.is_some()));
    // It is gone if it was renamed.
    let _ = std::fs::remove_file(&aside);
    made?;
    // The name too is to survive a power cut.
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
    Ok(())
}

fn write_aside(aside: &Path, blank: Option<&File>) -> std::io::Result<()> {
    let file = OpenOptions::new().write(true).create(true).truncate(true).open(aside)?;
    file.write_all_at(HEADER, 0)?;
    file.write_all_at(&vec![0xff; SIZE], HEADER.len() as u64)?;
    if let Some(blank) = blank {
        file.set_permissions(blank.metadata()?.permissions())?;
    }
    file.sync_all()
}

/// A file that another process has made meanwhile stays: only one that is blank is replaced.
fn give_name(aside: &Path, path: &Path, replace: bool) -> std::io::Result<()> {
    if replace {
        return std::fs::rename(aside, path);
    }
    match std::fs::hard_link(aside, path) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => Ok(()),
        // Not every file system knows a second name.
        Err(_) => std::fs::rename(aside, path),
        Ok(()) => Ok(()),
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
        let (store, loaded) =
            open().map_err(|error| anyhow!("--params {}: {error:#}: {}", path.display(), remedy(&error)))?;
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

    /// Saves all the values that wait: the vehicle ends, and flies no more. Returns how many.
    ///
    /// # Errors
    /// One line with the file, and why they were not saved.
    pub fn save_all(&mut self, settings: &mut Settings) -> Result<usize> {
        let mut count = 0;
        while self.save_next(settings, false)?.is_some() {
            count += 1;
        }
        Ok(count)
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
        drop(file);
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

    #[test]
    fn a_file_whose_creation_was_cut_off_is_made_anew() {
        let path = temporary("cut");
        let hole = [vec![0; HEADER.len()], vec![0xff; SIZE]].concat();
        for left in [Vec::new(), vec![0; 7], vec![0xff; 65_536], hole[..65_536].to_vec(), hole] {
            std::fs::write(&path, &left).expect("written");
            let (_, loaded) = ParameterFile::open(&path, &mut Settings::default()).expect("made anew");
            assert_eq!(loaded, Loaded::default(), "{} bytes", left.len());
            let made = std::fs::read(&path).expect("there");
            assert!(made.len() == WHOLE && made.starts_with(HEADER));
        }
        std::fs::write(&path, &HEADER[..10]).expect("written");
        ParameterFile::open(&path, &mut Settings::default()).expect_err("some text");
        std::fs::remove_file(&path).expect("removed");
    }

    #[test]
    fn a_file_that_does_not_fit_is_refused_with_its_own_remedy() {
        let (path, target) = (temporary("short"), temporary("target"));
        let refused = || {
            let error = ParameterFile::open(&path, &mut Settings::default()).expect_err("refused");
            format!("{error:#}").replace(&path.display().to_string(), "F").replace(&target.display().to_string(), "T")
        };
        std::fs::write(&path, [&HEADER[..], &[0xff; 84]].concat()).expect("written");
        let expected = "--params F: is cut off: it has 100 of its 65552 bytes: name a whole copy of it, or a new file";
        assert_eq!(refused(), expected);
        std::fs::remove_file(&path).expect("removed");
        std::os::unix::fs::symlink(&target, &path).expect("linked");
        let expected = "--params F: is a link to T, which is not there: remove the link, or name another file";
        assert_eq!(refused(), expected);
        std::fs::remove_file(&path).expect("removed");
        let denied = std::io::Error::from(ErrorKind::PermissionDenied);
        assert_eq!(remedy(&denied.into()), "name a file that you may write to");
    }

    #[test]
    fn two_at_once_are_refused_and_nothing_is_left_beside_the_file() {
        let path = temporary("locked");
        let (first, _) = ParameterFile::open(&path, &mut Settings::default()).expect("created");
        let error = ParameterFile::open(&path, &mut Settings::default()).expect_err("in use");
        assert!(format!("{error:#}").contains("is in use by another `sim-host serve`"), "{error:#}");
        drop(first);
        ParameterFile::open(&path, &mut Settings::default()).expect("free again");
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        let beside = std::fs::read_dir(std::env::temp_dir()).expect("a folder").filter_map(Result::ok);
        let beside = beside.filter(|entry| entry.file_name().to_string_lossy().starts_with(&name)).count();
        assert_eq!(beside, 1);
        std::fs::remove_file(&path).expect("removed");
    }

    #[test]
    fn what_waits_at_the_end_is_saved() {
        let path = temporary("end");
        let index = find("MPC_XY_CRUISE").expect("in the table");
        let mut settings = Settings::of(&FlightConfig::default());
        let (mut file, _) = ParameterFile::open(&path, &mut settings).expect("created");
        settings.set(index, Value::Real(3.5), true).expect("in flight");
        assert_eq!(file.save_next(&mut settings, true).expect("waits"), None);
        assert_eq!(file.save_all(&mut settings).expect("saved"), 1);
        drop(file);
        let mut again = Settings::of(&FlightConfig::default());
        ParameterFile::open(&path, &mut again).expect("opened");
        assert_eq!(again.get(index), Some(Value::Real(3.5)));
        std::fs::remove_file(&path).expect("removed");
    }
}
