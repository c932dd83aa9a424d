//! Puts the board's memory map where the linker finds it, and asks for the linker scripts of the images.
//!
//! The root's `memory.x` includes `board-memory.x`, so that no board's map shadows another's. The flags stand
//! here and not in `.cargo/config.toml`, where a user's `RUSTFLAGS` would drop them.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

const BOARD: &str = "src/board/mps2";
/// The images of the board, and whether they log by defmt.
const IMAGES: [(&str, bool); 6] = [
    ("mps2", true),
    ("mps2-pil", true),
    ("math-hash", false),
    ("inner-only", false),
    ("counts", false),
    ("counts-tick", false),
];

fn main() -> io::Result<()> {
    println!("cargo:rerun-if-changed=build.rs");
    let for_image = env::var("CARGO_CFG_TARGET_OS").is_ok_and(|os| os == "none");
    if !for_image || env::var_os("CARGO_FEATURE_BOARD_MPS2").is_none() {
        return Ok(());
    }
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?);
    copy(&Path::new(BOARD).join("memory.x"), &out.join("board-memory.x"))?;
    copy(&Path::new(BOARD).join("device.x"), &out.join("device.x"))?;
    println!("cargo:rerun-if-changed=../memory.x");
    println!("cargo:rustc-link-search={}", out.display());
    for (image, logs) in IMAGES {
        println!("cargo:rustc-link-arg-bin={image}=-Tlink.x");
        if logs {
            println!("cargo:rustc-link-arg-bin={image}=-Tdefmt.x");
        }
    }
    Ok(())
}

fn copy(from: &Path, to: &Path) -> io::Result<()> {
    println!("cargo:rerun-if-changed={}", from.display());
    fs::copy(from, to).map(|_| ())
}
