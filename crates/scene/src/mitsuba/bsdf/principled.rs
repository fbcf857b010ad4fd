//! `principled` and `principledthin`.

use alloc::boxed::Box;
use alloc::format;

use etendue_brdf::{Ior, PrincipledParameters};

use super::super::Context;
use super::super::reader::PluginReader;
use super::super::value::{Role, texture_or};
use crate::material::{Material, MaterialId, PrincipledTextures, PrincipledThinTextures};
use crate::texture::TextureId;
use crate::{Color, SceneError};

/// Disney's material: `base_color` and `roughness` (0.5), `anisotropic`, `metallic`, `spec_trans`, `spec_tint`,
/// `sheen`, `sheen_tint`, `flatness`, `clearcoat` and `clearcoat_gloss` (0) may vary; `specular` (0.5) or `eta`, and the
/// sampling rates (1), may not.
pub(super) fn solid<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let spec_trans = if_not_zero(reader, context, "spec_trans")?;
    let eta = eta(reader, spec_trans.is_some())?;
    let mut share = |name, default| texture_or(reader, context, name, Role::Reflectance, default);
    let material = PrincipledTextures {
        base_color: share("base_color", 0.5)?,
        roughness: share("roughness", 0.5)?,
        anisotropic: share("anisotropic", 0.0)?,
        metallic: share("metallic", 0.0)?,
        spec_trans,
        eta,
        spec_tint: share("spec_tint", 0.0)?,
        sheen: share("sheen", 0.0)?,
        sheen_tint: share("sheen_tint", 0.0)?,
        flatness: share("flatness", 0.0)?,
        clearcoat: share("clearcoat", 0.0)?,
        clearcoat_gloss: share("clearcoat_gloss", 0.0)?,
        sampling_rates: [
            rate(reader, "diffuse_reflectance_sampling_rate")?,
            rate(reader, "main_specular_sampling_rate")?,
            rate(reader, "clearcoat_sampling_rate")?,
        ],
    };
    context.add_material(Material::Principled(Box::new(material)), &reader.node().location)
}

/// The same as a sheet without thickness: `eta` (1.5) and `diff_trans` (0, up to 2) may vary, and there is no metal and
/// no clear coat.
pub(super) fn thin<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let spec_trans = if_not_zero(reader, context, "spec_trans")?;
    let eta = texture_or(reader, context, "eta", Role::Material, 1.5)?;
    let diff_trans = texture_or(reader, context, "diff_trans", Role::Material, 0.0)?;
    let mut share = |name, default| texture_or(reader, context, name, Role::Reflectance, default);
    let material = PrincipledThinTextures {
        base_color: share("base_color", 0.5)?,
        roughness: share("roughness", 0.5)?,
        anisotropic: share("anisotropic", 0.0)?,
        spec_trans,
        eta,
        spec_tint: share("spec_tint", 0.0)?,
        sheen: share("sheen", 0.0)?,
        sheen_tint: share("sheen_tint", 0.0)?,
        flatness: share("flatness", 0.0)?,
        diff_trans,
        sampling_rates: [
            rate(reader, "specular_reflectance_sampling_rate")?,
            rate(reader, "specular_transmittance_sampling_rate")?,
            rate(reader, "diffuse_reflectance_sampling_rate")?,
            rate(reader, "diffuse_transmittance_sampling_rate")?,
        ],
    };
    context.add_material(Material::PrincipledThin(Box::new(material)), &reader.node().location)
}

/// A share that takes code of its own wherever it is not 0; `None` where it is 0 everywhere.
fn if_not_zero<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    name: &'static str,
) -> Result<Option<TextureId>, SceneError> {
    let texture = texture_or(reader, context, name, Role::Reflectance, 0.0)?;
    Ok((!context.textures.is_black(texture)).then_some(texture))
}

/// The relative index, by itself or by `specular`, of which Mitsuba takes 0 for 0.001 where light is let through.
fn eta(reader: &mut PluginReader<'_>, transmits: bool) -> Result<Ior<f32>, SceneError> {
    if let Some(eta) = reader.float("eta")? {
        if reader.has("specular") {
            return Err(reader.error("specular", "give either “eta” or “specular”"));
        }
        return Ior::new(eta as f32).map_err(|e| reader.error("eta", format!("“eta”: {e}")));
    }
    let specular = reader.float("specular")?.unwrap_or(0.5);
    let specular = if transmits && specular == 0.0 { 1e-3 } else { specular };
    PrincipledParameters::<Color>::default()
        .with_specular(specular as f32)
        .and_then(|parameters| Ior::new(parameters.eta))
        .map_err(|e| reader.error("specular", format!("“specular”: {e}")))
}

/// How often a lobe is sampled relative to the others.
fn rate(reader: &mut PluginReader<'_>, name: &'static str) -> Result<f32, SceneError> {
    let valid = |x| (0.0..=1e6).contains(&x);
    reader.float_in(name, 1.0, "between 0 and 1000000", valid).map(|rate| rate as f32)
}
