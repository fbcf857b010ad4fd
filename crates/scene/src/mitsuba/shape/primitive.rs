//! Sphere, rectangle, disk and cylinder.

use etendue_math::glam::DVec3;

use super::super::Context;
use super::super::reader::PluginReader;
use super::Item;
use super::surface::{placed, refused, surface};
use crate::SceneError;
use crate::geometry::{Cylinder, Disk, Rectangle, Shape, Sphere};

/// `center` (origin), `radius` (1), `flip_normals` (false), `to_world`.
pub(super) fn sphere<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Item, SceneError> {
    let center = reader.vector("center")?.unwrap_or(DVec3::ZERO);
    let radius = radius(reader)?;
    let (to_world, motion) = placed(reader, context)?;
    let sphere = Sphere::new(center, radius, &to_world).map_err(|e| refused(reader, e))?;
    surface(reader, context, Shape::Sphere(sphere), motion, "sphere".into())
}

/// The square between −1 and 1 with normal +z: `flip_normals` (false), `to_world`.
pub(super) fn rectangle<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Item, SceneError> {
    let (to_world, motion) = placed(reader, context)?;
    let rectangle = Rectangle::new(&to_world).map_err(|e| refused(reader, e))?;
    surface(reader, context, Shape::Rectangle(rectangle), motion, "rectangle".into())
}

/// The unit disk with normal +z: `flip_normals` (false), `to_world`.
pub(super) fn disk<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Item, SceneError> {
    let (to_world, motion) = placed(reader, context)?;
    surface(reader, context, Shape::Disk(Disk::new(&to_world)), motion, "disk".into())
}

/// The mantle of a cylinder: `p0` (origin), `p1` (0, 0, 1), `radius` (1), `flip_normals` (false),
/// `to_world`.
pub(super) fn cylinder<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Item, SceneError> {
    let p0 = reader.vector("p0")?.unwrap_or(DVec3::ZERO);
    let p1 = reader.vector("p1")?.unwrap_or(DVec3::Z);
    let radius = radius(reader)?;
    let (to_world, motion) = placed(reader, context)?;
    let cylinder = Cylinder::new(p0, p1, radius, &to_world).map_err(|e| refused(reader, e))?;
    surface(reader, context, Shape::Cylinder(cylinder), motion, "cylinder".into())
}

fn radius(reader: &mut PluginReader<'_>) -> Result<f64, SceneError> {
    reader.float_in("radius", 1.0, "positive", |radius| radius > 0.0)
}
