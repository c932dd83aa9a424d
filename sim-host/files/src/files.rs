//! Files of ours: built into the binary by name, or read from a path; TOML, and errors in one line.

use std::fmt;
use std::fs;
use std::io::{ErrorKind, Read as _};
use std::path::Path;

use anyhow::{Error, Result, anyhow, bail, ensure};
use serde::de::DeserializeOwned;
use toml::Table;
use toml::de::{DeTable, DeValue};

use crate::refusal::{Refusal, nearest, typed};

/// Files of a folder beside `src` that are built in: `(name, text)` of each.
#[macro_export]
macro_rules! built_in {
    ($folder:literal: $($name:literal),+ $(,)?) => {
        [$(($name, include_str!(concat!("../", $folder, "/", $name, ".toml")))),+]
    };
}

/// Larger files than this are none of ours, bytes.
pub const LARGEST: u64 = 1 << 20;

/// A file that has been read: what it is, its name or path, and its text.
#[derive(Clone, Debug)]
pub struct Source {
    kind: &'static str,
    name: String,
    text: String,
    /// Lines are told of files that the user can open.
    is_path: bool,
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} `{}`", self.kind, self.name)
    }
}

impl Source {
    /// A built-in file, or the file at a path.
    ///
    /// # Errors
    /// No such name, or a file that cannot be read: what was meant, or what to do.
    pub fn read(name: &str, kind: &'static str, built_in: &[(&str, &str)]) -> Result<Self> {
        let known = built_in.iter().find(|(known, _)| *known == name);
        let is_path = known.is_none();
        let text = match known {
            Some((_, text)) => (*text).to_owned(),
            None if is_file_name(name) => read_text(name, kind, built_in)?,
            None => bail!(unknown(name, kind, built_in)),
        };
        Ok(Self { kind, name: name.to_owned(), text, is_path })
    }

    /// A built-in file, or the file at a path, which a key names.
    ///
    /// # Errors
    /// A refusal of the key.
    pub fn named(key: &str, name: &str, kind: &'static str, built_in: &[(&str, &str)]) -> Result<Self> {
        Self::read(name, kind, built_in).map_err(|error| Refusal::new(key, format!(": {error:#}")).into())
    }

    /// Whether it was read from a path, and is not built in.
    pub fn is_path(&self) -> bool {
        self.is_path
    }

    /// As a table.
    ///
    /// # Errors
    /// No TOML: the file, the line, and what is wrong with it.
    pub fn table(&self) -> Result<Table> {
        self.text.parse::<Table>().map_err(|error| {
            let line = error.span().map_or(1, |span| line(&self.text, span.start));
            anyhow!("{self}, line {line}: {}", plain(error.message(), self.text.lines().nth(line - 1)))
        })
    }

    /// As what it describes.
    ///
    /// # Errors
    /// The file, the line, and the [`Refusal`] of a key.
    pub fn typed<T: DeserializeOwned>(&self) -> Result<T> {
        typed(self.table()?).map_err(|error| self.about(error))
    }

    /// An error with the file before it, and the line of the key that it refuses.
    pub fn about(&self, error: Error) -> Error {
        let Some(refusal) = error.downcast_ref::<Refusal>() else { return error.context(self.to_string()) };
        let line = self.line_of(refusal.key()).map_or(String::new(), |line| format!(", line {line}"));
        error.context(format!("{self}{line}"))
    }

    /// The line in which a dotted key stands, or, of one that does not, the table that ought to have it.
    fn line_of(&self, key: &str) -> Option<usize> {
        let table = DeTable::parse(&self.text).ok().filter(|_| self.is_path)?;
        let mut place = DeValue::Table(table.into_inner());
        let mut at = None;
        for part in key.split('.') {
            let (start, inner) = match place {
                DeValue::Table(table) => {
                    let Some((name, value)) = table.into_iter().find(|(name, _)| name.get_ref() == part) else { break };
                    (name.span().start, value)
                }
                DeValue::Array(values) => {
                    let index = part.parse::<usize>().ok();
                    let Some(value) = index.and_then(|index| values.into_iter().nth(index)) else { break };
                    (value.span().start, value)
                }
                _ => break,
            };
            at = Some(line(&self.text, start));
            place = inner.into_inner();
        }
        at
    }
}

/// What the TOML parser says, in plain words; `text` is the line that it is about.
fn plain(message: &str, text: Option<&str>) -> String {
    if message.contains("i128") || message.contains("overflowed") {
        let key = text.and_then(|text| text.split_once('=')).map_or("a number", |(key, _)| key.trim());
        return format!("`{key}` is too large: whole numbers go to {}, others to {:e}", i64::MAX, f64::MAX);
    }
    if message.contains("duplicate key") {
        let key = text.map_or("", |text| text.split('=').next().unwrap_or(text)).trim_matches(['[', ']', ' ']);
        return format!("`{key}` is given twice");
    }
    let message = message.trim().replace('\n', " ");
    // What could follow helps nobody here.
    [", expected nothing", ", expected literal string"].iter().fold(message, |text, tail| text.replace(tail, ""))
}

