//! What all shapes have in common: material and emission.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use etendue_math::glam::DVec3;

use super::super::emitter::Emission;
use super::super::reader::PluginReader;
use super::super::{Context, bsdf, emitter, medium, sensor};
use super::{Item, Surface};
use crate::SceneError;
use crate::geometry::{Aabb, MeshAttribute, Motion, Placement, Shape, ShapeError, Transform};
use crate::material::{Material, MaterialId};
use crate::texture::Texture;
use crate::xml::Kind;

/// The space in which a shape is described, and how it moves: `to_world` of a shape that stands still.
pub(super) fn placed(
    reader: &mut PluginReader<'_>,
    context: &mut Context<'_>,
) -> Result<(Transform, Option<Motion>), SceneError> {
    Ok(match reader.placement("to_world", context)? {
        Placement::Still(to_world) => (to_world, None),
        // Mirroring turns some shapes inside out, which it does not as a motion: it is part of the description.
        Placement::Moving(motion) if motion.opening().is_mirrored() => {
            let reflection = Transform::scale(DVec3::NEG_ONE);
            (reflection.map_err(|e| refused(reader, e))?, Some(motion.reflected()))
        }
        Placement::Moving(motion) => (Transform::IDENTITY, Some(motion)),
    })
}

/// A shape with the bsdf, the emitter and the media inside its plugin, turned inside out on request.
///
/// Without a bsdf it is diffuse: a half reflected, or nothing where it emits, as in Mitsuba.
pub(super) fn surface<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    shape: Shape,
    motion: Option<Motion>,
    name: String,
) -> Result<Item, SceneError> {
    let shape = if reader.boolean("flip_normals", false)? { shape.flipped() } else { shape };
    // Weights of gradient estimators.
    reader.ignore(&["silhouette_sampling_weight"]);
    let location = &reader.node().location;
    let boundary = medium::boundary(reader, context)?;
    let bsdf = reader.child(Kind::Bsdf, context)?;
    let emitter = reader.child(Kind::Emitter, context)?;
    let emission = emitter.map(|child| emitter::emission(context, child.node)).transpose()?;
    if let Some(motion) = &motion {
        check_motion(&shape, motion).map_err(|e| refused(reader, e))?;
    }
    if let (Some(_), Some(child)) = (&motion, emitter) {
        let message = "an emitter cannot move yet";
        return Err(SceneError::scene(child.location.clone(), message)
            .help("its shape must stand still while the shutter is open"));
    }
    if emission.is_some() && shape.area_total() == 0.0 {
        return Err(SceneError::scene(location.clone(), "a light needs an area, this has none"));
    }
    if let (Some(Emission::Ahead(_)), Some(child)) = (emission, emitter)
        && !matches!(shape, Shape::Rectangle(_) | Shape::Disk(_))
    {
        let message = "only a rectangle or a disk can emit along its normal";
        return Err(SceneError::scene(child.location.clone(), message));
    }
    meter(reader, context, &shape, motion.is_some())?;
    let material = match bsdf {
        Some(child) => bsdf::translate(context, child.node)?,
        None => {
            let albedo = if emission.is_some() { 0.0 } else { 0.5 };
            let reflectance = context.textures.constant([albedo; 3].into());
            context.add_material(Material::Diffuse { reflectance }, location)?
        }
    };
    let shape = with_attributes_of(material, shape, reader, context)?;
    let name = reader.node().id.clone().unwrap_or(name);
    Ok(Item::Surface(Surface { shape, motion, material, emission, boundary, name }))
}

/// The irradiance meter inside a shape, if there is one.
fn meter<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    shape: &Shape,
    is_moving: bool,
) -> Result<(), SceneError> {
    let Some(child) = reader.child(Kind::Sensor, context)? else { return Ok(()) };
    let error = |message| Err(SceneError::scene(child.location.clone(), message));
    if is_moving {
        return error("an irradiance meter cannot move");
    }
    context.metered = Some(shape.clone());
    let sensor = sensor::translate(context, child.node)?;
    if context.metered.take().is_some() {
        return error("only an irradiancemeter can stand inside a shape");
    }
    if context.meter.is_some() {
        context.warn(child.location.clone(), "only the first sensor is used");
    } else {
        context.meter = Some(sensor);
    }
    Ok(())
}

/// Refuses a motion that would make another kind of shape of it, or lead out of range.
///
/// What is a similarity at the ends of a part is one on the way: stretches are interpolated linearly.
fn check_motion(shape: &Shape, motion: &Motion) -> Result<(), ShapeError> {
    if !matches!(shape, Shape::Mesh(_)) {
        for end in motion.ends() {
            shape.clone().transformed(&end)?;
        }
    }
    let Aabb { min, max } = motion.bounds(&shape.bounds());
    if shape.area_total() > 0.0 && !(min.is_finite() && max.is_finite()) {
        return Err(ShapeError::OutOfRange);
    }
    Ok(())
}

/// The shape with those attributes that its material looks up, and no others.
fn with_attributes_of(
    material: MaterialId,
    shape: Shape,
    reader: &PluginReader<'_>,
    context: &Context<'_>,
) -> Result<Shape, SceneError> {
    let parts = context.materials.with_parts([material]);
    let parts = parts.into_iter().filter_map(|part| context.materials.get(part));
    let used = context.textures.with_parts(parts.flat_map(Material::textures));
    let names = used.into_iter().filter_map(|id| match context.textures.get(id) {
        Some(Texture::Attribute(attribute)) => Some(attribute.name.as_str()),
        _ => None,
    });
    let names: Vec<&str> = names.collect();
    let there: &[MeshAttribute] = match &shape {
        Shape::Mesh(mesh) => mesh.attributes(),
        _ => &[],
    };
    if let Some(name) = names.iter().find(|name| there.iter().all(|a| a.name != **name)) {
        let message = format!("{} has no attribute “{name}”", reader.title());
        let error = SceneError::scene(reader.node().location.clone(), message);
        let list: Vec<&str> = there.iter().map(|a| a.name.as_str()).collect();
        return Err(match list[..] {
            [] => error.help("only PLY files have attributes, and this shape has none"),
            _ => error.help(format!("it has {}", list.join(", "))),
        });
    }
    Ok(match shape {
        Shape::Mesh(mesh) => {
            Shape::Mesh(mesh.keep_attributes(|attribute| names.contains(&attribute.name.as_str())))
        }
        shape => shape,
    })
}

/// An error about the form of a shape.
pub(super) fn refused(reader: &PluginReader<'_>, error: impl Into<ShapeError>) -> SceneError {
    let error = error.into();
    SceneError::scene(reader.node().location.clone(), format!("{}: {error}", reader.title()))
}
