//! Where the tests of the images find them.

use std::path::PathBuf;

/// The image of that name: in the folder `GLISSADE_IMAGES`, or where `cargo fw` and `cargo fw-pil` leave it.
pub(crate) fn image(name: &str) -> PathBuf {
    let default = || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../target/thumbv7em-none-eabihf/image");
    std::env::var_os("GLISSADE_IMAGES").map_or_else(default, PathBuf::from).join(name)
}
