//! `diffuse`, `roughdiffuse` and `difftrans`.

use super::super::Context;
use super::super::reader::PluginReader;
use super::super::value::{Role, color_or, texture_if_given, texture_or};
use crate::SceneError;
use crate::material::{Material, MaterialId, OrenNayarForm};
use crate::texture::TextureId;

/// Lambert: `reflectance` (0.5).
pub(super) fn diffuse<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let reflectance = texture_or(reader, context, "reflectance", Role::Reflectance, 0.5)?;
    context.add_material(Material::Diffuse { reflectance }, &reader.node().location)
}

/// A sheet that lets light through, evenly scattered, as in Mitsuba 0.6: `transmittance` (0.5). `reflectance` (0, ours).
pub(super) fn transmitter<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let transmittance = texture_or(reader, context, "transmittance", Role::Reflectance, 0.5)?;
    let reflectance = texture_or(reader, context, "reflectance", Role::Reflectance, 0.0)?;
    let material = Material::DiffuseTransmitter { reflectance, transmittance };
    context.add_material(material, &reader.node().location)
}

/// Oren–Nayar, as in Mitsuba 0.6: `reflectance` (0.5), `alpha` (0.2), `use_fast_approx` (false),
/// or `sigma` instead of `alpha`: the standard deviation of the slope angle in radians, which may vary.
///
/// `alpha` is there the width of a Beckmann distribution, √2 times the standard deviation of the
/// slope: `σ = α / √2`.
///
/// # Source
/// Mitsuba 0.6, `src/bsdfs/roughdiffuse.cpp`, `conversionFactor`.
pub(super) fn rough<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let reflectance = texture_or(reader, context, "reflectance", Role::Reflectance, 0.5)?;
    let sigma = sigma(reader, context)?;
    let form = if reader.boolean("use_fast_approx", false)? {
        OrenNayarForm::Qualitative
    } else {
        OrenNayarForm::Full
    };
    context
        .add_material(Material::RoughDiffuse { reflectance, sigma, form }, &reader.node().location)
}

/// The standard deviation of the slope angle, by `sigma` or by `alpha`.
fn sigma<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<TextureId, SceneError> {
    if let Some(sigma) = texture_if_given(reader, context, "sigma", Role::Material)? {
        return if reader.has("alpha") {
            Err(reader.error("sigma", "give either “sigma” or “alpha”"))
        } else {
            Ok(sigma)
        };
    }
    let alpha = color_or(reader, context, "alpha", Role::Material, 0.2)?;
    Ok(context.textures.constant(alpha * core::f32::consts::FRAC_1_SQRT_2))
}