/// The number of the line in which a byte of a text stands.
fn line(text: &str, byte: usize) -> usize {
    text[..byte.min(text.len())].bytes().filter(|byte| *byte == b'\n').count() + 1
}

/// The path of a file that another file names, as a scenario its tuning: beside that file, if there is one; else as it
/// is, from the current folder.
pub fn beside(by: &str, name: &str) -> String {
    let near = Path::new(by).with_file_name(name);
    let is_path = Path::new(by).extension().is_some_and(|end| end == "toml") || by.contains('/');
    if is_path && near.is_file() { near.to_string_lossy().into_owned() } else { name.to_owned() }
}

/// A built-in file, or the file at a path, as what it describes.
///
/// # Errors
/// Those of [`Source::read`] and [`Source::typed`].
pub fn read<T: DeserializeOwned>(name: &str, kind: &'static str, built_in: &[(&str, &str)]) -> Result<T> {
    Source::read(name, kind, built_in)?.typed()
}

/// Whether a name that is not built in means a file.
fn is_file_name(name: &str) -> bool {
    let path = Path::new(name);
    let is_toml = path.extension().is_some_and(|extension| extension == "toml");
    name.contains(['/', '\\']) || is_toml || path.is_file() || path.is_dir()
}

fn unknown(name: &str, kind: &str, built_in: &[(&str, &str)]) -> Error {
    let known: Vec<&str> = built_in.iter().map(|(name, _)| *name).collect();
    match nearest(name, known.iter().copied()) {
        Some(near) => anyhow!("unknown {kind} `{name}`: did you mean `{near}`? A file is given by its path"),
        None if known.len() > 8 => {
            anyhow!("unknown {kind} `{name}`: `sim-host scenarios` lists them; or give a file's path")
        }
        None => anyhow!("unknown {kind} `{name}`: use one of {}, or a file's path", known.join(", ")),
    }
}

fn read_text(name: &str, kind: &str, built_in: &[(&str, &str)]) -> Result<String> {
    if Path::new(name).is_dir() {
        bail!(folder(name, kind));
    }
    let cannot = format!("cannot read {kind} file `{name}`");
    read_regular(Path::new(name), LARGEST).map_err(|error| {
        let is_missing = error.downcast_ref::<std::io::Error>().is_some_and(|e| e.kind() == ErrorKind::NotFound);
        let remedy = built_in_of(name, built_in).filter(|_| is_missing);
        let remedy = remedy.map_or(String::new(), |near| format!(": did you mean the built-in `{near}`?"));
        anyhow!("{cannot}: {error}{remedy}")
    })
}

/// The text of a file of at most `largest` bytes.
///
/// # Errors
/// What the system says, or why it is no such text: a FIFO or a device, which might never end, too large, not UTF-8.
/// The path is left to the caller.
pub fn read_regular(path: &Path, largest: u64) -> Result<String> {
    let is_other = |kind: fs::FileType| !kind.is_file() && !kind.is_dir();
    ensure!(
        !is_other(fs::metadata(path)?.file_type()),
        "it is not a regular file: write the text to one and give its path"
    );
    let mut bytes = Vec::new();
    fs::File::open(path)?.take(largest + 1).read_to_end(&mut bytes)?;
    ensure!(bytes.len() as u64 <= largest, "it is larger than {} MiB, the most that is read", largest >> 20);
    String::from_utf8(bytes).map_err(|error| {
        let line = line(&String::from_utf8_lossy(error.as_bytes()), error.utf8_error().valid_up_to());
        anyhow!("line {line} is not UTF-8: is it a text file?")
    })
}

/// A folder in place of a file: perhaps that of an earlier run.
fn folder(name: &str, kind: &str) -> String {
    let inside = Path::new(name).join(format!("{kind}.toml"));
    let remedy = if inside.is_file() {
        format!("give `{}`", inside.display())
    } else {
        format!("give the path of a {kind} file")
    };
    format!("cannot read {kind} file `{name}`: it is a folder: {remedy}")
}

/// The built-in file that a path's stem names, or nearly.
fn built_in_of<'a>(path: &str, built_in: &[(&'a str, &str)]) -> Option<&'a str> {
    nearest(Path::new(path).file_stem()?.to_str()?, built_in.iter().map(|(name, _)| *name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_is_found_in_its_line() {
        let text =
            "summary = \"x\"\n\n[control]\nroll = { gain = 1.0 }\n[[fault]]\nkind = \"off\"\n[[fault]]\nfrom_s = 1.0\n";
        let source = |is_path| Source { kind: "scenario", name: "x.toml".to_owned(), text: text.to_owned(), is_path };
        for (key, line) in [
            ("summary", Some(1)),
            ("control", Some(3)),
            ("control.roll.gain", Some(4)),
            ("control.roll.lambda", Some(4)),
            ("control.yaw", Some(3)),
            ("fault.1.from_s", Some(8)),
            ("plant", None),
        ] {
            assert_eq!(source(true).line_of(key), line, "{key}");
            assert_eq!(source(false).line_of(key), None, "{key}");
        }
    }
}
