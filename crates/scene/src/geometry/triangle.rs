//! What the shapes made of triangles share: points, error bounds, normals and areas.

use etendue_math::glam::{DVec3, Vec3};
use etendue_math::{Real, Vector3};

/// The three corners of a triangle.
pub(crate) type Corners = [Vec3; 3];

/// The point with barycentric coordinates `(1 − b₁ − b₂, b₁, b₂)` and a bound on its error, in
/// which the rounding of the intersection test is included.
///
/// ```text
/// p = v₀ + b₁ (v₁ − v₀) + b₂ (v₂ − v₀)                                       in f64
/// e = 2⁻²⁴ (|p| + max |v|/2²⁴ + 8 Σ |vᵢ − p| + 4 |v₁ − v₀| |v₂ − v₀| |v₁ − v₂| / (2A))
/// ```
///
/// The first two terms bound the rounding of `p`. The others bound how far the intersection test
/// sees the plane of the triangle displaced when a ray starts on it: it works with `vᵢ − o`, whose
/// rounding is relative to the distance of the corners, and with edge functions whose rounding is
/// relative to products of edges, which matters for slivers.
///
/// # Source
/// Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., section 6.8.5, which adds
/// `γ(7) Σ |bᵢ vᵢ|` instead because it works in `f32`: up to seven times as much away from the
/// origin, yet too little near it.
pub(crate) fn point(corners: &Corners, b1: f32, b2: f32) -> (Vec3, Vec3) {
    const U: f64 = 0.5 * f32::EPSILON as f64;
    let [v0, v1, v2] = corners.map(Vec3::as_dvec3);
    let p = v0 + (v1 - v0) * f64::from(b1) + (v2 - v0) * f64::from(b2);
    let largest = v0.abs().max(v1.abs()).max(v2.abs());
    let spread = (v0 - p).abs() + (v1 - p).abs() + (v2 - p).abs();
    let (e1, e2, e3) = (v1 - v0, v2 - v0, v2 - v1);
    let doubled_area = length(e1.cross(e2));
    let sliver = length(e1) * length(e2) * length(e3) / doubled_area;
    let sliver = if sliver.is_finite() { sliver } else { 0.0 };
    let error = p.abs() + largest * U + spread * 8.0 + DVec3::splat(4.0 * sliver);
    (p.as_vec3(), (error * U).as_vec3())
}

/// The unit normal of the side from which the corners run anticlockwise; `None` for a triangle
/// without area.
pub(crate) fn normal(corners: &Corners) -> Option<Vec3> {
    let [v0, v1, v2] = corners.map(Vec3::as_dvec3);
    // In f64 the cross product of f32 edges neither cancels badly nor leaves the range.
    Vector3::try_normalize((v1 - v0).cross(v2 - v0)).map(|n: DVec3| n.as_vec3())
}

/// The area, `|(v₁ − v₀) × (v₂ − v₀)| / 2`.
pub(crate) fn area(corners: &Corners) -> f32 {
    let [v0, v1, v2] = corners.map(Vec3::as_dvec3);
    (0.5 * length((v1 - v0).cross(v2 - v0))) as f32
}

fn length(v: DVec3) -> f64 {
    Real::sqrt(v.dot(v))
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Corners = [Vec3::ZERO, Vec3::X, Vec3::Y];

    #[test]
    fn the_front_is_where_the_corners_run_anticlockwise() {
        assert_eq!(normal(&UNIT), Some(Vec3::Z));
        assert_eq!(normal(&[Vec3::ONE; 3]), None);
        assert_eq!(area(&UNIT), 0.5);
    }

    #[test]
    fn tiny_and_huge_triangles_have_normals() {
        for scale in [1e-15, 1e15] {
            assert_eq!(normal(&UNIT.map(|v| v * scale)), Some(Vec3::Z));
        }
    }

    #[test]
    fn a_degenerate_triangle_has_a_finite_error_bound() {
        let (p, e) = point(&[Vec3::ONE; 3], 0.3, 0.3);
        assert!(p.is_finite() && e.is_finite());
    }
}
