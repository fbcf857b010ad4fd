//! Drawing points of a shape for a point that it illuminates.

use etendue_math::Vector3;
use etendue_math::glam::{DVec3, Vec3};
use etendue_sampling::warp;
use etendue_sampling::warp::rectangle::Rectangle as Corner;
use etendue_sampling::warp::seen_sphere::SeenSphere;
use etendue_sampling::warp::spherical_rectangle::SphericalRectangle;
use etendue_sampling::warp::spherical_triangle::SphericalTriangle;

use super::sample::solid_angle_density;
use super::{Shape, ShapeSample, SurfacePoint, TriangleMesh};

/// A primitive as a reference point sees it from near by: which map draws points on it.
enum Seen {
    Sphere(SeenSphere<f64>),
    Triangle(SphericalTriangle<f32>),
    Rectangle(SphericalRectangle<f32>),
    /// Uniform in area: where a solid angle is too close to 2π or to 0 to be computed well.
    Area {
        pdf: f32,
    },
}

impl Seen {
    /// Density with respect to solid angle of drawing a point.
    fn density(&self, reference: Vec3, position: Vec3, normal: Vec3) -> f32 {
        let finite = |pdf: f32| if pdf.is_finite() { pdf } else { 0.0 };
        match self {
            Self::Sphere(sphere) => {
                let w = position.as_dvec3() - reference.as_dvec3();
                Vector3::try_normalize(w).map_or(0.0, |w| finite(sphere.pdf(w) as f32))
            }
            Self::Triangle(triangle) => finite(1.0 / triangle.solid_angle()),
            Self::Rectangle(rectangle) => finite(1.0 / rectangle.solid_angle()),
            Self::Area { pdf } => solid_angle_density(*pdf, reference, position, normal),
        }
    }
}

impl TriangleMesh {
    /// Whether a triangle is so small for its distance that its area is sampled; false for one that
    /// does not exist.
    #[inline(always)]
    fn looks_small(&self, triangle: u32, reference: Vec3) -> bool {
        let Some(facet) = self.facets().get(triangle as usize) else { return false };
        let [a, b, c] = facet.corners;
        looks_small(facet.longest_squared, &[a - reference, b - reference, c - reference])
    }

    /// [`Shape::sample_from`] for a triangle that looks small.
    #[inline(always)]
    fn sample_area_from(
        &self,
        triangle: u32,
        reference: Vec3,
        u: [f32; 2],
    ) -> Option<(ShapeSample, f32)> {
        let [_, b1, b2] = warp::triangle::from_square(u);
        let sample = self.at(triangle, [b1, b2]);
        let pdf = solid_angle_density(sample.pdf_area, reference, sample.position, sample.normal);
        (pdf > 0.0).then_some((sample, pdf))
    }
}

impl Shape {
    /// Whether points of a primitive are drawn uniformly in area, without a look at its solid angle.
    #[inline(always)]
    fn is_sampled_by_area(&self, primitive: u32, reference: Vec3) -> bool {
        match self {
            // Points on the wall see the inside whether rounding has put them inside or outside.
            Self::Sphere(sphere) => sphere.faces_inward(),
            Self::Mesh(mesh) => mesh.looks_small(primitive, reference),
            Self::Rectangle(rectangle) => {
                let [a, b, c, d] = *rectangle.corners();
                let longest = (b - a).length_squared().max((d - a).length_squared());
                looks_small(longest, &[a - reference, b - reference, c - reference, d - reference])
            }
            Self::Disk(_) | Self::Cylinder(_) | Self::Sdf(_) | Self::Curves(_) => true,
        }
    }

    /// The map that draws points of a primitive that is not sampled by area; `None` where it has no
    /// solid angle at all.
    fn seen(&self, primitive: u32, reference: Vec3) -> Option<Seen> {
        let by_angle = match self {
            Self::Sphere(sphere) => {
                return SeenSphere::new(
                    sphere.exact_center() - reference.as_dvec3(),
                    sphere.exact_radius(),
                )
                .map(Seen::Sphere);
            }
            Self::Mesh(mesh) => {
                SphericalTriangle::new(mesh.corners(primitive).map(|corner| corner - reference))
                    .map(Seen::Triangle)
            }
            Self::Rectangle(rectangle) => {
                let [corner, right, _, top] = *rectangle.corners();
                let edges = [right - corner, top - corner];
                SphericalRectangle::new(Corner { corner: corner - reference, edges })
                    .map(Seen::Rectangle)
            }
            Self::Disk(_) | Self::Cylinder(_) | Self::Sdf(_) | Self::Curves(_) => None,
        };
        Some(by_angle.unwrap_or(Seen::Area { pdf: 1.0 / self.primitive_area(primitive) }))
    }

