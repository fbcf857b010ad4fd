//! From densities per area to densities per solid angle.

use etendue_math::Real;

/// Density per steradian of a direction to a surface point drawn with density `pdf` per area.
///
/// ```text
/// p(ω) = p(A) d² / |cos θ'|
/// ```
///
/// - `pdf`: density per area.
/// - `distance_squared`: squared distance `d²` of the point, in the unit of the area.
/// - `cos`: cosine between the surface normal and the direction; its sign does not matter.
///
/// Returns 0 where the surface is seen edge on (`cos = 0`): no direction leads to its area there.
#[inline]
pub fn to_solid_angle<T: Real>(pdf: T, distance_squared: T, cos: T) -> T {
    if cos == T::ZERO { T::ZERO } else { pdf * (distance_squared / cos.abs()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sphere_seen_from_its_centre_has_equal_densities() {
        let radius = 3.0_f64;
        let per_area = 1.0 / (4.0 * f64::PI * radius * radius);
        let got = to_solid_angle(per_area, radius * radius, -1.0);
        assert!((got * 4.0 * f64::PI - 1.0).abs() < 4.0 * f64::EPSILON);
    }

    #[test]
    fn edge_on_surfaces_have_no_density() {
        assert_eq!(to_solid_angle(1.0_f32, 1.0, 0.0), 0.0);
    }
}
