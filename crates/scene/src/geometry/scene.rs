//! All shapes of a scene behind one interface.

use alloc::vec::Vec;
use core::ops::Range;

use super::bvh::simd::{Backend, Kernel, Simd};
use super::bvh::{Bvh, Found, Objects, PreparedRay, TriangleRef};
use super::surface::LocalSurface;
use super::{Aabb, GeometryBuilder, Ray, Shape, ShapeId, SurfacePoint, Transform, triangle};

/// Shapes, groups and instances, ready for rays.
///
/// Made by [`GeometryBuilder::build`]. Rays with a NaN or infinite component, without direction, or
/// with a `t_max` that is not positive hit nothing.
#[derive(Clone, Debug)]
pub struct Geometry {
    shapes: Vec<Shape>,
    /// The shapes that are not part of a group.
    top_level: Vec<ShapeId>,
    instances: Vec<Instance>,
    groups: Vec<Level>,
    pub(super) top: Level,
    pub(super) backend: Backend,
}

/// Where a ray meets a surface first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The ray's parameter there.
    pub t: f32,
    /// Barycentric weights of the second and third corner of a triangle; 0 on other shapes.
    pub uv: [f32; 2],
    /// The shape.
    pub shape: ShapeId,
    /// The triangle within a mesh, the half of a rectangle, 0 on other shapes.
    pub primitive: u32,
    /// The instance through which the shape was hit, or `u32::MAX` for none.
    pub instance: u32,
}

/// How large a geometry is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeometryStatistics {
    /// Triangles that rays are tested against, each group counted once.
    pub triangles: usize,
    /// Triangles without area, which are never hit.
    pub degenerate_triangles: usize,
    /// Nodes of all hierarchies.
    pub nodes: usize,
    /// Memory of all hierarchies in bytes, the triangles' copies in them included.
    pub bytes: usize,
}

impl GeometryStatistics {
    /// Memory of the hierarchies per triangle in bytes; 0 without triangles.
    pub fn bytes_per_triangle(&self) -> f64 {
        if self.triangles == 0 { 0.0 } else { self.bytes as f64 / self.triangles as f64 }
    }
}

#[derive(Clone, Debug)]
struct Instance {
    group: u32,
    transform: Transform,
}

/// The point of any shape, in a group or not. Out of line, so that meshes do not pay for it.
#[inline(never)]
fn local_surface(shape: &Shape, instance: Option<&Instance>, ray: Ray, hit: Hit) -> LocalSurface {
    match instance {
        None => shape.surface(&ray, &hit),
        Some(Instance { transform, .. }) => {
            shape.surface(&transform.inverse_ray(&ray), &hit).transformed(transform)
        }
    }
}

/// One hierarchy: the world, or a group.
#[derive(Clone, Debug)]
pub(super) struct Level {
    /// Its objects are the quadrics, followed by the instances of the world.
    pub(super) bvh: Bvh,
    quadrics: Vec<u32>,
    triangles: usize,
    degenerate_triangles: usize,
}

impl Level {
    /// `instances`: the boxes of the instances.
    fn build(shapes: &[Shape], ids: impl Iterator<Item = u32>, instances: &[Aabb]) -> Self {
        let (mut triangles, mut degenerate_triangles) = (Vec::new(), 0);
        let (mut quadrics, mut boxes) = (Vec::new(), Vec::new());
        for id in ids {
            let shape = &shapes[id as usize];
            match shape {
                Shape::Mesh(_) | Shape::Rectangle(_) => {
                    for primitive in 0..shape.triangle_count() {
                        let Some(corners) = shape.triangle(primitive) else { continue };
                        if triangle::normal(&corners).is_some() {
                            triangles.push(TriangleRef { corners, shape: id, primitive });
                        } else {
                            degenerate_triangles += 1;
                        }
                    }
                }
                Shape::Sphere(_) | Shape::Disk(_) | Shape::Cylinder(_) => {
                    quadrics.push(id);
                    boxes.push(shape.bounds());
                }
            }
        }
        boxes.extend_from_slice(instances);
        let bvh = Bvh::build(&triangles, &boxes);
        Self { bvh, quadrics, triangles: triangles.len(), degenerate_triangles }
    }
}

