//! What the shapes made of triangles share: normals, areas, points and error bounds.

use etendue_math::glam::{DVec3, Vec3};
use etendue_math::{Real, Vector3};

/// The three corners of a triangle.
pub(crate) type Corners = [Vec3; 3];

/// What is the same at every point of a triangle, computed once, in `f64`: the cross product of
/// `f32` edges neither cancels badly nor leaves the range there.
///
/// It repeats the corners and fills one cache line: all that a hit or a sample of a triangle reads.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub(crate) struct Facet {
    /// The corners.
    pub(crate) corners: Corners,
    /// Unit normal; +z for a triangle without area.
    pub(crate) normal: Vec3,
    /// The area, `|(v₁ − v₀) × (v₂ − v₀)| / 2`.
    pub(crate) area: f32,
    /// The square of the longest side.
    pub(crate) longest_squared: f32,
    /// The part of the error bound of a point that does not depend on the point.
    error: f32,
}

impl Facet {
    /// The facet seen from the side from which the corners run anticlockwise.
    ///
    /// The error bound of a point p, in which the rounding of the intersection test is included, is
    ///
    /// ```text
    /// e = 2⁻²⁴ (|p| + max |v|/2²⁴ + 16 s + 4 |v₁ − v₀| |v₂ − v₀| |v₁ − v₂| / (2A))
    /// ```
    ///
    /// with s the largest side of the box around the triangle. The first two terms bound the rounding
    /// of `p`. The others bound how far the intersection test sees the plane of the triangle displaced
    /// when a ray starts on it: it works with `vᵢ − o`, whose rounding is relative to the distance of
    /// the corners (`Σ |vᵢ − p| ≤ 2 s` on each axis), and with edge functions whose rounding is relative
    /// to products of edges, which matters for slivers.
    ///
    /// # Source
    /// Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., section 6.8.5, which adds
    /// `γ(7) Σ |bᵢ vᵢ|` instead because it works in `f32`: up to seven times as much away from the
    /// origin, yet too little near it.
    pub(crate) fn of(corners: Corners) -> Self {
        let [v0, v1, v2] = corners.map(Vec3::as_dvec3);
        let (e1, e2, e3) = (v1 - v0, v2 - v0, v2 - v1);
        let doubled_area = length(e1.cross(e2));
        let sliver = length(e1) * length(e2) * length(e3) / doubled_area;
        let sliver = if sliver.is_finite() { sliver } else { 0.0 };
        let largest = v0.abs().max(v1.abs()).max(v2.abs()).max_element();
        let side = (v0.max(v1).max(v2) - v0.min(v1).min(v2)).max_element();
        let error = U * (largest * U + 16.0 * side + 4.0 * sliver);
        Self {
            corners,
            normal: normal(&corners).unwrap_or(Vec3::Z),
            area: (0.5 * doubled_area) as f32,
            longest_squared: e1.dot(e1).max(e2.dot(e2)).max(e3.dot(e3)) as f32,
            error: error as f32,
        }
    }

    /// Whether a ray can hit it: its corners are not on a line.
    pub(crate) fn has_area(&self) -> bool {
        // What underflows in `f32` need not be 0.
        self.area > 0.0 || normal(&self.corners).is_some()
    }

    /// The point with barycentric coordinates `(1 − b₁ − b₂, b₁, b₂)` and a bound on its error.
    ///
    /// ```text
    /// p = v₀ + b₁ (v₁ − v₀) + b₂ (v₂ − v₀)                                       in f64
    /// ```
    #[inline(always)]
    pub(crate) fn point(&self, [b1, b2]: [f32; 2]) -> (Vec3, Vec3) {
        // One by one: `map` is not always inlined.
        let [v0, v1, v2] = self.corners;
        let (v0, v1, v2) = (v0.as_dvec3(), v1.as_dvec3(), v2.as_dvec3());
        let p = v0 + (v1 - v0) * f64::from(b1) + (v2 - v0) * f64::from(b2);
        let p = p.as_vec3();
        (p, p.abs() * U as f32 + Vec3::splat(self.error))
    }
}

/// The unit normal of the side from which the corners run anticlockwise; `None` for a triangle
/// without area.
pub(crate) fn normal(corners: &Corners) -> Option<Vec3> {
    let [v0, v1, v2] = corners.map(Vec3::as_dvec3);
    Vector3::try_normalize((v1 - v0).cross(v2 - v0)).map(|n: DVec3| n.as_vec3())
}

/// The unit roundoff of `f32`.
const U: f64 = 0.5 * f32::EPSILON as f64;

fn length(v: DVec3) -> f64 {
    Real::sqrt(v.dot(v))
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Corners = [Vec3::ZERO, Vec3::X, Vec3::Y];

    #[test]
    fn the_front_is_where_the_corners_run_anticlockwise() {
        assert_eq!(Facet::of(UNIT).normal, Vec3::Z);
        assert_eq!(Facet::of(UNIT).area, 0.5);
        let [a, b, c] = UNIT;
        assert_eq!(Facet::of([a, c, b]).normal, -Vec3::Z);
    }

    #[test]
    fn tiny_and_huge_triangles_have_normals() {
        for scale in [1e-15, 1e15] {
            assert_eq!(Facet::of(UNIT.map(|v| v * scale)).normal, Vec3::Z);
        }
    }

    #[test]
    fn a_facet_fills_a_cache_line() {
        assert_eq!(size_of::<Facet>(), 64);
    }

    #[test]
    fn a_degenerate_triangle_has_a_finite_error_bound() {
        let facet = Facet::of([Vec3::ONE; 3]);
        let (p, e) = facet.point([0.3, 0.3]);
        assert!(p.is_finite() && e.is_finite());
        assert_eq!(facet.area, 0.0);
    }
}
