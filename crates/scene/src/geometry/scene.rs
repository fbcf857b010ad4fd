//! All shapes of a scene behind one interface.

use alloc::vec::Vec;
use core::ops::Range;

use super::bvh::simd::{Backend, Simd};
use super::bvh::{Bvh, Found, Objects, PreparedRay, TriangleRef, Triangles};
use super::moving::{Moving, Origin};
use super::surface::LocalSurface;
use super::{
    Aabb, GeometryBuilder, GroupId, Moment, Ray, Rays, Shape, ShapeId, SurfacePoint, Transform,
};

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
    moving: Vec<Moving>,
    groups: Vec<Level>,
    /// The shapes of each group.
    group_shapes: Vec<Range<u32>>,
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
    /// The triangle within a mesh, the half of a rectangle, the voxel of a distance field, the segment or part of
    /// curves, 0 on other shapes.
    pub primitive: u32,
    /// The instance through which the shape was hit, or `u32::MAX` for none.
    pub instance: u32,
    /// The moment of the hit, in shares of the exposure.
    pub time: f32,
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

/// A group that stands still.
#[derive(Clone, Debug)]
struct Instance {
    group: u32,
    transform: Transform,
}

/// A quadric, or a part of a shape that has several such objects.
#[derive(Clone, Copy, Debug)]
struct Object {
    shape: u32,
    number: u32,
}

/// One hierarchy: the world, or a group.
#[derive(Clone, Debug)]
pub(super) struct Level {
    /// Its objects are those of shapes, followed by the instances of the world and by what moves in it.
    pub(super) bvh: Bvh,
    objects: Vec<Object>,
    triangles: usize,
    degenerate_triangles: usize,
}

/// The triangles of some shapes, numbered through.
struct LevelTriangles<'a> {
    shapes: &'a [Shape],
    /// Shapes with triangles, and the numbers of their first ones.
    starts: Vec<(u32, u32)>,
    count: u32,
}

impl Triangles for LevelTriangles<'_> {
    fn count(&self) -> u32 {
        self.count
    }

    fn get(&self, number: u32) -> Option<TriangleRef> {
        let after = self.starts.partition_point(|&(_, start)| start <= number);
        let (shape, start) = *self.starts.get(after.checked_sub(1)?)?;
        let primitive = number - start;
        let facet = self.shapes[shape as usize].triangle(primitive)?;
        facet.has_area().then_some(TriangleRef { corners: facet.corners, shape, primitive })
    }
}

impl Level {
    /// `instances`: the boxes of the instances.
    fn build(shapes: &[Shape], ids: impl Iterator<Item = u32>, instances: &[Aabb]) -> Self {
        let mut triangles = LevelTriangles { shapes, starts: Vec::new(), count: 0 };
        let (mut objects, mut boxes) = (Vec::new(), Vec::new());
        for id in ids {
            let shape = &shapes[id as usize];
            if shape.triangle_count() > 0 {
                triangles.starts.push((id, triangles.count));
                triangles.count += shape.triangle_count();
            }
            for number in 0..shape.object_count() {
                objects.push(Object { shape: id, number });
                boxes.push(shape.object_bounds(number));
            }
        }
        boxes.extend_from_slice(instances);
        let bvh = Bvh::build(&triangles, &boxes);
        let degenerate_triangles = bvh.left_out();
        let triangles = triangles.count as usize - degenerate_triangles;
        Self { bvh, objects, triangles, degenerate_triangles }
    }
}

impl Geometry {
    pub(super) fn build(builder: GeometryBuilder) -> Self {
        let GeometryBuilder { shapes, top_level, groups, instances, moving } = builder;
        let group_shapes = groups;
        let groups = (group_shapes.iter())
            .map(|&Range { start, end }| Level::build(&shapes, start..end, &[]))
            .collect();
        let instances = instances
            .into_iter()
            .map(|(group, transform)| Instance { group: group.0, transform })
            .collect();
        let top = Level::build(&shapes, core::iter::empty(), &[]);
        let backend = Backend::detect();
        Self { shapes, top_level, instances, moving, groups, group_shapes, top, backend }.with_top()
    }

    /// The same with the hierarchy of the world built anew.
    fn with_top(self) -> Self {
        // A group of another builder may not exist here: such an instance shows nothing.
        let group = |number: u32| self.groups.get(number as usize).map(|level| level.bvh.bounds());
        let still = self.instances.iter().map(|Instance { group: number, transform }| {
            group(*number).map_or(Aabb::EMPTY, |bounds| transform.aabb(&bounds))
        });
        let moving = self.moving.iter().map(|Moving { group: number, motion, .. }| {
            group(*number).map_or(Aabb::EMPTY, |bounds| motion.bounds(&bounds))
        });
        let boxes: Vec<Aabb> = still.chain(moving).collect();
        let top = Level::build(&self.shapes, self.top_level.iter().map(|id| id.0), &boxes);
        Self { top, ..self }
    }