    /// A point of a primitive drawn for a reference point that it illuminates, and its density with
    /// respect to solid angle there; `None` where nothing can be drawn.
    ///
    /// Uniform in solid angle on spheres, and on triangles and rectangles that are not small for their
    /// distance; uniform in area on all others, inside spheres and on those that face inwards, and
    /// where a solid angle is too close to 2π to be computed well. The sample may face away from the
    /// reference point.
    ///
    /// # Examples
    /// ```
    /// use etendue_math::glam::Vec3;
    /// use etendue_scene::geometry::{Rectangle, Shape, Transform};
    /// let lamp = Shape::Rectangle(Rectangle::new(&Transform::IDENTITY)?);
    /// // One unit above the middle of a 2 × 2 square: a face of a cube, a sixth of 4π.
    /// let (sample, pdf) = lamp.sample_from(0, Vec3::Z, [0.5, 0.5]).expect("it is seen");
    /// assert!(sample.position.length() < 1e-6);
    /// assert!((1.0 / pdf - 4.0 * std::f32::consts::PI / 6.0).abs() < 1e-5);
    /// # Ok::<(), etendue_scene::geometry::ShapeError>(())
    /// ```
    #[inline(always)]
    pub fn sample_from(
        &self,
        primitive: u32,
        reference: Vec3,
        u: [f32; 2],
    ) -> Option<(ShapeSample, f32)> {
        // Taken apart by `?` and put together again: what is returned here is not where the longer
        // way returns it, and need not be in memory.
        Some(match self {
            Self::Mesh(mesh) if mesh.looks_small(primitive, reference) => {
                mesh.sample_area_from(primitive, reference, u)?
            }
            _ => self.sample_any_from(primitive, reference, u)?,
        })
    }

    /// The same without a short way for small triangles, out of line: most lights are small triangles
    /// from most places.
    #[inline(never)]
    fn sample_any_from(
        &self,
        primitive: u32,
        reference: Vec3,
        u: [f32; 2],
    ) -> Option<(ShapeSample, f32)> {
        let area = self.primitive_area(primitive);
        if area == 0.0 {
            return None;
        }
        if !self.is_sampled_by_area(primitive, reference) {
            return self.sample_seen(primitive, reference, u);
        }
        let sample = self.sample_area(primitive, u)?;
        let pdf = solid_angle_density(1.0 / area, reference, sample.position, sample.normal);
        (pdf > 0.0).then_some((sample, pdf))
    }

    /// The same for a primitive that is not sampled by area.
    fn sample_seen(
        &self,
        primitive: u32,
        reference: Vec3,
        u: [f32; 2],
    ) -> Option<(ShapeSample, f32)> {
        let seen = self.seen(primitive, reference)?;
        let sample = match (self, &seen) {
            (Self::Sphere(shape), Seen::Sphere(seen)) => {
                shape.sample_at(seen.from_square(u.map(f64::from))?.normal)
            }
            (Self::Mesh(mesh), Seen::Triangle(seen)) => {
                let [a, b, c] = mesh.corners(primitive);
                let [b1, b2] =
                    plane_coordinates(a, [b - a, c - a], reference, seen.from_square(u))?;
                mesh.at(primitive, [b1, b2.min(1.0 - b1)])
            }
            (Self::Rectangle(shape), Seen::Rectangle(seen)) => {
                let [a, b, _, d] = *shape.corners();
                shape.at(plane_coordinates(a, [b - a, d - a], reference, seen.from_square(u))?)
            }
            _ => self.sample_area(primitive, u)?,
        };
        let pdf = seen.density(reference, sample.position, sample.normal);
        (pdf > 0.0).then_some((sample, pdf))
    }

    /// The density, with respect to solid angle at `reference`, with which
    /// [`sample_from`](Self::sample_from) draws a point of this shape on its primitive
    /// `point.primitive`; 0 for a primitive that it draws no points on.
    pub fn pdf_from(&self, reference: Vec3, point: &SurfacePoint) -> f32 {
        let SurfacePoint { primitive, position, normal, .. } = *point;
        let area = self.primitive_area(primitive);
        if area == 0.0 {
            return 0.0;
        }
        if self.is_sampled_by_area(primitive, reference) {
            return solid_angle_density(1.0 / area, reference, position, normal);
        }
        self.seen(primitive, reference)
            .map_or(0.0, |seen| seen.density(reference, position, normal))
    }
}

/// Whether a polygon is so small for its distance that sampling its area is nearly as good as
/// sampling its solid angle, and several times faster: no side is longer than the distance of the
/// nearest corner, so that `1/d²` varies by less than a factor of 4 over it.
///
/// In the Cornell box, where a third of all light samples lie between one and two sides away, the
/// relative squared error is one or two percent larger than with twice the distance, and the time a
/// tenth less.
#[inline(always)]
fn looks_small<const N: usize>(longest_squared: f32, corners: &[Vec3; N]) -> bool {
    // Written so that NaN is not small.
    corners.iter().all(|c| longest_squared < c.length_squared())
}

/// Where a line meets a plane, in coordinates along the plane's edges limited to `[0, 1]`; `None`
/// for a line in the plane.
///
/// # Source
/// Möller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997, in `f64`.
fn plane_coordinates(
    corner: Vec3,
    edges: [Vec3; 2],
    origin: Vec3,
    direction: Vec3,
) -> Option<[f32; 2]> {
    let [e1, e2] = edges.map(Vec3::as_dvec3);
    let (s, w): (DVec3, DVec3) = (origin.as_dvec3() - corner.as_dvec3(), direction.as_dvec3());
    let p = w.cross(e2);
    let determinant = e1.dot(p);
    let coordinates = [s.dot(p), w.dot(s.cross(e1))].map(|x| (x / determinant) as f32);
    // 0/0 is NaN, for which no point can be given.
    let valid = coordinates.iter().all(|x| x.is_finite());
    valid.then(|| coordinates.map(|x| x.clamp(0.0, 1.0)))
}
