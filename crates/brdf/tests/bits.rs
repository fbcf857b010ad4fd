//! With the `libm` backend everything has the bits of `bits.txt`, on every target.
//!
//! The firmware and the WebAssembly module in `embedded/` print hashes of the same functions over the
//! same inputs, which `embedded/run.sh` compares with the same file. A change that is meant to change
//! bits rewrites it: `BITS=write cargo test -p etendue-brdf --features libm --test bits`.
#![cfg(feature = "libm")]

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

use etendue_specimens::bits::{BRIEF, Hash, LONG, all};

#[test]
fn every_function_and_model_has_its_bits() {
    let mut text = String::from("# hash, precision, number of inputs, function or model\n");
    let inputs = if cfg!(miri) { BRIEF } else { LONG };
    let mut report = |hash: Hash| {
        writeln!(text, "{hash}").unwrap();
        if cfg!(miri) {
            eprintln!("{hash}"); // an interpreter takes minutes for some
        }
    };
    all::<f32>(inputs, &mut report);
    all::<f64>(inputs, &mut report);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bits.txt");
    if env::var_os("BITS").is_some_and(|value| value == "write") {
        fs::write(&path, &text).unwrap();
    }
    let pinned = fs::read_to_string(&path).unwrap();
    let changed: Vec<_> = text.lines().filter(|line| !pinned.lines().any(|p| p == *line)).collect();
    assert!(changed.is_empty(), "these are not in bits.txt:\n{}", changed.join("\n"));
}
