//! Integrators, all of which are our path tracer.

use alloc::format;

use super::reader::PluginReader;
use super::{Context, Family};
use crate::SceneError;
use crate::effect::Element;
use crate::scene::PathSettings;
use crate::xml::{Kind, NodeId};

/// The integrators there are.
const INTEGRATORS: &Family<PathSettings> = &[
    ("direct", direct),
    ("moment", moment),
    ("path", path),
    ("volpath", volumetric_path),
    ("volpathmis", volumetric_path),
];

/// The paths the integrator of a scene asks for.
pub(super) fn translate(context: &mut Context<'_>, id: NodeId) -> Result<PathSettings, SceneError> {
    let node = context.description.node(id);
    context.origins.note(Element::Paths, node);
    context.translate(INTEGRATORS, node)
}

/// `max_depth` (−1, unlimited), `rr_depth` (5), `hide_emitters` (false), `strict_normals` (false), `spectral` (false).
fn path<'a>(
    reader: &mut PluginReader<'a>,
    _: &mut Context<'a>,
) -> Result<PathSettings, SceneError> {
    let max_depth = depth(reader.integer("max_depth")?.unwrap_or(-1)).map_err(|_| {
        reader.error("max_depth", "“max_depth” must be −1 (unlimited) or not negative")
    })?;
    let roulette = reader.integer("rr_depth")?.unwrap_or(5);
    let roulette_depth = u32::try_from(roulette).ok().filter(|&n| n > 0).ok_or_else(|| {
        reader.error("rr_depth", format!("“rr_depth” must be positive, not {roulette}"))
    })?;
    Ok(PathSettings {
        max_depth,
        roulette_depth,
        hide_emitters: reader.boolean("hide_emitters", false)?,
        strict_normals: reader.boolean("strict_normals", false)?,
        volumes: false,
        spectral: reader.boolean("spectral", false)?,
    })
}

/// The parameters of `path`; knows media. Its `rr_depth` is the last number of edges at which no path is
/// ended by chance, that of `path` the first at which some are.
fn volumetric_path<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<PathSettings, SceneError> {
    let path = path(reader, context)?;
    let roulette_depth = path.roulette_depth.saturating_add(1);
    Ok(PathSettings { volumes: true, roulette_depth, ..path })
}

/// Direct light: paths of two edges. `hide_emitters` (false), `strict_normals` (false).
fn direct<'a>(
    reader: &mut PluginReader<'a>,
    _: &mut Context<'a>,
) -> Result<PathSettings, SceneError> {
    // How many samples go to lights and how many to surfaces is decided per path here.
    reader.ignore(&["shading_samples", "emitter_samples", "bsdf_samples"]);
    Ok(PathSettings {
        max_depth: Some(2),
        hide_emitters: reader.boolean("hide_emitters", false)?,
        strict_normals: reader.boolean("strict_normals", false)?,
        ..PathSettings::default()
    })
}

/// A wrapper that adds the second moment to the picture, which is not a matter of the scene here.
fn moment<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<PathSettings, SceneError> {
    match reader.children(Kind::Integrator, context)[..] {
        [inner] => translate(context, inner.node),
        _ => Err(reader.error("integrator", "“moment” needs one integrator inside")),
    }
}

/// A `max_depth` below −1.
pub(super) struct NegativeDepth;

/// The largest number of edges that a `max_depth` stands for; −1 is unlimited.
pub(super) fn depth(max_depth: i64) -> Result<Option<u32>, NegativeDepth> {
    match max_depth {
        -1 => Ok(None),
        0.. => Ok(Some(u32::try_from(max_depth).unwrap_or(u32::MAX))),
        _ => Err(NegativeDepth),
    }
}
