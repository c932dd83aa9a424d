//! Files of ours: built into the binary by name, or read from a path; TOML, and errors in one line.

use std::path::Path;

use anyhow::{Context, Result, anyhow, bail};
use serde::de::DeserializeOwned;

/// Files of a folder beside `src` that are built in: `(name, text)` of each.
macro_rules! built_in {
    ($folder:literal: $($name:literal),+ $(,)?) => {
        [$(($name, include_str!(concat!("../", $folder, "/", $name, ".toml")))),+]
    };
}

pub(crate) use built_in;

/// A built-in file, or the file at a path, as what it describes.
pub(crate) fn read<T: DeserializeOwned>(name: &str, kind: &str, built_in: &[(&str, &str)]) -> Result<T> {
    let context = || format!("{kind} `{name}`");
    let table = parse(&source(name, kind, built_in)?).with_context(context)?;
    table.try_into().map_err(|error| one_line(&error)).with_context(context)
}

/// Text of a built-in file, or of the file at a path.
pub(crate) fn source(name: &str, kind: &str, built_in: &[(&str, &str)]) -> Result<String> {
    if let Some((_, text)) = built_in.iter().find(|(known, _)| *known == name) {
        return Ok((*text).to_owned());
    }
    if name.contains('/') || Path::new(name).extension().is_some_and(|extension| extension == "toml") {
        return std::fs::read_to_string(name).with_context(|| format!("cannot read {kind} file `{name}`"));
    }
    let known: Vec<&str> = built_in.iter().map(|(name, _)| *name).collect();
    bail!("unknown {kind} `{name}`: use one of {}, or a file's path", known.join(", "))
}

pub(crate) fn parse(text: &str) -> Result<toml::Table> {
    text.parse::<toml::Table>().map_err(|error| {
        let line = error.span().map_or(0, |span| text[..span.start].lines().count().max(1));
        anyhow!("line {line}: {}", error.message().replace('\n', " "))
    })
}

/// A TOML error in one line, with the key it is about.
pub(crate) fn one_line(error: &toml::de::Error) -> anyhow::Error {
    anyhow!("{}", error.to_string().trim().replace('\n', ", "))
}
