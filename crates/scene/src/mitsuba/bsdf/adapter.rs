//! `mask`, `twosided` and `null`.

use super::super::Context;
use super::super::reader::PluginReader;
use super::super::value::{Role, texture_or};
use super::translate;
use crate::SceneError;
use crate::material::{Material, MaterialId};
use crate::xml::Kind;

/// A surface with holes: `opacity` (0.5) and one model inside.
pub(super) fn mask<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let opacity = texture_or(reader, context, "opacity", Role::Reflectance, 0.5)?;
    let Some(nested) = reader.child(Kind::Bsdf, context)? else {
        return Err(reader.error("opacity", "the mask has no bsdf inside"));
    };
    let nested = translate(context, nested.node)?;
    context.add_material(Material::Mask { opacity, nested }, &reader.node().location)
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
