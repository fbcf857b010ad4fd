//! What is known while a scene is written.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::element::Element;
use super::names::Names;
use super::values::string;
use super::{ExportError, ExportedFile, Loss, image};
use crate::Scene;
use crate::geometry::ShapeId;
use crate::material::MaterialId;
use crate::medium::MediumId;
use crate::texture::{BitmapImage, TextureId};

use super::textures::Meaning;

/// The scene, and what is written of it so far.
///
/// Textures, materials and media are described once, when they are referred to first: those that nothing refers to are not
/// written.
pub(super) struct Exporter<'a> {
    pub(super) scene: &'a Scene,
    /// Whether paths carry wavelengths, so that curves count.
    pub(super) spectral: bool,
    pub(super) losses: BTreeSet<Loss>,
    pub(super) files: Vec<ExportedFile>,
    pub(super) textures: Vec<Element>,
    pub(super) materials: Vec<Element>,
    pub(super) media: Vec<Element>,
    pub(super) texture_ids: BTreeMap<(TextureId, Meaning), String>,
    pub(super) material_ids: BTreeMap<MaterialId, String>,
    pub(super) medium_ids: BTreeMap<MediumId, String>,
    /// The sensor that stands inside a shape instead of in the scene.
    pub(super) metering: Option<(ShapeId, Element)>,
    /// The first file that could not be written.
    pub(super) failure: Option<ExportError>,
    names: Names,
    folder: &'a str,
}

impl<'a> Exporter<'a> {
    pub(super) fn new(
        scene: &'a Scene,
        spectral: bool,
        losses: BTreeSet<Loss>,
        folder: &'a str,
    ) -> Self {
        Self {
            scene,
            spectral,
            losses,
            files: Vec::new(),
            textures: Vec::new(),
            materials: Vec::new(),
            media: Vec::new(),
            texture_ids: BTreeMap::new(),
            material_ids: BTreeMap::new(),
            medium_ids: BTreeMap::new(),
            metering: None,
            failure: None,
            names: Names::default(),
            folder,
        }
    }

    /// A name that nothing else has.
    pub(super) fn name(&mut self, wish: &str) -> String {
        self.names.unique(wish)
    }

    /// Adds an image; gives the parameter that names it.
    pub(super) fn image(&mut self, name: &str, image: &BitmapImage) -> Element {
        let bytes = image::exr(image).unwrap_or_else(|error| {
            self.failure.get_or_insert(error);
            Vec::new()
        });
        self.file(name, "exr", bytes)
    }

    /// Adds a file; gives the parameter that names it.
    pub(super) fn file(&mut self, name: &str, extension: &str, bytes: Vec<u8>) -> Element {
        let name = format!("{name}.{extension}");
        let path = match self.folder {
            "" => name.clone(),
            folder => format!("{folder}/{name}"),
        };
        self.files.push(ExportedFile { name, bytes });
        string("filename", &path)
    }
}
