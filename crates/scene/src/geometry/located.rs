//! What few ask of a point of a surface.

use super::{Geometry, Shape, SurfacePoint};
use crate::Color;

/// A point of a surface with the geometry that it is part of: what only some materials ask for is found from here.
#[derive(Clone, Copy, Debug)]
pub struct Located<'a> {
    geometry: &'a Geometry,
    point: SurfacePoint,
}

impl<'a> Located<'a> {
    /// A point that [`Geometry::surface_point`] of this geometry has given.
    #[inline]
    pub fn new(geometry: &'a Geometry, point: SurfacePoint) -> Self {
        Self { geometry, point }
    }

    /// The point.
    #[inline]
    pub fn point(&self) -> &SurfacePoint {
        &self.point
    }

    /// An attribute of the mesh at the point; `None` where its shape is no mesh or has none of that name.
    pub fn attribute(&self, name: &str) -> Option<Color> {
        match self.geometry.shapes().get(self.point.shape.0 as usize)? {
            Shape::Mesh(mesh) => mesh.attribute(name, self.point.primitive, self.point.barycentric),
            _ => None,
        }
    }
}
