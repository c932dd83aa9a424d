//! `src/generated.rs` is what rust-mavlink's generator makes of `glissade.xml`. After a change of the definitions,
//! `GLISSADE_GENERATE=1 cargo test -p glissade-dialect` writes it.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use mavlink_bindgen::{XmlDefinitions, generate};

/// What the generator makes of the definitions now, in this project's format.
fn generated(folder: &Path) -> String {
    let definitions = Path::new(env!("CARGO_MANIFEST_DIR")).join("glissade.xml");
    fs::create_dir_all(folder).expect("the temporary folder can be written");
    generate(XmlDefinitions::Files(vec![definitions]), folder).expect("the definitions are valid");
    let file = folder.join("glissade.rs");
    let formatted = Command::new("rustfmt")
        .args(["--edition", "2024", "--config-path", concat!(env!("CARGO_MANIFEST_DIR"), "/../../rustfmt.toml")])
        .arg(&file)
        .status()
        .expect("rustfmt is installed");
    assert!(formatted.success());
    fs::read_to_string(file).expect("readable")
}

#[test]
fn the_generated_code_is_that_of_the_definitions() {
    let kept = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("src/generated.rs");
    let folder = env::temp_dir().join(format!("glissade-{}-dialect", std::process::id()));
    let now = generated(&folder);
    fs::remove_dir_all(folder).expect("the temporary folder is ours");
    if env::var_os("GLISSADE_GENERATE").is_some() {
        fs::write(&kept, &now).expect("writable");
    }
    let same = fs::read_to_string(kept).is_ok_and(|kept| kept == now);
    assert!(same, "src/generated.rs is out of date: GLISSADE_GENERATE=1 cargo test -p glissade-dialect");
}
