//! Light sources.

use alloc::format;

use etendue_math::glam::{DVec3, Vec3};

use super::field_of_view::field_of_view;
use super::image::image;
use super::reader::PluginReader;
use super::value::{Role, color_or, texture_if_given, texture_or};
use super::{Context, Family};
use crate::SceneError;
use crate::effect::Element;
use crate::geometry::is_unit;
use crate::light::{
    ConstantLight, DirectionalLight, EnvironmentLight, Light, LightError, LightId, PointLight,
    ProjectorLight, SpotLight,
};
use crate::load::Encoding;
use crate::texture::{Texture, TextureId};
use crate::xml::NodeId;

/// The emitters that are no shape.
const EMITTERS: &Family<Light> = &[
    ("area", misplaced),
    ("constant", constant),
    ("directional", directional),
    ("directionalarea", misplaced),
    ("envmap", envmap),
    ("point", point),
    ("projector", projector),
    ("spot", spot),
];

/// The emitters that make a shape shine.
const SHAPE_EMITTERS: &Family<Emission> = &[("area", area), ("directionalarea", directional_area)];

/// What a shape emits.
#[derive(Clone, Copy, Debug)]
pub(super) enum Emission {
    /// Radiance from every point into all directions.
    Everywhere(TextureId),
    /// Radiant exitance along the normal.
    Ahead(TextureId),
}

/// Adds the light a node describes.
pub(super) fn add(context: &mut Context<'_>, id: NodeId) -> Result<(), SceneError> {
    let node = context.description.node(id);
    let light = context.translate(EMITTERS, node)?;
    context.origins.note(Element::Light(LightId(context.lights.len() as u32)), node);
    context.lights.push(light);
    Ok(())
}

/// What an emitter inside a shape makes it emit.
pub(super) fn emission(context: &mut Context<'_>, id: NodeId) -> Result<Emission, SceneError> {
    context.translate(SHAPE_EMITTERS, context.description.node(id))
}

/// `radiance` (1).
fn area<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Emission, SceneError> {
    radiance(reader, context).map(Emission::Everywhere)
}

/// `radiance` (1), which is the exitance here.
fn directional_area<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Emission, SceneError> {
    radiance(reader, context).map(Emission::Ahead)
}

fn radiance<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<TextureId, SceneError> {
    ignore_weights(reader);
    let radiance = texture_or(reader, context, "radiance", Role::Emission, 1.0)?;
    by_coordinates(reader, context, "radiance", radiance)
}

/// The texture of a light, which cannot be an attribute of a mesh or a volume: lights are chosen by their power beforehand.
fn by_coordinates(
    reader: &PluginReader<'_>,
    context: &Context<'_>,
    name: &'static str,
    texture: TextureId,
) -> Result<TextureId, SceneError> {
    let parts = context.textures.with_parts([texture]);
    if parts.iter().any(|&id| context.textures.get(id).is_some_and(Texture::needs_surface)) {
        let message = format!("“{name}” cannot be an attribute of a mesh or a volume");
        return Err(reader.error(name, message));
    }
    Ok(texture)
}

fn misplaced<'a>(reader: &mut PluginReader<'a>, _: &mut Context<'a>) -> Result<Light, SceneError> {
    Err(reader.error("radiance", format!("{} must stand inside a shape", reader.title())))
}

/// `radiance` (1).
fn constant<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Light, SceneError> {
    ignore_weights(reader);
    let radiance = color_or(reader, context, "radiance", Role::Emission, 1.0)?;
    Ok(Light::Constant(ConstantLight { radiance }))
}

/// `irradiance` (1), and `direction` or `to_world`, whose z axis is the direction of travel.
fn directional<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Light, SceneError> {
    ignore_weights(reader);
    let irradiance = color_or(reader, context, "irradiance", Role::Emission, 1.0)?;
    let to_world = reader.transform("to_world")?;
    let direction = match reader.vector("direction")? {
        Some(_) if reader.has("to_world") => return Err(either(reader, "direction")),
        Some(direction) => direction,
        None => to_world.affine().transform_vector3(DVec3::Z),
    };
    // A unit vector stays what it is, so that a scene that was written down is read as it was.
    let direction = match direction.try_normalize() {
        Some(_) if is_unit(direction.as_vec3()) => direction.as_vec3(),
        Some(unit) => unit.as_vec3(),
        None => return Err(reader.error("direction", "the direction has no length")),
    };
    Ok(Light::Directional(DirectionalLight { direction, irradiance }))
}