impl Geometry {
    pub(super) fn build(builder: GeometryBuilder) -> Self {
        let GeometryBuilder { shapes, top_level, groups, instances } = builder;
        let groups: Vec<Level> = groups
            .into_iter()
            .map(|Range { start, end }| Level::build(&shapes, start..end, &[]))
            .collect();
        let boxes: Vec<Aabb> = instances
            .iter()
            // A group of another builder may not exist here: such an instance shows nothing.
            .map(|(group, transform)| {
                let group = groups.get(group.0 as usize);
                group.map_or(Aabb::EMPTY, |level| transform.aabb(&level.bvh.bounds()))
            })
            .collect();
        let top = Level::build(&shapes, top_level.iter().map(|id| id.0), &boxes);
        let instances = instances
            .into_iter()
            .map(|(group, transform)| Instance { group: group.0, transform })
            .collect();
        Self { shapes, top_level, instances, groups, top, backend: Backend::detect() }
    }

    /// The same without its instances; the shapes of groups keep their numbers, and no ray meets them.
    pub(crate) fn without_instances(self) -> Self {
        let top = Level::build(&self.shapes, self.top_level.iter().map(|id| id.0), &[]);
        Self { instances: Vec::new(), top, ..self }
    }

    /// The closest hit at `0 < t < t_max`.
    #[inline]
    pub fn intersect(&self, ray: &Ray) -> Option<Hit> {
        self.backend.run(Closest { geometry: self, ray })
    }

    /// Whether anything is hit at `0 < t < t_max`.
    #[inline]
    pub fn occluded(&self, ray: &Ray) -> bool {
        self.backend.run(Occluded { geometry: self, ray })
    }

    #[inline(always)]
    pub(super) fn intersect_with<S: Simd>(&self, simd: S, ray: &Ray) -> Option<Hit> {
        if !ray.is_valid() {
            return None;
        }
        let mut found = Found::nothing_before(ray.t_max);
        // A copy field by field: objects are asked by calls, and a reference, or a copy that the
        // compiler sees through, would keep the caller's ray in memory.
        let objects = World { geometry: self, ray: &Ray { ..*ray } };
        self.top.bvh.closest(simd, &PreparedRay::new(simd, ray), &objects, &mut found);
        (found.shape != u32::MAX).then_some(Hit {
            t: found.t,
            uv: found.uv,
            shape: ShapeId(found.shape),
            primitive: found.primitive,
            instance: found.instance,
        })
    }

    #[inline(always)]
    pub(super) fn occluded_with<S: Simd>(&self, simd: S, ray: &Ray) -> bool {
        let objects = World { geometry: self, ray: &Ray { ..*ray } };
        ray.is_valid()
            && self.top.bvh.occluded(simd, &PreparedRay::new(simd, ray), &objects, ray.t_max)
    }

    /// What is at a hit that [`intersect`](Self::intersect) of this geometry has found for this ray.
    ///
    /// # Panics
    /// A hit of another geometry may name shapes and triangles that do not exist here.
    #[inline(always)]
    pub fn surface_point(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let shape = &self.shapes[hit.shape.0 as usize];
        match (shape, self.instances.get(hit.instance as usize)) {
            (Shape::Mesh(mesh), None) => mesh.surface(hit.primitive, hit.uv).of(hit),
            (Shape::Rectangle(rectangle), None) => rectangle.surface(hit.primitive, hit.uv).of(hit),
            // Only now made a point, so that those above need not be where this one is returned.
            (shape, instance) => {
                local_surface(shape, instance, Ray { ..*ray }, Hit { ..*hit }).of(hit)
            }
        }
    }

    /// Every shape, those of groups included, in the order in which they were added.
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    /// Where an instance puts its group; `None` where there is no such instance.
    pub(super) fn placement(&self, instance: u32) -> Option<&Transform> {
        self.instances.get(instance as usize).map(|instance| &instance.transform)
    }

    /// How many instances of groups there are.
    pub fn instance_count(&self) -> usize {
        self.instances.len()
    }

    /// A box that holds everything; empty for an empty scene.
    pub fn bounds(&self) -> Aabb {
        self.top.bvh.bounds()
    }

