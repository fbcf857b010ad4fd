//! Scenes as files of Mitsuba 3.
//!
//! [`export`] translates a [`Scene`] back into the plugins that mean the same there, whatever it was loaded from: text in
//! Mitsuba's XML, and the files that it names, with the bits that are held in memory. What Mitsuba 3 does not have is written as
//! the nearest plugin that it has, and named in [`Export::losses`]. Read again, a scene that lost nothing renders to the same
//! bits.
//!
//! One file here per family of plugins, each with one exhaustive match.

mod baked;
mod camera;
mod element;
mod exporter;
mod fields;
mod film;
mod image;
mod integrator;
mod lights;
mod loss;
mod materials;
mod media;
mod mesh;
mod names;
mod shapes;
mod textures;
mod values;
mod volumes;

#[cfg(test)]
mod tests;

use alloc::collections::BTreeSet;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

pub use loss::Loss;

use crate::Scene;
use crate::scene::Layer;
use element::Element;
use exporter::Exporter;

/// A scene as files.
#[derive(Clone, Debug, PartialEq)]
pub struct Export {
    /// The scene file.
    pub xml: String,
    /// The files that it names: meshes, images and volumes.
    pub files: Vec<ExportedFile>,
    /// What is lost, each kind once.
    pub losses: BTreeSet<Loss>,
}

/// A file that a scene file names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportedFile {
    /// Its name within the folder of files.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

/// How a scene is written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ExportOptions {
    /// The folder of the files as the scene file names it, relative to itself.
    pub folder: String,
    /// A remark at the head of the scene file.
    pub remark: String,
    /// The layers that a picture has beside its colours.
    pub layers: Vec<Layer>,
}

/// Why a scene cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// An image cannot be encoded.
    #[error("an image cannot be encoded: {0}")]
    Image(#[from] ::exr::error::Error),
}

/// A scene as files of Mitsuba 3.
///
/// # Errors
/// An image that OpenEXR has no room for.
///
/// # Examples
/// ```
/// use etendue_scene::export::{ExportOptions, export};
/// use etendue_scene::{LoadOptions, load_scene};
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("ball.xml");
/// std::fs::write(&path, r#"<scene version="0.6.0"><shape type="sphere"/></scene>"#)?;
/// let loaded = load_scene(&path, &LoadOptions::default())?;
/// let export = export(loaded.scene, &ExportOptions::default())?;
/// assert!(export.xml.contains("<shape type=\"sphere\""));
/// assert!(export.files.is_empty() && export.losses.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn export(scene: Scene, options: &ExportOptions) -> Result<Export, ExportError> {
    let spectral = scene.path.spectral || scene.has_dispersion();
    let (scene, losses) = loss::without_what_is_lost(scene);
    let mut exporter = Exporter::new(&scene, spectral, losses, &options.folder);
    let integrator = integrator::element(&mut exporter);
    let integrator = integrator::with_layers(integrator, &options.layers);
    let sensor = camera::sensor(&mut exporter);
    let sensor = shapes::inside(&mut exporter, sensor);
    let shapes = shapes::elements(&mut exporter);
    let lights = lights::elements(&mut exporter);
    let Exporter { textures, materials, media, files, losses, failure, .. } = exporter;
    if let Some(failure) = failure {
        return Err(failure);
    }
    let spp = Element::new("default")
        .attribute("name", "spp")
        .attribute("value", scene.sampling.samples_per_pixel.to_string());
    let parts = [
        Vec::from([spp]),
        [integrator].into_iter().chain(sensor).collect(),
        textures,
        materials,
        media,
        shapes,
        lights,
    ];
    let mut xml = format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!-- {} -->\n<scene version=\"3.0.0\">\n",
        element::comment(&options.remark)
    );
    for (number, part) in parts.iter().filter(|part| !part.is_empty()).enumerate() {
        if number > 0 {
            xml.push('\n');
        }
        for element in part {
            element.write(1, &mut xml);
        }
    }
    xml += "</scene>\n";
    Ok(Export { xml, files, losses })
}
