//! What is gathered while a description is translated.

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::vec::Vec;
use std::path::{Path, PathBuf};

use super::LoadOptions;
use super::origins::Origins;
use super::reader::PluginReader;
use super::sensor::Sensor;
use crate::geometry::{GeometryBuilder, GroupId, Shape, Shutter};
use crate::light::Light;
use crate::load::{Allowance, Sandbox};
use crate::material::{Material, MaterialId, Materials};
use crate::medium::{Media, MediumId};
use crate::scene::{Layer, SurfaceInfo};
use crate::texture::{TextureId, Textures};
use crate::xml::{Description, Node, NodeId, nearest};
use crate::{Location, SceneError, Warning};

/// Translates one plugin.
pub(super) type Translate<T> =
    for<'a> fn(&mut PluginReader<'a>, &mut Context<'a>) -> Result<T, SceneError>;

/// The plugins of one family: their names and what they mean.
pub(super) type Family<T> = [(&'static str, Translate<T>)];

/// A description of N plugins and references may be translated to `FREE + RATIO · N` parts: those that many refer to are translated
/// once, but for shapes that are merged and phase functions that are blended, of which a few lines could ask for without end.
const FREE: usize = 4096;
const RATIO: usize = 64;

/// The parts of a scene, as far as they are translated.
pub(super) struct Context<'a> {
    pub(super) description: &'a Description,
    pub(super) options: &'a LoadOptions,
    /// When the picture is taken.
    pub(super) shutter: Shutter,
    pub(super) warnings: Vec<Warning>,
    /// Files read beside the scene files themselves.
    pub(super) files: Vec<PathBuf>,
    /// Where all of them must lie.
    pub(super) sandbox: Sandbox,
    /// How much they may unfold to.
    allowance: Allowance,
    /// How many more plugins may be translated.
    left: usize,
    pub(super) textures: Textures,
    pub(super) materials: Materials,
    pub(super) geometry: GeometryBuilder,
    /// By shape.
    pub(super) surfaces: Vec<SurfaceInfo>,
    pub(super) lights: Vec<Light>,
    pub(super) media: Media,
    /// What the picture is to have beside its colours.
    pub(super) layers: Vec<Layer>,
    /// The shape whose irradiance meter is translated.
    pub(super) metered: Option<Shape>,
    /// The first sensor inside a shape.
    pub(super) meter: Option<Sensor>,
    /// Where what stands above is described.
    pub(super) origins: Origins,
    /// What was translated already, since many may refer to it.
    pub(super) texture_ids: BTreeMap<NodeId, TextureId>,
    pub(super) material_ids: BTreeMap<NodeId, MaterialId>,
    pub(super) medium_ids: BTreeMap<NodeId, MediumId>,
    pub(super) groups: BTreeMap<NodeId, GroupId>,
}

impl<'a> Context<'a> {
    pub(super) fn new(
        description: &'a Description,
        options: &'a LoadOptions,
        sandbox: Sandbox,
    ) -> Self {
        let nodes = description.nodes();
        let size: usize = nodes.iter().map(|node| 1 + node.children.len()).sum();
        Self {
            description,
            options,
            shutter: Shutter::default(),
            warnings: Vec::new(),
            files: Vec::new(),
            sandbox,
            allowance: Allowance::default(),
            left: FREE + RATIO * size,
            textures: Textures::default(),
            materials: Materials::default(),
            geometry: GeometryBuilder::new(),
            surfaces: Vec::new(),
            lights: Vec::new(),
            media: Media::default(),
            layers: Vec::new(),
            metered: None,
            meter: None,
            origins: Origins::default(),
            texture_ids: BTreeMap::new(),
            material_ids: BTreeMap::new(),
            medium_ids: BTreeMap::new(),
            groups: BTreeMap::new(),
        }
    }

    /// The file that is loaded.
    pub(super) fn file(&self) -> PathBuf {
        self.description.files.first().cloned().unwrap_or_default()
    }

    /// Notes something suspicious.
    pub(super) fn warn(&mut self, location: Location, message: impl Into<alloc::string::String>) {
        self.warnings.push(Warning::new(location, message));
    }

    /// Notes a file that was read and unfolded to so many bytes.
    ///
    /// # Errors
    /// More than there is reason for in files of this size.
    pub(super) fn read(&mut self, path: &Path, unfolded: usize) -> Result<(), SceneError> {
        self.files.push(path.to_path_buf());
        self.allowance.spend(path, unfolded)
    }

    /// Adds a material that is described at `location`.
    pub(super) fn add_material(
        &mut self,
        material: Material,
        location: &Location,
    ) -> Result<MaterialId, SceneError> {
        self.materials
            .add(material)
            .map_err(|e| SceneError::scene(location.clone(), format!("{e}")))
    }

    /// Translates a plugin of a family and checks that every parameter was understood.
    ///
    /// # Errors
    /// A plugin that the family does not have, and what its translation refuses.
    pub(super) fn translate<T>(
        &mut self,
        family: &Family<T>,
        node: &'a Node,
    ) -> Result<T, SceneError> {
        let Some((_, plugin)) = family.iter().find(|(name, _)| *name == node.plugin) else {
            return Err(unsupported(node, family.iter().map(|(name, _)| *name).collect()));
        };
        self.left = self.left.checked_sub(1).ok_or_else(|| {
            let message = "plugins refer to each other so often that the scene grows without end";
            SceneError::resource(node.location.clone(), message)
                .help("make instances of a shapegroup instead")
        })?;
        let mut reader = PluginReader::new(node);
        let result = plugin(&mut reader, self)?;
        reader.finish(self)?;
        Ok(result)
    }
}

/// The error for a plugin that is not in the list of those supported.
fn unsupported(node: &Node, mut names: Vec<&'static str>) -> SceneError {
    names.sort_unstable();
    let list = names.join(", ");
    let message = format!("the {} “{}” is not supported", node.kind.tag(), node.plugin);
    let error = SceneError::scene(node.location.clone(), message);
    match nearest(&node.plugin, names) {
        Some(name) => error.help(format!("did you mean “{name}”? Supported are {list}")),
        None => error.help(format!("supported are {list}")),
    }
}
