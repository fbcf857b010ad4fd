//! glTF documents and binary glTF, beside the files of a model: no panic.
#![no_main]

use std::fs;
use std::sync::LazyLock;

use etendue_scene::{LoadOptions, load_scene};
use libfuzzer_sys::fuzz_target;
use tempfile::TempDir;

/// What the seeds name.
const ASSETS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/gltf");

static FOLDER: LazyLock<TempDir> = LazyLock::new(|| {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for name in ["still-life.bin", "leaf.png"] {
        let from = std::path::Path::new(ASSETS).join(name);
        fs::copy(from, folder.path().join(name)).expect("a writable folder");
    }
    folder
});

fuzz_target!(|data: &[u8]| {
    if leaves(data) {
        return;
    }
    let name = if data.starts_with(b"glTF") { "fuzzed.glb" } else { "fuzzed.gltf" };
    let path = FOLDER.path().join(name);
    fs::write(&path, data).expect("a writable folder");
    let _refused = load_scene(&path, &LoadOptions::default());
});

/// Whether a string could name a file outside the folder: one that begins with a slash or goes up, itself or by the numbers of its
/// characters.
fn leaves(text: &[u8]) -> bool {
    let holds = |part: &[u8]| text.windows(part.len()).any(|window| window == part);
    [&b".."[..], b"\"/", b"\\", b"%2e", b"%2E", b"%2f", b"%2F"].iter().any(|part| holds(part))
}
