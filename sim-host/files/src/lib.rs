//! Files of ours: TOML read into types, and what does not fit refused in one line with file, key, value, range and remedy.

pub mod files;
pub mod refusal;
pub mod words;
