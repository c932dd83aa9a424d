//! A folder of its own for a test, and the program in it: it needs nothing beside it.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};

use serde_json::Value;

/// Removed with all that is in it when it goes out of scope.
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    /// Empty, with that name in its own.
    pub(crate) fn new(name: &str) -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let (process, count) = (std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(format!("glissade-{process}-{count}-{name}"));
        fs::create_dir_all(&path).expect("the temporary folder can be written");
        Self(path)
    }

    /// Writes a file; returns its path.
    pub(crate) fn file(&self, name: &str, text: impl AsRef<[u8]>) -> String {
        let path = self.0.join(name);
        fs::write(&path, text).expect("the temporary folder can be written");
        path.to_str().expect("a plain path").to_owned()
    }

    /// Names of what is in it, hidden ones too.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).expect("it can be read");
        let name = |entry: std::io::Result<fs::DirEntry>| entry.expect("it can be read").file_name();
        let mut names: Vec<String> = entries.map(|entry| name(entry).to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// The program with arguments, to be started here.
    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_sim-host"));
        command.args(arguments).current_dir(&self.0).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    /// Runs the program to its end.
    pub(crate) fn run(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().expect("the program starts")
    }

    /// What the program prints on standard output, whatever its exit code.
    pub(crate) fn text(&self, arguments: &[&str]) -> String {
        String::from_utf8(self.run(arguments).stdout).expect("UTF-8")
    }

    /// The same, as JSON.
    pub(crate) fn json(&self, arguments: &[&str]) -> Value {
        serde_json::from_slice(&self.run(arguments).stdout).expect("JSON")
    }

    /// What a run that succeeds prints on standard output and standard error.
    pub(crate) fn prints(&self, arguments: &[&str]) -> (String, String) {
        let output = self.run(arguments);
        let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).expect("UTF-8"));
        assert!(output.status.success(), "{arguments:?}: {err}");
        (out, err)
    }

    /// What a run that succeeds prints on standard output.
    pub(crate) fn succeeds(&self, arguments: &[&str]) -> String {
        self.prints(arguments).0
    }

    /// One line on standard error that holds every one of `parts`, nothing on standard output, exit code 2.
    pub(crate) fn refuses(&self, arguments: &[&str], parts: &[&str]) {
        let output = self.run(arguments);
        let line = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {line}");
        assert_eq!(line.lines().count(), 1, "{arguments:?}: {line}");
        assert!(line.starts_with("sim-host: ") && output.stdout.is_empty(), "{arguments:?}: {line}");
        for part in parts {
            assert!(line.contains(part), "{arguments:?}: {part} is not in: {line}");
        }
        for never in ["panicked", ", ,", "``", "os error", "NaN"] {
            assert!(!line.contains(never), "{arguments:?}: {never} is in: {line}");
        }
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}
