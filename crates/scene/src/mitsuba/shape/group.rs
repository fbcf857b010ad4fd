//! `shapegroup` and `instance`.

use alloc::format;
use alloc::vec::Vec;

use super::super::Context;
use super::super::reader::PluginReader;
use super::{Item, SHAPES, group_of};
use crate::SceneError;
use crate::xml::Kind;

/// Shapes that are seen only where an instance puts them.
pub(super) fn group<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Item, SceneError> {
    let mut surfaces = Vec::new();
    for child in reader.children(Kind::Shape, context) {
        let refused = |what: &str| {
            let message = format!("a shapegroup cannot contain {what}");
            SceneError::scene(child.location.clone(), message)
        };
        let node = context.description.node(child.node);
        // Before its translation: an instance inside its own group would never end.
        if node.plugin == "instance" {
            return Err(refused("instances"));
        }
        match context.translate(SHAPES, node)? {
            Item::Surface(surface) if surface.emission.is_some() => {
                return Err(refused("emitters"));
            }
            Item::Surface(surface) if surface.motion.is_some() => {
                return Err(refused("shapes that move").help("let its instances move"));
            }
            Item::Surface(surface) => surfaces.push(surface),
            Item::Group(_) | Item::Instance(..) => return Err(refused("groups or instances")),
        }
    }
    Ok(Item::Group(surfaces))
}

/// One group, put somewhere by `to_world`, which may be an animation.
pub(super) fn instance<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Item, SceneError> {
    let Some(child) = reader.child(Kind::Shape, context)? else {
        return Err(reader.error("shapegroup", "the instance has no shapegroup"));
    };
    let placement = reader.placement("to_world", context)?;
    Ok(Item::Instance(group_of(context, child.node)?, placement))
}
