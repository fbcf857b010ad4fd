//! `dielectric`, `roughdielectric` and `thindielectric`.

use super::super::reader::PluginReader;
use super::super::value::{Role, texture_or};
use super::super::{Context, dispersion, ior};
use super::compensation;
use super::roughness::roughness;
use crate::SceneError;
use crate::material::{Material, MaterialId, Roughness};
use crate::texture::TextureId;

/// A smooth interface: `int_ior` (bk7), `ext_ior` (air), `specular_reflectance` (1),
/// `specular_transmittance` (1), and what makes [`dispersion`].
pub(super) fn smooth<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    interface(reader, context, None)
}

/// The same with microfacets.
pub(super) fn rough<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let roughness = roughness(reader, context)?;
    interface(reader, context, Some(roughness))
}

fn interface<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    roughness: Option<Roughness>,
) -> Result<MaterialId, SceneError> {
    let (eta, dispersion) = dispersion::interface(reader)?;
    let how = match &roughness {
        Some(roughness) => compensation::of_glass(reader, context, eta, roughness)?,
        None => None,
    };
    if dispersion.is_some() && how.is_some() {
        let message = "glass cannot have both dispersion and “multiple_scattering”";
        return Err(reader.error("multiple_scattering", message));
    }
    let [specular_reflectance, specular_transmittance] = factors(reader, context)?;
    let material = Material::Dielectric {
        eta,
        dispersion,
        roughness,
        specular_reflectance,
        specular_transmittance,
    };
    compensation::add(reader, context, material, how)
}

/// A pane: the parameters of `dielectric`.
pub(super) fn thin<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let eta = ior::relative(reader, "bk7", "air")?;
    let [specular_reflectance, specular_transmittance] = factors(reader, context)?;
    let material = Material::ThinDielectric { eta, specular_reflectance, specular_transmittance };
    context.add_material(material, &reader.node().location)
}

fn factors<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<[TextureId; 2], SceneError> {
    Ok([
        texture_or(reader, context, "specular_reflectance", Role::Reflectance, 1.0)?,
        texture_or(reader, context, "specular_transmittance", Role::Reflectance, 1.0)?,
    ])
}
