//! Shapes, their acceleration structure, and what a ray finds.
//!
//! A [`GeometryBuilder`] collects shapes, groups of shapes and instances of groups, and builds the
//! [`Geometry`] that rays are traced through. What is behind [`Geometry::intersect`] and
//! [`Geometry::occluded`] is private and may change.
//!
//! No function here knows an ε in units of the scene: rays start beside the surface they leave by a
//! bound on the error of the computed point ([`offset_point`]).

mod aabb;
mod attribute;
mod builder;
mod bvh;
mod cube;
mod curves;
mod cylinder;
mod disk;
mod located;
mod mesh;
mod mesh_arrays;
mod motion;
mod moving;
mod offset;
mod ray;
mod rays;
mod rectangle;
mod root;
mod sample;
mod scene;
mod sdf;
mod seen;
mod shape;
mod sphere;
mod surface;
mod transform;
mod triangle;

#[cfg(test)]
mod tests;

pub use aabb::Aabb;
pub use attribute::{AttributeOwner, MeshAttribute};
pub use builder::{GeometryBuilder, GroupId};
pub use curves::{CurveBasis, CurveError, CurvePoint, Curves};
pub use cylinder::Cylinder;
pub use disk::Disk;
pub use located::Located;
pub use mesh::TriangleMesh;
pub use mesh_arrays::{MeshArrays, MeshError};
pub use motion::{Animation, AnimationError, Motion, Placement, Shutter, ShutterError};
pub use offset::offset_point;
pub use ray::Ray;
pub use rays::{Moment, Rays, Task};
pub use rectangle::Rectangle;
pub use sample::ShapeSample;
pub use scene::{Geometry, GeometryStatistics, Hit};
pub use sdf::{SdfError, SdfGrid, SdfNormals, SdfSamples};
pub use shape::{Shape, ShapeError, ShapeId};
pub use sphere::Sphere;
pub use surface::SurfacePoint;
pub(crate) use transform::is_unit;
pub use transform::{Transform, TransformError};
