//! `diffuse` and `roughdiffuse`.

use super::super::Context;
use super::super::reader::PluginReader;
use super::super::value::{Role, texture_or};
use crate::SceneError;
use crate::material::{Material, MaterialId, OrenNayarForm};
use crate::texture::Texture;

/// Lambert: `reflectance` (0.5).
pub(super) fn diffuse<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let reflectance = texture_or(reader, context, "reflectance", Role::Reflectance, 0.5)?;
    context.add_material(Material::Diffuse { reflectance }, &reader.node().location)
}

/// Oren–Nayar, as in Mitsuba 0.6: `reflectance` (0.5), `alpha` (0.2), `use_fast_approx` (false).
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
    let alpha = texture_or(reader, context, "alpha", Role::Material, 0.2)?;
    let sigma = match context.textures.get(alpha) {
        Some(Texture::Constant(alpha)) => {
            let sigma = *alpha * core::f32::consts::FRAC_1_SQRT_2;
            context.textures.constant(sigma)
        }
        _ => return Err(reader.error("alpha", "“alpha” cannot vary over a surface")),
    };
    let form = if reader.boolean("use_fast_approx", false)? {
        OrenNayarForm::Qualitative
    } else {
        OrenNayarForm::Full
    };
    context
        .add_material(Material::RoughDiffuse { reflectance, sigma, form }, &reader.node().location)
}
