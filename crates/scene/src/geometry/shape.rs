//! The shapes a scene is made of.

use alloc::boxed::Box;

use etendue_math::glam::Vec3;
use etendue_sampling::warp;

use super::surface::LocalSurface;
use super::{
    Aabb, CurveError, Curves, Cylinder, Disk, Hit, MeshError, Ray, Rectangle, SdfGrid, ShapeSample,
    Sphere, Transform, TransformError, TriangleMesh, triangle,
};

/// A shape of a scene, by its place in the scene's list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ShapeId(pub u32);

/// A surface. Parameterisations and normals are those of Mitsuba 3.
///
/// Points are drawn primitive by primitive: the triangles of a mesh, or the one surface of the
/// other shapes. A primitive that does not exist has area 0 and is never hit. On distance fields
/// and curves no points are drawn: they have no primitives and area 0, but are hit.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Triangles.
    Mesh(TriangleMesh),
    /// A sphere.
    Sphere(Sphere),
    /// A rectangle or parallelogram.
    Rectangle(Rectangle),
    /// A disk or ellipse.
    Disk(Disk),
    /// A cylinder without caps.
    Cylinder(Cylinder),
    /// The surface of a distance field.
    Sdf(Box<SdfGrid>),
    /// Curves with thickness.
    Curves(Box<Curves>),
}

