//! Generates the dialect's Rust code from `glissade.xml`.

use std::env;
use std::path::Path;

use mavlink_bindgen::{XmlDefinitions, emit_cargo_build_messages, generate};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let out = env::var("OUT_DIR")?;
    let definitions = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("glissade.xml");
    let bindings = generate(XmlDefinitions::Files(vec![definitions]), out)?;
    emit_cargo_build_messages(&bindings);
    Ok(())
}
