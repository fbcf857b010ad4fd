//! Everything that is rendered, in one place.

mod check;
mod lighting;
mod settings;

use alloc::collections::BTreeSet;
use alloc::string::String;
use alloc::vec::Vec;

use etendue_math::Vector3;

use crate::camera::Camera;
use crate::color::Primaries;
use crate::film::Film;
use crate::geometry::{Geometry, Located, ShapeId, SurfacePoint};
use crate::light::{Light, LightId};
use crate::material::{Material, MaterialId, Materials, Nesting, PreparedBsdf, Side};
use crate::medium::{Boundary, Media, MediumId};
use crate::texture::Textures;

pub use check::InvalidScene;
pub use settings::{Layer, PathSettings, SamplerKind, SamplingSettings, Shows};

/// What belongs to a shape besides its form.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceInfo {
    /// What it is made of.
    pub material: MaterialId,
    /// The area light that it is.
    pub light: Option<LightId>,
    /// The media on its sides; none where it lies within whatever is around it.
    pub boundary: Option<Boundary>,
    /// What the scene file calls it, for messages.
    pub name: String,
}

/// What a scene is made from.
#[derive(Debug)]
pub struct SceneParts {
    /// Shapes.
    pub geometry: Geometry,
    /// One entry per shape, in the order of [`ShapeId`].
    pub surfaces: Vec<SurfaceInfo>,
    /// Materials.
    pub materials: Materials,
    /// Textures.
    pub textures: Textures,
    /// Lights, in the order of [`LightId`].
    pub lights: Vec<Light>,
    /// Participating media.
    pub media: Media,
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
#[derive(Clone, Debug)]
pub struct Scene {
    /// Shapes.
    pub geometry: Geometry,
    /// One entry per shape, in the order of [`ShapeId`].
    pub surfaces: Vec<SurfaceInfo>,
    /// Materials.
    pub materials: Materials,
    /// Textures.
    pub textures: Textures,
    /// Lights, in the order of [`LightId`].
    pub lights: Vec<Light>,
    /// Participating media.
    pub media: Media,
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
            media,
            camera,
            film,
            sampling,
            path,
        } = parts;
        let infinite_lights = infinite(&lights);
        let bounds = geometry.bounds();
        let radius = if bounds.is_empty() { 0.0 } else { 0.5 * Vector3::length(bounds.extent()) };
        let scene = Self {
            geometry,
            surfaces,
            materials,
            textures,
            lights,
            media,
            camera,
            film,
            sampling,
            path,
            infinite_lights,
            radius,
        };
        check::check_powers(&scene)?;
        Ok(scene)
    }

    /// Removes the lights that are not to be kept; shapes that were such a light stay where they are and emit nothing.
    pub(crate) fn retain_lights(&mut self, keep: impl Fn(&Light) -> bool) {
        let mut count = 0;
        let renumbered: Vec<Option<LightId>> = (self.lights.iter())
            .map(|light| {
                keep(light).then(|| {
                    count += 1;
                    LightId(count - 1)
                })
            })
            .collect();
        self.lights.retain(keep);
        for surface in &mut self.surfaces {
            surface.light = surface.light.and_then(|light| renumbered[light.0 as usize]);
        }
        self.infinite_lights = infinite(&self.lights);
    }

    /// Whether anything moves while the shutter is open, so that paths belong to a moment.
    pub fn has_motion(&self) -> bool {
        self.camera.is_moving() || self.geometry.moving_count() > 0
    }

    /// The media on a side of a shape, and that around the camera. Paths meet them if they
    /// [know media](PathSettings::volumes).
    pub fn media_in_use(&self) -> BTreeSet<MediumId> {
        let sides = |boundary: Boundary| [boundary.interior, boundary.exterior];
        let of_shapes = self.surfaces.iter().filter_map(|s| s.boundary).flat_map(sides);
        of_shapes.chain([self.media.around_camera]).flatten().collect()
    }

    /// Whether there is anything between the surfaces, or light that passes one straight on: what
    /// [paths that know media](PathSettings::volumes) treat differently from others.
    pub fn has_volumes(&self) -> bool {
        let may_pass = |surface: &SurfaceInfo| self.materials.may_pass(surface.material);
        !self.media_in_use().is_empty() || self.surfaces.iter().any(may_pass)
    }

    /// Whether a surface refracts light of different wavelengths into different directions.
    pub fn has_dispersion(&self) -> bool {
        let used = self.materials.with_parts(self.surfaces.iter().map(|surface| surface.material));
        used.into_iter().any(|id| self.materials.get(id).is_some_and(Material::disperses))
    }

    /// The body among others whose surface a shape is, if it is one.
    #[inline]
    pub fn nesting(&self, shape: ShapeId) -> Option<Nesting> {
        self.materials.get(self.surfaces[shape.0 as usize].material)?.nesting()
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
        self.materials.prepare(material, &self.textures, surface.into(), side, Primaries)
    }
}

/// The lights that surround the scene.
fn infinite(lights: &[Light]) -> Vec<LightId> {
    let ids = (0..).map(LightId).zip(lights);
    ids.filter(|(_, light)| light.is_infinite()).map(|(id, _)| id).collect()
}

#[cfg(test)]
mod tests;