/// `intensity` (1), and `position` or `to_world`.
fn point<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Light, SceneError> {
    ignore_weights(reader);
    let intensity = color_or(reader, context, "intensity", Role::Emission, 1.0)?;
    let to_world = reader.transform("to_world")?;
    let position = match reader.vector("position")? {
        Some(_) if reader.has("to_world") => return Err(either(reader, "position")),
        Some(position) => position.as_vec3(),
        None => to_world.point(Vec3::ZERO),
    };
    if !position.is_finite() {
        return Err(reader.error("position", "the position is out of range"));
    }
    Ok(Light::Point(PointLight { position, intensity }))
}

/// `intensity` (1), `texture`, `cutoff_angle` (20), `beam_width` (¾ of it), `to_world`.
fn spot<'a>(reader: &mut PluginReader<'a>, context: &mut Context<'a>) -> Result<Light, SceneError> {
    ignore_weights(reader);
    let intensity = color_or(reader, context, "intensity", Role::Emission, 1.0)?;
    let texture = texture_if_given(reader, context, "texture", Role::Emission)?
        .map(|texture| by_coordinates(reader, context, "texture", texture))
        .transpose()?;
    let cutoff = reader.float("cutoff_angle")?.unwrap_or(20.0);
    let beam_width = reader.float("beam_width")?.unwrap_or(0.75 * cutoff);
    let to_world = reader.transform("to_world")?;
    SpotLight::new(to_world, intensity, texture, cutoff, beam_width)
        .map(Light::Spot)
        .map_err(|e| refused(reader, "cutoff_angle", e))
}

/// `irradiance` (1), whose size gives the picture its aspect; `scale` (1), `to_world`, and `fov` with `fov_axis` or
/// `focal_length` as of the sensor `perspective`.
fn projector<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Light, SceneError> {
    ignore_weights(reader);
    let irradiance = texture_or(reader, context, "irradiance", Role::Emission, 1.0)?;
    let irradiance = by_coordinates(reader, context, "irradiance", irradiance)?;
    let valid = |scale| (0.0..=f64::from(f32::MAX)).contains(&scale);
    let scale = reader.float_in("scale", 1.0, "not negative", valid)? as f32;
    let to_world = reader.transform("to_world")?;
    let (view, size) = (field_of_view(reader)?, context.textures.size(irradiance));
    ProjectorLight::new(to_world, irradiance, scale, view, size)
        .map(Light::Projector)
        .map_err(|e| refused(reader, "focal_length", e))
}

/// `filename`, `scale` (1), `to_world`.
fn envmap<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Light, SceneError> {
    ignore_weights(reader);
    // Bookkeeping of older versions and of gradient estimators.
    reader.ignore(&["cache", "mis_compensation"]);
    let scale = reader.float_in("scale", 1.0, "not negative", |scale| scale >= 0.0)?;
    let to_world = reader.transform("to_world")?;
    let image = image(reader, context, Encoding::Srgb)?;
    EnvironmentLight::new(image, to_world, scale as f32)
        .map(Light::Environment)
        .map_err(|e| refused(reader, "to_world", e))
}

/// Lights are chosen by their power and place; the weights of Mitsuba's choice do not apply.
fn ignore_weights(reader: &mut PluginReader<'_>) {
    reader.ignore(&["sampling_weight"]);
}

fn either(reader: &PluginReader<'_>, name: &str) -> SceneError {
    reader.error(name, format!("give either “{name}” or “to_world”"))
}

fn refused(reader: &PluginReader<'_>, name: &str, error: LightError) -> SceneError {
    reader.error(name, format!("{}: {error}", reader.title()))
}
