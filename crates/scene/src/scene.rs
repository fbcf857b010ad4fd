//! Everything that is rendered, in one place.

use alloc::string::String;
use alloc::vec::Vec;

use etendue_math::glam::Vec3;
use etendue_math::{Spectrum, Vector3};

use crate::Color;
use crate::camera::Camera;
use crate::film::Film;
use crate::geometry::{Geometry, Shape, ShapeId, SurfacePoint};
use crate::light::{AreaLight, Light, LightBounds, LightError, LightId, LightSample};
use crate::material::{MaterialId, Materials, PreparedBsdf};
use crate::texture::{TextureId, Textures};

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

/// Which source of random numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SamplerKind {
    /// Independent numbers.
    Independent,
    /// Owen-scrambled Sobol' points.
    #[default]
    Sobol,
}

/// How often a pixel is sampled, and by what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplingSettings {
    /// Source of random numbers.
    pub sampler: SamplerKind,
    /// Samples per pixel.
    pub samples_per_pixel: u32,
    /// Another seed gives another picture of the same scene.
    pub seed: u64,
}

impl Default for SamplingSettings {
    fn default() -> Self {
        Self { sampler: SamplerKind::default(), samples_per_pixel: 16, seed: 0 }
    }
}

/// How far paths go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathSettings {
    /// Largest number of edges: 1 shows emitters only, 2 adds direct light; `None` is unlimited.
    pub max_depth: Option<u32>,
    /// From which number of edges on paths are ended by chance.
    pub roulette_depth: u32,
    /// Whether emitters are invisible to the camera.
    pub hide_emitters: bool,
    /// Whether a direction must lie on the same side of the geometric normal as of the shading
    /// normal.
    pub strict_normals: bool,
}

impl Default for PathSettings {
    /// Mitsuba's defaults.
    fn default() -> Self {
        Self { max_depth: None, roulette_depth: 5, hide_emitters: false, strict_normals: false }
    }
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
    /// Camera.
    pub camera: Camera,
    /// Film.
    pub film: Film,
    /// Sampling.
    pub sampling: SamplingSettings,
    /// Paths.
    pub path: PathSettings,
}

/// Why parts do not make a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum InvalidScene {
    /// The list of surfaces is longer or shorter than that of shapes.
    #[error("there are {surfaces} surfaces for {shapes} shapes")]
    SurfaceCount {
        /// Entries in the list of surfaces.
        surfaces: usize,
        /// Shapes of the geometry.
        shapes: usize,
    },
    /// A surface names a material that does not exist.
    #[error("shape {0} is made of a material that does not exist")]
    Material(u32),
    /// A shape and a light do not name each other.
    #[error("shape {0} and its area light do not refer to each other")]
    AreaLight(u32),
    /// A light names a texture that does not exist.
    #[error("light {0} refers to a texture that does not exist")]
    Texture(u32),
    /// A light is refused.
    #[error("light {light}: {error}")]
    Light {
        /// Which.
        light: u32,
        /// Why.
        error: LightError,
    },
    /// The crop is empty or reaches beyond the film.
    #[error("the crop is empty or does not lie within the film")]
    Crop,
}

