//! What nodes put into the scene.

use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

use etendue_math::glam::DAffine3;

use super::builder::Builder;
use super::instances;
use super::json::Json;
use super::material::{self, Look, Substance};
use super::mesh::{self, Primitive};
use super::node::Node;
use super::skin::{self, Skin};
use crate::SceneError;
use crate::effect::Element;
use crate::geometry::{Shape, Transform, TransformError, TriangleMesh};
use crate::light::{AreaLight, Light, LightId};
use crate::scene::SurfaceInfo;

/// A mesh of one material, in the space of its nodes.
struct Part {
    mesh: TriangleMesh,
    substance: Substance,
    name: String,
}

/// A place where a mesh is seen.
struct Use<'n, 'a> {
    node: &'n Node<'a>,
    to_world: DAffine3,
}

/// Adds the meshes of all nodes: where they stand if they are used once, shine or hang on joints, else as instances of a group.
///
/// # Errors
/// Meshes and materials that are refused, places out of range.
pub(super) fn add(builder: &mut Builder<'_>, nodes: &[Node<'_>]) -> Result<(), SceneError> {
    let document = builder.document();
    let places = nodes.iter().map(|node| (node.index, node.to_world)).collect();
    let mut uses: BTreeMap<usize, Vec<Use<'_, '_>>> = BTreeMap::new();
    for node in nodes {
        let Some((index, mesh)) = document.named(&node.json, "mesh", "meshes")? else { continue };
        if let Some(skin) = skin::of(builder.buffers, node, &places)? {
            let parts = parts(builder, &mesh, Some(&skin))?;
            // Joints place it, its own node does not.
            add_in_place(builder, &parts, &Use { node, to_world: DAffine3::IDENTITY })?;
            continue;
        }
        let own = instances::of(builder.buffers, node)?;
        let own = own.into_iter().map(|to_world| Use { node, to_world });
        uses.entry(index).or_default().extend(own);
    }
    let meshes = document.list("meshes")?;
    for (index, uses) in uses {
        let parts = parts(builder, &meshes[index], None)?;
        let shines = parts.iter().any(|part| part.substance.radiance.is_some());
        if uses.len() == 1 || shines {
            let size = |part: &Part| part.mesh.positions().len() + part.mesh.triangles().len();
            let copies = uses.len().saturating_sub(1) as u64;
            let elements = parts.iter().map(size).sum::<usize>() as u64;
            builder.buffers.spend(elements.saturating_mul(copies), &meshes[index])?;
            for used in &uses {
                add_in_place(builder, &parts, used)?;
            }
        } else {
            add_instances(builder, parts, &uses)?;
        }
    }
    Ok(())
}

/// The parts of a mesh.
fn parts(
    builder: &mut Builder<'_>,
    mesh: &Json<'_>,
    skin: Option<&Skin>,
) -> Result<Vec<Part>, SceneError> {
    let name = mesh.title()?;
    if !mesh.items("weights")?.is_empty() {
        builder
            .warn(&mesh.warning("targets of a morph are not read: the mesh is as it is without"));
    }
    let mut parts = Vec::new();
    for primitive in mesh.items("primitives")? {
        let index = builder.document().named(&primitive, "material", "materials")?;
        let index = index.map(|(index, _)| index);
        let json = material::json(builder, index)?;
        let set = material::set(&json)?;
        let Some(read) = mesh::read(builder.buffers, &primitive, set, skin)? else {
            let message = "points, lines and what has no positions are not rendered";
            builder.warn(&primitive.warning(message));
            continue;
        };
        let Primitive { mesh, has_uv, has_colors, has_alpha } = read;
        let by_handedness = if has_uv && json.get("normalTexture")?.is_some() {
            mesh::by_handedness(mesh).map_err(|error| primitive.error(error))?
        } else {
            [Some(mesh), None]
        };
        for (mesh, is_mirrored) in by_handedness.into_iter().zip([false, true]) {
            let Some(mesh) = mesh else { continue };
            let look = Look { index, has_uv, has_colors, has_alpha, is_mirrored };
            let substance = material::of(builder, look)?;
            parts.push(Part { mesh, substance, name: name.clone() });
        }
    }
    Ok(parts)
}

/// The place of a mesh. None, with a warning, where it is flattened.
fn place(builder: &mut Builder<'_>, used: &Use<'_, '_>) -> Result<Option<Transform>, SceneError> {
    let json = &used.node.json;
    match Transform::from_affine(used.to_world) {
        Ok(transform) => Ok(Some(transform)),
        Err(TransformError::Singular) => {
            builder.warn(&json.warning("its mesh is flattened to nothing and left out"));
            Ok(None)
        }
        Err(error) => Err(json.error(error)),
    }
}

fn add_in_place(
    builder: &mut Builder<'_>,
    parts: &[Part],
    used: &Use<'_, '_>,
) -> Result<(), SceneError> {
    let Some(transform) = place(builder, used)? else { return Ok(()) };
    for Part { mesh, substance, name } in parts {
        let mesh = mesh.clone().transformed(&transform);
        let mesh = mesh.map_err(|error| used.node.json.error(error))?;
        // Mirroring does not turn a body inside out.
        let is_turned = transform.is_mirrored() && mesh.normals().is_empty();
        let shape = Shape::Mesh(if is_turned { mesh.flipped() } else { mesh });
        let radiance = substance.radiance.filter(|_| shape.area_total() > 0.0);
        let shape = builder.model.geometry.add_shape(shape);
        let lights = &mut builder.model.lights;
        let light = radiance.map(|radiance| {
            lights.push(Light::Area(AreaLight { shape, radiance }));
            LightId(lights.len() as u32 - 1)
        });
        if let Some(light) = light {
            builder.note(Element::Light(light), &used.node.json)?;
        }
        builder.model.surfaces.push(info(*substance, light, name.clone()));
    }
    Ok(())
}

fn info(substance: Substance, light: Option<LightId>, name: String) -> SurfaceInfo {
    let Substance { material, boundary, .. } = substance;
    SurfaceInfo { material, light, boundary, name }
}

fn add_instances(
    builder: &mut Builder<'_>,
    parts: Vec<Part>,
    uses: &[Use<'_, '_>],
) -> Result<(), SceneError> {
    let mut shapes = Vec::with_capacity(parts.len());
    for Part { mesh, substance, name } in parts {
        shapes.push(Shape::Mesh(mesh));
        builder.model.surfaces.push(info(substance, None, name));
    }
    let (group, _) = builder.model.geometry.add_group(shapes);
    for used in uses {
        if let Some(transform) = place(builder, used)? {
            builder.note(Element::Instances, &used.node.json)?;
            builder.model.geometry.add_instance(group, transform);
        }
    }
    Ok(())
}
