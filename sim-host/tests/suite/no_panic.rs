//! No tick of the inner partition can panic: the image that holds nothing else has no function of `core::panicking`.
//! Ignored by default, because it needs the images (`cargo fw && cargo fw-pil`).

use object::{Object, ObjectSymbol};

use crate::common::image::image;

/// Parts of the names of all functions through which a panic goes; the last one is the way into the handler.
const PANICS: [&str; 3] = ["panicking", "unwrap_failed", "rust_begin_unwind"];

fn panicking_symbols(name: &str) -> Vec<String> {
    let path = image(name);
    let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}: `cargo fw-pil`", path.display()));
    let file = object::File::parse(&*bytes).expect("an ELF file");
    let names: Vec<_> = file.symbols().filter_map(|symbol| symbol.name().ok().map(str::to_owned)).collect();
    assert!(names.iter().any(|name| name == "Reset"), "{name} has symbols");
    names.into_iter().filter(|name| PANICS.iter().any(|part| name.contains(part))).collect()
}

#[test]
#[ignore = "needs the images"]
fn the_inner_partition_has_no_reachable_panic() {
    assert_eq!(panicking_symbols("inner-only"), Vec::<String>::new());
}

/// Or the test above could not fail: this image panics on purpose.
#[test]
#[ignore = "needs the images"]
fn an_image_that_can_panic_is_recognised() {
    assert!(!panicking_symbols("mps2-pil").is_empty());
}
