//! Rectangles.

use etendue_math::glam::{DAffine3, Vec3};

use super::surface::LocalSurface;
use super::triangle::{Corners, Facet};
use super::{Aabb, ShapeError, ShapeSample, Transform};

/// The square `[−1, 1]²` in the plane z = 0, placed by a transform; a parallelogram where that
/// shears. The front is on the side of +z, texture coordinates run over `[0, 1]²`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Corners at (u, v) = (0, 0), (1, 0), (1, 1), (0, 1).
    corners: [Vec3; 4],
    normal: Vec3,
    /// The two triangles that rays are tested against.
    halves: [Facet; 2],
    /// From the square.
    to_world: DAffine3,
    is_flipped: bool,
}

impl Rectangle {
    /// The square placed by a transform.
    ///
    /// # Errors
    /// A corner beyond the range of `f32`.
    pub fn new(transform: &Transform) -> Result<Self, ShapeError> {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[x, y]| transform.point(Vec3::new(x, y, 0.0)));
        Self::of_corners(corners, transform.normal(Vec3::Z), *transform.affine())
    }

    fn of_corners(
        corners: [Vec3; 4],
        normal: Vec3,
        to_world: DAffine3,
    ) -> Result<Self, ShapeError> {
        if corners.iter().any(|c| !c.is_finite()) {
            return Err(ShapeError::OutOfRange);
        }
        let halves = [0, 1].map(|half| Facet::of(half_of(&corners, half)));
        Ok(Self { corners, normal, halves, to_world, is_flipped: false })
    }

    /// The rectangle moved by a transform.
    pub(super) fn transformed(self, transform: &Transform) -> Result<Self, ShapeError> {
        let corners = self.corners.map(|corner| transform.point(corner));
        let to_world = *transform.affine() * self.to_world;
        let moved = Self::of_corners(corners, transform.normal(self.normal), to_world)?;
        Ok(Self { is_flipped: self.is_flipped, ..moved })
    }

    /// The same rectangle with front and back exchanged.
    pub fn flipped(self) -> Self {
        Self { normal: -self.normal, is_flipped: !self.is_flipped, ..self }
    }

    /// What places the square, and whether front and back are exchanged.
    pub fn placement(&self) -> (&DAffine3, bool) {
        (&self.to_world, self.is_flipped)
    }

    /// The corners at (u, v) = (0, 0), (1, 0), (1, 1), (0, 1).
    pub fn corners(&self) -> &[Vec3; 4] {
        &self.corners
    }

    /// The area.
    pub fn area(&self) -> f32 {
        self.halves[0].area + self.halves[1].area
    }

    /// One of the two triangles that rays are tested against.
    pub(crate) fn half(&self, half: u32) -> &Facet {
        &self.halves[usize::from(half != 0)]
    }

    pub(crate) fn bounds(&self) -> Aabb {
        Aabb::from_points(self.corners)
    }

    /// `∂p/∂u` and `∂p/∂v`, the sides.
    pub(crate) fn partials(&self) -> [Vec3; 2] {
        let [corner, right, _, top] = self.corners;
        [right - corner, top - corner]
    }

    #[inline(always)]
    pub(crate) fn surface(&self, half: u32, [b1, b2]: [f32; 2]) -> LocalSurface {
        let (position, error) = self.half(half).point([b1, b2]);
        let [uv0, uv1, uv2] = match half {
            0 => [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]],
            _ => [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        };
        let b0 = 1.0 - b1 - b2;
        LocalSurface {
            position,
            error,
            normal: self.normal,
            shading_normal: self.normal,
            uv: core::array::from_fn(|i| b0 * uv0[i] + b1 * uv1[i] + b2 * uv2[i]),
            tangent: Some(self.corners[1] - self.corners[0]),
            primitive: 0,
        }
    }

    /// The point from which the normal leads to `above`; `None` where that is outside or behind.
    pub(crate) fn foot(&self, above: Vec3) -> Option<ShapeSample> {
        let [right, up] = self.partials().map(Vec3::as_dvec3);
        let from_corner = above.as_dvec3() - self.corners[0].as_dvec3();
        let normal = self.normal.as_dvec3();
        let height = from_corner.dot(normal);
        let foot = from_corner - normal * height;
        // The coordinates in the basis of the sides, by Cramer's rule.
        let [rr, ru, uu] = [right.dot(right), right.dot(up), up.dot(up)];
        let [r, u] = [foot.dot(right), foot.dot(up)];
        let determinant = rr * uu - ru * ru;
        let uv = [(r * uu - u * ru) / determinant, (u * rr - r * ru) / determinant];
        // Written so that NaN, of a rectangle without area, is outside.
        let is_inside = height > 0.0 && uv.iter().all(|x| (0.0..=1.0).contains(x));
        is_inside.then(|| self.at(uv.map(|x| x as f32)))
    }

    /// The point with texture coordinates `(u, v)`.
    pub(crate) fn at(&self, [u, v]: [f32; 2]) -> ShapeSample {
        let s = if u >= v { self.surface(0, [u - v, v]) } else { self.surface(1, [u, v - u]) };
        ShapeSample {
            position: s.position,
            error: s.error,
            normal: s.normal,
            uv: [u, v],
            pdf_area: 1.0 / self.area(),
        }
    }
}

/// One of the two triangles.
fn half_of([a, b, c, d]: &[Vec3; 4], half: u32) -> Corners {
    if half == 0 { [*a, *b, *c] } else { [*a, *c, *d] }
}
