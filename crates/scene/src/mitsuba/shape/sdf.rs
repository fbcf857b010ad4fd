//! `sdfgrid`.

use alloc::format;

use super::super::Context;
use super::super::reader::PluginReader;
use super::Item;
use super::mesh::{asset_error, path};
use super::surface::{placed, refused, surface};
use crate::SceneError;
use crate::geometry::{SdfGrid, SdfNormals, Shape};
use crate::load::load_sdf;

/// `filename`, `normals` (smooth), `flip_normals` (false), `to_world`.
pub(super) fn sdfgrid<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Item, SceneError> {
    let path = path(reader)?;
    let samples = load_sdf(&path).map_err(|error| asset_error(error, reader))?;
    let unfolded = size_of_val(samples.values());
    context.read(&path, unfolded).map_err(|error| asset_error(error, reader))?;
    let normals = match reader.string("normals")? {
        None | Some("smooth") => SdfNormals::Smooth,
        Some("analytic") => SdfNormals::Analytic,
        Some(other) => {
            let message = format!("“{other}” are no normals of a distance field");
            return Err(reader
                .error("normals", message)
                .help("there are smooth and analytic ones"));
        }
    };
    let (to_world, motion) = placed(reader, context)?;
    let grid = SdfGrid::new(samples, normals, &to_world).map_err(|e| refused(reader, e))?;
    surface(reader, context, Shape::Sdf(grid.into()), motion, reader.title())
}
