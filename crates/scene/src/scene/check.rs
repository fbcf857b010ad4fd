//! Whether the parts of a scene fit together.

use super::{SceneParts, SurfaceInfo};
use crate::geometry::ShapeId;
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
    /// The crop is empty or reaches beyond the film.
    #[error("the crop is empty or does not lie within the film")]
    Crop,
}

/// Checks every reference between the parts, and the lights; directional lights get a direction of
/// unit length.
pub(super) fn check(parts: &mut SceneParts) -> Result<(), InvalidScene> {
    let SceneParts { geometry, surfaces, materials, textures, lights, media, film, .. } = parts;
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
