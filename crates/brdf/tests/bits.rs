//! With the `libm` backend everything has the bits of `bits.txt`, on every target.
//!
//! The firmware and the WebAssembly module in `embedded/` print hashes of the same functions over the
//! same inputs, which `embedded/run.sh` compares with the same file. A change that is meant to change
//! bits rewrites it: `BITS=write cargo test -p etendue-brdf --features libm --test bits`.
#![cfg(feature = "libm")]

use std::path::{Path, PathBuf};
use std::{env, fs};

use etendue_specimens::Scalar;
use etendue_specimens::bits::{BRIEF, Hash, LONG, all, all_but};

/// Models whose tables are integrated, in double precision whatever the model's: half an hour for an interpreter, once.
const TABULATED: [&str; 2] = ["kulla-conty-dielectric", "rough-plastic"];

fn file() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bits.txt")
}

/// The line of every hash.
fn lines<T: Scalar>() -> Vec<String> {
    let mut lines = Vec::new();
    let mut report = |hash: Hash| {
        if cfg!(miri) {
            eprintln!("{hash}"); // how far it is
        }
        lines.push(hash.to_string());
    };
    if cfg!(miri) {
        let again = T::NAME == f64::NAME;
        all_but::<T>(if again { &TABULATED } else { &[] }, BRIEF, &mut report);
    } else {
        all::<T>(LONG, &mut report);
    }
    lines
}

/// Whether the file is to be written instead of read.
fn writes() -> bool {
    env::var_os("BITS").is_some_and(|value| value == "write")
}

fn check<T: Scalar>() {
    let pinned = fs::read_to_string(file()).unwrap();
    let lines = lines::<T>();
    let changed: Vec<_> =
        lines.iter().filter(|line| !pinned.lines().any(|p| p == **line)).collect();
    assert!(changed.is_empty(), "these are not in bits.txt:\n{changed:#?}");
}

#[test]
fn every_function_and_model_has_its_bits_in_single_precision() {
    if writes() {
        let heading = "# hash, precision, number of inputs, function or model".to_owned();
        let lines = [vec![heading], lines::<f32>(), lines::<f64>()].concat();
        fs::write(file(), lines.join("\n") + "\n").unwrap();
    }
    check::<f32>();
}

#[test]
fn every_function_and_model_has_its_bits_in_double_precision() {
    if !writes() {
        check::<f64>();
    }
}