/// Why a shape is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ShapeError {
    /// The radius is not a positive finite number.
    #[error("the radius is not a positive number")]
    BadRadius,
    /// The end points of a cylinder coincide.
    #[error("the end points of the cylinder coincide")]
    NoAxis,
    /// The transform would change the kind of shape: an ellipsoid, an oblique cylinder.
    #[error("the transform scales this shape unequally or shears it")]
    NonUniformScale,
    /// A distance field is positive everywhere, or negative.
    #[error("the values have one sign: there is no surface between them")]
    NoSurface,
    /// The control points of curves are refused.
    #[error(transparent)]
    Curves(#[from] CurveError),
    /// A coordinate leaves the range of `f32`.
    #[error("the transformed shape is out of range")]
    OutOfRange,
    /// The transform itself is refused.
    #[error(transparent)]
    Transform(#[from] TransformError),
    /// The mesh is refused.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

impl Shape {
    /// A box that holds the shape.
    pub fn bounds(&self) -> Aabb {
        match self {
            Self::Mesh(s) => s.bounds(),
            Self::Sphere(s) => s.bounds(),
            Self::Rectangle(s) => s.bounds(),
            Self::Disk(s) => s.bounds(),
            Self::Cylinder(s) => s.bounds(),
            Self::Sdf(s) => s.bounds(),
            Self::Curves(s) => s.bounds(),
        }
    }

    /// The same shape with front and back exchanged.
    pub fn flipped(self) -> Self {
        match self {
            Self::Mesh(s) => Self::Mesh(s.flipped()),
            Self::Sphere(s) => Self::Sphere(s.flipped()),
            Self::Rectangle(s) => Self::Rectangle(s.flipped()),
            Self::Disk(s) => Self::Disk(s.flipped()),
            Self::Cylinder(s) => Self::Cylinder(s.flipped()),
            Self::Sdf(s) => Self::Sdf(Box::new(s.flipped())),
            Self::Curves(s) => Self::Curves(Box::new(s.flipped())),
        }
    }

    /// The shape moved by a transform.
    ///
    /// # Errors
    /// A transform that would make it another kind of shape, a coordinate that leaves the range of `f32`.
    pub(crate) fn transformed(self, transform: &Transform) -> Result<Self, ShapeError> {
        Ok(match self {
            Self::Mesh(s) => Self::Mesh(s.transformed(transform)?),
            Self::Sphere(s) => Self::Sphere(s.transformed(transform)?),
            Self::Rectangle(s) => Self::Rectangle(s.transformed(transform)?),
            Self::Disk(s) => Self::Disk(s.transformed(transform)?),
            Self::Cylinder(s) => Self::Cylinder(s.transformed(transform)?),
            Self::Sdf(s) => Self::Sdf(Box::new(s.transformed(transform)?)),
            Self::Curves(s) => Self::Curves(Box::new(s.transformed(transform)?)),
        })
    }

    /// How many primitives points can be drawn on: the triangles of a mesh, none of distance fields and
    /// curves, 1 otherwise.
    #[inline(always)]
    pub fn primitive_count(&self) -> u32 {
        match self {
            Self::Mesh(mesh) => mesh.triangles().len() as u32,
            Self::Sdf(_) | Self::Curves(_) => 0,
            _ => 1,
        }
    }

    /// The area of a primitive; 0 for one that does not exist.
    #[inline(always)]
    pub fn primitive_area(&self, primitive: u32) -> f32 {
        if primitive >= self.primitive_count() {
            return 0.0;
        }
        match self {
            Self::Mesh(mesh) => mesh.facet(primitive).area,
            Self::Sphere(s) => s.area(),
            Self::Rectangle(s) => s.area(),
            Self::Disk(s) => s.area(),
            Self::Cylinder(s) => s.area(),
            Self::Sdf(_) | Self::Curves(_) => 0.0,
        }
    }

    /// The point of a rectangle or disk from which its normal leads to `above`; `None` where that is outside or behind, and
    /// of other shapes.
    pub(crate) fn foot(&self, above: Vec3) -> Option<ShapeSample> {
        match self {
            Self::Rectangle(s) => s.foot(above),
            Self::Disk(s) => s.foot(above),
            Self::Mesh(_)
            | Self::Sphere(_)
            | Self::Cylinder(_)
            | Self::Sdf(_)
            | Self::Curves(_) => None,
        }
    }

    /// The area of all primitives, summed in `f64`.
    pub fn area_total(&self) -> f32 {
        (0..self.primitive_count()).map(|i| f64::from(self.primitive_area(i))).sum::<f64>() as f32
    }

    /// A point uniform over the area of a primitive, from two uniforms in `[0, 1)`; `None` for a
    /// primitive that does not exist or has no area.
    #[inline(always)]
    pub fn sample_area(&self, primitive: u32, u: [f32; 2]) -> Option<ShapeSample> {
        if self.primitive_area(primitive) == 0.0 {
            return None;
        }
        Some(match self {
            Self::Mesh(mesh) => {
                let [_, b1, b2] = warp::triangle::from_square(u);
                mesh.at(primitive, [b1, b2])
            }
            Self::Sphere(s) => s.sample_area(u),
            Self::Rectangle(s) => s.at(u),
            Self::Disk(s) => s.sample_area(u),
            Self::Cylinder(s) => s.sample_area(u),
            Self::Sdf(_) | Self::Curves(_) => return None,
        })
    }

    /// The objects that a hierarchy numbers, as in [`Hit::primitive`]: the voxels of a distance field, the
    /// segments and parts of curves, a quadric as a whole, none where there are triangles instead.
    pub(crate) fn object_count(&self) -> u32 {
        match self {
            Self::Mesh(_) | Self::Rectangle(_) => 0,
            Self::Sphere(_) | Self::Disk(_) | Self::Cylinder(_) => 1,
            Self::Sdf(s) => s.voxel_count(),
            Self::Curves(s) => s.object_count(),
        }
    }

    /// A box that holds one of these objects.
    pub(crate) fn object_bounds(&self, object: u32) -> Aabb {
        match self {
            Self::Sdf(s) => s.voxel_bounds(object),
            Self::Curves(s) => s.object_bounds(object),
            _ => self.bounds(),
        }
    }

    /// Where a ray meets one of these objects.
    pub(crate) fn intersect_object(&self, object: u32, ray: &Ray) -> Option<f32> {
        match self {
            Self::Sphere(s) => s.intersect(ray),
            Self::Disk(s) => s.intersect(ray),
            Self::Cylinder(s) => s.intersect(ray),
            Self::Sdf(s) => s.intersect(object, ray),
            Self::Curves(s) => s.intersect(object, ray),
            Self::Mesh(_) | Self::Rectangle(_) => None,
        }
    }

    /// The triangles that rays are tested against, numbered as in [`Hit::primitive`].
    pub(crate) fn triangle_count(&self) -> u32 {
        match self {
            Self::Mesh(mesh) => mesh.triangles().len() as u32,
            Self::Rectangle(_) => 2,
            _ => 0,
        }
    }

    /// One of these triangles.
    pub(crate) fn triangle(&self, index: u32) -> Option<&triangle::Facet> {
        match self {
            Self::Mesh(mesh) => mesh.facets().get(index as usize),
            Self::Rectangle(s) => Some(s.half(index)),
            _ => None,
        }
    }

    /// The point that a ray in the shape's own space has hit.
    pub(crate) fn surface(&self, ray: &Ray, hit: &Hit) -> LocalSurface {
        match self {
            Self::Mesh(s) => s.surface(hit.primitive, hit.uv),
            Self::Rectangle(s) => s.surface(hit.primitive, hit.uv),
            Self::Sphere(s) => s.surface(ray, hit.t),
            Self::Disk(s) => s.surface(ray),
            Self::Cylinder(s) => s.surface(ray, hit.t),
            Self::Sdf(s) => s.surface(hit.primitive, ray, hit.t),
            Self::Curves(s) => s.surface(hit.primitive, ray, hit.t),
        }
    }
}
