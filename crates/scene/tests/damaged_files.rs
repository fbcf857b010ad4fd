//! Valid files of every kind, cut off after each byte, with one byte changed or mutated at random: a mesh, picture, volume or scene,
//! or an error of that file; never a panic, and never a mesh that is not what a mesh must be.
//!
//! The variable `MUTATIONS` is the number of mutations of each kind of file.

mod mutation;
mod samples;

use core::panic::AssertUnwindSafe;
use core::time::Duration;
use std::env;
use std::fs;
use std::panic::{catch_unwind, resume_unwind};
use std::path::Path;
use std::time::Instant;

use mutation::{Random, mutated};

use etendue_scene::geometry::{CurveBasis, MeshArrays};
use etendue_scene::load::{
    Encoding, TexCoords, parse_curves, parse_image, parse_mtl, parse_obj, parse_obj_merged,
    parse_ply, parse_sdf, parse_serialized, parse_volume,
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
        "vol" => {
            drop(parse_sdf(bytes, path));
            drop(parse_volume(bytes, path)?);
        }
        "curves" => {
            for basis in [CurveBasis::Linear, CurveBasis::BSpline] {
                let file = parse_curves(bytes, path, basis)?;
                let points: u32 = file.lengths.iter().sum();
                assert_eq!(points as usize, file.points.len());
            }
        }
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
    ["xml", "glb", "gltf", "spd"].contains(&kind(name))
}

/// The kind of a file.
fn kind(name: &str) -> &str {
    name.rsplit('.').next().expect("an extension")
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
        let whole = load(folder.path(), name, bytes);
        // Some show what is refused: an unused parameter, or a name for something that is not there.
        assert_eq!(
            whole.is_ok(),
            !["shapes.xml", "old.xml"].contains(&name.as_str()),
            "{name}: {whole:?}"
        );
        let refused =
            damaged(bytes).filter(|bytes| load(folder.path(), name, bytes).is_err()).count();
        assert!(refused > bytes.len() / 2, "{name}: {refused}");
    }
}

/// What names a spectrum.
const LIT: &str = r#"<scene version="3.0.0"><emitter type="constant">
<spectrum name="radiance" filename="changed.spd"/></emitter></scene>"#;

/// Loads a scene or model, or the scene of a spectrum, beside the other samples.
fn load(folder: &Path, name: &str, bytes: &[u8]) -> Result<(), SceneError> {
    let mut path = folder.join("changed").with_extension(kind(name));
    fs::write(&path, bytes).expect("written");
    if kind(name) == "spd" {
        path = folder.join("lit.xml");
        fs::write(&path, LIT).expect("written");
    }
    load_scene(&path, &LoadOptions { sandbox: true, ..LoadOptions::default() }).map(|_| ())
}

/// A thousand times what a file takes: it is only to end.
const LONGEST: Duration = Duration::from_secs(20);

/// Mutates the samples of a kind. What a mutation panics with is preceded by what makes it again.
fn mutate(kind_of_file: &str) {
    let count = env::var("MUTATIONS").map_or(500, |text| text.parse().expect("a number"));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let samples = samples::samples();
    for (name, bytes) in &samples {
        fs::write(folder.path().join(name), bytes).expect("written");
    }
    let own: Vec<_> = samples.iter().filter(|(name, _)| kind(name) == kind_of_file).collect();
    let (mut refused, mut slowest) = (0, Duration::ZERO);
    for index in 0..count {
        let mut random = Random::of(kind_of_file, index);
        let of = |index: u64| own[index as usize % own.len()];
        let ((name, bytes), (_, other)) = (of(index), of(index / own.len() as u64));
        let file = mutated(bytes, other, &mut random);
        let start = Instant::now();
        let outcome = catch_unwind(AssertUnwindSafe(|| {
            let outcome =
                if is_scene(name) { load(folder.path(), name, &file) } else { read(name, &file) };
            outcome.is_err()
        }));
        let took = start.elapsed();
        let made = || format!("mutation {index} of {kind_of_file}, from {name}");
        match outcome {
            Ok(is_refused) => refused += u64::from(is_refused),
            Err(panic) => {
                eprintln!("{}", made());
                resume_unwind(panic);
            }
        }
        assert!(took < LONGEST, "{}: {took:?}", made());
        slowest = slowest.max(took);
    }
    println!(
        "{kind_of_file}: {count} mutations, {refused} refused, none took longer than {slowest:.1?}"
    );
    assert!(refused > count / 20 && refused < count, "{kind_of_file}: {refused} of {count}");
}

/// A test for each kind, so that they run side by side.
macro_rules! kinds {
    ($($name:ident: $kind:literal),*) => {
        mod mutations {
            $(#[test] fn $name() { super::mutate($kind); })*

            #[test]
            fn every_kind_is_mutated() {
                let all = super::samples::samples();
                let mut kinds: Vec<&str> = all.iter().map(|(name, _)| super::kind(name)).collect();
                kinds.sort_unstable();
                kinds.dedup();
                assert_eq!(kinds, [$($kind),*]);
            }
        }
    };
}

kinds! {
    of_bmp: "bmp", of_curves: "curves", of_exr: "exr", of_glb: "glb", of_gltf: "gltf", of_hdr: "hdr",
    of_jpg: "jpg", of_mtl: "mtl", of_obj: "obj", of_pfm: "pfm", of_ply: "ply", of_png: "png",
    of_serialized: "serialized", of_spd: "spd", of_tga: "tga", of_vol: "vol", of_xml: "xml"
}