    /// How large it is.
    pub fn statistics(&self) -> GeometryStatistics {
        let levels = || self.groups.iter().chain([&self.top]);
        GeometryStatistics {
            triangles: levels().map(|l| l.triangles).sum(),
            degenerate_triangles: levels().map(|l| l.degenerate_triangles).sum(),
            nodes: levels().map(|l| l.bvh.node_count()).sum(),
            bytes: levels().map(|l| l.bvh.bytes()).sum(),
        }
    }
}

/// The closest hit as a kernel.
struct Closest<'a> {
    geometry: &'a Geometry,
    ray: &'a Ray,
}

impl Kernel for Closest<'_> {
    type Output = Option<Hit>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Option<Hit> {
        self.geometry.intersect_with(simd, self.ray)
    }
}

/// Any hit as a kernel.
struct Occluded<'a> {
    geometry: &'a Geometry,
    ray: &'a Ray,
}

impl Kernel for Occluded<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> bool {
        self.geometry.occluded_with(simd, self.ray)
    }
}

/// The objects of the world: quadrics and instances.
struct World<'a> {
    geometry: &'a Geometry,
    ray: &'a Ray,
}

/// The objects of a group: quadrics only, so that instances do not nest.
struct Group<'a> {
    shapes: &'a [Shape],
    quadrics: &'a [u32],
    ray: &'a Ray,
}

impl<'a> World<'a> {
    fn quadrics(&self) -> Group<'a> {
        let Geometry { shapes, top, .. } = self.geometry;
        Group { shapes, quadrics: &top.quadrics, ray: self.ray }
    }

    /// An object that is not a quadric: the number of the instance, and its group.
    #[inline(always)]
    fn instance(&self, object: u32) -> Option<(u32, &'a Transform, &'a Level)> {
        let number = object.checked_sub(self.geometry.top.quadrics.len() as u32)?;
        let Instance { group, transform } = self.geometry.instances.get(number as usize)?;
        Some((number, transform, self.geometry.groups.get(*group as usize)?))
    }
}

impl Objects for World<'_> {
    #[inline(always)]
    fn closest<S: Simd>(&self, simd: S, object: u32, found: &mut Found) {
        let Some((number, transform, group)) = self.instance(object) else {
            return self.quadrics().closest(simd, object, found);
        };
        let ray = transform.inverse_ray(self.ray);
        if !ray.is_valid() {
            return;
        }
        let objects = Group { shapes: &self.geometry.shapes, quadrics: &group.quadrics, ray: &ray };
        let before = found.t;
        group.bvh.closest(simd, &PreparedRay::new(simd, &ray), &objects, found);
        if found.t < before {
            found.instance = number;
        }
    }

    #[inline(always)]
    fn occluded<S: Simd>(&self, simd: S, object: u32, t_max: f32) -> bool {
        let Some((_, transform, group)) = self.instance(object) else {
            return self.quadrics().occluded(simd, object, t_max);
        };
        let ray = transform.inverse_ray(self.ray);
        let objects = Group { shapes: &self.geometry.shapes, quadrics: &group.quadrics, ray: &ray };
        ray.is_valid() && group.bvh.occluded(simd, &PreparedRay::new(simd, &ray), &objects, t_max)
    }
}

impl Group<'_> {
    /// Never inlined: `f64` arithmetic in the middle of the loop over boxes would only cost registers.
    #[inline(never)]
    fn intersect(&self, object: u32, t_max: f32) -> Option<(u32, f32)> {
        let shape = *self.quadrics.get(object as usize)?;
        let ray = Ray { t_max, ..*self.ray };
        Some((shape, self.shapes[shape as usize].intersect_quadric(&ray)?))
    }
}

impl Objects for Group<'_> {
    #[inline(always)]
    fn closest<S: Simd>(&self, _: S, object: u32, found: &mut Found) {
        if let Some((shape, t)) = self.intersect(object, found.t) {
            *found = Found { t, shape, ..Found::nothing_before(t) };
        }
    }

    #[inline(always)]
    fn occluded<S: Simd>(&self, _: S, object: u32, t_max: f32) -> bool {
        self.intersect(object, t_max).is_some()
    }
}
