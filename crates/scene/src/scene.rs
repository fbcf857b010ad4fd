//! Everything that is rendered, in one place.

mod check;
mod lighting;
mod settings;

use alloc::string::String;
use alloc::vec::Vec;

use etendue_math::Vector3;

use crate::camera::Camera;
use crate::film::Film;
use crate::geometry::{Geometry, Located, SurfacePoint};
use crate::light::{Light, LightId};
use crate::material::{MaterialId, Materials, PreparedBsdf, Side};
use crate::texture::Textures;

pub use check::InvalidScene;
pub use settings::{PathSettings, SamplerKind, SamplingSettings};

/// What belongs to a shape besides its form.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceInfo {
    /// What it is made of.
    pub material: MaterialId,
    /// The area light that it is.
    pub light: Option<LightId>,
    /// What the scene file calls it, for messages.
    pub name: String,
}

/// What a scene is made from.
#[derive(Debug)]
pub struct SceneParts {
    /// Shapes.
    pub geometry: Geometry,
    /// One entry per shape, in the order of [`ShapeId`](crate::geometry::ShapeId).
    pub surfaces: Vec<SurfaceInfo>,
    /// Materials.
    pub materials: Materials,
    /// Textures.
    pub textures: Textures,
    /// Lights, in the order of [`LightId`].
    pub lights: Vec<Light>,
    /// Camera.
    pub camera: Camera,
    /// Film.
    pub film: Film,
    /// Sampling.
    pub sampling: SamplingSettings,
    /// Paths.
    pub path: PathSettings,
}

/// A scene: what there is, where it is seen from, and how it is to be rendered.
///
/// References between the parts have been checked.
#[derive(Debug)]
pub struct Scene {
    /// Shapes.
    pub geometry: Geometry,
    /// One entry per shape, in the order of [`ShapeId`](crate::geometry::ShapeId).
    pub surfaces: Vec<SurfaceInfo>,
    /// Materials.
    pub materials: Materials,
    /// Textures.
    pub textures: Textures,
    /// Lights, in the order of [`LightId`].
    pub lights: Vec<Light>,
    /// Camera.
    pub camera: Camera,
    /// Film.
    pub film: Film,
    /// Sampling.
    pub sampling: SamplingSettings,
    /// Paths.
    pub path: PathSettings,
    infinite_lights: Vec<LightId>,
    /// Radius of a sphere around all shapes.
    radius: f32,
}

impl Scene {
    /// A scene from its parts. One without shapes or lights is a scene too.
    ///
    /// # Errors
    /// Parts that do not fit together.
    pub fn new(mut parts: SceneParts) -> Result<Self, InvalidScene> {
        check::check(&mut parts)?;
        let SceneParts {
            geometry,
            surfaces,
            materials,
            textures,
            lights,
            camera,
            film,
            sampling,
            path,
        } = parts;
        let is_infinite = |id: &LightId| lights[id.0 as usize].is_infinite();
        let infinite_lights = (0..lights.len() as u32).map(LightId).filter(is_infinite).collect();
        let bounds = geometry.bounds();
        let radius = if bounds.is_empty() { 0.0 } else { 0.5 * Vector3::length(bounds.extent()) };
        Ok(Self {
            geometry,
            surfaces,
            materials,
            textures,
            lights,
            camera,
            film,
            sampling,
            path,
            infinite_lights,
            radius,
        })
    }

    /// A point that the geometry has given, as [`prepare`](Self::prepare) takes it.
    #[inline]
    pub fn locate(&self, point: SurfacePoint) -> Located<'_> {
        Located::new(&self.geometry, point)
    }

    /// The reflection model at a point looked at from one side, for directions in its shading frame.
    #[inline]
    pub fn prepare<'a>(&'a self, surface: &'a Located<'a>, side: Side) -> PreparedBsdf<'a> {
        let material = self.surfaces[surface.point().shape.0 as usize].material;
        self.materials.prepare(material, &self.textures, surface.into(), side)
    }
}

#[cfg(test)]
mod tests;
