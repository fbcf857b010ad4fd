//! Leaving a surface without hitting it again.

use etendue_math::glam::Vec3;

/// The point from which a ray leaves a surface: moved along the normal, to the side of `direction`,
/// by more than the error of the computed position, and then rounded away from the surface.
///
/// ```text
/// d = |n.x| e.x + |n.y| e.y + |n.z| e.z
/// p' = p ± d n,   each coordinate then a step of `f32` further in the direction of the shift
/// ```
///
/// - `position`: computed point, `error`: absolute bound on its error per axis (non-negative).
/// - `normal`: unit geometric normal. - `direction`: where the ray goes, any length.
///
/// # Source
/// Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., section 6.8.6.
#[inline(always)]
pub fn offset_point(position: Vec3, error: Vec3, normal: Vec3, direction: Vec3) -> Vec3 {
    let distance = normal.abs().dot(error);
    let shift = normal * distance.copysign(direction.dot(normal));
    let moved = position + shift;
    Vec3::new(away(moved.x, shift.x), away(moved.y, shift.y), away(moved.z, shift.z))
}

/// At least one float further in the direction of a shift; unchanged where there was none.
///
/// ```text
/// x' = x + sign(shift) (2⁻²³ |x| + 2⁻¹²⁶)
/// ```
///
/// The distance to the next float is at most `2⁻²³ |x|`, or `2⁻¹⁴⁹` near 0. Unlike counting the bits
/// up or down, this takes no branch on two signs that are as good as random.
#[inline(always)]
fn away(x: f32, shift: f32) -> f32 {
    let step = (x.abs() * f32::EPSILON + f32::MIN_POSITIVE).copysign(shift);
    x + if shift == 0.0 { 0.0 } else { step }
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
