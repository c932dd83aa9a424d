//! `--set KEY=VALUE`: a dotted key of a table, and its value as TOML has it.

use anyhow::{Result, anyhow};

pub(super) fn split_setting(setting: &str) -> Result<(&str, toml::Value)> {
    let (key, text) = setting.split_once('=').ok_or_else(|| anyhow!("--set {setting}: use KEY=VALUE"))?;
    Ok((key, value(text)))
}

/// A value as TOML has it; what is none, is a string.
pub(crate) fn value(text: &str) -> toml::Value {
    format!("value = {text}")
        .parse::<toml::Table>()
        .ok()
        .and_then(|mut table| table.remove("value"))
        .unwrap_or_else(|| toml::Value::String(text.to_owned()))
}

/// Sets a dotted key; integers become floats where a float stood.
pub(super) fn set(table: &mut toml::Table, key: &str, value: toml::Value) -> Result<()> {
    let (path, last) = key.rsplit_once('.').map_or((None, key), |(path, last)| (Some(path), last));
    let mut place = table;
    for part in path.into_iter().flat_map(|path| path.split('.')) {
        place = place
            .entry(part)
            .or_insert_with(|| toml::Value::Table(toml::Table::new()))
            .as_table_mut()
            .ok_or_else(|| anyhow!("`{part}` is not a table"))?;
    }
    place.insert(last.to_owned(), value);
    Ok(())
}
