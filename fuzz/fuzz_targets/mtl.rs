//! MTL text: no panic.
#![no_main]

use std::path::Path;

use etendue_scene::load::parse_mtl;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let _refused = parse_mtl(data, Path::new("a.mtl"));
});
