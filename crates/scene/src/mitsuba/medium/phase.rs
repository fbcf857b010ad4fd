//! Phase functions.

use alloc::boxed::Box;
use alloc::format;
use alloc::vec::Vec;

use etendue_sampling::warp::henyey_greenstein::HenyeyGreenstein;

use super::super::reader::PluginReader;
use super::super::value::Role;
use super::super::{Context, Family};
use super::volume;
use crate::SceneError;
use crate::medium::{BlendPhase, Phase, TabulatedPhase};
use crate::xml::{Kind, NodeId};

/// The phase functions there are.
const PHASES: &Family<Phase> = &[
    ("blendphase", blend),
    ("hg", henyey_greenstein),
    ("isotropic", isotropic),
    ("rayleigh", rayleigh),
    ("tabphase", tabulated),
];

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

#[expect(clippy::unnecessary_wraps, reason = "the signature of its family")]
fn rayleigh<'a>(_: &mut PluginReader<'a>, _: &mut Context<'a>) -> Result<Phase, SceneError> {
    Ok(Phase::Rayleigh)
}

/// `values`, a list, at cosines from −1 to 1.
fn tabulated<'a>(reader: &mut PluginReader<'a>, _: &mut Context<'a>) -> Result<Phase, SceneError> {
    let Some(values) = reader.numbers("values")? else {
        return Err(reader.error("values", "the table has no “values”"));
    };
    let values: Vec<f32> = values.into_iter().map(|value| value as f32).collect();
    if values.len() < 2 {
        return Err(reader.error("values", "“values” must be at least two"));
    }
    TabulatedPhase::new(&values)
        .map(Phase::Tabulated)
        .map_err(|error| reader.error("values", format!("“values”: {error}")))
}

/// Two phase functions in shares: `weight` (volume, 0.5) is that of the second.
fn blend<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Phase, SceneError> {
    let weight = volume::or(reader, context, "weight", Role::Reflectance, 0.5)?;
    let [first, second] = reader.children(Kind::Phase, context)[..] else {
        let location = reader.node().location.clone();
        return Err(SceneError::scene(location, "a blend needs two phase functions inside"));
    };
    let parts = [translate(context, first.node)?, translate(context, second.node)?];
    Ok(Phase::Blend(Box::new(BlendPhase { weight, parts })))
}
