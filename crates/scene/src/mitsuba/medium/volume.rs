//! Values that may vary in space.

use alloc::format;
use alloc::string::String;

use etendue_math::glam::{DAffine3, DVec3};

use super::super::reader::PluginReader;
use super::super::value::{Role, color_and_curve_or, color_or};
use super::super::{Context, Family};
use crate::SceneError;
use crate::color::Curve;
use crate::geometry::{Aabb, Transform, TransformError};
use crate::load::{VolumeFile, load_volume};
use crate::medium::{GridFilter, Volume};
use crate::texture::Wrap;
use crate::xml::Kind;

/// The volumes there are.
const VOLUMES: &Family<Volume> = &[("constvolume", constant), ("gridvolume", grid)];

/// Whether the parameter `name` is a volume.
pub(super) fn is_volume(reader: &PluginReader<'_>, context: &Context<'_>, name: &str) -> bool {
    let mut named = reader.node().children.iter().filter(|child| child.name == name);
    named.any(|child| context.description.node(child.node).kind == Kind::Volume)
}

/// The parameter `name` as a volume; grey `default` where it is missing.
///
/// # Errors
/// A value that is neither a number nor a colour, a spectrum or a volume.
pub(in crate::mitsuba) fn or<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    name: &'static str,
    role: Role,
    default: f32,
) -> Result<Volume, SceneError> {
    with_curve_or(reader, context, name, role, default).map(|(volume, _)| volume)
}

/// The same with the curve of one that is the same everywhere, if it was given as such.
///
/// # Errors
/// As [`or`].
pub(super) fn with_curve_or<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    name: &'static str,
    role: Role,
    default: f32,
) -> Result<(Volume, Option<Curve>), SceneError> {
    if is_volume(reader, context, name)
        && let Some(child) = reader.named_child(name)
    {
        let node = context.description.node(child.node);
        return context.translate(VOLUMES, node).map(|volume| (volume, None));
    }
    let (color, curve) = color_and_curve_or(reader, context, name, role, default)?;
    Ok((Volume::constant(color), curve))
}

/// `value` (colour, 1), `to_world`.
fn constant<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Volume, SceneError> {
    let value = color_or(reader, context, "value", Role::Material, 1.0)?;
    Ok(Volume::constant_in(value, &reader.transform("to_world")?))
}

/// `filename`, `filter_type` (trilinear), `wrap_mode` (clamp), `to_world`, `use_grid_bbox` (false).
fn grid<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Volume, SceneError> {
    let filter = reader.choice(
        "filter_type",
        &[("trilinear", GridFilter::Trilinear), ("nearest", GridFilter::Nearest)],
    )?;
    let wrap = reader.choice(
        "wrap_mode",
        &[("clamp", Wrap::Clamp), ("repeat", Wrap::Repeat), ("mirror", Wrap::Mirror)],
    )?;
    // Values are linear RGB either way, and their largest is found by looking.
    reader.ignore(&["raw", "accel", "max_value"]);
    let Some(name) = reader.string("filename")? else {
        return Err(reader.error("filename", format!("{} has no “filename”", reader.title())));
    };
    let named = |mut error: SceneError| {
        let place = reader.location("filename");
        error.message = format!("{} (named at {place})", error.message);
        error
    };
    let path = reader.node().search.resolve(name).map_err(named)?;
    let VolumeFile { grid, bounds } = load_volume(&path).map_err(named)?;
    context.read(&path, grid.bytes()).map_err(named)?;
    let mut to_world = reader.transform("to_world")?;
    if reader.boolean("use_grid_bbox", false)? {
        to_world = placed(&to_world, &bounds).map_err(|error| {
            let message: String = format!("the box of {name}: {error}");
            reader.error("use_grid_bbox", message)
        })?;
    }
    Ok(Volume::grid(grid, to_world, filter, wrap))
}

/// The unit cube put into a box before `to_world`.
fn placed(to_world: &Transform, bounds: &Aabb) -> Result<Transform, TransformError> {
    let min = bounds.min.as_dvec3();
    let size: DVec3 = bounds.max.as_dvec3() - min;
    let fit = DAffine3::from_translation(min) * DAffine3::from_scale(size);
    to_world.compose(&Transform::from_affine(fit)?)
}