/// A scene: what there is, where it is seen from, and how it is to be rendered.
///
/// References between the parts have been checked.
#[derive(Debug)]
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
    pub fn new(parts: SceneParts) -> Result<Self, InvalidScene> {
        let SceneParts {
            geometry,
            surfaces,
            materials,
            textures,
            mut lights,
            camera,
            film,
            sampling,
            path,
        } = parts;
        let shapes = geometry.shapes().len();
        if surfaces.len() != shapes {
            return Err(InvalidScene::SurfaceCount { surfaces: surfaces.len(), shapes });
        }
        if !film.contains_crop() {
            return Err(InvalidScene::Crop);
        }
        for (index, surface) in surfaces.iter().enumerate() {
            let shape = index as u32;
            materials.get(surface.material).ok_or(InvalidScene::Material(shape))?;
            if let Some(light) = surface.light {
                match lights.get(light.0 as usize) {
                    Some(Light::Area(light)) if light.shape == ShapeId(shape) => {}
                    _ => return Err(InvalidScene::AreaLight(shape)),
                }
            }
        }
        for (index, light) in lights.iter_mut().enumerate() {
            check_light(LightId(index as u32), light, &surfaces, &textures)?;
        }
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

    /// The shape of an area light, which `new` has found to exist.
    #[inline]
    fn shape_of(&self, light: AreaLight) -> &Shape {
        &self.geometry.shapes()[light.shape.0 as usize]
    }

    /// The reflection model at a point, for directions in its shading frame.
    #[inline]
    pub fn prepare(&self, point: &SurfacePoint) -> PreparedBsdf<'_> {
        let material = self.surfaces[point.shape.0 as usize].material;
        self.materials.prepare(material, &self.textures, point.uv)
    }

    /// Light of one source arriving at a point, drawn with two uniforms in `[0, 1)`.
    ///
    /// * `primitive`: which triangle of an area light's mesh; 0 for everything else.
    ///
    /// `None` where nothing arrives: the light shows its back, the drawn point is black, or there is
    /// no such light.
    pub fn sample_light(
        &self,
        light: LightId,
        primitive: u32,
        reference: &SurfacePoint,
        u: [f32; 2],
    ) -> Option<LightSample> {
        let from = reference.position;
        match self.lights.get(light.0 as usize)? {
            Light::Area(area) => {
                let shape = self.shape_of(*area);
                area.sample(shape, &self.textures, primitive, from, u)
            }
            Light::Point(light) => light.sample(from),
            Light::Spot(light) => light.sample(from, &self.textures),
            Light::Directional(light) => light.sample(),
            Light::Constant(light) => light.sample(u),
            Light::Environment(light) => light.sample(u),
        }
    }

    /// Density per steradian at `from` with which [`sample_light`](Self::sample_light) draws a point
    /// that a ray has hit, given the light and its primitive; 0 for a light that is no shape.
    pub fn light_pdf_hit(&self, light: LightId, from: Vec3, hit: &SurfacePoint) -> f32 {
        match self.lights.get(light.0 as usize) {
            Some(Light::Area(area)) => self.shape_of(*area).pdf_from(from, hit),
            _ => 0.0,
        }
    }

    /// Density per steradian with which [`sample_light`](Self::sample_light) draws a unit direction
    /// for a light infinitely far away; 0 for every other light, and for a directional one.
    pub fn light_pdf_escaped(&self, light: LightId, direction: Vec3) -> f32 {
        match self.lights.get(light.0 as usize) {
            Some(Light::Constant(light)) => light.pdf(),
            Some(Light::Environment(light)) => light.pdf(direction),
            _ => 0.0,
        }
    }

    /// The light that a surface is, and the radiance that leaves it towards `direction`; `None` for
    /// a surface that does not emit, and from behind.
    #[inline]
    pub fn emitted(&self, hit: &SurfacePoint, direction: Vec3) -> Option<(LightId, Color)> {
        let id = self.surfaces[hit.shape.0 as usize].light?;
        match self.lights.get(id.0 as usize)? {
            Light::Area(area) => Some((id, area.emitted(&self.textures, hit, direction)?)),
            _ => None,
        }
    }

    /// Radiance from infinitely far away, from a unit direction: the sum over all lights there.
    pub fn background(&self, direction: Vec3) -> Color {
        self.infinite_lights.iter().fold(Color::black(), |sum, &id| {
            sum + match &self.lights[id.0 as usize] {
                Light::Constant(light) => light.radiance,
                Light::Environment(light) => light.radiance(direction),
                _ => Color::black(),
            }
        })
    }

    /// The lights infinitely far away, directional ones included.
    pub fn infinite_lights(&self) -> &[LightId] {
        &self.infinite_lights
    }

    /// Every light with a place, area lights primitive by primitive; those that emit nothing are
    /// left out.
    pub fn finite_lights(&self) -> Vec<(LightId, u32, LightBounds)> {
        let mut list = Vec::new();
        for (index, light) in self.lights.iter().enumerate() {
            let id = LightId(index as u32);
            match light {
                Light::Area(area) => {
                    let shape = self.shape_of(*area);
                    let of = |i| LightBounds::of_primitive(*area, shape, &self.textures, i);
                    let primitives = 0..shape.primitive_count();
                    list.extend(primitives.filter_map(|i| Some((id, i, of(i)?))));
                }
                Light::Point(light) => list.push((id, 0, LightBounds::of_point(light))),
                Light::Spot(light) => {
                    list.push((id, 0, LightBounds::of_spot(light, &self.textures)));
                }
                Light::Directional(_) | Light::Constant(_) | Light::Environment(_) => {}
            }
        }
        list.retain(|(_, _, bounds)| bounds.power > 0.0);
        list
    }

    /// Power Φ in W: of a light with a place all that it emits, of one infinitely far away what
    /// passes through a sphere around the shapes; 0 for a light that does not exist.
    pub fn light_power(&self, light: LightId) -> f32 {
        match self.lights.get(light.0 as usize) {
            Some(Light::Area(area)) => area.power(&self.textures, self.shape_of(*area).area_total()),
            Some(Light::Point(light)) => light.power(),
            Some(Light::Spot(light)) => light.power(&self.textures),
            Some(Light::Directional(light)) => light.power(self.radius),
            Some(Light::Constant(light)) => light.power(self.radius),
            Some(Light::Environment(light)) => light.power(self.radius),
            None => 0.0,
        }
    }
}

/// Checks a light, and gives the direction of a directional one unit length.
fn check_light(
    id: LightId,
    light: &mut Light,
    surfaces: &[SurfaceInfo],
    textures: &Textures,
) -> Result<(), InvalidScene> {
    let refused = |error| InvalidScene::Light { light: id.0, error };
    let known = |texture: TextureId| match textures.get(texture) {
        Some(_) => Ok(()),
        None => Err(InvalidScene::Texture(id.0)),
    };
    match light {
        Light::Area(area) => {
            let surface = surfaces.get(area.shape.0 as usize);
            if surface.is_none_or(|surface| surface.light != Some(id)) {
                return Err(InvalidScene::AreaLight(area.shape.0));
            }
            known(area.radiance)
        }
        Light::Point(light) => light.check().map_err(refused),
        Light::Spot(light) => light.texture().map_or(Ok(()), known),
        Light::Directional(light) => {
            *light = light.normalized().map_err(refused)?;
            Ok(())
        }
        Light::Constant(light) => light.check().map_err(refused),
        // Checked where they are made.
        Light::Environment(_) => Ok(()),
    }
}

#[cfg(test)]
mod tests;
