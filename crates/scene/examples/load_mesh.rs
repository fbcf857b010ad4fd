//! Loads one mesh and says how long it took: `load_mesh FILE`, an OBJ or PLY file.
//!
//! What is timed is what a scene file's `<shape>` asks for before it is placed: the file is read, checked and, where it has no
//! normals, given smooth ones. No hierarchy is built. The program waits for a line before it loads and after it has printed the
//! seconds and the number of triangles, so that `tests/measure/load_speed.py` can ask the system for its memory meanwhile.

use core::error::Error;
use std::io::stdin;
use std::path::Path;
use std::time::Instant;

use etendue_scene::load::{TexCoords, load_obj_merged, load_ply, smooth_normals};

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("usage: load_mesh FILE")?;
    let path = Path::new(&file);
    println!("ready");
    stdin().read_line(&mut String::new())?;
    let start = Instant::now();
    let mut mesh = if path.extension().is_some_and(|e| e == "obj") {
        load_obj_merged(path, TexCoords::Flipped)?.mesh
    } else {
        load_ply(path, TexCoords::AsWritten)?.mesh
    };
    if mesh.normals().is_empty() {
        let normals = smooth_normals(&mesh);
        mesh = mesh.with_normals(normals)?;
    }
    println!("{} {}", start.elapsed().as_secs_f64(), mesh.triangles().len());
    stdin().read_line(&mut String::new())?;
    Ok(())
}
