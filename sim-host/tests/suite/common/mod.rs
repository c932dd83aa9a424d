//! What several of the tests need.

pub(crate) mod by_bytes;
pub(crate) mod fault;
pub(crate) mod fingerprint;
pub(crate) mod folder;
pub(crate) mod image;
pub(crate) mod load;
pub(crate) mod station;
