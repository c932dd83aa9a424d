//! QEMU as a child process, with a pipe each way to the image in it.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, anyhow, bail, ensure};

use super::fifo::{self, Directory};

const PROGRAM: &str = "qemu-system-arm";

/// A running QEMU, killed when dropped.
#[derive(Debug)]
pub(super) struct Qemu {
    process: Process,
    to_image: File,
    from_image: File,
    timeout: Duration,
    _directory: Directory,
}

impl Qemu {
    /// Boots the image and opens both pipes.
    pub(super) fn start(image: &Path, timeout: Duration) -> Result<Self> {
        ensure!(image.is_file(), "there is no image {}: build it with `cargo fw-pil`", image.display());
        ensure!(is_elf(image), "{} is not an ELF file: build the image with `cargo fw-pil`", image.display());
        let directory = Directory::create()?;
        let from_image = fifo::open_to_read(&directory.out_of_image())?;
        let mut process = Process::spawn(image, directory.path())?;
        // The image opens its writing end before its reading end: from here on both are open.
        let to_image = fifo::open_to_write(&directory.towards_image(), timeout, || process.check())?;
        Ok(Self { process, to_image, from_image, timeout, _directory: directory })
    }

    pub(super) fn send(&mut self, bytes: &[u8]) -> Result<()> {
        fifo::write(&mut self.to_image, bytes, self.timeout).map_err(|error| self.explain(error))
    }

    pub(super) fn receive<const N: usize>(&mut self) -> Result<[u8; N]> {
        let mut bytes = [0; N];
        fifo::read(&mut self.from_image, &mut bytes, self.timeout).map_err(|error| self.explain(error))?;
        Ok(bytes)
    }

    fn explain(&mut self, error: std::io::Error) -> anyhow::Error {
        match error.kind() {
            ErrorKind::TimedOut => anyhow!("the image has not answered within {:?}", self.timeout),
            ErrorKind::UnexpectedEof | ErrorKind::BrokenPipe => match self.process.end(self.timeout) {
                Ok(status) => anyhow!("{PROGRAM} has ended ({status}){}", self.process.complaint()),
                Err(error) => error,
            },
            _ => anyhow::Error::new(error).context("the pipe to the image failed"),
        }
    }

    /// Waits until it ends by itself.
    pub(super) fn wait(mut self) -> Result<()> {
        let status = self.process.end(self.timeout)?;
        ensure!(status.success(), "{PROGRAM} has failed ({status}){}", self.process.complaint());
        Ok(())
    }
}

/// Whether a file begins like an ELF file. QEMU would boot any file, and fail with many lines of text.
fn is_elf(path: &Path) -> bool {
    let mut start = [0; 4];
    File::open(path).and_then(|mut file| file.read_exact(&mut start)).is_ok() && start == *b"\x7fELF"
}

/// The child process, killed when dropped.
#[derive(Debug)]
struct Process {
    child: Child,
}

impl Process {
    fn spawn(image: &Path, directory: &Path) -> Result<Self> {
        let semihosting = format!("enable=on,target=native,arg={}", directory.display());
        // An instruction is 8 ns of virtual time, near the speed of an STM32F405, and a sleeping core costs no time.
        let spawned = Command::new(PROGRAM)
            .args(["-M", "mps2-an386", "-icount", "shift=3,sleep=off"])
            .args(["-display", "none", "-monitor", "none", "-serial", "null", "-semihosting-config", &semihosting])
            .arg("-kernel")
            .arg(image)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn();
        match spawned {
            Ok(child) => Ok(Self { child }),
            Err(error) if error.kind() == ErrorKind::NotFound => bail!(
                "{PROGRAM} is not installed: `apt install qemu-system-arm` (Debian) or `brew install qemu` (macOS)"
            ),
            Err(error) => Err(error).with_context(|| format!("cannot start {PROGRAM}")),
        }
    }

    /// Fails if it has ended.
    fn check(&mut self) -> Result<()> {
        match self.child.try_wait()? {
            None => Ok(()),
            Some(status) => bail!("{PROGRAM} has ended ({status}){}", self.complaint()),
        }
    }

    fn end(&mut self, timeout: Duration) -> Result<ExitStatus> {
        let end = Instant::now() + timeout;
        loop {
            if let Some(status) = self.child.try_wait()? {
                return Ok(status);
            }
            ensure!(Instant::now() < end, "{PROGRAM} has not ended within {timeout:?}");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    /// The last line on its standard error, once it has ended.
    fn complaint(&mut self) -> String {
        let mut text = String::new();
        if let Some(stderr) = &mut self.child.stderr {
            // Without it, the exit status has to do.
            let _ = stderr.read_to_string(&mut text);
        }
        text.lines().last().map(|line| format!(": {line}")).unwrap_or_default()
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // Fails if it has ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
