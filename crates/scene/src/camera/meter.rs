//! Instruments that measure light on a surface.

use alloc::vec::Vec;

use etendue_math::glam::Vec3;
use etendue_math::{Frame, Real};
use etendue_sampling::warp::cosine_hemisphere;

use crate::geometry::{Ray, Shape, offset_point};

/// A surface whose mean irradiance is measured: rays leave it from points that are even over its area, in directions
/// proportional to their cosine, so that π times the mean of the radiance along them is the irradiance.
#[derive(Clone, Debug)]
pub(super) struct Meter {
    shape: Shape,
    /// The area up to and with each primitive.
    areas: Vec<f64>,
}

impl Meter {
    /// `None` for a shape without area.
    pub(super) fn new(shape: Shape) -> Option<Self> {
        let mut sum = 0.0;
        let areas = (0..shape.primitive_count()).map(|primitive| {
            sum += f64::from(shape.primitive_area(primitive));
            sum
        });
        let areas: Vec<f64> = areas.collect();
        (sum > 0.0 && sum.is_finite()).then_some(Self { shape, areas })
    }

    /// The surface.
    pub(super) fn shape(&self) -> &Shape {
        &self.shape
    }

    /// The ray for uniforms in `[0, 1)` that stand for a point and a direction; outside of the front of the surface.
    pub(super) fn ray(&self, [u, v]: [f32; 2], direction: [f32; 2]) -> Option<Ray> {
        let total = *self.areas.last()?;
        let at = f64::from(u) * total;
        let primitive = self.areas.partition_point(|&area| area <= at);
        let before = if primitive == 0 { 0.0 } else { self.areas[primitive - 1] };
        let u = ((at - before) / (self.areas.get(primitive)? - before)) as f32;
        let point = self.shape.sample_area(primitive as u32, [u.min(f32::ONE_MINUS_EPSILON), v])?;
        let local: Vec3 = cosine_hemisphere::from_square(direction);
        let direction = Frame::<f32>::from_normal(point.normal).to_world(local);
        let origin = offset_point(point.position, point.error, point.normal, direction);
        Some(Ray::new(origin, direction))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Rectangle, Transform, TriangleMesh};

    #[test]
    fn rays_leave_the_front_of_the_shape() {
        let rectangle = Rectangle::new(&Transform::IDENTITY).expect("a shape");
        let meter = Meter::new(Shape::Rectangle(rectangle)).expect("an area");
        for i in 0..100_u16 {
            let (u, v) = ((f32::from(i) + 0.5) / 100.0, (f32::from(i) * 0.618) % 1.0);
            let ray = meter.ray([u, v], [v, u]).expect("a ray");
            assert!(ray.origin.z >= 0.0 && ray.direction.z >= 0.0, "{ray:?}");
            assert!(ray.origin.x.abs() <= 1.0 && ray.origin.y.abs() <= 1.0, "{ray:?}");
        }
    }

    #[test]
    fn primitives_are_met_in_proportion_to_their_area() {
        // Triangles of area ½ and 2, and one between without any.
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [5.0, 0.0], [7.0, 0.0], [5.0, 2.0]];
        let positions = corners.map(|[x, y]| Vec3::new(x, y, 0.0));
        let triangles = Vec::from([[0, 1, 2], [0, 1, 1], [3, 4, 5]]);
        let mesh = TriangleMesh::new(positions.into(), Vec::new(), Vec::new(), triangles);
        let meter = Meter::new(Shape::Mesh(mesh.expect("a mesh"))).expect("an area");
        let small = (0..1000_u16).filter(|i| {
            let u = (f32::from(*i) + 0.5) / 1000.0;
            meter.ray([u, 0.5], [0.5, 0.5]).expect("a ray").origin.x < 2.0
        });
        assert_eq!(small.count(), 200);
    }

    #[test]
    fn a_shape_without_area_measures_nothing() {
        let corners = Vec::from([Vec3::ZERO, Vec3::X, Vec3::X]);
        let mesh = TriangleMesh::new(corners, Vec::new(), Vec::new(), Vec::from([[0, 1, 2]]));
        assert!(Meter::new(Shape::Mesh(mesh.expect("a mesh"))).is_none());
    }
}
