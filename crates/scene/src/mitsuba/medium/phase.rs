//! Phase functions.

use alloc::format;

use etendue_sampling::warp::henyey_greenstein::HenyeyGreenstein;

use super::super::reader::PluginReader;
use super::super::{Context, Family};
use crate::SceneError;
use crate::medium::Phase;
use crate::xml::NodeId;

/// The phase functions there are.
const PHASES: &Family<Phase> = &[("hg", henyey_greenstein), ("isotropic", isotropic)];

/// The phase function a node describes.
pub(super) fn translate(context: &mut Context<'_>, id: NodeId) -> Result<Phase, SceneError> {
    context.translate(PHASES, context.description.node(id))
}

#[expect(clippy::unnecessary_wraps, reason = "the signature of its family")]
fn isotropic<'a>(_: &mut PluginReader<'a>, _: &mut Context<'a>) -> Result<Phase, SceneError> {
    Ok(Phase::Isotropic)
}

/// `g` (0.8), the mean cosine.
fn henyey_greenstein<'a>(
    reader: &mut PluginReader<'a>,
    _: &mut Context<'a>,
) -> Result<Phase, SceneError> {
    let g = reader.float("g")?.unwrap_or(0.8);
    HenyeyGreenstein::new(g as f32).map(Phase::HenyeyGreenstein).ok_or_else(|| {
        reader.error("g", format!("“g” must lie between -1 and 1, both excluded, but is {g}"))
    })
}
