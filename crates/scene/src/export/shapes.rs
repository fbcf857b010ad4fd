//! Shapes, groups and instances.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

use etendue_math::glam::DAffine3;

use super::element::Element;
use super::exporter::Exporter;
use super::textures::Meaning;
use super::values::{boolean, to_world};
use super::{fields, mesh};
use crate::geometry::{GroupId, Shape, ShapeId};
use crate::light::Light;

/// The shapes of a scene in the order in which they are held, then the instances of groups.
pub(super) fn elements(exporter: &mut Exporter<'_>) -> Vec<Element> {
    let geometry = &exporter.scene.geometry;
    let used: BTreeSet<GroupId> = geometry.instances().map(|(group, _)| group).collect();
    let mut items: Vec<(ShapeId, Option<GroupId>)> =
        geometry.top_level().iter().map(|&shape| (shape, None)).collect();
    items.extend(used.into_iter().filter_map(|group| {
        let first = geometry.group(group).next()?;
        Some((first, Some(group)))
    }));
    items.sort_unstable();
    let mut elements = Vec::new();
    let mut groups = BTreeMap::new();
    for (shape, group) in items {
        let Some(group) = group else {
            elements.extend(self::shape(exporter, shape));
            continue;
        };
        let shapes: Vec<_> =
            geometry.group(group).filter_map(|shape| self::shape(exporter, shape)).collect();
        if shapes.is_empty() {
            continue;
        }
        let name = exporter.name("group");
        let element = Element::plugin("shape", "shapegroup").attribute("id", name.clone());
        elements.push(element.with_all(shapes));
        groups.insert(group, name);
    }
    let instances = geometry.instances().filter_map(|(group, place)| {
        let group = Element::reference(groups.get(&group)?);
        let instance = Element::plugin("shape", "instance").with(group);
        Some(instance.with_all(to_world(place.affine())))
    });
    elements.extend(instances);
    elements
}

/// Keeps a sensor for the shape whose surface it measures; gives one that stands by itself back.
pub(super) fn inside(exporter: &mut Exporter<'_>, sensor: Element) -> Option<Element> {
    let geometry = &exporter.scene.geometry;
    let shape = exporter.scene.camera.metered().and_then(|metered| {
        let is_it = |id: &&ShapeId| geometry.shapes()[id.0 as usize] == *metered;
        geometry.top_level().iter().find(is_it)
    });
    match shape {
        Some(&shape) => {
            exporter.metering = Some((shape, sensor));
            None
        }
        None => Some(sensor),
    }
}

/// A shape with what it is made of, what it emits and what it bounds; nothing for a mesh without triangles, which Mitsuba
/// refuses.
fn shape(exporter: &mut Exporter<'_>, id: ShapeId) -> Option<Element> {
    let scene = exporter.scene;
    let surface = &scene.surfaces[id.0 as usize];
    let shape = &scene.geometry.shapes()[id.0 as usize];
    if matches!(shape, Shape::Mesh(mesh) if mesh.triangles().is_empty()) {
        return None;
    }
    let name = exporter.name(&surface.name);
    let placed = |kind: &str, (place, is_flipped): (&DAffine3, bool)| {
        (Element::plugin("shape", kind).with_all(to_world(place)), is_flipped)
    };
    let (element, is_flipped) = match shape {
        Shape::Mesh(mesh) => {
            let filename = exporter.file(&name, "ply", mesh::ply(mesh));
            let is_flat = mesh.normals().is_empty();
            let element = Element::plugin("shape", "ply")
                .with(filename)
                .with_all(is_flat.then(|| boolean("face_normals", true)));
            (element, mesh.is_flipped())
        }
        Shape::Sphere(sphere) => placed("sphere", sphere.placement()),
        Shape::Rectangle(rectangle) => placed("rectangle", rectangle.placement()),
        Shape::Disk(disk) => placed("disk", disk.placement()),
        Shape::Cylinder(cylinder) => placed("cylinder", cylinder.placement()),
        Shape::Sdf(grid) => fields::sdf(exporter, &name, grid),
        Shape::Curves(curves) => fields::curves(exporter, &name, curves),
    };
    let mut element = element
        .attribute("id", name)
        .with_all(is_flipped.then(|| boolean("flip_normals", true)))
        .with(exporter.material(surface.material));
    if let Some(boundary) = surface.boundary {
        for (name, side) in [("interior", boundary.interior), ("exterior", boundary.exterior)] {
            element = element.with_all(side.and_then(|medium| exporter.medium(name, medium)));
        }
    }
    if let Some((_, sensor)) = exporter.metering.take_if(|(shape, _)| *shape == id) {
        element = element.with(sensor);
    }
    let light = surface.light.and_then(|light| scene.lights.get(light.0 as usize));
    let emission = match light {
        Some(Light::Area(light)) => Some(("area", light.radiance)),
        Some(Light::Beam(light)) => Some(("directionalarea", light.exitance)),
        _ => None,
    };
    if let Some((kind, radiance)) = emission {
        let radiance = exporter.texture("radiance", radiance, Meaning::Light);
        element = element.with(Element::plugin("emitter", kind).with(radiance));
    }
    Some(element)
}
