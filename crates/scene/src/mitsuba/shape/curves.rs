//! `linearcurve` and `bsplinecurve`.

use super::super::Context;
use super::super::reader::PluginReader;
use super::Item;
use super::mesh::{asset_error, path};
use super::surface::{placed, refused, surface};
use crate::SceneError;
use crate::geometry::{CurveBasis, Curves, Shape};
use crate::load::load_curves;

/// `filename`, `flip_normals` (false), `to_world`.
pub(super) fn linearcurve<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Item, SceneError> {
    curves(reader, context, CurveBasis::Linear)
}

/// The parameters of `linearcurve`.
pub(super) fn bsplinecurve<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Item, SceneError> {
    curves(reader, context, CurveBasis::BSpline)
}

fn curves<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    basis: CurveBasis,
) -> Result<Item, SceneError> {
    let path = path(reader)?;
    let file = load_curves(&path, basis).map_err(|error| asset_error(error, reader))?;
    let unfolded = size_of_val(&*file.points);
    context.read(&path, unfolded).map_err(|error| asset_error(error, reader))?;
    context.warnings.extend(file.warnings);
    let (to_world, motion) = placed(reader, context)?;
    let curves = Curves::new(basis, file.points, &file.lengths, &to_world);
    let curves = curves.map_err(|e| refused(reader, e))?;
    surface(reader, context, Shape::Curves(curves.into()), motion, reader.title())
}
