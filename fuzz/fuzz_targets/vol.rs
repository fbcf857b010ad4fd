//! Volume files: no panic, and only values that a medium can have.
#![no_main]

use std::path::Path;

use etendue_scene::load::parse_volume;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Ok(file) = parse_volume(data, Path::new("a.vol")) else { return };
    let [x, y, z] = file.grid.size();
    for cell in [[0; 3], [x - 1, y - 1, z - 1]] {
        assert!(file.grid.cell(cell).to_array().iter().all(|&c| c >= 0.0 && c.is_finite()));
    }
});
