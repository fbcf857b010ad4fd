//! Cameras.

use alloc::format;

use super::field_of_view::field_of_view;
use super::reader::PluginReader;
use super::{Context, Family, film, medium, sampler};
use crate::SceneError;
use crate::camera::{Camera, Projection};
use crate::effect::Element;
use crate::film::Film;
use crate::geometry::{Shutter, Transform};
use crate::scene::SamplingSettings;
use crate::xml::NodeId;

/// A camera with what belongs to it.
pub(super) struct Sensor {
    pub(super) camera: Camera,
    pub(super) film: Film,
    pub(super) sampling: SamplingSettings,
}

/// The sensors there are.
const SENSORS: &Family<Sensor> = &[
    ("irradiancemeter", irradiance_meter),
    ("orthographic", orthographic),
    ("perspective", perspective),
    ("radiancemeter", radiance_meter),
    ("thinlens", thin_lens),
];

/// Mitsuba's clipping distances.
const NEAR_CLIP: f64 = 1e-2;
const FAR_CLIP: f64 = 1e4;

/// The sensor a node describes.
pub(super) fn translate(context: &mut Context<'_>, id: NodeId) -> Result<Sensor, SceneError> {
    let node = context.description.node(id);
    context.origins.note(Element::Camera, node);
    context.translate(SENSORS, node)
}

/// `fov` with `fov_axis` (x), or `focal_length` (50mm); `principal_point_offset_x`,
/// `principal_point_offset_y`, and what all sensors have.
fn perspective<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Sensor, SceneError> {
    let field_of_view = field_of_view(reader)?;
    let offset_x = reader.float("principal_point_offset_x")?.unwrap_or(0.0) as f32;
    let offset_y = reader.float("principal_point_offset_y")?.unwrap_or(0.0) as f32;
    // What is in focus matters to lenses only.
    reader.ignore(&["focus_distance"]);
    let principal_point_offset = [offset_x, offset_y];
    sensor(reader, context, Projection::Perspective { field_of_view, principal_point_offset })
}

/// `aperture_radius`, `focus_distance` (the far clip), `fov` as of `perspective`.
fn thin_lens<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Sensor, SceneError> {
    let field_of_view = field_of_view(reader)?;
    let Some(aperture_radius) = reader.float("aperture_radius")? else {
        return Err(reader.error("aperture_radius", "the lens has no “aperture_radius”"));
    };
    let far = reader.float("far_clip")?.unwrap_or(FAR_CLIP);
    let focus_distance = reader.float("focus_distance")?.unwrap_or(far) as f32;
    let aperture_radius = aperture_radius as f32;
    sensor(reader, context, Projection::ThinLens { field_of_view, aperture_radius, focus_distance })
}

/// Parallel rays; what all sensors have.
fn orthographic<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Sensor, SceneError> {
    reader.ignore(&["focus_distance"]);
    sensor(reader, context, Projection::Orthographic)
}

/// A single ray: `origin` and `direction`, or `to_world`, whose z axis it is.
fn radiance_meter<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Sensor, SceneError> {
    let given = (reader.vector("origin")?, reader.vector("direction")?);
    let (Some(origin), Some(direction)) = given else {
        if let (Some(_), None) | (None, Some(_)) = given {
            return Err(reader.error("origin", "“origin” and “direction” need each other"));
        }
        return sensor(reader, context, Projection::RadianceMeter);
    };
    if reader.has("to_world") {
        return Err(reader.error("origin", "give either “origin” and “direction” or “to_world”"));
    }
    let to_world =
        Transform::look_at(origin, origin + direction, direction.any_orthogonal_vector())
            .map_err(|_| reader.error("direction", "the direction has no length"))?;
    let (film, sampling) = surroundings(reader, context)?;
    let (near, far) = (NEAR_CLIP as f32, FAR_CLIP as f32);
    let camera = Camera::new(Projection::RadianceMeter, to_world, near, far, film.size);
    let camera =
        camera.map_err(|e| reader.error("direction", format!("{}: {e}", reader.title())))?;
    Ok(Sensor { camera, film, sampling })
}

/// The irradiance on the shape that the meter stands in.
fn irradiance_meter<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Sensor, SceneError> {
    let refused = |reader: &PluginReader<'_>, message| {
        SceneError::scene(reader.node().location.clone(), message)
    };
    let Some(shape) = context.metered.take() else {
        let message = format!("{} must stand inside a shape", reader.title());
        return Err(refused(reader, message));
    };
    let (film, sampling) = surroundings(reader, context)?;
    let camera =
        Camera::irradiance_meter(shape, film.size).map_err(|e| refused(reader, format!("{e}")))?;
    Ok(Sensor { camera, film, sampling })
}

/// `shutter_open` and `shutter_close` (0), in the time of animations.
pub(super) fn shutter(reader: &mut PluginReader<'_>) -> Result<Shutter, SceneError> {
    let open = reader.float("shutter_open")?.unwrap_or(0.0);
    let close = reader.float("shutter_close")?.unwrap_or(0.0);
    let at = if reader.has("shutter_close") { "shutter_close" } else { "shutter_open" };
    Shutter::new(open, close).map_err(|e| reader.error(at, format!("{e}")))
}

/// What all sensors have, wherever they stand: film, sampler, the shutter and at most one medium, in which the camera
/// stands.
fn surroundings<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<(Film, SamplingSettings), SceneError> {
    context.media.around_camera = medium::around(reader, context)?;
    let film = film::of(reader, context)?;
    let sampling = sampler::of(reader, context)?;
    // Read already: shapes have to know it.
    shutter(reader)?;
    Ok((film, sampling))
}

/// A camera with its surroundings, `to_world`, which may be an animation, `near_clip` (0.01) and `far_clip` (10 000).
fn sensor<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    projection: Projection,
) -> Result<Sensor, SceneError> {
    let (film, sampling) = surroundings(reader, context)?;
    let (to_world, motion) = reader.placement("to_world", context)?.into_parts();
    let near = reader.float("near_clip")?.unwrap_or(NEAR_CLIP) as f32;
    let far = reader.float("far_clip")?.unwrap_or(FAR_CLIP) as f32;
    let camera = Camera::new(projection, to_world, near, far, film.size);
    let camera = match motion {
        Some(motion) => camera.and_then(|camera| camera.moving(motion)),
        None => camera,
    };
    let camera = camera.map_err(|e| reader.error("fov", format!("{}: {e}", reader.title())))?;
    Ok(Sensor { camera, film, sampling })
}
