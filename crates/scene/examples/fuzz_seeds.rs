//! Writes what fuzz targets begin with: `fuzz_seeds FOLDER`, a folder of files for each target.

#[path = "../tests/samples/mod.rs"]
mod samples;

use core::error::Error;
use std::fs;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("usage: fuzz_seeds FOLDER")?;
    for (name, bytes) in samples::samples() {
        let kind = Path::new(&name).extension().and_then(|e| e.to_str()).unwrap_or_default();
        // Scenes are read twice: as a description, and with all that it means.
        let targets: &[&str] = match kind {
            "xml" => &["xml", "scene"],
            "glb" => &["gltf"],
            kind => &[kind],
        };
        for target in targets {
            let target = Path::new(&folder).join(target);
            fs::create_dir_all(&target)?;
            fs::write(target.join(&name), &bytes)?;
        }
    }
    Ok(())
}