    /// The same without its instances, those that move included; the shapes of groups keep their numbers, and no ray
    /// meets them.
    pub(crate) fn without_instances(mut self) -> Self {
        self.instances.clear();
        self.moving.retain(|moving| moving.origin != Origin::Instance);
        self.with_top()
    }

    /// The same at the opening of the shutter: nothing moves.
    pub(crate) fn without_motion(mut self) -> Self {
        for Moving { group, motion, origin } in core::mem::take(&mut self.moving) {
            let transform = *motion.opening();
            let placed = match origin {
                // Mirroring turns some shapes inside out, but no instance.
                Origin::Shape(id) if !transform.is_mirrored() => {
                    let shape = self.shapes[id.0 as usize].clone();
                    shape.transformed(&transform).ok().map(|shape| (id, shape))
                }
                Origin::Shape(_) | Origin::Instance => None,
            };
            match placed {
                Some((id, shape)) => {
                    self.shapes[id.0 as usize] = shape;
                    self.top_level.push(id);
                }
                // A shape of which the motion makes what is no shape of its kind, an ellipsoid, stays an instance.
                None => self.instances.push(Instance { group, transform }),
            }
        }
        self.top_level.sort_unstable();
        self.with_top()
    }

    /// The geometry at a moment: a share of the exposure, 0 where the shutter opens, 1 where it closes.
    #[inline]
    pub fn at(&self, time: f32) -> Moment<'_> {
        Moment::new(self, time)
    }

    /// The closest hit at `0 < t < t_max`, where the shutter opens.
    #[inline]
    pub fn intersect(&self, ray: &Ray) -> Option<Hit> {
        self.at(0.0).intersect(ray)
    }

    /// Whether anything is hit at `0 < t < t_max`, where the shutter opens.
    #[inline]
    pub fn occluded(&self, ray: &Ray) -> bool {
        self.at(0.0).occluded(ray)
    }

    #[inline(always)]
    pub(super) fn intersect_with<S: Simd>(&self, simd: S, ray: &Ray, time: f32) -> Option<Hit> {
        if !ray.is_valid() {
            return None;
        }
        let mut found = Found::nothing_before(ray.t_max);
        // A copy field by field: objects are asked by calls, and a reference, or a copy that the
        // compiler sees through, would keep the caller's ray in memory.
        let objects = World { geometry: self, ray: &Ray { ..*ray }, time };
        self.top.bvh.closest(simd, &PreparedRay::new(simd, ray), &objects, &mut found);
        (found.shape != u32::MAX).then_some(Hit {
            t: found.t,
            uv: found.uv,
            shape: ShapeId(found.shape),
            primitive: found.primitive,
            instance: found.instance,
            time,
        })
    }

    #[inline(always)]
    pub(super) fn occluded_with<S: Simd>(&self, simd: S, ray: &Ray, time: f32) -> bool {
        let objects = World { geometry: self, ray: &Ray { ..*ray }, time };
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
        match (shape, hit.instance) {
            (Shape::Mesh(mesh), u32::MAX) => mesh.surface(hit.primitive, hit.uv).of(hit),
            (Shape::Rectangle(rectangle), u32::MAX) => {
                rectangle.surface(hit.primitive, hit.uv).of(hit)
            }
            // Only now made a point, so that those above need not be where this one is returned.
            (shape, _) => self.local_surface(shape, Ray { ..*ray }, Hit { ..*hit }).of(hit),
        }
    }

    /// The point of any shape, in a group or not. Out of line, so that meshes do not pay for it.
    #[inline(never)]
    fn local_surface(&self, shape: &Shape, ray: Ray, hit: Hit) -> LocalSurface {
        match self.placement(hit.instance, hit.time, &mut None) {
            None => shape.surface(&ray, &hit),
            Some(transform) => {
                shape.surface(&transform.inverse_ray(&ray), &hit).transformed(transform)
            }
        }
    }

    /// Every shape, those of groups included, in the order in which they were added.
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    /// The shapes that stand in the world by themselves.
    pub fn top_level(&self) -> &[ShapeId] {
        &self.top_level
    }

    /// The shapes of a group, which follow each other; none of a group of another geometry.
    pub fn group(&self, group: GroupId) -> impl ExactSizeIterator<Item = ShapeId> + use<> {
        let shapes = self.group_shapes.get(group.0 as usize);
        shapes.cloned().unwrap_or_default().map(ShapeId)
    }

    /// The instances that stand still: which group, and where it is put.
    pub fn instances(&self) -> impl Iterator<Item = (GroupId, &Transform)> {
        self.instances.iter().map(|instance| (GroupId(instance.group), &instance.transform))
    }

    /// Where an instance puts its group at a moment; `None` where there is no such instance.
    ///
    /// * `moved`: where the placement is put if it had to be made for this moment.
    #[inline(always)]
    pub(super) fn placement<'a>(
        &'a self,
        instance: u32,
        time: f32,
        moved: &'a mut Option<Transform>,
    ) -> Option<&'a Transform> {
        match self.instances.get(instance as usize) {
            Some(instance) => Some(&instance.transform),
            None => {
                *moved = self.moved(instance, time);
                moved.as_ref()
            }
        }
    }

    /// The same of what moves. Out of line, since most scenes stand still.
    #[inline(never)]
    fn moved(&self, instance: u32, time: f32) -> Option<Transform> {
        self.moving(instance).map(|moving| moving.motion.at(time))
    }

    /// What moves has the numbers after the instances that do not.
    fn moving(&self, instance: u32) -> Option<&Moving> {
        self.moving.get((instance as usize).wrapping_sub(self.instances.len()))
    }

    /// How many instances of groups there are, those that move included.
    pub fn instance_count(&self) -> usize {
        let moving = self.moving.iter().filter(|moving| moving.origin == Origin::Instance);
        self.instances.len() + moving.count()
    }

    /// Whether a shape moves by itself.
    pub(crate) fn is_moving(&self, shape: ShapeId) -> bool {
        self.moving.iter().any(|moving| moving.origin == Origin::Shape(shape))
    }

    /// How many shapes and instances move while the shutter is open.
    pub fn moving_count(&self) -> usize {
        self.moving.len()
    }

    /// A box that holds everything; empty for an empty scene.
    pub fn bounds(&self) -> Aabb {
        self.top.bvh.bounds()
    }

    /// Boxes that hold the world and each group, in its own space.
    pub(crate) fn level_bounds(&self) -> impl Iterator<Item = Aabb> {
        self.groups.iter().chain([&self.top]).map(|level| level.bvh.bounds())
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

/// The objects of the world: those of shapes, and instances.
struct World<'a> {
    geometry: &'a Geometry,
    ray: &'a Ray,
    time: f32,
}

