//! Leaving a surface without hitting it again.

use etendue_math::glam::Vec3;

/// The point from which a ray leaves a surface: moved along the normal, to the side of `direction`,
/// by more than the error of the computed position and of the sum itself.
///
/// ```text
/// d = Σ |nᵢ| (eᵢ + 2⁻²³ |pᵢ|),   p' = p ± d n
/// ```
///
/// - `position`: computed point, `error`: absolute bound on its error per axis (non-negative).
/// - `normal`: unit geometric normal. - `direction`: where the ray goes, any length.
///
/// Rounding `p'` moves it by at most `Σ |nᵢ| 2⁻²⁴ |p'ᵢ|` along the normal, about half of what the
/// second term adds: the point stays beyond the error of `position`. A coordinate along which the
/// normal vanishes stays the same.
///
/// # Source
/// Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., section 6.8.6. There each
/// coordinate is moved to the next float instead, by its bits, which takes three times as long.
#[inline(always)]
pub fn offset_point(position: Vec3, error: Vec3, normal: Vec3, direction: Vec3) -> Vec3 {
    let distance = normal.abs().dot(error + position.abs() * f32::EPSILON);
    position + normal * distance.copysign(direction.dot(normal))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_offset_is_to_the_side_of_the_direction_and_at_least_the_error() {
        let p = Vec3::new(10.0, -20.0, 30.0);
        let n = Vec3::new(0.6, 0.0, -0.8);
        let e = p.abs() * f32::EPSILON;
        for (d, side) in [(n, 1.0), (-n, -1.0), (n + Vec3::Y * 9.0, 1.0)] {
            let q = offset_point(p, e, n, d);
            let shift = (q - p).as_dvec3().dot(n.as_dvec3()) * side;
            assert!(shift >= f64::from(n.abs().dot(e)), "{shift}");
        }
    }

    #[test]
    fn coordinates_along_which_the_normal_vanishes_stay_the_same() {
        let q = offset_point(Vec3::ONE, Vec3::splat(1e-6), Vec3::Z, Vec3::X);
        assert_eq!((q.x, q.y), (1.0, 1.0));
    }
}
