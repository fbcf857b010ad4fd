//! Scene files with all that they mean, which is read from a scratch folder that holds files of every kind: no panic.
#![no_main]

#[path = "../../crates/scene/tests/samples/mod.rs"]
mod samples;

use std::fs;
use std::sync::LazyLock;

use etendue_scene::xml::Leniency;
use etendue_scene::{LoadOptions, load_scene};
use libfuzzer_sys::fuzz_target;
use tempfile::TempDir;

/// What the seeds name.
const ASSETS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/scenes/assets");

static FOLDER: LazyLock<TempDir> = LazyLock::new(|| {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, bytes) in samples::samples() {
        fs::write(folder.path().join(name), bytes).expect("a writable folder");
    }
    for entry in fs::read_dir(ASSETS).expect("the repository").flatten() {
        fs::copy(entry.path(), folder.path().join(entry.file_name())).expect("a writable folder");
    }
    folder
});

fuzz_target!(|data: &[u8]| {
    if data.len() > 1 << 16 || leaves(data) {
        return;
    }
    let path = FOLDER.path().join("fuzzed.xml");
    fs::write(&path, data).expect("a writable folder");
    let options = LoadOptions { leniency: Leniency::Lenient, ..LoadOptions::default() };
    let _refused = load_scene(&path, &options);
});

/// Whether a value could name a file outside the folder: one that begins with a slash, itself, by a definition or by a
/// character's number; or one that goes up.
fn leaves(text: &[u8]) -> bool {
    let holds = |part: &[u8]| text.windows(part.len()).any(|window| window == part);
    let absolute = |window: &[u8]| matches!(window, [b'"' | b'\'', b'/', next] if *next != b'>');
    let after_name = |rest: &[u8]| {
        let end = rest.iter().position(|b| !b.is_ascii_alphanumeric() && *b != b'_');
        end.is_some_and(|end| matches!(rest[end], b'/' | b'\\'))
    };
    holds(b"..")
        || holds(b"&#")
        || text.windows(3).any(absolute)
        || text.split(|&byte| byte == b'$').skip(1).any(after_name)
}
