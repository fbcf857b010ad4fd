//! PLY files: no panic, and meshes that are meshes.
#![no_main]

use std::path::Path;

use etendue_fuzz::check_mesh;
use etendue_scene::load::{TexCoords, parse_ply};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    if let Ok(file) = parse_ply(data, Path::new("a.ply"), TexCoords::Flipped) {
        check_mesh(&file.mesh);
    }
});
