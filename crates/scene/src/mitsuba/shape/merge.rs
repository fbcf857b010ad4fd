//! `merge`.

use super::super::Context;
use super::super::reader::PluginReader;
use super::Item;
use crate::SceneError;
use crate::xml::Kind;

/// Shapes that Mitsuba joins to fewer meshes, to trace them faster. The picture is that of the shapes by themselves,
/// which share one hierarchy here in any case.
#[expect(clippy::unnecessary_wraps, reason = "the signature of its family")]
pub(super) fn merge<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Item, SceneError> {
    let shapes = reader.children(Kind::Shape, context);
    Ok(Item::Merged(shapes.into_iter().map(|child| child.node).collect()))
}
