//! The entry point of loading.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use std::path::{Path, PathBuf};

use super::origins::Origins;
use super::{Context, bare, model, scene};
use crate::film::Crop;
use crate::load::Sandbox;
use crate::scene::{Layer, SamplerKind, Scene};
use crate::xml::{Leniency, parse_file};
use crate::{Location, SceneError, Warning};

/// What the caller asks for beside what the file says.
#[derive(Clone, Debug, Default)]
pub struct LoadOptions {
    /// What `$name` stands for in a scene file, before any `<default>`.
    pub definitions: Vec<(String, String)>,
    /// Whether unknown parameters are errors.
    pub leniency: Leniency,
    /// Another size of the picture in pixels; the crop of the file is then dropped.
    pub film_size: Option<[u32; 2]>,
    /// Another crop.
    pub crop: Option<Crop>,
    /// Another number of samples per pixel.
    pub samples_per_pixel: Option<u32>,
    /// Another limit of path lengths in edges; −1 for none.
    pub max_depth: Option<i64>,
    /// Another sampler.
    pub sampler: Option<SamplerKind>,
    /// Another seed.
    pub seed: Option<u64>,
    /// What a bare mesh or all of a model is made of, as `TYPE[:key=value,…]` with the names of scene files, such as
    /// `roughconductor:material=Au,alpha=0.2` or `diffuse:reflectance=0.8 0.2 0.1`.
    pub bsdf: Option<String>,
    /// Whether files outside of the folder of the scene file are refused, wherever links and `..` lead: for scenes that are not
    /// trusted.
    pub sandbox: bool,
}

/// A scene with how it came about.
#[derive(Debug)]
pub struct LoadedScene {
    /// The scene.
    pub scene: Scene,
    /// What looks suspicious, in the order in which it was found.
    pub warnings: Vec<Warning>,
    /// Every file that was read, the scene's own first.
    pub files: Vec<PathBuf>,
    /// The layers that it asks for beside the picture: what a render may add is not part of a scene.
    pub layers: Vec<Layer>,
    /// Where its parts are described.
    pub origins: Origins,
}

/// Loads a scene file (`.xml`), a model (`.gltf`, `.glb`) or a bare mesh (`.obj`, `.ply`).
///
/// A model without lights and surfaces that shine, or without a camera, has those of a bare mesh.
///
/// A bare mesh stands in white light of radiance 1 from everywhere, unless it emits light itself, seen from its front, right
/// and above by a camera that holds all of it; y is up. It is made of [`LoadOptions::bsdf`], of the materials of its MTL file,
/// or of grey that reflects a half, on both sides.
///
/// # Errors
/// Files that cannot be read, content that is wrong or not supported, and demands for too much
/// memory, each with its place.
///
/// # Examples
/// ```
/// use etendue_scene::{LoadOptions, load_scene};
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("ball.xml");
/// std::fs::write(&path, r#"<scene version="3.0.0">
///     <default name="albedo" value="0.5"/>
///     <emitter type="constant"/>
///     <shape type="sphere"><bsdf type="diffuse">
///         <rgb name="reflectance" value="$albedo"/>
///     </bsdf></shape>
/// </scene>"#)?;
/// let definitions = vec![("albedo".to_string(), "0.8".to_string())];
/// let loaded = load_scene(&path, &LoadOptions { definitions, ..LoadOptions::default() })?;
/// assert_eq!(loaded.scene.surfaces.len(), 1);
/// assert!(loaded.warnings[0].to_string().contains("there is no sensor"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn load_scene(path: &Path, options: &LoadOptions) -> Result<LoadedScene, SceneError> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let sandbox = if options.sandbox { Sandbox::beside(path)? } else { Sandbox::default() };
    match extension.as_str() {
        "xml" => {
            let description = parse_file(path, &options.definitions, options.leniency, &sandbox)?;
            scene::scene(Context::new(&description, options, sandbox))
        }
        "gltf" | "glb" => model::scene(path, options, sandbox),
        "obj" | "ply" => bare::mesh(path, options, sandbox),
        _ => {
            let message = format!("a scene cannot be read from a file named “.{extension}”");
            Err(SceneError::scene(Location::file(path), message)
                .help("scenes are .xml, .gltf or .glb, bare meshes .obj or .ply"))
        }
    }
}
