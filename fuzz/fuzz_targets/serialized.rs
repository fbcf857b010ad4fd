//! Mitsuba's `serialized` files, their first three meshes: no panic, and meshes that are meshes.
#![no_main]

use std::path::Path;

use etendue_fuzz::check_mesh;
use etendue_scene::load::parse_serialized;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    for index in 0..3 {
        if let Ok(file) = parse_serialized(data, Path::new("a.serialized"), index) {
            check_mesh(&file.mesh);
        }
    }
});
