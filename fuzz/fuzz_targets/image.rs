//! Images of the kind that the variable `KIND` names by its extension: no panic that reaches the caller, and as many samples as the
//! image has pixels.
//!
//! Decoders of others may panic where `parse_image` catches it, which libFuzzer would take for a finding: here only what it lets
//! through is one.
#![no_main]

use std::panic::{catch_unwind, set_hook};
use std::path::PathBuf;
use std::process::abort;
use std::sync::LazyLock;

use etendue_scene::load::{Encoding, parse_image};
use libfuzzer_sys::fuzz_target;

/// The name of the file, and the bytes that all files of the kind begin with.
static KIND: LazyLock<(PathBuf, &[u8])> = LazyLock::new(|| {
    set_hook(Box::new(|_| {}));
    let kind = std::env::var("KIND").expect("the variable KIND");
    let begin: &[u8] = match kind.as_str() {
        "png" => b"\x89PNG\r\n\x1a\n",
        "jpg" => b"\xff\xd8\xff",
        "bmp" => b"BM",
        "tga" => b"",
        "hdr" => b"#?RADIANCE",
        "exr" => b"\x76\x2f\x31\x01",
        "pfm" => b"P",
        _ => panic!("KIND is none of png, jpg, bmp, tga, hdr, exr, pfm"),
    };
    (PathBuf::from("a").with_extension(kind), begin)
});

fuzz_target!(|data: &[u8]| {
    let (path, begin) = &*KIND;
    let mut bytes = data.to_vec();
    if bytes.len() >= begin.len() {
        bytes[..begin.len()].copy_from_slice(begin);
    }
    let read = || parse_image(&bytes, path, Encoding::Srgb);
    let Ok(read) = catch_unwind(read) else {
        eprintln!("panicked");
        abort();
    };
    if let Ok(image) = read {
        let pixels = image.width() as usize * image.height() as usize;
        if image.data().len() != pixels * image.channels() {
            eprintln!("{} samples in {pixels} pixels", image.data().len());
            abort();
        }
    }
});
