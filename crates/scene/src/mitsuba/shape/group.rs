//! `shapegroup` and `instance`.

use alloc::collections::VecDeque;
use alloc::format;
use alloc::vec::Vec;

use super::super::Context;
use super::super::reader::PluginReader;
use super::{Item, SHAPES, group_of};
use crate::SceneError;
use crate::xml::{Kind, NodeId};

/// Shapes that are seen only where an instance puts them.
pub(super) fn group<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Item, SceneError> {
    let mut surfaces = Vec::new();
    let mut left: VecDeque<NodeId> =
        reader.children(Kind::Shape, context).into_iter().map(|child| child.node).collect();
    while let Some(id) = left.pop_front() {
        let node = context.description.node(id);
        let refused = |what: &str| {
            let message = format!("a shapegroup cannot contain {what}");
            SceneError::scene(node.location.clone(), message)
        };
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
            Item::Merged(shapes) => {
                for id in shapes.into_iter().rev() {
                    left.push_front(id);
                }
            }
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
