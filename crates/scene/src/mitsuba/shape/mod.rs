//! Shapes.

mod group;
mod mesh;
mod primitive;
mod surface;

pub(super) use mesh::shaded;

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::emitter::Emission;
use super::{Context, Family};
use crate::SceneError;
use crate::effect::Element;
use crate::geometry::{GroupId, Motion, Placement, Shape};
use crate::light::{AreaLight, BeamLight, Light, LightId};
use crate::material::MaterialId;
use crate::medium::Boundary;
use crate::scene::SurfaceInfo;
use crate::xml::NodeId;

/// The shapes there are.
const SHAPES: &Family<Item> = &[
    ("cube", mesh::cube),
    ("cylinder", primitive::cylinder),
    ("disk", primitive::disk),
    ("instance", group::instance),
    ("obj", mesh::obj),
    ("ply", mesh::ply),
    ("rectangle", primitive::rectangle),
    ("serialized", mesh::serialized),
    ("shapegroup", group::group),
    ("sphere", primitive::sphere),
];

/// What a shape plugin stands for.
#[expect(clippy::large_enum_variant, reason = "it is taken apart where it is made")]
pub(super) enum Item {
    /// A shape of its own.
    Surface(Surface),
    /// Shapes that are seen only where an instance puts them.
    Group(Vec<Surface>),
    /// A group at a place.
    Instance(GroupId, Placement),
}

/// A shape, what it is made of and what it emits.
pub(super) struct Surface {
    /// In the world, or in the space that moves.
    pub(super) shape: Shape,
    pub(super) motion: Option<Motion>,
    pub(super) material: MaterialId,
    pub(super) emission: Option<Emission>,
    pub(super) boundary: Option<Boundary>,
    pub(super) name: String,
}

/// Adds the shape, group or instance a node describes.
pub(super) fn add(context: &mut Context<'_>, id: NodeId) -> Result<(), SceneError> {
    let node = context.description.node(id);
    if context.groups.contains_key(&id) {
        return Ok(());
    }
    let item = context.translate(SHAPES, node)?;
    let moving = context.geometry.moving_count();
    match item {
        Item::Surface(surface) => {
            if let Some(light) = add_surface(context, surface) {
                context.origins.note(Element::Light(light), node);
            }
        }
        Item::Group(surfaces) => {
            let group = add_group(context, surfaces);
            context.groups.insert(id, group);
        }
        Item::Instance(group, placement) => {
            context.origins.note(Element::Instances, node);
            match placement {
                Placement::Still(transform) => {
                    context.geometry.add_instance(group, transform);
                }
                Placement::Moving(motion) => context.geometry.add_moving_instance(group, motion),
            }
        }
    }
    if context.geometry.moving_count() > moving {
        context.origins.note(Element::Moving(moving as u32), node);
    }
    Ok(())
}

/// Adds a shape that is seen where it stands, and the light that it is.
pub(super) fn add_surface(context: &mut Context<'_>, surface: Surface) -> Option<LightId> {
    let Surface { shape, motion, material, emission, boundary, name } = surface;
    let shape = match motion {
        Some(motion) => context.geometry.add_moving_shape(shape, motion),
        None => context.geometry.add_shape(shape),
    };
    let light = emission.map(|emission| {
        context.lights.push(match emission {
            Emission::Everywhere(radiance) => Light::Area(AreaLight { shape, radiance }),
            Emission::Ahead(exitance) => Light::Beam(BeamLight { shape, exitance }),
        });
        LightId(context.lights.len() as u32 - 1)
    });
    context.surfaces.push(SurfaceInfo { material, light, boundary, name });
    light
}

fn add_group(context: &mut Context<'_>, surfaces: Vec<Surface>) -> GroupId {
    let mut shapes = Vec::with_capacity(surfaces.len());
    for Surface { shape, material, boundary, name, .. } in surfaces {
        shapes.push(shape);
        context.surfaces.push(SurfaceInfo { material, light: None, boundary, name });
    }
    context.geometry.add_group(shapes).0
}

/// The group a node describes, added where that has not happened yet.
fn group_of(context: &mut Context<'_>, id: NodeId) -> Result<GroupId, SceneError> {
    let node = context.description.node(id);
    if node.plugin != "shapegroup" {
        let message = format!("an instance needs a shapegroup, not a shape “{}”", node.plugin);
        return Err(SceneError::scene(node.location.clone(), message));
    }
    add(context, id)?;
    context.groups.get(&id).copied().ok_or_else(|| {
        SceneError::scene(node.location.clone(), "the shapegroup contains its own instance")
    })
}
