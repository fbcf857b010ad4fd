//! Valid files of every kind, cut off after each byte or with one byte changed: a mesh, picture, volume or scene, or an error of that
//! file; never a panic, and never a mesh that is not what a mesh must be.

mod samples;

use std::fs;
use std::path::Path;

use etendue_scene::geometry::MeshArrays;
use etendue_scene::load::{
    Encoding, TexCoords, parse_image, parse_mtl, parse_obj, parse_obj_merged, parse_ply,
    parse_serialized, parse_volume,
};
use etendue_scene::{LoadOptions, SceneError, load_scene};

/// Reads a file by its extension. Files of more than one mesh are read to their last.
fn read(name: &str, bytes: &[u8]) -> Result<(), SceneError> {
    let path = Path::new(name);
    let extension = path.extension().and_then(|e| e.to_str()).expect("an extension");
    match extension {
        "obj" => {
            let library = |_: &Path| Ok(b"newmtl wood\nKd 1 0 0\n".to_vec());
            let parts = parse_obj(bytes, path, TexCoords::Flipped, library)?;
            let whole = parse_obj_merged(bytes, path, TexCoords::AsWritten)?.mesh;
            parts.meshes.iter().for_each(|part| check(&part.mesh));
            check(&whole);
            let triangles: usize =
                parts.meshes.iter().map(|part| part.mesh.triangles().len()).sum();
            assert_eq!(triangles, whole.triangles().len());
        }
        "mtl" => drop(parse_mtl(bytes, path)?),
        "ply" => check(&parse_ply(bytes, path, TexCoords::AsWritten)?.mesh),
        "serialized" => {
            for index in 0..2 {
                check(&parse_serialized(bytes, path, index)?.mesh);
            }
        }
        "vol" => drop(parse_volume(bytes, path)?),
        _ => {
            let image = parse_image(bytes, path, Encoding::Srgb)?;
            let pixels = image.width() as usize * image.height() as usize;
            assert_eq!(image.data().len(), pixels * image.channels());
        }
    }
    Ok(())
}

fn check(mesh: &MeshArrays) {
    let vertices = mesh.positions().len();
    assert!(mesh.positions().iter().chain(mesh.normals()).all(|v| v.is_finite()));
    assert!(mesh.uvs().iter().all(|uv| uv.is_finite()));
    assert!(mesh.triangles().as_flattened().iter().all(|&v| (v as usize) < vertices));
    assert!(
        [0, vertices].contains(&mesh.normals().len()) && [0, vertices].contains(&mesh.uvs().len())
    );
}

fn is_scene(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|extension| extension == "xml" || extension == "glb")
}

/// The file cut off after each byte, and with each byte changed in three ways.
fn damaged(bytes: &[u8]) -> impl Iterator<Item = Vec<u8>> {
    let changed = |at: usize, byte: u8| {
        let mut altered = bytes.to_vec();
        altered[at] = byte;
        altered
    };
    (0..bytes.len()).flat_map(move |at| {
        let byte = bytes[at];
        let altered =
            [byte ^ 0xff, byte ^ 0x10, byte.wrapping_add(1)].map(|byte| changed(at, byte));
        altered.into_iter().chain([bytes[..at].to_vec()])
    })
}

#[test]
fn damaged_assets_are_read_or_refused() {
    for (name, bytes) in samples::samples() {
        if is_scene(&name) {
            continue;
        }
        assert_eq!(read(&name, &bytes), Ok(()), "{name}");
        let refused = damaged(&bytes).filter_map(|bytes| read(&name, &bytes).err());
        let refused: Vec<SceneError> = refused.collect();
        assert!(refused.len() > 20, "{name}: {}", refused.len());
        assert!(refused.iter().all(|e| e.location.file == Path::new(&name)), "{name}");
    }
}

#[test]
fn damaged_scenes_are_read_or_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let samples = samples::samples();
    for (name, bytes) in &samples {
        fs::write(folder.path().join(name), bytes).expect("written");
    }
    for (name, bytes) in samples.iter().filter(|(name, _)| is_scene(name)) {
        let path = folder.path().join(format!("damaged-{name}"));
        let read = |bytes: &[u8]| {
            fs::write(&path, bytes).expect("written");
            load_scene(&path, &LoadOptions::default()).map(|_| ())
        };
        let whole = read(bytes);
        // One shows what is refused: an unused parameter, or a name for something that is not there.
        assert_eq!(
            whole.is_ok(),
            ["scene.xml", "included.xml", "model.glb"].contains(&name.as_str()),
            "{name}: {whole:?}"
        );
        let refused = damaged(bytes).filter(|bytes| read(bytes).is_err()).count();
        assert!(refused > bytes.len(), "{name}: {refused}");
    }
}
