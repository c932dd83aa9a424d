//! Named pipes with time-outs.

use std::fs::{DirBuilder, File, OpenOptions};
use std::io::{self, ErrorKind, Read, Write};
use std::os::unix::fs::{DirBuilderExt, OpenOptionsExt};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail, ensure};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::OFlags;

/// A directory of its own with the two pipes, removed when dropped.
#[derive(Debug)]
pub(super) struct Directory {
    path: PathBuf,
}

impl Directory {
    pub(super) fn create() -> Result<Self> {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let name = format!("glissade-pil-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(name);
        let text = path.to_str().unwrap_or(" ");
        ensure!(
            !text.contains(|c: char| c.is_whitespace() || c == ',') && text.len() < 240,
            "QEMU cannot take the name of the folder for temporary files, {}: set TMPDIR to one without spaces and commas",
            path.display()
        );
        let made = DirBuilder::new().mode(0o700).create(&path);
        made.with_context(|| format!("cannot create {}", path.display()))?;
        let directory = Self { path };
        // The program, because macOS has the system call under another name.
        let status = Command::new("mkfifo").arg(directory.towards_image()).arg(directory.out_of_image()).status();
        ensure!(status.context("cannot run `mkfifo`")?.success(), "`mkfifo` failed in {}", directory.path.display());
        Ok(directory)
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn towards_image(&self) -> PathBuf {
        self.path.join("to-image")
    }

    pub(super) fn out_of_image(&self) -> PathBuf {
        self.path.join("from-image")
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        // A folder that stays does no harm.
        let _ = std::fs::remove_dir_all(&self.path);
    }
}

fn open(path: &Path, options: &mut OpenOptions) -> io::Result<File> {
    options.custom_flags(OFlags::NONBLOCK.bits().cast_signed()).open(path)
}

/// The reading end; the writer may come later.
pub(super) fn open_to_read(path: &Path) -> Result<File> {
    open(path, OpenOptions::new().read(true)).with_context(|| format!("cannot open {}", path.display()))
}

/// The writing end, as soon as there is a reader. `alive` fails if there never will be one.
pub(super) fn open_to_write(path: &Path, timeout: Duration, mut alive: impl FnMut() -> Result<()>) -> Result<File> {
    let end = Instant::now() + timeout;
    loop {
        match open(path, OpenOptions::new().write(true)) {
            Ok(file) => return Ok(file),
            Err(error) if error.raw_os_error() == Some(rustix::io::Errno::NXIO.raw_os_error()) => {}
            Err(error) => return Err(error).with_context(|| format!("cannot open {}", path.display())),
        }
        alive()?;
        if Instant::now() > end {
            bail!("the image has not opened its end within {timeout:?}: is it one for processor in the loop?");
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Writes all bytes, or fails after `timeout`.
pub(super) fn write(file: &mut File, mut bytes: &[u8], timeout: Duration) -> io::Result<()> {
    while !bytes.is_empty() {
        match file.write(bytes) {
            Ok(count) => bytes = bytes.get(count..).unwrap_or_default(),
            Err(error) if error.kind() == ErrorKind::WouldBlock => wait(file, PollFlags::OUT, timeout)?,
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

/// Fills the buffer, or fails after `timeout`. [`ErrorKind::UnexpectedEof`] if the writer has closed its end.
pub(super) fn read(file: &mut File, mut buffer: &mut [u8], timeout: Duration) -> io::Result<()> {
    while !buffer.is_empty() {
        match file.read(buffer) {
            Ok(0) => return Err(ErrorKind::UnexpectedEof.into()),
            Ok(count) => buffer = buffer.get_mut(count..).unwrap_or_default(),
            Err(error) if error.kind() == ErrorKind::WouldBlock => wait(file, PollFlags::IN, timeout)?,
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

fn wait(file: &File, what: PollFlags, timeout: Duration) -> io::Result<()> {
    let timeout = Timespec::try_from(timeout).map_err(|_| ErrorKind::InvalidInput)?;
    match poll(&mut [PollFd::new(file, what)], Some(&timeout)) {
        Ok(0) => Err(ErrorKind::TimedOut.into()),
        Ok(_) | Err(rustix::io::Errno::INTR) => Ok(()),
        Err(error) => Err(error.into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHORT: Duration = Duration::from_millis(20);

    #[test]
    fn every_wait_ends() {
        let directory = Directory::create().expect("a folder");
        let path = directory.towards_image();
        let alone = open_to_write(&path, SHORT, || Ok(())).expect_err("nobody reads");
        assert!(alone.to_string().contains("within 20ms"), "{alone}");
        let mut reader = open_to_read(&path).expect("does not wait for a writer");
        let mut writer = open_to_write(&path, SHORT, || Ok(())).expect("there is a reader");
        write(&mut writer, b"ab", SHORT).expect("there is room");
        let mut buffer = [0; 3];
        assert_eq!(read(&mut reader, &mut buffer, SHORT).map_err(|e| e.kind()), Err(ErrorKind::TimedOut));
        assert_eq!(&buffer, b"ab\0");
        let full = write(&mut writer, &vec![0; 1 << 20], SHORT);
        assert_eq!(full.map_err(|e| e.kind()), Err(ErrorKind::TimedOut));
        drop(reader);
        assert_eq!(write(&mut writer, b"c", SHORT).map_err(|e| e.kind()), Err(ErrorKind::BrokenPipe));
    }

    #[test]
    fn a_closed_writing_end_is_the_end_of_the_file() {
        let directory = Directory::create().expect("a folder");
        let mut reader = open_to_read(&directory.out_of_image()).expect("does not wait");
        drop(open_to_write(&directory.out_of_image(), SHORT, || Ok(())).expect("there is a reader"));
        assert_eq!(read(&mut reader, &mut [0], SHORT).map_err(|e| e.kind()), Err(ErrorKind::UnexpectedEof));
        let path = directory.path().to_owned();
        drop(directory);
        assert!(!path.exists());
    }
}
