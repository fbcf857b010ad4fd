//! `mask`, `coating`, `blendbsdf`, `mixturebsdf`, `twosided`, `normalmap`, `bumpmap` and `null`.

use alloc::format;

use super::super::reader::PluginReader;
use super::super::value::{Role, texture_if_given, texture_or};
use super::super::{Context, ior, texture};
use super::translate;
use crate::SceneError;
use crate::material::{Material, MaterialId, Perturbation};
use crate::texture::Texture;
use crate::xml::Kind;

/// A surface with holes: `opacity` (0.5) and one model inside.
pub(super) fn mask<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let opacity = texture_or(reader, context, "opacity", Role::Reflectance, 0.5)?;
    let nested = nested(reader, context)?;
    context.add_material(Material::Mask { opacity, nested }, &reader.node().location)
}

/// A model under a smooth layer, as in Mitsuba 0.6: `int_ior` (bk7), `ext_ior` (air), `thickness` (1), `sigma_a` (0),
/// `specular_reflectance` (1) and one model inside.
pub(super) fn coating<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let eta = ior::relative(reader, "bk7", "air")?;
    let valid = |x: f64| (0.0..=f64::from(f32::MAX)).contains(&x);
    let thickness = reader.float_in("thickness", 1.0, "not negative", valid)? as f32;
    let absorption = texture_or(reader, context, "sigma_a", Role::Material, 0.0)?;
    let specular_reflectance =
        texture_or(reader, context, "specular_reflectance", Role::Reflectance, 1.0)?;
    let nested = nested(reader, context)?;
    let material = Material::Coated { eta, absorption, thickness, specular_reflectance, nested };
    context.add_material(material, &reader.node().location)
}

/// The one model inside.
fn nested<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    match reader.child(Kind::Bsdf, context)? {
        Some(nested) => translate(context, nested.node),
        None => {
            let message = format!("{} has no bsdf inside", reader.title());
            Err(SceneError::scene(reader.node().location.clone(), message))
        }
    }
}

/// Two models in shares: `weight` (0.5) is that of the second.
pub(super) fn blend<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let weight = texture_or(reader, context, "weight", Role::Reflectance, 0.5)?;
    let location = &reader.node().location;
    let [first, second] = reader.children(Kind::Bsdf, context)[..] else {
        return Err(SceneError::scene(location.clone(), "a blend needs two bsdfs inside"));
    };
    let parts = [translate(context, first.node)?, translate(context, second.node)?];
    context.add_material(Material::Blend { weight, parts }, location)
}

/// Any number of models in shares, as in Mitsuba 0.6: `weights` (a list), scaled where they exceed 1 together; what they leave
/// is absorbed.
///
/// As blends of two: after i models the share of the last among them is `wᵢ / (w₁ + … + wᵢ)`.
pub(super) fn mixture<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let location = &reader.node().location;
    let Some(weights) = reader.numbers("weights")? else {
        return Err(reader.error("weights", "the mixture has no “weights”"));
    };
    if weights.iter().any(|&weight| weight < 0.0) {
        return Err(reader.error("weights", "“weights” must be numbers that are not negative"));
    }
    let parts = reader.children(Kind::Bsdf, context);
    if parts.len() != weights.len() || parts.is_empty() {
        let message = format!("{} bsdfs have {} weights", parts.len(), weights.len());
        return Err(reader.error("weights", message));
    }
    let mut mixed = translate(context, parts[0].node)?;
    let mut total = weights[0];
    let mut mix = |context: &mut Context<'a>, part, weight: f64, total: f64| {
        let share = if total > 0.0 { weight / total } else { 0.0 };
        let weight = context.textures.constant([share as f32; 3].into());
        context
            .add_material(Material::Blend { weight, parts: [mixed, part] }, location)
            .map(|id| mixed = id)
    };
    for (part, weight) in parts.iter().zip(weights).skip(1) {
        let part = translate(context, part.node)?;
        total += weight;
        mix(context, part, weight, total)?;
    }
    if total < 1.0 {
        let reflectance = context.textures.constant([0.0; 3].into());
        let black = context.add_material(Material::Diffuse { reflectance }, location)?;
        mix(context, black, 1.0 - total, 1.0)?;
    }
    Ok(mixed)
}

/// A model in the frame of another normal: `normalmap`, `flip_invalid_normals` and `use_shadowing_function` (true).
pub(super) fn normal_map<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let Some(normal) = texture_if_given(reader, context, "normalmap", Role::Reflectance)? else {
        return Err(reader.error("normalmap", "the normal map has no texture “normalmap”"));
    };
    let options = perturbation(reader)?;
    let nested = nested(reader, context)?;
    let material = Material::NormalMap { normal, options, nested };
    context.add_material(material, &reader.node().location)
}

/// A model on bumps: a bitmap of any name, `scale` (1), `flip_invalid_normals` and `use_shadowing_function` (true).
pub(super) fn bump_map<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let location = &reader.node().location;
    let Some(child) = reader.child(Kind::Texture, context)? else {
        return Err(SceneError::scene(location.clone(), "the bump map has no texture inside"));
    };
    let height = texture::translate(context, child.node)?;
    if !matches!(context.textures.get(height), Some(Texture::Bitmap(_) | Texture::Constant(_))) {
        let message = "the height of a bump map must be a bitmap";
        return Err(SceneError::scene(child.location.clone(), message));
    }
    let finite = |x: f64| (x as f32).is_finite();
    let scale =
        reader.float_in("scale", 1.0, "of a size that single precision has", finite)? as f32;
    let options = perturbation(reader)?;
    let nested = nested(reader, context)?;
    context.add_material(Material::BumpMap { height, scale, options, nested }, location)
}

/// What is done where the normals disagree.
fn perturbation(reader: &mut PluginReader<'_>) -> Result<Perturbation, SceneError> {
    Ok(Perturbation {
        flip_invalid_normals: reader.boolean("flip_invalid_normals", true)?,
        use_shadowing_function: reader.boolean("use_shadowing_function", true)?,
    })
}

/// The same model on both sides, or one for each.
pub(super) fn two_sided<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let location = &reader.node().location;
    let (front, back) = match reader.children(Kind::Bsdf, context)[..] {
        [both] => (both, both),
        [front, back] => (front, back),
        _ => {
            let message = "a two-sided bsdf needs one or two bsdfs inside";
            return Err(SceneError::scene(location.clone(), message));
        }
    };
    let front = translate(context, front.node)?;
    let back = translate(context, back.node)?;
    context.add_material(Material::TwoSided { front, back }, location)
}

/// A surface that light does not notice.
pub(super) fn null<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    context.add_material(Material::Null, &reader.node().location)
}
