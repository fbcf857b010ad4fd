//! Which part of a scene calls for which effect.

use super::Effect;
use crate::light::Light;
use crate::material::{Material, PlasticSurface};
use crate::medium::{Extinction, Medium};
use crate::texture::{Texture, TextureId};

/// The effect of a light.
pub(super) fn of_light(light: &Light) -> Effect {
    match light {
        Light::Area(_) | Light::Beam(_) => Effect::AreaLight,
        Light::Point(_) => Effect::PointLight,
        Light::Spot(_) => Effect::SpotLight,
        Light::Projector(_) => Effect::Projector,
        Light::Directional(_) => Effect::DirectionalLight,
        Light::Constant(_) => Effect::ConstantBackground,
        Light::Environment(_) => Effect::EnvironmentMap,
    }
}

/// The effect of a texture that varies.
pub(super) fn of_texture(texture: &Texture) -> Option<Effect> {
    match texture {
        Texture::Constant(_) => None,
        Texture::Bitmap(_) => Some(Effect::BitmapTexture),
        Texture::Checkerboard(_) => Some(Effect::CheckerboardTexture),
        Texture::Attribute(_) => Some(Effect::MeshAttribute),
        Texture::Volume(_) => Some(Effect::VolumeTexture),
    }
}

/// The effects that are lobes of a material, each with the texture that scales it: where that is black, the effect is
/// absent.
pub(super) fn of_lobes(material: &mut Material) -> impl Iterator<Item = (Effect, &mut TextureId)> {
    const DELTA: [Effect; 2] = [Effect::DeltaReflection, Effect::DeltaTransmission];
    const ROUGH: [Effect; 2] = [Effect::RoughReflection, Effect::RoughTransmission];
    let ([reflection, transmission], reflected, transmitted) = match material {
        Material::Dielectric {
            roughness, specular_reflectance, specular_transmittance, ..
        } => {
            let lobes = if roughness.is_some() { ROUGH } else { DELTA };
            (lobes, Some(specular_reflectance), Some(specular_transmittance))
        }
        Material::ThinDielectric { specular_reflectance, specular_transmittance, .. } => {
            (DELTA, Some(specular_reflectance), Some(specular_transmittance))
        }
        Material::Conductor { roughness, specular_reflectance, .. } => {
            (if roughness.is_some() { ROUGH } else { DELTA }, Some(specular_reflectance), None)
        }
        Material::Plastic { surface, specular_reflectance, .. } => match surface {
            PlasticSurface::Smooth(_) => (DELTA, Some(specular_reflectance), None),
            PlasticSurface::Rough(_) => (ROUGH, Some(specular_reflectance), None),
        },
        Material::DiffuseTransmitter { transmittance, .. } => (ROUGH, None, Some(transmittance)),
        Material::Phong { specular_reflectance, .. } => (ROUGH, Some(specular_reflectance), None),
        Material::Coated { specular_reflectance, .. } => (DELTA, Some(specular_reflectance), None),
        Material::Principled(textures) => (ROUGH, None, textures.spec_trans.as_mut()),
        Material::PrincipledThin(textures) => (ROUGH, None, textures.spec_trans.as_mut()),
        Material::Diffuse { .. }
        | Material::RoughDiffuse { .. }
        | Material::Compensated { .. }
        | Material::TwoSided { .. }
        | Material::Mask { .. }
        | Material::Blend { .. }
        | Material::NormalMap { .. }
        | Material::BumpMap { .. }
        | Material::Null => (DELTA, None, None),
    };
    let reflected = reflected.map(|factor| (reflection, factor));
    reflected.into_iter().chain(transmitted.map(|factor| (transmission, factor)))
}

/// The effect that a material is as a whole.
pub(super) fn of_surface(material: &Material) -> Option<Effect> {
    match material {
        Material::Principled(_) | Material::PrincipledThin(_) => Some(Effect::Principled),
        Material::Compensated { .. } => Some(Effect::MultipleScattering),
        Material::Mask { .. } => Some(Effect::OpacityMask),
        Material::Blend { .. } => Some(Effect::Blend),
        Material::NormalMap { .. } => Some(Effect::NormalMap),
        Material::BumpMap { .. } => Some(Effect::BumpMap),
        Material::Null => Some(Effect::PassThrough),
        _ => None,
    }
}

/// What kind of medium it is.
pub(super) fn of_extinction(medium: &Medium) -> Effect {
    match medium.extinction {
        Extinction::Homogeneous(_) => Effect::HomogeneousMedium,
        Extinction::Heterogeneous(_) => Effect::HeterogeneousMedium,
    }
}

/// The effects of a medium.
pub(super) fn of_medium(medium: &Medium) -> impl Iterator<Item = Effect> {
    let coloured = medium.is_coloured().then_some(Effect::ColouredExtinction);
    let anisotropic = (!medium.phase.is_isotropic()).then_some(Effect::AnisotropicScattering);
    [Some(of_extinction(medium)), coloured, anisotropic].into_iter().flatten()
}
