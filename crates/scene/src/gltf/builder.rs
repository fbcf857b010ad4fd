//! What is gathered while a document is translated.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::rc::Rc;
use alloc::string::String;
use alloc::vec::Vec;
use std::path::PathBuf;

use super::buffers::Buffers;
use super::camera::View;
use super::document::Document;
use super::image::{self, Pixels};
use super::json::Json;
use super::material::{Look, Substance};
use super::texture::Key;
use crate::effect::Element;
use crate::geometry::GeometryBuilder;
use crate::light::Light;
use crate::material::{Material, MaterialId, Materials};
use crate::medium::Media;
use crate::scene::SurfaceInfo;
use crate::texture::{TextureId, Textures};
use crate::{Color, SceneError, Warning};

/// What a document describes, in our vocabulary.
#[derive(Default)]
pub(crate) struct Model {
    pub(crate) textures: Textures,
    pub(crate) materials: Materials,
    pub(crate) geometry: GeometryBuilder,
    /// By shape.
    pub(crate) surfaces: Vec<SurfaceInfo>,
    pub(crate) lights: Vec<Light>,
    pub(crate) media: Media,
    /// None where the document has no camera.
    pub(crate) view: Option<View>,
    pub(crate) warnings: Vec<Warning>,
    /// Those read beside the document.
    pub(crate) files: Vec<PathBuf>,
    /// Where elements are described: the place in the document, with its name.
    pub(crate) places: Vec<(Element, String)>,
}

/// A model in the making.
pub(super) struct Builder<'a> {
    pub(super) buffers: &'a Buffers<'a>,
    pub(super) model: Model,
    /// Decoded already, since many textures may look at them.
    images: BTreeMap<usize, Rc<Pixels>>,
    /// Translated already.
    pub(super) textures_made: BTreeMap<Key, TextureId>,
    pub(super) substances_made: BTreeMap<Look, Substance>,
    /// What was said already.
    said: BTreeSet<String>,
}

impl<'a> Builder<'a> {
    pub(super) fn new(buffers: &'a Buffers<'a>) -> Self {
        Self {
            buffers,
            model: Model::default(),
            images: BTreeMap::new(),
            textures_made: BTreeMap::new(),
            substances_made: BTreeMap::new(),
            said: BTreeSet::new(),
        }
    }

    pub(super) fn document(&self) -> &'a Document {
        self.buffers.document()
    }

    /// Notes something suspicious, once.
    pub(super) fn warn(&mut self, warning: &Warning) {
        if self.said.insert(warning.message.clone()) {
            self.model.warnings.push(warning.clone());
        }
    }

    /// Notes where an element is described.
    pub(super) fn note(&mut self, element: Element, json: &Json<'_>) -> Result<(), SceneError> {
        let name = json.text("name")?.map(|name| format!(" “{name}”")).unwrap_or_default();
        self.model.places.push((element, format!("{}{name}", json.place())));
        Ok(())
    }

    /// An image of the document.
    pub(super) fn pixels(
        &mut self,
        index: usize,
        json: &Json<'_>,
    ) -> Result<Rc<Pixels>, SceneError> {
        if let Some(pixels) = self.images.get(&index) {
            return Ok(Rc::clone(pixels));
        }
        let pixels = Rc::new(image::read(self.buffers, json, &mut self.model.files)?);
        self.images.insert(index, Rc::clone(&pixels));
        Ok(pixels)
    }

    /// A number that is the same everywhere.
    pub(super) fn constant(&mut self, number: f32) -> TextureId {
        self.model.textures.constant(Color::new(number, number, number))
    }

    /// Adds a material that an object of the document describes.
    pub(super) fn add(
        &mut self,
        material: Material,
        json: &Json<'_>,
    ) -> Result<MaterialId, SceneError> {
        let id = self.model.materials.add(material).map_err(|error| json.error(error))?;
        self.note(Element::Material(id), json)?;
        Ok(id)
    }
}
