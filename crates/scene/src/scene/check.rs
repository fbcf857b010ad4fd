//! Whether the parts of a scene fit together.

use etendue_math::glam::Vec3;

use super::{Scene, SceneParts, SurfaceInfo};
use crate::camera::Camera;
use crate::geometry::{Aabb, Geometry, ShapeId};
use crate::light::{AreaLight, BeamLight, Light, LightError, LightId};
use crate::texture::{Texture, TextureId, Textures};

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
    /// A shape that is an area light moves.
    #[error("shape {0} is an area light, which cannot move yet")]
    MovingLight(u32),
    /// A surface lies between media of which one does not exist.
    #[error("shape {0} bounds a medium that does not exist")]
    Medium(u32),
    /// The camera stands in a medium that does not exist.
    #[error("the camera stands in a medium that does not exist")]
    MediumAroundCamera,
    /// A light names a texture that does not exist.
    #[error("light {0} refers to a texture that does not exist")]
    Texture(u32),
    /// A light looks up an attribute of a mesh or a volume.
    #[error("light {0} refers to an attribute of a mesh or to a volume")]
    NeedsSurface(u32),
    /// A light is refused.
    #[error("light {light}: {error}")]
    Light {
        /// Which.
        light: u32,
        /// Why.
        error: LightError,
    },
    /// A light is too bright for sums in single precision.
    #[error(
        "light {0} emits more than 2¹⁰⁰ W (10³⁰), which single precision cannot sum: dim all lights alike"
    )]
    Power(u32),
    /// Shapes or the camera are where rays miss triangles.
    #[error(
        "the scene reaches beyond ±2⁴⁰ (10¹²), where single precision misses triangles: make everything smaller"
    )]
    TooLarge,
    /// Shapes are so small that rays miss triangles.
    #[error(
        "the scene is smaller than 2⁻⁴⁰ (10⁻¹²), where single precision misses triangles: make everything larger"
    )]
    TooSmall,
    /// The crop is empty or reaches beyond the film.
    #[error("the crop is empty or does not lie within the film")]
    Crop,
}

/// The largest coordinate, and the inverse of the least size of a scene. Tests of rays against triangles take products of three
/// distances: 2¹²⁰ times the 6 terms of a sum are below 2¹²⁸, and 2⁻¹²⁰ has a full mantissa.
const RANGE: f32 = (1_u64 << 40) as f32;

/// The largest power: that many photons of as many lights, samples and pixels are below 2¹²⁸.
const MOST_POWER: f32 = (1_u128 << 100) as f32;

/// Checks that no light of a scene is brighter than can be summed.
pub(super) fn check_powers(scene: &Scene) -> Result<(), InvalidScene> {
    for index in 0..scene.lights.len() as u32 {
        let power = scene.light_power(LightId(index));
        // False for NaN too.
        let is_summable = power <= MOST_POWER;
        if !is_summable {
            return Err(InvalidScene::Power(index));
        }
    }
    Ok(())
}

/// Checks that triangles are where rays find them.
fn check_range(geometry: &Geometry, camera: &Camera) -> Result<(), InvalidScene> {
    let mut bounds = geometry.level_bounds().filter(|bounds| !bounds.is_empty()).peekable();
    if bounds.peek().is_none() {
        return Ok(());
    }
    let eye = camera.position();
    let is_within = |point: Vec3| point.abs().cmple(Vec3::splat(RANGE)).all();
    if !is_within(eye) {
        return Err(InvalidScene::TooLarge);
    }
    for Aabb { min, max } in bounds {
        if !is_within(min) || !is_within(max) {
            return Err(InvalidScene::TooLarge);
        }
        let size = (max - min).max_element();
        if size > 0.0 && size < 1.0 / RANGE {
            return Err(InvalidScene::TooSmall);
        }
    }
    Ok(())
}

/// Checks every reference between the parts, and the lights; directional lights get a direction of
/// unit length.
pub(super) fn check(parts: &mut SceneParts) -> Result<(), InvalidScene> {
    let SceneParts { geometry, surfaces, materials, textures, lights, media, film, camera, .. } =
        parts;
    let shapes = geometry.shapes().len();
    if surfaces.len() != shapes {
        return Err(InvalidScene::SurfaceCount { surfaces: surfaces.len(), shapes });
    }
    if !film.contains_crop() {
        return Err(InvalidScene::Crop);
    }
    check_range(geometry, camera)?;
    for (index, surface) in surfaces.iter().enumerate() {
        let shape = index as u32;
        materials.get(surface.material).ok_or(InvalidScene::Material(shape))?;
        let boundary = surface.boundary.unwrap_or_default();
        let mut sides = [boundary.interior, boundary.exterior].into_iter().flatten();
        if sides.any(|id| media.get(id).is_none()) {
            return Err(InvalidScene::Medium(shape));
        }
        if let Some(light) = surface.light {
            match lights.get(light.0 as usize) {
                Some(
                    Light::Area(AreaLight { shape: of_light, .. })
                    | Light::Beam(BeamLight { shape: of_light, .. }),
                ) if *of_light == ShapeId(shape) => {
                    if geometry.is_moving(*of_light) {
                        return Err(InvalidScene::MovingLight(shape));
                    }
                }
                _ => return Err(InvalidScene::AreaLight(shape)),
            }
        }
    }
    if media.around_camera.is_some_and(|id| media.get(id).is_none()) {
        return Err(InvalidScene::MediumAroundCamera);
    }
    for (index, light) in lights.iter_mut().enumerate() {
        check_light(LightId(index as u32), light, surfaces, textures)?;
    }
    Ok(())
}

/// Checks a light, and gives the direction of a directional one unit length.
fn check_light(
    id: LightId,
    light: &mut Light,
    surfaces: &[SurfaceInfo],
    textures: &Textures,
) -> Result<(), InvalidScene> {
    let refused = |error| InvalidScene::Light { light: id.0, error };
    let needs_surface = |part: &TextureId| textures.get(*part).is_some_and(Texture::needs_surface);
    let known = |texture: TextureId| match textures.get(texture) {
        Some(_) if textures.with_parts([texture]).iter().any(needs_surface) => {
            Err(InvalidScene::NeedsSurface(id.0))
        }
        Some(_) => Ok(()),
        None => Err(InvalidScene::Texture(id.0)),
    };
    match light {
        Light::Area(AreaLight { shape, radiance: texture })
        | Light::Beam(BeamLight { shape, exitance: texture }) => {
            let surface = surfaces.get(shape.0 as usize);
            if surface.is_none_or(|surface| surface.light != Some(id)) {
                return Err(InvalidScene::AreaLight(shape.0));
            }
            known(*texture)
        }
        Light::Point(light) => light.check().map_err(refused),
        Light::Spot(light) => light.texture().map_or(Ok(()), known),
        Light::Projector(light) => known(light.texture()),
        Light::Directional(light) => {
            *light = light.normalized().map_err(refused)?;
            Ok(())
        }
        Light::Constant(light) => light.check().map_err(refused),
        // Checked where they are made.
        Light::Environment(_) => Ok(()),
    }
}