/// The objects of a group: those of shapes only, so that instances do not nest.
struct Group<'a> {
    shapes: &'a [Shape],
    objects: &'a [Object],
    ray: &'a Ray,
}

impl<'a> World<'a> {
    fn shapes(&self) -> Group<'a> {
        let Geometry { shapes, top, .. } = self.geometry;
        Group { shapes, objects: &top.objects, ray: self.ray }
    }

    /// The number of an object that is no shape's.
    #[inline(always)]
    fn instance(&self, object: u32) -> Option<u32> {
        object.checked_sub(self.geometry.top.objects.len() as u32)
    }

    /// The group of an instance, and the ray in its space.
    #[inline(always)]
    fn enter(&self, instance: u32) -> Option<(&'a Level, Ray)> {
        let (group, ray) = match self.geometry.instances.get(instance as usize) {
            Some(Instance { group, transform }) => (*group, transform.inverse_ray(self.ray)),
            None => self.enter_moving(instance)?,
        };
        let group = self.geometry.groups.get(group as usize)?;
        ray.is_valid().then_some((group, ray))
    }

    /// The same of what moves; out of line, since most scenes stand still.
    #[inline(never)]
    fn enter_moving(&self, instance: u32) -> Option<(u32, Ray)> {
        let Moving { group, motion, .. } = self.geometry.moving(instance)?;
        Some((*group, motion.at(self.time).inverse_ray(self.ray)))
    }
}

impl Objects for World<'_> {
    #[inline(always)]
    fn closest<S: Simd>(&self, simd: S, object: u32, found: &mut Found) {
        let Some(number) = self.instance(object) else {
            return self.shapes().closest(simd, object, found);
        };
        let Some((group, ray)) = self.enter(number) else { return };
        let objects = Group { shapes: &self.geometry.shapes, objects: &group.objects, ray: &ray };
        let before = found.t;
        group.bvh.closest(simd, &PreparedRay::new(simd, &ray), &objects, found);
        if found.t < before {
            found.instance = number;
        }
    }

    #[inline(always)]
    fn occluded<S: Simd>(&self, simd: S, object: u32, t_max: f32) -> bool {
        let Some(number) = self.instance(object) else {
            return self.shapes().occluded(simd, object, t_max);
        };
        let Some((group, ray)) = self.enter(number) else { return false };
        let objects = Group { shapes: &self.geometry.shapes, objects: &group.objects, ray: &ray };
        group.bvh.occluded(simd, &PreparedRay::new(simd, &ray), &objects, t_max)
    }
}

impl Group<'_> {
    /// Never inlined: `f64` arithmetic in the middle of the loop over boxes would only cost registers.
    #[inline(never)]
    fn intersect(&self, object: u32, t_max: f32) -> Option<(Object, f32)> {
        let object = *self.objects.get(object as usize)?;
        let ray = Ray { t_max, ..*self.ray };
        let t = self.shapes[object.shape as usize].intersect_object(object.number, &ray)?;
        Some((object, t))
    }
}

impl Objects for Group<'_> {
    #[inline(always)]
    fn closest<S: Simd>(&self, _: S, object: u32, found: &mut Found) {
        if let Some((Object { shape, number }, t)) = self.intersect(object, found.t) {
            *found = Found { t, shape, primitive: number, ..Found::nothing_before(t) };
        }
    }

    #[inline(always)]
    fn occluded<S: Simd>(&self, _: S, object: u32, t_max: f32) -> bool {
        self.intersect(object, t_max).is_some()
    }
}
