//! OBJ text with its material library: no panic, meshes that are meshes, and the same triangles whether parts are kept apart or not.
//!
//! The library is what follows the first NUL.
#![no_main]

use std::path::Path;

use etendue_fuzz::check_mesh;
use etendue_scene::load::{TexCoords, parse_obj, parse_obj_merged};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let end = data.iter().position(|&byte| byte == 0).unwrap_or(data.len());
    let (text, library) = data.split_at(end);
    let path = Path::new("a.obj");
    let whole = parse_obj_merged(text, path, TexCoords::AsWritten);
    if let Ok(file) = &whole {
        check_mesh(&file.mesh);
    }
    if let Ok(scene) = parse_obj(text, path, TexCoords::Flipped, |_| Ok(library.to_vec())) {
        scene.meshes.iter().for_each(|part| check_mesh(&part.mesh));
        let triangles: usize = scene.meshes.iter().map(|part| part.mesh.triangles().len()).sum();
        let whole = whole.expect("nothing is wrong with its parts");
        assert_eq!(triangles, whole.mesh.triangles().len());
    }
});
