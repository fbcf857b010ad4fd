//! What all shapes have in common: material and emission.

use alloc::format;
use alloc::string::String;

use super::super::reader::PluginReader;
use super::super::{Context, bsdf, emitter, medium};
use super::{Item, Surface};
use crate::SceneError;
use crate::geometry::{Shape, ShapeError};
use crate::material::Material;
use crate::xml::Kind;

/// A shape with the bsdf, the emitter and the media inside its plugin, turned inside out on request.
///
/// Without a bsdf it is diffuse: a half reflected, or nothing where it emits, as in Mitsuba.
pub(super) fn surface<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    shape: Shape,
    name: String,
) -> Result<Item, SceneError> {
    let shape = if reader.boolean("flip_normals", false)? { shape.flipped() } else { shape };
    // Weights of gradient estimators.
    reader.ignore(&["silhouette_sampling_weight"]);
    let location = &reader.node().location;
    let boundary = medium::boundary(reader, context)?;
    let bsdf = reader.child(Kind::Bsdf, context)?;
    let emission = reader.child(Kind::Emitter, context)?;
    let radiance = emission.map(|child| emitter::radiance(context, child.node)).transpose()?;
    if radiance.is_some() && shape.area_total() == 0.0 {
        return Err(SceneError::scene(location.clone(), "a light needs an area, this has none"));
    }
    let material = match bsdf {
        Some(child) => bsdf::translate(context, child.node)?,
        None => {
            let albedo = if radiance.is_some() { 0.0 } else { 0.5 };
            let reflectance = context.textures.constant([albedo; 3].into());
            context.add_material(Material::Diffuse { reflectance }, location)?
        }
    };
    let name = reader.node().id.clone().unwrap_or(name);
    Ok(Item::Surface(Surface { shape, material, radiance, boundary, name }))
}

/// An error about the form of a shape.
pub(super) fn refused(reader: &PluginReader<'_>, error: impl Into<ShapeError>) -> SceneError {
    let error = error.into();
    SceneError::scene(reader.node().location.clone(), format!("{}: {error}", reader.title()))
}
