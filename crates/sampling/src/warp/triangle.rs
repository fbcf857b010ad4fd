//! A triangle, uniform in area.

use etendue_math::{Real, Vec3, Vector3};

use super::{accurate_cross, into_unit};

/// Barycentric coordinates `[b₀, b₁, b₂]` of a point uniform in area.
///
/// ```text
/// u₁ > u₀:  b₀ = u₀/2, b₁ = u₁ − b₀;   else:  b₁ = u₁/2, b₀ = u₀ − b₁;   b₂ = 1 − b₀ − b₁
/// ```
///
/// `u`: uniforms in `[0, 1)`. All three are at least 0 and sum to 1 within rounding.
///
/// # Precision
/// Absolute, 1 ε.
///
/// # Source
/// E. Heitz, "A Low-Distortion Map Between Triangle and Square", 2019: no square root, and less
/// distortion than the textbook's `√u` map.
///
/// # Examples
/// ```
/// use etendue_sampling::warp::triangle;
/// assert_eq!(triangle::from_square([0.5_f32, 0.5]), [0.25, 0.25, 0.5]);
/// ```
#[inline(always)]
pub fn from_square<T: Real>([u, v]: [T; 2]) -> [T; 3] {
    // The smaller one less its half is that half: both cases in one, because a branch on which one
    // is smaller would be as good as random.
    let half = T::HALF * if v > u { u } else { v };
    let (b0, b1) = (u - half, v - half);
    [b0, b1, (T::ONE - b0 - b1).max(T::ZERO)]
}

/// The uniforms of a point given by its barycentric coordinates.
#[inline]
pub fn to_square<T: Real>([b0, b1, _]: [T; 3]) -> [T; 2] {
    let (u, v) = if b1 > b0 { (T::TWO * b0, b0 + b1) } else { (b0 + b1, T::TWO * b1) };
    [into_unit(u), into_unit(v)]
}

/// Density per area: `1/A`, 0 for a triangle without area.
///
/// ```text
/// A = ½ |(p₁ − p₀) × (p₂ − p₀)|
/// ```
#[inline]
pub fn pdf<T: Real>([p0, p1, p2]: [Vec3<T>; 3]) -> T {
    let area = T::HALF * accurate_cross(p1 - p0, p2 - p0).length();
    if area > T::ZERO { T::ONE / area } else { T::ZERO }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{check_inverse, check_jacobian, chi_squared_deviation, uniforms};
    use etendue_math::glam::DVec3;

    const CORNERS: [DVec3; 3] =
        [DVec3::new(1.0, 0.0, 0.5), DVec3::new(0.0, 2.0, 0.0), DVec3::new(-1.0, 0.5, 3.0)];

    #[test]
    fn inverse_undoes_the_map() {
        check_inverse(from_square::<f64>, to_square, 2.0 * f64::EPSILON);
        check_inverse(from_square::<f32>, to_square, 2.0 * f64::from(f32::EPSILON));
    }

    #[test]
    fn density_is_that_of_the_map() {
        let point = |u| {
            let [b0, b1, b2] = from_square(u);
            CORNERS[0] * b0 + CORNERS[1] * b1 + CORNERS[2] * b2
        };
        check_jacobian(point, |_| pdf::<f64>(CORNERS));
    }

    #[test]
    fn samples_fill_triangles_of_equal_area_evenly() {
        const SIDE: usize = 8;
        let mut counts = [0.0; SIDE * SIDE];
        for u in uniforms::<f64>(20_000) {
            let b = from_square(u);
            assert!(b.iter().all(|&b| b >= 0.0));
            // SIDE² congruent triangles: SIDE − row … in each strip, upright and inverted.
            let scaled = b.map(|b| b * SIDE as f64);
            let row = (scaled[2] as usize).min(SIDE - 1);
            let column = scaled[0] as usize;
            let inverted = scaled[0].fract() + scaled[1].fract() < 1.0;
            let index = (0..row).map(|r| 2 * (SIDE - r) - 1).sum::<usize>();
            counts[(index + 2 * column + usize::from(!inverted)).min(SIDE * SIDE - 1)] += 1.0;
        }
        let z = chi_squared_deviation(&counts, &[20_000.0 / 64.0; SIDE * SIDE]);
        // 5 standard deviations of a fixed seed.
        assert!(z < 5.0, "{z} {counts:?}");
    }

    #[test]
    fn a_triangle_without_area_has_no_density() {
        let p = DVec3::new(1.0, 2.0, 3.0);
        assert_eq!(pdf::<f64>([p, p, DVec3::ZERO]), 0.0);
        assert_eq!(pdf::<f64>([DVec3::NAN, p, DVec3::ZERO]), 0.0);
    }
}
