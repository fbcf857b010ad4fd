//! `dielectric`, `roughdielectric` and `thindielectric`.

use alloc::format;

use etendue_brdf::Ior;

use super::super::reader::PluginReader;
use super::super::value::{Role, texture_or};
use super::super::{Context, dispersion, ior};
use super::compensation;
use super::roughness::roughness;
use crate::SceneError;
use crate::material::{Material, MaterialId, Nesting, Roughness};
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
    let nesting = nesting(reader, eta)?;
    if nesting.is_some() && how.is_some() {
        let message = "a body among others cannot have “multiple_scattering”";
        return Err(reader.error("multiple_scattering", message));
    }
    let [specular_reflectance, specular_transmittance] = factors(reader, context)?;
    let material = Material::Dielectric {
        eta,
        dispersion,
        nesting,
        roughness,
        specular_reflectance,
        specular_transmittance,
    };
    compensation::add(reader, context, material, how)
}

/// `priority` (integer): where bodies overlap, the one of the largest number is there.
fn nesting(reader: &mut PluginReader<'_>, eta: Ior<f32>) -> Result<Option<Nesting>, SceneError> {
    let Some(priority) = reader.integer("priority")? else { return Ok(None) };
    let priority = i32::try_from(priority)
        .map_err(|_| reader.error("priority", format!("“priority” is too large: {priority}")))?;
    let exterior = ior::index(reader, "ext_ior", "air")? as f32;
    Ok(Some(Nesting { priority, interior: eta.value() * exterior, exterior }))
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
