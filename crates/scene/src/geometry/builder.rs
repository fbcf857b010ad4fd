//! Collecting shapes into a geometry.

use alloc::vec::Vec;
use core::ops::Range;

use super::moving::{Moving, Origin};
use super::{Geometry, Motion, Shape, ShapeId, Transform};

/// A group of shapes that instances refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GroupId(pub(super) u32);

/// Collects shapes, groups and instances.
///
/// # Examples
/// ```
/// use etendue_math::glam::{DVec3, Vec3};
/// use etendue_scene::geometry::{GeometryBuilder, Ray, Shape, Sphere, Transform};
///
/// let mut builder = GeometryBuilder::new();
/// let unit = Shape::Sphere(Sphere::new(DVec3::ZERO, 1.0, &Transform::IDENTITY)?);
/// let (group, shapes) = builder.add_group(vec![unit]);
/// builder.add_instance(group, Transform::translate(DVec3::new(0.0, 0.0, 5.0))?);
/// let geometry = builder.build();
///
/// let ray = Ray::new(Vec3::ZERO, Vec3::Z);
/// let hit = geometry.intersect(&ray).expect("the sphere is straight ahead");
/// assert_eq!((hit.t, hit.shape), (4.0, shapes[0]));
/// let point = geometry.surface_point(&ray, &hit);
/// assert_eq!(point.normal, -Vec3::Z);
/// assert!(!geometry.occluded(&point.spawn(-Vec3::Z)));
/// # Ok::<(), etendue_scene::geometry::ShapeError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct GeometryBuilder {
    /// Every shape, those of groups included.
    pub(super) shapes: Vec<Shape>,
    /// The shapes that are not part of a group.
    pub(super) top_level: Vec<ShapeId>,
    /// The shapes of each group: groups are added whole.
    pub(super) groups: Vec<Range<u32>>,
    pub(super) instances: Vec<(GroupId, Transform)>,
    pub(super) moving: Vec<Moving>,
}

impl GeometryBuilder {
    /// A builder of nothing.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a shape in world space.
    pub fn add_shape(&mut self, shape: Shape) -> ShapeId {
        let id = ShapeId(self.shapes.len() as u32);
        self.shapes.push(shape);
        self.top_level.push(id);
        id
    }

    /// Adds a group of shapes, invisible until instances refer to it; returns the group and the ids
    /// of its shapes in order.
    pub fn add_group(&mut self, shapes: Vec<Shape>) -> (GroupId, Vec<ShapeId>) {
        let start = self.shapes.len() as u32;
        self.shapes.extend(shapes);
        let range = start..self.shapes.len() as u32;
        self.groups.push(range.clone());
        (GroupId(self.groups.len() as u32 - 1), range.map(ShapeId).collect())
    }

    /// Places a group in the world; returns the number that [`Hit::instance`](super::Hit::instance)
    /// gives for it.
    pub fn add_instance(&mut self, group: GroupId, transform: Transform) -> u32 {
        self.instances.push((group, transform));
        self.instances.len() as u32 - 1
    }

    /// Adds a shape, described in the space that moves. As through an instance, fronts stay fronts where a motion
    /// mirrors.
    pub fn add_moving_shape(&mut self, shape: Shape, motion: Motion) -> ShapeId {
        let (group, ids) = self.add_group(alloc::vec![shape]);
        self.moving.push(Moving { group: group.0, motion, origin: Origin::Shape(ids[0]) });
        ids[0]
    }

    /// Places a group in the world that moves. [`Hit::instance`](super::Hit::instance) numbers what moves, shapes
    /// included, after the instances that do not, in the order in which it was added.
    pub fn add_moving_instance(&mut self, group: GroupId, motion: Motion) {
        self.moving.push(Moving { group: group.0, motion, origin: Origin::Instance });
    }

    /// How many shapes and instances move.
    pub fn moving_count(&self) -> usize {
        self.moving.len()
    }

    /// Builds the acceleration structures, on all cores with the feature `std`.
    ///
    /// The result does not depend on the number of threads.
    pub fn build(self) -> Geometry {
        Geometry::build(self)
    }
}
