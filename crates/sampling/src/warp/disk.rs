//! The unit disk, uniform in area, by concentric squares.

use etendue_math::Real;

use super::into_unit;

/// A point of the unit disk with the radius that the map knows without rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DiskPoint<T> {
    pub(crate) x: T,
    pub(crate) y: T,
    /// r², correct to 1 ulp.
    pub(crate) radius_squared: T,
    /// 1 − r², correct to 2 ulp: near the rim `1 − x² − y²` would have lost all digits.
    pub(crate) one_minus_radius_squared: T,
}

/// Concentric squares to concentric circles.
#[inline(always)]
pub(crate) fn concentric<T: Real>([u, v]: [T; 2]) -> DiskPoint<T> {
    let (a, b) = (T::TWO * u - T::ONE, T::TWO * v - T::ONE);
    // 1 − |a| and 1 − |b| from the uniforms themselves, where they are exact.
    let (rest_u, rest_v) = (T::ONE - u, T::ONE - v);
    let rim_a = T::TWO * if u < rest_u { u } else { rest_u };
    let rim_b = T::TWO * if v < rest_v { v } else { rest_v };
    // |a| > |b|, which rounding of a and b could not tell near the corners. The order is looked up:
    // a branch would be as good as random.
    let (order, rim) = if rim_a < rim_b { (0, rim_a) } else { (1, rim_b) };
    let longer_first = [a, b, a];
    let (r, other) = (longer_first[order], longer_first[order + 1]);
    let ratio = if r == T::ZERO { T::ZERO } else { other / r };
    let (sin, cos) = ratio.sin_cos_eighth_turn();
    let (along, across) = (r * cos, r * sin);
    let x_first = [along, across, along];
    let (x, y) = (x_first[order], x_first[order + 1]);
    DiskPoint { x, y, radius_squared: r * r, one_minus_radius_squared: rim * (T::ONE + r.abs()) }
}

/// A point uniform in area on the unit disk.
///
/// ```text
/// (a, b) = 2u − 1
/// |a| > |b|:  r = a, φ = π/4 · b/a;   else:  r = b, φ = π/2 − π/4 · a/b
/// (x, y) = r (cos φ, sin φ)
/// ```
///
/// `u`: uniforms in `[0, 1)`. Squares around the centre become circles: neighbours stay neighbours
/// and stratified points stay well spread.
///
/// # Precision
/// 3 ulp of each coordinate.
///
/// # Source
/// Shirley and Chiu, "A Low Distortion Map Between Disk and Square", J. Graphics Tools 2(3), 1997;
/// with signed radii as in Cline's simplification. Departure: the second sector swaps sine and
/// cosine instead of subtracting from π/2.
///
/// # Examples
/// ```
/// use etendue_sampling::warp::disk;
/// assert_eq!(disk::from_square([0.5_f32, 0.5]), [0.0, 0.0]);
/// assert_eq!(disk::from_square([0.0_f32, 0.5]), [-1.0, 0.0]);
/// ```
#[inline]
pub fn from_square<T: Real>(u: [T; 2]) -> [T; 2] {
    let point = concentric(u);
    [point.x, point.y]
}

/// The uniforms of a point of the unit disk; those of the nearest rim point for a point beyond it.
///
/// # Precision
/// Absolute, 4 ε.
#[inline]
pub fn to_square<T: Real>([x, y]: [T; 2]) -> [T; 2] {
    let r = (x * x + y * y).sqrt();
    let inverse_quarter_pi = T::lit(4.0) * T::FRAC_1_PI;
    let (a, b) = if r == T::ZERO {
        (T::ZERO, T::ZERO)
    } else if x.abs() > y.abs() {
        let a = r.copysign(x);
        (a, a * (y / x).atan() * inverse_quarter_pi)
    } else {
        let b = r.copysign(y);
        (b * (x / y).atan() * inverse_quarter_pi, b)
    };
    [into_unit(T::HALF * (a + T::ONE)), into_unit(T::HALF * (b + T::ONE))]
}

/// Density per area: 1/π on the disk, 0 beyond.
#[inline]
pub fn pdf<T: Real>([x, y]: [T; 2]) -> T {
    // The rim of the map itself is rounded.
    if x * x + y * y <= T::ONE + T::lit(4.0) * T::EPSILON { T::FRAC_1_PI } else { T::ZERO }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{check_inverse, check_jacobian, chi_squared_deviation, uniforms};
    use etendue_math::glam::DVec3;

    #[test]
    fn inverse_undoes_the_map() {
        check_inverse(from_square::<f64>, to_square, 4.0 * f64::EPSILON);
        check_inverse(from_square::<f32>, to_square, 4.0 * f64::from(f32::EPSILON));
    }

    #[test]
    fn density_is_that_of_the_map() {
        let map = |u| DVec3::from((from_square(u)[0], from_square(u)[1], 0.0));
        check_jacobian(map, |p| pdf([p.x, p.y]));
    }

    #[test]
    fn samples_fill_rings_and_sectors_of_equal_area_evenly() {
        let mut counts = [0.0; 64];
        for u in uniforms::<f64>(20_000) {
            let [x, y] = from_square(u);
            let ring = ((x * x + y * y) * 8.0) as usize;
            let sector = (crate::warp::turn::from_point(x, y) * 8.0) as usize;
            counts[ring.min(7) * 8 + sector] += 1.0;
        }
        // 5 standard deviations of a fixed seed.
        assert!(chi_squared_deviation(&counts, &[20_000.0 / 64.0; 64]) < 5.0);
        // Equal areas: the density integrates to 1 because it is 1/π on an area of π.
        assert_eq!(pdf([0.3_f64, 0.4]) * f64::PI, 1.0);
        assert_eq!(pdf([0.8_f64, 0.7]), 0.0);
    }

    #[test]
    fn distance_to_the_rim_is_exact_at_the_edge_of_the_square() {
        for k in 2..=40 {
            let u = Real::powi(0.5_f32, k);
            // (1 − |1 − 2u|)(1 + |1 − 2u|) = 4u(1 − u), exact in f64.
            let exact = 4.0 * f64::from(u) * (1.0 - f64::from(u));
            // At a corner too, where below 2⁻²⁴ both 2u − 1 round to −1.
            for other in [0.5, 1.5 * u] {
                for point in [concentric([u, other]), concentric([other, u])] {
                    let error = (f64::from(point.one_minus_radius_squared) / exact - 1.0).abs();
                    assert!(error <= f64::from(f32::EPSILON), "{u} {other}: {error:e}");
                }
            }
        }
    }
}
