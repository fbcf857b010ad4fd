//! What few ask of a point of a surface.

use etendue_math::glam::Vec3;

use super::{Geometry, Shape, SurfacePoint};
use crate::Color;

/// A point of a surface with the geometry that it is part of: what only some materials ask for is found from here.
#[derive(Clone, Copy, Debug)]
pub struct Located<'a> {
    geometry: &'a Geometry,
    point: SurfacePoint,
    width: f32,
}

impl<'a> Located<'a> {
    /// A point that [`Geometry::surface_point`] of this geometry has given.
    #[inline]
    pub fn new(geometry: &'a Geometry, point: SurfacePoint) -> Self {
        Self { geometry, point, width: 0.0 }
    }

    /// The same as part of what a sample stands for that is `width` wide, in units of the world.
    #[inline]
    #[must_use]
    pub fn as_wide_as(self, width: f32) -> Self {
        Self { width, ..self }
    }

    /// How far texture coordinates go in that width, along u and along v; 0 where they do not vary.
    pub fn extent(&self) -> [f32; 2] {
        self.partials().map(|partial| {
            let extent = self.width / Vec3::length(partial);
            if extent.is_finite() { extent } else { 0.0 }
        })
    }

    /// The point.
    #[inline]
    pub fn point(&self) -> &SurfacePoint {
        &self.point
    }

    /// How the position changes with the texture coordinates: `∂p/∂u` and `∂p/∂v`, in world space.
    ///
    /// Where a mesh has no texture coordinates, two unit vectors orthogonal to the geometric normal; 0 on a distance field.
    ///
    /// # Source
    /// Mitsuba 3, `compute_surface_interaction` of each shape.
    pub fn partials(&self) -> [Vec3; 2] {
        let SurfacePoint { shape, primitive, uv, instance, time, .. } = self.point;
        let Some(shape) = self.geometry.shapes().get(shape.0 as usize) else {
            return [Vec3::ZERO; 2];
        };
        let local = match shape {
            Shape::Mesh(mesh) => mesh.partials(primitive),
            Shape::Sphere(sphere) => sphere.partials(uv),
            Shape::Rectangle(rectangle) => rectangle.partials(),
            Shape::Disk(disk) => disk.partials(uv),
            Shape::Cylinder(cylinder) => cylinder.partials(uv),
            Shape::Sdf(_) => [Vec3::ZERO; 2],
            Shape::Curves(curves) => curves.partials(primitive, uv),
        };
        match self.geometry.placement(instance, time, &mut None) {
            Some(transform) => local.map(|d| transform.vector(d)),
            None => local,
        }
    }

    /// An attribute of the mesh at the point; `None` where its shape is no mesh or has none of that name.
    pub fn attribute(&self, name: &str) -> Option<Color> {
        match self.geometry.shapes().get(self.point.shape.0 as usize)? {
            Shape::Mesh(mesh) => mesh.attribute(name, self.point.primitive, self.point.barycentric),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Cylinder, Disk, GeometryBuilder, Ray, Rectangle, Sphere, Transform};
    use alloc::vec;
    use etendue_math::glam::DVec3;

    /// Turned by 40° about (0.6, 0, 0.8), after a scaling and before a translation.
    fn placed(scale: DVec3) -> Transform {
        let all = [
            Transform::translate(DVec3::new(1.0, 2.0, 3.0)),
            Transform::rotate(DVec3::new(0.6, 0.0, 0.8), 40.0),
            Transform::scale(scale),
        ];
        let [translate, rotate, scale] = all.map(|t| t.expect("a map"));
        let turned = translate.compose(&rotate).expect("a map");
        turned.compose(&scale).expect("a map")
    }

    #[test]
    fn partials_are_those_of_mitsuba() {
        // si.dp_du and si.dp_dv of mi.load_dict(…).ray_intersect(…), 3.9.1.
        let (twice, uneven) = (placed(DVec3::splat(2.0)), placed(DVec3::new(2.0, 3.0, 0.5)));
        let sphere = Sphere::new(DVec3::ZERO, 0.5, &twice).expect("a sphere");
        let rectangle = Rectangle::new(&uneven).expect("a rectangle");
        let cylinder = Cylinder::new(DVec3::ZERO, DVec3::Z, 0.5, &twice).expect("a cylinder");
        let cases = [
            (
                Shape::Sphere(sphere),
                twice,
                [[0.8, 1.2, 1.6], [0.2, 0.3, 0.4]],
                [[-4.17614, -0.0123703, 0.506897], [-0.134052, 2.96420, -1.03206]],
            ),
            (
                Shape::Rectangle(rectangle),
                uneven,
                [[0.3, -0.4, 3.0], [0.3, -0.4, 0.0]],
                [[3.40107, 2.05692, 0.449195], [-3.08538, 4.59627, 2.31404]],
            ),
            (
                Shape::Disk(Disk::new(&twice)),
                twice,
                [[0.3, -0.4, 3.0], [0.3, -0.4, 0.0]],
                [[1.84309, -0.608595, -0.482318], [2.33531, 5.47272, 2.01843]],
            ),
            (
                Shape::Cylinder(cylinder),
                twice,
                [[1.2, 1.6, 0.7], [0.3, 0.4, 0.7]],
                [[-6.21252, 0.303116, 0.889476], [0.224597, -0.771345, 1.83155]],
            ),
        ];
        for (shape, to_world, segment, expected) in cases {
            let mut builder = GeometryBuilder::new();
            builder.add_shape(shape.clone());
            let (group, _) = builder.add_group(vec![shape]);
            // The same behind an instance, far away and half as large.
            let half = Transform::scale(DVec3::splat(0.5)).expect("a map");
            let away = Transform::translate(DVec3::X * 1000.0).expect("a map");
            builder.add_instance(group, away.compose(&half).expect("a map"));
            let geometry = builder.build();
            let [from, to] = segment.map(|p| to_world.point(Vec3::from(p)));
            let shifted = |p: Vec3| p * 0.5 + Vec3::X * 1000.0;
            for (ray, scale) in [
                (Ray::new(from, to - from), 1.0),
                (Ray::new(shifted(from), shifted(to) - shifted(from)), 0.5),
            ] {
                let hit = geometry.intersect(&ray).expect("it is aimed at");
                let point = geometry.surface_point(&ray, &hit);
                let partials = Located::new(&geometry, point).partials();
                for (found, expected) in partials.into_iter().zip(expected) {
                    let expected = Vec3::from(expected) * scale;
                    // Six digits of Mitsuba's; at 1000 units a position has an error of 6e-5, half a unit from the axis.
                    let error = if scale == 1.0 { 2e-5 } else { 1e-3 };
                    assert!((found - expected).length() < error, "{found} {expected}");
                }
            }
        }
    }
}
